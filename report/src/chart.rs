//! Charts as SVG: a sweep, and the figures of the paper.

mod canvas;
mod charted;
mod contours;
mod labels;
mod lines;
pub mod paper;
mod record;
mod uncertainty;

use planar_impact_app::issue::Issues;
use planar_impact_app::sweep::Sweep;
use planar_impact_app::{Answer, Units};

use charted::Charted;
pub use record::record;
pub use uncertainty::uncertainty;

const LONGEST_TITLE: usize = 80;

/// Draws the chart of a sweep: lines over one input, contours over two.
///
/// # Errors
///
/// A defect: drawing into memory cannot fail.
pub fn sweep(sweep: &Answer<Sweep>, units: Units) -> Result<String, Issues> {
    let charted = Charted { sweep, units };
    // A grid with one row is drawn as a line.
    if sweep.ranges.iter().filter(|range| range.si.len() > 1).count() == 2 {
        canvas::page(&title(sweep), contours::height(&charted), |body| contours::draw(&charted, body))
    } else {
        canvas::page(&title(sweep), lines::height(&charted), |body| lines::draw(&charted, body))
    }
}

/// The title of the case, with the input that has one value only.
fn title(sweep: &Answer<Sweep>) -> String {
    let mut title = sweep.title.clone();
    if let ([one, two], true) = (&sweep.ranges[..], sweep.ranges.iter().any(|range| range.si.len() == 1)) {
        let fixed = if one.si.len() == 1 { one } else { two };
        title = format!("{title}, {} = {} {}", fixed.parameter, fixed.shown[0], fixed.unit).trim().to_owned();
    }
    shortened(&title)
}

/// Returns a title that fits the page.
fn shortened(title: &str) -> String {
    if title.chars().count() <= LONGEST_TITLE { title.to_owned() } else { title.chars().take(LONGEST_TITLE - 1).chain(['…']).collect() }
}
