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

/// The same line as force per width against depth: F/w = A + B C, so that d₀ = A/√B and d₁ = √B.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ForceLine<T = f64> {
    /// A in N/m: where crush begins.
    pub onset: T,
    /// B in N/m², above zero.
    pub slope: T,
}

/// The same line as the speed of a barrier test against the depth it leaves: v = b₀ + b₁ C, so that d = b √(m/w).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BarrierSpeedLine<T = f64> {
    /// b₀ in m/s: the speed that leaves no crush.
    pub onset: T,
    /// b₁ in 1/s.
    pub slope: T,
    /// Mass m of the vehicle as tested, in kg.
    pub test_mass: T,
    /// Width w of the crush in the test, in m.
    pub test_width: T,
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

impl<T: Field> ProfileMoments<T> {
    /// The mean depth over the width, ∫ C dw/w = K₂/(2 K₁), in m.
    pub fn mean_depth(&self) -> T {
        self.second.clone() / (T::int(2) * self.first.clone())
    }
}

impl<T: Real> From<ForceLine<T>> for CrushStiffness<T> {
    fn from(line: ForceLine<T>) -> Self {
        let root = line.slope.sqrt();
        CrushStiffness { onset: line.onset / root.clone(), slope: root }
    }
}

impl<T: Real> From<BarrierSpeedLine<T>> for CrushStiffness<T> {
    fn from(line: BarrierSpeedLine<T>) -> Self {
        let root = (line.test_mass / line.test_width).sqrt();
        CrushStiffness { onset: line.onset * root.clone(), slope: line.slope * root }
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

/// The speed of a vehicle whose kinetic energy is the crush energy, √(2 E_C/m), in m/s.
pub fn speed_of_energy<T: Real>(crush_energy: T, mass: T) -> T {
    (T::int(2) * crush_energy / mass).sqrt()
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
    fn the_three_lines_are_one() {
        let line = CrushStiffness { onset: 3.0, slope: 4.0 };
        assert_eq!(CrushStiffness::from(ForceLine { onset: 12.0, slope: 16.0 }), line);
        // F/w is the slope of E/w: of ½ (d₀ + d₁ C)² at C = ½ it is d₁ (d₀ + d₁ C) = 20 = A + B C.
        assert_eq!(line.slope * line.crush_intensity(0.5), 12.0 + 16.0 * 0.5);
        let barrier = BarrierSpeedLine { onset: 1.5, slope: 2.0, test_mass: 8.0, test_width: 2.0 };
        assert_eq!(CrushStiffness::from(barrier), line);
        // The crush of the test itself is worth the speed of the test: b₀ + b₁ C.
        let energy = line.crush_energy(ProfileMoments::of(2.0, &[0.5, 0.5]).expect("two depths"));
        assert_eq!(speed_of_energy(energy, 8.0), 2.5);
    }

    #[test]
    fn the_mean_depth_weighs_the_ends_by_half() {
        let moments = ProfileMoments::of(3.0, &[0.0, 1.0, 2.0, 0.0]).expect("four depths");
        assert_eq!(moments.mean_depth(), 1.0);
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
