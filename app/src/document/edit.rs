//! Edits of a file that replace one value and keep the rest: its unit, its uncertainty, comments and layout. A form beside the text and a
//! drawing that is dragged change a file in this way.

use std::ops::Range;

use super::{Document, Node, Value, json, toml};
use crate::case::Parameter;
use crate::issue::{Cause, Issue, Issues};
use crate::quantity::{Conversion, Kind, unit_of};

/// A replacement of a range of bytes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Edit {
    /// The bytes that are replaced; empty for an insertion.
    pub span: Range<usize>,
    /// The text in their place.
    pub text: String,
}

/// A value as the file has it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Written {
    /// The bytes of the value.
    pub span: Range<usize>,
    /// The text of a string without its quotes; anything else as it is written.
    pub text: String,
}

/// Keys of a distribution that are a place: a move shifts each of them.
const PLACES: [&str; 6] = ["value", "mode", "median", "min", "max", "start"];

impl Document {
    /// Returns the value at a path, such as `vehicle.1.mass` or `vehicle.1.impact_center.forward`, as the file has it.
    pub fn written(&self, path: &str) -> Option<Written> {
        let node = self.find(&key_of(path))?;
        Some(Written { span: node.span.clone(), text: self.shown(node) })
    }

    /// Writes a value as a person has typed it: a number without quotes where one stood, or where none stood; a table as it is; anything else as a
    /// string. A missing key is added below the last key of its table.
    ///
    /// # Errors
    ///
    /// A table that is missing, or is written in braces.
    pub fn write_text(&self, path: &str, text: &str) -> Result<Edit, Issues> {
        let (key, text) = (key_of(path), text.trim());
        let table = self.table_of(text);
        // What is a number in JSON is one in TOML, and `007`, `5.` and `+1` are in neither.
        let is_number = serde_json::from_str::<f64>(text).is_ok();
        match self.find(&key) {
            Some(node) if self.has_header(node) => Err(self.refuse_edit(&key, node.span.clone(), "is a table; write one of its keys")),
            Some(node) => {
                let keeps_bare = is_number && matches!(node.value, Value::Number(_));
                let value = table.unwrap_or_else(|| if keeps_bare { text.to_owned() } else { quoted(text) });
                Ok(Edit { span: node.span.clone(), text: value })
            }
            None => self.insert(&key, &table.unwrap_or_else(|| if is_number { text.to_owned() } else { quoted(text) })),
        }
    }

    /// Moves an input to a value in SI, in the unit that the file gives it, to a `resolution` in SI. An uncertain input keeps its deviation, and
    /// the ends of a range move with it.
    ///
    /// # Errors
    ///
    /// A value that is no quantity; a missing key whose table is missing or written in braces.
    pub fn write_number(&self, parameter: Parameter, si: f64, resolution: f64) -> Result<Vec<Edit>, Issues> {
        let (name, kind) = (parameter.to_string(), parameter.kind());
        let key = key_of(&name);
        let Some(node) = self.find(&key) else {
            let unit = kind.likely.first().filter(|_| kind.si.starts_with("rad")).copied().unwrap_or(kind.si);
            let number = rounded(Conversion::to(unit).of_si(si), Conversion::to(unit).of_si(resolution));
            let text = if kind.si.is_empty() { rounded(si, resolution) } else { quoted(&format!("{number} {unit}")) };
            return Ok(vec![self.insert(&key, &text)?]);
        };
        let no_quantity = || self.refuse_edit(&name, node.span.clone(), "is no quantity that can be moved; edit the text");
        let Value::Table(entries) = &node.value else {
            let edit = self.moved(node, kind, resolution, |_| si);
            return edit.map(|edit| vec![edit]).ok_or_else(no_quantity);
        };
        let place = |name: &str| entries.iter().find(|entry| entry.key == name).map(|entry| &entry.node);
        let from = self.nominal(node, kind).ok_or_else(no_quantity)?;
        // What stands at the value gets the new one itself: from far away the sum would round it.
        let shifted = |old: f64| if old == from { si } else { old + (si - from) };
        // Bounds of a search are not of the value; limits of a distribution are where it stands.
        let moves: &[&str] = if place("start").is_some() { &["start"] } else { &PLACES };
        let edits = moves.iter().filter_map(|name| place(name)).map(|node| self.moved(node, kind, resolution, shifted));
        edits.collect::<Option<Vec<Edit>>>().filter(|edits| !edits.is_empty()).ok_or_else(no_quantity)
    }

    /// Returns the value in SI of an input as it stands in the file, that of the middle of its range if it has one.
    pub fn number_at(&self, parameter: Parameter) -> Option<f64> {
        let node = self.find(&key_of(&parameter.to_string()))?;
        self.nominal(node, parameter.kind())
    }

    /// Returns the value of a quantity in SI, that of a distribution where it stands, or the middle of its range.
    fn nominal(&self, node: &Node, kind: Kind) -> Option<f64> {
        let Value::Table(entries) = &node.value else { return self.number(node, kind).map(|number| number.si) };
        let place = |name: &str| entries.iter().find(|entry| entry.key == name);
        let value = |name: &str| place(name).and_then(|entry| self.number(&entry.node, kind)).map(|number| number.si);
        let nominal = ["value", "mode", "median", "start"].into_iter().find_map(value);
        nominal.or_else(|| Some((value("min")? + value("max")?) / 2.0))
    }

    /// Returns a table in braces that is typed, in the format of the file whichever it is typed in; `None` for anything else.
    fn table_of(&self, text: &str) -> Option<String> {
        if !(text.starts_with('{') && text.ends_with('}')) {
            return None;
        }
        let in_toml = || match toml::parse(&format!("x = {text}")).ok()?.value {
            Value::Table(entries) => entries.into_iter().next().map(|entry| entry.node.value),
            _ => None,
        };
        let in_json = || json::parse(text).ok().map(|node| node.value);
        let is_json = super::is_json(&self.source);
        let (is_own, other) = if is_json { (in_json().is_some(), in_toml()) } else { (in_toml().is_some(), in_json()) };
        if is_own { Some(text.to_owned()) } else { inline(&other?, if is_json { ": " } else { " = " }) }
    }

    fn refuse_edit(&self, path: &str, span: Range<usize>, message: &'static str) -> Issues {
        self.refuse(Cause::Input, vec![Issue { span: Some(span), ..Issue::at("edit", path, message) }])
    }

    /// Returns `true` for a table, or an array of tables, whose keys stand below its header.
    fn has_header(&self, node: &Node) -> bool {
        let first = match &node.value {
            Value::Table(_) => Some(node),
            Value::Array(items) => items.first().filter(|item| matches!(item.value, Value::Table(_))),
            _ => None,
        };
        first.is_some_and(|table| !self.source.text[table.span.clone()].starts_with('{'))
    }

    fn find(&self, key: &str) -> Option<&Node> {
        let mut parts = key.split('.');
        let first = parts.next()?;
        let mut node = &self.entries.iter().find(|entry| entry.key == first)?.node;
        for part in parts {
            node = super::child(node, part)?;
        }
        Some(node)
    }

    fn shown(&self, node: &Node) -> String {
        match &node.value {
            Value::String(text) => text.clone(),
            _ => self.source.text.get(node.span.clone()).unwrap_or("").to_owned(),
        }
    }

    /// Reads the number of a value, and what follows it: its unit and its deviation.
    fn number(&self, node: &Node, kind: Kind) -> Option<Number> {
        match &node.value {
            Value::Number(number) => Some(Number { si: number.text.parse().ok()?, unit: String::new(), rest: String::new() }),
            Value::String(text) => {
                let (value, deviation) = text.split_once('±').map_or((text.as_str(), None), |(value, rest)| (value, Some(rest)));
                let (number, own) = unit_of(value)?;
                let lent = deviation.and_then(unit_of).map(|(_, unit)| unit).filter(|unit| *unit != "%");
                let unit = if own.is_empty() { lent.unwrap_or("") } else { own };
                let si = Conversion::of(unit, kind).ok()?.to_si(number);
                let after = if own.is_empty() { String::new() } else { format!(" {own}") };
                let rest = after + &deviation.map_or_else(String::new, |deviation| format!(" ±{deviation}"));
                Some(Number { si, unit: unit.to_owned(), rest })
            }
            _ => None,
        }
    }

    fn moved(&self, node: &Node, kind: Kind, resolution: f64, to: impl Fn(f64) -> f64) -> Option<Edit> {
        let number = self.number(node, kind)?;
        if matches!(node.value, Value::Number(_)) {
            return Some(Edit { span: node.span.clone(), text: rounded(to(number.si), resolution) });
        }
        let conversion = Conversion::of(&number.unit, kind).ok()?;
        let value = rounded(conversion.of_si(to(number.si)), conversion.of_si(resolution));
        Some(Edit { span: node.span.clone(), text: quoted(&format!("{value}{}", number.rest)) })
    }

    /// Adds a key below the last one of its table.
    fn insert(&self, key: &str, value: &str) -> Result<Edit, Issues> {
        let text = &self.source.text;
        let missing = || {
            Issues::new(Cause::Input, self.source.clone(), vec![Issue::at("edit", key, "has no place in the file yet; add it to the text")])
        };
        let place = key.rsplit_once('.').filter(|(_, name)| is_bare(name)).and_then(|(table, name)| Some((self.find(table)?, name)));
        let (node, name) = place.ok_or_else(missing)?;
        let (Value::Table(entries), Some('[')) = (&node.value, text[node.span.clone()].chars().next()) else { return Err(missing()) };
        let of_name = FORMS.iter().filter(|forms| forms.contains(&name)).flatten();
        if let Some(other) = of_name.copied().find(|form| *form != name && entries.iter().any(|entry| entry.key == *form)) {
            let issue = Issue::at("edit", key, format!("is given by `{other}`; edit the text"));
            return Err(Issues::new(Cause::Input, self.source.clone(), vec![issue]));
        }
        let is_own = |node: &Node| match &node.value {
            Value::Table(_) => text[node.span.clone()].starts_with('{'),
            Value::Array(items) => !items.first().is_some_and(|item| text[item.span.clone()].starts_with("[[")),
            _ => true,
        };
        let last = entries.iter().map(|entry| &entry.node).filter(|node| is_own(node)).map(|node| node.span.end).max();
        let from = last.unwrap_or(node.span.end);
        let end = from + text[from..].find(['\r', '\n']).unwrap_or(text.len() - from);
        Ok(Edit { span: end..end, text: format!("\n{name} = {value}") })
    }
}

/// A number of the file, its unit, and what is written after it.
struct Number {
    si: f64,
    unit: String,
    rest: String,
}

/// Keys that give the same in two forms, of which a table has one.
const FORMS: [[&str; 2]; 5] = [
    ["mass", "weight"],
    ["yaw_inertia", "radius_of_gyration"],
    ["speed", "velocity"],
    ["crush_plane", "surfaces"],
    ["impulse_ratio", "friction"],
];

/// Returns `true` for a key that needs no quotes in TOML.
fn is_bare(key: &str) -> bool {
    !key.is_empty() && key.chars().all(|c| c.is_ascii_alphanumeric() || matches!(c, '_' | '-'))
}

/// Writes a value in one line, with a sign between keys and values: a colon, behind keys in quotation marks, or an equals sign.
fn inline(value: &Value, between: &str) -> Option<String> {
    let key = |key: &str| if between == ": " || !is_bare(key) { quoted(key) } else { key.to_owned() };
    let all = |items: Vec<String>, [open, close]: [&str; 2]| format!("{open}{}{close}", items.join(", "));
    Some(match value {
        Value::Table(entries) => {
            let items = entries.iter().map(|entry| Some(format!("{}{between}{}", key(&entry.key), inline(&entry.node.value, between)?)));
            all(items.collect::<Option<_>>()?, ["{ ", " }"])
        }
        Value::Array(items) => all(items.iter().map(|node| inline(&node.value, between)).collect::<Option<_>>()?, ["[", "]"]),
        Value::String(text) => quoted(text),
        Value::Number(number) => number.text.clone(),
        Value::Bool(is_true) => is_true.to_string(),
        Value::Null | Value::Other(_) => return None,
    })
}

/// Returns the key of the file for the name of an input: components are the items of an array.
fn key_of(path: &str) -> String {
    const COMPONENTS: [(&str, &str); 4] = [
        ("impact_center.forward", "impact_center.1"),
        ("impact_center.left", "impact_center.2"),
        ("velocity.x", "velocity.1"),
        ("velocity.y", "velocity.2"),
    ];
    let component = COMPONENTS.iter().find_map(|(name, key)| path.strip_suffix(name).map(|start| format!("{start}{key}")));
    component.unwrap_or_else(|| path.to_owned())
}

/// Writes a string of TOML and JSON.
fn quoted(text: &str) -> String {
    let mut quoted = String::from("\"");
    for c in text.chars() {
        match c {
            '"' | '\\' => quoted.extend(['\\', c]),
            c if c.is_control() => quoted.push_str(&format!("\\u{:04x}", u32::from(c))),
            c => quoted.push(c),
        }
    }
    quoted + "\""
}

/// Writes a number with the decimals that a resolution needs.
fn rounded(value: f64, resolution: f64) -> String {
    let decimals = (-libm::log10(resolution.abs()) - 1e-9).ceil().clamp(0.0, 12.0) as usize;
    let text = format!("{value:.decimals$}");
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Source;

    const TEXT: &str = "\
[[vehicle]]
name = \"é\"
speed = \"40 ft/s\" # a comment
heading = \"1.5 rad ± 2 deg\"
mass = 1500
impact_center = [\"6.3 ft\", \"5 ft 2 in\"]

[vehicle.crush]
width = \"5 ft\"

[[vehicle]]
speed = { min = \"36 km/h\", max = \"46 km/h\" }
yaw_rate = \"3 ± 1 deg/s\"

[contact]
crush_plane = '-10 deg' # Γ
restitution = { mode = 0.1, min = 0, max = 0.3 }
";

    fn document(text: &str) -> Document {
        Document::parse(Source::new("case.toml", text)).unwrap()
    }

    fn apply(text: &str, mut edits: Vec<Edit>) -> String {
        let mut text = text.to_owned();
        edits.sort_by_key(|edit| std::cmp::Reverse(edit.span.start));
        edits.into_iter().for_each(|edit| text.replace_range(edit.span, &edit.text));
        text
    }

    /// Returns the lines that moving an input changes.
    fn moved(name: &str, si: f64, resolution: f64) -> Vec<String> {
        let parameter = Parameter::named(name).unwrap();
        let edited = apply(TEXT, document(TEXT).write_number(parameter, si, resolution).unwrap());
        edited.lines().filter(|line| !TEXT.lines().any(|old| old == *line)).map(str::to_owned).collect()
    }

    #[test]
    fn a_move_keeps_unit_deviation_and_comment() {
        assert_eq!(moved("vehicle.1.speed", 3.048, 0.01), ["speed = \"10 ft/s\" # a comment"]); // 10 ft/s
        assert_eq!(moved("vehicle.1.heading", 1.25, 0.001), ["heading = \"1.25 rad ± 2 deg\""]);
        assert_eq!(moved("vehicle.1.mass", 1600.25, 0.1), ["mass = 1600.2"]);
        assert_eq!(moved("contact.crush_plane", 22.5f64.to_radians(), 0.1f64.to_radians()), ["crush_plane = \"22.5 deg\" # Γ"]);
        assert_eq!(moved("contact.crush_plane", -1e-9, 0.1f64.to_radians()), ["crush_plane = \"0 deg\" # Γ"]);
        assert_eq!(moved("vehicle.1.impact_center.left", 0.0254, 0.001), ["impact_center = [\"6.3 ft\", \"1 in\"]"]); // an inch
        assert_eq!(moved("vehicle.2.yaw_rate", 0.1, 1e-4), ["yaw_rate = \"5.73 ± 1 deg/s\""]); // 5.7296 deg/s
    }

    #[test]
    fn a_range_moves_as_one() {
        assert_eq!(moved("vehicle.2.speed", 50.0 / 3.6, 0.01), ["speed = { min = \"45 km/h\", max = \"55 km/h\" }"]);
        assert_eq!(moved("contact.restitution", 0.15, 0.01), ["restitution = { mode = 0.15, min = 0.05, max = 0.35 }"]);
    }

    #[test]
    fn a_number_that_is_a_table_stands_at_its_mode_or_middle() {
        let at = |name: &str| document(TEXT).number_at(Parameter::named(name).unwrap());
        assert_eq!((at("contact.restitution"), at("vehicle.2.speed").map(|speed| (speed * 3.6).round())), (Some(0.1), Some(41.0)));
    }

    #[test]
    fn a_missing_key_is_added_to_its_table() {
        let lines = |name: &str, text: &str| {
            let edited = apply(TEXT, vec![document(TEXT).write_text(name, text).unwrap()]);
            let at = edited.lines().position(|line| !TEXT.lines().any(|old| old == line)).unwrap();
            edited.lines().skip(at - 1).take(2).map(str::to_owned).collect::<Vec<_>>().join("|")
        };
        assert_eq!(lines("vehicle.1.yaw_rate", "3 deg/s"), "impact_center = [\"6.3 ft\", \"5 ft 2 in\"]|yaw_rate = \"3 deg/s\"");
        assert_eq!(lines("contact.impulse_ratio", "0.5"), "restitution = { mode = 0.1, min = 0, max = 0.3 }|impulse_ratio = 0.5");
        let refused = |path: &str| document(TEXT).write_text(path, "1").unwrap_err().to_string();
        assert_eq!(refused("scene.friction"), "scene.friction: has no place in the file yet; add it to the text");
        assert_eq!(refused("vehicle.1"), "vehicle.1: is a table; write one of its keys");
        // At the end of a text without a last line break, too.
        let text = format!("{TEXT}[contact.other]\ne = 1 # last");
        assert_eq!(apply(&text, vec![document(&text).write_text("contact.other.f", "2").unwrap()]), format!("{text}\nf = 2"));
        // Neither a name that needs quotes nor a table below a header can be written in place: the file could not be read any more.
        for path in ["contact.", "contact.a b", "contact", "vehicle.1", "vehicle"] {
            assert!(document(TEXT).write_text(path, "1").is_err(), "{path}");
        }
        assert_eq!(moved("vehicle.1.yaw_rate", 1.0, 0.01), ["yaw_rate = \"57.3 deg/s\""]); // 180/π
    }

    /// A table is one in either format, typed in either; what is a table in neither is a text, which is refused when it is read.
    #[test]
    fn a_table_that_is_typed_is_one_of_the_file() {
        let toml = "[[vehicle]]\nmass = 1500\n[contact]\nrestitution = 0.1\nfriction = 0.5\n";
        let json = "{\"vehicle\": [{\"mass\": 1500}],\n\"contact\": {\"restitution\": 0.1}}";
        for (name, text) in [("case.toml", toml), ("case.json", json)] {
            let read = |text: String| Document::parse(Source::new(name, text)).unwrap_or_else(|issues| panic!("{issues}"));
            let typed = |typed: &str| {
                let again = read(apply(text, vec![read(text.to_owned()).write_text("contact.restitution", typed).unwrap()]));
                match &again.find("contact.restitution").unwrap().value {
                    Value::Table(entries) => {
                        entries.iter().map(|entry| format!("{} {:?}", entry.key, entry.node.value)).collect::<Vec<_>>().join("; ")
                    }
                    other => other.describe().to_owned(),
                }
            };
            let number = |text: &str| format!("Number(Number {{ text: {text:?}, integer: {} }})", !text.contains('.'));
            let wanted = format!("min {}; max {}; values Array", number("0"), number("0.3"));
            for table in ["{ min = 0, max = 0.3, values = [\"a\\\"\", true] }", "{\"min\": 0, \"max\": 0.3, \"values\": [\"a\\\"\", true]}"]
            {
                assert!(
                    typed(table).starts_with(&wanted) && typed(table).contains("String(\"a\\\"\")"),
                    "{name} {table}: {}",
                    typed(table)
                );
            }
            assert_eq!([typed("{ min 0 }"), typed("{}}")], ["a string", "a string"]);
        }
        // Beside another form of the same a key is none.
        let refused = |path: &str| {
            let text =
                toml.replace("restitution", "surfaces = [0, 1]\nrestitution").replace("mass = 1500", "mass = 1500\nvelocity = [1, 2]");
            document(&text).write_text(path, "1").unwrap_err().to_string()
        };
        assert_eq!(refused("contact.crush_plane"), "contact.crush_plane: is given by `surfaces`; edit the text");
        assert_eq!(refused("contact.impulse_ratio"), "contact.impulse_ratio: is given by `friction`; edit the text");
        assert_eq!(refused("vehicle.1.speed"), "vehicle.1.speed: is given by `velocity`; edit the text");
    }

    #[test]
    fn what_is_typed_is_written_as_it_is_meant() {
        let line = |name: &str, text: &str| {
            let edited = apply(TEXT, vec![document(TEXT).write_text(name, text).unwrap()]);
            edited.lines().find(|line| !TEXT.lines().any(|old| old == *line)).unwrap_or_default().to_owned()
        };
        assert_eq!(line("vehicle.1.mass", "1600"), "mass = 1600");
        assert_eq!(line("vehicle.1.mass", "1600 lb"), "mass = \"1600 lb\"");
        assert_eq!(line("vehicle.1.speed", "12"), "speed = \"12\" # a comment"); // refused with a message when it is read
        assert_eq!(line("vehicle.1.name", "a\"\\\u{7}"), "name = \"a\\\"\\\\\\u0007\"");
        assert_eq!(line("contact.restitution", "{ min = 0, max = 1 }"), "restitution = { min = 0, max = 1 }");
        // What only looks like a number would break the file without quotes.
        for (typed, is_bare) in
            [("1.6e3", true), ("-0", true), ("000", false), ("007", false), ("5.", false), (".5", false), ("+1", false), ("1e999", false)]
        {
            for (name, text) in [("case.toml", "[[vehicle]]\nmass = 1500\n"), ("case.json", "{\"vehicle\": [{\"mass\": 1500}]}")] {
                let read = |text: String| Document::parse(Source::new(name, text)).unwrap_or_else(|issues| panic!("{typed}: {issues}"));
                let edit = read(text.to_owned()).write_text("vehicle.1.mass", typed).unwrap();
                assert_eq!(edit.text.starts_with('"'), !is_bare, "{typed}");
                let again = read(apply(text, vec![edit]));
                assert_eq!(again.written("vehicle.1.mass").map(|written| written.text).as_deref(), Some(typed), "{name}");
            }
        }
        let written = |name: &str| document(TEXT).written(name).map(|written| written.text);
        assert_eq!(written("contact.crush_plane").as_deref(), Some("-10 deg"));
        assert_eq!(written("vehicle.2.speed").as_deref(), Some("{ min = \"36 km/h\", max = \"46 km/h\" }"));
        assert_eq!(written("vehicle.2.mass"), None);
    }
}
