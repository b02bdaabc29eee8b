//! Comparisons and selections of the code, which a field does not have: tested at random fractions instead.

use planar_impact::law::impulse_at_fraction;
use planar_impact::{Collision, Field, ImpulseRatio, Law, Moment, Vehicle};
use rand::SeedableRng;
use rand::rngs::ChaCha20Rng;

use crate::equation::Equations;
use crate::free::Free;
use crate::identity::Form;
use crate::identity::scene::{Scene, each_vehicle, with_moment};
use crate::proof::{Trial, Verdict, fraction};
use crate::scalar::Rational;

/// Number of points at which a choice is tested.
const POINTS: u64 = 20;

/// A required choice of [`Collision::evaluate`], tested and not proven.
#[derive(Clone, Copy, Debug)]
pub struct Choice {
    /// The required choice.
    pub name: &'static str,
    /// The same in symbols.
    pub statement: &'static str,
    /// Number of points at which it was tested.
    pub points: u64,
    /// The verdict.
    pub verdict: Verdict,
}

impl Choice {
    /// Returns `true` if the code made this choice at every point.
    pub fn holds(&self) -> bool {
        self.verdict == Verdict::Holds
    }
}

/// A choice before its test.
struct Case {
    name: &'static str,
    statement: &'static str,
    form: Form<Rational>,
}

const CASES: [Case; 4] = [
    Case {
        name: "the critical ratio takes the sticking impulse",
        statement: "evaluate() has the impulse and the moment of the identities above, under both laws, with and without a moment",
        form: critical,
    },
    Case { name: "a given ratio takes the impulse at that ratio", statement: "the same, at any μ", form: given },
    Case { name: "a fraction takes that of the critical ratio", statement: "the same, at f μ0", form: of_critical },
    Case {
        name: "a friction limit sticks or slides",
        statement: "|P_t| ≤ f |P_n|, P_n v_n > 0, V_n = −e v_n; sticks where that pushes within the cone, or else slides on the cone's edge on the side \
                    of the sticking impulse",
        form: limited,
    },
];

/// Tests all choices.
pub(crate) fn all(seed: u64) -> Vec<Choice> {
    let mut rng = ChaCha20Rng::seed_from_u64(seed);
    rng.set_stream(u64::MAX);
    let trial = Trial { points: POINTS, redraws: 10 * POINTS };
    let mut tried =
        |Case { name, statement, form }| Choice { name, statement, points: POINTS, verdict: trial.verdict(form, || fraction(&mut rng)) };
    CASES.into_iter().map(&mut tried).collect()
}

/// Returns collisions of each kind under each law, without a moment impulse, with a given one and with a fraction of the critical one.
fn collisions(free: &mut Free<'_, Rational>) -> Vec<Collision<Rational>> {
    let mut all = Vec::new();
    for collision in free.collisions() {
        for law in [Law::Brach, Law::KudlichSlibar] {
            for moment in [Moment::None, Moment::Given(free.variable()), Moment::OfCritical(free.variable())] {
                all.push(Collision { law, ..with_moment(collision.clone(), moment) });
            }
        }
    }
    all
}

fn critical(free: &mut Free<'_, Rational>) -> Equations<Rational> {
    let mut must = Equations::new();
    for collision in collisions(free) {
        let (chosen, sticking) = (collision.evaluate(), Scene::sticking(collision).impact);
        must.equal(chosen.impulse, sticking.impulse);
        must.equal(chosen.moment, sticking.moment);
    }
    must
}

fn given(free: &mut Free<'_, Rational>) -> Equations<Rational> {
    let mut must = Equations::new();
    for collision in collisions(free) {
        let ratio = free.variable();
        let chosen = Collision { impulse_ratio: ImpulseRatio::Given(ratio.clone()), ..collision.clone() }.evaluate();
        let at_ratio = Scene::at_ratio(collision, ratio).impact;
        must.equal(chosen.impulse, at_ratio.impulse);
        must.equal(chosen.moment, at_ratio.moment);
    }
    must
}

fn of_critical(free: &mut Free<'_, Rational>) -> Equations<Rational> {
    let mut must = Equations::new();
    for collision in collisions(free) {
        let fraction = free.variable();
        let contact = collision.contact();
        let moment = collision.moment_impulse(&contact);
        let change = collision.sticking_change(&contact, moment.as_ref());
        let chosen = Collision { impulse_ratio: ImpulseRatio::OfCritical(fraction.clone()), ..collision }.evaluate();
        must.equal(chosen.impulse, impulse_at_fraction(&contact.compliance, change, fraction));
    }
    must
}

fn limited(free: &mut Free<'_, Rational>) -> Equations<Rational> {
    let mut must = Equations::new();
    let (zero, one) = (Rational::int(0), Rational::int(1));
    for collision in free.collisions() {
        // Squares, for quantities that must not be negative.
        let positive = each_vehicle(collision, |vehicle| Vehicle {
            mass: vehicle.mass.squared(),
            yaw_inertia: vehicle.yaw_inertia.squared(),
            ..vehicle
        });
        let friction = free.variable().squared();
        for law in [Law::Brach, Law::KudlichSlibar] {
            let collision = Collision { law, restitution: positive.restitution.clone().squared(), ..positive.clone() };
            let sticking = Scene::sticking(collision.clone()).impact.impulse;
            let limited = Collision { impulse_ratio: ImpulseRatio::LimitedByFriction(friction.clone()), ..collision.clone() }.evaluate();
            let (p, v) = (limited.impulse, limited.approach.clone());
            let edge = |n: Rational| (friction.clone() * n).squared();
            let within = sticking.t.clone().squared() <= edge(sticking.n.clone());
            let pushes = sticking.n.clone() * v.n.clone() > zero;
            let on_edge = p.t.clone().squared() == edge(p.n.clone());
            let same_side = p.t.clone() * sticking.t.clone() * v.n.clone() * v.n.clone() >= zero;
            let as_it_must = if within && pushes { p == sticking } else { on_edge && same_side };
            let pushed = p.n.clone() * v.n.clone() > zero || v.n == zero;
            must.equal(limited.separation.n, -(collision.restitution * v.n));
            must.equal(Rational::int(i32::from(as_it_must)), one.clone());
            must.equal(Rational::int(i32::from(pushed)), one.clone());
        }
    }
    must
}
