//! The evidence compared with the solution, and the evidence that each unknown depends on.

use planar_impact_app::reconstruct::{Evidence, Influence, Reconstruction};
use planar_impact_app::units::{Measure, Units};

use crate::block::{Block, Table};
use crate::page::rounding::{rounded, without_sign_of_zero};

/// Smallest correlation that is shown.
const STRONG: f64 = 0.5;

/// Number of pieces of evidence shown for each unknown.
const SHOWN: usize = 4;

/// Renders residuals, strong correlations and influences.
pub fn blocks(answer: &Reconstruction, units: Units) -> Vec<Block> {
    let row = |name: String, evidence: &Evidence| {
        let number = |value| rounded(evidence.measure, value, evidence.sd, units);
        let residual = evidence.standardised_residual.map_or_else(|| "-".to_owned(), |off| without_sign_of_zero(format!("{off:.2}")));
        let sd = evidence.sd.map_or_else(|| "exact".to_owned(), number);
        vec![name, number(evidence.given), number(evidence.computed), sd, residual, units.unit(evidence.measure).to_owned()]
    };
    let (weighed, certain): (Vec<_>, Vec<_>) = answer.evidence.iter().partition(|(name, _)| answer.is_weighed(name));
    let mut rows: Vec<Vec<String>> = weighed.into_iter().map(|(name, evidence)| row(name.to_owned(), evidence)).collect();
    rows.extend(answer.priors.iter().flat_map(|priors| priors.iter()).map(|(name, prior)| row(format!("{name} (prior)"), prior)));
    rows.extend(certain.into_iter().map(|(name, evidence)| row(name.to_owned(), evidence)));
    let table = Table::new(["evidence", "given", "computed", "sd", "residual", "unit"], "lrrrrl", rows).narrow();
    let of_rest = if !answer.separations.is_empty() { "; of separations from rest on locked wheels, what the ways differ by" } else { "" };
    let mut blocks = vec![table.into(), Block::item("", format!("Residual: given less computed, in standard deviations{of_rest}."))];
    blocks.extend(correlations(answer));
    blocks.extend(influences(answer, units).map(Block::from));
    blocks
}

/// Renders the strong correlations of unknowns.
fn correlations(answer: &Reconstruction) -> Option<Block> {
    let unknowns: Vec<_> = answer.unknown.iter().collect();
    let mut pairs = Vec::new();
    for (i, (name, unknown)) in unknowns.iter().enumerate() {
        for (other, with) in &unknowns[..i] {
            let correlation = unknown.sd.and(with.sd).and(answer.correlation.get(other)?.get(name).copied().flatten());
            pairs.extend(correlation.filter(|r| r.abs() > STRONG).map(|r| format!("{other} with {name} {r:+.2}")));
        }
    }
    (!pairs.is_empty()).then(|| Block::paragraph(format!("Correlated: {}.", pairs.join("; "))))
}

/// Renders the evidence that each unknown depends on.
fn influences(answer: &Reconstruction, units: Units) -> Option<Table> {
    let mut rows = Vec::new();
    for (name, unknown) in answer.unknown.iter().filter(|(_, unknown)| unknown.sd.is_some()) {
        for (i, influence) in answer.influences(name).iter().take(SHOWN).enumerate() {
            rows.push(moved(if i == 0 { name } else { "" }, unknown.measure, influence, units));
        }
    }
    (!rows.is_empty()).then(|| Table::new(["unknown", "moves by", "when this is larger", "by its sd of"], "llll", rows).narrow())
}

fn moved(unknown: &str, measure: Measure, influence: &Influence<'_>, units: Units) -> Vec<String> {
    let quantity = |measure, value: f64| {
        let number = rounded(measure, value, Some(value.abs()), units);
        format!("{number} {}", units.unit(measure)).trim_end().to_owned()
    };
    let by = quantity(measure, influence.change);
    let sign = if by.starts_with('-') { "" } else { "+" };
    let piece = match influence.piece.strip_prefix("prior of ") {
        Some(name) => format!("{name} (prior)"),
        None => influence.piece.to_owned(),
    };
    vec![unknown.to_owned(), format!("{sign}{by}"), piece, quantity(influence.measure, influence.sd)]
}
