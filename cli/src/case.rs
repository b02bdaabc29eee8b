//! From a case file to the collision it describes.

mod answers;
mod crush;
mod given;
mod inputs;
mod knowledge;
mod parameter;
mod rest;
mod setup;
mod vehicle;

use std::path::Path;

use planar_impact::reconstruct::Variable;
use planar_impact::{Collision, CrushPlaneBracket, Impact, Refusal, Refusals};

pub use answers::{Answer, Answers, Crash3Answers, Crash3Key, CrushAnswers};
pub use crush::Crush;
#[cfg(test)]
pub use crush::CrushKey;
pub(crate) use given::Given;
pub use inputs::Inputs;
pub use knowledge::{Knowledge, Known, Sought, measure_of, measure_of_variable, parameter_of};
pub use parameter::{Parameter, number as vehicle_number};
pub use rest::RestInputs;
pub use setup::Setup;
pub use vehicle::Velocity;

use crate::document::{Document, Problem, Problems, Source};
use crate::exit::Failure;
use crate::units::Units;

/// What a case file says.
#[derive(Clone)]
pub struct Case {
    document: Document,
    /// Its title; empty if it has none.
    pub title: String,
    /// The names of the two vehicles.
    pub names: [String; 2],
    /// The numbers that it gives, in SI.
    pub inputs: Inputs,
    /// The collision and the crush that they make.
    pub setup: Setup,
    /// The collision alone.
    pub collision: Collision,
    /// The bracket of the crush plane, where the file gives the surfaces that meet.
    pub bracket: Option<CrushPlaneBracket>,
    /// What is known after the crash, and what is asked.
    pub knowledge: Knowledge,
    /// How the vehicles came to rest, where the file says so.
    pub rest: Option<RestInputs>,
    /// The units that most of its quantities are in.
    pub units: Units,
    /// What was taken for granted, such as the unit of a number without one.
    pub notes: Vec<String>,
}

impl Case {
    /// Reads a file, or standard input for `-`, for what needs every number.
    ///
    /// # Errors
    ///
    /// Everything wrong with it, and everything that it leaves out because it is unknown.
    pub fn read(path: &Path) -> Result<Case, Problems> {
        Case::read_for(path, |_| true)
    }

    /// The same for what needs some numbers alone.
    ///
    /// # Errors
    ///
    /// Everything wrong with it, and what is needed and left out.
    pub fn read_for(path: &Path, needs: impl Fn(Variable) -> bool) -> Result<Case, Problems> {
        let case = Case::read_with_unknowns(path)?;
        let unknown = |left_out: &knowledge::LeftOut| {
            let help = "`planar-impact reconstruct` solves for it";
            let at = case.document.problem(&left_out.key, "it is unknown, and not given", Some(help.to_owned()));
            Problem { key: left_out.of.name().to_owned(), ..at }
        };
        let list: Vec<Problem> = case.knowledge.left_out.iter().filter(|left_out| needs(left_out.of)).map(unknown).collect();
        if list.is_empty() { Ok(case) } else { Err(case.document.refuse(list)) }
    }

    /// Reads a file of which some numbers may be unknown: what stands in their place is where the search for them starts.
    ///
    /// # Errors
    ///
    /// Everything wrong with it.
    pub fn read_with_unknowns(path: &Path) -> Result<Case, Problems> {
        Case::parse(Source::read(path)?)
    }

    /// Reads a text.
    ///
    /// # Errors
    ///
    /// Everything wrong with it.
    pub fn parse(source: Source) -> Result<Case, Problems> {
        let document = Document::parse(source)?;
        let given = Given::default();
        let read = document.read(|root| given.case(root))?;
        let units = given.units();
        let setup = read.inputs.as_given();
        Ok(Case {
            document,
            title: read.title,
            names: read.names,
            inputs: read.inputs,
            collision: setup.collision,
            setup,
            bracket: read.bracket,
            knowledge: read.knowledge,
            rest: read.rest,
            units,
            notes: given.notes.into_inner(),
        })
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
        Case { setup: Setup { collision, crush: case.setup.crush.clone() }, collision, ..case }
    }

    /// What is possible and still deserves a second look.
    pub fn cautions(&self, impact: &Impact) -> Vec<String> {
        let mut cautions = Vec::new();
        for (i, party) in [&self.collision.one, &self.collision.two].into_iter().enumerate() {
            if let Some(vehicle) = party.vehicle() {
                let radius = (vehicle.yaw_inertia / vehicle.mass).sqrt();
                // Cars to trucks have 0.9 to 2.5 m.
                if !(0.5..=5.0).contains(&radius) {
                    cautions
                        .push(format!("vehicle.{}: a radius of gyration of {radius:.3} m is unusual; check mass and yaw inertia", i + 1));
                }
            }
        }
        if let Some(admissible) = self.collision.admissible()
            && self.collision.restitution > admissible.restitution_for_any_approach
        {
            cautions.push(format!(
                "the restitution is above {:.3}, beyond which some approach velocities gain energy in this contact",
                admissible.restitution_for_any_approach
            ));
        }
        if impact.work.t > 0.0 && impact.work.t > 1e-9 * impact.loss() {
            cautions.push("the tangential impulse gives energy back: W_t is positive".to_owned());
        }
        cautions
    }

    /// Why the library refuses the collision, as the input's fault or the physics', each reason at its place in the file.
    pub fn refuse(&self, refusals: &Refusals, units: Units) -> Failure {
        let problems = self.place(refusals, units);
        if refusals.reasons().iter().all(Refusal::is_physical) { Failure::Physics(problems) } else { Failure::Input(problems) }
    }

    /// Why the file does not do for what is asked of it: a key with a message and a help for each.
    pub fn unfit(&self, problems: impl IntoIterator<Item = (String, String, Option<String>)>) -> Failure {
        let list = problems.into_iter().map(|(key, message, help)| self.document.problem(&key, message, help)).collect();
        Failure::Input(self.document.refuse(list))
    }

    /// The same where the physics refuses what is asked.
    pub fn refused(&self, problems: impl IntoIterator<Item = (String, String, Option<String>)>) -> Failure {
        match self.unfit(problems) {
            Failure::Input(problems) => Failure::Physics(problems),
            other => other,
        }
    }

    fn place(&self, refusals: &Refusals, units: Units) -> Problems {
        let problem = |refusal: &Refusal| {
            let (key, message, help) = crate::wording::refusal(refusal, units);
            self.document.problem(key, message, help)
        };
        let list: Vec<Problem> = refusals.reasons().iter().map(problem).collect();
        self.document.refuse(list)
    }
}
