//! Runs each verb: reads its files, calls the application layer and renders its page.

use std::path::{Path, PathBuf};

use clap::CommandFactory;
use planar_impact_app::gradient::Selection;
use planar_impact_app::json::Layout;
use planar_impact_app::stiffness::TestFile;
use planar_impact_app::{
    Answer, Case, Control, Issues, Notice, Notices, Units, compare, crash3, crush, formula, gradient, prove, reconstruct, record, scene,
    schema, slide, solve, stiffness, sweep, template, uncertainty, validate,
};
use planar_impact_report::chart;
use planar_impact_report::page::{self, Facts};
use serde::Serialize;

use crate::arguments::{
    self, Arguments, CompareFormat, DrawFormat, Format, Notation, OfCase, RecordFormat, SamplePoints, SlideFormat, SweepFormat,
    UncertaintyFormat, UncertaintyMethod, UnitSystem, Verb,
};
use crate::exit::Failure;
use crate::output::CommandOutput;
use crate::progress::Progress;
use crate::{batch, check, files, report};

/// Maximum number of rows of a table for people.
const MOST_ROWS: usize = 20_000;

/// Runs a verb.
///
/// # Errors
///
/// Returns everything wrong with the call or the files, or why there is no answer.
pub fn run(verb: Verb) -> Result<CommandOutput, Failure> {
    match verb {
        Verb::New { kind } => template::of(&kind).map_or(Err(Failure::Defect), |text| Ok(CommandOutput::text(text.to_owned()))),
        Verb::Solve(call) => of_case(&call, solve::solve),
        Verb::Crush(call) => of_case(&call, crush::crush),
        Verb::Crash3(call) => of_case(&call, crash3::crash3),
        Verb::Gradient(call) => differentiate(&call),
        Verb::Sweep(call) => vary(&call),
        Verb::Compare(call) => line_up(&call),
        Verb::Batch(call) => batch::run(&call),
        Verb::Reconstruct(call) => look_back(&call),
        Verb::Uncertainty(call) => doubt(&call),
        Verb::Slide(call) => follow(&call),
        Verb::Draw(call) => sketch(&call),
        Verb::Report(call) => report::run(&call),
        Verb::Record(call) => recorded(&call),
        Verb::Stiffness(call) => fit(&call),
        Verb::Formula(call) => express(&call),
        Verb::Check(call) => check::run(&call),
        Verb::Validate(call) => hold_tables(&call),
        Verb::Prove(call) => establish(&call),
        Verb::Schema { of } => schema::of(&of).map_or(Err(Failure::Defect), |schema| CommandOutput::json(&schema, Layout::Pretty)),
        Verb::Completions { shell } => {
            let mut script = Vec::new();
            clap_complete::generate(shell, &mut Arguments::command(), "planar-impact", &mut script);
            // The script for bash names the program in its labels otherwise than where it looks for them, because of the dash.
            let script = String::from_utf8_lossy(&script).replace("planar__subcmd__impact", "planar__impact");
            Ok(CommandOutput::text(script))
        }
        Verb::Man => {
            let mut manual = Vec::new();
            arguments::manual(&mut manual).map_err(Failure::Output)?;
            Ok(CommandOutput::text(String::from_utf8_lossy(&manual).into_owned()))
        }
    }
}

/// Reads a case file, and returns it with the units for its reader: those requested, or those that most of the file uses.
pub fn read(path: &Path, units: Option<UnitSystem>) -> Result<(Case, Units), Failure> {
    read_unless_written(path, units, None)
}

/// Reads a case file, and returns it as [`read`] does, unless the call would write over a file that it names.
pub fn read_unless_written(path: &Path, units: Option<UnitSystem>, written: Option<&Path>) -> Result<(Case, Units), Failure> {
    let case = case_unless_written(path, written)?;
    let units = units.map_or(case.units, Units::from);
    Ok((case, units))
}

/// Reads a case file, unless the call would write over a file that it names.
pub fn case_unless_written(path: &Path, written: Option<&Path>) -> Result<Case, Issues> {
    Case::parse_with(files::source(path)?, files::beside(path, written))
}

/// Attaches the reader's units to issues.
fn in_units<T>(answer: Result<T, Issues>, units: Units) -> Result<T, Failure> {
    answer.map_err(|issues| Failure::Issues(issues, units))
}

/// An answer as a page or as JSON.
fn print<T: Facts + Serialize>(answer: &Answer<T>, format: Format, units: Units) -> Result<CommandOutput, Failure> {
    match format {
        Format::Text => Ok(CommandOutput::page(&page::page(answer, units))),
        Format::Json => CommandOutput::json(answer, Layout::Pretty),
    }
}

/// A verb of the application layer that takes a case alone.
type VerbOfCase<T> = fn(&Case, &(), &dyn Control) -> Result<Answer<T>, Issues>;

fn of_case<T: Facts + Serialize>(call: &OfCase, verb: VerbOfCase<T>) -> Result<CommandOutput, Failure> {
    let (case, units) = read(&call.case, call.units)?;
    let answer = in_units(verb(&case, &(), &Progress::new()), units)?;
    print(&answer, call.format, units)
}

fn differentiate(call: &arguments::Gradient) -> Result<CommandOutput, Failure> {
    let (case, units) = read(&call.case, call.units)?;
    // Text shows the principal selection unless names are given.
    let selection = |names: &[String]| match (names, call.format) {
        ([], Format::Text) => Selection::Principal,
        ([], Format::Json) => Selection::All,
        (names, _) => Selection::Named(names.to_vec()),
    };
    let options = gradient::Options { of: selection(&call.of), wrt: selection(&call.wrt), second: call.second };
    let answer = in_units(gradient::gradient(&case, &options, &Progress::new()), units)?;
    print(&answer, call.format, units)
}

fn vary(call: &arguments::Sweep) -> Result<CommandOutput, Failure> {
    let (case, units) = read(&call.case, call.units)?;
    let of_text = sweep::Shown { most: MOST_ROWS, by: "--format text", help: "take a larger step, or --format csv, json or svg" };
    let shown = (call.format == SweepFormat::Text).then_some(of_text);
    let options = sweep::Options { vary: call.vary.clone(), of: call.of.clone(), shown };
    let answer = in_units(sweep::sweep(&case, &options, &Progress::new()), units)?;
    match call.format {
        SweepFormat::Text => Ok(CommandOutput::page(&page::page(&answer, units))),
        SweepFormat::Csv => Ok(csv(page::sweep_csv::records(&answer, units))?.noting(&answer.notices, units)),
        SweepFormat::Json => CommandOutput::json(&answer, Layout::Compact),
        SweepFormat::Svg => Ok(CommandOutput::text(chart::sweep(&answer, units)?).noting(&answer.notices, units)),
    }
}

fn line_up(call: &arguments::Compare) -> Result<CommandOutput, Failure> {
    files::is_read_once(&call.cases)?;
    let variant = |path: &PathBuf| {
        Ok(compare::Variant { name: path.display().to_string(), case: Case::parse_with(files::source(path)?, files::beside(path, None))? })
    };
    let variants = Issues::all(call.cases.iter().map(variant))?;
    let units = call.units.map_or_else(|| variants.first().map_or(Units::Si, |first| first.case.units), Units::from);
    let answer = in_units(compare::compare(&variants, &(), &Progress::new()), units)?;
    let output = match call.format {
        CompareFormat::Text => CommandOutput::page(&page::page(&answer, units)),
        CompareFormat::Json => CommandOutput::json(&answer, Layout::Pretty)?,
        CompareFormat::Svg => CommandOutput::text(chart::compare(&answer, units)?).noting(&answer.notices, units),
    };
    Ok(output.holds(answer.is_complete()))
}

fn csv(records: impl Iterator<Item = Vec<String>>) -> Result<CommandOutput, Failure> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for record in records {
        writer.write_record(record).map_err(Issues::defect)?;
    }
    let bytes = writer.into_inner().map_err(Issues::defect)?;
    Ok(CommandOutput::text(String::from_utf8(bytes).map_err(Issues::defect)?))
}

fn look_back(call: &arguments::Reconstruct) -> Result<CommandOutput, Failure> {
    if let Some(message) = call.without_effect() {
        return Err(Failure::of_options(message));
    }
    let (case, units) = read(&call.case, call.units)?;
    let options = reconstruct::Options {
        starts: usize::try_from(call.starts).unwrap_or(usize::MAX),
        seed: call.seed,
        level: call.level,
        profile: call.profile,
        guaranteed: call.guaranteed,
        bounds_sd: call.bounds_sd,
        posterior: call.posterior,
        probabilities: call.probability.clone(),
        draws: call.draws,
    };
    let answer = in_units(reconstruct::reconstruct(&case, &options, &Progress::new()), units)?;
    let output =
        if call.brief { CommandOutput::page(&page::reconstruct::brief(&answer, units)) } else { print(&answer, call.format, units)? };
    Ok(output.holds(answer.is_answer))
}

fn doubt(call: &arguments::Uncertainty) -> Result<CommandOutput, Failure> {
    if let Some(message) = call.without_effect() {
        return Err(Failure::of_options(message));
    }
    let (case, units) = read(&call.case, call.units)?;
    let method = |method: &UncertaintyMethod| match method {
        UncertaintyMethod::Linear => uncertainty::Method::Linear,
        UncertaintyMethod::SecondOrder => uncertainty::Method::SecondOrder,
        UncertaintyMethod::MonteCarlo => uncertainty::Method::MonteCarlo,
        UncertaintyMethod::Sobol => uncertainty::Method::Sobol,
        UncertaintyMethod::Shapley => uncertainty::Method::Shapley,
        UncertaintyMethod::Bounds => uncertainty::Method::Bounds,
    };
    let default = uncertainty::Options::default();
    let options = uncertainty::Options {
        of: call.of.clone(),
        methods: call.method.iter().map(method).collect(),
        samples: call.samples.unwrap_or(default.samples),
        seed: call.seed.unwrap_or(default.seed),
        points_of_sobol: call.points == Some(SamplePoints::Sobol),
        precision: call.precision,
        probabilities: call.probability.clone(),
        level: call.level.unwrap_or(default.level),
        bounds_sd: call.bounds_sd,
    };
    if let Some(issue) = options.without_effect(&call.given()) {
        return Err(Issues::of_call(vec![issue]).into());
    }
    let answer = in_units(uncertainty::uncertainty(&case, &options, &Progress::new()), units)?;
    let notices = || {
        let refused = (answer.refused.count > 0).then(|| Notice::note("refused-samples", "", page::uncertainty::samples_drawn(&answer)));
        Notices(answer.notices.0.iter().cloned().chain(refused).collect())
    };
    match call.format {
        UncertaintyFormat::Text => Ok(CommandOutput::page(&page::page(&answer, units))),
        UncertaintyFormat::Json => CommandOutput::json(&answer, Layout::Pretty),
        UncertaintyFormat::Csv => Ok(csv(page::uncertainty_csv::records(&answer, units).into_iter())?.noting(&notices(), units)),
        UncertaintyFormat::Svg => Ok(CommandOutput::text(chart::uncertainty(&answer, units)?).noting(&notices(), units)),
    }
}

fn follow(call: &arguments::Slide) -> Result<CommandOutput, Failure> {
    let (case, units) = read(&call.case, call.units)?;
    let answer = in_units(slide::slide(&case, &(), &Progress::new()), units)?;
    match call.format {
        SlideFormat::Text => Ok(CommandOutput::page(&page::page(&answer, units))),
        SlideFormat::Csv => Ok(csv(page::slide::records(&answer, units).into_iter())?.noting(&answer.notices, units)),
        SlideFormat::Json => CommandOutput::json(&answer, Layout::Pretty),
    }
}

fn sketch(call: &arguments::Draw) -> Result<CommandOutput, Failure> {
    let ending = match call.format {
        DrawFormat::Svg => "svg",
        DrawFormat::Json => "json",
    };
    files::is_no_input(call.output.as_deref(), [&call.case])?;
    files::is_named_as(call.output.as_deref(), &[ending])?;
    let (case, units) = read_unless_written(&call.case, call.units, call.output.as_deref())?;
    let answer = in_units(scene::draw(&case, &(), &Progress::new()), units)?;
    let output = match call.format {
        DrawFormat::Svg => CommandOutput::text(planar_impact_report::scene::scene(&answer, units)),
        DrawFormat::Json => CommandOutput::json(&answer, Layout::Pretty)?,
    };
    Ok(output.to(call.output.as_deref()))
}

fn recorded(call: &arguments::Record) -> Result<CommandOutput, Failure> {
    files::is_read_once(&call.files)?;
    let read = |path: &PathBuf| record::Recording::parse(files::source(path)?, &files::beside(path, None));
    let recordings = Issues::all(call.files.iter().map(read))?;
    let units = call.units.map(Units::from).or(recordings.first().map(|first| first.units)).unwrap_or(Units::Si);
    let answer = in_units(record::record(&recordings, &(), &Progress::new()), units)?;
    let output = match call.format {
        RecordFormat::Text => CommandOutput::page(&page::page(&answer, units)),
        RecordFormat::Json => CommandOutput::json(&answer, Layout::Compact)?,
        RecordFormat::Svg => CommandOutput::text(chart::record(&answer, units)?).noting(&answer.notices, units),
    };
    Ok(output.holds(answer.is_whole()))
}

fn fit(call: &arguments::Stiffness) -> Result<CommandOutput, Failure> {
    let file = TestFile::parse_with(files::source(&call.tests)?, files::beside(&call.tests, None))?;
    let units = call.units.map_or(file.units, Units::from);
    let answer = in_units(stiffness::stiffness(&file, &(), &Progress::new()), units)?;
    Ok(print(&answer, call.format, units)?.holds(answer.headlines.is_empty()))
}

fn express(call: &arguments::Formula) -> Result<CommandOutput, Failure> {
    let Some(output) = call.output else { return Ok(CommandOutput::page(&page::formula::names())) };
    let case = call.case.as_deref().map(|path| read(path, None)).transpose()?;
    let units = case.as_ref().map_or(Units::Si, |(_, units)| *units);
    let options = formula::Options { output, wrt: call.wrt, kind: call.kind() };
    let answer = in_units(formula::formula(case.as_ref().map(|(case, _)| case), &options, &Progress::new()), units)?;
    match call.format {
        Notation::Text => Ok(CommandOutput::page(&page::formula::page(&answer, units))),
        Notation::Latex => Ok(CommandOutput::text(answer.latex).noting(&answer.notices, units)),
        Notation::Rust => Ok(CommandOutput::text(answer.rust).noting(&answer.notices, units)),
        Notation::Json => CommandOutput::json(&answer, Layout::Pretty),
    }
}

fn hold_tables(call: &arguments::Validate) -> Result<CommandOutput, Failure> {
    let answer = validate::validate(&(), &Progress::new())?;
    let output = match (call.figure, call.format) {
        (Some(figure), _) => CommandOutput::text(chart::paper::figure(&answer.report, figure.number())?),
        (None, Format::Text) => CommandOutput::page(&page::validate::page(&answer)),
        (None, Format::Json) => CommandOutput::json(&answer, Layout::Pretty)?,
    };
    Ok(output.holds(answer.report.holds()))
}

fn establish(call: &arguments::Prove) -> Result<CommandOutput, Failure> {
    let answer = prove::prove(&(), &planar_impact_app::Uncontrolled)?;
    let output = match call.format {
        Format::Text => CommandOutput::page(&page::prove::page(&answer)),
        Format::Json => CommandOutput::json(&answer, Layout::Pretty)?,
    };
    Ok(output.holds(answer.report.holds()))
}
