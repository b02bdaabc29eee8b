//! The verb `record`: impulse, velocity change and restitution from recorded channels, and what an event data recorder kept.

mod analysis;
mod channel;
mod cut;
mod film;
mod kinematics;
mod pulse;
mod recorder;
mod recording;
mod samples;

use std::cell::Cell;

use schemars::JsonSchema;
use serde::{Serialize, Serializer};

use planar_impact::barrier::{ChannelClass, Estimate};

use crate::answer::Answer;
use crate::control::Control;
use crate::issue::Issues;
use crate::named::positive_zero;
use crate::notice::Notices;
use crate::quantity::{self, Kind};
use crate::units::Measure;

pub(crate) use kinematics::FollowedPoint;
pub use kinematics::Kinematics;
pub use recorder::{AtImpact, AtTime, ClippedSensor, PreCrash, Recorder, VelocityChange};
pub use recording::Recording;
pub(crate) use recording::{ACCELEROMETER_RANGE, samples_of};

/// What a channel records.
#[derive(Clone, Copy, Debug, PartialEq, Eq, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ChannelQuantity {
    /// A force on the vehicle along the normal of the barrier, away from it.
    NormalForce,
    /// A force on the vehicle along the barrier, a quarter turn counter-clockwise from the normal force.
    TangentialForce,
    /// The acceleration of the center of mass along the normal, away from the barrier.
    Acceleration,
    /// The distance of a point from the barrier, from film.
    Distance,
    /// The longitudinal velocity change of a recorder, forward positive.
    DeltaVForward,
    /// The lateral velocity change of a recorder, to the left positive.
    DeltaVLeft,
    /// The same, to the right positive, as recorders store it.
    DeltaVRight,
    /// The speed of the vehicle before the impact.
    Speed,
}

/// The recordings of a call.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Records {
    /// Each recording, in the order of the call.
    pub records: Vec<RecordAnswer>,
}

/// What a recording tells, in SI.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct RecordAnswer {
    /// The name of the file.
    pub file: String,
    /// Its channels.
    pub channels: Vec<ChannelAnswer>,
    /// The load cells of the barrier; `null` without any.
    pub barrier: Option<Barrier>,
    /// Each acceleration.
    pub accelerations: Vec<Accelerated>,
    /// Each film.
    pub films: Vec<Film>,
    /// The event data recorder; `null` without one.
    pub recorder: Option<Recorder>,
    /// The restitution of a point from measured kinematics; left out without them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub kinematics: Option<Kinematics>,
    /// The channels for drawing: force channels summed by bank, filtered, less their baseline.
    pub traces: Vec<Trace>,
}

/// A number with its uncertainty.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Uncertain {
    /// The number, in SI.
    pub value: f64,
    /// Its standard deviation; `null` where the recording does not tell it.
    pub sd: Option<f64>,
}

/// A channel as it was read.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct ChannelAnswer {
    /// The name of its column.
    pub name: String,
    /// What it records.
    pub quantity: ChannelQuantity,
    /// The number of its samples.
    pub samples: usize,
    /// The time of its first sample, in s.
    pub from: f64,
    /// The time of its last sample, in s.
    pub to: f64,
    /// The time from one sample to the next, in s; `null` if it varies.
    pub period: Option<f64>,
    /// The least step between two values, in SI; `null` if all are equal.
    pub resolution: Option<f64>,
    /// Where it was driven beyond its range; `null` if it was not.
    pub clipped: Option<Clipped>,
    /// `true` if it ends before the event does.
    pub is_truncated: bool,
}

/// A stretch in which a channel was driven beyond its range.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Clipped {
    /// The value at which it stays, in SI.
    pub value: f64,
    /// The time of its first sample, in s.
    pub from: f64,
    /// The time of its last sample, in s.
    pub to: f64,
    /// The number of its samples.
    pub samples: usize,
}

/// The load cells of a barrier.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Barrier {
    /// Impulse along the normal, in N s; `null` without such channels.
    pub normal_impulse: Option<Uncertain>,
    /// Impulse along the barrier, in N s; `null` without such channels.
    pub tangential_impulse: Option<Uncertain>,
    /// Impulse ratio, tangential to normal; `null` unless both are recorded.
    pub impulse_ratio: Option<Uncertain>,
    /// The greatest normal force of the filtered channels; `null` without such channels.
    pub peak_force: Option<Peak>,
    /// Velocity change along the normal, in m/s; `null` without a mass.
    pub delta_v: Option<Uncertain>,
    /// Restitution of the center of mass along the normal; `null` without a mass and a speed.
    pub restitution: Option<Uncertain>,
}

/// An acceleration, integrated.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Accelerated {
    /// The name of its column.
    pub channel: String,
    /// Velocity change, in m/s.
    pub delta_v: Uncertain,
    /// Impulse, in N s; `null` without a mass.
    pub impulse: Option<Uncertain>,
    /// The greatest acceleration of the filtered channel.
    pub peak: Peak,
    /// Restitution of the center of mass along the normal; `null` without a speed.
    pub restitution: Option<Uncertain>,
}

/// The distance of a point from the barrier, smoothed and differentiated.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Film {
    /// The name of its column.
    pub channel: String,
    /// Closing speed of the point, in m/s.
    pub closing_speed: Uncertain,
    /// The time at which the point has separated, in s.
    pub separation: f64,
    /// Restitution of the point.
    pub restitution: Uncertain,
}

/// The extreme value of a trace.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Peak {
    /// The value, in SI.
    pub value: f64,
    /// Its time, in s.
    pub time: f64,
}

/// A channel or a bank over time.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Trace {
    /// Its name.
    pub name: String,
    /// What it records.
    pub quantity: ChannelQuantity,
    /// The channel frequency class that it is filtered to; `null` if it is not.
    pub filter: Option<i32>,
    /// Times, in s.
    pub times: Vec<f64>,
    /// Values, in SI.
    pub values: Vec<f64>,
    /// Values before the filter, in SI; `null` if it is not filtered.
    pub unfiltered: Option<Vec<f64>>,
}

/// Analyses recordings.
///
/// # Errors
///
/// Every reason for which a recording tells nothing.
pub fn record(recordings: &[Recording], _: &(), control: &dyn Control) -> Result<Answer<Records>, Issues> {
    let (mut records, mut notices) = (Vec::new(), Vec::new());
    let films = |recording: &Recording| recording.channels.iter().filter(|channel| channel.quantity == ChannelQuantity::Distance).count();
    let steps = recordings.iter().map(|recording| 1 + films(recording)).sum();
    let done = Cell::new(0);
    let proceed = || control.proceed(done.replace(done.get() + 1), steps);
    let analysed = recordings.iter().map(|recording| {
        proceed()?;
        analysis::analyse(recording, &proceed)
    });
    for (recording, (record, found)) in recordings.iter().zip(Issues::all(analysed)?) {
        let of_file = |mut notice: crate::Notice| {
            if recordings.len() > 1 {
                notice.message = crate::Message::from(format!("{}: ", recording.name)).join(notice.message);
            }
            notice
        };
        notices.extend(recording.notices.0.iter().cloned().chain(found).map(of_file));
        records.push(record);
    }
    let title = if let [one] = recordings { one.title.as_str() } else { "" };
    Ok(Answer::new(title, Records { records }, Notices(notices)))
}

impl Answer<Records> {
    /// Returns `true` if no channel is clipped or truncated, nor the sensor behind it, and every restitution is from 0 to 1 within its error.
    pub fn is_whole(&self) -> bool {
        let is_lawful = !self.notices.0.iter().any(|notice| notice.code == "implausible-restitution");
        let sensors_hold = |record: &RecordAnswer| record.recorder.as_ref().is_none_or(|recorder| recorder.clipped_sensors.is_empty());
        let records = &self.facts.records;
        is_lawful
            && records.iter().all(sensors_hold)
            && records.iter().flat_map(|record| &record.channels).all(|channel| channel.clipped.is_none() && !channel.is_truncated)
    }
}

impl Uncertain {
    fn of(estimate: Estimate, is_known: bool) -> Uncertain {
        Uncertain { value: positive_zero(estimate.value), sd: is_known.then(|| estimate.deviation()) }
    }
}

impl ChannelQuantity {
    const ALL: [ChannelQuantity; 8] = [
        ChannelQuantity::NormalForce,
        ChannelQuantity::TangentialForce,
        ChannelQuantity::Acceleration,
        ChannelQuantity::Distance,
        ChannelQuantity::DeltaVForward,
        ChannelQuantity::DeltaVLeft,
        ChannelQuantity::DeltaVRight,
        ChannelQuantity::Speed,
    ];

    /// Returns its name in files, such as `normal_force`.
    pub fn name(self) -> &'static str {
        match self {
            ChannelQuantity::NormalForce => "normal_force",
            ChannelQuantity::TangentialForce => "tangential_force",
            ChannelQuantity::Acceleration => "acceleration",
            ChannelQuantity::Distance => "distance",
            ChannelQuantity::DeltaVForward => "delta_v_forward",
            ChannelQuantity::DeltaVLeft => "delta_v_left",
            ChannelQuantity::DeltaVRight => "delta_v_right",
            ChannelQuantity::Speed => "speed",
        }
    }

    /// Returns every name.
    pub fn names() -> [&'static str; 8] {
        Self::ALL.map(Self::name)
    }

    /// Returns the quantity that the name of a column says: up to the first dot, as in `normal_force.left`.
    pub fn of_column(name: &str) -> Option<ChannelQuantity> {
        let quantity = name.split('.').next().unwrap_or_default();
        Self::ALL.into_iter().find(|known| known.name() == quantity)
    }

    /// Returns the name of a channel that a column with another name most likely means, as `Delta V forward` does.
    fn meant_by(name: &str) -> Option<&'static str> {
        let words = name.split('.').next().unwrap_or_default().replace([' ', '-'], "_");
        quantity::nearest(&words, Self::names().into_iter())
    }

    /// Returns the measure of its values.
    pub fn measure(self) -> Measure {
        match self {
            ChannelQuantity::NormalForce | ChannelQuantity::TangentialForce => Measure::Force,
            ChannelQuantity::Acceleration => Measure::Acceleration,
            ChannelQuantity::Distance => Measure::Length,
            _ => Measure::Speed,
        }
    }

    fn kind(self) -> Kind {
        self.measure().into()
    }

    /// Returns the measure of the integral of a force or an acceleration.
    fn integral(self) -> Measure {
        if self.measure() == Measure::Force { Measure::Impulse } else { Measure::Speed }
    }

    /// Returns the class of filter that the standard has for it: 60 for the forces of a barrier, 180 for an acceleration to be integrated.
    fn class(self) -> Option<ChannelClass> {
        match self.measure() {
            Measure::Force => Some(ChannelClass::Cfc60),
            Measure::Acceleration => Some(ChannelClass::Cfc180),
            _ => None,
        }
    }

    /// Returns `true` if it keeps its last value, as a velocity change does, where a pulse ends at zero.
    fn is_running(self) -> bool {
        matches!(self, ChannelQuantity::DeltaVForward | ChannelQuantity::DeltaVLeft | ChannelQuantity::DeltaVRight)
    }
}

impl Serialize for ChannelQuantity {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Source;
    use crate::control::Noted;

    /// Each recording is a step, and each film in it another.
    #[test]
    fn recordings_and_films_are_steps() {
        let rows: String = (-12..=12).map(|i: i32| format!("{},{}\n", 10 * i, if i < 0 { -100 * i } else { 15 * i })).collect();
        let of = |name: &str| {
            let source = Source::new(name, format!("time [ms],distance [mm]\n{rows}"));
            Recording::parse_by(source, |_| panic!("it names no file")).expect("a film")
        };
        let steps = Noted::default();
        record(&[of("a.csv"), of("b.csv")], &(), &steps).expect("an answer");
        assert_eq!(steps.steps(), [(0, 4), (1, 4), (2, 4), (3, 4)]);
    }
}
