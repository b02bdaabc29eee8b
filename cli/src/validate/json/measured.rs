//! The measured tests as JSON.

use planar_impact_validation::{Frontal, Reading, RootMeanSquare, SmallOverlap};
use serde::Serialize;

/// The measured tests.
#[derive(Serialize)]
pub struct Measured<'a> {
    small_overlap: Vec<SmallOverlapEntry<'a>>,
    small_overlap_root_mean_square: RootMeanSquares,
    full_frontal: Vec<FrontalEntry<'a>>,
}

#[derive(Serialize)]
struct ReadingEntry<'a> {
    unit: &'a str,
    measured: &'a str,
    computed: f64,
    error: f64,
    percent: f64,
    within_digits: bool,
    recorded_percent: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    kudlich_slibar: Option<Other>,
    /// With the stiffness that is made of the profile itself.
    #[serde(skip_serializing_if = "Option::is_none")]
    by_profile: Option<Other>,
}

/// The same, computed otherwise.
#[derive(Serialize)]
struct Other {
    computed: f64,
    error: f64,
    percent: f64,
}

#[derive(Serialize)]
struct SmallOverlapEntry<'a> {
    test: &'a str,
    delta_v: ReadingEntry<'a>,
    yaw_rate: ReadingEntry<'a>,
    turns_as_measured: bool,
    reason: &'a str,
}

#[derive(Serialize)]
struct RootMeanSquares {
    brach: Errors,
    kudlich_slibar: Errors,
}

#[derive(Serialize)]
struct Errors {
    delta_v: Size,
    yaw_rate: Size,
}

#[derive(Serialize)]
struct Size {
    error: f64,
    percent: f64,
}

#[derive(Serialize)]
struct FrontalEntry<'a> {
    test: &'a str,
    vehicle: &'a str,
    mean_depth: f64,
    coefficients: Vec<CoefficientEntry<'a>>,
    crush_energy: ReadingEntry<'a>,
    unevenness: f64,
    speed: &'a str,
    speed_of_crush: f64,
    reason: &'a str,
}

#[derive(Serialize)]
struct CoefficientEntry<'a> {
    name: &'a str,
    unit: &'a str,
    computed: f64,
    published: Option<&'a str>,
}

impl<'a> Measured<'a> {
    pub fn of(measured: &'a planar_impact_validation::Measured) -> Self {
        let tests = &measured.small_overlap;
        Measured {
            small_overlap: tests.iter().map(SmallOverlapEntry::of).collect(),
            small_overlap_root_mean_square: RootMeanSquares {
                brach: Errors::of(SmallOverlap::root_mean_squares(tests)),
                kudlich_slibar: Errors::of(SmallOverlap::kudlich_slibar_root_mean_squares(tests)),
            },
            full_frontal: measured.frontal.iter().map(FrontalEntry::of).collect(),
        }
    }
}

impl<'a> ReadingEntry<'a> {
    fn of(reading: &'a Reading) -> Self {
        ReadingEntry {
            unit: reading.unit,
            measured: reading.measured.text(),
            computed: reading.computed,
            error: reading.error(),
            percent: reading.percent(),
            within_digits: reading.is_within_digits(),
            recorded_percent: reading.recorded.as_ref().map(|recorded| recorded.value()),
            kudlich_slibar: None,
            by_profile: None,
        }
    }
}

impl Other {
    fn of(reading: &Reading, computed: f64) -> Self {
        Other { computed, error: reading.error_of(computed), percent: reading.percent_of(computed) }
    }
}

impl<'a> SmallOverlapEntry<'a> {
    fn of(test: &'a SmallOverlap) -> Self {
        let reading =
            |reading: &'a Reading, other| ReadingEntry { kudlich_slibar: Some(Other::of(reading, other)), ..ReadingEntry::of(reading) };
        SmallOverlapEntry {
            test: &test.test,
            delta_v: reading(&test.delta_v, test.kudlich_slibar_delta_v),
            yaw_rate: reading(&test.yaw_rate, test.kudlich_slibar_yaw_rate),
            turns_as_measured: test.turns_as_measured(),
            reason: &test.reason,
        }
    }
}

impl Errors {
    fn of([delta_v, yaw_rate]: [RootMeanSquare; 2]) -> Self {
        let size = |RootMeanSquare { error, percent }| Size { error, percent };
        Errors { delta_v: size(delta_v), yaw_rate: size(yaw_rate) }
    }
}

impl<'a> FrontalEntry<'a> {
    fn of(test: &'a Frontal) -> Self {
        let coefficients = test.coefficients.iter().map(|coefficient| CoefficientEntry {
            name: coefficient.name,
            unit: coefficient.unit,
            computed: coefficient.computed,
            published: coefficient.published.as_ref().map(|published| published.text()),
        });
        FrontalEntry {
            test: &test.test,
            vehicle: &test.vehicle,
            mean_depth: test.mean_depth,
            coefficients: coefficients.collect(),
            crush_energy: ReadingEntry {
                by_profile: Some(Other::of(&test.energy, test.energy_by_profile)),
                ..ReadingEntry::of(&test.energy)
            },
            unevenness: test.unevenness,
            speed: test.speed.text(),
            speed_of_crush: test.speed_of_crush,
            reason: &test.reason,
        }
    }
}
