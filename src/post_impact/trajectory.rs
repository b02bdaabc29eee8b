//! The trajectory of a vehicle to rest: its equations of motion, integrated until it almost stands still.

use alloc::vec::Vec;

use differential_equations::control::ControlFlag;
use differential_equations::error::Error;
use differential_equations::interpolate::Interpolation;
use differential_equations::methods::ExplicitRungeKutta;
use differential_equations::ode::{ODE, solve_ode};
use differential_equations::solout::Solout;
use differential_equations::solution::Solution;
use differential_equations::traits::State;

use super::check::check_pose;
use super::issue::{NoRest, SlideIssues};
use super::slide::Slide;
use super::trajectory_state::{TIME_LIMIT, TrajectoryState};
use super::vehicle::{Pose, Standing, Wheels};
use crate::frame::Xy;
use crate::issue::Place;
use crate::measure::Measure;
use crate::scalar::Real;
use crate::vehicle::Motion;

/// The speed that counts as rest, in regularization speeds: below it the force of a sliding tire is no longer that of friction.
pub const REST_SPEED: f64 = 5.0;

/// Maximum number of steps; each takes a few microseconds.
const MOST_STEPS: usize = 30_000;
/// Longest section on a grade, in s: on level ground nothing gets faster.
const ON_A_GRADE: f64 = 1.0;
/// Half of the longest remaining time that is extrapolated, in s: a vehicle that the ground hardly brakes moves on, over ground that may be other.
const LONGEST_REMAINDER: f64 = 30.0;
/// The error of a step, relative and in m, rad, m/s and rad/s. The inverse needs the end as a smooth function of the start to about 1e-10.
const TOLERANCE: f64 = 1e-12;

/// The rest position of a vehicle and its trajectory.
#[derive(Clone, Debug, PartialEq)]
pub struct Rest {
    /// The pose at rest.
    pub pose: Pose,
    /// Time from the start to rest, in s.
    pub time: f64,
    /// Energy that its tires dissipated, in J.
    pub dissipated: f64,
    /// The last state of the integration; from it the motion is extrapolated to rest with its deceleration.
    pub last: TrajectoryState,
    /// The trajectory from the start to that state.
    pub path: Vec<TrajectoryState>,
}

impl Rest {
    /// Returns the length of the path of the center of mass, in m: the integral of its speed, by Simpson's rule over the steps of the integration.
    pub fn distance(&self) -> f64 {
        let step = |pair: &[TrajectoryState]| {
            let ([from, to], duration) = ([&pair[0], &pair[1]], pair[1].time - pair[0].time);
            if duration <= 0.0 {
                return 0.0;
            }
            let [start, end] = [from, to].map(|state| state.motion.velocity);
            // The middle of the cubic that has both places and velocities.
            let middle = (to.pose.position - from.pose.position) * (1.5 / duration) - (start + end) * 0.25;
            duration / 6.0 * (start.length() + 4.0 * middle.length() + end.length())
        };
        self.path.windows(2).map(step).sum::<f64>() + (self.pose.position - self.last.pose.position).length()
    }
}

/// A state of the equations of motion: the pose, the motion, and the energy dissipated, followed optionally by derivatives of the first six.
pub(super) trait Moving: State<f64> {
    fn passing(&self, time: f64) -> TrajectoryState {
        let [x, y, heading, vx, vy, yaw_rate] = core::array::from_fn(|i| self.get_component(i));
        let motion = Motion { velocity: Xy { x: vx, y: vy }, yaw_rate };
        TrajectoryState { time, pose: Pose { position: Xy { x, y }, heading }, motion }
    }
}

impl<const N: usize> Moving for [f64; N] {}

/// The equations of motion in the form that the integrator needs.
struct Equations<'a> {
    slide: &'a Slide,
    wheels: [Standing<f64>; 4],
}

impl ODE<f64, [f64; 7]> for Equations<'_> {
    fn diff(&self, _: f64, y: &[f64; 7], change: &mut [f64; 7]) {
        let TrajectoryState { pose, motion, .. } = y.passing(0.0);
        let drag = self.slide.drag_of(&self.wheels, &pose, &motion);
        let acceleration = self.slide.acceleration_by(&drag);
        *change = [
            motion.velocity.x,
            motion.velocity.y,
            motion.yaw_rate,
            acceleration.velocity.x,
            acceleration.velocity.y,
            acceleration.yaw_rate,
            drag.dissipation,
        ];
    }
}

impl Slide {
    /// Computes the rest position of the vehicle from a pose and a motion.
    ///
    /// The trajectory ends when 2T/m = v² + k²ω² falls to the square of [`REST_SPEED`] · ε and the ground holds the vehicle there ([`Slide::stands`]). One that
    /// rolls up a grade without brakes would roll back, and is not followed there. The remaining motion is extrapolated with its deceleration at
    /// that point: T falls with the square of the remaining time, so the vehicle continues for T/Ṫ times its velocity and yaw rate, fractions of a millimeter
    /// for a sliding vehicle.
    ///
    /// # Errors
    ///
    /// [`NoRest`]: every issue of the input, or that it does not come to rest, with its motion at the end.
    ///
    /// # Examples
    ///
    /// ```
    /// use planar_impact::post_impact::*;
    /// use planar_impact::{Motion, Xy};
    ///
    /// let vehicle = SlidingVehicle {
    ///     mass: 1500.0,
    ///     yaw_inertia: 2500.0,
    ///     front_axle: 1.2,
    ///     rear_axle: 1.5,
    ///     track: 1.5,
    ///     wheels: Wheels::all(Wheel::LOCKED),
    ///     tires: Tires::ORDINARY,
    /// };
    /// let slide = Slide { vehicle, ground: Ground::uniform(0.7) };
    /// let motion = Motion { velocity: Xy { x: 20.0, y: 0.0 }, yaw_rate: 0.0 };
    /// let rest = slide.to_rest(&Pose::default(), &motion)?;
    /// let distance = 20.0 * 20.0 / (2.0 * 0.7 * 9.80665); // v²/(2μg)
    /// assert!((rest.pose.position.x / distance - 1.0).abs() < 1e-5);
    /// # Ok::<(), NoRest>(())
    /// ```
    pub fn to_rest(&self, from: &Pose, motion: &Motion) -> Result<Rest, NoRest> {
        self.to_rest_within(from, motion, &mut Effort::of(MOST_STEPS))
    }

    /// As [`Slide::to_rest`], with a limited number of steps.
    pub(super) fn to_rest_within(&self, from: &Pose, motion: &Motion, effort: &mut Effort) -> Result<Rest, NoRest> {
        self.check_start(from, motion).map_err(NoRest::Refused)?;
        let start = [from.position.x, from.position.y, from.heading, motion.velocity.x, motion.velocity.y, motion.yaw_rate, 0.0];
        let end = follow(self, &Equations { slide: self, wheels: self.standing() }, start, TOLERANCE, effort)?;
        let last = end.state.passing(end.time);
        let rest = self.stand_still(&last)?;
        let left = self.time_left(&last).unwrap_or(0.0);
        // What is left of the energy goes into the tires, but for what goes into height.
        let remaining = self.kinetic_energy(&last.motion) - left * self.drag(&last.pose, &last.motion).climb;
        let mut path = end.trajectory();
        path.push(last);
        Ok(Rest { pose: rest, time: last.time + 2.0 * left, dissipated: end.state[6] + remaining, last, path })
    }

    /// Returns the pose at rest from the last state of the integration.
    pub(super) fn stand_still(&self, last: &TrajectoryState) -> Result<Pose, NoRest> {
        match self.time_left(last) {
            Some(_) => Ok(self.after_remainder(&last.pose, &last.motion)),
            // A vehicle at rest stays there, with or without friction; on a grade, one that the ground holds.
            None if last.motion == Motion::rest() || !self.ground.is_level() => Ok(last.pose),
            None => Err(NoRest::Moves(*last)),
        }
    }

    /// Returns half of the remaining time of the motion, in s; `None` if its energy does not fall, as that of a vehicle at rest.
    fn time_left(&self, last: &TrajectoryState) -> Option<f64> {
        let left = self.remainder(&last.pose, &last.motion);
        (last.motion != Motion::rest() && (0.0..=LONGEST_REMAINDER).contains(&left)).then_some(left)
    }
}

impl<T: Real<Mask = bool>> Slide<T> {
    /// Returns T/Ṫ, half of the remaining time of the motion, in s.
    fn remainder(&self, pose: &Pose<T>, motion: &Motion<T>) -> T {
        let drag = self.drag(pose, motion);
        self.kinetic_energy(motion) / (drag.dissipation + drag.climb)
    }

    /// Returns the pose in which the motion ends.
    pub(super) fn after_remainder(&self, pose: &Pose<T>, motion: &Motion<T>) -> Pose<T> {
        let left = self.remainder(pose, motion);
        Pose {
            position: pose.position.clone() + motion.velocity.clone() * left.clone(),
            heading: pose.heading.clone() + motion.yaw_rate.clone() * left,
        }
    }

    /// Returns v² + k²ω² less the square of the speed that counts as rest, which falls through zero at rest.
    pub(super) fn above_rest(&self, motion: &Motion<T>, rest_speed: T) -> T {
        T::int(2) * self.kinetic_energy(motion) / self.vehicle.mass.clone() - rest_speed.squared()
    }
}

/// The end of the integration.
pub(super) struct End<Y> {
    pub time: f64,
    pub state: Y,
    /// The states before it, with their times.
    pub path: Vec<(f64, Y)>,
}

impl<Y: Moving> End<Y> {
    /// Returns pose and motion of the states before it.
    pub(super) fn trajectory(&self) -> Vec<TrajectoryState> {
        self.path.iter().map(|(time, state)| state.passing(*time)).collect()
    }
}

/// The number of steps of an integration: the most that it may take, and those taken.
pub(super) struct Effort {
    most: usize,
    pub taken: usize,
}

impl Effort {
    pub(super) fn of(most: usize) -> Self {
        Effort { most, taken: 0 }
    }

    fn left(&self) -> usize {
        self.most.saturating_sub(self.taken)
    }
}

/// Integrates equations of motion from a state until it counts as rest, each step within a tolerance.
pub(super) fn follow<Y: Moving>(
    slide: &Slide,
    equations: &impl ODE<f64, Y>,
    start: Y,
    tolerance: f64,
    effort: &mut Effort,
) -> Result<End<Y>, NoRest> {
    let mut watch = Watch { slide, path: Vec::new(), end: None, effort };
    let from = start.passing(0.0);
    if slide.is_at_rest(&from.motion) {
        if !slide.stands(&from.pose) {
            return Err(NoRest::RollsBack(from));
        }
        return Ok(End { time: 0.0, state: start, path: Vec::new() });
    }
    watch.path.push((0.0, start.clone()));
    let (mut time, mut state) = (0.0, start);
    loop {
        let Section { duration, step } = slide.section(&state.passing(time));
        let until = (time + duration).min(TIME_LIMIT);
        let mut method = ExplicitRungeKutta::dop853().rtol(tolerance).atol(tolerance).h_max(step).max_steps(watch.effort.left());
        (time, state) = match solve_ode(&mut method, equations, time, until, &state, &mut watch) {
            // The integrator reports stiffness for a wheel that rolls slowly: short steps suffice.
            Err(Error::Stiffness { t, y }) if t > time && watch.effort.left() > 0 => (t, y),
            Err(Error::MaxSteps { t, y } | Error::StepSize { t, y } | Error::Stiffness { t, y }) => {
                return Err(NoRest::NotFollowed(y.passing(t)));
            }
            Err(_) => return Err(NoRest::NotFollowed(state.passing(time))),
            Ok(solution) => match solution.t.last().copied().zip(solution.y.last().cloned()) {
                Some(last) => last,
                None => return Err(NoRest::NotFollowed(state.passing(time))),
            },
        };
        if let Some((time, state)) = watch.end {
            let end = state.passing(time);
            return if slide.stands(&end.pose) { Ok(End { time, state, path: watch.path }) } else { Err(NoRest::RollsBack(end)) };
        }
        if time >= TIME_LIMIT {
            return Err(NoRest::Moves(state.passing(time)));
        }
    }
}

/// A part of the way that is integrated in one go, and the longest step in it, both in s.
struct Section {
    duration: f64,
    step: f64,
}

impl Slide {
    pub(super) fn rest_speed(&self) -> f64 {
        REST_SPEED * self.vehicle.tires.regularization
    }

    pub(super) fn is_at_rest(&self, motion: &Motion) -> bool {
        self.above_rest(motion, self.rest_speed()) <= 0.0
    }

    /// Returns the time in which no wheel can come to a border, or near one a time with steps that cannot jump over it.
    fn section(&self, from: &TrajectoryState) -> Section {
        if self.ground.regions.is_empty() {
            return Section { duration: TIME_LIMIT, step: TIME_LIMIT };
        }
        let (ground, vehicle) = (&self.ground, &self.vehicle);
        let (longest, gained) = match ground.steepest() {
            0.0 => (TIME_LIMIT, 0.0),
            steepest => (ON_A_GRADE, steepest * ground.gravity * ON_A_GRADE),
        };
        // |v| + r |ω| is greatest, for an energy, at √(1 + r²/k²) times √(v² + k²ω²): the tires may turn one into the other.
        let arm = libm::hypot(vehicle.front_axle.max(vehicle.rear_axle), vehicle.track / 2.0);
        let moves = (2.0 * self.kinetic_energy(&from.motion) / vehicle.mass).sqrt() + gained;
        let fastest = moves * (1.0 + arm * arm * vehicle.mass / vehicle.yaw_inertia).sqrt();
        let step = (ground.contact_length / fastest).clamp(1e-4, longest);
        let Wheels { front_left, front_right, rear_left, rear_right } =
            vehicle.wheel_places(&from.pose).map(|place| ground.distance_to_border(&place));
        let nearest = front_left.min(front_right).min(rear_left).min(rear_right);
        let clear = (nearest - ground.contact_length / 2.0) / fastest;
        if clear > step { Section { duration: clear.min(longest), step: longest } } else { Section { duration: 2.0 * step, step } }
    }
}

/// Checks after each step whether the vehicle is at rest.
struct Watch<'a, Y> {
    slide: &'a Slide,
    path: Vec<(f64, Y)>,
    end: Option<(f64, Y)>,
    effort: &'a mut Effort,
}

impl<Y: Moving> Solout<f64, Y> for Watch<'_, Y> {
    fn solout<I>(
        &mut self,
        time: f64,
        time_before: f64,
        state: &Y,
        _: &Y,
        between: &mut I,
        solution: &mut Solution<f64, Y>,
    ) -> ControlFlag<f64, Y>
    where
        I: Interpolation<f64, Y> + ?Sized,
    {
        // Only the last state is needed.
        (solution.t, solution.y) = (alloc::vec![time], alloc::vec![state.clone()]);
        if time <= time_before {
            return ControlFlag::Continue;
        }
        self.effort.taken += 1;
        let now = state.passing(time);
        if !self.slide.is_at_rest(&now.motion) {
            self.path.push((time, state.clone()));
            return ControlFlag::Continue;
        }
        // Bisection of the step finds the instant to the last bit, and cannot leave the step.
        let (mut moving, mut resting) = (time_before, (time, state.clone()));
        for _ in 0..60 {
            let middle = f64::midpoint(moving, resting.0);
            match between.interpolate(middle) {
                Ok(state) if self.slide.is_at_rest(&state.passing(middle).motion) => resting = (middle, state),
                Ok(_) => moving = middle,
                Err(_) => break,
            }
        }
        self.end = Some(resting);
        ControlFlag::Terminate
    }
}

impl Slide {
    fn check_start(&self, from: &Pose, motion: &Motion) -> Result<(), SlideIssues> {
        let mut issues = self.issues();
        check_pose(&mut issues, ["start.position.x", "start.position.y", "start.heading"], from);
        issues.finite(Place::of("start.velocity.x", Measure::Speed), &motion.velocity.x);
        issues.finite(Place::of("start.velocity.y", Measure::Speed), &motion.velocity.y);
        issues.finite(Place::of("start.yaw_rate", Measure::YawRate), &motion.yaw_rate);
        issues.finish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::post_impact::{Area, Ground, Region, SlidingVehicle, Tires, Wheel, Wheels};

    #[test]
    fn a_motion_that_hardly_anything_slows_has_no_end() {
        let vehicle = SlidingVehicle {
            mass: 1500.0,
            yaw_inertia: 2400.0,
            front_axle: 1.15,
            rear_axle: 1.5,
            track: 1.5,
            wheels: Wheels::all(Wheel::ROLLING),
            tires: Tires::ORDINARY,
        };
        let slide = Slide { vehicle, ground: Ground::uniform(0.7) };
        let rolls =
            TrajectoryState { time: 0.0, pose: Pose::default(), motion: Motion { velocity: Xy { x: 20.0, y: 0.0 }, yaw_rate: 0.0 } };
        assert!(matches!(slide.stand_still(&rolls), Err(NoRest::Moves(_))));
        let stands = TrajectoryState { motion: Motion::rest(), ..rolls };
        assert!(slide.stand_still(&stands).is_ok_and(|pose| pose == stands.pose));
    }

    /// Compares with a separate implementation of the tire formulas and a fourth-order Runge–Kutta method with steps of 0.05 ms, which agrees with a step of
    /// 0.2 ms to 1e-7.
    #[test]
    fn a_slide_computed_apart_comes_to_the_same_rest() {
        let sedan = SlidingVehicle {
            mass: 1500.0,
            yaw_inertia: 2400.0,
            front_axle: 1.15,
            rear_axle: 1.5,
            track: 1.5,
            wheels: Wheels { front_left: Wheel::LOCKED, front_right: Wheel::braked(0.3), ..Wheels::all(Wheel::ROLLING) },
            tires: Tires::ORDINARY,
        };
        let steer = 4.0_f64.to_radians();
        let wagon = SlidingVehicle {
            mass: 1900.0,
            yaw_inertia: 3300.0,
            front_axle: 1.3,
            rear_axle: 1.5,
            track: 1.52,
            wheels: Wheels {
                front_left: Wheel::ROLLING.steered(steer),
                front_right: Wheel::LOCKED.steered(steer),
                ..Wheels::all(Wheel::braked(0.2))
            },
            tires: Tires::ORDINARY,
        };
        let at = |x, y, heading| Pose { position: Xy { x, y }, heading };
        let moves = |x, y, yaw_rate| Motion { velocity: Xy { x, y }, yaw_rate };
        let rests = [
            (sedan, at(0.0, 0.0, 3.0), moves(-12.0, 2.5, -4.0), at(-14.802396733, 4.853191419, -2.010057741), 2.836_24),
            (wagon, at(2.0, -1.2, 1.8), moves(-7.0, 8.5, 3.5), at(-6.462320654, 7.433442349, 4.800244274), 2.255_05),
        ];
        for (vehicle, from, motion, end, time) in rests {
            let slide = Slide { vehicle, ground: Ground::uniform(0.7) };
            let rest = slide.to_rest(&from, &motion).expect("it comes to rest");
            assert!((rest.pose.position - end.position).length() < 1e-7, "{rest:?}");
            assert!((rest.pose.heading - end.heading).abs() < 1e-7 && (rest.time - time).abs() < 1e-4, "{rest:?}");
        }
    }

    #[test]
    fn what_hardly_moves_is_at_rest_where_its_friction_stops_it() {
        let vehicle = SlidingVehicle::sedan(Wheels::all(Wheel::ROLLING));
        let slide = Slide { vehicle, ground: Ground::uniform(0.7) };
        let motion = Motion { velocity: Xy { x: 0.04, y: 0.0 }, yaw_rate: 0.0 };
        let rest = slide.to_rest(&Pose::default(), &motion).expect("it comes to rest");
        assert!((rest.pose.position.x / (0.04 * 0.04 / (2.0 * 0.015 * 9.80665)) - 1.0).abs() < 1e-9, "{rest:?}");
        let still = slide.to_rest(&Pose::default(), &Motion::rest()).expect("it is at rest");
        assert_eq!((still.pose, still.time), (Pose::default(), 0.0));
    }

    /// Ice 3 cm wide, straight across the path or beside a vehicle that rotates on the spot: compared with steps of 0.2 ms.
    #[test]
    fn no_step_jumps_over_a_narrow_region() {
        let strip = |from: Xy, toward: Xy| {
            let half_plane = |friction, from| Region { friction, grade: Xy::zero(), area: Area::HalfPlane { from, toward } };
            alloc::vec![half_plane(0.0, from), half_plane(0.7, from + toward * 0.03)]
        };
        let across = strip(Xy { x: 10.0, y: 0.0 }, Xy { x: 1.0, y: 0.0 });
        let beside = strip(Xy { x: 0.0, y: 1.3 }, Xy { x: 0.0, y: 1.0 });
        for (regions, velocity, yaw_rate) in [(across, Xy { x: 15.0, y: 0.0 }, 0.0), (beside, Xy { x: 0.0, y: 0.0 }, 9.0)] {
            let vehicle = SlidingVehicle::sedan(Wheels::all(Wheel::LOCKED));
            let slide = Slide { vehicle, ground: Ground { regions, contact_length: 0.01, ..Ground::uniform(0.7) } };
            let (mut pose, mut motion) = (Pose::default(), Motion { velocity, yaw_rate });
            let rest = slide.to_rest(&pose, &motion).expect("it comes to rest").pose;
            let moved = |pose: &Pose, motion: &Motion, by: f64| Pose {
                position: pose.position + motion.velocity * by,
                heading: pose.heading + motion.yaw_rate * by,
            };
            let faster = |motion: &Motion, by: &Motion, time: f64| Motion {
                velocity: motion.velocity + by.velocity * time,
                yaw_rate: motion.yaw_rate + by.yaw_rate * time,
            };
            while !slide.is_at_rest(&motion) {
                let middle = faster(&motion, &slide.acceleration(&pose, &motion), 1e-4);
                let change = slide.acceleration(&moved(&pose, &motion, 1e-4), &middle);
                (pose, motion) = (moved(&pose, &middle, 2e-4), faster(&motion, &change, 2e-4));
            }
            let off = (rest.position - pose.position).length() + (rest.heading - pose.heading).abs();
            assert!(off < 1e-3, "{rest:?} {pose:?}");
        }
    }

    #[test]
    fn what_stands_stays_and_what_the_grade_takes_rolls_back_at_once() {
        let on_a_grade = |wheels, grade| {
            let ground = Ground { grade: Xy { x: grade, y: 0.0 }, ..Ground::uniform(0.7) };
            Slide { vehicle: SlidingVehicle::sedan(wheels), ground }.to_rest(&Pose::default(), &Motion::rest())
        };
        let rest = on_a_grade(Wheels::all(Wheel::LOCKED), 0.05).expect("it stands");
        assert_eq!((rest.time, rest.pose, rest.distance()), (0.0, Pose::default(), 0.0));
        let rolls = on_a_grade(Wheels::all(Wheel::ROLLING), 0.05);
        assert!(matches!(rolls, Err(NoRest::RollsBack(state)) if state.time == 0.0), "{rolls:?}");
    }
}
