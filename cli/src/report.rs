//! The result of `solve` as a person reads it.

use planar_impact::{Admissible, Impact, ImpulseRatio, Law, Moment, Party, Response, Xy};

use unicode_width::{UnicodeWidthChar, UnicodeWidthStr};

use crate::bracket::Bracket;
use crate::case::{Case, CrushAnswers};
use crate::table::{self, Align};
use crate::units::{Measure, Units};

/// The report, in tables of at most 80 columns.
pub fn render(case: &Case, impact: &Impact, bracket: Option<&Bracket<'_>>, units: Units, notes: &[String]) -> String {
    let page = Page::of(case, impact, units);
    let mut text = heading(&case.title);
    text.push_str(&page.tables());
    if let Some(bracket) = bracket {
        text.push_str(&bracket.render(units));
        text.push('\n');
    }
    text.push_str(&page.remarks());
    text.push_str(&notes_below(notes));
    text
}

/// The tables alone, and the coefficients below them.
pub fn tables(case: &Case, impact: &Impact, units: Units) -> String {
    let page = Page::of(case, impact, units);
    page.tables() + &page.remarks()
}

/// The title of a file with an empty line behind it; nothing where it has none.
pub fn heading(title: &str) -> String {
    if title.is_empty() { String::new() } else { table::wrap(&clean(title), "") + "\n" }
}

/// What was taken for granted and what deserves a second look, a paragraph each.
pub fn notes_below(notes: &[String]) -> String {
    notes.iter().map(|note| table::wrap(&format!("{note}."), "Note: ")).collect()
}

struct Page<'a> {
    case: &'a Case,
    impact: &'a Impact,
    units: Units,
    /// The greatest speed and energy: what is 10⁻¹² of them is rounding.
    speed: f64,
    energy: f64,
}

fn speed_scale(case: &Case, impact: &Impact) -> f64 {
    let motions =
        [&case.collision.one, &case.collision.two].map(|party| party.vehicle().map_or(Xy::zero(), |vehicle| vehicle.motion.velocity));
    let all = [motions[0], motions[1], impact.one.after.velocity, impact.two.after.velocity];
    all.iter().map(|v| v.length()).fold(impact.approach.length(), f64::max)
}

fn energy_scale(impact: &Impact) -> f64 {
    let exchanged = impact.impulse.length() * impact.approach.length();
    impact.kinetic_energy.before.max(impact.kinetic_energy.after).max(exchanged)
}

impl<'a> Page<'a> {
    fn of(case: &'a Case, impact: &'a Impact, units: Units) -> Self {
        Page { case, impact, units, speed: speed_scale(case, impact), energy: energy_scale(impact) }
    }
}

impl Page<'_> {
    fn tables(&self) -> String {
        [self.vehicles(), self.contact(), self.energies()].map(|section| section + "\n\n").concat()
    }

    fn speed(&self, value: f64) -> String {
        self.units.number(Measure::Speed, value, self.speed)
    }

    fn energy(&self, value: f64) -> String {
        self.units.number(Measure::Energy, value, self.energy)
    }

    fn vehicles(&self) -> String {
        let unit = |measure| self.units.unit(measure).to_owned();
        let sides = [(&self.case.collision.one, &self.impact.one), (&self.case.collision.two, &self.impact.two)];
        let row = |what: &str, unit: String, value: &dyn Fn(&planar_impact::Vehicle, &Response) -> String| {
            let cell = |(party, response): (&Party, &Response)| {
                party.vehicle().map_or_else(|| "fixed".to_owned(), |vehicle| value(vehicle, response))
            };
            vec![what.to_owned(), unit, cell(sides[0]), cell(sides[1])]
        };
        let yaw = |rate: f64| self.units.number(Measure::YawRate, rate, 1.0);
        let names = [0, 1].map(|i| shorten(&self.case.names[i], 18));
        let mut rows = vec![
            row("before: velocity x", unit(Measure::Speed), &|v, _| self.speed(v.motion.velocity.x)),
            row("        velocity y", unit(Measure::Speed), &|v, _| self.speed(v.motion.velocity.y)),
            row("        yaw rate", unit(Measure::YawRate), &|v, _| yaw(v.motion.yaw_rate)),
            row("after:  velocity x", unit(Measure::Speed), &|_, r| self.speed(r.after.velocity.x)),
            row("        velocity y", unit(Measure::Speed), &|_, r| self.speed(r.after.velocity.y)),
            row("        yaw rate", unit(Measure::YawRate), &|_, r| yaw(r.after.yaw_rate)),
            row("delta-V", unit(Measure::Speed), &|_, r| self.speed(r.delta_v_magnitude())),
            row("", unit(Measure::RoadSpeed), &|_, r| self.units.number(Measure::RoadSpeed, r.delta_v_magnitude(), self.speed)),
            row("PDOF, clockwise from ahead", unit(Measure::Angle), &|_, r| {
                self.units.number(Measure::Angle, r.principal_direction_of_force(), 1.0)
            }),
        ];
        rows.extend(self.crush());
        let columns = [Align::Left, Align::Left, Align::Right, Align::Right];
        table::render(&["", "unit", &names[0], &names[1]], &columns, &rows)
    }

    /// What the crush that the file reports stands for; nothing where it reports none.
    fn crush(&self) -> Vec<Vec<String>> {
        let answers = self.case.setup.crush_answers();
        let row = |what: &str, measure, value: fn(&CrushAnswers) -> f64| {
            let cell =
                |crush: &Option<CrushAnswers>| crush.as_ref().map_or("-".to_owned(), |crush| self.units.number(measure, value(crush), 0.0));
            vec![what.to_owned(), self.units.unit(measure).to_owned(), cell(&answers[0]), cell(&answers[1])]
        };
        if answers.iter().all(Option::is_none) {
            return Vec::new();
        }
        vec![
            row("crush: mean depth", Measure::Length, |crush| crush.mean_depth),
            row("       crush energy", Measure::Energy, |crush| crush.energy),
            row("       equivalent speed", Measure::Speed, |crush| crush.equivalent_speed),
        ]
    }

    fn contact(&self) -> String {
        let unit = |measure| self.units.unit(measure).to_owned();
        let impulse = |value: f64| self.units.number(Measure::Impulse, value, self.impact.impulse.length());
        let (p, v, s) = (self.impact.impulse, self.impact.approach, self.impact.separation);
        let mut rows = vec![
            vec!["approach velocity at the impact center".into(), unit(Measure::Speed), self.speed(v.n), self.speed(v.t)],
            vec!["separation velocity".into(), unit(Measure::Speed), self.speed(s.n), self.speed(s.t)],
            vec!["impulse on vehicle 1".into(), unit(Measure::Impulse), impulse(p.n), impulse(p.t)],
            vec![
                "work of the impulse, W_n and W_t".into(),
                unit(Measure::Energy),
                self.energy(self.impact.work.n),
                self.energy(self.impact.work.t),
            ],
        ];
        if self.case.collision.moment != Moment::None {
            let moment = self.units.number(Measure::MomentImpulse, self.impact.moment, 0.0);
            rows.push(vec!["moment impulse on vehicle 1".into(), unit(Measure::MomentImpulse), moment, String::new()]);
            rows.push(vec![
                "work of the moment impulse, W_m".into(),
                unit(Measure::Energy),
                self.energy(self.impact.work.m),
                String::new(),
            ]);
        }
        let columns = [Align::Left, Align::Left, Align::Right, Align::Right];
        table::render(&["contact", "unit", "normal", "tangential"], &columns, &rows)
    }

    fn energies(&self) -> String {
        let energy = self.impact.kinetic_energy;
        let share = 100.0 * self.impact.loss() / energy.before;
        let row = |what: &str, value: f64| vec![what.to_owned(), self.units.unit(Measure::Energy).to_owned(), self.energy(value)];
        let rows = [
            row("kinetic energy before", energy.before),
            row("kinetic energy after", energy.after),
            row(&format!("energy loss T_L ({share:.1} %)"), self.impact.loss()),
        ];
        table::render(&["energy", "unit", ""], &[Align::Left, Align::Left, Align::Right], &rows)
    }

    /// The coefficients, the law in force, and how far they may go.
    fn remarks(&self) -> String {
        let ratio = |value: f64| self.units.number(Measure::Ratio, value, 1.0);
        let collision = &self.case.collision;
        let plane = self.units.quantity(Measure::Angle, self.case.inputs.contact.crush_plane);
        let kind = match collision.impulse_ratio {
            ImpulseRatio::Critical => "critical".to_owned(),
            ImpulseRatio::Given(_) => "given".to_owned(),
            ImpulseRatio::OfCritical(fraction) => format!("{} of critical", ratio(fraction)),
            ImpulseRatio::LimitedByFriction(friction) => format!("limited by friction {}", ratio(friction)),
        };
        let law = match collision.law {
            Law::Brach => "Brach",
            Law::KudlichSlibar => "Kudlich-Slibar",
        };
        let mut text = format!(
            "Crush plane Gamma = {plane}, restitution e = {}, law of {law}.\nImpulse ratio mu = {} ({kind}), critical mu0 = {}.\n",
            ratio(collision.restitution),
            ratio(self.impact.impulse_ratio()),
            ratio(self.impact.critical_impulse_ratio()),
        );
        if let Some(admissible) = collision.admissible() {
            text.push_str(&bounds(&admissible, &ratio));
        }
        text
    }
}

fn bounds(admissible: &Admissible, ratio: &dyn Fn(f64) -> String) -> String {
    let end = |bound: Option<f64>| bound.map_or_else(|| "any".to_owned(), ratio);
    let up_to = |bound: f64| if bound >= 1.0 { "1".to_owned() } else { ratio(bound) };
    format!(
        "No energy is gained up to e = {} here (up to {} for any approach),\nnor, at this e, for mu from {} to {}.\n",
        up_to(admissible.restitution),
        up_to(admissible.restitution_for_any_approach),
        end(admissible.least_impulse_ratio),
        end(admissible.greatest_impulse_ratio),
    )
}

/// Without line breaks, escapes and changes of direction, which must not reach the terminal.
pub fn clean(text: &str) -> String {
    let turns = |c: char| matches!(c, '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    text.chars().map(|c| if c.is_control() || turns(c) { ' ' } else { c }).collect()
}

/// A name of at most so many columns, which leaves room for the table.
pub fn shorten(name: &str, most: usize) -> String {
    let clean = clean(name);
    if clean.width() <= most {
        return clean;
    }
    let mut short = String::new();
    for c in clean.chars() {
        if short.width() + c.width().unwrap_or(0) >= most {
            break;
        }
        short.push(c);
    }
    short + "…"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_fit_their_column() {
        assert_eq!(shorten("sedan", 18), "sedan");
        assert_eq!(shorten("a sedan of a very long name", 18), "a sedan of a very…");
        assert_eq!(shorten("\u{1b}[31mred", 18), " [31mred");
        assert_eq!(shorten("a\u{202e}b\u{2028}c", 18), "a b c");
        assert!(shorten(&"漢".repeat(20), 18).width() <= 18);
    }
}
