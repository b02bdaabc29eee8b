//! The verb `slide`: follows the vehicles from separation to rest.

use planar_impact::post_impact::{Method, NearestPlace, NoRest, PathPoint, Pose, Rest, TrajectoryState};
use planar_impact::reconstruct::Measurand;
use planar_impact::{Motion, Output, Side, Xy};
use schemars::JsonSchema;
use serde::Serialize;

use crate::answer::Answer;
use crate::case::{Case, RestOfVehicle, vehicle_number, wheel_name};
use crate::control::Control;
use crate::issue::{Issue, Issues};
use crate::named::positive_zero;
use crate::notice::Notice;
use crate::wording;

/// The slides to rest, in SI and radians.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Slides {
    /// Each vehicle that the case gives wheels and ground.
    pub vehicles: Vec<VehicleSlide>,
}

/// The slide of a vehicle from separation to rest.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct VehicleSlide {
    /// Its number, 1 or 2.
    pub vehicle: usize,
    /// Its name.
    pub name: String,
    /// `solve` if its motion at separation is computed from the impact, `given` if it is evidence of the case.
    pub separation_from: &'static str,
    /// Where it comes to rest.
    pub rest: RestPose,
    /// Distance of the rest pose from the given one, where the case has it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub miss: Option<Miss>,
    /// Points along the path that the case gives, beside the places of this path that are nearest to them.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    #[schemars(default)]
    pub points: Vec<PointFit>,
    /// Time from separation to rest, in s.
    pub time: f64,
    /// Length of the path of the center of mass, in m.
    pub distance: f64,
    /// The motion, from separation to rest.
    pub path: Vec<State>,
}

/// A pose.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct RestPose {
    /// Place of the center of mass along x and y, in m.
    pub position: [f64; 2],
    /// Heading in rad, whole turns counted.
    pub heading: f64,
}

/// What a computed rest pose misses a given one by.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Miss {
    /// Computed less given place, along x and y, in m.
    pub position: [f64; 2],
    /// Computed less given heading, in rad.
    pub heading: f64,
}

/// A point along the path, beside the place of the path that is nearest to it in standard deviations.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct PointFit {
    /// The wheel that passed it; `null` for the center of mass.
    pub wheel: Option<&'static str>,
    /// Its place along x and y in the file, in m.
    pub given: [f64; 2],
    /// Its standard deviations along x and y, in m.
    pub sd: [f64; 2],
    /// The nearest place of the path, in m.
    pub computed: [f64; 2],
    /// The time since separation of the vehicle there, in s.
    pub time: f64,
    /// Distance from the path in standard deviations, positive where the point is to the left of the path.
    pub standardised_residual: f64,
    /// `true` if the nearest place is an end of the path.
    pub is_end: bool,
}

/// A state of the motion.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct State {
    /// Time since separation, in s.
    pub t: f64,
    /// Place of the center of mass along x, in m.
    pub x: f64,
    /// Place along y, in m.
    pub y: f64,
    /// Heading in rad.
    pub heading: f64,
    /// Velocity along x, in m/s.
    pub vx: f64,
    /// Velocity along y, in m/s.
    pub vy: f64,
    /// Yaw rate in rad/s.
    pub yaw_rate: f64,
    /// Places of the wheels in m: front left, front right, rear left, rear right.
    pub wheels: [[f64; 2]; 4],
}

/// Follows each vehicle of `[rest]` from separation to rest. It separates with the motion that the evidence gives, or else with that of the solved impact.
///
/// # Errors
///
/// A case without `[rest]` or with unknowns that the impact needs, the reasons why the physics refuses it, or a vehicle that does not come to rest.
pub fn slide(case: &Case, _: &(), control: &dyn Control) -> Result<Answer<Slides>, Issues> {
    control.proceed(0, 2)?;
    let Some(rest) = &case.rest else {
        let help = "give [rest] with `friction`, and [rest.vehicle.1] with `front_axle`, `rear_axle`, `track` and `wheels`";
        return Err(case.unfit([Issue::at("no-rest", "rest", "missing: the ground and the wheels").with_help(help)]));
    };
    let sides = || Side::ALL.into_iter().filter_map(|side| Some((side, rest.vehicles[side as usize].as_ref()?)));
    let given = |side| given_motion(case, side);
    let impact = if sides().all(|(side, _)| given(side).is_some()) { None } else { Some(case.impact()?) };
    let (mut vehicles, mut issues) = (Vec::new(), Vec::new());
    for (done, (side, of)) in sides().enumerate() {
        control.proceed(done, 2)?;
        let solved = impact.as_ref().map(|impact| [impact.one, impact.two][side as usize].after);
        let Some((motion, separation_from)) = given(side).map(|motion| (motion, "given")).or(solved.map(|motion| (motion, "solve"))) else {
            continue;
        };
        match of.slide.to_rest(&of.separation, &motion) {
            Ok(rest) => vehicles.push(VehicleSlide { separation_from, ..VehicleSlide::of(case, side, of, &rest) }),
            Err(why) => issues.push(issue(side, &why)),
        }
    }
    if !issues.is_empty() {
        return Err(case.refuse_physics(issues));
    }
    let warnings = impact.as_ref().map_or_else(Vec::new, |impact| case.warnings(impact));
    let note = (case.scene.is_none() && sides().any(|(_, of)| of.separation.position == Xy::zero())).then(|| {
        let message = "places are counted from where each vehicle separated: [scene] impact_point puts both on the scene";
        Notice::note("places-from-separation", "rest", message)
    });
    let is_uncertain = |of: &RestOfVehicle| of.evidence.as_ref().is_some_and(|evidence| evidence.friction_deviation > 0.0);
    let friction = sides()
        .any(|(_, of)| is_uncertain(of))
        .then(|| Notice::note("nominal-values", "rest.friction", "rest.friction is uncertain, and used at its nominal value"));
    let incomplete = sides().filter_map(|(side, _)| incomplete_motion(case, side));
    let not_used = sides().filter(|(_, of)| of.method == Method::ClosedForm).map(|(side, _)| {
        let message = "`method = \"closed-form\"` is for `reconstruct`, and not used: a slide follows the wheels over the ground";
        Notice::note("method-not-used", format!("rest.vehicle.{}.method", vehicle_number(side)), message)
    });
    Ok(case.answer(Slides { vehicles }, warnings.into_iter().chain(friction).chain(note).chain(incomplete).chain(not_used)))
}

/// Returns a note if the evidence gives a part of the motion at separation, which is not used.
fn incomplete_motion(case: &Case, side: Side) -> Option<Notice> {
    let parts = Output::motion_after(side).map(Measurand::Output);
    let first = parts.into_iter().find_map(|part| case.knowledge.of(part))?;
    let message = format!(
        "vehicle {}: the evidence gives a part of the motion at separation, which is not used: give `separation_velocity` and `separation_yaw_rate`",
        vehicle_number(side)
    );
    given_motion(case, side).is_none().then(|| Notice::note("incomplete-motion", first.key.clone(), message))
}

/// Returns the motion at separation that the evidence gives, if it gives all of it.
pub(crate) fn given_motion(case: &Case, side: Side) -> Option<Motion> {
    let velocity = case.knowledge.separation()[side as usize]?;
    let yaw_rate = case.knowledge.of(Measurand::Output(Output::YawRate(side)))?.value;
    Some(Motion { velocity, yaw_rate })
}

fn issue(side: Side, why: &NoRest) -> Issue {
    let path = format!("rest.vehicle.{}", vehicle_number(side));
    Issue::at("no-rest", path, why.to_string()).with_help(wording::remedy_of_no_rest(why))
}

impl PointFit {
    pub(crate) fn of(point: &PathPoint, place: &NearestPlace) -> Self {
        let pair = |v: Xy| [v.x, v.y].map(positive_zero);
        PointFit {
            wheel: point.wheel.map(wheel_name),
            given: pair(point.position),
            sd: pair(point.deviation),
            computed: pair(place.position),
            time: place.time,
            standardised_residual: positive_zero(place.standardized_residual),
            is_end: place.is_end,
        }
    }
}

impl VehicleSlide {
    /// The slide with every place moved.
    pub(crate) fn moved(mut self, by: [f64; 2]) -> Self {
        let moved = |place: &mut [f64; 2]| *place = [place[0] + by[0], place[1] + by[1]];
        moved(&mut self.rest.position);
        for point in &mut self.points {
            moved(&mut point.given);
            moved(&mut point.computed);
        }
        for state in &mut self.path {
            (state.x, state.y) = (state.x + by[0], state.y + by[1]);
            state.wheels.iter_mut().for_each(moved);
        }
        self
    }

    pub(crate) fn of(case: &Case, side: Side, of: &RestOfVehicle, rest: &Rest) -> Self {
        let xy = |v: Xy| [v.x, v.y].map(positive_zero);
        let end = TrajectoryState { time: rest.time, pose: rest.pose, motion: Motion::rest() };
        let state = |state: &TrajectoryState| {
            let wheels = of.slide.vehicle.wheel_places(&state.pose);
            State {
                t: state.time,
                x: positive_zero(state.pose.position.x),
                y: positive_zero(state.pose.position.y),
                heading: positive_zero(state.pose.heading),
                vx: positive_zero(state.motion.velocity.x),
                vy: positive_zero(state.motion.velocity.y),
                yaw_rate: positive_zero(state.motion.yaw_rate),
                wheels: [wheels.front_left, wheels.front_right, wheels.rear_left, wheels.rear_right].map(xy),
            }
        };
        let nearest = |point: &PathPoint| Some(PointFit::of(point, &point.nearest(&of.slide, &rest.path)?));
        let miss = |given: Pose| Miss {
            position: xy(rest.pose.position - given.position),
            heading: positive_zero(rest.pose.heading - given.heading),
        };
        VehicleSlide {
            vehicle: vehicle_number(side),
            name: case.names[side as usize].clone(),
            separation_from: "solve",
            rest: RestPose { position: xy(rest.pose.position), heading: positive_zero(rest.pose.heading) },
            miss: of.evidence.as_ref().map(|evidence| miss(evidence.rest)),
            points: of.evidence.iter().flat_map(|evidence| &evidence.points).filter_map(nearest).collect(),
            time: rest.time,
            distance: rest.distance(),
            path: rest.path.iter().chain([&end]).map(state).collect(),
        }
    }
}
