//! An expression in simplified form.
//!
//! | form | kept |
//! |---|---|
//! | sum | terms with a coefficient each, like terms together, no common factor in all of them |
//! | product | powers of different bases, no number among them |
//!
//! Terms and, but for a few, factors stay in the order in which the code has them, because that is the order in which they are read. So two expressions can be
//! equal, or opposite, in another order: [`Expression::likeness`] says.

use super::likeness::trace;
use alloc::sync::Arc;
use alloc::vec::Vec;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

/// A simplified expression; a clone is the same one.
#[derive(Clone, Debug)]
pub(super) struct Expression(Arc<Node>);

#[derive(Debug)]
struct Node {
    form: Form,
    trace: u64,
}

/// What an expression is.
#[derive(Debug)]
pub(super) enum Form {
    Number(BigRational),
    Variable(Arc<str>),
    /// A quantity that has a name, and what it is.
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

/// A term of a sum; neither a sum nor a number but 1.
#[derive(Clone, Debug)]
pub(super) struct Term {
    pub(super) coefficient: BigRational,
    pub(super) of: Expression,
}

/// A factor of a product; neither a product nor a number, except that a division by zero stays as it is.
#[derive(Clone, Debug)]
pub(super) struct Factor {
    pub(super) base: Expression,
    pub(super) exponent: i64,
}

/// `yes` where `left < right`, else `no`.
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
    /// The variables that it is differentiated by, one after the other.
    pub(super) by: Vec<Arc<str>>,
}

impl Name {
    /// Of a quantity.
    pub(super) fn of(symbol: &str) -> Name {
        Name { symbol: symbol.into(), by: Vec::new() }
    }

    /// Of its derivative.
    pub(super) fn derivative(&self, variable: &Arc<str>) -> Name {
        let mut by = self.by.clone();
        by.push(variable.clone());
        Name { symbol: self.symbol.clone(), by }
    }
}

impl Expression {
    /// As it is: the constructors in `build.rs` simplify.
    pub(super) fn new(form: Form) -> Expression {
        let trace = trace(&form);
        Expression(Arc::new(Node { form, trace }))
    }

    /// Equal for expressions that are equal or opposite.
    pub(super) fn trace(&self) -> u64 {
        self.0.trace
    }

    pub(super) fn form(&self) -> &Form {
        &self.0.form
    }

    /// Its identity, which its clones share, for as long as one of them lives.
    pub(super) fn identity(&self) -> usize {
        Arc::as_ptr(&self.0).addr()
    }

    /// The number that it is.
    pub(super) fn as_number(&self) -> Option<&BigRational> {
        match self.form() {
            Form::Number(number) => Some(number),
            _ => None,
        }
    }

    pub(super) fn is_zero(&self) -> bool {
        self.as_number().is_some_and(Zero::is_zero)
    }

    /// Whether it has two terms or more.
    pub(super) fn has_terms(&self) -> bool {
        matches!(self.form(), Form::Sum(terms) if terms.len() > 1)
    }

    /// Itself as a sum.
    pub(super) fn terms(&self) -> Vec<Term> {
        match self.form() {
            Form::Sum(terms) => terms.clone(),
            Form::Number(number) if number.is_zero() => Vec::new(),
            Form::Number(number) => Vec::from([Term { coefficient: number.clone(), of: Expression::int(1) }]),
            _ => Vec::from([Term { coefficient: One::one(), of: self.clone() }]),
        }
    }

    /// Itself as a number times a product. What a sum has in all its coefficients is in the number, its sign if all of them are negative.
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

    /// The expressions that it is made of.
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
    /// What it is the magnitude of, if it is one.
    pub(super) fn magnitude(&self) -> Option<&Expression> {
        let Choice { left, right, yes, no } = self;
        (right.is_zero() && no.equals(left) && yes.equals(&no.negative())).then_some(no)
    }
}

/// The greatest number that all coefficients are integer multiples of; negative if all of them are.
fn content(terms: &[Term]) -> BigRational {
    let coefficients = || terms.iter().map(|term| &term.coefficient);
    let content = if coefficients().all(BigRational::is_integer) && coefficients().any(|c| c.numer().magnitude().is_one()) {
        One::one()
    } else {
        coefficients().fold(BigRational::zero(), |content, coefficient| common_measure(content, coefficient.clone()))
    };
    if coefficients().all(Signed::is_negative) { -content } else { content }
}

/// Euclid's algorithm.
fn common_measure(mut a: BigRational, mut b: BigRational) -> BigRational {
    while !b.is_zero() {
        (a, b) = (b.clone(), a % b);
    }
    a.abs()
}
