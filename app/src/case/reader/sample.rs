//! Uncertain inputs that are known from measurements: their mean, standard deviation and number, or each of them.

use std::cell::Cell;

use planar_impact::Distribution;

use super::CaseReader;
use super::csv_column::CsvColumn;
use crate::batch::{unit_in_name, units_below};
use crate::case::domain::Domain;
use crate::case::uncertain::{MOST_VALUES, Uncertain};
use crate::document::{Field, Table};
use crate::notice::Notice;
use crate::quantity::{self, Conversion, Kind, Quantity, QuantityError, nearest};
use crate::quotes::Quotes;
use crate::source::Source;

/// Help for an input that does not vary.
const CERTAIN: &str = "a certain number needs no table: give it alone";

impl CaseReader {
    /// Reads `mean`, `sd` and `n`: the mean of a quantity as far as n measurements tell it.
    pub(super) fn mean_of_measurements(&self, table: &Table<'_>, kind: Kind, domain: Domain) -> Option<(f64, Option<Distribution>)> {
        let mean = self.certain(table.required("mean"), kind, domain);
        let sd = self.quantity(table.required("sd"), kind.difference()).filter(|sd| {
            if *sd <= 0.0 {
                let message = format!("it is {sd} {}; the standard deviation of measurements must be above zero", kind.si);
                table.optional("sd").report(message, Some(CERTAIN.to_owned()));
            }
            *sd > 0.0
        });
        let n = if table.has("n") {
            table.required("n").integer(2..=i64::from(u32::MAX)).and_then(|n| u32::try_from(n).ok())
        } else {
            let help = "expected the number of measurements, from 2; for a normal distribution write `value` instead of `mean`";
            table.required("n").report_as("missing-key", "missing", Some(help.to_owned()));
            None
        };
        let (mean, sd, n) = (mean?, sd?, n?);
        Some((mean, Some(Distribution::StudentT { mean, sd, n })))
    }

    /// Reads `values`, in SI.
    pub(super) fn values_of_list(&self, table: &Table<'_>, kind: Kind, domain: Domain) -> Option<Vec<f64>> {
        let field = table.required("values");
        let place = field.clone();
        let items = field.items(&format!("an array of values, each {}", kind.wanted()), 0..=usize::MAX)?;
        if items.len() > MOST_VALUES {
            place.report(too_many(items.len()), Some(FEWER.to_owned()));
            return None;
        }
        let values = self.each(items, kind, domain)?;
        enough(&values, kind).map_err(|(message, help)| place.report(message, Some(help))).ok()?;
        Some(values)
    }

    /// Reads the items of an array, with one note for all numbers without a unit.
    pub(super) fn each(&self, items: Vec<Field<'_>>, kind: Kind, domain: Domain) -> Option<Vec<f64>> {
        let is_noted = Cell::new(false);
        let read: Vec<Option<f64>> = items
            .into_iter()
            .map(|item| {
                let at = item.clone();
                let quantity = item.quantity(kind)?;
                let is_as_before = quantity.bare && is_noted.replace(true);
                let unit = if is_as_before { String::new() } else { quantity.unit.clone() };
                self.within(&at, self.take(at.path(), Quantity { unit, ..quantity }, kind), kind, domain)
            })
            .collect();
        read.into_iter().collect()
    }

    /// Reads `file` and `column`: the values of a column of a CSV file, in SI.
    pub(super) fn values_of_file(&self, table: &Table<'_>, kind: Kind, domain: Domain) -> Option<Vec<f64>> {
        let (column, file) = (table.required("column"), table.required("file"));
        let (of_column, of_file) = (column.clone(), file.clone());
        let name = column.string();
        let source = self.opened(file, "give the values in the case itself: { values = [\u{2026}] }");
        let (name, source) = (name?, source?);
        if let Some(fault) = Quotes::fault_of(&source.text) {
            of_file.report(format!("{}:{}: {fault}", source.name, fault.line()), None);
            return None;
        }
        let column =
            CsvColumn::of(&source.text, name).map_err(|missing| of_column.report(missing.message(&source), missing.help())).ok()?;
        let unit = column.unit.as_deref();
        let conversion = match unit.map(|unit| Conversion::in_header(unit, kind)).transpose() {
            Ok(conversion) => conversion,
            Err(error) => {
                let help =
                    error.help.or_else(|| Some(format!("write the unit of {} in the header, such as \"{}\" has", kind.name, kind.example)));
                of_column.report(format!("{}: {name} [{}]: {}", source.name, unit.unwrap_or_default(), error.message), help);
                return None;
            }
        };
        let (mut values, mut lines) = (Vec::new(), Vec::new());
        let (mut sound, mut bare, mut with_unit) = (true, None, None);
        for (line, cell) in column.cells {
            let read =
                cell.as_ref().map_err(|none| QuantityError::from(*none)).and_then(|cell| read_cell(cell, unit.zip(conversion), kind));
            let read = read.and_then(|read| match domain.wanted(read.si) {
                Some(wanted) => Err(QuantityError {
                    message: format!("it is {} {}; it must be {wanted}", read.si, kind.si).replace(" ;", ";"),
                    help: None,
                }),
                None => Ok(read),
            });
            match read {
                Ok(read) => {
                    let is_bare = read.bare && !read.unit.is_empty();
                    if !is_bare && read.unit != kind.si && unit.is_none() {
                        with_unit.get_or_insert_with(|| (line, read.unit.clone()));
                    }
                    if is_bare && bare.is_none() {
                        if let Some((bare, unit)) = unit_in_name(name, kind) {
                            let help = format!("write `{bare} [{unit}]`, and `column = \"{bare}\"`");
                            of_column.report(format!("{}: {name}: the unit of a column is read in brackets", source.name), Some(help));
                            return None;
                        }
                        let what = if values.is_empty() { String::new() } else { format!("line {line} in ") };
                        let message =
                            format!("{}: {what}the column {name} of {} has no unit: {} assumed", of_column.path(), source.name, read.unit);
                        self.notices.borrow_mut().push(Notice::note("unit-assumed", of_column.path(), message));
                        bare = Some(line);
                    }
                    if values.is_empty() {
                        self.take(of_column.path(), Quantity { bare: false, ..read.clone() }, kind);
                    }
                    values.push(read.si);
                    lines.push(line);
                }
                Err(QuantityError { message, help }) => {
                    let of_units = cell.ok().and_then(|cell| units_below(name, &cell, kind));
                    let help = of_units.or(help).or_else(|| Some("correct the cell, or remove its row".to_owned()));
                    of_file.report(format!("{}:{line}: {name}: {message}", source.name), help);
                    sound = false;
                }
            }
            if values.len() > MOST_VALUES {
                of_file.report(format!("{}: {}", source.name, too_many(values.len())), Some(FEWER.to_owned()));
                return None;
            }
        }
        if !sound {
            return None;
        }
        if let (Some(bare), Some((line, unit))) = (bare, &with_unit) {
            let bare = format!("{}: line {bare} in the column {name} of {}", of_column.path(), source.name);
            self.notices.borrow_mut().push(Notice::mixed_units(of_column.path(), &bare, kind.si, [&format!("line {line}"), unit]));
        }
        enough(&values, kind).map_err(|(message, help)| of_file.report(format!("{}: {name}: {message}", source.name), Some(help))).ok()?;
        self.columns.borrow_mut().push(MeasuredColumn { file: source.name, of: table.path().to_owned(), lines, values: values.clone() });
        Some(values)
    }

    /// Notes the uncertain inputs that are columns of one file, whose rows go together, and that have no correlation.
    pub(super) fn note_independent_columns(&self, uncertain: &Uncertain) {
        let columns = self.columns.borrow();
        let input = |column: &MeasuredColumn| uncertain.inputs.iter().find(|input| input.key == column.of).map(|input| input.parameter);
        for (i, one) in columns.iter().enumerate() {
            for other in columns[i + 1..].iter().filter(|other| other.file == one.file && other.lines == one.lines) {
                let Some((a, b)) = input(one).zip(input(other)).filter(|(a, b)| uncertain.correlation(*a, *b) == 0.0) else { continue };
                let coefficient = correlation(&one.values, &other.values);
                // What three standard deviations of chance do not make.
                let square = coefficient * coefficient;
                if square * (one.values.len() as f64 - 2.0) > 9.0 * (1.0 - square) {
                    let message = format!(
                        "{a} and {b} are columns of {}, whose rows have a correlation of {coefficient:.2}, and count as independent: if each row is one \
                         measurement, give it as their `correlation`",
                        one.file
                    );
                    self.notices.borrow_mut().push(Notice::warning("independent-columns", other.of.clone(), message));
                }
            }
        }
    }
}

/// A column of measured values, and the lines of its file that have them.
pub(super) struct MeasuredColumn {
    file: String,
    /// The path of the input.
    of: String,
    lines: Vec<usize>,
    values: Vec<f64>,
}

/// Returns the coefficient of correlation of as many values.
fn correlation(one: &[f64], other: &[f64]) -> f64 {
    let centered = |values: &[f64]| {
        let mean = normal_of(values).0;
        values.iter().map(|value| value - mean).collect::<Vec<f64>>()
    };
    let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let (one, other) = (centered(one), centered(other));
    product(&one, &other) / (product(&one, &one) * product(&other, &other)).sqrt()
}

/// Help for too many values.
const FEWER: &str = "give a part of them, drawn at random, or their distribution";

fn too_many(count: usize) -> String {
    format!("it has {count} values or more; at most {MOST_VALUES} are accepted")
}

/// Returns an error and its help unless there are two values that differ.
fn enough(values: &[f64], kind: Kind) -> Result<(), (String, String)> {
    match values {
        [] => Err(("it has no value; at least two are needed".to_owned(), CERTAIN.to_owned())),
        [_] => Err(("it has one value; at least two are needed".to_owned(), "give the number alone, or its `value` and `sd`".to_owned())),
        [first, ..] if normal_of(values).1 <= 0.0 => {
            let message = format!("all {} values are {first} {}", values.len(), kind.si);
            Err((message.trim_end().to_owned(), CERTAIN.to_owned()))
        }
        _ => Ok(()),
    }
}

/// Reads a cell of a column, with the unit of the header if it has one.
pub(crate) fn read_cell(cell: &str, unit: Option<(&str, Conversion)>, kind: Kind) -> Result<Quantity, QuantityError> {
    let Some((unit, conversion)) = unit else { return quantity::parse_word(cell, kind) };
    let value = quantity::finite(cell)?;
    let si = conversion.to_si(value);
    if !kind.domain.holds(si) {
        return Err(QuantityError { message: format!("{cell} {unit} is out of range for {}", kind.name), help: None });
    }
    Ok(Quantity { si, value, unit: unit.to_owned(), bare: false, pound_force: conversion.pound_force })
}

/// Returns the mean of values and the standard deviation of one that is drawn from them.
pub(super) fn normal_of(values: &[f64]) -> (f64, f64) {
    let count = values.len() as f64;
    let [least, greatest] =
        [values.iter().copied().fold(f64::INFINITY, f64::min), values.iter().copied().fold(f64::NEG_INFINITY, f64::max)];
    // Rounding must not take the mean beyond the values, and so beyond the domain.
    let mean = (values.iter().sum::<f64>() / count).clamp(least, greatest);
    let variance = values.iter().map(|value| (value - mean) * (value - mean)).sum::<f64>() / count;
    (mean, variance.sqrt())
}

impl super::csv_column::NoColumn {
    fn message(&self, source: &Source) -> String {
        let name = quantity::excerpt(&self.name);
        match self.count {
            0 => format!("{} has no column {name}", source.name),
            count => format!("{} has {count} columns {name}", source.name),
        }
    }

    fn help(&self) -> Option<String> {
        let listed = || format!("its columns are {}", self.names.iter().map(|name| quantity::excerpt(name)).collect::<Vec<_>>().join(", "));
        Some(match self.count {
            0 if self.names.is_empty() => "the first line of the file names its columns".to_owned(),
            0 => match nearest(&self.name, self.names.iter().map(String::as_str)) {
                Some(meant) => format!("did you mean `{meant}`? {}", listed()),
                None => listed(),
            },
            _ => "give each column a name of its own".to_owned(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::{Case, Parameter};
    use crate::issue::Issues;
    use planar_impact::{Input, Side};

    /// Reads a case with a mass and a restitution; every file that it names has the given text.
    fn read(mass: &str, restitution: &str, csv: &'static str) -> Result<Case, Issues> {
        let vehicle = |mass: &str| {
            format!("[[vehicle]]\nmass = {mass}\nyaw_inertia = 1500\nheading = 0\nspeed = \"10 m/s\"\nimpact_center = [\"2 m\", \"0 m\"]\n")
        };
        let contact = format!("[contact]\ncrush_plane = 0\nrestitution = {restitution}\n");
        let text = format!("schema = 1\n{}{}{contact}", vehicle(mass), vehicle("\"1 t\""));
        let open = move |name: &str| Ok(Source::new(format!("folder/{name}"), csv));
        Case::parse_with(Source::new("case.toml", text), Box::new(open))
    }

    const MASS: Parameter = Parameter::Input(Input::Mass(Side::One));

    const OF_FILE: &str = "{ file = \"tests.csv\", column = \"m\" }";

    /// Returns the messages and remedies of a case that is refused.
    fn refused(mass: &str, csv: &'static str) -> Vec<String> {
        let issues = read(mass, "0.1", csv).err().expect("it is refused");
        assert!(issues.list().iter().all(|issue| issue.help.is_some()), "{issues}");
        issues.to_string().lines().map(str::to_owned).collect()
    }

    #[test]
    fn values_are_equally_likely() {
        for (mass, csv) in [
            ("{ values = [\"1.5 t\", 1600, 1700] }", ""),
            (OF_FILE, "site,m [t]\na,1.5\nb,1.6\nc,1.7\n"),
            (OF_FILE, "m,site\n1.5 t,a\n1600 kg,b\n1700,\n"),
            (OF_FILE, "m [kg]\r\n1500\r\n\r\n1600\r\n1.7e3"),
        ] {
            let case = read(mass, "0.1", csv).expect("a case");
            let [input] = &case.uncertain.inputs[..] else { panic!("{:?}", case.uncertain) };
            assert_eq!((input.parameter, input.key.as_str(), input.nominal), (MASS, "vehicle.1.mass", 1600.0), "{mass}");
            assert_eq!(input.values.as_deref(), Some(&[1500.0, 1600.0, 1700.0][..]), "{mass}");
            // The variance of one that is drawn is the mean square, 20 000/3.
            let Distribution::Normal { mean, sd } = input.distribution else { panic!("{:?}", input.distribution) };
            assert!(mean == 1600.0 && (sd - (20_000.0_f64 / 3.0).sqrt()).abs() < 1e-10, "{sd}");
            assert_eq!(case.inputs.value(MASS), Ok(1600.0));
        }
        let pure = read("1500", "{ file = \"e.csv\", column = \"e\" }", "e [1]\n0.1\n0.3\n").expect("a case");
        assert_eq!(pure.uncertain.inputs[0].values.as_deref(), Some(&[0.1, 0.3][..]));
        let percent = read("1500", "{ values = [\"10 %\", 0.3] }", "").expect("a case");
        assert_eq!(percent.uncertain.inputs[0].values.as_deref(), Some(&[0.1, 0.3][..]));
    }

    #[test]
    fn the_mean_is_in_the_domain_as_its_values_are() {
        // The sum of three tenths, rounded, is above three times a tenth.
        assert_eq!(normal_of(&[0.1; 3]), (0.1, 0.0));
        let (mean, sd) = normal_of(&[0.1, 0.1, 0.1 + 1e-9]);
        assert!((0.1..=0.1 + 1e-9).contains(&mean) && sd > 0.0);
    }

    #[test]
    fn a_unit_is_assumed_once() {
        let notes = |mass: &str, csv| -> Vec<String> {
            let case = read(mass, "0.1", csv).expect("a case");
            case.notices.0.iter().filter(|notice| notice.path.contains(".1.mass")).map(|notice| format!("{:?}", notice.message)).collect()
        };
        assert_eq!(notes("{ values = [1500, 1600, 1700] }", "").len(), 1);
        assert_eq!(notes("{ values = [\"1 t\", \"2 t\"] }", ""), [""; 0]);
        assert_eq!(notes(OF_FILE, "m [kg]\n1500\n1600\n"), [""; 0]);
        let [of_column] = &notes(OF_FILE, "m\n1500\n1600\n")[..] else { panic!("one note") };
        assert!(of_column.contains("m of folder/tests.csv has no unit: kg assumed"), "{of_column}");
    }

    #[test]
    fn every_bad_cell_has_its_line() {
        let found = refused(OF_FILE, "m [kg]\n1500\nheavy\n\n-3\nnan\n1e300\n\"\"\n1600\n");
        let wanted = ["3: m: `heavy` is not a number", "5: m: it is -3 kg; it must be above zero", "6: m: `nan` is not a finite number"];
        let others = ["7: m: 1e300 kg is out of range for a mass", "8: m: the cell is empty"];
        assert_eq!(found.len(), 5, "{found:?}");
        for (found, wanted) in found.iter().zip(wanted.into_iter().chain(others)) {
            assert!(found.starts_with(&format!("vehicle.1.mass.file: folder/tests.csv:{wanted}")), "{found}");
        }
        assert!(found[1].ends_with("(correct the cell, or remove its row)"), "{found:?}");
        let with_units = refused(OF_FILE, "m\nlb\n1500\n1600\n");
        assert!(with_units[0].ends_with("(write the unit in the header, as `m [lb]`, and remove the line of units)"), "{with_units:?}");
        assert!(refused(OF_FILE, "a,m\n1\n")[0].contains("tests.csv:2: m: the row has 1 cell, and the table has 2 columns"));
        // Without a unit in the header the cells are as numbers in a case file.
        assert!(refused(OF_FILE, "m\n5 m\n")[0].contains("`5 m` is a length; a mass is expected"));
        assert!(refused(OF_FILE, "m\n1500000000\n1\n")[0].contains("not a plausible mass"));
    }

    #[test]
    fn columns_that_are_not_there() {
        let column = |csv: &'static str| refused(OF_FILE, csv).remove(0);
        let found = column("mass [kg],site\n1500,a\n");
        assert!(
            found.starts_with("vehicle.1.mass.column: folder/tests.csv has no column `m` (") && found.contains("`mass`, `site`"),
            "{found}"
        );
        assert!(column("").contains("the first line of the file names its columns"));
        assert!(column("m,m [t]\n1,2\n").contains("has 2 columns `m`"));
        assert!(column("m [m]\n1\n2\n").contains("folder/tests.csv: m [m]: `m` is a length; a mass is expected"));
        assert!(column("m [stone]\n1\n2\n").contains("vehicle.1.mass.column: folder/tests.csv: m [stone]: "));
        assert!(
            column("m [m]\n1\n2\n").ends_with("(write the unit of a mass in the header, such as \"1500 kg\" has)"),
            "{}",
            column("m [m]\n1\n2\n")
        );
    }

    #[test]
    fn two_values_that_differ_are_needed() {
        for (mass, csv, says) in [
            ("{ values = [] }", "", "vehicle.1.mass.values: it has no value"),
            ("{ values = [1500] }", "", "vehicle.1.mass.values: it has one value"),
            ("{ values = [0.3, 0.3, 0.3] }", "", "vehicle.1.mass.values: all 3 values are 0.3 kg"),
            (OF_FILE, "m [kg]\n", "vehicle.1.mass.file: folder/tests.csv: m: it has no value"),
            (OF_FILE, "m [kg]\n1500", "m: it has one value"),
            (OF_FILE, "m [kg]\n1500\n1500", "m: all 2 values are 1500 kg"),
        ] {
            let found = refused(mass, csv);
            assert!(found.len() == 1 && found[0].contains(says), "{found:?}");
            let remedy = if says.ends_with("one value") {
                "(give the number alone, or its `value` and `sd`)".to_owned()
            } else {
                format!("({CERTAIN})")
            };
            assert!(found[0].ends_with(&remedy), "{found:?}");
        }
        // Their variance is below every float.
        assert_eq!(normal_of(&[0.0, 1e-200]).1, 0.0);
        assert!(enough(&[0.0, 1e-200], Kind::PURE).is_err() && enough(&[0.0, 1e-100], Kind::PURE).is_ok());
    }

    #[test]
    fn no_more_values_than_fit() {
        let listed = format!("{{ values = [{}] }}", "1,".repeat(MOST_VALUES + 1));
        assert!(refused(&listed, "")[0].contains("at most 1000000 are accepted"));
        let csv: &'static str = Box::leak(format!("m [kg]\n{}", "1\n2\n".repeat(MOST_VALUES / 2 + 1)).into_boxed_str());
        assert!(refused(OF_FILE, csv)[0].contains("at most 1000000 are accepted"));
    }

    #[test]
    fn a_case_without_files_has_a_remedy() {
        let text = "schema = 1\n[[vehicle]]\nmass = { file = \"m.csv\", column = \"m\" }\n".to_owned();
        let issues = Case::parse(Source::new("case.toml", text)).err().expect("it is refused");
        assert!(issues.to_string().contains("cannot name another one (give the values in the case itself"), "{issues}");
    }
}
