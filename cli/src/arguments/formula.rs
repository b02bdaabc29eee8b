//! Arguments of `formula`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use planar_impact::{Output, Side};
use planar_impact_app::formula::{self, Kind, MomentGiven};
use planar_impact_app::solve;

use super::whole;

/// Arguments of `formula`.
#[derive(Debug, Args)]
pub struct Formula {
    /// The output, by name or symbol.
    #[arg(value_name = "NAME", value_parser = formula::output, required_unless_present = "list")]
    pub output: Option<Output>,
    /// The input to differentiate with respect to, by name or symbol.
    #[arg(long, value_name = "NAME", value_parser = formula::input)]
    pub wrt: Option<formula::Wrt>,
    /// Notation of the formula.
    #[arg(long, value_enum, default_value_t = Notation::Text)]
    pub format: Notation,
    /// A case file that gives the kind of collision and the numbers; - reads standard input.
    #[arg(long, value_name = "CASE", conflicts_with_all = ["ratio", "law", "barrier", "moment"])]
    pub case: Option<PathBuf>,
    /// Form in which the impulse ratio is given.
    #[arg(long, value_enum, default_value_t = Ratio::Critical)]
    pub ratio: Ratio,
    /// The law of the tangential impulse.
    #[arg(long, value_enum, default_value_t = TangentialLaw::Brach)]
    pub law: TangentialLaw,
    /// The vehicle, 1 or 2, that is a fixed barrier.
    #[arg(long, value_name = "VEHICLE", value_parser = whole::<u8>(1..=2))]
    pub barrier: Option<u8>,
    /// Form in which the moment impulse is given.
    #[arg(long, value_enum, default_value_t = MomentImpulse::None)]
    pub moment: MomentImpulse,
    /// List the outputs and the inputs instead.
    #[arg(long, conflicts_with_all = ["output", "wrt", "format", "case", "ratio", "law", "barrier", "moment"])]
    pub list: bool,
}

/// Notation of a formula.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Notation {
    /// For a terminal.
    Text,
    /// For a document.
    Latex,
    /// For a program: a function of f64.
    Rust,
    /// Everything, as JSON.
    Json,
}

/// Form in which the impulse ratio is given.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Ratio {
    /// Not given: the critical ratio, at which sliding just ends.
    Critical,
    /// As a number.
    Given,
    /// As a fraction of the critical ratio.
    OfCritical,
    /// As a coefficient of friction that limits the critical ratio.
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

/// Form in which the moment impulse is given.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum MomentImpulse {
    /// There is none.
    None,
    /// As a number.
    Given,
    /// As a fraction of the moment impulse that ends relative rotation.
    OfCritical,
}

impl Formula {
    /// Returns the kind of collision that the options select.
    pub fn kind(&self) -> Kind {
        Kind {
            ratio: match self.ratio {
                Ratio::Critical => solve::ImpulseRatioGiven::Critical,
                Ratio::Given => solve::ImpulseRatioGiven::Number,
                Ratio::OfCritical => solve::ImpulseRatioGiven::OfCritical,
                Ratio::Friction => solve::ImpulseRatioGiven::Friction,
            },
            law: match self.law {
                TangentialLaw::Brach => solve::TangentialLaw::Brach,
                TangentialLaw::KudlichSlibar => solve::TangentialLaw::KudlichSlibar,
            },
            barrier: self.barrier.map(|number| if number == 1 { Side::One } else { Side::Two }),
            moment: match self.moment {
                MomentImpulse::None => MomentGiven::None,
                MomentImpulse::Given => MomentGiven::Number,
                MomentImpulse::OfCritical => MomentGiven::OfCritical,
            },
        }
    }
}
