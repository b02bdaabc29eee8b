//! The way outwards of one quantity, from a solution to the end of its interval.
//!
//! It follows the best fit of everything else, so that an end may lie at the far end of a curved valley.

use nalgebra::{DMatrix, DVector};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::given::{Evidence, Uncertainty};
use super::interval::{Interval, Method};
use super::limit::Limit;
use super::measurand::Measurand;
use super::piece::Piece;
use super::profile::Profile;
use super::residuals::Model;
use super::variable::turns;
use super::within_limits::{Fixed, WithinLimits};
use crate::least_squares::limited::{self, Limited, Reached, Until};
use crate::least_squares::{self, Bound, FitError, ParameterBounds, Residuals, scaled};

/// Precision of an end, as a share of its distance from the value.
const PRECISE: f64 = 2e-4;

/// Distance in scales from the best fit that no bound and no evidence limits: for a speed a thousand kilometers a second.
const FAR: f64 = 1e6;

/// One end of an interval.
#[derive(Clone, Debug)]
pub(super) struct End {
    pub(super) value: f64,
    limited_by: Option<Limit>,
    /// The unknowns there.
    pub(super) at: Vec<f64>,
}

/// The best fit with the quantity held at a value.
struct Tried {
    value: f64,
    /// `Err` if it does not get that value, with the closest one that it got, if any.
    reached: Result<Reached, Option<f64>>,
}

/// A quantity whose interval is wanted.
pub(super) struct Quantity<'a> {
    pub(super) profile: &'a Profile<'a>,
    pub(super) of: Measurand,
    /// Its value at the best solution.
    value: f64,
    /// The place of an unknown angle that repeats itself within no bounds or one, and its period.
    turning: Option<(usize, f64)>,
    scale: f64,
    /// The period of an angle that is computed.
    period: Option<f64>,
    /// Whether the unknowns do not move it about the solutions. Far from them they may: a friction limits no ratio where the vehicles stick.
    pub(super) is_constant: bool,
    /// Largest difference of values that is rounding.
    rounding: f64,
    /// The farthest values to look at: bounds, or half a turn away.
    pub(super) outer: [f64; 2],
    bounds: [f64; 2],
}

/// The way outwards, as far as it is within the limit.
struct Inside {
    value: f64,
    unknowns: Vec<f64>,
    before: Option<(f64, Vec<f64>)>,
    limited_by: Option<Limit>,
}

impl Inside {
    fn advance(&mut self, value: f64, reached: &Reached, limited_by: Option<Limit>) {
        self.before = Some((self.value, std::mem::replace(&mut self.unknowns, reached.unknowns.clone())));
        (self.value, self.limited_by) = (value, limited_by);
    }

    /// Returns the point to which the last two lead.
    fn extrapolated(&self, value: f64) -> Vec<f64> {
        let Some((before, unknowns)) = &self.before else { return self.unknowns.clone() };
        let share = (value - self.value) / (self.value - before);
        self.unknowns.iter().zip(unknowns).map(|(here, before)| here + share * (here - before)).collect()
    }
}

impl<'a> Quantity<'a> {
    /// Prepares the quantity, or returns `None` if it has no value at the best solution.
    pub(super) fn of(profile: &'a Profile<'a>, of: Measurand) -> Option<Self> {
        let value = profile.value(of, profile.solutions.first()?)?;
        let variable = profile.model.question.place_of(of);
        let scale = variable.map_or_else(|| (0.1 * value.abs()).max(0.1 * of.least_size()), |i| profile.spans[i].scale);
        let bounds = variable.map_or([f64::NEG_INFINITY, f64::INFINITY], |i| [profile.spans[i].min, profile.spans[i].max]);
        // An angle repeats itself: after half a turn to either side, or a whole one from its only bound.
        let outer = match (of.period(), bounds.map(f64::is_finite)) {
            (Some(period), [false, false]) => [value - period / 2.0, value + period / 2.0],
            (Some(period), [true, false]) => [bounds[0], bounds[0] + period],
            (Some(period), [false, true]) => [bounds[1] - period, bounds[1]],
            _ => bounds,
        };
        let turning = variable.zip(of.period()).filter(|_| !bounds.iter().all(|bound| bound.is_finite()));
        let period = of.period().filter(|_| variable.is_none());
        let is_constant = variable.is_none() && is_constant(profile, of, value, period);
        let rounding = rounding(of, value);
        Some(Quantity { profile, of, value, turning, scale, period, is_constant, rounding, outer, bounds })
    }

    /// Returns the ends that enclose those around each solution.
    pub(super) fn around_solutions(&self) -> Option<[End; 2]> {
        if self.is_constant {
            let only = End { value: self.value, limited_by: None, at: self.profile.solutions.first()?.clone() };
            return Some([only.clone(), only]);
        }
        let ends = |point: &Vec<f64>| {
            let value = self.unwrapped(point)?;
            Some([-1.0, 1.0].map(|direction| self.end(direction, point, value)))
        };
        self.profile.solutions.iter().filter_map(ends).reduce(|[low, high], [other_low, other_high]| {
            [if other_low.value < low.value { other_low } else { low }, if other_high.value > high.value { other_high } else { high }]
        })
    }

    /// Follows an end from a point that lies beyond it.
    pub(super) fn extend(&self, ends: &mut [End; 2], point: &[f64]) {
        /// Share of the width by which a point must lie beyond.
        const BEYOND: f64 = 1e-3;
        let Some(value) = self.unwrapped(point) else { return };
        let width = ends[1].value - ends[0].value;
        for (end, direction) in ends.iter_mut().zip([-1.0, 1.0]) {
            let beyond = direction * (value - end.value);
            if beyond > BEYOND * width && beyond > self.rounding {
                *end = self.end(direction, point, value);
            }
        }
    }

    /// Returns the value at a point; for an angle the turn next to the best one.
    pub(super) fn unwrapped(&self, point: &[f64]) -> Option<f64> {
        let value = self.profile.value(self.of, &self.turned(point))?;
        Some(value - turns(value - self.value, self.period))
    }

    /// Returns a point with the quantity itself, if it is an unknown angle, within the farthest values: a plane is the same after half a turn, and a heading after a whole one.
    fn turned(&self, point: &[f64]) -> Vec<f64> {
        let mut turned = point.to_vec();
        if let Some((place, period)) = self.turning {
            turned[place] -= turns(turned[place] - (self.outer[0] + period / 2.0), Some(period));
        }
        turned
    }

    /// Follows the best fit outwards from a point to the value at which χ² reaches its limit, or to what stops it: within one piece of the mechanics after the
    /// other, because no slope leads across their edges.
    pub(super) fn end(&self, direction: f64, start: &[f64], value: f64) -> End {
        let mut end = End { value, limited_by: None, at: self.turned(start) };
        let Ok((placed, impact)) = self.profile.model.solve(&end.at) else { return end };
        let mut problem = WithinLimits::around(self.profile.model, &end.at, &placed, &impact);
        let mut pieces = vec![Piece::of(&placed)];
        problem.keep_to(pieces[0]);
        end = self.end_within(&mut problem, direction, &end);
        // A fit may end in another piece than the one that it was kept to, or on an edge of that.
        let ahead = |problem: &WithinLimits<'_>, at: &[f64]| [self.profile.piece(at)].into_iter().chain(problem.beyond(at));
        while let Some(next) = ahead(&problem, &end.at).find(|next| !pieces.contains(next)) {
            pieces.push(next);
            problem.keep_to(next);
            let farther = self.end_within(&mut problem, direction, &end);
            if direction * (farther.value - end.value) > self.rounding {
                end = farther;
            }
        }
        end
    }

    /// The same as far as the problem goes.
    fn end_within(&self, problem: &mut WithinLimits<'_>, direction: f64, start: &End) -> End {
        /// Largest number of steps outwards, each twice the last.
        const STEPS: usize = 60;
        let profile = self.profile;
        let outer = self.outer[usize::from(direction > 0.0)];
        let mut inside = Inside { value: start.value, unknowns: start.at.clone(), before: None, limited_by: None };
        let mut length = self.first_step(problem, &start.at);
        for _ in 0..STEPS {
            let next = inside.value + direction * length;
            let next = if direction * (next - outer) > 0.0 { outer } else { next };
            let rest = direction * (next - inside.value);
            if rest <= 0.0 || next == outer && rest <= PRECISE * (outer - self.value).abs() {
                return self.at_outer(inside, outer);
            }
            if outer.is_infinite() && (next - self.value).abs() > FAR * self.scale {
                break;
            }
            let tried = self.tried(problem, &inside, next);
            let Ok(reached) = &tried.reached else { return self.between(problem, inside, tried) };
            let root = self.root(reached.sum_of_squares);
            if root > PRECISE * profile.quantile.sqrt() {
                return self.between(problem, inside, tried);
            }
            inside.advance(tried.value, reached, self.limit(problem, reached));
            if root.abs() <= PRECISE * profile.quantile.sqrt() {
                return End { value: tried.value, limited_by: inside.limited_by, at: inside.unknowns };
            }
            // A little beyond where the slope leads, so that the next point encloses the end.
            let wanted = self.toward(&tried).map_or(f64::INFINITY, |value| 1.02 * direction * (value - next));
            length = if wanted > 0.0 { wanted.min(4.0 * length) } else { 2.0 * length };
        }
        End { value: outer, limited_by: None, at: inside.unknowns }
    }

    /// Returns how far the quantity would go if the evidence were linear in the unknowns.
    fn first_step(&self, problem: &WithinLimits<'_>, unknowns: &[f64]) -> f64 {
        /// The longest first step, in scales, and the least one that is not rounding: of a quantity without a slope.
        const LONGEST: f64 = 20.0;
        const LEAST: f64 = 1e-12;
        let longest = LONGEST * self.scale;
        let slopes = problem.slopes_of(self.of, unknowns);
        let Some((jacobian, slope)) = slopes else { return longest };
        let jacobian = scaled(jacobian, &self.profile.spans);
        let slope = scaled(slope, &self.profile.spans).transpose();
        let stiff = jacobian.tr_mul(&jacobian) + DMatrix::identity(jacobian.ncols(), jacobian.ncols()) * 1e-9;
        let Some(factor) = stiff.cholesky() else { return longest };
        let sd = slope.dot(&factor.solve(&slope)).sqrt();
        let length = sd * self.profile.quantile.sqrt();
        if length > LEAST * self.scale { length.min(longest) } else { 1e-3 * self.scale }
    }

    /// Returns the end at a bound of the quantity, or half a turn away.
    fn at_outer(&self, inside: Inside, outer: f64) -> End {
        let limited_by = match self.of {
            _ if outer.is_infinite() => None,
            Measurand::Variable(of) if outer == self.bounds[0] => Some(Limit::Bound(of, Bound::Min)),
            Measurand::Variable(of) if outer == self.bounds[1] => Some(Limit::Bound(of, Bound::Max)),
            _ => Some(Limit::Period),
        };
        End { value: outer, limited_by, at: inside.unknowns }
    }

    /// Narrows the end down between a value within the limit and one beyond it, or beyond what can be.
    fn between(&self, problem: &mut WithinLimits<'_>, mut inside: Inside, mut outside: Tried) -> End {
        const STEPS: usize = 40;
        let profile = self.profile;
        let mut guess = self.toward(&outside);
        let mut limited_by = None;
        for step in 0..STEPS {
            let (near, far) = (inside.value, outside.value);
            // The limit that ends an interval is named only if the end lies close to it.
            let precise = if outside.reached.is_err() { PRECISE / 16.0 } else { PRECISE };
            let tolerance = precise * (far - self.value).abs();
            if (far - near).abs() <= tolerance {
                break;
            }
            // Two thirds of the steps go where the slope of the profile leads; bisection in between keeps the bracket shrinking.
            let is_between = |value: f64| (value - near) * (far - value) > 0.0;
            let value = guess.filter(|value| step % 3 != 2 && is_between(*value)).unwrap_or(near + (far - near) / 2.0);
            let tried = self.tried(problem, &inside, value);
            let value = tried.value;
            guess = self.toward(&tried);
            match &tried.reached {
                Ok(reached) => {
                    let excess = self.root(reached.sum_of_squares);
                    if excess <= 0.0 {
                        inside.advance(value, reached, self.limit(problem, reached));
                    }
                    if excess.abs() <= PRECISE * profile.quantile.sqrt() {
                        let limited_by = self.limit(problem, reached);
                        return End { value, limited_by, at: reached.unknowns.clone() };
                    }
                    if excess > 0.0 {
                        outside = tried;
                    }
                }
                Err(closest) => {
                    let is_over = closest.is_some_and(|closest| (closest - near).abs() <= tolerance);
                    outside = tried;
                    if is_over {
                        break;
                    }
                }
            }
        }
        // Nothing lies beyond: what stops the way is near.
        if outside.reached.is_err() {
            limited_by = self.near(problem, &inside.unknowns);
        }
        // Where the way begins at its end, nothing has been asked yet.
        if limited_by.is_none() && inside.before.is_none() {
            limited_by = self.tried(problem, &inside, inside.value).reached.ok().and_then(|reached| self.limit(problem, &reached));
        }
        End { value: inside.value, limited_by: limited_by.or(inside.limited_by), at: inside.unknowns }
    }

    /// Returns the quantity held at a value.
    pub(super) fn fixed_at(&self, value: f64) -> Fixed {
        Fixed { of: self.of, value, scale: self.scale, period: self.period }
    }

    /// Returns the root of the excess of χ² over the least, less that at the limit: for linear evidence it is linear in the quantity.
    fn root(&self, chi_square: f64) -> f64 {
        let profile = self.profile;
        let excess = chi_square - (profile.greatest - profile.quantile);
        // Not `max`, which would take a NaN for a best fit.
        let excess = if excess < 0.0 { 0.0 } else { excess };
        excess.sqrt() - profile.quantile.sqrt()
    }

    /// Returns the value at which the slope of the profile meets the limit, or the closest that can be.
    fn toward(&self, tried: &Tried) -> Option<f64> {
        match &tried.reached {
            Ok(reached) => {
                let root = self.root(reached.sum_of_squares);
                let slope = reached.fixed_multiplier / (self.scale * (root + self.profile.quantile.sqrt()));
                Some(tried.value - root / slope).filter(|value| value.is_finite())
            }
            Err(closest) => *closest,
        }
    }

    /// Finds the best fit with the quantity held at a value: from where the last two points lead, and unless that is within the limit, from the last point and the
    /// solutions.
    fn tried(&self, problem: &mut WithinLimits<'_>, inside: &Inside, value: f64) -> Tried {
        const ITERATIONS: usize = 60;
        /// Number of solutions from which it starts too.
        const OTHERS: usize = 3;
        let profile = self.profile;
        problem.hold(Some(self.fixed_at(value)));
        let spans = profile.released(Some(self.of));
        let others = profile.solutions.iter().take(OTHERS).cloned();
        let mut best: Option<Reached> = None;
        let mut closest: Option<f64> = None;
        let near = [inside.extrapolated(value), inside.unknowns.clone()].map(|start| (limited::SHORT, start));
        for (radius, start) in near.into_iter().chain(others.map(|start| (limited::LONG, start))) {
            match limited::minimum(problem, &start, &spans, radius, ITERATIONS, Until::Sum)
                .map(|reached| Reached { unknowns: profile.bounded(reached.unknowns.clone()), ..reached })
            {
                Ok(reached) if profile.model.solve(&reached.unknowns).is_ok() => {
                    let is_inside = reached.sum_of_squares <= profile.greatest;
                    if best.as_ref().is_none_or(|best| reached.sum_of_squares < best.sum_of_squares) {
                        best = Some(reached);
                    }
                    if is_inside {
                        break;
                    }
                }
                Ok(_) => (),
                Err(stopped) => {
                    // Where the start has no meaning, it stopped nowhere.
                    let got = (!stopped.is_empty())
                        .then(|| self.unwrapped(&stopped))
                        .flatten()
                        .filter(|at| (at - inside.value) * (value - at) > 0.0);
                    let is_closer = |at: &f64| closest.is_none_or(|closest| (at - value).abs() < (closest - value).abs());
                    closest = got.filter(is_closer).or(closest);
                }
            }
        }
        if let Some(best) = best {
            return Tried { value, reached: Ok(best) };
        }
        match self.nearly_held(value, inside, &spans) {
            Some((value, best)) => Tried { value, reached: Ok(best) },
            None => Tried { value, reached: Err(closest) },
        }
    }

    /// Finds the best fit with the quantity as evidence of a value, so sure that it is held for all purposes, and its own value of the quantity: where a measurand
    /// has no slope, as the direction of a velocity near zero, other searches fail. A point on the way to a fit is one that fits, too.
    fn nearly_held(&self, value: f64, inside: &Inside, spans: &[ParameterBounds]) -> Option<(f64, Reached)> {
        const ITERATIONS: usize = 60;
        /// Largest distance from the value, in standard deviations: the other evidence pulls by less, and the physics by more.
        const HELD: f64 = 0.1;
        let (model, solutions) = (self.profile.model, &self.profile.solutions);
        let sd = 0.1 * PRECISE * (value - self.value).abs();
        let mut question = model.question.clone();
        question.evidence.push(Evidence { of: self.of, value, uncertainty: Uncertainty::StandardDeviation(sd) });
        let held = Model::of(&question);
        let search = |start: &Vec<f64>| match least_squares::minimum(&held, start, spans, ITERATIONS) {
            Ok(minimum) => Some((minimum.unknowns, minimum.iterations)),
            Err(FitError::NotConverged(stopped)) => Some((stopped.unknowns, stopped.iterations)),
            Err(FitError::NoStart) => None,
        };
        let starts = [inside.extrapolated(value), inside.unknowns.clone()].into_iter().chain(solutions.iter().take(1).cloned());
        let fits = starts.filter_map(|start| search(&start)).filter_map(|(unknowns, iterations)| {
            let own = self.unwrapped(&unknowns)?;
            let off = (value - own) / sd;
            (off.abs() < HELD).then_some(())?;
            let sum_of_squares = model.at(&unknowns)?.iter().map(|residual| residual * residual).sum();
            let slopes = scaled(held.jacobian(&unknowns), spans).tr_mul(&DVector::from_vec(held.at(&unknowns)?));
            let at = |(x, span): (&f64, &ParameterBounds)| match *x {
                x if x == span.min => Some(Bound::Min),
                x if x == span.max => Some(Bound::Max),
                _ => None,
            };
            let reached = Reached {
                sum_of_squares,
                held: unknowns.iter().zip(spans).map(at).collect(),
                bound_multipliers: slopes.data.into(),
                margin_multipliers: Vec::new(),
                // The evidence pulls as the quantity that it holds would.
                fixed_multiplier: self.scale * off / sd,
                iterations,
                unknowns,
            };
            Some((own, reached))
        });
        fits.min_by(|(_, one), (_, other)| one.sum_of_squares.total_cmp(&other.sum_of_squares))
    }

    /// Returns the bound of another unknown, or the limit of the physics, that a fit presses against most.
    fn limit(&self, problem: &WithinLimits<'_>, reached: &Reached) -> Option<Limit> {
        /// Least derivative of ½χ² by a limit that matters.
        const MATTERS: f64 = 1e-6;
        let unknowns = &self.profile.model.question.unknowns;
        let held = reached.held.iter().zip(&self.profile.spans).map(|(held, span)| {
            held.filter(|held| match held {
                Bound::Min => span.min.is_finite(),
                Bound::Max => span.max.is_finite(),
            })
        });
        let of_bounds = held.zip(&reached.bound_multipliers).zip(unknowns).filter_map(|((held, multiplier), unknown)| {
            let limit = Limit::Bound(unknown.of, held?);
            (Measurand::Variable(unknown.of) != self.of).then_some((limit, multiplier.abs()))
        });
        let of_margins = reached.margin_multipliers.iter().enumerate().filter_map(|(k, multiplier)| Some((problem.limit(k)?, *multiplier)));
        let all = of_bounds.chain(of_margins).filter(|(_, multiplier)| *multiplier > MATTERS);
        all.max_by(|one, other| one.1.total_cmp(&other.1)).map(|(limit, _)| limit)
    }

    /// Returns the limit that a point is nearest to.
    fn near(&self, problem: &WithinLimits<'_>, point: &[f64]) -> Option<Limit> {
        /// Distance from a limit, in scales, that is none.
        const NEAR: f64 = 1e-3;
        let unknowns = self.profile.model.question.unknowns.iter().zip(point).zip(&self.profile.spans);
        let of_bounds = unknowns.filter(|((unknown, _), _)| Measurand::Variable(unknown.of) != self.of).flat_map(|((unknown, x), span)| {
            let to = |bound: f64, which| ((x - bound).abs() / span.scale, Limit::Bound(unknown.of, which));
            [to(span.min, Bound::Min), to(span.max, Bound::Max)]
        });
        let margins = problem.at(point).map(|local| local.margins.iter().copied().collect::<Vec<_>>()).unwrap_or_default();
        let of_margins = margins.into_iter().enumerate().filter_map(|(k, margin)| Some((margin.abs(), problem.limit(k)?)));
        // Where the vehicles hardly close, hardly an impulse acts and hardly any energy is lost.
        let order = |(distance, limit): &(f64, Limit)| if *limit == Limit::Closing { 0.0 } else { *distance };
        let near = of_bounds.chain(of_margins).filter(|(distance, _)| *distance < NEAR);
        near.min_by(|one, other| order(one).total_cmp(&order(other))).map(|(_, limit)| limit)
    }

    pub(super) fn interval(&self, [low, high]: &[End; 2], level: f64) -> Interval {
        /// Share of the range that is rounding.
        const NARROWER: f64 = 1e-6;
        Interval {
            of: self.of,
            value: self.value,
            sd: self.profile.sd(self.of),
            low: low.value,
            high: high.value,
            level,
            method: Method::Profile,
            low_limited_by: low.limited_by,
            high_limited_by: high.limited_by,
            narrows: (high.value - low.value) < (self.outer[1] - self.outer[0]) * (1.0 - NARROWER),
        }
    }
}

/// Returns `true` if the unknowns do not move a quantity, neither at the solutions nor about them.
fn is_constant(profile: &Profile<'_>, of: Measurand, value: f64, period: Option<f64>) -> bool {
    /// Number of points about each solution.
    const POINTS: usize = 24;
    let rounding = rounding(of, value);
    let mut random = ChaCha8Rng::seed_from_u64(1912);
    let mut moved = 0;
    for solution in &profile.solutions {
        for _ in 0..POINTS {
            let point: Vec<f64> = solution
                .iter()
                .zip(&profile.spans)
                .map(|(x, span)| (x + span.scale * random.random_range(-1.0..1.0)).clamp(span.min, span.max))
                .collect();
            let Some(there) = profile.value(of, &point) else { continue };
            let difference = there - value;
            if (difference - turns(difference, period)).abs() > rounding {
                return false;
            }
            moved += 1;
        }
    }
    // A few points that the mechanics accepts show nothing.
    moved >= POINTS / 4
}

/// Returns the largest difference from a value that is rounding, beside the value or a size that matters.
fn rounding(of: Measurand, value: f64) -> f64 {
    1e-10 * value.abs().max(of.least_size())
}
