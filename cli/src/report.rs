//! The verb `report`: answers a file and writes a document.

use std::path::{Path, PathBuf};

use clap::CommandFactory;
use clap::error::ErrorKind;
use planar_impact_app::report::{self, Identity};
use planar_impact_app::stiffness::{self, TestFile};
use planar_impact_app::{Issues, Units, validate};
use planar_impact_report::document::{self, CheckDigest, Part};
use planar_impact_report::html;

use crate::arguments::{Arguments, Report, ReportVerb};
use crate::exit::Failure;
use crate::output::CommandOutput;
use crate::progress::Progress;
use crate::{check, files, interrupt, verbs};

/// Writes the report.
///
/// # Errors
///
/// Those of the verb that it is about; a call with the wrong number of files, or that would write over one of them.
pub fn run(call: &Report) -> Result<CommandOutput, Failure> {
    files::is_no_input(call.output.as_deref(), &call.files)?;
    files::is_named_as(call.output.as_deref(), &["html", "htm"])?;
    let verb = match call.verb {
        None => None,
        Some(ReportVerb::Solve) => Some(report::ReportVerb::Solve),
        Some(ReportVerb::Reconstruct) => Some(report::ReportVerb::Reconstruct),
        Some(ReportVerb::Crush) => Some(report::ReportVerb::Crush),
        Some(ReportVerb::Crash3) => Some(report::ReportVerb::Crash3),
        Some(ReportVerb::Uncertainty) => Some(report::ReportVerb::Uncertainty),
        Some(_) if call.posterior && call.verb != Some(ReportVerb::Reconstruct) => return Err(report::posterior_of_nothing().into()),
        Some(ReportVerb::Check | ReportVerb::Validate) if call.units.is_some() => {
            return Err(Failure::of_options("--units has no effect: this report has the units of its files; leave it out"));
        }
        Some(ReportVerb::Stiffness) => return of_stiffness(call),
        Some(ReportVerb::Check) => return of_check(call),
        Some(ReportVerb::Validate) => return of_validation(call),
    };
    let (case, units) = verbs::read_unless_written(one(call)?, call.units, call.output.as_deref())?;
    let answer = report::report(&case, &report::Options { verb, posterior: call.posterior }, &Progress::new())
        .map_err(|issues| Failure::Issues(issues, units))?;
    Ok(write(call, &document::of_case(&answer, &options(call, units))?).holds(answer.is_answer()))
}

fn of_stiffness(call: &Report) -> Result<CommandOutput, Failure> {
    let path = one(call)?;
    let source = files::source(path)?;
    let identity = Identity::of(&source);
    let file = TestFile::parse_with(source, files::beside(path, call.output.as_deref()))?;
    let units = call.units.map_or(file.units, Units::from);
    let answer = stiffness::stiffness(&file, &(), &Progress::new()).map_err(|issues| Failure::Issues(issues, units))?;
    Ok(write(call, &document::of_stiffness(&answer, &identity, &options(call, units))?).holds(answer.headlines.is_empty()))
}

fn of_check(call: &Report) -> Result<CommandOutput, Failure> {
    if call.files.is_empty() {
        return Err(wrong_number("give one file of records or more"));
    }
    let mut digest = CheckDigest::default();
    let holds = check::digest(&call.files, &mut digest)?;
    if interrupt::is_interrupted() {
        return Err(Issues::interrupted().into());
    }
    Ok(write(call, &digest.document(&options(call, Units::Si))?).holds(holds))
}

fn of_validation(call: &Report) -> Result<CommandOutput, Failure> {
    if !call.files.is_empty() {
        return Err(wrong_number("--verb validate takes no file"));
    }
    let answer = validate::validate(&(), &Progress::new())?;
    let holds = answer.report.holds();
    Ok(write(call, &document::of_validation(&answer, &options(call, Units::Si))?).holds(holds))
}

fn options(call: &Report, units: Units) -> document::Options {
    let parts = call.sections.iter().filter_map(|name| Part::ALL.into_iter().find(|part| part.name() == name)).collect();
    document::Options { units, date: call.date.clone(), parts }
}

fn write(call: &Report, document: &html::Document) -> CommandOutput {
    CommandOutput::text(html::render(document)).to(call.output.as_deref())
}

/// Returns the one file of the call.
fn one(call: &Report) -> Result<&Path, Failure> {
    let [file] = &call.files[..] else { return Err(wrong_number("give one file")) };
    Ok(PathBuf::as_path(file))
}

fn wrong_number(message: &str) -> Failure {
    Failure::Call(Arguments::command().error(ErrorKind::WrongNumberOfValues, message))
}
