//! The checker: what is right raises no alarm, at any number of digits; what is wrong is found by name.

use crate::strategies::{Draw, draw};
use planar_impact::check::*;
use planar_impact::*;
use proptest::prelude::*;
use proptest::test_runner::Config;
use std::f64::consts::PI;

/// About as many draws are refused as are solved.
fn config() -> Config {
    Config { max_local_rejects: u32::MAX, ..crate::strategies::config() }
}

/// A collision that can be solved.
fn solved() -> impl Strategy<Value = Draw> {
    draw().prop_filter("refused", |draw| draw.of::<f64>().solve().is_ok())
}

/// Its record in f64.
fn record_of(draw: &Draw) -> Record {
    let collision = draw.of::<f64>();
    Record::of(&collision, &collision.evaluate())
}

fn failures(outcome: &Outcome) -> Vec<&Finding> {
    outcome.findings.iter().filter(|finding| finding.severity == Severity::Fail).collect()
}

/// A value rounded to a number of decimals, and half a unit of the last.
fn rounded(value: f64, decimals: i32) -> (f64, f64) {
    let unit = 10_f64.powi(-decimals);
    ((value / unit).round() * unit, unit / 2.0 * (1.0 + 1e-9))
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn what_is_solved_passes(draw in solved()) {
        let record = record_of(&draw);
        let outcome = check(&record, &Options::default());
        prop_assert!(failures(&outcome).is_empty(), "{outcome}");
        prop_assert_ne!(outcome.verdict(), Verdict::Undecidable);
    }

    #[test]
    fn rounded_digits_raise_no_alarm(draw in solved(), decimals in prop::collection::vec(-1..6_i32, Key::COUNT)) {
        let record = record_of(&draw);
        let mut printed = Record { profile: Profile::Printed, ..record.clone() };
        for (key, decimals) in Key::ALL.into_iter().zip(decimals) {
            let Some(value) = record.get(key) else { continue };
            let (value, resolution) = rounded(value, decimals);
            if matches!(key, Key::Mass(_) | Key::YawInertia(_)) && value <= 0.0 {
                continue;
            }
            printed.set(key, value);
            printed.resolution = printed.resolution.with_key(key, resolution);
        }
        let outcome = check(&printed, &Options::default());
        prop_assert!(failures(&outcome).is_empty(), "{outcome}");
    }
}

fn vehicle() -> impl Strategy<Value = Vehicle> {
    let size = (800.0..3000.0, 1.0..1.8, -PI..PI);
    let place = (-2.5..2.5, -1.0..1.0);
    let motion = (-30.0..30.0, -30.0..30.0, -2.0..2.0);
    (size, place, motion).prop_map(|((mass, gyration, heading), (forward, left), (x, y, yaw_rate))| Vehicle {
        mass,
        yaw_inertia: mass * gyration * gyration,
        heading: Heading::from_angle(heading),
        impact_center: ForwardLeft { forward, left },
        motion: Motion { velocity: Xy { x, y }, yaw_rate },
    })
}

/// A collision of two vehicles, or of one and a barrier, that could be anyone's. It may be impossible.
fn on_the_road() -> impl Strategy<Value = Collision> {
    let ratio = prop_oneof![
        Just(ImpulseRatio::Critical),
        (-1.0..1.0).prop_map(ImpulseRatio::Given),
        (0.0..1.0).prop_map(ImpulseRatio::OfCritical),
        (0.0..1.0).prop_map(ImpulseRatio::LimitedByFriction),
    ];
    let law = prop_oneof![Just(Law::Brach), Just(Law::KudlichSlibar)];
    (vehicle(), vehicle(), 0..5_u8, -PI..PI, 0.0..0.9, ratio, law).prop_map(
        |(one, two, barrier, angle, restitution, impulse_ratio, law)| Collision {
            one: if barrier == 1 { Party::Barrier } else { one.into() },
            two: if barrier == 2 { Party::Barrier } else { two.into() },
            crush_plane: CrushPlane::from_angle(angle),
            restitution,
            impulse_ratio,
            law,
            moment: Moment::None,
        },
    )
}

fn possible() -> impl Strategy<Value = Collision> {
    on_the_road().prop_filter("refused", |collision| collision.solve().is_ok())
}

fn is_found(record: &Record, rule: Rule) -> Result<(), TestCaseError> {
    let outcome = check(record, &Options::default());
    prop_assert!(outcome.of(rule).any(|finding| finding.severity == Severity::Fail), "{rule} is not among: {outcome}");
    Ok(())
}

/// Without what the program reports beside the motions: the laws alone must find it.
fn motions(record: &Record) -> Record {
    Record { reported: Reported::default(), ..record.clone() }
}

fn scaled(record: &Record, key: Key, factor: f64) -> Record {
    let mut wrong = record.clone();
    wrong.set(key, record.get(key).expect("it is known") * factor);
    wrong
}

const SIDES: [Side; 2] = [Side::One, Side::Two];

fn free(record: &Record) -> impl Iterator<Item = Side> {
    SIDES.into_iter().filter(|side| !record.subject(*side).fixed)
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn a_velocity_component_off_by_a_thousandth_is_found(collision in possible()) {
        let record = Record::of(&collision, &collision.evaluate());
        for side in free(&record) {
            for key in [Key::BeforeX(side), Key::BeforeY(side), Key::AfterX(side), Key::AfterY(side)] {
                prop_assume!(record.get(key).expect("known").abs() > 0.01);
                let wrong = scaled(&record, key, 1.001);
                if free(&record).count() == 2 {
                    is_found(&motions(&wrong), Rule::LinearMomentum)?;
                } else {
                    // A barrier takes any momentum; the energies that are reported do not fit.
                    is_found(&wrong, Rule::Reported)?;
                    let outcome = check(&motions(&wrong), &Options::default());
                    prop_assert_eq!(outcome.verdict(), Verdict::Fail, "{}", outcome);
                }
            }
        }
    }

    #[test]
    fn an_error_of_little_more_than_the_bound_is_found(collision in possible(), decimals in 0..4_i32, x in any::<bool>(), one in any::<bool>()) {
        let record = motions(&Record::of(&collision, &collision.evaluate()));
        prop_assume!(free(&record).count() == 2);
        let resolution = 10_f64.powi(-decimals) / 2.0;
        let mut printed = Record { resolution: Resolution::default().with(Measure::Velocity, resolution), ..record };
        for key in Key::ALL.into_iter().filter(|key| key.measure() == Measure::Velocity) {
            if let Some(value) = printed.get(key) {
                printed.set(key, rounded(value, decimals).0);
            }
        }
        let (m1, m2) = (printed.one.mass.expect("known"), printed.two.mass.expect("known"));
        // What the digits imply, before and after, for either body; as much again may be used up by the digits themselves.
        let bound = 2.0 * (m1 + m2) * resolution;
        let side = if one { Side::One } else { Side::Two };
        let key = if x { Key::AfterX(side) } else { Key::AfterY(side) };
        let off = 2.001 * bound / printed.subject(side).mass.expect("known");
        printed.set(key, printed.get(key).expect("known") + off);
        is_found(&printed, Rule::LinearMomentum)?;
    }

    #[test]
    fn a_yaw_rate_turned_around_or_in_degrees_is_found(collision in possible()) {
        let record = Record::of(&collision, &collision.evaluate());
        for side in free(&record) {
            for key in [Key::BeforeYawRate(side), Key::AfterYawRate(side)] {
                prop_assume!(record.get(key).expect("known").abs() > 1e-4);
                is_found(&motions(&scaled(&record, key, -1.0)), Rule::LineOfAction)?;
                is_found(&motions(&scaled(&record, key, 180.0 / PI)), Rule::LineOfAction)?;
                if free(&record).count() == 2 {
                    is_found(&motions(&scaled(&record, key, -1.0)), Rule::AngularMomentum)?;
                    // Without a contact point too.
                    let nowhere = Record { point: None, normal_angle: None, ..motions(&scaled(&record, key, -1.0)) };
                    is_found(&nowhere, Rule::AngularMomentum)?;
                }
            }
        }
    }

    #[test]
    fn swapped_masses_are_found(collision in possible()) {
        let record = Record::of(&collision, &collision.evaluate());
        prop_assume!(free(&record).count() == 2 && (record.one.mass.expect("known") / record.two.mass.expect("known")).ln().abs() > 1e-6);
        let mut wrong = motions(&record);
        (wrong.one.mass, wrong.two.mass) = (record.two.mass, record.one.mass);
        is_found(&wrong, Rule::LinearMomentum)?;
    }

    #[test]
    fn a_wrong_restitution_is_found(collision in possible(), by in 1e-6..0.1, above in 1.001..3.0) {
        let record = motions(&Record::of(&collision, &collision.evaluate()));
        let with = |e: f64| Record { model: Model { restitution: Some(e), ..record.model }, ..record.clone() };
        is_found(&with(collision.restitution + by), Rule::Restitution)?;
        is_found(&with(above), Rule::Restitution)?;
        is_found(&with(0.0 - by), Rule::Restitution)?;
        // An impact that was computed with it, and says so or not.
        let wild = Collision { restitution: above, ..collision };
        let mut record = motions(&Record::of(&wild, &wild.evaluate()));
        is_found(&record, Rule::Restitution)?;
        record.model.restitution = None;
        is_found(&record, Rule::Restitution)?;
    }

    #[test]
    fn a_gain_of_energy_is_found(collision in on_the_road(), restitution in 0.0..2.0) {
        let wild = Collision { restitution, ..collision };
        let impact = wild.evaluate();
        prop_assume!(impact.loss() < -1e-6 * impact.kinetic_energy.before);
        let record = motions(&Record::of(&wild, &impact));
        is_found(&record, Rule::EnergyGain)?;
        is_found(&Record { point: None, normal_angle: None, model: Model::default(), ..record }, Rule::EnergyGain)?;
    }

    #[test]
    fn a_moved_contact_is_found(collision in possible(), by in 0.01..1.0) {
        let impact = collision.evaluate();
        let mut wrong = motions(&Record::of(&collision, &impact));
        let across = impact.impulse_on_ground.quarter_turn();
        wrong.point = Some(across * (by / across.length()));
        is_found(&wrong, Rule::LineOfAction)?;
    }

    #[test]
    fn a_turned_normal_is_found(collision in possible(), by in 0.01..3.0) {
        // At common velocity nothing depends on the normal, nor with a restitution of both components.
        prop_assume!(collision.restitution > 0.01 && collision.law == Law::Brach);
        let record = motions(&Record::of(&collision, &collision.evaluate()));
        let wrong = scaled(&Record { normal_angle: Some(1.0), ..record.clone() }, Key::NormalAngle, collision.crush_plane.angle() + by);
        let outcome = check(&wrong, &Options::default());
        prop_assert_eq!(outcome.verdict(), Verdict::Fail, "{}", outcome);
        // Either of its directions is right.
        let around = Record { normal_angle: Some(collision.crush_plane.angle() + PI), ..record };
        let outcome = check(&around, &Options::default());
        prop_assert!(outcome.findings.iter().all(|finding| finding.severity == Severity::Warn), "{outcome}");
    }

    #[test]
    fn an_impulse_that_pulls_or_goes_too_far_is_found(collision in on_the_road(), ratio in -3.0..3.0) {
        let wild = Collision { impulse_ratio: ImpulseRatio::Given(ratio), ..collision };
        let impact = wild.evaluate();
        let record = motions(&Record::of(&wild, &impact));
        for refusal in wild.solve().err().iter().flat_map(|refusals| refusals.reasons()) {
            match refusal {
                Refusal::NotClosing { .. } => is_found(&record, Rule::Compressive)?,
                Refusal::Tensile { reason: Tension::Pulls, .. } => is_found(&record, Rule::Compressive)?,
                Refusal::BeyondCritical { .. } => is_found(&record, Rule::BeyondCritical)?,
                Refusal::EnergyGain { .. } => is_found(&record, Rule::EnergyGain)?,
                _ => (),
            }
        }
    }

    #[test]
    fn an_impact_that_did_not_take_place_is_found(collision in possible()) {
        let mut wrong = motions(&Record::of(&collision, &collision.evaluate()));
        (wrong.one.after, wrong.two.after) = (wrong.one.before, wrong.two.before);
        is_found(&wrong, Rule::Interpenetration)?;
    }

    #[test]
    fn a_wrong_ratio_is_found(collision in possible(), by in 1e-5..1.0) {
        let record = motions(&Record::of(&collision, &collision.evaluate()));
        let wrong = Record { model: Model { impulse_ratio: record.model.impulse_ratio.map(|ratio| ratio - by), ..record.model }, ..record.clone() };
        // Friction may be less than it says where the bodies stick.
        prop_assume!(record.model.ratio_kind != RatioKind::Friction);
        let sticking = Collision { impulse_ratio: ImpulseRatio::Critical, ..collision }.evaluate().impulse;
        prop_assume!(record.model.ratio_kind != RatioKind::OfCritical || sticking.t.abs() > 0.01 * sticking.length());
        is_found(&wrong, Rule::ImpulseRatio)?;
    }

    #[test]
    fn a_wrong_result_is_found(collision in possible(), by in prop_oneof![Just(1.001), Just(-1.0), 0.5..0.999]) {
        let impact = collision.evaluate();
        let mut record = Record::of(&collision, &impact);
        for (side, party) in SIDES.into_iter().zip([&collision.one, &collision.two]) {
            // All of the normal work in the one body.
            if let Some(vehicle) = party.vehicle().filter(|_| free(&record).count() == 1) {
                record.reported.ees[side as usize] = Some((-2.0 * impact.work.n / vehicle.mass).sqrt());
            }
        }
        check(&record, &Options::default()).assert();
        for key in Key::ALL.into_iter().filter(|key| key.name().starts_with("reported.")) {
            let Some(value) = record.get(key).filter(|value| value.abs() > 1e-3) else { continue };
            let of = [(Key::NormalWork, impact.work.n), (Key::TangentialWork, impact.work.t), (Key::EnergyLoss, impact.loss())];
            // A billionth of the whole may be off in a small part.
            let whole = impact.kinetic_energy.before.max(impact.work.n.abs());
            prop_assume!(of.iter().all(|(of, part)| *of != key || part.abs() > 1e-5 * whole));
            prop_assume!(value.abs() > 1e-5 * impact.impulse.length() || key.measure() != Measure::Impulse);
            if matches!(key, Key::EquivalentEnergySpeed(_)) && by < 0.0 {
                continue; // a square
            }
            is_found(&scaled(&record, key, by), Rule::Reported)?;
        }
    }
}
