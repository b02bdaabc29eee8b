//! The result of `solve` in the form other tools read: SI and radians, key by key as documented.

use planar_impact::{Impact, Nt, Response};
use serde::Serialize;

use crate::bracket;
use crate::case::{Case, Crash3Answers, CrushAnswers};
use crate::named::plain;

/// The JSON document of `solve`.
#[derive(Debug, Serialize)]
pub struct Solution {
    schema: u32,
    title: String,
    vehicles: [Vehicle; 2],
    contact: Contact,
    energy: Energy,
    /// Only when the case gives the surfaces that meet.
    #[serde(skip_serializing_if = "Option::is_none")]
    crush_plane_bracket: Option<bracket::Document>,
    /// What was taken for granted, such as the unit of a number without one; left out when nothing was.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    notes: Vec<String>,
}

#[derive(Debug, Serialize)]
struct Vehicle {
    name: String,
    velocity: [f64; 2],
    yaw_rate: f64,
    delta_v: [f64; 2],
    delta_v_magnitude: f64,
    pdof: f64,
    /// These only when the case has the crush of this vehicle.
    #[serde(skip_serializing_if = "Option::is_none")]
    crush_energy: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    equivalent_energy_speed: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    mean_depth: Option<f64>,
    /// Only when every vehicle has its crush.
    #[serde(skip_serializing_if = "Option::is_none")]
    crash3: Option<Crash3>,
}

/// What CRASH3 makes of the crush of a vehicle.
#[derive(Debug, Serialize)]
struct Crash3 {
    pdof: f64,
    correction: f64,
    corrected_energy: f64,
    effective_mass_factor: f64,
    delta_v_magnitude: f64,
}

impl Crash3 {
    fn of(answers: &Crash3Answers) -> Self {
        let Crash3Answers { pdof, correction, corrected_energy, effective_mass_factor, delta_v_magnitude } = *answers;
        Crash3 {
            pdof: plain(pdof),
            correction: plain(correction),
            corrected_energy: plain(corrected_energy),
            effective_mass_factor: plain(effective_mass_factor),
            delta_v_magnitude: plain(delta_v_magnitude),
        }
    }
}

#[derive(Debug, Serialize)]
struct Contact {
    restitution: f64,
    impulse_ratio: f64,
    /// `null` where the impulse that ends sliding has no normal part.
    critical_impulse_ratio: f64,
    impulse: Impulse,
    approach: Components,
    separation: Components,
}

#[derive(Debug, Serialize)]
struct Impulse {
    normal: f64,
    tangential: f64,
    x: f64,
    y: f64,
    /// Only when the case has a moment impulse.
    #[serde(skip_serializing_if = "Option::is_none")]
    moment: Option<f64>,
}

#[derive(Debug, Serialize)]
struct Components {
    normal: f64,
    tangential: f64,
}

#[derive(Debug, Serialize)]
struct Energy {
    before: f64,
    after: f64,
    loss: f64,
    normal_work: f64,
    tangential_work: f64,
    /// Only when the case has a moment impulse.
    #[serde(skip_serializing_if = "Option::is_none")]
    moment_work: Option<f64>,
}

impl Solution {
    /// Of a case and its impact.
    pub fn of(case: &Case, impact: &Impact, crush_plane_bracket: Option<bracket::Document>, notes: Vec<String>) -> Self {
        let impact = impact.map(plain);
        let crush = case.setup.crush_answers();
        let [crash3_1, crash3_2] = case.setup.crash3_answers(&crush);
        let [crush_1, crush_2] = crush;
        let vehicle = |name: &String, response: &Response, crush: Option<CrushAnswers>, crash3: Option<Crash3Answers>| Vehicle {
            name: name.clone(),
            velocity: [response.after.velocity.x, response.after.velocity.y],
            yaw_rate: response.after.yaw_rate,
            delta_v: [response.delta_v.x, response.delta_v.y],
            delta_v_magnitude: response.delta_v_magnitude(),
            pdof: response.principal_direction_of_force(),
            crush_energy: crush.as_ref().map(|crush| crush.energy),
            equivalent_energy_speed: crush.as_ref().map(|crush| crush.equivalent_speed),
            mean_depth: crush.as_ref().map(|crush| crush.mean_depth),
            crash3: crash3.as_ref().map(Crash3::of),
        };
        let components = |v: Nt| Components { normal: v.n, tangential: v.t };
        let has_moment = case.collision.moment != planar_impact::Moment::None;
        Solution {
            schema: 1,
            title: case.title.clone(),
            vehicles: [vehicle(&case.names[0], &impact.one, crush_1, crash3_1), vehicle(&case.names[1], &impact.two, crush_2, crash3_2)],
            contact: Contact {
                restitution: case.collision.restitution,
                impulse_ratio: plain(impact.impulse_ratio()),
                critical_impulse_ratio: plain(impact.critical_impulse_ratio()),
                impulse: Impulse {
                    normal: impact.impulse.n,
                    tangential: impact.impulse.t,
                    x: impact.impulse_on_ground.x,
                    y: impact.impulse_on_ground.y,
                    moment: has_moment.then_some(impact.moment),
                },
                approach: components(impact.approach),
                separation: components(impact.separation),
            },
            energy: Energy {
                before: impact.kinetic_energy.before,
                after: impact.kinetic_energy.after,
                loss: plain(impact.loss()),
                normal_work: impact.work.n,
                tangential_work: impact.work.t,
                moment_work: has_moment.then_some(impact.work.m),
            },
            crush_plane_bracket,
            notes,
        }
    }
}
