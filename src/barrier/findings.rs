//! Gathers what is wrong with an input, so that all of it is said at once.

use super::problem::{Place, Problem, Problems};
use crate::scalar::Ordered;
use crate::solve::{is_finite, is_positive};
use alloc::vec::Vec;

/// A result, unless its numbers were so large or so small that it is infinite or not a number.
pub(super) fn finite<T: Ordered<Mask = bool>>(name: &'static str, result: T) -> Result<T, Problems<T>> {
    let mut findings = Findings::none();
    findings.finite(Place::of(name), &result);
    findings.done().map(|()| result)
}

/// The problems found so far.
pub(super) struct Findings<T>(Vec<Problem<T>>);

impl<T: Ordered<Mask = bool>> Findings<T> {
    pub fn none() -> Self {
        Findings(Vec::new())
    }

    pub fn push(&mut self, problem: Problem<T>) {
        self.0.push(problem);
    }

    pub fn finite(&mut self, place: Place, value: &T) -> bool {
        let finite = is_finite(value);
        if !finite {
            self.push(Problem::NotFinite { place, value: value.clone() });
        }
        finite
    }

    /// Says of a list only where it begins to be bad: a record may have a million samples.
    pub fn all_finite(&mut self, name: &'static str, values: &[T]) {
        let mut bad = (0..values.len()).filter(|&i| !is_finite(&values[i]));
        if let Some(first) = bad.next() {
            self.push(Problem::NotFiniteIn { name, first, count: 1 + bad.count() });
        }
    }

    pub fn positive(&mut self, place: Place, value: &T) -> bool {
        let finite = self.finite(place, value);
        let positive = is_positive(value);
        if finite && !positive {
            self.push(Problem::NotPositive { place, value: value.clone() });
        }
        finite && positive
    }

    pub fn within(&mut self, place: Place, value: &T, least: T, greatest: Option<T>) -> bool {
        if !self.finite(place, value) {
            return false;
        }
        let outside = value.less(&least) || greatest.as_ref().is_some_and(|greatest| greatest.less(value));
        if outside {
            self.push(Problem::OutOfRange { place, value: value.clone(), least, greatest });
        }
        !outside
    }

    pub fn not_negative(&mut self, place: Place, value: &T) -> bool {
        self.within(place, value, T::int(0), None)
    }

    pub fn at_least(&mut self, name: &'static str, count: usize, least: usize) {
        if count < least {
            self.push(Problem::TooFew { name, count, least });
        }
    }

    pub fn done(self) -> Result<(), Problems<T>> {
        if self.0.is_empty() { Ok(()) } else { Err(Problems(self.0)) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::string::ToString;

    #[test]
    fn every_problem_has_its_name_place_and_number() {
        let mut findings = Findings::none();
        findings.positive(Place::of("mass").in_series(1).at(2), &-3.0);
        findings.within(Place::of("restitution"), &1.5, 0.0, Some(1.0));
        findings.finite(Place::of("time").at(7), &f64::NAN);
        let problems = findings.done().expect_err("three problems");
        assert_eq!(problems.all().len(), 3);
        assert_eq!(
            problems.to_string(),
            "mass[1][2] is -3; it must be above zero; restitution is 1.5; it must lie between 0 and 1; time[7] is NaN; a finite number is expected"
        );
    }
}
