//! How exact the numbers of a record are.

use super::key::Key;
use super::measure::Measure;
use alloc::vec::Vec;

/// How far each number of a record may be from what it stands for: half a unit of its last digit, or its standard uncertainty (see
/// [`Profile::Measured`](super::Profile::Measured)). In the unit of the number.
///
/// ```
/// use planar_impact::Side;
/// use planar_impact::check::{Key, Measure, Resolution};
/// let printed = Resolution::default().with(Measure::Velocity, 0.05).with_key(Key::DeltaV(Side::One), 0.005);
/// assert_eq!(printed.of(Key::AfterX(Side::Two)), Some(0.05));
/// assert_eq!(printed.of(Key::DeltaV(Side::One)), Some(0.005));
/// assert_eq!(printed.of(Key::Mass(Side::One)), None);
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Resolution {
    measures: [Option<f64>; Measure::COUNT],
    keys: Vec<(Key, f64)>,
}

impl Resolution {
    /// This, with one for all numbers of a kind.
    #[must_use]
    pub fn with(mut self, measure: Measure, resolution: f64) -> Self {
        self.measures[measure as usize] = Some(resolution);
        self
    }

    /// This, with one for a single number, which goes before that for its kind.
    #[must_use]
    pub fn with_key(mut self, key: Key, resolution: f64) -> Self {
        self.keys.retain(|(known, _)| *known != key);
        self.keys.push((key, resolution));
        self
    }

    /// That of a number. None: it is as exact as the profile says.
    pub fn of(&self, key: Key) -> Option<f64> {
        let own = self.keys.iter().find(|(known, _)| *known == key);
        own.map(|(_, resolution)| *resolution).or(self.measures[key.measure() as usize])
    }

    /// Whether there is none at all.
    pub fn is_empty(&self) -> bool {
        self.keys.is_empty() && self.measures.iter().all(Option::is_none)
    }

    /// Every resolution with the name it is given under.
    pub(super) fn entries(&self) -> impl Iterator<Item = (&'static str, f64)> {
        let measures = Measure::ALL.into_iter().filter_map(|measure| Some((measure.name(), self.measures[measure as usize]?)));
        measures.chain(self.keys.iter().map(|(key, resolution)| (key.name(), *resolution)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input::Side;

    #[test]
    fn the_last_one_given_holds() {
        let key = Key::Mass(Side::One);
        let resolution = Resolution::default().with_key(key, 1.0).with(Measure::Mass, 3.0).with_key(key, 2.0);
        assert_eq!(resolution.of(key), Some(2.0));
        assert_eq!(resolution.of(Key::Mass(Side::Two)), Some(3.0));
        assert_eq!(resolution.entries().collect::<Vec<_>>(), [("mass", 3.0), ("b1.mass", 2.0)]);
        assert!(!resolution.is_empty() && Resolution::default().is_empty());
    }
}
