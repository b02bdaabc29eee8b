//! Records in a row: each is checked, and held against those before it with the same id or the same group.
//!
//! Memory is bounded. Of ids, and of the names of groups that have ended, the last 65 536 are remembered, by hashes. A group is a run of records with one
//! group name; its first 4096 records are held back until it ends and agree on a consensus, and those behind them are held against that.

use std::collections::{HashSet, VecDeque};
use std::hash::{BuildHasher, BuildHasherDefault, DefaultHasher};
use std::io;

use planar_impact::check::{Consensus, Options, Outcome, Record, Severity, check};

use super::entry::{Entry, Found};
use super::json::Unreadable;

/// The most records of a group that are held back.
const MOST_HELD: usize = 4096;
/// How many names are remembered.
const REMEMBERED: usize = 1 << 16;

/// What is done with each record that was checked.
pub type Emit<'a> = &'a mut dyn FnMut(Entry) -> io::Result<()>;

/// The last names, by their hashes: two names in a million records are mistaken for one with a probability of 1 in 10⁸.
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

    /// Remembers a name. False if it was known.
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

/// The group at hand.
#[derive(Default)]
struct Run {
    name: String,
    held: Vec<Held>,
    /// Those of the records in `held` that were checked, in order.
    outcomes: Vec<Outcome>,
    /// Once there are more than are held back.
    consensus: Option<Consensus>,
}

/// Checks records one after the other.
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

    /// Takes the next record of a file.
    ///
    /// # Errors
    ///
    /// When the emitter fails.
    pub fn take(&mut self, line: u64, record: Result<Record, Unreadable>, emit: Emit<'_>) -> io::Result<()> {
        let mut record = match record {
            Ok(record) => record,
            Err((id, complaints)) => {
                // It may stand in the middle of a group.
                let entry = Entry::unreadable(id, &complaints, line);
                return match &mut self.run {
                    Some(run) if run.held.len() < MOST_HELD && run.consensus.is_none() => {
                        run.held.push(Held::Unreadable(entry));
                        Ok(())
                    }
                    Some(_) => self.freeze(emit).and_then(|()| emit(entry)),
                    None => emit(entry),
                };
            }
        };
        let mut notes = Vec::new();
        if !self.ids.insert(&record.id) {
            notes.push(Found::malformed(format!("an earlier record has the id `{}` too", record.id)));
        }
        let group = record.group.as_mut().map(|group| std::mem::take(&mut group.name));
        let Some(name) = group else {
            self.finish(emit)?;
            return emit(Entry::of(check(&record, &self.options), line, notes));
        };
        if self.run.as_ref().is_none_or(|run| run.name != name) {
            self.finish(emit)?;
            if self.groups.has(&name) {
                let what = format!(
                    "the group `{name}` has ended on an earlier line: a group is a run of records with one name, and these are not held against those"
                );
                notes.push(Found { rule: "group", severity: Severity::Warn, size: None, bound: None, what });
            }
            self.run = Some(Run { name, ..Run::default() });
        }
        let outcome = check(&record, &self.options);
        if self.run.as_ref().is_some_and(|run| run.consensus.is_none() && run.held.len() >= MOST_HELD) {
            self.freeze(emit)?;
        }
        let Some(run) = &mut self.run else { return Ok(()) };
        match &run.consensus {
            None => {
                run.held.push(Held::Checked { line, notes });
                run.outcomes.push(outcome);
                Ok(())
            }
            Some(consensus) => {
                let mut outcome = [outcome];
                consensus.apply(&mut outcome);
                let [outcome] = outcome;
                emit(Entry::of(outcome, line, notes))
            }
        }
    }

    /// Ends the group at hand.
    ///
    /// # Errors
    ///
    /// When the emitter fails.
    pub fn finish(&mut self, emit: Emit<'_>) -> io::Result<()> {
        self.freeze(emit)?;
        if let Some(run) = self.run.take() {
            self.groups.insert(&run.name);
        }
        Ok(())
    }

    /// Lets go of the records that are held back, held against each other; those of the group behind them are held against these.
    fn freeze(&mut self, emit: Emit<'_>) -> io::Result<()> {
        let Some(run) = &mut self.run else { return Ok(()) };
        if run.consensus.is_none() {
            let consensus = Consensus::of(&run.outcomes);
            consensus.apply(&mut run.outcomes);
            run.consensus = Some(consensus);
        }
        let mut outcomes = std::mem::take(&mut run.outcomes).into_iter();
        for held in std::mem::take(&mut run.held) {
            match held {
                Held::Unreadable(entry) => emit(entry)?,
                Held::Checked { line, notes } => outcomes.next().map_or(Ok(()), |outcome| emit(Entry::of(outcome, line, notes)))?,
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use planar_impact::check::{Agreement, Key, Membership, Verdict};

    fn record(id: usize, group: Option<&str>, loss: f64) -> Record {
        let group = group.map(|name| Membership { name: name.to_owned(), agreement: Agreement::Loss });
        let mut record = Record { id: format!("{id}"), group, ..Record::default() };
        record.set(Key::EnergyLoss, loss);
        record
    }

    fn verdicts(records: impl IntoIterator<Item = Record>) -> Vec<(u64, Verdict)> {
        let mut stream = Stream::new(Options::default());
        let mut found = Vec::new();
        let mut emit = |entry: Entry| {
            found.push((entry.line, entry.verdict));
            Ok(())
        };
        for (line, record) in (1..).zip(records) {
            stream.take(line, Ok(record), &mut emit).unwrap();
        }
        stream.finish(&mut emit).unwrap();
        found
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
        let mut found = Vec::new();
        let mut emit = |entry: Entry| {
            found.push((entry.line, entry.verdict));
            Ok(())
        };
        let unreadable = || Err((String::new(), super::super::csv::refused("x").1));
        let all = [Ok(record(1, Some("a"), 1.0)), unreadable(), Ok(record(2, Some("a"), 1.0)), Ok(record(3, Some("a"), 9.0)), unreadable()];
        for (line, record) in (1..).zip(all) {
            stream.take(line, record, &mut emit).unwrap();
        }
        stream.finish(&mut emit).unwrap();
        assert_eq!(found, (1..).zip([Verdict::Pass, Verdict::Fail, Verdict::Pass, Verdict::Fail, Verdict::Fail]).collect::<Vec<_>>());
    }
}
