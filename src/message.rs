//! Messages whose numbers keep their measure.
//!
//! A [`Message`] is written once, in SI; the program that shows it converts its figures to the units of its reader.

use alloc::borrow::Cow;
use alloc::string::String;
use alloc::vec::Vec;
use core::fmt;

use crate::measure::Measure;

/// A message: text and figures in order. [`Display`](fmt::Display) prints the figures in SI with their units, with the precision of the formatter if it has
/// one.
///
/// ```
/// use planar_impact::{Measure, Message};
/// let message = Message::new().text("vehicles gain ").figure(Measure::Energy, 12.25).text(" in the impact");
/// assert_eq!(message.to_string(), "vehicles gain 12.25 J in the impact");
/// assert_eq!(format!("{message:.0}"), "vehicles gain 12 J in the impact");
/// assert_eq!(message.figures().collect::<Vec<_>>(), [(Measure::Energy, &12.25)]);
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Message<T = f64>(Vec<Part<T>>);

/// A part of a [`Message`].
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Part<T = f64> {
    /// Text.
    Text(Cow<'static, str>),
    /// A number.
    Figure {
        /// Its measure.
        measure: Measure,
        /// Its value in SI.
        value: T,
    },
}

impl<T> Message<T> {
    /// Creates an empty message.
    #[must_use]
    pub const fn new() -> Self {
        Message(Vec::new())
    }

    /// Appends text.
    #[must_use]
    pub fn text(mut self, text: impl Into<Cow<'static, str>>) -> Self {
        self.0.push(Part::Text(text.into()));
        self
    }

    /// Appends a number in SI, with its measure.
    #[must_use]
    pub fn figure(mut self, measure: Measure, value: T) -> Self {
        self.0.push(Part::Figure { measure, value });
        self
    }

    /// Appends another message.
    #[must_use]
    pub fn join(mut self, other: Message<T>) -> Self {
        self.0.extend(other.0);
        self
    }

    /// Returns its parts, in order.
    pub fn parts(&self) -> &[Part<T>] {
        &self.0
    }

    /// Returns its figures in order, each with its measure.
    pub fn figures(&self) -> impl Iterator<Item = (Measure, &T)> {
        self.0.iter().filter_map(|part| match part {
            Part::Figure { measure, value } => Some((*measure, value)),
            Part::Text(_) => None,
        })
    }
}

impl<T> Default for Message<T> {
    fn default() -> Self {
        Message::new()
    }
}

impl<T> From<&'static str> for Message<T> {
    fn from(text: &'static str) -> Self {
        Message::new().text(text)
    }
}

impl<T> From<String> for Message<T> {
    fn from(text: String) -> Self {
        Message::new().text(text)
    }
}

impl<T: fmt::Display> fmt::Display for Message<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.iter().try_for_each(|part| match part {
            Part::Text(text) => f.write_str(text),
            Part::Figure { measure, value } => {
                match f.precision() {
                    Some(precision) => write!(f, "{value:.precision$}")?,
                    None => write!(f, "{value}")?,
                }
                match measure.si_unit() {
                    "" => Ok(()),
                    unit => write!(f, " {unit}"),
                }
            }
        })
    }
}
