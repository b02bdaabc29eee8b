//! The impact in matrix form, by hand: K P = v − V, with K from inverse masses and inertias and the arms to the impact center.

use serde_json::Value;

use super::number;

/// The compliance at the impact center and the approach velocity, along n and t.
pub struct Contact {
    pub nn: f64,
    pub nt: f64,
    pub tt: f64,
    pub v: [f64; 2],
}

impl Contact {
    /// Computes them from the values of all inputs by name, as `gradient` has them under `wrt`; a barrier has none.
    pub fn of(inputs: &Value) -> Contact {
        let plane = number(&inputs["contact.crush_plane"]);
        let mut contact = Contact { nn: 0.0, nt: 0.0, tt: 0.0, v: [0.0; 2] };
        for (vehicle, sign) in [("vehicle.1", -1.0), ("vehicle.2", 1.0)] {
            let of = |name: &str| inputs[format!("{vehicle}.{name}")].as_f64();
            let Some(mass) = of("mass") else { continue };
            let [inertia, heading, forward, left] =
                ["yaw_inertia", "heading", "impact_center.forward", "impact_center.left"].map(|name| of(name).expect("a value"));
            let [x, y, rate] = ["velocity.x", "velocity.y", "yaw_rate"].map(|name| of(name).expect("a value"));
            // The arm from the center of mass to the impact center along n and t.
            let (sin, cos) = (heading - plane).sin_cos();
            let (n, t) = (forward * cos - left * sin, forward * sin + left * cos);
            contact.nn += 1.0 / mass + t * t / inertia;
            contact.nt -= n * t / inertia;
            contact.tt += 1.0 / mass + n * n / inertia;
            let (sin, cos) = plane.sin_cos();
            contact.v[0] += sign * (x * cos + y * sin - rate * t);
            contact.v[1] += sign * (y * cos - x * sin + rate * n);
        }
        contact
    }

    /// Returns the loss T_L of an impulse: P·v − ½ P·K P.
    fn loss(&self, [n, t]: [f64; 2]) -> f64 {
        n * self.v[0] + t * self.v[1] - 0.5 * (self.nn * n * n + 2.0 * self.nt * n * t + self.tt * t * t)
    }

    /// Returns the loss for a restitution and an impulse ratio: P_n = (1 + e) v_n/(K_nn + μ K_nt).
    pub fn loss_at_ratio(&self, restitution: f64, ratio: f64) -> f64 {
        let normal = (1.0 + restitution) * self.v[0] / (self.nn + ratio * self.nt);
        self.loss([normal, ratio * normal])
    }

    /// Returns the loss if sliding ends: K P = ((1 + e) v_n, v_t).
    pub fn critical_loss(&self, restitution: f64) -> f64 {
        let (a, b) = ((1.0 + restitution) * self.v[0], self.v[1]);
        let determinant = self.nn * self.tt - self.nt * self.nt;
        self.loss([(self.tt * a - self.nt * b) / determinant, (self.nn * b - self.nt * a) / determinant])
    }

    /// Returns the highest restitution at which no approach velocity gains energy if sliding ends: e² ≤ 1 − K_nt²/(K_nn K_tt).
    pub fn restitution_for_any_approach(&self) -> f64 {
        (1.0 - self.nt * self.nt / (self.nn * self.tt)).sqrt()
    }
}
