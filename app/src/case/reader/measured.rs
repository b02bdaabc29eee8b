//! A measurement: a value and its uncertainty.

use planar_impact::reconstruct::Uncertainty;

use super::CaseReader;
use crate::document::{Field, Table, Value};
use crate::quantity::{self, Kind, QuantityError};
use crate::units::Measure;

/// The sign between a value and its standard deviation.
const PLUS_MINUS: [&str; 3] = ["±", "+/-", "+-"];

/// Written instead of a crush energy to take it from the crush in the file.
const FROM_CRUSH: &str = "from crush";

/// A measurement as written in the file.
pub(super) struct Measured {
    pub(super) amount: Amount,
    pub(super) spread: Spread,
}

/// A value, or where to take it from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Amount {
    Number(f64),
    FromCrush,
}

/// The uncertainty of a value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Spread {
    Exact,
    StandardDeviation(f64),
    Resolution(f64),
    /// A fraction of the value.
    Relative(f64),
}

impl Spread {
    /// Returns the uncertainty of `value`. A standard deviation of zero means exact.
    pub(super) fn of(self, value: f64) -> Uncertainty {
        match self {
            Spread::Exact => Uncertainty::Exact,
            Spread::StandardDeviation(sd) => above_zero(sd, Uncertainty::StandardDeviation),
            Spread::Resolution(step) => above_zero(step, Uncertainty::Resolution),
            Spread::Relative(share) => above_zero(share * value.abs(), Uncertainty::StandardDeviation),
        }
    }
}

fn above_zero(size: f64, uncertainty: fn(f64) -> Uncertainty) -> Uncertainty {
    if size > 0.0 { uncertainty(size) } else { Uncertainty::Exact }
}

impl CaseReader {
    /// Reads a value, a value with ± and its standard deviation, or { value, sd } or { value, resolution }.
    pub(super) fn measured(&self, field: Field<'_>, measure: Measure) -> Option<Measured> {
        match field.value() {
            Some(Value::Table(_)) => self.measured_in(&field.table()?, measure),
            Some(Value::String(text)) => match PLUS_MINUS.iter().find_map(|sign| text.split_once(sign)) {
                Some((value, deviation)) => self.with_deviation(&field, value, deviation, measure),
                None => Some(Measured { amount: self.amount(field, measure)?, spread: Spread::Exact }),
            },
            _ => Some(Measured { amount: self.amount(field, measure)?, spread: Spread::Exact }),
        }
    }

    fn amount(&self, field: Field<'_>, measure: Measure) -> Option<Amount> {
        match field.value() {
            Some(Value::String(text)) if measure == Measure::Energy && text.trim() == FROM_CRUSH => Some(Amount::FromCrush),
            _ => self.quantity(field, measure.into()).map(Amount::Number),
        }
    }

    fn with_deviation(&self, field: &Field<'_>, value: &str, deviation: &str, measure: Measure) -> Option<Measured> {
        let kind = Kind::from(measure);
        let share = deviation.trim().ends_with('%') && measure == Measure::Energy;
        let (amount, size, spread): (_, f64, fn(f64) -> Spread) = if value.trim() == FROM_CRUSH && measure == Measure::Energy {
            let kind = if share { Kind::PURE } else { kind.difference() };
            let spread = if share { Spread::Relative } else { Spread::StandardDeviation };
            (Amount::FromCrush, accept(field, quantity::parse(deviation, kind))?.si, spread)
        } else if share {
            let value = accept(field, quantity::parse(value, kind))?;
            let share = accept(field, quantity::parse(deviation, Kind::PURE))?;
            (Amount::Number(self.take(field.path(), value)), share.si, Spread::Relative)
        } else {
            let [value, deviation] = accept(field, quantity::parse_pair(value, deviation, kind))?;
            (Amount::Number(self.take(field.path(), value)), deviation.si, Spread::StandardDeviation)
        };
        if size < 0.0 {
            field.report("the standard deviation is below zero", None);
            return None;
        }
        Some(Measured { amount, spread: spread(size) })
    }

    fn measured_in(&self, table: &Table<'_>, measure: Measure) -> Option<Measured> {
        let amount = self.amount(table.required("value"), measure);
        let size = |key, kind: Kind| self.not_negative(table.optional(key), kind);
        let difference = Kind::from(measure).difference();
        let has_share = measure == Measure::Energy && table.has("relative");
        let given = [
            table.has("sd").then(|| size("sd", difference).map(Spread::StandardDeviation)),
            table.has("resolution").then(|| size("resolution", difference).map(Spread::Resolution)),
            has_share.then(|| size("relative", Kind::PURE).map(Spread::Relative)),
        ];
        table.finish();
        let mut spreads = given.into_iter().flatten();
        let spread = spreads.next().unwrap_or(Some(Spread::Exact));
        if spreads.next().is_some() {
            let help = "a resolution is the step of a record, and has a standard deviation of its own: the step over the root of 12";
            table.issue("it has more than one of `sd`, `resolution` and `relative`", Some(help.to_owned()));
            return None;
        }
        Some(Measured { amount: amount?, spread: spread? })
    }
}

fn accept<T>(field: &Field<'_>, read: Result<T, QuantityError>) -> Option<T> {
    read.map_err(|error| field.report(error.message, error.help)).ok()
}

/// Returns `true` if a value is a table of further names, not a table that has any of the keys `said`.
pub(super) fn is_folder(field: &Field<'_>, said: &[&str]) -> bool {
    match field.value() {
        Some(Value::Table(entries)) => !entries.is_empty() && !entries.iter().any(|entry| said.contains(&entry.key.as_str())),
        _ => false,
    }
}
