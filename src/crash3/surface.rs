//! Which surface of a vehicle is crushed.

use crate::collision::Collision;
use crate::frame::{ForwardLeft, Nt};
use crate::impact::ForceOrigin;
use crate::input::Side;
use crate::scalar::{Field, Ordered};
use crate::solve::slack;
use crate::vehicle::Party;

/// An end or a side of a vehicle.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
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

    /// Where a force comes from that is perpendicular to the undeformed surface.
    pub fn perpendicular<T: Field>(self) -> ForceOrigin<T> {
        let (ahead, right) = match self {
            Surface::Front => (1, 0),
            Surface::Right => (0, 1),
            Surface::Rear => (-1, 0),
            Surface::Left => (0, -1),
        };
        ForceOrigin { ahead: T::int(ahead), right: T::int(right) }
    }

    /// The surface that a force comes at: the one whose perpendicular is nearest to it. An end before a side where both are as near.
    pub fn facing<T: Ordered<Mask = bool>>(origin: &ForceOrigin<T>) -> Surface {
        let (ahead, right) = (origin.ahead.clone().magnitude(), origin.right.clone().magnitude());
        if (ahead * (T::int(1) + slack())).less(&right) {
            if origin.right.less(&T::int(0)) { Surface::Left } else { Surface::Right }
        } else if origin.ahead.less(&T::int(0)) {
            Surface::Rear
        } else {
            Surface::Front
        }
    }

    /// The surface of a vehicle that lies along the crush plane of a collision: the one whose perpendicular is nearest to the normal that it is pushed
    /// along. None of a barrier.
    ///
    /// ```
    /// use planar_impact::crash3::Surface;
    /// # use planar_impact::*;
    /// # let vehicle = |heading: f64, speed: f64| Vehicle {
    /// #     mass: 1000.0,
    /// #     yaw_inertia: 2000.0,
    /// #     heading: Heading::from_angle(heading),
    /// #     impact_center: ForwardLeft { forward: 1.5, left: 0.0 },
    /// #     motion: Motion { velocity: Xy { x: speed, y: 0.0 }, yaw_rate: 0.0 },
    /// # };
    /// // Vehicle 1 drives along x into the left side of vehicle 2, which stands across its way.
    /// let collision = Collision {
    ///     one: vehicle(0.0, 10.0).into(),
    ///     two: vehicle(std::f64::consts::FRAC_PI_2, 0.0).into(),
    /// #   crush_plane: CrushPlane::from_angle(0.0),
    /// #   restitution: 0.0,
    /// #   impulse_ratio: ImpulseRatio::Critical,
    /// #   law: Law::Brach,
    /// #   moment: Moment::None,
    ///     // ...
    /// };
    /// assert_eq!(Surface::along_crush_plane(&collision, Side::One), Some(Surface::Front));
    /// assert_eq!(Surface::along_crush_plane(&collision, Side::Two), Some(Surface::Left));
    /// ```
    pub fn along_crush_plane<T: Ordered<Mask = bool>>(collision: &Collision<T>, side: Side) -> Option<Surface> {
        let party = match side {
            Side::One => &collision.one,
            Side::Two => &collision.two,
        };
        let Party::Vehicle(vehicle) = party else { return None };
        // The normal impulse on vehicle 1 has the sign of the normal approach; vehicle 2 gets the opposite.
        let approach = collision.contact().approach;
        let pushed_back = approach.n.less(&T::int(0)) == (side == Side::One);
        let normal = Nt { n: T::int(if pushed_back { -1 } else { 1 }), t: T::int(0) };
        let push = vehicle.heading.to_vehicle(collision.crush_plane.to_ground(normal));
        Some(Surface::facing(&origin_of(push)))
    }
}

/// Whence a push comes.
pub(super) fn origin_of<T: Field>(push: ForwardLeft<T>) -> ForceOrigin<T> {
    ForceOrigin { ahead: T::int(0) - push.forward, right: push.left + T::int(0) }
}

#[cfg(test)]
mod tests {
    use super::*;

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
            assert_eq!(Surface::facing(&ForceOrigin { ahead, right }), surface, "{degrees}");
        }
    }
}
