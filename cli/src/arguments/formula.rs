//! The call of `formula`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use planar_impact::{Input, Output};

use crate::formula;

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
