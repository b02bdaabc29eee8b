//! What the answer is worth, and what to do next: the first thing that is read.

use planar_impact::reconstruct::{Bound, Fitted, Variable, Verdict};

use super::Page;
use crate::case::measure_of;
use crate::reconstruct::question::measure_in;
use crate::reconstruct::wording::{direction, rounded, with_spread};
use crate::table::wrap;

impl Page<'_> {
    pub(super) fn headline(&self) -> String {
        match self.verdict() {
            Verdict::Agrees => self.agrees(),
            Verdict::SeveralSolutions => self.several(),
            Verdict::Undetermined => self.undetermined(),
            Verdict::Contradicted => self.contradicted(),
            Verdict::BoundsExclude => self.bounds_exclude(),
            other => wrap(&format!("{}: {}.", other.name().to_uppercase(), self.chi_square()), ""),
        }
    }

    /// χ², its degrees of freedom and its probability.
    fn chi_square(&self) -> String {
        let best = self.result.answer.best();
        let count = best.degrees_of_freedom;
        let degrees = if count == 1 { "1 degree of freedom".to_owned() } else { format!("{count} degrees of freedom") };
        if count == 0 && best.chi_square < 1e-9 {
            return format!("chi-square 0 with {degrees}");
        }
        format!("chi-square {} with {degrees}, probability {}", digits(best.chi_square), probability(best.probability))
    }

    fn furthest(&self) -> String {
        match self.result.furthest() {
            Some((fitted, residual)) if residual.abs() > 1e-3 => {
                wrap(&format!("Furthest off is {}, by {:.1} standard deviations.", fitted.of.name(), residual.abs()), "")
            }
            _ => String::new(),
        }
    }

    fn agrees(&self) -> String {
        let vague: Vec<&str> =
            self.result.answer.best().hardly_determined(&self.result.question.asked).into_iter().map(Variable::name).collect();
        let but = if vague.is_empty() { String::new() } else { format!(", BUT SAYS NEXT TO NOTHING OF {}", vague.join(", ")) };
        let mut text = wrap(&format!("THE EVIDENCE AGREES WITH ONE SOLUTION{but}: {}.", self.chi_square()), "");
        if self.result.answer.best().degrees_of_freedom == 0 {
            text.push_str(&wrap("It is just enough evidence: no piece checks another. One more would.", ""));
        } else {
            text.push_str(&self.furthest());
        }
        text
    }

    fn several(&self) -> String {
        if self.result.answer.verdict == Verdict::Agrees {
            return self.one_of_several_rests();
        }
        let count = self.result.answer.solutions.len();
        let mut text =
            wrap(&format!("THE EVIDENCE AGREES WITH {count} SOLUTIONS, and cannot tell them apart; none of them alone is the answer."), "");
        text.push_str(&wrap(
            "What to do: find evidence in which they differ, or a reason for a bound that leaves one. All stand below; what follows them is of the first, \
             which has the least chi-square.",
            "",
        ));
        text
    }

    /// Of several separations that lead to the same rest only one was taken.
    fn one_of_several_rests(&self) -> String {
        let mut text = wrap(
            &format!(
                "SEVERAL SEPARATIONS LEAD TO THE SAME REST: what follows is of one of them, and not the answer alone. {}.",
                self.chi_square()
            ),
            "",
        );
        text.push_str(&wrap(
            "What to do: look which way the tire marks turn, and give the separation velocity or yaw rate as evidence in place of that vehicle's rest.",
            "",
        ));
        text
    }

    fn undetermined(&self) -> String {
        let mut text = wrap("THE EVIDENCE LEAVES UNKNOWNS OPEN: these can move, and no piece of evidence notices.", "");
        for found in &self.result.answer.not_determined {
            text.push_str(&wrap(&format!("{}.", direction(found, &self.result.solved, self.units)), "- "));
        }
        text.push_str(&wrap(
            "What to do: add evidence that depends on one of them, or take one as known. What is open has no value below.",
            "",
        ));
        text
    }

    fn contradicted(&self) -> String {
        let best = self.result.answer.best();
        let mut text = wrap(&format!("THE EVIDENCE CONTRADICTS ITSELF: at its least, {}.", self.chi_square()), "");
        text.push_str(&match self.result.furthest() {
            Some((fitted, residual)) => wrap(&self.off(fitted, residual), ""),
            None => wrap("All of it was given as exact, and no unknowns fit it.", ""),
        });
        let share = if best.degrees_of_freedom == 0 { " The mechanics reaches none nearer." } else { "" };
        text.push_str(&wrap(
            &format!(
                "What to do: re-examine that piece and its standard deviation first, then the geometry: impact center and crush plane.{share} \
                 The numbers below are the least disagreement, and not an answer."
            ),
            "",
        ));
        text
    }

    /// How far a piece is off, in its unit and in standard deviations.
    fn off(&self, fitted: &Fitted, residual: f64) -> String {
        let measure = measure_of(fitted.of);
        let say = |value| format!("{} {}", rounded(measure, value, fitted.sd, self.units), self.units.unit(measure)).trim_end().to_owned();
        format!(
            "Furthest off is {}: given {}, computed {}, {:.1} standard deviations apart.",
            fitted.of.name(),
            say(fitted.given),
            say(fitted.computed),
            residual.abs()
        )
    }

    fn bounds_exclude(&self) -> String {
        let answer = &self.result.answer;
        let mut text = wrap(&format!("THE BOUNDS EXCLUDE WHAT THE EVIDENCE ASKS FOR: within them, {}.", self.chi_square()), "");
        if let Some(free) = &answer.without_bounds {
            for (within, without) in answer.best().unknowns.iter().zip(&free.unknowns) {
                let Some(bound) = within.at else { continue };
                let say = |value, sd| with_spread(measure_in(within.of, &self.result.solved), value, sd, self.units);
                let which = if bound == Bound::Min { "min" } else { "max" };
                let name = within.of.name();
                let (held, asked) = (say(within.value, None), say(without.value, without.sd));
                text.push_str(&wrap(
                    &format!("{name} is held at its {which}, {held}; without bounds the evidence asks for {asked}."),
                    "- ",
                ));
            }
            text.push_str(&wrap(&format!("Without bounds chi-square is {}.", digits(free.chi_square)), ""));
        }
        text.push_str(&wrap(
            "What to do: re-examine the reason for that bound, then the evidence. The numbers below are the best within the bounds, and not an answer.",
            "",
        ));
        text
    }
}

/// A probability, which is never nothing.
pub(super) fn probability(value: f64) -> String {
    if value < 1e-12 { "below 1e-12".to_owned() } else { digits(value) }
}

/// Three digits that matter, small ones by their power of ten.
pub(super) fn digits(value: f64) -> String {
    match value {
        v if v == 0.0 || v.abs() < 1e-15 => "0".to_owned(),
        v if v.abs() < 1e-3 => format!("{v:.1e}"),
        v if v.abs() < 10.0 => format!("{v:.3}"),
        v if v.abs() < 1e6 => format!("{v:.1}"),
        v => format!("{v:.2e}"),
    }
}
