//! The evidence beside what the solution makes of it, and what each piece is worth.

use planar_impact::reconstruct::{Fitted, Measurable, Variable};

use super::{Page, fitted};
use crate::case::measure_of;
use crate::reconstruct::question::measure_in;
use crate::reconstruct::wording::{rounded, without_sign_of_zero};
use crate::table::{Align, wrap};
use crate::units::Measure;

/// From which size on a correlation is told.
const STRONG: f64 = 0.5;

/// How many pieces of evidence are told of each unknown.
const SHOWN: usize = 4;

impl Page<'_> {
    fn measure_of(&self, of: Measurable) -> Measure {
        match of {
            Measurable::Variable(variable) => measure_in(variable, &self.result.solved),
            _ => measure_of(of),
        }
    }

    pub(super) fn evidence(&self) -> String {
        let best = self.result.answer.best();
        let row = |name: String, fitted: &Fitted| {
            let measure = self.measure_of(fitted.of);
            let say = |value| rounded(measure, value, fitted.sd, self.units);
            let sd = fitted.sd.map_or_else(|| "exact".to_owned(), say);
            let off = fitted.standardised_residual().map_or_else(|| "-".to_owned(), |off| without_sign_of_zero(format!("{off:.2}")));
            vec![name, say(fitted.given), say(fitted.computed), sd, off, self.units.unit(measure).to_owned()]
        };
        let mut rows: Vec<Vec<String>> = best.evidence.iter().map(|fitted| row(fitted.of.name().to_owned(), fitted)).collect();
        rows.extend(best.priors.iter().map(|fitted| row(format!("{} (prior)", fitted.of.name()), fitted)));
        for evidence in &self.result.question.certain {
            let measure = self.measure_of(evidence.of);
            let value = rounded(measure, evidence.value, None, self.units);
            let unit = self.units.unit(measure).to_owned();
            rows.push(vec![evidence.of.name().to_owned(), value.clone(), value, "exact".to_owned(), "-".to_owned(), unit]);
        }
        let header = ["evidence", "given", "computed", "sd", "off by", "unit"];
        let columns = [Align::Left, Align::Right, Align::Right, Align::Right, Align::Right, Align::Left];
        fitted(&header, &columns, &rows) + &wrap("Off by: given less computed, in standard deviations.", "")
    }

    /// Which unknowns are uncertain together.
    pub(super) fn correlations(&self) -> String {
        let best = self.result.answer.best();
        let mut pairs = Vec::new();
        for i in 0..best.unknowns.len() {
            for k in 0..i {
                let both = best.unknowns[i].sd.and(best.unknowns[k].sd);
                let correlation = both.and_then(|_| best.covariance.correlation(k, i)).filter(|r| r.abs() > STRONG);
                pairs.extend(correlation.map(|r| format!("{} with {} {r:+.2}", best.unknowns[k].of.name(), best.unknowns[i].of.name())));
            }
        }
        if pairs.is_empty() { String::new() } else { wrap(&format!("Correlated: {}.", pairs.join("; ")), "") }
    }

    /// What each unknown hangs on.
    pub(super) fn influence(&self) -> String {
        let best = self.result.answer.best();
        let pieces: Vec<(String, &Fitted)> = best
            .evidence
            .iter()
            .map(|fitted| (fitted.of.name().to_owned(), fitted))
            .chain(best.priors.iter().map(|fitted| (format!("{} (prior)", fitted.of.name()), fitted)))
            .collect();
        let mut rows = Vec::new();
        for (estimate, influence) in best.unknowns.iter().zip(&best.influence).filter(|(estimate, _)| estimate.sd.is_some()) {
            let moves = |((name, fitted), by): (&(String, &Fitted), &f64)| {
                Some((name.clone(), self.measure_of(fitted.of), fitted.sd?, by * fitted.sd?))
            };
            let mut moves: Vec<_> = pieces.iter().zip(influence).filter_map(moves).collect();
            moves.sort_by(|one, other| other.3.abs().total_cmp(&one.3.abs()));
            let greatest = moves.first().map_or(0.0, |first| first.3.abs());
            let told = moves.into_iter().take(SHOWN).filter(|moved| moved.3.abs() > 1e-3 * greatest);
            for (i, (name, measure, sd, by)) in told.enumerate() {
                let unknown = if i == 0 { estimate.of.name() } else { "" };
                rows.push(self.moved(unknown, estimate.of, by, &name, measure, sd));
            }
        }
        if rows.is_empty() {
            return String::new();
        }
        let header = ["unknown", "moves by", "when this is larger", "by its sd of"];
        let columns = [Align::Left, Align::Left, Align::Left, Align::Left];
        fitted(&header, &columns, &rows)
    }

    fn moved(&self, unknown: &str, of: Variable, by: f64, piece: &str, measure: Measure, sd: f64) -> Vec<String> {
        let quantity =
            |measure, value: f64| format!("{} {}", rounded(measure, value, Some(value.abs()), self.units), self.units.unit(measure));
        let by = quantity(measure_in(of, &self.result.solved), by);
        let sign = if by.starts_with('-') { "" } else { "+" };
        vec![unknown.to_owned(), format!("{sign}{}", by.trim_end()), piece.to_owned(), quantity(measure, sd).trim_end().to_owned()]
    }
}
