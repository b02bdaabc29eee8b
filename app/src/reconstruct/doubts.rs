//! Judges points along a path with what is uncertain of the vehicle.

use planar_impact::reconstruct::{Answer, Unknown};

use super::followed::Followed;
use super::from_rest::{BY_CHANCE, Separations, key, outputs};
use super::question::{Question, key_of};
use crate::case::{Case, Inputs, Parameter, vehicle_number};
use crate::issue::Issues;
use crate::message::Message;
use crate::notice::Notice;

/// Judges points along a path with what is uncertain of the vehicle: where it is contradicted at the solution, and not beside it, within what is known beforehand, it is
/// not, and a warning says where.
pub fn reconciled(
    case: &Case,
    inputs: &Inputs,
    question: Question,
    answer: Answer,
    mut about: Separations,
    ask: &dyn Fn(&Separations) -> Result<Question, Issues>,
) -> Result<(Question, Answer, Separations), Issues> {
    let mut warnings = Vec::new();
    for followed in Followed::all(case, inputs, &about.clone()) {
        let doubt = |unknown: &Unknown| {
            question.asked.dependences.iter().find(|one| one.on == unknown.of && outputs(followed.side).contains(&one.of))?;
            let parameter = key_of(unknown.of, case)?;
            let span = [unknown.min.unwrap_or(f64::NEG_INFINITY), unknown.max.unwrap_or(f64::INFINITY)];
            Some(Doubt { parameter, value: inputs.value(parameter).ok()?, sd: unknown.prior.unwrap_or(f64::INFINITY), span })
        };
        let doubts: Vec<Doubt> = question.asked.unknowns.iter().filter_map(doubt).collect();
        let Some(fit) = about[followed.side as usize].as_mut().and_then(|separation| separation.fit.as_mut()) else { continue };
        if doubts.is_empty() || fit.probability >= BY_CHANCE {
            continue;
        }
        let (chi_square, at) = followed.reconciled(&doubts);
        let with_doubts = fit.clone().with_chi_square(chi_square);
        if with_doubts.probability >= BY_CHANCE {
            *fit = with_doubts;
            let mut message = Message::from(format!("vehicle.{}: a slide comes past its points with ", vehicle_number(followed.side)));
            for (i, (doubt, value)) in doubts.iter().zip(at).enumerate() {
                let and = if i == 0 { "" } else { " and " };
                message = message.text(format!("{and}{} = ", doubt.parameter)).figure(doubt.parameter.measure(), value);
            }
            let message = message.text(", and with the values of the solution none does: the points say more of them than the answer uses");
            warnings.push(Notice::warning("points-move-inputs", format!("{}.points", key(followed.side)), message));
        }
    }
    if warnings.is_empty() {
        return Ok((question, answer, about));
    }
    let mut question = ask(&about)?;
    question.notices.0.extend(warnings);
    Ok((question, answer, about))
}

/// What is uncertain of a vehicle.
struct Doubt {
    /// The number.
    parameter: Parameter,
    /// Its value.
    value: f64,
    /// Its standard deviation; infinite if it has none.
    sd: f64,
    /// The least and the greatest value that it may have.
    span: [f64; 2],
}

impl Followed<'_> {
    /// Returns the least χ² of pose and points with what is uncertain of the vehicle, and the values at which it is: a slide that comes past none of the points from one
    /// impact center may come past all of them from another that is as probable. It is found by parabolas along each number in turn.
    fn reconciled(&self, doubts: &[Doubt]) -> (f64, Vec<f64>) {
        const SWEEPS: usize = 3;
        let mut at: Vec<f64> = doubts.iter().map(|doubt| doubt.value).collect();
        let chi_square = |at: &[f64]| {
            let values: Vec<(Parameter, f64)> = doubts.iter().zip(at).map(|(doubt, value)| (doubt.parameter, *value)).collect();
            let fit = self.near(&self.with(&values)?)?.fit?;
            let off = doubts.iter().zip(at).map(|(doubt, value)| (value - doubt.value) / doubt.sd);
            Some(fit.chi_square + off.map(|off| off * off).sum::<f64>())
        };
        let mut least = chi_square(&at).unwrap_or(f64::INFINITY);
        for _ in 0..SWEEPS {
            for i in 0..doubts.len() {
                let step = 0.3 * if doubts[i].sd.is_finite() { doubts[i].sd } else { 0.1 * at[i].abs().max(1.0) };
                let moved = |by: f64| {
                    let mut moved = at.clone();
                    moved[i] = (moved[i] + by).clamp(doubts[i].span[0], doubts[i].span[1]);
                    chi_square(&moved).map(|sum| (moved, sum))
                };
                let (Some((_, more)), Some((_, less))) = (moved(step), moved(-step)) else { continue };
                let curvature = more - 2.0 * least + less;
                if curvature > 0.0
                    && let Some((there, sum)) = moved((0.5 * (less - more) / curvature).clamp(-10.0, 10.0) * step)
                    && sum < least
                {
                    (at, least) = (there, sum);
                }
            }
        }
        (least, at)
    }
}
