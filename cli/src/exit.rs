//! Exit statuses and failures of the program.

use std::fmt::Display;

use clap::CommandFactory;
use clap::builder::StyledStr;
use clap::error::{ContextValue, ErrorKind};
use planar_impact_app::plain_text::{is_active, shorten};
use planar_impact_app::{Cause, Issues, Units};

use crate::arguments::Arguments;
use crate::diagnostics;

/// Maximum width of a word of the call repeated in a message, in columns.
const LONGEST_WORD: usize = 120;

/// The exit status.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// Done.
    Done,
    /// Done, and a check did not hold.
    DoesNotHold,
    /// The input or the call is wrong, or a file cannot be read.
    Input,
    /// The physics refuses the input.
    Physics,
    /// A defect of the program.
    Defect,
    /// The output cannot be written.
    Output,
    /// The user has requested a stop.
    Interrupted,
}

impl Status {
    /// Returns its number.
    pub fn code(self) -> u8 {
        match self {
            Status::Done => 0,
            Status::DoesNotHold => 1,
            Status::Input => 2,
            Status::Physics => 3,
            Status::Defect => 70,
            Status::Output => 74,
            Status::Interrupted => 130,
        }
    }
}

/// Reason why a verb prints no answer.
#[derive(Debug)]
pub enum Failure {
    /// The call is wrong.
    Call(clap::Error),
    /// A verb has no answer; figures are in the units of the reader.
    Issues(Issues, Units),
    /// A defect, already reported.
    Defect,
    /// The output cannot be written.
    Output(std::io::Error),
}

impl Failure {
    /// Creates the failure of options that exclude each other, or of one that would have no effect.
    pub fn of_options(message: impl Display) -> Failure {
        Failure::Call(Arguments::command().error(ErrorKind::ArgumentConflict, message))
    }
}

/// In place of clap's hint to write `--` before a value: that is right for files alone.
const WITH_A_DASH: &str = "a value that begins with - is written with an equals sign, as in --option=-1; a file as ./-name";

/// A wrong call, with its words cleaned and shortened. A hint that repeats a long word is omitted.
impl From<clap::Error> for Failure {
    fn from(mut error: clap::Error) -> Self {
        let is_plain = |hint: &StyledStr| {
            let hint = hint.to_string();
            hint.len() <= 2 * LONGEST_WORD && !hint.contains(is_active)
        };
        let cleaned = |value: &ContextValue| match value {
            ContextValue::String(word) => Some(ContextValue::String(shorten(word, LONGEST_WORD))),
            ContextValue::Strings(words) => Some(ContextValue::Strings(words.iter().map(|word| shorten(word, LONGEST_WORD)).collect())),
            ContextValue::StyledStrs(hints) => {
                let right = |hint: &StyledStr| if hint.to_string().contains("'-- ") { WITH_A_DASH.into() } else { hint.clone() };
                Some(ContextValue::StyledStrs(hints.iter().filter(|hint| is_plain(hint)).map(right).collect()))
            }
            _ => None,
        };
        let context: Vec<_> = error.context().filter_map(|(kind, value)| Some((kind, cleaned(value)?))).collect();
        for (kind, value) in context {
            error.insert(kind, value);
        }
        Failure::Call(error)
    }
}

impl From<Issues> for Failure {
    fn from(issues: Issues) -> Self {
        Failure::Issues(issues, Units::Si)
    }
}

impl Failure {
    /// Returns its exit status.
    pub fn status(&self) -> Status {
        match self {
            Failure::Call(_) => Status::Input,
            Failure::Issues(issues, _) => match issues.cause() {
                Cause::Input => Status::Input,
                Cause::Physics => Status::Physics,
                Cause::Interrupted => Status::Interrupted,
                Cause::Defect => Status::Defect,
            },
            Failure::Defect => Status::Defect,
            Failure::Output(_) => Status::Output,
        }
    }

    /// Returns the message for the user, if there is one.
    pub fn render(&self, color: bool) -> Option<String> {
        match self {
            Failure::Call(error) if color => Some(error.render().ansi().to_string()),
            Failure::Call(error) => Some(error.render().to_string().trim_end().to_owned()),
            Failure::Issues(issues, units) => match issues.cause() {
                Cause::Interrupted => None,
                Cause::Defect => Some(format!("error: a defect of planar-impact, please report it: {issues}")),
                Cause::Input | Cause::Physics => Some(diagnostics::render(issues, *units, color)),
            },
            Failure::Defect => None,
            Failure::Output(error) => Some(format!("error: the output cannot be written: {error}")),
        }
    }
}
