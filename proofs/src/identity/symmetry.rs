//! Symmetries: exchange of the vehicles, direction of the axes, observer, units, and direction of time.

use planar_impact::{Collision, CrushPlane, Field, ForwardLeft, Heading, Motion, Nt, Vehicle, Xy};

use super::scene::{Scene, each_vehicle, inelastic, kudlich_slibar};
use super::{Identity, identity};
use crate::equation::Equations;
use crate::free::Free;

pub(super) fn all() -> Vec<Identity> {
    vec![
        identity!(exchange, "the vehicles may be exchanged", "1 ↔ 2: P becomes −P, all else follows its vehicle"),
        identity!(rotation, "the ground may be turned", "n-t components, works and energies stay, velocities turn along"),
        identity!(mirror_image, "the mirror image does the mirror image", "y, left, angles, ω, μ change sign: so do P_t and Ω"),
        identity!(observer, "a moving observer sees the same impact", "v + c for all: P, W, T_L stay, V becomes V + c"),
        identity!(units, "units scale each quantity by its power", "mass κ, length λ, time τ: P by κλ/τ, W by κλ²/τ², Ω by 1/τ, μ0 by 1"),
        identity!(common_mass, "μ0 is free of a common factor of all masses", "m, I by κ: μ0 and motions stay, P and W by κ", "A27"),
        identity!(reversal, "run backwards, the impulse undoes the impact", "−V, −Ω before and P again: −v, −ω after, W → −W"),
        identity!(elastic, "at e = 1 Kudlich–Slibar undoes itself", "a second impact from −V, −Ω ends at −v, −ω; T_L = 0"),
        identity!(settled, "after e = 0, μ = μ0 nothing is left to do", "a second impact from V, Ω has P = 0"),
    ]
}

/// Returns the impacts of a collision at its critical ratio and at a given ratio.
fn impacts<T: Field>(collision: &Collision<T>, ratio: &T) -> [Scene<T>; 2] {
    [Scene::sticking(collision.clone()), Scene::at_ratio(collision.clone(), ratio.clone())]
}

fn reversed<T: Field>(motion: Motion<T>) -> Motion<T> {
    Motion { velocity: -motion.velocity, yaw_rate: -motion.yaw_rate }
}

fn exchange<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let mut must = Equations::new();
    for collision in free.collisions() {
        let ratio = free.variable();
        let exchanged = Collision { one: collision.two.clone(), two: collision.one.clone(), ..collision.clone() };
        for (here, there) in impacts(&collision, &ratio).into_iter().zip(impacts(&exchanged, &ratio)) {
            let (here, there) = (here.impact, there.impact);
            must.equal(here.impulse, -there.impulse);
            must.equal(here.approach, -there.approach);
            must.equal(here.separation, -there.separation);
            must.equal(here.one, there.two);
            must.equal(here.two, there.one);
            must.equal(here.work, there.work);
            must.equal(here.kinetic_energy, there.kinetic_energy);
        }
    }
    must
}

fn rotation<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let mut must = Equations::new();
    for collision in free.collisions() {
        let (by, ratio) = (free.heading(), free.variable());
        let rotate = |v: Xy<T>| by.to_ground(ForwardLeft { forward: v.x, left: v.y });
        let around = each_vehicle(collision.clone(), |vehicle| Vehicle {
            heading: {
                let ahead = rotate(Xy { x: vehicle.heading.cos, y: vehicle.heading.sin });
                Heading { cos: ahead.x, sin: ahead.y }
            },
            motion: Motion { velocity: rotate(vehicle.motion.velocity), yaw_rate: vehicle.motion.yaw_rate },
            ..vehicle
        });
        let normal = rotate(Xy { x: collision.crush_plane.cos.clone(), y: collision.crush_plane.sin.clone() });
        let around = Collision { crush_plane: CrushPlane { cos: normal.x, sin: normal.y }, ..around };
        for (here, there) in impacts(&collision, &ratio).into_iter().zip(impacts(&around, &ratio)) {
            let (here, there) = (here.impact, there.impact);
            must.equal(here.impulse, there.impulse);
            must.equal(here.approach, there.approach);
            must.equal(here.separation, there.separation);
            must.equal(here.work, there.work);
            must.equal(here.kinetic_energy, there.kinetic_energy);
            must.equal(rotate(here.impulse_on_ground), there.impulse_on_ground);
            for (here, there) in [(here.one, there.one), (here.two, there.two)] {
                must.equal(rotate(here.after.velocity), there.after.velocity);
                must.equal(here.after.yaw_rate, there.after.yaw_rate);
                must.equal(here.delta_v_in_vehicle, there.delta_v_in_vehicle);
            }
        }
    }
    must
}

fn mirror_image<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let mut must = Equations::new();
    let mirror = |v: Xy<T>| Xy { x: v.x, y: -v.y };
    for collision in free.collisions() {
        let ratio = free.variable();
        let image = each_vehicle(collision.clone(), |vehicle| Vehicle {
            heading: Heading { cos: vehicle.heading.cos, sin: -vehicle.heading.sin },
            impact_center: ForwardLeft { forward: vehicle.impact_center.forward, left: -vehicle.impact_center.left },
            motion: Motion { velocity: mirror(vehicle.motion.velocity), yaw_rate: -vehicle.motion.yaw_rate },
            ..vehicle
        });
        let plane = collision.crush_plane.clone();
        let image = Collision { crush_plane: CrushPlane { cos: plane.cos, sin: -plane.sin }, ..image };
        for (here, there) in impacts(&collision, &ratio).into_iter().zip(impacts(&image, &-ratio.clone())) {
            let (here, there) = (here.impact, there.impact);
            must.equal(here.work, there.work);
            must.equal(here.kinetic_energy, there.kinetic_energy);
            must.equal(here.impulse.n, there.impulse.n);
            must.equal(here.impulse.t, -there.impulse.t);
            for (here, there) in [(here.one, there.one), (here.two, there.two)] {
                must.equal(mirror(here.after.velocity), there.after.velocity);
                must.equal(-here.after.yaw_rate, there.after.yaw_rate);
            }
        }
    }
    must
}

fn observer<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let mut must = Equations::new();
    let (collision, ratio, drift) = (free.collision(), free.variable(), free.xy());
    let watched = each_vehicle(collision.clone(), |vehicle| Vehicle {
        motion: Motion { velocity: vehicle.motion.velocity + drift.clone(), yaw_rate: vehicle.motion.yaw_rate },
        ..vehicle
    });
    for (here, there) in impacts(&collision, &ratio).into_iter().zip(impacts(&watched, &ratio)) {
        let (here, there) = (here.impact, there.impact);
        must.equal(here.impulse, there.impulse);
        must.equal(here.work, there.work);
        for (here, there) in [(here.one, there.one), (here.two, there.two)] {
            must.equal(here.after.velocity + drift.clone(), there.after.velocity);
            must.equal(here.after.yaw_rate, there.after.yaw_rate);
        }
    }
    must
}

fn units<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let mut must = Equations::new();
    for collision in free.collisions() {
        let ratio = free.variable();
        let (mass, length, time) = (free.variable(), free.variable(), free.variable());
        let speed = length.clone() / time.clone();
        let momentum = mass.clone() * speed.clone();
        let energy = momentum.clone() * speed.clone();
        let other = each_vehicle(collision.clone(), |vehicle| Vehicle {
            mass: vehicle.mass * mass.clone(),
            yaw_inertia: vehicle.yaw_inertia * mass.clone() * length.clone().squared(),
            impact_center: vehicle.impact_center * length.clone(),
            motion: Motion { velocity: vehicle.motion.velocity * speed.clone(), yaw_rate: vehicle.motion.yaw_rate / time.clone() },
            heading: vehicle.heading,
        });
        for (here, there) in impacts(&collision, &ratio).into_iter().zip(impacts(&other, &ratio)) {
            let (here, there) = (here.impact, there.impact);
            must.equal(here.critical_impulse_ratio(), there.critical_impulse_ratio());
            must.equal(here.impulse * momentum.clone(), there.impulse);
            must.equal(here.separation * speed.clone(), there.separation);
            must.equal(here.work.map(|work| work * energy.clone()), there.work);
            must.equal(here.kinetic_energy.map(|t| t * energy.clone()), there.kinetic_energy);
            for (here, there) in [(here.one, there.one), (here.two, there.two)] {
                must.equal(here.after.velocity * speed.clone(), there.after.velocity);
                must.equal(here.after.yaw_rate / time.clone(), there.after.yaw_rate);
            }
        }
    }
    must
}

fn common_mass<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let mut must = Equations::new();
    for collision in free.collisions() {
        let factor = free.variable();
        let heavier = each_vehicle(collision.clone(), |vehicle| Vehicle {
            mass: vehicle.mass * factor.clone(),
            yaw_inertia: vehicle.yaw_inertia * factor.clone(),
            ..vehicle
        });
        let (here, there) = (Scene::sticking(collision).impact, Scene::sticking(heavier).impact);
        must.equal(here.critical_impulse_ratio(), there.critical_impulse_ratio());
        must.equal(here.one, there.one);
        must.equal(here.two, there.two);
        must.equal(here.impulse * factor.clone(), there.impulse);
        must.equal(here.work.map(|work| work * factor.clone()), there.work);
    }
    must
}

fn reversal<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let mut must = Equations::new();
    for collision in free.collisions() {
        let there = Scene::by_any_moment(free, collision);
        let back = Scene::by(there.continued(reversed), there.impact.impulse.clone(), Some(there.impact.moment.clone()));
        for (start, end) in there.sides().into_iter().zip(back.sides()) {
            must.equal(reversed(end.response.after.clone()), start.vehicle.motion.clone());
        }
        must.equal(back.impact.work.map(|work| -work), there.impact.work);
    }
    must
}

fn elastic<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let mut must = Equations::new();
    for collision in free.collisions().map(kudlich_slibar) {
        let there = Scene::sticking(Collision { restitution: T::int(1), ..collision });
        let back = Scene::sticking(there.continued(reversed));
        for (start, end) in there.sides().into_iter().zip(back.sides()) {
            must.equal(reversed(end.response.after.clone()), start.vehicle.motion.clone());
        }
        must.equal(there.impact.loss(), T::int(0));
        must.equal(back.impact.loss(), T::int(0));
    }
    must
}

fn settled<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let mut must = Equations::new();
    for collision in free.collisions().map(inelastic) {
        let first = Scene::sticking(collision);
        let second = Scene::sticking(first.continued(|motion| motion));
        must.equal(second.impact.impulse, Nt::zero());
        must.equal(second.impact.one.after, first.impact.one.after);
        must.equal(second.impact.two.after, first.impact.two.after);
    }
    must
}
