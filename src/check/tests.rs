//! Records with more and fewer numbers.

use super::*;
use crate::frame::Xy;
use crate::input::Side;
use alloc::vec::Vec;

/// A car against a wall, to four digits, as another program printed it, with degrees converted to radians.
fn printed() -> Record {
    let degrees = 1_f64.to_radians();
    Record {
        id: "case-1".into(),
        one: Subject {
            mass: Some(1163.0),
            yaw_inertia: Some(1945.0),
            center: Some(Xy { x: 0.0, y: 0.0 }),
            before: State { velocity: Some(Xy { x: -17.88, y: 2.0 }), yaw_rate: Some(0.0) },
            after: State { velocity: Some(Xy { x: 1.678, y: -0.709 }), yaw_rate: Some(-20.95 * degrees) },
            ..Subject::default()
        },
        two: Subject::FIXED,
        point: Some(Xy { x: -1.94, y: 0.3 }),
        normal_angle: Some(0.0),
        model: Model { restitution: Some(0.1), impulse_ratio: Some(-0.1385), ratio_kind: RatioKind::Critical, ..Model::default() },
        reported: Reported {
            energy_loss: Some(186_168.0),
            work_normal: Some(-183_017.0),
            delta_v: [Some(19.745), None],
            ..Reported::default()
        },
        resolution: Resolution::default()
            .with(ResolutionGroup::Velocity, 0.0005)
            .with(ResolutionGroup::YawRate, 0.005 * degrees)
            .with(ResolutionGroup::Energy, 0.5)
            .with(ResolutionGroup::ImpulseRatio, 0.00005),
        ..Record::default()
    }
}

fn verdict(record: &Record) -> Verdict {
    check(record, &Options::default()).verdict()
}

fn rules(record: &Record) -> Vec<&'static str> {
    let fails = |finding: &&Finding| finding.severity == Severity::Fail;
    check(record, &Options::default()).findings.iter().filter(fails).map(|finding| finding.rule.name()).collect()
}

#[test]
fn printed_digits_pass_within_their_resolution_alone() {
    let outcome = check(&printed(), &Options::default());
    assert_eq!((outcome.verdict(), outcome.findings.len()), (Verdict::Pass, 0), "{outcome}");
    // A wall takes any momentum.
    assert_eq!(outcome.not_checked().collect::<Vec<_>>(), [Rule::LinearMomentum, Rule::AngularMomentum, Rule::Group]);
    let exact = Record { resolution: Resolution::default(), ..printed() };
    assert_eq!(verdict(&exact), Verdict::Fail);
}

#[test]
fn each_digit_counts() {
    let off = |key: Key, by: f64| {
        let mut record = printed();
        record.set(key, record.get(key).expect("known") + by);
        rules(&record)
    };
    assert_eq!(off(Key::EnergyLoss, 30.0), ["reported"]);
    assert_eq!(off(Key::DeltaV(Side::One), 0.004), ["reported"]);
    assert!(off(Key::AfterYawRate(Side::One), 0.002).contains(&"line-of-action"));
    assert!(off(Key::AfterX(Side::One), 0.01).contains(&"restitution"));
    assert!(off(Key::ImpulseRatio, 0.001).contains(&"impulse-ratio"));
}

#[test]
fn what_is_not_known_is_not_checked() {
    let mut record = printed();
    record.point = None;
    let outcome = check(&record, &Options::default());
    assert!(outcome.findings.is_empty(), "{outcome}");
    let expected = [
        Rule::LinearMomentum,
        Rule::AngularMomentum,
        Rule::LineOfAction,
        Rule::Compressive,
        Rule::Interpenetration,
        Rule::ImpulseRatio,
        Rule::BeyondCritical,
        Rule::WorkIdentity,
        Rule::Group,
    ];
    // The restitution is still checked: it must be between 0 and 1.
    assert_eq!(outcome.not_checked().collect::<Vec<_>>(), expected);
    let nothing = check(&Record::default(), &Options::default());
    assert_eq!(nothing.not_checked().count(), Rule::COUNT - 2);
}

#[test]
fn a_coarse_record_cannot_be_decided() {
    let coarse = Record { resolution: Resolution::default().with(ResolutionGroup::Velocity, 50.0), ..printed() };
    let outcome = check(&coarse, &Options::default());
    assert_eq!(outcome.verdict(), Verdict::Undecidable, "{outcome}");
    assert!(outcome.of(Rule::LineOfAction).next().is_some());
}

#[test]
fn a_moving_barrier_is_seen_from_itself() {
    let by = Xy { x: 5.0, y: -3.0 };
    let mut moving = printed();
    for state in [&mut moving.one.before, &mut moving.one.after, &mut moving.two.before] {
        state.velocity = Some(state.velocity.unwrap_or(Xy::zero()) + by);
    }
    assert!(rules(&moving).is_empty(), "{}", check(&moving, &Options::default()));
    // The barrier keeps its velocity.
    moving.two.after.velocity = Some(by);
    assert!(rules(&moving).is_empty());
    moving.two.after.velocity = Some(Xy { x: 4.9, y: -3.0 });
    assert_eq!(rules(&moving), ["linear-momentum"]);
}

#[test]
fn without_yaw_a_gain_of_translation_is_a_warning() {
    let puck = |mass, before, after| Subject {
        mass: Some(mass),
        before: State { velocity: Some(Xy { x: before, y: 0.0 }), yaw_rate: None },
        after: State { velocity: Some(Xy { x: after, y: 0.0 }), yaw_rate: None },
        ..Subject::default()
    };
    let record = |after: f64| Record {
        profile: Profile::Stepper,
        one: puck(1.0, 3.0, after),
        two: puck(3.0, -1.0, -after / 3.0),
        ..Record::default()
    };
    assert_eq!(verdict(&record(-3.0)), Verdict::Pass);
    let outcome = check(&record(-4.0), &Options::default());
    assert_eq!((outcome.verdict(), outcome.findings[0].rule), (Verdict::Warn, Rule::EnergyGain), "{outcome}");
}

#[test]
fn claims_are_held_against_each_other() {
    let said = |claims: &[(Key, f64)]| {
        let mut record = Record::default();
        claims.iter().for_each(|&(key, value)| record.set(key, value));
        rules(&record)
    };
    let works = [(Key::NormalWork, -100.0), (Key::TangentialWork, -20.0)];
    assert!(said(&[works[0], works[1], (Key::EnergyLoss, 120.0)]).is_empty());
    assert_eq!(said(&[works[0], works[1], (Key::EnergyLoss, 121.0)]), ["reported"]);
    assert_eq!(said(&[works[0], works[1], (Key::EnergyBefore, 500.0), (Key::EnergyAfter, 300.0)]), ["reported"]);
    let impulse = [(Key::NormalImpulse, 3.0), (Key::TangentialImpulse, 4.0)];
    assert!(said(&[impulse[0], impulse[1], (Key::ImpulseMagnitude, 5.0), (Key::ImpulseRatio, 4.0 / 3.0)]).is_empty());
    assert_eq!(said(&[impulse[0], impulse[1], (Key::ImpulseMagnitude, 5.1)]), ["reported"]);
    assert_eq!(said(&[impulse[0], impulse[1], (Key::ImpulseRatio, 1.3)]), ["impulse-ratio"]);
    assert_eq!(said(&[impulse[0], impulse[1], (Key::ImpulseX, -3.0), (Key::ImpulseY, 4.0), (Key::NormalAngle, 0.0)]), ["reported"]);
    let passed = [(Key::Mass(Side::One), 1000.0), (Key::DeltaV(Side::One), 5.0), (Key::Mass(Side::Two), 2000.0)];
    assert!(said(&[passed[0], passed[1], passed[2], (Key::DeltaV(Side::Two), 2.5)]).is_empty());
    assert_eq!(said(&[passed[0], passed[1], passed[2], (Key::DeltaV(Side::Two), 2.6)]), ["reported"]);
    assert_eq!(said(&[passed[0], passed[1], (Key::ImpulseMagnitude, 5001.0)]), ["reported"]);
    let speeds = [(Key::ClosingSpeed, 10.0), (Key::SeparationSpeed, 1.0)];
    assert!(said(&[speeds[0], speeds[1], (Key::Restitution, 0.1)]).is_empty());
    assert_eq!(said(&[speeds[0], speeds[1], (Key::Restitution, 0.2)]), ["restitution"]);
    assert!(said(&[(Key::ImpulseRatio, 0.5), (Key::CriticalRatio, 0.6)]).is_empty());
    for beyond in [0.7, -0.1] {
        assert_eq!(said(&[(Key::ImpulseRatio, beyond), (Key::CriticalRatio, 0.6)]), ["beyond-critical"]);
        assert_eq!(said(&[(Key::ImpulseRatio, -beyond), (Key::CriticalRatio, -0.6)]), ["beyond-critical"]);
    }
}

#[test]
fn equivalent_energy_speeds_stand_for_the_normal_work_or_for_all() {
    let with = |ees: f64| {
        let mut record = printed();
        record.resolution = record.resolution.with(ResolutionGroup::Velocity, 0.0005);
        record.set(Key::EquivalentEnergySpeed(Side::One), ees);
        rules(&record)
    };
    assert!(with(17.741).is_empty()); // √(2 · 183017/1163), the work of the normal impulse
    assert!(with(17.893).is_empty()); // √(2 · 186168/1163), the loss
    assert_eq!(with(17.80), ["reported"]);
    // With two cars, the EES of one alone may not exceed the energy lost.
    let alone = |ees: f64| {
        let mut record = Record::default();
        for (key, value) in [(Key::Mass(Side::One), 1000.0), (Key::EquivalentEnergySpeed(Side::One), ees), (Key::EnergyLoss, 50_000.0)] {
            record.set(key, value);
        }
        rules(&record)
    };
    assert!(alone(9.9).is_empty());
    assert_eq!(alone(10.1), ["reported"]);
}

#[test]
fn restitution_of_both_components_is_another_law() {
    use crate::law::{ImpulseRatio, Law};
    use crate::{Collision, CrushPlane, ForwardLeft, Heading, Moment, Motion, Party, Vehicle};
    let car: Vehicle = Vehicle {
        mass: 1500.0,
        yaw_inertia: 2500.0,
        heading: Heading::from_angle(0.0),
        impact_center: ForwardLeft { forward: 2.0, left: 0.5 },
        motion: Motion { velocity: Xy { x: 15.0, y: 4.0 }, yaw_rate: 0.0 },
    };
    let collision = Collision {
        one: car.into(),
        two: Party::Barrier,
        crush_plane: CrushPlane::from_angle(0.0),
        restitution: 0.3,
        impulse_ratio: ImpulseRatio::Critical,
        law: Law::KudlichSlibar,
        moment: Moment::None,
    };
    let record = Record::of(&collision, &collision.evaluate());
    assert!(rules(&record).is_empty());
    let brach = Record { model: Model { law: Law::Brach, ..record.model }, ..record };
    assert_eq!(rules(&brach), ["impulse-ratio", "beyond-critical"]);
}

#[test]
fn a_finding_says_what_and_how_much() {
    let mut record = printed();
    record.set(Key::EnergyLoss, 190_000.0);
    let outcome = check(&record, &Options::default());
    let text = alloc::format!("{outcome}");
    assert!(
        text.starts_with("case-1: fail\n  reported (fail): reported.energy_loss is said to be 190000, and the motions give 18616"),
        "{text}"
    );
}

#[test]
#[should_panic(expected = "case-1: fail")]
fn an_assertion_shows_what_was_found() {
    let mut record = printed();
    record.set(Key::EnergyLoss, 190_000.0);
    check(&record, &Options::default()).assert();
}

#[test]
fn a_tolerance_is_no_precision_of_positions() {
    // Two discs, whose centers are 3 m apart along the normal and 6.5 m across: 0.42 of their distance.
    let disc = |x: f64, y: f64, before: f64, after: f64| Subject {
        mass: Some(1000.0),
        yaw_inertia: Some(2000.0),
        center: Some(Xy { x, y }),
        before: State { velocity: Some(Xy { x: before, y: 0.0 }), yaw_rate: Some(0.0) },
        after: State { velocity: Some(Xy { x: after, y: 0.0 }), yaw_rate: Some(0.0) },
        ..Subject::default()
    };
    let with = |y: f64, width: f64, tolerance: f64| {
        let (one, two) = (disc(-0.5 * width, y, 2.0, -2.0), disc(0.5 * width, -y, -2.0, 2.0));
        let record = Record { one, two, point: Some(Xy { x: 0.0, y: 0.0 }), normal_angle: Some(0.0), ..Record::default() };
        let outcome = check(&record, &Options { tolerance: Some(tolerance) });
        outcome.of(Rule::Compressive).map(|finding| finding.severity).collect::<Vec<_>>()
    };
    assert_eq!(with(3.25, 3.0, 0.4), []);
    assert_eq!(with(3.25, 3.0, 0.45), [Severity::Undecidable]);
    assert_eq!(with(3.25, 0.0, 0.4), [Severity::Fail]);
    assert_eq!(with(3.25, 0.0, 1e-9), [Severity::Fail]);
}

/// A body of 1 kg and 2 kg m² hits a wall 1 m ahead of it with 3 m/s, comes back with 1 m/s, and turns at 1.5 rad/s by a moment impulse of 3 N m s. By hand:
/// P = −4 N s without a lever, W_n = ½ · 4 (1 − 3) = −4 J, W_m = ½ · 3 · 1.5 = 2.25 J, T = 4.5 J, T' = 0.5 + 2.25 J.
fn twisted() -> Record {
    let state = |x, yaw_rate| State { velocity: Some(Xy { x, y: 0.0 }), yaw_rate: Some(yaw_rate) };
    Record {
        profile: Profile::Stepper,
        one: Subject {
            mass: Some(1.0),
            yaw_inertia: Some(2.0),
            center: Some(Xy { x: -1.0, y: 0.0 }),
            before: state(3.0, 0.0),
            after: state(-1.0, 1.5),
            ..Subject::default()
        },
        two: Subject::FIXED,
        point: Some(Xy { x: 0.0, y: 0.0 }),
        normal_angle: Some(0.0),
        moment: Some(3.0),
        model: Model { restitution: Some(1.0 / 3.0), impulse_ratio: Some(0.0), ..Model::default() },
        reported: Reported {
            energy_loss: Some(1.75),
            work_normal: Some(-4.0),
            work_tangential: Some(0.0),
            work_moment: Some(2.25),
            kinetic_energy_before: Some(4.5),
            kinetic_energy_after: Some(2.75),
            ..Reported::default()
        },
        ..Record::default()
    }
}

#[test]
fn a_moment_impulse_turns_a_body_and_does_work() {
    check(&twisted(), &Options::default()).assert();
    assert_eq!(rules(&Record { moment: None, ..twisted() }), ["line-of-action", "work-identity", "reported"]);
    assert_eq!(rules(&Record { moment: Some(-3.0), reported: Reported::default(), ..twisted() }), ["line-of-action", "work-identity"]);
    // Body 2 gets the opposite.
    let exchanged = Record { one: twisted().two, two: twisted().one, moment: Some(-3.0), ..twisted() };
    check(&exchanged, &Options::default()).assert();
    assert_eq!(rules(&Record { moment: Some(3.0), reported: Reported::default(), ..exchanged }), ["line-of-action", "work-identity"]);
}

#[test]
fn claims_of_works_include_that_of_the_moment() {
    let with = |key: Key, value: f64| {
        let mut record = twisted();
        record.set(key, value);
        rules(&record)
    };
    assert!(with(Key::MomentWork, 2.3).is_empty());
    assert!(with(Key::MomentWork, 2.6).contains(&"reported"));
    assert!(with(Key::EnergyLoss, 4.0).contains(&"reported"));
    // Without the claim, the motions determine that work; without motions nothing does.
    let mut record = twisted();
    record.reported.work_moment = None;
    assert!(rules(&record).is_empty());
    record.one.yaw_inertia = None;
    record.reported = Reported { energy_loss: Some(4.0), kinetic_energy_before: None, kinetic_energy_after: None, ..record.reported };
    assert!(rules(&record).contains(&"reported"));
    record.one.after.yaw_rate = None;
    assert!(rules(&record).is_empty());
    // Motions without a contact: the claimed works are the change of kinetic energy.
    let nowhere = Record { point: None, ..twisted() };
    assert!(rules(&nowhere).is_empty());
    let mut wrong = nowhere;
    wrong.reported =
        Reported { work_moment: Some(-2.25), energy_loss: None, kinetic_energy_before: None, kinetic_energy_after: None, ..wrong.reported };
    assert_eq!(rules(&wrong), ["work-identity"]);
}

/// Two bodies of 1 kg and 1 kg m² push each other apart with 6 N for half a second, and their contact point stays at the origin. By hand: P = −3 N s, the
/// centers of mass move by v τ ± ½ 6 τ², and the spins change by the mean of the levers, 0.25 m, times P.
fn long_contact() -> Record {
    let body = |side: f64| {
        let at = |x: f64, y: f64| Some(Xy { x: side * x, y: side * y });
        Subject {
            mass: Some(1.0),
            yaw_inertia: Some(1.0),
            center: at(-1.0, 0.0),
            center_after: at(-0.75, 0.5),
            before: State { velocity: at(2.0, 1.0), yaw_rate: Some(0.375) },
            after: State { velocity: at(-1.0, 1.0), yaw_rate: Some(-0.375) },
            ..Subject::default()
        }
    };
    let origin = Some(Xy { x: 0.0, y: 0.0 });
    Record {
        profile: Profile::Stepper,
        one: body(1.0),
        two: body(-1.0),
        point: origin,
        point_after: origin,
        normal_angle: Some(0.0),
        duration: Some(0.5),
        // (1 + 0.375 × 0.5)/2
        model: Model { restitution: Some(0.59375), impulse_ratio: Some(0.0), ..Model::default() },
        ..Record::default()
    }
}

/// The same without the places after the contact.
fn at_one_instant() -> Record {
    let mut record = long_contact();
    (record.one.center_after, record.two.center_after, record.point_after) = (None, None, None);
    record
}

/// Returns the rules of the warnings.
fn warnings(record: &Record) -> Vec<&'static str> {
    let warns = |finding: &&Finding| finding.severity == Severity::Warn;
    check(record, &Options::default()).findings.iter().filter(warns).map(|finding| finding.rule.name()).collect()
}

#[test]
fn a_long_contact_is_checked_at_its_places_before_and_after() {
    let outcome = check(&long_contact(), &Options::default());
    assert!(outcome.findings.is_empty(), "{outcome}");
    outcome.assert();
    for (key, factor, rule) in [
        (Key::AfterYawRate(Side::One), -1.0, "angular-momentum"),
        (Key::AfterYawRate(Side::Two), 4.0, "line-of-action"),
        (Key::CenterAfterY(Side::Two), -1.0, "angular-momentum"),
        (Key::AfterY(Side::One), -1.0, "linear-momentum"),
    ] {
        let mut wrong = long_contact();
        wrong.set(key, factor * wrong.get(key).expect("known"));
        assert!(rules(&wrong).contains(&rule), "{key}: {:?}", rules(&wrong));
    }
    // A contact point that moves too little, or too far, for the spins.
    for (y, fails) in [(0.0, false), (0.1, false), (0.45, true), (-0.3, true)] {
        let moved = Record { point_after: Some(Xy { x: 0.0, y }), model: Model::default(), ..long_contact() };
        assert_eq!(rules(&moved).contains(&"line-of-action"), fails, "{y}: {:?}", rules(&moved));
    }
}

#[test]
fn what_the_motion_during_a_contact_explains_is_a_warning() {
    let instant = Record { duration: None, model: Model::default(), ..at_one_instant() };
    let broken = ["angular-momentum", "line-of-action", "line-of-action"];
    assert_eq!(rules(&instant), broken);
    assert_eq!(rules(&Record { duration: Some(1e-3), ..instant.clone() }), broken);
    let lasting = Record { duration: Some(0.5), ..instant };
    assert_eq!((rules(&lasting), warnings(&lasting)), (Vec::new(), broken.to_vec()));
    let outcome = check(&lasting, &Options::default());
    assert!(outcome.findings[0].what.contains("the bodies move during the contact"), "{outcome}");
    // With the centers of mass after, angular momentum is known, and the levers are not.
    let mut placed = Record { duration: None, ..lasting.clone() };
    (placed.one.center_after, placed.two.center_after) = (long_contact().one.center_after, long_contact().two.center_after);
    assert_eq!((rules(&placed), warnings(&placed)), (Vec::new(), vec!["line-of-action"; 2]));
    // An error far beyond what the motion explains is a failure, and so is one in linear momentum.
    let mut wrong = Record { duration: Some(0.1), ..lasting.clone() };
    assert!(rules(&wrong).is_empty());
    wrong.set(Key::AfterYawRate(Side::One), 30.0);
    assert!(rules(&wrong).contains(&"angular-momentum") && rules(&wrong).contains(&"line-of-action"));
    let mut wrong = lasting;
    wrong.set(Key::AfterX(Side::One), -0.9);
    assert!(rules(&wrong).contains(&"linear-momentum"));
}

#[test]
fn the_velocities_at_a_long_contact_are_those_at_its_point_after() {
    // Without the point after, 2 m/s along the normal after the contact, not 2.375.
    let restitution =
        |record: &Record| check(record, &Options::default()).of(Rule::Restitution).map(|finding| finding.severity).collect::<Vec<_>>();
    assert_eq!(restitution(&at_one_instant()), [Severity::Warn]);
    // 0.094 of the approach off; in 0.04 s the motion explains 0.75 rad/s × 0.04 s × 5.2 m/s, 0.039 of it.
    assert_eq!(restitution(&Record { duration: Some(0.04), ..at_one_instant() }), [Severity::Fail]);
    assert_eq!(restitution(&Record { duration: None, ..at_one_instant() }), [Severity::Fail]);
    let half = Record { model: Model { restitution: Some(0.5), ..Model::default() }, ..long_contact() };
    assert_eq!(restitution(&half), [Severity::Fail]);
    assert!(restitution(&Record { duration: None, model: half.model, ..at_one_instant() }).is_empty());
}

#[test]
fn the_impulse_of_two_contact_points_acts_between_them() {
    // 1 kg hits a wall with 2 m/s and comes back with it: P = −4 N s, and −4 N s × y about the center of mass, −y from 0.5 to −0.5 m.
    let with = |spin: f64| {
        let state = |x, yaw_rate| State { velocity: Some(Xy { x, y: 0.0 }), yaw_rate: Some(yaw_rate) };
        Record {
            profile: Profile::Stepper,
            one: Subject {
                mass: Some(1.0),
                yaw_inertia: Some(1.0),
                center: Some(Xy { x: -1.0, y: 0.0 }),
                before: state(2.0, -0.5 * spin),
                after: state(-2.0, 0.5 * spin),
                ..Subject::default()
            },
            two: Subject::FIXED,
            point: Some(Xy { x: 0.0, y: -0.5 }),
            point_after: Some(Xy { x: 0.0, y: 0.5 }),
            ..Record::default()
        }
    };
    assert!([-1.9, 0.0, 1.2, 2.0].iter().all(|spin| rules(&with(*spin)).is_empty()));
    assert!([-2.2, 2.2].iter().all(|spin| rules(&with(*spin)) == ["line-of-action"]));
    // The points have different velocities, 1.7 m/s before at one and 2.3 m/s after at the other, so a restitution above 1 is a warning.
    let outcome = check(&Record { normal_angle: Some(0.0), ..with(1.2) }, &Options::default());
    assert_eq!(outcome.of(Rule::Restitution).map(|finding| finding.severity).collect::<Vec<_>>(), [Severity::Warn], "{outcome}");
}

#[test]
fn a_duration_is_at_least_zero_and_that_of_an_impact() {
    assert_eq!(rules(&Record { duration: Some(-0.1), ..long_contact() }), ["finite"]);
    let of_vehicles = |duration| warnings(&Record { duration: Some(duration), ..Record::default() });
    assert!(of_vehicles(0.15).is_empty());
    assert_eq!(of_vehicles(150.0), ["plausible-units"]);
}

/// Returns the message of a panic.
fn panic_of(assert: impl FnOnce() + std::panic::UnwindSafe) -> std::string::String {
    let payload = std::panic::catch_unwind(assert).expect_err("it panics");
    payload.downcast_ref::<std::string::String>().expect("a text").clone()
}

#[test]
fn an_assertion_needs_every_rule_that_the_record_calls_for() {
    check(&printed(), &Options::default()).assert();
    // An empty record, and one without its second body.
    let nothing = check(&Record::default(), &Options::default());
    let expected = [
        Rule::LinearMomentum,
        Rule::AngularMomentum,
        Rule::LineOfAction,
        Rule::EnergyGain,
        Rule::Compressive,
        Rule::Interpenetration,
        Rule::Restitution,
        Rule::BeyondCritical,
        Rule::WorkIdentity,
    ];
    assert_eq!(nothing.unchecked().map(|unchecked| unchecked.rule).collect::<Vec<_>>(), expected);
    let text = panic_of(|| nothing.assert());
    assert!(
        text.contains("linear-momentum was not checked: b1.mass, b1.before.vx, b1.before.vy, b1.after.vx, b1.after.vy, b2.mass"),
        "{text}"
    );
    nothing.assert_checked(&[]);
    nothing.assert_checked(&[Rule::Finite]);
    let alone = Record { two: Subject::default(), ..printed() };
    let text = panic_of(|| check(&alone, &Options::default()).assert());
    assert!(
        text.contains("linear-momentum was not checked: b2.mass, b2.before.vx, b2.before.vy, b2.after.vx, b2.after.vy are missing"),
        "{text}"
    );
}

#[test]
fn each_forgotten_number_is_named_by_the_assertion() {
    let side = Side::One;
    for (keys, rule) in [
        (&[Key::Mass(side)][..], Rule::EnergyGain),
        (&[Key::YawInertia(side)], Rule::EnergyGain),
        (&[Key::CenterX(side), Key::CenterY(side)], Rule::LineOfAction),
        (&[Key::BeforeX(side), Key::BeforeY(side)], Rule::LineOfAction),
        (&[Key::BeforeYawRate(side)], Rule::LineOfAction),
        (&[Key::AfterX(side), Key::AfterY(side)], Rule::Interpenetration),
        (&[Key::AfterYawRate(side)], Rule::WorkIdentity),
        (&[Key::PointX, Key::PointY], Rule::LineOfAction),
        (&[Key::NormalAngle], Rule::BeyondCritical),
    ] {
        let mut record = Record { resolution: Resolution::default(), profile: Profile::Stepper, ..printed() };
        record.reported = Reported::default();
        forget(&mut record, keys[0]);
        let outcome = check(&record, &Options::default());
        let missing: Vec<Key> =
            outcome.unchecked().filter(|unchecked| unchecked.rule == rule).flat_map(|unchecked| unchecked.missing).collect();
        // Spin that is not known is left out of the energy, which is then only warned of.
        if !matches!(keys[0], Key::YawInertia(_)) {
            assert_eq!(missing, keys, "{}", keys[0]);
        }
        assert!(panic_of(move || outcome.assert()).contains(keys[0].name()), "{}", keys[0]);
    }
    // A ratio without its number.
    let mut record = printed();
    record.model = Model { impulse_ratio: None, ratio_kind: RatioKind::Friction, ..record.model };
    let text = panic_of(move || check(&record, &Options::default()).assert());
    assert!(text.ends_with("\n  impulse-ratio was not checked: model.impulse_ratio is missing"), "{text}");
}

/// Removes a number of body 1 or of the contact; a vector as a whole.
fn forget(record: &mut Record, key: Key) {
    let one = &mut record.one;
    match key {
        Key::Mass(_) => one.mass = None,
        Key::YawInertia(_) => one.yaw_inertia = None,
        Key::CenterX(_) => one.center = None,
        Key::BeforeX(_) => one.before.velocity = None,
        Key::BeforeYawRate(_) => one.before.yaw_rate = None,
        Key::AfterX(_) => one.after.velocity = None,
        Key::AfterYawRate(_) => one.after.yaw_rate = None,
        Key::PointX => record.point = None,
        _ => record.normal_angle = None,
    }
}

#[test]
fn an_assertion_needs_rules_that_can_be_decided_and_a_group_that_was_compared() {
    let coarse = Record { resolution: Resolution::default().with(ResolutionGroup::Velocity, 50.0), ..printed() };
    let outcome = check(&coarse, &Options::default());
    outcome.assert_checked(&[]);
    assert!(panic_of(|| outcome.assert()).contains("line-of-action (undecidable)"));
    let mut outcomes = [0, 1].map(|_| {
        let group = Some(Membership { name: "g".into(), agreement: Agreement::Loss });
        check(&Record { group, ..printed() }, &Options::default())
    });
    assert!(panic_of(|| outcomes[0].assert()).contains("Consensus::apply"));
    Consensus::of(&outcomes).apply(&mut outcomes);
    outcomes[0].assert();
}

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

/// A body along x: mass, place, velocities before and after, yaw rates before and after; its yaw inertia is 2 kg m².
fn body(mass: f64, (x, y): (f64, f64), before: (f64, f64), after: (f64, f64), yaw: (f64, f64)) -> Subject {
    let state = |(x, y), yaw_rate| State { velocity: Some(Xy { x, y }), yaw_rate: Some(yaw_rate) };
    let center = Some(Xy { x, y });
    Subject {
        mass: Some(mass),
        yaw_inertia: Some(2.0),
        center,
        before: state(before, yaw.0),
        after: state(after, yaw.1),
        ..Subject::default()
    }
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
        (record.one.yaw_inertia, record.two.yaw_inertia) = (None, None);
        record
    };
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
