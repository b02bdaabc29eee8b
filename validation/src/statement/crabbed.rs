//! Statements about the tests in Table B1, and about the paper's computation of them.

use super::{Crabbed, Standing, Statement, joined, largest, rounds_to};
use crate::account::{Computed, find, value};
use crate::barrier::{MPH, table_b1, vehicle_masses};
use crate::data::DataError;
use crate::geometry::{Geometry, Wall};
use crate::series::{CrabbedTest, Restitution, Series};

const PLACE: &str = "comparison with barrier tests";

pub(super) fn statements(crabbed: &Crabbed<'_>, cells: &[Computed], text: &str) -> Result<Vec<Statement>, DataError> {
    let heavy = table_b1(crabbed.geometry, text, Wall::Papers)?;
    Ok(vec![
        the_papers_wall_is_a_heavy_body(crabbed.geometry, &heavy),
        rounded_cells_are_computed_with(cells, &heavy),
        velocity_changes_are_within_three_percent(cells, crabbed.series),
        yaw_rates_are_too_high(cells, crabbed.series),
    ])
}

fn label(cell: &Computed) -> String {
    format!("{}, {}", cell.row, cell.column)
}

fn the_papers_wall_is_a_heavy_body(geometry: &Geometry, heavy: &[Computed]) -> Statement {
    // Two columns are computed from other rounded cells: `rounded_cells_are_computed_with`.
    let direct = heavy.iter().filter(|cell| cell.column != "T_L" && cell.column != "dv_mph");
    let off = direct.clone().filter(|cell| !cell.printed.agrees_with(cell.value)).map(label).collect::<Vec<_>>();
    let multiple = vehicle_masses(&geometry.crabbed(1.0, 0.0, Wall::Papers)).unwrap_or(f64::NAN);
    let count = direct.count();
    Statement {
        name: "the paper's barrier is a heavy body",
        place: "this crate",
        says: "the paper computes Table B1 with a body of 1e6 slug instead of a fixed barrier",
        found: format!(
            "with {:.0e} slug, {multiple:.0} vehicle masses, all but {} of {count} cells agree to the last digit: {}, which is a misprint",
            geometry.papers_barrier_mass,
            off.len(),
            off.join("; ")
        ),
        standing: Standing::of(count == 54 && off == ["2 0.13, T_Ln"]),
        expected: Standing::Holds,
    }
}

fn rounded_cells_are_computed_with(cells: &[Computed], heavy: &[Computed]) -> Statement {
    let printed = |row: &str, column| find(cells, row, column).map_or(f64::NAN, |cell| cell.printed.value());
    let sums = cells.iter().filter(|cell| cell.column == "T_L").filter(|cell| {
        let sum = printed(&cell.row, "T_Ln") + printed(&cell.row, "T_Lt");
        let adds_up = (sum - cell.printed.value()).abs() < 1e-6;
        !adds_up
    });
    let speeds = cells.iter().filter(|cell| cell.column == "dv_mph");
    let speeds = speeds.filter(|cell| !cell.printed.agrees_with(printed(&cell.row, "dv_ftps") * MPH));
    let off = sums.chain(speeds).map(label).collect::<Vec<_>>();
    let unrounded = heavy.iter().filter(|cell| cell.column == "T_L" || cell.column == "dv_mph");
    let unrounded = unrounded.filter(|cell| !cell.printed.agrees_with(cell.value)).map(label).collect::<Vec<_>>();
    Statement {
        name: "the paper computes with rounded cells",
        place: "this crate",
        says: "T_L of Table B1 is the sum of the printed T_Ln and T_Lt, and ΔV in mph is the printed ΔV in ft/s converted",
        found: format!(
            "so in all but {}, where T_Ln is a misprint; without rounding first, {} would not agree even with the paper's barrier",
            off.join("; "),
            unrounded.join("; ")
        ),
        standing: Standing::of(off == ["2 0.13, T_L"]),
        expected: Standing::Holds,
    }
}

fn velocity_changes_are_within_three_percent(cells: &[Computed], series: &Series) -> Statement {
    let percent = |test: &CrabbedTest| (value(cells, &test.label(Restitution::Measured), "dv_mph") / test.delta_v_mph - 1.0) * 100.0;
    let off = series.tests.iter().map(percent).collect::<Vec<_>>();
    Statement {
        name: "velocity changes are within 3 percent",
        place: PLACE,
        says: "the ΔV values from the three collisions are all within 3 % of the test",
        found: format!("off by {} %", joined(off.iter().copied(), 2)),
        standing: Standing::of(off.len() == 3 && largest(off.iter().map(|percent| percent.abs())) <= 3.0),
        expected: Standing::Holds,
    }
}

fn yaw_rates_are_too_high(cells: &[Computed], series: &Series) -> Statement {
    let factor = |test: &CrabbedTest| value(cells, &test.label(Restitution::Measured), "omega") / test.yaw_rate;
    let factors = series.tests.iter().map(factor).collect::<Vec<_>>();
    let least = -largest(factors.iter().map(|factor| -factor));
    Statement {
        name: "yaw rates are too high",
        place: PLACE,
        says: "all computed yaw rates are higher than those of the tests, some by as much as a factor of 2",
        found: format!("by factors of {}", joined(factors.iter().copied(), 2)),
        standing: Standing::of(factors.len() == 3 && least > 1.0 && rounds_to(largest(factors), "2")),
        expected: Standing::Holds,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::Texts;
    use crate::reconstruction::Reconstructions;

    fn standings(geometry: &str, table_b1_text: &str) -> Vec<Standing> {
        let geometry = Geometry::read(geometry).expect("digits");
        let cells = table_b1(&geometry, table_b1_text, Wall::Fixed).expect("digits");
        let series = Series::read(table_b1_text, Texts::embedded().table_b2).expect("digits");
        let found = Reconstructions::of(&geometry, &series, Wall::Fixed).expect("possible");
        let crabbed = Crabbed { geometry: &geometry, series: &series, found: &found };
        statements(&crabbed, &cells, table_b1_text).expect("digits").into_iter().map(|statement| statement.standing).collect()
    }

    #[test]
    fn only_the_papers_mass_fits() {
        let texts = Texts::embedded();
        // Values from 0.9962 to 1.0003 million slug fit.
        for (mass, fits) in [("980000", false), ("998000", true), ("1000000", true), ("1010000", false), ("1000000000", false)] {
            let geometry = texts.geometry.replace("papers_mass,1000000", &format!("papers_mass,{mass}"));
            assert_eq!(standings(&geometry, texts.table_b1)[0] == Standing::Holds, fits, "{mass}");
        }
    }

    #[test]
    fn a_measured_cell_is_read() {
        let texts = Texts::embedded();
        // ΔV of test 2, 24.0 mph: at 25, the computed 23.3 differs by 7 %.
        assert_eq!(standings(texts.geometry, &texts.table_b1.replace(",24.0,", ",25.0,"))[2], Standing::Fails);
        // Ω of test 1, 37.7 deg/s: above 64.3 the computed one is no longer higher.
        assert_eq!(standings(texts.geometry, &texts.table_b1.replace(",37.7,", ",64.4,"))[3], Standing::Fails);
    }

    #[test]
    fn a_measured_cell_that_is_no_number_is_an_error() {
        let text = Texts::embedded().table_b1.replace(",24.0,", ",fast,");
        assert!(matches!(Series::read(&text, Texts::embedded().table_b2).err(), Some(DataError::NotANumber { column: "dv_test_mph", .. })));
    }
}
