//! K₁, K₂, K₃ of a crush profile (Eq 4).

use core::ops::Add;

use crate::scalar::Field;

/// K₁, K₂, K₃: the moments of a crush profile (Eq 4).
///
/// Exact for a profile that is piecewise linear between its depths: a profile with more points on the same lines has the same moments, and the moments of a
/// width are the sum of those of its parts.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ProfileMoments<T = f64> {
    /// K₁ = w/2, in m.
    pub first: T,
    /// K₂ = ∫ C dw, in m².
    pub second: T,
    /// K₃ = ½ ∫ C² dw, in m³.
    pub third: T,
}

impl<T: Field> ProfileMoments<T> {
    /// Computes the moments of a profile of a given width with equally spaced depths. Returns `None` with fewer than two depths.
    ///
    /// ```
    /// use planar_impact::crush::ProfileMoments;
    /// let flat = ProfileMoments::of(2.0, &[0.5, 0.5, 0.5]);
    /// assert_eq!(flat, Some(ProfileMoments { first: 1.0, second: 1.0, third: 0.25 }));
    /// ```
    pub fn of(width: T, depths: &[T]) -> Option<Self> {
        let gaps = i32::try_from(depths.len()).ok().and_then(|n| n.checked_sub(1)).filter(|&gaps| gaps > 0)?;
        let step = width.clone() / T::int(gaps);
        let (mut sum, mut sum_of_squares) = (T::int(0), T::int(0));
        for pair in depths.windows(2) {
            let (a, b) = (pair[0].clone(), pair[1].clone());
            sum = sum + a.clone() + b.clone();
            sum_of_squares = sum_of_squares + a.clone().squared() + a * b.clone() + b.squared();
        }
        Some(ProfileMoments { first: width.half(), second: step.clone() * sum.half(), third: step * sum_of_squares / T::int(6) })
    }

    /// Computes the moments of a width over which the depth changes linearly.
    #[inline]
    pub fn of_segment(width: T, from: T, to: T) -> Self {
        let squares = from.clone().squared() + from.clone() * to.clone() + to.clone().squared();
        ProfileMoments { first: width.clone().half(), second: width.clone() * (from + to).half(), third: width * squares / T::int(6) }
    }

    /// Returns the moments of zero width.
    pub fn zero() -> Self {
        ProfileMoments { first: T::int(0), second: T::int(0), third: T::int(0) }
    }

    /// Returns the width, 2 K₁, in m.
    pub fn width(&self) -> T {
        T::int(2) * self.first.clone()
    }

    /// Returns the mean depth over the width, ∫ C dw/w = K₂/(2 K₁), in m.
    pub fn mean_depth(&self) -> T {
        self.second.clone() / (T::int(2) * self.first.clone())
    }
}

impl<T: Field> Add for ProfileMoments<T> {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        ProfileMoments { first: self.first + other.first, second: self.second + other.second, third: self.third + other.third }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn more_points_on_the_same_lines_change_nothing() {
        let coarse = ProfileMoments::of(6.0_f64, &[0.0, 0.6, 0.3]).expect("three depths");
        let fine = ProfileMoments::of(6.0, &[0.0, 0.3, 0.6, 0.45, 0.3]).expect("five depths");
        assert_relative_eq!(coarse.second, fine.second, max_relative = 1e-15);
        assert_relative_eq!(coarse.third, fine.third, max_relative = 1e-15);
        // A triangle of base 1 and height 1: ∫C = ½, ½∫C² = 1/6.
        let triangle = ProfileMoments::of(1.0, &[0.0, 1.0]).expect("two depths");
        assert_eq!((triangle.second, triangle.third), (0.5, 1.0 / 6.0));
        assert_eq!(triangle, ProfileMoments::of_segment(1.0, 0.0, 1.0));
    }

    #[test]
    fn the_mean_depth_weighs_the_ends_by_half() {
        let moments = ProfileMoments::of(3.0, &[0.0, 1.0, 2.0, 0.0]).expect("four depths");
        assert_eq!(moments.mean_depth(), 1.0);
        assert_eq!(moments.width(), 3.0);
    }

    #[test]
    fn the_parts_add_up() {
        let parts = ProfileMoments::zero() + ProfileMoments::of_segment(1.0, 0.0, 3.0) + ProfileMoments::of_segment(1.0, 3.0, 1.5);
        assert_eq!(Some(parts), ProfileMoments::of(2.0, &[0.0, 3.0, 1.5]));
    }

    #[test]
    fn one_depth_is_no_profile() {
        assert_eq!(ProfileMoments::of(1.0, &[0.5]), None);
        assert_eq!(ProfileMoments::<f64>::of(1.0, &[]), None);
    }
}
