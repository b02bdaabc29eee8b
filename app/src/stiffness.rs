//! The verb `stiffness`: crush stiffness from barrier tests.

mod test_file;

use planar_impact::barrier::{
    BarrierTest, CovarianceBasis, CrushModel, FitFinding, MeasuredTest, Observations, Residual, StiffnessFit, TestIssue, TestIssues,
    TestSeries,
};
use planar_impact::crush::{CrushStiffness, ForceLine, crush_intensity};
use planar_impact::{InputIssue, InputIssueKind, Issue as _};
use schemars::JsonSchema;
use serde::Serialize;

use crate::answer::Answer;
use crate::control::Control;
use crate::issue::{Issue, Issues};
use crate::message::{Message, Sentence};
use crate::named::positive_zero;
use crate::notice::Notice;
use crate::units::Measure;

pub use test_file::{Prediction, TestFile, Tested};

/// Barrier tests with the stiffness fitted to them, in SI.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct StiffnessAnswer {
    /// The tests in the order of the file.
    pub tests: Vec<Test>,
    /// Fits on mean depths and on the profiles; empty for one test.
    pub fits: Vec<Fit>,
    /// `true` if the file gives standard deviations.
    pub has_deviations: bool,
}

/// A barrier test.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Test {
    /// The name of the vehicle.
    pub vehicle: String,
    /// Speed of the test in m/s.
    pub speed: f64,
    /// Coefficient of restitution.
    pub restitution: f64,
    /// Mean depth of the crush in m.
    pub mean_depth: f64,
    /// Crush energy in J, including that of earlier tests of the same vehicle.
    pub crush_energy: f64,
    /// Speed at which the crush energy is the vehicle's kinetic energy, in m/s.
    pub equivalent_energy_speed: f64,
    /// E* = √(2 E_C/w) in √N.
    pub crush_intensity: f64,
    /// Stiffness computed from the mean depth of this test alone and the assumed onset.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub on_mean_depth: Option<Forms>,
    /// Stiffness computed from its profile.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub on_profile: Option<Forms>,
}

/// A stiffness in its equivalent forms.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Forms {
    /// d0 in √N.
    pub d0: f64,
    /// d1 in √N/m.
    pub d1: f64,
    /// A = d0 d1 in N/m.
    #[serde(rename = "A")]
    pub force: f64,
    /// B = d1² in N/m².
    #[serde(rename = "B")]
    pub force_per_depth: f64,
    /// G = d0²/2 in N.
    #[serde(rename = "G")]
    pub without_crush: f64,
    /// Slope b1 of the barrier speed against the crush, in 1/s.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub b1: Option<f64>,
}

/// A stiffness fitted to all tests.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Fit {
    /// Representation of the crush: `mean depth` or `profile`.
    pub model: &'static str,
    /// The stiffness.
    #[serde(flatten)]
    pub forms: Forms,
    /// Sum of the squares of the standardised residuals.
    pub chi_square: f64,
    /// Number of tests minus two.
    pub degrees_of_freedom: usize,
    /// E* of each test compared with the fit.
    pub residuals: Vec<Residuals>,
    /// Covariance of d0 and d1; `null` where neither the file nor the residuals give the scatter.
    pub covariance: Option<Covariance>,
    /// Crush energy of the depth and width under `[fit]`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub prediction: Option<Predicted>,
    /// Implausible properties of this stiffness.
    pub findings: Vec<Sentence>,
}

/// E* of a test compared with a fit.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Residuals {
    /// E* of the test in √N.
    pub observed: f64,
    /// E* of the fit in √N.
    pub fitted: f64,
    /// Observed minus fitted, in √N.
    pub difference: f64,
    /// The difference in standard deviations; `null` where the file gives none.
    pub standardised: Option<f64>,
}

/// Covariance of d0 and d1.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Covariance {
    /// Its source: `standard deviations` of the file, or `residuals`.
    pub basis: &'static str,
    /// Variance of d0 in N.
    pub d0_d0: f64,
    /// Covariance of d0 and d1 in N/m.
    pub d0_d1: f64,
    /// Variance of d1 in N/m².
    pub d1_d1: f64,
    /// Standard deviation of d0 in √N.
    pub d0_sd: f64,
    /// Standard deviation of d1 in √N/m.
    pub d1_sd: f64,
    /// Correlation of d0 and d1.
    pub correlation: f64,
}

/// Crush energy of a flat crush predicted by a fit.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Predicted {
    /// Its depth in m.
    pub depth: f64,
    /// Its width in m.
    pub width: f64,
    /// Crush energy in J.
    pub crush_energy: f64,
    /// Its standard deviation from the covariance, in J; `null` without one.
    pub sd: Option<f64>,
}

/// Fits crush stiffness to barrier tests.
///
/// # Errors
///
/// Every reason for which the tests do not determine a stiffness.
pub fn stiffness(file: &TestFile, _: &(), _: &dyn Control) -> Result<Answer<StiffnessAnswer>, Issues> {
    if file.onset.is_none() && file.count() < 2 {
        let help = "give a second test, or assume the speed that leaves no crush: onset = \"2 m/s\" under [fit]";
        return Err(file.unfit([Issue::at("too-few", "vehicle", "one test cannot determine stiffness").with_help(help)]));
    }
    fit(file).map_err(|problems| file.unfit(problems.iter().map(issue)))
}

fn fit(file: &TestFile) -> Result<Answer<StiffnessAnswer>, Vec<TestIssue>> {
    let series: Vec<&[MeasuredTest]> = file.vehicles.iter().map(|vehicle| vehicle.tests.as_slice()).collect();
    let all = |problems: TestIssues| problems.as_slice().to_vec();
    let observations = Observations::of_tests(&series).map_err(all)?;
    let (mut tests, mut problems) = (Vec::with_capacity(file.count()), Vec::new());
    for (i, (vehicle, measured)) in file.vehicles.iter().zip(&series).enumerate() {
        let series = TestSeries::new(measured.iter().map(|measured| measured.test).collect::<Vec<_>>()).map_err(all)?;
        let numbers = series.crush_energies().into_iter().zip(series.equivalent_energy_speeds());
        for (k, (test, (crush_energy, equivalent_energy_speed))) in series.tests().iter().zip(numbers).enumerate() {
            let mut test = Test::of(&vehicle.name, test, crush_energy, equivalent_energy_speed);
            if let Some(onset) = file.onset.filter(|_| k == 0)
                && let Err(wrong) = test.alone(&measured[k].test, onset)
            {
                problems.extend(all(wrong.of_test(i, k)));
            }
            tests.push(test);
        }
    }
    let mut notices = file.notices.clone();
    let both = || -> Result<_, TestIssues> {
        Ok(vec![fitted(file, &observations, CrushModel::MeanDepth)?, fitted(file, &observations, CrushModel::Profile)?])
    };
    let fits = match both() {
        _ if file.count() < 2 => Vec::new(),
        Ok(fits) => fits,
        Err(wrong) if file.onset.is_some() && matches!(wrong.as_slice(), [TestIssue::OneDepth { .. }]) => {
            let message = "all tests have the same mean depth: no line can be fitted through them";
            notices.0.push(Notice::note("one-depth", "vehicle", message));
            Vec::new()
        }
        Err(wrong) => {
            problems.extend(all(wrong));
            Vec::new()
        }
    };
    if !problems.is_empty() {
        return Err(problems);
    }
    let fits = fits.iter().map(|fit| Fit::of(file, fit)).collect();
    Ok(Answer::new(&file.title, StiffnessAnswer { tests, fits, has_deviations: file.has_deviations }, notices))
}

/// Fits the stiffness to the tests of a file.
fn fitted(file: &TestFile, observations: &Observations, model: CrushModel) -> Result<StiffnessFit, TestIssues> {
    let fit = match model {
        CrushModel::MeanDepth => StiffnessFit::on_mean_depth(observations)?,
        CrushModel::Profile => StiffnessFit::on_profiles(observations)?,
    };
    // Without standard deviations all tests have equal weight, and only the residuals give the scatter.
    Ok(if file.has_deviations { fit } else { fit.rescaled().unwrap_or(fit) })
}

impl TestFile {
    /// Fits the stiffness to two or more tests.
    ///
    /// # Errors
    ///
    /// Every reason for which the tests do not determine a stiffness.
    pub(crate) fn fit(&self, model: CrushModel) -> Result<StiffnessFit, Issues> {
        let series: Vec<&[MeasuredTest]> = self.vehicles.iter().map(|vehicle| vehicle.tests.as_slice()).collect();
        let fit = Observations::of_tests(&series).and_then(|observations| fitted(self, &observations, model));
        fit.map_err(|problems| self.unfit(problems.as_slice().iter().map(issue)))
    }

    /// Returns `true` if the file or the residuals of a fit give the scatter of the tests.
    pub(crate) fn is_uncertain(&self, fit: &StiffnessFit) -> bool {
        self.has_deviations || fit.degrees_of_freedom > 0
    }
}

impl Test {
    fn of(vehicle: &str, test: &BarrierTest, crush_energy: f64, equivalent_energy_speed: f64) -> Self {
        Test {
            vehicle: vehicle.to_owned(),
            speed: test.speed,
            restitution: test.restitution,
            mean_depth: positive_zero(test.crush.mean_depth()),
            crush_energy,
            equivalent_energy_speed,
            crush_intensity: crush_intensity(crush_energy, test.width()),
            on_mean_depth: None,
            on_profile: None,
        }
    }

    /// Adds the stiffness computed from this test alone and an assumed onset.
    fn alone(&mut self, test: &BarrierTest, onset: f64) -> Result<(), TestIssues> {
        let (line, exact) = (test.speed_line(onset)?, test.stiffness(onset)?);
        self.on_mean_depth = Some(Forms { b1: Some(line.slope), ..Forms::of(line.into()) });
        self.on_profile = Some(Forms::of(exact));
        Ok(())
    }
}

impl Forms {
    fn of(stiffness: CrushStiffness) -> Self {
        let force = ForceLine::from(stiffness);
        Forms {
            d0: positive_zero(stiffness.onset),
            d1: positive_zero(stiffness.slope),
            force: positive_zero(force.onset),
            force_per_depth: positive_zero(force.slope),
            without_crush: positive_zero(stiffness.energy_without_crush()),
            b1: None,
        }
    }
}

impl Fit {
    fn of(file: &TestFile, fit: &StiffnessFit) -> Self {
        let is_uncertain = file.is_uncertain(fit);
        let residual = |residual: &Residual| Residuals {
            observed: positive_zero(residual.observed),
            fitted: positive_zero(residual.fitted),
            difference: positive_zero(residual.difference()),
            standardised: file.has_deviations.then(|| positive_zero(residual.standardized())),
        };
        let covariance = || Covariance {
            basis: match fit.basis {
                CovarianceBasis::Deviations => "standard deviations",
                CovarianceBasis::Residuals => "residuals",
            },
            d0_d0: fit.covariance.onset,
            d0_d1: fit.covariance.between,
            d1_d1: fit.covariance.slope,
            d0_sd: fit.onset().deviation(),
            d1_sd: fit.slope().deviation(),
            correlation: positive_zero(fit.covariance.correlation()),
        };
        let prediction = file.prediction.as_ref().map(|asked| {
            let energy = fit.energy_at(asked.depth, asked.width);
            let sd = is_uncertain.then(|| positive_zero(energy.deviation()));
            Predicted { depth: asked.depth, width: asked.width, crush_energy: positive_zero(energy.value), sd }
        });
        Fit {
            model: match fit.model {
                CrushModel::MeanDepth => "mean depth",
                CrushModel::Profile => "profile",
            },
            forms: Forms::of(fit.stiffness),
            chi_square: positive_zero(fit.chi_square),
            degrees_of_freedom: fit.degrees_of_freedom,
            residuals: fit.residuals.iter().map(residual).collect(),
            covariance: is_uncertain.then(covariance),
            prediction,
            findings: fit.findings().iter().map(|finding| Sentence(message(finding))).collect(),
        }
    }
}

/// Describes an implausible property of a stiffness.
pub(crate) fn message(finding: &FitFinding) -> Message {
    let negative = |name: &'static str, measure, value| Message::from(name).text(" is ").figure(measure, value).text(", below zero: ");
    match finding {
        FitFinding::NegativeOnset(onset) => negative("d0", Measure::RootForce, *onset).text("the tests would leave crush at no energy"),
        FitFinding::NegativeSlope(slope) => {
            negative("d1", Measure::RootForcePerLength, *slope).text("the structure would take less energy the deeper it is crushed")
        }
        other => other.to_string().into(),
    }
}

/// Locates an issue of the library at its key in the file.
fn issue(issue: &TestIssue) -> Issue {
    let help = match issue {
        TestIssue::Input(InputIssue { kind: InputIssueKind::OutOfOrder { .. }, .. }) => {
            Some("list the tests of one vehicle in their order, each with all its crush")
        }
        TestIssue::OneDepth { .. } | TestIssue::Input(InputIssue { kind: InputIssueKind::TooFew { .. }, .. }) => {
            Some("or assume an onset: onset = \"2 m/s\" under [fit]")
        }
        TestIssue::Input(InputIssue { at, .. }) if ["variance", "pivot of the covariance"].contains(&at.name) => {
            Some("the standard deviations leave no doubt of E*: give a scatter above zero")
        }
        _ => None,
    };
    // The path gives its place, counted from 1.
    let message = match issue {
        TestIssue::Input(issue) => issue.sentence(issue.at.name),
        other => other.message(),
    };
    Issue { help: help.map(Message::from), ..Issue::at(issue.code(), path(issue), message) }
}

/// Returns the path in the file that an issue refers to.
fn path(issue: &TestIssue) -> String {
    let place = match (issue, issue.place()) {
        (TestIssue::OnsetTooFast { .. }, _) => return "fit.onset".to_owned(),
        (_, Some(place)) => place,
        (_, None) => return "vehicle".to_owned(),
    };
    let (Some(series), Some(index)) = (place.series, place.index) else {
        return "vehicle".to_owned();
    };
    let key = match place.name {
        "mass" | "speed" | "restitution" | "width" | "scatter" => format!(".{}", place.name),
        "speed_deviation" => ".speed_sd".to_owned(),
        "restitution_deviation" => ".restitution_sd".to_owned(),
        "mean depth" => ".depths".to_owned(),
        _ => String::new(),
    };
    format!("vehicle.{}.test.{}{key}", series + 1, index + 1)
}
