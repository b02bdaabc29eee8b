//! The laws, of numbers as an answer prints them, in exact rational arithmetic: nothing here uses the library's own mechanics, scalars or tolerances.

use dashu_ratio::RBig;
use planar_impact::{Collision, ImpulseRatio, Law, Moment, Party};
use serde_json::Value;

/// Rounding of numbers that follow from the printed ones by a few operations.
const ROUNDING: f64 = 1e-13;
/// Rounding of numbers that a solution of the impulse equations stands between, and that of what a solution divides by, as a share of its parts.
const SOLVED: f64 = 1e-9;
const OF_PARTS: f64 = 64.0 * f64::EPSILON;

/// An exact number.
fn exact(value: f64) -> RBig {
    RBig::try_from(value).unwrap_or_else(|_| panic!("{value} is no number"))
}

fn magnitude(value: &RBig) -> RBig {
    if *value < RBig::ZERO { -value.clone() } else { value.clone() }
}

/// A vector in ground axes.
#[derive(Clone)]
struct Vector(RBig, RBig);

impl Vector {
    fn of(x: f64, y: f64) -> Vector {
        Vector(exact(x), exact(y))
    }

    fn dot(&self, other: &Vector) -> RBig {
        &self.0 * &other.0 + &self.1 * &other.1
    }

    fn cross(&self, other: &Vector) -> RBig {
        &self.0 * &other.1 - &self.1 * &other.0
    }

    fn plus(&self, other: &Vector) -> Vector {
        Vector(&self.0 + &other.0, &self.1 + &other.1)
    }

    fn minus(&self, other: &Vector) -> Vector {
        Vector(&self.0 - &other.0, &self.1 - &other.1)
    }

    fn times(&self, factor: &RBig) -> Vector {
        Vector(&self.0 * factor, &self.1 * factor)
    }

    /// The velocity of a point at this place of a body that turns.
    fn turning(&self, rate: &RBig) -> Vector {
        Vector(-(&self.1 * rate), &self.0 * rate)
    }

    fn turned_back(&self) -> Vector {
        Vector(-self.0.clone(), -self.1.clone())
    }

    /// The sum of the magnitudes of its components, at least its length.
    fn size(&self) -> RBig {
        magnitude(&self.0) + magnitude(&self.1)
    }
}

/// What the laws have found.
struct Findings(Vec<String>);

impl Findings {
    /// Two numbers that must agree, to a share of the size of what they come from.
    fn equal(&mut self, what: &str, one: &RBig, other: &RBig, size: &RBig, share: f64) {
        let away = magnitude(&(one - other));
        // What underflows has lost its digits.
        if away > size * exact(share) + exact(1e-300) {
            let number = |value: &RBig| value.to_f64().value();
            self.0.push(format!("{what}: {:e} and {:e} differ by {:e} of {:e}", number(one), number(other), number(&away), number(size)));
        }
    }

    fn holds(&mut self, what: &str, holds: bool) {
        if !holds {
            self.0.push(what.to_owned());
        }
    }
}

/// A body before and after the impact.
struct Moved {
    mass: RBig,
    inertia: RBig,
    before: Vector,
    rate_before: RBig,
    after: Vector,
    rate_after: RBig,
    /// From its center of mass to the impact center.
    arm: Vector,
    heading: (f64, f64),
}

fn number(of: &Value, path: &str) -> f64 {
    let value = path.split('.').fold(of, |value, part| part.parse::<usize>().map_or(&value[part], |place| &value[place]));
    value.as_f64().unwrap_or_else(|| panic!("{path} is {value}"))
}

fn moved(party: &Party, printed: &Value) -> Option<Moved> {
    let vehicle = party.vehicle()?;
    let (cos, sin) = (vehicle.heading.cos, vehicle.heading.sin);
    let ahead = Vector::of(cos, sin);
    let left = Vector::of(-sin, cos);
    Some(Moved {
        mass: exact(vehicle.mass),
        inertia: exact(vehicle.yaw_inertia),
        before: Vector::of(vehicle.motion.velocity.x, vehicle.motion.velocity.y),
        rate_before: exact(vehicle.motion.yaw_rate),
        after: Vector::of(number(printed, "velocity.0"), number(printed, "velocity.1")),
        rate_after: exact(number(printed, "yaw_rate")),
        arm: ahead.times(&exact(vehicle.impact_center.forward)).plus(&left.times(&exact(vehicle.impact_center.left))),
        heading: (cos, sin),
    })
}

/// Returns every law that the JSON of `solve` violates for a collision.
pub fn violations(collision: &Collision, answer: &Value) -> Vec<String> {
    let mut found = Findings(Vec::new());
    let bodies = [moved(&collision.one, &answer["vehicles"][0]), moved(&collision.two, &answer["vehicles"][1])];
    let contact = &answer["contact"];
    let impulse = Vector::of(number(contact, "impulse.x"), number(contact, "impulse.y"));
    let moment = contact["impulse"].get("moment").map_or(RBig::ZERO, |moment| exact(moment.as_f64().expect("a number")));
    let two = exact(2.0);

    // Momentum: each body gains what the impulse on it brings, and the second the opposite of the first.
    for (i, body) in bodies.iter().enumerate() {
        let printed = &answer["vehicles"][i];
        let delta_v = Vector::of(number(printed, "delta_v.0"), number(printed, "delta_v.1"));
        let Some(body) = body else {
            let zeros = ["velocity.0", "velocity.1", "yaw_rate", "delta_v.0", "delta_v.1", "delta_v_magnitude", "pdof"];
            found.holds("a barrier moves", zeros.iter().all(|path| number(printed, path) == 0.0));
            continue;
        };
        let (on_it, couple) = if i == 0 { (impulse.clone(), moment.clone()) } else { (impulse.turned_back(), -moment.clone()) };
        let gain = body.after.minus(&body.before);
        for (axis, gained, given) in [("x", &gain.0, &on_it.0), ("y", &gain.1, &on_it.1)] {
            let size = (body.before.size() + body.after.size()) * &body.mass + on_it.size();
            found.equal(&format!("linear momentum of {} along {axis}", i + 1), &(gained * &body.mass), given, &size, ROUNDING);
        }
        let size = &body.inertia * (magnitude(&body.rate_before) + magnitude(&body.rate_after))
            + body.arm.size() * on_it.size()
            + magnitude(&couple);
        let gained = &body.inertia * (&body.rate_after - &body.rate_before);
        found.equal(&format!("angular momentum of {}", i + 1), &gained, &(body.arm.cross(&on_it) + &couple), &size, ROUNDING);
        let size = on_it.size() / &body.mass;
        for (axis, printed, given) in [("x", &delta_v.0, &on_it.0), ("y", &delta_v.1, &on_it.1)] {
            found.equal(&format!("delta_v of {} along {axis}", i + 1), printed, &(given / &body.mass), &size, ROUNDING);
        }
        let length = exact(number(printed, "delta_v_magnitude"));
        found.holds("a length is negative", length >= RBig::ZERO);
        found.equal(
            &format!("delta_v_magnitude of {}", i + 1),
            &(&length * &length),
            &delta_v.dot(&delta_v),
            &delta_v.dot(&delta_v),
            ROUNDING,
        );
        direction_of_force(&mut found, i, body, &delta_v, number(printed, "pdof"));
    }

    // The contact, at the impact center.
    let (cos, sin) = (collision.crush_plane.cos, collision.crush_plane.sin);
    let (normal, tangent) = (Vector::of(cos, sin), Vector::of(-sin, cos));
    let at_contact = |is_after: bool| {
        let of = |body: &Option<Moved>| match body {
            None => (Vector::of(0.0, 0.0), RBig::ZERO),
            Some(body) => {
                let (velocity, rate) = if is_after { (&body.after, &body.rate_after) } else { (&body.before, &body.rate_before) };
                (velocity.plus(&body.arm.turning(rate)), velocity.size() + magnitude(rate) * body.arm.size())
            }
        };
        let ((one, size_one), (two, size_two)) = (of(&bodies[0]), of(&bodies[1]));
        (two.minus(&one), size_one + size_two)
    };
    let ((approach, size_before), (separation, size_after)) = (at_contact(false), at_contact(true));
    let (approach_n, approach_t) = (approach.dot(&normal), approach.dot(&tangent));
    let (separation_n, separation_t) = (separation.dot(&normal), separation.dot(&tangent));
    let size = &size_before + &size_after;
    let solved = SOLVED.max(OF_PARTS / least_share(&bodies, &normal, &tangent, &impulse, &moment));
    found.equal("approach.normal", &exact(number(contact, "approach.normal")), &approach_n, &size_before, ROUNDING);
    found.equal("approach.tangential", &exact(number(contact, "approach.tangential")), &approach_t, &size_before, ROUNDING);
    found.equal("separation.normal", &exact(number(contact, "separation.normal")), &separation_n, &size, solved);
    found.equal("separation.tangential", &exact(number(contact, "separation.tangential")), &separation_t, &size, solved);
    let restitution = exact(collision.restitution);
    found.equal("restitution", &separation_n, &-(&restitution * &approach_n), &size, solved);
    found.holds("the restitution is another", number(contact, "restitution") == collision.restitution);

    let (impulse_n, impulse_t) = (exact(number(contact, "impulse.normal")), exact(number(contact, "impulse.tangential")));
    found.equal("impulse.normal", &impulse_n, &impulse.dot(&normal), &impulse.size(), ROUNDING);
    found.equal("impulse.tangential", &impulse_t, &impulse.dot(&tangent), &impulse.size(), ROUNDING);
    let ratio = exact(number(contact, "impulse_ratio"));
    found.equal("impulse_ratio", &impulse_t, &(&ratio * &impulse_n), &(magnitude(&impulse_t) + magnitude(&impulse_n)), ROUNDING);
    let center = |body: &Option<Moved>| body.as_ref().map_or(Vector::of(0.0, 0.0), |body| body.arm.turned_back());
    let apart = center(&bodies[1]).minus(&center(&bodies[0])).dot(&normal);
    // Two points, whose impact centers are their centers of mass, close either way.
    found.holds("the vehicles do not close", apart == RBig::ZERO || &approach_n * &apart < RBig::ZERO);
    found.holds("the normal impulse is tensile", &approach_n * &impulse_n > RBig::ZERO);
    let critical = contact["critical_impulse_ratio"].as_f64();
    match (collision.impulse_ratio, critical) {
        (ImpulseRatio::Given(given), _) => {
            found.equal("the ratio that is given", &ratio, &exact(given), &magnitude(&ratio), ROUNDING);
        }
        // The critical ratio of Kudlich and Slibar's law is another than the printed one.
        (ImpulseRatio::OfCritical(share), Some(critical)) if collision.law == Law::Brach => {
            found.equal("the share of the critical ratio", &ratio, &(exact(share) * exact(critical)), &magnitude(&ratio), ROUNDING);
        }
        (ImpulseRatio::LimitedByFriction(friction), _) => {
            found.holds("the ratio exceeds the friction", magnitude(&ratio) <= exact(friction.abs()) * exact(1.0 + ROUNDING));
        }
        (ImpulseRatio::Critical, _) if collision.law == Law::Brach && matches!(collision.moment, Moment::None) => {
            found.equal("sliding at the critical ratio", &separation_t, &RBig::ZERO, &size, solved);
        }
        _ => (),
    }

    // Energy.
    let kinetic = |is_after: bool| {
        bodies.iter().flatten().fold(RBig::ZERO, |sum, body| {
            let (velocity, rate) = if is_after { (&body.after, &body.rate_after) } else { (&body.before, &body.rate_before) };
            sum + (&body.mass * velocity.dot(velocity) + &body.inertia * rate * rate) / &two
        })
    };
    let (before, after) = (kinetic(false), kinetic(true));
    let energy = |name: &str| exact(number(&answer["energy"], name));
    let all = &before + &after;
    found.equal("energy.before", &energy("before"), &before, &before, ROUNDING);
    found.equal("energy.after", &energy("after"), &after, &all, solved);
    found.equal("energy.loss", &energy("loss"), &(&before - &after), &all, solved);
    found.holds("energy is gained", &before - &after >= -(&all * exact(solved)));
    let work_m = answer["energy"].get("moment_work").map_or(RBig::ZERO, |work| exact(work.as_f64().expect("a number")));
    let works = [energy("normal_work"), energy("tangential_work"), work_m];
    let size = works.iter().fold(RBig::ZERO, |sum, work| sum + magnitude(work));
    found.equal("the works", &energy("loss"), &-works.iter().fold(RBig::ZERO, |sum, work| sum + work), &size, ROUNDING);
    for (name, impulse, [before, after]) in
        [("normal_work", &impulse_n, [&approach_n, &separation_n]), ("tangential_work", &impulse_t, [&approach_t, &separation_t])]
    {
        // The work on both bodies: half the impulse on the second times the sum of the relative velocities.
        let work = -(impulse * (before + after)) / &two;
        let size = magnitude(impulse) * (&size_before + &size_after);
        found.equal(name, &energy(name), &work, &size, solved);
    }
    found.0
}

/// What a solution of the impulse equations divides by, as a share of its parts: K_nn + μ K_nt at the ratio μ of the impulse, and the determinant of K, with K n the
/// relative velocity at the contact by a unit impulse along n. The first is small near wedging, the second where an inertia is tiny, and smaller by what a moment leaves of
/// the angular impulse.
fn least_share(bodies: &[Option<Moved>; 2], normal: &Vector, tangent: &Vector, impulse: &Vector, moment: &RBig) -> f64 {
    let share = |parts: [RBig; 2]| {
        let all = magnitude(&parts[0]) + magnitude(&parts[1]);
        if all == RBig::ZERO { RBig::ONE } else { magnitude(&(&parts[0] + &parts[1])) / all }
    };
    let (mut nn, mut nt, mut tt) = (RBig::ZERO, RBig::ZERO, RBig::ZERO);
    for body in bodies.iter().flatten() {
        let (along, across) = (body.arm.dot(normal), body.arm.dot(tangent));
        nn += RBig::ONE / &body.mass + &across * &across / &body.inertia;
        nt -= &along * &across / &body.inertia;
        tt += RBig::ONE / &body.mass + &along * &along / &body.inertia;
    }
    let sum = &nn + &tt;
    let of_determinant = (&nn * &tt - &nt * &nt) / (&sum * &sum);
    // Of both bodies the angular impulses are opposite, and so are the moments.
    let of_moment = bodies.iter().flatten().map(|body| share([body.arm.cross(impulse), moment.clone()])).fold(RBig::ONE, RBig::min);
    // Times P_n, so that nothing is divided by.
    let of_wedging = share([nn * impulse.dot(normal), nt * impulse.dot(tangent)]);
    of_wedging.min(of_determinant * of_moment).to_f64().value().max(f64::EPSILON)
}

/// The direction that the force comes from, clockwise from straight ahead.
fn direction_of_force(found: &mut Findings, i: usize, body: &Moved, delta_v: &Vector, pdof: f64) {
    let size = delta_v.size();
    if size == RBig::ZERO {
        return found.holds("a direction without a force", pdof == 0.0);
    }
    let share = |of: &RBig| (of / &size).to_f64().value();
    let (x, y) = (-share(&delta_v.0), -share(&delta_v.1));
    let (cos, sin) = body.heading;
    let (ahead, left) = (x * cos + y * sin, y * cos - x * sin);
    let (right_of, ahead_of) = pdof.sin_cos();
    let (along, across) = (ahead * ahead_of - left * right_of, ahead * right_of + left * ahead_of);
    found.holds(
        &format!("pdof of {} is {pdof}, and the force comes from ahead {ahead}, left {left}", i + 1),
        along > 0.0 && across.abs() < 1e-12,
    );
}

/// Panics if an answer violates a law.
pub fn check(collision: &Collision, answer: &Value) {
    let found = violations(collision, answer);
    assert!(found.is_empty(), "{}\n{collision:?}\n{answer:#}", found.join("\n"));
}

#[cfg(test)]
mod tests {
    use super::*;
    use planar_impact_app::json::{self, Layout};
    use planar_impact_app::{Case, Source, Uncontrolled, solve};

    const CASE: &str = include_str!("../../cli/examples/position-a.toml");

    fn solved(text: &str) -> (Collision, Value) {
        let case = Case::parse(Source::new("case.toml", text)).expect("a case");
        let answer = solve::solve(&case, &(), &Uncontrolled).expect("an answer");
        (case.collision, serde_json::from_str(&json::text(&answer, Layout::Pretty).expect("JSON")).expect("JSON"))
    }

    #[test]
    fn an_answer_holds() {
        check(&solved(CASE).0, &solved(CASE).1);
    }

    /// Each printed number, a billionth off or of the other sign: some law notices.
    #[test]
    fn every_number_of_an_answer_is_held_by_a_law() {
        let with_moment =
            CASE.replace("restitution = 0", "restitution = 0.2\nimpulse_ratio = { of_critical = 0.8 }\nmoment = \"700 N m s\"");
        for text in [CASE.to_owned(), CASE.replace("restitution = 0", "restitution = 0.2\nimpulse_ratio = 0.5"), with_moment] {
            let (collision, sound) = solved(&text);
            assert_eq!(violations(&collision, &sound), Vec::<String>::new());
            for path in [
                "/vehicles/0/velocity/0",
                "/vehicles/0/velocity/1",
                "/vehicles/0/yaw_rate",
                "/vehicles/1/velocity/0",
                "/vehicles/1/velocity/1",
                "/vehicles/1/yaw_rate",
                "/vehicles/0/delta_v/0",
                "/vehicles/0/delta_v/1",
                "/vehicles/0/delta_v_magnitude",
                "/vehicles/0/pdof",
                "/vehicles/1/delta_v/0",
                "/vehicles/1/delta_v/1",
                "/vehicles/1/delta_v_magnitude",
                "/vehicles/1/pdof",
                "/contact/restitution",
                "/contact/impulse/normal",
                "/contact/impulse/tangential",
                "/contact/impulse/x",
                "/contact/impulse/y",
                "/contact/approach/normal",
                "/contact/approach/tangential",
                "/contact/separation/normal",
                "/contact/separation/tangential",
                "/contact/impulse_ratio",
                "/energy/before",
                "/energy/after",
                "/energy/loss",
                "/energy/normal_work",
                "/energy/tangential_work",
            ] {
                let value = sound.pointer(path).and_then(Value::as_f64).expect("a number");
                // A number that is zero, as the restitution of the first, is moved by a little of the size of others.
                for wrong in [-value, value * (1.0 + 1e-7) + 1e-6, value * (1.0 - 1e-7) - 1e-6] {
                    let mut planted = sound.clone();
                    *planted.pointer_mut(path).expect("a number") = wrong.into();
                    let is_same = (wrong - value).abs() < 1e-12;
                    assert!(is_same || !violations(&collision, &planted).is_empty(), "{path}: {value} and {wrong}");
                }
            }
        }
    }
}
