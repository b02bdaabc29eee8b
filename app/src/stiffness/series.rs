//! The tests of a file as repeated tests of one car or as tests of new cars, and the fits to them.

use planar_impact::barrier::{CrushModel, FitFinding, MeasuredTest, Observations, StiffnessFit, TestIssue, TestIssues};
use planar_impact::{InputIssue, InputIssueKind, Issue as _};

use super::pooled::{OwnFit, Pooled};
use super::{TestFile, is_negative};
use crate::issue::{Issue, Issues};
use crate::message::Message;
use crate::units::Measure;

/// Largest relative difference of √(m/w) between tests at which a held b0 has one d0 in all of them.
const SAME_ONSET: f64 = 0.025;

/// Lists of repeated tests of one car, as the library takes them.
pub(super) struct Series<'a> {
    pub lists: Vec<&'a [MeasuredTest]>,
    /// Where each list is in the file.
    pub places: Vec<Place>,
    /// Where the file gives the speed that leaves no crush.
    onset: &'static str,
}

/// The place of a list: a vehicle of the file, and the first of its tests in the list.
pub(super) struct Place {
    pub vehicle: usize,
    test: usize,
}

/// Why there is no fit.
pub(super) enum Unfitted {
    /// A held b0 makes another d0 in each test.
    OnsetOfEach,
    Issues(TestIssues),
}

impl From<TestIssues> for Unfitted {
    fn from(issues: TestIssues) -> Self {
        Unfitted::Issues(issues)
    }
}

/// A vehicle whose tests cannot be repeated tests of one car, but can be tests of new cars.
pub(super) struct NotOneCar {
    pub vehicle: usize,
    /// The coefficient below zero, as one car.
    finding: FitFinding,
    /// d0 as new cars.
    onset: f64,
}

impl Series<'_> {
    pub(super) fn observations(&self) -> Result<Observations, Vec<Issue>> {
        Observations::of_tests(&self.lists).map_err(|wrong| self.issues(&wrong))
    }

    /// Locates issues of the library at their keys in the file.
    pub(super) fn issues(&self, issues: &TestIssues) -> Vec<Issue> {
        issues.as_slice().iter().map(|issue| self.issue(issue)).collect()
    }

    /// Locates an issue of the library at its key in the file.
    fn issue(&self, issue: &TestIssue) -> Issue {
        let help = match issue {
            TestIssue::Input(InputIssue { kind: InputIssueKind::OutOfOrder { .. }, .. }) => {
                Some("list the tests of one car in their order, each with all its crush, or write new_cars = true if each was of a new car")
            }
            TestIssue::Undetermined => Some("add a test with another depth, or fit on mean depth: model = \"mean depth\""),
            TestIssue::OneDepth { .. } | TestIssue::Input(InputIssue { kind: InputIssueKind::TooFew { .. }, .. }) => {
                Some("or hold the speed that leaves no crush: b0 = \"2 m/s\" under [fit]")
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
        Issue { help: help.map(Message::from), ..Issue::at(issue.code(), self.path(issue), message) }
    }

    /// Returns the path in the file that an issue refers to.
    fn path(&self, issue: &TestIssue) -> String {
        let place = match (issue, issue.place()) {
            (TestIssue::OnsetTooFast { .. }, _) => return self.onset.to_owned(),
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
        let Place { vehicle, test } = self.places[series];
        format!("vehicle.{}.test.{}{key}", vehicle + 1, test + index + 1)
    }
}

impl TestFile {
    /// Returns the tests as the file says: those of a vehicle are of one car unless it says otherwise.
    pub(super) fn series(&self) -> Series<'_> {
        self.series_with(|_| false)
    }

    /// The same with the tests of further vehicles as those of new cars.
    pub(super) fn series_with(&self, is_new: impl Fn(usize) -> bool) -> Series<'_> {
        let onset = if self.holds_onset { "fit.b0" } else { "fit.onset" };
        let mut series = Series { lists: Vec::new(), places: Vec::new(), onset };
        for (vehicle, tested) in self.vehicles.iter().enumerate() {
            let size = if tested.new_cars == Some(true) || is_new(vehicle) { 1 } else { tested.tests.len() };
            for (i, list) in tested.tests.chunks(size.max(1)).enumerate() {
                series.lists.push(list);
                series.places.push(Place { vehicle, test: i * size });
            }
        }
        series
    }

    /// Fits the stiffness to tests, on mean depths and on profiles; with the reason if the profiles alone do not determine it.
    pub(super) fn fits(&self, observations: &Observations) -> Result<(Vec<StiffnessFit>, Option<TestIssue>), Unfitted> {
        let on_mean_depth = self.fitted(observations, CrushModel::MeanDepth)?;
        match self.fitted(observations, CrushModel::Profile) {
            Ok(on_profile) => Ok((vec![on_mean_depth, on_profile], None)),
            Err(Unfitted::Issues(wrong)) => match wrong.as_slice() {
                [why @ (TestIssue::Undetermined | TestIssue::NotConverged { .. })] => Ok((vec![on_mean_depth], Some(why.clone()))),
                _ => Err(Unfitted::Issues(wrong)),
            },
            Err(why) => Err(why),
        }
    }

    fn fitted(&self, observations: &Observations, model: CrushModel) -> Result<StiffnessFit, Unfitted> {
        if let Some(force) = self.force {
            return Ok(self.with_scatter(StiffnessFit::with_force(observations, force, model)?));
        }
        let fit = match (self.onset.filter(|_| self.holds_onset), model) {
            (Some(speed), _) => {
                let roots = || {
                    self.vehicles
                        .iter()
                        .flat_map(|vehicle| &vehicle.tests)
                        .map(|measured| (measured.test.mass / measured.test.width()).sqrt())
                };
                let (least, most) = (roots().fold(f64::INFINITY, f64::min), roots().fold(0.0, f64::max));
                if most > least * (1.0 + SAME_ONSET) {
                    return Err(Unfitted::OnsetOfEach);
                }
                StiffnessFit::with_onset(observations, speed * roots().sum::<f64>() / self.count() as f64, model)?
            }
            (None, CrushModel::MeanDepth) => StiffnessFit::on_mean_depth(observations)?,
            (None, CrushModel::Profile) => StiffnessFit::on_profiles(observations)?,
        };
        Ok(self.with_scatter(fit))
    }

    /// Without standard deviations all tests have equal weight, and only the residuals give the scatter.
    fn with_scatter(&self, fit: StiffnessFit) -> StiffnessFit {
        if self.has_deviations { fit } else { fit.rescaled().unwrap_or(fit) }
    }

    /// Fits the stiffness to the tests.
    ///
    /// # Errors
    ///
    /// Every reason for which the tests do not determine a stiffness.
    pub(crate) fn fit(&self, model: CrushModel) -> Result<StiffnessFit, Issues> {
        let series = self.series();
        let observations = series.observations().map_err(|wrong| self.unfit(wrong))?;
        self.fitted(&observations, model).map_err(|why| match why {
            Unfitted::Issues(wrong) => self.unfit(series.issues(&wrong)),
            Unfitted::OnsetOfEach => {
                let message = "the tests have different masses per width, so that b0 makes another d0 in each";
                self.unfit([Issue::at("onset-of-each", "fit.b0", message).with_help("give one vehicle in a file")])
            }
        })
    }

    /// Returns `true` if the file or the residuals of a fit give the scatter of the tests.
    pub(crate) fn is_uncertain(&self, fit: &StiffnessFit) -> bool {
        self.has_deviations || fit.degrees_of_freedom > 0
    }

    /// Returns the vehicles whose tests, as repeated tests of one car, make a negative coefficient, but none as tests of new cars.
    pub(super) fn not_one_car(&self) -> Vec<NotOneCar> {
        let suspect = |(vehicle, tested): (usize, &super::Tested)| {
            let line = |lists: &[&[MeasuredTest]]| StiffnessFit::on_mean_depth(&Observations::of_tests(lists).ok()?).ok();
            tested.new_cars.is_none().then_some(())?;
            let finding = line(&[&tested.tests])?.findings().into_iter().find(is_negative)?;
            let as_new = line(&tested.tests.chunks(1).collect::<Vec<_>>())?;
            let is_stiffness = !as_new.findings().iter().any(is_negative);
            is_stiffness.then_some(NotOneCar { vehicle, finding, onset: as_new.stiffness.onset })
        };
        self.vehicles.iter().enumerate().filter_map(suspect).collect()
    }

    /// Returns the stiffness of the class if two or more vehicles have one of their own: by a held or assumed onset, or by tests to different depths. A negative
    /// coefficient of one of them is an estimate like the others: without it the spread would be too small.
    pub(crate) fn class(&self, model: CrushModel) -> Option<Pooled> {
        let fits: Vec<OwnFit> = self.vehicles.iter().filter_map(|tested| self.own(tested, model)).collect();
        Pooled::of(model, &fits)
    }

    /// Returns the stiffness of the class on mean depths and on profiles.
    pub(super) fn pooled(&self) -> Vec<Pooled> {
        [CrushModel::MeanDepth, CrushModel::Profile].into_iter().filter_map(|model| self.class(model)).collect()
    }

    fn own(&self, tested: &super::Tested, model: CrushModel) -> Option<OwnFit> {
        let size = if tested.new_cars == Some(true) { 1 } else { tested.tests.len() };
        let observations = Observations::of_tests(&tested.tests.chunks(size).collect::<Vec<_>>()).ok()?;
        let free = || match model {
            CrushModel::MeanDepth => StiffnessFit::on_mean_depth(&observations).ok(),
            CrushModel::Profile => StiffnessFit::on_profiles(&observations).ok(),
        };
        let held = |speed: f64| {
            let mean = tested.tests.iter().map(|measured| (measured.test.mass / measured.test.width()).sqrt()).sum::<f64>();
            StiffnessFit::with_onset(&observations, speed * mean / tested.tests.len() as f64, model).ok()
        };
        let fit = match self.onset {
            _ if self.force.is_some() => self.force.and_then(|force| StiffnessFit::with_force(&observations, force, model).ok()),
            Some(speed) if self.holds_onset || tested.tests.len() < 2 => held(speed),
            _ => free(),
        };
        let fit = self.with_scatter(fit?);
        Some(OwnFit { name: tested.name.clone(), is_uncertain: self.is_uncertain(&fit), fit })
    }
}

impl NotOneCar {
    /// Says why the tests cannot be of one car.
    pub(super) fn headline(&self, file: &TestFile) -> Message {
        Message::from(format!("{}: as repeated tests of one car, whose energies add up, ", file.vehicles[self.vehicle].name))
            .join(super::message(&self.finding))
            .text("; as tests of new cars d0 is ")
            .figure(Measure::RootForce, self.onset)
            .text(". Write new_cars = true under this [[vehicle]] if each test was of a new car, and new_cars = false if not")
    }
}
