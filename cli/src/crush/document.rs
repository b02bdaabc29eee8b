//! The JSON document of `crush`.

use planar_impact::crush::{CrushStiffness, ForceLine, ProfileMoments};
use serde::Serialize;

use crate::case::{Case, Crush, CrushAnswers};
use crate::named::plain;

#[derive(Serialize)]
pub struct Document<'a> {
    schema: u32,
    title: &'a str,
    /// `null` for a vehicle without crush.
    vehicles: [Option<Vehicle<'a>>; 2],
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    notes: &'a [String],
}

/// What the crush of a vehicle stands for; zeros of a barrier.
#[derive(Default, Serialize)]
struct Vehicle<'a> {
    name: &'a str,
    width: f64,
    mean_depth: f64,
    #[serde(rename = "K")]
    moments: [f64; 3],
    /// The stiffness; `null` where the zones have their own.
    #[serde(flatten)]
    stiffness: Stiffness,
    crush_energy: f64,
    equivalent_energy_speed: f64,
    /// The depth beyond which the force does not grow, where the file gives one.
    #[serde(skip_serializing_if = "Option::is_none")]
    saturation: Option<f64>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    zones: Vec<Zone>,
}

/// One law of crush in both its forms.
#[derive(Serialize)]
struct Stiffness {
    d0: Option<f64>,
    d1: Option<f64>,
    #[serde(rename = "A")]
    force: Option<f64>,
    #[serde(rename = "B")]
    force_per_depth: Option<f64>,
    #[serde(rename = "G")]
    without_crush: Option<f64>,
}

#[derive(Serialize)]
struct Zone {
    /// Where it ends; `null` for the last.
    to: Option<f64>,
    #[serde(rename = "K")]
    moments: [f64; 3],
    #[serde(flatten)]
    stiffness: Stiffness,
    crush_energy: f64,
}

impl Default for Stiffness {
    fn default() -> Self {
        Stiffness { d0: Some(0.0), d1: Some(0.0), force: Some(0.0), force_per_depth: Some(0.0), without_crush: Some(0.0) }
    }
}

impl<'a> Document<'a> {
    pub fn of(case: &'a Case) -> Self {
        let answers = case.setup.crush_answers();
        let parties = [&case.collision.one, &case.collision.two];
        let vehicle = |i: usize| match (parties[i].vehicle(), &case.setup.crush[i], &answers[i]) {
            (None, ..) => Some(Vehicle { name: &case.names[i], ..Vehicle::default() }),
            (Some(_), Some(crush), Some(answers)) => Some(Vehicle::of(&case.names[i], crush, answers)),
            _ => None,
        };
        Document { schema: 1, title: &case.title, vehicles: [vehicle(0), vehicle(1)], notes: &case.notes }
    }
}

impl<'a> Vehicle<'a> {
    fn of(name: &'a str, crush: &Crush, answers: &CrushAnswers) -> Self {
        let zones = crush.zones.zones();
        let zone = |(i, moments): (usize, ProfileMoments)| Zone {
            to: crush.zones.borders().get(i).copied(),
            moments: of_moments(moments),
            stiffness: Stiffness::of(&zones[i]),
            crush_energy: plain(zones[i].crush_energy(moments)),
        };
        let one = zones.len() == 1;
        Vehicle {
            name,
            width: crush.profile.width(),
            mean_depth: plain(answers.mean_depth),
            moments: of_moments(answers.moments),
            stiffness: if one { Stiffness::of(&zones[0]) } else { Stiffness::none() },
            crush_energy: plain(answers.energy),
            equivalent_energy_speed: plain(answers.equivalent_speed),
            saturation: crush.saturation,
            zones: if one { Vec::new() } else { crush.zones.moments(&crush.profile).enumerate().map(zone).collect() },
        }
    }
}

impl Stiffness {
    fn of(stiffness: &CrushStiffness) -> Self {
        let force = ForceLine::from(*stiffness);
        Stiffness {
            d0: Some(plain(stiffness.onset)),
            d1: Some(plain(stiffness.slope)),
            force: Some(plain(force.onset)),
            force_per_depth: Some(plain(force.slope)),
            without_crush: Some(plain(stiffness.energy_without_crush())),
        }
    }

    fn none() -> Self {
        Stiffness { d0: None, d1: None, force: None, force_per_depth: None, without_crush: None }
    }
}

fn of_moments(moments: ProfileMoments) -> [f64; 3] {
    [moments.first, moments.second, moments.third].map(plain)
}
