//! A test in the CI of another simulator: each of its collisions must obey the laws of impact.
// Examples and comparisons compute as their readers do.
#![allow(clippy::disallowed_methods)]

use planar_impact::check::{Options, Record, State, Subject, check};
use planar_impact::prelude::*;

/// A body of the simulator: mass, yaw inertia, position, velocity, spin.
#[derive(Clone, Copy)]
struct Disc {
    mass: f64,
    inertia: f64,
    at: Xy,
    velocity: Xy,
    spin: f64,
}

/// The simulator: an impulse along the normal, without friction, with a restitution of ½.
fn collide(one: Disc, two: Disc, normal: Xy) -> (Disc, Disc) {
    let closing = (two.velocity - one.velocity).dot(normal);
    let impulse = normal * (1.5 * closing / (1.0 / one.mass + 1.0 / two.mass));
    (Disc { velocity: one.velocity + impulse / one.mass, ..one }, Disc { velocity: two.velocity - impulse / two.mass, ..two })
}

fn subject(before: Disc, after: Disc) -> Subject {
    let state = |disc: Disc| State { velocity: Some(disc.velocity), yaw_rate: Some(disc.spin) };
    Subject {
        mass: Some(before.mass),
        yaw_inertia: Some(before.inertia),
        center: Some(before.at),
        before: state(before),
        after: state(after),
        ..Subject::default()
    }
}

fn main() {
    for angle in [0.0_f64, 0.4, 1.9, -2.5] {
        let normal = Xy::new(angle.cos(), angle.sin());
        let one = Disc { mass: 2.0, inertia: 1.0, at: Xy::new(0.0, 0.0), velocity: normal * 3.0 + Xy::new(0.2, 0.1), spin: 0.5 };
        let two = Disc { mass: 5.0, inertia: 2.5, at: normal * 2.0, velocity: normal * -1.0, spin: -1.0 };
        let (one_after, two_after) = collide(one, two, normal);
        let record = Record {
            id: format!("discs at {angle} rad"),
            one: subject(one, one_after),
            two: subject(two, two_after),
            point: Some(normal),
            normal_angle: Some(angle),
            ..Record::default()
        };
        // Fails, with the numbers, if a law is broken or if the record lacks what a law needs.
        check(&record, &Options::default()).assert();
    }
    println!("every collision obeys the laws of impact");
}
