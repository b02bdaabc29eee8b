//! The answer of `reconstruct`.

use planar_impact::reconstruct::Verdict;
use schemars::JsonSchema;
use serde::Serialize;

use super::diagnostics::Diagnostic;
use super::from_rest::{BY_CHANCE, SeparationFromRest};
use super::guaranteed::Guaranteed;
use super::posterior::{Draws, Posterior};
use crate::answer::Answer;
use crate::crash3::Comparison;
use crate::named::Named;
use crate::notice::Notice;
use crate::scene::Scene;
use crate::solve;
use crate::units::Measure;

/// A collision found from evidence, in SI and radians.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Reconstruction {
    /// `agrees`, `several solutions`, `undetermined`, `contradicted` or `bounds exclude`.
    pub verdict: &'static str,
    /// `true` if other separations, which lead to the same rest positions, agree with the evidence too.
    pub other_separations: bool,
    /// The separations that are used, from rest positions and points along the paths; left out without `[rest]`.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    #[schemars(default)]
    pub separations: Vec<SeparationFromRest>,
    /// The answers from the other separations that lead to the same rest positions, the best first.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    #[schemars(default)]
    pub by_other_separations: Vec<Reconstruction>,
    /// `true` if a search converged; otherwise there is no answer.
    pub converged: bool,
    /// Number of steps of the search that found the best solution.
    pub iterations: usize,
    /// The unknowns.
    pub unknown: Named<Unknown>,
    /// What follows from the unknowns and is asked for most: ΔV and principal direction of force of each vehicle, closing speed, energies, impulse ratio, and
    /// equivalent energy speed of each vehicle where its share of the crush energy is known.
    pub derived: Named<Derived>,
    /// Draws from the posterior, on request.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub posterior: Option<Draws>,
    /// The probability of each statement of the call.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub probabilities: Option<Named<f64>>,
    /// Covariance of the unknowns; `null` where an unknown has no standard deviation.
    pub covariance: Named<Named<Option<f64>>>,
    /// Correlation of the unknowns.
    pub correlation: Named<Named<Option<f64>>>,
    /// The evidence, compared with the best solution.
    pub evidence: Named<Evidence>,
    /// Prior values of unknowns, compared with the best solution.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub priors: Option<Named<Evidence>>,
    /// The piece of evidence, or the prior, with the largest standardised residual in the best solution; `null` if all are exact.
    pub furthest_off: Option<FurthestOff>,
    /// Change of each unknown per unit of each piece of evidence; `null` if the unknown is not determined.
    #[schemars(with = "Named<Named<Option<f64>>>")]
    pub influence: Named<Named<f64>>,
    /// Sum of the squares of the standardised residuals.
    pub chi_square: f64,
    /// Number of pieces of evidence minus number of unknowns.
    pub degrees_of_freedom: usize,
    /// Probability that chi-square is larger by chance.
    pub probability: f64,
    /// Unknowns that the evidence barely constrains.
    pub weakly_determined: Vec<String>,
    /// Deprecated name of `weakly_determined`.
    #[deprecated]
    pub hardly_determined: Vec<String>,
    /// The limits of the physics that the best solution lies on, by the code of the refusal beyond them.
    pub limits: Vec<String>,
    /// Combinations of unknowns that the evidence does not constrain, in words.
    pub not_determined: Vec<String>,
    /// The same as numbers: the change of each unknown along the combination.
    pub open_directions: Vec<Named<f64>>,
    /// Every solution that fits the evidence; several only if the evidence cannot distinguish them.
    pub solutions: Vec<Alternative>,
    /// Other minima of chi-square, which the evidence distinguishes from the best one.
    pub other_minima: Vec<Alternative>,
    /// Deprecated name of `other_minima`.
    #[deprecated]
    pub worse: Vec<Alternative>,
    /// The best fit without bounds, if it lies outside the bounds.
    pub without_bounds: Option<Alternative>,
    /// Maximum number of starts.
    pub starts: usize,
    /// Number of searches.
    pub searches: usize,
    /// Number of searches that converged.
    pub searches_converged: usize,
    /// Number of searches that ended at each solution, the best first.
    pub searches_at_solutions: Vec<usize>,
    /// The seed of the starts.
    pub seed: u64,
    /// Diagnostics of the best solution: what users of crash programs ask next.
    pub diagnostics: Vec<Diagnostic>,
    /// CRASH3 results from the same evidence.
    pub crash3: Option<Comparison>,
    /// The collision of the best solution; `null` where the evidence leaves an unknown open.
    pub solution: Option<Answer<solve::Solution>>,
    /// `true` if `contact.impulse_ratio` is the fraction of the critical ratio, as the case gives it.
    pub impulse_ratio_is_fraction: bool,
    /// The scene of the best solution, with what to know about its drawing; `None` where the evidence leaves an unknown open.
    #[serde(skip)]
    pub scene: Option<(Scene, Vec<Notice>)>,
    /// The verdict of the library.
    #[serde(skip)]
    pub status: Verdict,
    /// `true` if there is one solution, the evidence agrees with it, and it narrows every unknown down.
    #[serde(skip)]
    pub is_answer: bool,
}

/// An unknown in the best solution.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Unknown {
    /// Its value; `null` if the evidence does not determine it.
    pub value: Option<f64>,
    /// Its standard deviation; `null` if there is none, as with exact evidence or at a bound.
    pub sd: Option<f64>,
    /// `min` or `max` if it lies on a bound.
    pub at_bound: Option<&'static str>,
    /// The range that the evidence, all bounds and the physics allow; without ends if none could be found.
    pub interval: Interval,
    /// The profile of the likelihood, outwards, on request.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub profile: Option<Vec<ProfileLevel>>,
    /// Its posterior, on request.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub posterior: Option<Posterior>,
    /// Its guaranteed range, on request.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub guaranteed: Option<Guaranteed>,
    /// Its lower bound in the file.
    pub min: Option<f64>,
    /// Its upper bound in the file.
    pub max: Option<f64>,
    /// `true` if it is an uncertain input of a vehicle or of the contact, and not listed under `[unknown]`.
    pub is_input: bool,
    /// Its measure.
    #[serde(skip)]
    pub measure: Measure,
}

/// What follows from the unknowns, in the best solution.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Derived {
    /// Its value; `null` if the evidence leaves an unknown open.
    pub value: Option<f64>,
    /// Its standard deviation, from those of the unknowns; `null` if one of them has none.
    pub sd: Option<f64>,
    /// The range that the evidence, all bounds and the physics allow.
    pub interval: Interval,
    /// The profile of the likelihood, outwards, on request.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub profile: Option<Vec<ProfileLevel>>,
    /// Its posterior, on request.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub posterior: Option<Posterior>,
    /// Its measure.
    #[serde(skip)]
    pub measure: Measure,
}

/// An interval of an unknown, or of what follows from the unknowns.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Interval {
    /// The probability with which such intervals contain the true value.
    pub level: f64,
    /// Its lower end; `null` if nothing limits it.
    pub low: Option<f64>,
    /// Its upper end; `null` if nothing limits it.
    pub high: Option<f64>,
    /// `profile`: the range over which the best fit of everything else stays within a quantile of chi-square of the least one.
    pub method: &'static str,
    /// The bound of another unknown, or the limit of the physics, that makes the lower end; `null` if the evidence does.
    pub low_limited_by: Option<String>,
    /// The same of the upper end.
    pub high_limited_by: Option<String>,
    /// `true` if it is narrower than the range that the bounds of the quantity alone allow, or than a whole turn.
    pub narrows: bool,
}

/// The values at which the profile of the likelihood reaches a height.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct ProfileLevel {
    /// Its height: chi-square of the best fit of everything else, above the least one.
    pub chi_square: f64,
    /// The level of confidence of the interval between the two.
    pub level: f64,
    /// The value below the best one; `null` if nothing limits it. A bound or a limit of the physics has one value for all heights beyond.
    pub low: Option<f64>,
    /// The same above it.
    pub high: Option<f64>,
}

/// A piece of evidence compared with a solution.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Evidence {
    /// Its value in the file.
    pub given: f64,
    /// Its value in the solution.
    pub computed: f64,
    /// Its standard deviation; `null` if it is exact.
    pub sd: Option<f64>,
    /// Given minus computed, in standard deviations. Of separations from rest on locked wheels what the ways differ by.
    pub standardised_residual: Option<f64>,
    /// Its measure.
    #[serde(skip)]
    pub measure: Measure,
}

/// The piece of evidence, or the prior, with the largest standardised residual.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct FurthestOff {
    /// Its name.
    pub name: &'static str,
    /// The piece itself.
    #[serde(flatten)]
    pub evidence: Evidence,
}

/// One of several solutions.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Alternative {
    /// The unknowns.
    pub unknown: Named<f64>,
    /// Their standard deviations.
    pub sd: Named<Option<f64>>,
    /// Its chi-square.
    pub chi_square: f64,
    /// Number of pieces of evidence minus number of unknowns.
    pub degrees_of_freedom: usize,
    /// Probability that chi-square is larger by chance.
    pub probability: f64,
    /// Number of searches that ended there.
    pub searches: usize,
}

/// Effect of a piece of evidence on an unknown.
#[derive(Clone, Debug, PartialEq)]
pub struct Influence<'a> {
    /// The piece of evidence, or `prior of` an unknown.
    pub piece: &'a str,
    /// The measure of the piece.
    pub measure: Measure,
    /// The standard deviation of the piece.
    pub sd: f64,
    /// The change of the unknown if the piece increases by its standard deviation.
    pub change: f64,
}

impl Reconstruction {
    /// Largest excess of χ² over that of the best at which another separation is an alternative: by chance it is exceeded in one case of a thousand.
    const NEARLY_AS_GOOD: f64 = 10.83;

    /// Returns χ² of the evidence and of the slides that lead to it.
    pub fn total_chi_square(&self) -> f64 {
        self.chi_square + self.separations.iter().map(SeparationFromRest::chi_square).sum::<f64>()
    }

    /// Returns `true` if points along a path contradict the rest position, while the rest of the evidence agrees.
    pub fn is_contradicted_by_path(&self) -> bool {
        self.probability >= BY_CHANCE && self.separations.iter().any(SeparationFromRest::is_contradicted)
    }

    /// Adds the answers from other separations. If one of them agrees as well, the solution is one of several.
    pub(super) fn with_others(mut self, others: Vec<Reconstruction>) -> Self {
        let limit = self.total_chi_square() + Self::NEARLY_AS_GOOD;
        let agrees = |other: &Reconstruction| !matches!(other.status, Verdict::Contradicted | Verdict::BoundsExclude);
        self.other_separations = others.iter().any(|other| agrees(other) && other.total_chi_square() <= limit);
        if self.other_separations && self.status == Verdict::Agrees {
            (self.status, self.verdict, self.is_answer) = (Verdict::SeveralSolutions, Verdict::SeveralSolutions.name(), false);
        }
        self.by_other_separations = others;
        self
    }

    /// Returns the names of the unknowns whose range the evidence leaves as wide as their bounds.
    pub fn not_narrowed(&self) -> impl Iterator<Item = &str> {
        self.unknown.iter().filter(|(_, unknown)| !unknown.is_input && !unknown.interval.narrows).map(|(name, _)| name)
    }

    /// Returns `true` if the best solution is an answer or the best fit to inconsistent evidence, not one of many.
    pub fn has_solution(&self) -> bool {
        self.solution.is_some()
    }

    /// Returns `true` if any evidence is uncertain, so that the uncertainty of unknowns is known.
    pub fn has_uncertainty(&self) -> bool {
        let all = self.evidence.iter().chain(self.priors.iter().flat_map(Named::iter));
        all.into_iter().any(|(_, evidence)| evidence.sd.is_some_and(|sd| sd > 0.0))
    }

    /// Returns the pieces of evidence that an unknown depends on most, the largest change first, without those below a thousandth of it.
    pub fn influences(&self, unknown: &str) -> Vec<Influence<'_>> {
        let pieces = self.evidence.iter().filter(|(name, _)| self.is_weighed(name));
        let all = pieces.chain(self.priors.iter().flat_map(Named::iter));
        let Some(row) = self.influence.get(unknown) else { return Vec::new() };
        let mut found: Vec<Influence<'_>> = row
            .iter()
            .zip(all)
            .filter_map(|((piece, by), (_, evidence))| {
                evidence.sd.map(|sd| Influence { piece, measure: evidence.measure, sd, change: by * sd })
            })
            .collect();
        found.sort_by(|one, other| other.change.abs().total_cmp(&one.change.abs()));
        let greatest = found.first().map_or(0.0, |first| first.change.abs());
        found.retain(|influence| influence.change.abs() > 1e-3 * greatest);
        found
    }

    /// Returns `true` if a piece of evidence takes part in the fit; the value of any other is set in the case.
    pub fn is_weighed(&self, name: &str) -> bool {
        self.influence.iter().next().is_some_and(|(_, row)| row.get(name).is_some())
    }
}
