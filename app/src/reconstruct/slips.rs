//! Slips of input that explain why evidence does not agree: the same question with one number mirrored, exchanged or in another unit.

use std::f64::consts::PI;

use planar_impact::reconstruct::{Measurand, ReconstructionProblem, Search, Uncertainty, Variable};
use planar_impact::{Input, Measure, Output, Party, Side};

use super::question::Question;
use crate::case::vehicle_number;
use crate::message::Message;
use crate::notice::Notice;

/// Number of starts of the search of each slip.
const STARTS: usize = 8;

/// Most slips that are named.
const MOST_NAMED: usize = 3;

/// Metres in a mile over those in a kilometre.
const MILE: f64 = 1.609344;

/// Kilograms in a pound.
const POUND: f64 = 0.45359237;

/// One number that may have slipped.
struct Slip {
    /// Its key.
    path: String,
    /// What it would be instead.
    instead: Message,
    /// The question with it.
    problem: ReconstructionProblem,
}

/// Returns a warning for each slip with which the evidence would agree, the best fit first. `chi_square` is that of the question as it is.
pub fn of(question: &Question, chi_square: f64, goes_on: &dyn Fn() -> bool) -> Vec<Notice> {
    let search = Search { starts: STARTS, ..Search::default() };
    let fit = |slip: Slip| {
        if !goes_on() {
            return None;
        }
        let answer = slip.problem.solve(&search).ok()?;
        let best = answer.best();
        best.is_explained().then_some((best.chi_square, slip))
    };
    let mut found: Vec<(f64, Slip)> = slips(&question.asked).into_iter().filter_map(fit).collect();
    found.sort_by(|one, other| one.0.total_cmp(&other.0));
    found.truncate(MOST_NAMED);
    found.into_iter().map(|(of_slip, slip)| warning(slip, of_slip, chi_square)).collect()
}

fn warning(slip: Slip, of_slip: f64, chi_square: f64) -> Notice {
    let message = Message::from(format!("check {}: with ", slip.path))
        .join(slip.instead)
        .text(format!(" the evidence would agree, with a chi-square of {of_slip:.1} in place of {chi_square:.1}"));
    Notice::warning("possible-slip", slip.path, message)
}

/// Returns the question with each slip that it can have.
fn slips(asked: &ReconstructionProblem) -> Vec<Slip> {
    let mut all = Vec::new();
    mirrored_centers(asked, &mut all);
    exchanged_headings(asked, &mut all);
    for side in Side::ALL {
        mass_in_pounds(asked, side, &mut all);
    }
    for (i, evidence) in asked.evidence.iter().enumerate() {
        let mut scaled = |factor: f64, words: &str| {
            let mut problem = asked.clone();
            let piece = &mut problem.evidence[i];
            piece.value *= factor;
            if let Uncertainty::StandardDeviation(sd) = &mut piece.uncertainty {
                *sd *= factor.abs();
            }
            let instead = Message::new().figure(evidence.of.measure(), piece.value).text(words.to_owned());
            all.push(Slip { path: evidence.of.name().to_owned(), instead, problem });
        };
        match evidence.of {
            Measurand::Output(Output::YawRate(_)) => {
                scaled(-1.0, ", the other way round,");
                scaled(PI / 180.0, ", degrees taken for radians,");
                scaled(180.0 / PI, ", radians taken for degrees,");
            }
            of if of.measure() == Measure::Speed => {
                scaled(MILE, ", mph taken for km/h,");
                scaled(MILE.recip(), ", km/h taken for mph,");
            }
            _ => (),
        }
    }
    all
}

/// Returns `true` if an input is given and not solved for.
fn is_known(asked: &ReconstructionProblem, input: Input) -> bool {
    asked.collision.input(input).is_some() && asked.unknowns.iter().all(|unknown| unknown.of != Variable::Input(input))
}

/// Returns the question with other values of inputs, which the collision has.
fn with(asked: &ReconstructionProblem, values: &[(Input, f64)]) -> Option<ReconstructionProblem> {
    let mut problem = asked.clone();
    for (input, value) in values {
        problem.collision.set(*input, *value).ok()?;
    }
    Some(problem)
}

/// The impact center on the other side of a vehicle, or of both.
fn mirrored_centers(asked: &ReconstructionProblem, all: &mut Vec<Slip>) {
    for sides in [&[Side::One][..], &[Side::Two], &Side::ALL] {
        let mirrored = |side: &Side| {
            let input = Input::ImpactCenterLeft(*side);
            let left = asked.collision.input(input).filter(|left| *left != 0.0 && is_known(asked, input))?;
            Some((input, -left))
        };
        let Some(values) = sides.iter().map(mirrored).collect::<Option<Vec<_>>>() else { continue };
        let Some(problem) = with(asked, &values) else { continue };
        let mut instead = Message::new();
        for (k, (side, (_, left))) in sides.iter().zip(&values).enumerate() {
            let and = if k > 0 { " and " } else { "" };
            instead = instead.text(format!("{and}the impact center of vehicle {} at left = ", vehicle_number(*side)));
            instead = instead.figure(Measure::Length, *left);
        }
        let path = format!("vehicle.{}.impact_center", vehicle_number(sides[0]));
        all.push(Slip { path, instead: instead.text(", the mirror image,"), problem });
    }
}

/// Each vehicle with the heading of the other; one that drives along its heading turns its velocity with it.
fn exchanged_headings(asked: &ReconstructionProblem, all: &mut Vec<Slip>) {
    let mut problem = asked.clone();
    let (Party::Vehicle(one), Party::Vehicle(two)) = (&mut problem.collision.one, &mut problem.collision.two) else { return };
    if one.heading == two.heading || !Side::ALL.into_iter().all(|side| is_known(asked, Input::Heading(side))) {
        return;
    }
    let headings = [two.heading, one.heading];
    for ((vehicle, heading), drives_along) in [one, two].into_iter().zip(headings).zip(asked.drives_along_heading) {
        let speed = vehicle.heading.to_vehicle(vehicle.motion.velocity).forward;
        *vehicle = vehicle.with_heading(heading);
        if drives_along {
            *vehicle = vehicle.with_speed(speed);
        }
    }
    all.push(Slip { path: "vehicle.1.heading".to_owned(), instead: Message::from("the headings of both vehicles exchanged"), problem });
}

/// A mass in the other unit.
fn mass_in_pounds(asked: &ReconstructionProblem, side: Side, all: &mut Vec<Slip>) {
    let input = Input::Mass(side);
    let Some(mass) = asked.collision.input(input).filter(|_| is_known(asked, input)) else { return };
    for (factor, words) in [(POUND, ", pounds taken for kilograms,"), (POUND.recip(), ", kilograms taken for pounds,")] {
        let mass = factor * mass;
        let Some(problem) = with(asked, &[(input, mass)]) else { continue };
        all.push(Slip { path: input.name().to_owned(), instead: Message::new().figure(Measure::Mass, mass).text(words), problem });
    }
}
