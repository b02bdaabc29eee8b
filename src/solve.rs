//! The forward problem with its conditions: the impact, or every reason for refusing it.
//!
//! The checks surround the kernel, which contains no conditions. Every scalar with true or false comparisons is refused for the same reasons
//! (`proptests/refusals.rs`, `every_scalar_refuses_the_same`), an f32 to its own precision.

mod possible;

use self::possible::{is_direction, is_none};
use crate::collision::Collision;
use crate::contact::Contact;
use crate::frame::Nt;
use crate::impact::Impact;
use crate::input::{Input, Side};
use crate::issue::{IssueCollector, Place};
use crate::law::ImpulseRatio;
use crate::moment::Moment;
use crate::refusal::{Refusal, Refusals, Tension};
use crate::scalar::{Ordered, is_finite, is_positive, tolerance};
use crate::vehicle::Party;

/// Checks a direction, given as a cosine and a sine.
fn check_direction<T: Ordered<Mask = bool>>(issues: &mut IssueCollector<Refusal<T>>, input: Input, cos: &T, sin: &T) {
    let at = Place::input(input);
    if issues.finite(at, cos) && issues.finite(at, sin) && !is_direction(cos, sin) {
        issues.push(Refusal::NotADirection { at, length_squared: cos.clone().squared() + sin.clone().squared() });
    }
}

fn check_party<T: Ordered<Mask = bool>>(issues: &mut IssueCollector<Refusal<T>>, side: Side, party: &Party<T>) {
    if let Party::Vehicle(vehicle) = party {
        issues.positive(Place::input(Input::Mass(side)), &vehicle.mass);
        issues.positive(Place::input(Input::YawInertia(side)), &vehicle.yaw_inertia);
        check_direction(issues, Input::Heading(side), &vehicle.heading.cos, &vehicle.heading.sin);
        issues.finite(Place::input(Input::ImpactCenterForward(side)), &vehicle.impact_center.forward);
        issues.finite(Place::input(Input::ImpactCenterLeft(side)), &vehicle.impact_center.left);
        issues.finite(Place::input(Input::VelocityX(side)), &vehicle.motion.velocity.x);
        issues.finite(Place::input(Input::VelocityY(side)), &vehicle.motion.velocity.y);
        issues.finite(Place::input(Input::YawRate(side)), &vehicle.motion.yaw_rate);
    }
}

impl<T: Ordered<Mask = bool>> Collision<T> {
    /// Computes the impact, or returns every reason for refusing it.
    ///
    /// # Errors
    ///
    /// [`Refusals`]: an input that is not finite or outside its range, or a collision that the mechanics refuses.
    pub fn solve(&self) -> Result<Impact<T>, Refusals<T>> {
        let contact = self.checked_contact()?;
        self.solve_at(&contact)
    }

    /// Returns the contact after checking the inputs.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn checked_contact(&self) -> Result<Contact<T>, Refusals<T>> {
        self.check_inputs()?;
        Ok(self.contact())
    }

    /// Computes the impact at the contact of this collision.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn solve_at(&self, contact: &Contact<T>) -> Result<Impact<T>, Refusals<T>> {
        if !is_finite(&contact.compliance.determinant) || !is_positive(&contact.compliance.determinant) {
            return Err(Refusal::OutOfFloatRange.into());
        }
        self.check_closing(contact)?;
        self.check_ratio(contact)?;
        let impact = self.impact_at(contact);
        self.check_impact(contact, &impact)?;
        Ok(impact)
    }

    pub(crate) fn check_inputs(&self) -> Result<(), Refusals<T>> {
        let mut issues = IssueCollector::<Refusal<T>>::new();
        check_party(&mut issues, Side::One, &self.one);
        check_party(&mut issues, Side::Two, &self.two);
        if self.one.vehicle().is_none() && self.two.vehicle().is_none() {
            issues.push(Refusal::NothingMoves);
        }
        check_direction(&mut issues, Input::CrushPlane, &self.crush_plane.cos, &self.crush_plane.sin);
        let (zero, one) = (T::int(0), T::int(1));
        issues.within(Place::input(Input::Restitution), &self.restitution, zero.clone(), Some(one.clone()));
        match &self.impulse_ratio {
            ImpulseRatio::Critical => true,
            ImpulseRatio::Given(ratio) => issues.finite(Place::input(Input::ImpulseRatio), ratio),
            ImpulseRatio::OfCritical(fraction) => issues.finite(Place::plain("contact.impulse_ratio.of_critical"), fraction),
            ImpulseRatio::LimitedByFriction(friction) => issues.not_negative(Place::plain("contact.friction"), friction),
        };
        match &self.moment {
            Moment::None => true,
            Moment::Given(moment) => issues.finite(Place::input(Input::Moment), moment),
            Moment::OfCritical(fraction) => issues.within(Place::plain("contact.moment.of_critical"), fraction, zero, Some(one)),
        };
        issues.finish()
    }

    /// Checks that the vehicles are closing: v_n s < 0, with both above the rounding of their terms.
    fn check_closing(&self, contact: &Contact<T>) -> Result<(), Refusals<T>> {
        if self.is_closing(contact) {
            Ok(())
        } else {
            Err(Refusal::NotClosing { approach: contact.approach.n.clone(), offset: contact.offset().n }.into())
        }
    }

    /// Checks that the ratio can be evaluated: nothing divides by zero, and a sticking impulse of which it is a fraction is compressive.
    fn check_ratio(&self, contact: &Contact<T>) -> Result<(), Refusals<T>> {
        match &self.impulse_ratio {
            ImpulseRatio::Given(ratio) => {
                let normal = contact.compliance.along_ratio(ratio.clone());
                if !is_positive(&normal) {
                    return Err(Refusal::Tensile { normal, reason: Tension::Wedges }.into());
                }
            }
            ImpulseRatio::OfCritical(fraction) => {
                let sticking = self.sticking_impulse(contact);
                if !is_none(fraction, &sticking) {
                    check_push(contact, &sticking)?;
                }
                if fraction.less(&T::int(0)) || T::int(1).less(fraction) {
                    let critical = sticking.t / sticking.n;
                    let ratio = fraction.clone() * critical.clone();
                    return Err(Refusal::BeyondCritical { ratio, critical: Some(critical) }.into());
                }
            }
            ImpulseRatio::Critical | ImpulseRatio::LimitedByFriction(_) => (),
        }
        Ok(())
    }

    /// Checks that rounding has left the restitution and the energy.
    fn check_accuracy(&self, impact: &Impact<T>) -> Result<(), Refusals<T>> {
        for (error, size) in self.errors(impact) {
            if (size.clone() * tolerance()).less(&error) {
                return Err(Refusal::IllConditioned { error: error / size }.into());
            }
        }
        Ok(())
    }

    fn check_impact(&self, contact: &Contact<T>, impact: &Impact<T>) -> Result<(), Refusals<T>> {
        if !impact.is_finite() {
            return Err(Refusal::OutOfFloatRange.into());
        }
        self.check_accuracy(impact)?;
        check_push(contact, &impact.impulse)?;
        let mut issues = IssueCollector::<Refusal<T>>::new();
        if let ImpulseRatio::Given(ratio) = &self.impulse_ratio
            && !self.is_within_critical(contact, impact)
        {
            let sticking = self.sticking_impulse(contact);
            let critical = contact.is_pushed_by(&sticking).then(|| sticking.t / sticking.n);
            issues.push(Refusal::BeyondCritical { ratio: ratio.clone(), critical });
        }
        if impact.gains_energy() {
            issues.push(Refusal::EnergyGain { gain: -impact.loss(), before: impact.kinetic_energy.before.clone() });
        }
        issues.finish()
    }
}

/// Checks that an impulse pushes.
fn check_push<T: Ordered<Mask = bool>>(contact: &Contact<T>, impulse: &Nt<T>) -> Result<(), Refusals<T>> {
    if contact.is_pushed_by(impulse) { Ok(()) } else { Err(Refusal::Tensile { normal: impulse.n.clone(), reason: Tension::Pulls }.into()) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::crash3::{Damaged, DamagedPair, Surface};
    use crate::{ForceDirection, ForwardLeft, Vehicle};

    /// The most refusals at once: the capacity of [`Refusals`] without an allocator.
    #[test]
    fn every_input_is_refused_at_most_once() {
        let nan = f64::NAN;
        let car = Party::from(Vehicle::default().map(|_: f64| nan));
        let ratios = [
            (1, ImpulseRatio::Given(nan)),
            (1, ImpulseRatio::OfCritical(nan)),
            (1, ImpulseRatio::LimitedByFriction(nan)),
            (0, ImpulseRatio::Critical),
        ];
        let moments = [(1, Moment::Given(nan)), (1, Moment::OfCritical(nan)), (0, Moment::None)];
        let parties = [(16, car, car), (8, car, Party::Barrier), (8, Party::Barrier, car), (1, Party::Barrier, Party::Barrier)];
        let mut most = 0;
        for ((of_parties, one, two), (of_ratio, impulse_ratio), (of_moment, moment)) in
            parties.into_iter().flat_map(|parties| ratios.map(|ratio| moments.map(|moment| (parties, ratio, moment)))).flatten()
        {
            let collision = Collision { impulse_ratio, moment, ..Collision::new(one, two).map(|_| nan) };
            let refusals = collision.solve().expect_err("nothing is a number");
            assert_eq!(refusals.len(), of_parties + 2 + of_ratio + of_moment, "{refusals}");
            most = most.max(refusals.len());
        }
        assert_eq!(most, Input::COUNT);
        let damaged = Damaged {
            mass: nan,
            yaw_inertia: nan,
            impact_center: ForwardLeft { forward: nan, left: nan },
            surface: Surface::Front,
            force_direction: ForceDirection { ahead: nan, right: nan },
            crush_energy: nan,
        };
        let refusals = DamagedPair { one: Some(damaged), two: Some(damaged) }.solve().expect_err("nothing is a number");
        assert_eq!(refusals.len(), 12);
    }
}
