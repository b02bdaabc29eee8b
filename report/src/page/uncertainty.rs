//! The page of `uncertainty`: for each output its mean and deviation by each method, its quantiles, and what they are due to.

use std::iter;

use planar_impact_app::case::{CaseOutput, Parameter};
use planar_impact_app::uncertainty::{Bounds, OutputUncertainty, Probability, UncertainNumber, Uncertainty, ends};
use planar_impact_app::units::{Measure, Units, trim};

use super::Facts;
use super::rounding::{Toward, ended, without_sign_of_zero};
use crate::block::{Block, Table};

/// Number of inputs shown for an output.
const SHOWN: usize = 10;

impl Facts for Uncertainty {
    /// The middle range of each output.
    fn summary(&self, units: Units) -> Vec<Block> {
        let of = |(output, (name, found)): (&CaseOutput, (&str, &OutputUncertainty))| {
            let measure = output.measure();
            let measure = units.on_the_road(measure).unwrap_or(measure);
            let value =
                if found.value.is_finite() { units.quantity(measure, found.value) } else { "none at the nominal inputs".to_owned() };
            let quantiles = found.monte_carlo.as_ref().map(|samples| &samples.quantiles);
            let [low, high] = ends(self.level);
            let range = quantiles.and_then(|quantiles| Some((*quantiles.get(&low.to_string())?, *quantiles.get(&high.to_string())?)));
            let range = match (range, &found.linear) {
                (Some((low, high)), _) => {
                    format!(
                        ", {} % from {} to {}",
                        trim(100.0 * self.level),
                        units.number(measure, low, 0.0),
                        units.quantity(measure, high)
                    )
                }
                (None, Some(linear)) if !linear.sd.is_finite() => ", no finite standard deviation".to_owned(),
                (None, Some(linear)) => format!(", standard deviation {}", units.quantity(measure, linear.sd)),
                _ => String::new(),
            };
            Block::item("- ", format!("{name}: {value}{range}."))
        };
        self.outputs.iter().zip(self.of.iter()).map(of).collect()
    }

    /// The inputs, each output, and the probabilities.
    fn blocks(&self, units: Units) -> Vec<Block> {
        let mut blocks = vec![Block::paragraph(samples_drawn(self) + "."), table_of_inputs(self, units)];
        for (output, (name, found)) in self.outputs.iter().zip(self.of.iter()) {
            let of = Shown { all: self, of: *output, name, found, units };
            blocks.extend(of.blocks());
        }
        blocks.extend(table_of_probabilities(self));
        blocks
    }
}

/// Says what was sampled, and what of it was refused.
pub fn samples_drawn(answer: &Uncertainty) -> String {
    if answer.samples == 0 {
        return "From derivatives and limits, without samples".to_owned();
    }
    let reasons: Vec<String> = answer.refused.reasons.iter().map(|(code, count)| format!("{code} {count}")).collect();
    let refused = match answer.refused.count {
        0 => "physics refuses none".to_owned(),
        count => {
            let share = 100.0 * count as f64 / answer.samples as f64;
            // Few are not none.
            let decimals = (-libm::log10(share).floor()).clamp(2.0, 12.0) as usize;
            format!("physics refuses {count} ({share:.decimals$} %: {}), and the figures are of the others", reasons.join(", "))
        }
    };
    format!("{} samples (seed {}); {refused}", answer.samples, answer.seed)
}

fn table_of_inputs(answer: &Uncertainty, units: Units) -> Block {
    let row = |(parameter, (name, number)): (&Parameter, (&str, &UncertainNumber))| {
        let measure = parameter.measure();
        let shown = |si: f64| if si.is_finite() { with_digits(units, measure, si, number.sd) } else { "none".to_owned() };
        let range = format!("{} to {}", shown(number.range[0]), shown(number.range[1]));
        vec![name.to_owned(), shown(number.mean), shown(number.sd), units.unit(measure).to_owned(), range]
    };
    let rows = answer.parameters.iter().zip(answer.inputs.iter()).map(row).collect();
    Table::new(["uncertain input", "mean", "sd", "unit", "limits for bounds"], "lrrll", rows).narrow().with_optional(4).into()
}

fn table_of_probabilities(answer: &Uncertainty) -> Option<Block> {
    let row = |(text, found): (&str, &Probability)| {
        // Two digits of the standard error, and at least four decimals.
        let decimals = if found.se > 0.0 { (1.0 - libm::log10(found.se).floor()).clamp(4.0, 12.0) as usize } else { 4 };
        vec![text.to_owned(), format!("{:.decimals$}", found.value), format!("{:.decimals$}", found.se)]
    };
    let rows: Vec<Vec<String>> = answer.probabilities.iter().map(row).collect();
    (!rows.is_empty()).then(|| Table::new(["statement", "probability", "standard error"], "lrr", rows).into())
}

/// Formats a value with the decimals of two digits of a deviation.
pub(crate) fn with_digits(units: Units, measure: Measure, si: f64, sd: f64) -> String {
    let deviation = units.convert(measure, sd).abs();
    let value = units.convert(measure, si);
    let has_digits = deviation > 0.0 && deviation.is_finite() && (1e-9..1e12).contains(&value.abs().max(deviation));
    if !has_digits {
        return units.number(measure, si, 0.0);
    }
    let decimals = (1.0 - libm::log10(deviation).floor()).clamp(0.0, 12.0) as usize;
    without_sign_of_zero(format!("{value:.decimals$}"))
}

/// Formats a value of an output with the decimals of two digits of its deviation.
fn number(found: &OutputUncertainty, units: Units, measure: Measure, si: f64) -> String {
    let of_samples = found.monte_carlo.as_ref().map(|found| found.sd);
    let sd = of_samples.or(found.linear.as_ref().map(|found| found.sd)).filter(|sd| sd.is_finite()).unwrap_or(0.0);
    if si.is_finite() { with_digits(units, measure, si, sd) } else { "none".to_owned() }
}

/// Formats a value of an output with its unit.
pub(crate) fn quantity(found: &OutputUncertainty, units: Units, measure: Measure, si: f64) -> String {
    format!("{} {}", number(found, units, measure, si), units.unit(measure)).trim_end().to_owned()
}

/// Formats a share in percent.
pub(crate) fn percent(share: f64) -> String {
    let text = format!("{:.1} %", 100.0 * share);
    match text.as_str() {
        _ if !share.is_finite() => "none".to_owned(),
        "-0.0 %" => "0.0 %".to_owned(),
        _ => text,
    }
}

/// Returns the greatest of some standard errors; `None` without any.
fn worst(errors: impl Iterator<Item = f64>) -> Option<f64> {
    errors.map(|error| if error.is_finite() { error } else { 0.0 }).reduce(f64::max)
}

/// Says how precise some parts of the variance are.
fn said(what: &str, worst: f64) -> Block {
    Block::item("- ", format!("{what} have standard errors of at most {}.", percent(worst)))
}

/// Returns the words of the ends of a guaranteed range, rounded outward, and of the values that are found near them.
pub(crate) fn range_ends(bounds: &Bounds, measure: Measure, units: Units) -> [[String; 2]; 2] {
    let width = Some(bounds.high - bounds.low).filter(|width| width.is_finite()).unwrap_or(0.0);
    let end = |si: f64, toward| match si.is_finite() {
        true => format!("{} {}", ended(measure, si, width, toward, units), units.unit(measure)).trim_end().to_owned(),
        false => "no limit that is proven".to_owned(),
    };
    let proven = [end(bounds.low, Toward::Below), end(bounds.high, Toward::Above)];
    [proven, [bounds.low_attained, bounds.high_attained].map(|si| end(si, Toward::Nearest))]
}

/// Formats a skewness.
pub(crate) fn skewness(value: f64) -> String {
    let text = format!("{value:.2}");
    match text.as_str() {
        _ if !value.is_finite() => "none".to_owned(),
        "-0.00" => "0.00".to_owned(),
        _ => text,
    }
}

/// An output with what is found of it.
struct Shown<'a> {
    all: &'a Uncertainty,
    of: CaseOutput,
    name: &'a str,
    found: &'a OutputUncertainty,
    units: Units,
}

impl Shown<'_> {
    fn blocks(&self) -> Vec<Block> {
        let mut blocks = vec![self.heading()];
        blocks.extend(self.methods());
        blocks.extend(self.range());
        blocks.extend(self.inputs());
        blocks.extend(self.curvature());
        blocks.extend(self.next_measurement());
        blocks
    }

    fn number(&self, si: f64) -> String {
        number(self.found, self.units, self.of.measure(), si)
    }

    fn quantity(&self, si: f64) -> String {
        quantity(self.found, self.units, self.of.measure(), si)
    }

    fn heading(&self) -> Block {
        let symbol = self.of.symbol().map(|symbol| format!(" ({symbol})")).unwrap_or_default();
        let value = if self.found.value.is_nan() { "none".to_owned() } else { self.quantity(self.found.value) };
        Block::Heading { level: 2, text: format!("{}{symbol} = {value}", self.name) }
    }

    fn methods(&self) -> Option<Block> {
        let [low, high] = ends(self.all.level);
        let mut rows = Vec::new();
        // Only samples have quantiles.
        let has_samples = self.found.monte_carlo.is_some();
        let none = || vec![String::new(); if has_samples { 3 } else { 0 }];
        if let Some(found) = &self.found.linear {
            rows.push([vec!["linear".to_owned(), self.number(found.mean), self.number(found.sd)], none()].concat());
        }
        if let Some(found) = &self.found.second_order {
            rows.push([vec!["second order".to_owned(), self.number(found.mean), self.number(found.sd)], none()].concat());
        }
        if let Some(found) = &self.found.monte_carlo {
            let quantile = |p: f64| found.quantiles.get(&p.to_string()).map_or_else(String::new, |value| self.number(*value));
            let of_samples = ["samples".to_owned(), self.number(found.mean), self.number(found.sd)];
            rows.push(of_samples.into_iter().chain([low, 0.5, high].map(quantile)).collect());
            let error = |p: f64| found.quantiles_se.get(&p.to_string()).map_or_else(String::new, |value| self.error(*value));
            let errors = ["standard error".to_owned(), self.error(found.mean_se), self.error(found.sd_se)];
            rows.push(errors.into_iter().chain([low, 0.5, high].map(error)).collect());
        }
        let percent = |p: f64| format!("{} %", trim(100.0 * p));
        let header = ["method".to_owned(), "mean".to_owned(), "sd".to_owned(), percent(low), "median".to_owned(), percent(high)];
        let (columns, align) = if has_samples { (6, "lrrrrr") } else { (3, "lrr") };
        (!rows.is_empty()).then(|| Table::new(header.into_iter().take(columns), align, rows).into())
    }

    /// Formats a standard error with two digits of its own.
    fn error(&self, si: f64) -> String {
        if si.is_finite() { with_digits(self.units, self.of.measure(), si, si) } else { "none".to_owned() }
    }

    fn range(&self) -> Vec<Block> {
        let Some(bounds) = &self.found.bounds else { return Vec::new() };
        let gap = (bounds.low_attained - bounds.low).max(bounds.high - bounds.high_attained);
        let accepted = if bounds.is_whole { "" } else { ", where physics accepts the collision," };
        let [[low, high], found] = range_ends(bounds, self.of.measure(), self.units);
        let text = format!("Within the limits of the inputs{accepted} it is from {low} to {high}, guaranteed");
        let tight = if bounds.is_tight {
            "both ends are attained".to_owned()
        } else {
            let found = format!("values from {} to {} are found", found[0], found[1]);
            let gap_with_unit = || format!("{} {}", self.error(gap), self.units.unit(self.of.measure()));
            if gap.is_finite() { format!("{found}, and nothing tighter than {} is proven", gap_with_unit().trim_end()) } else { found }
        };
        vec![Block::item("- ", format!("{text}; {tight}."))]
    }

    fn inputs(&self) -> Vec<Block> {
        let OutputUncertainty { linear, sobol, shapley, .. } = self.found;
        let share = |name: &str| linear.as_ref().and_then(|linear| linear.shares.get(name)).copied();
        let of_sobol = |name: &str| sobol.as_ref().and_then(|shares| shares.get(name));
        let effect = |name: &str| shapley.as_ref().and_then(|effects| effects.get(name)).map(|found| found.effect);
        let total = |name: &str| of_sobol(name).map(|found| found.total);
        let cell = |share: Option<f64>| share.map_or_else(String::new, percent);
        let halved = |name: &str| linear.as_ref().and_then(|linear| linear.sd_if_halved.get(name)).map(|sd| self.number(*sd));
        type Column<'a> = (&'static str, bool, &'a dyn Fn(&str) -> String);
        let columns: [Column<'_>; 5] = [
            ("linear", linear.is_some(), &|name| cell(share(name))),
            ("sd if halved", linear.is_some(), &|name| halved(name).unwrap_or_default()),
            ("alone", sobol.is_some(), &|name| cell(of_sobol(name).map(|found| found.first))),
            ("with others", sobol.is_some(), &|name| cell(total(name))),
            ("Shapley", shapley.is_some(), &|name| cell(effect(name))),
        ];
        let columns: Vec<Column<'_>> = columns.into_iter().filter(|(_, is_there, _)| *is_there).collect();
        if columns.is_empty() {
            return Vec::new();
        }
        let mut names: Vec<&str> = self.all.inputs.iter().map(|(name, _)| name).collect();
        let size = |name: &str| total(name).or(effect(name)).or(share(name)).filter(|size| !size.is_nan()).unwrap_or(0.0);
        names.sort_by(|one, other| size(other).abs().total_cmp(&size(one).abs()));
        let hidden = names.len().saturating_sub(SHOWN);
        names.truncate(SHOWN);
        let row = |name: &&str| iter::once((*name).to_owned()).chain(columns.iter().map(|(_, _, cell)| cell(name))).collect();
        let header = iter::once("share of the variance").chain(columns.iter().map(|(name, ..)| *name)).map(str::to_owned);
        let align = format!("l{}", "r".repeat(columns.len()));
        let mut blocks = vec![Table::new(header, &align, names.iter().map(row).collect()).narrow().into()];
        let errors = sobol.iter().flat_map(|shares| shares.iter()).flat_map(|(_, share)| [share.first_se, share.total_se]);
        blocks.extend(worst(errors).map(|worst| said("Shares alone and with others", worst)));
        let errors = shapley.iter().flat_map(|effects| effects.iter()).map(|(_, effect)| effect.se);
        blocks.extend(worst(errors).map(|worst| said("Shapley effects", worst)));
        if hidden > 0 {
            blocks.push(Block::item("", format!("{hidden} more inputs have smaller shares (--format json).")));
        }
        blocks
    }

    /// Says how far second order moves the answer.
    fn curvature(&self) -> Option<Block> {
        let (linear, second) = (self.found.linear.as_ref()?, self.found.second_order.as_ref()?);
        let (moved, wider) = (second.mean - linear.mean, second.sd / linear.sd - 1.0);
        if !moved.is_finite() || !wider.is_finite() {
            return None;
        }
        let text = format!(
            "Curvature moves the mean by {} ({} of the sd), and the sd by {}; skewness {}.",
            self.signed(moved),
            percent(moved / linear.sd),
            percent(wider),
            skewness(second.skewness),
        );
        Some(Block::item("- ", text))
    }

    fn signed(&self, si: f64) -> String {
        let unit = self.units.unit(self.of.measure());
        format!("{} {unit}", self.error(si)).trim_end().to_owned()
    }

    /// Says which measurement, made twice as precise, narrows the answer most.
    fn next_measurement(&self) -> Option<Block> {
        let linear = self.found.linear.as_ref()?;
        let halved = linear.sd_if_halved.iter().filter(|(_, sd)| sd.is_finite());
        let (name, sd) = halved.min_by(|one, other| one.1.total_cmp(other.1))?;
        let narrows = *sd < linear.sd && linear.sd.is_finite();
        if !narrows {
            return None;
        }
        let narrower = 100.0 * (1.0 - sd / linear.sd);
        Some(Block::item(
            "- ",
            format!("To narrow it most, measure {name} twice as precisely: the sd falls by {narrower:.0} %, to {}.", self.quantity(*sd)),
        ))
    }
}
