//! A collision with values for its unknowns.

use crate::collision::Collision;
use crate::contact::Contact;
use crate::frame::Xy;
use crate::impact::Impact;
use crate::refusal::Refusals;
use crate::scalar::Real;

/// A collision with values for its unknowns.
#[derive(Clone, Copy, Debug)]
pub(super) struct Placed<T> {
    pub(super) collision: Collision<T>,
    /// The share of vehicle 1 in the crush energy.
    pub(super) crush_share: T,
    /// The impulse on vehicle 1, in a problem of momentum alone.
    pub(super) impulse: Option<Xy<T>>,
    /// The speed that each vehicle would have lost in braking before the impact, had it come to rest.
    pub(super) skids: [Option<T>; 2],
    /// Whether the impulse ratio is one of the unknowns.
    pub(super) ratio_is_unknown: bool,
}

impl<T: Real> Placed<T> {
    /// Computes the impact, whether or not the mechanics accepts it.
    pub(super) fn evaluate(&self) -> Impact<T> {
        self.impact_at(&self.collision.contact())
    }

    /// The same with the contact of the collision.
    pub(super) fn impact_at(&self, contact: &Contact<T>) -> Impact<T> {
        match &self.impulse {
            Some(impulse) => self.collision.impact_by_at(contact, impulse.clone()),
            None => self.collision.impact_at(contact),
        }
    }
}

impl Placed<f64> {
    /// Computes the impact if the mechanics accepts it.
    pub(super) fn solve(&self) -> Result<Impact, Refusals> {
        match self.impulse {
            Some(impulse) => self.collision.solve_by(impulse),
            None => self.collision.solve(),
        }
    }
}
