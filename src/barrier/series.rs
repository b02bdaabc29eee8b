//! Repeated tests of one vehicle: the energies add up, and the crush that is measured after each is all there is by then.

use super::findings::Findings;
use super::problem::{Place, Problem, Problems};
use super::test::BarrierTest;
use crate::crush::equivalent_energy_speed;
use crate::scalar::{Field, Ordered, Real};
use alloc::vec::Vec;

/// Tests of one vehicle, one after the other, in order.
#[derive(Clone, Debug, PartialEq)]
pub struct TestSeries<T = f64>(Vec<BarrierTest<T>>);

impl<T: Ordered<Mask = bool>> TestSeries<T> {
    /// From the tests in their order.
    ///
    /// # Errors
    ///
    /// No test at all, every number that is out of order, and a mean depth below that of the test before.
    pub fn new(tests: impl Into<Vec<BarrierTest<T>>>) -> Result<Self, Problems<T>> {
        let tests = tests.into();
        let mut findings = Findings::none();
        findings.at_least("tests", tests.len(), 1);
        check_series(&tests, Place::of("test"), &mut findings);
        findings.done().map(|()| TestSeries(tests))
    }
}

/// Finds what is wrong with each test of a series and with their order.
pub(super) fn check_series<'a, T>(tests: impl IntoIterator<Item = &'a BarrierTest<T>>, place: Place, findings: &mut Findings<T>)
where
    T: Ordered<Mask = bool> + 'a,
{
    let mut deepest: Option<T> = None;
    for (i, test) in tests.into_iter().enumerate() {
        test.check(place.at(i), findings);
        // Of a width of zero there is no mean.
        if !T::int(0).less(&test.crush.first) {
            continue;
        }
        let depth = test.crush.mean_depth();
        if let Some(before) = deepest.take().filter(|before| depth.less(before)) {
            findings.push(Problem::OutOfOrder { place: place.named("mean depth").at(i), value: depth.clone(), before });
        }
        deepest = Some(depth);
    }
}

impl<T> TestSeries<T> {
    /// The tests, in order.
    pub fn tests(&self) -> &[BarrierTest<T>] {
        &self.0
    }
}

impl<T: Field> TestSeries<T> {
    /// The crush energy that the vehicle has kept after each test, Σ ½ m (1 − e²) v_n², in J.
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
    /// The equivalent energy speed after each test, EES = √Σ (1 − e²) v_n², in m/s   (Eq 9, with restitution). It is that of a vehicle of unchanged mass.
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
    /// # Ok::<(), planar_impact::barrier::Problems>(())
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
        assert_eq!(series.crush_energies(), [36.0, 100.0]);
        assert_eq!(series.equivalent_energy_speeds(), [3.0, 5.0]);
    }

    #[test]
    fn crush_that_shrinks_is_out_of_order() {
        let problems = TestSeries::new([test(3.0, 0.2), test(4.0, 0.1), test(-1.0, 0.3)]).expect_err("two problems");
        assert_eq!(
            problems.all(),
            [
                Problem::OutOfOrder { place: Place::of("mean depth").at(1), value: 0.1, before: 0.2 },
                Problem::NotPositive { place: Place::of("speed").at(2), value: -1.0 }
            ]
        );
        assert_eq!(TestSeries::<f64>::new([]).expect_err("nothing").all(), [Problem::TooFew { name: "tests", count: 0, least: 1 }]);
    }
}
