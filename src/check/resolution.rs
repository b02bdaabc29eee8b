//! Resolutions of the numbers of a record.

use super::key::Key;
use super::resolution_group::ResolutionGroup;
use alloc::vec::Vec;

/// Largest distance of each number of a record from the quantity it represents: half a unit of its last digit, or its standard uncertainty (see
/// [`Profile::Measured`](super::Profile::Measured)). In the unit of the number.
///
/// ```
/// use planar_impact::Side;
/// use planar_impact::check::{Key, ResolutionGroup, Resolution};
/// let printed = Resolution::default().with(ResolutionGroup::Velocity, 0.05).with_key(Key::DeltaV(Side::One), 0.005);
/// assert_eq!(printed.of(Key::AfterX(Side::Two)), Some(0.05));
/// assert_eq!(printed.of(Key::DeltaV(Side::One)), Some(0.005));
/// assert_eq!(printed.of(Key::Mass(Side::One)), None);
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(from = "Stored", into = "Stored"))]
pub struct Resolution {
    groups: [Option<f64>; ResolutionGroup::COUNT],
    keys: Vec<(Key, f64)>,
}

impl Resolution {
    /// Sets the resolution of all numbers of a group.
    #[must_use]
    pub fn with(mut self, group: ResolutionGroup, resolution: f64) -> Self {
        self.groups[group as usize] = Some(resolution);
        self
    }

    /// Sets the resolution of a single number, which takes precedence over that of its group.
    #[must_use]
    pub fn with_key(mut self, key: Key, resolution: f64) -> Self {
        self.keys.retain(|(known, _)| *known != key);
        self.keys.push((key, resolution));
        self
    }

    /// Returns the resolution of a number, or `None` if it is as precise as the profile says.
    pub fn of(&self, key: Key) -> Option<f64> {
        let own = self.keys.iter().find(|(known, _)| *known == key);
        own.map(|(_, resolution)| *resolution).or(self.groups[key.group() as usize])
    }

    /// Returns `true` if there are no resolutions.
    pub fn is_empty(&self) -> bool {
        self.keys.is_empty() && self.groups.iter().all(Option::is_none)
    }

    /// Returns every resolution with the name of its key or group.
    pub(super) fn entries(&self) -> impl Iterator<Item = (&'static str, f64)> {
        let groups = ResolutionGroup::ALL.into_iter().filter_map(|group| Some((group.name(), self.groups[group as usize]?)));
        groups.chain(self.keys.iter().map(|(key, resolution)| (key.name(), *resolution)))
    }
}

/// Resolutions as stored, by name.
#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
struct Stored {
    groups: Vec<(ResolutionGroup, f64)>,
    keys: Vec<(Key, f64)>,
}

#[cfg(feature = "serde")]
impl From<Resolution> for Stored {
    fn from(resolution: Resolution) -> Self {
        let groups = ResolutionGroup::ALL.into_iter().filter_map(|group| Some((group, resolution.groups[group as usize]?))).collect();
        Stored { groups, keys: resolution.keys }
    }
}

#[cfg(feature = "serde")]
impl From<Stored> for Resolution {
    fn from(stored: Stored) -> Self {
        let of_groups = stored.groups.into_iter().fold(Resolution::default(), |sum, (group, of)| sum.with(group, of));
        stored.keys.into_iter().fold(of_groups, |sum, (key, of)| sum.with_key(key, of))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input::Side;

    #[test]
    fn the_last_one_given_holds() {
        let key = Key::Mass(Side::One);
        let resolution = Resolution::default().with_key(key, 1.0).with(ResolutionGroup::Mass, 3.0).with_key(key, 2.0);
        assert_eq!(resolution.of(key), Some(2.0));
        assert_eq!(resolution.of(Key::Mass(Side::Two)), Some(3.0));
        assert_eq!(resolution.entries().collect::<Vec<_>>(), [("mass", 3.0), ("b1.mass", 2.0)]);
        assert!(!resolution.is_empty() && Resolution::default().is_empty());
    }
}
