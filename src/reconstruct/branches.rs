//! Ends of intervals on other branches of the profile.
//!
//! The region within a quantile of the least χ² need not be convex: bounds and the limits of the physics cut it, and the evidence bends it. An end that is followed
//! from a solution is that of its own branch. Here each quantity is held beyond its ends, and fits begin at points all over the region: one that is within the
//! quantile leads to an end farther out. Where friction begins to hold or sliding changes its side, no slope leads on: each piece in which friction does one thing is
//! searched by itself. Small steps by chance end the search, for corners in which slopes end before the region does.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::measurand::Measurand;
use super::outwards::{End, Quantity};
use super::piece::Piece;
use super::profile::{Lying, Profile};
use super::search::draw;
use super::variable::Variable;
use super::within_limits::Fixed;
use crate::input::Input;
use crate::scalar::Field as _;

/// Largest number of points from which fits begin.
const MOST: usize = 18;

/// Number of points that are drawn, in addition to the ends of other intervals.
const DRAWN: usize = 24;

/// Distance beyond an end, in widths of the interval, at which fits are tried.
const BEYOND: f64 = 0.003;

/// Number of spreads of an unknown about the best fit in which points are drawn: without bounds its own interval may have no ends.
const SPREADS: f64 = 10.0;

/// Points of the region far from each other, for each piece of the mechanics.
pub(super) struct Region {
    points: Vec<(Piece, Vec<f64>)>,
    /// Points halfway between two of a piece. Best fits lie on the bounds that the evidence presses against; these lie within them, where an output may be farther out
    /// though it is the same all along the bound.
    halfway: Vec<Vec<f64>>,
}

impl Region {
    /// Collects points: ends of intervals, and best fits with an unknown held somewhere between its own ends.
    pub(super) fn of<'e>(profile: &Profile<'_>, ends: impl Iterator<Item = &'e End>) -> Self {
        let reached: Vec<&Vec<f64>> = ends.map(|end| &end.at).collect();
        let mut region = Region { points: Vec::new(), halfway: Vec::new() };
        let Some(best) = profile.solutions.first().filter(|_| !reached.is_empty()) else { return region };
        let question = profile.model.question;
        let unknowns = &question.unknowns;
        let range = |i: usize| {
            let ends =
                reached.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], point| [low.min(point[i]), high.max(point[i])]);
            let far = SPREADS * unknowns[i].of.spread(&question.collision, unknowns[i].start);
            [ends[0].max(best[i] - far), ends[1].min(best[i] + far)]
        };
        let ranges: Vec<[f64; 2]> = (0..unknowns.len()).map(range).collect();
        let pieces = profile.piece(best).all();
        // Where the centers of mass may pass each other along the normal, the vehicles close the other way beyond.
        let ways = if may_pass(profile) { &[Lying::AsItIs, Lying::TheOtherWay][..] } else { &[Lying::AsItIs] };
        let mut random = ChaCha8Rng::seed_from_u64(1988);
        for piece in pieces {
            for way in ways {
                let mut found: Vec<Vec<f64>> = match way {
                    Lying::AsItIs => reached.iter().filter(|point| profile.piece(point) == *piece).map(|point| point.to_vec()).collect(),
                    Lying::TheOtherWay => Vec::new(),
                };
                for i in (0..unknowns.len()).cycle().take(DRAWN / pieces.len()) {
                    // Of what lies the other way no end has been found.
                    let start: Vec<f64> = match way {
                        Lying::AsItIs => ranges.iter().map(|[low, high]| low + (high - low) * random.random::<f64>()).collect(),
                        Lying::TheOtherWay => (0..unknowns.len()).map(|k| draw(question, k, &profile.spans[k], &mut random)).collect(),
                    };
                    let fixed =
                        Fixed { of: Measurand::Variable(unknowns[i].of), value: start[i], scale: profile.spans[i].scale, period: None };
                    found.extend(profile.fit_within(*piece, *way, Some(fixed), &start));
                }
                found.extend(profile.fit_within(*piece, *way, None, best));
                let chosen = far_from_each_other(found, &ranges, MOST / pieces.len());
                region.points.extend(chosen.into_iter().map(|point| (*piece, point)));
            }
        }
        for (i, (piece, one)) in region.points.iter().enumerate() {
            let others = region.points[i + 1..].iter().filter(|(of, _)| of == piece);
            let between = others.map(|(_, other)| one.iter().zip(other).map(|(x, y)| 0.5 * (x + y)).collect::<Vec<f64>>());
            region.halfway.extend(between.filter(|point| profile.allows(point)));
        }
        region
    }

    /// Moves the ends of an interval outwards by small steps by chance, as long as some lead on.
    pub(super) fn climb(&self, quantity: &Quantity<'_>, ends: &mut [End; 2]) {
        const STEPS: usize = 128;
        /// Size of the first steps as a share of the region, its growth after a step outwards, and its decrease after another.
        const SIZE: (f64, f64, f64) = (0.2, 1.5, 0.95);
        /// Share of the width by which an end must move.
        const BEYOND: f64 = 1e-4;
        if quantity.is_constant {
            return;
        }
        let (profile, mut random) = (quantity.profile, ChaCha8Rng::seed_from_u64(1687));
        for (k, direction) in [-1.0, 1.0].into_iter().enumerate() {
            let (mut value, mut at, mut size) = (ends[k].value, ends[k].at.clone(), SIZE.0);
            for _ in 0..STEPS {
                // Along differences of points of the region, which is narrow where the evidence ties unknowns to each other.
                let mut point = at.clone();
                for pair in self.points.windows(2) {
                    let share = size * random.random_range(-1.0..1.0);
                    point.iter_mut().zip(&pair[0].1).zip(&pair[1].1).for_each(|((x, one), other)| *x += share * (other - one));
                }
                point.iter_mut().zip(&profile.spans).for_each(|(x, span)| *x = x.clamp(span.min, span.max));
                let there = quantity.unwrapped(&point).filter(|there| direction * (there - value) > 0.0 && profile.allows(&point));
                match there {
                    Some(there) => (value, at, size) = (there, point, size * SIZE.1),
                    None => size *= SIZE.2,
                }
            }
            if direction * (value - ends[k].value) > BEYOND * (ends[1].value - ends[0].value) {
                ends[k] = quantity.end(direction, &at, value);
            }
        }
    }

    /// Moves the ends of an interval outwards as far as a branch of the profile goes.
    pub(super) fn extend(&self, quantity: &Quantity<'_>, ends: &mut [End; 2]) {
        /// Number of branches that one end may move to.
        const BRANCHES: usize = 8;
        self.points.iter().map(|(_, point)| point).chain(&self.halfway).for_each(|point| quantity.extend(ends, point));
        for (k, direction) in [-1.0, 1.0].into_iter().enumerate() {
            for _ in 0..BRANCHES {
                let Some(end) = self.farther(quantity, ends, k, direction) else { break };
                ends[k] = end;
            }
        }
    }

    /// Returns an end beyond one of an interval, if a fit begins there.
    fn farther(&self, quantity: &Quantity<'_>, ends: &[End; 2], k: usize, direction: f64) -> Option<End> {
        let width = ends[1].value - ends[0].value;
        let value = ends[k].value + direction * BEYOND * width;
        let is_within = width > 0.0 && value.is_finite() && direction * (quantity.outer[k] - value) > 0.0;
        let fixed = quantity.fixed_at(Some(value).filter(|_| is_within)?);
        self.points.iter().find_map(|(piece, point)| {
            let fit = quantity.profile.fit_within(*piece, Lying::AsItIs, Some(fixed), point)?;
            let reached = quantity.unwrapped(&fit).filter(|reached| direction * (reached - ends[k].value) > 0.5 * BEYOND * width)?;
            Some(quantity.end(direction, &fit, reached))
        })
    }
}

/// Returns `true` if an unknown moves the centers of mass along the normal.
fn may_pass(profile: &Profile<'_>) -> bool {
    let moves = |of: Variable| {
        use Input::{CrushPlane, Heading, ImpactCenterForward, ImpactCenterLeft};
        matches!(of, Variable::Input(CrushPlane | Heading(_) | ImpactCenterForward(_) | ImpactCenterLeft(_)))
    };
    let question = profile.model.question;
    !question.is_by_momentum() && question.unknowns.iter().any(|unknown| moves(unknown.of))
}

/// Chooses points far from each other within ranges, beginning with the last.
fn far_from_each_other(points: Vec<Vec<f64>>, ranges: &[[f64; 2]], most: usize) -> Vec<Vec<f64>> {
    /// Square of a distance, in ranges, that is nearly none.
    const NEAR: f64 = 1e-4;
    let distance = |one: &[f64], other: &[f64]| {
        let squares = one.iter().zip(other).zip(ranges).filter(|(_, [low, high])| high > low);
        squares.map(|((x, y), [low, high])| ((x.clamp(*low, *high) - y.clamp(*low, *high)) / (high - low)).squared()).sum::<f64>()
    };
    let mut chosen: Vec<Vec<f64>> = points.last().cloned().into_iter().collect();
    while chosen.len() < most {
        let nearest = |point: &Vec<f64>| chosen.iter().map(|other| distance(point, other)).fold(f64::INFINITY, f64::min);
        let farthest = points.iter().map(|point| (nearest(point), point)).max_by(|one, other| one.0.total_cmp(&other.0));
        let Some((_, point)) = farthest.filter(|(distance, _)| *distance > NEAR) else { break };
        chosen.push(point.clone());
    }
    chosen
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Distances count in ranges, of which none begins at zero, and one of no width does not count.
    #[test]
    fn points_are_chosen_far_from_each_other() {
        let ranges = [[1.0, 3.0], [10.0, 110.0], [5.0, 5.0]];
        let [first, wide, high, near] = [[1.0, 10.0, 5.0], [3.0, 20.0, 5.0], [1.5, 100.0, 9.0], [1.0, 10.5, 7.0]].map(Vec::from);
        let chosen = |most: usize| far_from_each_other(vec![near.clone(), high.clone(), wide.clone(), first.clone()], &ranges, most);
        // From the first, 1 + 0.1² of the ranges away and 0.25² + 0.9²; the other one is at it.
        assert_eq!(chosen(2), [first.clone(), wide.clone()]);
        assert_eq!(chosen(9), [first.clone(), wide.clone(), high.clone()]);
        // Beyond a range counts as its end.
        assert_eq!(far_from_each_other(vec![vec![-7.0, 10.0, 5.0], first.clone()], &ranges, 2), [first]);
    }
}
