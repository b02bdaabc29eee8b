//! Statements of the paper about the impulses on the load cells, and of Table 3 about momentum.

use super::{Cells, Crabbed, Standing, Statement, joined, rounds_to};
use crate::account::value;
use crate::barrier::MPH;
use crate::comparison::JOULES;
use crate::series::{CrabbedTest, Restitution};

const PLACE: &str = "comparison with barrier tests";

pub(super) fn statements(cells: &Cells<'_>, crabbed: &Crabbed<'_>) -> Vec<Statement> {
    vec![speeds_of_the_tests(crabbed), critical_ratios(cells, crabbed), good_agreement(cells, crabbed), momentum(cells, crabbed)]
}

fn speeds_of_the_tests(crabbed: &Crabbed<'_>) -> Statement {
    let speeds: Vec<_> = crabbed.series.tests.iter().map(|test| test.speed.value() * MPH).collect();
    let holds = speeds.len() == 3 && speeds.iter().zip(["13.11", "23.12", "29.02"]).all(|(&speed, digits)| rounds_to(speed, digits));
    Statement {
        name: "speeds of the crabbed tests",
        place: "introduction",
        says: "the crabbed tests were carried out at 13.11, 23.12 and 29.02 mph",
        found: format!("the speeds of Table B1 are {} mph", joined(speeds, 3)),
        standing: Standing::of(holds),
        expected: Standing::Holds,
    }
}

/// Returns measured and computed ratio of each test.
fn ratios(cells: &Cells<'_>, crabbed: &Crabbed<'_>) -> Vec<(f64, f64)> {
    let both = |test: &CrabbedTest| {
        (value(&cells.table_3.computed, &test.name, "ratio"), value(cells.table_b1, &test.label(Restitution::Measured), "mu"))
    };
    crabbed.series.tests.iter().map(both).collect()
}

fn critical_ratios(cells: &Cells<'_>, crabbed: &Crabbed<'_>) -> Statement {
    let ratios = ratios(cells, crabbed);
    let stated = [("0.239", "0.232"), ("0.283", "0.243"), ("0.535", "0.245")];
    let holds = ratios.iter().zip(stated).all(|(ratio, digits)| rounds_to(ratio.0, digits.0) && rounds_to(ratio.1, digits.1));
    Statement {
        name: "critical ratios of the three tests",
        place: PLACE,
        says: "the test values of μ0 are 0.239, 0.283 and 0.535, the computed ones 0.232, 0.243 and 0.245",
        found: format!(
            "from the impulses {}, computed {}",
            joined(ratios.iter().map(|ratio| ratio.0), 4),
            joined(ratios.iter().map(|ratio| ratio.1), 4)
        ),
        standing: Standing::of(ratios.len() == 3 && holds),
        expected: Standing::Holds,
    }
}

fn good_agreement(cells: &Cells<'_>, crabbed: &Crabbed<'_>) -> Statement {
    let off: Vec<_> = ratios(cells, crabbed).iter().map(|(test, computed)| (computed / test - 1.0) * 100.0).collect();
    let within = |percent: f64| off.len() == 3 && off[..2].iter().all(|off| off.abs() < percent);
    Statement {
        name: "critical ratios agree well",
        place: "after Table 3",
        says: "the impulse ratios of tests 1 and 2 show good agreement, that of test 3 is dramatically higher than the computed one",
        found: format!("computed ratios are off by {} %", joined(off.iter().copied(), 1)),
        // "Good" is interpreted as better than ten percent.
        standing: Standing::conditional(off.len() == 3 && off[0].abs() < 10.0 && off[2] < -50.0, within(10.0)),
        expected: Standing::HoldsConditionally,
    }
}

fn momentum(cells: &Cells<'_>, crabbed: &Crabbed<'_>) -> Statement {
    // A pound-second in N s equals a foot-pound in J divided by a foot in m.
    let newton_seconds = JOULES / 0.3048;
    let shares = crabbed.series.tests.iter().map(|test| {
        let normal = value(&cells.table_3.computed, &test.name, "normal");
        let given = cells.table_3.given.iter().find(|given| given.row == test.name && given.column == "wing");
        let wing = given.map_or(f64::NAN, |given| given.printed.value());
        let approach = crabbed.geometry.crabbed_velocity(test.speed.value()).x;
        let mass = crabbed.geometry.barrier_mass * newton_seconds;
        (normal / (mass * approach), libm::hypot(normal, wing) / (mass * test.delta_v_mph / MPH))
    });
    let shares: Vec<_> = shares.collect();
    Statement {
        name: "the load cells measure the whole impulse",
        place: "this crate",
        says: "the impulses of Table 3 are the momentum that the car loses",
        found: format!(
            "they are {} of m times the measured ΔV, and the normal ones {} of m v_n, less than at e = 0: the load cells miss a growing part of the \
             impulse, in tests 1 and 2 as well. The paper says so of test 3",
            joined(shares.iter().map(|share| share.1), 2),
            joined(shares.iter().map(|share| share.0), 2)
        ),
        standing: Standing::of(shares.iter().all(|share| share.0 >= 1.0 && (share.1 - 1.0).abs() < 0.05)),
        expected: Standing::Fails,
    }
}
