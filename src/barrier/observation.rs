//! Observations of a stiffness from tests: the crush, E* = √(2 E_C/w), and the uncertainty of E*.

use super::issue::{TestIssue, TestIssues};
use super::series::check_series;
use super::test::{BarrierTest, check_crush};
use crate::crush::{ProfileMoments, crush_intensity};
use crate::issue::{InputIssue, IssueCollector, Place};
use crate::measure::Measure;
use crate::scalar::{Ordered, Real};
use alloc::vec::Vec;

/// One test, with the standard deviations of what was measured.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct MeasuredTest<T = f64> {
    /// The test.
    pub test: BarrierTest<T>,
    /// Standard deviation of the closing speed, in m/s.
    pub speed_deviation: T,
    /// Standard deviation of the restitution.
    pub restitution_deviation: T,
    /// Standard deviation of E* from all sources but speed and restitution, in √N: the measured depth (d₁ times its standard deviation), and structures that
    /// do not follow the line.
    pub scatter: T,
}

/// A crush and its energy, for use when the energies are known but not the tests.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct CrushEnergy<T = f64> {
    /// Moments of the residual crush.
    pub crush: ProfileMoments<T>,
    /// Total energy absorbed by the crush, E_C, in J.
    pub energy: T,
    /// Its standard deviation, in J.
    pub deviation: T,
}

/// A crush and its E*.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Observation<T = f64> {
    /// Moments of the residual crush.
    pub crush: ProfileMoments<T>,
    /// E* = √(2 E_C/w), in √N   (Eq 3).
    pub intensity: T,
    /// Its standard deviation, in √N.
    pub deviation: T,
}

/// Crushes with their E*, and the covariance of the E*.
#[derive(Clone, Debug, PartialEq)]
pub struct Observations<T = f64> {
    pub(super) points: Vec<Point<T>>,
    /// Rows of the covariance of the E*, each up to its diagonal, in N.
    pub(super) covariance: Vec<Vec<T>>,
}

#[derive(Clone, Debug, PartialEq)]
pub(super) struct Point<T> {
    /// Place in the input.
    pub place: Place,
    pub crush: ProfileMoments<T>,
    pub intensity: T,
}

impl<T: Ordered<Mask = bool>> Observations<T> {
    /// Creates observations from E* whose errors are independent.
    ///
    /// # Errors
    ///
    /// Every invalid number.
    pub fn independent(observations: &[Observation<T>]) -> Result<Self, TestIssues<T>> {
        let mut issues = IssueCollector::<TestIssue<T>>::new();
        for (i, observation) in observations.iter().enumerate() {
            let place = Place::plain("observation").at(i);
            check_crush(&observation.crush, place, &mut issues);
            issues.positive(place.named("intensity", Measure::RootForce), &observation.intensity);
            issues.positive(place.named("deviation", Measure::RootForce), &observation.deviation);
        }
        issues.finish()?;
        let point = |(i, observation): (usize, &Observation<T>)| Point {
            place: Place::plain("observation").at(i),
            crush: observation.crush.clone(),
            intensity: observation.intensity.clone(),
        };
        let points = observations.iter().enumerate().map(point).collect();
        let row = |(i, observation): (usize, &Observation<T>)| {
            let mut row = alloc::vec![T::int(0); i];
            row.push(observation.deviation.clone().squared());
            row
        };
        Ok(Observations { points, covariance: observations.iter().enumerate().map(row).collect() })
    }

    /// Returns the number of observations.
    pub fn len(&self) -> usize {
        self.points.len()
    }

    /// Returns `true` if there are no observations.
    pub fn is_empty(&self) -> bool {
        self.points.is_empty()
    }
}

impl<T: Real + Ordered<Mask = bool>> Observations<T> {
    /// Creates observations from tests on several vehicles, a list for each: the tests of one list are repeated tests of one vehicle, in order.
    ///
    /// The energies of repeated tests add up, and so do their errors: the speed of the first test enters every later E* of its vehicle. The covariance
    /// includes this. To first order, var E_C = (m (1 − e²) v σ_v)² + (m e v² σ_e)² for each test, and σ(E*) = σ(E_C)/(w E*).
    ///
    /// # Errors
    ///
    /// Every invalid number of every test, and every mean depth below that of the test before.
    pub fn of_tests<S: AsRef<[MeasuredTest<T>]>>(vehicles: &[S]) -> Result<Self, TestIssues<T>> {
        let mut issues = IssueCollector::<TestIssue<T>>::new();
        for (series, tests) in vehicles.iter().enumerate() {
            let place = Place::plain("test").in_series(series);
            check_series(tests.as_ref().iter().map(|measured| &measured.test), place, &mut issues);
            for (i, measured) in tests.as_ref().iter().enumerate() {
                let place = place.at(i);
                issues.not_negative(place.named("speed_deviation", Measure::Speed), &measured.speed_deviation);
                issues.not_negative(place.named("restitution_deviation", Measure::Ratio), &measured.restitution_deviation);
                issues.not_negative(place.named("scatter", Measure::RootForce), &measured.scatter);
                // At e = 1 the crush absorbs nothing, so the test contains no information on the stiffness.
                issues.positive(place.named("crush energy", Measure::Energy), &measured.test.crush_energy());
            }
        }
        issues.finish()?;
        let mut observations = Observations { points: Vec::new(), covariance: Vec::new() };
        for (series, tests) in vehicles.iter().enumerate() {
            observations.add_vehicle(tests.as_ref(), Place::plain("test").in_series(series));
        }
        observations.check_deviations()?;
        Ok(observations)
    }

    /// Creates observations from known energies with independent errors, in the order in which one vehicle accumulated them.
    ///
    /// # Errors
    ///
    /// Every invalid number, and every energy that is not above the one before.
    pub fn of_energies(series: &[CrushEnergy<T>]) -> Result<Self, TestIssues<T>> {
        let mut issues = IssueCollector::<TestIssue<T>>::new();
        for (i, known) in series.iter().enumerate() {
            let place = Place::of("energy", Measure::Energy).at(i);
            check_crush(&known.crush, place, &mut issues);
            issues.positive(place, &known.energy);
            issues.positive(place.named("deviation", Measure::Energy), &known.deviation);
        }
        for (i, pair) in series.windows(2).enumerate() {
            let (before, value) = (pair[0].energy.clone(), pair[1].energy.clone());
            if !before.less(&value) {
                issues.push(InputIssue::out_of_order(Place::of("energy", Measure::Energy).at(i + 1), value, before));
            }
        }
        issues.finish()?;
        let observe = |known: &CrushEnergy<T>| {
            let width = known.crush.width();
            let intensity = crush_intensity(known.energy.clone(), width.clone());
            let deviation = known.deviation.clone() / (width * intensity.clone());
            Observation { crush: known.crush.clone(), intensity, deviation }
        };
        Self::independent(&series.iter().map(observe).collect::<Vec<_>>())
    }

    fn add_vehicle(&mut self, tests: &[MeasuredTest<T>], place: Place) {
        let first = self.points.len();
        let (mut energy, mut energy_variance) = (T::int(0), T::int(0));
        // w E* of each test so far, and the variance of the cumulative energy.
        let mut before: Vec<(T, T)> = Vec::new();
        for (i, measured) in tests.iter().enumerate() {
            let test = &measured.test;
            energy = energy + test.crush_energy();
            energy_variance = energy_variance + measured.energy_variance();
            let intensity = crush_intensity(energy.clone(), test.width());
            let lever = test.width() * intensity.clone();
            let mut row = alloc::vec![T::int(0); first];
            row.extend(before.iter().map(|(other, shared)| shared.clone() / (other.clone() * lever.clone())));
            row.push(energy_variance.clone() / lever.clone().squared() + measured.scatter.clone().squared());
            self.points.push(Point { place: place.at(i), crush: test.crush.clone(), intensity });
            self.covariance.push(row);
            before.push((lever, energy_variance.clone()));
        }
    }

    fn check_deviations(&self) -> Result<(), TestIssues<T>> {
        let mut issues = IssueCollector::<TestIssue<T>>::new();
        for (point, row) in self.points.iter().zip(&self.covariance) {
            if let Some(variance) = row.last() {
                issues.positive(point.place.named("variance", Measure::Force), variance);
            }
        }
        issues.finish()
    }
}

impl<T: crate::scalar::Field> MeasuredTest<T> {
    fn energy_variance(&self) -> T {
        let BarrierTest { mass, speed, restitution, .. } = self.test.clone();
        let by_speed = mass.clone() * (T::int(1) - restitution.clone().squared()) * speed.clone();
        let by_restitution = mass * restitution * speed.squared();
        (by_speed * self.speed_deviation.clone()).squared() + (by_restitution * self.restitution_deviation.clone()).squared()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec;
    use approx::assert_relative_eq;

    fn measured(speed: f64, depth: f64) -> MeasuredTest {
        let test = BarrierTest { mass: 8.0, speed, restitution: 0.0, crush: ProfileMoments::of(2.0, &[depth, depth]).expect("two depths") };
        MeasuredTest { test, speed_deviation: 0.1, restitution_deviation: 0.0, scatter: 0.0 }
    }

    #[test]
    fn errors_of_repeated_tests_add_up_and_are_shared() {
        let observations = Observations::of_tests(&[[measured(3.0, 0.1), measured(4.0, 0.2)]]).expect("good tests");
        // Energies 36 and 100 J, E* 6 and 10 √N, w E* 12 and 20; σ(E_C) = 8 · 3 · 0.1 and 8 · 4 · 0.1 J.
        assert_eq!(observations.points[0].intensity, 6.0);
        assert_eq!(observations.points[1].intensity, 10.0);
        assert_relative_eq!(observations.covariance[0][0], 2.4 * 2.4 / 144.0, max_relative = 1e-14);
        assert_relative_eq!(observations.covariance[1][0], 2.4 * 2.4 / 240.0, max_relative = 1e-14);
        assert_relative_eq!(observations.covariance[1][1], (2.4 * 2.4 + 3.2 * 3.2) / 400.0, max_relative = 1e-14);
    }

    #[test]
    fn tests_of_two_vehicles_share_nothing() {
        let observations = Observations::of_tests(&[[measured(3.0, 0.1)], [measured(4.0, 0.2)]]).expect("good tests");
        assert_eq!(observations.points[1].intensity, 8.0);
        assert_eq!(observations.covariance[1][0], 0.0);
    }

    #[test]
    fn scatter_is_of_each_test_alone() {
        let scattered = [3.0, 4.0].map(|speed| MeasuredTest { scatter: 3.0, ..measured(speed, 0.1) });
        let exact = Observations::of_tests(&[[measured(3.0, 0.1), measured(4.0, 0.1)]]).expect("good tests");
        let observations = Observations::of_tests(&[scattered]).expect("good tests");
        assert_relative_eq!(observations.covariance[0][0] - exact.covariance[0][0], 9.0, max_relative = 1e-13);
        assert_relative_eq!(observations.covariance[1][1] - exact.covariance[1][1], 9.0, max_relative = 1e-13);
        assert_eq!(observations.covariance[1][0], exact.covariance[1][0]);
    }

    #[test]
    fn an_uncertain_restitution_is_the_slope_of_the_energy() {
        let step = 1e-6;
        let at = |restitution| {
            let measured = measured(4.0, 0.2);
            MeasuredTest {
                test: BarrierTest { restitution, ..measured.test },
                speed_deviation: 0.0,
                restitution_deviation: step,
                scatter: 0.0,
            }
        };
        let difference = (at(0.3 + step).test.crush_energy() - at(0.3 - step).test.crush_energy()) / 2.0;
        assert_relative_eq!(at(0.3).energy_variance(), difference * difference, max_relative = 1e-7);
    }

    #[test]
    fn energies_that_do_not_grow_are_out_of_order() {
        let crush = ProfileMoments::of(2.0, &[0.1, 0.1]).expect("two depths");
        let energy = |energy| CrushEnergy { crush, energy, deviation: 1.0 };
        let issues = Observations::of_energies(&[energy(3.0), energy(2.0), energy(f64::NAN)]).expect_err("two issues");
        assert_eq!(issues.len(), 3);
        assert!(issues.as_slice().contains(&InputIssue::out_of_order(Place::of("energy", Measure::Energy).at(1), 2.0, 3.0).into()));
    }

    #[test]
    fn a_test_that_keeps_no_energy_or_knows_everything_is_refused() {
        let mut elastic = measured(3.0, 0.1);
        elastic.test.restitution = 1.0;
        let issues = Observations::of_tests(&[[elastic]]).expect_err("no energy");
        assert_eq!(
            issues.as_slice(),
            [InputIssue::not_positive(Place::of("crush energy", Measure::Energy).in_series(0).at(0), 0.0).into()]
        );
        let certain = MeasuredTest { speed_deviation: 0.0, ..measured(3.0, 0.1) };
        let issues = Observations::of_tests(&[vec![measured(3.0, 0.1); 2], vec![certain]]).expect_err("no deviation");
        assert_eq!(issues.as_slice(), [InputIssue::not_positive(Place::of("variance", Measure::Force).in_series(1).at(0), 0.0).into()]);
    }
}
