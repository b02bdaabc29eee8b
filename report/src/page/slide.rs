//! The page of `slide`, and its motion as CSV.

use planar_impact_app::case::WHEELS;
use planar_impact_app::plain_text::shorten;
use planar_impact_app::slide::{Slides, State, VehicleSlide};
use planar_impact_app::units::{Measure, Units};

use super::sweep_csv::digits;
use super::{Facts, NAME_WIDTH, SUMMARY_WIDTH};
use crate::block::{Block, Table};

/// Most rows of a path in text.
const MOST_ROWS: usize = 16;

impl Facts for Slides {
    /// Where each vehicle comes to rest.
    fn summary(&self, units: Units) -> Vec<Block> {
        let of = |vehicle: &VehicleSlide| {
            let [distance, time] =
                [(Measure::Length, vehicle.distance), (Measure::Time, vehicle.time)].map(|(measure, value)| units.quantity(measure, value));
            Block::paragraph(format!("{}: at rest after {distance} and {time}.", shorten(&vehicle.name, SUMMARY_WIDTH)))
        };
        self.vehicles.iter().map(of).collect()
    }

    fn blocks(&self, units: Units) -> Vec<Block> {
        let mut blocks = vec![rests(self, units).into()];
        for vehicle in &self.vehicles {
            blocks.push(Block::paragraph(format!("The path of {}:", shorten(&vehicle.name, NAME_WIDTH))));
            blocks.push(path(vehicle, units).into());
            if !vehicle.points.is_empty() {
                blocks.push(super::points::table("point", &vehicle.points, units).into());
                blocks.push(Block::item("", "Residual: to the left of the path, in standard deviations."));
            }
        }
        blocks
    }
}

fn rests(slides: &Slides, units: Units) -> Table {
    let row = |vehicle: &VehicleSlide| {
        let number = |measure, value| units.number(measure, value, 1.0);
        let from = if vehicle.separation_from == "solve" { "the impact" } else { "evidence" };
        vec![
            shorten(&vehicle.name, NAME_WIDTH),
            from.to_owned(),
            number(Measure::Length, vehicle.rest.position[0]),
            number(Measure::Length, vehicle.rest.position[1]),
            number(Measure::Angle, vehicle.rest.heading),
            number(Measure::Length, vehicle.distance),
            number(Measure::Time, vehicle.time),
        ]
    };
    let in_unit = |what: &str, measure| format!("{what} {}", units.unit(measure));
    let header = [
        "rest of".to_owned(),
        "separates by".to_owned(),
        in_unit("x", Measure::Length),
        in_unit("y", Measure::Length),
        in_unit("heading", Measure::Angle),
        in_unit("path", Measure::Length),
        in_unit("time", Measure::Time),
    ];
    let mut rows = Vec::new();
    for vehicle in &slides.vehicles {
        rows.push(row(vehicle));
        if let Some(miss) = vehicle.miss {
            let number = |measure, value| units.number(measure, value, 1.0);
            let [x, y] = miss.position.map(|part| number(Measure::Length, part));
            let heading = number(Measure::Angle, miss.heading);
            rows.push(vec!["  less given".to_owned(), String::new(), x, y, heading, String::new(), String::new()]);
        }
    }
    Table::new(header, "llrrrrr", rows)
}

/// Renders the motion at about evenly spaced times.
fn path(vehicle: &VehicleSlide, units: Units) -> Table {
    let number = |measure, value| units.number(measure, value, 1.0);
    let row = |state: &State| {
        vec![
            number(Measure::Time, state.t),
            number(Measure::Length, state.x),
            number(Measure::Length, state.y),
            number(Measure::Angle, state.heading),
            number(Measure::Speed, state.vx),
            number(Measure::Speed, state.vy),
            number(Measure::YawRate, state.yaw_rate),
        ]
    };
    let in_unit = |what: &str, measure| format!("{what} {}", units.unit(measure));
    let header = [
        in_unit("t", Measure::Time),
        in_unit("x", Measure::Length),
        in_unit("y", Measure::Length),
        in_unit("heading", Measure::Angle),
        in_unit("vx", Measure::Speed),
        in_unit("vy", Measure::Speed),
        in_unit("yaw rate", Measure::YawRate),
    ];
    Table::new(header, "rrrrrrr", spread(&vehicle.path, vehicle.time).map(row).collect())
}

/// Returns the states nearest to evenly spaced times, the first and the last among them.
fn spread(path: &[State], time: f64) -> impl Iterator<Item = &State> {
    let nearest = |k: usize| {
        let wanted = time * k as f64 / (MOST_ROWS - 1) as f64;
        let after = path.partition_point(|state| state.t < wanted).min(path.len().saturating_sub(1));
        if after > 0 && wanted - path[after - 1].t < path[after].t - wanted { after - 1 } else { after }
    };
    let mut places: Vec<usize> = if path.is_empty() { Vec::new() } else { (0..MOST_ROWS).map(nearest).collect() };
    places.dedup();
    places.into_iter().map(|place| &path[place])
}

/// A column: its name, its measure and its number.
type Column = (&'static str, Measure, fn(&State) -> f64);

/// Returns the motion of every vehicle as records of CSV, in the reader's units: a header, then a state in each row.
pub fn records(slides: &Slides, units: Units) -> Vec<Vec<String>> {
    const COLUMNS: [Column; 7] = [
        ("t", Measure::Time, |state| state.t),
        ("x", Measure::Length, |state| state.x),
        ("y", Measure::Length, |state| state.y),
        ("heading", Measure::Angle, |state| state.heading),
        ("vx", Measure::Speed, |state| state.vx),
        ("vy", Measure::Speed, |state| state.vy),
        ("yaw_rate", Measure::YawRate, |state| state.yaw_rate),
    ];
    let head = |name: &str, measure| format!("{name} [{}]", units.unit(measure));
    let of_wheels = WHEELS.iter().flat_map(|wheel| ["x", "y"].map(|axis| head(&format!("{wheel}.{axis}"), Measure::Length)));
    let header = ["vehicle".to_owned()].into_iter().chain(COLUMNS.iter().map(|(name, measure, _)| head(name, *measure))).chain(of_wheels);
    let mut records = vec![header.collect()];
    for vehicle in &slides.vehicles {
        for state in &vehicle.path {
            let numbers = COLUMNS.iter().map(|(_, measure, value)| units.convert(*measure, value(state)));
            let wheels = state.wheels.iter().flatten().map(|place| units.convert(Measure::Length, *place));
            records.push([vehicle.vehicle.to_string()].into_iter().chain(numbers.chain(wheels).map(digits)).collect());
        }
    }
    records
}
