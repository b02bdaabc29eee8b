//! A scalar that records the operations on it.
//!
//! The kernel run on symbols computes nothing: it records every operation that it would have done, in order. The expression is therefore that of the code by
//! construction, and evaluated on any scalar it gives the result of the kernel on that scalar, to the bit. [`formula`](crate::formula) makes it readable.

use super::{Ordered, Real};
use alloc::collections::BTreeMap;
use alloc::sync::Arc;
use core::ops::{Add, Div, Mul, Neg, Sub};
use num_rational::BigRational;
use num_traits::{FromPrimitive, Inv, Signed, ToPrimitive};

/// An expression: a name, a number, or an operation on other expressions.
///
/// A clone shares the identity of the expression, so a value that the code uses twice is recorded and evaluated once.
///
/// ```
/// use planar_impact::energy::work;
/// use planar_impact::scalar::symbol::Symbol;
///
/// let [impulse, before, after] = ["P", "v", "V"].map(Symbol::variable);
/// let symbol = work(impulse, before, after);
/// let number = symbol.evaluate(|name| match name {
///     "P" => 2.0,
///     "v" => 3.0,
///     _ => 1.0,
/// });
/// assert_eq!(number, work(2.0, 3.0, 1.0));
/// ```
#[derive(Clone, Debug)]
pub struct Symbol(Arc<Operation>);

/// `left < right`, undecided.
#[derive(Clone, Debug)]
pub struct Less {
    pub(crate) left: Symbol,
    pub(crate) right: Symbol,
}

/// A recorded operation.
#[derive(Debug)]
pub(crate) enum Operation {
    Number(BigRational),
    Variable(Arc<str>),
    Neg(Symbol),
    Inv(Symbol),
    Add(Symbol, Symbol),
    Sub(Symbol, Symbol),
    Mul(Symbol, Symbol),
    Div(Symbol, Symbol),
    Sqrt(Symbol),
    Sin(Symbol),
    Cos(Symbol),
    Atan2(Symbol, Symbol),
    Select(Less, Symbol, Symbol),
}

impl Symbol {
    /// Creates a quantity with only a name. A name has letters, digits and underscores, and begins with a letter, so that it is valid in every notation.
    ///
    /// # Panics
    ///
    /// If the name is not valid.
    pub fn variable(name: &str) -> Symbol {
        assert!(is_name(name), "`{name}` is not a name: it must have letters, digits and underscores, and begin with a letter");
        Symbol::record(Operation::Variable(name.into()))
    }

    /// Returns the operation at its root.
    pub(crate) fn operation(&self) -> &Operation {
        &self.0
    }

    /// Returns its identity, which it shares with its clones, valid as long as one of them lives.
    pub(crate) fn identity(&self) -> usize {
        Arc::as_ptr(&self.0).addr()
    }

    fn record(operation: Operation) -> Symbol {
        Symbol(Arc::new(operation))
    }

    /// Evaluates the expression on another scalar, given each variable by its name. Every operation is done once, in the order in which it was recorded.
    pub fn evaluate<T: Real>(&self, mut variable: impl FnMut(&str) -> T) -> T {
        self.computed(&mut variable, &mut BTreeMap::new())
    }

    fn computed<T: Real>(&self, variable: &mut impl FnMut(&str) -> T, done: &mut BTreeMap<usize, T>) -> T {
        if let Some(value) = done.get(&self.identity()) {
            return value.clone();
        }
        let mut of = |symbol: &Symbol| symbol.computed(variable, done);
        let value = match &*self.0 {
            Operation::Number(number) => in_field(number),
            Operation::Variable(name) => variable(name),
            Operation::Neg(a) => -of(a),
            Operation::Inv(a) => of(a).inv(),
            Operation::Add(a, b) => of(a) + of(b),
            Operation::Sub(a, b) => of(a) - of(b),
            Operation::Mul(a, b) => of(a) * of(b),
            Operation::Div(a, b) => of(a) / of(b),
            Operation::Sqrt(a) => of(a).square_root(),
            Operation::Sin(a) => of(a).sin_and_cos().0,
            Operation::Cos(a) => of(a).sin_and_cos().1,
            Operation::Atan2(y, x) => of(y).arctangent(of(x)),
            Operation::Select(less, yes, no) => {
                let mask = of(&less.left).less(&of(&less.right));
                T::select(mask, of(yes), of(no))
            }
        };
        done.insert(self.identity(), value.clone());
        value
    }
}

/// Returns `true` if it is a valid name in every notation.
pub(crate) fn is_name(name: &str) -> bool {
    name.starts_with(|first: char| first.is_ascii_alphabetic()) && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
}

/// Converts a rational number to any field.
pub(crate) fn in_field<T: super::Field>(number: &BigRational) -> T {
    let (numerator, denominator) = (number.numer(), number.denom());
    let integer = |negative: bool, digits: alloc::vec::Vec<u32>| {
        // Two steps of 2¹⁶ per digit, which is a small integer in every field.
        let half = T::int(1 << 16);
        let magnitude = digits.into_iter().rev().fold(T::int(0), |sum, digit| {
            let (high, low) = ((digit >> 16) as i32, (digit & 0xffff) as i32);
            (sum * half.clone() + T::int(high)) * half.clone() + T::int(low)
        });
        if negative { -magnitude } else { magnitude }
    };
    let whole = match numerator.to_i32() {
        Some(small) => T::int(small),
        None => integer(number.is_negative(), numerator.magnitude().to_u32_digits()),
    };
    if number.is_integer() {
        return whole;
    }
    whole / denominator.to_i32().map_or_else(|| integer(false, denominator.magnitude().to_u32_digits()), T::int)
}

impl FromPrimitive for Symbol {
    fn from_i64(n: i64) -> Option<Self> {
        BigRational::from_i64(n).map(|number| Symbol::record(Operation::Number(number)))
    }

    fn from_u64(n: u64) -> Option<Self> {
        BigRational::from_u64(n).map(|number| Symbol::record(Operation::Number(number)))
    }

    /// Returns the rational number that equals the float.
    fn from_f64(x: f64) -> Option<Self> {
        BigRational::from_float(x).map(|number| Symbol::record(Operation::Number(number)))
    }
}

impl Neg for Symbol {
    type Output = Self;
    fn neg(self) -> Self {
        Symbol::record(Operation::Neg(self))
    }
}

impl Inv for Symbol {
    type Output = Self;
    fn inv(self) -> Self {
        Symbol::record(Operation::Inv(self))
    }
}

macro_rules! recorded {
    ($($operator:ident $method:ident),*) => {
        $(impl $operator for Symbol {
            type Output = Self;
            fn $method(self, other: Self) -> Self {
                Symbol::record(Operation::$operator(self, other))
            }
        })*
    };
}

recorded!(Add add, Sub sub, Mul mul, Div div);

impl Ordered for Symbol {
    /// The condition itself: both results are kept.
    type Mask = Less;

    fn less(&self, other: &Self) -> Less {
        Less { left: self.clone(), right: other.clone() }
    }

    fn select(mask: Less, yes: Self, no: Self) -> Self {
        Symbol::record(Operation::Select(mask, yes, no))
    }
}

impl Real for Symbol {
    fn square_root(self) -> Self {
        Symbol::record(Operation::Sqrt(self))
    }

    fn sin_and_cos(self) -> (Self, Self) {
        (Symbol::record(Operation::Sin(self.clone())), Symbol::record(Operation::Cos(self)))
    }

    fn arctangent(self, x: Self) -> Self {
        Symbol::record(Operation::Atan2(self, x))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scalar::Field;
    use alloc::vec::Vec;
    use core::cell::Cell;

    #[test]
    fn numbers_of_any_size_are_in_every_field() {
        for (numerator, denominator) in [(3, 4), (-7, 1), (1 << 40, 3), (i64::MIN, 1), (5, i64::MAX)] {
            let number = BigRational::new(numerator.into(), denominator.into());
            assert_eq!(in_field::<BigRational>(&number), number);
        }
        let tenth = BigRational::from_float(0.1).expect("finite");
        assert_eq!(in_field::<f64>(&tenth), 0.1);
        assert_eq!(Symbol::from_f64(0.1).map(|symbol| symbol.evaluate(|_| 0.0)), Some(0.1));
        assert!(Symbol::from_f64(f64::NAN).is_none());
    }

    #[test]
    fn what_is_shared_is_evaluated_once() {
        let asked = Cell::new(0);
        let mut power = Symbol::variable("x");
        for _ in 0..60 {
            power = power.squared();
        }
        let one = power.evaluate(|_| {
            asked.set(asked.get() + 1);
            1.0
        });
        assert_eq!((one, asked.get()), (1.0, 1));
    }

    #[test]
    fn a_condition_keeps_both_answers() {
        let x = Symbol::variable("x");
        let magnitude = x.magnitude();
        let at: Vec<f64> = [-2.0, 3.0].into_iter().map(|x| magnitude.evaluate(|_| x)).collect();
        assert_eq!(at, [2.0, 3.0]);
    }

    #[test]
    #[should_panic(expected = "is not a name")]
    fn a_name_is_one_in_every_notation() {
        Symbol::variable("1/2");
    }
}
