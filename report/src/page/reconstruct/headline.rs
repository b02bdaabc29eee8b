//! The verdict and the next step, at the top of the page.

use planar_impact_app::named::Named;
use planar_impact_app::plain_text::shorten;
use planar_impact_app::reconstruct::{FurthestOff, Reconstruction, Unknown};
use planar_impact_app::units::trim;
use planar_impact_app::units::{Measure, Units};
use planar_impact_app::wording::degrees_of_freedom;

use super::super::SUMMARY_WIDTH;
use super::unknowns::beyond;
use crate::block::Block;
use crate::page::rounding::{digits, probability, rounded, share, with_spread};

/// Renders the verdict.
pub fn blocks(answer: &Reconstruction, units: Units) -> Vec<Block> {
    let mut blocks = verdict(answer, units);
    blocks.extend(values(answer, units));
    blocks.extend(answer.limits.iter().filter_map(|limit| Some(Block::item("- ", at_the_edge(limit, beyond(limit)?)))));
    blocks
}

/// Renders the value of each unknown with its interval, if the evidence agrees with one solution.
fn values(answer: &Reconstruction, units: Units) -> Vec<Block> {
    if answer.verdict != "agrees" {
        return Vec::new();
    }
    let unknowns = answer.unknown.iter().filter(|(_, unknown)| !unknown.is_input);
    unknowns.filter_map(|(name, unknown)| Some(Block::item("- ", value(answer, name, unknown, unknown.value?, units)))).collect()
}

fn value(answer: &Reconstruction, name: &str, unknown: &Unknown, value: f64, units: Units) -> String {
    let measure = units.on_the_road(unknown.measure).unwrap_or(unknown.measure);
    let step = unknown.sd.or_else(|| Some((unknown.interval.high? - unknown.interval.low?) / 4.0));
    let end = |end: Option<f64>| end.map_or_else(|| "no limit".to_owned(), |end| rounded(measure, end, step, units));
    let (low, high) = (end(unknown.interval.low), end(unknown.interval.high));
    let whose = vehicle_of(answer, name).map_or_else(String::new, |vehicle| format!(" ({})", shorten(vehicle, SUMMARY_WIDTH)));
    // Without any uncertainty the interval has the tolerance of exact evidence alone.
    let step = step.filter(|_| answer.has_uncertainty());
    let (value, unit) = (rounded(measure, value, step, units), units.unit(measure));
    let space = if unit.is_empty() { "" } else { " " };
    if !answer.has_uncertainty() {
        return format!("{name}{whose}: {value}{space}{unit}.");
    }
    format!("{name}{whose}: {value}{space}{unit}, {} from {low} to {high}.", share(unknown.interval.level))
}

/// Returns the name of the vehicle that an unknown belongs to.
fn vehicle_of<'a>(answer: &'a Reconstruction, name: &str) -> Option<&'a str> {
    let number: usize = name.strip_prefix("vehicle.")?.split('.').next()?.parse().ok()?;
    Some(&answer.solution.as_ref()?.vehicles.get(number.checked_sub(1)?)?.name)
}

/// Explains a best fit at the edge of the physics.
fn at_the_edge(limit: &str, beyond: &str) -> String {
    let hint = match limit {
        "beyond-critical" => {
            " The evidence implies more tangential impulse than ends the sliding, or one that speeds it up: something snagged, or the crush plane is another."
        }
        "not-closing" => " A normal impulse of zero means little: re-examine the crush plane and the directions.",
        _ => " Re-examine the geometry.",
    };
    format!("The best fit lies at the edge of the physics: beyond it {beyond}.{hint}")
}

fn verdict(answer: &Reconstruction, units: Units) -> Vec<Block> {
    match answer.verdict {
        "agrees" => agrees(answer),
        "several solutions" if answer.other_separations => other_separations(answer),
        "several solutions" => several(answer),
        "undetermined" => undetermined(answer, units),
        "contradicted" if answer.is_contradicted_by_path() => path_contradicted(answer),
        "contradicted" => contradicted(answer, units),
        "bounds exclude" => bounds_exclude(answer, units),
        other => vec![headline(format!("{other}: {}.", chi_square(answer)))],
    }
}

fn headline(text: impl Into<String>) -> Block {
    Block::Heading { level: 2, text: text.into() }
}

/// Formats χ², its degrees of freedom and its probability.
fn chi_square(answer: &Reconstruction) -> String {
    let degrees = degrees_of_freedom(answer.degrees_of_freedom);
    if answer.degrees_of_freedom == 0 && answer.chi_square < 1e-9 {
        return format!("chi-square 0 with {degrees}");
    }
    format!("chi-square {} with {degrees}, probability {}", digits(answer.chi_square), probability(answer.probability))
}

fn agrees(answer: &Reconstruction) -> Vec<Block> {
    /// Probability below which the agreement is poor.
    const POOR: f64 = 0.05;
    let weak = &answer.weakly_determined;
    let mut but = if weak.is_empty() { String::new() } else { format!(", but evidence barely constrains {}", weak.join(", ")) };
    if !answer.is_answer && weak.is_empty() {
        but = format!(", but does not narrow {} down", answer.not_narrowed().collect::<Vec<_>>().join(", "));
    }
    let poorly = if answer.probability < POOR { " poorly" } else { "" };
    let mut blocks = vec![headline(format!("The evidence agrees{poorly} with one solution{but}: {}.", chi_square(answer)))];
    if !poorly.is_empty() {
        blocks.extend(poor_agreement(answer));
    }
    if answer.degrees_of_freedom == 0 {
        blocks.push(Block::paragraph("The evidence is just enough: no piece checks another. One more would."));
    } else if let Some((name, residual)) = off(&answer.furthest_off).filter(|(_, residual)| residual.abs() > 1e-3) {
        blocks.push(Block::paragraph(format!("Furthest off is {name}, by {:.1} standard deviations.", residual.abs())));
    }
    blocks
}

/// Explains a poor agreement: by chance, or because an unknown would go further than its bound.
fn poor_agreement(answer: &Reconstruction) -> Vec<Block> {
    let chance = format!(
        "Poor agreement: by chance alone, evidence is this far off in {} of 100 cases. Re-examine the piece that is furthest off.",
        digits(answer.probability * 100.0)
    );
    let held = answer.unknown.iter().filter(|(_, unknown)| unknown.at_bound.is_some() && unknown.sd.is_none());
    let further = held.map(|(name, unknown)| {
        let bound = if unknown.at_bound == Some("min") { "lower" } else { "upper" };
        Block::item("- ", format!("{name} would go beyond its {bound} bound: is there a reason for that bound?"))
    });
    std::iter::once(Block::paragraph(chance)).chain(further).collect()
}

fn off(furthest: &Option<FurthestOff>) -> Option<(&'static str, f64)> {
    let furthest = furthest.as_ref()?;
    Some((furthest.name, furthest.evidence.standardised_residual?))
}

fn several(answer: &Reconstruction) -> Vec<Block> {
    let count = answer.solutions.len();
    vec![
        headline(format!("The evidence agrees with {count} solutions and cannot distinguish them; none of them alone is the answer.")),
        Block::paragraph(
            "Next: find evidence in which they differ, or a reason for a bound that leaves one. All are listed below; the rest of this page is \
             about the first, which has the least chi-square.",
        ),
    ]
}

/// Explains that several separations lead to the same rest positions and agree with the evidence.
fn other_separations(answer: &Reconstruction) -> Vec<Block> {
    let count = 1 + answer.by_other_separations.len();
    vec![
        headline(format!(
            "{count} separations lead to the same rest positions, and the evidence cannot distinguish them; none of them alone is the answer. {}.",
            chi_square(answer)
        )),
        Block::paragraph(
            "Next: give `points` along the path, such as tire marks, which decide between them. The answer from each is listed below; the rest of this page is \
             about the first, which fits best.",
        ),
    ]
}

/// Explains that a rest position and the points along the path contradict each other.
fn path_contradicted(answer: &Reconstruction) -> Vec<Block> {
    vec![
        headline("Inconsistent evidence: no slide comes past the points and ends in the rest position."),
        Block::paragraph(format!(
            "The rest of the evidence agrees: {}. Next: look at the residuals of the points below; check which wheel made each mark, the heading at rest \
             with its whole turns, and which wheels were locked.",
            chi_square(answer)
        )),
    ]
}

fn undetermined(answer: &Reconstruction, units: Units) -> Vec<Block> {
    let mut blocks = vec![headline("Underdetermined: these combinations are not constrained by the evidence.")];
    blocks.extend(open_directions(answer, units));
    blocks.push(Block::paragraph(
        "Next: add evidence that depends on one of them, or take one as known. An open unknown has no value below; its interval is what the bounds and \
         the other evidence allow.",
    ));
    blocks
}

fn open_directions(answer: &Reconstruction, units: Units) -> impl Iterator<Item = Block> {
    answer.open_directions.iter().map(move |direction| Block::item("- ", format!("{}.", in_words(direction, answer, units))))
}

/// Describes how unknowns can change together without contradicting the evidence: `vehicle.1.speed by 1 m/s with
/// vehicle.2.speed by -1 m/s`.
fn in_words(direction: &Named<f64>, answer: &Reconstruction, units: Units) -> String {
    let part = |(of, by): (&str, &f64)| {
        let measure = measure(answer, of);
        format!("{of} by {} {}", trim(units.convert(measure, *by)), units.unit(measure)).trim_end().to_owned()
    };
    direction.iter().map(part).collect::<Vec<_>>().join(" with ")
}

fn measure(answer: &Reconstruction, of: &str) -> Measure {
    answer.unknown.get(of).map_or(Measure::Ratio, |unknown| unknown.measure)
}

fn contradicted(answer: &Reconstruction, units: Units) -> Vec<Block> {
    let furthest = match &answer.furthest_off {
        Some(furthest) => furthest_off(furthest, units),
        None => "All of it was given as exact, and no unknowns fit it.".to_owned(),
    };
    let is_exact = |furthest: &FurthestOff| furthest.evidence.sd.is_none();
    let next = match &answer.furthest_off {
        Some(furthest) if is_exact(furthest) => "re-examine that piece, and give its standard deviation",
        Some(_) => "re-examine that piece and its standard deviation",
        None => "re-examine the evidence, and give the standard deviation of each piece",
    };
    let reached = if answer.degrees_of_freedom == 0 { " The mechanics reaches no better fit." } else { "" };
    let mut blocks = vec![
        headline(format!("Inconsistent evidence: at the best fit, {}.", chi_square(answer))),
        Block::paragraph(furthest),
        Block::paragraph(format!(
            "Next: {next} first, then the geometry: impact center and crush plane.{reached} The numbers below are the best fit, and not an answer."
        )),
    ];
    if !answer.open_directions.is_empty() {
        blocks.push(Block::paragraph("It is one of many that fit as badly: these combinations are not constrained by the evidence."));
        blocks.extend(open_directions(answer, units));
    }
    blocks
}

/// Describes the residual of a piece of evidence, in its unit and in standard deviations.
fn furthest_off(furthest: &FurthestOff, units: Units) -> String {
    let FurthestOff { name, evidence } = furthest;
    let quantity = |value| {
        let number = rounded(evidence.measure, value, evidence.sd, units);
        format!("{number} {}", units.unit(evidence.measure)).trim_end().to_owned()
    };
    let apart = match evidence.standardised_residual {
        Some(residual) => format!("{:.1} standard deviations apart", residual.abs()),
        None => "although it was given as exact".to_owned(),
    };
    format!("Furthest off is {name}: given {}, computed {}, {apart}.", quantity(evidence.given), quantity(evidence.computed))
}

fn bounds_exclude(answer: &Reconstruction, units: Units) -> Vec<Block> {
    let mut blocks = vec![headline(format!("Best fit lies outside the bounds: within them, {}.", chi_square(answer)))];
    if let Some(free) = &answer.without_bounds {
        for (name, within) in answer.unknown.iter() {
            let Some((bound, value)) = within.at_bound.zip(within.value) else { continue };
            let without = free.unknown.get(name).copied().unwrap_or(f64::NAN);
            let sd = free.sd.get(name).copied().flatten();
            let held = with_spread(within.measure, value, None, units);
            let fitted = with_spread(within.measure, without, sd, units);
            blocks.push(Block::item("- ", format!("{name} is held at its {bound}, {held}; without bounds the best fit is {fitted}.")));
        }
        blocks.push(Block::paragraph(format!("Without bounds chi-square is {}.", digits(free.chi_square))));
    }
    blocks.push(Block::paragraph(
        "Next: re-examine the reason for that bound, then the evidence. The numbers below are the best within the bounds, and not an answer.",
    ));
    blocks
}
