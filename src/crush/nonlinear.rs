//! Laws of crush other than the linear one.
//!
//! | law | F/w | E/w | energy of a profile |
//! |---|---|---|---|
//! | [`CrushStiffness`], linear | A + B C | G + A C + ½ B C² | exact (Eq 4) |
//! | [`ConstantForce`] | F | G + F C | exact |
//! | [`Saturating`] | A + B min(C, C_s) | quadratic up to C_s, linear beyond | exact |
//! | [`PowerLaw`] | F_r (C/C_r)ⁿ | G + F_r C_r/(n + 1) (C/C_r)ⁿ⁺¹ | exact if accurate in floating point, otherwise by quadrature |
//!
//! The third test of the paper's barrier series reportedly behaved as a constant force.

use super::{CrushLaw, CrushStiffness, ForceLine, Segment, energy_by_quadrature};
use crate::scalar::{Field, Ordered, Power};

/// The same force per width at every depth.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ConstantForce<T = f64> {
    /// G in J/m: the energy per width that leaves no crush.
    pub energy_without_crush: T,
    /// F in N/m.
    pub force: T,
}

impl<T: Field> CrushLaw<T> for ConstantForce<T> {
    fn force(&self, _depth: T) -> T {
        self.force.clone()
    }

    fn energy(&self, depth: T) -> T {
        self.energy_without_crush.clone() + self.force.clone() * depth
    }

    fn energy_of_segment(&self, segment: &Segment<T>) -> T {
        segment.width.clone() * self.energy((segment.from.clone() + segment.to.clone()).half())
    }
}

/// The linear law up to a depth, and a constant force beyond it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Saturating<T = f64> {
    /// The linear law.
    pub stiffness: CrushStiffness<T>,
    /// C_s in m: depth at which the force stops growing.
    pub depth: T,
}

impl<T: Ordered> Saturating<T> {
    fn beyond(&self, depth: &T) -> T {
        (depth.clone() - self.depth.clone()).larger(T::int(0))
    }

    fn slope(&self) -> T {
        ForceLine::from(self.stiffness.clone()).slope
    }

    /// Returns ∫ (C − C_s) dw over the part of a segment that is deeper than C_s.
    pub(super) fn area_beyond(&self, segment: &Segment<T>) -> T {
        let (from, to) = (self.beyond(&segment.from), self.beyond(&segment.to));
        let share = self.share_beyond(segment, &from, &to);
        (segment.width.clone() * (from + to) * share).half()
    }

    /// Returns the share of the width that is deeper than C_s, where some of it is, from the depths of its ends beyond C_s.
    fn share_beyond(&self, segment: &Segment<T>, from: &T, to: &T) -> T {
        let deep = from.clone().larger(to.clone());
        // If only one end is beyond C_s, the ratio of the width beyond to the whole is the ratio of the depth beyond to the difference of the depths.
        let reach = (segment.to.clone() - segment.from.clone()).magnitude();
        let crosses = deep.less(&reach);
        let share = deep / T::select(T::int(0).less(&reach), reach, T::int(1));
        // From 0 to 1 where it crosses, which an interval of depths that may be equal does not know.
        T::select(crosses, share.larger(T::int(0)).smaller(T::int(1)), T::int(1))
    }
}

impl<T: Ordered> CrushLaw<T> for Saturating<T> {
    fn force(&self, depth: T) -> T {
        let over = self.beyond(&depth);
        CrushLaw::force(&self.stiffness, depth) - self.slope() * over
    }

    fn energy(&self, depth: T) -> T {
        let over = self.beyond(&depth);
        CrushLaw::energy(&self.stiffness, depth) - (self.slope() * over.squared()).half()
    }

    /// Returns the energy of the linear law, less ½ B (C − C_s)² over the part that is deeper than C_s.
    fn energy_of_segment(&self, segment: &Segment<T>) -> T {
        let (from, to) = (self.beyond(&segment.from), self.beyond(&segment.to));
        let share = self.share_beyond(segment, &from, &to);
        let squares = from.clone().squared() + from * to.clone() + to.squared();
        let over = self.slope() * squares * share / T::int(6);
        CrushLaw::energy_of_segment(&self.stiffness, segment) - segment.width.clone() * over
    }
}

/// A force per width that grows with a power of the depth.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PowerLaw<T = f64> {
    /// G in J/m: the energy per width that leaves no crush.
    pub energy_without_crush: T,
    /// F_r in N/m: the force per width at the reference depth.
    pub force: T,
    /// C_r in m, above zero.
    pub reference_depth: T,
    /// n, at least 0.
    pub exponent: T,
}

impl<T: Power> PowerLaw<T> {
    /// Returns (C/C_r)ᵖ.
    fn power(&self, depth: T, exponent: T) -> T {
        (depth / self.reference_depth.clone()).power(exponent)
    }

    fn plus(&self, n: i32) -> T {
        self.exponent.clone() + T::int(n)
    }
}

impl<T: Power<Mask = bool>> CrushLaw<T> for PowerLaw<T> {
    fn force(&self, depth: T) -> T {
        self.force.clone() * self.power(depth, self.exponent.clone())
    }

    fn energy(&self, depth: T) -> T {
        let factor = self.force.clone() * self.reference_depth.clone() / self.plus(1);
        self.energy_without_crush.clone() + factor * self.power(depth, self.plus(1))
    }

    /// Returns the energy from the integral of the power, a difference of powers over the difference of depths. If the depths are close to each other it
    /// would lose digits; there the law is smooth enough for quadrature to be exact to rounding.
    fn energy_of_segment(&self, segment: &Segment<T>) -> T {
        let (from, to) = (segment.from.clone(), segment.to.clone());
        let reach = (to.clone() - from.clone()).magnitude();
        if !(from.clone() + to.clone()).less(&(T::int(4) * reach)) {
            return energy_by_quadrature(self, segment);
        }
        let factor = self.force.clone() * self.reference_depth.clone().squared() / (self.plus(1) * self.plus(2));
        let powers = (self.power(to.clone(), self.plus(2)) - self.power(from.clone(), self.plus(2))) / (to - from);
        segment.width.clone() * (self.energy_without_crush.clone() + factor * powers)
    }
}

#[cfg(test)]
mod tests {
    use super::super::Profile;
    use super::*;
    use alloc::vec;
    use approx::assert_relative_eq;

    const LINE: CrushStiffness = CrushStiffness { onset: 3.0, slope: 4.0 };

    fn profile() -> Profile {
        Profile::at_stations(vec![0.0, 0.5, 1.5, 2.0, 3.5], vec![0.0, 0.75, 0.25, 0.25, 1.0]).expect("five depths")
    }

    /// Sums the energy of many thin slices, each at its middle depth.
    fn sliced<L: CrushLaw<f64>>(law: &L, profile: &Profile) -> f64 {
        const SLICES: i32 = 20_000;
        let slice = |segment: Segment| {
            let depth = |i: i32| segment.from + (segment.to - segment.from) * (f64::from(i) + 0.5) / f64::from(SLICES);
            (0..SLICES).map(|i| law.energy(depth(i))).sum::<f64>() * segment.width / f64::from(SLICES)
        };
        profile.segments().map(slice).sum()
    }

    #[test]
    fn a_constant_force_is_a_force_times_the_mean_depth() {
        let law = ConstantForce { energy_without_crush: 2.0, force: 10.0 };
        let profile = profile();
        let expected = profile.width() * (2.0 + 10.0 * profile.moments().mean_depth());
        assert_relative_eq!(law.energy_of(&profile), expected, max_relative = 1e-14);
        assert_relative_eq!(sliced(&law, &profile), expected, max_relative = 1e-12);
    }

    #[test]
    fn saturation_is_the_linear_law_until_it_is_reached() {
        let deep = Saturating { stiffness: LINE, depth: 1.0 };
        assert_eq!(deep.energy_of(&profile()), profile().segments().map(|s| LINE.energy_of_segment(&s)).sum::<f64>());
        // Saturating at zero depth, it is the constant force A = 12 with G = 4.5.
        let shallow = Saturating { stiffness: LINE, depth: 0.0 };
        let constant = ConstantForce { energy_without_crush: 4.5, force: 12.0 };
        assert_relative_eq!(shallow.energy_of(&profile()), constant.energy_of(&profile()), max_relative = 1e-14);
        for depth in [0.1, 0.25, 0.5, 0.9] {
            let law = Saturating { stiffness: LINE, depth };
            assert_relative_eq!(law.energy_of(&profile()), sliced(&law, &profile()), max_relative = 1e-8);
            assert_relative_eq!(law.force(depth + 0.5), law.force(depth), max_relative = 1e-14);
        }
    }

    #[test]
    fn a_power_of_one_is_the_linear_law_without_onset() {
        let line = CrushStiffness { onset: 0.0, slope: 4.0 };
        let law = PowerLaw { energy_without_crush: 0.0, force: 16.0, reference_depth: 1.0, exponent: 1.0 };
        assert_relative_eq!(law.energy_of(&profile()), line.energy_of(&profile()), max_relative = 1e-14);
        let constant = PowerLaw { energy_without_crush: 2.0, force: 10.0, reference_depth: 0.3, exponent: 0.0 };
        let same = ConstantForce { energy_without_crush: 2.0, force: 10.0 };
        assert_relative_eq!(constant.energy_of(&profile()), same.energy_of(&profile()), max_relative = 1e-14);
    }

    #[test]
    fn the_formula_and_the_quadrature_of_a_power_meet() {
        for exponent in [0.5, 1.5, 2.25] {
            let law = PowerLaw { energy_without_crush: 1.0, force: 10.0, reference_depth: 0.5, exponent };
            assert_relative_eq!(law.energy_of(&profile()), sliced(&law, &profile()), max_relative = 1e-7);
            // At the boundary between the two methods both are accurate to rounding.
            let segment = Segment { width: 2.0, from: 0.375, to: 0.625 };
            let a_little_less = Segment { to: 0.624_999_999_999, ..segment };
            let (one, other) = (law.energy_of_segment(&segment), law.energy_of_segment(&a_little_less));
            assert_relative_eq!(one, other, max_relative = 1e-11);
            assert_relative_eq!(law.energy_of_segment(&a_little_less), energy_by_quadrature(&law, &a_little_less), max_relative = 1e-13);
            // Between depths that are nearly one, a difference of powers would have no digits left.
            for (from, to) in [(0.5, 0.5 + 1e-12), (2.0, 2.0 - 1e-12), (0.125, 0.125)] {
                let level = Segment { width: 2.0, from, to };
                assert_relative_eq!(law.energy_of_segment(&level), 2.0 * law.energy(from), max_relative = 1e-11);
            }
        }
    }

    /// Depths and the reference depth in another unit: the same choice of method, and the same bits.
    #[test]
    fn the_energy_of_a_power_does_not_depend_on_the_unit_of_depth() {
        let small = 1.0 / f64::from(1 << 20);
        for (from, to) in [(0.5, 0.500_001), (0.5, 0.75), (0.375, 0.625), (0.1, 0.9), (0.25, 0.1)] {
            let law = PowerLaw { energy_without_crush: 0.0, force: 10.0, reference_depth: 0.5, exponent: 1.5 };
            let segment = Segment { width: 2.0, from, to };
            let other = PowerLaw { reference_depth: 0.5 * small, ..law };
            let same = Segment { from: from * small, to: to * small, ..segment };
            assert_eq!(other.energy_of_segment(&same), law.energy_of_segment(&segment) * small, "{from} to {to}");
        }
    }

    #[test]
    fn a_power_law_by_hand() {
        // With F_r = 10, C_r = 1/2 and C = 2, (C/C_r)ⁿ is 2 and 8; the mean of (C/C_r)ⁿ⁺¹ from 0 is the last one over n + 2.
        for (exponent, force, powers) in [(0.5, 20.0, 8.0), (1.5, 80.0, 32.0)] {
            let law = PowerLaw { energy_without_crush: 1.0, force: 10.0, reference_depth: 0.5, exponent };
            let energy = 5.0 * powers / (exponent + 1.0);
            assert_relative_eq!(law.force(2.0), force, max_relative = 1e-15);
            assert_relative_eq!(law.energy(2.0), 1.0 + energy, max_relative = 1e-15);
            for (from, to) in [(0.0, 2.0), (2.0, 0.0)] {
                let segment = Segment { width: 3.0, from, to };
                assert_relative_eq!(law.energy_of_segment(&segment), 3.0 * (1.0 + energy / (exponent + 2.0)), max_relative = 1e-15);
            }
        }
    }
}
