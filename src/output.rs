//! Outputs of a collision, identified by name.
//!
//! A name is the path of the output in the JSON of the command `solve`, with vehicles 1 and 2 as in the paper. The paper's own symbol is an alias.

use crate::catalogue::catalogue;
use crate::collision::Collision;
use crate::energy::{KineticEnergy, Work};
use crate::frame::{Nt, Xy};
use crate::impact::{Impact, Response};
use crate::input::{Input, Side};
use crate::measure::Measure;
use crate::scalar::Real;
use crate::vehicle::Motion;
use core::ops::{Index, IndexMut};

/// All outputs of an impact, including magnitudes and ratios.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Outputs<T = f64> {
    /// The outputs of vehicle 1.
    pub one: VehicleOutputs<T>,
    /// The outputs of vehicle 2.
    pub two: VehicleOutputs<T>,
    /// Coefficient of restitution e.
    pub restitution: T,
    /// Impulse ratio μ = P_t/P_n.
    pub impulse_ratio: T,
    /// Critical impulse ratio μ₀.
    pub critical_impulse_ratio: T,
    /// The impulse on vehicle 1 in contact axes, in N s.
    pub impulse: Nt<T>,
    /// The impulse on vehicle 1 in ground axes, in N s.
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

/// The outputs of one vehicle.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct VehicleOutputs<T = f64> {
    /// Its motion after the impact.
    pub after: Motion<T>,
    /// Its change of velocity in ground axes, in m/s.
    pub delta_v: Xy<T>,
    /// The magnitude of the change of velocity, ΔV, in m/s.
    pub delta_v_magnitude: T,
    /// The principal direction of force in rad, clockwise from straight ahead.
    pub principal_direction_of_force: T,
}

catalogue! {
    /// One of the [`Outputs`].
    ///
    /// ```
    /// use planar_impact::{Output, Side};
    /// assert_eq!(Output::NormalWork.name(), "energy.normal_work");
    /// assert_eq!(Output::named("dV1"), Some(Output::DeltaVMagnitude(Side::One)));
    /// ```
    pub enum Output after "result." with symbols,
    /// Returns its measure.
    measure: Measure {
        of each vehicle {
            /// Velocity along x after the impact.
            VelocityX = "vehicle." _ ".velocity.x", "V" _ "x", Speed;
            /// Velocity along y after the impact.
            VelocityY = "vehicle." _ ".velocity.y", "V" _ "y", Speed;
            /// Yaw rate Ω after the impact.
            YawRate = "vehicle." _ ".yaw_rate", "Omega" _, YawRate;
            /// Change of velocity along x.
            DeltaVX = "vehicle." _ ".delta_v.x", "dV" _ "x", Speed;
            /// Change of velocity along y.
            DeltaVY = "vehicle." _ ".delta_v.y", "dV" _ "y", Speed;
            /// Magnitude of the change of velocity, ΔV.
            DeltaVMagnitude = "vehicle." _ ".delta_v_magnitude", "dV" _, Speed;
            /// Principal direction of force.
            PrincipalDirectionOfForce = "vehicle." _ ".pdof", "pdof" _, Angle;
        }
        of the pair {
            /// Coefficient of restitution e, which is an input too.
            Restitution = "contact.restitution", "e", Ratio;
            /// Impulse ratio μ.
            ImpulseRatio = "contact.impulse_ratio", "mu", Ratio;
            /// Critical impulse ratio μ₀.
            CriticalImpulseRatio = "contact.critical_impulse_ratio", "mu0", Ratio;
            /// Normal impulse P_n.
            NormalImpulse = "contact.impulse.normal", "P_n", Impulse;
            /// Tangential impulse P_t.
            TangentialImpulse = "contact.impulse.tangential", "P_t", Impulse;
            /// Impulse along x.
            ImpulseX = "contact.impulse.x", "P_x", Impulse;
            /// Impulse along y.
            ImpulseY = "contact.impulse.y", "P_y", Impulse;
            /// Moment impulse.
            Moment = "contact.impulse.moment", "M", MomentImpulse;
            /// Normal approach velocity v_n.
            NormalApproach = "contact.approach.normal", "v_n", Speed;
            /// Tangential approach velocity v_t.
            TangentialApproach = "contact.approach.tangential", "v_t", Speed;
            /// Normal separation velocity V_n.
            NormalSeparation = "contact.separation.normal", "V_n", Speed;
            /// Tangential separation velocity V_t.
            TangentialSeparation = "contact.separation.tangential", "V_t", Speed;
            /// Kinetic energy before the impact.
            EnergyBefore = "energy.before", "T_before", Energy;
            /// Kinetic energy after the impact.
            EnergyAfter = "energy.after", "T_after", Energy;
            /// Energy loss T_L.
            Loss = "energy.loss", "T_L", Energy;
            /// Work W_n of the normal impulse.
            NormalWork = "energy.normal_work", "W_n", Energy;
            /// Work W_t of the tangential impulse.
            TangentialWork = "energy.tangential_work", "W_t", Energy;
            /// Work W_m of the moment impulse.
            MomentWork = "energy.moment_work", "W_m", Energy;
        }
    }
}

impl Output {
    /// Returns the outputs that are the motion of a vehicle after the impact, in the order of [`Motion::components`].
    pub fn motion_after(side: Side) -> [Output; 3] {
        [Output::VelocityX(side), Output::VelocityY(side), Output::YawRate(side)]
    }

    /// Returns this output of a collision and its impact.
    #[cfg_attr(not(debug_assertions), inline(always))]
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

    /// Returns the output with a name or a symbol. Any name may be prefixed by `result.`, as qualified names are.
    pub fn named(name: &str) -> Option<Output> {
        match name.strip_prefix("result.") {
            Some(name) => Output::ALL.into_iter().find(|output| output.name() == name),
            None => Output::of_name(name),
        }
    }

    /// Returns a name that no input has: with the prefix `result.` if an input has the plain name.
    ///
    /// ```
    /// use planar_impact::{Output, Side};
    /// assert_eq!(Output::VelocityX(Side::One).qualified_name(), "result.vehicle.1.velocity.x");
    /// assert_eq!(Output::Loss.qualified_name(), "energy.loss");
    /// ```
    pub fn qualified_name(self) -> &'static str {
        let is_taken = Input::ALL.into_iter().any(|input| input.name() == self.name());
        if is_taken { Output::PREFIXED[self.index()] } else { self.name() }
    }
}

impl<T: Real> Outputs<T> {
    /// Computes the outputs of a collision and its impact.
    #[cfg_attr(not(debug_assertions), inline(always))]
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
    #[cfg_attr(not(debug_assertions), inline(always))]
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
    /// Converts the outputs to another scalar type.
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
    /// Converts the outputs to another scalar type.
    pub fn map<U>(self, mut f: impl FnMut(T) -> U) -> VehicleOutputs<U> {
        VehicleOutputs {
            after: self.after.map(&mut f),
            delta_v: self.delta_v.map(&mut f),
            delta_v_magnitude: f(self.delta_v_magnitude),
            principal_direction_of_force: f(self.principal_direction_of_force),
        }
    }
}

/// Returns the place of each output, by shared or by mutable reference.
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

    #[inline]
    fn index(&self, output: Output) -> &T {
        place!(self, output, &)
    }
}

impl<T> IndexMut<Output> for Outputs<T> {
    #[inline]
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
    fn a_qualified_name_is_that_of_no_input_and_every_output_has_one() {
        let qualified: [&str; 8] = [
            "result.vehicle.1.velocity.x",
            "result.vehicle.1.velocity.y",
            "result.vehicle.1.yaw_rate",
            "result.vehicle.2.velocity.x",
            "result.vehicle.2.velocity.y",
            "result.vehicle.2.yaw_rate",
            "result.contact.restitution",
            "result.contact.impulse_ratio",
        ];
        assert!(Output::ALL.into_iter().map(Output::qualified_name).filter(|name| name.starts_with("result.")).eq(qualified));
        for output in Output::ALL {
            assert_eq!(Output::named(output.qualified_name()), Some(output));
            assert_eq!(Output::named(&alloc::format!("result.{}", output.name())), Some(output));
            assert!(Input::ALL.into_iter().all(|input| input.name() != output.qualified_name()));
        }
        assert_eq!((Output::named("result.mu"), Output::named("result.result.energy.loss")), (None, None));
    }

    #[test]
    fn names_sides_and_measures_are_those_of_the_rows() {
        use Side::{One, Two};
        assert_eq!((Output::DeltaVX(Two).name(), Output::DeltaVX(Two).symbol()), ("vehicle.2.delta_v.x", "dV2x"));
        assert_eq!((Output::DeltaVX(Two).side(), Output::Loss.side()), (Some(Two), None));
        assert_eq!((Output::PrincipalDirectionOfForce(One).measure(), Output::Moment.measure()), (Measure::Angle, Measure::MomentImpulse));
        assert_eq!((Output::COUNT, Output::VelocityX(Two).index(), Output::MomentWork.index()), (32, 7, 31));
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
