//! Compiles and runs the Rust source of formulas.

use crate::formulas::{Tree, at, real_tree, symbols};
use crate::strategies::computable;
use crate::symbols::{Case, case};
use planar_impact::formula::{Formula, Formulas, Glossary};
use planar_impact::*;
use proptest::strategy::{Strategy, ValueTree};
use proptest::test_runner::TestRunner;
use std::fmt::Write;
use std::path::Path;
use std::process::Command;

/// A formula, and the values of its variables.
struct Sample {
    formula: Formula,
    values: Vec<f64>,
}

impl Sample {
    fn of(formula: Formula, value: impl Fn(&str) -> f64) -> Sample {
        let values = formula.variables().iter().map(|name| value(name)).collect();
        Sample { formula, values }
    }

    fn value(&self) -> f64 {
        let variables = self.formula.variables();
        self.formula.evaluate(|name| self.values[variables.iter().position(|known| **known == *name).expect("a variable")])
    }
}

/// Samples every output of collisions of every kind, and its derivative with respect to one input each.
fn of_collisions(runner: &mut TestRunner, samples: &mut Vec<Sample>) {
    for kind in 0..12 {
        let drawn: Case = case(computable()).prop_filter("smooth", Case::is_smooth).new_tree(runner).expect("some are smooth").current();
        let formulas = Formulas::of::<f64>(&drawn.of());
        for (i, output) in Output::ALL.into_iter().enumerate() {
            let formula = formulas.output(output);
            let by = Input::ALL[(i + kind) % Input::COUNT];
            samples.push(Sample::of(formula.clone(), |name| drawn.float(name)));
            samples.push(Sample::of(formula.derivative(by.symbol()), |name| drawn.float(name)));
        }
    }
}

fn of_trees(runner: &mut TestRunner, samples: &mut Vec<Sample>) {
    let values = [1.25, -0.75, 2.5];
    for _ in 0..200 {
        let tree: Tree = real_tree().prop_filter("smooth", |tree| tree.is_smooth(&values)).new_tree(runner).expect("some are").current();
        let formula = Glossary::default().formula("f", &tree.of(&symbols()));
        samples.push(Sample::of(formula, |name| values[at(name)]));
    }
}

/// Returns a program that prints the value of each sample, to be compiled with warnings as errors.
fn program(samples: &[Sample]) -> String {
    let (mut modules, mut calls) = (String::new(), String::new());
    for (i, sample) in samples.iter().enumerate() {
        let source = sample.formula.rust();
        assert!(source.lines().all(|line| line.len() <= 100), "{source}");
        let head = source.lines().find_map(|line| line.strip_prefix("pub fn ")).expect("a function");
        let name = head.split('(').next().expect("a name");
        let arguments: Vec<String> = sample.values.iter().map(|value| format!("{value:?}")).collect();
        writeln!(modules, "mod f{i} {{\n{source}\n}}").expect("a string takes everything");
        writeln!(calls, "    println!(\"{{:?}}\", f{i}::{name}({}));", arguments.join(", ")).expect("a string takes everything");
    }
    format!("{modules}\nfn main() {{\n{calls}}}\n")
}

#[test]
fn the_source_compiles_and_computes_the_formula() {
    let mut runner = TestRunner::deterministic();
    let mut samples = Vec::new();
    of_collisions(&mut runner, &mut samples);
    of_trees(&mut runner, &mut samples);

    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let (source, binary) = (folder.join("formulas.rs"), folder.join("formulas"));
    std::fs::write(&source, program(&samples)).expect("the folder for temporary files can be written");
    let compiler = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let compiled = Command::new(compiler).args(["--edition", "2024", "-D", "warnings", "-o"]).arg(&binary).arg(&source).output();
    let compiled = compiled.expect("the compiler runs where tests are run");
    assert!(compiled.status.success(), "{}", String::from_utf8_lossy(&compiled.stderr));
    let run = Command::new(&binary).output().expect("it runs");
    let printed = String::from_utf8(run.stdout).expect("numbers are ASCII");
    let computed: Vec<f64> = printed.lines().map(|line| line.parse().expect("a number")).collect();
    assert_eq!(computed.len(), samples.len());
    for (sample, computed) in samples.iter().zip(computed) {
        // The trigonometric functions of the standard library differ from those of libm, and products are rounded in another order.
        let expected = sample.value();
        let turned = (computed - expected).abs().min((core::f64::consts::TAU - (computed - expected).abs()).abs());
        assert!(turned <= 1e-9 * (1.0 + expected.abs()), "{computed} for {expected} of {}", sample.formula.rust());
    }
}
