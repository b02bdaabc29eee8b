//! Statements of Table 1 about increasing restitution.

use super::{Standing, Statement, largest, rounds_to};
use crate::account::Computed;

const PLACE: &str = "after Table 1";

/// One position and one pair of speeds, at e = 0, 0.15 and 0.30.
struct Series<'a> {
    label: String,
    mu_0: [&'a Computed; 3],
    w_n: [&'a Computed; 3],
    w_t: [&'a Computed; 3],
}

impl Series<'_> {
    /// Returns all nine series of Table 1; fewer if rows are missing.
    fn all(cells: &[Computed]) -> Vec<Series<'_>> {
        let one = |label: &str, column: &str| {
            let at = |e: &str| cells.iter().find(|cell| cell.row == format!("{label} {e}") && cell.column == column);
            Some([at("0.00")?, at("0.15")?, at("0.30")?])
        };
        let labels =
            ["A", "B", "C"].into_iter().flat_map(|position| ["-40 40", "-20 40", "-40 20"].map(|pair| format!("{position} {pair}")));
        labels
            .filter_map(|label| Some(Series { mu_0: one(&label, "mu_0")?, w_n: one(&label, "W_n")?, w_t: one(&label, "W_t")?, label }))
            .collect()
    }
}

fn values(cells: &[&Computed; 3]) -> [f64; 3] {
    cells.map(|cell| cell.value)
}

fn printed(cells: &[&Computed; 3]) -> [f64; 3] {
    cells.map(|cell| cell.printed.value())
}

/// Returns the change from the first to the last value, in percent of the first.
fn percent([first, _, last]: [f64; 3]) -> f64 {
    ((last - first) / first).abs() * 100.0
}

fn rises(magnitudes: [f64; 3]) -> bool {
    let [a, b, c] = magnitudes.map(f64::abs);
    a < b && b < c
}

fn falls([a, b, c]: [f64; 3]) -> bool {
    rises([c, b, a])
}

/// Returns `true` if the values are equal except for binary rounding.
fn is_constant([a, b, c]: [f64; 3]) -> bool {
    (b / a - 1.0).abs() < 1e-12 && (c / a - 1.0).abs() < 1e-12
}

/// Returns the series with the largest value of `size`.
fn where_largest<'a, 'b>(series: &'b [Series<'a>], size: impl Fn(&Series<'a>) -> f64) -> Option<&'b Series<'a>> {
    series.iter().max_by(|a, b| size(a).total_cmp(&size(b)))
}

pub(super) fn statements(cells: &[Computed]) -> Vec<Statement> {
    let series = Series::all(cells);
    let complete = series.len() == 9;
    let mut statements = vec![both_works_move(&series), normal_work_falls(&series), tangential_trend(&series)];
    statements.extend([largest_normal_change(&series), largest_tangential_change(&series), tangential_rarely_moves_more(&series)]);
    statements.extend([critical_ratio_moves_little(&series), critical_ratio_in_general(&series)]);
    for statement in &mut statements {
        if !complete {
            statement.standing = Standing::Fails;
        }
    }
    statements
}

fn both_works_move(series: &[Series<'_>]) -> Statement {
    let still = series.iter().filter(|s| is_constant(values(&s.w_n)) || is_constant(values(&s.w_t)));
    let still = still.map(|s| s.label.as_str()).collect::<Vec<_>>();
    Statement {
        name: "restitution moves both works",
        place: PLACE,
        says: "for all geometries, changes in e lead to changes in both W_n and W_t",
        found: format!("one of them does not change in: {}; the paper says so itself of position B", still.join(", ")),
        standing: Standing::of(still.is_empty()),
        expected: Standing::Fails,
    }
}

fn normal_work_falls(series: &[Series<'_>]) -> Statement {
    let exceptions = series.iter().filter(|s| !falls(values(&s.w_n))).map(|s| s.label.as_str()).collect::<Vec<_>>();
    let works = series.iter().find(|s| s.label == "C -20 40").map_or([f64::NAN; 3], |s| values(&s.w_n));
    Statement {
        name: "normal work falls as restitution grows",
        place: PLACE,
        says: "with one exception, position C at (-20, 40), W_n decreases as e increases from 0 to 0.3",
        found: format!(
            "exceptions: {}; its W_n is {:.1}, {:.1}, {:.1} ft lb: it grows up to e = 0.15 alone",
            exceptions.join(", "),
            works[0],
            works[1],
            works[2]
        ),
        standing: Standing::of(exceptions == ["C -20 40"]),
        expected: Standing::Holds,
    }
}

fn tangential_trend(series: &[Series<'_>]) -> Statement {
    let holds = series.iter().all(|s| {
        let works = values(&s.w_t);
        match s.label.split(' ').next() {
            Some("A") => rises(works),
            Some("B") => is_constant(works),
            _ => falls(works),
        }
    });
    Statement {
        name: "tangential work follows the geometry",
        place: PLACE,
        says: "as e increases, W_t increases in position A, decreases in C, and does not change in B",
        found: format!("{} of all nine", if holds { "so" } else { "not so" }),
        standing: Standing::of(holds),
        expected: Standing::Holds,
    }
}

fn largest_normal_change(series: &[Series<'_>]) -> Statement {
    let change = |s: &Series<'_>| percent(values(&s.w_n));
    let most = where_largest(series, change);
    let (label, size) = most.map_or(("", f64::NAN), |s| (s.label.as_str(), change(s)));
    Statement {
        name: "largest change of normal work",
        place: PLACE,
        says: "the largest percent change of W_n for a change in e is 12.6 %, for position A",
        found: format!("{size:.3} % from e = 0 to 0.30, in percent of the value at e = 0, in {label}"),
        standing: Standing::of(rounds_to(size, "12.6") && label.starts_with('A')),
        expected: Standing::Holds,
    }
}

fn largest_tangential_change(series: &[Series<'_>]) -> Statement {
    let change = |s: &Series<'_>| percent(values(&s.w_t));
    let most = where_largest(series, change);
    let (label, size) = most.map_or(("", f64::NAN), |s| (s.label.as_str(), change(s)));
    let from_print = most.map_or(f64::NAN, |s| percent(printed(&s.w_t)));
    let place = label == "C -40 20";
    Statement {
        name: "largest change of tangential work",
        place: PLACE,
        says: "the largest percent change of W_t for a change in e is 15.0 %, for position C at (-40, 20)",
        found: format!("{size:.3} % from e = 0 to 0.30 in {label}; {from_print:.4} % from the printed works, which alone rounds to 15.0"),
        standing: Standing::conditional(place && rounds_to(from_print, "15.0"), rounds_to(size, "15.0")),
        expected: Standing::HoldsConditionally,
    }
}

fn tangential_rarely_moves_more(series: &[Series<'_>]) -> Statement {
    let more = series.iter().filter(|s| percent(values(&s.w_t)) > percent(values(&s.w_n)));
    let more = more.map(|s| s.label.as_str()).collect::<Vec<_>>();
    Statement {
        name: "tangential work rarely moves more",
        place: PLACE,
        says: "position C at (-40, 20) is the only case in which W_t changes by more percent than W_n",
        found: format!("W_t changes by more in: {}", more.join(", ")),
        standing: Standing::of(more == ["C -40 20"]),
        expected: Standing::Holds,
    }
}

/// Returns the change of the critical ratio from e = 0.15 to 0.30, in percent of the value at e = 0.15.
fn ratio_change(series: &Series<'_>) -> f64 {
    let [_, half, whole] = values(&series.mu_0);
    percent([half, half, whole])
}

fn critical_ratio_moves_little(series: &[Series<'_>]) -> Statement {
    let first = series.iter().find(|s| s.label == "A -40 40");
    let [_, half, whole] = first.map_or([f64::NAN; 3], |s| values(&s.mu_0));
    let change = first.map_or(f64::NAN, ratio_change);
    Statement {
        name: "critical ratio moves little",
        place: PLACE,
        says: "as e is changed from 0.15 to 0.3, μ0 changed from 0.594 to 0.542, only about 9 %",
        found: format!("from {half:.4} to {whole:.4}, {change:.2} %"),
        standing: Standing::of(rounds_to(half, "0.594") && rounds_to(whole, "0.542") && rounds_to(change, "9")),
        expected: Standing::Holds,
    }
}

fn critical_ratio_in_general(series: &[Series<'_>]) -> Statement {
    let most = where_largest(series, ratio_change);
    let (label, size) = most.map_or(("", f64::NAN), |s| (s.label.as_str(), ratio_change(s)));
    let whole = largest(series.iter().map(|s| percent(values(&s.mu_0))));
    let shown = series.iter().find(|s| s.label == "A -40 40").map_or(f64::NAN, ratio_change);
    // "Large" is interpreted as more than the 9 % of the paper's own example, rounded.
    Statement {
        name: "critical ratio moves little everywhere",
        place: PLACE,
        says: "for the geometries and parameters investigated, large changes in e do not lead to large changes in μ0",
        found: format!(
            "the 9 % of the paper's pair is among the smallest: {size:.1} % from e = 0.15 to 0.30 in {label}, and {whole:.1} % at most from 0 to 0.30"
        ),
        standing: Standing::conditional(rounds_to(shown, "9"), size < 9.5),
        expected: Standing::HoldsConditionally,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn trends_are_of_magnitudes_and_strict() {
        // Table 1, W_t in position A and in position B, and W_n in C at (-20, 40).
        assert!(rises([-19883.6, -20308.8, -20734.0]));
        let exception = [-5398.2, -5457.4, -5210.0];
        assert!(!rises(exception) && !falls(exception));
        let flat = [-16747.6, -16747.6, -16747.6];
        assert!(is_constant(flat) && !rises(flat) && !falls(flat) && !is_constant([1.0, 1.0, 1.001]));
        assert!(!is_constant([f64::NAN; 3]));
    }

    #[test]
    fn percent_is_of_the_first() {
        // W_n of position A at (-20, 40), e = 0 and 0.30.
        assert!(rounds_to(percent([-8233.0, -7867.0, -7194.4]), "12.6"));
    }

    #[test]
    fn nothing_holds_of_no_table() {
        assert!(statements(&[]).iter().all(|statement| statement.standing == Standing::Fails));
    }
}
