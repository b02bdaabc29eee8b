//! Separation speed and yaw rate from distance, rotation and drag alone: the work of the tires along a straight way.
//!
//! CRASH begins with relations between the distance and the rotation to rest and the velocity and yaw rate at separation, of wheels that all roll or are all
//! locked. CRASH's step has empirical coefficients after Marquard (ATZ 68, 1966); this form has none and is not his: what the tires take, integrated over the way.
//!
//! 1. The center of mass goes straight from separation to rest, and the heading turns in proportion: at the share s of the way it is at r₀ + s Δr, θ₀ + s Δθ.
//! 2. There every contact moves along Δr + Δθ × arm, which is the direction of its slip; the tire law of [`Tires::force`](super::Tires::force) and the friction
//!    under the wheel give force F and moment M.
//! 3. The force takes the energy of the translation, the moment that of the rotation:
//!
//! ```text
//! ½ m V² = −∫ F · Δr ds        ½ I Ω² = −∫ M Δθ ds
//! ```
//!
//! Exact for locked wheels without rotation, V² = 2 μ g |Δr|, and for rotation on the spot. Else the way bends, and how much of the rotation happens early is
//! not known: that error is not in the standard deviations, which are those of the input alone. The direction of V is that to the rest; a vehicle that turns
//! leaves it first to the one side.

use super::evidence::{MotionCovariance, NoSeparation, RestEvidence, Separation};
use super::slide::Slide;
use super::vehicle::Pose;
use crate::frame::Xy;
use crate::scalar::Real;
use crate::vehicle::Motion;
use num_dual::Dual64;

/// The parts of the way.
const PARTS: i32 = 200;
/// So many deviations of the heading are looked at.
const DEVIATIONS: f64 = 3.0;

impl<T: Real<Mask = bool>> Slide<T> {
    /// The motion at separation by the work of the tires along a straight way from there to the rest; not a number where they would drive the vehicle.
    ///
    /// The regularization is taken to be nothing. Where the vehicle does not turn, derivatives are right if the drag has no moment without rotation, as of wheels
    /// alike on both sides on one friction. Where it has one, the yaw rate there is not a number: to the one side the tires would drive the vehicle, and to the
    /// other the yaw rate grows as a root of the rotation.
    pub fn closed_form(&self, separation: &Pose<T>, rest: &Pose<T>) -> Motion<T> {
        let (zero, one) = (T::int(0), T::int(1));
        let millionth = one.clone() / T::int(1_000_000);
        let travel = rest.position.clone() - separation.position.clone();
        let turn = rest.heading.clone() - separation.heading.clone();
        let distance = travel.clone().length();
        // Ω is in proportion to a small Δθ. A root of nothing would hide that from derivatives, so less than a millionth is taken for a millionth.
        let is_little = turn.clone().magnitude().less(&millionth);
        let counted = if is_little { millionth.clone() } else { turn.clone() };
        let mut slide = self.clone();
        let arm = slide.vehicle.front_axle.clone() + slide.vehicle.rear_axle.clone();
        slide.vehicle.tires.regularization = (distance.clone() + arm * counted.clone().magnitude()) * millionth;
        // Moved over the whole way in a second: only the direction of the slip counts.
        let direction = Motion { velocity: travel.clone(), yaw_rate: counted.clone() };
        let back = Motion { velocity: travel.clone(), yaw_rate: -counted.clone() };
        let (mut of_travel, mut of_turn, mut of_turn_back) = (zero.clone(), zero.clone(), zero.clone());
        for part in 0..PARTS {
            let share = T::int(2 * part + 1) / T::int(2 * PARTS);
            let pose = Pose {
                position: separation.position.clone() + travel.clone() * share.clone(),
                heading: separation.heading.clone() + turn.clone() * share,
            };
            let drag = slide.drag(&pose, &direction);
            of_travel = of_travel - drag.force.dot(travel.clone()) / T::int(PARTS);
            of_turn = of_turn - drag.moment * counted.clone() / T::int(PARTS);
            if is_little {
                of_turn_back = of_turn_back + slide.drag(&pose, &back).moment * counted.clone() / T::int(PARTS);
            }
        }
        let speed = (T::int(2) * of_travel / self.vehicle.mass.clone()).sqrt();
        let rate = |work: T| (T::int(2) * work / self.vehicle.yaw_inertia.clone()).sqrt() / counted.clone().magnitude();
        // Neither way is before the other.
        let rate = if is_little { (rate(of_turn) + rate(of_turn_back)).half() } else { rate(of_turn) };
        let along = if zero.less(&distance) { travel * (speed / distance) } else { Xy::zero() };
        Motion { velocity: along, yaw_rate: turn * rate }
    }
}

impl Slide {
    pub(super) fn separation_in_closed_form(&self, evidence: &RestEvidence) -> Result<Separation, NoSeparation> {
        let motion = self.closed_form(&evidence.separation, &evidence.rest);
        let (turn, turn_deviation) = (evidence.rest.heading - evidence.separation.heading, evidence.heading_deviation);
        let turned = turn.abs() > DEVIATIONS * turn_deviation;
        if !motion.velocity.x.is_finite() || !motion.velocity.y.is_finite() || (turned && !motion.yaw_rate.is_finite()) {
            return Err(NoSeparation::Driven);
        }
        if !self.turn_is_smooth(evidence) {
            return Err(NoSeparation::Turned { turn, deviation: turn_deviation });
        }
        let distance = (evidence.rest.position - evidence.separation.position).length();
        let deviation = evidence.position_deviation.x.max(evidence.position_deviation.y);
        if distance <= deviation {
            return Err(NoSeparation::TooShort { distance, deviation });
        }
        let deviations =
            [evidence.position_deviation.x, evidence.position_deviation.y, evidence.heading_deviation, evidence.friction_deviation];
        let mut covariance = [[0.0; 3]; 3];
        // The friction is the last.
        let mut by = [0.0; 3];
        for (input, deviation) in deviations.into_iter().enumerate() {
            by = self.closed_form_by(evidence, input).map(|slope| slope * deviation);
            for i in 0..3 {
                for k in 0..3 {
                    covariance[i][k] += by[i] * by[k];
                }
            }
        }
        let [x, y, yaw_rate] = by;
        let by_friction = Motion { velocity: Xy { x, y }, yaw_rate };
        Ok(Separation { motion, covariance: MotionCovariance(covariance), by_friction, fit: None })
    }

    /// Whether the yaw rate has values within a few deviations of the heading: it goes as a root where it has none, and a deviation says nothing there.
    fn turn_is_smooth(&self, evidence: &RestEvidence) -> bool {
        let (turn, reach) = (evidence.rest.heading - evidence.separation.heading, DEVIATIONS * evidence.heading_deviation);
        let none = if turn.abs() <= reach { 0.0 } else { turn };
        [none, turn - reach, turn + reach].into_iter().all(|turn| {
            let rest = Pose { heading: evidence.separation.heading + turn, ..evidence.rest };
            self.closed_form(&evidence.separation, &rest).yaw_rate.is_finite()
        })
    }

    /// The derivatives of V_x, V_y and Ω by x, y or heading at rest, or by the common factor of the frictions.
    fn closed_form_by(&self, evidence: &RestEvidence, input: usize) -> [f64; 3] {
        let seed = |value: f64, number: usize| Dual64::new(value, if number == input { 1.0 } else { 0.0 });
        let mut slide = self.clone().map(Dual64::from);
        slide.ground = slide.ground.times(seed(1.0, 3));
        let rest = evidence.rest;
        let rest = Pose { position: Xy { x: seed(rest.position.x, 0), y: seed(rest.position.y, 1) }, heading: seed(rest.heading, 2) };
        let motion = slide.closed_form(&evidence.separation.map(Dual64::from), &rest);
        [motion.velocity.x.eps, motion.velocity.y.eps, motion.yaw_rate.eps]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rest::{Ground, SlidingVehicle, Tires, Wheel, Wheels};

    fn locked() -> Slide {
        let vehicle = SlidingVehicle {
            mass: 1500.0,
            yaw_inertia: 2400.0,
            front_axle: 1.2,
            rear_axle: 1.6,
            track: 1.8,
            wheels: Wheels::all(Wheel::LOCKED),
            tires: Tires::ORDINARY,
        };
        Slide { vehicle, ground: Ground { gravity: 10.0, ..Ground::uniform(0.5) } }
    }

    #[test]
    fn rotation_on_the_spot_is_exact() {
        // By hand: the front wheels are 1.5 m from the center of mass and carry 4/7 of 15 kN, the rear ones √3.37 m and 3/7.
        let moment = 0.5 * 15e3 * (4.0 / 7.0 * 1.5 + 3.0 / 7.0 * 3.37_f64.sqrt());
        let turn = -2.0;
        let found = locked().closed_form(&Pose::default(), &Pose { heading: turn, ..Pose::default() });
        let exact = -(2.0 * moment * 2.0 / 2400.0_f64).sqrt();
        assert!((found.yaw_rate - exact).abs() < 1e-9 && found.velocity == Xy::zero(), "{found:?} {exact}");
    }

    /// All four contacts move on circles about a point far away: the friction on them is along the way, and hardly has a moment.
    #[test]
    fn it_is_near_the_slide_that_turns_a_little() {
        let slide = locked();
        let motion = Motion { velocity: Xy { x: 9.0, y: 4.0 }, yaw_rate: 1.0 };
        let rest = slide.to_rest(&Pose::default(), &motion).expect("it comes to rest").pose;
        let found = slide.closed_form(&Pose::default(), &rest);
        assert!((found.velocity - motion.velocity).length() < 0.1 && (found.yaw_rate - motion.yaw_rate).abs() < 0.03, "{found:?}");
    }

    #[test]
    fn the_yaw_rate_has_a_slope_where_there_is_no_rotation() {
        let slide = locked();
        let rest = |heading| Pose { position: Xy { x: 8.0, y: 1.0 }, heading };
        let turned = Pose { heading: Dual64::new(0.0, 1.0), ..rest(0.0).map(Dual64::from) };
        let here: Pose = Pose::default();
        let slope = slide.clone().map(Dual64::from).closed_form(&here.map(Dual64::from), &turned).yaw_rate.eps;
        let quotient = slide.closed_form(&Pose::default(), &rest(1e-3)).yaw_rate / 1e-3;
        assert!((slope / quotient - 1.0).abs() < 1e-3 && slope > 0.1, "{slope} {quotient}");
    }
}
