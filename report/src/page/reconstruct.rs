//! The page of `reconstruct`: the verdict comes first.

mod diagnostics;
mod evidence;
mod headline;
mod posterior;
mod rounding;
mod unknowns;

use planar_impact_app::Answer;
use planar_impact_app::reconstruct::Reconstruction;
use planar_impact_app::units::Units;

use super::{Facts, framed};
use crate::block::Block;

impl Facts for Reconstruction {
    /// The verdict, the unknowns, the evidence, and the collision that follows.
    fn blocks(&self, units: Units) -> Vec<Block> {
        let answer = self;
        let mut blocks = essentials(answer, units);
        blocks.extend(unknowns::alternatives(answer, units));
        blocks.extend(evidence::blocks(answer, units));
        blocks.extend(diagnostics::blocks(answer, units));
        blocks.extend(collision(answer, units));
        if let Some(comparison) = &answer.crash3 {
            blocks.push(Block::paragraph("The same evidence through CRASH3, from its crush energy, beside planar mechanics:"));
            blocks.extend(comparison.blocks(units));
        }
        blocks.push(search(answer));
        blocks
    }
}

/// Renders the verdict, the unknowns, what follows from them and the posterior alone, with title and notices.
pub fn brief(answer: &Answer<Reconstruction>, units: Units) -> Vec<Block> {
    framed(answer, essentials(answer, units), units)
}

fn essentials(answer: &Reconstruction, units: Units) -> Vec<Block> {
    let mut blocks = headline::blocks(answer, units);
    blocks.extend(unknowns::blocks(answer, units));
    blocks.extend(unknowns::derived(answer, units));
    blocks.extend(posterior::blocks(answer, units));
    blocks
}

/// Renders the collision of the best solution.
fn collision(answer: &Reconstruction, units: Units) -> Vec<Block> {
    let Some(solution) = &answer.solution else { return Vec::new() };
    let what = match answer.verdict {
        "agrees" => "The reconstructed collision:",
        "several solutions" => "The collision of the first solution:",
        _ => "The collision of the best fit, which is not an answer:",
    };
    std::iter::once(Block::paragraph(what)).chain(solution.blocks(units)).collect()
}

/// Describes the search, so that it can be repeated.
fn search(answer: &Reconstruction) -> Block {
    let ended = match &answer.searches_at_solutions[..] {
        // Along a valley, each search ends at a different point.
        _ if answer.verdict == "undetermined" => "at different values of what is open".to_owned(),
        [one] => format!("{one} of them at this one"),
        several => several.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ") + " at the solutions in turn",
    };
    let other = match answer.other_minima.len() {
        0 => String::new(),
        1 => " One other minimum was found, which the evidence excludes.".to_owned(),
        count => format!(" {count} other minima were found, which the evidence excludes."),
    };
    // More searches start near each solution, so there are more searches than starts; if a formula gives the answer,
    // there is only one search.
    let starts = match answer.searches {
        1 => "1 search from 1 start".to_owned(),
        searches => format!("{searches} searches from {} starts", searches.min(answer.starts)),
    };
    Block::paragraph(format!(
        "{starts} (--starts), drawn with seed {} (--seed): {} converged, {ended}.{other}",
        answer.seed, answer.searches_converged
    ))
}
