//! JUnit XML: a suite for each file, a case for each record. Suites have no counts, because these are known only after the last record.

use std::io;

use planar_impact_app::check::{Entry, Found, Severity, Summary};
use quick_xml::Writer;
use quick_xml::events::{BytesDecl, BytesEnd, BytesStart, BytesText, Event};

use super::{Report, clean};
use crate::arguments::FailOn;

/// A report in JUnit XML.
pub struct JUnit {
    pub fail_on: FailOn,
}

fn event(to: &mut Vec<u8>, event: Event<'_>) -> io::Result<()> {
    Writer::new(&mut *to).write_event(event)?;
    to.push(b'\n');
    Ok(())
}

impl Report for JUnit {
    fn begin(&mut self, to: &mut Vec<u8>) -> io::Result<()> {
        event(to, Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)))?;
        event(to, Event::Start(BytesStart::new("testsuites").with_attributes([("name", "planar-impact check")])))
    }

    fn begin_file(&mut self, to: &mut Vec<u8>, file: &str) -> io::Result<()> {
        event(to, Event::Start(BytesStart::new("testsuite").with_attributes([("name", clean(file).as_str())])))
    }

    fn record(&mut self, to: &mut Vec<u8>, file: &str, entry: &Entry) -> io::Result<()> {
        let (name, file, line) = (clean(&entry.title()), clean(file), entry.line.to_string());
        let case = BytesStart::new("testcase").with_attributes([
            ("classname", file.as_str()),
            ("name", name.as_str()),
            ("file", file.as_str()),
            ("line", line.as_str()),
        ]);
        let unchecked = entry.unchecked();
        if entry.findings.is_empty() && unchecked.is_none() {
            return event(to, Event::Empty(case));
        }
        event(to, Event::Start(case))?;
        let (failures, rest): (Vec<&Found>, Vec<&Found>) =
            entry.findings.iter().chain(&unchecked).partition(|found| self.fail_on.includes(found.severity));
        for found in &failures {
            element(to, "failure", found)?;
        }
        // A case as a whole is skipped, once, unless it fails.
        let undecidable = rest.iter().find(|found| found.severity == Severity::Undecidable && failures.is_empty());
        if let Some(found) = undecidable {
            element(to, "skipped", found)?;
        }
        let told: Vec<String> = rest.iter().map(|found| format!("{} ({}): {}", found.rule, found.severity, clean(&found.what))).collect();
        if !told.is_empty() {
            Writer::new(&mut *to).create_element("system-out").write_text_content(BytesText::new(&told.join("\n")))?;
            to.push(b'\n');
        }
        event(to, Event::End(BytesEnd::new("testcase")))
    }

    fn end_file(&mut self, to: &mut Vec<u8>) -> io::Result<()> {
        event(to, Event::End(BytesEnd::new("testsuite")))
    }

    fn end(&mut self, to: &mut Vec<u8>, _: &Summary, interrupted: bool) -> io::Result<()> {
        if interrupted {
            Writer::new(&mut *to).create_element("system-err").write_text_content(BytesText::new("interrupted before the last record"))?;
            to.push(b'\n');
        }
        event(to, Event::End(BytesEnd::new("testsuites")))
    }
}

fn element(to: &mut Vec<u8>, name: &str, found: &Found) -> io::Result<()> {
    let what = clean(&found.what);
    let mut writer = Writer::new(&mut *to);
    let element = writer.create_element(name).with_attribute(("message", format!("{}: {what}", found.rule).as_str()));
    if name == "failure" {
        element.with_attribute(("type", found.rule)).write_text_content(BytesText::new(&what))?;
    } else {
        element.write_empty()?;
    }
    to.push(b'\n');
    Ok(())
}
