//! The forward problem: post-impact motions from pre-impact motions.
//!
//! # Properties
//!
//! Equalities in exact arithmetic, for any law and ratio unless stated otherwise. Each is a property test, and those without a comparison are proven
//! (`proofs/`).
//!
//! | property | test in `proptests/` |
//! |---|---|
//! | the linear momentum gained by one body is lost by the other, and equals the impulse | `laws.rs`, `linear_momentum_is_exchanged` |
//! | the angular momentum of each body about the impact center changes only by the moment impulse | `laws.rs`, `angular_momentum_of_each_body_about_the_impact_center_is_conserved`, `a_moment_impulse_is_the_change_of_angular_momentum` |
//! | V_n = −e v_n | `laws.rs`, `normal_separation_is_restitution_of_the_approach` |
//! | P_t = μ P_n, and V_t = 0 at μ₀ | `laws.rs`, `the_impulse_has_the_ratio_asked_for`, `sliding_ends_at_the_critical_ratio` |
//! | W_n + W_t + W_m is the change of kinetic energy | `energy.rs`, `work_is_the_change_of_kinetic_energy`, `a_moment_impulse_is_in_the_account` |
//! | T_L is its maximum less ½ δ·K δ, so the maximum is at e = 0, μ = μ₀ | `energy.rs`, `the_loss_is_its_peak_less_a_square`, `the_peak_is_at_common_velocity` |
//! | at e = 0, μ = μ₀ nothing depends on Γ; for e > 0 the loss does | `energy.rs`, `at_common_velocity_nothing_depends_on_the_crush_plane`, `with_restitution_the_loss_depends_on_the_crush_plane` |
//! | the vehicles may be exchanged, mirrored, rotated, or seen from a moving observer; Γ has two normals; units scale by their powers | `symmetry.rs` |
//! | without arms the vehicles are point masses; a barrier is the limit of heavy vehicles, and exact | `limits.rs` |
//! | the f64 result lies in the interval, which encloses the rational one; lanes are four f64 | `scalars.rs` |

use crate::body::Body;
use crate::contact::Contact;
use crate::energy::{KineticEnergy, Work, work};
use crate::frame::{CrushPlane, ForwardLeft, Nt, Xy};
use crate::impact::{Impact, Response};
use crate::law::{ImpulseRatio, Law};
use crate::moment::Moment;
use crate::scalar::{Field, Ordered};
use crate::vehicle::{Motion, Party};

/// Two parties about to collide, and the parameters of the impact.
///
/// Any coherent system of units is accepted; the documentation uses SI.
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
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Collision<T = f64> {
    /// Vehicle 1 of the paper; impulses are those on vehicle 1.
    pub one: Party<T>,
    /// Vehicle 2.
    pub two: Party<T>,
    /// The crush plane Γ.
    pub crush_plane: CrushPlane<T>,
    /// Coefficient of restitution e, from 0 to 1.
    pub restitution: T,
    /// Impulse ratio μ.
    pub impulse_ratio: ImpulseRatio<T>,
    /// The impulse that ends the tangential process.
    pub law: Law,
    /// The moment impulse, if any.
    pub moment: Moment<T>,
}

impl<T> Collision<T> {
    /// Converts the collision to another scalar type.
    #[cfg_attr(not(debug_assertions), inline(always))]
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

    /// Both parties, vehicle 1 first.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn parties(&self) -> [&Party<T>; 2] {
        [&self.one, &self.two]
    }
}

impl<T: Field> Default for Collision<T> {
    /// Two barriers, which [`Collision::solve`] refuses until one party is a vehicle.
    fn default() -> Self {
        Collision::new(Party::Barrier, Party::Barrier)
    }
}

impl<T: Field> Collision<T> {
    /// Creates a collision of two parties without restitution, at the critical impulse ratio of the paper's law, with the crush plane at Γ = 0 and without a
    /// moment.
    #[must_use]
    pub fn new(one: impl Into<Party<T>>, two: impl Into<Party<T>>) -> Self {
        Collision {
            one: one.into(),
            two: two.into(),
            crush_plane: CrushPlane::default(),
            restitution: T::int(0),
            impulse_ratio: ImpulseRatio::Critical,
            law: Law::Brach,
            moment: Moment::None,
        }
    }

    /// Returns the same collision with another crush plane.
    #[must_use]
    pub fn with_crush_plane(self, crush_plane: CrushPlane<T>) -> Self {
        Collision { crush_plane, ..self }
    }

    /// Returns the same collision with another coefficient of restitution.
    #[must_use]
    pub fn with_restitution(self, restitution: T) -> Self {
        Collision { restitution, ..self }
    }

    /// Returns the same collision with another impulse ratio.
    #[must_use]
    pub fn with_impulse_ratio(self, impulse_ratio: ImpulseRatio<T>) -> Self {
        Collision { impulse_ratio, ..self }
    }

    /// Returns the same collision with another law of the tangential impulse.
    #[must_use]
    pub fn with_law(self, law: Law) -> Self {
        Collision { law, ..self }
    }

    /// Returns the same collision with another moment impulse.
    #[must_use]
    pub fn with_moment(self, moment: Moment<T>) -> Self {
        Collision { moment, ..self }
    }

    /// Returns the same two parties with e = 0, μ = μ₀ and no moment, so that they reach a common velocity. The loss is then greatest, and neither it nor the
    /// velocities depend on the crush plane.
    pub fn at_common_velocity(&self) -> Self {
        Collision { restitution: T::int(0), impulse_ratio: ImpulseRatio::Critical, law: Law::Brach, moment: Moment::None, ..self.clone() }
    }

    /// Returns the two parties at the impact center.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn contact(&self) -> Contact<T> {
        Contact::between(Body::seen_from(&self.crush_plane, &self.one), Body::seen_from(&self.crush_plane, &self.two))
    }

    /// Returns the requested moment impulse, if any.
    #[cfg_attr(not(debug_assertions), inline(always))]
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

    /// Returns the change of relative velocity caused by the sticking impulse, without the change caused by a moment.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn sticking_change(&self, contact: &Contact<T>, moment: Option<&T>) -> Nt<T> {
        let change = self.law.change(contact.approach.clone(), self.restitution.clone());
        match moment {
            None => change,
            Some(moment) => change - contact.moment_compliance().force * moment.clone(),
        }
    }

    /// Returns the result of a given impulse and moment, whatever the law.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn impact_of(&self, contact: &Contact<T>, impulse: Nt<T>, moment: Option<T>) -> Impact<T> {
        let mut separation = contact.separation(impulse.clone());
        let mut critical_change = Law::Brach.change(contact.approach.clone(), self.restitution.clone());
        let mut work_of_moment = T::int(0);
        if let Some(moment) = &moment {
            let row = contact.moment_compliance();
            separation -= row.force.clone() * moment.clone();
            critical_change -= row.force.clone() * moment.clone();
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

    #[cfg_attr(not(debug_assertions), inline(always))]
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

/// Returns the kinetic energy of a party in its own or another motion.
#[cfg_attr(not(debug_assertions), inline(always))]
fn energy_of<T: Field>(party: &Party<T>, motion: Option<&Motion<T>>) -> T {
    match party {
        Party::Vehicle(vehicle) => vehicle.kinetic_energy(motion.unwrap_or(&vehicle.motion).clone()),
        Party::Barrier => T::int(0),
    }
}

impl<T: Ordered> Collision<T> {
    /// Computes the impulse and the moment from the law and the ratio.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn impulse(&self, contact: &Contact<T>) -> (Nt<T>, Option<T>) {
        let moment = self.moment_impulse(contact);
        let change = self.sticking_change(contact, moment.as_ref());
        (self.impulse_ratio.impulse(&contact.compliance, change), moment)
    }

    /// Returns the impulse that ends the tangential process, whichever ratio is in force.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn sticking_impulse(&self, contact: &Contact<T>) -> Nt<T> {
        Collision { impulse_ratio: ImpulseRatio::Critical, ..self.clone() }.impulse(contact).0
    }

    /// Computes the impact without checking whether it is possible. On a field it is total, except for a zero divisor.
    ///
    /// Use it for lanes and intervals, whose comparisons have no yes or no. [`Collision::solve`] checks first.
    ///
    /// # Panics
    ///
    /// If the scalar panics on a division by zero, as rationals do: no mass, or an impulse ratio at which the pair wedges.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn evaluate(&self) -> Impact<T> {
        self.impact_at(&self.contact())
    }

    /// Computes the impact of a contact, which is that of this collision.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn impact_at(&self, contact: &Contact<T>) -> Impact<T> {
        let (impulse, moment) = self.impulse(contact);
        self.impact_of(contact, impulse, moment)
    }
}
