//! What a report of a case stands on: the answer of its verb with what goes beside it, for a reader who has the report alone.

use planar_impact::reconstruct::Uncertainty as Spread;
use planar_impact::{Distribution, ImpulseRatio, Law, Output, Xy};
use sha2::{Digest, Sha256};

use crate::answer::Answer;
use crate::case::Case;
use crate::control::Control;
use crate::crash3::{self, Comparison};
use crate::crush::{self, CrushAnswer};
use crate::formula::{self, Formula};
use crate::gradient::{self, Gradient, Selection};
use crate::issue::{Issue, Issues};
use crate::reconstruct::{self, Reconstruction};
use crate::scene::{self, Scene};
use crate::solve::{self, Solution};
use crate::source::Source;
use crate::uncertainty::{self, Uncertainty};
use crate::units::Measure;
use crate::validate::{self, Validation};

/// The verb that a report of a case is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ReportVerb {
    /// How the vehicles leave the collision.
    Solve,
    /// What the evidence says of the unknowns.
    Reconstruct,
    /// The crush energy.
    Crush,
    /// ΔV by CRASH3.
    Crash3,
    /// How uncertain the outputs are.
    Uncertainty,
}

/// What a report of a case is to show.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Options {
    /// The verb; if none is given, that of the case.
    pub verb: Option<ReportVerb>,
    /// `true` to draw from the posterior of a reconstruction. Its last bits depend on the platform, and with them the bytes of the report.
    pub posterior: bool,
}

impl ReportVerb {
    /// Returns the verb of a case for which none is asked: `reconstruct` with unknowns, otherwise `solve`.
    pub fn of(case: &Case) -> Self {
        if case.knowledge.unknowns.is_empty() { ReportVerb::Solve } else { ReportVerb::Reconstruct }
    }

    /// Returns its name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            ReportVerb::Solve => "solve",
            ReportVerb::Reconstruct => "reconstruct",
            ReportVerb::Crush => "crush",
            ReportVerb::Crash3 => "crash3",
            ReportVerb::Uncertainty => "uncertainty",
        }
    }
}

/// The answer that a report is about.
#[derive(Clone, Debug, PartialEq)]
pub enum MainAnswer {
    /// Of `solve`.
    Solve(Box<Answer<Solution>>),
    /// Of `reconstruct`.
    Reconstruct(Box<Answer<Reconstruction>>),
    /// Of `crush`.
    Crush(Box<Answer<CrushAnswer>>),
    /// Of `crash3`.
    Crash3(Box<Answer<Comparison>>),
    /// Of `uncertainty`.
    Uncertainty(Box<Answer<Uncertainty>>),
}

/// What a report of a case stands on, in SI and radians.
#[derive(Clone, Debug)]
pub struct CaseReport {
    /// The verb.
    pub verb: ReportVerb,
    /// The title of the case; empty if it has none.
    pub title: String,
    /// The names of the vehicles.
    pub names: [String; 2],
    /// The file.
    pub identity: Identity,
    /// The files that it names.
    pub named_files: Vec<Source>,
    /// The numbers that the case gives, and those that it asks for.
    pub inputs: Vec<GivenInput>,
    /// The evidence that the case gives.
    pub evidence: Vec<GivenEvidence>,
    /// The answer.
    pub main: MainAnswer,
    /// The scene, where there is one collision to draw.
    pub scene: Option<Answer<Scene>>,
    /// The derivatives of the principal outputs by every input, where the answer is that of `solve` and no input is uncertain.
    pub gradient: Option<Answer<Gradient>>,
    /// The effect of uncertain inputs, where the answer is that of `solve`.
    pub uncertainty: Option<Answer<Uncertainty>>,
    /// The same collision by the other tangential law, where it makes a difference.
    pub other_law: Option<OtherLaw>,
    /// CRASH3 from the crush of the case, beside an answer of `solve`.
    pub crash3: Option<Answer<Comparison>>,
    /// The formulas of the critical impulse ratio and of the energy loss with the impulse, as the code computes them.
    pub formulas: Vec<Formula>,
    /// How the program compares with the paper's tables and with measured tests.
    pub validation: Validation,
}

impl CaseReport {
    /// Returns `true` unless it is of a reconstruction without a unique answer.
    pub fn is_answer(&self) -> bool {
        !matches!(&self.main, MainAnswer::Reconstruct(answer) if !answer.is_answer)
    }
}

/// What identifies the input of a report.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Identity {
    /// The file as it was given.
    pub source: Source,
    /// The SHA-256 of its content, in hexadecimal digits.
    pub sha256: String,
    /// The version of the program.
    pub version: &'static str,
}

/// A number of the case.
#[derive(Clone, Debug, PartialEq)]
pub struct GivenInput {
    /// Its name.
    pub name: String,
    /// Its measure.
    pub measure: Measure,
    /// Its value; `None` where it is unknown.
    pub value: Option<f64>,
    /// Its standard deviation, where it is uncertain.
    pub sd: Option<f64>,
    /// `true` if it is normal, so that ± says everything.
    pub is_normal: bool,
    /// The bounds of an unknown, or of an uncertain value that has both.
    pub bounds: [Option<f64>; 2],
}

/// A piece of evidence as the case gives it.
#[derive(Clone, Debug, PartialEq)]
pub struct GivenEvidence {
    /// Its path in the file.
    pub key: String,
    /// Its measure.
    pub measure: Measure,
    /// Its value.
    pub value: f64,
    /// Its standard deviation; `None` if it is exact.
    pub sd: Option<f64>,
}

/// A collision by another tangential law.
#[derive(Clone, Debug)]
pub struct OtherLaw {
    /// `Brach` or `Kudlich-Slibar`.
    pub name: &'static str,
    /// The collision, or why physics refuses it.
    pub solution: Result<Box<Solution>, Issues>,
}

impl Identity {
    /// Identifies a file.
    pub fn of(source: &Source) -> Self {
        let digits = Sha256::digest(source.content().as_bytes());
        let sha256 = digits.iter().map(|byte| format!("{byte:02x}")).collect();
        Identity { source: source.clone(), sha256, version: env!("CARGO_PKG_VERSION") }
    }
}

/// Returns the error of a posterior in a report of another verb than `reconstruct`.
pub fn posterior_of_nothing() -> Issues {
    let help = "leave it out, or give --verb reconstruct and a case with unknowns".to_owned();
    Issues::of_call(vec![Issue::of_call("--posterior", "it has no effect: the report is not one of `reconstruct`", Some(help))])
}

/// Answers a case, with everything that a report shows beside the answer.
///
/// # Errors
///
/// Those of the verb, and a posterior of what is not reconstructed. What only goes beside the answer is left out where the case does not have it.
pub fn report(case: &Case, options: &Options, control: &dyn Control) -> Result<CaseReport, Issues> {
    let verb = options.verb.unwrap_or_else(|| ReportVerb::of(case));
    if options.posterior && verb != ReportVerb::Reconstruct {
        return Err(posterior_of_nothing());
    }
    let main = match verb {
        ReportVerb::Solve => MainAnswer::Solve(Box::new(solve::solve(case, &(), control)?)),
        ReportVerb::Reconstruct => {
            let asked = reconstruct::Options { profile: true, posterior: options.posterior, ..Default::default() };
            MainAnswer::Reconstruct(Box::new(reconstruct::reconstruct(case, &asked, control)?))
        }
        ReportVerb::Crush => MainAnswer::Crush(Box::new(crush::crush(case, &(), control)?)),
        ReportVerb::Crash3 => MainAnswer::Crash3(Box::new(crash3::crash3(case, &(), control)?)),
        ReportVerb::Uncertainty => MainAnswer::Uncertainty(Box::new(uncertainty::uncertainty(case, &Default::default(), control)?)),
    };
    let is_solved = verb == ReportVerb::Solve;
    let is_certain = case.uncertain.inputs.is_empty();
    let all = gradient::Options { of: Selection::Principal, wrt: Selection::Principal, second: false };
    let of_solve = |wanted: bool| wanted && is_solved;
    let optional = |asked: bool| asked.then_some(());
    let scene = match &main {
        MainAnswer::Reconstruct(answer) => {
            answer.scene.clone().map(|(facts, notices)| Answer::new(&case.title, facts, crate::notice::Notices(notices)))
        }
        MainAnswer::Solve(_) | MainAnswer::Uncertainty(_) => scene::draw(case, &(), control).ok(),
        MainAnswer::Crush(_) | MainAnswer::Crash3(_) => None,
    };
    Ok(CaseReport {
        verb,
        title: case.title.clone(),
        names: case.names.clone(),
        identity: Identity::of(case.source()),
        named_files: case.named_files.clone(),
        inputs: inputs(case),
        evidence: evidence(case),
        scene,
        gradient: optional(of_solve(is_certain)).and_then(|()| gradient::gradient(case, &all, control).ok()),
        uncertainty: optional(of_solve(!is_certain)).and_then(|()| uncertainty::uncertainty(case, &Default::default(), control).ok()),
        other_law: optional(is_solved).and_then(|()| other_law(case)),
        crash3: optional(is_solved && case.setup.crush.iter().any(Option::is_some)).and_then(|()| crash3::crash3(case, &(), control).ok()),
        formulas: formulas(case, verb, control),
        validation: validate::validate(&(), control)?,
        main,
    })
}

fn inputs(case: &Case) -> Vec<GivenInput> {
    let unknown = |name: &str| case.knowledge.unknowns.iter().find(|unknown| unknown.key.strip_prefix("unknown.") == Some(name));
    let mut all: Vec<GivenInput> = case
        .inputs
        .keys()
        .into_iter()
        .map(|parameter| {
            let name = parameter.to_string();
            let uncertain = case.uncertain.inputs.iter().find(|input| input.parameter == parameter);
            let sd = uncertain.map(|input| input.distribution.sd()).filter(|sd| sd.is_finite());
            let value = case.inputs.value(parameter).ok().filter(|_| unknown(&name).is_none());
            let is_normal =
                uncertain.is_some_and(|input| matches!(input.distribution, Distribution::Normal { .. }) && input.values.is_none());
            let ends = uncertain.map(|input| [0.0, 1.0].map(|probability| input.distribution.quantile(probability)));
            let bounds = ends.filter(|ends| ends.iter().all(|end| end.is_finite())).map_or([None; 2], |ends| ends.map(Some));
            GivenInput { name, measure: parameter.measure(), value, sd, is_normal, bounds }
        })
        .filter(|input| input.value.is_some())
        .collect();
    all.extend(case.knowledge.unknowns.iter().map(|unknown| GivenInput {
        name: unknown.key.strip_prefix("unknown.").unwrap_or(&unknown.key).to_owned(),
        measure: unknown.of.measure(),
        value: None,
        sd: None,
        is_normal: false,
        bounds: [unknown.min, unknown.max],
    }));
    all
}

fn evidence(case: &Case) -> Vec<GivenEvidence> {
    let sd = |spread: &Spread| match spread {
        Spread::StandardDeviation(sd) => Some(*sd),
        Spread::Resolution(step) => Some(step / 12f64.sqrt()),
        Spread::Exact => None,
    };
    let given = |known: &crate::case::Known| GivenEvidence {
        key: known.key.strip_prefix("evidence.").unwrap_or(&known.key).to_owned(),
        measure: known.of.measure(),
        value: known.value,
        sd: sd(&known.uncertainty),
    };
    let mut all: Vec<GivenEvidence> = case.knowledge.evidence.iter().map(given).collect();
    for (i, rest) in case.rest.iter().flat_map(|rest| rest.vehicles.iter().enumerate()) {
        let Some(evidence) = rest.as_ref().and_then(|rest| rest.evidence.as_ref()) else { continue };
        let Xy { x, y } = evidence.rest.position;
        let sd = evidence.position_deviation;
        let numbers = [
            ("position.1", Measure::Length, x, sd.x),
            ("position.2", Measure::Length, y, sd.y),
            ("heading", Measure::Angle, evidence.rest.heading, evidence.heading_deviation),
        ];
        all.extend(numbers.map(|(key, measure, value, sd)| {
            let key = format!("rest.vehicle.{}.{key}", i + 1);
            GivenEvidence { key, measure, value, sd: Some(sd) }
        }));
    }
    all
}

fn other_law(case: &Case) -> Option<OtherLaw> {
    // A given ratio is the same by either law.
    if case.model.is_momentum() || matches!(case.collision.impulse_ratio, ImpulseRatio::Given(_)) {
        return None;
    }
    let (law, name) = match case.collision.law {
        Law::Brach => (Law::KudlichSlibar, "Kudlich-Slibar"),
        _ => (Law::Brach, "Brach"),
    };
    let case = case.with_law(law);
    let solution = case.impact().map(|impact| Box::new(Solution::of(&case, &impact)));
    Some(OtherLaw { name, solution })
}

fn formulas(case: &Case, verb: ReportVerb, control: &dyn Control) -> Vec<Formula> {
    if case.model.is_momentum() || matches!(verb, ReportVerb::Crush | ReportVerb::Crash3) {
        return Vec::new();
    }
    let kind = formula::Kind::of(&case.collision);
    let of = |output: Output| {
        formula::formula((verb == ReportVerb::Solve).then_some(case), &formula::Options { output, wrt: None, kind }, control).ok()
    };
    [Output::CriticalImpulseRatio, Output::Loss].into_iter().filter_map(of).collect()
}
