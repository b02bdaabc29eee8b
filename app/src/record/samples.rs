//! The samples of a recording: a CSV text whose first line names its columns, each with its unit in brackets.

use planar_impact::STANDARD_GRAVITY;
use planar_impact::barrier::{Record, TestIssue};

use super::ChannelQuantity;
use crate::batch::{Header, not_names, separated_otherwise, unit_in_name, units_below};
use crate::case::{Rows, read_cell};
use crate::notice::Notice;
use crate::quantity::{self, Conversion, Kind, QuantityError};
use crate::quotes::{QuoteFault, Quotes};
use crate::source::Source;
use crate::units::Units;

/// The name of the column with the times.
pub(super) const TIME: &str = "time";

/// A CSV text in rows.
pub(super) struct Samples {
    pub(super) headers: Vec<Header>,
    rows: Vec<(usize, Vec<String>)>,
    /// What is wrong with the quotes of the text.
    quotes: Option<QuoteFault>,
}

/// Something wrong with a line of the text.
pub(super) struct Fault {
    pub(super) line: usize,
    pub(super) column: String,
    pub(super) message: String,
    pub(super) help: String,
}

/// A column of samples.
pub(super) struct Column {
    pub(super) record: Record,
    /// The value of one unit of the last decimal of the number with the most decimals, in SI.
    pub(super) digit: f64,
}

/// How the numbers of a column become numbers in SI.
#[derive(Clone, Copy)]
enum Scale<'a> {
    /// By the unit in the header, if it has one.
    Unit(Option<(&'a str, Conversion)>, Kind),
    /// By what one in the column is.
    Calibration(f64),
}

impl Samples {
    pub(super) fn of(source: &Source) -> Samples {
        // A line of spaces alone is as empty as one without.
        let mut rows = Rows::of(&source.text).filter(|(_, cells)| !matches!(&cells[..], [only] if only.trim().is_empty()));
        let headers = rows.next().into_iter().flat_map(|(_, cells)| cells).map(|cell| Header::read(&cell)).collect();
        Samples { headers, rows: rows.collect(), quotes: Quotes::fault_of(&source.text) }
    }

    /// Returns the place of the column with a name.
    pub(super) fn place(&self, name: &str) -> Result<usize, Fault> {
        if let Some(fault) = self.quotes {
            let line = usize::try_from(fault.line()).unwrap_or(usize::MAX);
            return Err(self.fault(line, "", fault.to_string(), "correct the quotes, or remove them: numbers need none"));
        }
        let found: Vec<usize> = (0..self.headers.len()).filter(|&i| self.headers[i].name == name).collect();
        match found[..] {
            [place] => Ok(place),
            [] => Err(match &self.headers[..] {
                [only] if let Some([wrong, remedy]) = separated_otherwise(&only.name) => self.fault(1, "", wrong, remedy),
                all if let Some([wrong, remedy]) = not_names(all) => self.fault(1, "", wrong, remedy),
                _ => self.fault(1, name, "no column has this name", format!("its columns are {}", self.names())),
            }),
            _ => Err(self.fault(1, name, format!("{} columns have this name", found.len()), "give each column a name of its own")),
        }
    }

    /// Notes in which unit the columns without one are read: that of the times, and those of the channels that have a quantity.
    pub(super) fn units_assumed(&self, time: Option<usize>, of: impl Fn(&str) -> Option<ChannelQuantity>) -> Vec<Notice> {
        let kind = |(i, header): (usize, &Header)| match Some(i) == time {
            true => Some(Kind::DURATION),
            false => of(&header.name).map(ChannelQuantity::kind),
        };
        let note = |(i, header): (usize, &Header)| {
            let of_column = kind((i, header))?;
            let (si, is_alike) = (of_column.si, |other: &(usize, &Header)| kind(*other).is_some_and(|other| other.si == of_column.si));
            let other = self.headers.iter().enumerate().filter(is_alike).find_map(|(_, other)| Some((other, other.unit.as_deref()?)));
            Some(match other.filter(|(_, unit)| *unit != si) {
                Some((other, unit)) => {
                    Notice::mixed_units(header.name.as_str(), &format!("the column {}", header.name), si, [&other.name, unit])
                }
                None => Notice::note("unit-assumed", header.name.clone(), format!("the column {} has no unit: {si} assumed", header.name)),
            })
        };
        self.headers.iter().enumerate().filter(|(_, header)| header.unit.is_none()).filter_map(note).collect()
    }

    /// Lists the names of the columns.
    pub(super) fn names(&self) -> String {
        self.headers.iter().take(20).map(|header| quantity::excerpt(&header.name)).collect::<Vec<_>>().join(", ")
    }

    pub(super) fn fault(&self, line: usize, column: &str, message: impl Into<String>, help: impl Into<String>) -> Fault {
        Fault { line, column: column.to_owned(), message: message.into(), help: help.into() }
    }

    /// Returns the system of units that a column is in, if its header tells.
    pub(super) fn units(&self, place: usize) -> Option<Units> {
        self.headers[place].unit.as_deref().and_then(Units::of)
    }

    fn scale(&self, place: usize, kind: Kind, calibration: Option<f64>) -> Result<Scale<'_>, Fault> {
        let Header { name, unit } = &self.headers[place];
        match (calibration, unit.as_deref()) {
            (Some(_), Some(unit)) => {
                let message = format!("the column is in {unit}, and has a calibration too");
                Err(self.fault(1, name, message, "remove the unit from the header, or the calibration"))
            }
            (Some(one), None) => Ok(Scale::Calibration(one)),
            // Accelerometers are read in multiples of the standard gravity; elsewhere g is a gram.
            (None, Some("g" | "G" | "g's" | "G's" | "g’s" | "G’s")) if kind.dimension == Kind::ACCELERATION.dimension => {
                Ok(Scale::Calibration(STANDARD_GRAVITY))
            }
            (None, None) => match unit_in_name(name, kind) {
                Some((bare, unit)) => {
                    Err(self.fault(1, name, "the unit of a column is read in brackets", format!("write `{bare} [{unit}]`")))
                }
                None => Ok(Scale::Unit(None, kind)),
            },
            (None, Some(unit)) => match Conversion::in_header(unit, kind) {
                Ok(conversion) => Ok(Scale::Unit(Some((unit, conversion)), kind)),
                Err(QuantityError { message, help }) => {
                    let help =
                        help.unwrap_or_else(|| format!("write the unit of {} in the header, such as \"{}\" has", kind.name, kind.example));
                    Err(self.fault(1, name, format!("[{unit}]: {message}"), help))
                }
            },
        }
    }

    /// Reads a channel. Where its cell is empty the channel has no sample.
    pub(super) fn channel(&self, time: usize, place: usize, of: ChannelQuantity, gain: (Option<f64>, f64)) -> Result<Column, Vec<Fault>> {
        let (calibration, polarity) = gain;
        let name = self.headers[place].name.as_str();
        let (of_time, scale) = match (self.scale(time, Kind::DURATION, None), self.scale(place, of.kind(), calibration)) {
            (Ok(time), Ok(scale)) => (time, scale),
            (one, other) => return Err([one.err(), other.err()].into_iter().flatten().collect()),
        };
        let (mut times, mut values, mut faults) = (Vec::new(), Vec::new(), Vec::new());
        // Of rows whose value cannot be read too.
        let mut instants: Vec<(f64, usize)> = Vec::new();
        let mut finest: Option<(i32, f64)> = None;
        for (line, cells) in &self.rows {
            if cells.len() != self.headers.len() {
                let message = format!("the row has {} of {} cells", cells.len(), self.headers.len());
                let help = match cells.len() < self.headers.len() {
                    true => "the file may be cut off here: export it again, or remove the row",
                    false => "remove what is too much; a cell with a comma in it needs quotes",
                };
                faults.push(self.fault(*line, name, message, help));
                continue;
            }
            let [at, value_cell] = [time, place].map(|place| cells[place].trim());
            if value_cell.is_empty() {
                continue;
            }
            let mut read = |column: &str, cell: &str, kind, scale, help: &str| match scale_cell(cell, scale) {
                Ok(value) => Some(value),
                Err(QuantityError { message, .. }) => {
                    let help = units_below(column, cell, kind).unwrap_or_else(|| help.to_owned());
                    faults.push(self.fault(*line, column, message, help));
                    None
                }
            };
            let of_time = read(&self.headers[time].name, at, Kind::DURATION, of_time, "correct the time of this row, or remove the row");
            instants.extend(of_time.map(|at| (at, *line)));
            let of_channel = read(
                name,
                value_cell,
                of.kind(),
                scale,
                "correct the cell; channels that go together need the same instants, and one by itself may leave it empty",
            );
            if let (Some(at), Some(value)) = (of_time, of_channel) {
                times.push(at);
                values.push(polarity * value);
                let (decimals, one) = last_decimal(value_cell);
                if finest.is_none_or(|(most, _)| decimals > most)
                    && let Ok(digit) = scale_cell(&one, scale)
                {
                    finest = Some((decimals, digit));
                }
            }
        }
        let not_later = instants.windows(2).filter(|pair| pair[1].0 <= pair[0].0).map(|pair| {
            let (message, help) = ("the time is not later than the one before", "list the samples in the order of their times, each once");
            self.fault(pair[1].1, TIME, message, help)
        });
        faults.extend(not_later);
        faults.sort_by_key(|fault| fault.line);
        if faults.is_empty() {
            let (start, count) = (times.first().copied().unwrap_or(0.0), times.len());
            let step = if count > 1 { (times[count - 1] - start) / (count - 1) as f64 } else { 0.0 };
            // Times are printed with few digits: within a hundredth of a step they are evenly spaced.
            let is_even = step > 0.0 && times.iter().enumerate().all(|(i, at)| (at - (start + i as f64 * step)).abs() <= 0.01 * step);
            let record = if is_even { Record::uniform(start, step, values) } else { Record::at_times(times, values) };
            match record {
                Ok(record) => return Ok(Column { record, digit: finest.map_or(0.0, |(_, digit)| digit) }),
                Err(issues) => faults.extend(issues.iter().map(|issue| self.record_fault(issue, name, count))),
            }
        }
        Err(faults)
    }

    fn record_fault(&self, issue: &TestIssue, name: &str, samples: usize) -> Fault {
        if samples < 2 {
            let message = format!("the column has {samples} of at least two samples");
            return self.fault(1, name, message, "a record needs two samples or more");
        }
        self.fault(1, name, Units::Si.sentence(&planar_impact::Issue::message(issue)), "correct the column")
    }
}

fn scale_cell(cell: &str, scale: Scale<'_>) -> Result<f64, QuantityError> {
    match scale {
        Scale::Unit(unit, kind) => read_cell(cell, unit, kind).map(|read| read.si),
        Scale::Calibration(one) => quantity::finite(cell).map(|value| one * value),
    }
}

/// Returns the number of decimals of a cell, fewer by its exponent, and the same cell with one of the last of them in place of its number.
fn last_decimal(cell: &str) -> (i32, String) {
    let end_of = |text: &str, belongs: fn(char) -> bool| text.find(|c| !belongs(c)).unwrap_or(text.len());
    let (mantissa, rest) = cell.split_at(end_of(cell, |c| c.is_ascii_digit() || "+-.".contains(c)));
    let decimals = mantissa.split_once('.').map_or(0, |(_, decimals)| decimals.len());
    let exponent = rest.strip_prefix(['e', 'E']).map(|rest| rest.split_at(end_of(rest, |c| c.is_ascii_digit() || "+-".contains(c))));
    let exponent = exponent.and_then(|(digits, unit)| Some((digits.parse::<i32>().ok()?, unit)));
    let (exponent, unit) = exponent.unwrap_or((0, rest));
    let decimals = i32::try_from(decimals).unwrap_or(i32::MAX).saturating_sub(exponent);
    (decimals, format!("1e{}{unit}", -i64::from(decimals)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_decimal_of_a_number_is_found() {
        for (cell, decimals, one) in [
            ("9.4", 1, "1e-1"),
            ("-300.00", 2, "1e-2"),
            ("12", 0, "1e0"),
            ("+7.", 0, "1e0"),
            ("1.50e3", -1, "1e1"),
            ("2.5E-04", 5, "1e-5"),
            ("3.25 kN", 2, "1e-2 kN"),
            ("1.5e2 erg", -1, "1e1 erg"),
            ("4.0erg", 1, "1e-1erg"),
        ] {
            assert_eq!(last_decimal(cell), (decimals, one.to_owned()), "{cell}");
        }
    }
}
