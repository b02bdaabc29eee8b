//! Diagnostics of draws: split R̂ and effective number of draws, of ranks (Vehtari, Gelman, Simpson, Carpenter and Bürkner 2021).

use statrs::distribution::{ContinuousCDF, Normal};

use super::marginal::{Marginal, quantile};

/// Least share of independent draws of which more need not be drawn.
const INDEPENDENT: f64 = 0.25;

/// The diagnostics of the draws of one quantity.
pub(super) struct Convergence {
    pub(super) r_hat: f64,
    pub(super) effective: f64,
}

impl Convergence {
    /// Returns the diagnostics of draws in turn, of chains of walkers. Walkers that stay where they are show in the effective number, of the walkers one by one;
    /// chains that do not agree show in R̂.
    pub(super) fn of(draws: &[f64], chains: usize, walkers: usize) -> Self {
        let chains: Vec<Vec<f64>> = draws.chunks(draws.len() / chains).map(<[f64]>::to_vec).collect();
        let of_walker = |chain: &[f64], walker: usize| chain.iter().skip(walker).step_by(walkers).copied().collect();
        let of_chain = |chain| (0..walkers).map(move |walker| of_walker(chain, walker));
        Convergence { r_hat: r_hat(&chains), effective: effective(&chains.iter().flat_map(|chain| of_chain(chain)).collect::<Vec<_>>()) }
    }

    /// Returns `true` if further draws would not be better.
    pub(super) fn is_reached(&self, draws: usize) -> bool {
        self.r_hat <= Marginal::CONVERGED && self.effective >= INDEPENDENT * draws as f64
    }
}

/// Returns R̂: how much wider all draws together are than those of single chains. It is the greater of that of the values and that of their distances from
/// the median. NaN where the draws do not vary.
fn r_hat(chains: &[Vec<f64>]) -> f64 {
    let halves = split(chains);
    let middle = quantile(&sorted(chains), 0.5);
    let folded: Vec<Vec<f64>> = halves.iter().map(|half| half.iter().map(|x| (x - middle).abs()).collect()).collect();
    let of = |chains: &[Vec<f64>]| Variances::of(chains).r_hat();
    of(&normal_scores(&halves)).max(of(&normal_scores(&folded)))
}

/// Returns the number of independent draws that would know the middle and the tails as well: the least of those for the ranks and for the share of draws
/// beyond the 5 % and the 95 % quantiles.
fn effective(chains: &[Vec<f64>]) -> f64 {
    let (halves, sorted) = (split(chains), sorted(chains));
    let beyond = |level: f64| {
        let limit = quantile(&sorted, level);
        let share = |half: &Vec<f64>| half.iter().map(|x| if *x <= limit { 1.0 } else { 0.0 }).collect();
        halves.iter().map(share).collect::<Vec<_>>()
    };
    // Where a twentieth of the draws or more is the greatest, none lies beyond it.
    let known = [normal_scores(&halves), beyond(0.05), beyond(0.95)].into_iter().filter_map(|chains| independent(&chains));
    known.reduce(f64::min).unwrap_or(f64::NAN)
}

/// Returns the halves of each chain.
fn split(chains: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let halves = |chain: &Vec<f64>| {
        let half = chain.len() / 2;
        [chain[..half].to_vec(), chain[chain.len() - half..].to_vec()]
    };
    chains.iter().flat_map(halves).collect()
}

fn sorted(chains: &[Vec<f64>]) -> Vec<f64> {
    let mut all: Vec<f64> = chains.iter().flatten().copied().collect();
    all.sort_by(f64::total_cmp);
    all
}

/// Returns the normal scores of the ranks among all draws; equal draws share their mean rank.
fn normal_scores(chains: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let sorted = sorted(chains);
    let count = sorted.len() as f64;
    let score = |x: &f64| {
        let below = sorted.partition_point(|other| other.total_cmp(x).is_lt()) as f64;
        let up_to = sorted.partition_point(|other| other.total_cmp(x).is_le()) as f64;
        let rank = 0.5 * (below + up_to + 1.0);
        Normal::standard().inverse_cdf((rank - 0.375) / (count + 0.25))
    };
    chains.iter().map(|chain| chain.iter().map(score).collect()).collect()
}

/// Variances within the chains and of all draws.
struct Variances {
    within: f64,
    all: f64,
}

impl Variances {
    fn of(chains: &[Vec<f64>]) -> Self {
        let (count, length) = (chains.len() as f64, chains[0].len() as f64);
        let means: Vec<f64> = chains.iter().map(|chain| mean(chain)).collect();
        let within = chains.iter().zip(&means).map(|(chain, mean)| squares(chain, *mean) / (length - 1.0)).sum::<f64>() / count;
        let between = squares(&means, mean(&means)) / (count - 1.0);
        Variances { within, all: within * (length - 1.0) / length + between }
    }

    fn r_hat(&self) -> f64 {
        (self.all / self.within).sqrt()
    }
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

fn squares(values: &[f64], from: f64) -> f64 {
    values.iter().map(|x| (x - from) * (x - from)).sum()
}

/// Returns the number of draws over their autocorrelation time, summed in pairs until one is not positive and made monotone (Geyer 1992).
/// `None` if they do not vary.
fn independent(chains: &[Vec<f64>]) -> Option<f64> {
    let Variances { within, all } = Variances::of(chains);
    if all.is_nan() || all <= 0.0 {
        return None;
    }
    let length = chains[0].len();
    let draws = (chains.len() * length) as f64;
    let means: Vec<f64> = chains.iter().map(|chain| mean(chain)).collect();
    let autocovariance = |lag: usize| {
        let of = |(chain, mean): (&Vec<f64>, &f64)| {
            chain.iter().zip(&chain[lag..]).map(|(one, other)| (one - mean) * (other - mean)).sum::<f64>() / length as f64
        };
        chains.iter().zip(&means).map(of).sum::<f64>() / chains.len() as f64
    };
    let correlation = |lag: usize| 1.0 - (within - autocovariance(lag)) / all;
    let (mut time, mut least) = (-1.0, f64::INFINITY);
    for lag in (0..).step_by(2) {
        let first = if lag == 0 { 1.0 } else { correlation(lag) };
        let pair = first + correlation(lag + 1);
        // The last lags are those of too few draws.
        if pair <= 0.0 || lag + 4 >= length {
            time += first.max(0.0);
            break;
        }
        least = pair.min(least);
        time += 2.0 * least;
    }
    // Draws that alternate are worth more than independent ones, but not without limit.
    Some(draws / time.max(1.0 / libm::log10(draws)))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns autoregressive chains of uniform noise, each shifted and widened more than the one before.
    fn chains(count: usize, length: usize, correlation: f64, shift: f64, widening: f64) -> Vec<Vec<f64>> {
        let mut state = 1_u64;
        let mut noise = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
        };
        let mut chain = |c: usize| {
            let mut x = 0.0;
            let mut next = || {
                x = correlation * x + noise();
                (x + shift * c as f64) * (1.0 + widening * c as f64)
            };
            (0..length).map(|_| next()).collect()
        };
        (0..count).map(&mut chain).collect()
    }

    #[test]
    fn diagnostics_are_those_of_another_program() {
        // ArviZ 0.23.4: rhat(method="rank"), and the least of ess(method="bulk") and ess(method="quantile") at 0.05 and 0.95.
        for (chains, r, independent) in [
            (chains(4, 200, 0.7, 0.0, 0.0), 1.007_501_320_012_235_4, 180.169_748_271_382_64),
            (chains(4, 200, 0.7, 0.2, 0.0), 1.239_465_609_497_866_7, 14.629_789_395_721_438),
            (chains(8, 50, -0.4, 0.0, 0.0), 0.992_851_300_956_624_3, 492.288_604_366_633_1),
            (chains(4, 500, 0.95, 0.0, 0.0), 1.045_344_854_265_470_4, 77.606_261_972_449_87),
            (chains(4, 200, 0.0, 0.0, 1.0), 1.232_657_476_056_850_3, 60.332_266_094_835_42),
        ] {
            assert!((r_hat(&chains) - r).abs() < 1e-9, "{} {r}", r_hat(&chains));
            assert!((effective(&chains) / independent - 1.0).abs() < 1e-9, "{} {independent}", effective(&chains));
        }
    }

    #[test]
    fn draws_that_do_not_vary_have_no_diagnostics() {
        assert!(r_hat(&[vec![1.0; 8], vec![1.0; 8]]).is_nan());
        assert!(effective(&[vec![1.0; 8], vec![1.0; 8]]).is_nan() && effective(&[vec![1.0], vec![2.0]]).is_nan());
        // A third of the draws is the greatest; the others are worth about as many as there are.
        let noise = chains(4, 300, 0.0, 0.0, 0.0);
        let capped: Vec<Vec<f64>> = noise.iter().map(|chain| chain.iter().map(|x| x.min(0.17)).collect()).collect();
        assert!((800.0..1500.0).contains(&effective(&capped)), "{}", effective(&capped));
    }
}
