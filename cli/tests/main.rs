//! The command line as a process: what it is given, what it prints where, and how it ends.
//!
//! One binary, because each would link the program's dependencies again. `bad_inputs` holds what must be refused, `check` what
//! is found in the results of other programs, `examples` what the manual promises, `reference`, `gradient` and `crush` the
//! numbers of an independent solver.

#[path = "main/bad_inputs/mod.rs"]
mod bad_inputs;
#[path = "main/check/mod.rs"]
mod check;
#[path = "main/crush.rs"]
mod crush;
#[path = "main/examples.rs"]
mod examples;
#[path = "main/formula.rs"]
mod formula;
#[path = "main/gradient.rs"]
mod gradient;
#[path = "main/guideline.rs"]
mod guideline;
#[path = "main/manual.rs"]
mod manual;
#[path = "main/process.rs"]
mod process;
#[path = "main/reconstruct/mod.rs"]
mod reconstruct;
#[path = "main/reference.rs"]
mod reference;
#[path = "main/rest.rs"]
mod rest;
#[path = "main/stiffness.rs"]
mod stiffness;
#[path = "main/sweep.rs"]
mod sweep;
