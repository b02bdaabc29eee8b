//! The sweep as data: CSV in the units of the text, JSON in SI.

use serde::Serialize;

use super::Sweep;
use crate::exit::Failure;
use crate::named::{Named, plain};

/// CSV: a header with names and units, then a row for each point. A refused one has its reason and no numbers.
///
/// # Errors
///
/// A defect: writing to memory cannot fail.
pub fn csv(sweep: &Sweep<'_>) -> Result<String, Failure> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let defect = |error: &dyn std::fmt::Display| Failure::Data(error.to_string());
    let header = |name: String, unit: &str| if unit.is_empty() { name } else { format!("{name} [{unit}]") };
    let varied = sweep.ranges.iter().map(|range| header(range.parameter.to_string(), &range.unit));
    let answers = sweep.answers.iter().map(|answer| header(answer.to_string(), sweep.units.unit(answer.measure())));
    writer.write_record(varied.chain(answers).chain(["refused".to_owned()])).map_err(|error| defect(&error))?;
    let conversions: Vec<_> = sweep.answers.iter().map(|answer| sweep.units.conversion(answer.measure())).collect();
    for (at, point) in sweep.points.iter().enumerate() {
        let mut record: Vec<String> = sweep.at(at).map(|(range, i)| digits(range.shown[i])).collect();
        match point {
            Ok(values) => {
                record.extend(values.iter().zip(&conversions).map(|(value, conversion)| digits(plain(conversion.of_si(*value)))));
                record.push(String::new());
            }
            Err(refused) => {
                record.extend(sweep.answers.iter().map(|_| String::new()));
                record.push(refused.reason.clone());
            }
        }
        writer.write_record(record).map_err(|error| defect(&error))?;
    }
    let bytes = writer.into_inner().map_err(|error| defect(&error))?;
    String::from_utf8(bytes).map_err(|error| defect(&error))
}

/// The shortest decimal that is this number; nothing for what is no number.
fn digits(value: f64) -> String {
    if value.is_finite() { format!("{value:?}") } else { String::new() }
}

/// The JSON document of `sweep`: a column for each name, a row for each point.
#[derive(Serialize)]
struct Document<'a> {
    schema: u32,
    title: &'a str,
    vary: Named<Vec<f64>>,
    /// `null` where the point is refused.
    of: Named<Vec<f64>>,
    /// Why a point is refused, `null` where it is not.
    refused: Vec<Option<&'a str>>,
    #[serde(skip_serializing_if = "<[String]>::is_empty")]
    notes: &'a [String],
}

/// JSON, in SI.
///
/// # Errors
///
/// A defect: writing to memory cannot fail.
pub fn json(sweep: &Sweep<'_>) -> Result<String, Failure> {
    let points = || 0..sweep.points.len();
    let varied = sweep.ranges.iter().enumerate().map(|(at, range)| {
        let value = |point: usize| sweep.at(point).nth(at).map_or(f64::NAN, |(range, i)| plain(range.si[i]));
        (range.parameter, points().map(value).collect())
    });
    let document = Document {
        schema: 1,
        title: &sweep.case.title,
        vary: varied.collect(),
        of: sweep.answers.iter().enumerate().map(|(at, answer)| (answer, sweep.column(at))).collect(),
        refused: sweep.points.iter().map(|point| point.as_ref().err().map(|refused| refused.reason.as_str())).collect(),
        notes: &sweep.case.notes,
    };
    serde_json::to_string(&document).map(|text| text + "\n").map_err(|error| Failure::Data(error.to_string()))
}
