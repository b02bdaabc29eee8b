//! Converts a case into the problem that the library solves.

use planar_impact::reconstruct::{Evidence, Measurand, ReconstructionProblem, Solution, Uncertainty, Unknown, Variable, crush_share};
use planar_impact::{ImpulseRatio, Input, Moment, Output, Side};

use super::dependences::Dependences;
use super::from_crush::FromCrush;
use super::from_rest::{FromRest, SeparationFromRest, Separations};
use super::from_skids::FromSkids;
use super::inputs::InputUnknowns;
use crate::case::{Case, Inertia, Inputs, Known, Parameter, RequestedUnknown, Velocity, at_nominal_values, parameter_of};
use crate::issue::{Issue, Issues};
use crate::message::Message;
use crate::notice::{Notice, Notices};
use crate::units::Measure;

/// Maximum sideways velocity, as a fraction of its speed, of a vehicle that counts as driving along its heading.
const ALONG: f64 = 1e-6;

/// The question, with the assumptions made to set it up.
pub struct Question {
    /// The case, with the values of exact evidence set.
    pub case: Case,
    /// The problem that the library solves.
    pub asked: ReconstructionProblem,
    /// The unknowns that are uncertain inputs of the case, not listed under `[unknown]`.
    pub inputs: Vec<Variable>,
    /// Exact evidence whose values are set in the case, so that it takes no part in the fit.
    pub certain: Vec<Evidence>,
    /// Paths of the unknowns and the evidence in the file.
    pub places: Places,
    /// Assumptions.
    pub notices: Notices,
    /// The separations from rest positions that are used.
    pub separations: Vec<SeparationFromRest>,
    /// Whether the separation of vehicle 1 or of vehicle 2 is what its rest position says about the fitted motion.
    pub about_fit: [bool; 2],
}

/// Paths in the file of the parts of the question.
#[derive(Default)]
pub struct Places {
    unknowns: Vec<(Variable, String)>,
    evidence: Vec<(Measurand, String)>,
}

impl Places {
    /// Returns the key of an unknown, the last one if there are several; for an unknown that only the evidence names,
    /// the key of the evidence.
    pub fn of_unknown(&self, of: Variable) -> String {
        let found = self.unknowns.iter().rfind(|(variable, _)| *variable == of);
        found.map_or_else(|| "unknown".to_owned(), |(_, key)| key.clone())
    }

    /// Returns the key of a piece of evidence, the last one if there are several.
    pub fn of_evidence(&self, of: Measurand) -> String {
        let found = self.evidence.iter().rfind(|(measurable, _)| *measurable == of);
        found.map_or_else(|| "evidence".to_owned(), |(_, key)| key.clone())
    }
}

impl Question {
    /// Sets up the question of a case, with the separations that its rest positions lead to.
    ///
    /// # Errors
    ///
    /// Returns the contradictions in the case.
    pub fn of(case: &Case, separations: &Separations) -> Result<Self, Issues> {
        Self::about(case, &case.inputs, separations)
    }

    /// The same with the separations at other values of the inputs than those of the case, about which they are followed.
    ///
    /// # Errors
    ///
    /// As [`Question::of`].
    pub fn about(case: &Case, at: &Inputs, separations: &Separations) -> Result<Self, Issues> {
        let of_rest = SeparationFromRest::of(case, separations);
        let with_rest = case;
        let FromRest { mut case, mut correlations, by_way } = FromRest::of(case, separations)?;
        let of_crush = FromCrush::of(&mut case);
        correlations.extend(of_crush.correlations.into_iter().chain(case.knowledge.correlations.iter().copied()));
        // Without a question and evidence there is nothing to learn of the inputs.
        let is_asked = !case.knowledge.unknowns.is_empty() || !case.knowledge.evidence.is_empty();
        let of_inputs = if is_asked { InputUnknowns::of(&case) } else { InputUnknowns::default() };
        let of_skids = FromSkids::of(&case, separations);
        correlations.extend(of_skids.with_separations);
        let case = &case;
        let knowledge = &case.knowledge;
        let mut draft =
            Draft { case, unknowns: Vec::new(), evidence: Vec::new(), places: Places::default(), notices: case.notices.clone() };
        let (mut set, mut certain, mut crush_share) = (Vec::new(), Vec::new(), None);
        let mut issues: Vec<Issue> = knowledge.unknowns.iter().filter_map(|requested| misnamed(case, requested)).collect();
        issues.extend(of_crush.issues.into_iter().chain(of_inputs.issues).chain(of_skids.issues));
        draft.notices.0.extend(of_skids.notices);
        issues.extend(knowledge.evidence.iter().filter_map(|known| beyond_momentum(case, known)));
        for requested in &knowledge.unknowns {
            if case.model.is_momentum() && Measurand::Variable(requested.of).is_of_contact() {
                let message = format!("{} is not solved for: momentum alone does not take it", requested.of.name());
                draft.notices.0.push(Notice::note("not-used-by-momentum", requested.key.clone(), message));
                continue;
            }
            let start = draft.start(requested);
            // An unknown without uncertainty is known.
            if requested.prior == Some(0.0) {
                let message = format!("{} has a standard deviation of 0: it is taken as known", requested.of.name());
                draft.notices.0.push(Notice::note("unknown-is-known", requested.key.clone(), message));
                match key_of(requested.of, case) {
                    Some(key) => set.push((key, start)),
                    None => crush_share = Some(start),
                }
                continue;
            }
            draft.places.unknowns.push((requested.of, requested.key.clone()));
            let (min, max) = (requested.min, requested.max);
            let unknown = Unknown { min, max, prior: requested.prior, ..Unknown::free(requested.of, start) };
            if unknown.on_the_circle() != unknown {
                let message = format!("the bounds of {} leave out no direction, and are taken as none", name_in(requested.of, case));
                draft.notices.0.push(Notice::note("every-direction", requested.key.clone(), message));
            }
            draft.unknowns.push(unknown.on_the_circle());
        }
        draft.notices.0.extend(of_crush.notices.into_iter().chain(of_inputs.notices));
        draft.notices.0.extend(at_nominal_values(of_crush.unused));
        let beside: Vec<(Unknown, String)> = of_inputs.unknowns.into_iter().chain(of_skids.unknowns).collect();
        let inputs: Vec<Variable> = beside.iter().map(|(unknown, _)| unknown.of).collect();
        for (unknown, key) in beside {
            draft.places.unknowns.push((unknown.of, key));
            draft.unknowns.push(unknown);
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
        draft.warn_of_what_counts_twice();
        if crush_share.is_none() {
            draft.share_the_crush();
        }
        let dependences = Dependences::of(with_rest, at, separations, &draft.unknowns);
        issues.extend(dependences.issues);
        draft.notices.0.extend(dependences.notices.into_iter().chain(with_rest.independent_frictions(true)));
        let holds_radius_of_gyration = [Side::One, Side::Two].map(|side| draft.holds_radius_of_gyration(side));
        let drives_along_heading = [Side::One, Side::Two].map(|side| draft.drives_along_heading(side, &mut issues));
        if !issues.is_empty() {
            return Err(case.unfit(issues));
        }
        let settled = case.with(&set);
        let asked = ReconstructionProblem {
            unknowns: draft.unknowns,
            evidence: draft.evidence,
            dependences: dependences.all,
            correlations,
            prior_correlations: of_inputs.correlations.into_iter().chain(of_skids.correlation).collect(),
            skid_speeds: of_skids.known,
            drives_along_heading,
            holds_radius_of_gyration,
            separation_from_rest: by_way,
            crush_energy_from_depths: of_crush.from_depths,
            crush_share,
            ..ReconstructionProblem::of(settled.collision)
        };
        Ok(Question {
            asked: if settled.model.is_momentum() { asked.by_momentum() } else { asked },
            case: settled,
            inputs,
            certain,
            places: draft.places,
            notices: draft.notices,
            separations: of_rest,
            about_fit: [false; 2],
        })
    }
}

/// Returns an issue if the name of an unknown does not match the form in which the contact gives it.
fn misnamed(case: &Case, requested: &RequestedUnknown) -> Option<Issue> {
    let contact = &case.inputs.contact;
    let is_there = match requested.called? {
        Parameter::RatioOfCritical => matches!(contact.impulse_ratio, ImpulseRatio::OfCritical(_)),
        Parameter::Friction => matches!(contact.impulse_ratio, ImpulseRatio::LimitedByFriction(_)),
        _ => matches!(contact.moment, Moment::OfCritical(_)),
    };
    let given = match requested.of {
        Variable::Input(Input::Moment) => "moment",
        _ => "impulse ratio",
    };
    let help = "leave it out of [contact], or name the unknown as the contact gives it";
    (!is_there)
        .then(|| Issue::at("conflict", requested.key.clone(), format!("the contact gives the {given} in another way")).with_help(help))
}

/// Returns an issue if evidence cannot be used with momentum alone.
fn beyond_momentum(case: &Case, known: &Known) -> Option<Issue> {
    if !case.model.is_momentum() {
        return None;
    }
    let name = known.of.name();
    let issue = |message: String, help: &'static str| Some(Issue::at("by-momentum", known.key.clone(), message).with_help(help));
    match known.of {
        of if of.is_of_contact() => issue(
            format!("momentum alone says nothing of {name}"),
            "leave it out, or leave `model` out and give `crush_plane` and `restitution`",
        ),
        Measurand::Output(Output::YawRate(_)) if !case.model.is_angular() => issue(
            format!("{name} needs angular momentum"),
            "give `yaw_inertia` and `impact_center` of both vehicles, or leave the yaw rate out",
        ),
        of if has_rotation(of, case) => issue(
            format!("{name} includes the energy of rotation, of which point masses have none"),
            "give `yaw_inertia` and `impact_center` of both vehicles, or leave it out",
        ),
        _ => None,
    }
}

/// Returns `true` for an energy that includes that of a rotation which the case leaves out.
pub(super) fn has_rotation(of: Measurand, case: &Case) -> bool {
    let is_energy = matches!(of, Measurand::Output(Output::EnergyBefore | Output::EnergyAfter | Output::Loss));
    is_energy && !case.model.is_angular()
}

/// Measurands that are about the same numbers.
struct Kin {
    about: &'static str,
    numbers: usize,
    of: Vec<Measurand>,
}

impl Kin {
    /// Returns those of an impact of two vehicles, or of one and a barrier. A velocity is one number of a vehicle whose speed is unknown, and not its
    /// heading; the speed of one that drives along an axis is its component there.
    fn all(is_barrier: bool, is_on_line: [bool; 2], headings: [f64; 2]) -> Vec<Kin> {
        /// Sine of the angle within which a direction is that of an axis.
        const NEARLY: f64 = 0.2;
        use Measurand::{
            ClosingSpeed, CrushEnergy, CrushEnergyOf, DeltaVForward, DeltaVLeft, EquivalentEnergySpeed, SeparationDirection,
            SeparationSpeed,
        };
        use Output::{
            DeltaVMagnitude, DeltaVX, DeltaVY, EnergyAfter, EnergyBefore, ImpulseRatio, ImpulseX, ImpulseY, Loss, NormalApproach,
            NormalImpulse, NormalSeparation, NormalWork, PrincipalDirectionOfForce, TangentialImpulse, TangentialWork, VelocityX,
            VelocityY,
        };
        const VECTOR: &str = "the two components of one vector";
        let kin = |about, numbers, of: &[Measurand]| Kin { about, numbers, of: of.to_vec() };
        let total = [CrushEnergy, Measurand::Output(NormalWork)];
        let of_vehicles = Side::ALL.map(|side| [CrushEnergyOf(side), EquivalentEnergySpeed(side)]);
        let mut all = vec![kin("one speed", 1, &[ClosingSpeed, Measurand::Output(NormalApproach)])];
        if is_barrier {
            all.push(kin("one energy", 1, &[&total[..], of_vehicles.as_flattened()].concat()));
        } else {
            all.extend([&total, &of_vehicles[0], &of_vehicles[1]].map(|energies| kin("one energy", 1, energies)));
            all.push(kin(
                "the crush energies of the two vehicles",
                2,
                &[&total[..1], &[CrushEnergyOf(Side::One), CrushEnergyOf(Side::Two)]].concat(),
            ));
        }
        let outputs = |of: &[Output]| of.iter().copied().map(Measurand::Output).collect::<Vec<_>>();
        let impulse = outputs(&[ImpulseX, ImpulseY, NormalImpulse, TangentialImpulse, ImpulseRatio]);
        let ratio = Measurand::Variable(Variable::Input(Input::ImpulseRatio));
        all.push(kin(VECTOR, 2, &[impulse, vec![ratio]].concat()));
        all.push(kin(
            "the works of the two components of the impulse",
            2,
            &[outputs(&[NormalWork, TangentialWork, Loss]), vec![CrushEnergy]].concat(),
        ));
        all.push(kin("the kinetic energies before and after", 2, &outputs(&[EnergyBefore, EnergyAfter, Loss])));
        let restitution = Measurand::Variable(Variable::Input(Input::Restitution));
        all.push(kin("the two normal velocities", 2, &[outputs(&[NormalApproach, NormalSeparation]), vec![restitution]].concat()));
        for ((side, is_on_line), heading) in Side::ALL.into_iter().zip(is_on_line).zip(headings) {
            let along = [(libm::sin(heading), Input::VelocityX(side)), (libm::cos(heading), Input::VelocityY(side))];
            for (_, component) in along.into_iter().filter(|(across, _)| across.abs() < NEARLY && !is_on_line) {
                all.push(kin(
                    "the velocity along the heading",
                    1,
                    &[Variable::Speed(side), Variable::Input(component)].map(Measurand::Variable),
                ));
            }
            let before = [Variable::Speed(side), Variable::Input(Input::VelocityX(side)), Variable::Input(Input::VelocityY(side))];
            all.push(kin("one velocity", if is_on_line { 1 } else { 2 }, &before.map(Measurand::Variable)));
            let outputs = |of: &[fn(Side) -> Output]| of.iter().map(|output| Measurand::Output(output(side))).collect::<Vec<_>>();
            let change = outputs(&[DeltaVX, DeltaVY, DeltaVMagnitude, PrincipalDirectionOfForce]);
            let separation = outputs(&[VelocityX, VelocityY]);
            all.push(kin(VECTOR, 2, &[change, vec![DeltaVForward(side), DeltaVLeft(side)]].concat()));
            all.push(kin(VECTOR, 2, &[separation, vec![SeparationSpeed(side), SeparationDirection(side)]].concat()));
        }
        all
    }
}

/// The question under construction.
struct Draft<'a> {
    case: &'a Case,
    unknowns: Vec<Unknown>,
    evidence: Vec<Evidence>,
    places: Places,
    notices: Notices,
}

impl Draft<'_> {
    fn seeks(&self, variable: Variable) -> bool {
        self.unknowns.iter().any(|unknown| unknown.of == variable)
    }

    /// Returns the value of an unknown in the case.
    fn of_case(&self, variable: Variable) -> Option<f64> {
        match key_of(variable, self.case) {
            None => self.share_of_crush(),
            Some(key) => self.case.inputs.value(key).ok(),
        }
    }

    /// Returns the start of the search for an unknown: from the file if given, else from the evidence, else from the case.
    fn start(&mut self, requested: &RequestedUnknown) -> f64 {
        let of = requested.of;
        if let Some(start) = requested.start {
            return start;
        }
        if let Some(known) = self.case.knowledge.of(Measurand::Variable(of)) {
            return known.value;
        }
        let start = self.of_case(of);
        if let Some(start) = start {
            let whose = if of == Variable::CrushShare { ", that of the crush" } else { ", that of the case" };
            let message =
                Message::from(format!("the search for {} starts at ", of.name())).figure(measure_in(of, self.case), start).text(whose);
            self.notices.0.push(Notice::note("start-of-case", requested.key.clone(), message));
        }
        // The library refuses an unknown that the collision does not have.
        start.unwrap_or(0.5)
    }

    /// Returns `true` if evidence of an input sets its value in the case: it is exact, and the input is not an unknown.
    fn is_set(&self, variable: Variable, known: &Known) -> bool {
        let is_there = variable == Variable::CrushShare || self.of_case(variable).is_some();
        known.uncertainty == Uncertainty::Exact && is_there && !self.case.knowledge.seeks(variable)
    }

    /// Adds an input to the unknowns if the evidence gives it with an uncertainty.
    fn add_if_doubtful(&mut self, variable: Variable, known: &Known) {
        if self.seeks(variable) || self.is_known_by_others(variable) || known.uncertainty == Uncertainty::Exact {
            return;
        }
        self.places.unknowns.push((variable, known.key.clone()));
        self.unknowns.push(Unknown::free(variable, known.value));
        let message = format!("{} is solved for too: the evidence gives it with an uncertainty", variable.name());
        self.notices.0.push(Notice::note("evidence-is-unknown", known.key.clone(), message));
        self.warn_of_another_value(variable, known);
    }

    /// Warns of an input whose value in the case is another one than the evidence has, within its uncertainty: the value of the case does not count.
    fn warn_of_another_value(&mut self, variable: Variable, known: &Known) {
        /// Standard deviations that are no chance.
        const MOST: f64 = 3.0;
        let sd = known.uncertainty.standard_deviation().unwrap_or(0.0);
        let Some(value) = self.of_case(variable).filter(|value| (value - known.value).abs() > MOST * sd) else { return };
        let measure = measure_in(variable, self.case);
        let message = Message::from(format!("{} is ", variable.name()))
            .figure(measure, value)
            .text(" in the case and ")
            .figure(measure, known.value)
            .text(" by the evidence, with a standard deviation of ")
            .figure(measure, sd)
            .text(": the evidence alone counts; leave the other out, or give it with ± if it was measured too");
        self.notices.0.push(Notice::warning("evidence-differs", known.key.clone(), message));
    }

    /// Warns of one quantity that counts twice: an input with an uncertainty of its own that is evidence too, and more pieces of evidence than the quantities have
    /// numbers that they are about. Measured several times, each by itself, it may.
    fn warn_of_what_counts_twice(&mut self) {
        let evidence = &self.case.knowledge.evidence;
        let is_on_line = Side::ALL.map(|side| self.seeks(Variable::Speed(side)) && !self.seeks(Variable::Input(Input::Heading(side))));
        let mut warn = |key: &str, message: String| self.notices.0.push(Notice::warning("counts-twice", key.to_owned(), message));
        for known in evidence {
            let is_prior = |unknown: &Unknown| Some(unknown.of) == known.variable() && unknown.prior.is_some();
            if known.uncertainty != Uncertainty::Exact && self.unknowns.iter().any(is_prior) {
                let name = known.of.name();
                warn(
                    &known.key,
                    format!(
                        "{name} has an uncertainty, and is evidence too: both count, as independent; if they are one measurement, give one of them"
                    ),
                );
            }
        }
        let vehicles = &self.case.inputs.vehicles;
        let headings = [0, 1].map(|i| vehicles[i].as_ref().map_or(f64::NAN, |vehicle| vehicle.heading));
        for Kin { about, numbers, of } in Kin::all(vehicles.iter().any(Option::is_none), is_on_line, headings) {
            let given: Vec<&Known> = evidence.iter().filter(|known| of.contains(&known.of)).collect();
            if given.len() > numbers {
                let names: Vec<&str> = given.iter().map(|known| known.of.name()).collect();
                let message = format!(
                    "{} are about {about}, and count as independent: if they are one measurement, give {numbers} of them",
                    names.join(", ")
                );
                warn(&given[numbers].key, message);
            }
        }
    }

    /// Returns `true` for a speed whose components are unknowns, or a component whose speed is an unknown.
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

    /// Returns vehicle 1's share of the total crush energy.
    fn share_of_crush(&self) -> Option<f64> {
        let [one, two] = [Side::One, Side::Two].map(|side| self.crush_energy(side));
        crush_share(one?, two?)
    }

    /// Returns the crush energy of a vehicle from the evidence, or else from its crush.
    fn crush_energy(&self, side: Side) -> Option<f64> {
        let known = self.case.knowledge.of(Measurand::CrushEnergyOf(side)).map(|known| known.value);
        known.or_else(|| self.case.setup.crush_outputs()[side as usize].as_ref().map(|crush| crush.energy))
    }

    /// Makes the crush share an unknown if the evidence gives the crush energy of each vehicle: the share follows
    /// from them, not from mechanics.
    fn share_the_crush(&mut self) {
        let has = |side| self.case.knowledge.of(Measurand::CrushEnergyOf(side));
        let (Some(one), Some(_)) = (has(Side::One), has(Side::Two)) else { return };
        if self.seeks(Variable::CrushShare) || self.case.collision.one.vehicle().is_none() || self.case.collision.two.vehicle().is_none() {
            return;
        }
        let Some(start) = self.share_of_crush() else { return };
        self.places.unknowns.push((Variable::CrushShare, one.key.clone()));
        self.unknowns.push(Unknown::free(Variable::CrushShare, start));
        let message = "contact.crush_share is solved for too: the evidence has the crush energy of each vehicle";
        let notice = Notice::note("crush-share-is-unknown", one.key.clone(), message);
        self.notices.0.push(notice);
    }

    /// Returns `true` if a vehicle has its radius of gyration, and an unknown mass.
    fn holds_radius_of_gyration(&self, side: Side) -> bool {
        let vehicle = self.case.inputs.vehicles[side as usize].as_ref();
        let has_radius = vehicle.is_some_and(|vehicle| matches!(vehicle.inertia, Inertia::Radius(_)));
        has_radius && self.seeks(Variable::Input(Input::Mass(side)))
    }

    /// Returns `true` if a vehicle drives along its heading; reports an issue if its speed is an unknown and it does not.
    fn drives_along_heading(&self, side: Side, issues: &mut Vec<Issue>) -> bool {
        let Some(vehicle) = &self.case.inputs.vehicles[side as usize] else { return false };
        if let Velocity::Speed(_) = vehicle.velocity {
            return !self.seeks_component(side);
        }
        let party = match side {
            Side::One => &self.case.collision.one,
            Side::Two => &self.case.collision.two,
        };
        let is_along = party.vehicle().is_none_or(|vehicle| vehicle.drives_along_heading(ALONG));
        if self.seeks(Variable::Speed(side)) && !is_along {
            let direction = Measurand::ApproachDirection(side).name();
            let help = format!("make velocity.x and velocity.y unknown, and give {direction} in [evidence] if it is known");
            let message = "the vehicle gives a velocity that is not along its heading, and a speed is along it";
            issues.push(Issue::at("conflict", self.places.of_unknown(Variable::Speed(side)), message).with_help(help));
        }
        false
    }
}

/// Returns the case parameter of an unknown: for the impulse ratio and the moment impulse, the form that the case
/// gives; `None` for the crush share.
pub fn key_of(variable: Variable, case: &Case) -> Option<Parameter> {
    let contact = &case.inputs.contact;
    match (variable, contact.impulse_ratio, contact.moment) {
        (Variable::Input(Input::ImpulseRatio), ImpulseRatio::OfCritical(_), _) => Some(Parameter::RatioOfCritical),
        (Variable::Input(Input::ImpulseRatio), ImpulseRatio::LimitedByFriction(_), _) => Some(Parameter::Friction),
        (Variable::Input(Input::Moment), _, Moment::OfCritical(_)) => Some(Parameter::MomentOfCritical),
        _ => parameter_of(variable),
    }
}

/// Returns the values of a solution that a case has.
pub fn values_of(case: &Case, solution: &Solution) -> Vec<(Parameter, f64)> {
    solution.unknowns.iter().filter_map(|estimate| Some((key_of(estimate.of, case)?, estimate.value))).collect()
}

/// Returns the name of an unknown in a case: that of the form in which the contact gives it, such as `contact.impulse_ratio.of_critical`.
pub fn name_in(of: Variable, case: &Case) -> String {
    key_of(of, case).map_or_else(|| of.name().to_owned(), |key| key.to_string())
}

/// Returns the measure of an unknown in a case: a fraction of the critical moment is a ratio.
pub fn measure_in(of: Variable, case: &Case) -> Measure {
    match (of, case.inputs.contact.moment) {
        (Variable::Input(Input::Moment), Moment::OfCritical(_)) => Measure::Ratio,
        _ => of.measure(),
    }
}

/// Returns the name of a quantity in a case.
pub fn name_of(of: Measurand, case: &Case) -> String {
    match of {
        Measurand::Variable(variable) => name_in(variable, case),
        _ => of.name().to_owned(),
    }
}

/// Returns the measure of a quantity in a case.
pub fn measure_of(of: Measurand, case: &Case) -> Measure {
    match of {
        Measurand::Variable(variable) => measure_in(variable, case),
        _ => of.measure(),
    }
}
