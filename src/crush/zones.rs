//! A stiffness that changes along the width: a stiff corner, an engine block, an overlap with the frame.

use alloc::vec::Vec;
use core::fmt;

use super::{CrushStiffness, Profile, ProfileMoments};
use crate::issue::Issue;
use crate::message::Message;
use crate::scalar::{Field, Ordered};

/// Zones of stiffness side by side along the surface, each with its own line E* = d₀ + d₁ C.
///
/// ```
/// use planar_impact::crush::{CrushStiffness, Profile, StiffnessZones};
/// let soft = CrushStiffness { onset: 3.0, slope: 4.0 };
/// let stiff = CrushStiffness { onset: 3.0, slope: 8.0 };
/// let profile = Profile::equally_spaced(2.0, vec![0.5, 0.5])?;
/// // A stiff corner over the last quarter of the width.
/// let energy = StiffnessZones::new(vec![soft, stiff], vec![1.5])?.crush_energy(&profile);
/// assert_eq!(energy, 1.5 * 0.5 * 5.0 * 5.0 + 0.5 * 0.5 * 7.0 * 7.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedZones<T>"))]
pub struct StiffnessZones<T = f64> {
    zones: Vec<CrushStiffness<T>>,
    borders: Vec<T>,
}

/// Zones as stored, whose borders may not match.
#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
struct UncheckedZones<T> {
    zones: Vec<CrushStiffness<T>>,
    borders: Vec<T>,
}

#[cfg(feature = "serde")]
impl<T> TryFrom<UncheckedZones<T>> for StiffnessZones<T> {
    type Error = ZoneError;

    fn try_from(stored: UncheckedZones<T>) -> Result<Self, ZoneError> {
        StiffnessZones::new(stored.zones, stored.borders)
    }
}

/// The number of borders does not match the number of zones: n zones have n − 1 borders between them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct ZoneError {
    /// The number of zones.
    pub zones: usize,
    /// The number of borders.
    pub borders: usize,
}

impl Issue for ZoneError {
    type Number = f64;

    fn code(&self) -> &'static str {
        "zone-count"
    }

    fn message(&self) -> Message {
        Message::new().text(alloc::format!(
            "{} zones of stiffness with {} borders: there is one border between two zones",
            self.zones,
            self.borders
        ))
    }
}

impl fmt::Display for ZoneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.message().fmt(f)
    }
}

impl core::error::Error for ZoneError {}

impl<T> StiffnessZones<T> {
    /// Creates zones in the order of their stations, with the station of each border between two of them, in m, increasing. The first and the last zone
    /// extend to the ends of the crush. A border that does not lie beyond the one before leaves no width between them.
    ///
    /// # Errors
    ///
    /// [`ZoneError`] unless there is at least one zone and n zones have n − 1 borders.
    pub fn new(zones: Vec<CrushStiffness<T>>, borders: Vec<T>) -> Result<Self, ZoneError> {
        if zones.len() != borders.len() + 1 {
            return Err(ZoneError { zones: zones.len(), borders: borders.len() });
        }
        Ok(StiffnessZones { zones, borders })
    }

    /// Returns the zones.
    pub fn zones(&self) -> &[CrushStiffness<T>] {
        &self.zones
    }

    /// Returns the borders between them.
    pub fn borders(&self) -> &[T] {
        &self.borders
    }
}

impl<T: Field> From<CrushStiffness<T>> for StiffnessZones<T> {
    fn from(stiffness: CrushStiffness<T>) -> Self {
        StiffnessZones { zones: [stiffness].into(), borders: Vec::new() }
    }
}

impl<T: Ordered> StiffnessZones<T> {
    /// Returns the crush energy of a profile, each part of it with the stiffness of its zone, in J   (Eq 4 in each zone).
    pub fn crush_energy(&self, profile: &Profile<T>) -> T {
        if let [stiffness] = self.zones.as_slice() {
            return stiffness.crush_energy(profile.moments());
        }
        self.moments(profile).zip(&self.zones).fold(T::int(0), |sum, (moments, zone)| sum + zone.crush_energy(moments))
    }

    /// Returns K₁, K₂, K₃ of the part of the profile in each zone.
    pub fn moments<'a>(&'a self, profile: &'a Profile<T>) -> impl Iterator<Item = ProfileMoments<T>> + 'a {
        let stations = profile.stations();
        (0..self.zones.len()).map(move |zone| {
            let furthest = |one: T, other: &T| one.larger(other.clone());
            let start = self.borders[..zone].split_first().map(|(first, others)| others.iter().fold(first.clone(), furthest));
            let ends = stations.windows(2).zip(profile.depths().windows(2));
            ends.fold(ProfileMoments::zero(), |sum, (at, depth)| {
                let (begin, end) = (at[0].clone(), at[1].clone());
                let (mut from, mut to) = (begin.clone(), end.clone());
                // A border belongs to the part that begins at it: if it lies on a station it shifts only that part, not the one before as well.
                if let Some(border) = &start {
                    let inside = end.clone().smaller(border.clone());
                    from = T::select(border.less(&begin), from, inside);
                }
                if let Some(border) = self.borders.get(zone) {
                    let inside = border.clone().larger(begin.clone());
                    to = T::select(border.less(&end), inside, to);
                }
                let depth_at = |station: &T| {
                    let share = (station.clone() - begin.clone()) / (end.clone() - begin.clone());
                    depth[0].clone() + (depth[1].clone() - depth[0].clone()) * share
                };
                // Borders out of order leave no width between them.
                let width = (to.clone() - from.clone()).larger(T::int(0));
                sum + ProfileMoments::of_segment(width, depth_at(&from), depth_at(&to))
            })
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::string::ToString;
    use alloc::vec;
    use approx::assert_relative_eq;

    const SOFT: CrushStiffness = CrushStiffness { onset: 3.0, slope: 4.0 };
    const STIFF: CrushStiffness = CrushStiffness { onset: 2.0, slope: 9.0 };

    #[test]
    fn the_moments_of_the_zones_are_those_of_their_parts() {
        let profile = Profile::equally_spaced(4.0, vec![0.0, 1.0, 0.5]).expect("three depths");
        let zones = StiffnessZones::new(vec![SOFT, STIFF, SOFT], vec![1.0, 3.0]).expect("three zones");
        let parts: Vec<_> = zones.moments(&profile).collect();
        let part = |depths: Vec<f64>, width| Profile::equally_spaced(width, depths).expect("two or more").moments();
        assert_eq!(parts, [part(vec![0.0, 0.5], 1.0), part(vec![0.5, 1.0, 0.75], 2.0), part(vec![0.75, 0.5], 1.0)]);
        let by_hand = SOFT.crush_energy(parts[0]) + STIFF.crush_energy(parts[1]) + SOFT.crush_energy(parts[2]);
        assert_eq!(zones.crush_energy(&profile), by_hand);
    }

    #[test]
    fn zones_beyond_the_crush_do_not_count() {
        let profile = Profile::at_stations(vec![1.0, 2.0], vec![0.5, 0.25]).expect("two stations");
        let alone = SOFT.crush_energy(profile.moments());
        for borders in [vec![0.0, 0.5], vec![0.5, 3.0], vec![2.0, 3.0], vec![-1.0, 1.0]] {
            let before = borders[1] <= 1.0;
            let among = if before {
                vec![STIFF, STIFF, SOFT]
            } else if borders[0] < 1.0 {
                vec![STIFF, SOFT, STIFF]
            } else {
                vec![SOFT, STIFF, STIFF]
            };
            let zones = StiffnessZones::new(among, borders.clone()).expect("three zones");
            assert_relative_eq!(zones.crush_energy(&profile), alone, max_relative = 1e-15);
        }
        assert_eq!(StiffnessZones::from(SOFT).crush_energy(&profile), alone);
    }

    #[test]
    fn there_is_one_border_between_two_zones() {
        let zones = StiffnessZones::new(vec![SOFT, STIFF], vec![1.0]).expect("one border");
        assert_eq!((zones.zones(), zones.borders()), (&[SOFT, STIFF][..], &[1.0][..]));
        let error = StiffnessZones::new(vec![SOFT, STIFF], vec![]).expect_err("no border");
        assert_eq!(error, ZoneError { zones: 2, borders: 0 });
        assert_eq!(error.to_string(), "2 zones of stiffness with 0 borders: there is one border between two zones");
        assert_eq!(StiffnessZones::<f64>::new(vec![], vec![]), Err(ZoneError { zones: 0, borders: 0 }));
    }
}
