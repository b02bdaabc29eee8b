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

/// Returns how much wider a variance is, given the quantile of Student's distribution at 97.5 %.
fn student(quantile: f64) -> f64 {
    (quantile / 1.959_964).powi(2)
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
    // Weights ½, 1, ½ in the window and −2/2 on each sample of the baseline, of variance 2; and the slope changes by 11 and by −20 within the window,
    // which is to and fro beyond twice that variance.
    let of_sampling = (121.0 + 400.0) / 144.0 + 220.0 / 4.0 - 2.0 * 2.0;
    assert_relative_eq!(impulse.variance, 2.0 * (0.25 + 1.0 + 0.25 + 2.0) * student(12.706_205) + of_sampling, max_relative = 1e-3);
}

#[test]
fn a_sample_on_the_edge_of_a_window_is_in_it_however_its_time_is_rounded() {
    // 10 kHz from a whole number of milliseconds: −0.1 ms is a sum that is rounded, and a number of the file.
    for start in -9..0 {
        let samples = (20 - 10 * start) as usize;
        let values = (0..samples).map(|i| if i as i32 == -10 * start - 1 { 300.0 } else { 0.0 }).collect();
        let record: Record = Record::uniform(1e-3 * f64::from(start), 1e-4, values).expect("a good record");
        let count = f64::from(-10 * start);
        let baseline = record.baseline(&Window { from: 1e-3 * f64::from(start), to: -1e-4 }).expect("samples");
        assert_relative_eq!(baseline.value, 300.0 / count, max_relative = 1e-12);
        // Two samples, both on its edges; and a little less, none.
        assert_eq!(record.baseline(&Window { from: -2e-4, to: -1e-4 }).expect("two samples").value, 150.0);
        assert!(record.baseline(&Window { from: -1.999e-4, to: -1.001e-4 }).is_err());
        // The last sample: at 1.9 ms.
        let smoothed = crate::barrier::Lowess { neighbors: 8, robust_passes: 0 }.smooth(&record).expect("wide enough");
        for time in [1e-3 * f64::from(start), 1.9e-3] {
            assert!(smoothed.at(time).is_ok(), "{start} {time}");
        }
        assert!(smoothed.at(1.901e-3).is_err());
    }
}

#[test]
fn where_baseline_and_window_overlap_the_weights_are_one() {
    // Over the whole record with the whole record as baseline, the mean remains: the ends have half weight.
    let record = Record::uniform(0.0, 1.0, alloc::vec![1.0, 2.0, 6.0]).expect("a good record");
    let all = Window { from: 0.0, to: 2.0 };
    let impulse = record.impulse(&all, &all).expect("inside");
    assert_relative_eq!(impulse.value, 5.5 - 6.0, max_relative = 1e-14);
    // Its slope changes by 3.
    let of_noise = 7.0 * (1.0 / 36.0 + 1.0 / 9.0 + 1.0 / 36.0) * student(4.302_653);
    assert_relative_eq!(impulse.variance, of_noise + 9.0 / 144.0, max_relative = 5e-3);
}

/// A half-sine without noise, from −4 steps: its ends are kinks, a share of a step after a sample.
fn half_sine(samples: usize, share: f64) -> (Record, f64) {
    let force = |time: f64| (core::f64::consts::PI * (time - share) / samples as f64).sin();
    let value = |i: usize| if i as f64 - 4.0 < share || i as f64 - 4.0 > share + samples as f64 { 0.0 } else { force(i as f64 - 4.0) };
    let record = Record::uniform(-4.0, 1.0, (0..samples + 8).map(value).collect()).expect("a good record");
    (record, 2.0 * samples as f64 / core::f64::consts::PI)
}

#[test]
fn coarse_sampling_is_in_the_deviation() {
    // Of four steps, the bends next to the ends are to and fro.
    for (samples, errors) in [(4, 0.7..1.1), (10, 1.1..1.5), (33, 1.1..1.5), (100, 1.1..1.5)] {
        let mut worst: f64 = 0.0;
        for share in [0.0, 0.1, 0.25, 0.5, 0.7, 0.95] {
            let (record, exact) = half_sine(samples, share);
            let before = Window { from: -4.0, to: -1.0 };
            let window = Window { from: 0.0, to: samples as f64 + 3.0 };
            let impulse = record.impulse(&window, &before).expect("inside");
            worst = worst.max((impulse.value - exact).abs() / impulse.deviation());
            // The window may end with the pulse, on its last sample.
            let ends = record.impulse(&Window { from: 0.0, to: samples as f64 + share.ceil() }, &before).expect("inside");
            assert_relative_eq!(ends.variance, impulse.variance, max_relative = 1e-12);
        }
        // Two kinks on samples err in the same direction.
        assert!(errors.contains(&worst), "{samples}: {worst}");
    }
    let (coarse, exact) = half_sine(10, 0.0);
    let impulse = coarse.impulse(&Window { from: 0.0, to: 10.0 }, &Window { from: -4.0, to: -1.0 }).expect("inside");
    assert_relative_eq!(impulse.deviation() / exact, 0.0064, max_relative = 0.02);
    // Uneven steps, the longer of which counts: bends of 2, −6 and 2, whose steps are 1, 3/2 and 3/2: the peak alternates with both of its neighbors.
    let uneven =
        Record::at_times(alloc::vec![-2.0, -1.0, 0.0, 1.0, 3.0, 4.0], alloc::vec![0.0, 0.0, 0.0, 2.0, 0.0, 0.0]).expect("a good record");
    let impulse = uneven.impulse(&Window { from: 0.0, to: 4.0 }, &Window { from: -2.0, to: -1.0 }).expect("inside");
    assert_relative_eq!(impulse.variance, (4.0 + 16.0 * 9.0 + 16.0) / 144.0 + 3.0 * 1.5 + 3.0 * 2.25, max_relative = 1e-14);
}

#[test]
fn sampling_adds_little_to_noise_even_where_it_alternates() {
    // In the second, neighbors alike outweigh the others by one pair, so that it has 120/3 − 1 degrees of freedom.
    for (noise, quantile) in [([1.0, -1.0].as_slice(), 1.980_100), (&[1.0, 1.0, -1.0, -1.0], 2.022_691), (&[2.0, -1.0, -1.0], 1.980_100)] {
        let record = Record::uniform(0.0, 1.0, noise.iter().copied().cycle().take(240).collect()).expect("a good record");
        let before = Window { from: 0.0, to: 119.0 };
        let over = Window { from: 120.0, to: 239.0 };
        let (all, baseline) = (record.impulse(&over, &before).expect("inside"), record.baseline(&before).expect("samples"));
        let white = baseline.variance * (119.0 + 119.0 * 119.0 / 120.0);
        assert!(all.variance < 1.06 * student(quantile) * white, "{noise:?}: {} {white}", all.variance);
    }
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
