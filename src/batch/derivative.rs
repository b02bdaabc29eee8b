//! Derivatives of every row.

use alloc::vec::Vec;

use super::{Batch, Columns, Refused};
use crate::collision::Collision;
use crate::impact::Impact;
use crate::input::Input;
use crate::output::Output;
use crate::scalar::{Logic, Real};
use crate::sensitivity::{Covariance, Gradient, Gradients};

/// A number of every row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Numbers<'a> {
    /// The same in every row.
    Same(f64),
    /// One of each row.
    Column(&'a [f64]),
}

impl Numbers<'_> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn at(&self, row: usize) -> f64 {
        match self {
            Numbers::Same(x) => *x,
            Numbers::Column(column) => column[row],
        }
    }
}

/// Outputs of every row, with what was asked of their derivatives.
#[derive(Clone, Debug, PartialEq)]
pub struct Derivatives<K> {
    /// The outputs; NaN in every row that is refused.
    pub values: Columns,
    /// The derivatives, or what follows from them; NaN in every row that is refused.
    pub derivatives: Columns<K>,
    /// The rows that are refused, in order: by [`Collision::solve`], or because a number that was asked for is not finite.
    pub refused: Vec<Refused>,
}

/// Numbers of a row that follow from its derivatives.
pub(super) trait Question {
    /// How many.
    fn numbers(&self) -> usize;

    /// The numbers of every row that it needs beside inputs.
    fn given(&self) -> &[Numbers<'_>] {
        &[]
    }

    /// Computes the numbers and puts them down, one after the other.
    fn answer<T: Scalar>(&self, collision: &Collision<T>, impact: &Impact<T>, given: &[T], to: &mut impl Answers<T>);
}

/// The scalars of a question: one row, and several.
pub(super) trait Scalar: Real<Mask: Logic> + Copy + Default + From<f64> {}

impl<T: Real<Mask: Logic> + Copy + Default + From<f64>> Scalar for T {}

/// The place of the numbers of an answer.
pub(super) trait Answers<T: Copy> {
    /// Puts down the next numbers, some of an array.
    fn put<const N: usize>(&mut self, numbers: &[T; N], places: &[usize]);
}

impl Answers<f64> for Vec<f64> {
    fn put<const N: usize>(&mut self, numbers: &[f64; N], places: &[usize]) {
        self.extend(places.iter().map(|place| numbers[*place]));
    }
}

/// No question.
pub(super) struct Nothing;

impl Question for Nothing {
    fn numbers(&self) -> usize {
        0
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn answer<T: Scalar>(&self, _: &Collision<T>, _: &Impact<T>, _: &[T], _: &mut impl Answers<T>) {}
}

/// What are the derivatives of some outputs by some inputs?
struct OfAll<'a> {
    of: &'a [Output],
    by: Vec<usize>,
}

impl Question for OfAll<'_> {
    fn numbers(&self) -> usize {
        self.of.len() * self.by.len()
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn answer<T: Scalar>(&self, collision: &Collision<T>, impact: &Impact<T>, _: &[T], to: &mut impl Answers<T>) {
        collision.give_gradients_of(impact, self.of, &mut Chosen { by: &self.by, to });
    }
}

/// Puts down the derivatives of each output by some inputs.
struct Chosen<'a, A> {
    by: &'a [usize],
    to: &'a mut A,
}

impl<T: Copy, A: Answers<T>> Gradients<T> for Chosen<'_, A> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn take(&mut self, gradient: &Gradient<T>) {
        self.to.put(&gradient.0, self.by);
    }
}

/// What are the derivatives of one output by some inputs?
struct OfOne {
    of: Output,
    by: Vec<usize>,
}

impl Question for OfOne {
    fn numbers(&self) -> usize {
        self.by.len()
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn answer<T: Scalar>(&self, collision: &Collision<T>, impact: &Impact<T>, _: &[T], to: &mut impl Answers<T>) {
        to.put(&collision.sensitivity_of(impact, self.of).by.0, &self.by);
    }
}

/// What are the derivatives of a weighted sum of outputs by some inputs?
struct OfSum<'a> {
    of: &'a [Output],
    weights: &'a [Numbers<'a>],
    by: Vec<usize>,
}

impl Question for OfSum<'_> {
    fn numbers(&self) -> usize {
        self.by.len()
    }

    fn given(&self) -> &[Numbers<'_>] {
        self.weights
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn answer<T: Scalar>(&self, collision: &Collision<T>, impact: &Impact<T>, given: &[T], to: &mut impl Answers<T>) {
        to.put(&collision.pullback_of(impact, self.of.iter().copied().zip(given.iter().copied())).0, &self.by);
    }
}

/// What are the derivatives of some outputs along a direction of the inputs?
struct Along<'a> {
    of: &'a [Output],
    inputs: &'a [Input],
    direction: &'a [Numbers<'a>],
}

impl Question for Along<'_> {
    fn numbers(&self) -> usize {
        self.of.len()
    }

    fn given(&self) -> &[Numbers<'_>] {
        self.direction
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn answer<T: Scalar>(&self, collision: &Collision<T>, _: &Impact<T>, given: &[T], to: &mut impl Answers<T>) {
        let mut direction = [T::int(0); Input::COUNT];
        for (input, along) in self.inputs.iter().zip(given) {
            direction[input.index()] = *along;
        }
        let outputs = collision.pushforward_of(&direction);
        for of in self.of {
            to.put(&[outputs[*of]], &[0]);
        }
    }
}

/// What are the variances of some outputs, given the covariance of the inputs?
struct Spread<'a> {
    of: &'a [Output],
    covariance: &'a Covariance,
}

impl Question for Spread<'_> {
    fn numbers(&self) -> usize {
        self.of.len()
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn answer<T: Scalar>(&self, collision: &Collision<T>, impact: &Impact<T>, _: &[T], to: &mut impl Answers<T>) {
        collision.give_gradients_of(impact, self.of, &mut Variances { covariance: self.covariance, to });
    }
}

/// Puts down the variance of each output.
struct Variances<'a, A> {
    covariance: &'a Covariance,
    to: &'a mut A,
}

impl<T: Scalar, A: Answers<T>> Gradients<T> for Variances<'_, A> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn take(&mut self, gradient: &Gradient<T>) {
        self.to.put(&[self.covariance.variance_in(gradient, T::from)], &[0]);
    }
}

/// Returns the places of inputs in a gradient, found once and not in every row.
fn places(by: &[Input]) -> Vec<usize> {
    by.iter().map(|input| input.index()).collect()
}

impl Batch<'_> {
    /// Computes outputs of every row with their derivatives by inputs, as [`Collision::sensitivities`] does. A row is refused as by [`Batch::solve`], and if a
    /// derivative that is asked for is not finite.
    ///
    /// ```
    /// use planar_impact::batch::Batch;
    /// use planar_impact::*;
    /// let car = Vehicle::new(1500.0, 2500.0).with_impact_center(2.0, 0.3).with_speed(15.0);
    /// let restitution: Vec<f64> = (0..=10).map(|tenth| f64::from(tenth) / 10.0).collect();
    /// let batch = Batch::of(Collision::new(car, Party::Barrier)).with(Input::Restitution, &restitution)?;
    /// let by = [Input::Restitution, Input::VelocityX(Side::One)];
    /// let answer = batch.sensitivities(&[Output::Loss], &by);
    /// let alone = batch.row(3).sensitivities()?;
    /// assert_eq!(answer.derivatives[(Output::Loss, Input::Restitution)][3], alone.loss.by[Input::Restitution]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn sensitivities(&self, of: &[Output], by: &[Input]) -> Derivatives<(Output, Input)> {
        let pairs: Vec<_> = of.iter().flat_map(|of| by.iter().map(move |by| (*of, *by))).collect();
        self.derive(of, &pairs, &OfAll { of, by: places(by) })
    }

    /// Computes one output of every row with its derivatives by inputs, as [`Collision::sensitivity`] does: faster than all, with other rounding.
    #[must_use]
    pub fn sensitivity(&self, of: Output, by: &[Input]) -> Derivatives<(Output, Input)> {
        let pairs: Vec<_> = by.iter().map(|by| (of, *by)).collect();
        self.derive(&[of], &pairs, &OfOne { of, by: places(by) })
    }

    /// Computes the derivatives by inputs of the sum of outputs, each times its weight, as [`Collision::pullback`] does: the product of a row vector with the
    /// Jacobian of each row.
    ///
    /// # Panics
    ///
    /// If a column has another length than the batch.
    #[must_use]
    pub fn pullback(&self, weights: &[(Output, Numbers<'_>)], by: &[Input]) -> Derivatives<Input> {
        let (of, weights): (Vec<Output>, Vec<Numbers<'_>>) = weights.iter().copied().unzip();
        self.assert_rows(&weights);
        self.derive(&of, by, &OfSum { of: &of, weights: &weights, by: places(by) })
    }

    /// Computes the derivatives of outputs along a direction of the inputs, as [`Collision::pushforward`] does: the product of the Jacobian of each row with a
    /// column vector, which is zero for every input without a number.
    ///
    /// # Panics
    ///
    /// If a column has another length than the batch.
    #[must_use]
    pub fn pushforward(&self, of: &[Output], direction: &[(Input, Numbers<'_>)]) -> Derivatives<Output> {
        let (inputs, direction): (Vec<Input>, Vec<Numbers<'_>>) = direction.iter().copied().unzip();
        self.assert_rows(&direction);
        self.derive(of, of, &Along { of, inputs: &inputs, direction: &direction })
    }

    /// Computes outputs of every row with the variance of each to first order, from a covariance of the inputs that holds for every row: the diagonal of
    /// J S Jᵀ.
    #[must_use]
    pub fn variances(&self, of: &[Output], covariance: &Covariance) -> Derivatives<Output> {
        self.derive(of, of, &Spread { of, covariance })
    }

    fn derive<K: Copy + PartialEq>(&self, of: &[Output], keys: &[K], question: &impl Question) -> Derivatives<K> {
        let (values, slopes, refused) = self.ask(of, true, question);
        Derivatives { values, derivatives: Columns::new(keys, slopes), refused }
    }

    fn assert_rows(&self, numbers: &[Numbers<'_>]) {
        for column in numbers {
            if let Numbers::Column(column) = column {
                assert!(column.len() == self.rows(), "a column of {} rows for a batch of {}", column.len(), self.rows());
            }
        }
    }
}
