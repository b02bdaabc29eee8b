//! How a crush energy departs from a straight line over the uncertainty of the crush.
//!
//! It grows with the square of the depths, and its root evenly with them: which of both is the straighter decides by which its errors are taken as normal.

use planar_impact::num_dual::HyperDual64;
use planar_impact::reconstruct::Measurand;
use planar_impact::{Real, Side};

use crate::case::{Inputs, Parameter, Uncertain};

/// A crush energy over the uncertainty of the crush, to second order.
pub struct CrushBend {
    /// Whether its root grows more evenly than itself with most of what it is uncertain by.
    pub has_straighter_root: bool,
    /// What the energy is on average larger by than that of the nominal crush, in J; of a straighter root, what this is larger by, as an energy to first order.
    pub excess: f64,
}

impl CrushBend {
    /// Computes that of an energy E of the nominal crush, whose uncertain numbers it has slopes by, and which has another standard deviation besides.
    pub fn of(inputs: &Inputs, uncertain: &Uncertain, of: Measurand, crush: &[Parameter], slopes: &[f64], besides: f64) -> Self {
        let numbers: Vec<(Parameter, f64)> = crush
            .iter()
            .zip(slopes)
            .filter(|(_, slope)| **slope != 0.0)
            .map(|(&parameter, _)| (parameter, uncertain.of(parameter).map_or(0.0, |input| input.distribution.sd())))
            .collect();
        // The second derivative of √E is (E'' − E'²/2E)/(2√E).
        let (mut of_root, mut of_energy) = (0.0, besides * besides);
        let [mut excess, mut excess_of_root] = [0.0; 2];
        for &(one, sd) in &numbers {
            for &(other, other_sd) in &numbers {
                let covariance = uncertain.correlation(one, other) * sd * other_sd;
                if covariance == 0.0 {
                    continue;
                }
                let by = |parameter| {
                    let part = |is: bool| if is { 1.0 } else { 0.0 };
                    HyperDual64::new(0.0, part(parameter == one), part(parameter == other), 0.0)
                };
                let energy = crush_energy(inputs, of, by);
                let second = energy.eps1eps2;
                let second_of_root = second - energy.eps1 * energy.eps2 / (2.0 * energy.re);
                excess += 0.5 * covariance * second;
                excess_of_root += 0.5 * covariance * second_of_root;
                if one == other {
                    let share = if second_of_root.abs() < second.abs() { &mut of_root } else { &mut of_energy };
                    *share += energy.eps1 * energy.eps1 * covariance;
                }
            }
        }
        let has_straighter_root = of_root > of_energy;
        CrushBend { has_straighter_root, excess: if has_straighter_root { excess_of_root } else { excess } }
    }
}

/// Returns a crush energy of the nominal crush, or that of both vehicles, with a part added to each uncertain number.
pub fn crush_energy<T: Real + From<f64>>(inputs: &Inputs, of: Measurand, by: impl Fn(Parameter) -> T) -> T {
    let of_side = |side: Side| {
        let crush = inputs.vehicles[side as usize].as_ref().and_then(|vehicle| vehicle.crush.as_ref())?;
        Some(crush.on_scalar(|key| by(Parameter::Crush(side, key))).energy())
    };
    let sides = Side::ALL.into_iter().filter(|side| !matches!(of, Measurand::CrushEnergyOf(own) if own != *side));
    sides.filter_map(of_side).fold(T::from(0.0), |sum, energy| sum + energy)
}
