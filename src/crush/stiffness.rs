//! The linear law of crush, in the three forms used in the field.
//!
//! | form | equation | d₀, d₁ |
//! |---|---|---|
//! | [`CrushStiffness`] | √(2 E/w) = d₀ + d₁ C | |
//! | [`ForceLine`] | F/w = A + B C, with E/w = G + A C + ½ B C² and G = A²/(2 B) | A/√B, √B |
//! | [`BarrierSpeedLine`] | v = b₀ + b₁ C of a barrier test with mass m and width w | b₀ √(m/w), b₁ √(m/w) |

use super::ProfileMoments;
use crate::scalar::{Field, Real};

/// Stiffness of a vehicle's structure against crush: the line E* = d₀ + d₁ C.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct CrushStiffness<T = f64> {
    /// d₀ in √N: value at which crush begins.
    pub onset: T,
    /// d₁ in √N/m: increase of E* with depth.
    pub slope: T,
}

/// The same line as force per width against depth: F/w = A + B C.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ForceLine<T = f64> {
    /// A in N/m: force per width at which crush begins.
    pub onset: T,
    /// B in N/m², above zero.
    pub slope: T,
}

/// The same line as the speed of a barrier test against the depth it leaves: v = b₀ + b₁ C.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
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

impl<T: Real> From<ForceLine<T>> for CrushStiffness<T> {
    fn from(line: ForceLine<T>) -> Self {
        let root = line.slope.square_root();
        CrushStiffness { onset: line.onset / root.clone(), slope: root }
    }
}

impl<T: Real> From<BarrierSpeedLine<T>> for CrushStiffness<T> {
    fn from(line: BarrierSpeedLine<T>) -> Self {
        let root = (line.test_mass / line.test_width).square_root();
        CrushStiffness { onset: line.onset * root.clone(), slope: line.slope * root }
    }
}

impl<T: Field> From<CrushStiffness<T>> for ForceLine<T> {
    /// Converts with A = d₀ d₁, B = d₁².
    fn from(line: CrushStiffness<T>) -> Self {
        ForceLine { onset: line.onset * line.slope.clone(), slope: line.slope.squared() }
    }
}

impl<T: Field> ForceLine<T> {
    /// Returns G = A²/(2 B), the energy per width that leaves no crush, in J/m.
    ///
    /// ```
    /// use planar_impact::crush::{CrushStiffness, ForceLine};
    /// let line = CrushStiffness { onset: 3.0, slope: 4.0 };
    /// assert_eq!(ForceLine::from(line).energy_without_crush(), line.energy_without_crush());
    /// ```
    pub fn energy_without_crush(&self) -> T {
        self.onset.clone().squared() / (T::int(2) * self.slope.clone())
    }
}

impl<T: Field> CrushStiffness<T> {
    /// Returns the crush energy of a profile, E_C = d₀² K₁ + d₀ d₁ K₂ + d₁² K₃, in J   (Eq 4).
    #[inline]
    pub fn crush_energy(&self, moments: ProfileMoments<T>) -> T {
        self.onset.clone().squared() * moments.first
            + self.onset.clone() * self.slope.clone() * moments.second
            + self.slope.clone().squared() * moments.third
    }

    /// Returns E* = d₀ + d₁ C at a depth C, in √N   (Eq 3).
    pub fn crush_intensity(&self, depth: T) -> T {
        self.onset.clone() + self.slope.clone() * depth
    }

    /// Returns G = ½ d₀², the energy per width that leaves no crush, in J/m.
    pub fn energy_without_crush(&self) -> T {
        self.onset.clone().squared().half()
    }
}

impl<T: Real> CrushStiffness<T> {
    /// Returns the same line as the speed of a barrier test of a given mass (kg) and width (m): b = d √(w/m).
    ///
    /// ```
    /// use planar_impact::crush::{BarrierSpeedLine, CrushStiffness};
    /// let test = BarrierSpeedLine { onset: 1.5, slope: 2.0, test_mass: 8.0, test_width: 2.0 };
    /// assert_eq!(CrushStiffness::from(test).as_barrier_speed(8.0, 2.0), test);
    /// ```
    pub fn as_barrier_speed(&self, test_mass: T, test_width: T) -> BarrierSpeedLine<T> {
        let root = (test_mass.clone() / test_width.clone()).square_root();
        BarrierSpeedLine { onset: self.onset.clone() / root.clone(), slope: self.slope.clone() / root, test_mass, test_width }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{crush_intensity, speed_of_energy};
    use super::*;

    #[test]
    fn a_flat_profile_is_the_line_itself() {
        let stiffness = CrushStiffness { onset: 3.0, slope: 4.0 };
        let moments = ProfileMoments::of(2.0, &[0.5, 0.5]).expect("two depths");
        let energy = stiffness.crush_energy(moments);
        assert_eq!(energy, 25.0);
        assert_eq!(crush_intensity(energy, 2.0), stiffness.crush_intensity(0.5));
    }

    #[test]
    fn the_three_lines_are_one() {
        let line = CrushStiffness { onset: 3.0, slope: 4.0 };
        let force = ForceLine { onset: 12.0, slope: 16.0 };
        assert_eq!((CrushStiffness::from(force), ForceLine::from(line)), (line, force));
        // F/w is the slope of E/w: of ½ (d₀ + d₁ C)² at C = ½ it is d₁ (d₀ + d₁ C) = 20 = A + B C.
        assert_eq!(line.slope * line.crush_intensity(0.5), 12.0 + 16.0 * 0.5);
        let other = BarrierSpeedLine { onset: 1.0, slope: 4.0, test_mass: 18.0, test_width: 2.0 };
        assert_eq!(CrushStiffness::from(other), CrushStiffness { onset: 3.0, slope: 12.0 });
        let barrier = BarrierSpeedLine { onset: 1.5, slope: 2.0, test_mass: 8.0, test_width: 2.0 };
        assert_eq!((CrushStiffness::from(barrier), line.as_barrier_speed(8.0, 2.0)), (line, barrier));
        // The equivalent speed of the test's own crush is the speed of the test: b₀ + b₁ C.
        let energy = line.crush_energy(ProfileMoments::of(2.0, &[0.5, 0.5]).expect("two depths"));
        assert_eq!(speed_of_energy(energy, 8.0), 2.5);
    }

    #[test]
    fn what_leaves_no_crush_is_the_energy_at_depth_zero() {
        let line = CrushStiffness { onset: 3.0, slope: 4.0 };
        let none = ProfileMoments::of(2.0, &[0.0, 0.0]).expect("two depths");
        assert_eq!(line.crush_energy(none), 2.0 * line.energy_without_crush());
        assert_eq!(ForceLine::from(line).energy_without_crush(), 4.5);
        // A structure that does not stiffen has this energy too, although A²/(2 B) is 0/0 there.
        assert_eq!(CrushStiffness { onset: 3.0, slope: 0.0 }.energy_without_crush(), 4.5);
    }
}
