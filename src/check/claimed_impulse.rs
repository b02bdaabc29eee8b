//! Consistency of what is reported of the impulse: its components, magnitude and ratio, the directions of force and the changes of velocity are of one vector.
//!
//! Each of them but a magnitude is a line on which the vector ends. Two lines that cross determine it, and it is held against all others.

use super::claims::{direction_of_force, norm};
use super::format::Digits;
use super::judge::{IMPULSE, Judge, Residual};
use super::key::Key;
use super::known::{Known, turned};
use super::model::RatioKind;
use super::momentum::{length, number_of};
use super::rule::Rule;
use super::uncertain::{Uncertain, best_known, sharper, sharper_known};
use crate::frame::{CrushPlane, Nt, Xy};
use crate::input::Side;
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

/// Least sine of the angle of lines that determine an impulse: at a smaller one errors grow.
const CLEAR: f64 = 0.1;

/// What a line is of.
#[derive(Clone, Copy)]
enum Of {
    /// A component of the impulse.
    Component(Key),
    /// The impulse ratio of the model, or the reported one.
    Ratio(Key),
    /// The direction of force on a body.
    Force(Side),
    /// The change of velocity of a body, whose mass need not be known.
    Change(Side),
}

impl Of {
    fn words(self) -> String {
        match self {
            Of::Component(key) | Of::Ratio(key) => format!("{key}"),
            Of::Force(side) => format!("the direction of force on body {}", number_of(side)),
            Of::Change(side) => format!("the change of velocity of body {}", number_of(side)),
        }
    }
}

/// A line on which the impulse P on body 1 ends, normal · P = value, in contact axes or, without a contact normal, in ground axes.
#[derive(Clone, Copy)]
struct Line<const N: usize> {
    of: Of,
    normal: Xy<Uncertain<N>>,
    value: Uncertain<N>,
    /// The direction of P on it, if it has only one.
    toward: Option<Xy<Uncertain<N>>>,
}

/// The impulse on body 1 where two lines cross.
struct Crossing<const N: usize> {
    lines: [usize; 2],
    impulse: Xy<Uncertain<N>>,
    /// The sine of the angle between them.
    sine: f64,
    /// Its size, for arbitrary errors.
    scale: f64,
}

/// Lines in the same axes.
struct Lines<'a, 'b, const N: usize> {
    known: &'a Known<'b, N>,
    all: Vec<Line<N>>,
}

/// The length of the impulse where lines cross.
struct Length<const N: usize> {
    /// The names of the lines.
    by: String,
    value: Uncertain<N>,
    scale: f64,
}

/// Returns the impulse on body 1 in ground axes, if two lines determine it that are not nearly parallel, or a direction and a magnitude.
pub(super) fn determined<const N: usize>(known: &Known<'_, N>, judge: &Judge) -> Option<Xy<Uncertain<N>>> {
    // Without a contact normal, those in contact axes determine no vector on the ground.
    let groups = groups(known);
    let lines = groups.last()?;
    let crossing = lines.crossing(judge).filter(|crossing| crossing.sine > CLEAR).map(|crossing| crossing.impulse);
    let Xy { x, y } = crossing.or_else(|| lines.by_magnitude(judge))?;
    Some(known.plane.as_ref().map_or(Xy { x, y }, |plane| plane.to_ground(Nt { n: x, t: y })))
}

/// Returns the normal component of the impulse on body 1, if two lines in contact axes determine it that are not nearly parallel.
pub(super) fn normal<const N: usize>(known: &Known<'_, N>, judge: &Judge) -> Option<Uncertain<N>> {
    let crossing = groups(known).first()?.crossing(judge).filter(|crossing| crossing.sine > CLEAR)?;
    Some(crossing.impulse.x)
}

/// Returns the lines in contact axes or, without a contact normal, those in contact axes and those on the ground.
fn groups<'a, 'b, const N: usize>(known: &'a Known<'b, N>) -> Vec<Lines<'a, 'b, N>> {
    let (contact, mut ground) = (of_contact(known), of_ground(known));
    match &known.plane {
        Some(plane) => {
            for line in &mut ground {
                (line.normal, line.toward) = (turned_to(plane, line.normal), line.toward.map(|toward| turned_to(plane, toward)));
            }
            alloc::vec![Lines { known, all: contact.into_iter().chain(ground).collect() }]
        }
        None => [contact, ground].map(|all| Lines { known, all }).into(),
    }
}

pub(super) fn check<const N: usize>(known: &Known<'_, N>, judge: &mut Judge) {
    let groups = groups(known);
    let crossings: Vec<Option<Crossing<N>>> = groups.iter().map(|lines| lines.check(judge)).collect();
    let length = |(lines, crossing): (&Lines<'_, '_, N>, &Option<Crossing<N>>)| {
        let crossing = crossing.as_ref()?;
        Some(Length { by: lines.words(crossing), value: norm(crossing.impulse), scale: crossing.scale })
    };
    let lengths: Vec<Length<N>> = groups.iter().zip(&crossings).filter_map(length).collect();
    magnitudes(known, &lengths, judge);
    let single = groups.iter().zip(&crossings).filter(|(_, crossing)| crossing.is_none()).flat_map(|(lines, _)| &lines.all);
    let components = single.filter_map(|line| if let Of::Component(key) = line.of { Some(key) } else { None });
    parts(known, &lengths, components, judge);
}

/// Returns the lines of components along both axes.
fn components<const N: usize>(known: &Known<'_, N>, keys: [Key; 2]) -> [Option<Line<N>>; 2] {
    let (one, zero) = (Uncertain::exact(1.0), Uncertain::exact(0.0));
    let line = |key, x, y| Some(Line { of: Of::Component(key), normal: Xy { x, y }, value: known.number(key)?, toward: None });
    [line(keys[0], one, zero), line(keys[1], zero, one)]
}

/// Converts a vector to contact axes.
fn turned_to<const N: usize>(plane: &CrushPlane<Uncertain<N>>, v: Xy<Uncertain<N>>) -> Xy<Uncertain<N>> {
    let Nt { n, t } = plane.to_contact(v);
    Xy { x: n, y: t }
}

/// Returns the lines of what is reported along the normal and the tangent.
fn of_contact<const N: usize>(known: &Known<'_, N>) -> Vec<Line<N>> {
    let ratio = |key| {
        let ratio: Uncertain<N> = known.number(key)?;
        let unit = 1.0 / libm::sqrt(1.0 + ratio.value * ratio.value);
        Some(Line {
            of: Of::Ratio(key),
            normal: Xy { x: (-ratio).scaled(unit), y: Uncertain::exact(unit) },
            value: Uncertain::exact(0.0),
            toward: None,
        })
    };
    let parts = components(known, [Key::NormalImpulse, Key::TangentialImpulse]);
    // With both components the ratio of the model is compared by its own rule.
    let of_model = matches!(known.record.model.ratio_kind, RatioKind::Given | RatioKind::Critical) && parts.iter().any(Option::is_none);
    let ratios = [ratio(Key::ReportedRatio), Some(Key::ImpulseRatio).filter(|_| of_model).and_then(ratio)];
    parts.into_iter().chain(ratios).flatten().collect()
}

/// Returns the lines of what is reported along x and y, and of directions.
fn of_ground<const N: usize>(known: &Known<'_, N>) -> Vec<Line<N>> {
    let along = |of, toward: Xy<Uncertain<N>>| Line {
        of,
        normal: Xy { x: -toward.y, y: toward.x },
        value: Uncertain::exact(0.0),
        toward: Some(toward),
    };
    let on_one = |side, v: Xy<Uncertain<N>>| if side == Side::One { v } else { -v };
    let change = |side| {
        // A mass makes an impulse of it, with which every claim is compared.
        let delta_v = known.subject(side).delta_v().filter(|_| known.impulse.is_none() && !known.subject(side).fixed)?;
        let speed = length(&delta_v);
        (speed > 0.0).then(|| along(Of::Change(side), on_one(side, delta_v.map(|v| v.scaled(1.0 / speed)))))
    };
    let force = |side| {
        let (from, heading) = (known.number(Key::ForceDirection(side))?, known.number(Key::Heading(side))?);
        let from = turned(heading - from);
        (!known.subject(side).fixed).then(|| along(Of::Force(side), on_one(side, Xy { x: -from.cos, y: -from.sin })))
    };
    let components = components(known, [Key::ImpulseX, Key::ImpulseY]);
    components.into_iter().chain(Side::ALL.map(change)).chain(Side::ALL.map(force)).flatten().collect()
}

impl<const N: usize> Lines<'_, '_, N> {
    /// Holds all lines against the impulse where two of them cross, and returns it; or against each other, if none cross.
    fn check(&self, judge: &mut Judge) -> Option<Crossing<N>> {
        let crossing = self.crossing(judge);
        match &crossing {
            Some(crossing) => (0..self.all.len()).for_each(|place| self.hold(place, crossing, judge)),
            None => {
                self.parallel(judge);
                self.directions(judge);
            }
        }
        crossing
    }

    /// Returns the most precise impulse where two lines cross that do not both go through zero.
    fn crossing(&self, judge: &Judge) -> Option<Crossing<N>> {
        let lines = &self.all;
        let pairs = (0..lines.len()).flat_map(|i| (i + 1..lines.len()).map(move |k| [i, k]));
        let of_pair = |[i, k]: [usize; 2]| {
            let (one, other) = (&lines[i], &lines[k]);
            if ![one.of, other.of].iter().any(|of| matches!(of, Of::Component(_))) {
                return None;
            }
            let determinant = one.normal.cross(other.normal);
            judge.sign(Rule::Reported, &Residual::new(determinant, 1.0))?;
            let impulse = Xy {
                x: (one.value * other.normal.y - other.value * one.normal.y) / determinant,
                y: (one.normal.x * other.value - other.normal.x * one.value) / determinant,
            };
            let size = length(&impulse).max(one.value.value.abs()).max(other.value.value.abs());
            let sine = determinant.value.abs();
            Some(Crossing { lines: [i, k], impulse, sine, scale: size / sine })
        };
        let radius = |crossing: &Crossing<N>| crossing.impulse.x.radius() + crossing.impulse.y.radius();
        let usable = pairs.filter_map(of_pair).filter(|crossing| radius(crossing).is_finite() && crossing.scale.is_finite());
        usable.min_by(|one, other| radius(one).total_cmp(&radius(other)).then(other.sine.total_cmp(&one.sine)))
    }

    /// Returns the impulse of the reported magnitude along a direction of force or, toward the side on which the bodies approach each other, at a ratio.
    fn by_magnitude(&self, judge: &Judge) -> Option<Xy<Uncertain<N>>> {
        let magnitude = magnitude(self.known)?;
        let pushes = || {
            let approach = self.known.before?.velocity;
            judge.sign(Rule::Reported, &Residual::new(approach.n, super::normal::length(&approach)))
        };
        let along = |line: &Line<N>| match line.of {
            Of::Force(_) => line.toward,
            Of::Ratio(_) => {
                let sign = pushes()?;
                let (Xy { x, y }, unit) = (line.normal, norm(line.normal));
                Some(Xy { x: y.scaled(sign) / unit, y: -x.scaled(sign) / unit })
            }
            _ => None,
        };
        let along = self.all.iter().find_map(along)?;
        Some(along.map(|part| part * magnitude))
    }

    /// Returns the names of the lines that cross.
    fn words(&self, crossing: &Crossing<N>) -> String {
        let [one, other] = crossing.lines.map(|line| self.all[line].of.words());
        format!("{one} and {other}")
    }

    fn hold(&self, place: usize, crossing: &Crossing<N>, judge: &mut Judge) {
        let (line, impulse) = (&self.all[place], crossing.impulse);
        let determines = crossing.lines.contains(&place);
        let words = || self.words(crossing);
        match line.of {
            Of::Component(key) if !determines => {
                let implied = line.normal.x * impulse.x + line.normal.y * impulse.y;
                judge.zero(Rule::Reported, Residual::new(line.value - implied, crossing.scale), |size, bound| {
                    let (said, implied, size, bound) = (Digits(line.value.value), Digits(implied.value), Digits(size), Digits(bound));
                    format!("{key} is said to be {said} N s, and by {} it is {implied} N s: {size} off, {bound} may be", words())
                });
            }
            Of::Ratio(key) if !determines => self.ratio(key, impulse, crossing.scale, &words(), judge),
            Of::Force(side) => self.force(side, impulse, &format!("the impulse by {}", words()), judge),
            Of::Change(side) => {
                // Across it there is none, and along it none against it.
                let across = line.normal.x * impulse.x + line.normal.y * impulse.y;
                let against = line.toward.map(|toward| -(toward.x * impulse.x + toward.y * impulse.y));
                let mut hold = |residual: Uncertain<N>, is_none: bool| {
                    let what = |size, bound| {
                        let (size, bound) = (Digits(size), Digits(bound));
                        let of_body = number_of(side);
                        format!(
                            "{} make an impulse that is not along the change of velocity of body {of_body}: {size} N s off, {bound} may be",
                            words()
                        )
                    };
                    let residual = Residual::new(residual, crossing.scale);
                    if is_none { judge.zero(Rule::Reported, residual, what) } else { judge.not_above(Rule::Reported, residual, what) }
                };
                if !determines {
                    hold(across, true);
                }
                against.into_iter().for_each(|against| hold(against, false));
            }
            Of::Component(_) | Of::Ratio(_) => (),
        }
    }

    /// Compares a ratio with a vector.
    fn ratio(&self, key: Key, along: Xy<Uncertain<N>>, scale: f64, words: &str, judge: &mut Judge) {
        let Some(said) = self.known.number(key) else { return };
        let rule = if key == Key::ImpulseRatio { Rule::ImpulseRatio } else { Rule::Reported };
        if judge.sign(rule, &Residual::new(along.x, scale)).is_none() {
            return;
        }
        let residual = Residual::new(along.y - said * along.x, scale * said.value.abs().max(1.0)).per(along.x.value);
        judge.zero(rule, residual, |size, bound| {
            let (said, ratio, size, bound) = (Digits(said.value), Digits(along.y.value / along.x.value), Digits(size), Digits(bound));
            format!("{key} is said to be {said}, and by {words} it is {ratio}: {size} off, {bound} may be")
        });
    }

    /// Compares the direction of force on a body with a vector on body 1. The one of a body whose change of velocity is known is compared with that.
    fn force(&self, side: Side, on_one: Xy<Uncertain<N>>, words: &str, judge: &mut Judge) {
        let Some(claimed) = self.known.number(Key::ForceDirection(side)) else { return };
        let on_one = match &self.known.plane {
            Some(plane) => plane.to_ground(Nt { n: on_one.x, t: on_one.y }),
            None => on_one,
        };
        let on_body = if side == Side::One { on_one } else { -on_one };
        if self.known.subject(side).delta_v().is_none() {
            direction_of_force(self.known, side, (words, on_body), claimed, judge);
        }
    }

    /// Compares lines that are parallel, of which one at least is of a component.
    fn parallel(&self, judge: &mut Judge) {
        /// Largest sine of an angle that is the rounding of zero: of any other the vector may end far away.
        const ROUNDING: f64 = 4.0 * f64::EPSILON;
        for (i, one) in self.all.iter().enumerate() {
            for other in &self.all[i + 1..] {
                let of = [one.of, other.of];
                // A tangential impulse beside a ratio of zero has a rule of its own.
                let has_ratio = of.iter().any(|of| matches!(of, Of::Ratio(_)));
                let has_component = of.iter().any(|of| matches!(of, Of::Component(_)));
                let sine = one.normal.cross(other.normal);
                if has_ratio || !has_component || sine.radius() > 0.0 || sine.value.abs() > ROUNDING {
                    continue;
                }
                let is_reversed = one.normal.x.value * other.normal.x.value + one.normal.y.value * other.normal.y.value < 0.0;
                let off = if is_reversed { one.value + other.value } else { one.value - other.value };
                let residual = Residual::new(off, one.value.value.abs().max(other.value.value.abs())).beside(IMPULSE);
                judge.zero(Rule::Reported, residual, |size, bound| {
                    let (one, other, size, bound) = (one.of.words(), other.of.words(), Digits(size), Digits(bound));
                    format!("{one} and {other} are of no impulse: {size} N s off, {bound} may be")
                });
            }
        }
    }

    /// Compares ratios and directions of force, without any component, with the first direction or, if there is one, with the impulse of the motions.
    fn directions(&self, judge: &mut Judge) {
        let in_axes = |v| self.known.plane.as_ref().map_or(v, |plane| turned_to(plane, v));
        let of_motions = self.known.impulse.map(|impulse| ("the impulse".into(), in_axes(impulse), None));
        let first = || self.all.iter().enumerate().find_map(|(place, line)| Some((line.of.words(), line.toward?, Some(place))));
        let Some((words, toward, place)) = of_motions.or_else(first) else { return };
        for line in self.all.iter().enumerate().filter(|(other, _)| place != Some(*other)).map(|(_, line)| line) {
            match line.of {
                Of::Ratio(key) if place.is_some() => self.ratio(key, toward, 1.0, &words, judge),
                Of::Force(side) => self.force(side, toward, &words, judge),
                _ => (),
            }
        }
    }
}

/// Compares the magnitudes of the impulse: the reported one, those of components, and mass times delta-V.
fn magnitudes<const N: usize>(known: &Known<'_, N>, lengths: &[Length<N>], judge: &mut Judge) {
    let mut equal = |words: &str, a: Uncertain<N>, b: Uncertain<N>, scale: f64| {
        judge.zero(Rule::Reported, Residual::new(a - b, a.value.abs().max(b.value.abs()).max(scale)), |size, bound| {
            let (a, b, size, bound) = (Digits(a.value), Digits(b.value), Digits(size), Digits(bound));
            format!("{words} of what is reported are {a} N s and {b} N s: {size} off, {bound} may be")
        });
    };
    let magnitude = known.number(Key::ImpulseMagnitude);
    for Length { by, value, scale } in lengths {
        if let Some(magnitude) = magnitude {
            equal(&format!("the impulse and its length by {by}"), magnitude, *value, *scale);
        }
    }
    if let [one, other] = lengths {
        equal(&format!("the length of the impulse by {} and by {}", one.by, other.by), one.value, other.value, one.scale.max(other.scale));
    }
    let [on_one, on_two] = Side::ALL.map(|side| passed_on(known, side));
    if let (Some(a), Some(b)) = (on_one, on_two) {
        equal("mass times delta-V of body 1 and of body 2", a, b, 0.0);
    }
    if let (Some((impulse, scale)), Some(passed)) = (sharpest(magnitude, lengths), passed(known)) {
        equal("the impulse and mass times delta-V", impulse, passed, scale);
    }
}

/// Returns the more precise of a magnitude and of lengths, with the size of arbitrary errors beyond itself.
fn sharpest<const N: usize>(magnitude: Option<Uncertain<N>>, lengths: &[Length<N>]) -> Option<(Uncertain<N>, f64)> {
    let of_lengths = lengths.iter().map(|length| (length.value, length.scale));
    magnitude
        .map(|magnitude| (magnitude, 0.0))
        .into_iter()
        .chain(of_lengths)
        .reduce(|one, other| sharper(one, other, |(of, _)| of.radius()))
}

/// Checks that no component is above the whole impulse.
fn parts<const N: usize>(known: &Known<'_, N>, lengths: &[Length<N>], components: impl Iterator<Item = Key>, judge: &mut Judge) {
    let Some((whole, scale)) = sharpest(magnitude(known), lengths).or_else(|| Some((norm(known.impulse?), 0.0))) else { return };
    for key in components {
        // Those that the motions imply are held against them.
        let is_implied = match key {
            Key::NormalImpulse | Key::TangentialImpulse => known.contact_impulse.is_some(),
            _ => known.impulse.is_some(),
        };
        let Some(part) = known.number(key).filter(|_| !is_implied) else { continue };
        judge.not_above(
            Rule::Reported,
            Residual::new(part.magnitude() - whole, whole.value.abs().max(part.value.abs()).max(scale)),
            |size, bound| {
                let (part, whole, size, bound) = (Digits(part.value), Digits(whole.value), Digits(size), Digits(bound));
                format!("{key} is said to be {part} N s, and the whole impulse is {whole} N s: {size} more than that, {bound} may be")
            },
        );
    }
}

fn passed_on<const N: usize>(known: &Known<'_, N>, side: Side) -> Option<Uncertain<N>> {
    Some(known.number(Key::DeltaV(side))? * known.subject(side).mass?)
}

/// Returns mass times the reported delta-V.
fn passed<const N: usize>(known: &Known<'_, N>) -> Option<Uncertain<N>> {
    let [on_one, on_two] = Side::ALL.map(|side| passed_on(known, side));
    best_known(on_one, on_two, Uncertain::radius, Uncertain::mean)
}

/// Returns the reported magnitude of the impulse, or that of the reported delta-V.
pub(super) fn magnitude<const N: usize>(known: &Known<'_, N>) -> Option<Uncertain<N>> {
    sharper_known(known.number(Key::ImpulseMagnitude), passed(known), Uncertain::radius)
}
