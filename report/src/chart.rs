//! Figures of answers as SVG, and the figures of the paper.

mod canvas;
mod charted;
mod compare;
mod contours;
mod energy;
mod impulse;
mod intervals;
mod joined;
mod labels;
mod lines;
pub mod paper;
mod posterior;
mod profile;
mod record;
mod residuals;
#[cfg(test)]
mod samples;
mod stiffness;
mod tornado;
mod uncertainty;

use planar_impact_app::issue::Issues;
use planar_impact_app::sweep::Sweep;
use planar_impact_app::{Answer, Units};

use charted::Charted;
pub use compare::compare;
pub use energy::energy;
pub use impulse::impulse;
pub use intervals::intervals;
pub use posterior::posterior;
pub use profile::profile;
pub use record::record;
pub use residuals::residuals;
pub use stiffness::stiffness;
pub use tornado::{tornado_of_gradient, tornado_of_uncertainty};
pub use uncertainty::uncertainty;

/// Draws the chart of a sweep: lines over one input, contours over two.
///
/// # Errors
///
/// A defect: drawing into memory cannot fail.
pub fn sweep(sweep: &Answer<Sweep>, units: Units) -> Result<String, Issues> {
    let charted = Charted { sweep, units };
    let of = described(sweep);
    // A grid with one row is drawn as a line.
    if sweep.ranges.iter().filter(|range| range.si.len() > 1).count() == 2 {
        canvas::page(&title(sweep), &format!("Contours of {of}."), contours::height(&charted), |body| contours::draw(&charted, body))
    } else {
        canvas::page(&title(sweep), &format!("Lines of {of}."), lines::height(&charted), |body| lines::draw(&charted, body))
    }
}

/// The title of the case, with the input that has one value only.
fn title(sweep: &Answer<Sweep>) -> String {
    let mut title = sweep.title.clone();
    if let ([one, two], true) = (&sweep.ranges[..], sweep.ranges.iter().any(|range| range.si.len() == 1)) {
        let fixed = if one.si.len() == 1 { one } else { two };
        title = format!("{title}, {} = {} {}", fixed.parameter, fixed.shown[0], fixed.unit).trim().to_owned();
    }
    title
}

/// Says in words what a sweep shows.
fn described(sweep: &Sweep) -> String {
    let list = |names: Vec<String>| names.join(", ");
    let varied = sweep.ranges.iter().filter(|range| range.si.len() > 1).map(|range| range.parameter.to_string());
    let outputs = sweep.outputs.iter().map(|output| output.short_name());
    format!("{} over {}", list(outputs.collect()), list(varied.collect()))
}
