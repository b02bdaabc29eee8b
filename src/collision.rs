//! The forward problem: from the motions before the impact to those after it.

use crate::body::Body;
use crate::contact::Contact;
use crate::energy::{KineticEnergy, Work, work};
use crate::frame::{CrushPlane, ForwardLeft, Nt, Xy};
use crate::law::{ImpulseRatio, Law};
use crate::moment::Moment;
use crate::scalar::{Field, Ordered, Real};
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

/// What an impact does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Impact<T = f64> {
    /// The impulse on vehicle 1 in the axes of the contact, in N s; vehicle 2 gets the opposite.
    pub impulse: Nt<T>,
    /// The same in ground axes.
    pub impulse_on_ground: Xy<T>,
    /// The moment impulse on vehicle 1 in N m s; zero when there is none.
    pub moment: T,
    /// The impulse after which sliding has ended, K P = ((1 + e) v_n, v_t): its ratio is the critical one.
    pub critical_impulse: Nt<T>,
    /// Relative velocity at the impact center before, v_2C − v_1C, in m/s.
    pub approach: Nt<T>,
    /// Relative velocity at the impact center after, V_2C − V_1C, in m/s.
    pub separation: Nt<T>,
    /// What vehicle 1 does.
    pub one: Response<T>,
    /// What vehicle 2 does.
    pub two: Response<T>,
    /// The work of each component of the impulse, in J.
    pub work: Work<T>,
    /// Kinetic energy of both, in J. A barrier has none.
    pub kinetic_energy: KineticEnergy<T>,
}

/// What an impact does to one vehicle. A barrier's entries are zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Response<T = f64> {
    /// Its motion after the impact.
    pub after: Motion<T>,
    /// Its change of velocity P/m, in m/s.
    pub delta_v: Xy<T>,
    /// The same in the vehicle's own axes.
    pub delta_v_in_vehicle: ForwardLeft<T>,
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
    /// The two parties at the impact center.
    #[inline(always)]
    pub fn contact(&self) -> Contact<T> {
        Contact::between(Body::seen_from(&self.crush_plane, &self.one), Body::seen_from(&self.crush_plane, &self.two))
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
        let change = self.law.change(contact.approach.clone(), self.restitution.clone());
        let moment = match &self.moment {
            Moment::None => return (self.impulse_ratio.impulse(&contact.compliance, change), None),
            Moment::Given(moment) => moment.clone(),
            Moment::OfCritical(fraction) => {
                let yaw = contact.relative_yaw_rate();
                let yaw = match self.law {
                    Law::Brach => yaw,
                    Law::KudlichSlibar => yaw * (T::int(1) + self.restitution.clone()),
                };
                fraction.clone() * contact.moment_for(change.clone(), yaw)
            }
        };
        let change = change - contact.moment_compliance().force * moment.clone();
        (self.impulse_ratio.impulse(&contact.compliance, change), Some(moment))
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

impl<T: Field> Impact<T> {
    /// The impulse ratio, μ = P_t/P_n (A8).
    #[inline(always)]
    pub fn impulse_ratio(&self) -> T {
        self.impulse.t.clone() / self.impulse.n.clone()
    }

    /// The critical impulse ratio μ₀, at which sliding just ends (A27). A property of the collision, whichever law and ratio are in force.
    #[inline(always)]
    pub fn critical_impulse_ratio(&self) -> T {
        self.critical_impulse.t.clone() / self.critical_impulse.n.clone()
    }

    /// The energy lost, T_L (Eq 1).
    #[inline(always)]
    pub fn loss(&self) -> T {
        self.work.loss()
    }
}

impl<T> Impact<T> {
    /// The same impact on another scalar.
    #[inline(always)]
    pub fn map<U>(self, mut f: impl FnMut(T) -> U) -> Impact<U> {
        Impact {
            impulse: self.impulse.map(&mut f),
            impulse_on_ground: self.impulse_on_ground.map(&mut f),
            moment: f(self.moment),
            critical_impulse: self.critical_impulse.map(&mut f),
            approach: self.approach.map(&mut f),
            separation: self.separation.map(&mut f),
            one: self.one.map(&mut f),
            two: self.two.map(&mut f),
            work: self.work.map(&mut f),
            kinetic_energy: self.kinetic_energy.map(f),
        }
    }
}

impl<T> Response<T> {
    /// The same response on another scalar.
    #[inline(always)]
    pub fn map<U>(self, mut f: impl FnMut(T) -> U) -> Response<U> {
        Response { after: self.after.map(&mut f), delta_v: self.delta_v.map(&mut f), delta_v_in_vehicle: self.delta_v_in_vehicle.map(f) }
    }
}

impl<T: Real> Response<T> {
    /// Magnitude of the change of velocity, ΔV, in m/s.
    #[inline(always)]
    pub fn delta_v_magnitude(&self) -> T {
        self.delta_v.clone().length()
    }

    /// The principal direction of force: where the force comes from, in the vehicle's axes, in radians clockwise from straight ahead, in (−π, π].
    /// 0 is a frontal impact, π/2 one from the right. Zero where no force acts.
    #[inline(always)]
    pub fn principal_direction_of_force(&self) -> T {
        let zero = T::int(0);
        let dv = self.delta_v_in_vehicle.clone();
        let some = zero.less(&dv.clone().length_squared());
        // Adding zero makes a negative zero positive, so that a push from straight behind is +π and not −π.
        let across = dv.left + zero.clone();
        let along = T::select(some.clone(), -dv.forward, T::int(1));
        T::select(some, across, zero).atan2(along)
    }
}
