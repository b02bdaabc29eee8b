//! The reconstruction as a person reads it: what it is worth first.

mod collision;
mod diagnostics;
mod evidence;
mod headline;
mod unknowns;

use planar_impact::reconstruct::Verdict;
use unicode_width::UnicodeWidthStr;

use super::Reconstructed;
use crate::report::{heading, notes_below};
use crate::table::{self, Align, wrap};
use crate::units::Units;

/// The columns of a terminal.
const WIDTH: usize = 80;

/// The report, in at most 80 columns.
pub fn render(result: &Reconstructed, units: Units) -> String {
    let page = Page { result, units };
    let mut text = heading(&result.question.case.title);
    let sections = [
        page.headline(),
        page.unknowns(),
        page.alternatives(),
        page.evidence(),
        page.correlations(),
        page.influence(),
        page.diagnostics(),
        page.collision(),
        page.crash3(),
        page.search(),
    ];
    let sections: Vec<String> = sections.into_iter().filter(|section| !section.is_empty()).collect();
    text.push_str(&sections.join("\n"));
    if !result.notes.is_empty() {
        text.push('\n');
        text.push_str(&notes_below(&result.notes));
    }
    text
}

struct Page<'a> {
    result: &'a Reconstructed,
    units: Units,
}

impl Page<'_> {
    fn verdict(&self) -> Verdict {
        self.result.verdict()
    }

    /// How it was searched for, so that it can be searched for again.
    fn search(&self) -> String {
        let answer = &self.result.answer;
        let ended = match &answer.solutions[..] {
            // Along a valley each ends elsewhere.
            _ if answer.verdict == Verdict::Undetermined => "at different values of what is open".to_owned(),
            [one] => format!("{} of them at this one", one.searches),
            several => {
                several.iter().map(|solution| solution.searches.to_string()).collect::<Vec<_>>().join(", ") + " at the solutions in turn"
            }
        };
        let worse = match answer.worse.len() {
            0 => String::new(),
            1 => " One other least sum of squares was found, which the evidence tells from the best.".to_owned(),
            count => format!(" {count} other least sums of squares were found, which the evidence tells from the best."),
        };
        // Beside each solution it is searched again, so there are more searches than starts, or one alone where a formula has the answer.
        let starts = match answer.searches {
            1 => "1 search from 1 start".to_owned(),
            searches => format!("{searches} searches from {} starts", searches.min(self.result.search.starts)),
        };
        wrap(
            &format!(
                "{starts} (--starts), drawn with seed {} (--seed): {} came to an end, {ended}.{worse}",
                self.result.search.seed, answer.converged
            ),
            "",
        )
    }
}

/// A table of at most 80 columns: where it would be wider, the names in its columns break after a point.
fn fitted(header: &[&str], columns: &[Align], rows: &[Vec<String>]) -> String {
    let mut rows = rows.to_vec();
    let mut text = table::narrow(header, columns, &rows);
    for place in (0..columns.len()).filter(|&place| columns[place] == Align::Left) {
        let over = text.lines().map(UnicodeWidthStr::width).max().unwrap_or(0).saturating_sub(WIDTH);
        if over == 0 {
            break;
        }
        let longest = rows.iter().map(|row| row[place].width()).max().unwrap_or(0);
        let most = longest.saturating_sub(over).max(16);
        rows.iter_mut().for_each(|row| row[place] = broken(&row[place], most));
        text = table::narrow(header, columns, &rows);
    }
    text + "\n"
}

/// A name in two lines if it is longer than it may be.
fn broken(name: &str, most: usize) -> String {
    if name.width() <= most {
        return name.to_owned();
    }
    let mut points = name.char_indices().filter(|(_, c)| matches!(c, '.' | '_' | ' ')).map(|(at, _)| at + 1);
    match points.rfind(|at| *at <= most) {
        Some(at) => format!("{}\n  {}", &name[..at], &name[at..]),
        None => name.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_names_break_after_a_point() {
        assert_eq!(broken("vehicle.1.speed", 20), "vehicle.1.speed");
        assert_eq!(broken("vehicle.1.separation_velocity.x", 26), "vehicle.1.separation_\n  velocity.x");
        let row = vec!["vehicle.1.separation_velocity.x".to_owned(), "x".repeat(52)];
        let text = fitted(&["a", "b"], &[Align::Left, Align::Left], &[row]);
        assert!(text.lines().all(|line| line.width() <= WIDTH), "{text}");
    }
}
