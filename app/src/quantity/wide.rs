//! A number held in two floats, about 32 digits, so that a product of conversion factors is rounded only once, when converted to a float.

/// `high + low` with `|low|` at most half a unit in the last place of `high`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Wide {
    high: f64,
    low: f64,
}

impl Wide {
    /// π; the second word is the error of the first.
    pub(super) const PI: Wide = Wide { high: std::f64::consts::PI, low: 1.224_646_799_147_353_2e-16 };

    pub(super) const fn new(value: f64) -> Wide {
        Wide { high: value, low: 0.0 }
    }

    /// Adds two floats, the second much smaller than the first (Dekker's fast two-sum).
    fn sum(high: f64, low: f64) -> Wide {
        let total = high + low;
        Wide { high: total, low: low - (total - high) }
    }

    pub(super) fn times(self, other: Wide) -> Wide {
        let product = self.high * other.high;
        let error = self.high.mul_add(other.high, -product);
        Wide::sum(product, error + (self.high * other.low + self.low * other.high))
    }

    pub(super) fn over(self, other: Wide) -> Wide {
        let quotient = self.high / other.high;
        let rest = (-quotient).mul_add(other.high, self.high) + self.low - quotient * other.low;
        Wide::sum(quotient, rest / other.high)
    }

    fn sqrt(self) -> Wide {
        let root = self.high.sqrt();
        let rest = (-root).mul_add(root, self.high) + self.low;
        Wide::sum(root, rest / (2.0 * root))
    }

    /// Returns the power with an exponent counted in halves.
    pub(super) fn power(self, halves: i16) -> Wide {
        let mut result = Wide::new(1.0);
        for _ in 0..halves.unsigned_abs() / 2 {
            result = result.times(self);
        }
        if halves % 2 != 0 {
            result = result.times(self.sqrt());
        }
        if halves < 0 { Wide::new(1.0).over(result) } else { result }
    }

    /// Returns the nearest float, or NaN if a step overflowed.
    pub(super) fn value(self) -> f64 {
        self.high
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_words_hold_what_one_loses() {
        let third = Wide::new(1.0).over(Wide::new(3.0));
        assert_eq!(third.times(Wide::new(3.0)).value(), 1.0);
        assert_eq!(third.low, 1.850_371_707_708_594e-17); // 1/3 - fl(1/3), Python fractions
        let root = Wide::new(2.0).power(1);
        assert!((root.low + 9.667_293_313_452_913e-17).abs() < 1e-31); // √2 - fl(√2), Python decimal
        assert_eq!(Wide::new(10.0).power(-4).value(), 0.01);
        assert_eq!(Wide::new(4.0).power(3).value(), 8.0);
    }
}
