//! Whether two expressions are equal, or opposite, in whatever order their terms and factors are.

use super::expression::{Choice, Expression, Factor, Form, Term};
use num_rational::BigRational;

/// How two expressions are related.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Likeness {
    Equal,
    Opposite,
}

impl Likeness {
    /// The sign as a number.
    pub(super) fn sign(self) -> i32 {
        match self {
            Likeness::Equal => 1,
            Likeness::Opposite => -1,
        }
    }

    fn of(sign: i32) -> Likeness {
        if sign < 0 { Likeness::Opposite } else { Likeness::Equal }
    }
}

impl Expression {
    /// Whether it equals another, or is its opposite, in whatever order terms and factors are.
    pub(super) fn likeness(&self, other: &Expression) -> Option<Likeness> {
        if self.identity() == other.identity() {
            return Some(Likeness::Equal);
        }
        if self.trace() != other.trace() {
            return None;
        }
        let equal = |a: &Expression, b: &Expression| a.likeness(b) == Some(Likeness::Equal);
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
        all_equal.then_some(Likeness::Equal)
    }

    /// Whether it equals another.
    pub(super) fn equals(&self, other: &Expression) -> bool {
        self.likeness(other) == Some(Likeness::Equal)
    }
}

impl Factor {
    pub(super) fn equals(&self, other: &Factor) -> bool {
        self.exponent == other.exponent && self.base.equals(&other.base)
    }
}

impl Choice {
    /// Whether another has the same condition.
    pub(super) fn same_condition(&self, other: &Choice) -> bool {
        self.left.equals(&other.left) && self.right.equals(&other.right)
    }
}

/// Sums are alike if each term of one has its like in the other, with one sign for all of them.
fn sums(a: &[Term], b: &[Term]) -> Option<Likeness> {
    if a.len() != b.len() {
        return None;
    }
    let sign_to_b = |term: &Term| {
        b.iter().find_map(|other| {
            let likeness = term.of.likeness(&other.of)?;
            let coefficient = if likeness == Likeness::Equal { other.coefficient.clone() } else { -other.coefficient.clone() };
            (term.coefficient == coefficient).then_some(1).or_else(|| (term.coefficient == -coefficient).then_some(-1))
        })
    };
    let sign = sign_to_b(a.first()?)?;
    a.iter().all(|term| sign_to_b(term) == Some(sign)).then(|| Likeness::of(sign))
}

/// Products are alike if each factor of one has its like in the other.
fn products(a: &[Factor], b: &[Factor]) -> Option<Likeness> {
    if a.len() != b.len() {
        return None;
    }
    let mut sign = 1;
    for factor in a {
        let likeness = b.iter().filter(|other| other.exponent == factor.exponent).find_map(|other| factor.base.likeness(&other.base))?;
        if factor.exponent % 2 != 0 {
            sign *= likeness.sign();
        }
    }
    Some(Likeness::of(sign))
}

/// A number that tells most unlike expressions apart. It does not see the order of terms and factors, nor any sign.
pub(super) fn trace(form: &Form) -> u64 {
    let of = |expression: &Expression| expression.trace();
    let ordered = |kind: u64, parts: &[&Expression]| parts.iter().fold(kind, |sum, part| mix(sum ^ of(part)));
    match form {
        Form::Number(number) => magnitude(number),
        Form::Variable(name) => text(1, name),
        Form::Named(name, _) => name.by.iter().fold(text(2, &name.symbol), |sum, by| mix(sum ^ text(3, by))),
        Form::Sum(terms) => {
            let sum = terms.iter().fold(0_u64, |sum, term| sum.wrapping_add(mix(of(&term.of) ^ magnitude(&term.coefficient))));
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

fn magnitude(number: &BigRational) -> u64 {
    let digits = number.numer().magnitude().iter_u32_digits().chain([0]).chain(number.denom().magnitude().iter_u32_digits());
    digits.fold(11, |sum, digit| mix(sum ^ u64::from(digit)))
}

fn text(kind: u64, text: &str) -> u64 {
    text.bytes().fold(kind, |sum, byte| mix(sum ^ u64::from(byte)))
}

/// The finishing step of the generator SplitMix64, which spreads each bit over all.
fn mix(x: u64) -> u64 {
    let x = x.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}
