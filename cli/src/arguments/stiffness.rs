//! Arguments of `stiffness`.

use std::path::PathBuf;

use clap::Args;

use super::{Format, UnitSystem};

/// Arguments of `stiffness`.
#[derive(Debug, Args)]
pub struct Stiffness {
    /// The file of barrier tests, TOML or JSON; - reads standard input.
    pub tests: PathBuf,
    /// Format of the result.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub format: Format,
    /// Units of the text. Default: those of most values in the file. JSON is always SI.
    #[arg(long, value_enum)]
    pub units: Option<UnitSystem>,
}
