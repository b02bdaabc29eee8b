//! The same impact, written by hand for f64 only: the reference for the generic kernel.

use crate::inputs::{Angles, DIRECTIONS};

/// A collision at the critical ratio, with its angles as cosines and sines.
#[derive(Clone, Copy)]
pub struct Directions {
    m1: f64,
    m2: f64,
    i1: f64,
    i2: f64,
    h1: [f64; 2],
    h2: [f64; 2],
    c1: [f64; 2],
    c2: [f64; 2],
    v1: [f64; 2],
    v2: [f64; 2],
    w1: f64,
    w2: f64,
    plane: [f64; 2],
    e: f64,
}

impl Directions {
    pub const COUNT: usize = DIRECTIONS;

    pub fn from_row(row: [f64; Self::COUNT]) -> Self {
        let [m1, m2, i1, i2, hc1, hs1, hc2, hs2, f1, f2, l1, l2, vx1, vx2, vy1, vy2, w1, w2, pc, ps, e] = row;
        Directions {
            m1,
            m2,
            i1,
            i2,
            h1: [hc1, hs1],
            h2: [hc2, hs2],
            c1: [f1, l1],
            c2: [f2, l2],
            v1: [vx1, vy1],
            v2: [vx2, vy2],
            w1,
            w2,
            plane: [pc, ps],
            e,
        }
    }
}

#[derive(Clone, Copy, Default)]
pub struct Outputs {
    pub v1: [f64; 2],
    pub w1: f64,
    pub v2: [f64; 2],
    pub w2: f64,
    pub p: [f64; 2],
    pub mu0: f64,
    pub wn: f64,
    pub wt: f64,
    pub tl: f64,
}

#[inline]
fn out([c, s]: [f64; 2], [a, b]: [f64; 2]) -> [f64; 2] {
    [c * a - s * b, s * a + c * b]
}

#[inline]
fn back([c, s]: [f64; 2], [a, b]: [f64; 2]) -> [f64; 2] {
    [c * a + s * b, c * b - s * a]
}

#[inline]
pub fn solve(d: &Directions) -> Outputs {
    let (a1, j1, a2, j2) = (1.0 / d.m1, 1.0 / d.i1, 1.0 / d.m2, 1.0 / d.i2);
    let r1 = back(d.plane, out(d.h1, d.c1));
    let r2 = back(d.plane, out(d.h2, d.c2));
    let v1 = back(d.plane, d.v1);
    let v2 = back(d.plane, d.v2);
    let un = (v2[0] - r2[1] * d.w2) - (v1[0] - r1[1] * d.w1);
    let ut = (v2[1] + r2[0] * d.w2) - (v1[1] + r1[0] * d.w1);
    let w = a1 + a2;
    let kn = j1 * r1[1] * r1[1] + j2 * r2[1] * r2[1];
    let kt = j1 * r1[0] * r1[0] + j2 * r2[0] * r2[0];
    let knt = -(j1 * r1[0] * r1[1] + j2 * r2[0] * r2[1]);
    let cross = r1[0] * r2[1] - r1[1] * r2[0];
    let scale = 1.0 / (w * (w + kn + kt) + j1 * j2 * cross * cross);
    let (knn, ktt) = (w + kn, w + kt);
    let cn = (1.0 + d.e) * un;
    let pn = (ktt * cn - knt * ut) * scale;
    let pt = (knn * ut - knt * cn) * scale;
    let sn = un - (knn * pn + knt * pt);
    let st = ut - (knt * pn + ktt * pt);
    let wn = -0.5 * pn * (un + sn);
    let wt = -0.5 * pt * (ut + st);
    let dv1 = out(d.plane, [pn * a1, pt * a1]);
    let dv2 = out(d.plane, [-pn * a2, -pt * a2]);
    Outputs {
        v1: [d.v1[0] + dv1[0], d.v1[1] + dv1[1]],
        w1: d.w1 + (r1[0] * pt - r1[1] * pn) * j1,
        v2: [d.v2[0] + dv2[0], d.v2[1] + dv2[1]],
        w2: d.w2 - (r2[0] * pt - r2[1] * pn) * j2,
        p: [pn, pt],
        mu0: pt / pn,
        wn,
        wt,
        tl: -(wn + wt),
    }
}

/// Source of the trigonometric functions.
pub trait Circle {
    fn sin_cos(angle: f64) -> (f64, f64);
    fn atan2(y: f64, x: f64) -> f64;
}

/// The standard library, whose results differ between platforms.
pub struct Std;

/// libm, as in the library: identical bits on every platform.
pub struct Libm;

impl Circle for Std {
    #[inline]
    fn sin_cos(angle: f64) -> (f64, f64) {
        angle.sin_cos()
    }

    #[inline]
    fn atan2(y: f64, x: f64) -> f64 {
        y.atan2(x)
    }
}

impl Circle for Libm {
    #[inline]
    fn sin_cos(angle: f64) -> (f64, f64) {
        libm::sincos(angle)
    }

    #[inline]
    fn atan2(y: f64, x: f64) -> f64 {
        libm::atan2(y, x)
    }
}

/// Computes the magnitude of a velocity change, and the direction the force comes from.
#[inline]
fn delta_v<C: Circle>(heading: [f64; 2], dv: [f64; 2]) -> [f64; 2] {
    let [forward, left] = back(heading, dv);
    // Matches the library on the axes: no negative zero, which would give −π directly from behind.
    let (left, forward) = (left + 0.0, 0.0 - forward);
    [(dv[0] * dv[0] + dv[1] * dv[1]).sqrt(), C::atan2(left, forward)]
}

#[inline]
pub fn solve_from_angles<C: Circle>(a: &Angles<f64>) -> [f64; 16] {
    let direction = |angle: f64| {
        let (sin, cos) = C::sin_cos(angle);
        [cos, sin]
    };
    let d = Directions {
        m1: a.mass[0],
        m2: a.mass[1],
        i1: a.yaw_inertia[0],
        i2: a.yaw_inertia[1],
        h1: direction(a.heading[0]),
        h2: direction(a.heading[1]),
        c1: [a.forward[0], a.left[0]],
        c2: [a.forward[1], a.left[1]],
        v1: [a.vx[0], a.vy[0]],
        v2: [a.vx[1], a.vy[1]],
        w1: a.yaw_rate[0],
        w2: a.yaw_rate[1],
        plane: direction(a.crush_plane),
        e: a.restitution,
    };
    let o = solve(&d);
    let [dv1, pdof1] = delta_v::<C>(d.h1, [o.v1[0] - d.v1[0], o.v1[1] - d.v1[1]]);
    let [dv2, pdof2] = delta_v::<C>(d.h2, [o.v2[0] - d.v2[0], o.v2[1] - d.v2[1]]);
    [o.v1[0], o.v1[1], o.w1, o.v2[0], o.v2[1], o.w2, o.p[0], o.p[1], o.mu0, o.wn, o.wt, o.tl, dv1, pdof1, dv2, pdof2]
}
