//! Claims of a program, each compared with the masses and motions that are known.

use super::*;
use crate::law::Law;
use alloc::vec;
use core::f64::consts::PI;

/// Sets numbers of a record.
pub(super) fn with(mut record: Record, numbers: &[(Key, f64)]) -> Record {
    numbers.iter().for_each(|&(key, value)| record.set(key, value));
    record
}

/// Body 1 of 1000 kg goes from −10 to −2 m/s along n and to 1 m/s across it; body 2 of 2000 kg, ahead of it, from 3 to −1 and −0.5 m/s.
fn without_spins() -> Record {
    use Key::{AfterX, AfterY, BeforeX, BeforeY, Mass, NormalAngle};
    use Side::{One, Two};
    let one = [(Mass(One), 1000.0), (BeforeX(One), -10.0), (BeforeY(One), 0.0), (AfterX(One), -2.0), (AfterY(One), 1.0)];
    let two = [(Mass(Two), 2000.0), (BeforeX(Two), 3.0), (BeforeY(Two), 0.0), (AfterX(Two), -1.0), (AfterY(Two), -0.5)];
    with(with(with(Record::default(), &one), &two), &[(NormalAngle, 0.0)])
}

/// Masses, velocities and the normal tell the impulse; neither spins nor places are needed.
#[test]
fn the_impulse_of_masses_and_velocities_refutes_claims() {
    let said = |claims: &[(Key, f64)]| rules(&with(without_spins(), claims));
    assert!(said(&[(Key::NormalImpulse, 8000.0), (Key::TangentialImpulse, 1000.0), (Key::ReportedRatio, 0.125)]).is_empty());
    assert_eq!(said(&[(Key::NormalImpulse, -8000.0)]), ["reported"]);
    assert_eq!(said(&[(Key::TangentialImpulse, 1001.0)]), ["reported"]);
    assert_eq!(said(&[(Key::ReportedRatio, 0.5)]), ["reported"]);
    let of_kind = |ratio_kind, claims: &[(Key, f64)]| {
        rules(&with(Record { model: Model { ratio_kind, ..Model::default() }, ..without_spins() }, claims))
    };
    assert!(of_kind(RatioKind::Given, &[(Key::ImpulseRatio, 0.125)]).is_empty());
    assert_eq!(of_kind(RatioKind::Given, &[(Key::ImpulseRatio, 0.5)]), ["impulse-ratio"]);
    assert!(of_kind(RatioKind::Friction, &[(Key::ImpulseRatio, 0.2)]).is_empty());
    assert_eq!(of_kind(RatioKind::Friction, &[(Key::ImpulseRatio, 0.1)]), ["impulse-ratio"]);
    // The impulse on body 1 is along n, so that body 2 lies behind it.
    let centers = |n: f64| {
        said(&[
            (Key::CenterX(Side::One), 0.0),
            (Key::CenterY(Side::One), 0.0),
            (Key::CenterX(Side::Two), n),
            (Key::CenterY(Side::Two), 1.0),
        ])
    };
    assert_eq!((centers(-2.0), centers(2.0)), (vec![], vec!["compressive"]));
    let claimed = |impulse: f64| {
        let places = [
            (Key::CenterX(Side::One), 0.0),
            (Key::CenterY(Side::One), 0.0),
            (Key::CenterX(Side::Two), 2.0),
            (Key::CenterY(Side::Two), 0.0),
        ];
        rules(&with(Record::default(), &[&places[..], &[(Key::NormalAngle, 0.0), (Key::NormalImpulse, impulse)]].concat()))
    };
    assert_eq!([-5000.0, 1e-10, 5000.0].map(claimed), [vec![], vec![], vec!["compressive"]]);
}

/// What one body tells of the impulse holds for the other.
#[test]
fn half_of_the_motions_refutes_claims() {
    use Key::{AfterX, AfterY, BeforeX, BeforeY, DeltaV, EnergyAfter, EnergyBefore, EnergyLoss, ForceDirection, Heading, Mass};
    use Side::{One, Two};
    let one = [(Mass(One), 1000.0), (BeforeX(One), -10.0), (BeforeY(One), 0.0), (AfterX(One), 2.0), (AfterY(One), 0.0)];
    let said = |claims: &[(Key, f64)]| rules(&with(with(Record::default(), &one), claims));
    let of_two = |delta_v: f64| said(&[(Mass(Two), 2000.0), (DeltaV(Two), delta_v)]);
    assert_eq!([6.0, 5.9, 7.0].map(of_two), [vec![], vec!["reported"], vec!["reported"]]);
    // The force on body 2, which heads along x, comes from ahead.
    let from = |direction: f64| said(&[(Heading(Two), 0.0), (ForceDirection(Two), direction)]);
    assert_eq!([0.0, 1.0].map(from), [vec![], vec!["reported"]]);
    let part = |impulse: f64| said(&[(Key::NormalImpulse, impulse)]);
    assert_eq!([-12000.0, 11000.0, 13000.0].map(part), [vec![], vec![], vec!["reported"]]);
    let of_changes = |impulse: f64| {
        let claims = [(Mass(One), 1000.0), (DeltaV(One), 10.0), (Mass(Two), 2000.0), (DeltaV(Two), 5.0), (Key::TangentialImpulse, impulse)];
        rules(&with(Record::default(), &claims))
    };
    assert_eq!([-10_000.0, 9000.0, -10_001.0].map(of_changes), [vec![], vec![], vec!["reported"]]);
    // 50 kJ of translation before, and 2 kJ after.
    let before = |energy: f64| said(&[(EnergyBefore, energy)]);
    assert_eq!([60e3, 50e3, 49e3].map(before), [vec![], vec![], vec!["reported"]]);
    // With 8 kJ of the spin of body 2.
    let with_spin = |energy: f64| said(&[(Key::YawInertia(Two), 1000.0), (Key::BeforeYawRate(Two), 4.0), (EnergyBefore, energy)]);
    assert_eq!([58e3, 57e3].map(with_spin), [vec![], vec!["reported"]]);
    let after = |energy: f64| said(&[(EnergyAfter, energy)]);
    assert_eq!([3e3, 2e3, 1.9e3].map(after), [vec![], vec![], vec!["reported"]]);
    let lost = |loss: f64| said(&[(EnergyBefore, 60e3), (EnergyLoss, loss)]);
    assert_eq!([0.0, 58e3, 58.1e3].map(lost), [vec![], vec![], vec!["reported"]]);
    // What moves after the impact moved before it.
    let of_after = |energy: f64| {
        rules(&with(Record::default(), &[(Mass(One), 1000.0), (AfterX(One), 6.0), (AfterY(One), 8.0), (EnergyBefore, energy)]))
    };
    assert_eq!([50e3, 49e3].map(of_after), [vec![], vec!["reported"]]);
    let wall = Subject { fixed: true, before: State { velocity: Some(Xy { x: 3.0, y: 0.0 }), yaw_rate: None }, ..Subject::default() };
    let beside_wall = Record { two: wall, ..Record::default() };
    let claims = [(Mass(One), 1000.0), (AfterX(One), 6.0), (AfterY(One), 8.0), (EnergyBefore, 1e3)];
    assert!(rules(&with(beside_wall, &claims)).is_empty(), "a wall that moves gives energy to what it hits");
}

/// A zero is one, and an elastic impact loses nothing, whatever else is known.
#[test]
fn claims_of_nothing_are_held() {
    let said = |claims: &[(Key, f64)]| rules(&with(Record::default(), claims));
    let parting = |e: f64, speed: f64| said(&[(Key::Restitution, e), (Key::SeparationSpeed, speed)]);
    assert_eq!(
        (parting(0.0, 0.0), parting(0.0, 1e-14), parting(0.1, 1.0), parting(0.0, 1.0)),
        (vec![], vec![], vec![], vec!["restitution"])
    );
    let work = |e: f64, work: f64| said(&[(Key::Restitution, e), (Key::NormalWork, work)]);
    assert_eq!((work(1.0, -1e-9), work(1.0, 1e-9), work(0.9, -1000.0), work(1.0, -1000.0)), (vec![], vec![], vec![], vec!["reported"]));
    let moment = |moment: f64, work: f64| said(&[(Key::Moment, moment), (Key::MomentWork, work)]);
    assert_eq!((moment(0.0, 0.0), moment(10.0, -500.0), moment(0.0, -500.0)), (vec![], vec![], vec!["reported"]));
    let ratio = |ratio: f64, key: Key, value: f64| said(&[(Key::ReportedRatio, ratio), (key, value)]);
    for (key, rounding) in [(Key::TangentialImpulse, 1e-9), (Key::TangentialWork, -1e-9)] {
        assert_eq!((ratio(0.0, key, rounding), ratio(0.3, key, -5.0), ratio(0.0, key, -5.0)), (vec![], vec![], vec!["impulse-ratio"]));
    }
    let critical = |law, claims: &[(Key, f64)]| {
        rules(&with(Record { model: Model { ratio_kind: RatioKind::Critical, law, ..Model::default() }, ..Record::default() }, claims))
    };
    let both = |ratio: f64| [(Key::CriticalRatio, 0.6), (Key::ReportedRatio, ratio)];
    assert_eq!((critical(Law::Brach, &both(0.6)), critical(Law::Brach, &both(0.2))), (vec![], vec!["impulse-ratio"]));
    assert!(critical(Law::KudlichSlibar, &both(0.2)).is_empty(), "the ratio that is reported is that of Brach's law");
    let fixed = |speed: f64| {
        let wall = Subject { fixed: true, ..Subject::default() };
        rules(&with(Record { two: wall, ..Record::default() }, &[(Key::EquivalentEnergySpeed(Side::Two), speed)]))
    };
    assert_eq!([0.0, 3.0].map(fixed), [vec![], vec!["reported"]]);
    // More energy than there was may be the rounding of no claim, but is no proof: the tangential impulse may do work.
    let warned = |speed: f64| {
        let record = with(
            Record::default(),
            &[(Key::Mass(Side::One), 1000.0), (Key::EquivalentEnergySpeed(Side::One), speed), (Key::EnergyBefore, 50e3)],
        );
        check(&record, &Options::default()).verdict()
    };
    assert_eq!([9.0, 30.0].map(warned), [Verdict::Pass, Verdict::Warn]);
}

/// An elastic impact without tangential impulse loses nothing.
#[test]
fn a_loss_needs_a_work() {
    let said = |kind, claims: &[(Key, f64)]| {
        rules(&with(Record { model: Model { ratio_kind: kind, ..Model::default() }, ..Record::default() }, claims))
    };
    for (kind, key) in [
        (RatioKind::Given, Key::ImpulseRatio),
        (RatioKind::Friction, Key::ImpulseRatio),
        (RatioKind::Critical, Key::ReportedRatio),
        (RatioKind::Critical, Key::TangentialImpulse),
    ] {
        let lost = |e: f64, number: f64, loss: f64| said(kind, &[(Key::Restitution, e), (key, number), (Key::EnergyLoss, loss)]);
        assert_eq!([lost(1.0, 0.0, 0.0), lost(1.0, 0.0, 500.0)], [vec![], vec!["reported"]], "{key}");
        assert!([lost(0.9, 0.0, 500.0), lost(1.0, 0.1, 500.0)].concat().is_empty(), "{key}");
        // 1000 N s at 5 and 1 m/s do 2 kJ.
        let speeds = |loss: f64| {
            let speeds = [(Key::NormalImpulse, 1000.0), (Key::ClosingSpeed, 5.0), (Key::SeparationSpeed, 1.0)];
            said(kind, &[&speeds[..], &[(key, 0.0), (Key::EnergyLoss, loss)]].concat())
        };
        assert_eq!([2000.0, 2001.0, 1999.0].map(speeds), [vec![], vec!["reported"], vec!["reported"]], "{key}");
    }
    let of_critical = [(Key::Restitution, 1.0), (Key::ImpulseRatio, 0.0), (Key::EnergyLoss, 500.0)];
    assert!(said(RatioKind::Critical, &of_critical).is_empty(), "the number of a critical ratio says nothing");
}

/// What a change of velocity leaves of the relative speed has at most the energy that there was: by Cauchy's inequality the two are equal where the impulse is
/// along the relative velocity.
#[test]
fn an_impulse_is_at_most_that_of_the_energy() {
    use Key::{BeforeX, BeforeY, BeforeYawRate, DeltaV, EnergyLoss, ImpulseMagnitude, Mass, YawInertia};
    use Side::{One, Two};
    // Reduced mass 1200 kg, and 5 m/s: 15 kJ; spins of 9 kJ and 0.
    let bodies =
        [(Mass(One), 2000.0), (BeforeX(One), 4.0), (BeforeY(One), 0.0), (Mass(Two), 3000.0), (BeforeX(Two), 1.0), (BeforeY(Two), 4.0)];
    let spins = [(YawInertia(One), 2000.0), (BeforeYawRate(One), 3.0), (YawInertia(Two), 4000.0), (BeforeYawRate(Two), 0.0)];
    let still = [(BeforeYawRate(One), 0.0), (BeforeYawRate(Two), 0.0)];
    let said = |spins: &[(Key, f64)], claims: &[(Key, f64)]| rules(&with(with(Record::default(), &bodies), &[spins, claims].concat()));
    let most = |all: f64, loss: f64| 1200.0 * (5.0 + (2.0 * (all - loss) / 1200.0).sqrt());
    for loss in [0.0, 5e3, 15e3] {
        for (spins, all) in [(&still[..], 15e3), (&spins[..], 24e3)] {
            let of = |part: f64| {
                let impulse = part * most(all, loss);
                [(ImpulseMagnitude, impulse), (DeltaV(One), impulse / 2000.0), (DeltaV(Two), impulse / 3000.0)]
                    .map(|claim| said(spins, &[claim, (EnergyLoss, loss)]))
            };
            assert!(of(1.0 - 1e-9).concat().is_empty(), "{loss} {all}");
            assert_eq!(of(1.001), [vec!["reported"], vec!["reported"], vec!["reported"]], "{loss} {all}");
        }
    }
    assert!(said(&[], &[(DeltaV(One), 20.0)]).is_empty(), "spins that are not known may have any energy");
    // Beside a wall the reduced mass is that of the other body, and a wall that moves may give what is lost.
    let beside = |speed: f64, impulse: f64, loss: f64| {
        let wall = Subject { fixed: true, before: State { velocity: Some(Xy { x: speed, y: 0.0 }), yaw_rate: None }, ..Subject::default() };
        let claims = [(Mass(One), 1000.0), (BeforeX(One), -10.0), (BeforeY(One), 0.0), (BeforeYawRate(One), 0.0)];
        rules(&with(Record { two: wall, ..Record::default() }, &[&claims[..], &[(ImpulseMagnitude, impulse), (EnergyLoss, loss)]].concat()))
    };
    assert_eq!([beside(0.0, 20e3, 0.0), beside(0.0, 20.1e3, 0.0), beside(0.0, 18e3, 30e3)], [vec![], vec!["reported"], vec!["reported"]]);
    assert_eq!([beside(5.0, 30e3, 0.0), beside(5.0, 30.1e3, 0.0), beside(5.0, 25e3, 60e3)], [vec![], vec!["reported"], vec![]]);
}

/// Bodies that stand after an impact without restitution have speeds that are the rounding of what they had before, which a record may leave out.
#[test]
fn what_stands_after_the_impact_is_rounding() {
    use Key::{AfterX, AfterY, AfterYawRate, CenterX, CenterY, Mass, NormalAngle, PointX, PointY, SeparationSpeed};
    let of_body = |side: Side, x: f64, v: f64| {
        [(Mass(side), 1e3), (CenterX(side), x), (CenterY(side), 0.0), (AfterX(side), v), (AfterY(side), 0.0), (AfterYawRate(side), 0.0)]
    };
    let said = |v: f64, speed: f64| {
        let contact = [(PointX, 0.0), (PointY, 0.0), (NormalAngle, 0.0), (SeparationSpeed, speed)];
        rules(&with(Record::default(), &[&of_body(Side::One, -2.0, 0.0)[..], &of_body(Side::Two, 2.0, v), &contact].concat()))
    };
    assert!(said(-1e-15, 2e-15).is_empty() && said(1.0, 1.0).is_empty());
    assert_eq!((said(-1.0, 1.0), said(1.0, 2.0)), (vec!["interpenetration"], vec!["reported"]));
}

/// Works and losses of an elastic impact are rounding, beside whatever shows its size.
#[test]
fn what_an_elastic_impact_loses_is_rounding() {
    let thrown_back = with(
        Record { two: Subject { fixed: true, ..Subject::default() }, ..Record::default() },
        &[
            (Key::Mass(Side::One), 2000.0),
            (Key::BeforeX(Side::One), 30.0),
            (Key::BeforeY(Side::One), 0.0),
            (Key::AfterX(Side::One), -30.0),
            (Key::AfterY(Side::One), 0.0),
        ],
    );
    let said = |claims: &[(Key, f64)]| rules(&with(Record::default(), claims));
    for rounding in [3.5e-10, -3.5e-10] {
        assert!(rules(&with(thrown_back.clone(), &[(Key::NormalWork, rounding)])).is_empty());
        assert!(said(&[(Key::EnergyLoss, rounding), (Key::EnergyAfter, 1.41e6)]).is_empty());
        assert!(said(&[(Key::EnergyLoss, rounding)]).is_empty() && said(&[(Key::NormalWork, rounding)]).is_empty());
    }
    assert!(!rules(&with(thrown_back, &[(Key::NormalWork, 1e3)])).is_empty());
    assert!(!said(&[(Key::EnergyLoss, -1e3), (Key::EnergyAfter, 1.41e6)]).is_empty() && !said(&[(Key::EnergyLoss, -1.0)]).is_empty());
}

/// The impulse over a change of velocity is the mass of a body, with which equivalent energy speeds have an energy; of a small part of the other change it is too coarse.
#[test]
fn masses_by_the_impulse_refute_equivalent_energy_speeds() {
    use Key::{DeltaV, EnergyLoss, EquivalentEnergySpeed, ImpulseMagnitude, NormalWork};
    let said = |record: Record, changes: [f64; 2], speeds: [f64; 2], impulse: f64, work: f64| {
        let of_bodies = Side::ALL.into_iter().zip(changes.into_iter().zip(speeds)).filter(|(_, (change, _))| *change > 0.0);
        let of_bodies = of_bodies.flat_map(|(side, (change, speed))| [(DeltaV(side), change), (EquivalentEnergySpeed(side), speed)]);
        let claims: Vec<(Key, f64)> = of_bodies.chain([(ImpulseMagnitude, impulse), (NormalWork, work), (EnergyLoss, -work)]).collect();
        rules(&with(record, &claims))
    };
    // 1000 kg and 2000 kg, with 18 kJ and 9 kJ.
    let of_both = |impulse: f64, one: f64, work: f64| said(Record::default(), [12.0, 6.0], [one, 3.0], impulse, work);
    assert_eq!(of_both(12e3, 6.0, -27e3), Vec::<&str>::new());
    for [impulse, one, work] in [[12.1e3, 6.0, -27e3], [11.9e3, 6.0, -27e3], [12e3, 6.1, -27e3], [12e3, 6.0, -27.5e3]] {
        assert_eq!(of_both(impulse, one, work), ["reported"], "{impulse} {one} {work}");
    }
    let wall = || Record { two: Subject { fixed: true, ..Subject::default() }, ..Record::default() };
    let against_wall = |change: f64, speed: f64| said(wall(), [change, 0.0], [speed, 0.0], 12e3, -18e3);
    assert_eq!(against_wall(12.0, 6.0), Vec::<&str>::new());
    assert_eq!([against_wall(12.0, 5.0), against_wall(11.0, 6.0)], [["reported"], ["reported"]]);
    let light = |change: f64| said(Record::default(), [12.0, change], [6.0, 1.0], 12e3, -27e3);
    assert_eq!([light(0.1), light(0.13)], [vec![], vec!["reported"]]);
    assert_eq!(beside_motions_of_one(6.0), Vec::<&str>::new());
    assert_eq!(beside_motions_of_one(5.0), ["reported"]);
}

/// Body 2, whose mass is not known, changes by 4 m/s where body 1 changes by 8 m/s along n: it has 2000 kg and, with 6 m/s, 36 kJ.
fn beside_motions_of_one(speed: f64) -> Vec<&'static str> {
    use Key::{AfterX, AfterY, BeforeX, BeforeY, DeltaV, EnergyLoss, EquivalentEnergySpeed, Mass, NormalWork};
    use Side::{One, Two};
    let one = [(Mass(One), 1000.0), (BeforeX(One), -10.0), (BeforeY(One), 0.0), (AfterX(One), -2.0), (AfterY(One), 0.0)];
    let energies = [(EquivalentEnergySpeed(One), 2.0), (EquivalentEnergySpeed(Two), speed), (NormalWork, -38e3), (EnergyLoss, 38e3)];
    rules(&with(with(Record::default(), &one), &[&energies[..], &[(DeltaV(Two), 4.0)]].concat()))
}

/// The work of the normal impulse is what the loss and the other works leave, and that of an impulse which the motions imply.
#[test]
fn the_work_of_the_normal_impulse_is_held_however_it_is_known() {
    use Key::{ClosingSpeed, EnergyLoss, NormalImpulse, NormalWork, Restitution, SeparationSpeed, TangentialWork};
    let by_loss = |loss: f64, tangential: f64, parting: (Key, f64)| {
        let claims = [(EnergyLoss, loss), (TangentialWork, tangential), (NormalImpulse, -9e3), (ClosingSpeed, 8.0), parting];
        rules(&with(Record::default(), &claims))
    };
    for (loss, tangential, parting, broken) in [
        (30e3, -3e3, (SeparationSpeed, 2.0), vec![]),
        (24e3, 3e3, (Restitution, 0.25), vec![]),
        (30e3, -3e3, (SeparationSpeed, 2.1), vec!["reported"]),
        (30e3, 3e3, (SeparationSpeed, 2.0), vec!["reported"]),
        (31e3, -3e3, (Restitution, 0.25), vec!["reported"]),
    ] {
        assert_eq!(by_loss(loss, tangential, parting), broken, "{loss} {tangential} {parting:?}");
    }
    // At most zero: more than the loss cannot be lost along the tangent.
    let rest = |tangential: f64| rules(&with(Record::default(), &[(EnergyLoss, 10e3), (TangentialWork, tangential)]));
    assert_eq!([-9e3, -10e3, -11e3].map(rest), [vec![], vec![], vec!["reported"]]);
    let by_motions = |work: f64| rules(&with(without_spins(), &[(ClosingSpeed, 10.0), (SeparationSpeed, 1.0), (NormalWork, work)]));
    assert_eq!([-36e3, -35e3].map(by_motions), [vec![], vec!["reported"]]);
}

/// Two cars of 1500 kg that close head-on at 15 and −5 m/s and do not spin.
fn head_on() -> Record {
    use Key::{BeforeX, BeforeY, Mass, NormalAngle};
    let of_body = |side, speed| [(Mass(side), 1500.0), (BeforeX(side), speed), (BeforeY(side), 0.0), (Key::BeforeYawRate(side), 0.0)];
    with(Record::default(), &[&of_body(Side::One, 15.0)[..], &of_body(Side::Two, -5.0), &[(NormalAngle, 0.0)]].concat())
}

/// By hand: changes of velocity of 12 m/s, from the front of both, leave 3 and 7 m/s. With either change alone, or as the magnitude of the impulse, too.
#[test]
fn an_impulse_by_magnitude_and_direction_leads_to_motions() {
    let place = |side, x| [(Key::CenterX(side), x), (Key::CenterY(side), 0.0), (Key::YawInertia(side), 2500.0)];
    let places = [&place(Side::One, 0.0)[..], &place(Side::Two, 4.0), &[(Key::PointX, 2.0), (Key::PointY, 0.0)]].concat();
    let head_on = || with(head_on(), &places);
    let headings = [(Key::Heading(Side::One), 0.0), (Key::Heading(Side::Two), PI), (Key::ForceDirection(Side::One), 0.0)];
    let forms = [
        &[(Key::DeltaV(Side::One), 12.0), (Key::DeltaV(Side::Two), 12.0), (Key::ForceDirection(Side::Two), 0.0)][..],
        &[(Key::DeltaV(Side::One), 12.0)],
        &[(Key::ImpulseMagnitude, 18_000.0)],
    ];
    for form in forms {
        let said = |claim| rules(&with(with(head_on(), &headings), &[form, &[claim]].concat()));
        for (key, right, wrong, rule) in [
            (Key::Restitution, 0.2, 0.1, "restitution"),
            (Key::SeparationSpeed, 4.0, 5.0, "reported"),
            (Key::EnergyLoss, 144_000.0, 100_000.0, "reported"),
            (Key::EnergyAfter, 43_500.0, 50_000.0, "reported"),
        ] {
            assert!(
                said((key, right)).is_empty() && said((key, wrong)).contains(&rule),
                "{form:?} {key}: {:?} {:?}",
                said((key, right)),
                said((key, wrong))
            );
        }
    }
    // At a ratio the impulse is from the other body.
    let without_friction = |claim| {
        let model = Model { ratio_kind: RatioKind::Given, impulse_ratio: Some(0.0), ..Model::default() };
        rules(&with(Record { model, ..head_on() }, &[(Key::ImpulseMagnitude, 18_000.0), claim]))
    };
    assert!(without_friction((Key::SeparationSpeed, 4.0)).is_empty());
    assert_eq!(without_friction((Key::SeparationSpeed, 5.0)), ["reported"]);
    // Where body 2 slides past it at −10 m/s, friction pushes body 1 that way: 2 m · 1800 N s/2500 kg m² of spin.
    let sliding = |yaw_rate: f64| {
        let model = Model { ratio_kind: RatioKind::Given, impulse_ratio: Some(0.1), ..Model::default() };
        let of_slide = [(Key::BeforeY(Side::Two), -10.0), (Key::ImpulseMagnitude, 18_000.0 * 1.01_f64.sqrt())];
        rules(&with(Record { model, ..head_on() }, &[&of_slide[..], &[(Key::AfterYawRate(Side::One), yaw_rate)]].concat()))
    };
    assert!(sliding(-1.44).is_empty(), "{:?}", sliding(-1.44));
    assert!(sliding(1.44).contains(&"line-of-action"));
}

/// Without a spin neither inertia, nor places matter.
#[test]
fn a_pair_that_does_not_spin_needs_no_places() {
    let after = |one, two| {
        let of_body = |side, speed| [(Key::AfterX(side), speed), (Key::AfterY(side), 0.0), (Key::AfterYawRate(side), 0.0)];
        with(head_on(), &[of_body(Side::One, one), of_body(Side::Two, two)].concat())
    };
    let said = |record: Record, claim| rules(&with(record, &[claim]));
    for (key, right, wrong, rule) in [
        (Key::Restitution, 0.2, 0.3, "restitution"),
        (Key::ClosingSpeed, 20.0, 40.0, "reported"),
        (Key::EnergyBefore, 187_500.0, 375_000.0, "reported"),
        (Key::EnergyLoss, 144_000.0, 288_000.0, "reported"),
        (Key::NormalWork, -144_000.0, -100_000.0, "reported"),
    ] {
        let [right, wrong] = [right, wrong].map(|value| said(after(3.0, 7.0), (key, value)));
        assert!(right.is_empty() && wrong == [rule], "{key}: {right:?} {wrong:?}");
    }
    assert_eq!(rules(&after(-10.0, 20.0)), ["restitution", "energy-gain"]);
    // Body 2 lies ahead, and they would drive through each other.
    let places =
        [(Key::CenterX(Side::One), 0.0), (Key::CenterY(Side::One), 0.0), (Key::CenterX(Side::Two), 4.0), (Key::CenterY(Side::Two), 0.0)];
    assert!(rules(&with(after(3.0, 7.0), &places)).is_empty());
    assert!(rules(&with(after(12.0, -2.0), &places)).contains(&"interpenetration"));
    // Nor does a wall, and a spin needs a place.
    let wall = |restitution| {
        let mut record = with(after(-3.0, 0.0), &[(Key::Restitution, restitution)]);
        record.two = Subject::FIXED;
        record
    };
    assert!(rules(&wall(0.2)).is_empty());
    assert_eq!(rules(&wall(0.6)), ["restitution"]);
    assert!(rules(&with(wall(0.6), &[(Key::AfterYawRate(Side::One), 0.1)])).is_empty());
}

/// By hand: ½ · 750 · 20² J, and the center of mass of the pair keeps the rest.
#[test]
fn no_more_is_lost_than_the_relative_motion_has() {
    let said = |claims: &[(Key, f64)]| rules(&with(head_on(), claims));
    assert!(said(&[(Key::EnergyLoss, 150_000.0)]).is_empty());
    assert_eq!(said(&[(Key::EnergyLoss, 160_000.0)]), ["reported"]);
    assert_eq!(said(&[(Key::NormalWork, -140_000.0), (Key::TangentialWork, -20_000.0)]), ["reported"]);
    assert_eq!(said(&[(Key::EnergyBefore, 187_500.0), (Key::EnergyAfter, 27_500.0)]), ["reported"]);
    assert!(said(&[(Key::EnergyBefore, 187_500.0), (Key::EnergyAfter, 37_500.0)]).is_empty());
}

/// By hand: 2 · 80 000/16 000 = 10 m/s are (1 − e) of the closing speed, and the separation speed e of it.
#[test]
fn the_work_of_the_normal_impulse_is_that_of_either_speed() {
    let known = [(Key::Restitution, 0.2), (Key::NormalWork, -80_000.0)];
    let said = |claims: &[(Key, f64)]| rules(&with(Record::default(), &[&known[..], claims].concat()));
    for impulse in [&[(Key::NormalImpulse, 16_000.0)][..], &[(Key::TangentialImpulse, 4000.0), (Key::ReportedRatio, 0.25)]] {
        assert!(said(&[impulse, &[(Key::SeparationSpeed, 2.5)]].concat()).is_empty());
        assert_eq!(said(&[impulse, &[(Key::SeparationSpeed, 10.0)]].concat()), ["reported"]);
        assert!(said(&[impulse, &[(Key::ClosingSpeed, 12.5)]].concat()).is_empty());
        assert_eq!(said(&[impulse, &[(Key::ClosingSpeed, 50.0)]].concat()), ["reported"]);
    }
}

#[test]
fn the_ratio_of_a_reported_impulse_is_held_as_a_reported_ratio() {
    let said = |ratio_kind, impulse_ratio, claims: &[(Key, f64)]| {
        rules(&with(Record { model: Model { ratio_kind, impulse_ratio, ..Model::default() }, ..Record::default() }, claims))
    };
    let impulse = |t| [(Key::CriticalRatio, 0.6), (Key::NormalImpulse, 10_000.0), (Key::TangentialImpulse, t)];
    assert!(said(RatioKind::Critical, None, &impulse(6000.0)).is_empty());
    assert!(said(RatioKind::Critical, None, &impulse(3000.0)).contains(&"impulse-ratio"));
    assert!(said(RatioKind::OfCritical, Some(0.5), &impulse(3000.0)).is_empty());
    assert_eq!(said(RatioKind::OfCritical, Some(0.5), &impulse(6000.0)), ["impulse-ratio"]);
    assert_eq!(said(RatioKind::Friction, None, &impulse(7000.0)), ["beyond-critical"]);
    // Without a ratio the tangential impulse does no work: all of the loss is that of the normal one.
    let works = |normal| said(RatioKind::Given, Some(0.0), &[(Key::EnergyLoss, 60_000.0), (Key::NormalWork, normal)]);
    assert!(works(-60_000.0).is_empty());
    assert_eq!(works(-20_000.0), ["impulse-ratio"]);
}
