//! The principal outputs of cases side by side.

use super::{Answered, ComparedOutput, Variant};
use crate::case::{Case, Parameter};
use crate::solve::{Solution, Vehicle};
use crate::units::Measure;

/// A principal output: its name, its measure, and its value in a collision.
type PrincipalOutput = (&'static str, Measure, fn(&Solution) -> Option<f64>);

fn of_vehicle(solution: &Solution, place: usize, value: impl Fn(&Vehicle) -> f64) -> Option<f64> {
    Some(&solution.vehicles[place]).filter(|vehicle| !vehicle.barrier).map(value)
}

/// The principal outputs, those of which a reconstruction has an interval by their names there.
const OUTPUTS: [PrincipalOutput; 13] = [
    ("vehicle.1.delta_v_magnitude", Measure::Speed, |of| of_vehicle(of, 0, |vehicle| vehicle.delta_v_magnitude)),
    ("vehicle.2.delta_v_magnitude", Measure::Speed, |of| of_vehicle(of, 1, |vehicle| vehicle.delta_v_magnitude)),
    ("vehicle.1.pdof", Measure::Angle, |of| of_vehicle(of, 0, |vehicle| vehicle.pdof)),
    ("vehicle.2.pdof", Measure::Angle, |of| of_vehicle(of, 1, |vehicle| vehicle.pdof)),
    ("result.vehicle.1.yaw_rate", Measure::YawRate, |of| of_vehicle(of, 0, |vehicle| vehicle.yaw_rate)),
    ("result.vehicle.2.yaw_rate", Measure::YawRate, |of| of_vehicle(of, 1, |vehicle| vehicle.yaw_rate)),
    ("contact.impulse.normal", Measure::Impulse, |of| Some(of.contact.impulse.normal)),
    ("contact.impulse.tangential", Measure::Impulse, |of| Some(of.contact.impulse.tangential)),
    ("result.contact.impulse_ratio", Measure::Ratio, |of| Some(of.contact.impulse_ratio)),
    ("contact.critical_impulse_ratio", Measure::Ratio, |of| Some(of.contact.critical_impulse_ratio)),
    ("energy.normal_work", Measure::Energy, |of| Some(of.energy.normal_work)),
    ("energy.tangential_work", Measure::Energy, |of| Some(of.energy.tangential_work)),
    ("energy.loss", Measure::Energy, |of| Some(of.energy.loss)),
];

/// Returns the unknowns of the reconstructions, of which a solved case has its given value, then the principal outputs; without those that no case has.
pub(super) fn of(variants: &[Variant], answers: &[Answered]) -> Vec<ComparedOutput> {
    let mut unknowns: Vec<(&str, Measure)> = Vec::new();
    for (name, unknown) in answers.iter().filter_map(Answered::reconstruction).flat_map(|found| found.unknown.iter()) {
        if !unknowns.iter().any(|(known, _)| *known == name) {
            unknowns.push((name, unknown.measure));
        }
    }
    let of_unknown = |(name, measure): (&str, Measure)| {
        let found = |answered: &Answered| answered.reconstruction()?.unknown.get(name).cloned();
        let given = |case: &Case| Parameter::named(name).and_then(|parameter| case.inputs.value(parameter).ok());
        let value = |(variant, answered): (&Variant, &Answered)| match answered {
            Answered::Solved(_) => given(&variant.case),
            _ => found(answered)?.value,
        };
        let values = variants.iter().zip(answers).map(value).collect();
        let intervals = answers.iter().map(|answered| found(answered).map(|unknown| unknown.interval)).collect();
        ComparedOutput { name: name.to_owned(), values, intervals, scale: 0.0, measure }
    };
    let of_output = |(name, measure, value): PrincipalOutput| {
        let plain = name.strip_prefix("result.").unwrap_or(name);
        let interval = |answered: &Answered| Some(answered.reconstruction()?.derived.get(plain)?.interval.clone());
        // Momentum alone has no contact.
        let has_it = |variant: &Variant| !plain.starts_with("contact.") || !variant.case.model.is_momentum();
        let solutions = || variants.iter().zip(answers).map(|(variant, answered)| answered.solution().filter(|_| has_it(variant)));
        ComparedOutput {
            name: name.to_owned(),
            values: solutions().map(|solution| solution.and_then(value).filter(|value| value.is_finite())).collect(),
            intervals: answers.iter().map(interval).collect(),
            scale: solutions().flatten().map(|solution| solution.scale(measure)).fold(0.0, f64::max),
            measure,
        }
    };
    let all = unknowns.into_iter().map(of_unknown).chain(OUTPUTS.into_iter().map(of_output));
    all.filter(|output| output.values.iter().any(Option::is_some) || output.intervals.iter().any(Option::is_some)).collect()
}
