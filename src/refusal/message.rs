//! Messages of refusals.

use alloc::borrow::Cow;
use alloc::string::ToString;
use core::fmt;

use super::{Refusal, Tension, is_separating};
use crate::issue::Issue;
use crate::measure::Measure;
use crate::message::Message;
use crate::scalar::Ordered;

fn not_a_direction<T>(subject: impl Into<Cow<'static, str>>, length_squared: T) -> Message<T> {
    Message::new().text(subject).text(" is not a direction: cos² + sin² is ").figure(Measure::Ratio, length_squared).text("; it must be 1")
}

impl<T: Ordered<Mask = bool>> Issue for Refusal<T> {
    type Number = T;

    fn code(&self) -> &'static str {
        self.code()
    }

    fn path(&self) -> Option<Cow<'static, str>> {
        match self {
            Refusal::Input(issue) => issue.path(),
            Refusal::NotADirection { at, .. } => Some(at.name.into()),
            Refusal::NothingMoves => Some("vehicle".into()),
            Refusal::OutOfFloatRange | Refusal::IllConditioned { .. } => None,
            Refusal::NotClosing { .. } | Refusal::Tensile { reason: Tension::Pulls, .. } => Some("contact".into()),
            Refusal::Tensile { reason: Tension::Wedges, .. } | Refusal::BeyondCritical { .. } => Some("contact.impulse_ratio".into()),
            Refusal::EnergyGain { .. } => Some("contact.restitution".into()),
        }
    }

    fn message(&self) -> Message<T> {
        match self {
            Refusal::Input(issue) => issue.message(),
            Refusal::NotADirection { length_squared, .. } => not_a_direction("it", length_squared.clone()),
            Refusal::NothingMoves => "both parties are fixed barriers, so nothing moves".into(),
            Refusal::OutOfFloatRange => "the result overflows: the inputs are too large or too small".into(),
            Refusal::IllConditioned { error } => Message::new()
                .text("the inputs are ill-conditioned: rounding changes the result by a share of ")
                .figure(Measure::Ratio, error.clone()),
            Refusal::NotClosing { approach, offset } => {
                let what =
                    if is_separating(approach, offset) { "vehicles are separating" } else { "vehicles are not approaching each other" };
                Message::new()
                    .text(what)
                    .text(": the normal approach velocity is ")
                    .figure(Measure::Speed, approach.clone())
                    .text(", and center of mass 2 lies ")
                    .figure(Measure::Length, offset.clone())
                    .text(" from center of mass 1 along the normal")
            }
            Refusal::Tensile { normal, reason: Tension::Pulls } => Message::new()
                .text("normal impulse is tensile: ")
                .figure(Measure::Impulse, normal.clone())
                .text(" on vehicle 1, towards vehicle 2"),
            Refusal::Tensile { normal, reason: Tension::Wedges } => Message::new()
                .text("vehicles wedge at this impulse ratio: K_nn + mu K_nt is ")
                .figure(Measure::InverseMass, normal.clone())
                .text(", so no compressive impulse separates them"),
            Refusal::BeyondCritical { ratio, critical } => {
                let ratio = Message::new().text("impulse ratio ").figure(Measure::Ratio, ratio.clone());
                match critical {
                    None => ratio.text(" has the wrong sign: it would accelerate the sliding"),
                    Some(critical) => {
                        let range = ratio.text(" is beyond the critical one; it must be from ");
                        if critical.less(&T::int(0)) {
                            range.figure(Measure::Ratio, critical.clone()).text(" to 0")
                        } else {
                            // Of zero of either sign.
                            range.text("0 to ").figure(Measure::Ratio, T::int(0) + critical.clone())
                        }
                    }
                }
            }
            Refusal::EnergyGain { gain, before } => Message::new()
                .text("vehicles would gain energy: ")
                .figure(Measure::Energy, gain.clone())
                .text(" more than the ")
                .figure(Measure::Energy, before.clone())
                .text(" before the impact"),
        }
    }

    fn help(&self) -> Option<Message<T>> {
        Some(match self {
            Refusal::Input(issue) => return issue.help(),
            Refusal::NothingMoves => "one party must be a vehicle".into(),
            Refusal::NotClosing { .. } => {
                "they close when the two have opposite signs and neither is zero; check velocities, impact centers and crush plane".into()
            }
            Refusal::Tensile { reason: Tension::Pulls, .. } => {
                "sliding does not end in this contact: give `impulse_ratio` as a number, or a `friction`; of a contact with a moment impulse, a smaller one".into()
            }
            Refusal::IllConditioned { .. } => "check each mass, yaw inertia and impact center, and their units".into(),
            Refusal::EnergyGain { .. } => "the restitution is too high for this contact, or a moment impulse is too large".into(),
            Refusal::BeyondCritical { critical: Some(_), .. } => "the limit is rounded here; `critical` is the limit itself".into(),
            _ => return None,
        })
    }
}

impl<T: Ordered<Mask = bool> + fmt::Display> fmt::Display for Refusal<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Refusal::Input(issue) => issue.fmt(f),
            Refusal::NotADirection { at, length_squared } => not_a_direction(at.to_string(), length_squared.clone()).fmt(f),
            _ => self.message().fmt(f),
        }
    }
}

impl<T: Ordered<Mask = bool> + fmt::Debug + fmt::Display> core::error::Error for Refusal<T> {}
