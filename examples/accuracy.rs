//! Measures the error of each output against exact rational arithmetic, by condition, and prints `docs/accuracy.md`:
//!
//! ```sh
//! cargo run --release --example accuracy > docs/accuracy.md
//! ```
// Examples and comparisons compute as their readers do.
#![allow(clippy::disallowed_methods)]

#[path = "../proptests/rational.rs"]
#[allow(dead_code)]
mod rational;

use planar_impact::{Collision, CrushPlane, ForwardLeft, Heading, Impact, ImpulseRatio, Motion, Party, Vehicle, Xy};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rational::Rational;

/// Number of collisions that are solved for each condition.
const COUNT: usize = 10_000;

/// Outputs that are measured, and what their error is a share of.
const MEASURED: [&str; 8] = [
    "V, of the greatest speed",
    "Ω, of the greatest yaw rate",
    "ΔV, of itself",
    "P_n, of itself",
    "P_t, of P",
    "T_L, of itself",
    "T_L, of T",
    "μ₀, of itself or 1",
];

struct Domain {
    name: &'static str,
    draw: fn(&mut ChaCha8Rng) -> Collision,
}

fn log_uniform(random: &mut ChaCha8Rng, low: f64, high: f64) -> f64 {
    (random.random_range(low.ln()..high.ln())).exp()
}

fn vehicle(random: &mut ChaCha8Rng, facing: f64) -> Vehicle {
    let mass = random.random_range(800.0..20_000.0);
    let heading = Heading::from_angle(facing + random.random_range(-1.0..1.0));
    Vehicle {
        mass,
        yaw_inertia: mass * random.random_range(1.0..4.0),
        heading,
        impact_center: ForwardLeft { forward: random.random_range(-1.0..2.5), left: random.random_range(-1.0..1.0) },
        motion: Motion {
            velocity: heading.to_ground(ForwardLeft { forward: random.random_range(0.0..35.0), left: 0.0 }),
            yaw_rate: random.random_range(-0.5..0.5),
        },
    }
}

fn vehicles(random: &mut ChaCha8Rng) -> Collision {
    let facing = random.random_range(-3.0..3.0);
    let one = vehicle(random, facing);
    let two = vehicle(random, facing + std::f64::consts::PI);
    Collision::new(one, two)
        .with_crush_plane(CrushPlane::from_angle(facing + random.random_range(-0.5..0.5)))
        .with_restitution(random.random_range(0.0..0.4))
        .with_impulse_ratio(match random.random_range(0..3) {
            0 => ImpulseRatio::Critical,
            1 => ImpulseRatio::OfCritical(random.random_range(0.0..1.0)),
            _ => ImpulseRatio::LimitedByFriction(random.random_range(0.0..1.0)),
        })
}

/// Moves the velocity of vehicle 2 so that the normal approach is nearly nothing.
fn near_separation(random: &mut ChaCha8Rng) -> Collision {
    let collision = vehicles(random);
    let approach = collision.evaluate().approach.n;
    let share = 1.0 - log_uniform(random, 1e-9, 1e-3);
    let less = collision.crush_plane.to_ground(planar_impact::Nt { n: share * approach, t: 0.0 });
    let Party::Vehicle(two) = collision.two else { return collision };
    let velocity = Xy { x: two.motion.velocity.x - less.x, y: two.motion.velocity.y - less.y };
    Collision { two: Vehicle { motion: Motion { velocity, ..two.motion }, ..two }.into(), ..collision }
}

/// Sticking, with an approach along the arm of a vehicle that almost only turns: K_nn + μ₀ K_nt is a small part of its terms.
fn near_wedging(random: &mut ChaCha8Rng) -> Collision {
    let collision = vehicles(random);
    let (Party::Vehicle(one), Party::Vehicle(two)) = (collision.one, collision.two) else { return collision };
    let arm = one.heading.to_ground(one.impact_center);
    let share = log_uniform(random, 1.0, 35.0) / arm.length();
    let Motion { velocity, .. } = one.motion;
    let towards = Xy { x: velocity.x - share * arm.x, y: velocity.y - share * arm.y };
    let one = Vehicle { yaw_inertia: one.yaw_inertia * log_uniform(random, 1e-9, 1e-2), motion: Motion { velocity, yaw_rate: 0.0 }, ..one };
    let two = Vehicle { motion: Motion { velocity: towards, yaw_rate: 0.0 }, ..two };
    Collision { one: one.into(), two: two.into(), impulse_ratio: ImpulseRatio::Critical, ..collision }
}

fn tiny_inertia(random: &mut ChaCha8Rng) -> Collision {
    let collision = vehicles(random);
    let factor = log_uniform(random, 1e-9, 1e-2);
    let Party::Vehicle(one) = collision.one else { return collision };
    Collision { one: Vehicle { yaw_inertia: one.yaw_inertia * factor, ..one }.into(), ..collision }
}

/// Every magnitude that a case file accepts.
fn any_size(random: &mut ChaCha8Rng) -> Collision {
    let scaled = |party: Party, random: &mut ChaCha8Rng| {
        let Party::Vehicle(vehicle) = party else { return party };
        let (mass, speed, length) = (log_uniform(random, 1e-3, 1e9), log_uniform(random, 1e-6, 1e5), log_uniform(random, 1e-6, 1e3));
        let ForwardLeft { forward, left } = vehicle.impact_center;
        let Xy { x, y } = vehicle.motion.velocity;
        Vehicle {
            mass,
            yaw_inertia: mass * log_uniform(random, 1e-6, 1e6),
            impact_center: ForwardLeft { forward: forward * length, left: left * length },
            motion: Motion {
                velocity: Xy { x: x / 35.0 * speed, y: y / 35.0 * speed },
                yaw_rate: vehicle.motion.yaw_rate * log_uniform(random, 1e-6, 1e4),
            },
            ..vehicle
        }
        .into()
    };
    let collision = vehicles(random);
    Collision { one: scaled(collision.one, random), two: scaled(collision.two, random), ..collision }
}

/// Sizes from the smallest to the largest floats whose products stay finite.
fn whole_floats(random: &mut ChaCha8Rng) -> Collision {
    let (mass, speed, length) = (log_uniform(random, 1e-60, 1e60), log_uniform(random, 1e-60, 1e60), log_uniform(random, 1e-30, 1e30));
    let scaled = |party: Party| {
        let Party::Vehicle(vehicle) = party else { return party };
        let ForwardLeft { forward, left } = vehicle.impact_center;
        let Xy { x, y } = vehicle.motion.velocity;
        Vehicle {
            mass: vehicle.mass * mass,
            yaw_inertia: vehicle.yaw_inertia * mass * length * length,
            impact_center: ForwardLeft { forward: forward * length, left: left * length },
            motion: Motion { velocity: Xy { x: x * speed, y: y * speed }, yaw_rate: vehicle.motion.yaw_rate * speed / length },
            ..vehicle
        }
        .into()
    };
    let collision = vehicles(random);
    Collision { one: scaled(collision.one), two: scaled(collision.two), ..collision }
}

/// Returns the error of each measured output.
fn errors(collision: &Collision, found: &Impact) -> Option<[f64; 8]> {
    let exact = collision.map(|x| Rational::from_float(x).expect("finite")).evaluate();
    let number = |x: &Rational| x.to_f64();
    let away = |found: f64, exact: &Rational| Rational::from_float(found).map_or(f64::NAN, |found| (found - exact).to_f64().abs());
    let speeds = [found.one.after.velocity.length(), found.two.after.velocity.length(), found.approach.length()];
    let speed = speeds.into_iter().fold(0.0, f64::max);
    let before = collision.parties().into_iter().filter_map(|party| party.vehicle()).map(|vehicle| vehicle.motion.yaw_rate.abs());
    let rate = before.chain([found.one.after.yaw_rate.abs(), found.two.after.yaw_rate.abs()]).fold(0.0, f64::max);
    let velocity = [
        away(found.one.after.velocity.x, &exact.one.after.velocity.x),
        away(found.one.after.velocity.y, &exact.one.after.velocity.y),
        away(found.two.after.velocity.x, &exact.two.after.velocity.x),
        away(found.two.after.velocity.y, &exact.two.after.velocity.y),
    ];
    let yaw = away(found.one.after.yaw_rate, &exact.one.after.yaw_rate).max(away(found.two.after.yaw_rate, &exact.two.after.yaw_rate));
    // The root of the exact square, itself within a rounding.
    let delta_v = |found: f64, exact: &Xy<Rational>| {
        let square = (&exact.x * &exact.x + &exact.y * &exact.y).to_f64();
        (found / square.sqrt() - 1.0).abs()
    };
    let impulse = found.impulse.length();
    let loss = exact.loss();
    let critical = exact.critical_impulse_ratio();
    let all = [
        velocity.into_iter().fold(0.0, f64::max) / speed,
        yaw / rate,
        delta_v(found.one.delta_v_magnitude(), &exact.one.delta_v).max(delta_v(found.two.delta_v_magnitude(), &exact.two.delta_v)),
        away(found.impulse.n, &exact.impulse.n) / number(&exact.impulse.n).abs(),
        away(found.impulse.t, &exact.impulse.t) / impulse,
        away(found.loss(), &loss) / number(&loss).abs(),
        away(found.loss(), &loss) / found.kinetic_energy.before,
        away(found.critical_impulse_ratio(), &critical) / number(&critical).abs().max(1.0),
    ];
    all.iter().all(|error| error.is_finite()).then_some(all)
}

fn main() {
    const DOMAINS: [Domain; 6] = [
        Domain { name: "vehicles: 0.8 to 20 t, to 35 m/s", draw: vehicles },
        Domain { name: "nearly separating: the normal approach 10⁻⁹ to 10⁻³ of its own", draw: near_separation },
        Domain { name: "nearly wedged: sticking along the arm of a vehicle with 10⁻⁹ to 10⁻² of its inertia", draw: near_wedging },
        Domain { name: "tiny inertia: 10⁻⁹ to 10⁻² of a vehicle's", draw: tiny_inertia },
        Domain { name: "every size that a case file accepts", draw: any_size },
        Domain { name: "floats: units from 10⁻⁶⁰ to 10⁶⁰", draw: whole_floats },
    ];
    println!(
        "# Accuracy\n\nThe error of each output of `Collision::solve` in f64 against exact rational arithmetic on the same inputs, in units of 2⁻⁵² = 2.2e-16."
    );
    println!("Written by `cargo run --release --example accuracy > docs/accuracy.md`, for version {}.", env!("CARGO_PKG_VERSION"));
    println!("Each row has {COUNT} solved collisions. A refused collision has no error: the program refuses where rounding decides.\n");
    for domain in &DOMAINS {
        let mut random = ChaCha8Rng::seed_from_u64(1);
        let mut columns: [Vec<f64>; 8] = Default::default();
        let (mut drawn, mut without) = (0, 0);
        while columns[0].len() < COUNT && drawn < 50 * COUNT {
            drawn += 1;
            let collision = (domain.draw)(&mut random);
            let Ok(impact) = collision.solve() else { continue };
            match errors(&collision, &impact) {
                Some(errors) => columns.iter_mut().zip(errors).for_each(|(column, error)| column.push(error / f64::EPSILON)),
                None => without += 1,
            }
        }
        println!(
            "## {}\n\n{} of {drawn} are solved{}.\n",
            domain.name,
            columns[0].len() + without,
            if without > 0 { format!("; {without} have no error to state, such as a loss of zero") } else { String::new() }
        );
        println!("| output | median | 99 % | 99.9 % | greatest |\n|---|---:|---:|---:|---:|");
        for (name, column) in MEASURED.iter().zip(&mut columns) {
            column.sort_by(f64::total_cmp);
            let at = |share: f64| {
                column.get(((column.len() as f64 * share) as usize).min(column.len().saturating_sub(1))).copied().unwrap_or(f64::NAN)
            };
            let digits = |value: f64| if value < 1e4 { format!("{value:.1}") } else { format!("{value:.1e}") };
            println!("| {name} | {} | {} | {} | {} |", digits(at(0.5)), digits(at(0.99)), digits(at(0.999)), digits(at(1.0)));
        }
        println!();
    }
}
