//! How uncertain numbers determine inputs of a collision.

use alloc::vec;
use alloc::vec::Vec;

use crate::collision::Collision;
use crate::input::{Input, NoSuchInput};
use crate::scalar::Real;

/// What uncertain numbers mean: the inputs of a collision that they determine, on any scalar.
///
/// The numbers may be inputs themselves ([`Direct`]), or others that inputs follow from, such as the speed along an uncertain heading.
pub trait Mapping: Sync {
    /// Returns how many uncertain numbers there are.
    fn numbers(&self) -> usize;

    /// Returns the inputs that they determine, each once. The collision has each of them.
    fn inputs(&self) -> &[Input];

    /// Computes those inputs, in SI and radians.
    fn write<T: Real + Copy + From<f64>>(&self, numbers: &[T], inputs: &mut [T]);

    /// Computes those inputs of many samples, given a column of each number. A column has the same length as every other.
    fn write_columns(&self, numbers: &mut [Vec<f64>], inputs: &mut [Vec<f64>]) {
        let samples = numbers.first().map_or(0, Vec::len);
        inputs.iter_mut().for_each(|column| column.resize(samples, 0.0));
        let (mut of_sample, mut to) = (vec![0.0; numbers.len()], vec![0.0; inputs.len()]);
        for sample in 0..samples {
            of_sample.iter_mut().zip(&*numbers).for_each(|(x, column)| *x = column[sample]);
            self.write(&of_sample, &mut to);
            to.iter().zip(&mut *inputs).for_each(|(x, column)| column[sample] = *x);
        }
    }

    /// Returns a collision with the inputs that the numbers determine.
    fn apply<T: Real + Copy + From<f64>>(&self, base: &Collision, numbers: &[T]) -> Collision<T> {
        let mut collision = base.map(T::from);
        let mut values: Vec<T> = self.inputs().iter().map(|_| T::int(0)).collect();
        self.write(numbers, &mut values);
        for (input, value) in self.inputs().iter().zip(values) {
            collision.set(*input, value).unwrap_or_else(|none: NoSuchInput| panic!("{none}"));
        }
        collision
    }
}

/// Numbers that are inputs.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Direct(pub Vec<Input>);

impl Mapping for Direct {
    fn numbers(&self) -> usize {
        self.0.len()
    }

    fn inputs(&self) -> &[Input] {
        &self.0
    }

    #[inline]
    fn write<T: Real + Copy + From<f64>>(&self, numbers: &[T], inputs: &mut [T]) {
        inputs.copy_from_slice(numbers);
    }

    fn write_columns(&self, numbers: &mut [Vec<f64>], inputs: &mut [Vec<f64>]) {
        inputs.swap_with_slice(numbers);
    }
}
