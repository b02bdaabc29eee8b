//! All outputs by all inputs at once: the rows of the impulse and of the velocities at the impact center, and every other row as a linear combination of
//! those.
//!
//! No table of all of them is kept but that which a caller asks for: it has five thousand bytes, and of lanes more than the first cache.

#[cfg(feature = "batch")]
use super::Gradients;
use super::body_partials::BodyPartials;
use super::impulse_adjoint::{Cotangent, ImpulseAdjoint, Slip};
use super::{Gradient, Sensitive, cotangent};
use crate::collision::Collision;
use crate::contact::Contact;
use crate::frame::{CrushPlane, Nt, Xy};
use crate::impact::Impact;
use crate::input::{Input, Side};
use crate::law::Law;
use crate::output::{Output, Outputs};
use crate::scalar::{Logic, Ordered, Real};

/// The derivatives from which those of all other outputs follow.
pub(super) struct Rows<T> {
    pub(super) impulse: Nt<Gradient<T>>,
    pub(super) approach: Nt<Gradient<T>>,
    pub(super) separation: Nt<Gradient<T>>,
}

impl<T: Real<Mask: Logic> + Copy> Rows<T> {
    #[inline(always)]
    pub(super) fn of(adjoint: &ImpulseAdjoint<T>) -> Self {
        let mut rows = Rows::zero();
        rows.fill(adjoint);
        rows
    }

    #[inline(always)]
    fn zero() -> Self {
        let [impulse, approach, separation] = [Nt { n: Gradient::zero(), t: Gradient::zero() }; 3];
        Rows { impulse, approach, separation }
    }

    #[inline(always)]
    fn fill(&mut self, adjoint: &ImpulseAdjoint<T>) {
        let Nt { n, t } = axes();
        self.impulse.n = adjoint.gradient(Cotangent::of_impulse(n));
        self.impulse.t = adjoint.gradient(Cotangent::of_impulse(t));
        self.approach.n = adjoint.approach_row(n);
        self.approach.t = adjoint.approach_row(t);
        self.separation.n = rebound(adjoint, &self.approach.n, adjoint.approach.n);
        self.separation.t = sliding(adjoint, &self.impulse, &self.approach.t);
    }
}

/// Returns the directions of the two components.
#[inline(always)]
fn axes<T: Real>() -> Nt<Nt<T>> {
    Nt { n: Nt { n: T::int(1), t: T::int(0) }, t: Nt { n: T::int(0), t: T::int(1) } }
}

/// Returns the gradient of V = −e v, the normal separation velocity whatever the law.
#[inline(always)]
fn rebound<T: Real<Mask: Logic> + Copy>(adjoint: &ImpulseAdjoint<T>, approach: &Gradient<T>, v: T) -> Gradient<T> {
    let mut row = *approach;
    row.scale(-adjoint.restitution);
    row.add(Input::Restitution, -v);
    row
}

/// Returns the gradient of the tangential separation velocity.
#[inline(always)]
fn sliding<T: Real<Mask: Logic> + Copy>(adjoint: &ImpulseAdjoint<T>, impulse: &Nt<Gradient<T>>, approach: &Gradient<T>) -> Gradient<T> {
    let ends = match adjoint.law {
        Law::Brach => Gradient::zero(),
        Law::KudlichSlibar => rebound(adjoint, approach, adjoint.approach.t),
    };
    if let Slip::Ends = adjoint.slip {
        return ends;
    }
    // V_t = v_t − (K P)_t
    let mut slides = adjoint.yielding_row(axes().t);
    slides.add_scaled(T::int(1), approach);
    slides.add_scaled(-adjoint.compliance.nt, &impulse.n);
    slides.add_scaled(-adjoint.compliance.tt, &impulse.t);
    match &adjoint.slip {
        Slip::Limited { slides: mask, .. } => Gradient::select(mask.clone(), &slides, &ends),
        _ => slides,
    }
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
#[cfg(feature = "batch")]
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

/// Writes every output of an impact with its derivatives by every input.
#[inline(always)]
pub(super) fn write<T: Real<Mask: Logic> + Copy>(
    collision: &Collision<T>,
    contact: &Contact<T>,
    impact: &Impact<T>,
    to: &mut Outputs<Sensitive<T>>,
) {
    let adjoint = ImpulseAdjoint::of(collision, contact, impact);
    let mut rows = Rows::zero();
    rows.fill(&adjoint);
    let mut shared = Shared::zero();
    shared.fill(collision, impact, &rows);
    let jacobian = Jacobian::of(collision, impact, &adjoint, &rows, &shared);
    let values = Outputs::of(collision, impact);
    // Written out, so that the compiler knows each output.
    macro_rules! write {
        ($($output:expr),+) => { $({
            let to = &mut to[$output];
            to.value = values[$output];
            jacobian.write($output, &mut to.by);
        })+ };
    }
    use Output::*;
    use Side::{One, Two};
    write!(VelocityX(One), VelocityY(One), YawRate(One), DeltaVX(One), DeltaVY(One), DeltaVMagnitude(One), PrincipalDirectionOfForce(One));
    write!(VelocityX(Two), VelocityY(Two), YawRate(Two), DeltaVX(Two), DeltaVY(Two), DeltaVMagnitude(Two), PrincipalDirectionOfForce(Two));
    write!(Restitution, ImpulseRatio, CriticalImpulseRatio, NormalImpulse, TangentialImpulse, ImpulseX, ImpulseY, Moment);
    write!(NormalApproach, TangentialApproach, NormalSeparation, TangentialSeparation, EnergyBefore, EnergyAfter, Loss);
    write!(NormalWork, TangentialWork, MomentWork);
}

/// Returns the gradient of the critical ratio if the impulse has another ratio. Rarely needed, and therefore a separate function.
#[cold]
#[inline(never)]
fn critical<T: Real<Mask: Logic> + Copy>(adjoint: &ImpulseAdjoint<T>, impact: &Impact<T>) -> Gradient<T> {
    let critical = impact.critical_impulse;
    adjoint.critical(critical).gradient(Cotangent::of_ratio(critical))
}

/// The response of a vehicle to the impulse; zero for a barrier.
struct Passed<T> {
    inverse_mass: T,
    /// ∓1/m
    push: T,
    /// ∓r⊥/I
    twist: Nt<T>,
    /// −1, because it is measured clockwise.
    direction: T,
}

impl<T: Real + Copy> Passed<T> {
    #[inline(always)]
    fn on(partials: Option<&BodyPartials<T>>) -> Self {
        match partials {
            Some(partials) => Passed {
                inverse_mass: partials.inverse_mass,
                push: -(partials.sign * partials.inverse_mass),
                twist: partials.arm.quarter_turn() * -(partials.sign * partials.inverse_yaw_inertia),
                direction: T::int(-1),
            },
            None => Passed { inverse_mass: T::int(0), push: T::int(0), twist: Nt::zero(), direction: T::int(0) },
        }
    }
}
