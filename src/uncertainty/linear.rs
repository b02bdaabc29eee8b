//! What first and second derivatives say of an uncertain output.

use alloc::vec::Vec;

use super::Uncertain;
use super::model::{Bend, Model, Slope};
use super::tally::nearest_turn;
use crate::refusal::Refusals;

/// An output to first order, about the means of the numbers.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Linear {
    /// The output at the means.
    pub mean: f64,
    /// Its standard deviation; infinite if that of a number which matters is.
    pub sd: f64,
    /// Its derivative by each number.
    pub derivatives: Vec<f64>,
    /// The share of each number in the variance: g_i (S g)_i of g·S g. They add up to 1; with correlations one may be negative. NaN if nothing matters.
    pub shares: Vec<f64>,
    /// The standard deviation that would be left if one number had half its own.
    pub with_half: Vec<f64>,
}

/// Two standard deviations of an output, each without correlations.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SlopesAndValues {
    /// By the derivatives at the means.
    pub by_slopes: f64,
    /// By the values one standard deviation of each number below and above its mean: √Σ ½ (Δ₋² + Δ₊²).
    pub by_values: f64,
}

/// An output to second order, about the means of the numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SecondOrder {
    /// The mean, f + ½ tr H S.
    pub mean: f64,
    /// The standard deviation.
    pub sd: f64,
    /// The third central moment divided by the cube of the standard deviation; NaN for an output that is certain.
    pub skewness: f64,
}

impl<M: Model> Uncertain<M> {
    /// Returns an output to first order: exact if it is linear in the numbers.
    ///
    /// # Errors
    ///
    /// [`Refusals`] of the model at the means of the numbers.
    pub fn linear(&self, of: M::Output) -> Result<Linear, Refusals> {
        let Slope { value, by: gradient } = self.model.slope(&self.means(), of)?;
        let covariance = &self.covariance;
        let along = product(covariance, &gradient);
        let variance = dot(&gradient, &along);
        // Half the deviation of a number: three quarters of its variance go, and half of its covariances. Half of an infinite one is infinite.
        let with_half = |i: usize| {
            if !variance.is_finite() {
                return variance;
            }
            let (own, others) = (square(gradient[i]) * covariance[i][i], gradient[i] * along[i]);
            let left = variance - 0.75 * own - (others - own);
            libm::sqrt(if left > 0.0 { left } else { 0.0 })
        };
        Ok(Linear {
            mean: value,
            sd: libm::sqrt(variance),
            shares: gradient.iter().zip(&along).map(|(g, s)| if *g == 0.0 { 0.0 } else { g * s } / variance).collect(),
            with_half: (0..gradient.len()).map(with_half).collect(),
            derivatives: gradient,
        })
    }

    /// Returns the standard deviation of an output by slopes beside that by values one standard deviation away. Where they differ the output bends, or has a corner,
    /// beside which second derivatives are zero and slopes are those of one side.
    ///
    /// ```
    /// use planar_impact::*;
    /// let car = Vehicle::new(1500.0, 2500.0).with_impact_center(2.0, 0.3).with_speed(15.0);
    /// // The friction is the critical impulse ratio: below it slides, above it holds and has no effect.
    /// let collision = Collision::new(car, Party::Barrier).with_restitution(0.1);
    /// let critical = f64::abs(collision.sensitivity(Output::CriticalImpulseRatio)?.value);
    /// let limited = collision.with_impulse_ratio(ImpulseRatio::LimitedByFriction(critical));
    /// let uncertain = limited.uncertain(&[(Input::ImpulseRatio, Distribution::Normal { mean: critical + 1e-6, sd: 0.05 })])?;
    /// let beside = uncertain.beside_means(Output::TangentialWork, &uncertain.linear(Output::TangentialWork)?);
    /// assert!(beside.by_slopes == 0.0 && beside.by_values > 0.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn beside_means(&self, of: M::Output, linear: &Linear) -> SlopesAndValues {
        let means = self.means();
        let change = |place: usize, to: f64| {
            let mut at = means.clone();
            at[place] = to;
            let value = self.model.value(&at, of);
            (if self.model.is_angle(of) { nearest_turn(value, linear.mean) } else { value }) - linear.mean
        };
        let (mut of_slopes, mut of_values) = (0.0, 0.0);
        for (place, (number, derivative)) in self.numbers.iter().zip(&linear.derivatives).enumerate() {
            let (mean, sd) = (number.mean(), number.sd());
            let (least, greatest) = number.range(3.0);
            let slope = if *derivative == 0.0 { 0.0 } else { square(derivative * sd) };
            let (down, up) = (change(place, (mean - sd).max(least)), change(place, (mean + sd).min(greatest)));
            let squares = 0.5 * (square(down) + square(up));
            of_slopes += slope;
            // Where a number is impossible, or has no deviation, slopes are all there is.
            of_values += if squares.is_finite() { squares } else { slope };
        }
        SlopesAndValues { by_slopes: libm::sqrt(of_slopes), by_values: libm::sqrt(of_values) }
    }

    /// Returns the covariances of outputs to first order, row by row in their order: exact if they are linear in the numbers.
    ///
    /// ```
    /// use planar_impact::*;
    /// let car = Vehicle::new(1500.0, 2500.0).with_impact_center(2.0, 0.3).with_speed(15.0);
    /// let collision = Collision::new(car, Party::Barrier).with_restitution(0.1);
    /// let uncertain = collision.uncertain(&[(Input::VelocityX(Side::One), Distribution::Normal { mean: 15.0, sd: 1.0 })])?;
    /// let covariances = uncertain.covariances(&[Output::VelocityX(Side::One), Output::VelocityY(Side::One)])?;
    /// // One number moves both: they are wholly correlated.
    /// assert!((covariances[0][0] * covariances[1][1] - covariances[0][1] * covariances[1][0]).abs() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`Refusals`] of the model at the means of the numbers.
    pub fn covariances(&self, of: &[M::Output]) -> Result<Vec<Vec<f64>>, Refusals> {
        let means = self.means();
        let gradients = of.iter().map(|of| self.model.slope(&means, *of).map(|slope| slope.by)).collect::<Result<Vec<_>, _>>()?;
        let row = |gradient: &Vec<f64>| {
            let along = product(&self.covariance, gradient);
            gradients.iter().map(|other| dot(other, &along)).collect()
        };
        Ok(gradients.iter().map(row).collect())
    }

    /// Returns an output to second order. For normal numbers mean, standard deviation and skewness are those of the quadratic function; for others the third
    /// and fourth moments of each number count in the standard deviation, and its third moment in the skewness.
    ///
    /// # Errors
    ///
    /// [`Refusals`] of the model at the means of the numbers.
    pub fn second_order(&self, of: M::Output) -> Result<SecondOrder, Refusals> {
        let Bend { value, by: gradient, twice: hessian } = self.model.bend(&self.means(), of)?;
        let covariance = &self.covariance;
        let curved: Vec<Vec<f64>> = hessian.iter().map(|row| product(covariance, row)).collect();
        let trace = |power: &[Vec<f64>]| (0..power.len()).map(|i| power[i][i]).sum::<f64>();
        let squared = times(&curved, &curved);
        let along = product(covariance, &gradient);
        let mut variance = dot(&gradient, &along) + 0.5 * trace(&squared);
        let mut third = 3.0 * dot(&along, &product(&hessian, &along)) + trace(&times(&squared, &curved));
        // What the shapes of the numbers add to normal ones.
        for (i, number) in self.numbers.iter().enumerate() {
            let (g, h, central) = (gradient[i], hessian[i][i], number.central());
            let excess = central.fourth - 3.0 * square(central.second);
            variance += if h == 0.0 { 0.0 } else { g * h * central.third + 0.25 * h * h * excess };
            third += if g == 0.0 { 0.0 } else { g * g * g * central.third };
        }
        let sd = libm::sqrt(variance);
        // Without a variance there is no third moment either, be it zero by symmetry.
        let skewness = if variance.is_finite() { third / (variance * sd) } else { f64::NAN };
        Ok(SecondOrder { mean: value + 0.5 * trace(&curved), sd, skewness })
    }
}

fn square(x: f64) -> f64 {
    x * x
}

/// Returns the sum of products, in which nothing times infinity is nothing.
fn dot(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).map(|(x, y)| if *x == 0.0 || *y == 0.0 { 0.0 } else { x * y }).sum()
}

fn product(rows: &[Vec<f64>], by: &[f64]) -> Vec<f64> {
    rows.iter().map(|row| dot(row, by)).collect()
}

/// Returns the product of two square tables.
fn times(one: &[Vec<f64>], other: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let n = one.len();
    let entry = |i: usize, j: usize| (0..n).map(|k| one[i][k] * other[k][j]).sum();
    (0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect()
}
