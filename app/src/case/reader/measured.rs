//! A value and its uncertainty, of evidence and of inputs.

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use planar_impact::Distribution;
use planar_impact::barrier::Estimate;
use planar_impact::reconstruct::Uncertainty;

use super::CaseReader;
use super::sample::normal_of;
use crate::case::domain::Domain;
use crate::document::{Field, Table, Value};
use crate::message::Message;
use crate::notice::Notice;
use crate::quantity::{self, Kind, QuantityError};
use crate::units::{Measure, trim};

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

/// An input as the file gives it.
pub(super) struct Distributed {
    /// The value that a computation with one number uses.
    pub(super) nominal: f64,
    /// Its distribution; `None` if it is certain.
    pub(super) distribution: Option<Distribution>,
    /// Its measured values, if the file gives them.
    pub(super) values: Option<Arc<[f64]>>,
}

impl From<(f64, Option<Distribution>)> for Distributed {
    fn from((nominal, distribution): (f64, Option<Distribution>)) -> Self {
        Distributed { nominal, distribution, values: None }
    }
}

impl Distributed {
    /// Returns the same input divided by a number above zero.
    fn over(self, divisor: f64) -> Self {
        if let Some(values) = self.values {
            return Distributed::of_values(values.iter().map(|value| value / divisor).collect());
        }
        let distribution = self.distribution.map(|distribution| distribution.over(divisor));
        (distribution.map_or(self.nominal / divisor, |distribution| distribution.nominal()), distribution).into()
    }

    fn of_values(values: Arc<[f64]>) -> Self {
        let (mean, sd) = normal_of(&values);
        Distributed { nominal: mean, distribution: Some(Distribution::Normal { mean, sd }), values: Some(values) }
    }
}

impl CaseReader {
    /// Reads a value, a value with ± and its standard deviation, { value, sd }, { value, resolution } or { value, relative }, or any other distribution of an
    /// uncertain number by its mean and standard deviation.
    pub(super) fn measured(&self, field: Field<'_>, measure: Measure) -> Option<Measured> {
        let key = field.path().to_owned();
        let measured = self.measured_at(field, measure)?;
        if let Amount::Number(value) = measured.amount {
            let size = match measured.spread.of(value) {
                Uncertainty::StandardDeviation(sd) => Some((format!("{key} sd"), sd, measure)),
                Uncertainty::Resolution(step) => Some((format!("{key} resolution"), step, measure)),
                Uncertainty::Exact => None,
            };
            self.contents.borrow_mut().numbers(&key, [(key.clone(), value, measure)].into_iter().chain(size));
        }
        Some(measured)
    }

    fn measured_at(&self, field: Field<'_>, measure: Measure) -> Option<Measured> {
        match field.value() {
            Some(Value::Table(entries)) if entries.iter().any(|entry| is_of_distribution(&entry.key)) => self.moments(field, measure),
            Some(Value::Table(_)) => self.measured_in(&field.table()?, measure),
            Some(Value::String(text)) => match PLUS_MINUS.iter().find_map(|sign| text.split_once(sign)) {
                Some((value, deviation)) => self.with_deviation(&field, value, deviation, measure.into()),
                None => Some(Measured { amount: self.amount(field, measure)?, spread: Spread::Exact }),
            },
            _ => Some(Measured { amount: self.amount(field, measure)?, spread: Spread::Exact }),
        }
    }

    /// Reads a value with its uncertainty, as an estimate.
    pub(crate) fn measured_estimate(&self, field: Field<'_>, measure: Measure) -> Option<Estimate> {
        let Measured { amount: Amount::Number(value), spread } = self.measured(field, measure)? else { return None };
        Some(Estimate::with_deviation(value, spread.of(value).standard_deviation().unwrap_or(0.0)))
    }

    /// Reads a positive value with its uncertainty, as an estimate.
    pub(crate) fn positive_estimate(&self, field: Field<'_>, measure: Measure) -> Option<Estimate> {
        let place = field.clone();
        let Measured { amount: Amount::Number(value), spread } = self.measured(field, measure)? else { return None };
        let value = self.above_zero(&place, value, measure.into())?;
        Some(Estimate::with_deviation(value, spread.of(value).standard_deviation().unwrap_or(0.0)))
    }

    /// Reads a distribution as a measurement: evidence is normal, so its mean and standard deviation are what counts.
    fn moments(&self, field: Field<'_>, measure: Measure) -> Option<Measured> {
        let (place, path) = (field.clone(), field.path().to_owned());
        let read = self.distribution_in(&field.table()?, measure.into(), Domain::Any)?;
        let is_of_few = matches!(read.distribution, Some(Distribution::StudentT { .. }));
        let (mean, sd) = read.distribution.map_or((read.nominal, 0.0), |distribution| (distribution.mean(), distribution.sd()));
        if !(mean.is_finite() && sd.is_finite()) {
            let help = "a mean of two or three measurements has none: give more, or `sd` alone".to_owned();
            place.report("this distribution has no standard deviation", Some(help));
            return None;
        }
        let message = Message::from(format!("{path}: it counts as normal, by the mean of its distribution, "))
            .figure(measure, mean)
            .text(", and its standard deviation, ")
            .figure(measure, sd)
            .text(if is_of_few { "; of few measurements intervals of more than 95 % are too narrow" } else { "" });
        self.notices.borrow_mut().push(Notice::note("moments-of-distribution", path, message));
        Some(Measured { amount: Amount::Number(mean), spread: Spread::StandardDeviation(sd) })
    }

    fn amount(&self, field: Field<'_>, measure: Measure) -> Option<Amount> {
        match field.value() {
            Some(Value::String(text)) if measure == Measure::Energy && text.trim() == FROM_CRUSH => Some(Amount::FromCrush),
            _ => self.quantity(field, measure.into()).map(Amount::Number),
        }
    }

    fn with_deviation(&self, field: &Field<'_>, value: &str, deviation: &str, kind: Kind) -> Option<Measured> {
        let [is_of_value, is_of_deviation] = [value, deviation].map(|text| text.trim().ends_with('%'));
        let is_pure = kind.dimension == Kind::PURE.dimension;
        if is_pure && is_of_deviation && !is_of_value {
            let help = "write the standard deviation as a number, or { value = \u{2026}, relative = \u{2026} } for a share of the value";
            field.report(
                "the percent sign after a number without a unit may mean a hundredth or a share of the value",
                Some(help.to_owned()),
            );
            return None;
        }
        if is_pure && is_of_value && !is_of_deviation {
            let help = format!("write both as numbers, or \"{} \u{b1} {} %\"", value.trim(), deviation.trim());
            field.report("the value is in percent, and its standard deviation is not", Some(help));
            return None;
        }
        let share = is_of_deviation && !is_pure;
        let (amount, size, spread): (_, f64, fn(f64) -> Spread) = if value.trim() == FROM_CRUSH && kind.name == Kind::ENERGY.name {
            let kind = if share { Kind::PURE } else { kind.difference() };
            let spread = if share { Spread::Relative } else { Spread::StandardDeviation };
            (Amount::FromCrush, accept(field, quantity::parse(deviation, kind))?.si, spread)
        } else if share {
            let value = accept(field, quantity::parse(value, kind))?;
            let share = accept(field, quantity::parse(deviation, Kind::PURE))?;
            (Amount::Number(self.take(field.path(), value, kind)), share.si, Spread::Relative)
        } else {
            let [value, deviation] = accept(field, quantity::parse_pair(value, deviation, kind).map_err(|error| error.expected(&kind)))?;
            (Amount::Number(self.take(field.path(), value, kind)), deviation.si, Spread::StandardDeviation)
        };
        if size < 0.0 {
            field.report("the standard deviation is below zero", None);
            return None;
        }
        if share && size > 1.0 {
            let help = "a share of the value is at most 100 %; for more, write the standard deviation in the unit of the value".to_owned();
            field.report_as("out-of-range", format!("the standard deviation is {} % of the value", trim(100.0 * size)), Some(help));
            return None;
        }
        let spread = spread(size);
        self.doubt(field.path(), spread, kind);
        Some(Measured { amount, spread })
    }

    fn measured_in(&self, table: &Table<'_>, measure: Measure) -> Option<Measured> {
        let amount = self.amount(table.required("value"), measure);
        let spread = self.spread(table, measure.into(), true);
        table.finish();
        let (amount, spread) = (amount?, spread?);
        if let (Amount::Number(0.0), Spread::Relative(share)) = (amount, spread)
            && share > 0.0
        {
            table.optional("relative").report("the value is 0, and so is any share of it", Some("give `sd`".to_owned()));
            return None;
        }
        Some(Measured { amount, spread })
    }

    /// Reads at most one of `sd`, `resolution` and, if `has_share`, `relative`.
    fn spread(&self, table: &Table<'_>, kind: Kind, has_share: bool) -> Option<Spread> {
        let size = |key, kind: Kind| self.not_negative(table.optional(key), kind);
        let has_share = has_share && table.has("relative");
        let given = [
            table.has("sd").then(|| size("sd", kind.difference()).map(Spread::StandardDeviation)),
            table.has("resolution").then(|| size("resolution", kind.difference()).map(Spread::Resolution)),
            has_share.then(|| self.coefficient(table.optional("relative"), 1.0).map(Spread::Relative)),
        ];
        let mut spreads = given.into_iter().flatten();
        let spread = spreads.next().unwrap_or(Some(Spread::Exact));
        if spreads.next().is_some() {
            let help = "a resolution is the step of a record, and has a standard deviation of its own: the step over the root of 12";
            table.issue("it has more than one of `sd`, `resolution` and `relative`", Some(help.to_owned()));
            return None;
        }
        self.doubt(table.path(), spread?, kind);
        spread
    }

    /// Warns of the standard deviation of an angle that is a share of it, or nearly that of any direction.
    fn doubt(&self, path: &str, spread: Spread, kind: Kind) {
        /// In rad; that of any direction is π/√3.
        const GREATEST: f64 = 1.0;
        let (code, message): (_, Message) = match spread {
            Spread::Relative(share) if share > 0.0 => {
                ("share-of-angle", "a share of an angle depends on where angles count from; give its standard deviation in degrees".into())
            }
            Spread::StandardDeviation(sd) if sd > GREATEST => {
                let of = Message::from("a standard deviation of ").figure(Measure::Angle, sd);
                ("unusual-sd", of.text(" leaves an angle almost unknown; check its unit"))
            }
            _ => return,
        };
        if kind.dimension == Kind::ANGLE.dimension {
            self.notices.borrow_mut().push(Notice::warning(code, path, Message::from(format!("{path}: ")).join(message)));
        }
    }

    /// Reads the mass of a vehicle from its weight, which may be uncertain.
    pub(super) fn mass_of_weight(&self, field: Field<'_>, gravity: f64) -> Option<Distributed> {
        let place = field.clone();
        let mass = self.distributed(field, Kind::WEIGHT, Domain::Positive)?.over(gravity);
        if !Kind::MASS.domain.holds(mass.nominal) {
            place.report(format!("with a gravity of {gravity} m/s^2 it makes {} kg, which is no mass of a vehicle", mass.nominal), None);
            return None;
        }
        Some(mass)
    }

    /// Reads an input that may be uncertain.
    pub(super) fn distributed(&self, field: Field<'_>, kind: Kind, domain: Domain) -> Option<Distributed> {
        let text = match field.value() {
            Some(Value::Table(_)) => return self.distribution_in(&field.table()?, kind, domain),
            Some(Value::String(text)) => PLUS_MINUS.iter().find_map(|sign| text.split_once(sign)),
            _ => None,
        };
        let Some((value, deviation)) = text else { return Some((self.certain(field, kind, domain)?, None).into()) };
        let measured = self.with_deviation(&field, value, deviation, kind)?;
        let Measured { amount: Amount::Number(value), spread } = measured else { return None };
        let value = self.within(&field, value, kind, domain)?;
        Some((value, self.distribution_of(&field, value, spread, kind, domain)?).into())
    }

    /// Returns the distribution of a value with a spread; `Some(None)` if it is exact.
    fn distribution_of(&self, place: &Field<'_>, value: f64, spread: Spread, kind: Kind, domain: Domain) -> Option<Option<Distribution>> {
        let normal = |sd: f64| (sd > 0.0).then_some(Distribution::Normal { mean: value, sd });
        Some(match spread {
            Spread::Exact => None,
            Spread::StandardDeviation(sd) => normal(sd),
            Spread::Relative(share) if share > 0.0 && value == 0.0 => {
                place.report("the value is 0, and so is any share of it", Some("give `sd`".to_owned()));
                return None;
            }
            Spread::Relative(share) => normal(share * value.abs()),
            Spread::Resolution(step) if step > 0.0 => {
                let distribution = Distribution::of_resolution(value, step);
                let (min, max) = distribution.support();
                if let Some(wanted) = [min, max].into_iter().find_map(|end| domain.wanted(end)) {
                    let unit = kind.si;
                    let message = format!("half a step from the value it is from {min} {unit} to {max} {unit}; it must be {wanted}");
                    place.report(message, Some("give its limits instead: { min, max }".to_owned()));
                    return None;
                }
                Some(distribution)
            }
            Spread::Resolution(_) => None,
        })
    }

    fn distribution_in(&self, table: &Table<'_>, kind: Kind, domain: Domain) -> Option<Distributed> {
        let given: Vec<&'static str> = DISTRIBUTION_KEYS.into_iter().filter(|key| table.has(key)).collect();
        let has = |key: &str| given.contains(&key);
        // The key that decides what the others mean.
        let deciding = ["values", "file", "column", "n", "mean", "median", "factor", "value", "mode", "min", "max"];
        let by = deciding.into_iter().find(|key| has(key)).unwrap_or("value");
        let allowed: &[&str] = match by {
            "values" => &["values"],
            "file" | "column" => &["file", "column"],
            "n" | "mean" => &["mean", "sd", "n"],
            "median" | "factor" => &["median", "factor"],
            "value" => &["value", "sd", "resolution", "relative", "min", "max"],
            _ => &["min", "mode", "max"],
        };
        let mut sound = true;
        for key in given.iter().filter(|key| !allowed.contains(key)) {
            let help = match listed(allowed.iter().filter(|key| **key != by)) {
                others if others.is_empty() => format!("give `{by}` alone"),
                others => format!("with `{by}` go {others}"),
            };
            table.optional(key).report(format!("`{key}` and `{by}` exclude each other"), Some(help));
            sound = false;
        }
        if ["values", "file", "column"].contains(&by) {
            let values = if by == "values" { self.values_of_list(table, kind, domain) } else { self.values_of_file(table, kind, domain) };
            table.finish();
            return values.filter(|_| sound).map(|values| Distributed::of_values(values.into()));
        }
        let read = self.distribution_by(by, table, kind, domain);
        table.finish();
        read.filter(|_| sound).map(Distributed::from)
    }

    /// Reads the numbers of a distribution by the key that decides what they mean.
    fn distribution_by(&self, by: &str, table: &Table<'_>, kind: Kind, domain: Domain) -> Option<(f64, Option<Distribution>)> {
        let has = |key: &'static str| table.has(key);
        let number = |key| self.certain(table.required(key), kind, domain);
        let mut sound = true;
        let read = match by {
            "n" | "mean" => self.mean_of_measurements(table, kind, domain),
            "median" | "factor" => {
                let median = self.certain(table.required("median"), kind, domain);
                let factor = self.quantity(table.required("factor"), Kind::PURE);
                median.zip(factor).and_then(|(median, factor)| log_normal(table, kind, median, factor))
            }
            "value" => {
                let value = number("value");
                let spread = self.spread(table, kind, true);
                let limits = (has("min") || has("max")).then(|| [number("min"), number("max")]);
                match limits {
                    None if has("value") && !["sd", "resolution", "relative"].into_iter().any(has) => {
                        table.issue("missing `sd`, `relative` or `resolution`", Some("a certain number needs no table".to_owned()));
                        None
                    }
                    None => {
                        let (value, spread) = (value?, spread?);
                        let key = if has("resolution") { "resolution" } else { "relative" };
                        let place = if has(key) { table.optional(key) } else { table.optional("value") };
                        let distribution = self.distribution_of(&place, value, spread, kind, domain);
                        distribution.map(|distribution| (value, distribution))
                    }
                    Some([min, max]) => {
                        if has("resolution") {
                            table.optional("resolution").report("a resolution has limits of its own: half a step from the value", None);
                            sound = false;
                        } else if !has("sd") && !has("relative") {
                            table.required("sd").quantity(kind.difference());
                        }
                        let (value, spread, min, max) = (value?, spread?, min?, max?);
                        let sd = match spread {
                            Spread::StandardDeviation(sd) => Some(sd),
                            Spread::Relative(share) => Some(share * value.abs()),
                            _ => None,
                        };
                        let is_ordered = is_between(table, kind, min, max, Some(("value", value)));
                        if let Some(sd) = sd.filter(|sd| *sd <= 0.0) {
                            let key = if has("sd") { "sd" } else { "relative" };
                            let message = format!("the standard deviation is {sd}; between limits it must be above zero");
                            table.optional(key).report(message, None);
                            sound = false;
                        }
                        let scale = sd.filter(|_| is_ordered);
                        scale.map(|scale| (value, Some(Distribution::TruncatedNormal { mode: value, scale, min, max })))
                    }
                }
            }
            _ => {
                let (min, max) = (number("min"), number("max"));
                let mode = has("mode").then(|| number("mode"));
                let (min, max) = (min?, max?);
                let mode = match mode {
                    Some(mode) => Some(mode?),
                    None => None,
                };
                let distribution = match mode {
                    Some(mode) => Distribution::Triangular { min, mode, max },
                    None => Distribution::Uniform { min, max },
                };
                let is_ordered = is_between(table, kind, min, max, mode.map(|mode| ("mode", mode)));
                is_ordered.then(|| (distribution.nominal(), Some(distribution)))
            }
        };
        read.filter(|_| sound)
    }
}

/// Every key of a table that describes the distribution of an input.
pub(super) const DISTRIBUTION_KEYS: [&str; 14] =
    ["value", "sd", "resolution", "relative", "min", "mode", "max", "median", "factor", "mean", "n", "values", "file", "column"];

/// Returns `true` for the keys that a value with a spread does not have.
fn is_of_distribution(key: &str) -> bool {
    DISTRIBUTION_KEYS.contains(&key) && !["value", "sd", "resolution", "relative"].contains(&key)
}

/// Lists keys as in `` `a`, `b` and `c` ``.
fn listed<'a>(keys: impl Iterator<Item = &'a &'a str>) -> String {
    let keys: Vec<String> = keys.map(|key| format!("`{key}`")).collect();
    match keys.split_last() {
        Some((last, [])) => last.clone(),
        Some((last, others)) => format!("{} and {last}", others.join(", ")),
        None => String::new(),
    }
}

fn log_normal(table: &Table<'_>, kind: Kind, median: f64, factor: f64) -> Option<(f64, Option<Distribution>)> {
    let mut sound = true;
    if median <= 0.0 {
        table.optional("median").report_as("not-positive", format!("it is {median} {}; it must be above zero", kind.si), None);
        sound = false;
    }
    if factor <= 1.0 {
        let help = "the natural logarithm of the factor is the standard deviation of that of the number";
        table.optional("factor").report_as("out-of-range", format!("it is {factor}; it must be above 1"), Some(help.to_owned()));
        sound = false;
    }
    sound.then(|| (median, Some(Distribution::of_factor(median, factor))))
}

/// Returns `true` if the limits are in order and a named value lies between them; reports the issue otherwise.
fn is_between(table: &Table<'_>, kind: Kind, min: f64, max: f64, value: Option<(&'static str, f64)>) -> bool {
    let written = |key| as_written(&table.optional(key), kind);
    if min >= max {
        let help = match min == max {
            true => Some("a number that is known has no `min` and `max`: write the number alone".to_owned()),
            false => across_zero(kind, [min, max]),
        };
        let message = format!("it is {}; it must be above `min`, {}", written("max"), written("min"));
        table.optional("max").report_as("out-of-order", message, help);
        return false;
    }
    match value.filter(|(_, value)| !(min..=max).contains(value)) {
        Some((key, value)) => {
            let message = format!("it is {}; it must be from `min`, {}, to `max`, {}", written(key), written("min"), written("max"));
            table.optional(key).report_as("out-of-range", message, same_direction(kind, value, [min, max]));
            false
        }
        None => true,
    }
}

/// Returns a number as the file has it, with the unit in which it counts if it has none.
fn as_written(field: &Field<'_>, kind: Kind) -> String {
    match field.value() {
        Some(Value::Number(number)) => format!("{} {}", number.text, kind.si).trim_end().to_owned(),
        Some(Value::String(text)) => text.clone(),
        _ => String::new(),
    }
}

/// Returns the remedy for an angle beyond its limits that is within them after a turn.
pub(super) fn same_direction(kind: Kind, angle: f64, [min, max]: [f64; 2]) -> Option<String> {
    let turned = || [angle - TAU, angle + TAU].into_iter().find(|angle| (min..=max).contains(angle));
    (kind.dimension == Kind::ANGLE.dimension).then(turned)?.map(|angle| format!("the same direction is {} deg", trim(angle.to_degrees())))
}

/// Returns the remedy for limits of an angle that cross, as from 350 to 10 degrees.
pub(super) fn across_zero(kind: Kind, [min, max]: [f64; 2]) -> Option<String> {
    let is_narrow = kind.dimension == Kind::ANGLE.dimension && (0.0..PI).contains(&(max - (min - TAU)));
    is_narrow.then(|| format!("for limits on both sides of 0 deg write `min` as {} deg", trim((min - TAU).to_degrees())))
}

/// Returns `true` if a text has a standard deviation after its value.
pub(super) fn has_deviation(text: &str) -> bool {
    PLUS_MINUS.iter().any(|sign| text.contains(sign))
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
