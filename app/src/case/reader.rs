//! Reads a case file key by key.

mod barrier_test;
mod before;
mod contact;
mod correlation;
mod crush;
mod csv_column;
mod evidence;
mod fitted;
mod implied;
mod measured;
mod mixed_units;
mod momentum;
mod recorder;
mod rest;
mod restitution;
mod sample;
mod unknown;

use std::cell::{Cell, RefCell};
use std::path::PathBuf;

use planar_impact::reconstruct::{Correlation, Variable};
use planar_impact::{CrushPlaneBracket, ForwardLeft, Input, Side, Xy};

pub(crate) use self::csv_column::Rows;
use self::fitted::FittedToTests;
pub(crate) use self::fitted::report as report_file;
use self::implied::{ImpliedValues, Unread};
use self::measured::Distributed;
use self::mixed_units::NumbersBeside;
use self::momentum::ANY_INERTIA;
pub(crate) use self::recorder::Recorded;
use self::sample::MeasuredColumn;
pub(crate) use self::sample::read_cell;
use super::contents::Contents;
use super::domain::Domain;
use super::inputs::Inputs;
use super::knowledge::Knowledge;
use super::model::ContactModel;
use super::parameter::Parameter;
use super::rest::RestInputs;
use super::uncertain::{Uncertain, UncertainInput};
use super::vehicle::{Inertia, Size, VehicleInputs, Velocity};
use crate::document::{Field, Table};
use crate::notice::Notice;
use crate::quantity::{Kind, Quantity};
use crate::source::{Open, SharedOpen};
use crate::units::Units;
use crate::unusual;
use crate::wording::{barrier_instead, count_of, percent_meant};

/// Contents of a case file.
pub(super) struct Read {
    pub(super) title: String,
    pub(super) names: [String; 2],
    pub(super) inputs: Inputs,
    pub(super) model: ContactModel,
    pub(super) bracket: Option<CrushPlaneBracket>,
    pub(super) knowledge: Knowledge,
    pub(super) scene: Option<Xy>,
    pub(super) rest: Option<RestInputs>,
    pub(super) uncertain: Uncertain,
}

/// Reads the keys of a case file, collecting notices and counting the units used.
#[derive(Default)]
pub(crate) struct CaseReader {
    pub(crate) notices: RefCell<Vec<Notice>>,
    /// What the file gives, by path.
    pub(super) contents: RefCell<Contents>,
    uncertain: RefCell<Vec<UncertainInput>>,
    open: Option<SharedOpen>,
    fitted: RefCell<Vec<FittedToTests>>,
    /// The recordings that are of one test or one vehicle, by their file or samples, each with the path of its key.
    records: RefCell<Vec<(PathBuf, String)>>,
    /// The test of `contact.record`.
    barrier_test: RefCell<Option<barrier_test::BarrierTest>>,
    /// Correlations of pieces of evidence that come from one recording.
    correlations_of_evidence: RefCell<Vec<Correlation>>,
    /// The columns that inputs are measured in.
    columns: RefCell<Vec<MeasuredColumn>>,
    unread: RefCell<Unread>,
    /// `true` if the friction of `[rest]` is uncertain.
    has_uncertain_rest: Cell<bool>,
    /// The `gravity` of the case, if the file gives it.
    gravity: Cell<Option<f64>>,
    /// `true` if something of the case weighs or slides.
    uses_gravity: Cell<bool>,
    numbers: RefCell<NumbersBeside>,
    us: Cell<usize>,
    si: Cell<usize>,
}

impl CaseReader {
    /// Creates a reader of a case that may name other files.
    pub(crate) fn opening(open: Open) -> Self {
        CaseReader { open: Some(open.into()), ..CaseReader::default() }
    }

    /// Returns the system of units that most quantities use.
    pub(crate) fn units(&self) -> Units {
        if self.us.get() > self.si.get() { Units::Us } else { Units::Si }
    }

    /// Returns the value in SI, and records it and its unit.
    fn take(&self, path: &str, quantity: Quantity, kind: Kind) -> f64 {
        let mixed = self.numbers.borrow_mut().add(path, &quantity, kind);
        self.notices.borrow_mut().extend(Notice::unit_assumed(path, &quantity).into_iter().chain(mixed));
        let Quantity { si, unit, pound_force, .. } = quantity;
        self.notices.borrow_mut().extend(pound_force.then(|| Notice::pound_force_assumed(path)));
        match Units::of(&unit) {
            Some(Units::Us) => self.us.update(|count| count + 1),
            Some(_) => self.si.update(|count| count + 1),
            None => (),
        }
        self.contents.borrow_mut().numbers(path, [(path.to_owned(), si, kind.measure())]);
        si
    }

    pub(crate) fn quantity(&self, field: Field<'_>, kind: Kind) -> Option<f64> {
        let path = field.path().to_owned();
        field.quantity(kind).map(|quantity| self.take(&path, quantity, kind))
    }

    /// Reads a quantity that must be above zero. The library checks this too; checking here reports it together with
    /// all other issues in the file.
    pub(crate) fn positive(&self, field: Field<'_>, kind: Kind) -> Option<f64> {
        let place = field.clone();
        let value = self.quantity(field, kind)?;
        self.above_zero(&place, value, kind)
    }

    fn above_zero(&self, place: &Field<'_>, value: f64, kind: Kind) -> Option<f64> {
        if value > 0.0 {
            return Some(value);
        }
        place.report_as("not-positive", format!("it is {value} {}; it must be above zero", kind.si), barrier_instead(place.path()));
        None
    }

    /// Reads a quantity that must not be negative.
    pub(crate) fn not_negative(&self, field: Field<'_>, kind: Kind) -> Option<f64> {
        let place = field.clone();
        let value = self.quantity(field, kind)?;
        self.not_below_zero(&place, value, kind)
    }

    fn not_below_zero(&self, place: &Field<'_>, value: f64, kind: Kind) -> Option<f64> {
        if value >= 0.0 {
            return Some(value);
        }
        place.report_as("out-of-range", format!("it is {value} {}; it must not be below zero", kind.si), None);
        None
    }

    /// Returns a value that its domain accepts, or reports the issue.
    fn within(&self, place: &Field<'_>, value: f64, kind: Kind, domain: Domain) -> Option<f64> {
        let is_pure = kind.dimension == Kind::PURE.dimension;
        match domain {
            Domain::Any => Some(value),
            Domain::Positive => self.above_zero(place, value, kind),
            Domain::NotNegative if is_pure => self.up_to(place, value, f64::INFINITY),
            Domain::NotNegative => self.not_below_zero(place, value, kind),
            Domain::Fraction => self.up_to(place, value, 1.0),
        }
    }

    /// Reads a number without an uncertainty.
    fn certain(&self, field: Field<'_>, kind: Kind, domain: Domain) -> Option<f64> {
        let place = field.clone();
        let value = self.quantity(field, kind)?;
        self.within(&place, value, kind, domain)
    }

    /// Reads an input that may be uncertain. Returns its nominal value, and keeps its distribution.
    fn input(&self, field: Field<'_>, parameter: Parameter) -> Option<f64> {
        self.input_in(field, parameter, parameter.domain())
    }

    /// Reads an input that may be uncertain, in another domain than its own.
    fn input_in(&self, field: Field<'_>, parameter: Parameter, domain: Domain) -> Option<f64> {
        let key = field.path().to_owned();
        let read = self.distributed(field, parameter.kind(), domain)?;
        Some(self.keep(parameter, key, read))
    }

    /// Keeps the distribution of an input, if it has one. Returns its nominal value.
    fn keep(&self, parameter: Parameter, key: String, read: Distributed) -> f64 {
        self.contents.borrow_mut().input(&key);
        let Distributed { nominal, distribution, values } = read;
        if let Some(distribution) = distribution {
            self.uncertain.borrow_mut().push(UncertainInput { parameter, key, nominal, distribution, values, is_for_95: false });
        }
        nominal
    }

    /// Reads an array of two inputs that may be uncertain.
    fn inputs(&self, field: Field<'_>, pair: [Input; 2]) -> Option<[f64; 2]> {
        let wanted = format!("an array of two values, each {}", Parameter::Input(pair[0]).kind().wanted());
        let items = field.items(&wanted, 2..=2)?;
        let read: Vec<_> = items.into_iter().zip(pair).map(|(item, input)| self.input(item, Parameter::Input(input))).collect();
        read.into_iter().collect::<Option<Vec<f64>>>()?.try_into().ok()
    }

    /// Reads a pure number between 0 and `greatest`.
    pub(crate) fn coefficient(&self, field: Field<'_>, greatest: f64) -> Option<f64> {
        let place = field.clone();
        let value = self.quantity(field, Kind::PURE)?;
        self.up_to(&place, value, greatest)
    }

    fn up_to(&self, place: &Field<'_>, value: f64, greatest: f64) -> Option<f64> {
        if (0.0..=greatest).contains(&value) {
            return Some(value);
        }
        let range = if greatest.is_finite() { format!("from 0 to {greatest}") } else { "at least 0".to_owned() };
        place.report_as("out-of-range", format!("it is {value}; it must be {range}"), percent_meant(value));
        None
    }

    pub(crate) fn pair(&self, field: Field<'_>, kind: Kind) -> Option<[f64; 2]> {
        let path = field.path().to_owned();
        let [a, b] = field.pair(kind)?;
        Some([self.take(&format!("{path}.1"), a, kind), self.take(&format!("{path}.2"), b, kind)])
    }

    /// Reads the whole case from the root of the file.
    pub(super) fn case(&self, root: &Table<'_>) -> Option<Read> {
        let schema = root.required("schema").integer(1..=1);
        let title = root.optional("title").string().unwrap_or_default().to_owned();
        let gravity = root.has("gravity").then(|| self.positive(root.optional("gravity"), Kind::ACCELERATION));
        self.gravity.set(gravity.flatten());
        self.notices.borrow_mut().extend(gravity.flatten().and_then(|gravity| unusual::gravity("gravity", gravity)));
        let evidence = self.part(root, "evidence", CaseReader::evidence);
        let unknowns = self.part(root, "unknown", CaseReader::unknowns);
        // Keep notices in file order: these usually come last.
        let notices = self.notices.take();
        let implied = ImpliedValues::of(&evidence, &unknowns, self.unread.take());
        let contact = root.required("contact").table();
        let is_momentum = contact.as_ref().is_some_and(Self::is_momentum);
        let vehicles = self.vehicles(root, &implied, is_momentum);
        let contact = contact.and_then(|contact| self.contact(&contact, &implied, is_momentum));
        self.notices.borrow_mut().extend(notices);
        let impact_point = root.has("scene").then(|| self.impact_point(root));
        let rest = root.has("rest").then(|| {
            let vehicles = vehicles.as_ref().map(|[(_, one), (_, two)]| [one.as_ref(), two.as_ref()]);
            self.rest(root, vehicles, impact_point.flatten())
        });
        let braking = root.has("before").then(|| {
            let is_vehicle = vehicles.as_ref().map(|[(_, one), (_, two)]| [one.is_some(), two.is_some()]);
            self.before(root, is_vehicle.unwrap_or([true; 2]))
        });
        // Of all uncertain inputs, which have been read by now.
        let is_read =
            [rest.as_ref().map(Option::is_some), braking.as_ref().map(Option::is_some)].into_iter().flatten().all(|is_read| is_read);
        let is_whole = vehicles.is_some() && contact.is_some() && is_read;
        let correlations = root.has("correlation").then(|| self.correlations(root.optional("correlation"), is_whole));
        let spins = !is_momentum || self.rests_have_inertia(root);
        schema?;
        if !spins || gravity == Some(None) {
            return None;
        }
        let scene = match impact_point {
            Some(impact_point) => Some(impact_point?),
            None => None,
        };
        let ([(name_1, mut one), (name_2, mut two)], (contact, bracket)) = (vehicles?, contact?);
        if let Some(braking) = braking {
            let parties = [&mut one, &mut two].into_iter().zip(braking?);
            parties.for_each(|(party, braking)| party.iter_mut().for_each(|vehicle| vehicle.braking.clone_from(&braking)));
        }
        let model = match is_momentum {
            true => ContactModel::Momentum { angular: self.is_angular(root, [&one, &two])? },
            false => ContactModel::ImpulseRatio,
        };
        let is_sought = |of: Variable| unknowns.iter().any(|asked| asked.requested.of == of);
        let is_test = self.compare_with_test(&evidence, &is_sought, [&one, &two], contact.crush_plane);
        let evidence = is_test.and(self.settle(&evidence, [&one, &two]));
        let mut rest = match rest {
            Some(rest) => Some(rest?),
            None => None,
        };
        if !model.is_angular() {
            self.make_point_masses(root, [&mut one, &mut two], rest.as_mut())?;
        }
        let inputs = Inputs { vehicles: [one, two], contact };
        let mut correlations = correlations.unwrap_or(Some(Vec::new()))?;
        correlations.extend(self.correlations_of_tests());
        let uncertain = Uncertain { inputs: self.uncertain.take(), correlations };
        self.note_independent_columns(&uncertain);
        if root.has("gravity") && !self.uses_gravity.get() {
            let message = "gravity has no effect: no vehicle of this case has a weight, skids or slides to rest";
            self.notices.borrow_mut().push(Notice::note("gravity-not-used", "gravity", message));
        }
        let agrees = implied.agree_with(&inputs, &uncertain);
        let unknowns: Vec<_> = unknowns.iter().map(|asked| asked.requested.clone()).collect();
        let knowledge =
            Knowledge { evidence: evidence?, correlations: self.correlations_of_evidence.take(), unknowns, left_out: implied.left_out() };
        (implied.is_whole() && agrees).then_some(Read {
            title,
            names: [name_1, name_2],
            inputs,
            model,
            bracket,
            knowledge,
            scene,
            rest,
            uncertain,
        })
    }

    /// Reads where on the scene the vehicles met.
    fn impact_point(&self, root: &Table<'_>) -> Option<Xy> {
        let scene = root.optional("scene").table()?;
        let point = self.pair(scene.required("impact_point"), Kind::LENGTH);
        scene.finish();
        point.map(|[x, y]| Xy { x, y })
    }

    /// Reads an optional table as a list.
    fn part<'a, T>(&self, root: &Table<'a>, key: &'static str, read: impl Fn(&Self, &Table<'a>) -> Vec<T>) -> Vec<T> {
        if !root.has(key) {
            return Vec::new();
        }
        let table = root.optional(key).table();
        if table.is_none() {
            self.unread.borrow_mut().add(None);
        }
        table.map(|table| read(self, &table)).unwrap_or_default()
    }

    fn vehicles(&self, root: &Table<'_>, implied: &ImpliedValues<'_>, is_momentum: bool) -> Option<[(String, Option<VehicleInputs>); 2]> {
        let field = root.required("vehicle");
        let place = root.optional("vehicle");
        let tables = field.array_of_tables()?;
        if tables.len() != 2 {
            place.report(
                format!("expected exactly two vehicles; found {}", count_of(tables.len(), "table")),
                Some("a fixed barrier is a [[vehicle]] with `barrier = true`".to_owned()),
            );
        }
        let read: Vec<_> = tables.iter().enumerate().map(|(i, table)| self.party(table, i + 1, implied, is_momentum)).collect();
        let both: Option<Vec<_>> = read.into_iter().collect();
        both?.try_into().ok()
    }

    fn party(
        &self,
        table: &Table<'_>,
        number: usize,
        implied: &ImpliedValues<'_>,
        is_momentum: bool,
    ) -> Option<(String, Option<VehicleInputs>)> {
        let name = table.optional("name").name().map_or_else(|| format!("vehicle {number}"), str::to_owned);
        let is_barrier = if table.has("barrier") { table.optional("barrier").boolean() } else { Some(false) };
        if is_barrier == Some(true) {
            table.finish_because("a barrier has nothing but a name");
            return Some((name, None));
        }
        // If `barrier` is neither true nor false, what has a mass is judged as a vehicle.
        if is_barrier.is_none() && !table.has("mass") && !table.has("weight") {
            return None;
        }
        let side = if number == 2 { Side::Two } else { Side::One };
        let vehicle = self.vehicle(table, side, implied, is_momentum);
        table.finish();
        is_barrier.and(vehicle).map(|vehicle| (name, Some(vehicle)))
    }

    fn vehicle(&self, table: &Table<'_>, side: Side, implied: &ImpliedValues<'_>, is_momentum: bool) -> Option<VehicleInputs> {
        let or = |key, input: fn(Side) -> Input, read: &dyn Fn(Field<'_>) -> Option<f64>| match implied.of_key(table, key, input(side)) {
            Some(value) => value,
            None => read(table.required(key)),
        };
        let mass = if table.has("weight") {
            self.weight(table, side)
        } else {
            or("mass", Input::Mass, &|field| self.input(field, Parameter::Input(Input::Mass(side))))
        };
        let heading = or("heading", Input::Heading, &|field| self.input(field, Parameter::Input(Input::Heading(side))));
        let center = [Input::ImpactCenterForward, Input::ImpactCenterLeft].map(|input| input(side));
        let impact_center = match implied.of_pair(table, "impact_center", center.map(Variable::Input)) {
            Some(pair) => pair,
            None if is_momentum && !table.has("impact_center") => Some([0.0, 0.0]),
            None => self.inputs(table.required("impact_center"), center),
        };
        let yaw_rate = match implied.of_optional(table, "yaw_rate", Input::YawRate(side), 0.0) {
            Some(value) => Some(value),
            None => self.input(table.required("yaw_rate"), Parameter::Input(Input::YawRate(side))),
        };
        let inertia = if is_momentum && !has_inertia(table) { Some(ANY_INERTIA) } else { self.inertia(table, side, implied) };
        let velocity = self.velocity(table, side, implied);
        let crush = table.has("crush").then(|| self.crush(table.optional("crush"), side));
        let size = self.size(table);
        if let (Some(Some(crush)), Some(size)) = (&crush, &size) {
            self.notices.borrow_mut().extend(unusual::crush(&format!("{}.crush", table.path()), crush, size));
        }
        let [forward, left] = impact_center?;
        if let Some(size) = &size {
            self.notices.borrow_mut().extend(unusual::plan(table.path(), size, [forward, left]));
        }
        Some(VehicleInputs {
            mass: mass?,
            inertia: inertia?,
            heading: heading?,
            velocity: velocity?,
            yaw_rate: yaw_rate?,
            impact_center: ForwardLeft { forward, left },
            size: size?,
            crush: match crush {
                Some(crush) => Some(crush?),
                None => None,
            },
            braking: None,
        })
    }

    /// Reads the size of a vehicle on a plan, each number of which may be left out.
    fn size(&self, table: &Table<'_>) -> Option<Size> {
        let length = |key| table.has(key).then(|| self.length(table.optional(key)));
        let [length, width, front_overhang] = ["length", "width", "front_overhang"].map(length);
        if [length, width, front_overhang].contains(&Some(None)) {
            return None;
        }
        if let (Some(Some(length)), Some(Some(overhang))) = (length, front_overhang)
            && overhang >= length
        {
            table.optional("front_overhang").report(format!("it is {overhang} m; it must be below the length, {length} m"), None);
            return None;
        }
        Some(Size { length: length.flatten(), width: width.flatten(), front_overhang: front_overhang.flatten() })
    }

    /// Reads a length on the plan of a vehicle.
    fn length(&self, field: Field<'_>) -> Option<f64> {
        let path = field.path().to_owned();
        let length = self.positive(field, Kind::LENGTH)?;
        self.notices.borrow_mut().extend(unusual::length(&path, length));
        Some(length)
    }

    /// Reads the mass of a vehicle that gives its weight instead.
    fn weight(&self, table: &Table<'_>, side: Side) -> Option<f64> {
        let field = table.required("weight");
        let key = field.path().to_owned();
        let mass = self.mass_of_weight(field, self.gravity());
        (one_of(table, "mass", "weight") == Some("weight")).then_some(())?;
        Some(self.keep(Parameter::Input(Input::Mass(side)), key, mass?))
    }

    /// Returns the acceleration of gravity in m/s²: that of the case, or the standard one.
    fn gravity(&self) -> f64 {
        self.uses_gravity.set(true);
        self.gravity.get().unwrap_or(planar_impact::STANDARD_GRAVITY)
    }

    fn inertia(&self, table: &Table<'_>, side: Side, implied: &ImpliedValues<'_>) -> Option<Inertia> {
        if !table.has("radius_of_gyration")
            && let Some(value) = implied.of_key(table, "yaw_inertia", Input::YawInertia(side))
        {
            return value.map(Inertia::Yaw);
        }
        match one_of(table, "yaw_inertia", "radius_of_gyration")? {
            "yaw_inertia" => self.input(table.required("yaw_inertia"), Parameter::Input(Input::YawInertia(side))).map(Inertia::Yaw),
            // The square would lose the sign, so it must be positive.
            _ => self.input(table.required("radius_of_gyration"), Parameter::RadiusOfGyration(side)).map(Inertia::Radius),
        }
    }

    fn velocity(&self, table: &Table<'_>, side: Side, implied: &ImpliedValues<'_>) -> Option<Velocity> {
        let components = [Input::VelocityX(side), Input::VelocityY(side)];
        if !table.has("speed") && !table.has("velocity") {
            if let Some(speed) = implied.of_key(table, "speed", Variable::Speed(side)) {
                return speed.map(Velocity::Speed);
            }
            if let Some(pair) = implied.of_pair(table, "velocity", components.map(Variable::Input)) {
                return pair.map(|[x, y]| Velocity::Components(Xy { x, y }));
            }
        }
        match one_of(table, "speed", "velocity")? {
            "speed" => self.input(table.required("speed"), Parameter::Speed(side)).map(Velocity::Speed),
            _ => self.inputs(table.required("velocity"), components).map(|[x, y]| Velocity::Components(Xy { x, y })),
        }
    }
}

/// Returns `true` if a vehicle has a yaw inertia.
fn has_inertia(vehicle: &Table<'_>) -> bool {
    vehicle.has("yaw_inertia") || vehicle.has("radius_of_gyration")
}

/// Returns which of two keys the table has; it must have exactly one.
pub(crate) fn one_of(table: &Table<'_>, first: &'static str, second: &'static str) -> Option<&'static str> {
    match (table.has(first), table.has(second)) {
        (true, true) => {
            table.optional(second).report(format!("`{first}` and `{second}` exclude each other"), Some("give one of them".to_owned()));
            Some(first)
        }
        (_, true) => Some(second),
        (true, _) => Some(first),
        (false, false) => {
            table.issue(format!("missing `{first}` or `{second}`"), None);
            None
        }
    }
}
