//! Constructors from quantities of the crate `uom`, whose types know their dimension.

use uom::si::angle::radian;
use uom::si::angular_velocity::radian_per_second;
use uom::si::f64::{Angle, AngularVelocity, Length, Mass, MomentOfInertia, Velocity};
use uom::si::length::meter;
use uom::si::mass::kilogram;
use uom::si::moment_of_inertia::kilogram_square_meter;
use uom::si::velocity::meter_per_second;

use crate::frame::{CrushPlane, ForwardLeft, Heading, Xy};
use crate::vehicle::{Motion, Vehicle};

impl Vehicle {
    /// Creates a vehicle as [`Vehicle::new`] does.
    ///
    /// ```
    /// use planar_impact::{Vehicle, uom::si::{f64::{Mass, MomentOfInertia}, mass::pound, moment_of_inertia::kilogram_square_meter}};
    /// let car = Vehicle::of_quantities(Mass::new::<pound>(2564.0), MomentOfInertia::new::<kilogram_square_meter>(1945.0));
    /// // uom has the pound to seven digits.
    /// assert!((car.mass - 2564.0 * 0.453_592_37).abs() < 1e-3);
    /// ```
    #[must_use]
    pub fn of_quantities(mass: Mass, yaw_inertia: MomentOfInertia) -> Self {
        Vehicle::new(mass.get::<kilogram>(), yaw_inertia.get::<kilogram_square_meter>())
    }
}

impl Motion {
    /// Creates a motion from velocities along x and y and a yaw rate.
    #[must_use]
    pub fn of_quantities(velocity: [Velocity; 2], yaw_rate: AngularVelocity) -> Self {
        Motion { velocity: velocity.into(), yaw_rate: yaw_rate.get::<radian_per_second>() }
    }
}

impl From<[Velocity; 2]> for Xy {
    /// Velocities along x and y, in m/s.
    fn from(velocity: [Velocity; 2]) -> Self {
        let [x, y] = velocity.map(|v| v.get::<meter_per_second>());
        Xy { x, y }
    }
}

impl From<[Length; 2]> for ForwardLeft {
    /// Lengths ahead and to the left, in m.
    fn from(position: [Length; 2]) -> Self {
        let [forward, left] = position.map(|length| length.get::<meter>());
        ForwardLeft { forward, left }
    }
}

impl From<Angle> for Heading {
    fn from(angle: Angle) -> Self {
        Heading::from_angle(angle.get::<radian>())
    }
}

impl From<Angle> for CrushPlane {
    fn from(angle: Angle) -> Self {
        CrushPlane::from_angle(angle.get::<radian>())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use uom::si::angle::degree;
    use uom::si::angular_velocity::degree_per_second;
    use uom::si::length::foot;
    use uom::si::velocity::mile_per_hour;

    #[test]
    fn each_is_converted_to_si() {
        let mph = |v| Velocity::new::<mile_per_hour>(v);
        let motion = Motion::of_quantities([mph(10.0), mph(-20.0)], AngularVelocity::new::<degree_per_second>(180.0));
        assert!((motion.velocity.x - 4.4704).abs() < 1e-12 && (motion.velocity.y + 8.9408).abs() < 1e-12);
        assert!((motion.yaw_rate - core::f64::consts::PI).abs() < 1e-12);
        let center: ForwardLeft = ForwardLeft::from([Length::new::<foot>(10.0), Length::new::<foot>(-1.0)]);
        assert!((center.forward - 3.048).abs() < 1e-12 && (center.left + 0.3048).abs() < 1e-12);
        assert!((Heading::from(Angle::new::<degree>(90.0)).sin - 1.0).abs() < 1e-15);
        assert!((CrushPlane::from(Angle::new::<degree>(60.0)).cos - 0.5).abs() < 1e-15);
    }

    #[test]
    fn a_vehicle_has_its_mass_and_its_inertia() {
        let car = Vehicle::of_quantities(Mass::new::<kilogram>(1300.0), MomentOfInertia::new::<kilogram_square_meter>(2100.0));
        assert_eq!((car.mass, car.yaw_inertia), (1300.0, 2100.0));
    }
}
