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
        let smooth_part = |part: Range<usize>| {
            let part = Record::at_times(times[part.clone()].to_vec(), record.values()[part].to_vec())?;
            let smoothed = lowess.smooth(&part)?;
            let changes = changes_of_slope(&part, lowess.neighbors, smoothed.noise().max(step * step / 12.0));
            Ok((smoothed, changes))
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
        let [before, after]: [Result<_, TestIssues>; 2] = [0..count, left..times.len()].map(smooth_part);
        let growth = growth_of_noise([&before, &after].into_iter().flatten().flat_map(|(_, changes)| changes.iter().copied()).collect());
        // What the step explains is known, and needs no wider distribution.
        let wide = |smoothed: Smoothed| smoothed.widened().with_noise_of_at_least(growth * step * step / 12.0);
        let grown = |(smoothed, _): (Smoothed, Vec<f64>)| {
            let noise = growth * smoothed.noise();
            wide(smoothed.with_noise_of_at_least(noise))
        };
        let slope = before.map(grown).and_then(|before| before.at(times[count - 1])).map(|line| line.slope);
        let of_film = slope.ok().map(|slope| Estimate { value: -slope.value, ..slope });
        let Some(closing) = settings.speed.or(of_film) else {
            let message = format!("{count} frames up to the contact are too few for a closing speed");
            let help = "give `speed`, fewer `neighbors`, or frames from before the contact";
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
