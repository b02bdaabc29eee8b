//! The evidence as a least-squares problem within the limits of the physics, with or without a fixed quantity.

use nalgebra::{DMatrix, DVector};

use super::limit::{Limit, Margins};
use super::measurand::Measurand;
use super::piece::Piece;
use super::placed::Placed;
use super::residuals::{Model, curvature_of_sum};
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
    let impact = margins.piece().impact_of(&placed, &contact);
    let mut all = model.compared(point, &placed, &impact);
    all.extend(margins.of(&placed, &contact, &impact));
    all.extend(fixed.map(|fixed| model.value(fixed.of, point, &placed, &impact).unwrap_or_else(|| T::int(0))));
    all
}

impl<'a> WithinLimits<'a> {
    /// Sets up the problem on the side of a collision that the mechanics accepts, that at a point.
    pub(super) fn around(model: &'a Model<'a>, point: &[f64], placed: &Placed<f64>, impact: &Impact) -> Self {
        WithinLimits { model, margins: Margins::around(model, point, placed, impact), fixed: None }
    }

    /// Holds a quantity at a value.
    pub(super) fn hold(&mut self, fixed: Option<Fixed>) {
        self.fixed = fixed;
    }

    /// Keeps to a piece of the mechanics, up to its edges.
    pub(super) fn keep_to(&mut self, piece: Piece) {
        self.margins.within(piece);
    }

    /// Lets the vehicles lie the other way round along the normal.
    pub(super) fn turn_round(&mut self) {
        self.margins.turn_round();
    }

    /// Returns the piece beyond each edge that a point is on.
    pub(super) fn beyond(&self, unknowns: &[f64]) -> Vec<Piece> {
        self.at(unknowns).map_or_else(Vec::new, |local| self.margins.beyond(local.margins.as_slice()).collect())
    }

    /// Returns `true` where the vehicles approach each other as slowly as they may.
    pub(super) fn hardly_closes(&self, unknowns: &[f64]) -> bool {
        /// Largest margin, a share of a significant velocity, that is none.
        const NONE: f64 = 1e-6;
        // The first margin is that of the approach velocity, if there is one.
        self.limit(0) == Some(Limit::Closing) && self.at(unknowns).is_some_and(|local| local.margins[0].abs() < NONE)
    }

    /// Returns the limit of the physics whose distance a margin is, if it is one.
    pub(super) fn limit(&self, margin: usize) -> Option<Limit> {
        self.margins.limit(margin)
    }

    /// Returns the slopes of some margins by the unknowns, a row for each. An edge of a piece, whichever, is the nearest one about sticking.
    pub(super) fn margin_slopes(&self, unknowns: &[f64], margins: &[usize]) -> DMatrix<f64> {
        let none = || DMatrix::zeros(0, unknowns.len());
        if margins.is_empty() {
            return none();
        }
        let mut about_sticking = WithinLimits { model: self.model, margins: self.margins.clone(), fixed: None };
        about_sticking.keep_to(Piece::Sticks);
        let Some(local) = about_sticking.at(unknowns) else { return none() };
        let limits = (0..local.margins.len()).filter(|k| self.limit(*k).is_some()).count();
        let edge = (limits..local.margins.len()).min_by(|one, other| local.margins[*one].abs().total_cmp(&local.margins[*other].abs()));
        let rows: Vec<usize> = margins.iter().filter_map(|k| if *k < limits { Some(*k) } else { edge }).collect();
        local.margin_slopes.select_rows(&rows)
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
        let (values, slopes) = self.model.with_slopes(unknowns, |point| computed(self.model, &self.margins, self.fixed, point));
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input::{Input, Side};
    use crate::reconstruct::{ReconstructionProblem, Uncertainty, Variable};
    use crate::{Collision, Heading, ImpulseRatio, Vehicle};

    /// A car meets a wall at an angle to its normal, with an unknown ratio. One of zero is possible at any angle, so that either sign begins there.
    #[test]
    fn ratios_of_either_sign_meet_at_zero() {
        let car = Vehicle::new(1400.0, 2500.0).with_impact_center(2.0, 0.0).with_speed(15.0);
        let collision = Collision::new(car, crate::Party::Barrier).with_impulse_ratio(ImpulseRatio::Given(0.0));
        let problem = ReconstructionProblem::of(collision)
            .unknown(Variable::Input(Input::CrushPlane), 0.0)
            .unknown(Variable::Input(Input::ImpulseRatio), 0.0);
        let model = Model::of(&problem);
        for (plane, ratio, piece, beyond) in [
            (0.1, -0.01, -1, None),
            (-0.1, 0.01, 1, None),
            (0.1, 0.0, -1, Some(1)),
            (-0.1, 0.0, 1, Some(-1)),
            (0.0, 0.0, 1, Some(-1)),
            (1e-5, -1e-6, -1, Some(1)),
            (-1e-5, 1e-6, 1, Some(-1)),
        ] {
            let (placed, impact) = model.solve(&[plane, ratio]).expect("possible");
            let own = Piece::of(&placed);
            assert_eq!((own, own.all()), (Piece::OfRatio(piece), &[Piece::OfRatio(1), Piece::OfRatio(-1)][..]), "{plane} {ratio}");
            let mut limited = WithinLimits::around(&model, &[plane, ratio], &placed, &impact);
            assert!(limited.at(&[plane, ratio]).expect("possible").margins.iter().all(|margin| *margin >= -1e-7), "{plane} {ratio}");
            limited.keep_to(own);
            assert_eq!(limited.beyond(&[plane, ratio]), Vec::from_iter(beyond.map(Piece::OfRatio)), "{plane} {ratio}");
        }
    }

    /// Zero of the sticking impulse is none, whether or not sticking would pull; an unknown share may be more.
    #[test]
    fn a_fixed_share_of_zero_asks_for_no_sticking_impulse() {
        let car = Vehicle::new(1400.0, 2500.0).with_impact_center(2.0, 0.3).with_speed(15.0);
        let pushes = |share: f64, unknown: Variable, at: f64| {
            let collision = Collision::new(car, crate::Party::Barrier).with_impulse_ratio(ImpulseRatio::OfCritical(share));
            let problem = ReconstructionProblem::of(collision).unknown(unknown, at);
            let model = Model::of(&problem);
            let (placed, impact) = model.solve(&[at]).expect("possible");
            let limited = WithinLimits::around(&model, &[at], &placed, &impact);
            let margins = limited.at(&[at]).expect("possible").margins.len();
            (0..margins).filter(|margin| limited.limit(*margin) == Some(Limit::Tension)).count()
        };
        let (speed, share) = (Variable::Speed(Side::One), Variable::Input(Input::ImpulseRatio));
        assert_eq!([pushes(0.0, speed, 15.0), pushes(0.5, speed, 15.0), pushes(0.5, share, 0.0), pushes(0.5, share, 0.4)], [1, 2, 2, 2]);
    }

    /// The gradient of ½χ² less the margins and the fixed quantity, each times its multiplier, changes by the curvature of Gauss and Newton and the bend.
    #[test]
    fn the_bend_is_what_gauss_and_newton_leave_out() {
        const STEP: f64 = 1e-5;
        let car = |mass: f64, left: f64| Vehicle::new(mass, 1.8 * mass).with_impact_center(1.9, left);
        let two = car(1300.0, -0.2).with_heading(Heading::from_angle(2.6)).with_speed(11.0);
        let collision =
            Collision::new(car(1600.0, 0.4).with_speed(14.0), two).with_restitution(0.1).with_impulse_ratio(ImpulseRatio::OfCritical(0.8));
        let problem = ReconstructionProblem::of(collision)
            .unknown(Variable::Speed(Side::One), 14.0)
            .unknown(Variable::Input(Input::CrushPlane), 0.1)
            .evidence(Measurand::CrushEnergy, 9e4, Uncertainty::StandardDeviation(5e3))
            .evidence(Measurand::DeltaVForward(Side::Two), -9.0, Uncertainty::StandardDeviation(0.5));
        let model = Model::of(&problem);
        let unknowns = [14.0, 0.1];
        let (placed, impact) = model.solve(&unknowns).expect("possible");
        let mut limited = WithinLimits::around(&model, &unknowns, &placed, &impact);
        limited.hold(Some(Fixed { of: Measurand::SeparationSpeed(Side::One), value: 5.0, scale: 0.25, period: None }));
        let at = |unknowns: &[f64]| limited.at(unknowns).expect("possible");
        let margins: Vec<f64> = (0..at(&unknowns).margins.len()).map(|k| 3.0 + k as f64).collect();
        let gradient = |unknowns: &[f64]| {
            let local = at(unknowns);
            local.jacobian.tr_mul(&local.residuals)
                - local.margin_slopes.tr_mul(&DVector::from_column_slice(&margins))
                - local.fixed_slopes.tr_mul(&DVector::from_element(1, 7.0))
        };
        let here = at(&unknowns);
        let curvature = here.jacobian.tr_mul(&here.jacobian) + limited.bend(&unknowns, &margins, &[7.0]);
        for k in 0..2 {
            let moved = |by: f64| [0, 1].map(|i| if i == k { unknowns[i] + by } else { unknowns[i] });
            let difference = (gradient(&moved(STEP)) - gradient(&moved(-STEP))) / (2.0 * STEP);
            assert!((difference - curvature.column(k)).amax() < 1e-6 * curvature.amax(), "{k}: {curvature}");
        }
    }
}
