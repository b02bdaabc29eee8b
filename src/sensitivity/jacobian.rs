//! All outputs by all inputs at once: the rows of the impulse and of the velocities at the impact center, and every other row as a linear combination of
//! those.
//!
//! Every row is written to its final place in one loop: the table has five thousand bytes, and moving it would cost as much as computing it.

use super::body_partials::BodyPartials;
use super::impulse_adjoint::{Cotangent, ImpulseAdjoint, Slip};
use super::{Gradient, Sensitive, cotangent};
use crate::collision::Collision;
use crate::contact::Contact;
use crate::frame::Nt;
use crate::impact::Impact;
use crate::input::{Input, Side};
use crate::law::Law;
use crate::output::{Output, Outputs};
use crate::scalar::{Logic, Real};

/// The derivatives from which those of all other outputs follow.
pub(super) struct Rows<T> {
    pub(super) impulse: Nt<Gradient<T>>,
    pub(super) approach: Nt<Gradient<T>>,
    pub(super) separation: Nt<Gradient<T>>,
}

impl<T: Real<Mask: Logic> + Copy> Rows<T> {
    #[inline(always)]
    pub(super) fn of(adjoint: &ImpulseAdjoint<T>) -> Self {
        let mut rows = Rows::zero();
        rows.fill(adjoint);
        rows
    }

    #[inline(always)]
    pub(super) fn zero() -> Self {
        let [impulse, approach, separation] = [Nt { n: Gradient::zero(), t: Gradient::zero() }; 3];
        Rows { impulse, approach, separation }
    }

    #[inline(always)]
    pub(super) fn fill(&mut self, adjoint: &ImpulseAdjoint<T>) {
        let Nt { n, t } = axes();
        self.impulse.n = adjoint.gradient(Cotangent::of_impulse(n));
        self.impulse.t = adjoint.gradient(Cotangent::of_impulse(t));
        self.approach.n = adjoint.approach_row(n);
        self.approach.t = adjoint.approach_row(t);
        self.separation.n = rebound(adjoint, &self.approach.n, adjoint.approach.n);
        self.separation.t = sliding(adjoint, &self.impulse, &self.approach.t);
    }
}

/// Returns the directions of the two components.
#[inline(always)]
fn axes<T: Real>() -> Nt<Nt<T>> {
    Nt { n: Nt { n: T::int(1), t: T::int(0) }, t: Nt { n: T::int(0), t: T::int(1) } }
}

/// Returns the gradient of V = −e v, the normal separation velocity whatever the law.
#[inline(always)]
fn rebound<T: Real<Mask: Logic> + Copy>(adjoint: &ImpulseAdjoint<T>, approach: &Gradient<T>, v: T) -> Gradient<T> {
    let mut row = *approach;
    row.scale(-adjoint.restitution);
    row.add(Input::Restitution, -v);
    row
}

/// Returns the gradient of the tangential separation velocity.
#[inline(always)]
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
#[inline(always)]
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
    mix(collision, impact, &adjoint, to);
    for none in [&mut to.restitution, &mut to.moment, &mut to.work.m] {
        none.by = Gradient::zero();
    }
    add_direct(collision, impact, &adjoint, to);
    if !matches!((&adjoint.slip, adjoint.law), (Slip::Ends, Law::Brach)) {
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

/// Returns the gradient of the critical ratio if the impulse has another ratio. Rarely needed, and therefore a separate function.
#[cold]
#[inline(never)]
pub(super) fn critical<T: Real<Mask: Logic> + Copy>(adjoint: &ImpulseAdjoint<T>, impact: &Impact<T>) -> Gradient<T> {
    let critical = impact.critical_impulse;
    adjoint.critical(critical).gradient(Cotangent::of_ratio(critical))
}

/// Writes the derivatives of each output through the impulse and the velocities.
#[inline(always)]
fn mix<T: Real<Mask: Logic> + Copy>(
    collision: &Collision<T>,
    impact: &Impact<T>,
    adjoint: &ImpulseAdjoint<T>,
    to: &mut Outputs<Sensitive<T>>,
) {
    let p = impact.impulse;
    let (cos, sin) = (collision.crush_plane.cos, collision.crush_plane.sin);
    let half = T::int(1).half();
    let sum = (impact.approach + impact.separation) * -half;
    let minus_half_p = p * -half;
    let ratio = Cotangent::of_ratio(p).impulse;
    let along = p * p.length().inv();
    let across = p.quarter_turn() * p.length_squared().inv();
    let (one, two) = (Passed::on(adjoint.partials[0].as_ref()), Passed::on(adjoint.partials[1].as_ref()));
    for i in 0..Input::COUNT {
        let (n, t) = (to.impulse.n.by.0[i], to.impulse.t.by.0[i]);
        let (v_n, v_t) = (to.approach.n.by.0[i], to.approach.t.by.0[i]);
        let (s_n, s_t) = (to.separation.n.by.0[i], to.separation.t.by.0[i]);
        let (x, y) = (cos * n - sin * t, sin * n + cos * t);
        to.impulse_on_ground.x.by.0[i] = x;
        to.impulse_on_ground.y.by.0[i] = y;
        let by_ratio = ratio.n * n + ratio.t * t;
        to.impulse_ratio.by.0[i] = by_ratio;
        to.critical_impulse_ratio.by.0[i] = by_ratio;
        // W = −½ P (v + V)
        let work_n = sum.n * n + minus_half_p.n * (v_n + s_n);
        let work_t = sum.t * t + minus_half_p.t * (v_t + s_t);
        let loss = -(work_n + work_t);
        to.work.n.by.0[i] = work_n;
        to.work.t.by.0[i] = work_t;
        to.loss.by.0[i] = loss;
        to.kinetic_energy.after.by.0[i] = to.kinetic_energy.before.by.0[i] - loss;
        let length = along.n * n + along.t * t;
        let angle = across.n * n + across.t * t;
        for (vehicle, passed) in [(&mut to.one, &one), (&mut to.two, &two)] {
            let (dx, dy) = (passed.push * x, passed.push * y);
            vehicle.delta_v.x.by.0[i] = dx;
            vehicle.delta_v.y.by.0[i] = dy;
            vehicle.after.velocity.x.by.0[i] = dx;
            vehicle.after.velocity.y.by.0[i] = dy;
            vehicle.after.yaw_rate.by.0[i] = passed.twist.n * n + passed.twist.t * t;
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
    #[inline(always)]
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
#[inline(always)]
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
