//! Tests of the run on the embedded data, and on altered data.

mod measured;
mod tables;

use super::*;

fn report(alter: impl FnOnce(&mut Texts<'static>)) -> Report {
    run_altered(alter).expect("well formed")
}

fn run_altered(alter: impl FnOnce(&mut Texts<'static>)) -> Result<Report, DataError> {
    let mut texts = Texts::embedded();
    alter(&mut texts);
    run_on(&texts)
}

/// Replaces a text by an altered one, which lives as long as the embedded ones.
fn put(text: &mut &'static str, altered: String) {
    *text = altered.leak();
}

fn swap(text: &mut &'static str, from: &str, to: &str) {
    assert_eq!(text.matches(from).count(), 1, "{from}");
    replace(text, from, to);
}

fn replace(text: &mut &'static str, from: &str, to: &str) {
    put(text, text.replace(from, to));
}

fn add(text: &mut &'static str, more: &str) {
    put(text, format!("{text}{more}"));
}

/// Removes the only line that contains a piece of text.
fn drop_line(text: &mut &'static str, piece: &str) {
    let kept = text.lines().filter(|line| !line.contains(piece)).collect::<Vec<_>>();
    assert_eq!(kept.len() + 1, text.lines().count(), "{piece}");
    put(text, kept.join("\n"));
}

fn problems(alter: impl FnOnce(&mut Texts<'static>)) -> Vec<Problem> {
    let report = report(alter);
    assert!(!report.holds());
    assert!(report.problems().iter().all(|problem| !problem.to_string().is_empty()));
    report.problems()
}

#[test]
fn everything_is_accounted_for() {
    let report = run().expect("embedded");
    assert_eq!(report.problems(), []);
    assert!(report.holds());
    let counts = report.tables.iter().map(|table| (table.name, table.counts())).collect::<Vec<_>>();
    let expected = |agree, within_bound, misprints, given| Counts { agree, within_bound, misprints, given, unaccounted: 0 };
    // README.md, "What is reproduced".
    assert_eq!(counts[0], ("Table 1", expected(64, 17, 0, 81)));
    assert_eq!(counts[1], ("Table 2", expected(36, 2, 1, 13)));
    assert_eq!(counts[2], ("Table 3", expected(6, 0, 0, 9)));
    assert_eq!(counts[3], ("Table 4", expected(3, 0, 0, 6)));
    assert_eq!(counts[4], ("Table 5", expected(12, 5, 1, 0)));
    assert_eq!(counts[5], ("Table 6", expected(8, 8, 2, 0)));
    assert_eq!(counts[6], ("Table B1", expected(51, 20, 1, 15)));
    assert_eq!(counts[7], ("Table B2", expected(74, 24, 0, 6)));
    assert_eq!(report.counts().total(), 465);
    // README.md, "What the mechanics computes".
    let derived = report.tables.iter().map(|table| (table.cells.len() - table.derived, table.derived)).collect::<Vec<_>>();
    assert_eq!(derived, [(81, 0), (36, 3), (0, 6), (0, 3), (0, 18), (0, 18), (30, 42), (20, 78)]);
    assert_eq!((report.cells().count() - report.derived(), report.derived()), (167, 168));
    assert!(report.summary().ends_with("all accounted for") && !report.summary().contains("NOT"));
}

#[test]
fn no_bound_is_wider_than_it_must_be() {
    let report = run().expect("embedded");
    for (bound, used) in report.bounds.iter().zip(report.bounds_used()) {
        let used = used.expect("needed");
        assert!(used <= 1.0 && used * LARGEST_SLACK >= 1.0, "{bound:?} {used}");
    }
}

#[test]
fn a_nudged_cell_is_found() {
    // Table 1, first row, W_n, by 0.2 ft lb; Table 2, μ₀ at 5°, by 0.001; Table B1, T_Ln of test 3, by 10 ft lb.
    for (which, from, to) in [(0, "-30097.2", "-30097.4"), (1, ",0.542,", ",0.543,"), (2, "0.00,,,,69216.10", "0.00,,,,69206.10")] {
        let problems = problems(|texts| swap([&mut texts.table_1, &mut texts.table_2, &mut texts.table_b1][which], from, to));
        assert!(problems.iter().any(|p| matches!(p, Problem::Cell(Cell { verdict: Verdict::Disagrees { .. }, .. }))), "{problems:?}");
    }
}

#[test]
fn a_corrected_misprint_is_stale() {
    let problems = problems(|texts| swap(&mut texts.table_2, "-21631.2", "-21639.2"));
    assert!(problems.iter().any(|problem| matches!(problem, Problem::StaleMisprint(_))), "{problems:?}");
}

#[test]
fn a_misprint_that_agrees_is_found() {
    // Table 1, first row, μ₀ = 0.661, listed as a misprint.
    let line = "Table 1,A -40 40 0.00,mu_0,0.661,0.666,made up\n";
    let problems = problems(|texts| add(&mut texts.misprints, line));
    assert!(problems.iter().any(|p| matches!(p, Problem::Cell(Cell { verdict: Verdict::MisprintAgrees, .. }))), "{problems:?}");
}

#[test]
fn a_correction_that_disagrees_is_found() {
    let problems = problems(|texts| swap(&mut texts.misprints, "43197.30,", "44197.30,"));
    assert!(problems.iter().any(|p| matches!(p, Problem::Cell(Cell { verdict: Verdict::CorrectionDisagrees { .. }, .. }))), "{problems:?}");
}

#[test]
fn a_misprint_of_no_cell_is_stale() {
    for line in ["Table 1,D -40 40 0.00,mu_0,0.661,0.666,no such row\n", "Table 9,0,mu_0,0.661,0.666,no such table\n"] {
        let problems = problems(|texts| add(&mut texts.misprints, line));
        assert!(matches!(&problems[..], [Problem::StaleMisprint(_)]), "{problems:?}");
    }
}

#[test]
fn a_misprint_that_is_not_listed_disagrees() {
    let problems = problems(|texts| drop_line(&mut texts.misprints, "43197.30"));
    assert!(matches!(&problems[..], [Problem::Cell(cell)] if cell.printed.text() == "49197.30"), "{problems:?}");
}

#[test]
fn a_bound_that_nothing_needs_is_found() {
    for line in [
        "Table 1,A,W_n,0.06,absolute,every cell of position A agrees\n",
        "Table 9,*,W_n,0.06,absolute,no such table\n",
        "Table 1,B,W_n,1.1,absolute,there is one already\n",
    ] {
        let problems = problems(|texts| add(&mut texts.bounds, line));
        assert!(matches!(&problems[..], [Problem::UnusedBound(_)]), "{problems:?}");
    }
}

#[test]
fn a_wide_bound_is_found() {
    let problems = problems(|texts| swap(&mut texts.bounds, "W_n,1.1,", "W_n,2,"));
    assert!(matches!(&problems[..], [Problem::LooseBound { used, .. }] if (used - 0.53).abs() < 0.01), "{problems:?}");
}

#[test]
fn a_narrow_bound_is_found() {
    let problems = problems(|texts| swap(&mut texts.bounds, "W_n,1.1,", "W_n,1.0,"));
    assert!(problems.iter().any(|problem| matches!(problem, Problem::Cell(_))), "{problems:?}");
}

#[test]
fn a_dropped_row_is_missed() {
    let problems = problems(|texts| drop_line(&mut texts.table_1, "-40,20,0.30,0.142,-41286.4"));
    assert!(problems.contains(&Problem::CellCount { table: "Table 1", expected: 81, found: 78 }), "{problems:?}");
}

#[test]
fn a_row_in_place_of_another_is_missed() {
    let problems = problems(|texts| {
        drop_line(&mut texts.table_2, "-1,0.686");
        add(&mut texts.table_2, "\n0,0.661,-30097.2,-19883.6\n");
    });
    assert!(problems.iter().any(|problem| matches!(problem, Problem::Repeated { .. })), "{problems:?}");
}

#[test]
fn a_report_of_nothing_does_not_hold() {
    let nothing = Report {
        tables: vec![],
        statements: vec![],
        bounds: vec![],
        misprints: vec![],
        chain: vec![],
        figures: vec![],
        measured: Measured { small_overlap: vec![], frontal: vec![], worked: vec![] },
    };
    assert!(!nothing.holds());
    // Eight tables, the statements, the chain, the figures, both kinds of measured tests, the worked examples.
    assert_eq!(nothing.problems().len(), 8 + 1 + 1 + 1 + 3);
    assert!(nothing.summary().contains("NOT"));
    let mut report = run().expect("embedded");
    report.statements.pop();
    assert!(matches!(report.problems()[..], [Problem::StatementCount { expected: 37, found: 36 }]));
}

#[test]
fn malformed_texts_are_errors() {
    let cases: [fn(&mut Texts<'static>); 6] = [
        |texts| texts.table_1 = "",
        |texts| texts.table_2 = "gamma_deg,mu0,Wn_ftlb,Wt_ftlb\n",
        |texts| add(&mut texts.table_b1, "4,1\n"),
        |texts| texts.geometry = "",
        |texts| texts.misprints = "",
        |texts| swap(&mut texts.table_2, "-30097.2", "-30,097.2"),
    ];
    for (which, case) in cases.into_iter().enumerate() {
        assert!(run_altered(case).is_err(), "case {which}");
    }
}

#[test]
fn another_geometry_does_not_hold() {
    // geometry.csv's inertia of vehicle 1, changed by 0.02 %.
    assert!(!report(|texts| swap(&mut texts.geometry, "1434.9", "1435.2")).holds());
}
