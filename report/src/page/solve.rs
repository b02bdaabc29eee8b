//! The page of `solve`.

use planar_impact_app::plain_text::shorten;
use planar_impact_app::solve::{EnergyBounds, ImpulseRatioGiven, Solution, TangentialLaw, Vehicle};
use planar_impact_app::units::{Measure, Units, beyond_rounding};

use super::{Facts, SUMMARY_WIDTH, crush_plane_bracket, heads};
use crate::block::{Block, Table};

impl Facts for Solution {
    /// What each vehicle undergoes, and the energy lost.
    fn summary(&self, units: Units) -> Vec<Block> {
        let road = |value: f64| units.quantity(Measure::RoadSpeed, beyond_rounding(value, self.scale(Measure::RoadSpeed)));
        let of = |vehicle: &Vehicle| {
            format!(
                "{}: ΔV {}, principal direction of force {}; from {} to {}.",
                shorten(&vehicle.name, SUMMARY_WIDTH),
                road(vehicle.delta_v_magnitude),
                units.quantity(Measure::Angle, beyond_rounding(vehicle.pdof, 1.0)),
                road(vehicle.before.speed()),
                road(vehicle.speed()),
            )
        };
        let moving = self.vehicles.iter().filter(|vehicle| !vehicle.barrier);
        let share = loss_share(self).map_or_else(String::new, |share| format!(", {:.0} % of what there was", 100.0 * share));
        let lost = format!("Energy lost: {}{share}.", units.quantity(Measure::Energy, loss(self)));
        moving.map(of).chain([lost]).map(Block::paragraph).collect()
    }

    fn blocks(&self, units: Units) -> Vec<Block> {
        let mut blocks = Vec::from(tables(self, units));
        blocks.extend(self.crush_plane_bracket.iter().flat_map(|bracket| crush_plane_bracket::blocks(bracket, self, units)));
        blocks.extend(remarks(self, units));
        blocks
    }
}

/// Returns the energy that is lost, 0 if it is rounding.
fn loss(solution: &Solution) -> f64 {
    beyond_rounding(solution.energy.loss, solution.scale(Measure::Energy))
}

/// Returns the share of the energy that is lost, 0 if the loss is rounding.
pub(crate) fn loss_share(solution: &Solution) -> Option<f64> {
    solution.energy.loss_share.map(|share| if loss(solution) == 0.0 { 0.0 } else { share })
}

fn tables(solution: &Solution, units: Units) -> [Block; 3] {
    [vehicles(solution, units), contact(solution, units), energies(solution, units)].map(Block::from)
}

fn vehicles(solution: &Solution, units: Units) -> Table {
    let row = |what: &str, measure: Measure, scale: f64, value: fn(&Vehicle) -> f64| {
        let cell = |vehicle: &Vehicle| match vehicle.barrier {
            true => "fixed".to_owned(),
            false if value(vehicle).is_nan() => "-".to_owned(),
            false => units.number(measure, value(vehicle), scale),
        };
        let [one, two] = solution.vehicles.each_ref().map(cell);
        vec![what.to_owned(), units.unit(measure).to_owned(), one, two]
    };
    let speed = solution.scale(Measure::Speed);
    let mut rows = vec![
        row("before: velocity x", Measure::Speed, speed, |v| v.before.velocity[0]),
        row("        velocity y", Measure::Speed, speed, |v| v.before.velocity[1]),
        row("        yaw rate", Measure::YawRate, 1.0, |v| v.before.yaw_rate),
        row("after:  velocity x", Measure::Speed, speed, |v| v.velocity[0]),
        row("        velocity y", Measure::Speed, speed, |v| v.velocity[1]),
        row("        yaw rate", Measure::YawRate, 1.0, |v| v.yaw_rate),
        row("delta-V", Measure::Speed, speed, |v| v.delta_v_magnitude),
    ];
    rows.extend(units.on_the_road(Measure::Speed).map(|road| row("", road, speed, |v| v.delta_v_magnitude)));
    rows.push(row("PDOF, clockwise from ahead", Measure::Angle, 1.0, |v| v.pdof));
    rows.extend(crush(solution, units));
    rows.extend(braking(solution, units));
    let [one, two] = heads(solution.vehicles.each_ref().map(|vehicle| vehicle.name.as_str()));
    Table::new(["".to_owned(), "unit".to_owned(), one, two], "llrr", rows)
}

/// Renders a quantity that only some vehicles have.
fn of_some(solution: &Solution, units: Units, what: &str, measure: Measure, value: fn(&Vehicle) -> Option<f64>) -> Vec<String> {
    let cell = |vehicle: &Vehicle| value(vehicle).map_or("-".to_owned(), |value| units.number(measure, value, 0.0));
    let [one, two] = solution.vehicles.each_ref().map(cell);
    vec![what.to_owned(), units.unit(measure).to_owned(), one, two]
}

/// Renders crush energy and equivalent speed; nothing if no vehicle has a crush.
fn crush(solution: &Solution, units: Units) -> Vec<Vec<String>> {
    if solution.vehicles.iter().all(|vehicle| vehicle.crush_energy.is_none()) {
        return Vec::new();
    }
    vec![
        of_some(solution, units, "crush: mean depth", Measure::Length, |v| v.mean_depth),
        of_some(solution, units, "       crush energy", Measure::Energy, |v| v.crush_energy),
        of_some(solution, units, "       equivalent speed", Measure::Speed, |v| v.equivalent_energy_speed),
    ]
}

/// Renders the braking before the impact; nothing if no vehicle has skids.
fn braking(solution: &Solution, units: Units) -> Vec<Vec<String>> {
    if solution.vehicles.iter().all(|vehicle| vehicle.braking.is_none()) {
        return Vec::new();
    }
    let row = |what: &str, measure, value| of_some(solution, units, what, measure, value);
    let mut rows = vec![row("braking: speed at its start", Measure::Speed, |v| Some(v.braking.as_ref()?.speed))];
    rows.extend(units.on_the_road(Measure::Speed).map(|road| row("", road, |v| Some(v.braking.as_ref()?.speed))));
    rows.extend([
        row("         speed at the impact", Measure::RoadSpeed, |v| Some(v.braking.as_ref()?.impact_speed)),
        row("         distance to the impact", Measure::Length, |v| Some(v.braking.as_ref()?.distance)),
        row("         time to the impact", Measure::Time, |v| Some(v.braking.as_ref()?.time)),
    ]);
    rows
}

/// Returns `true` if the vehicles are point masses, so that the velocities of the contact are those of their centers.
fn is_of_points(solution: &Solution) -> bool {
    solution.vehicles.iter().all(|vehicle| vehicle.yaw_rate.is_nan())
}

fn contact(solution: &Solution, units: Units) -> Table {
    let contact = &solution.contact;
    let row = |what: &str, measure: Measure, normal: f64, tangential: Option<f64>| {
        let number = |value| units.number(measure, value, solution.scale(measure));
        vec![what.to_owned(), units.unit(measure).to_owned(), number(normal), tangential.map(number).unwrap_or_default()]
    };
    let approach =
        if is_of_points(solution) { "approach velocity of the centers of mass" } else { "approach velocity at the impact center" };
    let (v, s, p, energy) = (&contact.approach, &contact.separation, &contact.impulse, &solution.energy);
    let mut rows = vec![
        row(approach, Measure::Speed, v.normal, Some(v.tangential)),
        row("separation velocity", Measure::Speed, s.normal, Some(s.tangential)),
        row("impulse on vehicle 1", Measure::Impulse, p.normal, Some(p.tangential)),
        row("work of the impulse, W_n and W_t", Measure::Energy, energy.normal_work, Some(energy.tangential_work)),
    ];
    if let Some((moment, work)) = p.moment.zip(energy.moment_work) {
        let moment = units.number(Measure::MomentImpulse, moment, 0.0);
        let unit = units.unit(Measure::MomentImpulse).to_owned();
        rows.push(vec!["moment impulse on vehicle 1".to_owned(), unit, moment, String::new()]);
        rows.push(row("work of the moment impulse, W_m", Measure::Energy, work, None));
    }
    Table::new(["contact", "unit", "normal", "tangential"], "llrr", rows)
}

fn energies(solution: &Solution, units: Units) -> Table {
    let energy = &solution.energy;
    let row = |what: &str, value: f64| {
        let number = units.number(Measure::Energy, value, solution.scale(Measure::Energy));
        vec![what.to_owned(), units.unit(Measure::Energy).to_owned(), number]
    };
    let share = loss_share(solution).map_or_else(String::new, |share| format!(" ({:.1} %)", 100.0 * share));
    let rows = vec![
        row("kinetic energy before", energy.before),
        row("kinetic energy after", energy.after),
        row(&format!("energy loss T_L{share}"), energy.loss),
    ];
    Table::new(["energy", "unit", ""], "llr", rows)
}

/// Describes the coefficients, the tangential law, and the limits of the coefficients.
fn remarks(solution: &Solution, units: Units) -> Vec<Block> {
    let ratio = |value: f64| units.number(Measure::Ratio, value, 1.0);
    let contact = &solution.contact;
    let given = |what: &str| format!("{what} {}", contact.impulse_ratio_parameter.map(ratio).unwrap_or_default());
    // The critical ratio of the document is Brach's, whichever law is in force; by the other one sliding ends at a ratio of its own.
    let (law, by_law, critical) = match contact.tangential_law {
        TangentialLaw::Brach => ("Brach", "", "critical mu0"),
        TangentialLaw::KudlichSlibar => ("Kudlich-Slibar", " by this law", "critical mu0 by Brach's law"),
    };
    let kind = match contact.impulse_ratio_given {
        ImpulseRatioGiven::Critical => format!("critical{by_law}"),
        ImpulseRatioGiven::Number => "given".to_owned(),
        ImpulseRatioGiven::OfCritical => format!("{} of critical{by_law}", given("").trim()),
        ImpulseRatioGiven::Friction if contact.slides_by_friction() => given("limited by friction"),
        ImpulseRatioGiven::Friction => format!("critical{by_law}, less than {}", given("friction")),
    };
    if contact.model.is_some() {
        let between = if is_of_points(solution) { "centers of mass" } else { "impact centers" };
        let along = units.quantity(Measure::Angle, contact.crush_plane);
        let restitution = if contact.restitution.is_finite() { ratio(contact.restitution) } else { "none".to_owned() };
        return vec![Block::Verbatim(format!(
            "By momentum alone. The normal is along the impulse, at {along} from x;\nrestitution along it, between the {between}: {restitution}."
        ))];
    }
    let plane = units.quantity(Measure::Angle, contact.crush_plane);
    let of_impulse = format!("Impulse ratio mu = {} ({kind}),", ratio(contact.impulse_ratio));
    let critical = format!("{critical} = {}.", ratio(contact.critical_impulse_ratio));
    let between = if of_impulse.len() + critical.len() < 80 { " " } else { "\n" };
    let restitution = ratio(contact.restitution);
    let coefficients =
        format!("Crush plane Gamma = {plane}, restitution e = {restitution}, law of {law}.\n{of_impulse}{between}{critical}");
    let bounds = contact.no_energy_gain.as_ref().map(|bounds| energy_bounds(bounds, &ratio));
    vec![Block::Verbatim(coefficients + &bounds.unwrap_or_default())]
}

fn energy_bounds(bounds: &EnergyBounds, ratio: &dyn Fn(f64) -> String) -> String {
    let end = |bound: Option<f64>| bound.map_or_else(|| "any".to_owned(), ratio);
    let up_to = |bound: f64| if bound >= 1.0 { "1".to_owned() } else { ratio(bound) };
    format!(
        "\nNo energy is gained up to e = {} here (up to {} for any approach),\nnor, at this e, for mu from {} to {}.",
        up_to(bounds.restitution),
        up_to(bounds.restitution_for_any_approach),
        end(bounds.least_impulse_ratio),
        end(bounds.greatest_impulse_ratio),
    )
}
