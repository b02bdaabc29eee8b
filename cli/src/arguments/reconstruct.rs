//! Arguments of `reconstruct`.

use std::path::PathBuf;

use clap::Args;

use super::{Format, UnitSystem, level, whole};

/// Arguments of `reconstruct`.
#[derive(Debug, Args)]
pub struct Reconstruct {
    /// The case file with [evidence] and [unknown], TOML or JSON; - reads standard input.
    pub case: PathBuf,
    /// Format of the result.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub format: Format,
    /// Units of the text. Default: those of most values in the case file. JSON is always SI.
    #[arg(long, value_enum)]
    pub units: Option<UnitSystem>,
    /// Number of starts of the search: the given one, and others drawn within the bounds. A few more searches start close to each solution.
    #[arg(long, value_name = "COUNT", default_value_t = 64, value_parser = whole::<u64>(1..=10_000))]
    pub starts: u64,
    /// Seed of the random starts and of the draws. The same seed gives the same answer.
    #[arg(long, default_value_t = 1, value_parser = whole::<u64>(0..=u64::MAX))]
    pub seed: u64,
    /// Level of confidence of the intervals, from 0.5 to 0.9999.
    #[arg(long, default_value_t = 0.95, value_parser = level)]
    pub level: f64,
    /// Add the profile of the likelihood: how far chi-square rises as each quantity leaves its best value.
    #[arg(long)]
    pub profile: bool,
    /// Add the guaranteed range of each unknown: outside of it nothing meets the evidence. Exact evidence is met exactly, and readings within half of their step.
    #[arg(long)]
    pub guaranteed: bool,
    /// Standard deviations at which `--guaranteed` ends other evidence, and inputs without limits.
    #[arg(long, value_name = "COUNT", default_value_t = 3.0, requires = "guaranteed")]
    pub bounds_sd: f64,
    /// Draw from the posterior: the priors times the likelihood of the evidence.
    #[arg(long)]
    pub posterior: bool,
    /// Print the probability of a statement under the posterior, such as "vehicle.1.speed > 50 km/h"; may be repeated. A direction of force counts from -180 to
    /// 180 deg.
    #[arg(long, value_name = "NAME > VALUE")]
    pub probability: Vec<String>,
    /// Add the values of each draw to the JSON.
    #[arg(long)]
    pub draws: bool,
    /// Print the verdict, the unknowns and what follows from them alone.
    #[arg(long)]
    pub brief: bool,
}

impl Reconstruct {
    /// Returns the error of an option that has no effect with the format of the call.
    pub fn without_effect(&self) -> Option<&'static str> {
        if self.draws && self.format == Format::Text {
            return Some("--draws has no effect: they are added to the JSON; give --format json, or leave it out");
        }
        let is_idle = self.brief && self.format == Format::Json;
        is_idle.then_some("--brief has no effect: it shortens the text alone; leave it out")
    }
}
