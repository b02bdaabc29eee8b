//! Limits on restitution and impulse ratio beyond which the vehicles would gain energy.
//!
//! A coefficient of restitution below 1 does not rule out an energy gain. With μ = μ₀ the loss is
//!
//! ```text
//! 2 det K T_L = (1 − e²) K_tt v_n² − 2 K_nt v_n v_t + K_nn v_t²
//! ```
//!
//! which is nonnegative for every approach velocity if and only if e² ≤ 1 − K_nt²/(K_nn K_tt). For a single approach velocity the bound is wider. For a given
//! e, the impulses with that restitution lie on a line, along which the loss is a concave quadratic: it is nonnegative between two impulse ratios, one on
//! each side of zero.

use crate::collision::Collision;
use crate::contact::Contact;
use crate::law::{ImpulseRatio, Law};
use crate::moment::Moment;
use crate::scalar::{Field, Ordered, Real, is_finite};

/// Limits within which a collision gains no energy.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Admissible<T = f64> {
    /// Largest coefficient of restitution at which this collision gains no energy. With [`ImpulseRatio::Critical`] the critical ratio changes with e; any
    /// other ratio is held constant. The value may exceed 1, which does not mean that such a restitution is possible.
    pub restitution: T,
    /// Largest coefficient of restitution at which no approach velocity gains energy at the critical ratio; 1 for the law of Kudlich and Slibar.
    pub restitution_for_any_approach: T,
    /// Smallest impulse ratio that gains no energy at the given restitution, or `None` if there is none. Never above zero.
    pub least_impulse_ratio: Option<T>,
    /// Largest impulse ratio that gains no energy at the given restitution, or `None` if there is none. Never below zero.
    pub greatest_impulse_ratio: Option<T>,
}

impl<T: Field> Contact<T> {
    /// Returns the square of the largest restitution at which this approach velocity gains no energy at the critical ratio: v·adj(K) v / (K_tt v_n²).
    pub fn critical_restitution_bound_squared(&self) -> T {
        let normal = self.compliance.tt.clone() * self.approach.n.clone().squared();
        self.compliance.determinant.clone() * self.greatest_loss() * T::int(2) / normal
    }

    /// Returns the square of the largest restitution at which no approach velocity gains energy at the critical ratio: 1 − K_nt²/(K_nn K_tt).
    pub fn restitution_bound_for_any_approach_squared(&self) -> T {
        let k = &self.compliance;
        k.determinant.clone() / (k.nn.clone() * k.tt.clone())
    }

    /// Returns the largest restitution at which an impulse with the given ratio gains no energy: (1 + 2μr − s)/(1 + s) with r = v_t/v_n and s = μ (K_nt + μ
    /// K_tt)/(K_nn + μ K_nt). At this restitution the bracket of Eq 1 vanishes.
    pub fn restitution_bound_at_ratio(&self, ratio: T) -> T {
        let k = &self.compliance;
        let r = self.approach.t.clone() / self.approach.n.clone();
        let s = ratio.clone() * (k.nt.clone() + ratio.clone() * k.tt.clone()) / k.along_ratio(ratio.clone());
        (T::int(1) + T::int(2) * ratio * r - s.clone()) / (T::int(1) + s)
    }
}

impl<T: Real + Ordered<Mask = bool>> Collision<T> {
    /// Returns the limits within which this collision gains no energy. Returns `None` with a moment impulse, which shifts the bounds, and for inputs that
    /// [`Collision::solve`] refuses or for which a limit is not finite.
    pub fn admissible(&self) -> Option<Admissible<T>> {
        if self.moment_is_on() {
            return None;
        }
        let contact = self.checked_contact().ok()?;
        let any = contact.restitution_bound_for_any_approach_squared().square_root();
        let restitution = match (self.law, &self.impulse_ratio) {
            (Law::Brach, ImpulseRatio::Critical) => contact.critical_restitution_bound_squared().square_root(),
            (Law::KudlichSlibar, ImpulseRatio::Critical) => T::int(1),
            _ => {
                let impulse = self.impulse(&contact).0;
                contact.restitution_bound_at_ratio(impulse.t / impulse.n)
            }
        };
        let (least, greatest) = contact.ratios_without_gain(self.restitution.clone());
        let is_bounded = [Some(&restitution), Some(&any), least.as_ref(), greatest.as_ref()].into_iter().flatten().all(is_finite);
        is_bounded.then(|| Admissible {
            restitution,
            restitution_for_any_approach: if self.law == Law::Brach { any } else { T::int(1) },
            least_impulse_ratio: least,
            greatest_impulse_ratio: greatest,
        })
    }

    fn moment_is_on(&self) -> bool {
        !matches!(self.moment, Moment::None)
    }
}

impl<T: Real + Ordered<Mask = bool>> Contact<T> {
    /// Returns the impulse ratios between which an impulse with the given restitution gains no energy.
    ///
    /// Along that line T_L(P_t) = (1 − e²) v_n²/(2 K_nn) + b P_t − det K/(2 K_nn) P_t² with b = v_t − v_n K_nt/K_nn, which vanishes on either side of zero.
    /// A ratio that would need a tensile normal impulse is not a bound.
    fn ratios_without_gain(&self, restitution: T) -> (Option<T>, Option<T>) {
        let k = &self.compliance;
        let v = &self.approach;
        let base = (T::int(1) - restitution.clone().squared()) * v.n.clone().squared() / k.nn.clone();
        let slope = v.t.clone() - v.n.clone() * k.nt.clone() / k.nn.clone();
        let curvature = k.determinant.clone() / k.nn.clone();
        let root = (slope.clone().squared() + base * curvature.clone()).square_root();
        let change = (T::int(1) + restitution) * v.n.clone();
        let ratio = |t: T| {
            let n = (change.clone() - k.nt.clone() * t.clone()) / k.nn.clone();
            let pushes = T::int(0).less(&(n.clone() * v.n.clone()));
            pushes.then(|| t / n)
        };
        let (low, high) = (ratio((slope.clone() - root.clone()) / curvature.clone()), ratio((slope + root) / curvature));
        // P_n points against n if body two is ahead, which reverses the order of the ratios.
        if v.n.less(&T::int(0)) { (high, low) } else { (low, high) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::{CrushPlane, ForwardLeft, Heading, Xy};
    use crate::vehicle::{Motion, Party, Vehicle};

    /// Unit mass and inertia against a wall, arm (−1, 1), v = (−3, −2): at e = 1 it gains two thirds of a joule.
    fn kane(restitution: f64) -> Collision {
        Collision {
            one: Party::Vehicle(Vehicle {
                mass: 1.0,
                yaw_inertia: 1.0,
                heading: Heading { cos: 1.0, sin: 0.0 },
                impact_center: ForwardLeft { forward: -1.0, left: 1.0 },
                motion: Motion { velocity: Xy { x: -3.0, y: -2.0 }, yaw_rate: 0.0 },
            }),
            two: Party::Barrier,
            crush_plane: CrushPlane { cos: 1.0, sin: 0.0 },
            restitution,
            impulse_ratio: ImpulseRatio::Critical,
            law: Law::Brach,
            moment: Moment::None,
        }
    }

    #[test]
    fn the_loss_vanishes_at_the_bounds() {
        let admissible = kane(1.0).admissible().expect("no moment");
        assert!((kane(1.0).evaluate().loss() + 2.0 / 3.0).abs() < 1e-14);
        assert!(admissible.restitution < 1.0);
        assert!(kane(admissible.restitution).evaluate().loss().abs() < 1e-13);
        // K = [[2, 1], [1, 2]]: e² ≤ 1 − 1/4.
        assert!((admissible.restitution_for_any_approach - 0.75_f64.sqrt()).abs() < 1e-15);
        for restitution in [0.0, 0.4] {
            let admissible = kane(restitution).admissible().expect("no moment");
            for ratio in [admissible.least_impulse_ratio, admissible.greatest_impulse_ratio].into_iter().flatten() {
                let at = Collision { impulse_ratio: ImpulseRatio::Given(ratio), ..kane(restitution) };
                assert!(at.evaluate().loss().abs() < 1e-12, "{ratio}");
                let beyond = Collision { impulse_ratio: ImpulseRatio::Given(ratio * 1.01), ..at };
                assert!(beyond.evaluate().loss() < 0.0);
                let bound = at.admissible().expect("no moment").restitution;
                assert!((bound - restitution).abs() < 1e-12, "{bound}");
            }
        }
    }

    #[test]
    fn zero_ratio_is_always_between_the_bounds() {
        for restitution in [0.0, 0.3, 0.9] {
            let admissible = kane(restitution).admissible().expect("no moment");
            assert!(admissible.least_impulse_ratio.is_none_or(|least| least <= 0.0));
            assert!(admissible.greatest_impulse_ratio.is_none_or(|greatest| greatest >= 0.0));
            assert!(admissible.least_impulse_ratio.is_some() || admissible.greatest_impulse_ratio.is_some());
        }
    }

    #[test]
    fn the_other_law_and_a_moment_have_their_own_answer() {
        let other = Collision { law: Law::KudlichSlibar, ..kane(0.9) };
        let admissible = other.admissible().expect("no moment");
        assert_eq!((admissible.restitution, admissible.restitution_for_any_approach), (1.0, 1.0));
        assert!(other.evaluate().loss() > 0.0);
        assert_eq!(Collision { moment: Moment::Given(1.0), ..kane(0.0) }.admissible(), None);
    }
}
