//! What is known of a crash.

use planar_impact::Side;
use planar_impact::reconstruct::{Measurable, Uncertainty};

use super::Given;
use super::measured::{Amount, Measured, is_folder};
use crate::case::knowledge::{Known, measure_of, names_of_evidence};
use crate::case::parameter::number;
use crate::case::vehicle::VehicleInputs;
use crate::document::{Field, Table, Value};
use crate::quantity::nearest;

/// A piece of evidence, so far without the energy of the crush, and its place in the file.
pub(super) struct Piece<'a> {
    pub(super) of: Measurable,
    pub(super) place: Field<'a>,
    measured: Measured,
}

impl Piece<'_> {
    /// Its value, if it stands in the file.
    pub(super) fn number(&self) -> Option<f64> {
        match self.measured.amount {
            Amount::Number(value) => Some(value),
            Amount::FromCrush => None,
        }
    }

    /// Whether it may be off by nothing.
    pub(super) fn is_exact(&self) -> bool {
        self.number().is_some_and(|value| self.measured.spread.of(value) == Uncertainty::Exact)
    }
}

impl Given {
    /// Every piece of evidence of the table, by its dotted name or symbol.
    pub(super) fn evidence<'a>(&self, table: &Table<'a>) -> Option<Vec<Piece<'a>>> {
        let mut found = Vec::new();
        let sound = self.walk_evidence(table, "", &mut found);
        sound.then_some(found)
    }

    fn walk_evidence<'a>(&self, table: &Table<'a>, above: &str, found: &mut Vec<Piece<'a>>) -> bool {
        let mut sound = true;
        for (key, field) in table.fields() {
            let name = if above.is_empty() { key.to_owned() } else { format!("{above}.{key}") };
            sound &= self.piece(&name, field, found).is_some();
        }
        sound
    }

    fn piece<'a>(&self, name: &str, field: Field<'a>, found: &mut Vec<Piece<'a>>) -> Option<()> {
        if let Some(of) = named(name) {
            let place = field.clone();
            let measured = self.measured(field, measure_of(of))?;
            found.push(Piece { of, place, measured });
            return Some(());
        }
        match (field.value(), halves(name)) {
            (Some(Value::Table(_)), _) if is_folder(&field, &["value", "sd", "resolution", "relative"]) => {
                field.table().filter(|table| self.walk_evidence(table, name, found)).map(|_| ())
            }
            (_, Some(halves)) => {
                let wanted = format!("an array of two values, each {}", measure_of(halves[0]).kind().wanted());
                let items = field.items(&wanted, 2..=2)?;
                let read = halves.into_iter().zip(items).map(|(of, item)| {
                    let place = item.clone();
                    self.measured(item, measure_of(of)).map(|measured| found.push(Piece { of, place, measured }))
                });
                // Each of them, so that each says what is wrong with it.
                let read: Vec<Option<()>> = read.collect();
                read.into_iter().collect()
            }
            _ => {
                let names: Vec<String> = names_of_evidence().collect();
                let help = nearest(name, names.iter().map(String::as_str)).map(|name| format!("did you mean `{name}`?"));
                field.report("nothing that can be measured has this name", Some(help.unwrap_or_else(known_names)));
                None
            }
        }
    }

    /// The evidence with the energy of the crush in its place; both vehicles are known by now.
    pub(super) fn settle(&self, pieces: &[Piece<'_>], vehicles: [&Option<VehicleInputs>; 2]) -> Option<Vec<Known>> {
        let settled: Vec<Option<Known>> = pieces.iter().map(|piece| settled(piece, vehicles)).collect();
        settled.into_iter().collect()
    }
}

fn settled(piece: &Piece<'_>, vehicles: [&Option<VehicleInputs>; 2]) -> Option<Known> {
    let of_crush = match piece.of {
        Measurable::CrushEnergy => &[Side::One, Side::Two][..],
        Measurable::CrushEnergyOf(Side::One) => &[Side::One],
        Measurable::CrushEnergyOf(Side::Two) => &[Side::Two],
        _ => &[],
    };
    let known = |value| Known { of: piece.of, key: piece.place.path().to_owned(), value, uncertainty: piece.measured.spread.of(value) };
    if let Amount::Number(value) = piece.measured.amount {
        let has_crush = |side: &Side| vehicles[*side as usize].as_ref().is_some_and(|vehicle| vehicle.crush.is_some());
        if of_crush.iter().any(has_crush) {
            let name = piece.of.name();
            let help = format!("write {name} = \"from crush\", or leave [vehicle.crush] out");
            piece.place.report("a crush energy is given, and the crush that has one of its own", Some(help));
            return None;
        }
        return Some(known(value));
    }
    let mut energy = Some(0.0);
    for side in of_crush {
        let Some(vehicle) = vehicles[*side as usize] else { continue };
        let own = vehicle.crush.as_ref().map(|crush| crush.on_scalar(|_| 0.0).energy());
        if own.is_none() {
            let help = "give its crush; of a vehicle that was not crushed it has depths of 0".to_owned();
            piece.place.report(format!("vehicle {} has no [vehicle.crush]", number(*side)), Some(help));
        }
        energy = energy.zip(own).map(|(sum, own)| sum + own);
    }
    if of_crush.is_empty() {
        piece.place.report("only a crush energy can be taken \"from crush\"", None);
        return None;
    }
    energy.map(known)
}

/// What a name means, and the two components along and across the vehicle, which records have as one ΔV.
fn named(name: &str) -> Option<Measurable> {
    let of_vehicle = || {
        let (vehicle, component) = name.rsplit_once(".delta_v.")?;
        Measurable::named(&format!("{vehicle}.delta_v_{component}"))
    };
    Measurable::named(name).or_else(of_vehicle)
}

/// The two components of what is given as an array.
fn halves(name: &str) -> Option<[Measurable; 2]> {
    let ends = [["x", "y"], ["forward", "left"]];
    ends.into_iter().find_map(|ends| {
        let [one, other] = ends.map(|end| Measurable::named(&format!("{name}.{end}")));
        Some([one?, other?])
    })
}

fn known_names() -> String {
    "known can be crush_energy; separation_velocity, separation_speed, separation_direction, separation_yaw_rate, delta_v, delta_v_magnitude, \
     delta_v_forward, delta_v_left, pdof, crush_energy and every input of a vehicle; what `solve` prints of contact and energy"
        .to_owned()
}
