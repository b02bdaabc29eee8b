//! The verb `crash3`: CRASH3's damage algorithm beside planar mechanics.

pub mod document;
pub mod text;

use planar_impact::crash3::{Assumptions, Damaged, DamagedPair, PairEstimate};
use planar_impact::{ForwardLeft, Impact, Moment, Party, Real, Refusals, Xy};

use crate::Done;
use crate::arguments::{Format, OfCase as Call};
use crate::case::Case;
use crate::exit::Failure;
use crate::units::{Measure, Units};

/// Reads the case and prints what CRASH3 makes of its crush.
///
/// # Errors
///
/// Everything wrong with the file, a vehicle without crush, or why the physics refuses the impact that the direction of force is taken from.
pub fn run(call: &Call) -> Result<Done, Failure> {
    let case = Case::read(&call.case).map_err(Failure::Input)?;
    let units = call.units.unwrap_or(case.units);
    let mut result = every_vehicle_has_crush(&case).and_then(|()| Comparison::of(&case, units))?;
    result.notes.splice(0..0, case.notes.iter().cloned());
    match call.format {
        Format::Text => Ok(Done::with(text::render(&case, &result, units))),
        Format::Json => {
            let document = document::Document::of(&case, &result);
            let text = serde_json::to_string_pretty(&document).map_err(|error| Failure::Data(error.to_string()))?;
            Ok(Done::with(text + "\n"))
        }
    }
}

/// 5°: how far two directions of force may be from opposite without a word.
const OPPOSITE: f64 = 0.087;

/// How far the force on one vehicle is from being opposite to that on the other, on the ground; none against a barrier.
fn crossing(case: &Case, pair: &DamagedPair) -> Option<f64> {
    let push = |damaged: &Option<Damaged>, party: &Party| {
        let from = damaged.as_ref()?.force_origin;
        Some(party.vehicle()?.heading.to_ground(ForwardLeft { forward: -from.ahead, left: from.right }))
    };
    let (one, two) = (push(&pair.one, &case.collision.one)?, push(&pair.two, &case.collision.two)?);
    Some(Real::atan2(one.cross(two), -one.dot(two)).abs())
}

/// What CRASH3 says of the crush of every vehicle.
struct Damage {
    pair: DamagedPair,
    estimate: PairEstimate,
    /// The separation velocity of each vehicle that CRASH3 goes back from: that of the evidence, or else of its rest, or else of the case.
    separation: [Option<Xy>; 2],
}

/// What CRASH3 says, and what planar mechanics says beside it.
pub struct Comparison {
    /// None where a vehicle has no crush.
    damage: Option<Damage>,
    /// What both methods make of the same crush energy, where planar mechanics can be asked.
    assumptions: Option<Assumptions>,
    notes: Vec<String>,
}

impl Comparison {
    /// Of a case in which every vehicle has its crush.
    ///
    /// # Errors
    ///
    /// Why the physics refuses the impact that the direction of force is taken from.
    pub fn of(case: &Case, units: Units) -> Result<Self, Failure> {
        let mut notes = Vec::new();
        let common = case.collision.at_common_velocity().solve();
        let has_common_velocity = common.is_ok();
        if case.setup.crush.iter().flatten().any(|crush| crush.force_origin.is_none()) {
            common.map_err(|refusals| case.refuse(&refusals, units))?;
            notes.push("the PDOF is that of the common-velocity impulse, e = 0 and mu = mu0, which CRASH3 assumes".to_owned());
        }
        let pair = case.setup.damaged_pair(&case.setup.crush_answers()).ok_or(Failure::Defect)?;
        let estimate = pair.solve().map_err(|refusals| case.refuse(&refusals, units))?;
        notes.extend(cautions(case, &pair, &estimate, units));
        let energy = [&pair.one, &pair.two].into_iter().flatten().map(|damaged| damaged.crush_energy).sum();
        let impact = case.collision.solve();
        let assumptions = assumptions(case, &impact, has_common_velocity, energy, units, &mut notes);
        let after = impact.ok().map(|impact| [impact.one.after.velocity, impact.two.after.velocity]);
        let given = case.knowledge.separation();
        let from_rest = case.separations_from_rest()?.map(|separation| separation.map(|separation| separation.motion.velocity));
        let separation = [0, 1].map(|i| given[i].or(from_rest[i]).or(after.map(|after| after[i])));
        for i in (0..2).filter(|&i| given[i].is_none() && from_rest[i].is_some()) {
            notes.push(format!("vehicle.{}: the separation velocity is that from which it comes to rest where [rest] says", i + 1));
        }
        if given.iter().chain(&from_rest).all(Option::is_none) && after.is_some() {
            notes.push("the separation velocities are those that planar mechanics has for the case: the evidence has none".to_owned());
        }
        Ok(Comparison { damage: Some(Damage { pair, estimate, separation }), assumptions, notes })
    }

    /// Of a crush energy alone: what the assumptions cost, and nothing of a single vehicle.
    pub fn of_energy(case: &Case, energy: f64, units: Units) -> Self {
        let mut notes = Vec::new();
        let has_common_velocity = case.collision.at_common_velocity().solve().is_ok();
        let assumptions = assumptions(case, &case.collision.solve(), has_common_velocity, energy, units, &mut notes);
        Comparison { damage: None, assumptions, notes }
    }

    /// Whether there is nothing to say.
    pub fn is_empty(&self) -> bool {
        self.damage.is_none() && self.assumptions.is_none()
    }

    /// What was taken for granted.
    pub fn notes(&self) -> &[String] {
        &self.notes
    }
}

fn assumptions(
    case: &Case,
    impact: &Result<Impact, Refusals>,
    has_common_velocity: bool,
    energy: f64,
    units: Units,
    notes: &mut Vec<String>,
) -> Option<Assumptions> {
    match nothing_to_compare(case, impact, has_common_velocity, units) {
        Some(why) => {
            notes.push(format!("nothing to compare with: {why}"));
            None
        }
        None => Assumptions::from_crush_energy(&case.collision, energy),
    }
}

fn every_vehicle_has_crush(case: &Case) -> Result<(), Failure> {
    let parties = [&case.collision.one, &case.collision.two];
    let lacking: Vec<usize> = (0..2).filter(|&i| parties[i].vehicle().is_some() && case.setup.crush[i].is_none()).collect();
    if lacking.is_empty() {
        return Ok(());
    }
    let problem = |i: usize| {
        let help = "CRASH3 adds up the crush energy of every vehicle; one that was not crushed has depths of 0".to_owned();
        (format!("vehicle.{}.crush", i + 1), "missing".to_owned(), Some(help))
    };
    Err(case.unfit(lacking.into_iter().map(problem)))
}

/// What is possible and still deserves a second look.
fn cautions(case: &Case, pair: &DamagedPair, estimate: &PairEstimate, units: Units) -> Vec<String> {
    let mut cautions = Vec::new();
    for (i, vehicle) in [&estimate.one, &estimate.two].into_iter().enumerate() {
        if vehicle.is_some_and(|vehicle| vehicle.correction >= 2.0) {
            cautions.push(format!("vehicle.{}: the energy correction is at its limit of 2; the force comes 45 deg or more off", i + 1));
        }
    }
    if let Some(angle) = crossing(case, pair).filter(|angle| *angle > OPPOSITE) {
        let angle = units.quantity(Measure::Angle, angle);
        cautions
            .push(format!("the forces on the two vehicles are {angle} from being opposite, which they must be; check the pdof of each"));
    }
    cautions
}

/// Why planar mechanics has nothing to say of the same crush energy; none if it has.
fn nothing_to_compare(case: &Case, impact: &Result<Impact, Refusals>, has_common_velocity: bool, units: Units) -> Option<String> {
    match impact {
        Err(refusals) => {
            let reasons: Vec<String> = refusals.reasons().iter().map(|refusal| crate::wording::refusal(refusal, units).1).collect();
            Some(format!("planar mechanics refuses the case, {}", reasons.join("; ")))
        }
        Ok(_) if case.collision.restitution >= 1.0 => Some("at e = 1 the normal impulse does no work, so it leaves no crush".to_owned()),
        Ok(_) if !has_common_velocity => Some("no push brings the vehicles to a common velocity".to_owned()),
        Ok(_) if case.collision.moment != Moment::None => Some("CRASH3 knows no moment impulse".to_owned()),
        Ok(_) => None,
    }
}
