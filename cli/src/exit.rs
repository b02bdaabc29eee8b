//! How the program ends.

use crate::document::Problems;

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
    /// The user has asked to stop.
    Interrupted,
}

impl Status {
    /// Its number.
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

/// Why a verb has nothing to print.
#[derive(Debug)]
pub enum Failure {
    /// The call is wrong.
    Call(clap::Error),
    /// The case file is wrong.
    Input(Problems),
    /// The physics refuses the case.
    Physics(Problems),
    /// A defect, already reported.
    Defect,
    /// The program's own data are wrong.
    Data(String),
    /// The output cannot be written.
    Output(std::io::Error),
    /// The user has asked to stop.
    Interrupted,
}

impl Failure {
    /// Its exit status.
    pub fn status(&self) -> Status {
        match self {
            Failure::Call(_) | Failure::Input(_) => Status::Input,
            Failure::Physics(_) => Status::Physics,
            Failure::Defect | Failure::Data(_) => Status::Defect,
            Failure::Output(_) => Status::Output,
            Failure::Interrupted => Status::Interrupted,
        }
    }

    /// What to tell the user, if it has not been told.
    pub fn render(&self, color: bool) -> Option<String> {
        match self {
            Failure::Call(error) if color => Some(error.render().ansi().to_string()),
            Failure::Call(error) => Some(error.render().to_string().trim_end().to_owned()),
            Failure::Input(problems) | Failure::Physics(problems) => Some(problems.render(color)),
            Failure::Defect | Failure::Interrupted => None,
            Failure::Data(what) => Some(format!("error: a defect of planar-impact, please report it: {what}")),
            Failure::Output(error) => Some(format!("error: the output cannot be written: {error}")),
        }
    }
}
