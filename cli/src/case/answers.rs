//! What is known after an impact and of the crush, each by one name.

use std::fmt;

use planar_impact::crash3::{Damaged, VehicleEstimate};
use planar_impact::crush::ProfileMoments;
use planar_impact::{Output, Outputs, Real, Side};

use super::parameter::number;
use crate::units::Measure;

/// One of the things known.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Answer {
    /// An output of the impact.
    Impact(Output),
    /// The energy that a vehicle's crush stands for.
    CrushEnergy(Side),
    /// The speed of the vehicle at which that is its kinetic energy.
    EquivalentEnergySpeed(Side),
    /// The mean depth of the crush.
    MeanDepth(Side),
    /// What CRASH3 says of the vehicle.
    Crash3(Side, Crash3Key),
}

/// What CRASH3 says of a vehicle, by one name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Crash3Key {
    /// The principal direction of force that it takes.
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
    /// All of them, in the order of the JSON of `crash3`.
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

/// Everything known.
#[derive(Clone, Debug, PartialEq)]
pub struct Answers<T = f64> {
    pub(super) impact: Outputs<T>,
    pub(super) crush: [Option<CrushAnswers<T>>; 2],
    pub(super) crash3: [Option<Crash3Answers<T>>; 2],
}

/// What the crush of one vehicle says.
#[derive(Clone, Debug, PartialEq)]
pub struct CrushAnswers<T = f64> {
    /// The crush energy.
    pub energy: T,
    /// The equivalent energy speed.
    pub equivalent_speed: T,
    /// The mean depth.
    pub mean_depth: T,
    /// K1, K2, K3 of the profile.
    pub moments: ProfileMoments<T>,
}

/// What CRASH3 says of one vehicle.
#[derive(Clone, Debug, PartialEq)]
pub struct Crash3Answers<T = f64> {
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

impl<T: Real> Crash3Answers<T> {
    /// Of a vehicle and what its damage says.
    pub(super) fn of(damaged: &Damaged<T>, estimate: VehicleEstimate<T>) -> Self {
        let VehicleEstimate { correction, corrected_energy, effective_mass_factor, delta_v_magnitude, .. } = estimate;
        let pdof = damaged.force_origin.clone().direction();
        Crash3Answers { pdof, correction, corrected_energy, effective_mass_factor, delta_v_magnitude }
    }

    fn get(&self, key: Crash3Key) -> T {
        match key {
            Crash3Key::Pdof => self.pdof.clone(),
            Crash3Key::Correction => self.correction.clone(),
            Crash3Key::CorrectedEnergy => self.corrected_energy.clone(),
            Crash3Key::EffectiveMassFactor => self.effective_mass_factor.clone(),
            Crash3Key::DeltaVMagnitude => self.delta_v_magnitude.clone(),
        }
    }
}

impl<T: Real> Answers<T> {
    /// One of them; none if the case has no such crush.
    pub fn get(&self, answer: Answer) -> Option<T> {
        let crush = |side: Side| self.crush[side as usize].as_ref();
        match answer {
            Answer::Impact(output) => Some(self.impact[output].clone()),
            Answer::CrushEnergy(side) => crush(side).map(|crush| crush.energy.clone()),
            Answer::EquivalentEnergySpeed(side) => crush(side).map(|crush| crush.equivalent_speed.clone()),
            Answer::MeanDepth(side) => crush(side).map(|crush| crush.mean_depth.clone()),
            Answer::Crash3(side, key) => self.crash3[side as usize].as_ref().map(|crash3| crash3.get(key)),
        }
    }
}

impl Answers {
    /// The size that numbers of a measure have in this collision: what is 10⁻¹² of it is rounding.
    pub fn scale(&self, measure: Measure) -> f64 {
        let of = |output: Output| self.impact[output];
        let speeds = [Side::One, Side::Two].into_iter().flat_map(|side| {
            let after = [of(Output::VelocityX(side)), of(Output::VelocityY(side))];
            let before = [after[0] - of(Output::DeltaVX(side)), after[1] - of(Output::DeltaVY(side))];
            after.into_iter().chain(before)
        });
        let approach = of(Output::NormalApproach).hypot(of(Output::TangentialApproach));
        let impulse = of(Output::NormalImpulse).hypot(of(Output::TangentialImpulse));
        match measure {
            Measure::Speed | Measure::RoadSpeed => speeds.map(f64::abs).fold(approach, f64::max),
            Measure::Energy => (impulse * approach).max(of(Output::EnergyBefore)).max(of(Output::EnergyAfter)),
            Measure::Impulse | Measure::MomentImpulse => impulse,
            _ => 1.0,
        }
    }
}

impl Answer {
    /// The answer of a name or a symbol, whether or not a case has it.
    pub fn named(name: &str) -> Option<Answer> {
        if let Some(output) = Output::named(name) {
            return Some(Answer::Impact(output));
        }
        let (side, key) = super::parameter::of_vehicle(name)?;
        match key {
            "crush_energy" => Some(Answer::CrushEnergy(side)),
            "equivalent_energy_speed" => Some(Answer::EquivalentEnergySpeed(side)),
            "mean_depth" => Some(Answer::MeanDepth(side)),
            _ => {
                let key = key.strip_prefix("crash3.")?;
                Crash3Key::ALL.into_iter().find(|known| known.name() == key).map(|key| Answer::Crash3(side, key))
            }
        }
    }

    /// The paper's symbol, if it has one.
    pub fn symbol(self) -> Option<&'static str> {
        match self {
            Answer::Impact(output) => Some(output.symbol()),
            _ => None,
        }
    }

    /// What it measures.
    pub fn measure(self) -> Measure {
        match self {
            Answer::Impact(output) => match output {
                Output::VelocityX(_)
                | Output::VelocityY(_)
                | Output::DeltaVX(_)
                | Output::DeltaVY(_)
                | Output::DeltaVMagnitude(_)
                | Output::NormalApproach
                | Output::TangentialApproach
                | Output::NormalSeparation
                | Output::TangentialSeparation => Measure::Speed,
                Output::YawRate(_) => Measure::YawRate,
                Output::PrincipalDirectionOfForce(_) => Measure::Angle,
                Output::Restitution | Output::ImpulseRatio | Output::CriticalImpulseRatio => Measure::Ratio,
                Output::NormalImpulse | Output::TangentialImpulse | Output::ImpulseX | Output::ImpulseY => Measure::Impulse,
                Output::Moment => Measure::MomentImpulse,
                Output::EnergyBefore
                | Output::EnergyAfter
                | Output::Loss
                | Output::NormalWork
                | Output::TangentialWork
                | Output::MomentWork => Measure::Energy,
            },
            Answer::CrushEnergy(_) => Measure::Energy,
            Answer::EquivalentEnergySpeed(_) => Measure::Speed,
            Answer::MeanDepth(_) => Measure::Length,
            Answer::Crash3(_, key) => match key {
                Crash3Key::Pdof => Measure::Angle,
                Crash3Key::Correction | Crash3Key::EffectiveMassFactor => Measure::Ratio,
                Crash3Key::CorrectedEnergy => Measure::Energy,
                Crash3Key::DeltaVMagnitude => Measure::Speed,
            },
        }
    }
}

impl fmt::Display for Answer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let vehicle = |f: &mut fmt::Formatter<'_>, side: &Side, key: &str| write!(f, "vehicle.{}.{key}", number(*side));
        match self {
            Answer::Impact(output) => f.write_str(output.name()),
            Answer::CrushEnergy(side) => vehicle(f, side, "crush_energy"),
            Answer::EquivalentEnergySpeed(side) => vehicle(f, side, "equivalent_energy_speed"),
            Answer::MeanDepth(side) => vehicle(f, side, "mean_depth"),
            Answer::Crash3(side, key) => vehicle(f, side, &format!("crash3.{}", key.name())),
        }
    }
}
