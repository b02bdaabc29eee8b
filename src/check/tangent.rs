//! Rules along the tangent: `impulse-ratio`, `beyond-critical`.

use super::claimed_energies::{available, rest_of_loss};
use super::format::Digits;
use super::judge::{ENERGY, IMPULSE, Judge, Residual};
use super::key::Key;
use super::known::{Known, Touch};
use super::model::RatioKind;
use super::normal::length;
use super::rule::Rule;
use super::uncertain::Uncertain;
use crate::frame::Nt;
use crate::law::Law;
use alloc::format;
use alloc::string::String;

pub(super) fn check<const N: usize>(known: &Known<'_, N>, judge: &mut Judge) {
    match known.touch.and_then(|touch| Some((touch, touch.impulse?))) {
        Some((touch, impulse)) => {
            if !can_divide(Residual::new(impulse.n, length(&impulse)), judge)
                || !can_divide(Residual::new(touch.approach.n, length(&touch.approach)), judge)
            {
                return;
            }
            let slip = slip(known.record.model.law, &touch);
            impulse_ratio(known, &touch, impulse, slip, judge);
            beyond_critical(known, &touch, impulse, slip, judge);
            warn_of_ratio(&touch, impulse, judge);
        }
        None => claims(known, judge),
    }
}

/// Returns `true` if a divisor is clearly nonzero. Otherwise there is no ratio; if that is due to the resolution alone, the rules are marked undecidable.
fn can_divide<const N: usize>(divisor: Residual<N>, judge: &mut Judge) -> bool {
    let clear = judge.sign(Rule::ImpulseRatio, &divisor).is_some();
    if !clear && divisor.value.radius() > 0.0 {
        let bound = judge.bound(Rule::ImpulseRatio, &divisor).total;
        for rule in [Rule::ImpulseRatio, Rule::BeyondCritical] {
            judge.checks(rule);
            judge.undecidable(rule, 0.0, bound, divisor.value.value.abs());
        }
    }
    clear
}

/// Returns the tangential velocity after the impact less that at which sliding has ended: V_t, and V_t + e v_t if restitution applies to both components.
fn slip<const N: usize>(law: Law, touch: &Touch<N>) -> Uncertain<N> {
    match law {
        Law::Brach => touch.separation.t,
        // e = −V_n/v_n.
        Law::KudlichSlibar => touch.approach.cross(touch.separation) / touch.approach.n,
    }
}

/// Checks the ratio of the model.
fn impulse_ratio<const N: usize>(known: &Known<'_, N>, touch: &Touch<N>, impulse: Nt<Uncertain<N>>, slip: Uncertain<N>, judge: &mut Judge) {
    let rule = Rule::ImpulseRatio;
    let model = &known.record.model;
    let claimed = known.number(Key::ImpulseRatio);
    let ratio = impulse.t.value / impulse.n.value;
    let sliding_ended = |judge: &mut Judge, why: &str| {
        let residual = Residual::new(slip, length(&touch.approach)).open(0.0, known.travel.velocity_leeway());
        judge.zero(rule, residual, |size, bound| {
            let end = if model.law == Law::Brach { "has" } else { "and its restitution have" };
            format!("{why}, so sliding {end} ended, but {} m/s of it are left, {} may be", Digits(size), Digits(bound))
        });
    };
    let has_ratio = |judge: &mut Judge, wanted: Uncertain<N>, words: &str| {
        let scale = length(&impulse).max(wanted.value.abs() * impulse.n.value.abs());
        judge.zero(rule, Residual::new(impulse.t - wanted * impulse.n, scale).per(impulse.n.value.abs()), |size, bound| {
            format!(
                "{words} {}, and the impulse, {} N s along n and {} N s along t, has {}: {} off, {} may be",
                Digits(wanted.value),
                Digits(impulse.n.value),
                Digits(impulse.t.value),
                Digits(ratio),
                Digits(size),
                Digits(bound)
            )
        });
    };
    match (model.ratio_kind, claimed) {
        (RatioKind::Given, Some(claimed)) => has_ratio(judge, claimed, "the impulse ratio is said to be"),
        (RatioKind::Given, None) => (),
        (RatioKind::Critical, claimed) => {
            sliding_ended(judge, "the impulse ratio is said to be critical");
            if let Some(claimed) = claimed {
                has_ratio(judge, claimed, "the critical impulse ratio is said to be");
            }
        }
        (RatioKind::OfCritical, claimed) => fraction(known, touch, impulse, claimed, judge),
        (RatioKind::Friction, Some(friction)) => {
            let push = impulse.n.magnitude();
            let excess = Residual::new(impulse.t.magnitude() - friction * push, length(&impulse)).per(push.value);
            judge.not_above(rule, excess, |size, bound| {
                format!(
                    "the friction is said to be {}, and the impulse has a ratio of {}: {} above it, {} may be",
                    Digits(friction.value),
                    Digits(ratio),
                    Digits(size),
                    Digits(bound)
                )
            });
            if judge.sign(rule, &excess) == Some(-1.0) {
                sliding_ended(judge, "the impulse ratio is below the friction");
            }
        }
        (RatioKind::Friction, None) => (),
    }
}

/// Checks P_t = f P_n S_t/S_n, where S is the impulse that ends sliding.
fn fraction<const N: usize>(
    known: &Known<'_, N>,
    touch: &Touch<N>,
    impulse: Nt<Uncertain<N>>,
    claimed: Option<Uncertain<N>>,
    judge: &mut Judge,
) {
    let e = known.number(Key::Restitution).unwrap_or(-touch.separation.n / touch.approach.n);
    let (Some(fraction), Some(sticking)) = (claimed, touch.sticking(known.record.model.law, e)) else { return };
    let product = impulse.t * sticking.n - fraction * impulse.n * sticking.t;
    // Not by the normal component of the sticking impulse, which may be zero if the fraction is zero.
    let unit = impulse.n.value.abs() * length(&sticking);
    let scale = length(&impulse) * length(&sticking);
    judge.zero(Rule::ImpulseRatio, Residual::new(product, scale).per(unit), |size, bound| {
        format!(
            "the impulse ratio is said to be {} of the critical {}, and the impulse has {}: {} off, {} may be",
            Digits(fraction.value),
            Digits(sticking.t.value / sticking.n.value),
            Digits(impulse.t.value / impulse.n.value),
            Digits(size),
            Digits(bound)
        )
    });
}

/// Checks `beyond-critical`. Along the line of impulses with the same normal change, the slip decreases steadily with P_t and is zero at the sticking
/// impulse. So P_t lies between zero and that impulse if and only if the two have the same sign; nothing is divided by, and this holds even if the sticking
/// impulse is tensile. With a moment the impulse may wedge, K_nn + μ K_nt < 0: it works against the normal change, which the moment causes, and μ has no bound.
fn beyond_critical<const N: usize>(
    known: &Known<'_, N>,
    touch: &Touch<N>,
    impulse: Nt<Uncertain<N>>,
    slip: Uncertain<N>,
    judge: &mut Judge,
) {
    let rule = Rule::BeyondCritical;
    judge.checks(rule);
    let along = touch.values().map(|contact| contact.compliance.along_ratio(impulse.t.value / impulse.n.value));
    if touch.moment.is_some() && along.is_some_and(|along| along < 0.0) {
        return;
    }
    let slip = Residual::new(slip, length(&touch.approach));
    let tangential = Residual::new(impulse.t, length(&impulse));
    let Some(pushed) = judge.sign(rule, &tangential) else { return };
    let backward = Residual::new(slip.value.scaled(-pushed), slip.scale).open(0.0, known.travel.velocity_leeway());
    judge.not_above(rule, backward, |size, bound| {
        let ratio = impulse.t.value / impulse.n.value;
        let critical = sticking(known, touch).filter(|sticking| sticking.n * touch.approach.n.value > 0.0).map(|p| p.t / p.n);
        let side = match critical {
            Some(critical) if ratio * critical < 0.0 => {
                format!("the impulse ratio {} has the other sign than the critical one, {}", Digits(ratio), Digits(critical))
            }
            Some(critical) if critical.abs() < ratio.abs() => {
                format!("the impulse ratio {} is beyond the critical one, {}", Digits(ratio), Digits(critical))
            }
            // The sticking impulse is tensile, or momentum is not conserved.
            _ => format!("the tangential impulse, {} N s, goes too far or points the wrong way", Digits(impulse.t.value)),
        };
        format!("{side}: after the impact the bodies slide against it at {} m/s, {} may be", Digits(size), Digits(bound))
    });
}

/// Returns the impulse with the same normal change after which sliding has ended.
fn sticking<const N: usize>(known: &Known<'_, N>, touch: &Touch<N>) -> Option<Nt> {
    let sticking = touch.sticking(known.record.model.law, -touch.separation.n / touch.approach.n)?;
    Some(sticking.map(|p| p.value))
}

fn warn_of_ratio<const N: usize>(touch: &Touch<N>, impulse: Nt<Uncertain<N>>, judge: &mut Judge) {
    let rule = Rule::ImpulseRatio;
    let tangential = Residual::new(impulse.t, length(&impulse));
    let sliding = Residual::new(touch.approach.t, length(&touch.approach));
    if let (Some(pushed), Some(slides)) = (judge.sign(rule, &tangential), judge.sign(rule, &sliding))
        && pushed != slides
    {
        let what = format!(
            "the tangential impulse on body 1 is {} N s, and body 2 slides past it with {} m/s along t before the impact: it speeds that up at first, \
             which is possible, as the bodies turn, and rare",
            Digits(impulse.t.value),
            Digits(touch.approach.t.value)
        );
        judge.warn(rule, impulse.t.value.abs(), 0.0, what);
    }
    let Some(share) = touch.wedging_share() else { return };
    let ratio = impulse.t.value / impulse.n.value;
    if share < 0.01 {
        let what =
            format!("the pair nearly wedges at the impulse ratio {}: K_nn + mu K_nt is {} of its parts", Digits(ratio), Digits(share));
        judge.warn(rule, share, 0.01, what);
    }
}

/// Returns the impulse on body 1 in contact axes: that of the motions, or the reported one.
fn impulse_of<const N: usize>(known: &Known<'_, N>) -> Option<Nt<Uncertain<N>>> {
    let claimed = || Some(Nt { n: known.number(Key::NormalImpulse)?, t: known.number(Key::TangentialImpulse)? });
    known.contact_impulse.or_else(claimed)
}

/// Returns the ratio that is reported, or that of the impulse.
fn reported_ratio<const N: usize>(known: &Known<'_, N>, judge: &Judge) -> Option<Uncertain<N>> {
    let of_impulse = || {
        let Nt { n, t } = impulse_of(known)?;
        judge.sign(Rule::ImpulseRatio, &Residual::new(n, n.value.abs().max(t.value.abs())))?;
        Some(t / n)
    };
    known.number(Key::ReportedRatio).or_else(of_impulse)
}

/// Checks that without an impulse ratio there is no tangential impulse, and no work of one. With a normal impulse that is known they are compared themselves.
fn no_tangential_impulse<const N: usize>(known: &Known<'_, N>, judge: &mut Judge) {
    let rest = || rest_of_loss(known, known.number(Key::EnergyLoss)?, known.number(Key::NormalWork)?);
    let (impulse, work) = (known.number(Key::TangentialImpulse), known.number(Key::TangentialWork).or_else(rest));
    let claims = [
        (impulse, "impulse", "N s", IMPULSE, known.beside.impulse),
        (work, "work of the tangential impulse", "J", ENERGY, available(known)),
    ];
    for (claimed, what, unit, rounded, beside) in claims {
        let Some(claimed) = claimed else { continue };
        judge.zero(Rule::ImpulseRatio, Residual::new(claimed, claimed.value.abs().max(beside)).beside(rounded), |size, bound| {
            let (size, bound) = (Digits(size), Digits(bound));
            format!("the impulse ratio is said to be 0, and the {what} along t to be {size} {unit}, {bound} may be")
        });
    }
}

/// Checks the number of the model by itself and by reported ratios if the motions do not determine them.
fn claims<const N: usize>(known: &Known<'_, N>, judge: &mut Judge) {
    let model = &known.record.model;
    let claimed = known.number(Key::ImpulseRatio);
    match (model.ratio_kind, claimed) {
        (RatioKind::Friction, Some(friction)) => friction_of_claims(known, friction, judge),
        (RatioKind::OfCritical, Some(share)) if known.moment.is_none() => share_of_claims(known, share, judge),
        _ => (),
    }
    let given = claimed.filter(|_| model.ratio_kind == RatioKind::Given).or_else(|| known.number(Key::ReportedRatio));
    let of_model = claimed.filter(|_| matches!(model.ratio_kind, RatioKind::Given | RatioKind::Critical));
    let said = |ratio: Uncertain<N>| -> String { format!("the impulse ratio is said to be {}", Digits(ratio.value)) };
    if let (Some(ratio), Some(Nt { n, t })) = (of_model, impulse_of(known)) {
        let scale = n.value.abs().max(t.value.abs());
        let residual = Residual::new(t - ratio * n, scale);
        if judge.sign(Rule::ImpulseRatio, &Residual::new(n, scale)).is_some() {
            judge.zero(Rule::ImpulseRatio, residual.per(n.value.abs()), |size, bound| {
                let has = Digits(t.value / n.value);
                format!("{}, and the impulse has {has}: {} off, {} may be", said(ratio), Digits(size), Digits(bound))
            });
        } else {
            // Without a normal impulse there is no ratio, and friction has nothing to act with.
            judge.zero(Rule::ImpulseRatio, residual, |size, bound| {
                let has = format!("{} N s along n and {} N s along t", Digits(n.value), Digits(t.value));
                format!("{}, and the impulse has {has}: {} N s off, {} may be", said(ratio), Digits(size), Digits(bound))
            });
        }
    }
    if given.is_some_and(|ratio| ratio.is_zero()) && known.contact_impulse.is_none() {
        no_tangential_impulse(known, judge);
    }
    // The critical ratio that is reported is that of Brach's law; under another one sliding ends at another ratio.
    let is_critical = model.law == Law::Brach;
    let critical_ratio = Some(Key::CriticalRatio).filter(|_| model.ratio_kind == RatioKind::Critical && is_critical);
    for key in [Some(Key::ReportedRatio), critical_ratio].into_iter().flatten() {
        if let (Some(ratio), Some(reported)) = (of_model, known.number(key)) {
            let residual = Residual::new(ratio - reported, ratio.value.abs().max(1.0));
            judge.zero(Rule::ImpulseRatio, residual, |size, bound| {
                format!("{}, and {key} is {}: {} off, {} may be", said(ratio), Digits(reported.value), Digits(size), Digits(bound))
            });
        }
    }
    let both = reported_ratio(known, judge).zip(known.number(Key::CriticalRatio));
    if let (Some((ratio, critical)), None) = (both, of_model)
        && critical_ratio.is_some()
    {
        judge.zero(Rule::ImpulseRatio, Residual::new(ratio - critical, ratio.value.abs().max(1.0)), |size, bound| {
            let (ratio, critical, size, bound) = (Digits(ratio.value), Digits(critical.value), Digits(size), Digits(bound));
            format!("the impulse ratio is said to be critical, {critical}, and is reported as {ratio}: {size} off, {bound} may be")
        });
    }
    // With a moment the impulse may wedge, and the ratio has no bound.
    let ratio = given.or_else(|| reported_ratio(known, judge));
    if let (Some(ratio), Some(critical), true) = (ratio, known.number(Key::CriticalRatio), is_critical && known.moment.is_none()) {
        beyond_claim(ratio, critical, judge);
    }
}

/// Checks that friction is not below zero, and that no reported ratio is above it.
fn friction_of_claims<const N: usize>(known: &Known<'_, N>, friction: Uncertain<N>, judge: &mut Judge) {
    let rule = Rule::ImpulseRatio;
    judge.not_above(rule, Residual::new(-friction, friction.value.abs().max(1.0)), |_, _| {
        format!("the friction is said to be {}, which is below 0", Digits(friction.value))
    });
    let of_impulse = impulse_of(known)
        .filter(|p| p.n.value != 0.0)
        .map(|Nt { n, t }| (t.magnitude() - friction * n.magnitude(), t.value / n.value, n.value.abs()));
    let of_ratio = known.number(Key::ReportedRatio).map(|ratio| (ratio.magnitude() - friction, ratio.value, 1.0));
    for (above, ratio, per) in of_ratio.into_iter().chain(of_impulse) {
        let residual = Residual::new(above, per * ratio.abs().max(1.0)).per(per);
        judge.not_above(rule, residual, |size, bound| {
            let (friction, ratio, size, bound) = (Digits(friction.value), Digits(ratio), Digits(size), Digits(bound));
            format!("the friction is said to be {friction}, and the impulse ratio is {ratio}: {size} above it, {bound} may be")
        });
    }
    below_friction(known, friction, judge);
}

/// Checks that a reported ratio below the friction is the reported critical one, of Brach's law: sliding has ended.
fn below_friction<const N: usize>(known: &Known<'_, N>, friction: Uncertain<N>, judge: &mut Judge) {
    let rule = Rule::ImpulseRatio;
    let (Some(ratio), Some(critical)) = (known.number(Key::ReportedRatio), known.number(Key::CriticalRatio)) else { return };
    let scale = ratio.value.abs().max(1.0);
    let is_below = judge.sign(rule, &Residual::new(ratio.magnitude() - friction, scale)) == Some(-1.0);
    if is_below && known.record.model.law == Law::Brach && known.moment.is_none() {
        judge.zero(rule, Residual::new(ratio - critical, scale), |size, bound| {
            let (friction, ratio, critical) = (Digits(friction.value), Digits(ratio.value), Digits(critical.value));
            let (size, bound) = (Digits(size), Digits(bound));
            format!(
                "the friction is said to be {friction} and the impulse ratio {ratio}, which is below it, so that sliding has ended, at the critical ratio \
                 {critical}: {size} off, {bound} may be"
            )
        });
    }
}

/// Checks that the share of the critical ratio lies from 0 to 1, and that both ratios that are reported have it. The critical ratio that is reported is that of
/// Brach's law.
fn share_of_claims<const N: usize>(known: &Known<'_, N>, share: Uncertain<N>, judge: &mut Judge) {
    let out_of_range = [(share - Uncertain::exact(1.0), "above 1"), (-share, "below 0")];
    for (beyond, words) in out_of_range {
        judge.not_above(Rule::BeyondCritical, Residual::new(beyond, share.value.abs().max(1.0)), |_, _| {
            format!("the share of the critical impulse ratio is said to be {}, which is {words}", Digits(share.value))
        });
    }
    let ratios = reported_ratio(known, judge).zip(known.number(Key::CriticalRatio));
    let Some((ratio, critical)) = ratios.filter(|_| known.record.model.law == Law::Brach) else { return };
    let of_share = share * critical;
    judge.zero(Rule::ImpulseRatio, Residual::new(ratio - of_share, ratio.value.abs().max(1.0)), |size, bound| {
        let (share, critical, ratio, size, bound) =
            (Digits(share.value), Digits(critical.value), Digits(ratio.value), Digits(size), Digits(bound));
        format!(
            "the impulse ratio is said to be {share} of the critical {critical}, and is reported as {ratio}: {size} off, {bound} may be"
        )
    });
}

/// Checks that a reported ratio is not beyond the reported critical one. A ratio of the other sign is possible, and rare: where the impulse that ends sliding
/// would be tensile.
fn beyond_claim<const N: usize>(ratio: Uncertain<N>, critical: Uncertain<N>, judge: &mut Judge) {
    let rule = Rule::BeyondCritical;
    let scale = critical.value.abs().max(1.0);
    let [sign, of_critical] = [ratio, critical].map(|of| judge.sign(rule, &Residual::new(of, scale)));
    if let (Some(one), Some(other)) = (sign, of_critical)
        && one != other
    {
        let what = format!(
            "the impulse ratio {} has the other sign than the critical one, {}, which is possible if the impulse that ends sliding would be tensile, and rare",
            Digits(ratio.value),
            Digits(critical.value)
        );
        return judge.warn(rule, ratio.value.abs(), 0.0, what);
    }
    let side = sign.or(of_critical).unwrap_or(1.0);
    judge.not_above(rule, Residual::new((ratio - critical).scaled(side), scale), |size, bound| {
        let (ratio, critical) = (Digits(ratio.value), Digits(critical.value));
        format!("the impulse ratio {ratio} is beyond the critical one, {critical}: {} off, {} may be", Digits(size), Digits(bound))
    });
}
