//! The command line, parsed by clap.

mod batch;
mod check;
mod compare;
mod draw;
mod formula;
mod gradient;
mod help;
mod reconstruct;
mod record;
mod report;
mod slide;
mod stiffness;
mod sweep;
mod uncertainty;
mod validate;

use std::io::{self, Write};
use std::ops::RangeInclusive;
use std::path::PathBuf;

use clap::{Args, CommandFactory, FromArgMatches, Parser, Subcommand, ValueEnum};
use clap_complete::Shell;
use planar_impact_app::Units;
use planar_impact_app::quantity;

pub use batch::Batch;
pub use check::{Check, CheckFormat, FailOn};
pub use compare::{Compare, CompareFormat};
pub use draw::{Draw, DrawFormat};
pub use formula::{Formula, Notation};
pub use gradient::Gradient;
pub use reconstruct::Reconstruct;
pub use record::{Record, RecordFormat};
pub use report::{Report, ReportVerb};
pub use slide::{Slide, SlideFormat};
pub use stiffness::Stiffness;
pub use sweep::{Sweep, SweepFormat};
pub use uncertainty::{SamplePoints, Uncertainty, UncertaintyFormat, UncertaintyMethod};
pub use validate::Validate;

/// Planar impact mechanics and crush energy: velocities, impulse and energy of two vehicles in a collision.
#[derive(Debug, Parser)]
#[command(name = "planar-impact", version, after_help = help::STATUS, max_term_width = 100)]
pub struct Arguments {
    /// The verb.
    #[command(subcommand)]
    pub verb: Verb,
}

impl Arguments {
    /// Parses the call. A number below zero is a value that may be wrong, and not an unknown option.
    ///
    /// # Errors
    ///
    /// If the call is wrong, or asks for help or the version.
    pub fn of_call() -> Result<Arguments, clap::Error> {
        let matches = Arguments::command().mut_subcommands(|verb| verb.allow_negative_numbers(true)).try_get_matches()?;
        Arguments::from_arg_matches(&matches)
    }
}

/// The verb to run.
#[derive(Debug, Subcommand)]
pub enum Verb {
    /// Print a case file to begin with, with every optional key explained.
    #[command(after_help = "Examples:\n  planar-impact new\n  planar-impact new --kind head-on > case.toml")]
    New {
        /// The kind of collision.
        #[arg(long, default_value = "t-bone", value_parser = planar_impact_app::template::kinds())]
        kind: String,
    },
    /// Solve a collision: final velocities, impulse, delta-V, energy.
    #[command(after_help = help::CASE)]
    Solve(OfCase),
    /// Differentiate a collision: derivatives of outputs with respect to inputs.
    #[command(after_help = help::GRADIENT)]
    Gradient(Gradient),
    /// Vary one or two inputs of a collision: tables, data and charts.
    #[command(after_help = help::SWEEP)]
    Sweep(Sweep),
    /// Compare variants of a case: the inputs that differ, and the outputs, side by side.
    #[command(after_help = help::COMPARE)]
    Compare(Compare),
    /// Solve a table of collisions, a row each: CSV, Parquet or Arrow.
    #[command(after_help = help::BATCH)]
    Batch(Batch),
    /// Check collision results of any program against the laws of mechanics.
    #[command(after_help = help::CHECK)]
    Check(Check),
    /// Compute crush energy and equivalent speed from residual crush.
    #[command(after_help = help::CRUSH)]
    Crush(OfCase),
    /// Reconstruct delta-V from crush with CRASH3, compared with planar mechanics.
    #[command(after_help = help::CRASH3)]
    Crash3(OfCase),
    /// Reconstruct speeds and other unknowns from evidence, with their uncertainty.
    #[command(after_help = help::RECONSTRUCT)]
    Reconstruct(Reconstruct),
    /// Say how uncertain the outputs are, given uncertain inputs.
    #[command(after_help = help::UNCERTAINTY)]
    Uncertainty(Uncertainty),
    /// Follow the vehicles from separation to rest: path, headings, wheel tracks.
    #[command(after_help = help::SLIDE)]
    Slide(Slide),
    /// Draw the scene of a collision to scale.
    #[command(after_help = help::DRAW)]
    Draw(Draw),
    /// Write a report of a case as one HTML file.
    #[command(after_help = help::REPORT)]
    Report(Report),
    /// Analyse recorded forces, accelerations, films and event data recorders.
    #[command(after_help = help::RECORD)]
    Record(Record),
    /// Fit crush stiffness to barrier tests, with its uncertainty.
    #[command(after_help = help::STIFFNESS)]
    Stiffness(Stiffness),
    /// Compare every printed value of the paper's tables, and measured tests.
    #[command(after_help = help::VALIDATE)]
    Validate(Validate),
    /// Prove the identities of the mechanics, and demonstrate the paper's misprints.
    #[command(after_help = "Examples:\n  planar-impact prove\n  planar-impact prove --format json")]
    Prove(Prove),
    /// Print the formula that the code computes for an output, or for its derivative.
    #[command(after_help = help::FORMULA)]
    Formula(Formula),
    /// Print the JSON Schema of a file that a verb reads, or of its answer.
    #[command(after_help = "Examples:\n  planar-impact schema case\n  planar-impact schema solve")]
    Schema {
        /// `case`, `tests`, `recording`, or a verb.
        #[arg(value_parser = planar_impact_app::schema::names())]
        of: String,
    },
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

/// A system of units.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum UnitSystem {
    /// Feet, pounds, seconds; ΔV also in miles per hour.
    Us,
    /// Meters, kilograms, seconds; ΔV also in kilometers per hour.
    Si,
    /// As SI, but speeds in miles per hour.
    Uk,
}

impl From<UnitSystem> for Units {
    fn from(system: UnitSystem) -> Units {
        match system {
            UnitSystem::Us => Units::Us,
            UnitSystem::Si => Units::Si,
            UnitSystem::Uk => Units::Uk,
        }
    }
}

/// Arguments of a verb that reads a case and prints its answer.
#[derive(Debug, Args)]
pub struct OfCase {
    /// The case file, TOML or JSON; - reads standard input.
    pub case: PathBuf,
    /// Format of the result.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub format: Format,
    /// Units of the text. Default: those of most values in the case file. JSON is always SI.
    #[arg(long, value_enum)]
    pub units: Option<UnitSystem>,
}

/// Parses a level of confidence.
fn level(text: &str) -> Result<f64, String> {
    let value = quantity::finite(text.trim()).map_err(|error| error.to_string())?;
    let is_valid = (0.5..=0.9999).contains(&value);
    if is_valid { Ok(value) } else { Err(format!("{value}; it must be from 0.5 to 0.9999, such as 0.95")) }
}

/// Returns the parser of a whole number in a range.
fn whole<T: TryFrom<u64>>(range: RangeInclusive<u64>) -> impl Fn(&str) -> Result<T, String> + Clone {
    move |text| {
        let number = text.trim().parse().ok().filter(|number| range.contains(number)).and_then(|number: u64| number.try_into().ok());
        number.ok_or_else(|| format!("it must be a whole number from {} to {}", range.start(), range.end()))
    }
}

/// Arguments of `prove`.
#[derive(Debug, Args)]
pub struct Prove {
    /// Format of the result.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub format: Format,
}

/// Format of a result.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// For people.
    Text,
    /// For programs.
    Json,
}

/// Writes the manual: the page of the program, then the page of each verb.
///
/// # Errors
///
/// Fails if the writer fails.
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
    fn options_without_effect_are_refused() {
        let words = "planar-impact uncertainty case.toml --samples 9 --seed 2 --points sobol --precision 1% --level 0.9".split_whitespace();
        let Arguments { verb: Verb::Uncertainty(call), .. } = Arguments::try_parse_from(words.clone()).expect("a call") else {
            panic!("a call of uncertainty")
        };
        assert_eq!(call.given(), ["--samples", "--seed", "--points", "--precision", "--level"]);
        let Arguments { verb: Verb::Uncertainty(call), .. } = Arguments::try_parse_from(words.take(3)).expect("a call") else {
            panic!("a call of uncertainty")
        };
        assert!(call.given().is_empty());
        let reconstruct = |options: &[&str]| Arguments::try_parse_from([&["planar-impact", "reconstruct", "case.toml"], options].concat());
        let error = reconstruct(&["--bounds-sd", "7"]).expect_err("no guarantee is asked for");
        assert!(error.to_string().contains("--guaranteed"), "{error}");
        assert!(reconstruct(&["--bounds-sd", "7", "--guaranteed"]).is_ok() && reconstruct(&[]).is_ok());
        for (options, idle) in [(&["--brief", "--format", "json"][..], "--brief"), (&["--draws"], "--draws"), (&["--brief"], "")] {
            let Arguments { verb: Verb::Reconstruct(call), .. } = reconstruct(options).expect("a call") else { panic!("{options:?}") };
            assert_eq!(call.without_effect().map_or("", |message| message.split(' ').next().unwrap_or_default()), idle, "{options:?}");
        }
    }

    /// What is wrapped by hand is not wrapped again, and what is to be copied stays on its line.
    #[test]
    fn no_line_below_the_options_is_too_long() {
        for verb in Arguments::command().get_subcommands() {
            let below = verb.get_after_help().map(ToString::to_string).unwrap_or_default();
            assert!(below.lines().all(|line| line.chars().count() < 100), "{}: {below}", verb.get_name());
        }
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
