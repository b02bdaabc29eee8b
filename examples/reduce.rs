//! Draws, solves and summarizes collisions with six uncertain inputs, on one to seven threads and on each set of vector instructions, and compares time, memory and
//! bits:
//!
//! ```sh
//! cargo run --release --example reduce -- 1e9
//! ```
use std::hash::{DefaultHasher, Hash, Hasher};
use std::process::ExitCode;
use std::time::Instant;

use planar_impact::batch::Instructions;
use planar_impact::prelude::*;
use planar_impact::simulation::{Extremes, Moments, Quantiles, Simulation};
use planar_impact::{Distribution, Output};

const OF: [Output; 2] = [Output::DeltaVMagnitude(Side::One), Output::Loss];

fn simulation() -> Result<Simulation, Box<dyn std::error::Error>> {
    let car = |mass: f64| Vehicle::new(mass, 1.7 * mass).with_impact_center(1.9, 0.35);
    let collision =
        Collision::new(car(1450.0).with_speed(14.0), Party::from(car(2180.0).with_heading(Heading::from_angle(2.0)).with_speed(11.0)))
            .with_restitution(0.1);
    let uncertain = [
        (Input::Mass(Side::One), Distribution::Normal { mean: 1450.0, sd: 40.0 }),
        (Input::VelocityX(Side::One), Distribution::Normal { mean: 14.0, sd: 0.8 }),
        (Input::Mass(Side::Two), Distribution::Normal { mean: 2180.0, sd: 60.0 }),
        (Input::YawRate(Side::Two), Distribution::Uniform { min: -0.2, max: 0.2 }),
        (Input::CrushPlane, Distribution::Uniform { min: -0.15, max: 0.15 }),
        (Input::Restitution, Distribution::Triangular { min: 0.0, mode: 0.1, max: 0.3 }),
    ];
    Ok(uncertain
        .into_iter()
        .try_fold(Simulation::of(collision), |simulation, (input, distribution)| simulation.with(input, distribution))?)
}

/// Returns what the bits of the answer are, in short, and how long it took.
fn run(simulation: &Simulation, samples: u64, threads: usize) -> Result<(u64, f64), Box<dyn std::error::Error>> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build()?;
    let began = Instant::now();
    let reduced = pool.install(|| simulation.reduce(samples, (Moments::of(&OF), Quantiles::of(&OF), Extremes::of(&OF)), &|_| true));
    let seconds = began.elapsed().as_secs_f64();
    let mut hasher = DefaultHasher::new();
    format!("{reduced:?}").hash(&mut hasher);
    Ok((hasher.finish(), seconds))
}

/// Returns the most memory that this process had, in MiB, where the system tells it.
fn memory() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let kib: u64 = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?.trim().strip_suffix(" kB")?.parse().ok()?;
    Some(kib / 1024)
}

fn main() -> Result<ExitCode, Box<dyn std::error::Error>> {
    let samples = std::env::args().nth(1).map_or(Ok(1e7), |written| written.parse::<f64>())? as u64;
    let mut answers = Vec::new();
    println!("{:12} {:>12} {:>8} {:>8} {:>10} {:>7}  bits", "instructions", "samples", "threads", "s", "ns a sample", "MiB");
    let best = Instructions::best();
    let on_threads = [1, 2, 3, 7].map(|threads| (samples, best, threads));
    let on_instructions = Instructions::available().filter(|set| *set != best).map(|set| (samples, set, 2));
    for (samples, set, threads) in [(samples / 1000, best, 7)].into_iter().chain(on_threads).chain(on_instructions) {
        let (bits, seconds) = run(&simulation()?.on(set), samples, threads)?;
        let memory = memory().map_or("?".to_owned(), |mib| mib.to_string());
        println!(
            "{:12} {samples:12} {threads:8} {seconds:8.2} {:11.1} {memory:>7}  {bits:016x}",
            format!("{set:?}"),
            1e9 * seconds / samples as f64
        );
        answers.push((samples, bits));
    }
    let is_same = answers.iter().all(|(count, bits)| *count != samples || *bits == answers[1].1);
    println!("{}", if is_same { "the same bits everywhere" } else { "OTHER BITS" });
    Ok(if is_same { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}
