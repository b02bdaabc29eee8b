//! Converts uncertain inputs of a case into unknowns with what is known of them beforehand.

use planar_impact::Distribution;
use planar_impact::reconstruct::{PriorCorrelation, Unknown, Variable};

use crate::case::{Case, Domain, Parameter, UncertainInput, variable_of};
use crate::issue::Issue;
use crate::notice::Notice;

/// Uncertain inputs as unknowns.
#[derive(Default)]
pub struct InputUnknowns {
    /// The unknowns, each with its path in the file, in file order.
    pub unknowns: Vec<(Unknown, String)>,
    /// Correlations of their priors.
    pub correlations: Vec<PriorCorrelation>,
    /// Approximations.
    pub notices: Vec<Notice>,
    /// Inputs that the search cannot take.
    pub issues: Vec<Issue>,
}

impl InputUnknowns {
    /// Converts the uncertain inputs of a case, except the numbers of its crush.
    pub fn of(case: &Case) -> Self {
        let mut found = InputUnknowns::default();
        for input in &case.uncertain.inputs {
            let Some(variable) = variable_of(input.parameter) else { continue };
            if let Some(issue) = without_deviation(input) {
                found.issues.push(issue);
                continue;
            }
            let unknown = unknown(variable, input);
            found.notices.extend(approximated(input).map(|shape| shape_approximated(input, shape)));
            found.unknowns.push((unknown, input.key.clone()));
        }
        for pair in &case.uncertain.correlations {
            let prior = |parameter: Parameter| {
                let variable = variable_of(parameter)?;
                let unknown = found.unknowns.iter().find(|(unknown, _)| unknown.of == variable)?.0;
                unknown.prior.map(|_| variable)
            };
            match (prior(pair.one), prior(pair.other)) {
                (Some(one), Some(other)) => found.correlations.push(PriorCorrelation { one, other, coefficient: pair.coefficient }),
                // The crush energies have the correlations of two numbers of the crush.
                _ if variable_of(pair.one).is_none() && variable_of(pair.other).is_none() => (),
                _ => {
                    let (one, other) = (pair.one, pair.other);
                    let reason = match (variable_of(one), variable_of(other)) {
                        (Some(_), Some(_)) => "one of them has any direction",
                        _ => "one of them is a number of the crush, and the other is not",
                    };
                    let message = format!("the correlation of {one} and {other} is not used: {reason}");
                    found.notices.push(Notice::warning("correlation-not-used", pair.key.clone(), message));
                }
            }
        }
        found
    }
}

/// Returns an unknown that starts at its nominal value, or at its mean where a normal prior replaces another shape.
fn unknown(of: Variable, input: &UncertainInput) -> Unknown {
    let free = Unknown::free(of, input.nominal);
    match input.distribution {
        Distribution::Normal { sd, .. } => Unknown { prior: Some(sd), ..free },
        Distribution::TruncatedNormal { scale, min, max, .. } => Unknown { min: Some(min), max: Some(max), prior: Some(scale), ..free },
        Distribution::Uniform { min, max } if is_any_direction(of, min, max) => Unknown { min: Some(min), max: Some(max), ..free },
        other => {
            let (min, max) = other.support();
            // A limit at zero is that of the mechanics already, unless any number is possible.
            let is_own = |end: &f64| end.is_finite() && (*end != 0.0 || input.parameter.domain() == Domain::Any);
            let [min, max] = [min, max].map(|end| Some(end).filter(is_own));
            Unknown { start: other.mean(), prior: Some(other.sd()), min, max, shape: Some(other), ..free }
        }
    }
}

/// Returns `true` for limits of an angle that leave out no direction.
fn is_any_direction(of: Variable, min: f64, max: f64) -> bool {
    let within = Unknown { min: Some(min), max: Some(max), ..Unknown::free(of, min) };
    within.on_the_circle() != within
}

/// Returns the issue of an input whose standard deviation is infinite, which no normal distribution has.
pub(super) fn without_deviation(input: &UncertainInput) -> Option<Issue> {
    let Distribution::StudentT { n, .. } = input.distribution else { return None };
    (!input.distribution.sd().is_finite()).then(|| {
        let message = format!(
            "{} is the mean of {n} measurements, whose distribution has an infinite standard deviation; `reconstruct` needs a finite one",
            input.parameter
        );
        let help = "measure at least 4 times, or give `value` and an `sd` that allows for so few measurements";
        Issue::at("infinite-deviation", input.key.clone(), message).with_help(help)
    })
}

/// Notes that a normal prior replaces a shape.
pub(super) fn shape_approximated(input: &UncertainInput, shape: &str) -> Notice {
    /// Share of the values that the middle range of 95 % may well leave out by chance.
    const FEW: f64 = 0.075;
    let name = input.parameter;
    let message = format!("{name} is {shape}; the search takes a normal distribution of the same mean and standard deviation for it");
    let (values, distribution) = (input.values.as_deref().unwrap_or_default(), &input.distribution);
    let beyond = values.iter().filter(|value| (*value - distribution.mean()).abs() > Distribution::NORMAL_95 * distribution.sd()).count();
    if beyond as f64 <= FEW * values.len() as f64 {
        return Notice::note("shape-approximated", input.key.clone(), message);
    }
    let message = format!("{message}, which leaves {beyond} of the {} values out of its 95 %: reconstruct once with each", values.len());
    Notice::warning("values-left-out", input.key.clone(), message)
}

/// Returns the name of a shape that a normal prior replaces.
pub(super) fn approximated(input: &UncertainInput) -> Option<&'static str> {
    match input.distribution {
        _ if input.values.is_some() => Some("given by measured values"),
        Distribution::Normal { .. } | Distribution::TruncatedNormal { .. } => None,
        Distribution::Uniform { min, max } => {
            let of_any_direction = variable_of(input.parameter).is_some_and(|of| is_any_direction(of, min, max));
            (!of_any_direction).then_some("uniform")
        }
        Distribution::Triangular { .. } => Some("triangular"),
        Distribution::LogNormal { .. } => Some("log-normal"),
        Distribution::StudentT { .. } => Some("t-distributed"),
        _ => Some("of another shape"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::Source;
    use crate::units::Units;
    use planar_impact::{Input, Side};
    use std::f64::consts::PI;

    fn of(top: &str, mass: &str, speed: &str, restitution: &str) -> InputUnknowns {
        let vehicle = |mass: &str, speed: &str| {
            format!("[[vehicle]]\nmass = {mass}\nyaw_inertia = 1500\nheading = 0\nspeed = {speed}\nimpact_center = [2, 0]\n")
        };
        let contact = format!("[contact]\ncrush_plane = 0\nrestitution = {restitution}\n");
        let text = format!("schema = 1\n{top}\n{}{}{contact}", vehicle(mass, speed), vehicle("1000", "5"));
        InputUnknowns::of(&Case::parse(Source::new("case.toml", text)).expect("a case"))
    }

    const MASS: Variable = Variable::Input(Input::Mass(Side::One));
    const E: Variable = Variable::Input(Input::Restitution);

    fn codes(found: &InputUnknowns) -> Vec<&str> {
        found.notices.iter().map(|notice| notice.code).collect()
    }

    #[test]
    fn normal_numbers_have_priors_and_uniform_ones_have_bounds_too() {
        let found = of("", "\"1600 kg ± 50 kg\"", "{ min = 8, max = 12 }", "{ value = 0.1, sd = 0.05, min = 0, max = 0.3 }");
        let wanted = [
            Unknown { prior: Some(50.0), ..Unknown::free(MASS, 1600.0) },
            // By hand: the standard deviation of a uniform distribution is its width over the root of twelve.
            Unknown {
                min: Some(8.0),
                max: Some(12.0),
                prior: Some(4.0 / 12_f64.sqrt()),
                shape: Some(Distribution::Uniform { min: 8.0, max: 12.0 }),
                ..Unknown::free(Variable::Speed(Side::One), 10.0)
            },
            Unknown { min: Some(0.0), max: Some(0.3), prior: Some(0.05), ..Unknown::free(E, 0.1) },
        ];
        assert_eq!(found.unknowns.iter().map(|(unknown, _)| *unknown).collect::<Vec<_>>(), wanted);
        assert_eq!(found.unknowns[2].1, "contact.restitution");
        assert_eq!(codes(&found), ["shape-approximated"]);
        assert!(Units::Si.sentence(&found.notices[0].message).contains("is uniform"));
    }

    #[test]
    fn other_shapes_keep_their_mean_standard_deviation_and_limits() {
        let found = of("", "{ median = 1600, factor = 1.1 }", "{ median = 10, factor = 1.2 }", "{ min = 0, mode = 0.1, max = 0.3 }");
        let [mass, speed, e] = [0, 1, 2].map(|i| found.unknowns[i].0);
        // m exp(s²/2) and its product with √(exp(s²) − 1), for s = ln f.
        let log_normal = |median: f64, factor: f64| {
            let variance = factor.ln() * factor.ln();
            let mean = median * (0.5 * variance).exp();
            (mean, mean * (variance.exp() - 1.0).sqrt())
        };
        for (unknown, (mean, sd)) in
            [(mass, log_normal(1600.0, 1.1)), (speed, log_normal(10.0, 1.2)), (e, (0.4 / 3.0, ((0.01 + 0.02 + 0.04) / 18.0_f64).sqrt()))]
        {
            assert!(
                (unknown.start / mean - 1.0).abs() < 1e-12 && (unknown.prior.expect("a prior") / sd - 1.0).abs() < 1e-12,
                "{unknown:?}"
            );
        }
        // A mass is above zero anyway; a speed may be negative, unless its logarithm is normal.
        assert_eq!([(mass.min, mass.max), (speed.min, speed.max)], [(None, None), (Some(0.0), None)]);
        assert_eq!(codes(&found), ["shape-approximated"; 3]);
        let texts: Vec<String> = found.notices.iter().map(|notice| Units::Si.sentence(&notice.message)).collect();
        assert!(texts[0].contains("is log-normal") && texts[2].contains("is triangular"), "{texts:?}");
    }

    #[test]
    fn measurements_have_their_mean_and_standard_deviation() {
        // Of nine measurements the mean has 30/3 · √(8/6); of values the variance is the mean square.
        let found = of("", "{ mean = 1600, sd = 30, n = 9 }", "{ values = [9, 10, 14] }", "0.1");
        let [mass, speed] = [0, 1].map(|i| found.unknowns[i].0);
        assert_eq!((mass.start, mass.shape), (1600.0, Some(Distribution::StudentT { mean: 1600.0, sd: 30.0, n: 9 })));
        assert!((mass.prior.expect("a prior") - 10.0 * (8.0_f64 / 6.0).sqrt()).abs() < 1e-12);
        assert_eq!((speed.start, speed.shape, speed.min), (11.0, None, None));
        assert!((speed.prior.expect("a prior") - (14.0_f64 / 3.0).sqrt()).abs() < 1e-12);
        assert_eq!((codes(&found), found.issues.len()), (vec!["shape-approximated"; 2], 0));
        let texts: Vec<String> = found.notices.iter().map(|notice| Units::Si.sentence(&notice.message)).collect();
        assert!(texts[0].contains("is t-distributed") && texts[1].contains("is given by measured values"), "{texts:?}");
    }

    #[test]
    fn values_beyond_the_normal_distribution_are_told() {
        let told = |values: &str| {
            let found = of("", "1600", "10", &format!("{{ values = [{values}] }}"));
            (found.notices[0].code, Units::Si.sentence(&found.notices[0].message))
        };
        let (code, text) = told("0.05, 0.05, 0.05, 0.05, 0.3");
        assert_eq!(code, "values-left-out");
        assert!(text.ends_with("which leaves 1 of the 5 values out of its 95 %: reconstruct once with each"), "{text}");
        assert_eq!(told("0.05, 0.05, 0.06, 0.3").0, "shape-approximated");
    }

    #[test]
    fn an_infinite_standard_deviation_is_refused() {
        let found = of("", "{ mean = 1600, sd = 30, n = 3 }", "{ mean = 10, sd = 1, n = 4 }", "{ mean = 0.1, sd = 0.01, n = 2 }");
        let refused: Vec<(&str, &str)> = found.issues.iter().map(|issue| (issue.code, issue.path.as_str())).collect();
        assert_eq!(refused, [("infinite-deviation", "vehicle.1.mass"), ("infinite-deviation", "contact.restitution")]);
        let said = |part: &crate::message::Message| Units::Si.sentence(part);
        assert_eq!(
            said(&found.issues[0].message),
            "vehicle.1.mass is the mean of 3 measurements, whose distribution has an infinite standard deviation; `reconstruct` needs a finite one"
        );
        assert!(
            found.issues[0]
                .help
                .as_ref()
                .is_some_and(|help| said(help).starts_with("measure at least 4 times, or give `value` and an `sd`"))
        );
        assert_eq!(found.unknowns.len(), 1);
    }

    #[test]
    fn correlations_are_those_of_priors() {
        let [mass, e] = ["\"1600 kg ± 50 kg\"", "\"0.1 ± 0.05\""];
        let found = of("correlation = [[\"e\", \"m1\", -0.5]]", mass, "10", e);
        assert_eq!(found.correlations, [PriorCorrelation { one: E, other: MASS, coefficient: -0.5 }]);
        assert!(found.notices.is_empty());
        let found = of("correlation = [[\"e\", \"m1\", -0.5]]", mass, "10", "{ min = 0, max = 0.3 }");
        assert_eq!((found.correlations.len(), codes(&found)), (1, vec!["shape-approximated"]));
    }

    /// No direction is more likely than another, so that none is the mean.
    #[test]
    fn a_heading_of_any_direction_has_no_prior() {
        let of = |limit: f64| {
            let distribution = Distribution::Uniform { min: -limit, max: limit };
            let input = UncertainInput {
                parameter: Parameter::Input(Input::Heading(Side::One)),
                key: "vehicle.1.heading".to_owned(),
                nominal: 0.0,
                distribution,
                values: None,
                is_for_95: false,
            };
            let unknown = unknown(Variable::Input(Input::Heading(Side::One)), &input);
            (unknown.prior.is_some(), unknown.min, approximated(&input))
        };
        assert_eq!(of(0.5), (true, Some(-0.5), Some("uniform")));
        assert_eq!(of(PI), (false, Some(-PI), None));
    }
}
