//! The recording: a CSV file, or a file that names one and says what its columns are.

mod document;

use std::path::Path;
use std::sync::Arc;

use planar_impact::barrier::{ChannelClass, Estimate, Record, Window};

use super::kinematics::{FollowedPoint, MeasuredKinematics};
use super::samples::{Column, Fault, Samples, TIME};
use super::{ChannelQuantity, RecordAnswer};
use crate::case::CaseReader;
use crate::document::{Document, FileKind};
use crate::issue::{Cause, Issue, Issues, MOST_KEPT};
use crate::notice::{Notice, Notices};
use crate::quantity::excerpt;
use crate::source::{Open, Source};
use crate::units::Units;

pub(crate) use document::samples_of;

/// The key of the greatest acceleration that the sensors of a recorder hold.
pub(crate) const ACCELEROMETER_RANGE: &str = "accelerometer_range";

/// Channels over time, and what is known of the test or the vehicle.
pub struct Recording {
    origin: Origin,
    /// Its name as given.
    pub name: String,
    /// Its title; empty if it has none.
    pub title: String,
    /// The units that most of its quantities are in.
    pub units: Units,
    /// Assumptions, such as the unit of a number without one.
    pub notices: Notices,
    pub(super) channels: Vec<Channel>,
    pub(super) settings: Settings,
}

/// Where the issues of a recording are located.
enum Origin {
    Document(Document),
    Samples(Arc<Source>),
}

/// A channel with its polarity and calibration applied.
pub(super) struct Channel {
    pub(super) name: String,
    pub(super) quantity: ChannelQuantity,
    pub(super) record: Record,
    /// The value of one unit of its last printed decimal, in SI.
    pub(super) digit: f64,
    pub(super) range: Option<f64>,
    pub(super) path: String,
}

/// The class of the filter.
#[derive(Clone, Copy, Default)]
pub(super) enum Filter {
    /// That of the quantity, if the record is sampled fast enough.
    #[default]
    Usual,
    Off,
    Class(ChannelClass),
}

/// Everything that a file says beside its channels.
#[derive(Default)]
pub(super) struct Settings {
    pub(super) filter: Filter,
    pub(super) baseline: Option<Window>,
    pub(super) window: Option<Window>,
    pub(super) mass: Option<Estimate>,
    pub(super) speed: Option<Estimate>,
    pub(super) separation: Option<f64>,
    pub(super) neighbors: Option<usize>,
    pub(super) resolution: Option<f64>,
    pub(super) relative: f64,
    /// The greatest acceleration that the sensors of a recorder hold.
    pub(super) accelerometer_range: Option<f64>,
    pub(super) kinematics: Option<MeasuredKinematics>,
}

impl Recording {
    /// Parses a recording: as CSV if its name ends in `.csv`, or if it ends in neither `.toml` nor `.json` and its first line that is no comment names columns.
    ///
    /// # Errors
    ///
    /// Returns everything wrong with it and with the file that it names.
    pub fn parse(source: Source, open: &Open) -> Result<Recording, Issues> {
        Self::parse_by(source, |name| open(&name.to_string_lossy()))
    }

    /// The same with another way to open a file.
    pub(crate) fn parse_by(source: Source, open: impl Fn(&Path) -> Result<Source, Issues>) -> Result<Recording, Issues> {
        let extension = Path::new(&source.name).extension().map(|end| end.to_ascii_lowercase());
        let is_comment = |line: &&str| line.trim_start().starts_with('#') || line.trim().is_empty();
        let first = source.text.lines().find(|line| !is_comment(line)).unwrap_or_default().trim_start();
        let is_document = match extension.as_ref().and_then(|end| end.to_str()) {
            Some("csv") => false,
            Some("toml" | "json") => true,
            _ => first.starts_with(['{', '[']) || first.contains('='),
        };
        if is_document { Self::of_document(source, &open) } else { Self::of_samples(source) }
    }

    pub(crate) fn of_samples(source: Source) -> Result<Recording, Issues> {
        let samples = Samples::of(&source);
        let mut faults = Vec::new();
        let time = samples.place(TIME).map_err(|fault| faults.push(fault)).ok();
        let ByName { channels, faults: of_columns, mut notices, meant } = ByName::of(&samples, time);
        faults.extend(of_columns);
        if channels.is_empty() && faults.is_empty() {
            let help = meant.unwrap_or_else(|| {
                format!("name the columns {}, or write a file that says what they are", ChannelQuantity::names().join(", "))
            });
            faults.push(samples.fault(1, "", "no column has the name of a channel", help));
        }
        let of_channel = |i: usize| ChannelQuantity::of_column(&samples.headers[i].name).and_then(|_| samples.units(i));
        let systems: Vec<Units> = (0..samples.headers.len()).filter_map(of_channel).collect();
        notices.extend(samples.units_assumed(time, ChannelQuantity::of_column));
        let us = systems.iter().filter(|units| **units == Units::Us).count();
        let units = if 2 * us > systems.len() { Units::Us } else { Units::Si };
        let issues = distinct(faults).into_iter().map(|fault| of_line(&source, fault)).collect::<Vec<_>>();
        let (name, source) = (source.name.clone(), Arc::new(source));
        if !issues.is_empty() {
            return Err(Issues::new(Cause::Input, source, issues));
        }
        let settings = Settings::default();
        let origin = Origin::Samples(source);
        Ok(Recording { origin, name, title: String::new(), units, notices: Notices(notices), channels, settings })
    }

    fn of_document(source: Source, open: &dyn Fn(&Path) -> Result<Source, Issues>) -> Result<Recording, Issues> {
        let name = source.name.clone();
        let document = Document::parse(source)?;
        let reader = CaseReader::default();
        let (title, settings, channels) = document.read_as(FileKind::Recording, |root| reader.recording(root, open))?;
        let (units, notices) = (reader.units(), Notices(reader.notices.into_inner()));
        Ok(Recording { origin: Origin::Document(document), name, title, units, notices, channels, settings })
    }

    /// Says more of the channels of a recorder than the recording does.
    pub(crate) fn set_recorder(
        &mut self,
        resolution: Option<f64>,
        relative: Option<f64>,
        range: Option<f64>,
        accelerometer_range: Option<f64>,
    ) {
        self.settings.accelerometer_range = accelerometer_range.or(self.settings.accelerometer_range);
        self.settings.resolution = resolution.or(self.settings.resolution);
        self.settings.relative = relative.unwrap_or(self.settings.relative);
        for channel in self.channels.iter_mut().filter(|channel| channel.quantity.is_running()) {
            channel.range = range.or(channel.range);
        }
    }

    /// Returns the mass of the vehicle, if the file gives one.
    pub(crate) fn mass(&self) -> Option<Estimate> {
        self.settings.mass
    }

    /// Returns its closing speed, if the file gives one.
    pub(crate) fn speed(&self) -> Option<Estimate> {
        self.settings.speed
    }

    /// Returns the point whose motion to the barrier it has.
    pub(crate) fn followed(&self) -> Option<FollowedPoint> {
        self.settings.kinematics.as_ref().map(MeasuredKinematics::followed)
    }

    /// Computes what the recording tells.
    pub(crate) fn analyse(&self) -> Result<(RecordAnswer, Vec<Notice>), Issues> {
        super::analysis::analyse(self, &|| Ok(()))
    }

    /// Locates issues that the analysis finds.
    pub(super) fn refuse(&self, cause: Cause, issues: Vec<Issue>) -> Issues {
        match &self.origin {
            Origin::Document(document) => document.refuse_at(cause, issues),
            Origin::Samples(source) => {
                let end = source.text.find(['\r', '\n']).unwrap_or(source.text.len());
                let at_header = |issue| Issue { span: Some(0..end), ..issue };
                Issues::new(cause, source.clone(), issues.into_iter().map(at_header).collect())
            }
        }
    }
}

/// The channels of columns that have the name of one.
struct ByName {
    channels: Vec<Channel>,
    faults: Vec<Fault>,
    /// About the columns that are no channels.
    notices: Vec<Notice>,
    /// What the name of one of them was meant for.
    meant: Option<String>,
}

impl ByName {
    /// Reads them. Without a time, it reads the names alone.
    fn of(samples: &Samples, time: Option<usize>) -> ByName {
        let mut read = ByName { channels: Vec::new(), faults: Vec::new(), notices: Vec::new(), meant: None };
        let mut unused = Vec::new();
        for header in samples.headers.iter().filter(|header| header.name != TIME) {
            let name = || excerpt(&header.name);
            let Some(quantity) = ChannelQuantity::of_column(&header.name) else {
                match ChannelQuantity::meant_by(&header.name) {
                    Some(meant) => {
                        let message = format!("the column {} is no channel, and is not used; did you mean `{meant}`?", name());
                        read.notices.push(Notice::warning("unread-column", header.name.clone(), message));
                        read.meant.get_or_insert_with(|| format!("did you mean `{meant}` in place of {}?", name()));
                    }
                    None => unused.push(name()),
                }
                continue;
            };
            let column = samples.place(&header.name).map_err(|fault| vec![fault]).and_then(|place| match time {
                Some(time) => samples.channel(time, place, quantity, (None, 1.0)),
                None => Err(Vec::new()),
            });
            match column {
                Ok(column) => read.channels.push(Channel::of(header.name.clone(), quantity, column)),
                Err(found) => read.faults.extend(found),
            }
        }
        if !unused.is_empty() {
            let message = format!("these columns are no channels, and are not used: {}", unused.join(", "));
            read.notices.push(Notice::note("unused-columns", "", message));
        }
        read
    }
}

impl Channel {
    fn of(name: String, quantity: ChannelQuantity, Column { record, digit }: Column) -> Channel {
        Channel { path: name.clone(), name, quantity, record, digit, range: None }
    }
}

/// Removes what several channels have found in the same line.
fn distinct(faults: Vec<Fault>) -> Vec<Fault> {
    let mut kept: Vec<Fault> = Vec::new();
    let mut seen = std::collections::BTreeSet::new();
    for fault in faults {
        if kept.len() < MOST_KEPT && seen.insert((fault.line, fault.message.clone())) {
            kept.push(fault);
        }
    }
    kept
}

fn of_line(source: &Source, fault: Fault) -> Issue {
    let begin: usize = source.text.split_inclusive('\n').take(fault.line.saturating_sub(1)).map(str::len).sum();
    let length = source.text[begin..].split(['\r', '\n']).next().unwrap_or_default().len();
    Issue { span: Some(begin..begin + length), ..Issue::at("samples", fault.column, fault.message).with_help(fault.help) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(text: &str) -> Result<Recording, Issues> {
        let source = Source::new("test.csv", text);
        Recording::parse_by(source, |_| panic!("it names no file"))
    }

    #[test]
    fn channels_are_in_si_and_empty_cells_are_no_samples() {
        let recording = parse("time [ms],normal_force.left [kip],speed,site\r\n-1,1,10,a\r\n0,,9,b\r\n1,3,,c\r\n").expect("a recording");
        let [force, speed] = &recording.channels[..] else { panic!("two channels") };
        assert_eq!((force.quantity, speed.quantity), (ChannelQuantity::NormalForce, ChannelQuantity::Speed));
        assert!((force.record.values()[1] - 3.0 * 4_448.221_615_260_5).abs() < 1e-9); // 1000 lbf
        assert_eq!((force.record.times(), speed.record.times()), (vec![-0.001, 0.001], vec![-0.001, 0.0]));
        assert_eq!(recording.units, Units::Us);
        let codes: Vec<_> = recording.notices.0.iter().map(|notice| notice.code).collect();
        assert_eq!(codes, ["unused-columns", "unit-assumed"]);
    }

    #[test]
    fn a_column_is_one_channel() {
        let channel = "[[channel]]\ncolumn = \"F\"\nquantity = \"normal_force\"\n";
        let file = |channels: &str| format!("schema = 1\nsamples = \"time [s],F [N],G [N]\\n0,1,2\\n1,2,3\\n\"\n{channels}");
        let read = |text: String| {
            let none: Open = Box::new(|name| Err(crate::decode::unreadable(name, "is not there")));
            Recording::parse(Source::new("a.toml", text), &none)
        };
        assert!(read(file(&format!("{channel}{}", channel.replace('F', "G")))).is_ok());
        let issues = read(file(&format!("{channel}{channel}"))).err().expect("a repeated column");
        assert!(matches!(issues.list(), [issue] if issue.code == "repeated-column" && issue.path == "channel.2.column"), "{issues}");
        let said = "the column `F` is a channel already (remove one of the two: forces of several load cells add up, and this one would count twice)";
        assert!(issues.to_string().contains(said), "{issues}");
    }

    #[test]
    fn every_fault_has_its_line_once() {
        let issues = parse("time [s],distance [m],speed [m/s]\n0,1,2\n1,x,3\n2\n3,4,y\n").err().expect("three faults");
        let lines: Vec<_> = issues.list().iter().map(|issue| (issues.line(issue), issue.path.as_str())).collect();
        assert_eq!(lines, [(Some(3), "distance"), (Some(4), "distance"), (Some(5), "speed")]);
        assert!(issues.list().iter().all(|issue| issue.help.is_some()));
        let text = |issue: &Issue| issue.span.clone().map(|span| &issues.source().text[span]);
        assert_eq!(issues.list().iter().map(text).collect::<Vec<_>>(), [Some("1,x,3"), Some("2"), Some("3,4,y")]);
    }
}
