//! The contact of two bodies: relative velocities, and the compliance K.

use planar_impact::{Body, Collision, Compliance, Contact, CrushPlane, Field, Motion, Nt, Party, Vehicle, Xy};

use super::scene::Scene;
use super::{Identity, identity};
use crate::equation::Equations;
use crate::free::Free;

pub(super) fn all() -> Vec<Identity> {
    vec![
        identity!(approach, "the approach velocity is that of the motions", "v = v_2C − v_1C with v_C = v + ω × r, in n-t", "A11, A13"),
        identity!(separation, "separation velocity at the impact center", "V = v − K P (− k M) = V_2C − V_1C with V_C = V + Ω × r", "A12"),
        identity!(relative_yaw, "and the relative yaw rate", "Ω_r = ω_r − k·P − K_mm M = Ω_2 − Ω_1"),
        identity!(offset, "r₁ − r₂ joins the centers of mass", "r₁ − r₂ = x₂ − x₁ with x + r = C"),
        identity!(entries, "K by its entries", "K_nn = Σ 1/m + r_t²/I, K_nt = −Σ r_n r_t/I, K_tt = Σ 1/m + r_n²/I", "A28–A30"),
        identity!(third_row, "the third row by its entries", "K_nm = −Σ r_t/I, K_tm = Σ r_n/I, K_mm = Σ 1/I"),
        identity!(yields, "K P is how the two bodies yield to P", "K P = Σ P/m + ((r × P)/I) (r turned by 90°)"),
        identity!(determinant, "det K", "det K = K_nn K_tt − K_nt² = w² + w Σ |r|²/I + (r₁ × r₂)²/(I₁ I₂), w = Σ 1/m"),
        identity!(inverse, "K and its inverse cancel", "K⁻¹ K P = P = K K⁻¹ P"),
        identity!(along_ratio, "K along a ratio", "(K (1, μ))_n = K_nn + μ K_nt", "A14"),
        identity!(squares, "P·K P is a sum of squares", "P·K P = w |P|² + (r₁ × P)²/I₁ + (r₂ × P)²/I₂"),
        identity!(moment_squares, "(P, M)·K₃ (P, M) is a sum of squares", "(P, M)·K₃ (P, M) = w |P|² + Σ (r × P + M)²/I"),
        identity!(turned, "K turns with the crush plane", "trace and determinant are free of Γ; K′ = R K Rᵀ"),
    ]
}

/// Returns the velocity of the impact center on a vehicle, in ground axes.
fn at_center<T: Field>(vehicle: &Vehicle<T>, motion: &Motion<T>) -> Xy<T> {
    let arm = vehicle.heading.to_ground(vehicle.impact_center.clone());
    // ω × r with ω pointing up.
    let around = Xy { x: -(motion.yaw_rate.clone() * arm.y), y: motion.yaw_rate.clone() * arm.x };
    motion.velocity.clone() + around
}

fn approach<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let mut must = Equations::new();
    for collision in free.collisions() {
        let at = |party: &Party<T>| party.vehicle().map_or_else(Xy::zero, |vehicle| at_center(vehicle, &vehicle.motion));
        let relative = at(&collision.two) - at(&collision.one);
        must.equal(collision.contact().approach, collision.crush_plane.to_contact(relative.clone()));
        let CrushPlane { cos, sin } = collision.crush_plane.clone();
        must.equal(collision.contact().approach.n, relative.dot(Xy { x: cos, y: sin }));
    }
    must
}

fn separation<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let mut must = Equations::new();
    for scene in Scene::by_anything(free) {
        let relative =
            scene.sides().into_iter().fold(Xy::zero(), |sum, side| sum - at_center(side.vehicle, &side.response.after) * side.sign);
        must.equal(scene.impact.separation.clone(), scene.collision.crush_plane.to_contact(relative));
        must.equal(scene.impact.approach.clone(), scene.contact.approach.clone());
    }
    must
}

fn relative_yaw<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let mut must = Equations::new();
    for collision in free.collisions() {
        let scene = Scene::by_any_moment(free, collision);
        let row = scene.contact.moment_compliance();
        let after = scene.impact.two.after.yaw_rate.clone() - scene.impact.one.after.yaw_rate.clone();
        let changed = row.force.dot(scene.impact.impulse.clone()) + row.moment * scene.impact.moment.clone();
        must.equal(after, scene.contact.relative_yaw_rate() - changed);
        must.equal(scene.contact.relative_yaw_rate(), scene.contact.two.yaw_rate.clone() - scene.contact.one.yaw_rate.clone());
    }
    must
}

fn offset<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let collision = free.collision();
    let center = free.xy();
    let position = |party: &Party<T>| {
        let vehicle = party.vehicle().expect("a vehicle");
        center.clone() - vehicle.heading.to_ground(vehicle.impact_center.clone())
    };
    let between = position(&collision.two) - position(&collision.one);
    let mut must = Equations::new();
    must.equal(collision.contact().offset(), collision.crush_plane.to_contact(between));
    must
}

fn entries<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let collision = free.collision();
    let contact = collision.contact();
    let [mut nn, mut nt, mut tt] = [T::int(0), T::int(0), T::int(0)];
    for party in collision.parties() {
        let vehicle = party.vehicle().expect("a vehicle");
        let Nt { n, t } = collision.crush_plane.to_contact(vehicle.heading.to_ground(vehicle.impact_center.clone()));
        let (mass, inertia) = (vehicle.mass.clone(), vehicle.yaw_inertia.clone());
        nn = nn + T::int(1) / mass.clone() + t.clone() * t.clone() / inertia.clone();
        nt = nt - n.clone() * t / inertia.clone();
        tt = tt + T::int(1) / mass + n.clone() * n / inertia;
    }
    let mut must = Equations::new();
    must.equal(contact.compliance.nn().clone(), nn);
    must.equal(contact.compliance.nt().clone(), nt);
    must.equal(contact.compliance.tt().clone(), tt);
    must
}

fn third_row<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let Contact { one, two, .. } = free.contact();
    let (j1, j2) = (one.inverse_yaw_inertia.clone(), two.inverse_yaw_inertia.clone());
    let row = Contact::between(one.clone(), two.clone()).moment_compliance();
    let mut must = Equations::new();
    must.equal(row.force.n, -(one.arm.t * j1.clone()) - two.arm.t * j2.clone());
    must.equal(row.force.t, one.arm.n * j1.clone() + two.arm.n * j2.clone());
    must.equal(row.moment, j1 + j2);
    must
}

fn yields<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let Contact { one, two, compliance, .. } = free.contact();
    let p = free.nt();
    let mut must = Equations::new();
    let mut sum = Nt::zero();
    for body in [one, two] {
        let moved = Nt { n: body.inverse_mass.clone() * p.n.clone(), t: body.inverse_mass.clone() * p.t.clone() };
        let spun = (body.arm.n.clone() * p.t.clone() - body.arm.t.clone() * p.n.clone()) * body.inverse_yaw_inertia.clone();
        must.equal(body.delta_v(p.clone()), moved.clone());
        must.equal(body.delta_yaw_rate(p.clone()), spun.clone());
        sum = sum + moved + Nt { n: -(spun.clone() * body.arm.t), t: spun * body.arm.n };
    }
    must.equal(compliance.velocity_change(p), sum);
    must
}

fn determinant<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let Contact { one, two, compliance: k, .. } = free.contact();
    let w = one.inverse_mass.clone() + two.inverse_mass.clone();
    let (j1, j2) = (one.inverse_yaw_inertia, two.inverse_yaw_inertia);
    let across = one.arm.n.clone() * two.arm.t.clone() - one.arm.t.clone() * two.arm.n.clone();
    let arms = j1.clone() * one.arm.length_squared() + j2.clone() * two.arm.length_squared();
    let mut must = Equations::new();
    must.equal(k.determinant().clone(), k.nn().clone() * k.tt().clone() - k.nt().clone() * k.nt().clone());
    must.equal(k.determinant().clone(), w.clone() * w.clone() + w * arms + j1 * j2 * across.clone() * across);
    must
}

fn inverse<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let (contact, p) = (free.contact(), free.nt());
    let k = contact.compliance;
    let mut must = Equations::new();
    must.equal(k.impulse_for(k.velocity_change(p.clone())), p.clone());
    must.equal(k.velocity_change(k.impulse_for(p.clone())), p);
    must
}

fn along_ratio<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let (contact, ratio) = (free.contact(), free.variable());
    let k = contact.compliance;
    let mut must = Equations::new();
    must.equal(k.along_ratio(ratio.clone()), k.velocity_change(Nt { n: T::int(1), t: ratio.clone() }).n);
    must.equal(k.along_ratio(ratio.clone()), k.nn().clone() + ratio * k.nt().clone());
    must
}

fn squares<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let (Contact { one, two, compliance, .. }, p) = (free.contact(), free.nt());
    let mut must = Equations::new();
    let straight = (one.inverse_mass.clone() + two.inverse_mass.clone()) * p.clone().length_squared();
    let around = |body: Body<T>| body.inverse_yaw_inertia * body.arm.cross(p.clone()).squared();
    must.equal(p.clone().dot(compliance.velocity_change(p.clone())), straight + around(one) + around(two));
    must
}

fn moment_squares<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let (contact, p, m) = (free.contact(), free.nt(), free.variable());
    let row = contact.moment_compliance();
    let mixed = T::int(2) * m.clone() * row.force.dot(p.clone());
    let form = p.clone().dot(contact.compliance.velocity_change(p.clone())) + mixed + row.moment * m.clone().squared();
    let straight = (contact.one.inverse_mass.clone() + contact.two.inverse_mass.clone()) * p.clone().length_squared();
    let around = |body: Body<T>| body.inverse_yaw_inertia * (body.arm.cross(p.clone()) + m.clone()).squared();
    let mut must = Equations::new();
    must.equal(form, straight + around(contact.one) + around(contact.two));
    must
}

fn turned<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let collision = free.collision();
    let other = free.crush_plane();
    let p = free.xy();
    let here = collision.contact().compliance;
    let there = Collision { crush_plane: other.clone(), ..collision.clone() }.contact().compliance;
    let trace = |k: &Compliance<T>| k.nn().clone() + k.tt().clone();
    let on_ground = |k: &Compliance<T>, plane: &CrushPlane<T>| plane.to_ground(k.velocity_change(plane.to_contact(p.clone())));
    let mut must = Equations::new();
    must.equal(trace(&here), trace(&there));
    must.equal(here.determinant().clone(), there.determinant().clone());
    must.equal(on_ground(&here, &collision.crush_plane), on_ground(&there, &other));
    must
}
