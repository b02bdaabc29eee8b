//! The measured tests with altered data.

use super::*;

fn of(problems: &[Problem]) -> Vec<&MeasuredProblem> {
    problems.iter().filter_map(|problem| if let Problem::Measured(problem) = problem { Some(problem) } else { None }).collect()
}

#[test]
fn the_tests_are_there_with_their_errors() {
    let measured = run().expect("embedded").measured;
    let names: Vec<_> = measured.small_overlap.iter().map(|test| test.test.as_str()).collect();
    assert!(["CF10023", "CF10020", "CEN1212"].iter().all(|test| names.contains(test)), "{names:?}");
    assert!(measured.frontal.iter().any(|test| test.test == "6268"));
    // No error is hidden: no test agrees to its digits, and every recorded error is the actual one.
    for (test, reading) in measured.readings() {
        assert!(!reading.is_within_digits(), "{test}");
        let recorded = reading.recorded.as_ref().expect("recorded");
        assert!(recorded.agrees_with(reading.percent()), "{test} {} {}", reading.quantity, reading.percent());
    }
}

#[test]
fn an_error_that_is_not_the_recorded_one_is_found() {
    // The measured ΔV of CF10020, altered to be farther from the computed one.
    let found = problems(|texts| swap(&mut texts.iihs, ",49.9,", ",50.9,"));
    assert!(
        matches!(of(&found)[..], [MeasuredProblem::NotAsRecorded { test, reading }] if test == "CF10020" && reading.quantity == "delta-V"),
        "{found:?}"
    );
    // Another mass causes another yaw rate.
    let found = problems(|texts| replace(&mut texts.iihs, "CEN1212,3574.2,", "CEN1212,3674.2,"));
    assert!(
        of(&found).iter().any(|problem| matches!(problem, MeasuredProblem::NotAsRecorded { test, .. } if test == "CEN1212")),
        "{found:?}"
    );
    // The opposite sign, with the same magnitude.
    assert_eq!(of(&problems(|texts| swap(&mut texts.iihs, ",-5.84,", ",5.84,"))).len(), 1);
    // An energy that is better than recorded must be recorded.
    let said = |recorded: &str| {
        let found = problems(|texts| swap(&mut texts.nhtsa, ",1.60,", recorded));
        assert!(matches!(of(&found)[..], [MeasuredProblem::NotAsRecorded { test, .. }] if test == "6268"), "{found:?}");
        of(&found)[0].to_string()
    };
    assert!(said(",1.70,").contains("record the new error") && !said(",1.50,").contains("record the new error"));
    // To the digits recorded: 1.6 is 1.60 to within half a unit.
    assert!(report(|texts| swap(&mut texts.nhtsa, ",1.60,", ",1.6,")).holds());
}

#[test]
fn the_wrong_direction_of_rotation_is_found() {
    // The impact center and the crush plane of CF10020 on the other side.
    let found = problems(|texts| swap(&mut texts.iihs, ",37.5,77.6,", ",-37.5,-77.6,"));
    assert!(of(&found).iter().any(|problem| matches!(problem, MeasuredProblem::Turn { test } if test == "CF10020")), "{found:?}");
    // With the plane turned the wrong way, the car does not meet it, or gets another yaw rate.
    let found = run_altered(|texts| swap(&mut texts.iihs, ",37.5,77.6,", ",37.5,-77.6,"));
    assert!(found.is_err() || !found.expect("computed").holds());
}

#[test]
fn a_test_is_one_line() {
    // Invented: CF10020 at another speed. ΔV and yaw rate are proportional to it; no error is recorded yet.
    let report = report(|texts| add(&mut texts.iihs, "MADE-UP,3574.2,2336.3,0,0.959,3.8,37.5,77.6,29.30,24.9,96.2,,,\n"));
    assert!(report.holds(), "{:?}", report.problems());
    let test = report.measured.small_overlap.last().expect("four");
    assert!((test.delta_v.computed - 46.986 / 2.0).abs() < 1e-3 && test.delta_v.recorded.is_none());
    let more = "1,made up,1500,15,1.5,0.4 0.4,2,,,,,\n";
    assert!(super::report(|texts| add(&mut texts.nhtsa, more)).holds());
    // The same test twice is an error.
    let twice = problems(|texts| add(&mut texts.nhtsa, &more.replacen('1', "6268", 1)));
    assert!(matches!(of(&twice)[..], [MeasuredProblem::Repeated { test }] if test == "6268"), "{twice:?}");
}

#[test]
fn a_published_coefficient_that_is_another_is_found() {
    let found = problems(|texts| swap(&mut texts.nhtsa, ",1071581,", ",1071591,"));
    assert!(matches!(of(&found)[..], [MeasuredProblem::Coefficient { coefficient, .. }] if coefficient.name == "B"), "{found:?}");
}

#[test]
fn data_that_cannot_be_computed_is_an_error() {
    let cases: [fn(&mut Texts<'static>); 6] = [
        |texts| texts.iihs = "",
        |texts| texts.nhtsa = "",
        |texts| swap(&mut texts.iihs, "CF10020,3574.2,", "CF10020,0,"),
        |texts| swap(&mut texts.iihs, ",0.959,", ",1.2,"),
        |texts| swap(&mut texts.iihs, ",0.103,", ",fast,"),
        |texts| swap(&mut texts.nhtsa, "0.265 0.474 0.504 0.505 0.475 0.310", "0.265"),
    ];
    for (which, case) in cases.into_iter().enumerate() {
        assert!(run_altered(case).is_err(), "case {which}");
    }
}

#[test]
fn root_mean_squares_are_over_the_tests() {
    let tests = run().expect("embedded").measured.small_overlap;
    let [delta_v, yaw_rate] = SmallOverlap::root_mean_squares(&tests);
    // The errors of README.md: in percent 4.24, -5.84, -0.44 and -25.59, 0.84, -1.37; in ft/s 2.07, -2.91, -0.23.
    let of = |a: f64, b: f64, c: f64| ((a * a + b * b + c * c) / 3.0).sqrt();
    assert!((delta_v.percent - of(4.24, 5.84, 0.44)).abs() < 0.01 && (yaw_rate.percent - of(25.59, 0.84, 1.37)).abs() < 0.01);
    assert!((delta_v.error - of(2.07, 2.91, 0.23)).abs() < 0.01, "{delta_v:?}");
    // By the other law CEN1212 is off by 7.94 and 12.06 %.
    let [delta_v, yaw_rate] = SmallOverlap::kudlich_slibar_root_mean_squares(&tests);
    assert!((delta_v.percent - of(4.24, 5.84, 7.94)).abs() < 0.01 && (yaw_rate.percent - of(25.59, 0.84, 12.06)).abs() < 0.01);
}

#[test]
fn worked_examples_come_out_to_their_digits_and_staged_ones_with_their_error() {
    let measured = run().expect("embedded").measured;
    let names: Vec<&str> = measured.worked.iter().map(|worked| worked.example.as_str()).collect();
    assert_eq!(names, ["intersection", "intersection", "locked", "pushed", "GBB", "GBB"]);
    assert!(measured.worked.iter().all(|worked| worked.holds() && worked.reading.recorded.is_some() == (worked.example == "GBB")));
    for (from, to, example) in [(",25.0,,", ",25.1,,", "intersection"), (",20.4,,", ",20.5,,", "locked"), (",0.40,", ",0.41,", "pushed")] {
        let found = problems(|texts| swap(&mut texts.worked, from, to));
        assert!(matches!(of(&found)[..], [MeasuredProblem::Worked { example: found, .. }] if found == example), "{found:?}");
        assert!(found[0].to_string().contains("published was"), "{found:?}");
    }
    let found = problems(|texts| swap(&mut texts.worked, ",3.1,-4.7,", ",3.1,4.7,"));
    assert!(matches!(of(&found)[..], [MeasuredProblem::NotAsRecorded { test, .. }] if test == "GBB"), "{found:?}");
    assert!(
        run_altered(|texts| swap(
            &mut texts.worked,
            ",3.1,-4.7,\"staged rear-end collision: the measured changes of momentum differ by 8.5 %\"",
            ",3.1,-4.7,"
        ))
        .is_err()
    );
}
