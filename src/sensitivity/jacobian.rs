//! All outputs by all inputs at once: the rows of the impulse and of the approach velocity, and every other row as a mixture of those.

use super::lever::Lever;
use super::waist::{Slip, Waist, Worth};
use super::worth::add_energy;
use super::{Gradient, Sensitive};
use crate::collision::Collision;
use crate::energy::{KineticEnergy, Work};
use crate::frame::{Nt, Xy};
use crate::impact::Impact;
use crate::input::{Input, Side};
use crate::law::Law;
use crate::output::{Outputs, VehicleOutputs};
use crate::scalar::{Ordered, Real};
use crate::vehicle::Motion;

/// Every output of an impact with its derivatives by every input.
#[inline(always)]
pub(super) fn of<T: Real + Copy + Ordered<Mask = bool>>(collision: &Collision<T>, impact: &Impact<T>) -> Outputs<Sensitive<T>> {
    let values = Outputs::of(collision, impact);
    let waist = Waist::of(collision, impact);
    let rows = Rows::of(&waist);
    let p = impact.impulse;
    let (cos, sin) = (collision.crush_plane.cos, collision.crush_plane.sin);

    let mut impulse_x = Gradient::mix(cos, &rows.impulse.n, -sin, &rows.impulse.t);
    impulse_x.add(Input::CrushPlane, -impact.impulse_on_ground.y);
    let mut impulse_y = Gradient::mix(sin, &rows.impulse.n, cos, &rows.impulse.t);
    impulse_y.add(Input::CrushPlane, impact.impulse_on_ground.x);
    let on_ground = Xy { x: impulse_x, y: impulse_y };

    // W_c = −½ P_c (v_c + V_c)
    let work = |impulse: T, sum: T, by_impulse: &Gradient<T>, v: &Gradient<T>, s: &Gradient<T>| {
        let (a, b) = (-sum.half(), -impulse.half());
        Gradient(core::array::from_fn(|i| a * by_impulse.0[i] + b * (v.0[i] + s.0[i])))
    };
    let sum = impact.approach + impact.separation;
    let normal_work = work(p.n, sum.n, &rows.impulse.n, &rows.approach.n, &rows.separation.n);
    let tangential_work = work(p.t, sum.t, &rows.impulse.t, &rows.approach.t, &rows.separation.t);
    let loss = Gradient(core::array::from_fn(|i| -(normal_work.0[i] + tangential_work.0[i])));
    let mut before = Gradient::zero();
    add_energy(&collision.one, Side::One, &mut before);
    add_energy(&collision.two, Side::Two, &mut before);
    let after = Gradient(core::array::from_fn(|i| before.0[i] - loss.0[i]));

    let impulse_ratio = ratio(p, &rows.impulse);
    let critical_impulse_ratio = match (&waist.slip, waist.law) {
        (Slip::Ends, Law::Brach) => impulse_ratio,
        _ => waist.critical(impact.critical_impulse).gradient(Worth::of_ratio(impact.critical_impulse)),
    };
    let mut restitution = Gradient::zero();
    restitution.add(Input::Restitution, T::int(1));

    let nothing = |value| Sensitive { value, by: Gradient::zero() };
    let side = |values: &VehicleOutputs<T>, lever: &Option<Lever<T>>| match lever {
        Some(lever) => vehicle(values, lever, p, impact.impulse_on_ground, &rows.impulse, &on_ground),
        None => values.map(nothing),
    };
    let with = |value, by| Sensitive { value, by };
    Outputs {
        one: side(&values.one, &waist.levers[0]),
        two: side(&values.two, &waist.levers[1]),
        restitution: with(values.restitution, restitution),
        impulse_ratio: with(values.impulse_ratio, impulse_ratio),
        critical_impulse_ratio: with(values.critical_impulse_ratio, critical_impulse_ratio),
        impulse: rows.impulse.with(p),
        impulse_on_ground: Xy { x: with(impact.impulse_on_ground.x, on_ground.x), y: with(impact.impulse_on_ground.y, on_ground.y) },
        moment: nothing(values.moment),
        approach: rows.approach.with(impact.approach),
        separation: rows.separation.with(impact.separation),
        kinetic_energy: KineticEnergy {
            before: with(values.kinetic_energy.before, before),
            after: with(values.kinetic_energy.after, after),
        },
        loss: with(values.loss, loss),
        work: Work { n: with(values.work.n, normal_work), t: with(values.work.t, tangential_work), m: nothing(values.work.m) },
    }
}

/// The derivatives of what all other outputs are made of.
pub(super) struct Rows<T> {
    pub(super) impulse: Nt<Gradient<T>>,
    pub(super) approach: Nt<Gradient<T>>,
    pub(super) separation: Nt<Gradient<T>>,
}

impl<T: Real + Copy> Rows<T> {
    #[inline(always)]
    pub(super) fn of(waist: &Waist<T>) -> Self {
        let (zero, one) = (T::int(0), T::int(1));
        let (n, t) = (Nt { n: one, t: zero }, Nt { n: zero, t: one });
        let impulse = Nt { n: waist.gradient(Worth::of_impulse(n)), t: waist.gradient(Worth::of_impulse(t)) };
        let approach = Nt { n: waist.approach_row(n), t: waist.approach_row(t) };
        // V_n = −e v_n, whatever the law.
        let rebound = |approach: &Gradient<T>, v: T| {
            let mut row = *approach;
            row.scale(-waist.restitution);
            row.add(Input::Restitution, -v);
            row
        };
        let separation_t = match (&waist.slip, waist.law) {
            (Slip::Ends, Law::Brach) => Gradient::zero(),
            (Slip::Ends, Law::KudlichSlibar) => rebound(&approach.t, waist.approach.t),
            // V_t = v_t − (K P)_t
            _ => {
                let mut row = approach.t;
                for lever in waist.levers.iter().flatten() {
                    lever.add_yielding(t, waist.impulse, &mut row);
                }
                row.add_scaled(-waist.compliance.nt, &impulse.n);
                row.add_scaled(-waist.compliance.tt, &impulse.t);
                row
            }
        };
        let separation = Nt { n: rebound(&approach.n, waist.approach.n), t: separation_t };
        Rows { impulse, approach, separation }
    }
}

/// The ratio of the components of the impulse.
#[inline(always)]
fn ratio<T: Real + Copy>(p: Nt<T>, rows: &Nt<Gradient<T>>) -> Gradient<T> {
    let scale = p.n.inv();
    Gradient::mix(scale, &rows.t, -(p.t * scale * scale), &rows.n)
}

#[inline(always)]
fn vehicle<T: Real + Copy>(
    values: &VehicleOutputs<T>,
    lever: &Lever<T>,
    p: Nt<T>,
    impulse: Xy<T>,
    rows: &Nt<Gradient<T>>,
    on_ground: &Xy<Gradient<T>>,
) -> VehicleOutputs<Sensitive<T>> {
    let side = lever.side;
    let (w, j) = (lever.inverse_mass, lever.inverse_yaw_inertia);
    let one = T::int(1);
    let with = |value, by| Sensitive { value, by };

    let push = -(lever.sign * w);
    let pushed = |row: &Gradient<T>, along: T| {
        let mut row = *row;
        row.scale(push);
        row.add(Input::Mass(side), -(push * w * along));
        row
    };
    let delta_v = Xy { x: pushed(&on_ground.x, impulse.x), y: pushed(&on_ground.y, impulse.y) };
    let mut velocity = delta_v;
    velocity.x.add(Input::VelocityX(side), one);
    velocity.y.add(Input::VelocityY(side), one);

    let twist = -(lever.sign * j);
    let c = lever.moments(p);
    let mut yaw_rate = Gradient::mix(twist * lever.arm.n, &rows.t, -(twist * lever.arm.t), &rows.n);
    yaw_rate.add(Input::YawInertia(side), -(twist * j * c.here));
    for (input, by) in lever.arm_inputs().into_iter().zip(c.by_arm()) {
        yaw_rate.add(input, twist * by);
    }
    yaw_rate.add(Input::CrushPlane, -(twist * c.heading));
    yaw_rate.add(Input::YawRate(side), one);

    let length = p.length();
    let scale = w / length;
    let mut magnitude = Gradient::mix(scale * p.n, &rows.n, scale * p.t, &rows.t);
    magnitude.add(Input::Mass(side), -(w * w * length));

    let turn = p.length_squared().inv();
    let mut direction = Gradient::mix(turn * p.t, &rows.n, -(turn * p.n), &rows.t);
    direction.add(Input::CrushPlane, -one);
    direction.add(Input::Heading(side), one);

    VehicleOutputs {
        after: Motion {
            velocity: Xy { x: with(values.after.velocity.x, velocity.x), y: with(values.after.velocity.y, velocity.y) },
            yaw_rate: with(values.after.yaw_rate, yaw_rate),
        },
        delta_v: Xy { x: with(values.delta_v.x, delta_v.x), y: with(values.delta_v.y, delta_v.y) },
        delta_v_magnitude: with(values.delta_v_magnitude, magnitude),
        principal_direction_of_force: with(values.principal_direction_of_force, direction),
    }
}

impl<T: Copy> Nt<Gradient<T>> {
    #[inline(always)]
    fn with(&self, values: Nt<T>) -> Nt<Sensitive<T>> {
        Nt { n: Sensitive { value: values.n, by: self.n }, t: Sensitive { value: values.t, by: self.t } }
    }
}
