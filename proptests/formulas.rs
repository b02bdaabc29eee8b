//! Simplification and differentiation of arbitrary expressions, without mechanics.

use crate::exact_dual::ExactDual;
use crate::rational::Rational;
use crate::reading::Reader;
use crate::strategies::{OrReject, config};
use num_dual::Dual64;
use planar_impact::formula::Glossary;
use planar_impact::scalar::symbol::Symbol;
use planar_impact::*;
use proptest::prelude::*;

/// An expression before it is recorded.
#[derive(Clone, Debug)]
pub enum Tree {
    Int(i32),
    Variable(usize),
    Neg(Box<Tree>),
    Inv(Box<Tree>),
    Squared(Box<Tree>),
    Magnitude(Box<Tree>),
    Add(Box<Tree>, Box<Tree>),
    Sub(Box<Tree>, Box<Tree>),
    Mul(Box<Tree>, Box<Tree>),
    Div(Box<Tree>, Box<Tree>),
    /// The third if the first is less than the second, else the fourth.
    Select(Box<Tree>, Box<Tree>, Box<Tree>, Box<Tree>),
    Sqrt(Box<Tree>),
    Sin(Box<Tree>),
    Cos(Box<Tree>),
    Atan2(Box<Tree>, Box<Tree>),
}

impl Tree {
    pub fn of<T: Real>(&self, variables: &[T; 3]) -> T {
        let of = |tree: &Tree| tree.of(variables);
        match self {
            Tree::Int(n) => T::int(*n),
            Tree::Variable(at) => variables[*at].clone(),
            Tree::Neg(a) => -of(a),
            Tree::Inv(a) => of(a).inv(),
            Tree::Squared(a) => of(a).squared(),
            Tree::Magnitude(a) => of(a).magnitude(),
            Tree::Add(a, b) => of(a) + of(b),
            Tree::Sub(a, b) => of(a) - of(b),
            Tree::Mul(a, b) => of(a) * of(b),
            Tree::Div(a, b) => of(a) / of(b),
            Tree::Select(a, b, yes, no) => T::select(of(a).less(&of(b)), of(yes), of(no)),
            Tree::Sqrt(a) => of(a).square_root(),
            Tree::Sin(a) => of(a).sin_and_cos().0,
            Tree::Cos(a) => of(a).sin_and_cos().1,
            // Formulas have only one zero.
            Tree::Atan2(y, x) => (of(y) + T::int(0)).arctangent(of(x) + T::int(0)),
        }
    }
}

impl Tree {
    /// Returns `true` if its value and derivative are well conditioned in floats: no division, root or direction is
    /// taken of a number near zero.
    pub fn is_smooth(&self, values: &[f64; 3]) -> bool {
        let of = |tree: &Tree| tree.of(values);
        let parts = match self {
            Tree::Int(_) | Tree::Variable(_) => return true,
            Tree::Inv(a) => (of(a).abs() > 1e-2, vec![a]),
            Tree::Sqrt(a) => (of(a) > 1e-2, vec![a]),
            Tree::Div(a, b) => (of(b).abs() > 1e-2, vec![a, b]),
            Tree::Atan2(a, b) => (of(a).hypot(of(b)) > 1e-2 && of(b).abs() > 1e-9, vec![a, b]),
            Tree::Neg(a) | Tree::Squared(a) | Tree::Magnitude(a) | Tree::Sin(a) | Tree::Cos(a) => (true, vec![a]),
            Tree::Add(a, b) | Tree::Sub(a, b) | Tree::Mul(a, b) => (true, vec![a, b]),
            Tree::Select(a, b, yes, no) => (true, vec![a, b, yes, no]),
        };
        parts.0 && of(self).abs() < 1e3 && parts.1.into_iter().all(|part| part.is_smooth(values))
    }
}

fn leaf() -> impl Strategy<Value = Tree> {
    prop_oneof![(-3..=3_i32).prop_map(Tree::Int), (0..3_usize).prop_map(Tree::Variable)]
}

/// Generates expressions of the four operations and comparisons.
fn rational_tree() -> impl Strategy<Value = Tree> {
    leaf().prop_recursive(5, 24, 4, |inner| {
        let one = || inner.clone().prop_map(Box::new);
        prop_oneof![
            one().prop_map(Tree::Neg),
            one().prop_map(Tree::Inv),
            one().prop_map(Tree::Squared),
            one().prop_map(Tree::Magnitude),
            (one(), one()).prop_map(|(a, b)| Tree::Add(a, b)),
            (one(), one()).prop_map(|(a, b)| Tree::Sub(a, b)),
            (one(), one()).prop_map(|(a, b)| Tree::Mul(a, b)),
            (one(), one()).prop_map(|(a, b)| Tree::Div(a, b)),
            (one(), one(), one(), one()).prop_map(|(a, b, yes, no)| Tree::Select(a, b, yes, no)),
        ]
    })
}

/// Generates expressions of all functions.
pub fn real_tree() -> impl Strategy<Value = Tree> {
    leaf().prop_recursive(5, 16, 2, |inner| {
        let one = || inner.clone().prop_map(Box::new);
        prop_oneof![
            one().prop_map(Tree::Inv),
            one().prop_map(Tree::Squared),
            one().prop_map(Tree::Sqrt),
            one().prop_map(Tree::Sin),
            one().prop_map(Tree::Cos),
            (one(), one()).prop_map(|(a, b)| Tree::Add(a, b)),
            (one(), one()).prop_map(|(a, b)| Tree::Sub(a, b)),
            (one(), one()).prop_map(|(a, b)| Tree::Mul(a, b)),
            (one(), one()).prop_map(|(a, b)| Tree::Div(a, b)),
            (one(), one()).prop_map(|(a, b)| Tree::Atan2(a, b)),
        ]
    })
}

pub fn symbols() -> [Symbol; 3] {
    ["x", "y", "z"].map(Symbol::variable)
}

/// Returns the index of a variable among the three.
pub fn at(name: &str) -> usize {
    ["x", "y", "z"].iter().position(|known| *known == name).expect("there are three variables")
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn simplification_keeps_the_value_and_differentiation_is_exact(
        trees in [rational_tree(), rational_tree(), rational_tree()], values in [-4..=4_i32, -4..=4, -4..=4], by in 0..3_usize
    ) {
        let [one, two, whole] = trees;
        // The whole consists of x and two named quantities.
        let compound = |variables: [ExactDual; 3]| {
            let quantities = [one.of(&variables), two.of(&variables)];
            let [x, _, _] = variables;
            let [a, b] = quantities.clone();
            quantities.iter().all(|quantity| quantity.clone().parts().is_some()).then(|| whole.of(&[x, a, b]))
        };
        let value = |at: usize, slope: bool| ExactDual::number(Rational::int(values[at]), slope.into());
        let expected = compound([0, 1, 2].map(|at| value(at, at == by))).and_then(ExactDual::parts);
        let (expected, slope) = expected.or_reject("no value")?;

        let variables = symbols();
        let [a, b] = [one.of(&variables), two.of(&variables)];
        let [x, _, _] = variables;
        let mut glossary = Glossary::default();
        glossary.give("a", &a);
        glossary.give("b", &b);
        let formula = glossary.formula("f", &whole.of(&[x, a, b]));
        let computed = formula.evaluate(|name| value(at(name), at(name) == by)).parts();
        prop_assert_eq!(computed, Some((expected, slope.clone())), "{}", formula);
        let derivative = formula.derivative(["x", "y", "z"][by]);
        let computed = derivative.evaluate(|name| value(at(name), false)).parts();
        prop_assert_eq!(computed.map(|(value, _)| value), Some(slope), "{}\n{}", formula, derivative);
        for formula in [formula, derivative] {
            for width in [80, 20] {
                let text = formula.text(width);
                let given = ["x", "y", "z"].map(|name| (name, value(at(name), false)));
                let read = Reader::of(&text).value(&given.into()).parts();
                prop_assert_eq!(read, formula.evaluate(|name| value(at(name), false)).parts(), "{}", text);
            }
        }
    }

    #[test]
    fn roots_and_circular_functions_keep_their_value_and_derivative(tree in real_tree(), values in [0.1..2.0_f64, -2.0..-0.1, -3.0..3.0], by in 0..3_usize) {
        let value = |at: usize| Dual64::new(values[at], f64::from(u8::from(at == by)));
        let expected = tree.of(&[0, 1, 2].map(value));
        prop_assume!(tree.is_smooth(&values));
        let formula = Glossary::default().formula("f", &tree.of(&symbols()));
        let computed = formula.evaluate(|name| value(at(name)));
        prop_assert!((computed.re - expected.re).abs() < 1e-6, "{} for {} of {}", computed, expected, formula);
        prop_assert!((computed.eps - expected.eps).abs() < 1e-6, "{} for {} of {}", computed, expected, formula);
        let derivative = formula.derivative(["x", "y", "z"][by]).evaluate(|name| values[at(name)]);
        prop_assert!((derivative - expected.eps).abs() < 1e-6, "{} for {} of {}", derivative, expected, formula);
        let given = ["x", "y", "z"].map(|name| (name, values[at(name)]));
        let read = Reader::of(&formula.text(80)).value(&given.into());
        prop_assert!((read - expected.re).abs() < 1e-6, "{} for {} of {}", read, expected, formula);
    }
}
