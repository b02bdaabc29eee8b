//! The measured tests in the JSON answer.

use planar_impact_validation::{Frontal, Reading, RootMeanSquare, SmallOverlap, Worked};
use schemars::JsonSchema;
use serde::Serialize;

/// The measured tests.
#[derive(Serialize, JsonSchema)]
pub(super) struct Measured<'a> {
    /// Small-overlap barrier tests.
    small_overlap: Vec<SmallOverlapEntry<'a>>,
    /// Root mean squares of their errors.
    small_overlap_root_mean_square: RootMeanSquares,
    /// Full-frontal barrier tests.
    full_frontal: Vec<FrontalEntry<'a>>,
    /// Worked examples and staged collisions of the field.
    worked: Vec<WorkedEntry<'a>>,
}

/// A published number of a worked example.
#[derive(Serialize, JsonSchema)]
struct WorkedEntry<'a> {
    /// The example.
    example: &'a str,
    /// The quantity.
    quantity: &'a str,
    /// The number; an error is recorded where it was measured.
    #[serde(flatten)]
    reading: ReadingEntry<'a>,
    /// `true` if it comes out to its digits, or with its recorded error.
    holds: bool,
    /// Where it is from.
    source: &'a str,
}

/// A measured quantity and its computed value.
#[derive(Serialize, JsonSchema)]
struct ReadingEntry<'a> {
    /// Its unit.
    unit: &'a str,
    /// The value as published.
    measured: &'a str,
    /// The computed value, by the paper's tangential law if a law applies.
    computed: f64,
    /// Computed minus measured.
    error: f64,
    /// The error in percent of the measured value.
    percent: f64,
    /// `true` if the computed value rounds to the published one.
    within_digits: bool,
    /// The error on record, in percent; null if there is none.
    recorded_percent: Option<f64>,
    /// Computed by the law of Kudlich and Slibar.
    #[serde(skip_serializing_if = "Option::is_none")]
    kudlich_slibar: Option<Other>,
    /// Computed with the stiffness obtained from the profile itself.
    #[serde(skip_serializing_if = "Option::is_none")]
    by_profile: Option<Other>,
}

/// A value computed in another way.
#[derive(Serialize, JsonSchema)]
struct Other {
    /// The computed value.
    computed: f64,
    /// Computed minus measured.
    error: f64,
    /// The error in percent of the measured value.
    percent: f64,
}

/// A small-overlap barrier test.
#[derive(Serialize, JsonSchema)]
struct SmallOverlapEntry<'a> {
    /// Its number.
    test: &'a str,
    /// ΔV.
    delta_v: ReadingEntry<'a>,
    /// Yaw rate, clockwise.
    yaw_rate: ReadingEntry<'a>,
    /// `true` if the computed yaw rate has the direction of the measured one by both laws.
    turns_as_measured: bool,
    /// Reason for the errors.
    reason: &'a str,
}

/// Root mean squares by each tangential law.
#[derive(Serialize, JsonSchema)]
struct RootMeanSquares {
    /// By the paper's law.
    brach: Errors,
    /// By the law of Kudlich and Slibar.
    kudlich_slibar: Errors,
}

/// Root mean squares of errors.
#[derive(Serialize, JsonSchema)]
struct Errors {
    /// Of ΔV, in ft/s.
    delta_v: Size,
    /// Of the yaw rate, in deg/s.
    yaw_rate: Size,
}

/// The size of an error.
#[derive(Serialize, JsonSchema)]
struct Size {
    /// In the unit of the quantity.
    error: f64,
    /// In percent of the measured value.
    percent: f64,
}

/// A full-frontal barrier test.
#[derive(Serialize, JsonSchema)]
struct FrontalEntry<'a> {
    /// Its number.
    test: &'a str,
    /// The vehicle.
    vehicle: &'a str,
    /// Mean crush depth over the width, in m.
    mean_depth: f64,
    /// The coefficients of the crush line through the test.
    coefficients: Vec<CoefficientEntry<'a>>,
    /// Crush energy of the profile, compared with the kinetic energy of the test, in J.
    crush_energy: ReadingEntry<'a>,
    /// Excess of the energy of the profile over that of a flat one with the same mean depth, in J.
    unevenness: f64,
    /// Speed of the test as published, in m/s.
    speed: &'a str,
    /// Speed equivalent to the energy of the profile, in m/s.
    speed_of_crush: f64,
    /// Reason for the error.
    reason: &'a str,
}

/// A coefficient of the crush line.
#[derive(Serialize, JsonSchema)]
struct CoefficientEntry<'a> {
    /// Its symbol.
    name: &'a str,
    /// Its unit.
    unit: &'a str,
    /// The computed value.
    computed: f64,
    /// The value as published; null if none is.
    published: Option<&'a str>,
}

impl<'a> Measured<'a> {
    pub(super) fn of(measured: &'a planar_impact_validation::Measured) -> Self {
        let tests = &measured.small_overlap;
        Measured {
            small_overlap: tests.iter().map(SmallOverlapEntry::of).collect(),
            small_overlap_root_mean_square: RootMeanSquares {
                brach: Errors::of(SmallOverlap::root_mean_squares(tests)),
                kudlich_slibar: Errors::of(SmallOverlap::kudlich_slibar_root_mean_squares(tests)),
            },
            full_frontal: measured.frontal.iter().map(FrontalEntry::of).collect(),
            worked: measured.worked.iter().map(WorkedEntry::of).collect(),
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

impl<'a> WorkedEntry<'a> {
    fn of(worked: &'a Worked) -> Self {
        WorkedEntry {
            example: &worked.example,
            quantity: worked.reading.quantity,
            reading: ReadingEntry::of(&worked.reading),
            holds: worked.holds(),
            source: &worked.source,
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
