//! What an event data recorder kept: velocity changes over time, and speeds before the impact.

use planar_impact::barrier::Record;
use planar_impact::{Distribution, ForceDirection, ForwardLeft};
use schemars::JsonSchema;
use serde::Serialize;

use super::analysis::ROUNDING;
use super::channel::{Scatter, greatest, scatter, stretch};
use super::cut::FULL_BRAKING;
use super::recording::Channel;
use super::{ChannelQuantity, Recording, Uncertain};
use crate::issue::Issue;
use crate::message::Message;
use crate::notice::Notice;
use crate::units::Measure;
use crate::unusual;

/// What an event data recorder kept, in SI and radians.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Recorder {
    /// The longitudinal velocity change of greatest magnitude, forward positive; `null` if it is not recorded.
    pub delta_v_forward: Option<AtTime>,
    /// The lateral velocity change of greatest magnitude, to the left positive; `null` if it is not recorded.
    pub delta_v_left: Option<AtTime>,
    /// The greatest velocity change of both together; `null` unless both are recorded.
    pub maximum: Option<VelocityChange>,
    /// `true` if a velocity change, or the sensor behind it, is clipped or truncated: the true one is greater.
    pub is_lower_bound: bool,
    /// Velocity changes at the rate of the greatest acceleration that the sensors hold, where the recording says how much that is.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    #[schemars(default)]
    pub clipped_sensors: Vec<ClippedSensor>,
    /// Speeds before the impact.
    pub pre_crash: Vec<PreCrash>,
    /// The speed at the impact; `null` if no speed is recorded.
    pub speed_at_impact: Option<AtImpact>,
}

/// A stretch in which the acceleration was beyond what the sensor holds.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct ClippedSensor {
    /// The name of the column of the velocity change.
    pub channel: String,
    /// The greatest acceleration of the record, in m/s².
    pub acceleration: f64,
    /// When it begins, in s.
    pub from: f64,
    /// When it ends, in s.
    pub to: f64,
}

/// A value with its uncertainty and its time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct AtTime {
    /// The value in m/s.
    #[serde(flatten)]
    pub number: Uncertain,
    /// Its time, in s.
    pub time: f64,
}

/// The greatest velocity change.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct VelocityChange {
    /// Its time, in s.
    pub time: f64,
    /// Its magnitude, in m/s.
    pub magnitude: Uncertain,
    /// Its longitudinal component at that time, forward positive, in m/s.
    pub forward: Uncertain,
    /// Its lateral component at that time, to the left positive, in m/s.
    pub left: Uncertain,
    /// Principal direction of force, clockwise from straight ahead, in rad; `null` without a velocity change.
    pub pdof: Option<Uncertain>,
}

/// A row of the table of speeds before the impact.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct PreCrash {
    /// The time, in s; zero is the impact.
    pub time: f64,
    /// The speed, in m/s.
    pub speed: f64,
}

/// The speed at the impact: the last one that was stored before it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct AtImpact {
    /// The speed in m/s, and its standard deviation: that of the resolution, and what it may have changed by since it was stored.
    #[serde(flatten)]
    pub number: Uncertain,
    /// When it was stored, in s.
    pub time: f64,
}

/// The resolution of a channel and its relative standard deviation.
#[derive(Clone, Copy)]
struct Noise {
    step: Option<f64>,
    relative: f64,
    /// By which readings scatter, beyond their steps.
    scatter: Scatter,
}

impl Noise {
    /// Returns the noise of each of the channels, which are stored in the same steps but where all readings of one lie coarser steps apart.
    fn of_each<const N: usize>(recording: &Recording, all: [Option<&Channel>; N], notices: &mut Vec<Notice>) -> [Option<Noise>; N] {
        let channels: Vec<&Channel> = all.into_iter().flatten().collect();
        let found = channels.iter().filter_map(|channel| channel.record.resolution()).reduce(f64::min);
        let given = recording.settings.resolution;
        if given.is_none() && !channels.is_empty() {
            let name = channels.iter().map(|channel| channel.name.as_str()).collect::<Vec<_>>().join(" and ");
            let message = match found {
                Some(step) => {
                    Message::from(format!("the resolution of {name} is taken as ")).figure(Measure::Speed, step).text(", the least step")
                }
                None => Message::from(format!("{name}: constant, which does not tell the resolution: the standard deviation is not known")),
            };
            notices.push(Notice::note("resolution-assumed", channels[0].path.clone(), message));
        }
        let common = given.or(found);
        let mut of = |channel: &Channel| {
            // All readings of a finer recorder are no multiples of coarser steps. A channel that is constant has no steps.
            let printed = channel.record.resolution().map(|_| channel.step());
            let coarser = common.zip(printed).filter(|(common, printed)| *printed > 1.5 * common);
            if let Some((common, printed)) = coarser {
                let whose = if given.is_some() { " of `resolution`" } else { " of the other channel" };
                let message = Message::from(format!("all readings of {} lie whole steps of ", channel.name))
                    .figure(Measure::Speed, printed)
                    .text(" apart: that is taken as its resolution, and not the ")
                    .figure(Measure::Speed, common)
                    .text(whose);
                notices.push(Notice::warning("resolution-coarser", channel.path.clone(), message));
            }
            Noise {
                step: coarser.map(|(_, printed)| printed).or(common),
                relative: recording.settings.relative,
                scatter: Scatter::default(),
            }
        };
        all.map(|channel| channel.map(&mut of))
    }

    /// Returns the standard deviation of a reading. The greatest of many that scatter is too great by about twice the scatter.
    fn sd(self, value: f64) -> Option<f64> {
        self.step.map(|step| {
            libm::hypot(libm::hypot(step / 12.0_f64.sqrt(), self.relative * value), 2.0 * self.scatter.deviation.unwrap_or(0.0))
        })
    }
}

/// A component of the velocity change: its channel, its values with the sign of the answer, and its noise.
struct Component<'a> {
    channel: &'a Channel,
    times: Vec<f64>,
    values: Vec<f64>,
    noise: Noise,
}

impl<'a> Component<'a> {
    fn of(channel: &'a Channel, noise: Noise) -> Component<'a> {
        let sign = if channel.quantity == ChannelQuantity::DeltaVRight { -1.0 } else { 1.0 };
        let values: Vec<f64> = channel.record.values().iter().map(|value| sign * value).collect();
        let noise = Noise { scatter: scatter(&values, noise.step.unwrap_or(0.0)), ..noise };
        Component { channel, times: channel.record.times(), values, noise }
    }

    /// Notes that the readings scatter, or warns that too few would show it.
    fn of_scatter(&self) -> Option<Notice> {
        let (Scatter { deviation, readings }, name, path) = (self.noise.scatter, &self.channel.name, self.channel.path.clone());
        let Some(deviation) = deviation else {
            let is_whole = self.channel.record.resolution().is_some() && self.channel.cut(None).is_none();
            let message = || {
                format!(
                    "{name} has too few readings after its change to show whether they scatter, which would make the greatest too great: its standard deviation is that of its steps alone"
                )
            };
            return is_whole.then(|| Notice::warning("plateau-short", path, message()));
        };
        let message = Message::from(format!("{name} scatters by up to "))
            .figure(Measure::Speed, deviation)
            .text(format!(", as far as {readings} readings show: the greatest of such readings is too great; its standard deviation includes twice the scatter"));
        (deviation > 0.0).then(|| Notice::note("readings-scatter", path, message))
    }

    /// Returns where the velocity changes as fast as a sensor of some range can tell, to within the resolution of the record; `None` if that is nowhere, or if
    /// the record is too coarse to say.
    fn clipped_sensor(&self, range: f64) -> Option<ClippedSensor> {
        let step = self.step();
        let is_at_range = |i: &usize| {
            let most = range * (self.times[i + 1] - self.times[*i]);
            most > 2.0 * step && (self.values[i + 1] - self.values[*i]).abs() >= most - step - ROUNDING * most
        };
        let mut at: Vec<usize> = (0..self.times.len() - 1).filter(is_at_range).collect();
        let (first, last) = (*at.first()?, *at.last()?);
        let rate = |i: usize| ((self.values[i + 1] - self.values[i]) / (self.times[i + 1] - self.times[i])).abs();
        at.sort_by(|one, other| rate(*other).total_cmp(&rate(*one)));
        let channel = self.channel.name.clone();
        Some(ClippedSensor { channel, acceleration: rate(at[0]), from: self.times[first], to: self.times[last + 1] })
    }

    /// Warns of a velocity change that is not about time zero, where a recorder puts the impact and which the speed at impact is of.
    fn away_from_zero(&self) -> Option<Notice> {
        /// In s: recorders wake within a tenth of it.
        const NEAR: f64 = 0.5;
        /// Of the greatest change, beyond which the impact has begun.
        const BEGUN: f64 = 0.2;
        let (first, greatest) = (self.values.first()?, self.values[self.greatest()].abs());
        let begins = self.values.iter().position(|value| (value - first).abs() > BEGUN * greatest)?;
        let at = self.times[begins];
        let message = || {
            Message::from(format!("{} begins to change at ", self.channel.name))
                .figure(Measure::Time, at)
                .text(": times must count from the impact, which the speed at impact is of")
        };
        (at.abs() > NEAR).then(|| Notice::warning("impact-not-at-zero", self.channel.path.clone(), message()))
    }

    /// Returns the step of its readings, zero if it is not known.
    fn step(&self) -> f64 {
        self.noise.step.unwrap_or(0.0)
    }

    /// Returns the place of its greatest reading.
    fn greatest(&self) -> usize {
        greatest(self.values.iter().map(|value| value.abs()))
    }

    /// Returns a reading. What it changed by since the impact may have ended is uncertain: it may be of the impact, or of tires.
    fn reading(&self, at: usize, ended: usize) -> Uncertain {
        let value = self.values[at];
        let change = (value - self.values[ended]).abs();
        // Either end is rounded.
        let of_tires = if ended == at { 0.0 } else { (change + 0.5 * self.step()) / Distribution::NORMAL_95 };
        Uncertain { value: value + 0.0, sd: self.noise.sd(value).map(|sd| libm::hypot(sd, of_tires)) }
    }

    /// Returns its greatest reading, where the impact may have ended at some reading before it.
    fn extreme(&self, ended: usize) -> AtTime {
        let at = self.greatest();
        AtTime { number: self.reading(at, ended), time: self.times[at] }
    }

    /// Notes that it goes on changing no faster than by braking.
    fn goes_on(&self, ended: usize) -> Option<Notice> {
        let at = self.greatest();
        let change = self.values[at] - self.values[ended];
        let message = || {
            Message::from(format!("{} changes by ", self.channel.name))
                .figure(Measure::Speed, change)
                .join(stretch(self.times[ended], self.times[at]))
                .text(", no faster than by braking: its standard deviation allows for an impact that ended before; leave out the later rows if it did")
        };
        (change != 0.0).then(|| Notice::note("change-goes-on", self.channel.path.clone(), message()))
    }
}

/// Returns the first reading from which the velocity changes no more up to another than full braking would change it: the impact may have ended there, and tires have done the rest.
fn ended(components: &[&Component<'_>], at: usize) -> usize {
    let rounding = 0.5 * components.iter().map(|component| component.step()).fold(0.0, f64::max);
    let is_slow = |i: &usize| {
        let changes = components.iter().map(|component| component.values[at] - component.values[*i]);
        let change = changes.fold(0.0, libm::hypot);
        components.first().is_some_and(|first| change <= FULL_BRAKING * (first.times[at] - first.times[*i]) + rounding)
    };
    (0..at).find(is_slow).unwrap_or(at)
}

impl Recorder {
    /// Returns what the channels of a recorder tell; `None` without any.
    pub(super) fn of(recording: &Recording, issues: &mut Vec<Issue>, notices: &mut Vec<Notice>) -> Option<Recorder> {
        use ChannelQuantity as Q;
        let mut one = |quantities: &[Q]| -> Option<&Channel> {
            let mut found = recording.channels.iter().filter(|channel| quantities.contains(&channel.quantity));
            let first = found.next();
            for other in found {
                let names: Vec<&str> = quantities.iter().map(|quantity| quantity.name()).collect();
                let help = format!("keep one of them: {}", names.join(" or "));
                issues.push(Issue::at("contradiction", other.path.clone(), "a recorder has one channel of this kind").with_help(help));
            }
            first
        };
        let (forward, left, speed) = (one(&[Q::DeltaVForward]), one(&[Q::DeltaVLeft, Q::DeltaVRight]), one(&[Q::Speed]));
        if forward.is_none() && left.is_none() && speed.is_none() {
            return None;
        }
        let [of_forward, of_left] = Noise::of_each(recording, [forward, left], notices);
        let [forward, left] =
            [forward.zip(of_forward), left.zip(of_left)].map(|found| found.map(|(channel, noise)| Component::of(channel, noise)));
        let maximum = forward.as_ref().zip(left.as_ref()).and_then(|(forward, left)| both(forward, left, issues));
        let components = || forward.iter().chain(&left);
        // Of both together, where they are read at the same times.
        let ended = |component: &Component<'_>| match (&forward, &left, &maximum) {
            (Some(forward), Some(left), Some(_)) => ended(&[forward, left], component.greatest()),
            _ => ended(&[component], component.greatest()),
        };
        notices.extend(components().filter_map(Component::of_scatter));
        notices.extend(components().filter_map(|component| component.goes_on(ended(component))));
        for component in components() {
            let path = &component.channel.path;
            let duration = component.times.last().zip(component.times.first()).map_or(0.0, |(last, first)| last - first);
            notices.extend(unusual::duration(path, format!("{} is recorded over", component.channel.name), duration));
            notices.extend(unusual::speed(path, component.values[component.greatest()]));
        }
        let is_dead = |component: &Component<'_>| component.channel.record.resolution().is_none();
        if let Some(first) = components().next().filter(|_| components().all(is_dead)) {
            let message = format!("{} is constant: it has no velocity change of an impact in it", first.channel.name);
            notices.push(Notice::warning("no-event", first.channel.path.clone(), message));
        }
        let mut pre_crash: Vec<PreCrash> = speed.iter().flat_map(|speed| rows(&speed.record)).collect();
        let [of_speed] = Noise::of_each(recording, [speed], notices);
        let speed_at_impact = speed.zip(of_speed).and_then(|(speed, noise)| {
            let after = after_impact(&mut pre_crash);
            if after > 0 {
                let message = format!(
                    "{} of {} speeds are later than the impact, and not used: times count from the impact, and those before it are negative",
                    after,
                    after + pre_crash.len()
                );
                notices.push(Notice::warning("after-impact", speed.path.clone(), message));
            }
            notices.extend(of_jump(&pre_crash, noise, &speed.path));
            at_impact(&pre_crash, noise, &speed.path, issues, notices)
        });
        for component in components() {
            if let (Some(first), Some(step)) = (component.values.first(), component.noise.step)
                && component.times[0] >= 0.0
                && first.abs() > 2.0 * step
            {
                let message = Message::from(format!("{} begins at ", component.channel.name))
                    .figure(Measure::Time, component.times[0])
                    .text(" with ")
                    .figure(Measure::Speed, *first)
                    .text(": the impact had begun before it");
                notices.push(Notice::warning("begins-late", component.channel.path.clone(), message));
            }
        }
        notices.extend(components().find_map(Component::away_from_zero));
        let range = recording.settings.accelerometer_range;
        let clipped_sensors: Vec<ClippedSensor> =
            range.map_or_else(Vec::new, |range| components().filter_map(|component| component.clipped_sensor(range)).collect());
        for (sensor, range) in clipped_sensors.iter().zip(range.into_iter().cycle()) {
            let message = Message::from(format!("the sensor of {} is clipped:", sensor.channel))
                .join(stretch(sensor.from, sensor.to))
                .text(" the velocity changes by up to ")
                .figure(Measure::Acceleration, sensor.acceleration)
                .text(", and it holds ")
                .figure(Measure::Acceleration, range)
                .text("; the true velocity change is greater");
            notices.push(Notice::warning("sensor-clipped", sensor.channel.clone(), message));
        }
        Some(Recorder {
            delta_v_forward: forward.as_ref().map(|forward| forward.extreme(ended(forward))),
            delta_v_left: left.as_ref().map(|left| left.extreme(ended(left))),
            maximum,
            is_lower_bound: !clipped_sensors.is_empty()
                || components().any(|of| of.channel.clipped().is_some() || of.channel.cut(None).is_some()),
            clipped_sensors,
            pre_crash,
            speed_at_impact,
        })
    }
}

/// Returns the greatest velocity change of two components that are sampled at the same times.
fn both(forward: &Component<'_>, left: &Component<'_>, issues: &mut Vec<Issue>) -> Option<VelocityChange> {
    let period = forward.times.last()? - forward.times.first()?;
    let is_same = |(one, other): (&f64, &f64)| (one - other).abs() <= 1e-9 * period;
    if forward.times.len() != left.times.len() || !forward.times.iter().zip(&left.times).all(is_same) {
        let message = format!("it must be sampled at the same instants as {}", forward.channel.name);
        let help = "list both velocity changes in the same rows, or record them in two files";
        issues.push(Issue::at("instants-differ", left.channel.path.clone(), message).with_help(help));
        return None;
    }
    let at = greatest(forward.values.iter().zip(&left.values).map(|(forward, left)| libm::hypot(*forward, *left)));
    let (f, l) = (forward.values[at], left.values[at]);
    let ended = ended(&[forward, left], at);
    let [of_forward, of_left] = [forward, left].map(|component| component.reading(at, ended));
    let sds = of_forward.sd.zip(of_left.sd);
    let magnitude = libm::hypot(f, l);
    let pdof = ForceDirection::of_push(ForwardLeft { forward: f, left: l }).direction();
    // To first order; the two components are independent.
    let along = |by: [f64; 2]| sds.map(|(sd_f, sd_l)| libm::hypot(by[0] * sd_f, by[1] * sd_l));
    let is_moving = magnitude > 0.0;
    Some(VelocityChange {
        time: forward.times[at],
        magnitude: Uncertain { value: magnitude, sd: if is_moving { along([f / magnitude, l / magnitude]) } else { along([1.0, 1.0]) } },
        forward: of_forward,
        left: of_left,
        pdof: is_moving.then(|| Uncertain { value: pdof, sd: along([l / magnitude / magnitude, f / magnitude / magnitude]) }),
    })
}

fn rows(record: &Record) -> impl Iterator<Item = PreCrash> {
    record.times().into_iter().zip(record.values().to_vec()).map(|(time, speed)| PreCrash { time, speed })
}

/// Removes the rows after the impact, and returns how many there were.
fn after_impact(rows: &mut Vec<PreCrash>) -> usize {
    let count = rows.len();
    rows.truncate(rows.partition_point(|row| row.time <= slack_of(rows)));
    count - rows.len()
}

/// Returns the rounding of the times of rows.
fn slack_of(rows: &[PreCrash]) -> f64 {
    rows.first().zip(rows.last()).map_or(0.0, |(first, last)| ROUNDING * (last.time - first.time))
}

/// Returns a warning of speeds before the impact that change faster than a vehicle brakes.
fn of_jump(before: &[PreCrash], noise: Noise, path: &str) -> Option<Notice> {
    /// As a multiple of the acceleration of full braking.
    const MOST: f64 = 2.0;
    let step = noise.step.unwrap_or(0.0);
    let is_jump = |(one, other): &(&PreCrash, &PreCrash)| {
        let most = MOST * FULL_BRAKING * (other.time - one.time) + 2.0 * step;
        (other.speed - one.speed).abs() > most
    };
    let (one, other) = before.iter().zip(before.iter().skip(1)).find(is_jump)?;
    let message = Message::from("the speed changes from ")
        .figure(Measure::Speed, one.speed)
        .text(" to ")
        .figure(Measure::Speed, other.speed)
        .text(" within ")
        .figure(Measure::Time, other.time - one.time)
        .text(" before the impact, which neither brakes nor an engine do: check its sign, and whether a number marks a missing reading");
    Some(Notice::warning("speed-jumps", path, message))
}

/// Returns the last speed that was stored up to the impact. It may have changed since: at the rate at which it changed last, or by braking that began later, which
/// is within the 95 % interval.
fn at_impact(before: &[PreCrash], noise: Noise, path: &str, issues: &mut Vec<Issue>, notices: &mut Vec<Notice>) -> Option<AtImpact> {
    let Some(last) = before.last() else {
        let help = "count the times from the impact: those before it are negative";
        issues.push(Issue::at("no-speed-before-impact", path, "no speed is at or before the time zero").with_help(help));
        return None;
    };
    let rate = match before {
        [.., one, other] => (other.speed - one.speed) / (other.time - one.time),
        _ => 0.0,
    };
    let age = if last.time < -slack_of(before) { -last.time } else { 0.0 };
    // Braking ends at a standstill.
    let of_braking = (FULL_BRAKING * age).min(last.speed.abs());
    let change = (rate * age).abs().max(of_braking / Distribution::NORMAL_95);
    if change > 0.0 {
        let message = Message::from("the last speed is ")
            .figure(Measure::Time, age)
            .text(" older than the impact: full braking since would have taken ")
            .figure(Measure::Speed, of_braking)
            .text(" from it, and at its last rate it would have changed by ")
            .figure(Measure::Speed, rate * age)
            .text(", which its standard deviation allows for");
        notices.push(Notice::warning("speed-before-impact", path, message));
    }
    let number = Uncertain { value: last.speed, sd: noise.sd(last.speed).map(|sd| libm::hypot(sd, change)) };
    Some(AtImpact { number, time: last.time })
}
