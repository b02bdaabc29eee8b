//! The unknowns of the solution.

use planar_impact_app::reconstruct::{Alternative, Derived, Interval, Reconstruction, Unknown};
use planar_impact_app::units::{Measure, Units, beyond_rounding};

use crate::block::{Block, Table};
use crate::page::rounding::{digits, probability, rounded, share};

/// Renders values, standard deviations and intervals, with the footnotes that they need.
pub fn blocks(answer: &Reconstruction, units: Units) -> Vec<Block> {
    let entries = |is_input: bool| {
        let all = answer.unknown.iter().filter(move |(_, unknown)| unknown.is_input == is_input);
        all.map(|(name, unknown)| (name, Row::of_unknown(unknown))).collect::<Vec<_>>()
    };
    let mut blocks: Vec<Block> = [("unknown", false), ("uncertain input", true)]
        .into_iter()
        .filter_map(|(head, is_input)| Some(entries(is_input)).filter(|rows| !rows.is_empty()).map(|rows| table(head, answer, rows, units)))
        .collect();
    for (name, unknown) in answer.unknown.iter() {
        blocks.extend(unknown.at_bound.map(|bound| Block::item("* ", at_bound(answer, name, unknown, bound))));
    }
    for name in &answer.weakly_determined {
        let text = "evidence barely constrains it: its standard deviation is larger than its whole range.";
        blocks.push(Block::item("! ", format!("{name}: {text}")));
    }
    blocks.extend(answer.unknown.iter().filter_map(|(name, unknown)| limited_by(name, &unknown.interval)));
    if !answer.has_uncertainty() && answer.has_solution() {
        blocks.push(Block::item("", "No piece of evidence has an uncertainty, so that of the unknowns is not known."));
    }
    blocks
}

/// Renders what follows from the unknowns, with its intervals.
pub fn derived(answer: &Reconstruction, units: Units) -> Vec<Block> {
    if answer.derived.is_empty() {
        return Vec::new();
    }
    let scale = |measure| answer.solution.as_ref().map_or(0.0, |solution| solution.facts.scale(measure));
    let rows = answer.derived.iter().map(|(name, derived)| (name, Row::of_derived(derived, scale(derived.measure)))).collect();
    vec![table("what follows", answer, rows, units)]
}

/// A row of a table of values and intervals.
struct Row<'a> {
    value: Option<f64>,
    sd: Option<f64>,
    interval: &'a Interval,
    is_at_bound: bool,
    measure: Measure,
}

impl<'a> Row<'a> {
    fn of_unknown(unknown: &'a Unknown) -> Self {
        let Unknown { value, sd, at_bound, measure, .. } = *unknown;
        Row { value, sd, interval: &unknown.interval, is_at_bound: at_bound.is_some(), measure }
    }

    /// Creates the row of what follows, of which a value that is rounding beside a scale is zero.
    fn of_derived(derived: &'a Derived, scale: f64) -> Self {
        let Derived { sd, measure, .. } = *derived;
        let value = derived.value.map(|value| beyond_rounding(value, scale));
        Row { value, sd, interval: &derived.interval, is_at_bound: false, measure }
    }

    /// Formats the row; without a name in another unit. Without any uncertainty there is no interval.
    fn cells(&self, name: &str, measure: Measure, has_uncertainty: bool, units: Units) -> Vec<String> {
        let dash = || "-".to_owned();
        /// Share of the value below which the width of an interval is the tolerance of exact evidence.
        const EXACT: f64 = 1e-5;
        let Interval { low, high, .. } = *self.interval;
        let width = high.zip(low).map(|(high, low)| high - low);
        let is_exact = !has_uncertainty || width.zip(self.value).is_some_and(|(width, value)| width <= EXACT * value.abs());
        // Without a standard deviation, the digits are those of a normal distribution as wide as the interval.
        let step = match width.filter(|_| !is_exact) {
            Some(width) => Some(self.sd.map_or(width / 4.0, |sd| sd.min(width))),
            None => self.sd.filter(|_| !is_exact),
        };
        let number = |value: f64| rounded(measure, value, step, units);
        let end = |end: Option<f64>| end.filter(|_| !is_exact).map_or_else(dash, number);
        let mark = if self.is_at_bound && !name.is_empty() { " *" } else { "" };
        let value = self.value.map_or_else(|| "open".to_owned(), number);
        let sd = self.sd.map_or_else(dash, |sd| if is_exact { "exact".to_owned() } else { number(sd) });
        vec![format!("{name}{mark}"), value, sd, end(low), end(high), units.unit(measure).to_owned()]
    }
}

/// Renders rows; a speed also in road units.
fn table(head: &str, answer: &Reconstruction, rows: Vec<(&str, Row<'_>)>, units: Units) -> Block {
    let cells = |(name, row): (&str, Row<'_>)| {
        let has_uncertainty = answer.has_uncertainty();
        let first = row.cells(name, row.measure, has_uncertainty, units);
        let road = units.on_the_road(row.measure).map(|road| row.cells("", road, has_uncertainty, units));
        [Some(first), road].into_iter().flatten()
    };
    Table::new([head, "value", "+/- sd", &from(answer), "to", "unit"], "lrrrrl", rows.into_iter().flat_map(cells).collect()).narrow().into()
}

/// Returns the head of the lower ends of ranges, with their level.
pub fn from(answer: &Reconstruction) -> String {
    let level = answer.unknown.iter().next().map_or(0.95, |(_, unknown)| unknown.interval.level);
    format!("{} from", share(level))
}

/// Names the bounds and the limits of the physics that make the ends of an interval.
fn limited_by(name: &str, interval: &Interval) -> Option<Block> {
    let limits = match (&interval.low_limited_by, &interval.high_limited_by) {
        (None, None) => return None,
        (Some(low), Some(high)) if low == high => format!("both ends of its interval come from {}", in_words(name, low)),
        (Some(low), Some(high)) => {
            format!("the lower end of its interval comes from {}, the upper end from {}", in_words(name, low), in_words(name, high))
        }
        (Some(low), None) => format!("the lower end of its interval comes from {}", in_words(name, low)),
        (None, Some(high)) => format!("the upper end of its interval comes from {}", in_words(name, high)),
    };
    Some(Block::item("- ", format!("{name}: {limits}.")))
}

/// Returns what is impossible beyond a limit of the physics.
pub fn beyond(limit: &str) -> Option<&'static str> {
    Some(match limit {
        "not-closing" => "the vehicles do not approach each other",
        "tensile" => "the impulse would pull",
        "beyond-critical" => "friction would do more than end the sliding, or speed it up",
        "energy-gain" => "the impact would gain energy",
        _ => return None,
    })
}

fn in_words(of: &str, limit: &str) -> String {
    match limit {
        "period" => "a whole turn".to_owned(),
        limit if beyond(limit).is_some() => format!("the physics: beyond it {}", beyond(limit).unwrap_or_default()),
        bound => match bound.rsplit_once(' ') {
            Some((name, "min")) if name == of => "its own lower bound".to_owned(),
            Some((name, _)) if name == of => "its own upper bound".to_owned(),
            Some((name, "min")) => format!("the lower bound of {name}"),
            Some((name, _)) => format!("the upper bound of {name}"),
            None => bound.to_owned(),
        },
    }
}

/// Explains an unknown at its bound, with the paper's guideline if it has one.
fn at_bound(answer: &Reconstruction, name: &str, unknown: &Unknown, bound: &str) -> String {
    let end = if bound == "min" { "lower" } else { "upper" };
    let meaning = match (name, bound) {
        ("contact.restitution", "max") => "without a reason for so high a value, re-examine the geometry.",
        ("contact.restitution", "min") if unknown.value == Some(0.0) => "a common velocity along the normal, as in most severe crashes.",
        _ if unknown.sd.is_some() => "the best fit without the bound lies there too.",
        _ if answer.has_uncertainty() => {
            "the best fit without the bound lies beyond it. It is held at the bound, so it has no standard deviation, and those of the others treat it as known; the intervals do not."
        }
        // Without any standard deviation, nothing distinguishes the two cases.
        _ => "is there a reason for that bound?",
    };
    format!("{name} lies on its {end} bound: {meaning}")
}

/// Renders several solutions side by side; nothing if there is only one.
pub fn alternatives(answer: &Reconstruction, units: Units) -> Vec<Block> {
    /// Number of solutions that fit side by side.
    const SHOWN: usize = 4;
    if answer.solutions.len() < 2 {
        return Vec::new();
    }
    let shown = &answer.solutions[..answer.solutions.len().min(SHOWN)];
    let mut rows: Vec<Vec<String>> = Vec::new();
    for (name, unknown) in answer.unknown.iter() {
        let value = |solution: &Alternative| {
            let value = solution.unknown.get(name).copied().unwrap_or(f64::NAN);
            rounded(unknown.measure, value, solution.sd.get(name).copied().flatten(), units)
        };
        let unit = units.unit(unknown.measure).to_owned();
        rows.push(std::iter::once(name.to_owned()).chain(shown.iter().map(value)).chain([unit]).collect());
    }
    let of_all = |what: &str, value: &dyn Fn(&Alternative) -> String| -> Vec<String> {
        std::iter::once(what.to_owned()).chain(shown.iter().map(value)).chain([String::new()]).collect()
    };
    rows.push(of_all("chi-square", &|solution| digits(solution.chi_square)));
    rows.push(of_all("probability", &|solution| probability(solution.probability)));
    let header: Vec<String> =
        std::iter::once("solution".to_owned()).chain((1..=shown.len()).map(|i| i.to_string())).chain(["unit".to_owned()]).collect();
    let columns = format!("l{}l", "r".repeat(shown.len()));
    let mut blocks = vec![Block::from(Table::new(header, &columns, rows).narrow())];
    if answer.solutions.len() > SHOWN {
        blocks.push(Block::item("", format!("{} more: --format json.", answer.solutions.len() - SHOWN)));
    }
    blocks
}
