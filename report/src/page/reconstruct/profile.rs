//! The profile of the likelihood.

use planar_impact_app::reconstruct::{ProfileLevel, Reconstruction};
use planar_impact_app::units::{Measure, Units};

use crate::block::{Block, Table};
use crate::page::rounding::{rounded, share};

/// Heights of the profile that the page shows: those of one and of three standard deviations, if the evidence is linear in the unknowns.
const HEIGHTS: [f64; 2] = [1.0, 9.0];

/// Renders how far each quantity goes until the best fit of everything else is worse by a height; nothing without profiles.
pub fn blocks(answer: &Reconstruction, units: Units) -> Vec<Block> {
    let all: Vec<_> = answer.estimates().filter_map(|of| Some((of, shown(of.profile?)?))).collect();
    let Some((_, levels)) = all.first() else { return Vec::new() };
    let [near, far] = levels.map(|level| format!("{} from", share(level.level)));
    let rows = all.iter().flat_map(|(of, levels)| {
        let road = units.on_the_road(of.measure).map(|road| row("", road, of.sd, levels, units));
        [Some(row(of.name, of.measure, of.sd, levels, units)), road].into_iter().flatten()
    });
    let table = Table::new(["profile", &near, "to", &far, "to", "unit"], "lrrrrl", rows.collect()).narrow();
    let what = "Chi-square of the best fit of everything else rises by 1 up to the inner ends, and by 9 up to the outer ones.";
    vec![table.into(), Block::paragraph(what)]
}

fn shown(levels: &[ProfileLevel]) -> Option<[&ProfileLevel; 2]> {
    let [near, far] = HEIGHTS.map(|height| levels.iter().find(|level| level.chi_square == height));
    Some([near?, far?])
}

fn row(name: &str, measure: Measure, sd: Option<f64>, levels: &[&ProfileLevel; 2], units: Units) -> Vec<String> {
    let width = levels[0].high.zip(levels[0].low).map(|(high, low)| 0.5 * (high - low));
    let end = |end: Option<f64>| end.map_or_else(|| "-".to_owned(), |end| rounded(measure, end, sd.or(width), units));
    let ends = levels.iter().flat_map(|level| [end(level.low), end(level.high)]);
    std::iter::once(name.to_owned()).chain(ends).chain([units.unit(measure).to_owned()]).collect()
}
