//! Arguments of `gradient`.

use std::path::PathBuf;

use clap::Args;

use super::{Format, UnitSystem};

/// Arguments of `gradient`.
#[derive(Debug, Args)]
pub struct Gradient {
    /// The case file, TOML or JSON; - reads standard input.
    pub case: PathBuf,
    /// Outputs, by name or symbol; may be repeated. Default: all in JSON, the principal ones in text.
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub of: Vec<String>,
    /// Inputs, by name or symbol; may be repeated. Default: all in JSON, the keys of the file in text.
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub wrt: Vec<String>,
    /// Add the second derivatives.
    #[arg(long)]
    pub second: bool,
    /// Format of the result.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub format: Format,
    /// Units of the text. Default: those of most values in the case file. JSON is always SI.
    #[arg(long, value_enum)]
    pub units: Option<UnitSystem>,
}
