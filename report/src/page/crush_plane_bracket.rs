//! The bracket of the crush plane between two surfaces.

use planar_impact_app::crush_plane_bracket::{Bracket, End};
use planar_impact_app::solve::Solution;
use planar_impact_app::units::{Measure, Units};

use crate::block::{Block, Table};

/// An output of the bracket's table: its description, its name, its measure, and its value at the nominal plane.
type Shown = (&'static str, &'static str, Measure, fn(&Solution) -> f64);

const SHOWN: [Shown; 9] = [
    ("normal work W_n", "energy.normal_work", Measure::Energy, |s| s.energy.normal_work),
    ("tangential work W_t", "energy.tangential_work", Measure::Energy, |s| s.energy.tangential_work),
    ("energy loss T_L", "energy.loss", Measure::Energy, |s| s.energy.loss),
    ("impulse ratio mu", "contact.impulse_ratio", Measure::Ratio, |s| s.contact.impulse_ratio),
    ("critical impulse ratio mu0", "contact.critical_impulse_ratio", Measure::Ratio, |s| s.contact.critical_impulse_ratio),
    ("delta-V, vehicle 1", "vehicle.1.delta_v_magnitude", Measure::Speed, |s| s.vehicles[0].delta_v_magnitude),
    ("delta-V, vehicle 2", "vehicle.2.delta_v_magnitude", Measure::Speed, |s| s.vehicles[1].delta_v_magnitude),
    ("yaw rate after, vehicle 1", "vehicle.1.yaw_rate", Measure::YawRate, |s| s.vehicles[0].yaw_rate),
    ("yaw rate after, vehicle 2", "vehicle.2.yaw_rate", Measure::YawRate, |s| s.vehicles[1].yaw_rate),
];

/// Renders both ends and the nominal plane, with the change per degree.
pub fn blocks(bracket: &Bracket, nominal: &Solution, units: Units) -> Vec<Block> {
    let angle = |angle: f64| units.number(Measure::Angle, angle, 0.0);
    let [lower, upper] = [&bracket.lower, &bracket.upper];
    let plane = [angle(lower.crush_plane), angle(nominal.contact.crush_plane), angle(upper.crush_plane), String::new()];
    let mut rows = vec![row("crush plane Gamma", units.unit(Measure::Angle), plane)];
    for (what, name, measure, of_nominal) in SHOWN {
        let number = |value: f64| units.number(measure, value, nominal.scale(measure));
        let end = |end: &End| match &end.outputs {
            None => "refused".to_owned(),
            Some(outputs) => outputs.get(name).map(|value| number(*value)).unwrap_or_default(),
        };
        let slope = bracket.d.get(name).map(|slope| number(slope.to_radians())).unwrap_or_default();
        rows.push(row(what, units.unit(measure), [end(lower), number(of_nominal(nominal)), end(upper), slope]));
    }
    let table = Table::new(["between the surfaces", "unit", "lower", "nominal", "upper", "per deg"], "llrrrr", rows);
    let refused = |end: &&End| {
        let why = end.refused.as_ref()?;
        Some(Block::item(format!("Refused at {} deg: ", angle(end.crush_plane)), format!("{}.", units.sentence(&why.0))))
    };
    std::iter::once(table.into()).chain([lower, upper].iter().filter_map(refused)).collect()
}

fn row(what: &str, unit: &str, cells: [String; 4]) -> Vec<String> {
    [what.to_owned(), unit.to_owned()].into_iter().chain(cells).collect()
}
