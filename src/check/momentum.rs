//! Momentum: `linear-momentum`, `angular-momentum`, `line-of-action`.

use super::format::Digits;
use super::judge::{Judge, Residual};
use super::key::Key;
use super::known::Known;
use super::rule::Rule;
use super::subject::{Subject, When};
use super::uncertain::Uncertain;
use crate::frame::Xy;
use crate::input::Side;
use crate::scalar::Field;
use alloc::format;

const AXES: [&str; 2] = ["x", "y"];

/// Returns the length of a vector's values.
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

/// Checks that a fixed body keeps its velocity, if a record has one for it after the impact.
fn fixed_stays<const N: usize>(known: &Known<'_, N>, side: Side, judge: &mut Judge) {
    let keys = [[Key::BeforeX(side), Key::AfterX(side)], [Key::BeforeY(side), Key::AfterY(side)]];
    let changes = keys.map(|[before, after]| Some(known.number(after)? - known.number(before)?));
    let [Some(x), Some(y)] = changes else { return };
    // 1 m/s if it has no speed of its own.
    let residuals = [x, y].map(|change| Residual::new(change, change.size.max(1.0)));
    judge.all_zero(Rule::LinearMomentum, residuals, |axis, size, bound| {
        let (number, axis) = (number_of(side), AXES[axis]);
        format!("body {number} is fixed and changes its velocity along {axis} by {} m/s, {} may", Digits(size), Digits(bound))
    });
}

/// Returns the change of angular momentum of a body about a point at `arm` from its center of mass, I ΔΩ − r × m ΔV, and the size of its parts.
fn angular_momentum_gained<const N: usize>(subject: &Subject<N>, arm: Xy<Uncertain<N>>) -> Option<(Uncertain<N>, f64)> {
    let (spin, gained) = (subject.spin_gained()?, subject.momentum_gained()?);
    let scale = spin.value.abs() + length(&arm) * length(&gained);
    Some((spin - arm.cross(gained), scale))
}

/// Checks that the angular momentum of the pair is the same at the places after the contact, about its center of mass: Σ I ΔΩ + μ (R × W − r × w) = 0, with
/// the reduced mass μ, the position r of center of mass 2 from 1 and its velocity w.
fn angular_of_moved<const N: usize>(known: &Known<'_, N>, judge: &mut Judge) -> Option<()> {
    let (one, two) = (&known.one, &known.two);
    let apart = [two.center? - one.center?, two.center_after? - one.center_after?];
    let past = [When::Before, When::After].map(|when| Some(two.velocity(when)? - one.velocity(when)?));
    let [Some(before), Some(after)] = past else { return None };
    let (m1, m2) = (one.mass?, two.mass?);
    let reduced = m1 * m2 / (m1 + m2);
    let gained = [one.spin_gained()?, two.spin_gained()?];
    let spins = gained[0] + gained[1];
    let orbit = reduced * (apart[1].cross(after) - apart[0].cross(before));
    let exchanged = reduced.value * length(&apart[0]).max(length(&apart[1])) * length(&(after - before));
    judge.zero(Rule::AngularMomentum, Residual::new(spins + orbit, gained.map(|spin| spin.value.abs()).iter().sum::<f64>() + exchanged), |size, bound| {
        format!(
            "from the places before to those after, the spins gain {} N m s of angular momentum and the motion of the centers of mass {} N m s, which do not \
             cancel: {} N m s appear, {} may",
            Digits(spins.value),
            Digits(orbit.value),
            Digits(size),
            Digits(bound)
        )
    });
    Some(())
}

fn angular<const N: usize>(known: &Known<'_, N>, judge: &mut Judge) {
    let (one, two) = (&known.one, &known.two);
    if angular_of_moved(known, judge).is_some() {
        return;
    }
    let (Some(c1), Some(c2)) = (one.center, two.center) else { return };
    // About the contact point if known, where non-conserved momentum has the smallest effect. Otherwise about center of mass 1.
    let arms = one.arm.zip(two.arm).unwrap_or((Xy::zero(), c1 - c2));
    let (Some((l1, s1)), Some((l2, s2))) = (angular_momentum_gained(one, arms.0), angular_momentum_gained(two, arms.1)) else { return };
    let leeway = known.travel.moment_leeway(known.impulse_value());
    judge.zero(Rule::AngularMomentum, Residual::new(l1 + l2, s1 + s2).open(0.0, leeway), |size, bound| {
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

/// Checks that the angular momentum of a body about the contact point changes by the moment impulse alone.
fn line_of_action<const N: usize>(known: &Known<'_, N>, side: Side, judge: &mut Judge) {
    let subject = known.subject(side);
    if subject.fixed {
        return;
    }
    // The impulse acts between the arms before and after.
    let arm = subject.arm.zip(subject.arm_after).map(|(before, after)| (before + after).map(Uncertain::half));
    let Some((gained, scale)) = arm.and_then(|arm| angular_momentum_gained(subject, arm)) else { return };
    let impulse = known.impulse_value();
    let (slack, leeway) = (known.travel.moment_slack(side, impulse), known.travel.moment_leeway(impulse));
    let moment = known.moment.map_or(Uncertain::exact(0.0), |moment| if side == Side::One { moment } else { -moment });
    let (gained, scale) = (gained - moment, scale + moment.value.abs());
    let cause = if known.moment.is_some() {
        "its impulse at the contact point and the moment give"
    } else {
        "its impulse at the contact point gives"
    };
    judge.zero(Rule::LineOfAction, Residual::new(gained, scale).open(slack, leeway), |size, bound| {
        let spin = subject.spin_gained().map_or(0.0, |spin| spin.value);
        format!(
            "body {} gains a spin of {} N m s, and {cause} {} N m s: {} N m s off, {} may be",
            number_of(side),
            Digits(spin),
            Digits(spin - gained.value),
            Digits(size),
            Digits(bound)
        )
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bodies_are_counted_from_one() {
        assert_eq!([Side::One, Side::Two].map(number_of), [1, 2]);
    }
}
