//! Rules along the normal: `compressive`, `interpenetration`, `restitution`.

use super::format::Digits;
use super::judge::{IMPULSE, Judge, Residual, SPEED};
use super::key::Key;
use super::known::{Known, Touch};
use super::model::RatioKind;
use super::rule::{Rule, Severity};
use super::uncertain::Uncertain;
use crate::frame::Nt;
use crate::law::Law;
use alloc::format;

/// Returns the length of a vector's values.
pub(super) fn length<const N: usize>(v: &Nt<Uncertain<N>>) -> f64 {
    Nt { n: v.n.value, t: v.t.value }.length()
}

/// Returns the length of what makes up the components of a vector, some of which may cancel.
fn length_of_terms<const N: usize>(v: &Nt<Uncertain<N>>) -> f64 {
    Nt { n: v.n.size, t: v.t.size }.length()
}

pub(super) fn check<const N: usize>(known: &Known<'_, N>, judge: &mut Judge) {
    restitution_in_range(known, judge);
    along_the_normal(known, judge);
    match &known.touch {
        Some(touch) => restitution(known, touch, judge),
        None => restitution_of_claims(known, judge),
    }
}

/// Checks `compressive` and `interpenetration`. The sign of s, the normal component of center of mass 2 less center of mass 1, determines the compressive
/// direction; of point masses the approach does.
fn along_the_normal<const N: usize>(known: &Known<'_, N>, judge: &mut Judge) {
    let [approach, separation] = [known.before, known.after].map(|meeting| meeting.map(|meeting| meeting.velocity));
    let meeting = known.before.or(known.after);
    let claimed = || known.number(Key::NormalImpulse).map(|claimed| Residual::new(claimed, claimed.value.abs()).beside(IMPULSE));
    let impulse = known.contact_impulse.map(|impulse| Residual::new(impulse.n, length(&impulse))).or_else(claimed);
    let (Some(offset), true) = (known.offset, meeting.is_some() || impulse.is_some()) else { return };
    let offset = Residual::new(offset.n, length(&offset));
    // Point masses may come from either side, and then the other body lies ahead.
    let side = if meeting.is_some_and(|meeting| meeting.is_of_points) {
        let Some(approach) = approach else { return };
        judge.sign(Rule::Compressive, &Residual::new(-approach.n, length(&approach)))
    } else {
        judge.sign(Rule::Compressive, &offset)
    };
    let Some(side) = side else {
        if meeting.is_some() {
            no_side(offset, judge);
        }
        return;
    };
    if let Some(impulse) = impulse {
        judge.not_above(Rule::Compressive, impulse.per(side), |size, bound| {
            format!("the normal impulse pulls the bodies together with {} N s, {} may be", Digits(size), Digits(bound))
        });
    }
    let Some(meeting) = meeting else { return };
    // Bodies that stick have no velocity after the impact by which to judge that it is none.
    let speed = if approach.is_some() { length(&meeting.velocity) } else { length_of_terms(&meeting.velocity) };
    let apart = |v: Uncertain<N>| Residual::new(v.scaled(side), speed);
    if let Some(approach) = approach {
        judge.not_above(Rule::Compressive, apart(approach.n), |size, bound| {
            format!("before the impact the bodies part along the normal at {} m/s, {} may be", Digits(size), Digits(bound))
        });
    }
    if let Some(separation) = separation {
        let apart = apart(-separation.n).open(0.0, known.travel.velocity_leeway());
        // Bodies that stand after the impact have the rounding of speeds before it.
        let apart = if approach.is_none() { apart.beside(SPEED) } else { apart };
        judge.not_above(Rule::Interpenetration, apart, |size, bound| {
            format!(
                "after the impact the bodies approach each other still along the normal at {} m/s, {} may be",
                Digits(size),
                Digits(bound)
            )
        });
    }
}

/// Reports that the offset along the normal does not determine the compressive direction.
fn no_side<const N: usize>(offset: Residual<N>, judge: &mut Judge) {
    judge.checks(Rule::Compressive);
    judge.checks(Rule::Interpenetration);
    let bound = judge.bound(Rule::Compressive, &offset);
    let size = offset.value.value.abs();
    if offset.value.radius() > 0.0 {
        judge.undecidable(Rule::Compressive, size, bound.total, offset.scale);
        judge.undecidable(Rule::Interpenetration, size, bound.total, offset.scale);
    } else if size > 0.0 {
        // The tolerance of a law is no precision of positions.
        let what = format!(
            "the centers of mass are {} m apart along the normal, within the tolerance of {} m, so the compressive direction is unknown",
            Digits(size),
            Digits(bound.total)
        );
        judge.push(Rule::Compressive, Severity::Undecidable, size, bound.total, what);
    } else {
        let what = format!("the centers of mass are abreast: {} m apart along the normal, so no approach along it closes", Digits(size));
        judge.fail(Rule::Compressive, size, bound.total, what);
    }
}

fn restitution_in_range<const N: usize>(known: &Known<'_, N>, judge: &mut Judge) {
    let Some(claimed) = known.number(Key::Restitution) else { return };
    let e = claimed.value;
    judge.not_above(Rule::Restitution, Residual::new(claimed - Uncertain::exact(1.0), 1.0), |_, _| {
        let percent = if (2.0..=100.0).contains(&e) { "; a percentage?" } else { "" };
        format!("the restitution is said to be {}, which is above 1{percent}", Digits(e))
    });
    judge.not_above(Rule::Restitution, Residual::new(-claimed, 1.0), |_, _| {
        format!("the restitution is said to be {}, which is below 0", Digits(e))
    });
}

/// Checks V_n = −e v_n, as a share of v_n.
fn restitution<const N: usize>(known: &Known<'_, N>, touch: &Touch<N>, judge: &mut Judge) {
    let (approach, separation) = (touch.approach.n, touch.separation.n);
    let closing = Residual::new(approach, length(&touch.approach));
    judge.checks(Rule::Restitution);
    if judge.sign(Rule::Restitution, &closing).is_none() {
        let bound = judge.bound(Rule::Restitution, &closing).total;
        if approach.radius() > 0.0 {
            judge.undecidable(Rule::Restitution, 0.0, bound, approach.value.abs());
        }
        return;
    }
    let v = approach.value;
    let found = -separation.value / v;
    let per_approach = |value: Uncertain<N>| Residual::new(value, v.abs()).open(0.0, known.travel.velocity_leeway()).per(v);
    match known.number(Key::Restitution) {
        Some(claimed) => {
            judge.zero(Rule::Restitution, per_approach(separation + claimed * approach), |size, bound| {
                format!(
                    "the restitution is said to be {}, and the velocities along the normal, {} m/s before and {} m/s after, give {}: {} off, {} may be",
                    Digits(claimed.value),
                    Digits(v),
                    Digits(separation.value),
                    Digits(found),
                    Digits(size),
                    Digits(bound)
                )
            });
        }
        None => judge.not_above(Rule::Restitution, per_approach(-separation - approach), |_, bound| {
            format!(
                "the velocities along the normal give a restitution of {}, which is above 1 by more than {}",
                Digits(found),
                Digits(bound)
            )
        }),
    }
    warn_above_bound(known, touch, known.record.model.restitution.unwrap_or(found), judge);
}

/// Warns of a restitution above √(1 − K_nt²/(K_nn K_tt)) at the critical ratio, which gains energy at some approach velocities, if not at this one.
fn warn_above_bound<const N: usize>(known: &Known<'_, N>, touch: &Touch<N>, e: f64, judge: &mut Judge) {
    let model = &known.record.model;
    // A moment shifts the bound.
    if model.ratio_kind != RatioKind::Critical || model.law != Law::Brach || touch.moment.is_some() {
        return;
    }
    let Some(contact) = touch.values() else { return };
    let bound = libm::sqrt(contact.restitution_bound_for_any_approach_squared());
    if e > bound && e <= 1.0 {
        let what = format!(
            "the restitution {} is above {}: at the critical ratio this contact would gain energy at some approach velocities",
            Digits(e),
            Digits(bound)
        );
        judge.warn(Rule::Restitution, e, bound, what);
    }
}

/// Checks the restitution of speeds that are reported, or that the motions before or after alone give.
fn restitution_of_claims<const N: usize>(known: &Known<'_, N>, judge: &mut Judge) {
    let e = known.number(Key::Restitution);
    if let (Some(e), None, Some(parting)) = (e.filter(Uncertain::is_zero), known.closing_speed(), known.separation_speed()) {
        judge.zero(Rule::Restitution, Residual::new(parting, parting.size.max(known.beside.speed)).beside(SPEED), |size, bound| {
            let (e, size, bound) = (Digits(e.value), Digits(size), Digits(bound));
            format!("the restitution is said to be {e}, and the separation speed {size} m/s, whatever the closing speed is; {bound} may be")
        });
    }
    let (Some(closing), Some(parting)) = (known.closing_speed(), known.separation_speed()) else { return };
    let scale = closing.value.abs().max(known.beside.speed);
    let Some(e) = e else {
        return judge.not_above(
            Rule::Restitution,
            Residual::new(parting - closing, scale.max(parting.value.abs())).open(0.0, known.travel.velocity_leeway()),
            |size, bound| {
                format!(
                    "the closing speed is {} m/s, and the separation speed {} m/s, which is more: {} m/s off, {} may be",
                    Digits(closing.value),
                    Digits(parting.value),
                    Digits(size),
                    Digits(bound)
                )
            },
        );
    };
    // A closing speed of zero has no ratio.
    let (unit, of_unit) = if closing.value != 0.0 { (closing.value.abs(), "their ratio is") } else { (1.0, "in m/s, this is") };
    let residual = Residual::new(parting - e * closing, scale).open(0.0, known.travel.velocity_leeway()).per(unit);
    judge.zero(Rule::Restitution, residual, |size, bound| {
        format!(
            "the restitution is said to be {}, the closing speed is {} m/s and the separation speed {} m/s; {of_unit} {} off, {} may be",
            Digits(e.value),
            Digits(closing.value),
            Digits(parting.value),
            Digits(size),
            Digits(bound)
        )
    });
}
