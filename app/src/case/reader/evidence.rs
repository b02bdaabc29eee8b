//! The keys of `[evidence]`.

use planar_impact::reconstruct::{Measurand, Uncertainty, Variable};
use planar_impact::{Input, Side};

use super::CaseReader;
use super::measured::{Amount, DISTRIBUTION_KEYS, Measured, is_folder};
use super::recorder::RecordingOf;
use crate::case::knowledge::{Known, names_of_evidence};
use crate::case::parameter::number;
use crate::case::vehicle::VehicleInputs;
use crate::document::{Field, Table, Value};
use crate::quantity::Kind;
use crate::quantity::{did_you_mean, nearest};

/// A piece of evidence and its place in the file; a crush energy is not filled in yet.
pub(super) struct Piece<'a> {
    pub(super) of: Measurand,
    pub(super) place: Field<'a>,
    measured: Measured,
}

impl<'a> Piece<'a> {
    pub(super) fn new(of: Measurand, place: Field<'a>, measured: Measured) -> Self {
        Piece { of, place, measured }
    }

    /// Returns its value, if the file gives a number.
    pub(super) fn number(&self) -> Option<f64> {
        match self.measured.amount {
            Amount::Number(value) => Some(value),
            Amount::FromCrush => None,
        }
    }

    /// Returns `true` if it is exact, with no uncertainty.
    pub(super) fn is_exact(&self) -> bool {
        self.number().is_some_and(|value| self.measured.spread.of(value) == Uncertainty::Exact)
    }
}

impl CaseReader {
    /// Reads every piece of evidence in the table, by dotted name or symbol.
    pub(super) fn evidence<'a>(&self, table: &Table<'a>) -> Vec<Piece<'a>> {
        let mut found = Vec::new();
        self.walk_evidence(table, "", &mut found);
        found
    }

    fn walk_evidence<'a>(&self, table: &Table<'a>, above: &str, found: &mut Vec<Piece<'a>>) {
        for (key, field) in table.fields() {
            let name = if above.is_empty() { key.to_owned() } else { format!("{above}.{key}") };
            match field.value() {
                Some(Value::Table(_)) if is_of_several(&name) && is_folder(&field, &DISTRIBUTION_KEYS) => {
                    field.table().iter().for_each(|table| self.walk_evidence(table, &name, found));
                }
                _ if self.piece(&name, field, found).is_none() => self.unread.borrow_mut().add(meant(&name)),
                _ => (),
            }
        }
    }

    fn piece<'a>(&self, name: &str, field: Field<'a>, found: &mut Vec<Piece<'a>>) -> Option<()> {
        if let Some(of) = RecordingOf::named(name) {
            return self.recorded(of, &field, found);
        }
        if let Some(of) = named(name) {
            let place = field.clone();
            let measured = self.measured(field, of.measure())?;
            // What is no input in its domain is no evidence of it.
            if let (Measurand::Variable(Variable::Input(Input::Restitution)), Amount::Number(value)) = (of, measured.amount) {
                self.up_to(&place, value, 1.0)?;
            }
            found.push(Piece { of, place, measured });
            return Some(());
        }
        match halves(name) {
            Some(halves) => {
                let wanted = format!("an array of two values, each {}", Kind::from(halves[0].measure()).wanted());
                let items = field.items(&wanted, 2..=2)?;
                let read = halves.into_iter().zip(items).map(|(of, item)| {
                    let place = item.clone();
                    self.measured(item, of.measure()).map(|measured| found.push(Piece { of, place, measured }))
                });
                // Read all of them before returning, so that each one reports its issues.
                let read: Vec<Option<()>> = read.collect();
                read.into_iter().collect()
            }
            None => {
                // Its usual abbreviation is nearer to other names.
                let of = name.to_ascii_lowercase();
                let spelled = of.strip_suffix(".ees").map_or_else(|| name.to_owned(), |of| format!("{of}.equivalent_energy_speed"));
                let help = did_you_mean(&spelled, names_of_evidence()).unwrap_or_else(known_names);
                field.report("nothing that can be measured has this name", Some(help));
                None
            }
        }
    }

    /// Returns the evidence with crush energies filled in, once both vehicles have been read.
    pub(super) fn settle(&self, pieces: &[Piece<'_>], vehicles: [&Option<VehicleInputs>; 2]) -> Option<Vec<Known>> {
        let settled: Vec<Option<Known>> = pieces.iter().map(|piece| settled(piece, vehicles)).collect();
        settled.into_iter().collect()
    }
}

fn settled(piece: &Piece<'_>, vehicles: [&Option<VehicleInputs>; 2]) -> Option<Known> {
    let of_crush = match piece.of {
        Measurand::CrushEnergy => &[Side::One, Side::Two][..],
        Measurand::CrushEnergyOf(Side::One) => &[Side::One],
        Measurand::CrushEnergyOf(Side::Two) => &[Side::Two],
        _ => &[],
    };
    let is_from_crush = piece.number().is_none();
    let key = || piece.place.path().to_owned();
    let known = |value| Known { of: piece.of, key: key(), value, uncertainty: piece.measured.spread.of(value), is_from_crush };
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
            let help = "give its crush; of a vehicle that was not crushed, depths of 0 and a stiffness with d0 = 0".to_owned();
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

/// Returns the measurand with this name. Components of ΔV in vehicle axes may be given as one key.
fn named(name: &str) -> Option<Measurand> {
    let of_vehicle = || {
        let (vehicle, component) = name.rsplit_once(".delta_v.")?;
        Measurand::named(&format!("{vehicle}.delta_v_{component}"))
    };
    Measurand::named(name).or_else(of_vehicle)
}

/// Returns `true` if a table of this name has pieces of evidence rather than the number of one.
fn is_of_several(name: &str) -> bool {
    named(name).is_none() && RecordingOf::named(name).is_none()
}

/// Returns the variables that evidence of this name gives, or of the name that it is likely to be misspelled from.
fn meant(name: &str) -> Option<Vec<Variable>> {
    let variables =
        |all: &[Measurand]| all.iter().filter_map(|of| if let Measurand::Variable(of) = of { Some(*of) } else { None }).collect();
    if let Some(recording) = RecordingOf::named(name) {
        return Some(vec![recording.variable()]);
    }
    match (named(name), halves(name)) {
        (Some(of), _) => Some(variables(&[of])),
        (None, Some(halves)) => Some(variables(&halves)),
        (None, None) => nearest_name(name).and_then(|name| meant(&name)),
    }
}

fn nearest_name(name: &str) -> Option<String> {
    let names: Vec<String> = names_of_evidence().collect();
    nearest(name, names.iter().map(String::as_str)).map(str::to_owned)
}

/// Returns the two components of a quantity given as an array.
fn halves(name: &str) -> Option<[Measurand; 2]> {
    let ends = [["x", "y"], ["forward", "left"]];
    ends.into_iter().find_map(|ends| {
        let [one, other] = ends.map(|end| Measurand::named(&format!("{name}.{end}")));
        Some([one?, other?])
    })
}

fn known_names() -> String {
    "known can be crush_energy; separation_velocity, separation_speed, separation_direction, separation_yaw_rate, delta_v, delta_v_magnitude, \
     delta_v_forward, delta_v_left, pdof, crush_energy, equivalent_energy_speed and every input of a vehicle; what `solve` prints of contact and energy"
        .to_owned()
}
