//! The checker: correct records raise no alarm with any number of digits; wrong ones are found by name.

use crate::strategies::{Draw, OrReject, config, solved};
use planar_impact::check::*;
use planar_impact::*;
use proptest::prelude::*;
use std::f64::consts::PI;

/// Generates a collision with a moment impulse that can be solved.
fn solved_with_moment() -> impl Strategy<Value = Collision> {
    let moment = prop_oneof![
        (-40..=40_i32).prop_map(|m| Moment::Given(f64::from(m) / 4.0)),
        (0..=8).prop_map(|f| Moment::OfCritical(f64::from(f) / 8.0))
    ];
    (solved(), moment)
        .prop_map(|(draw, moment)| Collision { moment, ..draw.of::<f64>() })
        .prop_filter("refused", |collision| collision.solve().is_ok())
}

/// Returns its record in f64.
fn record_of(draw: &Draw) -> Record {
    let collision = draw.of::<f64>();
    Record::of(&collision, &collision.evaluate())
}

fn failures(outcome: &Outcome) -> Vec<&Finding> {
    outcome.findings.iter().filter(|finding| finding.severity == Severity::Fail).collect()
}

/// Returns a value rounded to a number of decimals, and half a unit of the last one.
fn rounded(value: f64, decimals: i32) -> (f64, f64) {
    let unit = 10_f64.powi(-decimals);
    ((value / unit).round() * unit, unit / 2.0 * (1.0 + 1e-9))
}

/// Returns a record with its numbers printed to some decimals each; those without stay as they are.
fn printed(record: &Record, decimals: impl Fn(Key) -> Option<i32>) -> Record {
    let mut printed = Record { profile: Profile::Printed, ..record.clone() };
    for key in Key::ALL {
        let Some((value, decimals)) = record.get(key).zip(decimals(key)) else { continue };
        let (value, resolution) = rounded(value, decimals);
        printed.set(key, value);
        printed.resolution = printed.resolution.with_key(key, resolution);
    }
    printed
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
    fn what_is_solved_with_a_moment_passes(collision in solved_with_moment(), decimals in 0..6_i32) {
        let record = Record::of(&collision, &collision.evaluate());
        let outcome = check(&record, &Options::default());
        prop_assert!(failures(&outcome).is_empty(), "{outcome}");
        prop_assert_ne!(outcome.verdict(), Verdict::Undecidable);
        // Nor do rounded digits raise an alarm.
        let printed = printed(&record, |_| Some(decimals));
        let outcome = check(&printed, &Options::default());
        prop_assert!(failures(&outcome).is_empty(), "{outcome}");
    }

    #[test]
    fn rounded_digits_raise_no_alarm(draw in solved(), decimals in prop::collection::vec(-1..6_i32, Key::COUNT)) {
        let record = record_of(&draw);
        // A mass or a yaw inertia stays as it is if no digit of it would be left.
        let printed = printed(&record, |key| {
            let decimals = decimals[key.index()];
            let vanishes = |value| rounded(value, decimals).0 <= 0.0;
            let is_inertia = matches!(key, Key::Mass(_) | Key::YawInertia(_));
            (!is_inertia || !record.get(key).is_some_and(vanishes)).then_some(decimals)
        });
        let outcome = check(&printed, &Options::default());
        prop_assert!(failures(&outcome).is_empty(), "{outcome}");
    }

    /// Where motions are missing, results are held against each other: each formula has the resolution of all its numbers.
    #[test]
    fn rounded_results_without_motions_raise_no_alarm(
        collision in possible(),
        decimals in prop::collection::vec(-1..4_i32, Key::COUNT),
        kept in prop::collection::vec(prop::bool::weighted(0.7), Key::COUNT),
    ) {
        let whole = Record::of(&collision, &collision.evaluate());
        let given = motions(&whole);
        let is_scalar = |key| matches!(key, Key::Mass(_) | Key::Restitution | Key::ImpulseRatio | Key::NormalAngle);
        let record = parts(&whole, |key| kept[key.index()] && (is_scalar(key) || given.get(key).is_none()));
        let printed = printed(&record, |key| (!matches!(key, Key::Mass(_))).then(|| decimals[key.index()]));
        let outcome = check(&printed, &Options::default());
        prop_assert!(failures(&outcome).is_empty(), "{outcome}");
    }

    /// Whatever a program leaves out of its motions, results and places.
    #[test]
    fn parts_of_what_is_solved_raise_no_alarm(
        collision in possible(),
        decimals in prop::collection::vec(0..5_i32, Key::COUNT),
        kept in prop::collection::vec(prop::bool::weighted(0.8), Key::COUNT),
        print in any::<bool>(),
    ) {
        let mut whole = Record::of(&collision, &collision.evaluate());
        for (side, party) in SIDES.into_iter().zip([&collision.one, &collision.two]) {
            if let Some(vehicle) = party.vehicle() {
                whole.set(Key::Heading(side), vehicle.heading.angle());
            }
        }
        let record = parts(&whole, |key| kept[key.index()]);
        let record = if print { printed(&record, |key| (!matches!(key, Key::Mass(_) | Key::YawInertia(_))).then(|| decimals[key.index()])) } else { record };
        let outcome = check(&record, &Options::default());
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

/// Generates a realistic collision of two vehicles, or of one and a barrier. It may be impossible.
fn on_the_road() -> impl Strategy<Value = Collision> {
    let ratio = prop_oneof![
        Just(ImpulseRatio::Critical),
        (-1.0..1.0).prop_map(ImpulseRatio::Given),
        (0.0..1.0).prop_map(ImpulseRatio::OfCritical),
        (0.0..1.0).prop_map(ImpulseRatio::LimitedByFriction),
    ];
    let law = prop_oneof![Just(Law::Brach), Just(Law::KudlichSlibar)];
    (vehicle(), vehicle(), 0..8_u8, -PI..PI, 0.0..0.9, ratio, law).prop_map(
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

/// Reverses every motion if the vehicles are separating, so that they approach each other.
fn closing(mut collision: Collision) -> Collision {
    let contact = collision.contact();
    if contact.approach.n * contact.offset().n >= 0.0 {
        for party in [&mut collision.one, &mut collision.two] {
            if let Party::Vehicle(Vehicle { motion, .. }) = party {
                *motion = Motion { velocity: -motion.velocity, yaw_rate: -motion.yaw_rate };
            }
        }
    }
    collision
}

/// Generates a collision that can be solved after a change.
fn possible_as(change: fn(Collision) -> Collision) -> impl Strategy<Value = Collision> {
    on_the_road().prop_map(move |collision| closing(change(collision))).prop_filter("refused", |collision| collision.solve().is_ok())
}

/// Friction may be less than stated if the bodies stick: a share of the critical ratio may not.
fn without_friction(collision: Collision) -> Collision {
    let ImpulseRatio::LimitedByFriction(share) = collision.impulse_ratio else { return collision };
    Collision { impulse_ratio: ImpulseRatio::OfCritical(share), ..collision }
}

fn possible() -> impl Strategy<Value = Collision> {
    possible_as(|collision| collision)
}

/// Generates a contact that lasts: a constant force for a time τ at a point that moves by a share of the relative motion. The centers of mass move by
/// v τ + ½ F τ²/m, and the levers of F change steadily, so the spins change by the impulse times the mean of the first and the last lever.
fn lasting() -> impl Strategy<Value = Record> {
    let body = || ((800.0..3000.0, 1.0..1.8), (-30.0..30.0, -30.0..30.0, -2.0..2.0), -1.0..1.0);
    let contact = (0.05..0.5, 0.0..1.0, -30_000.0..-1000.0, -10_000.0..10_000.0, (-0.5..0.5, -0.5..0.5));
    (body(), body(), contact).prop_map(|(one, two, (time, share, px, py, (x, y)))| {
        let (impulse, point) = (Xy { x: px, y: py }, Xy { x, y });
        let places = |((mass, _), (vx, vy, _), y): ((f64, f64), (f64, f64, f64), f64), x: f64, impulse: Xy| {
            let (center, velocity) = (Xy { x, y }, Xy { x: vx, y: vy });
            (center, center + velocity * time + impulse * (time / (2.0 * mass)))
        };
        let (c1, c2) = (places(one, -2.0, impulse), places(two, 2.0, -impulse));
        let past = (c2.1 - c1.1) - (c2.0 - c1.0);
        let point_after = point + (c1.1 - c1.0) + past * share;
        let subject =
            |((mass, gyration), (vx, vy, yaw_rate), _): ((f64, f64), (f64, f64, f64), f64), (center, after): (Xy, Xy), impulse: Xy| {
                let (velocity, inertia) = (Xy { x: vx, y: vy }, mass * gyration * gyration);
                let lever = ((point - center) + (point_after - after)) * 0.5;
                Subject {
                    mass: Some(mass),
                    yaw_inertia: Some(inertia),
                    center: Some(center),
                    center_after: Some(after),
                    before: State { velocity: Some(velocity), yaw_rate: Some(yaw_rate) },
                    after: State {
                        velocity: Some(velocity + impulse * (1.0 / mass)),
                        yaw_rate: Some(yaw_rate + lever.cross(impulse) / inertia),
                    },
                    ..Subject::default()
                }
            };
        Record {
            one: subject(one, c1, impulse),
            two: subject(two, c2, -impulse),
            point: Some(point),
            point_after: Some(point_after),
            duration: Some(time),
            normal_angle: Some(0.0),
            ..Record::default()
        }
    })
}

/// The rules that hold for any force between two bodies.
const OF_ANY_FORCE: [Rule; 4] = [Rule::LinearMomentum, Rule::AngularMomentum, Rule::LineOfAction, Rule::WorkIdentity];

fn is_found(record: &Record, rule: Rule) -> Result<(), TestCaseError> {
    let outcome = check(record, &Options::default());
    prop_assert!(outcome.of(rule).any(|finding| finding.severity == Severity::Fail), "{rule} is not among: {outcome}");
    Ok(())
}

/// Removes the values reported in addition to the motions: the laws alone must find the error.
fn motions(record: &Record) -> Record {
    Record { reported: Reported::default(), ..record.clone() }
}

/// Returns the numbers of a record that are kept; both components of a vector are, or none.
fn parts(record: &Record, keep: impl Fn(Key) -> bool) -> Record {
    let first = |key| match key {
        Key::CenterY(side) => Key::CenterX(side),
        Key::BeforeY(side) => Key::BeforeX(side),
        Key::AfterY(side) => Key::AfterX(side),
        Key::CenterAfterY(side) => Key::CenterAfterX(side),
        Key::PointY => Key::PointX,
        Key::PointAfterY => Key::PointAfterX,
        other => other,
    };
    let mut some =
        Record { model: Model { law: record.model.law, ratio_kind: record.model.ratio_kind, ..Model::default() }, ..Record::default() };
    (some.one.fixed, some.two.fixed) = (record.one.fixed, record.two.fixed);
    for key in Key::ALL.into_iter().filter(|key| keep(first(*key))) {
        if let Some(value) = record.get(key) {
            some.set(key, value);
        }
    }
    some
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
                    // A barrier absorbs any momentum; the reported energies are inconsistent.
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
        let mut printed = Record { resolution: Resolution::default().with(ResolutionGroup::Velocity, resolution), ..record };
        for key in Key::ALL.into_iter().filter(|key| key.group() == ResolutionGroup::Velocity) {
            if let Some(value) = printed.get(key) {
                printed.set(key, rounded(value, decimals).0);
            }
        }
        let (m1, m2) = (printed.one.mass.expect("known"), printed.two.mass.expect("known"));
        // The uncertainty of the digits, before and after, for both bodies; rounding may use up the same amount again.
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
                    // Also without a contact point.
                    let nowhere = Record { point: None, normal_angle: None, ..motions(&scaled(&record, key, -1.0)) };
                    is_found(&nowhere, Rule::AngularMomentum)?;
                }
            }
        }
    }

    #[test]
    fn a_contact_that_lasts_breaks_no_law_of_any_force(record in lasting(), decimals in 1..6_i32) {
        let fails = |record: &Record| {
            let outcome = check(record, &Options::default());
            let broken = failures(&outcome).iter().any(|finding| OF_ANY_FORCE.contains(&finding.rule));
            (broken, OF_ANY_FORCE.iter().all(|rule| outcome.has_checked(*rule)), outcome)
        };
        let (broken, checked, outcome) = fails(&record);
        prop_assert!(!broken && checked, "{outcome}");
        // Its duration alone makes what the motion explains a warning.
        let mut lasting = record.clone();
        (lasting.one.center_after, lasting.two.center_after, lasting.point_after) = (None, None, None);
        let (broken, checked, outcome) = fails(&lasting);
        prop_assert!(!broken && checked, "{outcome}");
        let printed = printed(&record, |_| Some(decimals));
        let (broken, _, outcome) = fails(&printed);
        prop_assert!(!broken, "{outcome}");
    }

    #[test]
    fn a_wrong_place_after_a_contact_is_found(record in lasting(), by in 0.01..1.0) {
        let past = record.two.after.velocity.expect("known") - record.one.after.velocity.expect("known");
        prop_assume!(past.length() > 1.0);
        let mut wrong = record.clone();
        wrong.one.center_after = record.one.center_after.map(|center| center + past.quarter_turn() * (by / past.length()));
        is_found(&wrong, Rule::AngularMomentum)?;
        prop_assume!(record.one.after.yaw_rate.expect("known").abs() > 1e-3);
        is_found(&scaled(&record, Key::AfterYawRate(Side::One), -1.0), Rule::AngularMomentum)?;
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
        // An impact computed with it, whether the record states it or not.
        let wild = Collision { restitution: above, ..collision };
        let mut record = motions(&Record::of(&wild, &wild.evaluate()));
        is_found(&record, Rule::Restitution)?;
        record.model.restitution = None;
        is_found(&record, Rule::Restitution)?;
    }

    #[test]
    fn a_gain_of_energy_is_found(collision in on_the_road(), restitution in prop_oneof![1 => 0.0..1.0, 4 => 1.0..2.0]) {
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
    fn a_wrong_moment_is_found(collision in possible(), moment in -500.0..500.0, by in 1e-3..10.0) {
        let with = Collision { moment: Moment::Given(moment), ..collision };
        let record = motions(&Record::of(&with, &with.evaluate()));
        // An error of a billionth of the parts may not be seen in a small moment.
        prop_assume!(moment.abs() > 0.1);
        is_found(&scaled(&record, Key::Moment, 1.0 + by), Rule::LineOfAction)?;
        is_found(&Record { moment: None, ..record }, Rule::LineOfAction)?;
    }

    #[test]
    fn a_turned_normal_is_found(collision in possible_as(|it| Collision { law: Law::Brach, ..it }), by in 0.01..3.0) {
        // At common velocity, or with restitution of both components, nothing depends on the normal.
        prop_assume!(collision.restitution > 0.01);
        let record = motions(&Record::of(&collision, &collision.evaluate()));
        let wrong = scaled(&Record { normal_angle: Some(1.0), ..record.clone() }, Key::NormalAngle, collision.crush_plane.angle() + by);
        let outcome = check(&wrong, &Options::default());
        prop_assert_eq!(outcome.verdict(), Verdict::Fail, "{}", outcome);
        // Both directions of the normal are correct.
        let around = Record { normal_angle: Some(collision.crush_plane.angle() + PI), ..record };
        let outcome = check(&around, &Options::default());
        prop_assert!(outcome.findings.iter().all(|finding| finding.severity == Severity::Warn), "{outcome}");
    }

    #[test]
    fn an_impulse_that_pulls_or_goes_too_far_is_found(collision in on_the_road(), ratio in -3.0..3.0) {
        let wild = Collision { impulse_ratio: ImpulseRatio::Given(ratio), ..collision };
        let impact = wild.evaluate();
        let record = motions(&Record::of(&wild, &impact));
        for refusal in &wild.solve().err().or_reject("solved")? {
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
    fn a_wrong_ratio_is_found(collision in possible_as(without_friction), by in 1e-5..1.0) {
        let record = motions(&Record::of(&collision, &collision.evaluate()));
        let wrong = Record { model: Model { impulse_ratio: record.model.impulse_ratio.map(|ratio| ratio - by), ..record.model }, ..record.clone() };
        let sticking = Collision { impulse_ratio: ImpulseRatio::Critical, ..collision }.evaluate().impulse;
        prop_assume!(record.model.ratio_kind != RatioKind::OfCritical || sticking.t.abs() > 0.01 * sticking.length());
        is_found(&wrong, Rule::ImpulseRatio)?;
    }

    #[test]
    fn a_wrong_result_is_found(collision in possible(), by in prop_oneof![Just(1.001), Just(-1.0), 0.5..0.999]) {
        let impact = collision.evaluate();
        let mut record = Record::of(&collision, &impact);
        for (side, party) in SIDES.into_iter().zip([&collision.one, &collision.two]) {
            // One body absorbs the total normal work.
            if let Some(vehicle) = party.vehicle().filter(|_| free(&record).count() == 1) {
                record.reported.ees[side as usize] = Some((-2.0 * impact.work.n / vehicle.mass).sqrt());
            }
        }
        check(&record, &Options::default()).assert();
        for key in Key::ALL.into_iter().filter(|key| key.name().starts_with("reported.")) {
            let Some(value) = record.get(key).filter(|value| value.abs() > 1e-3) else { continue };
            let of = [(Key::NormalWork, impact.work.n), (Key::TangentialWork, impact.work.t), (Key::EnergyLoss, impact.loss())];
            // An error of a billionth of the total may appear in a small part.
            let whole = impact.kinetic_energy.before.max(impact.work.n.abs());
            let is_small = of.iter().any(|(of, part)| *of == key && part.abs() <= 1e-5 * whole)
                || key.group() == ResolutionGroup::Impulse && value.abs() <= 1e-5 * impact.impulse.length();
            let is_squared = matches!(key, Key::EquivalentEnergySpeed(_)) && by < 0.0;
            if is_small || is_squared {
                continue;
            }
            is_found(&scaled(&record, key, by), Rule::Reported)?;
        }
    }

    /// Motions before the impact alone, or after it, tell the energy and the speed along the normal then; and an impulse the directions of force.
    #[test]
    fn a_wrong_result_is_found_by_half_of_the_motions(collision in possible(), by in prop_oneof![1.01..3.0, 0.3..0.99], turn in 0.01..3.0) {
        let impact = collision.evaluate();
        let whole = Record::of(&collision, &impact);
        let of_after = |key| matches!(key, Key::AfterX(_) | Key::AfterYawRate(_));
        let of_before = |key| matches!(key, Key::BeforeX(_) | Key::BeforeYawRate(_));
        let given = motions(&whole);
        let (before, after) = (parts(&given, |key| !of_after(key)), parts(&given, |key| !of_before(key)));
        let speeds = [impact.approach.n.abs(), impact.separation.n.abs()];
        let energies = [impact.kinetic_energy.before, impact.kinetic_energy.after];
        for (record, energy, speed, i) in [(&before, Key::EnergyBefore, Key::ClosingSpeed, 0), (&after, Key::EnergyAfter, Key::SeparationSpeed, 1)] {
            for (key, value) in [(energy, energies[i]), (speed, speeds[i])] {
                let relative = if key == energy { energies[i] } else { [impact.approach, impact.separation][i].length() };
                if value < 0.1 * relative || relative < 1e-3 {
                    continue;
                }
                let mut told = record.clone();
                told.set(key, value);
                prop_assert!(failures(&check(&told, &Options::default())).is_empty(), "{key}");
                is_found(&scaled(&told, key, by), Rule::Reported)?;
            }
        }
        // A loss that is more than there was, and vehicles that part.
        let mut lost = before.clone();
        lost.set(Key::EnergyLoss, 1.01 * energies[0] + 1.0);
        if free(&whole).count() == 2 {
            is_found(&lost, Rule::Reported)?;
        }
        let is_motion = |key: &Key| matches!(key, Key::BeforeX(_) | Key::BeforeY(_) | Key::BeforeYawRate(_)) && before.get(*key).is_some();
        let parting = Key::ALL.into_iter().filter(is_motion).fold(before.clone(), |record, key| scaled(&record, key, -1.0));
        is_found(&parting, Rule::Compressive)?;
        // The force on each vehicle by the impulse, and by each other.
        let mut forces = Record::default();
        (forces.one.fixed, forces.two.fixed) = (whole.one.fixed, whole.two.fixed);
        for (side, party) in SIDES.into_iter().zip([&collision.one, &collision.two]) {
            if let (Some(vehicle), Some(from)) = (party.vehicle(), whole.get(Key::ForceDirection(side))) {
                forces.set(Key::Heading(side), vehicle.heading.angle());
                forces.set(Key::ForceDirection(side), from);
            }
        }
        let mut by_impulse = forces.clone();
        by_impulse.set(Key::ImpulseX, impact.impulse_on_ground.x);
        by_impulse.set(Key::ImpulseY, impact.impulse_on_ground.y);
        for record in [&forces, &by_impulse] {
            prop_assert!(failures(&check(record, &Options::default())).is_empty());
            for side in SIDES {
                let Some(from) = record.get(Key::ForceDirection(side)).filter(|_| free(&whole).count() == 2) else { continue };
                let mut wrong = record.clone();
                wrong.set(Key::ForceDirection(side), from + turn);
                is_found(&wrong, Rule::Reported)?;
            }
        }
    }

    /// The model and the motions before lead to every result, of motions after that nobody gives.
    #[test]
    fn a_wrong_result_is_found_by_the_model(collision in possible(), by in prop_oneof![1.01..3.0, 0.3..0.99]) {
        let impact = collision.evaluate();
        // Near the edge of the cone, and of wedging, the model leaves something open.
        let ratio = impact.impulse.t / impact.impulse.n;
        prop_assume!(collision.contact().compliance.wedging_share(ratio) > 0.1 && impact.impulse.n * impact.approach.n > 0.0);
        if let ImpulseRatio::LimitedByFriction(friction) = collision.impulse_ratio {
            let sticking = Collision { impulse_ratio: ImpulseRatio::Critical, ..collision }.evaluate().impulse;
            prop_assume!((sticking.t.abs() - friction * sticking.n.abs()).abs() > 1e-3 * sticking.length());
        }
        let whole = Record::of(&collision, &impact);
        let before = parts(&whole, |key| !matches!(key, Key::AfterX(_) | Key::AfterYawRate(_)));
        prop_assert!(failures(&check(&before, &Options::default())).is_empty());
        let scale = [(Key::EnergyLoss, impact.loss(), impact.kinetic_energy.before), (Key::NormalWork, impact.work.n, impact.kinetic_energy.before)];
        for (key, value, of) in scale {
            if value.abs() > 1e-3 * of {
                is_found(&scaled(&before, key, by), Rule::Reported)?;
            }
        }
        for side in free(&whole) {
            is_found(&scaled(&before, Key::DeltaV(side), by), Rule::Reported)?;
        }
        is_found(&scaled(&before, Key::ImpulseMagnitude, by), Rule::Reported)?;
    }

    /// The work of the normal impulse by the restitution, where no separation speed is reported.
    #[test]
    fn a_wrong_work_is_found_by_the_restitution(collision in possible(), by in prop_oneof![1.01..3.0, 0.3..0.99]) {
        let impact = collision.evaluate();
        prop_assume!(impact.work.n.abs() > 1e-3 * impact.kinetic_energy.before);
        let mut record = Record { model: Model { restitution: Some(collision.restitution), ..Model::default() }, ..Record::default() };
        record.set(Key::ClosingSpeed, impact.approach.n.abs());
        record.set(Key::NormalImpulse, impact.impulse.n);
        record.set(Key::NormalWork, impact.work.n);
        prop_assert!(failures(&check(&record, &Options::default())).is_empty());
        is_found(&scaled(&record, Key::NormalWork, by), Rule::Reported)?;
    }
}
