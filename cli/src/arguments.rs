//! The command line, as clap sees it.

use std::io::{self, Write};
use std::path::PathBuf;

use clap::{Args, CommandFactory, Parser, Subcommand, ValueEnum};
use clap_complete::Shell;
use planar_impact::{Input, Output};

use planar_impact::check::Severity;

use crate::formula;
use crate::quantity;
use crate::units::Units;

const STATUS: &str = "\
Exit status:
   0  done
   1  done, and a check did not hold
   2  the input or the call is wrong, or a file cannot be read
   3  the physics refuses the input
  70  a defect of the program
  74  the output cannot be written
 130  interrupted";

const CASE: &str = r#"A case file, TOML or JSON:
  schema = 1
  [[vehicle]]                        # exactly two
  name = "sedan"
  mass = "1163 kg"
  yaw_inertia = "1945 kg m^2"        # or radius_of_gyration = "1.3 m"
  heading = "180 deg"                # from x, counter-clockwise
  speed = "12 m/s"                   # or velocity = ["-12 m/s", "0 m/s"]
  yaw_rate = "0 deg/s"               # may be left out
  impact_center = ["1.9 m", "0 m"]   # from the center of mass: forward, left
  [[vehicle]]
  name = "wall"
  barrier = true                     # a fixed barrier has nothing else
  [contact]
  crush_plane = "0 deg"              # from x to the normal
  restitution = 0.15
  impulse_ratio = "critical"         # or 0.4, or { of_critical = 0.9 }
  # friction = 0.45                  # instead of impulse_ratio
  tangential_law = "brach"           # or "kudlich-slibar"
Quantities are strings with a unit, or bare numbers in SI.

Examples:
  planar-impact solve cli/examples/position-a.toml
  planar-impact solve cli/examples/sideswipe.toml --units us --format json"#;

const SWEEP: &str = "\
The last value is among the points when it is a whole number of steps away. Values are written as in
a case file; the table and the chart show them in the unit of the first one. A ratio that the case
leaves critical is given when it is varied: contact.impulse_ratio, contact.friction or
contact.impulse_ratio.of_critical; so is a moment. A point that the physics refuses is left empty,
with the reason. Names are those of `planar-impact gradient --help`.

The paper's Table 2 and its Figure 4:
  planar-impact sweep cli/examples/position-a.toml --vary \"contact.crush_plane=-10deg:10deg:1deg\"
  planar-impact sweep cli/examples/position-a.toml --vary Gamma=-10deg:10deg:1deg --format svg

More examples:
  planar-impact sweep cli/examples/position-a.toml --vary mu=0:0.6:0.1 --of W_t,dV1 --format csv
  planar-impact sweep case.toml --vary e=0:0.3:0.02 --vary \"v1=30 mph:40 mph:1 mph\" --format svg";

const GRADIENT: &str = "\
Names are those of the case file and of the JSON of `solve`, vehicles counted from 1, or symbols:
  inputs    vehicle.1.mass (m1), .yaw_inertia (I1), .radius_of_gyration (k1), .heading (theta1),
            .speed (v1), .velocity.x, .velocity.y, .yaw_rate (omega1), .impact_center.forward,
            .impact_center.left, .crush.width, .crush.depths.3, .crush.d0, .crush.d1;
            contact.crush_plane (Gamma), .restitution (e), .impulse_ratio (mu), .friction,
            .impulse_ratio.of_critical, .moment, .moment.of_critical
  outputs   energy.normal_work (W_n), .tangential_work (W_t), .loss (T_L), .before, .after;
            contact.critical_impulse_ratio (mu0), .impulse_ratio (mu), .impulse.normal (P_n), ...;
            vehicle.1.delta_v_magnitude (dV1), .velocity.x, .yaw_rate (Omega1), .pdof, .crush_energy, ...;
            vehicle.1.crash3.delta_v_magnitude, .corrected_energy, .effective_mass_factor, ...
  all       every one
A derivative by one input holds the other keys of the file as they are given. At the critical
impulse ratio it is that of the critical solution, so the ratio moves with the inputs.

Examples:
  planar-impact gradient cli/examples/position-a.toml
  planar-impact gradient cli/examples/oblique-surfaces.toml --of dV1,dV2 --wrt Gamma,e
  planar-impact gradient cli/examples/position-a.toml --of W_n --second --format json";

const VALIDATE: &str = "Examples:
  planar-impact validate
  planar-impact validate --format json
  planar-impact validate --figure 6 > figure-6.svg
  planar-impact validate --figure 7 > figure-7.svg";

const CHECK: &str = r#"A file of records, in any of three forms:
  a JSON document   { "schema": "planar-impact-record/1", "units": { ... }, "records": [ ... ] }
  JSON Lines        the same without `records` on the first line, then a record on each line
  CSV               column names such as b1.after.vx, a line of units, then a record on each line
{
  "schema": "planar-impact-record/1",
  "units": { "length": "m", "mass": "kg", "time": "s", "angle": "deg" },
  "records": [ {
    "id": "case-1", "profile": "impulse",
    "bodies": [
      { "mass": 1163, "yaw_inertia": 1945, "cg": [0, 0],
        "before": { "v": [-17.88, 2], "yaw_rate": 0 },
        "after": { "v": [1.678, -0.709], "yaw_rate": -20.95 } },
      { "fixed": true } ],
    "contact": { "point": [-1.94, 0.3], "normal_angle": 0 },
    "model": { "restitution": 0.1, "impulse_ratio": -0.1385, "ratio_kind": "critical" },
    "reported": { "energy_loss": 186168, "work_normal": -183017, "delta_v": [19.745, null] },
    "resolution": { "v": 0.0005, "yaw_rate": 0.005, "energy": 0.5, "impulse_ratio": 0.00005 } } ]
}
What is not known is left out, and rules that need it are not checked. Everything is said in the
documentation: planar_impact::guide::checking.

Examples:
  planar-impact check cli/examples/check/collision.json
  planar-impact check cli/examples/check/engine.jsonl cli/examples/check/template.csv --format json
  planar-impact check --rules"#;

const CRUSH: &str = r#"Under a [[vehicle]] of the case file:
  [vehicle.crush]
  width = "1.6 m"                    # or stations = ["0 m", "0.4 m", "1.6 m"]
  depths = ["0.1 m", "0.3 m", "0 m"] # two or more; equally spaced over a width
  stiffness = { d0 = "90 N^0.5", d1 = "1000 N^0.5/m" }
  #         = { A = "90 kN/m", B = "1 MPa" }
  #         = { b0 = "2 m/s", b1 = "30 1/s", test_mass = "1500 kg", test_width = "1.6 m" }
  #         = { ..., saturation = "0.5 m" }: the force grows no more beyond that depth
  #         = [ { to = "0.4 m", d0 = ..., d1 = ... }, { d0 = ..., d1 = ... } ]: zones
  measured = { offset = "0.2 m", angle = "10 deg" }   # read off from a line outside the surface
  surface = "front"                  # for crash3: right, rear, left; else from the crush plane
  pdof = "-10 deg"                   # for crash3: else that of the common-velocity impulse
The depth is taken straight between two stations. `gradient` and `sweep` know these numbers by
names such as vehicle.1.crush.depths.2 and vehicle.1.crush.zones.1.d0.

Examples:
  planar-impact crush cli/examples/cavalier-crush.toml
  planar-impact crush cli/examples/stiff-corner.toml --units si --format json"#;

const STIFFNESS: &str = r#"A file of barrier tests, TOML or JSON:
  schema = 1
  [[vehicle]]
  name = "sedan"
  [[vehicle.test]]                   # one or more, in order: their energies add up
  mass = "1500 kg"
  speed = "15.6 m/s"                 # normal to the barrier
  restitution = 0.1                  # the crush keeps 1 - e^2 of the energy
  width = "1.5 m"                    # or stations
  depths = ["0.3 m", "0.5 m"]        # all the crush that is there after the test
  speed_sd = "0.1 m/s"               # standard deviations, each may be left out
  restitution_sd = 0.03
  scatter = "10 N^0.5"               # of E* by all that is not speed or restitution
  [fit]                              # may be left out
  onset = "2 m/s"                    # b0, assumed: the stiffness from each first test alone
  depth = "0.4 m"                    # where to say how uncertain E_C is
  width = "1.5 m"
Without any standard deviation the tests weigh alike, and the residuals tell the scatter.

Examples:
  planar-impact stiffness cli/examples/tests/struble-welsh.toml
  planar-impact stiffness cli/examples/tests/malibu.toml --format json"#;

const CRASH3: &str = "\
The energy of each vehicle's crush times 1 + tan^2 alpha, at most 2, alpha from the perpendicular of
the crushed surface to the principal force; the effective mass from the moment arm of the force
through the impact center; delta-V at common velocity; then back along the force from the separation
velocities of the case. `crush --help` has the keys of the crush; `gradient` knows what is found by
names such as vehicle.1.crash3.delta_v_magnitude.

Examples:
  planar-impact crash3 cli/examples/cavalier-crush.toml
  planar-impact crash3 cli/examples/stiff-corner.toml --format json";

const FORMULA: &str = r#"Without a case file the formula is that of two vehicles at the critical impulse
ratio under the law of Brach; --ratio, --law, --barrier and --moment say otherwise.
With one it is that of the case, and text has the value of every line, in SI.

Examples:
  planar-impact formula W_n
  planar-impact formula W_n --wrt Gamma
  planar-impact formula T_L --ratio friction --barrier 2
  planar-impact formula mu0 --wrt contact.restitution --case cli/examples/position-a.toml
  planar-impact formula dV1 --format latex
  planar-impact formula energy.loss --wrt vehicle.1.mass --format rust > loss_by_mass.rs
  planar-impact formula --list"#;

/// Planar impact mechanics and crush energy: how two vehicles leave a collision, and what it cost them.
#[derive(Debug, Parser)]
#[command(name = "planar-impact", version, after_help = STATUS, max_term_width = 100)]
pub struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub verb: Verb,
}

/// What to do.
#[derive(Debug, Subcommand)]
pub enum Verb {
    /// Solve a collision: final velocities, impulse, delta-V, energy.
    #[command(after_help = CASE)]
    Solve(Solve),
    /// Differentiate a collision: how its outputs answer to its inputs.
    #[command(after_help = GRADIENT)]
    Gradient(Gradient),
    /// Vary one or two inputs of a collision: tables, data and charts.
    #[command(after_help = SWEEP)]
    Sweep(Sweep),
    /// Check collision results of any program against the laws of mechanics.
    #[command(after_help = CHECK)]
    Check(Check),
    /// Tell what residual crush stands for: energy and equivalent speed.
    #[command(after_help = CRUSH)]
    Crush(Crush),
    /// Reconstruct delta-V from crush as CRASH3 does, beside planar mechanics.
    #[command(after_help = CRASH3)]
    Crash3(Crash3),
    /// Fit crush stiffness to barrier tests, with its uncertainty.
    #[command(after_help = STIFFNESS)]
    Stiffness(Stiffness),
    /// Hold every printed cell of the paper's tables to account, then measured tests.
    #[command(after_help = VALIDATE)]
    Validate(Validate),
    /// Prove the identities of the mechanics, and show what is wrong in print.
    #[command(after_help = "Examples:\n  planar-impact prove\n  planar-impact prove --format json")]
    Prove(Prove),
    /// Print the formula that the code computes for an output, or for its derivative.
    #[command(after_help = FORMULA)]
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

/// The call of `solve`.
#[derive(Debug, Args)]
pub struct Solve {
    /// The case file, TOML or JSON; - reads standard input.
    pub case: PathBuf,
    /// How to print the result.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub format: Format,
    /// Units of the text; those that most of the case file is in, unless given. JSON is always SI.
    #[arg(long, value_enum)]
    pub units: Option<Units>,
}

/// The call of `crush`.
#[derive(Debug, Args)]
pub struct Crush {
    /// The case file, TOML or JSON; - reads standard input.
    pub case: PathBuf,
    /// How to print the result.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub format: Format,
    /// Units of the text; those that most of the case file is in, unless given. JSON is always SI.
    #[arg(long, value_enum)]
    pub units: Option<Units>,
}

/// The call of `crash3`.
#[derive(Debug, Args)]
pub struct Crash3 {
    /// The case file, TOML or JSON; - reads standard input.
    pub case: PathBuf,
    /// How to print the result.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub format: Format,
    /// Units of the text; those that most of the case file is in, unless given. JSON is always SI.
    #[arg(long, value_enum)]
    pub units: Option<Units>,
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

/// The call of `formula`.
#[derive(Debug, Args)]
pub struct Formula {
    /// The output, by its name or its symbol.
    #[arg(value_name = "NAME", value_parser = formula::output, required_unless_present = "list")]
    pub output: Option<Output>,
    /// The input to differentiate by, by its name or its symbol.
    #[arg(long, value_name = "NAME", value_parser = formula::input)]
    pub wrt: Option<Input>,
    /// How to print the formula.
    #[arg(long, value_enum, default_value_t = Notation::Text)]
    pub format: Notation,
    /// A case file that has the kind of collision, and the numbers; - reads standard input.
    #[arg(long, value_name = "CASE", conflicts_with_all = ["ratio", "law", "barrier", "moment"])]
    pub case: Option<PathBuf>,
    /// What the impulse ratio is given by.
    #[arg(long, value_enum, default_value_t = Ratio::Critical)]
    pub ratio: Ratio,
    /// The law of the tangential impulse.
    #[arg(long, value_enum, default_value_t = TangentialLaw::Brach)]
    pub law: TangentialLaw,
    /// Which of the two, 1 or 2, is a fixed barrier.
    #[arg(long, value_name = "VEHICLE", value_parser = clap::value_parser!(u8).range(1..=2))]
    pub barrier: Option<u8>,
    /// What the moment impulse is given by.
    #[arg(long, value_enum, default_value_t = MomentImpulse::None)]
    pub moment: MomentImpulse,
    /// List the outputs and the inputs instead.
    #[arg(long, conflicts_with_all = ["output", "wrt", "format", "case", "ratio", "law", "barrier", "moment"])]
    pub list: bool,
}

/// How to print a formula.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Notation {
    /// For a terminal.
    Text,
    /// For a document.
    Latex,
    /// For a program: a function of f64.
    Rust,
}

/// What the impulse ratio is given by.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Ratio {
    /// By the law alone: at the critical ratio sliding just ends.
    Critical,
    /// By a number.
    Given,
    /// By a fraction of the critical ratio.
    OfCritical,
    /// By a friction that limits the critical ratio.
    Friction,
}

/// The law of the tangential impulse.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum TangentialLaw {
    /// Sliding has ended at separation.
    Brach,
    /// Restitution holds for both components.
    KudlichSlibar,
}

/// What the moment impulse is given by.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum MomentImpulse {
    /// There is none.
    None,
    /// By a number.
    Given,
    /// By a fraction of the moment that ends relative rotation.
    OfCritical,
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
