//! Issues of one input, and a collector for them.

use core::fmt;

use super::input::{InputIssue, InputIssueKind};
use super::place::Place;
use crate::scalar::{Ordered, is_finite, is_positive};

#[cfg(feature = "alloc")]
type List<I> = alloc::vec::Vec<I>;
#[cfg(not(feature = "alloc"))]
type List<I> = arrayvec::ArrayVec<I, { crate::Input::COUNT }>;

/// All issues of one input, in the order in which they were found; never empty.
///
/// Without the feature `alloc` it holds at most [`Input::COUNT`](crate::Input::COUNT) issues, which is all that a collision can have at once.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Issues<I>(List<I>);

impl<I> Issues<I> {
    /// Returns the first issue.
    pub fn first(&self) -> &I {
        &self.0[0]
    }

    /// Returns all issues.
    pub fn as_slice(&self) -> &[I] {
        &self.0
    }

    /// Iterates over the issues.
    pub fn iter(&self) -> core::slice::Iter<'_, I> {
        self.0.iter()
    }

    /// Iterates over the issues mutably.
    pub fn iter_mut(&mut self) -> core::slice::IterMut<'_, I> {
        self.0.iter_mut()
    }

    /// Returns the number of issues, at least one.
    #[expect(clippy::len_without_is_empty, reason = "it is never empty")]
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Converts each issue, such as to one of a larger input.
    #[must_use]
    pub fn map<J>(self, of: impl FnMut(I) -> J) -> Issues<J> {
        Issues(self.0.into_iter().map(of).collect())
    }
}

impl<I> From<I> for Issues<I> {
    fn from(issue: I) -> Self {
        Issues(List::from_iter([issue]))
    }
}

impl<I> IntoIterator for Issues<I> {
    type Item = I;
    type IntoIter = <List<I> as IntoIterator>::IntoIter;

    fn into_iter(self) -> Self::IntoIter {
        self.0.into_iter()
    }
}

impl<'a, I> IntoIterator for &'a Issues<I> {
    type Item = &'a I;
    type IntoIter = core::slice::Iter<'a, I>;

    fn into_iter(self) -> Self::IntoIter {
        self.0.iter()
    }
}

impl<I: fmt::Display> fmt::Display for Issues<I> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, issue) in self.0.iter().enumerate() {
            if i > 0 {
                f.write_str("; ")?;
            }
            issue.fmt(f)?;
        }
        Ok(())
    }
}

impl<I: fmt::Debug + fmt::Display> core::error::Error for Issues<I> {}

/// Collects the issues of an input, so that all are reported at once. Without the feature `alloc` it keeps the first
/// [`Input::COUNT`](crate::Input::COUNT) issues.
///
/// ```
/// use planar_impact::issue::{InputIssue, IssueCollector, Place};
/// use planar_impact::Measure;
/// let mut issues = IssueCollector::<InputIssue>::new();
/// issues.positive(Place::of("mass", Measure::Mass), &-2.0);
/// issues.within(Place::plain("share"), &0.5, 0.0, Some(1.0));
/// let issues = issues.finish().unwrap_err();
/// assert_eq!(issues.to_string(), "mass is -2 kg; it must be above zero");
/// ```
#[derive(Clone, Debug)]
pub struct IssueCollector<I>(List<I>);

impl<I> IssueCollector<I> {
    /// Creates an empty collector.
    #[must_use]
    pub const fn new() -> Self {
        #[cfg(feature = "alloc")]
        return IssueCollector(List::new());
        #[cfg(not(feature = "alloc"))]
        return IssueCollector(List::new_const());
    }

    /// Adds an issue.
    pub fn push(&mut self, issue: impl Into<I>) {
        #[cfg(feature = "alloc")]
        self.0.push(issue.into());
        #[cfg(not(feature = "alloc"))]
        let _ = self.0.try_push(issue.into());
    }

    /// Returns the number of issues so far.
    pub fn count(&self) -> usize {
        self.0.len()
    }

    /// Returns `true` if a number is finite, and adds an issue otherwise.
    #[inline]
    pub fn finite<T: Ordered<Mask = bool>>(&mut self, at: Place, value: &T) -> bool
    where
        I: From<InputIssue<T>>,
    {
        let finite = is_finite(value);
        if !finite {
            self.push(InputIssue { at, kind: InputIssueKind::NotFinite { value: value.clone() } });
        }
        finite
    }

    /// Returns `true` if all numbers of a list are finite, and adds a single issue otherwise, since a record may have a million samples.
    pub fn all_finite<T: Ordered<Mask = bool>>(&mut self, list: Place, values: &[T]) -> bool
    where
        I: From<InputIssue<T>>,
    {
        let mut bad = (0..values.len()).filter(|&i| !is_finite(&values[i]));
        let Some(first) = bad.next() else { return true };
        match 1 + bad.count() {
            1 => self.finite(list.at(first), &values[first]),
            count => {
                self.push(InputIssue { at: list.at(first), kind: InputIssueKind::SeveralNotFinite { count } });
                false
            }
        }
    }

    /// Returns `true` if a number is finite and above zero, and adds an issue otherwise.
    #[inline]
    pub fn positive<T: Ordered<Mask = bool>>(&mut self, at: Place, value: &T) -> bool
    where
        I: From<InputIssue<T>>,
    {
        if !self.finite(at, value) {
            return false;
        }
        let positive = is_positive(value);
        if !positive {
            self.push(InputIssue::not_positive(at, value.clone()));
        }
        positive
    }

    /// Returns `true` if a number is finite and within bounds, both accepted, and adds an issue otherwise.
    #[inline]
    pub fn within<T: Ordered<Mask = bool>>(&mut self, at: Place, value: &T, least: T, greatest: Option<T>) -> bool
    where
        I: From<InputIssue<T>>,
    {
        if !self.finite(at, value) {
            return false;
        }
        let outside = value.less(&least) || greatest.as_ref().is_some_and(|greatest| greatest.less(value));
        if outside {
            self.push(InputIssue { at, kind: InputIssueKind::OutOfRange { value: value.clone(), least, greatest } });
        }
        !outside
    }

    /// Returns `true` if a number is finite and not below zero, and adds an issue otherwise.
    #[inline]
    pub fn not_negative<T: Ordered<Mask = bool>>(&mut self, at: Place, value: &T) -> bool
    where
        I: From<InputIssue<T>>,
    {
        self.within(at, value, T::int(0), None)
    }

    /// Returns `true` if a list is long enough, and adds an issue otherwise.
    pub fn at_least<T>(&mut self, list: Place, count: usize, least: usize) -> bool
    where
        I: From<InputIssue<T>>,
    {
        if count < least {
            self.push(InputIssue::too_few(list, count, least));
        }
        count >= least
    }

    /// Returns the collected issues.
    ///
    /// # Errors
    ///
    /// All issues, if there are any.
    pub fn finish(self) -> Result<(), Issues<I>> {
        if self.0.is_empty() { Ok(()) } else { Err(Issues(self.0)) }
    }
}

impl<I> Default for IssueCollector<I> {
    fn default() -> Self {
        IssueCollector::new()
    }
}
