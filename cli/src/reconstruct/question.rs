//! From a case to the question that the library answers.

use planar_impact::reconstruct::{Evidence, Measurable, Reconstruction, Uncertainty, Unknown, Variable};
use planar_impact::{ForwardLeft, Heading, ImpulseRatio, Input, Moment, Side, Xy};

use super::from_rest::{self, FromRest};
use crate::case::{Case, Known, Parameter, Sought, Velocity, measure_of_variable, parameter_of};
use crate::exit::Failure;
use crate::units::{Measure, Units};

/// How far across its heading a vehicle may go that is said to drive along it, as a share of its speed.
const ALONG: f64 = 1e-6;

/// The question, and what had to be said on the way to it.
pub struct Question {
    /// The case with what is certain by the evidence in its place.
    pub case: Case,
    /// What is asked.
    pub asked: Reconstruction,
    /// Evidence that stands in the case as it is, and is not weighed.
    pub certain: Vec<Evidence>,
    /// Where the file has the unknowns and the evidence, in the order of the question.
    pub places: Places,
    /// What was taken for granted.
    pub notes: Vec<String>,
    /// Whether a vehicle could have separated in other ways and come to the same rest, of which only one was asked about.
    pub has_other_separations: bool,
}

/// Where the file has what the question is made of.
#[derive(Default)]
pub struct Places {
    unknowns: Vec<(Variable, String)>,
    evidence: Vec<(Measurable, String)>,
}

impl Places {
    /// The key of an unknown, the last one where there are several; of one that only the evidence names, that of the evidence.
    pub fn of_unknown(&self, of: Variable) -> String {
        let found = self.unknowns.iter().rfind(|(variable, _)| *variable == of);
        found.map_or_else(|| "unknown".to_owned(), |(_, key)| key.clone())
    }

    /// The key of a piece of evidence, the last one where there are several.
    pub fn of_evidence(&self, of: Measurable) -> String {
        let found = self.evidence.iter().rfind(|(measurable, _)| *measurable == of);
        found.map_or_else(|| "evidence".to_owned(), |(_, key)| key.clone())
    }
}

/// A problem: the key, what is wrong, what may help.
pub type Complaint = (String, String, Option<String>);

impl Question {
    /// Of a case.
    ///
    /// # Errors
    ///
    /// What does not fit together in it.
    pub fn of(case: &Case, units: Units) -> Result<Self, Failure> {
        let FromRest { case, correlations, has_others } = &from_rest::with_rest(case)?;
        let knowledge = &case.knowledge;
        let mut draft =
            Draft { case, units, unknowns: Vec::new(), evidence: Vec::new(), places: Places::default(), notes: case.notes.clone() };
        let (mut set, mut certain, mut crush_share) = (Vec::new(), Vec::new(), None);
        let mut complaints: Vec<Complaint> = knowledge.unknowns.iter().filter_map(|sought| misnamed(case, sought)).collect();
        for sought in &knowledge.unknowns {
            let start = draft.start(sought);
            // What has no doubt is no unknown.
            if sought.prior == Some(0.0) {
                draft.notes.push(format!("{} has a standard deviation of 0: it is taken as known", sought.of.name()));
                match key_of(sought.of, case) {
                    Some(key) => set.push((key, start)),
                    None => crush_share = Some(start),
                }
                continue;
            }
            draft.places.unknowns.push((sought.of, sought.key.clone()));
            draft.unknowns.push(Unknown { of: sought.of, start, min: sought.min, max: sought.max, prior: sought.prior });
        }
        for known in &knowledge.evidence {
            draft.places.evidence.push((known.of, known.key.clone()));
            let evidence = Evidence { of: known.of, value: known.value, uncertainty: known.uncertainty };
            match known.variable() {
                Some(variable) if draft.is_set(variable, known) => {
                    certain.push(evidence);
                    if variable == Variable::CrushShare {
                        crush_share = Some(known.value);
                    }
                }
                Some(variable) => {
                    draft.add_if_doubtful(variable, known);
                    draft.evidence.push(evidence);
                }
                None => draft.evidence.push(evidence),
            }
        }
        if crush_share.is_none() {
            draft.share_the_crush();
        }
        let drives_along_heading = [Side::One, Side::Two].map(|side| draft.drives_along_heading(side, &mut complaints));
        if !complaints.is_empty() {
            return Err(case.unfit(complaints));
        }
        let settled = case.with(&set);
        let asked = Reconstruction {
            unknowns: draft.unknowns,
            evidence: draft.evidence,
            correlations: correlations.clone(),
            drives_along_heading,
            crush_share,
            ..Reconstruction::of(settled.collision)
        };
        Ok(Question { case: settled, asked, certain, places: draft.places, notes: draft.notes, has_other_separations: *has_others })
    }
}

/// Why the way in which an unknown is called does not fit the case; none if it does.
fn misnamed(case: &Case, sought: &Sought) -> Option<Complaint> {
    let contact = &case.inputs.contact;
    let is_there = match sought.called? {
        Parameter::RatioOfCritical => matches!(contact.impulse_ratio, ImpulseRatio::OfCritical(_)),
        Parameter::Friction => matches!(contact.impulse_ratio, ImpulseRatio::LimitedByFriction(_)),
        _ => matches!(contact.moment, Moment::OfCritical(_)),
    };
    let given = match sought.of {
        Variable::Input(Input::Moment) => "moment",
        _ => "impulse ratio",
    };
    let help = "leave it out of [contact], or name the unknown as the contact gives it".to_owned();
    (!is_there).then(|| (sought.key.clone(), format!("the contact gives the {given} in another way"), Some(help)))
}

/// The question on the way.
struct Draft<'a> {
    case: &'a Case,
    units: Units,
    unknowns: Vec<Unknown>,
    evidence: Vec<Evidence>,
    places: Places,
    notes: Vec<String>,
}

impl Draft<'_> {
    fn seeks(&self, variable: Variable) -> bool {
        self.unknowns.iter().any(|unknown| unknown.of == variable)
    }

    /// The value that the case has for an unknown.
    fn of_case(&self, variable: Variable) -> Option<f64> {
        match key_of(variable, self.case) {
            None => self.share_of_crush(),
            Some(key) => self.case.inputs.value(key).ok(),
        }
    }

    /// Where the search for an unknown starts: as the file says, at what the evidence has, or at what the case has.
    fn start(&mut self, sought: &Sought) -> f64 {
        let of = sought.of;
        if let Some(start) = sought.start {
            return start;
        }
        if let Some(known) = self.case.knowledge.of(Measurable::Variable(of)) {
            return known.value;
        }
        let start = self.of_case(of);
        if let Some(start) = start {
            let value = self.units.quantity(measure_in(of, self.case), start);
            let whose = if of == Variable::CrushShare { "that of the crush" } else { "that of the case" };
            self.notes.push(format!("the search for {} starts at {value}, {whose}", of.name()));
        }
        // What the collision does not have is refused by the library.
        start.unwrap_or(0.5)
    }

    /// Whether evidence of an input is its value in the case: it has no doubt, and is not solved for.
    fn is_set(&self, variable: Variable, known: &Known) -> bool {
        let is_there = variable == Variable::CrushShare || self.of_case(variable).is_some();
        known.uncertainty == Uncertainty::Exact && is_there && !self.case.knowledge.seeks(variable)
    }

    /// Adds an input to the unknowns that the evidence knows with doubt.
    fn add_if_doubtful(&mut self, variable: Variable, known: &Known) {
        if self.seeks(variable) || self.is_known_by_others(variable) || known.uncertainty == Uncertainty::Exact {
            return;
        }
        self.places.unknowns.push((variable, known.key.clone()));
        self.unknowns.push(Unknown { of: variable, start: known.value, min: None, max: None, prior: None });
        self.notes.push(format!("{} is solved for too: the evidence gives it with an uncertainty", variable.name()));
    }

    /// Whether a speed follows from components that are solved for, or a component from a speed.
    fn is_known_by_others(&self, variable: Variable) -> bool {
        match variable {
            Variable::Speed(side) => self.seeks_component(side),
            Variable::Input(Input::VelocityX(side) | Input::VelocityY(side)) => self.seeks(Variable::Speed(side)),
            _ => false,
        }
    }

    fn seeks_component(&self, side: Side) -> bool {
        [Input::VelocityX(side), Input::VelocityY(side)].into_iter().any(|input| self.seeks(Variable::Input(input)))
    }

    /// The share that vehicle 1 has of the energies of both crushes.
    fn share_of_crush(&self) -> Option<f64> {
        let [one, two] = [Side::One, Side::Two].map(|side| self.crush_energy(side));
        let (one, two) = (one?, two?);
        (one + two > 0.0).then(|| one / (one + two))
    }

    /// The crush energy of a vehicle by the evidence, or else by its crush.
    fn crush_energy(&self, side: Side) -> Option<f64> {
        let known = self.case.knowledge.of(Measurable::CrushEnergyOf(side)).map(|known| known.value);
        known.or_else(|| self.case.setup.crush_answers()[side as usize].as_ref().map(|crush| crush.energy))
    }

    /// Where the evidence has the crush energy of each vehicle, how they share it follows from that, and is no question of mechanics.
    fn share_the_crush(&mut self) {
        let has = |side| self.case.knowledge.of(Measurable::CrushEnergyOf(side));
        let (Some(one), Some(_)) = (has(Side::One), has(Side::Two)) else { return };
        if self.seeks(Variable::CrushShare) || self.case.collision.one.vehicle().is_none() || self.case.collision.two.vehicle().is_none() {
            return;
        }
        let Some(start) = self.share_of_crush() else { return };
        self.places.unknowns.push((Variable::CrushShare, one.key.clone()));
        self.unknowns.push(Unknown { of: Variable::CrushShare, start, min: None, max: None, prior: None });
        self.notes.push("contact.crush_share is solved for too: the evidence has the crush energy of each vehicle".to_owned());
    }

    /// Whether a vehicle drives along its heading; a complaint where its speed is asked for and it does not.
    fn drives_along_heading(&self, side: Side, complaints: &mut Vec<Complaint>) -> bool {
        let Some(vehicle) = &self.case.inputs.vehicles[side as usize] else { return false };
        let components = match vehicle.velocity {
            Velocity::Speed(_) => return !self.seeks_component(side),
            Velocity::Components(components) => components,
        };
        let ForwardLeft { left, .. } = Heading::from_angle(vehicle.heading).to_vehicle(components);
        if self.seeks(Variable::Speed(side)) && left.abs() > ALONG * Xy::length(components) {
            let direction = Measurable::ApproachDirection(side).name();
            let help = format!("make velocity.x and velocity.y unknown, and give {direction} in [evidence] if it is known");
            let message = "the vehicle gives a velocity that is not along its heading, and a speed is along it";
            complaints.push((self.places.of_unknown(Variable::Speed(side)), message.to_owned(), Some(help)));
        }
        false
    }
}

/// The key of a case that an unknown is: of the ratio and the moment the one that the case has; none of the share of the crush.
pub fn key_of(variable: Variable, case: &Case) -> Option<Parameter> {
    let contact = &case.inputs.contact;
    match (variable, contact.impulse_ratio, contact.moment) {
        (Variable::Input(Input::ImpulseRatio), ImpulseRatio::OfCritical(_), _) => Some(Parameter::RatioOfCritical),
        (Variable::Input(Input::ImpulseRatio), ImpulseRatio::LimitedByFriction(_), _) => Some(Parameter::Friction),
        (Variable::Input(Input::Moment), _, Moment::OfCritical(_)) => Some(Parameter::MomentOfCritical),
        _ => parameter_of(variable),
    }
}

/// What an unknown measures in a case: of a fraction of the critical moment it is a ratio.
pub fn measure_in(of: Variable, case: &Case) -> Measure {
    match (of, case.inputs.contact.moment) {
        (Variable::Input(Input::Moment), Moment::OfCritical(_)) => Measure::Ratio,
        _ => measure_of_variable(of),
    }
}
