//! Warnings of what samples do not tell.

use planar_impact::uncertainty as library;

use super::{OutputUncertainty, ends};
use crate::case::CaseOutput;
use crate::message::Message;
use crate::notice::Notice;
use crate::units::trim;

/// Ratio of two standard deviations from which an interval of 95 % by the smaller one holds less than 88 %.
const MUCH: f64 = 1.25;

/// Share of a number that is rounding.
const ROUNDING: f64 = 1e-9;

/// Warns of outputs whose standard deviation the outermost samples make, and of which further samples make another.
pub(super) fn heavy_tails(outputs: &[CaseOutput], of: &[OutputUncertainty], solved: u64) -> Option<Notice> {
    /// Samples from which a standard deviation of finite moments is known to a few per cent.
    const MANY: u64 = 10_000;
    /// Largest share of its standard error.
    const MOST: f64 = 0.1;
    let is_heavy = |found: &OutputUncertainty| found.monte_carlo.as_ref().is_some_and(|sampled| sampled.sd_se > MOST * sampled.sd);
    let names: Vec<String> = outputs.iter().zip(of).filter(|(_, found)| is_heavy(found)).map(|(output, _)| output.to_string()).collect();
    let message = || {
        format!(
            "a few samples far out make the standard deviation of {}, and further samples another; it may have none, and then no mean either: take \
             quantiles and probabilities",
            names.join(", ")
        )
    };
    (solved >= MANY && !names.is_empty()).then(|| Notice::warning("heavy-tails", "", message()))
}

/// Returns `true` if curvature makes a standard deviation much larger than slopes do.
pub(super) fn is_bent(linear: &library::Linear, second: &library::SecondOrder) -> bool {
    second.sd.is_finite() && second.sd > MUCH * linear.sd && second.sd > ROUNDING * linear.mean.abs()
}

/// Returns `true` if values one standard deviation away make another standard deviation than slopes do: at a corner, such as the limit of CRASH3's correction, slopes
/// are those of one side.
pub(super) fn is_at_corner(of: &library::Linear, beside: &library::SlopesAndValues) -> bool {
    let (less, more) = (beside.by_slopes.min(beside.by_values), beside.by_slopes.max(beside.by_values));
    let is_known = beside.by_slopes.is_finite() && beside.by_values.is_finite();
    is_known && more > MUCH * less && more > ROUNDING * of.mean.abs()
}

/// Warns of a standard deviation by the slopes of one side of a corner.
pub(super) fn linear_at_corner(of: CaseOutput, beside: &library::SlopesAndValues) -> Notice {
    let message = Message::from(format!("the standard deviation of {of} is "))
        .figure(of.measure(), beside.by_slopes)
        .text(" by slopes, and about ")
        .figure(of.measure(), beside.by_values)
        .text(
            " by its values one standard deviation of each input away: it has a corner near the means, where slopes are those of one side; take monte-carlo or sobol",
        );
    Notice::warning("linear-at-corner", of.to_string(), message)
}

/// Warns of a standard deviation by slopes that hardly change the output where it bends, such as that of a symmetric collision.
pub(super) fn linear_bends(of: CaseOutput, linear: f64, second: f64) -> Notice {
    let linear = if linear < ROUNDING * second { 0.0 } else { linear };
    let message = Message::from(format!("the standard deviation of {of} is "))
        .figure(of.measure(), linear)
        .text(" by slopes, and ")
        .figure(of.measure(), second)
        .text(
            " with curvature: the linear one is too small, and says little of which input matters; take second-order, monte-carlo or sobol",
        );
    Notice::warning("linear-bends", of.to_string(), message)
}

/// Warns if the inputs are mostly what physics refuses: what is left of them is another distribution than the one that was given.
pub(super) fn most_refused(samples: u64, refused: u64) -> Option<Notice> {
    let share = refused as f64 / samples as f64;
    let message = || {
        format!(
            "physics refuses {:.0} % of the samples, so that the inputs of the others are distributed otherwise than given: check the standard \
             deviations, and give limits of what is possible",
            100.0 * share
        )
    };
    (share > 0.5).then(|| Notice::warning("most-refused", "", message()))
}

/// Warns if the ends of the middle range are those of few samples, of which the outermost is mostly nearer than the end.
pub(super) fn few_samples(samples: u64, refused: u64, level: f64) -> Option<Notice> {
    const ENOUGH: f64 = 10.0;
    let solved = samples - refused;
    let [tail, _] = ends(level);
    let beyond = tail * solved as f64;
    let message = || {
        let wanted = (ENOUGH / beyond * samples as f64).ceil();
        format!(
            "{solved} solved samples have {} beyond either end of the {} % range, which may be too narrow: give --samples {wanted} or more",
            trim(beyond),
            trim(100.0 * level)
        )
    };
    (beyond < ENOUGH).then(|| Notice::warning("few-samples", "", message()))
}
