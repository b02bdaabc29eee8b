//! Arguments of `record`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::UnitSystem;

/// Arguments of `record`.
#[derive(Debug, Args)]
pub struct Record {
    /// Recordings: CSV, or TOML or JSON that names one; - reads standard input.
    #[arg(required = true)]
    pub files: Vec<PathBuf>,
    /// Format of the result.
    #[arg(long, value_enum, default_value_t = RecordFormat::Text)]
    pub format: RecordFormat,
    /// Units of text and SVG. Default: those of most values in the first file. JSON is always SI.
    #[arg(long, value_enum)]
    pub units: Option<UnitSystem>,
}

/// Format of an analysed recording.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum RecordFormat {
    /// For people.
    Text,
    /// For programs, in SI.
    Json,
    /// A chart of the traces.
    Svg,
}
