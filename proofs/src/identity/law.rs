//! The impulse according to each law of impact.

use planar_impact::law::{impulse_at_fraction, impulse_at_ratio};
use planar_impact::{Field, Moment, Nt};

use super::scene::{Scene, inelastic, kudlich_slibar, with_moment};
use super::{Identity, identity};
use crate::equation::Equations;
use crate::free::Free;

pub(super) fn all() -> Vec<Identity> {
    vec![
        identity!(restitution, "restitution, whichever law and ratio", "V_n = −e v_n", "A7"),
        identity!(ratio, "the impulse has the ratio asked for", "P_t = μ P_n", "A8"),
        identity!(sliding_ends, "Brach: at the critical ratio sliding ends", "μ = μ0 = P_t/P_n:  V_t = 0", "A27"),
        identity!(critical_given, "the critical ratio may be given as a number", "μ = μ0 has the same impulse", "A27"),
        identity!(both_components, "Kudlich–Slibar: restitution of both components", "V = −e v"),
        identity!(fraction, "a fraction of the critical ratio", "P_t/P_n = f μ0 and V_n = −e v_n; f = 1 is the whole"),
        identity!(laws_meet, "the two laws agree at e = 0", "K P = v under both"),
        identity!(reported_ratio, "μ0 is a property of the collision", "reported alike whichever impulse is in force", "A27"),
        identity!(
            given_moment,
            "a given moment leaves the laws as they are",
            "M given: V_n = −e v_n, V_t = 0 at μ0 (Brach), V = −e v (Kudlich–Slibar)"
        ),
        identity!(
            critical_moment,
            "with the critical moment relative rotation ends",
            "M = M0: Ω_r = 0 (Brach), −e ω_r (Kudlich–Slibar), V as without"
        ),
        identity!(moment_fraction, "a fraction of the critical moment", "M = f M0"),
    ]
}

fn restitution<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let mut must = Equations::new();
    for brach in free.collisions() {
        let ratio = free.variable();
        for collision in [brach.clone(), kudlich_slibar(brach)] {
            for scene in [Scene::sticking(collision.clone()), Scene::at_ratio(collision.clone(), ratio.clone())] {
                must.equal(scene.impact.separation.n, -(collision.restitution.clone() * scene.contact.approach.n));
            }
        }
    }
    must
}

fn ratio<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let mut must = Equations::new();
    for collision in free.collisions() {
        let ratio = free.variable();
        let scene = Scene::at_ratio(collision, ratio.clone());
        must.equal(scene.impact.impulse_ratio(), ratio.clone());
        must.equal(scene.impact.impulse.t, ratio * scene.impact.impulse.n);
    }
    must
}

fn sliding_ends<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let mut must = Equations::new();
    for collision in free.collisions() {
        let scene = Scene::sticking(collision);
        must.equal(scene.impact.separation.t.clone(), T::int(0));
        must.equal(scene.impact.critical_impulse.clone(), scene.impact.impulse.clone());
        must.equal(scene.impact.critical_impulse_ratio(), scene.impact.impulse_ratio());
    }
    must
}

fn critical_given<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let mut must = Equations::new();
    for collision in free.collisions() {
        let critical = Scene::sticking(collision.clone()).impact;
        let given = Scene::at_ratio(collision, critical.critical_impulse_ratio()).impact;
        must.equal(given.impulse, critical.impulse);
    }
    must
}

fn both_components<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let mut must = Equations::new();
    for collision in free.collisions() {
        let scene = Scene::sticking(kudlich_slibar(collision));
        must.equal(scene.impact.separation, -(scene.contact.approach * scene.collision.restitution));
    }
    must
}

fn fraction<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let mut must = Equations::new();
    let (contact, change, fraction) = (free.contact(), free.nt(), free.variable());
    let k = &contact.compliance;
    let whole = k.impulse_for(change.clone());
    let part = impulse_at_fraction(k, change.clone(), fraction.clone());
    must.equal(part.t.clone() * whole.n.clone(), fraction * whole.t.clone() * part.n.clone());
    must.equal(k.velocity_change(part).n, change.n.clone());
    must.equal(impulse_at_fraction(k, change.clone(), T::int(1)), whole);
    must.equal(impulse_at_fraction(k, change.clone(), T::int(0)), impulse_at_ratio(k, change.n, T::int(0)));
    must
}

fn laws_meet<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let mut must = Equations::new();
    for collision in free.collisions().map(inelastic) {
        let brach = Scene::sticking(collision.clone());
        let other = Scene::sticking(kudlich_slibar(collision));
        must.equal(brach.impact.impulse.clone(), other.impact.impulse);
        must.equal(brach.contact.compliance.velocity_change(brach.impact.impulse), brach.contact.approach);
    }
    must
}

fn reported_ratio<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let mut must = Equations::new();
    for collision in free.collisions() {
        let any = Scene::by_any_impulse(free, collision.clone());
        let critical = Scene::sticking(collision);
        must.equal(any.impact.critical_impulse.clone(), critical.impact.impulse.clone());
        must.equal(any.impact.critical_impulse_ratio(), critical.impact.impulse_ratio());
    }
    must
}

fn given_moment<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let mut must = Equations::new();
    for collision in free.collisions() {
        let (moment, ratio) = (free.variable(), free.variable());
        let collision = with_moment(collision, Moment::Given(moment.clone()));
        let (e, v) = (collision.restitution.clone(), collision.contact().approach);
        let brach = Scene::sticking(collision.clone());
        must.equal(brach.impact.moment.clone(), moment);
        must.equal(brach.impact.separation.clone(), Nt { n: -(e.clone() * v.n.clone()), t: T::int(0) });
        must.equal(brach.impact.critical_impulse.clone(), brach.impact.impulse.clone());
        let other = Scene::sticking(kudlich_slibar(collision.clone()));
        must.equal(other.impact.separation, -(v.clone() * e.clone()));
        let at_ratio = Scene::at_ratio(collision, ratio.clone());
        must.equal(at_ratio.impact.separation.n, -(e * v.n));
        must.equal(at_ratio.impact.impulse.t, ratio * at_ratio.impact.impulse.n);
    }
    must
}

fn critical_moment<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let mut must = Equations::new();
    for collision in free.collisions() {
        let brach = with_moment(collision, Moment::OfCritical(T::int(1)));
        let e = brach.restitution.clone();
        let other = kudlich_slibar(brach.clone());
        for (collision, rebound) in [(brach, T::int(0)), (other, e.clone())] {
            let scene = Scene::sticking(collision);
            let v = scene.contact.approach.clone();
            let after = scene.impact.two.after.yaw_rate - scene.impact.one.after.yaw_rate;
            must.equal(after, -(rebound.clone() * scene.contact.relative_yaw_rate()));
            must.equal(scene.impact.separation, Nt { n: -(e.clone() * v.n), t: -(rebound * v.t) });
        }
    }
    must
}

fn moment_fraction<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let mut must = Equations::new();
    for collision in free.collisions() {
        let fraction = free.variable();
        let contact = collision.contact();
        let of = |fraction: T| {
            let moment = with_moment(collision.clone(), Moment::OfCritical(fraction)).moment_impulse(&contact);
            moment.expect("a moment is asked for")
        };
        must.equal(of(fraction.clone()), fraction * of(T::int(1)));
    }
    must
}
