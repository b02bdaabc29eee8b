//! The verb `batch`: a table of collisions, a row each.
//!
//! A [`Plan`] is made once from the headers of the columns, a case that supplies what no column has, and the question. It then solves the rows, any number at a
//! time, from [`Column`]s of cells. The mechanics is that of [`planar_impact::batch`], and each row has the bits of the case file that it stands for.

mod answer;
mod column;
mod header;
mod row;
mod row_warning;
mod watch;

use planar_impact::{ForwardLeft, ImpulseRatio, Input, Moment, Side, Xy};

pub use answer::{Answer, Refused};
pub use column::{Cell, Column, InputColumn, Key, NotARow, Table};
pub use header::{Header, separated_otherwise};
pub(crate) use header::{not_names, unit_in_name, units_below};
pub use row_warning::RowWarning;

use self::row::{ContactColumns, Defaults, VehicleColumns, VehicleDefaults};
use crate::case::{
    Case, CaseOutput, ContactInputs, CrushInputs, Inertia, Inputs, Parameter, Restitution, Size, VehicleInputs, Velocity,
    at_nominal_values, parameter_of, vehicle_number,
};
use crate::gradient::ratio_note;
use crate::issue::{Issue, Issues};
use crate::names;
use crate::notice::Notice;
use crate::quantity::{Kind, excerpt};

/// What is asked of every row.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Options {
    /// The outputs, by name or symbol; all of `solve` if empty.
    pub of: Vec<String>,
    /// The inputs to differentiate with respect to, by name or symbol.
    pub wrt: Vec<String>,
    /// `true` to check every solved row with the laws of mechanics.
    pub check: bool,
    /// `true` for fused multiplication and addition where the machine has it: faster, with last bits that differ between machines. See [`Batch::fast`].
    ///
    /// [`Batch::fast`]: planar_impact::batch::Batch::fast
    pub fast: bool,
}

/// The columns of a table that are inputs, and what is computed from them.
#[derive(Clone, Debug)]
pub struct Plan {
    inputs: Vec<InputColumn>,
    /// The columns that pass through with the name of an input in another form, and the headers of those inputs.
    unread: Vec<(String, Vec<String>)>,
    outputs: Vec<CaseOutput>,
    wrt: Vec<Parameter>,
    is_checked: bool,
    is_fast: bool,
    vehicles: [VehicleColumns; 2],
    contact: ContactColumns,
    defaults: Defaults,
    crush: [Option<CrushInputs>; 2],
}

/// The name of the column that has the codes of the refusals.
pub const REFUSAL: &str = "refusal";

/// The name of the column that has the rules that a row violates.
pub const CHECK: &str = "check";

impl Plan {
    /// Reads the headers of a table and the question.
    ///
    /// # Errors
    ///
    /// Every unknown, repeated, missing or contradictory column, and every unknown name of the question; a case that momentum alone determines.
    pub fn of(headers: &[Header], base: Option<&Case>, options: &Options) -> Result<Plan, Issues> {
        base.map_or(Ok(()), Case::needs_contact)?;
        let mut issues = Vec::new();
        let (mut inputs, mut unread): (Vec<InputColumn>, Vec<(String, Vec<String>)>) = (Vec::new(), Vec::new());
        for (place, header) in headers.iter().enumerate() {
            match InputColumn::of(place, header) {
                Ok(Some(column)) => match inputs.iter().find(|other| other.key == column.key) {
                    Some(_) => issues.push(Issue::at("repeated-column", header.name.clone(), "two columns have this name; keep one")),
                    None => inputs.push(column),
                },
                Ok(None) => {
                    let meant = column::meant_by(header);
                    if !meant.is_empty() || column::is_of_evidence(&header.name) {
                        unread.push((header.name.clone(), meant));
                    }
                }
                Err(issue) => issues.push(issue),
            }
        }
        if let Some([wrong, remedy]) = not_names(headers).filter(|_| inputs.is_empty()) {
            return Err(Issues::of_call(vec![Issue::of_file("no-input-column", wrong).with_help(remedy)]));
        }
        if base.is_some() && !headers.is_empty() && inputs.is_empty() && issues.is_empty() {
            let message = "no column is an input of a collision, so every row would be the case itself";
            let help = "name the columns as in a case file, such as vehicle.1.speed or contact.restitution";
            issues.push(Issue::of_file("no-input-column", message).with_help(help));
        }
        let crush = base.map_or([None, None], |case| case.inputs.vehicles.each_ref().map(|vehicle| vehicle.as_ref()?.crush.clone()));
        let mut plan = Plan {
            outputs: Vec::new(),
            wrt: Vec::new(),
            is_checked: options.check,
            is_fast: options.fast,
            vehicles: Side::ALL.map(|side| VehicleColumns::of(side, &inputs)),
            contact: ContactColumns::of(&inputs),
            defaults: base.map_or_else(Defaults::without_case, Defaults::of),
            crush,
            inputs,
            unread,
        };
        plan.missing(&mut issues);
        plan.impossible(&mut issues);
        plan.scatter(&mut issues);
        let template = plan.template();
        let setup = template.as_given();
        plan.outputs = names::outputs("--of", &options.of, &setup, &mut issues).unwrap_or_else(|| setup.outputs());
        plan.wrt = plan.parameters(&options.wrt, &template, &mut issues);
        for (i, name) in plan.names().iter().enumerate() {
            if headers.iter().any(|header| header.name == *name) {
                let taken = "the table has a column of this name already";
                let help = if [REFUSAL, CHECK].contains(&name.as_str()) {
                    "drop or rename it"
                } else {
                    "drop or rename it, or name the outputs that are needed with --of"
                };
                issues.push(Issue::at("repeated-column", name.clone(), taken).with_help(help));
            } else if plan.names()[..i].contains(name) {
                return Err(Issues::defect(format!("two outputs are named {name}")));
            }
        }
        if issues.is_empty() { Ok(plan) } else { Err(Issues::of_call(issues)) }
    }

    /// The input columns.
    pub fn inputs(&self) -> &[InputColumn] {
        &self.inputs
    }

    /// The outputs.
    pub fn outputs(&self) -> &[CaseOutput] {
        &self.outputs
    }

    /// The inputs that outputs are differentiated with respect to.
    pub fn wrt(&self) -> &[Parameter] {
        &self.wrt
    }

    /// Whether every solved row is checked with the laws of mechanics.
    pub fn is_checked(&self) -> bool {
        self.is_checked
    }

    /// Returns what a reader of the answer must know: which uncertain numbers of the case rows use at their nominal values, because no column gives them, which
    /// units are assumed, and which columns pass through although they may be meant as inputs.
    pub fn notices(&self, base: Option<&Case>) -> Vec<Notice> {
        let is_given = |parameter: Parameter| self.inputs.iter().any(|column| column.key.replaces(parameter));
        let uncertain = base.into_iter().flat_map(|case| &case.uncertain.inputs).map(|input| input.parameter);
        let unread = self.unread.iter().map(|(name, meant)| {
            let as_input = match meant.is_empty() {
                true => "a table has inputs of the collision alone, which begin with `vehicle.` or `contact.`".to_owned(),
                false => format!("as an input it is named {}", meant.join(" or ")),
            };
            let message = format!("the column {} passes through unread; {as_input}", excerpt(name));
            Notice::warning("unread-column", name.clone(), message)
        });
        let in_si = self.inputs.iter().filter_map(|bare| {
            let unit = bare.assumed_unit()?;
            let other = self.inputs.iter().find(|other| other.has_unit_of(bare))?;
            let message = format!("{} has no unit and is read in {unit}, beside {}, which has one: give each its own", bare.key, other.key);
            Some(Notice::warning("mixed-units", bare.key.to_string(), message))
        });
        let loses_motion = |(side, columns): &(Side, &VehicleColumns)| {
            let of_case = base.and_then(|case| case.inputs.vehicles[*side as usize].as_ref());
            columns.speed.is_some() && of_case.is_some_and(VehicleInputs::moves_across)
        };
        let replaced = Side::ALL.into_iter().zip(&self.vehicles).filter(loses_motion).map(|(side, _)| {
            let speed = Parameter::Speed(side);
            let [x, y] = [Input::VelocityX(side), Input::VelocityY(side)];
            let message = format!(
                "{speed}: it replaces the whole velocity of the case, and the component across the heading is lost; to keep it, write the columns {x} and {y}"
            );
            Notice::warning("motion-across-lost", speed.to_string(), message)
        });
        let pounds = self.inputs.iter().filter(|column| column.has_pound_force());
        let pounds = pounds.map(|column| Notice::pound_force_assumed(&column.key.to_string()));
        // A few degrees are as plausible in radians. Where others have a unit, one without may have been forgotten.
        let some_have = self.inputs.iter().any(InputColumn::has_unit);
        let assumed: Vec<(&InputColumn, &str)> = self.inputs.iter().filter_map(|column| Some((column, column.assumed_unit()?))).collect();
        let is_in_radians = |unit: &str| [Kind::ANGLE.si, Kind::YAW_RATE.si].contains(&unit);
        let angles: Vec<String> =
            assumed.iter().filter(|(_, unit)| is_in_radians(unit)).map(|(column, _)| column.key.to_string()).collect();
        let assumed = match &assumed[..] {
            [(first, _), ..] if some_have => {
                let all: Vec<String> = assumed.iter().map(|(column, unit)| format!("{} [{unit}]", column.key)).collect();
                let message = format!("read in SI for want of a unit: {}; write the unit of each behind its name", all.join(", "));
                Some(Notice::note("unit-assumed", first.key.to_string(), message))
            }
            _ => angles.first().map(|first| {
                let message = format!(
                    "read in radians for want of a unit: {}; write [deg] or [deg/s] behind the name of one in degrees",
                    angles.join(", ")
                );
                Notice::note("unit-assumed", first.clone(), message)
            }),
        };
        // Rows may give a number of their own.
        let ratio = Parameter::Input(Input::ImpulseRatio);
        let follows = base.filter(|_| self.wrt.contains(&ratio) && !is_given(ratio)).and_then(ratio_note);
        // What was assumed of the numbers of the case that no column replaces.
        let is_of_units = |notice: &&Notice| ["unit-assumed", "pound-force-assumed", "mixed-units"].contains(&notice.code);
        let is_replaced = |path: &str| self.inputs.iter().any(|column| path.starts_with(&column.key.to_string()));
        let of_case = base.into_iter().flat_map(|case| &case.notices.0).filter(is_of_units);
        let of_case = of_case.filter(|notice| !is_replaced(&notice.path)).cloned();
        at_nominal_values(uncertain.filter(|parameter| !is_given(*parameter)))
            .into_iter()
            .chain(of_case)
            .chain(follows)
            .chain(unread)
            .chain(in_si)
            .chain(replaced)
            .chain(pounds)
            .chain(assumed)
            .collect()
    }

    /// Returns the names of the columns that are added to those of the table: outputs, derivatives, the check, refusals.
    pub fn names(&self) -> Vec<String> {
        let outputs: Vec<String> = self.outputs.iter().copied().map(CaseOutput::qualified_name).collect();
        let derivatives = outputs.iter().flat_map(|of| self.wrt.iter().map(move |by| format!("d {of} / d {by}")));
        let derivatives: Vec<String> = derivatives.collect();
        let check = self.is_checked.then(|| CHECK.to_owned());
        outputs.into_iter().chain(derivatives).chain(check).chain([REFUSAL.to_owned()]).collect()
    }

    /// Returns the named inputs, in order and without repetition: those of the columns, and those of the case.
    fn parameters(&self, wrt: &[String], template: &Inputs, issues: &mut Vec<Issue>) -> Vec<Parameter> {
        let mut all: Vec<Parameter> = Vec::new();
        for name in wrt {
            let column =
                Parameter::named(name.trim()).filter(|named| self.inputs.iter().any(|column| column.key == Key::Parameter(*named)));
            let found = match column {
                Some(parameter) => vec![parameter],
                None => names::parameters("--wrt", std::slice::from_ref(name), template, issues).unwrap_or_default(),
            };
            found.into_iter().for_each(|one| {
                if !all.contains(&one) {
                    all.push(one)
                }
            });
        }
        all
    }

    /// Reports what neither a column nor a case gives.
    fn missing(&self, issues: &mut Vec<Issue>) {
        for ((vehicle, default), side) in self.vehicles.iter().zip(&self.defaults.vehicles).zip(Side::ALL) {
            if vehicle.barrier.is_some() || default.is_barrier {
                continue;
            }
            let number = vehicle_number(side);
            if !vehicle.has_any && default.mass.is_none() {
                let help = "add its columns, or give a case with --case; a fixed barrier is in a case, or a column of `true`";
                issues
                    .push(Issue::at("missing-column", format!("vehicle.{number}"), "neither a column nor a case gives it").with_help(help));
                continue;
            }
            let is_there = |column: Option<usize>| column.is_some();
            let needed = [
                (is_there(vehicle.mass) || default.mass.is_some(), "mass"),
                (is_there(vehicle.yaw_inertia) || is_there(vehicle.radius) || default.inertia.is_some(), "yaw_inertia"),
                (is_there(vehicle.heading) || default.heading.is_some(), "heading"),
                (is_there(vehicle.speed) || vehicle.velocity.into_iter().all(is_there) || default.velocity.is_some(), "speed"),
                (is_there(vehicle.center[0]) || default.forward.is_some(), "impact_center.forward"),
                (is_there(vehicle.center[1]) || default.left.is_some(), "impact_center.left"),
            ];
            issues.extend(needed.into_iter().filter(|(is_there, _)| !is_there).map(|(_, key)| missing(&format!("vehicle.{number}.{key}"))));
        }
        let (contact, default) = (&self.contact, &self.defaults);
        let needed = [
            (contact.crush_plane.is_some() || default.crush_plane.is_some(), "contact.crush_plane"),
            (contact.restitution.is_some() || default.restitution.is_some() || default.has_curve, "contact.restitution"),
            (contact.ratio.iter().any(Option::is_some) || default.impulse_ratio.is_some(), "contact.impulse_ratio"),
        ];
        issues.extend(needed.into_iter().filter(|(is_there, _)| !is_there).map(|(_, name)| missing(name)));
        if contact.restitution.is_none() && default.has_curve {
            let message = "the case gives it over the closing speed, which the rows of a table do not follow";
            let help = "add the column, or give a number in the case; `uncertainty` and `sweep` follow the curve";
            issues.push(Issue::at("missing-column", "contact.restitution", message).with_help(help));
        }
    }

    /// Reports columns of what the case does not have.
    fn impossible(&self, issues: &mut Vec<Issue>) {
        for (i, (vehicle, default)) in self.vehicles.iter().zip(&self.defaults.vehicles).enumerate() {
            if default.is_barrier && vehicle.has_any && vehicle.barrier.is_none() {
                let message = "the case has a fixed barrier here, and the table has columns of a vehicle";
                let help = "drop them, or say which rows have a barrier in a column of `true` and `false` named as this";
                issues.push(Issue::at("conflict", format!("vehicle.{}.barrier", i + 1), message).with_help(help));
            }
            for (column, key) in &vehicle.crush {
                let why = match &self.crush[i] {
                    None => Some("a crush is varied by columns where --case gives one; this case has none".to_owned()),
                    Some(crush) => crush.value(*key).err(),
                };
                issues.extend(why.map(|why| Issue::at("not-in-case", self.inputs[*column].key.to_string(), why)));
            }
        }
    }

    /// Reports the scatter of a restitution over the closing speed, which no row has.
    fn scatter(&self, issues: &mut Vec<Issue>) {
        for column in self.inputs.iter().filter(|column| column.key == Key::Parameter(Parameter::RestitutionScatter)) {
            let message = "the rows of a table do not follow a restitution over the closing speed";
            issues.push(Issue::at("not-in-case", column.key.to_string(), message).with_help("give `contact.restitution`"));
        }
    }

    /// Returns a case that has every key which some row may have: names are resolved in it.
    fn template(&self) -> Inputs {
        let vehicle = |i: usize| {
            let (columns, default) = (&self.vehicles[i], &self.defaults.vehicles[i]);
            let is_barrier = default.is_barrier && columns.barrier.is_none();
            let radius = columns.radius.is_some() || matches!(default.inertia, Some(Inertia::Radius(_)));
            (!is_barrier).then(|| VehicleInputs {
                mass: 1.0,
                inertia: if radius { Inertia::Radius(1.0) } else { Inertia::Yaw(1.0) },
                heading: 0.0,
                velocity: Velocity::Components(Xy { x: 0.0, y: 0.0 }),
                yaw_rate: 0.0,
                impact_center: ForwardLeft { forward: 0.0, left: 0.0 },
                crush: self.crush[i].clone(),
                size: Size::default(),
                braking: None,
            })
        };
        let [ratio, share, friction] = self.contact.ratio;
        let forms =
            [(share, ImpulseRatio::OfCritical(1.0)), (friction, ImpulseRatio::LimitedByFriction(1.0)), (ratio, ImpulseRatio::Given(0.0))];
        let given = forms.into_iter().find(|(column, _)| column.is_some()).map(|(_, form)| form);
        let moments = self.contact.moment.into_iter().zip([Moment::Given(0.0), Moment::OfCritical(0.0)]);
        let moment = moments.filter(|(column, _)| column.is_some()).map(|(_, form)| form).next_back();
        Inputs {
            vehicles: [vehicle(0), vehicle(1)],
            contact: ContactInputs {
                crush_plane: 0.0,
                restitution: Restitution::Given(0.0),
                impulse_ratio: given.or(self.defaults.impulse_ratio).unwrap_or(ImpulseRatio::Critical),
                law: self.defaults.law,
                moment: moment.or(self.defaults.moment).unwrap_or(Moment::None),
            },
        }
    }
}

fn missing(name: &str) -> Issue {
    let help = match name.rsplit_once('.').map(|(_, key)| key) {
        Some("yaw_inertia") => "add this column or `radius_of_gyration`, or give a case with --case",
        Some("speed") => "add this column or `velocity.x` and `velocity.y`, or give a case with --case",
        _ => "add the column, or give a case with --case",
    };
    Issue::at("missing-column", name, "neither a column nor a case gives it").with_help(help)
}

impl VehicleDefaults {
    /// What a case file may leave out of a vehicle.
    fn left_out() -> Self {
        VehicleDefaults { yaw_rate: Some(0.0), ..VehicleDefaults::default() }
    }
}

impl Defaults {
    /// What a case file may leave out.
    fn without_case() -> Self {
        Defaults {
            vehicles: [VehicleDefaults::left_out(), VehicleDefaults::left_out()],
            impulse_ratio: Some(ImpulseRatio::Critical),
            moment: Some(Moment::None),
            ..Defaults::default()
        }
    }

    /// The numbers of a case, but for those that it lists as unknown.
    fn of(case: &Case) -> Self {
        let unknown: Vec<Parameter> = case.knowledge.left_out.iter().filter_map(|left_out| parameter_of(left_out.of)).collect();
        let known = |parameter: Parameter| !unknown.contains(&parameter);
        let vehicle = |i: usize, side: Side| {
            let Some(vehicle) = &case.inputs.vehicles[i] else {
                return VehicleDefaults { is_barrier: true, ..VehicleDefaults::left_out() };
            };
            let number = |input: fn(Side) -> Input, value: f64| known(Parameter::Input(input(side))).then_some(value);
            let has_inertia = known(Parameter::RadiusOfGyration(side)) && known(Parameter::Input(Input::YawInertia(side)));
            let of_velocity = [Parameter::Speed(side), Parameter::Input(Input::VelocityX(side)), Parameter::Input(Input::VelocityY(side))];
            VehicleDefaults {
                is_barrier: false,
                mass: number(Input::Mass, vehicle.mass),
                inertia: has_inertia.then_some(vehicle.inertia),
                heading: number(Input::Heading, vehicle.heading),
                velocity: of_velocity.into_iter().all(known).then_some(vehicle.velocity),
                yaw_rate: number(Input::YawRate, vehicle.yaw_rate),
                forward: number(Input::ImpactCenterForward, vehicle.impact_center.forward),
                left: number(Input::ImpactCenterLeft, vehicle.impact_center.left),
            }
        };
        let contact = &case.inputs.contact;
        let is_known = |input: Input| known(Parameter::Input(input));
        Defaults {
            vehicles: [vehicle(0, Side::One), vehicle(1, Side::Two)],
            crush_plane: is_known(Input::CrushPlane).then_some(contact.crush_plane),
            restitution: contact.restitution.given().filter(|_| is_known(Input::Restitution)),
            has_curve: contact.restitution.given().is_none(),
            impulse_ratio: is_known(Input::ImpulseRatio).then_some(contact.impulse_ratio),
            law: contact.law,
            moment: is_known(Input::Moment).then_some(contact.moment),
        }
    }
}

#[cfg(test)]
mod tests;
