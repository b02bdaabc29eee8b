//! The verb `uncertainty`: what the outputs of a case are worth, given its uncertain inputs.

mod answer;
mod bounds;
mod doubts;
mod mapping;
mod model;
mod rounding;
mod variance;

use std::collections::BTreeMap;

use planar_impact::uncertainty::{self as library, Estimated, Sampled, Threshold, Uncertain};
use planar_impact::{Distribution, ImpulseRatio, Output, Refusals, simulation};

use crate::answer::Answer;
use crate::case::{Case, CaseOutput, Parameter, UncertainInput};
use crate::control::Control;
use crate::gradient::principal;
use crate::issue::{Cause, Issue, Issues};
use crate::message::Message;
use crate::named::{Named, positive_zero};
use crate::names;
use crate::notice::{Notice, Notices};
use crate::quantity::{self, Kind};
use crate::statement::{self, Written};
use crate::units::Measure;
use crate::wording;
use model::CaseModel;

pub use answer::{
    Bounds, Density, Linear, MonteCarlo, OutputUncertainty, Probability, RefusedSamples, SecondOrder, ShapleyEffect, Share,
    UncertainNumber, Uncertainty,
};
pub(crate) use bounds::wrong_sd as wrong_bounds_sd;

/// A way to say how uncertain an output is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Method {
    /// First derivatives.
    Linear,
    /// First and second derivatives.
    SecondOrder,
    /// Samples.
    MonteCarlo,
    /// Shares in the variance, from samples.
    Sobol,
    /// Parts of the variance, of correlated inputs too, from samples.
    Shapley,
    /// A guaranteed range.
    Bounds,
}

impl Method {
    /// All of them.
    pub const ALL: [Method; 6] = [Method::Linear, Method::SecondOrder, Method::MonteCarlo, Method::Sobol, Method::Shapley, Method::Bounds];
}

/// What is asked of the uncertain inputs.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// The outputs by name or symbol; the principal ones if empty.
    pub of: Vec<String>,
    /// The methods; all that apply if empty.
    pub methods: Vec<Method>,
    /// The number of samples; with a precision, the greatest.
    pub samples: u64,
    /// Their seed.
    pub seed: u64,
    /// `true` for points of Sobol' in place of random ones.
    pub points_of_sobol: bool,
    /// The standard error of every mean that is small enough, as a share of the mean or of the standard deviation, whichever is greater.
    pub precision: Option<f64>,
    /// Statements whose probability is wanted, such as `dV1 > 25 mph`.
    pub probabilities: Vec<String>,
    /// The level of the middle range, whose ends are among the quantiles.
    pub level: f64,
    /// The standard deviations at which `bounds` ends inputs without limits.
    pub bounds_sd: f64,
}

impl Default for Options {
    fn default() -> Self {
        Options {
            of: Vec::new(),
            methods: Vec::new(),
            samples: 100_000,
            seed: 1,
            points_of_sobol: false,
            precision: None,
            probabilities: Vec::new(),
            level: 0.95,
            bounds_sd: 3.0,
        }
    }
}

/// Largest number of uncertain inputs: every output follows all of them by each.
const MOST_INPUTS: usize = 1000;

/// Computes the uncertainty of the outputs of a case.
///
/// # Errors
///
/// A case without an uncertain input, everything wrong with the options, and physics that refuses every sample.
pub fn uncertainty(case: &Case, options: &Options, control: &dyn Control) -> Result<Answer<Uncertainty>, Issues> {
    case.needs_everything()?;
    let question = Question::read(case, options)?;
    let mut found = question.found();
    question.expand(&mut found);
    question.sample(&mut found, control)?;
    question.share(&mut found, control)?;
    question.divide(&mut found, control)?;
    question.bound(&mut found, control)?;
    found.of.iter_mut().zip(found.scales).for_each(|(found, scale)| found.remove_rounding(scale));
    let of = question.outputs.iter().zip(found.of).collect();
    Ok(Answer::new(&case.title, Uncertainty { of, ..found.facts }, found.notices))
}

/// Returns the covariances of outputs of the impact to first order in the uncertain inputs, infinite or NaN where there are none; `None` where the case has no
/// such inputs or no such outputs, and where physics refuses their means.
pub(crate) fn covariances(case: &Case, of: &[Output]) -> Option<Vec<Vec<f64>>> {
    let uncertain = uncertain(case).ok().filter(|uncertain| !uncertain.numbers().is_empty())?;
    let of: Vec<CaseOutput> = of.iter().copied().map(CaseOutput::Impact).collect();
    let has_all = of.iter().all(|of| case.setup.outputs().contains(of));
    uncertain.covariances(&of).ok().filter(|_| has_all)
}

/// Returns the model of a case with its uncertain numbers and their correlations.
fn uncertain(case: &Case) -> Result<Uncertain<CaseModel>, Issues> {
    let inputs = &case.uncertain.inputs;
    let numbers = inputs.iter().map(number).collect::<Result<_, _>>().map_err(Issues::defect)?;
    let place = |parameter: Parameter| inputs.iter().position(|input| input.parameter == parameter);
    let pairs = case.uncertain.correlations.iter().filter_map(|pair| Some((place(pair.one)?, place(pair.other)?, pair.coefficient)));
    Uncertain::new(CaseModel::of(case), numbers).with_correlations(&pairs.collect::<Vec<_>>()).map_err(Issues::defect)
}

/// What is asked, read and checked.
struct Question<'a> {
    case: &'a Case,
    options: &'a Options,
    uncertain: Uncertain<CaseModel>,
    parameters: Vec<Parameter>,
    outputs: Vec<CaseOutput>,
    thresholds: Vec<Threshold<CaseOutput>>,
    /// Those of the case and of the call.
    notices: Notices,
}

/// The answer as far as it is known.
struct Found {
    facts: Uncertainty,
    of: Vec<OutputUncertainty>,
    /// The size that numbers of each output's measure have in the nominal case; none if physics refuses it.
    scales: Vec<f64>,
    notices: Notices,
}

impl Found {
    /// Adds samples to those drawn, and those that physics refuses of them.
    fn count(&mut self, samples: u64, refused: &simulation::RefusedSamples) {
        let all = &mut self.facts.refused;
        let mut by_code: BTreeMap<&str, u64> = all.reasons.iter().map(|(code, count)| (code, *count)).collect();
        refused.by_code.iter().for_each(|(code, count)| *by_code.entry(code).or_default() += count);
        let reasons = by_code.into_iter().collect();
        *all = RefusedSamples { count: all.count + refused.samples, reasons };
        self.facts.samples += samples;
    }
}

impl<'a> Question<'a> {
    fn read(case: &'a Case, options: &'a Options) -> Result<Self, Issues> {
        let mut issues = Vec::new();
        let outputs = names::outputs("--of", &options.of, &case.setup, &mut issues).unwrap_or_else(|| principal(case));
        let mut notices = case.notices.clone();
        let thresholds = options.probabilities.iter().filter_map(|text| match threshold(text, case) {
            Ok((threshold, of_threshold)) => {
                notices.0.extend(of_threshold);
                Some(threshold)
            }
            Err(found) => {
                issues.extend(found);
                None
            }
        });
        let thresholds = thresholds.collect();
        issues.extend(options.issues());
        if case.uncertain.inputs.is_empty() {
            let help = "give one as \"40 mph ± 2 mph\", or as a table such as { min = 0, max = 0.3 }".to_owned();
            issues.push(Issue::of_call("CASE", "no input of the case is uncertain".to_owned(), Some(help)));
        }
        let count = case.uncertain.inputs.len();
        if count > MOST_INPUTS {
            let help = "give those that matter least without an uncertainty".to_owned();
            issues.push(Issue::of_call(
                "CASE",
                format!("{count} inputs of the case are uncertain; at most {MOST_INPUTS} can be"),
                Some(help),
            ));
        }
        if !issues.is_empty() {
            return Err(Issues::of_call(issues));
        }
        let uncertain = uncertain(case)?;
        notices.0.extend(case.independent_frictions(false));
        let parameters = case.uncertain.inputs.iter().map(|input| input.parameter).collect();
        Ok(Question { case, options, uncertain, parameters, outputs, thresholds, notices })
    }

    fn asks(&self, method: Method) -> bool {
        self.options.methods.is_empty() || self.options.methods.contains(&method)
    }

    /// Returns `true` if the outputs themselves are sampled, not their parts in the variance alone.
    fn samples_outputs(&self) -> bool {
        self.asks(Method::MonteCarlo) || !self.thresholds.is_empty()
    }

    fn named<V>(&self, values: impl IntoIterator<Item = V>) -> Named<V> {
        self.parameters.iter().zip(values).collect()
    }

    /// Returns the answer before any method.
    fn found(&self) -> Found {
        let nominal = self.case.setup.solve().ok();
        let value = |of: &CaseOutput| nominal.as_ref().and_then(|outputs| outputs.get(*of)).map_or(f64::NAN, positive_zero);
        let numbers = self.uncertain.numbers().iter().map(|number| {
            let (least, greatest) = number.range(self.options.bounds_sd);
            UncertainNumber { value: number.nominal(), mean: number.mean(), sd: number.sd(), range: [least, greatest] }
        });
        let mut notices = self.notices.clone();
        if nominal.is_none() {
            let message = "physics refuses the collision at the nominal values of the inputs, which therefore has no value";
            notices.0.push(Notice::warning("nominal-refused", "", message));
        }
        Found {
            of: self.outputs.iter().map(|of| OutputUncertainty { value: value(of), ..OutputUncertainty::default() }).collect(),
            scales: nominal.iter().flat_map(|nominal| self.outputs.iter().map(|of| nominal.scale(of.measure()))).collect(),
            facts: Uncertainty {
                samples: 0,
                seed: self.options.seed,
                refused: RefusedSamples { count: 0, reasons: Named::from_iter(Vec::<(String, u64)>::new()) },
                inputs: self.named(numbers.collect::<Vec<_>>()),
                of: Named::from_iter(Vec::<(String, OutputUncertainty)>::new()),
                probabilities: Named::from_iter(Vec::<(String, Probability)>::new()),
                outputs: self.outputs.clone(),
                parameters: self.parameters.clone(),
                level: self.options.level,
            },
            notices,
        }
    }

    /// Adds what derivatives say.
    fn expand(&self, found: &mut Found) {
        let infinite: Vec<String> = self.infinite().map(|parameter| parameter.to_string()).collect();
        if !infinite.is_empty() {
            let message = format!(
                "{} has no finite standard deviation, and neither has what depends on it: only quantiles and probabilities of samples hold",
                infinite.join(", ")
            );
            found.notices.0.push(Notice::warning("infinite-deviation", "", message));
        }
        let heavy: Vec<String> = self.heavy().map(|parameter| parameter.to_string()).collect();
        if !heavy.is_empty() && self.asks(Method::MonteCarlo) && self.outputs.iter().any(|of| of.measure() == Measure::Energy) {
            let message = format!(
                "{} follows Student's t of so few measurements that energies, which grow with the square of a speed, have no finite standard deviation: only their \
                 quantiles and probabilities of samples hold",
                heavy.join(", ")
            );
            found.notices.0.push(Notice::warning("infinite-deviation", "energy", message));
        }
        // Without means of the inputs there is no place for derivatives.
        let has_means = self.uncertain.means().iter().all(|mean| mean.is_finite());
        if !has_means || (!self.asks(Method::Linear) && !self.asks(Method::SecondOrder)) {
            return;
        }
        let switch = self.of_switch();
        for (of, to) in self.outputs.iter().zip(&mut found.of) {
            let refused = match self.expand_one(*of, to, switch.is_none(), &mut found.notices.0) {
                Ok(()) => continue,
                Err(refusals) => refusals,
            };
            let message = Message::from("physics refuses the collision at the means of the inputs, so that there are no derivatives: ");
            found.notices.0.push(Notice::warning("means-refused", "", message.join(wording::reasons(&refused))));
            break;
        }
        found.notices.0.extend(switch);
    }

    /// Warns if the friction may hold, and may give way, within the uncertainty, where derivatives are those of one side.
    fn of_switch(&self) -> Option<Notice> {
        /// Standard deviations within which it may.
        const NEAR: f64 = 2.0;
        let at = self.parameters.iter().position(|parameter| *parameter == Parameter::Friction);
        let own = at.map(|at| &self.uncertain.numbers()[at]);
        let friction = match (own, self.case.collision.impulse_ratio) {
            (Some(own), _) => own.mean(),
            (None, ImpulseRatio::LimitedByFriction(friction)) => friction,
            _ => return None,
        };
        let critical = self.uncertain.linear(CaseOutput::Impact(Output::CriticalImpulseRatio)).ok()?;
        let sd = own.map_or(0.0, library::UncertainNumber::sd) + critical.sd;
        let message = || {
            Message::from("the friction of ")
                .figure(Measure::Ratio, friction)
                .text(" may hold and may give way within the uncertainty (the critical ratio is ")
                .figure(Measure::Ratio, critical.mean.abs())
                .text("), and derivatives are those of one side: samples have both")
        };
        // Without friction nothing holds.
        let is_near = sd > 0.0 && friction > 0.0 && (friction - critical.mean.abs()).abs() <= NEAR * sd;
        is_near.then(|| Notice::warning("friction-switch", "contact.friction", message()))
    }

    fn infinite(&self) -> impl Iterator<Item = Parameter> + '_ {
        let is_infinite = |(_, number): &(&Parameter, &library::UncertainNumber)| !number.sd().is_finite();
        self.parameters.iter().zip(self.uncertain.numbers()).filter(is_infinite).map(|(parameter, _)| *parameter)
    }

    /// Returns the speeds and yaw rates with a finite standard deviation of which the square has none.
    fn heavy(&self) -> impl Iterator<Item = Parameter> + '_ {
        /// Student's t has moments below its degrees of freedom, one less than the measurements: a fourth one from six on.
        const FEW: u32 = 5;
        let is_heavy = |number: &library::UncertainNumber| matches!(number, library::UncertainNumber::Of(Distribution::StudentT { n, .. }) if *n <= FEW);
        let is_of_motion = |parameter: &Parameter| matches!(parameter.measure(), Measure::Speed | Measure::YawRate);
        let numbers = self.parameters.iter().zip(self.uncertain.numbers());
        let heavy = numbers.filter(move |(parameter, number)| is_of_motion(parameter) && number.sd().is_finite() && is_heavy(number));
        heavy.map(|(parameter, _)| *parameter)
    }

    /// Adds what derivatives say of an output, with a warning of a corner unless another one gives its reason.
    fn expand_one(
        &self,
        of: CaseOutput,
        to: &mut OutputUncertainty,
        warns_of_corner: bool,
        notices: &mut Vec<Notice>,
    ) -> Result<(), Refusals> {
        /// Most inputs whose curvature judges the slopes: it grows with their square.
        const MOST_BENT: usize = 64;
        let is_judged = self.asks(Method::Linear) && self.parameters.len() <= MOST_BENT;
        let second = (is_judged || self.asks(Method::SecondOrder)).then(|| self.uncertain.second_order(of));
        if self.asks(Method::Linear) {
            let linear = self.uncertain.linear(of)?;
            let bent = second.as_ref().filter(|_| is_judged).and_then(|second| second.as_ref().ok());
            let bent = bent.filter(|second| doubts::is_bent(&linear, second)).map(|second| doubts::linear_bends(of, linear.sd, second.sd));
            let at_corner = || {
                let beside = self.uncertain.beside_means(of, &linear);
                doubts::is_at_corner(&linear, &beside).then(|| doubts::linear_at_corner(of, &beside))
            };
            let doubt = bent.or_else(|| at_corner().filter(|_| warns_of_corner));
            let effect = |(derivative, number): (&f64, &library::UncertainNumber)| {
                if *derivative == 0.0 { 0.0 } else { positive_zero(derivative * number.sd()) }
            };
            to.linear = Some(Linear {
                effects: self.named(linear.derivatives.iter().zip(self.uncertain.numbers()).map(effect)),
                mean: positive_zero(linear.mean),
                sd: linear.sd,
                shares: self.named(linear.shares),
                // Of slopes that say little of the deviation, these say nothing.
                sd_if_halved: self.named(linear.with_half.into_iter().map(|sd| if doubt.is_some() { f64::NAN } else { sd })),
            });
            notices.extend(doubt);
        }
        if let Some(second) = second.filter(|_| self.asks(Method::SecondOrder)) {
            let library::SecondOrder { mean, sd, skewness } = second?;
            to.second_order = Some(SecondOrder { mean: positive_zero(mean), sd, skewness });
        }
        Ok(())
    }

    /// Adds what samples say.
    fn sample(&self, found: &mut Found, control: &dyn Control) -> Result<(), Issues> {
        if !self.samples_outputs() {
            return Ok(());
        }
        let Options { samples, seed, precision, level, points_of_sobol, .. } = *self.options;
        let question = library::MonteCarlo {
            samples,
            seed,
            precision,
            points: if points_of_sobol { library::Points::Sobol } else { library::Points::Random },
            quantiles: ends(level).into(),
            statements: self.thresholds.clone(),
        };
        let goes_on = |done: u64| control.goes_on(saturated(done), saturated(samples));
        let sampled = self.uncertain.monte_carlo_while(&self.outputs, &question, &goes_on);
        if !control.goes_on(saturated(sampled.samples), saturated(samples)) {
            return Err(Issues::interrupted());
        }
        if sampled.refused.samples == sampled.samples {
            return Err(self.nothing_is_possible(&sampled));
        }
        for (output, to) in sampled.outputs.iter().zip(&mut found.of).filter(|_| self.asks(Method::MonteCarlo)) {
            let quantiles =
                |f: fn(&Estimated) -> f64| output.quantiles.iter().map(|(p, quantile)| (p, f(quantile))).collect::<Named<f64>>();
            to.monte_carlo = Some(MonteCarlo {
                mean: positive_zero(output.mean.value),
                mean_se: output.mean.standard_error,
                sd: output.sd.value,
                sd_se: output.sd.standard_error,
                skewness: output.skewness,
                quantiles: quantiles(|quantile| positive_zero(quantile.value)),
                quantiles_se: quantiles(|quantile| quantile.standard_error),
                density: Density { edges: output.edges.clone(), shares: output.shares.clone() },
            });
        }
        let probability = |found: &Estimated| Probability { value: found.value, se: found.standard_error };
        found.facts.probabilities = self.options.probabilities.iter().zip(sampled.probabilities.iter().map(probability)).collect();
        let three_sd = |of: CaseOutput| {
            let moments = sampled.outputs.iter().find(|output| output.of == of)?;
            Some([-3.0, 3.0].map(|sds| moments.mean.value + sds * moments.sd.value))
        };
        let of_half_turn = self.options.probabilities.iter().zip(&self.thresholds).filter_map(|(text, threshold)| {
            statement::of_half_turn(text, threshold.of.measure(), threshold.value, three_sd(threshold.of)?)
        });
        found.notices.0.extend(of_half_turn);
        found.count(sampled.samples, &sampled.refused);
        found.notices.0.extend(doubts::most_refused(sampled.samples, sampled.refused.samples));
        if self.infinite().next().is_none() {
            found.notices.0.extend(doubts::heavy_tails(&self.outputs, &found.of, sampled.samples - sampled.refused.samples));
        }
        if let Some(precision) = precision.filter(|_| !sampled.is_precise) {
            // To the digits in which it is written.
            let percent = (precision * 1e14).round() / 1e12;
            let message = format!("{samples} samples do not reach the precision of {percent} %: give more with --samples");
            found.notices.0.push(Notice::warning("precision-not-reached", "", message));
        }
        if self.asks(Method::MonteCarlo) {
            found.notices.0.extend(doubts::few_samples(sampled.samples, sampled.refused.samples, level));
        }
        Ok(())
    }

    fn nothing_is_possible(&self, sampled: &Sampled<CaseOutput>) -> Issues {
        let reasons: Vec<String> = sampled.refused.by_code.iter().map(|(code, count)| format!("{code} ({count})")).collect();
        let message = format!("physics refuses each of {} samples: {}", sampled.samples, reasons.join(", "));
        let help = "give the inputs distributions within which the vehicles collide".to_owned();
        let issue = Issue::of_call("CASE", message, Some(help));
        Issues::without_source(Cause::Physics, vec![issue])
    }
}

impl Options {
    /// Returns the error of a given option, such as `--samples`, that has no effect with the methods. A probability is sampled with any method.
    pub fn without_effect(&self, given: &[&str]) -> Option<Issue> {
        if self.methods.is_empty() || !self.probabilities.is_empty() || self.methods.contains(&Method::MonteCarlo) {
            return None;
        }
        let draws = self.methods.iter().any(|method| [Method::Sobol, Method::Shapley].contains(method));
        given.iter().find_map(|option| {
            let (what, remedy) = match *option {
                "--samples" | "--seed" if !draws => ("no method of the call draws samples", "monte-carlo, sobol or shapley"),
                // Shares in the variance have a plan of their own.
                "--points" | "--precision" | "--level" => {
                    ("it is for samples of the outputs, which no method of the call draws", "monte-carlo")
                }
                _ => return None,
            };
            let help = format!("add {remedy} to --method, or leave {option} out");
            Some(Issue::of_call(option, format!("it has no effect: {what}"), Some(help)))
        })
    }

    fn issues(&self) -> Vec<Issue> {
        let mut issues = Vec::new();
        let mut wrong = |option: &str, message: String, help: &str| issues.push(Issue::of_call(option, message, Some(help.to_owned())));
        if self.samples < 2 {
            wrong("--samples", format!("{} samples have no standard deviation", self.samples), "give at least 2");
        }
        if self.precision.is_some_and(|precision| !(precision > 0.0 && precision < 1.0)) {
            wrong("--precision", "it must be above 0 and below 1".to_owned(), "for instance 0.001");
        }
        if !(0.5..=0.9999).contains(&self.level) {
            wrong("--level", format!("{} is not from 0.5 to 0.9999", self.level), "for instance 0.95");
        }
        issues.extend(bounds::wrong_sd(self.bounds_sd));
        issues
    }
}

/// Returns the distribution of an input: of measured values themselves, where the file has them.
fn number(input: &UncertainInput) -> Result<library::UncertainNumber, planar_impact::Issues<planar_impact::InputIssue>> {
    match &input.values {
        Some(values) => library::Values::new(values.to_vec()).map(library::UncertainNumber::Values),
        None => Ok(input.distribution.into()),
    }
}

/// Returns the probabilities of the ends of the middle range.
pub fn ends(level: f64) -> [f64; 2] {
    // To the digits in which it is written.
    let tail = ((1.0 - level) * 0.5e12).round() / 1e12;
    [tail, 1.0 - tail]
}

/// Parses a statement about an output, with notes: that its unit is assumed if it has none, and that it is of the motion after the impact if an input has its name.
fn threshold(text: &str, case: &Case) -> Result<(Threshold<CaseOutput>, Vec<Notice>), Vec<Issue>> {
    let Written { name, is_above, or_equal, value } = Written::read(text).map_err(|issue| vec![issue])?;
    let mut issues = Vec::new();
    let of = names::outputs("--probability", &[name.to_owned()], &case.setup, &mut issues);
    let Some([of]) = of.as_deref() else {
        if issues.is_empty() {
            issues.push(names::issue("--probability", name, "a statement is about one output", None));
        }
        return Err(issues);
    };
    let value = quantity::parse_word(value, Kind::from(of.measure()))
        .map_err(|error| vec![names::issue("--probability", name, &error.message, error.help)])?;
    let is_of_motion = matches!(of, CaseOutput::Impact(Output::VelocityX(_) | Output::VelocityY(_) | Output::YawRate(_)));
    let after = || {
        let message = format!(
            "`{text}` is of the motion after the impact; that before it is an input. The name {} has no other meaning",
            of.qualified_name()
        );
        Notice::note("after-impact", text, message)
    };
    let is_of_input_too = is_of_motion && name != of.qualified_name();
    let notices = Notice::unit_assumed(text, &value).into_iter().chain(is_of_input_too.then(after)).collect();
    Ok((Threshold { of: *of, is_above, or_equal, value: value.si }, notices))
}

fn saturated(count: u64) -> usize {
    usize::try_from(count).unwrap_or(usize::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn options_without_effect_are_named_with_their_remedy() {
        use Method::{Bounds, Linear, MonteCarlo, SecondOrder, Shapley, Sobol};
        for (methods, given, idle) in [
            (&[Linear][..], "--samples", true),
            (&[Linear, Bounds], "--seed", true),
            (&[SecondOrder], "--points", true),
            (&[Sobol], "--precision", true),
            (&[Shapley], "--points", true),
            (&[Bounds], "--level", true),
            (&[Sobol], "--samples", false),
            (&[Shapley], "--seed", false),
            (&[Linear, MonteCarlo], "--points", false),
            (&[], "--points", false),
        ] {
            let options = Options { methods: methods.to_vec(), ..Options::default() };
            let found = options.without_effect(&[given]);
            assert_eq!(found.as_ref().map(|issue| issue.path.as_str()), idle.then_some(given), "{methods:?}");
            let help = found.and_then(|issue| issue.help).map(|help| help.to_string()).unwrap_or_default();
            assert!(!idle || help.contains("monte-carlo") && help.contains(given), "{help}");
            assert_eq!(help.contains("sobol"), idle && ["--samples", "--seed"].contains(&given), "{help}");
            let asked = Options { probabilities: vec!["dV1 > 1 m/s".to_owned()], ..options };
            assert_eq!(asked.without_effect(&[given]), None);
        }
    }
}
