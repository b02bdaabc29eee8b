//! Claims of a program, each compared with the others.

use super::*;
use crate::law::Law;
use alloc::vec;

/// The finding about a wrong ratio gives the ratio that follows from the motions.
#[test]
fn a_wrong_ratio_is_told_with_the_right_one() {
    use crate::collision::Collision;
    use crate::vehicle::{Party, Vehicle};
    let collision = Collision::new(Vehicle::new(1000.0, 2000.0).with_impact_center(2.0, 0.5).with_speed(10.0), Party::Barrier);
    let impact = collision.evaluate();
    let mut record = Record::of(&collision, &impact);
    let ratio = impact.impulse_ratio();
    record.set(Key::ReportedRatio, 2.0 * ratio);
    let outcome = check(&record, &Options::default());
    let told: Vec<_> = outcome.of(Rule::Reported).map(|finding| finding.what.clone()).collect();
    let implied = alloc::format!("the motions give {}", super::super::format::Digits(ratio));
    assert!(told.iter().any(|told| told.contains(&implied)), "{told:?}, not {implied}");
}

/// The impulse is that of the body whose change of momentum is known better: of 100 kg to 10 N s, of 10 t to 1000 N s.
#[test]
fn an_impulse_that_is_claimed_is_held_against_the_lighter_body() {
    for [heavy, light] in [[Side::One, Side::Two], [Side::Two, Side::One]] {
        let verdict = |claim: f64| {
            let mut record = Record { resolution: Resolution::default().with(ResolutionGroup::Velocity, 0.1), ..Record::default() };
            for (side, mass, [before, after]) in [(heavy, 1e4, [10.0, 9.9]), (light, 100.0, [0.0, 10.0])] {
                let keys = [Key::Mass(side), Key::BeforeX(side), Key::AfterX(side), Key::BeforeY(side), Key::AfterY(side)];
                keys.into_iter().zip([mass, before, after, 0.0, 0.0]).for_each(|(key, value)| record.set(key, value));
            }
            let on_one = if heavy == Side::One { -claim } else { claim };
            record.set(Key::ImpulseX, on_one);
            check(&record, &Options::default()).verdict()
        };
        assert_eq!([1000.0, 1200.0].map(|claim| verdict(claim) == Verdict::Fail), [false, true], "{light:?} is light");
    }
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
    assert!(said(&[impulse[0], impulse[1], (Key::ReportedRatio, 4.0 / 3.0), (Key::ImpulseRatio, 4.0 / 3.0)]).is_empty());
    assert_eq!(said(&[impulse[0], impulse[1], (Key::ReportedRatio, 1.3)]), ["reported"]);
    assert_eq!(said(&[(Key::ReportedRatio, 0.3), (Key::ImpulseRatio, 0.31)]), ["impulse-ratio"]);
    let critical = |claims: &[(Key, f64)]| {
        let mut record = Record { model: Model { ratio_kind: RatioKind::Critical, ..Model::default() }, ..Record::default() };
        claims.iter().for_each(|&(key, value)| record.set(key, value));
        rules(&record)
    };
    assert!(critical(&[(Key::ImpulseRatio, 0.6), (Key::CriticalRatio, 0.6), (Key::ReportedRatio, 0.6)]).is_empty());
    assert_eq!(critical(&[(Key::ImpulseRatio, 0.6), (Key::CriticalRatio, 0.7)]), ["impulse-ratio"]);
    assert_eq!(critical(&[(Key::ImpulseRatio, 0.6), (Key::ReportedRatio, 0.5)]), ["impulse-ratio"]);
    // The share of the critical ratio is no ratio.
    let mut share = Record { model: Model { ratio_kind: RatioKind::OfCritical, ..Model::default() }, ..Record::default() };
    [(Key::ImpulseRatio, 0.5), (Key::ReportedRatio, 0.3), (Key::CriticalRatio, 0.6)].iter().for_each(|&(key, value)| share.set(key, value));
    assert!(rules(&share).is_empty());
    let of_kind = |ratio_kind: RatioKind, claims: &[(Key, f64)]| {
        let mut record = Record { model: Model { ratio_kind, ..Model::default() }, ..Record::default() };
        claims.iter().for_each(|&(key, value)| record.set(key, value));
        rules(&record)
    };
    let share = |share: f64, ratio: f64, critical: f64| {
        of_kind(RatioKind::OfCritical, &[(Key::ImpulseRatio, share), (Key::ReportedRatio, ratio), (Key::CriticalRatio, critical)])
    };
    assert_eq!((share(0.5, 0.3, 0.4), share(0.75, -0.3, -0.4)), (vec!["impulse-ratio"], vec![]));
    for (of, share) in [(1.0, vec![]), (1.2, vec!["beyond-critical"]), (0.0, vec![]), (-0.5, vec!["beyond-critical"])] {
        assert_eq!(of_kind(RatioKind::OfCritical, &[(Key::ImpulseRatio, of)]), share, "{of}");
    }
    let friction =
        |friction: f64, claims: &[(Key, f64)]| of_kind(RatioKind::Friction, &[&[(Key::ImpulseRatio, friction)], claims].concat());
    for sign in [1.0, -1.0] {
        assert!(
            friction(0.5, &[(Key::ReportedRatio, sign * 0.5)]).is_empty() && friction(0.5, &[(Key::ReportedRatio, sign * 0.2)]).is_empty()
        );
        assert_eq!(friction(0.2, &[(Key::ReportedRatio, sign * 0.5)]), ["impulse-ratio"]);
        assert!(friction(0.5, &[(Key::NormalImpulse, -100.0), (Key::TangentialImpulse, sign * 50.0)]).is_empty());
        assert_eq!(friction(0.2, &[(Key::NormalImpulse, -100.0), (Key::TangentialImpulse, sign * 50.0)]), ["impulse-ratio"]);
    }
    assert_eq!((friction(0.0, &[]), friction(-0.2, &[])), (vec![], vec!["impulse-ratio"]));
    let passed = [(Key::Mass(Side::One), 1000.0), (Key::DeltaV(Side::One), 5.0), (Key::Mass(Side::Two), 2000.0)];
    assert!(said(&[passed[0], passed[1], passed[2], (Key::DeltaV(Side::Two), 2.5)]).is_empty());
    assert_eq!(said(&[passed[0], passed[1], passed[2], (Key::DeltaV(Side::Two), 2.6)]), ["reported"]);
    assert_eq!(said(&[passed[0], passed[1], (Key::ImpulseMagnitude, 5001.0)]), ["reported"]);
    let speeds = [(Key::ClosingSpeed, 10.0), (Key::SeparationSpeed, 1.0)];
    assert!(said(&[speeds[0], speeds[1], (Key::Restitution, 0.1)]).is_empty());
    assert_eq!(said(&[speeds[0], speeds[1], (Key::Restitution, 0.2)]), ["restitution"]);
    assert!(said(&[(Key::ImpulseRatio, 0.5), (Key::CriticalRatio, 0.6)]).is_empty());
    // Without a restitution it is at most 1.
    assert!(said(&[speeds[0], (Key::SeparationSpeed, 10.0)]).is_empty());
    assert_eq!(said(&[speeds[0], (Key::SeparationSpeed, 10.1)]), ["restitution"]);
    // W_n = −½ · 100 · (10 − 1).
    let of_normal = |impulse: f64, work: f64| said(&[speeds[0], speeds[1], (Key::NormalImpulse, impulse), (Key::NormalWork, work)]);
    assert!(of_normal(100.0, -450.0).is_empty() && of_normal(-100.0, -450.0).is_empty());
    assert_eq!((of_normal(100.0, -440.0), of_normal(100.0, 450.0)), (vec!["reported"], vec!["reported"; 2]));
    assert_eq!(said(&[(Key::NormalWork, 1.0)]), ["reported"]);
    // At a restitution of 1 it is rounding.
    assert!(said(&[(Key::NormalWork, 1e-14), (Key::TangentialWork, -100.0), (Key::EnergyLoss, 100.0)]).is_empty());
    let loss = [(Key::EnergyBefore, 500.0), (Key::EnergyLoss, 500.0)];
    assert!(said(&loss).is_empty());
    assert_eq!(said(&[loss[0], (Key::EnergyLoss, 501.0)]), ["reported"]);
    assert_eq!(said(&[loss[0], (Key::NormalWork, -400.0), (Key::TangentialWork, -101.0)]), ["reported"]);
    let told = |ratio: f64, critical: f64| {
        let mut record = Record::default();
        [(Key::ImpulseRatio, ratio), (Key::CriticalRatio, critical)].iter().for_each(|&(key, value)| record.set(key, value));
        check(&record, &Options::default()).of(Rule::BeyondCritical).map(|finding| finding.what.clone()).collect::<Vec<_>>()
    };
    for (ratio, critical) in [(0.75, 0.5), (-0.75, -0.5)] {
        let wanted = alloc::format!("the impulse ratio {ratio} is beyond the critical one, {critical}: 0.25 off, ");
        assert!(matches!(&told(ratio, critical)[..], [what] if what.starts_with(&wanted)), "{:?}, not {wanted}", told(ratio, critical));
        assert_eq!(said(&[(Key::ImpulseRatio, ratio), (Key::CriticalRatio, critical)]), ["beyond-critical"]);
        // Of the other sign it is possible, where the impulse that ends sliding would be tensile.
        let wanted =
            alloc::format!("the impulse ratio {} has the other sign than the critical one, {critical}, which is possible ", -ratio);
        assert!(matches!(&told(-ratio, critical)[..], [what] if what.starts_with(&wanted)), "{:?}, not {wanted}", told(-ratio, critical));
        assert!(said(&[(Key::ImpulseRatio, -ratio), (Key::CriticalRatio, critical)]).is_empty());
    }
}

#[test]
fn a_critical_ratio_of_either_sign_within_its_resolution_bounds_both() {
    let verdict = |ratio: f64, critical: f64, resolution: f64| {
        let resolution = Resolution::default().with_key(Key::CriticalRatio, resolution).with_key(Key::ReportedRatio, 0.05);
        let mut record = Record { resolution, ..Record::default() };
        [(Key::ReportedRatio, ratio), (Key::CriticalRatio, critical)].iter().for_each(|&(key, value)| record.set(key, value));
        check(&record, &Options::default()).verdict()
    };
    for side in [1.0, -1.0] {
        assert_eq!(verdict(side * 0.1, side * -0.1, 0.3), Verdict::Pass);
        assert_eq!(verdict(side * 0.1, side * -0.1, 0.01), Verdict::Warn);
        assert_eq!(verdict(side * 0.02, side * -0.1, 0.01), Verdict::Pass);
        assert_eq!(verdict(side * 0.5, side * -0.1, 0.3), Verdict::Fail);
        assert_eq!(verdict(side * 0.2, side * 0.1, 0.01), Verdict::Fail);
    }
}

#[test]
fn under_another_law_the_critical_ratio_bounds_nothing() {
    for law in [Law::Brach, Law::KudlichSlibar] {
        for ratio_kind in [RatioKind::Given, RatioKind::Critical] {
            let mut record = Record { model: Model { ratio_kind, law, ..Model::default() }, ..Record::default() };
            for (key, value) in [(Key::ImpulseRatio, 0.113), (Key::ReportedRatio, 0.113), (Key::CriticalRatio, 0.111)] {
                record.set(key, value);
            }
            assert_eq!(rules(&record).is_empty(), law == Law::KudlichSlibar, "{law:?} {ratio_kind:?}");
        }
    }
    // With a moment the impulse may wedge.
    let mut record = Record { moment: Some(5.0), ..Record::default() };
    [(Key::ReportedRatio, 0.113), (Key::CriticalRatio, 0.111)].iter().for_each(|&(key, value)| record.set(key, value));
    assert!(rules(&record).is_empty());
}

#[test]
fn a_wall_that_moves_does_work_that_is_not_lost() {
    // At 5 m/s it takes a car of a ton with it.
    let motion = |x: f64| State { velocity: Some(Xy { x, y: 0.0 }), yaw_rate: Some(0.0) };
    let one = Subject { mass: Some(1000.0), before: motion(0.0), after: motion(5.0), ..Subject::default() };
    let with = |wall: f64, loss: f64| {
        let two = Subject { before: State { velocity: Some(Xy { x: wall, y: 0.0 }), ..State::default() }, ..Subject::FIXED };
        let mut record = Record { one, two, ..Record::default() };
        for (key, value) in [(Key::EnergyBefore, 0.0), (Key::EnergyAfter, 12_500.0), (Key::EnergyLoss, loss)] {
            record.set(key, value);
        }
        rules(&record).contains(&"reported")
    };
    assert!(!with(5.0, 12_500.0));
    assert!(with(0.0, 12_500.0));
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
    // Without motions the work is what is claimed, below zero as it leaves the vehicle: ½ 2 · 3² = 9 J.
    let claimed = |work: f64| {
        let mut record = Record { two: Subject::FIXED, ..Record::default() };
        for (key, value) in [(Key::Mass(Side::One), 2.0), (Key::EquivalentEnergySpeed(Side::One), 3.0), (Key::NormalWork, work)] {
            record.set(key, value);
        }
        rules(&record)
    };
    assert!(claimed(-9.0).is_empty());
    // It may be all that is lost; less than the work of the normal impulse is possible, and rare.
    let verdict = |claims: &[(Key, f64)], two: Subject| {
        let mut record = Record { two, ..Record::default() };
        [(Key::Mass(Side::One), 1000.0), (Key::EquivalentEnergySpeed(Side::One), 10.0)]
            .iter()
            .chain(claims)
            .for_each(|&(key, value)| record.set(key, value));
        check(&record, &Options::default()).verdict()
    };
    let [normal, tangential, loss] = [Key::NormalWork, Key::TangentialWork, Key::EnergyLoss];
    for (claims, wanted) in [
        (&[(normal, -49_000.0)][..], Verdict::Pass),
        (&[(normal, -51_000.0)], Verdict::Warn),
        (&[(loss, 51_000.0)], Verdict::Pass),
        (&[(loss, 49_000.0)], Verdict::Warn),
        (&[(loss, 70_000.0), (tangential, -20_000.0)], Verdict::Pass),
        (&[(loss, 50_000.0), (tangential, -20_000.0)], Verdict::Pass),
        (&[(loss, 70_000.0), (tangential, -10_000.0)], Verdict::Fail),
        (&[(normal, -30_000.0), (tangential, -20_000.0)], Verdict::Pass),
        (&[(normal, -40_000.0), (tangential, -20_000.0)], Verdict::Fail),
    ] {
        assert_eq!(verdict(claims, Subject::FIXED), wanted, "{claims:?}");
    }
    // With two cars, the EES of one alone is at most all of it.
    let other = || Subject { mass: Some(1500.0), ..Subject::default() };
    for (claims, wanted) in [
        (&[(normal, -30_000.0)][..], Verdict::Pass),
        (&[(loss, 51_000.0)], Verdict::Pass),
        (&[(loss, 49_000.0)], Verdict::Warn),
        (&[(normal, -30_000.0), (tangential, -30_000.0)], Verdict::Pass),
        (&[(normal, -30_000.0), (tangential, -10_000.0)], Verdict::Fail),
        (&[(normal, -51_000.0), (tangential, 10_000.0)], Verdict::Pass),
    ] {
        assert_eq!(verdict(claims, other()), wanted, "{claims:?}");
    }
}

#[test]
fn restitution_of_both_components_is_another_law() {
    use crate::law::ImpulseRatio;
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

/// Returns the rules that claims without motions break.
fn broken(claims: &[(Key, f64)]) -> Vec<&'static str> {
    let mut record = Record::default();
    claims.iter().for_each(|&(key, value)| record.set(key, value));
    rules(&record)
}

#[test]
fn claims_without_motions_state_no_gain() {
    let (before, after) = (Key::EnergyBefore, Key::EnergyAfter);
    assert_eq!(broken(&[(before, 300.0), (after, 500.0)]), ["energy-gain"]);
    assert_eq!(broken(&[(before, 300.0), (after, 500.0), (Key::EnergyLoss, -200.0)]), ["energy-gain"]);
    assert_eq!(broken(&[(Key::EnergyLoss, -200.0)]), ["energy-gain"]);
    assert_eq!(broken(&[(Key::NormalWork, 300.0), (Key::TangentialWork, 100.0)]), ["energy-gain", "reported"]);
    assert!(broken(&[(before, 500.0), (after, 300.0), (Key::EnergyLoss, 200.0)]).is_empty());
    // The tangential impulse may give back a part.
    assert!(broken(&[(Key::NormalWork, -300.0), (Key::TangentialWork, 100.0)]).is_empty());
    // Of a large energy the loss is rounded as that is.
    assert!(broken(&[(before, 3e5), (after, 3e5), (Key::EnergyLoss, -1e-11)]).is_empty());
    // A wall that moves may give energy to what it hits; works are the same for every observer.
    let mut moving = Record {
        two: Subject { before: State { velocity: Some(Xy { x: -5.0, y: 0.0 }), yaw_rate: None }, ..Subject::FIXED },
        ..Record::default()
    };
    [(before, 300.0), (after, 500.0)].iter().for_each(|&(key, value)| moving.set(key, value));
    assert!(rules(&moving).is_empty());
    [(Key::NormalWork, 300.0), (Key::TangentialWork, 100.0)].iter().for_each(|&(key, value)| moving.set(key, value));
    assert_eq!(rules(&moving), ["energy-gain", "reported"]);
}

/// P_n = −10049 N s, 10.049 and 1.051 m/s make W_n = −45210 J. Printed, each number counts with its own digits.
#[test]
fn a_work_of_rounded_speeds_has_the_digits_of_all() {
    let printed = [
        (Key::NormalWork, -45_210.0, 0.5),
        (Key::ClosingSpeed, 10.0, 0.05),
        (Key::SeparationSpeed, 1.1, 0.05),
        (Key::NormalImpulse, -1e4, 50.0),
    ];
    let mut record = Record { profile: Profile::Printed, ..Record::default() };
    for (key, value, resolution) in printed {
        record.set(key, value);
        record.resolution = record.resolution.with_key(key, resolution);
    }
    assert!(rules(&record).is_empty());
    // They make ½ · 10 050 · 9 = 45 225 J at the most.
    record.set(Key::NormalWork, -45_800.0);
    assert_eq!(rules(&record), ["reported"]);
    record.set(Key::NormalWork, -43_200.0);
    assert_eq!(rules(&record), ["reported"]);
}

/// A closing speed of zero has no ratio to the other.
#[test]
fn a_restitution_of_no_closing_speed_is_checked_by_the_speeds() {
    let restitution = |parting| broken(&[(Key::Restitution, 0.5), (Key::ClosingSpeed, 0.0), (Key::SeparationSpeed, parting)]);
    assert!(restitution(0.0).is_empty());
    assert_eq!(restitution(0.1), ["restitution"]);
}

#[test]
fn lengths_and_speeds_are_not_negative() {
    let side = Side::Two;
    for key in [
        Key::ClosingSpeed,
        Key::SeparationSpeed,
        Key::ImpulseMagnitude,
        Key::DeltaV(side),
        Key::EquivalentEnergySpeed(side),
        Key::EnergyBefore,
        Key::EnergyAfter,
    ] {
        assert_eq!((broken(&[(key, -1.0)]), broken(&[(key, 0.0)])), (alloc::vec!["reported"], alloc::vec![]), "{key}");
    }
    // The rounding of what they are the difference of: of what is reported of the same measure, or of vehicles.
    assert!(broken(&[(Key::SeparationSpeed, -1e-13)]).is_empty() && broken(&[(Key::EnergyAfter, -1e-8)]).is_empty());
    assert!(broken(&[(Key::ClosingSpeed, 10.0), (Key::SeparationSpeed, -5e-9)]).is_empty());
    assert_eq!(broken(&[(Key::ClosingSpeed, 10.0), (Key::SeparationSpeed, -1e-7)]), ["reported"]);
    assert!(broken(&[(Key::EnergyBefore, 5e4), (Key::EnergyAfter, -1e-5)]).is_empty());
    assert_eq!(broken(&[(Key::EnergyBefore, 5e4), (Key::EnergyAfter, -1e-3)]), ["reported"]);
}

/// A body that stands after the impact has the rounding of its speed before, and its energy that of the energy before.
#[test]
fn an_energy_after_is_rounded_as_the_one_before() {
    let side = Side::One;
    let motions = |inertia: Option<f64>, before: Option<f64>, after: f64| {
        let mut record = Record { two: Subject::FIXED, ..Record::default() };
        let state = |v: f64| State { velocity: Some(Xy { x: v, y: 0.0 }), yaw_rate: Some(0.0) };
        record.one = Subject { mass: Some(1200.0), yaw_inertia: inertia, after: state(after), ..Subject::default() };
        record.one.before = before.map(state).unwrap_or_default();
        record
    };
    let rules_of = |mut record: Record, energy: f64| {
        record.set(Key::EnergyAfter, energy);
        rules(&record)
    };
    for inertia in [None, Some(2000.0)] {
        for before in [None, Some(-10.0)] {
            assert!(rules_of(motions(inertia, before, 1e-16), 0.0).is_empty(), "{inertia:?} {before:?}");
            assert_eq!(rules_of(motions(inertia, before, 0.1), 0.0), ["reported"], "{inertia:?} {before:?}");
        }
    }
    // So has the velocity change of a wall.
    let mut wall = motions(None, None, 0.0);
    wall.set(Key::DeltaV(Side::Two), 1e-16);
    assert!(rules(&wall).is_empty());
    wall.set(Key::DeltaV(Side::Two), 1e-3);
    assert_eq!(rules(&wall), ["reported"]);
    assert_eq!(wall.subject(side).mass, Some(1200.0));
}

/// Coarse motions leave more open of the work of the normal impulse than a printed loss says.
#[test]
fn an_equivalent_energy_speed_of_one_body_may_be_of_the_normal_work() {
    // By hand: 1000 kg lose 10 to 2 m/s along x at a wall; W_n = −48 kJ to 1.2 MJ by speeds to 1 m/s, and a loss of 47 kJ is printed.
    let of = |ees: f64, step: f64| {
        let mut record = Record { profile: Profile::Printed, two: Subject::FIXED, ..Record::default() };
        let state = |v: f64| State { velocity: Some(Xy { x: v, y: 0.0 }), yaw_rate: Some(0.0) };
        record.one = Subject {
            mass: Some(1000.0),
            yaw_inertia: Some(2000.0),
            center: Some(Xy { x: -2.0, y: 0.0 }),
            before: state(10.0),
            after: state(-2.0),
            ..Subject::default()
        };
        (record.point, record.normal_angle) = (Some(Xy { x: 0.0, y: 0.0 }), Some(0.0));
        record.set(Key::EnergyLoss, 47_500.0);
        record.set(Key::EquivalentEnergySpeed(Side::One), ees);
        record.resolution = Resolution::default().with(ResolutionGroup::Velocity, step).with_key(Key::EnergyLoss, 600.0);
        check(&record, &Options::default()).verdict() == Verdict::Fail
    };
    assert_eq!([(9.8, 0.001), (10.2, 0.001), (10.2, 0.5), (15.0, 0.5)].map(|(ees, step)| of(ees, step)), [false, true, false, true]);
}

#[test]
fn nothing_is_a_ratio_of_nothing() {
    let of = |n: f64, t: f64| broken(&[(Key::ImpulseRatio, 0.3), (Key::NormalImpulse, n), (Key::TangentialImpulse, t)]);
    assert!(of(0.0, 0.0).is_empty());
    assert_eq!((of(0.0, 5.0), of(10.0, 3.1)), (alloc::vec!["impulse-ratio"], alloc::vec!["impulse-ratio"]));
    // Elastic: no crush, and all that is lost is the work of friction.
    let mut elastic = Record { two: Subject::FIXED, ..Record::default() };
    [(Key::Mass(Side::One), 1000.0), (Key::EnergyLoss, 100.0), (Key::NormalWork, 0.0), (Key::EquivalentEnergySpeed(Side::One), 0.0)]
        .iter()
        .for_each(|&(key, value)| elastic.set(key, value));
    assert!(rules(&elastic).is_empty());
    elastic.set(Key::EquivalentEnergySpeed(Side::One), 2.0);
    assert_eq!(rules(&elastic), ["reported"]);
}

/// A finding about a ratio gives that of the impulse, and one about sliding says what has ended it.
#[test]
fn findings_about_a_ratio_give_that_of_the_impulse() {
    let told = |record: &Record| {
        let outcome = check(record, &Options::default());
        outcome.of(Rule::ImpulseRatio).map(|finding| finding.what.clone()).collect::<Vec<_>>().join("\n")
    };
    let mut claims = Record::default();
    [(Key::NormalImpulse, 8.0), (Key::TangentialImpulse, 2.0), (Key::ImpulseRatio, 0.5)]
        .into_iter()
        .for_each(|(key, value)| claims.set(key, value));
    assert!(told(&claims).contains("the impulse ratio is said to be 0.5, and the impulse has 0.25: "), "{}", told(&claims));
    // A car that slides along a wall, said to stop sliding there.
    use crate::collision::Collision;
    use crate::law::ImpulseRatio;
    use crate::vehicle::{Party, Vehicle};
    let car = Vehicle::new(1000.0, 2000.0).with_impact_center(2.0, 0.5).with_speed(10.0);
    let car = Vehicle { motion: crate::vehicle::Motion { velocity: crate::frame::Xy { x: 10.0, y: 4.0 }, yaw_rate: 0.0 }, ..car };
    let collision = Collision::new(car, Party::Barrier).with_impulse_ratio(ImpulseRatio::Given(0.0));
    for (law, says) in [(Law::Brach, "so sliding has ended, but "), (Law::KudlichSlibar, "so sliding and its restitution have ended, but ")]
    {
        let mut record = Record::of(&collision, &collision.evaluate());
        record.model.ratio_kind = RatioKind::Critical;
        record.model.law = law;
        assert!(told(&record).contains(says), "{law:?}: {}", told(&record));
    }
}
