//! The page of `reconstruct`: the verdict comes first.

mod diagnostics;
mod evidence;
mod guaranteed;
mod headline;
mod posterior;
mod profile;
mod separations;
mod unknowns;

use planar_impact_app::Answer;
use planar_impact_app::reconstruct::Reconstruction;
use planar_impact_app::units::Units;

use super::{Facts, framed};
use crate::block::Block;

impl Facts for Reconstruction {
    /// The verdict, and the value of each unknown with its interval.
    fn summary(&self, units: Units) -> Vec<Block> {
        headline::blocks(self, units)
    }

    /// The unknowns, the evidence, and the collision that follows.
    fn blocks(&self, units: Units) -> Vec<Block> {
        let mut blocks = unknowns(self, units);
        blocks.extend(unknowns::alternatives(self, units));
        blocks.extend(separations::alternatives(self, units));
        blocks.extend(under("Evidence", evidence::blocks(self, units)));
        blocks.extend(under("Paths to rest", separations::points(self, units)));
        blocks.extend(under("Diagnostics", diagnostics::blocks(self, units)));
        blocks.extend(under("Collision", collision(self, units)));
        if let Some(comparison) = &self.crash3 {
            let what = Block::paragraph("The same evidence through CRASH3, from its crush energy, beside planar mechanics:");
            blocks.extend(under("CRASH3", std::iter::once(what).chain(comparison.blocks(units)).collect()));
        }
        blocks.extend(under("Search", vec![search(self)]));
        blocks
    }
}

/// Puts blocks under a heading; nothing without blocks.
fn under(heading: &str, blocks: Vec<Block>) -> Vec<Block> {
    let heading = (!blocks.is_empty()).then(|| Block::Heading { level: 3, text: heading.to_owned() });
    heading.into_iter().chain(blocks).collect()
}

/// Renders the verdict, the unknowns, what follows from them, what is asked of profile, guarantee and posterior, and the other solutions, with title and notices.
pub fn brief(answer: &Answer<Reconstruction>, units: Units) -> Vec<Block> {
    let mut blocks = answer.summary(units);
    blocks.extend(unknowns(answer, units));
    blocks.extend(unknowns::alternatives(answer, units));
    blocks.extend(separations::alternatives(answer, units));
    framed(answer, blocks, units)
}

/// Renders the unknowns, what follows from them, and what is asked of profile, guarantee and posterior.
fn unknowns(answer: &Reconstruction, units: Units) -> Vec<Block> {
    let mut blocks = unknowns::blocks(answer, units);
    blocks.extend(unknowns::derived(answer, units));
    blocks.extend(profile::blocks(answer, units));
    blocks.extend(guaranteed::blocks(answer, units));
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
