//! The stiffness from tests, as a person reads it.

use planar_impact::barrier::{Estimate, StiffnessFit};
use planar_impact::crush::{CrushStiffness, ForceLine, crush_intensity};

use super::document::{basis, model, said};
use super::given::TestFile;
use super::{Findings, Found, is_uncertain, predicted};
use crate::report::{heading, notes_below, shorten};
use crate::table::{self, Align, wrap};
use crate::units::{Measure, Units};

/// The report, in tables of at most 80 columns.
pub fn render(file: &TestFile, findings: &Findings, units: Units) -> String {
    let page = Page { file, findings, units };
    let mut text = heading(&file.title);
    text.push_str(&page.tests());
    for section in [page.alone(), page.fits()].into_iter().flatten() {
        text.push_str("\n\n");
        text.push_str(&section);
    }
    text.push_str("\n\n");
    text.push_str(&page.remarks());
    text
}

struct Page<'a> {
    file: &'a TestFile,
    findings: &'a Findings,
    units: Units,
}

impl Page<'_> {
    fn number(&self, measure: Measure, value: f64) -> String {
        self.units.number(measure, value, 0.0)
    }

    fn headed(&self, what: &str, measure: Measure) -> String {
        format!("{what} {}", self.units.unit(measure))
    }

    fn tests(&self) -> String {
        let row = |(i, found): (usize, &Found)| {
            let intensity = crush_intensity(found.crush_energy, found.test.width());
            vec![
                format!("{} {}", i + 1, shorten(&self.file.vehicles[found.vehicle].name, 12)),
                self.number(Measure::Speed, found.test.speed),
                self.number(Measure::Ratio, found.test.restitution),
                self.number(Measure::Length, found.test.crush.mean_depth()),
                self.number(Measure::Energy, found.crush_energy),
                self.number(Measure::Speed, found.equivalent_energy_speed),
                self.number(Measure::RootForce, intensity),
            ]
        };
        let rows: Vec<_> = self.findings.tests.iter().enumerate().map(row).collect();
        let header = [
            "test".to_owned(),
            self.headed("v_n", Measure::Speed),
            "e".to_owned(),
            self.headed("C", Measure::Length),
            self.headed("E_C", Measure::Energy),
            self.headed("EES", Measure::Speed),
            self.headed("E*", Measure::RootForce),
        ];
        let mut columns = [Align::Right; 7];
        columns[0] = Align::Left;
        table::render(&header.each_ref().map(String::as_str), &columns, &rows)
    }

    /// From each first test of a vehicle and the assumed onset.
    fn alone(&self) -> Option<String> {
        let mut rows = Vec::new();
        for (i, found) in self.findings.tests.iter().enumerate() {
            let Some(alone) = &found.alone else { continue };
            rows.push(self.forms(&format!("{}: mean depth", i + 1), &alone.line.into()));
            rows.push(self.forms(&format!("{}: profile", i + 1), &alone.exact));
        }
        (!rows.is_empty()).then(|| self.table_of_forms("from one test", &rows))
    }

    fn forms(&self, what: &str, stiffness: &CrushStiffness) -> Vec<String> {
        let force = ForceLine::from(*stiffness);
        vec![
            what.to_owned(),
            self.number(Measure::RootForce, stiffness.onset),
            self.number(Measure::RootForcePerLength, stiffness.slope),
            self.number(Measure::ForcePerWidth, force.onset),
            self.number(Measure::ForcePerArea, force.slope),
            self.number(Measure::Force, stiffness.energy_without_crush()),
        ]
    }

    fn table_of_forms(&self, what: &str, rows: &[Vec<String>]) -> String {
        let header = [
            what.to_owned(),
            self.headed("d0", Measure::RootForce),
            self.headed("d1", Measure::RootForcePerLength),
            self.headed("A", Measure::ForcePerWidth),
            self.headed("B", Measure::ForcePerArea),
            self.headed("G", Measure::Force),
        ];
        let mut columns = [Align::Right; 6];
        columns[0] = Align::Left;
        table::narrow(&header.each_ref().map(String::as_str), &columns, rows)
    }

    fn fits(&self) -> Option<String> {
        let fits = &self.findings.fits;
        let first = fits.first()?;
        let forms = fits.iter().map(|fit| self.forms(model(fit.model), &fit.stiffness)).collect::<Vec<_>>();
        let mut text = self.table_of_forms("fitted on", &forms);
        text.push_str("\n\n");
        let cell = |fit: &StiffnessFit, measure, estimate: &Estimate| {
            let value = self.number(measure, estimate.value);
            if is_uncertain(self.file, fit) { format!("{value} ± {}", self.number(measure, estimate.deviation())) } else { value }
        };
        let row = |what: String, value: &dyn Fn(&StiffnessFit) -> String| {
            let mut cells = vec![what];
            cells.extend(fits.iter().map(value));
            cells
        };
        let root = |text: &str| format!("{text}, {}", self.units.unit(Measure::RootForce));
        let mut rows = vec![
            row(root("d0"), &|fit| cell(fit, Measure::RootForce, &fit.onset())),
            row(format!("d1, {}", self.units.unit(Measure::RootForcePerLength)), &|fit| {
                cell(fit, Measure::RootForcePerLength, &fit.slope())
            }),
        ];
        if is_uncertain(self.file, first) {
            rows.push(row("correlation of d0 and d1".to_owned(), &|fit| {
                self.units.number(Measure::Ratio, fit.covariance.correlation(), 0.0)
            }));
        }
        if let Some(asked) = &self.file.prediction {
            let (depth, width) = (self.units.quantity(Measure::Length, asked.depth), self.units.quantity(Measure::Length, asked.width));
            let what = format!("E_C at {depth} over {width}, {}", self.units.unit(Measure::Energy));
            rows.push(row(what, &|fit| cell(fit, Measure::Energy, &predicted(fit, asked))));
        }
        for i in 0..first.residuals.len() {
            rows.push(row(root(&format!("E* of test {}, less fitted", i + 1)), &|fit| {
                let residual = &fit.residuals[i];
                let difference = self.units.number(Measure::RootForce, residual.difference(), residual.observed);
                if self.file.has_deviations { format!("{difference} ({:+.1} sd)", residual.standardized()) } else { difference }
            }));
        }
        if self.file.has_deviations {
            rows.push(row(format!("chi square, {} degrees of freedom", first.degrees_of_freedom), &|fit| format!("{:.2}", fit.chi_square)));
        }
        let models = fits.iter().map(|fit| model(fit.model)).collect::<Vec<_>>();
        text.push_str(&table::render(&[&["fit"], &models[..]].concat(), &[Align::Left, Align::Right, Align::Right], &rows));
        Some(text)
    }

    fn remarks(&self) -> String {
        let mut text = String::new();
        if let Some(fit) = self.findings.fits.first() {
            let uncertainty = if is_uncertain(self.file, fit) {
                format!("; ± is one standard deviation, by the {}", basis(fit.basis))
            } else {
                "; two tests without standard deviations say nothing of their scatter".to_owned()
            };
            text.push_str(&wrap(&format!("Weighted least squares of E* = sqrt(2 E_C/w) against the crush{uncertainty}."), ""));
        }
        for fit in &self.findings.fits {
            for finding in fit.findings() {
                text.push_str(&wrap(&format!("fitted on {}: {}.", model(fit.model), said(&finding, self.units)), "Note: "));
            }
        }
        text.push_str(&notes_below(&self.findings.notes));
        text
    }
}
