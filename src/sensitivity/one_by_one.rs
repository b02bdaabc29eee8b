//! Some outputs by all inputs, one after the other, for batches.
//!
//! A table of all of them is written in one loop (`jacobian`), for one collision a third faster; in lanes it exceeds the first cache.

use super::impulse_adjoint::ImpulseAdjoint;
use super::jacobian::{Mixture, Rows, critical, is_critical};
use super::{Gradient, cotangent};
use crate::collision::Collision;
use crate::contact::Contact;
use crate::frame::{Nt, Xy};
use crate::impact::Impact;
use crate::input::Input;
use crate::output::Output;
use crate::scalar::{Logic, Ordered, Real};

/// What is done with the gradients of one output after the other. Not a closure, which would not always be compiled for the instructions around it.
pub(crate) trait Gradients<T> {
    fn take(&mut self, gradient: &Gradient<T>);
}

/// Rows that several outputs have in common.
struct Shared<T> {
    on_ground: Xy<Gradient<T>>,
    work: Nt<Gradient<T>>,
}

impl<T: Real<Mask: Logic> + Copy> Shared<T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn of(mixture: &Mixture<T>, rows: &Rows<T>) -> Self {
        let mut shared =
            Shared { on_ground: Xy { x: Gradient::zero(), y: Gradient::zero() }, work: Nt { n: Gradient::zero(), t: Gradient::zero() } };
        for i in 0..Input::COUNT {
            let impulse = at(&rows.impulse, i);
            let on_ground = mixture.on_ground(impulse);
            let work = mixture.work(impulse, at(&rows.approach, i), at(&rows.separation, i));
            (shared.on_ground.x.0[i], shared.on_ground.y.0[i]) = (on_ground.x, on_ground.y);
            (shared.work.n.0[i], shared.work.t.0[i]) = (work.n, work.t);
        }
        shared
    }
}

/// Returns the derivatives by one input.
#[cfg_attr(not(debug_assertions), inline(always))]
fn at<T: Copy>(rows: &Nt<Gradient<T>>, i: usize) -> Nt<T> {
    Nt { n: rows.n.0[i], t: rows.t.0[i] }
}

/// What the gradients of all outputs are combined from.
struct Jacobian<'a, T: Ordered> {
    collision: &'a Collision<T>,
    impact: &'a Impact<T>,
    adjoint: &'a ImpulseAdjoint<T>,
    mixture: &'a Mixture<T>,
    rows: &'a Rows<T>,
    shared: &'a Shared<T>,
    /// The number of inputs. The compiler does not know it, and keeps the loops over inputs: without them the code exceeds the first cache.
    inputs: usize,
}

impl<T: Real<Mask: Logic> + Copy> Jacobian<'_, T> {
    /// Writes the derivatives of an output by every input.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn write(&self, of: Output, to: &mut Gradient<T>) {
        let Rows { impulse, approach, separation } = self.rows;
        let Shared { on_ground, work } = self.shared;
        let Mixture { ratio, length, angle, passed, .. } = self.mixture;
        // Not a function of a closure, which would not always be compiled into the loop.
        macro_rules! each {
            ($i:ident => $entry:expr) => {
                for $i in 0..self.inputs.min(Input::COUNT) {
                    to.0[$i] = $entry;
                }
            };
        }
        match of {
            Output::VelocityX(side) | Output::DeltaVX(side) => {
                let push = passed[side as usize].push;
                each!(i => push * on_ground.x.0[i]);
            }
            Output::VelocityY(side) | Output::DeltaVY(side) => {
                let push = passed[side as usize].push;
                each!(i => push * on_ground.y.0[i]);
            }
            Output::YawRate(side) => {
                let twist = passed[side as usize].twist;
                each!(i => twist.dot(at(impulse, i)));
            }
            Output::DeltaVMagnitude(side) => {
                let inverse_mass = passed[side as usize].inverse_mass;
                each!(i => inverse_mass * length.dot(at(impulse, i)));
            }
            Output::PrincipalDirectionOfForce(side) => {
                let direction = passed[side as usize].direction;
                each!(i => direction * angle.dot(at(impulse, i)));
            }
            Output::CriticalImpulseRatio if !is_critical(self.adjoint) => *to = critical(self.adjoint, self.impact),
            Output::ImpulseRatio | Output::CriticalImpulseRatio => each!(i => ratio.dot(at(impulse, i))),
            Output::NormalImpulse => *to = impulse.n,
            Output::TangentialImpulse => *to = impulse.t,
            Output::ImpulseX => *to = on_ground.x,
            Output::ImpulseY => *to = on_ground.y,
            Output::NormalApproach => *to = approach.n,
            Output::TangentialApproach => *to = approach.t,
            Output::NormalSeparation => *to = separation.n,
            Output::TangentialSeparation => *to = separation.t,
            Output::EnergyBefore => *to = cotangent::energy(self.collision),
            Output::EnergyAfter => {
                *to = cotangent::energy(self.collision);
                each!(i => to.0[i] - -(work.n.0[i] + work.t.0[i]));
            }
            Output::Loss => each!(i => -(work.n.0[i] + work.t.0[i])),
            Output::NormalWork => *to = work.n,
            Output::TangentialWork => *to = work.t,
            Output::Restitution | Output::Moment | Output::MomentWork => *to = Gradient::zero(),
        }
        // The others have no direct derivatives, or have them in the rows that they are combined from.
        use Output::*;
        if let VelocityX(_)
        | VelocityY(_)
        | YawRate(_)
        | DeltaVX(_)
        | DeltaVY(_)
        | DeltaVMagnitude(_)
        | PrincipalDirectionOfForce(_)
        | Restitution
        | ImpulseX
        | ImpulseY = of
        {
            cotangent::add_direct(self.collision, self.impact, self.adjoint, of, to);
        }
    }
}

/// Gives the derivatives of some outputs of an impact by every input, one output after the other.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn give<T: Real<Mask: Logic> + Copy>(
    collision: &Collision<T>,
    contact: &Contact<T>,
    impact: &Impact<T>,
    of: &[Output],
    to: &mut impl Gradients<T>,
) {
    let adjoint = ImpulseAdjoint::of(collision, contact, impact);
    let mixture = Mixture::of(impact, &adjoint);
    let rows = Rows::of(&adjoint);
    let shared = Shared::of(&mixture, &rows);
    let inputs = core::hint::black_box(Input::COUNT);
    let jacobian = Jacobian { collision, impact, adjoint: &adjoint, mixture: &mixture, rows: &rows, shared: &shared, inputs };
    let mut gradient = Gradient::zero();
    for of in of {
        jacobian.write(*of, &mut gradient);
        to.take(&gradient);
    }
}
