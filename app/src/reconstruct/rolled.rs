//! Separations on wheels that roll, about the motion that all evidence leads to.
//!
//! The motion whose slide ends in the rest position itself may lie beside a fold, at which separations turn round, and its slopes say little of the others. A fit by Gauss and
//! Newton takes the slopes about the motion that it has reached.

use planar_impact::post_impact::{Miss, Separation};
use planar_impact::{Motion, Side, Xy};

use super::followed::Followed;
use super::from_rest::{Separations, are_near, key};
use crate::case::{Case, Inputs, vehicle_number};
use crate::control::Control;
use crate::issue::Issues;
use crate::message::Message;
use crate::notice::Notice;
use crate::units::Measure;

/// Largest χ² by which the slide of a motion misses the rest position that slopes are taken about: beyond four standard deviations a line from before is no guide.
const MOST_MISSED: f64 = 16.0;
/// Shares of the way to a fitted motion that are gone, the first that does not lead too far.
const SHARES: [f64; 5] = [1.0, 0.5, 0.25, 0.125, 0.0625];

/// Largest number of pairs of motions elsewhere that are tried.
const MOST_ELSEWHERE: usize = 8;

/// Returns the separations about motions of vehicles on wheels that roll, where there are such motions and something is said about them.
pub fn about(case: &Case, separations: &Separations, motions: &[Option<Motion>; 2]) -> Separations {
    let mut all = separations.clone();
    for followed in Followed::all(case, &case.inputs, separations) {
        let place = followed.side as usize;
        let there = motions[place].and_then(|motion| followed.widened_about(&followed.about(&motion)?));
        all[place] = there.or(all[place].take());
    }
    all
}

/// Returns motions of vehicles on wheels that roll, elsewhere than those of the separations, that lead within two standard deviations of the rest headings: where
/// separations turn round, the true one may be none of those that lead to the rest position itself.
///
/// # Errors
///
/// That it was stopped.
pub fn elsewhere(case: &Case, separations: &Separations, control: &dyn Control) -> Result<Vec<[Option<Motion>; 2]>, Issues> {
    /// Standard deviations.
    const ASIDE: f64 = 2.0;
    const FAR: f64 = 3.0;
    let mut motions = [vec![None], vec![None]];
    for followed in Followed::all(case, &case.inputs, separations) {
        let Some((rest, evidence)) = followed.rolling() else { continue };
        let known = &mut motions[followed.side as usize];
        for aside in [-ASIDE, ASIDE] {
            let mut moved = evidence.clone();
            moved.rest.heading += aside * evidence.heading_deviation;
            let found = rest.slide.separation_while(&moved, rest.method, &|done, total| control.goes_on(done, total));
            control.proceed(0, 1)?;
            let Ok(found) = found else { continue };
            let others = found.fit.iter().flat_map(|fit| &fit.others).map(|other| other.motion);
            let sds = followed.separation.covariance.deviations();
            for motion in std::iter::once(found.motion).chain(others) {
                let is_near = |other: &Motion| are_near([motion, *other], sds, FAR);
                if !is_near(&followed.separation.motion) && !known.iter().flatten().any(is_near) {
                    known.push(Some(motion));
                }
            }
        }
    }
    let [one, two] = motions;
    let pairs = one.iter().flat_map(|one| two.iter().map(move |two| [*one, *two]));
    Ok(pairs.filter(|pair| pair.iter().any(Option::is_some)).take(MOST_ELSEWHERE).collect())
}

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
        Some(Rolled { separation: followed.widened_about(&there)?, about, missed, is_fitted: share == 1.0 })
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
