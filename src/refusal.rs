//! Reasons for refusing a collision. [`Collision::solve`](crate::Collision::solve) finds all of them at once.

use alloc::borrow::Cow;
use alloc::string::ToString;
use core::fmt;

use crate::issue::{InputIssue, Issue, Issues, Place};
use crate::measure::Measure;
use crate::message::Message;
use crate::scalar::{Ordered, is_positive};

/// Reason for refusing a collision.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Refusal<T = f64> {
    /// A number is invalid.
    Input(InputIssue<T>),
    /// A cosine and a sine do not belong to an angle.
    NotADirection {
        /// The direction.
        at: Place,
        /// cos² + sin², which must be 1.
        length_squared: T,
    },
    /// Both parties are barriers.
    NothingMoves,
    /// The numbers are so large or so small that the result is infinite or not a number.
    OutOfFloatRange,
    /// The result violates its own restitution or energy by more than the accepted rounding of the scalar, for instance because a yaw inertia is far too
    /// small for its arm.
    IllConditioned {
        /// The error, as a share of the approach velocity or of the energy.
        error: T,
    },
    /// The vehicles do not approach each other along the normal: they separate, or slide along the crush plane.
    NotClosing {
        /// The normal approach velocity v_n, in m/s.
        approach: T,
        /// The normal component s of center of mass 2 less center of mass 1, in m. The vehicles are closing if v_n s < 0.
        offset: T,
    },
    /// The normal impulse is tensile.
    Tensile {
        /// The normal impulse that would satisfy the equations in N s, or the change of normal velocity by a unit of it in 1/kg if that is not positive.
        normal: T,
        /// The reason for the tension.
        reason: Tension,
    },
    /// The impulse ratio is beyond the critical one, or has the opposite sign.
    BeyondCritical {
        /// The impulse ratio μ.
        ratio: T,
        /// The ratio of the sticking impulse. `None` if that impulse is tensile: then any ratio of its sign is accepted, and this one has the opposite sign.
        critical: Option<T>,
    },
    /// The vehicles would have more energy after the impact than before.
    EnergyGain {
        /// The gain, in J.
        gain: T,
        /// Their kinetic energy before, in J.
        before: T,
    },
}

/// Reason why an impulse is tensile.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Tension {
    /// The normal impulse that solves the equations is tensile.
    Pulls,
    /// At this impulse ratio no compressive impulse separates the vehicles: K_nn + μ K_nt is not positive, and the pair wedges.
    Wedges,
}

/// All reasons for refusing a collision; never empty.
pub type Refusals<T = f64> = Issues<Refusal<T>>;

impl<T> Refusal<T> {
    /// Returns `true` if the mechanics refuses the collision although each of its numbers is valid.
    pub fn is_physical(&self) -> bool {
        matches!(self, Refusal::NotClosing { .. } | Refusal::Tensile { .. } | Refusal::BeyondCritical { .. } | Refusal::EnergyGain { .. })
    }

    /// Returns the name of the refused input, if the refusal is about a single input.
    pub fn input(&self) -> Option<&'static str> {
        match self {
            Refusal::Input(InputIssue { at, .. }) | Refusal::NotADirection { at, .. } => Some(at.name),
            _ => None,
        }
    }
}

impl<T> From<InputIssue<T>> for Refusal<T> {
    fn from(issue: InputIssue<T>) -> Self {
        Refusal::Input(issue)
    }
}

fn not_a_direction<T>(subject: impl Into<Cow<'static, str>>, length_squared: T) -> Message<T> {
    Message::new().text(subject).text(" is not a direction: cos² + sin² is ").figure(Measure::Ratio, length_squared).text("; it must be 1")
}

/// Returns `true` if the vehicles separate, by more than the rounding of meters and meters per second.
fn is_separating<T: Ordered<Mask = bool>>(approach: &T, offset: &T) -> bool {
    let is_more_than_rounding = |x: &T| T::int(1).less(&(x.clone().magnitude() * T::int(1_000_000_000)));
    is_positive(&(approach.clone() * offset.clone())) && is_more_than_rounding(approach) && is_more_than_rounding(offset)
}

impl<T: Ordered<Mask = bool>> Issue for Refusal<T> {
    type Number = T;

    fn code(&self) -> &'static str {
        match self {
            Refusal::Input(issue) => issue.code(),
            Refusal::NotADirection { .. } => "not-a-direction",
            Refusal::NothingMoves => "nothing-moves",
            Refusal::OutOfFloatRange => "overflow",
            Refusal::IllConditioned { .. } => "ill-conditioned",
            Refusal::NotClosing { approach, offset } if is_separating(approach, offset) => "separating",
            Refusal::NotClosing { .. } => "not-closing",
            Refusal::Tensile { reason: Tension::Pulls, .. } => "tensile",
            Refusal::Tensile { reason: Tension::Wedges, .. } => "wedging",
            Refusal::BeyondCritical { .. } => "beyond-critical",
            Refusal::EnergyGain { .. } => "energy-gain",
        }
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
                            range.text("0 to ").figure(Measure::Ratio, critical.clone())
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
                "sliding does not end in this contact; give `impulse_ratio` as a number, or a `friction`".into()
            }
            Refusal::IllConditioned { .. } => "check each mass, yaw inertia and impact center, and their units".into(),
            Refusal::EnergyGain { .. } => "the restitution is too high for this contact".into(),
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
