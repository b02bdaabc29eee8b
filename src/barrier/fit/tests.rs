use super::super::{CrushEnergy, Observation, TestIssue};
use super::*;
use crate::issue::{InputIssue, Place};
use approx::assert_relative_eq;

fn flat(depth: f64, intensity: f64, deviation: f64) -> Observation {
    Observation { crush: ProfileMoments::of(2.0, &[depth, depth]).expect("two depths"), intensity, deviation }
}

fn fit(observations: &[Observation]) -> StiffnessFit {
    StiffnessFit::on_mean_depth(&Observations::independent(observations).expect("good numbers")).expect("two depths")
}

#[test]
fn the_struble_welsh_series() {
    // Table B2: cumulative crush energies in ft lb and mean depths in ft, on 5 ft; equal deviations of E*.
    let series = [(13674.0, 0.1062), (56876.0, 0.5203), (125102.0, 1.0768)].map(|(energy, depth): (f64, f64)| {
        let crush = ProfileMoments::of(5.0, &[depth, depth]).expect("two depths");
        CrushEnergy { crush, energy, deviation: (10.0 * energy).sqrt() }
    });
    let fit = StiffnessFit::on_mean_depth(&Observations::of_energies(&series).expect("good numbers")).expect("three depths");
    // The line of plain least squares by hand: 62.640256793 √lbf and 152.977362606 √lbf/ft, residuals −4.92971, 8.59798, −3.66827.
    assert_relative_eq!(fit.stiffness.onset, 62.640256793, max_relative = 1e-9);
    assert_relative_eq!(fit.stiffness.slope, 152.977362606, max_relative = 1e-9);
    for (residual, expected) in fit.residuals.iter().zip([-4.92971, 8.59798, -3.66827]) {
        assert_relative_eq!(residual.difference(), expected, max_relative = 1e-5);
        assert_relative_eq!(residual.standardized(), expected, max_relative = 1e-5); // σ(E*) = √(10 E)/√(2 w E) = 1
    }
    // The pair of Table B2, 48.27 and 162.8, is below every one of these tests but the last, which it meets.
    let table = CrushStiffness { onset: 48.27, slope: 162.8 };
    let short: [f64; 3] = core::array::from_fn(|i| fit.residuals[i].observed - table.crush_intensity(fit.residuals[i].crush.mean_depth()));
    assert!(short[0] > 8.0 && short[1] > 17.0 && short[2].abs() < 0.2, "{short:?}");
    // One degree of freedom, and a scatter of 10.6 √lbf by it.
    let told = fit.rescaled().expect("one degree of freedom");
    assert_eq!((told.basis, told.degrees_of_freedom), (CovarianceBasis::Residuals, 1));
    assert_relative_eq!(told.covariance.slope, fit.covariance.slope * fit.chi_square, max_relative = 1e-12);
    assert_relative_eq!(fit.chi_square, 4.92971_f64.powi(2) + 8.59798_f64.powi(2) + 3.66827_f64.powi(2), max_relative = 1e-5);
    assert_eq!(told.rescaled(), Some(told));
}

#[test]
fn weights_pull_and_the_covariance_knows_them() {
    // By hand: at depths 0, 1, 1 with deviations 1, 1, 2: the two at 1 weigh 1 and ¼, so their mean is (10 + ¼ 20)/1¼ = 12 with variance 0.8.
    let fit = fit(&[flat(0.0, 4.0, 1.0), flat(1.0, 10.0, 1.0), flat(1.0, 20.0, 2.0)]);
    assert_relative_eq!(fit.stiffness.onset, 4.0, max_relative = 1e-14);
    assert_relative_eq!(fit.stiffness.slope, 8.0, max_relative = 1e-14);
    assert_relative_eq!(fit.covariance.onset, 1.0, max_relative = 1e-14);
    assert_relative_eq!(fit.covariance.slope, 1.8, max_relative = 1e-14);
    assert_relative_eq!(fit.covariance.between, -1.0, max_relative = 1e-14);
    assert_relative_eq!(fit.covariance.correlation(), -1.0 / 1.8_f64.sqrt(), max_relative = 1e-14);
    assert_relative_eq!(fit.chi_square, 4.0 + 16.0, max_relative = 1e-14);
    // E_C = ½ w (E*)², so σ(E_C) = w E* σ(E*) = 2 · 12 · √0.8 at depth 1.
    assert_relative_eq!(fit.intensity_at(1.0).variance, 0.8, max_relative = 1e-13);
    let energy = fit.energy_at(1.0, 2.0);
    assert_relative_eq!(energy.value, 144.0, max_relative = 1e-14);
    assert_relative_eq!(energy.variance, 24.0 * 24.0 * 0.8, max_relative = 1e-13);
}

#[test]
fn what_a_stiffness_should_not_be_is_found_and_kept() {
    let falling = fit(&[flat(0.1, 10.0, 1.0), flat(0.2, 8.0, 1.0)]);
    assert_relative_eq!(falling.stiffness.slope, -20.0, max_relative = 1e-13);
    let findings = falling.findings();
    assert!(matches!(findings[..], [FitFinding::NegativeSlope(_), FitFinding::NoFreedom]), "{findings:?}");
    assert!(alloc::string::ToString::to_string(&findings[0]).contains("d1 is -"));
    assert_eq!(falling.rescaled(), None);
    let steep = fit(&[flat(0.1, 1.0, 1.0), flat(0.2, 8.0, 1.0), flat(0.3, 15.0, 1.0)]);
    assert!(matches!(steep.findings()[..], [FitFinding::NegativeOnset(onset)] if (onset + 6.0).abs() < 1e-12));
}

#[test]
fn two_ragged_profiles_can_have_two_answers() {
    let crushes = [[0.2, 0.6, 0.1], [0.0, 0.0, 0.7]].map(|depths| ProfileMoments::of(1.0, &depths).expect("three depths"));
    let truth = CrushStiffness { onset: 0.0, slope: 1.0 };
    let observe = |crush: ProfileMoments| Observation { crush, intensity: profile_fit::intensity(&truth, &crush), deviation: 1.0 };
    let observations = Observations::independent(&crushes.map(observe)).expect("good numbers");
    let other = StiffnessFit::on_profiles(&observations).expect("it settles");
    assert!(other.chi_square < 1e-24, "{}", other.chi_square);
    // Where the two ellipses of Eq 4 meet again.
    assert_relative_eq!(other.stiffness.onset, 0.0643747906, max_relative = 1e-8);
    assert_relative_eq!(other.stiffness.slope, 0.8460686767, max_relative = 1e-8);
}

#[test]
fn a_line_needs_two_different_depths() {
    let refused = |observations: &[Observation]| {
        let observations = Observations::independent(observations).expect("good numbers");
        let line = StiffnessFit::on_mean_depth(&observations).expect_err("no line");
        assert_eq!(line, StiffnessFit::on_profiles(&observations).expect_err("no line"));
        line.as_slice().to_vec()
    };
    assert_eq!(refused(&[]), [InputIssue::too_few(Place::plain("tests"), 0, 2).into()]);
    assert_eq!(refused(&[flat(0.1, 1.0, 1.0)]), [InputIssue::too_few(Place::plain("tests"), 1, 2).into()]);
    assert_eq!(refused(&[flat(0.5, 1.0, 1.0), flat(0.5, 2.0, 1.0)]), [TestIssue::OneDepth { depth: 0.5 }]);
    // Different by rounding is not different.
    let same = refused(&[flat(0.3, 1.0, 1.0), flat(0.1 + 0.2, 2.0, 1.0)]);
    assert!(matches!(same[..], [TestIssue::OneDepth { .. }]), "{same:?}");
    assert_eq!(refused(&[flat(0.0, 1.0, 1.0), flat(0.0, 2.0, 1.0)]), [TestIssue::OneDepth { depth: 0.0 }]);
    let bad = Observations::independent(&[flat(0.1, -1.0, 0.0), flat(f64::NAN, 1.0, f64::INFINITY)]).expect_err("bad numbers");
    assert_eq!(bad.len(), 5);
}

/// Two uneven profiles of nearly one mean depth and other energies: no stiffness has both, and the best lies where d₀ and d₁ do the same to each.
#[test]
fn profiles_that_do_not_tell_the_coefficients_apart_have_no_fit() {
    let observe =
        |depths: &[f64], intensity| Observation { crush: ProfileMoments::of(1.5, depths).expect("six depths"), intensity, deviation: 10.0 };
    let uneven = [observe(&[0.43, 0.49, 0.0, 0.17, 0.12, 0.0], 230.85), observe(&[0.49, 0.0, 0.12, 0.38, 0.16, 0.29], 404.77)];
    let two = Observations::independent(&uneven).expect("good numbers");
    let issues = StiffnessFit::on_profiles(&two).expect_err("one direction is free");
    assert_eq!(issues.as_slice(), [TestIssue::Undetermined]);
    // A third of another depth tells them apart, though it fits no better.
    let three = Observations::independent(&[uneven[0], uneven[1], observe(&[0.6; 6], 500.0)]).expect("good numbers");
    let fit = StiffnessFit::on_profiles(&three).expect("it settles");
    assert!(fit.covariance.onset > 0.0 && fit.covariance.slope > 0.0, "{:?}", fit.covariance);
}

#[test]
fn of_flat_profiles_both_models_are_one() {
    let observations = Observations::independent(&[flat(0.1, 5.0, 1.0), flat(0.2, 9.0, 2.0), flat(0.4, 12.0, 1.0)]).expect("good numbers");
    let (line, profiles) = (StiffnessFit::on_mean_depth(&observations), StiffnessFit::on_profiles(&observations));
    let (line, profiles) = (line.expect("three depths"), profiles.expect("it settles"));
    assert_relative_eq!(line.stiffness.onset, profiles.stiffness.onset, max_relative = 1e-12);
    assert_relative_eq!(line.stiffness.slope, profiles.stiffness.slope, max_relative = 1e-12);
    assert_relative_eq!(line.covariance.slope, profiles.covariance.slope, max_relative = 1e-12);
    assert_relative_eq!(line.covariance.between, profiles.covariance.between, max_relative = 1e-12);
    assert_eq!((line.model, profiles.model), (CrushModel::MeanDepth, CrushModel::Profile));
}

#[test]
fn with_its_onset_held_a_fit_has_one_coefficient() {
    // By hand: depths 1, 2 with deviations 1, 2 above an onset of 4: d1 = (6 + 2 · 16/4)/(1 + 4/4) = 7, variance ½, and residuals −1 and 2.
    let observations = Observations::independent(&[flat(1.0, 10.0, 1.0), flat(2.0, 20.0, 2.0)]).expect("good numbers");
    for model in [CrushModel::MeanDepth, CrushModel::Profile] {
        let fit = StiffnessFit::with_onset(&observations, 4.0, model).expect("two depths");
        assert_relative_eq!(fit.stiffness.slope, 7.0, max_relative = 1e-14);
        assert_eq!((fit.stiffness.onset, fit.covariance.onset, fit.covariance.between, fit.degrees_of_freedom), (4.0, 0.0, 0.0, 1));
        assert_relative_eq!(fit.covariance.slope, 0.5, max_relative = 1e-14);
        assert_relative_eq!(fit.chi_square, 2.0, max_relative = 1e-13);
    }
    let uneven = [(0.2, 0.9, 7.0), (0.5, 0.1, 4.0), (1.2, 0.4, 11.0)].map(|(one, other, intensity)| Observation {
        crush: ProfileMoments::of(2.0, &[one, other]).expect("two depths"),
        intensity,
        deviation: 1.0,
    });
    let observations = Observations::independent(&uneven).expect("good numbers");
    let best = StiffnessFit::with_onset(&observations, 3.0, CrushModel::Profile).expect("it converges");
    let chi_square = |slope: f64| {
        let intensity = |crush: &ProfileMoments| (CrushStiffness { onset: 3.0, slope }.crush_energy(*crush) / crush.first).sqrt();
        uneven.iter().map(|each| (each.intensity - intensity(&each.crush)).powi(2)).sum::<f64>()
    };
    let slope = best.stiffness.slope;
    assert_relative_eq!(best.chi_square, chi_square(slope), max_relative = 1e-12);
    assert!(chi_square(slope + 1e-4) > best.chi_square && chi_square(slope - 1e-4) > best.chi_square);
    let none = Observations::independent(&[flat(0.0, 10.0, 1.0)]).expect("good numbers");
    assert_eq!(StiffnessFit::with_onset(&none, 4.0, CrushModel::MeanDepth).expect_err("no depth").len(), 1);
}
