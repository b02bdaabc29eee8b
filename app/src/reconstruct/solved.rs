//! Makes the answer of `reconstruct` from what was solved.

use planar_impact::reconstruct::{Bound, Direction, Estimate, Fitted, Limit, Measurand, Method, Search, Solution, Variable, Verdict};

use super::answer::{Alternative, Derived, Evidence, FurthestOff, Interval, ProfileLevel, Reconstruction, Unknown};
use super::diagnostics::Diagnostic;
use super::from_rest::SeparationFromRest;
use super::guaranteed::Guaranteed;
use super::posterior::{Drawn, Posterior};
use super::question::{Question, measure_in, measure_of, name_in};
use crate::answer::Answer;
use crate::case::Case;
use crate::crash3::Comparison;
use crate::named::{Named, positive_zero};
use crate::notice::Notices;
use crate::solve;
use crate::units::trim;

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
            solution: answer
                .is_one()
                .then(|| Answer::new(&self.case.title, solve::Solution::of(self.case, &self.impact), Notices::default())),
            scene: None,
            impulse_ratio_is_fraction: matches!(self.case.collision.impulse_ratio, planar_impact::ImpulseRatio::OfCritical(_)),
        }
    }

    fn unknown(&self, estimate: &Estimate) -> Unknown {
        let given = self.question.case.knowledge.unknowns.iter().find(|unknown| unknown.of == estimate.of);
        let asked = self.question.asked.unknowns.iter().find(|unknown| unknown.of == estimate.of);
        let of_asked = || asked.map_or((None, None), |unknown| (unknown.min, unknown.max));
        let (min, max) = given.map_or_else(of_asked, |given| (given.min, given.max));
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
        let is_open = !self.answer.is_one();
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
