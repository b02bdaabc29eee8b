//! A number of several vehicles of a class: its mean over the class, and how much the vehicles differ.

use super::estimate::Estimate;
use crate::distribution::Distribution;
use crate::scalar::Real;
use alloc::vec::Vec;

/// The random-effects model of a class: the number of each vehicle is drawn from a distribution with a mean and a standard deviation, and is known with an
/// error of its own.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct RandomEffects {
    /// Mean over the class, with the variance that it has with this variance between the vehicles.
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
        let has_variance = |estimate: &Estimate| estimate.variance >= 0.0 && estimate.variance.is_finite();
        if vehicles.len() < 2 || !vehicles.iter().all(has_variance) {
            return None;
        }
        let (count, freedom) = (vehicles.len() as f64, vehicles.len() as f64 - 1.0);
        let simple = vehicles.iter().map(|estimate| estimate.value).sum::<f64>() / count;
        let squares: f64 = vehicles.iter().map(|estimate| (estimate.value - simple) * (estimate.value - simple)).sum();
        // The weighted sum of squares falls with τ², and is at most that without weights over τ².
        let exceeds = |between: f64| weighted(vehicles, between).1 > freedom;
        let between = if exceeds(0.0) { last_with(squares / freedom, exceeds) } else { 0.0 };
        let mean = weighted(vehicles, between).0;
        // A value may be none, and squares of the largest overflow.
        [mean.value, mean.variance, between, squares].iter().all(|number| number.is_finite()).then_some(RandomEffects { mean, between })
    }

    /// Pools them with the variance between vehicles with which a normal distribution has the 95 % interval of a further one; the interval of the mean by its variance
    /// has at least that probability. `None` as [`Self::of`].
    ///
    /// An estimate of τ² tells nothing of its own error, and is 0 by chance where few vehicles are known well. By the prior density τ/(τ² + v) of τ, with the median v
    /// of their own variances (Box and Tiao 1973, Bayesian Inference in Statistical Analysis, 5.2, for equal ones), the further vehicle is drawn from normal
    /// distributions of variance τ² + var x̄ about x̄, each weighted by the density of τ that the vehicles leave. Of vehicles that are known exactly it has Student's
    /// distribution with k − 1 degrees of freedom.
    ///
    /// ```
    /// use planar_impact::barrier::{Estimate, RandomEffects};
    /// let of = |variance| [80.0, 100.0, 120.0].map(|value| Estimate { value, variance });
    /// let further = RandomEffects::of_further(&of(0.0)).expect("three vehicles");
    /// let half_width = 1.959_964 * (further.between + further.mean.variance).sqrt();
    /// // Student's quantile is 4.3027, and the standard deviation of the vehicles 20.
    /// assert!((half_width / (4.302_653 * 20.0 * (4.0_f64 / 3.0).sqrt()) - 1.0).abs() < 1e-6);
    /// // Errors that explain all differences do not exclude that the vehicles differ.
    /// let errors = of(900.0);
    /// assert!(RandomEffects::of(&errors).expect("three vehicles").between == 0.0);
    /// assert!(RandomEffects::of_further(&errors).expect("three vehicles").between > 900.0);
    /// ```
    pub fn of_further(vehicles: &[Estimate]) -> Option<RandomEffects> {
        let class = RandomEffects::of(vehicles)?;
        let Some(half_width) = Further::of(vehicles, class.mean.value).half_width() else { return Some(class) };
        let wanted = (half_width / Distribution::NORMAL_95) * (half_width / Distribution::NORMAL_95);
        // Both variances grow with τ².
        let falls_short = |between: f64| between + weighted(vehicles, between).0.variance < wanted;
        let between = last_with(wanted, falls_short);
        let mean = weighted(vehicles, between).0;
        [mean.value, mean.variance, between].iter().all(|number| number.is_finite()).then_some(RandomEffects { mean, between })
    }

    /// Returns the standard deviation between the vehicles of the class.
    pub fn deviation_between(&self) -> f64 {
        self.between.square_root()
    }
}

/// The distribution of a further vehicle, about a center: normal ones of which each has a weight, a standard deviation, and the place of its mean.
struct Further(Vec<[f64; 3]>);

impl Further {
    /// The density is summed over steps of the logarithm of τ², so many to either side of its scale. The sum is its integral to within rounding.
    const STEP: f64 = 0.1;
    const STEPS: i32 = 800;

    fn of(vehicles: &[Estimate], center: f64) -> Further {
        let count = vehicles.len() as f64;
        // Of two in the middle the greater: one that is known exactly tells nothing of the spread.
        let mut variances: Vec<f64> = vehicles.iter().map(|estimate| estimate.variance).collect();
        variances.sort_by(f64::total_cmp);
        let own = variances[variances.len() / 2];
        let squares = vehicles.iter().map(|estimate| (estimate.value - center) * (estimate.value - center)).sum::<f64>() / count;
        let scale = squares.max(own);
        let at = |step: i32| {
            let between = scale * libm::exp(f64::from(step) * Self::STEP);
            let (mean, squares) = weighted(vehicles, between);
            // Shares of the scale, so that products of many stay within the floats.
            let spreads: f64 = vehicles.iter().map(|estimate| libm::log((estimate.variance + between) / scale)).sum();
            // The density of ln τ² is that of τ times τ/2.
            let density = libm::log(between / (between + own)) + 0.5 * (libm::log(mean.variance / scale) - spreads - squares);
            [density, (between + mean.variance).square_root(), mean.value - center]
        };
        let mut all: Vec<[f64; 3]> =
            (-Self::STEPS..=Self::STEPS).map(at).filter(|one| one.iter().all(|number| number.is_finite())).collect();
        let greatest = all.iter().map(|one| one[0]).fold(f64::NEG_INFINITY, f64::max);
        all.iter_mut().for_each(|one| one[0] = libm::exp(one[0] - greatest));
        all.retain(|one| one[0] > f64::EPSILON * f64::EPSILON);
        let total: f64 = all.iter().map(|one| one[0]).sum();
        all.iter_mut().for_each(|one| one[0] /= total);
        Further(all)
    }

    /// Returns the distance from the center within which it lies with a probability of 95 %; `None` if nothing differs.
    fn half_width(&self) -> Option<f64> {
        let widest = self.0.iter().map(|one| one[1] + one[2].abs()).fold(0.0, f64::max);
        let below = |x: f64| 0.5 * libm::erfc(-x * core::f64::consts::FRAC_1_SQRT_2);
        let falls_short = |half_width: f64| {
            let within = |[weight, sd, place]: &[f64; 3]| weight * (below((half_width - place) / sd) - below((-half_width - place) / sd));
            self.0.iter().map(within).sum::<f64>() < 0.95
        };
        (widest > 0.0).then(|| last_with(10.0 * widest, falls_short))
    }
}

/// Returns the end of a condition that holds from zero on, and no longer at `high`, by bisection to the last bit.
fn last_with(mut high: f64, holds: impl Fn(f64) -> bool) -> f64 {
    let mut low = 0.0;
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return high;
        }
        if holds(middle) { low = middle } else { high = middle }
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
        for variance in [-1.0, f64::NAN, f64::INFINITY] {
            assert_eq!(RandomEffects::of(&[two[0], Estimate { value: 1.0, variance }]), None);
        }
        assert_eq!(RandomEffects::of(&[1e308, -1e308].map(|value| Estimate { value, variance: 0.0 })), None);
    }

    #[test]
    fn a_further_vehicle_of_exact_ones_has_the_distribution_of_student() {
        // Quantiles at 0.975 of 1, 2, 4 and 9 degrees of freedom.
        for (count, quantile) in
            [(2, 12.706_204_736_174_71), (3, 4.302_652_729_749_464), (5, 2.776_445_105_197_793), (10, 2.262_157_162_740_99)]
        {
            let values: Vec<f64> = (0..count).map(|i| 1e3 + f64::from(i * i)).collect();
            let mean = values.iter().sum::<f64>() / f64::from(count);
            let variance = values.iter().map(|value| (value - mean) * (value - mean)).sum::<f64>() / f64::from(count - 1);
            let vehicles: Vec<Estimate> = values.iter().map(|&value| Estimate { value, variance: 0.0 }).collect();
            let found = RandomEffects::of_further(&vehicles).expect("two or more");
            let wanted = quantile * (variance * (1.0 + f64::from(count).recip())).sqrt();
            assert_relative_eq!(Distribution::NORMAL_95 * (found.between + found.mean.variance).sqrt(), wanted, max_relative = 1e-10);
        }
    }

    /// Nothing tells the spread where one vehicle alone is known well: it is that which the others leave open, and never less than an estimate.
    #[test]
    fn a_further_vehicle_is_as_uncertain_as_the_spread() {
        let further = |numbers: &[(f64, f64)]| {
            let vehicles: Vec<Estimate> = numbers.iter().map(|&(value, sd)| Estimate::with_deviation(value, sd)).collect();
            let found = RandomEffects::of_further(&vehicles).expect("two or more");
            assert!(found.between >= class(numbers).between, "{numbers:?}");
            found.between.sqrt()
        };
        let alike = further(&[(636.0, 6.0), (600.0, 97.0), (604.0, 99.0)]);
        assert!((40.0..400.0).contains(&alike), "{alike}");
        // The more vehicles, the less, and in any unit the same.
        let many: Vec<(f64, f64)> = [(654.0, 30.0); 10].into();
        assert!(further(&many) < 0.5 * further(&many[..4]) && further(&many) > 10.0);
        // One of which nothing is known changes little.
        let useless: Vec<(f64, f64)> = many.iter().copied().chain([(0.0, 1e6)]).collect();
        assert_relative_eq!(further(&useless), further(&many), max_relative = 0.01);
        let small: Vec<(f64, f64)> = many.iter().map(|(value, sd)| (value * 1e-140, sd * 1e-140)).collect();
        assert_relative_eq!(further(&small), further(&many) * 1e-140, max_relative = 1e-9);
        assert_eq!(further(&[(5.0, 0.0), (5.0, 0.0)]), 0.0);
        // One that is exact beside others that are not.
        assert!(further(&[(5.0, 0.0), (6.0, 1.0), (7.0, 1.0)]) > 0.5);
    }
}
