//! What the evidence determines, by singular values.

use nalgebra::{DMatrix, Dyn, SVD};

use super::variable::Variable;

/// The share of the largest singular value below which a direction changes no piece of evidence.
const NOTHING: f64 = 1e-9;

/// What is rounding in a derivative beside what it is the derivative of.
const ROUNDING: f64 = 1e-11;

/// Singular values and directions; none where there are none, as of what is not a number.
fn decomposed(matrix: DMatrix<f64>) -> Option<SVD<f64, Dyn, Dyn>> {
    /// More rotations than any matrix of this size takes.
    const ROTATIONS: usize = 10_000;
    if matrix.iter().any(|entry| !entry.is_finite()) {
        return None;
    }
    SVD::try_new(matrix, false, true, f64::EPSILON, ROTATIONS)
}

/// A way in which the unknowns can move together without any piece of evidence noticing, to first order.
#[derive(Clone, Debug, PartialEq)]
pub struct Direction {
    /// The unknowns that move, and by how much beside each other, in SI units; the largest in its scale (1 m/s, 1 rad/s, 0.1 of the rest) moves by that.
    pub parts: Vec<(Variable, f64)>,
}

impl Direction {
    /// The unknowns that move.
    pub fn variables(&self) -> impl Iterator<Item = Variable> {
        self.parts.iter().map(|(variable, _)| *variable)
    }
}

/// The directions of the unknowns that no evidence notices, from derivatives of the evidence by the unknowns in their scales.
///
/// Rows are brought to the same size first: how well a piece of evidence is known says nothing of what it is evidence of. A row that is rounding beside the
/// `sizes` of what it is the derivative of is none.
pub(super) fn blind(derivatives: &DMatrix<f64>, sizes: &[f64]) -> Vec<Vec<f64>> {
    let unknowns = derivatives.ncols();
    // Bounds hold them all.
    if unknowns == 0 {
        return Vec::new();
    }
    let rows = derivatives.nrows().max(unknowns);
    let mut matrix = DMatrix::zeros(rows, unknowns);
    for ((mut to, from), size) in matrix.row_iter_mut().zip(derivatives.row_iter()).zip(sizes) {
        let length = from.norm();
        if length > ROUNDING * size {
            to.copy_from(&(from / length));
        }
    }
    let Some(svd) = decomposed(matrix) else { return Vec::new() };
    let Some(directions) = svd.v_t else { return Vec::new() };
    let largest = svd.singular_values.max();
    let is_blind = |k: &usize| svd.singular_values[*k] <= NOTHING * largest;
    (0..unknowns).filter(is_blind).map(|k| directions.row(k).iter().copied().collect()).collect()
}

/// The direction that the evidence notices least, of length 1; none without unknowns.
pub(super) fn weakest(derivatives: &DMatrix<f64>) -> Option<Vec<f64>> {
    if derivatives.is_empty() {
        return None;
    }
    let svd = decomposed(derivatives.clone())?;
    // Singular values are in descending order.
    let last = svd.v_t?.row(svd.singular_values.len() - 1).iter().copied().collect();
    Some(last)
}

/// Whether a part of a direction is more than rounding beside its largest.
pub(super) fn is_moved(part: f64, direction: &[f64]) -> bool {
    let largest = direction.iter().fold(0.0_f64, |largest, other| largest.max(other.abs()));
    part.abs() > 1e-6 * largest
}

/// A direction in scales, in units, without what is rounding.
pub(super) fn named(direction: &[f64], variables: &[Variable], scales: &[f64]) -> Direction {
    let largest = direction.iter().fold(0.0_f64, |largest, part| if part.abs() > largest.abs() { *part } else { largest });
    let part = |i: usize| (variables[i], direction[i] / largest * scales[i]);
    let moves = |i: &usize| is_moved(direction[*i], direction);
    Direction { parts: (0..direction.len()).filter(moves).map(part).collect() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input::Side;

    #[test]
    fn a_sum_alone_does_not_tell_its_terms() {
        let sum = DMatrix::from_row_slice(2, 2, &[1.0, 1.0, 3e5, 3e5]);
        let blind = blind(&sum, &[1.0; 2]);
        assert_eq!(blind.len(), 1);
        let direction = named(&blind[0], &[Variable::Speed(Side::One), Variable::Speed(Side::Two)], &[1.0, 1.0]);
        let [(_, one), (_, two)] = direction.parts[..] else { panic!("{direction:?}") };
        assert!((one + two).abs() < 1e-12 && one.abs().max(two.abs()) == 1.0, "{direction:?}");
    }

    #[test]
    fn weak_evidence_is_evidence() {
        assert!(blind(&DMatrix::from_row_slice(2, 2, &[1e6, 0.0, 0.0, 1e-6]), &[1.0; 2]).is_empty());
        assert_eq!(blind(&DMatrix::from_row_slice(1, 2, &[1.0, 0.0]), &[1.0]).len(), 1);
        assert_eq!(blind(&DMatrix::zeros(2, 2), &[1.0; 2]).len(), 2);
    }

    #[test]
    fn rounding_is_no_evidence() {
        let derivatives = DMatrix::from_row_slice(2, 2, &[1.0, 1.0, 3e-16, -1e-16]);
        assert_eq!(blind(&derivatives, &[20.0, 1.0]).len(), 1);
        assert!(blind(&derivatives, &[20.0, 1e-12]).is_empty());
    }

    #[test]
    fn what_is_no_number_has_no_directions() {
        let derivatives = DMatrix::from_row_slice(2, 2, &[1.0, f64::NAN, f64::INFINITY, 1.0]);
        assert!(blind(&derivatives, &[1.0; 2]).len() <= 2);
        assert_eq!(weakest(&derivatives), None);
    }
}
