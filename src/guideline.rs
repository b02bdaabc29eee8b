//! The paper's guideline for the crush plane ("Guidelines for Use of the Method", Fig 5).
//!
//! Γ cannot be measured, and the partition of the energy loss depends on it. The paper starts from the two undeformed surfaces that meet: the nominal
//! crush plane is half way between them, and each of them is an end of the bracket in which Γ may lie.

use crate::scalar::{Ordered, Real};
use crate::solve::slack;
use core::fmt;

/// The nominal crush plane and its bracket, as angles Γ in rad. Γ and Γ + 180° are the same plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CrushPlaneBracket<T = f64> {
    /// Half way between the ends.
    pub nominal: T,
    /// The end that is the normal of vehicle 1's surface, as given.
    pub one: T,
    /// The end that is the normal of vehicle 2's surface, by half turns within a right angle of the other end.
    pub two: T,
}

/// Two surfaces at a right angle, which have two planes half way between them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PerpendicularSurfaces<T = f64> {
    /// The one mean, in rad.
    pub one: T,
    /// The other, a right angle further.
    pub other: T,
}

impl<T: Real + Ordered<Mask = bool>> CrushPlaneBracket<T> {
    /// From the directions of the normals of the two undeformed surfaces that meet, in rad from x. Either normal of a surface will do.
    ///
    /// The two cars of Fig 5, headed 0° and 225°, meet front to front: Γ is 22.5°, between 0° and 45°.
    ///
    /// ```
    /// use planar_impact::CrushPlaneBracket;
    /// let bracket = CrushPlaneBracket::of_surfaces(0.0, 225_f64.to_radians())?;
    /// assert!((bracket.nominal.to_degrees() - 22.5).abs() < 1e-12);
    /// assert_eq!(bracket.lower(), 0.0);
    /// assert!((bracket.upper().to_degrees() - 45.0).abs() < 1e-12);
    /// # Ok::<(), planar_impact::PerpendicularSurfaces>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`PerpendicularSurfaces`], with the two planes that are half way, when the surfaces stand at a right angle.
    pub fn of_surfaces(one: T, two: T) -> Result<Self, PerpendicularSurfaces<T>> {
        let turn = two.clone() - one.clone();
        let quarter = T::int(1).atan2(T::int(0));
        let (sin, cos) = turn.clone().sin_cos();
        if cos.clone().magnitude().less(&slack()) {
            let mean = one + quarter.clone().half();
            return Err(PerpendicularSurfaces { one: mean.clone() - quarter, other: mean });
        }
        let two = if turn.magnitude().less(&quarter) {
            two
        } else {
            let side = T::select(cos.less(&T::int(0)), T::int(-1), T::int(1));
            one.clone() + (sin * side.clone()).atan2(cos * side)
        };
        Ok(CrushPlaneBracket { nominal: (one.clone() + two.clone()).half(), one, two })
    }

    /// The lower end.
    pub fn lower(&self) -> T {
        T::select(self.two.less(&self.one), self.two.clone(), self.one.clone())
    }

    /// The upper end.
    pub fn upper(&self) -> T {
        T::select(self.two.less(&self.one), self.one.clone(), self.two.clone())
    }
}

impl<T: fmt::Display> fmt::Display for PerpendicularSurfaces<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the surfaces stand at a right angle: the planes at {} rad and at {} rad are both half way", self.one, self.other)
    }
}

impl<T: fmt::Debug + fmt::Display> core::error::Error for PerpendicularSurfaces<T> {}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_abs_diff_eq;

    fn degrees(one: f64, two: f64) -> [f64; 3] {
        let bracket = CrushPlaneBracket::of_surfaces(one.to_radians(), two.to_radians()).expect("not at a right angle");
        [bracket.lower(), bracket.nominal, bracket.upper()].map(f64::to_degrees)
    }

    #[test]
    fn the_second_surface_is_taken_within_a_right_angle_of_the_first() {
        // Lower end, mean and upper end by hand.
        for (one, two, expected) in [
            (0.0, 45.0, [0.0, 22.5, 45.0]),
            (0.0, 225.0, [0.0, 22.5, 45.0]),
            (0.0, -135.0, [0.0, 22.5, 45.0]),
            (225.0, 0.0, [180.0, 202.5, 225.0]),
            (0.0, 180.0, [0.0, 0.0, 0.0]),
            (10.0, 10.0, [10.0, 10.0, 10.0]),
            (170.0, 10.0, [170.0, 180.0, 190.0]),
            (0.0, 100.0, [-80.0, -40.0, 0.0]),
            (-30.0, 59.0, [-30.0, 14.5, 59.0]),
            (5.0, 725.0, [5.0, 5.0, 5.0]),
        ] {
            for (got, want) in degrees(one, two).into_iter().zip(expected) {
                assert_abs_diff_eq!(got, want, epsilon = 1e-12);
            }
        }
    }

    #[test]
    fn what_is_given_within_a_right_angle_is_kept_to_the_bit() {
        let bracket = CrushPlaneBracket::of_surfaces(0.1, -0.7).expect("not at a right angle");
        assert_eq!(bracket, CrushPlaneBracket { nominal: -0.3, one: 0.1, two: -0.7 });
        assert_eq!((bracket.lower(), bracket.upper()), (-0.7, 0.1));
    }

    #[test]
    fn a_right_angle_has_two_means() {
        for two in [90.0_f64, -90.0, 270.0, 630.0] {
            let refused = CrushPlaneBracket::of_surfaces(0.0, two.to_radians()).expect_err("a right angle");
            assert_abs_diff_eq!(refused.one.to_degrees(), -45.0, epsilon = 1e-12);
            assert_abs_diff_eq!(refused.other.to_degrees(), 45.0, epsilon = 1e-12);
        }
        assert!(CrushPlaneBracket::of_surfaces(0.0, 89.999_f64.to_radians()).is_ok());
        assert!(CrushPlaneBracket::of_surfaces(0.0_f32, core::f32::consts::FRAC_PI_2).is_err());
    }

    #[cfg(feature = "dual")]
    #[test]
    fn the_mean_follows_each_surface_by_half() {
        use num_dual::Dual64;
        for two in [0.3, 3.3] {
            let bracket = CrushPlaneBracket::of_surfaces(Dual64::from(0.1), Dual64::new(two, 1.0)).expect("not at a right angle");
            assert_abs_diff_eq!(bracket.nominal.eps, 0.5, epsilon = 1e-15);
            assert_abs_diff_eq!(bracket.two.eps, 1.0, epsilon = 1e-15);
        }
    }
}
