//! Messages of the issues of a number or a list.

use alloc::borrow::Cow;
use alloc::string::ToString;
use core::fmt;

use super::{InputIssue, InputIssueKind};
use crate::issue::Issue;
use crate::measure::Measure;
use crate::message::Message;
use crate::scalar::Ordered;

impl<T: Clone> InputIssue<T> {
    /// Returns the message with its own subject, such as the name of the number: [`Issue::message`] uses `it`.
    pub fn sentence(&self, subject: impl Into<Cow<'static, str>>) -> Message<T> {
        let measure = self.at.measure;
        let subject = Message::new().text(subject);
        match &self.kind {
            // A number that is not finite has no unit.
            InputIssueKind::NotFinite { value } => subject.text(" is not finite: ").figure(Measure::Ratio, value.clone()),
            InputIssueKind::SeveralNotFinite { count } => {
                subject.text(" is not finite").text(alloc::format!("; it is the first of {count} such numbers"))
            }
            InputIssueKind::NotPositive { value } => subject.text(" is ").figure(measure, value.clone()).text("; it must be above zero"),
            InputIssueKind::OutOfRange { value, least, greatest } => {
                let is = subject.text(" is ").figure(measure, value.clone());
                match greatest {
                    Some(greatest) => {
                        is.text("; it must be from ").figure(measure, least.clone()).text(" to ").figure(measure, greatest.clone())
                    }
                    None => is.text("; it must be at least ").figure(measure, least.clone()),
                }
            }
            InputIssueKind::OutOfOrder { value, before } => subject
                .text(" is ")
                .figure(measure, value.clone())
                .text(" after ")
                .figure(measure, before.clone())
                .text("; it is out of order"),
            InputIssueKind::TooFew { count, least } => {
                subject.text(alloc::format!(" has {count} {}; it needs at least {least}", if *count == 1 { "item" } else { "items" }))
            }
        }
    }
}

impl<T: Ordered<Mask = bool>> Issue for InputIssue<T> {
    type Number = T;

    fn code(&self) -> &'static str {
        self.code()
    }

    fn path(&self) -> Option<Cow<'static, str>> {
        Some(self.at.path())
    }

    fn message(&self) -> Message<T> {
        let subject = self.at.part.map_or(Cow::Borrowed("it"), |part| alloc::format!("its {part}").into());
        self.sentence(subject)
    }

    fn help(&self) -> Option<Message<T>> {
        match &self.kind {
            // A share given in percent.
            InputIssueKind::OutOfRange { value, greatest: Some(greatest), .. }
                if self.at.measure == Measure::Ratio
                    && greatest.less(value)
                    && !T::int(100).less(value)
                    && !greatest.less(&T::int(1))
                    && !T::int(1).less(greatest) =>
            {
                Some(Message::new().text("did you mean \"").figure(Measure::Ratio, value.clone()).text(" %\"?"))
            }
            _ => None,
        }
    }
}

impl<T: Clone + fmt::Display> fmt::Display for InputIssue<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.sentence(self.at.to_string()).fmt(f)
    }
}

impl<T: Clone + fmt::Debug + fmt::Display> core::error::Error for InputIssue<T> {}
