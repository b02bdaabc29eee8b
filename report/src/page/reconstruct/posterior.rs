//! The posterior of the unknowns.

use planar_impact_app::named::Named;
use planar_impact_app::reconstruct::{Posterior, Reconstruction};
use planar_impact_app::units::{Measure, Units};

use super::unknowns::from;
use crate::block::{Block, Table};
use crate::page::rounding::rounded;

/// Renders means, medians and shortest ranges, then the probabilities that were asked for; nothing without a posterior.
pub fn blocks(answer: &Reconstruction, units: Units) -> Vec<Block> {
    let Some(draws) = &answer.posterior else { return Vec::new() };
    let all = answer.estimates().filter_map(|of| Some((of.name, of.measure, of.posterior?)));
    let rows = all.flat_map(|(name, measure, posterior)| {
        let road = units.on_the_road(measure).map(|road| row("", road, posterior, units));
        [Some(row(name, measure, posterior, units)), road].into_iter().flatten()
    });
    let header = ["posterior", "mean", "+/- sd", "median", &from(answer), "to", "unit"];
    let mut blocks = vec![Table::new(header, "lrrrrrl", rows.collect()).narrow().with_optional(2).into()];
    let converged = match (draws.r_hat, draws.ess) {
        (Some(r_hat), Some(ess)) => format!(": R-hat at most {r_hat:.3}, at least {ess:.0} independent draws"),
        _ => String::new(),
    };
    let text = format!(
        "{} chains of {} draws with seed {} (--seed){converged}. The range is the shortest that has this probability.",
        draws.chains, draws.draws, draws.seed
    );
    blocks.push(Block::paragraph(text));
    blocks.extend(answer.probabilities.iter().flat_map(Named::iter).map(|(statement, probability)| {
        let error = draws.standard_error(*probability);
        Block::item("- ", format!("probability of {statement}: {probability:.3} ± {error:.3}"))
    }));
    blocks
}

fn row(name: &str, measure: Measure, posterior: &Posterior, units: Units) -> Vec<String> {
    let number = |value: f64| rounded(measure, value, Some(posterior.sd), units);
    let [low, high] = posterior.hdi;
    let unit = units.unit(measure).to_owned();
    vec![name.to_owned(), number(posterior.mean), number(posterior.sd), number(posterior.median), number(low), number(high), unit]
}
