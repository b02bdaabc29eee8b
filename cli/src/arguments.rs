//! The command line, parsed by clap.

mod formula;
mod help;

use std::io::{self, Write};
use std::path::PathBuf;

use clap::{Args, CommandFactory, FromArgMatches, Parser, Subcommand, ValueEnum};
use clap_complete::Shell;
use planar_impact_app::Units;
use planar_impact_app::check::{Options, Severity};
use planar_impact_app::quantity;
use planar_impact_report::document::Part;

pub use formula::{Formula, Notation};

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

/// Arguments of `compare`.
#[derive(Debug, Args)]
pub struct Compare {
    /// Case files, TOML or JSON; - reads standard input.
    #[arg(required = true, num_args = 2..=20, value_name = "CASE")]
    pub cases: Vec<PathBuf>,
    /// Format of the result.
    #[arg(long, value_enum, default_value_t = CompareFormat::Text)]
    pub format: CompareFormat,
    /// Units of text and SVG. Default: those of most values in the first case file. JSON is always SI.
    #[arg(long, value_enum)]
    pub units: Option<UnitSystem>,
}

/// Format of a comparison.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum CompareFormat {
    /// For people.
    Text,
    /// For programs, in SI.
    Json,
    /// A chart: each output of each case, with its interval if it is reconstructed.
    Svg,
}

/// Arguments of `reconstruct`.
#[derive(Debug, Args)]
pub struct Reconstruct {
    /// The case file with [evidence] and [unknown], TOML or JSON; - reads standard input.
    pub case: PathBuf,
    /// Format of the result.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub format: Format,
    /// Units of the text. Default: those of most values in the case file. JSON is always SI.
    #[arg(long, value_enum)]
    pub units: Option<UnitSystem>,
    /// Number of starts of the search: the given one, and others drawn within the bounds. A few more searches start close to each solution.
    #[arg(long, value_name = "COUNT", default_value_t = 64, value_parser = clap::value_parser!(u64).range(1..=10_000))]
    pub starts: u64,
    /// Seed of the random starts and of the draws. The same seed gives the same answer.
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    /// Level of confidence of the intervals, between 0 and 1.
    #[arg(long, default_value_t = 0.95, value_parser = level)]
    pub level: f64,
    /// Add the profile of the likelihood: how far chi-square rises as each quantity leaves its best value.
    #[arg(long)]
    pub profile: bool,
    /// Add the guaranteed range of each unknown: outside of it nothing meets the evidence. Exact evidence is met exactly, and readings within half of their step.
    #[arg(long)]
    pub guaranteed: bool,
    /// Standard deviations at which `--guaranteed` ends other evidence, and inputs without limits.
    #[arg(long, value_name = "COUNT", default_value_t = 3.0, requires = "guaranteed")]
    pub bounds_sd: f64,
    /// Draw from the posterior: the priors times the likelihood of the evidence.
    #[arg(long)]
    pub posterior: bool,
    /// Print the probability of a statement under the posterior, such as "vehicle.1.speed > 50 km/h"; may be repeated.
    #[arg(long, value_name = "NAME > VALUE")]
    pub probability: Vec<String>,
    /// Add the values of each draw to the JSON.
    #[arg(long)]
    pub draws: bool,
    /// Print the verdict, the unknowns and what follows from them alone.
    #[arg(long)]
    pub brief: bool,
}

/// Arguments of `uncertainty`.
#[derive(Debug, Args)]
pub struct Uncertainty {
    /// The case file with uncertain inputs, TOML or JSON; - reads standard input.
    pub case: PathBuf,
    /// Outputs, by name or symbol; may be repeated. Default: the principal ones.
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub of: Vec<String>,
    /// Methods; may be repeated. Default: all that apply.
    #[arg(long, value_enum, value_name = "METHODS", value_delimiter = ',')]
    pub method: Vec<UncertaintyMethod>,
    /// Number of samples; with a precision, the greatest. Default: 100000.
    #[arg(long, value_name = "COUNT", value_parser = samples)]
    pub samples: Option<u64>,
    /// Draw until the standard error of every mean is this share of it, such as 0.1%; of the standard deviation if that is greater.
    #[arg(long, value_name = "SHARE", value_parser = share)]
    pub precision: Option<f64>,
    /// Seed of the samples. The same seed gives the same answer, for any number of threads. Default: 1.
    #[arg(long)]
    pub seed: Option<u64>,
    /// Where the samples lie. Default: random.
    #[arg(long, value_enum)]
    pub points: Option<SamplePoints>,
    /// Print the probability of a statement, such as "dV1 > 18 mph"; may be repeated.
    #[arg(long, value_name = "NAME > VALUE")]
    pub probability: Vec<String>,
    /// Level of the middle range, between 0 and 1.
    #[arg(long, default_value_t = 0.95, value_parser = level)]
    pub level: f64,
    /// Standard deviations at which `bounds` ends an input without limits.
    #[arg(long, value_name = "COUNT", default_value_t = 3.0)]
    pub bounds_sd: f64,
    /// Format of the result.
    #[arg(long, value_enum, default_value_t = UncertaintyFormat::Text)]
    pub format: UncertaintyFormat,
    /// Units of text, CSV and SVG. Default: those of most values in the case file. JSON is always SI.
    #[arg(long, value_enum)]
    pub units: Option<UnitSystem>,
}

impl Uncertainty {
    /// Returns the error of an option that has no effect with the methods of the call; a probability is sampled with any method.
    pub fn without_effect(&self) -> Option<String> {
        use UncertaintyMethod::{MonteCarlo, Shapley, Sobol};
        if self.method.is_empty() || !self.probability.is_empty() || self.method.contains(&MonteCarlo) {
            return None;
        }
        let draws = self.method.iter().any(|method| [Sobol, Shapley].contains(method));
        // Shares in the variance have a plan of their own.
        let of_outputs = [(self.points.is_some(), "--points"), (self.precision.is_some(), "--precision")];
        let of_any = [(self.samples.is_some() && !draws, "--samples"), (self.seed.is_some() && !draws, "--seed")];
        let idle = of_any.into_iter().chain(of_outputs).find_map(|(is_idle, option)| is_idle.then_some(option))?;
        let (what, remedy) = match idle {
            "--samples" | "--seed" => ("no method of the call draws samples", "monte-carlo, sobol or shapley"),
            _ => ("it is for samples of the outputs, which no method of the call draws", "monte-carlo"),
        };
        Some(format!("{idle} has no effect: {what}; add {remedy} to --method, or leave {idle} out"))
    }
}

/// A way to say how uncertain an output is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum UncertaintyMethod {
    /// First derivatives.
    Linear,
    /// First and second derivatives.
    SecondOrder,
    /// Samples.
    MonteCarlo,
    /// The share of each input in the variance, from samples.
    Sobol,
    /// The part of each input in the variance, correlated or not, from samples.
    Shapley,
    /// A guaranteed range within the limits of the inputs.
    Bounds,
}

/// Where samples lie.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum SamplePoints {
    /// Independent of each other.
    Random,
    /// Scrambled points of Sobol', more even than chance.
    Sobol,
}

/// Format of an uncertainty.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum UncertaintyFormat {
    /// For people.
    Text,
    /// For programs, in SI.
    Json,
    /// Comma-separated values, a figure in each row.
    Csv,
    /// A chart: densities with quantiles, and shares.
    Svg,
}

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

/// Format of a drawing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum DrawFormat {
    /// The drawing.
    Svg,
    /// The places, outlines and vectors that it shows.
    Json,
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

/// Arguments of `batch`.
#[derive(Debug, Args)]
pub struct Batch {
    /// Tables of the same columns: .csv, .parquet or .arrow; - reads CSV from standard input.
    #[arg(required = true)]
    pub files: Vec<PathBuf>,
    /// The table to write: .csv, .parquet or .arrow; - writes CSV to standard output.
    #[arg(long, short, value_name = "OUT")]
    pub output: PathBuf,
    /// A case file that supplies what no column has, TOML or JSON.
    #[arg(long, value_name = "CASE")]
    pub case: Option<PathBuf>,
    /// Outputs, by name or symbol; may be repeated. Default: all of `solve`.
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub of: Vec<String>,
    /// Inputs to differentiate with respect to, by name or symbol; may be repeated.
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub wrt: Vec<String>,
    /// Check each solved row with the laws of mechanics, and add a column with the rules that it violates.
    #[arg(long)]
    pub check: bool,
    /// Number of threads that solve rows. Default: one for each processor. The bits of the answer do not depend on it.
    #[arg(long, value_name = "COUNT", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// Fuse multiplications and additions where the machine can, which is faster: the last bits then differ between machines.
    #[arg(long)]
    pub fast: bool,
    /// Stop at the first row that is refused, and write no file.
    #[arg(long)]
    pub fail_fast: bool,
}

/// Arguments of `check`.
#[derive(Debug, Args)]
pub struct Check {
    /// Files of records: a JSON document, JSON Lines or CSV; - reads standard input.
    #[arg(required_unless_present = "rules")]
    pub files: Vec<PathBuf>,
    /// Format of the findings.
    #[arg(long, value_enum, default_value_t = CheckFormat::Text)]
    pub format: CheckFormat,
    /// Relative tolerance of numbers without a resolution, at most 0.5. Default: that of the record's profile.
    #[arg(long, value_name = "REL", value_parser = tolerance)]
    pub tolerance: Option<f64>,
    /// Lowest severity for which the exit status is 1.
    #[arg(long, value_enum, value_name = "SEVERITY", default_value_t = FailOn::Fail)]
    pub fail_on: FailOn,
    /// Print the rules and their meaning instead.
    #[arg(long, conflicts_with = "files")]
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
    /// Also rules that could not be evaluated.
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

/// Parses a share, such as 0.001 or 0.1%.
fn share(text: &str) -> Result<f64, String> {
    let (number, unit) = match text.trim().strip_suffix('%') {
        Some(number) => (number, 0.01),
        None => (text, 1.0),
    };
    let value = unit * quantity::finite(number.trim()).map_err(|error| error.to_string())?;
    if value > 0.0 && value < 1.0 { Ok(value) } else { Err(format!("{text}; it must be above 0 and below 1, such as 0.1%")) }
}

/// Parses a number of samples, such as 100000 or 1e6.
fn samples(text: &str) -> Result<u64, String> {
    const MOST: f64 = 1e15;
    let value = quantity::finite(text.trim()).map_err(|error| error.to_string())?;
    let is_valid = value.fract() == 0.0 && (2.0..=MOST).contains(&value);
    if is_valid { Ok(value as u64) } else { Err(format!("{text}; it must be a whole number from 2 to 1e15, such as 1e6")) }
}

/// Parses a level of confidence.
fn level(text: &str) -> Result<f64, String> {
    let value = quantity::finite(text.trim()).map_err(|error| error.to_string())?;
    let is_valid = (0.5..=0.9999).contains(&value);
    if is_valid { Ok(value) } else { Err(format!("{value}; it must be from 0.5 to 0.9999, such as 0.95")) }
}

/// Arguments of `validate`.
#[derive(Debug, Args)]
pub struct Validate {
    /// Format of the result.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub format: Format,
    /// Draw a figure of the paper as SVG instead, from computed numbers.
    #[arg(long, value_enum, value_name = "NUMBER", conflicts_with = "format")]
    pub figure: Option<FigureNumber>,
}

impl FigureNumber {
    /// Returns the number.
    pub fn number(self) -> u32 {
        match self {
            FigureNumber::Six => 6,
            FigureNumber::Seven => 7,
        }
    }
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
        let uncertainty = |options: &str| {
            let words = ["planar-impact", "uncertainty", "case.toml"].into_iter().chain(options.split_whitespace());
            let Arguments { verb: Verb::Uncertainty(call), .. } = Arguments::try_parse_from(words).expect("a call") else {
                panic!("{options}")
            };
            call.without_effect()
        };
        for (options, idle) in [
            ("--method linear --samples 1000", Some("--samples")),
            ("--method linear,bounds --seed 2", Some("--seed")),
            ("--method second-order --points sobol", Some("--points")),
            ("--method sobol --precision 1%", Some("--precision")),
            ("--method shapley --points sobol", Some("--points")),
            ("--method sobol --samples 1000 --seed 2", None),
            ("--method linear --method monte-carlo --points sobol", None),
            ("--samples 1000 --points sobol", None),
            ("--method linear", None),
        ] {
            let found = uncertainty(options);
            assert_eq!(found.as_deref().and_then(|message| message.split(' ').next()), idle, "{options}");
        }
        let reconstruct = |options: &[&str]| Arguments::try_parse_from([&["planar-impact", "reconstruct", "case.toml"], options].concat());
        let error = reconstruct(&["--bounds-sd", "7"]).expect_err("no guarantee is asked for");
        assert!(error.to_string().contains("--guaranteed"), "{error}");
        assert!(reconstruct(&["--bounds-sd", "7", "--guaranteed"]).is_ok() && reconstruct(&[]).is_ok());
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
