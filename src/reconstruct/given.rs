//! The question: a collision, what of it is unknown, and what is known instead.

use super::measurable::Measurable;
use super::problem::{Problems, check};
use super::variable::Variable;
use crate::collision::Collision;

/// How well a piece of evidence is known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Uncertainty {
    /// Its standard deviation, in its unit.
    StandardDeviation(f64),
    /// The step that it is read or recorded in: anything within half a step is as likely, so its standard deviation is the step over √12.
    Resolution(f64),
    /// As good as known: it is held to a millionth of its size, and adds nothing to the uncertainty of the answer.
    Exact,
}

/// Something known of the crash.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Evidence {
    /// What it is of.
    pub of: Measurable,
    /// Its value, in SI.
    pub value: f64,
    /// How well it is known.
    pub uncertainty: Uncertainty,
}

/// Something to be solved for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unknown {
    /// What it is.
    pub of: Variable,
    /// Where the first search starts, in SI.
    pub start: f64,
    /// The least it may be; none where only the mechanics says so.
    pub min: Option<f64>,
    /// The most it may be.
    pub max: Option<f64>,
    /// How well `start` is known beforehand, as a standard deviation: then it is evidence too.
    pub prior: Option<f64>,
}

/// Two pieces of evidence whose errors go together, as those of one vehicle that a path to rest has been traced back from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Correlation {
    /// One piece.
    pub one: Measurable,
    /// The other.
    pub other: Measurable,
    /// Their coefficient of correlation, between −1 and 1.
    pub coefficient: f64,
}

/// What is asked: the collision, what of it is unknown, and the evidence.
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
/// let question = Reconstruction::of(collision)
///     .unknown(Variable::Speed(Side::One), 10.0)
///     .evidence(Measurable::CrushEnergy, 80e3, Uncertainty::StandardDeviation(4e3));
/// let answer = question.solve(&Search::default())?;
/// assert_eq!(answer.verdict, Verdict::Agrees);
/// let speed = &answer.best().unknowns[0];
/// println!("{:.1} m/s ± {:.1} m/s", speed.value, speed.sd.unwrap_or(f64::NAN));
/// # assert!((answer.best().impact.work.n + 80e3).abs() < 1e-6);
/// # Ok::<(), Unsolved>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Reconstruction {
    /// The collision. What it has for the unknowns does not matter.
    pub collision: Collision,
    /// What is solved for.
    pub unknowns: Vec<Unknown>,
    /// What is known of the crash.
    pub evidence: Vec<Evidence>,
    /// Evidence whose errors go together.
    pub correlations: Vec<Correlation>,
    /// Whether vehicle 1 and vehicle 2 drive along their headings: a heading that is unknown then turns the velocity with it. One whose speed is unknown does.
    pub drives_along_heading: [bool; 2],
    /// The share of the crush energy that vehicle 1 has, where it is known.
    pub crush_share: Option<f64>,
}

/// How an answer is searched for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Search {
    /// How many starts there are: the first the given one, the others drawn within the bounds. With more than one, a few searches beside the solutions follow.
    pub starts: usize,
    /// Seed of those draws.
    pub seed: u64,
    /// The most steps that one search takes.
    pub iterations: usize,
}

impl Default for Search {
    /// 64 starts of at most 200 steps, always with the same seed.
    fn default() -> Self {
        Search { starts: 64, seed: 1, iterations: 200 }
    }
}

impl Uncertainty {
    /// The standard deviation; none of what is exact.
    pub fn standard_deviation(self) -> Option<f64> {
        match self {
            Uncertainty::StandardDeviation(sd) => Some(sd),
            Uncertainty::Resolution(step) => Some(step / 12_f64.sqrt()),
            Uncertainty::Exact => None,
        }
    }
}

impl Evidence {
    /// What a residual is divided by.
    pub(super) fn weight_scale(&self) -> f64 {
        /// The share of its size that something exact is held to.
        const EXACT: f64 = 1e-6;
        let sd = self.uncertainty.standard_deviation();
        sd.unwrap_or_else(|| EXACT * self.value.abs().max(self.of.least_size()))
    }
}

impl Unknown {
    /// What its prior says, if it has one.
    pub(super) fn as_evidence(&self) -> Option<Evidence> {
        let sd = self.prior?;
        Some(Evidence { of: Measurable::Variable(self.of), value: self.start, uncertainty: Uncertainty::StandardDeviation(sd) })
    }
}

impl Reconstruction {
    /// Of a collision, so far with nothing unknown and no evidence.
    pub fn of(collision: Collision) -> Self {
        Reconstruction {
            collision,
            unknowns: Vec::new(),
            evidence: Vec::new(),
            correlations: Vec::new(),
            drives_along_heading: [false; 2],
            crush_share: None,
        }
    }

    /// With one more unknown, without bounds of its own.
    #[must_use]
    pub fn unknown(self, of: Variable, start: f64) -> Self {
        self.with(Unknown { of, start, min: None, max: None, prior: None })
    }

    /// With one more unknown, between two bounds.
    #[must_use]
    pub fn between(self, of: Variable, start: f64, min: f64, max: f64) -> Self {
        self.with(Unknown { of, start, min: Some(min), max: Some(max), prior: None })
    }

    /// With one more unknown that something is known of beforehand: a value and its standard deviation.
    #[must_use]
    pub fn prior(self, of: Variable, value: f64, sd: f64) -> Self {
        self.with(Unknown { of, start: value, min: None, max: None, prior: Some(sd) })
    }

    /// With one more unknown.
    #[must_use]
    pub fn with(mut self, unknown: Unknown) -> Self {
        self.unknowns.push(unknown);
        self
    }

    /// With one more piece of evidence.
    #[must_use]
    pub fn evidence(mut self, of: Measurable, value: f64, uncertainty: Uncertainty) -> Self {
        self.evidence.push(Evidence { of, value, uncertainty });
        self
    }

    /// The evidence, and what the priors say after it.
    pub(super) fn all_evidence(&self) -> Vec<Evidence> {
        self.evidence.iter().copied().chain(self.unknowns.iter().filter_map(Unknown::as_evidence)).collect()
    }

    /// Whether the question can be asked.
    ///
    /// # Errors
    ///
    /// Every problem with it, from a bound above another to more unknowns than evidence.
    pub fn check(&self) -> Result<(), Problems> {
        check(self)
    }
}
