//! Proves an identity: the bound on its degree, the points, and the probability of error.
//!
//! # The argument
//!
//! An equation of an identity states that left − right is zero, a rational function N/D of the free variables with
//! integer coefficients. Suppose it is false: then N is not the zero polynomial. Its degree is at most d, and each of
//! its coefficients is smaller than the product of [`PRIMES`](crate::scalar::PRIMES); both bounds are found by
//! running the same code on [`Size`]. So one of the primes, p, does not divide one of the coefficients, and N is not
//! zero modulo p. By the lemma of Schwartz and Zippel, N is zero at a point drawn uniformly modulo p with a
//! probability of at most d/p.
//!
//! A point at which a divisor is zero gives no information and is drawn again, at most [`REDRAWS`] times. To pass
//! with n points, a false identity needs n zeros of N among the first n + [`REDRAWS`] points, which has a probability
//! of at most C(n + [`REDRAWS`], n) (d/p)ⁿ. The number n is the smallest for which this is below 2⁻¹¹⁰, so that the
//! probability that any one of up to a thousand identities is false stays below 2⁻¹⁰⁰.

use std::fmt;

use num_bigint::BigUint;
use num_rational::BigRational;
use num_traits::One;
use rand::rngs::ChaCha20Rng;
use rand::{RngExt, SeedableRng};

use crate::equation::Equation;
use crate::free::Free;
use crate::identity::{Form, Identity};
use crate::scalar::{Extent, Lanes, PRIMES, Partial, Rational, Residues, Ring, Size};

/// A proof requires a probability of error of at most 2 to the power of minus this.
pub const ERROR_BITS: u64 = 110;

/// Maximum number of points that may be redrawn because of a division by zero.
pub const REDRAWS: u64 = 2;

/// Number of additional points in exact fractions at which an identity is evaluated.
pub const FRACTIONS: u64 = 20;

/// Maximum number of redrawn points in fractions, which are small and often cause divisions by zero.
const FRACTION_REDRAWS: u64 = 200;

/// An identity, and the evidence for it.
#[derive(Clone, Debug)]
pub struct Proof {
    /// The identity.
    pub identity: Identity,
    /// An upper bound on the degree of its equations, cleared of fractions.
    pub degree: u64,
    /// Number of bits that suffice for each of their coefficients.
    pub coefficient_bits: u64,
    /// Number of points at which it was evaluated modulo each prime.
    pub points: u64,
    /// Number of points that had to be redrawn.
    pub redrawn: u64,
    /// Number of points at which it was evaluated in exact fractions.
    pub fractions: u64,
    /// A false identity would pass with a probability of at most 2 to the power of minus this.
    pub error_bits: u64,
    /// The verdict.
    pub verdict: Verdict,
}

/// Result of an attempt to prove an identity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Verdict {
    /// It holds, except for the probability of error.
    Holds,
    /// It is false: one of its equations fails at a point.
    False {
        /// The arithmetic in which it fails.
        by: Arithmetic,
        /// The number of the equation within the identity, counted from 1.
        equation: usize,
    },
    /// It contains no equation.
    Empty,
    /// Its coefficients may be larger than the product of the primes.
    TooLarge,
    /// A division by zero occurred at too many points.
    Undefined(Arithmetic),
}

/// The numbers on which an identity is evaluated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Arithmetic {
    /// Residues modulo the primes.
    Residues,
    /// Exact fractions.
    Fractions,
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Verdict::Holds => write!(f, "it holds"),
            Verdict::False { by, equation } => write!(f, "equation {equation} of it fails at a point, in {by}"),
            Verdict::Empty => write!(f, "it has no equation"),
            Verdict::TooLarge => write!(f, "its coefficients may be multiples of all the primes"),
            Verdict::Undefined(by) => write!(f, "it divides by zero too often, in {by}"),
        }
    }
}

impl fmt::Display for Arithmetic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Arithmetic::Residues => "residues",
            Arithmetic::Fractions => "fractions",
        })
    }
}

impl Proof {
    /// Evaluates an identity. `stream` separates its points from those of the others.
    pub(crate) fn of(identity: Identity, seed: u64, stream: u64) -> Self {
        let equations = (identity.size)(&mut Free::new(&mut Size::variable));
        let count = equations.len();
        let extent = equations.into_iter().map(|Equation { left, right }| (left - right).numerator().clone()).reduce(Extent::or);
        let Extent { degree, norm } = extent.unwrap_or(Extent { degree: 0, norm: BigUint::one() });
        let points = points_for(degree);
        let mut proof = Proof {
            identity,
            degree,
            coefficient_bits: norm.bits(),
            points,
            redrawn: 0,
            fractions: FRACTIONS,
            error_bits: error_bits(degree, points),
            verdict: Verdict::Holds,
        };
        let product: BigUint = PRIMES.into_iter().map(BigUint::from).product();
        proof.verdict = if count == 0 {
            Verdict::Empty
        } else if norm >= product {
            Verdict::TooLarge
        } else {
            let mut rng = ChaCha20Rng::seed_from_u64(seed);
            rng.set_stream(stream);
            proof.tried(&mut rng)
        };
        proof
    }

    /// Returns `true` if it holds with a sufficiently small probability of error.
    pub fn holds(&self) -> bool {
        self.verdict == Verdict::Holds && self.error_bits >= ERROR_BITS
    }

    fn tried(&mut self, rng: &mut ChaCha20Rng) -> Verdict {
        let by_residues = Trial { points: self.points, redraws: REDRAWS };
        match by_residues.of(self.identity.residues, || Residues::defined(Lanes::draw(rng))) {
            Ok(redrawn) => self.redrawn = redrawn,
            Err(failure) => return failure.verdict(Arithmetic::Residues),
        }
        let by_fractions = Trial { points: self.fractions, redraws: FRACTION_REDRAWS };
        by_fractions.verdict(self.identity.rational, || fraction(rng))
    }
}

/// Draws a small fraction.
pub(crate) fn fraction(rng: &mut ChaCha20Rng) -> Rational {
    let (numerator, denominator): (i32, i32) = (rng.random_range(-9..=9), rng.random_range(1..=3));
    Rational::defined(BigRational::new(numerator.into(), denominator.into()))
}

/// Returns the binary logarithm, rounded down, of 1/(C(n + r, n) (d/p)ⁿ), where p is the smallest prime.
fn error_bits(degree: u64, points: u64) -> u64 {
    let smallest = PRIMES.into_iter().min().expect("there are primes");
    // A polynomial of degree zero has no zeros unless it is zero; treating it as of degree 1 only increases the bound.
    let degree = degree.max(1);
    let choices: BigUint = (1..=REDRAWS).fold(BigUint::one(), |choices, r| choices * (points + r) / r);
    let exponent = u32::try_from(points).expect("a few points");
    let ratio = BigUint::from(smallest).pow(exponent) / (choices * BigUint::from(degree).pow(exponent));
    ratio.bits().saturating_sub(1)
}

/// Returns the smallest number of points for which the probability of error is below its limit.
fn points_for(degree: u64) -> u64 {
    let enough = (2..100).find(|&points| error_bits(degree, points) >= ERROR_BITS);
    // Only a degree close to the primes themselves would need more, and its proof fails.
    enough.unwrap_or(100)
}

/// Number of points of a trial, and how many may be redrawn.
pub(crate) struct Trial {
    pub(crate) points: u64,
    pub(crate) redraws: u64,
}

/// Reason why a trial failed.
enum Failure {
    Differs { equation: usize },
    Undefined,
}

impl Failure {
    fn verdict(self, by: Arithmetic) -> Verdict {
        match self {
            Failure::Differs { equation } => Verdict::False { by, equation },
            Failure::Undefined => Verdict::Undefined(by),
        }
    }
}

impl Trial {
    /// Returns the verdict of evaluating an identity in fractions.
    pub(crate) fn verdict(&self, form: Form<Rational>, draw: impl FnMut() -> Rational) -> Verdict {
        self.of(form, draw).map_or_else(|failure| failure.verdict(Arithmetic::Fractions), |_| Verdict::Holds)
    }

    /// Evaluates an identity at its points, and returns the number of redrawn points.
    fn of<T: Ring + PartialEq>(&self, form: Form<Partial<T>>, mut draw: impl FnMut() -> Partial<T>) -> Result<u64, Failure> {
        let (mut passed, mut redrawn) = (0, 0);
        while passed < self.points {
            let equations = form(&mut Free::new(&mut draw));
            let undefined = equations.iter().any(|sides| sides.left.value().is_none() || sides.right.value().is_none());
            if undefined {
                redrawn += 1;
                if redrawn > self.redraws {
                    return Err(Failure::Undefined);
                }
            } else if let Some(place) = equations.iter().position(|sides| sides.left != sides.right) {
                return Err(Failure::Differs { equation: place + 1 });
            } else {
                passed += 1;
            }
        }
        Ok(redrawn)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::equation::Equations;
    use crate::identity::identity;
    use planar_impact::Field;

    fn square_of_a_sum<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
        let (a, b) = (free.variable(), free.variable());
        let mut must = Equations::new();
        let expanded = a.clone().squared() + T::int(2) * a.clone() * b.clone() + b.clone().squared();
        must.equal((a + b).squared(), expanded);
        must
    }

    fn square_of_a_difference<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
        let (a, b) = (free.variable(), free.variable());
        let mut must = Equations::new();
        let expanded = a.clone().squared() + T::int(2) * a.clone() * b.clone() + b.clone().squared();
        must.equal((a - b).squared(), expanded);
        must
    }

    #[test]
    fn a_true_identity_is_proven_with_its_degree() {
        let proof = Proof::of(identity!(square_of_a_sum, "(a + b)²", "a² + 2ab + b²"), 1, 0);
        assert!(proof.holds(), "{proof:?}");
        // 1 + 2 + 1 on the left, and the same on the right.
        assert_eq!((proof.degree, proof.coefficient_bits, proof.redrawn), (2, 4, 0));
    }

    #[test]
    fn a_wrong_sign_is_found() {
        for seed in 0..20 {
            let proof = Proof::of(identity!(square_of_a_difference, "(a − b)²", "a² + 2ab + b²"), seed, 0);
            assert_eq!(proof.verdict, Verdict::False { by: Arithmetic::Residues, equation: 1 });
            assert!(!proof.holds());
        }
    }

    #[test]
    fn the_error_is_that_of_the_lemma() {
        // (2⁶¹ − 283)²/6 = 2^119.4 at degree 1; at degree 2³⁰ each point contributes 31 bits, minus the C(n + 2, 2) choices.
        assert_eq!(error_bits(1, 2), 119);
        assert_eq!(error_bits(0, 2), 119);
        assert_eq!(error_bits(1 << 30, 4), 4 * 31 - 4);
        assert_eq!((points_for(1), points_for(100), points_for(1 << 30)), (2, 3, 4));
    }
}
