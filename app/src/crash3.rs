//! The verb `crash3`: compares CRASH3's damage algorithm with planar mechanics.

use planar_impact::crash3::{
    Assumption, Assumptions, Consequence, Damaged, DamagedPair, PairEstimate, Surface, VehicleEstimate, approach_velocity,
};
use planar_impact::reconstruct::Measurand;
use planar_impact::{Heading, Impact, Moment, Output, Refusals, Side, Xy};
use schemars::JsonSchema;
use serde::Serialize;

use crate::answer::Answer;
use crate::case::{Case, Known, vehicle_number};
use crate::control::Control;
use crate::crush::pulling;
use crate::issue::{Issue, Issues};
use crate::message::Message;
use crate::named::positive_zero;
use crate::notice::Notice;
use crate::units::Measure;
use crate::wording;

/// CRASH3 beside planar mechanics.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Comparison {
    /// CRASH3's damage algorithm; `null` unless every vehicle has a crush.
    #[serde(flatten)]
    pub damage: Option<Damage>,
    /// Both methods from the same crush energy; `null` if planar mechanics refuses the case.
    pub planar: Option<Planar>,
}

/// CRASH3's damage algorithm.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Damage {
    /// Vehicle 1 and vehicle 2.
    pub vehicles: [Vehicle; 2],
    /// Sum of the corrected crush energies, in J.
    pub corrected_energy: f64,
    /// The impulse between them, in N s.
    pub impulse: f64,
}

/// CRASH3 results for a vehicle; zeros for a barrier.
#[derive(Clone, Debug, Default, PartialEq, Serialize, JsonSchema)]
pub struct Vehicle {
    /// Its name.
    pub name: String,
    /// `true` if it is a fixed barrier.
    pub barrier: bool,
    /// The crushed surface: `front`, `right`, `rear` or `left`; `null` for a barrier.
    pub surface: Option<&'static str>,
    /// Crush energy in J.
    pub crush_energy: f64,
    /// Principal direction of force in rad, clockwise from straight ahead.
    pub pdof: f64,
    /// Energy correction factor 1 + tan² α.
    pub correction: f64,
    /// Corrected crush energy in J.
    pub corrected_energy: f64,
    /// Moment arm of the force about the center of mass, in m.
    pub moment_arm: f64,
    /// Effective mass factor γ.
    pub effective_mass_factor: f64,
    /// ΔV in m/s.
    pub delta_v_magnitude: f64,
    /// ΔV along x and y, in m/s.
    pub delta_v: [f64; 2],
    /// Approach velocity of the case along x and y, in m/s.
    pub approach_velocity: [f64; 2],
    /// Approach velocity computed from the separation velocity; `null` if neither the evidence nor planar mechanics gives one.
    pub reconstruction: Option<Reconstruction>,
}

/// Approach velocity reconstructed from a separation velocity.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Reconstruction {
    /// Separation velocity along x and y, in m/s.
    pub separation_velocity: [f64; 2],
    /// Approach velocity along x and y by CRASH3, in m/s.
    pub approach_velocity: [f64; 2],
}

/// Results from the crush energy of both vehicles.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Planar {
    /// `true` for each of vehicle 1 and vehicle 2 that is a fixed barrier.
    pub barriers: [bool; 2],
    /// The crush energy of both vehicles in J.
    pub crush_energy: f64,
    /// Planar mechanics.
    pub planar: Follows,
    /// Planar mechanics with CRASH3's common velocity alone.
    pub common_velocity: Follows,
    /// Planar mechanics with CRASH3's point mass alone.
    pub point_mass: Follows,
    /// Planar mechanics with CRASH3's tangential factor alone.
    pub tangential_factor: Follows,
    /// Planar mechanics with all three assumptions.
    pub together: Follows,
}

/// A result, and its difference from planar mechanics.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Follows {
    /// The assumption in words.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub assumption: Option<&'static str>,
    /// Energy loss T_L in J.
    pub loss: f64,
    /// ΔV of each vehicle in m/s.
    pub delta_v_magnitude: [f64; 2],
    /// The change caused by the assumption.
    pub cost: Cost,
}

/// The difference from planar mechanics.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Cost {
    /// Difference of the energy loss, in J.
    pub loss: f64,
    /// Difference of each ΔV, in m/s.
    pub delta_v_magnitude: [f64; 2],
    /// Difference of the energy loss as a fraction of it; `null` without a loss.
    pub loss_share: Option<f64>,
    /// Difference of each ΔV as a fraction of it; `null` for a barrier.
    pub delta_v_share: [Option<f64>; 2],
}

/// Runs CRASH3's damage algorithm for a case and compares it with planar mechanics.
///
/// # Errors
///
/// A vehicle without crush, numbers that the case lists as unknown, or why the physics refuses the impact that the direction of force is taken from.
pub fn crash3(case: &Case, _: &(), control: &dyn Control) -> Result<Answer<Comparison>, Issues> {
    case.needs_everything()?;
    every_vehicle_has_crush(case)?;
    let mut notices = Vec::new();
    let comparison = Comparison::of(case, &mut notices, control)?;
    notices.extend(unused_evidence(case));
    Ok(case.answer(comparison, notices))
}

/// 5°: two directions of force may deviate from opposite by this angle without a warning.
const MISALIGNED: f64 = 0.087;

/// 25°: the direction of force on a vehicle, as it is given, may deviate from that of the case by this angle without a warning.
const APART: f64 = 0.436;

impl Comparison {
    /// Compares the methods for a case in which every vehicle has a crush.
    ///
    /// # Errors
    ///
    /// Returns the reason if the physics refuses the impact that determines the direction of force.
    pub fn of(case: &Case, notices: &mut Vec<Notice>, control: &dyn Control) -> Result<Self, Issues> {
        let common = case.collision.at_common_velocity().solve();
        let has_common_velocity = common.is_ok();
        if case.setup.crush.iter().flatten().any(|crush| crush.force_direction.is_none()) {
            common.map_err(|refusals| case.refuse(&refusals))?;
            let message = "the PDOF is that of the common-velocity impulse, e = 0 and mu = mu0, which CRASH3 assumes";
            notices.push(Notice::note("pdof-at-common-velocity", "", message));
        }
        let pair = case.setup.damaged_pair(&case.setup.crush_outputs()).ok_or_else(|| Issues::defect("a vehicle has no crush"))?;
        let estimate = pair.solve().map_err(|refusals| case.refuse(&refusals))?;
        let impact = case.collision.solve();
        notices.extend(warnings(case, &pair, &estimate, impact.as_ref().ok()));
        let energy = [&pair.one, &pair.two].into_iter().flatten().map(|damaged| damaged.crush_energy).sum();
        let planar = planar(case, &impact, has_common_velocity, energy, notices);
        let separation = separations(case, &impact, notices, control)?;
        Ok(Comparison { damage: Some(Damage::of(case, &pair, &estimate, separation)), planar })
    }

    /// Compares the methods for a crush energy alone: effects of the assumptions, without results per vehicle.
    pub fn of_energy(case: &Case, energy: f64, notices: &mut Vec<Notice>) -> Self {
        let has_common_velocity = case.collision.at_common_velocity().solve().is_ok();
        Comparison { damage: None, planar: planar(case, &case.collision.solve(), has_common_velocity, energy, notices) }
    }

    /// Returns `true` if it is empty.
    pub fn is_empty(&self) -> bool {
        self.damage.is_none() && self.planar.is_none()
    }
}

fn every_vehicle_has_crush(case: &Case) -> Result<(), Issues> {
    let parties = case.collision.parties();
    let lacking: Vec<usize> = (0..2).filter(|&i| parties[i].vehicle().is_some() && case.setup.crush[i].is_none()).collect();
    let help =
        "CRASH3 adds the crush energies of both vehicles; for a vehicle that was not crushed give depths of 0 and a stiffness with d0 = 0";
    let issue = |i: usize| Issue::at("missing-key", format!("vehicle.{}.crush", i + 1), "missing").with_help(help);
    if lacking.is_empty() { Ok(()) } else { Err(case.unfit(lacking.into_iter().map(issue))) }
}

/// Returns the separation velocity of each vehicle from which CRASH3 computes the approach: from the evidence if
/// given, else from the rest position, else from the case.
fn separations(
    case: &Case,
    impact: &Result<Impact, Refusals>,
    notices: &mut Vec<Notice>,
    control: &dyn Control,
) -> Result<[Option<Xy>; 2], Issues> {
    let after = impact.as_ref().ok().map(|impact| [impact.one.after.velocity, impact.two.after.velocity]);
    let given = case.knowledge.separation();
    let rests = [0, 1].map(|i| case.rest.as_ref().and_then(|rest| rest.vehicles[i].as_ref()));
    let is_needed = [0, 1].map(|i| given[i].is_none() && rests[i].is_some_and(|rest| rest.evidence.is_some()));
    let from_rest =
        case.separations_from_rest_of(is_needed, control)?.map(|separation| separation.map(|separation| separation.motion.velocity));
    for i in (0..2).filter(|&i| from_rest[i].is_some()) {
        let path = format!("rest.vehicle.{}", i + 1);
        let message = format!("vehicle.{}: the separation velocity is reconstructed from its rest position", i + 1);
        notices.push(Notice::note("separation-from-rest", path, message));
    }
    let parties = case.collision.parties();
    let is_assumed = |i: &usize| after.is_some() && parties[*i].vehicle().is_some() && given[*i].or(from_rest[*i]).is_none();
    let assumed: Vec<(usize, Option<String>)> =
        (0..2).filter(is_assumed).map(|i| (i, incomplete(case, Side::ALL[i], rests[i].is_some()))).collect();
    let is_of_all = given.iter().chain(&from_rest).all(Option::is_none) && assumed.iter().all(|(_, why)| why.is_none());
    if is_of_all && !assumed.is_empty() {
        let message = "the separation velocities are those that planar mechanics has for the case: the evidence has none";
        notices.push(Notice::note("separation-of-case", "", message));
    } else {
        notices.extend(assumed.into_iter().map(|(i, why)| {
            let path = format!("vehicle.{}", i + 1);
            let why = why.unwrap_or_else(|| "the evidence has none".to_owned());
            let message = format!("{path}: the separation velocity is the one that planar mechanics has for the case: {why}");
            Notice::note("separation-of-case", path, message)
        }));
    }
    Ok([0, 1].map(|i| given[i].or(from_rest[i]).or(after.map(|after| after[i]))))
}

/// Returns what the case lacks of the separation velocity of a vehicle, of which it has a part; `None` if it has nothing of it.
fn incomplete(case: &Case, side: Side, has_rest: bool) -> Option<String> {
    let number = vehicle_number(side);
    let components = [Output::VelocityX(side), Output::VelocityY(side)].map(|output| case.knowledge.of(Measurand::Output(output)));
    match components {
        [Some(one), None] | [None, Some(one)] => Some(format!("the evidence has only {}; give both components", one.of.name())),
        _ if has_rest => Some(format!("[rest.vehicle.{number}] does not say where it came to rest; give `position` and `heading` there")),
        _ => None,
    }
}

/// Returns the note of the evidence that CRASH3 does not use, or `None` if it uses all. It starts from the crush and from separation velocities.
fn unused_evidence(case: &Case) -> Option<Notice> {
    let is_used = |known: &&Known| match known.of {
        // An approach is a number of the case.
        Measurand::Variable(_) => true,
        Measurand::Output(Output::VelocityX(_) | Output::VelocityY(_)) => true,
        _ => known.is_from_crush,
    };
    let unused: Vec<&Known> = case.knowledge.evidence.iter().filter(|known| !is_used(known)).collect();
    let names: Vec<&str> = unused.iter().map(|known| known.of.name()).collect();
    let message = format!("CRASH3 takes no part of the evidence but separation velocities; not used: {}", names.join(", "));
    let direction = unused.iter().find(|known| matches!(known.of, Measurand::Output(Output::PrincipalDirectionOfForce(_))));
    let message = match direction {
        Some(_) => format!("{message}; give the direction of the force as `pdof` under [vehicle.crush]"),
        None => message,
    };
    let path = if let [one] = &unused[..] { one.key.clone() } else { "evidence".to_owned() };
    (!unused.is_empty()).then(|| Notice::note("evidence-not-used", path, message))
}

/// Compares both methods for a crush energy, unless planar mechanics has no result.
fn planar(
    case: &Case,
    impact: &Result<Impact, Refusals>,
    has_common_velocity: bool,
    energy: f64,
    notices: &mut Vec<Notice>,
) -> Option<Planar> {
    let assumptions = match nothing_to_compare(case, impact, has_common_velocity) {
        Some(why) => Err(why),
        None => Assumptions::from_crush_energy(&case.collision, energy)
            .filter(Assumptions::is_finite)
            .ok_or_else(|| Message::from("the crush energy leads to no finite impulse")),
    };
    let refuse = |why: Message| {
        let message = Message::from("nothing to compare with: ").join(why);
        notices.push(Notice::warning("nothing-to-compare", "", message));
    };
    let barriers = case.collision.parties().map(|party| party.vehicle().is_none());
    assumptions.map_err(refuse).ok().map(|assumptions| Planar { barriers, ..Planar::of(&assumptions) })
}

/// Returns why planar mechanics has no result for the same crush energy, or `None` if it has one.
fn nothing_to_compare(case: &Case, impact: &Result<Impact, Refusals>, has_common_velocity: bool) -> Option<Message> {
    match impact {
        Err(refusals) => Some(Message::from("planar mechanics refuses the case, ").join(wording::reasons(refusals))),
        Ok(_) if case.collision.restitution >= 1.0 => Some("at e = 1 the normal impulse does no work, so it leaves no crush".into()),
        Ok(_) if !has_common_velocity => Some("no push brings the vehicles to a common velocity".into()),
        Ok(_) if case.collision.moment != Moment::None => Some("CRASH3 has no moment impulse".into()),
        Ok(_) => None,
    }
}

/// Returns warnings about results that are possible but unusual.
fn warnings(case: &Case, pair: &DamagedPair, estimate: &PairEstimate, impact: Option<&Impact>) -> Vec<Notice> {
    let at_limit = |(i, vehicle): (usize, Option<&VehicleEstimate>)| {
        vehicle.filter(|vehicle| vehicle.correction >= 2.0)?;
        let path = format!("vehicle.{}", i + 1);
        let message = format!("{path}: the energy correction is at its limit of 2; the force comes 45 deg or more off");
        Some(Notice::warning("correction-at-limit", path, message))
    };
    let leaves = |(i, damaged): (usize, Option<&Damaged>)| {
        let Damaged { surface, force_direction, .. } = damaged?;
        pulling(i, *surface, force_direction)
    };
    let mut warnings: Vec<Notice> = [estimate.one.as_ref(), estimate.two.as_ref()].into_iter().enumerate().filter_map(at_limit).collect();
    warnings.extend([pair.one.as_ref(), pair.two.as_ref()].into_iter().enumerate().filter_map(leaves));
    let against = |(i, damaged): (usize, Option<&Damaged>)| {
        case.setup.crush[i].as_ref()?.force_direction?;
        let response = [&impact?.one, &impact?.two][i];
        let [given, found] = [damaged?.force_direction.direction(), response.principal_direction_of_force()];
        let apart = libm::remainder(given - found, std::f64::consts::TAU).abs();
        let path = format!("vehicle.{}.crush.pdof", i + 1);
        let message = Message::from(format!("{path}: it is "))
            .figure(Measure::Angle, given)
            .text(", and the impact of the case has ")
            .figure(Measure::Angle, found)
            .text("; check its sign, clockwise from straight ahead");
        (apart > APART).then(|| Notice::warning("pdof-contradicts-motion", path, message))
    };
    warnings.extend([pair.one.as_ref(), pair.two.as_ref()].into_iter().enumerate().filter_map(against));
    if let Some(angle) = pair.force_misalignment(&case.collision).filter(|angle| *angle > MISALIGNED) {
        let message = Message::from("the forces on the two vehicles are ")
            .figure(Measure::Angle, angle)
            .text(" from being opposite, which they must be; check the pdof of each");
        warnings.push(Notice::warning("forces-not-opposite", "vehicle", message));
    }
    warnings
}

impl Damage {
    fn of(case: &Case, pair: &DamagedPair, estimate: &PairEstimate, separation: [Option<Xy>; 2]) -> Self {
        let parties = case.collision.parties();
        let vehicle = |i: usize, damaged: &Option<Damaged>, estimate: &Option<VehicleEstimate>| {
            let name = case.names[i].clone();
            match (damaged, estimate, parties[i].vehicle()) {
                (Some(damaged), Some(estimate), Some(vehicle)) => Vehicle {
                    name,
                    approach_velocity: components(vehicle.motion.velocity),
                    ..Vehicle::of(damaged, estimate, vehicle.heading, separation[i])
                },
                _ => Vehicle { name, barrier: true, ..Vehicle::default() },
            }
        };
        Damage {
            vehicles: [vehicle(0, &pair.one, &estimate.one), vehicle(1, &pair.two, &estimate.two)],
            corrected_energy: positive_zero(estimate.energy),
            impulse: positive_zero(estimate.impulse),
        }
    }
}

fn components(v: Xy) -> [f64; 2] {
    [v.x, v.y].map(positive_zero)
}

impl Vehicle {
    fn of(damaged: &Damaged, estimate: &VehicleEstimate, heading: Heading, separation: Option<Xy>) -> Self {
        let reconstruction = |separation: Xy| Reconstruction {
            separation_velocity: components(separation),
            approach_velocity: components(approach_velocity(estimate, &heading, separation)),
        };
        Vehicle {
            surface: Some(name_of(damaged.surface)),
            crush_energy: positive_zero(damaged.crush_energy),
            pdof: positive_zero(damaged.force_direction.direction()),
            correction: positive_zero(estimate.correction),
            corrected_energy: positive_zero(estimate.corrected_energy),
            moment_arm: positive_zero(estimate.moment_arm),
            effective_mass_factor: positive_zero(estimate.effective_mass_factor),
            delta_v_magnitude: positive_zero(estimate.delta_v_magnitude),
            delta_v: components(heading.to_ground(estimate.delta_v)),
            reconstruction: separation.map(reconstruction),
            ..Vehicle::default()
        }
    }
}

impl Planar {
    fn of(assumptions: &Assumptions) -> Self {
        let planar = &assumptions.planar;
        let share = |cost: f64, of: f64| Some(cost / of).filter(|share| share.is_finite());
        let follows = |assumption: Option<Assumption>, with: &Consequence, cost: Consequence| Follows {
            assumption: assumption.map(Assumption::statement),
            loss: positive_zero(with.loss),
            delta_v_magnitude: [with.delta_v_1, with.delta_v_2].map(positive_zero),
            cost: Cost {
                loss: positive_zero(cost.loss),
                delta_v_magnitude: [cost.delta_v_1, cost.delta_v_2].map(positive_zero),
                loss_share: share(with.loss - planar.loss, planar.loss),
                delta_v_share: [
                    share(with.delta_v_1 - planar.delta_v_1, planar.delta_v_1),
                    share(with.delta_v_2 - planar.delta_v_2, planar.delta_v_2),
                ],
            },
        };
        let alone = |assumption| follows(Some(assumption), assumptions.with(assumption), assumptions.cost(assumption));
        Planar {
            barriers: [false; 2],
            crush_energy: positive_zero(assumptions.crush_energy),
            planar: follows(None, planar, Consequence { loss: 0.0, delta_v_1: 0.0, delta_v_2: 0.0 }),
            common_velocity: alone(Assumption::CommonVelocity),
            point_mass: alone(Assumption::PointMass),
            tangential_factor: alone(Assumption::TangentialFactor),
            together: follows(None, &assumptions.together, assumptions.cost_together()),
        }
    }
}

/// Returns the name of a surface in a case file.
pub(crate) fn name_of(surface: Surface) -> &'static str {
    match surface {
        Surface::Front => "front",
        Surface::Right => "right",
        Surface::Rear => "rear",
        Surface::Left => "left",
    }
}
