//! The forward problem with its conditions: the impact, or every reason why there is none.
//!
//! The checks stand around the kernel, which has no condition in it. Every scalar that compares with yes or no is refused the same (`proptests/refusals.rs`,
//! `every_scalar_refuses_the_same`), an f32 to its own precision.

use crate::collision::Collision;
use crate::contact::Contact;
use crate::frame::Nt;
use crate::impact::Impact;
use crate::law::ImpulseRatio;
use crate::moment::Moment;
use crate::refusal::{Refusal, Refusals, Tension};
use crate::scalar::Ordered;
use crate::vehicle::Party;
use alloc::vec::Vec;

/// Whether the scalar has no more than the 24 bits of an f32: one more than 2²⁴ is 2²⁴.
fn is_single<T: Ordered<Mask = bool>>() -> bool {
    let limit = T::int(1 << 24);
    !limit.less(&(limit.clone() + T::int(1)))
}

/// 2⁻⁴⁸: what is smaller than this share of the terms it was summed from is their rounding. 2⁻²⁰ of an f32.
pub(crate) fn rounding<T: Ordered<Mask = bool>>() -> T {
    let step = T::int(1) / T::int(if is_single::<T>() { 1 << 10 } else { 1 << 24 });
    step.squared()
}

/// 2⁻⁴⁰: how far a given direction may be from unit length, and a given ratio from a critical one computed elsewhere. 2⁻¹⁶ of an f32.
pub(crate) fn slack<T: Ordered<Mask = bool>>() -> T {
    let step = T::int(1) / T::int(if is_single::<T>() { 1 << 8 } else { 1 << 20 });
    step.squared()
}

pub(crate) fn is_finite<T: Ordered<Mask = bool>>(x: &T) -> bool {
    // Zero for every finite number, and not a number for the others.
    let nothing = x.clone() - x.clone();
    nothing.less(&T::int(1)) && T::int(-1).less(&nothing)
}

pub(crate) fn is_positive<T: Ordered<Mask = bool>>(x: &T) -> bool {
    T::int(0).less(x)
}

fn is_zero<T: Ordered<Mask = bool>>(x: &T) -> bool {
    !is_positive(x) && !x.less(&T::int(0))
}

fn sum_of_magnitudes<T: Ordered>(v: &Nt<T>) -> T {
    v.n.clone().magnitude() + v.t.clone().magnitude()
}

/// The problems found so far.
pub(crate) struct Findings<T>(Vec<Refusal<T>>);

impl<T: Ordered<Mask = bool>> Findings<T> {
    pub(crate) fn none() -> Self {
        Findings(Vec::new())
    }

    pub(crate) fn add(&mut self, refusal: Refusal<T>) {
        self.0.push(refusal);
    }

    pub(crate) fn finite(&mut self, input: &'static str, value: &T) -> bool {
        let finite = is_finite(value);
        if !finite {
            self.0.push(Refusal::NotFinite { input, value: value.clone() });
        }
        finite
    }

    pub(crate) fn positive(&mut self, input: &'static str, value: &T) {
        if self.finite(input, value) && !is_positive(value) {
            self.0.push(Refusal::NotPositive { input, value: value.clone() });
        }
    }

    pub(crate) fn within(&mut self, input: &'static str, value: &T, least: i32, greatest: Option<i32>) {
        if !self.finite(input, value) {
            return;
        }
        let above = greatest.is_some_and(|greatest| T::int(greatest).less(value));
        if value.less(&T::int(least)) || above {
            self.0.push(Refusal::OutOfRange { input, value: value.clone(), least, greatest });
        }
    }

    fn direction(&mut self, input: &'static str, cos: &T, sin: &T) {
        if self.finite(input, cos) && self.finite(input, sin) {
            let length_squared = cos.clone().squared() + sin.clone().squared();
            let error = (length_squared.clone() - T::int(1)).magnitude();
            if !error.less(&slack()) {
                self.0.push(Refusal::NotADirection { input, length_squared });
            }
        }
    }

    fn party(&mut self, names: &[&'static str; 8], party: &Party<T>) {
        if let Party::Vehicle(vehicle) = party {
            let [mass, inertia, heading, forward, left, vx, vy, yaw_rate] = names;
            self.positive(mass, &vehicle.mass);
            self.positive(inertia, &vehicle.yaw_inertia);
            self.direction(heading, &vehicle.heading.cos, &vehicle.heading.sin);
            self.finite(forward, &vehicle.impact_center.forward);
            self.finite(left, &vehicle.impact_center.left);
            self.finite(vx, &vehicle.motion.velocity.x);
            self.finite(vy, &vehicle.motion.velocity.y);
            self.finite(yaw_rate, &vehicle.motion.yaw_rate);
        }
    }

    pub(crate) fn done(self) -> Result<(), Refusals<T>> {
        if self.0.is_empty() { Ok(()) } else { Err(Refusals(self.0)) }
    }
}

const ONE: [&str; 8] = [
    "vehicle.1.mass",
    "vehicle.1.yaw_inertia",
    "vehicle.1.heading",
    "vehicle.1.impact_center.forward",
    "vehicle.1.impact_center.left",
    "vehicle.1.velocity.x",
    "vehicle.1.velocity.y",
    "vehicle.1.yaw_rate",
];

const TWO: [&str; 8] = [
    "vehicle.2.mass",
    "vehicle.2.yaw_inertia",
    "vehicle.2.heading",
    "vehicle.2.impact_center.forward",
    "vehicle.2.impact_center.left",
    "vehicle.2.velocity.x",
    "vehicle.2.velocity.y",
    "vehicle.2.yaw_rate",
];

impl<T: Ordered<Mask = bool>> Collision<T> {
    /// The impact, or every reason why there is none.
    ///
    /// # Errors
    ///
    /// [`Refusals`]: an input that is not finite or outside its range, or a collision that the mechanics refuses.
    pub fn solve(&self) -> Result<Impact<T>, Refusals<T>> {
        let contact = self.checked_contact()?;
        self.solve_at(&contact)
    }

    /// The contact, once the inputs are in order.
    #[inline(always)]
    pub(crate) fn checked_contact(&self) -> Result<Contact<T>, Refusals<T>> {
        self.check_inputs()?;
        Ok(self.contact())
    }

    /// The impact at the contact of this collision.
    #[inline(always)]
    pub(crate) fn solve_at(&self, contact: &Contact<T>) -> Result<Impact<T>, Refusals<T>> {
        if !is_finite(&contact.compliance.determinant) || !is_positive(&contact.compliance.determinant) {
            return Err(Refusals([Refusal::OutOfFloatRange].into()));
        }
        self.check_closing(contact)?;
        self.check_ratio(contact)?;
        let (impulse, moment) = self.impulse(contact);
        let impact = self.impact_of(contact, impulse, moment);
        self.check_impact(contact, &impact)?;
        Ok(impact)
    }

    fn check_inputs(&self) -> Result<(), Refusals<T>> {
        let mut findings = Findings::none();
        findings.party(&ONE, &self.one);
        findings.party(&TWO, &self.two);
        if self.one.vehicle().is_none() && self.two.vehicle().is_none() {
            findings.0.push(Refusal::NothingMoves);
        }
        findings.direction("contact.crush_plane", &self.crush_plane.cos, &self.crush_plane.sin);
        findings.within("contact.restitution", &self.restitution, 0, Some(1));
        match &self.impulse_ratio {
            ImpulseRatio::Critical => (),
            ImpulseRatio::Given(ratio) => drop(findings.finite("contact.impulse_ratio", ratio)),
            ImpulseRatio::OfCritical(fraction) => drop(findings.finite("contact.impulse_ratio.of_critical", fraction)),
            ImpulseRatio::LimitedByFriction(friction) => findings.within("contact.friction", friction, 0, None),
        }
        match &self.moment {
            Moment::None => (),
            Moment::Given(moment) => drop(findings.finite("contact.moment", moment)),
            Moment::OfCritical(fraction) => findings.within("contact.moment.of_critical", fraction, 0, Some(1)),
        }
        findings.done()
    }

    /// They close where v_n s < 0, both of them more than the rounding of their terms.
    fn check_closing(&self, contact: &Contact<T>) -> Result<(), Refusals<T>> {
        let (one, two) = (&contact.one, &contact.two);
        let speeds = sum_of_magnitudes(&one.velocity)
            + sum_of_magnitudes(&two.velocity)
            + sum_of_magnitudes(&one.arm) * one.yaw_rate.clone().magnitude()
            + sum_of_magnitudes(&two.arm) * two.yaw_rate.clone().magnitude();
        let arms = sum_of_magnitudes(&one.arm) + sum_of_magnitudes(&two.arm);
        let (approach, offset) = (contact.approach.n.clone(), contact.offset().n);
        let moves = (speeds * rounding()).less(&approach.clone().magnitude());
        let apart = (arms * rounding()).less(&offset.clone().magnitude());
        if moves && apart && is_positive(&approach) != is_positive(&offset) {
            Ok(())
        } else {
            Err(Refusals([Refusal::NotClosing { approach, offset }].into()))
        }
    }

    /// That the ratio can be evaluated: nothing divides by zero, and the sticking impulse that it is a fraction of pushes.
    fn check_ratio(&self, contact: &Contact<T>) -> Result<(), Refusals<T>> {
        match &self.impulse_ratio {
            ImpulseRatio::Given(ratio) => {
                let normal = contact.compliance.along_ratio(ratio.clone());
                if !is_positive(&normal) {
                    return Err(Refusals([Refusal::Tensile { normal, reason: Tension::Wedges }].into()));
                }
            }
            ImpulseRatio::OfCritical(fraction) => {
                let sticking = self.sticking_impulse(contact);
                // None of it at all is none of it, even where the whole would pull.
                let none = is_zero(fraction) && !is_zero(&sticking.n);
                if !none {
                    self.check_push(contact, &sticking)?;
                }
                if fraction.less(&T::int(0)) || T::int(1).less(fraction) {
                    let critical = sticking.t / sticking.n;
                    let ratio = fraction.clone() * critical.clone();
                    return Err(Refusals([Refusal::BeyondCritical { ratio, critical: Some(critical) }].into()));
                }
            }
            ImpulseRatio::Critical | ImpulseRatio::LimitedByFriction(_) => (),
        }
        Ok(())
    }

    /// The impulse that ends the tangential process, whichever ratio is in force.
    fn sticking_impulse(&self, contact: &Contact<T>) -> Nt<T> {
        Collision { impulse_ratio: ImpulseRatio::Critical, ..self.clone() }.impulse(contact).0
    }

    /// The impulse must push body one away from body two, as the approach does.
    fn check_push(&self, contact: &Contact<T>, impulse: &Nt<T>) -> Result<(), Refusals<T>> {
        if is_positive(&(impulse.n.clone() * contact.approach.n.clone())) {
            Ok(())
        } else {
            Err(Refusals([Refusal::Tensile { normal: impulse.n.clone(), reason: Tension::Pulls }].into()))
        }
    }

    fn check_impact(&self, contact: &Contact<T>, impact: &Impact<T>) -> Result<(), Refusals<T>> {
        let results = [
            &impact.impulse.n,
            &impact.impulse.t,
            &impact.moment,
            &impact.work.n,
            &impact.work.t,
            &impact.work.m,
            &impact.one.after.yaw_rate,
            &impact.two.after.yaw_rate,
            &impact.kinetic_energy.before,
            &impact.kinetic_energy.after,
        ];
        if !results.into_iter().all(is_finite) {
            return Err(Refusals([Refusal::OutOfFloatRange].into()));
        }
        self.check_push(contact, &impact.impulse)?;
        let mut findings = Findings::none();
        if let ImpulseRatio::Given(ratio) = &self.impulse_ratio {
            let sticking = self.sticking_impulse(contact);
            // Of tangential impulses with the same normal change, those between none and the sticking one: the ratio itself has no bound
            // where the sticking impulse would pull.
            let limit = sticking.t.clone().magnitude() * (T::int(1) + slack());
            let against = (impact.impulse.t.clone() * sticking.t.clone()).less(&T::int(0));
            if against || limit.less(&impact.impulse.t.clone().magnitude()) {
                let critical = self.check_push(contact, &sticking).is_ok().then(|| sticking.t / sticking.n);
                findings.0.push(Refusal::BeyondCritical { ratio: ratio.clone(), critical });
            }
        }
        let loss = impact.loss();
        let exchanged = impact.work.n.clone().magnitude()
            + impact.work.t.clone().magnitude()
            + impact.work.m.clone().magnitude()
            + (impact.impulse.n.clone() * impact.approach.n.clone()).magnitude();
        if loss.less(&-(exchanged * slack())) {
            findings.0.push(Refusal::EnergyGain { gain: -loss, before: impact.kinetic_energy.before.clone() });
        }
        findings.done()
    }
}
