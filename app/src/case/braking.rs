//! The braking of a vehicle before the impact: skids and reaction time.

use std::fmt;

use planar_impact::Real;
use planar_impact::skid::{Skid, skid_speed};

use super::domain::Domain;
use crate::units::Measure;

/// Braking before the impact.
#[derive(Clone, Debug, PartialEq)]
pub struct BrakingInputs {
    /// The skids, in their order along the road; at least one.
    pub skids: Vec<Skid>,
    /// The time from perception to the first skid, in s.
    pub reaction_time: Option<f64>,
    /// The acceleration of gravity, in m/s².
    pub gravity: f64,
}

/// A number of a skid; skids are counted from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct SkidKey {
    /// The skid.
    pub skid: usize,
    /// The number.
    pub of: SkidNumber,
}

/// A number of a skid.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SkidNumber {
    /// The length on a plan.
    Length,
    /// The coefficient of friction.
    Friction,
    /// The grade, positive uphill.
    Grade,
    /// The share of the friction that the wheels have.
    Braking,
}

impl SkidNumber {
    /// Every number.
    pub const ALL: [SkidNumber; 4] = [SkidNumber::Length, SkidNumber::Friction, SkidNumber::Grade, SkidNumber::Braking];

    /// Returns its name in a case file.
    pub fn name(self) -> &'static str {
        match self {
            SkidNumber::Length => "length",
            SkidNumber::Friction => "friction",
            SkidNumber::Grade => "grade",
            SkidNumber::Braking => "braking",
        }
    }

    fn of<T>(self, skid: &mut Skid<T>) -> &mut T {
        match self {
            SkidNumber::Length => &mut skid.length,
            SkidNumber::Friction => &mut skid.friction,
            SkidNumber::Grade => &mut skid.grade,
            SkidNumber::Braking => &mut skid.braking,
        }
    }
}

impl SkidKey {
    /// Returns the key with a name such as `1.friction`.
    pub fn named(name: &str) -> Option<SkidKey> {
        let (number, key) = name.split_once('.')?;
        let skid = number.parse().ok().filter(|skid: &usize| *skid > 0 && skid.to_string() == number)?;
        let of = SkidNumber::ALL.into_iter().find(|known| known.name() == key)?;
        Some(SkidKey { skid, of })
    }

    /// Returns its measure.
    pub fn measure(self) -> Measure {
        if self.of == SkidNumber::Length { Measure::Length } else { Measure::Ratio }
    }

    /// Returns its accepted values.
    pub fn domain(self) -> Domain {
        match self.of {
            SkidNumber::Length => Domain::Positive,
            SkidNumber::Friction => Domain::NotNegative,
            SkidNumber::Grade => Domain::Any,
            SkidNumber::Braking => Domain::Fraction,
        }
    }
}

impl fmt::Display for SkidKey {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}.{}", self.skid, self.of.name())
    }
}

impl BrakingInputs {
    /// Returns every number of the skids.
    pub fn keys(&self) -> impl Iterator<Item = SkidKey> {
        (1..=self.skids.len()).flat_map(|skid| SkidNumber::ALL.map(|of| SkidKey { skid, of }))
    }

    /// Returns a number.
    ///
    /// # Errors
    ///
    /// Returns a message if there is no such skid.
    pub fn value(&self, key: SkidKey) -> Result<f64, String> {
        let skid = self.skids.get(key.skid - 1).ok_or_else(|| format!("the vehicle has {} skids", self.skids.len()))?;
        Ok(*key.of.of(&mut skid.clone()))
    }

    /// Sets a number of a skid that is there.
    pub fn set(&mut self, key: SkidKey, value: f64) {
        *key.of.of(&mut self.skids[key.skid - 1]) = value;
    }

    /// Returns the speed from which the skids bring the vehicle to rest, adding `by` of its key to each number.
    pub fn skid_speed<T: Real + From<f64>>(&self, mut by: impl FnMut(SkidKey) -> T) -> T {
        let skids: Vec<Skid<T>> = self
            .skids
            .iter()
            .zip(1..)
            .map(|(skid, number)| {
                let mut plus = |value: f64, of| T::from(value) + by(SkidKey { skid: number, of });
                Skid {
                    length: plus(skid.length, SkidNumber::Length),
                    friction: plus(skid.friction, SkidNumber::Friction),
                    grade: plus(skid.grade, SkidNumber::Grade),
                    braking: plus(skid.braking, SkidNumber::Braking),
                }
            })
            .collect();
        skid_speed(&skids, T::from(self.gravity))
    }
}
