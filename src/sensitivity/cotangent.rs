//! Derivatives of one output by the impulse and the velocities, and by its inputs directly.

use super::body_partials::{BodyPartials, ByVehicle};
use super::impulse_adjoint::{Cotangent, ImpulseAdjoint};
use super::{Gradient, Sensitive};
use crate::collision::Collision;
use crate::contact::Contact;
use crate::frame::{Nt, Xy};
use crate::impact::Impact;
use crate::input::{Input, Side};
use crate::output::Output;
use crate::scalar::{Logic, Ordered, Real};
use crate::vehicle::Party;

/// Returns one output of an impact with its derivatives by every input.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn sensitivity<T: Real<Mask: Logic> + Copy>(
    collision: &Collision<T>,
    contact: &Contact<T>,
    impact: &Impact<T>,
    of: Output,
) -> Sensitive<T> {
    Sensitive { value: of.of(collision, impact), by: gradient(collision, impact, &ImpulseAdjoint::of(collision, contact, impact), of) }
}

/// Returns the derivatives by every input of a sum of outputs with weights: one solution of the transposed equations for all of them.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn pullback<T: Real<Mask: Logic> + Copy>(
    collision: &Collision<T>,
    contact: &Contact<T>,
    impact: &Impact<T>,
    weights: impl IntoIterator<Item = (Output, T)>,
) -> Gradient<T> {
    let adjoint = ImpulseAdjoint::of(collision, contact, impact);
    let (mut sum, mut gradient) = (Cotangent::nothing(), Gradient::zero());
    for (of, weight) in weights {
        let mut direct = Gradient::zero();
        if of == Output::CriticalImpulseRatio {
            direct = self::gradient(collision, impact, &adjoint, of);
        } else {
            add_direct(collision, impact, &adjoint, of, &mut direct);
            if let Some(cotangent) = cotangent(&adjoint, impact, of) {
                sum = sum.plus(weight, cotangent);
            }
        }
        gradient.add_scaled(weight, &direct);
    }
    gradient.add_scaled(T::int(1), &adjoint.gradient(sum));
    gradient
}

#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn gradient<T: Real<Mask: Logic> + Copy>(
    collision: &Collision<T>,
    impact: &Impact<T>,
    adjoint: &ImpulseAdjoint<T>,
    of: Output,
) -> Gradient<T> {
    let critical;
    let adjoint = if of == Output::CriticalImpulseRatio {
        critical = adjoint.critical(impact.critical_impulse);
        &critical
    } else {
        adjoint
    };
    let mut gradient = match cotangent(adjoint, impact, of) {
        Some(cotangent) => adjoint.gradient(cotangent),
        None => Gradient::zero(),
    };
    add_direct(collision, impact, adjoint, of, &mut gradient);
    gradient
}

/// Returns `None` for an output that does not depend on an impulse or an approach velocity.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn cotangent<T: Real<Mask: Logic> + Copy>(adjoint: &ImpulseAdjoint<T>, impact: &Impact<T>, of: Output) -> Option<Cotangent<T>> {
    let (p, v) = (adjoint.impulse, adjoint.approach);
    let (zero, one) = (T::int(0), T::int(1));
    let (n, t) = (Nt { n: one, t: zero }, Nt { n: zero, t: one });
    let ground = |x, y| adjoint.plane.to_contact(Xy { x, y });
    let pushed = |side: Side, direction: Nt<T>| {
        let partials = partials(adjoint, side)?;
        Some(Cotangent::of_impulse(direction * -(partials.sign * partials.inverse_mass)))
    };
    Some(match of {
        Output::VelocityX(side) | Output::DeltaVX(side) => return pushed(side, ground(one, zero)),
        Output::VelocityY(side) | Output::DeltaVY(side) => return pushed(side, ground(zero, one)),
        Output::YawRate(side) => {
            let partials = partials(adjoint, side)?;
            Cotangent::of_impulse(partials.arm.quarter_turn() * -(partials.sign * partials.inverse_yaw_inertia))
        }
        Output::DeltaVMagnitude(side) => Cotangent::of_impulse(p * (partials(adjoint, side)?.inverse_mass / p.length())),
        Output::PrincipalDirectionOfForce(side) => {
            partials(adjoint, side)?;
            Cotangent::of_impulse(-(p.quarter_turn() * p.length_squared().inv()))
        }
        Output::ImpulseRatio | Output::CriticalImpulseRatio => Cotangent::of_ratio(p),
        Output::NormalImpulse => Cotangent::of_impulse(n),
        Output::TangentialImpulse => Cotangent::of_impulse(t),
        Output::ImpulseX => Cotangent::of_impulse(ground(one, zero)),
        Output::ImpulseY => Cotangent::of_impulse(ground(zero, one)),
        Output::NormalApproach => Cotangent { approach: n, ..Cotangent::nothing() },
        Output::TangentialApproach => Cotangent { approach: t, ..Cotangent::nothing() },
        Output::NormalSeparation => Cotangent { approach: n * -adjoint.restitution, ..Cotangent::nothing() },
        Output::TangentialSeparation => Cotangent { separation: t, ..Cotangent::nothing() },
        // T_L = ½ P·(v + V)
        Output::Loss => of_loss(adjoint, impact),
        Output::EnergyAfter => -of_loss(adjoint, impact),
        // W_n = −½ (1 − e) P_n v_n
        Output::NormalWork => {
            let share = -((one - adjoint.restitution).half());
            Cotangent { impulse: n * (share * v.n), approach: n * (share * p.n), ..Cotangent::nothing() }
        }
        // W_t = −½ P_t (v_t + V_t)
        Output::TangentialWork => {
            let velocity = t * -(p.t.half());
            Cotangent { impulse: t * -((v.t + impact.separation.t).half()), approach: velocity, separation: velocity }
        }
        Output::Restitution | Output::Moment | Output::EnergyBefore | Output::MomentWork => return None,
    })
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn of_loss<T: Real<Mask: Logic> + Copy>(adjoint: &ImpulseAdjoint<T>, impact: &Impact<T>) -> Cotangent<T> {
    let p = adjoint.impulse.map(T::half);
    Cotangent { impulse: (adjoint.approach + impact.separation).map(T::half), approach: p, separation: p }
}

/// Adds the derivatives of the output by the inputs with impulse and velocities held constant.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn add_direct<T: Real<Mask: Logic> + Copy>(
    collision: &Collision<T>,
    impact: &Impact<T>,
    adjoint: &ImpulseAdjoint<T>,
    of: Output,
    to: &mut Gradient<T>,
) {
    let (p, one) = (impact.impulse_on_ground, T::int(1));
    match of {
        Output::VelocityX(side) | Output::VelocityY(side) | Output::DeltaVX(side) | Output::DeltaVY(side) => {
            let Some(partials) = partials(adjoint, side) else { return };
            let along_x = matches!(of, Output::VelocityX(_) | Output::DeltaVX(_));
            let (along, turned) = if along_x { (p.x, -p.y) } else { (p.y, p.x) };
            let push = partials.sign * partials.inverse_mass;
            to.add(Input::Mass(side), push * partials.inverse_mass * along);
            to.add(Input::CrushPlane, -(push * turned));
            match of {
                Output::VelocityX(_) => to.add(Input::VelocityX(side), one),
                Output::VelocityY(_) => to.add(Input::VelocityY(side), one),
                _ => (),
            }
        }
        Output::YawRate(side) => {
            let Some(partials) = partials(adjoint, side) else { return };
            let twist = partials.sign * partials.inverse_yaw_inertia;
            let c = partials.moments(adjoint.impulse);
            to.add(Input::YawInertia(side), twist * partials.inverse_yaw_inertia * c.here);
            for (input, by) in partials.arm_inputs().into_iter().zip(c.by_arm()) {
                to.add(input, -(twist * by));
            }
            to.add(Input::CrushPlane, twist * c.heading);
            to.add(Input::YawRate(side), one);
        }
        Output::DeltaVMagnitude(side) => {
            let Some(partials) = partials(adjoint, side) else { return };
            to.add(Input::Mass(side), -(partials.inverse_mass * partials.inverse_mass * adjoint.impulse.length()));
        }
        Output::PrincipalDirectionOfForce(side) if partials(adjoint, side).is_some() => {
            to.add(Input::CrushPlane, -one);
            to.add(Input::Heading(side), one);
        }
        Output::Restitution => to.add(Input::Restitution, one),
        Output::ImpulseX => to.add(Input::CrushPlane, -p.y),
        Output::ImpulseY => to.add(Input::CrushPlane, p.x),
        Output::NormalSeparation => to.add(Input::Restitution, -adjoint.approach.n),
        Output::NormalWork => to.add(Input::Restitution, (adjoint.impulse.n * adjoint.approach.n).half()),
        Output::EnergyBefore | Output::EnergyAfter => to.add_scaled(one, &energy(collision)),
        _ => (),
    }
}

/// Returns the derivatives of the kinetic energy before the impact by each input.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn energy<T: Real + Copy>(collision: &Collision<T>) -> Gradient<T> {
    let of = |party: &Party<T>| match party {
        Party::Barrier => ByVehicle::nothing(),
        Party::Vehicle(vehicle) => {
            let motion = vehicle.motion;
            ByVehicle {
                mass: motion.velocity.length_squared().half(),
                yaw_inertia: motion.yaw_rate.squared().half(),
                velocity: motion.velocity * vehicle.mass,
                yaw_rate: vehicle.yaw_inertia * motion.yaw_rate,
                ..ByVehicle::nothing()
            }
        }
    };
    Gradient::of_parts(&of(&collision.one), &of(&collision.two), T::int(0), T::int(0))
}

#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn partials<T: Ordered>(adjoint: &ImpulseAdjoint<T>, side: Side) -> Option<&BodyPartials<T>> {
    adjoint.partials[side as usize].as_ref()
}

impl<T: Real + Copy> core::ops::Neg for Cotangent<T> {
    type Output = Self;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn neg(self) -> Self {
        Cotangent { impulse: -self.impulse, approach: -self.approach, separation: -self.separation }
    }
}
