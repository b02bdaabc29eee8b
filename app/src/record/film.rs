//! The restitution by a film: the distance of a point from the barrier over time.

use std::ops::Range;

use planar_impact::barrier::{Estimate, Lowess, Record, Smoothed, TestIssues, restitution_from_smoothed};

use super::analysis::{Analysis, ROUNDING, plain};
use super::recording::Channel;
use super::{Film, Uncertain};
use crate::issue::Issue;
use crate::message::Message;
use crate::notice::Notice;
use crate::units::Measure;
use crate::unusual;

/// Samples in a local line of a film, unless the file says otherwise.
const NEIGHBORS: usize = 9;
/// Fewest samples in a local line.
const FEWEST: usize = 4;
/// Maximum number of frames of a film: smoothing takes time that grows with the square.
const MOST_FRAMES: usize = 5000;

/// Returns `true` if two estimates of a speed differ by more than three standard deviations and a twentieth.
fn is_apart(one: Estimate, other: Estimate) -> bool {
    let apart = (one.value - other.value).abs();
    apart > 3.0 * (one.variance + other.variance).sqrt() && apart > 0.05 * other.value.abs()
}

/// Returns the squares of the changes of slope from each short line of a uniform motion to the next, in variances of errors that are independent from frame to frame.
///
/// The lines have as many frames as those of the smoother and none in common. As each is compared with the next, the motion may change slowly.
fn changes_of_slope(film: &Record, neighbors: usize, noise: f64) -> Vec<f64> {
    let (times, values) = (film.times(), film.values());
    let lines = times.chunks_exact(neighbors).zip(values.chunks_exact(neighbors)).map(|(times, values)| {
        let (middle, level) = (mean(times), mean(values));
        let spread: f64 = times.iter().map(|time| (time - middle) * (time - middle)).sum();
        let slope: f64 = times.iter().zip(values).map(|(time, value)| (time - middle) * (value - level)).sum();
        (slope / spread, 1.0 / spread)
    });
    let lines: Vec<(f64, f64)> = lines.collect();
    let square = |pair: &[(f64, f64)]| (pair[1].0 - pair[0].0) * (pair[1].0 - pair[0].0) / (noise * (pair[0].1 + pair[1].1));
    lines.windows(2).map(square).filter(|square| square.is_finite()).collect()
}

/// Returns by how much errors that go on from frame to frame raise the variance of a slope: the median of the squares of its changes over that of independent errors, so
/// that a frame which stands out does not count. 1 if it is not above what chance does, or if the film is too short to tell.
fn growth_of_noise(mut squares: Vec<f64>) -> f64 {
    /// Fewest changes that tell.
    const FEW: usize = 5;
    /// Median of the square of a standard normal variable.
    const MEDIAN: f64 = 0.454_936;
    /// Standard deviations of the median of one such square, over that median.
    const SCATTER: f64 = 2.34;
    squares.sort_by(f64::total_cmp);
    let growth = squares.get(squares.len() / 2).map_or(1.0, |median| median / MEDIAN);
    let by_chance = 1.0 + 2.0 * SCATTER / (squares.len() as f64).sqrt();
    if squares.len() < FEW || growth < by_chance { 1.0 } else { growth }
}

/// Returns by how much the slope of the local line at a time is off, as far as the frames about it accelerate: the line is the mean of some of them.
fn drift(lowess: Lowess, film: &Record, at: f64) -> f64 {
    /// Lines whose frames tell the acceleration.
    const LINES: usize = 3;
    let (times, values) = (film.times(), film.values());
    let about = times.len().min(LINES * lowess.neighbors);
    let is_at_end = (at - times[0]).abs() > (times[times.len() - 1] - at).abs();
    let first = if is_at_end { times.len() - about } else { 0 };
    let (near, values) = (&times[first..first + about], &values[first..first + about]);
    // The part of the squares of the times that no line has.
    let middle = mean(near);
    let moment = |power: i32| near.iter().map(|time| (0..power).fold(1.0, |product, _| product * (time - middle))).sum::<f64>();
    let (square, cube, count) = (moment(2), moment(3), about as f64);
    let bend = |time: f64| (time - middle) * (time - middle) - cube / square * (time - middle) - square / count;
    let (sum, of_bend) = near.iter().zip(values).fold((0.0, 0.0), |(sum, squares), (time, value)| {
        let bend = bend(*time);
        (sum + bend * value, squares + bend * bend)
    });
    let acceleration = 2.0 * sum / of_bend;
    let parabola = near.iter().map(|time| 0.5 * (time - at) * (time - at)).collect();
    let line = Record::at_times(near.to_vec(), parabola)
        .and_then(|parabola| Lowess { robust_passes: 0, ..lowess }.smooth(&parabola))
        .and_then(|smoothed| smoothed.at(at));
    let drift = line.map_or(0.0, |line| acceleration * line.slope.value);
    if drift.is_finite() { drift } else { 0.0 }
}

fn mean(numbers: &[f64]) -> f64 {
    numbers.iter().sum::<f64>() / numbers.len() as f64
}

impl Analysis<'_> {
    /// Returns the closing speed and the restitution that a film shows.
    pub(super) fn film(&mut self, channel: &Channel) -> Option<Film> {
        let (record, settings) = (&channel.record, &self.of.settings);
        self.traces.push(plain(channel));
        if record.len() > MOST_FRAMES {
            let message = format!("it has {} frames; at most {MOST_FRAMES} are accepted", record.len());
            self.issues
                .push(Issue::at("too-many", channel.path.clone(), message).with_help("leave out frames before and after the contact"));
            return None;
        }
        let lowess = Lowess { neighbors: settings.neighbors.unwrap_or(NEIGHBORS), robust_passes: 3 };
        // Uniform motion in whole steps leaves no scatter, however coarse they are.
        let step = channel.step();
        let times = record.times();
        let smooth_part = |(part, at): (Range<usize>, f64)| {
            let part = Record::at_times(times[part.clone()].to_vec(), record.values()[part].to_vec())?;
            let smoothed = lowess.smooth(&part)?;
            let changes = changes_of_slope(&part, lowess.neighbors, smoothed.noise().max(step * step / 12.0));
            Ok((smoothed, changes, drift(lowess, &part, at)))
        };
        let (first, last) = (times[0], times[times.len() - 1]);
        let contact = settings.window.map_or(first.max(0.0), |window| window.from);
        let separation = settings.separation.or(settings.window.map(|window| window.to)).unwrap_or(last);
        self.notices.extend(unusual::duration(&channel.path, format!("by {} the contact lasts", channel.name), separation - contact));
        if separation <= contact {
            let message = Message::from("it is ")
                .figure(Measure::Time, separation)
                .text(", and the contact begins at ")
                .figure(Measure::Time, contact);
            self.issues
                .push(Issue::at("out-of-order", "separation", message).with_help("give the time at which the vehicle leaves the barrier"));
            return None;
        }
        // The frames before the contact alone: a local line must not reach into it. Nor must that of the separation, where the frames from it on are enough for one.
        let count = times.partition_point(|time| *time <= contact + ROUNDING * (last - first));
        let left = times.partition_point(|time| *time <= separation + ROUNDING * (last - first)).max(1) - 1;
        let [before, after]: [Result<_, TestIssues>; 2] =
            [(0..count, times[count.max(1) - 1]), (left..times.len(), separation)].map(smooth_part);
        let growth = growth_of_noise([&before, &after].into_iter().flatten().flat_map(|(_, changes, _)| changes.iter().copied()).collect());
        let [drift_before, drift_after] = [&before, &after].map(|part| part.as_ref().map_or(0.0, |(_, _, drift)| *drift));
        // What the step explains is known, and needs no wider distribution.
        let wide = |smoothed: Smoothed| smoothed.widened().with_noise_of_at_least(growth * step * step / 12.0);
        let grown = |(smoothed, ..): (Smoothed, Vec<f64>, f64)| {
            let noise = growth * smoothed.noise();
            wide(smoothed.with_noise_of_at_least(noise))
        };
        let slope = before.map(grown).and_then(|before| before.at(times[count - 1])).map(|line| line.slope);
        let of_film = slope.ok().map(|slope| Estimate { value: -slope.value, variance: slope.variance + drift_before * drift_before });
        let Some(closing) = settings.speed.or(of_film) else {
            let message = format!("{count} frames up to the contact are too few for a closing speed");
            let fewer = if count > FEWEST { " fewer `neighbors`," } else { "" };
            let help = format!("give `speed`,{fewer} or frames from before the contact");
            self.issues.push(Issue::at("no-closing-speed", channel.path.clone(), message).with_help(help));
            return None;
        };
        if let Some(filmed) = of_film.filter(|filmed| filmed.value <= 0.0) {
            let message = Message::from("before the contact it grows by ").figure(Measure::Speed, -filmed.value);
            let help = "a distance from the barrier falls before the contact: add or remove `polarity = -1`, or correct the window";
            self.issues.push(Issue::at("separating", channel.path.clone(), message).with_help(help));
            return None;
        }
        if let Some(filmed) = of_film.filter(|filmed| is_apart(*filmed, closing)) {
            let message = Message::from(format!("before the contact {} falls by ", channel.name))
                .figure(Measure::Speed, filmed.value)
                .text(", and `speed` is ")
                .figure(Measure::Speed, closing.value);
            self.notices.push(Notice::warning("speed-contradicts-film", "speed", message));
        }
        let path = if settings.separation.is_some() { "separation" } else { channel.path.as_str() };
        let smoothed = after.map(grown).or_else(|_| lowess.smooth(record).map(wide));
        let restitution = match smoothed.and_then(|smoothed| restitution_from_smoothed(&smoothed, separation, closing)) {
            Err(issues) if issues.iter().all(|issue| issue.place().is_some_and(|at| at.name == "restitution")) => {
                self.overflows(&channel.name);
                return None;
            }
            other => self.report(path, other)?,
        };
        let of_drift = drift_after / closing.value;
        let restitution = Estimate { variance: restitution.variance + of_drift * of_drift, ..restitution };
        let drift_before = if settings.speed.is_some() { 0.0 } else { drift_before };
        let parts = [
            ("before the contact", drift_before, closing.variance),
            ("after the separation", drift_after, restitution.variance * closing.value * closing.value),
        ];
        for (when, drift, variance) in parts {
            if drift * drift > 0.5 * variance {
                let message = Message::from(format!("{} bends {when}: a local line is off by about ", channel.name))
                    .figure(Measure::Speed, drift.abs())
                    .text(", which the standard deviation allows for; fewer `neighbors`, or frames at shorter intervals, are off by less");
                self.notices.push(Notice::note("film-bends", channel.path.clone(), message));
            }
        }
        if growth > 1.0 {
            let message = format!(
                "the errors of {} go on from frame to frame: they make its speeds {:.1} times as uncertain as independent ones",
                channel.name,
                growth.sqrt()
            );
            self.notices.push(Notice::note("correlated-frames", channel.path.clone(), message));
        }
        let (closing_speed, restitution) = (Uncertain::of(closing, true), Uncertain::of(restitution, true));
        self.plausible(
            &channel.name,
            "speed, the times of contact and separation, and that it goes on beyond the separation",
            &restitution,
        );
        Some(Film { channel: channel.name.clone(), closing_speed, separation, restitution })
    }
}
