//! Arguments of `check`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use planar_impact_app::check::{Options, Severity};
use planar_impact_app::quantity;

/// Arguments of `check`.
#[derive(Debug, Args)]
pub struct Check {
    /// Files of records: a JSON document, JSON Lines or CSV; - reads standard input.
    #[arg(required_unless_present = "rules")]
    pub files: Vec<PathBuf>,
    /// Format of the findings.
    #[arg(long, value_enum, default_value_t = CheckFormat::Text)]
    pub format: CheckFormat,
    /// Tolerance of records without resolutions, as a share of what is exchanged, at most 0.5; printed numbers need `resolution`. Default: that of the record's profile.
    #[arg(long, value_name = "REL", value_parser = tolerance)]
    pub tolerance: Option<f64>,
    /// Lowest severity for which the exit status is 1.
    #[arg(long, value_enum, value_name = "SEVERITY", default_value_t = FailOn::Fail)]
    pub fail_on: FailOn,
    /// Print the rules and their meaning instead.
    #[arg(long, conflicts_with_all = ["files", "tolerance", "fail_on"])]
    pub rules: bool,
}

/// Format of the findings.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum CheckFormat {
    /// For people: records with findings, and a summary.
    Text,
    /// For programs.
    Json,
    /// JUnit XML, for GitLab, Jenkins and others.
    Junit,
    /// SARIF 2.1.0, for GitHub and others.
    Sarif,
}

/// Lowest severity that fails the run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum FailOn {
    /// Violated rules.
    Fail,
    /// Also rules that could not be evaluated, and records that give too little for any law.
    Undecidable,
    /// Also warnings.
    Warn,
}

impl FailOn {
    /// Returns `true` if a finding of this severity fails the run.
    pub fn includes(self, severity: Severity) -> bool {
        let least = match self {
            FailOn::Fail => Severity::Fail,
            FailOn::Undecidable => Severity::Undecidable,
            FailOn::Warn => Severity::Warn,
        };
        severity >= least
    }
}

/// Parses a tolerance that the checker accepts.
fn tolerance(text: &str) -> Result<f64, String> {
    let value = quantity::finite(text.trim()).map_err(|error| error.to_string())?;
    let is_valid = Options { tolerance: Some(value) }.validate();
    is_valid.map(|()| value).map_err(|issues| format!("{issues}; give a share such as 1e-6"))
}
