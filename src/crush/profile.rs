//! The shape of a crush: depths at stations across its width, linear in between.

use alloc::borrow::Cow;
use alloc::vec::Vec;
use core::fmt;

use super::ProfileMoments;
use crate::issue::{InputIssue, Issue, IssueCollector, Issues, Place};
use crate::measure::Measure;
use crate::message::Message;
use crate::scalar::{Field, Ordered};

/// A part of a crush profile: a width over which the depth changes linearly.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Segment<T = f64> {
    /// Its width, in m.
    pub width: T,
    /// Depth at its beginning, in m.
    pub from: T,
    /// Depth at its end, in m.
    pub to: T,
}

/// Depths at stations across a crush: two or more, at increasing stations, the depth linear in between.
///
/// ```
/// use planar_impact::crush::{CrushStiffness, Profile};
/// let even = Profile::equally_spaced(6.0, vec![0.0, 0.6, 0.3])?;
/// let uneven = Profile::at_stations(vec![0.0, 3.0, 5.0, 6.0], vec![0.0, 0.6, 0.4, 0.3])?;
/// let stiffness = CrushStiffness { onset: 100.0, slope: 1000.0 };
/// let difference: f64 = stiffness.crush_energy(even.moments()) - stiffness.crush_energy(uneven.moments());
/// assert!(difference.abs() < 1e-9);
/// # Ok::<(), planar_impact::Issues<planar_impact::crush::ProfileError>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(try_from = "UncheckedProfile<T>", bound(deserialize = "T: serde::Deserialize<'de> + Ordered<Mask = bool> + fmt::Display"))
)]
pub struct Profile<T = f64> {
    stations: Stations<T>,
    depths: Vec<T>,
}

/// Positions of the depths. Equal spacing is stored as such, so that its moments equal those of [`ProfileMoments::of`] to the bit.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
enum Stations<T> {
    Equal { width: T },
    At(Vec<T>),
}

/// A profile as stored, whose numbers may be invalid.
#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
struct UncheckedProfile<T> {
    stations: Stations<T>,
    depths: Vec<T>,
}

#[cfg(feature = "serde")]
impl<T: Ordered<Mask = bool>> TryFrom<UncheckedProfile<T>> for Profile<T> {
    type Error = Issues<ProfileError<T>>;

    fn try_from(stored: UncheckedProfile<T>) -> Result<Self, Self::Error> {
        match stored.stations {
            Stations::Equal { width } => Profile::equally_spaced(width, stored.depths),
            Stations::At(stations) => Profile::at_stations(stations, stored.depths),
        }
    }
}

/// Reason why depths and stations do not form a profile.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub enum ProfileError<T = f64> {
    /// A depth, a station, the width or a list is invalid. Places are counted from zero.
    Input(InputIssue<T>),
    /// The numbers of depths and stations differ.
    Unequal {
        /// The number of depths.
        depths: usize,
        /// The number of stations.
        stations: usize,
    },
}

impl<T> From<InputIssue<T>> for ProfileError<T> {
    fn from(issue: InputIssue<T>) -> Self {
        ProfileError::Input(issue)
    }
}

impl<T: Ordered<Mask = bool>> Issue for ProfileError<T> {
    type Number = T;

    fn code(&self) -> &'static str {
        match self {
            ProfileError::Input(issue) => issue.code(),
            ProfileError::Unequal { .. } => "unequal-lengths",
        }
    }

    fn path(&self) -> Option<Cow<'static, str>> {
        match self {
            ProfileError::Input(issue) => issue.path(),
            ProfileError::Unequal { .. } => Some("stations".into()),
        }
    }

    fn message(&self) -> Message<T> {
        match self {
            ProfileError::Input(issue) => issue.message(),
            ProfileError::Unequal { depths, stations } => {
                Message::new().text(alloc::format!("{depths} depths at {stations} stations: each depth needs its station"))
            }
        }
    }
}

impl<T: Ordered<Mask = bool> + fmt::Display> fmt::Display for ProfileError<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            ProfileError::Input(issue) => issue.fmt(f),
            ProfileError::Unequal { .. } => self.message().fmt(f),
        }
    }
}

impl<T: Ordered<Mask = bool> + fmt::Debug + fmt::Display> core::error::Error for ProfileError<T> {}

/// Place of the depths of a profile in issues.
pub(super) const DEPTHS: Place = Place::of("depths", Measure::Length);
const STATIONS: Place = Place::of("stations", Measure::Length);

impl<T: Field> Profile<T> {
    /// Creates a profile as [`Profile::equally_spaced`] does, without checking its numbers: for a field without an order, and for numbers that are checked
    /// later, by [`Profile::checked`].
    ///
    /// # Errors
    ///
    /// If there are fewer than two depths.
    pub fn equally_spaced_unchecked(width: T, depths: Vec<T>) -> Result<Self, ProfileError<T>> {
        if depths.len() < 2 || i32::try_from(depths.len()).is_err() {
            return Err(InputIssue::too_few(DEPTHS, depths.len(), 2).into());
        }
        Ok(Profile { stations: Stations::Equal { width }, depths })
    }

    /// Creates a profile as [`Profile::at_stations`] does, without checking its numbers: for a field without an order, and for numbers that are checked
    /// later, by [`Profile::checked`].
    ///
    /// # Errors
    ///
    /// If there are fewer than two depths, or [`ProfileError::Unequal`].
    pub fn at_stations_unchecked(stations: Vec<T>, depths: Vec<T>) -> Result<Self, ProfileError<T>> {
        if depths.len() < 2 {
            return Err(InputIssue::too_few(DEPTHS, depths.len(), 2).into());
        }
        if stations.len() != depths.len() {
            return Err(ProfileError::Unequal { depths: depths.len(), stations: stations.len() });
        }
        Ok(Profile { stations: Stations::At(stations), depths })
    }

    /// Returns the depths, in m.
    pub fn depths(&self) -> &[T] {
        &self.depths
    }

    /// Returns the positions of the depths along the surface, in m; equally spaced ones begin at 0.
    pub fn stations(&self) -> Vec<T> {
        match &self.stations {
            Stations::At(stations) => stations.clone(),
            Stations::Equal { width } => {
                let step = width.clone() / T::int(self.gaps());
                (0..=self.gaps()).map(|i| step.clone() * T::int(i)).collect()
            }
        }
    }

    /// Returns the width of the crush, in m.
    pub fn width(&self) -> T {
        match &self.stations {
            Stations::Equal { width } => width.clone(),
            Stations::At(stations) => stations[stations.len() - 1].clone() - stations[0].clone(),
        }
    }

    fn gaps(&self) -> i32 {
        i32::try_from(self.depths.len() - 1).expect("checked where it is made")
    }

    /// Returns the parts between neighboring depths.
    pub fn segments(&self) -> impl Iterator<Item = Segment<T>> + '_ {
        let step = match &self.stations {
            Stations::Equal { width } => Some(width.clone() / T::int(self.gaps())),
            Stations::At(_) => None,
        };
        self.depths.windows(2).enumerate().map(move |(i, pair)| {
            let width = match (&self.stations, &step) {
                (Stations::At(stations), _) => stations[i + 1].clone() - stations[i].clone(),
                (_, Some(step)) => step.clone(),
                (Stations::Equal { width }, None) => width.clone(),
            };
            Segment { width, from: pair[0].clone(), to: pair[1].clone() }
        })
    }

    /// Returns K₁, K₂, K₃ of the profile   (Eq 4).
    pub fn moments(&self) -> ProfileMoments<T> {
        if let Stations::Equal { width } = &self.stations
            && let Some(moments) = ProfileMoments::of(width.clone(), &self.depths)
        {
            return moments;
        }
        self.segments().fold(ProfileMoments::zero(), |sum, segment| sum + segment.moments())
    }
}

impl<T: Field> Segment<T> {
    /// Returns K₁, K₂, K₃ of this part   (Eq 4).
    #[inline]
    pub fn moments(&self) -> ProfileMoments<T> {
        ProfileMoments::of_segment(self.width.clone(), self.from.clone(), self.to.clone())
    }
}

impl<T: Ordered<Mask = bool>> Profile<T> {
    /// Creates a profile with depths equally spaced over a width, both in m; usually two, four or six depths.
    ///
    /// ```
    /// use planar_impact::crush::Profile;
    /// let wrong = Profile::equally_spaced(-1.0, vec![0.2, -0.3]).unwrap_err();
    /// assert_eq!(wrong.to_string(), "width is -1 m; it must be above zero; depths[1] is -0.3 m; it must be at least 0 m");
    /// ```
    ///
    /// # Errors
    ///
    /// Every issue: fewer than two depths, a width that is not above zero, depths below zero, numbers that are not finite.
    pub fn equally_spaced(width: T, depths: Vec<T>) -> Result<Self, Issues<ProfileError<T>>> {
        Profile::equally_spaced_unchecked(width, depths)?.checked()
    }

    /// Creates a profile with depths at given stations along the surface, in m from any origin, increasing.
    ///
    /// # Errors
    ///
    /// Every issue: fewer than two depths, another number of stations, stations that do not increase, depths below zero, numbers that are not finite.
    pub fn at_stations(stations: Vec<T>, depths: Vec<T>) -> Result<Self, Issues<ProfileError<T>>> {
        Profile::at_stations_unchecked(stations, depths)?.checked()
    }

    /// Returns the same profile if its numbers are valid for a crush.
    ///
    /// # Errors
    ///
    /// Every issue: a width that is not above zero, stations that do not increase, depths below zero, numbers that are not finite.
    pub fn checked(self) -> Result<Self, Issues<ProfileError<T>>> {
        let mut issues = IssueCollector::<ProfileError<T>>::new();
        match &self.stations {
            Stations::Equal { width } => {
                issues.positive(Place::of("width", Measure::Length), width);
            }
            Stations::At(stations) => {
                let mut before: Option<&T> = None;
                for (i, station) in stations.iter().enumerate() {
                    let finite = issues.finite(STATIONS.at(i), station);
                    if let Some(before) = before.filter(|before| finite && !before.less(station)) {
                        issues.push(InputIssue::out_of_order(STATIONS.at(i), station.clone(), before.clone()));
                    }
                    before = finite.then_some(station);
                }
            }
        }
        for (i, depth) in self.depths.iter().enumerate() {
            issues.not_negative(DEPTHS.at(i), depth);
        }
        issues.finish().map(|()| self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::string::ToString;
    use alloc::vec;

    #[test]
    fn equal_spacing_is_a_choice_of_stations() {
        let equal = Profile::equally_spaced(3.0, vec![0.0, 1.0, 2.0, 0.0]).expect("four depths");
        let at = Profile::at_stations(equal.stations(), equal.depths().to_vec()).expect("four stations");
        assert_eq!(equal.stations(), [0.0, 1.0, 2.0, 3.0]);
        assert_eq!((equal.width(), equal.moments()), (at.width(), at.moments()));
        assert!(equal.segments().eq(at.segments()));
        let shifted = Profile::at_stations(vec![-1.5, -0.5, 0.5, 1.5], vec![0.0, 1.0, 2.0, 0.0]).expect("four stations");
        assert_eq!(shifted.moments(), at.moments());
    }

    #[test]
    fn what_is_no_profile_is_refused() {
        let one_depth = ProfileError::Input(InputIssue::too_few(DEPTHS, 1, 2));
        assert_eq!(Profile::equally_spaced(1.0, vec![0.5]), Err(one_depth.clone().into()));
        assert_eq!(Profile::at_stations(vec![0.0], vec![0.5]), Err(one_depth.into()));
        assert_eq!(Profile::at_stations(vec![0.0], vec![0.5, 0.5]), Err(ProfileError::Unequal { depths: 2, stations: 1 }.into()));
        let wrong = Profile::at_stations(vec![0.0, 1.0, 1.0, f64::NAN], vec![0.1, -0.1, f64::NAN, 0.0]);
        let texts: Vec<_> = wrong.expect_err("four of them are wrong").iter().map(ToString::to_string).collect();
        assert_eq!(
            texts,
            [
                "stations[2] is 1 m after 1 m; it is out of order",
                "stations[3] is not finite: NaN",
                "depths[1] is -0.1 m; it must be at least 0 m",
                "depths[2] is not finite: NaN"
            ]
        );
        for width in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            let errors = Profile::equally_spaced(width, vec![0.1, 0.2]).expect_err("no width");
            assert!(matches!(errors.as_slice(), [ProfileError::Input(issue)] if issue.at.name == "width"), "{width}");
        }
        let deep = Profile::equally_spaced(1.0, vec![0.9, f64::INFINITY]);
        assert_eq!(deep.expect_err("it is infinite").to_string(), "depths[1] is not finite: inf");
        let right = Profile::equally_spaced(1.0, vec![0.0, 1.2]).expect("two depths");
        assert_eq!(right.clone().checked(), Ok(right));
    }
}
