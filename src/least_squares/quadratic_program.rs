//! Convex quadratic programs of a few unknowns: the dual active-set method of Goldfarb and Idnani (1983).
//!
//! It starts from the minimum without conditions and adds the violated ones, one at a time, so that no feasible start is needed and infeasibility shows itself.
//! The programs here have at most a dozen unknowns and are solved a thousand times for one answer, which rules out interior-point libraries.

use alloc::vec::Vec;

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

/// A condition on the unknowns: `normal · x ≥ least`, or `normal · x = least`.
#[derive(Clone, Debug)]
pub(crate) struct Condition {
    pub(crate) normal: DVector<f64>,
    pub(crate) least: f64,
    pub(crate) is_equality: bool,
}

/// The minimum of a quadratic program.
#[derive(Clone, Debug)]
pub(crate) struct Optimum {
    pub(crate) x: DVector<f64>,
    /// The multiplier of each condition: the derivative of the minimum by `least`. Zero for a condition that is not active.
    pub(crate) multipliers: Vec<f64>,
}

/// Minimizes ½ xᵀHx + gᵀx under conditions, from the factor of H. Returns `None` if no point meets the conditions, to rounding.
pub(crate) fn minimum(h: &Cholesky<f64, Dyn>, g: &DVector<f64>, conditions: &[Condition]) -> Option<Optimum> {
    /// More changes of the active set than programs of this size need.
    const CHANGES: usize = 200;
    let mut state = Active { h, x: -h.solve(g), conditions, active: Vec::new() };
    let mut changes = 0;
    while let Some(next) = state.most_violated() {
        let mut entering = Entry { condition: next.0, sign: next.1, multiplier: 0.0 };
        loop {
            changes += 1;
            if changes > CHANGES || !state.x.iter().all(|x| x.is_finite()) {
                return None;
            }
            if state.step(&mut entering)? {
                break;
            }
        }
    }
    let mut multipliers: Vec<f64> = core::iter::repeat_n(0.0, conditions.len()).collect();
    for entry in &state.active {
        multipliers[entry.condition] = entry.sign * entry.multiplier;
    }
    let is_finite = state.x.iter().chain(&multipliers).all(|value| value.is_finite());
    is_finite.then_some(Optimum { x: state.x, multipliers })
}

/// An active condition. An equality that is approached from above counts with the opposite sign.
#[derive(Clone, Copy)]
struct Entry {
    condition: usize,
    sign: f64,
    multiplier: f64,
}

struct Active<'a> {
    h: &'a Cholesky<f64, Dyn>,
    x: DVector<f64>,
    conditions: &'a [Condition],
    active: Vec<Entry>,
}

impl Active<'_> {
    fn normal(&self, entry: &Entry) -> DVector<f64> {
        &self.conditions[entry.condition].normal * entry.sign
    }

    /// Returns by how much a condition is met; below zero it is violated.
    fn slack(&self, condition: usize) -> f64 {
        let condition = &self.conditions[condition];
        condition.normal.dot(&self.x) - condition.least
    }

    /// Returns the condition that is violated most beyond rounding, equalities first, with its sign.
    fn most_violated(&self) -> Option<(usize, f64)> {
        /// Rounding of a slack, as a share of its terms.
        const ROUNDING: f64 = 1e-13;
        let violated = |k: usize| {
            let condition = &self.conditions[k];
            if self.active.iter().any(|entry| entry.condition == k) {
                return None;
            }
            let slack = self.slack(k);
            let size = condition.least.abs() + condition.normal.iter().zip(self.x.iter()).map(|(n, x)| (n * x).abs()).sum::<f64>();
            let rounding = ROUNDING * size + f64::MIN_POSITIVE;
            match condition.is_equality {
                true => Some((k, if slack > 0.0 { -1.0 } else { 1.0 }, f64::INFINITY)),
                false => (slack < -rounding).then(|| (k, 1.0, -slack / condition.normal.norm().max(f64::MIN_POSITIVE))),
            }
        };
        let all = (0..self.conditions.len()).filter_map(violated);
        all.max_by(|one, other| one.2.total_cmp(&other.2)).map(|(k, sign, _)| (k, sign))
    }

    /// Moves toward the entering condition as far as the multipliers of the active ones allow. Returns `true` once the condition is active, and `None` if it
    /// contradicts the active ones.
    fn step(&mut self, entering: &mut Entry) -> Option<bool> {
        /// Share of a normal's length below which it depends on the active ones.
        const DEPENDENT: f64 = 1e-12;
        let normal = self.normal(entering);
        let across = self.h.solve(&normal);
        let (direction, rates) = if self.active.is_empty() {
            (across.clone(), DVector::zeros(0))
        } else {
            let normals = DMatrix::from_columns(&self.active.iter().map(|entry| self.normal(entry)).collect::<Vec<_>>());
            let moved = self.h.solve(&normals);
            let rates = (normals.transpose() * &moved).cholesky()?.solve(&(normals.transpose() * &across));
            (&across - moved * &rates, rates)
        };
        let slope = direction.dot(&normal);
        let length = across.dot(&normal);
        let full = if slope > DEPENDENT * length { -entering.sign * self.slack(entering.condition) / slope } else { f64::INFINITY };
        let may_leave = |i: &usize| rates[*i] > 0.0 && !self.conditions[self.active[*i].condition].is_equality;
        let leaving = (0..self.active.len()).filter(may_leave).min_by(|&i, &k| {
            let until = |i: usize| self.active[i].multiplier / rates[i];
            until(i).total_cmp(&until(k))
        });
        let until_leaving = leaving.map_or(f64::INFINITY, |i| self.active[i].multiplier / rates[i]);
        let length = full.min(until_leaving);
        if !length.is_finite() {
            return None;
        }
        if full.is_finite() {
            self.x += direction * length;
        }
        for (entry, rate) in self.active.iter_mut().zip(rates.iter()) {
            entry.multiplier -= length * rate;
        }
        entering.multiplier += length;
        if full <= until_leaving {
            self.active.push(*entering);
            return Some(true);
        }
        self.active.remove(leaving?);
        Some(false)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at_least(normal: &[f64], least: f64) -> Condition {
        Condition { normal: DVector::from_row_slice(normal), least, is_equality: false }
    }

    fn solved(h: &[f64], g: &[f64], conditions: &[Condition]) -> Option<Optimum> {
        let n = g.len();
        let factor = Cholesky::new(DMatrix::from_row_slice(n, n, h)).expect("positive definite");
        minimum(&factor, &DVector::from_row_slice(g), conditions)
    }

    /// The example of Goldfarb and Idnani's paper.
    #[test]
    fn the_published_example() {
        let conditions = [at_least(&[1.0, 0.0], 0.0), at_least(&[0.0, 1.0], 0.0), at_least(&[1.0, 1.0], 2.0)];
        let optimum = solved(&[4.0, -2.0, -2.0, 4.0], &[6.0, 0.0], &conditions).expect("feasible");
        assert!((optimum.x[0] - 0.5).abs() < 1e-14 && (optimum.x[1] - 1.5).abs() < 1e-14, "{optimum:?}");
        assert!((optimum.multipliers[2] - 5.0).abs() < 1e-13 && optimum.multipliers[0] == 0.0, "{optimum:?}");
    }

    #[test]
    fn the_conditions_of_karush_kuhn_and_tucker_hold() {
        let mut seed = 1_u64;
        let mut random = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (seed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
        };
        let (mut solved_count, mut with_active) = (0, 0);
        for case in 0..2000 {
            let n = 1 + case % 6;
            let root = DMatrix::from_fn(n, n, |_, _| random());
            let h = root.transpose() * &root + DMatrix::identity(n, n) * 1e-3;
            let g = DVector::from_fn(n, |_, _| 3.0 * random());
            let inside = DVector::from_fn(n, |_, _| random());
            // Every condition holds at one point, so that a minimum exists.
            let mut conditions: Vec<Condition> = (0..case % 7)
                .map(|_| {
                    let normal = DVector::from_fn(n, |_, _| random());
                    let least = normal.dot(&inside) - random().abs() * 0.3;
                    Condition { normal, least, is_equality: false }
                })
                .collect();
            if n > 1 && case % 3 == 0 {
                let normal = DVector::from_fn(n, |_, _| random());
                conditions.push(Condition { least: normal.dot(&inside), normal, is_equality: true });
            }
            let factor = Cholesky::new(h.clone()).expect("positive definite");
            let optimum = minimum(&factor, &g, &conditions).expect("feasible");
            solved_count += 1;
            let mut gradient = &h * &optimum.x + &g;
            for (condition, multiplier) in conditions.iter().zip(&optimum.multipliers) {
                let slack = condition.normal.dot(&optimum.x) - condition.least;
                gradient -= &condition.normal * *multiplier;
                with_active += usize::from(*multiplier != 0.0);
                if condition.is_equality {
                    assert!(slack.abs() < 1e-8, "{slack}");
                } else {
                    assert!(slack > -1e-8 && *multiplier >= 0.0 && (slack * multiplier).abs() < 1e-6, "{slack} {multiplier}");
                }
            }
            assert!(gradient.amax() < 1e-6, "case {case}: {gradient}");
        }
        assert!(solved_count == 2000 && with_active > 1000, "{with_active}");
    }

    #[test]
    fn contradictions_have_no_minimum() {
        let conditions = [at_least(&[1.0], 1.0), at_least(&[-1.0], 0.0)];
        assert!(solved(&[1.0], &[0.0], &conditions).is_none());
        let equalities = [1.0, 2.0].map(|least| Condition { is_equality: true, ..at_least(&[1.0, 1.0], least) });
        assert!(solved(&[1.0, 0.0, 0.0, 1.0], &[0.0, 0.0], &equalities).is_none());
        assert!(solved(&[1.0], &[f64::NAN], &conditions).is_none());
    }
}
