//! Sliding to rest, forward and inverse.

use crate::strategies::fewer;
use differential_equations::methods::ExplicitRungeKutta;
use differential_equations::ode::{ODE, solve_ode};
use differential_equations::solout::DefaultSolout;
use planar_impact::post_impact::*;
use planar_impact::*;
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::{Config, TestRunner};
use std::thread;
use std::time::Instant;

const GRAVITY: f64 = 9.80665;

fn restraints() -> impl Strategy<Value = Restraint> {
    prop_oneof![
        Just(Restraint::Rolling),
        Just(Restraint::Locked),
        (0..=10_i32).prop_map(|tenths| Restraint::Braked(f64::from(tenths) / 10.0))
    ]
}

fn wheels() -> impl Strategy<Value = Wheels<Wheel>> {
    let wheel = || (restraints(), -3..=3_i32).prop_map(|(restraint, steer)| Wheel { restraint, steer: f64::from(steer) / 20.0 });
    (wheel(), wheel(), wheel(), wheel()).prop_map(|(front_left, front_right, rear_left, rear_right)| Wheels {
        front_left,
        front_right,
        rear_left,
        rear_right,
    })
}

fn vehicle(wheels: Wheels<Wheel>) -> SlidingVehicle {
    SlidingVehicle { mass: 1400.0, yaw_inertia: 2300.0, front_axle: 1.1, rear_axle: 1.5, track: 1.5, wheels, tires: Tires::ORDINARY }
}

fn on_a_road(wheels: Wheels<Wheel>) -> Slide {
    Slide { vehicle: vehicle(wheels), ground: Ground::uniform(0.7) }
}

/// Generates velocities up to 15 m/s in either direction, and yaw rates up to 3 rad/s.
fn motions() -> impl Strategy<Value = Motion> {
    (-15..=15_i32, -15..=15_i32, -6..=6_i32)
        .prop_map(|(x, y, rate)| Motion { velocity: Xy { x: f64::from(x), y: f64::from(y) }, yaw_rate: f64::from(rate) / 2.0 })
}

/// Generates grades up to 12 % in any direction.
fn grades() -> impl Strategy<Value = Xy> {
    (-8..=8_i32, -8..=8_i32).prop_map(|(x, y)| Xy { x: f64::from(x) / 100.0, y: f64::from(y) / 100.0 })
}

/// Returns a wet lane across the path, and a square of gravel in it.
fn lane() -> Vec<Region> {
    let at = |x, y| Xy { x, y };
    vec![
        Region { friction: 0.4, grade: Xy::zero(), area: Area::HalfPlane { from: at(6.0, 0.0), toward: at(1.0, 0.2) } },
        Region { friction: 0.55, grade: Xy::zero(), area: Area::Polygon(vec![at(5.0, -3.0), at(9.0, -3.0), at(9.0, 3.0), at(5.0, 3.0)]) },
    ]
}

fn turned(point: Xy, by: f64) -> Xy {
    Heading::from_angle(by).to_ground(ForwardLeft { forward: point.x, left: point.y })
}

fn mirrored(point: Xy) -> Xy {
    Xy { x: point.x, y: -point.y }
}

fn left_is_right(wheels: Wheels<Wheel>) -> Wheels<Wheel> {
    let mirrored = |wheel: Wheel| Wheel { steer: -wheel.steer, ..wheel };
    Wheels {
        front_left: mirrored(wheels.front_right),
        front_right: mirrored(wheels.front_left),
        rear_left: mirrored(wheels.rear_right),
        rear_right: mirrored(wheels.rear_left),
    }
}

fn moved(ground: &Ground, point: impl Fn(Xy) -> Xy) -> Ground {
    let area = |area: &Area| match area {
        Area::HalfPlane { from, toward } => Area::HalfPlane { from: point(*from), toward: point(*toward) },
        Area::Polygon(corners) => Area::Polygon(corners.iter().map(|corner| point(*corner)).collect()),
    };
    let regions =
        ground.regions.iter().map(|region| Region { grade: point(region.grade), area: area(&region.area), ..region.clone() }).collect();
    Ground { regions, grade: point(ground.grade), ..ground.clone() }
}

/// Returns `true` if two end poses agree to a fraction of the distance: the integration bounds its errors by such a
/// fraction, and free wheels roll for hundreds of meters.
fn close(one: &Pose, other: &Pose, within: f64) -> bool {
    let within = within * (1.0 + other.position.length());
    (one.position - other.position).length() <= within && (one.heading - other.heading).abs() <= within
}

/// Computes the distance that a locked vehicle slides straight on, with the force of a regularized tire: ∫ √(v² + ε²) dv / (μ g).
fn locked_distance(speed: f64, friction: f64, epsilon: f64) -> f64 {
    let root = (speed * speed + epsilon * epsilon).sqrt();
    (speed * root + epsilon * epsilon * (speed / epsilon).asinh()) / (2.0 * friction * GRAVITY)
}

proptest! {
    #![proptest_config(fewer(50))]

    /// The distance is v²/(2μg), in any direction relative to the vehicle; the effect of the regularization is in
    /// closed form, below ε² (1 + ln(2v/ε))/(2μg), and vanishes with ε.
    #[test]
    fn locked_wheels_stop_in_half_the_square_over_friction(tenths in 20..=250_i32, hundredths in 20..=90_i32, degrees in -180..=180_i32, steer in -5..=5_i32) {
        let (speed, friction) = (f64::from(tenths) / 10.0, f64::from(hundredths) / 100.0);
        let exact = speed * speed / (2.0 * friction * GRAVITY);
        let mut before = f64::INFINITY;
        for epsilon in [0.04, 0.02, 0.01, 0.001] {
            let mut slide = on_a_road(Wheels::all(Wheel::LOCKED.steered(f64::from(steer) / 10.0)));
            slide.ground.friction = friction;
            slide.vehicle.tires.regularization = epsilon;
            let pose = Pose { position: Xy { x: 3.0, y: -2.0 }, heading: f64::from(degrees).to_radians() };
            let motion = Motion { velocity: turned(Xy { x: speed, y: 0.0 }, 0.3), yaw_rate: 0.0 };
            let rest = slide.to_rest(&pose, &motion).expect("it comes to rest");
            let distance = (rest.pose.position - pose.position).length();
            prop_assert!((rest.pose.heading - pose.heading).abs() < 1e-12);
            // Below five ε, the rest of the path uses the deceleration there: the error is less than the entire
            // effect of the regularization.
            let beside = epsilon * epsilon / (friction * GRAVITY);
            prop_assert!((distance - locked_distance(speed, friction, epsilon)).abs() < 2.0 * beside, "{} {}", distance, exact);
            let excess = distance - exact;
            prop_assert!(excess > -beside && excess < beside * (1.0 + (2.0 * speed / epsilon).ln()) / 2.0, "{} of {}", excess, exact);
            prop_assert!(excess.abs() < before);
            before = excess.abs() + 1e-9;
        }
    }

    #[test]
    fn the_tires_dissipate_what_there_was(wheels in wheels(), motion in motions(), is_wet in any::<bool>()) {
        let mut slide = on_a_road(wheels);
        if is_wet {
            slide.ground.regions = lane();
        }
        let rest = slide.to_rest(&Pose::default(), &motion).expect("it comes to rest");
        let energy = slide.kinetic_energy(&motion);
        prop_assert!((rest.dissipated - energy).abs() <= 1e-8 * energy, "{} of {}", rest.dissipated, energy);
        for pair in rest.path.windows(2) {
            prop_assert!(slide.kinetic_energy(&pair[1].motion) <= slide.kinetic_energy(&pair[0].motion) * (1.0 + 1e-9));
        }
    }

    /// Straight up or down a grade, in any direction and with any heading: v²/(2g(μ ± G)) over v/(g(μ ± G)).
    #[test]
    fn locked_wheels_stop_on_a_grade(tenths in 20..=250_i32, hundredths in 20..=90_i32, percent in -15..=15_i32, degrees in -180..=180_i32, heading in -3..=3_i32) {
        let (speed, friction, grade) = (f64::from(tenths) / 10.0, f64::from(hundredths) / 100.0, f64::from(percent) / 100.0);
        let along = turned(Xy { x: 1.0, y: 0.0 }, f64::from(degrees).to_radians());
        let mut slide = on_a_road(Wheels::all(Wheel::LOCKED));
        slide.ground = Ground { grade: along * grade, ..Ground::uniform(friction) };
        slide.vehicle.tires.regularization = 1e-6;
        let pose = Pose { position: Xy { x: 3.0, y: -2.0 }, heading: f64::from(heading) };
        let rest = slide.to_rest(&pose, &Motion { velocity: along * speed, yaw_rate: 0.0 }).expect("it comes to rest");
        let deceleration = GRAVITY * (friction + grade);
        let distance = speed * speed / (2.0 * deceleration);
        prop_assert!((rest.pose.position - (pose.position + along * distance)).length() < 1e-9 * distance, "{:?} {}", rest.pose, distance);
        prop_assert!((rest.time * deceleration / speed - 1.0).abs() < 1e-6 && (rest.pose.heading - pose.heading).abs() < 1e-9);
        prop_assert!((rest.distance() / distance - 1.0).abs() < 1e-9);
    }

    /// By hand: with ψ the angle of the velocity from downhill, v̇ = g (G cos ψ − μ) and v ψ̇ = −g G sin ψ, so that v sin ψ is proportional to tan(ψ/2)^(μ/G).
    #[test]
    fn locked_wheels_slide_across_a_grade(tenths in 50..=250_i32, hundredths in 30..=90_i32, percent in 3..=15_i32, degrees in 20..=170_i32) {
        let (speed, friction, grade) = (f64::from(tenths) / 10.0, f64::from(hundredths) / 100.0, f64::from(percent) / 100.0);
        let downhill = 0.8;
        let mut slide = on_a_road(Wheels::all(Wheel::LOCKED));
        slide.ground = Ground { grade: turned(Xy { x: -grade, y: 0.0 }, downhill), ..Ground::uniform(friction) };
        slide.vehicle.tires.regularization = 1e-6;
        let velocity = turned(Xy { x: speed, y: 0.0 }, downhill + f64::from(degrees).to_radians());
        let rest = slide.to_rest(&Pose::default(), &Motion { velocity, yaw_rate: 0.0 }).expect("it comes to rest");
        let invariant = |velocity: Xy| {
            let angle = turned(velocity, -downhill);
            let angle = angle.y.atan2(angle.x);
            (velocity.length() * angle.sin()).ln() - friction / grade * (angle / 2.0).tan().ln()
        };
        let first = invariant(velocity);
        for state in rest.path.iter().filter(|state| state.motion.velocity.length() > 0.1) {
            prop_assert!((invariant(state.motion.velocity) - first).abs() < 1e-9 * friction / grade, "{:?}", state);
        }
    }

    /// Or it does not come to rest.
    #[test]
    fn on_a_grade_the_tires_dissipate_the_height_too(wheels in wheels(), motion in motions(), grade in grades(), of_lane in grades()) {
        let mut slide = on_a_road(wheels);
        slide.ground.grade = grade;
        let energy = slide.kinetic_energy(&motion);
        match slide.to_rest(&Pose::default(), &motion) {
            Ok(rest) => {
                let height = slide.vehicle.mass * GRAVITY * grade.dot(rest.pose.position);
                prop_assert!((rest.dissipated + height - energy).abs() <= 1e-7 * (energy + height.abs() + 1.0), "{} {} {}", rest.dissipated, height, energy);
                prop_assert!(slide.stands(&rest.pose));
            }
            Err(NoRest::RollsBack(state)) => prop_assert!(!slide.stands(&state.pose)),
            Err(why) => prop_assert!(matches!(why, NoRest::Moves(_)), "{}", why),
        }
        slide.vehicle.wheels = Wheels::all(Wheel::braked(0.4));
        slide.ground.regions = lane();
        slide.ground.regions[0].grade = of_lane;
        match slide.to_rest(&Pose::default(), &motion) {
            Ok(rest) => prop_assert!(slide.stands(&rest.pose)),
            Err(why) => prop_assert!(matches!(why, NoRest::Moves(_)), "{}", why),
        }
    }

    /// With the entire scene rotated, moved and mirrored.
    #[test]
    fn the_end_turns_with_the_scene(wheels in wheels(), motion in motions(), degrees in -180..=180_i32, percent in 0..=2_i32) {
        let mut slide = Slide { ground: Ground { regions: lane(), ..Ground::uniform(0.7) }, ..on_a_road(wheels) };
        // Less than the rolling resistance, so that every vehicle comes to rest.
        slide.ground.grade = Xy { x: 0.004, y: -0.002 } * f64::from(percent);
        slide.ground.regions[1].grade = Xy { x: 0.0, y: 0.005 } * f64::from(percent);
        let from = Pose { position: Xy { x: 0.5, y: 1.0 }, heading: 0.4 };
        let rest = slide.to_rest(&from, &motion).expect("it comes to rest");
        let (by, along) = (f64::from(degrees).to_radians(), Xy { x: 7.0, y: -11.0 });

        // A direction is rotated but not moved.
        let mut ground = moved(&slide.ground, |point| turned(point, by));
        for region in &mut ground.regions {
            match &mut region.area {
                Area::HalfPlane { from, .. } => *from += along,
                Area::Polygon(corners) => corners.iter_mut().for_each(|corner| *corner += along),
            }
        }
        let scene = Slide { ground, ..slide.clone() };
        let start = Pose { position: turned(from.position, by) + along, heading: from.heading + by };
        let there = scene.to_rest(&start, &Motion { velocity: turned(motion.velocity, by), ..motion }).expect("it comes to rest as well");
        let expected = Pose { position: turned(rest.pose.position, by) + along, heading: rest.pose.heading + by };
        prop_assert!(close(&there.pose, &expected, 1e-5), "{:?} {:?}", there.pose, expected);

        let mirror = Slide { vehicle: vehicle(left_is_right(wheels)), ground: moved(&slide.ground, mirrored) };
        let start = Pose { position: mirrored(from.position), heading: -from.heading };
        let motion = Motion { velocity: mirrored(motion.velocity), yaw_rate: -motion.yaw_rate };
        let there = mirror.to_rest(&start, &motion).expect("it comes to rest as well");
        let expected = Pose { position: mirrored(rest.pose.position), heading: -rest.pose.heading };
        prop_assert!(close(&there.pose, &expected, 1e-5), "{:?} {:?}", there.pose, expected);
    }

    /// A common factor of mass and inertia changes nothing. If lengths are multiplied by L and speeds by √L, with the
    /// same friction, every distance is multiplied by L and the time by √L.
    #[test]
    fn the_end_scales(wheels in wheels(), motion in motions(), factor in 2..=5_i32) {
        let slide = on_a_road(wheels);
        let rest = slide.to_rest(&Pose::default(), &motion).expect("it comes to rest");
        let factor = f64::from(factor);
        let mut heavy = slide.clone();
        (heavy.vehicle.mass, heavy.vehicle.yaw_inertia) = (factor * slide.vehicle.mass, factor * slide.vehicle.yaw_inertia);
        let there = heavy.to_rest(&Pose::default(), &motion).expect("it comes to rest as well");
        prop_assert!(close(&there.pose, &rest.pose, 1e-7), "{:?} {:?}", there.pose, rest.pose);

        let mut large = slide.clone();
        let vehicle = &mut large.vehicle;
        for length in [&mut vehicle.front_axle, &mut vehicle.rear_axle, &mut vehicle.track] {
            *length *= factor;
        }
        vehicle.yaw_inertia *= factor * factor;
        vehicle.tires.regularization *= factor.sqrt();
        let motion = Motion { velocity: motion.velocity * factor.sqrt(), yaw_rate: motion.yaw_rate / factor.sqrt() };
        let there = large.to_rest(&Pose::default(), &motion).expect("it comes to rest as well");
        let expected = Pose { position: rest.pose.position * factor, heading: rest.pose.heading };
        prop_assert!(close(&there.pose, &expected, 1e-6 * factor), "{:?} {:?}", there.pose, expected);
        prop_assert!((there.time / rest.time / factor.sqrt() - 1.0).abs() < 1e-6);
    }

    /// v² = 2 g (μ₁ d₁ + μ₂ d₂) if every wheel ends on the second friction: the axles cross one at a time, so d is
    /// the mean over the axles, weighted by their loads.
    #[test]
    fn two_frictions_take_their_shares(first in 30..=90_i32, second in 30..=90_i32, tenths in 30..=120_i32, beyond in 20..=100_i32) {
        let (first, second) = (f64::from(first) / 100.0, f64::from(second) / 100.0);
        let (border, beyond) = (f64::from(tenths) / 10.0, f64::from(beyond) / 10.0);
        let mut slide = on_a_road(Wheels::all(Wheel::LOCKED));
        slide.vehicle.tires.regularization = 0.001;
        let region = Region { friction: second, grade: Xy::zero(), area: Area::HalfPlane { from: Xy { x: border, y: 0.0 }, toward: Xy { x: 1.0, y: 0.0 } } };
        slide.ground = Ground { friction: first, regions: vec![region], ..slide.ground };
        // By hand: the front axle, 1.1 m ahead, carries 1.5/2.6; the rear one, 1.5 m behind, 1.1/2.6.
        let end = border + 1.6 + beyond;
        let axle = |ahead: f64, share: f64| share * (first * (border - ahead) + second * (end + ahead - border));
        let speed = (2.0 * GRAVITY * (axle(1.1, 1.5 / 2.6) + axle(-1.5, 1.1 / 2.6))).sqrt();
        let motion = Motion { velocity: Xy { x: speed, y: 0.0 }, yaw_rate: 0.0 };
        let rest = slide.to_rest(&Pose::default(), &motion).expect("it comes to rest");
        prop_assert!((rest.pose.position.x - end).abs() < 1e-5, "{} {}", rest.pose.position.x, end);
    }

    /// The distance is v²/(2 f g), without effect of the regularization, because a rolling wheel does not slip.
    #[test]
    fn free_wheels_roll_to_a_stop(tenths in 5..=200_i32, thousandths in 5..=50_i32) {
        let (speed, resistance) = (f64::from(tenths) / 10.0, f64::from(thousandths) / 1000.0);
        let mut slide = on_a_road(Wheels::all(Wheel::ROLLING));
        slide.vehicle.tires.rolling_resistance = resistance;
        let motion = Motion { velocity: Xy { x: speed, y: 0.0 }, yaw_rate: 0.0 };
        let rest = slide.to_rest(&Pose::default(), &motion).expect("it comes to rest");
        let exact = speed * speed / (2.0 * resistance * GRAVITY);
        prop_assert!((rest.pose.position.x / exact - 1.0).abs() < 1e-9, "{} {}", rest.pose.position.x, exact);
        prop_assert!((rest.time - speed / (resistance * GRAVITY)).abs() < 1e-6);
    }

    /// The mirrored answer, or the same refusal; also for a vehicle that hardly turned or did not turn.
    #[test]
    fn the_closed_form_mirrors(wheels in wheels(), x in -20..=20_i32, y in -20..=20_i32, degrees in prop_oneof![Just(0), -20..=20_i32, -400..=400_i32]) {
        let evidence = RestEvidence {
            separation: Pose::default(),
            rest: Pose { position: Xy { x: f64::from(x), y: f64::from(y) }, heading: f64::from(degrees).to_radians() },
            position_deviation: Xy { x: 0.3, y: 0.3 },
            heading_deviation: 0.09,
            friction_deviation: 0.07,
            points: vec![],
        };
        let other_rest = Pose { position: mirrored(evidence.rest.position), heading: -evidence.rest.heading };
        let here = on_a_road(wheels).separation(&evidence, Method::ClosedForm);
        let there = on_a_road(left_is_right(wheels)).separation(&RestEvidence { rest: other_rest, ..evidence.clone() }, Method::ClosedForm);
        match (here, there) {
            (Ok(here), Ok(there)) => {
                prop_assert!((mirrored(here.motion.velocity) - there.motion.velocity).length() < 1e-9);
                prop_assert!((here.motion.yaw_rate + there.motion.yaw_rate).abs() < 1e-6, "{:?} {:?}", here, there);
                let (sds, others) = (here.covariance.deviations(), there.covariance.deviations());
                prop_assert!((0..3).all(|i| (sds[i] / others[i] - 1.0).abs() < 1e-6), "{:?} {:?}", sds, others);
                // The standard deviation stays meaningful.
                prop_assert!(sds[2] < 20.0, "{:?}", here);
            }
            (Err(here), Err(there)) => prop_assert!(std::mem::discriminant(&here) == std::mem::discriminant(&there), "{here} {there}"),
            (here, there) => prop_assert!(false, "{:?} {:?}", here, there),
        }
    }

    /// If the path satisfies its assumptions.
    #[test]
    fn the_closed_form_is_exact_for_locked_wheels_without_rotation(motion in motions()) {
        let motion = Motion { yaw_rate: 0.0, ..motion };
        let slide = on_a_road(Wheels::all(Wheel::LOCKED));
        let speed = motion.velocity.length();
        prop_assume!(speed > 1.0);
        let travel = motion.velocity * (speed / (2.0 * 0.7 * GRAVITY));
        let found = slide.closed_form(&Pose::default(), &Pose { position: travel, heading: 0.0 });
        prop_assert!((found.velocity - motion.velocity).length() < 1e-9 * speed && found.yaw_rate == 0.0, "{:?}", found);
    }
}

const ODD: [f64; 10] = [1.0, 0.5, 20.0, 0.01, 0.0, -1.0, f64::NAN, f64::INFINITY, 1e-300, 1e300];

/// Returns a slide and evidence with these numbers in place of all others.
fn numbered(wheels: Wheels<Wheel>, numbers: &[f64]) -> (Slide, Motion, RestEvidence) {
    let [mass, yaw_inertia, front_axle, rear_axle, rolling_resistance, slip_angle, regularization, friction, ref rest @ ..] = *numbers
    else {
        panic!("too few numbers")
    };
    let [x, y, yaw_rate, heading, rest_x, rest_y, rest_heading, sd_x, sd_y, heading_deviation, friction_deviation] = *rest else {
        panic!("19 numbers")
    };
    let tires = Tires { rolling_resistance, slip_angle, regularization };
    let vehicle = SlidingVehicle { mass, yaw_inertia, front_axle, rear_axle, tires, ..vehicle(wheels) };
    let evidence = RestEvidence {
        separation: Pose { heading, ..Pose::default() },
        rest: Pose { position: Xy { x: rest_x, y: rest_y }, heading: rest_heading },
        position_deviation: Xy { x: sd_x, y: sd_y },
        heading_deviation,
        friction_deviation,
        points: vec![],
    };
    let slide = Slide { vehicle, ground: Ground { regions: lane(), ..Ground::uniform(friction) } };
    (slide, Motion { velocity: Xy { x, y }, yaw_rate }, evidence)
}

/// Tests that all answers are finite or have a reason; returns `true` if there is any.
fn answers(slide: &Slide, motion: &Motion, evidence: &RestEvidence) -> Result<bool, TestCaseError> {
    let begun = std::time::Instant::now();
    let rest = slide.to_rest(&evidence.separation, motion);
    match &rest {
        Ok(Rest { pose: Pose { position, heading }, .. }) => {
            prop_assert!([position.x, position.y, *heading].into_iter().all(f64::is_finite))
        }
        Err(why) => prop_assert!(!why.to_string().is_empty()),
    }
    let separations = [Method::Slide, Method::ClosedForm].map(|method| slide.separation(evidence, method));
    for separation in &separations {
        match separation {
            Ok(found) => prop_assert!(found.motion.velocity.x.is_finite() && found.motion.yaw_rate.is_finite()),
            Err(why) => prop_assert!(!why.to_string().is_empty()),
        }
    }
    prop_assert!(begun.elapsed().as_secs() < 30);
    Ok(rest.is_ok() || separations.iter().any(Result::is_ok))
}

proptest! {
    #![proptest_config(fewer(300))]

    /// For any numbers, it terminates without a panic; most of them are refused.
    #[test]
    fn nothing_hangs_and_nothing_panics(wheels in wheels(), odd in prop::collection::vec(prop::sample::select(&ODD[..]), 19)) {
        let (slide, motion, evidence) = numbered(wheels, &odd);
        answers(&slide, &motion, &evidence)?;
        // With a valid road and separation pose, the search runs.
        answers(&on_a_road(wheels), &motion, &RestEvidence { separation: Pose::default(), ..evidence })?;
    }
}

/// The equations of motion for the crate's Runge–Kutta method with fixed steps.
struct Equations(Slide);

impl ODE<f64, [f64; 6]> for Equations {
    fn diff(&self, _: f64, y: &[f64; 6], change: &mut [f64; 6]) {
        let motion = Motion { velocity: Xy { x: y[3], y: y[4] }, yaw_rate: y[5] };
        let acceleration = self.0.acceleration(&Pose { position: Xy { x: y[0], y: y[1] }, heading: y[2] }, &motion);
        *change = [y[3], y[4], y[5], acceleration.velocity.x, acceleration.velocity.y, acceleration.yaw_rate];
    }
}

/// Half the step leaves a sixteenth of the error, on a section where no wheel comes to rest or changes from rolling to sliding.
#[test]
fn the_error_of_a_step_is_of_its_order() {
    let slide = on_a_road(Wheels::all(Wheel::LOCKED));
    let end = |steps: u32| {
        let mut method = ExplicitRungeKutta::rk4(0.5 / f64::from(steps));
        let start = [0.0, 0.0, 0.3, 14.0, 3.0, 4.0];
        let equations = Equations(slide.clone());
        let solution = solve_ode(&mut method, &equations, 0.0, 0.5, &start, &mut DefaultSolout::new()).expect("half a second");
        *solution.y.last().expect("an end")
    };
    let exact = end(2048);
    let error = |steps| end(steps).iter().zip(&exact).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    for steps in [8, 16, 32] {
        let ratio = error(steps) / error(2 * steps);
        assert!((12.0..20.0).contains(&ratio), "{steps} steps: {} and {}, {ratio}", error(steps), error(2 * steps));
    }
    // The path to rest passes through the same states.
    let motion = Motion { velocity: Xy { x: 14.0, y: 3.0 }, yaw_rate: 4.0 };
    let rest = slide.to_rest(&Pose { heading: 0.3, ..Pose::default() }, &motion).expect("it comes to rest");
    let passing = rest.path.iter().rev().find(|passing| passing.time <= 1.0).expect("it takes longer");
    let mut method = ExplicitRungeKutta::rk4(passing.time / 4096.0);
    let start = [0.0, 0.0, 0.3, 14.0, 3.0, 4.0];
    let equations = Equations(slide);
    let solution = solve_ode(&mut method, &equations, 0.0, passing.time, &start, &mut DefaultSolout::new()).expect("a second");
    let [x, y, heading, ..] = *solution.y.last().expect("an end");
    assert!(passing.time > 0.5 && close(&passing.pose, &Pose { position: Xy { x, y }, heading }, 1e-9), "{passing:?} {x} {y} {heading}");
}

proptest! {
    // An inverse takes seconds.
    #![proptest_config(Config { cases: 8, ..fewer(300) })]

    /// Of numbers that are accepted, however far from those of a vehicle.
    #[test]
    fn what_is_accepted_has_an_answer(wheels in wheels(), powers in prop::collection::vec(-1..=1_i32, 19)) {
        let usual = [1400.0, 2300.0, 1.1, 1.5, 0.015, 0.1, 0.01, 0.7, 9.0, 3.0, 1.0, 0.4, 8.0, 2.0, 1.0, 0.3, 0.3, 0.1, 0.05];
        let numbers: Vec<f64> = usual.into_iter().zip(powers).map(|(usual, power)| usual * 2_f64.powi(power)).collect();
        let (slide, motion, evidence) = numbered(wheels, &numbers);
        prop_assume!(answers(&slide, &motion, &evidence)?);
    }

    #[test]
    fn forward_and_back(wheels in wheels(), motion in motions(), grade in grades()) {
        let mut slide = on_a_road(wheels);
        slide.ground.grade = grade;
        let is_found = there_and_back(&slide, &motion)?;
        prop_assert!(is_found, "another motion was found alone");
    }
}

/// The same on a thousand cases, on a level, on a grade, or across a lane, and each within seconds. Near a fold of the motions over the poses, two that differ
/// by centimeters a second end in one pose: of these the search may find one alone.
#[ignore = "minutes in release: a thousand inverses, cargo test --release --test proptests -- --ignored --nocapture a_thousand_times"]
#[test]
fn forward_and_back_a_thousand_times() {
    /// Longest search, in s: that of the most work, on a machine of 2024 at which nothing else works.
    const LONGEST: f64 = 3.0;
    /// Largest number of cases with another motion alone.
    const OTHERS: usize = 2;
    let drawn = a_thousand_slides();
    let timed = |number: usize| {
        let (slide, motion) = &drawn[number];
        let start = Instant::now();
        let found = there_and_back(slide, motion);
        (start.elapsed().as_secs_f64(), found)
    };
    let of = |from: usize| (from..drawn.len()).step_by(2).map(|number| (number, timed(number))).collect::<Vec<_>>();
    let [even, odd] = thread::scope(|scope| {
        let odd = scope.spawn(|| of(1));
        [of(0), odd.join().expect("it does not panic")]
    });
    let all = [even, odd].concat();
    let others: Vec<usize> = all.iter().filter(|(_, (_, found))| matches!(found, Ok(false))).map(|(number, _)| *number).collect();
    // Two searches at once share the machine: one that was too long has the whole of it.
    let is_fault = |(_, (seconds, found)): &(usize, (f64, Result<bool, TestCaseError>))| found.is_err() || *seconds > LONGEST;
    let again = all.into_iter().filter(is_fault).map(|(number, _)| (number, timed(number)));
    let faults: Vec<String> =
        again.filter(is_fault).map(|(number, (seconds, found))| format!("{number}: {seconds:.1} s, {found:?}")).collect();
    assert!(faults.is_empty(), "{} of 1000:\n{}", faults.len(), faults.join("\n"));
    assert!(others.len() <= OTHERS, "another motion alone: {others:?}");
}

fn a_thousand_slides() -> Vec<(Slide, Motion)> {
    let mut runner = TestRunner::deterministic();
    let grounds = prop_oneof![grades().prop_map(|grade| (grade, vec![])), Just((Xy::zero(), lane()))];
    let cases = (wheels(), motions(), grounds);
    let mut draw = || cases.new_tree(&mut runner).expect("nothing is rejected").current();
    std::iter::repeat_with(|| {
        let (wheels, motion, (grade, regions)) = draw();
        let mut slide = on_a_road(wheels);
        (slide.ground.grade, slide.ground.regions) = (grade, regions);
        (slide, motion)
    })
    .filter(|(slide, motion)| slide.to_rest(&Pose::default(), motion).is_ok_and(|rest| ends_well(&rest)))
    .take(1000)
    .collect()
}

/// Vehicles that roll far are excluded, because the end of their path depends sensitively on every input.
fn ends_well(rest: &Rest) -> bool {
    rest.pose.position.length() > 1.0 && rest.time < 5.0
}

/// Tests that the slide from a separation that is computed from a rest position ends there, to a millionth. Returns whether the motion that led there is among
/// those found.
fn there_and_back(slide: &Slide, motion: &Motion) -> Result<bool, TestCaseError> {
    let rest = slide.to_rest(&Pose::default(), motion);
    prop_assume!(rest.is_ok());
    let Ok(rest) = rest else { return Ok(true) };
    prop_assume!(ends_well(&rest));
    let evidence = RestEvidence {
        separation: Pose::default(),
        rest: rest.pose,
        position_deviation: Xy { x: 0.3, y: 0.3 },
        heading_deviation: 0.1,
        friction_deviation: 0.05,
        points: vec![],
    };
    let found = slide.separation(&evidence, Method::Slide);
    let Ok(found) = found else { return Err(TestCaseError::fail(format!("{found:?} for {motion:?}"))) };
    let there = slide.to_rest(&Pose::default(), &found.motion).expect("it comes to rest");
    prop_assert!(close(&there.pose, &rest.pose, 1e-6), "{:?} {:?}", there.pose, rest.pose);
    let fit = found.fit.clone().expect("a fit");
    let all = fit.others.iter().map(|other| other.motion).chain([found.motion]);
    let error = all.map(|one| (one.velocity - motion.velocity).length().max((one.yaw_rate - motion.yaw_rate).abs())).fold(1e9, f64::min);
    let [x, y, rate] = found.covariance.deviations();
    Ok(error < 1e-7 * (x + y + rate).max(1.0))
}
