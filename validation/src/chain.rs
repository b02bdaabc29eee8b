//! The chain of misprints: Table 5 misprints a digit of a sum in Table B2, and Table 6 converts the wrong number.

use crate::account::{Computed, find, printed, value};
use crate::sheet::Printed;

/// One link: a printed number, and its derivation from the preceding one.
#[derive(Clone, Debug, PartialEq)]
pub struct Link {
    /// Its place in the paper.
    pub place: &'static str,
    /// The printed value.
    pub printed: String,
    /// The correct value.
    pub holds: String,
    /// The derivation, in numbers.
    pub how: String,
    /// `true` if those numbers confirm it.
    pub follows: bool,
}

const TEST: &str = "2";
const ENERGY: &str = "planar_energy";

/// Returns the three links, from Table B2 to Table 6.
pub(crate) fn links(table_b2: &[Computed], table_5: &[Computed], table_6: &[Computed]) -> Vec<Link> {
    vec![sum(table_b2), digit(table_b2, table_5), conversion(table_b2, table_5, table_6)]
}

fn text(cells: &[Computed], row: &str, column: &str) -> String {
    find(cells, row, column).map_or_else(String::new, |cell| cell.printed.text().to_owned())
}

/// Returns the loss in the rows of Table B2 with the measured restitution, which Table 5 repeats.
fn loss_of(table_b2: &[Computed], test: &str) -> f64 {
    let row = table_b2.iter().find(|cell| cell.column == "planar_T_L" && cell.row.starts_with(test) && !cell.row.ends_with(" 0.00"));
    row.map_or(f64::NAN, |cell| cell.printed.value())
}

fn sum(table_b2: &[Computed]) -> Link {
    const ROW: &str = "2 0.13";
    let [normal, tangential, loss] = ["planar_T_Ln", "planar_T_Lt", "planar_T_L"].map(|column| printed(table_b2, ROW, column));
    Link {
        place: "Table B2, test 2, planar T_L, ft lb",
        printed: text(table_b2, ROW, "planar_T_L"),
        holds: text(table_b2, ROW, "planar_T_L"),
        how: format!("{normal} + {tangential} of its row, rounded before; computed {:.1}", value(table_b2, ROW, "planar_T_L")),
        // Two terms and their sum, each rounded.
        follows: (normal + tangential - loss).abs() <= 1.5,
    }
}

fn digit(table_b2: &[Computed], table_5: &[Computed]) -> Link {
    let excess = |test: &str| printed(table_5, test, ENERGY) - loss_of(table_b2, test);
    Link {
        place: "Table 5, test 2, planar crush energy, ft lb",
        printed: text(table_5, TEST, ENERGY),
        holds: loss_of(table_b2, TEST).to_string(),
        how: format!(
            "{} more than Table B2: one digit is wrong. The other two tests repeat Table B2, with differences of {} and {}",
            excess(TEST),
            excess("1"),
            excess("3")
        ),
        follows: excess(TEST) == 10_000.0 && excess("1") == 0.0 && excess("3") == 0.0,
    }
}

fn conversion(table_b2: &[Computed], table_5: &[Computed], table_6: &[Computed]) -> Link {
    // The range of kJ per ft lb that the rounded values of the other two tests in the column allow.
    let factors = ["1", "3"].map(|test| {
        let half = find(table_6, test, ENERGY).map_or(f64::NAN, |cell| cell.printed.half_unit());
        let (metric, us) = (printed(table_6, test, ENERGY), printed(table_5, test, ENERGY));
        [(metric - half) / us, (metric + half) / us]
    });
    let (least, most) = (factors[0][0].max(factors[1][0]), factors[0][1].min(factors[1][1]));
    let stated = find(table_6, TEST, ENERGY).map(|cell| cell.printed.clone());
    let gives = |energy: f64| [least * energy, most * energy];
    let [low, high] = gives(printed(table_5, TEST, ENERGY));
    let [low_right, high_right] = gives(loss_of(table_b2, TEST));
    let agrees = |number: f64| stated.as_ref().is_some_and(|stated: &Printed| stated.agrees_with(number));
    Link {
        place: "Table 6, test 2, planar crush energy, kJ",
        printed: text(table_6, TEST, ENERGY),
        holds: format!("{:.1}", value(table_6, TEST, ENERGY)),
        how: format!(
            "the misprint of Table 5 converted: the column's other cells have {:.4} to {:.4} kJ in 1000 ft lb, which makes {low:.2} to {high:.2} of it; \
             Table B2's number would be {low_right:.2} to {high_right:.2}, and {:.1} with 1.3558",
            least * 1e3,
            most * 1e3,
            value(table_6, TEST, ENERGY)
        ),
        follows: least < most && agrees(low) && agrees(high) && !agrees(low_right) && !agrees(high_right),
    }
}
