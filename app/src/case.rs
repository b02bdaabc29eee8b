//! From a case file to the collision it describes.

mod braking;
mod contents;
mod crush;
mod domain;
mod inputs;
mod knowledge;
mod model;
mod outputs;
mod parameter;
mod reader;
mod rest;
mod restitution;
mod setup;
mod uncertain;
mod vehicle;

use std::sync::{Arc, Mutex};

use planar_impact::reconstruct::Variable;
use planar_impact::{Collision, CrushPlaneBracket, Impact, ImpulseRatio, Input, Law, Moment, Output, Refusal, Refusals, Side, Vehicle, Xy};

pub use braking::{BrakingInputs, SkidKey, SkidNumber};
use contents::Contents;
pub use contents::{Entry, EntryValue};
pub use crush::Crush;
pub use crush::{CrushInputs, CrushKey, FormKey, StiffnessInputs};
pub use domain::Domain;
pub use inputs::{ContactInputs, Inputs};
pub(crate) use inputs::{moment_parameter, ratio_parameter};
pub(crate) use knowledge::correlation_of;
pub use knowledge::{Knowledge, Known, RequestedUnknown, parameter_of, variable_of};
pub use model::ContactModel;
pub use outputs::{CaseOutput, CaseOutputs, Crash3Key, Crash3Outputs, CrushOutputs};
pub use parameter::{Parameter, number as vehicle_number};
pub(crate) use reader::{CaseReader, Recorded, Rows, one_of, read_cell, report_file};
pub(crate) use rest::wheel_name;
pub use rest::{RestInputs, RestOfVehicle, WHEELS};
pub use restitution::{CurvePoint, Restitution, RestitutionCurve, closing_speed};
pub use setup::Setup;
pub(crate) use uncertain::MOST_VALUES;
pub use uncertain::{InputCorrelation, Uncertain, UncertainInput};
pub use vehicle::{Inertia, Size, VehicleInputs, Velocity};

use crate::answer::Answer;
use crate::document::{Document, FileKind};
use crate::issue::{Cause, Issue, Issues};
use crate::message::Message;
use crate::notice::{Notice, Notices};
use crate::source::{Open, Source};
use crate::units::{Measure, Units};
use crate::{doubtful, unusual};

/// A case file, read and checked.
#[derive(Clone)]
pub struct Case {
    document: Document,
    contents: Arc<Contents>,
    /// Its title; empty if it has none.
    pub title: String,
    /// The names of the two vehicles.
    pub names: [String; 2],
    /// The numbers that it gives, in SI; those that are uncertain at their nominal values.
    pub inputs: Inputs,
    /// The inputs that it gives with an uncertainty.
    pub uncertain: Uncertain,
    /// The collision and the crush that they make.
    pub setup: Setup,
    /// The collision alone.
    pub collision: Collision,
    /// What determines the impulse.
    pub model: ContactModel,
    /// The bracket of the crush plane, where the file gives the surfaces that meet.
    pub bracket: Option<CrushPlaneBracket>,
    /// Evidence and unknowns.
    pub knowledge: Knowledge,
    /// Where on the scene the vehicles met, if the file says so.
    pub scene: Option<Xy>,
    /// The path of each vehicle to rest; `None` if the file does not give it.
    pub rest: Option<RestInputs>,
    /// The files that it names, each by the name that it gives.
    pub named_files: Vec<Source>,
    /// The units that most of its quantities are in.
    pub units: Units,
    /// Assumptions, such as the unit of a number without one.
    pub notices: Notices,
}

impl Case {
    /// Reads the text of a case file that names no other file. What the file lists under `[unknown]` stands at the start of its search.
    ///
    /// # Errors
    ///
    /// Everything wrong with it.
    pub fn parse(source: Source) -> Result<Case, Issues> {
        Case::read(source, CaseReader::default())
    }

    /// The same for a case file that may name files of barrier tests or of measured values, which `open` reads.
    ///
    /// # Errors
    ///
    /// Everything wrong with it and with the files that it names.
    pub fn parse_with(source: Source, open: Open) -> Result<Case, Issues> {
        let opened: Arc<Mutex<Vec<Source>>> = Arc::default();
        let keep = opened.clone();
        let open: Open = Box::new(move |name| {
            let file = open(name)?;
            if let Ok(mut opened) = keep.lock() {
                opened.push(Source { name: name.to_owned(), ..file.clone() });
            }
            Ok(file)
        });
        let mut case = Case::read(source, CaseReader::opening(open))?;
        case.named_files = opened.lock().map(|opened| opened.clone()).unwrap_or_default();
        case.named_files.dedup_by(|one, other| one.name == other.name);
        Ok(case)
    }

    fn read(source: Source, given: CaseReader) -> Result<Case, Issues> {
        let document = Document::parse(source)?;
        let read = document.read_as(FileKind::Case, |root| given.case(root))?;
        let units = given.units();
        let setup = read.inputs.as_given();
        Ok(Case {
            document,
            contents: Arc::new(given.contents.take()),
            title: read.title,
            names: read.names,
            inputs: read.inputs,
            uncertain: read.uncertain,
            collision: setup.collision,
            setup,
            model: read.model,
            bracket: read.bracket,
            knowledge: read.knowledge,
            scene: read.scene,
            rest: read.rest,
            named_files: Vec::new(),
            units,
            notices: Notices(given.notices.into_inner()),
        })
    }

    /// Refuses a case that lists numbers under `[unknown]` which a verb needs, or that has them as uncertain evidence alone.
    ///
    /// # Errors
    ///
    /// Each number that is needed and unknown, at its entry under `[unknown]`, or at the vehicle or the contact that has only evidence of it.
    pub fn needs(&self, is_needed: impl Fn(Variable) -> bool) -> Result<(), Issues> {
        let missing: Vec<Issue> = self
            .knowledge
            .left_out
            .iter()
            .filter(|left_out| is_needed(left_out.of))
            .map(|left_out| {
                // The form of the ratio or of the inertia that is asked for.
                let name = left_out.key.strip_prefix("unknown.").unwrap_or_else(|| left_out.of.name()).to_owned();
                if left_out.is_evidence() {
                    let message = "missing: `[evidence]` measures it with an uncertainty, and this verb needs a value";
                    let help = "give it here; `planar-impact reconstruct` solves for it from the evidence";
                    return self.document.place(Issue::at("unknown", name, message).with_help(help));
                }
                let at = Issue::at("unknown", left_out.key.clone(), "missing: listed under `[unknown]`, so this verb needs a value")
                    .with_help("`planar-impact reconstruct` solves for it");
                Issue { path: name, ..self.document.place(at) }
            })
            .collect();
        if missing.is_empty() { Ok(()) } else { Err(self.document.refuse(Cause::Input, missing)) }
    }

    /// The same for a verb that needs every number.
    ///
    /// # Errors
    ///
    /// Each number that is unknown; a contact that momentum alone determines.
    pub fn needs_everything(&self) -> Result<(), Issues> {
        self.needs_contact()?;
        self.needs(|_| true)
    }

    /// Refuses a case that momentum alone determines, for a verb that solves an impact.
    ///
    /// # Errors
    ///
    /// The model of the contact.
    pub fn needs_contact(&self) -> Result<(), Issues> {
        if !self.model.is_momentum() {
            return Ok(());
        }
        let message = "momentum alone does not determine how the vehicles separate, and this verb needs that";
        let help = "`planar-impact reconstruct` finds speeds by momentum; for this verb leave `model` out and give `crush_plane` and `restitution`";
        Err(self.unfit([Issue::at("by-momentum", "contact.model", message).with_help(help)]))
    }

    /// Refuses a case that gives the restitution over the closing speed, for a verb that needs a number.
    ///
    /// # Errors
    ///
    /// The restitution, with the number that the curve has at the closing speed of the file.
    pub fn needs_one_restitution(&self) -> Result<(), Issues> {
        if self.inputs.contact.restitution.given().is_some() {
            return Ok(());
        }
        let path = "contact.restitution";
        let help = "give a number, here or as an unknown with a range, such as contact.restitution = { start = 0.1, min = 0, max = 0.3 }; \
                    `uncertainty` and `sweep` follow the curve";
        let issue =
            Issue::at("restitution-of-curve", path, "it is given over the closing speed, which is not known before it is solved for");
        Err(self.unfit([issue.with_help(help)]))
    }

    /// Solves its collision.
    ///
    /// # Errors
    ///
    /// Numbers that the case lists as unknown, or every reason why the physics refuses the collision.
    pub fn impact(&self) -> Result<Impact, Issues> {
        self.needs_everything()?;
        self.collision.solve().map_err(|refusals| self.refuse(&refusals))
    }

    /// Wraps the facts of a verb that uses one number for each input into an answer, with the notices of the case and further ones.
    pub fn answer<T>(&self, facts: T, further: impl IntoIterator<Item = Notice>) -> Answer<T> {
        let nominal = at_nominal_values(self.uncertain.inputs.iter().map(|input| input.parameter));
        let notices = self.notices.0.iter().cloned().chain(nominal).chain(self.restitution_of_curve()).chain(further);
        Answer::new(&self.title, facts, Notices(notices.collect()))
    }

    /// Returns the notice of a restitution that follows the closing speed: its value, and whether the curve has points about that speed.
    fn restitution_of_curve(&self) -> Option<Notice> {
        let Restitution::OfClosingSpeed(curve) = &self.inputs.contact.restitution else { return None };
        let (speed, [first, last]) = (closing_speed(&self.collision), curve.range());
        let value = Message::from("contact.restitution is ")
            .figure(Measure::Ratio, self.collision.restitution)
            .text(", that of its curve at the closing speed of ")
            .figure(Measure::Speed, speed);
        let path = "contact.restitution";
        if (first..=last).contains(&speed) {
            return Some(Notice::note("restitution-of-curve", path, value.text("; it follows the inputs that change this speed")));
        }
        let range = value.text(", beyond its points from ").figure(Measure::Speed, first).text(" to ").figure(Measure::Speed, last);
        Some(Notice::warning("restitution-beyond-curve", path, range.text(", where it is constant")))
    }

    /// The same case with other values of some parameters, each of which [can be set](Inputs::can_set).
    pub fn with(&self, values: &[(Parameter, f64)]) -> Case {
        let inputs = self.inputs.set_all(values);
        let setup = inputs.as_given();
        Case { inputs, collision: setup.collision, setup, ..self.clone() }
    }

    /// The same case with another collision, which its inputs make to the last rounding.
    pub fn with_collision(&self, values: &[(Parameter, f64)], collision: Collision) -> Case {
        let case = self.with(values);
        Case { setup: Setup { collision, ..case.setup.clone() }, collision, ..case }
    }

    /// The file.
    pub fn source(&self) -> &Source {
        self.document.source()
    }

    /// The same case with another tangential law.
    pub(crate) fn with_law(&self, law: Law) -> Case {
        let mut case = self.clone();
        case.inputs.contact.law = law;
        case.setup = case.inputs.as_given();
        case.collision = case.setup.collision;
        case
    }

    /// The same case with other rest positions.
    pub(crate) fn with_rest(&self, rest: Option<RestInputs>) -> Case {
        Case { rest, ..self.clone() }
    }

    /// Warnings about motions before the impact that no road vehicle has.
    pub fn unusual_motions(&self) -> impl Iterator<Item = Notice> {
        self.vehicles().flat_map(|(path, vehicle)| {
            let unusual = unusual::motion(&path, vehicle.motion.velocity.length(), vehicle.motion.yaw_rate);
            let or_limit = |notice: Notice| Notice { message: notice.message.text(", or limit it if it is unknown"), ..notice };
            unusual.into_iter().flatten().map(or_limit)
        })
    }

    /// Returns each party that is a vehicle, with its path.
    fn vehicles(&self) -> impl Iterator<Item = (String, Vehicle)> {
        let parties = self.collision.parties().into_iter().zip(["vehicle.1", "vehicle.2"]);
        parties.filter_map(|(party, path)| Some((path.to_owned(), *party.vehicle()?)))
    }

    /// Warnings about a result that is possible and deserves a second look.
    pub fn warnings(&self, impact: &Impact) -> Vec<Notice> {
        let mut warnings = Vec::new();
        for (path, vehicle) in self.vehicles() {
            let unusual = unusual::vehicle(&path, vehicle.mass, vehicle.radius_of_gyration(), vehicle.impact_center.length());
            warnings.extend(unusual.into_iter().flatten());
        }
        warnings.extend(unusual::friction(&self.collision.impulse_ratio));
        warnings.extend(self.unusual_motions());
        warnings.extend(doubtful::result(&self.collision, impact, !warnings.is_empty()));
        warnings.extend(doubtful::tangential_work(impact.work.t, impact.loss()));
        let crush: f64 = self.setup.crush_outputs().iter().flatten().map(|crush| crush.energy).sum();
        warnings.extend(doubtful::crush(crush, Output::EnergyBefore.of(&self.collision, impact)));
        warnings
    }

    /// Returns the refusals of the library as issues of the input or of the physics, each at its place in the file.
    pub fn refuse(&self, refusals: &Refusals) -> Issues {
        let cause = if refusals.iter().all(Refusal::is_physical) { Cause::Physics } else { Cause::Input };
        self.document.refuse_at(cause, refusals.iter().map(|refusal| self.refusal(refusal, refusals)))
    }

    /// Returns one of some refusals as an issue, in the words of what the file gives.
    fn refusal(&self, refusal: &Refusal, all: &Refusals) -> Issue {
        let issue = crate::wording::refusal(refusal);
        let ratio = "contact.impulse_ratio";
        match (refusal, self.inputs.contact.impulse_ratio) {
            (Refusal::BeyondCritical { .. }, ImpulseRatio::OfCritical(share)) => {
                let message = format!("it is {share} of the critical ratio; it must be from 0 to 1");
                let issue = Issue { message: message.into(), path: format!("{ratio}.of_critical"), ..issue };
                issue.with_help("1 is the critical ratio itself; more, or the other sign, would speed the sliding up")
            }
            (Refusal::EnergyGain { .. }, _) if all.iter().any(|other| matches!(other, Refusal::BeyondCritical { .. })) => {
                Issue { path: ratio.to_owned(), ..issue }.with_help("a ratio beyond the critical one adds energy: correct it first")
            }
            (Refusal::EnergyGain { .. }, _) if self.gains_by_its_moment() => {
                let help = "the moment impulse adds the energy: give a smaller one, or check its sign";
                Issue { path: "contact.moment".to_owned(), ..issue }.with_help(help)
            }
            _ => self.of_radius(issue),
        }
    }

    /// Returns `true` if the contact has a moment impulse without which it would be lawful.
    fn gains_by_its_moment(&self) -> bool {
        self.collision.moment != Moment::None && Collision { moment: Moment::None, ..self.collision }.solve().is_ok()
    }

    /// Returns an issue of a yaw inertia at the radius of gyration that gives it, where there is one.
    fn of_radius(&self, issue: Issue) -> Issue {
        let is_at_fault = |side: &Side| {
            let vehicle = self.inputs.vehicles[*side as usize].as_ref();
            vehicle.is_some_and(|vehicle| matches!(vehicle.inertia, Inertia::Radius(_)))
                && issue.path == Parameter::Input(Input::YawInertia(*side)).to_string()
        };
        let Some(side) = Side::ALL.into_iter().find(is_at_fault) else { return issue };
        let message = Message::from("the yaw inertia that follows from it is out of range: ").join(issue.message);
        Issue { path: Parameter::RadiusOfGyration(side).to_string(), message, ..issue }.with_help("that of a car is from 1 m to 2 m")
    }

    /// Returns the issues that keep a verb from using the file, each at its place in it.
    pub fn unfit(&self, issues: impl IntoIterator<Item = Issue>) -> Issues {
        self.document.refuse_at(Cause::Input, issues)
    }

    /// The same where the physics refuses what is asked.
    pub fn refuse_physics(&self, issues: impl IntoIterator<Item = Issue>) -> Issues {
        self.document.refuse_at(Cause::Physics, issues)
    }
}

/// Returns the notice that uncertain inputs are taken at their nominal values, or `None` without any.
pub(crate) fn at_nominal_values(inputs: impl IntoIterator<Item = Parameter>) -> Option<Notice> {
    let names: Vec<String> = inputs.into_iter().map(|input| input.to_string()).collect();
    let path = if let [one] = &names[..] { one.clone() } else { String::new() };
    let message = match names.len() {
        0 => return None,
        1 => format!("{path} is uncertain, and used at its nominal value"),
        _ => format!("uncertain inputs are used at their nominal values: {}", names.join(", ")),
    };
    Some(Notice::note("nominal-values", path, message))
}
