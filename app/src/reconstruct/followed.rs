//! A separation that leads to a rest position, and those beside it that other numbers of the vehicle lead to.

use planar_impact::post_impact::{RestEvidence, Separation};
use planar_impact::{Motion, Side};

use super::from_rest::Separations;
use super::inputs::without_deviation;
use crate::case::{Case, Inputs, Parameter, RestInputs, RestOfVehicle, vehicle_number};
use crate::issue::Issue;

/// The inputs of a case, and the separation of one vehicle that they lead to, or nearly so.
pub struct Followed<'a> {
    /// The rest positions of the case.
    pub rest: &'a RestInputs,
    /// The inputs.
    pub inputs: &'a Inputs,
    /// The vehicle.
    pub side: Side,
    /// Its separation.
    pub separation: &'a Separation,
}

impl<'a> Followed<'a> {
    /// Returns those of a case, at values of its inputs.
    pub fn all(case: &'a Case, inputs: &'a Inputs, separations: &'a Separations) -> impl Iterator<Item = Followed<'a>> {
        let of_side = move |(side, separation): (Side, &'a Option<Separation>)| {
            Some(Followed { rest: case.rest.as_ref()?, inputs, side, separation: separation.as_ref()? })
        };
        Side::ALL.into_iter().zip(separations).filter_map(of_side)
    }

    /// Returns the rest position with other values of the inputs.
    pub fn with(&self, values: &[(Parameter, f64)]) -> Option<RestOfVehicle> {
        self.rest.of(&self.inputs.set_all(values).vehicles).vehicles[self.side as usize].clone()
    }

    /// Returns the separation that a rest position leads to.
    pub fn near(&self, rest: &RestOfVehicle) -> Option<Separation> {
        rest.slide.separation_near(rest.evidence.as_ref()?, rest.method, &self.separation.motion)
    }

    /// Returns the rest position of a slide on wheels that roll, without points along it, and its evidence: a way on locked wheels is compared as one.
    pub fn rolling(&self) -> Option<(RestOfVehicle, RestEvidence)> {
        let rest = self.with(&[]).filter(|rest| !rest.slide.vehicle.is_locked())?;
        let evidence = rest.evidence.clone().filter(|evidence| evidence.points.is_empty())?;
        Some((rest, evidence))
    }

    /// Returns what the rest position of [a slide on wheels that roll](Self::rolling) says of the separation to first order about another motion.
    pub fn about(&self, motion: &Motion) -> Option<Separation> {
        let (rest, evidence) = self.rolling()?;
        rest.slide.separation_about(&evidence, rest.method, motion).filter(Separation::has_deviations)
    }

    /// Returns a separation about another motion with the uncertainty of what its slide alone has, and with the fit of this one.
    pub fn widened_about(&self, there: &Separation) -> Option<Separation> {
        let widened = Followed { separation: there, ..*self }.widened().ok()?;
        Some(Separation { fit: self.separation.fit.clone(), ..widened })
    }

    /// Returns `true` if the vehicle that slides, or its pose at separation, changes with a parameter.
    pub fn depends_on(&self, parameter: Parameter, step: f64) -> bool {
        self.inputs.value(parameter).is_ok_and(|at| self.with(&[(parameter, at + step)]) != self.with(&[]))
    }

    /// Returns the separation with the uncertainty of what its slide alone has, or what cannot be followed.
    pub fn widened(&self) -> Result<Separation, Vec<Issue>> {
        let mut wider = self.separation.clone();
        let mut issues = Vec::new();
        let given = self.rest.vehicles[self.side as usize].as_ref().zip(self.inputs.vehicles[self.side as usize].as_ref());
        for (rest, vehicle, input) in
            given.iter().flat_map(|(rest, vehicle)| rest.uncertain().iter().map(move |input| (rest, vehicle, input)))
        {
            if let Some(issue) = without_deviation(input) {
                issues.push(issue);
                continue;
            }
            let sd = input.distribution.sd();
            let Some(slopes) = self.slopes(input.nominal, sd, |value| Some(rest.with_own(input.parameter, value, vehicle))) else {
                let message =
                    format!("vehicle.{}: its separation cannot be followed as {} changes", vehicle_number(self.side), input.parameter);
                issues.push(Issue::at("no-separation", input.key.clone(), message).with_help("give it without an uncertainty"));
                continue;
            };
            for (i, row) in wider.covariance.0.iter_mut().enumerate() {
                row.iter_mut().zip(slopes).for_each(|(entry, slope)| *entry += slopes[i] * slope * sd * sd);
            }
        }
        if issues.is_empty() { Ok(wider) } else { Err(issues) }
    }

    /// Returns the slopes of the separation by a number, by central differences of a step or, where there is no slide so far away, of a part of it.
    pub fn slopes(&self, at: f64, step: f64, with: impl Fn(f64) -> Option<RestOfVehicle>) -> Option<[f64; 3]> {
        let motion = |value: f64| self.near(&with(value)?).map(|separation| separation.motion.components());
        let by = |step: f64| {
            let (more, less) = (motion(at + step)?, motion(at - step)?);
            let slopes: [f64; 3] = std::array::from_fn(|i| (more[i] - less[i]) / (2.0 * step));
            slopes.iter().all(|slope| slope.is_finite()).then_some(slopes)
        };
        [1.0, 0.1, 0.01].into_iter().find_map(|share| by(share * step))
    }
}
