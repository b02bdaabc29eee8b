//! Records with more and fewer numbers.

mod assertion;
mod balance;
mod claimed_impulse;
mod claims;
mod implied;
mod lasting;
mod refuted;

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

/// Two cars that stick together, with a share of the critical ratio that is half of the true one: wherever the origin is, and for any precision of the numbers.
#[test]
fn a_law_holds_wherever_the_origin_is() {
    let collision = crate::Collision::new(
        crate::Vehicle::new(1500.0, 2500.0).with_impact_center(1.0, -0.5).with_velocity(Xy { x: 10.0, y: 12.0 }),
        crate::Vehicle::new(1000.0, 1500.0).with_impact_center(-1.5, 0.5).with_velocity(Xy { x: -5.0, y: 0.0 }),
    );
    let solved = Record::of(&collision, &collision.solve().expect("possible"));
    for (profile, offsets) in [(Profile::Impulse, &[0.0, 30.0, 1e3, 1e6][..]), (Profile::StepperF32, &[0.0, 30.0, 1e3][..])] {
        for offset in offsets {
            let at = |place: Option<Xy>| place.map(|place| Xy { x: place.x + offset, y: place.y - offset });
            let mut record = Record { profile, point: at(solved.point), ..solved.clone() };
            (record.one.center, record.two.center) = (at(solved.one.center), at(solved.two.center));
            let share = |share: f64| {
                let model = Model { impulse_ratio: Some(share), ratio_kind: RatioKind::OfCritical, ..record.model };
                rules(&Record { model, ..record.clone() })
            };
            assert_eq!((share(1.0), share(0.5)), (alloc::vec![], alloc::vec!["impulse-ratio"]), "{profile:?}, {offset} m");
            let ratio = solved.reported.critical_impulse_ratio.expect("a ratio");
            let claims = |ratio: f64| {
                rules(&Record { reported: Reported { critical_impulse_ratio: Some(ratio), ..Reported::default() }, ..record.clone() })
            };
            assert_eq!((claims(ratio), claims(1.2 * ratio)), (alloc::vec![], alloc::vec!["reported"]), "{profile:?}, {offset} m");
        }
    }
}

/// Centers of mass within the rounding of their places: the less is known of them, the less can be said.
#[test]
fn sides_within_rounding_are_undecidable() {
    let verdicts = [Profile::Impulse, Profile::StepperF32].map(|profile| {
        let mut record = Record {
            profile,
            two: Subject::FIXED,
            normal_angle: Some(0.0),
            point: Some(Xy { x: 100.0001, y: 100.0 }),
            ..Record::default()
        };
        record.one.center = Some(Xy { x: 100.0, y: 101.0 });
        (record.one.before, record.one.after) = (
            State { velocity: Some(Xy { x: 10.0, y: 0.0 }), yaw_rate: Some(0.0) },
            State { velocity: Some(Xy { x: 5.0, y: 0.0 }), yaw_rate: Some(0.0) },
        );
        let exact = Record { point: Some(Xy { x: 100.0, y: 100.0 }), ..record.clone() };
        [record, exact].map(|record| check(&record, &Options::default()).of(Rule::Compressive).next().map(|finding| finding.severity))
    });
    assert_eq!(verdicts, [[None, Some(Severity::Fail)], [Some(Severity::Undecidable), Some(Severity::Fail)]]);
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
        Rule::BeyondCritical,
        Rule::WorkIdentity,
        Rule::Group,
    ];
    // The restitution is still checked, which must be between 0 and 1, and the ratio of the impulse, which masses, velocities and the normal tell.
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
    // It has one velocity, whichever is given.
    (moving.two.before.velocity, moving.two.after.velocity) = (None, Some(by));
    assert!(rules(&moving).is_empty());
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

/// At a restitution of 1 works and losses are the rounding of energies, or of an impulse times a speed: nothing is wrong with 4·10⁻¹¹ J beside 741 559 J, in either
/// sign, and a joule is.
#[test]
fn works_of_an_elastic_impact_are_rounding() {
    let model = Model { restitution: Some(1.0), ..Model::default() };
    let of = |reported: Reported| Record { profile: Profile::Impulse, model, reported, ..Record::default() };
    let of_energies = |work| {
        of(Reported {
            kinetic_energy_before: Some(741_559.0),
            kinetic_energy_after: Some(741_559.0),
            energy_loss: Some(0.0),
            work_normal: Some(work),
            work_tangential: Some(0.0),
            ..Reported::default()
        })
    };
    let of_speeds = |work| {
        of(Reported {
            closing_speed: Some(10.0),
            impulse: ReportedImpulse { normal: Some(1000.0), ..Default::default() },
            work_normal: Some(work),
            ..Reported::default()
        })
    };
    for (work, verdict) in [(4.3e-11, Verdict::Pass), (-4.3e-11, Verdict::Pass), (1.0, Verdict::Fail)] {
        assert_eq!(check(&of_energies(work), &Options::default()).verdict(), verdict, "{work}");
    }
    for (work, verdict) in [(1e-12, Verdict::Pass), (1.0, Verdict::Fail)] {
        assert_eq!(check(&of_speeds(work), &Options::default()).verdict(), verdict, "{work}");
    }
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

/// A vehicle that meets a barrier straight ahead of its center of mass at Γ and does not turn: of K_nn + μ K_nt = 1/m the parts are 1/m + 2 (r sin Γ)²/I.
#[test]
fn a_pair_that_nearly_wedges_passes_with_the_rounding_of_its_impulse() {
    use crate::collision::Collision;
    use crate::frame::{CrushPlane, Heading};
    use crate::vehicle::{Party, Vehicle};
    let mut worst: f64 = 1.0;
    for k in 1..=40 {
        let (angle, radius) = (0.01 * f64::from(k) + 0.2, 1e-4 * f64::from(k));
        let vehicle = Vehicle::new(1000.0, 1000.0 * radius * radius).with_heading(Heading::from_angle(0.3)).with_impact_center(2.0, 0.0);
        let collision = Collision::new(vehicle.with_speed(10.0), Party::Barrier).with_crush_plane(CrushPlane::from_angle(0.3 + angle));
        let impact = collision.solve().expect("a collision");
        let outcome = check(&Record::of(&collision, &impact), &Options::default());
        assert_ne!(outcome.verdict(), Verdict::Fail, "{outcome}");
        let warned =
            outcome.of(Rule::ImpulseRatio).map(|finding| finding.what.as_str()).find(|what| what.starts_with("the pair nearly wedges"));
        assert!(warned.is_some(), "{outcome}");
        worst = worst.min(collision.contact().compliance.wedging_share(impact.impulse.t / impact.impulse.n));
    }
    assert!(worst < 1e-6, "{worst}");
}

#[test]
fn a_tangential_impulse_that_goes_too_far_is_told_with_the_critical_ratio() {
    use crate::collision::Collision;
    use crate::law::ImpulseRatio;
    use crate::vehicle::{Motion, Party, Vehicle};
    let motion = Motion { velocity: Xy { x: 10.0, y: -6.0 }, yaw_rate: 0.0 };
    let base = Collision::new(Vehicle { motion, ..Vehicle::new(1000.0, 2000.0).with_impact_center(2.0, 0.5) }, Party::Barrier);
    let critical = base.evaluate().critical_impulse_ratio();
    let told = |share: f64| {
        let collision = Collision { impulse_ratio: ImpulseRatio::Given(share * critical), ..base };
        let outcome = check(&Record::of(&collision, &collision.evaluate()), &Options::default());
        outcome.of(Rule::BeyondCritical).map(|finding| finding.what.clone()).collect::<Vec<_>>()
    };
    let digits = |x: f64| alloc::format!("{}", super::format::Digits(x));
    let beyond = alloc::format!("the impulse ratio {} is beyond the critical one, {}: ", digits(1.5 * critical), digits(critical));
    assert!(told(1.5)[0].starts_with(&beyond), "{:?}, not {beyond}", told(1.5));
    let other =
        alloc::format!("the impulse ratio {} has the other sign than the critical one, {}: ", digits(-0.5 * critical), digits(critical));
    assert!(told(-0.5)[0].starts_with(&other), "{:?}, not {other}", told(-0.5));
    assert!(told(0.5).is_empty() && told(1.0).is_empty());
}
