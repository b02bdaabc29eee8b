//! What the answer is worth, in one word.

use super::determined::Direction;
use super::solution::Solution;
use super::variable::Variable;

/// What the solutions are worth. Only of [`Verdict::Agrees`] can the best be taken as the answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Verdict {
    /// There is one solution, and the evidence agrees with it. That does not say how well it is known: see the standard deviations, and
    /// [`Solution::hardly_determined`].
    Agrees,
    /// There are several solutions that the evidence agrees with.
    SeveralSolutions,
    /// The evidence leaves some of the unknowns open.
    Undetermined,
    /// The evidence contradicts itself: what it is least off by is more than its uncertainty explains.
    Contradicted,
    /// The evidence agrees, but outside the given bounds; within them it does not.
    BoundsExclude,
}

impl Verdict {
    /// Its name in reports.
    pub fn name(self) -> &'static str {
        match self {
            Verdict::Agrees => "agrees",
            Verdict::SeveralSolutions => "several solutions",
            Verdict::Undetermined => "undetermined",
            Verdict::Contradicted => "contradicted",
            Verdict::BoundsExclude => "bounds exclude",
        }
    }
}

/// The answer to a [`Reconstruction`](super::Reconstruction).
#[derive(Clone, Debug, PartialEq)]
pub struct Answer {
    /// What the solutions are worth.
    pub verdict: Verdict,
    /// Every solution that is as good as the best, or nearly; the best first. Never empty.
    pub solutions: Vec<Solution>,
    /// Least sums of squares that the search came upon and that the evidence tells from the best.
    pub worse: Vec<Solution>,
    /// The ways in which the unknowns of the best can move without the evidence noticing.
    pub not_determined: Vec<Direction>,
    /// With [`Verdict::BoundsExclude`], the solution without the given bounds.
    pub without_bounds: Option<Box<Solution>>,
    /// How many searches there were: from each start, and beside what those had found.
    pub searches: usize,
    /// How many of them reached a least sum of squares.
    pub converged: usize,
}

impl Answer {
    /// The probability below which chance does not explain what the evidence is off by.
    pub const CONTRADICTION: f64 = 1e-3;

    /// The best solution.
    ///
    /// # Panics
    ///
    /// When all solutions have been taken out of the answer.
    pub fn best(&self) -> &Solution {
        &self.solutions[0]
    }

    /// Whether the evidence determines an unknown.
    pub fn determines(&self, unknown: Variable) -> bool {
        !self.not_determined.iter().any(|direction| direction.variables().any(|variable| variable == unknown))
    }
}
