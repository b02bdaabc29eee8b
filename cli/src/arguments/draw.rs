//! Arguments of `draw`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::UnitSystem;

/// The call of `draw`.
#[derive(Debug, Args)]
pub struct Draw {
    /// The case file, TOML or JSON; - reads standard input.
    pub case: PathBuf,
    /// The file to write, which appears when it is whole. Default: standard output.
    #[arg(long, short, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Format of the drawing.
    #[arg(long, value_enum, default_value_t = DrawFormat::Svg)]
    pub format: DrawFormat,
    /// Units of the drawing. Default: those of most values in the case file. JSON is always SI.
    #[arg(long, value_enum)]
    pub units: Option<UnitSystem>,
}

/// Format of a drawing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum DrawFormat {
    /// The drawing.
    Svg,
    /// The places, outlines and vectors that it shows.
    Json,
}
