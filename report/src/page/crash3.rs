//! The page of `crash3`: CRASH3 compared with planar mechanics.

use planar_impact_app::crash3::{Comparison, Damage, Follows, Planar, Reconstruction, Vehicle};
use planar_impact_app::plain_text::shorten;
use planar_impact_app::units::{Measure, Units, size};

use super::{Facts, SUMMARY_WIDTH, heads};
use crate::block::{Block, Table};

impl Facts for Comparison {
    /// ΔV of each vehicle.
    fn summary(&self, units: Units) -> Vec<Block> {
        let of = |vehicle: &Vehicle| {
            let delta_v = units.quantity(Measure::RoadSpeed, vehicle.delta_v_magnitude);
            Block::paragraph(format!("{}: ΔV {delta_v} by CRASH3.", shorten(&vehicle.name, SUMMARY_WIDTH)))
        };
        self.damage.iter().flat_map(|damage| &damage.vehicles).filter(|vehicle| !vehicle.barrier).map(of).collect()
    }

    fn blocks(&self, units: Units) -> Vec<Block> {
        let mut blocks: Vec<Block> = self.damage.iter().map(|damage| vehicles(damage, units).into()).collect();
        if let Some(planar) = &self.planar {
            blocks.push(assumptions(planar, units).into());
            let alone = [&planar.common_velocity, &planar.point_mass, &planar.tangential_factor];
            blocks
                .extend(alone.into_iter().filter_map(|with| with.assumption).map(|assumption| Block::item("- ", format!("{assumption}."))));
            blocks.push(Block::paragraph(
            "All from the same crush energy and the same direction of approach: each assumption alone, on planar mechanics; all three are CRASH3, \
             alpha taken from the normal of the crush plane and its correction without a limit.",
        ));
        }
        blocks
    }
}

fn number(units: Units, measure: Measure, value: f64) -> String {
    units.number(measure, value, size(measure))
}

fn vehicles(damage: &Damage, units: Units) -> Table {
    let row = |what: &str, unit: &str, value: &dyn Fn(&Vehicle) -> String| {
        let cell = |vehicle: &Vehicle| if vehicle.barrier { "fixed".to_owned() } else { value(vehicle) };
        let [one, two] = damage.vehicles.each_ref().map(cell);
        vec![what.to_owned(), unit.to_owned(), one, two]
    };
    let of = |what: &str, measure: Measure, value: fn(&Vehicle) -> f64| {
        row(what, units.unit(measure), &|vehicle| number(units, measure, value(vehicle)))
    };
    let mut rows = vec![
        row("crushed surface", "", &|vehicle| vehicle.surface.unwrap_or_default().to_owned()),
        of("crush energy", Measure::Energy, |vehicle| vehicle.crush_energy),
        of("PDOF, clockwise from ahead", Measure::Angle, |vehicle| vehicle.pdof),
        of("correction 1 + tan^2 alpha", Measure::Ratio, |vehicle| vehicle.correction),
        of("corrected energy", Measure::Energy, |vehicle| vehicle.corrected_energy),
        of("moment arm of the force", Measure::Length, |vehicle| vehicle.moment_arm),
        of("effective mass factor", Measure::Ratio, |vehicle| vehicle.effective_mass_factor),
        of("delta-V", Measure::Speed, |vehicle| vehicle.delta_v_magnitude),
    ];
    rows.extend(units.on_the_road(Measure::Speed).map(|road| of("", road, |vehicle| vehicle.delta_v_magnitude)));
    if damage.vehicles.iter().any(|vehicle| vehicle.reconstruction.is_some()) {
        let unit = units.unit(Measure::Speed);
        let back = |what: &str, value: fn(&Reconstruction) -> f64| {
            row(what, unit, &|vehicle| {
                vehicle.reconstruction.as_ref().map_or("-".to_owned(), |back| number(units, Measure::Speed, value(back)))
            })
        };
        rows.extend([
            back("separation velocity x", |back| back.separation_velocity[0]),
            back("                    y", |back| back.separation_velocity[1]),
            back("approach by CRASH3  x", |back| back.approach_velocity[0]),
            back("                    y", |back| back.approach_velocity[1]),
            of("approach of the case x", Measure::Speed, |vehicle| vehicle.approach_velocity[0]),
            of("                     y", Measure::Speed, |vehicle| vehicle.approach_velocity[1]),
        ]);
    }
    let [one, two] = heads(damage.vehicles.each_ref().map(|vehicle| vehicle.name.as_str()));
    Table::new(["CRASH3".to_owned(), "unit".to_owned(), one, two], "llrr", rows)
}

fn assumptions(planar: &Planar, units: Units) -> Table {
    let is_fixed = planar.barriers;
    let percent = |share: Option<f64>| share.map_or_else(String::new, |share| format!("{:+.1} %", 100.0 * share));
    let row = |what: &str, with: &Follows| {
        let delta_v = |i: usize| if is_fixed[i] { "fixed".to_owned() } else { number(units, Measure::Speed, with.delta_v_magnitude[i]) };
        let moves = usize::from(is_fixed[0]);
        vec![
            what.to_owned(),
            number(units, Measure::Energy, with.loss),
            percent(with.cost.loss_share),
            delta_v(0),
            delta_v(1),
            percent(with.cost.delta_v_share[moves]),
        ]
    };
    let rows = vec![
        row("planar mechanics", &planar.planar),
        row("common velocity alone", &planar.common_velocity),
        row("point mass alone", &planar.point_mass),
        row("tangential factor alone", &planar.tangential_factor),
        row("all three: CRASH3", &planar.together),
    ];
    let head = |what: &str, measure| format!("{what} {}", units.unit(measure));
    let [loss, one, two] = [head("T_L", Measure::Energy), head("dV1", Measure::Speed), head("dV2", Measure::Speed)];
    Table::new(["from the crush energy".to_owned(), loss, String::new(), one, two, String::new()], "lrrrrr", rows)
}
