//! Momentum: `linear-momentum`, `angular-momentum`, `line-of-action`.

use super::judge::{Judge, Residual};
use super::key::Key;
use super::known::Known;
use super::rule::Rule;
use super::say::Digits;
use super::subject::Subject;
use super::uncertain::Uncertain;
use crate::frame::Xy;
use crate::input::Side;
use alloc::format;

const AXES: [&str; 2] = ["x", "y"];

/// The length of a vector's values.
pub(super) fn length<const N: usize>(v: &Xy<Uncertain<N>>) -> f64 {
    Xy { x: v.x.value, y: v.y.value }.length()
}

pub(super) fn number_of(side: Side) -> usize {
    side as usize + 1
}

pub(super) fn check<const N: usize>(known: &Known<'_, N>, judge: &mut Judge) {
    linear(known, judge);
    angular(known, judge);
    for side in [Side::One, Side::Two] {
        line_of_action(known, side, judge);
    }
}

fn linear<const N: usize>(known: &Known<'_, N>, judge: &mut Judge) {
    for side in [Side::One, Side::Two] {
        if known.subject(side).fixed {
            fixed_stays(known, side, judge);
        }
    }
    let (Some(p1), Some(p2)) = (known.one.momentum_gained(), known.two.momentum_gained()) else { return };
    let scale = length(&p1) + length(&p2);
    let both = [(p1.x, p2.x), (p1.y, p2.y)];
    judge.all_zero(Rule::LinearMomentum, both.map(|(a, b)| Residual::new(a + b, scale)), |axis, size, bound| {
        let (a, b) = both[axis];
        format!(
            "along {} body 1 gains {} N s and body 2 {} N s, which do not cancel: {} N s appear, {} may",
            AXES[axis],
            Digits(a.value),
            Digits(b.value),
            Digits(size),
            Digits(bound)
        )
    });
}

/// A fixed body keeps its velocity, if a record has one for it after the impact.
fn fixed_stays<const N: usize>(known: &Known<'_, N>, side: Side, judge: &mut Judge) {
    let keys = [[Key::BeforeX(side), Key::AfterX(side)], [Key::BeforeY(side), Key::AfterY(side)]];
    let changes = keys.map(|[before, after]| {
        let before = known.number(before).unwrap_or(Uncertain::exact(0.0));
        known.number(after).map(|after| after - before)
    });
    let [Some(x), Some(y)] = changes else { return };
    // One meter a second for want of a speed of its own.
    let residuals = [x, y].map(|change| Residual::new(change, change.size.max(1.0)));
    judge.all_zero(Rule::LinearMomentum, residuals, |axis, size, bound| {
        let (number, axis) = (number_of(side), AXES[axis]);
        format!("body {number} is fixed and changes its velocity along {axis} by {} m/s, {} may", Digits(size), Digits(bound))
    });
}

/// The change of angular momentum of a body about a point at `arm` from its center of mass, I ΔΩ − r × m ΔV, and the size of its parts.
fn angular_momentum_gained<const N: usize>(subject: &Subject<N>, arm: Xy<Uncertain<N>>) -> Option<(Uncertain<N>, f64)> {
    let (spin, gained) = (subject.spin_gained()?, subject.momentum_gained()?);
    let scale = spin.value.abs() + length(&arm) * length(&gained);
    Some((spin - arm.cross(gained), scale))
}

fn angular<const N: usize>(known: &Known<'_, N>, judge: &mut Judge) {
    let (one, two) = (&known.one, &known.two);
    let (Some(c1), Some(c2)) = (one.center, two.center) else { return };
    // About the contact point where it is known: momentum that is not conserved shows least there. Else about center of mass 1.
    let arms = one.arm.zip(two.arm).unwrap_or((Xy::zero(), c1 - c2));
    let (Some((l1, s1)), Some((l2, s2))) = (angular_momentum_gained(one, arms.0), angular_momentum_gained(two, arms.1)) else { return };
    judge.zero(Rule::AngularMomentum, Residual::new(l1 + l2, s1 + s2), |size, bound| {
        let about = if one.arm.is_some() { "the contact point" } else { "center of mass 1" };
        format!(
            "about {about} body 1 gains {} N m s of angular momentum and body 2 {} N m s, which do not cancel: {} N m s appear, {} may",
            Digits(l1.value),
            Digits(l2.value),
            Digits(size),
            Digits(bound)
        )
    });
}

fn line_of_action<const N: usize>(known: &Known<'_, N>, side: Side, judge: &mut Judge) {
    let subject = known.subject(side);
    if subject.fixed {
        return;
    }
    let Some((gained, scale)) = subject.arm.and_then(|arm| angular_momentum_gained(subject, arm)) else { return };
    judge.zero(Rule::LineOfAction, Residual::new(gained, scale), |size, bound| {
        let spin = subject.spin_gained().map_or(0.0, |spin| spin.value);
        format!(
            "body {} gains a spin of {} N m s, and its impulse at the contact point gives {} N m s: {} N m s too many, {} may be",
            number_of(side),
            Digits(spin),
            Digits(spin - gained.value),
            Digits(size),
            Digits(bound)
        )
    });
}
