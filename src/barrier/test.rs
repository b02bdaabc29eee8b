//! One test of a vehicle against a fixed barrier, and the stiffness that follows from it and an assumed onset.

use super::issue::{TestIssue, TestIssues, finite};
use crate::crush::{BarrierSpeedLine, CrushStiffness, ProfileMoments};
use crate::issue::{IssueCollector, Place};
use crate::measure::Measure;
use crate::scalar::{Field, Ordered, Real, slack};

/// A vehicle's impact with a fixed barrier, and the crush measured after it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct BarrierTest<T = f64> {
    /// Mass m of the vehicle as tested, in kg.
    pub mass: T,
    /// Closing speed normal to the barrier, v_n, in m/s.
    pub speed: T,
    /// Restitution e of the test.
    pub restitution: T,
    /// Moments of the residual crush, from [`Profile::moments`](crate::crush::Profile::moments); K₁ is half the width. For a vehicle that was tested before,
    /// these are the moments of its total crush.
    pub crush: ProfileMoments<T>,
}

impl<T: Field> BarrierTest<T> {
    /// Returns the energy absorbed by the crush in this test, E_C = ½ m (1 − e²) v_n², in J.
    ///
    /// The rebound returns e² of the energy, which is not crush energy. All of the normal motion is stopped only if the impact center lies on the normal
    /// through the center of mass: with an offset, part of the energy goes into yaw, and this value exceeds the crush energy. For a vehicle that was tested
    /// before, this is the energy that the test added.
    pub fn crush_energy(&self) -> T {
        (self.mass.clone() * (T::int(1) - self.restitution.clone().squared()) * self.speed.clone().squared()).half()
    }

    /// Returns the width w of the crush, in m.
    pub fn width(&self) -> T {
        self.crush.width()
    }
}

/// Returns the mean of the squares of the depths, ∫ C² dw/w = K₃/K₁, in m².
pub(super) fn mean_square_depth<T: Field>(crush: &ProfileMoments<T>) -> T {
    crush.third.clone() / crush.first.clone()
}

/// Reports what is wrong with the moments of a profile.
pub(super) fn check_crush<T: Ordered<Mask = bool>>(
    crush: &ProfileMoments<T>,
    place: Place,
    issues: &mut IssueCollector<TestIssue<T>>,
) -> bool {
    let wide = issues.positive(place.named("width", Measure::Length), &crush.first);
    let finite = issues.finite(place.named("crush.second", Measure::Area), &crush.second)
        & issues.finite(place.named("crush.third", Measure::Ratio), &crush.third);
    if !(wide && finite) {
        return false;
    }
    let (mean, mean_square) = (crush.mean_depth(), mean_square_depth(crush));
    let square = mean.clone().squared();
    // For a flat profile they are equal, to rounding.
    let impossible = mean_square.less(&(square.clone() - square * slack()));
    if impossible {
        issues.push(TestIssue::ImpossibleProfile { at: place.named("crush", Measure::Length), mean, mean_square });
    }
    !impossible
}

impl<T: Ordered<Mask = bool>> BarrierTest<T> {
    /// Reports what is wrong with the test. Returns `true` if its crush is valid.
    pub(super) fn check(&self, place: Place, issues: &mut IssueCollector<TestIssue<T>>) -> bool {
        issues.positive(place.named("mass", Measure::Mass), &self.mass);
        issues.positive(place.named("speed", Measure::Speed), &self.speed);
        issues.within(place.named("restitution", Measure::Ratio), &self.restitution, T::int(0), Some(T::int(1)));
        check_crush(&self.crush, place, issues)
    }
}

impl<T: Real> BarrierTest<T> {
    /// Returns the speed whose energy the crush absorbs, v_n √(1 − e²), in m/s.
    pub fn corrected_speed(&self) -> T {
        (T::int(1) - self.restitution.clone().squared()).square_root() * self.speed.clone()
    }
}

impl<T: Real + Ordered<Mask = bool>> BarrierTest<T> {
    /// Returns the line of barrier speeds as customarily derived from one test: b₁ = (v_n √(1 − e²) − b₀)/C, where C is the mean depth and b₀ the speed that
    /// is assumed to leave no crush, in m/s. Published A and B are computed this way.
    ///
    /// It is exact for a flat profile. For any other, the crush energy of the line (Eq 4) is above that of the test: see [`Self::stiffness`].
    ///
    /// ```
    /// use planar_impact::barrier::BarrierTest;
    /// use planar_impact::crush::{CrushStiffness, ForceLine, ProfileMoments};
    /// // Malibu 2008, NHTSA test 6268; b₀ is assumed to be 2.2 m/s.
    /// let crush = ProfileMoments::of(1.478, &[0.265, 0.474, 0.504, 0.505, 0.475, 0.310]).unwrap();
    /// let test = BarrierTest { mass: 1779.0, speed: 15.6, restitution: 0.0, crush };
    /// let line = test.speed_line(2.2)?;
    /// assert_eq!(format!("{:.4}", line.slope), "29.8375"); // b₁
    /// let force = ForceLine::from(CrushStiffness::from(line));
    /// assert_eq!(format!("{:.1}, {:.0}", force.onset, force.slope), "79010.7, 1071581"); // A and B
    /// # Ok::<(), planar_impact::barrier::TestIssues>(())
    /// ```
    ///
    /// # Errors
    ///
    /// Every invalid number, and an onset that is not below the speed of the test.
    pub fn speed_line(&self, onset: T) -> Result<BarrierSpeedLine<T>, TestIssues<T>> {
        self.check_with(&onset)?;
        let slope = (self.corrected_speed() - onset.clone()) / self.crush.mean_depth();
        let slope = finite(Place::plain("b1"), slope)?;
        Ok(BarrierSpeedLine { onset, slope, test_mass: self.mass.clone(), test_width: self.width() })
    }

    /// Returns the stiffness for which the crush energy of the measured profile equals that of the test: d₀ = b₀ √(m/w), and d₁ > 0 is the root of d₀² K₁ +
    /// d₀ d₁ K₂ + d₁² K₃ = ½ m (1 − e²) v_n²   (Eq 4).
    ///
    /// # Errors
    ///
    /// Every invalid number, and an onset that is not below the speed of the test.
    pub fn stiffness(&self, onset: T) -> Result<CrushStiffness<T>, TestIssues<T>> {
        self.check_with(&onset)?;
        // Energy of the test less d₀² K₁, written as a product so that rounding never makes it negative.
        let speed = self.corrected_speed();
        let beyond_onset = (self.mass.clone() * (speed.clone() - onset.clone()) * (speed + onset.clone())).half();
        let onset = (self.mass.clone() / self.width()).square_root() * onset;
        let ProfileMoments { second, third, .. } = self.crush.clone();
        let linear = onset.clone() * second;
        // This form of the root loses no digits: it contains no difference of similar numbers.
        let root = (linear.clone().squared() + T::int(4) * third * beyond_onset.clone()).square_root();
        let slope = finite(Place::plain("d1"), T::int(2) * beyond_onset / (linear + root))?;
        Ok(CrushStiffness { onset: finite(Place::plain("d0"), onset)?, slope })
    }

    fn check_with(&self, onset: &T) -> Result<(), TestIssues<T>> {
        let mut issues = IssueCollector::<TestIssue<T>>::new();
        let crush_stands = self.check(Place::plain("test"), &mut issues);
        let onset_stands = issues.not_negative(Place::of("onset", Measure::Speed), onset);
        if crush_stands {
            issues.positive(Place::of("mean depth", Measure::Length), &self.crush.mean_depth());
        }
        let speed = self.corrected_speed();
        // The test left crush, and its mean depth is judged above.
        if onset_stands && !onset.less(&speed) {
            issues.push(TestIssue::OnsetTooFast { onset: onset.clone(), speed });
        }
        issues.finish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::issue::InputIssue;
    use approx::assert_relative_eq;

    // Malibu 2008, NHTSA test 6268.
    fn malibu() -> BarrierTest {
        let crush = ProfileMoments::of(1.478, &[0.265, 0.474, 0.504, 0.505, 0.475, 0.310]).expect("six depths");
        BarrierTest { mass: 1779.0, speed: 15.6, restitution: 0.0, crush }
    }

    #[test]
    fn the_exact_line_has_the_energy_of_the_test_and_the_customary_one_more() {
        for restitution in [0.0, 0.2] {
            let test = BarrierTest { restitution, ..malibu() };
            let exact = test.stiffness(2.2).expect("a good test");
            assert_relative_eq!(exact.crush_energy(test.crush), test.crush_energy(), max_relative = 1e-15);
            let customary = CrushStiffness::from(test.speed_line(2.2).expect("a good test"));
            assert!(customary.crush_energy(test.crush) > 1.01 * test.crush_energy());
            assert_relative_eq!(customary.onset, exact.onset, max_relative = 1e-15);
        }
    }

    #[test]
    fn a_flat_profile_has_one_line() {
        let crush = ProfileMoments::of(2.0, &[0.5, 0.5]).expect("two depths");
        // E* = 3 + 4 · ½ = 5, so E_C = 25 J = ½ · 8 · (1 − 0.6²) v².
        let test = BarrierTest { mass: 8.0, speed: 2.5 / 0.8, restitution: 0.6, crush };
        assert_relative_eq!(test.crush_energy(), 25.0, max_relative = 1e-15);
        let line = CrushStiffness::from(test.speed_line(1.5).expect("a good test"));
        let exact = test.stiffness(1.5).expect("a good test");
        for got in [line, exact] {
            assert_relative_eq!(got.onset, 3.0, max_relative = 1e-15);
            assert_relative_eq!(got.slope, 4.0, max_relative = 1e-15);
        }
        assert_relative_eq!(test.stiffness(0.0).expect("no onset").slope, 10.0, max_relative = 1e-15);
    }

    #[test]
    fn every_bad_number_is_named() {
        let bad =
            BarrierTest { mass: -1.0, speed: 0.0, restitution: 1.5, crush: ProfileMoments { first: 0.0, second: f64::NAN, third: 1.0 } };
        let issues = bad.stiffness(-2.0).expect_err("bad numbers");
        let names = ["mass", "speed", "restitution", "width", "crush.second", "onset"];
        let said = alloc::string::ToString::to_string(&issues);
        assert_eq!(issues.len(), names.len(), "{said}");
        assert!(names.iter().all(|name| said.contains(name)), "{said}");
        assert_eq!(said, alloc::string::ToString::to_string(&bad.speed_line(-2.0).expect_err("bad numbers")));
    }

    #[test]
    fn an_onset_at_the_test_or_above_it_and_a_profile_of_nothing_are_refused() {
        for onset in [15.6, 15.7] {
            let fast = malibu().stiffness(onset).expect_err("too fast");
            assert_eq!(fast.as_slice(), [TestIssue::OnsetTooFast { onset, speed: 15.6 }]);
        }
        let crush = ProfileMoments::of(1.0, &[0.0, 0.0]).expect("two depths");
        let flat = BarrierTest { crush, ..malibu() }.speed_line(2.2).expect_err("no crush");
        assert_eq!(flat.as_slice(), [InputIssue::not_positive(Place::of("mean depth", Measure::Length), 0.0).into()]);
        let crush = ProfileMoments { first: 0.5, second: 1.0, third: 0.4 };
        let impossible = BarrierTest { crush, ..malibu() }.speed_line(2.2).expect_err("mean 1, mean square 0.8");
        assert_eq!(
            impossible.as_slice(),
            [TestIssue::ImpossibleProfile { at: Place::of("crush", Measure::Length), mean: 1.0, mean_square: 0.8 }]
        );
    }
}
