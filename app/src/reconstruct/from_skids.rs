//! Skid speeds before the impact, with their uncertainty to first order.

use planar_impact::Side;
use planar_impact::num_dual::Dual64;
use planar_impact::reconstruct::{Correlation, Measurand, PriorCorrelation, Unknown, Variable};

use super::from_crush::covariance;
use super::from_rest::{Separations, outputs};
use super::inputs::{approximated, shape_approximated, without_deviation};
use crate::case::{BrakingInputs, Case, Parameter, SkidKey, UncertainInput, correlation_of, vehicle_number};
use crate::issue::Issue;
use crate::message::Message;
use crate::notice::Notice;
use crate::units::Measure;

/// Skid speeds of the vehicles that braked before the impact.
#[derive(Default)]
pub struct FromSkids {
    /// Those that are certain.
    pub known: [Option<f64>; 2],
    /// Those of uncertain skids, each with its path in the file.
    pub unknowns: Vec<(Unknown, String)>,
    /// Their correlation, where both vehicles have one.
    pub correlation: Option<PriorCorrelation>,
    /// Those with separations from rest positions, if the frictions of skids have one with that of `[rest]`.
    pub with_separations: Vec<Correlation>,
    /// Numbers of skids for whose distribution a normal one is taken.
    pub notices: Vec<Notice>,
    /// Numbers of skids that have no standard deviation.
    pub issues: Vec<Issue>,
}

impl FromSkids {
    /// Computes the skid speeds of a case, whose separations from rest positions are among its evidence.
    pub fn of(case: &Case, separations: &Separations) -> Self {
        let mut found = FromSkids::default();
        let of_skids = case.uncertain.inputs.iter().filter(|input| matches!(input.parameter, Parameter::Skid(..)));
        let of_rest = std::iter::once(Parameter::RestFriction);
        let parameters: Vec<Parameter> = of_skids.clone().map(|input| input.parameter).chain(of_rest).collect();
        found.issues = of_skids.clone().filter_map(without_deviation).collect();
        if !found.issues.is_empty() {
            return found;
        }
        let mut uncertain = Vec::new();
        for side in Side::ALL {
            let braking = case.inputs.vehicles[side as usize].as_ref().and_then(|vehicle| vehicle.braking.as_ref());
            let Some(braking) = braking else { continue };
            let by = |key: SkidKey| braking.skid_speed(|other| Dual64::new(0.0, if other == key { 1.0 } else { 0.0 })).eps;
            let slope = |parameter: &Parameter| match *parameter {
                Parameter::Skid(of, key) if of == side => by(key),
                _ => 0.0,
            };
            let (speed, slopes): (f64, Vec<f64>) = (braking.skid_speed(|_| 0.0), parameters.iter().map(slope).collect());
            let sd = covariance(&case.uncertain, &parameters, &slopes, &slopes).sqrt();
            if sd > 0.0 {
                let of = Variable::SkidSpeed(side);
                let path = format!("before.vehicle.{}", vehicle_number(side));
                let inputs: Vec<&UncertainInput> = of_skids.clone().filter(|input| input.parameter.side() == Some(side)).collect();
                let [min, max] = limits(&inputs, braking);
                found.notices.extend(inputs.iter().filter_map(|input| Some(shape_approximated(input, approximated(input)?))));
                found.notices.extend(bends(&path, speed, sd));
                found.unknowns.push((Unknown { prior: Some(sd), min, max, ..Unknown::free(of, speed) }, path));
                uncertain.push((of, sd, slopes));
            } else {
                found.known[side as usize] = Some(speed);
            }
        }
        if let [(one, sd_1, by_1), (other, sd_2, by_2)] = &uncertain[..] {
            let coefficient = covariance(&case.uncertain, &parameters, by_1, by_2) / (sd_1 * sd_2);
            found.correlation = (coefficient != 0.0).then_some(PriorCorrelation { one: *one, other: *other, coefficient });
        }
        for (skid, sd, by) in &uncertain {
            for (side, separation) in Side::ALL.into_iter().zip(separations) {
                let Some(separation) = separation else { continue };
                let parts = separation.by_friction.components().into_iter().zip(separation.covariance.deviations());
                for (of, (by_friction, deviation)) in outputs(side).into_iter().zip(parts) {
                    let slope = |parameter: &Parameter| if *parameter == Parameter::RestFriction { by_friction } else { 0.0 };
                    let slopes: Vec<f64> = parameters.iter().map(slope).collect();
                    let pair = [of, Measurand::Variable(*skid)];
                    let shared = covariance(&case.uncertain, &parameters, &slopes, by);
                    found
                        .with_separations
                        .extend(correlation_of(pair, shared, [deviation, *sd]).filter(|_| case.knowledge.of(of).is_some()));
                }
            }
        }
        found
    }
}

/// Returns a warning of a skid speed that is too uncertain for its first order: it is a root of friction and length.
fn bends(path: &str, speed: f64, sd: f64) -> Option<Notice> {
    /// Share of the speed up to which an interval of 95 % contains the truth in 94 %.
    const STRAIGHT: f64 = 0.15;
    let message = Message::from(format!("{path}: its skid speed, "))
        .figure(Measure::RoadSpeed, speed)
        .text(" ± ")
        .figure(Measure::RoadSpeed, sd)
        .text(", is taken to first order, and grows with the root of what it depends on: of so large an uncertainty the lower ends of intervals may be too high");
    (sd > STRAIGHT * speed).then(|| Notice::warning("skid-bends", path, message))
}

/// Returns the least and the greatest skid speed, if each number that is uncertain has both: the speed grows with every one of them.
fn limits(inputs: &[&UncertainInput], braking: &BrakingInputs) -> [Option<f64>; 2] {
    let ends: Option<Vec<(Parameter, [f64; 2])>> = inputs
        .iter()
        .map(|input| {
            let (min, max) = input.distribution.support();
            (input.values.is_none() && min.is_finite() && max.is_finite())
                .then_some((input.parameter, [min - input.nominal, max - input.nominal]))
        })
        .collect();
    let Some(ends) = ends else { return [None; 2] };
    let at = |end: usize| {
        let offset = |key: SkidKey| {
            let of_key = ends.iter().find(|(parameter, _)| matches!(parameter, Parameter::Skid(_, of) if *of == key));
            of_key.map_or(0.0, |(_, offsets)| offsets[end])
        };
        Some(braking.skid_speed(offset)).filter(|speed: &f64| speed.is_finite())
    };
    [at(0), at(1)]
}
