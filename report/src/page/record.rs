//! The page of `record`.

use planar_impact_app::plain_text::shorten;
use planar_impact_app::record::{AtTime, ChannelAnswer, RecordAnswer, Recorder, Records, Uncertain};
use planar_impact_app::units::{Measure, Units};

use super::Facts;
use crate::block::{Block, Table};

/// Most rows of the speeds before the impact.
const MOST_ROWS: usize = 40;

impl Facts for Records {
    /// The results of each recording, then its channels.
    fn blocks(&self, units: Units) -> Vec<Block> {
        let mut blocks = Vec::new();
        for record in &self.records {
            if self.records.len() > 1 {
                blocks.push(Block::Heading { level: 2, text: shorten(&record.file, 76) });
            }
            let page = Page { units };
            blocks.extend(page.results(record).map(Block::from));
            blocks.extend(record.recorder.iter().flat_map(|recorder| page.recorder(recorder)));
            if !record.channels.is_empty() {
                blocks.push(page.channels(record).into());
            }
        }
        blocks
    }
}

struct Page {
    units: Units,
}

impl Page {
    fn number(&self, measure: Measure, value: f64) -> String {
        self.units.number(measure, value, 0.0)
    }

    fn sd(&self, measure: Measure, of: Uncertain) -> String {
        of.sd.map_or_else(String::new, |sd| format!("± {}", self.number(measure, sd)))
    }

    fn row(&self, what: &str, measure: Measure, of: Uncertain, time: Option<f64>) -> Vec<String> {
        let at = time.map_or_else(String::new, |time| self.number(Measure::Time, time));
        let unit = self.units.unit(measure).to_owned();
        vec![what.to_owned(), self.number(measure, of.value), self.sd(measure, of), unit, at]
    }

    /// A speed, and the same in the unit of the road.
    fn speeds(&self, what: &str, of: Uncertain, time: Option<f64>) -> Vec<Vec<String>> {
        let road = self.units.on_the_road(Measure::Speed).map(|measure| self.row("", measure, of, None));
        [self.row(what, Measure::Speed, of, time)].into_iter().chain(road).collect()
    }

    fn table(rows: Vec<Vec<String>>) -> Option<Table> {
        (!rows.is_empty()).then(|| Table::new(["", "value", "sd", "unit", "at time s"], "lrrlr", rows))
    }

    fn results(&self, record: &RecordAnswer) -> Option<Table> {
        let mut rows = Vec::new();
        let exact = |value| Uncertain { value, sd: None };
        if let Some(barrier) = &record.barrier {
            let mut row = |what, measure, of: Option<Uncertain>| rows.extend(of.map(|of| self.row(what, measure, of, None)));
            row("normal impulse", Measure::Impulse, barrier.normal_impulse);
            row("tangential impulse", Measure::Impulse, barrier.tangential_impulse);
            row("impulse ratio", Measure::Ratio, barrier.impulse_ratio);
            rows.extend(barrier.peak_force.map(|peak| self.row("peak normal force", Measure::Force, exact(peak.value), Some(peak.time))));
            rows.extend(barrier.delta_v.into_iter().flat_map(|of| self.speeds("delta-V", of, None)));
            rows.extend(barrier.restitution.map(|of| self.row("restitution", Measure::Ratio, of, None)));
        }
        if let Some(kinematics) = &record.kinematics {
            let [normal, tangential] = kinematics.separation.map(exact);
            rows.push(self.row("contact point: restitution", Measure::Ratio, kinematics.restitution, None));
            rows.push(self.row("separates normal", Measure::Speed, normal, None));
            rows.push(self.row("separates tangential", Measure::Speed, tangential, None));
            rows.push(self.row("heading at separation", Measure::Angle, exact(kinematics.heading_at_separation), None));
        }
        for one in &record.accelerations {
            let name = |what: &str| format!("{}: {what}", shorten(&one.channel, 24));
            rows.extend(self.speeds(&name("delta-V"), one.delta_v, None));
            rows.extend(one.impulse.map(|of| self.row(&name("impulse"), Measure::Impulse, of, None)));
            rows.push(self.row(&name("peak"), Measure::Acceleration, exact(one.peak.value), Some(one.peak.time)));
            rows.extend(one.restitution.map(|of| self.row(&name("restitution"), Measure::Ratio, of, None)));
        }
        for film in &record.films {
            let name = |what: &str| format!("{}: {what}", shorten(&film.channel, 24));
            rows.extend(self.speeds(&name("closing speed"), film.closing_speed, None));
            rows.push(self.row(&name("restitution"), Measure::Ratio, film.restitution, Some(film.separation)));
        }
        Self::table(rows)
    }

    fn recorder(&self, recorder: &Recorder) -> Vec<Block> {
        let mut rows = Vec::new();
        let mut change = |what, at: Option<AtTime>| rows.extend(at.into_iter().flat_map(|at| self.speeds(what, at.number, Some(at.time))));
        change("delta-V forward", recorder.delta_v_forward);
        change("delta-V left", recorder.delta_v_left);
        if let Some(maximum) = &recorder.maximum {
            rows.extend(self.speeds("delta-V", maximum.magnitude, Some(maximum.time)));
            let components = [
                (recorder.delta_v_forward, "at that time forward", maximum.forward),
                (recorder.delta_v_left, "at that time left", maximum.left),
            ];
            let others = components.into_iter().filter(|(greatest, ..)| greatest.is_some_and(|greatest| greatest.time != maximum.time));
            rows.extend(others.flat_map(|(_, what, then)| self.speeds(what, then, Some(maximum.time))));
            rows.extend(maximum.pdof.map(|pdof| self.row("PDOF", Measure::Angle, pdof, Some(maximum.time))));
        }
        let at_impact = recorder.speed_at_impact;
        rows.extend(at_impact.into_iter().flat_map(|at| self.speeds("speed at impact", at.number, Some(at.time))));
        let mut blocks: Vec<Block> = Self::table(rows).map(Block::from).into_iter().collect();
        if recorder.is_lower_bound {
            blocks.push(Block::item("! ", "The record does not hold the whole velocity change: the true one is greater."));
        }
        if !recorder.pre_crash.is_empty() {
            let road = self.units.on_the_road(Measure::Speed).unwrap_or(Measure::Speed);
            let row = |of: &planar_impact_app::record::PreCrash| vec![self.number(Measure::Time, of.time), self.number(road, of.speed)];
            let shown = recorder.pre_crash.iter().rev().take(MOST_ROWS).rev().map(row).collect();
            let header = ["before impact s".to_owned(), format!("speed {}", self.units.unit(road))];
            blocks.push(Table::new(header, "rr", shown).into());
            if let hidden @ 1.. = recorder.pre_crash.len().saturating_sub(MOST_ROWS) {
                blocks.push(Block::item("- ", format!("{hidden} earlier speeds are in the JSON.")));
            }
        }
        blocks
    }

    fn channels(&self, record: &RecordAnswer) -> Table {
        let row = |channel: &ChannelAnswer| {
            let measure = channel.quantity.measure();
            let time = |time| self.number(Measure::Time, time);
            let whole = match (channel.clipped, channel.is_truncated) {
                (None, false) => "",
                (Some(_), false) => "clipped",
                (None, true) => "truncated",
                (Some(_), true) => "clipped, truncated",
            };
            let least = channel.resolution.map_or_else(String::new, |step| self.units.quantity(measure, step));
            let period = channel.period.map_or_else(|| "uneven".to_owned(), |period| self.units.number(Measure::Time, period, 0.0));
            vec![
                shorten(&channel.name, 24),
                channel.samples.to_string(),
                time(channel.from),
                time(channel.to),
                period,
                least,
                whole.to_owned(),
            ]
        };
        let header = ["channel", "samples", "from s", "to s", "period s", "least step", ""];
        Table::new(header, "lrrrrrl", record.channels.iter().map(row).collect()).narrow()
    }
}
