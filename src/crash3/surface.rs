//! The crushed surface of a vehicle.

use crate::frame::{CrushPlane, Heading, Nt};
use crate::impact::ForceDirection;
use crate::scalar::interval::{Interval, Truth};
use crate::scalar::{Field, Logic, Ordered, slack};

/// An end or a side of a vehicle.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Surface {
    /// The front.
    Front,
    /// The right side.
    Right,
    /// The rear.
    Rear,
    /// The left side.
    Left,
}

impl Surface {
    /// All four, clockwise from the front.
    pub const ALL: [Surface; 4] = [Surface::Front, Surface::Right, Surface::Rear, Surface::Left];

    /// Returns the direction from which a force perpendicular to the undeformed surface comes.
    pub fn perpendicular<T: Field>(self) -> ForceDirection<T> {
        let (ahead, right) = match self {
            Surface::Front => (1, 0),
            Surface::Right => (0, 1),
            Surface::Rear => (-1, 0),
            Surface::Left => (0, -1),
        };
        ForceDirection { ahead: T::int(ahead), right: T::int(right) }
    }

    /// Returns the surface that faces a force: the one whose perpendicular is nearest to its direction. An end takes precedence over a side if both are
    /// equally near.
    pub fn facing<T: Ordered<Mask = bool>>(origin: &ForceDirection<T>) -> Surface {
        Surface::facing_by(origin, Some).expect("a float decides")
    }

    /// Returns the surface of a vehicle that lies along a crush plane: the one whose perpendicular is nearest to the normal of the plane, on the side that
    /// the force comes from.
    ///
    /// ```
    /// use planar_impact::crash3::Surface;
    /// use planar_impact::{CrushPlane, ForceDirection, Heading};
    /// // A plane across the way, and a force from ahead and farther to the right than 45°: the front is crushed nevertheless.
    /// let (plane, heading) = (CrushPlane::from_angle(0.1), Heading::from_angle(0.0));
    /// let origin = ForceDirection { ahead: 1.0, right: 1.5 };
    /// assert_eq!(Surface::along(&plane, &heading, &origin), Surface::Front);
    /// assert_eq!(Surface::facing(&origin), Surface::Right);
    /// ```
    pub fn along<T: Ordered<Mask = bool>>(plane: &CrushPlane<T>, heading: &Heading<T>, origin: &ForceDirection<T>) -> Surface {
        Surface::along_by(plane, heading, origin, Some).expect("a float decides")
    }

    /// Returns the surface [`along`](Surface::along) a crush plane whatever the numbers in their intervals are, or `None` if they leave it open.
    pub fn certainly_along(
        plane: &CrushPlane<Interval>,
        heading: &Heading<Interval>,
        origin: &ForceDirection<Interval>,
    ) -> Option<Surface> {
        Surface::along_by(plane, heading, origin, Truth::decided)
    }

    fn facing_by<T: Ordered<Mask: Logic>>(origin: &ForceDirection<T>, decided: fn(T::Mask) -> Option<bool>) -> Option<Surface> {
        let (ahead, right) = (origin.ahead.clone().magnitude(), origin.right.clone().magnitude());
        let is_side = decided((ahead * (T::int(1) + slack())).less(&right))?;
        let is_negative = decided(if is_side { &origin.right } else { &origin.ahead }.less(&T::int(0)))?;
        Some(match (is_side, is_negative) {
            (false, false) => Surface::Front,
            (false, true) => Surface::Rear,
            (true, false) => Surface::Right,
            (true, true) => Surface::Left,
        })
    }

    fn along_by<T: Ordered<Mask: Logic>>(
        plane: &CrushPlane<T>,
        heading: &Heading<T>,
        origin: &ForceDirection<T>,
        decided: fn(T::Mask) -> Option<bool>,
    ) -> Option<Surface> {
        let normal = ForceDirection::of_push(heading.to_vehicle(plane.to_ground(Nt { n: T::int(1), t: T::int(0) })));
        let towards = normal.ahead.clone() * origin.ahead.clone() + normal.right.clone() * origin.right.clone();
        let is_away = decided(towards.less(&T::int(0)))?;
        let facing = if is_away { ForceDirection { ahead: -normal.ahead, right: -normal.right } } else { normal };
        Surface::facing_by(&facing, decided)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::ForwardLeft;

    #[test]
    fn a_force_comes_at_the_nearest_surface() {
        for surface in Surface::ALL {
            assert_eq!(Surface::facing(&surface.perpendicular::<f64>()), surface);
        }
        for (degrees, surface) in [
            (44.0, Surface::Front),
            (45.0, Surface::Front),
            (46.0, Surface::Right),
            (134.0, Surface::Right),
            (135.0, Surface::Rear),
            (-44.0, Surface::Front),
            (-90.0, Surface::Left),
            (-170.0, Surface::Rear),
        ] {
            let (right, ahead) = f64::to_radians(degrees).sin_cos();
            assert_eq!(Surface::facing(&ForceDirection { ahead, right }), surface, "{degrees}");
        }
    }

    #[test]
    fn along_a_plane_it_is_the_surface_nearest_to_the_normal_on_the_side_of_the_force() {
        // Directions relative to the vehicle, clockwise from ahead: that of the normal is the heading less the plane's angle.
        for (heading, plane, pdof, surface) in [
            (0.0, 0.0, 10.0, Surface::Front),
            (0.0, 0.0, 170.0, Surface::Rear),
            (90.0, 0.0, 60.0, Surface::Right),
            (90.0, 0.0, -60.0, Surface::Left),
            (30.0, 0.0, 80.0, Surface::Front),
            (60.0, 0.0, 20.0, Surface::Right),
            (60.0, 0.0, -40.0, Surface::Left),
            (-60.0, 0.0, -20.0, Surface::Left),
            (200.0, 100.0, 75.0, Surface::Right),
            (100.0, 240.0, -120.0, Surface::Rear),
            (100.0, 240.0, 30.0, Surface::Front),
        ] {
            let (right, ahead) = f64::to_radians(pdof).sin_cos();
            let (plane, heading) = (CrushPlane::from_angle(f64::to_radians(plane)), Heading::from_angle(f64::to_radians(heading)));
            for length in [1e-3, 1.0, 4e4] {
                let origin = ForceDirection { ahead: ahead * length, right: right * length };
                assert_eq!(Surface::along(&plane, &heading, &origin), surface, "{heading:?} {plane:?} {pdof}");
            }
        }
    }

    #[test]
    fn a_push_comes_from_where_it_does_not_go() {
        let push = ForwardLeft { forward: 3.0, left: 4.0 };
        assert_eq!(ForceDirection::of_push(push), ForceDirection { ahead: -3.0, right: 4.0 });
    }
}
