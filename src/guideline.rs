//! The paper's guideline for the crush plane ("Guidelines for Use of the Method", Fig 5).
//!
//! Γ cannot be measured, and the partition of the energy loss depends on it. The paper starts from the two undeformed surfaces in contact: the nominal crush
//! plane is half way between them, and each of them is one end of the range of Γ.

use crate::input::Input;
use crate::issue::{InputIssue, Issue, IssueCollector, Issues, Place};
use crate::measure::Measure;
use crate::message::Message;
use crate::scalar::{Ordered, Real, slack};
use alloc::borrow::Cow;
use core::fmt;

/// The nominal crush plane and its bracket, as angles Γ in rad. Γ and Γ + 180° are the same plane.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct CrushPlaneBracket<T = f64> {
    /// Half way between the ends.
    pub nominal: T,
    /// The end given by the normal of vehicle 1's surface.
    pub one: T,
    /// The end given by the normal of vehicle 2's surface, shifted by half turns to within a right angle of the other end.
    pub two: T,
}

/// Reason why two surfaces have no nominal crush plane.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub enum SurfaceIssue<T = f64> {
    /// An angle is not finite, or beyond a million radians. Places are counted from zero.
    Input(InputIssue<T>),
    /// The surfaces are at a right angle: there are two planes half way between them.
    Perpendicular {
        /// One mean, in rad.
        one: T,
        /// The other mean, a right angle further, in rad.
        other: T,
    },
}

impl<T> From<InputIssue<T>> for SurfaceIssue<T> {
    fn from(issue: InputIssue<T>) -> Self {
        SurfaceIssue::Input(issue)
    }
}

/// Place of the normals of the two surfaces in issues.
const SURFACES: Place = Place::of("contact.surfaces", Measure::Angle);

impl<T: Real + Ordered<Mask = bool>> CrushPlaneBracket<T> {
    /// Computes the bracket from the directions of the normals of the two undeformed surfaces in contact, in rad from x. Either normal of a surface is
    /// accepted.
    ///
    /// The two cars of Fig 5, headed 0° and 225°, meet front to front: Γ is 22.5°, between 0° and 45°.
    ///
    /// ```
    /// use planar_impact::CrushPlaneBracket;
    /// let bracket = CrushPlaneBracket::of_surfaces(0.0, 225_f64.to_radians())?;
    /// assert!((bracket.nominal.to_degrees() - 22.5).abs() < 1e-12);
    /// assert_eq!(bracket.lower(), 0.0);
    /// assert!((bracket.upper().to_degrees() - 45.0).abs() < 1e-12);
    /// # Ok::<(), planar_impact::Issues<planar_impact::SurfaceIssue>>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`SurfaceIssue::Perpendicular`], with the two planes half way between them, if the surfaces are at a right angle; otherwise every angle that is not
    /// finite, or beyond a million radians, where it has lost its digits.
    pub fn of_surfaces(one: T, two: T) -> Result<Self, Issues<SurfaceIssue<T>>> {
        let mut issues = IssueCollector::<SurfaceIssue<T>>::new();
        for (i, angle) in [&one, &two].into_iter().enumerate() {
            issues.within(SURFACES.at(i), angle, T::int(-1_000_000), Some(T::int(1_000_000)));
        }
        issues.finish()?;
        let turn = two.clone() - one.clone();
        let quarter = T::int(1).arctangent(T::int(0));
        let (sin, cos) = turn.clone().sin_and_cos();
        if cos.clone().magnitude().less(&slack()) {
            let mean = one + quarter.clone().half();
            return Err(SurfaceIssue::Perpendicular { one: mean.clone() - quarter, other: mean }.into());
        }
        let two = if turn.magnitude().less(&quarter) {
            two
        } else {
            let side = T::select(cos.less(&T::int(0)), T::int(-1), T::int(1));
            one.clone() + (sin * side.clone()).arctangent(cos * side)
        };
        Ok(CrushPlaneBracket { nominal: (one.clone() + two.clone()).half(), one, two })
    }

    /// Returns the lower end.
    pub fn lower(&self) -> T {
        self.one.clone().smaller(self.two.clone())
    }

    /// Returns the upper end.
    pub fn upper(&self) -> T {
        self.two.clone().larger(self.one.clone())
    }
}

impl<T: Ordered<Mask = bool>> Issue for SurfaceIssue<T> {
    type Number = T;

    fn code(&self) -> &'static str {
        match self {
            SurfaceIssue::Input(issue) => issue.code(),
            SurfaceIssue::Perpendicular { .. } => "perpendicular-surfaces",
        }
    }

    fn path(&self) -> Option<Cow<'static, str>> {
        match self {
            SurfaceIssue::Input(issue) => issue.path(),
            SurfaceIssue::Perpendicular { .. } => Some(Input::CrushPlane.name().into()),
        }
    }

    fn message(&self) -> Message<T> {
        match self {
            SurfaceIssue::Input(issue) => issue.message(),
            SurfaceIssue::Perpendicular { one, other } => Message::new()
                .text("the surfaces are at a right angle: the planes at ")
                .figure(Measure::Angle, one.clone())
                .text(" and at ")
                .figure(Measure::Angle, other.clone())
                .text(" are both half way between them"),
        }
    }

    fn help(&self) -> Option<Message<T>> {
        match self {
            SurfaceIssue::Input(issue) => issue.help(),
            SurfaceIssue::Perpendicular { .. } => None,
        }
    }
}

impl<T: Ordered<Mask = bool> + fmt::Display> fmt::Display for SurfaceIssue<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            SurfaceIssue::Input(issue) => issue.fmt(f),
            SurfaceIssue::Perpendicular { .. } => self.message().fmt(f),
        }
    }
}

impl<T: Ordered<Mask = bool> + fmt::Debug + fmt::Display> core::error::Error for SurfaceIssue<T> {}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::string::ToString;
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
            let [SurfaceIssue::Perpendicular { one, other }] = refused.as_slice() else { panic!("{refused}") };
            assert_abs_diff_eq!(one.to_degrees(), -45.0, epsilon = 1e-12);
            assert_abs_diff_eq!(other.to_degrees(), 45.0, epsilon = 1e-12);
        }
        assert!(CrushPlaneBracket::of_surfaces(0.0, 89.999_f64.to_radians()).is_ok());
        assert!(CrushPlaneBracket::of_surfaces(0.0_f32, core::f32::consts::FRAC_PI_2).is_err());
    }

    #[test]
    fn what_is_no_angle_is_refused() {
        let refused = CrushPlaneBracket::of_surfaces(f64::INFINITY, -2e6).expect_err("neither is an angle");
        assert_eq!(
            refused.to_string(),
            "contact.surfaces[0] is not finite: inf; contact.surfaces[1] is -2000000 rad; it must be from -1000000 rad to 1000000 rad"
        );
        assert!(CrushPlaneBracket::of_surfaces(0.0, f64::NAN).is_err());
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
