//! What can be wrong with a test as it is given. All of it is said at once, by name, place and number.

use alloc::vec::Vec;
use core::fmt;

/// A number of the input: its name, and where it stands in its list, counted from zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Place {
    /// What it is.
    pub name: &'static str,
    /// The series it belongs to, of several.
    pub series: Option<usize>,
    /// Its place in the list.
    pub index: Option<usize>,
}

/// Why a test, a record or a fit is refused.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Problem<T = f64> {
    /// A number is infinite or not a number.
    NotFinite {
        /// Which.
        place: Place,
        /// Its value.
        value: T,
    },
    /// Some numbers of a list are infinite or not a number.
    NotFiniteIn {
        /// What it is a list of.
        name: &'static str,
        /// The place of the first of them.
        first: usize,
        /// How many there are.
        count: usize,
    },
    /// A number that must be above zero is not.
    NotPositive {
        /// Which.
        place: Place,
        /// Its value.
        value: T,
    },
    /// A number lies outside of its range.
    OutOfRange {
        /// Which.
        place: Place,
        /// Its value.
        value: T,
        /// The least that is accepted.
        least: T,
        /// The greatest that is accepted, if there is one.
        greatest: Option<T>,
    },
    /// A list is too short.
    TooFew {
        /// What it is a list of.
        name: &'static str,
        /// How many there are.
        count: usize,
        /// How many there must be.
        least: usize,
    },
    /// Two lists that belong together have not the same length, or two channels not the same instants.
    NotAlike {
        /// The list that differs.
        place: Place,
        /// What it must be like.
        like: &'static str,
    },
    /// A number that must not be below the one before it is, or a time is not after the one before it.
    OutOfOrder {
        /// Which.
        place: Place,
        /// Its value.
        value: T,
        /// The value before it.
        before: T,
    },
    /// No profile has these moments: the mean of the squares of its depths would be below the square of their mean.
    ImpossibleProfile {
        /// Which.
        place: Place,
        /// The mean depth, in m.
        mean: T,
        /// The mean of the squares of the depths, in m².
        mean_square: T,
    },
    /// All tests have the same mean depth, so no line can be laid through them.
    OneDepth {
        /// The mean depth of all, in m.
        depth: T,
    },
    /// The speed that is assumed to leave no crush is above the speed that the test has left after restitution.
    OnsetTooFast {
        /// The assumed onset speed b₀, in m/s.
        onset: T,
        /// The speed of the test, v √(1 − e²), in m/s.
        speed: T,
    },
    /// A record is sampled too slowly for its filter.
    SampledTooSlowly {
        /// The time between two samples, in s.
        step: T,
        /// The longest time that is accepted, in s.
        longest: T,
    },
    /// A record that must be sampled at equal intervals is not.
    NotUniform,
    /// Too few points have a weight for a line through them.
    SpanTooNarrow {
        /// How many neighbors were taken.
        neighbors: usize,
        /// Where, in s.
        time: T,
    },
    /// The fit did not settle.
    NotConverged {
        /// The steps taken.
        steps: usize,
    },
}

/// All the problems of an input; never empty.
#[derive(Clone, Debug, PartialEq)]
pub struct Problems<T = f64>(pub(super) Vec<Problem<T>>);

impl<T> Problems<T> {
    /// The problems, in the order in which they were found.
    pub fn all(&self) -> &[Problem<T>] {
        &self.0
    }

    /// The same problems of a test that stands in a list: in which series and at which place, both counted from zero. What has a place already keeps it.
    ///
    /// ```
    /// use planar_impact::barrier::BarrierTest;
    /// use planar_impact::crush::ProfileMoments;
    /// let crush = ProfileMoments::of(1.5, &[0.3, 0.5]).unwrap();
    /// let problems = BarrierTest { mass: -1.0, speed: 15.6, restitution: 0.0, crush }.stiffness(2.0).unwrap_err();
    /// assert_eq!(problems.of_test(2, 0).to_string(), "mass[2][0] is -1; it must be above zero");
    /// ```
    #[must_use]
    pub fn of_test(mut self, series: usize, index: usize) -> Self {
        for place in self.0.iter_mut().filter_map(Problem::place_mut) {
            place.series.get_or_insert(series);
            place.index.get_or_insert(index);
        }
        self
    }
}

impl<T> Problem<T> {
    /// Where the input has what is wrong, if the problem is one of a place.
    pub fn place(&self) -> Option<&Place> {
        match self {
            Problem::NotFinite { place, .. }
            | Problem::NotPositive { place, .. }
            | Problem::OutOfRange { place, .. }
            | Problem::NotAlike { place, .. }
            | Problem::OutOfOrder { place, .. }
            | Problem::ImpossibleProfile { place, .. } => Some(place),
            _ => None,
        }
    }

    fn place_mut(&mut self) -> Option<&mut Place> {
        match self {
            Problem::NotFinite { place, .. }
            | Problem::NotPositive { place, .. }
            | Problem::OutOfRange { place, .. }
            | Problem::NotAlike { place, .. }
            | Problem::OutOfOrder { place, .. }
            | Problem::ImpossibleProfile { place, .. } => Some(place),
            _ => None,
        }
    }
}

impl<T> From<Problem<T>> for Problems<T> {
    fn from(problem: Problem<T>) -> Self {
        Problems(alloc::vec![problem])
    }
}

impl Place {
    pub(super) const fn of(name: &'static str) -> Self {
        Place { name, series: None, index: None }
    }

    pub(super) const fn at(self, index: usize) -> Self {
        Place { index: Some(index), ..self }
    }

    pub(super) const fn in_series(self, series: usize) -> Self {
        Place { series: Some(series), ..self }
    }

    pub(super) const fn named(self, name: &'static str) -> Self {
        Place { name, ..self }
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name)?;
        self.series.into_iter().chain(self.index).try_for_each(|at| write!(f, "[{at}]"))
    }
}

impl<T: fmt::Display> fmt::Display for Problem<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Problem::NotFinite { place, value } => write!(f, "{place} is {value}; a finite number is expected"),
            Problem::NotFiniteIn { name, first, count } => {
                write!(f, "{count} of the {name} are not finite numbers, the first is {name}[{first}]")
            }
            Problem::NotPositive { place, value } => write!(f, "{place} is {value}; it must be above zero"),
            Problem::OutOfRange { place, value, least, greatest: Some(greatest) } => {
                write!(f, "{place} is {value}; it must lie between {least} and {greatest}")
            }
            Problem::OutOfRange { place, value, least, greatest: None } => write!(f, "{place} is {value}; it must be at least {least}"),
            Problem::TooFew { name, count, least } => write!(f, "{name}: there are {count}; at least {least} are needed"),
            Problem::NotAlike { place, like } => write!(f, "{place} must be like {like}"),
            Problem::OutOfOrder { place, value, before } => write!(f, "{place} is {value} after {before}; it is out of order"),
            Problem::ImpossibleProfile { place, mean, mean_square } => {
                write!(
                    f,
                    "{place} has a mean depth of {mean} and a mean square of {mean_square}, which is less than the square of the mean"
                )
            }
            Problem::OneDepth { depth } => write!(f, "every test has the mean depth {depth}; two different depths are needed"),
            Problem::OnsetTooFast { onset, speed } => {
                write!(f, "the speed that leaves no crush is assumed to be {onset}; the test left crush at {speed}")
            }
            Problem::SampledTooSlowly { step, longest } => {
                write!(f, "the samples are {step} s apart; the filter needs them at most {longest} s apart")
            }
            Problem::NotUniform => write!(f, "the record is not sampled at equal intervals, as the filter needs it"),
            Problem::SpanTooNarrow { neighbors, time } => {
                write!(f, "{neighbors} neighbors are too few for a line at {time} s and for its uncertainty")
            }
            Problem::NotConverged { steps } => write!(f, "the fit did not settle in {steps} steps"),
        }
    }
}

impl<T: fmt::Display> fmt::Display for Problems<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, problem) in self.0.iter().enumerate() {
            if i > 0 {
                f.write_str("; ")?;
            }
            write!(f, "{problem}")?;
        }
        Ok(())
    }
}

impl<T: fmt::Debug + fmt::Display> core::error::Error for Problem<T> {}
impl<T: fmt::Debug + fmt::Display> core::error::Error for Problems<T> {}
