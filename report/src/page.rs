//! One page for each answer.

pub mod compare;
pub mod crash3;
pub mod crush;
pub mod crush_plane_bracket;
pub mod formula;
pub mod gradient;
mod points;
pub mod prove;
pub mod reconstruct;
pub mod record;
mod rounding;
pub mod rules;
pub mod slide;
pub mod solve;
pub mod stiffness;
pub mod sweep;
pub mod sweep_csv;
pub mod uncertainty;
pub mod uncertainty_csv;
pub mod validate;

use planar_impact_app::plain_text::shorten;
use planar_impact_app::{Answer, Units};

use crate::block::Block;

/// The facts of a verb, as blocks.
pub trait Facts {
    /// The answer in a few sentences, in a system of units; none where a table says it at a glance.
    fn summary(&self, _: Units) -> Vec<Block> {
        Vec::new()
    }

    /// All facts in a system of units, without summary, title and notices.
    fn blocks(&self, units: Units) -> Vec<Block>;
}

/// The page of an answer: its title, its summary, its facts, its notices.
pub fn page(answer: &Answer<impl Facts>, units: Units) -> Vec<Block> {
    let blocks = answer.facts.summary(units).into_iter().chain(answer.facts.blocks(units)).collect();
    framed(answer, blocks, units)
}

/// Blocks of an answer between its title and its notices.
fn framed<T>(answer: &Answer<T>, blocks: Vec<Block>, units: Units) -> Vec<Block> {
    Block::title(&answer.title).into_iter().chain(blocks).chain(Block::notices(&answer.notices, units)).collect()
}

/// The widest name of a vehicle in a summary.
const SUMMARY_WIDTH: usize = 40;

/// The widest name of a vehicle in the head of a column.
const NAME_WIDTH: usize = 18;

/// The names of two vehicles as heads of columns.
fn heads(names: [&str; 2]) -> [String; 2] {
    names.map(|name| shorten(name, NAME_WIDTH))
}
