//! Whether a channel lacks an end of the event: whether a pulse or a velocity change is over where the record ends.

use std::f64::consts::PI;

use planar_impact::barrier::Window;

use super::ChannelQuantity;
use super::channel::scatter;
use super::recording::Channel;

/// The end of an event that a record lacks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Cut {
    Beginning,
    End,
}

/// Standard deviations that are no chance.
const SURE: f64 = 3.0;

/// The greatest deceleration of a vehicle that brakes, in m/s²: 0.8 g.
pub(super) const FULL_BRAKING: f64 = 0.8 * planar_impact::STANDARD_GRAVITY;

impl Channel {
    /// Returns which end of the event the record lacks. Its end: a pulse is above a tenth of its height at the last sample, or a [velocity change still
    /// changes](Self::still_changes). Its beginning: a pulse is above a tenth of its height at the first sample. In each case by more than two steps and more than the
    /// noise. A pulse counts from its mean over the window before the contact, or from zero without one, and then only its beginning can be missing.
    pub(super) fn cut(&self, before: Option<Window>) -> Option<Cut> {
        let values = self.record.values();
        let (first, last) = (values[0], values[values.len() - 1]);
        let mut slack = 2.0 * self.record.resolution().unwrap_or(0.0);
        let (unloaded, late, left) = match self.quantity {
            ChannelQuantity::Distance | ChannelQuantity::Speed => return None,
            quantity if quantity.is_running() => return self.still_changes().then_some(Cut::End),
            _ => {
                // A window without a mean is reported where the channel is integrated.
                let mean = before.and_then(|before| self.record.baseline(&before).ok());
                let unloaded = mean.map_or(0.0, |mean| mean.value);
                slack = slack.max(SURE * mean.map_or(0.0, |mean| mean.deviation()));
                (unloaded, if before.is_none() { first.abs() } else { 0.0 }, (last - unloaded).abs())
            }
        };
        let height = values.iter().map(|value| (value - unloaded).abs()).fold(0.0, f64::max);
        let is_missing = |left: f64| left > (0.1 * height).max(slack);
        if is_missing(left) { Some(Cut::End) } else { is_missing(late).then_some(Cut::Beginning) }
    }

    /// Returns `true` if a velocity change goes on at the last reading, or does not show that it stands still: a change of few steps hardly shows rates.
    fn still_changes(&self) -> bool {
        /// Steps of a change of which the last tenth of a ramp has too few to show its rate.
        const FEW_STEPS: f64 = 25.0;
        let (times, values) = (self.record.times(), self.record.values());
        // Two readings show no end of the change, whatever their step.
        if values.len() < 3 {
            return values[0] != values[values.len() - 1];
        }
        let change = Change::of(&times, values, self.step());
        change.goes_on() || (0.0 < change.height && change.height < FEW_STEPS * change.step && !change.stands_still())
    }
}

/// A velocity change up to its last reading.
struct Change<'a> {
    times: &'a [f64],
    values: &'a [f64],
    step: f64,
    /// The last reading before it begins.
    begun: usize,
    /// The last reading.
    end: usize,
    /// Its greatest magnitude.
    height: f64,
    /// By how much two readings that scatter differ without any change.
    by_chance: f64,
}

impl<'a> Change<'a> {
    /// A change by one step is rounding.
    const STEPS: f64 = 1.5;

    fn of(times: &'a [f64], values: &'a [f64], step: f64) -> Self {
        let (first, end) = (values[0], values.len() - 1);
        Change {
            times,
            values,
            step,
            begun: values.iter().position(|value| (value - first).abs() > Self::STEPS * step).map_or(end, |changed| changed - 1),
            end,
            height: values.iter().map(|value| (value - first).abs()).fold(0.0, f64::max),
            by_chance: SURE * 2_f64.sqrt() * scatter(values, step).deviation.unwrap_or(0.0),
        }
    }

    /// Returns the time from a reading to the last one, as a share of that since it began.
    fn share(&self, before: usize) -> f64 {
        (self.times[self.end] - self.times[before]) / (self.times[self.end] - self.times[self.begun])
    }

    /// Returns by how much it changes from a reading to the last one.
    fn since(&self, before: usize) -> f64 {
        (self.values[self.end] - self.values[before]).abs()
    }

    /// Returns `true` if it goes on: within the last tenth of the time since it began, or the last reading but up to three tenths, it changes at half of its mean rate, by
    /// more than one step and more than its readings scatter. What a whole half-sine, which ends with the record, changes by in so much time is not enough.
    fn goes_on(&self) -> bool {
        /// Of the time since the change began.
        const LATELY: f64 = 0.1;
        const LATE: f64 = 0.3;
        /// Of the mean rate.
        const RATE: f64 = 0.5;
        /// Of what a half-sine that ends with the record changes by.
        const MARGIN: f64 = 1.2;
        let changes = |before: usize| {
            let share = self.share(before);
            let enough = self.height * (RATE * share).max(MARGIN * 0.5 * (1.0 - libm::cos(PI * share)));
            self.since(before) > enough.max(Self::STEPS * self.step).max(self.by_chance)
        };
        let backwards = || (self.begun..self.end).rev();
        let lately = backwards().find(|before| self.share(*before) >= LATELY);
        backwards()
            .skip_while(|before| Some(*before) > lately)
            .take_while(|before| Some(*before) == lately || self.share(*before) <= LATE)
            .any(changes)
    }

    /// Returns `true` if it stands still: over at least three readings and at most half of the time since it began it changes by one step, and as brakes do; of a change of
    /// one or two steps no step is little.
    fn stands_still(&self) -> bool {
        /// Steps that a change at the mean rate would show while this one stands still.
        const EXPECTED: f64 = 2.5;
        /// Of the time since the change began.
        const LONGEST: f64 = 0.5;
        /// One step, but for the rounding of the readings.
        const ONE: f64 = 1.01;
        let expected = EXPECTED * self.step;
        let little = if self.height < expected { 0.0 } else { ONE * self.step };
        let lasts = (expected / self.height).min(LONGEST);
        let stands = |before: usize| {
            let by_brakes = FULL_BRAKING * (self.times[self.end] - self.times[before]);
            self.since(before) <= little.max(self.by_chance) + by_brakes
        };
        (0..self.end).rev().take_while(|before| self.end - before <= 2 || self.share(*before) <= lasts).all(stands)
    }
}
