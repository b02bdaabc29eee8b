//! Names of numbers in the input.

#[cfg(feature = "alloc")]
use alloc::{borrow::Cow, string::ToString};
use core::fmt;

use crate::input::Input;
use crate::measure::Measure;

/// A number of the input: its name, and its index in its list, counted from zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Place {
    /// Its name, such as `vehicle.1.mass`.
    pub name: &'static str,
    /// Its measure.
    pub measure: Measure,
    /// The part of it, such as its `standard deviation`; `None` for its value.
    pub part: Option<&'static str>,
    /// The series it belongs to, if there are several, counted from zero.
    pub series: Option<usize>,
    /// Its index in the list.
    pub index: Option<usize>,
}

impl Place {
    /// Creates the place of a number with a name.
    pub const fn of(name: &'static str, measure: Measure) -> Self {
        Place { name, measure, part: None, series: None, index: None }
    }

    /// Creates the place of a list, or of a number without a unit.
    pub const fn plain(name: &'static str) -> Self {
        Place::of(name, Measure::Ratio)
    }

    /// Creates the place of an input of a collision.
    pub const fn input(input: Input) -> Self {
        Place::of(input.name(), input.measure())
    }

    /// Returns the place of an item of the list, by its index counted from zero.
    #[must_use]
    pub const fn at(self, index: usize) -> Self {
        Place { index: Some(index), ..self }
    }

    /// Returns the same place in one of several series, counted from zero.
    #[must_use]
    pub const fn in_series(self, series: usize) -> Self {
        Place { series: Some(series), ..self }
    }

    /// Returns the place of another number at the same index and in the same series.
    #[must_use]
    pub const fn named(self, name: &'static str, measure: Measure) -> Self {
        Place { name, measure, ..self }
    }

    /// Returns its dotted path, with its series and index in brackets.
    #[cfg(feature = "alloc")]
    pub fn path(&self) -> Cow<'static, str> {
        match self {
            Place { name, part: None, series: None, index: None, .. } => Cow::Borrowed(name),
            place => place.to_string().into(),
        }
    }

    /// Returns the place of another part of it, such as its `standard deviation`.
    #[must_use]
    pub const fn part(self, part: &'static str) -> Self {
        Place { part: Some(part), ..self }
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(part) = self.part {
            write!(f, "{part} of ")?;
        }
        f.write_str(self.name)?;
        self.series.into_iter().chain(self.index).try_for_each(|at| write!(f, "[{at}]"))
    }
}
