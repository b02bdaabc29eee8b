//! Formulas from recorded operations.

use super::Formula;
use super::expression::{Choice, Expression, Form, Name};
use super::known::{Known, cancelled};
use crate::scalar::symbol::{Operation, Symbol, is_name};
use alloc::collections::BTreeMap;
use alloc::sync::Arc;

/// Names for quantities. Any expression that is one of them, or a number times one of them, is expressed by it.
///
/// ```
/// use planar_impact::formula::Glossary;
/// use planar_impact::scalar::symbol::Symbol;
///
/// let [m, v] = ["m", "v"].map(Symbol::variable);
/// let momentum = m * v.clone();
/// let mut glossary = Glossary::default();
/// glossary.give("p", &momentum);
/// let energy = glossary.formula("E", &(momentum.clone() * v / (Symbol::variable("c") + momentum)));
/// assert_eq!(energy.to_string(), "E = p v/(c + p)\n\nwhere\n  p = m v");
/// ```
#[derive(Clone, Debug, Default)]
pub struct Glossary {
    known: Arc<Known>,
    /// Simplified expressions by identity, which is valid as long as they are stored here.
    done: BTreeMap<usize, (Symbol, Expression)>,
}

impl Glossary {
    /// Creates a glossary without quantities; formulas take their variables in this order.
    pub fn of_variables(names: &[&str]) -> Glossary {
        Glossary { known: Arc::new(Known::of_variables(names)), done: BTreeMap::new() }
    }

    /// Gives an expression a name, in terms of the quantities that already have one, so name a quantity before those that contain it. An expression that is
    /// as short as a name, or is already a quantity, gets none.
    ///
    /// # Panics
    ///
    /// If the name is not valid for a [`Symbol::variable`] either.
    pub fn give(&mut self, name: &str, symbol: &Symbol) {
        assert!(is_name(name), "`{name}` is not a name");
        let value = self.simplified(symbol);
        let named = Arc::make_mut(&mut self.known).add(Name::of(name), value);
        self.done.insert(symbol.identity(), (symbol.clone(), named));
    }

    /// Returns the formula of an expression, in terms of the named quantities.
    ///
    /// # Panics
    ///
    /// If the name is not valid for a [`Symbol::variable`] either.
    pub fn formula(&mut self, name: &str, symbol: &Symbol) -> Formula {
        assert!(is_name(name), "`{name}` is not a name");
        let name = Name::of(name);
        let simplified = self.simplified(symbol);
        let value = match simplified.form() {
            Form::Named(known, value) if *known == name => value.clone(),
            _ => simplified,
        };
        Formula { name, value, known: self.known.clone() }
    }

    fn simplified(&mut self, symbol: &Symbol) -> Expression {
        if let Some((_, expression)) = self.done.get(&symbol.identity()) {
            return expression.clone();
        }
        let mut of = |symbol: &Symbol| self.simplified(symbol);
        let expression = match symbol.operation() {
            Operation::Number(number) => Expression::number(number.clone()),
            Operation::Variable(name) => Expression::variable(name),
            Operation::Neg(a) => of(a).negative(),
            Operation::Inv(a) => of(a).power(-1),
            Operation::Add(a, b) => of(a).plus(&of(b)),
            Operation::Sub(a, b) => of(a).plus(&of(b).negative()),
            Operation::Mul(a, b) => of(a).multiplied(&of(b)),
            Operation::Div(a, b) => of(a).multiplied(&of(b).power(-1)),
            Operation::Sqrt(a) => of(a).root(),
            Operation::Sin(a) => of(a).sine(),
            Operation::Cos(a) => of(a).cosine(),
            Operation::Atan2(y, x) => Expression::angle(of(y), of(x)),
            Operation::Select(less, yes, no) => {
                Expression::choice(Choice { left: of(&less.left), right: of(&less.right), yes: of(yes), no: of(no) })
            }
        };
        let expression = self.known.recognized(&cancelled(expression));
        self.done.insert(symbol.identity(), (symbol.clone(), expression.clone()));
        expression
    }
}
