//! Combining terms and factors.

use super::equivalence::Equivalence;
use super::expression::{Expression, Factor, Form, Term};
use alloc::vec::Vec;
use num_rational::BigRational;
use num_traits::{One, Zero};

/// Returns the rank of a factor in a product: 1 + e first, derivatives after symbols, and sines and cosines last.
pub(super) fn place(factor: &Expression) -> u8 {
    match factor.form() {
        Form::Sum(terms) if terms.iter().any(|term| term.of.as_number().is_some()) => 0,
        Form::Named(name, _) if !name.by.is_empty() => 2,
        Form::Sine(_) | Form::Cosine(_) => 3,
        _ => 1,
    }
}

/// Adds a term to its like term, if there is one.
pub(super) fn collect(sum: &mut Vec<Term>, term: Term) {
    for known in sum.iter_mut() {
        match known.of.equivalence(&term.of) {
            Some(Equivalence::Equal) => return known.coefficient += term.coefficient,
            Some(Equivalence::Opposite) => return known.coefficient -= term.coefficient,
            None => (),
        }
    }
    sum.push(term);
}

/// Multiplies a power with the power of the same base, if there is one.
pub(super) fn gather(number: &mut BigRational, product: &mut Vec<Factor>, factor: Factor) {
    for known in product.iter_mut() {
        if let Some(equivalence) = known.base.equivalence(&factor.base)
            && let Some(exponent) = known.exponent.checked_add(factor.exponent)
        {
            known.exponent = exponent;
            if equivalence == Equivalence::Opposite && factor.exponent % 2 != 0 {
                *number = -number.clone();
            }
            return;
        }
    }
    product.push(factor);
}

/// Factors out what all terms of the sum have in common.
pub(super) fn without_common_factors(sum: Vec<Term>) -> Expression {
    let products: Vec<Vec<Factor>> = sum.iter().map(|term| term.of.factors().1).collect();
    let of_all = |factor: &Factor| {
        let exponents = products.iter().map(|product| {
            let other = product.iter().find(|other| other.base.equals(&factor.base))?;
            (other.exponent.signum() == factor.exponent.signum()).then_some(other.exponent)
        });
        let least: Option<Vec<i64>> = exponents.collect();
        least?.into_iter().min_by_key(|exponent| exponent.unsigned_abs())
    };
    let common: Vec<(Expression, i64)> =
        products[0].iter().filter_map(|factor| of_all(factor).map(|exponent| (factor.base.clone(), exponent))).collect();
    if common.is_empty() {
        return Expression::new(Form::Sum(sum));
    }
    let divided = |term: Term| {
        let divisors: Vec<_> = common.iter().map(|(base, exponent)| (base.clone(), -exponent)).collect();
        Expression::product([(term.of, 1)].into_iter().chain(divisors)).times(&term.coefficient).terms()
    };
    let rest = Expression::sum(sum.into_iter().flat_map(divided));
    Expression::product(common.into_iter().chain([(rest, 1)]))
}

/// Returns the powers with the squares of roots resolved, or `None` if there are none.
pub(super) fn without_squared_roots(product: &[Factor]) -> Option<Vec<(Expression, i64)>> {
    product.iter().any(|factor| matches!(factor.base.form(), Form::Root(_)) && factor.exponent.abs() > 1).then(|| {
        let resolved = |factor: &Factor| match factor.base.form() {
            Form::Root(of) => [(of.clone(), factor.exponent / 2), (factor.base.clone(), factor.exponent % 2)],
            _ => [(factor.base.clone(), factor.exponent), (Expression::int(1), 1)],
        };
        product.iter().flat_map(resolved).collect()
    })
}

/// Returns the power of a number, unless it divides by zero or is excessively large.
pub(super) fn raised(number: &BigRational, exponent: i64) -> Option<BigRational> {
    if number.is_one() {
        return Some(One::one());
    }
    let exponent = i32::try_from(exponent).ok().filter(|exponent| exponent.abs() < 1 << 10)?;
    (exponent > 0 || !number.is_zero()).then(|| number.pow(exponent))
}

/// Returns the square root of a number, if the number is a perfect square.
pub(super) fn exact_root(number: &BigRational) -> Option<BigRational> {
    if number < &BigRational::zero() {
        return None;
    }
    let root = BigRational::new(number.numer().sqrt(), number.denom().sqrt());
    (&root * &root == *number).then_some(root)
}
