//! Statements of Table B2, Tables 5 and 6 and Figures 6 and 7 about crush energy.

use super::{Cells, Crabbed, Standing, Statement, joined, largest};
use crate::account::{Computed, find, printed, value};
use crate::barrier::MPH;
use crate::data::DataError;
use crate::figure::{fitted_line, intensities};
use crate::geometry::Wall;
use crate::reconstruction::{Reconstruction, Reconstructions, columns};
use crate::series::{CrabbedTest, Restitution};
use planar_impact::crush::equivalent_energy_speed;
use planar_impact::scalar::Field as _;

const PLACE: &str = "comparison with CRASH3";

pub(super) fn statements(cells: &Cells<'_>, crabbed: &Crabbed<'_>) -> Result<Vec<Statement>, DataError> {
    Ok(vec![
        equation_9(cells, crabbed),
        energies_add_up(cells),
        crush_lies_on_the_line(crabbed),
        rounding_explains_the_bounds(cells, crabbed)?,
        crash3_takes_a_rounded_angle(cells),
        crash3_velocity_change(cells, crabbed),
        planar_is_closer(cells, crabbed),
        crash3_is_closer(cells, crabbed),
    ])
}

fn tests<'a>(crabbed: &'a Crabbed<'_>, restitution: Restitution) -> Vec<(&'a CrabbedTest, &'a Reconstruction)> {
    crabbed.series.tests.iter().enumerate().map(|(which, test)| (test, crabbed.found.get(which, restitution))).collect()
}

fn equation_9(cells: &Cells<'_>, crabbed: &Crabbed<'_>) -> Statement {
    let normal = |test: &CrabbedTest| (crabbed.geometry.crabbed_velocity(test.speed.value()).x, 0.0);
    let as_printed: Vec<_> = (1..=crabbed.series.tests.len())
        .map(|count| equivalent_energy_speed(crabbed.series.tests.iter().take(count).map(normal)) * MPH)
        .collect();
    let stated: Vec<_> = crabbed.series.tests.iter().map(|test| printed(cells.table_5, &test.name, "test_EES")).collect();
    let with: Vec<_> = tests(crabbed, Restitution::Measured).iter().map(|(_, found)| found.cumulative.equivalent_speed * MPH).collect();
    let agrees = |speeds: &[f64]| speeds.len() == 3 && speeds.iter().zip(&stated).all(|(a, b)| (a - b).abs() < 0.05);
    Statement {
        name: "equation 9",
        place: "Eq 9",
        says: "EES is the root of the sum of the squares of v_in",
        found: format!(
            "only for e = 0: that gives {} mph, and Table 5 has {}, which is the sum of (1 - e²) v_in²: {}",
            joined(as_printed.iter().copied(), 2),
            joined(stated.iter().copied(), 1),
            joined(with.iter().copied(), 2)
        ),
        standing: Standing::conditional(agrees(&with), agrees(&as_printed)),
        expected: Standing::HoldsConditionally,
    }
}

fn energies_add_up(cells: &Cells<'_>) -> Statement {
    let rows = [("1 0.18", None), ("2 0.13", Some("1 0.18")), ("3 0.12", Some("2 0.13"))];
    // Differences of printed energies in successive tests of Table B2, compared with the computed T_Ln of Table B1.
    let off = rows.map(|(row, before)| {
        let energy = |row| printed(cells.table_b2, row, "test_E_C");
        let own = energy(row) - before.map_or(0.0, energy);
        own - value(cells.table_b1, row, "T_Ln")
    });
    let misprint = printed(cells.table_b1, "2 0.13", "T_Ln") - value(cells.table_b1, "2 0.13", "T_Ln");
    Statement {
        name: "crush energies add up from test to test",
        place: "Figure 6",
        says: "the crush energy of each test is an accumulation of the kinetic energy from test to test",
        found: format!(
            "each test adds its T_Ln of Table B1 to the printed E_C of Table B2, to {} ft lb; the T_Ln that is misprinted there would be off by {misprint:.0}",
            joined(off, 1)
        ),
        // Two energies, each rounded to one foot-pound.
        standing: Standing::of(largest(off.map(f64::abs)) <= 1.0),
        expected: Standing::Holds,
    }
}

fn crush_lies_on_the_line(crabbed: &Crabbed<'_>) -> Statement {
    let found = tests(crabbed, Restitution::Measured);
    let off: Vec<_> = found.iter().map(|(_, found)| (found.intensity_of_crush / found.cumulative.intensity - 1.0) * 100.0).collect();
    let energy: Vec<_> = found.iter().map(|(_, found)| (found.crash3.normal / found.cumulative.energy - 1.0) * 100.0).collect();
    let line = fitted_line(&intensities(crabbed.series, crabbed.found, Restitution::Measured));
    let residuals = found.iter().map(|(test, found)| (line.crush_intensity(test.depth) / found.cumulative.intensity - 1.0) * 100.0);
    Statement {
        name: "crush lies on the line",
        place: "Figure 7",
        says: "the average measured crush, with the crush stiffness of NHTSA, matches the linear model",
        found: format!(
            "E* of the line is off by {} % of that of the tests, the energy by {} %: test 3 alone matches. A line fitted to the three is \
             {:.2} + {:.1} C, off by {} %",
            joined(off.iter().copied(), 1),
            joined(energy, 1),
            line.onset,
            line.slope,
            joined(residuals, 1)
        ),
        // "To match" is interpreted as within five percent.
        standing: Standing::conditional(off.last().is_some_and(|off| off.abs() < 5.0), largest(off.iter().map(|off| off.abs())) < 5.0),
        expected: Standing::HoldsConditionally,
    }
}

/// A slope and depths that round to those of the data and reproduce every energy of Table B2 to its last digit.
const UNROUNDED_SLOPE: f64 = 162.815;
const UNROUNDED_DEPTHS: [f64; 3] = [0.10621, 0.520_335, 1.076_774];

fn rounding_explains_the_bounds(cells: &Cells<'_>, crabbed: &Crabbed<'_>) -> Result<Statement, DataError> {
    let (mut geometry, mut series) = (crabbed.geometry.clone(), crabbed.series.clone());
    let mut most = (geometry.crush.slope - UNROUNDED_SLOPE).abs() / 0.05;
    geometry.crush.slope = UNROUNDED_SLOPE;
    for (test, depth) in series.tests.iter_mut().zip(UNROUNDED_DEPTHS) {
        // Printed to 0.0001 ft.
        most = largest([most, (test.depth - depth).abs() / 0.000_05]);
        test.depth = depth;
    }
    let found = Reconstructions::of(&geometry, &series, Wall::Papers)?;
    let (mut agreeing, mut off) = (0, Vec::new());
    for (which, restitution) in (0..series.tests.len()).flat_map(|which| Restitution::BOTH.map(|restitution| (which, restitution))) {
        let row = series.tests[which].label(restitution);
        for (_, column, _, value) in columns(&geometry, &series.tests[which], found.get(which, restitution)) {
            // CRASH3's correction uses a rounded angle.
            let of_crush = column == "E*" || column == "crash3_T_Ln" || column.starts_with("planar_T");
            match find(cells.table_b2, &row, column).filter(|_| of_crush) {
                Some(cell) if cell.printed.agrees_with(value) => agreeing += 1,
                Some(_) => off.push(format!("{row}, {column}")),
                None => (),
            }
        }
    }
    Ok(Statement {
        name: "rounding explains the bounds of Table B2",
        place: "this crate",
        says: "rounding of C_avg and d1, and the paper's heavy barrier, are enough to explain the bounds of E*, T_Ln, T_Lt and T_L",
        found: format!(
            "with d1 = {UNROUNDED_SLOPE} and C_avg of {} ft, within half a unit of their digits, {agreeing} cells agree to the last digit; others: {}",
            joined(UNROUNDED_DEPTHS, 6),
            if off.is_empty() { "none".to_owned() } else { off.join("; ") }
        ),
        standing: Standing::of(most <= 1.0 && agreeing == 21 && off.is_empty()),
        expected: Standing::Holds,
    })
}

fn crash3_takes_a_rounded_angle(cells: &Cells<'_>) -> Statement {
    let rows: Vec<&Computed> = cells.table_b2.iter().filter(|cell| cell.column == "crash3_T_Lt").collect();
    let tangential = |row: &str, alpha: f64| printed(cells.table_b2, row, "crash3_T_Ln") * libm::tan(alpha.to_radians()).squared();
    let angle = value(cells.table_b1, "1 0.00", "pdof");
    let agrees = |alpha| rows.iter().filter(|cell| cell.printed.agrees_with(tangential(&cell.row, alpha))).count();
    Statement {
        name: "CRASH3's correction takes a rounded angle",
        place: "this crate",
        says: "T_Lt of CRASH3 in Table B2 is tan² of the 15.3° of Table B1 times T_Ln, both as rounded",
        found: format!("so in all {}, to the last digit; with the unrounded {angle:.3}° in {}", agrees(15.3), agrees(angle)),
        standing: Standing::of(rows.len() == 3 && agrees(15.3) == 3 && agrees(angle) == 0),
        expected: Standing::Holds,
    }
}

fn crash3_velocity_change(cells: &Cells<'_>, crabbed: &Crabbed<'_>) -> Statement {
    let found = tests(crabbed, Restitution::None);
    let all = |of: fn(&Reconstruction) -> f64| found.iter().map(|(_, found)| of(found)).collect::<Vec<_>>();
    let columns = [("crash3_dv_ftps", 1.0), ("crash3_dv_mph", MPH)];
    let cells = found.iter().zip(0..).flat_map(|((test, _), which)| {
        let row = test.label(Restitution::None);
        columns.map(|(column, unit)| (which, unit, find(cells.table_b2, &row, column)))
    });
    let cells: Vec<(usize, f64, Option<&Computed>)> = cells.collect();
    let agreeing = |speeds: &[f64]| {
        cells.iter().filter(|(which, unit, cell)| cell.is_some_and(|cell| cell.printed.agrees_with(speeds[*which] * unit))).count()
    };
    let (alone, algorithm) = (all(|found| found.crash3.delta_v), all(|found| found.crash3.algorithm_delta_v));
    let corrected = all(|found| found.crash3.algorithm_delta_v / found.crash3.effective_mass_factor.sqrt());
    let planar = all(|found| found.planar.one.delta_v_magnitude());
    let apart = largest(corrected.iter().zip(&planar).map(|(corrected, planar)| (corrected / planar - 1.0).abs()));
    Statement {
        name: "CRASH3's velocity changes are corrected",
        place: PLACE,
        says: "crush energy and ΔV of CRASH3 are corrected for tangential effects",
        found: format!(
            "the energies are. All {} ΔV in ft/s and mph are those of T_Ln alone. The algorithm, with correction and effective mass, has {} ft/s, and {} of \
             the {0} round to that; with the correction and the whole mass it is {}, with {}, the same as planar impact mechanics at e = 0 to {apart:.0e}. \
             1 + tan²α happens to be almost 1/γ: {:.4} and {:.4}",
            agreeing(&alone),
            joined(algorithm.iter().copied(), 2),
            agreeing(&algorithm),
            joined(corrected.iter().copied(), 2),
            agreeing(&corrected),
            largest(all(|found| found.crash3.total / found.crash3.normal)),
            largest(all(|found| 1.0 / found.crash3.effective_mass_factor)),
        ),
        standing: Standing::of(agreeing(&alone) < 6 && agreeing(&algorithm).max(agreeing(&corrected)) == 6),
        expected: Standing::Fails,
    }
}

/// Returns the computed errors of CRASH3 and planar impact mechanics for a number of Table 5, in its unit.
fn off(cells: &Cells<'_>, test: &str, measured: f64, quantity: &str) -> [f64; 2] {
    ["crash3", "planar"].map(|model| value(cells.table_5, test, &format!("{model}_{quantity}")) - measured)
}

fn closer(test: &CrabbedTest, cells: &Cells<'_>) -> [[f64; 2]; 3] {
    let energy = off(cells, &test.name, value(cells.table_5, &test.name, "test_energy"), "energy");
    let speed = off(cells, &test.name, value(cells.table_5, &test.name, "test_EES"), "dv");
    [energy, speed, off(cells, &test.name, test.delta_v_mph, "dv")]
}

fn planar_is_closer(cells: &Cells<'_>, crabbed: &Crabbed<'_>) -> Statement {
    let tests: Vec<_> = crabbed.series.tests.iter().take(2).map(|test| closer(test, cells)).collect();
    let holds = tests.len() == 2 && tests.iter().flatten().all(|[crash3, planar]| planar.abs() < crash3.abs());
    let normal = crabbed.series.tests.iter().take(2).map(|test| {
        let row = test.label(Restitution::None);
        (value(cells.table_b2, &row, "crash3_T_Ln") / value(cells.table_5, &test.name, "test_energy") - 1.0) * 100.0
    });
    Statement {
        name: "planar impact mechanics is closer in tests 1 and 2",
        place: "after Table 6",
        says: "for tests 1 and 2 crush energy and ΔV of planar impact mechanics agree better with the measured values",
        found: format!(
            "so as the table compares them, T_L with the E_C of the test, also against the measured ΔV. But E_C is normal energy alone: like with like, \
             both models have the same crush energy, off by {} %",
            joined(normal, 1)
        ),
        // The condition: a loss including its tangential part is compared with an energy without it.
        standing: Standing::conditional(holds, false),
        expected: Standing::HoldsConditionally,
    }
}

fn crash3_is_closer(cells: &Cells<'_>, crabbed: &Crabbed<'_>) -> Statement {
    let third = crabbed.series.tests.get(2).map_or([[f64::NAN; 2]; 3], |test| closer(test, cells));
    let [energy, speed, delta_v] = third;
    Statement {
        name: "CRASH3 is closer in test 3",
        place: "after Table 6",
        says: "for test 3 CRASH3 gives crush energy and ΔV closer to the measured values",
        found: format!(
            "CRASH3 is off by {:.0} ft lb and {:.2} mph, planar impact mechanics by {:.0} and {:.2}; against the measured ΔV by {:.1} and {:.1} mph",
            energy[0], speed[0], energy[1], speed[1], delta_v[0], delta_v[1]
        ),
        standing: Standing::of(third.iter().all(|[crash3, planar]| crash3.abs() < planar.abs())),
        expected: Standing::Holds,
    }
}
