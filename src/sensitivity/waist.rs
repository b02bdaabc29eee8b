//! The narrow waist: what an output is worth of each component of the impulse becomes what it is worth of each input.
//!
//! The impulse solves G = change(v, e) − K P = 0, or at a given ratio ρ the normal part of that and P_t = ρ P_n. With the worth p̄ of the impulse, λ solves
//! the transposed equations, p̄ = K λ (K is symmetric), and p̄·dP = λ·dG with the impulse held.

use super::Gradient;
use super::lever::{ByVehicle, Held, Lever};
use crate::collision::Collision;
use crate::compliance::Compliance;
use crate::contact::Contact;
use crate::frame::{CrushPlane, Nt};
use crate::impact::Impact;
use crate::input::{Input, Side};
use crate::law::{FrictionCone, ImpulseRatio, Law};
use crate::scalar::{Ordered, Real};

/// The equation of one impulse, at its solution.
#[derive(Clone, Copy)]
pub(super) struct Waist<T> {
    pub(super) levers: [Option<Lever<T>>; 2],
    pub(super) plane: CrushPlane<T>,
    pub(super) compliance: Compliance<T>,
    pub(super) approach: Nt<T>,
    pub(super) restitution: T,
    pub(super) law: Law,
    pub(super) impulse: Nt<T>,
    pub(super) slip: Slip<T>,
}

/// What the tangential part of the impulse follows.
#[derive(Clone, Copy)]
pub(super) enum Slip<T> {
    /// The law's sticking impulse.
    Ends,
    /// A ratio that is `side` times the input.
    AtRatio { ratio: T, side: T },
    /// A fraction of the ratio of the sticking impulse.
    OfCritical { ratio: T, fraction: T, sticking: Nt<T> },
}

/// What an output is worth of the impulse, of the approach velocity and of the separation velocity: its derivatives by their components.
#[derive(Clone, Copy)]
pub(super) struct Worth<T> {
    pub(super) impulse: Nt<T>,
    pub(super) approach: Nt<T>,
    pub(super) separation: Nt<T>,
}

/// The same after the equation of the impulse has been solved for it.
#[derive(Clone, Copy)]
pub(super) struct Settled<T> {
    /// α, λ and the impulse.
    pub(super) held: Held<T>,
    /// λ of the equation alone, without what the separation velocity adds.
    pub(super) equation: Nt<T>,
    /// κ, the worth of ρ P_n − P_t.
    pub(super) slip: T,
}

impl<T: Real + Copy> Worth<T> {
    #[inline(always)]
    pub(super) fn nothing() -> Self {
        Worth { impulse: Nt::zero(), approach: Nt::zero(), separation: Nt::zero() }
    }

    #[inline(always)]
    pub(super) fn of_impulse(impulse: Nt<T>) -> Self {
        Worth { impulse, ..Worth::nothing() }
    }

    /// That of the ratio P_t/P_n.
    #[inline(always)]
    pub(super) fn of_ratio(impulse: Nt<T>) -> Self {
        let scale = impulse.n.inv();
        Worth::of_impulse(Nt { n: -(impulse.t * scale * scale), t: scale })
    }
}

impl<T: Real + Copy + Ordered<Mask = bool>> Waist<T> {
    /// That of the impulse of a collision without a moment.
    #[inline(always)]
    pub(super) fn of(collision: &Collision<T>, contact: &Contact<T>, impact: &Impact<T>) -> Self {
        Waist {
            levers: [
                collision.one.vehicle().map(|vehicle| Lever::of(vehicle, &contact.one, Side::One, &collision.crush_plane)),
                collision.two.vehicle().map(|vehicle| Lever::of(vehicle, &contact.two, Side::Two, &collision.crush_plane)),
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

impl<T: Real + Copy + Ordered<Mask = bool>> Slip<T> {
    #[inline(always)]
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
                if cone.slides { Slip::AtRatio { ratio: cone.side * friction, side: cone.side } } else { Slip::Ends }
            }
        }
    }
}

impl<T: Real + Copy> Waist<T> {
    /// That of the impulse after which sliding has ended, whose ratio is the critical one.
    #[inline(always)]
    pub(super) fn critical(&self, critical_impulse: Nt<T>) -> Self {
        Waist { law: Law::Brach, impulse: critical_impulse, slip: Slip::Ends, ..*self }
    }

    /// That of the law's own sticking impulse.
    #[inline(always)]
    pub(super) fn sticking(&self, sticking: Nt<T>) -> Self {
        Waist { impulse: sticking, slip: Slip::Ends, ..*self }
    }

    /// Part of the change of relative velocity that grows with the restitution.
    #[inline(always)]
    pub(super) fn by_restitution(&self, v: Nt<T>) -> Nt<T> {
        match self.law {
            Law::Brach => Nt { n: v.n, t: T::int(0) },
            Law::KudlichSlibar => v,
        }
    }

    /// Solves the transposed equations.
    #[inline(always)]
    pub(super) fn settle(&self, worth: Worth<T>) -> Settled<T> {
        let of_impulse = worth.impulse - self.compliance.yield_to(worth.separation);
        let (equation, slip) = match self.slip {
            Slip::Ends => (self.compliance.impulse_for(of_impulse), T::int(0)),
            Slip::AtRatio { ratio, .. } | Slip::OfCritical { ratio, .. } => {
                let n = (of_impulse.n + ratio * of_impulse.t) / self.compliance.along_ratio(ratio);
                (Nt { n, t: T::int(0) }, of_impulse.t - self.compliance.nt * n)
            }
        };
        let held = Held {
            approach: self.law.change(equation, self.restitution) + worth.approach + worth.separation,
            yielding: equation + worth.separation,
            impulse: self.impulse,
        };
        Settled { held, equation, slip }
    }

    /// What is worth so much of the impulse and the velocities, by each input.
    #[inline(always)]
    pub(super) fn gradient(&self, worth: Worth<T>) -> Gradient<T> {
        let settled = self.settle(worth);
        self.gradient_of(&settled)
    }

    #[inline(always)]
    pub(super) fn gradient_of(&self, settled: &Settled<T>) -> Gradient<T> {
        let slip = settled.slip * self.impulse.n;
        let by_ratio = if let Slip::AtRatio { side, .. } = self.slip { slip * side } else { T::int(0) };
        let mut gradient = self.with_ratio_by(settled, by_ratio);
        if let Slip::OfCritical { .. } = self.slip {
            gradient.add_scaled(slip, &self.ratio_row());
        }
        gradient
    }

    /// With the ratio held, but for an input that it is.
    #[inline(always)]
    fn with_ratio_by(&self, settled: &Settled<T>, impulse_ratio: T) -> Gradient<T> {
        let restitution = settled.equation.dot(self.by_restitution(self.approach));
        let (one, two) = (self.of_both(Side::One, settled), self.of_both(Side::Two, settled));
        Gradient::of_parts(&one, &two, restitution, impulse_ratio)
    }

    #[inline(always)]
    fn of_both(&self, side: Side, settled: &Settled<T>) -> ByVehicle<T> {
        match &self.levers[side as usize] {
            Some(lever) => lever.of_both(&settled.held, &self.plane),
            None => ByVehicle::nothing(),
        }
    }

    /// The ratio by each input, where it is a fraction of that of the sticking impulse.
    #[cold]
    #[inline(never)]
    pub(super) fn ratio_row(&self) -> Gradient<T> {
        let mut row = Gradient::zero();
        if let Slip::OfCritical { fraction, sticking, .. } = self.slip {
            let ends = self.sticking(sticking);
            row = ends.with_ratio_by(&ends.settle(Worth::of_ratio(sticking)), T::int(0));
            row.scale(fraction);
            row.add(Input::ImpulseRatio, sticking.t / sticking.n);
        }
        row
    }

    /// A component of the approach velocity by each input.
    #[inline(always)]
    pub(super) fn approach_row(&self, component: Nt<T>) -> Gradient<T> {
        let [one, two] = &self.levers;
        let of = |lever: &Option<Lever<T>>| match lever {
            Some(lever) => lever.of_approach(component, &self.plane),
            None => ByVehicle::nothing(),
        };
        Gradient::of_parts(&of(one), &of(two), T::int(0), T::int(0))
    }

    /// A component of −K P by each input, the impulse held.
    #[inline(always)]
    pub(super) fn yielding_row(&self, component: Nt<T>) -> Gradient<T> {
        let [one, two] = &self.levers;
        let of = |lever: &Option<Lever<T>>| match lever {
            Some(lever) => lever.of_yielding(component, self.impulse),
            None => ByVehicle::nothing(),
        };
        Gradient::of_parts(&of(one), &of(two), T::int(0), T::int(0))
    }
}

impl<T: Real + Copy> Gradient<T> {
    #[inline(always)]
    pub(super) fn scale(&mut self, by: T) {
        for x in &mut self.0 {
            *x = *x * by;
        }
    }

    #[inline(always)]
    pub(super) fn add_scaled(&mut self, by: T, other: &Gradient<T>) {
        for (x, y) in self.0.iter_mut().zip(&other.0) {
            *x = *x + by * *y;
        }
    }

    /// a x + b y.
    #[inline(always)]
    pub(super) fn mix(a: T, x: &Gradient<T>, b: T, y: &Gradient<T>) -> Gradient<T> {
        Gradient(core::array::from_fn(|i| a * x.0[i] + b * y.0[i]))
    }
}
