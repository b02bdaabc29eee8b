//! Where vehicles came to rest as evidence of how they separated.

use planar_impact::reconstruct::{Correlation, Measurable, Uncertainty};
use planar_impact::rest::Separation;
use planar_impact::{Output, Side};

use crate::case::{Case, Known};
use crate::exit::Failure;

/// What the rest of the vehicles says.
pub struct FromRest {
    /// The case with how they separated among the evidence.
    pub case: Case,
    /// How the errors of that go together.
    pub correlations: Vec<Correlation>,
    /// Whether a vehicle could have separated in several ways and come to the same rest.
    pub has_others: bool,
}

/// The case with what the vehicles' rest says of their separation among the evidence, and how its errors go together.
///
/// # Errors
///
/// Why it says nothing.
pub fn with_rest(case: &Case) -> Result<FromRest, Failure> {
    let (mut case, separations) = (case.clone(), case.separations_from_rest()?);
    let unfit = unfit(&case, &separations);
    if !unfit.is_empty() {
        return Err(case.unfit(unfit));
    }
    let mut has_others = false;
    // From here on it is evidence as any other.
    case.rest = None;
    let mut all = Vec::new();
    for (side, separation) in [Side::One, Side::Two].into_iter().zip(&separations) {
        let Some(Separation { motion, covariance, fit, .. }) = separation else { continue };
        let of = motion_of(side);
        let values = [motion.velocity.x, motion.velocity.y, motion.yaw_rate];
        let key = format!("rest.vehicle.{}", side as usize + 1);
        for ((of, value), sd) in of.into_iter().zip(values).zip(covariance.deviations()) {
            // None of them can be exact: a pose at rest never is.
            let uncertainty = Uncertainty::StandardDeviation(sd);
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
            has_others = true;
            let them = if others == 1 { "one other motion leads".to_owned() } else { format!("{others} other motions lead") };
            case.notes.push(format!(
                "vehicle.{number}: {them} to the same rest; what stands here is of the one nearest to the closed form, and not the answer alone"
            ));
        }
    }
    if let [Some(one), Some(two)] = &separations {
        all.extend(by_friction(one, two));
    }
    Ok(FromRest { case, correlations: all, has_others })
}

/// Separations that cannot be evidence: without a standard deviation that is a number, or whose slide does not end at the rest.
fn unfit(case: &Case, separations: &[Option<Separation>; 2]) -> Vec<(String, String, Option<String>)> {
    let deviations = |i: usize| case.rest.as_ref()?.vehicles[i].as_ref().map(|rest| rest.evidence);
    let why = |i: usize| {
        let separation = separations[i].as_ref()?;
        let key = format!("rest.vehicle.{}", i + 1);
        if !separation.covariance.deviations().iter().all(|sd| sd.is_finite() && *sd > 0.0) {
            let help = "give the separation velocity as evidence instead".to_owned();
            return Some((key, "the rest does not say how well the separation is known".to_owned(), Some(help)));
        }
        let (miss, given) = (separation.fit.as_ref()?.miss, deviations(i)?);
        let within = miss.position.x.abs() <= given.position_deviation.x
            && miss.position.y.abs() <= given.position_deviation.y
            && miss.heading.abs() <= given.heading_deviation;
        if miss.is_nothing() || within {
            return None;
        }
        let why = format!(
            "the slide that ends nearest misses the rest by {:.3} m and {:.2} deg, more than its deviations",
            miss.position.length(),
            miss.heading.to_degrees().abs()
        );
        Some((key, why, Some("check the heading at rest, whole turns counted, and which wheels are locked".to_owned())))
    };
    (0..2).filter_map(why).collect()
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
