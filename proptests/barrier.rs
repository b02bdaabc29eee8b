//! Barrier tests: the stiffness fitted to them, the validity of its covariance, and kinematics.

use crate::noise::{Count, Noise, WITHIN_ONE, WITHIN_TWO};
use crate::rational::Rational;
use crate::strategies::{Draw, Fraction, config, draw, fewer};
use num_dual::{Dual2_64, Dual64};
use planar_impact::barrier::*;
use planar_impact::crush::{CrushStiffness, ProfileMoments, speed_of_energy};
use planar_impact::*;
use proptest::prelude::*;
use std::fmt::Debug;

/// Generates several crushes with different mean depths, on several widths.
fn profiles() -> impl Strategy<Value = Vec<(i32, Vec<i32>)>> {
    let profile = (1..=4_i32, proptest::collection::vec(0..=9_i32, 2..=6));
    proptest::collection::vec(profile, 2..=6).prop_filter("two different mean depths", |profiles| {
        let means: Vec<Rational> = profiles.iter().map(|(width, depths)| moments(*width, depths).mean_depth()).collect();
        means.iter().any(|mean| *mean != means[0])
    })
}

fn moments<T: Field>(width: i32, depths: &[i32]) -> ProfileMoments<T> {
    let depths: Vec<T> = depths.iter().map(|&depth| Fraction(depth, 10).of()).collect();
    ProfileMoments::of(T::int(width), &depths).expect("two depths")
}

fn against_a_barrier(draw: Draw) -> Draw {
    Draw { barrier: true, law: Law::Brach, ..draw }
}

fn flat<T: Field>(width: T, depth: T) -> ProfileMoments<T> {
    ProfileMoments::of(width, &[depth.clone(), depth]).expect("two depths")
}

proptest! {
    #![proptest_config(fewer(20))]

    #[test]
    fn exact_data_give_back_the_stiffness(profiles in profiles(), onset in 0..=9_i32, slope in 1..=9_i32, deviations in proptest::collection::vec(1..=5_i32, 6)) {
        let exact = CrushStiffness::<Rational> { onset: Rational::int(onset), slope: Rational::int(slope) };
        let observe = |((width, depths), deviation): (&(i32, Vec<i32>), &i32)| {
            let crush = moments(*width, depths);
            let intensity = exact.crush_intensity(crush.mean_depth());
            Observation { crush, intensity, deviation: Rational::int(*deviation) }
        };
        let observations: Vec<_> = profiles.iter().zip(&deviations).map(observe).collect();
        prop_assume!(observations.iter().all(|o| o.intensity > Rational::int(0)));
        let fit = StiffnessFit::on_mean_depth(&Observations::independent(&observations).expect("good numbers")).expect("two depths");
        prop_assert_eq!(fit.stiffness, exact);
        prop_assert_eq!(fit.chi_square, Rational::int(0));
    }

    /// With profiles as measured: increasing from test to test, and uneven by up to half of their depth.
    #[test]
    fn exact_profiles_give_back_the_stiffness(deeper in proptest::collection::vec((1..=3_i32, -5..=5_i32, -5..=5_i32), 2..=6), onset in 0..=9_i32, slope in 5..=20_i32) {
        let stiffness = CrushStiffness { onset: f64::from(onset), slope: f64::from(slope) };
        let mut depth = 0.0;
        let observe = |(more, left, right): (i32, i32, i32)| {
            depth = 1.5 * depth + f64::from(more) / 10.0;
            let depths = [left, 0, right].map(|uneven| depth * (1.0 + f64::from(uneven) / 10.0));
            let crush = ProfileMoments::of(1.5, &depths).expect("three depths");
            Observation { crush, intensity: (stiffness.crush_energy(crush) / crush.first).sqrt(), deviation: 1.0 }
        };
        let observations: Vec<_> = deeper.into_iter().map(observe).collect();
        prop_assume!(observations.windows(2).all(|pair| pair[0].crush.mean_depth() < 0.9 * pair[1].crush.mean_depth()));
        let fit = StiffnessFit::on_profiles(&Observations::independent(&observations).expect("good numbers")).expect("it settles");
        prop_assert!((fit.stiffness.onset - stiffness.onset).abs() < 1e-9 * stiffness.slope, "{:?}", fit);
        prop_assert!((fit.stiffness.slope - stiffness.slope).abs() < 1e-9 * stiffness.slope, "{:?}", fit);
    }

    /// A single test of a vehicle is fitted exactly: with a given onset, the exact stiffness reproduces the energy of the test.
    #[test]
    fn one_test_has_its_energy((width, depths) in (1..=4_i32, proptest::collection::vec(1..=9_i32, 2..=6)), speed in 2..=30_i32, e in 0..=9_i32, onset in 0..=4_i32) {
        let test = BarrierTest { mass: 1500.0, speed: f64::from(speed), restitution: f64::from(e) / 10.0, crush: moments(width, &depths) };
        let onset = f64::from(onset);
        match test.stiffness(onset) {
            Ok(stiffness) => {
                prop_assert!(stiffness.slope > 0.0 && onset < test.corrected_speed());
                let energy = stiffness.crush_energy(test.crush);
                prop_assert!((energy - test.crush_energy()).abs() <= 1e-12 * energy);
                // A profile holds more energy than its mean depth, so the line through the mean depth is steeper.
                let line = CrushStiffness::from(test.speed_line(onset).expect("the same test"));
                prop_assert!(line.slope >= stiffness.slope * (1.0 - 1e-12));
            }
            Err(problems) => prop_assert!(onset >= test.corrected_speed(), "{}", problems),
        }
    }

    /// With zero duration the vehicle does not turn, and the kinematics of the impact center agree with the mechanics.
    #[test]
    fn kinematics_give_back_the_restitution(draw in draw().prop_map(against_a_barrier).prop_filter("the impulse divides by zero", Draw::is_computable)) {
        let collision = draw.exact();
        let Party::Vehicle(vehicle) = collision.one.clone() else { unreachable!("the first is a vehicle") };
        let contact = collision.contact();
        prop_assume!(contact.approach.n != Rational::int(0));
        let point = |motion| PointOfVehicle { heading: vehicle.heading.clone(), position: vehicle.impact_center.clone(), motion };
        let (before, after) = (point(vehicle.motion.clone()), point(collision.evaluate().one.after));
        prop_assert_eq!(barrier::restitution(&before, &after, &collision.crush_plane), collision.restitution);
    }
}

fn any_number() -> impl Strategy<Value = f64> {
    prop_oneof![proptest::num::f64::ANY, Just(0.0), Just(f64::MAX), Just(f64::MIN_POSITIVE), 0.0..10.0_f64, 0.0..10.0_f64]
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn no_test_panics(numbers in proptest::collection::vec(proptest::collection::vec(any_number(), 9), 0..5), onset in any_number()) {
        let tests: Vec<MeasuredTest> = numbers.iter().map(|n| {
            let crush = ProfileMoments { first: n[3], second: n[4], third: n[5] };
            let test = BarrierTest { mass: n[0], speed: n[1], restitution: n[2] / 10.0, crush };
            MeasuredTest { test, speed_deviation: n[6], restitution_deviation: n[7], scatter: n[8] }
        }).collect();
        for test in &tests {
            if let Ok(stiffness) = test.test.stiffness(onset) {
                prop_assert!(stiffness.onset.is_finite() && stiffness.slope >= 0.0, "{:?}", stiffness);
            }
            let _ = test.test.speed_line(onset);
        }
        let _ = TestSeries::new(tests.iter().map(|measured| measured.test).collect::<Vec<_>>());
        let each: Vec<_> = tests.iter().map(|&measured| [measured]).collect();
        let of_energies: Vec<_> = tests.iter().map(|m| CrushEnergy { crush: m.test.crush, energy: m.test.mass, deviation: m.scatter }).collect();
        for observations in [Observations::of_tests(&[&tests]), Observations::of_tests(&each), Observations::of_energies(&of_energies)].into_iter().flatten() {
            for fit in [StiffnessFit::on_mean_depth(&observations), StiffnessFit::on_profiles(&observations)].into_iter().flatten() {
                prop_assert!(fit.stiffness.onset.is_finite() && fit.covariance.slope.is_finite());
                let _ = (fit.findings(), fit.rescaled(), fit.energy_at(onset, onset));
            }
        }
    }
}

const WIDTH: f64 = 1.5;
const MASS: f64 = 1500.0;
const TRUE: CrushStiffness = CrushStiffness { onset: 90.0, slope: 1000.0 };
const DATA_SETS: usize = 20_000;

/// Counts of d₀, d₁ and E_C at 0.4 m within one and two of their own standard deviations of the truth.
#[derive(Default)]
struct Coverage {
    within_one: [Count; 3],
    within_two: [Count; 3],
}

impl Coverage {
    fn add(&mut self, fit: &StiffnessFit) {
        let energy = TRUE.crush_energy(flat(WIDTH, 0.4));
        let sizes = [(fit.onset(), TRUE.onset), (fit.slope(), TRUE.slope), (fit.energy_at(0.4, WIDTH), energy)];
        for (i, (estimate, truth)) in sizes.into_iter().enumerate() {
            let off = ((estimate.value - truth) / estimate.deviation()).abs();
            self.within_one[i].add(off < 1.0);
            self.within_two[i].add(off < 2.0);
        }
    }

    fn assert(&self, one: f64, two: f64) {
        for (i, what) in ["d0", "d1", "E_C"].into_iter().enumerate() {
            self.within_one[i].assert_rate(what, one);
            self.within_two[i].assert_rate(what, two);
        }
    }
}

#[test]
fn the_covariance_covers_at_its_rate() {
    // Eight tests of eight vehicles with known standard deviations.
    let mut noise = Noise::of_seed(2);
    let (mut given, mut told, mut chi_square) = (Coverage::default(), Coverage::default(), 0.0);
    for _ in 0..DATA_SETS {
        let observations: [Observation; 8] = std::array::from_fn(|i| {
            let (depth, deviation) = (0.05 + 0.07 * i as f64, 2.0 + 0.5 * i as f64);
            let intensity = TRUE.crush_intensity(depth) + deviation * noise.normal();
            Observation { crush: flat(WIDTH, depth), intensity, deviation }
        });
        let fit = StiffnessFit::on_mean_depth(&Observations::independent(&observations).expect("good numbers")).expect("eight depths");
        given.add(&fit);
        // Standard deviations that are all wrong by one factor, which the residuals reveal.
        let wrong = observations.map(|o| Observation { deviation: 7.0 * o.deviation, ..o });
        let fit_of_wrong = StiffnessFit::on_mean_depth(&Observations::independent(&wrong).expect("good numbers")).expect("eight depths");
        told.add(&fit_of_wrong.rescaled().expect("six degrees of freedom"));
        chi_square += fit.chi_square;
    }
    given.assert(WITHIN_ONE, WITHIN_TWO);
    // Student's t of 6 degrees of freedom: sin θ (1 + ½ cos² θ + ⅜ cos⁴ θ) with tan θ = t/√6.
    let student = |t: f64| {
        let square = 6.0 / (6.0 + t * t);
        (1.0 - square).sqrt() * (1.0 + square / 2.0 + 3.0 * square * square / 8.0)
    };
    told.assert(student(1.0), student(2.0));
    let (mean, allowed) = (chi_square / DATA_SETS as f64, 5.0 * (2.0 * 6.0 / DATA_SETS as f64).sqrt());
    assert!((mean - 6.0).abs() < allowed, "χ² is {mean} on average; its mean is 6 ± {allowed}");
}

#[test]
fn the_covariance_of_repeated_tests_covers_at_its_rate() {
    // Two vehicles, each tested three times with measured speed and restitution: the error of the first test affects
    // the energies of all three.
    let (speed_deviation, restitution_deviation) = (0.05, 0.005);
    let mut noise = Noise::of_seed(3);
    let mut coverage = Coverage::default();
    for _ in 0..DATA_SETS {
        let series = [[0.1, 0.3, 0.5], [0.2, 0.4, 0.6]].map(|depths: [f64; 3]| {
            let mut before = 0.0;
            depths.map(|depth| {
                let crush = flat(WIDTH, depth);
                let added = TRUE.crush_energy(crush) - before;
                before += added;
                let restitution: f64 = 0.15;
                let speed = speed_of_energy(added, MASS) / (1.0 - restitution * restitution).sqrt();
                let speed = speed + speed_deviation * noise.normal();
                let restitution = restitution + restitution_deviation * noise.normal();
                let test = BarrierTest { mass: MASS, speed, restitution, crush };
                MeasuredTest { test, speed_deviation, restitution_deviation, scatter: 0.0 }
            })
        });
        coverage.add(&StiffnessFit::on_mean_depth(&Observations::of_tests(&series).expect("good tests")).expect("six depths"));
    }
    coverage.assert(WITHIN_ONE, WITHIN_TWO);
}

/// Fits three inconsistent tests with uneven crush; one speed and one depth are free.
fn uneven<T: Real + Ordered<Mask = bool> + Debug>(speed: T, depth: T) -> StiffnessFit<T> {
    let of = |x: f64| T::from_f64(x).expect("a finite number");
    let test = |speed: T, depths: [T; 3]| {
        let crush = ProfileMoments::of(of(WIDTH), &depths).expect("three depths");
        let test = BarrierTest { mass: of(MASS), speed, restitution: of(0.1), crush };
        MeasuredTest { test, speed_deviation: of(0.1), restitution_deviation: of(0.02), scatter: of(8.0) }
    };
    let first = [test(of(8.0), [of(0.1), of(0.25), of(0.05)]), test(speed, [of(0.3), depth, of(0.2)])];
    let second = [test(of(16.0), [of(0.6), of(0.3), of(0.9)])];
    let observations = Observations::of_tests(&[&first[..], &second[..]]).expect("good tests");
    StiffnessFit::on_profiles(&observations).expect("it settles")
}

#[test]
fn derivatives_of_the_fit_are_difference_quotients() {
    let numbers = |fit: &StiffnessFit| {
        let energy = fit.energy_at(0.4, WIDTH);
        [fit.stiffness.onset, fit.stiffness.slope, energy.value, energy.deviation(), fit.chi_square]
    };
    let at = |speed, depth| numbers(&uneven(speed, depth));
    let (speed, depth, h) = (10.0, 0.5, 1e-5);
    let by_dual = |speed, depth| {
        let fit = uneven::<Dual64>(speed, depth);
        let energy = fit.energy_at(0.4.into(), WIDTH.into());
        [fit.stiffness.onset, fit.stiffness.slope, energy.value, energy.deviation(), fit.chi_square].map(|x| x.eps)
    };
    for (dual, ahead, behind) in [
        (by_dual(Dual64::new(speed, 1.0), depth.into()), at(speed + h, depth), at(speed - h, depth)),
        (by_dual(speed.into(), Dual64::new(depth, 1.0)), at(speed, depth + h), at(speed, depth - h)),
    ] {
        for i in 0..5 {
            let quotient = (ahead[i] - behind[i]) / (2.0 * h);
            assert!(
                (dual[i] - quotient).abs() <= 1e-6 * quotient.abs().max(1.0),
                "{i}: {} by dual numbers, {quotient} by difference",
                dual[i]
            );
        }
    }
    // Second derivatives have converged as well.
    let second = uneven(Dual2_64::new(speed, 1.0, 0.0), depth.into()).stiffness;
    let slope = |speed: f64| uneven(Dual64::new(speed, 1.0), depth.into()).stiffness.slope.eps;
    let quotient = (slope(speed + h) - slope(speed - h)) / (2.0 * h);
    assert!((second.slope.v2 - quotient).abs() <= 1e-6 * quotient.abs(), "{} and {quotient}", second.slope.v2);
}

#[test]
fn derivatives_of_kinematics_and_of_one_test_are_difference_quotients() {
    fn restitution<T: Real + Ordered<Mask = bool> + Debug>(yaw_rate: T, duration: T) -> T {
        let of = |x: f64| T::from_f64(x).expect("a finite number");
        let contact = MeasuredContact {
            heading: Heading::from_angle(of(0.2)),
            before: Motion { velocity: Xy { x: of(9.0), y: of(4.0) }, yaw_rate: of(0.1) },
            after: Motion { velocity: Xy { x: of(-1.0), y: of(0.5) }, yaw_rate },
            duration,
            point_before: ForwardLeft { forward: of(2.1), left: of(0.1) },
            point_after: ForwardLeft { forward: of(1.6), left: of(0.3) },
            barrier: CrushPlane::from_angle(of(0.4)),
        };
        contact.restitution().expect("good numbers")
    }
    fn slope<T: Real + Ordered<Mask = bool> + Debug>(e: T) -> T {
        let of = |x: f64| T::from_f64(x).expect("a finite number");
        let crush = ProfileMoments::of(of(1.5), &[of(0.1), of(0.5), of(0.3)]).expect("three depths");
        BarrierTest { mass: of(1500.0), speed: of(12.0), restitution: e, crush }.stiffness(of(2.0)).expect("a good test").slope
    }
    let h = 1e-5;
    for (dual, quotient) in [
        (restitution(Dual64::new(0.7, 1.0), 0.12.into()).eps, restitution(0.7 + h, 0.12) - restitution(0.7 - h, 0.12)),
        (restitution(0.7.into(), Dual64::new(0.12, 1.0)).eps, restitution(0.7, 0.12 + h) - restitution(0.7, 0.12 - h)),
        (slope(Dual64::new(0.2, 1.0)).eps, slope(0.2 + h) - slope(0.2 - h)),
    ] {
        let quotient = quotient / (2.0 * h);
        assert!(quotient != 0.0 && (dual - quotient).abs() <= 1e-6 * quotient.abs().max(1e-2), "{dual} and {quotient}");
    }
}

/// The intervals of a further vehicle, and of the mean of the class, by normal classes of which each vehicle is known with an error of its own. Where one alone is known well, or their errors are
/// as large as their differences, the estimate of these is zero by chance: intervals by it contained 50 to 92 %.
#[test]
fn a_further_vehicle_of_a_class_and_its_mean_lie_within_their_intervals() {
    /// Three standard deviations of a share of 95 % in the classes.
    const CHANCE: f64 = 0.03;
    let mut noise = Noise::of_seed(4);
    for (errors, between, most) in [
        (&[3.0, 40.0, 40.0][..], 45.0, 1.0),
        (&[3.0, 40.0, 40.0, 40.0, 40.0], 45.0, 1.0),
        (&[5.0, 20.0, 20.0, 20.0, 20.0], 45.0, 1.0),
        (&[30.0; 10], 21.0, 1.0),
        (&[30.0; 10], 60.0, 0.95 + CHANCE),
        (&[0.0; 4], 60.0, 0.95 + CHANCE),
    ] {
        let mut normal = |sd: f64| sd * noise.normal();
        let (mut within, mut mean_within) = (Count::default(), Count::default());
        for _ in 0..500 {
            let vehicle = |&sd: &f64| Estimate::with_deviation(650.0 + normal(between) + normal(sd), sd);
            let vehicles: Vec<Estimate> = errors.iter().map(vehicle).collect();
            let center = RandomEffects::of(&vehicles).expect("two or more").mean.value;
            let further = RandomEffects::of_further(&vehicles).expect("two or more");
            within.add((650.0 + normal(between) - center).abs() <= 1.959_964 * (further.between + further.mean.variance).sqrt());
            mean_within.add((650.0 - center).abs() <= 1.959_964 * further.mean.deviation());
        }
        for share in [within.rate(), mean_within.rate()] {
            assert!((0.95 - CHANCE..=most).contains(&share), "{errors:?} {between}: {share}");
        }
    }
}
