//! The command line, as clap sees it.

mod formula;
mod help;

use std::io::{self, Write};
use std::path::PathBuf;

use clap::{Args, CommandFactory, Parser, Subcommand, ValueEnum};
use clap_complete::Shell;
use planar_impact::check::Severity;

use crate::quantity;
use crate::units::Units;

pub use formula::{Formula, MomentImpulse, Notation, Ratio, TangentialLaw};

/// Planar impact mechanics and crush energy: how two vehicles leave a collision, and what it cost them.
#[derive(Debug, Parser)]
#[command(name = "planar-impact", version, after_help = help::STATUS, max_term_width = 100)]
pub struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub verb: Verb,
}

/// What to do.
#[derive(Debug, Subcommand)]
pub enum Verb {
    /// Solve a collision: final velocities, impulse, delta-V, energy.
    #[command(after_help = help::CASE)]
    Solve(OfCase),
    /// Differentiate a collision: how its outputs answer to its inputs.
    #[command(after_help = help::GRADIENT)]
    Gradient(Gradient),
    /// Vary one or two inputs of a collision: tables, data and charts.
    #[command(after_help = help::SWEEP)]
    Sweep(Sweep),
    /// Check collision results of any program against the laws of mechanics.
    #[command(after_help = help::CHECK)]
    Check(Check),
    /// Tell what residual crush stands for: energy and equivalent speed.
    #[command(after_help = help::CRUSH)]
    Crush(OfCase),
    /// Reconstruct delta-V from crush as CRASH3 does, beside planar mechanics.
    #[command(after_help = help::CRASH3)]
    Crash3(OfCase),
    /// Reconstruct speeds from what is left after the crash, and say how sure that is.
    #[command(after_help = help::RECONSTRUCT)]
    Reconstruct(Reconstruct),
    /// Fit crush stiffness to barrier tests, with its uncertainty.
    #[command(after_help = help::STIFFNESS)]
    Stiffness(Stiffness),
    /// Hold every printed cell of the paper's tables to account, then measured tests.
    #[command(after_help = help::VALIDATE)]
    Validate(Validate),
    /// Prove the identities of the mechanics, and show what is wrong in print.
    #[command(after_help = "Examples:\n  planar-impact prove\n  planar-impact prove --format json")]
    Prove(Prove),
    /// Print the formula that the code computes for an output, or for its derivative.
    #[command(after_help = help::FORMULA)]
    Formula(Formula),
    /// Print a completion script for a shell.
    #[command(after_help = "Example:\n  planar-impact completions bash > ~/.local/share/bash-completion/completions/planar-impact")]
    Completions {
        /// The shell.
        shell: Shell,
    },
    /// Print the manual page.
    #[command(after_help = "Example:\n  planar-impact man | man -l -")]
    Man,
}

/// The call of a verb that reads a case and prints what follows.
#[derive(Debug, Args)]
pub struct OfCase {
    /// The case file, TOML or JSON; - reads standard input.
    pub case: PathBuf,
    /// How to print the result.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub format: Format,
    /// Units of the text; those that most of the case file is in, unless given. JSON is always SI.
    #[arg(long, value_enum)]
    pub units: Option<Units>,
}

/// The call of `reconstruct`.
#[derive(Debug, Args)]
pub struct Reconstruct {
    /// The case file with [evidence] and [unknown], TOML or JSON; - reads standard input.
    pub case: PathBuf,
    /// How to print the result.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub format: Format,
    /// Units of the text; those that most of the case file is in, unless given. JSON is always SI.
    #[arg(long, value_enum)]
    pub units: Option<Units>,
    /// From how many starts to search: the first is the given one, the others are drawn within the bounds. Some more searches begin beside what these found.
    #[arg(long, value_name = "COUNT", default_value_t = 64, value_parser = clap::value_parser!(u64).range(1..=10_000))]
    pub starts: u64,
    /// The seed of those draws: the same seed gives the same answer.
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
}

/// The call of `stiffness`.
#[derive(Debug, Args)]
pub struct Stiffness {
    /// The file of barrier tests, TOML or JSON; - reads standard input.
    pub tests: PathBuf,
    /// How to print the result.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub format: Format,
    /// Units of the text; those that most of the file is in, unless given. JSON is always SI.
    #[arg(long, value_enum)]
    pub units: Option<Units>,
}

/// The call of `gradient`.
#[derive(Debug, Args)]
pub struct Gradient {
    /// The case file, TOML or JSON; - reads standard input.
    pub case: PathBuf,
    /// The outputs, by name or symbol; may be repeated. All of them in JSON and the principal ones in the text, unless given.
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub of: Vec<String>,
    /// The inputs, by name or symbol; may be repeated. All of them in JSON and the keys of the file in the text, unless given.
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub wrt: Vec<String>,
    /// Add the second derivatives.
    #[arg(long)]
    pub second: bool,
    /// How to print the result.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub format: Format,
    /// Units of the text; those that most of the case file is in, unless given. JSON is always SI.
    #[arg(long, value_enum)]
    pub units: Option<Units>,
}

/// The call of `sweep`.
#[derive(Debug, Args)]
pub struct Sweep {
    /// The case file, TOML or JSON; - reads standard input.
    pub case: PathBuf,
    /// An input by name or symbol, its first and its last value and the step. A second one makes a grid.
    #[arg(long, value_name = "NAME=FROM:TO:STEP", required = true)]
    pub vary: Vec<String>,
    /// The outputs, by name or symbol; may be repeated. W_n, W_t, T_L and mu0 unless given.
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub of: Vec<String>,
    /// How to print the result.
    #[arg(long, value_enum, default_value_t = SweepFormat::Text)]
    pub format: SweepFormat,
    /// Units of the outputs but in JSON, which is SI; those that most of the case file is in, unless given.
    #[arg(long, value_enum)]
    pub units: Option<Units>,
}

/// How to print a sweep.
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

/// The call of `check`.
#[derive(Debug, Args)]
pub struct Check {
    /// Files of records: a JSON document, JSON Lines or CSV; - reads standard input.
    #[arg(required_unless_present = "rules")]
    pub files: Vec<PathBuf>,
    /// How to print what was found.
    #[arg(long, value_enum, default_value_t = CheckFormat::Text)]
    pub format: CheckFormat,
    /// The tolerance of numbers without a resolution, as a share of what they would be off by if nothing were right; that of the record's profile, unless given.
    #[arg(long, value_name = "REL", value_parser = tolerance)]
    pub tolerance: Option<f64>,
    /// From which severity on the exit status is 1.
    #[arg(long, value_enum, value_name = "SEVERITY", default_value_t = FailOn::Fail)]
    pub fail_on: FailOn,
    /// Print the rules instead, with what each means.
    #[arg(long, conflicts_with = "files")]
    pub rules: bool,
}

/// How to print what was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum CheckFormat {
    /// For people: the records that do not simply pass, and a summary.
    Text,
    /// For programs.
    Json,
    /// JUnit XML, for GitLab, Jenkins and others.
    Junit,
    /// SARIF 2.1.0, for GitHub and others.
    Sarif,
}

/// From which severity on a finding fails the run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum FailOn {
    /// Broken rules alone.
    Fail,
    /// What cannot be decided too.
    Undecidable,
    /// Warnings too.
    Warn,
}

impl FailOn {
    /// Whether a severity is among them.
    pub fn includes(self, severity: Severity) -> bool {
        let least = match self {
            FailOn::Fail => Severity::Fail,
            FailOn::Undecidable => Severity::Undecidable,
            FailOn::Warn => Severity::Warn,
        };
        severity >= least
    }
}

/// A share between 0 and 1.
fn tolerance(text: &str) -> Result<f64, String> {
    let value = quantity::finite(text.trim()).map_err(|error| error.to_string())?;
    if value > 0.0 && value < 1.0 { Ok(value) } else { Err("expected a share between 0 and 1, such as 1e-6".to_owned()) }
}

/// The call of `validate`.
#[derive(Debug, Args)]
pub struct Validate {
    /// How to print the result.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub format: Format,
    /// Draw a figure of the paper as SVG instead, from the computed numbers.
    #[arg(long, value_enum, value_name = "NUMBER", conflicts_with = "format")]
    pub figure: Option<FigureNumber>,
}

/// A figure that can be drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum FigureNumber {
    /// Cumulative crush energy against crush.
    #[value(name = "6")]
    Six,
    /// E* against crush, with the linear model.
    #[value(name = "7")]
    Seven,
}

/// The call of `prove`.
#[derive(Debug, Args)]
pub struct Prove {
    /// How to print the result.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub format: Format,
}

/// How to print a result.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// For people.
    Text,
    /// For programs.
    Json,
}

/// Writes the manual: the page of the program, then that of each verb.
///
/// # Errors
///
/// When the writer fails.
pub fn manual(page: &mut dyn Write) -> io::Result<()> {
    let mut command = Arguments::command();
    command.build();
    clap_mangen::Man::new(command.clone()).render(page)?;
    for verb in command.get_subcommands().filter(|verb| verb.get_name() != "help") {
        clap_mangen::Man::new(verb.clone()).render(page)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_command_line_is_sound() {
        Arguments::command().debug_assert();
    }

    #[test]
    fn the_manual_has_every_verb() {
        let mut page = Vec::new();
        manual(&mut page).expect("a vector takes everything");
        let page = String::from_utf8(page).expect("clap writes UTF-8");
        for verb in Arguments::command().get_subcommands().map(|verb| verb.get_name().to_owned()) {
            assert!(page.contains(&format!("planar\\-impact\\-{verb}")), "{verb}");
        }
    }
}
