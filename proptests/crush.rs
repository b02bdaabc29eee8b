//! Crush: the energy of a profile under each law.

use crate::rational::Rational;
use crate::strategies::{Fraction, config};
use num_dual::Dual64;
use planar_impact::crush::*;
use planar_impact::{Field, Ordered};
use proptest::prelude::*;

type Exact = Rational;

fn int(n: i32) -> Exact {
    Exact::int(n)
}

/// Steps between stations, and depths, in tenths.
#[derive(Clone, Debug)]
struct ProfileDraw {
    origin: i32,
    steps: Vec<i32>,
    depths: Vec<i32>,
}

impl ProfileDraw {
    fn stations<T: Field>(&self) -> Vec<T> {
        let places = self.steps.iter().scan(self.origin, |at, step| {
            *at += step;
            Some(*at)
        });
        std::iter::once(self.origin).chain(places).map(|at| Fraction(at, 10).of()).collect()
    }

    fn depths<T: Field>(&self) -> Vec<T> {
        self.depths.iter().map(|&depth| Fraction(depth, 10).of()).collect()
    }

    fn of<T: Field>(&self) -> Profile<T> {
        Profile::at_stations_unchecked(self.stations(), self.depths()).ok().expect("as many stations as depths")
    }
}

fn profile() -> impl Strategy<Value = ProfileDraw> {
    (2..=7_usize).prop_flat_map(|count| {
        let steps = proptest::collection::vec(1..=9_i32, count - 1);
        let depths = proptest::collection::vec(0..=12_i32, count);
        (-20..=20_i32, steps, depths).prop_map(|(origin, steps, depths)| ProfileDraw { origin, steps, depths })
    })
}

fn stiffness() -> impl Strategy<Value = (i32, i32)> {
    (0..=9_i32, 0..=9_i32)
}

fn line<T: Field>((onset, slope): (i32, i32)) -> CrushStiffness<T> {
    CrushStiffness { onset: T::int(onset), slope: T::int(slope) }
}

/// Computes ∫ f dw over a profile by Simpson's rule, which is exact for the quadratics here.
fn integral(profile: &Profile<Exact>, f: impl Fn(Exact) -> Exact) -> Exact {
    profile.segments().fold(int(0), |sum, Segment { width, from, to }| {
        let middle = (from.clone() + &to).half();
        sum + width * (f(from) + int(4) * f(middle) + f(to)) / int(6)
    })
}

/// Adds a station to a profile, on the line between two others.
fn with_another_station(profile: &Profile<Exact>, place: usize, share: Exact) -> Profile<Exact> {
    let (mut stations, mut depths) = (profile.stations(), profile.depths().to_vec());
    let i = place % (depths.len() - 1);
    let between = |values: &[Exact]| values[i].clone() + (values[i + 1].clone() - &values[i]) * &share;
    let (station, depth) = (between(&stations), between(&depths));
    stations.insert(i + 1, station);
    depths.insert(i + 1, depth);
    Profile::at_stations(stations, depths).expect("as many stations as depths")
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn the_moments_are_the_integrals_over_the_width(draw in profile()) {
        let profile = draw.of::<Exact>();
        let moments = profile.moments();
        prop_assert_eq!(moments.first.clone() * int(2), profile.width());
        prop_assert_eq!(&moments.second, &integral(&profile, |depth| depth));
        prop_assert_eq!(&moments.third, &integral(&profile, |depth| depth.squared().half()));
        prop_assert_eq!(moments.mean_depth() * profile.width(), moments.second);
    }

    #[test]
    fn the_energy_is_half_the_squared_intensity_over_the_width(draw in profile(), d in stiffness()) {
        let (profile, line) = (draw.of::<Exact>(), line(d));
        let integral = integral(&profile, |depth| line.crush_intensity(depth).squared().half());
        prop_assert_eq!(line.crush_energy(profile.moments()), integral);
    }

    #[test]
    fn another_point_on_the_same_profile_changes_nothing(draw in profile(), place in 0..6_usize, share in 1..=8_i32, d in stiffness()) {
        let profile = draw.of::<Exact>();
        let finer = with_another_station(&profile, place, Fraction(share, 9).of());
        prop_assert_eq!(profile.moments(), finer.moments());
        let zones = StiffnessZones::new(vec![line(d), line((d.1, d.0))], vec![Fraction(share, 3).of()]).expect("two zones");
        prop_assert_eq!(zones.crush_energy(&profile), zones.crush_energy(&finer));
        let saturating = Saturating { stiffness: line::<Exact>(d), depth: Fraction(share, 10).of() };
        prop_assert_eq!(saturating.energy_of(&profile), saturating.energy_of(&finer));
    }

    #[test]
    fn equal_spacing_is_a_choice_of_stations(draw in profile()) {
        let depths = draw.depths::<Exact>();
        let width = int(draw.steps[0]);
        let equal = Profile::equally_spaced(width.clone(), depths.clone()).expect("two depths or more");
        let at = Profile::at_stations(equal.stations(), depths.clone()).expect("as many stations as depths");
        prop_assert_eq!(equal.moments(), at.moments());
        prop_assert_eq!(ProfileMoments::of(width, &depths), Some(at.moments()));
    }

    #[test]
    fn the_energy_of_a_width_is_that_of_its_parts(draw in profile(), cut in 0..6_usize, d in stiffness()) {
        let profile = draw.of::<Exact>();
        let i = 1 + cut % (profile.depths().len() - 1);
        let part = |range: std::ops::Range<usize>| {
            let (stations, depths) = (profile.stations()[range.clone()].to_vec(), profile.depths()[range].to_vec());
            Profile::at_stations(stations, depths).map_or(int(0), |part| line::<Exact>(d).crush_energy(part.moments()))
        };
        prop_assert_eq!(line(d).crush_energy(profile.moments()), part(0..i + 1) + part(i..profile.depths().len()));
    }

    #[test]
    fn zones_of_the_same_stiffness_are_none(draw in profile(), d in stiffness(), one in -30..=30_i32, more in -20..=20_i32) {
        let profile = draw.of::<Exact>();
        let borders = vec![Fraction(one, 7).of(), Fraction(one + more, 7).of()];
        let zones = StiffnessZones::new(vec![line(d); 3], borders).expect("three zones");
        prop_assert_eq!(zones.crush_energy(&profile), line(d).crush_energy(profile.moments()));
        let all = zones.moments(&profile).fold(ProfileMoments::zero(), |sum, part| sum + part);
        prop_assert_eq!(all, profile.moments());
    }

    #[test]
    fn the_energy_grows_with_every_depth_the_width_and_both_stiffnesses(draw in profile(), d in stiffness(), place in 0..7_usize) {
        let energy = |draw: &ProfileDraw, d| line::<Exact>(d).crush_energy(draw.of::<Exact>().moments());
        let before = energy(&draw, d);
        let mut deeper = draw.clone();
        deeper.depths[place % draw.depths.len()] += 1;
        prop_assert!(before <= energy(&deeper, d));
        prop_assert_eq!(before == energy(&deeper, d), d.1 == 0);
        let mut wider = draw.clone();
        wider.steps[place % draw.steps.len()] += 1;
        prop_assert!(before <= energy(&wider, d));
        prop_assert!(before < energy(&draw, (d.0 + 1, d.1)));
        let crushed = draw.depths.iter().any(|&depth| depth > 0);
        prop_assert!(before <= energy(&draw, (d.0, d.1 + 1)));
        prop_assert!(!crushed || before < energy(&draw, (d.0, d.1 + 1)));
    }

    #[test]
    fn units_scale_by_their_powers(draw in profile(), d in stiffness(), length in 1..=9_i32, root in 1..=9_i32) {
        // d₀ is the root of a force, and d₁ the root of a force per length: E_C is a force times a length.
        let (profile, length, root) = (draw.of::<Exact>(), Fraction(length, 4).of::<Exact>(), Fraction(root, 3).of::<Exact>());
        let scaled = |values: &[Exact]| values.iter().map(|value| value * &length).collect();
        let scaled = Profile::at_stations(scaled(&profile.stations()), scaled(profile.depths())).expect("as many stations as depths");
        let CrushStiffness { onset, slope } = line::<Exact>(d);
        let there = CrushStiffness { onset: onset * &root, slope: slope * &root / &length };
        let factor = root.squared() * &length;
        prop_assert_eq!(there.crush_energy(scaled.moments()), line(d).crush_energy(profile.moments()) * factor);
    }

    #[test]
    fn saturation_is_the_linear_law_and_then_a_constant_force(draw in profile(), d in stiffness(), at in 0..=12_i32) {
        // Split where the depth equals C_s: shallower parts are linear, deeper ones have the force at C_s.
        let law = Saturating { stiffness: line::<Exact>(d), depth: Fraction(at, 10).of() };
        let force = ForceLine::from(law.stiffness.clone());
        let beyond = |depth: Exact| {
            let over = depth - &law.depth;
            CrushLaw::energy(&law.stiffness, law.depth.clone()) + (force.onset.clone() + &force.slope * &law.depth) * over
        };
        let expected = draw.of::<Exact>().segments().fold(int(0), |sum, segment| {
            let Segment { width, from, to } = segment;
            let part = |share: Exact, from: &Exact, to: &Exact| {
                let middle = (from.clone() + to).half();
                let width = width.clone() * share;
                if middle <= law.depth {
                    law.stiffness.energy_of_segment(&Segment { width, from: from.clone(), to: to.clone() })
                } else {
                    width * beyond(middle)
                }
            };
            let inside = |depth: &Exact| *depth <= law.depth;
            if inside(&from) == inside(&to) {
                return sum + part(int(1), &from, &to);
            }
            let share = (law.depth.clone() - &from) / (to.clone() - &from);
            sum + part(share.clone(), &from, &law.depth) + part(int(1) - share, &law.depth, &to)
        });
        prop_assert_eq!(law.energy_of(&draw.of()), expected);
    }

    #[test]
    fn the_force_is_the_slope_of_the_energy(d in stiffness(), at in 0..=12_i32, depth in 0..=24_i32, n in 0..=12_i32) {
        let depth = 0.05 * f64::from(depth);
        fn slope(law: &impl CrushLaw<Dual64>, depth: f64) -> (f64, f64) {
            (law.energy(Dual64::new(depth, 1.0)).eps, law.force(Dual64::from(depth)).re)
        }
        let stiffness = line::<Dual64>(d);
        let saturating = Saturating { stiffness, depth: Dual64::from(0.1 * f64::from(at)) };
        let power = PowerLaw {
            energy_without_crush: Dual64::from(1.0),
            force: Dual64::from(3.0),
            reference_depth: Dual64::from(0.4),
            exponent: Dual64::from(0.25 * f64::from(n)),
        };
        for (energy, force) in [slope(&stiffness, depth), slope(&saturating, depth), slope(&power, depth)] {
            let near = (energy - force).abs() <= 1e-13 * force.abs();
            // The energy of a force that is nonzero at once has no slope at depth 0, where the fractional powers omit it.
            prop_assert!(near || depth == 0.0, "{} {} at {}", energy, force, depth);
        }
    }

    #[test]
    fn the_energy_follows_every_number_that_it_is_made_of(draw in profile(), d in stiffness(), at in 1..=12_i32, n in 0..=12_i32, which in 0..4_usize) {
        // Dual numbers compared with central differences, away from the kinks of the saturating law.
        let depth = 0.1 * f64::from(at) + 0.003;
        let exponent = 0.25 * f64::from(n);
        fn energy<T: planar_impact::scalar::Power<Mask = bool>>(profile: &Profile<T>, d: (i32, i32), numbers: [T; 4]) -> T {
            let [depth, exponent, force, onset] = numbers;
            let stiffness = CrushStiffness { onset, slope: T::int(d.1) };
            let power = PowerLaw { energy_without_crush: T::int(1), force, reference_depth: T::int(2), exponent };
            Saturating { stiffness, depth }.energy_of(profile) + power.energy_of(profile)
        }
        let values = [depth, exponent, 2.0, f64::from(d.0)];
        let dual = energy(&draw.of(), d, std::array::from_fn(|i| Dual64::new(values[i], f64::from(u8::from(i == which)))));
        let moved = |by: f64| energy(&draw.of(), d, std::array::from_fn(|i| values[i] + if i == which { by } else { 0.0 }));
        // A negative exponent or onset is invalid, so the difference is one-sided there.
        let step = 1e-5;
        let low = if which < 3 && values[which] < step { 0.0 } else { -step };
        let difference = (moved(step) - moved(low)) / (step - low);
        let scale = dual.re.abs().max(1.0);
        let bound = if low == 0.0 { 1e-3 } else { 1e-7 };
        prop_assert!((dual.eps - difference).abs() <= bound * scale, "{} {}", dual.eps, difference);
    }

    #[test]
    fn a_border_on_a_station_counts_once(draw in profile(), one in stiffness(), two in stiffness(), place in 0..7_usize) {
        // The derivatives with respect to a border on a station, and to that station, equal those for a border beside it.
        let place = place % draw.depths.len();
        let energy = |border: Dual64, station: f64| {
            let mut stations = draw.stations::<Dual64>();
            stations[place].eps = station;
            let profile = Profile::at_stations(stations, draw.depths()).expect("as many stations as depths");
            StiffnessZones::new(vec![line(one), line(two)], vec![border]).expect("two zones").crush_energy(&profile)
        };
        let on = draw.stations::<f64>()[place];
        // A border before the first station or at and after the last one has no effect: the derivative there is one-sided.
        let inner = place > 0 && place + 1 < draw.depths.len();
        let by_border = [on - 1e-9, on, on + 1e-9].map(|border| energy(Dual64::new(border, 1.0), 0.0));
        let by_station = [on - 1e-9, on, on + 1e-9].map(|border| energy(Dual64::from(border), 1.0));
        let jump = (by_border[0].eps - by_border[2].eps).abs() + (by_station[0].eps - by_station[2].eps).abs();
        // Over 1e-9 m the derivative changes by the second derivative times that; counting a border twice would double it.
        let slope = by_border.into_iter().chain(by_station).map(|energy| energy.eps.abs()).fold(0.0, f64::max);
        let bound = 1e-6 * (1.0 + by_border[1].re.abs() + slope);
        prop_assert!(!inner || jump <= bound, "{:?} {:?}", by_border, by_station);
        for [before, at, after] in [by_border, by_station] {
            let (low, high) = (before.eps.min(after.eps) - bound, before.eps.max(after.eps) + bound);
            prop_assert!((low..=high).contains(&at.eps), "{:?} {:?}", by_border, by_station);
        }
    }

    #[test]
    fn a_border_moves_energy_from_one_zone_to_the_other(draw in profile(), one in stiffness(), two in stiffness(), share in 1..=8_i32) {
        // dE/dx for a border at x is the difference of the energies per width there.
        let (first, width) = (f64::from(draw.origin) / 10.0, draw.of::<f64>().width());
        let border = first + width * f64::from(share) / 9.0 + 1e-4;
        let zones = StiffnessZones::new(vec![line(one), line(two)], vec![Dual64::new(border, 1.0)]).expect("two zones");
        let energy = zones.crush_energy(&draw.of());
        let (stations, depths) = (draw.stations::<f64>(), draw.depths::<f64>());
        let i = stations.windows(2).position(|ends| ends[0] <= border && border < ends[1]);
        prop_assume!(i.is_some());
        let i = i.expect("assumed");
        let depth = depths[i] + (depths[i + 1] - depths[i]) * (border - stations[i]) / (stations[i + 1] - stations[i]);
        let jump = CrushLaw::energy(&line::<f64>(one), depth) - CrushLaw::energy(&line::<f64>(two), depth);
        prop_assert!((energy.eps - jump).abs() <= 1e-9 * (1.0 + jump.magnitude()), "{} {}", energy.eps, jump);
    }
}
