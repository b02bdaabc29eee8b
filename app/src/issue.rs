//! Issues of an input, collected together, each with a code, a path and a remedy.

use std::fmt;
use std::ops::Range;
use std::sync::Arc;

use crate::message::Message;
use crate::source::Source;
use crate::units::Units;

/// Maximum number of issues collected, so that a hostile file cannot exhaust the memory.
pub(crate) const MOST_KEPT: usize = 1000;

/// One thing wrong with an input.
#[derive(Clone, Debug, PartialEq)]
pub struct Issue {
    /// A stable code in kebab case, such as `unknown-key` or `tensile`.
    pub code: &'static str,
    /// The bytes of the source that it refers to; `None` if it refers to the whole file or to the call.
    pub span: Option<Range<usize>>,
    /// Its dotted path, vehicles counted from 1, such as `vehicle.1.mass`, or the option of a call; may be empty.
    pub path: String,
    /// The message, with the value and the values that are accepted.
    pub message: Message,
    /// A remedy.
    pub help: Option<Message>,
    /// The text that it refers to, if that is another one than that of the first issues.
    pub source: Option<Arc<Source>>,
}

impl Issue {
    /// Creates an issue with the file as a whole.
    pub fn of_file(code: &'static str, message: impl Into<Message>) -> Issue {
        Issue::at(code, String::new(), message)
    }

    /// Creates an issue with an option of the call.
    pub fn of_call(option: &str, message: impl Into<Message>, help: Option<String>) -> Issue {
        Issue { help: help.map(Message::from), ..Issue::at("call", option.trim_end(), message) }
    }

    /// Creates an issue with a path, to be located in a document.
    pub fn at(code: &'static str, path: impl Into<String>, message: impl Into<Message>) -> Issue {
        Issue { code, span: None, path: path.into(), message: message.into(), help: None, source: None }
    }

    /// Adds a remedy.
    pub fn with_help(self, help: impl Into<Message>) -> Issue {
        Issue { help: Some(help.into()), ..self }
    }
}

/// The cause of a failed verb.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cause {
    /// The input or the call is wrong.
    Input,
    /// The physics refuses the input, or a search did not converge.
    Physics,
    /// The caller has requested a stop.
    Interrupted,
    /// A defect of the program.
    Defect,
}

/// All issues of a failed verb, in file order.
#[derive(Clone, Debug, PartialEq)]
pub struct Issues {
    cause: Cause,
    source: Arc<Source>,
    list: Vec<Issue>,
}

impl Issues {
    /// Sorts issues into file order; issues with the whole file come first.
    pub fn new(cause: Cause, source: Arc<Source>, mut list: Vec<Issue>) -> Issues {
        list.sort_by_key(|issue| issue.span.as_ref().map(|span| (span.start, span.end)));
        Issues { cause, source, list }
    }

    /// Creates issues with a call, or with files whose text is not available.
    pub fn without_source(cause: Cause, list: Vec<Issue>) -> Issues {
        Issues::new(cause, Arc::default(), list)
    }

    /// Creates issues with a call.
    pub fn of_call(list: Vec<Issue>) -> Issues {
        Issues::without_source(Cause::Input, list)
    }

    /// Creates the error of a verb that the caller has stopped.
    pub fn interrupted() -> Issues {
        Issues::without_source(Cause::Interrupted, Vec::new())
    }

    /// Creates the error of an internal contradiction in the program.
    pub fn defect(what: impl fmt::Display) -> Issues {
        Issues::without_source(Cause::Defect, vec![Issue::of_file("defect", what.to_string())])
    }

    /// Returns every result, or the issues of all that failed, each at its place in its file.
    ///
    /// # Errors
    ///
    /// The issues, if any of the results is an error. An interrupt or a defect is returned alone.
    pub fn all<T>(results: impl IntoIterator<Item = Result<T, Issues>>) -> Result<Vec<T>, Issues> {
        let (mut found, mut wrong): (Vec<T>, Option<Issues>) = (Vec::new(), None);
        for result in results {
            match result {
                Ok(value) => found.push(value),
                Err(issues) if issues.stand_alone() => return Err(issues),
                Err(issues) => {
                    wrong = Some(match wrong {
                        Some(first) => first.and(issues),
                        None => issues,
                    });
                }
            }
        }
        wrong.map_or(Ok(found), Err)
    }

    /// Returns both results, or the issues of those that failed, as [`all`](Issues::all) does.
    ///
    /// # Errors
    ///
    /// The issues, if one of the results is an error.
    pub fn both<A, B>(one: Result<A, Issues>, other: Result<B, Issues>) -> Result<(A, B), Issues> {
        match (one, other) {
            (Ok(one), Ok(other)) => Ok((one, other)),
            (Ok(_), Err(issues)) | (Err(issues), Ok(_)) => Err(issues),
            (Err(one), Err(other)) => Err(one.and(other)),
        }
    }

    fn stand_alone(&self) -> bool {
        matches!(self.cause, Cause::Interrupted | Cause::Defect)
    }

    fn and(mut self, other: Issues) -> Issues {
        if self.stand_alone() || other.stand_alone() {
            return if self.stand_alone() { self } else { other };
        }
        let source = other.source;
        self.list.extend(other.list.into_iter().map(|issue| Issue { source: issue.source.or_else(|| Some(source.clone())), ..issue }));
        self
    }

    /// Returns the cause.
    pub fn cause(&self) -> Cause {
        self.cause
    }

    /// Returns the text that the first issues refer to; empty if there is none.
    pub fn source(&self) -> &Source {
        &self.source
    }

    /// Returns the text that an issue refers to; empty if there is none.
    pub fn source_of<'a>(&'a self, issue: &'a Issue) -> &'a Source {
        issue.source.as_deref().unwrap_or(&self.source)
    }

    /// Returns every issue, in file order; empty only if the caller has requested a stop.
    pub fn list(&self) -> &[Issue] {
        &self.list
    }

    /// Returns the line of an issue, counted from 1, or `None` if it has no place in a text.
    pub fn line(&self, issue: &Issue) -> Option<usize> {
        let text = &self.source_of(issue).text;
        let start = issue.span.as_ref()?.start.min(text.len());
        Some(1 + text.as_bytes()[..start].iter().filter(|byte| **byte == b'\n').count())
    }
}

impl fmt::Display for Issues {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, issue) in self.list.iter().enumerate() {
            let separator = if i > 0 { "\n" } else { "" };
            let colon = if issue.path.is_empty() { "" } else { ": " };
            write!(f, "{separator}{}{colon}{}", issue.path, Units::Si.sentence(&issue.message))?;
            issue.help.iter().try_for_each(|help| write!(f, " ({})", Units::Si.sentence(help)))?;
        }
        Ok(())
    }
}

impl std::error::Error for Issues {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn issues_are_in_file_order_and_know_their_lines() {
        let source = Source::new("case.toml", "a = 1\nb = 2\n");
        let issue = |span, path: &str| Issue { span, ..Issue::at("invalid", path, "it is wrong").with_help("mend it") };
        let issues = Issues::new(Cause::Input, source.into(), vec![issue(Some(6..7), "b"), issue(Some(0..1), "a"), issue(None, "")]);
        let lines: Vec<_> = issues.list().iter().map(|issue| issues.line(issue)).collect();
        assert_eq!(lines, [None, Some(1), Some(2)]);
        assert_eq!(issues.to_string(), "it is wrong (mend it)\na: it is wrong (mend it)\nb: it is wrong (mend it)");
    }
}
