//! The keys of a crush.

use planar_impact::Side;
use planar_impact::crash3::Surface;
use planar_impact::crush::{BarrierSpeedLine, CrushStiffness, ForceLine, MeasuringLine, ProfileError};
use planar_impact::scalar::Real as _;

use super::{CaseReader, one_of};
use crate::case::crush::{CrushInputs, CrushKey, FormKey, Places, ProfileInputs, StiffnessInputs, sentence, too_stiff};
use crate::case::domain::Domain;
use crate::case::parameter::Parameter;
use crate::document::{Field, Table, Value};
use crate::message::Message;
use crate::notice::Notice;
use crate::units::Measure;
use crate::unusual;

/// Maximum number of zones: measured stiffnesses have few zones, and each zone is evaluated for every depth.
const MOST_ZONES: usize = 32;

/// Maximum number of depths of a vehicle, each of which is an input: a crush profile has six, and a million took a gigabyte.
const MOST_DEPTHS: usize = 20_000;

impl CaseReader {
    pub(super) fn crush(&self, field: Field<'_>, side: Side) -> Option<CrushInputs> {
        let crush = field.table()?;
        let profile = self.profile_of(&crush, Some(side));
        let stiffness = self.zones(crush.required("stiffness"), side);
        let surface = match crush.optional("surface").choice(&["front", "right", "rear", "left"]) {
            Some("front") => Some(Surface::Front),
            Some("right") => Some(Surface::Right),
            Some("rear") => Some(Surface::Rear),
            Some(_) => Some(Surface::Left),
            None => None,
        };
        let pdof = crush.has("pdof").then(|| self.input(crush.optional("pdof"), Parameter::Crush(side, CrushKey::Pdof)));
        crush.finish();
        let (profile, Zones { stiffness, borders, saturation }) = (profile?, stiffness?);
        let pdof = match pdof {
            Some(pdof) => Some(pdof?),
            None => None,
        };
        let inputs = CrushInputs { profile, stiffness, borders, saturation, surface, pdof };
        self.note_unusual(&crush, &inputs);
        Some(inputs)
    }

    /// Reads the depths, their positions and the measuring line; reports an issue if no crush can have this profile.
    pub(crate) fn profile(&self, crush: &Table<'_>) -> Option<ProfileInputs> {
        self.profile_of(crush, None)
    }

    /// Reads the profile of a vehicle of the case, whose numbers may be uncertain, or that of a test.
    fn profile_of(&self, crush: &Table<'_>, side: Option<Side>) -> Option<ProfileInputs> {
        let places = if crush.has("stations") {
            // Reports an issue if both are given.
            one_of(crush, "width", "stations");
            self.stations(crush, side).map(Places::Stations)
        } else {
            self.of_crush(crush.required("width"), side, CrushKey::Width, Domain::Positive).map(Places::Width)
        };
        let line = crush.has("measured").then(|| self.measuring_line(crush.optional("measured"), side));
        let domain = if line.is_none() { Domain::NotNegative } else { Domain::Any };
        let depths = self.lengths(crush.required("depths"), side, CrushKey::Depth, domain);
        let line = match line {
            Some(line) => Some(line?),
            None => None,
        };
        let (places, mut depths) = (places?, depths?);
        if let Some(line) = &line {
            depths.iter_mut().for_each(|reading| *reading = on_surface(line, *reading));
        }
        if let Places::Stations(stations) = &places
            && stations.len() != depths.len()
        {
            crush.optional("stations").report(format!("{} stations for {} depths", stations.len(), depths.len()), None);
            return None;
        }
        let profile = ProfileInputs { places, depths, line };
        self.check_profile(crush, &profile).then_some(profile)
    }

    /// Returns `true` if a crush can have the measured profile; reports the issues otherwise.
    fn check_profile(&self, table: &Table<'_>, inputs: &ProfileInputs) -> bool {
        match inputs.on_scalar(|_| 0.0).checked() {
            Ok(_) => true,
            Err(errors) => {
                // Issues without a measuring line were reported at their own keys.
                let depths = table.optional("depths").items("", 0..=usize::MAX).unwrap_or_default();
                let help = "the readings less the offset, along the angle, as `measured` has it";
                let reading = |error: &ProfileError| match error {
                    ProfileError::Input(issue) if issue.at.name == "depths" => issue.at.index.and_then(|index| depths.get(index)).cloned(),
                    _ => None,
                };
                if depths.len() > 1 && errors.iter().filter_map(reading).count() == depths.len() {
                    table.optional("measured").report("every reading less its offset is below zero", Some(help.to_owned()));
                    return false;
                }
                for error in errors {
                    let place = reading(&error);
                    place.unwrap_or_else(|| table.optional("measured")).report(sentence(&error), Some(help.to_owned()));
                }
                false
            }
        }
    }

    fn note_unusual(&self, table: &Table<'_>, inputs: &CrushInputs) {
        let crush = inputs.on_scalar(|_| 0.0);
        let profile = &crush.profile;
        let path = table.path();
        let warn = |code, path: String, message: Message| self.notices.borrow_mut().push(Notice::warning(code, path, message));
        self.notices.borrow_mut().extend(unusual::sizes_of_crush(path, inputs));
        let energy = crush.energy();
        if profile.depths().iter().all(|depth| *depth == 0.0) && energy > 0.0 {
            let message = Message::from(format!("{path}: no depth, and an energy of "))
                .figure(Measure::Energy, energy)
                .text(", which leaves no crush; of a vehicle that was not crushed give a stiffness with d0 = 0");
            warn("no-depth", path.to_owned(), message);
        }
        let (first, last) = (profile.stations()[0], profile.stations()[0] + profile.width());
        for (i, border) in inputs.borders.iter().enumerate().filter(|(_, border)| !(first..=last).contains(border)) {
            let at = format!("{path}.stiffness.{}.to", i + 1);
            let message = format!("{at} = {border} m lies outside the crush, which is from {first} m to {last} m");
            warn("zone-outside-crush", at, message.into());
        }
    }

    /// Reads a number of a crush, which may be uncertain if it is that of a vehicle of the case.
    fn of_crush(&self, field: Field<'_>, side: Option<Side>, key: CrushKey, domain: Domain) -> Option<f64> {
        match side {
            Some(side) => self.input_in(field, Parameter::Crush(side, key), domain),
            None => self.certain(field, key.measure().into(), domain),
        }
    }

    fn lengths(&self, field: Field<'_>, side: Option<Side>, key: fn(usize) -> CrushKey, domain: Domain) -> Option<Vec<f64>> {
        let items = field.items("an array of at least 2 and at most 20000 values, each a length, such as \"0.1 m\"", 2..=MOST_DEPTHS)?;
        let length = |(i, item)| self.of_crush(item, side, key(i + 1), domain);
        items.into_iter().enumerate().map(length).collect::<Vec<_>>().into_iter().collect()
    }

    fn stations(&self, crush: &Table<'_>, side: Option<Side>) -> Option<Vec<f64>> {
        let stations = self.lengths(crush.required("stations"), side, CrushKey::Station, Domain::Any)?;
        let items = crush.required("stations").items("", 2..=usize::MAX)?;
        let mut increase = true;
        for (i, item) in items.into_iter().enumerate().skip(1).filter(|(i, _)| stations[*i] <= stations[*i - 1]) {
            increase = false;
            item.report(format!("it is at {} m, not beyond the station before, at {} m", stations[i], stations[i - 1]), None);
        }
        increase.then_some(stations)
    }

    fn measuring_line(&self, field: Field<'_>, side: Option<Side>) -> Option<MeasuringLine> {
        let table = field.table()?;
        let number = |name, key| table.has(name).then(|| self.of_crush(table.optional(name), side, key, Domain::Any));
        let (offset, angle) = (number("offset", CrushKey::Offset), number("angle", CrushKey::Angle));
        table.finish();
        if offset.is_none() && angle.is_none() {
            table.issue("missing `offset` or `angle`", None);
            return None;
        }
        let (offset, angle) = (offset.unwrap_or(Some(0.0))?, angle.unwrap_or(Some(0.0))?);
        // A right angle in floats has a cosine above zero.
        if libm::cos(angle) < 1e-9 {
            table.optional("angle").report("readings along the surface measure no depth", Some("0 deg is straight in".to_owned()));
            return None;
        }
        Some(MeasuringLine { offset, angle })
    }

    /// Reads one stiffness, or one for each zone.
    fn zones(&self, field: Field<'_>, side: Side) -> Option<Zones> {
        if !matches!(field.value(), Some(Value::Array(_))) {
            let table = field.table()?;
            let saturation =
                table.has("saturation").then(|| self.input(table.optional("saturation"), Parameter::Crush(side, CrushKey::Saturation)));
            let stiffness = self.stiffness(&table, side, None);
            let saturation = match saturation {
                Some(depth) => Some(depth?),
                None => None,
            };
            return Some(Zones { stiffness: vec![stiffness?], borders: Vec::new(), saturation });
        }
        let place = field.clone();
        let tables = field.array_of_tables()?;
        if tables.is_empty() {
            place.report("no zone: a stiffness, or one for each zone", None);
            return None;
        }
        if tables.len() > MOST_ZONES {
            place.report(format!("{} zones are more than the {MOST_ZONES} that are taken", tables.len()), None);
            return None;
        }
        let last = tables.len() - 1;
        // One zone is the whole width.
        let number = |i: usize| (last > 0).then_some(i + 1);
        let mut zones = Zones { stiffness: Vec::new(), borders: Vec::new(), saturation: None };
        let mut whole = true;
        for (i, table) in tables.iter().enumerate() {
            let border = if i < last {
                self.input(table.required("to"), Parameter::Crush(side, CrushKey::ZoneEnd(i + 1))).map(Some)
            } else if table.has("to") {
                table.optional("to").report("the last zone reaches to the end of the crush", Some("leave `to` out".to_owned()));
                None
            } else {
                Some(None)
            };
            let stiffness = self.stiffness(table, side, number(i));
            let (Some(border), Some(stiffness)) = (border, stiffness) else {
                whole = false;
                continue;
            };
            if let (Some(border), Some(before)) = (border, zones.borders.last())
                && border <= *before
            {
                table.optional("to").report(format!("it ends at {border} m, not beyond the zone before, at {before} m"), None);
                whole = false;
            }
            zones.stiffness.push(stiffness);
            zones.borders.extend(border);
        }
        whole.then_some(zones)
    }

    /// Reads the stiffness of the whole width, or of a zone.
    fn stiffness(&self, table: &Table<'_>, side: Side, zone: Option<usize>) -> Option<StiffnessInputs> {
        let is_fitted = table.has("tests");
        if !is_fitted && !is_of_one_form(table) {
            return None;
        }
        let has = |keys: &[&'static str]| keys.iter().any(|key| table.has(key));
        let root = |name, whole: CrushKey, of_zone: fn(usize) -> CrushKey| {
            self.input(table.required(name), Parameter::Crush(side, zone.map_or(whole, of_zone)))
        };
        let of_form = |key: FormKey| {
            let parameter = zone.map_or(CrushKey::Form(key), |zone| CrushKey::ZoneForm(zone, key));
            self.input(table.required(key.name()), Parameter::Crush(side, parameter))
        };
        let stiffness = if is_fitted {
            let of = [(CrushKey::Onset, CrushKey::ZoneOnset as fn(usize) -> CrushKey), (CrushKey::Slope, CrushKey::ZoneSlope)];
            self.fitted(table, of.map(|(whole, of_zone)| Parameter::Crush(side, zone.map_or(whole, of_zone)))).map(StiffnessInputs::Roots)
        } else if has(FORMS[0]) || !FORMS[1..].iter().any(|keys| has(keys)) {
            let onset = root("d0", CrushKey::Onset, CrushKey::ZoneOnset);
            let slope = root("d1", CrushKey::Slope, CrushKey::ZoneSlope);
            onset.zip(slope).map(|(onset, slope)| StiffnessInputs::Roots(CrushStiffness { onset, slope }))
        } else if has(FORMS[1]) {
            let (onset, slope) = (of_form(FormKey::ForceOnset), of_form(FormKey::ForceSlope));
            onset.zip(slope).map(|(onset, slope)| StiffnessInputs::Force(ForceLine { onset, slope }))
        } else {
            let (onset, slope) = (of_form(FormKey::SpeedOnset), of_form(FormKey::SpeedSlope));
            let (mass, width) = (of_form(FormKey::TestMass), of_form(FormKey::TestWidth));
            let speeds = onset.zip(slope).zip(mass.zip(width));
            speeds.map(|((onset, slope), (test_mass, test_width))| {
                StiffnessInputs::Speed(BarrierSpeedLine { onset, slope, test_mass, test_width })
            })
        };
        table.finish();
        let stiffness = stiffness?;
        if let Some(why) = too_stiff(&stiffness.roots()) {
            table.issue(why, None);
            return None;
        }
        Some(stiffness)
    }
}

/// The keys of each form of a stiffness that is not fitted to tests.
const FORMS: [&[&str]; 3] = [&["d0", "d1"], &["A", "B"], &["b0", "b1", "test_mass", "test_width"]];

/// Reports keys of several forms of a stiffness, and misspelled ones of none: the keys that any one form lacks are not missing then.
fn is_of_one_form(table: &Table<'_>) -> bool {
    let has = |keys: &&&[&str]| table.fields().any(|(key, _)| keys.contains(&key));
    match FORMS.iter().filter(has).count() {
        0 if table.fields().any(|(key, _)| !["saturation", "to"].contains(&key)) => {
            FORMS.iter().copied().flatten().for_each(|key| drop(table.optional(key)));
            table.finish();
            false
        }
        0 | 1 => true,
        _ => {
            let help = "keep one form: A and B; d0 and d1; or b0, b1, test_mass and test_width";
            table.issue("it has keys of two forms of a stiffness", Some(help.to_owned()));
            false
        }
    }
}

/// Contents of the key `stiffness`.
struct Zones {
    stiffness: Vec<StiffnessInputs>,
    borders: Vec<f64>,
    saturation: Option<f64>,
}

/// Returns a reading that ends on the undeformed surface, where the conversion of units has moved it outside by rounding; any other as it is.
fn on_surface(line: &MeasuringLine, reading: f64) -> f64 {
    /// Number of floats that rounding crosses.
    const STEPS: usize = 4;
    let (_, cos) = line.angle.sin_and_cos();
    let mut candidates = std::iter::successors(Some(reading), |reading| Some(reading.next_up())).take(STEPS + 1);
    candidates.find(|reading| reading * cos - line.offset >= 0.0).unwrap_or(reading)
}
