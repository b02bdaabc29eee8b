//! The result of comparing intervals: true, false, or not decided.

use core::ops::{BitAnd, BitOr, BitXor, Not};

/// Truth of a statement about unknown numbers in intervals: it holds for all of them, for none, or this is not decided. The operators are those of Kleene's
/// logic, which claim no more than the operands allow.
///
/// ```
/// use planar_impact::scalar::interval::Truth;
/// assert_eq!(Truth::UNKNOWN & Truth::FALSE, Truth::FALSE);
/// assert_eq!(Truth::UNKNOWN | Truth::FALSE, Truth::UNKNOWN);
/// assert_eq!((!Truth::UNKNOWN).decided(), None);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Truth {
    may_hold: bool,
    may_fail: bool,
}

impl Truth {
    /// It holds for all numbers.
    pub const TRUE: Truth = Truth { may_hold: true, may_fail: false };

    /// It holds for none.
    pub const FALSE: Truth = Truth { may_hold: false, may_fail: true };

    /// It may hold for some and fail for others.
    pub const UNKNOWN: Truth = Truth { may_hold: true, may_fail: true };

    /// Returns `true` or `false` if the statement has this truth for all numbers, and `None` if that is not decided.
    #[inline]
    pub const fn decided(self) -> Option<bool> {
        if self.may_hold && self.may_fail { None } else { Some(self.may_hold) }
    }

    /// Returns `true` if the statement holds for all numbers.
    #[inline]
    pub const fn is_certain(self) -> bool {
        !self.may_fail
    }

    /// Returns `true` if the statement holds for no number.
    #[inline]
    pub const fn is_excluded(self) -> bool {
        !self.may_hold
    }
}

impl From<bool> for Truth {
    #[inline]
    fn from(holds: bool) -> Self {
        Truth { may_hold: holds, may_fail: !holds }
    }
}

impl BitAnd for Truth {
    type Output = Self;
    #[inline]
    fn bitand(self, other: Self) -> Self {
        Truth { may_hold: self.may_hold & other.may_hold, may_fail: self.may_fail | other.may_fail }
    }
}

impl BitOr for Truth {
    type Output = Self;
    #[inline]
    fn bitor(self, other: Self) -> Self {
        Truth { may_hold: self.may_hold | other.may_hold, may_fail: self.may_fail & other.may_fail }
    }
}

impl BitXor for Truth {
    type Output = Self;
    #[inline]
    fn bitxor(self, other: Self) -> Self {
        Truth {
            may_hold: (self.may_hold & other.may_fail) | (self.may_fail & other.may_hold),
            may_fail: (self.may_hold & other.may_hold) | (self.may_fail & other.may_fail),
        }
    }
}

impl Not for Truth {
    type Output = Self;
    #[inline]
    fn not(self) -> Self {
        Truth { may_hold: self.may_fail, may_fail: self.may_hold }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [Truth; 3] = [Truth::TRUE, Truth::FALSE, Truth::UNKNOWN];

    /// Returns the truths that an operand may have.
    fn cases(truth: Truth) -> impl Iterator<Item = bool> + Clone {
        [true, false].into_iter().filter(move |case| truth.decided().is_none_or(|decided| decided == *case))
    }

    /// An operator has exactly the truths that it has in the cases of its operands.
    fn of_cases(mut cases: impl Iterator<Item = bool> + Clone) -> Truth {
        Truth { may_hold: cases.clone().any(|case| case), may_fail: cases.any(|case| !case) }
    }

    #[test]
    fn operators_are_those_of_every_case() {
        for one in ALL {
            assert_eq!(!one, of_cases(cases(one).map(|one| !one)));
            assert_eq!((one.is_certain(), one.is_excluded()), (one.decided() == Some(true), one.decided() == Some(false)));
            for other in ALL {
                let pairs =
                    |of: fn(bool, bool) -> bool| of_cases(cases(one).flat_map(move |one| cases(other).map(move |other| of(one, other))));
                assert_eq!(one & other, pairs(|one, other| one & other));
                assert_eq!(one | other, pairs(|one, other| one | other));
                assert_eq!(one ^ other, pairs(|one, other| one ^ other));
            }
        }
        assert_eq!([true, false].map(Truth::from), [Truth::TRUE, Truth::FALSE]);
    }
}
