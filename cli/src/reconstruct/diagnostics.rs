//! What to look at first: the questions that each reconstruction is asked.

use planar_impact::reconstruct::diagnosis::{Damage, Figure, Finding, Limit, Reading};
use serde::Serialize;

use super::question::Question as Asked;
use super::wording::share;
use crate::case::{Case, Crush};
use crate::units::{Measure, Units};
use crate::wording::trim;
use planar_impact::reconstruct::Solution;

/// The answers to the questions, of the best solution.
pub fn of(asked: &Asked, solved: &Case, best: &Solution) -> Vec<Finding> {
    let damage = solved.setup.crush.each_ref().map(|crush| crush.as_ref().map(damage));
    best.diagnose(&asked.asked, &damage)
}

fn damage(crush: &Crush) -> Damage {
    let damage = Damage { force_origin: crush.force_origin, ..Damage::of(&crush.profile, &crush.zones) };
    match crush.saturation {
        // What was not crushed speaks of no force, and its stiffness was not tried.
        _ if crush.profile.depths().iter().all(|depth| *depth <= 0.0) => Damage { force: None, stiffness: None, ..damage },
        None => damage,
        // Beyond the saturation the force does not grow, and the depth does not tell it.
        Some(_) => Damage { crush_energy: crush.energy(), force: None, stiffness: None, ..damage },
    }
}

/// A finding in the form that other tools read, in SI.
#[derive(Serialize)]
pub struct Document {
    name: &'static str,
    /// `within`, `outside` or `not checked`.
    reading: &'static str,
    figure: Option<f64>,
    limit: Range,
    source: &'static str,
    meaning: String,
}

#[derive(Serialize)]
#[serde(rename_all = "snake_case")]
enum Range {
    AtMost(f64),
    Between(f64, f64),
    SameSign,
}

impl Document {
    pub fn of(finding: &Finding) -> Self {
        Document {
            name: finding.question.name(),
            reading: reading(finding.reading),
            figure: finding.figure.map(Figure::value),
            limit: match finding.limit {
                Limit::AtMost(most) => Range::AtMost(most.value()),
                Limit::Between(least, most) => Range::Between(least.value(), most.value()),
                Limit::SameSign => Range::SameSign,
            },
            source: finding.source,
            meaning: finding.meaning.to_string(),
        }
    }
}

fn reading(reading: Reading) -> &'static str {
    match reading {
        Reading::Within => "within",
        Reading::Outside => "outside",
        Reading::NotChecked => "not checked",
    }
}

/// A finding as a paragraph: the figure, its limit, what it means and where the limit is from.
pub fn paragraph(finding: &Finding, units: Units) -> String {
    let name = finding.question.name();
    let meaning = finding.meaning.with(|figure| say(figure, units));
    let Some(figure) = finding.figure else { return format!("{name}: {meaning}.") };
    let said = match (finding.limit, finding.reading) {
        (Limit::AtMost(most), reading) => format!("{}, {} at most {}", say(figure, units), place(reading), say(most, units)),
        (Limit::Between(least, most), reading) => {
            format!("{}, {} {} to {}", say(figure, units), place(reading), say(least, units), say(most, units))
        }
        (Limit::SameSign, Reading::Outside) => "of OPPOSITE sign".to_owned(),
        (Limit::SameSign, _) if figure.value() == 0.0 => "none to speak of".to_owned(),
        (Limit::SameSign, _) => "of the same sign".to_owned(),
    };
    format!("{name}: {said}. {}. [{}]", capital(&meaning), finding.source)
}

/// What is outside should not be read past.
fn place(reading: Reading) -> &'static str {
    if reading == Reading::Outside { "OUTSIDE" } else { "within" }
}

fn say(figure: Figure, units: Units) -> String {
    match figure {
        Figure::Number(value) => trim((value * 1e3).round() / 1e3),
        Figure::Share(value) => share(value),
        Figure::Angle(value) => units.quantity(Measure::Angle, value),
        // What is left of a sliding that has ended is rounding.
        Figure::Speed(value) => format!("{} {}", units.number(Measure::Speed, value, 1.0), units.unit(Measure::Speed)),
        Figure::YawRate(value) => units.quantity(Measure::YawRate, value),
        // A newton is nothing beside the forces of crush.
        Figure::Force(value) if units == Units::Si && value.abs() >= 1e3 => format!("{:.1} kN", value / 1e3),
        Figure::Force(value) => units.quantity(Measure::Force, value),
    }
}

fn capital(sentence: &str) -> String {
    // The symbols of the mechanics stay small.
    if ["e is", "mu is"].iter().any(|symbol| sentence.starts_with(symbol)) {
        return sentence.to_owned();
    }
    let mut letters = sentence.chars();
    letters.next().map_or(String::new(), |first| first.to_uppercase().chain(letters).collect())
}

/// Whether a question is about the whole, and outside its limit.
pub fn is_outside(finding: &Finding) -> bool {
    finding.reading == Reading::Outside
}

#[cfg(test)]
mod tests {
    use super::*;
    use planar_impact::reconstruct::diagnosis::{Meaning, Question};

    #[test]
    fn a_finding_reads_as_a_paragraph() {
        let finding = |figure, limit, reading| Finding {
            question: Question::ImpulseRatio,
            reading,
            figure,
            limit,
            source: "a book",
            meaning: Meaning::of("mu is low"),
        };
        let limit = Limit::Between(Figure::Share(0.9), Figure::Share(1.0));
        let say = |finding: Finding| paragraph(&finding, Units::Si);
        assert_eq!(
            say(finding(Some(Figure::Share(0.5)), limit, Reading::Outside)),
            "impulse ratio: 50 %, OUTSIDE 90 % to 100 %. mu is low. [a book]"
        );
        assert_eq!(say(finding(None, limit, Reading::NotChecked)), "impulse ratio: mu is low.");
        let same = finding(Some(Figure::Number(-1.0)), Limit::SameSign, Reading::Outside);
        assert_eq!(say(same), "impulse ratio: of OPPOSITE sign. mu is low. [a book]");
        let angle = finding(Some(Figure::Angle(0.5)), Limit::AtMost(Figure::Angle(1.0)), Reading::Within);
        assert_eq!(say(angle), "impulse ratio: 28.6 deg, within at most 57.3 deg. mu is low. [a book]");
        let force = |value, units| super::say(Figure::Force(value), units);
        assert_eq!([force(299_345.0, Units::Si), force(120.0, Units::Si)], ["299.3 kN", "120 N"]);
        // 1 lbf = 4.4482216152605 N.
        assert_eq!(force(44_482.216, Units::Us), "10000.0 lbf");
    }
}
