//! Laws that determine the magnitude and the direction of the impulse.
//!
//! Restitution determines the normal separation velocity, V_n = −e v_n (A7). For the tangential part a **law** determines the impulse that ends the
//! tangential process (the *sticking* impulse), and a **ratio** determines how much of it takes place:
//!
//! | law | sticking impulse | tangential separation velocity |
//! |---|---|---|
//! | [`Law::Brach`], the paper's | K P = ((1 + e) v_n, v_t) | 0: sliding ends |
//! | [`Law::KudlichSlibar`] | K P = (1 + e) (v_n, v_t) | −e v_t: restitution applies to both components |
//!
//! The two agree at e = 0. P_t/P_n of the first is the paper's critical impulse ratio μ₀ (A27).

use crate::compliance::Compliance;
use crate::frame::Nt;
use crate::scalar::{Field, Ordered};

/// The impulse that ends the tangential process.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Law {
    /// The paper's law: sliding has ended at separation.
    #[default]
    Brach,
    /// The law of PC-Crash and Virtual CRASH, and of Carpenter and Welcher: restitution multiplies both components of the common-velocity impulse.
    KudlichSlibar,
}

/// Relation between the tangential and the normal impulse, μ = P_t/P_n (A8).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum ImpulseRatio<T = f64> {
    /// The sticking impulse of the law. With [`Law::Brach`] μ = μ₀.
    #[default]
    Critical,
    /// A given μ, with its sign, between 0 and the critical ratio.
    Given(T),
    /// A fraction of the critical ratio, from 0 to 1.
    OfCritical(T),
    /// The critical ratio, unless its magnitude is above this coefficient of friction: then the bodies slide throughout, at this ratio, in the direction of
    /// the sticking impulse.
    LimitedByFriction(T),
}

impl Law {
    /// Returns the change of relative velocity caused by the sticking impulse.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn change<T: Field>(self, approach: Nt<T>, restitution: T) -> Nt<T> {
        let both = T::int(1) + restitution;
        match self {
            Law::Brach => Nt { n: both * approach.n, t: approach.t },
            Law::KudlichSlibar => approach * both,
        }
    }
}

impl<T> ImpulseRatio<T> {
    /// Converts the ratio to another scalar type.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn map<U>(self, mut f: impl FnMut(T) -> U) -> ImpulseRatio<U> {
        match self {
            ImpulseRatio::Critical => ImpulseRatio::Critical,
            ImpulseRatio::Given(ratio) => ImpulseRatio::Given(f(ratio)),
            ImpulseRatio::OfCritical(fraction) => ImpulseRatio::OfCritical(f(fraction)),
            ImpulseRatio::LimitedByFriction(friction) => ImpulseRatio::LimitedByFriction(f(friction)),
        }
    }
}

impl<T: Ordered> ImpulseRatio<T> {
    /// Returns the impulse of this ratio, given the change of relative velocity `change` that the sticking impulse would cause.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn impulse(&self, compliance: &Compliance<T>, change: Nt<T>) -> Nt<T> {
        match self {
            ImpulseRatio::Critical => compliance.impulse_for(change),
            ImpulseRatio::Given(ratio) => impulse_at_ratio(compliance, change.n, ratio.clone()),
            ImpulseRatio::OfCritical(fraction) => impulse_at_fraction(compliance, change, fraction.clone()),
            ImpulseRatio::LimitedByFriction(friction) => limited_by_friction(compliance, change, friction.clone()),
        }
    }
}

/// Returns the impulse at a given ratio that causes a given change of normal velocity: P_n = change/(K_nn + μ K_nt), P_t = μ P_n (A1, A2, A14).
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn impulse_at_ratio<T: Field>(compliance: &Compliance<T>, normal_change: T, ratio: T) -> Nt<T> {
    let n = normal_change / compliance.along_ratio(ratio.clone());
    Nt { t: ratio * n.clone(), n }
}

/// Returns the impulse at a fraction of the ratio of the sticking impulse, which would cause the change of relative velocity `change`.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn impulse_at_fraction<T: Field>(compliance: &Compliance<T>, change: Nt<T>, fraction: T) -> Nt<T> {
    let sticking = compliance.impulse_for(change.clone());
    impulse_at_ratio(compliance, change.n, fraction * sticking.t / sticking.n)
}

/// Returns the sticking impulse, unless it lies outside the friction cone: then the impulse on the edge of the cone with the same normal change.
///
/// From zero tangential impulse to the sticking impulse, the ratio leaves the cone where the magnitude of the tangential part exceeds the friction
/// coefficient times the compression. That point always exists and involves no division, even if the sticking impulse is tensile.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn limited_by_friction<T: Ordered>(compliance: &Compliance<T>, change: Nt<T>, friction: T) -> Nt<T> {
    let sticking = compliance.impulse_for(change.clone());
    let cone = FrictionCone::around(&sticking, &change, &friction);
    let ratio = T::select(cone.slides.clone(), cone.side * friction, T::int(0));
    let sliding = impulse_at_ratio(compliance, change.n, ratio);
    Nt { n: T::select(cone.slides.clone(), sliding.n, sticking.n), t: T::select(cone.slides, sliding.t, sticking.t) }
}

/// Position of the sticking impulse relative to the friction cone.
pub(crate) struct FrictionCone<T: Ordered> {
    /// True if it lies outside, or the cone is a line: the bodies slide throughout.
    pub(crate) slides: T::Mask,
    /// Sign of the ratio on the edge where it leaves the cone: 1 or −1, or 0 on the line.
    pub(crate) side: T,
}

impl<T: Ordered> FrictionCone<T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn around(sticking: &Nt<T>, change: &Nt<T>, friction: &T) -> Self {
        let compression = sticking.n.clone() * change.n.clone();
        let across = sticking.t.clone() * change.n.clone();
        let (left, right) = (across.less(&T::int(0)), T::int(0).less(&across));
        // On a line even what does not move across slides.
        let most = T::select(T::int(0).less(friction), friction.clone() * compression, T::int(-1));
        FrictionCone { slides: most.less(&across.magnitude()), side: T::select(left, T::int(-1), T::select(right, T::int(1), T::int(0))) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::Body;
    use num_dual::Dual64;

    /// K = [[0.75, 0.5], [0.5, 1.5]].
    fn compliance() -> Compliance {
        let body = Body { inverse_mass: 0.5, inverse_yaw_inertia: 0.25, arm: Nt { n: 2.0, t: -1.0 }, velocity: Nt::zero(), yaw_rate: 0.0 };
        Compliance::between(&body, &Body::fixed())
    }

    #[test]
    fn the_laws_differ_by_the_restitution_of_the_tangential_part() {
        let approach = Nt { n: -8.0, t: 4.0 };
        assert_eq!(Law::Brach.change(approach, 0.25), Nt { n: -10.0, t: 4.0 });
        assert_eq!(Law::KudlichSlibar.change(approach, 0.25), Nt { n: -10.0, t: 5.0 });
        assert_eq!(Law::Brach.change(approach, 0.0), Law::KudlichSlibar.change(approach, 0.0));
    }

    #[test]
    fn the_ratio_chooses_along_one_line() {
        let (k, change) = (compliance(), Nt { n: -7.0, t: -7.0 });
        let sticking = ImpulseRatio::Critical.impulse(&k, change);
        assert_eq!(sticking, Nt { n: -8.0, t: -2.0 });
        assert_eq!(ImpulseRatio::Given(0.25).impulse(&k, change), sticking);
        assert_eq!(ImpulseRatio::OfCritical(1.0).impulse(&k, change), sticking);
        let half = ImpulseRatio::OfCritical(0.5).impulse(&k, change);
        assert_eq!(half.t / half.n, 0.125);
        assert_eq!(k.velocity_change(half).n, change.n);
        assert_eq!(ImpulseRatio::Given(0.0).impulse(&k, change), Nt { n: -7.0 / 0.75, t: -0.0 });
    }

    #[test]
    fn friction_limits_only_outside_its_cone() {
        let (k, change) = (compliance(), Nt { n: -7.0, t: -7.0 });
        let sticking = ImpulseRatio::Critical.impulse(&k, change);
        assert_eq!(ImpulseRatio::LimitedByFriction(0.25).impulse(&k, change), sticking);
        assert_eq!(ImpulseRatio::LimitedByFriction(1.0).impulse(&k, change), sticking);
        let sliding = ImpulseRatio::LimitedByFriction(0.125).impulse(&k, change);
        assert_eq!(sliding, ImpulseRatio::Given(0.125).impulse(&k, change));
        let other_way = Nt { n: -7.0, t: 70.0 };
        assert_eq!(ImpulseRatio::LimitedByFriction(0.125).impulse(&k, other_way), ImpulseRatio::Given(-0.125).impulse(&k, other_way));
    }

    /// Without friction the tangential impulse is zero whatever changes, also where it would be zero anyway.
    #[test]
    fn nothing_sticks_without_friction() {
        let Compliance { nn, nt, tt, determinant } = compliance();
        let [nn, nt, tt, determinant] = [nn, nt, tt, determinant].map(Dual64::from);
        let k = Compliance { nn, nt, tt, determinant };
        for sticking in [-0.25, 0.0, 0.25] {
            // What an impulse of (−1, `sticking`) changes.
            let change = |eps: f64| Nt { n: Dual64::from(-0.75 + 0.5 * sticking), t: Dual64::new(-0.5 + 1.5 * sticking, eps) };
            let by_change = ImpulseRatio::LimitedByFriction(Dual64::from(0.0)).impulse(&k, change(1.0));
            assert_eq!((by_change.t.re, by_change.t.eps, by_change.n.eps), (0.0, 0.0, 0.0), "{sticking}");
            assert!((by_change.n.re - change(0.0).n.re / 0.75).abs() < 1e-15);
            // By the friction it changes along the sticking impulse, and not at all where there is none.
            let by_friction = ImpulseRatio::LimitedByFriction(Dual64::new(0.0, 1.0)).impulse(&k, change(0.0)).t.eps;
            assert!(by_friction * sticking >= 0.0 && (by_friction == 0.0) == (sticking == 0.0), "{sticking}: {by_friction}");
        }
    }

    #[test]
    fn friction_slides_where_sticking_would_pull() {
        // K⁻¹ (−1, −7) = (2.29, −5.43): the sticking impulse would be tensile.
        let (k, change) = (compliance(), Nt { n: -1.0, t: -7.0 });
        assert!(k.impulse_for(change).n > 0.0);
        let sliding = ImpulseRatio::LimitedByFriction(0.5).impulse(&k, change);
        assert_eq!(sliding, Nt { n: -1.0, t: -0.5 });
    }
}
