//! Arguments of `validate`.

use clap::{Args, ValueEnum};

use super::Format;

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

impl FigureNumber {
    /// Returns the number.
    pub fn number(self) -> u32 {
        match self {
            FigureNumber::Six => 6,
            FigureNumber::Seven => 7,
        }
    }
}
