//! SARIF 2.1.0: a result for each finding, at the line of its record.

use std::io::{self, Write};
use std::path::Path;

use percent_encoding::{AsciiSet, NON_ALPHANUMERIC, utf8_percent_encode};
use planar_impact::check::Rule;
use planar_impact_app::check::{Entry, Found, MALFORMED, MALFORMED_HELP, Severity, Summary};
use serde_json::json as value;

use super::{Report, clean, json};

/// Characters to escape in the path of a URI: all but letters, digits and `/-._~`.
const PATH: &AsciiSet = &NON_ALPHANUMERIC.remove(b'/').remove(b'-').remove(b'.').remove(b'_').remove(b'~');

/// A report in SARIF.
#[derive(Default)]
pub struct Sarif {
    is_behind: bool,
}

fn level(severity: Severity) -> &'static str {
    match severity {
        Severity::Fail => "error",
        Severity::Warn => "warning",
        Severity::Undecidable => "note",
    }
}

/// Converts a path to a URI, relative to the working directory unless the path is absolute.
fn uri(file: &str) -> String {
    let slashed = file.replace(std::path::MAIN_SEPARATOR, "/");
    let encoded = utf8_percent_encode(&slashed, PATH).to_string();
    if Path::new(file).is_absolute() { format!("file://{}{encoded}", if encoded.starts_with('/') { "" } else { "/" }) } else { encoded }
}

fn rules() -> serde_json::Value {
    let of_library = Rule::ALL.into_iter().map(|rule| (rule.name(), rule.help(), rule.law(), rule.severity()));
    let all = of_library.chain([(MALFORMED, MALFORMED_HELP, "no law of mechanics", Severity::Fail)]);
    all.map(|(id, help, law, severity)| {
        let first = help.split_inclusive(". ").next().unwrap_or(help).trim();
        value!({
            "id": id,
            "name": id,
            "shortDescription": { "text": first },
            "fullDescription": { "text": help },
            "help": { "text": format!("{help} Law: {law}."), "markdown": format!("{help}\n\n`{law}`") },
            "defaultConfiguration": { "level": level(severity) },
        })
    })
    .collect()
}

impl Report for Sarif {
    fn begin(&mut self, to: &mut Vec<u8>) -> io::Result<()> {
        let driver = value!({
            "name": "planar-impact check",
            "version": env!("CARGO_PKG_VERSION"),
            "semanticVersion": env!("CARGO_PKG_VERSION"),
            "rules": rules(),
        });
        write!(
            to,
            "{{ \"$schema\": \"https://json.schemastore.org/sarif-2.1.0.json\", \"version\": \"2.1.0\", \"runs\": [ {{\n\"tool\": {{ \"driver\": {driver} }},\n\
             \"columnKind\": \"unicodeCodePoints\",\n\"results\": ["
        )
    }

    fn begin_file(&mut self, _: &mut Vec<u8>, _: &str) -> io::Result<()> {
        Ok(())
    }

    fn record(&mut self, to: &mut Vec<u8>, file: &str, entry: &Entry) -> io::Result<()> {
        for (i, found) in entry.findings.iter().enumerate() {
            writeln!(to, "{}", if self.is_behind { "," } else { "" })?;
            self.is_behind = true;
            json::write(to, &result(file, entry, i, found))?;
        }
        Ok(())
    }

    fn end_file(&mut self, _: &mut Vec<u8>) -> io::Result<()> {
        Ok(())
    }

    fn end(&mut self, to: &mut Vec<u8>, summary: &Summary, interrupted: bool) -> io::Result<()> {
        let summary = serde_json::to_string(summary)?;
        let invocations = if interrupted { "\"invocations\": [ { \"executionSuccessful\": false } ],\n" } else { "" };
        writeln!(to, "\n],\n{invocations}\"properties\": {{ \"summary\": {summary} }} }} ] }}")
    }
}

fn result(file: &str, entry: &Entry, place: usize, found: &Found) -> serde_json::Value {
    let name = clean(&entry.title());
    value!({
        "ruleId": found.rule,
        "level": level(found.severity),
        "message": { "text": format!("{name}: {}", clean(&found.what)) },
        "locations": [ {
            "physicalLocation": { "artifactLocation": { "uri": uri(file) }, "region": { "startLine": entry.line.max(1) } },
            "logicalLocations": [ { "name": name, "kind": "record" } ],
        } ],
        "partialFingerprints": { "record/v1": format!("{name}/{place}/{}", found.rule) },
        "properties": { "size": found.size, "bound": found.bound },
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_becomes_a_uri() {
        assert_eq!(uri("records/a b&c.jsonl"), "records/a%20b%26c.jsonl");
        assert_eq!(uri("<stdin>"), "%3Cstdin%3E");
        assert_eq!(uri("ä.csv"), "%C3%A4.csv");
        #[cfg(unix)]
        assert_eq!(uri("/tmp/a.csv"), "file:///tmp/a.csv");
    }

    #[test]
    fn every_rule_is_described() {
        let rules = rules();
        assert_eq!(rules.as_array().map(Vec::len), Some(Rule::COUNT + 1));
        assert_eq!(
            rules[0]["shortDescription"]["text"],
            "Every number is finite, masses and yaw inertias are above zero, resolutions are not below it, and one body can move."
        );
    }
}
