//! Instructions of one answer to each question that speed is promised for, counted by `.ci/instructions/count` under callgrind: unlike time, they do not vary
//! with the load of the machine.
//!
//! Called with a question and a number of rounds, it asks the question of 256 collisions in each. The difference between two numbers of rounds leaves out
//! what happens once. Batches use the vector instructions that every x86-64 has.
// Examples and comparisons compute as their readers do.
#![allow(clippy::disallowed_methods)]

use std::hint::black_box;

use planar_impact::batch::{Batch, Instructions};
use planar_impact::scalar::lanes::Lanes;
use planar_impact::*;

#[path = "../../benches/kernel/inputs.rs"]
#[allow(dead_code)]
mod inputs;

const COLLISIONS: usize = 256;

fn main() {
    let mut words = std::env::args().skip(1);
    let (Some(question), rounds) = (words.next(), words.next().and_then(|rounds| rounds.parse().ok()).unwrap_or(1)) else {
        return println!("a question and a number of rounds: {}", QUESTIONS.map(|(name, _)| name).join(", "));
    };
    let collisions: Vec<Collision> = inputs::cases(COLLISIONS).iter().map(inputs::collision_from_angles).collect();
    let rows: Vec<[f64; Input::COUNT]> = collisions.iter().map(Collision::to_inputs).collect();
    let columns: Vec<Vec<f64>> = (0..Input::COUNT).map(|i| rows.iter().map(|row| row[i]).collect()).collect();
    let with = |batch: Batch<'static>, input: Input| batch.with(input, columns[input.index()].clone().leak()).expect("as many rows");
    let batch = Input::ALL.into_iter().fold(Batch::of(collisions[0]).on(Instructions::Compiled), with);
    let subject = Subject { collisions, rows, batch };
    let (_, ask) = QUESTIONS.into_iter().find(|(name, _)| *name == question).unwrap_or_else(|| panic!("no question is named {question}"));
    for _ in 0..rounds {
        ask(black_box(&subject));
    }
}

struct Subject {
    collisions: Vec<Collision>,
    rows: Vec<[f64; Input::COUNT]>,
    batch: Batch<'static>,
}

type Ask = fn(&Subject);

const QUESTIONS: [(&str, Ask); 9] = [
    ("evaluate", |subject| subject.each(|collision| use_of(collision.evaluate()))),
    ("solve", |subject| subject.each(|collision| use_of(collision.solve()))),
    ("gradient", |subject| subject.each(|collision| use_of(collision.sensitivity(Output::NormalWork)))),
    ("jacobian", |subject| {
        let mut table = Outputs::default();
        subject.each(|collision| use_of(collision.sensitivities_to(&mut table)));
    }),
    ("lanes", |subject| {
        for four in subject.collisions.chunks_exact(4) {
            let four: &[Collision; 4] = four.try_into().expect("four");
            black_box(Collision::<Lanes<4>>::gather(four).map(|lanes| lanes.evaluate()));
        }
    }),
    ("batch-evaluate", |subject| use_of(subject.batch.evaluate(&Output::ALL))),
    ("batch-solve", |subject| use_of(subject.batch.solve(&Output::ALL))),
    ("batch-gradient", |subject| use_of(subject.batch.sensitivity(Output::NormalWork, &Input::ALL))),
    ("batch-jacobian", |subject| use_of(subject.batch.sensitivities(&Output::ALL, &Input::ALL))),
];

/// Keeps the compiler from leaving out what nothing else uses.
fn use_of<T>(answer: T) {
    black_box(answer);
}

impl Subject {
    /// Asks each collision, made from its inputs.
    fn each(&self, mut ask: impl FnMut(&Collision)) {
        for row in &self.rows {
            ask(&self.collisions[0].with_inputs(*black_box(row)));
        }
    }
}
