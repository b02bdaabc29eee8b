//! The numbers that each rule needs, and the rules that a record calls for.

use super::key::Key;
use super::model::RatioKind;
use super::record::Record;
use super::rule::{Rule, Rules};
use crate::input::Side;
use alloc::vec::Vec;

/// What an outcome remembers of its record: its numbers, its fixed bodies, and the rules that it calls for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Coverage {
    /// One bit for each number of the record.
    numbers: u64,
    fixed: [bool; 2],
    /// `true` if sliding has ended at the stated ratio, which then needs no number.
    is_critical: bool,
    called_for: Rules,
}

impl Coverage {
    pub(super) fn of(record: &Record) -> Self {
        let present = Key::ALL.into_iter().filter(|key| record.get(*key).is_some());
        let numbers = present.fold(0, |numbers, key| numbers | 1 << key.index());
        let mut called_for = Rules::default();
        Rule::ALL.into_iter().filter(|rule| calls_for(record, *rule)).for_each(|rule| called_for.insert(rule));
        let is_critical = record.model.ratio_kind == RatioKind::Critical;
        Coverage { numbers, fixed: Side::ALL.map(|side| record.subject(side).fixed), is_critical, called_for }
    }

    fn has(&self, key: Key) -> bool {
        self.numbers & (1 << key.index()) != 0
    }

    /// Returns the rules that the record calls for.
    pub(super) fn called_for(&self) -> impl Iterator<Item = Rule> {
        let rules = self.called_for;
        Rule::ALL.into_iter().filter(move |rule| rules.contains(*rule))
    }

    /// Returns the numbers that a rule needs and the record lacks.
    pub(super) fn missing(&self, rule: Rule) -> Vec<Key> {
        let free = Side::ALL.into_iter().filter(|side| !self.fixed[*side as usize]);
        let of_bodies = free.flat_map(|side| of_each_body(rule).iter().map(move |key| key(side)));
        let of_pair = of_pair(rule).iter().copied().filter(|key| !(self.is_critical && *key == Key::ImpulseRatio));
        of_bodies.chain(of_pair).filter(|key| !self.has(*key)).collect()
    }
}

/// Returns `true` if a record calls for a rule: every law of two bodies in the plane, the ratio that its model states, its claims, and its group. A fixed
/// body absorbs any momentum.
fn calls_for(record: &Record, rule: Rule) -> bool {
    let model = &record.model;
    match rule {
        Rule::LinearMomentum | Rule::AngularMomentum => !record.one.fixed && !record.two.fixed,
        Rule::ImpulseRatio => model.impulse_ratio.is_some() || model.ratio_kind != RatioKind::Given,
        Rule::Reported => Key::ALL.into_iter().any(|key| key.is_claim() && record.get(key).is_some()),
        Rule::Group => record.group.is_some(),
        _ => true,
    }
}

const VELOCITIES: [fn(Side) -> Key; 5] = [Key::Mass, Key::BeforeX, Key::BeforeY, Key::AfterX, Key::AfterY];
const MOTIONS: [fn(Side) -> Key; 8] =
    [Key::Mass, Key::YawInertia, Key::BeforeX, Key::BeforeY, Key::BeforeYawRate, Key::AfterX, Key::AfterY, Key::AfterYawRate];
const PLACED_MOTIONS: [fn(Side) -> Key; 10] = [
    Key::Mass,
    Key::YawInertia,
    Key::CenterX,
    Key::CenterY,
    Key::BeforeX,
    Key::BeforeY,
    Key::BeforeYawRate,
    Key::AfterX,
    Key::AfterY,
    Key::AfterYawRate,
];

/// Returns the numbers of each free body that a rule needs.
fn of_each_body(rule: Rule) -> &'static [fn(Side) -> Key] {
    match rule {
        Rule::Finite | Rule::PlausibleUnits | Rule::Reported | Rule::Group => &[],
        Rule::LinearMomentum => &VELOCITIES,
        Rule::EnergyGain => &MOTIONS,
        _ => &PLACED_MOTIONS,
    }
}

/// Returns the numbers of the pair that a rule needs.
fn of_pair(rule: Rule) -> &'static [Key] {
    match rule {
        Rule::LineOfAction => &[Key::PointX, Key::PointY],
        Rule::ImpulseRatio => &[Key::PointX, Key::PointY, Key::NormalAngle, Key::ImpulseRatio],
        Rule::Compressive | Rule::Interpenetration | Rule::Restitution | Rule::BeyondCritical | Rule::WorkIdentity => {
            &[Key::PointX, Key::PointY, Key::NormalAngle]
        }
        _ => &[],
    }
}
