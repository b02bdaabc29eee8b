//! A sweep as CSV, in the reader's units.

use planar_impact_app::named::positive_zero;
use planar_impact_app::sweep::Sweep;
use planar_impact_app::units::Units;

/// Returns the records: a header with names and units, then a row for each point. A refused point has its reason and no numbers.
pub fn records(sweep: &Sweep, units: Units) -> impl Iterator<Item = Vec<String>> + '_ {
    let header = |name: String, unit: &str| if unit.is_empty() { name } else { format!("{name} [{unit}]") };
    let varied = sweep.ranges.iter().map(|range| header(range.parameter.to_string(), &range.unit));
    let computed = sweep.outputs.iter().map(|output| header(output.qualified_name(), units.unit(output.measure())));
    let head = varied.chain(computed).chain(["refused".to_owned()]).collect();
    let conversions: Vec<_> = sweep.outputs.iter().map(|output| units.conversion(output.measure())).collect();
    let columns: Vec<&[f64]> = (0..sweep.outputs.len()).map(|output| sweep.column(output)).collect();
    let row = move |point: usize| {
        let varied = (0..sweep.ranges.len()).map(|range| digits(sweep.shown(point, range)));
        let computed = columns.iter().zip(&conversions).map(|(column, conversion)| digits(positive_zero(conversion.of_si(column[point]))));
        let refused = sweep.refused[point].as_ref().map(|reason| units.sentence(&reason.0)).unwrap_or_default();
        varied.chain(computed).chain([refused]).collect()
    };
    std::iter::once(head).chain((0..sweep.len()).map(row))
}

/// Formats the shortest decimal that parses to the same number; empty for NaN.
pub(super) fn digits(value: f64) -> String {
    if value.is_finite() { format!("{value:?}") } else { String::new() }
}
