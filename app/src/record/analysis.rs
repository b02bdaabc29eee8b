//! From the channels of a recording to impulse, velocity change and restitution.

use planar_impact::barrier::{ChannelClass, Clock, Estimate, Record, TestIssue, TestIssues, Window, bank, impulse_ratio};
use planar_impact::{InputIssue, InputIssueKind, Issue as _, Nt};

use super::recording::{Channel, Filter};
use super::{
    Accelerated, Barrier, ChannelAnswer, ChannelQuantity, Clipped, Kinematics, Peak, RecordAnswer, Recorder, Recording, Trace, Uncertain,
};
use crate::issue::{Cause, Issue, Issues};
use crate::message::Message;
use crate::notice::Notice;
use crate::units::Measure;
use crate::wording::too_small;

/// Rounding of times, as a share of the length of a record.
pub(super) const ROUNDING: f64 = 1e-9;

/// The end of an event that a record lacks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Cut {
    Beginning,
    End,
}

/// What an analysis collects.
pub(super) struct Analysis<'a> {
    pub(super) of: &'a Recording,
    pub(super) issues: Vec<Issue>,
    pub(super) notices: Vec<Notice>,
    pub(super) traces: Vec<Trace>,
}

/// A pulse, integrated over the contact.
struct Pulse {
    integral: Estimate,
    is_known: bool,
    peak: Peak,
}

/// Computes what a recording tells. Asks before each film, which takes longer than everything else, whether to go on.
pub(super) fn analyse(recording: &Recording, proceed: &dyn Fn() -> Result<(), Issues>) -> Result<(RecordAnswer, Vec<Notice>), Issues> {
    let mut all = Analysis { of: recording, issues: Vec::new(), notices: Vec::new(), traces: Vec::new() };
    let channels: Vec<ChannelAnswer> = recording.channels.iter().map(|channel| all.channel(channel)).collect();
    let barrier = all.barrier();
    let of = |quantity: ChannelQuantity| recording.channels.iter().filter(move |channel| channel.quantity == quantity);
    let accelerations = of(ChannelQuantity::Acceleration).filter_map(|channel| all.acceleration(channel)).collect();
    let mut films = Vec::new();
    for channel in of(ChannelQuantity::Distance) {
        proceed()?;
        films.extend(all.film(channel));
    }
    let recorder = Recorder::of(recording, &mut all.issues, &mut all.notices);
    all.traces_of_recorder();
    let kinematics = all.kinematics();
    let Analysis { issues, notices, traces, .. } = all;
    if !issues.is_empty() {
        let is_physics = issues.iter().all(|issue| issue.code == "tensile");
        return Err(recording.refuse(if is_physics { Cause::Physics } else { Cause::Input }, issues));
    }
    let file = recording.name.clone();
    Ok((RecordAnswer { file, channels, barrier, accelerations, films, recorder, kinematics, traces }, notices))
}

impl Channel {
    /// Returns where the channel was driven beyond its range: where it reaches the given one, or else where it is flat at an extreme. A distance is flat where it turns.
    pub(super) fn clipped(&self) -> Option<Clipped> {
        let (times, values) = (self.record.times(), self.record.values());
        let beyond = |i: &usize| self.range.is_some_and(|range| values[*i].abs() >= range * (1.0 - 1e-9));
        if let Some(first) = (0..values.len()).find(beyond) {
            let last = first + (first..values.len()).take_while(beyond).count() - 1;
            return Some(Clipped { value: values[first], from: times[first], to: times[last], samples: last + 1 - first });
        }
        if self.quantity == ChannelQuantity::Distance {
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

    /// Returns the longest stretch without samples of a channel that is integrated, if that is many times as long as most of its steps.
    fn gap(&self) -> Option<[f64; 2]> {
        /// Steps that are missing.
        const MANY: f64 = 5.0;
        self.quantity.class()?;
        let times = self.record.times();
        let mut steps: Vec<f64> = times.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let longest = times.windows(2).max_by(|one, other| (one[1] - one[0]).total_cmp(&(other[1] - other[0])))?;
        steps.sort_by(f64::total_cmp);
        (longest[1] - longest[0] > MANY * steps[steps.len() / 2]).then_some([longest[0], longest[1]])
    }

    /// Returns which end of the event the record lacks. Its end: a pulse is above a tenth of its height at the last sample, or a velocity change still changes by
    /// a tenth within the last tenth of the time since it began. Its beginning: a pulse is above a tenth of its height at the first sample. In each case by more
    /// than two steps. A pulse counts from its mean over the window before the contact, or from zero without one, and then only its beginning can be missing.
    pub(super) fn cut(&self, before: Option<Window>) -> Option<Cut> {
        let (times, values) = (self.record.times(), self.record.values());
        let (first, last) = (values[0], values[values.len() - 1]);
        let slack = 2.0 * self.record.resolution().unwrap_or(0.0);
        let (unloaded, late, left) = match self.quantity {
            ChannelQuantity::Distance | ChannelQuantity::Speed => return None,
            quantity if quantity.is_running() => {
                let begun = values.iter().position(|value| (value - first).abs() > slack).unwrap_or(values.len()) - 1;
                let end = times[times.len() - 1];
                let lately = end - 0.1 * (end - times[begun]);
                let before = times.partition_point(|time| *time < lately).clamp(1, values.len() - 1) - 1;
                (first, 0.0, (last - values[before]).abs())
            }
            _ => {
                // A window without a mean is reported where the channel is integrated.
                let mean = before.and_then(|before| self.record.baseline(&before).ok());
                let unloaded = mean.map_or(0.0, |mean| mean.value);
                (unloaded, if before.is_none() { first.abs() } else { 0.0 }, (last - unloaded).abs())
            }
        };
        let height = values.iter().map(|value| (value - unloaded).abs()).fold(0.0, f64::max);
        let is_missing = |left: f64| left > (0.1 * height).max(slack);
        if is_missing(left) { Some(Cut::End) } else { is_missing(late).then_some(Cut::Beginning) }
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

/// Returns what the steps of a channel add to the variance of its integral. Noise of half a step or more spreads the samples over them, so that their mean is not
/// rounded. Of less noise all samples of the unloaded channel are off by the same part of a step, or toggle between two readings whose mean is off, and so is the
/// whole pulse.
fn variance_of_steps(channel: &Channel, over: &Window, before: &Window) -> f64 {
    let step = channel.step();
    let of_sample = step * step / 12.0;
    // The reading adds its own variance to that of the noise; that of two readings in turn is at most a quarter of the square of the step.
    let of_noise = step * step / 4.0;
    let is_spread = channel.record.baseline(before).is_ok_and(|baseline| baseline.variance >= of_noise + of_sample);
    let duration = over.to - over.from;
    if is_spread { 0.0 } else { of_sample * duration * duration }
}

/// Returns a note of a baseline that tells the noise badly.
fn of_short_baseline(name: &str, path: &str, record: &Record, before: &Window) -> Option<Notice> {
    let (count, independent) = (record.indices_in(before).count(), record.independent_samples(before).ok()?.round());
    let too_small = too_small((independent as usize).saturating_sub(1))?;
    let correlated = if independent < count as f64 { format!(", correlated as {independent} independent ones,") } else { String::new() };
    let message = format!(
        "{name}: a baseline of {count} samples{correlated} hardly tells the noise: the standard deviation of what follows may be {too_small}"
    );
    Some(Notice::note("short-baseline", path, message))
}

/// Returns the times between which a time must lie, to the nanosecond: rounded further, a limit may lie beyond itself.
fn times_of(issue: &TestIssue) -> String {
    let TestIssue::Input(InputIssue { kind: InputIssueKind::OutOfRange { least, greatest: Some(greatest), .. }, .. }) = issue else {
        return String::new();
    };
    let [first, last] = [least, greatest].map(|time| (time * 1e9).round() / 1e9);
    format!(", {first} s to {last} s")
}

impl Analysis<'_> {
    /// Describes a channel, and says if it does not hold the whole event.
    fn channel(&mut self, channel: &Channel) -> ChannelAnswer {
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
                .text(" from ")
                .figure(Measure::Time, from)
                .text(" to ")
                .figure(Measure::Time, to)
                .text("; what follows from it is too small in magnitude");
            self.notices.push(Notice::warning("clipped", channel.path.clone(), message));
        }
        if let Some(cut) = cut {
            let (what, at, when) = match cut {
                Cut::Beginning => ("begins", times[0], " after the event has begun, or with an offset that no sample before it shows"),
                Cut::End => ("ends", times[times.len() - 1], " before the event is over"),
            };
            let message = Message::from(format!("{} is truncated: it {what} at ", channel.name))
                .figure(Measure::Time, at)
                .text(format!("{when}; what follows from it is incomplete"));
            self.notices.push(Notice::warning("truncated", channel.path.clone(), message));
        }
        if let Some([from, to]) = channel.gap() {
            let message = Message::from(format!("{} has no samples from ", channel.name))
                .figure(Measure::Time, from)
                .text(" to ")
                .figure(Measure::Time, to)
                .text("; its integral takes a straight line there");
            self.notices.push(Notice::warning("gap", channel.path.clone(), message));
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

    pub(super) fn report<T>(&mut self, path: &str, result: Result<T, TestIssues>) -> Option<T> {
        self.report_of("", path, result)
    }

    /// The same with what is at fault before the message, where the path and the place do not say it.
    fn report_of<T>(&mut self, whose: &str, path: &str, result: Result<T, TestIssues>) -> Option<T> {
        let issues = match result {
            Ok(value) => return Some(value),
            Err(issues) => issues,
        };
        for issue in issues.iter() {
            let place = issue.place().map(|place| place.name);
            let (path, name) = match place {
                Some("window from" | "window to") if path == "baseline" => (path, "the baseline: "),
                Some("window from" | "window to") => (path, "the window: "),
                Some("channel") => (path, "a channel: "),
                Some("samples in the baseline") => (path, "the baseline: "),
                Some("time") => (path, "separation: "),
                _ => (path, whose),
            };
            let message = Message::from(name.to_owned()).join(issue.message());
            let help = issue.help().unwrap_or_else(|| match path {
                "baseline" | "window" => {
                    format!("give its begin and its end within the times of the channel{}, in this order", times_of(issue)).into()
                }
                "filter" => "leave `filter` out, or write `filter = false`".into(),
                _ => "correct the times and the settings of the recording".into(),
            });
            // Several channels may have the same times.
            let issue = Issue::at(issue.code(), path, message).with_help(help);
            if !self.issues.contains(&issue) {
                self.issues.push(issue);
            }
        }
        None
    }

    /// Returns the window of the contact.
    fn over(&self, record: &Record) -> Window {
        let times = record.times();
        self.of.settings.window.unwrap_or(Window { from: times[0].max(0.0), to: times[times.len() - 1] })
    }

    /// Returns the window of the unloaded channel before the contact, if the recording has one.
    fn before(&self, record: &Record) -> Option<Window> {
        let times = record.times();
        let (first, last) = (times[0], times[times.len() - 1]);
        // Times computed from a start and a step are rounded.
        let slack = ROUNDING * (last - first);
        let from = self.over(record).from.min(0.0);
        let unloaded = times.iter().copied().filter(|time| *time < from - slack);
        let (count, end) = unloaded.fold((0, first), |(count, _), time| (count + 1, time));
        self.of.settings.baseline.or((count > 1).then_some(Window { from: first, to: end }))
    }

    /// Returns the window of the contact and that of the unloaded channel before it.
    fn windows(&mut self, record: &Record) -> Option<(Window, Option<Window>)> {
        let (over, before) = (self.over(record), self.before(record));
        if let Some(before) = before.filter(|before| before.to > over.from) {
            let message = Message::from("the channels are loaded from ")
                .figure(Measure::Time, over.from)
                .text(", and the baseline lasts to ")
                .figure(Measure::Time, before.to);
            self.issues.push(Issue::at("contradiction", "baseline", message).with_help("end it where `window` begins, or before"));
            return None;
        }
        Some((over, before))
    }

    /// Integrates a pulse from the raw record, the sum of these channels, and draws it filtered.
    fn pulse(&mut self, name: &str, path: &str, quantity: ChannelQuantity, record: &Record, channels: &[&Channel]) -> Option<Pulse> {
        let (over, before) = self.windows(record)?;
        let place = if self.of.settings.window.is_some() { "window" } else { path };
        let uncorrected = self.report(place, record.impulse_over(&over));
        let corrected = match &before {
            Some(before) => self.report("baseline", record.corrected(before)),
            None => {
                let message = format!("{name}: no samples before the contact, so its offset is taken as zero and its noise is not known");
                self.notices.push(Notice::note("no-baseline", path, message));
                Some(record.clone())
            }
        };
        let class = self.class(name, path, quantity, record);
        let filtered = match class {
            Some(class) => self.report_of(&format!("{name}: "), "filter", corrected.as_ref().unwrap_or(record).filtered(class)),
            None => corrected.clone(),
        };
        let (uncorrected, corrected, filtered) = (uncorrected?, corrected?, filtered?);
        let mut integral = match &before {
            Some(before) => {
                let integral = self.report(place, record.impulse(&over, before))?;
                self.notices.extend(of_short_baseline(name, path, record, before));
                let of_steps: f64 = channels.iter().map(|channel| variance_of_steps(channel, &over, before)).sum();
                Estimate { variance: integral.variance + of_steps, ..integral }
            }
            None => Estimate { value: uncorrected, variance: 0.0 },
        };
        // Of a constant channel nothing is left but the rounding of its sum.
        if integral.value.abs() <= ROUNDING * 1e-3 * uncorrected.abs() {
            integral.value = 0.0;
        }
        let unfiltered = class.is_some().then(|| corrected.values().to_vec());
        let (times, values) = (filtered.times(), filtered.values().to_vec());
        let inside = (0..times.len()).filter(|&i| (over.from..=over.to).contains(&times[i]));
        let Some(peak) = inside.max_by(|&a, &b| values[a].abs().total_cmp(&values[b].abs())) else {
            let message = Message::from("no sample of ")
                .text(name.to_owned())
                .text(" lies from ")
                .figure(Measure::Time, over.from)
                .text(" to ")
                .figure(Measure::Time, over.to);
            self.issues.push(Issue::at("too-few", place, message).with_help("widen the window to the whole contact"));
            return None;
        };
        let peak = Peak { value: values[peak] + 0.0, time: times[peak] };
        self.cut_by_window(name, quantity, &corrected, peak);
        self.traces.push(Trace { name: name.to_owned(), quantity, filter: class.map(ChannelClass::number), times, values, unfiltered });
        Some(Pulse { integral, is_known: before.is_some(), peak })
    }

    /// Says if the window begins or ends within the pulse.
    fn cut_by_window(&mut self, name: &str, quantity: ChannelQuantity, corrected: &Record, peak: Peak) {
        let Some(window) = self.of.settings.window else { return };
        let (times, values) = (corrected.times(), corrected.values());
        let least = (0.1 * peak.value.abs()).max(2.0 * corrected.resolution().unwrap_or(0.0));
        for (does, edge) in [("begins", window.from), ("ends", window.to)] {
            let nearest = (0..times.len()).min_by(|&a, &b| (times[a] - edge).abs().total_cmp(&(times[b] - edge).abs()));
            let Some(value) = nearest.map(|at| values[at]).filter(|value| value.abs() > least) else { continue };
            let message = Message::from(format!("the window {does} at "))
                .figure(Measure::Time, edge)
                .text(format!(" within the pulse: {name} is "))
                .figure(quantity.measure(), value)
                .text(" there; the integral has no more than the window");
            self.notices.push(Notice::warning("cut-by-window", "window", message));
        }
    }

    /// Returns the class of the filter: the one that the file gives, or else that of the quantity if the record is fast enough.
    fn class(&mut self, name: &str, path: &str, quantity: ChannelQuantity, record: &Record) -> Option<ChannelClass> {
        let usual = match self.of.settings.filter {
            Filter::Class(class) => return Some(class),
            Filter::Off => return None,
            Filter::Usual => quantity.class()?,
        };
        if record.filtered(usual).is_ok() {
            return Some(usual);
        }
        let message = Message::from(format!("{name} is not filtered: CFC {} needs equal steps of at most ", usual.number()))
            .figure(Measure::Time, usual.longest_step());
        self.notices.push(Notice::note("not-filtered", path, message));
        None
    }

    fn barrier(&mut self) -> Option<Barrier> {
        let of = self.of;
        let mut sum = |quantity: ChannelQuantity, name: &str| -> Option<Pulse> {
            let channels: Vec<&Channel> = of.channels.iter().filter(|channel| channel.quantity == quantity).collect();
            let records: Vec<Record> = channels.iter().map(|channel| channel.record.clone()).collect();
            let path = channels.first()?.path.clone();
            let total = match bank(&records) {
                Ok(total) => total,
                Err(issues) => {
                    for issue in issues.iter() {
                        let at =
                            issue.place().and_then(|place| place.index).and_then(|i| channels.get(i)).map_or(path.as_str(), |c| &c.path);
                        let help = format!("list the channels of a bank, here {}, at the times of {}", quantity.name(), channels[0].name);
                        self.issues.push(Issue::at(issue.code(), at, issue.message()).with_help(help));
                    }
                    return None;
                }
            };
            self.pulse(name, &path, quantity, &total, &channels)
        };
        let normal = sum(ChannelQuantity::NormalForce, "normal force");
        let tangential = sum(ChannelQuantity::TangentialForce, "tangential force");
        let first = of.channels.iter().find(|channel| channel.quantity == ChannelQuantity::NormalForce);
        if let (Some(pulse), Some(first)) = (&normal, first)
            && pulse.integral.value <= 0.0
        {
            let (what, help) = match pulse.integral.value < 0.0 {
                true => (
                    ": the barrier would pull",
                    "forces on the vehicle away from the barrier are positive; add or remove `polarity = -1` under each [[channel]] whose sign is reversed, or end \
                     the baseline before the contact",
                ),
                false => (": there is no impact", "check the column, and the times of the window and of the baseline"),
            };
            let message = Message::from("the normal impulse is ").figure(Measure::Impulse, pulse.integral.value).text(what);
            self.issues.push(Issue::at("tensile", first.path.clone(), message).with_help(help));
            return None;
        }
        let ratio = normal.as_ref().zip(tangential.as_ref()).and_then(|(n, t)| {
            let ratio = impulse_ratio(Nt { n: n.integral.value, t: t.integral.value });
            let ratio = self.report("window", ratio.map(|value| Estimate { value, ..t.integral.over(n.integral) }))?;
            if !ratio.variance.is_finite() {
                self.issues.push(Issue::at("overflow", "window", "the impulse ratio overflows: the normal impulse is next to zero"));
                return None;
            }
            Some(Uncertain::of(ratio, n.is_known && t.is_known))
        });
        if normal.is_none() && tangential.is_none() {
            return None;
        }
        let impulse = |bank: &Option<Pulse>| bank.as_ref().map(|pulse| Uncertain::of(pulse.integral, pulse.is_known));
        let change = normal.as_ref().and_then(|pulse| Some((pulse.integral.over(of.settings.mass?), pulse.is_known)));
        Some(Barrier {
            normal_impulse: impulse(&normal),
            tangential_impulse: impulse(&tangential),
            impulse_ratio: ratio,
            peak_force: normal.as_ref().map(|pulse| pulse.peak),
            delta_v: change.map(|(change, is_known)| Uncertain::of(change, is_known)),
            restitution: change.and_then(|(change, is_known)| self.restitution("the load cells", change, is_known)),
        })
    }

    /// Returns the restitution of the center of mass from its velocity change, e = ΔV/v − 1.
    fn restitution(&mut self, source: &str, change: Estimate, is_known: bool) -> Option<Uncertain> {
        let ratio = change.over(self.of.settings.speed?);
        if !(ratio.value.is_finite() && ratio.variance.is_finite()) {
            self.overflows(source);
            return None;
        }
        let restitution = Estimate { value: ratio.value - 1.0, ..ratio };
        let restitution = Uncertain::of(restitution, is_known);
        self.plausible(source, &restitution);
        Some(restitution)
    }

    pub(super) fn overflows(&mut self, source: &str) {
        let message = format!("the restitution by {source} overflows: the speed is next to zero");
        self.issues.push(Issue::at("overflow", "speed", message).with_help("give the closing speed of the test"));
    }

    pub(super) fn plausible(&mut self, source: &str, restitution: &Uncertain) {
        /// Standard deviations by which one between 0 and 1 may seem to lie outside.
        const MOST: f64 = 2.0;
        let outside = (-restitution.value).max(restitution.value - 1.0);
        if outside > MOST * restitution.sd.unwrap_or(0.0) + ROUNDING {
            let message = Message::from(format!("the restitution by {source} is "))
                .figure(Measure::Ratio, restitution.value)
                .text(", and not from 0 to 1; check mass, speed, calibration and window");
            self.notices.push(Notice::warning("implausible-restitution", "speed", message));
        }
    }

    fn acceleration(&mut self, channel: &Channel) -> Option<Accelerated> {
        let Pulse { integral, is_known, peak } = self.pulse(&channel.name, &channel.path, channel.quantity, &channel.record, &[channel])?;
        let impulse = self.of.settings.mass.map(|mass| {
            let variance = integral.variance * mass.value * mass.value + integral.value * integral.value * mass.variance;
            Uncertain::of(Estimate { value: integral.value * mass.value, variance }, is_known)
        });
        let restitution = self.restitution(&channel.name, integral, is_known);
        Some(Accelerated { channel: channel.name.clone(), delta_v: Uncertain::of(integral, is_known), impulse, peak, restitution })
    }

    /// Returns the restitution of the measured kinematics.
    fn kinematics(&mut self) -> Option<Kinematics> {
        let measured = self.of.settings.kinematics.as_ref()?;
        let kinematics = match measured.answer() {
            Ok(kinematics) => kinematics,
            Err(issues) => {
                for issue in issues.iter() {
                    let path = issue.path().map_or_else(|| "kinematics".to_owned(), |path| format!("kinematics.{path}"));
                    let help = issue.help().unwrap_or_else(|| "correct the measured motion".into());
                    self.issues.push(Issue::at(issue.code(), path, issue.message()).with_help(help));
                }
                return None;
            }
        };
        self.plausible("the kinematics", &kinematics.restitution);
        Some(kinematics)
    }

    fn traces_of_recorder(&mut self) {
        let speeds = self.of.channels.iter().filter(|channel| channel.quantity.measure() == Measure::Speed);
        self.traces.extend(speeds.map(plain));
    }
}

pub(super) fn plain(channel: &Channel) -> Trace {
    let (name, quantity, filter) = (channel.name.clone(), channel.quantity, None);
    Trace { name, quantity, filter, times: channel.record.times(), values: channel.record.values().to_vec(), unfiltered: None }
}

/// Returns the time from one sample to the next, if it is the same for all.
pub(super) fn period(record: &Record) -> Option<f64> {
    match record.clock() {
        Clock::Uniform { step, .. } => Some(*step),
        _ => None,
    }
}
