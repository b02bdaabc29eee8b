//! Separation speed and yaw rate in closed form from distance, rotation and drag: the work of the tires along a straight path.
//!
//! CRASH starts from relations between the distance and rotation to rest and the velocity and yaw rate at separation, for wheels that all roll or are all
//! locked. CRASH's relations have empirical coefficients after Marquard (ATZ 68, 1966). The form here has none and is not Marquard's: it integrates the work
//! of the tires along the path.
//!
//! 1. The center of mass moves in a straight line from separation to rest, and the heading changes in proportion: at the share s of the path it is at
//!    r₀ + s Δr, θ₀ + s Δθ.
//! 2. There every contact moves along Δr + Δθ × arm, which is the direction of its slip; the tire law of [`Tires::force`](super::Tires::force) and the
//!    friction under the wheel give force F and moment M.
//! 3. The force absorbs the energy of the translation, the moment that of the rotation:
//!
//! ```text
//! ½ m V² = −∫ F · Δr ds        ½ I Ω² = −∫ M Δθ ds
//! ```
//!
//! Exact for locked wheels without rotation, V² = 2 μ g |Δr|, and for rotation in place. Otherwise the path is curved, and the share of the rotation that
//! happens early is unknown. That error is not included in the standard deviations, which are those of the input alone. The direction of V is that to the
//! rest position; a rotating vehicle first deviates from it to one side.

use super::evidence::{MotionCovariance, NoSeparation, RestEvidence, Separation};
use super::slide::Slide;
use super::vehicle::Pose;
use crate::frame::Xy;
use crate::scalar::Real;
use crate::vehicle::Motion;
use num_dual::Dual64;

/// Number of parts of the path.
const PARTS: i32 = 200;
/// Range of the heading that is examined, in deviations.
const DEVIATIONS: f64 = 3.0;

impl<T: Real<Mask = bool>> Slide<T> {
    /// Returns the motion at separation from the work of the tires along a straight path to rest; NaN if they would drive the vehicle.
    ///
    /// The regularization is negligibly small. If the vehicle does not rotate, derivatives are correct if the drag has no moment without rotation, as for
    /// equal wheels on both sides on one friction. If it has one, the yaw rate is NaN there: to one side the tires would drive the vehicle, and to the other
    /// the yaw rate grows as the square root of the rotation.
    pub fn closed_form(&self, separation: &Pose<T>, rest: &Pose<T>) -> Motion<T> {
        let (zero, one) = (T::int(0), T::int(1));
        let millionth = one.clone() / T::int(1_000_000);
        let travel = rest.position.clone() - separation.position.clone();
        let turn = rest.heading.clone() - separation.heading.clone();
        let distance = travel.clone().length();
        // Ω is proportional to a small Δθ. The root of zero would hide that from derivatives, so a rotation below a millionth is replaced by a millionth.
        let is_little = turn.clone().magnitude().less(&millionth);
        let counted = if is_little { millionth.clone() } else { turn.clone() };
        let mut slide = self.clone();
        let arm = slide.vehicle.front_axle.clone() + slide.vehicle.rear_axle.clone();
        slide.vehicle.tires.regularization = (distance.clone() + arm * counted.clone().magnitude()) * millionth;
        // The whole path in a second: only the direction of the slip matters.
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
        let speed = (T::int(2) * of_travel / self.vehicle.mass.clone()).square_root();
        let rate = |work: T| (T::int(2) * work / self.vehicle.yaw_inertia.clone()).square_root() / counted.clone().magnitude();
        // Neither direction of rotation takes precedence.
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
        // The friction comes last.
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

    /// Returns `true` if the yaw rate is finite within a few deviations of the heading. It varies as a square root near the values where it is not, so a
    /// deviation has no meaning there.
    fn turn_is_smooth(&self, evidence: &RestEvidence) -> bool {
        let (turn, reach) = (evidence.rest.heading - evidence.separation.heading, DEVIATIONS * evidence.heading_deviation);
        let none = if turn.abs() <= reach { 0.0 } else { turn };
        [none, turn - reach, turn + reach].into_iter().all(|turn| {
            let rest = Pose { heading: evidence.separation.heading + turn, ..evidence.rest };
            self.closed_form(&evidence.separation, &rest).yaw_rate.is_finite()
        })
    }

    /// Returns the derivatives of V_x, V_y and Ω by x, y or heading at rest, or by the common factor of the frictions.
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
    use crate::post_impact::{Ground, SlidingVehicle, Tires, Wheel, Wheels};
    use alloc::vec::Vec;

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

    /// All four contacts move on circles about a distant point: the friction on them acts along the path, and has almost no moment.
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

    fn evidence(rest: Pose, position_deviation: Xy, heading_deviation: f64) -> RestEvidence {
        RestEvidence {
            separation: Pose::default(),
            rest,
            position_deviation,
            heading_deviation,
            friction_deviation: 0.07,
            points: Vec::new(),
        }
    }

    #[test]
    fn a_distance_within_the_larger_deviation_is_too_short() {
        for deviations in [Xy { x: 0.3, y: 0.2 }, Xy { x: 0.2, y: 0.3 }] {
            let moved = |x| {
                let rest = Pose { position: Xy { x, y: 0.0 }, heading: 0.0 };
                locked().separation_in_closed_form(&evidence(rest, deviations, 0.09))
            };
            for distance in [0.25, 0.3] {
                assert_eq!(moved(distance), Err(NoSeparation::TooShort { distance, deviation: 0.3 }));
            }
            assert!(moved(0.301).is_ok());
        }
    }

    /// The left wheels are locked and turn the vehicle left, until it slides sideways.
    #[test]
    fn a_turn_is_refused_if_a_few_deviations_reach_one_that_the_tires_drive() {
        let mut slide = locked();
        let rolling = Wheel::ROLLING;
        slide.vehicle.wheels = Wheels { front_left: Wheel::LOCKED, front_right: rolling, rear_left: Wheel::LOCKED, rear_right: rolling };
        let rest = |heading| Pose { position: Xy { x: 8.0, y: 0.0 }, heading };
        let is_driven = |turn: &f64| slide.closed_form(&Pose::default(), &rest(*turn)).yaw_rate.is_nan();
        let edge = (1..400).map(|i| f64::from(i) / 100.0).find(|turn| !is_driven(turn)).expect("beyond it, sliding sideways resists");
        assert!(edge > 0.1 && is_driven(&(edge / 2.0)) && !is_driven(&-0.5), "{edge}");
        let separation = |turn, deviation| slide.separation_in_closed_form(&evidence(rest(turn), Xy { x: 0.3, y: 0.3 }, deviation));
        let refused = |turn, deviation| Err(NoSeparation::Turned { turn, deviation });
        // Three deviations below and above the turn.
        let beyond = edge + 0.05;
        assert_eq!(separation(beyond, 0.02), refused(beyond, 0.02));
        assert_eq!(separation(-0.5, 0.18), refused(-0.5, 0.18));
        // The turn and both of these have a yaw rate, but no turn at all has none.
        let wide = (edge + 0.25) / 3.0;
        assert_eq!(separation(-0.2, wide), refused(-0.2, wide));
        assert_eq!(separation(edge / 2.0, edge / 12.0), Err(NoSeparation::Driven));
        assert!(separation(beyond, 0.01).is_ok() && separation(-0.5, 0.1).is_ok());
    }
}
