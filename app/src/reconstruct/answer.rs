//! The answer of `reconstruct`.

use planar_impact::reconstruct::{Bound, Direction, Estimate, Fitted, Limit, Measurand, Method, Search, Solution, Variable, Verdict};
use schemars::JsonSchema;
use serde::Serialize;

use super::diagnostics::Diagnostic;
use super::from_rest::SeparationFromRest;
use super::guaranteed::Guaranteed;
use super::posterior::{Drawn, Draws, Posterior};
use super::question::{Question, measure_in, measure_of, name_in};
use crate::answer::Answer;
use crate::case::Case;
use crate::crash3::Comparison;
use crate::named::{Named, positive_zero};
use crate::notice::{Notice, Notices};
use crate::scene::Scene;
use crate::solve;
use crate::units::Measure;
use crate::units::trim;

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
    /// Given minus computed, in standard deviations.
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

/// A solved question with results derived from its best solution.
pub(super) struct Solved<'a> {
    pub(super) question: &'a Question,
    pub(super) answer: &'a planar_impact::reconstruct::Answer,
    /// The impact of the best solution.
    pub(super) impact: planar_impact::Impact,
    /// Those of the unknowns, then those of what follows from them.
    pub(super) intervals: Vec<planar_impact::reconstruct::Interval>,
    /// Their level of confidence.
    pub(super) level: f64,
    /// Intervals of the same at the heights of a profile, if it is asked for.
    pub(super) profile: Option<Vec<Height>>,
    /// Guaranteed ranges, if they are asked for, and the standard deviations that they take.
    pub(super) guaranteed: (Vec<planar_impact::reconstruct::GuaranteedRange>, f64),
    pub(super) search: Search,
    /// The case with the values of the best solution.
    pub(super) case: &'a Case,
    pub(super) diagnostics: Vec<Diagnostic>,
    pub(super) crash3: Option<Comparison>,
    /// What is drawn from the posterior, if it is asked for.
    pub(super) drawn: Option<Drawn>,
}

/// The intervals at a height of the profile.
pub(super) struct Height {
    /// Chi-square above the least one.
    pub(super) chi_square: f64,
    pub(super) level: f64,
    pub(super) intervals: Vec<planar_impact::reconstruct::Interval>,
}

/// Returns an end of an interval; `None` if nothing limits it.
fn end(value: f64) -> Option<f64> {
    value.is_finite().then(|| positive_zero(value))
}

impl Solved<'_> {
    /// Returns the overall verdict. Evidence contradicts itself too if no slide comes past the points along its path.
    fn verdict(&self) -> Verdict {
        match self.answer.verdict {
            Verdict::Agrees | Verdict::SeveralSolutions if self.question.separations.iter().any(SeparationFromRest::is_contradicted) => {
                Verdict::Contradicted
            }
            verdict => verdict,
        }
    }

    #[allow(deprecated)]
    pub(super) fn reconstruction(self) -> Reconstruction {
        let (answer, best) = (self.answer, self.answer.best());
        let name = |of: Variable| name_in(of, self.case);
        let names: Vec<String> = best.unknowns.iter().map(|estimate| name(estimate.of)).collect();
        let has_spread = |i: usize| best.unknowns[i].sd.is_some() || best.unknowns[i].at.is_some();
        let matrix = |entry: &dyn Fn(usize, usize) -> Option<f64>| {
            let row =
                |i: usize| (0..names.len()).map(|k| (names[k].clone(), entry(i, k).filter(|_| has_spread(i) && has_spread(k)))).collect();
            (0..names.len()).map(|i| (names[i].clone(), row(i))).collect()
        };
        let is_agreed = matches!(answer.verdict, Verdict::Agrees | Verdict::SeveralSolutions);
        let weakly_determined: Vec<_> = best.hardly_determined(&self.question.asked).into_iter().map(name).collect();
        let other_minima: Vec<Alternative> = answer.worse.iter().map(|worse| self.alternative(worse)).collect();
        Reconstruction {
            verdict: self.verdict().name(),
            status: self.verdict(),
            is_answer: self.is_answer(),
            other_separations: false,
            separations: self.question.separations.clone(),
            by_other_separations: Vec::new(),
            converged: true,
            iterations: best.iterations,
            unknown: best.unknowns.iter().map(|estimate| (name(estimate.of), self.unknown(estimate))).collect(),
            derived: self.derived(),
            posterior: self.drawn.as_ref().map(|drawn| drawn.draws.clone()),
            probabilities: self.drawn.as_ref().map(|drawn| drawn.probabilities.clone()).filter(|statements| !statements.is_empty()),
            covariance: matrix(&|i, k| Some(positive_zero(best.covariance.get(i, k)))),
            correlation: matrix(&|i, k| best.covariance.correlation(i, k)),
            evidence: self.evidence(),
            priors: (!best.priors.is_empty()).then(|| best.priors.iter().map(|prior| self.named(prior)).collect()),
            furthest_off: self.furthest_off(),
            influence: self.influence(best),
            chi_square: best.chi_square,
            degrees_of_freedom: best.degrees_of_freedom,
            probability: best.probability,
            hardly_determined: weakly_determined.clone(),
            weakly_determined,
            limits: best.limits.iter().map(|limit| limit.name()).collect(),
            not_determined: answer.not_determined.iter().map(|direction| in_words(direction, self.case)).collect(),
            open_directions: answer
                .not_determined
                .iter()
                .map(|direction| direction.parts.iter().map(|(of, by)| (name(*of), *by)).collect())
                .collect(),
            solutions: if is_agreed { answer.solutions.iter().map(|solution| self.alternative(solution)).collect() } else { Vec::new() },
            worse: other_minima.clone(),
            other_minima,
            without_bounds: answer.without_bounds.as_deref().map(|free| self.alternative(free)),
            starts: self.search.starts,
            searches: answer.searches,
            searches_converged: answer.converged,
            searches_at_solutions: answer.solutions.iter().map(|solution| solution.searches).collect(),
            seed: self.search.seed,
            diagnostics: self.diagnostics.clone(),
            crash3: self.crash3.clone(),
            solution: (answer.verdict != Verdict::Undetermined)
                .then(|| Answer::new(&self.case.title, solve::Solution::of(self.case, &self.impact), Notices::default())),
            scene: None,
            impulse_ratio_is_fraction: matches!(self.case.collision.impulse_ratio, planar_impact::ImpulseRatio::OfCritical(_)),
        }
    }

    fn unknown(&self, estimate: &Estimate) -> Unknown {
        let asked = self.question.asked.unknowns.iter().find(|unknown| unknown.of == estimate.of);
        let (min, max) = asked.map_or((None, None), |unknown| (unknown.min, unknown.max));
        Unknown {
            value: estimate.is_determined.then_some(positive_zero(estimate.value)),
            sd: estimate.sd,
            at_bound: estimate.at.map(bound_name),
            interval: self.interval(Measurand::Variable(estimate.of)).map_or_else(|| self.unlimited(), |interval| self.printed(interval)),
            profile: self.profile(Measurand::Variable(estimate.of)),
            posterior: self.posterior(Measurand::Variable(estimate.of)),
            guaranteed: self.guaranteed(estimate.of),
            min,
            max,
            is_input: self.question.inputs.contains(&estimate.of),
            measure: measure_in(estimate.of, self.case),
        }
    }

    fn posterior(&self, of: Measurand) -> Option<Posterior> {
        self.drawn.as_ref()?.posterior(of)
    }

    fn guaranteed(&self, of: Variable) -> Option<Guaranteed> {
        let (ranges, bounds_sd) = &self.guaranteed;
        let range = ranges.iter().find(|range| range.of == of)?;
        Some(Guaranteed::of(range, *bounds_sd, self.question))
    }

    fn interval(&self, of: Measurand) -> Option<&planar_impact::reconstruct::Interval> {
        self.intervals.iter().find(|interval| interval.of == of)
    }

    fn profile(&self, of: Measurand) -> Option<Vec<ProfileLevel>> {
        let level = |height: &Height| {
            let interval = height.intervals.iter().find(|interval| interval.of == of)?;
            let Height { chi_square, level, .. } = *height;
            Some(ProfileLevel { chi_square, level, low: end(interval.low), high: end(interval.high) })
        };
        Some(self.profile.as_ref()?.iter().filter_map(level).collect())
    }

    fn printed(&self, interval: &planar_impact::reconstruct::Interval) -> Interval {
        let limit = |limit: Option<Limit>| {
            limit.map(|limit| match limit {
                Limit::Bound(of, bound) => format!("{} {}", name_in(of, self.case), bound_name(bound)),
                other => other.name(),
            })
        };
        Interval {
            level: interval.level,
            low: end(interval.low),
            high: end(interval.high),
            method: interval.method.name(),
            low_limited_by: limit(interval.low_limited_by),
            high_limited_by: limit(interval.high_limited_by),
            narrows: interval.narrows,
        }
    }

    /// Returns an interval without ends, that of which nothing is known.
    fn unlimited(&self) -> Interval {
        let (low, high, low_limited_by, high_limited_by) = (None, None, None, None);
        Interval { level: self.level, low, high, method: Method::Profile.name(), low_limited_by, high_limited_by, narrows: false }
    }

    fn derived(&self) -> Named<Derived> {
        let is_open = self.answer.verdict == Verdict::Undetermined;
        let of_interval = |interval: &planar_impact::reconstruct::Interval| {
            let derived = Derived {
                value: (!is_open).then(|| positive_zero(interval.value)),
                sd: interval.sd.filter(|_| !is_open),
                interval: self.printed(interval),
                profile: self.profile(interval.of),
                posterior: self.posterior(interval.of),
                measure: measure_of(interval.of, self.case),
            };
            (interval.of.name(), derived)
        };
        self.intervals.iter().filter(|interval| !matches!(interval.of, Measurand::Variable(_))).map(of_interval).collect()
    }

    /// Returns `true` if there is one solution with an interval narrower than the bounds of each unknown.
    fn is_answer(&self) -> bool {
        let narrows = |estimate: &Estimate| self.interval(Measurand::Variable(estimate.of)).is_some_and(|interval| interval.narrows);
        let mut asked = self.answer.best().unknowns.iter().filter(|estimate| !self.question.inputs.contains(&estimate.of));
        self.verdict() == Verdict::Agrees && asked.all(narrows)
    }

    fn alternative(&self, solution: &Solution) -> Alternative {
        Alternative {
            unknown: solution.unknowns.iter().map(|estimate| (name_in(estimate.of, self.case), positive_zero(estimate.value))).collect(),
            sd: solution.unknowns.iter().map(|estimate| (name_in(estimate.of, self.case), estimate.sd)).collect(),
            chi_square: solution.chi_square,
            degrees_of_freedom: solution.degrees_of_freedom,
            probability: solution.probability,
            searches: solution.searches,
        }
    }

    /// Returns the influence of the pieces of evidence, then of the priors, on each unknown.
    fn influence(&self, best: &Solution) -> Named<Named<f64>> {
        let names = || {
            let priors = best.priors.iter().map(|prior| format!("prior of {}", prior.of.name()));
            best.evidence.iter().map(|fitted| fitted.of.name().to_owned()).chain(priors)
        };
        let row = |(estimate, row): (&Estimate, &Vec<f64>)| {
            let moves = if estimate.is_determined { row.iter().copied().map(positive_zero).collect() } else { vec![f64::NAN; row.len()] };
            (name_in(estimate.of, self.case), names().zip(moves).collect())
        };
        best.unknowns.iter().zip(&best.influence).map(row).collect()
    }

    fn named(&self, fitted: &Fitted) -> (&'static str, Evidence) {
        let evidence = Evidence {
            given: positive_zero(fitted.given),
            computed: positive_zero(fitted.computed),
            sd: fitted.sd,
            standardised_residual: fitted.standardised_residual().map(positive_zero),
            measure: measure_of(fitted.of, self.case),
        };
        (fitted.of.name(), evidence)
    }

    /// Returns the evidence of the fit, and the exact evidence whose values are set in the case.
    fn evidence(&self) -> Named<Evidence> {
        let certain = self.question.certain.iter().map(|evidence| {
            let value = positive_zero(evidence.value);
            let measure = measure_of(evidence.of, self.case);
            (evidence.of.name(), Evidence { given: value, computed: value, sd: None, standardised_residual: None, measure })
        });
        self.answer.best().evidence.iter().map(|fitted| self.named(fitted)).chain(certain).collect()
    }

    fn furthest_off(&self) -> Option<FurthestOff> {
        let best = self.answer.best();
        /// Residual of exact evidence, as a fit weighs it, that is none.
        const MET: f64 = 1.0;
        let off = |fitted: &Fitted| fitted.weighed_residual().abs();
        let all = best.evidence.iter().chain(&best.priors).filter(|fitted| fitted.sd.is_some() || off(fitted) > MET);
        let (name, evidence) = self.named(all.max_by(|one, other| off(one).total_cmp(&off(other)))?);
        Some(FurthestOff { name, evidence })
    }
}

/// Describes how unknowns can change together without contradicting the evidence: `vehicle.1.speed by 1 m/s with
/// vehicle.2.speed by -1 m/s`.
fn in_words(direction: &Direction, case: &Case) -> String {
    let part = |(of, by): &(Variable, f64)| {
        format!("{} by {} {}", name_in(*of, case), trim(*by), measure_in(*of, case).si_unit()).trim_end().to_owned()
    };
    direction.parts.iter().map(part).collect::<Vec<_>>().join(" with ")
}

fn bound_name(bound: Bound) -> &'static str {
    match bound {
        Bound::Min => "min",
        Bound::Max => "max",
    }
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
        /// Probability below which evidence contradicts itself.
        const BY_CHANCE: f64 = 0.001;
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
