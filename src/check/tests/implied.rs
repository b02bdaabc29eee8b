//! Motions that a record implies, and that what it reports is held against.

use super::*;

/// Two cars before the impact, and the model. By hand, with e = 0.1 and without friction: K_nn = 1/1000 + 1/2000 + 0.5²/4000 = 0.0015625, so P_n = −1.1 · 20/K_nn.
fn before() -> Record {
    let at_rest = State { velocity: Some(Xy { x: 0.0, y: 0.0 }), yaw_rate: Some(0.0) };
    let body = |mass, yaw_inertia, x, y, before| Subject {
        mass: Some(mass),
        yaw_inertia: Some(yaw_inertia),
        center: Some(Xy { x, y }),
        before,
        ..Subject::default()
    };
    Record {
        one: body(1000.0, 2000.0, -2.0, 0.0, State { velocity: Some(Xy { x: 20.0, y: 0.0 }), ..at_rest }),
        two: body(2000.0, 4000.0, 2.0, 0.5, at_rest),
        point: Some(Xy { x: 0.0, y: 0.0 }),
        normal_angle: Some(0.0),
        model: Model { restitution: Some(0.1), impulse_ratio: Some(0.0), ..Model::default() },
        ..Record::default()
    }
}

const IMPULSE: f64 = 14_080.0;

/// Results of that collision, by hand: T_L = −W_n = ½ · 14 080 · 20 (1 − 0.1).
const RESULTS: [(Key, f64); 9] = [
    (Key::DeltaV(Side::One), 14.08),
    (Key::DeltaV(Side::Two), 7.04),
    (Key::EnergyLoss, 126_720.0),
    (Key::EnergyAfter, 200_000.0 - 126_720.0),
    (Key::NormalWork, -126_720.0),
    (Key::SeparationSpeed, 2.0),
    (Key::NormalImpulse, -IMPULSE),
    (Key::ImpulseX, -IMPULSE),
    (Key::ImpulseMagnitude, IMPULSE),
];

fn outcome(record: &Record, claims: &[(Key, f64)]) -> Outcome {
    let mut record = record.clone();
    claims.iter().for_each(|&(key, value)| record.set(key, value));
    check(&record, &Options::default())
}

#[test]
fn the_model_leads_to_every_result() {
    assert_eq!(outcome(&before(), &RESULTS).verdict(), Verdict::Pass);
    for (key, value) in RESULTS {
        let right = outcome(&before(), &[(key, value)]);
        assert!(right.findings.is_empty(), "{right}");
        for wrong in [1.001 * value, 0.5 * value, -value] {
            let found = outcome(&before(), &[(key, wrong)]);
            assert!(found.findings.iter().any(|finding| finding.severity == Severity::Fail), "{key} {wrong}: {found}");
        }
        // The restitution is held against the speeds themselves.
        let told = outcome(&before(), &[(key, 1.001 * value)]);
        let is_implied = told.findings[0].what.starts_with("with what follows from the ");
        assert_eq!(is_implied, key != Key::SeparationSpeed, "{told}");
    }
    // The laws of motions that were not given are not checked by it.
    let not_checked: Vec<_> = outcome(&before(), &RESULTS[..1]).not_checked().collect();
    assert!(not_checked.contains(&Rule::LinearMomentum) && !not_checked.contains(&Rule::Reported), "{not_checked:?}");
}

/// A mass, a yaw inertia or the normal that is left out follows from the impulse and the motions, and with it what they imply.
#[test]
fn what_is_left_out_of_a_body_follows_from_its_impulse() {
    let whole = |left_out: Option<Key>| {
        let mut record = before();
        // By hand: P = −14 080 N s along x at 0.5 m beside center of mass 2, and none beside that of body 1.
        record.one.after = State { velocity: Some(Xy { x: 20.0 - 14.08, y: 0.0 }), yaw_rate: Some(0.0) };
        record.two.after = State { velocity: Some(Xy { x: 7.04, y: 0.0 }), yaw_rate: Some(1.76) };
        RESULTS.iter().for_each(|&(key, value)| record.set(key, value));
        record.set(Key::TangentialImpulse, 0.0);
        record.set(Key::TangentialWork, 0.0);
        record.set(Key::CriticalRatio, 1.0 / 18.0);
        if let Some(key) = left_out {
            leave_out(&mut record, key);
        }
        record
    };
    let (one, two) = (Side::One, Side::Two);
    for left_out in [None, Some(Key::Mass(one)), Some(Key::Mass(two)), Some(Key::YawInertia(two)), Some(Key::NormalAngle)] {
        let lawful = check(&whole(left_out), &Options::default());
        assert!(lawful.findings.iter().all(|finding| finding.severity != Severity::Fail), "{left_out:?}: {lawful}");
        let numbers = [(Key::CriticalRatio, 1.5), (Key::EnergyAfter, 1.01), (Key::NormalWork, 1.01)];
        let of_body_two = [(Key::AfterYawRate(two), -1.0), (Key::AfterX(two), -1.0)];
        let of_inertia = [(Key::YawInertia(two), 1.5)].into_iter().filter(|_| left_out != Some(Key::YawInertia(two)));
        for (key, factor) in numbers.into_iter().chain(of_body_two).chain(of_inertia) {
            let mut wrong = whole(left_out);
            wrong.set(key, factor * wrong.get(key).expect("known"));
            assert_eq!(check(&wrong, &Options::default()).verdict(), Verdict::Fail, "without {left_out:?}, {key} times {factor}");
        }
    }
    // Without anything that is reported, too.
    for (left_out, key, wrong, rule) in [
        (Key::Mass(two), Key::AfterYawRate(two), -1.76, "line-of-action"),
        (Key::Mass(two), Key::AfterYawRate(two), 1.8, "line-of-action"),
        (Key::Mass(two), Key::AfterX(two), -7.04, "linear-momentum"),
        (Key::Mass(two), Key::AfterY(two), 0.1, "linear-momentum"),
        (Key::YawInertia(two), Key::AfterYawRate(two), -1.76, "line-of-action"),
    ] {
        let mut record = motions_of(whole(Some(left_out)));
        assert!(rules(&record).is_empty(), "{left_out}: {:?}", rules(&record));
        record.set(key, wrong);
        assert!(rules(&record).contains(&rule), "{left_out} {key}: {:?}", rules(&record));
    }
}

fn leave_out(record: &mut Record, key: Key) {
    match key {
        Key::Mass(side) => subject(record, side).mass = None,
        Key::YawInertia(side) => subject(record, side).yaw_inertia = None,
        _ => record.normal_angle = None,
    }
}

fn subject(record: &mut Record, side: Side) -> &mut Subject {
    match side {
        Side::One => &mut record.one,
        Side::Two => &mut record.two,
    }
}

fn motions_of(record: Record) -> Record {
    Record { reported: Reported::default(), model: Model::default(), normal_angle: None, ..record }
}

/// By hand: K_nt = −2 · 0.5/4000 and K_tt = 1/1000 + 1/2000 + 2²/2000 + 2²/4000, so that sliding ends at μ₀ = −K_nt/K_tt = 1/18.
#[test]
fn a_model_that_no_impact_has_is_refuted() {
    let found = |kind, ratio| {
        let mut record = before();
        (record.model.ratio_kind, record.model.impulse_ratio) = (kind, Some(ratio));
        rules(&record)
    };
    let critical = 1.0 / 18.0;
    assert!([critical, critical * (1.0 + 1e-12)].into_iter().all(|ratio| found(RatioKind::Critical, ratio).is_empty()));
    for wrong in [1.001 * critical, -critical, 0.5] {
        assert_eq!(found(RatioKind::Critical, wrong), ["impulse-ratio"], "{wrong}");
    }
    assert!([0.0, 0.03, critical].into_iter().all(|ratio| found(RatioKind::Given, ratio).is_empty()));
    for beyond in [1.001 * critical, -0.001] {
        assert_eq!(found(RatioKind::Given, beyond), ["beyond-critical"], "{beyond}");
    }
    assert!(found(RatioKind::Given, 1.0).contains(&"energy-gain"));
    // Two bodies whose impact would end sliding only if they pulled at each other.
    let body = |x, y, velocity| Subject {
        mass: Some(1500.0),
        yaw_inertia: Some(2500.0),
        center: Some(Xy { x, y }),
        before: State { velocity: Some(velocity), yaw_rate: Some(0.0) },
        ..Subject::default()
    };
    let record = Record {
        one: body(-1.0, 1.5, Xy { x: 1.0, y: 0.0 }),
        two: body(1.0, -1.5, Xy { x: 0.0, y: -20.0 }),
        point: Some(Xy { x: 0.0, y: 0.0 }),
        normal_angle: Some(0.0),
        model: Model { restitution: Some(0.1), ratio_kind: RatioKind::Critical, ..Model::default() },
        ..Record::default()
    };
    assert!(rules(&record).contains(&"compressive"), "{:?}", rules(&record));
    let by_friction = Model { ratio_kind: RatioKind::Given, impulse_ratio: Some(0.1), ..record.model };
    assert!(rules(&Record { model: by_friction, ..record }).is_empty());
}

/// By hand: the impulse passes the center of mass of body 1, and 0.5 m beside that of body 2: 0.5 · 14 080/4000 rad/s.
#[test]
fn the_model_leads_to_spins() {
    let spins = |one, two| {
        let mut record = before();
        (record.one.after.yaw_rate, record.two.after.yaw_rate) = (one, two);
        rules(&record)
    };
    assert!(spins(Some(0.0), Some(1.76)).is_empty() && spins(None, Some(1.76)).is_empty() && spins(Some(0.0), None).is_empty());
    for (one, two) in [(Some(0.0), Some(1.7)), (None, Some(-1.76)), (Some(0.1), None), (None, Some(0.0))] {
        assert!(spins(one, two).contains(&"line-of-action"), "{one:?} {two:?}: {:?}", spins(one, two));
    }
}

/// Every kind of ratio, either law, and a moment, of collisions that this crate solves.
#[test]
fn every_kind_of_model_leads_to_its_results() {
    use crate::{Collision, ImpulseRatio, Law, Moment, Vehicle};
    // And their image in the x axis, where the vehicles slide past each other the other way.
    for mirror in [1.0, -1.0] {
        let one = Vehicle::new(1500.0, 2400.0).with_impact_center(1.9, 0.5 * mirror).with_speed(14.0);
        let heading = crate::Heading::from_angle(1.4 * mirror);
        let two = Vehicle::new(1100.0, 1700.0).with_impact_center(-0.3, 0.8 * mirror).with_heading(heading).with_speed(3.0);
        let of_ratio = [
            ImpulseRatio::Critical,
            ImpulseRatio::Given(0.03 * mirror),
            ImpulseRatio::OfCritical(0.4),
            ImpulseRatio::LimitedByFriction(0.02),
            ImpulseRatio::LimitedByFriction(3.0),
        ];
        for (ratio, law) in of_ratio.into_iter().flat_map(|ratio| [(ratio, Law::Brach), (ratio, Law::KudlichSlibar)]) {
            for moment in [Moment::None, Moment::Given(300.0 * mirror)] {
                let collision = Collision { law, moment, ..Collision::new(one, two).with_restitution(0.2).with_impulse_ratio(ratio) };
                let mut record = Record::of(&collision, &collision.evaluate());
                (record.one.after, record.two.after) = Default::default();
                let passed = check(&record, &Options::default());
                assert!(
                    passed.findings.iter().all(|finding| finding.severity != Severity::Fail),
                    "{mirror} {ratio:?} {law:?} {moment:?}: {passed}"
                );
                let reported = record.reported;
                record.reported = Reported { delta_v: reported.delta_v.map(|delta_v| delta_v.map(|v| 1.01 * v)), ..Reported::default() };
                assert_eq!(check(&record, &Options::default()).of(Rule::Reported).count(), 2, "{mirror} {ratio:?} {law:?} {moment:?}");
            }
        }
    }
}

#[test]
fn a_model_that_leaves_something_open_leads_nowhere() {
    let wrong = [(Key::EnergyLoss, 1.0)];
    let passes = |change: &dyn Fn(&mut Record)| {
        let mut record = before();
        change(&mut record);
        outcome(&record, &wrong).verdict() == Verdict::Pass
    };
    assert!(!passes(&|_| ()));
    assert!(passes(&|record| record.model.restitution = None));
    assert!(passes(&|record| record.model.impulse_ratio = None));
    assert!(passes(&|record| record.two.yaw_inertia = None));
    assert!(passes(&|record| record.one.before.yaw_rate = None));
    assert!(passes(&|record| record.duration = Some(0.1)));
    // By hand: K_nt = 0.5 · 2/4000, so that at a ratio of 6.25 in one direction the pair wedges; in the other it does not.
    let wedges = [6.2, -6.2].map(|ratio| passes(&|record| record.model.impulse_ratio = Some(ratio)));
    assert!(wedges[0] != wedges[1], "{wedges:?}");
}

/// By hand: 1000 kg that leave a wall with 5 m/s by an impulse of 15 kN s came with 10 m/s the other way.
#[test]
fn an_impulse_leads_from_one_side_to_the_other() {
    let mut body = Record { two: Subject::FIXED, ..Record::default() };
    let given = [(Key::Mass(Side::One), 1000.0), (Key::AfterX(Side::One), -5.0), (Key::AfterY(Side::One), 0.0)];
    given.into_iter().for_each(|(key, value)| body.set(key, value));
    let impulse = [(Key::ImpulseX, -15_000.0), (Key::ImpulseY, 0.0)];
    let of = |energy: f64| outcome(&body, &[impulse[0], impulse[1], (Key::EnergyBefore, energy)]);
    assert_eq!([50_000.0, 60_000.0, 40_000.0].map(|energy| of(energy).verdict()), [Verdict::Pass, Verdict::Pass, Verdict::Fail]);
    assert!(of(40_000.0).findings[0].what.starts_with("with what follows from the impulse that is reported, "), "{}", of(40_000.0));
    // With an arm (2, −0.5) the spin falls by 7500 N m s, to −2.75 rad/s of 1 rad/s: ½ 2000 · 1² more.
    let mut spinning = body.clone();
    spinning.point = Some(Xy { x: 0.0, y: 0.0 });
    let given = [
        (Key::YawInertia(Side::One), 2000.0),
        (Key::CenterX(Side::One), -2.0),
        (Key::CenterY(Side::One), 0.5),
        (Key::AfterYawRate(Side::One), -2.75),
    ];
    given.into_iter().for_each(|(key, value)| spinning.set(key, value));
    let of = |energy: f64| outcome(&spinning, &[impulse[0], impulse[1], (Key::EnergyBefore, energy)]).verdict();
    assert_eq!([51_000.0, 50_000.0, 92_250.0].map(of), [Verdict::Pass, Verdict::Fail, Verdict::Fail]);
    let of = |delta_v: f64| outcome(&body, &[impulse[0], impulse[1], (Key::DeltaV(Side::One), delta_v)]);
    assert_eq!([15.0, 14.0].map(|delta_v| of(delta_v).verdict()), [Verdict::Pass, Verdict::Fail]);
}

/// By hand: the velocity that one of two bodies gains is that of the other's impulse.
#[test]
fn the_impulse_on_one_body_moves_the_other() {
    let mut pair = Record::default();
    let (one, two) = (Side::One, Side::Two);
    let motions = [Key::Mass(one), Key::BeforeX(one), Key::BeforeY(one), Key::AfterX(one), Key::AfterY(one)]
        .into_iter()
        .zip([1000.0, 10.0, 0.0, 4.0, 0.0]);
    motions.for_each(|(key, value)| pair.set(key, value));
    [Key::Mass(two), Key::BeforeX(two), Key::BeforeY(two)]
        .into_iter()
        .zip([2000.0, 1.0, 0.0])
        .for_each(|(key, value)| pair.set(key, value));
    let of = |delta_v: f64| outcome(&pair, &[(Key::DeltaV(two), delta_v)]).verdict();
    assert_eq!([3.0, 4.0].map(of), [Verdict::Pass, Verdict::Fail]);
    // T' = ½ 1000 · 4² + ½ 2000 · 4² at least.
    let left = |energy: f64| outcome(&pair, &[(Key::EnergyAfter, energy)]).verdict();
    assert_eq!([24_000.0, 30_000.0, 23_000.0].map(left), [Verdict::Pass, Verdict::Pass, Verdict::Fail]);
}

/// By hand: r × P = 2 · 1000 − (−0.5) · 3000 of an arm (−2, 0.5), so that a yaw inertia of 2000 turns by −1.75 rad/s.
#[test]
fn a_spin_is_held_against_an_impulse_that_is_reported() {
    for side in Side::ALL {
        let on_one = if side == Side::One { 1.0 } else { -1.0 };
        let outcome_of = |yaw_rate: f64, moment: Option<f64>| {
            let mut record =
                Record { point: Some(Xy { x: 0.0, y: 0.0 }), moment: moment.map(|moment| on_one * moment), ..Record::default() };
            let keys = [Key::YawInertia(side), Key::CenterX(side), Key::CenterY(side), Key::BeforeYawRate(side), Key::AfterYawRate(side)];
            keys.into_iter().zip([2000.0, 2.0, -0.5, 0.0, yaw_rate]).for_each(|(key, value)| record.set(key, value));
            outcome(&record, &[(Key::ImpulseX, on_one * 3000.0), (Key::ImpulseY, on_one * 1000.0)])
        };
        let rules = |yaw_rate, moment| outcome_of(yaw_rate, moment).findings.iter().map(|finding| finding.rule).collect::<Vec<_>>();
        assert_eq!(rules(-1.75, None), []);
        assert_eq!([1.75, -3.5, -1.7].map(|yaw_rate| rules(yaw_rate, None)), [[Rule::LineOfAction]; 3]);
        assert_eq!((rules(-1.6, Some(300.0)), rules(-1.75, Some(300.0))), (vec![], vec![Rule::LineOfAction]));
        let told = alloc::format!("{}", outcome_of(1.75, None));
        assert!(told.contains("gains a spin of 3500 N m s, and its impulse gives -3500 N m s"), "{told}");
    }
}
