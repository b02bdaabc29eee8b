//! The verb `check`: checks collision results of any program against the laws of mechanics.
//!
//! Every file is validated before its records are read. Then records are read, checked and returned one by one, in
//! memory that does not grow with their number.

mod complaint;
mod csv;
mod document;
mod draft;
mod entry;
mod header;
mod input;
mod json;
mod jsonl;
mod lines;
mod rounding;
pub mod rules;
mod stream;
mod summary;
mod units;

use std::collections::VecDeque;

use schemars::JsonSchema;
use serde::Serialize;

use planar_impact::issue::{InputIssue, Issue as _};

pub use planar_impact::check::{Options, Severity, Verdict};

use crate::issue::{Cause, Issue, Issues};
use input::{FileIssue, Input};
use stream::Stream;

pub use entry::{CheckFinding, CheckedRecord, Entry, Found, MALFORMED, MALFORMED_HELP};
pub use input::{Open, Origin, Reader, reason};
pub use summary::Summary;

/// The JSON document of `check`, which is written record by record.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct CheckReport<'a> {
    /// The version of this document.
    pub schema: u32,
    /// The records of all files.
    pub records: Vec<CheckedRecord<'a>>,
    /// `true` if the run was interrupted before the last record.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    #[schemars(default)]
    pub interrupted: bool,
    /// Number of records with each verdict.
    pub summary: Summary,
}

/// The checked records of one file, in file order.
///
/// ```
/// use planar_impact_app::check::{Entries, Options, Origin, Verdict};
/// let text = "id,b1.mass,b2.mass,b1.before.vx,b1.before.vy\n,kg,kg,m/s,m/s\na,1000,1500,10,0\n";
/// let origin = Origin::Pipe(Box::new(text.as_bytes()));
/// let entries = Entries::open("records.csv", Some("csv"), origin, Options::default())?;
/// let verdicts: Result<Vec<Verdict>, _> = entries.map(|entry| entry.map(|entry| entry.verdict)).collect();
/// assert_eq!(verdicts?.len(), 1);
/// # Ok::<(), planar_impact_app::Issues>(())
/// ```
pub struct Entries {
    name: String,
    input: Input,
    stream: Stream,
    ready: VecDeque<Entry>,
    has_ended: bool,
}

impl Entries {
    /// Opens a file of records and validates its beginning, or all of it if it is a JSON document. Messages call it
    /// `name`; a lower-case extension selects its format.
    ///
    /// # Errors
    ///
    /// Returns every issue of the options, or every issue that makes the file unusable.
    pub fn open(name: &str, extension: Option<&str>, origin: Origin, options: Options) -> Result<Entries, Issues> {
        options.validate().map_err(|invalid| {
            let issue = |issue: InputIssue| Issue::of_call("tolerance", issue.message(), None);
            Issues::without_source(Cause::Input, invalid.into_iter().map(issue).collect())
        })?;
        let input = Input::open(origin, extension).map_err(|found| issues(name, found))?;
        Ok(Entries { name: name.to_owned(), input, stream: Stream::new(options), ready: VecDeque::new(), has_ended: false })
    }

    /// Returns the name of the file.
    pub fn name(&self) -> &str {
        &self.name
    }
}

impl Iterator for Entries {
    type Item = Result<Entry, Issues>;

    fn next(&mut self) -> Option<Self::Item> {
        while self.ready.is_empty() && !self.has_ended {
            match self.input.next() {
                Ok(Some((line, record))) => self.stream.take(line, record, &mut self.ready),
                Ok(None) => {
                    self.has_ended = true;
                    self.stream.finish(&mut self.ready);
                }
                Err(found) => {
                    self.has_ended = true;
                    return Some(Err(issues(&self.name, found)));
                }
            }
        }
        self.ready.pop_front().map(Ok)
    }
}

/// Returns the issue for a file that cannot be used, without its text.
///
/// ```
/// let issues = planar_impact_app::check::unusable("a.csv", "is a directory, not a file of records");
/// assert_eq!(issues.to_string(), "`a.csv`: is a directory, not a file of records");
/// ```
pub fn unusable(name: &str, message: &str) -> Issues {
    issues(name, vec![input::of_file(message)])
}

/// Adds the file and line to each issue.
fn issues(name: &str, found: Vec<FileIssue>) -> Issues {
    let place = |line: Option<u64>| line.map_or(format!("`{name}`"), |line| format!("`{name}`, line {line}"));
    let issue = |(line, complaints): &FileIssue| -> Vec<Issue> {
        complaints.iter().map(|complaint| Issue::of_file("unreadable-file", format!("{}: {complaint}", place(*line)))).collect()
    };
    Issues::without_source(Cause::Input, found.iter().flat_map(issue).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the findings of the records of a text.
    fn findings(text: String, extension: &str) -> Vec<Vec<String>> {
        let origin = Origin::Pipe(Box::new(std::io::Cursor::new(text)));
        let entries = Entries::open("records", Some(extension), origin, Options::default()).expect("it can be read");
        let finding = |found: &Found| format!("{} {}: {}", found.severity, found.rule, found.what);
        entries.map(|entry| entry.expect("it can be read").findings.iter().map(finding).collect()).collect()
    }

    /// A moment impulse and a contact that lasts, as in the tests of the library; the moment in kN m s.
    #[test]
    fn moments_and_places_after_a_contact_are_read_in_every_format() {
        let header = r#"{"schema": "planar-impact-record/1", "units": {"length": "m", "mass": "kg", "time": "s", "angle": "rad", "moment": "kN m s"}}"#;
        let moment = |value: &str, work: &str| {
            format!(
                r#"{{"id": "m{value}{work}", "profile": "stepper", "bodies": [{{"mass": 1, "yaw_inertia": 2, "cg": [-1, 0], "before": {{"v": [3, 0], "yaw_rate": 0}}, "after": {{"v": [-1, 0], "yaw_rate": 1.5}}}}, {{"fixed": true}}], "contact": {{"point": [0, 0], "normal_angle": 0, "moment": {value}}}, "reported": {{"work_moment": {work}}}, "resolution": {{"moment": 0.00001}}}}"#
            )
        };
        let lasting = |contact: &str| {
            format!(
                r#"{{"id": "{}", "profile": "stepper", "bodies": [{{"mass": 1, "yaw_inertia": 1, "cg": [-1, 0], "before": {{"v": [2, 1], "yaw_rate": 0.375}}, "after": {{"v": [-1, 1], "yaw_rate": -0.375, "cg": [-0.75, 0.5]}}}}, {{"mass": 1, "yaw_inertia": 1, "cg": [1, 0], "before": {{"v": [-2, -1], "yaw_rate": 0.375}}, "after": {{"v": [1, -1], "yaw_rate": -0.375, "cg": [0.75, -0.5]}}}}], "contact": {{"point": [0, 0]{contact}}}}}"#,
                contact.len()
            )
        };
        let all = [
            header.to_owned(),
            moment("0.003", "2.25"),
            moment("0.004", "2.25"),
            moment("0.003", "-2.25"),
            lasting(r#", "point_after": [0, 0]"#),
            lasting(r#", "duration": 0.5"#),
            lasting(""),
            lasting(r#", "point_after": [0, 0], "duration": -1"#),
        ];
        let found = findings(all.join("\n"), "jsonl");
        assert!(found[0].is_empty() && found[3].is_empty(), "{found:?}");
        for (record, start) in [
            (1, "fail line-of-action"),
            (2, "fail reported: reported.work_moment"),
            (4, "warn line-of-action"),
            (5, "warn line-of-action"),
            (6, "fail finite: contact.duration is -1"),
        ] {
            assert!(found[record][0].starts_with(start), "{record}: {found:?}");
        }
        let names = "id,profile,b1.mass,b1.yaw_inertia,b1.cgx,b1.cgy,b1.before.vx,b1.before.vy,b1.before.yaw_rate,b1.after.vx,b1.after.vy,b1.after.yaw_rate,\
                     b2.fixed,contact.px,contact.py,contact.moment,contact.after.px,contact.after.py,contact.duration,b1.after.cgx,b1.after.cgy";
        let units = ",,kg,kg m^2,m,m,m/s,m/s,rad/s,m/s,m/s,rad/s,,m,m,N m s,m,m,s,m,m";
        let csv = |moment: &str| format!("{names}\n{units}\na,stepper,1,2,-1,0,3,0,0,-1,0,1.5,true,0,0,{moment},0,0,0,-1,0\n");
        assert!(findings(csv("3"), "csv")[0].is_empty(), "{:?}", findings(csv("3"), "csv"));
        assert!(findings(csv("4"), "csv")[0][0].starts_with("fail line-of-action"));
        let half = format!("{names}\n{units}\na,stepper,1,2,-1,0,3,0,0,-1,0,1.5,true,0,0,3,0,,0,-1,0\n");
        assert!(findings(half, "csv")[0][0].contains("contact.after.py: missing"));
    }

    /// Of 1000 and 1700 kg at 10 m/s and a restitution of 0.3, after which they have 1.814815 and 4.814815 m/s: 8185.185 N s were exchanged.
    #[test]
    fn a_broken_rule_that_rounding_explains_says_so() {
        const HINT: &str = "; if the numbers of this record are rounded to the digits they have, it breaks no rule: give it the profile `printed` and a `resolution`";
        let header = r#"{"schema": "planar-impact-record/1", "units": {"length": "m", "mass": "kg", "time": "s", "angle": "rad"}}"#;
        let json = |after: [f64; 2], impulse: f64, more: &str| {
            let [one, two] = after;
            let record = format!(
                r#"{{"id": "a", "bodies": [{{"mass": 1000, "before": {{"v": [10, 0]}}, "after": {{"v": [{one}, 0]}}}}, {{"mass": 1700, "before": {{"v": [0, 0]}}, "after": {{"v": [{two}, 0]}}}}], "contact": {{"normal_angle": 0}}, "model": {{"restitution": 0.3}}, "reported": {{"impulse": {impulse}}}{more}}}"#
            );
            findings(format!("{header}\n{record}"), "jsonl").remove(0)
        };
        let csv = |one: &str, two: &str, impulse: &str| {
            let names = "id,b1.mass,b2.mass,b1.before.vx,b1.before.vy,b2.before.vx,b2.before.vy,b1.after.vx,b1.after.vy,b2.after.vx,b2.after.vy,reported.impulse.magnitude";
            let units = ",kg,kg,km/h,km/h,km/h,km/h,km/h,km/h,km/h,km/h,N s";
            findings(format!("{names}\n{units}\na,1000,1700,36,0,0,0,{one},0,{two},0,{impulse}\n"), "csv").remove(0)
        };
        let hints = |found: &[String]| found.iter().filter(|what| what.ends_with(HINT)).count();
        let rounded = json([1.81, 4.81], 8185.0, "");
        assert!(rounded.len() > 1 && rounded[0].ends_with(HINT) && hints(&rounded) == 1, "{rounded:?}");
        assert_eq!(
            json([1.81, 4.81], 8185.0, r#", "profile": "printed", "resolution": {"v": 0.005, "impulse": 0.5}"#),
            Vec::<String>::new()
        );
        let of_row = csv("6.53", "17.33", "8185");
        assert!(!of_row.is_empty() && hints(&of_row) == 1, "{of_row:?}");
        let unexplained = [
            json([1.81, 4.85], 8185.0, ""),
            json([1.81, 4.81], 8260.0, ""),
            json([1.811111111, 4.81], 8185.0, ""),
            json([1.81, 4.81], 8185.0, r#", "resolution": {"v": 0.00001}"#),
            csv("6.53", "17.4", "8185"),
            csv("6.53", "17.33", "8260"),
        ];
        for found in unexplained {
            assert!(!found.is_empty() && hints(&found) == 0, "{found:?}");
        }
    }

    #[test]
    fn invalid_options_are_refused_before_the_file_is_read() {
        let origin = Origin::Pipe(Box::new(&b"not a file of records"[..]));
        let refused = Entries::open("a.csv", Some("csv"), origin, Options { tolerance: Some(f64::NAN) });
        let issues = refused.err().expect("NaN is no tolerance");
        assert_eq!((issues.list().len(), issues.list()[0].path.as_str()), (1, "tolerance"), "{issues}");
        assert_eq!(issues.to_string(), "tolerance: it is not finite: NaN");
    }
}
