//! The energy correction for a force that is not perpendicular to the crushed surface.

use super::Surface;
use crate::impact::ForceDirection;
use crate::scalar::{Field, Ordered, Real, is_positive};

/// Largest value of the correction factor.
const CAP: i32 = 2;

/// Returns CRASH3's energy correction factor 1 + tan² α, at most 2, with α the angle from the perpendicular of the surface to the principal force.
///
/// A force that does not point into the surface at all, |α| ≥ 90°, has the factor 2 as well: such a force cannot have caused the crush energy, and the angle
/// should be questioned.
///
/// ```
/// use planar_impact::ForceDirection;
/// use planar_impact::crash3::{Surface, energy_correction};
/// let from_ahead_and_right = ForceDirection { ahead: 2.0, right: 1.0 };
/// assert_eq!(energy_correction(Surface::Front, &from_ahead_and_right), 1.25);
/// assert_eq!(energy_correction(Surface::Right, &from_ahead_and_right), 2.0); // 5 without the limit
/// ```
pub fn energy_correction<T: Ordered>(surface: Surface, origin: &ForceDirection<T>) -> T {
    let Parts { along, length_squared } = Parts::of(surface, origin);
    let capped = T::int(CAP) * along.clone().squared();
    let away = T::select(T::int(0).less(&along), capped, T::int(0));
    let below = length_squared.less(&away);
    // Above the limit, divide by one: the result is discarded.
    let square = T::select(below.clone(), along.squared(), T::int(1));
    T::select(below, (length_squared / square).smaller(T::int(CAP)).larger(T::int(1)), T::int(CAP))
}

/// Returns 1/cos α, by which the principal force exceeds its component perpendicular to the surface, or `None` if it does not point into the surface. Unlike
/// the correction of the energy it has no limit.
///
/// ```
/// use planar_impact::ForceDirection;
/// use planar_impact::crash3::{Surface, force_correction};
/// let from_ahead_and_right = ForceDirection { ahead: 4.0, right: 3.0 };
/// assert_eq!(force_correction(Surface::Front, &from_ahead_and_right), Some(1.25));
/// assert_eq!(force_correction(Surface::Left, &from_ahead_and_right), None);
/// ```
pub fn force_correction<T: Real + Ordered<Mask = bool>>(surface: Surface, origin: &ForceDirection<T>) -> Option<T> {
    let Parts { along, length_squared } = Parts::of(surface, origin);
    is_positive(&along).then(|| force_factor(along, length_squared.square_root()))
}

/// Returns 1/cos α, by which a force exceeds its component normal to the crushed surface, from that component and the length of the force.
///
/// A and B are of the force normal to the surface. CRASH3 takes the force and the depth along the principal direction of force to be both 1/cos α times as
/// large, and so the energy 1/cos² α = 1 + tan² α times (CRASH3 User's Guide and Technical Manual, DOT HS 805 732, 1981; EDCRASH is derived from it). This is
/// the factor of the force alone, which has no limit of its own.
pub fn force_factor<T: Field>(normal: T, length: T) -> T {
    length / normal
}

/// A force relative to a surface.
struct Parts<T> {
    /// Component perpendicular to the surface, positive if it points into the surface.
    along: T,
    length_squared: T,
}

impl<T: Field> Parts<T> {
    fn of(surface: Surface, origin: &ForceDirection<T>) -> Self {
        let perpendicular: ForceDirection<T> = surface.perpendicular();
        let (ahead, right) = (origin.ahead.clone(), origin.right.clone());
        Parts {
            along: ahead.clone() * perpendicular.ahead + right.clone() * perpendicular.right,
            length_squared: ahead.squared() + right.squared(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn it_is_one_plus_the_tangent_squared_up_to_two() {
        for degrees in [-44.9, -30.0, 0.0, 15.3, 44.9] {
            let (right, ahead) = f64::to_radians(degrees).sin_cos();
            let expected = 1.0 + f64::to_radians(degrees).tan().powi(2);
            for length in [1e-3, 1.0, 7e4] {
                let origin = ForceDirection { ahead: ahead * length, right: right * length };
                assert_relative_eq!(energy_correction(Surface::Front, &origin), expected, max_relative = 1e-14);
                let force = force_correction(Surface::Front, &origin).expect("it points into the front");
                assert_relative_eq!(force * force, expected, max_relative = 1e-14);
            }
        }
        for degrees in [45.1, 89.0, 90.0, 120.0, 180.0, -60.0] {
            let (right, ahead) = f64::to_radians(degrees).sin_cos();
            assert_eq!(energy_correction(Surface::Front, &ForceDirection { ahead, right }), 2.0);
        }
        assert_eq!(energy_correction(Surface::Front, &ForceDirection { ahead: 1.0, right: 1.0 }), 2.0);
        assert_eq!(energy_correction(Surface::Left, &ForceDirection { ahead: 1.0, right: -2.0 }), 1.25);
        assert_eq!(energy_correction(Surface::Rear, &ForceDirection { ahead: -2.0, right: -1.0 }), 1.25);
    }
}
