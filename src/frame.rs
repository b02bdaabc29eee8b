//! Three frames and the turns between them.
//!
//! | components | axes |
//! |---|---|
//! | [`Xy`] | fixed to the ground |
//! | [`Nt`] | of the contact: normal and tangent of the crush plane, x–y turned by Γ |
//! | [`ForwardLeft`] | of a vehicle: along its heading and to its left |
//!
//! Each is a type of its own, so that a number in one frame cannot be added to a number in another. [`CrushPlane`] leads from x–y to n–t and back,
//! [`Heading`] from a vehicle's axes to x–y and back. Both are a cosine and a sine: given an angle on any [`Real`] scalar, or the tangent of half
//! the angle on any [`Field`], where the cosine and sine come out exact.

use crate::scalar::{Field, Real};
use core::ops::{Add, Mul, Neg, Sub};

macro_rules! components {
    ($(#[$doc:meta])* $name:ident { $(#[$doc_a:meta])* $a:ident, $(#[$doc_b:meta])* $b:ident }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default, PartialEq)]
        pub struct $name<T = f64> {
            $(#[$doc_a])*
            pub $a: T,
            $(#[$doc_b])*
            pub $b: T,
        }

        impl<T> $name<T> {
            /// The same components on another scalar.
            #[inline(always)]
            pub fn map<U>(self, mut f: impl FnMut(T) -> U) -> $name<U> {
                $name { $a: f(self.$a), $b: f(self.$b) }
            }
        }

        impl<T: Field> $name<T> {
            /// No component at all.
            #[inline(always)]
            pub fn zero() -> Self {
                $name { $a: T::int(0), $b: T::int(0) }
            }

            /// The scalar product.
            #[inline(always)]
            pub fn dot(self, other: Self) -> T {
                self.$a * other.$a + self.$b * other.$b
            }

            /// The vertical component of the vector product.
            #[inline(always)]
            pub fn cross(self, other: Self) -> T {
                self.$a * other.$b - self.$b * other.$a
            }

            /// The square of the length.
            #[inline(always)]
            pub fn length_squared(self) -> T {
                self.$a.squared() + self.$b.squared()
            }

            /// Turned by +90°.
            #[inline(always)]
            pub fn quarter_turn(self) -> Self {
                $name { $a: -self.$b, $b: self.$a }
            }
        }

        impl<T: Real> $name<T> {
            /// The length. That of no vector is 0 without derivatives.
            #[inline(always)]
            pub fn length(self) -> T {
                self.length_squared().sqrt()
            }
        }

        impl<T: Field> Add for $name<T> {
            type Output = Self;
            #[inline(always)]
            fn add(self, other: Self) -> Self {
                $name { $a: self.$a + other.$a, $b: self.$b + other.$b }
            }
        }

        impl<T: Field> Sub for $name<T> {
            type Output = Self;
            #[inline(always)]
            fn sub(self, other: Self) -> Self {
                $name { $a: self.$a - other.$a, $b: self.$b - other.$b }
            }
        }

        impl<T: Field> Neg for $name<T> {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                $name { $a: -self.$a, $b: -self.$b }
            }
        }

        impl<T: Field> Mul<T> for $name<T> {
            type Output = Self;
            #[inline(always)]
            fn mul(self, factor: T) -> Self {
                $name { $a: self.$a * factor.clone(), $b: self.$b * factor }
            }
        }
    };
}

components! {
    /// Components along the ground axes.
    Xy {
        /// Along x.
        x,
        /// Along y.
        y
    }
}

components! {
    /// Components along the axes of the contact.
    Nt {
        /// Along the normal of the crush plane.
        n,
        /// Along its tangent: the normal turned by +90°.
        t
    }
}

components! {
    /// Components along the axes of a vehicle.
    ForwardLeft {
        /// Along the heading.
        forward,
        /// To the left of it.
        left
    }
}

macro_rules! direction {
    ($(#[$doc:meta])* $name:ident) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct $name<T = f64> {
            /// Cosine of the angle.
            pub cos: T,
            /// Sine of the angle.
            pub sin: T,
        }

        impl<T> $name<T> {
            /// The same direction on another scalar.
            #[inline(always)]
            pub fn map<U>(self, mut f: impl FnMut(T) -> U) -> $name<U> {
                $name { cos: f(self.cos), sin: f(self.sin) }
            }
        }

        impl<T: Field> $name<T> {
            /// From the tangent `h` of half the angle: cos = (1 − h²)/(1 + h²), sin = 2h/(1 + h²), of unit length exactly. Every angle but 180° has one.
            #[inline(always)]
            pub fn from_half_tangent(h: T) -> Self {
                let square = h.clone().squared();
                let one = T::int(1);
                let scale = (one.clone() + square.clone()).inv();
                $name { cos: (one - square) * scale.clone(), sin: T::int(2) * h * scale }
            }
        }

        impl<T: Real> $name<T> {
            /// From an angle in radians, counter-clockwise from x.
            #[inline(always)]
            pub fn from_angle(angle: T) -> Self {
                let (sin, cos) = angle.sin_cos();
                $name { cos, sin }
            }

            /// The angle in radians, in (−π, π].
            #[inline(always)]
            pub fn angle(self) -> T {
                self.sin.atan2(self.cos)
            }

            /// Turned by an angle in radians, counter-clockwise.
            #[inline(always)]
            #[must_use]
            pub fn turned(self, by: T) -> Self {
                let (sin, cos) = by.sin_cos();
                let (cos, sin) = turn(&self.cos, &self.sin, cos, sin);
                $name { cos, sin }
            }
        }
    };
}

direction! {
    /// Which way a vehicle points: θ, from x, counter-clockwise.
    Heading
}

direction! {
    /// How the crush plane lies: Γ, the angle from x to its normal n, counter-clockwise. Γ and Γ + 180° are the same plane.
    CrushPlane
}

impl<T: Field> Heading<T> {
    /// From the vehicle's axes to the ground's.
    #[inline(always)]
    pub fn to_ground(&self, v: ForwardLeft<T>) -> Xy<T> {
        let (x, y) = turn(&self.cos, &self.sin, v.forward, v.left);
        Xy { x, y }
    }

    /// From the ground's axes to the vehicle's.
    #[inline(always)]
    pub fn to_vehicle(&self, v: Xy<T>) -> ForwardLeft<T> {
        let (forward, left) = turn_back(&self.cos, &self.sin, v.x, v.y);
        ForwardLeft { forward, left }
    }
}

impl<T: Field> CrushPlane<T> {
    /// From the ground's axes to the contact's: P_n = P_x cos Γ + P_y sin Γ, P_t = −P_x sin Γ + P_y cos Γ (A24, A25).
    #[inline(always)]
    pub fn to_contact(&self, v: Xy<T>) -> Nt<T> {
        let (n, t) = turn_back(&self.cos, &self.sin, v.x, v.y);
        Nt { n, t }
    }

    /// From the contact's axes to the ground's.
    #[inline(always)]
    pub fn to_ground(&self, v: Nt<T>) -> Xy<T> {
        let (x, y) = turn(&self.cos, &self.sin, v.n, v.t);
        Xy { x, y }
    }
}

#[inline(always)]
fn turn<T: Field>(cos: &T, sin: &T, a: T, b: T) -> (T, T) {
    (cos.clone() * a.clone() - sin.clone() * b.clone(), sin.clone() * a + cos.clone() * b)
}

#[inline(always)]
fn turn_back<T: Field>(cos: &T, sin: &T, a: T, b: T) -> (T, T) {
    (cos.clone() * a.clone() + sin.clone() * b.clone(), cos.clone() * b - sin.clone() * a)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_normal_leads_the_tangent_by_a_quarter_turn() {
        let n = Nt { n: 1.0, t: 0.0 };
        assert_eq!(n.quarter_turn(), Nt { n: -0.0, t: 1.0 });
        assert_eq!(n.cross(n.quarter_turn()), 1.0);
    }

    #[test]
    fn a_half_tangent_of_one_third_is_the_3_4_5_triangle() {
        let plane = CrushPlane::from_half_tangent(1.0_f64 / 3.0);
        assert!((plane.cos - 0.8).abs() < 1e-15 && (plane.sin - 0.6).abs() < 1e-15);
        let there = plane.to_contact(Xy { x: 4.0, y: 3.0 });
        assert!((there.n - 5.0).abs() < 1e-14 && there.t.abs() < 1e-14);
    }

    #[test]
    fn left_of_east_is_north() {
        let east = Heading { cos: 1.0, sin: 0.0 };
        assert_eq!(east.to_ground(ForwardLeft { forward: 0.0, left: 1.0 }), Xy { x: 0.0, y: 1.0 });
        let north = Heading { cos: 0.0, sin: 1.0 };
        assert_eq!(north.to_ground(ForwardLeft { forward: 2.0, left: 1.0 }), Xy { x: -1.0, y: 2.0 });
        assert_eq!(north.to_vehicle(Xy { x: -1.0, y: 2.0 }), ForwardLeft { forward: 2.0, left: 1.0 });
    }

    #[test]
    fn angle_and_direction_are_inverse() {
        for degrees in [-179.0_f64, -90.0, 0.0, 12.5, 90.0, 180.0] {
            let angle = degrees.to_radians();
            assert!((Heading::from_angle(angle).angle() - angle).abs() < 1e-15);
        }
    }

    #[test]
    fn no_vector_has_length_zero_and_no_derivative() {
        assert_eq!(Xy { x: 0.0, y: 0.0 }.length(), 0.0);
        assert_eq!(Xy { x: 3.0, y: -4.0 }.length(), 5.0);
    }
}
