//! One hash of the bits of 10⁵ collisions, their derivatives, a batch, a Monte Carlo mean and a reconstruction; the same on every machine. `.ci/same_bits/run` compares it
//! with the one that is recorded.

mod collisions;

use collisions::{Hash, collision, derivatives, outputs};
use planar_impact::batch::{Batch, Instructions};
use planar_impact::{Collision, Input, Output, Party, Side, Vehicle};
use planar_impact_app::json::{self, Layout};
use planar_impact_app::{Case, Source, Uncontrolled, reconstruct, uncertainty};

const COUNT: u32 = 100_000;

fn case(text: &str) -> Case {
    Case::parse(Source::new("case.toml", text)).unwrap_or_else(|issues| panic!("{issues}"))
}

fn part(name: &str, whole: &mut Hash, of: impl FnOnce(&mut Hash)) {
    let mut hash = Hash::START;
    of(&mut hash);
    println!("{name:<16} {:016x}", hash.0);
    whole.bytes(&hash.0.to_le_bytes());
}

/// Hashes every output of a batch whose speeds, masses and yaw rates differ.
fn batch(hash: &mut Hash, instructions: Instructions) {
    let of = |number: u32, side: Side| match (side, collision(number)) {
        (Side::One, Collision { one: Party::Vehicle(vehicle), .. }) | (Side::Two, Collision { two: Party::Vehicle(vehicle), .. }) => {
            vehicle
        }
        _ => Vehicle::new(1500.0, 2500.0),
    };
    let rows: Vec<[Vehicle; 2]> = (0..COUNT).map(|number| [of(number, Side::One), of(number, Side::Two)]).collect();
    let base = collision(1);
    let columns: Vec<(Input, Vec<f64>)> = Side::ALL
        .into_iter()
        .flat_map(|side| {
            let column = |of: fn(&Vehicle) -> f64| rows.iter().map(|row| of(&row[side as usize])).collect::<Vec<f64>>();
            [
                (Input::Mass(side), column(|vehicle| vehicle.mass)),
                (Input::VelocityX(side), column(|vehicle| vehicle.motion.velocity.x)),
                (Input::VelocityY(side), column(|vehicle| vehicle.motion.velocity.y)),
                (Input::YawRate(side), column(|vehicle| vehicle.motion.yaw_rate)),
                (Input::Heading(side), column(|vehicle| vehicle.heading.angle())),
            ]
        })
        .collect();
    let batch = columns.iter().fold(Batch::of(base).on(instructions), |batch, (input, column)| {
        batch.with(*input, column).unwrap_or_else(|error| panic!("{error}"))
    });
    let solved = batch.solve(&Output::ALL);
    for output in Output::ALL {
        solved.columns[output].iter().filter(|value| !value.is_nan()).for_each(|value| hash.number(*value));
    }
}

fn main() {
    if std::env::args().nth(1).as_deref() == Some("few") {
        // What a controller computes in reasonable time.
        let (mut of_outputs, mut of_derivatives) = (Hash::START, Hash::START);
        outputs(&mut of_outputs, 10_000);
        derivatives(&mut of_derivatives, 1000);
        return println!("{:016x} {:016x}", of_outputs.0, of_derivatives.0);
    }
    let mut whole = Hash::START;
    part("outputs", &mut whole, |hash| {
        outputs(hash, COUNT);
    });
    part("derivatives", &mut whole, |hash| derivatives(hash, COUNT));
    let hashes = Instructions::available().map(|instructions| {
        let mut hash = Hash::START;
        batch(&mut hash, instructions);
        (hash.0, instructions)
    });
    let hashes: Vec<_> = hashes.collect();
    let sets: Vec<_> = hashes.iter().map(|(_, instructions)| format!("{instructions:?}")).collect();
    assert!(hashes.iter().all(|(hash, _)| *hash == hashes[0].0), "instructions give other bits: {hashes:x?}");
    eprintln!("instructions: {}", sets.join(", "));
    part("batch", &mut whole, |hash| *hash = Hash(hashes[0].0));
    part("monte carlo", &mut whole, |hash| {
        let options =
            uncertainty::Options { samples: 100_000, methods: vec![uncertainty::Method::MonteCarlo], ..uncertainty::Options::default() };
        let answer = uncertainty::uncertainty(&case(include_str!("../../../cli/examples/uncertain.toml")), &options, &Uncontrolled);
        hash.bytes(json::text(&answer.unwrap_or_else(|issues| panic!("{issues}")), Layout::Compact).unwrap_or_default().as_bytes());
    });
    let of_reconstruction = |text: &str, hash: &mut Hash| {
        let answer = reconstruct::reconstruct(&case(text), &reconstruct::Options::default(), &Uncontrolled);
        hash.bytes(json::text(&answer.unwrap_or_else(|issues| panic!("{issues}")), Layout::Compact).unwrap_or_default().as_bytes());
    };
    part("reconstruction", &mut whole, |hash| of_reconstruction(include_str!("../../../cli/examples/reconstruct/position-a.toml"), hash));
    println!("{:<16} {:016x}", "all", whole.0);
    // Not part of the whole: the integrator and its steps are of a library that takes powers of the platform.
    let mut apart = Hash::START;
    part("slide", &mut apart, |hash| of_reconstruction(include_str!("../../../cli/examples/reconstruct/two-cars.toml"), hash));
}
