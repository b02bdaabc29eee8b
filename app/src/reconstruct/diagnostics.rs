//! Diagnostics of a reconstruction, which answer what users of crash programs ask next.

use planar_impact::reconstruct::Solution;
use planar_impact::reconstruct::diagnosis::{Damage, Figure, Finding, Limit, Reading};
use schemars::JsonSchema;
use serde::Serialize;

use super::question::Question;
use crate::case::{Case, Crush};

/// A figure of the best solution compared with what crash tests and programs lead one to expect, in SI.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Diagnostic {
    /// Its subject.
    pub name: &'static str,
    /// Position of the figure relative to its limit.
    pub reading: Status,
    /// The figure; `null` if there is nothing to compare.
    pub figure: Option<f64>,
    /// Its expected limit.
    pub limit: Range,
    /// Source of the limit.
    pub source: &'static str,
    /// Interpretation of the figure.
    pub meaning: String,
    /// The same, with the kinds of its figures.
    #[serde(skip)]
    pub finding: Finding,
}

/// Position of a figure relative to its limit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, JsonSchema)]
pub enum Status {
    /// Within it.
    #[serde(rename = "within")]
    Within,
    /// Outside it.
    #[serde(rename = "outside")]
    Outside,
    /// There is nothing to compare.
    #[serde(rename = "not checked")]
    NotChecked,
}

/// The expected range of a figure: `at_most` a number, `between` two numbers, or `same_sign` as the value that it is compared with.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Range {
    /// At most this.
    AtMost(f64),
    /// From the first to the second.
    Between(f64, f64),
    /// The sign of the value that it is compared with.
    SameSign,
}

/// Computes the diagnostics of the best solution.
pub fn of(question: &Question, solved: &Case, best: &Solution) -> Vec<Diagnostic> {
    let damage = solved.setup.crush.each_ref().map(|crush| crush.as_ref().map(damage));
    best.diagnose(&question.asked, &damage).into_iter().map(Diagnostic::of).collect()
}

fn damage(crush: &Crush) -> Damage {
    let damage = Damage { force_direction: crush.force_direction, ..Damage::of(&crush.profile, &crush.zones) };
    match crush.saturation {
        Some(_) => damage.saturated(crush.energy()),
        None => damage,
    }
}

impl Diagnostic {
    fn of(finding: Finding) -> Self {
        Diagnostic {
            name: finding.question.name(),
            reading: match finding.reading {
                Reading::Within => Status::Within,
                Reading::Outside => Status::Outside,
                Reading::NotChecked => Status::NotChecked,
            },
            figure: finding.figure.map(Figure::value),
            limit: match finding.limit {
                Limit::AtMost(most) => Range::AtMost(most.value()),
                Limit::Between(least, most) => Range::Between(least.value(), most.value()),
                Limit::SameSign => Range::SameSign,
            },
            source: finding.source,
            meaning: finding.meaning.to_string(),
            finding,
        }
    }
}
