//! What is known of the crash, as equations of intervals, dual numbers and floats.

use core::f64::consts::TAU;

use nalgebra::{DMatrix, DVector};

use super::elimination::Pivots;
use super::{GuaranteedSearch, NoRange};
use crate::cells::is_divisible;
use crate::frame::Xy;
use crate::impact::Impact;
use crate::input::{Input, Side};
use crate::output::Output;
use crate::reconstruct::as_measured::AsMeasured;
use crate::reconstruct::given::{Evidence, PlacedDependence, ReconstructionProblem, Uncertainty};
use crate::reconstruct::measurand::Measurand;
use crate::reconstruct::placed::Placed;
use crate::reconstruct::scene::Scene;
use crate::reconstruct::variable::{Variable, party};
use crate::scalar::Real;
use crate::scalar::interval::Interval;
use crate::sensitivity::dual::Dual;

/// The equations, and the box of the numbers that are sought: the unknowns, then the errors.
pub(super) struct Equations<'a> {
    pub(super) problem: &'a ReconstructionProblem,
    scene: Scene,
    /// The equation that each error belongs to.
    errors: Vec<usize>,
    dependences: Vec<PlacedDependence>,
    as_measured: AsMeasured,
    pub(super) whole: Vec<Interval>,
    /// The least and the greatest value of each unknown that is looked at where nothing else limits it.
    pub(super) assumed: Vec<[Option<f64>; 2]>,
}

/// What a piece of evidence says: its residual is zero, and what is ahead is not negative.
struct Statement<T> {
    residual: T,
    ahead: T,
}

/// Residuals over a cell.
pub(super) struct Residuals {
    pub(super) of: Vec<Interval>,
    /// Whether a point of the cell may meet every piece of evidence, and physics accept it.
    pub(super) may_hold: bool,
    /// Whether no residual jumps.
    pub(super) is_continuous: bool,
}

/// Returns the limits of an error, rounded outward.
fn within(limit: f64) -> Interval {
    let limit = limit.next_up();
    Interval::new(-limit, limit).unwrap_or(Interval::ENTIRE)
}

/// Greatest speed without limits that is searched, in m/s, and greatest yaw rate in rad/s: beyond those of any road vehicle.
const FASTEST: f64 = 200.0;
const FASTEST_TURN: f64 = 50.0;

/// Width, as a share of the whole, below which a cell is not divided.
const SMALLEST: f64 = 1e-12;

impl<'a> Equations<'a> {
    pub(super) fn of(problem: &'a ReconstructionProblem, search: &GuaranteedSearch) -> Result<Self, NoRange> {
        problem.issues_of_parts().finish().map_err(NoRange::Problem)?;
        let mut whole = Vec::with_capacity(problem.unknowns.len());
        let mut assumed = Vec::with_capacity(problem.unknowns.len());
        for unknown in &problem.unknowns {
            let (least, greatest) = unknown.of.domain(&problem.collision);
            // An angle is looked at all around.
            let of_turn = unknown.of.period().map(|period| 0.5 * period);
            let about = if of_turn.is_some() { unknown.start } else { 0.0 };
            let beyond = match unknown.of {
                Variable::Speed(_) | Variable::SkidSpeed(_) | Variable::Input(Input::VelocityX(_) | Input::VelocityY(_)) => FASTEST,
                Variable::Input(Input::YawRate(_)) => FASTEST_TURN,
                // That of such a change of velocity.
                Variable::Impulse(_) => 2.0 * FASTEST * unknown.of.scale(&problem.collision, unknown.start),
                _ => of_turn.unwrap_or(f64::INFINITY),
            };
            let of_prior = unknown.prior.map_or(f64::INFINITY, |sd| search.deviations * sd);
            let low = unknown.min.unwrap_or(least.max(unknown.start - of_prior).max(about - beyond));
            let high = unknown.max.unwrap_or(greatest.min(unknown.start + of_prior).min(about + beyond));
            let range = Interval::new(low, high).filter(|_| low.is_finite() && high.is_finite());
            whole.push(range.ok_or(NoRange::NoLimits(unknown.of))?);
            let is_assumed = |given: Option<f64>, end: f64| given.is_none() && end.abs() == beyond && of_turn.is_none();
            assumed.push([(unknown.min, low), (unknown.max, high)].map(|(given, end)| is_assumed(given, end).then_some(end)));
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
        Ok(Equations {
            problem,
            scene: Scene::of(problem),
            errors,
            dependences: problem.placed_dependences(),
            as_measured: AsMeasured::of(problem, &problem.evidence),
            whole,
            assumed,
        })
    }

    pub(super) fn unknowns(&self) -> usize {
        self.problem.unknowns.len()
    }

    /// Returns what a piece of evidence says of a value, with its computed value if that is not the one of the impact.
    ///
    /// Angles are stated by the sine of their difference and its cosine, and lengths by their squares: these have derivatives everywhere.
    fn statement<T: Real + Copy + From<f64>>(
        &self,
        evidence: &Evidence,
        sought: T,
        computed: Option<T>,
        placed: &Placed<T>,
        impact: &Impact<T>,
    ) -> Statement<T> {
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
            Measurand::Output(Output::DeltaVMagnitude(side)) => {
                let delta_v = after(side).delta_v;
                squared(delta_v.x.magnitude().squared() + delta_v.y.magnitude().squared())
            }
            Measurand::SeparationSpeed(side) => {
                let velocity = after(side).after.velocity;
                squared(velocity.x.magnitude().squared() + velocity.y.magnitude().squared())
            }
            Measurand::EquivalentEnergySpeed(side) => {
                let mass = party(&placed.collision, side).vehicle().map_or(T::int(1), |vehicle| vehicle.mass);
                squared(value(Measurand::CrushEnergyOf(side)) * T::int(2) / mass)
            }
            Measurand::Output(Output::PrincipalDirectionOfForce(side)) => {
                let force = after(side).force_direction();
                along(force.right, force.ahead)
            }
            Measurand::SeparationDirection(side) => {
                let velocity = after(side).after.velocity;
                along(velocity.y, velocity.x)
            }
            Measurand::ApproachDirection(side) => {
                let velocity = party(&placed.collision, side).vehicle().map_or(Xy::zero(), |vehicle| vehicle.motion.velocity);
                along(velocity.y, velocity.x)
            }
            of => match of.period() {
                Some(period) => {
                    let (sin, cos) = (value(of) - sought).sin_and_cos();
                    Statement { residual: sin, ahead: if period < TAU { T::int(1) } else { cos } }
                }
                None => Statement { residual: computed.unwrap_or_else(|| value(of)) - sought, ahead: T::int(1) },
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
            move |place: usize| self.errors.iter().position(|of| *of == place).map_or(T::int(0), |error| numbers[self.unknowns() + error]);
        let sought = move |place: usize, evidence: &Evidence| {
            let own = self.dependences.iter().filter(move |dependence| dependence.evidence == place);
            own.fold(T::from(evidence.value) + error(place), |sought, dependence| sought + dependence.change(numbers))
        };
        let evidence = &self.problem.evidence;
        // Without such evidence each statement computes what it needs.
        let as_measured = &self.as_measured;
        let computed = if as_measured.is_nothing() { Vec::new() } else { as_measured.compared(evidence, placed, impact) };
        let statement =
            move |(place, evidence)| self.statement(evidence, sought(place, evidence), computed.get(place).copied(), placed, impact);
        evidence.iter().enumerate().map(statement)
    }

    /// Returns the residuals over a cell.
    pub(super) fn over(&self, cell: &[Interval]) -> Residuals {
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
    pub(super) fn slopes<T: Real + Copy + From<f64>>(&self, at: &[T]) -> Vec<Vec<Dual<T>>>
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
    pub(super) fn accepts(&self, point: &[f64]) -> bool {
        let placed = self.scene.place(&point[..self.unknowns()]);
        let is_within = point.iter().zip(&self.whole).all(|(x, range)| range.contains(*x));
        is_within && placed.solve().is_ok_and(|impact| self.statements(point, &placed, &impact).all(|statement| statement.ahead >= 0.0))
    }

    /// Returns the number of a cell that is widest beside a significant change of it and can be divided; errors last.
    pub(super) fn widest(&self, ranges: &[Interval]) -> Option<usize> {
        let changes = |i: usize| if i < self.unknowns() { ranges[i].width() / self.scale(i) } else { 0.0 };
        self.greatest(ranges, changes)
    }

    /// Returns the number of a cell of which something is greatest, among those that can be divided and have it.
    pub(super) fn greatest(&self, ranges: &[Interval], of: impl Fn(usize) -> f64) -> Option<usize> {
        let is_divisible = |i: &usize| is_divisible(ranges[*i]) && ranges[*i].width() > SMALLEST * self.whole[*i].width();
        let sizes = (0..ranges.len()).filter(is_divisible).map(|i| (i, of(i))).filter(|(_, size)| *size >= 0.0);
        sizes.max_by(|one, other| one.1.total_cmp(&other.1)).map(|(i, _)| i)
    }

    /// Returns a significant change of an unknown.
    pub(super) fn scale(&self, of: usize) -> f64 {
        let unknown = &self.problem.unknowns[of];
        unknown.of.scale(&self.problem.collision, unknown.start)
    }

    /// Solves the equations for some numbers by Newton's method, all others held.
    pub(super) fn solve(&self, start: &[f64], of: &[usize]) -> Option<Vec<f64>> {
        let mut point = start.to_vec();
        if of.len() < self.problem.evidence.len() {
            return None;
        }
        // Without evidence nothing is to be solved for.
        if of.is_empty() {
            return Some(point);
        }
        for _ in 0..30 {
            let rows = self.slopes(&point);
            let matrix = DMatrix::from_fn(rows.len(), of.len(), |i, j| rows[i][of[j]].derivative);
            let step = matrix.lu().solve(&DVector::from_fn(rows.len(), |i, _| rows[i][0].value))?;
            let mut moved: f64 = 0.0;
            for (place, step) in of.iter().zip(step.iter()) {
                let next = point[*place] - step;
                moved = moved.max(step.abs() / point[*place].abs().max(self.whole[*place].width() * 1e-3));
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

    /// Returns a point that meets the equations near values of the unknowns: its errors are those there, and where exact evidence needs it, unknowns move.
    pub(super) fn met_near(&self, unknowns: &[f64]) -> Option<Vec<f64>> {
        /// Width of an unknown beside that of its whole range, by which it is not chosen where an error can be.
        const HELD: f64 = 1e-6;
        let start: Vec<f64> = unknowns.iter().copied().chain(self.whole[unknowns.len()..].iter().map(|_| 0.0)).collect();
        let about = |(i, range): (usize, &Interval)| if i < unknowns.len() { *range * Interval::from(HELD) } else { *range };
        let ranges: Vec<Interval> = self.whole.iter().enumerate().map(about).collect();
        let slopes = self.slopes(&start).into_iter().map(|row| row.into_iter().map(|dual| Interval::from(dual.derivative)).collect());
        let pivots = Pivots::of(&slopes.collect::<Vec<_>>(), &ranges, None);
        self.solve(&start, &pivots.of).filter(|point| self.accepts(point))
    }
}
