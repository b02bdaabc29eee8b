//! The forward problem with its conditions: the impact, or every reason for refusing it.
//!
//! The checks surround the kernel, which contains no conditions. Every scalar with true or false comparisons is refused for the same reasons
//! (`proptests/refusals.rs`, `every_scalar_refuses_the_same`), an f32 to its own precision.

use crate::collision::Collision;
use crate::contact::Contact;
use crate::frame::Nt;
use crate::impact::{Impact, Response};
use crate::input::{Input, Side};
use crate::issue::{IssueCollector, Place};
use crate::law::ImpulseRatio;
use crate::moment::Moment;
use crate::refusal::{Refusal, Refusals, Tension};
use crate::scalar::{Ordered, is_finite, is_positive, is_zero, rounding, slack, tolerance};
use crate::vehicle::Party;

fn sum_of_magnitudes<T: Ordered>(v: &Nt<T>) -> T {
    v.n.clone().magnitude() + v.t.clone().magnitude()
}

/// Checks a direction, given as a cosine and a sine.
fn check_direction<T: Ordered<Mask = bool>>(issues: &mut IssueCollector<Refusal<T>>, input: Input, cos: &T, sin: &T) {
    let at = Place::input(input);
    if issues.finite(at, cos) && issues.finite(at, sin) {
        let length_squared = cos.clone().squared() + sin.clone().squared();
        let error = (length_squared.clone() - T::int(1)).magnitude();
        if !error.less(&slack()) {
            issues.push(Refusal::NotADirection { at, length_squared });
        }
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
    #[inline(always)]
    pub(crate) fn checked_contact(&self) -> Result<Contact<T>, Refusals<T>> {
        self.check_inputs()?;
        Ok(self.contact())
    }

    /// Computes the impact at the contact of this collision.
    #[inline(always)]
    pub(crate) fn solve_at(&self, contact: &Contact<T>) -> Result<Impact<T>, Refusals<T>> {
        if !is_finite(&contact.compliance.determinant) || !is_positive(&contact.compliance.determinant) {
            return Err(Refusal::OutOfFloatRange.into());
        }
        self.check_closing(contact)?;
        self.check_ratio(contact)?;
        let (impulse, moment) = self.impulse(contact);
        let impact = self.impact_of(contact, impulse, moment);
        self.check_impact(contact, &impact)?;
        Ok(impact)
    }

    fn check_inputs(&self) -> Result<(), Refusals<T>> {
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
            Err(Refusal::NotClosing { approach, offset }.into())
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
                // A fraction of zero is zero, even if the sticking impulse is tensile.
                let none = is_zero(fraction) && !is_zero(&sticking.n);
                if !none {
                    self.check_push(contact, &sticking)?;
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

    /// Checks that the impulse pushes body one away from body two, as the approach does.
    fn check_push(&self, contact: &Contact<T>, impulse: &Nt<T>) -> Result<(), Refusals<T>> {
        if is_positive(&(impulse.n.clone() * contact.approach.n.clone())) {
            Ok(())
        } else {
            Err(Refusal::Tensile { normal: impulse.n.clone(), reason: Tension::Pulls }.into())
        }
    }

    /// Checks that the result has the restitution and the loss that it was computed for: if m r²/I is huge, rounding alone determines them.
    fn check_accuracy(&self, impact: &Impact<T>) -> Result<(), Refusals<T>> {
        let energy = &impact.kinetic_energy;
        let missed = [
            (impact.separation.n.clone() + self.restitution.clone() * impact.approach.n.clone(), impact.approach.n.clone().magnitude()),
            (energy.after.clone() - energy.before.clone() + impact.loss(), energy.before.clone() + energy.after.clone()),
        ];
        for (error, size) in missed {
            let error = error.magnitude();
            if (size.clone() * tolerance()).less(&error) {
                return Err(Refusal::IllConditioned { error: error / size }.into());
            }
        }
        Ok(())
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
        let has_delta_v = |response: &Response<T>| is_finite(&response.delta_v.clone().length_squared());
        if !results.into_iter().all(is_finite) || !has_delta_v(&impact.one) || !has_delta_v(&impact.two) {
            return Err(Refusal::OutOfFloatRange.into());
        }
        self.check_accuracy(impact)?;
        self.check_push(contact, &impact.impulse)?;
        let mut issues = IssueCollector::<Refusal<T>>::new();
        if let ImpulseRatio::Given(ratio) = &self.impulse_ratio {
            let sticking = self.sticking_impulse(contact);
            // Accept tangential impulses with the same normal change between zero and the sticking impulse: the ratio itself has no bound if the sticking
            // impulse is tensile.
            let limit = sticking.t.clone().magnitude() * (T::int(1) + slack());
            let against = (impact.impulse.t.clone() * sticking.t.clone()).less(&T::int(0));
            if against || limit.less(&impact.impulse.t.clone().magnitude()) {
                let critical = self.check_push(contact, &sticking).is_ok().then(|| sticking.t / sticking.n);
                issues.push(Refusal::BeyondCritical { ratio: ratio.clone(), critical });
            }
        }
        let loss = impact.loss();
        let exchanged = impact.work.n.clone().magnitude()
            + impact.work.t.clone().magnitude()
            + impact.work.m.clone().magnitude()
            + (impact.impulse.n.clone() * impact.approach.n.clone()).magnitude();
        if loss.less(&-(exchanged * slack())) {
            issues.push(Refusal::EnergyGain { gain: -loss, before: impact.kinetic_energy.before.clone() });
        }
        issues.finish()
    }
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
