//! The verb `stiffness`: crush stiffness from barrier tests.

mod document;
mod given;
mod text;

use planar_impact::barrier::{
    BarrierTest, Estimate, MeasuredTest, Observations, Problem as Wrong, Problems as AllWrong, StiffnessFit, TestSeries,
};
use planar_impact::crush::{BarrierSpeedLine, CrushStiffness};

use crate::Done;
use crate::arguments::{Format, Stiffness as Call};
use crate::document::{Document, Source};
use crate::exit::Failure;
use given::{Prediction, TestFile};

/// Reads the tests and prints the stiffness that they tell.
///
/// # Errors
///
/// Everything wrong with the file, or why its tests tell no stiffness.
pub fn run(call: &Call) -> Result<Done, Failure> {
    let document = Document::parse(Source::read(&call.tests).map_err(Failure::Input)?).map_err(Failure::Input)?;
    let file = TestFile::read(&document).map_err(Failure::Input)?;
    if file.onset.is_none() && file.vehicles.iter().map(|vehicle| vehicle.tests.len()).sum::<usize>() < 2 {
        let help = "give a second test, or assume the speed that leaves no crush: onset = \"2 m/s\" under [fit]".to_owned();
        let problem = document.problem("vehicle", "one test tells no stiffness by itself", Some(help));
        return Err(Failure::Input(document.refuse(vec![problem])));
    }
    let result = Findings::of(&file).map_err(|wrong| Failure::Input(document.refuse(place(&document, &wrong))))?;
    match call.format {
        Format::Text => Ok(Done::with(text::render(&file, &result, call.units.unwrap_or(file.units)))),
        Format::Json => {
            let text = serde_json::to_string_pretty(&document::Document::of(&file, &result));
            text.map(|text| Done::with(text + "\n")).map_err(|error| Failure::Data(error.to_string()))
        }
    }
}

/// What the tests tell.
struct Findings {
    tests: Vec<Found>,
    /// The fit on mean depths and that on the profiles; none of one test.
    fits: Vec<StiffnessFit>,
    /// What the file leaves to be said, and why there is no fit of several tests.
    notes: Vec<String>,
}

/// What one test tells.
struct Found {
    /// The vehicle, counted from 0.
    vehicle: usize,
    test: BarrierTest,
    /// What the vehicle had kept by then, with the tests before.
    crush_energy: f64,
    equivalent_energy_speed: f64,
    /// From this test alone, where an onset is assumed and the vehicle was new.
    alone: Option<Alone>,
}

/// The stiffness from one test and an assumed onset.
struct Alone {
    /// As it is customarily made, from the mean depth.
    line: BarrierSpeedLine,
    /// With which the measured profile keeps the energy of the test.
    exact: CrushStiffness,
}

impl Findings {
    fn of(file: &TestFile) -> Result<Self, Vec<Wrong>> {
        let series: Vec<&[MeasuredTest]> = file.vehicles.iter().map(|vehicle| vehicle.tests.as_slice()).collect();
        let count: usize = series.iter().map(|tests| tests.len()).sum();
        let all = |wrong: AllWrong| wrong.all().to_vec();
        let observations = Observations::of_tests(&series).map_err(all)?;
        let (mut tests, mut problems) = (Vec::with_capacity(count), Vec::new());
        for (vehicle, measured) in series.iter().enumerate() {
            let series = TestSeries::new(measured.iter().map(|measured| measured.test).collect::<Vec<_>>()).map_err(all)?;
            let numbers = series.crush_energies().into_iter().zip(series.equivalent_energy_speeds());
            for (i, (&test, (crush_energy, equivalent_energy_speed))) in series.tests().iter().zip(numbers).enumerate() {
                let alone = file.onset.filter(|_| i == 0).map(|onset| Alone::of(&test, onset).map_err(|wrong| wrong.of_test(vehicle, i)));
                let alone = alone.transpose().unwrap_or_else(|wrong| {
                    problems.extend(all(wrong));
                    None
                });
                tests.push(Found { vehicle, test, crush_energy, equivalent_energy_speed, alone });
            }
        }
        let mut notes = file.notes.clone();
        let fits = match fits(&observations) {
            _ if count < 2 => Vec::new(),
            // Without standard deviations the tests weigh alike, and the residuals alone tell the scatter.
            Ok(fits) if !file.has_deviations => fits.iter().map(|fit| fit.rescaled().unwrap_or_else(|| fit.clone())).collect(),
            Ok(fits) => fits,
            Err(wrong) if file.onset.is_some() && matches!(wrong.all(), [Wrong::OneDepth { .. }]) => {
                notes.push("all tests have the same mean depth: no line can be fitted through them".to_owned());
                Vec::new()
            }
            Err(wrong) => {
                problems.extend(all(wrong));
                Vec::new()
            }
        };
        if problems.is_empty() { Ok(Findings { tests, fits, notes }) } else { Err(problems) }
    }
}

impl Alone {
    fn of(test: &BarrierTest, onset: f64) -> Result<Self, AllWrong> {
        Ok(Alone { line: test.speed_line(onset)?, exact: test.stiffness(onset)? })
    }
}

/// On mean depths and on the profiles.
fn fits(observations: &Observations) -> Result<Vec<StiffnessFit>, AllWrong> {
    Ok(vec![StiffnessFit::on_mean_depth(observations)?, StiffnessFit::on_profiles(observations)?])
}

/// What a fit expects of the crush energy at the depth that the file asks for.
fn predicted(fit: &StiffnessFit, prediction: &Prediction) -> Estimate {
    fit.energy_at(prediction.depth, prediction.width)
}

/// Whether a fit says how uncertain it is: not where its standard deviations were made up and no residual tells them.
fn is_uncertain(file: &TestFile, fit: &StiffnessFit) -> bool {
    file.has_deviations || fit.degrees_of_freedom > 0
}

/// What the library refuses, each at its place in the file.
fn place(document: &Document, wrong: &[Wrong]) -> Vec<crate::document::Problem> {
    let problem = |wrong: &Wrong| {
        let help = match wrong {
            Wrong::OutOfOrder { .. } => Some("list the tests of one vehicle in their order, each with all its crush"),
            Wrong::OneDepth { .. } | Wrong::TooFew { .. } => Some("or assume an onset: onset = \"2 m/s\" under [fit]"),
            Wrong::NotPositive { place, .. } if ["variance", "pivot of the covariance"].contains(&place.name) => {
                Some("the standard deviations leave no doubt of E*: give a scatter above zero")
            }
            _ => None,
        };
        // The key says where it is, counted from one.
        let said = wrong.place().map_or_else(|| wrong.to_string(), |place| wrong.to_string().replacen(&place.to_string(), place.name, 1));
        document.problem(&key(wrong), said, help.map(str::to_owned))
    };
    wrong.iter().map(problem).collect()
}

/// The key of the file that a problem is about.
fn key(wrong: &Wrong) -> String {
    let place = match (wrong, wrong.place()) {
        (Wrong::OnsetTooFast { .. }, _) => return "fit.onset".to_owned(),
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
