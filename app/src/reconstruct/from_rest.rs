//! Converts rest positions into evidence of the separation velocities.

use planar_impact::post_impact::{Separation, SeparationEvidence};
use planar_impact::reconstruct::{Correlation, Measurand};
use planar_impact::{Output, Side};

use crate::case::{Case, Known, vehicle_number};
use crate::issue::{Issue, Issues};
use crate::message::Message;
use crate::notice::Notice;
use crate::units::Measure;

/// A case whose rest positions have been converted into evidence.
pub struct FromRest {
    /// The case, with the separation velocities among its evidence.
    pub case: Case,
    /// Correlations of their errors.
    pub correlations: Vec<Correlation>,
    /// `true` if a vehicle could have separated in several ways and come to the same rest position.
    pub has_others: bool,
}

impl FromRest {
    /// Converts a case, with or without `[rest]`.
    ///
    /// # Errors
    ///
    /// Returns the reason if a rest position does not determine a separation.
    pub fn of(case: &Case) -> Result<Self, Issues> {
        let (mut case, separations) = (case.clone(), case.separations_from_rest()?);
        let unfit: Vec<Issue> = (0..2).filter_map(|i| unfit(&case, i, separations[i].as_ref()?)).collect();
        if !unfit.is_empty() {
            return Err(case.unfit(unfit));
        }
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
        let mut has_others = false;
        for (side, separation) in [Side::One, Side::Two].into_iter().zip(&separations) {
            let Some(separation) = separation else { continue };
            let number = vehicle_number(side);
            let message = format!("vehicle.{number}: its separation velocity and yaw rate are reconstructed from its rest position");
            case.notices.0.push(Notice::note("separation-from-rest", key(side), message));
            let others = separation.fit.as_ref().map_or(0, |fit| fit.others.len());
            if others > 0 {
                has_others = true;
                let them = if others == 1 { "one other motion leads".to_owned() } else { format!("{others} other motions lead") };
                let message = format!(
                    "vehicle.{number}: {them} to the same rest position; the one used here is nearest to the closed form, and not the only answer"
                );
                case.notices.0.push(Notice::warning("other-separations", key(side), message));
            }
        }
        Ok(FromRest { case, correlations, has_others })
    }
}

fn key(side: Side) -> String {
    format!("rest.vehicle.{}", vehicle_number(side))
}

/// Returns an issue if a separation cannot be evidence: if it has no standard deviation, or if its slide does not end at the rest position.
fn unfit(case: &Case, i: usize, separation: &Separation) -> Option<Issue> {
    let path = format!("rest.vehicle.{}", i + 1);
    if !separation.has_deviations() {
        let message = "the rest position does not determine the uncertainty of the separation";
        return Some(Issue::at("no-separation", path, message).with_help("give the separation velocity as evidence instead"));
    }
    let given = case.rest.as_ref()?.vehicles[i].as_ref().and_then(|rest| rest.evidence)?;
    let miss = separation.miss_beyond(&given)?;
    let message = Message::from("the slide that ends nearest misses the rest position by ")
        .figure(Measure::Length, miss.position.length())
        .text(" and ")
        .figure(Measure::Angle, miss.heading.abs())
        .text(", more than its standard deviations");
    let help = "check the heading at rest, whole turns counted, and which wheels are locked";
    Some(Issue::at("no-separation", path, message).with_help(help))
}
