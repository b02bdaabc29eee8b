//! Guaranteed ranges of the unknowns.

use planar_impact_app::reconstruct::{Guaranteed, Reconstruction};
use planar_impact_app::units::{Measure, Units, trim};

use crate::block::{Block, Table};
use crate::page::rounding::{Toward, ended};

/// Renders the guaranteed range of each unknown, rounded outward, and the values that are found near its ends; nothing without ranges.
pub fn blocks(answer: &Reconstruction, units: Units) -> Vec<Block> {
    let all: Vec<_> = answer.estimates().filter_map(|of| Some((of.name, of.measure, of.guaranteed?))).collect();
    let Some((_, _, first)) = all.first() else { return Vec::new() };
    let rows = all.iter().flat_map(|(name, measure, range)| {
        let road = units.on_the_road(*measure).map(|road| row("", road, range, units));
        [Some(row(name, *measure, range, units)), road].into_iter().flatten()
    });
    let table = Table::new(["guaranteed", "from", "to", "found from", "to", "unit"], "lrrrrl", rows.collect()).narrow();
    let what = format!(
        "Outside of its guaranteed range no value of an unknown meets the evidence: exact evidence exactly, readings within half of their step, and what has \
         a standard deviation and no limits within {} of them.",
        trim(first.bounds_sd)
    );
    let is_tight = all.iter().all(|(_, _, range)| range.is_tight);
    let open = (!is_tight).then(|| Block::paragraph("Where a value that is found is not at the end, no narrower range is proven."));
    [Block::from(table), Block::paragraph(what)].into_iter().chain(open).collect()
}

fn row(name: &str, measure: Measure, range: &Guaranteed, units: Units) -> Vec<String> {
    let width = range.high - range.low;
    let end = |value: f64, toward: Toward| ended(measure, value, width, toward, units);
    let ends = [end(range.low, Toward::Below), end(range.high, Toward::Above)];
    let found = [range.low_attained, range.high_attained].map(|value| end(value, Toward::Nearest));
    std::iter::once(name.to_owned()).chain(ends).chain(found).chain([units.unit(measure).to_owned()]).collect()
}
