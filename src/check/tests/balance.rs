//! Momentum, energy and work, each to the size that its rule allows.

use super::*;

/// Returns the findings of a rule as severity, size and bound.
fn sizes(record: &Record, rule: Rule) -> Vec<(Severity, f64, f64)> {
    check(record, &Options::default()).of(rule).map(|finding| (finding.severity, finding.size, finding.bound)).collect()
}

/// Compares the only finding of a rule with a size and a bound by hand.
#[track_caller]
fn finds(record: &Record, rule: Rule, severity: Severity, size: f64, bound: f64) {
    let found = sizes(record, rule);
    let is_close = |a: f64, b: f64| (a - b).abs() <= 1e-9 * b.abs().max(1e-3);
    assert!(
        found.len() == 1 && found[0].0 == severity && is_close(found[0].1, size) && is_close(found[0].2, bound),
        "{severity} {size} within {bound}: {}",
        check(record, &Options::default())
    );
}

fn stepped(one: Subject, two: Subject) -> Record {
    Record { profile: Profile::Stepper, one, two, ..Record::default() }
}

#[test]
fn momentum_is_balanced_to_a_share_of_what_is_exchanged() {
    // 2 kg gain (−6, 8) N s and 1 kg (6, −7.5) N s: half a newton second along y, within a millionth of 10 + √92.25.
    let one = body(2.0, (0.0, 0.0), (3.0, 0.0), (0.0, 4.0), (0.0, 0.0));
    let two = body(1.0, (2.0, 0.0), (-3.0, 1.0), (3.0, -6.5), (0.0, 0.0));
    let record = stepped(one, two);
    finds(&record, Rule::LinearMomentum, Severity::Fail, 0.5, 1e-6 * (10.0 + 92.25_f64.sqrt()));
    assert!(check(&record, &Options::default()).of(Rule::LinearMomentum).next().is_some_and(|finding| finding.what.starts_with("along y")));
    // A fixed body: a share of its speed, or of 1 m/s.
    let wall = |before: f64, after: f64| {
        let state = |x| State { velocity: Some(Xy { x, y: 0.0 }), yaw_rate: None };
        stepped(
            body(1.0, (0.0, 0.0), (0.0, 0.0), (0.0, 0.0), (0.0, 0.0)),
            Subject { before: state(before), after: state(after), ..Subject::FIXED },
        )
    };
    finds(&wall(0.0, 0.25), Rule::LinearMomentum, Severity::Fail, 0.25, 1e-6);
    finds(&wall(3.0, 4.0), Rule::LinearMomentum, Severity::Fail, 1.0, 7e-6);
    finds(&wall(4.0, 3.0), Rule::LinearMomentum, Severity::Fail, 1.0, 7e-6);
}

#[test]
fn angular_momentum_is_balanced_about_the_contact_or_a_center_of_mass() {
    // P = (−4, 2) N s on 1 kg at the origin, the opposite on 2 kg at (3, 1). About center of mass 1, body 2 gains 2 ΔΩ + 3 · (−2) − 1 · 4 = 2 ΔΩ − 10 N m s.
    let one = body(1.0, (0.0, 0.0), (4.0, 0.0), (0.0, 2.0), (0.5, 1.5));
    let two = body(2.0, (3.0, 1.0), (0.0, 0.0), (2.0, -1.0), (0.0, 4.0));
    let record = stepped(one, two);
    assert!(sizes(&record, Rule::AngularMomentum).is_empty(), "{}", check(&record, &Options::default()));
    let scale = 2.0 + 8.0 + 10.0_f64.sqrt() * 20.0_f64.sqrt();
    let with = |yaw: f64| stepped(one, Subject { after: State { yaw_rate: Some(yaw), ..two.after }, ..two });
    finds(&with(4.5), Rule::AngularMomentum, Severity::Fail, 1.0, 2e-2 * (scale + 1.0));
    finds(&with(3.5), Rule::AngularMomentum, Severity::Fail, 1.0, 2e-2 * (scale - 1.0));
    // About a contact at (1, 0.5): arms (1, 0.5) and (−2, −0.5). Body 1 gains 2 − (1 · 2 + 0.5 · 4) = −2 N m s, body 2 8 − (−2 · (−2) + 0.5 · 4) = 2 N m s.
    let there = Record { point: Some(Xy { x: 1.0, y: 0.5 }), ..record };
    let arms = [1.25_f64.sqrt(), 4.25_f64.sqrt()].map(|arm| arm * 20.0_f64.sqrt());
    let found = sizes(&there, Rule::LineOfAction);
    assert!(sizes(&there, Rule::AngularMomentum).is_empty());
    for ((severity, size, bound), (spin, arm)) in found.into_iter().zip([(2.0, arms[0]), (8.0, arms[1])]) {
        assert!(severity == Severity::Fail && (size - 2.0).abs() < 1e-12 && (bound - 2e-2 * (spin + arm)).abs() < 1e-12, "{size} {bound}");
    }
    let off = Record { point: there.point, ..with(4.5) };
    finds(&off, Rule::AngularMomentum, Severity::Fail, 1.0, 2e-2 * (2.0 + 9.0 + arms[0] + arms[1]));
    // At the places before and after, of a body that keeps its yaw rate: 0.75 N m s of the other's spin and ½ · 2 m · 6 m/s of the centers of mass.
    let mut moved = long_contact();
    moved.one.after.yaw_rate = Some(0.375);
    finds(&moved, Rule::AngularMomentum, Severity::Fail, 0.75, 2e-2 * (0.75 + 6.0));
    // The moment and a spin of either sign are part of the size of the angular momentum.
    let mut mirrored = Record { moment: Some(-4.0), reported: Reported::default(), ..twisted() };
    mirrored.one.after.yaw_rate = Some(-1.5);
    finds(&mirrored, Rule::LineOfAction, Severity::Fail, 1.0, 2e-2 * (3.0 + 4.0 + 4.0));
    let twist = Record { moment: Some(4.0), reported: Reported::default(), ..twisted() };
    finds(&twist, Rule::LineOfAction, Severity::Fail, 1.0, 2e-2 * (3.0 + 4.0 + 4.0));
}

#[test]
fn energy_is_gained_for_an_observer_on_the_ground_or_with_the_pair() {
    let still = (0.0, 0.0);
    let pair = |before: (f64, f64), after: (f64, f64)| {
        let place = |x| (x, 0.0);
        stepped(
            body(1.0, place(0.0), (before.0, 0.0), (after.0, 0.0), still),
            body(3.0, place(1.0), (before.1, 0.0), (after.1, 0.0), still),
        )
    };
    // Both faster by 1 m/s: ½ 1 (9 − 4) + ½ 3 (4 − 1) = 7 J on the ground, nothing for the pair; ½ · ¾ · 1² J could be lost.
    finds(&pair((2.0, 1.0), (3.0, 2.0)), Rule::EnergyGain, Severity::Fail, 7.0, 2e-2 * 0.375);
    // Slower on the ground, and thrown apart: ½ · ¾ (4² − 1²) J.
    finds(&pair((10.0, 9.0), (-2.0, 2.0)), Rule::EnergyGain, Severity::Fail, 5.625, 2e-2 * 0.375);
    // Within 2 % of what could be lost, ½ · ¾ · 4² = 6 J.
    assert!(sizes(&pair((3.0, -1.0), (-3.0, 1.0)), Rule::EnergyGain).is_empty());
    let gains = |factor: f64| sizes(&pair((3.0, -1.0), (-3.0 * factor, factor)), Rule::EnergyGain).len();
    assert_eq!((gains(1.0099_f64.sqrt()), gains(1.0201_f64.sqrt())), (0, 1));
    // Spin counts: 2 kg m² from rest to 1 rad/s is 1 J.
    let spun = stepped(body(1.0, still, still, still, (0.0, 1.0)), Subject::FIXED);
    assert_eq!(sizes(&spun, Rule::EnergyGain), [(Severity::Fail, 1.0, sizes(&spun, Rule::EnergyGain)[0].2)]);
    // Without it, a gain of ½ (16 − 9) + ½ 3 (16/9 − 1) J is a warning, and a loss is none.
    let without = |after: f64| {
        let mut record = pair((3.0, -1.0), (after, -after / 3.0));
        (record.one.before.yaw_rate, record.two.before.yaw_rate) = (None, None);
        record
    };
    // A pair that does not spin needs no yaw inertia.
    let mut still = pair((3.0, -1.0), (-4.0, 4.0 / 3.0));
    (still.one.yaw_inertia, still.two.yaw_inertia) = (None, None);
    finds(&still, Rule::EnergyGain, Severity::Fail, 3.5 + 7.0 / 6.0, 2e-2 * 6.0);
    finds(&without(-4.0), Rule::EnergyGain, Severity::Warn, 3.5 + 7.0 / 6.0, 2e-2 * 6.0);
    assert!(sizes(&without(-2.0), Rule::EnergyGain).is_empty() && sizes(&without(-3.01), Rule::EnergyGain).is_empty());
}

#[test]
fn works_are_balanced_to_a_share_of_their_size() {
    // W_n = −4 J and W_m = 2.25 J by hand; 4.5 J before and 2.75 J after. With 2 rad/s after the impact, W_m = 3 J and T' = 0.5 + 4 J.
    let mut record = Record { reported: Reported::default(), ..twisted() };
    record.one.after.yaw_rate = Some(2.0);
    finds(&record, Rule::WorkIdentity, Severity::Fail, 1.0, 2e-2 * (0.5 * 4.0 * (3.0 + 5.0_f64.sqrt()) + 3.0));
    // The works that are reported, without a contact: −4 + 2.25 + 1 J.
    let claims = Reported {
        work_tangential: Some(1.0),
        energy_loss: None,
        kinetic_energy_before: None,
        kinetic_energy_after: None,
        ..twisted().reported
    };
    let nowhere = Record { point: None, reported: claims, ..twisted() };
    let found = sizes(&nowhere, Rule::WorkIdentity);
    assert_eq!(found.iter().map(|finding| finding.0).collect::<Vec<_>>(), [Severity::Fail, Severity::Warn]);
    assert!((found[0].1 - 1.0).abs() < 1e-12 && (found[0].2 - 2e-2 * (4.0 + 1.0 + 2.25)).abs() < 1e-12, "{found:?}");
    assert!(found[1].1 == 1.0 && (found[1].2 - 2e-2 * (4.0 + 1.0 + 2.25)).abs() < 1e-12, "{found:?}");
}

#[test]
fn work_that_the_tangential_impulse_gives_back_is_a_warning() {
    // 1 kg and 2 kg m² with a lever of (1, 1) m: P = (−3, t) N s. Before, the point moves at (2 − ω, ω) m/s past the wall.
    let with = |t: f64, yaw: f64| {
        let spin = (1.0 * t + 3.0) / 2.0;
        let one = body(1.0, (-1.0, -1.0), (2.0, 0.0), (-1.0, t), (yaw, yaw + spin));
        Record { point: Some(Xy { x: 0.0, y: 0.0 }), normal_angle: Some(0.0), ..stepped(one, Subject::FIXED) }
    };
    // −½ t (v_t + V_t) with v_t = −ω and V_t = −(t + ω + spin): ½ · 1 · (−1 + 1 + 0.5 · 4 − 1) …
    for (t, yaw) in [(1.0, -1.0), (1.0, 1.0), (-1.0, -1.5), (-1.0, 1.0)] {
        let spin = (t + 3.0) / 2.0;
        let work = 0.5 * t * (yaw + (t + yaw + spin));
        let found = sizes(&with(t, yaw), Rule::WorkIdentity);
        if work > 0.0 {
            assert!(found.len() == 1 && found[0].0 == Severity::Warn && (found[0].1 - work).abs() < 1e-12, "{t} {yaw}: {found:?}, {work}");
        } else {
            assert!(work < 0.0 && found.is_empty(), "{t} {yaw}: {found:?}, {work}");
        }
    }
}

#[test]
fn restitution_above_what_every_approach_allows_is_a_warning() {
    use crate::law::{ImpulseRatio, Law};
    use crate::{Collision, CrushPlane, ForwardLeft, Heading, Moment, Motion, Party, Vehicle};
    // 1 kg and 1 kg m² with a lever of (1, 1) m: K_nn = K_tt = 2, K_nt = −1, so e may be √(1 − 1/4).
    let car: Vehicle = Vehicle {
        mass: 1.0,
        yaw_inertia: 1.0,
        heading: Heading::from_angle(0.0),
        impact_center: ForwardLeft { forward: 1.0, left: 1.0 },
        motion: Motion { velocity: Xy { x: 2.0, y: 0.0 }, yaw_rate: 0.0 },
    };
    let with = |restitution: f64, ratio: ImpulseRatio, law: Law, moment: Moment| {
        let (crush_plane, impulse_ratio) = (CrushPlane::from_angle(0.0), ratio);
        let collision = Collision { one: car.into(), two: Party::Barrier, crush_plane, restitution, impulse_ratio, law, moment };
        Record { profile: Profile::Stepper, ..Record::of(&collision, &collision.evaluate()) }
    };
    let above =
        |record: &Record| sizes(record, Rule::Restitution).into_iter().filter(|finding| finding.0 == Severity::Warn).collect::<Vec<_>>();
    let critical = |e| with(e, ImpulseRatio::Critical, Law::Brach, Moment::None);
    finds(&critical(0.875), Rule::Restitution, Severity::Warn, 0.875, 0.75_f64.sqrt());
    finds(&critical(1.0), Rule::Restitution, Severity::Warn, 1.0, 0.75_f64.sqrt());
    assert!(above(&critical(0.86)).is_empty());
    // The restitution of the velocities, if none is stated.
    let mut unstated = critical(0.875);
    unstated.model.restitution = None;
    finds(&unstated, Rule::Restitution, Severity::Warn, 0.875, 0.75_f64.sqrt());
    // Another ratio, law or a moment has another bound.
    assert!(above(&with(0.875, ImpulseRatio::Given(0.0), Law::Brach, Moment::None)).is_empty());
    assert!(above(&with(0.875, ImpulseRatio::Critical, Law::KudlichSlibar, Moment::None)).is_empty());
    assert!(above(&with(0.875, ImpulseRatio::Critical, Law::Brach, Moment::Given(0.25))).is_empty());
}

#[test]
fn the_normal_has_two_directions_and_one_of_compression() {
    // 1 kg at (∓1, 0.5) m, with 2 m/s toward a wall at the origin, and back with 1 m/s.
    let with = |x: f64, before: f64, after: f64, angle: f64| {
        let one = body(1.0, (x, 0.0), (before, 1.0), (after, 1.0), (0.0, 0.0));
        Record { point: Some(Xy { x: 0.0, y: 0.0 }), normal_angle: Some(angle), ..stepped(one, Subject::FIXED) }
    };
    for angle in [0.0, core::f64::consts::PI] {
        for side in [-1.0, 1.0] {
            let fails = |before: f64, after: f64| rules(&with(side, -side * before, -side * after, angle));
            assert!(fails(2.0, -1.0).is_empty());
            // Apart from the beginning, pulled back, and still closing after.
            assert_eq!(fails(-1.0, -2.0), ["compressive", "energy-gain"]);
            finds(&with(side, side, 2.0 * side, angle), Rule::Compressive, Severity::Fail, 1.0, 2e-2 * 2.0_f64.sqrt());
            finds(&with(side, -side, -2.0 * side, angle), Rule::Compressive, Severity::Fail, 1.0, 2e-2);
            finds(&with(side, -2.0 * side, -0.5 * side, angle), Rule::Interpenetration, Severity::Fail, 0.5, 2e-2 * 5.0_f64.sqrt());
        }
    }
    // Without a clear approach there is no restitution; with coarse positions no side.
    assert!(sizes(&with(-1.0, 0.0, 0.0, 0.0), Rule::Restitution).is_empty());
    let coarse = |group, resolution| Record { resolution: Resolution::default().with(group, resolution), ..with(-1.0, 2.0, -1.0, 0.0) };
    for rule in [Rule::Compressive, Rule::Interpenetration] {
        finds(
            &coarse(ResolutionGroup::Length, 3.0),
            rule,
            Severity::Undecidable,
            1.0,
            sizes(&coarse(ResolutionGroup::Length, 3.0), rule)[0].2,
        );
    }
    assert_eq!(sizes(&coarse(ResolutionGroup::Velocity, 3.0), Rule::Restitution).len(), 1);
    assert_eq!(sizes(&coarse(ResolutionGroup::Velocity, 3.0), Rule::Restitution)[0].0, Severity::Undecidable);
}

#[test]
fn a_restitution_that_is_stated_lies_between_zero_and_one() {
    let said = |e: f64| {
        let outcome =
            check(&Record { model: Model { restitution: Some(e), ..Model::default() }, ..Record::default() }, &Options::default());
        outcome.of(Rule::Restitution).map(|finding| (finding.size, finding.what.clone())).collect::<Vec<_>>()
    };
    assert!([0.0, 1e-10, 1.0, 1.0 + 1e-10].iter().all(|e| said(*e).is_empty()));
    for (e, size, percentage) in [(1.5, 0.5, false), (2.0, 1.0, true), (100.0, 99.0, true), (101.0, 100.0, false), (-0.25, 0.25, false)] {
        let found = said(e);
        assert!(found.len() == 1 && found[0].0 == size && found[0].1.contains("percentage") == percentage, "{e}: {found:?}");
    }
    let coarse = Record { profile: Profile::Stepper, model: Model { restitution: Some(-0.03), ..Model::default() }, ..Record::default() };
    finds(&coarse, Rule::Restitution, Severity::Fail, 0.03, 2e-2);
    // V_n = 1 m/s after 4 m/s is 0.25, and 0.05 off; of the speeds that are reported too.
    let one = body(1.0, (-1.0, 0.0), (4.0, 0.0), (-1.0, 0.0), (0.0, 0.0));
    let mut record = Record { point: Some(Xy { x: 0.0, y: 0.0 }), normal_angle: Some(0.0), ..stepped(one, Subject::FIXED) };
    record.model.restitution = Some(0.3);
    finds(&record, Rule::Restitution, Severity::Fail, 0.05, 2e-2);
    record.model.restitution = Some(0.2);
    finds(&record, Rule::Restitution, Severity::Fail, 0.05, 2e-2);
    record.model.restitution = None;
    record.one.after.velocity = Some(Xy { x: -5.0, y: 0.0 });
    finds(&record, Rule::Restitution, Severity::Fail, 0.25, 2e-2);
    let mut claims = Record { profile: Profile::Stepper, ..Record::default() };
    for (key, value) in [(Key::ClosingSpeed, 4.0), (Key::SeparationSpeed, 1.0), (Key::Restitution, 0.3)] {
        claims.set(key, value);
    }
    finds(&claims, Rule::Restitution, Severity::Fail, 0.05, 2e-2);
}

/// A wrong record fails at every size, whatever of it overflows or vanishes.
#[test]
fn no_size_hides_what_is_wrong() {
    let body = |mass, center, before, after| Subject {
        mass: Some(mass),
        yaw_inertia: Some(mass / 6.0),
        center: Some(center),
        before,
        after,
        ..Subject::default()
    };
    let state = |x, y, yaw_rate| State { velocity: Some(Xy { x, y }), yaw_rate: Some(yaw_rate) };
    let sound = Record {
        profile: Profile::Stepper,
        one: body(1.0, Xy { x: -0.5, y: -0.2 }, state(3.0, 0.0, 0.0), state(0.475, -0.505, 1.515)),
        two: body(1.0, Xy { x: 0.5, y: -0.1 }, state(-1.0, -2.5, 0.4), state(1.525, -1.995, -2.63)),
        point: Some(Xy { x: 0.0, y: 0.0 }),
        normal_angle: Some(0.0),
        ..Record::default()
    };
    assert_eq!(verdict(&sound), Verdict::Pass);
    let keys = |what: &str| match what {
        "mass" => [Side::One, Side::Two].map(|side| vec![Key::Mass(side), Key::YawInertia(side)]).concat(),
        "speed" => [Side::One, Side::Two]
            .map(|side| {
                vec![
                    Key::BeforeX(side),
                    Key::BeforeY(side),
                    Key::BeforeYawRate(side),
                    Key::AfterX(side),
                    Key::AfterY(side),
                    Key::AfterYawRate(side),
                ]
            })
            .concat(),
        _ => vec![Key::Mass(Side::One)],
    };
    for what in ["mass", "speed", "mass of one"] {
        for power in -320..=308 {
            let mut wrong = sound.clone();
            if what != "mass of one" {
                wrong.set(Key::AfterX(Side::One), 0.8);
            }
            for key in keys(what) {
                let value = wrong.get(key).expect("it is known");
                // In two steps, as the factor alone may vanish.
                wrong.set(key, value * 10_f64.powi(power / 2) * 10_f64.powi(power - power / 2));
            }
            let is_sound = what == "mass of one" && power == 0;
            assert_eq!(verdict(&wrong) != Verdict::Fail, is_sound, "{what} times 10^{power}: {}", check(&wrong, &Options::default()));
        }
    }
}
