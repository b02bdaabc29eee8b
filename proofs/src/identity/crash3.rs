//! The assumptions of CRASH3, and the conditions under which they hold.

use planar_impact::crash3::{Damaged, DamagedPair, Surface};
use planar_impact::{Field, ForwardLeft, Vehicle};

use super::scene::{Scene, each_vehicle};
use super::{Identity, identity};
use crate::equation::Equations;
use crate::free::Free;

pub(super) fn all() -> Vec<Identity> {
    vec![
        identity!(equivalent_mass, "γ m is what yields along the force", "Σ 1/(γ m) P·P = P·K P, γ = k²/(k² + h²), for any impulse P"),
        identity!(whole_loss, "at common velocity T_L gives the impulse", "e = 0, μ = μ0: P·P Σ 1/(γ m) = 2 T_L"),
        identity!(
            tangential_factor,
            "the tangential factor is that of points",
            "r = 0, e = 0, μ = μ0: W_t = μ² W_n, so T_L = (1 + tan² α) E_C"
        ),
    ]
}

/// Returns the vehicles of a scene with the direction of force on each, and no crush.
fn damaged<T: Field>(scene: &Scene<T>) -> DamagedPair<T> {
    let mut sides = scene.sides().into_iter();
    let mut next = || {
        let side = sides.next()?;
        Some(Damaged::of(side.vehicle, Surface::Front, side.response.force_direction(), T::int(0)))
    };
    DamagedPair { one: next(), two: next() }
}

fn equivalent_mass<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let mut must = Equations::new();
    for collision in free.collisions() {
        let scene = Scene::by_any_impulse(free, collision);
        let impulse = scene.impact.impulse.clone();
        let yielding = scene.contact.compliance.velocity_change(impulse.clone()).dot(impulse.clone());
        must.equal(damaged(&scene).inverse_effective_mass() * impulse.length_squared(), yielding);
    }
    must
}

fn whole_loss<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let mut must = Equations::new();
    for collision in free.collisions() {
        let scene = Scene::sticking(collision.at_common_velocity());
        let impulse = scene.impact.impulse.clone();
        must.equal(damaged(&scene).inverse_effective_mass() * impulse.length_squared(), T::int(2) * scene.impact.loss());
    }
    must
}

fn tangential_factor<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let mut must = Equations::new();
    for collision in free.collisions() {
        let points = each_vehicle(collision.at_common_velocity(), |vehicle| Vehicle { impact_center: ForwardLeft::zero(), ..vehicle });
        let impact = Scene::sticking(points).impact;
        must.equal(impact.impulse.n.clone().squared() * impact.work.t.clone(), impact.impulse.t.squared() * impact.work.n);
    }
    must
}
