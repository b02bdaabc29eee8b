//! Powers with any exponent, for laws that need them.

use super::Real;

/// A real number that can be raised to any power.
///
/// Separate from [`Real`], which every scalar with angles and magnitudes implements: only the power law of crush needs it. Floats take the power from `libm`,
/// so a result has the same bits on every platform; the real part of a dual number is the float.
#[diagnostic::on_unimplemented(
    message = "`{Self}` cannot be raised to any power",
    note = "only the power law of crush needs it: implement `Power`, or use another law"
)]
pub trait Power: Real {
    /// Returns `self` to the power of `exponent`, for `self` at least 0. 0 to the power of 0 is 1. A derivative that is infinite at 0 is omitted.
    fn power(self, exponent: Self) -> Self;
}

#[cfg(not(feature = "dual"))]
mod float {
    use super::Power;

    impl Power for f64 {
        fn power(self, exponent: Self) -> Self {
            libm::pow(self, exponent)
        }
    }

    impl Power for f32 {
        fn power(self, exponent: Self) -> Self {
            libm::powf(self, exponent)
        }
    }
}

#[cfg(feature = "dual")]
mod dual {
    use super::super::Portable;
    use super::Power;
    use num_dual::{DualNum, DualStruct};
    use num_traits::{FromPrimitive, ToPrimitive, Zero};

    // The bound on the primitive is private on purpose: num-dual has two primitives, and both meet it.
    #[allow(private_bounds)]
    impl<T> Power for T
    where
        T: DualNum + DualStruct<Real = <T as DualNum>::Primitive>,
        <T as DualNum>::Primitive: Portable,
    {
        /// Returns the power of the real parts, times the exponential of the remainder of p ln b, which is zero except for its derivatives.
        fn power(self, exponent: Self) -> Self {
            let (base, power) = (self.re(), exponent.re());
            let value = T::from(base.portable_pow(power));
            if T::NDERIV == 0 {
                return value;
            }
            if base.is_zero() {
                let whole = power.to_i32().filter(|&n| n > 0 && FromPrimitive::from_i32(n) == Some(power));
                return whole.map_or(value, |n| self.powi(n));
            }
            // The logarithm of a number whose real part is one is exactly zero there, and carries only the derivatives.
            let logarithm = exponent * ((self / T::from(base)).ln() + T::from(base.portable_ln()));
            let rest = logarithm.clone() - T::from(logarithm.re());
            value * rest.exp()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_of_floats() {
        assert_eq!((2.0.power(3.0), 0.0.power(0.0), 0.0.power(1.5)), (8.0, 1.0, 0.0));
        assert_eq!(4.0_f32.power(0.5), 2.0);
    }

    #[cfg(feature = "dual")]
    #[test]
    fn derivatives_by_base_and_exponent() {
        use num_dual::{Dual2_64, Dual64};
        let (b, p) = (1.7_f64, 2.3_f64);
        let by_base = Dual2_64::new(b, 1.0, 0.0).power(Dual2_64::from(p));
        assert_eq!(by_base.re.to_bits(), b.power(p).to_bits());
        assert!((by_base.v1 / (p * b.powf(p - 1.0)) - 1.0).abs() < 1e-14);
        assert!((by_base.v2 / (p * (p - 1.0) * b.powf(p - 2.0)) - 1.0).abs() < 1e-14);
        let by_exponent = Dual64::from(b).power(Dual64::new(p, 1.0));
        assert!((by_exponent.eps / (b.powf(p) * b.ln()) - 1.0).abs() < 1e-14);
    }

    #[cfg(feature = "dual")]
    #[test]
    fn at_zero_a_whole_power_keeps_its_derivatives() {
        use num_dual::Dual2_64;
        let at_zero = |p: f64| Dual2_64::new(0.0, 1.0, 0.0).power(Dual2_64::from(p));
        assert_eq!((at_zero(1.0).v1, at_zero(1.0).v2), (1.0, 0.0));
        assert_eq!((at_zero(2.0).v1, at_zero(2.0).v2), (0.0, 2.0));
        assert_eq!((at_zero(1.5).re, at_zero(1.5).v1, at_zero(0.5).v1), (0.0, 0.0, 0.0));
    }
}
