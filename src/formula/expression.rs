//! An expression in simplified form.
//!
//! | form | invariant |
//! |---|---|
//! | sum | terms with a coefficient each, like terms together, no common factor in all of them |
//! | product | powers of different bases, no number among them |
//!
//! Terms and, with few exceptions, factors stay in the order of the code, which is the order in which they are read. So two expressions can be equal, or
//! opposite, in a different order: see [`Expression::equivalence`].

use super::structural_hash::{mix, of_magnitude, of_text};
use alloc::sync::Arc;
use alloc::vec::Vec;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

/// A simplified expression; a clone shares its identity.
#[derive(Clone, Debug)]
pub(super) struct Expression(Arc<Node>);

#[derive(Debug)]
struct Node {
    form: Form,
    structural_hash: u64,
}

/// The form of an expression.
#[derive(Debug)]
pub(super) enum Form {
    Number(BigRational),
    Variable(Arc<str>),
    /// A quantity that has a name, and its value.
    Named(Name, Expression),
    /// Two terms or more, or one with a coefficient.
    Sum(Vec<Term>),
    /// Two factors or more, or one with an exponent.
    Product(Vec<Factor>),
    Root(Expression),
    Sine(Expression),
    Cosine(Expression),
    /// The direction of (x, y).
    Angle {
        y: Expression,
        x: Expression,
    },
    Choice(Choice),
}

/// A term of a sum: neither a sum nor a number other than 1.
#[derive(Clone, Debug)]
pub(super) struct Term {
    pub(super) coefficient: BigRational,
    pub(super) of: Expression,
}

/// A factor of a product: neither a product nor a number, except that a division by zero is kept.
#[derive(Clone, Debug)]
pub(super) struct Factor {
    pub(super) base: Expression,
    pub(super) exponent: i64,
}

/// `yes` if `left < right`, otherwise `no`.
#[derive(Clone, Debug)]
pub(super) struct Choice {
    pub(super) left: Expression,
    pub(super) right: Expression,
    pub(super) yes: Expression,
    pub(super) no: Expression,
}

/// The name of a quantity, or of its derivative.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Name {
    pub(super) symbol: Arc<str>,
    /// The variables by which it is differentiated, in order.
    pub(super) by: Vec<Arc<str>>,
}

impl Name {
    /// Creates the name of a quantity.
    pub(super) fn of(symbol: &str) -> Name {
        Name { symbol: symbol.into(), by: Vec::new() }
    }

    /// Returns the name of its derivative.
    pub(super) fn derivative(&self, variable: &Arc<str>) -> Name {
        let mut by = self.by.clone();
        by.push(variable.clone());
        Name { symbol: self.symbol.clone(), by }
    }
}

impl Expression {
    /// Creates an expression without simplifying: the constructors in `build.rs` simplify.
    pub(super) fn new(form: Form) -> Expression {
        let structural_hash = structural_hash(&form);
        Expression(Arc::new(Node { form, structural_hash }))
    }

    /// Returns a hash that is the same for expressions that are equal or opposite.
    pub(super) fn structural_hash(&self) -> u64 {
        self.0.structural_hash
    }

    pub(super) fn form(&self) -> &Form {
        &self.0.form
    }

    /// Returns its identity, which it shares with its clones, valid as long as one of them lives.
    pub(super) fn identity(&self) -> usize {
        Arc::as_ptr(&self.0).addr()
    }

    /// Returns the number, if it is one.
    pub(super) fn as_number(&self) -> Option<&BigRational> {
        match self.form() {
            Form::Number(number) => Some(number),
            _ => None,
        }
    }

    pub(super) fn is_zero(&self) -> bool {
        self.as_number().is_some_and(Zero::is_zero)
    }

    /// Returns `true` if it has two or more terms.
    pub(super) fn has_terms(&self) -> bool {
        matches!(self.form(), Form::Sum(terms) if terms.len() > 1)
    }

    /// Returns its terms as a sum.
    pub(super) fn terms(&self) -> Vec<Term> {
        match self.form() {
            Form::Sum(terms) => terms.clone(),
            Form::Number(number) if number.is_zero() => Vec::new(),
            Form::Number(number) => Vec::from([Term { coefficient: number.clone(), of: Expression::int(1) }]),
            _ => Vec::from([Term { coefficient: One::one(), of: self.clone() }]),
        }
    }

    /// Returns it as a number times a product. The number contains the common factor of the coefficients of a sum, negative if all of them are.
    pub(super) fn factors(&self) -> (BigRational, Vec<Factor>) {
        let single = |base: &Expression| Vec::from([Factor { base: base.clone(), exponent: 1 }]);
        match self.form() {
            Form::Number(number) => (number.clone(), Vec::new()),
            Form::Product(factors) => (One::one(), factors.clone()),
            Form::Sum(terms) if terms.len() == 1 => (terms[0].coefficient.clone(), terms[0].of.factors().1),
            Form::Sum(terms) => {
                let content = content(terms);
                if content.is_one() {
                    return (content, single(self));
                }
                let term = |term: &Term| Term { coefficient: &term.coefficient / &content, of: term.of.clone() };
                let primitive = Expression::new(Form::Sum(terms.iter().map(term).collect()));
                (content, single(&primitive))
            }
            _ => (One::one(), single(self)),
        }
    }

    /// Returns the expressions in it.
    pub(super) fn parts(&self) -> Vec<&Expression> {
        match self.form() {
            Form::Number(_) | Form::Variable(_) => Vec::new(),
            Form::Named(_, value) => Vec::from([value]),
            Form::Sum(terms) => terms.iter().map(|term| &term.of).collect(),
            Form::Product(factors) => factors.iter().map(|factor| &factor.base).collect(),
            Form::Root(a) | Form::Sine(a) | Form::Cosine(a) => Vec::from([a]),
            Form::Angle { y, x } => Vec::from([y, x]),
            Form::Choice(choice) => Vec::from([&choice.left, &choice.right, &choice.yes, &choice.no]),
        }
    }
}

impl Choice {
    /// Returns the expression whose magnitude the choice is, or `None` if it is not a magnitude.
    pub(super) fn magnitude(&self) -> Option<&Expression> {
        let Choice { left, right, yes, no } = self;
        (right.is_zero() && no.equals(left) && yes.equals(&no.negative())).then_some(no)
    }
}

/// Returns the greatest number of which all coefficients are integer multiples; negative if all of them are.
fn content(terms: &[Term]) -> BigRational {
    let coefficients = || terms.iter().map(|term| &term.coefficient);
    let content = if coefficients().all(BigRational::is_integer) && coefficients().any(|c| c.numer().magnitude().is_one()) {
        One::one()
    } else {
        coefficients().fold(BigRational::zero(), |content, coefficient| common_measure(content, coefficient.clone()))
    };
    if coefficients().all(Signed::is_negative) { -content } else { content }
}

/// Computes the common measure by Euclid's algorithm.
fn common_measure(mut a: BigRational, mut b: BigRational) -> BigRational {
    while !b.is_zero() {
        (a, b) = (b.clone(), a % b);
    }
    a.abs()
}

/// Computes a hash that differs for most distinct expressions. It ignores the order of terms and factors and all signs.
fn structural_hash(form: &Form) -> u64 {
    let of = |expression: &Expression| expression.structural_hash();
    let ordered = |kind: u64, parts: &[&Expression]| parts.iter().fold(kind, |sum, part| mix(sum ^ of(part)));
    match form {
        Form::Number(number) => of_magnitude(number),
        Form::Variable(name) => of_text(1, name),
        Form::Named(name, _) => name.by.iter().fold(of_text(2, &name.symbol), |sum, by| mix(sum ^ of_text(3, by))),
        Form::Sum(terms) => {
            let sum = terms.iter().fold(0_u64, |sum, term| sum.wrapping_add(mix(of(&term.of) ^ of_magnitude(&term.coefficient))));
            mix(4 ^ sum)
        }
        Form::Product(factors) => {
            let sum = factors.iter().fold(0_u64, |sum, factor| sum.wrapping_add(mix(of(&factor.base) ^ mix(factor.exponent as u64))));
            mix(5 ^ sum)
        }
        Form::Root(a) => ordered(6, &[a]),
        Form::Sine(a) => ordered(7, &[a]),
        Form::Cosine(a) => ordered(8, &[a]),
        Form::Angle { y, x } => ordered(9, &[y, x]),
        Form::Choice(choice) => ordered(10, &[&choice.left, &choice.right, &choice.yes, &choice.no]),
    }
}
