//! The shape of a crush: depths at stations across its width, linear in between.

use alloc::vec::Vec;
use core::fmt;

use super::ProfileMoments;
use crate::scalar::{Field, Ordered};

/// A part of a crush profile: a width over which the depth changes in a straight line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment<T = f64> {
    /// Its width, in m.
    pub width: T,
    /// The depth where it begins, in m.
    pub from: T,
    /// The depth where it ends, in m.
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
/// # Ok::<(), planar_impact::crush::ProfileError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Profile<T = f64> {
    stations: Stations<T>,
    depths: Vec<T>,
}

/// Where the depths are. Equal spacing is kept as such, so that its moments are those of [`ProfileMoments::of`] to the bit.
#[derive(Clone, Debug, PartialEq)]
enum Stations<T> {
    Equal { width: T },
    At(Vec<T>),
}

/// Why depths and stations make no profile.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum ProfileError<T = f64> {
    /// A profile needs two depths at least.
    TooFewDepths {
        /// How many there are.
        count: usize,
    },
    /// Each depth needs its station.
    Unequal {
        /// The number of depths.
        depths: usize,
        /// The number of stations.
        stations: usize,
    },
    /// The width is not above zero.
    NoWidth {
        /// The width, in m.
        width: T,
    },
    /// A station does not lie beyond the one before it.
    NotIncreasing {
        /// Its place, counted from 1.
        place: usize,
        /// The station, in m.
        station: T,
        /// The one before, in m.
        before: T,
    },
    /// A depth is below zero, or not a finite number.
    NotADepth {
        /// Its place, counted from 1.
        place: usize,
        /// The depth, in m.
        depth: T,
    },
}

impl<T: fmt::Display> fmt::Display for ProfileError<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            ProfileError::TooFewDepths { count } => write!(f, "{count} depths make no crush profile: two or more are needed"),
            ProfileError::Unequal { depths, stations } => write!(f, "{depths} depths at {stations} stations: each depth needs its station"),
            ProfileError::NoWidth { width } => write!(f, "the width of the crush is {width} m: it must be above zero"),
            ProfileError::NotIncreasing { place, station, before } => {
                write!(f, "station {place} at {station} m does not lie beyond station {} at {before} m", place - 1)
            }
            ProfileError::NotADepth { place, depth } => write!(f, "depth {place} is {depth} m: it must not be below zero"),
        }
    }
}

impl<T: fmt::Debug + fmt::Display> core::error::Error for ProfileError<T> {}

impl<T: Field> Profile<T> {
    /// Depths equally spaced over a width, which is the usual protocol with two, four or six of them.
    ///
    /// The depths are taken as they are: for floats, [`Profile::checked`] refuses those that are none.
    ///
    /// # Errors
    ///
    /// [`ProfileError::TooFewDepths`].
    pub fn equally_spaced(width: T, depths: Vec<T>) -> Result<Self, ProfileError<T>> {
        if depths.len() < 2 || i32::try_from(depths.len()).is_err() {
            return Err(ProfileError::TooFewDepths { count: depths.len() });
        }
        Ok(Profile { stations: Stations::Equal { width }, depths })
    }

    /// Depths at given stations along the surface, in m from any origin, increasing.
    ///
    /// # Errors
    ///
    /// [`ProfileError::TooFewDepths`], or [`ProfileError::Unequal`].
    pub fn at_stations(stations: Vec<T>, depths: Vec<T>) -> Result<Self, ProfileError<T>> {
        if depths.len() < 2 {
            return Err(ProfileError::TooFewDepths { count: depths.len() });
        }
        if stations.len() != depths.len() {
            return Err(ProfileError::Unequal { depths: depths.len(), stations: stations.len() });
        }
        Ok(Profile { stations: Stations::At(stations), depths })
    }

    /// The depths, in m.
    pub fn depths(&self) -> &[T] {
        &self.depths
    }

    /// Where the depths are along the surface, in m; equally spaced ones begin at 0.
    pub fn stations(&self) -> Vec<T> {
        match &self.stations {
            Stations::At(stations) => stations.clone(),
            Stations::Equal { width } => {
                let step = width.clone() / T::int(self.gaps());
                (0..=self.gaps()).map(|i| step.clone() * T::int(i)).collect()
            }
        }
    }

    /// The width of the crush, in m.
    pub fn width(&self) -> T {
        match &self.stations {
            Stations::Equal { width } => width.clone(),
            Stations::At(stations) => stations[stations.len() - 1].clone() - stations[0].clone(),
        }
    }

    fn gaps(&self) -> i32 {
        i32::try_from(self.depths.len() - 1).expect("checked where it is made")
    }

    /// The parts between neighbouring depths.
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

    /// K₁, K₂, K₃ of the profile   (Eq 4).
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
    /// K₁, K₂, K₃ of this part   (Eq 4).
    #[inline(always)]
    pub fn moments(&self) -> ProfileMoments<T> {
        ProfileMoments::of_segment(self.width.clone(), self.from.clone(), self.to.clone())
    }
}

impl<T: Ordered<Mask = bool>> Profile<T> {
    /// The same profile, if its numbers can be those of a crush.
    ///
    /// # Errors
    ///
    /// Everything wrong with it: a width that is not above zero, stations that do not increase, depths below zero. Infinity and what is not a number are
    /// neither a width nor a depth.
    pub fn checked(self) -> Result<Self, Vec<ProfileError<T>>> {
        let mut errors = Vec::new();
        let is_above = |x: &T, y: &T| y.less(x) && (x.clone() - x.clone()).less(&T::int(1));
        match &self.stations {
            Stations::Equal { width } if !is_above(width, &T::int(0)) => errors.push(ProfileError::NoWidth { width: width.clone() }),
            Stations::Equal { .. } => (),
            Stations::At(stations) => {
                for (i, pair) in stations.windows(2).enumerate().filter(|(_, pair)| !is_above(&pair[1], &pair[0])) {
                    let (before, station) = (pair[0].clone(), pair[1].clone());
                    errors.push(ProfileError::NotIncreasing { place: i + 2, station, before });
                }
            }
        }
        for (i, depth) in self.depths.iter().enumerate() {
            let is_number = (depth.clone() - depth.clone()).less(&T::int(1));
            if depth.less(&T::int(0)) || !is_number {
                errors.push(ProfileError::NotADepth { place: i + 1, depth: depth.clone() });
            }
        }
        if errors.is_empty() { Ok(self) } else { Err(errors) }
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
        assert_eq!(Profile::equally_spaced(1.0, vec![0.5]), Err(ProfileError::TooFewDepths { count: 1 }));
        assert_eq!(Profile::at_stations(vec![0.0], vec![0.5]), Err(ProfileError::TooFewDepths { count: 1 }));
        assert_eq!(Profile::at_stations(vec![0.0], vec![0.5, 0.5]), Err(ProfileError::Unequal { depths: 2, stations: 1 }));
        let wrong = Profile::at_stations(vec![0.0, 1.0, 1.0, f64::NAN], vec![0.1, -0.1, f64::NAN, 0.0]).expect("four and four");
        let errors = wrong.checked().expect_err("four of them are wrong");
        assert!(matches!(errors[0], ProfileError::NotIncreasing { place: 3, station: 1.0, before: 1.0 }));
        assert!(matches!(errors[1], ProfileError::NotIncreasing { place: 4, .. }));
        assert!(matches!(errors[2], ProfileError::NotADepth { place: 2, depth: -0.1 }));
        assert!(matches!(errors[3], ProfileError::NotADepth { place: 3, .. }));
        assert_eq!(errors.len(), 4);
        for width in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            let profile = Profile::equally_spaced(width, vec![0.1, 0.2]).expect("two depths");
            let errors = profile.checked().expect_err("no width");
            assert!(matches!(errors.as_slice(), [ProfileError::NoWidth { .. }]), "{width}");
        }
        let deep = Profile::equally_spaced(1.0, vec![0.9, f64::INFINITY]).expect("two depths");
        assert_eq!(deep.checked(), Err(vec![ProfileError::NotADepth { place: 2, depth: f64::INFINITY }]));
        let right = Profile::equally_spaced(1.0, vec![0.0, 1.2]).expect("two depths");
        assert_eq!(right.clone().checked(), Ok(right));
    }

    #[test]
    fn errors_have_their_numbers() {
        let words: [(ProfileError, &str); 5] = [
            (ProfileError::TooFewDepths { count: 1 }, "1 depths make no crush profile: two or more are needed"),
            (ProfileError::Unequal { depths: 2, stations: 3 }, "2 depths at 3 stations: each depth needs its station"),
            (ProfileError::NoWidth { width: -1.5 }, "the width of the crush is -1.5 m: it must be above zero"),
            (
                ProfileError::NotIncreasing { place: 3, station: 0.5, before: 0.75 },
                "station 3 at 0.5 m does not lie beyond station 2 at 0.75 m",
            ),
            (ProfileError::NotADepth { place: 2, depth: -0.1 }, "depth 2 is -0.1 m: it must not be below zero"),
        ];
        for (error, text) in words {
            assert_eq!(error.to_string(), text);
        }
    }
}
