//! The separations from rest positions: points along the paths, and answers from other separations.

use planar_impact_app::reconstruct::{Reconstruction, SeparationFromRest};
use planar_impact_app::units::{Measure, Units};
use planar_impact_app::wording::degrees_of_freedom;

use super::super::points;
use crate::block::{Block, Table};
use crate::page::rounding::{probability, rounded};

/// Renders the points along each path.
pub fn points(answer: &Reconstruction, units: Units) -> Vec<Block> {
    let mut blocks = Vec::new();
    for separation in &answer.separations {
        let Some(fit) = separation.fit.as_ref().filter(|fit| !fit.points.is_empty()) else { continue };
        blocks.push(points::table(&format!("path of {}", separation.vehicle), &fit.points, units).into());
        let length = |value| units.quantity(Measure::Length, value);
        let [x, y] = fit.position.map(length);
        blocks.push(Block::item(
            "",
            format!(
                "Its slide ends {x} and {y} from the rest position, turned by {}; chi-square {:.2} with {}, probability {}. Residual: to the left of \
                 the path, in standard deviations.",
                units.quantity(Measure::Angle, fit.heading),
                fit.chi_square,
                degrees_of_freedom(fit.degrees_of_freedom),
                probability(fit.probability)
            ),
        ));
    }
    blocks
}

/// Renders the answers from every separation that leads to the same rest positions, the best first.
pub fn alternatives(answer: &Reconstruction, units: Units) -> Vec<Block> {
    if answer.by_other_separations.is_empty() {
        return Vec::new();
    }
    let all = || std::iter::once(answer).chain(&answer.by_other_separations).zip(1..);
    let motions = all().flat_map(|(answer, number)| answer.separations.iter().map(move |separation| motion(number, separation, units)));
    let in_unit = |what: &str, measure| format!("{what} {}", units.unit(measure));
    let header = [
        "separation".to_owned(),
        "vehicle".to_owned(),
        in_unit("x", Measure::Speed),
        in_unit("y", Measure::Speed),
        in_unit("yaw rate", Measure::YawRate),
    ];
    let what = "Each of these separations leads to the rest positions, and to an answer of its own:";
    let mut blocks = vec![Block::paragraph(what), Table::new(header, "rlrrr", motions.collect()).narrow().into()];
    let mut rows = Vec::new();
    for (answer, number) in all() {
        rows.push(vec![
            format!("{number} {}", answer.verdict),
            String::new(),
            String::new(),
            String::new(),
            format!("chi-square {:.2}", answer.total_chi_square()),
        ]);
        for (name, unknown) in answer.unknown.iter().filter(|(_, unknown)| !unknown.is_input) {
            let measure = units.on_the_road(unknown.measure).unwrap_or(unknown.measure);
            let interval = &unknown.interval;
            let step = unknown.sd.or_else(|| Some((interval.high? - interval.low?) / 4.0));
            let cell = |value: Option<f64>| value.map_or_else(|| "-".to_owned(), |value| rounded(measure, value, step, units));
            let unit = units.unit(measure).to_owned();
            rows.push(vec![format!("  {name}"), cell(unknown.value), cell(interval.low), cell(interval.high), unit]);
        }
    }
    let header = ["answer from separation", "value", &super::unknowns::from(answer), "to", "unit"];
    blocks.push(Table::new(header, "lrrrl", rows).narrow().into());
    blocks
}

fn motion(number: usize, separation: &SeparationFromRest, units: Units) -> Vec<String> {
    let [x, y] = separation.velocity;
    let cell = |measure, value, sd| rounded(measure, value, Some(sd), units);
    vec![
        number.to_string(),
        separation.vehicle.to_string(),
        cell(Measure::Speed, x, separation.sd[0]),
        cell(Measure::Speed, y, separation.sd[1]),
        cell(Measure::YawRate, separation.yaw_rate, separation.sd[2]),
    ]
}
