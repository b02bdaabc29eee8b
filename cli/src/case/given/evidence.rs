//! What is known after the crash: so far the separation velocities, which CRASH3 goes back from. Other verbs read the rest.

use planar_impact::Xy;

use super::Given;
use crate::document::{Field, Table, Value};
use crate::quantity::{self, Kind};

/// What stands between a value and its standard deviation.
const PLUS_MINUS: [&str; 3] = ["±", "+/-", "+-"];

impl Given {
    /// The separation velocity of each vehicle, where the evidence has it.
    pub(super) fn separation_velocities(&self, evidence: &Table<'_>) -> Option<[Option<Xy>; 2]> {
        if !evidence.has("vehicle") {
            return Some([None, None]);
        }
        let vehicles = evidence.optional("vehicle").table()?;
        let of = |number: &'static str| {
            if !vehicles.has(number) {
                return Some(None);
            }
            let vehicle = vehicles.optional(number).table()?;
            if !vehicle.has("separation_velocity") {
                return Some(None);
            }
            let wanted = format!("an array of two values, each {}", Kind::SPEED.wanted());
            let items = vehicle.optional("separation_velocity").items(&wanted, 2..=2)?;
            let read: Vec<Option<f64>> = items.into_iter().map(|item| self.measured(item, Kind::SPEED)).collect();
            let [x, y] = read[..] else { return None };
            Some(Some(Xy { x: x?, y: y? }))
        };
        let (one, two) = (of("1"), of("2"));
        Some([one?, two?])
    }

    /// The value of a measurement: a value, a value with ± and its standard deviation, or { value, sd }.
    fn measured(&self, field: Field<'_>, kind: Kind) -> Option<f64> {
        match field.value() {
            Some(Value::Table(_)) => {
                let table = field.table()?;
                let value = self.quantity(table.required("value"), kind);
                let deviation = table.has("sd").then(|| self.not_negative(table.optional("sd"), kind));
                table.finish();
                deviation.unwrap_or(Some(0.0))?;
                value
            }
            Some(Value::String(text)) => {
                let Some((value, deviation)) = PLUS_MINUS.iter().find_map(|sign| text.split_once(sign)) else {
                    return self.quantity(field, kind);
                };
                let parse = |text: &str| match quantity::parse(text.trim(), kind) {
                    Ok(quantity) => Some(quantity),
                    Err(error) => {
                        field.report(error.message, error.help);
                        None
                    }
                };
                let (value, deviation) = (parse(value), parse(deviation));
                if deviation?.si < 0.0 {
                    field.report("the standard deviation is below zero", None);
                    return None;
                }
                Some(self.take(field.path(), value?))
            }
            _ => self.quantity(field, kind),
        }
    }
}
