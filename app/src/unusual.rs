//! Warnings of sizes that no road vehicle has: most often of a number in another unit.

use std::ops::RangeInclusive;

use planar_impact::ImpulseRatio;
use planar_impact::crash3::Surface;
use planar_impact::crush::ForceLine;

use crate::case::{CrushInputs, Size, Velocity};
use crate::message::Message;
use crate::notice::Notice;
use crate::units::Measure;

/// From a motorcycle to the heaviest road trains, in kg.
const MASS: RangeInclusive<f64> = 100.0..=250e3;
/// A vehicle that is heavier represents a barrier, in kg.
const AS_BARRIER: f64 = 1e7;
/// Cars to trucks have 0.9 to 2.5 m.
const RADIUS_OF_GYRATION: RangeInclusive<f64> = 0.5..=5.0;
/// From its center of mass no point of a vehicle is farther, in m.
const ARM: f64 = 15.0;
/// In m/s.
const SPEED: f64 = 100.0;
/// Of a car against a barrier, in m/s: the fastest tests have 25.
const TEST_SPEED: f64 = 35.0;
/// In rad/s: three turns a second.
const YAW_RATE: f64 = 20.0;
/// Impacts last a tenth of a second, in s.
const DURATION: RangeInclusive<f64> = 1e-3..=5.0;
/// The front of a car is about a meter long.
const DEPTH: f64 = 2.0;
/// The side of a bus is twelve meters long.
const WIDTH: RangeInclusive<f64> = 0.01..=15.0;
/// Of two vehicles that slide along each other.
const FRICTION: f64 = 3.0;
/// Of tires on a ground: those of race cars have 1.5.
const FRICTION_OF_TIRES: f64 = 1.5;
/// In N/m: those of cars are 5 to 100 kN/m.
const ONSET: RangeInclusive<f64> = 1e3..=4e5;
/// In N/m²: those of cars are 0.2 to 2 MPa.
const STIFFNESS: RangeInclusive<f64> = 1e4..=1e7;
/// Front wheels turn by 50° at most, in rad.
const STEER: f64 = 1.2;

/// Of the Earth, in m/s², with a margin.
const GRAVITY: RangeInclusive<f64> = 9.7..=9.9;
/// The lengths that a vehicle has on a plan, in m, by their keys.
const LENGTHS: [(&str, RangeInclusive<f64>); 6] = [
    ("length", 0.5..=30.0),
    ("width", 0.3..=5.0),
    ("front_overhang", 0.0..=5.0),
    ("front_axle", 0.5..=8.0),
    ("rear_axle", 0.5..=8.0),
    ("track", 0.8..=3.0),
];

fn warning(code: &'static str, path: &str, message: Message) -> Notice {
    Notice::warning(code, path, Message::from(format!("{path}: ")).join(message))
}

/// Of the mass, the radius of gyration and the distance of the impact center of a vehicle.
pub(crate) fn vehicle(path: &str, mass: f64, radius: f64, arm: f64) -> [Option<Notice>; 3] {
    [self::mass(path, mass), radius_of_gyration(path, radius), self::arm(path, arm)]
}

/// Of the speed and the yaw rate of a vehicle.
pub(crate) fn motion(path: &str, speed: f64, yaw_rate: f64) -> [Option<Notice>; 2] {
    [self::speed(path, speed), self::yaw_rate(path, yaw_rate)]
}

/// Of all of these.
pub(crate) fn sizes(
    path: &str,
    mass: f64,
    yaw_inertia: f64,
    velocity: Velocity,
    yaw_rate: f64,
    arm: f64,
) -> impl Iterator<Item = Notice> + use<> {
    let speed = match velocity {
        Velocity::Speed(speed) => speed,
        Velocity::Components(velocity) => velocity.length(),
    };
    let of_vehicle = vehicle(path, mass, (yaw_inertia / mass).sqrt(), arm);
    of_vehicle.into_iter().chain(motion(path, speed, yaw_rate)).flatten()
}

pub(crate) fn mass(path: &str, mass: f64) -> Option<Notice> {
    (!MASS.contains(&mass) && mass < AS_BARRIER).then(|| none_has("unusual-mass", path, "a mass", Measure::Mass, mass))
}

fn radius_of_gyration(path: &str, radius: f64) -> Option<Notice> {
    let message =
        || Message::from("a radius of gyration of ").figure(Measure::Length, radius).text(" is unusual; check mass and yaw inertia");
    (!RADIUS_OF_GYRATION.contains(&radius)).then(|| warning("unusual-radius-of-gyration", path, message()))
}

fn arm(path: &str, arm: f64) -> Option<Notice> {
    (arm > ARM).then(|| none_has("unusual-impact-center", path, "an impact center at a distance", Measure::Length, arm))
}

pub(crate) fn gravity(path: &str, gravity: f64) -> Option<Notice> {
    let message = || Message::from("").figure(Measure::Acceleration, gravity).text(" is not the gravity of the Earth; check its unit");
    (!GRAVITY.contains(&gravity)).then(|| warning("unusual-gravity", path, message()))
}

/// Of a length on the plan of a vehicle, at a path that ends with its key.
pub(crate) fn length(path: &str, length: f64) -> Option<Notice> {
    let message = || Message::from("").figure(Measure::Length, length).text(" is not that of a road vehicle; check its unit");
    let of_key = LENGTHS.iter().find(|(key, _)| path.rsplit('.').next() == Some(*key));
    of_key.filter(|(_, range)| !range.contains(&length)).map(|_| warning("unusual-length", path, message()))
}

/// Of a vehicle wider than long, and of an impact center outside of it, as far as the file has its size. Its center of mass lies near the middle of its width.
pub(crate) fn plan(path: &str, size: &Size, [forward, left]: [f64; 2]) -> Vec<Notice> {
    /// Of the center of mass from either side, as a share of the width.
    const TO_A_SIDE: f64 = 0.75;
    let lengths = |one: &str, a: f64, other: &str, b: f64| {
        Message::from(one.to_owned()).figure(Measure::Length, a).text(other.to_owned()).figure(Measure::Length, b)
    };
    let usual = |key: &str, of: Option<f64>| of.filter(|size| length(key, *size).is_none());
    let (length, width) = (usual("length", size.length), usual("width", size.width));
    let wide = width.zip(length).filter(|(width, length)| width > length).map(|(width, length)| {
        warning("unusual-length", path, lengths("it is ", width, " wide, and only ", length).text(" long; are the two exchanged?"))
    });
    let ahead = length.filter(|length| forward.abs() > *length).map(|length| {
        let message = lengths("an impact center ", forward.abs(), " from the center of mass is outside of a vehicle of ", length);
        warning("unusual-impact-center", path, message.text(" length"))
    });
    let beside = width.filter(|width| left.abs() > TO_A_SIDE * width).map(|width| {
        let message = lengths("an impact center ", left.abs(), " beside the center of mass is outside of a vehicle of ", width);
        warning("unusual-impact-center", path, message.text(" width"))
    });
    [wide, ahead, beside].into_iter().flatten().collect()
}

/// Of axles that are farther from each other than the vehicle is long.
pub(crate) fn wheelbase(path: &str, wheelbase: f64, size: &Size) -> Option<Notice> {
    let message = |length| {
        Message::from("the axles are ")
            .figure(Measure::Length, wheelbase)
            .text(" apart, and the vehicle is ")
            .figure(Measure::Length, length)
            .text(" long; each counts from the center of mass")
    };
    size.length.filter(|length| wheelbase > *length).map(|length| warning("unusual-length", path, message(length)))
}

pub(crate) fn speed(path: &str, speed: f64) -> Option<Notice> {
    (speed.abs() > SPEED).then(|| none_has("unusual-speed", path, "a speed", Measure::Speed, speed.abs()))
}

/// Of the speed of a barrier test.
pub(crate) fn test_speed(path: &str, speed: f64) -> Option<Notice> {
    let message = || Message::from("no barrier test has a speed of ").figure(Measure::Speed, speed).text("; check its unit");
    (speed > TEST_SPEED).then(|| warning("unusual-speed", path, message()))
}

fn yaw_rate(path: &str, rate: f64) -> Option<Notice> {
    (rate.abs() > YAW_RATE).then(|| none_has("unusual-yaw-rate", path, "a yaw rate", Measure::YawRate, rate.abs()))
}

fn none_has(code: &'static str, path: &str, what: &str, measure: Measure, size: f64) -> Notice {
    let message = Message::from(format!("no road vehicle has {what} of ")).figure(measure, size).text("; check its unit");
    warning(code, path, message)
}

/// Of the friction between two vehicles, if the impulse ratio has one.
pub(crate) fn friction(ratio: &ImpulseRatio) -> Option<Notice> {
    let ImpulseRatio::LimitedByFriction(friction) = *ratio else { return None };
    let message = || {
        Message::from("a friction of ")
            .figure(Measure::Ratio, friction)
            .text(" limits nothing that two vehicles do; a share of 1 is expected, and a percentage needs its sign")
    };
    (friction > FRICTION).then(|| Notice::warning("unusual-friction", "contact.friction", message()))
}

/// Of a ratio of measured impulses.
pub(crate) fn impulse_ratio(path: &str, ratio: f64) -> Option<Notice> {
    let message = || {
        Message::from("no friction makes an impulse ratio of ")
            .figure(Measure::Ratio, ratio)
            .text("; check the units and calibrations of the channels")
    };
    (ratio.abs() > FRICTION).then(|| Notice::warning("unusual-friction", path, message()))
}

/// Of the friction between tires and ground.
pub(crate) fn friction_of_tires(path: &str, friction: f64) -> Option<Notice> {
    let message = || Message::from("no tire has a friction of ").figure(Measure::Ratio, friction).text("; a share of 1 is expected");
    (friction > FRICTION_OF_TIRES).then(|| warning("unusual-friction", path, message()))
}

/// Of the angle of a wheel to the vehicle.
pub(crate) fn steer(path: &str, angle: f64) -> Option<Notice> {
    let message = || Message::from("no wheel turns by ").figure(Measure::Angle, angle).text("; check its unit");
    (angle.abs() > STEER).then(|| warning("unusual-steer", path, message()))
}

/// Of a crush that is wider than the surface that it lies on, as far as the file has both.
pub(crate) fn crush(path: &str, crush: &CrushInputs, size: &Size) -> Option<Notice> {
    /// Room for what is measured beyond the edges, as a share.
    const ROOM: f64 = 1.1;
    let (of_surface, what) = match crush.surface? {
        Surface::Front | Surface::Rear => (size.width?, "width"),
        Surface::Right | Surface::Left => (size.length?, "length"),
    };
    let width = crush.on_scalar(|_| 0.0).profile.width();
    let message = || {
        Message::from("it is ")
            .figure(Measure::Length, width)
            .text(format!(" wide, and the {what} of the vehicle is "))
            .figure(Measure::Length, of_surface)
            .text("; its energy grows with its width")
    };
    (width > ROOM * of_surface).then(|| warning("wider-than-vehicle", path, message()))
}

/// Of the depths, the width and the stiffness of a crush.
pub(crate) fn sizes_of_crush(path: &str, inputs: &CrushInputs) -> impl Iterator<Item = Notice> + use<> {
    let crush = inputs.on_scalar(|_| 0.0);
    let deepest = crush.profile.depths().iter().copied().reduce(f64::max);
    let stiffness = || {
        let mut lines = crush.zones.zones().iter().map(|zone| ForceLine::from(*zone));
        lines.find_map(|line| self::stiffness(&format!("{path}.stiffness"), line))
    };
    let of_profile = deepest.map(|deepest| [depth(&format!("{path}.depths"), deepest), width(path, crush.profile.width())]);
    let of_stiffness = deepest.filter(|deepest| *deepest != 0.0).and_then(|_| stiffness());
    of_profile.into_iter().flatten().chain([of_stiffness]).flatten()
}

/// Of the greatest depth of a crush.
pub(crate) fn depth(path: &str, deepest: f64) -> Option<Notice> {
    let message = || Message::from("").figure(Measure::Length, deepest).text(" is deeper than the structure of a car; check the unit");
    (deepest > DEPTH).then(|| warning("unusual-depth", path, message()))
}

pub(crate) fn width(path: &str, width: f64) -> Option<Notice> {
    let message = || Message::from("a width of ").figure(Measure::Length, width).text(" is not that of a crush; check the unit");
    (!WIDTH.contains(&width)).then(|| warning("unusual-width", path, message()))
}

/// Of the force per width at the onset of crush, and of its growth with depth; zero is none of either.
pub(crate) fn stiffness(path: &str, line: ForceLine) -> Option<Notice> {
    let of = [("B", Measure::ForcePerArea, line.slope, STIFFNESS), ("A", Measure::ForcePerWidth, line.onset, ONSET)];
    of.into_iter().find_map(|(name, measure, value, usual)| {
        let message =
            || Message::from(format!("{name} = ")).figure(measure, value).text(" is not the stiffness of a vehicle; check the unit");
        (value > 0.0 && !usual.contains(&value)).then(|| warning("unusual-stiffness", path, message()))
    })
}

/// Of what is recorded over a time; nothing is known of it if the time is zero.
pub(crate) fn duration(path: &str, what: String, duration: f64) -> Option<Notice> {
    let message =
        || Message::from(what).text(" ").figure(Measure::Time, duration).text(", which no impact lasts: check the unit of the times");
    (duration > 0.0 && !DURATION.contains(&duration)).then(|| Notice::warning("implausible-size", path, message()))
}
