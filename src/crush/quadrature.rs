//! Energy of a law without a formula for a profile.

use super::{CrushLaw, Segment};
use crate::scalar::Real;

/// Number of parts into which a segment is divided.
const PARTS: i32 = 4;

/// Computes the energy of a segment under a law, in J: the energy per width at five Gauss points in each of four parts, summed with their weights.
///
/// Exact to rounding if the energy is a polynomial of degree at most nine in the depth. A kink of the law inside a segment reduces the accuracy: cut the
/// profile there.
///
/// ```
/// use planar_impact::Real;
/// use planar_impact::crush::{CrushLaw, Profile, Segment, energy_by_quadrature};
///
/// /// Force per width a√C: the energy grows with the 3/2 power of the depth.
/// struct RootLaw(f64);
/// impl CrushLaw<f64> for RootLaw {
///     fn force(&self, depth: f64) -> f64 {
///         self.0 * depth.sqrt()
///     }
///     fn energy(&self, depth: f64) -> f64 {
///         self.0 * depth * depth.sqrt() * 2.0 / 3.0
///     }
///     fn energy_of_segment(&self, segment: &Segment) -> f64 {
///         energy_by_quadrature(self, segment)
///     }
/// }
/// let profile = Profile::equally_spaced(2.0, vec![1.0, 4.0])?;
/// let exact = 2.0 / 3.0 * (2.0 / 5.0) * (32.0 - 1.0) * 2.0 / 3.0;
/// assert!((RootLaw(1.0).energy_of(&profile) / exact - 1.0).abs() < 1e-12);
/// # Ok::<(), planar_impact::Issues<planar_impact::crush::ProfileError>>(())
/// ```
pub fn energy_by_quadrature<T: Real, L: CrushLaw<T> + ?Sized>(law: &L, segment: &Segment<T>) -> T {
    let step = (segment.to.clone() - segment.from.clone()) / T::int(2 * PARTS);
    let mut sum = T::int(0);
    for part in 0..PARTS {
        let middle = segment.from.clone() + step.clone() * T::int(2 * part + 1);
        sum = sum + law.energy(middle.clone()) * weight_of_the_middle();
        for Node { place, weight } in nodes() {
            let away = step.clone() * place;
            sum = sum + weight * (law.energy(middle.clone() - away.clone()) + law.energy(middle.clone() + away));
        }
    }
    segment.width.clone() * sum / T::int(2 * PARTS)
}

/// A pair of Gauss points, one on each side of the middle.
struct Node<T> {
    /// Distance from the middle, from 0 to 1.
    place: T,
    weight: T,
}

fn weight_of_the_middle<T: Real>() -> T {
    T::int(128) / T::int(225)
}

/// Returns the outer points of the five-point Gauss–Legendre rule: ⅓√(5 ∓ 2√(10/7)), with the weights (322 ± 13√70)/900.
fn nodes<T: Real>() -> [Node<T>; 2] {
    let root = T::int(2) * (T::int(10) / T::int(7)).square_root();
    let thirteen = T::int(13) * T::int(70).square_root();
    [
        Node { place: (T::int(5) - root.clone()).square_root() / T::int(3), weight: (T::int(322) + thirteen.clone()) / T::int(900) },
        Node { place: (T::int(5) + root).square_root() / T::int(3), weight: (T::int(322) - thirteen) / T::int(900) },
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    /// Energy per width Cⁿ.
    struct Monomial(i32);

    impl CrushLaw<f64> for Monomial {
        fn force(&self, depth: f64) -> f64 {
            f64::from(self.0) * depth.powi(self.0 - 1)
        }
        fn energy(&self, depth: f64) -> f64 {
            depth.powi(self.0)
        }
        fn energy_of_segment(&self, segment: &Segment) -> f64 {
            energy_by_quadrature(self, segment)
        }
    }

    #[test]
    fn degree_nine_is_exact_and_degree_ten_is_not() {
        let segment = Segment { width: 3.0, from: 1.0, to: 0.0 };
        for n in 0..=9 {
            assert_relative_eq!(Monomial(n).energy_of_segment(&segment), 3.0 / f64::from(n + 1), max_relative = 1e-14);
        }
        let tenth = Monomial(10).energy_of_segment(&segment) * 11.0 / 3.0;
        assert!((1e-15..1e-8).contains(&(tenth - 1.0).abs()), "{tenth}");
    }
}
