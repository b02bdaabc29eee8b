//! Separations that were computed from ways to rest, and the errors of such ways.
//!
//! Under friction a motion that is k times as fast goes k² times as far and turns k² times as much: the way to rest grows as |w| w, of the velocities w of the center
//! of mass and, relative to it, of the end of the radius of gyration. What is measured is the way. Its error is normal down to a standstill, where that of the speed is
//! not: a way of 0 m ± 0.1 m lets a vehicle stand as well as leave at 1.2 m/s. To first order both say the same.

use super::given::{Evidence, ReconstructionProblem};
use super::measurand::Measurand;
use super::variable::party;
use crate::input::Side;
use crate::output::Output;
use crate::scalar::{Field, Real};

/// The separation of a vehicle that was computed from its way to rest.
pub(super) struct WayToRest {
    components: Vec<Component>,
    /// The square of the size of the given motion g, |g|², in m²/s².
    square: f64,
    /// The square of a motion that hardly differs from a standstill, s², in m²/s².
    standstill: f64,
}

/// A component of the motion at separation.
struct Component {
    /// Its place among the evidence.
    evidence: usize,
    /// Its factor to a velocity: 1, or the radius of gyration.
    arm: f64,
    /// The given velocity.
    given: f64,
}

impl WayToRest {
    /// Returns those of a problem.
    pub(super) fn all(question: &ReconstructionProblem, evidence: &[Evidence]) -> Vec<WayToRest> {
        let sides = Side::ALL.into_iter().filter(|side| question.separation_from_rest[*side as usize]);
        sides.filter_map(|side| WayToRest::of(question, evidence, side)).collect()
    }

    fn of(question: &ReconstructionProblem, evidence: &[Evidence], side: Side) -> Option<WayToRest> {
        /// As a share of the way and its error: of their sum this is a twentieth of the motion. A search does not end there, as it would where the way had no slope.
        const STANDSTILL: f64 = 0.0025;
        let vehicle = party(&question.collision, side).vehicle()?;
        let gyration = vehicle.radius_of_gyration();
        let component = |(of, arm): (Output, f64)| {
            let place = evidence.iter().position(|evidence| evidence.of == Measurand::Output(of))?;
            Some(Component { evidence: place, arm, given: arm * evidence[place].value })
        };
        let components: Vec<Component> = Output::motion_after(side).into_iter().zip([1.0, 1.0, gyration]).filter_map(component).collect();
        let square: f64 = components.iter().map(|component| component.given * component.given).sum();
        let variance = |component: &Component| (component.arm * evidence[component.evidence].weight_scale()).squared();
        let variance: f64 = components.iter().map(variance).sum();
        let standstill = STANDSTILL * (square + 2.0 * (square * variance).sqrt());
        (square > 0.0 && standstill.is_finite()).then_some(WayToRest { components, square, standstill })
    }

    /// Replaces the computed motion by that whose distance from the given one is, to first order, what the ways differ by.
    ///
    /// The ways are q(w) = n w with n² = |w|² + s². Of q(w) = q(g) + J (w′ − g), with the slopes J at the given motion g: w′ = u + g (|g|² − g·u)/(2 |g|² + s²), where
    /// u is w times its n over that of g.
    pub(super) fn straighten<T: Real + Copy + From<f64>>(&self, computed: &mut [T]) {
        let of_given = T::from(self.square + self.standstill);
        let velocity = |component: &Component, computed: &[T]| computed[component.evidence] * T::from(component.arm);
        let squares = self.components.iter().map(|component| velocity(component, computed).magnitude().squared());
        let factor = (squares.fold(T::from(self.standstill), |sum, square| sum + square) / of_given).square_root();
        let along = self.components.iter().map(|component| velocity(component, computed) * T::from(component.given));
        let along = along.fold(T::int(0), |sum, product| sum + product) * factor;
        let share = (T::from(self.square) - along) / T::from(2.0 * self.square + self.standstill);
        for component in &self.components {
            computed[component.evidence] = computed[component.evidence] * factor + share * T::from(component.given / component.arm);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collision::Collision;
    use crate::reconstruct::Uncertainty;
    use crate::vehicle::Vehicle;
    use num_dual::Dual64;

    fn given(of: [f64; 3], sds: [f64; 3]) -> Vec<Evidence> {
        let pieces = Output::motion_after(Side::One).into_iter().zip(of).zip(sds);
        pieces
            .map(|((of, value), sd)| Evidence { of: Measurand::Output(of), value, uncertainty: Uncertainty::StandardDeviation(sd) })
            .collect()
    }

    fn way(evidence: &[Evidence]) -> WayToRest {
        let collision = Collision::new(Vehicle::new(1500.0, 2400.0), Vehicle::new(1500.0, 2400.0));
        let question = ReconstructionProblem { separation_from_rest: [true, false], ..ReconstructionProblem::of(collision) };
        let mut all = WayToRest::all(&question, evidence);
        assert_eq!(all.len(), 1);
        all.remove(0)
    }

    #[test]
    fn to_first_order_nothing_changes() {
        let motion = [3.0, -1.0, 2.0];
        let way = way(&given(motion, [0.5, 0.7, 0.4]));
        for by in 0..3 {
            let mut computed = motion.map(Dual64::from);
            computed[by].eps = 1.0;
            way.straighten(&mut computed);
            for (i, straight) in computed.into_iter().enumerate() {
                assert!((straight.re - motion[i]).abs() < 1e-14, "{i}: {straight}");
                assert!((straight.eps - if i == by { 1.0 } else { 0.0 }).abs() < 1e-14, "{i} by {by}: {straight}");
            }
        }
    }

    /// By hand: a straight slide ends after d = |v| v/(2 μ g), and its end is known to σ in each direction.
    #[test]
    fn residuals_are_those_of_the_place_at_rest() {
        const DECELERATION: f64 = 7.0;
        let end = |[x, y]: [f64; 2]| [x, y].map(|v| v * x.hypot(y) / (2.0 * DECELERATION));
        for (speed, sigma) in [(1.0, 0.3), (2.0, 0.3), (4.0, 0.3)] {
            let [d, _] = end([speed, 0.0]);
            let evidence = given([speed, 0.0, 0.0], [speed * sigma / (2.0 * d), speed * sigma / d, 1.0]);
            let way = way(&evidence);
            for velocity in [[speed, 0.0], [0.5, 0.0], [0.0, 0.0], [-0.7, 0.0], [0.6, 1.1], [-0.8, -0.9], [3.0, 1.0], [4.5, -0.4]] {
                let mut computed = [velocity[0], velocity[1], 0.0];
                way.straighten(&mut computed);
                let residual = |(evidence, computed): (&Evidence, f64)| ((evidence.value - computed) / evidence.weight_scale()).squared();
                let found: f64 = evidence.iter().zip(computed).map(residual).sum();
                let [x, y] = end(velocity);
                let wanted = ((d - x).squared() + y.squared()) / sigma.squared();
                assert!((found - wanted).abs() < 0.02 * (1.0 + wanted), "{velocity:?} for {speed}: {found}, not {wanted}");
            }
        }
    }

    #[test]
    fn a_standstill_has_slopes_and_no_way_is_none() {
        let ways = way(&given([2.0, 0.0, 0.0], [0.5, 0.5, 0.5]));
        let mut computed = [Dual64::from(0.0).derivative(), Dual64::from(0.0), Dual64::from(0.0)];
        ways.straighten(&mut computed);
        // Half of the given motion is left, as d = v²/(2 a) has half the slope of its chord; and a search is led away.
        assert!((computed[0].re - 1.0).abs() < 0.01 && computed[0].eps > 0.01, "{}", computed[0]);
        let problem = ReconstructionProblem::of(Collision::new(Vehicle::new(1500.0, 2400.0), Vehicle::new(1500.0, 2400.0)));
        let from_rest = ReconstructionProblem { separation_from_rest: [true; 2], ..problem.clone() };
        assert!(WayToRest::all(&from_rest, &given([0.0; 3], [0.5; 3])).is_empty());
        assert!(WayToRest::all(&problem, &given([2.0, 0.0, 0.0], [0.5; 3])).is_empty());
    }
}
