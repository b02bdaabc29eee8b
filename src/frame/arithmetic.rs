//! Arithmetic of components in the same frame.

use core::iter::Sum;
use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use super::{ForwardLeft, Nt, Xy};
use crate::scalar::Field;

macro_rules! arithmetic {
    ($name:ident { $a:ident, $b:ident }) => {
        impl<T: Field> Add for $name<T> {
            type Output = Self;
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn add(self, other: Self) -> Self {
                $name { $a: self.$a + other.$a, $b: self.$b + other.$b }
            }
        }

        impl<T: Field> Sub for $name<T> {
            type Output = Self;
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn sub(self, other: Self) -> Self {
                $name { $a: self.$a - other.$a, $b: self.$b - other.$b }
            }
        }

        impl<T: Field> Neg for $name<T> {
            type Output = Self;
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn neg(self) -> Self {
                $name { $a: -self.$a, $b: -self.$b }
            }
        }

        impl<T: Field> Mul<T> for $name<T> {
            type Output = Self;
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn mul(self, factor: T) -> Self {
                $name { $a: self.$a * factor.clone(), $b: self.$b * factor }
            }
        }

        impl<T: Field> Div<T> for $name<T> {
            type Output = Self;
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn div(self, divisor: T) -> Self {
                $name { $a: self.$a / divisor.clone(), $b: self.$b / divisor }
            }
        }

        impl<T: Field> AddAssign for $name<T> {
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn add_assign(&mut self, other: Self) {
                *self = self.clone() + other;
            }
        }

        impl<T: Field> SubAssign for $name<T> {
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn sub_assign(&mut self, other: Self) {
                *self = self.clone() - other;
            }
        }

        impl<T: Field> MulAssign<T> for $name<T> {
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn mul_assign(&mut self, factor: T) {
                *self = self.clone() * factor;
            }
        }

        impl<T: Field> DivAssign<T> for $name<T> {
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn div_assign(&mut self, divisor: T) {
                *self = self.clone() / divisor;
            }
        }

        impl<T: Field> Sum for $name<T> {
            fn sum<I: Iterator<Item = Self>>(all: I) -> Self {
                all.fold($name::zero(), Add::add)
            }
        }

        impl<'a, T: Field> Sum<&'a $name<T>> for $name<T> {
            fn sum<I: Iterator<Item = &'a Self>>(all: I) -> Self {
                all.cloned().sum()
            }
        }

        arithmetic!(@from the left, $name, f64);
        arithmetic!(@from the left, $name, f32);
    };

    // The language has no generic left factor.
    (@from the left, $name:ident, $float:ty) => {
        impl Mul<$name<$float>> for $float {
            type Output = $name<$float>;
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn mul(self, v: $name<$float>) -> $name<$float> {
                v * self
            }
        }
    };
}

arithmetic!(Xy { x, y });
arithmetic!(Nt { n, t });
arithmetic!(ForwardLeft { forward, left });

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn by_component() {
        let (a, b) = (Xy::new(1.0, -2.0), Xy::new(4.0, 8.0));
        assert_eq!((a + b, a - b, -a), (Xy::new(5.0, 6.0), Xy::new(-3.0, -10.0), Xy::new(-1.0, 2.0)));
        assert_eq!((2.0 * a, a * 2.0, b / 4.0), (Xy::new(2.0, -4.0), Xy::new(2.0, -4.0), Xy::new(1.0, 2.0)));
        assert_eq!(([a, b, a].iter().sum::<Xy>(), [a, b].into_iter().sum::<Xy>()), (Xy::new(6.0, 4.0), a + b));
        let mut c = a;
        c += b;
        c *= 3.0;
        c -= a;
        c /= 2.0;
        assert_eq!(c, Xy::new(7.0, 10.0));
        assert_eq!(0.5_f32 * Nt::new(1.0, 2.0), Nt::new(0.5, 1.0));
    }
}
