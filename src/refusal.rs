//! Reasons for refusing a collision. [`Collision::solve`](crate::Collision::solve) finds all of them at once.

#[cfg(feature = "alloc")]
mod message;

use crate::issue::{InputIssue, Issues, Place};
use crate::scalar::{Ordered, is_positive};

/// Reason for refusing a collision.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
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
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
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

impl<T: Ordered<Mask = bool>> Refusal<T> {
    /// Returns a stable name of the kind of refusal, in kebab case.
    pub fn code(&self) -> &'static str {
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
}

/// Returns `true` if the vehicles separate, by more than the rounding of meters and meters per second.
fn is_separating<T: Ordered<Mask = bool>>(approach: &T, offset: &T) -> bool {
    let is_more_than_rounding = |x: &T| T::int(1).less(&(x.clone().magnitude() * T::int(1_000_000_000)));
    is_positive(&(approach.clone() * offset.clone())) && is_more_than_rounding(approach) && is_more_than_rounding(offset)
}
