//! Every error of the crate, once: its code, its path and the figures of its message, each of a different size so that they cannot be confused.

use alloc::boxed::Box;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use alloc::{format, vec};
use core::fmt::Display;

use super::*;
use crate::barrier::TestIssue;
use crate::crush::{ProfileError, ZoneError};
use crate::guideline::SurfaceIssue;
use crate::input::{Input, Side};
use crate::measure::Measure;
use crate::refusal::{Refusal, Tension};

trait Error: Issue<Number = f64> + Display {}
impl<E: Issue<Number = f64> + Display> Error for E {}

struct Sample {
    error: Box<dyn Error>,
    code: &'static str,
    path: Option<&'static str>,
    figures: Vec<(Measure, f64)>,
}

fn sample(
    error: impl Error + 'static,
    code: &'static str,
    path: impl Into<Option<&'static str>>,
    figures: impl Into<Vec<(Measure, f64)>>,
) -> Sample {
    Sample { error: Box::new(error), code, path: path.into(), figures: figures.into() }
}

const MASS: Place = Place::input(Input::Mass(Side::Two));

fn inputs() -> Vec<Sample> {
    let issue = |kind| InputIssue { at: MASS, kind };
    let path = "vehicle.2.mass";
    use Measure::{Mass, Ratio};
    vec![
        sample(issue(InputIssueKind::NotFinite { value: f64::INFINITY }), "not-finite", path, [(Ratio, f64::INFINITY)]),
        sample(issue(InputIssueKind::SeveralNotFinite { count: 3 }), "not-finite", path, []),
        sample(issue(InputIssueKind::NotPositive { value: -2.5 }), "not-positive", path, [(Mass, -2.5)]),
        sample(
            issue(InputIssueKind::OutOfRange { value: 7.5, least: 1.0, greatest: Some(2.0) }),
            "out-of-range",
            path,
            [(Mass, 7.5), (Mass, 1.0), (Mass, 2.0)],
        ),
        sample(
            issue(InputIssueKind::OutOfRange { value: 0.5, least: 1.0, greatest: None }),
            "out-of-range",
            path,
            [(Mass, 0.5), (Mass, 1.0)],
        ),
        sample(issue(InputIssueKind::OutOfOrder { value: 1.5, before: 2.5 }), "out-of-order", path, [(Mass, 1.5), (Mass, 2.5)]),
        sample(issue(InputIssueKind::TooFew { count: 1, least: 2 }), "too-few", path, []),
    ]
}

fn refusals() -> Vec<Sample> {
    use Measure::{Energy, Impulse, InverseMass, Length, Ratio, Speed};
    let ratio = "contact.impulse_ratio";
    let closing = |approach, offset| Refusal::NotClosing { approach, offset };
    let gain = Refusal::EnergyGain { gain: 12.5, before: 80.25 };
    let direction = Refusal::NotADirection { at: Place::input(Input::CrushPlane), length_squared: 0.25 };
    let number = Refusal::Input(InputIssue::not_positive(MASS, -3.5));
    vec![
        sample(number, "not-positive", "vehicle.2.mass", [(Measure::Mass, -3.5)]),
        sample(direction, "not-a-direction", "contact.crush_plane", [(Ratio, 0.25)]),
        sample(Refusal::NothingMoves::<f64>, "nothing-moves", "vehicle", []),
        sample(Refusal::OutOfFloatRange::<f64>, "overflow", None, []),
        sample(Refusal::IllConditioned { error: 0.25 }, "ill-conditioned", None, [(Measure::Ratio, 0.25)]),
        sample(closing(1.25, 4.5), "separating", "contact", [(Speed, 1.25), (Length, 4.5)]),
        sample(closing(-1.25, -4.5), "separating", "contact", [(Speed, -1.25), (Length, -4.5)]),
        sample(closing(0.0, 4.5), "not-closing", "contact", [(Speed, 0.0), (Length, 4.5)]),
        sample(closing(1e-10, 4.5), "not-closing", "contact", [(Speed, 1e-10), (Length, 4.5)]),
        sample(closing(2.5, 1e-10), "not-closing", "contact", [(Speed, 2.5), (Length, 1e-10)]),
        sample(closing(2.5, 0.0), "not-closing", "contact", [(Speed, 2.5), (Length, 0.0)]),
        sample(Refusal::Tensile { normal: -90.5, reason: Tension::Pulls }, "tensile", "contact", [(Impulse, -90.5)]),
        sample(Refusal::Tensile { normal: -0.125, reason: Tension::Wedges }, "wedging", ratio, [(InverseMass, -0.125)]),
        sample(Refusal::BeyondCritical { ratio: 0.75, critical: None }, "beyond-critical", ratio, [(Ratio, 0.75)]),
        sample(Refusal::BeyondCritical { ratio: 0.75, critical: Some(0.5) }, "beyond-critical", ratio, [(Ratio, 0.75), (Ratio, 0.5)]),
        sample(Refusal::BeyondCritical { ratio: -0.75, critical: Some(-0.5) }, "beyond-critical", ratio, [(Ratio, -0.75), (Ratio, -0.5)]),
        sample(gain, "energy-gain", "contact.restitution", [(Energy, 12.5), (Energy, 80.25)]),
    ]
}

fn tests_and_profiles() -> Vec<Sample> {
    use Measure::{Angle, Area, Length, Speed, Time};
    let at = Place::of("crush", Length).in_series(1).at(2);
    let profile = TestIssue::ImpossibleProfile { at, mean: 1.5, mean_square: 0.75 };
    let depths = ProfileError::<f64>::Input(InputIssue::too_few(Place::plain("depths"), 1, 2));
    let (one, other) = (-0.75, 0.5);
    vec![
        sample(TestIssue::Input(InputIssue::not_positive(MASS, -1.5)), "not-positive", "vehicle.2.mass", [(Measure::Mass, -1.5)]),
        sample(TestIssue::<f64>::UnequalLengths { at, like: "the values" }, "unequal-lengths", "crush[1][2]", []),
        sample(TestIssue::<f64>::InstantsDiffer { at }, "instants-differ", "crush[1][2]", []),
        sample(profile, "impossible-profile", "crush[1][2]", [(Length, 1.5), (Area, 0.75)]),
        sample(TestIssue::OneDepth { depth: 0.25 }, "one-depth", None, [(Length, 0.25)]),
        sample(TestIssue::Undetermined::<f64>, "undetermined", None, []),
        sample(TestIssue::OnsetTooFast { onset: 2.5, speed: 1.5 }, "onset-too-fast", None, [(Speed, 2.5), (Speed, 1.5)]),
        sample(TestIssue::SampledTooSlowly { step: 0.5, longest: 0.25 }, "sampled-too-slowly", None, [(Time, 0.5), (Time, 0.25)]),
        sample(TestIssue::NotUniform::<f64>, "not-uniform", None, []),
        sample(TestIssue::SpanTooNarrow { neighbors: 2, time: 0.5 }, "span-too-narrow", None, [(Time, 0.5)]),
        sample(TestIssue::NotConverged::<f64> { steps: 100 }, "not-converged", None, []),
        sample(depths, "too-few", "depths", []),
        sample(ProfileError::<f64>::Unequal { depths: 2, stations: 3 }, "unequal-lengths", "stations", []),
        sample(ZoneError { zones: 2, borders: 3 }, "zone-count", None, []),
        sample(SurfaceIssue::Perpendicular { one, other }, "perpendicular-surfaces", "contact.crush_plane", [(Angle, one), (Angle, other)]),
    ]
}

#[cfg(feature = "reconstruct")]
fn reconstructions() -> Vec<Sample> {
    use crate::reconstruct::{Measurand, NoPosterior, ReconstructionIssue as Wrong, SolveError, Stop, Variable};
    use Measure::{Energy, Ratio, Speed};
    let (of, energy) = (Variable::Speed(Side::One), Measurand::CrushEnergy);
    let path = "vehicle.1.speed";
    let start = InputIssue { at: Place::of(of.name(), Speed).part("start"), kind: InputIssueKind::NotFinite { value: f64::NEG_INFINITY } };
    let deviation = InputIssue::not_positive(Place::of("crush_energy", Energy).part("standard deviation"), -1.5);
    let refusals = Issues::from(Refusal::NothingMoves);
    let stop = Stop { unknowns: vec![(of, 12.5)], chi_square: 8.25, step: 0.5, iterations: 7, beyond: Some(refusals.clone()) };
    let correlation = Wrong::CorrelationsImpossible { eigenvalue: -0.25 };
    vec![
        sample(Wrong::Unknown { of, issue: start }, "not-finite", "start of vehicle.1.speed", [(Ratio, f64::NEG_INFINITY)]),
        sample(Wrong::Evidence { of: energy, issue: deviation }, "not-positive", "standard deviation of crush_energy", [(Energy, -1.5)]),
        sample(Wrong::NothingUnknown, "nothing-unknown", None, []),
        sample(Wrong::TooLittleEvidence { unknowns: vec![of], evidence: 0 }, "too-little-evidence", None, []),
        sample(Wrong::NotInCase(of), "not-in-case", path, []),
        sample(Wrong::NothingToMeasure(energy), "not-in-case", "crush_energy", []),
        sample(Wrong::UnknownTwice(of), "repeated", path, []),
        sample(Wrong::ShapeWithoutPrior(of), "shape-without-prior", path, []),
        sample(Wrong::EvidenceTwice(energy), "repeated", "crush_energy", []),
        sample(Wrong::SpeedAndVelocity(Side::One), "speed-and-velocity", path, []),
        sample(Wrong::BoundsCrossed { of, min: 2.5, max: 1.5 }, "bounds-crossed", path, [(Speed, 2.5), (Speed, 1.5)]),
        sample(
            Wrong::StartOutside { of, start: 9.5, min: 1.5, max: 2.5 },
            "out-of-range",
            path,
            [(Speed, 9.5), (Speed, 1.5), (Speed, 2.5)],
        ),
        sample(
            Wrong::BoundOutside { of, bound: -9.5, least: 1.5, most: f64::INFINITY },
            "out-of-range",
            path,
            [(Speed, -9.5), (Speed, 1.5)],
        ),
        sample(
            Wrong::BoundOutside { of, bound: 9.5, least: f64::NEG_INFINITY, most: 2.5 },
            "out-of-range",
            path,
            [(Speed, 9.5), (Speed, 2.5)],
        ),
        sample(Wrong::ShareUnknown(energy), "share-unknown", "crush_energy", []),
        sample(Wrong::CorrelationOfNothing(energy, energy), "correlation-without-evidence", "crush_energy", []),
        sample(correlation, "impossible-correlations", None, [(Ratio, -0.25)]),
        sample(SolveError::Problems(Wrong::NothingUnknown.into()), "nothing-unknown", None, []),
        sample(SolveError::NoStart { starts: 3, refusals }, "no-start", "unknown", []),
        sample(SolveError::Stopped, "stopped", "unknown", []),
        sample(NoPosterior::Improper(vec![of]), "posterior-improper", "unknown", []),
        sample(NoPosterior::NoRoom, "no-posterior", "unknown", []),
        sample(NoPosterior::Stopped, "stopped", "unknown", []),
        sample(
            SolveError::NotConverged { searches: 4, converged: 0, nearest: stop },
            "not-converged",
            "unknown",
            [(Speed, 12.5), (Ratio, 8.25)],
        ),
    ]
}

#[cfg(feature = "post-impact")]
fn slides() -> Vec<Sample> {
    use crate::frame::Xy;
    use crate::post_impact::{Miss, NoRest, NoSeparation, Pose, SlideIssue, TIME_LIMIT, TrajectoryState};
    use crate::vehicle::Motion;
    use Measure::{Angle, Length, Speed, Time, YawRate};
    let moving = Motion { velocity: Xy { x: 3.0, y: 4.0 }, yaw_rate: 0.25 };
    let passing = TrajectoryState { time: 60.5, pose: Pose::default(), motion: moving };
    let miss = Miss { position: Xy { x: 3.0, y: 4.0 }, heading: 0.5 };
    let along = |motion| NoSeparation::NotDetermined { along: motion };
    let (no_area, moves) = (SlideIssue::NoArea { region: 1 }, NoRest::Moves(passing));
    vec![
        sample(SlideIssue::from(InputIssue::not_positive(MASS, -1.5)), "not-positive", "vehicle.2.mass", [(Measure::Mass, -1.5)]),
        sample(no_area.clone(), "no-area", "region[1]", []),
        sample(NoRest::Refused(no_area.clone().into()), "no-area", "region[1]", []),
        sample(moves.clone(), "does-not-rest", None, [(Time, TIME_LIMIT), (Time, 60.5), (Speed, 5.0), (YawRate, 0.25)]),
        sample(NoRest::NotFollowed(passing), "integration-failed", None, [(Time, 60.5)]),
        sample(NoSeparation::Refused(no_area.into()), "no-area", "region[1]", []),
        sample(NoSeparation::NoRest(moves), "does-not-rest", None, [(Time, 60.5)]),
        sample(NoSeparation::NotConverged { motion: moving, miss }, "not-converged", None, [(Length, 5.0), (Angle, 0.5)]),
        sample(along(moving), "underdetermined", None, [(Speed, 3.0), (Speed, 4.0), (YawRate, 0.25)]),
        sample(along(Motion::rest()), "underdetermined", None, []),
        sample(NoSeparation::Driven, "driven", None, []),
        sample(NoSeparation::Stopped, "stopped", None, []),
        sample(NoSeparation::Turned { turn: 1.5, deviation: 0.25 }, "turned", None, [(Angle, 1.5), (Angle, 0.25)]),
        sample(NoSeparation::TooShort { distance: 0.5, deviation: 0.25 }, "too-short", None, [(Length, 0.5), (Length, 0.25)]),
    ]
}

fn samples() -> Vec<Sample> {
    let mut samples = inputs();
    samples.extend(refusals());
    samples.extend(tests_and_profiles());
    #[cfg(feature = "reconstruct")]
    samples.extend(reconstructions());
    #[cfg(feature = "post-impact")]
    samples.extend(slides());
    samples
}

#[test]
fn every_error_has_its_code_path_and_figures() {
    for Sample { error, code, path, figures } in samples() {
        assert_eq!((error.code(), error.path().as_deref()), (code, path), "{error}");
        let message = error.message();
        let found: Vec<(Measure, f64)> = message.figures().map(|(measure, value)| (measure, *value)).collect();
        assert_eq!(found, figures, "{error}");
    }
}

#[test]
fn every_error_shows_its_path_or_a_sentence_with_all_figures() {
    for Sample { error, figures, .. } in samples() {
        let shown = error.to_string();
        for (measure, value) in figures {
            let [plain, rounded] = [format!("{value}"), format!("{value:.3}")];
            let with_unit = |number: &str| format!("{number} {}", measure.si_unit()).trim_end().to_string();
            assert!(shown.contains(&with_unit(&plain)) || shown.contains(&with_unit(&rounded)), "{shown}");
            assert!(value.is_finite() || shown.contains("not finite"), "{shown}");
        }
    }
}

/// Returns the codes in the table of [`Issue`].
fn documented() -> Vec<&'static str> {
    let rows = include_str!("contract.rs").lines().filter_map(|line| line.strip_prefix("/// | `"));
    rows.flat_map(|row| row.split(" | ").next().unwrap_or_default().split('`'))
        .filter(|word| !word.trim_matches([',', ' ']).is_empty())
        .collect()
}

#[test]
fn every_code_is_documented_once_in_kebab_case() {
    let documented = documented();
    for code in &documented {
        assert!(!code.starts_with('-') && !code.ends_with('-'), "{code}");
        assert!(code.chars().all(|c| c.is_ascii_lowercase() || c == '-'), "{code}");
        assert_eq!(documented.iter().filter(|other| *other == code).count(), 1, "{code}");
    }
    for Sample { error, code, .. } in samples() {
        assert!(documented.contains(&code), "{code}: {error}");
    }
}

/// With every feature, since one table has the codes of all.
#[test]
#[cfg(feature = "post-impact")]
fn every_documented_code_is_that_of_an_error() {
    let samples = samples();
    for code in documented() {
        assert!(samples.iter().any(|sample| sample.code == code), "{code}");
    }
}

#[test]
fn a_number_has_its_name_in_a_sentence_of_its_own_and_none_beside_its_path() {
    let issue = InputIssue::not_positive(MASS, -2.0);
    assert_eq!(issue.to_string(), "vehicle.2.mass is -2 kg; it must be above zero");
    assert_eq!(issue.message().to_string(), "it is -2 kg; it must be above zero");
    let sd = InputIssue { at: MASS.part("standard deviation"), ..issue };
    assert_eq!(sd.to_string(), "standard deviation of vehicle.2.mass is -2 kg; it must be above zero");
    assert_eq!(sd.message().to_string(), "its standard deviation is -2 kg; it must be above zero");
}

#[test]
fn a_share_in_percent_is_recognized() {
    let issue = |measure, value: f64, greatest: f64| {
        let kind = InputIssueKind::OutOfRange { value, least: 0.0, greatest: Some(greatest) };
        InputIssue { at: Place::of("share", measure), kind }.help().map(|help| help.to_string())
    };
    assert_eq!(issue(Measure::Ratio, 15.0, 1.0), Some(String::from("did you mean \"15 %\"?")));
    assert_eq!(issue(Measure::Ratio, 100.0, 1.0), Some(String::from("did you mean \"100 %\"?")));
    for (measure, value, greatest) in [
        (Measure::Ratio, 101.0, 1.0),
        (Measure::Ratio, -15.0, 1.0),
        (Measure::Ratio, 15.0, 10.0),
        (Measure::Ratio, 15.0, 0.5),
        (Measure::Length, 15.0, 1.0),
    ] {
        assert_eq!(issue(measure, value, greatest), None, "{value} of {greatest}");
    }
}

#[test]
fn the_collector_accepts_bounds_and_finds_each_kind() {
    let mut issues = IssueCollector::<InputIssue>::new();
    let at = Place::plain("x");
    for value in [1.0, 1.5, 2.0] {
        assert!(issues.within(at, &value, 1.0, Some(2.0)));
    }
    assert!(issues.not_negative(at, &0.0) && issues.positive(at, &f64::MIN_POSITIVE) && issues.at_least(at, 2, 2));
    assert!(issues.all_finite(at, &[1.0, f64::MAX]));
    assert_eq!(issues.clone().finish(), Ok(()));
    assert!(!issues.within(at, &1.0_f64.next_down(), 1.0, Some(2.0)) && !issues.within(at, &2.0_f64.next_up(), 1.0, Some(2.0)));
    assert!(!issues.not_negative(at, &-f64::MIN_POSITIVE) && !issues.positive(at, &0.0) && !issues.at_least(at, 1, 2));
    assert!(!issues.all_finite(at, &[1.0, f64::NAN]) && !issues.within(at, &f64::NAN, 1.0, Some(2.0)) && !issues.positive(at, &f64::NAN));
    let codes: Vec<_> = issues.finish().expect_err("eight").iter().map(Issue::code).collect();
    let range = "out-of-range";
    assert_eq!(codes, [range, range, range, "not-positive", "too-few", "not-finite", "not-finite", "not-finite"]);
}
