//! Equations combined so that each is that of one number.

use crate::cells::middle_of;
use crate::scalar::interval::Interval;

/// The numbers that equations are solved for, and how.
pub(super) struct Pivots {
    /// For each equation, the number that it is solved for.
    pub(super) of: Vec<usize>,
    /// The combination of equations that makes each row.
    combined: Vec<Vec<f64>>,
}

impl Pivots {
    /// Chooses a number for each equation, a given one first, and combines the equations so that each is that of its number.
    pub(super) fn of(slopes: &[Vec<Interval>], ranges: &[Interval], first: Option<usize>) -> Self {
        let equations = slopes.len();
        let mut matrix: Vec<Vec<f64>> = slopes.iter().map(|row| row.iter().copied().map(middle_of).collect()).collect();
        let mut combined: Vec<Vec<f64>> = (0..equations).map(|i| (0..equations).map(|j| f64::from(u8::from(i == j))).collect()).collect();
        let width: Vec<f64> = ranges.iter().map(|range| range.width().max(f64::MIN_POSITIVE)).collect();
        let length = |row: &[f64]| row.iter().zip(&width).fold(0.0, |sum: f64, (slope, width)| sum.max((slope * width).abs()));
        let lengths: Vec<f64> = matrix.iter().map(|row| length(row).max(f64::MIN_POSITIVE)).collect();
        let mut of: Vec<Option<usize>> = vec![None; equations];
        for step in 0..equations {
            let is_free = |row: usize, column: usize| of[row].is_none() && !of.contains(&Some(column));
            let size = |(row, column): &(usize, usize)| (matrix[*row][*column] * width[*column]).abs() / lengths[*row];
            let of_search = (0..equations)
                .filter_map(|row| Some((row, first?)))
                .filter(|(row, column)| step == 0 && is_free(*row, *column) && size(&(*row, *column)) > 1e-9);
            let all = (0..equations)
                .flat_map(|row| (0..width.len()).map(move |column| (row, column)))
                .filter(|(row, column)| is_free(*row, *column));
            let greatest = |one: &(usize, usize), other: &(usize, usize)| size(one).total_cmp(&size(other));
            let Some((row, column)) = of_search.max_by(greatest).or_else(|| all.max_by(greatest)).filter(|at| size(at) > 0.0) else {
                break;
            };
            of[row] = Some(column);
            let scale = matrix[row][column].recip();
            matrix[row].iter_mut().chain(&mut combined[row]).for_each(|x| *x *= scale);
            let (pivot, combination) = (matrix[row].clone(), combined[row].clone());
            for other in (0..equations).filter(|other| *other != row) {
                let factor = matrix[other][column];
                matrix[other]
                    .iter_mut()
                    .zip(&pivot)
                    .chain(combined[other].iter_mut().zip(&combination))
                    .for_each(|(x, y)| *x -= factor * y);
            }
        }
        let chosen = of.into_iter().zip(combined).filter_map(|(of, combined)| Some((of?, combined)));
        let (of, combined) = chosen.filter(|(_, combined)| combined.iter().all(|x| x.is_finite())).unzip();
        Pivots { of, combined }
    }

    /// Combines rows of the equations, each to that of its number.
    pub(super) fn combine(&self, rows: &[Vec<Interval>]) -> Vec<Vec<Interval>> {
        self.combined.iter().map(|by| combine(rows, by)).collect()
    }
}

/// Returns a sum of rows, each times a number.
fn combine(rows: &[Vec<Interval>], by: &[f64]) -> Vec<Interval> {
    let columns = rows.first().map_or(0, Vec::len);
    let sum = |j: usize| {
        rows.iter().zip(by).filter(|(_, by)| **by != 0.0).fold(Interval::ZERO, |sum, (row, by)| sum + row[j] * Interval::from(*by))
    };
    (0..columns).map(sum).collect()
}
