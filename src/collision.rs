//! The forward problem: from the motions before the impact to those after it.
//!
//! # Properties
//!
//! Equalities in exact arithmetic, for any law and ratio unless said otherwise; each is a property test, and those without a comparison are proven (`proofs/`).
//!
//! | what holds | test in `proptests/` |
//! |---|---|
//! | what one body gains in linear momentum the other loses, and it is the impulse | `laws.rs`, `linear_momentum_is_exchanged` |
//! | neither body's angular momentum about the impact center changes, but by the moment impulse | `laws.rs`, `angular_momentum_of_each_body_about_the_impact_center_is_conserved`, `a_moment_impulse_is_the_change_of_angular_momentum` |
//! | V_n = −e v_n | `laws.rs`, `normal_separation_is_restitution_of_the_approach` |
//! | P_t = μ P_n, and V_t = 0 at μ₀ | `laws.rs`, `the_impulse_has_the_ratio_asked_for`, `sliding_ends_at_the_critical_ratio` |
//! | W_n + W_t + W_m is the change of kinetic energy | `energy.rs`, `work_is_the_change_of_kinetic_energy`, `a_moment_impulse_is_in_the_account` |
//! | T_L is its peak less ½ δ·K δ, so the peak is at e = 0, μ = μ₀ | `energy.rs`, `the_loss_is_its_peak_less_a_square`, `the_peak_is_at_common_velocity` |
//! | there nothing depends on Γ; for e > 0 it does | `energy.rs`, `at_common_velocity_nothing_depends_on_the_crush_plane`, `with_restitution_the_loss_depends_on_the_crush_plane` |
//! | the vehicles may be exchanged, mirrored, turned, watched in passing; Γ has two normals; units scale by their powers | `symmetry.rs` |
//! | without arms they are point masses; a barrier is the limit of heavy vehicles, and exact | `limits.rs` |
//! | f64 lies in the interval, which encloses the rational; lanes are four f64 | `scalars.rs` |

use crate::body::Body;
use crate::contact::Contact;
use crate::energy::{KineticEnergy, Work, work};
use crate::frame::{CrushPlane, ForwardLeft, Nt, Xy};
use crate::impact::{Impact, Response};
use crate::law::{ImpulseRatio, Law};
use crate::moment::Moment;
use crate::scalar::{Field, Ordered};
use crate::vehicle::{Motion, Party};

/// Two parties about to collide, and how.
///
/// Any coherent system of units will do; SI is the documented one.
///
/// ```
/// use planar_impact::*;
///
/// let car: Vehicle = Vehicle {
///     mass: 1500.0,
///     yaw_inertia: 2500.0,
///     heading: Heading::from_angle(0.0),
///     impact_center: ForwardLeft { forward: 2.0, left: 0.5 },
///     motion: Motion { velocity: Xy { x: 15.0, y: 0.0 }, yaw_rate: 0.0 },
/// };
/// let collision = Collision {
///     one: car.into(),
///     two: Party::Barrier,
///     crush_plane: CrushPlane::from_angle(0.0),
///     restitution: 0.1,
///     impulse_ratio: ImpulseRatio::Critical,
///     law: Law::Brach,
///     moment: Moment::None,
/// };
/// let impact = collision.solve()?;
/// assert!((impact.separation.n - 1.5).abs() < 1e-12); // e × 15 m/s
/// assert!(impact.separation.t.abs() < 1e-12); // sliding has ended
/// # Ok::<(), Refusals>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Collision<T = f64> {
    /// Vehicle 1 of the paper; the impulse is the one on it.
    pub one: Party<T>,
    /// Vehicle 2.
    pub two: Party<T>,
    /// The crush plane Γ.
    pub crush_plane: CrushPlane<T>,
    /// Coefficient of restitution e, from 0 to 1.
    pub restitution: T,
    /// Impulse ratio μ.
    pub impulse_ratio: ImpulseRatio<T>,
    /// Which impulse ends the tangential process.
    pub law: Law,
    /// The moment impulse, if any.
    pub moment: Moment<T>,
}

impl<T> Collision<T> {
    /// The same collision on another scalar.
    #[inline(always)]
    pub fn map<U>(self, mut f: impl FnMut(T) -> U) -> Collision<U> {
        Collision {
            one: self.one.map(&mut f),
            two: self.two.map(&mut f),
            crush_plane: self.crush_plane.map(&mut f),
            restitution: f(self.restitution),
            impulse_ratio: self.impulse_ratio.map(&mut f),
            law: self.law,
            moment: self.moment.map(f),
        }
    }
}

impl<T: Field> Collision<T> {
    /// The same two parties, with no restitution and no sliding left: e = 0, μ = μ₀ and no moment. There the loss is greatest, and neither it nor the
    /// velocities depend on the crush plane.
    pub fn at_common_velocity(&self) -> Self {
        Collision { restitution: T::int(0), impulse_ratio: ImpulseRatio::Critical, law: Law::Brach, moment: Moment::None, ..self.clone() }
    }

    /// The two parties at the impact center.
    #[inline(always)]
    pub fn contact(&self) -> Contact<T> {
        Contact::between(Body::seen_from(&self.crush_plane, &self.one), Body::seen_from(&self.crush_plane, &self.two))
    }

    /// The moment impulse that is asked for, if any.
    #[inline(always)]
    pub fn moment_impulse(&self, contact: &Contact<T>) -> Option<T> {
        match &self.moment {
            Moment::None => None,
            Moment::Given(moment) => Some(moment.clone()),
            Moment::OfCritical(fraction) => {
                let yaw = contact.relative_yaw_rate();
                let yaw = match self.law {
                    Law::Brach => yaw,
                    Law::KudlichSlibar => yaw * (T::int(1) + self.restitution.clone()),
                };
                let change = self.law.change(contact.approach.clone(), self.restitution.clone());
                Some(fraction.clone() * contact.moment_for(change, yaw))
            }
        }
    }

    /// The change of relative velocity that the sticking impulse brings, beside what a moment brings.
    #[inline(always)]
    pub fn sticking_change(&self, contact: &Contact<T>, moment: Option<&T>) -> Nt<T> {
        let change = self.law.change(contact.approach.clone(), self.restitution.clone());
        match moment {
            None => change,
            Some(moment) => change - contact.moment_compliance().force * moment.clone(),
        }
    }

    /// What a given impulse and moment do, whichever law chose them.
    #[inline(always)]
    pub fn impact_of(&self, contact: &Contact<T>, impulse: Nt<T>, moment: Option<T>) -> Impact<T> {
        let mut separation = contact.separation(impulse.clone());
        let mut critical_change = Law::Brach.change(contact.approach.clone(), self.restitution.clone());
        let mut work_of_moment = T::int(0);
        if let Some(moment) = &moment {
            let row = contact.moment_compliance();
            separation = separation - row.force.clone() * moment.clone();
            critical_change = critical_change - row.force.clone() * moment.clone();
            let before = contact.relative_yaw_rate();
            let after = before.clone() - row.force.dot(impulse.clone()) - row.moment * moment.clone();
            work_of_moment = work(moment.clone(), before, after);
        }
        let on_one = self.response(&self.one, &contact.one, impulse.clone(), moment.clone());
        let on_two = self.response(&self.two, &contact.two, -impulse.clone(), moment.clone().map(|m| -m));
        Impact {
            impulse_on_ground: self.crush_plane.to_ground(impulse.clone()),
            moment: moment.unwrap_or_else(|| T::int(0)),
            critical_impulse: contact.compliance.impulse_for(critical_change),
            approach: contact.approach.clone(),
            work: Work { m: work_of_moment, ..Work::of(impulse.clone(), contact.approach.clone(), separation.clone()) },
            kinetic_energy: KineticEnergy {
                before: energy_of(&self.one, None) + energy_of(&self.two, None),
                after: energy_of(&self.one, Some(&on_one.after)) + energy_of(&self.two, Some(&on_two.after)),
            },
            impulse,
            separation,
            one: on_one,
            two: on_two,
        }
    }

    #[inline(always)]
    fn response(&self, party: &Party<T>, body: &Body<T>, impulse: Nt<T>, moment: Option<T>) -> Response<T> {
        let Some(vehicle) = party.vehicle() else {
            return Response { after: Motion::rest(), delta_v: Xy::zero(), delta_v_in_vehicle: ForwardLeft::zero() };
        };
        let delta_v = self.crush_plane.to_ground(body.delta_v(impulse.clone()));
        let mut yaw_rate = vehicle.motion.yaw_rate.clone() + body.delta_yaw_rate(impulse);
        if let Some(moment) = moment {
            yaw_rate = yaw_rate + moment * body.inverse_yaw_inertia.clone();
        }
        Response {
            after: Motion { velocity: vehicle.motion.velocity.clone() + delta_v.clone(), yaw_rate },
            delta_v_in_vehicle: vehicle.heading.to_vehicle(delta_v.clone()),
            delta_v,
        }
    }
}

/// The kinetic energy of a party in its own or another motion.
#[inline(always)]
fn energy_of<T: Field>(party: &Party<T>, motion: Option<&Motion<T>>) -> T {
    match party {
        Party::Vehicle(vehicle) => vehicle.kinetic_energy(motion.unwrap_or(&vehicle.motion).clone()),
        Party::Barrier => T::int(0),
    }
}

impl<T: Ordered> Collision<T> {
    /// The impulse and moment that the law and the ratio choose.
    #[inline(always)]
    pub fn impulse(&self, contact: &Contact<T>) -> (Nt<T>, Option<T>) {
        let moment = self.moment_impulse(contact);
        let change = self.sticking_change(contact, moment.as_ref());
        (self.impulse_ratio.impulse(&contact.compliance, change), moment)
    }

    /// The impact without asking whether it is possible: total on a field, but for a divisor that is zero.
    ///
    /// This is the one for lanes and intervals, whose comparisons have no yes or no. [`Collision::solve`] asks first.
    ///
    /// # Panics
    ///
    /// Where the scalar panics on a division by zero, as rationals do: no mass, or an impulse ratio at which the pair wedges.
    #[inline(always)]
    pub fn evaluate(&self) -> Impact<T> {
        let contact = self.contact();
        let (impulse, moment) = self.impulse(&contact);
        self.impact_of(&contact, impulse, moment)
    }
}
