//! The data of a chart of a sweep.

use std::borrow::Cow;
use std::f64::consts::TAU;
use std::ops::Deref;

use planar_impact_app::sweep::Sweep;
use planar_impact_app::units::{Measure, Units};

/// A sweep in the units of its chart.
pub struct Charted<'a> {
    pub sweep: &'a Sweep,
    pub units: Units,
}

impl Deref for Charted<'_> {
    type Target = Sweep;

    fn deref(&self) -> &Sweep {
        self.sweep
    }
}

impl<'a> Charted<'a> {
    /// Returns an output at every point, in SI; NaN where the point is refused. An angle is that of the turn next to the point before it, so that no line and no
    /// contour leads back through angles that do not occur.
    pub fn column(&self, output: usize) -> Cow<'a, [f64]> {
        let values = self.sweep.column(output);
        if self.outputs[output].measure() == Measure::Angle {
            // Rows are the values of the last range.
            Cow::Owned(unwound(values, self.ranges.last().map_or(1, |range| range.si.len())))
        } else {
            Cow::Borrowed(values)
        }
    }
}

/// Moves angles by whole turns next to those before them in the same row, and those that begin a row next to the beginning of the row before.
fn unwound(values: &[f64], wide: usize) -> Vec<f64> {
    let mut all: Vec<f64> = Vec::with_capacity(values.len());
    for (i, value) in values.iter().enumerate() {
        // Where many points are refused, a search from each would take the square of their number.
        if value.is_nan() {
            all.push(*value);
            continue;
        }
        let row = i - i % wide;
        let before = all[row..].iter().rev().chain(all[..row].chunks(wide).rev().flatten());
        let turns = before.copied().find(|angle| angle.is_finite()).map_or(0.0, |before| ((value - before) / TAU).round());
        all.push(value - TAU * turns);
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn angles_go_on_beyond_half_a_turn() {
        let near = |found: &[f64], expected: &[f64]| {
            found.len() == expected.len()
                && found.iter().zip(expected).all(|(one, other)| (one - other).abs() < 1e-12 || one.is_nan() && other.is_nan())
        };
        assert!(near(&unwound(&[3.0, 3.1, 3.1 - TAU, f64::NAN, 3.2 - TAU], 5), &[3.0, 3.1, 3.1, f64::NAN, 3.2]));
        assert!(near(&unwound(&[-3.0, 3.0, -PI + 0.1], 3), &[-3.0, 3.0 - TAU, -PI + 0.1]));
        // The second row begins beside the beginning of the first, and beside its end if nothing else is known.
        assert!(near(&unwound(&[3.1, 3.2, 3.3, 3.2 - TAU, 3.3 - TAU, 3.4 - TAU], 3), &[3.1, 3.2, 3.3, 3.2, 3.3, 3.4]));
        assert!(near(&unwound(&[f64::NAN, -3.1, 3.1], 1), &[f64::NAN, -3.1, 3.1 - TAU]));
        let refused = vec![f64::NAN; 1 << 20];
        assert!(near(&unwound(&refused, refused.len()), &refused));
        assert!(near(&unwound(&[0.1, 0.5, -0.4, 1.0], 2), &[0.1, 0.5, -0.4, 1.0]));
    }
}
