//! The JSON document of `stiffness`.

use planar_impact::barrier::{CovarianceBasis, CrushModel, Estimate, FitFinding, Residual, StiffnessFit};
use planar_impact::crush::{CrushStiffness, ForceLine};
use serde::Serialize;

use super::given::TestFile;
use super::{Alone, Findings, Found, is_uncertain, predicted};
use crate::named::plain;
use crate::units::{Measure, Units};

#[derive(Serialize)]
pub struct Document<'a> {
    schema: u32,
    title: &'a str,
    tests: Vec<Test<'a>>,
    /// On mean depths and on the profiles; empty of one test.
    fits: Vec<Fit>,
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    notes: &'a [String],
}

#[derive(Serialize)]
struct Test<'a> {
    vehicle: &'a str,
    mean_depth: f64,
    /// With what the tests before have added.
    crush_energy: f64,
    equivalent_energy_speed: f64,
    /// E* = √(2 E_C/w).
    crush_intensity: f64,
    /// From this test alone and the assumed onset.
    #[serde(skip_serializing_if = "Option::is_none")]
    on_mean_depth: Option<Forms>,
    #[serde(skip_serializing_if = "Option::is_none")]
    on_profile: Option<Forms>,
}

#[derive(Serialize)]
struct Forms {
    d0: f64,
    d1: f64,
    #[serde(rename = "A")]
    force: f64,
    #[serde(rename = "B")]
    force_per_depth: f64,
    #[serde(rename = "G")]
    without_crush: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    b1: Option<f64>,
}

#[derive(Serialize)]
struct Fit {
    model: &'static str,
    #[serde(flatten)]
    forms: Forms,
    chi_square: f64,
    degrees_of_freedom: usize,
    residuals: Vec<Residuals>,
    /// `null` where neither the file nor the residuals tell the scatter.
    covariance: Option<Covariance>,
    #[serde(skip_serializing_if = "Option::is_none")]
    prediction: Option<Predicted>,
    findings: Vec<String>,
}

#[derive(Serialize)]
struct Residuals {
    observed: f64,
    fitted: f64,
    /// In standard deviations; `null` where the file gives none.
    standardised: Option<f64>,
}

#[derive(Serialize)]
struct Covariance {
    basis: &'static str,
    d0_d0: f64,
    d0_d1: f64,
    d1_d1: f64,
    d0_sd: f64,
    d1_sd: f64,
    correlation: f64,
}

#[derive(Serialize)]
struct Predicted {
    depth: f64,
    width: f64,
    crush_energy: f64,
    /// By the covariance alone.
    sd: Option<f64>,
}

impl<'a> Document<'a> {
    pub fn of(file: &'a TestFile, findings: &'a Findings) -> Self {
        let test = |found: &Found| Test {
            vehicle: &file.vehicles[found.vehicle].name,
            mean_depth: plain(found.test.crush.mean_depth()),
            crush_energy: found.crush_energy,
            equivalent_energy_speed: found.equivalent_energy_speed,
            crush_intensity: planar_impact::crush::crush_intensity(found.crush_energy, found.test.width()),
            on_mean_depth: found.alone.as_ref().map(|alone: &Alone| Forms { b1: Some(alone.line.slope), ..Forms::of(alone.line.into()) }),
            on_profile: found.alone.as_ref().map(|alone| Forms::of(alone.exact)),
        };
        Document {
            schema: 1,
            title: &file.title,
            tests: findings.tests.iter().map(test).collect(),
            fits: findings.fits.iter().map(|fit| Fit::of(file, fit)).collect(),
            notes: &findings.notes,
        }
    }
}

impl Forms {
    fn of(stiffness: CrushStiffness) -> Self {
        let force = ForceLine::from(stiffness);
        Forms {
            d0: plain(stiffness.onset),
            d1: plain(stiffness.slope),
            force: plain(force.onset),
            force_per_depth: plain(force.slope),
            without_crush: plain(stiffness.energy_without_crush()),
            b1: None,
        }
    }
}

impl Fit {
    fn of(file: &TestFile, fit: &StiffnessFit) -> Self {
        let uncertain = is_uncertain(file, fit);
        let residual = |residual: &Residual| Residuals {
            observed: plain(residual.observed),
            fitted: plain(residual.fitted),
            standardised: file.has_deviations.then(|| plain(residual.standardized())),
        };
        let covariance = || Covariance {
            basis: basis(fit.basis),
            d0_d0: fit.covariance.onset,
            d0_d1: fit.covariance.between,
            d1_d1: fit.covariance.slope,
            d0_sd: fit.onset().deviation(),
            d1_sd: fit.slope().deviation(),
            correlation: plain(fit.covariance.correlation()),
        };
        let prediction = file.prediction.as_ref().map(|asked| {
            let energy: Estimate = predicted(fit, asked);
            let sd = uncertain.then(|| plain(energy.deviation()));
            Predicted { depth: asked.depth, width: asked.width, crush_energy: plain(energy.value), sd }
        });
        Fit {
            model: model(fit.model),
            forms: Forms::of(fit.stiffness),
            chi_square: plain(fit.chi_square),
            degrees_of_freedom: fit.degrees_of_freedom,
            residuals: fit.residuals.iter().map(residual).collect(),
            covariance: uncertain.then(covariance),
            prediction,
            findings: fit.findings().iter().map(|finding| said(finding, Units::Si)).collect(),
        }
    }
}

/// What the crush was taken for.
pub fn model(model: CrushModel) -> &'static str {
    match model {
        CrushModel::MeanDepth => "mean depth",
        CrushModel::Profile => "profile",
    }
}

/// What the covariance is made of.
pub fn basis(basis: CovarianceBasis) -> &'static str {
    match basis {
        CovarianceBasis::Deviations => "standard deviations",
        CovarianceBasis::Residuals => "residuals",
    }
}

/// What a fit says that a stiffness should not, its numbers in some units.
pub fn said(finding: &FitFinding, units: Units) -> String {
    match finding {
        FitFinding::NegativeOnset(onset) => FitFinding::NegativeOnset(units.quantity(Measure::RootForce, *onset)).to_string(),
        FitFinding::NegativeSlope(slope) => FitFinding::NegativeSlope(units.quantity(Measure::RootForcePerLength, *slope)).to_string(),
        other => other.to_string(),
    }
}
