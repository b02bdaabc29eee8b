//! The walk through a case file, key by key.

mod crush;
mod evidence;

use std::cell::{Cell, RefCell};

use planar_impact::{CrushPlaneBracket, ForwardLeft, ImpulseRatio, Law, Moment, PerpendicularSurfaces, Xy};

use super::inputs::{ContactInputs, Inputs};
use super::vehicle::{Inertia, VehicleInputs, Velocity};
use crate::document::{Field, Table, Value};
use crate::quantity::{Kind, Quantity};
use crate::units::{Measure, Units};
use crate::wording::{barrier_instead, percent_meant, trim};

/// What the keys of a case file give.
pub(super) struct Read {
    pub(super) title: String,
    pub(super) names: [String; 2],
    pub(super) inputs: Inputs,
    pub(super) bracket: Option<CrushPlaneBracket>,
    pub(super) separation: [Option<Xy>; 2],
}

/// The units met on the way through the file.
#[derive(Default)]
pub(crate) struct Given {
    pub(crate) notes: RefCell<Vec<String>>,
    us: Cell<usize>,
    si: Cell<usize>,
}

impl Given {
    /// The system that most quantities are in.
    pub(crate) fn units(&self) -> Units {
        if self.us.get() > self.si.get() { Units::Us } else { Units::Si }
    }

    /// The value in SI, having noted its unit.
    fn take(&self, path: &str, quantity: Quantity) -> f64 {
        let Quantity { si, unit, bare, .. } = quantity;
        if bare && !unit.is_empty() {
            self.notes.borrow_mut().push(format!("{path} has no unit: {si} {unit} taken"));
        }
        match Units::of(&unit) {
            Some(Units::Us) => self.us.update(|count| count + 1),
            Some(Units::Si) => self.si.update(|count| count + 1),
            None => (),
        }
        si
    }

    pub(crate) fn quantity(&self, field: Field<'_>, kind: Kind) -> Option<f64> {
        let path = field.path().to_owned();
        field.quantity(kind).map(|quantity| self.take(&path, quantity))
    }

    /// A quantity that must be above zero. The library refuses it too; said here, it is said together with everything else that is wrong in the file.
    pub(crate) fn positive(&self, field: Field<'_>, kind: Kind) -> Option<f64> {
        let place = field.clone();
        let value = self.quantity(field, kind)?;
        if value > 0.0 {
            return Some(value);
        }
        place.report(format!("it is {value} {}; it must be above zero", kind.si), barrier_instead(place.path()));
        None
    }

    /// A quantity that may be zero but not below.
    pub(crate) fn not_negative(&self, field: Field<'_>, kind: Kind) -> Option<f64> {
        let place = field.clone();
        let value = self.quantity(field, kind)?;
        if value >= 0.0 {
            return Some(value);
        }
        place.report(format!("it is {value} {}; it must not be below zero", kind.si), None);
        None
    }

    /// A pure number that must lie between 0 and a greatest value.
    pub(crate) fn coefficient(&self, field: Field<'_>, greatest: f64) -> Option<f64> {
        let place = field.clone();
        let value = self.quantity(field, Kind::PURE)?;
        if (0.0..=greatest).contains(&value) {
            return Some(value);
        }
        let range = if greatest.is_finite() { format!("from 0 to {greatest}") } else { "at least 0".to_owned() };
        place.report(format!("it is {value}; it must be {range}"), percent_meant(value));
        None
    }

    fn pair(&self, field: Field<'_>, kind: Kind) -> Option<[f64; 2]> {
        let path = field.path().to_owned();
        let [a, b] = field.pair(kind)?;
        Some([self.take(&format!("{path}.1"), a), self.take(&format!("{path}.2"), b)])
    }

    /// Everything, from the root of the file.
    pub(super) fn case(&self, root: &Table<'_>) -> Option<Read> {
        let schema = root.required("schema").integer(1..=1);
        let title = root.optional("title").string().unwrap_or_default().to_owned();
        let vehicles = self.vehicles(root);
        let contact = root.required("contact").table().and_then(|contact| self.contact(&contact));
        // What other verbs read of the same file.
        root.has("unknown");
        let evidence = root.has("evidence").then(|| root.optional("evidence").table());
        schema?;
        let ([(name_1, one), (name_2, two)], (contact, bracket)) = (vehicles?, contact?);
        let separation = match evidence {
            Some(evidence) => {
                let evidence = evidence?;
                let separation = self.separation_velocities(&evidence);
                self.one_crush_energy(&evidence, [&one, &two])?;
                separation?
            }
            None => [None, None],
        };
        Some(Read { title, names: [name_1, name_2], inputs: Inputs { vehicles: [one, two], contact }, bracket, separation })
    }

    /// A crush energy that is given in the evidence is not that of a crush that is given as well.
    fn one_crush_energy(&self, evidence: &Table<'_>, vehicles: [&Option<VehicleInputs>; 2]) -> Option<()> {
        let field = evidence.optional("crush_energy");
        let from_crush = field.value().is_none_or(|value| matches!(value, Value::String(text) if text == "from crush"));
        let crushed = vehicles.into_iter().flatten().any(|vehicle| vehicle.crush.is_some());
        if from_crush || !crushed {
            return Some(());
        }
        let help = "write crush_energy = \"from crush\", or leave [vehicle.crush] out".to_owned();
        field.report("a crush energy is given, and the crush that has one of its own", Some(help));
        None
    }

    fn vehicles(&self, root: &Table<'_>) -> Option<[(String, Option<VehicleInputs>); 2]> {
        let field = root.required("vehicle");
        let place = root.optional("vehicle");
        let tables = field.array_of_tables()?;
        if tables.len() != 2 {
            let plural = if tables.len() == 1 { "" } else { "s" };
            place.report(
                format!("expected exactly two vehicles; found {} table{plural}", tables.len()),
                Some("a fixed barrier is a [[vehicle]] with `barrier = true`".to_owned()),
            );
        }
        let read: Vec<_> = tables.iter().enumerate().map(|(i, table)| self.party(table, i + 1)).collect();
        let both: Option<Vec<_>> = read.into_iter().collect();
        both?.try_into().ok()
    }

    fn party(&self, table: &Table<'_>, number: usize) -> Option<(String, Option<VehicleInputs>)> {
        let name = table.optional("name").string().map_or_else(|| format!("vehicle {number}"), str::to_owned);
        if table.has("barrier") {
            // Neither true nor false says nothing of the other keys.
            if table.optional("barrier").boolean()? {
                table.finish_because("a barrier has nothing but a name");
                return Some((name, None));
            }
        }
        let vehicle = self.vehicle(table);
        table.finish();
        vehicle.map(|vehicle| (name, Some(vehicle)))
    }

    fn vehicle(&self, table: &Table<'_>) -> Option<VehicleInputs> {
        let mass = self.positive(table.required("mass"), Kind::MASS);
        let heading = self.quantity(table.required("heading"), Kind::ANGLE);
        let impact_center = self.pair(table.required("impact_center"), Kind::LENGTH);
        let yaw_rate = table.has("yaw_rate").then(|| self.quantity(table.optional("yaw_rate"), Kind::YAW_RATE));
        let inertia = match one_of(table, "yaw_inertia", "radius_of_gyration") {
            Some("yaw_inertia") => self.positive(table.required("yaw_inertia"), Kind::YAW_INERTIA).map(Inertia::Yaw),
            // Squared it would lose its sign.
            Some(_) => self.positive(table.required("radius_of_gyration"), Kind::LENGTH).map(Inertia::Radius),
            None => None,
        };
        let velocity = match one_of(table, "speed", "velocity") {
            Some("speed") => self.quantity(table.required("speed"), Kind::SPEED).map(Velocity::Speed),
            Some(_) => self.pair(table.required("velocity"), Kind::SPEED).map(|[x, y]| Velocity::Components(Xy { x, y })),
            None => None,
        };
        let crush = table.has("crush").then(|| self.crush(table.optional("crush")));
        let [forward, left] = impact_center?;
        Some(VehicleInputs {
            mass: mass?,
            inertia: inertia?,
            heading: heading?,
            velocity: velocity?,
            yaw_rate: yaw_rate.unwrap_or(Some(0.0))?,
            impact_center: ForwardLeft { forward, left },
            crush: match crush {
                Some(crush) => Some(crush?),
                None => None,
            },
        })
    }

    fn contact(&self, table: &Table<'_>) -> Option<(ContactInputs, Option<CrushPlaneBracket>)> {
        let crush_plane = self.crush_plane(table);
        let restitution = self.coefficient(table.required("restitution"), 1.0);
        let impulse_ratio = self.impulse_ratio(table);
        let law = match table.optional("tangential_law").choice(&["brach", "kudlich-slibar"]) {
            Some("kudlich-slibar") => Law::KudlichSlibar,
            _ => Law::Brach,
        };
        let moment = self.moment(table);
        table.finish();
        let (crush_plane, bracket) = crush_plane?;
        let contact = ContactInputs { crush_plane, restitution: restitution?, impulse_ratio: impulse_ratio?, law, moment: moment? };
        Some((contact, bracket))
    }

    /// The angle of the crush plane, and its bracket where it comes from the surfaces that meet.
    fn crush_plane(&self, table: &Table<'_>) -> Option<(f64, Option<CrushPlaneBracket>)> {
        if one_of(table, "crush_plane", "surfaces")? == "crush_plane" {
            return self.quantity(table.required("crush_plane"), Kind::ANGLE).map(|angle| (angle, None));
        }
        let field = table.required("surfaces");
        let place = field.clone();
        let [one, two] = self.pair(field, Kind::ANGLE)?;
        match CrushPlaneBracket::of_surfaces(one, two) {
            Ok(bracket) => Some((bracket.nominal, Some(bracket))),
            Err(PerpendicularSurfaces { one, other }) => {
                let degrees = |angle| trim(Units::Si.convert(Measure::Angle, angle));
                let help = format!("give crush_plane = \"{} deg\" or crush_plane = \"{} deg\"", degrees(one), degrees(other));
                place.report("the surfaces stand at a right angle, and two planes are half way between them", Some(help));
                None
            }
        }
    }

    fn impulse_ratio(&self, table: &Table<'_>) -> Option<ImpulseRatio> {
        if table.has("friction") {
            if table.has("impulse_ratio") {
                let help = "an impulse ratio is given; a friction limits the critical one".to_owned();
                table.optional("friction").report("`friction` and `impulse_ratio` exclude each other", Some(help));
            }
            let friction = self.coefficient(table.required("friction"), f64::INFINITY);
            return friction.map(ImpulseRatio::LimitedByFriction);
        }
        let field = table.optional("impulse_ratio");
        match field.value() {
            None => Some(ImpulseRatio::Critical),
            Some(Value::Table(_)) => self.of_critical(field).map(ImpulseRatio::OfCritical),
            Some(Value::Number(_)) => self.quantity(field, Kind::PURE).map(ImpulseRatio::Given),
            Some(Value::String(text)) if text == "critical" => Some(ImpulseRatio::Critical),
            Some(_) => {
                field.report("expected \"critical\", a number, or { of_critical = 0.975 }", None);
                None
            }
        }
    }

    fn moment(&self, table: &Table<'_>) -> Option<Moment> {
        let field = table.optional("moment");
        match field.value() {
            None => Some(Moment::None),
            Some(Value::Table(_)) => self.of_critical(field).map(Moment::OfCritical),
            Some(_) => self.quantity(field, Kind::MOMENT_IMPULSE).map(Moment::Given),
        }
    }

    fn of_critical(&self, field: Field<'_>) -> Option<f64> {
        let table = field.table()?;
        let fraction = self.quantity(table.required("of_critical"), Kind::PURE);
        table.finish();
        fraction
    }
}

/// Which of two keys the table has, when it must have exactly one of them.
fn one_of(table: &Table<'_>, first: &'static str, second: &'static str) -> Option<&'static str> {
    match (table.has(first), table.has(second)) {
        (true, true) => {
            table.optional(second).report(format!("`{first}` and `{second}` exclude each other"), Some("give one of them".to_owned()));
            Some(first)
        }
        (_, true) => Some(second),
        (true, _) => Some(first),
        (false, false) => {
            table.problem(format!("missing `{first}` or `{second}`"), None);
            None
        }
    }
}
