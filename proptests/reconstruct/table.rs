//! The table of the guide: the unknowns that each set of evidence determines.

use std::sync::atomic::{AtomicUsize, Ordering};

use planar_impact::reconstruct::{Estimate, Fitted, Measurand, ReconstructionProblem, Search, Solution, Uncertainty, Variable, Verdict};

use super::scene::{Source, Truth, asking, deviation};
use crate::strategies::config;

const GUIDE: &str = include_str!("../../src/guide/reconstruction.md");

/// Maximum error of a recovered unknown, in m/s, rad/s, m, rad or 1.
const EXACT: f64 = 1e-9;

/// Number of cases among which one is at a fold.
const CASES_PER_FOLD: usize = 240_000;

/// Number of cases at a fold, of all rows.
static FOLDED: AtomicUsize = AtomicUsize::new(0);

/// Returns the largest number of folds in so many cases of each row: one in those of every run, and four standard deviations more in as many others as are asked
/// for.
fn most_folds(cases: u32) -> usize {
    let expected = (rows().len() * cases as usize).div_ceil(CASES_PER_FOLD);
    expected + (4.0 * (expected as f64 - 1.0).sqrt()) as usize
}

/// Number of parts that the rows are dealt to.
const PARTS: usize = 4;

struct Row {
    unknowns: Vec<Variable>,
    evidence: Vec<Measurand>,
    is_determined: bool,
}

fn rows() -> Vec<Row> {
    let cells = |line: &'static str| line.split('|').map(str::trim).collect::<Vec<_>>();
    let lines = GUIDE.lines().skip_while(|line| !line.starts_with("| unknown |")).skip(2).take_while(|line| line.starts_with('|'));
    lines
        .map(|line| {
            let [_, unknowns, evidence, determined, _] = cells(line)[..] else { panic!("{line}") };
            Row {
                unknowns: unknowns.split(", ").map(|name| Variable::named(name).unwrap_or_else(|| panic!("{name}"))).collect(),
                evidence: evidence.split(", ").map(|name| Measurand::named(name).unwrap_or_else(|| panic!("{name}"))).collect(),
                is_determined: match determined {
                    "yes" => true,
                    "no" => false,
                    other => panic!("{other}"),
                },
            }
        })
        .collect()
}

/// Result of reconstructing one random collision.
enum Back {
    /// The result stated in the row.
    AsSaid,
    /// Another collision that agrees with the evidence to its last bits: at a fold, where two solutions merge, nothing distinguishes them.
    Folded,
    /// Another result.
    Wrong(String),
}

fn back(row: &Row, source: &mut Source) -> Back {
    let share = source.between(0.2, 0.8);
    let truth = Truth::of(source.collision(), share);
    let mut question = ReconstructionProblem::of(truth.collision);
    for &variable in &row.unknowns {
        question = asking(question, variable, truth.variable(variable), source);
    }
    for &measurable in &row.evidence {
        let value = truth.measured(measurable);
        question = question.evidence(measurable, value, Uncertainty::StandardDeviation(deviation(measurable, value)));
    }
    // First a part of the starts of the default search, then all of them, which find everything that a part of them finds.
    let few = Search { starts: 8, ..Search::default() };
    match answer(row, &truth, &question, &few) {
        Back::Wrong(_) => answer(row, &truth, &question, &Search::default()),
        right => right,
    }
}

fn answer(row: &Row, truth: &Truth, question: &ReconstructionProblem, search: &Search) -> Back {
    let answer = match question.solve(search) {
        Ok(answer) => answer,
        Err(why) => return Back::Wrong(format!("{why}")),
    };
    let verdicts: &[Verdict] = if row.is_determined { &[Verdict::Agrees, Verdict::SeveralSolutions] } else { &[Verdict::Undetermined] };
    if !verdicts.contains(&answer.verdict) {
        return Back::Wrong(format!("{:?}, chi-square {:e} of {:?}", answer.verdict, answer.best().chi_square, truth.collision));
    }
    let nearest = answer.solutions.iter().map(|solution| miss(solution, truth)).fold(f64::INFINITY, f64::min);
    if !row.is_determined || nearest <= 1.0 {
        Back::AsSaid
    } else if answer.solutions.iter().any(|solution| is_folded(solution, truth)) {
        Back::Folded
    } else {
        Back::Wrong(format!("off by {nearest:e} of what is allowed in {:?}", truth.collision))
    }
}

/// Returns `true` if a solution reproduces the true evidence to its last bits, and is within a millionth of its own
/// standard deviations of the truth.
fn is_folded(solution: &Solution, truth: &Truth) -> bool {
    let is_last_bit = |fitted: &Fitted| fitted.residual.abs() <= 16.0 * f64::EPSILON * fitted.given.abs().max(1.0);
    let is_near =
        |estimate: &Estimate| estimate.sd.is_some_and(|sd| (estimate.value - truth.variable(estimate.of)).abs() <= EXACT.max(1e-6 * sd));
    solution.evidence.iter().all(is_last_bit) && solution.unknowns.iter().all(is_near)
}

/// Returns the largest error of a solution, relative to the allowed error: 10⁻⁹, or the effect of the last bits of
/// the evidence if that is larger.
fn miss(solution: &Solution, truth: &Truth) -> f64 {
    let of_unknown = |(estimate, row): (&Estimate, &Vec<f64>)| {
        let last_bits = row.iter().zip(&solution.evidence).map(|(by, evidence)| (by * evidence.given).abs() * 4.0 * f64::EPSILON);
        (estimate.value - truth.variable(estimate.of)).abs() / last_bits.sum::<f64>().max(EXACT)
    };
    solution.unknowns.iter().zip(&solution.influence).map(of_unknown).fold(0.0, f64::max)
}

/// Tries cases of every row whose number leaves the remainder `part`.
fn forward_and_back(part: usize, cases: u32) {
    let rows = rows();
    assert!(rows.len() >= 20 && rows.iter().filter(|row| !row.is_determined).count() >= 5);
    let mut found = Vec::new();
    for (number, row) in rows.iter().enumerate().filter(|(number, _)| number % PARTS == part) {
        let mut source = Source::of(number as u64);
        let (mut wrong, mut folded) = (Vec::new(), 0);
        for _ in 0..cases {
            match back(row, &mut source) {
                Back::AsSaid => (),
                Back::Folded => folded += 1,
                Back::Wrong(what) => wrong.push(what),
            }
        }
        let (unknowns, evidence) = (&row.unknowns, &row.evidence);
        if let Some(first) = wrong.first() {
            found.push(format!("{} of {cases} wrong: {unknowns:?} from {evidence:?}: {first}", wrong.len()));
        }
        let all_folded = FOLDED.fetch_add(folded, Ordering::Relaxed) + folded;
        if folded > 0 && all_folded > most_folds(cases) {
            found.push(format!("{folded} of {cases} at a fold, {all_folded} in all rows: {unknowns:?} from {evidence:?}"));
        }
    }
    assert!(found.is_empty(), "{}", found.join("\n"));
}

/// Cases of each row that run with the other tests: a tenth of those of a law, which are many times cheaper.
fn some() -> u32 {
    config().cases.div_ceil(10)
}

// A test for each part of the rows, so that they run side by side.

#[test]
fn forward_and_back_is_the_truth_or_says_what_is_open_in_the_first_rows() {
    forward_and_back(0, some());
}

#[test]
fn forward_and_back_is_the_truth_or_says_what_is_open_in_the_second_rows() {
    forward_and_back(1, some());
}

#[test]
fn forward_and_back_is_the_truth_or_says_what_is_open_in_the_third_rows() {
    forward_and_back(2, some());
}

#[test]
fn forward_and_back_is_the_truth_or_says_what_is_open_in_the_fourth_rows() {
    forward_and_back(3, some());
}

/// `cargo test --release --test proptests -- --ignored every_row_of_the_table`
#[ignore = "a minute in release"]
#[test]
fn every_row_of_the_table_ten_times_as_often() {
    for part in 0..PARTS {
        forward_and_back(part, config().cases);
    }
}
