//! Braking over a distance: speeds and times of a vehicle that skids in a straight line, before an impact or after it.
//!
//! On a surface with friction μ and grade G, a vehicle whose wheels have a share b of the friction that locked ones would have loses
//!
//! ```text
//! ½ v₁² − ½ v₂² = g (μ b + G) L
//! ```
//!
//! per mass over a distance L as on a plan, that is horizontally: μ b + G is the drag factor of the field (Fricke 2010), and with horizontal distances it is
//! exact. Skids over several surfaces add up.
//!
//! | property | test in `proptests/skid.rs` |
//! |---|---|
//! | the speeds of the parts end in the last speed, and are those of the motion integrated in small steps | `parts_are_the_motion_in_small_steps` |
//! | a skid divided in two is the same skid | `a_divided_skid_is_the_same` |

use alloc::vec::Vec;

use crate::frame::Xy;
use crate::scalar::Real;

/// A distance over which a vehicle brakes.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Skid<T = f64> {
    /// Its length as on a plan, in m.
    pub length: T,
    /// The coefficient of friction of locked wheels on this surface when level.
    pub friction: T,
    /// The grade: height over horizontal distance, positive uphill in the direction of travel.
    pub grade: T,
    /// The share of that friction that the wheels have, from 0 to 1: the sum over braked wheels of their shares of the weight.
    pub braking: T,
}

/// The motion over a skid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Braking<T = f64> {
    /// Speed at its start, in m/s.
    pub start: T,
    /// Speed at its end, in m/s.
    pub end: T,
    /// Deceleration along the road, in m/s².
    pub deceleration: T,
    /// Its duration, in s.
    pub time: T,
}

impl<T: Real> Skid<T> {
    /// Returns the drag factor μ b + G. Without one above zero the vehicle does not slow down.
    pub fn drag_factor(&self) -> T {
        self.friction.clone() * self.braking.clone() + self.grade.clone()
    }

    /// Returns the square of the speed from which this skid brings a vehicle to rest, in m²/s².
    pub fn speed_squared(&self, gravity: T) -> T {
        T::int(2) * gravity * self.drag_factor() * self.length.clone()
    }

    /// Returns the motion over this skid that ends in a speed.
    pub fn before(&self, end: T, gravity: T) -> Braking<T> {
        let along = (T::int(1) + self.grade.clone().squared()).square_root();
        let start = (end.clone().squared() + self.speed_squared(gravity.clone())).square_root();
        let time = T::int(2) * self.length.clone() * along.clone() / (start.clone() + end.clone());
        Braking { start, end, deceleration: gravity * self.drag_factor() / along, time }
    }
}

/// Returns the speed from which skids bring a vehicle to rest, in m/s: √(2 g Σ (μ b + G) L). Zero without skids.
///
/// ```
/// use planar_impact::STANDARD_GRAVITY;
/// use planar_impact::skid::{Skid, skid_speed};
/// // 22 m on asphalt, then 8 m on grass.
/// let skids = [(22.0, 0.7), (8.0, 0.45)].map(|(length, friction)| Skid { length, friction, grade: 0.0, braking: 1.0 });
/// assert!((skid_speed(&skids, STANDARD_GRAVITY) - 19.304).abs() < 1e-3);
/// ```
pub fn skid_speed<T: Real>(skids: &[Skid<T>], gravity: T) -> T {
    let squares = skids.iter().map(|skid| skid.speed_squared(gravity.clone()));
    squares.fold(T::int(0), |sum, square| sum + square).square_root()
}

/// Returns the speed of a vehicle when it began to brake, in m/s: √(v² + s²) of its velocity v at the impact and its skid speed s.
///
/// ```
/// use planar_impact::{Xy, skid::braking_speed};
/// assert_eq!(braking_speed(Xy { x: 2.0, y: -6.0 }, 9.0), 11.0);
/// ```
pub fn braking_speed<T: Real>(at_impact: Xy<T>, skid_speed: T) -> T {
    (at_impact.length_squared() + skid_speed.squared()).square_root()
}

/// Returns the motion over skids, in their order along the road, that ends in a speed, in m/s.
pub fn braking<T: Real>(skids: &[Skid<T>], end: T, gravity: T) -> Vec<Braking<T>> {
    let mut parts = Vec::with_capacity(skids.len());
    let mut speed = end;
    for skid in skids.iter().rev() {
        let part = skid.before(speed, gravity.clone());
        speed = part.start.clone();
        parts.push(part);
    }
    parts.reverse();
    parts
}
