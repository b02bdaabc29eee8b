//! From the channels of a recording to its answer: what each kind of channel tells is in a file of its own.

use planar_impact::barrier::{Estimate, Record, TestIssue, TestIssues, Window};
use planar_impact::{InputIssue, InputIssueKind, Issue as _};

use super::channel::greatest;
use super::recording::Channel;
use super::{Accelerated, Barrier, ChannelAnswer, ChannelQuantity, Kinematics, RecordAnswer, Recorder, Recording, Trace, Uncertain};
use crate::issue::{Cause, Issue, Issues};
use crate::message::Message;
use crate::notice::Notice;
use crate::units::Measure;

/// Rounding of times, as a share of the length of a record.
pub(super) const ROUNDING: f64 = 1e-9;

/// What an analysis collects.
pub(super) struct Analysis<'a> {
    pub(super) of: &'a Recording,
    pub(super) issues: Vec<Issue>,
    pub(super) notices: Vec<Notice>,
    pub(super) traces: Vec<Trace>,
}

/// Computes what a recording tells. Asks before each film, which takes longer than everything else, whether to go on.
pub(super) fn analyse(recording: &Recording, proceed: &dyn Fn() -> Result<(), Issues>) -> Result<(RecordAnswer, Vec<Notice>), Issues> {
    let mut all = Analysis { of: recording, issues: Vec::new(), notices: Vec::new(), traces: Vec::new() };
    let channels: Vec<ChannelAnswer> = recording.channels.iter().map(|channel| all.channel(channel)).collect();
    all.sums();
    let barrier = all.barrier();
    let of = |quantity: ChannelQuantity| recording.channels.iter().filter(move |channel| channel.quantity == quantity);
    let accelerations: Vec<Accelerated> = of(ChannelQuantity::Acceleration).filter_map(|channel| all.acceleration(channel)).collect();
    all.notices.extend(of_disagreement(recording, barrier.as_ref(), &accelerations));
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

/// Returns the times between which a time must lie, to the nanosecond: rounded further, a limit may lie beyond itself.
fn times_of(issue: &TestIssue) -> String {
    let TestIssue::Input(InputIssue { kind: InputIssueKind::OutOfRange { least, greatest: Some(greatest), .. }, .. }) = issue else {
        return String::new();
    };
    let [first, last] = [least, greatest].map(|time| (time * 1e9).round() / 1e9);
    format!(", {first} s to {last} s")
}

impl Analysis<'_> {
    pub(super) fn report<T>(&mut self, path: &str, result: Result<T, TestIssues>) -> Option<T> {
        self.report_of("", path, result)
    }

    /// The same with what is at fault before the message, where the path and the place do not say it.
    pub(super) fn report_of<T>(&mut self, whose: &str, path: &str, result: Result<T, TestIssues>) -> Option<T> {
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

    /// Reports a channel of a bank that is the sum of the others, with which every force counts twice. Where all have one shape, in
    /// coarse steps, one that carries half of the force is as much the sum of the others: that is warned of.
    fn sums(&mut self) {
        /// Share of the greatest force that all steps together are.
        const COARSE: f64 = 0.01;
        for quantity in [ChannelQuantity::NormalForce, ChannelQuantity::TangentialForce] {
            let bank: Vec<&Channel> = self.of.channels.iter().filter(|channel| channel.quantity == quantity).collect();
            if bank.len() < 3 {
                continue;
            }
            let values = |channel: &Channel, i: usize| channel.record.values().get(i).copied().unwrap_or(f64::NAN);
            let steps: f64 = bank.iter().map(|channel| channel.step()).sum();
            let is_sum = |sum: &&Channel| {
                let others =
                    |i: usize| bank.iter().filter(|channel| channel.path != sum.path).map(|channel| values(channel, i)).sum::<f64>();
                let peak = sum.record.values().iter().fold(0.0, |peak: f64, value| peak.max(value.abs()));
                (0..sum.record.len()).all(|i| (values(sum, i) - others(i)).abs() <= steps + ROUNDING * peak)
            };
            let parts = bank.iter().filter(|channel| channel.record.resolution().is_some()).count();
            if let Some(sum) = bank.iter().copied().find(is_sum).filter(|_| parts > 2) {
                let others = bank.iter().filter(|channel| channel.path != sum.path).map(|channel| channel.name.as_str());
                let others = others.collect::<Vec<_>>().join(" and ");
                let at = greatest(sum.record.values().iter().map(|value| value.abs()));
                let is_alike = |channel: &&Channel| {
                    let share = values(channel, at) / values(sum, at);
                    let slack = channel.step() + share.abs() * sum.step() + ROUNDING * values(channel, at).abs();
                    (0..sum.record.len()).all(|i| (values(channel, i) - share * values(sum, i)).abs() <= slack)
                };
                if steps > COARSE * values(sum, at).abs() && bank.iter().all(is_alike) {
                    let message =
                        format!("{} is the sum of {others}: if it is a total, every force counts twice; leave it out then", sum.name);
                    self.notices.push(Notice::warning("sum-of-others", sum.path.clone(), message));
                    continue;
                }
                let message = format!("it is the sum of {others}: every force would count twice");
                self.issues
                    .push(Issue::at("contradiction", sum.path.clone(), message).with_help("leave its column out, or those that it sums"));
            }
        }
    }

    /// Returns the window of the contact.
    pub(super) fn over(&self, record: &Record) -> Window {
        let times = record.times();
        self.of.settings.window.unwrap_or(Window { from: times[0].max(0.0), to: times[times.len() - 1] })
    }

    /// Returns the window of the unloaded channel before the contact, if the recording has one.
    pub(super) fn before(&self, record: &Record) -> Option<Window> {
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
    pub(super) fn windows(&mut self, record: &Record) -> Option<(Window, Option<Window>)> {
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

    /// Returns the restitution of the center of mass from its velocity change, e = ΔV/v − 1.
    pub(super) fn restitution(&mut self, source: &str, change: Estimate, is_known: bool) -> Option<Uncertain> {
        let ratio = change.over(self.of.settings.speed?);
        if !(ratio.value.is_finite() && ratio.variance.is_finite()) {
            self.overflows(source);
            return None;
        }
        let restitution = Estimate { value: ratio.value - 1.0, ..ratio };
        let restitution = Uncertain::of(restitution, is_known);
        self.plausible(source, "mass, speed, polarity, calibration and window", &restitution);
        Some(restitution)
    }

    pub(super) fn overflows(&mut self, source: &str) {
        let message = format!("the restitution by {source} overflows: the speed is next to zero");
        self.issues.push(Issue::at("overflow", "speed", message).with_help("give the closing speed of the test"));
    }

    /// Warns of a restitution that is not from 0 to 1, with what it was computed from.
    pub(super) fn plausible(&mut self, source: &str, from: &str, restitution: &Uncertain) {
        /// Standard deviations by which one between 0 and 1 may seem to lie outside.
        const MOST: f64 = 2.0;
        let outside = (-restitution.value).max(restitution.value - 1.0);
        if outside > MOST * restitution.sd.unwrap_or(0.0) + ROUNDING {
            let message = Message::from(format!("the restitution by {source} is "))
                .figure(Measure::Ratio, restitution.value)
                .text(format!(", and not from 0 to 1; check {from}"));
            self.notices.push(Notice::warning("implausible-restitution", "speed", message));
        }
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
        self.plausible(
            "the kinematics",
            "the velocities before and after, the point and the heading of the barrier",
            &kinematics.restitution,
        );
        Some(kinematics)
    }

    fn traces_of_recorder(&mut self) {
        let speeds = self.of.channels.iter().filter(|channel| channel.quantity.measure() == Measure::Speed);
        self.traces.extend(speeds.map(plain));
    }
}

/// Returns a warning of two measurements of one velocity change that differ by more than their noise and the calibration of sensors explain.
fn of_disagreement(of: &Recording, barrier: Option<&Barrier>, accelerations: &[Accelerated]) -> Option<Notice> {
    /// Standard deviations that are no chance.
    const MOST: f64 = 3.0;
    /// Share by which the calibrations of two sensors differ at most.
    const CALIBRATION: f64 = 0.05;
    let of_cells = barrier.and_then(|barrier| barrier.delta_v).map(|delta_v| ("the load cells", delta_v));
    let all: Vec<(&str, Uncertain)> =
        of_cells.into_iter().chain(accelerations.iter().map(|one| (one.channel.as_str(), one.delta_v))).collect();
    let ((first, one), others) = all.split_first()?;
    let differs = |(_, other): &&(&str, Uncertain)| {
        let by_chance = MOST * libm::hypot(one.sd.unwrap_or(0.0), other.sd.unwrap_or(0.0));
        (one.value - other.value).abs() > by_chance + CALIBRATION * one.value.abs().max(other.value.abs())
    };
    let (second, other) = others.iter().find(differs)?;
    let message = Message::from(format!("{first} and {second} give velocity changes of "))
        .figure(Measure::Speed, one.value)
        .text(" and ")
        .figure(Measure::Speed, other.value)
        .text(", which noise and calibration do not explain; check polarity, scale and place. As evidence the first counts");
    let path = of.channels.iter().find(|channel| channel.name == *second).map_or_else(String::new, |channel| channel.path.clone());
    Some(Notice::warning("sensors-disagree", path, message))
}

pub(super) fn plain(channel: &Channel) -> Trace {
    let (name, quantity, filter) = (channel.name.clone(), channel.quantity, None);
    Trace { name, quantity, filter, times: channel.record.times(), values: channel.record.values().to_vec(), unfiltered: None }
}
