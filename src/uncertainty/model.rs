//! Functions of uncertain numbers.

use alloc::vec;
use alloc::vec::Vec;
use core::fmt;

use super::Mapping;
use crate::batch::Batch;
use crate::collision::Collision;
use crate::measure::Measure;
use crate::output::{Output, Outputs};
use crate::refusal::Refusals;
use crate::scalar::Real;
use crate::sensitivity::dual::Dual;
use crate::simulation::{SolvedSamples, filled};

/// Outputs that follow from uncertain numbers.
pub trait Model: Sync {
    /// The name of an output.
    type Output: Copy + PartialEq + fmt::Debug + Send + Sync;

    /// Returns how many numbers there are.
    fn numbers(&self) -> usize;

    /// Returns `true` if an output is an angle, which starts anew after a turn.
    fn is_angle(&self, of: Self::Output) -> bool;

    /// Returns an output without checking that it is possible.
    fn value(&self, numbers: &[f64], of: Self::Output) -> f64;

    /// Computes outputs of many samples, given a column of each number, which may be used up.
    fn solve(&self, samples: usize, numbers: &mut [Vec<f64>], of: &[Self::Output]) -> SolvedSamples;

    /// Returns an output with its derivatives by each number.
    ///
    /// # Errors
    ///
    /// [`Refusals`] if the numbers are impossible.
    fn slope(&self, numbers: &[f64], of: Self::Output) -> Result<Slope, Refusals>;

    /// Returns an output with its first and second derivatives by each number.
    ///
    /// # Errors
    ///
    /// [`Refusals`] if the numbers are impossible.
    fn bend(&self, numbers: &[f64], of: Self::Output) -> Result<Bend, Refusals>;
}

/// A value and its derivatives.
#[derive(Clone, Debug, PartialEq)]
pub struct Slope {
    /// The value.
    pub value: f64,
    /// Its derivative by each number.
    pub by: Vec<f64>,
}

/// A value with its first and second derivatives.
#[derive(Clone, Debug, PartialEq)]
pub struct Bend {
    /// The value.
    pub value: f64,
    /// Its derivative by each number.
    pub by: Vec<f64>,
    /// Its second derivatives by each pair.
    pub twice: Vec<Vec<f64>>,
}

/// The outputs of a collision whose inputs follow from the numbers through a mapping.
#[derive(Clone, Debug)]
pub struct Mapped<M> {
    collision: Collision,
    mapping: M,
}

impl<M: Mapping> Mapped<M> {
    /// Creates the model of a collision.
    ///
    /// # Panics
    ///
    /// If the collision has not the inputs of the mapping.
    #[must_use]
    pub fn new(collision: Collision, mapping: M) -> Self {
        for input in mapping.inputs() {
            assert!(collision.input(*input).is_some(), "{}", crate::input::NoSuchInput(*input));
        }
        Mapped { collision, mapping }
    }

    /// Returns the collision with the inputs that it has apart from the numbers.
    pub fn collision(&self) -> &Collision {
        &self.collision
    }

    /// Returns the mapping.
    pub fn mapping(&self) -> &M {
        &self.mapping
    }

    /// Returns the collision with given values of the numbers.
    pub fn at(&self, numbers: &[f64]) -> Collision {
        self.mapping.apply(&self.collision, numbers)
    }

    fn written<T: Real + Copy + From<f64>>(&self, numbers: &[T]) -> Vec<T> {
        let mut inputs = vec![T::int(0); self.mapping.inputs().len()];
        self.mapping.write(numbers, &mut inputs);
        inputs
    }

    /// Returns the derivatives of each input by each number.
    fn jacobian(&self, numbers: &[f64]) -> Vec<Vec<f64>> {
        let by = |j: usize| -> Vec<Dual<f64>> {
            let seed = |(i, x): (usize, &f64)| Dual { value: *x, derivative: unit(i, j) };
            self.written(&numbers.iter().enumerate().map(seed).collect::<Vec<_>>())
        };
        let columns: Vec<Vec<Dual<f64>>> = (0..numbers.len()).map(by).collect();
        (0..self.mapping.inputs().len()).map(|k| columns.iter().map(|column| column[k].derivative).collect()).collect()
    }

    /// Returns the derivatives of each input by a pair of numbers.
    fn bends(&self, numbers: &[f64], one: usize, other: usize) -> Vec<f64> {
        let seed = |(i, x): (usize, &f64)| Dual {
            value: Dual { value: *x, derivative: unit(i, one) },
            derivative: Dual { value: unit(i, other), derivative: 0.0 },
        };
        let twice = self.written(&numbers.iter().enumerate().map(seed).collect::<Vec<_>>());
        twice.iter().map(|x| x.derivative.derivative).collect()
    }
}

fn unit(i: usize, j: usize) -> f64 {
    f64::from(u8::from(i == j))
}

impl<M: Mapping> Model for Mapped<M> {
    type Output = Output;

    fn numbers(&self) -> usize {
        self.mapping.numbers()
    }

    fn is_angle(&self, of: Output) -> bool {
        of.measure() == Measure::Angle
    }

    fn value(&self, numbers: &[f64], of: Output) -> f64 {
        let collision = self.at(numbers);
        Outputs::of(&collision, &collision.evaluate())[of]
    }

    fn solve(&self, samples: usize, numbers: &mut [Vec<f64>], of: &[Output]) -> SolvedSamples {
        let mut columns: Vec<Vec<f64>> = self.mapping.inputs().iter().map(|_| Vec::new()).collect();
        self.mapping.write_columns(numbers, &mut columns);
        SolvedSamples::of(&filled(Batch::of(self.collision).with_rows(samples), self.mapping.inputs(), &columns), of)
    }

    fn slope(&self, numbers: &[f64], of: Output) -> Result<Slope, Refusals> {
        let sensitive = self.at(numbers).sensitivity(of)?;
        let jacobian = self.jacobian(numbers);
        let inputs = self.mapping.inputs();
        let by = |j: usize| inputs.iter().zip(&jacobian).map(|(input, row)| sensitive.by[*input] * row[j]).sum();
        Ok(Slope { value: sensitive.value, by: (0..numbers.len()).map(by).collect() })
    }

    /// Jᵀ H J, and the curvature of the mapping itself.
    fn bend(&self, numbers: &[f64], of: Output) -> Result<Bend, Refusals> {
        let curved = self.at(numbers).curvature(of)?;
        let inputs = self.mapping.inputs();
        let jacobian = self.jacobian(numbers);
        let by = |j: usize| inputs.iter().zip(&jacobian).map(|(input, row)| curved.by[*input] * row[j]).sum();
        let twice = |i: usize, j: usize| {
            let bent: f64 = inputs.iter().zip(self.bends(numbers, i, j)).map(|(input, bend)| curved.by[*input] * bend).sum();
            let through = |(one, row): (&crate::input::Input, &Vec<f64>)| {
                let hessian = &curved.twice.as_rows()[one.index()];
                inputs.iter().zip(&jacobian).map(|(other, column)| row[i] * hessian[other.index()] * column[j]).sum::<f64>()
            };
            bent + inputs.iter().zip(&jacobian).map(through).sum::<f64>()
        };
        let n = numbers.len();
        let twice = (0..n).map(|i| (0..n).map(|j| twice(i.max(j), i.min(j))).collect()).collect();
        Ok(Bend { value: curved.value, by: (0..n).map(by).collect(), twice })
    }
}
