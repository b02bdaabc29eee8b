//! Derivatives of the pose at rest by the motion at separation and by the friction: the variational equations, integrated with the equations of motion.
//!
//! The iteration is in f64 alone. The derivatives of the state are additional unknowns of the same integrator: S' = ∂f/∂y S + ∂f/∂φ, each column of it one
//! pass of the equations of motion on dual numbers. They are exact for the flow, not for the steps, so the tolerance applies to them too.

use alloc::vec::Vec;

use differential_equations::ode::ODE;
use num_dual::Dual64;

use super::issue::NoRest;
use super::path_point::{On, PathPoint};
use super::slide::Slide;
use super::trajectory::{Effort, Moving, follow};
use super::trajectory_state::TrajectoryState;
use super::vehicle::{Pose, Standing};
use crate::frame::{Heading, Xy};
use crate::vehicle::Motion;

/// V_x, V_y, Ω and the common factor of the frictions.
pub(super) const VARIED: usize = 4;
/// Pose and motion, and their derivatives.
const SIZE: usize = 6 * (1 + VARIED);

/// Error of a step if the derivatives determine the next step of a search.
pub(super) const COARSE: f64 = 1e-5;
/// Error of a step if the derivatives are the result.
pub(super) const FINE: f64 = 1e-9;

/// Derivatives by V_x, V_y, Ω and the factor of the frictions.
pub(super) type Slopes = [f64; VARIED];

/// Derivatives of a pose at rest, and of the residuals of points along the path.
pub(super) struct VariedRest {
    /// Those of x, y and heading at rest.
    pub by: [Slopes; 3],
    /// Those of the residuals of each point.
    pub points: Vec<[Slopes; 2]>,
}

/// The equations of motion on dual numbers, with the common factor of the frictions constant or varied.
struct VariationalEquations {
    fixed: Slide<Dual64>,
    more_friction: Slide<Dual64>,
    wheels: [Standing<Dual64>; 4],
}

impl VariationalEquations {
    fn of(slide: &Slide) -> Self {
        let fixed = slide.clone().map(Dual64::from);
        let mut more_friction = fixed.clone();
        more_friction.ground = more_friction.ground.times(Dual64::new(1.0, 1.0));
        let wheels = fixed.standing();
        VariationalEquations { fixed, more_friction, wheels }
    }

    /// Returns the slide for the derivative by a varied quantity.
    fn slide(&self, varied: usize) -> &Slide<Dual64> {
        if varied == VARIED - 1 { &self.more_friction } else { &self.fixed }
    }

    /// Evaluates the equations of motion with the derivative by a varied quantity.
    fn flow(&self, varied: usize, state: [Dual64; 6]) -> [Dual64; 6] {
        let slide = self.slide(varied);
        let (pose, motion) = on_duals(state);
        let rate = slide.acceleration_by(&slide.drag_of(&self.wheels, &pose, &motion)).components();
        let [vx, vy, yaw_rate] = motion.components();
        let [ax, ay, yaw_acceleration] = rate;
        [vx, vy, yaw_rate, ax, ay, yaw_acceleration]
    }

    /// Returns the state at the event, whose time depends on the varied quantity: the instant changes by −(∂g/∂y · S)/(∂g/∂y · f).
    fn at_the_event(&self, varied: usize, state: [Dual64; 6], rest_speed: f64) -> [Dual64; 6] {
        let event = |state| self.slide(varied).above_rest(&on_duals(state).1, Dual64::from(rest_speed)).eps;
        let rate = self.flow(varied, state).map(|rate| rate.re);
        let falls = event(core::array::from_fn(|i| Dual64::new(state[i].re, rate[i])));
        let later = -event(state) / falls;
        core::array::from_fn(|i| Dual64::new(state[i].re, state[i].eps + rate[i] * later))
    }
}

/// Returns the state with its derivative by one of the varied quantities.
fn along(state: &[f64; SIZE], varied: usize) -> [Dual64; 6] {
    core::array::from_fn(|i| Dual64::new(state[i], state[6 * (1 + varied) + i]))
}

fn on_duals(state: [Dual64; 6]) -> (Pose<Dual64>, Motion<Dual64>) {
    let [x, y, heading, vx, vy, yaw_rate] = state;
    (Pose { position: Xy { x, y }, heading }, Motion { velocity: Xy { x: vx, y: vy }, yaw_rate })
}

impl ODE<f64, [f64; SIZE]> for VariationalEquations {
    fn diff(&self, _: f64, state: &[f64; SIZE], change: &mut [f64; SIZE]) {
        for varied in 0..VARIED {
            let by = self.flow(varied, along(state, varied));
            for (i, rate) in by.into_iter().enumerate() {
                change[i] = rate.re;
                change[6 * (1 + varied) + i] = rate.eps;
            }
        }
    }
}

impl Slide {
    /// Computes the derivatives of the end of a checked slide.
    pub(super) fn varied_rest(
        &self,
        from: &Pose,
        motion: &Motion,
        points: &[PathPoint],
        tolerance: f64,
        effort: &mut Effort,
    ) -> Result<VariedRest, NoRest> {
        let mut start = [0.0; SIZE];
        start[..6].copy_from_slice(&[
            from.position.x,
            from.position.y,
            from.heading,
            motion.velocity.x,
            motion.velocity.y,
            motion.yaw_rate,
        ]);
        // V_x, V_y and Ω are the last three of the state.
        for varied in 0..3 {
            start[6 * (1 + varied) + 3 + varied] = 1.0;
        }
        let equations = VariationalEquations::of(self);
        let end = follow(self, &equations, start, tolerance, effort)?;
        let last: TrajectoryState = end.state.passing(end.time);
        self.stand_still(&last)?;
        let mut by = [[0.0; VARIED]; 3];
        if last.motion != Motion::rest() {
            for varied in 0..VARIED {
                let state = along(&end.state, varied);
                let state = if end.time > 0.0 { equations.at_the_event(varied, state, self.rest_speed()) } else { state };
                let (at, motion) = on_duals(state);
                let rest = equations.slide(varied).after_remainder(&at, &motion);
                for (row, value) in by.iter_mut().zip([rest.position.x, rest.position.y, rest.heading]) {
                    row[varied] = value.eps;
                }
            }
        }
        let mut states = end.path;
        states.push((end.time, end.state));
        let path: Vec<TrajectoryState> = states.iter().map(|(time, state)| state.passing(*time)).collect();
        let of_point = |point: &PathPoint| {
            let Some(passage) = point.passage(self, &path) else { return [[0.0; VARIED]; 2] };
            let of_pose = |varied: usize| match passage.on {
                On::Start => [0.0; 3],
                On::Step { first, share, .. } => {
                    let duration = path[first + 1].time - path[first].time;
                    core::array::from_fn(|i| between(&states[first].1, &states[first + 1].1, 6 * (1 + varied) + i, share, duration))
                }
                On::End => core::array::from_fn(|i| by[i][varied]),
            };
            let arm = Heading::from_angle(passage.pose.heading).to_ground(point.arm(self)).quarter_turn();
            let columns: [Xy; VARIED] = core::array::from_fn(|varied| {
                let [x, y, heading] = of_pose(varied);
                let change = point.scaled(Xy { x, y } + arm * heading);
                // The nearest place moves along the path, which does not change the distance from it.
                match passage.on {
                    On::Step { normal, .. } => Xy { x: normal.dot(change), y: 0.0 },
                    On::Start | On::End => change,
                }
            });
            [columns.map(|column| column.x), columns.map(|column| column.y)]
        };
        Ok(VariedRest { by, points: points.iter().map(of_point).collect() })
    }
}

/// Interpolates the derivative of x, y or heading within a step, by the cubic that has it and its rate of change, the derivative of the motion, at both ends.
fn between(from: &[f64; SIZE], to: &[f64; SIZE], of: usize, share: f64, duration: f64) -> f64 {
    let (start, end) = (from[of], to[of]);
    let [leaving, arriving] = [from, to].map(|state| state[of + 3] * duration);
    let left = 1.0 - share;
    let value = left * left * ((1.0 + 2.0 * share) * start + share * leaving);
    value + share * share * ((1.0 + 2.0 * left) * end - left * arriving)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::post_impact::{Area, Ground, Region, Restraint, SlidingVehicle, Wheel, Wheels};
    use alloc::vec;

    fn slides() -> Vec<Slide> {
        let wheels = Wheels {
            front_left: Wheel::LOCKED,
            front_right: Wheel::braked(0.4).steered(0.1),
            rear_left: Wheel::ROLLING,
            rear_right: Wheel { restraint: Restraint::Braked(0.2), steer: 0.0 },
        };
        let vehicle = SlidingVehicle::sedan(wheels);
        let locked = SlidingVehicle { wheels: Wheels::all(Wheel::LOCKED), ..vehicle };
        let ice = Region {
            friction: 0.3,
            grade: Xy::zero(),
            area: Area::HalfPlane { from: Xy { x: 5.0, y: 0.0 }, toward: Xy { x: 1.0, y: 0.3 } },
        };
        let with_ice = Ground { regions: vec![ice], ..Ground::uniform(0.7) };
        vec![
            Slide { vehicle, ground: Ground::uniform(0.7) },
            Slide { vehicle: locked, ground: Ground::uniform(0.7) },
            Slide { vehicle: locked, ground: with_ice.clone() },
            Slide { vehicle, ground: with_ice },
        ]
    }

    #[test]
    fn derivatives_are_difference_quotients() {
        let from = Pose { position: Xy { x: 1.0, y: 2.0 }, heading: 0.3 };
        let motion = |v: [f64; 3]| Motion { velocity: Xy { x: v[0], y: v[1] }, yaw_rate: v[2] };
        let at = [9.0, 4.0, 2.5];
        for (number, slide) in slides().into_iter().enumerate() {
            let varied = slide.varied_rest(&from, &motion(at), &[], FINE, &mut Effort::of(10_000)).expect("it comes to rest");
            for k in 0..VARIED {
                let end = |by: f64| {
                    let mut v = at;
                    let mut slide = slide.clone();
                    if k < 3 {
                        v[k] += by
                    } else {
                        slide.ground = slide.ground.times(1.0 + by)
                    }
                    let pose = slide.to_rest(&from, &motion(v)).expect("it comes to rest").pose;
                    [pose.position.x, pose.position.y, pose.heading]
                };
                // The error of the difference quotient is of order h², and of 1e-12/h.
                let h = 1e-3;
                let (more, less) = (end(h), end(-h));
                for i in 0..3 {
                    let quotient = (more[i] - less[i]) / (2.0 * h);
                    let error = (varied.by[i][k] - quotient).abs();
                    assert!(error < 2e-4 * (1.0 + quotient.abs()), "slide {number}, {i} by {k}: {} and {quotient}", varied.by[i][k]);
                }
            }
        }
    }
}
