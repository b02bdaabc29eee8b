//! Special cases in which the planar impact becomes a simpler one.

use planar_impact::{Body, Collision, Contact, Field, ForwardLeft, Motion, Nt, Vehicle, Work};

use super::scene::{Scene, each_vehicle};
use super::{Identity, identity};
use crate::equation::Equations;
use crate::free::Free;

pub(super) fn all() -> Vec<Identity> {
    vec![
        identity!(
            point_masses,
            "without arms they are point masses",
            "r = 0: P_n = m̄ (1 + e) v_n, P_t = m̄ v_t, T_L = ½ m̄ ((1 − e²) v_n² + v_t²), Ω = ω"
        ),
        identity!(no_loss, "without friction and with e = 1 nothing is lost", "μ = 0, e = 1: T_L = 0"),
        identity!(barrier_body, "a barrier is a body of infinite mass", "1/m = 1/I = 0 at rest, whatever its arm: the same v and K"),
        identity!(barrier_loss, "against a barrier the loss is that of vehicle 1", "T_L = ½ m v² + ½ I ω² − ½ m V² − ½ I Ω²"),
        identity!(
            moving_barrier,
            "against a moving barrier it is so in its frame",
            "T_L by the velocities of vehicle 1 less that of the barrier"
        ),
        identity!(
            no_coupling,
            "without coupling each work has its own cause",
            "K_nt = 0, μ = μ0: W_t = −v_t²/(2 K_tt), W_n = −(1 − e²) v_n²/(2 K_nn)"
        ),
    ]
}

fn point_masses<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let collision = each_vehicle(free.collision(), |vehicle| Vehicle { impact_center: ForwardLeft::zero(), ..vehicle });
    let Scene { collision, contact, impact } = Scene::sticking(collision);
    let [m1, m2] = collision.parties().map(|party| party.vehicle().expect("a vehicle").mass.clone());
    let m_bar = m1.clone() * m2.clone() / (m1 + m2);
    let (e, v) = (collision.restitution, contact.approach);
    let mut must = Equations::new();
    must.equal(impact.impulse.n.clone(), m_bar.clone() * (T::int(1) + e.clone()) * v.n.clone());
    must.equal(impact.impulse.t.clone(), m_bar.clone() * v.t.clone());
    let kept = (T::int(1) - e.squared()) * v.n.squared() + v.t.squared();
    must.equal(impact.loss(), (m_bar * kept).half());
    must.equal(impact.one.after.yaw_rate, contact.one.yaw_rate);
    must.equal(impact.two.after.yaw_rate, contact.two.yaw_rate);
    must
}

fn no_loss<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let mut must = Equations::new();
    for collision in free.collisions() {
        let elastic = Collision { restitution: T::int(1), ..collision };
        must.equal(Scene::at_ratio(elastic, T::int(0)).impact.loss(), T::int(0));
    }
    must
}

fn barrier_body<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let (one, arm, p) = (free.body(), free.nt(), free.nt());
    let zero = T::int(0);
    let heavy = Body {
        inverse_mass: zero.clone(),
        inverse_yaw_inertia: zero.clone(),
        arm,
        velocity: Nt { n: zero.clone(), t: zero.clone() },
        yaw_rate: zero,
    };
    let (here, there) = (Contact::between(one.clone(), Body::fixed()), Contact::between(one, heavy));
    let mut must = Equations::new();
    must.equal(here.approach.clone(), there.approach.clone());
    must.equal(here.compliance.velocity_change(p.clone()), there.compliance.velocity_change(p.clone()));
    must.equal(here.compliance.determinant().clone(), there.compliance.determinant().clone());
    must.equal(here.loss(p.clone()), there.loss(p));
    must.equal(here.offset(), here.one.arm.clone());
    must
}

fn barrier_loss<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let collision = free.barrier_collision();
    let scene = Scene::by_any_moment(free, collision);
    let mut must = Equations::new();
    for side in scene.sides() {
        let energy = |motion: &Motion<T>| side.vehicle.kinetic_energy(motion.clone());
        must.equal(scene.impact.loss(), energy(&side.vehicle.motion) - energy(&side.response.after));
    }
    must
}

fn moving_barrier<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let (one, wall, p) = (free.body(), free.nt(), free.nt());
    let moving = Body { velocity: wall.clone(), arm: free.nt(), ..Body::fixed() };
    let energy = |velocity: Nt<T>, yaw_rate: T| {
        let straight = (velocity - wall.clone()).length_squared() / one.inverse_mass.clone();
        (straight + yaw_rate.squared() / one.inverse_yaw_inertia.clone()).half()
    };
    let before = energy(one.velocity.clone(), one.yaw_rate.clone());
    let after = energy(one.velocity.clone() + one.delta_v(p.clone()), one.yaw_rate.clone() + one.delta_yaw_rate(p.clone()));
    let mut must = Equations::new();
    must.equal(Contact::between(one.clone(), moving).loss(p), before - after);
    must
}

fn no_coupling<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let (one, mut two, e) = (free.body(), free.body(), free.variable());
    // The arm of body two for which K_nt is zero.
    let product = one.inverse_yaw_inertia.clone() * one.arm.n.clone() * one.arm.t.clone();
    two.arm.t = -(product / (two.inverse_yaw_inertia.clone() * two.arm.n.clone()));
    let contact = Contact::between(one, two);
    let (k, v) = (&contact.compliance, contact.approach.clone());
    let impulse = k.impulse_for(Nt { n: (T::int(1) + e.clone()) * v.n.clone(), t: v.t.clone() });
    let work = Work::of(impulse.clone(), v.clone(), contact.separation(impulse));
    let mut must = Equations::new();
    must.equal(k.nt().clone(), T::int(0));
    must.equal(work.t, -(v.t.squared() / k.tt().clone()).half());
    must.equal(work.n, -((T::int(1) - e.squared()) * v.n.squared() / k.nn().clone()).half());
    must
}
