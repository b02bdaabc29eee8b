//! Second derivatives of one output by all inputs.
//!
//! Given the adjoint of an output, its second derivatives are those of ℓ with the impulse held constant, plus the contribution of the change of the impulse:
//! for each pair of inputs x and y, the mixed derivative of ℓ by x and P times ∂P/∂y, and the same with x and y exchanged. A product in the output adds the
//! rows of its two factors. Together they are
//!
//! ```text
//! ℓ_xy + u_x·p_y + p_x·u_y,    p the rows of the impulse
//! ```

use super::body_partials::BodyPartials;
use super::cotangent::{self, partials};
use super::impulse_adjoint::{Cotangent, ImpulseAdjoint, Settled, Slip};
use super::jacobian::Rows;
use super::{Curved, Gradient, Hessian};
use crate::collision::Collision;
use crate::frame::{Nt, Xy};
use crate::impact::Impact;
use crate::input::{Input, Side};
use crate::output::Output;
use crate::scalar::Real;
use crate::vehicle::Party;

/// Returns one output of an impact with its first and second derivatives by every input.
pub(super) fn curvature<T: Real<Mask = bool> + Copy>(collision: &Collision<T>, impact: &Impact<T>, of: Output) -> Curved<T> {
    let mut adjoint = ImpulseAdjoint::of(collision, &collision.contact(), impact);
    if of == Output::CriticalImpulseRatio {
        adjoint = adjoint.critical(impact.critical_impulse);
    }
    let rows = Rows::of(&adjoint);
    let mut terms = HessianTerms::nothing();
    if let Some(cotangent) = cotangent::cotangent(&adjoint, impact, of) {
        let settled = adjoint.settle(cotangent);
        terms.add_equation(&adjoint, &settled, &rows);
        terms.add_slip(&adjoint, &settled);
    }
    terms.add_output(&adjoint, &rows, of);
    if matches!(of, Output::EnergyBefore | Output::EnergyAfter) {
        terms.add_energy(&collision.one, Side::One);
        terms.add_energy(&collision.two, Side::Two);
    }
    Curved { value: of.of(collision, impact), by: cotangent::gradient(collision, impact, &adjoint, of), twice: terms.finish(&rows.impulse) }
}

/// Partial sums of the second derivatives.
struct HessianTerms<T> {
    /// Terms with the impulse held constant.
    twice: Hessian<T>,
    /// u, which is combined with the rows of the impulse.
    with: Nt<Gradient<T>>,
}

impl<T: Real<Mask = bool> + Copy> HessianTerms<T> {
    fn nothing() -> Self {
        HessianTerms { twice: Hessian::zero(), with: Nt { n: Gradient::zero(), t: Gradient::zero() } }
    }

    /// Adds the terms of the equation of the impulse.
    fn add_equation(&mut self, adjoint: &ImpulseAdjoint<T>, settled: &Settled<T>, rows: &Rows<T>) {
        for partials in adjoint.partials.iter().flatten() {
            partials.add_hessian(&settled.held, &adjoint.plane, &mut self.twice);
            partials.add_mixed(&settled.held, &mut self.with);
        }
        // α increases with the restitution.
        let growing = adjoint.by_restitution(settled.equation);
        self.add_row(Input::Restitution, &Gradient::mix(growing.n, &rows.approach.n, growing.t, &rows.approach.t));
    }

    /// Adds the terms of the ratio, if an input specifies it.
    fn add_slip(&mut self, adjoint: &ImpulseAdjoint<T>, settled: &Settled<T>) {
        match adjoint.slip {
            Slip::Ends | Slip::Limited { slides: false, .. } => (),
            Slip::AtRatio { side, .. } | Slip::Limited { slides: true, side, .. } => {
                self.with.n.add(Input::ImpulseRatio, settled.slip * side)
            }
            Slip::OfCritical { fraction, sticking, .. } => {
                self.with.n.add_scaled(settled.slip, &adjoint.ratio_row());
                // The ratio is the fraction times the ratio of the sticking impulse, and both change.
                let cotangent = settled.slip * adjoint.impulse.n;
                let ends = adjoint.sticking(sticking);
                let rows = Rows::of(&ends);
                let of_ratio = Cotangent::of_ratio(sticking);
                let mut ratio = HessianTerms::nothing();
                ratio.add_equation(&ends, &ends.settle(of_ratio), &rows);
                ratio.add_ratio(sticking, &rows);
                self.add_scaled(cotangent * fraction, &ratio.finish(&rows.impulse));
                let by = of_ratio.impulse * cotangent;
                self.add_row(Input::ImpulseRatio, &Gradient::mix(by.n, &rows.impulse.n, by.t, &rows.impulse.t));
            }
        }
    }

    fn add_scaled(&mut self, by: T, other: &Hessian<T>) {
        for (x, y) in self.twice.0.as_flattened_mut().iter_mut().zip(other.0.as_flattened()) {
            *x = *x + by * *y;
        }
    }

    /// Adds the second derivatives of the output itself.
    fn add_output(&mut self, adjoint: &ImpulseAdjoint<T>, rows: &Rows<T>, of: Output) {
        let p = adjoint.impulse;
        let (zero, one) = (T::int(0), T::int(1));
        match of {
            Output::VelocityX(side) | Output::DeltaVX(side) => self.add_push(adjoint, side, Xy { x: one, y: zero }),
            Output::VelocityY(side) | Output::DeltaVY(side) => self.add_push(adjoint, side, Xy { x: zero, y: one }),
            Output::ImpulseX => self.add_turn(one, adjoint.plane.to_contact(Xy { x: one, y: zero }), p),
            Output::ImpulseY => self.add_turn(one, adjoint.plane.to_contact(Xy { x: zero, y: one }), p),
            Output::YawRate(side) => {
                if let Some(partials) = partials(adjoint, side) {
                    self.add_twist(partials, p);
                }
            }
            Output::DeltaVMagnitude(side) => {
                let Some(partials) = partials(adjoint, side) else { return };
                let w = partials.inverse_mass;
                let length = p.length();
                let by_length = Gradient::mix(p.n / length, &rows.impulse.n, p.t / length, &rows.impulse.t);
                // The length of P changes along its direction: d²|P| = (dP·dP − d|P| d|P|)/|P| and P·d²P/|P|, which the equation contains.
                let share = (w / length).half();
                self.with.n.add_scaled(share, &rows.impulse.n);
                self.with.t.add_scaled(share, &rows.impulse.t);
                self.with.n.add_scaled(-(share * p.n / length), &by_length);
                self.with.t.add_scaled(-(share * p.t / length), &by_length);
                let mut row = by_length;
                row.scale(-(w * w));
                self.add_row(Input::Mass(side), &row);
                self.twice.add(Input::Mass(side), Input::Mass(side), T::int(2) * w * w * w * length);
            }
            Output::PrincipalDirectionOfForce(side) if partials(adjoint, side).is_some() => {
                // The angle β of P: d²β = P×d²P/|P|² − 2 d|P| dβ/|P|, and the direction is −β.
                let turn = p.length_squared().inv();
                let angle = Gradient::mix(-(turn * p.t), &rows.impulse.n, turn * p.n, &rows.impulse.t);
                self.with.n.add_scaled(turn * p.n, &angle);
                self.with.t.add_scaled(turn * p.t, &angle);
            }
            Output::ImpulseRatio | Output::CriticalImpulseRatio => self.add_ratio(p, rows),
            Output::NormalSeparation => {
                let mut row = rows.approach.n;
                row.scale(-one);
                self.add_row(Input::Restitution, &row);
            }
            Output::Loss => self.add_loss(one, rows),
            Output::EnergyAfter => self.add_loss(-one, rows),
            Output::NormalWork => {
                // −½ (1 − e) P_n v_n
                self.with.n.add_scaled(-((one - adjoint.restitution).half()), &rows.approach.n);
                self.with.n.add(Input::Restitution, adjoint.approach.n.half());
                let mut row = rows.approach.n;
                row.scale(p.n.half());
                self.add_row(Input::Restitution, &row);
            }
            Output::TangentialWork => {
                self.with.t.add_scaled(-one.half(), &rows.approach.t);
                self.with.t.add_scaled(-one.half(), &rows.separation.t);
            }
            _ => (),
        }
    }

    /// Adds P_t/P_n: d²μ = (d²P_t − μ d²P_n)/P_n − 2 dμ dP_n/P_n.
    fn add_ratio(&mut self, p: Nt<T>, rows: &Rows<T>) {
        let by = Cotangent::of_ratio(p).impulse;
        let scale = -p.n.inv();
        self.with.n.add_scaled(scale * by.n, &rows.impulse.n);
        self.with.n.add_scaled(scale * by.t, &rows.impulse.t);
    }

    /// Adds ½ P·(v + V), or its negative.
    fn add_loss(&mut self, sign: T, rows: &Rows<T>) {
        let half = sign.half();
        self.with.n.add_scaled(half, &rows.approach.n);
        self.with.n.add_scaled(half, &rows.separation.n);
        self.with.t.add_scaled(half, &rows.approach.t);
        self.with.t.add_scaled(half, &rows.separation.t);
    }

    /// Adds `share` times a component of the impulse along a ground direction d, given in contact axes, which turns backwards relative to the crush plane.
    fn add_turn(&mut self, share: T, direction: Nt<T>, p: Nt<T>) {
        self.twice.add(Input::CrushPlane, Input::CrushPlane, -(share * direction.dot(p)));
        self.with.add(Input::CrushPlane, -(direction.quarter_turn() * share));
    }

    /// Adds −σ w P·d.
    fn add_push(&mut self, adjoint: &ImpulseAdjoint<T>, side: Side, direction: Xy<T>) {
        let Some(partials) = partials(adjoint, side) else { return };
        let (w, p, d) = (partials.inverse_mass, adjoint.impulse, adjoint.plane.to_contact(direction));
        let push = -(partials.sign * w);
        self.add_turn(push, d, p);
        self.twice.add(Input::Mass(side), Input::Mass(side), T::int(2) * push * w * w * d.dot(p));
        self.twice.add_pair(Input::Mass(side), Input::CrushPlane, push * w * d.cross(p));
        self.with.add(Input::Mass(side), -(d * (push * w)));
    }

    /// Adds −σ j r×P.
    fn add_twist(&mut self, partials: &BodyPartials<T>, p: Nt<T>) {
        let (side, j) = (partials.side, partials.inverse_yaw_inertia);
        let twist = -(partials.sign * j);
        let c = partials.moments(p);
        let (by, twice) = (c.by_arm(), c.twice_by_arm());
        let inertia = Input::YawInertia(side);
        self.twice.add(inertia, inertia, T::int(2) * twist * j * j * c.here);
        self.with.add(inertia, -(partials.arm.quarter_turn() * (twist * j)));
        let by_impulse = [-partials.arm, partials.ahead.quarter_turn(), -partials.ahead];
        for (k, input) in partials.arm_inputs().into_iter().enumerate() {
            self.twice.add_pair(inertia, input, -(twist * j * by[k]));
            self.with.add(input, by_impulse[k] * twist);
            for (l, other) in partials.arm_inputs().into_iter().enumerate() {
                self.twice.add(input, other, twist * twice[k][l]);
            }
            self.twice.add_pair(Input::CrushPlane, input, -(twist * twice[0][k]));
        }
        // The crush plane turns the arm backwards.
        self.twice.add(Input::CrushPlane, Input::CrushPlane, twist * twice[0][0]);
        self.twice.add_pair(Input::CrushPlane, inertia, twist * j * c.heading);
        self.with.add(Input::CrushPlane, partials.arm * twist);
    }

    fn add_energy(&mut self, party: &Party<T>, side: Side) {
        let Some(vehicle) = party.vehicle() else { return };
        let v = vehicle.motion.velocity;
        self.twice.add(Input::VelocityX(side), Input::VelocityX(side), vehicle.mass);
        self.twice.add(Input::VelocityY(side), Input::VelocityY(side), vehicle.mass);
        self.twice.add(Input::YawRate(side), Input::YawRate(side), vehicle.yaw_inertia);
        self.twice.add_pair(Input::Mass(side), Input::VelocityX(side), v.x);
        self.twice.add_pair(Input::Mass(side), Input::VelocityY(side), v.y);
        self.twice.add_pair(Input::YawInertia(side), Input::YawRate(side), vehicle.motion.yaw_rate);
    }

    /// Adds a product of an input and a quantity with this row.
    fn add_row(&mut self, input: Input, row: &Gradient<T>) {
        let at = input.index();
        for (i, &x) in row.0.iter().enumerate() {
            self.twice.0[at][i] = self.twice.0[at][i] + x;
            self.twice.0[i][at] = self.twice.0[i][at] + x;
        }
    }

    /// Adds the terms of the change of the impulse.
    fn finish(mut self, p: &Nt<Gradient<T>>) -> Hessian<T> {
        let u = &self.with;
        for (i, row) in self.twice.0.iter_mut().enumerate() {
            for (j, entry) in row.iter_mut().enumerate() {
                // In pairs, so that both entries of a pair have the same bits.
                let moved = (u.n.0[i] * p.n.0[j] + u.n.0[j] * p.n.0[i]) + (u.t.0[i] * p.t.0[j] + u.t.0[j] * p.t.0[i]);
                *entry = *entry + moved;
            }
        }
        self.twice
    }
}
