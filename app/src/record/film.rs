//! The restitution by a film: the distance of a point from the barrier over time.

use std::ops::Range;

use planar_impact::barrier::{Estimate, Lowess, Record, restitution_from_smoothed};

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
        let smooth = |record: &Record| lowess.smooth(record).map(|smoothed| smoothed.with_noise_of_at_least(step * step / 12.0));
        let times = record.times();
        let smooth_part = |part: Range<usize>| {
            Record::at_times(times[part.clone()].to_vec(), record.values()[part].to_vec()).and_then(|part| smooth(&part))
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
        // The frames before the contact alone: a local line must not reach into it.
        let count = times.partition_point(|time| *time <= contact + ROUNDING * (last - first));
        let slope = smooth_part(0..count).and_then(|before| before.at(times[count - 1])).map(|line| line.slope);
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
        // Nor must that of the separation, where the frames from it on are enough for one.
        let left = times.partition_point(|time| *time <= separation + ROUNDING * (last - first)).max(1) - 1;
        let smoothed = smooth_part(left..times.len()).or_else(|_| smooth(record));
        let restitution = match smoothed.and_then(|smoothed| restitution_from_smoothed(&smoothed, separation, closing)) {
            Err(issues) if issues.iter().all(|issue| issue.place().is_some_and(|at| at.name == "restitution")) => {
                self.overflows(&channel.name);
                return None;
            }
            other => self.report(path, other)?,
        };
        let (closing_speed, restitution) = (Uncertain::of(closing, true), Uncertain::of(restitution, true));
        self.plausible(
            &channel.name,
            "speed, the times of contact and separation, and that it goes on beyond the separation",
            &restitution,
        );
        Some(Film { channel: channel.name.clone(), closing_speed, separation, restitution })
    }
}
