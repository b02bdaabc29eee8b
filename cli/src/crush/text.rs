//! What the crush stands for, as a person reads it.

use planar_impact::crush::{CrushStiffness, ForceLine};

use crate::case::{Case, Crush, CrushAnswers};
use crate::report::{heading, notes_below, shorten};
use crate::table::{self, Align, wrap};
use crate::units::{Measure, Units};

/// The report, in tables of at most 80 columns.
pub fn render(case: &Case, units: Units) -> String {
    let page = Page { case, units, answers: case.setup.crush_answers() };
    let mut text = heading(&case.title);
    text.push_str(&page.vehicles());
    text.push('\n');
    for i in [0, 1] {
        text.push_str(&page.zones(i).map(|zones| format!("\n{zones}\n")).unwrap_or_default());
    }
    text.push('\n');
    text.push_str(&wrap("E_C = d0^2 K1 + d0 d1 K2 + d1^2 K3, the depth taken straight between two stations.", ""));
    text.push_str(&notes_below(&case.notes));
    text
}

struct Page<'a> {
    case: &'a Case,
    units: Units,
    answers: [Option<CrushAnswers>; 2],
}

impl Page<'_> {
    fn number(&self, measure: Measure, value: f64) -> String {
        self.units.number(measure, value, 0.0)
    }

    /// A power of a length, which has no measure of its own.
    fn power(&self, value: f64, power: i32) -> String {
        let length = self.units.convert(Measure::Length, 1.0);
        format!("{:.4}", value * length.powi(power))
    }

    fn vehicles(&self) -> String {
        let length = self.units.unit(Measure::Length);
        let mut rows = vec![
            self.row("width", length, |crush, _| self.number(Measure::Length, crush.profile.width())),
            self.row("depths", "", |crush, _| crush.profile.depths().len().to_string()),
            self.row("mean depth", length, |_, answers| self.number(Measure::Length, answers.mean_depth)),
            self.row("K1 = w/2", length, |_, answers| self.power(answers.moments.first, 1)),
            self.row("K2", &format!("{length}^2"), |_, answers| self.power(answers.moments.second, 2)),
            self.row("K3", &format!("{length}^3"), |_, answers| self.power(answers.moments.third, 3)),
        ];
        for Form { name, measure, value } in FORMS {
            rows.push(self.row(name, self.units.unit(measure), |crush, _| match crush.zones.zones() {
                [stiffness] => self.number(measure, value(stiffness)),
                _ => "zones".to_owned(),
            }));
        }
        if self.case.setup.crush.iter().flatten().any(|crush| crush.saturation.is_some()) {
            rows.push(self.row("force constant beyond", length, |crush, _| {
                crush.saturation.map_or("-".to_owned(), |depth| self.number(Measure::Length, depth))
            }));
        }
        let of = |what, measure, value: fn(&CrushAnswers) -> f64| {
            self.row(what, self.units.unit(measure), |_, answers| self.number(measure, value(answers)))
        };
        rows.push(of("crush energy E_C", Measure::Energy, |answers| answers.energy));
        rows.push(of("equivalent energy speed", Measure::Speed, |answers| answers.equivalent_speed));
        rows.push(of("", Measure::RoadSpeed, |answers| answers.equivalent_speed));
        let names = [0, 1].map(|i| shorten(&self.case.names[i], 18));
        table::render(&["crush", "unit", &names[0], &names[1]], &[Align::Left, Align::Left, Align::Right, Align::Right], &rows)
    }

    fn row(&self, what: &str, unit: &str, value: impl Fn(&Crush, &CrushAnswers) -> String) -> Vec<String> {
        let cell = |i: usize| match (&self.case.setup.crush[i], &self.answers[i]) {
            (Some(crush), Some(answers)) => value(crush, answers),
            _ => "-".to_owned(),
        };
        vec![what.to_owned(), unit.to_owned(), cell(0), cell(1)]
    }

    /// The zones of a vehicle that has several.
    fn zones(&self, i: usize) -> Option<String> {
        let crush = self.case.setup.crush[i].as_ref().filter(|crush| crush.zones.zones().len() > 1)?;
        let row = |(place, moments): (usize, planar_impact::crush::ProfileMoments)| {
            let zone = &crush.zones.zones()[place];
            let end = crush.zones.borders().get(place).map_or("the end".to_owned(), |border| self.units.quantity(Measure::Length, *border));
            let width = self.number(Measure::Length, moments.width());
            let (onset, slope) = (self.number(Measure::RootForce, zone.onset), self.number(Measure::RootForcePerLength, zone.slope));
            vec![format!("{} to {end}", place + 1), width, onset, slope, self.number(Measure::Energy, zone.crush_energy(moments))]
        };
        let rows: Vec<_> = crush.zones.moments(&crush.profile).enumerate().map(row).collect();
        let unit = |measure| self.units.unit(measure);
        let header = [
            format!("zone of {}", shorten(&self.case.names[i], 18)),
            format!("width {}", unit(Measure::Length)),
            format!("d0 {}", unit(Measure::RootForce)),
            format!("d1 {}", unit(Measure::RootForcePerLength)),
            format!("E_C {}", unit(Measure::Energy)),
        ];
        let columns = [Align::Left, Align::Right, Align::Right, Align::Right, Align::Right];
        Some(table::render(&header.each_ref().map(String::as_str), &columns, &rows))
    }
}

/// One of the numbers that the field gives a stiffness by.
struct Form {
    name: &'static str,
    measure: Measure,
    value: fn(&CrushStiffness) -> f64,
}

const FORMS: [Form; 5] = [
    Form { name: "stiffness d0", measure: Measure::RootForce, value: |line| line.onset },
    Form { name: "          d1", measure: Measure::RootForcePerLength, value: |line| line.slope },
    Form { name: "          A = d0 d1", measure: Measure::ForcePerWidth, value: |line| ForceLine::from(*line).onset },
    Form { name: "          B = d1^2", measure: Measure::ForcePerArea, value: |line| ForceLine::from(*line).slope },
    Form { name: "          G = d0^2/2", measure: Measure::Force, value: |line| line.energy_without_crush() },
];
