//! The answer and its verdict.

use super::determined::Direction;
use super::solution::{self, Solution};
use super::variable::Variable;

/// Overall verdict on the solutions. Only with [`Verdict::Agrees`] is the best one the answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Verdict {
    /// There is one solution, and the evidence agrees with it. It may still be weakly determined: see the standard deviations, and
    /// [`Solution::hardly_determined`].
    Agrees,
    /// There are several solutions that the evidence agrees with.
    SeveralSolutions,
    /// Underdetermined: the evidence does not constrain some combinations of the unknowns.
    Undetermined,
    /// Inconsistent evidence: the minimum chi-square is more than its uncertainty explains.
    Contradicted,
    /// The best fit lies outside the given bounds; within them the evidence does not agree.
    BoundsExclude,
}

impl Verdict {
    /// Returns its name in reports.
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

/// The answer to a [`ReconstructionProblem`](super::ReconstructionProblem).
#[derive(Clone, Debug, PartialEq)]
pub struct Answer {
    /// Overall verdict on the solutions.
    pub verdict: Verdict,
    /// Every solution that fits about as well as the best; the best first. Never empty.
    pub solutions: Vec<Solution>,
    /// Other local minima that fit significantly worse than the best.
    pub worse: Vec<Solution>,
    /// Combinations of the unknowns that the evidence does not constrain at the best solution.
    pub not_determined: Vec<Direction>,
    /// With [`Verdict::BoundsExclude`], the solution without the given bounds.
    pub without_bounds: Option<Box<Solution>>,
    /// Number of searches: one from each start, and those near their results.
    pub searches: usize,
    /// Number of searches that converged.
    pub converged: usize,
}

impl Answer {
    /// The probability below which the evidence is inconsistent.
    pub const CONTRADICTION: f64 = solution::CONTRADICTION;

    /// Returns the best solution.
    ///
    /// # Panics
    ///
    /// If all solutions have been removed from the answer.
    pub fn best(&self) -> &Solution {
        &self.solutions[0]
    }

    /// Returns `true` if the evidence constrains all unknowns at the best solution, so that it is not one of many that are as good, whatever the verdict.
    pub fn is_one(&self) -> bool {
        self.not_determined.is_empty()
    }

    /// Returns `true` if the evidence determines an unknown.
    pub fn determines(&self, unknown: Variable) -> bool {
        !self.not_determined.iter().any(|direction| direction.variables().any(|variable| variable == unknown))
    }
}
