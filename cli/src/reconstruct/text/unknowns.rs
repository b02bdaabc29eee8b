//! What was found of the unknowns.

use planar_impact::reconstruct::{Bound, Estimate, Solution, Variable};
use planar_impact::{ImpulseRatio, Input};

use super::headline::{digits, probability};
use super::{Page, fitted};
use crate::reconstruct::question::measure_in;
use crate::reconstruct::wording::rounded;
use crate::table::{Align, wrap};
use crate::units::Measure;

/// The standard deviations on either side that hold 95 % of a normal distribution.
const NORMAL_95: f64 = 1.959_963_984_540_054;

impl Page<'_> {
    fn measure(&self, of: Variable) -> Measure {
        measure_in(of, &self.result.solved)
    }

    pub(super) fn unknowns(&self) -> String {
        let best = self.result.answer.best();
        let rows: Vec<Vec<String>> = best.unknowns.iter().flat_map(|estimate| self.rows(estimate)).collect();
        let header = ["unknown", "value", "+/- sd", "95 % from", "to", "unit"];
        let columns = [Align::Left, Align::Right, Align::Right, Align::Right, Align::Right, Align::Left];
        let mut text = fitted(&header, &columns, &rows);
        for estimate in &best.unknowns {
            if let Some(bound) = estimate.at {
                text.push_str(&wrap(&self.at(estimate, bound), "* "));
            }
        }
        for of in best.hardly_determined(&self.result.question.asked) {
            let said = "the evidence says as good as nothing of it, its standard deviation is larger than all that it may be.";
            text.push_str(&wrap(&format!("{}: {said}", of.name()), "! "));
        }
        let seeks_ratio = best.unknowns.iter().any(|estimate| estimate.of == Variable::Input(Input::ImpulseRatio));
        if seeks_ratio && matches!(self.result.solved.collision.impulse_ratio, ImpulseRatio::OfCritical(_)) {
            text.push_str(&wrap("contact.impulse_ratio is here the fraction of the critical ratio, as the case gives it.", ""));
        }
        if !self.has_spread() && self.result.has_solution() {
            text.push_str(&wrap("No piece of evidence has an uncertainty, so nothing can be said of that of the unknowns.", ""));
        }
        text
    }

    /// An unknown; a speed also as a driver reads it.
    fn rows(&self, estimate: &Estimate) -> Vec<Vec<String>> {
        let measure = self.measure(estimate.of);
        let row = self.row(estimate, estimate.of.name(), measure);
        if measure == Measure::Speed { vec![row, self.row(estimate, "", Measure::RoadSpeed)] } else { vec![row] }
    }

    fn row(&self, estimate: &Estimate, name: &str, measure: Measure) -> Vec<String> {
        let unit = self.units.unit(measure).to_owned();
        if !estimate.is_determined {
            return vec![name.to_owned(), "open".to_owned(), "-".to_owned(), "-".to_owned(), "-".to_owned(), unit];
        }
        let interval = estimate.sd.map(|sd| self.interval(estimate, sd));
        // Between bounds that are closer than the deviation, digits that tell these apart.
        let step =
            estimate.sd.map(|sd| interval.map(|[from, to]| to - from).filter(|width| *width > 0.0).map_or(sd, |width| width.min(sd)));
        let say = |value| rounded(measure, value, step, self.units);
        let mark = if estimate.at.is_some() && !name.is_empty() { " *" } else { "" };
        let mut cells = vec![format!("{name}{mark}"), say(estimate.value)];
        match estimate.sd.zip(interval) {
            Some((sd, [from, to])) => cells.extend([say(sd), say(from), say(to)]),
            None => cells.extend(["-"; 3].map(str::to_owned)),
        }
        cells.push(unit);
        cells
    }

    /// 95 % of what is likely, as far as the bounds reach.
    fn interval(&self, estimate: &Estimate, sd: f64) -> [f64; 2] {
        let unknown = self.result.unknown(estimate.of);
        let (min, max) = unknown.map_or((None, None), |unknown| (unknown.min, unknown.max));
        let (from, to) = (estimate.value - NORMAL_95 * sd, estimate.value + NORMAL_95 * sd);
        [from.max(min.unwrap_or(f64::NEG_INFINITY)), to.min(max.unwrap_or(f64::INFINITY))]
    }

    /// What it means that an unknown sits on a bound, by the paper's guideline where it has one.
    fn at(&self, estimate: &Estimate, bound: Bound) -> String {
        let end = if bound == Bound::Min { "lower" } else { "upper" };
        let meaning = match (estimate.of, bound) {
            (Variable::Input(Input::Restitution), Bound::Max) => "without a reason for so high a value, re-examine the geometry.",
            (Variable::Input(Input::Restitution), Bound::Min) if estimate.value == 0.0 => {
                "a common velocity along the normal, as in most severe crashes."
            }
            _ if estimate.sd.is_some() => "the evidence is content with it there.",
            _ if self.has_spread() => "it would go further. Held there it has no standard deviation, and the others' take it as known.",
            // Without a standard deviation anywhere nothing tells the one from the other.
            _ => "is there a reason for that bound?",
        };
        format!("{} sits on its {end} bound: {meaning}", estimate.of.name())
    }

    /// Whether anything is known of the unknowns' uncertainty.
    fn has_spread(&self) -> bool {
        let best = self.result.answer.best();
        best.evidence.iter().chain(&best.priors).any(|fitted| fitted.sd.is_some_and(|sd| sd > 0.0))
    }

    /// All solutions side by side, where there are several, and what the bounds exclude.
    pub(super) fn alternatives(&self) -> String {
        let solutions = &self.result.answer.solutions;
        if solutions.len() < 2 {
            return String::new();
        }
        /// As many as fit side by side.
        const SHOWN: usize = 4;
        let shown: Vec<&Solution> = solutions.iter().take(SHOWN).collect();
        let mut rows: Vec<Vec<String>> = Vec::new();
        for (i, estimate) in shown[0].unknowns.iter().enumerate() {
            let measure = self.measure(estimate.of);
            let mut row = vec![estimate.of.name().to_owned()];
            row.extend(shown.iter().map(|solution| rounded(measure, solution.unknowns[i].value, solution.unknowns[i].sd, self.units)));
            row.push(self.units.unit(measure).to_owned());
            rows.push(row);
        }
        let mut of_all = |what: &str, value: &dyn Fn(&Solution) -> String| {
            let mut row = vec![what.to_owned()];
            row.extend(shown.iter().map(|solution| value(solution)));
            row.push(String::new());
            rows.push(row);
        };
        of_all("chi-square", &|solution| digits(solution.chi_square));
        of_all("probability", &|solution| probability(solution.probability));
        let numbers: Vec<String> = (1..=shown.len()).map(|i| i.to_string()).collect();
        let mut header = vec!["solution"];
        header.extend(numbers.iter().map(String::as_str));
        header.push("unit");
        let mut columns = vec![Align::Left];
        columns.extend(shown.iter().map(|_| Align::Right));
        columns.push(Align::Left);
        let mut text = fitted(&header, &columns, &rows);
        if solutions.len() > SHOWN {
            text.push_str(&wrap(&format!("{} more: --format json.", solutions.len() - SHOWN), ""));
        }
        text
    }
}
