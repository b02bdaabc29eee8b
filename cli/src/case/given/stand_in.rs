//! What stands in for a key that is left out because it is unknown, or known from the evidence.

use std::cell::RefCell;
use std::f64::consts::TAU;

use planar_impact::reconstruct::{Measurable, Variable};
use planar_impact::{Input, Side};

use super::evidence::Piece;
use super::unknown::Asked;
use crate::case::inputs::Inputs;
use crate::case::knowledge::{LeftOut, measure_of_variable, parameter_of};
use crate::case::parameter::Parameter;
use crate::case::vehicle::Inertia;
use crate::document::Table;
use crate::units::Measure;

/// The evidence of inputs and the unknowns, for the keys that they may stand in for.
pub(super) struct StandIns<'a> {
    evidence: &'a [Piece<'a>],
    unknowns: &'a [Asked<'a>],
    /// Whether both could be read. If not, a key that is missing may be there.
    whole: bool,
    left_out: RefCell<Vec<LeftOut>>,
}

impl<'a> StandIns<'a> {
    pub(super) fn of(evidence: &'a [Piece<'a>], unknowns: &'a [Asked<'a>], whole: bool) -> Self {
        StandIns { evidence, unknowns, whole, left_out: RefCell::default() }
    }

    /// What is left out because it is unknown, in the order in which it was asked for.
    pub(super) fn left_out(&self) -> Vec<LeftOut> {
        self.left_out.borrow().clone()
    }

    /// How an unknown is called, if not by its own name.
    pub(super) fn called(&self, input: Input) -> Option<Parameter> {
        self.asked(Variable::Input(input)).and_then(|asked| asked.sought.called)
    }

    /// What stands in for a key: none if the table has it or nothing does, nothing if what does has no value.
    pub(super) fn of_key(&self, table: &Table<'_>, key: &'static str, variable: impl Into<Sought>) -> Option<Option<f64>> {
        let Sought(variable) = variable.into();
        if table.has(key) { None } else { self.value(variable, None) }
    }

    /// The same for a key that has a value where it is left out.
    pub(super) fn of_optional(&self, table: &Table<'_>, key: &'static str, input: Input, usual: f64) -> Option<f64> {
        if table.has(key) { None } else { self.value(Variable::Input(input), Some(usual)).unwrap_or(Some(usual)) }
    }

    /// The same for a key of two numbers: both must be unknown or known.
    pub(super) fn of_pair(&self, table: &Table<'_>, key: &'static str, pair: [Variable; 2]) -> Option<Option<[f64; 2]>> {
        if table.has(key) || !self.whole || !pair.iter().all(|variable| self.knows(*variable)) {
            return if self.whole || table.has(key) { None } else { Some(None) };
        }
        let [one, other] = pair.map(|variable| self.value(variable, None).flatten());
        Some(one.zip(other).map(|(one, other)| [one, other]))
    }

    fn asked(&self, variable: Variable) -> Option<&Asked<'a>> {
        self.unknowns.iter().find(|asked| asked.sought.of == variable)
    }

    fn piece(&self, variable: Variable) -> Option<&Piece<'a>> {
        self.evidence.iter().find(|piece| piece.of == Measurable::Variable(variable))
    }

    fn knows(&self, variable: Variable) -> bool {
        self.asked(variable).is_some() || self.piece(variable).is_some()
    }

    /// Its start or its value by the evidence. The value that it usually has does for a start.
    fn value(&self, variable: Variable, usual: Option<f64>) -> Option<Option<f64>> {
        let (asked, piece) = (self.asked(variable), self.piece(variable));
        let by_evidence = piece.and_then(Piece::number);
        let Some(asked) = asked else {
            let piece = match piece {
                Some(piece) => piece,
                None if self.whole || usual.is_some() => return None,
                None => return Some(None),
            };
            if !piece.is_exact() {
                self.leave_out(variable, piece.place.path());
            }
            return Some(by_evidence);
        };
        self.leave_out(variable, asked.place.path());
        let start = asked.sought.start.or(by_evidence).or(usual);
        if start.is_none() {
            let help = "write { start = … }, or give it in the vehicle or the contact".to_owned();
            asked.place.report("the search for it has no start: neither here nor among the known numbers", Some(help));
        }
        Some(start)
    }

    fn leave_out(&self, of: Variable, key: &str) {
        self.left_out.borrow_mut().push(LeftOut { of, key: key.to_owned() });
    }

    /// Whether the evidence and the unknowns can be those of these inputs; says what cannot.
    pub(super) fn agree_with(&self, inputs: &Inputs) -> bool {
        let mut agrees = true;
        for piece in self.evidence.iter().filter(|piece| piece.is_exact()) {
            if let (Measurable::Variable(variable), Some(value)) = (piece.of, piece.number())
                && self.asked(variable).is_none()
                && let Some(Ok(given)) = parameter_of(variable).map(|parameter| inputs.value(parameter))
                && differ(variable, given, value)
            {
                let help = "leave one of them out, or say how far the evidence may be off: it is then solved for".to_owned();
                piece.place.report("the vehicle or the contact gives another value", Some(help));
                agrees = false;
            }
        }
        for side in [Side::One, Side::Two] {
            let has_radius = inputs.vehicles[side as usize].as_ref().is_some_and(|vehicle| matches!(vehicle.inertia, Inertia::Radius(_)));
            let mass = Variable::Input(Input::Mass(side));
            let inertia = Variable::Input(Input::YawInertia(side));
            let doubtful = |variable: &Variable| {
                let piece = self.piece(*variable).filter(|piece| !piece.is_exact()).map(|piece| &piece.place);
                self.asked(*variable).map(|asked| &asked.place).or(piece)
            };
            for place in [mass, inertia].iter().filter_map(doubtful).filter(|_| has_radius) {
                let help = "give yaw_inertia in place of radius_of_gyration".to_owned();
                place.report("the vehicle gives a radius of gyration, which ties its yaw inertia to its mass", Some(help));
                agrees = false;
            }
        }
        agrees
    }
}

/// A variable, or the input that it is.
pub(super) struct Sought(Variable);

impl From<Variable> for Sought {
    fn from(variable: Variable) -> Self {
        Sought(variable)
    }
}

impl From<Input> for Sought {
    fn from(input: Input) -> Self {
        Sought(Variable::Input(input))
    }
}

/// Whether two values are not the same in other digits or turns.
fn differ(variable: Variable, one: f64, other: f64) -> bool {
    let difference = one - other;
    let difference =
        if measure_of_variable(variable) == Measure::Angle { difference - TAU * (difference / TAU).round() } else { difference };
    difference.abs() > 1e-9 * one.abs().max(other.abs()).max(1e-3)
}
