//! What to look at first.

use super::Page;
use crate::reconstruct::diagnostics::{is_outside, paragraph};
use crate::table::wrap;

impl Page<'_> {
    pub(super) fn diagnostics(&self) -> String {
        let findings = &self.result.findings;
        if findings.is_empty() {
            return String::new();
        }
        let outside = findings.iter().filter(|finding| is_outside(finding)).count();
        let what = match outside {
            0 => "What users of crash programs ask next; nothing is outside its limit:".to_owned(),
            1 => "What users of crash programs ask next; one figure is outside its limit:".to_owned(),
            count => format!("What users of crash programs ask next; {count} figures are outside their limits:"),
        };
        // What is outside its limit comes first.
        let (first, then): (Vec<_>, Vec<_>) = findings.iter().partition(|finding| is_outside(finding));
        let all = first.into_iter().chain(then).map(|finding| wrap(&paragraph(finding, self.units), "- "));
        wrap(&what, "") + &all.collect::<String>()
    }
}
