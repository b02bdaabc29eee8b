//! What is claimed of the impulse is of one vector.

use super::refuted::with;
use super::*;
use alloc::vec;

use Side::{One, Two};

/// The impulse (−5000, 3000) N s on body 1 in ground axes, with the contact normal at 0.5 rad and bodies of 1000 and 1600 kg that head to 0.3 and 2.9 rad.
fn claim(key: Key) -> f64 {
    const P: [f64; 2] = [-5000.0, 3000.0];
    const NORMAL: f64 = 0.5;
    let (n, t) = (P[0] * NORMAL.cos() + P[1] * NORMAL.sin(), P[1] * NORMAL.cos() - P[0] * NORMAL.sin());
    let heading = |side| if side == One { 0.3 } else { 2.9 };
    let mass = |side| if side == One { 1000.0 } else { 1600.0 };
    let angle = P[1].atan2(P[0]);
    match key {
        Key::NormalAngle => NORMAL,
        Key::NormalImpulse => n,
        Key::TangentialImpulse => t,
        Key::ReportedRatio | Key::ImpulseRatio => t / n,
        Key::ImpulseX => P[0],
        Key::ImpulseY => P[1],
        Key::ImpulseMagnitude => P[0].hypot(P[1]),
        Key::Heading(side) => heading(side),
        Key::Mass(side) => mass(side),
        Key::DeltaV(side) => P[0].hypot(P[1]) / mass(side),
        // Clockwise from the heading to where the force comes from.
        Key::ForceDirection(One) => heading(One) - (angle + core::f64::consts::PI),
        Key::ForceDirection(Two) => heading(Two) - angle,
        other => panic!("{other}"),
    }
}

fn record(keys: &[Key]) -> Record {
    with(Record::default(), &keys.iter().map(|key| (*key, claim(*key))).collect::<Vec<_>>())
}

/// With each of them the others determine the impulse, or its direction; without it they are of some impulse, whatever its value is.
#[test]
fn one_vector_has_all_that_is_said_of_it() {
    use Key::{
        DeltaV, ForceDirection, Heading, ImpulseMagnitude, ImpulseRatio, ImpulseX, ImpulseY, Mass, NormalAngle, NormalImpulse,
        ReportedRatio, TangentialImpulse,
    };
    let sets: &[(&[Key], &[Key])] = &[
        (&[], &[NormalImpulse, TangentialImpulse, ImpulseMagnitude]),
        (&[], &[NormalImpulse, ReportedRatio, ImpulseMagnitude]),
        (&[], &[TangentialImpulse, ReportedRatio, ImpulseMagnitude]),
        (&[], &[NormalImpulse, ImpulseRatio, ImpulseMagnitude]),
        (&[], &[NormalImpulse, TangentialImpulse, ReportedRatio]),
        (&[], &[ImpulseX, ImpulseY, ImpulseMagnitude]),
        (&[], &[ImpulseX, ImpulseY, NormalImpulse, TangentialImpulse]),
        (&[Heading(One)], &[ForceDirection(One), ImpulseX, NormalImpulse, ReportedRatio]),
        (&[Mass(One)], &[NormalImpulse, ReportedRatio, DeltaV(One)]),
        (&[Mass(Two)], &[TangentialImpulse, ReportedRatio, DeltaV(Two)]),
        (&[Heading(One)], &[ForceDirection(One), ImpulseX, ImpulseY]),
        (&[Heading(Two)], &[ForceDirection(Two), ImpulseX, ImpulseMagnitude]),
        (&[Heading(One), Mass(Two)], &[ForceDirection(One), ImpulseY, DeltaV(Two)]),
        (&[Heading(One), Heading(Two)], &[ForceDirection(One), ForceDirection(Two)]),
        (&[NormalAngle], &[ImpulseX, ImpulseY, NormalImpulse]),
        (&[NormalAngle], &[ImpulseX, ImpulseY, TangentialImpulse]),
        (&[NormalAngle], &[NormalImpulse, TangentialImpulse, ImpulseX]),
        (&[NormalAngle], &[NormalImpulse, ImpulseY, ImpulseMagnitude]),
        (&[NormalAngle], &[TangentialImpulse, ImpulseX, ImpulseMagnitude]),
        (&[NormalAngle], &[ImpulseX, ImpulseY, ReportedRatio]),
        (&[NormalAngle], &[ImpulseX, ImpulseY, ImpulseRatio]),
        (&[NormalAngle], &[ImpulseX, ReportedRatio, ImpulseMagnitude]),
        (&[NormalAngle, Heading(One)], &[ForceDirection(One), ReportedRatio]),
        (&[NormalAngle, Heading(Two)], &[ForceDirection(Two), ImpulseRatio]),
        (&[NormalAngle, Heading(Two)], &[ForceDirection(Two), NormalImpulse, TangentialImpulse]),
        (&[NormalAngle, Heading(One), Mass(One)], &[ForceDirection(One), NormalImpulse, DeltaV(One)]),
    ];
    for (given, claims) in sets {
        let sound = record(&[*given, *claims].concat());
        assert!(rules(&sound).is_empty(), "{claims:?}: {:?}", check(&sound, &Options::default()));
        let rounded = Record {
            resolution: claims.iter().fold(Resolution::default(), |all, key| all.with_key(*key, 1e-3 * claim(*key).abs())),
            ..sound.clone()
        };
        for key in *claims {
            let changed = |record: &Record, factor: f64| with(record.clone(), &[(*key, factor * claim(*key))]);
            assert_ne!(rules(&changed(&sound, 1.02)), Vec::<&str>::new(), "{key} of {claims:?}");
            assert!(rules(&changed(&rounded, 1.000_9)).is_empty(), "{key} of {claims:?}");
            assert_ne!(rules(&changed(&rounded, 1.05)), Vec::<&str>::new(), "{key} of {claims:?}");
            // A line of either direction.
            let has_ratio = claims.iter().any(|key| matches!(key, ReportedRatio | ImpulseRatio));
            if matches!(key, ForceDirection(_)) && !has_ratio {
                let turned = with(sound.clone(), &[(*key, claim(*key) + core::f64::consts::PI)]);
                assert_ne!(rules(&turned), Vec::<&str>::new(), "{key} of {claims:?}");
            }
        }
    }
}

/// Lines that are parallel cross nowhere: along x and y there is no impulse beside one that comes from ahead.
#[test]
fn a_component_across_the_force_is_none() {
    let from_ahead =
        |key, value| rules(&with(Record::default(), &[(Key::Heading(One), 0.0), (Key::ForceDirection(One), 0.0), (key, value)]));
    assert_eq!(from_ahead(Key::ImpulseX, -5000.0), Vec::<&str>::new());
    assert_eq!(from_ahead(Key::ImpulseY, 0.0), Vec::<&str>::new());
    assert_eq!(
        [(Key::ImpulseX, 5000.0), (Key::ImpulseY, 5000.0)].map(|(key, value)| from_ahead(key, value)),
        [vec!["reported"], vec!["reported"]]
    );
}

/// Turned, so that x is along neither axis of the contact; and what is not known to be parallel is not taken for it.
#[test]
fn parallel_lines_are_so_to_the_last_digit() {
    let quarter = core::f64::consts::FRAC_PI_2;
    let along_y = |plane: Option<f64>, from: f64, x: f64| {
        let record = with(Record::default(), &[(Key::Heading(One), 0.0), (Key::ForceDirection(One), from), (Key::ImpulseX, x)]);
        Record { normal_angle: plane, ..record }
    };
    for plane in [None, Some(0.5), Some(-2.0)] {
        for from in [quarter, -quarter] {
            assert_eq!(rules(&along_y(plane, from, 0.0)), Vec::<&str>::new(), "{plane:?} {from}");
            assert_eq!(rules(&along_y(plane, from, 5000.0)), ["reported"], "{plane:?} {from}");
            // Along a direction that is off by this much, a long impulse has such a component.
            assert_eq!(rules(&along_y(plane, from + 1e-9, 5.0)), Vec::<&str>::new(), "{plane:?} {from}");
            let coarse = along_y(plane, from, 100.0);
            let coarse = Record { resolution: coarse.resolution.with_key(Key::ForceDirection(One), 0.02), ..coarse };
            assert_eq!(rules(&coarse), Vec::<&str>::new(), "{plane:?} {from}");
        }
    }
}

#[test]
fn findings_say_which_claims_disagree() {
    let said = |claims: &[(Key, f64)]| check(&with(Record::default(), claims), &Options::default()).findings[0].what.clone();
    let (n, t) = ((Key::NormalImpulse, 3000.0), (Key::TangentialImpulse, 4000.0));
    let ahead = [(Key::Heading(One), 0.0), (Key::ForceDirection(One), 0.0)];
    let moved = [(Key::BeforeX(Two), 4.0), (Key::BeforeY(Two), 0.0), (Key::AfterX(Two), 10.0), (Key::AfterY(Two), 0.0)];
    for (claims, words) in [
        (
            &[n, t, (Key::ImpulseMagnitude, 6000.0)][..],
            "the impulse and its length by reported.impulse.normal and reported.impulse.tangential of what is reported are 6000 N s and 5000 N s: 1000 off",
        ),
        (
            &[n, (Key::ReportedRatio, 0.5), t],
            "reported.impulse_ratio is said to be 0.5, and by reported.impulse.normal and reported.impulse.tangential it is 1.33333: 0.833333 off",
        ),
        (
            &[(Key::NormalAngle, 0.0), n, t, (Key::ImpulseX, 2000.0)],
            "reported.impulse.x is said to be 2000 N s, and by reported.impulse.normal and reported.impulse.tangential it is 3000 N s: 1000 off",
        ),
        (
            &[ahead[0], ahead[1], (Key::ImpulseY, 500.0)],
            "reported.impulse.y and the direction of force on body 1 are of no impulse: 500 N s off",
        ),
        (
            &[ahead[0], ahead[1], (Key::ImpulseX, 0.0), (Key::ImpulseY, -500.0)],
            "the force on body 1 is said to come from 0 rad clockwise of its heading, and the impulse by reported.impulse.x and reported.impulse.y gives -1.5708 rad",
        ),
        (
            &[moved[0], moved[1], moved[2], moved[3], (Key::ImpulseX, -500.0), (Key::ImpulseY, 30.0)],
            "reported.impulse.x and reported.impulse.y make an impulse that is not along the change of velocity of body 2: 30 N s off",
        ),
        (
            &[moved[0], moved[1], moved[2], moved[3], (Key::NormalAngle, 0.0), (Key::ReportedRatio, 0.25)],
            "reported.impulse_ratio is said to be 0.25, and by the change of velocity of body 2 it is 0: 0.25 off",
        ),
    ] {
        assert!(said(claims).starts_with(words), "{}", said(claims));
    }
}

/// Within a tolerance, lines that nearly agree cross far away: what follows from them errs by as much more.
#[test]
fn a_tolerance_is_of_what_the_lines_leave_open() {
    let said = |normal_angle: f64, x: f64| {
        let (n, m) = ((Key::NormalImpulse, 5000.0), (Key::ImpulseMagnitude, 6250.0));
        let record = with(Record::default(), &[(Key::NormalAngle, normal_angle), n, m, (Key::ImpulseX, x)]);
        rules(&Record { profile: Profile::Stepper, ..record })
    };
    // t = 3750 N s; x = n cos − t sin, and a change of 20 N s moves t by 20/sin.
    let x = |normal_angle: f64| 5000.0 * normal_angle.cos() - 3750.0 * normal_angle.sin();
    assert_eq!([said(0.02, x(0.02)), said(0.02, x(0.02) + 20.0)], [vec![], Vec::<&str>::new()]);
    assert_eq!([said(1.0, x(1.0)), said(1.0, x(1.0) + 500.0)], [vec![], vec!["reported"]]);
}

/// The change of velocity of a body without a mass has the direction of the force, on the other body too.
#[test]
fn a_change_of_velocity_has_the_direction_of_the_force() {
    let moved =
        |side, gain: f64| [(Key::BeforeX(side), 4.0), (Key::BeforeY(side), 0.0), (Key::AfterX(side), 4.0 + gain), (Key::AfterY(side), 0.0)];
    let said = |side, gain, claims: &[(Key, f64)]| rules(&with(with(Record::default(), &moved(side, gain)), claims));
    let (none, reported) = (Vec::<&str>::new(), vec!["reported"]);
    for (side, other, gain) in [(One, Two, 6.0), (Two, One, -6.0)] {
        let from = |direction: f64| said(side, gain, &[(Key::Heading(other), 0.0), (Key::ForceDirection(other), direction)]);
        // The other body loses velocity along x, or body 1 gains it.
        let ahead = if side == One { 0.0 } else { core::f64::consts::PI };
        assert_eq!(
            [from(ahead), from(ahead + 0.7), from(ahead + core::f64::consts::PI)],
            [none.clone(), reported.clone(), reported.clone()],
            "{side:?}"
        );
        let of_impulse = |x: f64, y: f64| said(side, gain, &[(Key::ImpulseX, x), (Key::ImpulseY, y)]);
        assert_eq!(
            [of_impulse(5000.0, 0.0), of_impulse(-5000.0, 0.0), of_impulse(5000.0, 900.0)],
            [none.clone(), reported.clone(), reported.clone()]
        );
        let ratio = |key, ratio: f64| said(side, gain, &[(Key::NormalAngle, 0.0), (key, ratio)]);
        assert_eq!([ratio(Key::ReportedRatio, 0.0), ratio(Key::ReportedRatio, 0.5)], [none.clone(), reported.clone()]);
        assert_eq!(ratio(Key::ImpulseRatio, 0.5), ["impulse-ratio"]);
    }
}

/// Speeds and a restitution that do not agree, of motions so coarse that any of them would.
#[test]
fn coarse_motions_excuse_no_claims() {
    let claims = |parting: f64| [(Key::ClosingSpeed, 10.0), (Key::SeparationSpeed, parting), (Key::Restitution, 0.25)];
    let fine = |resolution: Resolution| claims(0.0).iter().fold(resolution, |all, (key, _)| all.with_key(*key, 0.005));
    let body = |x: f64, before: f64, after: f64| Subject {
        mass: Some(1000.0),
        yaw_inertia: Some(1500.0),
        center: Some(Xy { x, y: 0.0 }),
        before: State { velocity: Some(Xy { x: before, y: 0.0 }), yaw_rate: Some(0.0) },
        after: State { velocity: Some(Xy { x: after, y: 0.0 }), yaw_rate: Some(0.0) },
        ..Subject::default()
    };
    let coarse = Record {
        one: body(-2.0, 10.0, 4.0),
        two: body(2.0, 0.0, 6.0),
        point: Some(Xy::zero()),
        normal_angle: Some(0.0),
        resolution: fine(Resolution::default().with(ResolutionGroup::Velocity, 0.5)),
        ..Record::default()
    };
    let alone = Record { resolution: fine(Resolution::default()), ..Record::default() };
    for record in [coarse, alone] {
        let said = |parting| rules(&with(record.clone(), &claims(parting)));
        assert_eq!((said(2.5), said(2.0)), (vec![], vec!["restitution"]));
    }
}

#[test]
fn a_ratio_below_the_friction_is_critical() {
    let said = |friction: f64, ratio: f64, critical: f64| {
        let model = Model { impulse_ratio: Some(friction), ratio_kind: RatioKind::Friction, ..Model::default() };
        rules(&with(Record { model, ..Record::default() }, &[(Key::ReportedRatio, ratio), (Key::CriticalRatio, critical)]))
    };
    for (friction, ratio, critical) in [(0.6, -0.5, -0.5), (0.3, -0.3, -0.5), (0.5, -0.5, -0.5), (0.3, 0.0, 0.0)] {
        assert!(said(friction, ratio, critical).is_empty(), "{friction} {ratio} {critical}");
    }
    assert_eq!([said(0.6, -0.2, -0.5), said(0.3, -0.2, -0.5)], [vec!["impulse-ratio"], vec!["impulse-ratio"]]);
}

/// W_n is at most ½ |P| (closing − separation speed), as |P_n| is at most |P|.
#[test]
fn no_work_is_above_that_of_the_whole_impulse() {
    let said = |work: f64, of: (Key, f64), mass: f64| {
        rules(&with(
            Record::default(),
            &[(Key::ClosingSpeed, 10.0), (Key::SeparationSpeed, 2.0), (Key::NormalWork, work), of, (Key::Mass(One), mass)],
        ))
    };
    let magnitude = (Key::ImpulseMagnitude, 1000.0);
    assert_eq!([said(-3999.0, magnitude, 500.0), said(-4100.0, magnitude, 500.0)], [vec![], vec!["reported"]]);
    assert_eq!([said(-3999.0, (Key::DeltaV(One), 2.0), 500.0), said(-4100.0, (Key::DeltaV(One), 2.0), 500.0)], [vec![], vec!["reported"]]);
}
