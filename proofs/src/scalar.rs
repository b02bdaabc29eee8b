//! The numbers that the mechanics are put through.
//!
//! | number | what it is for |
//! |---|---|
//! | [`Residues`] | the value of an expression modulo six primes at once: this is what proves |
//! | [`Size`] | how large the polynomials behind that value can be: this is what says how surely |
//! | [`Rational`] | the value in exact fractions, by other arithmetic than the first: a cross-check |
//! | [`Dual`] | a value and its derivative, over any of these |
//!
//! Residues, sizes and duals are not [`Ordered`](planar_impact::Ordered), so the compiler lets no code that compares or selects take part:
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
