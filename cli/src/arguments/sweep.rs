//! Arguments of `sweep`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::UnitSystem;

/// Arguments of `sweep`.
#[derive(Debug, Args)]
pub struct Sweep {
    /// The case file, TOML or JSON; - reads standard input.
    pub case: PathBuf,
    /// An input by name or symbol, with its first and last value and the step. A second one makes a grid.
    #[arg(long, value_name = "NAME=FROM:TO:STEP", required = true)]
    pub vary: Vec<String>,
    /// Outputs, by name or symbol; may be repeated. Default: W_n, W_t, T_L and mu0.
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub of: Vec<String>,
    /// Format of the result.
    #[arg(long, value_enum, default_value_t = SweepFormat::Text)]
    pub format: SweepFormat,
    /// Units of outputs in text, CSV and SVG. Default: those of most values in the case file. JSON is always SI.
    #[arg(long, value_enum)]
    pub units: Option<UnitSystem>,
}

/// Format of a sweep.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum SweepFormat {
    /// A table.
    Text,
    /// Comma-separated values with names and units in the header.
    Csv,
    /// For programs, in SI.
    Json,
    /// A chart: lines over one input, contours over two.
    Svg,
}
