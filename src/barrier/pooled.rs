//! A number of several vehicles of a class: its mean over the class, and how much the vehicles differ.

use super::estimate::Estimate;
use crate::scalar::Real;

/// The random-effects model of a class: the number of each vehicle is drawn from a distribution with a mean and a standard deviation, and is known with an
/// error of its own.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct RandomEffects {
    /// Mean over the class, with the variance of that mean.
    pub mean: Estimate,
    /// Variance between the vehicles of the class.
    pub between: f64,
}

impl RandomEffects {
    /// Pools the numbers of two or more vehicles; `None` for fewer, or if a number is not finite.
    ///
    /// The variance between vehicles τ² is that of Paule and Mandel (1982, J. Res. Natl. Bur. Stand. 87, 377): Σ (xᵢ − x̄)²/(vᵢ + τ²) equals its expectation
    /// k − 1, with x̄ the mean weighted by 1/(vᵢ + τ²), or τ² is 0. It needs no distribution, and is recommended by Veroniki et al. (2016, Res. Synth. Methods
    /// 7, 55). Vehicles whose own variances are 0 have the variance of a sample, which includes the scatter of their tests.
    ///
    /// ```
    /// use planar_impact::barrier::{Estimate, RandomEffects};
    /// let exact = [80.0, 100.0, 120.0].map(|value| Estimate { value, variance: 0.0 });
    /// let class = RandomEffects::of(&exact).expect("three vehicles");
    /// assert!((class.mean.value - 100.0).abs() < 1e-9 && (class.between - 400.0).abs() < 1e-9);
    /// ```
    pub fn of(vehicles: &[Estimate]) -> Option<RandomEffects> {
        RandomEffects::at(vehicles, vehicles.len() as f64 - 1.0)
    }

    /// Pools the numbers of two or more vehicles with the variance between them at which the weighted sum of squares Σ (xᵢ − x̄)²/(vᵢ + τ²) is this, above zero; with
    /// none if the sum is less without it. `None` as [`Self::of`].
    ///
    /// Of vehicles that are known exactly, the sum is that of chi-square with k − 1 degrees of freedom: its quantile gives a limit of the variance.
    ///
    /// ```
    /// use planar_impact::barrier::{Estimate, RandomEffects};
    /// let exact = [80.0, 100.0, 120.0].map(|value| Estimate { value, variance: 0.0 });
    /// let at_most = RandomEffects::at(&exact, 0.5).expect("three vehicles");
    /// assert!((at_most.between - 1600.0).abs() < 1e-9 && (at_most.mean.variance - 1600.0 / 3.0).abs() < 1e-9);
    /// ```
    pub fn at(vehicles: &[Estimate], sum_of_squares: f64) -> Option<RandomEffects> {
        let has_variance = |estimate: &Estimate| estimate.variance >= 0.0 && estimate.variance.is_finite();
        if vehicles.len() < 2 || !vehicles.iter().all(has_variance) || !(sum_of_squares > 0.0 && sum_of_squares.is_finite()) {
            return None;
        }
        let count = vehicles.len() as f64;
        let simple = vehicles.iter().map(|estimate| estimate.value).sum::<f64>() / count;
        let squares: f64 = vehicles.iter().map(|estimate| (estimate.value - simple) * (estimate.value - simple)).sum();
        // The weighted sum of squares falls with τ², and is at most that without weights over τ².
        let exceeds = |between| weighted(vehicles, between).1 > sum_of_squares;
        let (mut low, mut between) = (0.0, if exceeds(0.0) { squares / sum_of_squares } else { 0.0 });
        loop {
            let middle = 0.5 * (low + between);
            if middle <= low || middle >= between {
                break;
            }
            if exceeds(middle) { low = middle } else { between = middle }
        }
        let mean = weighted(vehicles, between).0;
        // A value may be none, and squares of the largest overflow.
        [mean.value, mean.variance, between, squares].iter().all(|number| number.is_finite()).then_some(RandomEffects { mean, between })
    }

    /// Returns the standard deviation between the vehicles of the class.
    pub fn deviation_between(&self) -> f64 {
        self.between.square_root()
    }
}

/// Returns the weighted mean and the weighted sum of squares about it, for a variance between vehicles.
fn weighted(vehicles: &[Estimate], between: f64) -> (Estimate, f64) {
    let least = vehicles.iter().map(|estimate| estimate.variance + between).fold(f64::INFINITY, f64::min);
    // Relative to the largest weight, so that numbers without any variance have one.
    let weight = |estimate: &Estimate| {
        let variance = estimate.variance + between;
        if variance > 0.0 { least / variance } else { 1.0 }
    };
    let sum: f64 = vehicles.iter().map(weight).sum();
    let value = vehicles.iter().map(|estimate| weight(estimate) * estimate.value).sum::<f64>() / sum;
    let squares: f64 = vehicles.iter().map(|estimate| weight(estimate) * (estimate.value - value) * (estimate.value - value)).sum();
    (Estimate { value, variance: least / sum }, squares / least)
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    fn class(numbers: &[(f64, f64)]) -> RandomEffects {
        let vehicles: alloc::vec::Vec<Estimate> = numbers.iter().map(|&(value, sd)| Estimate::with_deviation(value, sd)).collect();
        RandomEffects::of(&vehicles).expect("two or more")
    }

    #[test]
    fn an_independent_computation_agrees() {
        // The root in τ² by Newton's method in 50 digits: cli/tests/reference/pooled.py.
        let found = class(&[(812.0, 31.0), (945.0, 22.0), (760.0, 40.0), (1010.0, 18.0), (880.0, 55.0)]);
        for (got, wanted) in [
            (found.mean.value, 885.332_757_265_467_2),
            (found.mean.deviation(), 45.512_453_387_070_14),
            (found.deviation_between(), 95.727_054_655_203_02),
        ] {
            assert_relative_eq!(got, wanted, max_relative = 1e-12);
        }
    }

    #[test]
    fn equal_variances_add_to_those_between() {
        // With equal v the estimate is the variance of the sample, 50², less v.
        let values = [100.0, 150.0, 200.0];
        let found = class(&values.map(|value| (value, 30.0)));
        assert_relative_eq!(found.between, 2500.0 - 900.0, max_relative = 1e-12);
        assert_relative_eq!(found.mean.variance, 2500.0 / 3.0, max_relative = 1e-12);
        // Differences that the errors explain are no differences of vehicles.
        let found = class(&values.map(|value| (value, 60.0)));
        assert_eq!(found.between, 0.0);
        assert_relative_eq!(found.mean.variance, 1200.0, max_relative = 1e-12);
    }

    #[test]
    fn what_cannot_be_pooled() {
        assert_eq!(RandomEffects::of(&[Estimate::with_deviation(1.0, 1.0)]), None);
        assert_eq!(RandomEffects::of(&[Estimate::with_deviation(1.0, 1.0), Estimate::with_deviation(f64::NAN, 1.0)]), None);
        let same = class(&[(5.0, 0.0), (5.0, 0.0)]);
        assert_eq!((same.mean.value, same.between), (5.0, 0.0));
        let two = [Estimate::with_deviation(1.0, 1.0), Estimate::with_deviation(2.0, 1.0)];
        for sum in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert_eq!(RandomEffects::at(&two, sum), None);
        }
        for variance in [-1.0, f64::NAN, f64::INFINITY] {
            assert_eq!(RandomEffects::of(&[two[0], Estimate { value: 1.0, variance }]), None);
        }
        assert_eq!(RandomEffects::of(&[1e308, -1e308].map(|value| Estimate { value, variance: 0.0 })), None);
    }

    #[test]
    fn the_variance_at_a_sum_of_squares_has_that_sum() {
        let vehicles = [(100.0, 30.0), (160.0, 10.0), (230.0, 25.0)].map(|(value, sd)| Estimate::with_deviation(value, sd));
        let mut last = 0.0;
        for sum in [30.0, 8.0, 2.0, 0.1] {
            let between = RandomEffects::at(&vehicles, sum).expect("three vehicles").between;
            // Without a variance between them the sum is less than 30.
            assert!(if sum == 30.0 { between == 0.0 } else { between > last }, "{sum}: {between} {last}");
            if sum < 30.0 {
                assert_relative_eq!(weighted(&vehicles, between).1, sum, max_relative = 1e-12);
            }
            last = between;
        }
        assert_eq!(RandomEffects::at(&vehicles, 2.0), RandomEffects::of(&vehicles));
    }
}
