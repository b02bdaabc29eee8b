//! Reconstructions in closed form. Each is a check of the search, and faster if it applies.
//!
//! | known | unknown | function |
//! |---|---|---|
//! | crush energy, the directions of motion and their proportions: a barrier with a known crab angle | the speed | [`at_crush_energy`] |
//! | crush energy, e, the compliance along the force | the normal closing speed | [`closing_speed`] |
//! | crush energy, e, the velocities after it, two vehicles on one line through both centers of mass | the velocities before | [`Collinear::before`] |
//! | crush energy, both motions after it, the impulse ratio or the heading along which one vehicle drove | both motions before, e | [`before_separation`] |
//!
//! All of them run on any scalar with square roots, including dual numbers for derivatives.

use crate::body::Body;
use crate::collision::Collision;
use crate::contact::Contact;
use crate::frame::Nt;
use crate::input::Side;
use crate::law::{ImpulseRatio, Law};
use crate::moment::Moment;
use crate::scalar::Real;
use crate::vehicle::{Party, Vehicle};

/// Returns the collision with the same directions and proportions of all motions and the given crush energy, in J.
///
/// Works grow with the square of the speeds, so every motion is multiplied by √(E_C/−W_n). With a barrier and a known crab angle this is the reconstruction
/// of the paper's Table B2. Not valid for a given moment impulse, which does not grow with the speeds.
///
/// ```
/// use planar_impact::reconstruct::closed_form::at_crush_energy;
/// # use planar_impact::*;
/// # let car: Vehicle = Vehicle {
/// #     mass: 1500.0, yaw_inertia: 2500.0, heading: Heading::from_angle(0.5), impact_center: ForwardLeft { forward: 1.4, left: -0.2 },
/// #     motion: Motion { velocity: Xy { x: 8.8, y: 4.8 }, yaw_rate: 0.0 },
/// # };
/// # let collision = Collision {
/// #     one: car.into(), two: Party::Barrier, crush_plane: CrushPlane::from_angle(0.0), restitution: 0.1,
/// #     impulse_ratio: ImpulseRatio::Critical, law: Law::Brach, moment: Moment::None,
/// # };
/// let impact = at_crush_energy(&collision, 100e3).solve()?;
/// assert!((impact.work.n + 100e3).abs() < 1e-6);
/// # Ok::<(), Refusals>(())
/// ```
pub fn at_crush_energy<T: Real>(collision: &Collision<T>, crush_energy: T) -> Collision<T> {
    let factor = (crush_energy / -collision.evaluate().work.n).square_root();
    let faster = |party: &Party<T>| match party {
        Party::Barrier => Party::Barrier,
        Party::Vehicle(vehicle) => {
            let mut vehicle = vehicle.clone();
            vehicle.motion.velocity *= factor.clone();
            vehicle.motion.yaw_rate = vehicle.motion.yaw_rate * factor.clone();
            Party::Vehicle(vehicle)
        }
    };
    Collision { one: faster(&collision.one), two: faster(&collision.two), ..collision.clone() }
}

/// Returns the normal closing speed |v_n| in m/s at which the work of the normal impulse is −E_C: v_n² = 2 k E_C/(1 − e²).
///
/// k is the change of normal velocity by a unit of normal impulse, K_nn + μ K_nt (`Compliance::along_ratio`) in 1/kg; for two point masses on one line it is
/// 1/m₁ + 1/m₂.
pub fn closing_speed<T: Real>(compliance: T, restitution: T, crush_energy: T) -> T {
    let both = (T::int(1) - restitution.clone()) * (T::int(1) + restitution);
    (T::int(2) * compliance * crush_energy / both).square_root()
}

/// Two vehicles that collide on one line through both centers of mass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Collinear<T = f64> {
    /// 1/m of vehicle 1 in 1/kg; zero for a barrier.
    pub inverse_mass_1: T,
    /// 1/m of vehicle 2 in 1/kg; zero for a barrier.
    pub inverse_mass_2: T,
    /// Coefficient of restitution e.
    pub restitution: T,
    /// Crush energy of both, E_C, in J.
    pub crush_energy: T,
}

/// The velocities of two vehicles along one line, in m/s. Vehicle 1 comes from below, vehicle 2 from above.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AlongLine<T = f64> {
    /// Velocity of vehicle 1.
    pub one: T,
    /// Velocity of vehicle 2.
    pub two: T,
}

impl<T: Real> Collinear<T> {
    /// Returns the impulse between them, in N s: P² = 2 E_C (1 + e)/((1 − e) k).
    pub fn impulse(&self) -> T {
        let compliance = self.inverse_mass_1.clone() + self.inverse_mass_2.clone();
        let (plus, minus) = (T::int(1) + self.restitution.clone(), T::int(1) - self.restitution.clone());
        (T::int(2) * self.crush_energy.clone() * plus / (minus * compliance)).square_root()
    }

    /// Returns the velocities before the impact, from that of vehicle 1 after it.
    pub fn before(&self, one_after: T) -> AlongLine<T> {
        let impulse = self.impulse();
        let compliance = self.inverse_mass_1.clone() + self.inverse_mass_2.clone();
        let closing = closing_speed(compliance, self.restitution.clone(), self.crush_energy.clone());
        let one = one_after + impulse * self.inverse_mass_1.clone();
        AlongLine { two: one.clone() - closing, one }
    }
}

/// The condition on the direction of the impulse if both motions after the impact are known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Direction<T = f64> {
    /// The impulse ratio μ = P_t/P_n.
    Ratio(T),
    /// One vehicle drove along its heading.
    AlongHeading(Side),
}

/// Returns the collisions that end in the motions of `after`, with a given crush energy in J. There are two, the roots of
///
/// ```text
/// E_C = ½ P_n (2 V_n + (K P)_n)
/// ```
///
/// along the line of impulses that the direction allows; [`Collision::solve`] decides which of them is possible. At e = 0, with V_n = 0, and a given ratio
/// they are ±√(2 E_C/k). The results contain the restitution e = −V_n/v_n and the ratio that follow; those of `after` are not used. Returns `None` if the
/// direction does not allow this energy, or a party that should drive along its heading is a barrier.
///
/// ```
/// use planar_impact::reconstruct::closed_form::{Direction, before_separation};
/// use planar_impact::*;
/// # let car = |heading: f64, speed: f64| Vehicle {
/// #     mass: 1500.0, yaw_inertia: 2500.0, heading: Heading::from_angle(heading), impact_center: ForwardLeft { forward: 2.0, left: 0.3 },
/// #     motion: Motion { velocity: Xy { x: speed, y: 0.0 }, yaw_rate: 0.0 },
/// # };
/// # let collision: Collision = Collision {
/// #     one: car(0.0, 10.0).into(), two: car(std::f64::consts::PI, -12.0).into(), crush_plane: CrushPlane::from_angle(0.1), restitution: 0.0,
/// #     impulse_ratio: ImpulseRatio::Critical, law: Law::Brach, moment: Moment::None,
/// # };
/// let impact = collision.solve()?;
/// let mut after = collision;
/// # if let (Party::Vehicle(one), Party::Vehicle(two)) = (&mut after.one, &mut after.two) { (one.motion, two.motion) = (impact.one.after, impact.two.after); }
/// let both = before_separation(&after, -impact.work.n, Direction::AlongHeading(Side::One)).expect("there is such an energy");
/// let speeds = both.map(|before| before.one.vehicle().expect("a car").motion.velocity.x);
/// assert!(speeds.iter().any(|speed| (speed - 10.0).abs() < 1e-9));
/// # Ok::<(), Refusals>(())
/// ```
pub fn before_separation<T: Real<Mask = bool>>(
    after: &Collision<T>,
    crush_energy: T,
    direction: Direction<T>,
) -> Option<[Collision<T>; 2]> {
    let contact = after.contact();
    // P = fixed + s along.
    let (fixed, along) = match direction {
        Direction::Ratio(ratio) => (Nt::zero(), Nt { n: T::int(1), t: ratio }),
        Direction::AlongHeading(side) => line_of_heading(after, &contact, side)?,
    };
    let separation = contact.approach.clone();
    let (k_fixed, k_along) = (contact.compliance.velocity_change(fixed.clone()).n, contact.compliance.velocity_change(along.clone()).n);
    let two_v = T::int(2) * separation.n.clone() + k_fixed;
    // ½ (fixed_n + s along_n) (2 V_n + (K fixed)_n + s (K along)_n) − E_C = a s² + b s + c
    let a = (along.n.clone() * k_along.clone()).half();
    let b = (fixed.n.clone() * k_along + along.n.clone() * two_v.clone()).half();
    let c = (fixed.n.clone() * two_v).half() - crush_energy;
    let discriminant = b.clone().squared() - T::int(4) * a.clone() * c;
    if discriminant.less(&T::int(0)) {
        return None;
    }
    let (root, twice_a) = (discriminant.square_root(), T::int(2) * a);
    let of = |s: T| before(after, &contact, fixed.clone() + along.clone() * s);
    Some([of((-b.clone() + root.clone()) / twice_a.clone()), of((-b - root) / twice_a)])
}

/// Returns the impulses P after which a vehicle was driving along its heading before the impact, V ∓ P/m, as a point and a direction.
fn line_of_heading<T: Real>(after: &Collision<T>, contact: &Contact<T>, side: Side) -> Option<(Nt<T>, Nt<T>)> {
    let (party, body, sign) = match side {
        Side::One => (&after.one, &contact.one, T::int(1)),
        Side::Two => (&after.two, &contact.two, T::int(-1)),
    };
    let Vehicle { mass, heading, .. } = party.vehicle()?.clone();
    let along = after.crush_plane.to_contact(heading.ahead());
    let across = along.clone().quarter_turn();
    let fixed = across.clone() * (body.velocity.clone().dot(across) * mass * sign);
    Some((fixed, along))
}

/// Returns the collision before an impulse on vehicle 1.
fn before<T: Real>(after: &Collision<T>, contact: &Contact<T>, impulse: Nt<T>) -> Collision<T> {
    let of = |party: &Party<T>, body: &Body<T>, impulse: Nt<T>| match party {
        Party::Barrier => Party::Barrier,
        Party::Vehicle(vehicle) => {
            let mut vehicle = vehicle.clone();
            vehicle.motion.velocity -= after.crush_plane.to_ground(body.delta_v(impulse.clone()));
            vehicle.motion.yaw_rate = vehicle.motion.yaw_rate - body.delta_yaw_rate(impulse);
            Party::Vehicle(vehicle)
        }
    };
    let approach = contact.approach.clone() + contact.compliance.velocity_change(impulse.clone());
    Collision {
        one: of(&after.one, &contact.one, impulse.clone()),
        two: of(&after.two, &contact.two, -impulse.clone()),
        crush_plane: after.crush_plane.clone(),
        restitution: T::int(0) - contact.approach.n.clone() / approach.n,
        impulse_ratio: ImpulseRatio::Given(impulse.t / impulse.n),
        law: Law::Brach,
        moment: Moment::None,
    }
}
