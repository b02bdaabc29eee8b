//! CRASH3 beside planar mechanics, as a person reads it.

use planar_impact::crash3::{Assumption, Assumptions, Consequence, Damaged, VehicleEstimate, approach_velocity};
use planar_impact::{Vehicle, Xy};

use super::document::name_of;
use super::{Comparison, Damage};
use crate::case::Case;
use crate::report::{heading, notes_below, shorten};
use crate::table::{self, Align, wrap};
use crate::units::{Measure, Units};

/// The report, in tables of at most 80 columns.
pub fn render(case: &Case, result: &Comparison, units: Units) -> String {
    let mut text = heading(&case.title);
    text.push_str(&body(case, result, units));
    text.push_str(&notes_below(&result.notes));
    text
}

/// What it says, without title and notes.
pub fn body(case: &Case, result: &Comparison, units: Units) -> String {
    let page = Page { case, units };
    let mut text = String::new();
    if let Some(damage) = &result.damage {
        text.push_str(&page.vehicles(damage));
        text.push_str("\n\n");
    }
    if let Some(assumptions) = &result.assumptions {
        text.push_str(&page.assumptions(assumptions));
        text.push_str("\n\n");
        for assumption in Assumption::ALL {
            text.push_str(&wrap(&format!("{}.", assumption.statement()), "- "));
        }
        text.push_str(&wrap(
            "All from the same crush energy and the same direction of approach: each assumption alone, on planar mechanics; all three are CRASH3, \
             alpha taken from the normal of the crush plane and its correction without a limit.",
            "",
        ));
    }
    text
}

struct Page<'a> {
    case: &'a Case,
    units: Units,
}

impl Page<'_> {
    fn number(&self, measure: Measure, value: f64) -> String {
        self.units.number(measure, value, 1e-6)
    }

    fn vehicles(&self, damage: &Damage) -> String {
        let estimate = &damage.estimate;
        let pair = [(&damage.pair.one, &estimate.one), (&damage.pair.two, &estimate.two)];
        let row = |what: &str, unit: &str, value: &dyn Fn(&Damaged, &VehicleEstimate) -> String| {
            let cell = |(damaged, estimate): (&Option<Damaged>, &Option<VehicleEstimate>)| match (damaged, estimate) {
                (Some(damaged), Some(estimate)) => value(damaged, estimate),
                _ => "fixed".to_owned(),
            };
            vec![what.to_owned(), unit.to_owned(), cell(pair[0]), cell(pair[1])]
        };
        let of = |what: &str, measure: Measure, value: fn(&Damaged, &VehicleEstimate) -> f64| {
            row(what, self.units.unit(measure), &|damaged, estimate| self.number(measure, value(damaged, estimate)))
        };
        let mut rows = vec![
            row("crushed surface", "", &|damaged, _| name_of(damaged.surface).to_owned()),
            of("crush energy", Measure::Energy, |damaged, _| damaged.crush_energy),
            of("PDOF, clockwise from ahead", Measure::Angle, |damaged, _| damaged.force_origin.direction()),
            of("correction 1 + tan^2 alpha", Measure::Ratio, |_, estimate| estimate.correction),
            of("corrected energy", Measure::Energy, |_, estimate| estimate.corrected_energy),
            of("moment arm of the force", Measure::Length, |_, estimate| estimate.moment_arm),
            of("effective mass factor", Measure::Ratio, |_, estimate| estimate.effective_mass_factor),
            of("delta-V", Measure::Speed, |_, estimate| estimate.delta_v_magnitude),
            of("", Measure::RoadSpeed, |_, estimate| estimate.delta_v_magnitude),
        ];
        rows.extend(self.reconstruction(damage));
        let names = [0, 1].map(|i| shorten(&self.case.names[i], 18));
        table::render(&["CRASH3", "unit", &names[0], &names[1]], &[Align::Left, Align::Left, Align::Right, Align::Right], &rows)
    }

    /// Back from the separation velocities.
    fn reconstruction(&self, damage: &Damage) -> Vec<Vec<String>> {
        let Damage { separation, estimate, .. } = damage;
        let sides = [
            (self.case.collision.one.vehicle(), &estimate.one, separation[0]),
            (self.case.collision.two.vehicle(), &estimate.two, separation[1]),
        ];
        if sides.iter().all(|(vehicle, _, separation)| vehicle.is_none() || separation.is_none()) {
            return Vec::new();
        }
        let row = |what: &str, value: &dyn Fn(&Vehicle, &VehicleEstimate, Xy) -> f64| {
            let cell = |(vehicle, estimate, separation): (Option<&Vehicle>, &Option<VehicleEstimate>, Option<Xy>)| {
                let Some((vehicle, estimate)) = vehicle.zip(estimate.as_ref()) else { return "fixed".to_owned() };
                separation.map_or("-".to_owned(), |separation| self.number(Measure::Speed, value(vehicle, estimate, separation)))
            };
            let unit = self.units.unit(Measure::Speed).to_owned();
            vec![what.to_owned(), unit, cell(sides[0]), cell(sides[1])]
        };
        let back = |vehicle: &Vehicle, estimate: &VehicleEstimate, separation| approach_velocity(estimate, &vehicle.heading, separation);
        vec![
            row("separation velocity x", &|_, _, separation| separation.x),
            row("                    y", &|_, _, separation| separation.y),
            row("approach by CRASH3  x", &|vehicle, estimate, separation| back(vehicle, estimate, separation).x),
            row("                    y", &|vehicle, estimate, separation| back(vehicle, estimate, separation).y),
            row("approach of the case x", &|vehicle, _, _| vehicle.motion.velocity.x),
            row("                     y", &|vehicle, _, _| vehicle.motion.velocity.y),
        ]
    }

    fn assumptions(&self, assumptions: &Assumptions) -> String {
        let row = |what: &str, with: &Consequence| {
            let share = |value: f64, of: f64| if of == 0.0 { String::new() } else { format!("{:+.1} %", 100.0 * (value / of - 1.0)) };
            let fixed = |i: usize| [&self.case.collision.one, &self.case.collision.two][i].vehicle().is_none();
            let planar = [assumptions.planar.delta_v_1, assumptions.planar.delta_v_2];
            let mut cells = vec![what.to_owned(), self.number(Measure::Energy, with.loss), share(with.loss, assumptions.planar.loss)];
            let delta_v = [with.delta_v_1, with.delta_v_2];
            for i in [0, 1] {
                cells.push(if fixed(i) { "fixed".to_owned() } else { self.number(Measure::Speed, delta_v[i]) });
            }
            let moves = if fixed(0) { 1 } else { 0 };
            cells.push(share(delta_v[moves], planar[moves]));
            cells
        };
        let mut rows = vec![row("planar mechanics", &assumptions.planar)];
        for (assumption, words) in Assumption::ALL.into_iter().zip(["common velocity alone", "point mass alone", "tangential factor alone"])
        {
            rows.push(row(words, assumptions.with(assumption)));
        }
        rows.push(row("all three: CRASH3", &assumptions.together));
        let loss = format!("T_L {}", self.units.unit(Measure::Energy));
        let delta_v = [1, 2].map(|i| format!("dV{i} {}", self.units.unit(Measure::Speed)));
        let header = ["from the crush energy", &loss, "", &delta_v[0], &delta_v[1], ""];
        let columns = [Align::Left, Align::Right, Align::Right, Align::Right, Align::Right, Align::Right];
        table::render(&header, &columns, &rows)
    }
}
