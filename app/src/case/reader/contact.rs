//! The keys of the contact.

use planar_impact::{CrushPlaneBracket, ImpulseRatio, Input, Law, Moment, SurfaceIssue};

use super::implied::ImpliedValues;
use super::measured::{DISTRIBUTION_KEYS, has_deviation};
use super::{CaseReader, one_of};
use crate::case::domain::Domain;
use crate::case::inputs::ContactInputs;
use crate::case::parameter::Parameter;
use crate::case::restitution::Restitution;
use crate::document::{Entry, Field, Table, Value};
use crate::notice::Notice;
use crate::quantity::{Kind, nearest};
use crate::units::trim;
use crate::units::{Measure, Units};

const MODELS: [&str; 2] = ["impulse-ratio", "momentum"];

/// The keys of a contact with restitution and impulse ratio.
const OF_IMPULSE_RATIO: [&str; 7] = ["crush_plane", "surfaces", "restitution", "impulse_ratio", "friction", "tangential_law", "moment"];

impl CaseReader {
    /// Reads the contact, and the crush-plane bracket if the plane is derived from two surfaces.
    pub(super) fn contact(
        &self,
        table: &Table<'_>,
        implied: &ImpliedValues<'_>,
        is_momentum: bool,
    ) -> Option<(ContactInputs, Option<CrushPlaneBracket>)> {
        table.optional("model").choice(&MODELS);
        if is_momentum {
            return self.without_contact(table);
        }
        let crush_plane = self.crush_plane(table, implied);
        let restitution = match implied.of_key(table, "restitution", Input::Restitution) {
            Some(value) => value.map(Restitution::Given),
            None => self.restitution(table.required("restitution")),
        };
        let impulse_ratio = self.impulse_ratio(table, implied);
        let law = match table.optional("tangential_law").choice(&["brach", "kudlich-slibar"]) {
            Some("kudlich-slibar") => Law::KudlichSlibar,
            _ => Law::Brach,
        };
        let moment = self.moment(table, implied);
        table.finish();
        let (crush_plane, bracket) = crush_plane?;
        let contact = ContactInputs { crush_plane, restitution: restitution?, impulse_ratio: impulse_ratio?, law, moment: moment? };
        Some((contact, bracket))
    }

    /// Returns `true` if momentum alone determines the impulse.
    pub(super) fn is_momentum(table: &Table<'_>) -> bool {
        // Also where it is misspelled, so that nothing is missed which that does not need.
        matches!(table.optional("model").value(), Some(Value::String(model)) if nearest(model, MODELS.into_iter()) == Some("momentum"))
    }

    /// Reads the contact of a case that momentum alone determines: whatever else it gives takes no part.
    fn without_contact(&self, table: &Table<'_>) -> Option<(ContactInputs, Option<CrushPlaneBracket>)> {
        let given: Vec<&str> = OF_IMPULSE_RATIO.into_iter().filter(|key| table.has(key)).collect();
        if !given.is_empty() {
            let message = format!("momentum alone takes no {}", given.join(", "));
            self.notices.borrow_mut().push(Notice::note("not-used-by-momentum", "contact", message));
        }
        table.finish();
        let (impulse_ratio, law, moment) = (ImpulseRatio::Critical, Law::Brach, Moment::None);
        Some((ContactInputs { crush_plane: 0.0, restitution: Restitution::Given(0.0), impulse_ratio, law, moment }, None))
    }

    /// Reads the angle of the crush plane, and its bracket if the angle is derived from the surfaces in contact.
    fn crush_plane(&self, table: &Table<'_>, implied: &ImpliedValues<'_>) -> Option<(f64, Option<CrushPlaneBracket>)> {
        if !table.has("surfaces")
            && let Some(value) = implied.of_key(table, "crush_plane", Input::CrushPlane)
        {
            return value.map(|angle| (angle, None));
        }
        if one_of(table, "crush_plane", "surfaces")? == "crush_plane" {
            let angle = self.input(table.required("crush_plane"), Parameter::Input(Input::CrushPlane));
            return angle.map(|angle| (angle, None));
        }
        let field = table.required("surfaces");
        let place = field.clone();
        let [one, two] = self.pair(field, Kind::ANGLE)?;
        match CrushPlaneBracket::of_surfaces(one, two) {
            Ok(bracket) => Some((bracket.nominal, Some(bracket))),
            Err(issues) => {
                let degrees = |angle: f64| trim(Units::Si.convert(Measure::Angle, angle));
                for issue in issues {
                    match issue {
                        SurfaceIssue::Perpendicular { one, other } => {
                            let help = format!("give crush_plane = \"{} deg\" or crush_plane = \"{} deg\"", degrees(one), degrees(other));
                            place.report("the surfaces stand at a right angle, and two planes are half way between them", Some(help));
                        }
                        issue => place.report(issue.to_string(), None),
                    }
                }
                None
            }
        }
    }

    fn impulse_ratio(&self, table: &Table<'_>, implied: &ImpliedValues<'_>) -> Option<ImpulseRatio> {
        if !table.has("friction")
            && let Some(value) = implied.of_key(table, "impulse_ratio", Input::ImpulseRatio)
        {
            return value.map(|value| match implied.called(Input::ImpulseRatio) {
                Some(Parameter::RatioOfCritical) => ImpulseRatio::OfCritical(value),
                Some(Parameter::Friction) => ImpulseRatio::LimitedByFriction(value),
                _ => ImpulseRatio::Given(value),
            });
        }
        if table.has("friction") {
            if table.has("impulse_ratio") {
                let help = "an impulse ratio is given; a friction limits the critical one".to_owned();
                table.optional("friction").report("`friction` and `impulse_ratio` exclude each other", Some(help));
            }
            let friction = self.input(table.required("friction"), Parameter::Friction);
            // Both are read, so that the faults of both are reported.
            let other = self.given_ratio(table.optional("impulse_ratio"));
            return friction.filter(|_| other.is_some()).map(ImpulseRatio::LimitedByFriction);
        }
        self.given_ratio(table.optional("impulse_ratio"))
    }

    fn given_ratio(&self, field: Field<'_>) -> Option<ImpulseRatio> {
        match field.value() {
            None => Some(ImpulseRatio::Critical),
            Some(Value::Table(entries)) if !is_distribution(entries) => {
                self.of_critical(field, Parameter::RatioOfCritical).map(ImpulseRatio::OfCritical)
            }
            Some(Value::Number(_) | Value::Table(_)) => self.ratio(field),
            Some(Value::String(text)) if text == "critical" => Some(ImpulseRatio::Critical),
            Some(Value::String(text)) if has_deviation(text) => self.ratio(field),
            Some(other) => {
                let word = if let Value::String(text) = other { nearest(text, ["critical"].into_iter()) } else { None };
                let help = word.map(|word| format!("did you mean \"{word}\"?"));
                field.report("expected \"critical\", a number, or { of_critical = 0.975 }", help);
                None
            }
        }
    }

    fn ratio(&self, field: Field<'_>) -> Option<ImpulseRatio> {
        self.input(field, Parameter::Input(Input::ImpulseRatio)).map(ImpulseRatio::Given)
    }

    fn moment(&self, table: &Table<'_>, implied: &ImpliedValues<'_>) -> Option<Moment> {
        if let Some(value) = implied.of_key(table, "moment", Input::Moment) {
            return value.map(|value| match implied.called(Input::Moment) {
                Some(Parameter::MomentOfCritical) => Moment::OfCritical(value),
                _ => Moment::Given(value),
            });
        }
        let field = table.optional("moment");
        match field.value() {
            None => Some(Moment::None),
            Some(Value::Table(entries)) if !is_distribution(entries) => {
                self.of_critical(field, Parameter::MomentOfCritical).map(Moment::OfCritical)
            }
            Some(_) => self.input(field, Parameter::Input(Input::Moment)).map(Moment::Given),
        }
    }

    fn of_critical(&self, field: Field<'_>, parameter: Parameter) -> Option<f64> {
        let table = field.table()?;
        // A fraction that the mechanics refuses is refused by its verbs.
        let fraction = self.input_in(table.required("of_critical"), parameter, Domain::Any);
        table.finish();
        fraction
    }
}

/// Returns `true` if a table describes the distribution of a number.
fn is_distribution(entries: &[Entry]) -> bool {
    let has = |key: &str| entries.iter().any(|entry| entry.key == key);
    !has("of_critical") && DISTRIBUTION_KEYS.into_iter().any(has)
}
