//! The JSON document of `reconstruct`, in SI.

use planar_impact::reconstruct::{Bound, Estimate, Fitted, Solution, Verdict};
use serde::Serialize;

use super::{Reconstructed, diagnostics, wording};
use crate::crash3::document::Body;
use crate::named::{Named, plain};
use crate::solution;

/// The document.
#[derive(Serialize)]
pub struct Document<'a> {
    schema: u32,
    title: &'a str,
    verdict: &'static str,
    /// Whether a search came to its end; one that does not prints nothing.
    converged: bool,
    iterations: usize,
    unknown: Named<Unknown>,
    /// `null` where an unknown has no standard deviation.
    covariance: Named<Named<Option<f64>>>,
    correlation: Named<Named<Option<f64>>>,
    evidence: Named<Evidence>,
    /// What is known of unknowns beforehand, beside what was found.
    #[serde(skip_serializing_if = "Option::is_none")]
    priors: Option<Named<Evidence>>,
    /// How each unknown moves per unit of each piece of evidence.
    influence: Named<Named<f64>>,
    chi_square: f64,
    degrees_of_freedom: usize,
    probability: f64,
    /// What the evidence says as good as nothing of.
    hardly_determined: Vec<&'static str>,
    not_determined: Vec<String>,
    /// Every solution that the evidence agrees with; more than one only where it cannot tell them apart.
    solutions: Vec<Alternative>,
    /// Least sums of squares that the evidence tells from the best.
    worse: Vec<Alternative>,
    /// What the evidence asks for where the bounds exclude it.
    without_bounds: Option<Alternative>,
    searches: usize,
    searches_converged: usize,
    seed: u64,
    diagnostics: Vec<diagnostics::Document>,
    crash3: Option<Body<'a>>,
    /// `null` where the evidence leaves an unknown open.
    solution: Option<solution::Solution>,
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    notes: &'a [String],
}

#[derive(Serialize)]
struct Unknown {
    /// `null` where the evidence does not determine it.
    value: Option<f64>,
    sd: Option<f64>,
    at_bound: Option<&'static str>,
}

#[derive(Serialize)]
struct Evidence {
    given: f64,
    computed: f64,
    sd: Option<f64>,
    standardised_residual: Option<f64>,
}

/// A solution beside others.
#[derive(Serialize)]
struct Alternative {
    unknown: Named<f64>,
    chi_square: f64,
    degrees_of_freedom: usize,
    probability: f64,
    /// How many searches ended there.
    searches: usize,
}

impl<'a> Document<'a> {
    pub fn of(result: &'a Reconstructed) -> Self {
        let (answer, best) = (&result.answer, result.answer.best());
        let names: Vec<&'static str> = best.unknowns.iter().map(|estimate| estimate.of.name()).collect();
        let has_spread = |i: usize| best.unknowns[i].sd.is_some() || best.unknowns[i].at.is_some();
        let matrix = |entry: &dyn Fn(usize, usize) -> Option<f64>| {
            let row = |i: usize| (0..names.len()).map(|k| (names[k], entry(i, k).filter(|_| has_spread(i) && has_spread(k)))).collect();
            (0..names.len()).map(|i| (names[i], row(i))).collect()
        };
        let is_agreed = matches!(answer.verdict, Verdict::Agrees | Verdict::SeveralSolutions);
        Document {
            schema: 1,
            title: &result.question.case.title,
            verdict: result.verdict().name(),
            converged: true,
            iterations: best.iterations,
            unknown: best.unknowns.iter().map(|estimate| (estimate.of.name(), Unknown::of(estimate))).collect(),
            covariance: matrix(&|i, k| Some(plain(best.covariance.get(i, k)))),
            correlation: matrix(&|i, k| best.covariance.correlation(i, k)),
            evidence: evidence(result),
            priors: (!best.priors.is_empty()).then(|| best.priors.iter().map(Evidence::named).collect()),
            influence: influence(best),
            chi_square: best.chi_square,
            degrees_of_freedom: best.degrees_of_freedom,
            probability: best.probability,
            hardly_determined: best.hardly_determined(&result.question.asked).into_iter().map(|of| of.name()).collect(),
            not_determined: answer.not_determined.iter().map(|direction| wording::direction_in_si(direction, &result.solved)).collect(),
            solutions: if is_agreed { answer.solutions.iter().map(Alternative::of).collect() } else { Vec::new() },
            worse: answer.worse.iter().map(Alternative::of).collect(),
            without_bounds: answer.without_bounds.as_deref().map(Alternative::of),
            searches: answer.searches,
            searches_converged: answer.converged,
            seed: result.search.seed,
            diagnostics: result.findings.iter().map(diagnostics::Document::of).collect(),
            crash3: result.crash3.as_ref().map(|comparison| Body::of(&result.solved, comparison)),
            solution: result.has_solution().then(|| solution::Solution::of(&result.solved, &best.impact, None, Vec::new())),
            notes: &result.notes,
        }
    }
}

/// What was weighed, and what stands in the case as the evidence has it.
fn evidence(result: &Reconstructed) -> Named<Evidence> {
    let certain = result.question.certain.iter().map(|evidence| {
        let value = plain(evidence.value);
        (evidence.of.name(), Evidence { given: value, computed: value, sd: None, standardised_residual: None })
    });
    result.answer.best().evidence.iter().map(Evidence::named).chain(certain).collect()
}

/// The pieces of evidence, then the priors, each named as one.
fn influence(best: &Solution) -> Named<Named<f64>> {
    let names = || {
        let priors = best.priors.iter().map(|prior| format!("prior of {}", prior.of.name()));
        best.evidence.iter().map(|fitted| fitted.of.name().to_owned()).chain(priors)
    };
    let row = |(estimate, row): (&Estimate, &Vec<f64>)| {
        let moves = if estimate.is_determined { row.iter().copied().map(plain).collect() } else { vec![f64::NAN; row.len()] };
        (estimate.of.name(), names().zip(moves).collect())
    };
    best.unknowns.iter().zip(&best.influence).map(row).collect()
}

impl Unknown {
    fn of(estimate: &Estimate) -> Self {
        Unknown {
            value: estimate.is_determined.then_some(plain(estimate.value)),
            sd: estimate.sd,
            at_bound: estimate.at.map(|bound| match bound {
                Bound::Min => "min",
                Bound::Max => "max",
            }),
        }
    }
}

impl Evidence {
    fn named(fitted: &Fitted) -> (&'static str, Self) {
        let evidence = Evidence {
            given: plain(fitted.given),
            computed: plain(fitted.computed),
            sd: fitted.sd,
            standardised_residual: fitted.standardised_residual().map(plain),
        };
        (fitted.of.name(), evidence)
    }
}

impl Alternative {
    fn of(solution: &Solution) -> Self {
        Alternative {
            unknown: solution.unknowns.iter().map(|estimate| (estimate.of.name(), plain(estimate.value))).collect(),
            chi_square: solution.chi_square,
            degrees_of_freedom: solution.degrees_of_freedom,
            probability: solution.probability,
            searches: solution.searches,
        }
    }
}
