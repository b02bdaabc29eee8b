//! Every fallible function with numbers from the smallest to the largest float: the result is finite and lawful, or an error.

use crate::strategies::{OrReject, config};
use planar_impact::barrier::{
    BarrierTest, CrushEnergy, MeasuredContact, Observation, Observations, Record, StiffnessFit, TestSeries, Window, bank, impulse_ratio,
};
use planar_impact::crash3::{Damaged, DamagedPair, Surface};
use planar_impact::crush::{MeasuringLine, Profile, ProfileMoments};
use planar_impact::*;
use proptest::prelude::*;

/// Numbers of every size and kind: mostly ordinary ones, so that one extreme number meets valid others.
fn number() -> impl Strategy<Value = f64> {
    let extreme = (-320..=308_i32, prop::bool::ANY).prop_map(|(power, sign)| 10_f64.powi(power) * if sign { 1.0 } else { -1.0 });
    let odd = prop::sample::select(vec![0.0, -0.0, 5e-324, f64::MIN_POSITIVE, f64::MAX, f64::MIN, f64::INFINITY, f64::NAN]);
    prop_oneof![40 => (-90..=90_i32).prop_map(|tenths| f64::from(tenths) / 10.0), 3 => extreme, 1 => odd]
}

/// The same above zero.
fn positive() -> impl Strategy<Value = f64> {
    number().prop_map(f64::abs)
}

fn vehicle() -> impl Strategy<Value = Vehicle> {
    (positive(), positive(), -3.2..3.2_f64, [number(), number()], [number(), number()], number()).prop_map(
        |(mass, yaw_inertia, heading, [forward, left], [x, y], yaw_rate)| Vehicle {
            mass,
            yaw_inertia,
            heading: Heading::from_angle(heading),
            impact_center: ForwardLeft { forward, left },
            motion: Motion { velocity: Xy { x, y }, yaw_rate },
        },
    )
}

fn collision() -> impl Strategy<Value = Collision> {
    let ratio = prop_oneof![
        3 => Just(ImpulseRatio::Critical),
        1 => number().prop_map(ImpulseRatio::Given),
        1 => (0..=10_i32).prop_map(|tenths| ImpulseRatio::OfCritical(f64::from(tenths) / 10.0)),
        1 => positive().prop_map(ImpulseRatio::LimitedByFriction),
    ];
    let moment = prop_oneof![4 => Just(Moment::None), 1 => number().prop_map(Moment::Given), 1 => Just(Moment::OfCritical(0.5))];
    let law = prop::sample::select(vec![Law::Brach, Law::KudlichSlibar]);
    (vehicle(), prop::option::weighted(0.8, vehicle()), -3.2..3.2_f64, 0..=10_i32, ratio, moment, law).prop_map(
        |(one, two, plane, restitution, impulse_ratio, moment, law)| Collision {
            one: one.into(),
            two: two.map_or(Party::Barrier, Party::Vehicle),
            crush_plane: CrushPlane::from_angle(plane),
            restitution: f64::from(restitution) / 10.0,
            impulse_ratio,
            law,
            moment,
        },
    )
}

/// An accepted impact: finite, with its restitution, without a gain of energy, and with its momentum.
fn is_lawful(collision: &Collision, impact: &Impact) -> Result<(), TestCaseError> {
    let accuracy = 2_f64.powi(-20);
    let outputs = Outputs::of(collision, impact);
    for output in Output::ALL.into_iter().filter(|&output| output != Output::CriticalImpulseRatio) {
        prop_assert!(outputs[output].is_finite(), "{output} is {}", outputs[output]);
    }
    let missed = impact.separation.n + collision.restitution * impact.approach.n;
    prop_assert!(missed.abs() <= accuracy * impact.approach.n.abs(), "the restitution is missed by {missed}");
    let energy = impact.kinetic_energy;
    prop_assert!(energy.after <= energy.before * (1.0 + 4.0 * accuracy), "energy is gained: {energy:?}");
    for (party, response, sign) in [(&collision.one, &impact.one, 1.0), (&collision.two, &impact.two, -1.0)] {
        let Some(vehicle) = party.vehicle() else { continue };
        // Below the normal floats a velocity has fewer digits.
        let accepted = 1e-9 * impact.impulse_on_ground.x.hypot(impact.impulse_on_ground.y) + vehicle.mass * f64::MIN_POSITIVE;
        let passed = response.delta_v * vehicle.mass - impact.impulse_on_ground * sign;
        prop_assert!(passed.x.hypot(passed.y) <= accepted, "the momentum misses the impulse by {passed:?}");
    }
    Ok(())
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn a_collision(collision in collision(), of in prop::sample::select(Output::ALL.to_vec())) {
        let solved = collision.solve();
        if let Ok(impact) = &solved {
            is_lawful(&collision, impact)?;
        }
        let of_all = collision.sensitivities();
        prop_assert!(solved.is_ok() || of_all.is_err(), "derivatives of what is refused");
        if let Ok(outputs) = of_all {
            for output in Output::ALL {
                let row = &outputs[output];
                prop_assert!(row.value.is_finite() && row.by.iter().all(|(_, by)| by.is_finite()), "{output}: {row:?}");
            }
        }
        if let Ok(row) = collision.sensitivity(of) {
            prop_assert!(row.value.is_finite() && row.by.iter().all(|(_, by)| by.is_finite()), "{of}: {row:?}");
        }
        if let Ok(curved) = collision.curvature(of) {
            prop_assert!(curved.value.is_finite() && curved.twice.as_rows().iter().flatten().all(|by| by.is_finite()), "{of}: {curved:?}");
        }
        if let Some(admissible) = collision.admissible() {
            let Admissible { restitution, restitution_for_any_approach: any, least_impulse_ratio: least, greatest_impulse_ratio: greatest } = admissible;
            prop_assert!([Some(restitution), Some(any), least, greatest].into_iter().flatten().all(f64::is_finite), "{admissible:?}");
        }
    }

    #[test]
    fn two_surfaces(one in number(), two in number()) {
        if let Ok(bracket) = CrushPlaneBracket::of_surfaces(one, two) {
            prop_assert!(bracket.nominal.is_finite() && bracket.lower() <= bracket.nominal && bracket.nominal <= bracket.upper(), "{bracket:?}");
        }
    }

    #[test]
    fn damage(one in vehicle(), two in vehicle(), energies in [positive(), positive()], from in [number(), number()]) {
        let force = ForceDirection { ahead: from[0], right: from[1] };
        let damaged = |vehicle: &Vehicle, energy| Some(Damaged::of(vehicle, Surface::Front, force, energy));
        if let Ok(estimate) = (DamagedPair { one: damaged(&one, energies[0]), two: damaged(&two, energies[1]) }).solve() {
            let vehicles = [estimate.one, estimate.two].into_iter().flatten().flat_map(|vehicle| {
                [vehicle.corrected_energy, vehicle.moment_arm, vehicle.effective_mass_factor, vehicle.delta_v_magnitude, vehicle.delta_v.forward, vehicle.delta_v.left]
            });
            prop_assert!([estimate.energy, estimate.impulse].into_iter().chain(vehicles).all(f64::is_finite), "{estimate:?}");
        }
    }

    #[test]
    fn a_crush(width in number(), depths in prop::collection::vec(number(), 0..6), stations in prop::collection::vec(number(), 0..6), angle in -1.5..1.5_f64) {
        let line = MeasuringLine { offset: width, angle };
        let profiles = [Profile::equally_spaced(width, depths.clone()), Profile::at_stations(stations.clone(), depths.clone()), line.profile(&stations, &depths)];
        for profile in profiles.into_iter().flatten() {
            prop_assert!(profile.width() > 0.0 && profile.depths().iter().all(|depth| *depth >= 0.0 && depth.is_finite()), "{profile:?}");
        }
    }

    #[test]
    fn barrier_tests(tests in prop::collection::vec(([positive(), positive(), positive()], 0..=10_i32, [positive(), positive(), positive()]), 1..4), onset in positive()) {
        let tests: Vec<BarrierTest> = tests.into_iter().map(|([mass, speed, width], tenths, depths)| {
            let crush = ProfileMoments::of(width, &depths).expect("three depths");
            BarrierTest { mass, speed, restitution: f64::from(tenths) / 10.0, crush }
        }).collect();
        if let Ok(line) = tests[0].speed_line(onset) {
            prop_assert!(line.slope.is_finite() && line.onset.is_finite(), "{line:?}");
        }
        if let Ok(stiffness) = tests[0].stiffness(onset) {
            prop_assert!(stiffness.onset.is_finite() && stiffness.slope.is_finite(), "{stiffness:?}");
        }
        let series = TestSeries::new(tests.clone());
        if let Ok(series) = series {
            let energies = series.crush_energies().into_iter().map(|energy| CrushEnergy { crush: tests[0].crush, energy, deviation: 1.0 });
            let _ = Observations::of_energies(&energies.collect::<Vec<_>>());
        }
        let observed: Vec<_> = tests.iter().map(|test| Observation { crush: test.crush, intensity: test.speed, deviation: 1.0 }).collect();
        let observations = Observations::independent(&observed);
        for fit in observations.iter().flat_map(|observations| [StiffnessFit::on_mean_depth(observations), StiffnessFit::on_profiles(observations)]).flatten() {
            let StiffnessFit { stiffness, covariance, chi_square, .. } = &fit;
            let numbers = [stiffness.onset, stiffness.slope, covariance.onset, covariance.slope, *chi_square];
            prop_assert!(numbers.into_iter().all(f64::is_finite), "{fit:?}");
        }
    }

    #[test]
    fn records(start in number(), step in positive(), values in prop::collection::vec(number(), 2..9), part in (0..8_i32, 1..8_i32)) {
        let record = Record::uniform(start, step, values).or_reject("no record")?;
        let window = Window { from: start + step * f64::from(part.0), to: start + step * f64::from(part.0 + part.1) };
        if let Ok(impulse) = record.impulse_over(&window) {
            prop_assert!(impulse.is_finite());
        }
        if let Ok(estimate) = record.baseline(&window) {
            prop_assert!(estimate.value.is_finite() && estimate.variance.is_finite(), "{estimate:?}");
        }
        if let Ok(estimate) = record.impulse(&window, &window) {
            prop_assert!(estimate.value.is_finite() && estimate.variance.is_finite(), "{estimate:?}");
        }
        if let Ok(sum) = bank(&[record.clone(), record]) {
            prop_assert!(sum.values().iter().all(|value| value.is_finite()), "{sum:?}");
        }
    }

    #[test]
    fn a_measured_contact(one in vehicle(), two in vehicle(), duration in positive(), impulse in [number(), number()]) {
        let contact = MeasuredContact {
            heading: one.heading, before: one.motion, after: two.motion, duration,
            point_before: one.impact_center, point_after: two.impact_center, barrier: CrushPlane::from_angle(0.3),
        };
        if let Ok(restitution) = contact.restitution() {
            prop_assert!(restitution.is_finite(), "{restitution}");
        }
        if let Ok(ratio) = impulse_ratio(Nt { n: impulse[0], t: impulse[1] }) {
            prop_assert!(ratio.is_finite(), "{ratio}");
        }
    }
}
