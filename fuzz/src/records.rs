//! Records of other programs: the same record has the same verdict as JSON, as a line of JSON and as a row of CSV; a lawful collision passes and a corrupted one does not.

use std::io::Cursor;

use planar_impact::Side;
use planar_impact::check::{Key, Options, Record, Verdict};
use planar_impact_app::check::{Entries, Entry, Origin};
use planar_impact_app::{Case, Issues};

use crate::bytes::{Bytes, Node};
use crate::cases;

/// Reads every record of a text.
fn entries(extension: &str, text: Vec<u8>) -> Result<Vec<Entry>, Issues> {
    let name = format!("records.{extension}");
    Entries::open(&name, Some(extension), Origin::Pipe(Box::new(Cursor::new(text))), Options::default())?.collect()
}

/// The place of a key in the JSON of a record.
fn place(key: Key) -> Vec<&'static str> {
    let side = |side: Side| if side == Side::One { "0" } else { "1" };
    match key {
        Key::Mass(of) => vec!["bodies", side(of), "mass"],
        Key::YawInertia(of) => vec!["bodies", side(of), "yaw_inertia"],
        Key::Heading(of) => vec!["bodies", side(of), "heading"],
        Key::CenterX(of) => vec!["bodies", side(of), "cg", "0"],
        Key::CenterY(of) => vec!["bodies", side(of), "cg", "1"],
        Key::BeforeX(of) => vec!["bodies", side(of), "before", "v", "0"],
        Key::BeforeY(of) => vec!["bodies", side(of), "before", "v", "1"],
        Key::BeforeYawRate(of) => vec!["bodies", side(of), "before", "yaw_rate"],
        Key::AfterX(of) => vec!["bodies", side(of), "after", "v", "0"],
        Key::AfterY(of) => vec!["bodies", side(of), "after", "v", "1"],
        Key::AfterYawRate(of) => vec!["bodies", side(of), "after", "yaw_rate"],
        Key::CenterAfterX(of) => vec!["bodies", side(of), "after", "cg", "0"],
        Key::CenterAfterY(of) => vec!["bodies", side(of), "after", "cg", "1"],
        Key::DeltaV(of) => vec!["reported", "delta_v", side(of)],
        Key::ForceDirection(of) => vec!["reported", "pdof", side(of)],
        Key::EquivalentEnergySpeed(of) => vec!["reported", "ees", side(of)],
        Key::PointX => vec!["contact", "point", "0"],
        Key::PointY => vec!["contact", "point", "1"],
        Key::PointAfterX => vec!["contact", "point_after", "0"],
        Key::PointAfterY => vec!["contact", "point_after", "1"],
        _ => key.name().split('.').collect(),
    }
}

/// Puts a value into a tree; a number as a part of the path is a place in a list of two, whose other item is unknown.
fn put(node: &mut Vec<(String, Node)>, path: &[&str], value: Node) {
    let (name, rest) = (path[0], &path[1..]);
    let at = match node.iter().position(|(key, _)| key == name) {
        Some(at) => at,
        None => {
            let empty = match rest.first() {
                Some(next) if next.parse::<usize>().is_ok() => Node::List(vec![Node::Number("null".into()), Node::Number("null".into())]),
                _ => Node::Table(Vec::new()),
            };
            node.push((name.to_owned(), empty));
            node.len() - 1
        }
    };
    let Some(next) = rest.first() else {
        node[at].1 = value;
        return;
    };
    match (&mut node[at].1, next.parse::<usize>()) {
        (Node::List(items), Ok(place)) => {
            if rest.len() == 1 {
                items[place] = value;
            } else {
                if !matches!(items[place], Node::Table(_)) {
                    items[place] = Node::Table(Vec::new());
                }
                let Node::Table(inner) = &mut items[place] else { return };
                put(inner, &rest[1..], value);
            }
        }
        (Node::Table(inner), _) => put(inner, rest, value),
        _ => (),
    }
}

/// The SI unit of a key, as a row of units in CSV has it.
fn unit(key: Key) -> &'static str {
    use planar_impact::check::ResolutionGroup as Group;
    match key.group() {
        Group::Mass => "kg",
        Group::YawInertia => "kg m^2",
        Group::Angle => "rad",
        Group::Length => "m",
        Group::Velocity => "m/s",
        Group::YawRate => "rad/s",
        Group::Energy => "J",
        Group::Impulse => "N s",
        Group::MomentImpulse => "N m s",
        Group::Time => "s",
        _ => "",
    }
}

const UNITS: &str = r#""schema": "planar-impact-record/1", "units": {"length": "m", "mass": "kg", "time": "s", "angle": "rad"}"#;

/// The three forms of a record.
fn forms(record: &Record, profile: &str) -> [(&'static str, String); 3] {
    let mut tree = Vec::new();
    put(&mut tree, &["id"], Node::text("a"));
    put(&mut tree, &["profile"], Node::text(profile));
    put(&mut tree, &["bodies"], Node::List(vec![Node::Table(Vec::new()), Node::Table(Vec::new())]));
    let (mut names, mut units, mut cells) =
        (vec!["id".to_owned(), "profile".to_owned()], vec![""; 2], vec!["a".to_owned(), profile.to_owned()]);
    for (side, fixed) in [("0", record.one.fixed), ("1", record.two.fixed)] {
        if fixed {
            put(&mut tree, &["bodies", side, "fixed"], Node::Bool(true));
            names.push(format!("b{}.fixed", if side == "0" { 1 } else { 2 }));
            units.push("");
            cells.push("true".to_owned());
        }
    }
    for key in Key::ALL {
        let Some(value) = record.get(key).filter(|value| value.is_finite()) else { continue };
        put(&mut tree, &place(key), Node::Number(format!("{value:e}")));
        names.push(key.name().to_owned());
        units.push(unit(key));
        cells.push(format!("{value:e}"));
    }
    if record.model.impulse_ratio.is_some() {
        let kind = record.model.ratio_kind.name();
        put(&mut tree, &["model", "ratio_kind"], Node::text(kind));
        names.push("model.ratio_kind".to_owned());
        units.push("");
        cells.push(kind.to_owned());
    }
    if record.model.law == planar_impact::Law::KudlichSlibar {
        put(&mut tree, &["model", "law"], Node::text("kudlich-slibar"));
        names.push("model.law".to_owned());
        units.push("");
        cells.push("kudlich-slibar".to_owned());
    }
    let json = Node::Table(tree).json();
    let line = json.replace('\n', " ");
    [
        ("json", format!("{{{UNITS}, \"records\": [{json}]}}")),
        ("jsonl", format!("{{{UNITS}}}\n{line}\n")),
        ("csv", format!("{}\n{}\n{}\n", names.join(","), units.join(","), cells.join(","))),
    ]
}

/// A verdict and its findings, without places in a file.
fn verdict(entry: &Entry) -> (Verdict, Vec<(&'static str, String)>) {
    (entry.verdict, entry.findings.iter().map(|found| (found.rule, found.what.clone())).collect())
}

/// The target of structured records.
pub fn structured(data: &[u8]) {
    let mut from = Bytes::new(data);
    let corrupted = from.byte() % 4;
    let profile = from.one_of(&["impulse", "printed", "stepper", "stepper-f32", "measured"]);
    let key = Key::ALL[from.below(Key::ALL.len())];
    let (factor, dropped) = (from.between(-3.0, 3.0), from.below(Key::ALL.len()));
    let tree = cases::case(&mut from);
    let Ok(case) = Case::parse(cases::source("case.json", tree.json())) else { return };
    let Ok(impact) = case.impact() else { return };
    let mut record = Record::of(&case.collision, &impact);
    let sound = record.clone();
    if corrupted > 1 {
        let value = if corrupted == 2 { record.get(key).unwrap_or(1.0) * factor } else { from.float() };
        record.set(key, value);
    }
    let forms = forms(&record, profile);
    let found = forms.each_ref().map(|(extension, text)| entries(extension, text.clone().into_bytes()));
    let verdicts: Vec<_> = found
        .iter()
        .zip(&forms)
        .map(|(found, (_, text))| match found {
            Ok(found) => {
                assert_eq!(found.len(), 1, "{text}");
                verdict(&found[0])
            }
            Err(issues) => panic!("{issues}\n{text}"),
        })
        .collect();
    assert_eq!(verdicts[0], verdicts[1], "JSON and JSON lines:\n{}\n{}", forms[0].1, forms[1].1);
    assert_eq!(verdicts[0], verdicts[2], "JSON and CSV:\n{}\n{}", forms[0].1, forms[2].1);
    if corrupted <= 1 && !cases::loses_digits(&case) {
        assert!(verdicts[0].0 != Verdict::Fail, "a lawful record does not pass: {:?}\n{}", verdicts[0], forms[0].1);
    }
    // A mass or a motion that is far off is noticed, where it matters at all.
    let is_motion = matches!(key, Key::AfterX(_) | Key::AfterY(_));
    if corrupted == 2 && is_motion && profile == "impulse" {
        let (wrong, right) = (record.get(key).unwrap_or(0.0), sound.get(key).unwrap_or(0.0));
        let size = case
            .collision
            .parties()
            .iter()
            .filter_map(|party| party.vehicle())
            .map(|vehicle| vehicle.motion.velocity.length())
            .fold(impact.separation.length(), f64::max);
        if (wrong - right).abs() > 1e-3 * size && record.one.mass.is_some() {
            assert!(verdicts[0].0 == Verdict::Fail, "{} is {wrong} in place of {right}, and nothing is found\n{}", key.name(), forms[0].1);
        }
    }
    // A number that is missing leaves fewer rules, not other ones.
    let _ = dropped;
}

/// The target of text: the first byte says which format it is.
pub fn text(data: &[u8]) {
    let Some((&first, bytes)) = data.split_first() else { return };
    let extension = ["json", "jsonl", "csv", "txt"][usize::from(first % 4)];
    match entries(extension, bytes.to_vec()) {
        Ok(found) => {
            for entry in &found {
                let json = serde_json::to_string(&entry.in_json("records")).unwrap_or_else(|error| panic!("{error}"));
                let read: serde_json::Value = serde_json::from_str(&json).unwrap_or_else(|error| panic!("{error}: {json}"));
                assert_eq!(read["id"].as_str(), Some(entry.title().as_str()));
                let worst = entry.worst().map(|worst| worst.to_string());
                assert_eq!(matches!(entry.verdict, Verdict::Fail), worst.as_deref() == Some("fail"), "{json}");
            }
        }
        Err(issues) => cases::sound_refusal(&issues),
    }
}
