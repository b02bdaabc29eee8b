//! The unknowns of the solution.

use planar_impact_app::reconstruct::{Alternative, Reconstruction, Unknown};
use planar_impact_app::units::{Measure, Units};

use super::rounding::{digits, probability, rounded};
use crate::block::{Block, Table};

/// Renders values, standard deviations and 95 % intervals, with the footnotes that they need.
pub fn blocks(answer: &Reconstruction, units: Units) -> Vec<Block> {
    let table = |kind: &str, is_input: bool| {
        let all = answer.unknown.iter().filter(|(_, unknown)| unknown.is_input == is_input);
        let rows: Vec<Vec<String>> = all.flat_map(|(name, unknown)| rows(name, unknown, units)).collect();
        (!rows.is_empty()).then(|| Table::new([kind, "value", "+/- sd", "95 % from", "to", "unit"], "lrrrrl", rows).narrow().into())
    };
    let mut blocks: Vec<Block> = table("unknown", false).into_iter().chain(table("uncertain input", true)).collect();
    for (name, unknown) in answer.unknown.iter() {
        blocks.extend(unknown.at_bound.map(|bound| Block::item("* ", at_bound(answer, name, unknown, bound))));
    }
    for name in &answer.weakly_determined {
        let text = "evidence barely constrains it: its standard deviation is larger than its whole range.";
        blocks.push(Block::item("! ", format!("{name}: {text}")));
    }
    if answer.impulse_ratio_is_fraction && answer.unknown.get("contact.impulse_ratio").is_some() {
        let text = "contact.impulse_ratio is the fraction of the critical ratio here, as the case gives it.";
        blocks.push(Block::item("", text));
    }
    if !answer.has_uncertainty() && answer.has_solution() {
        blocks.push(Block::item("", "No piece of evidence has an uncertainty, so that of the unknowns is not known."));
    }
    blocks
}

/// Renders an unknown; a speed also in road units.
fn rows(name: &str, unknown: &Unknown, units: Units) -> Vec<Vec<String>> {
    let first = row(name, unknown, unknown.measure, units);
    if unknown.measure == Measure::Speed { vec![first, row("", unknown, Measure::RoadSpeed, units)] } else { vec![first] }
}

fn row(name: &str, unknown: &Unknown, measure: Measure, units: Units) -> Vec<String> {
    let unit = units.unit(measure).to_owned();
    let Some(value) = unknown.value else {
        return vec![name.to_owned(), "open".to_owned(), "-".to_owned(), "-".to_owned(), "-".to_owned(), unit];
    };
    // If the interval is narrower than the standard deviation, use enough digits to distinguish its ends.
    let width = unknown.interval_95.map(|[from, to]| to - from).filter(|width| *width > 0.0);
    let step = unknown.sd.map(|sd| width.filter(|width| *width < sd).unwrap_or(sd));
    let number = |value| rounded(measure, value, step, units);
    let mark = if unknown.at_bound.is_some() && !name.is_empty() { " *" } else { "" };
    let mut cells = vec![format!("{name}{mark}"), number(value)];
    match unknown.sd.zip(unknown.interval_95) {
        Some((sd, [from, to])) => cells.extend([number(sd), number(from), number(to)]),
        None => cells.extend(["-"; 3].map(str::to_owned)),
    }
    cells.push(unit);
    cells
}

/// Explains an unknown at its bound, with the paper's guideline if it has one.
fn at_bound(answer: &Reconstruction, name: &str, unknown: &Unknown, bound: &str) -> String {
    let end = if bound == "min" { "lower" } else { "upper" };
    let meaning = match (name, bound) {
        ("contact.restitution", "max") => "without a reason for so high a value, re-examine the geometry.",
        ("contact.restitution", "min") if unknown.value == Some(0.0) => "a common velocity along the normal, as in most severe crashes.",
        _ if unknown.sd.is_some() => "the best fit without the bound lies there too.",
        _ if answer.has_uncertainty() => {
            "the best fit without the bound lies beyond it. It is held at the bound, so it has no standard deviation, and those of the others treat it as known."
        }
        // Without any standard deviation, nothing distinguishes the two cases.
        _ => "is there a reason for that bound?",
    };
    format!("{name} lies on its {end} bound: {meaning}")
}

/// Renders several solutions side by side; nothing if there is only one.
pub fn alternatives(answer: &Reconstruction, units: Units) -> Vec<Block> {
    /// Number of solutions that fit side by side.
    const SHOWN: usize = 4;
    if answer.solutions.len() < 2 {
        return Vec::new();
    }
    let shown = &answer.solutions[..answer.solutions.len().min(SHOWN)];
    let mut rows: Vec<Vec<String>> = Vec::new();
    for (name, unknown) in answer.unknown.iter() {
        let value = |solution: &Alternative| {
            let value = solution.unknown.get(name).copied().unwrap_or(f64::NAN);
            rounded(unknown.measure, value, solution.sd.get(name).copied().flatten(), units)
        };
        let unit = units.unit(unknown.measure).to_owned();
        rows.push(std::iter::once(name.to_owned()).chain(shown.iter().map(value)).chain([unit]).collect());
    }
    let of_all = |what: &str, value: &dyn Fn(&Alternative) -> String| -> Vec<String> {
        std::iter::once(what.to_owned()).chain(shown.iter().map(value)).chain([String::new()]).collect()
    };
    rows.push(of_all("chi-square", &|solution| digits(solution.chi_square)));
    rows.push(of_all("probability", &|solution| probability(solution.probability)));
    let header: Vec<String> =
        std::iter::once("solution".to_owned()).chain((1..=shown.len()).map(|i| i.to_string())).chain(["unit".to_owned()]).collect();
    let columns = format!("l{}l", "r".repeat(shown.len()));
    let mut blocks = vec![Block::from(Table::new(header, &columns, rows).narrow())];
    if answer.solutions.len() > SHOWN {
        blocks.push(Block::item("", format!("{} more: --format json.", answer.solutions.len() - SHOWN)));
    }
    blocks
}
