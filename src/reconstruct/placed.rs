//! A collision with values for its unknowns.

use crate::collision::Collision;

/// A collision with values for its unknowns.
#[derive(Clone, Copy, Debug)]
pub(super) struct Placed<T> {
    pub(super) collision: Collision<T>,
    /// The share of vehicle 1 in the crush energy.
    pub(super) crush_share: T,
}
