//! The account of energy: from the kinetic energy before the impact, over the work of each component of the impulse, to that after it.

use planar_impact_app::issue::Issues;
use planar_impact_app::solve::Solution;
use planar_impact_app::units::Measure;
use planar_impact_app::{Answer, Units};
use plotters::prelude::Color;
use plotters::style::text_anchor::VPos;

use crate::page::solve::loss_share;

use super::canvas::{Area, BLUE, DARK, Drawn, GRAY, VERMILION, Writing, hatch, outline, page, px, rectangle, segment};

/// Height of a bar and of its row, in pixels.
const BAR: i32 = 30;
const ROW: i32 = 46;
/// Upper edge of the first bar, and the ends of the longest bar.
const TOP: i32 = 16;
const LEFT: i32 = 280;
const RIGHT: i32 = 720;

/// Draws the energy before the impact, each work, and the energy after it, as bars that continue each other.
///
/// # Errors
///
/// A defect: drawing into memory cannot fail.
pub fn energy(answer: &Answer<Solution>, units: Units) -> Result<String, Issues> {
    let bars = bars(answer);
    let height = px((2 * TOP + ROW * bars.len() as i32) as u32);
    let of = |bar: &Bar| format!("{} {}", bar.name, number(answer, units, bar.value));
    let description = bars.iter().map(of).collect::<Vec<_>>().join("; ") + ".";
    let title = if answer.title.is_empty() { "Energy".to_owned() } else { format!("Energy: {}", answer.title) };
    page(&title, &description, height, |area| draw(area, answer, &bars, units))
}

/// A bar between two energies, in SI.
#[derive(Debug, PartialEq)]
struct Bar {
    name: &'static str,
    /// Where the one before it ends, and where it ends itself.
    ends: [f64; 2],
    /// The energy that it shows, with its sign.
    value: f64,
    kind: Kind,
}

/// What a bar shows.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    /// The energy before or after.
    Kinetic,
    Work,
    /// All works together.
    Loss,
}

fn bars(answer: &Solution) -> Vec<Bar> {
    let energy = &answer.energy;
    let mut bars = vec![Bar { name: "kinetic energy before", ends: [0.0, energy.before], value: energy.before, kind: Kind::Kinetic }];
    let works = [
        ("work of the normal impulse, W_n", Some(energy.normal_work)),
        ("work of the tangential impulse, W_t", Some(energy.tangential_work)),
        ("work of the moment impulse, W_m", energy.moment_work),
    ];
    let mut level = energy.before;
    for (name, work) in works {
        let Some(work) = work else { continue };
        bars.push(Bar { name, ends: [level, level + work], value: work, kind: Kind::Work });
        level += work;
    }
    bars.push(Bar { name: "kinetic energy after", ends: [0.0, energy.after], value: energy.after, kind: Kind::Kinetic });
    bars.push(Bar { name: "energy loss, T_L", ends: [energy.after, energy.before], value: energy.loss, kind: Kind::Loss });
    bars
}

fn number(answer: &Solution, units: Units, value: f64) -> String {
    let (measure, unit) = (Measure::Energy, units.unit(Measure::Energy));
    format!("{} {unit}", units.number(measure, value, answer.scale(measure)))
}

fn draw(area: &Area<'_>, answer: &Solution, bars: &[Bar], units: Units) -> Drawn {
    let values = || bars.iter().flat_map(|bar| bar.ends);
    let (least, greatest) = values().fold((0.0_f64, 0.0_f64), |(least, greatest), value| (least.min(value), greatest.max(value)));
    let length = greatest - least;
    let across = |value: f64| if length > 0.0 { LEFT + (f64::from(RIGHT - LEFT) * (value - least) / length).round() as i32 } else { LEFT };
    for (row, bar) in bars.iter().enumerate() {
        let top = TOP + ROW * row as i32;
        let (from, to) = ((across(bar.ends[0]), top), (across(bar.ends[1]), top + BAR));
        match bar.kind {
            Kind::Kinetic => rectangle(area, from, to, BLUE.mix(0.75).filled())?,
            Kind::Work => {
                rectangle(area, from, to, VERMILION.mix(0.25).filled())?;
                hatch(area, from, to, VERMILION.stroke_width(px(1)))?;
            }
            Kind::Loss => rectangle(area, from, to, VERMILION.mix(0.25).filled())?,
        }
        outline(area, from, to, DARK)?;
        // The next one continues where this ends.
        if row + 1 < bars.len() {
            segment(area, (to.0, to.1), (to.0, top + ROW), GRAY.stroke_width(px(1)))?;
        }
        let middle = top + BAR / 2;
        Writing { size: 15, down: VPos::Center, ..Writing::ending() }.write(area, bar.name, (LEFT - 12, middle))?;
        let share = loss_share(answer).filter(|_| bar.kind == Kind::Loss);
        let text = number(answer, units, bar.value) + &share.map_or_else(String::new, |share| format!(" ({:.1} %)", 100.0 * share));
        Writing { size: 15, down: VPos::Center, ..Writing::default() }.write(area, &text, (from.0.max(to.0) + 10, middle))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::samples::{assert_legible, hostile, pairs};
    use super::*;

    #[test]
    fn each_bar_begins_where_the_one_before_ends() {
        let mut gains = 0;
        for [answer, _] in pairs(200) {
            let (bars, energy) = (bars(&answer), &answer.energy);
            let size = 1e-9 * energy.before;
            let close = |one: f64, other: f64| assert!((one - other).abs() <= size, "{one}, not {other}");
            let [before, works @ .., after, loss] = &bars[..] else { panic!("four bars or more") };
            close(before.ends[1] - before.ends[0], energy.before);
            close(after.ends[1] - after.ends[0], energy.after);
            let mut level = before.ends[1];
            for work in works {
                close(work.ends[0], level);
                close(work.ends[1] - work.ends[0], work.value);
                level = work.ends[1];
                gains += usize::from(work.value > 0.0);
            }
            close(level, after.ends[1]);
            close(loss.ends[1] - loss.ends[0], loss.value);
            close(loss.value, -works.iter().map(|work| work.value).sum::<f64>());
            assert_eq!(works.len(), if energy.moment_work.is_some() { 3 } else { 2 });
        }
        assert!(gains > 0, "a tangential work may be positive");
    }

    #[test]
    fn every_account_is_legible() {
        for [mut answer, _] in pairs(100) {
            assert_legible(&energy(&answer, Units::Us).expect("in memory"));
            answer.title = hostile();
            assert_legible(&energy(&answer, Units::Si).expect("in memory"));
        }
    }
}
