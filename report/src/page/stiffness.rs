//! The page of `stiffness`.

use planar_impact_app::plain_text::shorten;
use planar_impact_app::stiffness::{Fit, Forms, StiffnessAnswer, Test};
use planar_impact_app::units::{Measure, Units};
use planar_impact_app::wording::degrees_of_freedom;

use super::{Facts, SUMMARY_WIDTH};
use crate::block::{Block, Table};

impl Facts for StiffnessAnswer {
    /// Why a fit is no stiffness, or the stiffness of each fit.
    fn summary(&self, units: Units) -> Vec<Block> {
        if !self.headlines.is_empty() {
            return self.headlines.iter().map(|headline| Block::item("! ", format!("{}.", units.sentence(&headline.0)))).collect();
        }
        let of = |what: String, forms: &Forms| {
            let force = units.quantity(Measure::ForcePerWidth, forms.force);
            let per_depth = units.quantity(Measure::ForcePerArea, forms.force_per_depth);
            Block::paragraph(format!("{what}: A = {force}, B = {per_depth}."))
        };
        let fits = self.fits.iter().map(|fit| of(format!("Fitted on the {}", fit.model), &fit.forms));
        let alone = self.tests.iter().filter(|_| self.fits.is_empty()).filter_map(|test| {
            Some(of(format!("{}, from one test on its profile", shorten(&test.vehicle, SUMMARY_WIDTH)), test.on_profile.as_ref()?))
        });
        fits.chain(alone).collect()
    }

    /// The tests, the stiffness from each alone and from all, with its uncertainty.
    fn blocks(&self, units: Units) -> Vec<Block> {
        let page = Page { answer: self, units };
        let mut blocks: Vec<Block> = vec![page.tests().into()];
        blocks.extend(page.alone().map(Block::from));
        blocks.extend(page.fits(&self.fits, "fitted on"));
        blocks.extend(page.fits(&self.fits_as_new_cars, "as new cars, on"));
        blocks.extend(page.pooled());
        blocks
    }
}

struct Page<'a> {
    answer: &'a StiffnessAnswer,
    units: Units,
}

impl Page<'_> {
    fn number(&self, measure: Measure, value: f64) -> String {
        self.units.number(measure, value, 0.0)
    }

    fn head(&self, what: &str, measure: Measure) -> String {
        format!("{what} {}", self.units.unit(measure))
    }

    fn tests(&self) -> Table {
        let row = |(i, test): (usize, &Test)| {
            vec![
                format!("{} {}", i + 1, shorten(&test.vehicle, 12)),
                self.number(Measure::Speed, test.speed),
                self.number(Measure::Ratio, test.restitution),
                self.number(Measure::Length, test.mean_depth),
                self.number(Measure::Energy, test.crush_energy),
                self.number(Measure::Speed, test.equivalent_energy_speed),
                self.number(Measure::RootForce, test.crush_intensity),
            ]
        };
        let header = [
            "test".to_owned(),
            self.head("v_n", Measure::Speed),
            "e".to_owned(),
            self.head("C", Measure::Length),
            self.head("E_C", Measure::Energy),
            self.head("EES", Measure::Speed),
            self.head("E*", Measure::RootForce),
        ];
        Table::new(header, "lrrrrrr", self.answer.tests.iter().enumerate().map(row).collect())
    }

    /// Renders the stiffness from the first test of each vehicle and the assumed onset.
    fn alone(&self) -> Option<Table> {
        let mut rows = Vec::new();
        for (i, test) in self.answer.tests.iter().enumerate() {
            let forms = [("mean depth", &test.on_mean_depth), ("profile", &test.on_profile)];
            rows.extend(forms.iter().filter_map(|(on, forms)| Some(self.forms(&format!("{}: {on}", i + 1), forms.as_ref()?))));
        }
        (!rows.is_empty()).then(|| self.table_of_forms("from one test", rows))
    }

    fn forms(&self, what: &str, forms: &Forms) -> Vec<String> {
        vec![
            what.to_owned(),
            self.number(Measure::RootForce, forms.d0),
            self.number(Measure::RootForcePerLength, forms.d1),
            self.number(Measure::ForcePerWidth, forms.force),
            self.number(Measure::ForcePerArea, forms.force_per_depth),
            self.number(Measure::Force, forms.without_crush),
        ]
    }

    fn table_of_forms(&self, what: &str, rows: Vec<Vec<String>>) -> Table {
        let header = [
            what.to_owned(),
            self.head("d0", Measure::RootForce),
            self.head("d1", Measure::RootForcePerLength),
            self.head("A", Measure::ForcePerWidth),
            self.head("B", Measure::ForcePerArea),
            self.head("G", Measure::Force),
        ];
        Table::new(header, "lrrrrr", rows).narrow()
    }

    fn fits(&self, fits: &[Fit], what: &str) -> Vec<Block> {
        let Some(first) = fits.first() else { return Vec::new() };
        let forms = fits.iter().map(|fit| self.forms(fit.model, &fit.forms)).collect();
        let header = std::iter::once("fit").chain(fits.iter().map(|fit| fit.model));
        let uncertainty = match &first.covariance {
            Some(covariance) => format!("; ± is one standard deviation, by the {}", covariance.basis),
            None => "; as many tests as coefficients, without standard deviations, do not give their scatter".to_owned(),
        };
        let mut blocks = vec![
            self.table_of_forms(what, forms).into(),
            Table::new(header, "lrr", self.estimates(fits, first)).into(),
            Block::paragraph(format!("Weighted least squares of E* = sqrt(2 E_C/w) against the crush{uncertainty}.")),
        ];
        for fit in fits {
            let item = |text: String| Block::item("! ", format!("{what} {}: {text}.", fit.model));
            blocks.extend(fit.findings.iter().map(|finding| item(self.units.sentence(&finding.0))));
        }
        blocks
    }

    /// Renders the stiffness of the class, and of each vehicle in it.
    fn pooled(&self) -> Vec<Block> {
        let (onset, slope) = (Measure::RootForce, Measure::RootForcePerLength);
        let with_sd = |measure, value, sd| match sd {
            0.0 => self.number(measure, value),
            sd => format!("{} ± {}", self.number(measure, value), self.number(measure, sd)),
        };
        let mut blocks: Vec<Block> = Vec::new();
        for pooled in &self.answer.pooled {
            let mut rows: Vec<Vec<String>> = pooled
                .vehicles
                .iter()
                .map(|of| vec![shorten(&of.name, 20), with_sd(onset, of.d0, of.d0_sd), with_sd(slope, of.d1, of.d1_sd)])
                .collect();
            let (d0, d1) = (&pooled.d0, &pooled.d1);
            rows.push(vec!["mean of the class".to_owned(), with_sd(onset, d0.mean, d0.mean_sd), with_sd(slope, d1.mean, d1.mean_sd)]);
            rows.push(vec!["sd between vehicles".to_owned(), self.number(onset, d0.between_sd), self.number(slope, d1.between_sd)]);
            rows.push(vec!["sd of a further one".to_owned(), self.number(onset, d0.further_sd), self.number(slope, d1.further_sd)]);
            let header = [format!("class, on {}", pooled.model), self.head("d0", onset), self.head("d1", slope)];
            blocks.push(Table::new(header, "lrr", rows).into());
        }
        if !blocks.is_empty() {
            let text = "Random effects by Paule and Mandel (1982): d0 and d1 of each vehicle are drawn from a class and known with their own error. Without \
                        an error of each, the spread between vehicles includes the scatter of their tests. The mean of a class, and a further vehicle of it, lie \
                        within 1.96 of their standard deviations in 95 % of classes or more, however few were tested.";
            blocks.push(Block::paragraph(text));
        }
        blocks
    }

    fn estimates(&self, fits: &[Fit], first: &Fit) -> Vec<Vec<String>> {
        let row =
            |what: String, value: &dyn Fn(&Fit) -> String| -> Vec<String> { std::iter::once(what).chain(fits.iter().map(value)).collect() };
        let with_sd = |measure, value, sd: Option<f64>| {
            let value = self.number(measure, value);
            sd.map_or(value.clone(), |sd| format!("{value} ± {}", self.number(measure, sd)))
        };
        let named = |what: &str, measure| format!("{what}, {}", self.units.unit(measure));
        let mut rows = vec![
            row(named("d0", Measure::RootForce), &|fit| {
                with_sd(Measure::RootForce, fit.forms.d0, fit.covariance.as_ref().map(|covariance| covariance.d0_sd))
            }),
            row(named("d1", Measure::RootForcePerLength), &|fit| {
                with_sd(Measure::RootForcePerLength, fit.forms.d1, fit.covariance.as_ref().map(|covariance| covariance.d1_sd))
            }),
        ];
        if first.covariance.is_some() {
            rows.push(row("correlation of d0 and d1".to_owned(), &|fit| {
                fit.covariance.as_ref().map(|covariance| self.number(Measure::Ratio, covariance.correlation)).unwrap_or_default()
            }));
        }
        if let Some(prediction) = &first.prediction {
            let quantity = |value| self.units.quantity(Measure::Length, value);
            let what = format!("E_C at {} over {}", quantity(prediction.depth), quantity(prediction.width));
            rows.push(row(named(&what, Measure::Energy), &|fit| {
                fit.prediction.as_ref().map(|energy| with_sd(Measure::Energy, energy.crush_energy, energy.sd)).unwrap_or_default()
            }));
        }
        for i in 0..first.residuals.len() {
            rows.push(row(named(&format!("E* of test {}, less fitted", i + 1), Measure::RootForce), &|fit| {
                let residual = &fit.residuals[i];
                let difference = self.units.number(Measure::RootForce, residual.difference, residual.observed);
                residual.standardised.map_or(difference.clone(), |off| format!("{difference} ({off:+.1} sd)"))
            }));
        }
        if self.answer.has_deviations {
            let what = format!("chi square, {}", degrees_of_freedom(first.degrees_of_freedom));
            rows.push(row(what, &|fit| format!("{:.2}", fit.chi_square)));
        }
        rows
    }
}
