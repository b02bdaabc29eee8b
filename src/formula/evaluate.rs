//! Evaluation of an expression on any real scalar.

use super::expression::{Choice, Expression, Factor, Form};
use crate::scalar::Real;
use crate::scalar::symbol::in_field;
use alloc::collections::BTreeMap;

impl Expression {
    /// Evaluates the expression, given the value of each variable. Shared parts are computed once.
    pub(super) fn evaluate<T: Real>(&self, mut variable: impl FnMut(&str) -> T) -> T {
        self.computed(&mut variable, &mut BTreeMap::new())
    }

    fn computed<T: Real>(&self, variable: &mut impl FnMut(&str) -> T, done: &mut BTreeMap<usize, T>) -> T {
        if let Some(value) = done.get(&self.identity()) {
            return value.clone();
        }
        let mut of = |expression: &Expression| expression.computed(variable, done);
        let value = match self.form() {
            Form::Number(number) => in_field(number),
            Form::Variable(name) => variable(name),
            Form::Named(_, value) => of(value),
            Form::Sum(terms) => {
                let terms = terms.iter().map(|term| in_field::<T>(&term.coefficient) * of(&term.of));
                terms.reduce(|sum, term| sum + term).expect("a sum has terms")
            }
            Form::Product(factors) => {
                let (above, below): (alloc::vec::Vec<&Factor>, _) = factors.iter().partition(|factor| factor.exponent > 0);
                let mut product = |factors: alloc::vec::Vec<&Factor>| {
                    let powers = factors.into_iter().map(|factor| raised(of(&factor.base), factor.exponent.unsigned_abs()));
                    powers.reduce(|product, power| product * power).unwrap_or_else(|| T::int(1))
                };
                let above = product(above);
                if below.is_empty() { above } else { above / product(below) }
            }
            Form::Root(a) => of(a).square_root(),
            Form::Sine(a) => of(a).sin_and_cos().0,
            Form::Cosine(a) => of(a).sin_and_cos().1,
            // Real numbers have one zero, the positive one.
            Form::Angle { y, x } => (of(y) + T::int(0)).arctangent(of(x) + T::int(0)),
            Form::Choice(Choice { left, right, yes, no }) => {
                let mask = of(left).less(&of(right));
                T::select(mask, of(yes), of(no))
            }
        };
        done.insert(self.identity(), value.clone());
        value
    }
}

/// Computes a power by squaring.
fn raised<T: Real>(base: T, exponent: u64) -> T {
    if exponent <= 1 {
        return base;
    }
    let half = raised(base.clone(), exponent / 2).squared();
    if exponent.is_multiple_of(2) { half } else { half * base }
}
