//! The verbs: arguments in, answers out.

use std::fs::File;
use std::io::BufReader;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use planar_impact_app::check::{self as checks, CheckReport, Entries, Entry, Origin, Summary};
use planar_impact_app::gradient::Selection;
use planar_impact_app::json::{self, Layout};
use planar_impact_app::stiffness::TestFile;
use planar_impact_app::uncertainty::Method;
use planar_impact_app::{Answer as AppAnswer, Case, Cause, Control, Issue, Issues, Notices, Units};
use planar_impact_report::document::{self, Part};
use planar_impact_report::page::{self, Facts};
use planar_impact_report::{chart, html, scene, text};
use pyo3::prelude::*;
use serde::Serialize;

use crate::answer::{Answer, Figure, Render};
use crate::control::Signals;
use crate::error::{self, Failure};
use crate::source::Source;
use crate::units::{self, unknown};

/// Runs `verb` on a case without the interpreter lock; Ctrl+C stops it. The verb is given the units of the reader.
fn on_case<A: Send>(
    py: Python<'_>,
    source: &Source,
    named: Option<&str>,
    verb: impl FnOnce(&Arc<Case>, Units, &dyn Control) -> Result<A, Issues> + Send,
) -> PyResult<A> {
    on_long_case(py, source, named, None, verb)
}

/// The same, with reports of its progress.
fn on_long_case<A: Send>(
    py: Python<'_>,
    source: &Source,
    named: Option<&str>,
    progress: Option<Py<PyAny>>,
    verb: impl FnOnce(&Arc<Case>, Units, &dyn Control) -> Result<A, Issues> + Send,
) -> PyResult<A> {
    let signals = Signals::new(progress);
    let answer = py.detach(|| {
        let failure = |units| move |issues| Failure { issues, units, has_lines: source.has_lines() };
        let given = units::named(named).map_err(failure(Units::Si))?;
        let case = Arc::new(source.case().map_err(failure(given.unwrap_or(Units::Si)))?);
        let units = given.unwrap_or(case.units);
        verb(&case, units, &signals).map_err(failure(units))
    });
    signals.finish(answer)
}

/// A verb of the application layer that takes a case alone.
type VerbOfCase<T> = fn(&Case, &(), &dyn Control) -> Result<AppAnswer<T>, Issues>;

/// Answers a verb that needs a case and nothing more.
fn plain<T: Facts + Serialize + Send + Sync + 'static>(
    py: Python<'_>,
    source: &Source,
    named: Option<&str>,
    verb: VerbOfCase<T>,
) -> PyResult<Answer> {
    on_case(py, source, named, |case, units, control| Ok(Answer::of(&Arc::new(verb(case, &(), control)?), units, Layout::Pretty)))
}

/// Solves the collision.
#[pyfunction]
pub fn solve(py: Python<'_>, case: &Source, units: Option<&str>) -> PyResult<Answer> {
    on_case(py, case, units, |case, units, control| {
        let answer = Arc::new(planar_impact_app::solve::solve(case, &(), control)?);
        let case = case.clone();
        let drawing: Figure = Box::new(move |units| {
            planar_impact_app::scene::draw(&case, &(), &planar_impact_app::Uncontrolled).map(|scene| Some(scene::scene(&scene, units)))
        });
        let shown = Answer::of(&answer, units, Layout::Pretty).with_figure("scene", drawing);
        Ok(shown.with_chart("impulse", &answer, chart::impulse).with_chart("energy", &answer, chart::energy))
    })
}

/// Computes the crush energy.
#[pyfunction]
pub fn crush(py: Python<'_>, case: &Source, units: Option<&str>) -> PyResult<Answer> {
    plain(py, case, units, planar_impact_app::crush::crush)
}

/// Computes ΔV by CRASH3.
#[pyfunction]
pub fn crash3(py: Python<'_>, case: &Source, units: Option<&str>) -> PyResult<Answer> {
    plain(py, case, units, planar_impact_app::crash3::crash3)
}

/// Follows the vehicles to rest.
#[pyfunction]
pub fn slide(py: Python<'_>, case: &Source, units: Option<&str>) -> PyResult<Answer> {
    plain(py, case, units, planar_impact_app::slide::slide)
}

/// Differentiates outputs. The page shows the principal ones unless names are given, as on the command line.
#[pyfunction]
pub fn gradient(py: Python<'_>, case: &Source, units: Option<&str>, of: Vec<String>, wrt: Vec<String>, second: bool) -> PyResult<Answer> {
    use planar_impact_app::gradient::{Options, gradient};
    let selection = |names: &[String], all: Selection| if names.is_empty() { all } else { Selection::Named(names.to_vec()) };
    let options = |all: Selection| Options { of: selection(&of, all.clone()), wrt: selection(&wrt, all), second };
    on_case(py, case, units, |case, units, control| {
        let answer = Arc::new(gradient(case, &options(Selection::All), control)?);
        let (case, principal) = (case.clone(), options(Selection::Principal));
        let page: Render = Box::new(move |units| {
            let answer = gradient(&case, &principal, &planar_impact_app::Uncontrolled)?;
            Ok(text::render(&page::page(&answer, units)))
        });
        Ok(Answer::of(&answer, units, Layout::Pretty).with_page(page).with_chart("effects", &answer, chart::tornado_of_gradient))
    })
}

/// Varies inputs.
#[pyfunction]
pub fn sweep(
    py: Python<'_>,
    case: &Source,
    units: Option<&str>,
    vary: Vec<String>,
    of: Vec<String>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Answer> {
    use planar_impact_app::sweep::{Options, sweep};
    let options = Options { vary, of, shown: None };
    on_long_case(py, case, units, progress, |case, units, control| {
        let answer = Arc::new(sweep(case, &options, control)?);
        Ok(Answer::of(&answer, units, Layout::Compact).with_chart("sweep", &answer, chart::sweep))
    })
}

/// Searches for the unknowns.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "the options of the verb, which Python names")]
pub fn reconstruct(
    py: Python<'_>,
    case: &Source,
    units: Option<&str>,
    starts: u64,
    seed: u64,
    level: f64,
    profile: bool,
    guaranteed: bool,
    bounds_sd: f64,
    posterior: bool,
    probability: Vec<String>,
    draws: bool,
    progress: Option<Py<PyAny>>,
) -> PyResult<Answer> {
    use planar_impact_app::reconstruct::{Options, reconstruct};
    let mut issues = Vec::new();
    if !(1..=10_000).contains(&starts) {
        issues.push(Issue::of_call("starts", format!("{starts}; it must be from 1 to 10000"), None));
    }
    if !(0.5..=0.9999).contains(&level) {
        issues.push(Issue::of_call("level", format!("{level}; it must be from 0.5 to 0.9999, such as 0.95"), None));
    }
    if !guaranteed && bounds_sd != Options::default().bounds_sd {
        let help = Some("add --guaranteed, or leave it out".to_owned());
        issues.push(Issue::of_call("--bounds-sd", "it has no effect: it is for guaranteed ranges", help));
    }
    if !issues.is_empty() {
        return Err(error::of(Issues::of_call(issues)));
    }
    let starts = usize::try_from(starts).unwrap_or(usize::MAX);
    let options = Options { starts, seed, level, profile, guaranteed, bounds_sd, posterior, probabilities: probability, draws };
    on_long_case(py, case, units, progress, |case, units, control| {
        let answer = Arc::new(reconstruct(case, &options, control)?);
        let (shown, title) = (answer.clone(), case.title.clone());
        let drawing: Figure = Box::new(move |units| {
            Ok(shown
                .scene
                .as_ref()
                .map(|(facts, notices)| scene::scene(&AppAnswer::new(&title, facts.clone(), Notices(notices.clone())), units)))
        });
        let shown = Answer::of(&answer, units, Layout::Pretty).with_figure("scene", drawing);
        let shown = shown.with_chart("intervals", &answer, chart::intervals).with_chart("residuals", &answer, chart::residuals);
        Ok(shown.with_chart("profile", &answer, chart::profile).with_chart("posterior", &answer, chart::posterior))
    })
}

/// The options of `uncertainty`.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct UncertaintyOptions {
    of: Vec<String>,
    method: Vec<String>,
    samples: u64,
    seed: u64,
    points: String,
    precision: Option<f64>,
    probability: Vec<String>,
    level: f64,
    bounds_sd: f64,
}

/// Computes the uncertainty of outputs.
#[pyfunction]
pub fn uncertainty(
    py: Python<'_>,
    case: &Source,
    units: Option<&str>,
    options: UncertaintyOptions,
    progress: Option<Py<PyAny>>,
) -> PyResult<Answer> {
    use planar_impact_app::uncertainty::{Options, uncertainty};
    let method = |name: &String| match name.as_str() {
        "linear" => Ok(Method::Linear),
        "second-order" => Ok(Method::SecondOrder),
        "monte-carlo" => Ok(Method::MonteCarlo),
        "sobol" => Ok(Method::Sobol),
        "shapley" => Ok(Method::Shapley),
        "bounds" => Ok(Method::Bounds),
        other => Err(unknown("method", other, "\"linear\", \"second-order\", \"monte-carlo\", \"sobol\", \"shapley\" and \"bounds\"")),
    };
    let points_of_sobol = match options.points.as_str() {
        "random" => false,
        "sobol" => true,
        other => return Err(error::of(unknown("points", other, "\"random\" and \"sobol\""))),
    };
    let options = Options {
        methods: options.method.iter().map(method).collect::<Result<_, _>>().map_err(error::of)?,
        of: options.of,
        samples: options.samples,
        seed: options.seed,
        points_of_sobol,
        precision: options.precision,
        probabilities: options.probability,
        level: options.level,
        bounds_sd: options.bounds_sd,
    };
    let default = Options::default();
    let given = [
        (options.samples != default.samples, "--samples"),
        (options.seed != default.seed, "--seed"),
        (options.points_of_sobol, "--points"),
        (options.precision.is_some(), "--precision"),
        (options.level != default.level, "--level"),
    ];
    let given: Vec<&str> = given.into_iter().filter_map(|(is_given, option)| is_given.then_some(option)).collect();
    if let Some(issue) = options.without_effect(&given) {
        return Err(error::of(Issues::of_call(vec![issue])));
    }
    on_long_case(py, case, units, progress, |case, units, control| {
        let answer = Arc::new(uncertainty(case, &options, control)?);
        let shown = Answer::of(&answer, units, Layout::Pretty).with_chart("uncertainty", &answer, chart::uncertainty);
        Ok(shown.with_chart("effects", &answer, chart::tornado_of_uncertainty))
    })
}

/// Fits the stiffness of vehicles to barrier tests.
#[pyfunction]
pub fn stiffness(py: Python<'_>, tests: &Source, units: Option<&str>) -> PyResult<Answer> {
    use planar_impact_app::stiffness::stiffness;
    let signals = Signals::new(None);
    let answer = py.detach(|| {
        let failure = |units| move |issues| Failure { issues, units, has_lines: tests.has_lines() };
        let given = units::named(units).map_err(failure(Units::Si))?;
        let (source, open) = tests.read().map_err(failure(Units::Si))?;
        let file = TestFile::parse_with(source, open).map_err(failure(given.unwrap_or(Units::Si)))?;
        let units = given.unwrap_or(file.units);
        let answer = Arc::new(stiffness(&file, &(), &signals).map_err(failure(units))?);
        let shown = Answer::of(&answer, units, Layout::Pretty);
        Ok(shown.with_chart("stiffness", &answer, chart::stiffness))
    });
    signals.finish(answer)
}

/// Reads recordings.
#[pyfunction]
pub fn record(py: Python<'_>, files: Vec<PyRef<'_, Source>>, units: Option<&str>) -> PyResult<Answer> {
    use planar_impact_app::record::{Recording, record};
    let signals = Signals::new(None);
    let files: Vec<&Source> = files.iter().map(|file| &**file).collect();
    let answer = py.detach(|| {
        let has_lines = files.iter().all(|file| file.has_lines());
        let failure = |units| move |issues| Failure { issues, units, has_lines };
        let given = units::named(units).map_err(failure(Units::Si))?;
        let read = |source: &&Source| source.read().and_then(|(source, open)| Recording::parse(source, &open));
        let recordings: Vec<Recording> = files.iter().map(read).collect::<Result<_, _>>().map_err(failure(given.unwrap_or(Units::Si)))?;
        let units = given.or(recordings.first().map(|first| first.units)).unwrap_or(Units::Si);
        let answer = Arc::new(record(&recordings, &(), &signals).map_err(failure(units))?);
        let shown = Answer::of(&answer, units, Layout::Compact);
        Ok(shown.with_chart("record", &answer, chart::record))
    });
    signals.finish(answer)
}

/// Returns the formula of an output, or of its derivative.
#[pyfunction]
pub fn formula(py: Python<'_>, output: &str, wrt: Option<&str>, case: Option<&Source>) -> PyResult<Answer> {
    use planar_impact_app::formula::{self, Options, formula};
    let issue = |argument: &'static str| move |message: String| error::of(Issues::of_call(vec![Issue::of_call(argument, message, None)]));
    let output = formula::output(output).map_err(issue("output"))?;
    let wrt = wrt.map(formula::input).transpose().map_err(issue("wrt"))?;
    let options = Options { output, wrt, kind: formula::Kind::default() };
    let answer = |case: Option<&Case>, units: Units, control: &dyn Control| {
        let answer = formula(case, &options, control)?;
        Answer::of_text(&answer, text::render(&page::formula::page(&answer, units)))
    };
    match case {
        Some(case) => on_case(py, case, None, |case, units, control| answer(Some(case), units, control)),
        None => {
            let signals = Signals::new(None);
            signals.finish(py.detach(|| answer(None, Units::Si, &signals)).map_err(Failure::from))
        }
    }
}

/// Draws the scene as SVG.
#[pyfunction]
pub fn draw(py: Python<'_>, case: &Source, units: Option<&str>) -> PyResult<String> {
    on_case(py, case, units, |case, units, control| {
        planar_impact_app::scene::draw(case, &(), control).map(|answer| scene::scene(&answer, units))
    })
}

/// Writes the report as HTML.
#[pyfunction]
pub fn report(
    py: Python<'_>,
    case: &Source,
    units: Option<&str>,
    verb: Option<&str>,
    posterior: bool,
    date: Option<String>,
    sections: Vec<String>,
) -> PyResult<String> {
    use planar_impact_app::report::{self, ReportVerb};
    let all = [ReportVerb::Solve, ReportVerb::Reconstruct, ReportVerb::Crush, ReportVerb::Crash3, ReportVerb::Uncertainty];
    let quoted = |names: &mut dyn Iterator<Item = &'static str>| names.map(|name| format!("{name:?}")).collect::<Vec<_>>().join(", ");
    let verb = verb.map(|name| {
        let found = all.into_iter().find(|verb| verb.name() == name);
        found.ok_or_else(|| error::of(unknown("verb", name, &quoted(&mut all.iter().map(|verb| verb.name())))))
    });
    let part = |name: &String| {
        let found = Part::ALL.into_iter().find(|part| part.name() == name);
        found.ok_or_else(|| error::of(unknown("sections", name, &quoted(&mut Part::ALL.iter().map(|part| part.name())))))
    };
    let (verb, parts) = (verb.transpose()?, sections.iter().map(part).collect::<PyResult<Vec<Part>>>()?);
    on_case(py, case, units, |case, units, control| {
        let answer = report::report(case, &report::Options { verb, posterior }, control)?;
        Ok(html::render(&document::of_case(&answer, &document::Options { units, date, parts })?))
    })
}

/// Returns the template of a case file.
#[pyfunction]
pub fn template(kind: &str) -> PyResult<&'static str> {
    use planar_impact_app::template::{kinds, of};
    let accepted = || kinds().map(|kind| format!("{kind:?}")).join(", ");
    of(kind).ok_or_else(|| error::of(unknown("kind", kind, &accepted())))
}

/// Checks the records of files.
#[pyfunction]
pub fn check(py: Python<'_>, files: Vec<PathBuf>, tolerance: Option<f64>) -> PyResult<Answer> {
    let signals = Signals::new(None);
    let options = checks::Options { tolerance };
    let answer = py.detach(|| -> Result<Answer, Issues> {
        let (mut entries, mut unusable): (Vec<(String, Entry)>, Vec<Issue>) = (Vec::new(), Vec::new());
        let mut summary = Summary::default();
        for path in &files {
            match records(path, options) {
                Ok(file) => {
                    let name = file.name().to_owned();
                    for entry in file {
                        let entry = entry?;
                        summary.add(&entry);
                        entries.push((name.clone(), entry));
                        if !signals.look(entries.len(), 0) {
                            return Err(Issues::interrupted());
                        }
                    }
                }
                Err(found) => unusable.extend_from_slice(found.list()),
            }
        }
        if !unusable.is_empty() {
            return Err(Issues::without_source(Cause::Input, unusable));
        }
        let records = entries.iter().map(|(file, entry)| entry.in_json(file)).collect();
        let report = CheckReport { schema: planar_impact_app::answer::SCHEMA, records, interrupted: false, summary };
        Answer::of_text(&report, json::text(&report, Layout::Pretty)?)
    });
    signals.finish(answer.map_err(Failure::from))
}

/// Opens a file of records.
fn records(path: &Path, options: checks::Options) -> Result<Entries, Issues> {
    let name = path.display().to_string();
    if path.is_dir() {
        return Err(checks::unusable(&name, "it is a directory, not a file of records"));
    }
    File::open(path).map_err(|error| checks::unusable(&name, &format!("it cannot be read: {}", checks::reason(&error))))?;
    let extension = path.extension().and_then(|end| end.to_str()).map(str::to_ascii_lowercase);
    let path = path.to_owned();
    let open: checks::Open = Box::new(move || Ok(Box::new(BufReader::new(File::open(&path)?))));
    Entries::open(&name, extension.as_deref(), Origin::File(open), options)
}
