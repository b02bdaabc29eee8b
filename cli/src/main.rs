//! `planar-impact`: read a case, call the library, print what it answers. No mechanics here.

mod arguments;
mod bracket;
mod case;
mod check;
mod crash3;
mod crush;
mod derivative;
mod document;
mod exit;
mod formula;
mod gradient;
mod named;
mod names;
mod progress;
mod prove;
mod quantity;
mod reconstruct;
mod report;
mod solution;
mod solve;
mod stiffness;
mod sweep;
mod table;
mod units;
mod validate;
mod wording;

use std::io::{IsTerminal, Write};
use std::process::ExitCode;

use arguments::{Arguments, Verb};
use clap::{CommandFactory, Parser};
use exit::{Failure, Status};

fn main() -> ExitCode {
    // A defect is reported as one, with its own status, and not as a wall of text.
    std::panic::set_hook(Box::new(|defect| eprintln!("error: a defect of planar-impact, please report it: {defect}")));
    let outcome = std::panic::catch_unwind(|| match Arguments::try_parse() {
        Ok(arguments) => run(arguments.verb),
        // Help and version come as errors of which the text belongs on standard output.
        Err(asked) if !asked.use_stderr() => Ok(Done::with(asked.render().to_string())),
        Err(wrong) => Err(Failure::Call(wrong)),
    })
    .unwrap_or(Err(Failure::Defect));
    let status = match outcome {
        Ok(done) => print(&done.text).map_or_else(|failure| report(&failure), |()| done.status),
        Err(failure) => report(&failure),
    };
    ExitCode::from(status.code())
}

/// What a verb has to say, and whether what it checked holds.
pub struct Done {
    text: String,
    status: Status,
}

impl Done {
    /// Done, with nothing that failed to hold.
    pub fn with(text: String) -> Done {
        Done { text, status: Status::Done }
    }

    /// Done, and something does not hold.
    pub fn without_agreement(text: String) -> Done {
        Done { text, status: Status::DoesNotHold }
    }
}

fn run(verb: Verb) -> Result<Done, Failure> {
    match verb {
        Verb::Solve(call) => solve::run(&call),
        Verb::Gradient(call) => gradient::run(&call),
        Verb::Sweep(call) => sweep::run(&call),
        Verb::Check(call) => check::run(&call),
        Verb::Crush(call) => crush::run(&call),
        Verb::Crash3(call) => crash3::run(&call),
        Verb::Reconstruct(call) => reconstruct::run(&call),
        Verb::Stiffness(call) => stiffness::run(&call),
        Verb::Validate(call) => validate::run(&call),
        Verb::Prove(call) => prove::run(&call),
        Verb::Formula(call) => formula::run(&call),
        Verb::Completions { shell } => {
            let mut script = Vec::new();
            clap_complete::generate(shell, &mut Arguments::command(), "planar-impact", &mut script);
            Ok(Done::with(String::from_utf8_lossy(&script).into_owned()))
        }
        Verb::Man => {
            let mut page = Vec::new();
            arguments::manual(&mut page).map_err(Failure::Output)?;
            Ok(Done::with(String::from_utf8_lossy(&page).into_owned()))
        }
    }
}

/// All of the text or none: nothing is written before everything is known.
fn print(text: &str) -> Result<(), Failure> {
    let mut output = std::io::stdout().lock();
    match output.write_all(text.as_bytes()).and_then(|()| output.flush()) {
        // The reader has seen enough, as `head` does.
        Err(error) if error.kind() == std::io::ErrorKind::BrokenPipe => Ok(()),
        other => other.map_err(Failure::Output),
    }
}

fn report(failure: &Failure) -> Status {
    let color = std::io::stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty());
    if let Some(text) = failure.render(color) {
        // Nothing is left to be told if standard error cannot be written either.
        let _ = writeln!(std::io::stderr(), "{text}");
    }
    failure.status()
}
