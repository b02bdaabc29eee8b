//! The scalar types on which the mechanics is evaluated.
//!
//! | type | purpose |
//! |---|---|
//! | [`Residues`] | the value of an expression modulo six primes at once: the basis of the proofs |
//! | [`Size`] | bounds on the polynomials behind that value: the basis of the error probability |
//! | [`Rational`] | the value in exact fractions, by independent arithmetic: a cross-check |
//! | [`Dual`] | a value and its derivative, over any of these |
//!
//! Residues, sizes and duals are not [`Ordered`](planar_impact::Ordered), so the compiler rejects code that compares or selects:
//!
//! ```compile_fail,E0277
//! use planar_impact_proofs::scalar::Residues;
//! fn friction<T: planar_impact::Ordered>() {}
//! friction::<Residues>();
//! ```

mod dual;
mod partial;
mod residues;
mod size;

pub use dual::Dual;
pub use partial::{Partial, Ring};
pub use residues::{Lanes, PRIMES, Residues};
pub use size::{Extent, Size};

/// An exact fraction, or undefined.
pub type Rational = Partial<num_rational::BigRational>;
