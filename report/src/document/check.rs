//! The report of `check`: how many records hold, and the worst of those that do not, however many there are.

use std::collections::BTreeMap;

use planar_impact_app::check::{Entry, Found, Summary};
use planar_impact_app::issue::Issues;
use planar_impact_app::plain_text::shorten;

use super::{Options, Part, sections};
use crate::block::{Block, Table};
use crate::html::Document;

/// Most findings of a rule that are shown.
const SHOWN: usize = 20;
/// Most columns of a name and of a finding.
const NAME: usize = 60;
const WHAT: usize = 400;

/// What a report keeps of records: their number by verdict, and the first findings of each rule. It does not grow with the number of records.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CheckDigest {
    files: Vec<String>,
    summary: Summary,
    findings: BTreeMap<(&'static str, &'static str), Vec<Vec<String>>>,
}

impl CheckDigest {
    /// Begins a file.
    pub fn file(&mut self, name: &str) {
        if self.files.len() < SHOWN {
            self.files.push(shorten(name, NAME));
        }
    }

    /// Adds a record of a file.
    pub fn add(&mut self, file: &str, entry: &Entry) {
        self.summary.add(entry);
        for found in &entry.findings {
            let rows = self.findings.entry((found.severity.name(), found.rule)).or_default();
            if rows.len() < SHOWN {
                rows.push(row(file, entry, found));
            }
        }
    }

    /// Writes the report.
    ///
    /// # Errors
    ///
    /// Parts that are asked for and have nothing in them.
    pub fn document(&self, options: &Options) -> Result<Document, Issues> {
        let of_part = |part| match part {
            Part::Summary => self.summary_blocks(options),
            Part::Method => vec![Block::paragraph(
                "Each record is held to the laws of impact: conservation of momentum and of angular momentum, the line of action, the energy account, \
                 restitution, the sliding limit and what the record claims of itself. A residual is compared with the bound that the resolution of the \
                 numbers implies, or else the tolerance of the call. `planar-impact check --rules` prints every rule.",
            )],
            Part::Results => self.results(),
            _ => Vec::new(),
        };
        Ok(Document {
            title: "Check of collision records".to_owned(),
            foot: format!("planar-impact {}", env!("CARGO_PKG_VERSION")),
            sections: sections(options, of_part)?,
            embedded: Vec::new(),
        })
    }

    fn summary_blocks(&self, options: &Options) -> Vec<Block> {
        let Summary { records, pass, warn, fail, undecidable, unchecked, .. } = self.summary;
        let mut verdict =
            if fail > 0 { format!("{fail} of {records} records break a law.") } else { format!("None of {records} records breaks a law.") };
        if unchecked > 0 {
            verdict.push_str(&format!(" {unchecked} of them give too little for any law."));
        }
        let counts = [("pass", pass), ("pass with warnings", warn), ("fail", fail), ("undecidable", undecidable)];
        let counts = counts.map(|(verdict, count)| vec![verdict.to_owned(), count.to_string()]).to_vec();
        let mut rows = vec![
            ["Files".to_owned(), self.files.join("; ")],
            ["Program".to_owned(), format!("planar-impact {}", env!("CARGO_PKG_VERSION"))],
        ];
        rows.extend(options.date.iter().map(|date| ["Date".to_owned(), date.clone()]));
        let tables = [
            Table::new(["verdict", "records"], "lr", counts),
            Table::new(["this report", ""], "ll", rows.into_iter().map(Vec::from).collect()),
        ];
        std::iter::once(Block::paragraph(verdict)).chain(tables.map(Block::from)).collect()
    }

    fn results(&self) -> Vec<Block> {
        let mut blocks = Vec::new();
        for ((severity, rule), rows) in &self.findings {
            let count = self.summary.findings.get(&(*severity, *rule)).copied().unwrap_or(0);
            let of = if count > rows.len() as u64 { format!("{count}, of which the first {}", rows.len()) } else { count.to_string() };
            blocks.push(Block::Heading { level: 2, text: format!("{rule} ({severity}): {of}") });
            blocks.push(Table::new(["record", "file and line", "finding"], "lll", rows.clone()).into());
        }
        if blocks.is_empty() {
            blocks.push(Block::paragraph("No finding."));
        }
        blocks
    }
}

fn row(file: &str, entry: &Entry, found: &Found) -> Vec<String> {
    vec![shorten(&entry.id, NAME), format!("{}, line {}", shorten(file, NAME), entry.line), shorten(&found.what, WHAT)]
}
