//! The verb `draw`: the scene of a collision to scale, as places, outlines and vectors. A drawing shows it; nothing here is drawn.

mod damage;
mod outline;
mod phase;

use planar_impact::crash3::Surface;
use planar_impact::{Distribution, ForwardLeft, Heading, Impact, Moment, Output, Side, Xy};
use schemars::JsonSchema;
use serde::Serialize;

use crate::answer::Answer;
use crate::case::{Case, Parameter, wheel_name};
use crate::control::Control;
use crate::issue::{Issue, Issues};
use crate::named::positive_zero;
use crate::notice::Notice;
use crate::reconstruct::{self, Interval, Reconstruction};
use crate::slide::{self, VehicleSlide};
use crate::solve::Motion;
use crate::uncertainty;

pub use damage::Damage;
pub use outline::Outline;
pub use phase::Phase;

/// The scene of a collision, in SI and radians, in ground axes.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Scene {
    /// Place of the impact center along x and y, in m.
    pub impact_point: [f64; 2],
    /// `true` if the case says where on the scene that is; otherwise it is the origin.
    pub is_on_scene: bool,
    /// Angle Γ of the crush plane's normal n from x, in rad; t is a quarter turn further. `null` for momentum alone, which has none.
    pub crush_plane: Option<f64>,
    /// Impulse on vehicle 1 along x and y, in N s; vehicle 2 gets the opposite one.
    pub impulse: [f64; 2],
    /// Vehicle 1 and vehicle 2.
    pub vehicles: [VehicleInScene; 2],
    /// The vehicles before the impact, at maximum compression, after the separation and, where the case follows them, at rest.
    pub phases: Vec<Phase>,
}

/// A vehicle at the impact.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct VehicleInScene {
    /// Its name.
    pub name: String,
    /// `true` for a fixed barrier, which lies along the crush plane, on the far side of the other vehicle.
    pub barrier: bool,
    /// Place of the center of mass along x and y, in m.
    pub position: [f64; 2],
    /// Heading from x, in rad.
    pub heading: f64,
    /// Impact center in the vehicle's axes: forward and left of the center of mass, in m.
    pub impact_center: [f64; 2],
    /// Outline in the vehicle's axes; `null` for a barrier, and for a mass point.
    pub outline: Option<Outline>,
    /// Residual crush, where the case has it.
    pub damage: Option<Damage>,
    /// Motion before the impact.
    pub before: Motion,
    /// Motion after the impact; its yaw rate is `null` where momentum alone does not determine it.
    pub after: MotionAfter,
    /// Change of velocity along x and y, in m/s.
    pub delta_v: [f64; 2],
    /// Principal direction of force, clockwise from straight ahead, in rad.
    pub pdof: f64,
    /// Range of the principal direction of force in rad: the interval of a reconstruction, or 95 % to first order in uncertain inputs.
    pub pdof_range: Option<[f64; 2]>,
    /// Range of the speed before the impact in m/s: the interval of a reconstruction, or 95 % of an uncertain input.
    pub speed_range: Option<[f64; 2]>,
    /// The skids before the impact, in their order along the road: the path of the center of mass, from x and y to x and y, in m.
    pub skids: Vec<[[f64; 2]; 2]>,
    /// The slide from separation to rest, where the case gives ground and wheels.
    pub slide: Option<VehicleSlide>,
    /// Where it came to rest according to the case.
    pub rest: Option<GivenRest>,
}

/// A motion after the impact.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct MotionAfter {
    /// Velocity along x and y, in m/s.
    pub velocity: [f64; 2],
    /// Yaw rate in rad/s; `null` where it is not determined.
    pub yaw_rate: Option<f64>,
    /// Deviations of the velocity, to first order in uncertain inputs.
    pub velocity_sd: Option<Deviations>,
}

/// The standard deviations of a vector in the plane, along the axes in which they are the greatest and the least.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Deviations {
    /// The greatest and the least standard deviation, in the unit of the vector.
    pub sd: [f64; 2],
    /// The angle of the greatest from x, in rad.
    pub angle: f64,
}

impl Deviations {
    /// Returns the axes of a covariance.
    fn of([[xx, xy], [_, yy]]: [[f64; 2]; 2]) -> Self {
        let (middle, half) = (0.5 * (xx + yy), libm::hypot(0.5 * (xx - yy), xy));
        // Rounding leaves a covariance without width below zero.
        let sd = [middle + half, middle - half].map(|variance| libm::sqrt(variance.max(0.0)));
        Deviations { sd, angle: positive_zero(0.5 * libm::atan2(2.0 * xy, xx - yy)) }
    }
}

/// A rest position of the case.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct GivenRest {
    /// Place of the center of mass along x and y, in m.
    pub position: [f64; 2],
    /// Its standard deviations, in m.
    pub position_sd: [f64; 2],
    /// Heading in rad.
    pub heading: f64,
    /// Its standard deviation, in rad.
    pub heading_sd: f64,
    /// Points that the vehicle passed on the way.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    #[schemars(default)]
    pub points: Vec<GivenPoint>,
}

/// A point that a vehicle passed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct GivenPoint {
    /// The wheel that passed it; `null` for the center of mass.
    pub wheel: Option<&'static str>,
    /// Its place along x and y, in m.
    pub position: [f64; 2],
    /// Its standard deviations, in m.
    pub position_sd: [f64; 2],
}

/// Returns the scene of a case: of the solved collision, or of the reconstructed one where the case has unknowns.
///
/// # Errors
///
/// Those of `solve` or of `reconstruct`; evidence that leaves an unknown open.
pub fn draw(case: &Case, _: &(), control: &dyn Control) -> Result<Answer<Scene>, Issues> {
    if case.knowledge.unknowns.is_empty() {
        return draw_solved(case);
    }
    let answer = reconstruct::reconstruct(case, &reconstruct::Options::default(), control)?;
    let (notices, Reconstruction { scene, verdict, .. }) = (answer.notices, answer.facts);
    let Some((scene, more)) = scene else {
        let help = "give more evidence: `planar-impact reconstruct` says what is open";
        let issue = Issue::at("undetermined", "unknown", "the evidence leaves an unknown open, so there is no one collision to draw");
        return Err(case.unfit([issue.with_help(help)]));
    };
    let mut notices = notices;
    if verdict != "agrees" {
        let message = format!("the drawing shows the best fit, which is not an answer: the verdict is `{verdict}`");
        notices.0.push(Notice::warning("best-fit", "unknown", message));
    }
    notices.0.extend(more);
    Ok(Answer::new(&case.title, scene, notices))
}

/// Returns the scene of the solved collision, as `draw` does for a case without unknowns. A program that calls this alone is linked without the
/// search of a reconstruction.
///
/// # Errors
///
/// Those of `solve`.
pub fn draw_solved(case: &Case) -> Result<Answer<Scene>, Issues> {
    let impact = case.impact()?;
    let (scene, notices) = Scene::of(case, &impact);
    let scene = scene.with_uncertain_inputs(case);
    Ok(case.answer(scene, case.warnings(&impact).into_iter().chain(notices).chain(evidence_not_drawn(case))))
}

/// Returns a note if the evidence gives a motion at separation, with which `slide` begins.
fn evidence_not_drawn(case: &Case) -> Option<Notice> {
    let message = "the picture is that of the solved impact; `slide` begins with the motion at separation that the evidence gives";
    let slides = |side: Side| case.rest.as_ref().is_some_and(|rest| rest.vehicles[side as usize].is_some());
    let is_given = Side::ALL.into_iter().any(|side| slides(side) && slide::given_motion(case, side).is_some());
    is_given.then(|| Notice::note("evidence-not-drawn", "evidence", message))
}

impl Scene {
    /// Returns the scene of a case and its impact, and what to know about the drawing.
    pub fn of(case: &Case, impact: &Impact) -> (Scene, Vec<Notice>) {
        let impact_point = case.scene.unwrap_or(Xy::zero());
        let mut notices = Vec::new();
        let parties = case.collision.parties();
        let responses = [impact.one, impact.two];
        let vehicles = Side::ALL.map(|side| {
            let i = side as usize;
            let Some(inputs) = &case.inputs.vehicles[i] else { return VehicleInScene::barrier(&case.names[i], impact_point) };
            let heading = Heading::from_angle(inputs.heading);
            let position = impact_point - heading.to_ground(inputs.impact_center);
            let rest = case.rest.as_ref().and_then(|rest| rest.vehicles[i].as_ref());
            let outline = Outline::of(inputs, rest, case.model.is_angular(), side, &mut notices);
            let before = parties[i].motion();
            let response = responses[i];
            // Without a place on the scene, each rest position is counted from where its vehicle separated.
            let shift = rest.map_or(Xy::zero(), |rest| if case.scene.is_some() { Xy::zero() } else { position - rest.separation.position });
            let slide = rest.and_then(|rest| {
                let slide = rest.slide.to_rest(&rest.separation, &response.after);
                let not_drawn = |why| {
                    let message = format!("{}: its slide to rest is not drawn: {why}", case.names[i]);
                    notices.push(Notice::warning("no-slide", format!("rest.vehicle.{}", i + 1), message));
                };
                slide.map_err(not_drawn).ok().map(|slide| VehicleSlide::of(case, side, rest, &slide).moved(components(shift)))
            });
            VehicleInScene {
                name: case.names[i].clone(),
                barrier: false,
                position: components(position),
                heading: inputs.heading,
                impact_center: [inputs.impact_center.forward, inputs.impact_center.left],
                damage: inputs.crush.as_ref().zip(outline.as_ref()).map(|(crush, outline)| {
                    let along = || Surface::along(&case.collision.crush_plane, &heading, &response.force_direction());
                    Damage::of(crush, crush.surface.unwrap_or_else(along), outline, inputs.impact_center)
                }),
                outline,
                before: Motion { velocity: components(before.velocity), yaw_rate: before.yaw_rate },
                after: MotionAfter {
                    velocity: components(response.after.velocity),
                    yaw_rate: case.model.is_angular().then_some(positive_zero(response.after.yaw_rate)),
                    velocity_sd: None,
                },
                delta_v: components(response.delta_v),
                pdof: positive_zero(response.principal_direction_of_force()),
                pdof_range: None,
                speed_range: None,
                skids: inputs.braking.as_ref().map_or_else(Vec::new, |braking| skids(position, before.velocity, &braking.skids)),
                slide,
                rest: rest.and_then(|rest| rest.evidence.as_ref()).map(|evidence| GivenRest {
                    position: components(evidence.rest.position + shift),
                    position_sd: [evidence.position_deviation.x, evidence.position_deviation.y],
                    heading: evidence.rest.heading,
                    heading_sd: evidence.heading_deviation,
                    points: evidence
                        .points
                        .iter()
                        .map(|point| GivenPoint {
                            wheel: point.wheel.map(wheel_name),
                            position: components(point.position + shift),
                            position_sd: [point.deviation.x, point.deviation.y],
                        })
                        .collect(),
                }),
            }
        });
        let has_moment = case.collision.moment != Moment::None;
        if has_moment {
            notices.push(Notice::note("moment-not-drawn", "contact.moment", "the moment impulse is not drawn"));
        }
        let mut scene = Scene {
            impact_point: components(impact_point),
            is_on_scene: case.scene.is_some(),
            crush_plane: (!case.model.is_momentum()).then_some(case.inputs.contact.crush_plane),
            impulse: components(impact.impulse_on_ground),
            vehicles,
            phases: Vec::new(),
        };
        scene.phases = phase::phases(&scene, case.collision.restitution);
        (scene, notices)
    }

    /// Adds the ranges of uncertain inputs, to first order: 1.96 standard deviations to each side.
    fn with_uncertain_inputs(mut self, case: &Case) -> Scene {
        let around = |value: f64, sd: f64| sd.is_finite().then(|| [-sd, sd].map(|sd| value + Distribution::NORMAL_95 * sd));
        for (vehicle, side) in self.vehicles.iter_mut().zip(Side::ALL).filter(|(vehicle, _)| !vehicle.barrier) {
            let of = [Output::PrincipalDirectionOfForce(side), Output::VelocityX(side), Output::VelocityY(side)];
            if let Some(covariances) = uncertainty::covariances(case, &of) {
                let velocity = [1, 2].map(|i| [covariances[i][1], covariances[i][2]]);
                let deviations = velocity.iter().flatten().all(|covariance| covariance.is_finite()).then(|| Deviations::of(velocity));
                vehicle.after.velocity_sd = deviations.filter(|deviations| deviations.sd[0] > 0.0);
                let direction = covariances[0][0];
                vehicle.pdof_range = (direction > 0.0).then(|| around(vehicle.pdof, libm::sqrt(direction))).flatten();
            }
            let speed = case.uncertain.inputs.iter().find(|input| input.parameter == Parameter::Speed(side));
            vehicle.speed_range = speed.and_then(|speed| around(speed.distribution.mean(), speed.distribution.sd()));
        }
        self
    }

    /// Adds the ranges of a reconstruction.
    pub(crate) fn with_ranges(mut self, answer: &Reconstruction) -> Scene {
        let ends = |interval: &Interval| Some([interval.low?, interval.high?]);
        for (vehicle, number) in self.vehicles.iter_mut().zip(1..) {
            vehicle.pdof_range = answer.derived.get(&format!("vehicle.{number}.pdof")).and_then(|derived| ends(&derived.interval));
            vehicle.speed_range = answer.unknown.get(&format!("vehicle.{number}.speed")).and_then(|unknown| ends(&unknown.interval));
        }
        self
    }
}

impl VehicleInScene {
    fn barrier(name: &str, impact_point: Xy) -> Self {
        VehicleInScene {
            name: name.to_owned(),
            barrier: true,
            position: components(impact_point),
            heading: 0.0,
            impact_center: [0.0; 2],
            outline: None,
            damage: None,
            before: Motion { velocity: [0.0; 2], yaw_rate: 0.0 },
            after: MotionAfter { velocity: [0.0; 2], yaw_rate: Some(0.0), velocity_sd: None },
            delta_v: [0.0; 2],
            pdof: 0.0,
            pdof_range: None,
            speed_range: None,
            skids: Vec::new(),
            slide: None,
            rest: None,
        }
    }

    /// Returns the speed before the impact in m/s.
    pub fn speed_before(&self) -> f64 {
        self.before.speed()
    }

    /// Returns the speed after the impact in m/s.
    pub fn speed_after(&self) -> f64 {
        libm::hypot(self.after.velocity[0], self.after.velocity[1])
    }

    /// Returns the magnitude of the change of velocity in m/s.
    pub fn delta_v_magnitude(&self) -> f64 {
        libm::hypot(self.delta_v[0], self.delta_v[1])
    }

    /// Returns the principal direction of force on a clock with 12 straight ahead.
    pub fn pdof_clock(&self) -> u8 {
        match (self.pdof.to_degrees() / 30.0).round().rem_euclid(12.0) as u8 {
            0 => 12,
            hour => hour,
        }
    }

    /// Returns the place on the ground of a point in the vehicle's axes.
    pub fn on_ground(&self, [forward, left]: [f64; 2]) -> [f64; 2] {
        components(
            Xy { x: self.position[0], y: self.position[1] } + Heading::from_angle(self.heading).to_ground(ForwardLeft { forward, left }),
        )
    }
}

fn components(v: Xy) -> [f64; 2] {
    [v.x, v.y].map(positive_zero)
}

/// Places the skids straight behind the vehicle, along its velocity.
fn skids(position: Xy, velocity: Xy, skids: &[planar_impact::skid::Skid]) -> Vec<[[f64; 2]; 2]> {
    let speed = velocity.length();
    if speed == 0.0 {
        return Vec::new();
    }
    let ahead = velocity * speed.recip();
    let mut end = position;
    let mut placed: Vec<_> = skids
        .iter()
        .rev()
        .map(|skid| {
            let start = end - ahead * skid.length;
            [components(start), components(std::mem::replace(&mut end, start))]
        })
        .collect();
    placed.reverse();
    placed
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_axes_of_a_covariance() {
        // Deviations 3 and 1, the greater one at an angle: S = R diag(9, 1) R'.
        for angle in [-1.5, -0.4, 0.0, 0.3, 1.2] {
            let (sin, cos) = libm::sincos(angle);
            let (xx, yy, xy) = (9.0 * cos * cos + sin * sin, 9.0 * sin * sin + cos * cos, 8.0 * sin * cos);
            let found = Deviations::of([[xx, xy], [xy, yy]]);
            let apart = [found.sd[0] - 3.0, found.sd[1] - 1.0, found.angle - angle];
            assert!(apart.into_iter().all(|apart| apart.abs() < 1e-14), "{angle}: {found:?}");
        }
        let without_width = Deviations::of([[4.0, 0.0], [0.0, 0.0]]);
        assert_eq!(without_width, Deviations { sd: [2.0, 0.0], angle: 0.0 });
    }
}
