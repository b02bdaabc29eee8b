//! What is known after an impact and of the crush, each by one name.

use std::fmt;

use planar_impact::{Output, Outputs, Side};

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
}

/// Everything known.
#[derive(Clone, Debug, PartialEq)]
pub struct Answers<T = f64> {
    pub(super) impact: Outputs<T>,
    pub(super) crush: [Option<CrushAnswers<T>>; 2],
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
}

impl<T: Clone> Answers<T> {
    /// One of them; none if the case has no such crush.
    pub fn get(&self, answer: Answer) -> Option<T> {
        let crush = |side: Side| self.crush[side as usize].as_ref();
        match answer {
            Answer::Impact(output) => Some(self.impact[output].clone()),
            Answer::CrushEnergy(side) => crush(side).map(|crush| crush.energy.clone()),
            Answer::EquivalentEnergySpeed(side) => crush(side).map(|crush| crush.equivalent_speed.clone()),
            Answer::MeanDepth(side) => crush(side).map(|crush| crush.mean_depth.clone()),
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
            _ => None,
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
        }
    }
}
