//! The file of barrier tests.

use planar_impact::barrier::{BarrierTest, MeasuredTest};

use crate::case::Given;
use crate::document::{Document, Problems, Table};
use crate::quantity::Kind;
use crate::units::Units;

/// The most tests: their covariance is inverted as a whole, which takes a second for so many.
const MOST_TESTS: usize = 500;

/// What a file of barrier tests gives.
pub struct TestFile {
    pub title: String,
    /// The vehicles with their tests, one or more each, in order.
    pub vehicles: Vec<Tested>,
    /// The speed that is assumed to leave no crush.
    pub onset: Option<f64>,
    /// Where to say what the fit leaves uncertain.
    pub prediction: Option<Prediction>,
    /// Whether the file gives any standard deviation.
    pub has_deviations: bool,
    pub units: Units,
    pub notes: Vec<String>,
}

/// A vehicle with its tests.
pub struct Tested {
    pub name: String,
    pub tests: Vec<MeasuredTest>,
}

/// A flat crush whose energy is asked for.
pub struct Prediction {
    pub depth: f64,
    pub width: f64,
}

/// Which tests of a file have standard deviations: all or none must.
#[derive(Default)]
struct Deviations<'a> {
    bare: Vec<Table<'a>>,
    is_any: bool,
}

/// A test with what the file says of its scatter.
struct Read {
    test: BarrierTest,
    speed_sd: Option<f64>,
    restitution_sd: Option<f64>,
    scatter: Option<f64>,
}

impl TestFile {
    /// # Errors
    ///
    /// Everything wrong with the file.
    pub fn read(document: &Document) -> Result<TestFile, Problems> {
        let given = Given::default();
        let mut file = document.read(|root| given.tests(root))?;
        file.units = given.units();
        file.notes = given.notes.into_inner();
        Ok(file)
    }
}

impl Given {
    fn tests(&self, root: &Table<'_>) -> Option<TestFile> {
        let schema = root.required("schema").integer(1..=1);
        let title = root.optional("title").string().unwrap_or_default().to_owned();
        let vehicles = root.required("vehicle").array_of_tables();
        let mut deviations = Deviations::default();
        let vehicles = vehicles
            .map(|tables| tables.iter().enumerate().map(|(i, table)| self.tested(table, i + 1, &mut deviations)).collect::<Vec<_>>());
        let fit = root.has("fit").then(|| root.optional("fit").table().and_then(|table| self.fit(&table)));
        let has_deviations = deviations.finish();
        schema?;
        let (onset, prediction) = match fit {
            Some(fit) => fit?,
            None => (None, None),
        };
        let vehicles: Vec<(String, Vec<Read>)> = vehicles?.into_iter().collect::<Option<_>>()?;
        let count: usize = vehicles.iter().map(|(_, tests)| tests.len()).sum();
        if count > MOST_TESTS {
            root.optional("vehicle").report(format!("{count} tests are more than the {MOST_TESTS} that are taken"), None);
            return None;
        }
        let measured = |read: Read| MeasuredTest {
            test: read.test,
            speed_deviation: read.speed_sd.unwrap_or(0.0),
            restitution_deviation: read.restitution_sd.unwrap_or(0.0),
            // Any number alike for all, where the file has none.
            scatter: read.scatter.unwrap_or(if has_deviations { 0.0 } else { 1.0 }),
        };
        let vehicles = vehicles.into_iter().map(|(name, tests)| Tested { name, tests: tests.into_iter().map(measured).collect() });
        let vehicles = vehicles.collect();
        Some(TestFile { title, vehicles, onset, prediction, has_deviations, units: Units::Si, notes: Vec::new() })
    }

    fn tested<'a>(&self, table: &Table<'a>, number: usize, deviations: &mut Deviations<'a>) -> Option<(String, Vec<Read>)> {
        let name = table.optional("name").string().map_or_else(|| format!("vehicle {number}"), str::to_owned);
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
        tests.into_iter().for_each(|test| deviations.add(test));
        Some((name, read.into_iter().collect::<Option<_>>()?))
    }

    fn test(&self, table: &Table<'_>) -> Option<Read> {
        let mass = self.positive(table.required("mass"), Kind::MASS);
        let speed = self.positive(table.required("speed"), Kind::SPEED);
        let restitution = self.coefficient(table.required("restitution"), 1.0);
        let profile = self.profile(table);
        let deviation = |key, kind| table.has(key).then(|| self.not_negative(table.optional(key), kind));
        let speed_sd = deviation("speed_sd", Kind::SPEED);
        let restitution_sd = deviation("restitution_sd", Kind::PURE);
        let scatter = deviation("scatter", Kind::ROOT_FORCE);
        table.finish();
        let crush = profile?.on_scalar(|_| 0.0).moments();
        let test = BarrierTest { mass: mass?, speed: speed?, restitution: restitution?, crush };
        let known = |deviation: Option<Option<f64>>| match deviation {
            Some(value) => value.map(Some),
            None => Some(None),
        };
        Some(Read { test, speed_sd: known(speed_sd)?, restitution_sd: known(restitution_sd)?, scatter: known(scatter)? })
    }

    fn fit(&self, table: &Table<'_>) -> Option<(Option<f64>, Option<Prediction>)> {
        let onset = table.has("onset").then(|| self.not_negative(table.optional("onset"), Kind::SPEED));
        let asked = table.has("depth") || table.has("width");
        let prediction = asked.then(|| {
            let (depth, width) =
                (self.not_negative(table.required("depth"), Kind::LENGTH), self.positive(table.required("width"), Kind::LENGTH));
            Some(Prediction { depth: depth?, width: width? })
        });
        table.finish();
        let onset = match onset {
            Some(onset) => Some(onset?),
            None => None,
        };
        let prediction = match prediction {
            Some(prediction) => Some(prediction?),
            None => None,
        };
        Some((onset, prediction))
    }
}

impl<'a> Deviations<'a> {
    fn add(&mut self, test: Table<'a>) {
        if ["speed_sd", "restitution_sd", "scatter"].iter().any(|key| test.has(key)) {
            self.is_any = true;
        } else {
            self.bare.push(test);
        }
    }

    /// Whether the file gives any, with a report at each test that has none then.
    fn finish(self) -> bool {
        for test in self.bare.iter().filter(|_| self.is_any) {
            let help = "give a speed_sd, a restitution_sd or a scatter, or leave them out everywhere: then all tests weigh alike";
            test.problem("no standard deviation here, though other tests have one", Some(help.to_owned()));
        }
        self.is_any
    }
}
