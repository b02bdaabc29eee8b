//! The energy that residual crush stands for.
//!
//! The CRASH3 relation is linear: √(2 E_C/w) = d₀ + d₁ C (Eq 3). Over a profile of depths it integrates to E_C = d₀² K₁ + d₀ d₁ K₂ + d₁² K₃ (Eq 4).

use crate::scalar::{Field, Real};

/// Stiffness of a vehicle's structure against crush: the line E* = d₀ + d₁ C.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CrushStiffness<T = f64> {
    /// d₀ in √N: where crush begins.
    pub onset: T,
    /// d₁ in √N/m: how the root of the energy grows with depth.
    pub slope: T,
}

/// K₁, K₂, K₃: the moments of a crush profile (Eq 4).
///
/// Exact for a profile that is piecewise linear between depths at equal distances, so a profile with more points on the same lines has the same moments.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProfileMoments<T = f64> {
    /// K₁ = w/2, in m.
    pub first: T,
    /// K₂ = ∫ C dw, in m².
    pub second: T,
    /// K₃ = ½ ∫ C² dw, in m³.
    pub third: T,
}

impl<T: Field> ProfileMoments<T> {
    /// Of a profile of a given width whose depths are equally spaced over it. None with fewer than two depths.
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
}

impl<T: Field> CrushStiffness<T> {
    /// Crush energy of a profile, E_C = d₀² K₁ + d₀ d₁ K₂ + d₁² K₃, in J   (Eq 4).
    pub fn crush_energy(&self, moments: ProfileMoments<T>) -> T {
        self.onset.clone().squared() * moments.first
            + self.onset.clone() * self.slope.clone() * moments.second
            + self.slope.clone().squared() * moments.third
    }

    /// E* = d₀ + d₁ C at a depth C, in √N   (Eq 3).
    pub fn crush_intensity(&self, depth: T) -> T {
        self.onset.clone() + self.slope.clone() * depth
    }
}

/// E* = √(2 E_C/w), from a crush energy and the width of the crush, in √N   (Eq 3).
pub fn crush_intensity<T: Real>(crush_energy: T, width: T) -> T {
    (T::int(2) * crush_energy / width).sqrt()
}

/// The square of the equivalent energy speed of a series of tests of one vehicle: Σ (1 − e²) v_n², each a normal approach speed and a restitution.
///
/// Eq 9 of the paper prints it without 1 − e², which holds for e = 0 alone; the paper's own tables have the factor.
pub fn equivalent_energy_speed_squared<T: Field>(tests: impl IntoIterator<Item = (T, T)>) -> T {
    tests.into_iter().fold(T::int(0), |sum, (speed, restitution)| sum + (T::int(1) - restitution.squared()) * speed.squared())
}

/// The equivalent energy speed of a series of tests, EES = √Σ (1 − e²) v_n², in m/s   (Eq 9).
pub fn equivalent_energy_speed<T: Real>(tests: impl IntoIterator<Item = (T, T)>) -> T {
    equivalent_energy_speed_squared(tests).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn a_flat_profile_is_the_line_itself() {
        let stiffness = CrushStiffness { onset: 3.0, slope: 4.0 };
        let moments = ProfileMoments::of(2.0, &[0.5, 0.5]).expect("two depths");
        let energy = stiffness.crush_energy(moments);
        assert_eq!(energy, 25.0);
        assert_eq!(crush_intensity(energy, 2.0), stiffness.crush_intensity(0.5));
    }

    #[test]
    fn more_points_on_the_same_lines_change_nothing() {
        let coarse = ProfileMoments::of(6.0_f64, &[0.0, 0.6, 0.3]).expect("three depths");
        let fine = ProfileMoments::of(6.0, &[0.0, 0.3, 0.6, 0.45, 0.3]).expect("five depths");
        assert_relative_eq!(coarse.second, fine.second, max_relative = 1e-15);
        assert_relative_eq!(coarse.third, fine.third, max_relative = 1e-15);
        // A triangle of base 1 and height 1: ∫C = ½, ½∫C² = 1/6.
        let triangle = ProfileMoments::of(1.0, &[0.0, 1.0]).expect("two depths");
        assert_eq!((triangle.second, triangle.third), (0.5, 1.0 / 6.0));
    }

    #[test]
    fn one_depth_is_no_profile() {
        assert_eq!(ProfileMoments::of(1.0, &[0.5]), None);
        assert_eq!(ProfileMoments::<f64>::of(1.0, &[]), None);
    }

    #[test]
    fn equivalent_energy_speed_of_the_first_barrier_test() {
        // Table B2, test 1: v_n = 16.6537 ft/s, EES 16.7 ft/s at e = 0 and 16.4 ft/s at e = 0.18.
        assert_relative_eq!(equivalent_energy_speed([(16.6537, 0.0)]), 16.6537);
        assert_relative_eq!(equivalent_energy_speed([(16.6537, 0.18)]), 16.4, epsilon = 0.05);
        // Test 2 adds up: 33.4 ft/s.
        assert_relative_eq!(equivalent_energy_speed([(16.6537, 0.18), (29.3669, 0.13)]), 33.4, epsilon = 0.05);
    }
}
