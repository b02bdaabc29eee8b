//! What is refused, and why.
//!
//! Nothing is repaired: no sign flipped, no coefficient clamped, no vehicle reordered. All problems are reported, each with its name and number.
//! [`Collision::solve`](crate::Collision::solve) finds them.

use alloc::vec::Vec;
use core::fmt;

/// Why a collision is refused.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Refusal<T = f64> {
    /// An input is infinite or not a number.
    NotFinite {
        /// Its name, such as `vehicle.1.mass`.
        input: &'static str,
        /// Its value.
        value: T,
    },
    /// An input must be above zero and is not.
    NotPositive {
        /// Its name.
        input: &'static str,
        /// Its value.
        value: T,
    },
    /// An input must lie between two bounds, both allowed, and does not.
    OutOfRange {
        /// Its name.
        input: &'static str,
        /// Its value.
        value: T,
        /// The least value allowed.
        least: i32,
        /// The greatest value allowed, if there is one.
        greatest: Option<i32>,
    },
    /// A cosine and a sine that are those of no angle.
    NotADirection {
        /// Its name.
        input: &'static str,
        /// cos² + sin², which must be 1.
        length_squared: T,
    },
    /// Both parties are barriers.
    NothingMoves,
    /// The numbers are so large or so small that the result is infinite or not a number.
    OutOfFloatRange,
    /// The vehicles do not approach each other along the normal: they separate, or slide along the crush plane.
    NotClosing {
        /// The normal approach velocity v_n, in m/s.
        approach: T,
        /// The normal component s of center of mass 2 less center of mass 1, in m. They close where v_n s < 0.
        offset: T,
    },
    /// The normal impulse would have to pull.
    Tensile {
        /// The normal impulse that would satisfy the equations in N s, or the change of normal velocity by a unit of it where that is not positive.
        normal: T,
        /// What about it.
        reason: Tension,
    },
    /// The impulse ratio is beyond the critical one, or of the other sign.
    BeyondCritical {
        /// The impulse ratio μ.
        ratio: T,
        /// The ratio of the sticking impulse. None where that impulse would pull: then any ratio of its side will do, and this one is of the other.
        critical: Option<T>,
    },
    /// The vehicles would have more energy after the impact than before.
    EnergyGain {
        /// What they would gain, in J.
        gain: T,
        /// Their kinetic energy before, in J.
        before: T,
    },
}

/// Why an impulse is tensile.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Tension {
    /// The normal impulse that solves the equations pulls the bodies together.
    Pulls,
    /// At this impulse ratio no push separates them: K_nn + μ K_nt is not positive, and the pair wedges.
    Wedges,
}

/// All the reasons why a collision is refused; never empty.
#[derive(Clone, Debug, PartialEq)]
pub struct Refusals<T = f64>(pub(crate) Vec<Refusal<T>>);

impl<T> Refusals<T> {
    /// The reasons, in the order in which they were found.
    pub fn reasons(&self) -> &[Refusal<T>] {
        &self.0
    }
}

impl<T> Refusal<T> {
    /// Whether the mechanics refuses a collision whose numbers are each in order.
    pub fn is_physical(&self) -> bool {
        matches!(self, Refusal::NotClosing { .. } | Refusal::Tensile { .. } | Refusal::BeyondCritical { .. } | Refusal::EnergyGain { .. })
    }

    /// The name of the input that is refused, if it is one alone.
    pub fn input(&self) -> Option<&'static str> {
        match self {
            Refusal::NotFinite { input, .. }
            | Refusal::NotPositive { input, .. }
            | Refusal::OutOfRange { input, .. }
            | Refusal::NotADirection { input, .. } => Some(input),
            _ => None,
        }
    }
}

impl<T: fmt::Display> fmt::Display for Refusal<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Refusal::NotFinite { input, value } => write!(f, "{input} is {value}; a finite number is expected"),
            Refusal::NotPositive { input, value } => write!(f, "{input} is {value}; it must be above zero"),
            Refusal::OutOfRange { input, value, least, greatest: Some(greatest) } => {
                write!(f, "{input} is {value}; it must lie between {least} and {greatest}")
            }
            Refusal::OutOfRange { input, value, least, greatest: None } => {
                write!(f, "{input} is {value}; it must be at least {least}")
            }
            Refusal::NotADirection { input, length_squared } => {
                write!(f, "{input} has cos² + sin² = {length_squared}; a direction has 1")
            }
            Refusal::NothingMoves => write!(f, "both parties are fixed barriers; one must be a vehicle"),
            Refusal::OutOfFloatRange => write!(f, "the numbers are too large or too small: the result overflows"),
            Refusal::NotClosing { approach, offset } => write!(
                f,
                "the vehicles do not close: the normal approach velocity is {approach} and the normal component of center of mass 2 \
                 less center of mass 1 is {offset}; a closing pair has them of opposite sign, and neither zero"
            ),
            Refusal::Tensile { normal, reason: Tension::Pulls } => write!(
                f,
                "the normal impulse would have to pull: {normal} on vehicle 1, towards vehicle 2; the contact slides on, so give an impulse ratio \
                 or a friction that lets it"
            ),
            Refusal::Tensile { normal, reason: Tension::Wedges } => write!(
                f,
                "the pair wedges at this impulse ratio: K_nn + μ K_nt is {normal}, and no push along the normal would separate them"
            ),
            Refusal::BeyondCritical { ratio, critical: Some(critical) } => {
                write!(f, "the impulse ratio {ratio} is beyond the critical one; it must lie between zero and {critical}")
            }
            Refusal::BeyondCritical { ratio, critical: None } => {
                write!(f, "the impulse ratio {ratio} has the wrong sign: it would speed the sliding up")
            }
            Refusal::EnergyGain { gain, before } => write!(
                f,
                "the vehicles would gain energy: {gain} on top of {before} before the impact; the restitution is too high for this contact"
            ),
        }
    }
}

impl<T: fmt::Display> fmt::Display for Refusals<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, reason) in self.0.iter().enumerate() {
            if i > 0 {
                f.write_str("; ")?;
            }
            write!(f, "{reason}")?;
        }
        Ok(())
    }
}

impl<T: fmt::Debug + fmt::Display> core::error::Error for Refusal<T> {}
impl<T: fmt::Debug + fmt::Display> core::error::Error for Refusals<T> {}
