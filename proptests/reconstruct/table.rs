//! The table of the guide: which evidence determines which unknowns.

use std::thread;

use planar_impact::reconstruct::{Estimate, Measurable, Reconstruction, Search, Solution, Uncertainty, Variable, Verdict};

use super::scene::{Source, Truth, asking, deviation};
use crate::strategies::config;

const GUIDE: &str = include_str!("../../src/guide/reconstruction.md");

/// How far an unknown may come back from the truth, in m/s, rad/s, m, rad or 1.
const EXACT: f64 = 1e-9;

struct Row {
    unknowns: Vec<Variable>,
    evidence: Vec<Measurable>,
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
                evidence: evidence.split(", ").map(|name| Measurable::named(name).unwrap_or_else(|| panic!("{name}"))).collect(),
                is_determined: match determined {
                    "yes" => true,
                    "no" => false,
                    other => panic!("{other}"),
                },
            }
        })
        .collect()
}

/// What is wrong with what comes back of one random collision; nothing if all is as the row says.
fn wrong(row: &Row, source: &mut Source) -> Option<String> {
    let share = source.between(0.2, 0.8);
    let truth = Truth::of(source.collision(), share);
    let mut question = Reconstruction::of(truth.collision);
    for &variable in &row.unknowns {
        question = asking(question, variable, truth.variable(variable), source);
    }
    for &measurable in &row.evidence {
        let value = truth.measured(measurable);
        question = question.evidence(measurable, value, Uncertainty::StandardDeviation(deviation(measurable, value)));
    }
    // The first starts of the default search, then all of them: what a part of them finds all of them find.
    let few = Search { starts: 8, ..Search::default() };
    wrong_answer(row, &truth, &question, &few)?;
    wrong_answer(row, &truth, &question, &Search::default())
}

fn wrong_answer(row: &Row, truth: &Truth, question: &Reconstruction, search: &Search) -> Option<String> {
    let answer = match question.solve(search) {
        Ok(answer) => answer,
        Err(why) => return Some(format!("{why}")),
    };
    if !row.is_determined {
        return (answer.verdict != Verdict::Undetermined).then(|| format!("{:?} of {:?}", answer.verdict, truth.collision));
    }
    if !matches!(answer.verdict, Verdict::Agrees | Verdict::SeveralSolutions) {
        return Some(format!("{:?}, chi-square {:e}", answer.verdict, answer.best().chi_square));
    }
    let nearest = answer.solutions.iter().map(|solution| miss(solution, truth)).fold(f64::INFINITY, f64::min);
    (nearest > 1.0).then(|| format!("off by {nearest:e} of what is allowed in {:?}", truth.collision))
}

/// The largest error of a solution, in what is allowed: 10⁻⁹, or what the last bits of the evidence come to where they come to more.
fn miss(solution: &Solution, truth: &Truth) -> f64 {
    let of_unknown = |(estimate, row): (&Estimate, &Vec<f64>)| {
        let last_bits = row.iter().zip(&solution.evidence).map(|(by, evidence)| (by * evidence.given).abs() * 4.0 * f64::EPSILON);
        (estimate.value - truth.variable(estimate.of)).abs() / last_bits.sum::<f64>().max(EXACT)
    };
    solution.unknowns.iter().zip(&solution.influence).map(of_unknown).fold(0.0, f64::max)
}

#[test]
fn forward_and_back_is_the_truth_or_says_what_is_open() {
    let rows = rows();
    assert!(rows.len() >= 20 && rows.iter().filter(|row| !row.is_determined).count() >= 5);
    let cases = config().cases;
    let try_half = |half: usize| {
        let mut found = Vec::new();
        for (number, row) in rows.iter().enumerate() {
            let mut source = Source::of(2 * number as u64 + half as u64);
            let wrong: Vec<String> = (0..cases / 2).filter_map(|_| wrong(row, &mut source)).collect();
            if let Some(first) = wrong.first() {
                let (unknowns, evidence) = (&row.unknowns, &row.evidence);
                found.push(format!("{} of {} wrong: {unknowns:?} from {evidence:?}: {first}", wrong.len(), cases / 2));
            }
        }
        found
    };
    let found = thread::scope(|scope| {
        let other = scope.spawn(|| try_half(1));
        let mut found = try_half(0);
        found.extend(other.join().expect("it does not panic"));
        found
    });
    assert!(found.is_empty(), "{}", found.join("\n"));
}
