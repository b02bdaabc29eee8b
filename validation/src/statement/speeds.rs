//! Statements of Table 1 and its text about speeds, units and losses.

use super::{Standing, Statement, largest};
use crate::account::Computed;
use crate::data::DataError;
use crate::geometry::{Geometry, Perpendicular, Position, solve};
use planar_impact::{Impact, ImpulseRatio, Nt};

const PLACE: &str = "after Table 1";
const SPEEDS: [(f64, f64); 3] = [(-40.0, 40.0), (-20.0, 40.0), (-40.0, 20.0)];
const RESTITUTIONS: [f64; 3] = [0.0, 0.15, 0.3];

pub(super) fn statements(geometry: &Geometry, cells: &[Computed]) -> Result<Vec<Statement>, DataError> {
    Ok(vec![
        speeds_are_in_feet(geometry, cells)?,
        weights_are_rounded(geometry)?,
        each_speed_has_its_work(geometry)?,
        no_tangential_work_on_a_vehicle_at_rest(geometry)?,
        loss_is_greatest_at_common_velocity(geometry),
    ])
}

fn impact(geometry: &Geometry, position: Position, (v_1x, v_2y): (f64, f64), restitution: f64) -> Result<Impact, DataError> {
    let case = Perpendicular { position, v_1x, v_2y, gamma_degrees: 0.0, restitution };
    solve(&geometry.perpendicular(case), &format!("{} {v_1x} {v_2y} {restitution}", position.letter()))
}

fn speeds_are_in_feet(geometry: &Geometry, cells: &[Computed]) -> Result<Statement, DataError> {
    let cell = cells.iter().find(|cell| cell.row == "B -40 40 0.00" && cell.column == "W_n");
    let printed = cell.map_or(f64::NAN, |cell| cell.printed.value());
    let (feet, miles) = (40.0, 40.0 * 22.0 / 15.0);
    let in_feet = impact(geometry, Position::B, (-feet, feet), 0.0)?.work.n / printed;
    let in_miles = impact(geometry, Position::B, (-miles, miles), 0.0)?.work.n / printed;
    Ok(Statement {
        name: "speeds are in mph",
        place: "Tables 1 and 2, headings",
        says: "v_1x and v_2y are in mph, W_n and W_t in ft lb",
        found: format!(
            "the speeds are in ft/s: W_n of position B at e = 0 is {in_feet:.5} of the printed one with 40 ft/s, and {in_miles:.4} of it with 40 mph"
        ),
        standing: if (in_feet - 1.0).abs() < 1e-4 { Standing::Fails } else { Standing::of((in_miles - 1.0).abs() < 1e-4) },
        expected: Standing::Fails,
    })
}

fn weights_are_rounded(geometry: &Geometry) -> Result<Statement, DataError> {
    // W_n of position B at e = 0 is −½ m̄ v², with m̄ the reduced mass.
    let reduced = |[one, two]: [f64; 2]| one * two / (one + two);
    let work = impact(geometry, Position::B, SPEEDS[0], 0.0)?.work.n;
    let heavier = work * reduced(geometry.weights().map(|weight| weight + 0.5)) / reduced(geometry.weights());
    let shift = (heavier - work).abs();
    Ok(Statement {
        name: "rounding of weights",
        place: "this crate",
        says: "rounding of the printed weights to a pound is enough to explain the bound of W_n in position B",
        found: format!("half a pound on both weights moves it by {shift:.1} ft lb"),
        standing: Standing::of(shift > 1.1),
        expected: Standing::Holds,
    })
}

fn each_speed_has_its_work(geometry: &Geometry) -> Result<Statement, DataError> {
    let (mut direct, mut across) = (Vec::new(), Vec::new());
    for position in Position::ALL {
        for restitution in RESTITUTIONS {
            let [both, slow_one, slow_two] = [0, 1, 2].map(|which| impact(geometry, position, SPEEDS[which], restitution));
            let [both, slow_one, slow_two] = [both?.work, slow_one?.work, slow_two?.work];
            direct.extend([both.n / slow_one.n - 1.0, both.t / slow_two.t - 1.0]);
            across.extend([(both.t / slow_one.t - 1.0).abs(), (both.n / slow_two.n - 1.0).abs()]);
        }
    }
    let (least, most) = (-largest(direct.iter().map(|change| -change)), largest(across));
    Ok(Statement {
        name: "each speed has its work",
        place: PLACE,
        says: "a greater speed of vehicle 1 increases W_n with little or no change in W_t, one of vehicle 2 increases W_t with little or no change in W_n",
        found: format!(
            "doubling a speed increases its work by at least {:.0} %, and changes the other by at most {:.1} %",
            least * 100.0,
            most * 100.0
        ),
        // "Little" is interpreted as less than a tenth of the smallest increase.
        standing: Standing::of(least > 0.0 && most < 0.1 * least),
        expected: Standing::Holds,
    })
}

fn no_tangential_work_on_a_vehicle_at_rest(geometry: &Geometry) -> Result<Statement, DataError> {
    let mut shares = Vec::new();
    for position in Position::ALL {
        for hundredths in 0..=100 {
            let impact = impact(geometry, position, (-40.0, 0.0), f64::from(hundredths) / 100.0)?;
            shares.push((impact.work.t / impact.kinetic_energy.before).abs());
        }
    }
    let (tried, most) = (shares.len(), largest(shares));
    Ok(Statement {
        name: "no tangential work on a vehicle at rest",
        place: PLACE,
        says: "with v_2 = 0, Γ = 0 and v_1 = -40 the tangential impulse does no work in any position, whatever e",
        found: format!("of the kinetic energy, W_t is at most {most:.0e} in {tried} collisions with e from 0 to 1"),
        standing: Standing::of(most < 1e-12),
        expected: Standing::Holds,
    })
}

fn loss_is_greatest_at_common_velocity(geometry: &Geometry) -> Statement {
    let (mut most, mut tried) = (Vec::new(), 0);
    for position in Position::ALL {
        for (v_1x, v_2y) in SPEEDS {
            let case = Perpendicular { position, v_1x, v_2y, gamma_degrees: 0.0, restitution: 0.0 };
            let common = geometry.perpendicular(case);
            let peak = common.evaluate().loss();
            let critical = common.evaluate().critical_impulse_ratio();
            let contact = common.contact();
            // Every restitution, and every ratio up to twice the critical one at e = 0, possible or not.
            for (restitution, ratio) in (0..=20).flat_map(|e| (-40..=40).map(move |share| (f64::from(e) / 20.0, f64::from(share) / 20.0))) {
                if restitution == 0.0 && ratio == 1.0 {
                    continue;
                }
                let impulse: Nt = ImpulseRatio::Given(ratio * critical)
                    .impulse(&contact.compliance, Nt { n: (1.0 + restitution) * contact.approach.n, t: contact.approach.t });
                most.push(contact.loss(impulse) / peak);
                tried += 1;
            }
        }
    }
    let most = largest(most);
    Statement {
        name: "loss is greatest at common velocity",
        place: "before the example",
        says: "under the common velocity conditions, e = 0 and μ = μ0, the energy loss is a maximum",
        found: format!("the largest of {tried} others, with e from 0 to 1 and μ from -2 to 2 times that μ0, is {most:.5} of it"),
        standing: Standing::of(most < 1.0),
        expected: Standing::Holds,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::Texts;

    #[test]
    fn rounding_of_the_weights_is_what_the_library_says_it_is() {
        let geometry = Geometry::read(Texts::embedded().geometry).expect("embedded");
        let heavier = geometry.with_weights([2564.5, 6345.5]);
        let work = |geometry: &Geometry| impact(geometry, Position::B, (-40.0, 40.0), 0.0).expect("possible").work.n;
        let shift = (work(&heavier) - work(&geometry)).abs();
        let found = weights_are_rounded(&geometry).expect("possible").found;
        // Half a pound of 2564 lb and of 6345 lb, weighted by the effect of each on the reduced mass: 1.6e-4 of 45 370 ft lb.
        assert!((shift - 7.3).abs() < 0.1, "{shift}");
        assert!(found.contains(&format!("{shift:.1}")), "{found}");
    }

    #[test]
    fn miles_would_show() {
        let texts = Texts::embedded();
        let geometry = Geometry::read(texts.geometry).expect("embedded");
        let cells = crate::perpendicular::table_1(&geometry, texts.table_1).expect("embedded").computed;
        let statement = speeds_are_in_feet(&geometry, &cells).expect("possible");
        // (22/15)² = 2.1511
        assert!(statement.found.contains("2.151"), "{}", statement.found);
        // If the works were printed for mph, the statement would hold: 45369.6 × 2.15111 = 97595.1.
        let cells = crate::perpendicular::table_1(&geometry, &texts.table_1.replace("-45369.6", "-97595.1")).expect("digits").computed;
        assert_eq!(speeds_are_in_feet(&geometry, &cells).map(|statement| statement.standing), Ok(Standing::Holds));
    }
}
