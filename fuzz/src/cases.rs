//! Case files: two vehicles that mostly collide, in any form that a file may give them, and text that may be anything.

use planar_impact::check;
use planar_impact_app::batch::{self, Column, Header, Key};
use planar_impact_app::case::{CaseOutput, Parameter};
use planar_impact_app::gradient::{self, Selection};
use planar_impact_app::json::{self, Layout};
use planar_impact_app::uncertainty::Method;
use planar_impact_app::{
    Answer, Case, Cause, Issues, Source, Uncontrolled, Units, crash3, crush, decode, reconstruct, scene, slide, solve, sweep, uncertainty,
};
use planar_impact_report::page::{self, Facts};
use planar_impact_report::{html, text as plain};
use serde::Serialize;
use serde_json::Value;

use crate::bytes::{Bytes, Node};
use crate::oracle;

/// A number with a unit: the factor is its size in SI.
type Unit = (&'static str, f64);

const MASSES: [Unit; 4] = [("kg", 1.0), ("lb", 0.453_592_37), ("t", 1000.0), ("slug", 14.593_903)];
const INERTIAS: [Unit; 3] = [("kg m^2", 1.0), ("lbf s^2 ft", 1.355_818), ("lb ft^2", 0.042_140)];
const LENGTHS: [Unit; 4] = [("m", 1.0), ("cm", 0.01), ("ft", 0.3048), ("in", 0.0254)];
const SPEEDS: [Unit; 4] = [("m/s", 1.0), ("km/h", 1.0 / 3.6), ("mph", 0.447_04), ("ft/s", 0.3048)];
const ANGLES: [Unit; 2] = [("deg", 0.017_453_292_5), ("rad", 1.0)];
const YAW_RATES: [Unit; 2] = [("deg/s", 0.017_453_292_5), ("rad/s", 1.0)];
const PURE: [Unit; 2] = [("", 1.0), ("%", 0.01)];

/// A number in one of the forms of a case file.
fn quantity(from: &mut Bytes<'_>, value: f64, units: &[Unit]) -> Node {
    let (unit, size) = from.one_of(units);
    let text = |value: f64| format!("{} {unit}", value / size);
    let width = (value.abs() * 0.01).max(1e-3);
    match from.byte() {
        0..=150 => Node::Text(text(value)),
        151..=200 => Node::number(value),
        201..=215 => Node::Text(format!("{} ± {}", text(value), text(width))),
        216..=220 => Node::Text(format!("{} ± 5 %", text(value))),
        221..=230 => Node::Table(vec![("value".into(), Node::Text(text(value))), ("sd".into(), Node::Text(text(width)))]),
        231..=240 => Node::Table(vec![("min".into(), Node::Text(text(value - width))), ("max".into(), Node::Text(text(value + width)))]),
        241..=244 => Node::Table(vec![
            ("min".into(), Node::Text(text(value - width))),
            ("mode".into(), Node::Text(text(value))),
            ("max".into(), Node::Text(text(value + width))),
        ]),
        245..=247 => Node::Table(vec![("value".into(), Node::Text(text(value))), ("resolution".into(), Node::Text(text(width)))]),
        248..=250 => Node::Table(vec![("median".into(), Node::Text(text(value))), ("factor".into(), Node::number(1.1))]),
        _ => from.junk(1),
    }
}

/// Sizes of vehicles, or of anything that a case file accepts.
struct Ranges {
    is_wide: bool,
}

impl Ranges {
    fn of(&self, from: &mut Bytes<'_>, usual: (f64, f64), widest: (f64, f64)) -> f64 {
        if self.is_wide { from.magnitude(widest.0, widest.1) } else { from.between(usual.0, usual.1) }
    }

    fn signed(&self, from: &mut Bytes<'_>, usual: (f64, f64), most: f64) -> f64 {
        if !self.is_wide {
            return from.between(usual.0, usual.1);
        }
        let size = if from.chance(30) { 0.0 } else { from.magnitude(1e-12, most) };
        if from.chance(128) { -size } else { size }
    }
}

fn vehicle(from: &mut Bytes<'_>, ranges: &Ranges, facing: f64) -> Node {
    let mut keys: Vec<(String, Node)> = Vec::new();
    let mut put = |key: &str, node: Node| keys.push((key.to_owned(), node));
    if from.chance(40) {
        let name = from.word();
        put("name", Node::Text(name));
    }
    if from.chance(25) {
        put("barrier", Node::Bool(true));
        return Node::Table(keys);
    }
    let mass = ranges.of(from, (800.0, 20_000.0), (1e-3, 1e9));
    put("mass", quantity(from, mass, &MASSES));
    if from.chance(128) {
        let radius = ranges.of(from, (1.0, 2.0), (1e-3, 1e2));
        put("radius_of_gyration", quantity(from, radius, &LENGTHS));
    } else {
        let inertia = ranges.of(from, (800.0, 40_000.0), (1e-9, 1e15));
        put("yaw_inertia", quantity(from, inertia, &INERTIAS));
    }
    let heading = facing + from.between(-1.0, 1.0);
    put("heading", quantity(from, heading, &ANGLES));
    if from.chance(200) {
        let speed = ranges.signed(from, (0.0, 40.0), 1e5);
        put("speed", quantity(from, speed, &SPEEDS));
    } else {
        let components = (0..2).map(|_| ranges.signed(from, (-40.0, 40.0), 1e5)).collect::<Vec<_>>();
        put("velocity", Node::List(components.into_iter().map(|speed| quantity(from, speed, &SPEEDS)).collect()));
    }
    if from.chance(128) {
        let rate = ranges.signed(from, (-1.0, 1.0), 1e4);
        put("yaw_rate", quantity(from, rate, &YAW_RATES));
    }
    let arm = (0..2).map(|_| ranges.signed(from, (-1.0, 2.5), 1e3)).collect::<Vec<_>>();
    put("impact_center", Node::List(arm.into_iter().map(|length| quantity(from, length, &LENGTHS)).collect()));
    if from.chance(40) {
        let depths = 2 + from.below(7);
        let depths = (0..depths).map(|_| from.between(0.0, 0.6)).collect::<Vec<_>>();
        let stiffness = match from.below(3) {
            0 => vec![("A".to_owned(), Node::text("60 kN/m")), ("B".to_owned(), Node::text("500 kPa"))],
            1 => vec![("d0".to_owned(), Node::text("90 N^0.5")), ("d1".to_owned(), Node::number(from.between(0.0, 2000.0)))],
            _ => vec![
                ("b0".to_owned(), Node::text("5 mph")),
                ("b1".to_owned(), Node::text("1.2 mph/in")),
                ("test_mass".to_owned(), Node::text("3000 lb")),
                ("test_width".to_owned(), Node::text("60 in")),
            ],
        };
        let crush = vec![
            ("width".to_owned(), Node::text(format!("{} m", from.between(0.3, 2.0)))),
            ("depths".to_owned(), Node::List(depths.into_iter().map(|depth| quantity(from, depth, &LENGTHS)).collect())),
            ("stiffness".to_owned(), Node::Table(stiffness)),
        ];
        put("crush", Node::Table(crush));
    }
    if from.chance(20) {
        let (key, node) = (from.key(), from.junk(1));
        keys.push((key, node));
    }
    Node::Table(keys)
}

/// A case file, as a tree.
pub fn case(from: &mut Bytes<'_>) -> Node {
    let ranges = Ranges { is_wide: from.chance(80) };
    let facing = from.between(-3.0, 3.0);
    let mut keys = vec![("schema".to_owned(), Node::Number("1".to_owned()))];
    if from.chance(40) {
        keys.push(("title".to_owned(), Node::Text(from.word())));
    }
    let vehicles = vec![vehicle(from, &ranges, facing), vehicle(from, &ranges, facing + std::f64::consts::PI)];
    keys.push(("vehicle".to_owned(), Node::List(vehicles)));
    let mut contact = Vec::new();
    let plane = facing + from.between(-0.5, 0.5);
    contact.push(("crush_plane".to_owned(), quantity(from, plane, &ANGLES)));
    let greatest = if from.chance(60) { 1.0 } else { 0.4 };
    let restitution = from.between(0.0, greatest);
    contact.push(("restitution".to_owned(), quantity(from, restitution, &PURE)));
    let share = from.between(0.0, 1.0);
    match from.below(5) {
        0 => contact.push(("impulse_ratio".to_owned(), Node::text("critical"))),
        1 => contact.push(("impulse_ratio".to_owned(), quantity(from, share, &PURE))),
        2 => contact.push(("impulse_ratio".to_owned(), Node::Table(vec![("of_critical".to_owned(), quantity(from, share, &PURE))]))),
        3 => contact.push(("friction".to_owned(), quantity(from, share, &PURE))),
        _ => (),
    }
    if from.chance(60) {
        contact.push(("tangential_law".to_owned(), Node::text(from.one_of(&["brach", "kudlich-slibar", "brach "]))));
    }
    if from.chance(30) {
        let moment =
            if from.chance(128) { Node::text("700 N m s") } else { Node::Table(vec![("of_critical".to_owned(), Node::number(share))]) };
        contact.push(("moment".to_owned(), moment));
    }
    keys.push(("contact".to_owned(), Node::Table(contact)));
    if from.chance(20) {
        let (key, node) = (from.key(), from.junk(0));
        keys.push((key, node));
    }
    Node::Table(keys)
}

fn read(name: &str, text: &str) -> Result<Case, Issues> {
    Case::parse(decode::source(name, text.as_bytes().to_vec())?)
}

/// A refusal names what is wrong, at a place that the text has.
pub fn sound_refusal(issues: &Issues) {
    assert!(!issues.list().is_empty(), "a refusal says nothing");
    assert!(issues.cause() != Cause::Defect, "a defect: {issues}");
    assert!(issues.cause() != Cause::Interrupted, "nobody has interrupted");
    for issue in issues.list() {
        assert!(!issue.code.is_empty(), "{issue:?}");
        assert!(!Units::Us.sentence(&issue.message).trim().is_empty(), "{issue:?}");
        if let Some(span) = &issue.span {
            assert!(issues.source().text.get(span.clone()).is_some(), "{issue:?} is no place of the text");
        }
        let _ = issues.line(issue);
    }
}

/// The JSON of an answer parses, has finite numbers, and is what the answer serializes to; its page has nothing that a terminal acts on.
fn sound_answer<T: Facts + Serialize>(answer: &Answer<T>, units: Units) -> Value {
    let written = json::text(answer, Layout::Pretty).unwrap_or_else(|issues| panic!("{issues}"));
    let value: Value = serde_json::from_str(&written).unwrap_or_else(|error| panic!("{error}: {written}"));
    let compact = json::text(answer, Layout::Compact).unwrap_or_else(|issues| panic!("{issues}"));
    assert_eq!(serde_json::from_str::<Value>(&compact).ok().as_ref(), Some(&value), "both layouts have the same");
    let blocks = page::page(answer, units);
    let page = plain::render(&blocks);
    assert!(
        !page.chars().any(|c| (c.is_control() && c != '\n') || matches!(c, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')),
        "{page:?}"
    );
    assert!(!html::fragment(&blocks).contains('\u{1b}'));
    value
}

/// Runs a verb: an answer or a refusal, each sound.
fn verb<T: Facts + Serialize>(answer: Result<Answer<T>, Issues>, units: Units) {
    match answer {
        Ok(answer) => drop(sound_answer(&answer, units)),
        Err(issues) => sound_refusal(&issues),
    }
}

/// A row of a batch has the bits of the case: all numbers as columns, and all from the case alone.
fn rows(case: &Case, solution: Option<&Value>) {
    // The columns of a table are inputs of the library; a curve, a weight or a moment of the case comes from the case alone.
    let given: Vec<(Parameter, f64)> = case.inputs.keys().into_iter().filter_map(|key| Some((key, case.inputs.value(key).ok()?))).collect();
    let (given, headers): (Vec<_>, Vec<Header>) = given
        .into_iter()
        .filter(|(key, _)| Key::named(&key.to_string()).is_some_and(Key::is_numeric) && !matches!(key, Parameter::Skid(..)))
        .map(|(key, value)| {
            ((key, value), Header { name: key.to_string(), unit: Some(key.kind().si.to_owned()).filter(|unit| !unit.is_empty()) })
        })
        .unzip();
    for columns in [&headers[..], &[]] {
        let Ok(plan) = batch::Plan::of(columns, Some(case), &batch::Options { check: true, ..batch::Options::default() }) else { continue };
        let numbers = plan.inputs().iter().map(|input| Column::Numbers(vec![given[input.place].1; 3].into())).collect();
        let answer = plan.solve(&batch::Table { rows: 3, columns: numbers, unreadable: Vec::new() });
        assert_eq!(answer.refused.is_empty(), solution.is_some(), "the row and the case: {:?}", answer.refused);
        let Some(solution) = solution else { continue };
        let is_checked = !has_few_digits(solution);
        assert!(!is_checked || answer.check.iter().flatten().all(Option::is_none), "the rows violate {:?}", answer.check);
        for (output, column) in plan.outputs().iter().zip(&answer.outputs) {
            assert!(column.iter().all(|value| value.to_bits() == column[0].to_bits()), "{output:?}: {column:?}");
            if let (CaseOutput::Impact(output), Some(value)) = (output, printed(solution, &output.short_name())) {
                assert!(value.to_bits() == (column[0] + 0.0).to_bits(), "{output:?}: {value:e} of the case and {:e} of the row", column[0]);
            }
        }
    }
}

/// The number at the place in the JSON of `solve` that the name of an output is.
fn printed(solution: &Value, name: &str) -> Option<f64> {
    let mut at = solution;
    let mut parts = name.split('.').filter(|part| *part != "result").peekable();
    while let Some(part) = parts.next() {
        at = match (part, at) {
            ("vehicle", _) => &at["vehicles"][parts.next()?.parse::<usize>().ok()? - 1],
            ("x", Value::Array(items)) => &items[0],
            ("y", Value::Array(items)) => &items[1],
            _ => &at[part],
        };
    }
    at.as_f64()
}

/// Returns `true` if `solve` says that rounding takes digits which a check of its answer needs; only what it also says to be badly conditioned may be so.
fn has_few_digits(solution: &Value) -> bool {
    let warns = |code: &str| solution["messages"].as_array().into_iter().flatten().any(|message| message["code"] == code);
    let has_few = warns("few-digits");
    assert!(!has_few || warns("unusual-radius-of-gyration") || warns("nearly-wedged"), "a usual case has few digits: {solution:#}");
    has_few
}

/// Returns `true` if `solve` warns so of a case.
pub fn loses_digits(case: &Case) -> bool {
    let solved = solve::solve(case, &(), &Uncontrolled).ok();
    solved.and_then(|answer| serde_json::to_value(&answer).ok()).is_some_and(|value| has_few_digits(&value))
}

/// Everything that must hold of a case file that can be read. `more` chooses a further verb.
fn hold(case: &Case, more: u8) -> Option<Value> {
    let units = case.units;
    let solved = match solve::solve(case, &(), &Uncontrolled) {
        Ok(answer) => {
            let value = sound_answer(&answer, units);
            oracle::check(&case.collision, &value);
            let impact = case.impact().unwrap_or_else(|issues| panic!("{issues}"));
            let outcome = check::check(&check::Record::of(&case.collision, &impact), &check::Options::default());
            assert!(outcome.verdict() != check::Verdict::Fail || has_few_digits(&value), "no warning of {outcome}\n{:?}", case.collision);
            Some(value)
        }
        Err(issues) => {
            sound_refusal(&issues);
            None
        }
    };
    if !case.model.is_momentum() && case.knowledge.left_out.is_empty() {
        rows(case, solved.as_ref());
    }
    match more {
        0..=30 => verb(crush::crush(case, &(), &Uncontrolled), units),
        31..=50 => verb(crash3::crash3(case, &(), &Uncontrolled), units),
        51..=75 => {
            let options = gradient::Options { of: Selection::Principal, wrt: Selection::All, second: more & 1 == 0 };
            verb(gradient::gradient(case, &options, &Uncontrolled), units);
        }
        76..=85 => match scene::draw(case, &(), &Uncontrolled) {
            Ok(answer) => {
                let svg = planar_impact_report::scene::scene(&answer, units);
                assert!(svg.starts_with("<svg") && !svg.contains("NaN") && !svg.contains("inf "), "{svg}");
            }
            Err(issues) => sound_refusal(&issues),
        },
        86..=95 => {
            let options = sweep::Options { vary: vec!["contact.crush_plane=-0.1:0.1:0.1".into()], ..sweep::Options::default() };
            verb(sweep::sweep(case, &options, &Uncontrolled), units);
        }
        96..=99 => {
            // Guaranteed bounds take seconds.
            let methods = [Method::Linear, Method::SecondOrder, Method::MonteCarlo, Method::Sobol];
            let methods = if more == 99 { Vec::new() } else { methods.into() };
            let options = uncertainty::Options { samples: 64, methods, ..uncertainty::Options::default() };
            verb(uncertainty::uncertainty(case, &options, &Uncontrolled), units);
        }
        100..=102 => verb(slide::slide(case, &(), &Uncontrolled), units),
        103 => {
            let options = reconstruct::Options { starts: 1, ..reconstruct::Options::default() };
            verb(reconstruct::reconstruct(case, &options, &Uncontrolled), units);
        }
        _ => (),
    }
    solved
}

/// The target of structured cases: TOML in both layouts and JSON give the same answer, or the same refusal.
pub fn structured(data: &[u8]) {
    let mut from = Bytes::new(data);
    let more = from.byte();
    let tree = case(&mut from);
    let forms = [("case.toml", tree.toml(true)), ("case.toml", tree.toml(false)), ("case.json", tree.json())];
    let read = forms.each_ref().map(|(name, text)| read(name, text));
    match &read[0] {
        Ok(case) => {
            let solved = hold(case, more);
            for (other, (_, text)) in read.iter().zip(&forms).skip(1) {
                let other =
                    other.as_ref().unwrap_or_else(|issues| panic!("one form is read and another not: {issues}\n{}\n{text}", forms[0].1));
                assert_eq!(case.inputs, other.inputs, "{}\n{text}", forms[0].1);
                let again = solve::solve(other, &(), &Uncontrolled).ok().map(|answer| sound_answer(&answer, case.units));
                assert_eq!(solved, again, "the same case in another form:\n{}\n{text}", forms[0].1);
            }
        }
        Err(issues) => {
            sound_refusal(issues);
            for (other, (_, text)) in read.iter().zip(&forms).skip(1) {
                match other {
                    // A word that TOML or JSON does not have is read by neither of the two.
                    Err(issues) => sound_refusal(issues),
                    Ok(_) => panic!("one form is refused and another read: {issues}\n{}\n{text}", forms[0].1),
                }
            }
        }
    }
}

/// The target of text: the first byte says whether it is TOML or JSON, and which verb comes after `solve`.
pub fn text(data: &[u8]) {
    let Some((&first, bytes)) = data.split_first() else { return };
    let name = if first % 2 == 0 { "case.toml" } else { "case.json" };
    match decode::source(name, bytes.to_vec()).and_then(Case::parse) {
        Ok(case) => drop(hold(&case, first / 2)),
        Err(issues) => sound_refusal(&issues),
    }
}

/// The text of a case file, for other targets.
pub fn source(name: &str, text: String) -> Source {
    Source::new(name, text)
}
