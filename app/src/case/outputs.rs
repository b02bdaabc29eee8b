//! Named outputs of a case.

use std::fmt;

use planar_impact::crash3::{Damaged, DamagedPair, PairEstimate, VehicleEstimate};
use planar_impact::crush::ProfileMoments;
use planar_impact::{Output, Outputs, Real, Side};

use super::parameter::number;
use crate::units::Measure;

/// One output of a case.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum CaseOutput {
    /// An output of the impact.
    Impact(Output),
    /// Crush energy of a vehicle.
    CrushEnergy(Side),
    /// Speed at which the vehicle's kinetic energy equals its crush energy.
    EquivalentEnergySpeed(Side),
    /// Mean crush depth.
    MeanDepth(Side),
    /// A CRASH3 result for the vehicle.
    Crash3(Side, Crash3Key),
    /// Speed of the vehicle when it began to brake before the impact.
    BrakingSpeed(Side),
}

/// A CRASH3 result for a vehicle.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Crash3Key {
    /// The principal direction of force (PDOF).
    Pdof,
    /// The energy correction factor.
    Correction,
    /// The corrected crush energy.
    CorrectedEnergy,
    /// The effective mass factor.
    EffectiveMassFactor,
    /// ΔV.
    DeltaVMagnitude,
}

impl Crash3Key {
    /// All results, in the order of the JSON of `crash3`.
    pub const ALL: [Crash3Key; 5] =
        [Crash3Key::Pdof, Crash3Key::Correction, Crash3Key::CorrectedEnergy, Crash3Key::EffectiveMassFactor, Crash3Key::DeltaVMagnitude];

    fn name(self) -> &'static str {
        match self {
            Crash3Key::Pdof => "pdof",
            Crash3Key::Correction => "correction",
            Crash3Key::CorrectedEnergy => "corrected_energy",
            Crash3Key::EffectiveMassFactor => "effective_mass_factor",
            Crash3Key::DeltaVMagnitude => "delta_v_magnitude",
        }
    }
}

/// All outputs of a case.
#[derive(Clone, Debug, PartialEq)]
pub struct CaseOutputs<T = f64> {
    pub(super) impact: Outputs<T>,
    pub(super) crush: [Option<CrushOutputs<T>>; 2],
    pub(super) crash3: [Option<Crash3Outputs<T>>; 2],
    pub(super) braking_speeds: [Option<T>; 2],
}

/// Results from the crush of one vehicle.
#[derive(Clone, Debug, PartialEq)]
pub struct CrushOutputs<T = f64> {
    /// The crush energy.
    pub energy: T,
    /// The equivalent energy speed.
    pub equivalent_speed: T,
    /// The mean depth.
    pub mean_depth: T,
    /// K1, K2, K3 of the profile.
    pub moments: ProfileMoments<T>,
}

/// CRASH3 results for one vehicle.
#[derive(Clone, Debug, PartialEq)]
pub struct Crash3Outputs<T = f64> {
    /// The principal direction of force, clockwise from straight ahead.
    pub pdof: T,
    /// The energy correction factor.
    pub correction: T,
    /// The corrected crush energy.
    pub corrected_energy: T,
    /// The effective mass factor.
    pub effective_mass_factor: T,
    /// ΔV.
    pub delta_v_magnitude: T,
}

impl<T: Real> Crash3Outputs<T> {
    /// Computes the results of each vehicle; `None` for a barrier.
    pub fn of_pair(pair: DamagedPair<T>) -> [Option<Self>; 2] {
        let PairEstimate { one, two, .. } = pair.evaluate();
        let of = |damaged: Damaged<T>, estimate| {
            let VehicleEstimate { correction, corrected_energy, effective_mass_factor, delta_v_magnitude, .. } = estimate;
            Crash3Outputs {
                pdof: damaged.force_direction.direction(),
                correction,
                corrected_energy,
                effective_mass_factor,
                delta_v_magnitude,
            }
        };
        [(pair.one, one), (pair.two, two)].map(|(damaged, estimate)| Some(of(damaged?, estimate?)))
    }

    /// Returns a result.
    pub fn get(&self, key: Crash3Key) -> T {
        match key {
            Crash3Key::Pdof => self.pdof.clone(),
            Crash3Key::Correction => self.correction.clone(),
            Crash3Key::CorrectedEnergy => self.corrected_energy.clone(),
            Crash3Key::EffectiveMassFactor => self.effective_mass_factor.clone(),
            Crash3Key::DeltaVMagnitude => self.delta_v_magnitude.clone(),
        }
    }
}

impl<T: Real> CaseOutputs<T> {
    /// Returns the value of an output, or `None` if the case has no such crush.
    pub fn get(&self, answer: CaseOutput) -> Option<T> {
        let crush = |side: Side| self.crush[side as usize].as_ref();
        match answer {
            CaseOutput::Impact(output) => Some(self.impact[output].clone()),
            CaseOutput::CrushEnergy(side) => crush(side).map(|crush| crush.energy.clone()),
            CaseOutput::EquivalentEnergySpeed(side) => crush(side).map(|crush| crush.equivalent_speed.clone()),
            CaseOutput::MeanDepth(side) => crush(side).map(|crush| crush.mean_depth.clone()),
            CaseOutput::Crash3(side, key) => self.crash3[side as usize].as_ref().map(|crash3| crash3.get(key)),
            CaseOutput::BrakingSpeed(side) => self.braking_speeds[side as usize].clone(),
        }
    }
}

impl CaseOutputs {
    /// Returns the magnitude of values of a measure in this collision; differences below 10⁻¹² of it are rounding.
    pub fn scale(&self, measure: Measure) -> f64 {
        let of = |output: Output| self.impact[output];
        let speeds = [Side::One, Side::Two].into_iter().flat_map(|side| {
            let after = [of(Output::VelocityX(side)), of(Output::VelocityY(side))];
            let before = [after[0] - of(Output::DeltaVX(side)), after[1] - of(Output::DeltaVY(side))];
            after.into_iter().chain(before)
        });
        let approach = libm::hypot(of(Output::NormalApproach), of(Output::TangentialApproach));
        let impulse = libm::hypot(of(Output::NormalImpulse), of(Output::TangentialImpulse));
        match measure {
            Measure::Speed | Measure::RoadSpeed => speeds.map(f64::abs).fold(approach, f64::max),
            Measure::Energy => (impulse * approach).max(of(Output::EnergyBefore)).max(of(Output::EnergyAfter)),
            Measure::Impulse | Measure::MomentImpulse => impulse,
            _ => 1.0,
        }
    }
}

impl CaseOutput {
    /// Returns the output with this name or symbol, whether or not a case has it.
    pub fn named(name: &str) -> Option<CaseOutput> {
        if let Some(output) = Output::named(name) {
            return Some(CaseOutput::Impact(output));
        }
        if let Some((side, "braking_speed")) = name.strip_prefix("before.").and_then(super::parameter::of_vehicle) {
            return Some(CaseOutput::BrakingSpeed(side));
        }
        let (side, key) = super::parameter::of_vehicle(name)?;
        match key {
            "crush_energy" => Some(CaseOutput::CrushEnergy(side)),
            "equivalent_energy_speed" => Some(CaseOutput::EquivalentEnergySpeed(side)),
            "mean_depth" => Some(CaseOutput::MeanDepth(side)),
            _ => {
                let key = key.strip_prefix("crash3.")?;
                Crash3Key::ALL.into_iter().find(|known| known.name() == key).map(|key| CaseOutput::Crash3(side, key))
            }
        }
    }

    /// Returns the paper's symbol, if it has one.
    pub fn symbol(self) -> Option<&'static str> {
        match self {
            CaseOutput::Impact(output) => Some(output.symbol()),
            _ => None,
        }
    }

    /// Returns a name that no input has, for tables in which both are columns.
    pub fn qualified_name(self) -> String {
        match self {
            CaseOutput::Impact(output) => output.qualified_name().to_owned(),
            _ => self.to_string(),
        }
    }

    /// Returns the symbol, or the name if it has none.
    pub fn short_name(self) -> String {
        self.symbol().map_or_else(|| self.to_string(), str::to_owned)
    }

    /// Returns the measure of this output.
    pub fn measure(self) -> Measure {
        match self {
            CaseOutput::Impact(output) => output.measure(),
            CaseOutput::CrushEnergy(_) => Measure::Energy,
            CaseOutput::EquivalentEnergySpeed(_) | CaseOutput::BrakingSpeed(_) => Measure::Speed,
            CaseOutput::MeanDepth(_) => Measure::Length,
            CaseOutput::Crash3(_, key) => match key {
                Crash3Key::Pdof => Measure::Angle,
                Crash3Key::Correction | Crash3Key::EffectiveMassFactor => Measure::Ratio,
                Crash3Key::CorrectedEnergy => Measure::Energy,
                Crash3Key::DeltaVMagnitude => Measure::Speed,
            },
        }
    }
}

impl fmt::Display for CaseOutput {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let vehicle = |f: &mut fmt::Formatter<'_>, side: &Side, key: &str| write!(f, "vehicle.{}.{key}", number(*side));
        match self {
            CaseOutput::Impact(output) => f.write_str(output.name()),
            CaseOutput::CrushEnergy(side) => vehicle(f, side, "crush_energy"),
            CaseOutput::EquivalentEnergySpeed(side) => vehicle(f, side, "equivalent_energy_speed"),
            CaseOutput::MeanDepth(side) => vehicle(f, side, "mean_depth"),
            CaseOutput::Crash3(side, key) => vehicle(f, side, &format!("crash3.{}", key.name())),
            CaseOutput::BrakingSpeed(side) => write!(f, "before.vehicle.{}.braking_speed", number(*side)),
        }
    }
}
