//! Records with more and less in them.

use super::*;
use crate::frame::Xy;
use crate::input::Side;
use alloc::vec::Vec;

/// A car against a wall, to four digits, as another program printed it; degrees made radians.
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
            .with(Measure::Velocity, 0.0005)
            .with(Measure::YawRate, 0.005 * degrees)
            .with(Measure::Energy, 0.5)
            .with(Measure::ImpulseRatio, 0.00005),
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
    // The restitution is still looked at: it must be between 0 and 1.
    assert_eq!(outcome.not_checked().collect::<Vec<_>>(), expected);
    let nothing = check(&Record::default(), &Options::default());
    assert_eq!(nothing.not_checked().count(), Rule::COUNT - 2);
}

#[test]
fn a_coarse_record_cannot_be_decided() {
    let coarse = Record { resolution: Resolution::default().with(Measure::Velocity, 50.0), ..printed() };
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
    // It keeps its velocity.
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
        record.resolution = record.resolution.with(Measure::Velocity, 0.0005);
        record.set(Key::EquivalentEnergySpeed(Side::One), ees);
        rules(&record)
    };
    assert!(with(17.741).is_empty()); // √(2 · 183017/1163), the work of the normal impulse
    assert!(with(17.893).is_empty()); // √(2 · 186168/1163), the loss
    assert_eq!(with(17.80), ["reported"]);
    // Of two cars, that of one alone may not stand for more than is lost.
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
