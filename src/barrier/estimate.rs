//! A number and its uncertainty.

use crate::scalar::{Field, Real};

/// A number that was measured or fitted, and its variance.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Estimate<T = f64> {
    /// The number.
    pub value: T,
    /// The square of its standard deviation, in the square of its unit.
    pub variance: T,
}

impl<T: Field> Estimate<T> {
    /// Creates an estimate from a number and its standard deviation.
    pub fn with_deviation(value: T, deviation: T) -> Self {
        Estimate { value, variance: deviation.squared() }
    }

    /// Returns the quotient of two independent numbers, with its variance to first order.
    #[must_use]
    pub fn over(self, divisor: Self) -> Self {
        let value = self.value / divisor.value.clone();
        let variance = (self.variance + value.clone().squared() * divisor.variance) / divisor.value.squared();
        Estimate { value, variance }
    }
}

impl<T: Real> Estimate<T> {
    /// Returns the standard deviation, in the unit of the number.
    pub fn deviation(&self) -> T {
        self.variance.clone().square_root()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn relative_variances_of_a_quotient_add_up() {
        let quotient = Estimate::with_deviation(6.0, 0.75).over(Estimate::with_deviation(2.0, 0.5));
        assert_eq!(quotient.value, 3.0);
        // (1/8)² + (1/4)² = 5/64, of 3².
        assert_eq!(quotient.variance, 9.0 * 5.0 / 64.0);
        assert_eq!(Estimate::with_deviation(1.0, 0.25).deviation(), 0.25);
    }
}
