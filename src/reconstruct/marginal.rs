//! The posterior of one quantity, in numbers.

use std::f64::consts::{PI, TAU};

use super::convergence::Convergence;
use super::measurand::Measurand;
use crate::scalar::rounding_at;

/// The posterior of one quantity.
#[derive(Clone, Debug, PartialEq)]
pub struct Marginal {
    /// Its quantity.
    pub of: Measurand,
    /// The mean, in SI. An angle is not wrapped: its draws lie within half a turn of the best solution.
    pub mean: f64,
    /// The standard deviation.
    pub sd: f64,
    /// The shortest range that has the probability asked for.
    pub highest_density: [f64; 2],
    /// R̂, split and of ranks: the draws have converged where it is below 1.01. NaN where they do not vary.
    pub r_hat: f64,
    /// Number of independent draws that would know the middle and the tails as well.
    pub effective: f64,
    /// The draws in ascending order.
    sorted: Vec<f64>,
}

impl Marginal {
    /// Largest R̂ of draws that count as converged.
    pub const CONVERGED: f64 = 1.01;

    /// Summarizes draws in turn, of a number of chains of walkers; `None` if one is not finite.
    pub(super) fn of(of: Measurand, draws: &[f64], chains: usize, walkers: usize, level: f64) -> Option<Self> {
        let mut sorted = draws.to_vec();
        if sorted.is_empty() || sorted.iter().any(|x| !x.is_finite()) {
            return None;
        }
        sorted.sort_by(f64::total_cmp);
        let count = sorted.len() as f64;
        let mean = sorted.iter().map(|x| x / count).sum::<f64>();
        let sd = (sorted.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / (count - 1.0)).sqrt();
        let highest_density = shortest(&sorted, level);
        let Convergence { r_hat, effective } = Convergence::of(draws, chains, walkers);
        Some(Marginal { of, mean, sd, highest_density, r_hat, effective, sorted })
    }

    /// Returns the value below which a share of the draws lies.
    ///
    /// # Panics
    ///
    /// If the share is not between 0 and 1.
    pub fn quantile(&self, share: f64) -> f64 {
        assert!((0.0..=1.0).contains(&share), "a share of draws is between 0 and 1, and not {share}");
        quantile(&self.sorted, share)
    }

    /// Returns the median.
    pub fn median(&self) -> f64 {
        self.quantile(0.5)
    }

    /// Returns the probability that the quantity is greater than a value, by more than the rounding of exact evidence. An angle that is computed counts within half
    /// a turn of zero, as it is printed, if the value lies there.
    pub fn probability_above(&self, value: f64) -> f64 {
        self.counted_above(value + rounding_at(value))
    }

    /// Returns the probability that the quantity is less than a value. With that of greater ones it is 1, unless the quantity may be the value itself.
    pub fn probability_below(&self, value: f64) -> f64 {
        1.0 - self.counted_above(value - rounding_at(value))
    }

    fn counted_above(&self, value: f64) -> f64 {
        if matches!(self.of, Measurand::Variable(_)) || self.of.period().is_none() || value.abs() > PI {
            return self.share_above(value);
        }
        let between = |low, high| self.share_above(low) - self.share_above(high);
        between(value, PI) + self.share_above(value + TAU) + between(value - TAU, -PI)
    }

    fn share_above(&self, value: f64) -> f64 {
        let count = self.sorted.len();
        (count - self.sorted.partition_point(|x| *x <= value)) as f64 / count as f64
    }
}

/// Returns a quantile of ascending numbers, between two of them by their distance.
pub(super) fn quantile(sorted: &[f64], share: f64) -> f64 {
    let place = share * (sorted.len() - 1) as f64;
    let below = (place as usize).min(sorted.len() - 1);
    let above = (below + 1).min(sorted.len() - 1);
    sorted[below] + (place - below as f64) * (sorted[above] - sorted[below])
}

/// Returns the shortest range of ascending numbers that contains a share of them.
fn shortest(sorted: &[f64], share: f64) -> [f64; 2] {
    let within = ((share * sorted.len() as f64).ceil() as usize).clamp(1, sorted.len());
    let ranges = sorted.windows(within).map(|range| [range[0], range[within - 1]]);
    ranges.min_by(|one, other| (one[1] - one[0]).total_cmp(&(other[1] - other[0]))).unwrap_or([f64::NAN; 2])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input::Side;
    use crate::output::Output;

    #[test]
    fn what_is_a_value_itself_is_neither_above_nor_below() {
        let draws: Vec<f64> = (0..40).map(|i| [0.0, 3e-17, -3e-17, 0.2][i % 4]).collect();
        let of = Measurand::Output(Output::CriticalImpulseRatio);
        let marginal = Marginal::of(of, &draws, 4, 10, 0.95).expect("finite");
        for (value, above, below) in [(0.0, 0.25, 0.0), (0.1, 0.25, 0.75), (0.2, 0.0, 0.75), (-0.1, 1.0, 0.0)] {
            assert_eq!((marginal.probability_above(value), marginal.probability_below(value)), (above, below), "{value}");
        }
    }

    /// Draws every degree within half a turn of 170°: 10° of 360° lie from 170° to 180° and as many from −180° to −170°.
    #[test]
    fn angles_count_as_they_are_printed() {
        let draws: Vec<f64> = (0..3600).map(|i| (-10.0 + (f64::from(i) + 0.5) / 10.0_f64).to_radians()).collect();
        let of = Measurand::Output(Output::PrincipalDirectionOfForce(Side::One));
        let marginal = Marginal::of(of, &draws, 4, 10, 0.95).expect("finite");
        for (degrees, above) in [(170.0, 10.0), (0.0, 180.0), (-170.0, 350.0), (-10.0, 190.0), (350.0, 0.0), (190.0, 160.0)] {
            let found = marginal.probability_above(f64::to_radians(degrees));
            assert!((found - above / 360.0).abs() < 1e-3, "{degrees}: {found}");
        }
    }
}
