//! Records that must agree: `group`.
//!
//! Each record contributes an interval for each quantity: its value and bound. The consensus is the region contained in the most intervals (Marzullo's
//! algorithm), so correct records are never found to disagree, and a wrong record cannot shift the consensus to itself. If more than half of the records
//! share the region and no other region has as many, the records outside it are wrong; otherwise it cannot be determined which of the disagreeing records is
//! wrong. They all fail: that the records disagree is certain, so the rule is broken, and not undecidable.

use super::format::Digits;
use super::outcome::Common;
use super::outcome::{Finding, Outcome};
use super::rule::{Rule, Severity};
use alloc::format;
use alloc::vec::Vec;

/// The consensus of a group of records.
///
/// ```
/// use planar_impact::check::{Consensus, Membership, Options, Record, Rule, check};
///
/// // Three records of one sweep; the third has a digit wrong.
/// let sweep = Membership { name: "sweep".into(), agreement: Default::default() };
/// let mut outcomes: Vec<_> = [(100.0, 50.0), (90.0, 60.0), (80.0, 80.0)]
///     .map(|(n, t)| {
///         let mut record = Record { group: Some(sweep.clone()), ..Record::default() };
///         (record.reported.work_normal, record.reported.work_tangential) = (Some(-n), Some(-t));
///         check(&record, &Options::default())
///     })
///     .into();
/// Consensus::of(&outcomes).apply(&mut outcomes);
/// assert!(outcomes[0].findings.is_empty() && outcomes[1].findings.is_empty());
/// assert_eq!(outcomes[2].findings[0].rule, Rule::Group);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Consensus {
    regions: Vec<Region>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Region {
    name: &'static str,
    unit: &'static str,
    lower: f64,
    upper: f64,
    votes: usize,
    records: usize,
    /// `true` if no other region has as many votes.
    only: bool,
    /// An interval above `least_upper` or below `greatest_lower` disagrees with another.
    least_upper: f64,
    greatest_lower: f64,
}

impl Consensus {
    /// Computes the consensus of the records of one group. A quantity needs at least two records.
    pub fn of(outcomes: &[Outcome]) -> Consensus {
        let mut names: Vec<(&'static str, &'static str)> = Vec::new();
        for common in outcomes.iter().flat_map(|outcome| &outcome.common) {
            if !names.iter().any(|(name, _)| *name == common.name) {
                names.push((common.name, common.unit));
            }
        }
        let all = |name| -> Vec<&Common> { outcomes.iter().filter_map(|outcome| quantity(outcome, name)).collect() };
        let regions = names.into_iter().filter_map(|(name, unit)| Region::of(name, unit, &all(name)));
        Consensus { regions: regions.collect() }
    }

    /// Adds a finding to each record that is outside the consensus.
    pub fn apply(&self, outcomes: &mut [Outcome]) {
        for outcome in outcomes {
            for region in &self.regions {
                region.apply(outcome);
            }
        }
    }
}

fn quantity<'a>(outcome: &'a Outcome, name: &str) -> Option<&'a Common> {
    outcome.common.iter().find(|common| common.name == name)
}

impl Region {
    fn of(name: &'static str, unit: &'static str, all: &[&Common]) -> Option<Region> {
        // Ends of intervals in order, with beginnings before ends at the same value: intervals that touch share a point.
        let mut ends: Vec<(f64, bool)> = Vec::with_capacity(2 * all.len());
        for common in all.iter().filter(|common| common.value.is_finite() && common.bound.is_finite()) {
            ends.push((common.value - common.bound, false));
            ends.push((common.value + common.bound, true));
        }
        let records = ends.len() / 2;
        if records < 2 {
            return None;
        }
        ends.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let of = |is_end: bool| ends.iter().filter(move |end| end.1 == is_end).map(|end| end.0);
        let least_upper = of(true).fold(f64::INFINITY, f64::min);
        let greatest_lower = of(false).fold(f64::NEG_INFINITY, f64::max);
        let mut best = Region { name, unit, lower: 0.0, upper: 0.0, votes: 0, records, only: true, least_upper, greatest_lower };
        let mut depth = 0;
        for (i, &(at, is_end)) in ends.iter().enumerate() {
            if is_end {
                depth -= 1;
                continue;
            }
            depth += 1;
            if depth > best.votes {
                // The region extends to the next end, where an interval closes.
                let upper = ends[i + 1..].iter().find(|(_, is_end)| *is_end).map_or(at, |(to, _)| *to);
                best = Region { lower: at, upper, votes: depth, only: true, ..best };
            } else if depth == best.votes {
                best.only = false;
            }
        }
        Some(best)
    }

    fn apply(&self, outcome: &mut Outcome) {
        let Some(common) = quantity(outcome, self.name).copied() else { return };
        outcome.checked.insert(Rule::Group);
        let is_told = self.only && 2 * self.votes > self.records;
        let (middle, half) = (0.5 * (self.lower + self.upper), 0.5 * (self.upper - self.lower));
        let (lower, upper) = (common.value - common.bound, common.value + common.bound);
        let (size, bound) = if is_told {
            ((common.value - middle).abs(), common.bound + half)
        } else {
            // To the nearer end of the record that is farthest away.
            ((common.value - self.least_upper).max(self.greatest_lower - common.value), common.bound)
        };
        let agrees =
            if is_told { lower <= self.upper && self.lower <= upper } else { lower <= self.least_upper && self.greatest_lower <= upper };
        if agrees {
            return;
        }
        let (value, unit) = (Digits(common.value), self.unit);
        let rest = if is_told {
            format!("and {} of the {} records of the group agree on {} {unit}", self.votes, self.records, Digits(middle))
        } else {
            format!(
                "and the {} records of the group do not agree: no more than {} share a value, so at least one is wrong, and which one cannot be determined",
                self.records, self.votes
            )
        };
        let what = format!("the {} is {value} {unit}, {rest}: {} off, {} may be", self.name, Digits(size), Digits(bound));
        outcome.findings.push(Finding { rule: Rule::Group, severity: Severity::Fail, size, bound, what });
    }
}

#[cfg(test)]
mod tests {
    use crate::Side;
    use crate::check::*;

    /// Returns the outcomes of records that each report a loss with a resolution.
    fn outcomes(losses: &[(f64, f64)]) -> Vec<Outcome> {
        let record = |&(loss, resolution): &(f64, f64)| {
            let group = Some(Membership { name: "g".into(), agreement: Agreement::Loss });
            let mut record =
                Record { group, resolution: Resolution::default().with(ResolutionGroup::Energy, resolution), ..Record::default() };
            record.set(Key::EnergyLoss, loss);
            check(&record, &Options::default())
        };
        let mut outcomes: Vec<_> = losses.iter().map(record).collect();
        Consensus::of(&outcomes).apply(&mut outcomes);
        outcomes
    }

    fn found(losses: &[(f64, f64)]) -> Vec<usize> {
        let of_group = |outcome: &Outcome| outcome.of(Rule::Group).count();
        outcomes(losses).iter().enumerate().filter(|(_, outcome)| of_group(outcome) > 0).map(|(i, _)| i).collect()
    }

    #[test]
    fn those_outside_of_the_majority_are_found() {
        assert_eq!(found(&[(10.0, 0.5), (10.9, 0.5), (10.4, 0.5)]), []);
        assert_eq!(found(&[(10.0, 0.5), (12.0, 0.5), (10.4, 0.5)]), [1]);
        assert_eq!(found(&[(10.0, 0.5), (12.0, 0.5), (10.4, 0.5), (8.0, 0.5), (10.2, 0.1)]), [1, 3]);
        // Half of the records are no majority.
        assert_eq!(found(&[(10.0, 0.5), (10.2, 0.5), (20.0, 0.1), (30.0, 0.1)]), [0, 1, 2, 3]);
        // A coarse record agrees with everything and proves nothing.
        assert_eq!(found(&[(10.0, 100.0), (12.0, 0.5), (10.4, 0.5)]), [1, 2]);
        assert_eq!(found(&[(10.0, 0.5), (12.0, 0.5), (10.4, 0.5), (12.1, 0.5)]), [0, 1, 2, 3]);
    }

    #[test]
    fn a_finding_has_the_middle_of_what_the_others_share() {
        // 9.9 to 10.5: its middle is 10.2, and 12 is within half a unit.
        let of_one = &outcomes(&[(10.0, 0.5), (12.0, 0.5), (10.4, 0.5)])[1];
        let finding = of_one.of(Rule::Group).next().expect("a finding");
        assert!((finding.size - 1.8).abs() < 1e-12 && (finding.bound - 0.8).abs() < 1e-12, "{finding:?}");
        assert!(finding.what.contains("2 of the 3 records of the group agree on 10.2 J"), "{}", finding.what);
    }

    #[test]
    fn without_a_majority_the_distance_is_to_the_farthest_record() {
        let all = outcomes(&[(100.0, 0.5), (120.0, 0.5)]);
        for (outcome, size) in all.iter().zip([19.5, 19.5]) {
            let finding = outcome.of(Rule::Group).next().expect("a finding");
            assert!(
                (finding.size - size).abs() < 1e-9 && (finding.bound - 0.5).abs() < 1e-9 && finding.what.contains("19.5 off"),
                "{finding:?}"
            );
        }
    }

    #[test]
    fn intervals_that_touch_agree() {
        assert_eq!(found(&[(10.0, 0.5), (11.0, 0.5)]), []);
        assert_eq!(found(&[(10.0, 0.5), (10.5, 0.5), (11.0, 0.5)]), []);
    }

    #[test]
    fn of_two_that_disagree_neither_is_right() {
        let both = outcomes(&[(10.0, 0.1), (12.0, 0.1)]);
        for outcome in &both {
            assert_eq!(outcome.verdict(), Verdict::Fail);
            assert!(outcome.findings[0].what.contains("at least one is wrong, and which one cannot be determined"), "{outcome}");
            assert_eq!((outcome.findings[0].severity, outcome.findings.len()), (Severity::Fail, 1));
        }
    }

    /// What a yaw rate may be off is of the order of the turn in the impact, whatever it was before.
    #[test]
    fn a_yaw_rate_that_differs_is_found() {
        for before in [0.0, 1.9] {
            let mut outcomes = [2.0, 2.0, 2.5].map(|after| {
                let group = Some(Membership { name: "g".into(), agreement: Agreement::Outcome });
                let mut record = Record { group, ..Record::default() };
                record.set(Key::BeforeYawRate(Side::One), before);
                record.set(Key::AfterYawRate(Side::One), after);
                check(&record, &Options::default())
            });
            Consensus::of(&outcomes).apply(&mut outcomes);
            assert_eq!(outcomes.map(|outcome| outcome.of(Rule::Group).count()), [0, 0, 1], "{before}");
        }
    }

    #[test]
    fn one_alone_agrees_with_nobody() {
        let alone = outcomes(&[(10.0, 0.1)]);
        assert!(alone[0].findings.is_empty() && !alone[0].has_checked(Rule::Group));
    }
}
