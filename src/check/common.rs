//! The quantities that the records of a group must share.

use super::claimed_energies::claimed_loss;
use super::claims::norm;
use super::judge::{Judge, Residual};
use super::key::Key;
use super::known::Known;
use super::model::Agreement;
use super::outcome::Common;
use super::rule::Rule;
use super::uncertain::Uncertain;
use crate::input::Side;

/// Collects the quantities that an agreement covers, as far as the record determines them. A claim takes precedence over what the motions imply, since
/// `reported` compares the two.
pub(super) fn collect<const N: usize>(known: &Known<'_, N>, agreement: Agreement, judge: &mut Judge) {
    let mut add = |name, unit, quantity: Option<Uncertain<N>>, scale: f64| {
        if let Some(quantity) = quantity {
            let bound = judge.bound(Rule::Group, &Residual::new(quantity, scale.max(quantity.value.abs()))).total;
            judge.common.push(Common { name, unit, value: quantity.value, bound });
        }
    };
    let lost = claimed_loss(known).or_else(|| known.loss());
    add("energy loss", "J", lost, 0.0);
    if agreement == Agreement::Loss {
        return;
    }
    let impulse = known.impulse.map(norm);
    let length = impulse.map_or(0.0, |impulse| impulse.value);
    add("magnitude of the impulse", "N s", known.number(Key::ImpulseMagnitude).or(impulse), 0.0);
    if agreement == Agreement::Magnitudes {
        return;
    }
    add("impulse along x", "N s", known.impulse.map(|p| p.x), length);
    add("impulse along y", "N s", known.impulse.map(|p| p.y), length);
    for (side, names) in [
        (Side::One, ["velocity of body 1 along x", "velocity of body 1 along y", "yaw rate of body 1"]),
        (Side::Two, ["velocity of body 2 along x", "velocity of body 2 along y", "yaw rate of body 2"]),
    ] {
        let subject = known.subject(side);
        if subject.fixed {
            continue;
        }
        // Of the order of the change in the impact: a component may be almost zero.
        let change = subject.delta_v().map_or(0.0, |delta_v| norm(delta_v).value);
        let turn = subject.yaw_after.zip(subject.yaw_before).map_or(0.0, |(after, before)| (after - before).value.abs());
        add(names[0], "m/s", subject.after.map(|v| v.x), change);
        add(names[1], "m/s", subject.after.map(|v| v.y), change);
        add(names[2], "rad/s", subject.yaw_after, turn);
    }
}
