//! The columns of a table that are inputs, and their cells.

use std::borrow::Cow;
use std::fmt;

use planar_impact::{Law, Side};

use super::header::{self, Header};
use crate::case::{Domain, Parameter, vehicle_number};
use crate::issue::Issue;
use crate::names::in_letters;
use crate::plain_text::clean;
use crate::quantity::{self, Conversion, Kind, Reach, did_you_mean, excerpt};

/// What an input column gives.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Key {
    /// A number of the case file.
    Parameter(Parameter),
    /// Whether the vehicle is a fixed barrier: `true` or `false`.
    Barrier(Side),
    /// The law of the tangential impulse: `brach` or `kudlich-slibar`.
    Law,
}

/// One cell of an input column.
#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    /// A number in SI; 0 or 1 for a word.
    Number(f64),
    /// The word `critical`, for an impulse ratio.
    Critical,
    /// Nothing.
    Empty,
    /// What is not what the column needs, as it is found.
    Unreadable(Box<str>),
}

/// The cells of an input column.
#[derive(Clone, Debug)]
pub enum Column<'a> {
    /// A number in every row, in SI.
    Numbers(Cow<'a, [f64]>),
    /// Any cells.
    Cells(Vec<Cell>),
}

/// Rows of a table, as far as they are inputs.
#[derive(Clone, Debug, Default)]
pub struct Table<'a> {
    /// The number of rows.
    pub rows: usize,
    /// The cells of each [input](super::Plan::inputs).
    pub columns: Vec<Column<'a>>,
    /// The rows, counted from 0, that are no rows of the table.
    pub unreadable: Vec<(usize, NotARow)>,
}

/// Why a line is no row of its table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NotARow {
    /// It has more cells or fewer than the table has columns.
    Ragged {
        /// The number of its cells.
        cells: usize,
        /// The number of columns.
        columns: usize,
    },
    /// A cell is not UTF-8 text.
    NotText,
}

/// An input column of a table.
#[derive(Clone, Copy, Debug)]
pub struct InputColumn {
    /// Its place among the columns of the table.
    pub place: usize,
    /// What it gives.
    pub key: Key,
    /// The least and the greatest number that a case file accepts, with this unit or without one.
    limits: [f64; 2],
    conversion: Option<Conversion>,
}

impl Key {
    /// Returns the key with this name, or `None` if no input has it.
    pub fn named(name: &str) -> Option<Key> {
        match name {
            "vehicle.1.barrier" => Some(Key::Barrier(Side::One)),
            "vehicle.2.barrier" => Some(Key::Barrier(Side::Two)),
            "contact.tangential_law" => Some(Key::Law),
            // Symbols are short words that a table may use for columns of its own.
            _ => Parameter::named(name).filter(|parameter| parameter.to_string() == name).map(Key::Parameter),
        }
    }

    /// Returns the least and the greatest number that a case file accepts, with a unit or without one.
    fn limits(self, has_unit: bool) -> [f64; 2] {
        let Key::Parameter(parameter) = self else { return Domain::Any.limits() };
        let ([least, greatest], kind) = (parameter.domain().limits(), parameter.kind());
        match if has_unit { kind.domain } else { kind.bare } {
            Reach::Magnitude(most) => [least.max(-most), greatest.min(most)],
            Reach::Positive(from, to) => [least.max(from), greatest.min(to)],
        }
    }

    /// Returns `true` if a cell of such a column gives what the case has as a parameter, be it in another form.
    pub(super) fn replaces(self, parameter: Parameter) -> bool {
        matches!(self, Key::Parameter(own) if own.replaces(parameter))
    }

    /// Returns `true` if every cell is a number.
    pub fn is_numeric(self) -> bool {
        matches!(self, Key::Parameter(parameter) if parameter != Parameter::Input(planar_impact::Input::ImpulseRatio))
    }
}

impl fmt::Display for Key {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Key::Parameter(parameter) => parameter.fmt(f),
            Key::Barrier(side) => write!(f, "vehicle.{}.barrier", vehicle_number(*side)),
            Key::Law => f.write_str("contact.tangential_law"),
        }
    }
}

impl Column<'_> {
    /// Returns the cell of a row.
    ///
    /// # Panics
    ///
    /// If there is no such row.
    #[inline]
    pub fn at(&self, row: usize) -> Cell {
        match self {
            Column::Numbers(numbers) => Cell::Number(numbers[row]),
            Column::Cells(cells) => cells[row].clone(),
        }
    }

    /// Returns the number of rows.
    pub fn rows(&self) -> usize {
        match self {
            Column::Numbers(numbers) => numbers.len(),
            Column::Cells(cells) => cells.len(),
        }
    }
}

impl InputColumn {
    /// Recognizes an input column by its header; `None` if it is another column, which passes through.
    ///
    /// # Errors
    ///
    /// An unknown name that begins as that of an input, or a unit that is not one of the input.
    pub fn of(place: usize, header: &Header) -> Result<Option<InputColumn>, Issue> {
        let Some(key) = Key::named(&header.name) else {
            let lower = visible(&header.name).to_ascii_lowercase();
            let is_of_case = ["vehicle.", "contact."].iter().any(|start| lower.starts_with(start));
            return if is_of_case { Err(unknown(&header.name)) } else { Ok(None) };
        };
        let conversion = match (&header.unit, key) {
            (None, _) => None,
            (Some(unit), Key::Parameter(parameter)) => Some(Conversion::in_header(unit, parameter.kind()).map_err(|error| {
                let issue = Issue::at("invalid-unit", header.name.clone(), error.message);
                Issue { help: error.help.map(Into::into), ..issue }
            })?),
            (Some(unit), _) => {
                let message = format!("this column has words, and no unit; found {}", excerpt(unit));
                return Err(Issue::at("invalid-unit", header.name.clone(), message));
            }
        };
        Ok(Some(InputColumn { place, key, limits: key.limits(conversion.is_some()), conversion }))
    }

    /// Returns the unit of SI that is assumed for a column without one; `None` if it has one, or needs none.
    pub(super) fn assumed_unit(&self) -> Option<&'static str> {
        let Key::Parameter(parameter) = self.key else { return None };
        Some(parameter.kind().si).filter(|unit| self.conversion.is_none() && !unit.is_empty())
    }

    /// Returns `true` if it has a unit, and the same quantity as another column.
    pub(super) fn has_unit_of(&self, other: &InputColumn) -> bool {
        let kind = |column: &InputColumn| if let Key::Parameter(parameter) = column.key { Some(parameter.kind().name) } else { None };
        self.conversion.is_some() && kind(self) == kind(other)
    }

    /// Returns a number of the table in SI; one that is not finite is the same in every unit, and one that SI would make zero is no number.
    #[inline]
    fn to_si(self, number: f64) -> f64 {
        let Some(conversion) = self.conversion.filter(|_| number.is_finite()) else { return number };
        let si = conversion.to_si(number);
        if si == 0.0 && number != 0.0 { f64::NAN } else { si }
    }

    /// Returns `true` if its header has a unit.
    pub(super) fn has_unit(&self) -> bool {
        self.conversion.is_some()
    }

    /// Returns `true` if a pound in its unit is taken as a force.
    pub(super) fn has_pound_force(&self) -> bool {
        self.conversion.is_some_and(|conversion| conversion.pound_force)
    }

    /// Returns `true` for a number that a case file accepts, which is finite.
    #[inline]
    pub(super) fn accepts(&self, number: f64) -> bool {
        self.limits[0] <= number && number <= self.limits[1]
    }

    /// Reads a text cell.
    pub fn of_text(&self, text: &str) -> Cell {
        let text = text.trim();
        if text.is_empty() {
            return Cell::Empty;
        }
        match (self.key, text) {
            // Spreadsheets write them in capitals.
            (Key::Barrier(_), word) if word.eq_ignore_ascii_case("true") => Cell::Number(1.0),
            (Key::Barrier(_), word) if word.eq_ignore_ascii_case("false") => Cell::Number(0.0),
            (Key::Law, "brach") => Cell::Number(0.0),
            (Key::Law, "kudlich-slibar") => Cell::Number(1.0),
            (Key::Barrier(_) | Key::Law, _) => Cell::Unreadable(text.into()),
            (Key::Parameter(Parameter::Input(planar_impact::Input::ImpulseRatio)), "critical") => Cell::Critical,
            (Key::Parameter(_), _) => match text.parse() {
                // Digits too small for a float are read as zero.
                Ok(0.0) if quantity::finite(text).is_err() => Cell::Unreadable(text.into()),
                Ok(number) => Cell::Number(self.to_si(number)),
                Err(_) => Cell::Unreadable(text.into()),
            },
        }
    }

    /// Reads a number of the table.
    pub fn of_number(&self, number: f64) -> Cell {
        if matches!(self.key, Key::Parameter(_)) { Cell::Number(self.to_si(number)) } else { Cell::Unreadable(number.to_string().into()) }
    }

    /// Reads a truth value of the table.
    pub fn of_truth(&self, is_true: bool) -> Cell {
        if matches!(self.key, Key::Barrier(_)) {
            Cell::Number(f64::from(u8::from(is_true)))
        } else {
            Cell::Unreadable(is_true.to_string().into())
        }
    }

    /// Says what to write for a cell that is no number, where it is clear what is meant.
    pub(super) fn remedy(&self, found: &str) -> String {
        let Key::Parameter(parameter) = self.key else { return String::new() };
        let kind = parameter.kind();
        let with_unit = || {
            let quantity = quantity::parse(found, kind).ok()?;
            Some(match self.conversion {
                Some(conversion) => {
                    format!("the header has the unit of the column, in which it is {}", rounded(quantity.si / conversion.to_si(1.0)))
                }
                None => {
                    let unit = quantity.unit;
                    format!("write its unit in the header, as `{} [{unit}]`, and every cell in that", self.key)
                }
            })
        };
        let help = with_unit().or_else(|| header::units_below(&self.key.to_string(), found, kind));
        let help = help.or_else(|| quantity::parse(found, Kind::PURE).err()?.help);
        help.map(|help| format!("; {help}")).unwrap_or_default()
    }

    /// Reads numbers of the table, without a copy where they are in SI.
    pub fn of_numbers<'a>(&self, numbers: &'a [f64]) -> Column<'a> {
        match (self.key, self.conversion) {
            (Key::Parameter(_), None) => Column::Numbers(Cow::Borrowed(numbers)),
            (Key::Parameter(_), Some(_)) => Column::Numbers(numbers.iter().map(|number| self.to_si(*number)).collect()),
            _ => Column::Cells(numbers.iter().map(|number| self.of_number(*number)).collect()),
        }
    }
}

impl Key {
    /// Returns `true` if it has a unit, and this is one; a number alone is none in the name of a column.
    fn has_unit(self, unit: &str) -> bool {
        let is_number = unit.chars().all(|c| c.is_ascii_digit());
        !is_number && matches!(self, Key::Parameter(parameter) if Conversion::of(unit, parameter.kind()).is_ok())
    }
}

/// Returns a number without the rounding of a conversion.
fn rounded(number: f64) -> f64 {
    format!("{number:.12e}").parse().unwrap_or(number)
}

/// Returns a name without characters that nobody sees, which an editor or a page may have put into it.
fn visible(name: &str) -> String {
    name.chars().filter(|c| !matches!(c, '\u{ad}' | '\u{200b}'..='\u{200f}' | '\u{2060}' | '\u{feff}')).collect()
}

/// Returns the law of a cell that gives one.
pub(super) fn law_of(number: f64) -> Law {
    if number == 0.0 { Law::Brach } else { Law::KudlichSlibar }
}

/// Returns the inputs of any case, but for those of its crush.
fn known() -> impl Iterator<Item = Key> {
    let of_vehicles = Side::ALL.into_iter().flat_map(|side| {
        let others = [Parameter::Speed(side), Parameter::RadiusOfGyration(side)].map(Key::Parameter);
        others.into_iter().chain([Key::Barrier(side)])
    });
    let of_contact = [Parameter::Friction, Parameter::RatioOfCritical, Parameter::MomentOfCritical].map(Key::Parameter);
    let inputs = planar_impact::Input::ALL.into_iter().map(|input| Key::Parameter(Parameter::Input(input)));
    inputs.chain(of_vehicles).chain(of_contact).chain([Key::Law])
}

/// Returns the inputs that a column which passes through may be meant as, by the words of its name in whatever order: its number of the vehicle, its symbol, its words
/// without `vehicle.1` or `contact`, or what people call it, as `veh1.mass`, `mass1`, `vx2` and `mass_lb_2`.
///
/// Each is a header, with the unit that stands in the name or behind it.
pub(super) fn meant_by(header: &Header) -> Vec<String> {
    /// Length in bytes beyond which no name means an input, of which the words would take long to compare.
    const LONGEST: usize = 200;
    let name = visible(&header.name);
    if name.len() > LONGEST {
        return Vec::new();
    }
    // A unit in parentheses is no part of the name.
    let base = name.trim().strip_suffix(')').and_then(|name| name.rsplit_once('(')).map_or(&*name, |(base, _)| base);
    let split: Vec<(&str, &str)> = header::split(&name).collect();
    let all = words(base);
    let behind = split.iter().map(|(bare, unit)| (words(bare), *unit));
    let among = all.iter().map(|unit| (all.iter().copied().filter(|word| word != unit).collect(), *unit));
    let with_unit = behind.chain(among).map(|(words, unit)| named_like(&words).into_iter().filter(|key| key.has_unit(unit)).collect());
    let meant: Vec<Key> = [named_like(&all)].into_iter().chain(with_unit).find(|keys: &Vec<Key>| !keys.is_empty()).unwrap_or_default();
    let unit_of = |key: &Key| {
        let given = header.unit.as_deref().into_iter().chain(split.iter().map(|(_, unit)| *unit)).chain(all.iter().copied());
        given.map(str::trim).find(|unit| key.has_unit(unit))
    };
    let headers: Vec<(&Key, Option<&str>)> = meant.iter().map(|key| (key, unit_of(key))).collect();
    let has_any = headers.iter().any(|(_, unit)| unit.is_some());
    let is_weight = all.iter().any(|word| [WEIGHT, "w"].contains(&&*word.to_ascii_lowercase()));
    let headed = |(key, unit): (&Key, Option<&str>)| match unit {
        Some(unit) => format!("{key} [{unit}]"),
        // Taken for a mass, pounds would be kilograms.
        None if is_weight && key.has_unit("kg") => format!("{key} [kg] or [lb]"),
        None => key.to_string(),
    };
    headers.into_iter().filter(|(_, unit)| !has_any || unit.is_some()).map(headed).collect()
}

/// Returns the words of a name: letters apart from digits, and both apart at any other sign.
fn words(name: &str) -> Vec<&str> {
    let kind = |c: char| (c.is_alphanumeric(), c.is_ascii_digit());
    let mut words: Vec<&str> = Vec::new();
    let mut from = 0;
    for ((_, c), (at, next)) in name.char_indices().zip(name.char_indices().skip(1).chain([(name.len(), ' ')])) {
        if kind(c) != kind(next) || at == name.len() {
            words.extend(Some(&name[from..at]).filter(|_| c.is_alphanumeric()));
            from = at;
        }
    }
    words
}

/// Words in a name that do not say which input it is.
const OF_ANY_INPUT: [&str; 14] =
    ["vehicle", "vehicles", "veh", "car", "unit", "body", "v", "b", "contact", "contacts", "input", "model", "before", "initial"];

/// What people call an input, and the last words of those that they may mean.
const CALLED: &[(&str, &str)] = &[
    ("cor", "restitution"),
    ("coefficientofrestitution", "restitution"),
    ("restitutioncoefficient", "restitution"),
    ("fric", "friction"),
    ("mufriction", "friction"),
    ("frictioncoefficient", "friction"),
    ("coefficientoffriction", "friction"),
    ("ofcritical", "impulseratioofcritical"),
    ("law", "tangentiallaw"),
    ("normalangle", "crushplane"),
    (WEIGHT, "mass"),
    ("w", "mass"),
    ("w", "yawrate"),
    ("yaw", "heading"),
    ("yaw", "yawrate"),
];

/// Returns the inputs that some words name.
fn named_like(words: &[&str]) -> Vec<Key> {
    let letters = words.iter().map(|word| in_letters(word)).collect::<String>();
    if let Some(parameter) = Parameter::named(&letters) {
        return vec![Key::Parameter(parameter)];
    }
    let lower: Vec<String> = words.iter().map(|word| in_letters(word).to_ascii_lowercase()).collect();
    let (sides, words): (Vec<&str>, Vec<&str>) = lower.iter().map(String::as_str).partition(|word| matches!(*word, "1" | "2"));
    let own: String = words.iter().copied().filter(|word| !OF_ANY_INPUT.contains(word)).collect();
    let own = if own.is_empty() { words.concat() } else { own };
    // A letter alone is a symbol only of a vehicle.
    if own.len() < 2 && sides.is_empty() {
        return Vec::new();
    }
    let said: Vec<&str> = CALLED.iter().filter(|(called, _)| *called == own).map(|(_, meant)| *meant).chain([own.as_str()]).collect();
    let joined = |name: &str| name.chars().filter(|c| c.is_alphabetic()).collect::<String>().to_ascii_lowercase();
    let is_meant = |key: &Key| {
        let name = key.to_string();
        let of_vehicle = name.strip_prefix("vehicle.").and_then(|rest| rest.split_once('.'));
        let is_of_side = match (&sides[..], of_vehicle) {
            ([], _) => true,
            ([side], Some((of, _))) => *side == of,
            _ => false,
        };
        let last = of_vehicle.map_or_else(|| name.strip_prefix("contact.").unwrap_or(&name), |(_, last)| last);
        let symbol = if let Key::Parameter(parameter) = key { parameter.symbol().map(joined) } else { None };
        let is_symbol = symbol.as_deref() == Some(&own);
        is_of_side && (said.contains(&joined(last).as_str()) || is_symbol)
    };
    known().filter(is_meant).collect()
}

/// Returns `true` for the name of what a case file has beside the collision, of which a table has nothing.
pub(super) fn is_of_evidence(name: &str) -> bool {
    let (section, rest) = name.split_once('.').unwrap_or((name, ""));
    !rest.is_empty() && ["before", "rest", "evidence", "unknown", "correlation"].contains(&section)
}

/// What a case file may give in place of a mass, and a table may not.
const WEIGHT: &str = "weight";

/// Returns the input whose symbol stands behind `contact` or `vehicle.1`, as in `contact.mu`, `vehicle.1.m` and `vehicle.1.vx`.
fn of_symbol(name: &str) -> Option<String> {
    let (of, symbol) = name.rsplit_once('.')?;
    let side = of.strip_prefix("vehicle.").unwrap_or_default();
    let first = symbol.chars().next()?;
    let spelled = [format!("{symbol}{side}"), format!("{first}{side}{}", &symbol[first.len_utf8()..])];
    let meant = spelled.iter().find_map(|symbol| Parameter::named(symbol)).filter(|meant| meant.to_string().starts_with(of))?;
    Some(format!("did you mean `{meant}`?"))
}

fn unknown(name: &str) -> Issue {
    let issue = Issue::at("unknown-column", name, "a column that begins so must be an input, and no input has this name");
    let bare = name.split(['(', ' ', ',', '[', '_']).next().unwrap_or_default();
    // Behind another sign there may be another word than a unit.
    let is_apart = |bare: &str| name.strip_prefix(bare).is_some_and(|rest| rest.starts_with(['(', '[', '{', ' ', ',']));
    let with_unit = header::split(name).find(|(bare, unit)| Key::named(bare).is_some_and(|key| is_apart(bare) || key.has_unit(unit)));
    if let Some((bare, unit)) = with_unit {
        let unit = unit.split([']', '}', ')']).next().unwrap_or_default().trim_end();
        return issue.with_help(format!("write the unit in brackets: `{bare} [{}]`", clean(unit)));
    }
    if let Some(vehicle) = bare.strip_suffix(WEIGHT) {
        return issue.with_help(format!("a table has no weights: give the mass, as `{vehicle}mass [kg]` or `{vehicle}mass [lb]`"));
    }
    if visible(name) != name {
        return issue.with_help(format!("it has characters that cannot be seen; write `{}`", visible(name)));
    }
    // The stiffness of a table is named as `gradient` names it, without the table of the case file.
    let of_file = name.replacen(".stiffness.", ".", 1);
    if of_file != name && Key::named(&of_file).is_some() {
        return issue.with_help(format!("did you mean `{of_file}`?"));
    }
    // A case has names, and a table passes them through.
    let is_name = name.ends_with(".name");
    let by_words = || match &named_like(&words(name))[..] {
        [key] => Some(format!("did you mean `{key}`?")),
        _ => None,
    };
    let by_spelling = || did_you_mean(&name.to_ascii_lowercase(), known().map(|key| key.to_string()));
    let meant = of_symbol(name).or_else(by_words).or_else(by_spelling).filter(|_| !is_name);
    issue.with_help(meant.unwrap_or_else(|| "rename the column, so that it passes through".to_owned()))
}
