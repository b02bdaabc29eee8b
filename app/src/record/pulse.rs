//! From the forces of a barrier and from accelerations to impulse, velocity change and restitution.

use planar_impact::barrier::{ChannelClass, Estimate, Record, Window, bank, impulse_ratio};
use planar_impact::{Issue as _, Nt};

use super::analysis::{Analysis, ROUNDING};
use super::channel::stretch;
use super::recording::{Channel, Filter};
use super::{Accelerated, Barrier, ChannelQuantity, Peak, Trace, Uncertain};
use crate::issue::Issue;
use crate::message::Message;
use crate::notice::Notice;
use crate::units::Measure;
use crate::unusual;

/// A pulse, integrated over the contact.
struct Pulse {
    integral: Estimate,
    is_known: bool,
    peak: Peak,
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

/// Returns a note of a baseline that tells the noise badly: Student's distribution is noticeably wider than the normal one.
fn of_short_baseline(name: &str, path: &str, record: &Record, before: &Window) -> Option<Notice> {
    /// Fewest independent samples that tell it well.
    const FEW: f64 = 12.0;
    let (count, independent) = (record.indices_in(before).count(), record.independent_samples(before).ok()?.round());
    let correlated = if independent < count as f64 { format!(", correlated as {independent} independent ones,") } else { String::new() };
    let message = format!(
        "{name}: a baseline of {count} samples{correlated} hardly tells the noise: standard deviations of what follows are widened to Student's distribution"
    );
    (independent <= FEW).then(|| Notice::note("short-baseline", path, message))
}

/// Returns a note of a pulse that has few samples: what lies between them is not known.
fn of_few_samples(name: &str, path: &str, corrected: &Record, over: &Window, peak: Peak) -> Option<Notice> {
    /// Fewest samples that show how rough a pulse is.
    const FEW: usize = 20;
    let (times, values) = (corrected.times(), corrected.values());
    let of_pulse = |i: &usize| (over.from..=over.to).contains(&times[*i]) && values[*i].abs() > 0.1 * peak.value.abs();
    let count = (0..times.len()).filter(of_pulse).count();
    let message = format!(
        "{name} has {count} samples above a tenth of its peak: they hardly tell how rough it is, and of a rough one the standard deviation may be several times too \
         small"
    );
    (peak.value != 0.0 && count < FEW).then(|| Notice::note("coarse-sampling", path, message))
}

/// Returns a warning of a top that is flat but for the noise, as of a sensor that is driven beyond its range and still has noise of its own.
///
/// The samples within six standard deviations of the greatest are one stretch of ten or more. About a peak that is rounded, or a triangle, the load falls by less than half
/// as much again within a fifth of that stretch on either side; at a flat top it falls by four times as much.
fn of_noisy_top(name: &str, path: &str, quantity: ChannelQuantity, corrected: &Record, noise: f64) -> Option<Notice> {
    const WITHIN: f64 = 6.0;
    const FALL: f64 = 4.0;
    const FEWEST: usize = 10;
    let (times, values) = (corrected.times(), corrected.values());
    let top = values.iter().copied().max_by(|a, b| a.abs().total_cmp(&b.abs()))?;
    let below = |i: usize| (top - values[i]) * top.signum();
    let within = WITHIN * noise;
    let (from, to) = ((0..values.len()).find(|&i| below(i) <= within)?, (0..values.len()).rfind(|&i| below(i) <= within)?);
    let beyond = (to - from + 1).div_ceil(5);
    let falls = |i: usize| below(i) >= FALL * within;
    let is_flat = noise > 0.0
        && to + 1 >= from + FEWEST
        && (from..=to).all(|i| below(i) <= 2.0 * within)
        && from >= beyond
        && to + beyond < values.len()
        && falls(from - beyond)
        && falls(to + beyond);
    let message = Message::from(format!("{name} stays near "))
        .figure(quantity.measure(), top)
        .join(stretch(times[from], times[to]))
        .text(", as a sensor does that is driven beyond its range: give its `range`; if it is, the integral is too small");
    is_flat.then(|| Notice::warning("flat-top", path, message))
}

/// Returns a warning of a channel, or a sum of several, that never leaves one value: its integral is zero, and as certain as the readings are fine.
fn of_constant(name: &str, path: &str, quantity: ChannelQuantity, record: &Record) -> Option<Notice> {
    let first = *record.values().first()?;
    let message = Message::from(format!("{name} is ")).figure(quantity.measure(), first).text(
        " at every sample, so that nothing was measured: leave it out, or its integral of zero counts as evidence that is almost exact",
    );
    record.values().iter().all(|value| *value == first).then(|| Notice::warning("no-event", path, message))
}

/// Returns a warning of a pulse that is beyond any impact of vehicles: its times or its readings are in another unit.
fn of_implausible_size(name: &str, path: &str, quantity: ChannelQuantity, over: &Window, peak: Peak) -> Option<Notice> {
    /// In N and m/s²: forces reach some MN, and accelerations some hundred g.
    const GREATEST_FORCE: f64 = 1e9;
    const GREATEST_ACCELERATION: f64 = 1e5;
    let greatest = if quantity == ChannelQuantity::Acceleration { GREATEST_ACCELERATION } else { GREATEST_FORCE };
    let too_great = || {
        let message =
            Message::from(format!("{name} reaches ")).figure(quantity.measure(), peak.value).text(", which no impact does: check the unit");
        (peak.value.abs() > greatest).then(|| Notice::warning("implausible-size", path, message))
    };
    unusual::duration(path, format!("{name} is integrated over"), over.to - over.from).or_else(too_great)
}

/// Returns the time from which a channel that has no window should be unloaded: its last tenth, unless the load falls there, or is more than a tenth of the greatest,
/// as in a record that ends too early.
fn from_end(record: &Record, over: &Window, unloaded: f64) -> Option<f64> {
    let lately = over.to - 0.1 * (over.to - over.from);
    let middle = 0.5 * (lately + over.to);
    let mean = |from: f64, to: f64| Some(record.baseline(&Window { from, to }).ok()?.value - unloaded);
    let [early, late] = [mean(lately, middle)?, mean(middle, over.to)?];
    let greatest = record.values().iter().map(|value| (value - unloaded).abs()).fold(0.0, f64::max);
    (late.abs() > 0.5 * early.abs() && early * late > 0.0 && late.abs() <= 0.1 * greatest).then_some(lately)
}

/// Returns a warning of a baseline that ends under load, as of a time zero that is set by a threshold: its offset and its noise are then those of the load.
fn of_loaded_baseline(name: &str, path: &str, quantity: ChannelQuantity, record: &Record, before: &Window, peak: Peak) -> Option<Notice> {
    /// Standard deviations of one reading that are no chance, and the share of the peak that matters.
    const MOST: f64 = 6.0;
    const SHARE: f64 = 0.02;
    let half = Window { to: 0.5 * (before.from + before.to), ..*before };
    let early = record.baseline(&half).ok()?;
    let late = record.indices_in(before).max().map(|last| record.values()[last])?;
    let load = late - early.value;
    let message = Message::from(format!("{name} has grown by "))
        .figure(quantity.measure(), load)
        .text(" at ")
        .figure(Measure::Time, before.to)
        .text(", within its baseline: the impact begins earlier than the times say, and the integral loses that load; end `baseline` before it, and begin `window` there");
    (load.abs() > MOST * early.deviation() && load.abs() > SHARE * peak.value.abs())
        .then(|| Notice::warning("loaded-baseline", path, message))
}

/// Returns a warning of a channel that does not return to its baseline after the window, or at its end if there is none.
fn of_drift(
    name: &str,
    path: &str,
    quantity: ChannelQuantity,
    record: &Record,
    [over, before]: [&Window; 2],
    integral: Estimate,
) -> Option<Notice> {
    /// Standard deviations that are no chance.
    const MOST: f64 = 4.0;
    let times = record.times();
    let last = times[times.len() - 1];
    let after_window = times.iter().copied().find(|time| *time > over.to + ROUNDING * (last - times[0]));
    let mean = |window: &Window| -> Option<Estimate> {
        let reading = record.baseline(window).ok()?;
        Some(Estimate { variance: reading.variance / record.independent_samples(window).ok()?, ..reading })
    };
    let before = mean(before)?;
    let first = after_window.or_else(|| from_end(record, over, before.value))?;
    let (when, path) = if after_window.is_some() { ("after the window", "window") } else { ("at its end", path) };
    let after = mean(&Window { from: first, to: last })?;
    let difference = after.value - before.value;
    // An offset that drifts evenly is in the integral with half of its last value.
    let of_drift = difference * (over.to - over.from) / 2.0;
    let is_chance = difference.abs() <= MOST * (after.variance + before.variance).sqrt() || of_drift.abs() <= integral.deviation();
    let message = Message::from(format!("{when} {name} is "))
        .figure(quantity.measure(), difference)
        .text(" from its baseline: unless this acts on the vehicle, the offset drifts, and the integral has some ")
        .figure(quantity.integral(), of_drift)
        .text(" of it, which its standard deviation does not have");
    (!is_chance).then(|| Notice::warning("drift", path, message))
}

impl Analysis<'_> {
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
                let integral = Estimate { variance: integral.variance + of_steps, ..integral };
                self.notices.extend(of_drift(name, path, quantity, record, [&over, before], integral));
                integral
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
            let message = Message::from("no sample of ").text(format!("{name} lies")).join(stretch(over.from, over.to));
            self.issues.push(Issue::at("too-few", place, message).with_help("widen the window to the whole contact"));
            return None;
        };
        let peak = Peak { value: values[peak] + 0.0, time: times[peak] };
        let noise = before.as_ref().and_then(|before| record.baseline(before).ok()).map_or(0.0, |mean| mean.deviation());
        self.cut_by_window(name, quantity, &corrected, peak, noise);
        if before.is_some() {
            self.notices.extend(of_few_samples(name, path, &corrected, &over, peak));
            self.notices.extend(before.as_ref().and_then(|before| of_loaded_baseline(name, path, quantity, record, before, peak)));
            if channels.iter().all(|channel| channel.clipped().is_none()) {
                self.notices.extend(of_noisy_top(name, path, quantity, &corrected, noise));
            }
        }
        self.notices.extend(of_constant(name, path, quantity, record));
        self.notices.extend(of_implausible_size(name, path, quantity, &over, peak));
        self.traces.push(Trace { name: name.to_owned(), quantity, filter: class.map(ChannelClass::number), times, values, unfiltered });
        Some(Pulse { integral, is_known: before.is_some(), peak })
    }

    /// Says if the window begins or ends within the pulse.
    fn cut_by_window(&mut self, name: &str, quantity: ChannelQuantity, corrected: &Record, peak: Peak, noise: f64) {
        /// Standard deviations that are no chance.
        const MOST: f64 = 3.0;
        let Some(window) = self.of.settings.window else { return };
        let (times, values) = (corrected.times(), corrected.values());
        let least = (0.1 * peak.value.abs()).max(2.0 * corrected.resolution().unwrap_or(0.0)).max(MOST * noise);
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

    pub(super) fn barrier(&mut self) -> Option<Barrier> {
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
            self.notices.extend(unusual::impulse_ratio("window", ratio.value));
            Some(Uncertain::of(ratio, n.is_known && t.is_known))
        });
        if normal.is_none() && tangential.is_none() {
            return None;
        }
        // Accelerations and films give a restitution by the closing speed alone.
        let needs_speed = |channel: &Channel| matches!(channel.quantity, ChannelQuantity::Acceleration | ChannelQuantity::Distance);
        let is_used = of.settings.mass.is_some() || of.channels.iter().any(needs_speed);
        if of.settings.speed.is_some() && !is_used && normal.is_some() {
            let message = "it is not used here: with a mass, load cells give the velocity change and the restitution";
            self.notices.push(Notice::note("missing-partner", "speed", message));
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

    pub(super) fn acceleration(&mut self, channel: &Channel) -> Option<Accelerated> {
        let Pulse { integral, is_known, peak } = self.pulse(&channel.name, &channel.path, channel.quantity, &channel.record, &[channel])?;
        if integral.value < 0.0 {
            let message = Message::from(format!("{} is a velocity change of ", channel.name))
                .figure(Measure::Speed, integral.value)
                .text(", toward the barrier, which pushes the vehicle away from it: add or remove `polarity = -1` under its [[channel]]");
            self.notices.push(Notice::warning("reversed-polarity", channel.path.clone(), message));
        }
        let impulse = self.of.settings.mass.map(|mass| {
            let variance = integral.variance * mass.value * mass.value + integral.value * integral.value * mass.variance;
            Uncertain::of(Estimate { value: integral.value * mass.value, variance }, is_known)
        });
        let restitution = self.restitution(&channel.name, integral, is_known);
        Some(Accelerated { channel: channel.name.clone(), delta_v: Uncertain::of(integral, is_known), impulse, peak, restitution })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A pulse of 1000 whose last tenth, five samples of which both halves have the middle one, has these readings, beside an unloaded reading of 2.
    fn ends_with(last: [f64; 5]) -> Option<f64> {
        let mut values = vec![2.0; 10];
        values.extend([1002.0; 26]);
        values.extend(last.map(|load| load + 2.0));
        let record = Record::uniform(0.0, 1.0, values).expect("a record");
        from_end(&record, &Window { from: 0.0, to: 40.0 }, 2.0)
    }

    #[test]
    fn a_channel_is_unloaded_at_its_end_where_a_small_load_stays() {
        assert_eq!([ends_with([60.0; 5]), ends_with([-60.0; 5])], [Some(36.0); 2]);
        // It is a tenth of the greatest at most, and neither falls by half nor changes its sign.
        assert_eq!([ends_with([99.0; 5]), ends_with([101.0; 5])], [Some(36.0), None]);
        let falls_to = |late: f64| ends_with([100.0, 100.0, late, late, late]);
        assert_eq!([falls_to(45.0), falls_to(38.0)], [Some(36.0), None]);
        assert_eq!(ends_with([60.0, 60.0, -20.0, -60.0, -60.0]), None);
    }
}
