//! Load cells of a barrier, summed into banks, and the impulse on the vehicle.

use super::estimate::Estimate;
use super::issue::{TestIssue, TestIssues, finite, finite_estimate};
use super::record::{Record, Window};
use crate::frame::Nt;
use crate::issue::{InputIssue, IssueCollector, Place};
use crate::measure::Measure;
use crate::scalar::Ordered;
use alloc::vec::Vec;

/// Channels of a barrier, as forces on the vehicle in N: those that measure the normal force and those that measure the tangential force.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(bound(deserialize = "T: serde::Deserialize<'de> + Ordered<Mask = bool> + core::fmt::Display")))]
pub struct BarrierRecord<T = f64> {
    /// Load cells of the main face, normal to it.
    pub normal: Vec<Record<T>>,
    /// Load cells along the main face, such as those of a wing.
    pub tangential: Vec<Record<T>>,
}

/// Returns the sum of channels that were sampled at the same instants.
///
/// # Errors
///
/// If there are no channels, and for every channel whose instants differ from those of the first.
pub fn bank<T: Ordered<Mask = bool>>(channels: &[Record<T>]) -> Result<Record<T>, TestIssues<T>> {
    let mut issues = IssueCollector::<TestIssue<T>>::new();
    let [first, others @ ..] = channels else {
        return Err(InputIssue::too_few(Place::plain("channels"), 0, 1).into());
    };
    for (i, other) in others.iter().enumerate() {
        if !are_simultaneous(first, other) {
            issues.push(TestIssue::InstantsDiffer { at: Place::plain("channel").at(i + 1) });
        }
    }
    issues.finish()?;
    let mut sums = first.values().to_vec();
    for other in others {
        sums.iter_mut().zip(other.values()).for_each(|(sum, value)| *sum = sum.clone() + value.clone());
    }
    let mut issues = IssueCollector::<TestIssue<T>>::new();
    issues.all_finite(Place::plain("sums"), &sums);
    issues.finish()?;
    Ok(first.with_values(sums))
}

impl<T: Ordered<Mask = bool>> BarrierRecord<T> {
    /// Returns the impulse over a window along the normal and the tangent, in N s, with the baseline of the window before it removed.
    ///
    /// # Errors
    ///
    /// As [`bank`], [`Record::baseline`] and [`Record::impulse_over`].
    pub fn impulse(&self, over: &Window<T>, before: &Window<T>) -> Result<Nt<T>, TestIssues<T>> {
        let along = |channels: &[Record<T>]| bank(channels)?.corrected(before)?.impulse_over(over);
        Ok(Nt { n: along(&self.normal)?, t: along(&self.tangential)? })
    }
}

impl<T: Ordered<Mask = bool>> BarrierRecord<T> {
    /// Returns the impulse ratio over a window, μ = P_t/P_n, with its variance from the noise of the two banks, which are assumed independent   (A8).
    ///
    /// # Errors
    ///
    /// As [`bank`] and [`Record::impulse`], and if the normal impulse is zero.
    pub fn ratio(&self, over: &Window<T>, before: &Window<T>) -> Result<Estimate<T>, TestIssues<T>> {
        let (normal, tangential) = (bank(&self.normal)?.impulse(over, before)?, bank(&self.tangential)?.impulse(over, before)?);
        impulse_ratio(Nt { n: normal.value.clone(), t: tangential.value.clone() })?;
        finite_estimate("impulse ratio", tangential.over(normal))
    }
}

/// Returns the impulse ratio μ = P_t/P_n   (A8).
///
/// ```
/// use planar_impact::{Nt, barrier::impulse_ratio};
/// // Table 3 of the paper, test 1: main barrier left and right, and wing, in N s.
/// let ratio = impulse_ratio(Nt { n: 2596.0 + 4612.0, t: 1720.0 })?;
/// assert_eq!(format!("{ratio:.3}"), "0.239");
/// # Ok::<(), planar_impact::barrier::TestIssues>(())
/// ```
///
/// # Errors
///
/// If the normal impulse is zero, or a number is not finite.
pub fn impulse_ratio<T: Ordered<Mask = bool>>(impulse: Nt<T>) -> Result<T, TestIssues<T>> {
    let mut issues = IssueCollector::<TestIssue<T>>::new();
    issues.positive(Place::of("magnitude of the normal impulse", Measure::Impulse), &impulse.n.clone().magnitude());
    issues.finite(Place::of("tangential impulse", Measure::Impulse), &impulse.t);
    issues.finish()?;
    finite(Place::plain("impulse ratio"), impulse.t / impulse.n)
}

/// Returns `true` if two channels were sampled at the same instants, to rounding.
fn are_simultaneous<T: Ordered<Mask = bool>>(one: &Record<T>, other: &Record<T>) -> bool {
    let slack = (one.time(one.len() - 1) - one.time(0)) * crate::scalar::slack();
    one.len() == other.len() && (0..one.len()).all(|i| !slack.less(&(one.time(i) - other.time(i)).magnitude()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    fn channel(start: f64, values: [f64; 4]) -> Record {
        Record::uniform(start, 1.0, values.to_vec()).expect("a good record")
    }

    #[test]
    fn ratios_of_table_3() {
        // Table 3: left, right, their sum as printed, wing, and the ratio as printed.
        for (left, right, normal, wing, ratio) in
            [(2596.0, 4612.0, 7208.0, 1720.0, 0.239), (3301.0, 6788.0, 10089.0, 2857.0, 0.283), (3999.0, 7715.0, 11714.0, 6262.0, 0.535)]
        {
            assert_eq!(left + right, normal);
            let got = impulse_ratio(Nt { n: left + right, t: wing }).expect("a normal impulse");
            assert!((got - ratio).magnitude() <= 0.0005, "{got} where Table 3 has {ratio}");
        }
    }

    #[test]
    fn banks_add_up_and_keep_the_side() {
        let normal = alloc::vec![channel(-1.0, [1.0, 1.0, 5.0, 1.0]), channel(-1.0, [2.0, 2.0, 8.0, 2.0])];
        let record = BarrierRecord { normal, tangential: alloc::vec![channel(-1.0, [0.0, 0.0, -2.0, 0.0])] };
        let impulse = record.impulse(&Window { from: 0.0, to: 2.0 }, &Window { from: -1.0, to: 0.0 }).expect("good records");
        assert_eq!(impulse, Nt { n: 10.0, t: -2.0 });
        assert_eq!(impulse_ratio(impulse), Ok(-0.2));
    }

    #[test]
    fn the_noise_of_the_banks_is_in_the_ratio() {
        let (over, before) = (Window { from: 0.0, to: 2.0 }, Window { from: -1.0, to: 0.0 });
        let quiet = channel(-1.0, [1.0, 1.0, 5.0, 1.0]);
        let noisy = BarrierRecord { normal: alloc::vec![quiet.clone()], tangential: alloc::vec![channel(-1.0, [1.0, -1.0, 2.0, 0.0])] };
        let ratio = noisy.ratio(&over, &before).expect("a normal impulse");
        // The quantile of Student's distribution of two samples over that of the normal one.
        let student = (12.706_205_f64 / 1.959_964).powi(2);
        // P_n is 4, P_t is −½ + 2 with variance 2 · (1 + (½ − 1)² + 1 + ½²): the baseline and the window share a sample. The slopes of P_n change by 4 and −8,
        // those of P_t by 5 and −5: a twelfth of each is the deviation of its error, and they bend to and fro, beyond twice the variance of the baselines of 0 and 2.
        let of_normal = (16.0 + 64.0) / 144.0 + 4.0 * 8.0 / 4.0 - 2.0 * 0.0;
        let of_tangential = (25.0 + 25.0) / 144.0 + 5.0 * 5.0 / 4.0 - 2.0 * 2.0;
        assert_eq!(ratio.value, 1.5 / 4.0);
        let expected = (2.0 * 2.5 * student + of_tangential + 0.375 * 0.375 * of_normal) / 16.0;
        assert_relative_eq!(ratio.variance, expected, max_relative = 1e-3);
        let nothing = BarrierRecord { normal: alloc::vec![channel(-1.0, [1.0; 4])], tangential: alloc::vec![quiet] };
        assert!(nothing.ratio(&over, &before).is_err());
    }

    #[test]
    fn channels_of_other_instants_are_named() {
        let channels = [channel(0.0, [0.0; 4]), channel(0.5, [0.0; 4]), channel(0.0, [0.0; 4])];
        let issues = bank(&channels).expect_err("one channel is late");
        assert_eq!(issues.len(), 1);
        assert!(alloc::string::ToString::to_string(&issues).contains("channel[1]"));
        let given = Record::at_times(alloc::vec![0.0, 1.0, 2.0, 3.0], alloc::vec![1.0; 4]).expect("a good record");
        assert!(bank(&[channel(0.0, [0.0; 4]), given]).is_ok());
        let longer = Record::uniform(0.0, 1.0, alloc::vec![0.0; 5]).expect("a good record");
        assert!(bank(&[channel(0.0, [0.0; 4]), longer]).is_err());
        assert!(bank::<f64>(&[]).is_err());
        assert!(impulse_ratio(Nt { n: 0.0, t: 1.0 }).is_err());
        assert!(impulse_ratio(Nt { n: f64::NAN, t: f64::NAN }).is_err());
    }
}
