//! What is rounding in an answer: an output that every sample has to the last digits is certain, and has no parts.

use super::answer::{OutputUncertainty, ShapleyEffect, Share};
use crate::named::Named;
use crate::units::beyond_rounding;

impl OutputUncertainty {
    /// Removes what is rounding beside the size that numbers of its measure have in the case.
    pub(super) fn remove_rounding(&mut self, scale: f64) {
        let rounded = |x: &mut f64| *x = beyond_rounding(*x, scale);
        let all_rounded = |named: &mut Named<f64>| named.values_mut().for_each(rounded);
        let has_none = |sd: f64| beyond_rounding(sd, scale) == 0.0;
        let OutputUncertainty { value, linear, second_order, monte_carlo, sobol, shapley, bounds: _ } = self;
        rounded(value);
        if let Some(linear) = linear {
            if has_none(linear.sd) {
                linear.shares.values_mut().for_each(|share| *share = f64::NAN);
            }
            [&mut linear.mean, &mut linear.sd].into_iter().for_each(rounded);
            [&mut linear.effects, &mut linear.sd_if_halved].into_iter().for_each(all_rounded);
        }
        if let Some(found) = second_order {
            if has_none(found.sd) {
                found.skewness = f64::NAN;
            }
            [&mut found.mean, &mut found.sd].into_iter().for_each(rounded);
        }
        let Some(found) = monte_carlo else { return };
        if has_none(found.sd) {
            found.skewness = f64::NAN;
            let none = |shares: &mut Named<Share>| {
                for Share { first, first_se, total, total_se, .. } in shares.values_mut() {
                    (*first, *first_se, *total, *total_se) = (f64::NAN, f64::NAN, f64::NAN, f64::NAN);
                }
            };
            sobol.iter_mut().for_each(none);
            for ShapleyEffect { effect, se } in shapley.iter_mut().flat_map(Named::values_mut) {
                (*effect, *se) = (f64::NAN, f64::NAN);
            }
        }
        [&mut found.mean, &mut found.mean_se, &mut found.sd, &mut found.sd_se].into_iter().for_each(rounded);
        [&mut found.quantiles, &mut found.quantiles_se].into_iter().for_each(all_rounded);
    }
}
