//! The second stage: tests not in the paper, computed and compared with measurements; and the third: worked examples of the field.
//!
//! This stage does not judge how well the paper is reproduced, and fits nothing: errors are reported as they are. A
//! run fails if nothing can be computed, if a vehicle turns the wrong way, if a published coefficient is not
//! reproduced, or if an error differs from the recorded one, for better or worse.

mod frontal;
mod small_overlap;
mod worked;

use crate::data::DataError;
use crate::sheet::{Printed, Row};
use planar_impact::scalar::Field as _;
use std::fmt;

pub use frontal::{Coefficient, Frontal};
pub use small_overlap::SmallOverlap;
pub use worked::Worked;

/// The measured tests of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
    /// Small-overlap barrier tests: ΔV and yaw rate.
    pub small_overlap: Vec<SmallOverlap>,
    /// Full-frontal barrier tests: stiffness and crush energy.
    pub frontal: Vec<Frontal>,
    /// Worked examples and staged collisions of the field.
    pub worked: Vec<Worked>,
}

/// A measured number compared with the computed one.
#[derive(Clone, Debug, PartialEq)]
pub struct Reading {
    /// The measured quantity.
    pub quantity: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// The published value.
    pub measured: Printed,
    /// The computed value, by the tangential law of the paper if a law applies.
    pub computed: f64,
    /// The error in percent when the test was added, if it was recorded.
    pub recorded: Option<Printed>,
}

/// Root mean square error over the tests.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RootMeanSquare {
    /// In the unit of the quantity.
    pub error: f64,
    /// In percent of the measured value.
    pub percent: f64,
}

/// Reason why the measured tests do not hold.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum MeasuredProblem {
    /// The car turns the wrong way.
    Turn {
        /// The test.
        test: String,
    },
    /// An error is not the recorded one; it is larger or smaller.
    NotAsRecorded {
        /// The test.
        test: String,
        /// The reading, with its error.
        reading: Reading,
    },
    /// A published coefficient is not reproduced.
    Coefficient {
        /// The test.
        test: String,
        /// The coefficient.
        coefficient: Coefficient,
    },
    /// A number worked by hand does not come out to its digits.
    Worked {
        /// The example.
        example: String,
        /// The number.
        reading: Reading,
    },
    /// There are no tests of one kind.
    None {
        /// The kind.
        kind: &'static str,
    },
    /// A test occurs twice.
    Repeated {
        /// The test.
        test: String,
    },
}

impl Reading {
    /// Returns computed minus measured.
    pub fn error(&self) -> f64 {
        self.error_of(self.computed)
    }

    /// Returns the error in percent of the measured value.
    pub fn percent(&self) -> f64 {
        self.percent_of(self.computed)
    }

    /// Returns the error of another computed number.
    pub fn error_of(&self, computed: f64) -> f64 {
        computed - self.measured.value()
    }

    /// Returns the error of another computed number, in percent of the measured value.
    pub fn percent_of(&self, computed: f64) -> f64 {
        100.0 * self.error_of(computed) / self.measured.value()
    }

    /// Returns `true` if the computed number rounds to the published digits, the only uncertainty that the tests state.
    pub fn is_within_digits(&self) -> bool {
        self.measured.agrees_with(self.computed)
    }

    /// Returns `true` if the error rounds to the recorded one, including its sign. A smaller error does not count: it must be recorded.
    pub fn is_as_recorded(&self) -> bool {
        self.recorded.as_ref().is_none_or(|recorded| recorded.agrees_with(self.percent()))
    }
}

impl RootMeanSquare {
    /// Computes the root mean square of readings, each with a computed number.
    pub(crate) fn of<'a>(readings: impl IntoIterator<Item = (&'a Reading, f64)>) -> Self {
        let (mut errors, mut percents, mut count) = (0.0, 0.0, 0.0);
        for (reading, computed) in readings {
            errors += reading.error_of(computed).squared();
            percents += reading.percent_of(computed).squared();
            count += 1.0;
        }
        RootMeanSquare { error: f64::sqrt(errors / count), percent: f64::sqrt(percents / count) }
    }
}

impl Measured {
    pub(crate) fn read(iihs: &str, nhtsa: &str, worked: &str) -> Result<Self, DataError> {
        Ok(Measured { small_overlap: small_overlap::read(iihs)?, frontal: frontal::read(nhtsa)?, worked: worked::read(worked)? })
    }

    /// Returns every reading of a measured test, with its name.
    pub fn readings(&self) -> impl Iterator<Item = (&str, &Reading)> {
        let overlap =
            self.small_overlap.iter().flat_map(|test| [&test.delta_v, &test.yaw_rate].map(|reading| (test.test.as_str(), reading)));
        overlap.chain(self.frontal.iter().map(|test| (test.test.as_str(), &test.energy)))
    }

    /// Returns the failures; empty if everything holds.
    pub fn problems(&self) -> Vec<MeasuredProblem> {
        let name = |test: &str| test.to_owned();
        let kinds = [("small-overlap", self.small_overlap.len()), ("full-frontal", self.frontal.len()), ("worked", self.worked.len())];
        let missing = kinds.into_iter().filter(|kind| kind.1 == 0);
        let mut problems: Vec<_> = missing.map(|(kind, _)| MeasuredProblem::None { kind }).collect();
        for test in self.small_overlap.iter().filter(|test| !test.turns_as_measured()) {
            problems.push(MeasuredProblem::Turn { test: name(&test.test) });
        }
        for (test, reading) in self.readings().filter(|(_, reading)| !reading.is_as_recorded()) {
            problems.push(MeasuredProblem::NotAsRecorded { test: name(test), reading: reading.clone() });
        }
        for test in &self.frontal {
            for coefficient in test.coefficients.iter().filter(|coefficient| !coefficient.is_as_published()) {
                problems.push(MeasuredProblem::Coefficient { test: name(&test.test), coefficient: coefficient.clone() });
            }
        }
        for Worked { example, reading, .. } in self.worked.iter().filter(|worked| !worked.holds()) {
            let (example, reading) = (name(example), reading.clone());
            problems.push(match reading.recorded {
                Some(_) => MeasuredProblem::NotAsRecorded { test: example, reading },
                None => MeasuredProblem::Worked { example, reading },
            });
        }
        let names: Vec<&str> =
            self.small_overlap.iter().map(|t| t.test.as_str()).chain(self.frontal.iter().map(|t| t.test.as_str())).collect();
        for (_, test) in names.iter().enumerate().filter(|(which, test)| names[..*which].contains(test)) {
            problems.push(MeasuredProblem::Repeated { test: name(test) });
        }
        problems
    }
}

/// Returns the error recorded in a row, which requires a reason.
fn recorded(file: &'static str, row: &Row<'_>, column: &'static str) -> Result<Option<Printed>, DataError> {
    recorded_as(file, row, column, "reason")
}

/// The same with the name of the column that has the reason.
fn recorded_as(file: &'static str, row: &Row<'_>, column: &'static str, reason: &'static str) -> Result<Option<Printed>, DataError> {
    let recorded = row.number_if_any(column)?;
    if recorded.is_some() && row.text(reason)?.is_empty() {
        return Err(DataError::UnknownWord { file, column: reason, field: String::new() });
    }
    Ok(recorded)
}

impl fmt::Display for MeasuredProblem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            MeasuredProblem::Turn { test } => write!(f, "{test}: the car turns the wrong way"),
            MeasuredProblem::NotAsRecorded { test, reading } => {
                let recorded = reading.recorded.as_ref();
                let percent = reading.percent();
                write!(f, "{test}: {} is off by {percent:.2} %, recorded was {} %", reading.quantity, recorded.map_or("", Printed::text))?;
                if recorded.is_some_and(|recorded| percent.abs() < recorded.value().abs()) {
                    f.write_str("; it is better: record the new error")?;
                }
                Ok(())
            }
            MeasuredProblem::Coefficient { test, coefficient } => {
                let published = coefficient.published.as_ref().map_or("", Printed::text);
                write!(f, "{test}: {} is {}, published was {published}", coefficient.name, coefficient.computed)
            }
            MeasuredProblem::Worked { example, reading } => {
                write!(
                    f,
                    "{example}: {} is {}, published was {} {}",
                    reading.quantity,
                    reading.computed,
                    reading.measured.text(),
                    reading.unit
                )
            }
            MeasuredProblem::None { kind } => write!(f, "there are no {kind} tests"),
            MeasuredProblem::Repeated { test } => write!(f, "{test} stands there twice"),
        }
    }
}
