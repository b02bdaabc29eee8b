//! Derivatives in closed form, compared with those of the code by dual numbers over the field.

use planar_impact::law::impulse_at_ratio;
use planar_impact::paper::PaperNotation;
use planar_impact::{Collision, Contact, CrushPlane, Field, Nt, Work};

use super::scene::{Scene, inelastic};
use super::{Identity, identity};
use crate::equation::Equations;
use crate::free::Free;
use crate::scalar::Dual;

pub(super) fn all() -> Vec<Identity> {
    vec![
        identity!(by_impulse, "derivative of the loss by the impulse", "dT_L/dP = V: the loss is stationary at V = 0"),
        identity!(by_ratio, "the loss by μ", "dT_L/dμ = V·dP/dμ; 0 at e = 0, μ = μ0", "Eq 1"),
        identity!(loss_by_restitution, "the loss by e at μ = μ0", "det K dT_L/de = −e K_tt v_n²", "Eq 1"),
        identity!(tangential_by_restitution, "W_t by e at μ = μ0", "2 det K dW_t/de = K_nt v_n v_t", "Eq 8"),
        identity!(ratio_by_restitution, "μ0 by e", "dμ0/de = −r (A (1 + C) − B²)/((1 + e)(1 + C) + r B)²", "A27"),
        identity!(ratio_by_velocities, "μ0 by r", "dμ0/dr = (1 + e)(A (1 + C) − B²)/((1 + e)(1 + C) + r B)²", "A27"),
        identity!(letters_are_positive, "A (1 + C) − B² has the sign of det K", "A (1 + C) − B² = m̄² det K", "A28–A30"),
        identity!(by_plane, "by Γ at e = 0, μ = μ0", "dT_L/dΓ = dP_x/dΓ = dP_y/dΓ = dV/dΓ = dΩ/dΓ = 0"),
        identity!(work_by_plane, "W_n and W_t by Γ there", "dW_n/dΓ = −½ (P_t v_n + P_n v_t) = −dW_t/dΓ"),
        identity!(
            work_by_plane_any,
            "W_n by Γ at any e, μ = μ0",
            "det K dW_n/dΓ = −½ (1 − e)(det K (P_n v_t + P_t v_n) + e v_n (K_tt v_t − K_nt v_n))"
        ),
    ]
}

type D<T> = Dual<T>;

fn constant<T: Field>(value: T) -> D<T> {
    Dual::constant(value)
}

/// Returns a contact in which nothing varies.
fn constant_contact<T: Field>(contact: &Contact<T>) -> Contact<D<T>> {
    Contact::between(contact.one.clone().map(constant), contact.two.clone().map(constant))
}

/// Returns the sticking impulse of a contact and its work, for a varying restitution.
fn by_restitution<T: Field>(contact: &Contact<T>, e: T) -> (Nt<D<T>>, Work<D<T>>) {
    let dual = constant_contact(contact);
    let v = dual.approach.clone();
    let impulse = dual.compliance.impulse_for(Nt { n: (D::int(1) + Dual::variable(e)) * v.n.clone(), t: v.t.clone() });
    (impulse.clone(), Work::of(impulse.clone(), v, dual.separation(impulse)))
}

/// Returns a collision with a turning crush plane: the derivative of (cos Γ, sin Γ) is (−sin Γ, cos Γ).
fn turning<T: Field>(collision: Collision<T>) -> Collision<D<T>> {
    let CrushPlane { cos, sin } = collision.crush_plane.clone();
    let crush_plane = CrushPlane { cos: Dual { re: cos.clone(), eps: -sin.clone() }, sin: Dual { re: sin, eps: cos } };
    Collision { crush_plane, ..collision.map(constant) }
}

fn by_impulse<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let (contact, p, direction) = (free.contact(), free.nt(), free.nt());
    let moving = Nt { n: Dual { re: p.n.clone(), eps: direction.n.clone() }, t: Dual { re: p.t.clone(), eps: direction.t.clone() } };
    let mut must = Equations::new();
    must.equal(constant_contact(&contact).loss(moving).eps, contact.separation(p).dot(direction));
    must
}

fn by_ratio<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let (contact, e, ratio) = (free.contact(), free.variable(), free.variable());
    let dual = constant_contact(&contact);
    let at = |e: T, ratio: T| {
        let change = constant((T::int(1) + e) * contact.approach.n.clone());
        impulse_at_ratio(&dual.compliance, change, Dual::variable(ratio))
    };
    let mut must = Equations::new();
    let p = at(e, ratio);
    let slope = p.clone().map(|component| component.eps);
    let separation = contact.separation(p.clone().map(|component| component.re));
    must.equal(dual.loss(p).eps, separation.dot(slope));
    let peak = contact.common_velocity_impulse();
    must.equal(dual.loss(at(T::int(0), peak.t / peak.n)).eps, T::int(0));
    must
}

fn loss_by_restitution<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let (contact, e) = (free.contact(), free.variable());
    let (_, work) = by_restitution(&contact, e.clone());
    let k = &contact.compliance;
    let mut must = Equations::new();
    must.equal(k.determinant().clone() * work.loss().eps, -(e * k.tt().clone() * contact.approach.n.squared()));
    must
}

fn tangential_by_restitution<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let (contact, e) = (free.contact(), free.variable());
    let (_, work) = by_restitution(&contact, e);
    let (k, v) = (&contact.compliance, contact.approach.clone());
    let mut must = Equations::new();
    must.equal(T::int(2) * k.determinant().clone() * work.t.eps, k.nt().clone() * v.n * v.t);
    must
}

/// A (1 + C) − B² and (1 + e)(1 + C) + r B of the paper.
struct Critical<T> {
    minor: T,
    denominator: T,
}

impl<T: Field> Critical<T> {
    fn of(letters: &PaperNotation<T>) -> Self {
        let (a, b, c) = (letters.a28(), letters.a29(), letters.a30());
        let one = T::int(1);
        Critical {
            minor: a * (one.clone() + c.clone()) - b.clone().squared(),
            denominator: (one.clone() + letters.e.clone()) * (one + c) + letters.a21() * b,
        }
    }
}

fn ratio_by_restitution<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let (contact, e) = (free.contact(), free.variable());
    let (impulse, _) = by_restitution(&contact, e.clone());
    let letters = PaperNotation::of(&contact.one, &contact.two, e, T::int(0));
    let Critical { minor, denominator } = Critical::of(&letters);
    let mut must = Equations::new();
    must.equal((impulse.t / impulse.n).eps * denominator.squared(), -(letters.a21() * minor));
    must
}

fn ratio_by_velocities<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let (contact, e) = (free.contact(), free.variable());
    let letters = PaperNotation::of(&contact.one, &contact.two, e, T::int(0));
    let Critical { minor, denominator } = Critical::of(&letters);
    // v_2t varies, and r with it: dr/dv_2t = 1/v_m.
    let mut two = contact.two.clone().map(constant);
    two.velocity.t = Dual::variable(contact.two.velocity.t.clone());
    let moving = Contact::between(contact.one.clone().map(constant), two);
    let both = T::int(1) + letters.e.clone();
    let change = Nt { n: constant(both.clone()) * moving.approach.n.clone(), t: moving.approach.t.clone() };
    let impulse = moving.compliance.impulse_for(change);
    let by_r = (impulse.t / impulse.n).eps * letters.a11();
    let mut must = Equations::new();
    must.equal(by_r * denominator.squared(), both * minor);
    must
}

fn letters_are_positive<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let contact = free.contact();
    let letters = PaperNotation::of(&contact.one, &contact.two, T::int(0), T::int(0));
    let mut must = Equations::new();
    must.equal(Critical::of(&letters).minor, letters.m_bar().squared() * contact.compliance.determinant().clone());
    must
}

fn by_plane<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let mut must = Equations::new();
    for collision in free.collisions().map(inelastic) {
        let impact = Scene::sticking(turning(collision)).impact;
        must.equal(impact.loss().eps, T::int(0));
        for response in [impact.one, impact.two] {
            must.equal(response.after.velocity.x.eps, T::int(0));
            must.equal(response.after.velocity.y.eps, T::int(0));
            must.equal(response.after.yaw_rate.eps, T::int(0));
        }
        must.equal(impact.impulse_on_ground.x.eps, T::int(0));
        must.equal(impact.impulse_on_ground.y.eps, T::int(0));
    }
    must
}

fn work_by_plane<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let mut must = Equations::new();
    for collision in free.collisions().map(inelastic) {
        let here = Scene::sticking(collision.clone());
        let (p, v) = (here.impact.impulse, here.contact.approach);
        let slope = -(p.t * v.n + p.n * v.t).half();
        let work = Scene::sticking(turning(collision)).impact.work;
        must.equal(work.n.eps, slope.clone());
        must.equal(work.t.eps, -slope);
    }
    must
}

fn work_by_plane_any<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let mut must = Equations::new();
    for collision in free.collisions() {
        let Scene { contact, impact, .. } = Scene::sticking(collision.clone());
        let (k, v, p, e) = (&contact.compliance, contact.approach.clone(), impact.impulse, collision.restitution.clone());
        let straight = k.determinant().clone() * (p.n * v.t.clone() + p.t * v.n.clone());
        let rebound = e.clone() * v.n.clone() * (k.tt().clone() * v.t - k.nt().clone() * v.n);
        let slope = -((T::int(1) - e) * (straight + rebound)).half();
        must.equal(k.determinant().clone() * Scene::sticking(turning(collision)).impact.work.n.eps, slope);
    }
    must
}
