//! Issues of a single number or list.

#[cfg(feature = "alloc")]
mod message;

use super::place::Place;

/// A number or a list that is invalid.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct InputIssue<T = f64> {
    /// Its place.
    pub at: Place,
    /// The kind of issue.
    pub kind: InputIssueKind<T>,
}

/// Kind of issue of a number or a list.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub enum InputIssueKind<T = f64> {
    /// It is infinite or not a number.
    NotFinite {
        /// The number.
        value: T,
    },
    /// Several numbers of a list are infinite or NaN; the place is that of the first.
    SeveralNotFinite {
        /// Number of such values.
        count: usize,
    },
    /// It must be above zero.
    NotPositive {
        /// The number.
        value: T,
    },
    /// It must lie within bounds, both accepted.
    OutOfRange {
        /// The number.
        value: T,
        /// The lower bound.
        least: T,
        /// The upper bound, if there is one.
        greatest: Option<T>,
    },
    /// It is on the wrong side of the number before it.
    OutOfOrder {
        /// The number.
        value: T,
        /// The number before it.
        before: T,
    },
    /// The list is too short.
    TooFew {
        /// Its length.
        count: usize,
        /// The required length.
        least: usize,
    },
}

impl<T> InputIssue<T> {
    /// Creates the issue of a number that must be above zero and is not.
    pub const fn not_positive(at: Place, value: T) -> Self {
        InputIssue { at, kind: InputIssueKind::NotPositive { value } }
    }

    /// Creates the issue of a number on the wrong side of the one before it.
    pub const fn out_of_order(at: Place, value: T, before: T) -> Self {
        InputIssue { at, kind: InputIssueKind::OutOfOrder { value, before } }
    }

    /// Creates the issue of a list that is too short.
    pub const fn too_few(list: Place, count: usize, least: usize) -> Self {
        InputIssue { at: list, kind: InputIssueKind::TooFew { count, least } }
    }

    /// Returns a stable name of the kind of issue, in kebab case.
    pub const fn code(&self) -> &'static str {
        match self.kind {
            InputIssueKind::NotFinite { .. } | InputIssueKind::SeveralNotFinite { .. } => "not-finite",
            InputIssueKind::NotPositive { .. } => "not-positive",
            InputIssueKind::OutOfRange { .. } => "out-of-range",
            InputIssueKind::OutOfOrder { .. } => "out-of-order",
            InputIssueKind::TooFew { .. } => "too-few",
        }
    }
}
