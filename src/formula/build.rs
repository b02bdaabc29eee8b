//! Simplifying constructors of expressions: exact numbers, neutral elements, like terms, powers, common factors.
//!
//! Each preserves the value as a formula in real numbers, wherever the formula has one. Rounding and the sign of zero are not represented.

use super::combine::{collect, exact_root, gather, place, raised, without_common_factors, without_squared_roots};
use super::expression::{Choice, Expression, Factor, Form, Name, Term};
use alloc::vec::Vec;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

impl Expression {
    pub(super) fn number(number: BigRational) -> Expression {
        Expression::new(Form::Number(number))
    }

    pub(super) fn int(n: i32) -> Expression {
        Expression::number(BigRational::from_integer(n.into()))
    }

    pub(super) fn variable(name: &str) -> Expression {
        Expression::new(Form::Variable(name.into()))
    }

    /// Returns it under a name, unless it is as short as a name.
    pub(super) fn named(self, name: Name) -> Expression {
        if self.is_short() { self } else { Expression::new(Form::Named(name, self)) }
    }

    /// Returns `true` if a name would not make it shorter: a number, a symbol, or a number times a symbol.
    pub(super) fn is_short(&self) -> bool {
        match self.form() {
            Form::Number(_) | Form::Variable(_) | Form::Named(..) => true,
            Form::Sum(terms) => terms.len() == 1 && terms[0].of.is_short(),
            _ => false,
        }
    }

    /// Multiplies it by a number.
    pub(super) fn times(&self, number: &BigRational) -> Expression {
        if number.is_one() {
            return self.clone();
        }
        Expression::sum(self.terms().into_iter().map(|term| Term { coefficient: term.coefficient * number, of: term.of }))
    }

    pub(super) fn negative(&self) -> Expression {
        self.times(&BigRational::from_integer((-1).into()))
    }

    pub(super) fn plus(&self, other: &Expression) -> Expression {
        Expression::sum(self.terms().into_iter().chain(other.terms()))
    }

    pub(super) fn multiplied(&self, other: &Expression) -> Expression {
        Expression::product([(self.clone(), 1), (other.clone(), 1)])
    }

    pub(super) fn power(&self, exponent: i64) -> Expression {
        Expression::product([(self.clone(), exponent)])
    }

    /// Creates the sum of terms.
    pub(super) fn sum(terms: impl IntoIterator<Item = Term>) -> Expression {
        let mut sum: Vec<Term> = Vec::new();
        for term in terms {
            collect(&mut sum, term);
        }
        sum.retain(|term| !term.coefficient.is_zero());
        match &sum[..] {
            [] => Expression::int(0),
            [term] if term.coefficient.is_one() => term.of.clone(),
            [term] if term.of.as_number().is_some() => Expression::number(term.coefficient.clone()),
            [_] => Expression::new(Form::Sum(sum)),
            _ => without_common_factors(sum),
        }
    }

    /// Creates the product of powers.
    pub(super) fn product(powers: impl IntoIterator<Item = (Expression, i64)>) -> Expression {
        let mut number = BigRational::one();
        let mut product: Vec<Factor> = Vec::new();
        for (base, exponent) in powers {
            let (content, factors) = base.factors();
            match raised(&content, exponent) {
                Some(power) if power.is_one() => (),
                Some(power) => number *= power,
                None => gather(&mut number, &mut product, Factor { base: Expression::number(content), exponent }),
            }
            for Factor { base, exponent: inner } in factors {
                match inner.checked_mul(exponent) {
                    Some(exponent) => gather(&mut number, &mut product, Factor { base, exponent }),
                    None => gather(&mut number, &mut product, Factor { base: base.power(inner), exponent }),
                }
            }
        }
        product.retain(|factor| factor.exponent != 0);
        if number.is_zero() {
            return Expression::int(0);
        }
        if let Some(squared) = without_squared_roots(&product) {
            return Expression::product(squared).times(&number);
        }
        product.sort_by_key(|factor| place(&factor.base));
        let product = match &product[..] {
            [] => return Expression::number(number),
            [factor] if factor.exponent == 1 => factor.base.clone(),
            _ => Expression::new(Form::Product(product)),
        };
        product.times(&number)
    }

    /// Returns the terms with each sum in a product multiplied out, unless it has an exponent or is in a denominator. Returns `None` if there would be too
    /// many terms.
    pub(super) fn expanded(&self) -> Option<Vec<Term>> {
        const MANY: usize = 64;
        let mut expanded = Vec::new();
        for Term { coefficient, of } in self.terms() {
            let (_, factors) = of.factors();
            let Some(at) = factors.iter().position(|factor| factor.base.has_terms() && factor.exponent == 1) else {
                collect(&mut expanded, Term { coefficient, of });
                continue;
            };
            let others = factors.iter().enumerate().filter(|(other, _)| *other != at);
            let others = Expression::product(others.map(|(_, factor)| (factor.base.clone(), factor.exponent)));
            for term in factors[at].base.terms() {
                let product = term.of.multiplied(&others).times(&(&term.coefficient * &coefficient));
                product.expanded()?.into_iter().for_each(|term| collect(&mut expanded, term));
                if expanded.len() > MANY {
                    return None;
                }
            }
        }
        Some(expanded)
    }

    pub(super) fn root(&self) -> Expression {
        match self.as_number().and_then(exact_root) {
            Some(root) => Expression::number(root),
            None => Expression::new(Form::Root(self.clone())),
        }
    }

    pub(super) fn sine(&self) -> Expression {
        if self.is_zero() { self.clone() } else { Expression::new(Form::Sine(self.clone())) }
    }

    pub(super) fn cosine(&self) -> Expression {
        if self.is_zero() { Expression::int(1) } else { Expression::new(Form::Cosine(self.clone())) }
    }

    /// Creates the direction of (x, y); that of (0, 0) is 0, as for floats.
    pub(super) fn angle(y: Expression, x: Expression) -> Expression {
        let ahead = x.as_number().is_some_and(|x| !x.is_negative());
        if y.is_zero() && ahead { y } else { Expression::new(Form::Angle { y, x }) }
    }

    /// Creates a choice between two expressions, which do not repeat its condition.
    pub(super) fn choice(choice: Choice) -> Expression {
        let Choice { left, right, yes, no } = &choice;
        if let (Some(left), Some(right)) = (left.as_number(), right.as_number()) {
            return if left < right { yes.clone() } else { no.clone() };
        }
        let (yes, no) = (yes.given(&choice, true), no.given(&choice, false));
        if yes.equals(&no) { yes } else { Expression::new(Form::Choice(Choice { left: left.clone(), right: right.clone(), yes, no })) }
    }

    /// Returns the expression with the condition of a choice known to be true or false.
    fn given(&self, known: &Choice, holds: bool) -> Expression {
        self.replaced(&mut |expression| match expression.form() {
            Form::Choice(choice) if choice.same_condition(known) => Some(if holds { choice.yes.clone() } else { choice.no.clone() }),
            _ => None,
        })
    }

    /// Returns the expression with parts replaced, from the root inward; named parts are not changed.
    pub(super) fn replaced(&self, by: &mut impl FnMut(&Expression) -> Option<Expression>) -> Expression {
        if let Some(other) = by(self) {
            return other.replaced(by);
        }
        match self.form() {
            Form::Number(_) | Form::Variable(_) | Form::Named(..) => self.clone(),
            Form::Sum(terms) => Expression::sum(terms.iter().flat_map(|term| term.of.replaced(by).times(&term.coefficient).terms())),
            Form::Product(factors) => Expression::product(factors.iter().map(|factor| (factor.base.replaced(by), factor.exponent))),
            Form::Root(a) => a.replaced(by).root(),
            Form::Sine(a) => a.replaced(by).sine(),
            Form::Cosine(a) => a.replaced(by).cosine(),
            Form::Angle { y, x } => Expression::angle(y.replaced(by), x.replaced(by)),
            Form::Choice(Choice { left, right, yes, no }) => Expression::choice(Choice {
                left: left.replaced(by),
                right: right.replaced(by),
                yes: yes.replaced(by),
                no: no.replaced(by),
            }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formula::Glossary;
    use crate::scalar::symbol::Symbol;
    use crate::scalar::{Field, Ordered, Real};
    use alloc::string::{String, ToString};
    use num_traits::Inv;

    /// Returns the printed form of the simplified expression of x, y and z.
    fn simplified(of: impl FnOnce(Symbol, Symbol, Symbol) -> Symbol) -> String {
        let [x, y, z] = ["x", "y", "z"].map(Symbol::variable);
        let text = Glossary::default().formula("f", &of(x, y, z)).to_string();
        text.strip_prefix("f = ").expect("it is the formula of f").to_string()
    }

    #[test]
    fn neutral_elements_go() {
        assert_eq!(simplified(|x, _, _| x * Symbol::int(1) + Symbol::int(0)), "x");
        assert_eq!(simplified(|x, y, _| x * Symbol::int(0) + y), "y");
        assert_eq!(simplified(|x, _, _| -(-x).inv().inv()), "x");
    }

    #[test]
    fn variables_are_equal_by_their_names() {
        let [x, again, y] = ["x", "x", "y"].map(Expression::variable);
        assert!(x.equals(&again) && !x.equals(&y));
    }

    #[test]
    fn like_terms_and_powers_are_collected() {
        assert_eq!(simplified(|x, y, _| x.clone() * y.clone() + y * x), "2 x y");
        assert_eq!(simplified(|x, _, _| x.clone() * x.clone() * x.inv()), "x");
        assert_eq!(simplified(|x, y, z| (x.clone() - y.clone()) * z.clone() + (y - x) * z), "0");
        assert_eq!(simplified(|x, y, _| (x.clone() - y.clone()) / (y - x)), "−1");
        assert_eq!(simplified(|x, _, _| x.clone().half() + x / Symbol::int(3)), "5 x/6");
    }

    #[test]
    fn common_factors_stand_before_the_bracket() {
        assert_eq!(simplified(|x, y, z| x.clone() * y / z.clone() - x / z), "(y − 1) x/z");
        assert_eq!(simplified(|x, y, z| -(x.clone() * y.clone()).half() - (x * z).half()), "−½ x (y + z)");
    }

    #[test]
    fn products_of_sums_are_multiplied_out_unless_they_divide() {
        let [x, y, z] = ["x", "y", "z"].map(Expression::variable);
        let terms = |of: &Expression| of.expanded().map(|terms| terms.len());
        let sum = x.plus(&y);
        assert_eq!(terms(&sum.multiplied(&z)), Some(2));
        assert_eq!(terms(&sum.multiplied(&z.plus(&y.negative()))), Some(4));
        assert_eq!(terms(&sum.power(-1).multiplied(&z)), Some(1));
    }

    #[test]
    fn opposite_directions_differ() {
        let [x, y] = ["x", "y"].map(Expression::variable);
        let angle = |y: &Expression, x: &Expression| Expression::angle(y.clone(), x.clone());
        assert!(angle(&y, &x).equals(&angle(&y, &x)));
        // Of the same hash, which has no signs.
        let [one, other] = [x.plus(&y.negative()), y.plus(&x.negative())];
        assert!(!angle(&x, &one).equals(&angle(&x, &other)) && !angle(&one, &x).equals(&angle(&other, &x)));
    }

    #[test]
    fn roots_circles_and_directions() {
        assert_eq!(simplified(|x, y, _| (x.clone() + y.clone()).square_root() * (x + y).square_root()), "x + y");
        assert_eq!(simplified(|_, _, _| (Symbol::int(9) / Symbol::int(4)).square_root()), "3/2");
        assert_eq!(simplified(|_, _, _| Symbol::int(0).sin_and_cos().1), "1");
        assert_eq!(simplified(|_, _, _| Symbol::int(0).arctangent(Symbol::int(0))), "0");
        assert_eq!(simplified(|_, _, _| Symbol::int(0).arctangent(Symbol::int(-1))), "atan2(0, −1)");
    }

    #[test]
    fn a_choice_asks_once() {
        let twice = |x: Symbol, y: Symbol, z: Symbol| {
            let less = x.less(&y);
            Symbol::select(less.clone(), Symbol::select(less.clone(), x, y.clone()) + z.clone(), Symbol::select(less, z, y))
        };
        assert_eq!(simplified(twice), "x + z\n      if x < y\n    y\n      otherwise");
        assert_eq!(simplified(|x, y, _| Symbol::select(x.less(&y), x.clone(), x)), "x");
        assert_eq!(simplified(|x, y, _| Symbol::select(Symbol::int(1).less(&Symbol::int(2)), x, y)), "x");
        assert_eq!(simplified(|x, _, _| x.magnitude()), "|x|");
    }

    #[test]
    fn no_exponent_is_too_large_and_no_divisor_too_small() {
        let power = |x: Symbol, times: u32| (0..times).fold(x, |power, _| power.squared());
        assert_eq!(simplified(|x, _, _| power(x, 62)), "x⁴⁶¹¹⁶⁸⁶⁰¹⁸⁴²⁷³⁸⁷⁹⁰⁴");
        // Beyond that it is not simplified.
        assert!(simplified(|x, _, _| power(x.clone(), 64) / power(x, 64)).starts_with("x⁴⁶¹¹⁶⁸⁶⁰¹⁸⁴²⁷³⁸⁷⁹⁰⁴ x⁴⁶"));
        assert_eq!(simplified(|x, _, _| x / Symbol::int(0)), "x/0");
        assert_eq!(simplified(|_, _, _| power(Symbol::int(2), 10)).len(), 309);
    }
}
