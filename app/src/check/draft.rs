//! A record under construction: values are added one by one, by name, from any file format.

use planar_impact::check::{Agreement, Key, Membership, Profile, RatioKind, Record, ResolutionGroup};
use planar_impact::{Law, Side};

use super::complaint::Complaints;
use super::rounding::Rounding;
use crate::quantity::{excerpt, nearest};

/// The longest identifier and group name, in bytes.
const LONGEST_NAME: usize = 1000;

/// A record that is complete, and the rounding that its digits show.
#[derive(Debug, Default)]
pub struct Drafted {
    pub record: Record,
    pub rounding: Rounding,
}

/// A record under construction.
#[derive(Debug, Default)]
pub struct Draft {
    record: Record,
    rounding: Rounding,
    /// One bit for each key that was given.
    given: u64,
    has_id: bool,
    body_names: [Option<String>; 2],
    group: Option<String>,
    agreement: Option<Agreement>,
    /// The complaints so far.
    pub complaints: Complaints,
}

/// The text values of a record, by column name.
pub const TEXTS: [&str; 11] =
    ["id", "note", "profile", "group", "group.agreement", "b1.id", "b1.fixed", "b2.id", "b2.fixed", "model.ratio_kind", "model.law"];

/// Names of a resolution that applies to two numbers at once.
pub const BOTH: [&str; 3] = ["delta_v", "pdof", "ees"];

/// Returns the group and keys of a name under `resolution`.
pub fn resolution_keys(name: &str) -> Option<(ResolutionGroup, Vec<Key>)> {
    use Side::{One, Two};
    if let Some(measure) = ResolutionGroup::named(name) {
        return Some((measure, Vec::new()));
    }
    let keys = match name {
        "delta_v" => vec![Key::DeltaV(One), Key::DeltaV(Two)],
        "pdof" => vec![Key::ForceDirection(One), Key::ForceDirection(Two)],
        "ees" => vec![Key::EquivalentEnergySpeed(One), Key::EquivalentEnergySpeed(Two)],
        _ => vec![Key::named(name)?],
    };
    Some((keys[0].group(), keys))
}

/// Returns every name that a resolution may have.
pub fn resolution_names() -> impl Iterator<Item = &'static str> {
    ResolutionGroup::ALL.into_iter().map(ResolutionGroup::name).chain(BOTH).chain(Key::ALL.into_iter().map(Key::name))
}

impl Draft {
    /// Sets a number as it is written, in units of `size`. Non-finite numbers are left to the rules.
    pub fn number(&mut self, key: Key, written: f64, size: f64) {
        self.given |= 1 << key.index();
        self.rounding.see(key.group(), written, size);
        self.record.set(key, written * size);
    }

    /// Sets a resolution in SI, for a measure or for single numbers.
    pub fn resolution(&mut self, measure: ResolutionGroup, keys: &[Key], si: f64) {
        let all = std::mem::take(&mut self.record.resolution);
        self.record.resolution =
            if keys.is_empty() { all.with(measure, si) } else { keys.iter().fold(all, |all, key| all.with_key(*key, si)) };
    }

    /// Sets a text by its column name.
    pub fn text(&mut self, name: &str, text: &str) {
        match name {
            "id" => {
                self.has_id = true;
                self.record.id = self.named(name, text);
            }
            "profile" => self.choice(name, text, Profile::ALL, Profile::name, |record, profile| record.profile = profile),
            "group" => self.group = Some(self.named(name, text)),
            "group.agreement" => {
                if let Some(agreement) = self.chosen(name, text, &Agreement::ALL, Agreement::name) {
                    self.agreement = Some(agreement);
                }
            }
            "b1.id" => self.body_names[0] = Some(text.to_owned()),
            "b2.id" => self.body_names[1] = Some(text.to_owned()),
            // Spreadsheets write them in capitals.
            "b1.fixed" | "b2.fixed" => match text.to_ascii_lowercase().as_str() {
                "true" => self.fix(if name == "b1.fixed" { Side::One } else { Side::Two }),
                "false" => (),
                _ => self.complaints.push(name, format!("expected true or false, found {}", excerpt(text))),
            },
            "model.ratio_kind" if text == "fraction" => self.text(name, RatioKind::OfCritical.name()),
            "model.ratio_kind" => self.choice(name, text, RatioKind::ALL, RatioKind::name, |record, kind| record.model.ratio_kind = kind),
            "model.law" => self.choice(name, text, [Law::Brach, Law::KudlichSlibar], law_name, |record, law| record.model.law = law),
            // Other texts are for readers and are ignored.
            _ => (),
        }
    }

    /// Complains of what stands in place of a text: an identifier that is none is not missing too.
    pub fn no_text(&mut self, name: &str, message: String) {
        self.has_id |= name == "id";
        self.complaints.push(name, message);
    }

    /// Makes a body a barrier.
    pub fn fix(&mut self, side: Side) {
        match side {
            Side::One => self.record.one.fixed = true,
            Side::Two => self.record.two.fixed = true,
        }
    }

    /// Completes the record.
    ///
    /// # Errors
    ///
    /// Returns the identifier, as far as it is known, and everything wrong with the record.
    pub fn finish(mut self) -> Result<Drafted, (String, Complaints)> {
        if !self.has_id {
            self.complaints.push("", "`id` is missing: every record has a name of its own");
        }
        if self.body_names[0].is_some() && self.body_names[0] == self.body_names[1] {
            self.complaints.push("b2.id", "both bodies have the same id");
        }
        self.whole_pairs();
        self.barriers();
        if self.agreement.is_some() && self.group.is_none() {
            self.complaints.push("group.agreement", "there is no group that it could be of");
        }
        self.record.group = self.group.take().map(|name| Membership { name, agreement: self.agreement.unwrap_or_default() });
        let Draft { record, rounding, .. } = self;
        if self.complaints.is_empty() { Ok(Drafted { record, rounding }) } else { Err((record.id, self.complaints)) }
    }

    /// Checks that each vector has both of its components.
    fn whole_pairs(&mut self) {
        let of = |side| {
            let centers = [(Key::CenterX(side), Key::CenterY(side)), (Key::CenterAfterX(side), Key::CenterAfterY(side))];
            centers.into_iter().chain([(Key::BeforeX(side), Key::BeforeY(side)), (Key::AfterX(side), Key::AfterY(side))])
        };
        let points = [(Key::PointX, Key::PointY), (Key::PointAfterX, Key::PointAfterY)];
        let pairs = of(Side::One).chain(of(Side::Two)).chain(points);
        for (x, y) in pairs {
            let [has_x, has_y] = [x, y].map(|key| self.given & (1 << key.index()) != 0);
            if has_x != has_y {
                let missing = if has_x { y } else { x };
                if !self.complaints.are_about(missing.name()) {
                    self.complaints.push(missing.name(), "missing, and the other component is there");
                }
            }
        }
    }

    fn barriers(&mut self) {
        for (side, body) in [(Side::One, "b1"), (Side::Two, "b2")] {
            let subject = *self.record.subject(side);
            if !subject.fixed {
                continue;
            }
            if subject.mass.is_some() || subject.yaw_inertia.is_some() {
                self.complaints.push(body, "it is fixed and has a mass or a yaw inertia: a fixed body has neither");
            }
            if [subject.before.yaw_rate, subject.after.yaw_rate].into_iter().flatten().any(|rate| rate != 0.0) {
                self.complaints.push(body, "it is fixed and has a yaw rate: a fixed body does not turn");
            }
        }
        if self.record.one.fixed && self.record.two.fixed {
            self.complaints.push("", "both bodies are fixed, and nothing can move");
        }
    }

    fn named(&mut self, key: &str, text: &str) -> String {
        if text.trim().is_empty() {
            self.complaints.push(key, "it is empty");
        }
        if text.len() > LONGEST_NAME {
            self.complaints.push(key, format!("it is longer than {LONGEST_NAME} bytes: {}", excerpt(text)));
            return excerpt(text);
        }
        text.to_owned()
    }

    fn chosen<T: Copy>(&mut self, key: &str, text: &str, all: &[T], name: impl Fn(T) -> &'static str) -> Option<T> {
        let chosen = all.iter().copied().find(|known| name(*known) == text);
        if chosen.is_none() {
            let names: Vec<&str> = all.iter().map(|known| name(*known)).collect();
            let meant = nearest(text, names.iter().copied()).map_or(String::new(), |near| format!("; did you mean \"{near}\"?"));
            self.complaints.push(key, format!("expected one of \"{}\", found {}{meant}", names.join("\", \""), excerpt(text)));
        }
        chosen
    }

    fn choice<T: Copy, const M: usize>(
        &mut self,
        key: &str,
        text: &str,
        all: [T; M],
        name: impl Fn(T) -> &'static str,
        set: impl FnOnce(&mut Record, T),
    ) {
        if let Some(chosen) = self.chosen(key, text, &all, name) {
            set(&mut self.record, chosen);
        }
    }
}

fn law_name(law: Law) -> &'static str {
    match law {
        Law::Brach => "brach",
        Law::KudlichSlibar => "kudlich-slibar",
    }
}
