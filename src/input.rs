//! The inputs of a collision, each by one name.
//!
//! A name is the path that a case file has for the input, with vehicles 1 and 2 as in the paper. The paper's own symbol is an alias.

use crate::collision::Collision;
use crate::law::ImpulseRatio;
use crate::moment::Moment;
use crate::scalar::Real;
use crate::vehicle::{Party, Vehicle};
use core::fmt;

/// One of the two that collide.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Side {
    /// Vehicle 1, on which the impulse acts.
    One,
    /// Vehicle 2, on which its opposite acts.
    Two,
}

/// An input of a collision.
///
/// ```
/// use planar_impact::{Input, Side};
/// assert_eq!(Input::CrushPlane.name(), "contact.crush_plane");
/// assert_eq!(Input::named("omega1"), Some(Input::YawRate(Side::One)));
/// assert_eq!(Input::named("vehicle.2.velocity.x"), Some(Input::VelocityX(Side::Two)));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Input {
    /// Mass m in kg.
    Mass(Side),
    /// Yaw inertia I in kg m².
    YawInertia(Side),
    /// Heading θ in rad. The velocity stays as it is.
    Heading(Side),
    /// Impact center ahead of the center of mass, in m.
    ImpactCenterForward(Side),
    /// Impact center to the left of the center of mass, in m.
    ImpactCenterLeft(Side),
    /// Velocity along x before the impact, in m/s.
    VelocityX(Side),
    /// Velocity along y before the impact, in m/s.
    VelocityY(Side),
    /// Yaw rate ω before the impact, in rad/s.
    YawRate(Side),
    /// Angle Γ of the crush plane in rad.
    CrushPlane,
    /// Coefficient of restitution e.
    Restitution,
    /// The number that the impulse ratio is given by: μ, its fraction of the critical ratio, or the friction. None at the critical ratio.
    ImpulseRatio,
    /// The number that the moment impulse is given by, in N m s, or its fraction of the critical one. None without a moment.
    Moment,
}

/// The name of each input and the paper's symbol for it, in the order of [`Input::ALL`].
const NAMES: [(&str, &str); Input::COUNT] = [
    ("vehicle.1.mass", "m1"),
    ("vehicle.1.yaw_inertia", "I1"),
    ("vehicle.1.heading", "theta1"),
    ("vehicle.1.impact_center.forward", "f1"),
    ("vehicle.1.impact_center.left", "l1"),
    ("vehicle.1.velocity.x", "v1x"),
    ("vehicle.1.velocity.y", "v1y"),
    ("vehicle.1.yaw_rate", "omega1"),
    ("vehicle.2.mass", "m2"),
    ("vehicle.2.yaw_inertia", "I2"),
    ("vehicle.2.heading", "theta2"),
    ("vehicle.2.impact_center.forward", "f2"),
    ("vehicle.2.impact_center.left", "l2"),
    ("vehicle.2.velocity.x", "v2x"),
    ("vehicle.2.velocity.y", "v2y"),
    ("vehicle.2.yaw_rate", "omega2"),
    ("contact.crush_plane", "Gamma"),
    ("contact.restitution", "e"),
    ("contact.impulse_ratio", "mu"),
    ("contact.moment", "M"),
];

impl Input {
    /// How many there are.
    pub const COUNT: usize = 20;

    /// Every input: those of vehicle 1, those of vehicle 2, those of the contact.
    pub const ALL: [Input; Input::COUNT] = {
        use Input::*;
        use Side::{One, Two};
        [
            Mass(One),
            YawInertia(One),
            Heading(One),
            ImpactCenterForward(One),
            ImpactCenterLeft(One),
            VelocityX(One),
            VelocityY(One),
            YawRate(One),
            Mass(Two),
            YawInertia(Two),
            Heading(Two),
            ImpactCenterForward(Two),
            ImpactCenterLeft(Two),
            VelocityX(Two),
            VelocityY(Two),
            YawRate(Two),
            CrushPlane,
            Restitution,
            ImpulseRatio,
            Moment,
        ]
    };

    /// The vehicle that it is of, if of one.
    pub fn side(self) -> Option<Side> {
        match self {
            Input::Mass(side)
            | Input::YawInertia(side)
            | Input::Heading(side)
            | Input::ImpactCenterForward(side)
            | Input::ImpactCenterLeft(side)
            | Input::VelocityX(side)
            | Input::VelocityY(side)
            | Input::YawRate(side) => Some(side),
            Input::CrushPlane | Input::Restitution | Input::ImpulseRatio | Input::Moment => None,
        }
    }

    /// Its place in [`Input::ALL`].
    #[inline(always)]
    pub const fn index(self) -> usize {
        let (at, side) = match self {
            Input::Mass(side) => (0, side),
            Input::YawInertia(side) => (1, side),
            Input::Heading(side) => (2, side),
            Input::ImpactCenterForward(side) => (3, side),
            Input::ImpactCenterLeft(side) => (4, side),
            Input::VelocityX(side) => (5, side),
            Input::VelocityY(side) => (6, side),
            Input::YawRate(side) => (7, side),
            Input::CrushPlane => return 16,
            Input::Restitution => return 17,
            Input::ImpulseRatio => return 18,
            Input::Moment => return 19,
        };
        at + 8 * (side as usize)
    }

    /// Its name, such as `vehicle.1.mass`.
    pub const fn name(self) -> &'static str {
        NAMES[self.index()].0
    }

    /// Its symbol, the paper's where it has one, such as `m1` or `Gamma`.
    pub const fn symbol(self) -> &'static str {
        NAMES[self.index()].1
    }

    /// The input of a name or a symbol.
    pub fn named(name: &str) -> Option<Input> {
        NAMES.iter().position(|&(path, symbol)| path == name || symbol == name).map(|at| Input::ALL[at])
    }
}

impl fmt::Display for Input {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl<T: Real> Collision<T> {
    /// The value of an input, an angle in (−π, π]. None if this collision does not have it: a barrier has no mass, and the critical ratio is not given.
    pub fn input(&self, input: Input) -> Option<T> {
        let vehicle = |side| match side {
            Side::One => self.one.vehicle(),
            Side::Two => self.two.vehicle(),
        };
        Some(match input {
            Input::Mass(side) => vehicle(side)?.mass.clone(),
            Input::YawInertia(side) => vehicle(side)?.yaw_inertia.clone(),
            Input::Heading(side) => vehicle(side)?.heading.clone().angle(),
            Input::ImpactCenterForward(side) => vehicle(side)?.impact_center.forward.clone(),
            Input::ImpactCenterLeft(side) => vehicle(side)?.impact_center.left.clone(),
            Input::VelocityX(side) => vehicle(side)?.motion.velocity.x.clone(),
            Input::VelocityY(side) => vehicle(side)?.motion.velocity.y.clone(),
            Input::YawRate(side) => vehicle(side)?.motion.yaw_rate.clone(),
            Input::CrushPlane => self.crush_plane.clone().angle(),
            Input::Restitution => self.restitution.clone(),
            Input::ImpulseRatio => match &self.impulse_ratio {
                ImpulseRatio::Critical => return None,
                ImpulseRatio::Given(x) | ImpulseRatio::OfCritical(x) | ImpulseRatio::LimitedByFriction(x) => x.clone(),
            },
            Input::Moment => match &self.moment {
                Moment::None => return None,
                Moment::Given(x) | Moment::OfCritical(x) => x.clone(),
            },
        })
    }

    /// The same collision with something added to each input. What is added to an input that this collision does not have is lost.
    ///
    /// With an infinitesimal of a dual number added, everything computed from the collision carries its derivative by that input:
    ///
    /// ```
    /// # #[cfg(feature = "dual")] {
    /// use num_dual::Dual64;
    /// use planar_impact::*;
    /// # let car: Vehicle = Vehicle {
    /// #     mass: 1500.0, yaw_inertia: 2500.0, heading: Heading::from_angle(0.0), impact_center: ForwardLeft { forward: 2.0, left: 0.5 },
    /// #     motion: Motion { velocity: Xy { x: 15.0, y: 0.0 }, yaw_rate: 0.0 },
    /// # };
    /// # let collision = Collision {
    /// #     one: car.into(), two: Party::Barrier, crush_plane: CrushPlane::from_angle(0.0), restitution: 0.1,
    /// #     impulse_ratio: ImpulseRatio::Critical, law: Law::Brach, moment: Moment::None,
    /// # };
    /// let seeded = collision.map(Dual64::from).shifted(|input| match input {
    ///     Input::VelocityX(Side::One) => Dual64::new(0.0, 1.0),
    ///     _ => Dual64::from(0.0),
    /// });
    /// // The separation velocity is −e times the approach velocity −15 m/s.
    /// assert!((seeded.evaluate().separation.n.eps - 0.1).abs() < 1e-12);
    /// # }
    /// ```
    #[must_use]
    pub fn shifted(self, mut by: impl FnMut(Input) -> T) -> Collision<T> {
        let Collision { one, two, crush_plane, restitution, impulse_ratio, law, moment } = self;
        let one = shifted_party(one, Side::One, &mut by);
        let two = shifted_party(two, Side::Two, &mut by);
        Collision {
            one,
            two,
            crush_plane: crush_plane.turned(by(Input::CrushPlane)),
            restitution: restitution + by(Input::Restitution),
            impulse_ratio: impulse_ratio.map(|x| x + by(Input::ImpulseRatio)),
            law,
            moment: moment.map(|x| x + by(Input::Moment)),
        }
    }
}

fn shifted_party<T: Real>(party: Party<T>, side: Side, by: &mut impl FnMut(Input) -> T) -> Party<T> {
    let Party::Vehicle(mut vehicle) = party else { return Party::Barrier };
    let Vehicle { mass, yaw_inertia, heading, impact_center, motion } = &mut vehicle;
    let mut add = |x: &mut T, input| *x = x.clone() + by(input);
    add(mass, Input::Mass(side));
    add(yaw_inertia, Input::YawInertia(side));
    add(&mut impact_center.forward, Input::ImpactCenterForward(side));
    add(&mut impact_center.left, Input::ImpactCenterLeft(side));
    add(&mut motion.velocity.x, Input::VelocityX(side));
    add(&mut motion.velocity.y, Input::VelocityY(side));
    add(&mut motion.yaw_rate, Input::YawRate(side));
    *heading = heading.clone().turned(by(Input::Heading(side)));
    Party::Vehicle(vehicle)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::{CrushPlane, ForwardLeft, Heading, Xy};
    use crate::law::Law;
    use crate::vehicle::Motion;

    #[test]
    fn every_input_has_its_place_and_its_names() {
        for (i, input) in Input::ALL.into_iter().enumerate() {
            assert_eq!(input.index(), i);
            assert_eq!(Input::named(input.name()), Some(input));
            assert_eq!(Input::named(input.symbol()), Some(input));
        }
        assert_eq!(Input::named("vehicle.3.mass"), None);
    }

    #[test]
    fn every_input_can_be_shifted_and_read_back() {
        let vehicle = Vehicle {
            mass: 1.0,
            yaw_inertia: 2.0,
            heading: Heading::from_angle(0.5),
            impact_center: ForwardLeft { forward: 1.0, left: -1.0 },
            motion: Motion { velocity: Xy { x: 3.0, y: 4.0 }, yaw_rate: 0.0 },
        };
        let collision: Collision = Collision {
            one: vehicle.into(),
            two: vehicle.into(),
            crush_plane: CrushPlane::from_angle(-0.5),
            restitution: 0.25,
            impulse_ratio: ImpulseRatio::OfCritical(0.5),
            law: Law::Brach,
            moment: Moment::Given(7.0),
        };
        for input in Input::ALL {
            let before = collision.input(input).expect("it has every input");
            let moved = collision.shifted(|other| if other == input { 0.125 } else { 0.0 });
            let after = moved.input(input).expect("as before");
            assert!((after - before - 0.125).abs() < 1e-15, "{input}");
            for other in Input::ALL.into_iter().filter(|&other| other != input) {
                assert_eq!(moved.input(other), collision.input(other), "{other} with {input}");
            }
        }
    }

    #[test]
    fn what_a_collision_does_not_have_is_none() {
        let collision = Collision {
            one: Party::<f64>::Barrier,
            two: Party::Barrier,
            crush_plane: CrushPlane::from_angle(0.0),
            restitution: 0.0,
            impulse_ratio: ImpulseRatio::Critical,
            law: Law::Brach,
            moment: Moment::None,
        };
        assert_eq!(collision.input(Input::Mass(Side::One)), None);
        assert_eq!(collision.input(Input::ImpulseRatio), None);
        assert_eq!(collision.input(Input::Moment), None);
        assert_eq!(collision.shifted(|_| 1.0).one, Party::Barrier);
    }
}
