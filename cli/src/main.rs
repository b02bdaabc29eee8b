//! `planar-impact`: reads a file, calls the application layer and prints its answer.

mod arguments;
mod batch;
mod check;
mod defect;
mod diagnostics;
mod exit;
mod files;
mod interrupt;
mod output;
mod progress;
mod report;
mod verbs;

use std::io::IsTerminal;
use std::process::ExitCode;

use arguments::Arguments;
use exit::{Failure, Status};
use output::CommandOutput;

fn main() -> ExitCode {
    interrupt::install();
    defect::install();
    let outcome = std::panic::catch_unwind(|| match Arguments::of_call() {
        Ok(arguments) => verbs::run(arguments.verb),
        // clap returns help and version as errors whose text belongs on standard output.
        Err(asked) if !asked.use_stderr() => Ok(CommandOutput::text(asked.render().to_string())),
        Err(wrong) => Err(wrong.into()),
    })
    .unwrap_or(Err(Failure::Defect));
    let status = outcome.and_then(CommandOutput::print).unwrap_or_else(|failure| report(&failure));
    ExitCode::from(status.code())
}

fn report(failure: &Failure) -> Status {
    let color = std::io::stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty());
    if let Some(text) = failure.render(color) {
        output::say(text);
    }
    failure.status()
}
