//! A channel by itself: whether it holds the whole event, undisturbed, and in which steps it was read.

use planar_impact::Distribution;
use planar_impact::barrier::{Clock, Record, Window};

use super::analysis::{Analysis, ROUNDING};
use super::cut::Cut;
use super::recording::Channel;
use super::{ChannelAnswer, ChannelQuantity, Clipped};
use crate::message::Message;
use crate::notice::Notice;
use crate::units::Measure;

impl Channel {
    /// Returns where the channel was driven beyond its range: where it reaches the given one, or else where it is flat at an extreme. A distance is flat where it
    /// turns, a speed where the driver holds it, and a velocity change that ends below a given range where it is over.
    pub(super) fn clipped(&self) -> Option<Clipped> {
        let (times, values) = (self.record.times(), self.record.values());
        let beyond = |i: &usize| self.range.is_some_and(|range| values[*i].abs() >= range * (1.0 - 1e-9));
        if let Some(first) = (0..values.len()).find(beyond) {
            let last = first + (first..values.len()).take_while(beyond).count() - 1;
            return Some(Clipped { value: values[first], from: times[first], to: times[last], samples: last + 1 - first });
        }
        let is_within_range = self.range.is_some() && self.quantity.is_running();
        if is_within_range || matches!(self.quantity, ChannelQuantity::Distance | ChannelQuantity::Speed) {
            return None;
        }
        let top = self.record.flat_top()?;
        Some(Clipped { value: top.value, from: top.from, to: top.to, samples: top.samples })
    }

    /// Returns the step in which the channel was read: at least one unit of the last decimal that is printed, or what all samples lie whole multiples of apart.
    pub(super) fn step(&self) -> f64 {
        let of_digits = self.digit * common_digits(&self.record, self.digit);
        step_of(&self.record).map_or(of_digits, |step| step.max(of_digits))
    }

    /// Returns the longest stretch without samples of a channel that is integrated there, if that is many times as long as most of its steps.
    fn gap(&self, over: &Window) -> Option<[f64; 2]> {
        /// Steps that are missing.
        const MANY: f64 = 5.0;
        self.quantity.class()?;
        let times = self.record.times();
        let step = |pair: &[f64]| pair[1] - pair[0];
        let mut steps: Vec<f64> = times.windows(2).map(step).collect();
        steps.sort_by(f64::total_cmp);
        let inside = times.windows(2).filter(|pair| pair[0] < over.to && over.from < pair[1]);
        let longest = inside.max_by(|one, other| step(one).total_cmp(&step(other)))?;
        (step(longest) > MANY * steps[steps.len() / 2]).then_some([longest[0], longest[1]])
    }

    /// Returns the first stretch of a pulse, of its times and value, that is no part of it: the channel goes to a value, holds it exactly, and returns. Both changes are
    /// a fifth of its range and several steps.
    fn dropout(&self, step: f64) -> Option<([f64; 2], f64)> {
        /// Fewest samples that are held.
        const FEW: usize = 3;
        /// Share of the range by which the channel changes.
        const LARGE: f64 = 0.2;
        /// Steps of the readings that are no change.
        const STEPS: f64 = 5.0;
        let [lowest, highest] = self.extremes();
        let least = (LARGE * (highest - lowest)).max(STEPS * step);
        self.held(FEW, |before, value, after| {
            let (fall, rise) = (before.unwrap_or(value) - value, after - value);
            fall.abs() > least && rise.abs() > least && fall.signum() == rise.signum()
        })
    }

    /// Returns the first stretch of a loaded pulse at which the channel holds one value, of which it is neither the greatest nor the least, and its times and value. A
    /// pulse that is stored in steps leaves such a value by one of them; a channel that was frozen by more than three.
    fn frozen(&self, step: f64) -> Option<([f64; 2], f64)> {
        /// Fewest samples that are held.
        const FEW: usize = 5;
        /// Share of the range from the first sample, which is unloaded.
        const LOADED: f64 = 0.1;
        /// Steps of the readings, which a pulse may change by from one to the next.
        const STEPS: f64 = 3.0;
        let ([lowest, highest], first) = (self.extremes(), self.record.values()[0]);
        let is_within = |value: f64| value > lowest && value < highest && (value - first).abs() > LOADED * (highest - lowest);
        self.held(FEW, |_, value, after| is_within(value) && (after - value).abs() > STEPS * step)
    }

    fn extremes(&self) -> [f64; 2] {
        let values = || self.record.values().iter().copied();
        [values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max)]
    }

    /// Returns the times and the value of the first stretch of so many equal samples or more, up to another one, that fits: by the sample before it, its value and the sample
    /// after it.
    fn held(&self, few: usize, fits: impl Fn(Option<f64>, f64, f64) -> bool) -> Option<([f64; 2], f64)> {
        let (times, values) = (self.record.times(), self.record.values());
        let mut first = 0;
        for held in values.chunk_by(|one, other| one == other) {
            let last = first + held.len() - 1;
            let before = first.checked_sub(1).map(|before| values[before]);
            if values.get(last + 1).is_some_and(|after| held.len() >= few && fits(before, held[0], *after)) {
                return Some(([times[first], times[last]], held[0]));
            }
            first = last + 1;
        }
        None
    }

    /// Returns the samples that stand out, up to a few, and what their neighbors give in their place: without them nothing in the channel bends a fifth as sharply as
    /// it does at each. The smoothing of a film is robust against them.
    fn spikes(&self) -> Vec<(usize, f64)> {
        /// Most samples that stand out.
        const FEW: usize = 4;
        /// How many times as sharply.
        const SHARPER: f64 = 5.0;
        if self.quantity == ChannelQuantity::Distance || self.record.len() < MANY {
            return Vec::new();
        }
        let (times, mut values) = (self.record.times(), self.record.values().to_vec());
        let between = |values: &[f64], i: usize| {
            let share = (times[i] - times[i - 1]) / (times[i + 1] - times[i - 1]);
            values[i - 1] * (1.0 - share) + values[i + 1] * share
        };
        let mut spikes = Vec::new();
        let mut least = f64::INFINITY;
        for _ in 0..=FEW {
            let bends = (1..values.len() - 1).map(|i| (i, (values[i] - between(&values, i)).abs()));
            let Some((sharpest, bend)) = bends.max_by(|one, other| one.1.total_cmp(&other.1)) else { break };
            if SHARPER * bend < least && !spikes.is_empty() {
                spikes.sort_by_key(|(i, _)| *i);
                return spikes;
            }
            least = bend.min(least);
            values[sharpest] = between(&values, sharpest);
            spikes.push((sharpest, values[sharpest]));
        }
        Vec::new()
    }
}

/// Fewest samples of which a common step is no chance.
const MANY: usize = 16;

/// Returns the greatest number of units of the last printed decimal that all samples of a record lie apart, if it has many; at least one.
fn common_digits(record: &Record, digit: f64) -> f64 {
    /// Greatest number of which the one after it is another float.
    const MOST: f64 = 9.0e15;
    /// Rounding of a difference of samples, in units of the last decimal.
    const NEAR: f64 = 0.01;
    let values = record.values();
    let greatest_divisor = |one: u64, other: u64| {
        let (mut one, mut other) = (one, other);
        while other != 0 {
            (one, other) = (other, one % other);
        }
        one
    };
    let digits = values.iter().map(|value| ((value - values[0]) / digit).abs());
    let whole = digits.map(|count| (count < MOST && (count - count.round()).abs() < NEAR).then(|| count.round() as u64));
    let common = whole.into_iter().try_fold(0, |common, count| count.map(|count| greatest_divisor(common, count)));
    common.filter(|_| values.len() >= MANY).map_or(1.0, |common| common.max(1) as f64)
}

/// Returns the step in which a record was read, if it has many samples and all lie whole steps apart, but for the rounding of their digits.
fn step_of(record: &Record) -> Option<f64> {
    /// Rounding of a sample, in steps.
    const NEAR: f64 = 0.02;
    let least = record.resolution()?;
    let mut levels = record.values().to_vec();
    levels.sort_by(f64::total_cmp);
    levels.dedup();
    // Counted from level to level, so that the rounding of the least step does not add up.
    let counts: Vec<f64> = std::iter::once(0.0)
        .chain(levels.windows(2).scan(0.0, |count, pair| {
            *count += ((pair[1] - pair[0]) / least).round();
            Some(*count)
        }))
        .collect();
    let heights = || counts.iter().zip(&levels).map(|(count, level)| (count, level - levels[0]));
    let step = heights().map(|(count, height)| count * height).sum::<f64>() / counts.iter().map(|count| count * count).sum::<f64>();
    let is_whole = heights().all(|(count, height)| (height - count * step).abs() < NEAR * step);
    (record.len() >= MANY && is_whole).then_some(step)
}

/// By how much readings scatter where a velocity change is almost constant.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Scatter {
    /// Standard deviation, widened for so few readings as Student's t is: 1.96 of it are as rarely exceeded as of a known one. Zero if their steps explain it;
    /// `None` if too few readings show it.
    pub(super) deviation: Option<f64>,
    /// Number of these readings.
    pub(super) readings: usize,
}

/// Returns the scatter of a velocity change, by the second differences of its almost constant readings.
///
/// It is almost constant from the first reading that reaches most of the late ones, if none is much greater, and otherwise from the greatest: of readings that scatter the
/// greatest may be one of the last.
pub(super) fn scatter(values: &[f64], step: f64) -> Scatter {
    /// Fewest readings of which some are late, and fewest that show it.
    const FEW: usize = 8;
    const LATE: usize = FEW / 2;
    /// Share of the late readings by which the greatest may exceed them.
    const HARDLY: f64 = 0.1;
    /// The same in standard deviations by which these scatter.
    const BY_CHANCE: f64 = 6.0;
    /// Share of the variance of steps that a constant leaves, which crosses a step at times.
    const OF_STEPS: f64 = 0.6;
    if values.len() < FEW {
        return Scatter::default();
    }
    let variance = |readings: &[f64]| -> f64 {
        let bends = readings.windows(3).map(|three| three[0] - 2.0 * three[1] + three[2]);
        bends.map(|bend| bend * bend).sum::<f64>() / (6.0 * (readings.len() - 2) as f64)
    };
    let heights: Vec<f64> = values.iter().map(|value| value.abs()).collect();
    let late = &heights[heights.len() - (heights.len() / 4).max(LATE)..];
    let by_chance = BY_CHANCE * variance(late).sqrt();
    let mut late = late.to_vec();
    late.sort_by(f64::total_cmp);
    let (late, top) = (late[late.len() / 4], greatest(heights.iter().copied()));
    let is_constant = heights[top] <= late + by_chance.max(HARDLY * late);
    let reached = heights.iter().position(|height| *height >= late).filter(|_| is_constant);
    let after = &values[reached.map_or(top, |reached| reached.min(top))..];
    let readings = after.len();
    if readings < LATE {
        return Scatter { deviation: None, readings };
    }
    if variance(after) <= OF_STEPS * step * step / 12.0 {
        return Scatter { deviation: Some(0.0), readings };
    }
    // Neighboring bends share readings: about half of them are independent.
    let n = u32::try_from((readings - 2).div_ceil(2) + 1).unwrap_or(u32::MAX);
    let student = Distribution::StudentT { mean: 0.0, sd: f64::from(n).sqrt(), n };
    let widened = student.quantile(0.975) / Distribution::NORMAL_95;
    Scatter { deviation: Some(widened * variance(after).sqrt()), readings }
}

/// Returns the index of the greatest of some magnitudes, the first of several.
pub(super) fn greatest(values: impl Iterator<Item = f64>) -> usize {
    values.enumerate().fold((0, f64::NEG_INFINITY), |best, (i, value)| if value > best.1 { (i, value) } else { best }).0
}

/// Says from when to when something is.
pub(super) fn stretch(from: f64, to: f64) -> Message {
    Message::from(" from ").figure(Measure::Time, from).text(" to ").figure(Measure::Time, to)
}

impl Analysis<'_> {
    /// Describes a channel, and says if it does not hold the whole event.
    pub(super) fn channel(&mut self, channel: &Channel) -> ChannelAnswer {
        let (times, measure) = (channel.record.times(), channel.quantity.measure());
        let (clipped, cut) = (channel.clipped(), channel.cut(self.before(&channel.record)));
        let greatest = channel.record.values().iter().copied().max_by(|one, other| one.abs().total_cmp(&other.abs())).unwrap_or(0.0);
        if let Some(range) = channel.range.filter(|range| greatest.abs() > range * (1.0 + ROUNDING)) {
            let message = Message::from(format!("{} reaches ", channel.name))
                .figure(measure, greatest)
                .text(", beyond its range of ")
                .figure(measure, range)
                .text(": check `range`, calibration and unit");
            self.notices.push(Notice::warning("beyond-range", channel.path.clone(), message));
        } else if let Some(Clipped { value, from, to, samples }) = clipped {
            let message = Message::from(format!("{} is clipped: {samples} samples at ", channel.name))
                .figure(measure, value)
                .join(stretch(from, to))
                .text("; what follows from it is too small in magnitude")
                .text(if channel.range.is_none() && channel.quantity.is_running() { "; give its `range` if it is whole" } else { "" });
            self.notices.push(Notice::warning("clipped", channel.path.clone(), message));
        }
        if let Some(cut) = cut {
            let (what, at, when) = match cut {
                Cut::Beginning => ("begins", times[0], " after the event has begun, or with an offset that no sample before it shows"),
                Cut::End => ("ends", times[times.len() - 1], " before it shows that the event is over"),
            };
            let message = Message::from(format!("{} is truncated: it {what} at ", channel.name))
                .figure(Measure::Time, at)
                .text(format!("{when}; what follows from it is incomplete"));
            self.notices.push(Notice::warning("truncated", channel.path.clone(), message));
        }
        // Of a pulse, which is integrated.
        let step = channel.quantity.class().map(|_| channel.step());
        if let Some(([from, to], value)) = step.and_then(|step| channel.dropout(step)) {
            let message = Message::from(format!("{} goes to ", channel.name))
                .figure(measure, value)
                .text(", holds it")
                .join(stretch(from, to))
                .text(", and returns: what follows from it is wrong if the channel was lost there");
            self.notices.push(Notice::warning("dropout", channel.path.clone(), message));
        } else if let Some(([from, to], value)) = step.and_then(|step| channel.frozen(step)) {
            let message = Message::from(format!("{} holds ", channel.name))
                .figure(measure, value)
                .join(stretch(from, to))
                .text(" and leaves it at once, as a channel does that was frozen: what follows from it is wrong if it was");
            self.notices.push(Notice::warning("frozen", channel.path.clone(), message));
        }
        if let Some([from, to]) = channel.gap(&self.over(&channel.record)) {
            let message = Message::from(format!("{} has no samples", channel.name))
                .join(stretch(from, to))
                .text("; its integral takes a straight line there");
            self.notices.push(Notice::warning("gap", channel.path.clone(), message));
        }
        if let [(first, neighbors), others @ ..] = channel.spikes().as_slice() {
            let what = if others.is_empty() {
                "a sample that stands out".to_owned()
            } else {
                format!("{} samples that stand out, the first", 1 + others.len())
            };
            let message = Message::from(format!("{} has {what} at ", channel.name))
                .figure(Measure::Time, times[*first])
                .text(": ")
                .figure(measure, channel.record.values()[*first])
                .text(", where its neighbors give ")
                .figure(measure, *neighbors)
                .text("; take the neighbors' if it is a disturbance");
            self.notices.push(Notice::warning("spike", channel.path.clone(), message));
        }
        ChannelAnswer {
            name: channel.name.clone(),
            quantity: channel.quantity,
            samples: times.len(),
            from: times[0],
            to: times[times.len() - 1],
            period: period(&channel.record),
            resolution: channel.record.resolution(),
            clipped,
            is_truncated: cut.is_some(),
        }
    }
}

/// Returns the time from one sample to the next, if it is the same for all.
pub(super) fn period(record: &Record) -> Option<f64> {
    match record.clock() {
        Clock::Uniform { step, .. } => Some(*step),
        _ => None,
    }
}
