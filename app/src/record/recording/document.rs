//! A recording that is a TOML or JSON file: where its samples are, what its columns are, and what is known of the test or the vehicle.

use std::path::Path;

use planar_impact::STANDARD_GRAVITY;
use planar_impact::barrier::{ChannelClass, Window};

use super::{ACCELEROMETER_RANGE, ByName, Channel, Filter, Settings, distinct};
use crate::case::{CaseReader, one_of, report_file};
use crate::document::{Field, Table, Value};
use crate::issue::Issues;
use crate::notice::Notice;
use crate::quantity::{Kind, excerpt};
use crate::record::ChannelQuantity;
use crate::record::samples::{Fault, Samples, TIME};
use crate::source::Source;
use crate::units::Measure;
use crate::unusual;

type Read = (String, Settings, Vec<Channel>);

/// Reports what is wrong with samples, at a key of the file.
type Report<'a> = dyn Fn(&Field<'_>, Vec<Fault>) + 'a;

/// The columns of the samples, and which of them is the time.
struct Columns<'a> {
    samples: &'a Samples,
    time: Option<usize>,
}

impl CaseReader {
    pub(super) fn recording(&self, root: &Table<'_>, open: &dyn Fn(&Path) -> Result<Source, Issues>) -> Option<Read> {
        let schema = root.required("schema").integer(1..=1);
        let title = root.optional("title").string().unwrap_or_default().to_owned();
        let kinematics = root.has("kinematics").then(|| root.optional("kinematics").table().and_then(|table| self.kinematics(&table)));
        let settings = self.settings(root);
        let kinematics = match kinematics {
            Some(kinematics) => Some(kinematics?),
            None => None,
        };
        // Kinematics need no samples.
        if kinematics.is_some() && !root.has("file") && !root.has("samples") {
            let sound = needed(root, &[]) && !root.has("channel");
            if root.has("channel") {
                root.optional("channel").report_as("missing-partner", "channels need samples", Some("give `file` or `samples`".to_owned()));
            }
            let settings = Settings { kinematics, ..settings? };
            return (schema.is_some() && sound).then_some((title, settings, Vec::new()));
        }
        let (place, source) = self.samples_named(root, open)?;
        let tables = if root.has("channel") { root.optional("channel").array_of_tables().map(Some) } else { Some(None) };
        let samples = source.as_ref().map(Samples::of);
        let report = |place: &Field<'_>, faults: Vec<Fault>| {
            for Fault { line, column, message, help } in distinct(faults) {
                let (name, column) =
                    (source.as_ref().map_or("", |source| &source.name), if column.is_empty() { column } else { column + ": " });
                place.report_as("samples", format!("{name}:{line}: {column}{message}"), Some(help));
            }
        };
        let columns = samples
            .as_ref()
            .map(|samples| Columns { samples, time: samples.place(TIME).map_err(|fault| report(&place, vec![fault])).ok() });
        let tables = tables?;
        let channels = match &tables {
            Some(tables) => self.listed(tables, columns.as_ref(), &report),
            None => columns.as_ref().and_then(|columns| self.named(columns, &place, &report)),
        };
        let (channels, settings) = (channels?, Settings { kinematics, ..settings? });
        if let Some(Columns { samples, time }) = &columns {
            let is_calibrated = |channel: &Channel| {
                let of_channel = |table: &&Table<'_>| table.path() == channel.path;
                tables.iter().flatten().find(of_channel).is_some_and(|table| table.has("calibration"))
            };
            let quantity = |name: &str| {
                let channel = channels.iter().find(|channel| channel.name == name).filter(|channel| !is_calibrated(channel));
                channel.map(|channel| channel.quantity)
            };
            self.notices.borrow_mut().extend(samples.units_assumed(*time, quantity));
        }
        let has_time = columns.is_some_and(|columns| columns.time.is_some());
        (schema.is_some() && has_time && needed(root, &channels)).then_some((title, settings, channels))
    }

    /// Reads the samples, in the file or in another one. What is wrong with the other file is reported.
    fn samples_named<'a>(&self, root: &Table<'a>, open: &dyn Fn(&Path) -> Result<Source, Issues>) -> Option<(Field<'a>, Option<Source>)> {
        Some(match one_of(root, "file", "samples")? {
            "file" => {
                let field = root.required("file");
                let place = field.clone();
                (place.clone(), field.string().and_then(|name| open(Path::new(name)).map_err(|issues| report_file(&place, &issues)).ok()))
            }
            _ => {
                let field = root.required("samples");
                (field.clone(), samples_of(field))
            }
        })
    }

    /// Reads every column that has the name of a channel.
    fn named(&self, Columns { samples, time }: &Columns<'_>, place: &Field<'_>, report: &Report<'_>) -> Option<Vec<Channel>> {
        let ByName { channels, faults, notices, meant } = ByName::of(samples, *time);
        let sound = faults.is_empty();
        report(place, faults);
        self.notices.borrow_mut().extend(notices);
        if channels.is_empty() && sound {
            let help = meant.unwrap_or_else(|| {
                format!("say what they are under [[channel]], with `column` and `quantity`; its columns are {}", samples.names())
            });
            place.report("no column has the name of a channel", Some(help));
            return None;
        }
        sound.then_some(channels)
    }

    /// Reads the channels that are listed. Without columns, because the file cannot be read, it reads them for what is wrong with them alone.
    fn listed(&self, tables: &[Table<'_>], columns: Option<&Columns<'_>>, report: &Report<'_>) -> Option<Vec<Channel>> {
        let mut channels: Vec<Channel> = Vec::new();
        let mut sound = true;
        for table in tables {
            let channel = self.channel(table, columns, &|faults| report(&table.optional("column"), faults));
            if let Some(twice) = channel.as_ref().filter(|channel| channels.iter().any(|other| other.name == channel.name)) {
                let help = "remove one of the two: forces of several load cells add up, and this one would count twice";
                let message = format!("the column {} is a channel already", excerpt(&twice.name));
                table.optional("column").report_as("repeated-column", message, Some(help.to_owned()));
                sound = false;
            }
            sound &= channel.is_some();
            channels.extend(channel);
        }
        let columns = columns.filter(|_| sound)?;
        let is_unlisted = |name: &&str| ChannelQuantity::of_column(name).is_some() && channels.iter().all(|channel| channel.name != *name);
        let unlisted: Vec<String> =
            columns.samples.headers.iter().map(|header| header.name.as_str()).filter(is_unlisted).map(excerpt).collect();
        if !unlisted.is_empty() {
            let message = format!("these columns are not under [[channel]], and are not used: {}", unlisted.join(", "));
            self.notices.borrow_mut().push(Notice::warning("unused-columns", "channel", message));
        }
        Some(channels)
    }

    fn channel(&self, table: &Table<'_>, columns: Option<&Columns<'_>>, report: &dyn Fn(Vec<Fault>)) -> Option<Channel> {
        let column = table.required("column").string();
        let by_name = column.and_then(ChannelQuantity::of_column);
        let quantity = match table.has("quantity") || by_name.is_none() {
            true => table.required("quantity").choice(&ChannelQuantity::names()).and_then(ChannelQuantity::of_column),
            false => by_name,
        };
        let polarity = if table.has("polarity") { sign(table) } else { Some(1.0) };
        let of_kind = |key| match (table.has(key), quantity) {
            (true, Some(ChannelQuantity::Acceleration)) => self.positive_acceleration(table.optional(key)).map(Some),
            (true, Some(quantity)) => self.positive(table.optional(key), quantity.kind().difference()).map(Some),
            _ => Some(None),
        };
        let (calibration, range) = (of_kind("calibration"), of_kind("range"));
        table.finish();
        let (column, quantity, polarity, calibration, range) = (column?, quantity?, polarity?, calibration?, range?);
        let Columns { samples, time } = columns?;
        let place = samples.place(column).map_err(|fault| report(vec![fault])).ok()?;
        let samples = samples.channel((*time)?, place, quantity, (calibration, polarity)).map_err(report).ok()?;
        Some(Channel { range, path: table.path().to_owned(), ..Channel::of(column.to_owned(), quantity, samples) })
    }

    fn settings(&self, root: &Table<'_>) -> Option<Settings> {
        let filter = if root.has("filter") { filter(root) } else { Some(Filter::Usual) };
        let window = |key| match root.has(key) {
            true => self.pair(root.optional(key), Kind::DURATION).map(|[from, to]| Some(Window { from, to })),
            false => Some(None),
        };
        let estimate = |key, measure| match root.has(key) {
            true => self.positive_estimate(root.optional(key), measure).map(Some),
            false => Some(None),
        };
        let number = |key, kind| match root.has(key) {
            true => self.quantity(root.optional(key), kind).map(Some),
            false => Some(None),
        };
        let (baseline, contact) = (window("baseline"), window("window"));
        let (mass, speed) = (estimate("mass", Measure::Mass), estimate("speed", Measure::Speed));
        let unusual = [
            mass.flatten().and_then(|mass| unusual::mass("mass", mass.value)),
            speed.flatten().and_then(|speed| unusual::speed("speed", speed.value)),
        ];
        self.notices.borrow_mut().extend(unusual.into_iter().flatten());
        let separation = number("separation", Kind::DURATION);
        let neighbors = if root.has("neighbors") { root.optional("neighbors").integer(4..=1000).map(Some) } else { Some(None) };
        let resolution = match root.has("resolution") {
            true => self.positive(root.optional("resolution"), Kind::SPEED).map(Some),
            false => Some(None),
        };
        let relative = if root.has("relative") { self.coefficient(root.optional("relative"), 1.0) } else { Some(0.0) };
        let accelerometer_range = match root.has(ACCELEROMETER_RANGE) {
            true => self.positive_acceleration(root.optional(ACCELEROMETER_RANGE)).map(Some),
            false => Some(None),
        };
        Some(Settings {
            filter: filter?,
            baseline: baseline?,
            window: contact?,
            mass: mass?,
            speed: speed?,
            separation: separation?,
            neighbors: neighbors?.and_then(|count| usize::try_from(count).ok()),
            resolution: resolution?,
            relative: relative?,
            accelerometer_range: accelerometer_range?,
            kinematics: None,
        })
    }

    /// Reads an acceleration above zero, in which g is the standard gravity and not a gram.
    pub(crate) fn positive_acceleration(&self, field: Field<'_>) -> Option<f64> {
        let number = match field.value() {
            Some(Value::String(text)) => text.trim().strip_suffix('g').map(str::trim).and_then(|number| number.parse::<f64>().ok()),
            _ => None,
        };
        match number.filter(|number| number.is_finite() && *number > 0.0) {
            Some(number) => Some(number * STANDARD_GRAVITY),
            None => self.positive(field, Kind::ACCELERATION),
        }
    }
}

/// Returns the samples that a file has in itself: a text as of a CSV file.
pub(crate) fn samples_of(field: Field<'_>) -> Option<Source> {
    let name = field.path().to_owned();
    // The line break after the opening quotes of a JSON or a one-line text is part of it.
    field.string().map(|text| Source::new(name, text.trim_start_matches(['\r', '\n'])))
}

fn sign(table: &Table<'_>) -> Option<f64> {
    let field = table.optional("polarity");
    let place = field.clone();
    match field.integer(-1..=1)? {
        0 => {
            place.report("it is 0; expected 1, or -1 for a channel whose sign is reversed", None);
            None
        }
        sign => Some(sign as f64),
    }
}

fn filter(root: &Table<'_>) -> Option<Filter> {
    let field = root.optional("filter");
    if let Some(Value::Bool(false)) = field.value() {
        return Some(Filter::Off);
    }
    let place = field.clone();
    let number = field.integer(0..=i64::from(i32::MAX))?;
    let class = ChannelClass::ALL.into_iter().find(|class| i64::from(class.number()) == number);
    if class.is_none() {
        let help = "the classes of SAE J211 are 60, 180, 600 and 1000; `false` is no filter".to_owned();
        place.report(format!("{number} is no channel frequency class"), Some(help));
    }
    class.map(Filter::Class)
}

/// Reports each key that no channel uses.
fn needed(root: &Table<'_>, channels: &[Channel]) -> bool {
    use ChannelQuantity as Q;
    let (forces, films) = ([Q::NormalForce, Q::TangentialForce, Q::Acceleration], [Q::Distance]);
    let recorder = [Q::DeltaVForward, Q::DeltaVLeft, Q::DeltaVRight, Q::Speed];
    let impulses = [Q::NormalForce, Q::Acceleration, Q::Distance];
    let velocity_changes = [Q::DeltaVForward, Q::DeltaVLeft, Q::DeltaVRight];
    let partners: [(&'static str, &[Q]); 10] = [
        ("mass", &forces),
        ("filter", &forces),
        ("baseline", &forces),
        ("window", &[Q::NormalForce, Q::TangentialForce, Q::Acceleration, Q::Distance]),
        ("speed", &impulses),
        ("separation", &films),
        ("neighbors", &films),
        ("resolution", &recorder),
        ("relative", &recorder),
        (ACCELEROMETER_RANGE, &velocity_changes),
    ];
    let mut sound = true;
    for (key, partners) in partners {
        if root.has(key) && !channels.iter().any(|channel| partners.contains(&channel.quantity)) {
            let names: Vec<&str> = partners.iter().map(|quantity| quantity.name()).collect();
            let help = format!("remove it, or add a channel: {}", names.join(", "));
            root.optional(key).report_as("missing-partner", "no channel of this recording uses it", Some(help));
            sound = false;
        }
    }
    sound
}
