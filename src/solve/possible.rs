//! The conditions of a possible impact, each a mask and without a branch: true or false for one collision, and so a loop over many becomes one over vectors;
//! lane by lane for several.
//!
//! [`Collision::solve`] asks one after the other and says what is wrong; a batch, and lanes, ask all of them at once (`is_possible`).

use crate::collision::Collision;
use crate::contact::Contact;
use crate::frame::Nt;
use crate::impact::{Impact, Response};
use crate::law::ImpulseRatio;
use crate::moment::Moment;
#[cfg(any(feature = "uncertainty", feature = "reconstruct"))]
use crate::scalar::interval::Interval;
use crate::scalar::{Logic, Ordered, is_finite, is_positive, is_zero, rounding, slack, tolerance};
use crate::vehicle::Party;

#[cfg_attr(not(debug_assertions), inline(always))]
fn always<T: Ordered>() -> T::Mask {
    T::int(0).less(&T::int(1))
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn sum_of_magnitudes<T: Ordered>(v: &Nt<T>) -> T {
    v.n.clone().magnitude() + v.t.clone().magnitude()
}

/// Returns `true` if a cosine and a sine are those of an angle.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn is_direction<T: Ordered<Mask: Logic>>(cos: &T, sin: &T) -> T::Mask {
    let length_squared = cos.clone().squared() + sin.clone().squared();
    (length_squared - T::int(1)).magnitude().less(&slack())
}

/// Returns `true` if a number is neither below the first bound nor above the second, nor not a number.
#[cfg_attr(not(debug_assertions), inline(always))]
fn is_between<T: Ordered<Mask: Logic>>(x: &T, least: i32, greatest: i32) -> T::Mask {
    is_finite(x) & !x.less(&T::int(least)) & !T::int(greatest).less(x)
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn has_sound_inputs<T: Ordered<Mask: Logic>>(party: &Party<T>) -> T::Mask {
    let Party::Vehicle(vehicle) = party else { return always::<T>() };
    is_finite(&vehicle.mass)
        & is_positive(&vehicle.mass)
        & is_finite(&vehicle.yaw_inertia)
        & is_positive(&vehicle.yaw_inertia)
        & is_direction(&vehicle.heading.cos, &vehicle.heading.sin)
        & is_finite(&vehicle.impact_center.forward)
        & is_finite(&vehicle.impact_center.left)
        & is_finite(&vehicle.motion.velocity.x)
        & is_finite(&vehicle.motion.velocity.y)
        & is_finite(&vehicle.motion.yaw_rate)
}

#[cfg(any(feature = "uncertainty", feature = "reconstruct"))]
impl Collision<Interval> {
    /// Returns `true` if the direction of sliding may reverse with a jump of the impulse. Where the normal change is not zero it reverses only where the
    /// sticking impulse is along the normal, hence compressive: there the bodies stick in between, and the impulse is continuous.
    pub(crate) fn friction_may_reverse(&self, contact: &Contact<Interval>) -> bool {
        let ImpulseRatio::LimitedByFriction(_) = &self.impulse_ratio else { return false };
        let moment = self.moment_impulse(contact);
        self.sticking_change(contact, moment.as_ref()).n.contains(0.0)
    }
}

impl<T: Ordered<Mask: Logic>> Collision<T> {
    /// Returns `true` if [`Collision::solve`] accepts the collision, given its contact and its impact.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[cfg_attr(not(any(feature = "batch", feature = "lanes")), allow(dead_code))]
    pub(crate) fn is_possible(&self, contact: &Contact<T>, impact: &Impact<T>) -> T::Mask {
        let determinant = &contact.compliance.determinant;
        self.has_sound_inputs()
            & is_finite(determinant)
            & is_positive(determinant)
            & self.is_closing(contact)
            & self.has_possible_ratio(contact)
            & impact.is_finite()
            & self.is_accurate(impact)
            & contact.is_pushed_by(&impact.impulse)
            & self.is_within_critical(contact, impact)
            & !impact.gains_energy()
    }

    /// Returns the same in exact arithmetic: of a box of collisions whose directions follow from angles, without the conditions that only rounding violates.
    #[cfg(any(feature = "uncertainty", feature = "reconstruct"))]
    pub(crate) fn is_possible_exactly(&self, contact: &Contact<T>, impact: &Impact<T>) -> T::Mask {
        self.parties().into_iter().fold(always::<T>(), |all, party| match party {
            Party::Barrier => all,
            Party::Vehicle(vehicle) => all & is_positive(&vehicle.mass) & is_positive(&vehicle.yaw_inertia),
        }) & self.has_sound_parameters()
            & self.is_closing(contact)
            & self.has_possible_ratio(contact)
            & contact.is_pushed_by(&impact.impulse)
            & self.is_within_critical(contact, impact)
            & !impact.gains_energy()
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn has_sound_inputs(&self) -> T::Mask {
        has_sound_inputs(&self.one)
            & has_sound_inputs(&self.two)
            & is_direction(&self.crush_plane.cos, &self.crush_plane.sin)
            & self.has_sound_parameters()
    }

    /// Returns `true` if the restitution, the ratio and the moment are within their limits.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn has_sound_parameters(&self) -> T::Mask {
        let ratio = match &self.impulse_ratio {
            ImpulseRatio::Critical => always::<T>(),
            ImpulseRatio::Given(ratio) => is_finite(ratio),
            ImpulseRatio::OfCritical(fraction) => is_finite(fraction),
            ImpulseRatio::LimitedByFriction(friction) => is_finite(friction) & !friction.less(&T::int(0)),
        };
        let moment = match &self.moment {
            Moment::None => always::<T>(),
            Moment::Given(moment) => is_finite(moment),
            Moment::OfCritical(fraction) => is_between(fraction, 0, 1),
        };
        is_between(&self.restitution, 0, 1) & ratio & moment
    }

    /// Returns `true` if the approach along the normal and the offset of the centers of mass along it have opposite signs, and are not just rounding of their
    /// terms. Two point masses, whose impact centers are their centers of mass, have no sides: any
    /// approach along the normal closes.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn is_closing(&self, contact: &Contact<T>) -> T::Mask {
        let (one, two) = (&contact.one, &contact.two);
        let speeds = sum_of_magnitudes(&one.velocity)
            + sum_of_magnitudes(&two.velocity)
            + sum_of_magnitudes(&one.arm) * one.yaw_rate.clone().magnitude()
            + sum_of_magnitudes(&two.arm) * two.yaw_rate.clone().magnitude();
        let arms = sum_of_magnitudes(&one.arm) + sum_of_magnitudes(&two.arm);
        let (approach, offset) = (&contact.approach.n, contact.offset().n);
        let moves = (speeds * rounding()).less(&approach.clone().magnitude());
        let apart = (arms * rounding()).less(&offset.clone().magnitude());
        moves & (self.is_of_points(contact) | (apart & (is_positive(approach) ^ is_positive(&offset))))
    }

    /// Returns `true` if both parties are vehicles whose impact center is their center of mass.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn is_of_points(&self, contact: &Contact<T>) -> T::Mask {
        if self.one.vehicle().is_none() || self.two.vehicle().is_none() {
            return !always::<T>();
        }
        is_zero(&(sum_of_magnitudes(&contact.one.arm) + sum_of_magnitudes(&contact.two.arm)))
    }

    /// Returns `true` if a given ratio lets the vehicles separate, or if a fraction of the critical ratio is one and that ratio exists.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn has_possible_ratio(&self, contact: &Contact<T>) -> T::Mask {
        match &self.impulse_ratio {
            ImpulseRatio::Given(ratio) => is_positive(&contact.compliance.along_ratio(ratio.clone())),
            ImpulseRatio::OfCritical(fraction) => {
                let sticking = self.sticking_impulse(contact);
                (is_none(fraction, &sticking) | contact.is_pushed_by(&sticking)) & is_between(fraction, 0, 1)
            }
            ImpulseRatio::Critical | ImpulseRatio::LimitedByFriction(_) => always::<T>(),
        }
    }

    /// Returns `true` if the impact has the restitution and the loss that it was computed for: if m r²/I is huge, rounding alone determines them.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn is_accurate(&self, impact: &Impact<T>) -> T::Mask {
        let [(restitution, approach), (energy, exchanged)] = self.errors(impact);
        !(approach * tolerance()).less(&restitution) & !(exchanged * tolerance()).less(&energy)
    }

    /// Returns the errors of the restitution and of the energy of an impact, each with its size.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn errors(&self, impact: &Impact<T>) -> [(T, T); 2] {
        let energy = &impact.kinetic_energy;
        let restitution = impact.separation.n.clone() + self.restitution.clone() * impact.approach.n.clone();
        let balance = energy.after.clone() - energy.before.clone() + impact.loss();
        [
            (restitution.magnitude(), impact.approach.n.clone().magnitude()),
            (balance.magnitude(), energy.before.clone() + energy.after.clone()),
        ]
    }

    /// Returns `true` if the tangential impulse of a given ratio lies between zero and that of the sticking impulse, whose normal change is the same: the ratio
    /// itself has no bound if the sticking impulse is tensile.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn is_within_critical(&self, contact: &Contact<T>, impact: &Impact<T>) -> T::Mask {
        let ImpulseRatio::Given(_) = &self.impulse_ratio else { return always::<T>() };
        let sticking = self.sticking_impulse(contact);
        let limit = sticking.t.clone().magnitude() * (T::int(1) + slack());
        let against = (impact.impulse.t.clone() * sticking.t).less(&T::int(0));
        !against & !limit.less(&impact.impulse.t.clone().magnitude())
    }
}

/// Returns `true` if a fraction of the critical ratio is zero, which it is even if the sticking impulse is tensile.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn is_none<T: Ordered<Mask: Logic>>(fraction: &T, sticking: &Nt<T>) -> T::Mask {
    is_zero(fraction) & !is_zero(&sticking.n)
}

impl<T: Ordered<Mask: Logic>> Contact<T> {
    /// Returns `true` if an impulse pushes body one away from body two, as the approach does.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn is_pushed_by(&self, impulse: &Nt<T>) -> T::Mask {
        is_positive(&(impulse.n.clone() * self.approach.n.clone()))
    }
}

impl<T: Ordered<Mask: Logic>> Impact<T> {
    /// Returns `true` if no number of the impact has overflowed.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn is_finite(&self) -> T::Mask {
        let has_delta_v = |response: &Response<T>| is_finite(&response.delta_v.clone().length_squared());
        is_finite(&self.impulse.n)
            & is_finite(&self.impulse.t)
            & is_finite(&self.moment)
            & is_finite(&self.work.n)
            & is_finite(&self.work.t)
            & is_finite(&self.work.m)
            & is_finite(&self.one.after.yaw_rate)
            & is_finite(&self.two.after.yaw_rate)
            & is_finite(&self.kinetic_energy.before)
            & is_finite(&self.kinetic_energy.after)
            & has_delta_v(&self.one)
            & has_delta_v(&self.two)
    }

    /// Returns `true` if more energy is gained than rounding explains.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn gains_energy(&self) -> T::Mask {
        let exchanged = self.work.n.clone().magnitude()
            + self.work.t.clone().magnitude()
            + self.work.m.clone().magnitude()
            + (self.impulse.n.clone() * self.approach.n.clone()).magnitude()
            + (self.impulse.t.clone() * self.approach.t.clone()).magnitude();
        self.loss().less(&-(exchanged * slack()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input::Input;
    use crate::vehicle::Vehicle;

    /// Two vehicles that meet with a given ratio and a given moment, so that every input counts.
    fn collision() -> Collision {
        let one = Vehicle::new(1500.0, 2500.0).with_impact_center(2.0, 0.3).with_speed(15.0).with_yaw_rate(0.2);
        let two = Vehicle::new(1000.0, 1400.0).with_impact_center(-1.5, 0.2).with_speed(5.0).with_yaw_rate(-0.1);
        Collision { impulse_ratio: ImpulseRatio::Given(0.1), moment: Moment::Given(20.0), ..Collision::new(one, two).with_restitution(0.2) }
    }

    #[test]
    fn one_input_that_is_not_sound_is_enough() {
        assert!(collision().has_sound_inputs());
        for input in Input::ALL {
            let odd = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY].into_iter();
            let beyond: &[f64] = match input {
                // A great mass below zero leaves a compliance that is positive.
                Input::Mass(_) | Input::YawInertia(_) => &[0.0, -1.0, -1e5],
                Input::Restitution => &[-0.1, 1.1],
                _ => &[],
            };
            for value in odd.chain(beyond.iter().copied()) {
                let mut spoiled = collision();
                spoiled.set(input, value).expect("an input of the collision");
                assert!(!spoiled.has_sound_inputs(), "{input} {value}");
                assert!(spoiled.solve().is_err(), "{input} {value}");
            }
        }
    }

    /// With a restitution of 1 the law of Kudlich and Slibar turns the whole approach around: the works are the rounding of the products of the impulse and the approach,
    /// and of an approach that is mostly tangential that of the tangential product.
    #[test]
    fn an_approach_that_is_turned_around_gains_nothing() {
        let mut solved = 0;
        for (plane, heading, arm, speed) in
            (0..18).flat_map(|i| (0..12).flat_map(move |j| (0..5).flat_map(move |k| (5..8).map(move |l| (10 * i, 5 * j, k, 2 * l)))))
        {
            let one: Vehicle = Vehicle::new(1000.0, 3000.0).with_speed(15.0);
            let angle = crate::Heading::from_angle(f64::from(heading).to_radians());
            let two = Vehicle::new(1500.0, 2500.0)
                .with_impact_center(-0.5 * f64::from(arm), 0.0)
                .with_heading(angle)
                .with_speed(f64::from(speed));
            let collision = Collision::new(one, two)
                .with_crush_plane(crate::CrushPlane::from_angle(f64::from(plane).to_radians()))
                .with_law(crate::Law::KudlichSlibar)
                .with_restitution(1.0);
            match collision.solve() {
                Ok(impact) => {
                    solved += 1;
                    assert!(!impact.gains_energy());
                }
                Err(refusals) => {
                    assert!(refusals.iter().all(|refusal| refusal.code() != "energy-gain"), "{plane} {heading} {arm} {speed}: {refusals}");
                }
            }
        }
        assert!(solved > 500, "{solved}");
    }

    #[test]
    fn one_number_that_overflowed_is_enough() {
        let impact = collision().evaluate();
        assert!(impact.is_finite());
        let numbers: [fn(&mut Impact) -> &mut f64; 14] = [
            |impact| &mut impact.impulse.n,
            |impact| &mut impact.impulse.t,
            |impact| &mut impact.moment,
            |impact| &mut impact.work.n,
            |impact| &mut impact.work.t,
            |impact| &mut impact.work.m,
            |impact| &mut impact.one.after.yaw_rate,
            |impact| &mut impact.two.after.yaw_rate,
            |impact| &mut impact.kinetic_energy.before,
            |impact| &mut impact.kinetic_energy.after,
            |impact| &mut impact.one.delta_v.x,
            |impact| &mut impact.one.delta_v.y,
            |impact| &mut impact.two.delta_v.x,
            |impact| &mut impact.two.delta_v.y,
        ];
        for (place, number) in numbers.into_iter().enumerate() {
            for value in [f64::INFINITY, f64::NEG_INFINITY, f64::NAN] {
                let mut spoiled = impact;
                *number(&mut spoiled) = value;
                assert!(!spoiled.is_finite(), "{place} {value}");
            }
        }
    }
}
