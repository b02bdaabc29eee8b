//! Guaranteed ranges of the unknowns.

use planar_impact::reconstruct::{GuaranteedRange, GuaranteedSearch, NoRange};
use schemars::JsonSchema;
use serde::Serialize;

use super::question::{Question, name_in};
use crate::control::Control;
use crate::issue::{Issue, Issues};
use crate::message::Message;
use crate::named::{Named, positive_zero};
use crate::notice::Notice;

/// The guaranteed range of an unknown: outside of it nothing meets the evidence, whatever the rounding.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Guaranteed {
    /// No value that meets the evidence is below it.
    pub low: f64,
    /// No value that meets the evidence is above it.
    pub high: f64,
    /// The least value that was found to meet it.
    pub low_attained: f64,
    /// The greatest value that was found to meet it.
    pub high_attained: f64,
    /// The unknowns where the least value is attained.
    pub at_low: Named<f64>,
    /// The unknowns where the greatest value is attained.
    pub at_high: Named<f64>,
    /// Standard deviations within which evidence and priors without limits are taken to be.
    pub bounds_sd: f64,
    /// `true` if both ends are attained to within a millionth.
    pub is_tight: bool,
}

/// Number of cells that the search for one unknown may divide.
const CELLS: usize = 10_000;

/// Searches for the guaranteed range of each unknown; none where nothing meets the evidence, which a notice says.
pub(super) fn ranges(
    question: &Question,
    bounds_sd: f64,
    control: &dyn Control,
    notices: &mut Vec<Notice>,
) -> Result<Vec<GuaranteedRange>, Issues> {
    let search = GuaranteedSearch { cells: CELLS, deviations: bounds_sd, ..GuaranteedSearch::default() };
    let total = CELLS * question.asked.unknowns.len();
    let found = question.asked.guaranteed(&search, &|cells| control.goes_on(cells, total));
    control.proceed(total, total)?;
    match found {
        Ok(ranges) => {
            notices.extend(ranges.iter().filter_map(|range| assumed(range, question)));
            Ok(ranges)
        }
        Err(NoRange::NoLimits(of)) => {
            let message = format!("{} has no limits, which a guaranteed range takes", name_in(of, &question.case));
            Err(question.case.unfit([Issue::at("no-limits", question.places.of_unknown(of), message).with_help("give min and max")]))
        }
        Err(reason) => {
            notices.push(Notice::warning("no-guaranteed-range", "unknown", format!("no guaranteed range: {reason}")));
            Ok(Vec::new())
        }
    }
}

/// Returns the note of an unknown that nothing limits, which is searched up to a limit all the same.
fn assumed(range: &GuaranteedRange, question: &Question) -> Option<Notice> {
    let ends: Vec<(&str, f64)> = ["min", "max"].into_iter().zip(range.assumed).filter_map(|(key, end)| Some((key, end?))).collect();
    let (name, keys) = (name_in(range.of, &question.case), ends.iter().map(|(key, _)| *key).collect::<Vec<_>>().join(" and "));
    let mut message = Message::from(format!("guaranteed ranges: {name} has no {keys}, and is searched "));
    for (i, (key, end)) in ends.iter().enumerate() {
        let (and, words) = (if i > 0 { " and " } else { "" }, if *key == "min" { "down to " } else { "up to " });
        message = message.text(format!("{and}{words}")).figure(range.of.measure(), *end);
    }
    let message = message.text("; what lies beyond is not excluded");
    (!ends.is_empty()).then(|| Notice::note("guaranteed-within", question.places.of_unknown(range.of), message))
}

impl Guaranteed {
    /// Describes a range with the names of a case.
    pub(super) fn of(range: &GuaranteedRange, bounds_sd: f64, question: &Question) -> Self {
        let named = |values: &[f64]| {
            let unknowns = question.asked.unknowns.iter().zip(values);
            unknowns.map(|(unknown, value)| (name_in(unknown.of, &question.case), positive_zero(*value))).collect()
        };
        Guaranteed {
            low: positive_zero(range.low),
            high: positive_zero(range.high),
            low_attained: positive_zero(range.low_attained),
            high_attained: positive_zero(range.high_attained),
            at_low: named(&range.at_low),
            at_high: named(&range.at_high),
            bounds_sd,
            is_tight: range.is_tight,
        }
    }
}
