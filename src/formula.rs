//! Formulas of what the code computes.
//!
//! The kernel runs on [`Symbol`](crate::scalar::symbol::Symbol)s, which record its operations. The record is simplified, and quantities that the kernel
//! itself names — an arm, the compliance, the impulse — keep their names, so that a formula is a short list of definitions as in the paper. No formula is
//! written by hand: the printed formula is by construction the computed one.
//!
//! ```
//! use planar_impact::formula::Formulas;
//! use planar_impact::*;
//! # let car: Vehicle = Vehicle {
//! #     mass: 1500.0, yaw_inertia: 2500.0, heading: Heading::from_angle(0.0), impact_center: ForwardLeft { forward: 2.0, left: 0.5 },
//! #     motion: Motion { velocity: Xy { x: 15.0, y: 0.0 }, yaw_rate: 0.0 },
//! # };
//! # let collision = Collision {
//! #     one: car.into(), two: Party::Barrier, crush_plane: CrushPlane::from_angle(0.0), restitution: 0.1,
//! #     impulse_ratio: ImpulseRatio::Given(0.2), law: Law::Brach, moment: Moment::None,
//! # };
//! // A car against a barrier, at a given impulse ratio.
//! let formulas = Formulas::of(&collision);
//! let impulse = formulas.output(Output::NormalImpulse);
//! let text = impulse.to_string();
//! assert!(text.starts_with("P_n = (1 + e) v_n/(K_nn + μ K_nt)\n\nwhere\n"), "{text}");
//! assert!(text.contains("K_nn = 1/m1 + r1t²/I1\n"), "{text}");
//!
//! // Its value, and its derivative by e, at the numbers of the collision itself.
//! let given = |name: &str| Input::named(name).and_then(|input| collision.input(input)).expect("the collision has it");
//! let by_e = impulse.derivative("e");
//! assert!((impulse.evaluate(given) - collision.evaluate().impulse.n).abs() < 1e-9);
//! assert!((by_e.evaluate(given) - collision.evaluate().impulse.n / 1.1).abs() < 1e-9);
//! ```
//!
//! # Properties
//!
//! | property | test in `proptests/` |
//! |---|---|
//! | the record evaluated in f64 equals the result of the kernel, to the bit | `symbols.rs`, `the_record_is_the_kernel_to_the_bit` |
//! | the formula and its derivative by each input equal those of the kernel, exactly | `symbols.rs`, `the_formula_and_its_derivative_are_those_of_the_kernel_in_rationals` |
//! | in f64 they agree to rounding | `symbols.rs`, `the_formula_is_the_kernel_to_rounding`, `the_derivative_is_that_of_dual_numbers` |
//! | simplification preserves the value of any expression, the text states the formula, differentiation is exact | `formulas.rs`, `simplification_keeps_the_value_and_differentiation_is_exact`, `roots_and_circular_functions_keep_their_value_and_derivative` |
//! | the Rust source compiles, and computes the formula | `source.rs`, `the_source_compiles_and_computes_the_formula` |

mod build;
mod combine;
mod derivative;
mod equivalence;
mod evaluate;
mod expression;
mod glossary;
mod kernel;
mod known;
mod latex;
mod listing;
mod notation;
mod source;
mod structural_hash;
mod text;

pub use glossary::Glossary;
pub use kernel::Formulas;

use crate::scalar::Real;
use alloc::format;
use alloc::string::String;
use alloc::sync::Arc;
use alloc::vec::Vec;
use core::fmt;
use derivative::Derivative;
use expression::{Expression, Name};
use known::Known;
use listing::Listing;
use notation::Writer;

/// Returns a name as it is written in text: `Gamma` is Γ, and `dV1` is ΔV1.
pub fn written(name: &str) -> String {
    text::spaced(&text::symbol(name))
}

/// A quantity and its definition, in terms of quantities that are defined with it.
#[derive(Clone, Debug)]
pub struct Formula {
    name: Name,
    value: Expression,
    known: Arc<Known>,
}

/// One of the definitions that make a formula.
#[derive(Clone, Debug)]
pub struct Definition {
    text: [String; 2],
    value: Expression,
}

impl Formula {
    /// Returns its total derivative by a variable, through every quantity in it.
    #[must_use]
    pub fn derivative(&self, variable: &str) -> Formula {
        let variable: Arc<str> = variable.into();
        let itself = self.value.clone().named(self.name.clone());
        let value = Derivative::by(&variable, &self.known).of_quantity(&itself, &self.value);
        Formula { name: self.name.derivative(&variable), value, known: self.known.clone() }
    }

    /// Evaluates the formula, given the value of each variable. Every quantity is computed once.
    pub fn evaluate<T: Real>(&self, variable: impl FnMut(&str) -> T) -> T {
        self.value.evaluate(variable)
    }

    /// Returns the variables that it depends on.
    pub fn variables(&self) -> Vec<Arc<str>> {
        self.listing().variables
    }

    /// Returns its definitions: the formula itself, then the quantities in it, each before those that it contains.
    pub fn definitions(&self) -> Vec<Definition> {
        let listing = self.listing();
        let writer = Writer { notation: text::Text, listing: &listing };
        let definition = |entry: &listing::Entry| Definition {
            text: [text::label(&entry.label), writer.definition(&entry.value)],
            value: entry.value.clone(),
        };
        listing.entries.iter().map(definition).collect()
    }

    /// Formats the formula as text of at most `width` columns, if possible.
    pub fn text(&self, width: usize) -> String {
        let definitions = self.definitions();
        let (formula, others) = definitions.split_first().expect("a formula has a value");
        let mut text = formula.text(width);
        if !others.is_empty() {
            text += "\n\nwhere";
        }
        for definition in others {
            for line in definition.text(width.saturating_sub(2)).lines() {
                text += "\n  ";
                text += line;
            }
        }
        text
    }

    /// Formats the formula as an `aligned` environment of LaTeX mathematics.
    pub fn latex(&self) -> String {
        let listing = self.listing();
        let writer = Writer { notation: latex::Latex, listing: &listing };
        let lines: Vec<String> =
            listing.entries.iter().map(|entry| latex::definition(&latex::label(&entry.label), &writer.definition(&entry.value))).collect();
        format!("\\begin{{aligned}}\n{}\n\\end{{aligned}}", lines.join(" \\\\\n"))
    }

    /// Formats the formula as a Rust function of f64 that needs only the standard library.
    pub fn rust(&self) -> String {
        source::function(&self.listing())
    }

    fn listing(&self) -> Listing {
        let mut listing = Listing::of(&self.name, &self.value, &self.known.names());
        let order = &self.known.variables;
        listing.variables.sort_by_key(|name| order.iter().position(|known| known == name).unwrap_or(order.len()));
        listing
    }
}

impl Definition {
    /// Returns the name of the quantity as text.
    pub fn name(&self) -> String {
        text::spaced(&self.text[0])
    }

    /// Formats the definition as text of at most `width` columns, if possible.
    pub fn text(&self, width: usize) -> String {
        let [label, value] = &self.text;
        text::definition(label, value, width)
    }

    /// Evaluates the definition, given the value of each variable.
    pub fn evaluate<T: Real>(&self, variable: impl FnMut(&str) -> T) -> T {
        self.value.evaluate(variable)
    }
}

impl fmt::Display for Formula {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text(80))
    }
}
