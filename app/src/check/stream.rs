//! Checks records in sequence, and compares each with earlier records of the same id or group.
//!
//! Memory is bounded. The last 65 536 ids, and names of finished groups, are remembered by hash. A group is a run of
//! records with the same group name; its first 4096 records are held back until the group ends and define a
//! consensus, with which the following records are compared.

use std::collections::{HashSet, VecDeque};
use std::hash::{BuildHasher, BuildHasherDefault, DefaultHasher};

use planar_impact::check::{Consensus, Options, Outcome, Severity, check};

use super::complaint::Unreadable;
use super::draft::Drafted;
use super::entry::{Entry, Found};

/// Maximum number of records of a group that are held back.
const MOST_HELD: usize = 4096;
/// Number of names that are remembered.
const REMEMBERED: usize = 1 << 16;

/// The most recent names, stored as hashes: the probability that two names in a million records are confused is 1 in 10⁸.
#[derive(Default)]
struct Recent {
    known: HashSet<u64>,
    order: VecDeque<u64>,
}

impl Recent {
    fn hash(name: &str) -> u64 {
        BuildHasherDefault::<DefaultHasher>::default().hash_one(name)
    }

    fn has(&self, name: &str) -> bool {
        self.known.contains(&Recent::hash(name))
    }

    /// Remembers a name. Returns `false` if it was already known.
    fn insert(&mut self, name: &str) -> bool {
        let hash = Recent::hash(name);
        if !self.known.insert(hash) {
            return false;
        }
        self.order.push_back(hash);
        if self.order.len() > REMEMBERED
            && let Some(oldest) = self.order.pop_front()
        {
            self.known.remove(&oldest);
        }
        true
    }
}

/// A record that is held back until its group ends.
enum Held {
    Checked { line: u64, notes: Vec<Found> },
    Unreadable(Entry),
}

/// The current group.
#[derive(Default)]
struct Run {
    name: String,
    held: Vec<Held>,
    /// Outcomes of the checked records in `held`, in order.
    outcomes: Vec<Outcome>,
    /// Set once the group exceeds the number of records held back.
    consensus: Option<Consensus>,
}

/// Checks a sequence of records.
pub struct Stream {
    options: Options,
    ids: Recent,
    groups: Recent,
    run: Option<Run>,
}

impl Stream {
    pub fn new(options: Options) -> Stream {
        Stream { options, ids: Recent::default(), groups: Recent::default(), run: None }
    }

    /// Checks the next record of a file.
    pub fn take(&mut self, line: u64, read: Result<Drafted, Unreadable>, to: &mut VecDeque<Entry>) {
        let Drafted { mut record, rounding } = match read {
            Ok(drafted) => drafted,
            Err((id, complaints)) => {
                // An unreadable record may be in the middle of a group.
                let entry = Entry::unreadable(id, &complaints, line);
                return match &mut self.run {
                    Some(run) if run.held.len() < MOST_HELD && run.consensus.is_none() => {
                        run.held.push(Held::Unreadable(entry));
                    }
                    _ => {
                        self.freeze(to);
                        to.push_back(entry);
                    }
                };
            }
        };
        let mut notes = Vec::new();
        if !self.ids.insert(&record.id) {
            notes.push(Found::malformed(format!("an earlier record has the id `{}` too", record.id)));
        }
        let group = record.group.as_mut().map(|group| std::mem::take(&mut group.name));
        let mut outcome = check(&record, &self.options);
        rounding.explain(&record, &mut outcome, &self.options);
        let Some(name) = group else {
            self.finish(to);
            return to.push_back(Entry::of(outcome, line, notes));
        };
        if self.run.as_ref().is_none_or(|run| run.name != name) {
            self.finish(to);
            if self.groups.has(&name) {
                let what = format!(
                    "the group `{name}` has ended on an earlier line: a group is a run of records with one name, and these are not held against those"
                );
                notes.push(Found { rule: "group", severity: Severity::Warn, size: None, bound: None, what });
            }
            self.run = Some(Run { name, ..Run::default() });
        }
        if self.run.as_ref().is_some_and(|run| run.consensus.is_none() && run.held.len() >= MOST_HELD) {
            self.freeze(to);
        }
        let Some(run) = &mut self.run else { return };
        match &run.consensus {
            None => {
                run.held.push(Held::Checked { line, notes });
                run.outcomes.push(outcome);
            }
            Some(consensus) => {
                let mut outcome = [outcome];
                consensus.apply(&mut outcome);
                let [outcome] = outcome;
                to.push_back(Entry::of(outcome, line, notes));
            }
        }
    }

    /// Ends the current group.
    pub fn finish(&mut self, to: &mut VecDeque<Entry>) {
        self.freeze(to);
        if let Some(run) = self.run.take() {
            self.groups.insert(&run.name);
        }
    }

    /// Compares the records held back with each other and releases them; later records of the group are compared with their consensus.
    fn freeze(&mut self, to: &mut VecDeque<Entry>) {
        let Some(run) = &mut self.run else { return };
        if run.consensus.is_none() {
            let consensus = Consensus::of(&run.outcomes);
            consensus.apply(&mut run.outcomes);
            run.consensus = Some(consensus);
        }
        let mut outcomes = std::mem::take(&mut run.outcomes).into_iter();
        for held in std::mem::take(&mut run.held) {
            match held {
                Held::Unreadable(entry) => to.push_back(entry),
                Held::Checked { line, notes } => to.extend(outcomes.next().map(|outcome| Entry::of(outcome, line, notes))),
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use planar_impact::check::{Agreement, Key, Membership, Record, Verdict};

    fn record(id: usize, group: Option<&str>, loss: f64) -> Record {
        let group = group.map(|name| Membership { name: name.to_owned(), agreement: Agreement::Loss });
        let mut record = Record { id: format!("{id}"), group, ..Record::default() };
        record.set(Key::EnergyLoss, loss);
        record
    }

    fn drafted(record: Record) -> Drafted {
        Drafted { record, ..Drafted::default() }
    }

    fn verdicts(records: impl IntoIterator<Item = Record>) -> Vec<(u64, Verdict)> {
        let mut stream = Stream::new(Options::default());
        let mut found = VecDeque::new();
        for (line, record) in (1..).zip(records) {
            stream.take(line, Ok(drafted(record)), &mut found);
        }
        stream.finish(&mut found);
        found.into_iter().map(|entry| (entry.line, entry.verdict)).collect()
    }

    #[test]
    fn an_id_that_comes_back_is_found() {
        let found = verdicts([1, 2, 1, 3].map(|id| record(id, None, 1.0)));
        assert_eq!(
            found.iter().map(|(_, verdict)| *verdict).collect::<Vec<_>>(),
            [Verdict::Pass, Verdict::Pass, Verdict::Fail, Verdict::Pass]
        );
    }

    #[test]
    fn names_are_forgotten_in_time() {
        let mut recent = Recent::default();
        for id in 0..REMEMBERED + 10 {
            assert!(recent.insert(&id.to_string()));
        }
        assert!(recent.has(&(REMEMBERED + 9).to_string()) && recent.has("10") && !recent.has("9"));
        assert!((recent.known.len(), recent.order.len()) == (REMEMBERED, REMEMBERED));
    }

    #[test]
    fn groups_stay_in_order_and_one_that_comes_back_is_noticed() {
        let losses = [(Some("a"), 1.0), (Some("a"), 1.0), (Some("a"), 2.0), (None, 7.0), (Some("b"), 3.0), (Some("a"), 2.0)];
        let found = verdicts(losses.iter().enumerate().map(|(id, (group, loss))| record(id, *group, *loss)));
        let expected = [Verdict::Pass, Verdict::Pass, Verdict::Fail, Verdict::Pass, Verdict::Pass, Verdict::Warn];
        assert_eq!(found, (1..).zip(expected).collect::<Vec<_>>());
    }

    #[test]
    fn a_long_group_is_held_against_its_beginning() {
        let last = MOST_HELD + 10;
        let losses = (0..=last).map(|id| record(id, Some("long"), if id == last { 2.0 } else { 1.0 }));
        let found = verdicts(losses);
        assert_eq!(found.len(), last + 1);
        assert!(found.iter().zip(1..).all(|((line, _), expected)| *line == expected), "in order");
        assert!(found[..last].iter().all(|(_, verdict)| *verdict == Verdict::Pass));
        assert_eq!(found[last].1, Verdict::Fail);
    }

    #[test]
    fn what_cannot_be_read_does_not_end_a_group() {
        let mut stream = Stream::new(Options::default());
        let mut found = VecDeque::new();
        let unreadable = || Err((String::new(), super::super::complaint::refused("x").1));
        let ok = |id, loss| Ok(drafted(record(id, Some("a"), loss)));
        let all = [ok(1, 1.0), unreadable(), ok(2, 1.0), ok(3, 9.0), unreadable()];
        for (line, record) in (1..).zip(all) {
            stream.take(line, record, &mut found);
        }
        stream.finish(&mut found);
        let found: Vec<_> = found.into_iter().map(|entry| (entry.line, entry.verdict)).collect();
        assert_eq!(found, (1..).zip([Verdict::Pass, Verdict::Fail, Verdict::Pass, Verdict::Fail, Verdict::Fail]).collect::<Vec<_>>());
    }
}
