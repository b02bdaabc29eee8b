//! The verb `stiffness`: crush stiffness from barrier tests.

mod pooled;
mod series;
mod test_file;

use planar_impact::barrier::{
    BarrierTest, CovarianceBasis, CrushModel, FitFinding, Residual, StiffnessFit, TestIssue, TestIssues, TestSeries,
};
use planar_impact::crush::{CrushStiffness, ForceLine, crush_intensity};
use planar_impact::{Distribution, Issue as _};
use schemars::JsonSchema;
use serde::Serialize;

use crate::answer::Answer;
use crate::control::Control;
use crate::issue::{Issue, Issues};
use crate::message::{Message, Sentence};
use crate::named::positive_zero;
use crate::notice::Notice;
use crate::units::Measure;
use crate::unusual;
use crate::wording::degrees_of_freedom;

use series::Unfitted;

pub(crate) use pooled::{FurtherVehicle, wider_than_normal};
pub use pooled::{OfVehicle, Pooled, PooledNumber};
pub use test_file::{Prediction, TestFile, Tested};

/// Number of steps between the points of a fitted line.
const LINE_STEPS: usize = 22;
/// End of a fitted line, as a multiple of the deepest mean crush.
const BEYOND_DEEPEST: f64 = 1.1;

/// Barrier tests with the stiffness fitted to them, in SI.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct StiffnessAnswer {
    /// The tests in the order of the file.
    pub tests: Vec<Test>,
    /// Why the fits are no stiffness, or may not be one; empty if they are.
    pub headlines: Vec<Sentence>,
    /// Fits on mean depths and on the profiles; empty for one test, unless the file holds b0.
    pub fits: Vec<Fit>,
    /// The same with each test as that of a new car, for vehicles whose tests cannot be repeated tests of one car; absent unless there are such vehicles.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    #[schemars(default)]
    pub fits_as_new_cars: Vec<Fit>,
    /// The stiffness of the class, if two or more vehicles have a stiffness of their own.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    #[schemars(default)]
    pub pooled: Vec<Pooled>,
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
    /// Number of tests minus the number of fitted coefficients.
    pub degrees_of_freedom: usize,
    /// E* of each test compared with the fit.
    pub residuals: Vec<Residuals>,
    /// Covariance of d0 and d1; `null` where neither the file nor the residuals give the scatter.
    pub covariance: Option<Covariance>,
    /// The fitted line at 23 depths, evenly from no crush to a tenth beyond the deepest mean crush.
    pub line: Vec<LinePoint>,
    /// Crush energy of the depth and width under `[fit]`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub prediction: Option<Predicted>,
    /// Implausible properties of this stiffness.
    pub findings: Vec<Sentence>,
}

/// A point of a fitted line, that of a flat crush.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct LinePoint {
    /// Depth of the crush in m.
    pub depth: f64,
    /// E* of the fit in √N.
    pub crush_intensity: f64,
    /// Its standard deviation from the covariance, in √N; `null` without one.
    pub sd: Option<f64>,
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

/// Covariance of d0 and d1, those of the line through all tests.
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
    if file.onset.is_none() && file.force.is_none() && file.count() < 2 {
        let help = "give a second test, or assume the speed that leaves no crush: b0 = \"2 m/s\" under [fit], or onset; or hold the force at which crush begins: A";
        return Err(file.unfit([Issue::at("too-few", "vehicle", "one test cannot determine stiffness").with_help(help)]));
    }
    fit(file).map_err(|problems| file.unfit(problems))
}

fn fit(file: &TestFile) -> Result<Answer<StiffnessAnswer>, Vec<Issue>> {
    let series = file.series();
    let observations = series.observations()?;
    let (mut tests, mut problems) = (Vec::with_capacity(file.count()), Vec::new());
    for (i, (list, place)) in series.lists.iter().zip(&series.places).enumerate() {
        let of_list =
            TestSeries::new(list.iter().map(|measured| measured.test).collect::<Vec<_>>()).map_err(|wrong| series.issues(&wrong))?;
        let numbers = of_list.crush_energies().into_iter().zip(of_list.equivalent_energy_speeds());
        for (k, (test, (crush_energy, equivalent_energy_speed))) in of_list.tests().iter().zip(numbers).enumerate() {
            let mut test = Test::of(&file.vehicles[place.vehicle].name, test, crush_energy, equivalent_energy_speed);
            if let Some(onset) = file.onset.filter(|_| k == 0)
                && let Err(wrong) = test.alone(&list[k].test, onset)
            {
                problems.extend(series.issues(&wrong.of_test(i, k)));
            }
            tests.push(test);
        }
    }
    let mut notices = file.notices.clone();
    let mut note = |code, message: &'static str| notices.0.push(Notice::note(code, "vehicle", message));
    let mut not_on_profile = None;
    let fits = if file.count() < 2 && !file.holds() {
        Vec::new()
    } else {
        match file.fits(&observations) {
            Ok((fits, why)) => {
                not_on_profile = why;
                fits
            }
            Err(Unfitted::OnsetOfEach) => {
                note(
                    "onset-of-each",
                    "the tests have different masses per width, so that b0 makes another d0 in each: there is no fit to all of them",
                );
                Vec::new()
            }
            Err(Unfitted::Issues(wrong)) if file.onset.is_some() && matches!(wrong.as_slice(), [TestIssue::OneDepth { .. }]) => {
                note("one-depth", "all tests have the same mean depth: no line can be fitted through them");
                Vec::new()
            }
            Err(Unfitted::Issues(wrong)) => {
                problems.extend(series.issues(&wrong));
                Vec::new()
            }
        }
    };
    if !problems.is_empty() {
        return Err(problems);
    }
    if file.prediction.is_some() && fits.is_empty() {
        let message = "`depth` and `width` have no effect: there is no fit to predict their crush energy; b0 in place of onset makes one of a single test";
        notices.0.push(Notice::note("prediction-not-used", "fit", message));
    }
    notices.0.extend(not_on_profile.map(|why| {
        let message = Message::from("no stiffness fitted on profile: ").join(why.message());
        Notice::warning(why.code(), "vehicle", message)
    }));
    let of_fits = fits.iter().map(|fit| fit.stiffness);
    let of_tests = tests.iter().flat_map(|test| [&test.on_mean_depth, &test.on_profile]).flatten().map(Forms::stiffness);
    notices.0.extend(of_fits.chain(of_tests).find_map(|stiffness| unusual::stiffness("vehicle", ForceLine::from(stiffness))));
    let pooled = file.pooled();
    let uncertain = fits.iter().filter(|fit| file.is_uncertain(fit));
    let further: Vec<_> = uncertain
        .filter_map(|fit| {
            let class = pooled.iter().find(|class| class.model == model_name(fit.model))?;
            Some((class, fit, class.further_vehicle(fit.clone()).fit))
        })
        .collect();
    notices.0.extend(fits.iter().find_map(of_few_tests));
    notices.0.extend(further.iter().filter_map(|(class, fit, further)| of_further_vehicle(file, class, fit, further)));
    notices.0.extend(further.iter().find_map(|(class, fit, further)| of_contradicted_line(class, fit, further)));
    if let (count @ 2.., true, false) = (file.vehicles.len(), pooled.is_empty(), fits.is_empty()) {
        let message = format!(
            "the tests of {count} vehicles are fitted as those of one: how much vehicles differ is not known, which takes two with tests to different depths or an \
             onset, so that a further one is less certain"
        );
        notices.0.push(Notice::warning("spread-between-vehicles", "vehicle", message));
    }
    let suspected = file.not_one_car();
    let fits_as_new_cars = if suspected.is_empty() {
        Vec::new()
    } else {
        let as_new = file.series_with(|vehicle| suspected.iter().any(|car| car.vehicle == vehicle));
        file.fits(&as_new.observations()?).map(|(fits, _)| fits).unwrap_or_default()
    };
    let negative = fits.iter().flat_map(|fit| fit.findings().into_iter().filter(is_negative).map(|finding| negative_fit(fit, &finding)));
    // The vehicles of a class may differ, and so do tests of new cars that are taken as those of one.
    let contradicted = fits.iter().filter(|fit| pooled.is_empty() && suspected.is_empty() && fit.is_contradicted()).map(contradicted_fit);
    let headlines = suspected.iter().map(|car| car.headline(file)).chain(negative).chain(contradicted).map(Sentence).collect();
    let deepest = BEYOND_DEEPEST * tests.iter().map(|test| test.mean_depth).fold(0.0, f64::max);
    let of_file = |fits: Vec<StiffnessFit>| fits.iter().map(|fit| Fit::of(file, fit, deepest)).collect();
    let answer = StiffnessAnswer {
        tests,
        headlines,
        pooled,
        fits: of_file(fits),
        fits_as_new_cars: of_file(fits_as_new_cars),
        has_deviations: file.has_deviations,
    };
    Ok(Answer::new(&file.title, answer, notices))
}

/// Returns `true` if a finding makes a fit no stiffness.
pub(crate) fn is_negative(finding: &FitFinding) -> bool {
    matches!(finding, FitFinding::NegativeOnset(_) | FitFinding::NegativeSlope(_))
}

/// Describes a fit with a negative coefficient.
fn negative_fit(fit: &StiffnessFit, finding: &FitFinding) -> Message {
    Message::from(format!("no stiffness fitted on {}: ", model_name(fit.model)))
        .join(message(finding))
        .text("; A = d0 d1 is ")
        .figure(Measure::ForcePerWidth, ForceLine::from(fit.stiffness).onset)
}

/// Returns a warning of a line through all tests that the vehicles, each by itself, contradict.
fn of_contradicted_line(class: &Pooled, fit: &StiffnessFit, further: &StiffnessFit) -> Option<Notice> {
    let is_stiffness = !fit.findings().iter().any(is_negative);
    let is_far = is_stiffness && class.is_far_from(further);
    let message = || Message::from(format!("the line through all tests, fitted on {}, is ", class.model)).join(class.contradiction());
    is_far.then(|| Notice::warning("line-off-class", "vehicle", message()))
}

/// Returns a note of the standard deviations of a further vehicle of a class, where those of the line through all tests are smaller.
fn of_further_vehicle(file: &TestFile, class: &Pooled, fit: &StiffnessFit, further: &StiffnessFit) -> Option<Notice> {
    if further.covariance == fit.covariance {
        return None;
    }
    let message = Message::from("a further vehicle differs from the line through all tests, fitted on ")
        .text(model_name(fit.model))
        .text(", as the tested ones do: its d0 is known to ± ")
        .figure(Measure::RootForce, further.onset().deviation())
        .text(", its d1 to ± ")
        .figure(Measure::RootForcePerLength, further.slope().deviation());
    let energy = file.prediction.as_ref().map(|asked| further.energy_at(asked.depth, asked.width).deviation());
    let message = match energy {
        Some(sd) => message.text(", and its crush energy to ± ").figure(Measure::Energy, sd),
        None => message,
    };
    let message = message.text(format!(", as far as {} vehicles tell; `reconstruct` uses these", class.vehicles.len()));
    Some(Notice::note("spread-between-vehicles", "vehicle", message))
}

/// Returns a note of a scatter that so few tests tell that a range of 95 % is that of Student's distribution.
fn of_few_tests(fit: &StiffnessFit) -> Option<Notice> {
    /// Ratio to that of the normal distribution that does not matter.
    const ALIKE: f64 = 1.1;
    let n = u32::try_from(fit.degrees_of_freedom + 1).ok().filter(|n| *n > 1 && fit.basis == CovarianceBasis::Residuals)?;
    let times = Distribution::StudentT { mean: 0.0, sd: f64::from(n).sqrt(), n }.quantile(0.975);
    let message = || {
        format!(
            "the tests alone tell their scatter, with {}: a range of 95 % is ± {times:.1} standard deviations, and not ± 1.96 (Student's distribution; `reconstruct` uses it)",
            degrees_of_freedom(fit.degrees_of_freedom)
        )
    };
    (times > ALIKE * Distribution::NORMAL_95).then(|| Notice::note("few-tests", "vehicle", message()))
}

/// Describes a fit to tests that contradict each other.
fn contradicted_fit(fit: &StiffnessFit) -> Message {
    let (model, freedom) = (model_name(fit.model), degrees_of_freedom(fit.degrees_of_freedom));
    Message::from(format!("the tests contradict each other, fitted on {model}: chi-square {:.1} with {freedom}", fit.chi_square))
}

/// Returns the name of a model of the crush in answers.
fn model_name(model: CrushModel) -> &'static str {
    match model {
        CrushModel::MeanDepth => "mean depth",
        CrushModel::Profile => "profile",
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

    fn stiffness(&self) -> CrushStiffness {
        CrushStiffness { onset: self.d0, slope: self.d1 }
    }
}

impl Fit {
    fn of(file: &TestFile, fit: &StiffnessFit, deepest: f64) -> Self {
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
            // A coefficient that is held is correlated with nothing.
            correlation: if fit.covariance.onset > 0.0 { positive_zero(fit.covariance.correlation()) } else { 0.0 },
        };
        let point = |i: usize| {
            let depth = deepest * i as f64 / LINE_STEPS as f64;
            let estimate = fit.intensity_at(depth);
            LinePoint {
                depth,
                crush_intensity: positive_zero(estimate.value),
                sd: is_uncertain.then(|| positive_zero(estimate.deviation())),
            }
        };
        let prediction = file.prediction.as_ref().map(|asked| {
            let energy = fit.energy_at(asked.depth, asked.width);
            let sd = is_uncertain.then(|| positive_zero(energy.deviation()));
            Predicted { depth: asked.depth, width: asked.width, crush_energy: positive_zero(energy.value), sd }
        });
        Fit {
            model: model_name(fit.model),
            forms: Forms::of(fit.stiffness),
            chi_square: positive_zero(fit.chi_square),
            degrees_of_freedom: fit.degrees_of_freedom,
            residuals: fit.residuals.iter().map(residual).collect(),
            covariance: is_uncertain.then(covariance),
            line: (0..=LINE_STEPS).map(point).collect(),
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
