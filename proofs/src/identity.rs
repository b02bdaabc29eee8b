//! The identities, by subject.
//!
//! An identity is a function written once over any field: it takes free variables and returns the numbers that must
//! be equal. The arithmetic on which it is evaluated determines what it shows. Each file begins with the list of its
//! identities.

mod compliance;
mod crash3;
mod crush;
mod derivative;
mod energy;
mod frame;
mod law;
mod limit;
mod momentum;
mod paper;
mod plane;
pub(crate) mod scene;
mod symmetry;

use crate::equation::Equations;
use crate::free::Free;
use crate::scalar::{Rational, Residues, Size};

/// An identity over one kind of number.
pub(crate) type Form<T> = fn(&mut Free<'_, T>) -> Equations<T>;

/// An identity of the model.
#[derive(Clone, Copy, Debug)]
pub struct Identity {
    /// The identity, in a few words.
    pub name: &'static str,
    /// The identity, in symbols.
    pub statement: &'static str,
    /// The numbers of the paper's equations that it covers; empty if there are none.
    pub equations: &'static str,
    pub(crate) size: Form<Size>,
    pub(crate) residues: Form<Residues>,
    pub(crate) rational: Form<Rational>,
}

/// The identities of one subject.
#[derive(Clone, Debug)]
pub struct Subject {
    /// The subject.
    pub name: &'static str,
    /// The identities.
    pub identities: Vec<Identity>,
}

/// Creates an identity from a function that is generic over the field, with the paper's equation numbers if it has any.
macro_rules! identity {
    ($function:ident, $name:literal, $statement:literal) => {
        $crate::identity::identity!($function, $name, $statement, "")
    };
    ($function:ident, $name:literal, $statement:literal, $equations:literal) => {
        $crate::identity::Identity {
            name: $name,
            statement: $statement,
            equations: $equations,
            size: $function,
            residues: $function,
            rational: $function,
        }
    };
}
pub(crate) use identity;

/// Returns all subjects, in the order of the argument.
pub fn subjects() -> Vec<Subject> {
    vec![
        Subject { name: "Frames", identities: frame::all() },
        Subject { name: "Momentum", identities: momentum::all() },
        Subject { name: "Compliance", identities: compliance::all() },
        Subject { name: "Laws of impact", identities: law::all() },
        Subject { name: "Energy", identities: energy::all() },
        Subject { name: "The crush plane", identities: plane::all() },
        Subject { name: "Symmetry", identities: symmetry::all() },
        Subject { name: "Special cases", identities: limit::all() },
        Subject { name: "Derivatives", identities: derivative::all() },
        Subject { name: "Crush energy", identities: crush::all() },
        Subject { name: "CRASH3", identities: crash3::all() },
        Subject { name: "The paper's equations", identities: paper::all() },
    ]
}
