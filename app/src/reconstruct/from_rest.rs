//! Converts rest positions into evidence of the separation velocities.

use planar_impact::post_impact::{Separation, SeparationEvidence};
use planar_impact::reconstruct::{Correlation, Measurand, by_chi_square};
use planar_impact::{Motion, Output, Side, Xy};
use schemars::JsonSchema;
use serde::Serialize;

use crate::case::{Case, Known, vehicle_number};
use crate::issue::{Issue, Issues};
use crate::message::Message;
use crate::named::positive_zero;
use crate::notice::{Notice, Notices};
use crate::slide::PointFit;
use crate::units::Measure;
use crate::wording::{self, degrees_of_freedom};

/// The separations of both vehicles, as far as rest positions give them.
pub type Separations = [Option<Separation>; 2];

/// Probability of a χ² below which pose and points contradict each other.
pub(super) const BY_CHANCE: f64 = 0.001;
/// Maximum number of combinations of separations that are reconstructed.
const MOST_COMBINATIONS: usize = 8;

/// A case whose rest positions have been converted into evidence.
pub struct FromRest {
    /// The case, with the separation velocities among its evidence.
    pub case: Case,
    /// Correlations of their errors.
    pub correlations: Vec<Correlation>,
    /// Whether vehicle 1 or vehicle 2 slid to rest on locked wheels, so that the errors of its separation are those of its way.
    pub by_way: [bool; 2],
}

/// The separation of a vehicle, from where it came to rest.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct SeparationFromRest {
    /// The number of the vehicle, 1 or 2.
    pub vehicle: usize,
    /// Its velocity at separation along x and y, in m/s.
    pub velocity: [f64; 2],
    /// Its yaw rate at separation, in rad/s.
    pub yaw_rate: f64,
    /// Standard deviations of both components of the velocity and of the yaw rate.
    pub sd: [f64; 3],
    /// How the slide fits the evidence; `null` for the closed form.
    pub fit: Option<SlideFit>,
}

/// How a slide fits the rest position, and the points along its path.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct SlideFit {
    /// Computed less given position at rest, along x and y, in m.
    pub position: [f64; 2],
    /// Computed less given heading at rest, in rad.
    pub heading: f64,
    /// Points along the path, in the order of the file.
    pub points: Vec<PointFit>,
    /// The sum of the squares of what pose and points are missed by, in standard deviations.
    pub chi_square: f64,
    /// The number of points.
    pub degrees_of_freedom: usize,
    /// Probability that chi-square is larger by chance; 1 without points.
    pub probability: f64,
}

impl FromRest {
    /// Converts a case, with or without `[rest]`, with the separations that are used.
    ///
    /// # Errors
    ///
    /// Returns the reason if a rest position does not determine a separation.
    pub fn of(case: &Case, separations: &Separations) -> Result<Self, Issues> {
        let mut case = case.clone();
        let unfit: Vec<Issue> = (0..2).filter_map(|i| unfit(&case, i, separations[i].as_ref()?)).collect();
        if !unfit.is_empty() {
            return Err(case.unfit(unfit));
        }
        let by_way = Side::ALL.map(|side| {
            let rest = case.rest.as_ref().and_then(|rest| rest.vehicles[side as usize].as_ref());
            separations[side as usize].is_some() && rest.is_some_and(|rest| rest.slide.vehicle.is_locked())
        });
        // From here on it is treated as any other evidence.
        case.rest = None;
        let SeparationEvidence { mut evidence, mut correlations } = SeparationEvidence::of(separations.each_ref().map(Option::as_ref));
        if !case.model.is_angular() {
            let spins = |of: Measurand| matches!(of, Measurand::Output(Output::YawRate(_)));
            evidence.retain(|piece| !spins(piece.of));
            correlations.retain(|pair| !spins(pair.one) && !spins(pair.other));
        }
        for piece in evidence {
            let key = piece.of.side().map_or_else(|| "rest".to_owned(), key);
            case.knowledge.evidence.push(Known {
                of: piece.of,
                key,
                value: piece.value,
                uncertainty: piece.uncertainty,
                is_from_crush: false,
            });
        }
        for ((side, separation), is_by_way) in Side::ALL.into_iter().zip(separations).zip(by_way) {
            let Some(separation) = separation else { continue };
            let number = vehicle_number(side);
            let message = format!("vehicle.{number}: its separation velocity and yaw rate are reconstructed from its rest position");
            case.notices.0.push(Notice::note("separation-from-rest", key(side), message));
            case.notices.0.extend(of_short_slide(side, separation, is_by_way));
            if let Some(fit) = separation.fit.as_ref().filter(|fit| fit.probability < BY_CHANCE) {
                let message = Message::from(format!(
                    "vehicle.{number}: no slide comes past its points and ends in its rest position: at best chi-square is {:.1} with {}",
                    fit.chi_square,
                    degrees_of_freedom(fit.degrees_of_freedom)
                ));
                case.notices.0.push(Notice::warning("points-contradict-rest", format!("{}.points", key(side)), message));
            }
        }
        Ok(FromRest { case, correlations, by_way })
    }
}

/// Returns the speed of a separation, and the deviation of its velocity.
pub(super) fn speed_of(separation: &Separation) -> [f64; 2] {
    let [x, y, _] = separation.covariance.deviations();
    [separation.motion.velocity.length(), libm::hypot(x, y)]
}

/// Returns `true` if two motions differ by no more than a share of standard deviations.
pub(super) fn are_near([one, other]: [Motion; 2], sds: [f64; 3], share: f64) -> bool {
    one.components().into_iter().zip(other.components()).zip(sds).all(|((one, other), sd)| (one - other).abs() <= share * sd)
}

/// Returns a warning of a separation that is too uncertain: a slide that is not much longer than the uncertainty of the rest position determines neither its speed,
/// which grows with the root of the way, nor its direction.
fn of_short_slide(side: Side, separation: &Separation, is_by_way: bool) -> Option<Notice> {
    /// Share of the speed up to which intervals of 95 % contain the truth in about as many cases: to first order, and by the way on locked wheels.
    const STRAIGHT: f64 = 0.25;
    const BY_WAY: f64 = 0.8;
    let [speed, sd] = speed_of(separation);
    let message = || {
        Message::from(format!("vehicle.{}: its separation speed of ", vehicle_number(side)))
            .figure(Measure::RoadSpeed, speed)
            .text(" is uncertain by ")
            .figure(Measure::RoadSpeed, sd)
            .text(if is_by_way { ", of a way to rest that is hardly longer than its uncertainty" } else { ", and is taken to first order" })
            .text(": intervals may be too narrow, and evidence that agrees may seem to contradict itself; measure the rest position better, or leave it out")
    };
    (sd > if is_by_way { BY_WAY } else { STRAIGHT } * speed).then(|| Notice::warning("slide-short", key(side), message()))
}

/// Returns every combination of the separations that lead to the same rest positions, the one that fits best first, and a notice if they are too many.
pub fn combinations(separations: &Separations) -> (Vec<Separations>, Notices) {
    let mut notices = Notices::default();
    let choices = separations.each_ref().map(|separation| -> Vec<Option<Separation>> {
        let Some(best) = separation else { return vec![None] };
        let mut alone = best.clone();
        let others = alone.fit.as_mut().map(|fit| std::mem::take(&mut fit.others)).unwrap_or_default();
        // One without deviations cannot be weighed.
        std::iter::once(alone).chain(others.into_iter().filter(Separation::has_deviations)).map(Some).collect()
    });
    for (side, choices) in Side::ALL.into_iter().zip(&choices) {
        let others = choices.len() - 1;
        if others > 0 {
            let them = if others == 1 { "one other motion leads".to_owned() } else { format!("{others} other motions lead") };
            let message = format!("vehicle.{}: {them} to the same rest position; each is reconstructed", vehicle_number(side));
            notices.0.push(Notice::warning("other-separations", key(side), message));
        }
    }
    let [one, two] = &choices;
    let mut all: Vec<Separations> = one.iter().flat_map(|one| two.iter().map(|two| [one.clone(), two.clone()])).collect();
    all.sort_by(|a, b| by_chi_square(chi_square(a), chi_square(b)));
    if all.len() > MOST_COMBINATIONS {
        let message = format!(
            "{} combinations of separations lead to these rest positions: the {MOST_COMBINATIONS} that fit best are reconstructed",
            all.len()
        );
        notices.0.push(Notice::warning("many-separations", "rest", message));
        all.truncate(MOST_COMBINATIONS);
    }
    (all, notices)
}

/// Returns the sum of the squares of what slides miss, in standard deviations.
fn chi_square(separations: &Separations) -> f64 {
    let of_fit = |separation: &Separation| separation.fit.as_ref().map_or(0.0, |fit| fit.chi_square);
    separations.iter().flatten().map(of_fit).sum()
}

impl SeparationFromRest {
    /// Returns the separations that are used, with their fits.
    pub fn of(case: &Case, separations: &Separations) -> Vec<Self> {
        let pair = |v: Xy| [v.x, v.y].map(positive_zero);
        let of_vehicle = |side: Side| {
            let Separation { motion: Motion { velocity, yaw_rate }, covariance, fit, .. } = separations[side as usize].as_ref()?;
            let given = case.rest.as_ref()?.vehicles[side as usize].as_ref()?.evidence.as_ref()?;
            let fit = fit.as_ref().map(|fit| SlideFit {
                position: pair(fit.miss.position),
                heading: positive_zero(fit.miss.heading),
                points: given.points.iter().zip(&fit.points).map(|(point, place)| PointFit::of(point, place)).collect(),
                chi_square: fit.chi_square,
                degrees_of_freedom: fit.degrees_of_freedom,
                probability: fit.probability,
            });
            Some(SeparationFromRest {
                vehicle: vehicle_number(side),
                velocity: pair(*velocity),
                yaw_rate: positive_zero(*yaw_rate),
                sd: covariance.deviations(),
                fit,
            })
        };
        Side::ALL.into_iter().filter_map(of_vehicle).collect()
    }

    /// Returns the sum of the squares of what its slide misses, in standard deviations.
    pub fn chi_square(&self) -> f64 {
        self.fit.as_ref().map_or(0.0, |fit| fit.chi_square)
    }

    /// Returns `true` if its rest position and the points contradict each other.
    pub fn is_contradicted(&self) -> bool {
        self.fit.as_ref().is_some_and(|fit| fit.probability < BY_CHANCE)
    }
}

/// Returns the components of a separation, as evidence.
pub(super) fn outputs(side: Side) -> [Measurand; 3] {
    Output::motion_after(side).map(Measurand::Output)
}

pub(super) fn key(side: Side) -> String {
    format!("rest.vehicle.{}", vehicle_number(side))
}

/// Returns an issue if a separation cannot be evidence: if it has no standard deviation, or if its slide does not end at the rest position.
fn unfit(case: &Case, i: usize, separation: &Separation) -> Option<Issue> {
    let path = format!("rest.vehicle.{}", i + 1);
    if !separation.has_deviations() {
        let message = "the rest position does not determine the uncertainty of the separation";
        return Some(Issue::at("no-separation", path, message).with_help("give the separation velocity as evidence instead"));
    }
    let given = case.rest.as_ref()?.vehicles[i].as_ref().and_then(|rest| rest.evidence.as_ref())?;
    let miss = separation.miss_beyond(given)?;
    let message = Message::from("the slide that ends nearest misses the rest position by ")
        .figure(Measure::Length, miss.position.length())
        .text(" and ")
        .figure(Measure::Angle, miss.heading.abs())
        .text(", more than its standard deviations");
    Some(Issue::at("no-separation", path, message).with_help(wording::NO_SLIDE_FOUND))
}

#[cfg(test)]
mod tests {
    use super::*;
    use planar_impact::post_impact::{Miss, MotionCovariance, SlideFit};

    fn separation(chi_square: f64, others: Vec<Separation>) -> Separation {
        let miss = Miss { position: Xy::zero(), heading: 0.0 };
        let (points, probability) = (Vec::new(), 1.0);
        let fit = SlideFit { iterations: 1, starts: 1, converged: 1, miss, points, chi_square, degrees_of_freedom: 1, probability, others };
        let covariance = MotionCovariance([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
        Separation { motion: Motion::rest(), covariance, by_friction: Motion::rest(), fit: Some(fit) }
    }

    /// By hand: three separations each, with these sums of chi-square.
    #[test]
    fn combinations_begin_with_the_best_and_end_at_the_eighth() {
        let alone = |chi_square| separation(chi_square, Vec::new());
        let one = separation(1.0, vec![alone(3.0), alone(7.0)]);
        let two = separation(0.5, vec![alone(1.0), alone(20.0)]);
        let (all, notices) = combinations(&[Some(one.clone()), Some(two)]);
        assert_eq!(all.iter().map(chi_square).collect::<Vec<_>>(), [1.5, 2.0, 3.5, 4.0, 7.5, 8.0, 21.0, 23.0]);
        let codes: Vec<_> = notices.0.iter().map(|notice| notice.code).collect();
        assert_eq!(codes, ["other-separations", "other-separations", "many-separations"]);
        let said = notices.0[2].message.to_string();
        assert_eq!(said, "9 combinations of separations lead to these rest positions: the 8 that fit best are reconstructed");
        // Of exact fits the one that was found first stays first, whatever its last bits are.
        let exact = separation(6e-20, vec![alone(2e-22), alone(0.0)]);
        assert_eq!(combinations(&[Some(exact), None]).0.iter().map(chi_square).collect::<Vec<_>>(), [6e-20, 2e-22, 0.0]);
        // What has no deviations cannot be weighed, and a vehicle without a rest position has one choice.
        let mut unknown = alone(0.1);
        unknown.covariance.0[0][0] = f64::INFINITY;
        let (all, notices) = combinations(&[None, Some(separation(0.5, vec![unknown]))]);
        assert!(all.len() == 1 && all[0][0].is_none() && notices.0.is_empty());
        assert!(all[0][1].as_ref().and_then(|two| two.fit.as_ref()).is_some_and(|fit| fit.others.is_empty()));
    }
}
