//! Simulations: collisions that are drawn, solved and summarized in cache, and never stored.
//!
//! A [`Simulation`] has a collision and the [`Distribution`] of each input that is uncertain. [`Simulation::reduce`] draws samples, solves them in
//! [batches](crate::batch) and gives their outputs to summaries: [`Moments`], [`Quantiles`], [`Extremes`], [`Histogram`], [`Exceedance`], several of them as a
//! tuple, or one of your own ([`Reduce`]). A sample that physics refuses is counted by reason.
//!
//! ```
//! use planar_impact::simulation::{Exceedance, Moments, Quantiles, Simulation};
//! use planar_impact::*;
//! let car = Vehicle::new(1500.0, 2500.0).with_impact_center(2.0, 0.3).with_speed(15.0);
//! let collision = Collision::new(car, Party::Barrier).with_restitution(0.1);
//! let simulation = Simulation::of(collision.clone())
//!     .with(Input::VelocityX(Side::One), Distribution::Normal { mean: 15.0, sd: 1.0 })?
//!     .with(Input::Restitution, Distribution::Uniform { min: 0.0, max: 0.2 })?;
//! let delta_v = Output::DeltaVMagnitude(Side::One);
//! let nominal = collision.solve()?.one.delta_v_magnitude();
//! let empty = (Moments::of(&[delta_v]), Quantiles::of(&[delta_v]), Exceedance::of(delta_v, nominal));
//! let answer = simulation.reduce(100_000, empty, &|_| true);
//! let (moments, quantiles, above) = answer.summary;
//! assert_eq!(answer.refused.samples, 0);
//! assert!((moments.mean(delta_v) - nominal).abs() < 5.0 * moments.standard_error(delta_v));
//! assert!((quantiles.quantile(delta_v, 0.5) / nominal - 1.0).abs() < 0.01);
//! assert!((above.share() - 0.5).abs() < 0.01);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # The same bits
//!
//! The numbers of a sample depend on the seed, its own number and the input alone: another uncertain input, a longer run or another number of threads leave
//! them as they are. Summaries are merged in the order of the samples. So the answer has the same bits for any number of threads (feature `rayon`: those of the
//! pool in which `reduce` is called) and any vector instructions.

mod exceedance;
mod extremes;
pub(crate) mod fill;
mod histogram;
mod moments;
pub(crate) mod quantiles;

pub use exceedance::Exceedance;
pub use extremes::{Extreme, Extremes};
pub use fill::{Draws, Fill};
pub use histogram::Histogram;
pub use moments::Moments;
pub use quantiles::Quantiles;

use alloc::collections::BTreeMap;
use alloc::vec::Vec;
use core::fmt;
use core::ops::Range;

use crate::batch::{Batch, Instructions};
use crate::collision::Collision;
use crate::distribution::Distribution;
use crate::input::{Input, NoSuchInput};
use crate::issue::{InputIssue, Issues};
use crate::output::Output;

/// Samples that are solved together: few enough that their numbers stay in the second cache.
const CHUNK: u64 = 1920;

/// Samples that are summarized on one thread before summaries are merged.
const STRETCH: u64 = 32 * CHUNK;

/// Collisions whose inputs are drawn.
#[derive(Clone, Debug)]
pub struct Simulation<F = Draws> {
    collision: Collision,
    fill: F,
    instructions: Instructions,
}

/// Reason why an input cannot be drawn.
#[derive(Clone, Debug, PartialEq)]
pub enum NotDrawn {
    /// The collision has no such input.
    NoSuchInput(NoSuchInput),
    /// The input has a distribution already.
    Twice(Input),
    /// The distribution has wrong parameters.
    Distribution(Input, Issues<InputIssue>),
}

impl fmt::Display for NotDrawn {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            NotDrawn::NoSuchInput(reason) => write!(f, "{reason}"),
            NotDrawn::Twice(input) => write!(f, "{input} has a distribution already; give each input one"),
            NotDrawn::Distribution(input, issues) => write!(f, "the distribution of {input}: {issues}"),
        }
    }
}

impl core::error::Error for NotDrawn {}

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

/// Samples that [`Collision::solve`] refuses.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct RefusedSamples {
    /// Their number.
    pub samples: u64,
    /// How many have each code; a sample may have several.
    pub by_code: BTreeMap<&'static str, u64>,
}

/// Accepted samples with consecutive numbers, but for those refused.
#[derive(Clone, Copy, Debug)]
pub struct Samples<'a, K = Output> {
    pub(crate) of: &'a [K],
    pub(crate) columns: &'a [Vec<f64>],
    pub(crate) first: u64,
    /// The place of each among those drawn, unless all are accepted.
    pub(crate) places: Option<&'a [u64]>,
}

impl<'a, K: Copy + PartialEq + fmt::Debug> Samples<'a, K> {
    /// Returns the values of an output.
    ///
    /// # Panics
    ///
    /// If the output is not one of [`Reduce::outputs`].
    pub fn column(&self, output: K) -> &'a [f64] {
        let place = self.of.iter().position(|of| *of == output);
        place.map(|place| self.columns[place].as_slice()).unwrap_or_else(|| panic!("{output:?} is not among the outputs of the summary"))
    }

    /// Returns the number of the sample at a place of the columns.
    pub fn number(&self, place: usize) -> u64 {
        self.first + self.places.map_or(place as u64, |places| places[place])
    }
}

/// A summary of samples, of whose outputs a key is the name.
pub trait Reduce<K = Output>: Clone + Send + Sync {
    /// Returns the outputs that it needs.
    fn outputs(&self) -> Vec<K>;

    /// Adds samples that follow those it has.
    fn take(&mut self, samples: &Samples<'_, K>);

    /// Adds the summary of samples that follow those it has.
    fn merge(&mut self, later: Self);
}

macro_rules! tuples {
    ($($($part:ident $i:tt),+;)+) => {
        $(impl<K, $($part: Reduce<K>),+> Reduce<K> for ($($part,)+) {
            fn outputs(&self) -> Vec<K> {
                let mut outputs = Vec::new();
                $(outputs.extend(self.$i.outputs());)+
                outputs
            }

            fn take(&mut self, samples: &Samples<'_, K>) {
                $(self.$i.take(samples);)+
            }

            fn merge(&mut self, later: Self) {
                $(self.$i.merge(later.$i);)+
            }
        })+
    };
}

tuples! {
    A 0, B 1;
    A 0, B 1, C 2;
    A 0, B 1, C 2, D 3;
    A 0, B 1, C 2, D 3, E 4;
}

impl<K, R: Reduce<K>> Reduce<K> for Vec<R> {
    fn outputs(&self) -> Vec<K> {
        self.iter().flat_map(R::outputs).collect()
    }

    fn take(&mut self, samples: &Samples<'_, K>) {
        self.iter_mut().for_each(|part| part.take(samples));
    }

    fn merge(&mut self, later: Self) {
        self.iter_mut().zip(later).for_each(|(part, later)| part.merge(later));
    }
}

impl Simulation {
    /// Creates a simulation of a collision of which every input is certain.
    #[must_use]
    pub fn of(collision: Collision) -> Self {
        Simulation::filled(collision, Draws::default())
    }

    /// Returns the same simulation with an uncertain input, in SI units and radians.
    ///
    /// # Errors
    ///
    /// [`NotDrawn`] if the collision has no such input, if it is uncertain already, or if the distribution has wrong parameters.
    pub fn with(mut self, input: Input, distribution: Distribution) -> Result<Self, NotDrawn> {
        self.collision.input(input).ok_or(NotDrawn::NoSuchInput(NoSuchInput(input)))?;
        distribution.check().map_err(|issues| NotDrawn::Distribution(input, issues))?;
        if self.fill.inputs().contains(&input) {
            return Err(NotDrawn::Twice(input));
        }
        self.fill.push(input, distribution);
        Ok(self)
    }

    /// Returns the same simulation with another seed than 0.
    #[must_use]
    pub fn with_seed(mut self, seed: u64) -> Self {
        self.fill.set_seed(seed);
        self
    }
}

impl<F: Fill> Simulation<F> {
    /// Creates a simulation of a collision whose uncertain inputs are filled in by code of yours.
    #[must_use]
    pub fn filled(collision: Collision, fill: F) -> Self {
        Simulation { collision, fill, instructions: Instructions::best() }
    }

    /// Returns the same simulation, to be computed with some vector instructions in place of the best: for comparing them. The bits are the same.
    #[must_use]
    pub fn on(self, instructions: Instructions) -> Self {
        Simulation { instructions, ..self }
    }

    /// Returns a sample by its number, such as that of an [`Extreme`].
    ///
    /// # Panics
    ///
    /// If a [`Fill`] of yours has not written one number for each input.
    pub fn sample(&self, number: u64) -> Collision {
        let mut columns = self.columns();
        self.fill.fill(number..number + 1, &mut columns);
        self.batch(&columns, 1).row(0)
    }

    /// Draws samples and summarizes those that physics accepts, in memory that does not grow with their number.
    ///
    /// `goes_on` is called with the number of samples that are done, from any thread; when it returns `false` the simulation stops, and the answer is that of
    /// the samples before.
    ///
    /// # Panics
    ///
    /// If a [`Fill`] of yours has not written a number for each sample and input.
    #[must_use]
    pub fn reduce<R: Reduce>(&self, samples: u64, empty: R, goes_on: &(dyn Fn(u64) -> bool + Sync)) -> Reduced<R> {
        reduce(self, samples, empty, goes_on)
    }

    fn columns(&self) -> Vec<Vec<f64>> {
        self.fill.inputs().iter().map(|_| Vec::new()).collect()
    }

    /// Returns some samples as a batch.
    ///
    /// # Panics
    ///
    /// If a fill has written another number of rows.
    fn batch<'a>(&self, columns: &'a [Vec<f64>], samples: usize) -> Batch<'a> {
        filled(Batch::of(self.collision).on(self.instructions).with_rows(samples), self.fill.inputs(), columns)
    }
}

/// Returns a batch with columns of inputs.
///
/// # Panics
///
/// If one has not as many rows as the batch.
pub(crate) fn filled<'a>(batch: Batch<'a>, inputs: &[Input], columns: &'a [Vec<f64>]) -> Batch<'a> {
    inputs.iter().zip(columns).fold(batch, |batch, (input, column)| match batch.with(*input, column) {
        Ok(batch) => batch,
        Err(unequal) => panic!("not every sample was written: {unequal}"),
    })
}

impl<F: Fill> Source for Simulation<F> {
    type Output = Output;

    fn solve(&self, samples: Range<u64>, of: &[Output]) -> SolvedSamples {
        let mut columns = self.columns();
        let rows = (samples.end - samples.start) as usize;
        self.fill.fill(samples, &mut columns);
        SolvedSamples::of(&self.batch(&columns, rows), of)
    }
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

/// Summarizes samples of a source as [`Simulation::reduce`] does.
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
