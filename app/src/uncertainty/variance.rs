//! The parts of inputs in the variance of outputs: shares of Sobol', and Shapley effects.

use planar_impact::uncertainty::{self as library, Estimated};

use super::{Found, Method, Question, ShapleyEffect, Share, saturated};
use crate::control::Control;
use crate::issue::Issues;
use crate::notice::Notice;

/// Largest share of refused samples with which shares in the variance are meaningful.
const MOST_REFUSED: f64 = 0.01;

/// Why an infinite variance has no parts.
const INFINITE: &str = "an infinite variance has none";

/// Returns why the parts of a variance mean nothing, if too many samples are refused.
fn too_many_refused(refused: u64, samples: u64) -> Option<String> {
    let share = refused as f64 / samples as f64;
    let reason =
        || format!("physics refuses {:.1} % of the samples, which makes the inputs of the others depend on each other", 100.0 * share);
    (share > MOST_REFUSED).then(reason)
}

impl Question<'_> {
    /// Adds the share of each input in the variances.
    pub(super) fn share(&self, found: &mut Found, control: &dyn Control) -> Result<(), Issues> {
        let is_asked = self.options.methods.contains(&Method::Sobol);
        if !self.asks(Method::Sobol) || (self.parameters.len() < 2 && !is_asked) {
            return Ok(());
        }
        let left_out = |reason: String| Notice::note("sobol-left-out", "", format!("the shares of Sobol' are left out: {reason}"));
        if self.infinite().next().is_some() {
            found.notices.0.push(left_out(INFINITE.to_owned()));
            return Ok(());
        }
        let groups: Vec<Vec<usize>> = (0..self.parameters.len()).map(|number| vec![number]).collect();
        // A fifth of the samples, each with its mixtures.
        let together = 2 + self.parameters.len() as u64;
        let samples = (self.options.samples / 5).max(1).saturating_mul(together);
        let goes_on = |done: u64| control.goes_on(saturated(done), saturated(samples));
        let shares = match self.uncertain.shares_of_groups(&self.outputs, &groups, samples, self.options.seed, &goes_on) {
            Ok(shares) => shares,
            Err(library::Correlated(one, other)) => {
                let (one, other) = (self.parameters[one], self.parameters[other]);
                let reason =
                    format!("{one} and {other} are correlated, and have no shares of their own; Shapley effects divide what they share");
                found.notices.0.push(left_out(reason));
                return Ok(());
            }
        };
        if !control.goes_on(saturated(shares.samples), saturated(samples)) {
            return Err(Issues::interrupted());
        }
        if !self.samples_outputs() {
            found.count(shares.samples, &shares.refused);
        }
        if let Some(reason) = too_many_refused(shares.refused.samples, shares.samples) {
            found.notices.0.push(left_out(reason));
            return Ok(());
        }
        for ((shares, of), to) in shares.outputs.iter().zip(&self.outputs).zip(&mut found.of) {
            let limits = self.uncertain.shares_at_most(*of, self.options.seed).map_err(Issues::defect)?;
            let share = |(share, limit): (&library::Share, Option<Estimated>)| Share {
                first: share.first.value,
                first_se: share.first.standard_error,
                total: share.total.value,
                total_se: share.total.standard_error,
                total_at_most: limit.map(|limit| limit.value),
            };
            to.sobol = Some(self.named(shares.iter().zip(limits).map(share)));
        }
        Ok(())
    }

    /// Adds the Shapley effects of the inputs: by default only where correlated inputs have no shares of Sobol'.
    pub(super) fn divide(&self, found: &mut Found, control: &dyn Control) -> Result<(), Issues> {
        let is_needed = self.options.methods.is_empty() && self.uncertain.is_correlated();
        if !is_needed && !self.options.methods.contains(&Method::Shapley) {
            return Ok(());
        }
        let left_out = |reason: &str| Notice::note("shapley-left-out", "", format!("the Shapley effects are left out: {reason}"));
        if self.infinite().next().is_some() {
            found.notices.0.push(left_out(INFINITE));
            return Ok(());
        }
        // A fifth of the samples, each with its steps.
        let samples = (self.options.samples / 5).max(1).saturating_mul(1 + self.parameters.len() as u64);
        let goes_on = |done: u64| control.goes_on(saturated(done), saturated(samples));
        let effects = self.uncertain.shapley_while(&self.outputs, samples, self.options.seed, &goes_on);
        if !control.goes_on(saturated(effects.samples), saturated(samples)) {
            return Err(Issues::interrupted());
        }
        if !self.samples_outputs() {
            found.count(effects.samples, &effects.refused);
        }
        if let Some(reason) = too_many_refused(effects.refused.samples, effects.samples) {
            found.notices.0.push(left_out(&reason));
            return Ok(());
        }
        for (effects, to) in effects.outputs.iter().zip(&mut found.of) {
            let effect = |effect: &Estimated| ShapleyEffect { effect: effect.value, se: effect.standard_error };
            to.shapley = Some(self.named(effects.iter().map(effect)));
        }
        Ok(())
    }
}
