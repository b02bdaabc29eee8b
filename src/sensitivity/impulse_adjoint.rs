//! The adjoint of the impulse equation, which converts derivatives of an output by the impulse to derivatives by each input.
//!
//! The impulse solves G = change(v, e) − K P = 0, or at a given ratio ρ the normal component of that and P_t = ρ P_n. With the cotangent p̄ of the impulse,
//! the adjoint λ solves the transposed equations, p̄ = K λ (K is symmetric), and p̄·dP = λ·dG with the impulse held constant.

use super::Gradient;
use super::body_partials::{BodyPartials, ByVehicle, Held};
use crate::collision::Collision;
use crate::compliance::Compliance;
use crate::contact::Contact;
use crate::frame::{CrushPlane, Nt};
use crate::impact::Impact;
use crate::input::{Input, Side};
use crate::law::{FrictionCone, ImpulseRatio, Law};
use crate::scalar::{Logic, Ordered, Real};

/// The equation of one impulse, at its solution.
pub(super) struct ImpulseAdjoint<T: Ordered> {
    pub(super) partials: [Option<BodyPartials<T>>; 2],
    pub(super) plane: CrushPlane<T>,
    pub(super) compliance: Compliance<T>,
    pub(super) approach: Nt<T>,
    pub(super) restitution: T,
    pub(super) law: Law,
    pub(super) impulse: Nt<T>,
    pub(super) slip: Slip<T>,
}

/// The condition on the tangential part of the impulse.
pub(super) enum Slip<T: Ordered> {
    /// The sticking impulse of the law.
    Ends,
    /// A ratio that is `side` times the input.
    AtRatio { ratio: T, side: T },
    /// A fraction of the ratio of the sticking impulse.
    OfCritical { ratio: T, fraction: T, sticking: Nt<T> },
    /// A ratio that is `side` times the input where the bodies slide, and the sticking impulse of the law elsewhere.
    Limited { slides: T::Mask, ratio: T, side: T },
}

/// The cotangent of an output: its derivatives by the components of the impulse, the approach velocity and the separation velocity.
#[derive(Clone, Copy)]
pub(super) struct Cotangent<T> {
    pub(super) impulse: Nt<T>,
    pub(super) approach: Nt<T>,
    pub(super) separation: Nt<T>,
}

/// The cotangent after the transposed equations have been solved for it.
#[derive(Clone, Copy)]
pub(super) struct Settled<T> {
    /// α, λ and the impulse.
    pub(super) held: Held<T>,
    /// λ of the equation alone, without the contribution of the separation velocity.
    pub(super) equation: Nt<T>,
    /// κ, the adjoint of ρ P_n − P_t.
    pub(super) slip: T,
}

impl<T: Real + Copy> Cotangent<T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn nothing() -> Self {
        Cotangent { impulse: Nt::zero(), approach: Nt::zero(), separation: Nt::zero() }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn of_impulse(impulse: Nt<T>) -> Self {
        Cotangent { impulse, ..Cotangent::nothing() }
    }

    /// Returns the sum with another one times a weight.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn plus(self, weight: T, other: Self) -> Self {
        Cotangent {
            impulse: self.impulse + other.impulse * weight,
            approach: self.approach + other.approach * weight,
            separation: self.separation + other.separation * weight,
        }
    }

    /// Returns the cotangent of the ratio P_t/P_n.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn of_ratio(impulse: Nt<T>) -> Self {
        let scale = impulse.n.inv();
        Cotangent::of_impulse(Nt { n: -(impulse.t * scale * scale), t: scale })
    }
}

impl<T: Real<Mask: Logic> + Copy> ImpulseAdjoint<T> {
    /// Returns the adjoint of the impulse of a collision without a moment.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn of(collision: &Collision<T>, contact: &Contact<T>, impact: &Impact<T>) -> Self {
        ImpulseAdjoint {
            partials: [
                collision.one.vehicle().map(|vehicle| BodyPartials::of(vehicle, &contact.one, Side::One, &collision.crush_plane)),
                collision.two.vehicle().map(|vehicle| BodyPartials::of(vehicle, &contact.two, Side::Two, &collision.crush_plane)),
            ],
            plane: collision.crush_plane,
            compliance: contact.compliance,
            approach: contact.approach,
            restitution: collision.restitution,
            law: collision.law,
            impulse: impact.impulse,
            slip: Slip::of(collision, contact),
        }
    }
}

impl<T: Real<Mask: Logic> + Copy> Slip<T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn of(collision: &Collision<T>, contact: &Contact<T>) -> Self {
        let change = collision.law.change(contact.approach, collision.restitution);
        match collision.impulse_ratio {
            ImpulseRatio::Critical => Slip::Ends,
            ImpulseRatio::Given(ratio) => Slip::AtRatio { ratio, side: T::int(1) },
            ImpulseRatio::OfCritical(fraction) => {
                let sticking = contact.compliance.impulse_for(change);
                Slip::OfCritical { ratio: fraction * sticking.t / sticking.n, fraction, sticking }
            }
            ImpulseRatio::LimitedByFriction(friction) => {
                let sticking = contact.compliance.impulse_for(change);
                let cone = FrictionCone::around(&sticking, &change, &friction);
                Slip::Limited { slides: cone.slides, ratio: cone.side * friction, side: cone.side }
            }
        }
    }
}

impl<T: Real<Mask: Logic> + Copy> ImpulseAdjoint<T> {
    /// Returns the adjoint of the impulse after which sliding has ended, whose ratio is the critical one.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn critical(&self, critical_impulse: Nt<T>) -> Self {
        ImpulseAdjoint { law: Law::Brach, impulse: critical_impulse, slip: Slip::Ends, ..*self }
    }

    /// Returns the adjoint of the law's own sticking impulse.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn sticking(&self, sticking: Nt<T>) -> Self {
        ImpulseAdjoint { impulse: sticking, slip: Slip::Ends, ..*self }
    }

    /// Returns the part of the change of relative velocity that is proportional to the restitution.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn by_restitution(&self, v: Nt<T>) -> Nt<T> {
        match self.law {
            Law::Brach => Nt { n: v.n, t: T::int(0) },
            Law::KudlichSlibar => v,
        }
    }

    /// Solves the transposed equations.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn settle(&self, cotangent: Cotangent<T>) -> Settled<T> {
        let of_impulse = cotangent.impulse - self.compliance.velocity_change(cotangent.separation);
        let nothing = T::int(0);
        let at_ratio = |ratio: T| {
            let n = (of_impulse.n + ratio * of_impulse.t) / self.compliance.along_ratio(ratio);
            (Nt { n, t: nothing }, of_impulse.t - self.compliance.nt * n)
        };
        let ends = || self.compliance.impulse_for(of_impulse);
        let (equation, slip) = match &self.slip {
            Slip::Ends => (ends(), nothing),
            Slip::AtRatio { ratio, .. } | Slip::OfCritical { ratio, .. } => at_ratio(*ratio),
            Slip::Limited { slides, ratio, .. } => {
                let (sliding, slip) = at_ratio(*ratio);
                let either = |sliding: T, ends: T| T::select(*slides, sliding, ends);
                let ends = ends();
                (Nt { n: either(sliding.n, ends.n), t: either(sliding.t, ends.t) }, either(slip, nothing))
            }
        };
        let held = Held {
            approach: self.law.change(equation, self.restitution) + cotangent.approach + cotangent.separation,
            yielding: equation + cotangent.separation,
            impulse: self.impulse,
        };
        Settled { held, equation, slip }
    }

    /// Returns the gradient by each input of an output with this cotangent.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn gradient(&self, cotangent: Cotangent<T>) -> Gradient<T> {
        let settled = self.settle(cotangent);
        self.gradient_of(&settled)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn gradient_of(&self, settled: &Settled<T>) -> Gradient<T> {
        let slip = settled.slip * self.impulse.n;
        let by_ratio = if let Slip::AtRatio { side, .. } | Slip::Limited { side, .. } = self.slip { slip * side } else { T::int(0) };
        let mut gradient = self.with_ratio_by(settled, by_ratio);
        if let Slip::OfCritical { .. } = self.slip {
            gradient.add_scaled(slip, &self.ratio_row());
        }
        gradient
    }

    /// Returns the gradient with the ratio held constant, except for an input that specifies it.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn with_ratio_by(&self, settled: &Settled<T>, impulse_ratio: T) -> Gradient<T> {
        let restitution = settled.equation.dot(self.by_restitution(self.approach));
        let (one, two) = (self.of_both(Side::One, settled), self.of_both(Side::Two, settled));
        Gradient::of_parts(&one, &two, restitution, impulse_ratio)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn of_both(&self, side: Side, settled: &Settled<T>) -> ByVehicle<T> {
        match &self.partials[side as usize] {
            Some(partials) => partials.of_both(&settled.held, &self.plane),
            None => ByVehicle::nothing(),
        }
    }

    /// Returns the gradient of the ratio if it is a fraction of that of the sticking impulse.
    #[cold]
    #[inline(never)]
    pub(super) fn ratio_row(&self) -> Gradient<T> {
        let mut row = Gradient::zero();
        if let Slip::OfCritical { fraction, sticking, .. } = self.slip {
            let ends = self.sticking(sticking);
            row = ends.with_ratio_by(&ends.settle(Cotangent::of_ratio(sticking)), T::int(0));
            row.scale(fraction);
            row.add(Input::ImpulseRatio, sticking.t / sticking.n);
        }
        row
    }

    /// Returns the gradient of a component of the approach velocity.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn approach_row(&self, component: Nt<T>) -> Gradient<T> {
        let [mut one, mut two] = [ByVehicle::nothing(); 2];
        for (to, partials) in [(&mut one, &self.partials[0]), (&mut two, &self.partials[1])] {
            if let Some(partials) = partials {
                *to = partials.of_approach(component, &self.plane);
            }
        }
        Gradient::of_parts(&one, &two, T::int(0), T::int(0))
    }

    /// Returns the gradient of a component of −K P with the impulse held constant.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn yielding_row(&self, component: Nt<T>) -> Gradient<T> {
        let [mut one, mut two] = [ByVehicle::nothing(); 2];
        for (to, partials) in [(&mut one, &self.partials[0]), (&mut two, &self.partials[1])] {
            if let Some(partials) = partials {
                *to = partials.of_yielding(component, self.impulse);
            }
        }
        Gradient::of_parts(&one, &two, T::int(0), T::int(0))
    }
}

/// A gradient entry by entry, by a loop: a closure is not always compiled into the loop around it, nor for its instructions.
macro_rules! each {
    ($i:ident => $entry:expr) => {{
        let mut gradient = Gradient::zero();
        for $i in 0..Input::COUNT {
            gradient.0[$i] = $entry;
        }
        gradient
    }};
}

impl<T: Real + Copy> Gradient<T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn scale(&mut self, by: T) {
        for x in &mut self.0 {
            *x = *x * by;
        }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn add_scaled(&mut self, by: T, other: &Gradient<T>) {
        for (x, y) in self.0.iter_mut().zip(&other.0) {
            *x = *x + by * *y;
        }
    }

    /// Returns one gradient where the mask is true, and the other elsewhere.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn select(mask: T::Mask, yes: &Gradient<T>, no: &Gradient<T>) -> Gradient<T> {
        each!(i => T::select(mask.clone(), yes.0[i], no.0[i]))
    }

    /// Returns a x + b y.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn mix(a: T, x: &Gradient<T>, b: T, y: &Gradient<T>) -> Gradient<T> {
        each!(i => a * x.0[i] + b * y.0[i])
    }
}
