//! Slips of input that explain why evidence does not agree: the same question with one number mirrored, exchanged or in another unit.

use std::f64::consts::{PI, TAU};

use planar_impact::reconstruct::{Measurand, ReconstructionProblem, Search, Solution, Uncertainty, Variable};
use planar_impact::{Heading, Input, Measure, Output, Party, Side};

use super::from_rest::Separations;
use super::question::Question;
use crate::case::{Case, Parameter, vehicle_number};
use crate::message::Message;
use crate::notice::Notice;

/// Number of starts of the search of each slip.
const STARTS: usize = 8;

/// Most slips that are named.
const MOST_NAMED: usize = 3;

/// Least residual, in standard deviations, of a yaw rate whose heading at rest may be a whole turn off.
const LEAST_RESIDUAL: f64 = 3.0;

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

/// Returns a warning for each slip with which the evidence would agree, the best fit first. `case` is the case of the file, with its rest positions, of which
/// the question uses these separations; `best` is the best fit of the question as it is.
pub fn of(case: &Case, separations: &Separations, question: &Question, best: &Solution, goes_on: &dyn Fn() -> bool) -> Vec<Notice> {
    let search = Search { starts: STARTS, ..Search::default() };
    let fit = |slip: Slip| {
        if !goes_on() {
            return None;
        }
        let answer = slip.problem.solve(&search).ok()?;
        let with_slip = answer.best();
        with_slip.is_explained().then_some((with_slip.chi_square, slip))
    };
    let mut found: Vec<(f64, Slip)> = slips(case, separations, &question.asked, best).into_iter().filter_map(fit).collect();
    found.sort_by(|one, other| one.0.total_cmp(&other.0));
    found.truncate(MOST_NAMED);
    found.into_iter().map(|(of_slip, slip)| warning(slip, of_slip, best.chi_square)).collect()
}

fn warning(slip: Slip, of_slip: f64, chi_square: f64) -> Notice {
    let message = Message::from(format!("check {}: with ", slip.path))
        .join(slip.instead)
        .text(format!(" the evidence would agree, with a chi-square of {of_slip:.1} in place of {chi_square:.1}"));
    Notice::warning("possible-slip", slip.path, message)
}

/// Returns the question with each slip that it can have.
fn slips(case: &Case, separations: &Separations, asked: &ReconstructionProblem, best: &Solution) -> Vec<Slip> {
    let mut all = Vec::new();
    mirrored_centers(asked, &mut all);
    exchanged_headings(asked, &mut all);
    for side in Side::ALL {
        mass_in_pounds(case, separations, asked, side, &mut all);
        heading_in_degrees(asked, side, &mut all);
        whole_turns(case, separations, best, side, &mut all);
    }
    crush_plane_in_degrees(asked, &mut all);
    speeds_in_miles(asked, &mut all);
    for (at, evidence) in asked.evidence.iter().enumerate() {
        if matches!(evidence.of, Measurand::Output(Output::YawRate(_))) {
            let factors = [
                (-1.0, ", the other way round,"),
                (PI / 180.0, ", degrees taken for radians,"),
                (180.0 / PI, ", radians taken for degrees,"),
            ];
            all.extend(factors.map(|(factor, words)| {
                let mut problem = asked.clone();
                scale(&mut problem, Given::Evidence(at), factor);
                let instead = Message::new().figure(evidence.of.measure(), factor * evidence.value).text(words);
                Slip { path: evidence.of.name().to_owned(), instead, problem }
            }));
        }
    }
    all
}

/// A number of the question that a factor multiplies.
#[derive(Clone, Copy)]
enum Given {
    /// A piece of evidence, by its place.
    Evidence(usize),
    /// The speed of a vehicle before the impact.
    Speed(Side),
}

fn scale(problem: &mut ReconstructionProblem, given: Given, factor: f64) {
    match given {
        Given::Evidence(at) => {
            let piece = &mut problem.evidence[at];
            piece.value *= factor;
            if let Uncertainty::StandardDeviation(sd) = &mut piece.uncertainty {
                *sd *= factor.abs();
            }
        }
        Given::Speed(side) => {
            if let Party::Vehicle(vehicle) = party(problem, side) {
                vehicle.motion.velocity *= factor;
            }
        }
    }
}

fn party(problem: &mut ReconstructionProblem, side: Side) -> &mut Party {
    match side {
        Side::One => &mut problem.collision.one,
        Side::Two => &mut problem.collision.two,
    }
}

/// Returns the speed of a vehicle that moves before the impact at a velocity that is given and not solved for.
fn known_speed(asked: &ReconstructionProblem, side: Side) -> Option<f64> {
    let speed = asked.collision.parties()[side as usize].vehicle()?.motion.velocity.length();
    let is_solved_for = |of: Variable| match of {
        Variable::Speed(of) => of == side,
        Variable::Input(input) => [Input::VelocityX(side), Input::VelocityY(side)].contains(&input),
        _ => false,
    };
    (speed > 0.0 && !asked.unknowns.iter().any(|unknown| is_solved_for(unknown.of))).then_some(speed)
}

/// Speeds in the other unit: each alone, those of one vehicle, and all, as one who mistakes the unit of a source mistakes it for all of its numbers.
fn speeds_in_miles(asked: &ReconstructionProblem, all: &mut Vec<Slip>) {
    let measured = asked.evidence.iter().enumerate().filter(|(_, piece)| piece.of.measure() == Measure::Speed);
    let mut speeds: Vec<(Given, Option<Side>, String, f64)> =
        measured.map(|(at, piece)| (Given::Evidence(at), piece.of.side(), piece.of.name().to_owned(), piece.value)).collect();
    let known = |side| Some((Given::Speed(side), Some(side), format!("vehicle.{}.speed", vehicle_number(side)), known_speed(asked, side)?));
    speeds.extend(Side::ALL.into_iter().filter_map(known));
    let mut groups: Vec<(Message, Vec<usize>)> = vec![(Message::from("every given speed"), (0..speeds.len()).collect())];
    groups.extend(Side::ALL.map(|side| {
        let of_vehicle = (0..speeds.len()).filter(|i| speeds[*i].1 == Some(side)).collect();
        (Message::from(format!("every given speed of vehicle {}", vehicle_number(side))), of_vehicle)
    }));
    groups.retain(|(_, of_group)| of_group.len() > 1);
    // All speeds may be those of one vehicle.
    groups.dedup_by(|one, other| one.1 == other.1);
    for (factor, words) in [(MILE, ", mph taken for km/h,"), (MILE.recip(), ", km/h taken for mph,")] {
        let alone =
            speeds.iter().enumerate().map(|(i, (_, _, _, value))| (Message::new().figure(Measure::RoadSpeed, factor * value), vec![i]));
        let together = groups.iter().map(|(name, of_group)| (name.clone().text(format!(" times {factor:.4}")), of_group.clone()));
        for (instead, of_group) in alone.chain(together) {
            let mut problem = asked.clone();
            of_group.iter().for_each(|&i| scale(&mut problem, speeds[i].0, factor));
            all.push(Slip { path: speeds[of_group[0]].2.clone(), instead: instead.text(words), problem });
        }
    }
}

/// Returns an angle that was meant in radians but given in degrees, which only small numbers can be. Numbers without a unit that are no angle in radians are
/// refused where they are read.
fn meant_in_radians(angle: f64) -> Option<f64> {
    let degrees = angle.to_degrees();
    (angle != 0.0 && degrees.abs() < TAU).then_some(degrees)
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

/// Turns a vehicle; one that drives along its heading turns its velocity with it.
fn turn(problem: &mut ReconstructionProblem, side: Side, heading: Heading) {
    let drives_along = problem.drives_along_heading[side as usize];
    let Party::Vehicle(vehicle) = party(problem, side) else { return };
    let speed = vehicle.heading.to_vehicle(vehicle.motion.velocity).forward;
    *vehicle = vehicle.with_heading(heading);
    if drives_along {
        *vehicle = vehicle.with_speed(speed);
    }
}

/// Each vehicle with the heading of the other.
fn exchanged_headings(asked: &ReconstructionProblem, all: &mut Vec<Slip>) {
    let [Some(one), Some(two)] = asked.collision.parties().map(|party| party.vehicle().map(|vehicle| vehicle.heading)) else { return };
    if one == two || !Side::ALL.into_iter().all(|side| is_known(asked, Input::Heading(side))) {
        return;
    }
    let mut problem = asked.clone();
    turn(&mut problem, Side::One, two);
    turn(&mut problem, Side::Two, one);
    all.push(Slip { path: "vehicle.1.heading".to_owned(), instead: Message::from("the headings of both vehicles exchanged"), problem });
}

/// A heading in radians that was given as degrees.
fn heading_in_degrees(asked: &ReconstructionProblem, side: Side, all: &mut Vec<Slip>) {
    let input = Input::Heading(side);
    let Some(heading) = asked.collision.input(input).filter(|_| is_known(asked, input)) else { return };
    let Some(angle) = meant_in_radians(heading) else { return };
    let mut problem = asked.clone();
    turn(&mut problem, side, Heading::from_angle(angle));
    all.push(Slip {
        path: input.name().to_owned(),
        instead: Message::new().figure(Measure::Angle, angle).text(", radians taken for degrees,"),
        problem,
    });
}

/// The angle of the crush plane in radians that was given as degrees.
fn crush_plane_in_degrees(asked: &ReconstructionProblem, all: &mut Vec<Slip>) {
    let input = Input::CrushPlane;
    let Some(angle) = asked.collision.input(input).filter(|_| is_known(asked, input)) else { return };
    let Some(angle) = meant_in_radians(angle) else { return };
    let Some(problem) = with(asked, &[(input, angle)]) else { return };
    all.push(Slip {
        path: input.name().to_owned(),
        instead: Message::new().figure(Measure::Angle, angle).text(", radians taken for degrees,"),
        problem,
    });
}

/// A heading at rest that is a whole turn off: a photograph does not show how often the vehicle turned. Only where the yaw rate that it means is off, and in
/// the direction in which it is, because each turn needs the slide that ends there.
fn whole_turns(case: &Case, separations: &Separations, best: &Solution, side: Side, all: &mut Vec<Slip>) {
    let of_rest = Measurand::Output(Output::YawRate(side));
    let Some(fitted) = best.evidence.iter().find(|fitted| fitted.of == of_rest) else { return };
    let is_off = fitted.sd.is_some_and(|sd| fitted.residual.abs() > LEAST_RESIDUAL * sd);
    let mut case = case.clone();
    let rest = case.rest.as_mut().and_then(|rest| rest.vehicles[side as usize].as_mut()).and_then(|rest| rest.evidence.as_mut());
    let Some(rest) = rest.filter(|_| is_off) else { return };
    rest.rest.heading -= TAU.copysign(fitted.residual);
    let heading = rest.rest.heading;
    let Some(problem) = slid_again(&case, separations, side) else { return };
    let path = format!("rest.vehicle.{}.heading", vehicle_number(side));
    let instead = Message::new().figure(Measure::Angle, heading).text(", a whole turn from it,");
    all.push(Slip { path, instead, problem });
}

/// A mass in the other unit.
fn mass_in_pounds(case: &Case, separations: &Separations, asked: &ReconstructionProblem, side: Side, all: &mut Vec<Slip>) {
    let input = Input::Mass(side);
    let Some(mass) = asked.collision.input(input).filter(|_| is_known(asked, input)) else { return };
    for (factor, words) in [(POUND, ", pounds taken for kilograms,"), (POUND.recip(), ", kilograms taken for pounds,")] {
        let mass = factor * mass;
        let Some(problem) = with_mass(case, separations, side, mass) else { continue };
        all.push(Slip { path: input.name().to_owned(), instead: Message::new().figure(Measure::Mass, mass).text(words), problem });
    }
}

/// Returns the question with another mass of a vehicle, which a moment of inertia by its radius of gyration follows, and its slide to rest.
fn with_mass(case: &Case, separations: &Separations, side: Side, mass: f64) -> Option<ReconstructionProblem> {
    let mut case = case.with(&[(Parameter::Input(Input::Mass(side)), mass)]);
    let yaw_inertia = case.collision.input(Input::YawInertia(side))?;
    if let Some(rest) = case.rest.as_mut().and_then(|rest| rest.vehicles[side as usize].as_mut()) {
        (rest.slide.vehicle.mass, rest.slide.vehicle.yaw_inertia) = (mass, yaw_inertia);
    }
    slid_again(&case, separations, side)
}

/// Returns the question of a case in which the slide of one vehicle is another; the other vehicle separates as it does in the question.
fn slid_again(case: &Case, separations: &Separations, side: Side) -> Option<ReconstructionProblem> {
    let mut separations = separations.clone();
    if let Some(rest) = case.rest.as_ref().and_then(|rest| rest.vehicles[side as usize].as_ref()) {
        separations[side as usize] = rest.separation().transpose().ok()?;
    }
    Question::of(case, &separations).ok().map(|question| question.asked)
}
