//! Rules shared by the notations: the sign of a term, the numerator and the denominator of a quotient, and brackets.

use super::expression::{Choice, Expression, Factor, Form, Term};
use super::listing::{Label, Listing};
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use num_rational::BigRational;
use num_traits::{One, Signed};

/// Strength with which the parts of a written expression hold together.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Bond {
    Sum,
    /// Nothing can be written after it without changing its meaning.
    Quotient,
    /// It can be multiplied, but not used as a divisor or raised to a power.
    Factor,
    /// It can be used as a divisor, but as the argument of a function or the base of a power it needs brackets; so does a numerator that ends with it.
    Divisor,
    /// As [`Bond::Divisor`], except that a numerator ending with it needs no brackets.
    Power,
    Symbol,
}

/// A written expression.
pub(super) struct Written {
    pub(super) text: String,
    pub(super) bond: Bond,
}

impl Written {
    pub(super) fn new(text: String, bond: Bond) -> Written {
        Written { text, bond }
    }
}

/// A notation for formulas.
pub(super) trait Notation {
    /// `true` if a quotient is written with a bar, whose numerator and denominator need no brackets.
    const BAR: bool;

    /// Separators between two terms, to the left and the right of the sign.
    const SIGNS: [&'static str; 2];

    fn variable(&self, name: &str) -> Written;
    fn quantity(&self, label: &Label) -> Written;
    fn integer(&self, digits: String) -> String;

    /// Formats a fraction of numbers that can precede other factors, if the notation has one.
    fn fraction(&self, number: &BigRational) -> Option<String>;
    fn product(&self, factors: &[String]) -> String;
    fn quotient(&self, above: String, below: String) -> String;
    fn brackets(&self, text: String) -> String;
    fn power(&self, base: String, exponent: i64) -> String;
    fn minus(&self) -> &'static str;
    fn root(&self, of: String, bond: Bond) -> Written;

    /// Formats a sine or cosine, with the exponent if it is not 1.
    fn circular(&self, name: &'static str, of: &Expression, written: Written, exponent: i64) -> Written;
    fn angle(&self, y: String, x: String) -> String;
    fn magnitude(&self, of: String) -> String;

    /// Formats a choice: the value of the first condition that holds, or else `otherwise`.
    fn cases(&self, cases: &[[String; 2]], otherwise: String) -> String;
}

/// Writes the expressions of a listing.
pub(super) struct Writer<'a, N> {
    pub(super) notation: N,
    pub(super) listing: &'a Listing,
}

impl<N: Notation> Writer<'_, N> {
    /// Formats the right side of a definition.
    pub(super) fn definition(&self, value: &Expression) -> String {
        match value.form() {
            Form::Choice(choice) if choice.magnitude().is_none() => self.cases(choice),
            _ => self.written(value).text,
        }
    }

    fn written(&self, expression: &Expression) -> Written {
        match expression.form() {
            Form::Number(number) => self.product_of(number, &[]),
            Form::Variable(name) => self.notation.variable(name),
            Form::Named(..) => self.notation.quantity(self.listing.label(expression)),
            Form::Sum(terms) if terms.len() == 1 => self.product_of(&terms[0].coefficient, &terms[0].of.factors().1),
            Form::Sum(terms) => match expression.factors() {
                (content, _) if content.is_one() => self.sum(terms),
                (content, factors) => self.product_of(&content, &factors),
            },
            Form::Product(factors) => self.product_of(&One::one(), factors),
            Form::Root(of) => {
                let of = self.written(of);
                self.notation.root(of.text, of.bond)
            }
            Form::Sine(of) => self.notation.circular("sin", of, self.written(of), 1),
            Form::Cosine(of) => self.notation.circular("cos", of, self.written(of), 1),
            Form::Angle { y, x } => Written::new(self.notation.angle(self.written(y).text, self.written(x).text), Bond::Symbol),
            Form::Choice(choice) => match choice.magnitude() {
                Some(of) => Written::new(self.notation.magnitude(self.written(of).text), Bond::Symbol),
                None => Written::new(self.notation.brackets(self.cases(choice)), Bond::Symbol),
            },
        }
    }

    fn cases(&self, mut choice: &Choice) -> String {
        let mut cases = Vec::new();
        loop {
            let Choice { left, right, yes, no } = choice;
            cases.push([self.written(yes).text, format!("{} < {}", self.written(left).text, self.written(right).text)]);
            match no.form() {
                Form::Choice(next) if next.magnitude().is_none() => choice = next,
                _ => return self.notation.cases(&cases, self.written(no).text),
            }
        }
    }

    /// Formats a sum, beginning with a term that is added, if there is one.
    fn sum(&self, terms: &[Term]) -> Written {
        let first = terms.iter().position(|term| term.coefficient.is_positive()).unwrap_or(0);
        let order = [first].into_iter().chain((0..terms.len()).filter(|&at| at != first));
        let mut text = String::new();
        for (place, at) in order.enumerate() {
            let Term { coefficient, of } = &terms[at];
            let negative = coefficient.is_negative();
            if place > 0 {
                let [before, behind] = N::SIGNS;
                text += before;
                text += if negative { self.notation.minus() } else { "+" };
                text += behind;
            } else if negative {
                text += self.notation.minus();
            }
            let factors = if of.as_number().is_some() { Vec::new() } else { of.factors().1 };
            text += &self.product_of(&coefficient.abs(), &factors).text;
        }
        Written::new(text, Bond::Sum)
    }

    /// Formats a number times a product.
    fn product_of(&self, number: &BigRational, factors: &[Factor]) -> Written {
        let (magnitude, mut above, mut below) = (number.abs(), Vec::new(), Vec::new());
        let (up, down): (Vec<&Factor>, Vec<&Factor>) = factors.iter().partition(|factor| factor.exponent > 0);
        if let Some(fraction) = self.notation.fraction(&magnitude).filter(|_| !up.is_empty() || down.is_empty()) {
            above.push(fraction);
        } else {
            let integer = |number: String| self.notation.integer(number);
            if !magnitude.numer().is_one() || up.is_empty() {
                above.push(integer(magnitude.numer().to_string()));
            }
            if !magnitude.denom().is_one() {
                below.push(integer(magnitude.denom().to_string()));
            }
        }
        let alone = |others: usize| if others == 0 { Bond::Sum } else { Bond::Factor };
        let quotient = !below.is_empty() || !down.is_empty();
        let others = (above.len() + up.len()).saturating_sub(1) + usize::from(quotient && !N::BAR) + usize::from(number.is_negative());
        let mut last = Bond::Symbol;
        for factor in up {
            let written = self.power(&factor.base, factor.exponent, alone(others));
            last = written.bond;
            above.push(written.text);
        }
        let others = (below.len() + down.len()).saturating_sub(1);
        let bond = if N::BAR { alone(others) } else { Bond::Divisor };
        below.extend(down.iter().map(|factor| self.power(&factor.base, -factor.exponent, bond).text));
        let numerator = self.notation.product(&above);
        let text = if below.is_empty() {
            numerator
        } else {
            let denominator = self.notation.product(&below);
            let bracketed = |text: String, so: bool| if so && !N::BAR { self.notation.brackets(text) } else { text };
            // The numerator must not be read as part of the argument of a function, or of the bar of a derivative.
            self.notation.quotient(bracketed(numerator, last < Bond::Power), bracketed(denominator, below.len() > 1))
        };
        if number.is_negative() {
            return Written::new(format!("{}{text}", self.notation.minus()), Bond::Sum);
        }
        let bond = match (quotient, above.len()) {
            (true, _) if !N::BAR => Bond::Quotient,
            (false, 1) => last,
            _ => Bond::Factor,
        };
        Written::new(text, bond)
    }

    /// Formats a power with a positive exponent, with at least the given bond.
    fn power(&self, base: &Expression, exponent: i64, least: Bond) -> Written {
        let raised = |of: &Expression, name| self.notation.circular(name, of, self.written(of), exponent);
        let written = match base.form() {
            Form::Sine(of) => raised(of, "sin"),
            Form::Cosine(of) => raised(of, "cos"),
            _ if exponent == 1 => self.written(base),
            _ => {
                let written = self.written(base);
                let text = if written.bond < Bond::Symbol { self.notation.brackets(written.text) } else { written.text };
                Written::new(self.notation.power(text, exponent), Bond::Power)
            }
        };
        if written.bond < least { Written::new(self.notation.brackets(written.text), Bond::Symbol) } else { written }
    }
}

#[cfg(test)]
mod tests {
    use crate::formula::{Formula, Glossary};
    use crate::scalar::symbol::Symbol;
    use crate::scalar::{Field, Ordered, Real};
    use alloc::string::ToString;
    use num_traits::Inv;

    fn formula(of: impl FnOnce([Symbol; 3]) -> Symbol) -> Formula {
        Glossary::default().formula("f", &of(["m1", "theta1", "v_n"].map(Symbol::variable)))
    }

    #[test]
    fn brackets_where_they_are_needed() {
        let of = |of: fn([Symbol; 3]) -> Symbol| formula(of).to_string();
        assert_eq!(of(|[m, a, v]| (m.clone() + v) / (m * a)), "f = (m1 + v_n)/(m1 θ1)");
        assert_eq!(of(|[m, a, v]| a.sin_and_cos().1 / m * v), "f = (v_n cos θ1)/m1");
        assert_eq!(of(|[m, a, _]| (a.squared() + m).sin_and_cos().0), "f = sin(θ1² + m1)");
        assert_eq!(of(|[_, a, _]| a.clone().sin_and_cos().0.squared() * a.squared().sin_and_cos().1), "f = sin² θ1 cos(θ1²)");
        assert_eq!(of(|[m, a, v]| -(m * (a - v)).square_root()), "f = −√(m1 (θ1 − v_n))");
        assert_eq!(of(|[m, a, v]| v - m * a.inv()), "f = v_n − m1/θ1");
    }

    #[test]
    fn the_same_in_three_notations() {
        let formula = formula(|[m, a, v]| (m.clone() * v.clone().squared()).half() * a.sin_and_cos().0 / (m + v.magnitude()).square_root());
        assert_eq!(formula.to_string(), "f = (½ m1 v_n² sin θ1)/√(m1 + |v_n|)");
        assert_eq!(
            formula.latex(),
            "\\begin{aligned}\nf &= \\frac{\\tfrac{1}{2} m_1 v_n^{2} \\sin \\theta_1}{\\sqrt{m_1 + \\left| v_n \\right|}}\n\\end{aligned}"
        );
        let source = "pub fn f(m1: f64, v_n: f64, theta1: f64) -> f64 {\n    let sin_theta1 = theta1.sin();\n    \
            0.5 * m1 * v_n.powi(2) * sin_theta1 / f64::sqrt(m1 + f64::abs(v_n))\n}";
        assert_eq!(formula.rust(), ["#[allow(non_snake_case, clippy::too_many_arguments)]\n", source].concat());
    }

    #[test]
    fn a_name_that_is_taken_gets_a_prime() {
        let [x, f] = ["x", "f"].map(Symbol::variable);
        let mut glossary = Glossary::default();
        glossary.give("x", &(x.clone() * f.clone()));
        let formula = glossary.formula("f", &(x.clone() * f + x));
        assert_eq!(formula.to_string(), "f′ = x′ + x\n\nwhere\n  x′ = x f");
        assert!(formula.rust().contains("pub fn f_(x: f64, f: f64) -> f64 {\n    let x_ = x * f;\n    x_ + x\n}"), "{}", formula.rust());
        assert!(formula.latex().contains("f' &= x' + x"), "{}", formula.latex());
    }

    #[test]
    fn what_is_long_and_repeated_gets_a_number() {
        let names = ["a", "b", "c", "d", "g", "h", "i", "j", "k", "l"];
        let long = names.map(Symbol::variable).into_iter().reduce(|sum, x| sum + x).expect("there are ten");
        let [x, y] = ["x", "y"].map(Symbol::variable);
        let formula = Glossary::default().formula("f", &(long.clone() * x - long.square_root() * y));
        assert_eq!(
            formula.to_string(),
            "f = s1 x − y √s1\n\nwhere\n  s1 = a + b + c + d + g + h + i + j + k + l".replace("y √s1", "√s1 y")
        );
    }
}
