//! The JSON document of `crash3`.

use planar_impact::crash3::{Assumption, Assumptions, Consequence, Damaged, Surface, VehicleEstimate, approach_velocity};
use planar_impact::{Heading, Xy};
use serde::Serialize;

use super::{Comparison, Damage};
use crate::case::Case;
use crate::named::plain;

/// The JSON document of `crash3`.
#[derive(Serialize)]
pub struct Document<'a> {
    schema: u32,
    title: &'a str,
    #[serde(flatten)]
    body: Body<'a>,
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    notes: &'a [String],
}

/// What it says of the two vehicles.
#[derive(Serialize)]
pub struct Body<'a> {
    #[serde(flatten)]
    damage: Option<OfDamage<'a>>,
    /// What both methods make of the crush energy; `null` where planar mechanics refuses the case.
    planar: Option<Planar>,
}

#[derive(Serialize)]
struct OfDamage<'a> {
    vehicles: [Vehicle<'a>; 2],
    /// The corrected energies of both.
    corrected_energy: f64,
    impulse: f64,
}

/// What CRASH3 says of a vehicle; zeros of a barrier.
#[derive(Default, Serialize)]
struct Vehicle<'a> {
    name: &'a str,
    /// `null` for a barrier.
    surface: Option<&'static str>,
    crush_energy: f64,
    pdof: f64,
    correction: f64,
    corrected_energy: f64,
    moment_arm: f64,
    effective_mass_factor: f64,
    delta_v_magnitude: f64,
    /// Along x and y.
    delta_v: [f64; 2],
    /// What CRASH3 makes of the separation velocity; `null` where neither the evidence nor planar mechanics has one.
    reconstruction: Option<Reconstruction>,
}

#[derive(Serialize)]
struct Reconstruction {
    separation_velocity: [f64; 2],
    approach_velocity: [f64; 2],
}

/// What follows from the crush energy of both vehicles.
#[derive(Serialize)]
struct Planar {
    crush_energy: f64,
    planar: Follows,
    common_velocity: Follows,
    point_mass: Follows,
    tangential_factor: Follows,
    together: Follows,
}

/// What follows, and its difference from planar mechanics.
#[derive(Serialize)]
struct Follows {
    /// The assumption in words.
    #[serde(skip_serializing_if = "Option::is_none")]
    assumption: Option<&'static str>,
    loss: f64,
    delta_v_magnitude: [f64; 2],
    cost: Cost,
}

#[derive(Serialize)]
struct Cost {
    loss: f64,
    delta_v_magnitude: [f64; 2],
}

impl<'a> Document<'a> {
    pub fn of(case: &'a Case, result: &'a Comparison) -> Self {
        Document { schema: 1, title: &case.title, body: Body::of(case, result), notes: &result.notes }
    }
}

impl<'a> Body<'a> {
    pub fn of(case: &'a Case, result: &Comparison) -> Self {
        Body {
            damage: result.damage.as_ref().map(|damage| OfDamage::of(case, damage)),
            planar: result.assumptions.as_ref().map(Planar::of),
        }
    }
}

impl<'a> OfDamage<'a> {
    fn of(case: &'a Case, Damage { pair, estimate, separation }: &Damage) -> Self {
        let headings = [&case.collision.one, &case.collision.two].map(|party| party.vehicle().map(|vehicle| vehicle.heading));
        let vehicle = |i: usize, damaged: &Option<Damaged>, estimate: &Option<VehicleEstimate>| match (damaged, estimate, headings[i]) {
            (Some(damaged), Some(estimate), Some(heading)) => Vehicle::of(&case.names[i], damaged, estimate, heading, separation[i]),
            _ => Vehicle { name: &case.names[i], ..Vehicle::default() },
        };
        OfDamage {
            vehicles: [vehicle(0, &pair.one, &estimate.one), vehicle(1, &pair.two, &estimate.two)],
            corrected_energy: plain(estimate.energy),
            impulse: plain(estimate.impulse),
        }
    }
}

impl<'a> Vehicle<'a> {
    fn of(name: &'a str, damaged: &Damaged, estimate: &VehicleEstimate, heading: Heading, separation: Option<Xy>) -> Self {
        let delta_v = heading.to_ground(estimate.delta_v);
        let reconstruction = |separation: Xy| {
            let approach = approach_velocity(estimate, &heading, separation);
            Reconstruction {
                separation_velocity: [separation.x, separation.y].map(plain),
                approach_velocity: [approach.x, approach.y].map(plain),
            }
        };
        Vehicle {
            name,
            surface: Some(name_of(damaged.surface)),
            crush_energy: plain(damaged.crush_energy),
            pdof: plain(damaged.force_origin.direction()),
            correction: plain(estimate.correction),
            corrected_energy: plain(estimate.corrected_energy),
            moment_arm: plain(estimate.moment_arm),
            effective_mass_factor: plain(estimate.effective_mass_factor),
            delta_v_magnitude: plain(estimate.delta_v_magnitude),
            delta_v: [delta_v.x, delta_v.y].map(plain),
            reconstruction: separation.map(reconstruction),
        }
    }
}

impl Planar {
    fn of(assumptions: &Assumptions) -> Self {
        let follows = |with: &Consequence, cost: Consequence| {
            let delta_v = |of: &Consequence| [of.delta_v_1, of.delta_v_2].map(plain);
            Follows {
                assumption: None,
                loss: plain(with.loss),
                delta_v_magnitude: delta_v(with),
                cost: Cost { loss: plain(cost.loss), delta_v_magnitude: delta_v(&cost) },
            }
        };
        let alone = |assumption: Assumption| Follows {
            assumption: Some(assumption.statement()),
            ..follows(assumptions.with(assumption), assumptions.cost(assumption))
        };
        Planar {
            crush_energy: plain(assumptions.crush_energy),
            planar: follows(&assumptions.planar, Consequence { loss: 0.0, delta_v_1: 0.0, delta_v_2: 0.0 }),
            common_velocity: alone(Assumption::CommonVelocity),
            point_mass: alone(Assumption::PointMass),
            tangential_factor: alone(Assumption::TangentialFactor),
            together: follows(&assumptions.together, assumptions.cost_together()),
        }
    }
}

/// The name of a surface, as the case file has it.
pub fn name_of(surface: Surface) -> &'static str {
    match surface {
        Surface::Front => "front",
        Surface::Right => "right",
        Surface::Rear => "rear",
        Surface::Left => "left",
    }
}
