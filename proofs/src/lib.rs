#![doc = include_str!("../README.md")]
// Tests compute with the functions of the platform, so that they do not repeat the program.
#![cfg_attr(test, allow(clippy::disallowed_methods))]

mod choice;
mod conclusion;
mod control;
mod equation;
mod free;
mod identity;
mod misprint;
mod proof;
mod report;
pub mod scalar;

pub use choice::Choice;
pub use conclusion::Conclusion;
pub use control::{Control, Expected};
pub use identity::Identity;
pub use misprint::{Finding, Input, Misprint};
pub use proof::{Arithmetic, ERROR_BITS, FRACTIONS, Proof, REDRAWS, Verdict};
pub use report::{Problem, Proofs, Report, TOTAL_ERROR_BITS};

/// The seed of [`run`]. Any other is just as good; a fixed one makes a run repeatable.
pub const SEED: u64 = 1;

/// Proves every identity, draws the conclusions, and demonstrates every misprint.
pub fn run() -> Report {
    run_from(SEED)
}

/// Runs the proofs with points drawn from another seed.
pub fn run_from(seed: u64) -> Report {
    let mut streams = 0..;
    let mut next_streams = |count: usize| streams.by_ref().take(count).collect::<Vec<u64>>();
    let (subjects, choices) = std::thread::scope(|scope| {
        let choices = scope.spawn(|| choice::all(seed));
        // One thread per subject. Its points depend only on its streams, not on the order in which threads finish.
        let subjects: Vec<_> = identity::subjects()
            .into_iter()
            .map(|subject| {
                let streams = next_streams(subject.identities.len());
                scope.spawn(move || Proofs::of(subject, seed, &streams))
            })
            .collect();
        let subjects: Vec<Proofs> = subjects.into_iter().map(finished).collect();
        (subjects, finished(choices))
    });
    let proofs: Vec<&Proof> = subjects.iter().flat_map(|subject| &subject.proofs).collect();
    let conclusions = conclusion::from(&proofs);
    Report { seed, conclusions, choices, misprints: misprint::all(), controls: control::all(seed), subjects }
}

fn finished<T>(thread: std::thread::ScopedJoinHandle<'_, T>) -> T {
    thread.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
}

#[cfg(test)]
mod tests;
