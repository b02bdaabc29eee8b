//! Components to and from arrays, tuples and vectors of other crates, in the order of the axes.

use super::{ForwardLeft, Nt, Xy};

macro_rules! conversions {
    ($name:ident { $a:ident, $b:ident }) => {
        impl<T> $name<T> {
            /// Creates a vector from its components, in the order of the axes.
            #[cfg_attr(not(debug_assertions), inline(always))]
            pub const fn new($a: T, $b: T) -> Self {
                $name { $a, $b }
            }
        }

        impl<T> From<[T; 2]> for $name<T> {
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn from([$a, $b]: [T; 2]) -> Self {
                $name { $a, $b }
            }
        }

        impl<T> From<$name<T>> for [T; 2] {
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn from(v: $name<T>) -> Self {
                [v.$a, v.$b]
            }
        }

        impl<T> From<(T, T)> for $name<T> {
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn from(($a, $b): (T, T)) -> Self {
                $name { $a, $b }
            }
        }

        impl<T> From<$name<T>> for (T, T) {
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn from(v: $name<T>) -> Self {
                (v.$a, v.$b)
            }
        }

        #[cfg(feature = "nalgebra")]
        impl<T: nalgebra::Scalar> From<nalgebra::Vector2<T>> for $name<T> {
            fn from(v: nalgebra::Vector2<T>) -> Self {
                let [[$a, $b]] = v.data.0;
                $name { $a, $b }
            }
        }

        #[cfg(feature = "nalgebra")]
        impl<T: nalgebra::Scalar> From<$name<T>> for nalgebra::Vector2<T> {
            fn from(v: $name<T>) -> Self {
                nalgebra::Vector2::new(v.$a, v.$b)
            }
        }

        #[cfg(feature = "mint")]
        impl<T> From<mint::Vector2<T>> for $name<T> {
            fn from(v: mint::Vector2<T>) -> Self {
                $name { $a: v.x, $b: v.y }
            }
        }

        #[cfg(feature = "mint")]
        impl<T> From<$name<T>> for mint::Vector2<T> {
            fn from(v: $name<T>) -> Self {
                mint::Vector2 { x: v.$a, y: v.$b }
            }
        }

        #[cfg(feature = "mint")]
        impl<T> mint::IntoMint for $name<T> {
            type MintType = mint::Vector2<T>;
        }
    };
}

conversions!(Xy { x, y });
conversions!(Nt { n, t });
conversions!(ForwardLeft { forward, left });

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_order_is_that_of_the_axes() {
        assert_eq!(Xy::from([1.0, 2.0]), Xy { x: 1.0, y: 2.0 });
        assert_eq!(Nt::from((1.0, 2.0)), Nt { n: 1.0, t: 2.0 });
        assert_eq!(ForwardLeft::new(1.0, 2.0), ForwardLeft { forward: 1.0, left: 2.0 });
        assert_eq!(<[f64; 2]>::from(Nt { n: 1.0, t: 2.0 }), [1.0, 2.0]);
        assert_eq!(<(f64, f64)>::from(ForwardLeft { forward: 1.0, left: 2.0 }), (1.0, 2.0));
    }

    #[cfg(feature = "nalgebra")]
    #[test]
    fn vectors_of_nalgebra() {
        let v = nalgebra::Vector2::new(1.0, 2.0);
        assert_eq!((Xy::from(v), nalgebra::Vector2::from(Xy::new(1.0, 2.0))), (Xy::new(1.0, 2.0), v));
    }

    #[cfg(feature = "mint")]
    #[test]
    fn vectors_of_mint() {
        let v = mint::Vector2 { x: 1.0, y: 2.0 };
        assert_eq!((ForwardLeft::from(v), mint::Vector2::from(ForwardLeft::new(1.0, 2.0))), (ForwardLeft::new(1.0, 2.0), v));
    }
}
