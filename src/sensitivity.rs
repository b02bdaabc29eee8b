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
//! // At μ = μ₀ the derivative is that of the critical solution: μ₀ moves with its arguments.
//! assert_eq!(format!("{:.3}", outputs.critical_impulse_ratio.by[Input::Restitution]), "-0.504");
//! # Ok::<(), Refusals>(())
//! ```
//!
//! | what | how | cost beside one solution |
//! |---|---|---|
//! | all outputs by all inputs | [`Collision::sensitivities`], [`Collision::sensitivities_to`] | 3½, 2½ |
//! | one output by all inputs | [`Collision::sensitivity`] | 1½ to 2 of that output alone |
//! | one output twice by all inputs | [`Collision::curvature`] | 5 to 6 |
//! | anything by anything | [`Collision::shifted`] on a dual number | 2½ for each input |
//!
//! # What is held
//!
//! A derivative by one input holds all the others of [`Input::ALL`]. By a heading, the vehicle turns and its velocity stays; by a mass, the yaw inertia stays.
//!
//! # How it is done, and why it is right
//!
//! Dual numbers through the one solution are the definition ([`by_definition`], [`curvature_by_definition`]). The fast way differentiates the equation of the impulse
//! instead, K P = change: everything that an input does to the impulse it does through the two components of that equation, the narrow waist of the
//! mechanics. Given what the output is worth of each component of the impulse, one solution with K gives the worth λ of the two equations, and
//! the rest is the derivative of one scalar with the impulse held,
//!
//! ```text
//! α·v − λ·K P,    v the approach velocity,  λ·K P = Σ λ·P/m + (r×λ)(r×P)/I
//! ```
//!
//! first by each input, then, for the curvature, by each pair. `proptests/derivatives.rs` holds both to the definition. No memory is allocated on the way.

mod bend;
mod definition;
mod jacobian;
mod lever;
#[cfg(feature = "nalgebra")]
mod matrix;
mod waist;
mod worth;

pub use definition::{by_definition, curvature_by_definition};

use crate::collision::Collision;
use crate::impact::Impact;
use crate::input::Input;
use crate::moment::Moment;
use crate::output::{Output, Outputs};
use crate::refusal::Refusals;
use core::ops::{Index, IndexMut};

/// The derivatives of one number by each [`Input`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
// Two floats are stored at a time; across a cache line that takes twice as long.
#[repr(align(16))]
pub struct Gradient<T = f64>(pub(crate) [T; Input::COUNT]);

/// The second derivatives of one number by each pair of [`Input`]s, symmetric.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hessian<T = f64>(pub(crate) [[T; Input::COUNT]; Input::COUNT]);

/// A number and its derivatives, in SI units and radians.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sensitive<T = f64> {
    /// The number.
    pub value: T,
    /// Its derivatives.
    pub by: Gradient<T>,
}

/// A number, its derivatives and its second derivatives, in SI units and radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Curved<T = f64> {
    /// The number.
    pub value: T,
    /// Its derivatives.
    pub by: Gradient<T>,
    /// Its second derivatives.
    pub twice: Hessian<T>,
}

impl<T> Gradient<T> {
    /// Each input and the derivative by it, in the order of [`Input::ALL`].
    pub fn iter(&self) -> impl Iterator<Item = (Input, &T)> {
        Input::ALL.into_iter().zip(&self.0)
    }

    /// The derivatives in the order of [`Input::ALL`].
    pub fn as_array(&self) -> &[T; Input::COUNT] {
        &self.0
    }
}

impl<T> Hessian<T> {
    /// The second derivatives, rows and columns in the order of [`Input::ALL`].
    pub fn as_rows(&self) -> &[[T; Input::COUNT]; Input::COUNT] {
        &self.0
    }
}

impl<T> Index<Input> for Gradient<T> {
    type Output = T;

    #[inline(always)]
    fn index(&self, input: Input) -> &T {
        &self.0[input.index()]
    }
}

impl<T> IndexMut<Input> for Gradient<T> {
    #[inline(always)]
    fn index_mut(&mut self, input: Input) -> &mut T {
        &mut self.0[input.index()]
    }
}

impl<T> Index<(Input, Input)> for Hessian<T> {
    type Output = T;

    #[inline(always)]
    fn index(&self, (one, other): (Input, Input)) -> &T {
        &self.0[one.index()][other.index()]
    }
}

impl Collision<f64> {
    /// Every output with its derivatives by every input.
    ///
    /// # Errors
    ///
    /// [`Refusals`], exactly those of [`Collision::solve`].
    pub fn sensitivities(&self) -> Result<Outputs<Sensitive>, Refusals> {
        let mut to = Outputs::default();
        self.sensitivities_to(&mut to)?;
        Ok(to)
    }

    /// The same, written to where they are wanted. All of it is written; when the collision is refused, none.
    ///
    /// The table has 5.4 kB. Returning it moves it, which costs half as much as computing it; where that counts, keep one and write to it.
    ///
    /// # Errors
    ///
    /// [`Refusals`], exactly those of [`Collision::solve`].
    pub fn sensitivities_to(&self, to: &mut Outputs<Sensitive>) -> Result<(), Refusals> {
        let contact = self.checked_contact()?;
        let impact = self.solve_at(&contact)?;
        match self.moment {
            Moment::None => jacobian::write(self, &contact, &impact, to),
            _ => *to = by_definition(self),
        }
        Ok(())
    }

    /// One output with its derivatives by every input, at less than the cost of all.
    ///
    /// # Errors
    ///
    /// [`Refusals`], exactly those of [`Collision::solve`].
    #[inline]
    pub fn sensitivity(&self, of: Output) -> Result<Sensitive, Refusals> {
        let contact = self.checked_contact()?;
        let impact = self.solve_at(&contact)?;
        Ok(match self.moment {
            Moment::None => worth::sensitivity(self, &contact, &impact, of),
            _ => by_definition(self)[of],
        })
    }

    /// One output with its first and second derivatives by every input.
    ///
    /// # Errors
    ///
    /// [`Refusals`], exactly those of [`Collision::solve`].
    pub fn curvature(&self, of: Output) -> Result<Curved, Refusals> {
        self.solve().map(|impact| self.curvature_of(&impact, of))
    }

    /// The sensitivities of an impact that [`Collision::solve`] or [`Collision::evaluate`] gave for this collision. Nothing is asked of it; a quantity that
    /// has no derivative, as the ΔV of no impulse, has derivatives that are not numbers.
    #[inline(always)]
    pub fn sensitivities_of(&self, impact: &Impact) -> Outputs<Sensitive> {
        let mut to = Outputs::default();
        match self.moment {
            Moment::None => jacobian::write(self, &self.contact(), impact, &mut to),
            _ => to = by_definition(self),
        }
        to
    }

    /// The sensitivity of one output of an impact at hand, as [`Collision::sensitivities_of`].
    #[inline(always)]
    pub fn sensitivity_of(&self, impact: &Impact, of: Output) -> Sensitive {
        match self.moment {
            Moment::None => worth::sensitivity(self, &self.contact(), impact, of),
            _ => by_definition(self)[of],
        }
    }

    /// The curvature of one output of an impact at hand, as [`Collision::sensitivities_of`].
    pub fn curvature_of(&self, impact: &Impact, of: Output) -> Curved {
        match self.moment {
            Moment::None => bend::curvature(self, impact, of),
            _ => curvature_by_definition(self, of),
        }
    }
}
