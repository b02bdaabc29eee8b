//! Momentum, for any impulse and any moment impulse, regardless of the law that determines them.

use planar_impact::{CrushPlane, Field, ForwardLeft, Motion, Nt, Response, Xy};

use super::scene::{Scene, Side};
use super::{Identity, identity};
use crate::equation::Equations;
use crate::free::Free;

pub(super) fn all() -> Vec<Identity> {
    vec![
        identity!(linear, "the impulse is the change of momentum", "m₁ (V₁ − v₁) = P = −m₂ (V₂ − v₂)", "A1–A4, A22, A23"),
        identity!(total_linear, "linear momentum is conserved", "m₁ V₁ + m₂ V₂ = m₁ v₁ + m₂ v₂"),
        identity!(
            about_center,
            "each body keeps its angular momentum about C",
            "I (Ω − ω) − r × m (V − v) = ±M, 0 without a moment",
            "A5, A6"
        ),
        identity!(about_any_point, "angular momentum is conserved about any point", "Σ I Ω + x × m V = Σ I ω + x × m v, M or none"),
        identity!(
            delta_v,
            "ΔV is the change of velocity, in every frame",
            "ΔV = V − v, turned into the vehicle's axes; P_x, P_y from P_n, P_t"
        ),
        identity!(
            force_direction,
            "principal direction of force is opposite to ΔV",
            "its ahead is −ΔV·(cos θ, sin θ), its right ΔV·(−sin θ, cos θ)"
        ),
        identity!(two_impulses, "impulses in succession add up", "P then Q is P + Q: the same motions, and losses that add up"),
        identity!(barrier, "a barrier does not move", "v₂ = V₂ = 0, ω₂ = Ω₂ = 0, ΔV₂ = 0 for any P and M"),
    ]
}

fn linear<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let mut must = Equations::new();
    for scene in Scene::by_anything(free) {
        for side in scene.sides() {
            must.equal(side.momentum_gained(), scene.impact.impulse_on_ground.clone() * side.sign);
        }
    }
    must
}

fn total_linear<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let collision = free.collision();
    let scene = Scene::by_any_moment(free, collision);
    let sum = |motion: fn(&Side<'_, T>) -> Motion<T>| {
        scene.sides().iter().fold(Xy::zero(), |sum, side| sum + motion(side).velocity * side.vehicle.mass.clone())
    };
    let mut must = Equations::new();
    must.equal(sum(|side| side.response.after.clone()), sum(|side| side.vehicle.motion.clone()));
    must
}

fn about_center<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let mut must = Equations::new();
    for scene in Scene::by_anything(free) {
        for side in scene.sides() {
            must.equal(side.angular_momentum_gained(), side.sign * scene.impact.moment.clone());
        }
    }
    must
}

fn about_any_point<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let mut must = Equations::new();
    let collision = free.collision();
    for scene in [Scene::by_any_impulse(free, collision.clone()), Scene::by_any_moment(free, collision)] {
        // The position of the impact center relative to the point.
        let center = free.xy();
        let sum = |motion: fn(&Side<'_, T>) -> Motion<T>| {
            scene.sides().iter().fold(T::int(0), |sum, side| {
                let Motion { velocity, yaw_rate } = motion(side);
                let position = center.clone() - side.arm();
                sum + side.vehicle.yaw_inertia.clone() * yaw_rate + position.cross(velocity * side.vehicle.mass.clone())
            })
        };
        must.equal(sum(|side| side.response.after.clone()), sum(|side| side.vehicle.motion.clone()));
    }
    must
}

fn delta_v<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let mut must = Equations::new();
    for scene in Scene::by_anything(free) {
        let CrushPlane { cos, sin } = scene.collision.crush_plane.clone();
        let (n, t) = (Xy { x: cos.clone(), y: sin.clone() }, Xy { x: -sin, y: cos });
        must.equal(scene.impact.impulse_on_ground.clone(), n * scene.impact.impulse.n.clone() + t * scene.impact.impulse.t.clone());
        for side in scene.sides() {
            let delta_v = side.response.delta_v.clone();
            must.equal(delta_v.clone(), side.response.after.velocity.clone() - side.vehicle.motion.velocity.clone());
            must.equal(side.vehicle.heading.to_ground(side.response.delta_v_in_vehicle.clone()), delta_v);
        }
    }
    must
}

fn force_direction<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let mut must = Equations::new();
    for scene in Scene::by_anything(free) {
        for side in scene.sides() {
            let ahead = Xy { x: side.vehicle.heading.cos.clone(), y: side.vehicle.heading.sin.clone() };
            let origin = side.response.force_direction();
            must.equal(origin.ahead, -ahead.clone().dot(side.response.delta_v.clone()));
            // A force to the left comes from the right.
            must.equal(origin.right, ahead.quarter_turn().dot(side.response.delta_v.clone()));
        }
    }
    must
}

fn two_impulses<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let collision = free.collision();
    let (p, q) = (free.nt(), free.nt());
    let (m, n) = (free.variable(), free.variable());
    let first = Scene::by(collision.clone(), p.clone(), Some(m.clone()));
    let second = Scene::by(first.continued(|motion| motion), q.clone(), Some(n.clone()));
    let at_once = Scene::by(collision, p + q, Some(m + n));
    let mut must = Equations::new();
    must.equal(second.impact.one.after.clone(), at_once.impact.one.after.clone());
    must.equal(second.impact.two.after.clone(), at_once.impact.two.after.clone());
    must.equal(second.impact.separation.clone(), at_once.impact.separation.clone());
    must.equal(first.impact.loss() + second.impact.loss(), at_once.impact.loss());
    must
}

fn barrier<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let collision = free.barrier_collision();
    let scene = Scene::by_any_moment(free, collision);
    let mut must = Equations::new();
    let still = Response { after: Motion::rest(), delta_v: Xy::zero(), delta_v_in_vehicle: ForwardLeft::zero() };
    must.equal(scene.impact.two.clone(), still);
    must.equal(Motion::<T>::rest().velocity, Xy { x: T::int(0), y: T::int(0) });
    must.equal(scene.contact.two.velocity_at_center(), Nt { n: T::int(0), t: T::int(0) });
    must.equal(scene.contact.relative_yaw_rate(), -scene.contact.one.yaw_rate.clone());
    must
}
