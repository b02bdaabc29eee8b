//! Values implied by the evidence or the unknowns, for keys left out of the vehicles and the contact.

use std::cell::RefCell;
use std::f64::consts::TAU;

use planar_impact::reconstruct::{Measurand, Variable};
use planar_impact::{Input, Side};

use super::evidence::Piece;
use super::unknown::Asked;
use crate::case::inputs::Inputs;
use crate::case::knowledge::{LeftOut, parameter_of, variable_of};
use crate::case::parameter::Parameter;
use crate::case::uncertain::Uncertain;
use crate::case::vehicle::{Inertia, Velocity};
use crate::document::Table;
use crate::units::Measure;

/// What of the evidence and the unknowns could not be read: a key that it may replace is not reported missing.
#[derive(Default)]
pub(super) struct Unread {
    /// The variables of each entry; `None` of a name that is none and near to none.
    entries: Vec<Option<Vec<Variable>>>,
}

impl Unread {
    /// Adds an entry.
    pub(super) fn add(&mut self, of: Option<Vec<Variable>>) {
        self.entries.push(of);
    }

    fn is_none(&self) -> bool {
        self.entries.is_empty()
    }

    fn may_be(&self, variable: Variable) -> bool {
        self.entries.iter().any(|entry| entry.as_ref().is_none_or(|all| all.contains(&variable)))
    }
}

/// Evidence of inputs, and unknowns, that may replace missing keys.
pub(super) struct ImpliedValues<'a> {
    evidence: &'a [Piece<'a>],
    unknowns: &'a [Asked<'a>],
    unread: Unread,
    left_out: RefCell<Vec<LeftOut>>,
}

impl<'a> ImpliedValues<'a> {
    pub(super) fn of(evidence: &'a [Piece<'a>], unknowns: &'a [Asked<'a>], unread: Unread) -> Self {
        ImpliedValues { evidence, unknowns, unread, left_out: RefCell::default() }
    }

    /// Returns the keys left out because they are unknown, in the order in which they were read.
    pub(super) fn left_out(&self) -> Vec<LeftOut> {
        self.left_out.borrow().clone()
    }

    /// Returns the parameter that names an unknown, if the file does not use its own name.
    pub(super) fn called(&self, input: Input) -> Option<Parameter> {
        self.asked(Variable::Input(input)).and_then(|asked| asked.requested.called)
    }

    /// Returns the value that replaces a missing key: `None` if the table has the key or nothing replaces it,
    /// `Some(None)` if the replacement has no value.
    pub(super) fn of_key(&self, table: &Table<'_>, key: &'static str, variable: impl Into<RequestedUnknown>) -> Option<Option<f64>> {
        let RequestedUnknown(variable) = variable.into();
        if table.has(key) { None } else { self.value(variable, None) }
    }

    /// Returns the value that replaces a missing key with the default `usual`.
    pub(super) fn of_optional(&self, table: &Table<'_>, key: &'static str, input: Input, usual: f64) -> Option<f64> {
        if table.has(key) { None } else { self.value(Variable::Input(input), Some(usual)).unwrap_or(Some(usual)) }
    }

    /// Returns the values that replace a missing key of two numbers, both of which must be unknown or known.
    pub(super) fn of_pair(&self, table: &Table<'_>, key: &'static str, pair: [Variable; 2]) -> Option<Option<[f64; 2]>> {
        if table.has(key) {
            return None;
        }
        if pair.iter().any(|variable| self.unread.may_be(*variable)) {
            return Some(None);
        }
        if !pair.iter().all(|variable| self.knows(*variable)) {
            return None;
        }
        let [one, other] = pair.map(|variable| self.value(variable, None).flatten());
        Some(one.zip(other).map(|(one, other)| [one, other]))
    }

    fn asked(&self, variable: Variable) -> Option<&Asked<'a>> {
        self.unknowns.iter().find(|asked| asked.requested.of == variable)
    }

    fn piece(&self, variable: Variable) -> Option<&Piece<'a>> {
        self.evidence.iter().find(|piece| piece.of == Measurand::Variable(variable))
    }

    fn knows(&self, variable: Variable) -> bool {
        self.asked(variable).is_some() || self.piece(variable).is_some()
    }

    /// Returns its start, or its value from the evidence, or the default as a start.
    fn value(&self, variable: Variable, usual: Option<f64>) -> Option<Option<f64>> {
        let (asked, piece) = (self.asked(variable), self.piece(variable));
        let by_evidence = piece.and_then(Piece::number);
        let Some(asked) = asked else {
            let piece = match piece {
                Some(piece) => piece,
                None if self.unread.may_be(variable) && usual.is_none() => return Some(None),
                None => return None,
            };
            if !piece.is_exact() {
                self.leave_out(variable, piece.place.path());
            }
            return Some(by_evidence);
        };
        self.leave_out(variable, asked.place.path());
        let start = asked.requested.start.or(by_evidence).or(usual);
        if start.is_none() {
            let help = "add `start`, or give the value in the vehicle or the contact".to_owned();
            asked.place.report("no starting value", Some(help));
        }
        Some(start)
    }

    fn leave_out(&self, of: Variable, key: &str) {
        self.left_out.borrow_mut().push(LeftOut { of, key: key.to_owned() });
    }

    /// Returns `true` if the evidence and the unknowns could be read.
    pub(super) fn is_whole(&self) -> bool {
        self.unread.is_none()
    }

    /// Returns `true` if the evidence and the unknowns are consistent with the inputs; reports the conflicts otherwise.
    pub(super) fn agree_with(&self, inputs: &Inputs, uncertain: &Uncertain) -> bool {
        let mut agrees = true;
        let is_uncertain = |variable| uncertain.inputs.iter().any(|input| variable_of(input.parameter) == Some(variable));
        for asked in self.unknowns.iter().filter(|asked| is_uncertain(asked.requested.of)) {
            let help = "leave it out here, or give a plain value there".to_owned();
            asked.place.report("the vehicle or the contact gives it with an uncertainty, with which it is solved for already", Some(help));
            agrees = false;
        }
        for piece in self.evidence.iter().filter(|piece| piece.is_exact()) {
            let (Measurand::Variable(variable), Some(value)) = (piece.of, piece.number()) else { continue };
            if self.asked(variable).is_some() {
                continue;
            }
            if is_uncertain(variable) {
                let help = "leave one of them out, or say how far the evidence may be off".to_owned();
                piece.place.report("it is exact here, and the vehicle or the contact gives it with an uncertainty", Some(help));
                agrees = false;
            } else if let Some(Ok(given)) = parameter_of(variable).map(|parameter| inputs.value(parameter))
                && differ(variable, given, value)
            {
                let has_components = |side: Side| {
                    inputs.vehicles[side as usize].as_ref().is_some_and(|vehicle| matches!(vehicle.velocity, Velocity::Components(_)))
                };
                let help = match variable {
                    Variable::Speed(side) if has_components(side) => {
                        "leave one of them out: the case gives a velocity, of which the components may be evidence"
                    }
                    _ => "leave one of them out, or say how far the evidence may be off: it is then solved for",
                };
                piece.place.report("the vehicle or the contact gives another value", Some(help.to_owned()));
                agrees = false;
            }
        }
        for side in [Side::One, Side::Two] {
            let has_radius = inputs.vehicles[side as usize].as_ref().is_some_and(|vehicle| matches!(vehicle.inertia, Inertia::Radius(_)));
            let inertia = Variable::Input(Input::YawInertia(side));
            let doubtful = |variable: &Variable| {
                let piece = self.piece(*variable).filter(|piece| !piece.is_exact()).map(|piece| &piece.place);
                self.asked(*variable).map(|asked| &asked.place).or(piece)
            };
            for place in doubtful(&inertia).into_iter().filter(|_| has_radius) {
                let help = "give yaw_inertia in place of radius_of_gyration".to_owned();
                place.report("the vehicle gives a radius of gyration, which ties its yaw inertia to its mass", Some(help));
                agrees = false;
            }
        }
        agrees
    }
}

/// A variable, also made from an input.
pub(super) struct RequestedUnknown(Variable);

impl From<Variable> for RequestedUnknown {
    fn from(variable: Variable) -> Self {
        RequestedUnknown(variable)
    }
}

impl From<Input> for RequestedUnknown {
    fn from(input: Input) -> Self {
        RequestedUnknown(Variable::Input(input))
    }
}

/// Returns `true` if two values differ by more than rounding or full turns.
fn differ(variable: Variable, one: f64, other: f64) -> bool {
    let difference = one - other;
    let difference = if variable.measure() == Measure::Angle { difference - TAU * (difference / TAU).round() } else { difference };
    difference.abs() > 1e-9 * one.abs().max(other.abs()).max(1e-3)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_differ_by_more_than_rounding_and_full_turns() {
        let (mass, heading) = (Variable::Input(Input::Mass(Side::One)), Variable::Input(Input::Heading(Side::One)));
        assert!(!differ(mass, 1500.0, 1500.0 * (1.0 + 9e-10)) && differ(mass, 1500.0, 1500.0 * (1.0 + 2e-9)));
        assert!(!differ(mass, 0.0, 9e-13) && differ(mass, 0.0, 2e-12));
        assert!(!differ(heading, 1.0, 1.0 + TAU) && !differ(heading, 1.0, 1.0 - 3.0 * TAU) && differ(heading, 1.0, 1.0 + TAU / 2.0));
        assert!(differ(mass, 1.0, 1.0 + TAU));
    }
}
