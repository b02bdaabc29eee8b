//! Text for a terminal: the records that do not pass without findings, and a summary.

use std::io::{self, Write};

use planar_impact_app::check::{Entry, Summary, Verdict};
use planar_impact_app::plain_text::clean;
use planar_impact_report::text::wrap;

use super::Report;

/// A report as text.
#[derive(Default)]
pub struct Text {
    files: u64,
}

impl Report for Text {
    fn begin(&mut self, _: &mut Vec<u8>) -> io::Result<()> {
        Ok(())
    }

    fn begin_file(&mut self, _: &mut Vec<u8>, _: &str) -> io::Result<()> {
        self.files += 1;
        Ok(())
    }

    fn record(&mut self, to: &mut Vec<u8>, file: &str, entry: &Entry) -> io::Result<()> {
        if entry.verdict == Verdict::Pass {
            return Ok(());
        }
        let named = if entry.id.is_empty() { String::new() } else { format!("{}, ", clean(&entry.id)) };
        let head = format!("{named}{} line {}", clean(file), entry.line);
        to.write_all(wrap(&head, &format!("{}: ", entry.verdict.name().to_uppercase())).as_bytes())?;
        for found in &entry.findings {
            let severity = if found.severity.name() == entry.verdict.name() { String::new() } else { format!(" ({})", found.severity) };
            to.write_all(wrap(&clean(&found.what), &format!("  {}{severity}: ", found.rule)).as_bytes())?;
        }
        // If a record cannot be read, or has non-finite numbers, nothing is checked; listing all rules would add nothing.
        if !entry.not_checked.is_empty() && !entry.not_checked.contains(&"plausible-units") {
            to.write_all(wrap(&entry.not_checked.join(", "), "  not checked: ").as_bytes())?;
        }
        writeln!(to)
    }

    fn end_file(&mut self, _: &mut Vec<u8>) -> io::Result<()> {
        Ok(())
    }

    fn end(&mut self, to: &mut Vec<u8>, summary: &Summary, interrupted: bool) -> io::Result<()> {
        if interrupted {
            writeln!(to, "Interrupted before the last record.")?;
        }
        let Summary { records, pass, warn, fail, undecidable, unchecked, findings } = summary;
        let plural = |count: u64| if count == 1 { "" } else { "s" };
        let files = if self.files == 1 { String::new() } else { format!(" in {} files", self.files) };
        let counts =
            format!("{records} record{}{files}: {pass} pass, {warn} warn, {fail} fail, {undecidable} undecidable", plural(*records));
        to.write_all(wrap(&counts, "").as_bytes())?;
        if *unchecked > 0 {
            let none = format!("{unchecked} of them give too little for any law; see --rules");
            to.write_all(wrap(&none, "unchecked: ").as_bytes())?;
        }
        let rules: Vec<String> = findings.iter().map(|((severity, rule), count)| format!("{rule} {count} ({severity})")).collect();
        if rules.is_empty() { Ok(()) } else { to.write_all(wrap(&rules.join(", "), "found: ").as_bytes()) }
    }
}
