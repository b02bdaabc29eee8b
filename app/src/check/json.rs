//! A record from its JSON.

use planar_impact::Side;
use planar_impact::check::{Key, ResolutionGroup};

use super::complaint::{Complaints, Unreadable};
use super::draft::{Draft, Drafted, resolution_keys, resolution_names};
use super::units::Units;
use crate::document::json::{parse, parse_with_non_finite};
use crate::document::{Entry, Node, Value};
use crate::quantity::{self, excerpt, nearest};

/// Reads one record.
///
/// # Errors
///
/// Returns everything wrong with it.
pub fn read(text: &str, units: &Units) -> Result<Drafted, Unreadable> {
    let parsed = parse(text).or_else(|issues| {
        // Python and other programs write these although JSON does not allow them. The rule `finite` reports them by name.
        let lenient = (text.contains("NaN") || text.contains("Infinity")).then(|| parse_with_non_finite(text));
        lenient.and_then(Result::ok).ok_or(issues)
    });
    let node = parsed.map_err(|issues| {
        let mut complaints = Complaints::default();
        for issue in &issues {
            let column = issue.span.as_ref().map_or(String::new(), |span| format!("column {}", column_of(text, span.start)));
            complaints.push(&column, issue.message.to_string());
        }
        (String::new(), complaints)
    })?;
    let mut reader = Reader { units, draft: Draft::default() };
    match &node.value {
        Value::Table(entries) => reader.record(entries),
        other => reader.draft.complaints.push("", format!("a record is an object; found {}", other.describe())),
    }
    reader.draft.finish()
}

fn column_of(text: &str, at: usize) -> usize {
    let before = text.get(..at).unwrap_or(text);
    let line = before.rsplit('\n').next().unwrap_or(before);
    line.chars().count() + 1
}

struct Reader<'a> {
    units: &'a Units,
    draft: Draft,
}

/// Returns a number; `null` means that it is unknown.
fn number(value: &Value) -> Result<Option<f64>, String> {
    match value {
        Value::Null => Ok(None),
        Value::Number(number) => {
            // A number beyond the range of `f64` becomes infinite, which the rules report; one that underflows to zero is refused here.
            let value = number.text.parse::<f64>().unwrap_or(f64::NAN);
            if value != 0.0 { Ok(Some(value)) } else { quantity::finite(&number.text).map(Some).map_err(|error| error.to_string()) }
        }
        Value::String(text) => {
            let hint = match text.trim() {
                "critical" => "write \"ratio_kind\": \"critical\" for it, and the ratio as a number or not at all",
                share if share.ends_with('%') => "write an amount, not a percentage",
                unit if unit.contains(char::is_alphabetic) => "write the number alone; units are those of the header",
                _ => "write it without quotes",
            };
            Err(format!("expected a number, found the string {}; {hint}", excerpt(text)))
        }
        other => Err(format!("expected a number, found {}", other.describe())),
    }
}

impl Reader<'_> {
    fn record(&mut self, entries: &[Entry]) {
        const KNOWN: [&str; 9] = ["id", "profile", "group", "bodies", "contact", "model", "reported", "resolution", "note"];
        for Entry { key, node, .. } in entries {
            match key.as_str() {
                "id" | "profile" | "note" => self.text(key, node),
                "group" => self.group(node),
                "bodies" => self.bodies(node),
                "contact" => self.contact(node),
                "model" => self.model(node),
                "reported" => self.reported(node),
                "resolution" => self.resolution(node),
                _ => self.unknown("", key, &KNOWN),
            }
        }
    }

    fn group(&mut self, node: &Node) {
        if let Value::String(_) = node.value {
            return self.text("group", node);
        }
        if matches!(&node.value, Value::Table(entries) if entries.is_empty()) {
            self.draft.complaints.push("group", "`name` is missing");
        }
        for Entry { key, node, .. } in self.object("group", node) {
            match key.as_str() {
                "name" => self.text("group", node),
                "agreement" => self.text("group.agreement", node),
                _ => self.unknown("group", key, &["name", "agreement"]),
            }
        }
    }

    fn bodies(&mut self, node: &Node) {
        let Value::Array(items) = &node.value else {
            return self.draft.complaints.push("bodies", format!("expected an array of two objects, found {}", node.value.describe()));
        };
        if items.len() != 2 {
            let plural = if items.len() == 1 { "y" } else { "ies" };
            self.draft.complaints.push("bodies", format!("a collision has two bodies; found {} bod{plural}", items.len()));
        }
        for (node, (side, path)) in items.iter().zip([(Side::One, "b1"), (Side::Two, "b2")]) {
            self.body(node, side, path);
        }
    }

    fn body(&mut self, node: &Node, side: Side, path: &'static str) {
        const KNOWN: [&str; 8] = ["id", "fixed", "mass", "yaw_inertia", "heading", "cg", "before", "after"];
        for Entry { key, node, .. } in self.object(path, node) {
            match key.as_str() {
                "id" => self.text(if side == Side::One { "b1.id" } else { "b2.id" }, node),
                "fixed" => match node.value {
                    Value::Bool(true) => self.draft.fix(side),
                    Value::Bool(false) => (),
                    ref other => {
                        self.draft.complaints.push(&format!("{path}.fixed"), format!("expected true or false, found {}", other.describe()))
                    }
                },
                "mass" => self.number(Key::Mass(side), node),
                "yaw_inertia" => self.number(Key::YawInertia(side), node),
                "heading" => self.number(Key::Heading(side), node),
                "cg" => self.pair("cg", [Key::CenterX(side), Key::CenterY(side)], node),
                "before" => self.state("before", [Key::BeforeX(side), Key::BeforeY(side), Key::BeforeYawRate(side)], None, node, path),
                "after" => {
                    let center = [Key::CenterAfterX(side), Key::CenterAfterY(side)];
                    self.state("after", [Key::AfterX(side), Key::AfterY(side), Key::AfterYawRate(side)], Some(center), node, path)
                }
                _ => self.unknown(path, key, &KNOWN),
            }
        }
    }

    fn state(&mut self, name: &str, [x, y, yaw_rate]: [Key; 3], center: Option<[Key; 2]>, node: &Node, body: &str) {
        let path = format!("{body}.{name}");
        for Entry { key, node, .. } in self.object(&path, node) {
            match (key.as_str(), center) {
                ("v", _) => self.pair("v", [x, y], node),
                ("yaw_rate", _) => self.number(yaw_rate, node),
                ("cg", Some(center)) => self.pair("cg", center, node),
                (_, None) => self.unknown(&path, key, &["v", "yaw_rate"]),
                (_, Some(_)) => self.unknown(&path, key, &["v", "yaw_rate", "cg"]),
            }
        }
    }

    fn contact(&mut self, node: &Node) {
        for Entry { key, node, .. } in self.object("contact", node) {
            match key.as_str() {
                "point" => self.pair("point", [Key::PointX, Key::PointY], node),
                "point_after" => self.pair("point_after", [Key::PointAfterX, Key::PointAfterY], node),
                "duration" => self.number(Key::Duration, node),
                "normal_angle" => self.number(Key::NormalAngle, node),
                "moment" => self.number(Key::Moment, node),
                _ => self.unknown("contact", key, &["point", "normal_angle", "moment", "point_after", "duration"]),
            }
        }
    }

    fn model(&mut self, node: &Node) {
        for Entry { key, node, .. } in self.object("model", node) {
            match key.as_str() {
                "restitution" => self.number(Key::Restitution, node),
                "impulse_ratio" => self.number(Key::ImpulseRatio, node),
                "ratio_kind" => self.text("model.ratio_kind", node),
                "law" => self.text("model.law", node),
                _ => self.unknown("model", key, &["restitution", "impulse_ratio", "ratio_kind", "law"]),
            }
        }
    }

    fn reported(&mut self, node: &Node) {
        const SINGLE: [(&str, Key); 10] = [
            ("energy_loss", Key::EnergyLoss),
            ("work_normal", Key::NormalWork),
            ("work_tangential", Key::TangentialWork),
            ("work_moment", Key::MomentWork),
            ("kinetic_energy_before", Key::EnergyBefore),
            ("kinetic_energy_after", Key::EnergyAfter),
            ("closing_speed", Key::ClosingSpeed),
            ("separation_speed", Key::SeparationSpeed),
            ("impulse_ratio", Key::ReportedRatio),
            ("critical_impulse_ratio", Key::CriticalRatio),
        ];
        const OF_BODIES: [(&str, [Key; 2]); 3] = [
            ("delta_v", [Key::DeltaV(Side::One), Key::DeltaV(Side::Two)]),
            ("pdof", [Key::ForceDirection(Side::One), Key::ForceDirection(Side::Two)]),
            ("ees", [Key::EquivalentEnergySpeed(Side::One), Key::EquivalentEnergySpeed(Side::Two)]),
        ];
        for Entry { key, node, .. } in self.object("reported", node) {
            if let Some((_, single)) = SINGLE.iter().find(|(name, _)| name == key) {
                self.number(*single, node);
            } else if let Some((name, pair)) = OF_BODIES.iter().find(|(name, _)| name == key) {
                self.of_bodies(name, *pair, node);
            } else if key == "impulse" {
                self.impulse(node);
            } else {
                let known: Vec<&str> = SINGLE.iter().map(|one| one.0).chain(OF_BODIES.iter().map(|one| one.0)).chain(["impulse"]).collect();
                self.unknown("reported", key, &known);
            }
        }
    }

    /// Reads an impulse: a magnitude, components along x and y, or an object of any of them.
    fn impulse(&mut self, node: &Node) {
        const PARTS: [(&str, Key); 5] = [
            ("normal", Key::NormalImpulse),
            ("tangential", Key::TangentialImpulse),
            ("x", Key::ImpulseX),
            ("y", Key::ImpulseY),
            ("magnitude", Key::ImpulseMagnitude),
        ];
        match &node.value {
            Value::Array(_) => self.pair("impulse", [Key::ImpulseX, Key::ImpulseY], node),
            Value::Table(entries) => {
                for Entry { key, node, .. } in entries {
                    match PARTS.iter().find(|(name, _)| name == key) {
                        Some((_, part)) => self.number(*part, node),
                        None => self.unknown("reported.impulse", key, &PARTS.map(|(name, _)| name)),
                    }
                }
            }
            _ => self.number(Key::ImpulseMagnitude, node),
        }
    }

    fn resolution(&mut self, node: &Node) {
        for Entry { key, node, .. } in self.object("resolution", node) {
            let Some((measure, keys)) = resolution_keys(key) else {
                let meant = nearest(key, resolution_names()).map_or_else(
                    || "; the names are those of measures, such as `v`, and of columns, such as `b1.after.vx`".to_owned(),
                    |near| format!("; did you mean `{near}`?"),
                );
                self.draft.complaints.push("resolution", format!("unknown key {}{meant}", excerpt(key)));
                continue;
            };
            let path = format!("resolution.{key}");
            if let Some((value, size)) = self.amount(&path, measure, node) {
                self.draft.resolution(measure, &keys, value * size);
            }
        }
    }

    /// Returns the entries of an object; otherwise adds a complaint and returns no entries.
    fn object<'n>(&mut self, path: &str, node: &'n Node) -> &'n [Entry] {
        match &node.value {
            Value::Table(entries) => entries,
            Value::Null => &[],
            other => {
                self.draft.complaints.push(path, format!("expected an object, found {}", other.describe()));
                &[]
            }
        }
    }

    fn text(&mut self, name: &str, node: &Node) {
        match &node.value {
            Value::String(text) => self.draft.text(name, text),
            Value::Null if name != "id" => (),
            other => self.draft.no_text(name, format!("expected a string, found {}", other.describe())),
        }
    }

    fn number(&mut self, key: Key, node: &Node) {
        if let Some((value, size)) = self.amount(key.name(), key.group(), node) {
            self.draft.number(key, value, size);
        }
    }

    /// Returns a number as it is written and the size of its unit; `None` if it is unknown, or a complaint was added.
    fn amount(&mut self, path: &str, measure: ResolutionGroup, node: &Node) -> Option<(f64, f64)> {
        let read = number(&node.value).and_then(|value| value.map(|value| Ok((value, self.units.size(measure)?))).transpose());
        self.draft.complaints.accept(path, read).flatten()
    }

    /// Reads two numbers, both of which are required.
    fn pair(&mut self, name: &str, keys: [Key; 2], node: &Node) {
        let path = keys[0].name().strip_suffix('x').unwrap_or(keys[0].name());
        let wanted = format!("`{name}` has two components, along x and y;");
        self.two(keys, node, path.trim_end_matches('.'), &wanted);
    }

    /// Reads a number for each body, each of which may be missing.
    fn of_bodies(&mut self, name: &str, keys: [Key; 2], node: &Node) {
        self.two(keys, node, &format!("reported.{name}"), "expected one number or null for each of the two bodies,");
    }

    /// Reads an array of two numbers; otherwise adds a complaint with the `path` and what is `wanted` there.
    fn two(&mut self, keys: [Key; 2], node: &Node, path: &str, wanted: &str) {
        match &node.value {
            Value::Array(items) if items.len() == 2 => {
                for (key, item) in keys.into_iter().zip(items) {
                    self.number(key, item);
                }
            }
            Value::Null => (),
            Value::Array(items) => self.draft.complaints.push(path, format!("{wanted} found {}", items.len())),
            other => self.draft.complaints.push(path, format!("{wanted} found {}", other.describe())),
        }
    }

    fn unknown(&mut self, path: &str, key: &str, known: &[&str]) {
        let help = match nearest(key, known.iter().copied()) {
            Some(near) => format!("did you mean `{near}`?"),
            None => format!("the keys known here are {}", known.join(", ")),
        };
        self.draft.complaints.push(path, format!("unknown key {}; {help}", excerpt(key)));
    }
}
