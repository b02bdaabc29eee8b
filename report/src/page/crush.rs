//! The page of `crush`.

use planar_impact_app::crush::{CrushAnswer, Stiffness, VehicleCrush};
use planar_impact_app::plain_text::shorten;
use planar_impact_app::units::{Measure, Units};

use planar_impact::crush::MOST_FORCE_IMBALANCE;

use super::{Facts, NAME_WIDTH, SUMMARY_WIDTH, heads};
use crate::block::{Block, Table};

impl Facts for CrushAnswer {
    /// The energy of each crush.
    fn summary(&self, units: Units) -> Vec<Block> {
        let of = |(name, vehicle): (&String, &VehicleCrush)| {
            let speed = units.quantity(Measure::RoadSpeed, vehicle.equivalent_energy_speed);
            let energy = units.quantity(Measure::Energy, vehicle.crush_energy);
            Block::paragraph(format!("{}: crush energy {energy}, equivalent energy speed {speed}.", shorten(name, SUMMARY_WIDTH)))
        };
        let vehicles = self.names.iter().zip(&self.vehicles).filter_map(|(name, vehicle)| Some((name, vehicle.as_ref()?)));
        vehicles.filter(|(_, vehicle)| !vehicle.barrier).map(of).collect()
    }

    fn blocks(&self, units: Units) -> Vec<Block> {
        let mut blocks = vec![vehicles(self, units).into()];
        blocks
            .extend(self.vehicles.iter().flatten().filter(|vehicle| !vehicle.zones.is_empty()).map(|vehicle| zones(vehicle, units).into()));
        blocks.push(Block::paragraph(
            "E_C = d0^2 K1 + d0 d1 K2 + d1^2 K3, with the depth linear between two stations. The normal force is the integral of A + B C over the \
             width; at the PDOF it is divided by the cosine of the angle from the perpendicular of the surface, as in CRASH3.",
        ));
        blocks.extend(self.force_imbalance.map(|imbalance| {
            let (percent, most) = (100.0 * imbalance, 100.0 * MOST_FORCE_IMBALANCE);
            Block::paragraph(format!(
                "Balance of crush forces: the larger exceeds the smaller by {percent:.0} %; EDCRASH's diagnostics accept {most:.0} %."
            ))
        }));
        blocks
    }
}

/// One of the forms in which the field gives a stiffness.
type Form = (&'static str, Measure, fn(&Stiffness) -> Option<f64>);

const FORMS: [Form; 5] = [
    ("stiffness d0", Measure::RootForce, |stiffness| stiffness.d0),
    ("          d1", Measure::RootForcePerLength, |stiffness| stiffness.d1),
    ("          A = d0 d1", Measure::ForcePerWidth, |stiffness| stiffness.force),
    ("          B = d1^2", Measure::ForcePerArea, |stiffness| stiffness.force_per_depth),
    ("          G = d0^2/2", Measure::Force, |stiffness| stiffness.without_crush),
];

fn vehicles(answer: &CrushAnswer, units: Units) -> Table {
    let row = |what: &str, unit: &str, value: &dyn Fn(&VehicleCrush) -> String| {
        let cell = |vehicle: &Option<VehicleCrush>| match vehicle {
            Some(vehicle) if !vehicle.barrier => value(vehicle),
            _ => "-".to_owned(),
        };
        let [one, two] = answer.vehicles.each_ref().map(cell);
        vec![what.to_owned(), unit.to_owned(), one, two]
    };
    let of = |what: &str, measure: Measure, value: fn(&VehicleCrush) -> f64| {
        row(what, units.unit(measure), &|vehicle| units.number(measure, value(vehicle), 0.0))
    };
    // A power of a length has no measure.
    let length = units.unit(Measure::Length);
    let moment = |what: &str, power: usize| {
        let unit = if power == 1 { length.to_owned() } else { format!("{length}^{power}") };
        let factor = libm::pow(units.convert(Measure::Length, 1.0), power as f64);
        row(what, &unit, &|vehicle| format!("{:.4}", vehicle.moments[power - 1] * factor))
    };
    let mut rows = vec![
        of("width", Measure::Length, |vehicle| vehicle.width),
        row("depths", "", &|vehicle| vehicle.depths.to_string()),
        of("mean depth", Measure::Length, |vehicle| vehicle.mean_depth),
        moment("K1 = w/2", 1),
        moment("K2", 2),
        moment("K3", 3),
        row("form factor", "", &|vehicle| vehicle.form_factor.map_or("-".to_owned(), |factor| units.number(Measure::Ratio, factor, 0.0))),
    ];
    for (name, measure, value) in FORMS {
        rows.push(row(name, units.unit(measure), &|vehicle| {
            value(&vehicle.stiffness).map_or("zones".to_owned(), |value| units.number(measure, value, 0.0))
        }));
    }
    if answer.vehicles.iter().flatten().any(|vehicle| vehicle.saturation.is_some()) {
        rows.push(row("force constant beyond", length, &|vehicle| {
            vehicle.saturation.map_or("-".to_owned(), |depth| units.number(Measure::Length, depth, 0.0))
        }));
    }
    let known = |what: &str, measure: Measure, value: fn(&VehicleCrush) -> Option<f64>| {
        row(what, units.unit(measure), &|vehicle| value(vehicle).map_or("-".to_owned(), |value| units.number(measure, value, 0.0)))
    };
    rows.push(known("crush force, normal", Measure::Force, |vehicle| vehicle.crush_force));
    rows.push(known("             at the PDOF", Measure::Force, |vehicle| vehicle.crush_force_at_pdof));
    rows.push(known("PDOF, clockwise from ahead", Measure::Angle, |vehicle| vehicle.pdof));
    rows.push(row("surface", "", &|vehicle| vehicle.surface.unwrap_or("-").to_owned()));
    rows.push(of("crush energy E_C", Measure::Energy, |vehicle| vehicle.crush_energy));
    rows.push(of("equivalent energy speed", Measure::Speed, |vehicle| vehicle.equivalent_energy_speed));
    rows.extend(units.on_the_road(Measure::Speed).map(|road| of("", road, |vehicle| vehicle.equivalent_energy_speed)));
    let [one, two] = heads(answer.names.each_ref().map(String::as_str));
    Table::new(["crush".to_owned(), "unit".to_owned(), one, two], "llrr", rows)
}

/// Renders the zones of a vehicle with several.
fn zones(vehicle: &VehicleCrush, units: Units) -> Table {
    let number = |measure, value: Option<f64>| value.map_or("-".to_owned(), |value| units.number(measure, value, 0.0));
    let rows = vehicle.zones.iter().enumerate().map(|(place, zone)| {
        let end = zone.to.map_or("the end".to_owned(), |border| units.quantity(Measure::Length, border));
        vec![
            format!("{} to {end}", place + 1),
            number(Measure::Length, Some(zone.width)),
            number(Measure::RootForce, zone.stiffness.d0),
            number(Measure::RootForcePerLength, zone.stiffness.d1),
            number(Measure::Energy, Some(zone.crush_energy)),
        ]
    });
    let header = [
        format!("zone of {}", shorten(&vehicle.name, NAME_WIDTH)),
        format!("width {}", units.unit(Measure::Length)),
        format!("d0 {}", units.unit(Measure::RootForce)),
        format!("d1 {}", units.unit(Measure::RootForcePerLength)),
        format!("E_C {}", units.unit(Measure::Energy)),
    ];
    Table::new(header, "lrrrr", rows.collect())
}
