//! Statements of the text and of Tables 5 and 6 in other units.

use super::{Cells, Standing, Statement, joined, rounds_to};
use crate::account::{Computed, find, printed};
use crate::barrier::MPH;
use crate::comparison::{JOULES, KPH};

pub(super) fn statements(cells: &Cells<'_>) -> Vec<Statement> {
    vec![first_test_in_the_text(cells), metric_energies(cells), metric_speeds(cells)]
}

fn first_test_in_the_text(cells: &Cells<'_>) -> Statement {
    let energy = ["crash3_energy", "planar_energy"].map(|column| printed(cells.table_5, "1", column) * JOULES / 1000.0);
    let speed = [printed(cells.table_5, "1", "crash3_dv"), printed(cells.table_5, "1", "planar_dv"), 13.7].map(|mph| mph * KPH / MPH);
    let energies = energy.iter().zip(["15.7", "17.0"]).all(|(&energy, digits)| rounds_to(energy, digits));
    let speeds = speed.iter().zip(["15.9", "19.6", "22.0"]).all(|(&speed, digits)| rounds_to(speed, digits));
    Statement {
        name: "test 1 in the text",
        place: "comparison with CRASH3",
        says: "for test 1 T_L is 11550 ft lb (15.7 kJ) with 9.9 mph (15.9 km/h) from CRASH3, 12504 ft lb (17.0 kJ) with 12.2 mph (19.6 km/h) from \
               planar impact mechanics, and the barrier test had 13.7 mph (22.0 km/h)",
        found: format!("they are {} kJ, and {} km/h; Table 6 has 15.6 kJ for the first", joined(energy, 2), joined(speed, 2)),
        standing: Standing::of(energies && speeds),
        expected: Standing::Holds,
    }
}

const ENERGIES: [&str; 3] = ["test_energy", "crash3_energy", "planar_energy"];
const SPEEDS: [(&str, &str); 3] = [("test_EES", "test_EES"), ("crash3_dv", "crash3_dv_ftps"), ("planar_dv", "planar_dv_ftps")];

/// Returns the range of factors from one printed number to another, given its rounding.
fn factors(from: f64, to: &Computed) -> [f64; 2] {
    [(to.printed.value() - to.printed.half_unit()) / from, (to.printed.value() + to.printed.half_unit()) / from]
}

fn metric_energies(cells: &Cells<'_>) -> Statement {
    let mut factors_of = Vec::new();
    for test in ["1", "2", "3"] {
        for column in ENERGIES {
            if let Some(cell) = find(cells.table_6, test, column) {
                factors_of.push(factors(printed(cells.table_5, test, column), cell).map(|factor| factor * 1e3));
            }
        }
    }
    let admits = |factor: f64| factors_of.iter().filter(|[least, most]| (*least..=*most).contains(&factor)).count();
    let (right, column) = (admits(JOULES), admits(1.358));
    Statement {
        name: "Table 6 converts energies",
        place: "Table 6",
        says: "Table 6 gives the energies of Table 5 in kJ",
        found: format!(
            "with 1.3558 J in a foot pound {right} of the {} energies are so, with 1.358 {column}: 15.6 and 170.0 kJ fit neither. 15.6 follows from \
             {:.4} to {:.4}, 170.0 from {:.4} to {:.4}",
            factors_of.len(),
            factors_of[1][0],
            factors_of[1][1],
            factors_of[6][0],
            factors_of[6][1]
        ),
        standing: Standing::of(right == 9),
        expected: Standing::Fails,
    }
}

fn metric_speeds(cells: &Cells<'_>) -> Statement {
    let mut factors_of = Vec::new();
    for (test, row) in [("1", "1 0.18"), ("2", "2 0.13"), ("3", "3 0.12")] {
        for (column, column_b2) in SPEEDS {
            // CRASH3 has one row per test.
            let without = format!("{test} 0.00");
            let row = if column == "crash3_dv" { without.as_str() } else { row };
            if let Some(cell) = find(cells.table_6, test, column) {
                factors_of.push(factors(printed(cells.table_b2, row, column_b2), cell));
            }
        }
    }
    let least = factors_of.iter().map(|range| range[0]).fold(f64::NEG_INFINITY, f64::max);
    let most = factors_of.iter().map(|range| range[1]).fold(f64::INFINITY, f64::min);
    Statement {
        name: "Table 6 converts rounded speeds",
        place: "this crate",
        says: "the speeds of Table 6 are the rounded ft/s of Table B2, converted",
        found: format!("all {} are, with a factor from {least:.4} to {most:.4}; a foot a second is {KPH:.4} km/h", factors_of.len()),
        standing: Standing::of(factors_of.len() == 9 && least <= most),
        expected: Standing::Holds,
    }
}
