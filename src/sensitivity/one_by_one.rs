//! Some outputs by all inputs, one after the other, for batches.
//!
//! The same combinations as in `jacobian`, whose table holds them all: for one collision one loop for all outputs is a third faster, and in lanes the table
//! exceeds the first cache.

use super::impulse_adjoint::{Cotangent, ImpulseAdjoint, Slip};
use super::jacobian::{Passed, Rows, critical};
use super::{Gradient, cotangent};
use crate::collision::Collision;
use crate::contact::Contact;
use crate::frame::{CrushPlane, Nt, Xy};
use crate::impact::Impact;
use crate::input::{Input, Side};
use crate::law::Law;
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
    #[inline(always)]
    fn zero() -> Self {
        Shared { on_ground: Xy { x: Gradient::zero(), y: Gradient::zero() }, work: Nt { n: Gradient::zero(), t: Gradient::zero() } }
    }

    #[inline(always)]
    fn fill(&mut self, collision: &Collision<T>, impact: &Impact<T>, rows: &Rows<T>) {
        let CrushPlane { cos, sin } = collision.crush_plane;
        let half = T::int(1).half();
        let sum = (impact.approach + impact.separation) * -half;
        let minus_half_p = impact.impulse * -half;
        for i in 0..Input::COUNT {
            let (n, t) = (rows.impulse.n.0[i], rows.impulse.t.0[i]);
            self.on_ground.x.0[i] = cos * n - sin * t;
            self.on_ground.y.0[i] = sin * n + cos * t;
            // W = −½ P (v + V)
            self.work.n.0[i] = sum.n * n + minus_half_p.n * (rows.approach.n.0[i] + rows.separation.n.0[i]);
            self.work.t.0[i] = sum.t * t + minus_half_p.t * (rows.approach.t.0[i] + rows.separation.t.0[i]);
        }
    }
}

/// What the gradients of all outputs are combined from, and the numbers by which they are.
struct Jacobian<'a, T: Ordered> {
    collision: &'a Collision<T>,
    impact: &'a Impact<T>,
    adjoint: &'a ImpulseAdjoint<T>,
    rows: &'a Rows<T>,
    shared: &'a Shared<T>,
    /// The derivatives of the ratio of the impulse, of its length and of its angle by the impulse.
    ratio: Nt<T>,
    length: Nt<T>,
    angle: Nt<T>,
    passed: [Passed<T>; 2],
    /// The number of inputs. Where the compiler does not know it, it keeps the loops over inputs: in lanes, without them, the code exceeds the first cache.
    inputs: usize,
}

impl<'a, T: Real<Mask: Logic> + Copy> Jacobian<'a, T> {
    #[inline(always)]
    fn of(
        collision: &'a Collision<T>,
        impact: &'a Impact<T>,
        adjoint: &'a ImpulseAdjoint<T>,
        rows: &'a Rows<T>,
        shared: &'a Shared<T>,
    ) -> Self {
        let p = impact.impulse;
        Jacobian {
            collision,
            impact,
            adjoint,
            rows,
            shared,
            ratio: Cotangent::of_ratio(p).impulse,
            length: p * p.length().inv(),
            angle: p.quarter_turn() * p.length_squared().inv(),
            passed: [Passed::on(adjoint.partials[0].as_ref()), Passed::on(adjoint.partials[1].as_ref())],
            inputs: Input::COUNT,
        }
    }

    /// Writes the derivatives of an output by every input.
    #[inline(always)]
    fn write(&self, of: Output, to: &mut Gradient<T>) {
        let Rows { impulse, approach, separation } = self.rows;
        let Shared { on_ground, work } = self.shared;
        // A letter each, because a function of their index would not always be compiled into the loop.
        macro_rules! each {
            ($i:ident => $entry:expr) => {
                for $i in 0..self.inputs.min(Input::COUNT) {
                    to.0[$i] = $entry;
                }
            };
        }
        macro_rules! by_impulse {
            ($n:expr, $t:expr, $i:ident) => {
                $n * impulse.n.0[$i] + $t * impulse.t.0[$i]
            };
        }
        let passed = |side: Side| &self.passed[side as usize];
        match of {
            Output::VelocityX(side) | Output::DeltaVX(side) => {
                let push = passed(side).push;
                each!(i => push * on_ground.x.0[i]);
            }
            Output::VelocityY(side) | Output::DeltaVY(side) => {
                let push = passed(side).push;
                each!(i => push * on_ground.y.0[i]);
            }
            Output::YawRate(side) => {
                let twist = passed(side).twist;
                each!(i => by_impulse!(twist.n, twist.t, i));
            }
            Output::DeltaVMagnitude(side) => {
                let inverse_mass = passed(side).inverse_mass;
                each!(i => inverse_mass * (by_impulse!(self.length.n, self.length.t, i)));
            }
            Output::PrincipalDirectionOfForce(side) => {
                let direction = passed(side).direction;
                each!(i => direction * (by_impulse!(self.angle.n, self.angle.t, i)));
            }
            Output::CriticalImpulseRatio if !self.is_critical() => *to = critical(self.adjoint, self.impact),
            Output::ImpulseRatio | Output::CriticalImpulseRatio => each!(i => by_impulse!(self.ratio.n, self.ratio.t, i)),
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

    /// Returns `true` if the ratio of the impulse is the critical one.
    #[inline(always)]
    fn is_critical(&self) -> bool {
        matches!((&self.adjoint.slip, self.adjoint.law), (Slip::Ends, Law::Brach))
    }
}

/// Gives the derivatives of some outputs of an impact by every input, one output after the other.
#[inline(always)]
pub(super) fn give<T: Real<Mask: Logic> + Copy>(
    collision: &Collision<T>,
    contact: &Contact<T>,
    impact: &Impact<T>,
    of: &[Output],
    to: &mut impl Gradients<T>,
) {
    let adjoint = ImpulseAdjoint::of(collision, contact, impact);
    let mut rows = Rows::zero();
    rows.fill(&adjoint);
    let mut shared = Shared::zero();
    shared.fill(collision, impact, &rows);
    let jacobian = Jacobian { inputs: core::hint::black_box(Input::COUNT), ..Jacobian::of(collision, impact, &adjoint, &rows, &shared) };
    let mut gradient = Gradient::zero();
    for of in of {
        jacobian.write(*of, &mut gradient);
        to.take(&gradient);
    }
}
