//! Tables 3 to 6 and B2, and the chain of misprints, with altered data.

use super::*;

fn disagrees(problems: &[Problem], table: &str, row: &str, column: &str) -> bool {
    problems.iter().any(|problem| {
        matches!(problem, Problem::Cell(cell) if cell.table == table && cell.row == row && cell.column == column && !cell.verdict.is_accounted_for())
    })
}

#[test]
fn a_nudged_cell_of_every_table_is_found() {
    type Text = for<'a> fn(&'a mut Texts<'static>) -> &'a mut &'static str;
    // Altered by one unit of the last digit; energies by more than their bound.
    let cases: [(Text, &str, &str, &str, &str, &str); 10] = [
        (|t| &mut t.table_3, ",7208,", ",7209,", "Table 3", "1", "normal"),
        (|t| &mut t.table_3, ",0.283", ",0.284", "Table 3", "2", "ratio"),
        (|t| &mut t.table_4, ",0.12", ",0.13", "Table 4", "3", "mean"),
        (|t| &mut t.table_5, ",145048,39.2", ",145048,39.3", "Table 5", "3", "planar_dv"),
        (|t| &mut t.table_5, "1,13674,", "1,13675,", "Table 5", "1", "test_energy"),
        (|t| &mut t.table_6, ",63.1", ",63.2", "Table 6", "3", "planar_dv"),
        (|t| &mut t.table_6, ",170.0,", ",170.1,", "Table 6", "3", "test_energy"),
        (|t| &mut t.table_b2, ",51.3,", ",51.4,", "Table B2", "3 0.00", "planar_dv_ftps"),
        (|t| &mut t.table_b2, ",1758,", ",1759,", "Table B2", "1 0.18", "planar_T_Lt"),
        (|t| &mut t.table_b2, ",34.5,23.6", ",34.5,23.7", "Table B2", "2 0.13", "planar_dv_mph"),
    ];
    for (text, from, to, table, row, column) in cases {
        let problems = problems(|texts| swap(text(texts), from, to));
        assert!(disagrees(&problems, table, row, column), "{to}: {problems:?}");
    }
}

#[test]
fn a_measured_cell_moves_what_follows_from_it() {
    // Table 3's wing impulse of test 1, Table 4's kinematics of test 1, Table B2's depth of test 3, Table B1's speed of test 1.
    let wing = problems(|texts| swap(&mut texts.table_3, ",1720,", ",1820,"));
    assert!(disagrees(&wing, "Table 3", "1", "ratio") && disagrees(&wing, "Table B1", "1 0.18", "test_mu"), "{wing:?}");
    let restitution = problems(|texts| swap(&mut texts.table_4, "1,0.111,", "1,0.131,"));
    assert!(disagrees(&restitution, "Table 4", "1", "mean") && disagrees(&restitution, "Table B2", "1 0.18", "e"), "{restitution:?}");
    let depth = problems(|texts| swap(&mut texts.table_b2, ",1.0768,", ",1.0868,"));
    assert!(disagrees(&depth, "Table B2", "3 0.00", "crash3_T_Ln") && disagrees(&depth, "Table 6", "3", "planar_dv"), "{depth:?}");
    let speed = problems(|texts| replace(&mut texts.table_b1, "1,19.23,", "1,19.33,"));
    assert!(disagrees(&speed, "Table 5", "3", "test_energy") && disagrees(&speed, "Table B2", "2 0.13", "test_E_C"), "{speed:?}");
}

#[test]
fn a_cell_that_is_left_out_is_missed() {
    let problems = problems(|texts| swap(&mut texts.table_b2, ",144759,", ",,"));
    assert!(problems.contains(&Problem::CellCount { table: "Table B2", expected: 98, found: 97 }), "{problems:?}");
    let problems = super::problems(|texts| swap(&mut texts.table_b1, ",0.283,", ",,"));
    assert!(problems.contains(&Problem::CellCount { table: "Table B1", expected: 72, found: 71 }), "{problems:?}");
}

#[test]
fn a_given_cell_that_is_left_out_is_missed() {
    // One row of Table 1 less: both its given and its computed cells are missing.
    let problems = problems(|texts| drop_line(&mut texts.table_1, "-40,20,0.30,0.142,-41286.4"));
    assert!(problems.contains(&Problem::GivenCount { table: "Table 1", expected: 81, found: 78 }), "{problems:?}");
}

#[test]
fn a_cell_that_nothing_looks_at_is_missed() {
    // One more column in Table 4.
    let problems = problems(|texts| {
        swap(&mut texts.table_4, ",average", ",average,guess");
        for mean in ["0.18", "0.13", "0.12"] {
            swap(&mut texts.table_4, &format!(",{mean}\n"), &format!(",{mean},0.1\n"));
        }
    });
    assert_eq!(problems, [Problem::LeftOut { table: "Table 4", printed: 12, accounted: 9 }]);
}

#[test]
fn rows_that_fit_no_test_are_refused() {
    let refused = |alter: fn(&mut Texts<'static>)| run_altered(alter).err();
    let file =
        |error: Option<DataError>| if let Some(DataError::UnknownWord { file, column, .. }) = error { (file, column) } else { ("", "") };
    assert_eq!(file(refused(|t| replace(&mut t.table_5, "\n3,", "\n4,"))), ("table5.csv", "test"));
    assert_eq!(file(refused(|t| replace(&mut t.table_6, "\n3,", "\n4,"))), ("table6.csv", "test"));
    assert_eq!(file(refused(|t| replace(&mut t.table_b2, ",0.18,", ",0.19,"))), ("tableB2.csv", "e"));
    assert!(refused(|t| swap(&mut t.table_3, ",3999,", ",much,")).is_some());
}

#[test]
fn other_crush_coefficients_do_not_hold() {
    // geometry.csv's width, onset and slope, each altered by half a percent.
    for (from, to) in [("width,5,", "width,5.025,"), ("onset,48.27,", "onset,48.51,"), ("slope,162.8,", "slope,163.6,")] {
        let problems = problems(|texts| swap(&mut texts.geometry, from, to));
        assert!(disagrees(&problems, "Table B2", "3 0.00", "crash3_T_Ln") || disagrees(&problems, "Table B2", "1 0.00", "test_E*"), "{to}");
    }
}

#[test]
fn the_chain_is_as_told() {
    let links = run().expect("embedded").chain;
    let told: Vec<_> = links.iter().map(|link| (link.printed.as_str(), link.holds.as_str(), link.follows)).collect();
    assert_eq!(told, [("51334", "51334", true), ("61334", "51334", true), ("83.3", "69.6", true)]);
}

#[test]
fn a_number_that_does_not_follow_breaks_the_chain() {
    let broken = |alter: fn(&mut Texts<'static>)| -> Vec<&'static str> {
        problems(alter).iter().filter_map(|problem| if let Problem::Chain(link) = problem { Some(link.place) } else { None }).collect()
    };
    let [sum, digit, conversion] =
        ["Table B2, test 2, planar T_L, ft lb", "Table 5, test 2, planar crush energy, ft lb", "Table 6, test 2, planar crush energy, kJ"];
    assert_eq!(broken(|t| swap(&mut t.table_b2, ",7120,", ",7140,")), [sum]);
    assert_eq!(broken(|t| swap(&mut t.table_5, "61334", "51334")), [digit, conversion]);
    // If the other tests do not repeat Table B2, the difference for this one proves nothing.
    assert_eq!(broken(|t| swap(&mut t.table_5, ",12504,", ",12514,")), [digit]);
    assert_eq!(broken(|t| swap(&mut t.table_5, ",145048,", ",145049,")), [digit]);
    assert_eq!(broken(|t| swap(&mut t.table_6, "83.3", "84.3")), [conversion]);
    assert_eq!(broken(|t| swap(&mut t.table_6, "83.3", "69.7")), [conversion]);
}

#[test]
fn a_corrected_misprint_of_the_chain_is_stale() {
    let problems = problems(|texts| swap(&mut texts.table_6, ",83.3,", ",69.7,"));
    assert!(
        problems.iter().any(|problem| matches!(problem, Problem::StaleMisprint(m) if m.table == "Table 6" && m.row == "2")),
        "{problems:?}"
    );
}

/// Returns the names of statements whose standing is no longer the known one.
fn fallen(alter: impl FnOnce(&mut Texts<'static>)) -> Vec<&'static str> {
    problems(alter)
        .iter()
        .filter_map(|problem| if let Problem::Statement(statement) = problem { Some(statement.name) } else { None })
        .collect()
}

/// An alteration of the texts.
type Altered = fn(&mut Texts<'static>);

#[test]
fn statements_about_energies_and_units_can_fall() {
    let cases: [(Altered, &str); 7] = [
        // The speeds and the energies of test 1 in Table 5, altered separately.
        (|t| swap(&mut t.table_5, "11550,9.9,", "11550,9.8,"), "test 1 in the text"),
        (|t| swap(&mut t.table_5, ",11550,", ",11450,"), "test 1 in the text"),
        (|t| swap(&mut t.table_6, ",63.1", ",62.9"), "Table 6 converts rounded speeds"),
        // E_C of test 2 in Table B2, misprinted as T_Ln is in Table B1.
        (|t| swap(&mut t.table_b2, ",56876,", ",62876,"), "crush energies add up from test to test"),
        // T_Lt of CRASH3, increased by one foot-pound.
        (|t| swap(&mut t.table_b2, ",3309,", ",3310,"), "CRASH3's correction takes a rounded angle"),
        (|t| swap(&mut t.table_b2, ",144759,", ",144760,"), "rounding explains the bounds of Table B2"),
        (
            |t| swap(&mut t.table_b1, "3,42.56,36.8580,21.2800,92297.52,0.12", "3,42.66,36.8580,21.2800,92297.52,0.12"),
            "speeds of the crabbed tests",
        ),
    ];
    for (alter, name) in cases {
        let fallen = fallen(alter);
        assert!(fallen.contains(&name), "{name}: {fallen:?}");
    }
}

#[test]
fn the_load_cells_miss_what_is_said() {
    let report = run().expect("embedded");
    let statement = report.statements.iter().find(|statement| statement.name == "the load cells measure the whole impulse").expect("there");
    // Table 3 and ΔV of Table B1, with 101.91 slug of 14.59390 kg; 1 mph is 0.44704 m/s, 1 ft is 0.3048 m.
    let mass = 101.91 * 14.593_90;
    let whole = [(7208.0, 1720.0, 13.7), (10089.0, 2857.0, 24.0), (11714.0, 6262.0, 29.8)]
        .map(|(normal, wing, mph): (f64, f64, f64)| format!("{:.2}", normal.hypot(wing) / (mass * mph * 0.447_04)));
    let normal =
        [(7208.0, 16.6537), (10089.0, 29.3669), (11714.0, 36.8580)].map(|(normal, v)| format!("{:.2}", normal / (mass * v * 0.3048)));
    for [a, b, c] in [whole, normal] {
        assert!(statement.found.contains(&format!("{a}, {b} and {c}")), "{a} {b} {c}: {}", statement.found);
    }
}

#[test]
fn a_figure_that_is_missing_is_found() {
    for which in 0..2 {
        let mut report = run().expect("embedded");
        report.figures.remove(which);
        assert_eq!(report.problems(), [Problem::Figures]);
    }
}
