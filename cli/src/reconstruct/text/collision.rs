//! The collision of the best solution, by planar mechanics and by CRASH3.

use planar_impact::reconstruct::Verdict;

use super::Page;
use crate::crash3;
use crate::report;
use crate::table::wrap;

impl Page<'_> {
    pub(super) fn collision(&self) -> String {
        if !self.result.has_solution() {
            return String::new();
        }
        let what = match self.verdict() {
            Verdict::Agrees => "The collision so reconstructed:",
            Verdict::SeveralSolutions => "The collision of the first solution:",
            _ => "The collision that disagrees least, which is not an answer:",
        };
        wrap(what, "") + &report::tables(&self.result.solved, &self.result.answer.best().impact, self.units)
    }

    pub(super) fn crash3(&self) -> String {
        let Some(comparison) = &self.result.crash3 else { return String::new() };
        wrap("The same evidence through CRASH3, from its crush energy, beside planar mechanics:", "")
            + &crash3::text::body(&self.result.solved, comparison, self.units)
    }
}
