//! The verb `solve`: how two vehicles leave a collision, and the energy it takes.

use planar_impact::skid::{self, braking};
use planar_impact::{Admissible, Collision, Impact, Law, Nt, Party, Response, Xy};
use schemars::JsonSchema;
use serde::Serialize;

use crate::answer::Answer;
use crate::case::{BrakingInputs, Case, Crash3Outputs, CrushOutputs};
use crate::control::Control;
use crate::crush_plane_bracket::Bracket;
use crate::issue::Issues;
use crate::named::positive_zero;
use crate::units::Measure;

/// A solved collision, in SI and radians.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Solution {
    /// Vehicle 1 and vehicle 2.
    pub vehicles: [Vehicle; 2],
    /// The contact.
    pub contact: Contact,
    /// The energies.
    pub energy: Energy,
    /// Outputs at both ends of the crush plane's bracket, where the case gives the surfaces that meet.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub crush_plane_bracket: Option<Bracket>,
}

/// A vehicle before and after the impact; zeros for a barrier.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Vehicle {
    /// Its name.
    pub name: String,
    /// `true` for a fixed barrier.
    pub barrier: bool,
    /// Its motion before the impact.
    pub before: Motion,
    /// Velocity after the impact along x and y, in m/s.
    pub velocity: [f64; 2],
    /// Yaw rate after the impact, in rad/s; `null` where momentum alone does not determine it.
    #[schemars(with = "Option<f64>")]
    pub yaw_rate: f64,
    /// Change of velocity along x and y, in m/s.
    pub delta_v: [f64; 2],
    /// Magnitude of the change of velocity, in m/s.
    pub delta_v_magnitude: f64,
    /// Principal direction of force, clockwise from straight ahead, in rad.
    pub pdof: f64,
    /// Crush energy in J, where the case has the crush of this vehicle.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub crush_energy: Option<f64>,
    /// Speed at which the crush energy is the vehicle's kinetic energy, in m/s.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub equivalent_energy_speed: Option<f64>,
    /// Its braking before the impact, where the case has its skids.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub braking: Option<Braking>,
    /// Mean depth of the crush in m.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mean_depth: Option<f64>,
    /// Results of CRASH3, where every vehicle has its crush.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub crash3: Option<Crash3>,
}

/// The braking of a vehicle before the impact.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Braking {
    /// Speed when it began to brake, in m/s.
    pub speed: f64,
    /// Speed at the impact, in m/s.
    pub impact_speed: f64,
    /// Distance of the skids, as on a plan, and of the reaction before them, in m.
    pub distance: f64,
    /// Time from the perception, or without a reaction time from the first skid, to the impact, in s.
    pub time: f64,
    /// Distance covered in the reaction time, in m.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reaction_distance: Option<f64>,
    /// The skids, in their order along the road.
    pub skids: Vec<Skid>,
}

/// The motion over a skid.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Skid {
    /// Speed at its start, in m/s.
    pub start: f64,
    /// Speed at its end, in m/s.
    pub end: f64,
    /// Deceleration along the road, in m/s².
    pub deceleration: f64,
    /// Duration in s.
    pub time: f64,
}

impl Braking {
    fn of(inputs: &BrakingInputs, impact_speed: f64) -> Self {
        let skids = braking(&inputs.skids, impact_speed, inputs.gravity);
        let speed = skids.first().map_or(impact_speed, |first| first.start);
        let reaction_distance = inputs.reaction_time.map(|time| speed * time);
        let of_skid = |part: &skid::Braking| Skid { start: part.start, end: part.end, deceleration: part.deceleration, time: part.time };
        Braking {
            speed,
            impact_speed,
            distance: inputs.skids.iter().map(|skid| skid.length).sum::<f64>() + reaction_distance.unwrap_or(0.0),
            time: skids.iter().map(|part| part.time).sum::<f64>() + inputs.reaction_time.unwrap_or(0.0),
            reaction_distance,
            skids: skids.iter().map(of_skid).collect(),
        }
    }
}

/// A motion.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Motion {
    /// Velocity along x and y, in m/s.
    pub velocity: [f64; 2],
    /// Yaw rate in rad/s.
    pub yaw_rate: f64,
}

impl Motion {
    /// Returns the speed in m/s.
    pub fn speed(&self) -> f64 {
        libm::hypot(self.velocity[0], self.velocity[1])
    }
}

/// Results of CRASH3 for a vehicle.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Crash3 {
    /// Principal direction of force that it takes, in rad.
    pub pdof: f64,
    /// Energy correction factor 1 + tan² α.
    pub correction: f64,
    /// Corrected crush energy in J.
    pub corrected_energy: f64,
    /// Effective mass factor γ.
    pub effective_mass_factor: f64,
    /// ΔV in m/s.
    pub delta_v_magnitude: f64,
}

/// The contact of the two vehicles.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Contact {
    /// `momentum` where momentum alone determines the impulse: the normal is then along it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub model: Option<&'static str>,
    /// Angle Γ of the crush plane in rad, as the case gives it.
    pub crush_plane: f64,
    /// Coefficient of restitution e; `null` where momentum alone leaves no approach along the impulse.
    #[schemars(with = "Option<f64>")]
    pub restitution: f64,
    /// Impulse ratio μ.
    pub impulse_ratio: f64,
    /// The form in which the case gives the impulse ratio.
    pub impulse_ratio_given: ImpulseRatioGiven,
    /// The number that it is given by; `null` at the critical ratio.
    pub impulse_ratio_parameter: Option<f64>,
    /// Critical impulse ratio μ₀, that of Brach's law whichever is in force; `null` where the impulse that ends sliding has no normal part.
    #[schemars(with = "Option<f64>")]
    pub critical_impulse_ratio: f64,
    /// The law of the tangential impulse.
    pub tangential_law: TangentialLaw,
    /// The impulse on vehicle 1 in N s.
    pub impulse: Impulse,
    /// Relative velocity at the impact center before, in m/s.
    pub approach: Components,
    /// Relative velocity at the impact center after, in m/s.
    pub separation: Components,
    /// Limits of restitution and impulse ratio without a gain of energy; `null` with a moment impulse.
    pub no_energy_gain: Option<EnergyBounds>,
    /// The lines and points of Routh's construction; absent where momentum alone determines the impulse.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub impulse_plane: Option<ImpulsePlane>,
}

/// Routh's construction in the plane of the impulse P on vehicle 1. An impulse changes the relative velocity at the impact center by K P, so that each event is a
/// line: `compliance.normal` P_n + `compliance.coupling` P_t has a given value, or `compliance.coupling` P_n + `compliance.tangential` P_t. A moment impulse shifts
/// the lines.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct ImpulsePlane {
    /// The compliance K at the impact center.
    pub compliance: ComplianceMatrix,
    /// Normal component of K P on the line of maximum compression, where the relative normal velocity is zero, in m/s.
    pub maximum_compression: f64,
    /// Normal component of K P on the line of termination, where restitution holds, in m/s.
    pub termination: f64,
    /// Tangential component of K P on the line where sliding ends, the relative tangential velocity being zero, in m/s.
    pub sliding_end: f64,
    /// The impulse to a common velocity, where sliding ends at maximum compression.
    pub common_velocity: PlaneImpulse,
    /// The sticking impulse of Brach's law, where sliding ends at termination; its ratio is the critical one.
    pub brach: PlaneImpulse,
    /// The sticking impulse of Kudlich and Slibar's law, where restitution holds for both components.
    pub kudlich_slibar: PlaneImpulse,
}

/// The compliance at the impact center, in 1/kg.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct ComplianceMatrix {
    /// K_nn: change of the normal velocity by a normal impulse.
    pub normal: f64,
    /// K_nt: change of the tangential velocity by a normal impulse, and the reverse.
    pub coupling: f64,
    /// K_tt: change of the tangential velocity by a tangential impulse.
    pub tangential: f64,
}

/// An impulse on vehicle 1 in the axes of the contact.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct PlaneImpulse {
    /// Along the normal, in N s.
    pub normal: f64,
    /// Along the tangent, in N s.
    pub tangential: f64,
}

/// The form in which a case gives its impulse ratio.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum ImpulseRatioGiven {
    /// It is the critical ratio.
    Critical,
    /// As a number.
    Number,
    /// As a fraction of the critical ratio.
    OfCritical,
    /// The critical ratio limited by a coefficient of friction.
    Friction,
}

/// The law of the tangential impulse.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum TangentialLaw {
    /// Sliding has ended at separation.
    Brach,
    /// Restitution holds for both components.
    KudlichSlibar,
}

impl From<Law> for TangentialLaw {
    fn from(law: Law) -> Self {
        match law {
            Law::Brach => TangentialLaw::Brach,
            Law::KudlichSlibar => TangentialLaw::KudlichSlibar,
        }
    }
}

/// The impulse on vehicle 1.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Impulse {
    /// Along the normal, in N s.
    pub normal: f64,
    /// Along the tangent, in N s.
    pub tangential: f64,
    /// Along x, in N s.
    pub x: f64,
    /// Along y, in N s.
    pub y: f64,
    /// The moment impulse in N m s, where the case has one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub moment: Option<f64>,
}

/// A velocity in the axes of the contact.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Components {
    /// Along the normal, in m/s.
    pub normal: f64,
    /// Along the tangent, in m/s.
    pub tangential: f64,
}

/// Up to where no energy is gained.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct EnergyBounds {
    /// The greatest restitution for this approach velocity.
    pub restitution: f64,
    /// The greatest restitution for any approach velocity of this contact.
    pub restitution_for_any_approach: f64,
    /// The least impulse ratio at this restitution; `null` if any.
    pub least_impulse_ratio: Option<f64>,
    /// The greatest impulse ratio at this restitution; `null` if any.
    pub greatest_impulse_ratio: Option<f64>,
}

/// Energies of both vehicles in J.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Energy {
    /// Kinetic energy before the impact.
    pub before: f64,
    /// Kinetic energy after the impact.
    pub after: f64,
    /// Energy loss T_L.
    pub loss: f64,
    /// The loss as a share of the energy before; `null` if there was none.
    pub loss_share: Option<f64>,
    /// Work W_n of the normal impulse; negative where energy is lost.
    pub normal_work: f64,
    /// Work W_t of the tangential impulse; negative where energy is lost.
    pub tangential_work: f64,
    /// Work W_m of the moment impulse, where the case has one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub moment_work: Option<f64>,
}

/// Solves a case.
///
/// # Errors
///
/// Numbers that the case lists as unknown, or every reason why the physics refuses the collision.
pub fn solve(case: &Case, _: &(), _: &dyn Control) -> Result<Answer<Solution>, Issues> {
    let impact = case.impact()?;
    let crush_plane_bracket = case.bracket.as_ref().map(|bracket| Bracket::of(case, bracket));
    let solution = Solution { crush_plane_bracket, ..Solution::of(case, &impact) };
    Ok(case.answer(solution, case.warnings(&impact)))
}

impl Solution {
    /// Of a case and its impact, without bracket.
    pub fn of(case: &Case, impact: &Impact) -> Self {
        let impact = impact.map(positive_zero);
        let crush = case.setup.crush_outputs();
        let crash3 = case.setup.crash3_outputs(&crush);
        let parties = [(&case.collision.one, &impact.one), (&case.collision.two, &impact.two)];
        let vehicle = |i: usize| {
            let vehicle = Vehicle::of(&case.names[i], parties[i].0, parties[i].1, crush[i].as_ref(), crash3[i].as_ref());
            let speed = parties[i].0.motion().velocity.length();
            let inputs = case.inputs.vehicles[i].as_ref().and_then(|vehicle| vehicle.braking.as_ref());
            let vehicle = Vehicle { braking: inputs.map(|inputs| Braking::of(inputs, speed)), ..vehicle };
            if case.model.is_angular() { vehicle } else { Vehicle { yaw_rate: f64::NAN, ..vehicle } }
        };
        let has_moment = case.collision.moment != planar_impact::Moment::None;
        Solution {
            vehicles: [vehicle(0), vehicle(1)],
            contact: Contact::of(case, &impact),
            energy: Energy {
                before: impact.kinetic_energy.before,
                after: impact.kinetic_energy.after,
                loss: positive_zero(impact.loss()),
                loss_share: Some(impact.loss() / impact.kinetic_energy.before).filter(|share| share.is_finite()),
                normal_work: impact.work.n,
                tangential_work: impact.work.t,
                moment_work: has_moment.then_some(impact.work.m),
            },
            crush_plane_bracket: None,
        }
    }

    /// The size that numbers of a measure have in this collision: 10⁻¹² of it is rounding.
    pub fn scale(&self, measure: Measure) -> f64 {
        let length = |v: [f64; 2]| libm::hypot(v[0], v[1]);
        let approach = libm::hypot(self.contact.approach.normal, self.contact.approach.tangential);
        let impulse = libm::hypot(self.contact.impulse.normal, self.contact.impulse.tangential);
        match measure {
            Measure::Speed | Measure::RoadSpeed => {
                let velocities = self.vehicles.iter().flat_map(|vehicle| [vehicle.before.velocity, vehicle.velocity]);
                velocities.map(length).fold(approach, f64::max)
            }
            Measure::Energy => self.energy.before.max(self.energy.after).max(impulse * approach),
            Measure::Impulse => impulse,
            _ => 1.0,
        }
    }
}

impl Vehicle {
    /// Returns the speed after the impact in m/s.
    pub fn speed(&self) -> f64 {
        libm::hypot(self.velocity[0], self.velocity[1])
    }

    fn of(name: &str, party: &Party, response: &Response, crush: Option<&CrushOutputs>, crash3: Option<&Crash3Outputs>) -> Self {
        let before = party.motion();
        let components = |v: Xy| [v.x, v.y].map(positive_zero);
        Vehicle {
            name: name.to_owned(),
            barrier: party.vehicle().is_none(),
            before: Motion { velocity: components(before.velocity), yaw_rate: positive_zero(before.yaw_rate) },
            velocity: components(response.after.velocity),
            yaw_rate: response.after.yaw_rate,
            delta_v: components(response.delta_v),
            delta_v_magnitude: response.delta_v_magnitude(),
            pdof: response.principal_direction_of_force(),
            crush_energy: crush.map(|crush| crush.energy),
            equivalent_energy_speed: crush.map(|crush| crush.equivalent_speed),
            mean_depth: crush.map(|crush| crush.mean_depth),
            braking: None,
            crash3: crash3.map(Crash3::of),
        }
    }
}

impl Crash3 {
    fn of(outputs: &Crash3Outputs) -> Self {
        let Crash3Outputs { pdof, correction, corrected_energy, effective_mass_factor, delta_v_magnitude } = *outputs;
        Crash3 {
            pdof: positive_zero(pdof),
            correction: positive_zero(correction),
            corrected_energy: positive_zero(corrected_energy),
            effective_mass_factor: positive_zero(effective_mass_factor),
            delta_v_magnitude: positive_zero(delta_v_magnitude),
        }
    }
}

impl Contact {
    /// Returns `true` if a friction limits the impulse ratio: less of it than ends sliding.
    pub fn slides_by_friction(&self) -> bool {
        self.impulse_ratio_given == ImpulseRatioGiven::Friction
            && self.impulse_ratio_parameter.is_some_and(|friction| self.impulse_ratio.abs() >= friction * (1.0 - 1e-12))
    }

    fn of(case: &Case, impact: &Impact) -> Self {
        use planar_impact::ImpulseRatio;
        let collision = &case.collision;
        let components = |v: Nt| Components { normal: v.n, tangential: v.t };
        let (impulse_ratio_given, impulse_ratio_parameter) = match collision.impulse_ratio {
            ImpulseRatio::Critical => (ImpulseRatioGiven::Critical, None),
            ImpulseRatio::Given(ratio) => (ImpulseRatioGiven::Number, Some(ratio)),
            ImpulseRatio::OfCritical(fraction) => (ImpulseRatioGiven::OfCritical, Some(fraction)),
            ImpulseRatio::LimitedByFriction(friction) => (ImpulseRatioGiven::Friction, Some(friction)),
        };
        let has_moment = collision.moment != planar_impact::Moment::None;
        Contact {
            model: case.model.is_momentum().then_some("momentum"),
            crush_plane: case.inputs.contact.crush_plane,
            restitution: collision.restitution,
            impulse_ratio: positive_zero(impact.impulse_ratio()),
            impulse_ratio_given,
            impulse_ratio_parameter,
            critical_impulse_ratio: positive_zero(impact.critical_impulse_ratio()),
            tangential_law: collision.law.into(),
            impulse: Impulse {
                normal: impact.impulse.n,
                tangential: impact.impulse.t,
                x: impact.impulse_on_ground.x,
                y: impact.impulse_on_ground.y,
                moment: has_moment.then_some(impact.moment),
            },
            approach: components(impact.approach),
            separation: components(impact.separation),
            no_energy_gain: collision.admissible().as_ref().filter(|_| !case.model.is_momentum()).map(EnergyBounds::of),
            impulse_plane: (!case.model.is_momentum()).then(|| ImpulsePlane::of(collision, impact)),
        }
    }
}

impl ImpulsePlane {
    fn of(collision: &Collision, impact: &Impact) -> Self {
        let contact = collision.contact();
        let compliance = &contact.compliance;
        let by_moment = contact.moment_compliance().force * impact.moment;
        let of = |change: Nt| change - by_moment;
        let sticking = |law: Law| of(law.change(contact.approach, collision.restitution));
        let impulse = |change: Nt| {
            let impulse = compliance.impulse_for(change);
            PlaneImpulse { normal: positive_zero(impulse.n), tangential: positive_zero(impulse.t) }
        };
        let (common, brach) = (of(contact.approach), sticking(Law::Brach));
        ImpulsePlane {
            compliance: ComplianceMatrix {
                normal: *compliance.nn(),
                coupling: positive_zero(*compliance.nt()),
                tangential: *compliance.tt(),
            },
            maximum_compression: positive_zero(common.n),
            termination: positive_zero(brach.n),
            sliding_end: positive_zero(common.t),
            common_velocity: impulse(common),
            brach: impulse(brach),
            kudlich_slibar: impulse(sticking(Law::KudlichSlibar)),
        }
    }
}

impl EnergyBounds {
    fn of(admissible: &Admissible) -> Self {
        EnergyBounds {
            restitution: admissible.restitution,
            restitution_for_any_approach: admissible.restitution_for_any_approach,
            least_impulse_ratio: admissible.least_impulse_ratio,
            greatest_impulse_ratio: admissible.greatest_impulse_ratio,
        }
    }
}
