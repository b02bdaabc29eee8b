//! Records as CSV: a line of column names, a line of units, and a line for each record.

use std::io::{self, BufRead};

use csv_core::{ReadRecordResult, Reader};
use planar_impact::check::{Key, ResolutionGroup};

use super::complaint::{Complaints, Numbered, Unreadable, refused};
use super::draft::{Draft, Drafted, TEXTS, resolution_keys, resolution_names};
use super::header::check_schema;
use super::lines::{LONGEST, Line, Lines, unreadable};
use super::units::{kind_of, size_of};
use crate::batch::separated_otherwise;
use crate::quantity::{self, excerpt, nearest};
use crate::quotes::{QuoteFault, Quotes};
use crate::wording::ragged;

/// Maximum number of columns; there are fewer valid names.
const MOST_COLUMNS: usize = 500;

/// Splits lines into fields.
pub struct Fields {
    reader: Reader,
    text: Vec<u8>,
    ends: Vec<usize>,
}

impl Fields {
    pub fn new() -> Fields {
        Fields { reader: Reader::new(), text: vec![0; LONGEST + 1], ends: vec![0; MOST_COLUMNS + 1] }
    }

    /// Splits a line into trimmed fields.
    ///
    /// # Errors
    ///
    /// Returns a message if a quotation mark is unmatched, a field goes on after one, or there are too many fields.
    fn split(&mut self, line: &str) -> Result<Vec<&str>, String> {
        if let Some(QuoteFault::GoesOn(_)) = Quotes::fault_of(line) {
            return Err("a field goes on after its closing quotation mark; write one within a field twice".to_owned());
        }
        self.reader.reset();
        let count = read_line(&mut self.reader, line, &mut self.text, &mut self.ends)?;
        let text = &self.text;
        let mut start = 0;
        let fields = self.ends[..count].iter().map(|&end| {
            let field = &text[start..end];
            start = end;
            // The text is split only at ASCII characters, so the pieces are valid UTF-8.
            str::from_utf8(field).unwrap_or("").trim()
        });
        Ok(fields.collect())
    }
}

/// What follows a carriage return would be another line, and be lost.
const LONE_RETURN: &str = "a carriage return stands within the line; end each line with a line feed";

/// Returns the number of fields in a line.
fn read_line(reader: &mut Reader, line: &str, text: &mut [u8], ends: &mut [usize]) -> Result<usize, String> {
    let (result, used, written, fields) = reader.read_record(line.as_bytes(), text, ends);
    // A line without its newline is incomplete; the newline completes it unless a quotation is open.
    let (result, _, _, more) = match result {
        ReadRecordResult::InputEmpty if used == line.len() => reader.read_record(b"\n", &mut text[written..], &mut ends[fields..]),
        other => (other, 0, 0, 0),
    };
    match result {
        ReadRecordResult::Record if used < line.len() => Err(LONE_RETURN.to_owned()),
        ReadRecordResult::Record => Ok(fields + more),
        ReadRecordResult::InputEmpty => {
            Err("a quotation mark has no partner in this line; a record stands in one line, and no cell has a line break".to_owned())
        }
        _ => Err(format!("there are more than {MOST_COLUMNS} fields")),
    }
}

/// The content of a column.
enum Column {
    Text(&'static str),
    Number {
        key: Key,
        size: f64,
    },
    Resolution {
        name: &'static str,
        measure: ResolutionGroup,
        keys: Vec<Key>,
        size: f64,
    },
    /// Without a name or a unit, as a spreadsheet pads lines.
    Padding,
}

/// A table of records.
pub struct Table<R> {
    lines: Lines<R>,
    fields: Fields,
    columns: Vec<Column>,
}

impl<R: BufRead> Table<R> {
    /// Reads the column names and the units.
    ///
    /// # Errors
    ///
    /// Fails if the reader fails. The inner result holds everything wrong with the two lines, with their numbers.
    pub fn open(mut lines: Lines<R>) -> io::Result<Result<Self, Vec<(u64, Complaints)>>> {
        let mut fields = Fields::new();
        let head = match read_head(&mut lines, &mut fields)? {
            Ok(head) => head,
            Err(problem) => return Ok(Err(vec![problem])),
        };
        let [(at, names), (units_at, units)] = head;
        let (mut of_names, mut of_units) = (Complaints::default(), Complaints::default());
        if units.len() != names.len() {
            let message = format!("the line of units has {} fields and that of columns {}", units.len(), names.len());
            of_units.push("", message);
        }
        let units = units.iter().map(String::as_str).chain(std::iter::repeat(""));
        let has_units = units.clone().take(names.len()).any(|unit| !unit.is_empty());
        let is_data = units.clone().take(names.len()).any(|unit| unit.parse::<f64>().is_ok_and(|number| number != 1.0));
        let is_missing = is_data || (!has_units && names.iter().any(|name| has_unit(name)));
        if is_missing {
            of_units.push("", "the line of units is missing: behind the columns stands the unit of each, empty for a text or a ratio");
        }
        let mut columns = Vec::new();
        for (i, (name, unit)) in names.iter().zip(units).enumerate() {
            if name.is_empty() && unit.is_empty() {
                columns.push(Column::Padding);
                continue;
            }
            if names[..i].contains(name) {
                of_names.push(name, "the column stands twice");
            }
            if let Some(column) = column(name, unit, &mut of_names, &mut of_units, !is_missing) {
                columns.push(column);
            }
        }
        if !names.iter().any(|name| name == "id") {
            of_names.push("", "the column `id` is missing");
        }
        let problems = [(at, of_names), (units_at, of_units)].into_iter().filter(|(_, complaints)| !complaints.is_empty());
        let problems: Vec<_> = problems.collect();
        lines.skip_commas();
        Ok(if problems.is_empty() { Ok(Table { lines, fields, columns }) } else { Err(problems) })
    }

    /// Returns `true` if there is another record.
    ///
    /// # Errors
    ///
    /// Fails if the reader fails.
    pub fn has_more(&mut self) -> io::Result<bool> {
        self.lines.has_more()
    }

    /// Returns the next record and its line number.
    ///
    /// # Errors
    ///
    /// Fails if the reader fails.
    pub fn next(&mut self) -> io::Result<Option<Numbered>> {
        let Some(line) = self.lines.next()? else { return Ok(None) };
        let read = match line {
            Line::Text(text) => self.fields.split(text).map_err(|message| refused(&message)).and_then(|row| read_row(&self.columns, &row)),
            other => Err(refused(&unreadable(&other))),
        };
        Ok(Some((self.lines.number(), read)))
    }
}

type Head = [(u64, Vec<String>); 2];

/// Reads the two header lines, skipping comments before them.
fn read_head<R: BufRead>(lines: &mut Lines<R>, fields: &mut Fields) -> io::Result<Result<Head, (u64, Complaints)>> {
    let problem = |at: u64, message: &str| {
        let mut complaints = Complaints::default();
        complaints.push("", message);
        Ok(Err((at, complaints)))
    };
    let mut head: Vec<(u64, Vec<String>)> = Vec::new();
    while head.len() < 2 {
        let Some(line) = lines.next()? else {
            let missing =
                if head.is_empty() { "the line of column names is missing" } else { "the line of units and the records are missing" };
            return problem(lines.number().max(1), missing);
        };
        let text = match line {
            Line::Text(text) => text.to_owned(),
            other => {
                let message = unreadable(&other);
                return problem(lines.number(), &message);
            }
        };
        let at = lines.number();
        if let Some(comment) = text.strip_prefix('#') {
            if comment.contains('\r') {
                return problem(at, LONE_RETURN);
            }
            // A spreadsheet ends each line with a comma for each column.
            if let Some(schema) =
                comment.split_whitespace().map(|word| word.trim_end_matches(',')).find(|word| word.starts_with("planar-impact-record"))
                && let Err(message) = check_schema(schema)
            {
                return problem(at, &message);
            }
            continue;
        }
        if let Some(wrong) = separated_otherwise(&text).filter(|_| head.is_empty()) {
            return problem(at, &wrong.join("; "));
        }
        match fields.split(&text) {
            Ok(row) => head.push((at, row.into_iter().map(str::to_owned).collect())),
            Err(message) => return problem(at, &message),
        }
    }
    let [names, units] = [head.remove(0), head.remove(0)];
    Ok(Ok([names, units]))
}

/// Returns `true` if a column has numbers with a unit.
fn has_unit(name: &str) -> bool {
    let of_resolution = || resolution_keys(name.strip_prefix("resolution.")?).map(|(measure, _)| measure);
    Key::named(name).map(Key::group).or_else(of_resolution).is_some_and(|measure| !kind_of(measure).si.is_empty())
}

/// Returns the content of a column with this name and unit.
fn column(name: &str, unit: &str, of_names: &mut Complaints, of_units: &mut Complaints, with_units: bool) -> Option<Column> {
    if let Some(text) = TEXTS.into_iter().find(|text| *text == name) {
        if with_units && !unit.is_empty() && unit != "-" {
            of_units.push(name, format!("it is a text and has no unit; found {}", excerpt(unit)));
        }
        return Some(Column::Text(text));
    }
    let mut size = |measure| if with_units { of_units.accept(name, size_of(unit, kind_of(measure))) } else { Some(1.0) };
    if let Some(key) = Key::named(name) {
        return Some(Column::Number { key, size: size(key.group())? });
    }
    if let Some(of) = name.strip_prefix("resolution.")
        && let Some((measure, keys)) = resolution_keys(of)
    {
        let name = resolution_names().find(|known| *known == of).unwrap_or_default();
        return Some(Column::Resolution { name, measure, keys, size: size(measure)? });
    }
    let all = TEXTS.into_iter().chain(Key::ALL.into_iter().map(Key::name)).map(str::to_owned);
    let all: Vec<String> = all.chain(resolution_names().map(|of| format!("resolution.{of}"))).collect();
    let bare = name.split(['[', '(']).next().unwrap_or_default().trim_end();
    let meant = match nearest(name, all.iter().map(String::as_str)) {
        _ if bare != name && all.iter().any(|known| known == bare) => "; units stand in a line of their own, below the names".to_owned(),
        Some(near) => format!("; did you mean `{near}`?"),
        None => String::new(),
    };
    let message = if name.is_empty() {
        format!("the column of the unit {} has no name", excerpt(unit))
    } else {
        format!("unknown column {}{meant}", excerpt(name))
    };
    of_names.push("", message);
    None
}

fn read_row(columns: &[Column], row: &[&str]) -> Result<Drafted, Unreadable> {
    if row.len() != columns.len() {
        return Err(refused(&ragged(row.len(), columns.len())));
    }
    let mut draft = Draft::default();
    for (column, field) in columns.iter().zip(row).filter(|(_, field)| !field.is_empty()) {
        match column {
            Column::Padding => draft.complaints.push("", format!("{} stands in a column without a name", excerpt(field))),
            Column::Text(name) => draft.text(name, field),
            Column::Number { key, size } => {
                let value = number(field);
                if let Some(value) = draft.complaints.accept(key.name(), value) {
                    draft.number(*key, value, *size);
                }
            }
            Column::Resolution { name, measure, keys, size } => {
                let value = number(field);
                if let Some(value) = draft.complaints.accept(&format!("resolution.{name}"), value) {
                    draft.resolution(*measure, keys, value * size);
                }
            }
        }
    }
    draft.finish()
}

/// Parses a decimal number. Non-finite results are left to the rules.
fn number(field: &str) -> Result<f64, String> {
    // Rust also parses words such as `nan` and `infinity`.
    let value = field.parse::<f64>();
    if let Ok(value) = value
        && value != 0.0
    {
        return Ok(value);
    }
    if value.is_err() && field.starts_with(|c: char| c.is_ascii_digit() || c == '-') && field.ends_with(char::is_alphabetic) {
        return Err(format!("{} is not a number; its unit belongs in the line of units", excerpt(field)));
    }
    quantity::finite(field).map_err(|error| error.to_string())
}
