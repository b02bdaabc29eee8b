//! Residuals of the evidence at given unknowns, and their derivatives.

use nalgebra::{DMatrix, DVector};
use num_dual::{Dual64, HyperDual64};

use super::as_measured::{AsMeasured, computed};
use super::given::{Evidence, PlacedDependence, ReconstructionProblem};
use super::measurand::Measurand;
use super::placed::Placed;
use super::scene::Scene;
use super::variable::turns;
use super::weight::Weights;
use crate::impact::Impact;
use crate::least_squares::Residuals;
use crate::refusal::Refusals;
use crate::scalar::Real;

/// A reconstruction problem prepared for computation.
pub(super) struct Model<'a> {
    pub(super) question: &'a ReconstructionProblem,
    /// The evidence, then the priors.
    pub(super) evidence: Vec<Evidence>,
    pub(super) weights: Weights,
    dependences: Vec<PlacedDependence>,
    as_measured: AsMeasured,
    scene: Scene,
    /// A significant change of each unknown.
    pub(super) scales: Vec<f64>,
}

impl<'a> Model<'a> {
    pub(super) fn of(question: &'a ReconstructionProblem) -> Self {
        let evidence = question.all_evidence();
        let scales = question.unknowns.iter().map(|unknown| unknown.of.scale(&question.collision, unknown.start)).collect();
        Model {
            weights: Weights::of(question, &evidence),
            scene: Scene::of(question),
            dependences: question.placed_dependences(),
            as_measured: AsMeasured::of(question, &evidence),
            evidence,
            question,
            scales,
        }
    }

    /// Returns the same model with no tolerance below a thousandth of the size of its evidence, with which a search approaches the solution more easily.
    /// Returns `None` if that changes nothing, or changes all evidence.
    pub(super) fn softened(&self) -> Option<Self> {
        let is_tight = |evidence: &Evidence| evidence.weight_scale() < softest(evidence);
        if !self.evidence.iter().any(is_tight) || self.evidence.iter().all(is_tight) {
            return None;
        }
        let mut soft = Model::of(self.question);
        soft.soften(|_| true);
        Some(soft)
    }

    /// Raises the tolerance of some evidence to a thousandth of its size.
    pub(super) fn soften(&mut self, is_meant: impl Fn(&Evidence) -> bool) {
        for (scale, evidence) in self.weights.scales.iter_mut().zip(&self.evidence).filter(|(_, evidence)| is_meant(evidence)) {
            *scale = scale.max(softest(evidence));
        }
    }

    /// Returns the collision at given unknowns.
    pub(super) fn place<T: Real + Copy + From<f64>>(&self, unknowns: &[T]) -> Placed<T> {
        self.scene.place(unknowns)
    }

    /// Returns the collision at given unknowns and its impact.
    pub(super) fn solve(&self, unknowns: &[f64]) -> Result<(Placed<f64>, Impact), Refusals> {
        let placed = self.scene.place(unknowns);
        let impact = placed.solve()?;
        Ok((placed, impact))
    }

    /// Returns the computed values of the evidence for unknowns, their collision and its impact, each less what its given value follows the unknowns by.
    pub(super) fn measured<T: Real + Copy + From<f64>>(&self, unknowns: &[T], placed: &Placed<T>, impact: &Impact<T>) -> Vec<T> {
        self.followed(computed(&self.evidence, placed, impact), unknowns)
    }

    /// Returns the same as the given values are compared with it ([`AsMeasured::compared`]).
    pub(super) fn compared<T: Real + Copy + From<f64>>(&self, unknowns: &[T], placed: &Placed<T>, impact: &Impact<T>) -> Vec<T> {
        self.followed(self.as_measured.compared(&self.evidence, placed, impact), unknowns)
    }

    fn followed<T: Real + Copy + From<f64>>(&self, mut computed: Vec<T>, unknowns: &[T]) -> Vec<T> {
        for dependence in &self.dependences {
            computed[dependence.evidence] = computed[dependence.evidence] - dependence.change(unknowns);
        }
        computed
    }

    /// Returns the value of a quantity at given unknowns, for their collision and its impact, or `None` if absent. An unknown angle is not wrapped.
    pub(super) fn value<T: Real + Copy>(&self, of: Measurand, unknowns: &[T], placed: &Placed<T>, impact: &Impact<T>) -> Option<T> {
        self.question.place_of(of).map_or_else(|| of.of(placed, impact), |i| unknowns.get(i).copied())
    }

    /// Returns given less computed values, with angles the shorter way.
    pub(super) fn residuals(&self, computed: &[f64]) -> Vec<f64> {
        let residual = |(evidence, computed): (&Evidence, &f64)| {
            let difference = evidence.value - computed;
            difference - turns(difference, evidence.of.period())
        };
        self.evidence.iter().zip(computed).map(residual).collect()
    }

    fn residuals_at(&self, unknowns: &[f64]) -> Option<Vec<f64>> {
        let (placed, impact) = self.solve(unknowns).ok()?;
        Some(self.residuals(&self.compared(unknowns, &placed, &impact)))
    }

    /// Returns the computed values that the evidence is compared with at given unknowns, whether or not the mechanics accepts the collision.
    fn evaluated<T: Real + Copy + From<f64>>(&self, unknowns: &[T]) -> Vec<T> {
        let placed = self.scene.place(unknowns);
        self.compared(unknowns, &placed, &placed.evaluate())
    }

    /// Returns the derivatives of the computed evidence: a row for each piece, a column for each unknown.
    pub(super) fn derivatives(&self, unknowns: &[f64]) -> DMatrix<f64> {
        self.with_slopes(unknowns, |point| self.evaluated(point)).1
    }

    /// Returns values that are computed from the unknowns, those of the evidence first, and their derivatives: a row for each value, a column for each unknown.
    ///
    /// Derivatives of the evidence that are rounding are zero. The speed of a vehicle that drives along the crush plane has a normal component of cos 90°, which is
    /// not zero in floats: a search would follow it to any speed, and an interval would end there.
    pub(super) fn with_slopes(&self, unknowns: &[f64], computed: impl Fn(&[Dual64]) -> Vec<Dual64>) -> (Vec<f64>, DMatrix<f64>) {
        /// Change of a piece of evidence by a significant change of an unknown, as a share of its size, that is rounding.
        const ROUNDING: f64 = 1e-13;
        let mut point: Vec<Dual64> = unknowns.iter().copied().map(Dual64::from).collect();
        let (mut values, mut columns) = (Vec::new(), Vec::new());
        for k in 0..point.len() {
            point[k].eps = 1.0;
            let at = computed(&point);
            let sizes = self.evidence.iter().map(Evidence::size).chain(core::iter::repeat(0.0));
            let slope = |(value, size): (&Dual64, f64)| if (value.eps * self.scales[k]).abs() < ROUNDING * size { 0.0 } else { value.eps };
            columns.push(DVector::from_iterator(at.len(), at.iter().zip(sizes).map(slope)));
            values = at.into_iter().map(|value| value.re).collect();
            point[k].eps = 0.0;
        }
        (values, DMatrix::from_columns(&columns))
    }

    /// Returns the second derivatives of a sum of the computed evidence, each piece times a factor.
    pub(super) fn curvature(&self, unknowns: &[f64], factors: &DVector<f64>) -> DMatrix<f64> {
        curvature_of_sum(unknowns, factors.as_slice(), |point| self.evaluated(point))
    }
}

/// Returns the tolerance of softened evidence. Of an angle it does not depend on its value, which the axes of the ground choose.
fn softest(evidence: &Evidence) -> f64 {
    /// As a share of the size.
    const SOFT: f64 = 1e-3;
    SOFT * if evidence.of.period().is_some() { evidence.of.least_size() } else { evidence.size() }
}

/// Returns the second derivatives of a sum of values that are computed from the unknowns, each times a factor.
pub(super) fn curvature_of_sum(unknowns: &[f64], factors: &[f64], computed: impl Fn(&[HyperDual64]) -> Vec<HyperDual64>) -> DMatrix<f64> {
    let n = unknowns.len();
    let mut point: Vec<HyperDual64> = unknowns.iter().copied().map(HyperDual64::from).collect();
    let mut matrix = DMatrix::zeros(n, n);
    for i in 0..n {
        for k in i..n {
            (point[i].eps1, point[k].eps2) = (1.0, 1.0);
            let twice = computed(&point).iter().zip(factors).map(|(value, factor)| value.eps1eps2 * factor).sum();
            (matrix[(i, k)], matrix[(k, i)]) = (twice, twice);
            (point[i].eps1, point[k].eps2) = (0.0, 0.0);
        }
    }
    matrix
}

impl Residuals for Model<'_> {
    fn at(&self, unknowns: &[f64]) -> Option<Vec<f64>> {
        let residuals = self.residuals_at(unknowns)?;
        let rows = self.weights.whiten(DMatrix::from_vec(residuals.len(), 1, residuals));
        // Undefined values, such as the direction of a zero velocity, are excluded like impossible collisions.
        rows.iter().all(|residual| residual.is_finite()).then(|| rows.data.into())
    }

    fn jacobian(&self, unknowns: &[f64]) -> DMatrix<f64> {
        -self.weights.whiten(self.derivatives(unknowns))
    }

    fn residual_hessian(&self, unknowns: &[f64]) -> Option<DMatrix<f64>> {
        let residuals = DVector::from_vec(self.residuals_at(unknowns)?);
        Some(-self.curvature(unknowns, &self.weights.inverse_times(&residuals)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Output, Side};

    #[test]
    fn the_tolerance_of_an_angle_is_the_same_in_any_axes() {
        let softest = |of: Measurand, value: f64| softest(&Evidence { of, value, uncertainty: crate::reconstruct::Uncertainty::Exact });
        for value in [0.0, 0.4, -1.5, 3.1] {
            assert_eq!(softest(Measurand::SeparationDirection(Side::One), value), 1e-3);
            assert_eq!(softest(Measurand::Output(Output::PrincipalDirectionOfForce(Side::Two)), value), 1e-3);
        }
        assert_eq!(softest(Measurand::Output(Output::DeltaVMagnitude(Side::One)), 8.0), 8e-3);
    }
}
