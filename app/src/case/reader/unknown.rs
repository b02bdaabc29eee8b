//! The keys of `[unknown]`.

use planar_impact::Input;
use planar_impact::reconstruct::{Measurand, Variable};

use super::CaseReader;
use super::measured::{Amount, Spread, across_zero, is_folder, same_direction};
use crate::case::knowledge::{RequestedUnknown, names_of_unknowns};
use crate::case::parameter::Parameter;
use crate::document::{Field, Table, Value};
use crate::message::Message;
use crate::quantity::Kind;
use crate::quantity::{did_you_mean, nearest};

/// An unknown and the place of its table, for issues found later.
pub(super) struct Asked<'a> {
    pub(super) requested: RequestedUnknown,
    pub(super) place: Field<'a>,
}

impl CaseReader {
    /// Reads every unknown in the table, by dotted name or symbol.
    pub(super) fn unknowns<'a>(&self, table: &Table<'a>) -> Vec<Asked<'a>> {
        let mut found = Vec::new();
        self.walk_unknowns(table, "", &mut found);
        found
    }

    fn walk_unknowns<'a>(&self, table: &Table<'a>, above: &str, found: &mut Vec<Asked<'a>>) {
        for (key, field) in table.fields() {
            let name = if above.is_empty() { key.to_owned() } else { format!("{above}.{key}") };
            match named(&name) {
                Some((of, called)) if !is_of_ratio(&field) => match self.requested(of, called, field) {
                    Some(asked) => found.push(asked),
                    None => self.unread.borrow_mut().add(Some(vec![of])),
                },
                _ if is_folder(&field, &["start", "min", "max", "sd"]) => {
                    field.table().iter().for_each(|table| self.walk_unknowns(table, &name, found));
                }
                _ => {
                    let (message, help) = unknown_name(&name);
                    field.report(message, help);
                    let meant = nearest(&name, names_of_unknowns()).and_then(named);
                    self.unread.borrow_mut().add(meant.map(|(of, _)| vec![of]));
                }
            }
        }
    }

    fn requested<'a>(&self, of: Variable, called: Option<Parameter>, field: Field<'a>) -> Option<Asked<'a>> {
        let (place, key) = (field.clone(), field.path().to_owned());
        let measure = of.measure();
        let kind = Kind::from(measure);
        let record = |requested: &RequestedUnknown| {
            let name = called.map_or_else(|| of.name().to_owned(), |called| called.to_string());
            let given = [("start", requested.start), ("min", requested.min), ("max", requested.max), ("sd", requested.prior)];
            let numbers = given.into_iter().filter_map(|(part, value)| Some((format!("unknown.{name}.{part}"), value?, measure)));
            self.contents.borrow_mut().numbers(&requested.key, numbers);
        };
        let bare = RequestedUnknown { of, key, start: None, min: None, max: None, prior: None, called };
        if !matches!(field.value(), Some(Value::Table(_))) {
            let measured = self.measured(field, measure)?;
            let Amount::Number(value) = measured.amount else { return None };
            let prior = if let Spread::StandardDeviation(sd) = measured.spread { Some(sd) } else { None };
            let requested = RequestedUnknown { start: Some(value), prior, ..bare };
            record(&requested);
            return Some(Asked { requested, place });
        }
        let table = field.table()?;
        let number = |key| table.has(key).then(|| self.quantity(table.optional(key), kind));
        let (start, min, max) = (number("start"), number("min"), number("max"));
        let prior = table.has("sd").then(|| self.not_negative(table.optional("sd"), kind.difference()));
        table.finish();
        let all = |value: Option<Option<f64>>| value.map_or(Some(None), |value| value.map(Some));
        let requested = RequestedUnknown { start: all(start)?, min: all(min)?, max: all(max)?, prior: all(prior)?, ..bare };
        if !are_in_order(&table, kind, &requested) {
            return None;
        }
        record(&requested);
        Some(Asked { requested, place })
    }
}

/// Refuses bounds that cross, and a start beyond them, of every verb. The library checks this too, and that they are in the domain, which depends on the
/// collision.
fn are_in_order(table: &Table<'_>, kind: Kind, unknown: &RequestedUnknown) -> bool {
    let RequestedUnknown { start, min, max, .. } = *unknown;
    let refuse = |key, value, must_be: &'static str, bound, help: Option<String>| {
        let figure = |value| Message::new().figure(unknown.of.measure(), value);
        let message = Message::from("it is ").join(figure(value)).text("; it must be ").text(must_be).join(figure(bound));
        table.optional(key).report(message, help);
        false
    };
    let limits = [min.unwrap_or(f64::NEG_INFINITY), max.unwrap_or(f64::INFINITY)];
    match (start, min, max) {
        (_, Some(min), Some(max)) if min >= max => {
            let is_known = || "what is known is no unknown: give its value, and leave it out of [unknown]".to_owned();
            let help = if min == max { Some(is_known()) } else { across_zero(kind, limits) };
            refuse("max", max, "above min, ", min, help)
        }
        (Some(start), Some(min), _) if start < min => refuse("start", start, "at least min, ", min, same_direction(kind, start, limits)),
        (Some(start), _, Some(max)) if start > max => refuse("start", start, "at most max, ", max, same_direction(kind, start, limits)),
        _ => true,
    }
}

/// Returns the unknown with this name; the impulse ratio and the moment impulse may also be named as the contact gives them.
fn named(name: &str) -> Option<(Variable, Option<Parameter>)> {
    if let Some(variable) = Variable::named(name) {
        return Some((variable, None));
    }
    let parameter = Parameter::named(name)?;
    let input = match parameter {
        Parameter::Friction | Parameter::RatioOfCritical => Input::ImpulseRatio,
        Parameter::MomentOfCritical => Input::Moment,
        _ => return None,
    };
    Some((Variable::Input(input), Some(parameter)))
}

/// Returns `true` for the table of `contact.impulse_ratio.of_critical`, `false` for that of `contact.impulse_ratio`.
fn is_of_ratio(field: &Field<'_>) -> bool {
    match field.value() {
        Some(Value::Table(entries)) => entries.len() == 1 && entries[0].key == "of_critical",
        _ => false,
    }
}

fn unknown_name(name: &str) -> (&'static str, Option<String>) {
    if name.ends_with(".radius_of_gyration") || name == "k1" || name == "k2" {
        let help = "make the yaw inertia unknown instead: give yaw_inertia in the vehicle, and leave radius_of_gyration out";
        return ("a radius of gyration cannot be solved for", Some(help.to_owned()));
    }
    if Measurand::named(name).is_some() {
        return (
            "it is what comes of a collision, and cannot be solved for by itself",
            Some("what is known of it belongs in [evidence]".to_owned()),
        );
    }
    if Parameter::named(name).is_some() {
        return ("it cannot be solved for", Some(known_names()));
    }
    let help = did_you_mean(name, names_of_unknowns()).unwrap_or_else(known_names);
    ("nothing has this name", Some(help))
}

fn known_names() -> String {
    "unknown can be speed, velocity.x, velocity.y, yaw_rate, heading, mass, yaw_inertia and impact_center of a vehicle; crush_plane, restitution, \
     impulse_ratio, moment and crush_share of the contact"
        .to_owned()
}
