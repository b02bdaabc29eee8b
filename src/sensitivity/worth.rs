//! What one output is worth of the impulse and the velocities, and what its inputs do to it directly.

use super::lever::{ByVehicle, Lever};
use super::waist::{Waist, Worth};
use super::{Gradient, Sensitive};
use crate::collision::Collision;
use crate::contact::Contact;
use crate::frame::{Nt, Xy};
use crate::impact::Impact;
use crate::input::{Input, Side};
use crate::output::Output;
use crate::scalar::{Ordered, Real};
use crate::vehicle::Party;

/// One output of an impact with its derivatives by every input.
#[inline(always)]
pub(super) fn sensitivity<T: Real + Copy + Ordered<Mask = bool>>(
    collision: &Collision<T>,
    contact: &Contact<T>,
    impact: &Impact<T>,
    of: Output,
) -> Sensitive<T> {
    Sensitive { value: of.of(collision, impact), by: gradient(collision, impact, &Waist::of(collision, contact, impact), of) }
}

#[inline(always)]
pub(super) fn gradient<T: Real + Copy>(collision: &Collision<T>, impact: &Impact<T>, waist: &Waist<T>, of: Output) -> Gradient<T> {
    let critical;
    let waist = if of == Output::CriticalImpulseRatio {
        critical = waist.critical(impact.critical_impulse);
        &critical
    } else {
        waist
    };
    let mut gradient = match worth(waist, impact, of) {
        Some(worth) => waist.gradient(worth),
        None => Gradient::zero(),
    };
    add_direct(collision, impact, waist, of, &mut gradient);
    gradient
}

/// None for an output that no impulse and no approach velocity has a part in.
#[inline(always)]
pub(super) fn worth<T: Real + Copy>(waist: &Waist<T>, impact: &Impact<T>, of: Output) -> Option<Worth<T>> {
    let (p, v) = (waist.impulse, waist.approach);
    let (zero, one) = (T::int(0), T::int(1));
    let (n, t) = (Nt { n: one, t: zero }, Nt { n: zero, t: one });
    let ground = |x, y| waist.plane.to_contact(Xy { x, y });
    let pushed = |side: Side, direction: Nt<T>| {
        let lever = lever(waist, side)?;
        Some(Worth::of_impulse(direction * -(lever.sign * lever.inverse_mass)))
    };
    Some(match of {
        Output::VelocityX(side) | Output::DeltaVX(side) => return pushed(side, ground(one, zero)),
        Output::VelocityY(side) | Output::DeltaVY(side) => return pushed(side, ground(zero, one)),
        Output::YawRate(side) => {
            let lever = lever(waist, side)?;
            Worth::of_impulse(lever.arm.quarter_turn() * -(lever.sign * lever.inverse_yaw_inertia))
        }
        Output::DeltaVMagnitude(side) => Worth::of_impulse(p * (lever(waist, side)?.inverse_mass / p.length())),
        Output::PrincipalDirectionOfForce(side) => {
            lever(waist, side)?;
            Worth::of_impulse(-(p.quarter_turn() * p.length_squared().inv()))
        }
        Output::ImpulseRatio | Output::CriticalImpulseRatio => Worth::of_ratio(p),
        Output::NormalImpulse => Worth::of_impulse(n),
        Output::TangentialImpulse => Worth::of_impulse(t),
        Output::ImpulseX => Worth::of_impulse(ground(one, zero)),
        Output::ImpulseY => Worth::of_impulse(ground(zero, one)),
        Output::NormalApproach => Worth { approach: n, ..Worth::nothing() },
        Output::TangentialApproach => Worth { approach: t, ..Worth::nothing() },
        Output::NormalSeparation => Worth { approach: n * -waist.restitution, ..Worth::nothing() },
        Output::TangentialSeparation => Worth { separation: t, ..Worth::nothing() },
        // T_L = ½ P·(v + V)
        Output::Loss => of_loss(waist, impact),
        Output::EnergyAfter => -of_loss(waist, impact),
        // W_n = −½ (1 − e) P_n v_n
        Output::NormalWork => {
            let share = -((one - waist.restitution).half());
            Worth { impulse: n * (share * v.n), approach: n * (share * p.n), ..Worth::nothing() }
        }
        // W_t = −½ P_t (v_t + V_t)
        Output::TangentialWork => {
            let velocity = t * -(p.t.half());
            Worth { impulse: t * -((v.t + impact.separation.t).half()), approach: velocity, separation: velocity }
        }
        Output::Restitution | Output::Moment | Output::EnergyBefore | Output::MomentWork => return None,
    })
}

#[inline(always)]
fn of_loss<T: Real + Copy>(waist: &Waist<T>, impact: &Impact<T>) -> Worth<T> {
    let p = waist.impulse.map(T::half);
    Worth { impulse: (waist.approach + impact.separation).map(T::half), approach: p, separation: p }
}

/// What the inputs do to the output with impulse and velocities held.
#[inline(always)]
pub(super) fn add_direct<T: Real + Copy>(collision: &Collision<T>, impact: &Impact<T>, waist: &Waist<T>, of: Output, to: &mut Gradient<T>) {
    let (p, one) = (impact.impulse_on_ground, T::int(1));
    match of {
        Output::VelocityX(side) | Output::VelocityY(side) | Output::DeltaVX(side) | Output::DeltaVY(side) => {
            let Some(lever) = lever(waist, side) else { return };
            let along_x = matches!(of, Output::VelocityX(_) | Output::DeltaVX(_));
            let (along, turned) = if along_x { (p.x, -p.y) } else { (p.y, p.x) };
            let push = lever.sign * lever.inverse_mass;
            to.add(Input::Mass(side), push * lever.inverse_mass * along);
            to.add(Input::CrushPlane, -(push * turned));
            match of {
                Output::VelocityX(_) => to.add(Input::VelocityX(side), one),
                Output::VelocityY(_) => to.add(Input::VelocityY(side), one),
                _ => (),
            }
        }
        Output::YawRate(side) => {
            let Some(lever) = lever(waist, side) else { return };
            let twist = lever.sign * lever.inverse_yaw_inertia;
            let c = lever.moments(waist.impulse);
            to.add(Input::YawInertia(side), twist * lever.inverse_yaw_inertia * c.here);
            for (input, by) in lever.arm_inputs().into_iter().zip(c.by_arm()) {
                to.add(input, -(twist * by));
            }
            to.add(Input::CrushPlane, twist * c.heading);
            to.add(Input::YawRate(side), one);
        }
        Output::DeltaVMagnitude(side) => {
            let Some(lever) = lever(waist, side) else { return };
            to.add(Input::Mass(side), -(lever.inverse_mass * lever.inverse_mass * waist.impulse.length()));
        }
        Output::PrincipalDirectionOfForce(side) if lever(waist, side).is_some() => {
            to.add(Input::CrushPlane, -one);
            to.add(Input::Heading(side), one);
        }
        Output::Restitution => to.add(Input::Restitution, one),
        Output::ImpulseX => to.add(Input::CrushPlane, -p.y),
        Output::ImpulseY => to.add(Input::CrushPlane, p.x),
        Output::NormalSeparation => to.add(Input::Restitution, -waist.approach.n),
        Output::NormalWork => to.add(Input::Restitution, (waist.impulse.n * waist.approach.n).half()),
        Output::EnergyBefore | Output::EnergyAfter => to.add_scaled(one, &energy(collision)),
        _ => (),
    }
}

/// The kinetic energy before the impact by each input.
#[inline(always)]
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

#[inline(always)]
pub(super) fn lever<T>(waist: &Waist<T>, side: Side) -> Option<&Lever<T>> {
    waist.levers[side as usize].as_ref()
}

impl<T: Real + Copy> core::ops::Neg for Worth<T> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Worth { impulse: -self.impulse, approach: -self.approach, separation: -self.separation }
    }
}
