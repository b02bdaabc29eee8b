//! Skid speeds before the impact, with their uncertainty to first order.

use planar_impact::Side;
use planar_impact::num_dual::Dual64;
use planar_impact::reconstruct::{Correlation, Measurand, PriorCorrelation, Unknown, Variable};

use super::from_crush::covariance;
use super::from_rest::{Separations, outputs};
use super::inputs::without_deviation;
use crate::case::{Case, Parameter, SkidKey, correlation_of, vehicle_number};
use crate::issue::Issue;

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
        found.issues = of_skids.filter_map(without_deviation).collect();
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
                found.unknowns.push((Unknown { prior: Some(sd), ..Unknown::free(of, speed) }, path));
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
