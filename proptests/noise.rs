//! Normal noise from a fixed seed, and counts of statements that must hold at a stated rate.

use proptest::prelude::RngExt;
use proptest::test_runner::{RngAlgorithm, TestRng};

pub struct Noise(TestRng);

impl Noise {
    pub fn of_seed(seed: u8) -> Self {
        Noise(TestRng::from_seed(RngAlgorithm::ChaCha, &[seed; 32]))
    }

    /// Draws a number with mean 0 and standard deviation 1 (Box and Muller).
    pub fn normal(&mut self) -> f64 {
        let (radius, angle): (f64, f64) = (1.0 - self.0.random::<f64>(), self.0.random());
        (-2.0 * radius.ln()).sqrt() * (std::f64::consts::TAU * angle).cos()
    }
}

/// Number of times a statement is made, and number of times it is true.
#[derive(Default)]
pub struct Count {
    said: u32,
    held: u32,
}

impl Count {
    pub fn add(&mut self, held: bool) {
        self.said += 1;
        self.held += u32::from(held);
    }

    /// Returns the share of the statements that are true.
    pub fn rate(&self) -> f64 {
        f64::from(self.held) / f64::from(self.said)
    }

    /// Asserts a rate to within five standard deviations of a binomial count: a correct rate fails for one seed in
    /// two million, and with the counts used here a standard deviation that is wrong by a tenth fails.
    pub fn assert_rate(&self, what: &str, rate: f64) {
        let (said, held) = (f64::from(self.said), f64::from(self.held));
        let allowed = 5.0 * (rate * (1.0 - rate) / said).sqrt();
        assert!((held / said - rate).abs() <= allowed, "{what}: {held} of {said}, where {rate} ± {allowed} is stated");
    }
}

/// Probability of a normal distribution within one standard deviation, erf(1/√2).
pub const WITHIN_ONE: f64 = 0.682_689_492;
/// Probability within two standard deviations, erf(√2).
pub const WITHIN_TWO: f64 = 0.954_499_736;

#[test]
fn the_noise_is_normal() {
    let mut noise = Noise::of_seed(1);
    let (mut one, mut two) = (Count::default(), Count::default());
    for _ in 0..100_000 {
        let size = noise.normal().abs();
        one.add(size < 1.0);
        two.add(size < 2.0);
    }
    one.assert_rate("one standard deviation", WITHIN_ONE);
    two.assert_rate("two standard deviations", WITHIN_TWO);
}
