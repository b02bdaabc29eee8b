//! Exact derivatives of every output by every input, by name.
//!
//! ```
//! use planar_impact::*;
//! # use std::f64::consts::{FRAC_PI_2, PI};
//! # let sedan: Vehicle = Vehicle {
//! #     mass: 2564.0 / 32.2, yaw_inertia: 1434.9, heading: Heading::from_angle(PI), impact_center: ForwardLeft { forward: 6.3499, left: 0.0 },
//! #     motion: Motion { velocity: Xy { x: -40.0, y: 0.0 }, yaw_rate: 0.0 },
//! # };
//! # let pickup = Vehicle {
//! #     mass: 6345.0 / 32.2, yaw_inertia: 5192.4, heading: Heading::from_angle(FRAC_PI_2), impact_center: ForwardLeft { forward: 7.96804, left: -3.2356 },
//! #     motion: Motion { velocity: Xy { x: 0.0, y: 40.0 }, yaw_rate: 0.0 },
//! # };
//! # let collision = Collision {
//! #     one: sedan.into(), two: pickup.into(), crush_plane: CrushPlane::from_angle(0.0), restitution: 0.0,
//! #     impulse_ratio: ImpulseRatio::Critical, law: Law::Brach, moment: Moment::None,
//! # };
//! // Position A of the paper, in feet and slugs.
//! let outputs = collision.sensitivities()?;
//! assert_eq!(format!("{:.1}", outputs.work.n.value), "-30097.2");
//! // ft lb a degree: Table 2 has −29221.9 at −1° and −30966.2 at 1°.
//! assert_eq!(format!("{:.1}", outputs.work.n.by[Input::CrushPlane].to_radians()), "-872.3");
//! // At μ = μ₀ the derivative is that of the critical solution: μ₀ changes with its arguments.
//! assert_eq!(format!("{:.3}", outputs.critical_impulse_ratio.by[Input::Restitution]), "-0.504");
//! # Ok::<(), Refusals>(())
//! ```
//!
//! | derivatives | function | cost relative to one solution |
//! |---|---|---|
//! | all outputs by all inputs | [`Collision::sensitivities`], [`Collision::sensitivities_to`] | 3½, 2½ |
//! | one output by all inputs | [`Collision::sensitivity`] | 1½ to 2 of that output alone |
//! | one output twice by all inputs | [`Collision::curvature`] | 5 to 6 |
//! | a weighted sum of outputs by all inputs | [`Collision::pullback`] | 1½ to 2 |
//! | all outputs along one direction of the inputs | [`Collision::pushforward`] | 3½ |
//! | any quantity by any other | [`Collision::shifted`] on a dual number | 2½ for each input |
//!
//! # What is held constant
//!
//! A derivative by one input holds all the others of [`Input::ALL`] constant. The derivative by a heading rotates the vehicle, not its velocity; the
//! derivative by a mass leaves the yaw inertia as it is.
//!
//! # Method
//!
//! Dual numbers through the one solution are the definition ([`by_definition`], [`curvature_by_definition`]), and the method if there is a moment impulse. The
//! fast method differentiates the equation of the impulse instead, K P = change: every input acts on the impulse only through the two components of that
//! equation. Given the derivative of the output by each component of the impulse, one solution with K gives the adjoint λ of the two equations, and the rest is
//! the derivative of one scalar with the impulse held constant,
//!
//! ```text
//! α·v − λ·K P,    v the approach velocity,  λ·K P = Σ λ·P/m + (r×λ)(r×P)/I
//! ```
//!
//! first by each input, then, for the curvature, by each pair. `proptests/derivatives.rs` compares both with the definition. No memory is allocated.

mod body_partials;
mod cotangent;
#[cfg(feature = "alloc")]
mod covariance;
mod definition;
pub(crate) mod dual;
mod hessian;
mod impulse_adjoint;
mod jacobian;
#[cfg(feature = "nalgebra")]
mod matrix;
#[cfg(feature = "batch")]
mod one_by_one;

#[cfg(feature = "alloc")]
pub use covariance::{Covariance, NotACovariance};
pub use definition::{by_definition, curvature_by_definition};
#[cfg(feature = "batch")]
pub(crate) use one_by_one::Gradients;

use crate::collision::Collision;
use crate::impact::Impact;
use crate::input::Input;
use crate::law::ImpulseRatio;
use crate::moment::Moment;
use crate::output::{Output, Outputs};
use crate::refusal::{Refusal, Refusals};
use crate::scalar::{Logic, Real, is_finite, is_single, is_zero};
use crate::vehicle::{Motion, Party, Vehicle};
use core::ops::{Index, IndexMut};

/// The derivatives of one number by each [`Input`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
// Two floats are stored at a time; across a cache line that takes twice as long.
#[repr(align(16))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Gradient<T = f64>(pub(crate) [T; Input::COUNT]);

/// The second derivatives of one number by each pair of [`Input`]s, symmetric.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Hessian<T = f64>(pub(crate) [[T; Input::COUNT]; Input::COUNT]);

/// A number and its derivatives, in SI units and radians.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Sensitive<T = f64> {
    /// The number.
    pub value: T,
    /// Its derivatives.
    pub by: Gradient<T>,
}

/// A number, its derivatives and its second derivatives, in SI units and radians.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Curved<T = f64> {
    /// The number.
    pub value: T,
    /// Its derivatives.
    pub by: Gradient<T>,
    /// Its second derivatives.
    pub twice: Hessian<T>,
}

impl<T> Gradient<T> {
    /// Returns each input and the derivative by it, in the order of [`Input::ALL`].
    pub fn iter(&self) -> impl Iterator<Item = (Input, &T)> {
        Input::ALL.into_iter().zip(&self.0)
    }

    /// Returns the derivatives in the order of [`Input::ALL`].
    pub fn as_array(&self) -> &[T; Input::COUNT] {
        &self.0
    }
}

impl<T> From<[T; Input::COUNT]> for Gradient<T> {
    /// From the derivatives in the order of [`Input::ALL`].
    fn from(by: [T; Input::COUNT]) -> Self {
        Gradient(by)
    }
}

impl<T: Real<Mask = bool>> Gradient<T> {
    fn is_finite(&self) -> bool {
        self.0.iter().all(is_finite)
    }
}

impl<T> Hessian<T> {
    /// Returns the second derivatives, rows and columns in the order of [`Input::ALL`].
    pub fn as_rows(&self) -> &[[T; Input::COUNT]; Input::COUNT] {
        &self.0
    }
}

impl<T> Index<Input> for Gradient<T> {
    type Output = T;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn index(&self, input: Input) -> &T {
        &self.0[input.index()]
    }
}

impl<T> IndexMut<Input> for Gradient<T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn index_mut(&mut self, input: Input) -> &mut T {
        &mut self.0[input.index()]
    }
}

impl<T> Index<(Input, Input)> for Hessian<T> {
    type Output = T;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn index(&self, (one, other): (Input, Input)) -> &T {
        &self.0[one.index()][other.index()]
    }
}

impl<T: Real<Mask: Logic> + Copy + Default> Collision<T> {
    /// Computes the sensitivities of an impact that [`Collision::solve`] or [`Collision::evaluate`] returned for this collision. The impact is not checked; a
    /// quantity without a derivative, such as the ΔV of a zero impulse, has derivatives of NaN. In lanes, of each collision.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn sensitivities_of(&self, impact: &Impact<T>) -> Outputs<Sensitive<T>> {
        let mut to = Outputs::default();
        self.write_sensitivities_of(impact, &mut to);
        to
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn write_sensitivities_of(&self, impact: &Impact<T>, to: &mut Outputs<Sensitive<T>>) {
        match self.moment {
            Moment::None => jacobian::write(self, &self.contact(), impact, to),
            _ => *to = by_definition(self),
        }
    }

    /// Gives the derivatives of some outputs of a given impact by every input, one output after the other, as [`Collision::sensitivities_of`].
    #[cfg(feature = "batch")]
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn give_gradients_of(&self, impact: &Impact<T>, of: &[Output], to: &mut impl Gradients<T>) {
        match self.moment {
            Moment::None => one_by_one::give(self, &self.contact(), impact, of, to),
            _ => {
                let table = by_definition(self);
                of.iter().for_each(|of| to.take(&table[*of].by));
            }
        }
    }

    /// Computes the derivatives by every input of a weighted sum of outputs of a given impact, as [`Collision::sensitivities_of`].
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn pullback_of(&self, impact: &Impact<T>, weights: impl Iterator<Item = (Output, T)>) -> Gradient<T> {
        match self.moment {
            Moment::None => cotangent::pullback(self, &self.contact(), impact, weights),
            _ => {
                let rows = by_definition(self);
                weights.fold(Gradient::zero(), |mut sum, (of, weight)| {
                    sum.add_scaled(weight, &rows[of].by);
                    sum
                })
            }
        }
    }

    /// Computes the derivatives of every output along a direction of the inputs, of a collision that is not checked.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn pushforward_of(&self, direction: &[T; Input::COUNT]) -> Outputs<T> {
        definition::along(self, |input| direction[input.index()]).map(|dual| dual.derivative)
    }

    /// Computes the sensitivity of one output of a given impact, as [`Collision::sensitivities_of`].
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn sensitivity_of(&self, impact: &Impact<T>, of: Output) -> Sensitive<T> {
        match self.moment {
            Moment::None => cotangent::sensitivity(self, &self.contact(), impact, of),
            _ => by_definition(self)[of],
        }
    }
}

impl<T: Real<Mask = bool> + Copy + Default> Collision<T> {
    /// Computes every output with its derivatives by every input.
    ///
    /// # Errors
    ///
    /// [`Refusals`] of [`Collision::solve`], and [`Refusal::OutOfFloatRange`] if a derivative is not finite.
    pub fn sensitivities(&self) -> Result<Outputs<Sensitive<T>>, Refusals<T>> {
        // The table is written where it is returned: moving it would cost as much as computing it.
        let mut result = Ok(Outputs::default());
        if let Ok(to) = &mut result
            && let Err(refusals) = self.sensitivities_to(to)
        {
            result = Err(refusals);
        }
        result
    }

    /// Computes the same as [`Self::sensitivities`], written to `to`. A refused collision leaves it as it was; a derivative that is not finite leaves zeros.
    ///
    /// The table has 5.4 kB. Returning it moves it, which costs half as much as computing it; if that matters, keep one table and write to it.
    ///
    /// # Errors
    ///
    /// [`Refusals`] of [`Collision::solve`], and [`Refusal::OutOfFloatRange`] if a derivative is not finite.
    pub fn sensitivities_to(&self, to: &mut Outputs<Sensitive<T>>) -> Result<(), Refusals<T>> {
        let contact = self.checked_contact()?;
        let impact = self.solve_at(&contact)?;
        match self.moment {
            Moment::None => jacobian::write(self, &contact, &impact, to),
            _ => *to = by_definition(self),
        }
        // What is refused must not be left in the table of the caller.
        self.within_floats(|| Output::ALL.into_iter().all(|output| is_finite(&to[output].value) && to[output].by.is_finite()))
            .inspect_err(|_| *to = Outputs::default())
    }

    /// Refuses derivatives that are not finite, although the outputs are. Only numbers far from those of vehicles have such derivatives: others are not
    /// searched for them.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn within_floats(&self, is_finite: impl FnOnce() -> bool) -> Result<(), Refusals<T>> {
        if self.is_moderate() || is_finite() { Ok(()) } else { Err(Refusal::OutOfFloatRange.into()) }
    }

    /// Returns `true` if each number is zero or within 10⁻¹⁵ to 10¹⁵ in SI: products of a dozen of them are finite, except as f32.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn is_moderate(&self) -> bool {
        let greatest = T::int(100_000) * T::int(100_000) * T::int(100_000);
        let least = greatest.inv();
        let is_moderate = |x: T| is_zero(&x) || !(x.magnitude().less(&least) || greatest.less(&x.magnitude()));
        let of_party = |party: &Party<T>| {
            party.vehicle().is_none_or(|vehicle| {
                let Vehicle { mass, yaw_inertia, impact_center, motion: Motion { velocity, yaw_rate }, .. } = *vehicle;
                [mass, yaw_inertia, impact_center.forward, impact_center.left, velocity.x, velocity.y, yaw_rate]
                    .into_iter()
                    .all(is_moderate)
            })
        };
        let moment = match self.moment {
            Moment::None => T::int(0),
            Moment::Given(moment) | Moment::OfCritical(moment) => moment,
        };
        let ratio = match self.impulse_ratio {
            ImpulseRatio::Critical => T::int(0),
            ImpulseRatio::Given(ratio) | ImpulseRatio::OfCritical(ratio) | ImpulseRatio::LimitedByFriction(ratio) => ratio,
        };
        !is_single::<T>() && of_party(&self.one) && of_party(&self.two) && is_moderate(moment) && is_moderate(ratio)
    }

    /// Computes one output with its derivatives by every input, at less than the cost of all.
    ///
    /// # Errors
    ///
    /// [`Refusals`] of [`Collision::solve`], and [`Refusal::OutOfFloatRange`] if a derivative is not finite.
    #[inline]
    pub fn sensitivity(&self, of: Output) -> Result<Sensitive<T>, Refusals<T>> {
        let contact = self.checked_contact()?;
        let impact = self.solve_at(&contact)?;
        let sensitive = match self.moment {
            Moment::None => cotangent::sensitivity(self, &contact, &impact, of),
            _ => by_definition(self)[of],
        };
        self.within_floats(|| is_finite(&sensitive.value) && sensitive.by.is_finite())?;
        Ok(sensitive)
    }

    /// Computes the derivatives by every input of the sum of all outputs, each times its weight: the product of a row vector with the Jacobian. For an
    /// objective of several outputs it costs little more than the sensitivity of one.
    ///
    /// ```
    /// use planar_impact::{Collision, Input, Outputs, Party, Side, Vehicle};
    /// let car = Vehicle::new(1200.0, 1900.0).with_impact_center(1.8, 0.3).with_speed(15.0);
    /// let collision = Collision::new(car, Party::Barrier).with_restitution(0.1);
    /// // J = T_L + 100 ΔV, in J and m/s.
    /// let mut weights = Outputs::default();
    /// (weights.loss, weights.one.delta_v_magnitude) = (1.0, 100.0);
    /// let by = collision.pullback(&weights)?;
    /// assert!(by[Input::VelocityX(Side::One)] > 0.0);
    /// # Ok::<(), planar_impact::Refusals>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`Refusals`] of [`Collision::solve`], and [`Refusal::OutOfFloatRange`] if a derivative is not finite.
    #[inline]
    pub fn pullback(&self, weights: &Outputs<T>) -> Result<Gradient<T>, Refusals<T>> {
        let impact = self.solve()?;
        // An output without a derivative does not matter unless it is weighted.
        let weighted = Output::ALL.into_iter().map(|of| (of, weights[of])).filter(|(_, weight)| !is_zero(weight));
        let gradient = self.pullback_of(&impact, weighted);
        // Weights may be of any size, and one that is not a number must not count as zero.
        if gradient.is_finite() && Output::ALL.into_iter().all(|of| is_finite(&weights[of])) {
            Ok(gradient)
        } else {
            Err(Refusal::OutOfFloatRange.into())
        }
    }

    /// Computes the derivatives of every output along a direction of the inputs, in the order of [`Input::ALL`]: the product of the Jacobian with a column
    /// vector.
    ///
    /// # Errors
    ///
    /// [`Refusals`] of [`Collision::solve`], and [`Refusal::OutOfFloatRange`] if a derivative is not finite.
    pub fn pushforward(&self, direction: &[T; Input::COUNT]) -> Result<Outputs<T>, Refusals<T>> {
        self.solve()?;
        let along = self.pushforward_of(direction);
        if Output::ALL.into_iter().all(|of| is_finite(&along[of])) { Ok(along) } else { Err(Refusal::OutOfFloatRange.into()) }
    }

    /// Computes one output with its first and second derivatives by every input.
    ///
    /// # Errors
    ///
    /// [`Refusals`] of [`Collision::solve`], and [`Refusal::OutOfFloatRange`] if a derivative is not finite.
    pub fn curvature(&self, of: Output) -> Result<Curved<T>, Refusals<T>> {
        let curved = self.curvature_of(&self.solve()?, of);
        self.within_floats(|| is_finite(&curved.value) && curved.by.is_finite() && curved.twice.0.iter().flatten().all(is_finite))?;
        Ok(curved)
    }

    /// Computes the curvature of one output of a given impact, as [`Collision::sensitivities_of`].
    pub fn curvature_of(&self, impact: &Impact<T>, of: Output) -> Curved<T> {
        match self.moment {
            Moment::None => hessian::curvature(self, impact, of),
            _ => curvature_by_definition(self, of),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input::Input;

    /// One number that is large or small is enough, and zero is neither.
    #[test]
    fn every_number_of_a_moderate_collision_is_moderate() {
        let vehicle = Vehicle::new(1500.0, 2500.0).with_impact_center(2.0, 0.3).with_speed(15.0);
        let collision =
            Collision { impulse_ratio: ImpulseRatio::Given(0.1), moment: Moment::Given(20.0), ..Collision::new(vehicle, vehicle) };
        assert!(collision.is_moderate());
        let angles = |input: &Input| matches!(input, Input::Heading(_) | Input::CrushPlane | Input::Restitution);
        for input in Input::ALL.into_iter().filter(|input| !angles(input)) {
            for (size, is_moderate) in [(1e16, false), (-1e16, false), (1e-16, false), (1e14, true), (-1e-14, true), (0.0, true)] {
                let mut changed = collision;
                changed.set(input, size).expect("an input of the collision");
                assert_eq!(changed.is_moderate(), is_moderate, "{input} {size}");
            }
        }
    }
}
