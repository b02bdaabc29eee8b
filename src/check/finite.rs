//! Numbers that are not finite, and implausible numbers: `finite`, `plausible-units`.

use super::format::Digits;
use super::judge::Judge;
use super::key::Key;
use super::momentum::number_of;
use super::options::Options;
use super::profile::Profile;
use super::record::Record;
use super::rule::Rule;
use crate::input::Side;
use crate::measure::Measure;
use alloc::format;
use core::f64::consts::TAU;

/// Checks that every number is finite, that what must be above zero is, that the options are valid, and that a body can move.
pub(super) fn check(record: &Record, options: &Options, judge: &mut Judge) {
    let rule = Rule::Finite;
    judge.checks(rule);
    for issue in options.validate().err().iter().flatten() {
        judge.fail(rule, f64::INFINITY, 0.0, format!("{issue}"));
    }
    for key in Key::ALL {
        let Some(value) = record.get(key) else { continue };
        if !value.is_finite() {
            judge.fail(rule, f64::INFINITY, 0.0, format!("{key} is {value}, which is not a finite number"));
        } else if matches!(key, Key::Mass(_) | Key::YawInertia(_)) && value <= 0.0 {
            judge.fail(rule, -value, 0.0, format!("{key} is {}, and must be above zero", Digits(value)));
        } else if key == Key::Duration && value < 0.0 {
            judge.fail(rule, -value, 0.0, format!("{key} is {}, and must be at least zero", Digits(value)));
        }
    }
    for (name, resolution) in record.resolution.entries() {
        if !(resolution >= 0.0 && resolution.is_finite()) {
            let what = format!("the resolution of {name} is {resolution}, and must be a finite number of at least zero");
            judge.fail(rule, resolution.abs(), 0.0, what);
        }
    }
    if record.one.fixed && record.two.fixed {
        judge.fail(rule, 0.0, 0.0, "both bodies are fixed, and nothing can move".into());
    }
}

/// Range of the radius of gyration of a vehicle, in m.
const GYRATION: (f64, f64) = (0.9, 2.5);
/// Range of the mass of a vehicle, in kg, from a motorcycle to a loaded truck.
const MASS: (f64, f64) = (100.0, 80_000.0);
/// Highest speed in m/s, highest yaw rate in rad/s, and largest distance of an impact from the center of mass in m.
const SPEED: f64 = 150.0;
const YAW_RATE: f64 = 30.0;
const ARM: f64 = 15.0;
/// Longest contact in s; that of vehicles lasts about 0.1 s.
const DURATION: f64 = 1.0;

/// Checks that vehicles have plausible sizes. The bodies of a stepping engine may have any size, but their angles must be within a turn as well.
pub(super) fn plausible(record: &Record, judge: &mut Judge) {
    judge.checks(Rule::PlausibleUnits);
    for key in Key::ALL.into_iter().filter(|key| key.measure() == Measure::Angle) {
        let turn = TAU * (1.0 + 1e-9);
        above(judge, record.get(key).map(f64::abs), turn, |angle| {
            format!("{key} is {angle} rad, more than a turn; check the unit of angles")
        });
    }
    if matches!(record.profile, Profile::Stepper | Profile::StepperF32) {
        return;
    }
    above(judge, record.duration, DURATION, |time| format!("the contact lasts {time} s: milliseconds?"));
    for side in [Side::One, Side::Two] {
        of_body(record, side, judge);
    }
}

fn of_body(record: &Record, side: Side, judge: &mut Judge) {
    let (subject, body) = (record.subject(side), number_of(side));
    for state in [subject.before, subject.after] {
        above(judge, state.velocity.map(|v| libm::hypot(v.x, v.y)), SPEED, |v| format!("body {body} moves at {v} m/s: mph or km/h?"));
        above(judge, state.yaw_rate.map(f64::abs), YAW_RATE, |w| format!("body {body} turns at {w} rad/s: degrees?"));
    }
    if let Some(mass) = subject.mass {
        let why = "a vehicle has 100 kg to 80 t; another unit, or a weight? A barrier is fixed";
        outside(judge, mass, MASS, |mass| format!("body {body} has a mass of {mass} kg: {why}"));
        if let Some(inertia) = subject.yaw_inertia {
            // The ratio itself may be infinite.
            let radius = libm::sqrt(inertia) / libm::sqrt(mass);
            outside(judge, radius, GYRATION, |k| {
                format!("body {body} has a radius of gyration of {k} m, and a vehicle 0.9 to 2.5 m: units?")
            });
        }
    }
    let arm = record.point.zip(subject.center).map(|(point, center)| (point - center).length());
    above(judge, arm, ARM, |arm| format!("body {body} is hit {arm} m from its center of mass: units?"));
}

fn above(judge: &mut Judge, value: Option<f64>, most: f64, what: impl FnOnce(Digits) -> alloc::string::String) {
    if let Some(value) = value.filter(|value| *value > most) {
        judge.warn(Rule::PlausibleUnits, value, most, what(Digits(value)));
    }
}

fn outside(judge: &mut Judge, value: f64, (least, most): (f64, f64), what: impl FnOnce(Digits) -> alloc::string::String) {
    if !(least..=most).contains(&value) {
        let bound = if value < least { least } else { most };
        judge.warn(Rule::PlausibleUnits, value, bound, what(Digits(value)));
    }
}

#[cfg(test)]
mod tests {
    use crate::check::*;
    use crate::input::Side;

    fn found(set: &[(Key, f64)]) -> Outcome {
        let mut record = Record::default();
        set.iter().for_each(|&(key, value)| record.set(key, value));
        check(&record, &Options::default())
    }

    #[test]
    fn numbers_that_are_none_are_found_and_nothing_else_is_checked() {
        for (key, value) in [(Key::AfterYawRate(Side::Two), f64::NAN), (Key::EnergyLoss, f64::INFINITY), (Key::Mass(Side::One), 0.0)] {
            let outcome = found(&[(key, value), (Key::Restitution, 7.0)]);
            assert_eq!(outcome.findings.len(), 1, "{outcome}");
            assert!(outcome.findings[0].what.contains(key.name()));
            assert_eq!((outcome.findings[0].rule, outcome.verdict()), (Rule::Finite, Verdict::Fail));
            assert_eq!(outcome.not_checked().count(), Rule::COUNT - 1);
        }
        let half = found(&[(Key::PointX, 1.0)]);
        assert!(half.findings[0].what.contains("contact.py is NaN"), "{half}");
        let walls = Record { one: Subject::FIXED, two: Subject::FIXED, ..Record::default() };
        assert_eq!(check(&walls, &Options::default()).verdict(), Verdict::Fail);
        let negative = Record { resolution: Resolution::default().with(ResolutionGroup::Mass, -1.0), ..Record::default() };
        assert!(check(&negative, &Options::default()).findings[0].what.contains("the resolution of mass is -1"));
    }

    #[test]
    fn numbers_beyond_all_measure_are_found() {
        let (one, two) = (Side::One, Side::Two);
        let huge = [Key::Mass(one), Key::Mass(two), Key::BeforeX(one), Key::BeforeY(one), Key::BeforeX(two), Key::BeforeY(two)];
        let mut all: Vec<_> = huge.into_iter().map(|key| (key, 1e200)).collect();
        all.extend([Key::AfterX(one), Key::AfterY(one), Key::AfterX(two), Key::AfterY(two)].map(|key| (key, 0.0)));
        let outcome = found(&all);
        assert!(outcome.of(Rule::Finite).next().is_some_and(|finding| finding.what.contains("so large or so small")), "{outcome}");
        // The message has the speed itself, although its square is infinite.
        assert!(outcome.of(Rule::PlausibleUnits).any(|finding| finding.what.contains("moves at 1")), "{outcome}");
        assert!(outcome.of(Rule::PlausibleUnits).all(|finding| !finding.what.contains("inf ")), "{outcome}");
    }

    #[test]
    fn units_are_wondered_about() {
        let warned = |set: &[(Key, f64)]| found(set).of(Rule::PlausibleUnits).count();
        let side = Side::One;
        assert_eq!(warned(&[(Key::Mass(side), 1163.0), (Key::YawInertia(side), 1945.0), (Key::NormalAngle, -6.0)]), 0);
        assert_eq!(warned(&[(Key::Mass(side), 2564.0), (Key::YawInertia(side), 1434.9)]), 1); // lb, and lbf s² ft
        assert_eq!(warned(&[(Key::Mass(side), 1e9)]), 1);
        assert_eq!(warned(&[(Key::NormalAngle, 45.0)]), 1);
        assert_eq!(warned(&[(Key::BeforeYawRate(side), 57.0)]), 1);
        assert_eq!(warned(&[(Key::BeforeX(side), 1000.0), (Key::BeforeY(side), 0.0)]), 1);
        assert_eq!(warned(&[(Key::PointX, 50.0), (Key::PointY, 0.0), (Key::CenterX(side), 0.0), (Key::CenterY(side), 0.0)]), 1);
        assert_eq!(found(&[(Key::NormalAngle, 45.0)]).verdict(), Verdict::Warn);
    }

    #[test]
    fn the_bodies_of_an_engine_may_have_any_size() {
        let mut record = Record { profile: Profile::Stepper, ..Record::default() };
        for (key, value) in [(Key::Mass(Side::One), 1.0), (Key::YawInertia(Side::One), 0.1667), (Key::BeforeYawRate(Side::One), 90.0)] {
            record.set(key, value);
        }
        assert_eq!(check(&record, &Options::default()).verdict(), Verdict::Pass);
        record.set(Key::NormalAngle, 45.0);
        assert_eq!(check(&record, &Options::default()).verdict(), Verdict::Warn);
    }
}
