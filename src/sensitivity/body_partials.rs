//! One body at the impact center, and its derivatives by its inputs with the impulse held constant.
//!
//! One scalar contains all contributions of a body to the equation of the impulse. With σ = −1 for body 1 and +1 for body 2, with α and λ two constant
//! vectors and w = 1/m, j = 1/I,
//!
//! ```text
//! ℓ = σ (α·v + ω r×α) − w λ·P − j (r×λ) (r×P)
//! ```
//!
//! is α times the body's contribution to the approach velocity, less λ times its change of velocity by the impulse P. The moments r×α, r×λ, r×P are linear in
//! the arm r = f h + l h⊥, with h the heading, so their derivatives are again moments and products with r and h.

use super::{Gradient, Hessian};
use crate::body::Body;
use crate::frame::{CrushPlane, Nt, Xy};
use crate::input::{Input, Side};
use crate::scalar::Real;
use crate::vehicle::Vehicle;

/// A vehicle in contact axes.
#[derive(Clone, Copy)]
pub(super) struct BodyPartials<T> {
    pub(super) side: Side,
    /// σ
    pub(super) sign: T,
    /// w = 1/m
    pub(super) inverse_mass: T,
    /// j = 1/I
    pub(super) inverse_yaw_inertia: T,
    /// r
    pub(super) arm: Nt<T>,
    /// h
    pub(super) ahead: Nt<T>,
    /// v
    pub(super) velocity: Nt<T>,
    /// ω
    pub(super) yaw_rate: T,
}

/// The moment r×x of a vector, and its derivatives by the inputs that change the arm.
#[derive(Clone, Copy)]
pub(super) struct Moments<T> {
    pub(super) here: T,
    pub(super) heading: T,
    pub(super) forward: T,
    pub(super) left: T,
}

/// Derivatives by the inputs of one vehicle, and its contribution to the derivative by the crush plane.
#[derive(Clone, Copy)]
pub(super) struct ByVehicle<T> {
    pub(super) mass: T,
    pub(super) yaw_inertia: T,
    pub(super) heading: T,
    pub(super) forward: T,
    pub(super) left: T,
    pub(super) velocity: Xy<T>,
    pub(super) yaw_rate: T,
    pub(super) crush_plane: T,
}

impl<T: Real + Copy> ByVehicle<T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn nothing() -> Self {
        let zero = T::int(0);
        ByVehicle {
            mass: zero,
            yaw_inertia: zero,
            heading: zero,
            forward: zero,
            left: zero,
            velocity: Xy::zero(),
            yaw_rate: zero,
            crush_plane: zero,
        }
    }
}

/// The two constant vectors of ℓ and the impulse.
#[derive(Clone, Copy)]
pub(super) struct Held<T> {
    /// α, the cotangent of the approach velocity.
    pub(super) approach: Nt<T>,
    /// λ, the adjoint of the velocity change.
    pub(super) yielding: Nt<T>,
    /// P
    pub(super) impulse: Nt<T>,
}

impl<T: Real + Copy> BodyPartials<T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn of(vehicle: &Vehicle<T>, body: &Body<T>, side: Side, plane: &CrushPlane<T>) -> Self {
        BodyPartials {
            side,
            sign: T::int(if side == Side::One { -1 } else { 1 }),
            inverse_mass: body.inverse_mass,
            inverse_yaw_inertia: body.inverse_yaw_inertia,
            arm: body.arm,
            ahead: plane.to_contact(Xy { x: vehicle.heading.cos, y: vehicle.heading.sin }),
            velocity: body.velocity,
            yaw_rate: body.yaw_rate,
        }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn moments(&self, x: Nt<T>) -> Moments<T> {
        Moments { here: self.arm.cross(x), heading: -self.arm.dot(x), forward: self.ahead.cross(x), left: -self.ahead.dot(x) }
    }

    /// Returns the derivatives of σ (α·v + ω r×α). Turning the crush plane turns both bodies, with their velocities, backwards relative to it.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn of_approach(&self, approach: Nt<T>, plane: &CrushPlane<T>) -> ByVehicle<T> {
        let a = self.moments(approach);
        let spin = self.sign * self.yaw_rate;
        let on_ground = plane.to_ground(approach) * self.sign;
        let heading = spin * a.heading;
        ByVehicle {
            heading,
            forward: spin * a.forward,
            left: spin * a.left,
            velocity: on_ground,
            yaw_rate: self.sign * a.here,
            crush_plane: -heading - self.sign * self.velocity.cross(approach),
            ..ByVehicle::nothing()
        }
    }

    /// Returns the derivatives of −w λ·P − j (r×λ) (r×P).
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn of_yielding(&self, yielding: Nt<T>, impulse: Nt<T>) -> ByVehicle<T> {
        let (w, j) = (self.inverse_mass, self.inverse_yaw_inertia);
        let (b, c) = (self.moments(yielding), self.moments(impulse));
        let by_arm = |bx: T, cx: T| -(j * (bx * c.here + b.here * cx));
        let heading = by_arm(b.heading, c.heading);
        ByVehicle {
            mass: w * w * yielding.dot(impulse),
            yaw_inertia: j * j * b.here * c.here,
            heading,
            forward: by_arm(b.forward, c.forward),
            left: by_arm(b.left, c.left),
            crush_plane: -heading,
            ..ByVehicle::nothing()
        }
    }

    /// Returns the derivatives of ℓ.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn of_both(&self, held: &Held<T>, plane: &CrushPlane<T>) -> ByVehicle<T> {
        let (a, b) = (self.of_approach(held.approach, plane), self.of_yielding(held.yielding, held.impulse));
        ByVehicle {
            mass: b.mass,
            yaw_inertia: b.yaw_inertia,
            heading: a.heading + b.heading,
            forward: a.forward + b.forward,
            left: a.left + b.left,
            velocity: a.velocity,
            yaw_rate: a.yaw_rate,
            crush_plane: a.crush_plane + b.crush_plane,
        }
    }

    /// Adds the second derivatives of ℓ.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn add_hessian(&self, held: &Held<T>, plane: &CrushPlane<T>, to: &mut Hessian<T>) {
        let (w, j) = (self.inverse_mass, self.inverse_yaw_inertia);
        let two = T::int(2);
        let (a, b, c) = (self.moments(held.approach), self.moments(held.yielding), self.moments(held.impulse));
        let spin = self.sign * self.yaw_rate;
        let on_ground = plane.to_ground(held.approach) * self.sign;
        let arm = self.arm_inputs();
        let (by_a, by_b, by_c) = (a.by_arm(), b.by_arm(), c.by_arm());
        let (twice_a, twice_b, twice_c) = (a.twice_by_arm(), b.twice_by_arm(), c.twice_by_arm());
        to.add(Input::Mass(self.side), Input::Mass(self.side), -(two * w * w * w * held.yielding.dot(held.impulse)));
        to.add(Input::YawInertia(self.side), Input::YawInertia(self.side), -(two * j * j * j * b.here * c.here));
        for (p, &input) in arm.iter().enumerate() {
            let by_inertia = j * j * (by_b[p] * c.here + b.here * by_c[p]);
            to.add_pair(Input::YawInertia(self.side), input, by_inertia);
            to.add_pair(Input::YawRate(self.side), input, self.sign * by_a[p]);
            for (q, &other) in arm.iter().enumerate() {
                let product = twice_b[p][q] * c.here + (by_b[p] * by_c[q] + by_b[q] * by_c[p]) + b.here * twice_c[p][q];
                let curved = spin * twice_a[p][q] - j * product;
                to.add(input, other, curved);
                if p == 0 {
                    to.add_pair(Input::CrushPlane, other, -curved);
                }
                if p == 0 && q == 0 {
                    to.add(Input::CrushPlane, Input::CrushPlane, curved);
                }
            }
        }
        to.add_pair(Input::CrushPlane, Input::YawInertia(self.side), -(j * j * (b.heading * c.here + b.here * c.heading)));
        to.add_pair(Input::CrushPlane, Input::YawRate(self.side), -(self.sign * a.heading));
        to.add_pair(Input::CrushPlane, Input::VelocityX(self.side), -on_ground.y);
        to.add_pair(Input::CrushPlane, Input::VelocityY(self.side), on_ground.x);
        to.add(Input::CrushPlane, Input::CrushPlane, -(self.sign * held.approach.dot(self.velocity)));
    }

    /// Adds to `with` the derivative by the impulse of each derivative of ℓ.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn add_mixed(&self, held: &Held<T>, with: &mut Nt<Gradient<T>>) {
        let (w, j) = (self.inverse_mass, self.inverse_yaw_inertia);
        let b = self.moments(held.yielding);
        let sweep = self.arm.quarter_turn();
        let by_arm = |bx: T, cx: Nt<T>| -((sweep * bx + cx * b.here) * j);
        let heading = by_arm(b.heading, -self.arm);
        with.add(Input::Mass(self.side), held.yielding * (w * w));
        with.add(Input::YawInertia(self.side), sweep * (j * j * b.here));
        with.add(Input::Heading(self.side), heading);
        with.add(Input::ImpactCenterForward(self.side), by_arm(b.forward, self.ahead.quarter_turn()));
        with.add(Input::ImpactCenterLeft(self.side), by_arm(b.left, -self.ahead));
        with.add(Input::CrushPlane, -heading);
    }

    /// Returns the inputs that change the arm, in the order of [`Moments::by_arm`].
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn arm_inputs(&self) -> [Input; 3] {
        [Input::Heading(self.side), Input::ImpactCenterForward(self.side), Input::ImpactCenterLeft(self.side)]
    }
}

impl<T: Real + Copy> Moments<T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn by_arm(&self) -> [T; 3] {
        [self.heading, self.forward, self.left]
    }

    /// Returns the second derivatives: the arm turns with the heading, and is linear in the coordinates of the impact center.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn twice_by_arm(&self) -> [[T; 3]; 3] {
        let zero = T::int(0);
        [[-self.here, self.left, -self.forward], [self.left, zero, zero], [-self.forward, zero, zero]]
    }
}

impl<T: Real + Copy> Gradient<T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn zero() -> Self {
        Gradient([T::int(0); Input::COUNT])
    }

    /// Combines the parts of both vehicles and of the contact, in the order of [`Input::ALL`].
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn of_parts(one: &ByVehicle<T>, two: &ByVehicle<T>, restitution: T, impulse_ratio: T) -> Self {
        Gradient([
            one.mass,
            one.yaw_inertia,
            one.heading,
            one.forward,
            one.left,
            one.velocity.x,
            one.velocity.y,
            one.yaw_rate,
            two.mass,
            two.yaw_inertia,
            two.heading,
            two.forward,
            two.left,
            two.velocity.x,
            two.velocity.y,
            two.yaw_rate,
            one.crush_plane + two.crush_plane,
            restitution,
            impulse_ratio,
            T::int(0),
        ])
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn add(&mut self, input: Input, x: T) {
        self[input] = self[input] + x;
    }
}

impl<T: Real + Copy> Nt<Gradient<T>> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn add(&mut self, input: Input, x: Nt<T>) {
        self.n.add(input, x.n);
        self.t.add(input, x.t);
    }
}

impl<T: Real + Copy> Hessian<T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn zero() -> Self {
        Hessian([[T::int(0); Input::COUNT]; Input::COUNT])
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn add(&mut self, one: Input, other: Input, x: T) {
        let entry = &mut self.0[one.index()][other.index()];
        *entry = *entry + x;
    }

    /// Adds to both entries of a pair of different inputs.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn add_pair(&mut self, one: Input, other: Input, x: T) {
        self.add(one, other, x);
        self.add(other, one, x);
    }
}
