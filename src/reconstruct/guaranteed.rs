//! Guaranteed ranges of the unknowns: set inversion (Jaulin and Walter 1993).
//!
//! What is known of the crash is a set of equations, f(x) = y + s: each piece of evidence holds with an error s within its limits, zero if it is exact. The
//! range of an unknown is that of its values over every x within its limits and every s within its own that meet all equations. The box of all of them is
//! divided into cells in the order of the unknown's least value. A cell is narrowed by the theorem of the mean, solved for one number after the other with the
//! derivatives over the cell as intervals, and dropped if it cannot meet an equation or physics refuses all of it. What is dropped holds no answer, whatever
//! the rounding; the values that are attained are those of points that f64 solves for.

use core::cmp::Ordering;
use core::f64::consts::{PI, TAU};
use core::fmt;
use std::collections::BinaryHeap;

use nalgebra::{DMatrix, DVector};

use super::given::{Evidence, ReconstructionProblem, Uncertainty};
use super::issue::ReconstructionIssues;
use super::measurand::Measurand;
use super::placed::Placed;
use super::scene::Scene;
use super::variable::{Variable, party};
use crate::frame::Xy;
use crate::impact::Impact;
use crate::input::{Input, Side};
use crate::scalar::interval::Interval;
use crate::scalar::{Ordered, Real};
use crate::sensitivity::dual::Dual;

/// Settings of a search for guaranteed ranges.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GuaranteedSearch {
    /// Accepted distance between an end and the attained value, as a share of the greater magnitude of the attained values, or of a significant change of the
    /// unknown.
    pub gap: f64,
    /// Number of cells that may be divided for each unknown.
    pub cells: usize,
    /// Limit of every error and every prior that has a standard deviation and no limits of its own, in standard deviations.
    pub deviations: f64,
}

impl Default for GuaranteedSearch {
    /// A gap of 10⁻⁶, a hundred thousand cells, and three standard deviations.
    fn default() -> Self {
        GuaranteedSearch { gap: 1e-6, cells: 100_000, deviations: 3.0 }
    }
}

/// The guaranteed range of an unknown, in SI and radians.
///
/// `low` ≤ least value that meets the evidence ≤ `low_attained`, and in the same way for the greatest one; the attained values meet exact evidence to the
/// rounding of f64.
#[derive(Clone, Debug, PartialEq)]
pub struct GuaranteedRange {
    /// The unknown.
    pub of: Variable,
    /// No value that meets the evidence is below it.
    pub low: f64,
    /// No value that meets the evidence is above it.
    pub high: f64,
    /// Least value found.
    pub low_attained: f64,
    /// Greatest value found.
    pub high_attained: f64,
    /// The unknowns, in their order, where the least value is attained.
    pub at_low: Vec<f64>,
    /// The unknowns, in their order, where the greatest value is attained.
    pub at_high: Vec<f64>,
    /// Whether both ends are within the gap of the attained values.
    pub is_tight: bool,
    /// Number of cells that were divided.
    pub cells: usize,
}

/// Reason why there is no guaranteed range.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum NoRange {
    /// The problem is not well posed.
    Problem(ReconstructionIssues),
    /// An unknown has no limits, so that no range of it would be found in a finite time.
    NoLimits(Variable),
    /// Nothing within the limits meets the evidence.
    Excluded,
    /// The number of cells did not suffice to find anything that meets the evidence, although something may.
    NoPoint {
        /// Number of cells that were divided.
        cells: usize,
    },
}

impl fmt::Display for NoRange {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            NoRange::Problem(issues) => write!(f, "{issues}"),
            NoRange::NoLimits(of) => write!(f, "{} has no limits, which a guaranteed range takes; give min and max", of.name()),
            NoRange::Excluded => {
                write!(
                    f,
                    "proven: nothing within the limits of the unknowns and of the errors meets the evidence; widen the limits, or check the evidence"
                )
            }
            NoRange::NoPoint { cells } => {
                write!(f, "nothing that meets the evidence was found in {cells} trials; narrow the limits of the unknowns, or allow more")
            }
        }
    }
}

impl core::error::Error for NoRange {}

/// Greatest speed without limits that is searched, in m/s, and greatest yaw rate in rad/s: beyond those of any road vehicle.
const FASTEST: f64 = 200.0;
const FASTEST_TURN: f64 = 50.0;

/// Width, as a share of the whole, below which a cell is not divided.
const SMALLEST: f64 = 1e-12;

/// Cells between two questions whether the search goes on.
const STRIDE: usize = 64;

impl ReconstructionProblem {
    /// Computes the guaranteed range of each unknown: of everything that meets exact evidence exactly, readings within half of their step, and other evidence
    /// within some standard deviations. The number of unknowns may exceed that of the evidence.
    ///
    /// An unknown is searched within its bounds, or those of its prior. A speed without bounds is searched up to 200 m/s, and a yaw rate up to 50 rad/s, either
    /// way. `goes_on` is called now and then with the number of cells divided so far; if it returns `false` the search ends with the ranges that it has.
    ///
    /// ```
    /// use planar_impact::reconstruct::*;
    /// use planar_impact::*;
    /// // The crush took 60 kJ, and the restitution is between 0 and 0.3: how fast was the car?
    /// let car = Vehicle::new(1500.0, 2500.0).with_impact_center(2.0, 0.0).with_speed(10.0);
    /// let problem = ReconstructionProblem::of(Collision::new(car, Party::Barrier))
    ///     .unknown(Variable::Speed(Side::One), 10.0)
    ///     .between(Variable::Input(Input::Restitution), 0.1, 0.0, 0.3)
    ///     .evidence(Measurand::CrushEnergy, 60e3, Uncertainty::Exact);
    /// let [speed, _] = &problem.guaranteed(&GuaranteedSearch::default(), &|_| true)?[..] else { panic!() };
    /// // ½ m v² (1 − e²) = E
    /// assert!((speed.low - 80_f64.sqrt()).abs() < 1e-4 && (speed.high - (80.0_f64 / 0.91).sqrt()).abs() < 1e-4);
    /// assert!(speed.is_tight && speed.low <= speed.low_attained && speed.high_attained <= speed.high);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`NoRange`]: a problem that is not well posed, an unknown without limits, or evidence that nothing within the limits meets.
    pub fn guaranteed(&self, search: &GuaranteedSearch, goes_on: &dyn Fn(usize) -> bool) -> Result<Vec<GuaranteedRange>, NoRange> {
        let equations = Equations::of(self, search)?;
        let mut spent = 0;
        let mut found = Vec::with_capacity(self.unknowns.len());
        for place in 0..self.unknowns.len() {
            let range = equations.range(place, search, &|cells| goes_on(spent + cells))?;
            spent += range.cells;
            found.push(range);
        }
        Ok(found)
    }
}

/// The equations, and the box of the numbers that are sought: the unknowns, then the errors.
struct Equations<'a> {
    problem: &'a ReconstructionProblem,
    scene: Scene,
    /// The equation that each error belongs to.
    errors: Vec<usize>,
    whole: Vec<Interval>,
}

/// What a piece of evidence says: its residual is zero, and what is ahead is not negative.
struct Statement<T> {
    residual: T,
    ahead: T,
}

/// Residuals over a cell.
struct Residuals {
    of: Vec<Interval>,
    /// Whether a point of the cell may meet every piece of evidence, and physics accept it.
    may_hold: bool,
    /// Whether no residual jumps.
    is_continuous: bool,
}

/// A point that meets every equation.
#[derive(Clone)]
struct Attained {
    point: Vec<f64>,
    value: f64,
}

struct Cell {
    ranges: Vec<Interval>,
    bound: f64,
    /// The number to divide, or `None` if the cell is too small.
    divide: Option<usize>,
}

impl Ord for Cell {
    /// The cell with the least bound is the greatest: it comes first.
    fn cmp(&self, other: &Self) -> Ordering {
        other.bound.total_cmp(&self.bound)
    }
}

impl PartialOrd for Cell {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Cell {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Cell {}

fn middle_of(range: Interval) -> f64 {
    (0.5 * range.lower() + 0.5 * range.upper()).clamp(range.lower(), range.upper())
}

fn intersection(one: Interval, other: Interval) -> Option<Interval> {
    Interval::new(one.lower().max(other.lower()), one.upper().min(other.upper()))
}

/// Returns the limits of an error, rounded outward.
fn within(limit: f64) -> Interval {
    let limit = limit.next_up();
    Interval::new(-limit, limit).unwrap_or(Interval::ENTIRE)
}

impl<'a> Equations<'a> {
    fn of(problem: &'a ReconstructionProblem, search: &GuaranteedSearch) -> Result<Self, NoRange> {
        problem.check_parts().map_err(NoRange::Problem)?;
        let mut whole = Vec::with_capacity(problem.unknowns.len());
        for unknown in &problem.unknowns {
            let (least, greatest) = unknown.of.domain(&problem.collision);
            let beyond = match unknown.of {
                Variable::Speed(_) | Variable::Input(Input::VelocityX(_) | Input::VelocityY(_)) => FASTEST,
                Variable::SkidSpeed(_) => FASTEST,
                Variable::Input(Input::YawRate(_)) => FASTEST_TURN,
                Variable::Input(Input::Heading(_)) => PI,
                // That of such a change of velocity.
                Variable::Impulse(_) => 2.0 * FASTEST * unknown.of.scale(&problem.collision, unknown.start),
                _ => f64::INFINITY,
            };
            let around = |center: f64, by: f64| (center - by, center + by);
            let of_prior = unknown.prior.map_or((f64::NEG_INFINITY, f64::INFINITY), |sd| around(unknown.start, search.deviations * sd));
            let low = unknown.min.unwrap_or(least.max(of_prior.0).max(-beyond));
            let high = unknown.max.unwrap_or(greatest.min(of_prior.1).min(beyond));
            let range = Interval::new(low, high).filter(|_| low.is_finite() && high.is_finite());
            whole.push(range.ok_or(NoRange::NoLimits(unknown.of))?);
        }
        let mut errors = Vec::new();
        for (place, evidence) in problem.evidence.iter().enumerate() {
            let limit = match evidence.uncertainty {
                Uncertainty::Exact => continue,
                Uncertainty::Resolution(step) => 0.5 * step,
                Uncertainty::StandardDeviation(sd) => search.deviations * sd,
            };
            errors.push(place);
            whole.push(within(limit));
        }
        Ok(Equations { problem, scene: Scene::of(problem), errors, whole })
    }

    fn unknowns(&self) -> usize {
        self.problem.unknowns.len()
    }

    /// Returns what a piece of evidence says with an error.
    ///
    /// Angles are stated by the sine of their difference and its cosine, and lengths by their squares: these have derivatives everywhere.
    fn statement<T: Real + Copy + From<f64>>(&self, evidence: &Evidence, error: T, placed: &Placed<T>, impact: &Impact<T>) -> Statement<T> {
        use Measurand::*;
        let sought = T::from(evidence.value) + error;
        let after = |side| match side {
            Side::One => &impact.one,
            Side::Two => &impact.two,
        };
        let squared = |length: T| Statement { residual: length - sought.squared(), ahead: sought };
        let along = |y: T, x: T| {
            let (sin, cos) = sought.sin_and_cos();
            Statement { residual: y * cos - x * sin, ahead: x * cos + y * sin }
        };
        // The check has asked whether the collision has it.
        let value = |of: Measurand| of.of(placed, impact).unwrap_or(T::int(0));
        match evidence.of {
            Output(crate::output::Output::DeltaVMagnitude(side)) => {
                let delta_v = after(side).delta_v;
                squared(delta_v.x.magnitude().squared() + delta_v.y.magnitude().squared())
            }
            SeparationSpeed(side) => {
                let velocity = after(side).after.velocity;
                squared(velocity.x.magnitude().squared() + velocity.y.magnitude().squared())
            }
            EquivalentEnergySpeed(side) => {
                let mass = party(&placed.collision, side).vehicle().map_or(T::int(1), |vehicle| vehicle.mass);
                squared(value(CrushEnergyOf(side)) * T::int(2) / mass)
            }
            Output(crate::output::Output::PrincipalDirectionOfForce(side)) => {
                let force = after(side).force_direction();
                along(force.right, force.ahead)
            }
            SeparationDirection(side) => {
                let velocity = after(side).after.velocity;
                along(velocity.y, velocity.x)
            }
            ApproachDirection(side) => {
                let velocity = party(&placed.collision, side).vehicle().map_or(Xy::zero(), |vehicle| vehicle.motion.velocity);
                along(velocity.y, velocity.x)
            }
            of => match of.period() {
                Some(period) => {
                    let (sin, cos) = (value(of) - sought).sin_and_cos();
                    Statement { residual: sin, ahead: if period < TAU { T::int(1) } else { cos } }
                }
                None => Statement { residual: value(of) - sought, ahead: T::int(1) },
            },
        }
    }

    /// Returns what each piece of evidence says of numbers.
    fn statements<'s, T: Real + Copy + From<f64>>(
        &'s self,
        numbers: &'s [T],
        placed: &'s Placed<T>,
        impact: &'s Impact<T>,
    ) -> impl Iterator<Item = Statement<T>> + 's {
        let error =
            |place: usize| self.errors.iter().position(|of| *of == place).map_or(T::int(0), |error| numbers[self.unknowns() + error]);
        self.problem.evidence.iter().enumerate().map(move |(place, evidence)| self.statement(evidence, error(place), placed, impact))
    }

    /// Returns the residuals over a cell.
    fn over(&self, cell: &[Interval]) -> Residuals {
        let placed = self.scene.place(&cell[..self.unknowns()]);
        let contact = placed.collision.contact();
        let impact = placed.impact_at(&contact);
        let is_excluded = placed.impulse.is_none() && placed.collision.is_possible_exactly(&contact, &impact).is_excluded();
        let mut may_hold = !is_excluded;
        let mut of = Vec::with_capacity(self.problem.evidence.len());
        for Statement { residual, ahead } in self.statements(cell, &placed, &impact) {
            may_hold &= residual.contains(0.0) && ahead.upper() >= 0.0;
            of.push(residual);
        }
        Residuals { of, may_hold, is_continuous: !placed.collision.friction_may_reverse(&contact) }
    }

    /// Returns the residuals with their derivatives by each number, a row for each.
    fn slopes<T: Real + Copy + From<f64>>(&self, at: &[T]) -> Vec<Vec<Dual<T>>>
    where
        Dual<T>: Real,
    {
        let mut rows: Vec<Vec<Dual<T>>> = self.problem.evidence.iter().map(|_| Vec::with_capacity(at.len())).collect();
        let mut numbers: Vec<Dual<T>> = at.iter().copied().map(Dual::constant).collect();
        for by in 0..numbers.len() {
            numbers[by].derivative = T::int(1);
            let placed = self.scene.place(&numbers[..self.unknowns()]);
            let impact = placed.evaluate();
            for (row, statement) in rows.iter_mut().zip(self.statements(&numbers, &placed, &impact)) {
                row.push(statement.residual);
            }
            numbers[by].derivative = T::int(0);
        }
        rows
    }

    /// Returns `true` if a point is within the limits, evidence is the right way round there, and physics accepts it.
    fn accepts(&self, point: &[f64]) -> bool {
        let placed = self.scene.place(&point[..self.unknowns()]);
        let is_within = point.iter().zip(&self.whole).all(|(x, range)| range.contains(*x));
        is_within && placed.solve().is_ok_and(|impact| self.statements(point, &placed, &impact).all(|statement| statement.ahead >= 0.0))
    }

    /// Returns the number of a cell that is widest beside a significant change of it and can be divided; errors last.
    fn widest(&self, ranges: &[Interval]) -> Option<usize> {
        let scale = |i: usize| self.problem.unknowns.get(i).map(|unknown| unknown.of.scale(&self.problem.collision, unknown.start));
        let changes = |i: &usize| scale(*i).map_or(0.0, |scale| ranges[*i].width() / scale);
        let divisible = (0..ranges.len()).filter(|i| is_divisible(ranges[*i], self.whole[*i]));
        divisible.max_by(|one, other| changes(one).total_cmp(&changes(other)))
    }

    /// Returns the range of one unknown.
    fn range(&self, of: usize, search: &GuaranteedSearch, goes_on: &dyn Fn(usize) -> bool) -> Result<GuaranteedRange, NoRange> {
        let variable = self.problem.unknowns[of].of;
        let scale = variable.scale(&self.problem.collision, self.problem.unknowns[of].start);
        let mut least = End::of(self, of, 1.0);
        let low = least.find(search, scale, search.cells.div_ceil(2), goes_on)?;
        let mut greatest = End::of(self, of, -1.0);
        // What is attained at one end is attained.
        greatest.best = Some(Attained { value: -low.attained.point[of], ..low.attained.clone() });
        let high = greatest.find(search, scale, search.cells - low.cells.min(search.cells), &|cells| goes_on(low.cells + cells))?;
        let unknowns = |attained: &Attained| attained.point[..self.unknowns()].to_vec();
        Ok(GuaranteedRange {
            of: variable,
            low: low.bound,
            high: -high.bound,
            low_attained: low.attained.value,
            high_attained: -high.attained.value,
            at_low: unknowns(&low.attained),
            at_high: unknowns(&high.attained),
            is_tight: low.is_tight && high.is_tight,
            cells: low.cells + high.cells,
        })
    }
}

/// A search for the least value of an unknown, times a sign.
struct End<'a, 'p> {
    equations: &'a Equations<'p>,
    of: usize,
    sign: f64,
    best: Option<Attained>,
    open: BinaryHeap<Cell>,
}

/// The end that was found.
struct Found {
    bound: f64,
    attained: Attained,
    is_tight: bool,
    cells: usize,
}

/// A row of the equations after elimination: each is that of one number.
struct Pivots {
    /// For each equation, the number that it is solved for.
    of: Vec<usize>,
    /// The combination of equations that makes each row.
    combined: Vec<Vec<f64>>,
}

impl<'a, 'p> End<'a, 'p> {
    fn of(equations: &'a Equations<'p>, of: usize, sign: f64) -> Self {
        End { equations, of, sign, best: None, open: BinaryHeap::new() }
    }

    fn bound(&self, range: Interval) -> f64 {
        if self.sign > 0.0 { range.lower() } else { -range.upper() }
    }

    fn find(&mut self, search: &GuaranteedSearch, scale: f64, budget: usize, goes_on: &dyn Fn(usize) -> bool) -> Result<Found, NoRange> {
        let whole = self.equations.whole.clone();
        self.enter(whole);
        let mut cells = 0;
        let is_tight = loop {
            let Some(first) = self.open.peek() else { break true };
            if let Some(best) = &self.best
                && best.value - first.bound <= search.gap * best.value.abs().max(scale)
            {
                break true;
            }
            let Some(by) = first.divide else { break false };
            if cells >= budget || (cells % STRIDE == STRIDE - 1 && !goes_on(cells)) {
                break false;
            }
            let Some(cell) = self.open.pop() else { break true };
            cells += 1;
            let middle = middle_of(cell.ranges[by]);
            for (lower, upper) in [(cell.ranges[by].lower(), middle), (middle, cell.ranges[by].upper())] {
                let mut half = cell.ranges.clone();
                half[by] = Interval::new(lower, upper).unwrap_or(half[by]);
                self.enter(half);
            }
        };
        match (&self.best, self.open.peek()) {
            (None, None) => Err(NoRange::Excluded),
            (None, Some(_)) => Err(NoRange::NoPoint { cells }),
            (Some(best), first) => {
                // Cells that are no longer open have no value below the best one.
                let bound = first.map_or(best.value, |first| first.bound.min(best.value));
                Ok(Found { bound, attained: best.clone(), is_tight, cells })
            }
        }
    }

    /// Narrows a cell and adds it to the open ones, unless nothing in it meets the equations or is better than the best one.
    fn enter(&mut self, mut ranges: Vec<Interval>) {
        let whole = &self.equations.whole;
        let mut divide = None;
        for pass in 0..4 {
            let over = self.equations.over(&ranges);
            if !over.may_hold {
                return;
            }
            if self.best.as_ref().is_some_and(|best| self.bound(ranges[self.of]) >= best.value) {
                return;
            }
            let slopes = derivatives(self.equations.slopes(&ranges));
            divide = self.equations.widest(&ranges);
            if !over.is_continuous || slopes.iter().flatten().any(|slope| !slope.finite().is_certain()) {
                self.consider(&ranges, None);
                break;
            }
            let pivots = self.pivots(&ranges, &slopes);
            let rows: Vec<Vec<Interval>> = pivots.combined.iter().map(|combined| combine(&slopes, combined)).collect();
            let row = pivots.of.iter().position(|pivot| *pivot == self.of).map(|row| &rows[row]);
            // The corner at which the unknown is least, if the equations make it so.
            let corner: Vec<f64> = (0..ranges.len())
                .map(|i| match row {
                    Some(row) if i != self.of && !pivots.of.contains(&i) && !row[self.of].contains(0.0) => {
                        toward_least(ranges[i], -row[i] / row[self.of] * Interval::from(self.sign))
                    }
                    _ => middle_of(ranges[i]),
                })
                .collect();
            let corner = self.consider(&corner.iter().copied().map(Interval::from).collect::<Vec<_>>(), Some((&pivots, &ranges)));
            let before = ranges.clone();
            let middle: Vec<f64> = ranges.iter().copied().map(middle_of).collect();
            for center in [middle, corner] {
                if !self.narrow(&mut ranges, &center, &slopes, &pivots) {
                    return;
                }
            }
            let change = |row: &[Interval], i: usize| row[i].magnitude().upper() * ranges[i].width();
            let smear =
                |i: usize| slopes.iter().map(|row| change(row, i) / (0..ranges.len()).map(|j| change(row, j)).sum::<f64>()).sum::<f64>();
            let divisible = || (0..ranges.len()).filter(|i| is_divisible(ranges[*i], whole[*i]));
            let greatest = |of: &dyn Fn(usize) -> f64, among: &dyn Fn(&usize) -> bool| {
                divisible().filter(among).max_by(|one, other| of(*one).total_cmp(&of(*other)))
            };
            // Where the equations do not determine their numbers over the cell, it is divided by the unknown that changes the residuals most.
            let is_solved = pivots.of.len() == self.equations.problem.evidence.len()
                && pivots.of.iter().zip(&rows).all(|(pivot, row)| !row[*pivot].contains(0.0));
            let chosen = match row {
                _ if !is_solved => greatest(&smear, &|i| *i < self.equations.unknowns() && smear(*i) > 0.0),
                Some(row) => greatest(&|i| change(row, i), &|i| !pivots.of.contains(i)),
                None => Some(self.of).filter(|of| is_divisible(ranges[*of], whole[*of])),
            };
            divide = chosen.or(divide);
            let shrinks = |i: usize| ranges[i].width() < 0.5 * before[i].width();
            if pass > 0 && !(0..ranges.len()).any(shrinks) {
                break;
            }
        }
        let bound = self.bound(ranges[self.of]);
        if self.best.as_ref().is_none_or(|best| bound < best.value) {
            self.open.push(Cell { ranges, bound, divide });
        }
    }

    /// Chooses a number for each equation, that of the search first, and combines the equations so that each is that of its number.
    fn pivots(&self, ranges: &[Interval], slopes: &[Vec<Interval>]) -> Pivots {
        let equations = slopes.len();
        let mut matrix: Vec<Vec<f64>> = slopes.iter().map(|row| row.iter().copied().map(middle_of).collect()).collect();
        let mut combined: Vec<Vec<f64>> = (0..equations).map(|i| (0..equations).map(|j| f64::from(u8::from(i == j))).collect()).collect();
        let width: Vec<f64> = ranges.iter().map(|range| range.width().max(f64::MIN_POSITIVE)).collect();
        let length = |row: &[f64]| row.iter().zip(&width).fold(0.0, |sum: f64, (slope, width)| sum.max((slope * width).abs()));
        let lengths: Vec<f64> = matrix.iter().map(|row| length(row).max(f64::MIN_POSITIVE)).collect();
        let mut of: Vec<Option<usize>> = vec![None; equations];
        for step in 0..equations {
            let is_free = |row: usize, column: usize| of[row].is_none() && !of.contains(&Some(column));
            let size = |(row, column): &(usize, usize)| (matrix[*row][*column] * width[*column]).abs() / lengths[*row];
            let of_search = (0..equations)
                .map(|row| (row, self.of))
                .filter(|(row, column)| step == 0 && is_free(*row, *column) && size(&(*row, *column)) > 1e-9);
            let all = (0..equations)
                .flat_map(|row| (0..width.len()).map(move |column| (row, column)))
                .filter(|(row, column)| is_free(*row, *column));
            let greatest = |one: &(usize, usize), other: &(usize, usize)| size(one).total_cmp(&size(other));
            let Some((row, column)) = of_search.max_by(greatest).or_else(|| all.max_by(greatest)).filter(|at| size(at) > 0.0) else {
                break;
            };
            of[row] = Some(column);
            let scale = matrix[row][column].recip();
            matrix[row].iter_mut().chain(&mut combined[row]).for_each(|x| *x *= scale);
            let (pivot, combination) = (matrix[row].clone(), combined[row].clone());
            for other in (0..equations).filter(|other| *other != row) {
                let factor = matrix[other][column];
                matrix[other]
                    .iter_mut()
                    .zip(&pivot)
                    .chain(combined[other].iter_mut().zip(&combination))
                    .for_each(|(x, y)| *x -= factor * y);
            }
        }
        let chosen = of.into_iter().zip(combined).filter_map(|(of, combined)| Some((of?, combined)));
        let (of, combined) = chosen.filter(|(_, combined)| combined.iter().all(|x| x.is_finite())).unzip();
        Pivots { of, combined }
    }

    /// Narrows a cell by the theorem of the mean about a point of it, and returns `false` if nothing in it meets the equations.
    fn narrow(&self, ranges: &mut [Interval], center: &[f64], slopes: &[Vec<Interval>], pivots: &Pivots) -> bool {
        let at: Vec<Interval> = center.iter().copied().map(Interval::from).collect();
        let here = self.equations.over(&at);
        let values: Vec<Vec<Interval>> = here.of.iter().map(|value| vec![*value]).collect();
        let alone = slopes.iter().cloned().zip(values.iter().map(|value| value[0]));
        let together = pivots.combined.iter().map(|combined| (combine(slopes, combined), combine(&values, combined)[0]));
        for (row, value) in alone.chain(together) {
            for i in 0..ranges.len() {
                if row[i].contains(0.0) || ranges[i].width() == 0.0 {
                    continue;
                }
                let others = (0..ranges.len()).filter(|j| *j != i).fold(value, |sum, j| sum + row[j] * (ranges[j] - at[j]));
                match intersection(ranges[i], at[i] - others / row[i]) {
                    Some(narrower) => ranges[i] = narrower,
                    None => return false,
                }
            }
        }
        true
    }

    /// Solves the equations for their numbers from the middle of a cell, takes what is found if it is better than the best, and returns the point: a center of
    /// the cell `within`, if that is where it is.
    fn consider(&mut self, cell: &[Interval], within: Option<(&Pivots, &[Interval])>) -> Vec<f64> {
        let start: Vec<f64> = cell.iter().copied().map(middle_of).collect();
        let own;
        let pivots = match within {
            Some((pivots, _)) => pivots,
            None => {
                let points: Vec<Interval> = start.iter().copied().map(Interval::from).collect();
                own = self.pivots(&self.equations.whole, &derivatives(self.equations.slopes(&points)));
                &own
            }
        };
        let solved = self.solve(&start, &pivots.of);
        let center = match (&solved, within) {
            (Some(point), Some((_, ranges))) if point.iter().zip(ranges).all(|(x, range)| range.contains(*x)) => point.clone(),
            _ => start,
        };
        if let Some(point) = solved {
            let value = self.sign * point[self.of];
            let is_better = self.best.as_ref().is_none_or(|best| value < best.value);
            if is_better && self.equations.accepts(&point) {
                self.best = Some(Attained { point, value });
            }
        }
        center
    }

    /// Solves the equations for some numbers by Newton's method, all others held.
    fn solve(&self, start: &[f64], of: &[usize]) -> Option<Vec<f64>> {
        let mut point = start.to_vec();
        if of.len() < self.equations.problem.evidence.len() {
            return None;
        }
        // Without evidence nothing is to be solved for.
        if of.is_empty() {
            return Some(point);
        }
        for _ in 0..30 {
            let rows = self.equations.slopes(&point);
            let matrix = DMatrix::from_fn(rows.len(), of.len(), |i, j| rows[i][of[j]].derivative);
            let step = matrix.lu().solve(&DVector::from_fn(rows.len(), |i, _| rows[i][0].value))?;
            let mut moved: f64 = 0.0;
            for (place, step) in of.iter().zip(step.iter()) {
                let next = point[*place] - step;
                moved = moved.max(step.abs() / point[*place].abs().max(self.equations.whole[*place].width() * 1e-3));
                point[*place] = next;
            }
            if !moved.is_finite() {
                return None;
            }
            if moved < 1e-13 {
                return Some(point);
            }
        }
        None
    }
}

fn derivatives(rows: Vec<Vec<Dual<Interval>>>) -> Vec<Vec<Interval>> {
    rows.into_iter().map(|row| row.into_iter().map(|dual| dual.derivative).collect()).collect()
}

/// Returns a sum of rows, each times a number.
fn combine(rows: &[Vec<Interval>], by: &[f64]) -> Vec<Interval> {
    let columns = rows.first().map_or(0, Vec::len);
    let sum = |j: usize| {
        rows.iter().zip(by).filter(|(_, by)| **by != 0.0).fold(Interval::ZERO, |sum, (row, by)| sum + row[j] * Interval::from(*by))
    };
    (0..columns).map(sum).collect()
}

/// Returns the end to which a function with this slope falls, or the middle if it does not fall to one.
fn toward_least(range: Interval, slope: Interval) -> f64 {
    if slope.lower() >= 0.0 {
        range.lower()
    } else if slope.upper() <= 0.0 {
        range.upper()
    } else {
        middle_of(range)
    }
}

fn is_divisible(range: Interval, whole: Interval) -> bool {
    let middle = middle_of(range);
    range.lower() < middle && middle < range.upper() && range.width() > SMALLEST * whole.width()
}
