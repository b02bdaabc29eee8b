//! The posterior in the answer of `reconstruct`.

use planar_impact::reconstruct::{Answer, Marginal, Measurand, NoPosterior, Sampling};
use schemars::JsonSchema;
use serde::Serialize;

use super::question::{Question, name_in, name_of};
use super::statement::Statement;
use crate::control::Control;
use crate::issue::{Issue, Issues};
use crate::named::{Named, positive_zero};
use crate::notice::Notice;
use crate::units::trim;

/// Least number of independent draws for quantiles.
const INDEPENDENT: f64 = 400.0;

/// Least number of independent draws outside of a shortest range, which fewer make shorter by more than 3 %.
const OUTSIDE: f64 = 20.0;

/// The draws of the posterior.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Draws {
    /// Number of chains.
    pub chains: usize,
    /// Number of draws of each chain.
    pub draws: usize,
    /// The seed of the draws.
    pub seed: u64,
    /// The greatest R-hat of an unknown or of a derived quantity; `null` if none varies.
    pub r_hat: Option<f64>,
    /// The least number of independent draws of an unknown or of a derived quantity; `null` if none varies.
    pub ess: Option<f64>,
    /// The joint density of each pair of the unknowns listed under `[unknown]`.
    pub pairs: Vec<PairDensity>,
    /// The value of each unknown and of each derived quantity in each draw, chain after chain; only on request.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub values: Option<Named<Vec<f64>>>,
}

/// The posterior of one quantity.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Posterior {
    /// The mean.
    pub mean: f64,
    /// The standard deviation.
    pub sd: f64,
    /// The median.
    pub median: f64,
    /// The shortest range that has the probability of the intervals.
    pub hdi: [f64; 2],
    /// Values below which a share of the draws lies, by that share.
    pub quantiles: Named<f64>,
    /// The density of the draws; `null` where they do not vary.
    pub density: Option<PosteriorDensity>,
    /// R-hat, split and of ranks: the draws have converged where it is below 1.01; `null` where they do not vary.
    pub r_hat: Option<f64>,
    /// Number of independent draws that would know the middle and the tails as well; `null` where they do not vary.
    pub ess: Option<f64>,
}

/// The share of the draws in bins of equal width.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct PosteriorDensity {
    /// Edges of the bins from the least draw to the greatest, one more than bins.
    pub edges: Vec<f64>,
    /// The share of the draws in each; they add up to 1.
    pub shares: Vec<f64>,
}

/// The share of the draws in each cell of a grid, whose columns and rows are the bins of two unknowns.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct PairDensity {
    /// The unknown whose bins are the columns.
    pub x: String,
    /// The unknown whose bins are the rows.
    pub y: String,
    /// The shares of each row, the least values first; all of them add up to 1.
    pub shares: Vec<Vec<f64>>,
}

/// The bins of the draws of a quantity.
struct Bins {
    edges: Vec<f64>,
    /// The bin of each draw.
    places: Vec<usize>,
}

impl Bins {
    /// Number of bins.
    const COUNT: usize = 24;

    /// Divides the range of the draws; `None` if they do not vary, or one is not finite.
    fn of(draws: &[f64]) -> Option<Bins> {
        let (least, greatest) =
            draws.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(least, greatest), x| (least.min(*x), greatest.max(*x)));
        let width = (greatest - least) / Bins::COUNT as f64;
        let is_range = draws.iter().all(|x| x.is_finite()) && width > 0.0 && width.is_finite() && least + width > least;
        is_range.then(|| Bins {
            edges: (0..Bins::COUNT).map(|bin| least + bin as f64 * width).chain([greatest]).collect(),
            // The greatest draw is in the last bin.
            places: draws.iter().map(|x| (((x - least) / width) as usize).min(Bins::COUNT - 1)).collect(),
        })
    }

    fn density(&self) -> PosteriorDensity {
        let mut counts = [0_usize; Bins::COUNT];
        self.places.iter().for_each(|&place| counts[place] += 1);
        let total = self.places.len() as f64;
        PosteriorDensity { edges: self.edges.clone(), shares: counts.iter().map(|&count| count as f64 / total).collect() }
    }

    /// Returns the shares of the cells with these bins as columns and others as rows.
    fn with_rows(&self, rows: &Bins) -> Vec<Vec<f64>> {
        let mut counts = vec![vec![0_usize; Bins::COUNT]; Bins::COUNT];
        self.places.iter().zip(&rows.places).for_each(|(&column, &row)| counts[row][column] += 1);
        let total = self.places.len() as f64;
        counts.into_iter().map(|row| row.into_iter().map(|count| count as f64 / total).collect()).collect()
    }
}

/// What the draws say of a question.
pub(super) struct Drawn {
    pub(super) draws: Draws,
    pub(super) probabilities: Named<f64>,
    marginals: Vec<Marginal>,
    /// The bins of each quantity whose draws vary.
    bins: Vec<(Measurand, Bins)>,
}

/// What is asked of the posterior.
pub(super) struct Asked<'a> {
    pub(super) sampling: Sampling,
    pub(super) statements: &'a [Statement],
    pub(super) level: f64,
    /// `true` if the answer has the values of each draw.
    pub(super) has_values: bool,
}

impl Drawn {
    /// Draws from the posterior of a question, and summarizes quantities.
    ///
    /// # Errors
    ///
    /// Why there is no posterior, or that the caller stopped it.
    pub(super) fn of(
        question: &Question,
        answer: &Answer,
        of: &[Measurand],
        asked: &Asked<'_>,
        control: &dyn Control,
        notices: &mut Vec<Notice>,
    ) -> Result<Self, Issues> {
        let posterior = question.asked.posterior_while(answer, &asked.sampling, &|done, total| control.goes_on(done, total));
        let posterior = posterior.map_err(|none| refused(question, none))?;
        let mut all = of.to_vec();
        all.extend(asked.statements.iter().map(|statement| statement.of).filter(|statement| !of.contains(statement)));
        let marginals = posterior.marginals(&all, asked.level);
        let find = |of: Measurand| marginals.iter().find(|marginal| marginal.of == of);
        let probability = |statement: &Statement| Some((statement.text.clone(), statement.probability(find(statement.of)?)));
        let name = |of| name_of(of, &question.case);
        let drawn = posterior.values(of);
        let bins: Vec<(Measurand, Bins)> = drawn.iter().filter_map(|(of, draws)| Some((*of, Bins::of(draws)?))).collect();
        let values = asked
            .has_values
            .then(|| drawn.into_iter().map(|(of, values)| (name(of), values.into_iter().map(positive_zero).collect())).collect());
        let of_all = |figure: fn(&Marginal) -> f64, worse: fn(f64, f64) -> f64| {
            marginals.iter().map(figure).filter(|figure| figure.is_finite()).reduce(worse)
        };
        let draws = Draws {
            chains: posterior.chains().len(),
            draws: posterior.chains().first().map_or(0, Vec::len),
            seed: asked.sampling.seed,
            r_hat: of_all(|marginal| marginal.r_hat, f64::max),
            ess: of_all(|marginal| marginal.effective, f64::min),
            pairs: pairs(question, &bins),
            values,
        };
        let softened: Vec<String> = posterior.softened.iter().map(|of| name_of(*of, &question.case)).collect();
        let probabilities = asked.statements.iter().filter_map(probability).collect();
        notices.extend(asked.statements.iter().filter_map(|statement| statement.of_half_turn(question, find(statement.of)?)));
        draws.warn(&softened, answer.solutions.len(), asked.level, notices);
        Ok(Drawn { draws, probabilities, marginals, bins })
    }

    /// Returns the posterior of a quantity.
    pub(super) fn posterior(&self, of: Measurand) -> Option<Posterior> {
        let marginal = self.marginals.iter().find(|marginal| marginal.of == of)?;
        let value = |share: &str| Some((share.to_owned(), positive_zero(marginal.quantile(share.parse().ok()?))));
        Some(Posterior {
            mean: positive_zero(marginal.mean),
            sd: marginal.sd,
            median: positive_zero(marginal.median()),
            hdi: marginal.highest_density.map(positive_zero),
            quantiles: ["0.025", "0.05", "0.25", "0.5", "0.75", "0.95", "0.975"].into_iter().filter_map(value).collect(),
            density: self.bins.iter().find(|(binned, _)| *binned == of).map(|(_, bins)| bins.density()),
            r_hat: Some(marginal.r_hat).filter(|x| x.is_finite()),
            ess: Some(marginal.effective).filter(|x| x.is_finite()),
        })
    }
}

/// Returns the joint densities of the unknowns that the case asks for.
fn pairs(question: &Question, bins: &[(Measurand, Bins)]) -> Vec<PairDensity> {
    let is_asked = |of: &Measurand| matches!(of, Measurand::Variable(of) if !question.inputs.contains(of));
    let asked: Vec<_> = bins.iter().filter(|(of, _)| is_asked(of)).collect();
    let mut pairs = Vec::new();
    for (i, (x, columns)) in asked.iter().enumerate() {
        for (y, rows) in &asked[i + 1..] {
            let [x, y] = [x, y].map(|of| name_of(*of, &question.case));
            pairs.push(PairDensity { x, y, shares: columns.with_rows(rows) });
        }
    }
    pairs
}

impl Draws {
    /// Returns `true` if the chains agree, and have enough independent draws.
    pub fn have_converged(&self) -> bool {
        self.r_hat.is_none_or(|r_hat| r_hat <= Marginal::CONVERGED) && self.ess.is_none_or(|ess| ess >= INDEPENDENT)
    }

    /// Returns the standard error of a probability that the draws give.
    pub fn standard_error(&self, probability: f64) -> f64 {
        (probability * (1.0 - probability) / self.ess.unwrap_or(f64::INFINITY)).sqrt()
    }

    fn warn(&self, softened: &[String], solutions: usize, level: f64, notices: &mut Vec<Notice>) {
        let outside = self.ess.map_or(f64::INFINITY, |ess| (1.0 - level) * ess);
        if !self.have_converged() {
            let (r_hat, ess) = (self.r_hat.unwrap_or(f64::NAN), self.ess.unwrap_or(f64::NAN));
            let message = format!(
                "the draws of the posterior have not converged: R-hat is up to {r_hat:.3}, and no more than {ess:.0} draws are independent; \
                 its numbers are not to be relied on"
            );
            notices.push(Notice::warning("posterior-not-converged", "", message));
        } else if outside < OUTSIDE {
            let message = format!(
                "about {outside:.0} independent draws of the posterior lie outside of its shortest ranges of {} %: they are rough, and rather too \
                 short; ask for a lower level",
                trim(100.0 * level)
            );
            notices.push(Notice::warning("posterior-range-rough", "", message));
        }
        if solutions > 1 {
            let message = format!("the posterior is that of {solutions} solutions together: a mean between them may be near none");
            notices.push(Notice::warning("posterior-has-modes", "", message));
        }
        if !softened.is_empty() {
            let message = format!(
                "the posterior takes exact evidence to a thousandth of its size, and angles to 0.06 deg ({}); give it a standard deviation",
                softened.join(", ")
            );
            notices.push(Notice::note("exact-evidence-softened", "evidence", message));
        }
    }
}

fn refused(question: &Question, none: NoPosterior) -> Issues {
    let help = "give it min and max, or a standard deviation; or leave --posterior out";
    match none {
        NoPosterior::Stopped => Issues::interrupted(),
        NoPosterior::Improper(unknowns) => question.case.unfit(unknowns.into_iter().map(|of| {
            let message = format!("nothing limits {}, so it has no posterior", name_in(of, &question.case));
            Issue::at("posterior-improper", question.places.of_unknown(of), message).with_help(help)
        })),
        none => question.case.refuse_physics([Issue::at("no-posterior", "unknown", none.to_string())]),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Bins of width 1 from 1 to 25, the last with its upper end.
    #[test]
    fn bins_divide_the_range_of_the_draws() {
        let bins = Bins::of(&[1.0, 25.0, 2.5, 24.5, 1.5, 13.0]).expect("a range");
        assert_eq!(bins.edges, (1..=25).map(f64::from).collect::<Vec<_>>());
        assert_eq!(bins.places, [0, 23, 1, 23, 0, 12]);
        let PosteriorDensity { edges, shares } = bins.density();
        assert_eq!((edges, shares[0], shares[1], shares[12], shares[23]), (bins.edges.clone(), 2.0 / 6.0, 1.0 / 6.0, 1.0 / 6.0, 2.0 / 6.0));
        let rows = Bins::of(&[-2.0, 22.0, 22.0, 0.5, 0.5, 0.5]).expect("a range");
        let cells = bins.with_rows(&rows);
        assert_eq!(
            [cells[0][0], cells[23][23], cells[23][1], cells[2][23], cells[2][0], cells[0][23]],
            [1.0 / 6.0, 1.0 / 6.0, 1.0 / 6.0, 1.0 / 6.0, 1.0 / 6.0, 0.0]
        );
        assert!([&[2.0, 2.0][..], &[0.0, f64::NAN], &[0.0, f64::INFINITY]].into_iter().all(|draws| Bins::of(draws).is_none()));
    }

    #[test]
    fn ranges_of_few_draws_have_a_warning() {
        let warned = |ess: f64, level: f64| {
            let draws = Draws { chains: 4, draws: 1000, seed: 1, r_hat: Some(1.0), ess: Some(ess), pairs: Vec::new(), values: None };
            let mut notices = Vec::new();
            draws.warn(&[], 1, level, &mut notices);
            notices.into_iter().map(|notice| (notice.code, notice.message)).collect::<Vec<_>>()
        };
        let codes = |ess, level| warned(ess, level).into_iter().map(|(code, _)| code).collect::<Vec<_>>();
        assert!(codes(500.0, 0.95).is_empty() && codes(2100.0, 0.99).is_empty() && codes(90_000.0, 0.999).is_empty());
        assert_eq!(codes(300.0, 0.95), ["posterior-not-converged"]);
        let said = warned(300.0, 0.95)[0].1.to_string();
        assert!(
            said.starts_with(
                "the draws of the posterior have not converged: R-hat is up to 1.000, and no more than 300 draws are independent"
            ),
            "{said}"
        );
        assert_eq!(codes(1900.0, 0.99), ["posterior-range-rough"]);
        let [(code, message)] = &warned(4000.0, 0.999)[..] else { panic!("one warning") };
        assert_eq!(code, &"posterior-range-rough");
        assert!(
            message.to_string().starts_with("about 4 independent draws of the posterior lie outside of its shortest ranges of 99.9 %"),
            "{message}"
        );
    }
}
