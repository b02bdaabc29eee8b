//! Equality and opposition of two expressions, regardless of the order of terms and factors.

use super::expression::{Choice, Expression, Factor, Form, Term};

/// Relation of two equivalent expressions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Equivalence {
    Equal,
    Opposite,
}

impl Equivalence {
    /// Returns the sign as a number.
    pub(super) fn sign(self) -> i32 {
        match self {
            Equivalence::Equal => 1,
            Equivalence::Opposite => -1,
        }
    }

    fn of(sign: i32) -> Equivalence {
        if sign < 0 { Equivalence::Opposite } else { Equivalence::Equal }
    }
}

impl Expression {
    /// Returns the equivalence if it equals another or is its opposite, regardless of the order of terms and factors.
    pub(super) fn equivalence(&self, other: &Expression) -> Option<Equivalence> {
        if self.identity() == other.identity() {
            return Some(Equivalence::Equal);
        }
        if self.structural_hash() != other.structural_hash() {
            return None;
        }
        let equal = |a: &Expression, b: &Expression| a.equivalence(b) == Some(Equivalence::Equal);
        let all_equal = match (self.form(), other.form()) {
            (Form::Sum(a), Form::Sum(b)) => return sums(a, b),
            (Form::Product(a), Form::Product(b)) => return products(a, b),
            (Form::Number(a), Form::Number(b)) => a == b,
            (Form::Variable(a), Form::Variable(b)) => a == b,
            (Form::Named(a, x), Form::Named(b, y)) => a == b && equal(x, y),
            (Form::Root(a), Form::Root(b)) | (Form::Sine(a), Form::Sine(b)) | (Form::Cosine(a), Form::Cosine(b)) => equal(a, b),
            (Form::Angle { y, x }, Form::Angle { y: v, x: u }) => equal(y, v) && equal(x, u),
            (Form::Choice(a), Form::Choice(b)) => a.same_condition(b) && equal(&a.yes, &b.yes) && equal(&a.no, &b.no),
            _ => false,
        };
        all_equal.then_some(Equivalence::Equal)
    }

    /// Returns `true` if it equals another.
    pub(super) fn equals(&self, other: &Expression) -> bool {
        self.equivalence(other) == Some(Equivalence::Equal)
    }
}

impl Factor {
    pub(super) fn equals(&self, other: &Factor) -> bool {
        self.exponent == other.exponent && self.base.equals(&other.base)
    }
}

impl Choice {
    /// Returns `true` if another has the same condition.
    pub(super) fn same_condition(&self, other: &Choice) -> bool {
        self.left.equals(&other.left) && self.right.equals(&other.right)
    }
}

/// Compares sums: they are equivalent if each term of one has its equivalent in the other, with one sign for all of them.
fn sums(a: &[Term], b: &[Term]) -> Option<Equivalence> {
    if a.len() != b.len() {
        return None;
    }
    let sign_to_b = |term: &Term| {
        b.iter().find_map(|other| {
            let equivalence = term.of.equivalence(&other.of)?;
            let coefficient = if equivalence == Equivalence::Equal { other.coefficient.clone() } else { -other.coefficient.clone() };
            (term.coefficient == coefficient).then_some(1).or_else(|| (term.coefficient == -coefficient).then_some(-1))
        })
    };
    let sign = sign_to_b(a.first()?)?;
    a.iter().all(|term| sign_to_b(term) == Some(sign)).then(|| Equivalence::of(sign))
}

/// Compares products: they are equivalent if each factor of one has its equivalent in the other.
fn products(a: &[Factor], b: &[Factor]) -> Option<Equivalence> {
    if a.len() != b.len() {
        return None;
    }
    let mut sign = 1;
    for factor in a {
        let equivalence =
            b.iter().filter(|other| other.exponent == factor.exponent).find_map(|other| factor.base.equivalence(&other.base))?;
        if factor.exponent % 2 != 0 {
            sign *= equivalence.sign();
        }
    }
    Some(Equivalence::of(sign))
}
