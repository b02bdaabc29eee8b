//! Where vehicles came to rest as evidence of how they separated.

use planar_impact::reconstruct::{Correlation, Measurable, Uncertainty};
use planar_impact::rest::Separation;
use planar_impact::{Output, Side};

use crate::case::{Case, Known};
use crate::exit::Failure;

/// The case with what the vehicles' rest says of their separation among the evidence, and how its errors go together.
///
/// # Errors
///
/// Why it says nothing.
pub fn with_rest(case: &Case) -> Result<(Case, Vec<Correlation>), Failure> {
    let (mut case, separations) = (case.clone(), case.separations_from_rest()?);
    // From here on it is evidence as any other.
    case.rest = None;
    let mut all = Vec::new();
    for (side, separation) in [Side::One, Side::Two].into_iter().zip(&separations) {
        let Some(Separation { motion, covariance, fit, .. }) = separation else { continue };
        let of = motion_of(side);
        let values = [motion.velocity.x, motion.velocity.y, motion.yaw_rate];
        let key = format!("rest.vehicle.{}", side as usize + 1);
        for ((of, value), sd) in of.into_iter().zip(values).zip(covariance.deviations()) {
            let uncertainty = if sd > 0.0 { Uncertainty::StandardDeviation(sd) } else { Uncertainty::Exact };
            case.knowledge.evidence.push(Known { of, key: key.clone(), value, uncertainty });
        }
        for (one, other) in [(0, 1), (0, 2), (1, 2)] {
            let coefficient = covariance.correlation(one, other);
            if coefficient != 0.0 {
                all.push(Correlation { one: of[one], other: of[other], coefficient });
            }
        }
        let number = side as usize + 1;
        case.notes.push(format!(
            "vehicle.{number}: its separation velocity and yaw rate are those from which it comes to rest where [rest] says"
        ));
        let others = fit.as_ref().map_or(0, |fit| fit.others.len());
        if others > 0 {
            let them = if others == 1 { "one other motion leads".to_owned() } else { format!("{others} other motions lead") };
            case.notes.push(format!(
                "vehicle.{number}: {them} to the same rest; the first found is taken, and turning the other way is worth a look"
            ));
        }
    }
    if let [Some(one), Some(two)] = &separations {
        all.extend(by_friction(one, two));
    }
    Ok((case, all))
}

fn motion_of(side: Side) -> [Measurable; 3] {
    [Output::VelocityX(side), Output::VelocityY(side), Output::YawRate(side)].map(Measurable::Output)
}

/// Both vehicles slid on the same ground: where it holds better than it was taken to, both were faster.
fn by_friction(one: &Separation, two: &Separation) -> Vec<Correlation> {
    let each = |i: usize, k: usize| Correlation {
        one: motion_of(Side::One)[i],
        other: motion_of(Side::Two)[k],
        coefficient: one.correlation_by_friction(i, two, k),
    };
    let all = (0..3).flat_map(|i| (0..3).map(move |k| each(i, k)));
    all.filter(|correlation| correlation.coefficient != 0.0).collect()
}
