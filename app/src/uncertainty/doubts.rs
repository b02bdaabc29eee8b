//! Warnings of what samples do not tell.

use planar_impact::uncertainty as library;

use super::{OutputUncertainty, ends};
use crate::case::CaseOutput;
use crate::message::Message;
use crate::notice::Notice;
use crate::units::trim;

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
    /// Ratio from which an interval of 95 % by the slopes holds less than 88 %.
    const MUCH: f64 = 1.25;
    /// Share of the value that is rounding.
    const ROUNDING: f64 = 1e-9;
    second.sd.is_finite() && second.sd > MUCH * linear.sd && second.sd > ROUNDING * linear.mean.abs()
}

/// Warns of a standard deviation by slopes that hardly change the output where it bends, such as that of a symmetric collision.
pub(super) fn linear_bends(of: CaseOutput, linear: f64, second: f64) -> Notice {
    /// Share of the other that is rounding.
    const ROUNDING: f64 = 1e-9;
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
