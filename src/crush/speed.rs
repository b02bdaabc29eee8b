//! The equivalent speed of an energy.

use crate::scalar::{Field, Real};

/// Returns E* = √(2 E_C/w), from a crush energy and the width of the crush, in √N   (Eq 3).
pub fn crush_intensity<T: Real>(crush_energy: T, width: T) -> T {
    (T::int(2) * crush_energy / width).square_root()
}

/// Returns the square of the equivalent energy speed of a series of tests of one vehicle: Σ (1 − e²) v_n², from a normal approach speed and a restitution
/// each.
///
/// The paper prints Eq 9 without 1 − e², which holds only for e = 0; the paper's own tables include the factor.
pub fn equivalent_energy_speed_squared<T: Field>(tests: impl IntoIterator<Item = (T, T)>) -> T {
    tests.into_iter().fold(T::int(0), |sum, (speed, restitution)| sum + (T::int(1) - restitution.squared()) * speed.squared())
}

/// Returns the equivalent energy speed of a series of tests, EES = √Σ (1 − e²) v_n², in m/s   (Eq 9).
pub fn equivalent_energy_speed<T: Real>(tests: impl IntoIterator<Item = (T, T)>) -> T {
    equivalent_energy_speed_squared(tests).square_root()
}

/// Returns the speed of a vehicle whose kinetic energy is the crush energy, √(2 E_C/m), in m/s.
pub fn speed_of_energy<T: Real>(crush_energy: T, mass: T) -> T {
    (T::int(2) * crush_energy / mass).square_root()
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn equivalent_energy_speed_of_the_first_barrier_test() {
        // Table B2, test 1: v_n = 16.6537 ft/s, EES 16.7 ft/s at e = 0 and 16.4 ft/s at e = 0.18.
        assert_relative_eq!(equivalent_energy_speed([(16.6537, 0.0)]), 16.6537);
        assert_relative_eq!(equivalent_energy_speed([(16.6537, 0.18)]), 16.4, epsilon = 0.05);
        // Test 2 adds up: 33.4 ft/s.
        assert_relative_eq!(equivalent_energy_speed([(16.6537, 0.18), (29.3669, 0.13)]), 33.4, epsilon = 0.05);
    }
}
