//! Restitution from rigid-body kinematics: the velocity of a point of the vehicle at contact and at separation, from the motion of its center of mass.

use super::issue::{TestIssue, TestIssues, finite};
use crate::frame::{CrushPlane, ForwardLeft, Heading, Nt, Xy};
use crate::issue::{InputIssue, IssueCollector, Place};
use crate::measure::Measure;
use crate::scalar::{Field, Ordered, Real};
use crate::vehicle::Motion;

/// A point of a vehicle at an instant.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PointOfVehicle<T = f64> {
    /// Heading of the vehicle.
    pub heading: Heading<T>,
    /// Position of the point relative to the center of mass, r_P, in vehicle axes, in m.
    pub position: ForwardLeft<T>,
    /// Motion of the vehicle.
    pub motion: Motion<T>,
}

/// Measured motion of a vehicle from contact to separation.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct MeasuredContact<T = f64> {
    /// Heading of the vehicle at contact.
    pub heading: Heading<T>,
    /// Its motion at contact.
    pub before: Motion<T>,
    /// Its motion at separation.
    pub after: Motion<T>,
    /// Time from contact to separation, in s.
    pub duration: T,
    /// The point on the undeformed vehicle, from the center of mass, in m. It matters only if the vehicle yaws before contact.
    pub point_before: ForwardLeft<T>,
    /// The point on the deformed vehicle, in m: measured after the test, along the axes of the undamaged vehicle.
    pub point_after: ForwardLeft<T>,
    /// Orientation of the barrier: n is normal to its main face.
    pub barrier: CrushPlane<T>,
}

impl<T: Field> PointOfVehicle<T> {
    /// Returns the velocity of the point, V_P = V_cg + ω × r_P, in m/s.
    pub fn velocity(&self) -> Xy<T> {
        let arm = self.heading.to_ground(self.position.clone());
        self.motion.velocity.clone() + arm.quarter_turn() * self.motion.yaw_rate.clone()
    }
}

/// Returns the restitution of the point, e = −V_Cn/v_Cn, along the normal of the barrier   (A7).
///
/// Divides by zero if the point does not move along the normal before contact.
pub fn restitution<T: Field>(before: &PointOfVehicle<T>, after: &PointOfVehicle<T>, barrier: &CrushPlane<T>) -> T {
    -(barrier.to_contact(after.velocity()).n / barrier.to_contact(before.velocity()).n)
}

/// Returns the heading at separation: the heading at contact, turned by the mean yaw rate ½ (ω + Ω) over the contact. Yaw rates in rad/s, the duration in s.
///
/// The paper has ω = 0 and uses half of the yaw rate at separation.
pub fn heading_at_separation<T: Real>(contact: Heading<T>, yaw_rate_before: T, yaw_rate_after: T, duration: T) -> Heading<T> {
    contact.turned((yaw_rate_before + yaw_rate_after).half() * duration)
}

impl<T: Field> MeasuredContact<T> {
    /// Returns the point at contact.
    pub fn at_contact(&self) -> PointOfVehicle<T> {
        PointOfVehicle { heading: self.heading.clone(), position: self.point_before.clone(), motion: self.before.clone() }
    }
}

impl<T: Real> MeasuredContact<T> {
    /// Returns the point at separation, taking into account how far the vehicle turns during the contact.
    pub fn at_separation(&self) -> PointOfVehicle<T> {
        let (before, after) = (self.before.yaw_rate.clone(), self.after.yaw_rate.clone());
        let heading = heading_at_separation(self.heading.clone(), before, after, self.duration.clone());
        PointOfVehicle { heading, position: self.point_after.clone(), motion: self.after.clone() }
    }

    /// Returns the velocity of the point at separation, normal to the barrier and along it, in m/s.
    pub fn separation(&self) -> Nt<T> {
        self.barrier.to_contact(self.at_separation().velocity())
    }
}

impl<T: Real + Ordered<Mask = bool>> MeasuredContact<T> {
    /// Returns the restitution of the point, e = −V_Cn/v_Cn, as measured, even if it is below zero or above one.
    ///
    /// ```
    /// use planar_impact::barrier::MeasuredContact;
    /// use planar_impact::{CrushPlane, ForwardLeft, Heading, Motion, Xy};
    /// let nose = ForwardLeft { forward: 1.9, left: 0.0 };
    /// let contact = MeasuredContact {
    ///     heading: Heading::from_angle(0.0), duration: 0.1, point_before: nose, point_after: ForwardLeft { forward: 1.5, left: 0.2 },
    ///     before: Motion { velocity: Xy { x: 10.0, y: 0.0 }, yaw_rate: 0.0 },
    ///     after: Motion { velocity: Xy { x: -0.5, y: 0.3 }, yaw_rate: 1.0 },
    ///     barrier: CrushPlane::from_angle(0.0),
    /// };
    /// // −0.5 − Ω (0.2 cos 0.05 + 1.5 sin 0.05) of 10 m/s.
    /// let e: f64 = contact.restitution()?;
    /// assert!((e - 0.0774719).abs() < 1e-7);
    /// # Ok::<(), planar_impact::barrier::TestIssues>(())
    /// ```
    ///
    /// # Errors
    ///
    /// If a number is not finite, the duration is below zero, a direction is invalid, or the point does not move along the normal before contact.
    pub fn restitution(&self) -> Result<T, TestIssues<T>> {
        let mut issues = IssueCollector::<TestIssue<T>>::new();
        for (place, direction) in [("heading", [&self.heading.cos, &self.heading.sin]), ("barrier", [&self.barrier.cos, &self.barrier.sin])]
        {
            let length_squared = direction.into_iter().fold(T::int(0), |sum, part| sum + part.clone().squared());
            let (least, greatest) = (T::int(1) - crate::scalar::slack(), T::int(1) + crate::scalar::slack());
            issues.within(Place::plain(place), &length_squared, least, Some(greatest));
        }
        for (name, number) in [
            ("before.velocity.x", &self.before.velocity.x),
            ("before.velocity.y", &self.before.velocity.y),
            ("before.yaw_rate", &self.before.yaw_rate),
            ("after.velocity.x", &self.after.velocity.x),
            ("after.velocity.y", &self.after.velocity.y),
            ("after.yaw_rate", &self.after.yaw_rate),
            ("point_before.forward", &self.point_before.forward),
            ("point_before.left", &self.point_before.left),
            ("point_after.forward", &self.point_after.forward),
            ("point_after.left", &self.point_after.left),
        ] {
            issues.finite(Place::plain(name), number);
        }
        issues.not_negative(Place::of("duration", Measure::Time), &self.duration);
        issues.finish()?;
        let before = self.at_contact();
        let approach = self.barrier.to_contact(before.velocity()).n.magnitude();
        if !crate::scalar::is_positive(&approach) {
            return Err(InputIssue::not_positive(Place::of("normal approach speed", Measure::Speed), approach).into());
        }
        finite(Place::plain("restitution"), restitution(&before, &self.at_separation(), &self.barrier))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    fn contact() -> MeasuredContact {
        MeasuredContact {
            heading: Heading::from_angle(0.0),
            before: Motion { velocity: Xy { x: 10.0, y: 0.0 }, yaw_rate: 0.0 },
            after: Motion { velocity: Xy { x: -1.0, y: 0.0 }, yaw_rate: 0.0 },
            duration: 0.1,
            point_before: ForwardLeft { forward: 2.0, left: 0.0 },
            point_after: ForwardLeft { forward: 1.5, left: 0.5 },
            barrier: CrushPlane::from_angle(0.0),
        }
    }

    #[test]
    fn without_yaw_every_point_rebounds_alike() {
        assert_relative_eq!(contact().restitution().expect("good numbers"), 0.1);
        // Γ and Γ + 180° are the same barrier.
        let other = MeasuredContact { barrier: CrushPlane::from_angle(core::f64::consts::PI), ..contact() };
        assert_relative_eq!(other.restitution().expect("good numbers"), 0.1, max_relative = 1e-14);
    }

    #[test]
    fn a_yawing_vehicle_carries_its_left_side_back() {
        // r = (1.5, 0.5), Ω = 2: ω × r = (−1, 3), without turning.
        let mut yawing = MeasuredContact { duration: 0.0, ..contact() };
        yawing.after.yaw_rate = 2.0;
        assert_eq!(yawing.separation(), Nt { n: -2.0, t: 3.0 });
        // A quarter turn takes π/2 s at the mean yaw rate of 1: then r = (−0.5, 1.5), ω × r = (−3, −1).
        yawing.duration = core::f64::consts::FRAC_PI_2;
        let turned = yawing.separation();
        assert_relative_eq!(turned.n, -4.0, max_relative = 1e-14);
        assert_relative_eq!(turned.t, -1.0, max_relative = 1e-14);
        // Yawing at 2 throughout, the vehicle has turned by twice that: r = (−1.5, −0.5).
        yawing.before.yaw_rate = 2.0;
        assert_relative_eq!(yawing.separation().n, 0.0, epsilon = 1e-14);
    }

    #[test]
    fn every_bad_number_is_named() {
        let mut bad = MeasuredContact { heading: Heading { cos: 2.0, sin: 0.0 }, duration: -1.0, ..contact() };
        bad.after.yaw_rate = f64::NAN;
        assert_eq!(bad.restitution().expect_err("three issues").len(), 3);
        let mut along = contact();
        along.before.velocity = Xy { x: 0.0, y: 5.0 };
        assert!(along.restitution().is_err());
    }
}
