//! Derivative of an expression, in terms of the quantities in it and of their derivatives.

use super::expression::{Choice, Expression, Factor, Form, Term};
use super::known::Known;
use super::listing::length;
use alloc::collections::BTreeMap;
use alloc::sync::Arc;
use num_rational::BigRational;

/// Number of symbols up to which a derivative needs no name.
const SHORT: usize = 2;

/// Differentiation by one variable.
pub(super) struct Derivative<'a> {
    variable: &'a Arc<str>,
    known: &'a Known,
    done: BTreeMap<usize, Expression>,
}

impl<'a> Derivative<'a> {
    pub(super) fn by(variable: &'a Arc<str>, known: &'a Known) -> Self {
        Derivative { variable, known, done: BTreeMap::new() }
    }

    /// Returns the derivative of an expression that outlives the differentiation.
    pub(super) fn of(&mut self, expression: &'a Expression) -> Expression {
        if let Some(derivative) = self.done.get(&expression.identity()) {
            return derivative.clone();
        }
        let derivative = match expression.form() {
            Form::Number(_) => Expression::int(0),
            Form::Variable(name) => Expression::int((name == self.variable).into()),
            Form::Named(name, value) => {
                let derivative = self.of_quantity(expression, value);
                if length(&derivative) <= SHORT { derivative } else { derivative.named(name.derivative(self.variable)) }
            }
            Form::Sum(terms) => Expression::sum(
                terms.iter().flat_map(|term| Term { coefficient: term.coefficient.clone(), of: self.of(&term.of) }.expression().terms()),
            ),
            Form::Product(factors) => self.of_product(factors, None),
            Form::Root(a) => self.of_root(a, expression),
            Form::Sine(a) => self.of(a).multiplied(&a.cosine()),
            Form::Cosine(a) => self.of(a).multiplied(&a.sine()).negative(),
            Form::Angle { y, x } => {
                let (dy, dx) = (self.of(y), self.of(x));
                let turn = x.multiplied(&dy).plus(&y.multiplied(&dx).negative());
                Expression::product([(turn, 1), (x.power(2).plus(&y.power(2)), -1)])
            }
            Form::Choice(Choice { left, right, yes, no }) => {
                let (yes, no) = (self.of(yes), self.of(no));
                Expression::choice(Choice { left: left.clone(), right: right.clone(), yes, no })
            }
        };
        let derivative = self.known.shortened(&self.known.recognized(&derivative));
        self.done.insert(expression.identity(), derivative.clone());
        derivative
    }

    /// Returns the derivative of a quantity, in terms of the quantity itself if that is shorter: (x/y)′ is (x′ − (x/y) y′)/y, and √x′ is x′/(2 √x).
    pub(super) fn of_quantity(&mut self, quantity: &Expression, value: &'a Expression) -> Expression {
        let derivative = match value.form() {
            Form::Product(factors) => self.of_product(factors, Some((quantity, &BigRational::from_integer(1.into())))),
            Form::Sum(terms) if terms.len() == 1 => match terms[0].of.form() {
                Form::Product(factors) => self.of_product(factors, Some((quantity, &terms[0].coefficient))).times(&terms[0].coefficient),
                _ => self.of(value),
            },
            Form::Root(a) => self.of_root(a, quantity),
            _ => self.of(value),
        };
        self.known.shortened(&self.known.recognized(&derivative))
    }

    fn of_root(&mut self, of: &'a Expression, root: &Expression) -> Expression {
        let half = BigRational::new(1.into(), 2.into());
        self.of(of).multiplied(&root.power(-1)).times(&half)
    }

    /// Applies the product rule; the derivative of a divisor is expressed by the quantity that is a number times the product.
    fn of_product(&mut self, factors: &'a [Factor], quantity: Option<(&Expression, &BigRational)>) -> Expression {
        let terms = factors.iter().enumerate().flat_map(|(i, factor)| {
            let derivative = self.of(&factor.base);
            let exponent = BigRational::from_integer(factor.exponent.into());
            let product = match quantity {
                Some((quantity, number)) if factor.exponent < 0 => {
                    Expression::product([(quantity.clone(), 1), (derivative, 1), (factor.base.clone(), -1)]).times(&number.recip())
                }
                _ => Expression::product(factors.iter().enumerate().flat_map(|(k, other)| {
                    let inner = if k == i {
                        [(derivative.clone(), 1), (other.base.clone(), other.exponent - 1)]
                    } else {
                        [(other.base.clone(), other.exponent), (Expression::int(1), 1)]
                    };
                    inner.into_iter().filter(|(_, exponent)| *exponent != 0)
                })),
            };
            product.times(&exponent).terms()
        });
        Expression::sum(terms.collect::<alloc::vec::Vec<_>>())
    }
}

#[cfg(test)]
mod tests {
    use crate::formula::Glossary;
    use crate::scalar::symbol::Symbol;
    use crate::scalar::{Field, Ordered, Real};
    use alloc::string::{String, ToString};

    /// Returns the derivative by x.
    fn derivative(of: impl FnOnce(Symbol, Symbol) -> Symbol) -> String {
        let [x, y] = ["x", "y"].map(Symbol::variable);
        let text = Glossary::default().formula("f", &of(x, y)).derivative("x").to_string();
        text.strip_prefix("∂f/∂x = ").expect("it is the derivative of f").to_string()
    }

    #[test]
    fn the_rules() {
        assert_eq!(derivative(|_, y| y), "0");
        assert_eq!(derivative(|x, y| x * y + Symbol::int(3)), "y");
        assert_eq!(derivative(|x, y| x.squared() * y), "2 x y");
        assert_eq!(derivative(|x, y| y / x), "−f/x\n\nwhere\n  f = y/x");
        assert_eq!(derivative(|x, _| x.square_root()), "1/(2 f)\n\nwhere\n  f = √x");
        assert_eq!(derivative(|x, _| x.sin_and_cos().0), "cos x");
        assert_eq!(derivative(|x, _| x.sin_and_cos().1), "−sin x");
        assert_eq!(derivative(|x, y| y.arctangent(x)), "−y/(x² + y²)");
        assert_eq!(derivative(|x, y| x.arctangent(y)), "y/(y² + x²)");
        assert_eq!(derivative(|x, _| x.magnitude()), "−1\n          if x < 0\n        1\n          otherwise");
    }

    #[test]
    fn a_derivative_is_expressed_by_what_is_known() {
        let [x, y, a] = ["x", "y", "a"].map(Symbol::variable);
        let (sin, cos) = a.sin_and_cos();
        let along = x.clone() * cos.clone() + y.clone() * sin.clone();
        let across = y * cos - x * sin;
        let mut glossary = Glossary::default();
        glossary.give("v_n", &along);
        glossary.give("v_t", &across);
        let square = glossary.formula("s", &(along.clone() * along));
        assert_eq!(square.derivative("a").to_string().lines().next(), Some("∂s/∂a = 2 v_t v_n"));
        let second = square.derivative("a").derivative("a").to_string();
        assert_eq!(second.lines().next(), Some("∂²s/∂a∂a = 2 (v_t² − v_n²)"));
    }
}
