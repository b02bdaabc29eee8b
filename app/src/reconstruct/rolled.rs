//! Separations on wheels that roll, about the motion that all evidence leads to.
//!
//! The motion whose slide ends in the rest position itself may lie beside a fold, at which separations turn round, and its slopes say little of the others. A fit by Gauss and
//! Newton takes the slopes about the motion that it has reached.

use planar_impact::post_impact::{Miss, Separation};
use planar_impact::{Motion, Side, Xy};

use super::followed::Followed;
use super::from_rest::{Separations, are_near, key};
use crate::case::{Case, Inputs, vehicle_number};
use crate::message::Message;
use crate::notice::Notice;
use crate::units::Measure;

/// Largest χ² by which the slide of a motion misses the rest position that slopes are taken about: beyond four standard deviations a line from before is no guide.
const MOST_MISSED: f64 = 16.0;
/// Shares of the way to a fitted motion that are gone, the first that does not lead too far.
const SHARES: [f64; 5] = [1.0, 0.5, 0.25, 0.125, 0.0625];

/// What a rest position says of a separation about another motion.
#[derive(Clone)]
pub struct Rolled {
    /// What it says.
    pub separation: Separation,
    /// That motion.
    pub about: Motion,
    /// By what its slide misses the rest position.
    pub missed: Miss,
    /// Whether it is the fitted one, and not one on the way there.
    pub is_fitted: bool,
}

impl Rolled {
    /// Returns those of each vehicle about fitted motions, or about motions on the way there: from others, or from those that lead to the rest positions.
    pub fn of(
        case: &Case,
        inputs: &Inputs,
        separations: &Separations,
        from: &[Option<Motion>; 2],
        fitted: &[Motion; 2],
    ) -> [Option<Rolled>; 2] {
        let mut all = [None, None];
        for followed in Followed::all(case, inputs, separations) {
            let place = followed.side as usize;
            let from = from[place].unwrap_or(followed.separation.motion);
            all[place] = SHARES.into_iter().find_map(|share| Rolled::on_the_way(&followed, share, &from, &fitted[place]));
        }
        all
    }

    fn on_the_way(followed: &Followed<'_>, share: f64, from: &Motion, fitted: &Motion) -> Option<Rolled> {
        let [start, end] = [from, fitted].map(|motion| motion.components());
        let [x, y, yaw_rate] = std::array::from_fn(|i| if share == 1.0 { end[i] } else { start[i] + share * (end[i] - start[i]) });
        let about = Motion { velocity: Xy { x, y }, yaw_rate };
        let there = followed.about(&about)?;
        let missed = there.fit.as_ref().filter(|fit| fit.chi_square <= MOST_MISSED)?.miss;
        let widened = Followed { separation: &there, ..*followed }.widened().ok()?;
        let separation = Separation { fit: followed.separation.fit.clone(), ..widened };
        Some(Rolled { separation, about, missed, is_fitted: share == 1.0 })
    }

    /// Returns a note of a separation that is another than that whose slide ends in the rest position, if that makes a difference.
    pub fn notice(&self, side: Side, at_rest: &Separation) -> Option<Notice> {
        /// Standard deviations.
        const MATTERS: f64 = 0.1;
        if are_near([self.separation.motion, at_rest.motion], at_rest.covariance.deviations(), MATTERS) {
            return None;
        }
        let message = format!("vehicle.{}: its separation is weighed about the fitted motion, whose slide ends ", vehicle_number(side));
        let message = Message::from(message).figure(Measure::Length, self.missed.position.length()).text(" and ");
        let message = message.figure(Measure::Angle, self.missed.heading.abs()).text(" from the rest position");
        Some(Notice::note("separation-about-fit", key(side), message))
    }
}
