//! All outputs by all inputs at once: the rows of the impulse and of the velocities at the impact center, and every other row as a linear combination of
//! those.
//!
//! Every row is written to its final place in one loop: the table has five thousand bytes, and moving it would cost as much as computing it.

use super::body_partials::BodyPartials;
use super::impulse_adjoint::{Cotangent, ImpulseAdjoint, Slip};
use super::{Gradient, Sensitive, cotangent};
use crate::collision::Collision;
use crate::contact::Contact;
use crate::frame::{CrushPlane, Nt, Xy};
use crate::impact::Impact;
use crate::input::{Input, Side};
use crate::law::Law;
use crate::output::{Output, Outputs};
use crate::scalar::{Logic, Ordered, Real};

/// The derivatives from which those of all other outputs follow.
pub(super) struct Rows<T> {
    pub(super) impulse: Nt<Gradient<T>>,
    pub(super) approach: Nt<Gradient<T>>,
    pub(super) separation: Nt<Gradient<T>>,
}

impl<T: Real<Mask: Logic> + Copy> Rows<T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn of(adjoint: &ImpulseAdjoint<T>) -> Self {
        let Nt { n, t } = axes();
        let impulse = Nt { n: adjoint.gradient(Cotangent::of_impulse(n)), t: adjoint.gradient(Cotangent::of_impulse(t)) };
        let approach = Nt { n: adjoint.approach_row(n), t: adjoint.approach_row(t) };
        let separation = Nt { n: rebound(adjoint, &approach.n, adjoint.approach.n), t: sliding(adjoint, &impulse, &approach.t) };
        Rows { impulse, approach, separation }
    }
}

/// Returns the directions of the two components.
#[cfg_attr(not(debug_assertions), inline(always))]
fn axes<T: Real>() -> Nt<Nt<T>> {
    Nt { n: Nt { n: T::int(1), t: T::int(0) }, t: Nt { n: T::int(0), t: T::int(1) } }
}

/// Returns the gradient of V = −e v, the normal separation velocity whatever the law.
#[cfg_attr(not(debug_assertions), inline(always))]
fn rebound<T: Real<Mask: Logic> + Copy>(adjoint: &ImpulseAdjoint<T>, approach: &Gradient<T>, v: T) -> Gradient<T> {
    let mut row = *approach;
    row.scale(-adjoint.restitution);
    row.add(Input::Restitution, -v);
    row
}

/// Returns the gradient of the tangential separation velocity.
#[cfg_attr(not(debug_assertions), inline(always))]
fn sliding<T: Real<Mask: Logic> + Copy>(adjoint: &ImpulseAdjoint<T>, impulse: &Nt<Gradient<T>>, approach: &Gradient<T>) -> Gradient<T> {
    let ends = match adjoint.law {
        Law::Brach => Gradient::zero(),
        Law::KudlichSlibar => rebound(adjoint, approach, adjoint.approach.t),
    };
    if let Slip::Ends = adjoint.slip {
        return ends;
    }
    // V_t = v_t − (K P)_t
    let mut slides = adjoint.yielding_row(axes().t);
    slides.add_scaled(T::int(1), approach);
    slides.add_scaled(-adjoint.compliance.nt, &impulse.n);
    slides.add_scaled(-adjoint.compliance.tt, &impulse.t);
    match &adjoint.slip {
        Slip::Limited { slides: mask, .. } => Gradient::select(*mask, &slides, &ends),
        _ => slides,
    }
}

/// Writes every output of an impact with its derivatives by every input.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn write<T: Real<Mask: Logic> + Copy>(
    collision: &Collision<T>,
    contact: &Contact<T>,
    impact: &Impact<T>,
    to: &mut Outputs<Sensitive<T>>,
) {
    let adjoint = ImpulseAdjoint::of(collision, contact, impact);
    to.impulse.n.by = adjoint.gradient(Cotangent::of_impulse(axes().n));
    to.impulse.t.by = adjoint.gradient(Cotangent::of_impulse(axes().t));
    to.approach.n.by = adjoint.approach_row(axes().n);
    to.approach.t.by = adjoint.approach_row(axes().t);
    to.separation.n.by = rebound(&adjoint, &to.approach.n.by, adjoint.approach.n);
    to.separation.t.by = sliding(&adjoint, &Nt { n: to.impulse.n.by, t: to.impulse.t.by }, &to.approach.t.by);
    to.kinetic_energy.before.by = cotangent::energy(collision);
    mix(impact, &adjoint, to);
    for none in [&mut to.restitution, &mut to.moment, &mut to.work.m] {
        none.by = Gradient::zero();
    }
    add_direct(collision, impact, &adjoint, to);
    if !is_critical(&adjoint) {
        to.critical_impulse_ratio.by = critical(&adjoint, impact);
    }
    let values = Outputs::of(collision, impact);
    macro_rules! value {
        ($($($field:ident).+),+) => { $(to.$($field).+.value = values.$($field).+;)+ };
    }
    value!(one.after.velocity.x, one.after.velocity.y, one.after.yaw_rate, one.delta_v.x, one.delta_v.y);
    value!(two.after.velocity.x, two.after.velocity.y, two.after.yaw_rate, two.delta_v.x, two.delta_v.y);
    value!(one.delta_v_magnitude, one.principal_direction_of_force, two.delta_v_magnitude, two.principal_direction_of_force);
    value!(restitution, impulse_ratio, critical_impulse_ratio, impulse.n, impulse.t, impulse_on_ground.x, impulse_on_ground.y, moment);
    value!(approach.n, approach.t, separation.n, separation.t, kinetic_energy.before, kinetic_energy.after, loss, work.n, work.t, work.m);
}

/// Returns `true` if the ratio of the impulse is the critical one.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn is_critical<T: Ordered>(adjoint: &ImpulseAdjoint<T>) -> bool {
    matches!((&adjoint.slip, adjoint.law), (Slip::Ends, Law::Brach))
}

/// Returns the gradient of the critical ratio if the impulse has another ratio. Rarely needed, and therefore a separate function.
#[cold]
#[inline(never)]
pub(super) fn critical<T: Real<Mask: Logic> + Copy>(adjoint: &ImpulseAdjoint<T>, impact: &Impact<T>) -> Gradient<T> {
    let critical = impact.critical_impulse;
    adjoint.critical(critical).gradient(Cotangent::of_ratio(critical))
}

/// The numbers by which the rows of the impulse and of the velocities are combined to those of other outputs.
pub(super) struct Mixture<T> {
    plane: CrushPlane<T>,
    /// −½ (v + V) and −½ P.
    velocity: Nt<T>,
    force: Nt<T>,
    /// The derivatives of the ratio of the impulse, of its length and of its angle by the impulse.
    pub(super) ratio: Nt<T>,
    pub(super) length: Nt<T>,
    pub(super) angle: Nt<T>,
    pub(super) passed: [Passed<T>; 2],
}

impl<T: Real<Mask: Logic> + Copy> Mixture<T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn of(impact: &Impact<T>, adjoint: &ImpulseAdjoint<T>) -> Self {
        let (p, half) = (impact.impulse, T::int(1).half());
        Mixture {
            plane: adjoint.plane,
            velocity: (impact.approach + impact.separation) * -half,
            force: p * -half,
            ratio: Cotangent::of_ratio(p).impulse,
            length: p * p.length().inv(),
            angle: p.quarter_turn() * p.length_squared().inv(),
            passed: [Passed::on(adjoint.partials[0].as_ref()), Passed::on(adjoint.partials[1].as_ref())],
        }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn on_ground(&self, impulse: Nt<T>) -> Xy<T> {
        self.plane.to_ground(impulse)
    }

    /// W = −½ P (v + V)
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn work(&self, impulse: Nt<T>, approach: Nt<T>, separation: Nt<T>) -> Nt<T> {
        Nt {
            n: self.velocity.n * impulse.n + self.force.n * (approach.n + separation.n),
            t: self.velocity.t * impulse.t + self.force.t * (approach.t + separation.t),
        }
    }
}

/// Writes the derivatives of each output through the impulse and the velocities.
#[cfg_attr(not(debug_assertions), inline(always))]
fn mix<T: Real<Mask: Logic> + Copy>(impact: &Impact<T>, adjoint: &ImpulseAdjoint<T>, to: &mut Outputs<Sensitive<T>>) {
    let mixture = Mixture::of(impact, adjoint);
    for i in 0..Input::COUNT {
        let impulse = Nt { n: to.impulse.n.by.0[i], t: to.impulse.t.by.0[i] };
        let approach = Nt { n: to.approach.n.by.0[i], t: to.approach.t.by.0[i] };
        let separation = Nt { n: to.separation.n.by.0[i], t: to.separation.t.by.0[i] };
        let Xy { x, y } = mixture.on_ground(impulse);
        to.impulse_on_ground.x.by.0[i] = x;
        to.impulse_on_ground.y.by.0[i] = y;
        let by_ratio = mixture.ratio.dot(impulse);
        to.impulse_ratio.by.0[i] = by_ratio;
        to.critical_impulse_ratio.by.0[i] = by_ratio;
        let work = mixture.work(impulse, approach, separation);
        let loss = -(work.n + work.t);
        to.work.n.by.0[i] = work.n;
        to.work.t.by.0[i] = work.t;
        to.loss.by.0[i] = loss;
        to.kinetic_energy.after.by.0[i] = to.kinetic_energy.before.by.0[i] - loss;
        let (length, angle) = (mixture.length.dot(impulse), mixture.angle.dot(impulse));
        for (vehicle, passed) in [&mut to.one, &mut to.two].into_iter().zip(&mixture.passed) {
            let (dx, dy) = (passed.push * x, passed.push * y);
            vehicle.delta_v.x.by.0[i] = dx;
            vehicle.delta_v.y.by.0[i] = dy;
            vehicle.after.velocity.x.by.0[i] = dx;
            vehicle.after.velocity.y.by.0[i] = dy;
            vehicle.after.yaw_rate.by.0[i] = passed.twist.dot(impulse);
            vehicle.delta_v_magnitude.by.0[i] = passed.inverse_mass * length;
            vehicle.principal_direction_of_force.by.0[i] = passed.direction * angle;
        }
    }
}

/// The response of a vehicle to the impulse; zero for a barrier.
pub(super) struct Passed<T> {
    pub(super) inverse_mass: T,
    /// ∓1/m
    pub(super) push: T,
    /// ∓r⊥/I
    pub(super) twist: Nt<T>,
    /// −1, because it is measured clockwise.
    pub(super) direction: T,
}

impl<T: Real + Copy> Passed<T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn on(partials: Option<&BodyPartials<T>>) -> Self {
        match partials {
            Some(partials) => Passed {
                inverse_mass: partials.inverse_mass,
                push: -(partials.sign * partials.inverse_mass),
                twist: partials.arm.quarter_turn() * -(partials.sign * partials.inverse_yaw_inertia),
                direction: T::int(-1),
            },
            None => Passed { inverse_mass: T::int(0), push: T::int(0), twist: Nt::zero(), direction: T::int(0) },
        }
    }
}

/// Adds the derivatives of each output by its inputs with the impulse held constant.
#[cfg_attr(not(debug_assertions), inline(always))]
fn add_direct<T: Real<Mask: Logic> + Copy>(
    collision: &Collision<T>,
    impact: &Impact<T>,
    adjoint: &ImpulseAdjoint<T>,
    to: &mut Outputs<Sensitive<T>>,
) {
    // Written out, so that the compiler knows each output. Those left out have no direct derivatives, or have them in the rows that they are combined from.
    macro_rules! add {
        ($($output:expr),+) => { $(cotangent::add_direct(collision, impact, adjoint, $output, &mut to[$output].by);)+ };
    }
    use Output::*;
    add!(VelocityX(Side::One), VelocityY(Side::One), YawRate(Side::One), DeltaVX(Side::One), DeltaVY(Side::One));
    add!(DeltaVMagnitude(Side::One), PrincipalDirectionOfForce(Side::One));
    add!(VelocityX(Side::Two), VelocityY(Side::Two), YawRate(Side::Two), DeltaVX(Side::Two), DeltaVY(Side::Two));
    add!(DeltaVMagnitude(Side::Two), PrincipalDirectionOfForce(Side::Two));
    add!(Restitution, ImpulseX, ImpulseY);
}
