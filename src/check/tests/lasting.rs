//! Contacts that last.

use super::*;

/// The long contact without the places after it.
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

/// A force of (165, −10) kN for 0.1 s, at a point that goes with the body from (−2, 0.5) to (−2.5, 0.3), by hand: its moment about the center of mass falls evenly
/// from (−2)(−10) − 0.5 · 165 to (−2.05)(−10) − 0.0333 · 165 kN m. Where the place before is left out, it may be anywhere within the way of the body.
#[test]
fn a_place_that_is_left_out_of_a_long_contact_is_no_failure() {
    let state = |x, y, yaw_rate| State { velocity: Some(Xy { x, y }), yaw_rate: Some(yaw_rate) };
    let record = |point| Record {
        one: Subject {
            mass: Some(1500.0),
            yaw_inertia: Some(2500.0),
            center: Some(Xy { x: 0.0, y: 0.0 }),
            center_after: Some(Xy { x: -0.45, y: 0.26666666666666666 }),
            before: state(-10.0, 3.0, 0.0),
            after: state(1.0, 7.0 / 3.0, -0.95),
            ..Subject::default()
        },
        two: Subject::FIXED,
        point,
        point_after: Some(Xy { x: -2.5, y: 0.3 }),
        normal_angle: Some(0.0),
        duration: Some(0.1),
        ..Record::default()
    };
    assert!(rules(&record(Some(Xy { x: -2.0, y: 0.5 }))).is_empty() && rules(&record(None)).is_empty());
    let mut without_center = record(Some(Xy { x: -2.0, y: 0.5 }));
    without_center.one.center = None;
    assert!(rules(&without_center).is_empty());
    // A center of mass that moved says without a duration that the contact lasts; of an instant the place after is the one before.
    let mut instant = Record { duration: None, ..record(None) };
    assert!(rules(&instant).is_empty() && warnings(&instant).contains(&"work-identity"), "{:?}", warnings(&instant));
    instant.one.center_after = instant.one.center;
    assert_eq!(rules(&instant), ["work-identity"]);
}

/// By hand: P = −6000 N s acts on body 2 at (0, 0), and I ΔΩ = −600 N m s; with center of mass 2 at (2.3, 0) and 1 at (−1.3, 0.2) after the impact
/// Σ (c × m V + I Ω) is 600 − 600 more than before.
#[test]
fn a_center_of_mass_that_moved_says_that_the_contact_lasts() {
    let body = |x, after, yaw_rate, center_after: Option<(f64, f64)>, before| Subject {
        mass: Some(1000.0),
        yaw_inertia: Some(2000.0),
        center: Some(Xy { x, y: 0.0 }),
        center_after: center_after.map(|(x, y)| Xy { x, y }),
        before: State { velocity: Some(before), yaw_rate: Some(0.0) },
        after: State { velocity: Some(after), yaw_rate: Some(yaw_rate) },
        ..Subject::default()
    };
    let one = |places| body(-2.0, Xy { x: 4.0, y: 2.0 }, 0.0, places, Xy { x: 10.0, y: 2.0 });
    let two = |places| body(2.0, Xy { x: 6.0, y: 0.0 }, -0.3, places, Xy { x: 0.0, y: 0.0 });
    let record = |of_one, of_two| Record { one: one(of_one), two: two(of_two), point: Some(Xy { x: 0.0, y: 0.0 }), ..Record::default() };
    let (after_one, after_two) = (Some((-1.3, 0.2)), Some((2.3, 0.0)));
    for (of_one, of_two) in [(after_one, after_two), (after_one, None), (None, after_two)] {
        let lasting = record(of_one, of_two);
        assert!(rules(&lasting).is_empty() && warnings(&lasting).contains(&"line-of-action"), "{:?}", rules(&lasting));
    }
    for still in [record(None, None), record(Some((-2.0, 0.0)), None)] {
        assert_eq!(rules(&still), ["angular-momentum", "line-of-action"]);
    }
}

/// What is slow after the impact says nothing of how far it moved: at 4 m/s for 0.01 s and 1 rad/s, it is 0.04 m/s at the contact, where 0.3 m/s are missing.
#[test]
fn a_velocity_that_is_left_out_bounds_no_motion_during_a_contact() {
    let record = |before| Record {
        one: Subject {
            center: Some(Xy { x: -2.0, y: 0.0 }),
            before: State { velocity: before, yaw_rate: Some(0.0) },
            after: State { velocity: Some(Xy { x: 0.0, y: 0.1 }), yaw_rate: Some(1.0) },
            ..Subject::default()
        },
        two: Subject::FIXED,
        point: Some(Xy { x: 0.0, y: 0.1 }),
        normal_angle: Some(0.0),
        duration: Some(0.01),
        model: Model { restitution: Some(0.1), ..Model::default() },
        reported: Reported { closing_speed: Some(4.0), ..Reported::default() },
        ..Record::default()
    };
    let unknown = record(None);
    assert_eq!((rules(&unknown), warnings(&unknown)), (Vec::new(), vec!["restitution"]));
    let known = record(Some(Xy { x: 4.0, y: 0.1 }));
    assert_eq!(rules(&known), ["restitution"]);
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

/// By hand: 1000 kg and 1500 kg m² lose ½ 1000 (10² − 1²) − ½ 1500 · 3² J, and by the impulse at one instant 41 250 J. Without the inertia only the works tell a loss.
#[test]
fn a_loss_by_works_is_that_of_an_instant() {
    let to = |digit: f64, loss: f64, inertia: Option<f64>, duration: Option<f64>| {
        let mut record = Record { two: Subject::FIXED, duration, ..Record::default() };
        if digit > 0.0 {
            record.resolution = Resolution::default().with_key(Key::YawInertia(Side::One), digit);
        }
        let state = |x, yaw_rate| State { velocity: Some(Xy { x, y: 0.0 }), yaw_rate: Some(yaw_rate) };
        record.one = Subject {
            mass: Some(1000.0),
            yaw_inertia: inertia,
            center: Some(Xy { x: -2.0, y: 0.5 }),
            before: state(10.0, 0.0),
            after: state(-1.0, -3.0),
            ..Subject::default()
        };
        (record.point, record.normal_angle) = (Some(Xy { x: 0.0, y: 0.0 }), Some(0.0));
        record.set(Key::EnergyLoss, loss);
        let found = check(&record, &Options::default());
        found.of(Rule::Reported).map(|finding| finding.severity).next()
    };
    let of = |loss, inertia, duration| to(0.0, loss, inertia, duration);
    // Known by the works to more digits, which are of no use here.
    assert_eq!((of(42_750.0, Some(1500.0), Some(0.1)), to(300.0, 42_750.0, Some(1500.0), Some(0.1))), (None, None));
    assert_eq!(of(42_750.0, None, Some(0.1)), Some(Severity::Warn));
    assert_eq!((of(41_250.0, None, None), of(42_750.0, None, None)), (None, Some(Severity::Fail)));
    assert_eq!(of(90_000.0, None, Some(0.1)), Some(Severity::Fail));
}

/// Without the velocity of the other body nothing bounds how far the contact moves.
#[test]
fn an_unknown_motion_during_a_contact_may_explain_any_spin() {
    let mut record = long_contact();
    (record.one.center_after, record.point_after) = (None, None);
    (record.two.before, record.two.after) = Default::default();
    record.set(Key::AfterYawRate(Side::One), 0.5);
    let found = check(&record, &Options::default());
    let told: Vec<_> =
        found.of(Rule::LineOfAction).map(|finding| (finding.severity, finding.what.contains("which may explain it:"))).collect();
    assert_eq!(told, [(Severity::Warn, true)], "{found}");
}

#[test]
fn a_duration_is_at_least_zero_and_that_of_an_impact() {
    assert_eq!(rules(&Record { duration: Some(-0.1), ..long_contact() }), ["finite"]);
    let of_vehicles = |duration| warnings(&Record { duration: Some(duration), ..Record::default() });
    assert!(of_vehicles(0.15).is_empty());
    assert_eq!(of_vehicles(150.0), ["plausible-units"]);
}
