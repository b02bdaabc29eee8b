//! Repeated tests of one vehicle: the energies add up, and the crush measured after each test is cumulative.

use super::issue::{TestIssue, TestIssues};
use super::test::BarrierTest;
use crate::crush::equivalent_energy_speed;
use crate::issue::{InputIssue, IssueCollector, Place};
use crate::measure::Measure;
use crate::scalar::{Field, Ordered, Real};
use alloc::vec::Vec;

/// Consecutive tests of one vehicle, in order.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(try_from = "Vec<BarrierTest<T>>", bound(deserialize = "T: serde::Deserialize<'de> + Ordered<Mask = bool> + core::fmt::Display"))
)]
pub struct TestSeries<T = f64>(Vec<BarrierTest<T>>);

impl<T: Ordered<Mask = bool>> TestSeries<T> {
    /// Creates a series from the tests in their order.
    ///
    /// # Errors
    ///
    /// If there are no tests, and for every invalid number and every mean depth below that of the test before.
    pub fn new(tests: impl Into<Vec<BarrierTest<T>>>) -> Result<Self, TestIssues<T>> {
        let tests = tests.into();
        let mut issues = IssueCollector::<TestIssue<T>>::new();
        issues.at_least(Place::plain("tests"), tests.len(), 1);
        check_series(&tests, Place::plain("test"), &mut issues);
        issues.finish().map(|()| TestSeries(tests))
    }
}

impl<T: Ordered<Mask = bool>> TryFrom<Vec<BarrierTest<T>>> for TestSeries<T> {
    type Error = TestIssues<T>;

    fn try_from(tests: Vec<BarrierTest<T>>) -> Result<Self, TestIssues<T>> {
        TestSeries::new(tests)
    }
}

/// Reports the issues of each test of a series and of their order.
pub(super) fn check_series<'a, T>(
    tests: impl IntoIterator<Item = &'a BarrierTest<T>>,
    place: Place,
    issues: &mut IssueCollector<TestIssue<T>>,
) where
    T: Ordered<Mask = bool> + 'a,
{
    let mut deepest: Option<T> = None;
    for (i, test) in tests.into_iter().enumerate() {
        test.check(place.at(i), issues);
        // With a width of zero there is no mean.
        if !T::int(0).less(&test.crush.first) {
            continue;
        }
        let depth = test.crush.mean_depth();
        if let Some(before) = deepest.take().filter(|before| depth.less(before)) {
            issues.push(InputIssue::out_of_order(place.named("mean depth", Measure::Length).at(i), depth.clone(), before));
        }
        deepest = Some(depth);
    }
}

impl<T> TestSeries<T> {
    /// Returns the tests, in order.
    pub fn tests(&self) -> &[BarrierTest<T>] {
        &self.0
    }
}

impl<T: Field> TestSeries<T> {
    /// Returns the cumulative crush energy of the vehicle after each test, Σ ½ m (1 − e²) v_n², in J.
    pub fn crush_energies(&self) -> Vec<T> {
        let mut kept = T::int(0);
        self.0
            .iter()
            .map(|test| {
                kept = kept.clone() + test.crush_energy();
                kept.clone()
            })
            .collect()
    }
}

impl<T: Real> TestSeries<T> {
    /// Returns the equivalent energy speed after each test, EES = √Σ (1 − e²) v_n², in m/s   (Eq 9, with restitution), assuming a constant mass of the
    /// vehicle.
    ///
    /// ```
    /// use planar_impact::barrier::{BarrierTest, TestSeries};
    /// use planar_impact::crush::ProfileMoments;
    /// // Table B1 and B2 of the paper in ft, slug and s: mass, v_n and e of the three tests, and their mean depths.
    /// let test = |speed, restitution, depth| BarrierTest {
    ///     mass: 101.91, speed, restitution, crush: ProfileMoments::of(5.0, &[depth, depth]).unwrap(),
    /// };
    /// let series = TestSeries::new([test(16.6537, 0.18, 0.1062), test(29.3669, 0.13, 0.5203), test(36.858, 0.12, 1.0768)])?;
    /// let speeds = series.equivalent_energy_speeds();
    /// assert_eq!(format!("{speeds:.1?}"), "[16.4, 33.4, 49.5]"); // Table B2
    /// # Ok::<(), planar_impact::barrier::TestIssues>(())
    /// ```
    pub fn equivalent_energy_speeds(&self) -> Vec<T> {
        let pair = |test: &BarrierTest<T>| (test.speed.clone(), test.restitution.clone());
        (1..=self.0.len()).map(|count| equivalent_energy_speed(self.0[..count].iter().map(pair))).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::crush::ProfileMoments;

    fn test(speed: f64, depth: f64) -> BarrierTest {
        BarrierTest { mass: 8.0, speed, restitution: 0.0, crush: ProfileMoments::of(2.0, &[depth, depth]).expect("two depths") }
    }

    #[test]
    fn energies_add_up() {
        let series = TestSeries::new([test(3.0, 0.1), test(4.0, 0.2)]).expect("in order");
        assert_eq!(series.tests(), [test(3.0, 0.1), test(4.0, 0.2)]);
        assert_eq!(series.crush_energies(), [36.0, 100.0]);
        assert_eq!(series.equivalent_energy_speeds(), [3.0, 5.0]);
    }

    #[test]
    fn crush_that_shrinks_is_out_of_order() {
        let issues = TestSeries::new([test(3.0, 0.2), test(4.0, 0.1), test(-1.0, 0.3)]).expect_err("two issues");
        assert_eq!(
            issues.as_slice(),
            [
                InputIssue::out_of_order(Place::of("mean depth", Measure::Length).at(1), 0.1, 0.2).into(),
                InputIssue::not_positive(Place::of("speed", Measure::Speed).at(2), -1.0).into()
            ]
        );
        assert_eq!(TestSeries::<f64>::new([]).expect_err("nothing").as_slice(), [InputIssue::too_few(Place::plain("tests"), 0, 1).into()]);
    }
}
