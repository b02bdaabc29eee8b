//! Guaranteed ranges of the unknowns: set inversion (Jaulin and Walter 1993).
//!
//! What is known of the crash is a set of equations, f(x) = y + s: each piece of evidence holds with an error s within its limits, zero if it is exact. The
//! range of an unknown is that of its values over every x within its limits and every s within its own that meet all equations. The box of all of them is
//! divided into cells in the order of the unknown's least value. A cell is narrowed by the theorem of the mean, solved for one number after the other with the
//! derivatives over the cell as intervals, and dropped if it cannot meet an equation or physics refuses all of it. What is dropped holds no answer, whatever
//! the rounding; the values that are attained are those of points that f64 solves for.

mod elimination;
mod end;
mod equations;

use core::fmt;

use self::end::{End, Found};
use self::equations::Equations;
use super::given::{ReconstructionProblem, Search};
use super::issue::ReconstructionIssues;
use super::variable::Variable;

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
    /// Where the search ended on either side because nothing limits the unknown, such as at 200 m/s: no value beyond was looked at.
    pub assumed: [Option<f64>; 2],
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
        // What attains the end of one unknown meets the evidence for all of them.
        let mut points = equations.fits(&|| goes_on(0));
        let mut spent = 0;
        let mut ends = Vec::with_capacity(self.unknowns.len());
        for of in 0..self.unknowns.len() {
            let low = End::least(&equations, of, &points).find(search, search.cells.div_ceil(2), &|cells| goes_on(spent + cells))?;
            points.push(low.attained.clone());
            spent += low.cells;
            let high = End::greatest(&equations, of, &points).find(search, search.cells - low.cells, &|cells| goes_on(spent + cells))?;
            points.push(high.attained.clone());
            spent += high.cells;
            ends.push([low, high]);
        }
        Ok(ends.iter().enumerate().map(|(of, ends)| equations.range(of, ends, &points, search)).collect())
    }
}

impl GuaranteedSearch {
    /// Returns `true` if a least value is as near to its bound as is asked, of an unknown with this significant change.
    fn is_tight(&self, bound: f64, attained: f64, scale: f64) -> bool {
        attained - bound <= self.gap * attained.abs().max(scale)
    }
}

impl Equations<'_> {
    /// Returns points that meet the evidence, near those at which it fits best.
    fn fits(&self, goes_on: &dyn Fn() -> bool) -> Vec<Vec<f64>> {
        let found = self.problem.solve_while(&Search::default(), &|_, _| goes_on());
        let solutions = found.map(|answer| answer.solutions).unwrap_or_default();
        solutions.iter().filter_map(|solution| self.met_near(&solution.values())).collect()
    }

    /// Returns the range of the unknown at a place between proven ends, as far as any point attains it.
    fn range(&self, of: usize, [low, high]: &[Found; 2], points: &[Vec<f64>], search: &GuaranteedSearch) -> GuaranteedRange {
        let scale = self.scale(of);
        let at_low = points.iter().fold(&low.attained, |best, point| if point[of] < best[of] { point } else { best });
        let at_high = points.iter().fold(&high.attained, |best, point| if point[of] > best[of] { point } else { best });
        GuaranteedRange {
            of: self.problem.unknowns[of].of,
            low: low.bound,
            high: -high.bound,
            low_attained: at_low[of],
            high_attained: at_high[of],
            at_low: at_low[..self.unknowns()].to_vec(),
            at_high: at_high[..self.unknowns()].to_vec(),
            is_tight: search.is_tight(low.bound, at_low[of], scale) && search.is_tight(high.bound, -at_high[of], scale),
            assumed: self.assumed[of],
            cells: low.cells + high.cells,
        }
    }
}
