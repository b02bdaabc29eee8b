//! The same derivatives as nalgebra matrices, for further linear algebra.

use super::{Gradient, Hessian, Sensitive};
use crate::input::Input;
use crate::output::{Output, Outputs};
use nalgebra::{DMatrix, SMatrix, SVector, Scalar};

impl<T: Scalar> From<Gradient<T>> for SVector<T, { Input::COUNT }> {
    /// Returns a column in the order of [`Input::ALL`].
    fn from(gradient: Gradient<T>) -> Self {
        SVector::from(gradient.0)
    }
}

impl<T: Scalar> From<Hessian<T>> for SMatrix<T, { Input::COUNT }, { Input::COUNT }> {
    /// Returns rows and columns in the order of [`Input::ALL`].
    fn from(hessian: Hessian<T>) -> Self {
        // Symmetric: its rows are its columns.
        SMatrix::from(hessian.0)
    }
}

impl<T: Scalar> Outputs<Sensitive<T>> {
    /// Returns the Jacobian: a row for each of [`Output::ALL`], a column for each of [`Input::ALL`].
    ///
    /// ```
    /// # use planar_impact::*;
    /// # let car: Vehicle = Vehicle {
    /// #     mass: 1500.0, yaw_inertia: 2500.0, heading: Heading::from_angle(0.0), impact_center: ForwardLeft { forward: 2.0, left: 0.5 },
    /// #     motion: Motion { velocity: Xy { x: 15.0, y: 0.0 }, yaw_rate: 0.0 },
    /// # };
    /// # let collision = Collision {
    /// #     one: car.into(), two: Party::Barrier, crush_plane: CrushPlane::from_angle(0.0), restitution: 0.1,
    /// #     impulse_ratio: ImpulseRatio::Critical, law: Law::Brach, moment: Moment::None,
    /// # };
    /// let outputs = collision.sensitivities()?;
    /// let jacobian = outputs.jacobian();
    /// assert_eq!(jacobian[(Output::Loss.index(), Input::Restitution.index())], outputs.loss.by[Input::Restitution]);
    /// # Ok::<(), Refusals>(())
    /// ```
    pub fn jacobian(&self) -> SMatrix<T, { Output::COUNT }, { Input::COUNT }> {
        SMatrix::from_fn(|row, column| self[Output::ALL[row]].by.0[column].clone())
    }

    /// Returns the part of the Jacobian for some outputs, its rows, and some inputs, its columns.
    pub fn jacobian_of(&self, of: &[Output], by: &[Input]) -> DMatrix<T> {
        DMatrix::from_fn(of.len(), by.len(), |row, column| self[of[row]].by[by[column]].clone())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_derivative_has_its_place() {
        let mut outputs = Outputs::<Sensitive>::default();
        for (i, output) in Output::ALL.into_iter().enumerate() {
            for (j, input) in Input::ALL.into_iter().enumerate() {
                outputs[output].by[input] = (100 * i + j) as f64;
            }
        }
        let jacobian = outputs.jacobian();
        assert_eq!((jacobian[(0, 0)], jacobian[(31, 19)], jacobian[(7, 3)]), (0.0, 3119.0, 703.0));
        let part = outputs.jacobian_of(&[Output::Loss, Output::NormalWork], &[Input::CrushPlane]);
        assert_eq!(part.shape(), (2, 1));
        assert_eq!(part[(1, 0)], outputs.work.n.by[Input::CrushPlane]);
        let column = SVector::from(outputs.loss.by);
        assert_eq!(column[19], outputs.loss.by[Input::Moment]);
    }

    #[test]
    fn a_hessian_keeps_its_entries() {
        let mut hessian = Hessian([[0.0; Input::COUNT]; Input::COUNT]);
        hessian.0[3][5] = 7.0;
        hessian.0[5][3] = 7.0;
        let matrix = SMatrix::from(hessian);
        assert_eq!((matrix[(3, 5)], matrix[(5, 3)], matrix.sum()), (7.0, 7.0, 14.0));
    }
}
