//! Diagnostics: what users of crash programs ask next.

use planar_impact::reconstruct::diagnosis::{Figure, Finding, Limit};
use planar_impact_app::reconstruct::Reconstruction;
use planar_impact_app::reconstruct::diagnostics::{Diagnostic, Status};
use planar_impact_app::units::trim;
use planar_impact_app::units::{Measure, Units};

use crate::block::Block;
use crate::page::rounding::share;

/// Renders a line for each diagnostic; those outside their limit come first.
pub fn blocks(answer: &Reconstruction, units: Units) -> Vec<Block> {
    let all = &answer.diagnostics;
    if all.is_empty() {
        return Vec::new();
    }
    let is_outside = |diagnostic: &&Diagnostic| diagnostic.reading == Status::Outside;
    let heading = match all.iter().filter(is_outside).count() {
        0 => "Diagnostics; no figure is outside its limit:".to_owned(),
        1 => "Diagnostics; one figure is outside its limit:".to_owned(),
        count => format!("Diagnostics; {count} figures are outside their limits:"),
    };
    let (first, then): (Vec<_>, Vec<_>) = all.iter().partition(is_outside);
    let item = |diagnostic: &Diagnostic| Block::item("- ", sentence(diagnostic, units));
    std::iter::once(Block::paragraph(heading)).chain(first.into_iter().chain(then).map(item)).collect()
}

/// Formats the figure, its limit, its interpretation and the source of the limit.
fn sentence(diagnostic: &Diagnostic, units: Units) -> String {
    let Finding { figure, limit, meaning, .. } = &diagnostic.finding;
    let name = diagnostic.name;
    let meaning = meaning.with(|figure| quantity(figure, units));
    let Some(figure) = *figure else { return format!("{name}: {meaning}.") };
    let place = if diagnostic.reading == Status::Outside { "outside" } else { "within" };
    let quantity = |figure| quantity(figure, units);
    let lies = match *limit {
        Limit::AtMost(most) => format!("{}, {place} at most {}", quantity(figure), quantity(most)),
        Limit::Between(least, most) => format!("{}, {place} {} to {}", quantity(figure), quantity(least), quantity(most)),
        Limit::SameSign if diagnostic.reading == Status::Outside => "of opposite sign".to_owned(),
        Limit::SameSign if figure.value() == 0.0 => "negligible".to_owned(),
        Limit::SameSign => "of the same sign".to_owned(),
    };
    format!("{name}: {lies}. {}. [{}]", capital(&meaning), diagnostic.source)
}

fn quantity(figure: Figure, units: Units) -> String {
    match figure {
        Figure::Number(value) => trim((value * 1e3).round() / 1e3),
        Figure::Share(value) => share(value),
        Figure::Angle(value) => units.quantity(Measure::Angle, value),
        // A residual sliding velocity is rounding if the sliding has ended.
        Figure::Speed(value) => format!("{} {}", units.number(Measure::Speed, value, 1.0), units.unit(Measure::Speed)),
        Figure::YawRate(value) => units.quantity(Measure::YawRate, value),
        Figure::Force(value) if units == Units::Si && value.abs() >= 1e3 => format!("{:.1} kN", value / 1e3),
        Figure::Force(value) => units.quantity(Measure::Force, value),
    }
}

fn capital(sentence: &str) -> String {
    // Symbols of the mechanics stay in lower case.
    if ["e is", "mu is"].iter().any(|symbol| sentence.starts_with(symbol)) {
        return sentence.to_owned();
    }
    let mut letters = sentence.chars();
    letters.next().map_or(String::new(), |first| first.to_uppercase().chain(letters).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use planar_impact::reconstruct::diagnosis::{Meaning, Question, Reading};
    use planar_impact_app::reconstruct::diagnostics::Range;

    #[test]
    fn a_diagnostic_reads_as_a_sentence() {
        let sentence = |figure, limit, reading, status| {
            let finding =
                Finding { question: Question::ImpulseRatio, reading, figure, limit, source: "a book", meaning: Meaning::of("mu is low") };
            let diagnostic = Diagnostic {
                name: "impulse ratio",
                reading: status,
                figure: None,
                limit: Range::SameSign,
                source: "a book",
                meaning: String::new(),
                finding,
            };
            sentence(&diagnostic, Units::Si)
        };
        let limit = Limit::Between(Figure::Share(0.9), Figure::Share(1.0));
        assert_eq!(
            sentence(Some(Figure::Share(0.5)), limit, Reading::Outside, Status::Outside),
            "impulse ratio: 50 %, outside 90 % to 100 %. mu is low. [a book]"
        );
        assert_eq!(sentence(None, limit, Reading::NotChecked, Status::NotChecked), "impulse ratio: mu is low.");
        assert_eq!(
            sentence(Some(Figure::Number(-1.0)), Limit::SameSign, Reading::Outside, Status::Outside),
            "impulse ratio: of opposite sign. mu is low. [a book]"
        );
        assert_eq!(
            sentence(Some(Figure::Angle(0.5)), Limit::AtMost(Figure::Angle(1.0)), Reading::Within, Status::Within),
            "impulse ratio: 28.6 deg, within at most 57.3 deg. mu is low. [a book]"
        );
        assert_eq!([quantity(Figure::Force(299_345.0), Units::Si), quantity(Figure::Force(120.0), Units::Si)], ["299.3 kN", "120 N"]);
        // 1 lbf = 4.4482216152605 N.
        assert_eq!(quantity(Figure::Force(44_482.216), Units::Us), "10000.0 lbf");
    }
}
