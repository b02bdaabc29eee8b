//! Directions that the evidence determines, from the singular values of its slopes.

use nalgebra::DMatrix;

use super::variable::Variable;
use crate::least_squares::SingularValues;

/// Share of the largest singular value below which a direction changes no piece of evidence.
const NOTHING: f64 = 1e-9;

/// The relative size of rounding in a derivative.
const ROUNDING: f64 = 1e-11;

/// A combination of changes of the unknowns that makes no fit worse.
#[derive(Clone, Debug, PartialEq)]
pub struct Direction {
    /// The unknowns that change, and their changes relative to each other, in SI units; the largest in its scale (1 m/s, 1 rad/s, 0.1 of other quantities)
    /// changes by that scale.
    pub parts: Vec<(Variable, f64)>,
}

impl Direction {
    /// Returns the unknowns that change.
    pub fn variables(&self) -> impl Iterator<Item = Variable> {
        self.parts.iter().map(|(variable, _)| *variable)
    }
}

/// Returns the directions of the unknowns along which no piece of evidence has a slope, from derivatives of the evidence by the scaled unknowns.
///
/// Rows are normalized first, because the uncertainty of a piece of evidence does not affect which unknowns it constrains. A row at rounding level relative
/// to `sizes`, the sizes of the evidence, counts as zero.
pub(super) fn blind(derivatives: &DMatrix<f64>, sizes: &[f64]) -> Vec<Vec<f64>> {
    let unknowns = derivatives.ncols();
    // Active bounds limit all unknowns.
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
    let Some(found) = SingularValues::of(matrix) else { return Vec::new() };
    let largest = found.greatest();
    (0..unknowns).filter(|k| found.values[*k] <= NOTHING * largest).map(|k| found.direction(k)).collect()
}

/// Returns `true` if a part of a direction is above rounding relative to its largest part.
pub(super) fn is_moved(part: f64, direction: &[f64]) -> bool {
    let largest = direction.iter().fold(0.0_f64, |largest, other| largest.max(other.abs()));
    part.abs() > 1e-6 * largest
}

/// Converts a direction from scales to units, without parts at rounding level.
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
    fn a_direction_has_every_part_above_rounding() {
        let speeds = [Variable::Speed(Side::One), Variable::Speed(Side::Two), Variable::CrushShare];
        let direction = named(&[1e-5, -0.5, 1e-7], &speeds, &[1.0, 2.0, 1.0]);
        assert_eq!(direction.parts, [(speeds[0], -2e-5), (speeds[1], 2.0)]);
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
        assert_eq!(crate::least_squares::weakest(derivatives), None);
    }
}
