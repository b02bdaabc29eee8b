//! Slips of input that explain why evidence does not agree: the same question with one number mirrored, exchanged or in another unit.

use std::f64::consts::{PI, TAU};

use planar_impact::reconstruct::{Evidence, Measurand, ReconstructionProblem, Search, Solution, Uncertainty, Variable};
use planar_impact::{Input, Measure, Output, Party, Side};

use super::from_rest::{Separations, outputs};
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
    given: Slipped,
}

/// What is given with a slip.
enum Slipped {
    /// A case, whose vehicles slide to rest again where that is another slide.
    Case(Box<Case>),
    /// A question.
    Question(Box<ReconstructionProblem>),
}

/// What slips are looked for in: the case of the file, the separations of which the question uses, and the question.
struct Given<'a> {
    case: &'a Case,
    separations: &'a Separations,
    asked: &'a ReconstructionProblem,
    goes_on: &'a dyn Fn() -> bool,
}

/// Returns a warning for each slip with which the evidence would agree, the best fit first. `case` is the case of the file, with its rest positions, of which
/// the question uses these separations; `best` is the best fit of the question as it is.
pub fn of(case: &Case, separations: &Separations, question: &Question, best: &Solution, goes_on: &dyn Fn() -> bool) -> Vec<Notice> {
    let search = Search { starts: STARTS, ..Search::default() };
    let given = Given { case, separations, asked: &question.asked, goes_on };
    let fit = |slip: Slip| {
        if !goes_on() {
            return None;
        }
        let Slip { path, instead, given: slipped } = slip;
        let answer = given.question(slipped)?.solve(&search).ok()?;
        let with_slip = answer.best();
        with_slip.is_explained().then_some((with_slip.chi_square, path, instead))
    };
    let mut found: Vec<(f64, String, Message)> = given.slips(best).into_iter().filter_map(fit).collect();
    found.sort_by(|one, other| one.0.total_cmp(&other.0));
    found.truncate(MOST_NAMED);
    found.into_iter().map(|(of_slip, path, instead)| warning(path, instead, of_slip, best.chi_square)).collect()
}

fn warning(path: String, instead: Message, of_slip: f64, chi_square: f64) -> Notice {
    let message = Message::from(format!("check {path}: with "))
        .join(instead)
        .text(format!(" the evidence would agree, with a chi-square of {of_slip:.1} in place of {chi_square:.1}"));
    Notice::warning("possible-slip", path, message)
}

impl Given<'_> {
    /// Returns the question of a slip; `None` where a vehicle cannot slide to rest with it.
    fn question(&self, slipped: Slipped) -> Option<ReconstructionProblem> {
        let case = match slipped {
            Slipped::Question(problem) => return Some(*problem),
            Slipped::Case(case) => case,
        };
        let mut separations = self.separations.clone();
        for (i, separation) in separations.iter_mut().enumerate() {
            let [rest, before] = [&*case, self.case].map(|case| case.rest.as_ref().and_then(|rest| rest.vehicles[i].as_ref()));
            if rest != before {
                *separation = rest.and_then(|rest| rest.separation(&|_, _| (self.goes_on)())).transpose().ok()?;
            }
        }
        Question::of(&case, &separations).ok().map(|question| question.asked)
    }

    /// Returns the case with other numbers, which its slides to rest follow.
    fn with(&self, values: &[(Input, f64)]) -> Slipped {
        let values: Vec<(Parameter, f64)> = values.iter().map(|(input, value)| (Parameter::Input(*input), *value)).collect();
        let case = self.case.with(&values);
        let rest = case.rest.as_ref().map(|rest| rest.of(&case.inputs.vehicles));
        Slipped::Case(Box::new(case.with_rest(rest)))
    }

    /// Returns an input that is given and not solved for.
    fn known(&self, input: Input) -> Option<f64> {
        self.asked.collision.input(input).filter(|_| self.asked.unknowns.iter().all(|unknown| unknown.of != Variable::Input(input)))
    }

    /// Returns each slip that there can be.
    fn slips(&self, best: &Solution) -> Vec<Slip> {
        let mut all = Vec::new();
        self.mirrored_centers(&mut all);
        self.exchanged_headings(&mut all);
        for side in Side::ALL {
            self.mass_in_pounds(side, &mut all);
            self.angle_in_degrees(Input::Heading(side), &mut all);
            self.whole_turns(best, side, &mut all);
        }
        self.angle_in_degrees(Input::CrushPlane, &mut all);
        let is_written = |of: Measurand| !self.is_from_rest(of);
        speeds_in_miles(self.asked, is_written, &mut all);
        yaw_rates(self.asked, is_written, &mut all);
        all
    }

    /// Returns `true` for a separation that was computed from a rest position: nobody wrote it.
    fn is_from_rest(&self, of: Measurand) -> bool {
        Side::ALL.into_iter().any(|side| self.separations[side as usize].is_some() && outputs(side).contains(&of))
    }

    /// The impact center on the other side of a vehicle, or of both.
    fn mirrored_centers(&self, all: &mut Vec<Slip>) {
        for sides in [&[Side::One][..], &[Side::Two], &Side::ALL] {
            let mirrored = |side: &Side| {
                let input = Input::ImpactCenterLeft(*side);
                self.known(input).filter(|left| *left != 0.0).map(|left| (input, -left))
            };
            let Some(values) = sides.iter().map(mirrored).collect::<Option<Vec<_>>>() else { continue };
            let mut instead = Message::new();
            for (k, (side, (_, left))) in sides.iter().zip(&values).enumerate() {
                let and = if k > 0 { " and " } else { "" };
                instead = instead.text(format!("{and}the impact center of vehicle {} at left = ", vehicle_number(*side)));
                instead = instead.figure(Measure::Length, *left);
            }
            let path = format!("vehicle.{}.impact_center", vehicle_number(sides[0]));
            all.push(Slip { path, instead: instead.text(", the mirror image,"), given: self.with(&values) });
        }
    }

    /// Each vehicle with the heading of the other.
    fn exchanged_headings(&self, all: &mut Vec<Slip>) {
        let [Some(one), Some(two)] = Side::ALL.map(|side| self.known(Input::Heading(side))) else { return };
        if (one - two).rem_euclid(TAU) == 0.0 {
            return;
        }
        let given = self.with(&[(Input::Heading(Side::One), two), (Input::Heading(Side::Two), one)]);
        all.push(Slip { path: "vehicle.1.heading".to_owned(), instead: Message::from("the headings of both vehicles exchanged"), given });
    }

    /// An angle in radians that was given as degrees.
    fn angle_in_degrees(&self, input: Input, all: &mut Vec<Slip>) {
        let Some(angle) = self.known(input).and_then(meant_in_radians) else { return };
        let instead = Message::new().figure(Measure::Angle, angle).text(", radians taken for degrees,");
        all.push(Slip { path: input.name().to_owned(), instead, given: self.with(&[(input, angle)]) });
    }

    /// A mass in the other unit.
    fn mass_in_pounds(&self, side: Side, all: &mut Vec<Slip>) {
        let input = Input::Mass(side);
        let Some(mass) = self.known(input) else { return };
        for (factor, words) in [(POUND, ", pounds taken for kilograms,"), (POUND.recip(), ", kilograms taken for pounds,")] {
            let mass = factor * mass;
            let instead = Message::new().figure(Measure::Mass, mass).text(words);
            all.push(Slip { path: input.name().to_owned(), instead, given: self.with(&[(input, mass)]) });
        }
    }

    /// A heading at rest that is a whole turn off: a photograph does not show how often the vehicle turned. Only where the yaw rate that it means is off, and in
    /// the direction in which it is, because each turn needs the slide that ends there.
    fn whole_turns(&self, best: &Solution, side: Side, all: &mut Vec<Slip>) {
        let of_rest = Measurand::Output(Output::YawRate(side));
        let Some(fitted) = best.evidence.iter().find(|fitted| fitted.of == of_rest) else { return };
        let is_off = fitted.sd.is_some_and(|sd| fitted.residual.abs() > LEAST_RESIDUAL * sd);
        let mut case = self.case.clone();
        let rest = case.rest.as_mut().and_then(|rest| rest.vehicles[side as usize].as_mut()).and_then(|rest| rest.evidence.as_mut());
        let Some(rest) = rest.filter(|_| is_off) else { return };
        rest.rest.heading -= TAU.copysign(fitted.residual);
        let path = format!("rest.vehicle.{}.heading", vehicle_number(side));
        let instead = Message::new().figure(Measure::Angle, rest.rest.heading).text(", a whole turn from it,");
        all.push(Slip { path, instead, given: Slipped::Case(Box::new(case)) });
    }
}

/// A yaw rate the other way round, or in the other unit.
fn yaw_rates(asked: &ReconstructionProblem, is_written: impl Fn(Measurand) -> bool, all: &mut Vec<Slip>) {
    let is_rate = |(_, piece): &(usize, &Evidence)| matches!(piece.of, Measurand::Output(Output::YawRate(_))) && is_written(piece.of);
    for (at, evidence) in asked.evidence.iter().enumerate().filter(is_rate) {
        let factors =
            [(-1.0, ", the other way round,"), (PI / 180.0, ", degrees taken for radians,"), (180.0 / PI, ", radians taken for degrees,")];
        all.extend(factors.map(|(factor, words)| {
            let mut problem = asked.clone();
            scale(&mut problem, Scaled::Evidence(at), factor);
            let instead = Message::new().figure(evidence.of.measure(), factor * evidence.value).text(words);
            Slip { path: evidence.of.name().to_owned(), instead, given: Slipped::Question(Box::new(problem)) }
        }));
    }
}

/// A number of the question that a factor multiplies.
#[derive(Clone, Copy)]
enum Scaled {
    /// A piece of evidence, by its place.
    Evidence(usize),
    /// The speed of a vehicle before the impact.
    Speed(Side),
}

fn scale(problem: &mut ReconstructionProblem, scaled: Scaled, factor: f64) {
    match scaled {
        Scaled::Evidence(at) => {
            let piece = &mut problem.evidence[at];
            piece.value *= factor;
            if let Uncertainty::StandardDeviation(sd) = &mut piece.uncertainty {
                *sd *= factor.abs();
            }
        }
        Scaled::Speed(side) => {
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
fn speeds_in_miles(asked: &ReconstructionProblem, is_written: impl Fn(Measurand) -> bool, all: &mut Vec<Slip>) {
    let is_speed = |piece: &Evidence| piece.of.measure() == Measure::Speed && is_written(piece.of);
    let measured = asked.evidence.iter().enumerate().filter(|(_, piece)| is_speed(piece));
    let mut speeds: Vec<(Scaled, Option<Side>, String, f64)> =
        measured.map(|(at, piece)| (Scaled::Evidence(at), piece.of.side(), piece.of.name().to_owned(), piece.value)).collect();
    let known =
        |side| Some((Scaled::Speed(side), Some(side), format!("vehicle.{}.speed", vehicle_number(side)), known_speed(asked, side)?));
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
            let (path, instead) = (speeds[of_group[0]].2.clone(), instead.text(words));
            all.push(Slip { path, instead, given: Slipped::Question(Box::new(problem)) });
        }
    }
}

/// Returns an angle that was meant in radians but given in degrees, which only small numbers can be. Numbers without a unit that are no angle in radians are
/// refused where they are read.
fn meant_in_radians(angle: f64) -> Option<f64> {
    let degrees = angle.to_degrees();
    (angle != 0.0 && degrees.abs() < TAU).then_some(degrees)
}
