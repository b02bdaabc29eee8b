//! The verb `sweep`: computes the outputs over a range of one or two inputs.

mod range;

use planar_impact::Output;
use schemars::JsonSchema;
use serde::Serialize;

use crate::answer::Answer;
use crate::case::{Case, CaseOutput, Crush, VehicleInputs};
use crate::control::Control;
use crate::issue::{Issue, Issues};
use crate::message::{Message, Sentence};
use crate::named::{Named, positive_zero};
use crate::names;
use crate::notice::Notice;
use crate::{unusual, wording};

pub use range::{MOST_POINTS, Range};

/// Maximum number of values that a sweep computes, so that every output at every point does not exhaust the memory.
pub const MOST_NUMBERS: usize = 10_000_000;

/// Inputs to vary and outputs to compute.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Options {
    /// One or two ranges, such as `contact.crush_plane=-10 deg:10 deg:1 deg`.
    pub vary: Vec<String>,
    /// The outputs by name or symbol; W_n, W_t, T_L and μ₀ if empty.
    pub of: Vec<String>,
    /// What the interface can show at most; `None` if it has no limit of its own.
    pub shown: Option<Shown>,
}

/// The most points of a sweep that an interface can show.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shown {
    /// Their number.
    pub most: usize,
    /// The option that shows them, for the message.
    pub by: &'static str,
    /// What to do about more.
    pub help: &'static str,
}

/// A case over ranges of its inputs, in SI: a column for each name, a row for each point, the last range running fastest.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Sweep {
    /// The values of the inputs at each point, the last range running fastest.
    pub vary: Named<Vec<f64>>,
    /// The outputs at each point; `null` if the point is refused.
    #[schemars(with = "Named<Vec<Option<f64>>>")]
    pub of: Named<Vec<f64>>,
    /// Reason why a point is refused; `null` if it is not.
    pub refused: Vec<Option<Sentence>>,
    /// The codes of these reasons, joined by `;`.
    pub refusal: Vec<Option<String>>,
    /// The ranges, with their values as they are written.
    #[serde(skip)]
    pub ranges: Vec<Range>,
    /// The outputs, in the order of `of`.
    #[serde(skip)]
    pub outputs: Vec<CaseOutput>,
    /// The scale of each output: values below 10⁻¹² of it are rounding.
    #[serde(skip)]
    pub scales: Vec<f64>,
}

/// Solves a case at every point of one or two ranges.
///
/// # Errors
///
/// Everything wrong with the options, or that the physics refuses every point.
pub fn sweep(case: &Case, options: &Options, control: &dyn Control) -> Result<Answer<Sweep>, Issues> {
    case.needs_everything()?;
    let mut issues = Vec::new();
    let ranges = range::read(&options.vary, &case.inputs, &mut issues);
    // An impulse ratio or moment impulse that is varied must exist in the setup.
    let first: Vec<_> = ranges.iter().map(|range| (range.parameter, range.si[0])).collect();
    let setup = if issues.is_empty() { case.inputs.set_all(&first).as_given() } else { case.setup.clone() };
    let outputs = names::outputs("--of", &options.of, &setup, &mut issues).unwrap_or_else(principal);
    let count: usize = ranges.iter().map(|range| range.si.len()).product();
    if count.saturating_mul(outputs.len()) > MOST_NUMBERS {
        let message = format!("{count} points of {} outputs exceed the {MOST_NUMBERS} numbers of a sweep", outputs.len());
        issues.push(Issue::of_call("--of", message, Some("take a larger step, or name fewer outputs".to_owned())));
    }
    if let Some(Shown { most, by, help }) = options.shown.filter(|shown| count > shown.most) {
        issues.push(Issue::of_call(by, format!("a table of {count} rows exceeds {most} rows"), Some(help.to_owned())));
    }
    if !issues.is_empty() {
        return Err(Issues::of_call(issues));
    }
    let mut points =
        Points { columns: vec![Vec::with_capacity(count); outputs.len()], scales: vec![0.0; outputs.len()], refused: Vec::new() };
    for at in 0..count {
        control.proceed(at, count)?;
        points.add(case, &ranges, &outputs, at);
    }
    points.check()?;
    let varied = |(i, range): (usize, &Range)| {
        let value = |at: usize| positive_zero(range.si[place(&ranges, at, i)]);
        (range.parameter, (0..count).map(value).collect())
    };
    let sweep = Sweep {
        vary: ranges.iter().enumerate().map(varied).collect(),
        of: outputs.iter().zip(points.columns).collect(),
        refusal: points.refused.iter().map(|refused| refused.as_ref().map(|refused| refused.codes.clone())).collect(),
        refused: points.refused.into_iter().map(|refused| refused.map(|refused| Sentence(refused.reason))).collect(),
        ranges,
        outputs,
        scales: points.scales,
    };
    let notices = notices(case, &sweep.ranges);
    Ok(case.answer(sweep, notices))
}

/// Notes units that are assumed, and warns of sizes at the ends of the ranges that no road vehicle has.
fn notices(case: &Case, ranges: &[Range]) -> Vec<Notice> {
    let assumed = ranges.iter().filter(|range| range.is_unit_assumed).map(|Range { parameter, unit, .. }| {
        Notice::note("unit-assumed", parameter.to_string(), format!("--vary {parameter} has no unit: {unit} assumed"))
    });
    let mut found: Vec<Notice> = assumed.collect();
    for at in [<[f64]>::first, <[f64]>::last] {
        let values: Vec<_> = ranges.iter().filter_map(|range| Some((range.parameter, *at(&range.si)?))).collect();
        let inputs = case.inputs.set_all(&values);
        let vehicles = inputs.vehicles.iter().zip(["vehicle.1", "vehicle.2"]);
        let of_vehicles = vehicles.filter_map(|(vehicle, path)| Some((vehicle.as_ref()?, path))).flat_map(|(vehicle, path)| {
            let VehicleInputs { mass, velocity, yaw_rate, impact_center, .. } = vehicle;
            unusual::sizes(path, *mass, vehicle.yaw_inertia(), *velocity, *yaw_rate, impact_center.length())
        });
        for notice in of_vehicles.chain(unusual::friction(&inputs.contact.impulse_ratio)) {
            if !case.notices.0.iter().chain(&found).any(|known| known.is_alike(&notice)) {
                found.push(notice);
            }
        }
    }
    found
}

/// Returns the outputs of the paper's Table 2 and Figure 4.
fn principal() -> Vec<CaseOutput> {
    [Output::NormalWork, Output::TangentialWork, Output::Loss, Output::CriticalImpulseRatio].map(CaseOutput::Impact).into()
}

/// Returns the index of a point within a range; the last range varies fastest.
fn place(ranges: &[Range], point: usize, range: usize) -> usize {
    match ranges {
        [_, inner] if range == 0 => point / inner.si.len(),
        [_, inner] => point % inner.si.len(),
        _ => point,
    }
}

/// The points computed so far.
struct Points {
    columns: Vec<Vec<f64>>,
    scales: Vec<f64>,
    refused: Vec<Option<Refused>>,
}

/// Reason why a point has no outputs.
struct Refused {
    codes: String,
    reason: Message,
}

impl Points {
    fn add(&mut self, case: &Case, ranges: &[Range], outputs: &[CaseOutput], at: usize) {
        let values: Vec<_> = ranges.iter().enumerate().map(|(i, range)| (range.parameter, range.si[place(ranges, at, i)])).collect();
        let setup = case.inputs.set_all(&values).as_given();
        let point = match setup.crush.iter().flatten().find_map(Crush::unfit) {
            Some(reason) => Err(Refused { codes: "no-crush".to_owned(), reason: reason.into() }),
            None => setup.solve().map_err(|refusals| Refused { codes: wording::codes(&refusals), reason: wording::reasons(&refusals) }),
        };
        for ((column, scale), &output) in self.columns.iter_mut().zip(&mut self.scales).zip(outputs) {
            let value = point.as_ref().ok().and_then(|found| found.get(output)).unwrap_or(f64::NAN);
            column.push(positive_zero(value));
            if let Ok(found) = &point {
                *scale = scale.max(found.scale(output.measure()));
            }
        }
        self.refused.push(point.err());
    }

    /// Checks that at least one point has outputs.
    fn check(&self) -> Result<(), Issues> {
        let Some(Some(first)) = self.refused.first() else { return Ok(()) };
        if self.refused.iter().any(Option::is_none) {
            return Ok(());
        }
        let message = match self.refused.len() {
            1 => Message::from("the only point is refused: "),
            count => Message::from(format!("each of the {count} points is refused, the first because ")),
        };
        let issue = Issue::of_call("--vary", message.join(first.reason.clone()), None);
        Err(Issues::without_source(crate::issue::Cause::Physics, vec![issue]))
    }
}

impl Sweep {
    /// Returns the number of points.
    pub fn len(&self) -> usize {
        self.refused.len()
    }

    /// Returns `true` if there are no points.
    pub fn is_empty(&self) -> bool {
        self.refused.is_empty()
    }

    /// Returns an output at every point, in SI; NaN where the point is refused.
    pub fn column(&self, output: usize) -> &[f64] {
        self.of.iter().nth(output).map_or(&[], |(_, column)| column)
    }

    /// Returns the value of a varied input at a point, as written.
    pub fn shown(&self, point: usize, range: usize) -> f64 {
        self.ranges[range].shown[place(&self.ranges, point, range)]
    }

    /// Returns `true` if any point is refused.
    pub fn has_refused(&self) -> bool {
        self.refused.iter().any(Option::is_some)
    }
}
