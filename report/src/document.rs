//! The report of a case: the answer first, then what it stands on, for a reader who has nothing else.

mod check;
mod glossary;
mod method;

use planar_impact_app::issue::{Issue, Issues};
use planar_impact_app::notice::Notices;
use planar_impact_app::reconstruct::Reconstruction;
use planar_impact_app::report::{CaseReport, GivenEvidence, GivenInput, Identity, MainAnswer, ReportVerb};
use planar_impact_app::solve::Solution;
use planar_impact_app::stiffness::StiffnessAnswer;
use planar_impact_app::units::{Measure, Units, trim};
use planar_impact_app::validate::Validation;
use planar_impact_app::{Answer, Source, plain_text::shown};

use crate::block::{Block, Table};
use crate::chart;
use crate::html::{Document, Embedded, Section};
use crate::page::{self, Facts};
use crate::scene;

pub use check::CheckDigest;

/// A part of a report, in the order in which a report has them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// The answer in a few sentences, and what it is about.
    Summary,
    /// The drawing of the scene.
    Scene,
    /// What the case gives and asks for.
    Question,
    /// The equations and the assumptions.
    Method,
    /// The answer in full.
    Results,
    /// What the answer depends on.
    Sensitivity,
    /// The same by other methods.
    Alternatives,
    /// How the program itself was checked.
    Validation,
    /// The file as it was given.
    Input,
    /// The terms, for a reader of another field.
    Glossary,
}

impl Part {
    /// Every part.
    pub const ALL: [Part; 10] = [
        Part::Summary,
        Part::Scene,
        Part::Question,
        Part::Method,
        Part::Results,
        Part::Sensitivity,
        Part::Alternatives,
        Part::Validation,
        Part::Input,
        Part::Glossary,
    ];

    /// Returns its name on the command line, which is its address in the document too.
    pub fn name(self) -> &'static str {
        match self {
            Part::Summary => "summary",
            Part::Scene => "scene",
            Part::Question => "question",
            Part::Method => "method",
            Part::Results => "results",
            Part::Sensitivity => "sensitivity",
            Part::Alternatives => "alternatives",
            Part::Validation => "validation",
            Part::Input => "input",
            Part::Glossary => "glossary",
        }
    }

    fn heading(self) -> &'static str {
        match self {
            Part::Summary => "Summary",
            Part::Scene => "Scene",
            Part::Question => "Question and evidence",
            Part::Method => "Method and assumptions",
            Part::Results => "Results",
            Part::Sensitivity => "What the answer depends on",
            Part::Alternatives => "The same by other methods",
            Part::Validation => "How this program is checked",
            Part::Input => "The input as given",
            Part::Glossary => "Terms",
        }
    }
}

/// How a report is written.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// The units.
    pub units: Units,
    /// The date that the reader gives, in any words; the program adds none, so that the same input gives the same bytes.
    pub date: Option<String>,
    /// The parts; all that apply if empty.
    pub parts: Vec<Part>,
}

/// Returns the sections that have anything in them, or those that are asked for.
///
/// # Errors
///
/// Sections that are asked for and have nothing in them.
fn sections(options: &Options, mut of_part: impl FnMut(Part) -> Vec<Block>) -> Result<Vec<Section>, Issues> {
    let parts = Part::ALL.into_iter().filter(|part| options.parts.is_empty() || options.parts.contains(part));
    let section = |part: Part| Section { id: part.name(), heading: part.heading().to_owned(), blocks: of_part(part) };
    let (sections, empty): (Vec<Section>, Vec<Section>) = parts.map(section).partition(|section| !section.blocks.is_empty());
    if options.parts.is_empty() || empty.is_empty() {
        return Ok(sections);
    }
    let names: Vec<&str> = empty.iter().map(|section| section.id).collect();
    let message = format!("it has no effect: this report has nothing to say on {}", names.join(", "));
    Err(Issues::of_call(vec![Issue::of_call("--sections", message, Some(format!("leave out {}", names.join(", "))))]))
}

/// Writes the report of a case as a document.
///
/// # Errors
///
/// Parts that are asked for and have nothing in them.
pub fn of_case(report: &CaseReport, options: &Options) -> Result<Document, Issues> {
    let units = options.units;
    let (results, sensitivity) = (results(report, units)?, sensitivity(report, units)?);
    let of_part = |part| match part {
        Part::Summary => summary(report, options),
        Part::Scene => scene_of(report, units),
        Part::Question => question(report, units),
        Part::Method => method::blocks(report),
        Part::Results => results.clone(),
        Part::Sensitivity => sensitivity.clone(),
        Part::Alternatives => alternatives(report, units),
        Part::Validation => validation(&report.validation),
        Part::Input => input(&report.identity, &report.named_files),
        Part::Glossary => glossary::blocks(),
    };
    let title = if report.title.trim().is_empty() { "Report of a collision".to_owned() } else { report.title.clone() };
    let identity = &report.identity;
    Ok(Document { title, foot: foot(identity), sections: sections(options, of_part)?, embedded: embedded(identity, &report.named_files) })
}

/// Writes the report of barrier tests as a document.
///
/// # Errors
///
/// Parts that are asked for and have nothing in them.
pub fn of_stiffness(answer: &Answer<StiffnessAnswer>, identity: &Identity, options: &Options) -> Result<Document, Issues> {
    let units = options.units;
    let drawing = figure("The crush intensity of each test over its depth, with the fitted lines", chart::stiffness(answer, units)?);
    let of_part = |part| match part {
        Part::Summary => {
            let question = ["Question".to_owned(), "Which crush stiffness do these barrier tests have?".to_owned()];
            answer.summary(units).into_iter().chain([identify(identity, vec![question], options)]).collect()
        }
        Part::Method => vec![Block::paragraph(method::STIFFNESS)],
        Part::Results => [drawing.clone()].into_iter().chain(answer.blocks(units)).chain(Block::notices(&answer.notices, units)).collect(),
        Part::Input => input(identity, &[]),
        Part::Glossary => glossary::blocks(),
        _ => Vec::new(),
    };
    let title = if answer.title.trim().is_empty() { "Crush stiffness from barrier tests".to_owned() } else { answer.title.clone() };
    Ok(Document { title, foot: foot(identity), sections: sections(options, of_part)?, embedded: embedded(identity, &[]) })
}

/// Writes how the program compares with the paper's tables and with measured tests as a document.
///
/// # Errors
///
/// Parts that are asked for and have nothing in them.
pub fn of_validation(answer: &Validation, options: &Options) -> Result<Document, Issues> {
    let version = env!("CARGO_PKG_VERSION");
    let mut rows = vec![vec!["Program".to_owned(), format!("planar-impact {version}")]];
    rows.extend(options.date.iter().map(|date| vec!["Date".to_owned(), date.clone()]));
    let of_part = |part| match part {
        Part::Summary => vec![Block::paragraph(answer.report.summary()), Table::new(["this report", ""], "ll", rows.clone()).into()],
        Part::Method => [method::PROOF, method::LIMITS].map(Block::paragraph).into(),
        Part::Results => page::validate::page(answer),
        _ => Vec::new(),
    };
    let title = "Validation of planar-impact".to_owned();
    Ok(Document { title, foot: format!("planar-impact {version}"), sections: sections(options, of_part)?, embedded: Vec::new() })
}

/// What a printed page has at its foot.
fn foot(identity: &Identity) -> String {
    format!("planar-impact {}, input {}", identity.version, &identity.sha256[..16])
}

/// Embeds the input and the files that it names.
fn embedded(identity: &Identity, named: &[Source]) -> Vec<Embedded> {
    let of = |id: String, name: Option<String>, source: &Source| {
        let media_type = match source.text.trim_start() {
            text if text.starts_with('{') => "application/json",
            _ if source.name.ends_with(".csv") => "text/csv",
            _ => "application/toml",
        };
        Embedded { id, name, media_type, text: source.content().into_owned() }
    };
    let others = (1..).zip(named).map(|(number, source)| of(format!("file-{number}"), Some(source.name.clone()), source));
    std::iter::once(of("case".to_owned(), None, &identity.source)).chain(others).collect()
}

/// A verdict or the values, and what identifies the report.
fn summary(report: &CaseReport, options: &Options) -> Vec<Block> {
    let units = options.units;
    let mut blocks = facts(&report.main).0.summary(units);
    let about = vec![["Vehicles".to_owned(), report.names.join("; ")], ["Question".to_owned(), method::question(report.verb).to_owned()]];
    blocks.push(identify(&report.identity, about, options));
    blocks
}

/// Renders what identifies a report.
fn identify(identity: &Identity, mut rows: Vec<[String; 2]>, options: &Options) -> Block {
    let Identity { source, sha256, version } = identity;
    rows.extend([
        ["Input file".to_owned(), source.name.clone()],
        ["SHA-256 of the input".to_owned(), sha256.clone()],
        ["Program".to_owned(), format!("planar-impact {version}")],
    ]);
    rows.extend(options.date.iter().map(|date| ["Date".to_owned(), date.clone()]));
    Table::new(["this report", ""], "ll", rows.into_iter().map(Vec::from).collect()).into()
}

fn scene_of(report: &CaseReport, units: Units) -> Vec<Block> {
    let Some(answer) = &report.scene else { return Vec::new() };
    let title =
        "The collision to scale, with velocities before and after, impulses, and the principal direction of force on each vehicle's clock";
    vec![figure(title, scene::scene(answer, units))]
}

/// Renders what the case gives, what it asks for, and its evidence.
fn question(report: &CaseReport, units: Units) -> Vec<Block> {
    let mut blocks = vec![Block::paragraph(method::question(report.verb))];
    let row = |input: &GivenInput| {
        let number = |value: f64| number(units, input.measure, value);
        let value = match (input.value, input.sd, input.bounds) {
            (Some(value), _, [Some(low), Some(high)]) => format!("{}, {} to {}", number(value), number(low), number(high)),
            (Some(value), Some(sd), _) if input.is_normal => format!("{} ± {}", number(value), number(sd)),
            (Some(value), Some(sd), _) => format!("{}, sd {}", number(value), number(sd)),
            (Some(value), None, _) => number(value),
            (None, _, [None, None]) => "unknown".to_owned(),
            (None, _, [low, high]) => {
                let end = |end: Option<f64>, open: &str| end.map_or(open.to_owned(), number);
                format!("unknown, {} to {}", end(low, "any"), end(high, "any"))
            }
        };
        vec![input.name.clone(), value, units.unit(input.measure).to_owned()]
    };
    let inputs: Vec<Vec<String>> = report.inputs.iter().map(row).collect();
    blocks.push(Table::new(["input", "value", "unit"], "lrl", inputs).into());
    if !report.evidence.is_empty() && report.verb == ReportVerb::Reconstruct {
        let row = |evidence: &GivenEvidence| {
            let sd = evidence.sd.map_or("exact".to_owned(), |sd| number(units, evidence.measure, sd));
            vec![evidence.key.clone(), number(units, evidence.measure, evidence.value), sd, units.unit(evidence.measure).to_owned()]
        };
        let rows = report.evidence.iter().map(row).collect();
        blocks.push(Table::new(["evidence of the file", "value", "standard deviation", "unit"], "lrrl", rows).into());
    }
    blocks
}

/// Formats a number as it could be entered again: six significant digits.
fn number(units: Units, measure: Measure, si: f64) -> String {
    trim(units.convert(measure, si))
}

/// Returns what every answer has: its facts and its notices.
fn facts(main: &MainAnswer) -> (&dyn Facts, &Notices) {
    fn of<T: Facts>(answer: &Answer<T>) -> (&dyn Facts, &Notices) {
        (&answer.facts, &answer.notices)
    }
    match main {
        MainAnswer::Solve(answer) => of(answer),
        MainAnswer::Reconstruct(answer) => of(answer),
        MainAnswer::Crush(answer) => of(answer),
        MainAnswer::Crash3(answer) => of(answer),
        MainAnswer::Uncertainty(answer) => of(answer),
    }
}

/// Renders the answer in full, its figures first.
fn results(report: &CaseReport, units: Units) -> Result<Vec<Block>, Issues> {
    let mut blocks = match &report.main {
        MainAnswer::Solve(answer) => figures_of_solution(answer, units)?,
        MainAnswer::Reconstruct(answer) => figures_of_reconstruction(answer, units)?,
        MainAnswer::Uncertainty(answer) => vec![figure("The outputs by every method", chart::uncertainty(answer, units)?)],
        MainAnswer::Crush(_) | MainAnswer::Crash3(_) => Vec::new(),
    };
    let (facts, notices) = facts(&report.main);
    blocks.extend(facts.blocks(units));
    blocks.extend(Block::notices(notices, units));
    Ok(blocks)
}

fn figure(title: &str, svg: String) -> Block {
    Block::Figure { title: title.to_owned(), svg }
}

/// Draws the unknowns, the evidence and the collision of a reconstruction.
///
/// # Errors
///
/// A defect: drawing into memory cannot fail.
pub fn figures_of_reconstruction(answer: &Answer<Reconstruction>, units: Units) -> Result<Vec<Block>, Issues> {
    let mut blocks = vec![figure("The unknowns with their intervals, within their bounds", chart::intervals(answer, units)?)];
    blocks.extend(chart::residuals(answer, units)?.map(|svg| figure("How far each piece of evidence is from the best fit", svg)));
    blocks.extend(
        chart::profile(answer, units)?.map(|svg| figure("The profile of the likelihood: how much worse the best fit becomes", svg)),
    );
    blocks.extend(chart::posterior(answer, units)?.map(|svg| figure("The posterior of the unknowns", svg)));
    if let Some(solution) = &answer.solution {
        blocks.extend(figures_of_solution(solution, units)?);
    }
    Ok(blocks)
}

/// Draws the impulse and the energies of a collision.
///
/// # Errors
///
/// A defect: drawing into memory cannot fail.
pub fn figures_of_solution(answer: &Answer<Solution>, units: Units) -> Result<Vec<Block>, Issues> {
    let impulse = chart::impulse(answer, units)?;
    let impulse = impulse.map(|svg| figure("The impulse of the contact by Routh's construction", svg));
    let energy = figure("Where the energy goes", chart::energy(answer, units)?);
    Ok(impulse.into_iter().chain([energy]).collect())
}

fn sensitivity(report: &CaseReport, units: Units) -> Result<Vec<Block>, Issues> {
    let mut blocks = Vec::new();
    if let Some(answer) = &report.gradient {
        blocks.push(Block::paragraph(
            "No input has an uncertainty in the file: the bars show what a usual uncertainty of each would change, by exact derivatives.",
        ));
        blocks.push(figure("The effect of a usual uncertainty of each input", chart::tornado_of_gradient(answer, units)?));
    }
    if let Some(answer) = &report.uncertainty {
        blocks.push(figure("The effect of the standard deviation of each uncertain input", chart::tornado_of_uncertainty(answer, units)?));
        blocks.extend(answer.blocks(units));
    }
    if let MainAnswer::Uncertainty(answer) = &report.main {
        blocks.push(figure("The effect of the standard deviation of each uncertain input", chart::tornado_of_uncertainty(answer, units)?));
    }
    Ok(blocks)
}

fn alternatives(report: &CaseReport, units: Units) -> Vec<Block> {
    let heading = |text: String| Block::Heading { level: 2, text };
    let mut blocks = Vec::new();
    if let Some(other) = &report.other_law {
        blocks.push(heading(format!("By the tangential law of {}", other.name)));
        match &other.solution {
            Ok(solution) => {
                blocks.extend(solution.summary(units));
                blocks.extend(solution.blocks(units));
            }
            Err(issues) => blocks.push(Block::paragraph(format!("Physics refuses it: {issues}"))),
        }
    }
    if let Some(answer) = &report.crash3 {
        blocks.push(heading("From the crush, by CRASH3".to_owned()));
        blocks.extend(answer.summary(units));
        blocks.extend(answer.blocks(units));
    }
    if let MainAnswer::Reconstruct(answer) = &report.main
        && answer.crash3.is_none()
        && answer.other_minima.is_empty()
    {
        blocks.push(Block::paragraph("The evidence has no crush for CRASH3, and the search found no other minimum."));
    }
    blocks
}

/// Says what of the program is proven and validated, and to which error.
fn validation(validation: &Validation) -> Vec<Block> {
    let result = &validation.report;
    let mut blocks = vec![
        Block::paragraph(method::PROOF),
        Block::paragraph(format!("Validated, by the same program that made this report: {}", result.summary())),
    ];
    blocks.extend(page::validate::measured::blocks(&result.measured));
    blocks.push(Block::paragraph(method::LIMITS));
    blocks
}

fn input(identity: &Identity, named: &[Source]) -> Vec<Block> {
    let what = "The file that this report answers, without any change. It is also embedded in this document, in the element with the id \"case\": with it the \
                program gives the same answer again.";
    let mut blocks = vec![Block::paragraph(what), Block::Verbatim(shown_lines(&identity.source.text))];
    if !named.is_empty() {
        let names: Vec<&str> = named.iter().map(|source| source.name.as_str()).collect();
        blocks.push(Block::paragraph(format!(
            "It names other files, which are embedded in the elements from \"file-1\" on: {}.",
            names.join(", ")
        )));
    }
    blocks
}

/// Shows control characters of each line as their code points.
fn shown_lines(text: &str) -> String {
    text.lines().map(|line| shown(line).into_owned()).collect::<Vec<_>>().join("\n")
}
