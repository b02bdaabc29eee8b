//! Arguments of `uncertainty`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use planar_impact_app::quantity;

use super::{UnitSystem, level, whole};

/// Arguments of `uncertainty`.
#[derive(Debug, Args)]
pub struct Uncertainty {
    /// The case file with uncertain inputs, TOML or JSON; - reads standard input.
    pub case: PathBuf,
    /// Outputs, by name or symbol; may be repeated. Default: the principal ones.
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub of: Vec<String>,
    /// Methods; may be repeated. Default: all that apply.
    #[arg(long, value_enum, value_name = "METHODS", value_delimiter = ',')]
    pub method: Vec<UncertaintyMethod>,
    /// Number of samples; with a precision, the greatest. Default: 100000.
    #[arg(long, value_name = "COUNT", value_parser = samples)]
    pub samples: Option<u64>,
    /// Draw until the standard error of every mean is this share of it, such as 0.1%; of the standard deviation if that is greater.
    #[arg(long, value_name = "SHARE", value_parser = share)]
    pub precision: Option<f64>,
    /// Seed of the samples. The same seed gives the same answer, for any number of threads. Default: 1.
    #[arg(long, value_parser = whole::<u64>(0..=u64::MAX))]
    pub seed: Option<u64>,
    /// Where the samples lie. Default: random.
    #[arg(long, value_enum)]
    pub points: Option<SamplePoints>,
    /// Print the probability of a statement, such as "dV1 > 18 mph"; may be repeated. An angle counts from -180 to 180 deg.
    #[arg(long, value_name = "NAME > VALUE")]
    pub probability: Vec<String>,
    /// Level of the middle range, from 0.5 to 0.9999. Default: 0.95.
    #[arg(long, value_parser = level)]
    pub level: Option<f64>,
    /// Standard deviations at which `bounds` ends an input without limits.
    #[arg(long, value_name = "COUNT", default_value_t = 3.0)]
    pub bounds_sd: f64,
    /// Format of the result.
    #[arg(long, value_enum, default_value_t = UncertaintyFormat::Text)]
    pub format: UncertaintyFormat,
    /// Units of text, CSV and SVG. Default: those of most values in the case file. JSON is always SI.
    #[arg(long, value_enum)]
    pub units: Option<UnitSystem>,
}

impl Uncertainty {
    /// Returns the options that are given and matter to some methods alone.
    pub fn given(&self) -> Vec<&'static str> {
        let all = [
            (self.samples.is_some(), "--samples"),
            (self.seed.is_some(), "--seed"),
            (self.points.is_some(), "--points"),
            (self.precision.is_some(), "--precision"),
            (self.level.is_some(), "--level"),
        ];
        all.into_iter().filter_map(|(is_given, option)| is_given.then_some(option)).collect()
    }

    /// Returns the error of an option that has no effect with the format of the call.
    pub fn without_effect(&self) -> Option<&'static str> {
        let is_idle = self.format == UncertaintyFormat::Svg && !self.probability.is_empty();
        is_idle.then_some("--probability has no effect: the chart has no probabilities; give --format text, json or csv, or leave it out")
    }
}

/// A way to say how uncertain an output is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum UncertaintyMethod {
    /// First derivatives.
    Linear,
    /// First and second derivatives.
    SecondOrder,
    /// Samples.
    MonteCarlo,
    /// The share of each input in the variance, from samples.
    Sobol,
    /// The part of each input in the variance, correlated or not, from samples.
    Shapley,
    /// A guaranteed range within the limits of the inputs.
    Bounds,
}

/// Where samples lie.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum SamplePoints {
    /// Independent of each other.
    Random,
    /// Scrambled points of Sobol', more even than chance.
    Sobol,
}

/// Format of an uncertainty.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum UncertaintyFormat {
    /// For people.
    Text,
    /// For programs, in SI.
    Json,
    /// Comma-separated values, a figure in each row.
    Csv,
    /// A chart: densities with quantiles, and shares.
    Svg,
}

/// Parses a share, such as 0.001 or 0.1%.
fn share(text: &str) -> Result<f64, String> {
    let (number, unit) = match text.trim().strip_suffix('%') {
        Some(number) => (number, 0.01),
        None => (text, 1.0),
    };
    let value = unit * quantity::finite(number.trim()).map_err(|error| error.to_string())?;
    if value > 0.0 && value < 1.0 { Ok(value) } else { Err(format!("{text}; it must be above 0 and below 1, such as 0.1%")) }
}

/// Parses a number of samples, such as 100000 or 1e6.
fn samples(text: &str) -> Result<u64, String> {
    const MOST: f64 = 1e15;
    let value = quantity::finite(text.trim()).map_err(|error| error.to_string())?;
    let is_valid = value.fract() == 0.0 && (2.0..=MOST).contains(&value);
    if is_valid { Ok(value as u64) } else { Err(format!("{text}; it must be a whole number from 2 to 1e15, such as 1e6")) }
}
