//! The energy balance, the peak of the energy loss, and the conditions for a gain of energy.

use planar_impact::energy::work;
use planar_impact::law::impulse_at_ratio;
use planar_impact::{Collision, Field, Moment, Motion, Nt, Xy};

use super::scene::{Scene, inelastic, kudlich_slibar, with_moment};
use super::{Identity, identity};
use crate::equation::Equations;
use crate::free::Free;

pub(super) fn all() -> Vec<Identity> {
    vec![
        identity!(kinetic, "kinetic energy", "T = Σ ½ m (v_x² + v_y²) + ½ I ω²"),
        identity!(work_energy, "works are the change of kinetic energy", "W_n + W_t = T_after − T_before = −T_L, for any P", "Eqs 1, 5, 6"),
        identity!(moment_work, "the moment is in the account", "W_n + W_t + W_m = T_after − T_before = −T_L, for any P and M"),
        identity!(one_body, "the work on a body is its change of energy", "½ P·(v_C + V_C) = ½ m V² + ½ I Ω² − ½ m v² − ½ I ω²", "Eq 5"),
        identity!(normal_work, "restitution fixes W_n", "W_n = −½ (1 − e) P_n v_n, under both laws at any ratio", "Eq 7"),
        identity!(tangential_work, "the end of sliding fixes W_t", "μ = μ0: W_t = −½ P_t v_t", "Eq 8"),
        identity!(loss, "the loss is a quadratic in the impulse", "T_L(P) = P·v − ½ P·K P", "Eq 1"),
        identity!(peak, "the loss is its peak less a square", "T_L(P) = T_L(P*) − ½ (P − P*)·K (P − P*),  P* = K⁻¹ v"),
        identity!(at_peak, "the peak is at e = 0, μ = μ0", "there P = P*, V = 0 and T_L = ½ v·K⁻¹ v = ½ P*·K P*"),
        identity!(
            moment_peak,
            "with a moment the peak ends all relative motion",
            "T_L(P, M) = T_L(P*, M*) − ½ δ·K₃ δ,  δ = (P − P*, M − M*)"
        ),
        identity!(
            along_restitution,
            "the loss at one e is a quadratic in P_t",
            "T_L = (1 − e²) v_n²/(2 K_nn) + b P_t − det K/(2 K_nn) P_t²,  b = v_t − v_n K_nt/K_nn"
        ),
        identity!(gain, "the loss at the critical ratio", "2 det K T_L = (1 − e²) K_tt v_n² − 2 K_nt v_n v_t + K_nn v_t²"),
        identity!(
            gain_square,
            "the same with its square completed",
            "2 K_nn det K T_L = (K_nn v_t − K_nt v_n)² + (K_nn K_tt − K_nt² − e² K_nn K_tt) v_n²"
        ),
        identity!(bound, "the bound of restitution is where it vanishes", "2 det K T_L = K_tt v_n² (e₀² − e²)"),
        identity!(bound_for_any, "the bound for any approach", "e₀² = 1 − K_nt²/(K_nn K_tt), attained by v = (K_nn, K_nt)"),
        identity!(bound_at_ratio, "the bound at a ratio is where Eq 1 vanishes", "at that e and μ: T_L = 0", "Eq 1"),
        identity!(kudlich_slibar_loss, "Kudlich–Slibar keeps e² of the peak", "T_L = (1 − e²) T_L(P*)"),
    ]
}

fn kinetic<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let mut must = Equations::new();
    for collision in free.collisions() {
        let scene = Scene::by_any_moment(free, collision);
        let (mut before, mut after) = (T::int(0), T::int(0));
        for side in scene.sides() {
            let twice = |motion: &Motion<T>| {
                let Xy { x, y } = motion.velocity.clone();
                let straight = side.vehicle.mass.clone() * (x.clone() * x + y.clone() * y);
                straight + side.vehicle.yaw_inertia.clone() * motion.yaw_rate.clone() * motion.yaw_rate.clone()
            };
            before = before + twice(&side.vehicle.motion);
            after = after + twice(&side.response.after);
        }
        must.equal(T::int(2) * scene.impact.kinetic_energy.before, before);
        must.equal(T::int(2) * scene.impact.kinetic_energy.after, after);
    }
    must
}

fn work_energy<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let mut must = Equations::new();
    for collision in free.collisions() {
        let impact = Scene::by_any_impulse(free, collision).impact;
        let change = impact.kinetic_energy.after.clone() - impact.kinetic_energy.before.clone();
        must.equal(impact.work.n.clone() + impact.work.t.clone(), change.clone());
        must.equal(impact.work.m.clone(), T::int(0));
        must.equal(impact.moment.clone(), T::int(0));
        must.equal(impact.loss(), -change);
    }
    must
}

fn moment_work<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let mut must = Equations::new();
    for collision in free.collisions() {
        let scene = Scene::by_any_moment(free, collision);
        let impact = &scene.impact;
        let change = impact.kinetic_energy.after.clone() - impact.kinetic_energy.before.clone();
        must.equal(impact.work.n.clone() + impact.work.t.clone() + impact.work.m.clone(), change.clone());
        must.equal(impact.loss(), -change);
        let relative = impact.two.after.yaw_rate.clone() - impact.one.after.yaw_rate.clone();
        must.equal(impact.work.m.clone(), -(impact.moment.clone() * (scene.contact.relative_yaw_rate() + relative)).half());
    }
    must
}

fn one_body<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let mut must = Equations::new();
    let collision = free.collision();
    let scene = Scene::by_any_impulse(free, collision);
    let before = [scene.contact.one.clone(), scene.contact.two.clone()];
    for ((side, before), after) in scene.sides().into_iter().zip(before).zip(scene.bodies_after()) {
        let impulse = scene.impact.impulse.clone() * side.sign;
        let of_body =
            |part: fn(Nt<T>) -> T| -work(part(impulse.clone()), part(before.velocity_at_center()), part(after.velocity_at_center()));
        let gained = side.vehicle.kinetic_energy(side.response.after.clone()) - side.vehicle.kinetic_energy(side.vehicle.motion.clone());
        must.equal(of_body(|v| v.n) + of_body(|v| v.t), gained);
    }
    must
}

fn normal_work<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let mut must = Equations::new();
    for brach in free.collisions() {
        let ratio = free.variable();
        for collision in [brach.clone(), kudlich_slibar(brach)] {
            for Scene { contact, impact, .. } in [Scene::sticking(collision.clone()), Scene::at_ratio(collision.clone(), ratio.clone())] {
                let kept = T::int(1) - collision.restitution.clone();
                must.equal(impact.work.n, -(kept * impact.impulse.n * contact.approach.n).half());
            }
        }
    }
    must
}

fn tangential_work<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let mut must = Equations::new();
    for collision in free.collisions() {
        let Scene { contact, impact, .. } = Scene::sticking(collision);
        must.equal(impact.work.t, -(impact.impulse.t * contact.approach.t).half());
    }
    must
}

fn loss<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let mut must = Equations::new();
    for collision in free.collisions() {
        let Scene { contact, impact, .. } = Scene::by_any_impulse(free, collision);
        let p = impact.impulse.clone();
        let quadratic = p.clone().dot(contact.approach.clone()) - p.clone().dot(contact.compliance.velocity_change(p.clone())).half();
        must.equal(contact.loss(p), quadratic.clone());
        must.equal(impact.loss(), quadratic);
    }
    must
}

fn peak<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let (contact, p) = (free.contact(), free.nt());
    let at_peak = contact.common_velocity_impulse();
    let from_peak = p.clone() - at_peak.clone();
    let square = from_peak.clone().dot(contact.compliance.velocity_change(from_peak)).half();
    let mut must = Equations::new();
    must.equal(contact.loss(p.clone()), contact.greatest_loss() - square.clone());
    must.equal(contact.loss(p), contact.loss(at_peak) - square);
    must
}

fn at_peak<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let mut must = Equations::new();
    for collision in free.collisions().map(inelastic) {
        let Scene { contact, impact, .. } = Scene::sticking(collision);
        let at_peak = contact.common_velocity_impulse();
        must.equal(impact.impulse.clone(), at_peak.clone());
        must.equal(contact.compliance.velocity_change(at_peak.clone()), contact.approach.clone());
        must.equal(impact.separation.clone(), Nt::zero());
        must.equal(impact.loss(), contact.greatest_loss());
        must.equal(contact.greatest_loss(), contact.approach.clone().dot(at_peak.clone()).half());
        must.equal(contact.greatest_loss(), at_peak.clone().dot(contact.compliance.velocity_change(at_peak)).half());
    }
    must
}

fn moment_peak<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let mut must = Equations::new();
    for collision in free.collisions().map(inelastic) {
        let peak = Scene::sticking(with_moment(collision.clone(), Moment::OfCritical(T::int(1))));
        let any = Scene::by_any_moment(free, collision);
        let p = any.impact.impulse.clone() - peak.impact.impulse.clone();
        let m = any.impact.moment.clone() - peak.impact.moment.clone();
        let row = peak.contact.moment_compliance();
        let mixed = T::int(2) * m.clone() * row.force.dot(p.clone());
        let square = p.clone().dot(peak.contact.compliance.velocity_change(p)) + mixed + row.moment * m.squared();
        must.equal(any.impact.loss(), peak.impact.loss() - square.half());
    }
    must
}

fn along_restitution<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let (contact, e, ratio) = (free.contact(), free.variable(), free.variable());
    let (k, v) = (&contact.compliance, contact.approach.clone());
    let p = impulse_at_ratio(k, (T::int(1) + e.clone()) * v.n.clone(), ratio);
    let base = (T::int(1) - e.squared()) * v.n.clone().squared() / (T::int(2) * k.nn().clone());
    let slope = v.t - v.n * k.nt().clone() / k.nn().clone();
    let curvature = k.determinant().clone() / (T::int(2) * k.nn().clone());
    let mut must = Equations::new();
    must.equal(contact.loss(p.clone()), base + slope * p.t.clone() - curvature * p.t.squared());
    must
}

fn gain<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let mut must = Equations::new();
    for collision in free.collisions() {
        let Scene { collision, contact, impact } = Scene::sticking(collision);
        let (k, v) = (&contact.compliance, contact.approach.clone());
        let kept = T::int(1) - collision.restitution.squared();
        let form =
            kept * k.tt().clone() * v.n.clone().squared() - T::int(2) * k.nt().clone() * v.n * v.t.clone() + k.nn().clone() * v.t.squared();
        must.equal(T::int(2) * k.determinant().clone() * impact.loss(), form);
    }
    must
}

fn gain_square<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let mut must = Equations::new();
    for collision in free.collisions() {
        let Scene { collision, contact, impact } = Scene::sticking(collision);
        let (k, v) = (&contact.compliance, contact.approach.clone());
        let square = (k.nn().clone() * v.t - k.nt().clone() * v.n.clone()).squared();
        let both = k.nn().clone() * k.tt().clone();
        let room = both.clone() - k.nt().clone().squared() - collision.restitution.squared() * both;
        must.equal(T::int(2) * k.nn().clone() * k.determinant().clone() * impact.loss(), square + room * v.n.squared());
    }
    must
}

fn bound<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let mut must = Equations::new();
    for collision in free.collisions() {
        let Scene { collision, contact, impact } = Scene::sticking(collision);
        let k = &contact.compliance;
        let room = contact.critical_restitution_bound_squared() - collision.restitution.squared();
        let expected = k.tt().clone() * contact.approach.n.clone().squared() * room;
        must.equal(T::int(2) * k.determinant().clone() * impact.loss(), expected);
    }
    must
}

fn bound_for_any<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let mut contact = free.contact();
    let k = contact.compliance.clone();
    let bound = contact.restitution_bound_for_any_approach_squared();
    let mut must = Equations::new();
    must.equal(bound.clone(), T::int(1) - k.nt().clone().squared() / (k.nn().clone() * k.tt().clone()));
    contact.approach = Nt { n: k.nn().clone(), t: k.nt().clone() };
    must.equal(contact.critical_restitution_bound_squared(), bound);
    must
}

fn bound_at_ratio<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let mut must = Equations::new();
    for collision in free.collisions() {
        let ratio = free.variable();
        let restitution = collision.contact().restitution_bound_at_ratio(ratio.clone());
        must.equal(Scene::at_ratio(Collision { restitution, ..collision }, ratio).impact.loss(), T::int(0));
    }
    must
}

fn kudlich_slibar_loss<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let mut must = Equations::new();
    for collision in free.collisions() {
        let Scene { collision, contact, impact } = Scene::sticking(kudlich_slibar(collision));
        must.equal(impact.loss(), (T::int(1) - collision.restitution.squared()) * contact.greatest_loss());
    }
    must
}
