//! The problem: a collision, its unknowns, and the evidence.

use super::measurand::Measurand;
use super::scene::Scene;
use super::variable::{Axis, Variable};
use crate::collision::Collision;
use crate::distribution::Distribution;
use crate::scalar::Real;

/// Uncertainty of a piece of evidence.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Uncertainty {
    /// Its standard deviation, in its unit.
    StandardDeviation(f64),
    /// The step in which it is read or recorded: anything within half a step is equally likely, so its standard deviation is the step over √12.
    Resolution(f64),
    /// Exact: it is met to a millionth of its size, and adds nothing to the uncertainty of the answer.
    Exact,
}

/// Something known of the crash.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Evidence {
    /// The measurand.
    pub of: Measurand,
    /// Its value, in SI.
    pub value: f64,
    /// Its uncertainty.
    pub uncertainty: Uncertainty,
}

/// Something to be solved for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unknown {
    /// The variable.
    pub of: Variable,
    /// Start of the first search, in SI.
    pub start: f64,
    /// The lower bound; `None` if only the mechanics limits it.
    pub min: Option<f64>,
    /// The upper bound; `None` if only the mechanics limits it.
    pub max: Option<f64>,
    /// Standard deviation of prior knowledge of `start`, which makes it evidence too; `None` without a prior.
    pub prior: Option<f64>,
    /// The shape of that knowledge if it is not normal. The posterior has this density; a search takes a normal one with the standard deviation of `prior`.
    pub shape: Option<Distribution>,
}

/// Two pieces of evidence with correlated errors, such as two velocities of one vehicle from the same rest position. A prior is the evidence of an unknown of which
/// there is no other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Correlation {
    /// One piece.
    pub one: Measurand,
    /// The other.
    pub other: Measurand,
    /// Their coefficient of correlation, between −1 and 1.
    pub coefficient: f64,
}

/// Two unknowns whose priors have correlated errors, such as two masses from one scale.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PriorCorrelation {
    /// One unknown.
    pub one: Variable,
    /// The other.
    pub other: Variable,
    /// The coefficient of correlation of their priors, between −1 and 1.
    pub coefficient: f64,
}

/// How the value of a piece of evidence follows an unknown that it was computed with, to first order: the separation that leads to a rest position depends on the
/// heading before the impact, for instance. Without evidence of this kind, or without this unknown, it has no effect.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dependence {
    /// The piece of evidence.
    pub of: Measurand,
    /// The unknown.
    pub on: Variable,
    /// The value of the unknown with which the evidence was computed, in SI.
    pub at: f64,
    /// The change of the evidence by that of the unknown, in SI.
    pub slope: f64,
}

/// A dependence, by the places of its evidence and its unknown.
pub(super) struct PlacedDependence {
    pub(super) evidence: usize,
    unknown: usize,
    at: f64,
    slope: f64,
}

impl PlacedDependence {
    /// Returns the change of the evidence that the unknowns make.
    pub(super) fn change<T: Real + Copy + From<f64>>(&self, unknowns: &[T]) -> T {
        (unknowns[self.unknown] - T::from(self.at)) * T::from(self.slope)
    }
}

/// The part of an error with one cause in a piece of evidence, which grows with what is computed: the friction of a slide to rest, in the speed that it began with. The
/// deviations and the correlations of the evidence have it as it is at the fit; draws of the posterior have that of their own motion, without which they would lean to
/// small ones (Peelle's puzzle).
///
/// ```
/// use planar_impact::reconstruct::*;
/// use planar_impact::{Collision, Party, Side, Vehicle};
///
/// // A slide that gives a separation at 3 m/s ± 0.32 m/s, of which ± 0.3 m/s by a friction of ± 20 %, with whose root the speed grows.
/// let car = Vehicle::new(1500.0, 2500.0).with_impact_center(2.0, 0.3).with_speed(13.0);
/// let mut problem = ReconstructionProblem::of(Collision::new(car, Party::Barrier).with_restitution(0.25))
///     .unknown(Variable::Speed(Side::One), 13.0)
///     .evidence(Measurand::SeparationSpeed(Side::One), 3.0, Uncertainty::StandardDeviation(0.32));
/// let error = GrowingError { of: Measurand::SeparationSpeed(Side::One), at_fit: 0.3, at_given: 0.3, slope: 0.1, relative_sd: 0.2, power: -0.5 };
/// problem.growing_error.push(error);
/// assert!(problem.check().is_ok());
/// problem.growing_error[0].relative_sd = 0.0;
/// assert!(problem.check().is_err());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GrowingError {
    /// The evidence.
    pub of: Measurand,
    /// The standard deviation that it has of this cause, with its sign, where the deviations and correlations were taken.
    pub at_fit: f64,
    /// The same at the given value.
    pub at_given: f64,
    /// The increase of that by a unit of the computed value.
    pub slope: f64,
    /// The relative standard deviation of the cause.
    pub relative_sd: f64,
    /// The power of the cause that the computed value grows with, beside what is given of it: −1 for the ways of slides and −½ for their speeds, by the friction.
    pub power: f64,
}

/// A reconstruction problem: the collision, its unknowns, and the evidence.
///
/// ```
/// use planar_impact::reconstruct::*;
/// use planar_impact::*;
///
/// # let car = |heading: f64, speed: f64| Vehicle {
/// #     mass: 1500.0, yaw_inertia: 2500.0, heading: Heading::from_angle(heading), impact_center: ForwardLeft { forward: 2.0, left: 0.3 },
/// #     motion: Motion { velocity: Xy { x: speed, y: 0.0 }, yaw_rate: 0.0 },
/// # };
/// # let collision: Collision = Collision {
/// #     one: car(0.0, 10.0).into(), two: car(std::f64::consts::PI, -12.0).into(), crush_plane: CrushPlane::from_angle(0.0), restitution: 0.1,
/// #     impulse_ratio: ImpulseRatio::Critical, law: Law::Brach, moment: Moment::None,
/// # };
/// // Vehicle 2 is known to have gone at 12 m/s; how fast was vehicle 1, if the crush took 80 kJ ± 4 kJ?
/// let question = ReconstructionProblem::of(collision)
///     .unknown(Variable::Speed(Side::One), 10.0)
///     .evidence(Measurand::CrushEnergy, 80e3, Uncertainty::StandardDeviation(4e3));
/// let answer = question.solve(&Search::default())?;
/// assert_eq!(answer.verdict, Verdict::Agrees);
/// let speed = &answer.best().unknowns[0];
/// println!("{:.1} m/s ± {:.1} m/s", speed.value, speed.sd.unwrap_or(f64::NAN));
/// # assert!((answer.best().impact.work.n + 80e3).abs() < 1e-6);
/// # Ok::<(), SolveError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct ReconstructionProblem {
    /// The collision. Its values of the unknowns are not used.
    pub collision: Collision,
    /// The unknowns.
    pub unknowns: Vec<Unknown>,
    /// The evidence.
    pub evidence: Vec<Evidence>,
    /// Evidence that was computed with unknowns.
    pub dependences: Vec<Dependence>,
    /// Correlations between pieces of evidence.
    pub correlations: Vec<Correlation>,
    /// Correlations between priors.
    pub prior_correlations: Vec<PriorCorrelation>,
    /// `true` if vehicle 1 or vehicle 2 drives along its heading: an unknown heading then also rotates the velocity. A vehicle whose speed is unknown always
    /// does.
    pub drives_along_heading: [bool; 2],
    /// `true` if vehicle 1 or vehicle 2 keeps its radius of gyration: an unknown mass then also changes the yaw inertia. A vehicle whose radius of gyration
    /// is unknown always does.
    pub holds_radius_of_gyration: [bool; 2],
    /// `true` if the separation velocity and the yaw rate of vehicle 1 or vehicle 2, as evidence, were computed from its way to rest on locked wheels: their errors are
    /// then those of the way, which grows as the square of the motion, and hold down to a standstill. To first order this changes nothing.
    pub separation_from_rest: [bool; 2],
    /// The crush energies, as evidence, that were computed from measured depths: their errors are then those of the depths, with which the root of the energy grows. To
    /// first order this changes nothing.
    pub crush_energy_from_depths: Vec<Measurand>,
    /// An error with one cause that grows with the evidence, in each piece that has it.
    pub growing_error: Vec<GrowingError>,
    /// The share of vehicle 1 in the crush energy, if it is known.
    pub crush_share: Option<f64>,
    /// The skid speed of vehicle 1 and of vehicle 2 ([`Variable::SkidSpeed`]), if it is known.
    pub skid_speeds: [Option<f64>; 2],
}

/// Settings of the search.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Search {
    /// Number of starts: the first is given, the others are drawn within the bounds. With more than one, a few searches near the solutions follow.
    pub starts: usize,
    /// Seed of those draws.
    pub seed: u64,
    /// Maximum number of steps of one search.
    pub iterations: usize,
}

impl Default for Search {
    /// Returns 64 starts of at most 200 steps, always with the same seed.
    fn default() -> Self {
        Search { starts: 64, seed: 1, iterations: 200 }
    }
}

impl Uncertainty {
    /// Returns the standard deviation, or `None` if it is exact.
    pub fn standard_deviation(self) -> Option<f64> {
        match self {
            Uncertainty::StandardDeviation(sd) => Some(sd),
            Uncertainty::Resolution(step) => Some(step / 12_f64.sqrt()),
            Uncertainty::Exact => None,
        }
    }
}

impl Evidence {
    /// Returns its size, at least the smallest size of its kind, to which relative tolerances refer.
    pub(super) fn size(&self) -> f64 {
        self.value.abs().max(self.of.least_size())
    }

    /// Returns the divisor of a residual.
    pub(super) fn weight_scale(&self) -> f64 {
        /// Tolerance of exact evidence as a share of its size.
        const EXACT: f64 = 1e-6;
        let sd = self.uncertainty.standard_deviation();
        sd.unwrap_or_else(|| EXACT * self.size())
    }
}

impl Unknown {
    /// Creates an unknown without bounds of its own and without a prior.
    pub fn free(of: Variable, start: f64) -> Self {
        Unknown { of, start, min: None, max: None, prior: None, shape: None }
    }

    /// Returns the same without bounds if it is an angle, which is the same after half a turn (a crush plane) or a turn (a heading), and its bounds leave out no
    /// direction: they would cut the circle where fits go on.
    ///
    /// ```
    /// use planar_impact::{Input, reconstruct::{Unknown, Variable}};
    /// let within = |max| Unknown { min: Some(-1.0), max: Some(max), ..Unknown::free(Variable::Input(Input::CrushPlane), 0.0) };
    /// assert_eq!(within(2.0).on_the_circle().max, Some(2.0));
    /// assert_eq!(within(2.2).on_the_circle().max, None);
    /// ```
    #[must_use]
    pub fn on_the_circle(self) -> Self {
        /// Of bounds in degrees, as a share.
        const ROUNDING: f64 = 1e-9;
        match (self.of.period(), self.min, self.max) {
            (Some(period), Some(min), Some(max)) if max - min >= period * (1.0 - ROUNDING) && (max - min).is_finite() => {
                Unknown { min: None, max: None, ..self }
            }
            _ => self,
        }
    }

    /// Returns its prior as evidence, if it has one.
    pub(super) fn as_evidence(&self) -> Option<Evidence> {
        let sd = self.prior?;
        Some(Evidence { of: Measurand::Variable(self.of), value: self.start, uncertainty: Uncertainty::StandardDeviation(sd) })
    }
}

impl ReconstructionProblem {
    /// Creates a problem from a collision, without unknowns and evidence.
    pub fn of(collision: Collision) -> Self {
        ReconstructionProblem {
            collision,
            unknowns: Vec::new(),
            evidence: Vec::new(),
            dependences: Vec::new(),
            correlations: Vec::new(),
            prior_correlations: Vec::new(),
            drives_along_heading: [false; 2],
            holds_radius_of_gyration: [false; 2],
            separation_from_rest: [false; 2],
            crush_energy_from_depths: Vec::new(),
            growing_error: Vec::new(),
            crush_share: None,
            skid_speeds: [None; 2],
        }
    }

    /// Solves by momentum alone: adds both components of the impulse to the unknowns, in place of what restitution, impulse ratio and crush plane say of it.
    /// The search starts at a common velocity. Without yaw inertia or impact center take any inertia, and an impact center at the center of mass.
    ///
    /// ```
    /// use planar_impact::reconstruct::*;
    /// use planar_impact::*;
    ///
    /// // 4220 lb eastbound and 3875 lb northbound; speeds in mph, velocities after to 1 mph.
    /// let [east, north] = [0.0, std::f64::consts::FRAC_PI_2].map(Heading::from_angle);
    /// let one = Vehicle::new(4220.0, 1.0).with_heading(east).with_speed(30.0);
    /// let two = Vehicle::new(3875.0, 1.0).with_heading(north).with_speed(30.0);
    /// let after = [(Output::VelocityX(Side::One), 14.0), (Output::VelocityY(Side::One), 16.0),
    ///     (Output::VelocityX(Side::Two), 12.0), (Output::VelocityY(Side::Two), 19.0)];
    /// let problem = ReconstructionProblem::of(Collision::new(one, two))
    ///     .unknown(Variable::Speed(Side::One), 30.0)
    ///     .unknown(Variable::Speed(Side::Two), 30.0)
    ///     .by_momentum();
    /// let problem = after.into_iter().fold(problem, |problem, (of, value)| {
    ///     problem.evidence(Measurand::Output(of), value, Uncertainty::StandardDeviation(1.0))
    /// });
    /// let answer = problem.solve(&Search::default())?;
    /// let speeds = &answer.best().unknowns;
    /// assert!((speeds[0].value - 25.02).abs() < 0.01 && (speeds[1].value - 36.42).abs() < 0.01);
    /// # Ok::<(), SolveError>(())
    /// ```
    #[must_use]
    pub fn by_momentum(self) -> Self {
        let start = Scene::of(&self).place(&self.unknowns.iter().map(|unknown| unknown.start).collect::<Vec<f64>>());
        let impulse = start.collision.at_common_velocity().evaluate().impulse_on_ground;
        self.unknown(Variable::Impulse(Axis::X), impulse.x).unknown(Variable::Impulse(Axis::Y), impulse.y)
    }

    /// Returns `true` if momentum alone determines the impact.
    pub fn is_by_momentum(&self) -> bool {
        self.unknowns.iter().any(|unknown| matches!(unknown.of, Variable::Impulse(_)))
    }

    /// Adds an unknown without bounds of its own.
    #[must_use]
    pub fn unknown(self, of: Variable, start: f64) -> Self {
        self.with(Unknown::free(of, start))
    }

    /// Adds an unknown between two bounds.
    #[must_use]
    pub fn between(self, of: Variable, start: f64, min: f64, max: f64) -> Self {
        self.with(Unknown { min: Some(min), max: Some(max), ..Unknown::free(of, start) })
    }

    /// Adds an unknown with prior knowledge: a value and its standard deviation.
    #[must_use]
    pub fn prior(self, of: Variable, value: f64, sd: f64) -> Self {
        self.with(Unknown { prior: Some(sd), ..Unknown::free(of, value) })
    }

    /// Adds an unknown; bounds of an angle that leave out no direction are none ([`Unknown::on_the_circle`]).
    #[must_use]
    pub fn with(mut self, unknown: Unknown) -> Self {
        self.unknowns.push(unknown.on_the_circle());
        self
    }

    /// Adds a piece of evidence.
    #[must_use]
    pub fn evidence(mut self, of: Measurand, value: f64, uncertainty: Uncertainty) -> Self {
        self.evidence.push(Evidence { of, value, uncertainty });
        self
    }

    /// Returns the place of a quantity among the unknowns, or `None` if it is none of them.
    pub(super) fn place_of(&self, of: Measurand) -> Option<usize> {
        self.unknowns.iter().position(|unknown| Measurand::Variable(unknown.of) == of)
    }

    /// Returns the evidence, followed by the priors.
    pub(super) fn all_evidence(&self) -> Vec<Evidence> {
        self.evidence.iter().copied().chain(self.unknowns.iter().filter_map(Unknown::as_evidence)).collect()
    }

    /// Returns the dependences of evidence that there is on unknowns that there are.
    pub(super) fn placed_dependences(&self) -> Vec<PlacedDependence> {
        let evidence = |of: Measurand| self.evidence.iter().position(|evidence| evidence.of == of);
        let unknown = |on: Variable| self.unknowns.iter().position(|unknown| unknown.of == on);
        let placed = |one: &Dependence| {
            let Dependence { of, on, at, slope } = *one;
            Some(PlacedDependence { evidence: evidence(of)?, unknown: unknown(on)?, at, slope })
        };
        self.dependences.iter().filter_map(placed).collect()
    }
}
