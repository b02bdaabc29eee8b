//! Depths measured from a line beside the vehicle.

use alloc::vec::Vec;

use super::{Profile, ProfileError};
use crate::issue::Issues;
use crate::scalar::{Ordered, Real};

/// A straight line beside the vehicle from which depths are measured: parallel to its undeformed surface, at a distance from it, with the readings at an
/// angle.
///
/// A reading r at a station s is a depth of r cos β − a at the station s + r sin β, with a the distance of the line from the surface and β the angle
/// between the readings and the perpendicular to the surface, positive towards larger stations.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct MeasuringLine<T = f64> {
    /// a: distance of the line outside the undeformed surface, in m.
    pub offset: T,
    /// β: angle of the readings from the perpendicular of the surface, in rad.
    pub angle: T,
}

impl<T: Real> MeasuringLine<T> {
    /// Returns the profile from readings at stations along the line.
    ///
    /// ```
    /// use planar_impact::crush::MeasuringLine;
    /// let line = MeasuringLine { offset: 0.25, angle: 0.0 };
    /// assert_eq!(line.profile(&[0.0, 1.0], &[0.5, 0.75])?.depths(), [0.25, 0.5]);
    /// # Ok::<(), planar_impact::Issues<planar_impact::crush::ProfileError>>(())
    /// ```
    ///
    /// # Errors
    ///
    /// As [`Profile::at_stations`].
    pub fn profile(&self, stations: &[T], readings: &[T]) -> Result<Profile<T>, Issues<ProfileError<T>>>
    where
        T: Ordered<Mask = bool>,
    {
        self.profile_unchecked(stations, readings)?.checked()
    }

    /// Returns the same without checking its numbers, as [`Profile::at_stations_unchecked`] does.
    ///
    /// # Errors
    ///
    /// As [`Profile::at_stations_unchecked`].
    pub fn profile_unchecked(&self, stations: &[T], readings: &[T]) -> Result<Profile<T>, ProfileError<T>> {
        let (sin, cos) = self.angle.clone().sin_and_cos();
        let depths = readings.iter().map(|reading| reading.clone() * cos.clone() - self.offset.clone()).collect();
        let along = stations.iter().zip(readings).map(|(station, reading)| station.clone() + reading.clone() * sin.clone());
        let along: Vec<T> = along.chain(stations.iter().skip(readings.len()).cloned()).collect();
        Profile::at_stations_unchecked(along, depths)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn a_leaning_reading_reaches_the_same_bottom() {
        // A flat crush of 0.3 m seen from a line 0.1 m out: at 60° from the perpendicular each reading is twice 0.4 m, √3/2 of it along the line.
        let line = MeasuringLine { offset: 0.1, angle: core::f64::consts::FRAC_PI_3 };
        let profile = line.profile(&[0.0, 1.0], &[0.8, 0.8]).expect("two readings");
        for depth in profile.depths() {
            assert_relative_eq!(*depth, 0.3, max_relative = 1e-14);
        }
        assert_relative_eq!(profile.stations()[0], 0.8 * 0.75_f64.sqrt(), max_relative = 1e-14);
        assert_relative_eq!(profile.width(), 1.0, max_relative = 1e-14);
        assert_eq!(line.profile(&[0.0, 1.0, 2.0], &[0.8, 0.8]), Err(ProfileError::Unequal { depths: 2, stations: 3 }.into()));
        assert!(line.profile(&[0.0, 1.0], &[0.8, 0.1]).is_err(), "the second reading ends outside the surface");
    }
}
