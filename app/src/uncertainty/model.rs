//! The outputs of a case as functions of its uncertain numbers.

use planar_impact::simulation::SolvedSamples;
use planar_impact::uncertainty::{Bend, Mapped, Model, Slope};
use planar_impact::{Output, Refusals};

use super::mapping::CaseMapping;
use crate::case::{Case, CaseOutput, Crush, Domain, Inputs, Parameter, Setup};
use crate::derivative;
use crate::units::Measure;

/// A case whose uncertain numbers are arguments.
#[derive(Clone, Debug)]
pub struct CaseModel {
    inputs: Inputs,
    parameters: Vec<Parameter>,
    impact: Mapped<CaseMapping>,
}

impl CaseModel {
    /// Returns the model of a case.
    pub fn of(case: &Case) -> Self {
        let parameters: Vec<Parameter> = case.uncertain.inputs.iter().map(|input| input.parameter).collect();
        let impact = Mapped::new(case.collision, CaseMapping::of(&case.inputs, &parameters));
        CaseModel { inputs: case.inputs.clone(), parameters, impact }
    }

    /// Returns the impact alone.
    pub fn impact(&self) -> &Mapped<CaseMapping> {
        &self.impact
    }

    /// Returns the uncertain numbers.
    pub fn parameters(&self) -> &[Parameter] {
        &self.parameters
    }

    /// Returns the place of a parameter among the uncertain numbers, if it is one.
    pub fn place(&self, parameter: Parameter) -> Option<usize> {
        self.parameters.iter().position(|uncertain| *uncertain == parameter)
    }

    /// Returns the inputs of the case with given values of the uncertain numbers.
    pub fn with(&self, numbers: &[f64]) -> Inputs {
        let values: Vec<(Parameter, f64)> = self.parameters.iter().copied().zip(numbers.iter().copied()).collect();
        self.inputs.set_all(&values)
    }

    /// Returns why the numbers of a crush or of skids are impossible.
    pub fn unfit(&self, numbers: &[f64], setup: &Setup) -> Option<&'static str> {
        let beside = self.parameters.iter().zip(numbers).filter(|(parameter, _)| is_beside_impact(**parameter));
        let outside = beside.map(|(parameter, value)| (parameter.domain(), value)).find(|(domain, value)| domain.wanted(**value).is_some());
        match outside {
            Some((Domain::Positive, _)) => Some("not-positive"),
            Some(_) => Some("out-of-range"),
            None if setup.skid_speeds.iter().flatten().any(|speed| speed.is_nan()) => Some("not-slowing"),
            None => setup.crush.iter().flatten().find_map(Crush::unfit).map(|_| "no-crush"),
        }
    }

    fn has_numbers_beside_impact(&self) -> bool {
        self.parameters.iter().copied().any(is_beside_impact)
    }

    /// Returns an output with its derivatives by duals.
    fn derive(&self, numbers: &[f64], of: CaseOutput) -> Slope {
        let inputs = self.with(numbers);
        let value = inputs.as_given().evaluate().get(of).unwrap_or(f64::NAN);
        let by = |parameter: &Parameter| {
            let found = derivative::by(&inputs, *parameter).get(of).map(|dual| dual.eps);
            derivative::defined(of, value, &[*parameter], found)
        };
        Slope { value, by: self.parameters.iter().map(by).collect() }
    }
}

/// Returns `true` for a number that the impact does not depend on.
pub fn is_beside_impact(parameter: Parameter) -> bool {
    matches!(parameter, Parameter::Crush(..) | Parameter::Skid(..))
}

/// Returns an output that is one of the impact.
fn of_impact(of: CaseOutput) -> Option<Output> {
    match of {
        CaseOutput::Impact(output) => Some(output),
        _ => None,
    }
}

impl Model for CaseModel {
    type Output = CaseOutput;

    fn numbers(&self) -> usize {
        self.parameters.len()
    }

    fn is_angle(&self, of: CaseOutput) -> bool {
        of.measure() == Measure::Angle
    }

    fn value(&self, numbers: &[f64], of: CaseOutput) -> f64 {
        match of {
            CaseOutput::Impact(output) => self.impact.value(numbers, output),
            _ => self.with(numbers).as_given().evaluate().get(of).unwrap_or(f64::NAN),
        }
    }

    fn solve(&self, samples: usize, numbers: &mut [Vec<f64>], of: &[CaseOutput]) -> SolvedSamples {
        let outputs: Vec<Output> = of.iter().copied().filter_map(of_impact).collect();
        let needs_setups = outputs.len() < of.len() || self.has_numbers_beside_impact();
        let columns = if needs_setups { numbers.to_vec() } else { Vec::new() };
        let SolvedSamples { columns: solved, mut refused } = self.impact.solve(samples, numbers, &outputs);
        let mut solved = solved.into_iter();
        let mut answer = SolvedSamples::default();
        let mut others: Vec<(CaseOutput, Vec<f64>)> =
            of.iter().filter(|of| of_impact(**of).is_none()).map(|of| (*of, vec![f64::NAN; samples])).collect();
        if needs_setups {
            let mut unfit = Vec::new();
            for sample in 0..samples {
                let at: Vec<f64> = columns.iter().map(|column| column[sample]).collect();
                let setup = self.with(&at).as_given();
                if let Some(code) = self.unfit(&at, &setup) {
                    unfit.push((sample, code));
                    continue;
                }
                if !others.is_empty() {
                    let found = setup.evaluate();
                    others.iter_mut().for_each(|(of, column)| column[sample] = found.get(*of).unwrap_or(f64::NAN));
                }
            }
            for (sample, code) in unfit {
                match refused.binary_search_by_key(&sample, |(place, _)| *place) {
                    Ok(place) => refused[place].1.push(code),
                    Err(place) => refused.insert(place, (sample, vec![code])),
                }
            }
        }
        let mut others = others.into_iter().map(|(_, column)| column);
        let column = |of: &CaseOutput| if of_impact(*of).is_some() { solved.next() } else { others.next() };
        answer.columns = of.iter().map(column).map(Option::unwrap_or_default).collect();
        answer.refused = refused;
        answer
    }

    fn slope(&self, numbers: &[f64], of: CaseOutput) -> Result<Slope, Refusals> {
        match of {
            CaseOutput::Impact(output) => self.impact.slope(numbers, output),
            _ => {
                self.impact.at(numbers).solve()?;
                Ok(self.derive(numbers, of))
            }
        }
    }

    fn bend(&self, numbers: &[f64], of: CaseOutput) -> Result<Bend, Refusals> {
        if let CaseOutput::Impact(output) = of {
            return self.impact.bend(numbers, output);
        }
        self.impact.at(numbers).solve()?;
        let Slope { value, by } = self.derive(numbers, of);
        let inputs = self.with(numbers);
        let twice = |one: &Parameter, other: &Parameter| {
            let found = derivative::by_both(&inputs, *one, *other).get(of).map(|dual| dual.eps1eps2);
            derivative::defined(of, value, &[*one, *other], found)
        };
        let row = |one: &Parameter| self.parameters.iter().map(|other| twice(one, other)).collect();
        Ok(Bend { value, by, twice: self.parameters.iter().map(row).collect() })
    }
}
