//! Diagnostics of a reconstruction, and their messages.

use planar_impact::crush::{CrushLaw, CrushStiffness, ForceLine, Profile, StiffnessZones};
use planar_impact::reconstruct::diagnosis::*;
use planar_impact::reconstruct::{Evidence, Measurand, ReconstructionProblem, Search, Solution, Uncertainty, Unknown, Variable};
use planar_impact::*;

use super::scene::{Source, Truth};

/// Reconstructs the speed of vehicle 1 from its own crush energy, and from other evidence if given.
fn solved(collision: Collision, more: &[(Measurand, f64)]) -> (ReconstructionProblem, Solution) {
    let truth = Truth::of(collision, 0.5);
    let mut question = ReconstructionProblem::of(collision)
        .between(Variable::Speed(Side::One), truth.variable(Variable::Speed(Side::One)), 0.0, 100.0)
        .evidence(Measurand::CrushEnergy, truth.measured(Measurand::CrushEnergy), Uncertainty::StandardDeviation(1.0));
    let with = |&(of, value)| Evidence { of, value, uncertainty: Uncertainty::StandardDeviation(1e3) };
    question.evidence.extend(more.iter().map(with));
    let answer = question.solve(&Search { starts: 1, ..Search::default() }).expect("it starts at the truth");
    (question, answer.solutions[0].clone())
}

fn crash(seed: u64) -> Collision {
    Source::of(seed).collision()
}

fn asked(findings: &[Finding], question: Question) -> &Finding {
    findings.iter().find(|finding| finding.question == question).unwrap_or_else(|| panic!("{question:?}"))
}

fn diagnose(collision: Collision, damage: [Option<Damage>; 2]) -> Vec<Finding> {
    let (question, solution) = solved(collision, &[]);
    solution.diagnose(&question, &damage)
}

fn flat(force: f64, stiffness: f64) -> Damage {
    Damage { crush_energy: force * force / (2.0 * stiffness), force: Some(force), stiffness: Some(stiffness), force_direction: None }
}

#[test]
fn every_question_has_an_answer_with_a_limit_and_its_source() {
    let findings = diagnose(crash(31), [None, None]);
    for question in Question::ALL {
        let finding = asked(&findings, question);
        assert!(!finding.source.is_empty() && !finding.meaning.to_string().is_empty());
        assert_eq!(finding.reading == Reading::NotChecked, finding.figure.is_none());
        assert_eq!(Question::ALL.iter().filter(|other| other.name() == question.name()).count(), 1);
    }
    let not_checked =
        [Question::ForceBalance, Question::OppositeForces, Question::Rotation, Question::CrushShare, Question::RestitutionBound];
    assert!(not_checked.iter().all(|&question| asked(&findings, question).reading == Reading::NotChecked));
}

#[test]
fn a_damage_has_the_force_of_its_law() {
    let profile = Profile::equally_spaced(1.5, vec![0.2, 0.4, 0.3]).expect("three depths");
    let (soft, stiff) = (ForceLine { onset: 40e3, slope: 600e3 }, ForceLine { onset: 60e3, slope: 1200e3 });
    let zones = StiffnessZones::new(vec![CrushStiffness::from(soft), CrushStiffness::from(stiff)], vec![0.75]).expect("two zones");
    let damage = Damage::of(&profile, &zones);
    // Straight lines: the force on each half is that at its middle, 0.3 m and 0.35 m, times its width.
    let by_hand = 0.75 * CrushStiffness::from(soft).force(0.3) + 0.75 * CrushStiffness::from(stiff).force(0.35);
    assert!((damage.force.expect("linear") / by_hand - 1.0).abs() < 1e-12);
    assert!((damage.stiffness.expect("linear") - 0.75 * (600e3 + 1200e3)).abs() < 1e-6);
    assert_eq!(damage.crush_energy, zones.crush_energy(&profile));
}

#[test]
fn forces_of_two_crushes_balance_within_100_percent() {
    let of = |other: f64| diagnose(crash(32), [Some(flat(200e3, 1e6)), Some(flat(other, 1e6))]);
    // One crush plane and one force: the component along the surface is the same fraction of both.
    for (other, expected, reading) in [
        (200e3, 0.0, Reading::Within),
        (398e3, 0.99, Reading::Within),
        (402e3, 1.01, Reading::Outside),
        (101e3, 99.0 / 101.0, Reading::Within),
        (99e3, 101.0 / 99.0, Reading::Outside),
    ] {
        let findings = of(other);
        let balance = asked(&findings, Question::ForceBalance);
        assert_eq!(balance.reading, reading, "{balance:?}");
        assert!((balance.figure.expect("checked").value() - expected).abs() < 1e-9, "{balance:?}");
    }
    assert!(asked(&of(402e3), Question::ForceBalance).meaning.to_string().contains("vehicle 2 are too large"));
    assert!(asked(&of(99e3), Question::ForceBalance).meaning.to_string().contains("vehicle 1 are too large"));
}

#[test]
fn a_direction_read_off_a_vehicle_adds_the_force_along_the_surface() {
    let collision = Collision { crush_plane: CrushPlane::from_angle(0.0), ..crash(32) };
    // At 60° from the normal of the crush plane, twice the force has the same normal component. Vehicle 1 heads along the normal.
    let angle = std::f64::consts::FRAC_PI_3;
    let oblique = Damage { force_direction: Some(ForceDirection { ahead: angle.cos(), right: angle.sin() }), ..flat(200e3, 1e6) };
    let straight = Damage { force_direction: Some(ForceDirection { ahead: 1.0, right: 0.0 }), ..flat(200e3, 1e6) };
    let impulse = collision.solve().expect("possible").impulse;
    let other = 200e3 * impulse.n.hypot(impulse.t) / impulse.n.abs();
    for (one, force) in [(straight, 200e3), (oblique, 400e3)] {
        let findings = diagnose(collision, [Some(one), Some(flat(200e3, 1e6))]);
        let share = asked(&findings, Question::ForceBalance).figure.expect("checked").value();
        assert!((share - (force - other).abs() / f64::min(force, other)).abs() < 1e-9, "{share} for {force} and {other}");
    }
}

#[test]
fn the_softer_vehicle_has_the_larger_share() {
    let (soft, stiff) = (flat(200e3, 0.5e6), flat(200e3, 1.5e6));
    let share = |damage| asked(&diagnose(crash(33), damage), Question::CrushShare).clone();
    let fits = share([Some(soft), Some(stiff)]);
    assert_eq!((fits.reading, fits.figure.map(|figure| (figure.value() * 1e9).round())), (Reading::Within, Some(1e9)));
    assert!(fits.meaning.to_string().starts_with("vehicle 1 has 75 % of the crush energy, by the stiffness of both it should have 75 %"));
    // With forces in the ratio 1 to 2.01, the energies at equal stiffness are in the ratio 1 to 4.0401.
    for (ratio, reading) in [(1.99, Reading::Within), (2.01, Reading::Outside)] {
        let (more, less) = (Some(flat(ratio * 100e3, 1e6)), Some(flat(100e3, 1e6)));
        let found = share([more, less]);
        assert!(found.reading == reading && (found.figure.expect("checked").value() - ratio * ratio).abs() < 1e-9, "{found:?}");
        assert_eq!(share([less, more]).reading, reading, "{ratio}");
    }
}

#[test]
fn directions_read_off_the_vehicles_are_compared_on_the_ground() {
    let collision = crash(34);
    let impact = collision.solve().expect("possible");
    let read_off = |response: &Response, by: f64| {
        let angle = response.principal_direction_of_force() + by;
        Some(Damage { force_direction: Some(ForceDirection { ahead: angle.cos(), right: angle.sin() }), ..flat(2e5, 1e6) })
    };
    let opposite = |damage| asked(&diagnose(collision, damage), Question::OppositeForces).clone();
    // The limit is 2 × 12.6° × √2, 0.622 rad.
    for (by, reading) in [(0.0, Reading::Within), (0.62, Reading::Within), (-0.624, Reading::Outside), (3.0, Reading::Outside)] {
        for damage in
            [[read_off(&impact.one, 0.0), read_off(&impact.two, by)], [read_off(&impact.one, by), None], [None, read_off(&impact.two, by)]]
        {
            let finding = opposite(damage);
            assert_eq!(finding.reading, reading, "{by}");
            assert!((finding.figure.expect("checked").value() - f64::abs(by)).abs() < 1e-6, "{finding:?}");
        }
    }
}

#[test]
fn a_vehicle_that_turns_against_the_moment_is_named() {
    let collision = crash(35);
    let impact = collision.solve().expect("possible");
    let rates = [impact.one.after.yaw_rate, impact.two.after.yaw_rate];
    let of = |side| Measurand::Output(Output::YawRate(side));
    let evidence = |deviation: f64, one: f64, two: f64| {
        let (mut question, _) = solved(collision, &[(of(Side::One), one), (of(Side::Two), two)]);
        for evidence in &mut question.evidence[1..] {
            evidence.uncertainty = Uncertainty::StandardDeviation(deviation);
        }
        let answer = question.solve(&Search { starts: 1, ..Search::default() }).expect("it starts at the truth");
        let findings = answer.best().diagnose(&question, &[None, None]);
        findings.into_iter().filter(|finding| finding.question == Question::Rotation).collect::<Vec<_>>()
    };
    let [one, two] = &evidence(0.01, rates[0], -rates[1])[..] else { panic!("one for each vehicle") };
    assert_eq!((one.reading, two.reading), (Reading::Within, Reading::Outside));
    assert!(two.meaning.to_string().contains("vehicle 2"));
    // Two standard deviations from none.
    for (deviations, reading) in [(2.01, Reading::Outside), (1.99, Reading::Within)] {
        let [one, _] = &evidence(rates[0].abs() / deviations, -rates[0], -rates[1])[..] else { panic!("one for each vehicle") };
        assert_eq!(one.reading, reading, "{deviations}");
    }
    // So uncertain that it may have turned the other way.
    let unsure = evidence(rates[0].abs().max(rates[1].abs()), -rates[0], -rates[1]);
    assert!(unsure.iter().all(|finding| finding.reading == Reading::Within && finding.meaning.to_string().contains("hardly turned")));
}

#[test]
fn common_velocity_is_left_by_restitution_and_by_sliding() {
    let common = |restitution, impulse_ratio| {
        let collision = Collision { restitution, impulse_ratio, ..crash(36) };
        let impact = collision.solve().expect("possible");
        let finding = asked(&diagnose(collision, [None, None]), Question::CommonVelocity).clone();
        assert!((finding.figure.expect("checked").value() - impact.separation.length() / impact.approach.length()).abs() < 1e-6);
        finding.reading
    };
    assert_eq!(common(0.0, ImpulseRatio::Critical), Reading::Within);
    // Sliding has ended, so that e times the normal part of the approach is left.
    let approach = Collision { impulse_ratio: ImpulseRatio::Critical, ..crash(36) }.solve().expect("possible").approach;
    let leaving = |share: f64| share * approach.length() / approach.n.abs();
    assert_eq!(common(leaving(0.099), ImpulseRatio::Critical), Reading::Within);
    assert_eq!(common(leaving(0.101), ImpulseRatio::Critical), Reading::Outside);
}

#[test]
fn restitution_is_compared_with_tests_at_the_same_closing_speed() {
    let at_closing_speed = |closing: f64, e: f64| {
        let mut collision = Collision { restitution: e, ..crash(37) };
        let factor = closing / collision.solve().expect("possible").approach.n.abs();
        for party in [&mut collision.one, &mut collision.two] {
            if let Party::Vehicle(car) = party {
                car.motion.velocity *= factor;
            }
        }
        asked(&diagnose(collision, [None, None]), Question::Restitution).reading
    };
    for (closing, e, reading) in [
        (15.0, 0.0, Reading::Within),
        (15.0, 0.299, Reading::Within),
        (15.0, 0.301, Reading::Outside),
        // At walking speed, bumpers rebound.
        (1.0, 0.199, Reading::Outside),
        (1.0, 0.201, Reading::Within),
        (1.0, 0.399, Reading::Within),
        (1.0, 0.401, Reading::Outside),
        (3.49, 0.35, Reading::Within),
        (3.51, 0.35, Reading::Outside),
    ] {
        assert_eq!(at_closing_speed(closing, e), reading, "e = {e} at {closing} m/s");
    }
}

#[test]
fn restitution_on_its_upper_bound_points_at_the_geometry() {
    let collision = Collision { restitution: 0.25, ..crash(38) };
    let truth = Truth::of(collision, 0.5);
    let e = Variable::Input(Input::Restitution);
    let at = |max: Option<f64>| {
        let of = Measurand::Output(Output::DeltaVMagnitude(Side::One));
        let question = ReconstructionProblem::of(collision).with(Unknown { min: Some(0.0), max, ..Unknown::free(e, 0.05) }).evidence(
            of,
            truth.measured(of),
            Uncertainty::StandardDeviation(0.2),
        );
        let answer = question.solve(&Search::default()).expect("it has a least sum of squares");
        asked(&answer.best().diagnose(&question, &[None, None]), Question::RestitutionBound).clone()
    };
    for (max, upper) in [(Some(0.4), 0.4), (None, 1.0)] {
        let below = at(max);
        assert_eq!((below.reading, below.limit), (Reading::Within, Limit::AtMost(Figure::Number(upper))));
    }
    let pressed = at(Some(0.1));
    assert_eq!((pressed.reading, pressed.figure), (Reading::Outside, Some(Figure::Number(0.1))));
    assert!(pressed.meaning.to_string().contains("re-examine the geometry"));
}

#[test]
fn a_ratio_away_from_the_critical_one_is_a_sideswipe() {
    let ratio = |fraction| {
        let collision = Collision { impulse_ratio: ImpulseRatio::OfCritical(fraction), ..crash(39) };
        asked(&diagnose(collision, [None, None]), Question::ImpulseRatio).clone()
    };
    assert_eq!(ratio(1.0).reading, Reading::Within);
    assert_eq!(ratio(0.901).reading, Reading::Within);
    assert_eq!(ratio(0.899).reading, Reading::Outside);
    let sideswipe = ratio(0.5);
    assert!((sideswipe.figure.expect("checked").value() - 0.5).abs() < 1e-6);
    assert!(sideswipe.reading == Reading::Outside && sideswipe.meaning.to_string().contains("sideswipe"));
    // No solution has more than the critical ratio, so one is changed by hand.
    let (question, solution) = solved(Collision { impulse_ratio: ImpulseRatio::Critical, ..crash(39) }, &[]);
    for (factor, reading) in [(1.01, Reading::Outside), (-0.5, Reading::Outside)] {
        let mut changed = solution.clone();
        changed.impact.impulse.t *= factor;
        assert_eq!(asked(&changed.diagnose(&question, &[None, None]), Question::ImpulseRatio).reading, reading, "{factor}");
    }
}
