//! The benchmarked collisions: distinct side impacts, drawn by a fixed recurrence around one of them.

use num_bigint::BigInt;
use num_rational::BigRational;
use planar_impact::*;

/// Number of values of a collision whose angles are given as cosines and sines.
pub const DIRECTIONS: usize = 21;

/// The eighteen inputs of a collision at the critical ratio, and the one that is not used there.
#[derive(Clone, Debug)]
pub struct Angles<T> {
    pub mass: [T; 2],
    pub yaw_inertia: [T; 2],
    pub heading: [T; 2],
    pub forward: [T; 2],
    pub left: [T; 2],
    pub vx: [T; 2],
    pub vy: [T; 2],
    pub yaw_rate: [T; 2],
    pub crush_plane: T,
    pub restitution: T,
    pub impulse_ratio: T,
}

impl<T: Clone> Angles<T> {
    pub fn row(&self) -> [T; 19] {
        let pairs = [&self.mass, &self.yaw_inertia, &self.heading, &self.forward, &self.left, &self.vx, &self.vy, &self.yaw_rate];
        std::array::from_fn(|i| match i {
            16 => self.crush_plane.clone(),
            17 => self.restitution.clone(),
            18 => self.impulse_ratio.clone(),
            _ => pairs[i / 2][i % 2].clone(),
        })
    }

    pub fn from_row(row: [T; 19]) -> Self {
        let [m1, m2, i1, i2, h1, h2, f1, f2, l1, l2, vx1, vx2, vy1, vy2, w1, w2, crush_plane, restitution, impulse_ratio] = row;
        Angles {
            mass: [m1, m2],
            yaw_inertia: [i1, i2],
            heading: [h1, h2],
            forward: [f1, f2],
            left: [l1, l2],
            vx: [vx1, vx2],
            vy: [vy1, vy2],
            yaw_rate: [w1, w2],
            crush_plane,
            restitution,
            impulse_ratio,
        }
    }

    pub fn map<U: Clone>(&self, f: impl Fn(T) -> U) -> Angles<U> {
        Angles::from_row(self.row().map(f))
    }
}

impl Angles<f64> {
    /// Returns the values with each angle as a cosine and a sine.
    pub fn directions(&self) -> [f64; DIRECTIONS] {
        let [h1, h2, plane] = [self.heading[0], self.heading[1], self.crush_plane].map(|angle| {
            let (sin, cos) = angle.sin_cos();
            [cos, sin]
        });
        [
            self.mass[0],
            self.mass[1],
            self.yaw_inertia[0],
            self.yaw_inertia[1],
            h1[0],
            h1[1],
            h2[0],
            h2[1],
            self.forward[0],
            self.forward[1],
            self.left[0],
            self.left[1],
            self.vx[0],
            self.vx[1],
            self.vy[0],
            self.vy[1],
            self.yaw_rate[0],
            self.yaw_rate[1],
            plane[0],
            plane[1],
            self.restitution,
        ]
    }
}

/// Returns rational values as a person would give them: directions from half-angle tangents with three decimals,
/// everything else with three decimals.
pub fn in_rationals(case: &Angles<f64>) -> [BigRational; DIRECTIONS] {
    let rational = |x: f64| BigRational::new(BigInt::from((x * 1000.0).round() as i64), BigInt::from(1000));
    let mut row = case.directions().map(rational);
    for (at, angle) in [(4, case.heading[0]), (6, case.heading[1]), (18, case.crush_plane)] {
        let direction = Heading::from_half_tangent(rational((angle / 2.0).tan()));
        row[at] = direction.cos;
        row[at + 1] = direction.sin;
    }
    row
}

/// Returns side impacts around that of a sedan into the side of a pickup.
pub fn cases(count: usize) -> Vec<Angles<f64>> {
    let mut state = 0x9e37_79b9_7f4a_7c15_u64;
    let mut about = |center: f64, spread: f64| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        center + spread * ((state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0)
    };
    (0..count)
        .map(|_| Angles {
            mass: [about(1160.0, 100.0), about(2880.0, 200.0)],
            yaw_inertia: [about(1945.0, 200.0), about(7040.0, 500.0)],
            heading: [about(3.1, 0.2), about(1.5, 0.2)],
            forward: [about(1.9, 0.1), about(0.3, 1.5)],
            left: [about(0.0, 0.5), about(1.0, 0.1)],
            vx: [about(-12.0, 2.0), about(0.0, 1.0)],
            vy: [about(0.0, 1.0), about(12.0, 2.0)],
            yaw_rate: [about(0.0, 0.3), about(0.0, 0.3)],
            crush_plane: about(0.0, 0.3),
            restitution: about(0.15, 0.1),
            impulse_ratio: 0.0,
        })
        .collect()
}

#[inline]
fn party<T>(mass: T, yaw_inertia: T, heading: Heading<T>, impact_center: ForwardLeft<T>, velocity: Xy<T>, yaw_rate: T) -> Party<T> {
    Party::Vehicle(Vehicle { mass, yaw_inertia, heading, impact_center, motion: Motion { velocity, yaw_rate } })
}

#[inline]
pub fn collision<T>(row: [T; DIRECTIONS]) -> Collision<T> {
    let [m1, m2, i1, i2, hc1, hs1, hc2, hs2, f1, f2, l1, l2, vx1, vx2, vy1, vy2, w1, w2, pc, ps, restitution] = row;
    let center = |forward, left| ForwardLeft { forward, left };
    Collision {
        one: party(m1, i1, Heading { cos: hc1, sin: hs1 }, center(f1, l1), Xy { x: vx1, y: vy1 }, w1),
        two: party(m2, i2, Heading { cos: hc2, sin: hs2 }, center(f2, l2), Xy { x: vx2, y: vy2 }, w2),
        crush_plane: CrushPlane { cos: pc, sin: ps },
        restitution,
        impulse_ratio: ImpulseRatio::Critical,
        law: Law::Brach,
        moment: Moment::None,
    }
}

#[inline]
pub fn collision_from_angles<T: Real>(case: &Angles<T>) -> Collision<T> {
    let at = |i: usize| {
        party(
            case.mass[i].clone(),
            case.yaw_inertia[i].clone(),
            Heading::from_angle(case.heading[i].clone()),
            ForwardLeft { forward: case.forward[i].clone(), left: case.left[i].clone() },
            Xy { x: case.vx[i].clone(), y: case.vy[i].clone() },
            case.yaw_rate[i].clone(),
        )
    };
    Collision {
        one: at(0),
        two: at(1),
        crush_plane: CrushPlane::from_angle(case.crush_plane.clone()),
        restitution: case.restitution.clone(),
        impulse_ratio: ImpulseRatio::Critical,
        law: Law::Brach,
        moment: Moment::None,
    }
}

/// Returns the outputs of the hand-written kernel from the generic one.
#[inline]
pub fn outputs<T: Field>(impact: &Impact<T>) -> [T; 12] {
    [
        impact.one.after.velocity.x.clone(),
        impact.one.after.velocity.y.clone(),
        impact.one.after.yaw_rate.clone(),
        impact.two.after.velocity.x.clone(),
        impact.two.after.velocity.y.clone(),
        impact.two.after.yaw_rate.clone(),
        impact.impulse.n.clone(),
        impact.impulse.t.clone(),
        impact.critical_impulse_ratio(),
        impact.work.n.clone(),
        impact.work.t.clone(),
        impact.loss(),
    ]
}

/// Returns these outputs with magnitude and direction of both ΔV.
#[inline]
pub fn outputs_with_directions<T: Real>(impact: &Impact<T>) -> [T; 16] {
    let [a, b, c, d, e, f, g, h, i, j, k, l] = outputs(impact);
    [
        a,
        b,
        c,
        d,
        e,
        f,
        g,
        h,
        i,
        j,
        k,
        l,
        impact.one.delta_v_magnitude(),
        impact.one.principal_direction_of_force(),
        impact.two.delta_v_magnitude(),
        impact.two.principal_direction_of_force(),
    ]
}
