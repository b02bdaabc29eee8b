//! What is known after an impact, each by one name.
//!
//! A name is the path that the JSON of the command `solve` has for the output, with vehicles 1 and 2 as in the paper. The paper's own symbol is an alias.

use crate::collision::Collision;
use crate::energy::{KineticEnergy, Work};
use crate::frame::{Nt, Xy};
use crate::impact::{Impact, Response};
use crate::input::Side;
use crate::scalar::Real;
use crate::vehicle::Motion;
use core::fmt;
use core::ops::{Index, IndexMut};

/// Everything that is known after an impact, the magnitudes and ratios among it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Outputs<T = f64> {
    /// What happens to vehicle 1.
    pub one: VehicleOutputs<T>,
    /// What happens to vehicle 2.
    pub two: VehicleOutputs<T>,
    /// Coefficient of restitution e.
    pub restitution: T,
    /// Impulse ratio μ = P_t/P_n.
    pub impulse_ratio: T,
    /// Critical impulse ratio μ₀.
    pub critical_impulse_ratio: T,
    /// The impulse on vehicle 1 in the axes of the contact, in N s.
    pub impulse: Nt<T>,
    /// The same in ground axes.
    pub impulse_on_ground: Xy<T>,
    /// The moment impulse on vehicle 1, in N m s.
    pub moment: T,
    /// Relative velocity at the impact center before, in m/s.
    pub approach: Nt<T>,
    /// Relative velocity at the impact center after, in m/s.
    pub separation: Nt<T>,
    /// Kinetic energy of both, in J.
    pub kinetic_energy: KineticEnergy<T>,
    /// The energy lost, T_L, in J.
    pub loss: T,
    /// The work of each component of the impulse, in J.
    pub work: Work<T>,
}

/// What an impact does to one vehicle.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct VehicleOutputs<T = f64> {
    /// Its motion after the impact.
    pub after: Motion<T>,
    /// Its change of velocity in ground axes, in m/s.
    pub delta_v: Xy<T>,
    /// The magnitude of that, ΔV.
    pub delta_v_magnitude: T,
    /// The principal direction of force in rad, clockwise from straight ahead.
    pub principal_direction_of_force: T,
}

/// One of the [`Outputs`].
///
/// ```
/// use planar_impact::{Output, Side};
/// assert_eq!(Output::NormalWork.name(), "energy.normal_work");
/// assert_eq!(Output::named("dV1"), Some(Output::DeltaVMagnitude(Side::One)));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Output {
    /// Velocity along x after the impact.
    VelocityX(Side),
    /// Velocity along y after the impact.
    VelocityY(Side),
    /// Yaw rate Ω after the impact.
    YawRate(Side),
    /// Change of velocity along x.
    DeltaVX(Side),
    /// Change of velocity along y.
    DeltaVY(Side),
    /// Magnitude of the change of velocity, ΔV.
    DeltaVMagnitude(Side),
    /// Principal direction of force.
    PrincipalDirectionOfForce(Side),
    /// Coefficient of restitution e, which is an input too.
    Restitution,
    /// Impulse ratio μ.
    ImpulseRatio,
    /// Critical impulse ratio μ₀.
    CriticalImpulseRatio,
    /// Normal impulse P_n.
    NormalImpulse,
    /// Tangential impulse P_t.
    TangentialImpulse,
    /// Impulse along x.
    ImpulseX,
    /// Impulse along y.
    ImpulseY,
    /// Moment impulse.
    Moment,
    /// Normal approach velocity v_n.
    NormalApproach,
    /// Tangential approach velocity v_t.
    TangentialApproach,
    /// Normal separation velocity V_n.
    NormalSeparation,
    /// Tangential separation velocity V_t.
    TangentialSeparation,
    /// Kinetic energy before the impact.
    EnergyBefore,
    /// Kinetic energy after it.
    EnergyAfter,
    /// Energy loss T_L.
    Loss,
    /// Work W_n of the normal impulse.
    NormalWork,
    /// Work W_t of the tangential impulse.
    TangentialWork,
    /// Work W_m of the moment impulse.
    MomentWork,
}

/// The name of each output and the paper's symbol for it, in the order of [`Output::ALL`].
const NAMES: [(&str, &str); Output::COUNT] = [
    ("vehicle.1.velocity.x", "V1x"),
    ("vehicle.1.velocity.y", "V1y"),
    ("vehicle.1.yaw_rate", "Omega1"),
    ("vehicle.1.delta_v.x", "dV1x"),
    ("vehicle.1.delta_v.y", "dV1y"),
    ("vehicle.1.delta_v_magnitude", "dV1"),
    ("vehicle.1.pdof", "pdof1"),
    ("vehicle.2.velocity.x", "V2x"),
    ("vehicle.2.velocity.y", "V2y"),
    ("vehicle.2.yaw_rate", "Omega2"),
    ("vehicle.2.delta_v.x", "dV2x"),
    ("vehicle.2.delta_v.y", "dV2y"),
    ("vehicle.2.delta_v_magnitude", "dV2"),
    ("vehicle.2.pdof", "pdof2"),
    ("contact.restitution", "e"),
    ("contact.impulse_ratio", "mu"),
    ("contact.critical_impulse_ratio", "mu0"),
    ("contact.impulse.normal", "P_n"),
    ("contact.impulse.tangential", "P_t"),
    ("contact.impulse.x", "P_x"),
    ("contact.impulse.y", "P_y"),
    ("contact.impulse.moment", "M"),
    ("contact.approach.normal", "v_n"),
    ("contact.approach.tangential", "v_t"),
    ("contact.separation.normal", "V_n"),
    ("contact.separation.tangential", "V_t"),
    ("energy.before", "T_before"),
    ("energy.after", "T_after"),
    ("energy.loss", "T_L"),
    ("energy.normal_work", "W_n"),
    ("energy.tangential_work", "W_t"),
    ("energy.moment_work", "W_m"),
];

impl Output {
    /// How many there are.
    pub const COUNT: usize = 32;

    /// Every output: those of vehicle 1, those of vehicle 2, those of the contact, the energies.
    pub const ALL: [Output; Output::COUNT] = {
        use Output::*;
        use Side::{One, Two};
        [
            VelocityX(One),
            VelocityY(One),
            YawRate(One),
            DeltaVX(One),
            DeltaVY(One),
            DeltaVMagnitude(One),
            PrincipalDirectionOfForce(One),
            VelocityX(Two),
            VelocityY(Two),
            YawRate(Two),
            DeltaVX(Two),
            DeltaVY(Two),
            DeltaVMagnitude(Two),
            PrincipalDirectionOfForce(Two),
            Restitution,
            ImpulseRatio,
            CriticalImpulseRatio,
            NormalImpulse,
            TangentialImpulse,
            ImpulseX,
            ImpulseY,
            Moment,
            NormalApproach,
            TangentialApproach,
            NormalSeparation,
            TangentialSeparation,
            EnergyBefore,
            EnergyAfter,
            Loss,
            NormalWork,
            TangentialWork,
            MomentWork,
        ]
    };

    /// Its place in [`Output::ALL`].
    pub fn index(self) -> usize {
        Output::ALL.iter().position(|&output| output == self).expect("every output is among all of them")
    }

    /// The vehicle that it is of, if of one.
    pub fn side(self) -> Option<Side> {
        match self {
            Output::VelocityX(side)
            | Output::VelocityY(side)
            | Output::YawRate(side)
            | Output::DeltaVX(side)
            | Output::DeltaVY(side)
            | Output::DeltaVMagnitude(side)
            | Output::PrincipalDirectionOfForce(side) => Some(side),
            _ => None,
        }
    }

    /// Its name, such as `energy.normal_work`.
    pub fn name(self) -> &'static str {
        NAMES[self.index()].0
    }

    /// Its symbol, the paper's where it has one, such as `W_n`.
    pub fn symbol(self) -> &'static str {
        NAMES[self.index()].1
    }

    /// This output alone, of a collision and its impact.
    #[inline(always)]
    pub fn of<T: Real>(self, collision: &Collision<T>, impact: &Impact<T>) -> T {
        let response = |side| match side {
            Side::One => &impact.one,
            Side::Two => &impact.two,
        };
        match self {
            Output::VelocityX(side) => response(side).after.velocity.x.clone(),
            Output::VelocityY(side) => response(side).after.velocity.y.clone(),
            Output::YawRate(side) => response(side).after.yaw_rate.clone(),
            Output::DeltaVX(side) => response(side).delta_v.x.clone(),
            Output::DeltaVY(side) => response(side).delta_v.y.clone(),
            Output::DeltaVMagnitude(side) => response(side).delta_v_magnitude(),
            Output::PrincipalDirectionOfForce(side) => response(side).principal_direction_of_force(),
            Output::Restitution => collision.restitution.clone(),
            Output::ImpulseRatio => impact.impulse_ratio(),
            Output::CriticalImpulseRatio => impact.critical_impulse_ratio(),
            Output::NormalImpulse => impact.impulse.n.clone(),
            Output::TangentialImpulse => impact.impulse.t.clone(),
            Output::ImpulseX => impact.impulse_on_ground.x.clone(),
            Output::ImpulseY => impact.impulse_on_ground.y.clone(),
            Output::Moment => impact.moment.clone(),
            Output::NormalApproach => impact.approach.n.clone(),
            Output::TangentialApproach => impact.approach.t.clone(),
            Output::NormalSeparation => impact.separation.n.clone(),
            Output::TangentialSeparation => impact.separation.t.clone(),
            Output::EnergyBefore => impact.kinetic_energy.before.clone(),
            Output::EnergyAfter => impact.kinetic_energy.after.clone(),
            Output::Loss => impact.loss(),
            Output::NormalWork => impact.work.n.clone(),
            Output::TangentialWork => impact.work.t.clone(),
            Output::MomentWork => impact.work.m.clone(),
        }
    }

    /// The output of a name or a symbol.
    pub fn named(name: &str) -> Option<Output> {
        NAMES.iter().position(|&(path, symbol)| path == name || symbol == name).map(|at| Output::ALL[at])
    }
}

impl fmt::Display for Output {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl<T: Real> Outputs<T> {
    /// Of a collision and its impact.
    #[inline(always)]
    pub fn of(collision: &Collision<T>, impact: &Impact<T>) -> Self {
        let impact = impact.clone();
        Outputs {
            restitution: collision.restitution.clone(),
            impulse_ratio: impact.impulse_ratio(),
            critical_impulse_ratio: impact.critical_impulse_ratio(),
            loss: impact.loss(),
            one: VehicleOutputs::of(impact.one),
            two: VehicleOutputs::of(impact.two),
            impulse: impact.impulse,
            impulse_on_ground: impact.impulse_on_ground,
            moment: impact.moment,
            approach: impact.approach,
            separation: impact.separation,
            kinetic_energy: impact.kinetic_energy,
            work: impact.work,
        }
    }
}

impl<T: Real> VehicleOutputs<T> {
    #[inline(always)]
    fn of(response: Response<T>) -> Self {
        VehicleOutputs {
            delta_v_magnitude: response.delta_v_magnitude(),
            principal_direction_of_force: response.principal_direction_of_force(),
            after: response.after,
            delta_v: response.delta_v,
        }
    }
}

impl<T> Outputs<T> {
    /// The same outputs on another scalar.
    pub fn map<U>(self, mut f: impl FnMut(T) -> U) -> Outputs<U> {
        Outputs {
            one: self.one.map(&mut f),
            two: self.two.map(&mut f),
            restitution: f(self.restitution),
            impulse_ratio: f(self.impulse_ratio),
            critical_impulse_ratio: f(self.critical_impulse_ratio),
            impulse: self.impulse.map(&mut f),
            impulse_on_ground: self.impulse_on_ground.map(&mut f),
            moment: f(self.moment),
            approach: self.approach.map(&mut f),
            separation: self.separation.map(&mut f),
            kinetic_energy: self.kinetic_energy.map(&mut f),
            loss: f(self.loss),
            work: self.work.map(f),
        }
    }
}

impl<T> VehicleOutputs<T> {
    /// The same outputs on another scalar.
    pub fn map<U>(self, mut f: impl FnMut(T) -> U) -> VehicleOutputs<U> {
        VehicleOutputs {
            after: self.after.map(&mut f),
            delta_v: self.delta_v.map(&mut f),
            delta_v_magnitude: f(self.delta_v_magnitude),
            principal_direction_of_force: f(self.principal_direction_of_force),
        }
    }
}

/// The place of each output, by shared or by mutable reference.
macro_rules! place {
    ($outputs:expr, $output:expr, $($reference:tt)+) => {{
        let vehicle = match $output {
            Output::VelocityX(side)
            | Output::VelocityY(side)
            | Output::YawRate(side)
            | Output::DeltaVX(side)
            | Output::DeltaVY(side)
            | Output::DeltaVMagnitude(side)
            | Output::PrincipalDirectionOfForce(side) => match side {
                Side::One => $($reference)+ $outputs.one,
                Side::Two => $($reference)+ $outputs.two,
            },
            Output::Restitution => return $($reference)+ $outputs.restitution,
            Output::ImpulseRatio => return $($reference)+ $outputs.impulse_ratio,
            Output::CriticalImpulseRatio => return $($reference)+ $outputs.critical_impulse_ratio,
            Output::NormalImpulse => return $($reference)+ $outputs.impulse.n,
            Output::TangentialImpulse => return $($reference)+ $outputs.impulse.t,
            Output::ImpulseX => return $($reference)+ $outputs.impulse_on_ground.x,
            Output::ImpulseY => return $($reference)+ $outputs.impulse_on_ground.y,
            Output::Moment => return $($reference)+ $outputs.moment,
            Output::NormalApproach => return $($reference)+ $outputs.approach.n,
            Output::TangentialApproach => return $($reference)+ $outputs.approach.t,
            Output::NormalSeparation => return $($reference)+ $outputs.separation.n,
            Output::TangentialSeparation => return $($reference)+ $outputs.separation.t,
            Output::EnergyBefore => return $($reference)+ $outputs.kinetic_energy.before,
            Output::EnergyAfter => return $($reference)+ $outputs.kinetic_energy.after,
            Output::Loss => return $($reference)+ $outputs.loss,
            Output::NormalWork => return $($reference)+ $outputs.work.n,
            Output::TangentialWork => return $($reference)+ $outputs.work.t,
            Output::MomentWork => return $($reference)+ $outputs.work.m,
        };
        match $output {
            Output::VelocityX(_) => $($reference)+ vehicle.after.velocity.x,
            Output::VelocityY(_) => $($reference)+ vehicle.after.velocity.y,
            Output::YawRate(_) => $($reference)+ vehicle.after.yaw_rate,
            Output::DeltaVX(_) => $($reference)+ vehicle.delta_v.x,
            Output::DeltaVY(_) => $($reference)+ vehicle.delta_v.y,
            Output::DeltaVMagnitude(_) => $($reference)+ vehicle.delta_v_magnitude,
            _ => $($reference)+ vehicle.principal_direction_of_force,
        }
    }};
}

impl<T> Index<Output> for Outputs<T> {
    type Output = T;

    #[inline(always)]
    fn index(&self, output: Output) -> &T {
        place!(self, output, &)
    }
}

impl<T> IndexMut<Output> for Outputs<T> {
    #[inline(always)]
    fn index_mut(&mut self, output: Output) -> &mut T {
        place!(self, output, &mut)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::Xy;

    #[test]
    fn every_output_has_its_place_and_its_names() {
        for (i, output) in Output::ALL.into_iter().enumerate() {
            assert_eq!(output.index(), i);
            assert_eq!(Output::named(output.name()), Some(output));
            assert_eq!(Output::named(output.symbol()), Some(output));
        }
        assert_eq!(Output::named("energy"), None);
    }

    #[test]
    fn every_place_is_another() {
        let vehicle = VehicleOutputs {
            after: Motion { velocity: Xy { x: 0, y: 0 }, yaw_rate: 0 },
            delta_v: Xy { x: 0, y: 0 },
            delta_v_magnitude: 0,
            principal_direction_of_force: 0,
        };
        let mut outputs = Outputs {
            one: vehicle,
            two: vehicle,
            restitution: 0,
            impulse_ratio: 0,
            critical_impulse_ratio: 0,
            impulse: Nt { n: 0, t: 0 },
            impulse_on_ground: Xy { x: 0, y: 0 },
            moment: 0,
            approach: Nt { n: 0, t: 0 },
            separation: Nt { n: 0, t: 0 },
            kinetic_energy: KineticEnergy { before: 0, after: 0 },
            loss: 0,
            work: Work { n: 0, t: 0, m: 0 },
        };
        for output in Output::ALL {
            outputs[output] += 1;
        }
        let mut places = 0;
        outputs.map(|count| {
            assert_eq!(count, 1);
            places += 1;
        });
        assert_eq!(places, Output::COUNT);
    }
}
