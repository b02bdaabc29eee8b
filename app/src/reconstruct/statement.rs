//! Statements whose probability is asked for, such as `vehicle.1.speed > 50 km/h`.

use planar_impact::reconstruct::{Marginal, Measurand};

use super::question::{Question, has_rotation, measure_of, name_in};
use crate::issue::{Issue, Issues};
use crate::names;
use crate::notice::Notice;
use crate::quantity::{self, Kind, did_you_mean};
use crate::statement::{Written, of_half_turn};

/// A quantity compared with a value.
#[derive(Clone, Debug, PartialEq)]
pub struct Statement {
    /// As it is written.
    pub text: String,
    /// The quantity.
    pub of: Measurand,
    /// `true` if the quantity is said to be greater than the value, `false` if less.
    is_above: bool,
    /// The value, in SI.
    value: f64,
    /// That its unit is assumed, if it has none.
    pub notice: Option<Notice>,
}

impl Statement {
    /// Parses statements about a question, as `NAME > VALUE`, or with `<`, `>=` or `<=`.
    ///
    /// # Errors
    ///
    /// Every statement that cannot be read, or whose quantity the collision does not have.
    pub fn read_all(texts: &[String], question: &Question) -> Result<Vec<Statement>, Issues> {
        let (mut read, mut issues) = (Vec::new(), Vec::new());
        for text in texts {
            match Statement::read(text, question) {
                Ok(statement) => read.push(statement),
                Err(issue) => issues.push(issue),
            }
        }
        if issues.is_empty() { Ok(read) } else { Err(Issues::of_call(issues)) }
    }

    fn read(text: &str, question: &Question) -> Result<Statement, Issue> {
        let issue = |word: &str, message: &str, help: Option<String>| names::issue("--probability", word, message, help);
        // A single value has no probability, so that `>=` is `>`.
        let Written { name, is_above, value, .. } = Written::read(text)?;
        let of = named(name, question).ok_or_else(|| {
            let known = question.asked.unknowns.iter().map(|unknown| name_in(unknown.of, &question.case));
            let all = known.chain(Measurand::all().map(|of| of.name().to_owned()));
            issue(name, "no quantity has this name", did_you_mean(name, all))
        })?;
        if !question.asked.determines(of) {
            let help = of.is_in(&question.asked.collision).then(|| "give contact.crush_share, or the crush of each vehicle".to_owned());
            return Err(issue(name, "the collision does not determine this quantity", help));
        }
        if has_rotation(of, &question.case) {
            let help = "give `yaw_inertia` and `impact_center` of both vehicles".to_owned();
            return Err(issue(name, "it includes the energy of rotation, of which point masses have none", Some(help)));
        }
        let value = quantity::parse_word(value, Kind::from(measure_of(of, &question.case)))
            .map_err(|error| issue(name, &error.message, error.help))?;
        Ok(Statement { text: text.to_owned(), of, is_above, value: value.si, notice: Notice::unit_assumed(text, &value) })
    }

    /// Warns if it is about an angle that lies on both sides of half a turn.
    pub fn of_half_turn(&self, question: &Question, marginal: &Marginal) -> Option<Notice> {
        let ends = [0.001, 0.999].map(|share| marginal.quantile(share));
        let is_computed = !matches!(self.of, Measurand::Variable(_));
        of_half_turn(&self.text, measure_of(self.of, &question.case), self.value, ends).filter(|_| is_computed)
    }

    /// Returns its probability under the posterior of its quantity.
    pub fn probability(&self, marginal: &Marginal) -> f64 {
        if self.is_above { marginal.probability_above(self.value) } else { marginal.probability_below(self.value) }
    }
}

/// Returns the quantity with a name: an unknown by its name in the case, before what follows from the unknowns.
fn named(name: &str, question: &Question) -> Option<Measurand> {
    let unknown = question.asked.unknowns.iter().find(|unknown| name_in(unknown.of, &question.case) == name);
    unknown.map(|unknown| Measurand::Variable(unknown.of)).or_else(|| Measurand::named(name))
}
