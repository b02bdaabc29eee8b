//! Named quantities, and expressions in terms of them.

use super::equivalence::Equivalence;
use super::expression::{Expression, Factor, Form, Name, Term};
use super::listing::length;
use alloc::sync::Arc;
use alloc::vec::Vec;
use num_rational::BigRational;

/// Named quantities, and the order of variables.
#[derive(Clone, Debug, Default)]
pub(super) struct Known {
    quantities: Vec<Quantity>,
    pub(super) variables: Vec<Arc<str>>,
}

/// A named expression, which is `content` times `primitive`.
#[derive(Clone, Debug)]
struct Quantity {
    name: Name,
    named: Expression,
    value: Expression,
    content: BigRational,
    primitive: Expression,
}

impl Known {
    pub(super) fn of_variables(names: &[&str]) -> Known {
        Known { quantities: Vec::new(), variables: names.iter().map(|&name| name.into()).collect() }
    }

    /// Returns the value under its name, unless it is as short as a name.
    pub(super) fn add(&mut self, name: Name, value: Expression) -> Expression {
        if value.is_short() {
            return value;
        }
        let named = value.clone().named(name.clone());
        let (content, primitive) = apart(&value);
        self.quantities.push(Quantity { named: named.clone(), value, name, content, primitive });
        named
    }

    /// Returns the names of the quantities.
    pub(super) fn names(&self) -> Vec<&str> {
        self.quantities.iter().map(|quantity| &*quantity.name.symbol).collect()
    }

    /// Returns the expression in terms of the quantities that equal it or a factor of it.
    pub(super) fn recognized(&self, expression: &Expression) -> Expression {
        if let Some(quantity) = self.quantity(expression) {
            return quantity;
        }
        let Form::Product(factors) = expression.form() else {
            return match expression.form() {
                Form::Sum(terms) if terms.len() == 1 => self.recognized(&terms[0].of).times(&terms[0].coefficient),
                _ => expression.clone(),
            };
        };
        let known: Vec<Option<Expression>> =
            factors.iter().map(|factor| factor.base.has_terms().then(|| self.quantity(&factor.base))?).collect();
        if known.iter().any(Option::is_some) {
            let replaced = known.into_iter().zip(factors).map(|(known, factor)| (known.unwrap_or(factor.base.clone()), factor.exponent));
            return self.recognized(&Expression::product(replaced));
        }
        match self.quantities.iter().find_map(|quantity| quantity.taken_out_of(factors)) {
            Some(product) => self.recognized(&product),
            None => expression.clone(),
        }
    }

    /// Returns the expression with each sum in terms of fewer quantities.
    pub(super) fn shortened(&self, expression: &Expression) -> Expression {
        let shorter = match expression.form() {
            Form::Sum(terms) if terms.len() == 1 => self.shortened(&terms[0].of).times(&terms[0].coefficient),
            Form::Sum(terms) => self.resolved(terms),
            Form::Product(factors) => Expression::product(factors.iter().map(|factor| (self.shortened(&factor.base), factor.exponent))),
            _ => return expression.clone(),
        };
        if length(&shorter) < length(expression) {
            return shorter;
        }
        self.of_two(expression).unwrap_or_else(|| expression.clone())
    }

    /// Returns a sum with each quantity in it resolved, because terms may cancel.
    fn resolved(&self, terms: &[Term]) -> Expression {
        let values = terms.iter().flat_map(|term| match term.of.form() {
            Form::Named(_, value) => value.times(&term.coefficient).terms(),
            _ => Vec::from([term.clone()]),
        });
        self.recognized(&Expression::sum(values))
    }

    /// Returns the expression as a sum of two quantities or of multiples of them, if that is shorter.
    fn of_two(&self, expression: &Expression) -> Option<Expression> {
        if length(expression) <= 2 {
            return None;
        }
        let parts = expression.expanded()?;
        self.quantities.iter().find_map(|quantity| {
            // A common term determines the factor with which the quantity can be one of the two.
            let Form::Sum(terms) = quantity.value.form() else { return None };
            let factor = terms.iter().find_map(|term| parts.iter().find_map(|part| term.ratio_to(part)))?;
            let quantity_taken = quantity.value.times(&-factor.clone()).terms();
            let rest = self.recognized(&Expression::sum(parts.iter().cloned().chain(quantity_taken)));
            rest.is_short().then(|| rest.plus(&quantity.named.times(&factor)))
        })
    }

    /// Returns the quantity that the expression equals, or of which it is a multiple.
    fn quantity(&self, expression: &Expression) -> Option<Expression> {
        if expression.is_short() {
            return None;
        }
        let (content, primitive) = apart(expression);
        self.quantities.iter().find_map(|quantity| {
            let equivalence = quantity.primitive.equivalence(&primitive)?;
            let ratio = &content / &quantity.content;
            Some(quantity.named.times(&if equivalence == Equivalence::Equal { ratio } else { -ratio }))
        })
    }
}

impl Quantity {
    /// Returns the product of factors in terms of this quantity, if it is the product of some of them.
    fn taken_out_of(&self, factors: &[Factor]) -> Option<Expression> {
        let Form::Product(own) = self.primitive.form() else { return None };
        let is_own = |factor: &Factor| own.iter().any(|own| own.equals(factor));
        let first = factors.iter().position(is_own)?;
        let others = || factors.iter().enumerate().filter(|(_, factor)| !is_own(factor));
        if others().count() + own.len() != factors.len() {
            return None;
        }
        let power = |(_, factor): (usize, &Factor)| (factor.base.clone(), factor.exponent);
        let before = others().take_while(|(at, _)| *at < first).map(power);
        let behind = others().skip_while(|(at, _)| *at < first).map(power);
        Some(Expression::product(before.chain([(self.named.clone(), 1)]).chain(behind)).times(&self.content.recip()))
    }
}

/// Splits an expression into its numeric factor and the rest.
fn apart(expression: &Expression) -> (BigRational, Expression) {
    let (content, factors) = expression.factors();
    (content, Expression::product(factors.into_iter().map(|factor| (factor.base, factor.exponent))))
}

/// Returns a quotient of two quantities in terms of their values, if something cancels: P_t/P_n is μ if P_t is μ P_n.
pub(super) fn cancelled(expression: Expression) -> Expression {
    let (number, factors) = expression.factors();
    let pairs = factors.iter().flat_map(|above| factors.iter().map(move |below| (above, below)));
    let mut quotients = pairs.filter(|(above, below)| above.exponent > 0 && below.exponent < 0);
    let Some((above, below)) = quotients.find_map(|(above, below)| cancelling(above, below)) else { return expression };
    let resolved = factors.iter().map(|factor| match factor {
        factor if factor.equals(&above.0) => (above.1.clone(), factor.exponent),
        factor if factor.equals(&below.0) => (below.1.clone(), factor.exponent),
        factor => (factor.base.clone(), factor.exponent),
    });
    cancelled(Expression::product(resolved).times(&number))
}

/// Returns the numerator and the denominator of a quotient that cancels, each with its resolved value: the quantity in the numerator contains the one in the
/// denominator as a factor, or both have a common factor.
fn cancelling(above: &Factor, below: &Factor) -> Option<((Factor, Expression), (Factor, Expression))> {
    let Form::Named(_, above_is) = above.base.form() else { return None };
    let (own, below_is) = (above_is.factors().1, resolved(&below.base));
    let contains_below = own.iter().any(|factor| factor.exponent > 0 && factor.base.equals(&below.base));
    let of_below = below_is.factors().1;
    let common = |factor: &Factor| {
        of_below.iter().any(|other| factor.exponent.signum() == other.exponent.signum() && factor.base.equals(&other.base))
    };
    let below_is = match contains_below {
        true => below.base.clone(),
        false if own.iter().any(common) => below_is,
        false => return None,
    };
    Some(((above.clone(), above_is.clone()), (below.clone(), below_is)))
}

/// Returns the value of a quantity.
fn resolved(expression: &Expression) -> Expression {
    match expression.form() {
        Form::Named(_, value) => value.clone(),
        _ => expression.clone(),
    }
}

impl Term {
    /// Returns the term as an expression.
    pub(super) fn expression(&self) -> Expression {
        self.of.times(&self.coefficient)
    }

    /// Returns the number that this term is multiplied by to give the other, or `None` if there is none.
    fn ratio_to(&self, other: &Term) -> Option<BigRational> {
        let equivalence = self.of.equivalence(&other.of)?;
        Some(&other.coefficient / &self.coefficient * BigRational::from_integer(equivalence.sign().into()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A quotient of named products is written out where a factor of both goes, and stays as it is otherwise.
    #[test]
    fn quotients_of_quantities_cancel_what_both_have() {
        let [x, y, z] = ["x", "y", "z"].map(Expression::variable);
        let named = |symbol: &str, factors: &[(&Expression, i64)]| {
            Expression::product(factors.iter().map(|(base, exponent)| ((*base).clone(), *exponent))).named(Name::of(symbol))
        };
        let quotient = |above: &Expression, below: &Expression| Expression::product([(above.clone(), 1), (below.clone(), -1)]);
        let (xy, xz, zz) = (named("a", &[(&x, 1), (&y, 1)]), named("b", &[(&x, 1), (&z, 1)]), named("c", &[(&z, 2)]));
        assert!(cancelled(quotient(&xy, &xz)).equals(&quotient(&y, &z)));
        assert!(cancelled(quotient(&xy, &zz)).equals(&quotient(&xy, &zz)));
    }
}
