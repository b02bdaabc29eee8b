//! Arguments of `compare`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::UnitSystem;

/// Arguments of `compare`.
#[derive(Debug, Args)]
pub struct Compare {
    /// Case files, TOML or JSON; - reads standard input.
    #[arg(required = true, num_args = 2..=20, value_name = "CASE")]
    pub cases: Vec<PathBuf>,
    /// Format of the result.
    #[arg(long, value_enum, default_value_t = CompareFormat::Text)]
    pub format: CompareFormat,
    /// Units of text and SVG. Default: those of most values in the first case file. JSON is always SI.
    #[arg(long, value_enum)]
    pub units: Option<UnitSystem>,
}

/// Format of a comparison.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum CompareFormat {
    /// For people.
    Text,
    /// For programs, in SI.
    Json,
    /// A chart: each output of each case, with its interval if it is reconstructed.
    Svg,
}
