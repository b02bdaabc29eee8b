//! Findings and assertions, as a reader of a failed test sees them.

use super::*;

#[test]
fn a_finding_says_what_and_how_much() {
    let mut record = printed();
    record.set(Key::EnergyLoss, 190_000.0);
    let outcome = check(&record, &Options::default());
    let text = alloc::format!("{outcome}");
    assert!(
        text.starts_with("case-1: fail\n  reported (fail): reported.energy_loss is said to be 190000 J, and the motions give 18616"),
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
