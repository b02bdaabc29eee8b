//! Tests of the command line as a process: its input, its output and its exit status.
//!
//! One test binary, because each one would link the program's dependencies again. `bad_inputs` holds inputs that must
//! be refused, `check` the findings in results of other programs, `examples` the examples of the manual, `reference`,
//! `gradient`, `crush` and `uncertainty` the numbers of an independent solver, and `pins` every number of the output.
// Tests compute with the functions of the platform, so that they do not repeat the program.
#![allow(clippy::disallowed_methods)]

#[path = "main/action.rs"]
mod action;
#[path = "main/answers.rs"]
mod answers;
#[path = "main/bad_inputs/mod.rs"]
mod bad_inputs;
#[path = "main/batch.rs"]
mod batch;
#[path = "main/casework.rs"]
mod casework;
#[path = "main/check/mod.rs"]
mod check;
#[path = "main/compare.rs"]
mod compare;
#[path = "main/crush.rs"]
mod crush;
#[path = "main/endings.rs"]
mod endings;
#[path = "main/examples.rs"]
mod examples;
#[path = "main/faults.rs"]
mod faults;
#[path = "main/formula.rs"]
mod formula;
#[path = "main/gradient.rs"]
mod gradient;
#[path = "main/guideline.rs"]
mod guideline;
#[path = "main/hostile.rs"]
mod hostile;
#[path = "main/manual.rs"]
mod manual;
#[path = "main/new.rs"]
mod new;
#[path = "main/paths.rs"]
mod paths;
#[path = "main/pins/mod.rs"]
mod pins;
#[path = "main/printed.rs"]
mod printed;
#[path = "main/process.rs"]
mod process;
#[path = "main/reconstruct/mod.rs"]
mod reconstruct;
#[path = "main/record/mod.rs"]
mod record;
#[path = "main/reference.rs"]
mod reference;
#[path = "main/report.rs"]
mod report;
#[path = "main/rest.rs"]
mod rest;
#[path = "main/schema.rs"]
mod schema;
#[path = "main/stiffness.rs"]
mod stiffness;
#[path = "main/sweep.rs"]
mod sweep;
#[path = "main/uncertainty.rs"]
mod uncertainty;
#[path = "main/units.rs"]
mod units;
#[path = "main/warnings.rs"]
mod warnings;
#[path = "main/words.rs"]
mod words;
