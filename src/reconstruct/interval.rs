//! Intervals by profile likelihood (Venzon and Moolgavkar 1988).
//!
//! The interval of a quantity is the range over which the best fit of everything else, within all bounds and the limits of the physics, stays within a quantile
//! of χ² of the least one. Each end is followed outwards from a solution, so that it may lie at the far end of a curved valley, and the interval of several
//! solutions covers those of each.

use nalgebra::DMatrix;
use statrs::distribution::{ChiSquared, ContinuousCDF};

use super::given::{ReconstructionProblem, Unknown};
use super::limit::Limit;
use super::measurand::Measurand;
use super::residuals::Model;
use super::search::spans;
use super::variable::turns;
use super::verdict::Answer;
use super::within_limits::{Fixed, WithinLimits};
use crate::input::Side;
use crate::least_squares::limited::{self, Limited, Reached, Until};
use crate::least_squares::{Bound, ParameterBounds, scaled};
use crate::output::Output;

/// Precision of an end, as a share of its distance from the value.
const PRECISE: f64 = 2e-4;

/// Largest number of solutions from which ends are followed, the best first.
const SOLUTIONS: usize = 8;

/// The method that found an interval.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Method {
    /// The profile of the likelihood.
    Profile,
}

/// The range of a quantity that the evidence, the bounds and the physics allow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// Its quantity.
    pub of: Measurand,
    /// Its value at the best solution, in SI.
    pub value: f64,
    /// Its standard deviation from those of the unknowns; `None` where one of them has none.
    pub sd: Option<f64>,
    /// Its lower end, in SI; −∞ if nothing limits it. An angle is not wrapped: its ends enclose the value.
    pub low: f64,
    /// Its upper end, in SI; ∞ if nothing limits it.
    pub high: f64,
    /// The probability with which such intervals contain the true value.
    pub level: f64,
    /// The method that found it.
    pub method: Method,
    /// A bound or a limit of the physics that makes the lower end; `None` if the evidence alone does.
    pub low_limited_by: Option<Limit>,
    /// A bound or a limit of the physics that makes the upper end.
    pub high_limited_by: Option<Limit>,
    /// `true` if it is narrower than the range that the bounds of the unknown alone allow, or than a whole turn.
    pub narrows: bool,
}

impl Method {
    /// Returns its name.
    pub fn name(self) -> &'static str {
        match self {
            Method::Profile => "profile",
        }
    }
}

impl ReconstructionProblem {
    /// Returns the intervals of quantities at a level of confidence, such as 0.95, around the solutions of an answer to this problem. A quantity that the
    /// collision does not have is left out.
    ///
    /// ```
    /// use planar_impact::reconstruct::*;
    /// use planar_impact::*;
    ///
    /// let car = Vehicle::new(1500.0, 2500.0).with_impact_center(2.0, 0.3).with_speed(13.0);
    /// let collision = Collision::new(car, Party::Barrier).with_restitution(0.1);
    /// let after = collision.solve()?.one;
    /// // A speed from a change of velocity and a yaw rate, with a restitution of which only the range is known.
    /// let problem = ReconstructionProblem::of(collision)
    ///     .unknown(Variable::Speed(Side::One), 15.0)
    ///     .between(Variable::Input(Input::Restitution), 0.1, 0.0, 0.3)
    ///     .evidence(Measurand::DeltaVForward(Side::One), after.delta_v_in_vehicle.forward, Uncertainty::StandardDeviation(0.5))
    ///     .evidence(Measurand::Output(Output::YawRate(Side::One)), after.after.yaw_rate, Uncertainty::StandardDeviation(0.2));
    /// let answer = problem.solve(&Search::default())?;
    /// let [speed] = problem.intervals(&answer, 0.95, &[Measurand::Variable(Variable::Speed(Side::One))])[..] else { panic!() };
    /// assert!(speed.low < 11.0 && speed.high > 14.3);
    /// assert_eq!(speed.low_limited_by.map(Limit::name).as_deref(), Some("contact.restitution max"));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Panics
    ///
    /// If the level is not between 0 and 1.
    pub fn intervals(&self, answer: &Answer, level: f64, of: &[Measurand]) -> Vec<Interval> {
        assert!(level > 0.0 && level < 1.0, "the level of an interval is between 0 and 1, and not {level}");
        let model = Model::of(self);
        let Some(profile) = Profile::of(&model, spans(self), answer, level) else { return Vec::new() };
        profile.intervals(of, level)
    }

    /// Returns what is derived from the unknowns and asked for most: ΔV and principal direction of force of each vehicle, closing speed, energies, ratio.
    pub fn derived(&self) -> impl Iterator<Item = Measurand> + use<> {
        let of_vehicles =
            [Side::One, Side::Two].into_iter().flat_map(|side| [Output::DeltaVMagnitude(side), Output::PrincipalDirectionOfForce(side)]);
        let of_contact = [Output::Loss, Output::NormalWork, Output::TangentialWork, Output::ImpulseRatio];
        let outputs = of_vehicles.chain(of_contact).map(Measurand::Output);
        let collision = self.collision;
        [Measurand::ClosingSpeed].into_iter().chain(outputs).filter(move |of| of.is_in(&collision))
    }
}

/// A point whose χ² is within the limit.
#[derive(Clone, Debug)]
struct Point {
    unknowns: Vec<f64>,
    chi_square: f64,
}

/// The likelihood around the solutions.
struct Profile<'a> {
    model: &'a Model<'a>,
    spans: Vec<ParameterBounds>,
    solutions: Vec<Point>,
    /// The covariance of the unknowns at the best solution; `None` if one of them has no standard deviation.
    covariance: Option<DMatrix<f64>>,
    /// The largest χ² within the interval.
    greatest: f64,
    /// Its excess over the least.
    quantile: f64,
}

/// One end of an interval.
#[derive(Clone, Debug)]
struct End {
    value: f64,
    limited_by: Option<Limit>,
    at: Point,
}

/// The best fit with the quantity held at a value.
struct Tried {
    value: f64,
    /// `Err` if it does not get that value, with the closest one that it got, if any.
    reached: Result<Reached, Option<f64>>,
}

impl<'a> Profile<'a> {
    fn of(model: &'a Model<'a>, spans: Vec<ParameterBounds>, answer: &Answer, level: f64) -> Option<Self> {
        let quantile = ChiSquared::new(1.0).ok()?.inverse_cdf(level);
        let point = |solution: &super::Solution| Point {
            unknowns: solution.unknowns.iter().map(|estimate| estimate.value).collect(),
            chi_square: solution.chi_square,
        };
        let greatest = answer.best().chi_square + quantile;
        let all = answer.solutions.iter().chain(&answer.worse).map(point);
        // Where a measurand has no slope, such as the direction of a velocity near zero, searches end in many places close to each other.
        let solutions = all.filter(|point| point.chi_square <= greatest).take(SOLUTIONS).collect();
        Some(Profile { model, spans, solutions, covariance: covariance(answer.best()), greatest, quantile })
    }

    fn intervals(&self, of: &[Measurand], level: f64) -> Vec<Interval> {
        /// Number of times that the ends of one interval extend another.
        const ROUNDS: usize = 3;
        let of = of.iter().copied().filter(|of| of.is_in(&self.model.question.collision));
        let quantities: Vec<Quantity<'_>> = of.filter_map(|of| self.quantity(of)).collect();
        let mut ends: Vec<Option<[End; 2]>> = quantities.iter().map(|quantity| quantity.around(&self.solutions)).collect();
        // The end of one interval may show that another is wider.
        for _ in 0..ROUNDS {
            let reached: Vec<Point> = ends.iter().flatten().flatten().map(|end| end.at.clone()).collect();
            for (quantity, ends) in quantities.iter().zip(&mut ends) {
                let Some(ends) = ends else { continue };
                for point in &reached {
                    quantity.extend(ends, point);
                }
            }
        }
        let interval = |(quantity, ends): (&Quantity<'_>, Option<[End; 2]>)| ends.map(|ends| quantity.interval(&ends, level));
        quantities.iter().zip(ends).filter_map(interval).collect()
    }

    fn quantity(&'a self, of: Measurand) -> Option<Quantity<'a>> {
        let value = self.value(of, &self.solutions.first()?.unknowns)?;
        let variable = self.model.question.unknowns.iter().position(|unknown| Measurand::Variable(unknown.of) == of);
        let scale = variable.map_or_else(|| (0.1 * value.abs()).max(0.1 * of.least_size()), |i| self.spans[i].scale);
        let bounds = variable.map_or([f64::NEG_INFINITY, f64::INFINITY], |i| [self.spans[i].min, self.spans[i].max]);
        // An angle without bounds repeats itself after half a turn to either side.
        let half_turn = of.period().filter(|_| bounds.iter().any(|bound| bound.is_infinite())).map_or(f64::INFINITY, |period| period / 2.0);
        let outer = [(value - half_turn).max(bounds[0]), (value + half_turn).min(bounds[1])];
        Some(Quantity { profile: self, of, value, scale, period: of.period().filter(|_| variable.is_none()), outer, bounds })
    }

    /// Returns the standard deviation of a quantity at the best solution, to first order.
    fn sd(&self, of: Measurand) -> Option<f64> {
        let point = &self.solutions.first()?.unknowns;
        let (placed, impact) = self.model.solve(point).ok()?;
        let (_, slope) = WithinLimits::around(self.model, &placed, &impact).slopes_of(of, point)?;
        Some((&slope * self.covariance.as_ref()? * slope.transpose())[(0, 0)].sqrt())
    }

    /// Returns the value of a quantity at a point that the mechanics accepts.
    fn value(&self, of: Measurand, unknowns: &[f64]) -> Option<f64> {
        let (placed, impact) = self.model.solve(unknowns).ok()?;
        of.of(&placed, &impact)
    }
}

fn covariance(solution: &super::Solution) -> Option<DMatrix<f64>> {
    let n = solution.unknowns.len();
    let has_all = solution.unknowns.iter().all(|estimate| estimate.sd.is_some());
    has_all.then(|| DMatrix::from_fn(n, n, |i, k| solution.covariance.get(i, k)))
}

/// A quantity whose interval is wanted.
struct Quantity<'a> {
    profile: &'a Profile<'a>,
    of: Measurand,
    /// Its value at the best solution.
    value: f64,
    scale: f64,
    /// The period of an angle that is computed.
    period: Option<f64>,
    /// The farthest values to look at: bounds, or half a turn away.
    outer: [f64; 2],
    bounds: [f64; 2],
}

/// The way outwards, as far as it is within the limit.
struct Inside {
    value: f64,
    point: Point,
    before: Option<(f64, Vec<f64>)>,
    limited_by: Option<Limit>,
}

impl Inside {
    fn advance(&mut self, value: f64, reached: &Reached, limited_by: Option<Limit>) {
        let point = Point { unknowns: reached.unknowns.clone(), chi_square: reached.sum_of_squares };
        self.before = Some((self.value, std::mem::replace(&mut self.point, point).unknowns));
        (self.value, self.limited_by) = (value, limited_by);
    }

    /// Returns the point to which the last two lead.
    fn extrapolated(&self, value: f64) -> Vec<f64> {
        let Some((before, unknowns)) = &self.before else { return self.point.unknowns.clone() };
        let share = (value - self.value) / (self.value - before);
        self.point.unknowns.iter().zip(unknowns).map(|(here, before)| here + share * (here - before)).collect()
    }
}

impl Quantity<'_> {
    /// Returns the ends that enclose those around each solution.
    fn around(&self, solutions: &[Point]) -> Option<[End; 2]> {
        let ends = |point: &Point| {
            let value = self.unwrapped(point)?;
            Some([-1.0, 1.0].map(|direction| self.end(direction, point, value)))
        };
        solutions.iter().filter_map(ends).reduce(|[low, high], [other_low, other_high]| {
            [if other_low.value < low.value { other_low } else { low }, if other_high.value > high.value { other_high } else { high }]
        })
    }

    /// Follows an end from a point that lies beyond it.
    fn extend(&self, ends: &mut [End; 2], point: &Point) {
        /// Share of the width by which a point must lie beyond.
        const BEYOND: f64 = 1e-3;
        let Some(value) = self.unwrapped(point) else { return };
        let width = ends[1].value - ends[0].value;
        for (end, direction) in ends.iter_mut().zip([-1.0, 1.0]) {
            if direction * (value - end.value) > BEYOND * width {
                *end = self.end(direction, point, value);
            }
        }
    }

    /// Returns the value at a point; for an angle the turn next to the best one.
    fn unwrapped(&self, point: &Point) -> Option<f64> {
        let value = self.profile.value(self.of, &point.unknowns)?;
        Some(value - turns(value - self.value, self.period))
    }

    /// Follows the best fit outwards from a point to the value at which χ² reaches its limit, or to what stops it.
    fn end(&self, direction: f64, start: &Point, value: f64) -> End {
        /// Largest number of steps outwards, each twice the last.
        const STEPS: usize = 60;
        let profile = self.profile;
        let Ok((placed, impact)) = profile.model.solve(&start.unknowns) else {
            return End { value, limited_by: None, at: start.clone() };
        };
        let mut problem = WithinLimits::around(profile.model, &placed, &impact);
        let outer = self.outer[usize::from(direction > 0.0)];
        let mut inside = Inside { value, point: start.clone(), before: None, limited_by: None };
        let mut length = self.first_step(&problem, &start.unknowns);
        for _ in 0..STEPS {
            let next = inside.value + direction * length;
            let next = if direction * (next - outer) > 0.0 { outer } else { next };
            if direction * (next - inside.value) <= 0.0 {
                return self.at_outer(inside, outer);
            }
            let tried = self.tried(&mut problem, &inside, next, true);
            let Ok(reached) = &tried.reached else { return self.between(&mut problem, inside, tried) };
            let root = self.root(reached.sum_of_squares);
            if root > PRECISE * profile.quantile.sqrt() {
                return self.between(&mut problem, inside, tried);
            }
            inside.advance(next, reached, self.limit(&problem, reached));
            if root.abs() <= PRECISE * profile.quantile.sqrt() {
                return End { value: next, limited_by: inside.limited_by, at: inside.point };
            }
            // A little beyond where the slope leads, so that the next point encloses the end.
            let wanted = self.toward(&tried).map_or(f64::INFINITY, |value| 1.02 * direction * (value - next));
            length = if wanted > 0.0 { wanted.min(4.0 * length) } else { 2.0 * length };
        }
        End { value: direction * f64::INFINITY, limited_by: None, at: inside.point }
    }

    /// Returns how far the quantity would go if the evidence were linear in the unknowns.
    fn first_step(&self, problem: &WithinLimits<'_>, unknowns: &[f64]) -> f64 {
        /// The longest first step, in scales.
        const LONGEST: f64 = 20.0;
        let longest = LONGEST * self.scale;
        let slopes = problem.slopes_of(self.of, unknowns);
        let Some((jacobian, slope)) = slopes else { return longest };
        let jacobian = scaled(jacobian, &self.profile.spans);
        let slope = scaled(slope, &self.profile.spans).transpose();
        let stiff = jacobian.tr_mul(&jacobian) + DMatrix::identity(jacobian.ncols(), jacobian.ncols()) * 1e-9;
        let Some(factor) = stiff.cholesky() else { return longest };
        let sd = slope.dot(&factor.solve(&slope)).sqrt();
        let length = sd * self.profile.quantile.sqrt();
        if length > 0.0 { length.min(longest) } else { 1e-3 * self.scale }
    }

    /// Returns the end at a bound of the quantity, or half a turn away.
    fn at_outer(&self, inside: Inside, outer: f64) -> End {
        let limit = match self.of {
            Measurand::Variable(of) if outer == self.bounds[0] => Limit::Bound(of, Bound::Min),
            Measurand::Variable(of) if outer == self.bounds[1] => Limit::Bound(of, Bound::Max),
            _ => Limit::Period,
        };
        End { value: outer, limited_by: Some(limit), at: inside.point }
    }

    /// Narrows the end down between a value within the limit and one beyond it, or beyond what can be.
    fn between(&self, problem: &mut WithinLimits<'_>, mut inside: Inside, mut outside: Tried) -> End {
        const STEPS: usize = 40;
        let profile = self.profile;
        let mut guess = self.toward(&outside);
        let mut limited_by = None;
        for step in 0..STEPS {
            let (near, far) = (inside.value, outside.value);
            let tolerance = PRECISE * (far - self.value).abs();
            if (far - near).abs() <= tolerance {
                break;
            }
            // Two thirds of the steps go where the slope of the profile leads; bisection in between keeps the bracket shrinking.
            let is_between = |value: f64| (value - near) * (far - value) > 0.0;
            let value = guess.filter(|value| step % 3 != 2 && is_between(*value)).unwrap_or(near + (far - near) / 2.0);
            let tried = self.tried(problem, &inside, value, false);
            guess = self.toward(&tried);
            match &tried.reached {
                Ok(reached) => {
                    let excess = self.root(reached.sum_of_squares);
                    if excess <= 0.0 {
                        inside.advance(value, reached, self.limit(problem, reached));
                    }
                    if excess.abs() <= PRECISE * profile.quantile.sqrt() {
                        let limited_by = self.limit(problem, reached);
                        let point = Point { unknowns: reached.unknowns.clone(), chi_square: reached.sum_of_squares };
                        return End { value, limited_by, at: point };
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
            limited_by = self.near(problem, &inside.point);
        }
        End { value: inside.value, limited_by: limited_by.or(inside.limited_by), at: inside.point }
    }

    /// Returns the spans without the bounds of the quantity itself, whose value is held.
    fn released(&self) -> Vec<ParameterBounds> {
        let unknowns = &self.profile.model.question.unknowns;
        let free = |span: &ParameterBounds| ParameterBounds { min: f64::NEG_INFINITY, max: f64::INFINITY, ..*span };
        let span =
            |(span, unknown): (&ParameterBounds, &Unknown)| if Measurand::Variable(unknown.of) == self.of { free(span) } else { *span };
        self.profile.spans.iter().zip(unknowns).map(span).collect()
    }

    /// Returns a point whose quantity, held at a bound, has not left it by rounding.
    fn bounded(&self, mut reached: Reached) -> Reached {
        reached.unknowns.iter_mut().zip(&self.profile.spans).for_each(|(x, span)| *x = x.clamp(span.min, span.max));
        reached
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

    /// Finds the best fit with the quantity held at a value: from where the last two points lead, and if that fails, or all are asked, from the last point and
    /// the solutions.
    fn tried(&self, problem: &mut WithinLimits<'_>, inside: &Inside, value: f64, all: bool) -> Tried {
        const ITERATIONS: usize = 60;
        /// Number of solutions from which it starts too.
        const OTHERS: usize = 3;
        let profile = self.profile;
        problem.hold(Some(Fixed { of: self.of, value, scale: self.scale, period: self.period }));
        let spans = self.released();
        let others = profile.solutions.iter().take(OTHERS).map(|point| point.unknowns.clone());
        let mut best: Option<Reached> = None;
        let mut closest: Option<f64> = None;
        for start in [inside.extrapolated(value), inside.point.unknowns.clone()].into_iter().chain(others) {
            match limited::minimum(problem, &start, &spans, ITERATIONS, Until::Sum).map(|reached| self.bounded(reached)) {
                Ok(reached) if profile.model.solve(&reached.unknowns).is_ok() => {
                    let is_inside = reached.sum_of_squares <= profile.greatest;
                    if best.as_ref().is_none_or(|best| reached.sum_of_squares < best.sum_of_squares) {
                        best = Some(reached);
                    }
                    if is_inside || !all {
                        break;
                    }
                }
                Ok(_) => (),
                Err(stopped) => {
                    let point = Point { unknowns: stopped, chi_square: f64::NAN };
                    let got = self.unwrapped(&point).filter(|at| (at - inside.value) * (value - at) > 0.0);
                    let is_closer = |at: &f64| closest.is_none_or(|closest| (at - value).abs() < (closest - value).abs());
                    closest = got.filter(is_closer).or(closest);
                }
            }
        }
        Tried { value, reached: best.ok_or(closest) }
    }

    /// Returns the bound of another unknown, or the limit of the physics, that a fit presses against most.
    fn limit(&self, problem: &WithinLimits<'_>, reached: &Reached) -> Option<Limit> {
        /// Least derivative of ½χ² by a limit that matters.
        const MATTERS: f64 = 1e-6;
        let unknowns = &self.profile.model.question.unknowns;
        let of_bounds = reached.held.iter().zip(&reached.bound_multipliers).zip(unknowns).filter_map(|((held, multiplier), unknown)| {
            let limit = Limit::Bound(unknown.of, (*held)?);
            (Measurand::Variable(unknown.of) != self.of).then_some((limit, multiplier.abs()))
        });
        let of_margins = reached.margin_multipliers.iter().enumerate().map(|(k, multiplier)| (problem.limit(k), *multiplier));
        let all = of_bounds.chain(of_margins).filter(|(_, multiplier)| *multiplier > MATTERS);
        all.max_by(|one, other| one.1.total_cmp(&other.1)).map(|(limit, _)| limit)
    }

    /// Returns the limit that a point is nearest to.
    fn near(&self, problem: &WithinLimits<'_>, point: &Point) -> Option<Limit> {
        /// Distance from a limit, in scales, that is none.
        const NEAR: f64 = 1e-3;
        let unknowns = self.profile.model.question.unknowns.iter().zip(&point.unknowns).zip(&self.profile.spans);
        let of_bounds = unknowns.filter(|((unknown, _), _)| Measurand::Variable(unknown.of) != self.of).flat_map(|((unknown, x), span)| {
            let to = |bound: f64, which| ((x - bound).abs() / span.scale, Limit::Bound(unknown.of, which));
            [to(span.min, Bound::Min), to(span.max, Bound::Max)]
        });
        let margins = problem.at(&point.unknowns).map(|local| local.margins.iter().copied().collect::<Vec<_>>()).unwrap_or_default();
        let of_margins = margins.into_iter().enumerate().map(|(k, margin)| (margin.abs(), problem.limit(k)));
        let near = of_bounds.chain(of_margins).filter(|(distance, _)| *distance < NEAR);
        near.min_by(|one, other| one.0.total_cmp(&other.0)).map(|(_, limit)| limit)
    }

    fn interval(&self, [low, high]: &[End; 2], level: f64) -> Interval {
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
