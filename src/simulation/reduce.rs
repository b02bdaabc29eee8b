//! Summaries of samples that are solved chunk by chunk, the same for any number of threads.

use alloc::collections::BTreeMap;
use alloc::vec::Vec;
use core::fmt;
use core::ops::Range;

use super::summary::{Reduce, Samples};
use crate::batch::Batch;
use crate::output::Output;

/// Samples that are solved together: few enough that their numbers stay in the second cache.
const CHUNK: u64 = 1920;

/// Samples that are summarized on one thread before summaries are merged.
const STRETCH: u64 = 32 * CHUNK;

/// The answer of a simulation.
#[derive(Clone, Debug, PartialEq)]
pub struct Reduced<R> {
    /// Number of samples drawn: fewer than asked for if the simulation was stopped.
    pub samples: u64,
    /// The samples that physics refuses, which are not in the summary.
    pub refused: RefusedSamples,
    /// The summary of the others.
    pub summary: R,
}

/// Samples that [`Collision::solve`](crate::Collision::solve) refuses.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct RefusedSamples {
    /// Their number.
    pub samples: u64,
    /// How many have each code; a sample may have several.
    pub by_code: BTreeMap<&'static str, u64>,
}

/// Samples by their numbers, with the outputs of each.
pub(crate) trait Source: Sync {
    /// The name of an output.
    type Output: Copy + PartialEq + fmt::Debug + Sync;

    /// Returns how many samples belong together: they are solved and summarized at once, and their numbers begin at a multiple of it.
    fn together(&self) -> u64 {
        1
    }

    /// Solves some samples.
    fn solve(&self, samples: Range<u64>, of: &[Self::Output]) -> SolvedSamples;
}

/// Samples that are solved.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SolvedSamples {
    /// The outputs, a column of all samples for each.
    pub columns: Vec<Vec<f64>>,
    /// The samples that are refused, in order, each with the codes of why.
    pub refused: Vec<(usize, Vec<&'static str>)>,
}

impl SolvedSamples {
    /// Solves the rows of a batch.
    pub(crate) fn of(batch: &Batch<'_>, of: &[Output]) -> Self {
        let solved = batch.solve(of);
        let refused = solved.refused.iter().map(|row| (row.row, row.refusals.iter().map(|refusal| refusal.code()).collect()));
        SolvedSamples { refused: refused.collect(), columns: solved.columns.into_columns() }
    }
}

/// Summarizes samples of a source as [`Simulation::reduce`](super::Simulation::reduce) does.
pub(crate) fn reduce<S: Source, R: Reduce<S::Output>>(
    source: &S,
    samples: u64,
    empty: R,
    goes_on: &(dyn Fn(u64) -> bool + Sync),
) -> Reduced<R> {
    let mut of: Vec<S::Output> = Vec::new();
    for output in empty.outputs() {
        if !of.contains(&output) {
            of.push(output);
        }
    }
    let answer = Reduced { samples: 0, refused: RefusedSamples::default(), summary: empty.clone() };
    let together = source.together().max(1);
    let chunk = (CHUNK / together).max(1) * together;
    let size = STRETCH / CHUNK * chunk;
    let range = |i: u64| i * size..((i + 1).saturating_mul(size)).min(samples);
    in_order(samples.div_ceil(size), answer, |i| stretch(source, &of, chunk, range(i), empty.clone()), goes_on)
}

/// Summarizes some samples on this thread, a chunk after the other.
fn stretch<S: Source, R: Reduce<S::Output>>(source: &S, of: &[S::Output], chunk: u64, samples: Range<u64>, empty: R) -> Reduced<R> {
    let mut answer = Reduced { samples: samples.end - samples.start, refused: RefusedSamples::default(), summary: empty };
    let mut first = samples.start;
    while first < samples.end {
        let end = (first + chunk).min(samples.end);
        let SolvedSamples { mut columns, refused } = source.solve(first..end, of);
        let places = (!refused.is_empty()).then(|| {
            answer.refused.add(&refused);
            let mut refused = refused.iter().map(|(place, _)| *place as u64).peekable();
            let places: Vec<u64> = (0..end - first).filter(|place| refused.next_if_eq(place).is_none()).collect();
            for column in &mut columns {
                *column = places.iter().map(|place| column[*place as usize]).collect();
            }
            places
        });
        answer.summary.take(&Samples { of, columns: &columns, first, places: places.as_deref() });
        first = end;
    }
    answer
}

impl RefusedSamples {
    fn add(&mut self, samples: &[(usize, Vec<&'static str>)]) {
        self.samples += samples.len() as u64;
        for (_, codes) in samples {
            let mut codes = codes.clone();
            codes.sort_unstable();
            codes.dedup();
            codes.into_iter().for_each(|code| *self.by_code.entry(code).or_default() += 1);
        }
    }

    pub(crate) fn merge(&mut self, later: &RefusedSamples) {
        self.samples += later.samples;
        later.by_code.iter().for_each(|(code, count)| *self.by_code.entry(code).or_default() += count);
    }
}

impl<R> Reduced<R> {
    fn merge<K>(&mut self, later: Self)
    where
        R: Reduce<K>,
    {
        self.samples += later.samples;
        self.refused.merge(&later.refused);
        self.summary.merge(later.summary);
    }
}

/// Merges the answers of stretches in their order, each computed on a thread of the pool.
#[cfg(feature = "rayon")]
fn in_order<K, R: Reduce<K>>(
    stretches: u64,
    mut answer: Reduced<R>,
    stretch: impl Fn(u64) -> Reduced<R> + Sync,
    goes_on: &(dyn Fn(u64) -> bool + Sync),
) -> Reduced<R> {
    use core::sync::atomic::{AtomicBool, AtomicU64, Ordering};
    use rayon::prelude::*;

    /// So many that threads seldom wait for the last, and few enough that memory stays small.
    const STRETCHES_A_THREAD: u64 = 8;
    let (done, is_stopped) = (AtomicU64::new(0), AtomicBool::new(false));
    let wave = STRETCHES_A_THREAD * rayon::current_num_threads() as u64;
    for start in (0..stretches).step_by(wave as usize) {
        let one = |i: u64| {
            if is_stopped.load(Ordering::Relaxed) || !goes_on(done.load(Ordering::Relaxed)) {
                is_stopped.store(true, Ordering::Relaxed);
                return None;
            }
            let part = stretch(i);
            done.fetch_add(part.samples, Ordering::Relaxed);
            Some(part)
        };
        let parts: Vec<Option<Reduced<R>>> = (start..(start + wave).min(stretches)).into_par_iter().map(one).collect();
        let is_whole = parts.iter().all(Option::is_some);
        // Those after a gap would not be the samples before.
        parts.into_iter().map_while(|part| part).for_each(|part| answer.merge(part));
        if !is_whole {
            break;
        }
    }
    answer
}

/// Merges the answers of stretches in their order.
#[cfg(not(feature = "rayon"))]
fn in_order<K, R: Reduce<K>>(
    stretches: u64,
    mut answer: Reduced<R>,
    stretch: impl Fn(u64) -> Reduced<R>,
    goes_on: &(dyn Fn(u64) -> bool + Sync),
) -> Reduced<R> {
    for i in 0..stretches {
        if !goes_on(answer.samples) {
            break;
        }
        answer.merge(stretch(i));
    }
    answer
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Mutex;

    /// Records the ranges that are solved at once.
    struct Recording {
        together: u64,
        seen: Mutex<Vec<Range<u64>>>,
    }

    impl Source for Recording {
        type Output = ();

        fn together(&self) -> u64 {
            self.together
        }

        fn solve(&self, samples: Range<u64>, of: &[()]) -> SolvedSamples {
            self.seen.lock().expect("no panic").push(samples.clone());
            let rows = (samples.end - samples.start) as usize;
            SolvedSamples { columns: of.iter().map(|()| vec![1.0; rows]).collect(), refused: Vec::new() }
        }
    }

    #[derive(Clone)]
    struct Sum(f64);

    impl Reduce<()> for Sum {
        fn outputs(&self) -> Vec<()> {
            vec![()]
        }

        fn take(&mut self, samples: &Samples<'_, ()>) {
            self.0 += samples.column(()).iter().sum::<f64>();
        }

        fn merge(&mut self, later: Self) {
            self.0 += later.0;
        }
    }

    #[test]
    fn samples_that_belong_together_are_solved_at_once_and_few_of_them() {
        for together in [1, 7, 1000, CHUNK + 1] {
            let source = Recording { together, seen: Mutex::default() };
            let samples = together * (3 * CHUNK / together + 2);
            let reduced = reduce(&source, samples, Sum(0.0), &|_| true);
            assert_eq!((reduced.samples, reduced.summary.0), (samples, samples as f64));
            let mut seen = source.seen.into_inner().expect("no panic");
            seen.sort_by_key(|range| range.start);
            assert!(seen.windows(2).all(|pair| pair[0].end == pair[1].start) && seen.len() > 1);
            for range in seen {
                assert!(range.start % together == 0 && range.end - range.start <= CHUNK.max(together), "{together}: {range:?}");
            }
        }
    }
}
