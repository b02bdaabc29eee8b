//! The covariance of inputs, and the variance of an output that follows from it to first order.

use alloc::vec::Vec;
use core::fmt;

use super::Gradient;
use crate::input::Input;
use crate::scalar::{Real, is_finite, is_positive, is_zero, slack};

/// The covariance S of uncertain inputs, which gives an output with the gradient g the variance g·S g. Every other input is exact.
///
/// It is kept as factors S = L D Lᵀ, so that no variance is negative, whatever the rounding.
///
/// ```
/// use planar_impact::*;
/// let car = Vehicle::new(1500.0, 2500.0).with_impact_center(2.0, 0.3).with_speed(15.0);
/// let collision = Collision::new(car, Party::Barrier).with_restitution(0.1);
/// // ± 0.5 m/s and ± 0.05.
/// let inputs: Covariance = Covariance::independent(&[(Input::VelocityX(Side::One), 0.5), (Input::Restitution, 0.05)])?;
/// let delta_v = collision.sensitivity(Output::DeltaVMagnitude(Side::One))?;
/// let by_speed = 0.5 * delta_v.by[Input::VelocityX(Side::One)];
/// let by_restitution = 0.05 * delta_v.by[Input::Restitution];
/// let sum = by_speed * by_speed + by_restitution * by_restitution;
/// assert!((inputs.variance_of(&delta_v.by) - sum).abs() <= 1e-15 * sum);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Covariance<T = f64> {
    factors: Vec<Factor<T>>,
}

/// A column of L with its place in D.
#[derive(Clone, Debug, PartialEq)]
struct Factor<T> {
    input: Input,
    variance: T,
    /// The entries of L below its diagonal that are not zero.
    below: Vec<(Input, T)>,
}

/// Reason why numbers are not the covariance of inputs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NotACovariance<T = f64> {
    /// The table has not one row and one column for each input.
    NotSquare {
        /// Number of inputs.
        inputs: usize,
        /// Number of rows, or of columns in the first row that has another number of them.
        found: usize,
    },
    /// An input is named twice.
    Repeated(Input),
    /// A number is not finite, or a variance is negative.
    NotANumber(Input, Input, T),
    /// Two numbers that should be equal differ.
    NotSymmetric(Input, Input),
    /// No inputs have these variances and covariances: given the inputs before it, this one would have a negative variance. The other is the one with which
    /// its correlation is the greatest.
    Indefinite(Input, Input),
}

impl<T: fmt::Display> fmt::Display for NotACovariance<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            NotACovariance::NotSquare { inputs, found } => {
                write!(f, "a covariance of {inputs} inputs has {inputs} rows and {inputs} columns, not {found}")
            }
            NotACovariance::Repeated(input) => write!(f, "{input} stands twice in a covariance; name each input once"),
            NotACovariance::NotANumber(one, other, found) if one == other => {
                write!(f, "the variance of {one} must be finite and not negative, not {found}")
            }
            NotACovariance::NotANumber(one, other, found) => write!(f, "the covariance of {one} and {other} must be finite, not {found}"),
            NotACovariance::NotSymmetric(one, other) => {
                write!(f, "the covariance of {one} and {other} is given twice, with different values")
            }
            NotACovariance::Indefinite(one, other) => {
                write!(f, "no inputs have this covariance; reduce the correlation of {one}, for instance with {other}")
            }
        }
    }
}

impl<T: fmt::Debug + fmt::Display> core::error::Error for NotACovariance<T> {}

impl<T: Real<Mask = bool> + Copy> Covariance<T> {
    /// Creates the covariance of inputs that are independent, from the standard deviation of each in SI units and radians.
    ///
    /// # Errors
    ///
    /// [`NotACovariance`] if an input stands twice, or a standard deviation is negative or not finite.
    pub fn independent(deviations: &[(Input, T)]) -> Result<Self, NotACovariance<T>> {
        let inputs: Vec<Input> = deviations.iter().map(|(input, _)| *input).collect();
        repeated(&inputs)?;
        let factor = |&(input, deviation): &(Input, T)| {
            let variance = deviation.squared();
            let is_sound = is_finite(&variance) && !is_positive(&-deviation);
            if is_sound {
                Ok(Factor { input, variance, below: Vec::new() })
            } else {
                Err(NotACovariance::NotANumber(input, input, deviation))
            }
        };
        Ok(Covariance { factors: deviations.iter().map(factor).collect::<Result<_, _>>()? })
    }

    /// Creates a covariance from its rows, in the order of the inputs, in SI units and radians.
    ///
    /// # Errors
    ///
    /// [`NotACovariance`] unless the rows are a symmetric table without a negative eigenvalue, but for rounding.
    pub fn new(inputs: &[Input], rows: &[impl AsRef<[T]>]) -> Result<Self, NotACovariance<T>> {
        let given = table(inputs, rows)?;
        let indefinite = |i: usize| NotACovariance::Indefinite(inputs[i], inputs[most_correlated(&given, i)]);
        let mut left = given.clone();
        let mut factors = Vec::with_capacity(inputs.len());
        for (k, &input) in inputs.iter().enumerate() {
            let variance = left[k][k];
            let rounding = given[k][k] * slack();
            if variance.less(&-rounding) {
                return Err(indefinite(k));
            }
            // What the inputs before it explain has no variance of its own, and no covariance.
            if !rounding.less(&variance) {
                match (k + 1..inputs.len()).find(|&i| (rounding * given[i][i]).less(&left[i][k].squared())) {
                    Some(i) => return Err(indefinite(i)),
                    None => continue,
                }
            }
            let mut below = Vec::new();
            let column: Vec<T> = left.iter().map(|row| row[k]).collect();
            for (i, row) in left.iter_mut().enumerate().skip(k + 1).filter(|(i, _)| !is_zero(&column[*i])) {
                let share = column[i] / variance;
                below.push((inputs[i], share));
                row.iter_mut().zip(&column).skip(k + 1).for_each(|(x, y)| *x = *x - share * *y);
            }
            factors.push(Factor { input, variance, below });
        }
        Ok(Covariance { factors })
    }
}

impl<T: Real + Copy> Covariance<T> {
    /// Returns the variance of an output from its gradient, to first order: exact for an output that is linear in the inputs.
    pub fn variance_of(&self, gradient: &Gradient<T>) -> T {
        self.variance_in(gradient, |number| number)
    }

    /// Returns the variance on another scalar, for which the numbers of the covariance are converted.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn variance_in<U: Real + Copy>(&self, gradient: &Gradient<U>, convert: impl Fn(T) -> U) -> U {
        let mut sum = U::int(0);
        for Factor { input, variance, below } in &self.factors {
            let mut along = gradient[*input];
            for (input, share) in below {
                along = along + convert(*share) * gradient[*input];
            }
            sum = sum + convert(*variance) * (along * along);
        }
        sum
    }
}

fn repeated<T>(inputs: &[Input]) -> Result<(), NotACovariance<T>> {
    match inputs.iter().enumerate().find(|(i, input)| inputs[..*i].contains(input)) {
        Some((_, input)) => Err(NotACovariance::Repeated(*input)),
        None => Ok(()),
    }
}

/// Returns the rows of a symmetric table of finite numbers whose diagonal is not negative.
fn table<T: Real<Mask = bool> + Copy>(inputs: &[Input], rows: &[impl AsRef<[T]>]) -> Result<Vec<Vec<T>>, NotACovariance<T>> {
    repeated(inputs)?;
    let rows: Vec<Vec<T>> = rows.iter().map(|row| row.as_ref().to_vec()).collect();
    let lengths = core::iter::once(rows.len()).chain(rows.iter().map(Vec::len));
    if let Some(found) = lengths.into_iter().find(|length| *length != inputs.len()) {
        return Err(NotACovariance::NotSquare { inputs: inputs.len(), found });
    }
    for (i, row) in rows.iter().enumerate() {
        for (j, x) in row.iter().enumerate() {
            if !is_finite(x) || (i == j && x.less(&T::int(0))) {
                return Err(NotACovariance::NotANumber(inputs[i], inputs[j], *x));
            }
            let scale = x.magnitude() + rows[j][i].magnitude();
            if (scale * slack()).less(&(*x - rows[j][i]).magnitude()) {
                return Err(NotACovariance::NotSymmetric(inputs[i], inputs[j]));
            }
        }
    }
    Ok(rows)
}

/// Returns the other input with which the correlation of one is the greatest.
fn most_correlated<T: Real<Mask = bool> + Copy>(rows: &[Vec<T>], one: usize) -> usize {
    let squared = |other: usize| rows[one][other].squared() / (rows[one][one] * rows[other][other]);
    let others = (0..rows.len()).filter(|other| *other != one);
    others.reduce(|most, other| if squared(most).less(&squared(other)) { other } else { most }).unwrap_or(one)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input::Side;

    const INPUTS: [Input; 3] = [Input::Mass(Side::One), Input::Restitution, Input::CrushPlane];

    fn gradient(x: f64, y: f64, z: f64) -> Gradient {
        let mut gradient = Gradient::default();
        (gradient[INPUTS[0]], gradient[INPUTS[1]], gradient[INPUTS[2]]) = (x, y, z);
        // Exact inputs do not matter.
        gradient[Input::VelocityX(Side::Two)] = 1e9;
        gradient
    }

    #[test]
    fn what_is_no_covariance_is_told_by_its_inputs_and_its_number() {
        let told = |issue: NotACovariance| alloc::format!("{issue}");
        let [mass, restitution, _] = INPUTS;
        assert_eq!(told(NotACovariance::NotSquare { inputs: 2, found: 3 }), "a covariance of 2 inputs has 2 rows and 2 columns, not 3");
        assert_eq!(told(NotACovariance::Repeated(mass)), alloc::format!("{mass} stands twice in a covariance; name each input once"));
        let variance = alloc::format!("the variance of {mass} must be finite and not negative, not -1");
        assert_eq!(told(NotACovariance::NotANumber(mass, mass, -1.0)), variance);
        let covariance = alloc::format!("the covariance of {mass} and {restitution} must be finite, not inf");
        assert_eq!(told(NotACovariance::NotANumber(mass, restitution, f64::INFINITY)), covariance);
        let twice = alloc::format!("the covariance of {mass} and {restitution} is given twice, with different values");
        assert_eq!(told(NotACovariance::NotSymmetric(mass, restitution)), twice);
        assert!(told(NotACovariance::Indefinite(mass, restitution)).contains("reduce the correlation of"));
    }

    #[test]
    fn the_variance_is_the_quadratic_form() {
        let rows = [[4.0, 1.0, -1.0], [1.0, 2.0, 0.5], [-1.0, 0.5, 1.0]];
        let covariance = Covariance::new(&INPUTS, &rows).unwrap();
        let g = [3.0, -2.0, 5.0];
        let wanted: f64 = (0..3).flat_map(|i| (0..3).map(move |j| g[i] * rows[i][j] * g[j])).sum();
        assert!((covariance.variance_of(&gradient(g[0], g[1], g[2])) - wanted).abs() < 1e-12 * wanted);
        let alone = Covariance::independent(&[(INPUTS[0], 2.0), (INPUTS[1], 0.5)]).unwrap();
        assert_eq!(alone.variance_of(&gradient(g[0], g[1], g[2])), 9.0 * 4.0 + 4.0 * 0.25);
        assert_eq!(Covariance::new(&INPUTS[..2], &[[4.0, 0.0], [0.0, 0.25]]), Ok(alone));
    }

    #[test]
    fn what_others_explain_cancels() {
        // The second is half the first, the third is constant.
        let rows = [[4.0, 2.0, 0.0], [2.0, 1.0, 0.0], [0.0; 3]];
        let covariance = Covariance::new(&INPUTS, &rows).unwrap();
        assert_eq!(covariance.variance_of(&gradient(1.0, -2.0, 7.0)), 0.0);
        assert_eq!(covariance.variance_of(&gradient(1.0, 2.0, 7.0)), 16.0);
    }

    #[test]
    fn what_is_no_covariance_is_refused() {
        let refused = |rows: [[f64; 3]; 3]| Covariance::new(&INPUTS, &rows).unwrap_err();
        let good = [[4.0, 1.0, 0.0], [1.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let with = |i: usize, j: usize, x: f64| {
            let mut rows = good;
            rows[i][j] = x;
            rows
        };
        assert!(Covariance::new(&INPUTS, &good).is_ok());
        assert_eq!(refused(with(0, 0, -4.0)), NotACovariance::NotANumber(INPUTS[0], INPUTS[0], -4.0));
        assert!(matches!(refused(with(2, 1, f64::NAN)), NotACovariance::NotSymmetric(..) | NotACovariance::NotANumber(..)));
        assert_eq!(refused(with(0, 1, 1.5)), NotACovariance::NotSymmetric(INPUTS[0], INPUTS[1]));
        let mut beyond = with(0, 1, 2.1);
        beyond[1][0] = 2.1;
        assert_eq!(refused(beyond), NotACovariance::Indefinite(INPUTS[1], INPUTS[0]));
        // Of no variance, and yet correlated.
        let mut constant = with(0, 0, 0.0);
        constant[2] = [0.0, 0.0, 1.0];
        assert_eq!(refused(constant), NotACovariance::Indefinite(INPUTS[1], INPUTS[0]));
        // Each pair is possible, and all three are not.
        let round = [[1.0, 0.9, -0.9], [0.9, 1.0, 0.9], [-0.9, 0.9, 1.0]];
        assert!(matches!(refused(round), NotACovariance::Indefinite(one, _) if one == INPUTS[2]));
        assert_eq!(Covariance::new(&INPUTS, &good[..2]), Err(NotACovariance::NotSquare { inputs: 3, found: 2 }));
        assert_eq!(Covariance::new(&INPUTS[..2], &good[..2]), Err(NotACovariance::NotSquare { inputs: 2, found: 3 }));
        let twice = [INPUTS[0], INPUTS[0]];
        assert_eq!(Covariance::new(&twice, &[[1.0, 0.0], [0.0, 1.0]]), Err(NotACovariance::Repeated(INPUTS[0])));
        assert_eq!(Covariance::independent(&[(INPUTS[0], 1.0), (INPUTS[0], 1.0)]), Err(NotACovariance::Repeated(INPUTS[0])));
        for deviation in [-1.0, f64::NAN, f64::INFINITY] {
            assert!(matches!(Covariance::independent(&[(INPUTS[0], deviation)]), Err(NotACovariance::NotANumber(..))), "{deviation}");
        }
    }

    /// By the correlation, 0.5 with the first and 0.3 with the last, and not by the covariance, 0.05 and 3.
    #[test]
    fn the_most_correlated_input_is_that_of_the_greatest_coefficient() {
        let rows = [vec![0.01, 0.05, 0.0], vec![0.05, 1.0, 3.0], vec![0.0, 3.0, 100.0]];
        assert_eq!((most_correlated(&rows, 1), most_correlated(&rows, 2)), (0, 1));
    }
}
