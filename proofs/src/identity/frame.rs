//! Frames and rotations between them, with angles given by half-angle tangents.

use planar_impact::{CrushPlane, Field, ForwardLeft, Heading, Nt, Xy};

use super::{Identity, identity};
use crate::equation::Equations;
use crate::free::Free;

pub(super) fn all() -> Vec<Identity> {
    vec![
        identity!(unit_length, "a half-tangent gives a direction", "cos² + sin² = 1,  sin = h (1 + cos)"),
        identity!(two_turns, "directions turn like angles", "h = (h₁ + h₂)/(1 − h₁ h₂) is one turn after the other"),
        identity!(vectors, "vectors add, and multiply in two ways", "(a·b)² + (a×b)² = |a|² |b|²,  a×b = (a turned by 90°)·b"),
        identity!(vehicle_axes, "a vehicle's axes", "forward = (cos θ, sin θ), left = (−sin θ, cos θ)"),
        identity!(contact_axes, "n-t are x-y turned by Γ", "P_n = P_x cos Γ + P_y sin Γ,  P_t = −P_x sin Γ + P_y cos Γ", "A24, A25"),
        identity!(back, "a turn and its reverse cancel", "to the ground and back, for vehicles and contact, either way"),
        identity!(products_turn, "turns keep lengths and angles", "a·b and a×b are the same in every frame"),
    ]
}

fn unit_length<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let h = free.variable();
    let mut must = Equations::new();
    let CrushPlane { cos, sin } = CrushPlane::from_half_tangent(h.clone());
    must.equal(cos.clone().squared() + sin.clone().squared(), T::int(1));
    must.equal(h.clone() * (T::int(1) + cos), sin);
    let Heading { cos, sin } = Heading::from_half_tangent(h.clone());
    must.equal(cos.clone().squared() + sin.clone().squared(), T::int(1));
    must.equal(h * (T::int(1) + cos), sin);
    must
}

fn two_turns<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let (h1, h2) = (free.variable(), free.variable());
    let (first, second) = (Heading::from_half_tangent(h1.clone()), Heading::from_half_tangent(h2.clone()));
    let both = Heading::from_half_tangent((h1.clone() + h2.clone()) / (T::int(1) - h1 * h2));
    let mut must = Equations::new();
    let turned = first.to_ground(ForwardLeft { forward: second.cos, left: second.sin });
    must.equal(turned, Xy { x: both.cos, y: both.sin });
    must
}

fn vectors<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let (a, b, factor) = (free.nt(), free.nt(), free.variable());
    let mut must = Equations::new();
    must.equal(a.clone() + b.clone(), Nt { n: a.n.clone() + b.n.clone(), t: a.t.clone() + b.t.clone() });
    must.equal(a.clone() - b.clone(), Nt { n: a.n.clone() - b.n.clone(), t: a.t.clone() - b.t.clone() });
    must.equal(-a.clone(), Nt { n: -a.n.clone(), t: -a.t.clone() });
    must.equal(a.clone() * factor.clone(), Nt { n: factor.clone() * a.n.clone(), t: factor * a.t.clone() });
    must.equal(a.clone() + Nt::zero(), a.clone());
    must.equal(a.clone().length_squared(), a.clone().dot(a.clone()));
    must.equal(a.clone().dot(b.clone()), a.n.clone() * b.n.clone() + a.t.clone() * b.t.clone());
    must.equal(Nt { n: T::int(1), t: T::int(0) }.quarter_turn(), Nt { n: T::int(0), t: T::int(1) });
    must.equal(a.clone().quarter_turn().quarter_turn(), -a.clone());
    must.equal(a.clone().quarter_turn().dot(b.clone()), a.clone().cross(b.clone()));
    let products = a.clone().dot(b.clone()).squared() + a.clone().cross(b.clone()).squared();
    must.equal(products, a.length_squared() * b.length_squared());
    must
}

fn vehicle_axes<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let (heading, v) = (free.heading(), free.forward_left());
    let forward = Xy { x: heading.cos.clone(), y: heading.sin.clone() };
    let left = Xy { x: -heading.sin.clone(), y: heading.cos.clone() };
    let mut must = Equations::new();
    let ground = heading.to_ground(v.clone());
    must.equal(ground.clone(), forward.clone() * v.forward.clone() + left.clone() * v.left);
    must.equal(heading.to_vehicle(ground.clone()), ForwardLeft { forward: ground.clone().dot(forward), left: ground.dot(left) });
    must
}

fn contact_axes<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let (plane, p) = (free.crush_plane(), free.xy());
    let CrushPlane { cos, sin } = plane.clone();
    let mut must = Equations::new();
    let contact = plane.to_contact(p.clone());
    must.equal(contact.n.clone(), p.x.clone() * cos.clone() + p.y.clone() * sin.clone());
    must.equal(contact.t.clone(), -(p.x * sin.clone()) + p.y * cos.clone());
    let (n, t) = (Xy { x: cos.clone(), y: sin.clone() }, Xy { x: -sin, y: cos });
    must.equal(plane.to_ground(contact.clone()), n * contact.n + t * contact.t);
    must
}

fn back<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let (heading, plane) = (free.heading(), free.crush_plane());
    let (ground, vehicle, contact) = (free.xy(), free.forward_left(), free.nt());
    let mut must = Equations::new();
    must.equal(heading.to_ground(heading.to_vehicle(ground.clone())), ground.clone());
    must.equal(heading.to_vehicle(heading.to_ground(vehicle.clone())), vehicle);
    must.equal(plane.to_ground(plane.to_contact(ground.clone())), ground);
    must.equal(plane.to_contact(plane.to_ground(contact.clone())), contact);
    must
}

fn products_turn<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let (heading, plane, a, b) = (free.heading(), free.crush_plane(), free.xy(), free.xy());
    let mut must = Equations::new();
    let (dot, cross) = (a.clone().dot(b.clone()), a.clone().cross(b.clone()));
    let turned = [plane.to_contact(a.clone()), plane.to_contact(b.clone())];
    let [ta, tb] = turned;
    must.equal(ta.clone().dot(tb.clone()), dot.clone());
    must.equal(ta.cross(tb), cross.clone());
    let (va, vb) = (heading.to_vehicle(a), heading.to_vehicle(b));
    must.equal(va.clone().dot(vb.clone()), dot);
    must.equal(va.cross(vb), cross);
    must
}
