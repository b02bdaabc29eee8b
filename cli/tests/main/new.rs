//! The verb `new`: its templates run as they are, and with each of their optional keys.

use std::collections::BTreeSet;

use planar_impact_app::source::Source;
use planar_impact_app::{Case, Issues, Uncontrolled, reconstruct, schema, solve, template};
use serde_json::Value;

use crate::process::{run, run_with_input, workspace};

/// Returns the key of a line `key = value` of TOML.
fn key_of(line: &str) -> Option<&str> {
    let (key, _) = line.split_once(" = ")?;
    let is_key = key.chars().all(|c| c.is_ascii_alphanumeric() || "._-$\"".contains(c));
    (is_key && !key.is_empty()).then_some(key)
}

/// Returns the optional line without its `#`: a key, or the header of a table. Prose has a space after the `#`.
fn optional(line: &str) -> Option<&str> {
    let line = line.strip_prefix('#')?;
    (line.starts_with('[') || key_of(line).is_some()).then_some(line)
}

/// A template with an optional key, or an optional table, in use.
struct Variant<'a> {
    /// The first line of what is in use.
    first: &'a str,
    /// `true` if it is evidence or an unknown.
    is_of_reconstruction: bool,
    /// The place of the vehicle whose rest position it is of, the first if it is of the ground: a slide takes a second.
    of_rest: Option<usize>,
    text: String,
}

/// Returns a variant for each optional key and each optional table, without the keys that they are instead of.
fn variants(text: &str) -> Vec<Variant<'_>> {
    let lines: Vec<&str> = text.lines().collect();
    let mut all = Vec::new();
    let mut next = 0;
    while next < lines.len() {
        let first = next;
        next += 1;
        let Some(begin) = optional(lines[first]) else { continue };
        while begin.starts_with('[') && next < lines.len() && optional(lines[next]).is_some() {
            next += 1;
        }
        let mut edited: Vec<String> = lines.iter().map(|line| (*line).to_owned()).collect();
        for line in &mut edited[first..next] {
            line.remove(0);
        }
        if let Some((_, other)) = begin.split_once("# instead of ") {
            let other = other.split(';').next().unwrap_or_default().trim();
            let is_header = |line: &&&str| line.starts_with('[');
            let table_begins = first - lines[..first].iter().rev().take_while(|line| !is_header(line)).count();
            let table_ends = next + lines[next..].iter().take_while(|line| !is_header(line)).count();
            let replaced = (table_begins..table_ends).find(|&i| i != first && key_of(lines[i]) == Some(other));
            edited[replaced.unwrap_or_else(|| panic!("{begin}: there is no {other}"))].clear();
        }
        let table = lines[..first].iter().rev().find(|line| line.starts_with('['));
        let of_rest = [Some(&begin), table].into_iter().flatten().find(|table| table.starts_with("[rest"));
        let of_rest = of_rest.map(|table| usize::from(table.starts_with("[rest.vehicle.2")));
        let is_of_reconstruction = table.is_some_and(|table| ["[evidence]", "[unknown]"].contains(table));
        all.push(Variant { first: begin, is_of_reconstruction, of_rest, text: edited.join("\n") });
    }
    all
}

fn read(text: &str) -> Result<Case, Issues> {
    let open = |name: &str| {
        let example = match name {
            "recorder.csv" => "record/edr.csv",
            "load-cells.toml" => "record/barrier.toml",
            "barrier.csv" => "record/barrier.csv",
            _ => "tests/struble-welsh.toml",
        };
        let text = std::fs::read_to_string(workspace().join("cli/examples").join(example)).expect("an example");
        // The impact center of the template lies beside its center of mass, whose restitution a speed would give.
        let text: Vec<&str> = text.lines().filter(|line| name != "load-cells.toml" || !line.starts_with("speed =")).collect();
        let text = text.join("\n");
        Ok(Source::new(name, text))
    };
    Case::parse_with(Source::new("case.toml", text), Box::new(open))
}

/// Reads a case and uses it: in a reconstruction for evidence and unknowns and by momentum alone, otherwise in a solution.
fn accept(variant: &Variant<'_>) -> Result<(), Issues> {
    let mut case = read(&variant.text)?;
    if let Some(vehicle) = variant.of_rest {
        case.separations_from_rest_of([vehicle == 0, vehicle == 1], &Uncontrolled)?;
    } else {
        case.rest = None;
    }
    let options = reconstruct::Options { starts: 1, ..reconstruct::Options::default() };
    if variant.is_of_reconstruction || variant.text.contains("model = \"momentum\"") {
        reconstruct::reconstruct(&case, &options, &Uncontrolled).map(drop)
    } else {
        solve::solve(&case, &(), &Uncontrolled).map(drop)
    }
}

/// Collects the path of every key, without places in arrays and with N for the number of a vehicle.
fn paths(value: &Value, path: &str, found: &mut BTreeSet<String>) {
    match value {
        Value::Object(entries) => entries.iter().for_each(|(key, inner)| {
            let key = if ["1", "2"].contains(&key.as_str()) { "N" } else { key };
            let path = if path.is_empty() { key.to_owned() } else { format!("{path}.{key}") };
            paths(inner, &path, found);
            found.insert(path);
        }),
        Value::Array(items) => items.iter().for_each(|inner| paths(inner, path, found)),
        _ => (),
    }
}

/// Collects the path of every key that the schema of case files describes, but for those within a number.
fn described(schema: &Value, node: &Value, path: &str, found: &mut BTreeSet<String>) {
    if !node.is_object() {
        return;
    }
    if let Some(name) = node["$ref"].as_str().and_then(|address| address.strip_prefix("#/$defs/")) {
        let is_number = ["input_", "measured_", "unknown_"].iter().any(|family| name.starts_with(family)) || name.contains("deviation");
        // Results by their qualified name are evidence as well.
        if !is_number && !path.contains("result.result") {
            described(schema, &schema["$defs"][name], path, found);
        }
    }
    for (key, inner) in node["properties"]
        .as_object()
        .into_iter()
        .flatten()
        .filter(|(_, inner)| inner["description"].is_string() || inner.get("$ref").is_some())
    {
        let key = if ["1", "2"].contains(&key.as_str()) { "N" } else { key };
        let path = if path.is_empty() { key.to_owned() } else { format!("{path}.{key}") };
        described(schema, inner, &path, found);
        found.insert(path);
    }
    for list in ["anyOf", "oneOf", "allOf", "prefixItems"] {
        node[list].as_array().into_iter().flatten().for_each(|part| described(schema, part, path, found));
    }
    for part in ["then", "else", "items"] {
        described(schema, &node[part], path, found);
    }
}

#[test]
fn each_template_runs_as_it_is() {
    for kind in template::kinds() {
        let text = run(&workspace(), &["new", "--kind", kind]).out;
        assert!(text.starts_with("#:schema ") && Some(text.as_str()) == template::of(kind), "{kind}");
        let verbs = if kind == "momentum" { &["reconstruct"][..] } else { &["solve", "reconstruct"] };
        for verb in verbs {
            let run = run_with_input(&[verb, "-"], &text);
            assert_eq!((run.status, run.err.as_str()), (0, ""), "{kind}: {verb}: {}", run.out);
        }
        assert!(text.lines().all(|line| line.trim_end() == line), "{kind}");
    }
    assert_eq!(run(&workspace(), &["new"]).out, template::of("t-bone").expect("a kind"));
    assert_eq!(run(&workspace(), &["new", "--kind", "pedestrian"]).status, 2);
}

#[test]
fn every_optional_key_is_accepted_and_every_key_is_mentioned() {
    let (mut mentioned, mut faults) = (BTreeSet::new(), Vec::new());
    for kind in template::kinds() {
        let text = template::of(kind).expect("a kind");
        let found = variants(text);
        assert!(found.len() >= 4, "{kind} has {} optional keys", found.len());
        for variant in &found {
            match accept(variant) {
                Ok(()) => paths(&toml::from_str(&variant.text).expect("TOML"), "", &mut mentioned),
                Err(issues) => faults.push(format!("{kind}: {}\n{issues}", variant.first)),
            }
        }
    }
    assert!(faults.is_empty(), "{} faults\n{}", faults.len(), faults.join("\n"));
    let schema = schema::of("case").expect("a schema").to_value();
    let mut known = BTreeSet::new();
    described(&schema, &schema, "", &mut known);
    assert!(known.len() > 150 && known.contains("rest.vehicle.N.wheels.rear_left.steer"), "{known:?}");
    // Results by their qualified name are those by the other.
    let of_plain_name = |path: &str| path.replacen("evidence.result.", "evidence.", 1);
    let is_plain = |path: &&String| *path != "evidence.result" && mentioned.contains(&of_plain_name(path));
    let missing: Vec<&String> = known.iter().filter(|path| !mentioned.contains(*path) && !is_plain(path)).collect();
    assert!(missing.is_empty(), "no template mentions {missing:#?}");
}
