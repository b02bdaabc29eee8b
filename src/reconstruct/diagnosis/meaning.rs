//! Sentences with figures, which the program that prints them converts to the reader's units.

use std::fmt;

use super::Figure;

/// A sentence with figures in it.
///
/// ```
/// use planar_impact::reconstruct::diagnosis::{Figure, Meaning};
/// let meaning = Meaning::of("what is left is ").figure(Figure::Speed(1.5)).words(" along the normal");
/// assert_eq!(meaning.to_string(), "what is left is 1.5 m/s along the normal");
/// let in_feet = meaning.with(|figure| format!("{:.1} ft/s", figure.value() / 0.3048));
/// assert_eq!(in_feet, "what is left is 4.9 ft/s along the normal");
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Meaning(Vec<Phrase>);

#[derive(Clone, Debug, PartialEq)]
enum Phrase {
    Words(String),
    Figure(Figure),
}

impl Meaning {
    /// Creates a sentence from its first words.
    pub fn of(words: impl Into<String>) -> Self {
        Meaning(vec![Phrase::Words(words.into())])
    }

    /// Appends words.
    #[must_use]
    pub fn words(mut self, words: impl Into<String>) -> Self {
        self.0.push(Phrase::Words(words.into()));
        self
    }

    /// Appends a figure.
    #[must_use]
    pub fn figure(mut self, figure: Figure) -> Self {
        self.0.push(Phrase::Figure(figure));
        self
    }

    /// Returns the sentence, with each figure printed by `print`.
    pub fn with(&self, print: impl Fn(Figure) -> String) -> String {
        let phrase = |phrase: &Phrase| match phrase {
            Phrase::Words(words) => words.clone(),
            Phrase::Figure(figure) => print(*figure),
        };
        self.0.iter().map(phrase).collect()
    }
}

impl fmt::Display for Meaning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.with(|figure| figure.to_string()))
    }
}

impl fmt::Display for Figure {
    /// Formats in SI, an angle in degrees and a share in percent, with as many digits as are significant to a reader.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Figure::Number(value) => write!(f, "{}", rounded(*value, 3)),
            Figure::Share(value) => write!(f, "{} %", rounded(100.0 * value, 1)),
            Figure::Angle(value) => write!(f, "{} deg", rounded(value.to_degrees(), 1)),
            Figure::Speed(value) => write!(f, "{} m/s", rounded(*value, 2)),
            Figure::YawRate(value) => write!(f, "{} deg/s", rounded(value.to_degrees(), 0)),
            Figure::Force(value) => write!(f, "{} kN", rounded(value / 1e3, 0)),
        }
    }
}

/// Rounds a number to a number of decimals, without trailing zeros and without a negative zero.
fn rounded(value: f64, decimals: i32) -> f64 {
    let unit = libm::exp10(f64::from(decimals));
    (value * unit).round() / unit + 0.0
}
