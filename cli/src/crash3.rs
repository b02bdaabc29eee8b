//! The verb `crash3`: CRASH3's damage algorithm beside planar mechanics.

mod document;
mod text;

use planar_impact::crash3::{Assumptions, Damaged, DamagedPair, PairEstimate};
use planar_impact::{ForwardLeft, Impact, Party, Real, Xy};

use crate::Done;
use crate::arguments::{Format, OfCase as Call};
use crate::case::Case;
use crate::exit::Failure;
use crate::units::{Measure, Units};

/// Reads the case and prints what CRASH3 makes of its crush.
///
/// # Errors
///
/// Everything wrong with the file, a vehicle without crush, or why the physics refuses the impact that the direction of force is taken from.
pub fn run(call: &Call) -> Result<Done, Failure> {
    let case = Case::read(&call.case).map_err(Failure::Input)?;
    let units = call.units.unwrap_or(case.units);
    let result = Comparison::of(&case, units)?;
    match call.format {
        Format::Text => Ok(Done::with(text::render(&case, &result, units))),
        Format::Json => {
            let document = document::Document::of(&case, &result);
            let text = serde_json::to_string_pretty(&document).map_err(|error| Failure::Data(error.to_string()))?;
            Ok(Done::with(text + "\n"))
        }
    }
}

/// How far two directions of force may be from opposite without a word: two estimates of a clock direction are no better.
const OPPOSITE: f64 = 0.087;

/// How far the force on one vehicle is from being opposite to that on the other, on the ground; none against a barrier.
fn crossing(case: &Case, pair: &DamagedPair) -> Option<f64> {
    let push = |damaged: &Option<Damaged>, party: &Party| {
        let from = damaged.as_ref()?.force_origin;
        Some(party.vehicle()?.heading.to_ground(ForwardLeft { forward: -from.ahead, left: from.right }))
    };
    let (one, two) = (push(&pair.one, &case.collision.one)?, push(&pair.two, &case.collision.two)?);
    Some(Real::atan2(one.cross(two), -one.dot(two)).abs())
}

/// What CRASH3 says, and what planar mechanics says beside it.
struct Comparison {
    pair: DamagedPair,
    estimate: PairEstimate,
    /// The separation velocity of each vehicle that CRASH3 goes back from: that of the evidence, or else of the case.
    separation: [Option<Xy>; 2],
    /// What both methods make of the same crush energy, where planar mechanics can be asked.
    assumptions: Option<Assumptions>,
    notes: Vec<String>,
}

impl Comparison {
    fn of(case: &Case, units: Units) -> Result<Self, Failure> {
        let parties = [&case.collision.one, &case.collision.two];
        let without = |i: &usize| parties[*i].vehicle().is_some() && case.setup.crush[*i].is_none();
        let lacking: Vec<_> = (0..2).filter(without).collect();
        if !lacking.is_empty() {
            let problem = |i: usize| {
                let help = "CRASH3 adds up the crush energy of every vehicle; one that was not crushed has depths of 0".to_owned();
                (format!("vehicle.{}.crush", i + 1), "missing".to_owned(), Some(help))
            };
            return Err(case.unfit(lacking.into_iter().map(problem)));
        }
        let mut notes = case.notes.clone();
        let given = case.setup.crush.iter().flatten().all(|crush| crush.force_origin.is_some());
        let common = case.collision.at_common_velocity().solve();
        let has_common_velocity = common.is_ok();
        if !given {
            common.map_err(|refusals| case.refuse(&refusals, units))?;
            notes.push("the PDOF is that of the common-velocity impulse, e = 0 and mu = mu0, which CRASH3 assumes".to_owned());
        }
        let pair = case.setup.damaged_pair().ok_or(Failure::Defect)?;
        let estimate = pair.solve().map_err(|refusals| case.refuse(&refusals, units))?;
        for (i, vehicle) in [&estimate.one, &estimate.two].into_iter().enumerate() {
            if vehicle.is_some_and(|vehicle| vehicle.correction >= 2.0) {
                notes.push(format!("vehicle.{}: the energy correction is at its limit of 2; the force comes 45 deg or more off", i + 1));
            }
        }
        let impact = case.collision.solve();
        if let Err(refusals) = &impact {
            let reasons: Vec<String> = refusals.reasons().iter().map(|refusal| crate::wording::refusal(refusal, units).1).collect();
            notes.push(format!("nothing to compare with: planar mechanics refuses the case, {}", reasons.join("; ")));
        }
        let impact: Option<Impact> = impact.ok();
        let responses = [impact.as_ref().map(|impact| &impact.one), impact.as_ref().map(|impact| &impact.two)];
        let separation = [0, 1].map(|i| case.separation[i].or_else(|| responses[i].map(|response| response.after.velocity)));
        if case.separation.iter().all(Option::is_none) && impact.is_some() {
            notes.push("the separation velocities are those that planar mechanics has for the case: the evidence has none".to_owned());
        }
        let energy = [&pair.one, &pair.two].into_iter().flatten().map(|damaged| damaged.crush_energy).sum();
        if impact.is_some() && case.collision.restitution >= 1.0 {
            notes.push(
                "nothing to compare with: at e = 1 the normal impulse does no work, so no crush follows from planar mechanics".to_owned(),
            );
        }
        if let Some(angle) = crossing(case, &pair).filter(|angle| *angle > OPPOSITE) {
            let angle = units.quantity(Measure::Angle, angle);
            notes.push(format!(
                "the forces on the two vehicles are {angle} from being opposite, which they must be; check the pdof of each"
            ));
        }
        if impact.is_some() && !has_common_velocity {
            notes.push("nothing to compare with: no push brings the vehicles to a common velocity".to_owned());
        }
        let can_be_asked = impact.is_some() && has_common_velocity && case.collision.restitution < 1.0;
        let assumptions = can_be_asked.then(|| Assumptions::from_crush_energy(&case.collision, energy)).flatten();
        Ok(Comparison { pair, estimate, separation, assumptions, notes })
    }
}
