//! The verb `sweep`: the outputs over a range of one or two inputs.

mod chart;
mod contours;
mod data;
mod labels;
pub mod plot;
mod range;
mod text;

use planar_impact::{Output, Refusals};

use crate::Done;
use crate::arguments::{Sweep as Call, SweepFormat};
use crate::case::{Answer, Case, Crush};
use crate::document::{Problem, Problems};
use crate::exit::Failure;
use crate::names;
use crate::progress::Progress;
use crate::units::Units;
use crate::wording;
use range::Range;

/// The most numbers that a sweep computes, so that every output at every point does not fill the memory.
const MOST_NUMBERS: usize = 10_000_000;

/// The most rows of a table for people.
const MOST_ROWS: usize = 20_000;

/// Reads the case, solves it at every point and prints the outputs.
///
/// # Errors
///
/// Everything wrong with the file or the call, or that the physics refuses every point.
pub fn run(call: &Call) -> Result<Done, Failure> {
    crate::progress::note_interrupts();
    let case = Case::read(&call.case).map_err(Failure::Input)?;
    let mut problems = Vec::new();
    let ranges = range::read(&call.vary, &case.inputs, &mut problems);
    // A ratio or a moment that is varied is one that the setup has.
    let first: Vec<_> = ranges.iter().map(|range| (range.parameter, range.si[0])).collect();
    let setup = if problems.is_empty() { case.inputs.set_all(&first).as_given() } else { case.setup.clone() };
    let answers = names::answers("--of", &call.of, &setup, &mut problems).unwrap_or_else(principal);
    let count: usize = ranges.iter().map(|range| range.si.len()).product();
    if count.saturating_mul(answers.len()) > MOST_NUMBERS {
        let message = format!("{count} points of {} outputs are more than the {MOST_NUMBERS} numbers of a sweep", answers.len());
        problems.push(Problem::of_call("--of", message, Some("take a larger step, or name fewer outputs".to_owned())));
    }
    if call.format == SweepFormat::Text && count > MOST_ROWS {
        let message = format!("a table of {count} rows is longer than anyone reads; the most is {MOST_ROWS}");
        problems.push(Problem::of_call("--format text", message, Some("take a larger step, or --format csv, json or svg".to_owned())));
    }
    if !problems.is_empty() {
        return Err(Failure::Input(Problems::of_call(problems)));
    }
    let units = call.units.unwrap_or(case.units);
    let sweep = Sweep::compute(&case, ranges, answers, units)?;
    sweep.check()?;
    let text = match call.format {
        SweepFormat::Text => text::render(&sweep),
        SweepFormat::Csv => data::csv(&sweep)?,
        SweepFormat::Json => data::json(&sweep)?,
        SweepFormat::Svg => plot::svg(&sweep)?,
    };
    if crate::progress::is_interrupted() { Err(Failure::Interrupted) } else { Ok(Done::with(text)) }
}

/// The outputs of the paper's Table 2 and Figure 4.
fn principal() -> Vec<Answer> {
    [Output::NormalWork, Output::TangentialWork, Output::Loss, Output::CriticalImpulseRatio].map(Answer::Impact).into()
}

/// The outputs over the ranges.
struct Sweep<'a> {
    case: &'a Case,
    units: Units,
    ranges: Vec<Range>,
    answers: Vec<Answer>,
    /// Each point, the last range running fastest.
    points: Vec<Result<Vec<f64>, Refused>>,
    /// For each answer, the size of its kind: what is 10⁻¹² of it is rounding.
    scales: Vec<f64>,
}

/// Why a point has no outputs.
#[derive(Clone, Debug, PartialEq)]
struct Refused {
    /// In a word or two.
    short: &'static str,
    /// In full.
    reason: String,
}

impl Refused {
    fn of(refusals: &Refusals, units: Units) -> Refused {
        let reasons: Vec<String> = refusals.reasons().iter().map(|refusal| wording::refusal(refusal, units).1).collect();
        Refused { short: refusals.reasons().first().map_or("", wording::short), reason: reasons.join("; ") }
    }
}

impl<'a> Sweep<'a> {
    fn compute(case: &'a Case, ranges: Vec<Range>, answers: Vec<Answer>, units: Units) -> Result<Self, Failure> {
        let count = ranges.iter().map(|range| range.si.len()).product();
        let mut sweep = Sweep { case, units, ranges, points: Vec::with_capacity(count), scales: vec![0.0; answers.len()], answers };
        let mut progress = Progress::over(count);
        for at in 0..count {
            if !progress.step() {
                return Err(Failure::Interrupted);
            }
            let values: Vec<_> = sweep.at(at).map(|(range, i)| (range.parameter, range.si[i])).collect();
            let setup = case.inputs.set_all(&values).as_given();
            let unfit = setup.crush.iter().flatten().find_map(Crush::unfit);
            let point = match unfit {
                Some(reason) => Err(Refused { short: "no crush", reason }),
                None => setup.solve().map_err(|refusals| Refused::of(&refusals, units)),
            };
            if let Ok(found) = &point {
                for (scale, answer) in sweep.scales.iter_mut().zip(&sweep.answers) {
                    *scale = scale.max(found.scale(answer.measure()));
                }
            }
            let numbers = |found: &crate::case::Answers| {
                sweep.answers.iter().map(|&answer| crate::named::plain(found.get(answer).unwrap_or(f64::NAN))).collect()
            };
            sweep.points.push(point.as_ref().map(numbers).map_err(Clone::clone));
        }
        Ok(sweep)
    }

    /// The ranges with the place of a point in each.
    fn at(&self, point: usize) -> impl Iterator<Item = (&Range, usize)> {
        let inner = self.ranges.last().map_or(1, |range| range.si.len());
        let places = if self.ranges.len() == 2 { [point / inner, point % inner] } else { [point, 0] };
        self.ranges.iter().zip(places)
    }

    /// At least one point must have an answer.
    fn check(&self) -> Result<(), Failure> {
        let Some(Err(first)) = self.points.first() else { return Ok(()) };
        if self.points.iter().any(Result::is_ok) {
            return Ok(());
        }
        let message = match self.points.len() {
            1 => format!("the only point is refused: {}", first.reason),
            count => format!("each of the {count} points is refused, the first because {}", first.reason),
        };
        Err(Failure::Physics(Problems::of_call(vec![Problem::of_call("--vary", message, None)])))
    }

    /// An answer at every point, in SI; not a number where the point is refused.
    fn column(&self, answer: usize) -> Vec<f64> {
        self.points.iter().map(|point| point.as_ref().map_or(f64::NAN, |values| values[answer])).collect()
    }
}
