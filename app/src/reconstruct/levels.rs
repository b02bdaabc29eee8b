//! What a level of confidence asks of standard deviations, and they do not have.

use planar_impact::Distribution;
use planar_impact::reconstruct::{Evidence, Interval, Uncertainty};

use super::question::{Question, name_of};
use crate::case::{Case, UncertainInput};
use crate::notice::Notice;
use crate::units::trim;

/// The level for which standard deviations of few measurements are widened.
const USUAL: f64 = 0.95;

/// Warns of inputs that few measurements or tests tell, whose tails a normal distribution lacks at a higher level.
pub(super) fn of_few(case: &Case, level: f64) -> Option<Notice> {
    let mut of: Vec<&str> = case.uncertain.inputs.iter().filter(|input| input.has_tails()).map(|input| input.key.as_str()).collect();
    of.dedup();
    let message = || {
        format!(
            "few measurements or tests tell {}, and a normal distribution has the tails of what they leave open to {} % only: intervals of {} % are too narrow",
            of.join(", "),
            trim(100.0 * USUAL),
            trim(100.0 * level)
        )
    };
    (level > USUAL && !of.is_empty()).then(|| Notice::warning("level-beyond-tests", of[0], message()))
}

/// Warns of readings of a resolution and of inputs between limits, which count as normal and are uniform: of a low level the middle of a normal distribution is too
/// narrow.
pub(super) fn of_uniform(case: &Case, question: &Question, level: f64) -> Option<Notice> {
    /// From here on the deviations of a normal distribution are as much of a step: 1.645 of them are 95 % of it.
    const LEAST: f64 = 0.9;
    let is_step = |piece: &&Evidence| matches!(piece.uncertainty, Uncertainty::Resolution(_));
    let steps = question.asked.evidence.iter().filter(is_step).map(|piece| name_of(piece.of, &question.case));
    let is_uniform = |input: &&UncertainInput| matches!(input.distribution, Distribution::Uniform { .. });
    let inputs = case.uncertain.inputs.iter().filter(is_uniform).map(|input| input.parameter.to_string());
    let of: Vec<String> = steps.chain(inputs).collect();
    let message = || {
        format!(
            "{} is uniform over a step or between limits, and counts as normal with its standard deviation: intervals below 90 % are up to a quarter too narrow where it \
             decides",
            of.join(", ")
        )
    };
    (level < LEAST && !of.is_empty()).then(|| Notice::warning("level-below-resolution", "", message()))
}

/// Warns of quantities whose interval is far wider than their standard deviation says: it is that of the slope at the best fit, which a limit or a bend ends.
pub(super) fn beyond_deviations(case: &Case, intervals: &[Interval]) -> Option<Notice> {
    /// Ratio of the two from which the standard deviation misleads.
    const FAR: f64 = 1.5;
    /// Share of a value that is rounding.
    const ROUNDING: f64 = 1e-9;
    let of_normal = |level: f64| Distribution::Normal { mean: 0.0, sd: 1.0 }.quantile(0.5 + 0.5 * level);
    let is_far = |interval: &&Interval| {
        let half = (interval.high - interval.value).max(interval.value - interval.low);
        let is_wide = half.is_finite() && half > ROUNDING * interval.value.abs();
        interval.sd.is_some_and(|sd| is_wide && half > FAR * of_normal(interval.level) * sd && sd > 0.0)
    };
    let of: Vec<String> = intervals.iter().filter(is_far).map(|interval| name_of(interval.of, case)).collect();
    let message = || {
        format!(
            "the intervals of {} go more than one and a half times as far as their standard deviations say, which are those of slopes at the best fit: the intervals hold",
            of.join(", ")
        )
    };
    (!of.is_empty()).then(|| Notice::warning("interval-beyond-sd", "", message()))
}
