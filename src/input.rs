//! Inputs of a collision, identified by name.
//!
//! A name is the path of the input in a case file, with vehicles 1 and 2 as in the paper. The paper's own symbol is an alias.

use crate::catalogue::catalogue;
use crate::collision::Collision;
use crate::frame::{CrushPlane, ForwardLeft, Heading, Xy};
use crate::law::ImpulseRatio;
use crate::measure::Measure;
use crate::moment::Moment;
use crate::scalar::Real;
use crate::vehicle::{Motion, Party, Vehicle};

/// One of the two parties.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Side {
    /// Vehicle 1, on which the impulse acts.
    One,
    /// Vehicle 2, on which the opposite impulse acts.
    Two,
}

impl Side {
    /// Both, vehicle 1 first.
    pub const ALL: [Side; 2] = [Side::One, Side::Two];

    /// Returns the other one.
    #[must_use]
    pub const fn other(self) -> Side {
        match self {
            Side::One => Side::Two,
            Side::Two => Side::One,
        }
    }
}

catalogue! {
    /// An input of a collision.
    ///
    /// ```
    /// use planar_impact::{Input, Side};
    /// assert_eq!(Input::CrushPlane.name(), "contact.crush_plane");
    /// assert_eq!(Input::named("omega1"), Some(Input::YawRate(Side::One)));
    /// assert_eq!(Input::named("vehicle.2.velocity.x"), Some(Input::VelocityX(Side::Two)));
    /// ```
    pub enum Input after "" with symbols,
    /// Returns its measure.
    measure: Measure {
        of each vehicle {
            /// Mass m in kg.
            Mass = "vehicle." _ ".mass", "m" _, Mass;
            /// Yaw inertia I in kg m².
            YawInertia = "vehicle." _ ".yaw_inertia", "I" _, YawInertia;
            /// Heading θ in rad. A change of it does not change the velocity.
            Heading = "vehicle." _ ".heading", "theta" _, Angle;
            /// Impact center ahead of the center of mass, in m.
            ImpactCenterForward = "vehicle." _ ".impact_center.forward", "f" _, Length;
            /// Impact center to the left of the center of mass, in m.
            ImpactCenterLeft = "vehicle." _ ".impact_center.left", "l" _, Length;
            /// Velocity along x before the impact, in m/s.
            VelocityX = "vehicle." _ ".velocity.x", "v" _ "x", Speed;
            /// Velocity along y before the impact, in m/s.
            VelocityY = "vehicle." _ ".velocity.y", "v" _ "y", Speed;
            /// Yaw rate ω before the impact, in rad/s.
            YawRate = "vehicle." _ ".yaw_rate", "omega" _, YawRate;
        }
        of the pair {
            /// Angle Γ of the crush plane in rad.
            CrushPlane = "contact.crush_plane", "Gamma", Angle;
            /// Coefficient of restitution e.
            Restitution = "contact.restitution", "e", Ratio;
            /// The number that specifies the impulse ratio: μ, its fraction of the critical ratio, or the friction. Absent at the critical ratio.
            ImpulseRatio = "contact.impulse_ratio", "mu", Ratio;
            /// The number that specifies the moment impulse, in N m s, or its fraction of the critical one. Absent without a moment.
            Moment = "contact.moment", "M", MomentImpulse;
        }
    }
}

impl Input {
    /// Returns the input with a name or a symbol.
    pub fn named(name: &str) -> Option<Input> {
        Input::of_name(name)
    }
}

/// An input that a collision does not have: a barrier has no mass, and the critical ratio is not given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct NoSuchInput(pub Input);

impl core::fmt::Display for NoSuchInput {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(f, "this collision has no {}: its party is a barrier, or its contact does not give it", self.0)
    }
}

impl core::error::Error for NoSuchInput {}

impl<T: Real> Collision<T> {
    /// Returns the value of an input, an angle in (−π, π], or `None` if this collision does not have it: a barrier has no mass, and the critical ratio is not
    /// given.
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

    /// Sets an input, an angle in rad.
    ///
    /// ```
    /// use planar_impact::{Collision, Input, Party, Side, Vehicle};
    /// let mut collision = Collision::new(Vehicle::new(1200.0, 1900.0), Party::Barrier);
    /// collision.set(Input::VelocityX(Side::One), 15.0)?;
    /// assert_eq!(collision.input(Input::VelocityX(Side::One)), Some(15.0));
    /// assert!(collision.set(Input::Mass(Side::Two), 900.0).is_err());
    /// # Ok::<(), planar_impact::NoSuchInput>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`NoSuchInput`] if this collision does not have it, as in [`Collision::input`]. The value itself is checked by [`Collision::solve`].
    pub fn set(&mut self, input: Input, value: T) -> Result<(), NoSuchInput> {
        let missing = Err(NoSuchInput(input));
        match (input, &mut self.impulse_ratio, &mut self.moment) {
            (Input::CrushPlane, ..) => self.crush_plane = CrushPlane::from_angle(value),
            (Input::Restitution, ..) => self.restitution = value,
            (Input::ImpulseRatio, ImpulseRatio::Critical, _) | (Input::Moment, _, Moment::None) => return missing,
            (Input::ImpulseRatio, ImpulseRatio::Given(x) | ImpulseRatio::OfCritical(x) | ImpulseRatio::LimitedByFriction(x), _)
            | (Input::Moment, _, Moment::Given(x) | Moment::OfCritical(x)) => *x = value,
            _ => {
                let party = if input.side() == Some(Side::One) { &mut self.one } else { &mut self.two };
                let Party::Vehicle(vehicle) = party else { return missing };
                match input {
                    Input::Heading(_) => vehicle.heading = Heading::from_angle(value),
                    Input::Mass(_) => vehicle.mass = value,
                    Input::YawInertia(_) => vehicle.yaw_inertia = value,
                    Input::ImpactCenterForward(_) => vehicle.impact_center.forward = value,
                    Input::ImpactCenterLeft(_) => vehicle.impact_center.left = value,
                    Input::VelocityX(_) => vehicle.motion.velocity.x = value,
                    Input::VelocityY(_) => vehicle.motion.velocity.y = value,
                    _ => vehicle.motion.yaw_rate = value,
                }
            }
        }
        Ok(())
    }

    /// Returns all inputs in the order of [`Input::ALL`], angles in (−π, π]. Those that this collision does not have are zero.
    ///
    /// ```
    /// use planar_impact::{Collision, Input, Party, Side, Vehicle};
    /// let collision = Collision::new(Vehicle::new(1200.0, 1900.0).with_speed(15.0), Party::Barrier);
    /// let mut inputs = collision.to_inputs();
    /// inputs[Input::Mass(Side::One).index()] += 100.0;
    /// assert_eq!(collision.with_inputs(inputs).input(Input::Mass(Side::One)), Some(1300.0));
    /// ```
    pub fn to_inputs(&self) -> [T; Input::COUNT] {
        Input::ALL.map(|input| self.input(input).unwrap_or_else(|| T::int(0)))
    }

    /// Returns the same collision with all inputs replaced, in the order of [`Input::ALL`]. Values of inputs that this collision does not have are ignored.
    #[must_use]
    pub fn with_inputs(self, inputs: [T; Input::COUNT]) -> Self {
        let of = |input: Input| inputs[input.index()].clone();
        let heading = |side| Heading::from_angle(of(Input::Heading(side)));
        self.given(Side::ALL.map(heading), CrushPlane::from_angle(of(Input::CrushPlane)), of)
    }

    /// Returns the same collision with all inputs replaced, the directions by themselves and the others by a function of their name.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn given(self, headings: [Heading<T>; 2], crush_plane: CrushPlane<T>, of: impl Fn(Input) -> T) -> Self {
        let party = |party: Party<T>, side, heading| match party {
            Party::Barrier => Party::Barrier,
            Party::Vehicle(_) => Party::Vehicle(Vehicle {
                mass: of(Input::Mass(side)),
                yaw_inertia: of(Input::YawInertia(side)),
                heading,
                impact_center: ForwardLeft { forward: of(Input::ImpactCenterForward(side)), left: of(Input::ImpactCenterLeft(side)) },
                motion: Motion {
                    velocity: Xy { x: of(Input::VelocityX(side)), y: of(Input::VelocityY(side)) },
                    yaw_rate: of(Input::YawRate(side)),
                },
            }),
        };
        let [one, two] = headings;
        Collision {
            one: party(self.one, Side::One, one),
            two: party(self.two, Side::Two, two),
            crush_plane,
            restitution: of(Input::Restitution),
            impulse_ratio: self.impulse_ratio.map(|_| of(Input::ImpulseRatio)),
            law: self.law,
            moment: self.moment.map(|_| of(Input::Moment)),
        }
    }

    /// Creates a collision of two vehicles from all inputs, in the order of [`Input::ALL`]: the impulse ratio and the moment are given numbers, and the law is
    /// the paper's.
    #[must_use]
    pub fn from_inputs(inputs: [T; Input::COUNT]) -> Self {
        Collision::new(Vehicle::default(), Vehicle::default())
            .with_impulse_ratio(ImpulseRatio::Given(T::int(0)))
            .with_moment(Moment::Given(T::int(0)))
            .with_inputs(inputs)
    }

    /// Returns the same collision with an increment added to each input. Increments of inputs that this collision does not have are ignored.
    ///
    /// If the increment is an infinitesimal dual number, everything computed from the collision carries its derivative by that input:
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
            crush_plane: crush_plane.shifted(by(Input::CrushPlane)),
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
    *heading = heading.clone().shifted(by(Input::Heading(side)));
    Party::Vehicle(vehicle)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::law::Law;
    use alloc::string::ToString;

    #[test]
    fn every_input_has_its_place_and_its_names() {
        for (i, input) in Input::ALL.into_iter().enumerate() {
            assert_eq!(input.index(), i);
            assert_eq!(Input::named(input.name()), Some(input));
            assert_eq!(Input::named(input.symbol()), Some(input));
        }
        assert_eq!(Input::named("vehicle.3.mass"), None);
        assert_eq!("omega2".parse(), Ok(Input::YawRate(Side::Two)));
        let unknown = "vehicle.3.mass".parse::<Input>().expect_err("there are two");
        assert_eq!(unknown.to_string(), "no quantity is named \"vehicle.3.mass\"; `ALL` lists those that exist");
        assert_eq!(Side::ALL.map(Side::other), [Side::Two, Side::One]);
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
        let inputs = collision.to_inputs();
        assert_eq!(Collision { impulse_ratio: ImpulseRatio::OfCritical(0.5), ..Collision::from_inputs(inputs) }.to_inputs(), inputs);
        for input in Input::ALL {
            let before = collision.input(input).expect("it has every input");
            let mut set = collision;
            assert_eq!(set.set(input, before + 0.125), Ok(()));
            for other in Input::ALL {
                let expected = collision.input(other).expect("as before") + if other == input { 0.125 } else { 0.0 };
                assert!((set.input(other).expect("as before") - expected).abs() < 1e-15, "{other} with {input}");
            }
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
        for input in [Input::Mass(Side::One), Input::Heading(Side::Two), Input::ImpulseRatio, Input::Moment] {
            assert_eq!(collision.clone().set(input, 1.0), Err(NoSuchInput(input)));
        }
        assert_eq!(collision.with_inputs([1.0; Input::COUNT]).one, Party::Barrier);
        assert_eq!(collision.shifted(|_| 1.0).one, Party::Barrier);
    }
}
