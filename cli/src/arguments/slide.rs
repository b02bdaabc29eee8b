//! Arguments of `slide`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::UnitSystem;

/// Arguments of `slide`.
#[derive(Debug, Args)]
pub struct Slide {
    /// The case file with [rest], TOML or JSON; - reads standard input.
    pub case: PathBuf,
    /// Format of the result.
    #[arg(long, value_enum, default_value_t = SlideFormat::Text)]
    pub format: SlideFormat,
    /// Units of text and CSV. Default: those of most values in the case file. JSON is always SI.
    #[arg(long, value_enum)]
    pub units: Option<UnitSystem>,
}

/// Format of a slide.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum SlideFormat {
    /// For people.
    Text,
    /// Comma-separated values, a state of the motion in each row.
    Csv,
    /// For programs, in SI.
    Json,
}
