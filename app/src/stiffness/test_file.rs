//! The file of barrier tests.

use planar_impact::barrier::{BarrierTest, MeasuredTest};

use crate::case::{CaseReader, Recorded, one_of};
use crate::document::{Document, Field, FileKind, Table, Value};
use crate::issue::{Cause, Issue, Issues};
use crate::message::Message;
use crate::notice::{Notice, Notices};
use crate::quantity::Kind;
use crate::source::{Open, Source};
use crate::units::{Measure, Units};
use crate::unusual;

/// Maximum number of tests: inverting their covariance takes about a second for this number.
const MOST_TESTS: usize = 500;

/// A file of barrier tests.
pub struct TestFile {
    document: Document,
    /// Its title; empty if it has none.
    pub title: String,
    /// The vehicles in file order, each with one or more tests.
    pub vehicles: Vec<Tested>,
    /// The speed assumed to leave no crush.
    pub onset: Option<f64>,
    /// `true` if a fit holds that speed.
    pub holds_onset: bool,
    /// The force A at the onset of crush that a fit holds, in N/m.
    pub force: Option<f64>,
    /// The flat crush whose energy the fit predicts, if given.
    pub prediction: Option<Prediction>,
    /// `true` if the file gives any standard deviation.
    pub has_deviations: bool,
    /// The units that most of its quantities use.
    pub units: Units,
    /// Assumptions.
    pub notices: Notices,
}

/// A vehicle with its tests.
pub struct Tested {
    /// Its name.
    pub name: String,
    /// Its tests.
    pub tests: Vec<MeasuredTest>,
    /// `true` if each test was of a new car, `false` if all were of one car; `None` if the file does not say, which means one car.
    pub new_cars: Option<bool>,
}

/// A flat crush whose energy is to be predicted.
pub struct Prediction {
    /// Its depth in m.
    pub depth: f64,
    /// Its width in m.
    pub width: f64,
}

/// The tests of a file with and without standard deviations, of which either all or none must have them, and those that leave crush.
#[derive(Default)]
struct Seen<'a> {
    bare: Vec<Table<'a>>,
    is_any: bool,
    crushed: Vec<(BarrierTest, String)>,
}

/// A test and the scatter that the file gives for it.
struct Read {
    test: BarrierTest,
    speed_sd: Option<f64>,
    restitution_sd: Option<f64>,
    scatter: Option<f64>,
}

impl TestFile {
    /// Parses a file of barrier tests that names no recording.
    ///
    /// # Errors
    ///
    /// Returns everything wrong with it.
    pub fn parse(source: Source) -> Result<TestFile, Issues> {
        TestFile::read(source, CaseReader::default())
    }

    /// The same for a file that may name recordings, which `open` reads.
    ///
    /// # Errors
    ///
    /// Returns everything wrong with it and with the recordings.
    pub fn parse_with(source: Source, open: Open) -> Result<TestFile, Issues> {
        TestFile::read(source, CaseReader::opening(open))
    }

    pub(crate) fn read(source: Source, reader: CaseReader) -> Result<TestFile, Issues> {
        let document = Document::parse(source)?;
        let read = document.read_as(FileKind::Tests, |root| reader.tests(root))?;
        let ReadFile { title, vehicles, fit: ReadFit { onset, holds_onset, force, prediction }, has_deviations } = read;
        let (units, notices) = (reader.units(), Notices(reader.notices.into_inner()));
        Ok(TestFile { document, title, vehicles, onset, holds_onset, force, prediction, has_deviations, units, notices })
    }

    /// Returns `true` if a fit holds d0 or A, so that one test is enough.
    pub fn holds(&self) -> bool {
        self.holds_onset || self.force.is_some()
    }

    /// Returns the number of tests.
    pub fn count(&self) -> usize {
        self.vehicles.iter().map(|vehicle| vehicle.tests.len()).sum()
    }

    /// Locates in the file the issues of tests that do not determine a stiffness.
    pub fn unfit(&self, issues: impl IntoIterator<Item = Issue>) -> Issues {
        self.document.refuse_at(Cause::Input, issues)
    }
}

/// The keys of a file of barrier tests.
struct ReadFile {
    title: String,
    vehicles: Vec<Tested>,
    fit: ReadFit,
    has_deviations: bool,
}

/// The keys of `[fit]`.
#[derive(Default)]
struct ReadFit {
    onset: Option<f64>,
    holds_onset: bool,
    force: Option<f64>,
    prediction: Option<Prediction>,
}

impl CaseReader {
    fn tests(&self, root: &Table<'_>) -> Option<ReadFile> {
        let schema = root.required("schema").integer(1..=1);
        let title = root.optional("title").string().unwrap_or_default().to_owned();
        let vehicles = root.required("vehicle").array_of_tables();
        let mut seen = Seen::default();
        let vehicles =
            vehicles.map(|tables| tables.iter().enumerate().map(|(i, table)| self.tested(table, i + 1, &mut seen)).collect::<Vec<_>>());
        let fit = root.has("fit").then(|| root.optional("fit").table().and_then(|table| self.fit(&table)));
        let has_deviations = seen.finish();
        schema?;
        let fit = match fit {
            Some(fit) => fit?,
            None => ReadFit::default(),
        };
        let vehicles: Vec<(String, Option<bool>, Vec<Read>)> = vehicles?.into_iter().collect::<Option<_>>()?;
        let count: usize = vehicles.iter().map(|(.., tests)| tests.len()).sum();
        if count > MOST_TESTS {
            root.optional("vehicle").report(format!("{count} tests exceed the limit of {MOST_TESTS}"), None);
            return None;
        }
        let measured = |read: Read| MeasuredTest {
            test: read.test,
            speed_deviation: read.speed_sd.unwrap_or(0.0),
            restitution_deviation: read.restitution_sd.unwrap_or(0.0),
            // If the file gives none, any equal scatter for all tests will do.
            scatter: read.scatter.unwrap_or(if has_deviations { 0.0 } else { 1.0 }),
        };
        let tested = |(name, new_cars, tests): (String, Option<bool>, Vec<Read>)| {
            let tests = tests.into_iter().map(measured).collect();
            Tested { name, tests, new_cars }
        };
        Some(ReadFile { title, vehicles: vehicles.into_iter().map(tested).collect(), fit, has_deviations })
    }

    fn tested<'a>(&self, table: &Table<'a>, number: usize, seen: &mut Seen<'a>) -> Option<(String, Option<bool>, Vec<Read>)> {
        let name = table.optional("name").name().map_or_else(|| format!("vehicle {number}"), str::to_owned);
        let new_cars = table.has("new_cars").then(|| table.optional("new_cars").boolean());
        let field = table.required("test");
        let place = field.clone();
        let tests = field.array_of_tables();
        table.finish();
        let tests = tests?;
        if tests.is_empty() {
            place.report("no test", None);
            return None;
        }
        let read: Vec<_> = tests.iter().map(|test| self.test(test)).collect();
        tests.into_iter().zip(&read).for_each(|(table, read)| seen.add(table, read.as_ref()));
        let new_cars = match new_cars {
            Some(new_cars) => Some(new_cars?),
            None => None,
        };
        Some((name, new_cars, read.into_iter().collect::<Option<_>>()?))
    }

    fn test(&self, table: &Table<'_>) -> Option<Read> {
        let mass = self.positive(table.required("mass"), Kind::MASS);
        let speed = alone(table, "speed", "speed_sd").and_then(|speed| self.positive(speed, Kind::SPEED));
        let recorded = is_recorded(table).then(|| self.recorded_restitution(&table.required("restitution")));
        let restitution = match &recorded {
            Some(recorded) => recorded.as_ref().map(|recorded| recorded.restitution),
            None => self.restitution_of_test(table, speed),
        };
        let profile = self.profile(table);
        let deviation = |key, kind| table.has(key).then(|| self.not_negative(table.optional(key), kind));
        let speed_sd = deviation("speed_sd", Kind::SPEED);
        if let (Some(Some(recorded)), Some(speed)) = (&recorded, speed) {
            self.compare_speeds(table, speed, speed_sd.flatten(), recorded);
        }
        let restitution_sd = match recorded {
            Some(recorded) => Some(recorded.map(|recorded| recorded.sd)),
            None => table.has("restitution_sd").then(|| self.coefficient(table.optional("restitution_sd"), 1.0)),
        };
        let scatter = deviation("scatter", Kind::ROOT_FORCE);
        let has_rebound = table.has("rebound_speed") && !table.has("restitution_sd");
        table.finish();
        let profile = profile?.on_scalar(|_| 0.0);
        let deepest = profile.depths().iter().copied().fold(0.0, f64::max);
        let crush = profile.moments();
        let test = BarrierTest { mass: mass?, speed: speed?, restitution: restitution?, crush };
        let at = |key: &str| format!("{}.{key}", table.path());
        let unusual = [
            unusual::mass(&at("mass"), test.mass),
            unusual::test_speed(&at("speed"), test.speed),
            unusual::depth(&at("depths"), deepest),
            unusual::width(&at("width"), profile.width()),
        ];
        let message = || "a test that leaves no crush says only that d0 is at least its E*, and a fit takes it as equal: leave it out, or hold the speed that leaves no crush, b0";
        let crushless = (deepest == 0.0).then(|| Notice::warning("no-crush", at("depths"), format!("{}: {}", at("depths"), message())));
        self.notices.borrow_mut().extend(unusual.into_iter().flatten().chain(crushless));
        // The restitution that a measured rebound speed gives falls as the speed grows: what is lost, v² − u², then changes by 1/(1 − e²) times as much.
        let of_speed = |sd: f64| if has_rebound { sd / (1.0 - test.restitution * test.restitution) } else { sd };
        let speed_sd = speed_sd.map(|sd| sd.map(of_speed));
        let known = |deviation: Option<Option<f64>>| match deviation {
            Some(value) => value.map(Some),
            None => Some(None),
        };
        Some(Read { test, speed_sd: known(speed_sd)?, restitution_sd: known(restitution_sd)?, scatter: known(scatter)? })
    }

    /// Warns if the speed of a test is not that of its recording, by more than two standard deviations of their difference.
    fn compare_speeds(&self, table: &Table<'_>, speed: f64, sd: Option<f64>, recorded: &Recorded) {
        /// Rounding, as a share of the speed.
        const ROUNDING: f64 = 1e-9;
        let Some(of_record) = recorded.speed else { return };
        let scale = libm::hypot(sd.unwrap_or(0.0), of_record.deviation());
        if (speed - of_record.value).abs() <= (2.0 * scale).max(ROUNDING * speed) {
            return;
        }
        let message = Message::from("the speed of the test is ")
            .figure(Measure::RoadSpeed, speed)
            .text(format!(", and that of {} is ", recorded.file))
            .figure(Measure::RoadSpeed, of_record.value)
            .text(": its restitution is for that speed");
        self.notices.borrow_mut().push(Notice::warning("speeds-differ", format!("{}.speed", table.path()), message));
    }

    /// Reads the restitution of a test, or the speed at which the vehicle rebounds: e = v'/v.
    fn restitution_of_test(&self, table: &Table<'_>, speed: Option<f64>) -> Option<f64> {
        if !table.has("rebound_speed") {
            return alone(table, "restitution", "restitution_sd").and_then(|restitution| self.coefficient(restitution, 1.0));
        }
        let field = table.required("rebound_speed");
        let rebound = self.not_negative(field.clone(), Kind::SPEED);
        (one_of(table, "restitution", "rebound_speed") == Some("rebound_speed")).then_some(())?;
        let (rebound, speed) = (rebound?, speed?);
        if rebound > speed {
            field.report(format!("it is {rebound} m/s; it must not be above the speed of the test, {speed} m/s"), None);
            return None;
        }
        Some(rebound / speed)
    }

    fn fit(&self, table: &Table<'_>) -> Option<ReadFit> {
        let holds_onset = table.has("b0");
        let key = if holds_onset || table.has("onset") { one_of(table, "onset", "b0") } else { None };
        let mut is_both = holds_onset && key == Some("onset");
        let force = table.has("A").then(|| self.positive(table.optional("A"), Kind::from(Measure::ForcePerWidth)));
        if let Some(key) = key.filter(|_| force.is_some()) {
            table.optional("A").report(format!("`A` and `{key}` exclude each other"), Some("give one of them".to_owned()));
            is_both = true;
        }
        let onset = key.map(|key| self.not_negative(table.optional(key), Kind::SPEED));
        let asked = table.has("depth") || table.has("width");
        let prediction = asked.then(|| {
            let (depth, width) =
                (self.not_negative(table.required("depth"), Kind::LENGTH), self.positive(table.required("width"), Kind::LENGTH));
            let (depth, width) = (depth?, width?);
            self.notices
                .borrow_mut()
                .extend([unusual::depth("fit.depth", depth), unusual::width("fit.width", width)].into_iter().flatten());
            Some(Prediction { depth, width })
        });
        table.finish();
        let onset = match onset {
            Some(onset) => Some(onset?),
            None => None,
        };
        let force = match force {
            Some(force) => Some(force?),
            None => None,
        };
        let prediction = match prediction {
            Some(prediction) => Some(prediction?),
            None => None,
        };
        (!is_both).then_some(ReadFit { onset, holds_onset, force, prediction })
    }
}

/// Returns `true` if the restitution of a test is that of a recording.
fn is_recorded(test: &Table<'_>) -> bool {
    matches!(test.optional("restitution").value(), Some(Value::Table(_)))
}

impl<'a> Seen<'a> {
    fn add(&mut self, test: Table<'a>, read: Option<&Read>) {
        if let Some(Read { test: read, .. }) = read.filter(|read| read.test.crush.mean_depth() > 0.0) {
            // No two cars are crushed to the same numbers: a fit would count one test as two.
            match self.crushed.iter().find(|(other, _)| other == read) {
                Some((_, first)) => {
                    let help = "leave one of them out: a test is of one vehicle, and counts once".to_owned();
                    test.issue(format!("it has the numbers of {first}, which would count twice"), Some(help));
                }
                None => self.crushed.push((*read, test.path().to_owned())),
            }
        }
        if is_recorded(&test) || ["speed_sd", "restitution_sd", "scatter"].iter().any(|key| test.has(key)) {
            self.is_any = true;
        } else {
            self.bare.push(test);
        }
    }

    /// Returns `true` if the file gives any; if so, reports each test that has none.
    fn finish(self) -> bool {
        for test in self.bare.iter().filter(|_| self.is_any) {
            let help = "give a speed_sd, a restitution_sd or a scatter, or leave them out everywhere: then all tests weigh alike";
            test.issue("no standard deviation here, though other tests have one", Some(help.to_owned()));
        }
        self.is_any
    }
}

/// Returns the field of a number whose standard deviation has a key of its own, or reports one that stands in it.
fn alone<'a>(test: &Table<'a>, key: &'static str, deviation: &'static str) -> Option<Field<'a>> {
    let field = test.required(key);
    if !matches!(field.value(), Some(Value::String(text)) if text.contains('±')) {
        return Some(field);
    }
    field.report("its standard deviation has a key of its own", Some(format!("give the value alone, and {deviation}")));
    None
}
