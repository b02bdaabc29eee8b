//! Guaranteed range of an output over a box of uncertain numbers.
//!
//! Branch and bound on interval arithmetic: the box is divided into cells, and each has a bound that no point of it exceeds, whatever the rounding. A bound is
//! the best of these: that of the formula itself; that of the mean value theorem about the best center of the cell (Baumann 1988) with the derivatives over
//! the cell; and, where few numbers are left, that of Taylor's theorem to second order. Cells are divided in the order of their bounds until the best one is
//! within the gap of a value that is attained. Where physics refuses no part of a cell, a number in which the output is monotone is held at its end.

mod descent;
mod impact_output;
mod minimum;
mod objective;
mod smooth;

use alloc::boxed::Box;
use alloc::vec::Vec;
use core::fmt;

pub use self::objective::{Bounded, Enclosure};

use self::impact_output::ImpactOutput;
use self::minimum::{MOST_BENT, Minimum, minimum, refused_part};
use self::objective::Objective;
use crate::collision::Collision;
use crate::input::NoSuchInput;
use crate::output::Output;
use crate::refusal::Refusals;
use crate::scalar::interval::Interval;
use crate::uncertainty::Mapping;

/// Cells that may be divided to find out which part of a box physics refuses.
const CELLS_OF_REFUSAL: usize = 256;

/// Limits of a search for bounds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Search {
    /// Accepted distance between a bound and the attained value, as a share of the greater magnitude of the two attained values.
    pub gap: f64,
    /// Number of cells that may be divided, in all.
    pub cells: usize,
}

impl Default for Search {
    /// A gap of 10⁻⁹ and a million cells.
    fn default() -> Self {
        Search { gap: 1e-9, cells: 1_000_000 }
    }
}

impl Search {
    /// Returns the search that computes the function, or a part of its derivatives, about that often over a box of so many uncertain numbers.
    pub fn of_evaluations(evaluations: usize, numbers: usize) -> Search {
        // Of a cell: itself, its center, and its slope by each number; near the best value each second derivative, which takes as long as nine values.
        let bends = if numbers <= MOST_BENT { 3 * numbers + 9 * numbers * (numbers + 1) / 2 } else { 0 };
        Search { cells: evaluations / (4 + numbers + bends), ..Search::default() }
    }
}

/// Part of a box that physics refuses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RefusedPart {
    /// Physics refuses no point of the box.
    None,
    /// It refuses some, or this could not be decided.
    Some,
    /// It refuses every point.
    All,
}

/// Guaranteed range of an output, in SI and radians.
///
/// `low` ≤ least value where physics accepts the collision ≤ `low_attained`, and in the same way for the greatest one; the attained values are those of f64, and
/// differ from exact ones by their rounding.
///
/// The range of a principal direction of force is that of the angle within a half turn of the direction at the first accepted point, so that it may
/// reach beyond π.
#[derive(Clone, Debug, PartialEq)]
pub struct Bounds {
    /// No value is below it.
    pub low: f64,
    /// No value is above it.
    pub high: f64,
    /// Least value found.
    pub low_attained: f64,
    /// Greatest value found.
    pub high_attained: f64,
    /// The uncertain numbers at which the least value is attained.
    pub at_low: Vec<f64>,
    /// The uncertain numbers at which the greatest value is attained.
    pub at_high: Vec<f64>,
    /// Whether both bounds are within the gap of the attained values, or within the rounding of the interval at these points if that is at most 10⁻⁹ of the value
    /// or 10⁻⁹ in SI.
    pub is_tight: bool,
    /// The part that physics refuses: [`RefusedPart::None`] if it is proven that it refuses none, else [`RefusedPart::Some`].
    pub refused: RefusedPart,
    /// Number of cells that were divided.
    pub cells: usize,
}

/// Reason why there are no bounds.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum NoBounds {
    /// The number of ranges is not that of the uncertain numbers.
    Count {
        /// Number of ranges.
        ranges: usize,
        /// Number of uncertain numbers.
        numbers: usize,
    },
    /// The collision has no such input.
    NoSuchInput(NoSuchInput),
    /// A range is not finite or not in order.
    Range {
        /// Its place, from 0.
        place: usize,
        /// Its lower end.
        low: f64,
        /// Its upper end.
        high: f64,
    },
    /// Physics refuses every point of the box.
    Refused {
        /// The reasons at the middle of the box, if f64 finds them there.
        at_the_middle: Option<Box<Refusals>>,
    },
    /// No accepted point was found, although physics may accept some.
    NoAcceptedPoint {
        /// Number of cells that were divided.
        cells: usize,
    },
}

impl fmt::Display for NoBounds {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            NoBounds::Count { ranges, numbers } => write!(f, "{ranges} ranges for {numbers} uncertain numbers; give one for each"),
            NoBounds::NoSuchInput(reason) => write!(f, "{reason}"),
            NoBounds::Range { place, low, high } => {
                write!(f, "range {} is {low} to {high}; give two finite numbers, the smaller one first", place + 1)
            }
            NoBounds::Refused { at_the_middle: Some(refusals) } => {
                write!(f, "physics refuses every point of the box, at its middle because: {refusals}")
            }
            NoBounds::Refused { at_the_middle: None } => write!(f, "physics refuses every point of the box; check the ranges"),
            NoBounds::NoAcceptedPoint { cells } => {
                write!(f, "no point that physics accepts was found in {cells} trials; narrow the ranges about one, or allow more cells")
            }
        }
    }
}

impl core::error::Error for NoBounds {}

/// Computes the guaranteed range of one output over a box of uncertain numbers, each within its range.
///
/// `goes_on` is called now and then with the number of cells divided so far; if it returns `false` the search ends with the bounds that it has. The mapping
/// has to be continuous.
///
/// ```
/// use planar_impact::uncertainty::{Direct, Search, bounds};
/// use planar_impact::*;
/// let car = Vehicle::new(1500.0, 2500.0).with_impact_center(2.0, 0.3).with_speed(15.0);
/// let collision = Collision::new(car, Party::Barrier);
/// let uncertain = Direct(vec![Input::VelocityX(Side::One), Input::Restitution]);
/// let delta_v = Output::DeltaVMagnitude(Side::One);
/// let range = bounds(&collision, &uncertain, &[(14.0, 16.0), (0.0, 0.2)], delta_v, &Search::default(), &|_| true)?;
/// assert!(range.is_tight && range.low <= range.low_attained && range.low_attained < range.high_attained);
/// // Slowest without restitution, fastest with most of it.
/// assert_eq!((range.at_low, range.at_high), (vec![14.0, 0.0], vec![16.0, 0.2]));
/// # Ok::<(), planar_impact::uncertainty::NoBounds>(())
/// ```
///
/// # Errors
///
/// [`NoBounds`]: a range that is not finite or not in order, an input that the collision does not have, or a box of which no point is accepted.
pub fn bounds(
    base: &Collision,
    mapping: &impl Mapping,
    ranges: &[(f64, f64)],
    of: Output,
    search: &Search,
    goes_on: &(dyn Fn(u64) -> bool + Sync),
) -> Result<Bounds, NoBounds> {
    if let Some(input) = mapping.inputs().iter().copied().find(|input| base.input(*input).is_none()) {
        return Err(NoBounds::NoSuchInput(NoSuchInput(input)));
    }
    let range = bounds_of(&mut ImpactOutput::new(base, mapping, of), ranges, search, goes_on);
    let lawful = |range: Bounds| {
        let (least, most) = limits(base, mapping, ranges, of);
        Bounds { low: range.low.max(least).min(range.low_attained), high: range.high.min(most).max(range.high_attained), ..range }
    };
    range.map(lawful).map_err(|reason| match reason {
        NoBounds::Refused { .. } => {
            let middle: Vec<f64> = ranges.iter().map(|(low, high)| 0.5 * low + 0.5 * high).collect();
            NoBounds::Refused { at_the_middle: mapping.apply::<f64>(base, &middle).solve().err().map(Box::new) }
        }
        other => other,
    })
}

/// Returns what an output of no accepted collision of a box is beyond, but for rounding: no energy and no magnitude is below zero, no more is lost or left than there was, and
/// the normal impulse only takes energy.
fn limits(base: &Collision, mapping: &impl Mapping, ranges: &[(f64, f64)], of: Output) -> (f64, f64) {
    let available = || {
        let whole: Option<Vec<Interval>> = ranges.iter().map(|&(low, high)| Interval::new(low, high)).collect();
        let collision = whole.map(|whole| mapping.apply(base, &whole));
        collision.map_or(f64::INFINITY, |collision| Output::EnergyBefore.of(&collision, &collision.evaluate()).upper())
    };
    match of {
        Output::EnergyBefore | Output::DeltaVMagnitude(_) => (0.0, f64::INFINITY),
        Output::EnergyAfter | Output::Loss => (0.0, available()),
        Output::NormalWork => (-f64::INFINITY, 0.0),
        _ => (-f64::INFINITY, f64::INFINITY),
    }
}

/// Computes the guaranteed range of any [`Bounded`] function of uncertain numbers, each within its range: see [`bounds`].
///
/// ```
/// use planar_impact::crush::{CrushStiffness, ProfileMoments};
/// use planar_impact::scalar::Real;
/// use planar_impact::scalar::interval::{Interval, Truth};
/// use planar_impact::uncertainty::{Bounded, Search, bounds_of};
///
/// /// The energy of an even crush 1.5 m wide, of its depth and d1.
/// struct EvenCrush;
///
/// impl Bounded for EvenCrush {
///     fn numbers(&self) -> usize {
///         2
///     }
///
///     fn value<T: Real + Copy + From<f64>>(&self, numbers: &[T]) -> T {
///         let [depth, slope] = [numbers[0], numbers[1]];
///         let moments = ProfileMoments::of_segment(T::from(1.5), depth, depth);
///         CrushStiffness { onset: T::from(60.0), slope }.crush_energy(moments)
///     }
///
///     fn at(&self, point: &[f64]) -> Option<f64> {
///         (point[0] >= 0.0).then(|| self.value(point))
///     }
///
///     fn is_possible(&self, cell: &[Interval]) -> Truth {
///         if cell[0].lower() >= 0.0 { Truth::TRUE } else { Truth::UNKNOWN }
///     }
///
///     fn is_continuous(&self, _cell: &[Interval], _value: Interval) -> bool {
///         true
///     }
/// }
///
/// let range = bounds_of(&mut EvenCrush, &[(0.2, 0.4), (700.0, 900.0)], &Search::default(), &|_| true)?;
/// let energy = |depth: f64, slope: f64| 0.75 * (60.0 + slope * depth).powi(2);
/// assert!(range.is_tight && (range.high - energy(0.4, 900.0)).abs() < 1e-3 && (range.low - energy(0.2, 700.0)).abs() < 1e-3);
/// # Ok::<(), planar_impact::uncertainty::NoBounds>(())
/// ```
///
/// # Errors
///
/// [`NoBounds`]: a range that is not finite or not in order, or a box of which no point is accepted.
pub fn bounds_of<F: Bounded>(
    of: &mut F,
    ranges: &[(f64, f64)],
    search: &Search,
    goes_on: &(dyn Fn(u64) -> bool + Sync),
) -> Result<Bounds, NoBounds> {
    if ranges.len() != of.numbers() {
        return Err(NoBounds::Count { ranges: ranges.len(), numbers: of.numbers() });
    }
    let mut whole = Vec::with_capacity(ranges.len());
    for (place, &(low, high)) in ranges.iter().enumerate() {
        let range = Interval::new(low, high).filter(|_| low.is_finite() && high.is_finite());
        whole.push(range.ok_or(NoBounds::Range { place, low, high })?);
    }
    let (refused, accepted) = refused_part(&Objective::new(of), &whole, search.cells.min(CELLS_OF_REFUSAL));
    if refused == RefusedPart::All {
        return Err(NoBounds::Refused { at_the_middle: None });
    }
    let start = accepted.or_else(|| Objective::new(of).accepted_in(&whole, search.cells));
    let start = start.ok_or(NoBounds::NoAcceptedPoint { cells: search.cells })?;
    of.turn_to(&start);
    let least = Objective::new(of);
    let greatest = least.negated();
    let starts = [least.descend(&start, &whole), greatest.descend(&start, &whole)];
    let scale = starts.iter().fold(0.0, |scale: f64, found| scale.max(found.value.abs()));
    let is_possible = refused == RefusedPart::None;
    let [from_low, from_high] = starts;
    let Minimum { bound: low, attained: low_at, is_tight: is_low_tight, cells: low_cells } =
        minimum(&least, &whole, from_low, is_possible, search.gap * scale, search.cells.div_ceil(2), goes_on);
    let Minimum { bound: high, attained: high_at, is_tight: is_high_tight, cells: high_cells } =
        minimum(&greatest, &whole, from_high, is_possible, search.gap * scale, search.cells - low_cells, &|cells| {
            goes_on(cells + low_cells as u64)
        });
    Ok(Bounds {
        low,
        high: -high,
        low_attained: low_at.value,
        high_attained: -high_at.value,
        at_low: low_at.point,
        at_high: high_at.point,
        is_tight: is_low_tight && is_high_tight,
        refused,
        cells: low_cells + high_cells,
    })
}
