//! Starts of the searches of the inverse problem.

use alloc::vec::Vec;
use core::f64::consts::FRAC_PI_2;

use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

use super::to_rest::ToRest;
use crate::least_squares::Residuals;

/// Number of starts of the search; the first is the closed form.
const STARTS: usize = 16;
/// Number of starts that are random, and of candidates from which the others are chosen.
const AT_RANDOM: usize = 6;
const LOOKED_AT: usize = 160;
/// Share of the work that is kept from candidates, for the searches.
const LEFT_FOR_SEARCHES: f64 = 0.8;
/// Yaw rates beside that of the first guess, in rad/s, for candidates.
const NEAR: f64 = 0.5;
/// The same for starts at random.
pub(super) const FAR: f64 = 2.5;

/// Draws starts around the first guess: up to 90° to either side, from a third to one and a half times as fast, and up to five times as fast in rotation.
pub(super) struct Starts {
    random: ChaCha8Rng,
    first: [f64; 3],
}

impl Starts {
    pub(super) fn around(first: [f64; 3]) -> Self {
        Starts { random: ChaCha8Rng::seed_from_u64(1966), first }
    }

    /// Draws a start, with a yaw rate up to a limit beside what the first guess suggests, in rad/s.
    pub(super) fn draw(&mut self, beside: f64) -> [f64; 3] {
        let [x, y, yaw_rate] = self.first;
        let aside = self.random.random_range(-FRAC_PI_2..FRAC_PI_2);
        let faster = self.random.random_range(0.33..1.5) * libm::hypot(x, y);
        let turning = self.random.random_range(-1.0..5.0) * yaw_rate + self.random.random_range(-beside..beside);
        let (sin, cos) = libm::sincos(libm::atan2(y, x) + aside);
        [faster * cos, faster * sin, turning]
    }

    /// Returns the first guess, those of many candidates whose slides end nearest to the pose, and a few at random, to find other solutions.
    pub(super) fn chosen(&mut self, search: &ToRest<'_>) -> Vec<[f64; 3]> {
        let at_random: Vec<[f64; 3]> = (0..AT_RANDOM).map(|_| self.draw(FAR)).collect();
        let mut near: Vec<(f64, [f64; 3])> = Vec::new();
        for _ in 0..LOOKED_AT {
            let start = self.draw(NEAR);
            if search.work_left() > LEFT_FOR_SEARCHES
                && let Some(residuals) = search.at(&start)
            {
                near.push((residuals.iter().map(|residual| residual * residual).sum(), start));
            }
        }
        near.sort_by(|a, b| a.0.total_cmp(&b.0));
        let near = near.into_iter().take(STARTS - 1 - AT_RANDOM).map(|(_, start)| start);
        core::iter::once(self.first).chain(near).chain(at_random).collect()
    }
}
