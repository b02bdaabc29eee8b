//! The force of the road on one wheel: rolling, braked or locked, never beyond the friction circle.

use crate::frame::ForwardLeft;
use crate::scalar::Real;

/// The restraint of a wheel, in addition to its rolling resistance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Restraint<T = f64> {
    /// No restraint: it rolls.
    Rolling,
    /// A brake, or damage, with this fraction of the force that the friction allows: 0 rolls freely, 1 is equivalent to locked.
    Braked(T),
    /// It does not rotate.
    Locked,
}

/// Rise of the force of a tire from zero to the limit of friction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tires<T = f64> {
    /// The rolling resistance of a free wheel as a share of its load, dimensionless.
    pub rolling_resistance: T,
    /// The tangent of the slip angle at which a rolling wheel has a lateral force of 1/√2 of the limit, dimensionless. It is the limit over the cornering
    /// stiffness.
    pub slip_angle: T,
    /// The slip speed ε at which a sliding wheel has 1/√2 of the limit, in m/s; below it the force decreases smoothly to zero.
    pub regularization: T,
}

impl Tires {
    /// Ordinary tires on a road: a rolling resistance of 0.015, a slip angle of 0.1 and ε = 1 cm/s.
    pub const ORDINARY: Tires = Tires { rolling_resistance: 0.015, slip_angle: 0.1, regularization: 0.01 };
}

impl<T> Restraint<T> {
    /// Converts the restraint to another scalar type.
    pub fn map<U>(self, f: impl FnOnce(T) -> U) -> Restraint<U> {
        match self {
            Restraint::Rolling => Restraint::Rolling,
            Restraint::Braked(fraction) => Restraint::Braked(f(fraction)),
            Restraint::Locked => Restraint::Locked,
        }
    }
}

impl<T> Tires<T> {
    /// Converts the tires to another scalar type.
    pub fn map<U>(self, mut f: impl FnMut(T) -> U) -> Tires<U> {
        Tires { rolling_resistance: f(self.rolling_resistance), slip_angle: f(self.slip_angle), regularization: f(self.regularization) }
    }
}

impl<T: Real<Mask = bool>> Tires<T> {
    /// Computes the force of the road on a wheel, in N, along and across it.
    ///
    /// With the limit L = friction · load, the slip u (the velocity of the point of contact, along and across) and ε:
    ///
    /// ```text
    /// along:   the lesser of L |u_a| / √(u² + ε²), as if locked, and of brake and rolling resistance D; against u_a
    /// across:  √(L² − along²) · u_c / √(u_c² + ε² + (κ u_a)²), κ² = s² (1 − (D/L)²); against u_c
    /// ```
    ///
    /// with s the slip angle. A locked wheel has D ≥ L, so κ = 0, and its force is L u / √(u² + ε²), against the slip. A brake locks its wheel if the slip
    /// angle is so large that sliding takes less along the wheel than the brake would; both sides of that transition agree. The force is continuous, and
    /// inside the circle of L.
    pub fn force(&self, restraint: &Restraint<T>, friction: T, load: T, slip: ForwardLeft<T>) -> ForwardLeft<T> {
        let zero = T::int(0);
        let limit = friction * load.clone();
        if !zero.less(&limit) {
            return ForwardLeft::zero();
        }
        let small = self.regularization.clone().squared();
        let across_squared = slip.left.clone().squared() + small;
        let speed = (slip.forward.clone().squared() + across_squared.clone()).square_root();
        let sliding = limit.clone() * slip.forward.clone() / speed.clone();
        let drag = self.drag(restraint, limit.clone(), load);
        let turns = drag.less(&sliding.clone().magnitude());
        let (along, left_over) = if turns {
            let left_over = (limit.clone().squared() - drag.clone().squared()).square_root();
            (if sliding.less(&zero) { -drag.clone() } else { drag.clone() }, left_over)
        } else {
            (sliding, limit.clone() * across_squared.clone().square_root() / speed)
        };
        // A wheel that is held with all the force that friction allows slides like a locked one.
        let free = if drag.less(&limit) { T::int(1) - (drag / limit).squared() } else { zero };
        let yielding = free * (self.slip_angle.clone() * slip.forward).squared();
        let across = left_over * slip.left / (across_squared + yielding).square_root();
        ForwardLeft { forward: -along, left: -across }
    }

    /// Returns the force of brake and rolling resistance, which may exceed that of friction.
    fn drag(&self, restraint: &Restraint<T>, limit: T, load: T) -> T {
        let rolling = self.rolling_resistance.clone() * load;
        match restraint {
            Restraint::Rolling => rolling,
            Restraint::Braked(fraction) => rolling + fraction.clone() * limit,
            Restraint::Locked => limit,
        }
    }
}

impl Tires {
    /// Returns the limits of the force on a wheel that stands.
    pub(super) fn limits(&self, restraint: &Restraint, friction: f64, load: f64) -> Limits {
        let limit = friction * load;
        Limits { limit, along: limit.min(self.drag(restraint, limit, load)) }
    }
}

/// Limits of the force on a wheel that stands: the friction circle, and along the wheel what brake and rolling resistance hold.
pub(super) struct Limits {
    limit: f64,
    along: f64,
}

impl Limits {
    /// Returns the force within the limits that reaches farthest in a direction.
    pub(super) fn farthest(&self, direction: ForwardLeft) -> ForwardLeft {
        let length = direction.length();
        if length == 0.0 {
            return ForwardLeft::zero();
        }
        let on_circle = direction * (self.limit / length);
        if on_circle.forward.abs() <= self.along {
            return on_circle;
        }
        let across = (self.limit * self.limit - self.along * self.along).sqrt();
        let toward = |size: f64, of: f64| if of == 0.0 { 0.0 } else { size.copysign(of) };
        ForwardLeft { forward: toward(self.along, direction.forward), left: toward(across, direction.left) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::ForwardLeft;

    const LOAD: f64 = 4000.0;
    const FRICTION: f64 = 0.7;

    fn force(restraint: Restraint, forward: f64, left: f64) -> ForwardLeft {
        Tires::ORDINARY.force(&restraint, FRICTION, LOAD, ForwardLeft { forward, left })
    }

    #[test]
    fn a_locked_wheel_is_held_back_along_its_slip() {
        let force = force(Restraint::Locked, 3.0, 4.0);
        assert!((force.forward / force.left - 0.75).abs() < 1e-12);
        // ε² beside 5² m²/s².
        let length = FRICTION * LOAD / (1.0 + 1e-4 / 25.0_f64).sqrt();
        assert!((force.length() / length - 1.0).abs() < 1e-12 && force.forward < 0.0 && force.left < 0.0);
    }

    #[test]
    fn a_full_brake_is_a_locked_wheel() {
        for (forward, left) in [(10.0, 0.0), (-3.0, 1.0), (0.0, 2.0), (0.002, -0.001)] {
            let (locked, braked) = (force(Restraint::Locked, forward, left), force(Restraint::Braked(1.0), forward, left));
            assert!((locked - braked).length() < 1e-9, "{locked:?} {braked:?}");
        }
    }

    #[test]
    fn a_rolling_wheel_resists_by_its_share_along_and_by_friction_across() {
        let straight = force(Restraint::Rolling, 10.0, 0.0);
        assert_eq!(straight, ForwardLeft { forward: -0.015 * LOAD, left: -0.0 });
        let across = force(Restraint::Rolling, 0.0, 10.0);
        assert!(across.forward == 0.0 && (across.left / (-FRICTION * LOAD) - 1.0).abs() < 1e-6);
        // At the slip angle of the tires the lateral force is 1/√2 of the limit, except for the rolling resistance.
        let at_slip_angle = force(Restraint::Rolling, 10.0, 1.0);
        assert!((at_slip_angle.left / (-FRICTION * LOAD / 2.0_f64.sqrt()) - 1.0).abs() < 1e-3, "{at_slip_angle:?}");
    }

    #[test]
    fn a_brake_locks_its_wheel_where_it_slides_more_across() {
        let half = force(Restraint::Braked(0.5), 10.0, 0.1);
        assert!((half.forward + 0.5 * FRICTION * LOAD + 0.015 * LOAD).abs() < 1e-9);
        // At 80° the brake would take more along the wheel than sliding does, which is cos 80°.
        let (forward, left) = (10.0 * 80.0_f64.to_radians().cos(), 10.0 * 80.0_f64.to_radians().sin());
        let sideways = force(Restraint::Braked(0.5), forward, left);
        assert!((sideways.forward / (-FRICTION * LOAD * 80.0_f64.to_radians().cos()) - 1.0).abs() < 1e-6);
    }

    #[test]
    fn it_is_continuous_and_inside_the_circle() {
        let restraints = [Restraint::Rolling, Restraint::Braked(0.3), Restraint::Braked(0.95), Restraint::Braked(1.0), Restraint::Locked];
        for restraint in restraints {
            let mut before = force(restraint, 5.0, 0.0);
            for i in 1..=200_000 {
                let angle = f64::from(i) * std::f64::consts::TAU / 200_000.0;
                let now = force(restraint, 5.0 * angle.cos(), 5.0 * angle.sin());
                assert!(now.length() <= FRICTION * LOAD * (1.0 + 1e-12));
                assert!((now - before).length() < 5.0, "{restraint:?} at {angle}: {before:?} {now:?}");
                before = now;
            }
        }
    }

    #[test]
    fn no_friction_is_no_force() {
        let force = Tires::ORDINARY.force(&Restraint::Rolling, 0.0, LOAD, ForwardLeft { forward: 1.0, left: 2.0 });
        assert_eq!(force, ForwardLeft::zero());
    }

    /// A wheel that resists 3 N along itself and 5 N in all.
    #[test]
    fn a_standing_wheel_gives_its_limit_along_and_what_is_left_across() {
        let limits = Limits { limit: 5.0, along: 3.0 };
        let near =
            |force: ForwardLeft, forward: f64, left: f64| (force.forward - forward).abs() < 1e-12 && (force.left - left).abs() < 1e-12;
        assert!(near(limits.farthest(ForwardLeft { forward: 2.0, left: -1.0 }), 3.0, -4.0));
        assert!(near(limits.farthest(ForwardLeft { forward: -0.6, left: 0.8 }), -3.0, 4.0));
        assert!(near(limits.farthest(ForwardLeft { forward: 0.28, left: 0.96 }), 1.4, 4.8));
    }
}
