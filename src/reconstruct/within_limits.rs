//! The evidence as a least-squares problem within the limits of the physics, with or without a fixed quantity.

use nalgebra::{DMatrix, DVector};

use super::limit::{Limit, Margins};
use super::measurand::Measurand;
use super::placed::Placed;
use super::residuals::{Model, curvature_of_sum, with_slopes};
use super::variable::turns;
use crate::impact::Impact;
use crate::least_squares::limited::{Limited, Local};
use crate::scalar::Real;

/// A quantity and the value at which it is held.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fixed {
    pub(super) of: Measurand,
    pub(super) value: f64,
    /// A significant change.
    pub(super) scale: f64,
    /// The period of an angle that is computed; that of an unknown is not wrapped.
    pub(super) period: Option<f64>,
}

/// The evidence, the margins of the physics, and the fixed quantity.
pub(super) struct WithinLimits<'a> {
    model: &'a Model<'a>,
    margins: Margins,
    fixed: Option<Fixed>,
}

/// What is computed at a point, in the order evidence, margins, fixed quantity.
fn computed<T: Real + Copy + From<f64>>(model: &Model<'_>, margins: &Margins, fixed: Option<Fixed>, point: &[T]) -> Vec<T> {
    let placed = model.place(point);
    let contact = placed.collision.contact();
    let (impulse, moment) = placed.collision.impulse(&contact);
    let impact = placed.collision.impact_of(&contact, impulse, moment);
    let mut all = model.measured(&placed, &impact);
    all.extend(margins.of(&placed.collision, &contact, &impact));
    all.extend(fixed.map(|fixed| fixed.of.of(&placed, &impact).unwrap_or_else(|| T::int(0))));
    all
}

impl<'a> WithinLimits<'a> {
    /// Sets up the problem on the side of a collision that the mechanics accepts.
    pub(super) fn around(model: &'a Model<'a>, placed: &Placed<f64>, impact: &Impact) -> Self {
        WithinLimits { model, margins: Margins::around(placed, impact), fixed: None }
    }

    /// Holds a quantity at a value.
    pub(super) fn hold(&mut self, fixed: Option<Fixed>) {
        self.fixed = fixed;
    }

    /// Returns the limit of the physics whose distance a margin is.
    pub(super) fn limit(&self, margin: usize) -> Limit {
        self.margins.limit(margin)
    }

    /// Returns the slopes of some margins by the unknowns, a row for each.
    pub(super) fn margin_slopes(&self, unknowns: &[f64], margins: &[usize]) -> DMatrix<f64> {
        let all = if margins.is_empty() { None } else { self.at(unknowns).map(|local| local.margin_slopes) };
        all.map_or_else(|| DMatrix::zeros(0, unknowns.len()), |all| all.select_rows(margins))
    }

    /// Returns the slopes of the evidence and of a quantity by the unknowns.
    pub(super) fn slopes_of(&self, of: Measurand, unknowns: &[f64]) -> Option<(DMatrix<f64>, DMatrix<f64>)> {
        let fixed = Some(Fixed { of, value: 0.0, scale: 1.0, period: None });
        let local = WithinLimits { model: self.model, margins: self.margins.clone(), fixed }.at(unknowns)?;
        Some((local.jacobian, local.fixed_slopes))
    }
}

impl Limited for WithinLimits<'_> {
    fn at(&self, unknowns: &[f64]) -> Option<Local> {
        let (values, slopes) = with_slopes(unknowns, |point| computed(self.model, &self.margins, self.fixed, point));
        let (evidence, margins) = (self.model.evidence.len(), slopes.nrows() - usize::from(self.fixed.is_some()));
        let residuals = self.model.residuals(&values[..evidence]);
        let whiten = |rows: DMatrix<f64>| self.model.weights.whiten(rows);
        let fixed = self.fixed.iter().map(|fixed| fixed.distance(values[margins])).collect::<Vec<_>>();
        let scale = self.fixed.map_or(1.0, |fixed| fixed.scale);
        Some(Local {
            residuals: DVector::from_vec(whiten(DMatrix::from_vec(evidence, 1, residuals)).data.into()),
            jacobian: -whiten(slopes.rows(0, evidence).into_owned()),
            margins: DVector::from_column_slice(&values[evidence..margins]),
            margin_slopes: slopes.rows(evidence, margins - evidence).into_owned(),
            fixed: DVector::from_vec(fixed),
            fixed_slopes: slopes.rows(margins, slopes.nrows() - margins) / scale,
        })
    }

    fn bend(&self, unknowns: &[f64], margins: &[f64], fixed: &[f64]) -> DMatrix<f64> {
        let values = computed(self.model, &self.margins, None, unknowns);
        let residuals = DVector::from_vec(self.model.residuals(&values[..self.model.evidence.len()]));
        let mut factors: Vec<f64> = self.model.weights.inverse_times(&residuals).iter().copied().collect();
        factors.extend(margins);
        factors.extend(fixed.iter().zip(&self.fixed).map(|(multiplier, fixed)| multiplier / fixed.scale));
        -curvature_of_sum(unknowns, &factors, |point| computed(self.model, &self.margins, self.fixed, point))
    }
}

impl Fixed {
    /// Returns the distance of a value from the fixed one, in its scale; for an angle the shorter way.
    fn distance(&self, value: f64) -> f64 {
        let difference = value - self.value;
        (difference - turns(difference, self.period)) / self.scale
    }
}
