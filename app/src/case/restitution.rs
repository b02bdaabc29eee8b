//! The coefficient of restitution: a number, or a curve over the closing speed.

use planar_impact::{Collision, Real};

/// The coefficient of restitution of a contact.
#[derive(Clone, Debug, PartialEq)]
pub enum Restitution {
    /// A number.
    Given(f64),
    /// It follows the closing speed.
    OfClosingSpeed(RestitutionCurve),
}

/// The mean restitution over the closing speed and its scatter: lines between points, constant beyond the first and the last.
///
/// The closing speed is the normal component of the approach velocity at the impact center, which does not depend on the restitution.
#[derive(Clone, Debug, PartialEq)]
pub struct RestitutionCurve {
    /// At least two, their closing speeds increasing.
    points: Vec<CurvePoint>,
    /// The standard deviations by which the restitution is above its mean.
    pub scatter: f64,
}

/// A point of a curve, in SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurvePoint {
    /// The closing speed.
    pub closing_speed: f64,
    /// The mean restitution.
    pub restitution: f64,
    /// Its standard deviation.
    pub sd: f64,
}

impl Restitution {
    /// Returns the number; `None` for a curve.
    pub fn given(&self) -> Option<f64> {
        match self {
            Restitution::Given(value) => Some(*value),
            Restitution::OfClosingSpeed(_) => None,
        }
    }
}

impl RestitutionCurve {
    /// Creates the curve through points with increasing closing speeds, at its mean.
    pub(super) fn new(points: Vec<CurvePoint>) -> Self {
        RestitutionCurve { points, scatter: 0.0 }
    }

    /// Returns `true` if the restitution has a standard deviation at any speed.
    pub fn has_scatter(&self) -> bool {
        self.points.iter().any(|point| point.sd > 0.0)
    }

    /// Returns the closing speeds of the first and the last point.
    pub fn range(&self) -> [f64; 2] {
        [self.points.first(), self.points.last()].map(|point| point.map_or(f64::NAN, |point| point.closing_speed))
    }

    /// Returns the restitution of a collision, so many standard deviations above the mean at its closing speed. That of the collision is not used.
    pub fn of<T: Real + From<f64>>(&self, collision: &Collision<T>, scatter: T) -> T {
        let speed = closing_speed(collision);
        self.at(&speed, |point| point.restitution) + self.at(&speed, |point| point.sd) * scatter
    }

    /// Interpolates between the points. A derivative at a point is that of the line behind it.
    fn at<T: Real + From<f64>>(&self, speed: &T, of: impl Fn(&CurvePoint) -> f64) -> T {
        let (Some(first), Some(last)) = (self.points.first(), self.points.last()) else { return T::from(f64::NAN) };
        let mut found = T::from(of(last));
        for pair in self.points.windows(2).rev() {
            let [from, to] = [&pair[0], &pair[1]];
            let part = (speed.clone() - T::from(from.closing_speed)) / T::from(to.closing_speed - from.closing_speed);
            // At both ends exactly that of the point, so that a curve that ends at 0 or 1 does not leave the range.
            let line = T::from(of(from)) + T::from(of(to) - of(from)) * part;
            found = T::select(speed.less(&T::from(to.closing_speed)), line, found);
        }
        T::select(speed.less(&T::from(first.closing_speed)), T::from(of(first)), found)
    }
}

/// Returns the speed at which the bodies approach each other along the normal at the impact center.
pub fn closing_speed<T: Real>(collision: &Collision<T>) -> T {
    collision.contact().approach.n.magnitude()
}

#[cfg(test)]
mod tests {
    use super::*;
    use planar_impact::scalar::interval::Interval;
    use planar_impact::{Input, Party, Side, Vehicle};

    fn curve() -> RestitutionCurve {
        let point = |(closing_speed, restitution, sd)| CurvePoint { closing_speed, restitution, sd };
        RestitutionCurve::new([(2.0, 0.4, 0.1), (6.0, 0.2, 0.05), (14.0, 0.1, 0.05)].map(point).into())
    }

    fn at_speed<T: Real + From<f64>>(speed: T) -> Collision<T> {
        let car: Vehicle = Vehicle::new(1500.0, 2500.0).with_impact_center(2.0, 0.3);
        let mut collision = Collision::new(car, Party::Barrier).map(T::from);
        collision.set(Input::VelocityX(Side::One), speed).expect("vehicle 1 has a velocity");
        collision
    }

    #[test]
    fn a_curve_goes_through_its_points_and_is_constant_beyond() {
        for (speed, mean, sd) in [
            (0.0, 0.4, 0.1),
            (2.0, 0.4, 0.1),
            (3.0, 0.35, 0.0875),
            (6.0, 0.2, 0.05),
            (10.0, 0.15, 0.05),
            (14.0, 0.1, 0.05),
            (90.0, 0.1, 0.05),
        ] {
            for scatter in [-2.0, 0.0, 1.5_f64] {
                let found = curve().of(&at_speed(speed), scatter);
                assert!((found - (mean + sd * scatter)).abs() < 1e-15, "{speed} {scatter}: {found}");
            }
            // The closing speed has no sign.
            assert_eq!(curve().of(&at_speed(-speed), 0.0), curve().of(&at_speed(speed), 0.0));
        }
        assert_eq!((curve().range(), curve().has_scatter()), ([2.0, 14.0], true));
        // A curve from 1 to 0 stays within, to the last rounding.
        let point = |(closing_speed, restitution)| CurvePoint { closing_speed, restitution, sd: 0.0 };
        let steep = RestitutionCurve::new([(0.1, 1.0), (0.3, 0.7), (0.9, 0.0)].map(point).into());
        for i in 0..10_000 {
            for speed in [0.1_f64, 0.3, 0.9] {
                let near = f64::from_bits(speed.to_bits() - 5_000 + i);
                assert!((0.0..=1.0).contains(&steep.of(&at_speed(near), 0.0)), "{near}");
            }
        }
        assert!(!steep.has_scatter());
    }

    #[test]
    fn derivatives_are_those_of_the_segment() {
        use num_dual::Dual64;
        for (speed, slope) in [(1.0, 0.0), (3.0, -0.05 + 0.5 * -0.0125), (9.0, -0.0125), (20.0, 0.0)] {
            let found = curve().of(&at_speed(Dual64::new(speed, 1.0)), Dual64::from(0.5));
            assert!((found.eps - slope).abs() < 1e-15, "{speed}: {found}");
        }
        // At a corner that of the segment behind it.
        assert!((curve().of(&at_speed(Dual64::new(6.0, 1.0)), Dual64::from(0.0)).eps + 0.0125).abs() < 1e-15);
        assert!((curve().of(&at_speed(Dual64::new(3.0, 0.0)), Dual64::new(0.0, 1.0)).eps - 0.0875).abs() < 1e-15);
    }

    #[test]
    fn an_interval_encloses_every_point() {
        for (low, high) in [(0.0, 1.0), (1.0, 3.0), (2.5, 3.0), (5.0, 7.0), (3.0, 13.0), (0.0, 20.0), (15.0, 16.0)] {
            let scatter = Interval::new(-1.0, 2.0).expect("in order");
            let found = curve().of(&at_speed(Interval::new(low, high).expect("in order")), scatter);
            for i in 0..=100 {
                let speed = low + (high - low) * f64::from(i) / 100.0;
                for z in [-1.0, 0.5, 2.0] {
                    assert!(found.contains(curve().of(&at_speed(speed), z)), "{found} at {speed} {z}");
                }
            }
        }
        // Within a segment it is as narrow as the curve.
        let narrow = curve().of(&at_speed(Interval::new(3.0, 4.0).expect("in order")), Interval::from(0.0));
        assert!((narrow.width() - 0.05).abs() < 1e-9, "{narrow}");
    }
}
