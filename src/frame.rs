//! Three frames and the rotations between them.
//!
//! | components | axes |
//! |---|---|
//! | [`Xy`] | fixed to the ground |
//! | [`Nt`] | of the contact: normal and tangent of the crush plane, x–y turned by Γ |
//! | [`ForwardLeft`] | of a vehicle: along its heading and to its left |
//!
//! Each is a separate type, so components in different frames cannot be added. [`CrushPlane`] converts between x–y and n–t, [`Heading`] between a vehicle's
//! axes and x–y. Both are a cosine and a sine, computed from an angle on any [`Real`] scalar, or from the tangent of half the angle on any [`Field`], where
//! the cosine and sine are exact.

mod arithmetic;
mod conversion;

use crate::scalar::{Field, Real};

macro_rules! components {
    ($(#[$doc:meta])* $name:ident { $(#[$doc_a:meta])* $a:ident, $(#[$doc_b:meta])* $b:ident }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default, PartialEq)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        pub struct $name<T = f64> {
            $(#[$doc_a])*
            pub $a: T,
            $(#[$doc_b])*
            pub $b: T,
        }

        impl<T> $name<T> {
            /// Converts the components to another scalar type.
            #[cfg_attr(not(debug_assertions), inline(always))]
            pub fn map<U>(self, mut f: impl FnMut(T) -> U) -> $name<U> {
                $name { $a: f(self.$a), $b: f(self.$b) }
            }
        }

        impl<T: Field> $name<T> {
            /// Returns the zero vector.
            #[cfg_attr(not(debug_assertions), inline(always))]
            pub fn zero() -> Self {
                $name { $a: T::int(0), $b: T::int(0) }
            }

            /// Returns the scalar product.
            #[cfg_attr(not(debug_assertions), inline(always))]
            pub fn dot(self, other: Self) -> T {
                self.$a * other.$a + self.$b * other.$b
            }

            /// Returns the vertical component of the vector product.
            #[cfg_attr(not(debug_assertions), inline(always))]
            pub fn cross(self, other: Self) -> T {
                self.$a * other.$b - self.$b * other.$a
            }

            /// Returns the square of the length.
            #[cfg_attr(not(debug_assertions), inline(always))]
            pub fn length_squared(self) -> T {
                self.$a.squared() + self.$b.squared()
            }

            /// Returns the vector rotated by +90°.
            #[cfg_attr(not(debug_assertions), inline(always))]
            pub fn quarter_turn(self) -> Self {
                $name { $a: -self.$b, $b: self.$a }
            }
        }

        impl<T: Real> $name<T> {
            /// Returns the length. For the zero vector it is 0 without derivatives.
            #[cfg_attr(not(debug_assertions), inline(always))]
            pub fn length(self) -> T {
                self.length_squared().square_root()
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
        /// To the left of the heading.
        left
    }
}

macro_rules! direction {
    ($(#[$doc:meta])* $name:ident) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        pub struct $name<T = f64> {
            /// Cosine of the angle.
            pub cos: T,
            /// Sine of the angle.
            pub sin: T,
        }

        impl<T> $name<T> {
            /// Converts the direction to another scalar type.
            #[cfg_attr(not(debug_assertions), inline(always))]
            pub fn map<U>(self, mut f: impl FnMut(T) -> U) -> $name<U> {
                $name { cos: f(self.cos), sin: f(self.sin) }
            }
        }

        impl<T: Field> $name<T> {
            /// Creates the direction from the tangent `h` of half the angle: cos = (1 − h²)/(1 + h²), sin = 2h/(1 + h²), of unit length exactly. Every angle
            /// except 180° has such a tangent.
            #[cfg_attr(not(debug_assertions), inline(always))]
            pub fn from_half_tangent(h: T) -> Self {
                let square = h.clone().squared();
                let one = T::int(1);
                let scale = (one.clone() + square.clone()).inv();
                $name { cos: (one - square) * scale.clone(), sin: T::int(2) * h * scale }
            }
        }

        impl<T: Real> $name<T> {
            /// Creates the direction from an angle in radians, counter-clockwise from x.
            #[cfg_attr(not(debug_assertions), inline(always))]
            pub fn from_angle(angle: T) -> Self {
                let (sin, cos) = angle.sin_and_cos();
                $name { cos, sin }
            }

            /// Returns the angle in radians, in (−π, π].
            #[cfg_attr(not(debug_assertions), inline(always))]
            pub fn angle(self) -> T {
                self.sin.arctangent(self.cos)
            }

            /// Returns the direction rotated by an angle in radians, counter-clockwise. However often it is turned, its length stays 1 to within rounding.
            #[cfg_attr(not(debug_assertions), inline(always))]
            #[must_use]
            pub fn turned(self, by: T) -> Self {
                self.turned_like(&$name::from_angle(by))
            }

            /// Returns the direction rotated by the angle of another.
            #[cfg_attr(not(debug_assertions), inline(always))]
            pub(crate) fn turned_like(self, by: &Self) -> Self {
                let (cos, sin) = turn(&self.cos, &self.sin, by.cos.clone(), by.sin.clone());
                // One step of Newton's method for the inverse square root of the length squared, from 1.
                let scale = (T::int(3) - cos.clone().squared() - sin.clone().squared()).half();
                $name { cos: cos * scale.clone(), sin: sin * scale }
            }

            /// Returns the direction rotated once, by the addition theorem alone: its formula, and the bits of a direction turned by zero, stay as they are.
            #[cfg_attr(not(debug_assertions), inline(always))]
            pub(crate) fn shifted(self, by: T) -> Self {
                let (sin, cos) = by.sin_and_cos();
                let (cos, sin) = turn(&self.cos, &self.sin, cos, sin);
                $name { cos, sin }
            }
        }
    };
}

direction! {
    /// Heading of a vehicle: θ, from x, counter-clockwise.
    Heading
}

direction! {
    /// Orientation of the crush plane: Γ, the angle from x to its normal n, counter-clockwise. Γ and Γ + 180° are the same plane.
    CrushPlane
}

impl Heading {
    /// Creates the heading from an angle in degrees, counter-clockwise from x.
    ///
    /// ```
    /// use planar_impact::{Heading, Xy};
    /// let north = Heading::from_degrees(90.0);
    /// assert!((north.reversed().angle().to_degrees() + 90.0).abs() < 1e-12);
    /// ```
    #[must_use]
    pub fn from_degrees(degrees: f64) -> Self {
        Heading::from_angle(degrees.to_radians())
    }
}

impl CrushPlane {
    /// Creates the crush plane from Γ in degrees.
    #[must_use]
    pub fn from_degrees(degrees: f64) -> Self {
        CrushPlane::from_angle(degrees.to_radians())
    }
}

impl<T: Field> Heading<T> {
    /// Returns the heading along x.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn along_x() -> Self {
        Heading { cos: T::int(1), sin: T::int(0) }
    }

    /// Returns the unit vector straight ahead.
    pub(crate) fn ahead(&self) -> Xy<T> {
        Xy { x: self.cos.clone(), y: self.sin.clone() }
    }

    /// Returns the opposite heading.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn reversed(self) -> Self {
        Heading { cos: -self.cos, sin: -self.sin }
    }

    /// Converts from vehicle axes to ground axes.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn to_ground(&self, v: ForwardLeft<T>) -> Xy<T> {
        let (x, y) = turn(&self.cos, &self.sin, v.forward, v.left);
        Xy { x, y }
    }

    /// Converts from ground axes to vehicle axes.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn to_vehicle(&self, v: Xy<T>) -> ForwardLeft<T> {
        let (forward, left) = turn_back(&self.cos, &self.sin, v.x, v.y);
        ForwardLeft { forward, left }
    }
}

impl<T: Field> Default for Heading<T> {
    /// Along x.
    fn default() -> Self {
        Heading::along_x()
    }
}

impl<T: Field> Default for CrushPlane<T> {
    /// Γ = 0: the normal is along x.
    fn default() -> Self {
        CrushPlane { cos: T::int(1), sin: T::int(0) }
    }
}

impl<T: Field> CrushPlane<T> {
    /// Converts from ground axes to contact axes: P_n = P_x cos Γ + P_y sin Γ, P_t = −P_x sin Γ + P_y cos Γ (A24, A25).
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn to_contact(&self, v: Xy<T>) -> Nt<T> {
        let (n, t) = turn_back(&self.cos, &self.sin, v.x, v.y);
        Nt { n, t }
    }

    /// Converts from contact axes to ground axes.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn to_ground(&self, v: Nt<T>) -> Xy<T> {
        let (x, y) = turn(&self.cos, &self.sin, v.n, v.t);
        Xy { x, y }
    }
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn turn<T: Field>(cos: &T, sin: &T, a: T, b: T) -> (T, T) {
    (cos.clone() * a.clone() - sin.clone() * b.clone(), sin.clone() * a + cos.clone() * b)
}

#[cfg_attr(not(debug_assertions), inline(always))]
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
    fn a_heading_and_its_reverse_are_half_a_turn_apart() {
        let heading = Heading { cos: 0.6, sin: -0.8 };
        assert_eq!(heading.reversed(), Heading { cos: -0.6, sin: 0.8 });
        assert_eq!(heading.reversed().reversed(), heading);
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

    /// By one milliradian ten million times: the length stays within a few roundings, and the angle within their sum.
    #[test]
    fn a_direction_that_is_turned_again_and_again_stays_one() {
        fn off(step: Heading<f64>) -> f64 {
            (step.cos * step.cos + step.sin * step.sin - 1.0).abs()
        }
        let turns = 10_000_000;
        let (mut heading, mut single) = (Heading { cos: 1.0, sin: 0.0 }, Heading { cos: 1.0_f32, sin: 0.0 });
        for _ in 0..turns {
            heading = heading.turned(0.001);
            single = single.turned(0.001);
            assert!(off(heading) < 1e-15 && off(single.map(f64::from)) < 4e-7, "{heading:?} {single:?}");
        }
        let expected = Heading::from_angle(f64::from(turns) * 0.001);
        assert!((heading.cos - expected.cos).hypot(heading.sin - expected.sin) < 1e-8, "{heading:?}, not {expected:?}");
    }

    #[test]
    fn no_vector_has_length_zero_and_no_derivative() {
        assert_eq!(Xy { x: 0.0, y: 0.0 }.length(), 0.0);
        assert_eq!(Xy { x: 3.0, y: -4.0 }.length(), 5.0);
    }
}
