//! Arguments of `report`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use planar_impact_report::document::Part;

use super::UnitSystem;

/// The call of `report`.
#[derive(Debug, Args)]
pub struct Report {
    /// The case file, TOML or JSON; the file of tests for --verb stiffness, files of records for --verb check; - reads standard input.
    pub files: Vec<PathBuf>,
    /// The file to write, which appears when it is whole. Default: standard output.
    #[arg(long, short, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// What the report answers. Default: `reconstruct` where the case has unknowns, else `solve`.
    #[arg(long, value_enum)]
    pub verb: Option<ReportVerb>,
    /// Sections, by name; may be repeated. Default: all that apply.
    #[arg(long, value_name = "NAMES", value_delimiter = ',', value_parser = Part::ALL.map(Part::name))]
    pub sections: Vec<String>,
    /// Draw the posterior of a reconstruction too, where that is what the report answers. Its last bits, and so the bytes of the report, depend on the platform.
    #[arg(long)]
    pub posterior: bool,
    /// A date, in any words. Without it the report has none: the same input gives the same bytes.
    #[arg(long, value_name = "TEXT")]
    pub date: Option<String>,
    /// Units of the report. Default: those of most values in the case file.
    #[arg(long, value_enum)]
    pub units: Option<UnitSystem>,
}

/// What a report answers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ReportVerb {
    /// How the vehicles leave the collision.
    Solve,
    /// What the evidence says of the unknowns.
    Reconstruct,
    /// The crush energy.
    Crush,
    /// ΔV by CRASH3.
    Crash3,
    /// How uncertain the outputs are.
    Uncertainty,
    /// The crush stiffness of barrier tests.
    Stiffness,
    /// The laws that records of collisions break.
    Check,
    /// How the program compares with the paper's tables and with measured tests; no file.
    Validate,
}
