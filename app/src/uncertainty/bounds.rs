//! Guaranteed ranges of the outputs of a case.

mod beside_impact;

use planar_impact::uncertainty::{self as library, NoBounds, RefusedPart, Search};

use self::beside_impact::{BesideImpact, of_impact};
use super::{Bounds, Found, Method, Question, saturated};
use crate::case::CaseOutput;
use crate::control::Control;
use crate::issue::{Issue, Issues};
use crate::named::positive_zero;
use crate::notice::Notice;

/// Evaluations that a search for the bounds of an output may take: a fraction of a second, and ten times as many if bounds are asked for by name.
const EVALUATIONS: [usize; 2] = [200_000, 2_000_000];

impl Question<'_> {
    /// Adds guaranteed ranges.
    pub(super) fn bound(&self, found: &mut Found, control: &dyn Control) -> Result<(), Issues> {
        if !self.asks(Method::Bounds) {
            return Ok(());
        }
        let evaluations = EVALUATIONS[usize::from(self.options.methods.contains(&Method::Bounds))];
        let search = Search::of_evaluations(evaluations, self.parameters.len());
        let cells = search.cells;
        let total = cells * self.outputs.len();
        let ranges = self.uncertain.ranges(self.options.bounds_sd);
        for (place, (of, to)) in self.outputs.iter().zip(&mut found.of).enumerate() {
            let goes_on = |done: u64| control.goes_on(cells * place + saturated(done), total);
            let range = self.range(*of, &ranges, &search, &goes_on);
            control.proceed(cells * (place + 1), total)?;
            match range {
                Ok(range) => to.bounds = Some(self.named_bounds(range)),
                Err(reason) => {
                    let message = format!("{of} has no guaranteed bounds: {reason}");
                    found.notices.0.push(Notice::warning("no-bounds", of.to_string(), message));
                }
            }
        }
        Ok(())
    }

    fn range(
        &self,
        of: CaseOutput,
        ranges: &[(f64, f64)],
        search: &Search,
        goes_on: &(dyn Fn(u64) -> bool + Sync),
    ) -> Result<library::Bounds, String> {
        let sentence = |reason: NoBounds| reason.to_string();
        let model = self.uncertain.model();
        if let CaseOutput::Impact(output) = of {
            let (impact, ranges) = (model.impact(), of_impact(model, ranges));
            return library::bounds(impact.collision(), impact.mapping(), &ranges, output, search, goes_on).map_err(sentence);
        }
        let mut function = BesideImpact::of(model, of, ranges).map_err(|reason| reason.to_string())?;
        library::bounds_of(&mut function, ranges, search, goes_on).map_err(sentence)
    }

    fn named_bounds(&self, range: library::Bounds) -> Bounds {
        Bounds {
            low: positive_zero(range.low),
            high: positive_zero(range.high),
            low_attained: positive_zero(range.low_attained),
            high_attained: positive_zero(range.high_attained),
            at_low: self.named(range.at_low),
            at_high: self.named(range.at_high),
            is_tight: range.is_tight,
            is_whole: range.refused == RefusedPart::None,
        }
    }
}

/// Returns the issue of a number of standard deviations that ends no input.
pub(crate) fn wrong_sd(bounds_sd: f64) -> Option<Issue> {
    let is_right = bounds_sd > 0.0 && bounds_sd <= 40.0;
    let message = || format!("{bounds_sd} is not above 0 and at most 40");
    (!is_right).then(|| Issue::of_call("--bounds-sd", message(), Some("for instance 3".to_owned())))
}
