//! The rounding that the digits of a record show.

use planar_impact::check::{Options, Outcome, Profile, Record, Resolution, ResolutionGroup, Severity, Verdict, check};

/// The most decimals of a number that may have been rounded for print.
const MOST_DECIMALS: usize = 6;
const POWERS: [f64; MOST_DECIMALS + 1] = [1.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6];

/// Half a unit of the last digit of each group, in SI, as if each of its numbers had as many decimals as the longest; the finest of its units counts.
/// Infinite if no digit shows it, and zero if a number has too many for print.
#[derive(Debug)]
pub struct Rounding([f64; ResolutionGroup::COUNT]);

impl Default for Rounding {
    fn default() -> Rounding {
        Rounding([f64::INFINITY; ResolutionGroup::COUNT])
    }
}

impl Rounding {
    /// Sees a number as it is written, in units of `size`.
    pub fn see(&mut self, group: ResolutionGroup, written: f64, size: f64) {
        let half_unit = match decimals(written) {
            None => 0.0,
            // Sums are rounded to whole units; other whole numbers are taken as given.
            Some(0) if !matches!(group, ResolutionGroup::Energy | ResolutionGroup::Impulse | ResolutionGroup::MomentImpulse) => {
                f64::INFINITY
            }
            Some(decimals) => 0.5 * size / POWERS[decimals],
        };
        let known = &mut self.0[group as usize];
        *known = known.min(half_unit);
    }

    /// Returns the resolution of the digits. Masses, lengths and what else is given are rounded only in a record whose velocities are.
    fn resolution(&self) -> Resolution {
        let shows = |group: ResolutionGroup| self.0[group as usize] > 0.0 && self.0[group as usize].is_finite();
        let is_result = |group: &ResolutionGroup| {
            use ResolutionGroup::{Energy, Impulse, MomentImpulse, Velocity, YawRate};
            matches!(group, Velocity | YawRate | Energy | Impulse | MomentImpulse)
        };
        let rounded =
            ResolutionGroup::ALL.into_iter().filter(|group| shows(*group) && (is_result(group) || shows(ResolutionGroup::Velocity)));
        rounded.fold(Resolution::default(), |all, group| all.with(group, self.0[group as usize]))
    }

    /// Adds to the first broken rule of a record without resolutions that rounding explains all of them, if it does.
    pub fn explain(&self, record: &Record, outcome: &mut Outcome, options: &Options) {
        let Some(broken) = outcome.findings.iter_mut().find(|finding| finding.severity == Severity::Fail) else { return };
        let resolution = self.resolution();
        if !record.resolution.is_empty() || resolution.is_empty() {
            return;
        }
        let printed = Record { profile: Profile::Printed, resolution, ..record.clone() };
        if matches!(check(&printed, options).verdict(), Verdict::Pass | Verdict::Warn) {
            broken.what.push_str(
                "; if the numbers of this record are rounded to the digits they have, it breaks no rule: give it the profile `printed` and a `resolution`",
            );
        }
    }
}

/// Returns the number of decimals; `None` if there are more than a printed number has.
fn decimals(written: f64) -> Option<usize> {
    let has_no_more = |decimals: &usize| (written * POWERS[*decimals]).round() / POWERS[*decimals] == written;
    // Numbers of full precision are most of those that are read.
    if has_no_more(&MOST_DECIMALS) { (0..=MOST_DECIMALS).find(has_no_more) } else { None }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_decimals_of_a_number_are_those_that_are_written() {
        let expected = [
            ("0", Some(0)),
            ("1200", Some(0)),
            ("-0.1", Some(1)),
            ("3.42", Some(2)),
            ("-17.305", Some(3)),
            ("0.123456", Some(6)),
            ("0.1234567", None),
            ("1e-7", None),
            ("1e300", Some(0)),
            ("nan", None),
        ];
        for (written, count) in expected {
            assert_eq!(decimals(written.parse().expect("a number")), count, "{written}");
        }
    }

    #[test]
    fn a_group_is_rounded_to_the_decimals_of_its_longest_number() {
        use ResolutionGroup::{Energy, Length, Mass, Velocity, YawRate};
        let seen = |numbers: &[(ResolutionGroup, f64, f64)]| {
            let mut rounding = Rounding::default();
            for (group, written, size) in numbers {
                rounding.see(*group, *written, *size);
            }
            rounding.resolution()
        };
        let expected = Resolution::default().with(Length, 0.05).with(Velocity, 0.0005).with(Energy, 500.0);
        let all = [(Velocity, 10.0, 0.1), (Velocity, 3.42, 0.1), (Energy, 12.0, 1e3), (Mass, 1200.0, 1.0), (Length, 1.5, 1.0)];
        assert_eq!(seen(&all), expected);
        // A yaw rate of full precision, then velocities of full precision: what is given is no longer taken as rounded.
        assert_eq!(seen(&[&all[..], &[(YawRate, 1.0 / 3.0, 1.0), (YawRate, 0.5, 1.0)]].concat()), expected);
        assert_eq!(seen(&[&all[..], &[(Velocity, 1.0 / 3.0, 1.0)]].concat()), Resolution::default().with(Energy, 500.0));
        assert!(seen(&[(Velocity, 10.0, 1.0), (Mass, 1200.0, 1.0)]).is_empty());
    }
}
