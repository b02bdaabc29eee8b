//! How terms and factors combine.

use super::expression::{Expression, Factor, Form, Term};
use super::likeness::Likeness;
use alloc::vec::Vec;
use num_rational::BigRational;
use num_traits::{One, Zero};

/// Where a factor is read best: 1 + e first, derivatives behind symbols, and last what is read together with whatever follows it.
pub(super) fn place(factor: &Expression) -> u8 {
    match factor.form() {
        Form::Sum(terms) if terms.iter().any(|term| term.of.as_number().is_some()) => 0,
        Form::Named(name, _) if !name.by.is_empty() => 2,
        Form::Sine(_) | Form::Cosine(_) => 3,
        _ => 1,
    }
}

/// Adds a term to its like, if there is one.
pub(super) fn collect(sum: &mut Vec<Term>, term: Term) {
    for known in sum.iter_mut() {
        match known.of.likeness(&term.of) {
            Some(Likeness::Equal) => return known.coefficient += term.coefficient,
            Some(Likeness::Opposite) => return known.coefficient -= term.coefficient,
            None => (),
        }
    }
    sum.push(term);
}

/// Multiplies a power with that of the same base, if there is one.
pub(super) fn gather(number: &mut BigRational, product: &mut Vec<Factor>, factor: Factor) {
    for known in product.iter_mut() {
        if let Some(likeness) = known.base.likeness(&factor.base)
            && let Some(exponent) = known.exponent.checked_add(factor.exponent)
        {
            known.exponent = exponent;
            if likeness == Likeness::Opposite && factor.exponent % 2 != 0 {
                *number = -number.clone();
            }
            return;
        }
    }
    product.push(factor);
}

/// The sum with what all of its terms have in common before the bracket.
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

/// The powers with the squares of roots resolved, if there are any.
pub(super) fn without_squared_roots(product: &[Factor]) -> Option<Vec<(Expression, i64)>> {
    product.iter().any(|factor| matches!(factor.base.form(), Form::Root(_)) && factor.exponent.abs() > 1).then(|| {
        let resolved = |factor: &Factor| match factor.base.form() {
            Form::Root(of) => [(of.clone(), factor.exponent / 2), (factor.base.clone(), factor.exponent % 2)],
            _ => [(factor.base.clone(), factor.exponent), (Expression::int(1), 1)],
        };
        product.iter().flat_map(resolved).collect()
    })
}

/// The power of a number, unless it divides by zero or is out of all proportion.
pub(super) fn raised(number: &BigRational, exponent: i64) -> Option<BigRational> {
    if number.is_one() {
        return Some(One::one());
    }
    let exponent = i32::try_from(exponent).ok().filter(|exponent| exponent.abs() < 1 << 10)?;
    (exponent > 0 || !number.is_zero()).then(|| number.pow(exponent))
}

/// The root of a number that is a square.
pub(super) fn exact_root(number: &BigRational) -> Option<BigRational> {
    if number < &BigRational::zero() {
        return None;
    }
    let root = BigRational::new(number.numer().sqrt(), number.denom().sqrt());
    (&root * &root == *number).then_some(root)
}
