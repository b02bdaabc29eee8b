use super::*;
use approx::assert_relative_eq;

#[test]
fn a_window_cuts_the_straight_line_between_samples() {
    // F = 2 t exactly, sampled unevenly: from 0.5 to 2.5 the integral is 6.25 − 0.25.
    let record = Record::at_times(alloc::vec![0.0, 1.0, 3.0], alloc::vec![0.0, 2.0, 6.0]).expect("a good record");
    assert_relative_eq!(record.impulse_over(&Window { from: 0.5, to: 2.5 }).expect("inside"), 6.0);
    // Both ends between the same two samples.
    assert_relative_eq!(record.impulse_over(&Window { from: 1.5, to: 2.5 }).expect("inside"), 4.0);
    assert_eq!(record.impulse_over(&Window { from: 0.0, to: 3.0 }).expect("inside"), record.integral());
    assert_eq!(record.running_integral(), [0.0, 1.0, 9.0]);
}

#[test]
fn the_baseline_is_the_mean_before_the_event() {
    let record = Record::uniform(-2.0, 1.0, alloc::vec![1.0, 3.0, 2.0, 12.0, 2.0]).expect("a good record");
    let before = Window { from: -2.0, to: -1.0 };
    let baseline = record.baseline(&before).expect("two samples");
    assert_eq!((baseline.value, baseline.variance), (2.0, 2.0));
    assert_eq!(record.corrected(&before).expect("two samples").values(), [-1.0, 1.0, 0.0, 10.0, 0.0]);
    let impulse = record.impulse(&Window { from: 0.0, to: 2.0 }, &before).expect("inside");
    assert_eq!(impulse.value, 10.0);
    // Weights ½, 1, ½ in the window and −2/2 on each sample of the baseline, of variance 2.
    assert_eq!(impulse.variance, 2.0 * (0.25 + 1.0 + 0.25 + 2.0));
}

#[test]
fn where_baseline_and_window_overlap_the_weights_are_one() {
    // Over the whole record with the whole record as baseline, the mean remains: the ends have half weight.
    let record = Record::uniform(0.0, 1.0, alloc::vec![1.0, 2.0, 6.0]).expect("a good record");
    let all = Window { from: 0.0, to: 2.0 };
    let impulse = record.impulse(&all, &all).expect("inside");
    assert_relative_eq!(impulse.value, 5.5 - 6.0, max_relative = 1e-14);
    assert_relative_eq!(impulse.variance, 7.0 * (1.0 / 36.0 + 1.0 / 9.0 + 1.0 / 36.0), max_relative = 1e-14);
}

#[test]
fn every_bad_number_of_a_record_is_named() {
    let issues = Record::uniform(f64::NAN, 0.0, alloc::vec![f64::INFINITY]).expect_err("four issues");
    assert_eq!(issues.len(), 4);
    let issues = Record::at_times(alloc::vec![0.0, 1.0, 1.0, 0.5], alloc::vec![0.0; 3]).expect_err("three issues");
    assert_eq!(issues.len(), 3);
    assert_eq!(issues.as_slice()[1], InputIssue::out_of_order(Place::of("time", Measure::Time).at(2), 1.0, 1.0).into());
    let nan = Record::at_times(alloc::vec![0.0, f64::NAN], alloc::vec![0.0; 2]).expect_err("one problem");
    assert_eq!(nan.len(), 1);
    let record = Record::uniform(0.0, 1.0, alloc::vec![0.0; 3]).expect("a good record");
    for (from, to) in [(-1.0, 1.0), (0.0, 3.0), (1.0, 1.0), (2.0, 1.0), (f64::NAN, 1.0)] {
        assert!(record.impulse_over(&Window { from, to }).is_err(), "{from} to {to}");
    }
    assert!(record.baseline(&Window { from: 0.1, to: 1.9 }).is_err());
}
