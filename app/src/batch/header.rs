//! The header of a column: its name, and its unit in brackets.

use crate::quantity::{Conversion, Kind};

/// What stands above a column, such as `vehicle.1.speed [mph]`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Header {
    /// The name.
    pub name: String,
    /// The unit; without one the numbers are in SI.
    pub unit: Option<String>,
}

impl Header {
    /// Separates the name from the unit.
    ///
    /// ```
    /// use planar_impact_app::batch::Header;
    /// let header = Header::read("vehicle.1.speed [mph]");
    /// assert_eq!((header.name.as_str(), header.unit.as_deref()), ("vehicle.1.speed", Some("mph")));
    /// assert_eq!(Header::read("site").unit, None);
    /// ```
    pub fn read(text: &str) -> Header {
        let bracketed = text.trim().strip_suffix(']').and_then(|text| text.rsplit_once('['));
        match bracketed {
            Some((name, unit)) => Header { name: name.trim().to_owned(), unit: Some(unit.trim().to_owned()) },
            None => Header { name: text.trim().to_owned(), unit: None },
        }
    }
}

/// Returns the name and the unit of a column whose unit stands in its name, as in `speed (mph)`, `speed_mph` and `speed / mph`, and not in brackets; `None` if that is
/// none of the kind, or the one that is assumed.
pub(crate) fn unit_in_name(name: &str, kind: Kind) -> Option<(&str, &str)> {
    let is_unit = |unit: &str| match Conversion::of(unit, kind) {
        Ok(conversion) => conversion.to_si(1.0) != 1.0,
        Err(_) => kind.dimension == Kind::ACCELERATION.dimension && matches!(unit, "g" | "G"),
    };
    split(name).find(|(_, unit)| is_unit(unit))
}

/// Returns the remedy for a cell that is a unit of its column: below the names no line has the units.
pub(crate) fn units_below(name: &str, cell: &str, kind: Kind) -> Option<String> {
    let unit = cell.trim().trim_matches(['[', ']', '(', ')']);
    let is_unit = !unit.is_empty() && Conversion::of(unit, kind).is_ok();
    is_unit.then(|| format!("write the unit in the header, as `{name} [{unit}]`, and remove the line of units"))
}

/// Returns each way to split a name in two, at what people write between a name and its unit, as in `speed in mph`; no unit is longer than some bytes.
pub(super) fn split(name: &str) -> impl Iterator<Item = (&str, &str)> {
    const LONGEST: usize = 40;
    let is_between = |c: char| matches!(c, ' ' | '_' | '/' | ',' | ':' | ';' | '-' | '.' | '(' | ')' | '{' | '}' | '[' | ']');
    let places = name.char_indices().filter(move |(at, c)| name.len() - at <= LONGEST && is_between(*c));
    let parts = places.map(move |(at, _)| {
        let unit = name[at..].trim_matches(is_between);
        (name[..at].trim_matches(is_between), unit.strip_prefix("in ").unwrap_or(unit))
    });
    parts.filter(|(name, unit)| !name.is_empty() && !unit.is_empty())
}

/// Returns what is wrong with column names of which the first begins as a comment, or as the separator of a spreadsheet does, and the remedy.
pub(crate) fn not_names(headers: &[Header]) -> Option<[&'static str; 2]> {
    match headers.first()?.name.as_str() {
        first if first.starts_with('#') => {
            Some(["the first line must name the columns, and begins with #", "remove the lines above the names; CSV has no comments"])
        }
        first if first.starts_with("sep=") => Some(SEPARATOR_LINE),
        _ => None,
    }
}

/// A line for a spreadsheet alone.
const SEPARATOR_LINE: [&str; 2] =
    ["the first line must name the columns, and is `sep=`", "remove it: only some spreadsheets read the separator there"];

/// Returns what is wrong with a line of column names in which no comma separates them, and the remedy.
///
/// ```
/// use planar_impact_app::batch::separated_otherwise;
/// let [wrong, remedy] = separated_otherwise("time [ms];force [kN]").expect("semicolons");
/// assert!(wrong.contains("semicolons") && remedy.contains("commas"));
/// assert!(separated_otherwise("sep=,").is_some_and(|[_, remedy]| remedy.contains("remove it")));
/// assert_eq!(separated_otherwise("time [ms],note; remark"), None);
/// assert_eq!(separated_otherwise("speed"), None);
/// ```
pub fn separated_otherwise(line: &str) -> Option<[&'static str; 2]> {
    if line.starts_with("sep=") {
        return Some(SEPARATOR_LINE);
    }
    let is_otherwise = !line.contains(',') && line.contains([';', '\t']);
    is_otherwise.then_some(["the columns are separated by semicolons or tabs", "separate them by commas, and write numbers with a point"])
}
