//! Restitution from film: the distance of a point from the barrier over time, smoothed and differentiated.

use super::estimate::Estimate;
use super::issue::{TestIssue, TestIssues, finite_estimate};
use super::lowess::{Lowess, Smoothed};
use super::record::Record;
use crate::issue::{IssueCollector, Place};
use crate::measure::Measure;
use crate::scalar::Ordered;

/// Computes the restitution of a point from its distance to the barrier over time, e = V_Cn/v_Cn: the slope of the smoothed distance at separation over the
/// closing speed.
///
/// The distance is perpendicular to the barrier, in m, and grows as the point rebounds. The separation time is in s, the closing speed normal to the barrier
/// in m/s. The variance includes the noise of the distances and that of the closing speed, but not the bias of the smoothing: see [`Lowess::smooth`].
///
/// ```
/// use planar_impact::barrier::{Estimate, Lowess, Record, restitution_from_film};
/// // 10 ms apart: in at 10 m/s, out at 1.5 m/s from 0.1 s on, read to 1 mm.
/// let distance = |i: i32| if i < 10 { 1.0 - 0.1 * f64::from(i) } else { 0.015 * f64::from(i - 10) };
/// let read = (0..30).map(|i| (distance(i) * 1000.0).round() / 1000.0).collect();
/// let film = Record::uniform(0.0, 0.01, read)?;
/// let lowess = Lowess { neighbors: 9, robust_passes: 3 };
/// let restitution = restitution_from_film(&film, lowess, 0.2, Estimate::with_deviation(10.0, 0.05))?;
/// assert!((restitution.value - 0.15).abs() < 3.0 * restitution.deviation());
/// # Ok::<(), planar_impact::barrier::TestIssues>(())
/// ```
///
/// # Errors
///
/// As [`Lowess::smooth`], and for a separation time outside the record, a closing speed that is not above zero or so small that the ratio is not finite, or a
/// negative variance.
pub fn restitution_from_film<T: Ordered<Mask = bool>>(
    distance: &Record<T>,
    lowess: Lowess,
    separation: T,
    closing: Estimate<T>,
) -> Result<Estimate<T>, TestIssues<T>> {
    check_closing(&closing)?;
    restitution_from_smoothed(&lowess.smooth(distance)?, separation, closing)
}

/// As [`restitution_from_film`], from distances that are smoothed already.
///
/// # Errors
///
/// As [`restitution_from_film`].
pub fn restitution_from_smoothed<T: Ordered<Mask = bool>>(
    distance: &Smoothed<T>,
    separation: T,
    closing: Estimate<T>,
) -> Result<Estimate<T>, TestIssues<T>> {
    check_closing(&closing)?;
    finite_estimate("restitution", distance.at(separation)?.slope.over(closing))
}

fn check_closing<T: Ordered<Mask = bool>>(closing: &Estimate<T>) -> Result<(), TestIssues<T>> {
    let mut issues = IssueCollector::<TestIssue<T>>::new();
    issues.positive(Place::of("closing speed", Measure::Speed), &closing.value);
    issues.not_negative(Place::plain("variance of the closing speed"), &closing.variance);
    issues.finish()
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec::Vec;
    use approx::assert_relative_eq;

    const LOWESS: Lowess = Lowess { neighbors: 8, robust_passes: 0 };

    fn film(noise: f64) -> Record {
        let distances: Vec<f64> = (0..20).map(|i| 0.02 * f64::from(i) + noise * if i % 2 == 0 { 1.0 } else { -1.0 }).collect();
        Record::uniform(0.0, 0.01, distances).expect("a good record")
    }

    #[test]
    fn a_clean_film_is_the_ratio_of_the_speeds() {
        let e = restitution_from_film(&film(0.0), LOWESS, 0.1, Estimate::with_deviation(10.0, 0.5)).expect("a good film");
        assert_relative_eq!(e.value, 0.2, max_relative = 1e-12);
        // The closing speed alone is uncertain: by 5 %.
        assert_relative_eq!(e.deviation(), 0.01, max_relative = 1e-9);
    }

    #[test]
    fn readings_on_one_line_are_as_uncertain_as_their_step() {
        let closing = Estimate::with_deviation(10.0, 0.0);
        let of = |noise: f64| {
            let smoothed = LOWESS.smooth(&film(0.002)).expect("a good film").with_noise_of_at_least(noise);
            (smoothed.noise(), restitution_from_smoothed(&smoothed, 0.1, closing).expect("a good film"))
        };
        let (own, as_it_is) = of(0.0);
        assert_eq!(as_it_is, restitution_from_film(&film(0.002), LOWESS, 0.1, closing).expect("a good film"));
        assert_eq!(of(0.9 * own).1, as_it_is);
        let (noise, coarse) = of(4.0 * own);
        assert_eq!((noise, coarse.value), (4.0 * own, as_it_is.value));
        assert_relative_eq!(coarse.deviation(), 2.0 * as_it_is.deviation(), max_relative = 1e-12);
    }

    #[test]
    fn noise_on_the_film_makes_it_uncertain() {
        let of =
            |noise| restitution_from_film(&film(noise), LOWESS, 0.1, Estimate::with_deviation(10.0, 0.0)).expect("a good film").deviation();
        assert_relative_eq!(of(0.004), 2.0 * of(0.002), max_relative = 1e-9);
        assert!(of(0.002) > 1e-3);
    }

    #[test]
    fn a_vehicle_that_does_not_close_is_refused() {
        let issues = restitution_from_film(&film(0.0), LOWESS, 0.1, Estimate { value: -1.0, variance: -1.0 }).expect_err("two issues");
        assert_eq!(issues.len(), 2);
        assert!(restitution_from_film(&film(0.0), LOWESS, 0.2, Estimate::with_deviation(1.0, 0.0)).is_err());
    }

    #[test]
    fn a_ratio_that_is_not_finite_is_refused() {
        let closing = Estimate::with_deviation(1e-300, 1e-3);
        let issues = restitution_from_film(&film(0.0), LOWESS, 0.1, closing).expect_err("a variance beyond every float");
        assert_eq!(issues.first().place().map(|place| place.path().into_owned()).as_deref(), Some("variance of restitution"));
    }
}
