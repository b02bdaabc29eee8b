//! Uncertain inputs of a case file, and their correlations.

use std::sync::Arc;

use planar_impact::Distribution;

use super::Case;
use super::parameter::Parameter;
use crate::notice::Notice;

/// Maximum number of measured values of one input.
pub(crate) const MOST_VALUES: usize = 1_000_000;

/// An input that the file gives with an uncertainty.
#[derive(Clone, Debug, PartialEq)]
pub struct UncertainInput {
    /// The input.
    pub parameter: Parameter,
    /// Its path in the file, such as `vehicle.1.impact_center.2`.
    pub key: String,
    /// The value that a computation with one number uses, in SI. The inputs of the case have it.
    pub nominal: f64,
    /// Its distribution, in SI. For an input with [values](Self::values) it is the normal one with their mean and standard deviation.
    pub distribution: Distribution,
    /// Measured values in SI, each of which is equally likely; `None` for an input that has its distribution.
    pub values: Option<Arc<[f64]>>,
    /// `true` if its standard deviation is widened so that 1.96 of it are the 95 % of Student's distribution: other levels are not in proportion.
    pub is_for_95: bool,
}

impl UncertainInput {
    /// Returns `true` if few measurements or tests tell it, so that a normal distribution has its 95 % at most.
    pub fn has_tails(&self) -> bool {
        self.is_for_95 || matches!(self.distribution, Distribution::StudentT { .. })
    }
}

/// The coefficient of correlation of two uncertain inputs.
#[derive(Clone, Debug, PartialEq)]
pub struct InputCorrelation {
    /// One input.
    pub one: Parameter,
    /// The other.
    pub other: Parameter,
    /// The coefficient, between −1 and 1.
    pub coefficient: f64,
    /// Its path in the file, such as `correlation.2`.
    pub key: String,
}

/// Uncertain inputs of a case file, in the order in which they are read.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Uncertain {
    /// The inputs.
    pub inputs: Vec<UncertainInput>,
    /// Their correlations.
    pub correlations: Vec<InputCorrelation>,
}

impl Uncertain {
    /// Returns an uncertain input, or `None` if the file gives a plain value.
    pub fn of(&self, parameter: Parameter) -> Option<&UncertainInput> {
        self.inputs.iter().find(|input| input.parameter == parameter)
    }

    /// Returns the coefficient of correlation of two inputs: 1 of an input with itself, and 0 where the file gives none.
    pub fn correlation(&self, one: Parameter, other: Parameter) -> f64 {
        if one == other {
            return 1.0;
        }
        let is_pair = |pair: &&InputCorrelation| [(pair.one, pair.other), (pair.other, pair.one)].contains(&(one, other));
        self.correlations.iter().find(is_pair).map_or(0.0, |pair| pair.coefficient)
    }

    /// Returns the pairs that no inputs can have together, the strongest correlation first; empty if the matrix of correlations is positive definite.
    ///
    /// They are those of a set of inputs none of which can be left out: without any one of them the others have a positive definite matrix.
    pub(super) fn impossible_pairs(&self) -> Vec<&InputCorrelation> {
        let mut inputs: Vec<Parameter> = self.inputs.iter().map(|input| input.parameter).collect();
        inputs.push(Parameter::RestFriction);
        let Some(last) = self.first_dependent(&inputs) else { return Vec::new() };
        // The leading block that fails, from which every input goes that is not needed for that.
        let mut set = inputs[..=last].to_vec();
        let mut next = 0;
        while next < set.len() && set.len() <= MOST_REDUCED {
            let mut fewer = set.clone();
            fewer.remove(next);
            if self.first_dependent(&fewer).is_some() { set = fewer } else { next += 1 }
        }
        let is_in = |pair: &&InputCorrelation| pair.coefficient != 0.0 && [pair.one, pair.other].iter().all(|input| set.contains(input));
        let mut pairs: Vec<&InputCorrelation> = self.correlations.iter().filter(is_in).collect();
        pairs.sort_by(|a, b| b.coefficient.abs().total_cmp(&a.coefficient.abs()));
        pairs
    }

    /// Returns the place of the first input that leaves the matrix of it and those before it without a Cholesky factor.
    fn first_dependent(&self, inputs: &[Parameter]) -> Option<usize> {
        /// Smallest accepted square on the diagonal of the factor.
        const SINGULAR: f64 = 1e-9;
        let mut factor: Vec<Vec<f64>> = Vec::new();
        for (i, &one) in inputs.iter().enumerate() {
            let mut row: Vec<f64> = Vec::new();
            for k in 0..i {
                let known: f64 = row.iter().zip(&factor[k]).map(|(a, b)| a * b).sum();
                row.push((self.correlation(one, inputs[k]) - known) / factor[k][k]);
            }
            let square = 1.0 - row.iter().map(|entry| entry * entry).sum::<f64>();
            if square <= SINGULAR {
                return Some(i);
            }
            row.push(square.sqrt());
            factor.push(row);
        }
        None
    }
}

impl Case {
    /// Returns a note if uncertain frictions that may be of one road have no correlation: those of the skids and, in an answer that uses it, that of `[rest]`.
    pub fn independent_frictions(&self, uses_rest: bool) -> Option<Notice> {
        let mut all: Vec<Parameter> = self.uncertain.inputs.iter().map(|input| input.parameter).collect();
        all.retain(|parameter| parameter.is_friction_of_skid());
        let mut rests = self.rest.iter().flat_map(|rest| &rest.vehicles).flatten().filter_map(|rest| rest.evidence.as_ref());
        let has_rest = uses_rest && !all.is_empty() && rests.any(|evidence| evidence.friction_deviation > 0.0);
        all.extend(has_rest.then_some(Parameter::RestFriction));
        let mut pairs = all.iter().enumerate().flat_map(|(i, one)| all[i + 1..].iter().map(move |other| (*one, *other)));
        let whose = if has_rest { "the frictions of the skids and of [rest]" } else { "the frictions of the skids" };
        let message = format!("{whose} count as independent; of one road they are the same: give their `correlation`");
        let are_independent = pairs.any(|(one, other)| self.uncertain.correlation(one, other) == 0.0);
        are_independent.then(|| Notice::note("independent-frictions", "before", message))
    }
}

/// Maximum number of inputs of a set that is reduced: each of them takes a factor of the matrix of the others.
const MOST_REDUCED: usize = 64;

#[cfg(test)]
mod tests {
    use super::*;
    use planar_impact::{Input, Side};

    fn uncertain(pairs: &[(usize, usize, f64)]) -> Uncertain {
        let all = [Input::Mass(Side::One), Input::Mass(Side::Two), Input::Restitution, Input::CrushPlane, Input::YawInertia(Side::One)]
            .map(Parameter::Input);
        let input = |parameter| UncertainInput {
            parameter,
            key: String::new(),
            nominal: 1.0,
            distribution: Distribution::Normal { mean: 1.0, sd: 0.1 },
            values: None,
            is_for_95: false,
        };
        let pair =
            |&(i, k, coefficient): &(usize, usize, f64)| InputCorrelation { one: all[i], other: all[k], coefficient, key: String::new() };
        Uncertain { inputs: all.map(input).into(), correlations: pairs.iter().map(pair).collect() }
    }

    #[test]
    fn a_matrix_of_correlations_is_positive_definite_or_not() {
        let is_positive_definite = |pairs: &[(usize, usize, f64)]| uncertain(pairs).impossible_pairs().is_empty();
        // The determinant of a matrix with equal correlations r is (1 − r)² (1 + 2 r).
        for (r, is_definite) in [(0.0, true), (0.999, true), (-0.499, true), (-0.5, false), (-0.501, false), (-0.9, false)] {
            assert_eq!(is_positive_definite(&[(0, 1, r), (2, 0, r), (1, 2, r)]), is_definite, "{r}");
        }
        assert!(is_positive_definite(&[(0, 2, -0.999)]));
        // With two correlations of 0.8 the third is above 2·0.8² − 1 = 0.28.
        assert!(is_positive_definite(&[(0, 1, 0.8), (0, 2, 0.8), (1, 2, 0.281)]));
        assert!(!is_positive_definite(&[(0, 1, 0.8), (0, 2, 0.8), (1, 2, 0.279)]));
        assert!(!is_positive_definite(&[(0, 1, 0.8), (0, 2, 0.8)]));
    }

    #[test]
    fn impossible_correlations_are_those_of_the_smallest_set() {
        let offending = |pairs: &[(usize, usize, f64)]| -> Vec<f64> {
            uncertain(pairs).impossible_pairs().iter().map(|pair| pair.coefficient).collect()
        };
        // The first input goes with the fourth and the fifth, and has no part in the conflict of the others.
        let others = [(0, 3, 0.99), (0, 4, 0.1)];
        assert_eq!(offending(&[(1, 2, 0.7), (2, 3, -0.9), (1, 3, 0.8), others[0]])[0], -0.9);
        assert_eq!(offending(&[(1, 2, 0.7), (2, 4, -0.9), (1, 4, 0.8), others[1]]), [-0.9, 0.8, 0.7]);
        // A pair that is not given has none.
        assert_eq!(offending(&[(1, 2, 0.75), (2, 4, 0.8), (0, 3, 0.5)]), [0.8, 0.75]);
        assert_eq!(offending(&[(0, 1, 0.3), (1, 2, 0.3), (2, 3, 0.3), (3, 4, 0.3)]), [0.0; 0]);
        // Four inputs of which each three are possible: −1/3 is the least of four, −1/2 that of three.
        let four: Vec<(usize, usize, f64)> = (0..4).flat_map(|i| (i + 1..4).map(move |k| (i, k, -0.4))).collect();
        assert_eq!(offending(&four), [-0.4; 6]);
    }

    #[test]
    fn a_correlation_has_no_order() {
        let all = uncertain(&[(0, 1, 0.25)]);
        let [one, two, e] = [0, 1, 2].map(|i| all.inputs[i].parameter);
        assert_eq!(
            [all.correlation(one, two), all.correlation(two, one), all.correlation(one, e), all.correlation(e, e)],
            [0.25, 0.25, 0.0, 1.0]
        );
        assert_eq!((all.of(one).map(|input| input.parameter), uncertain(&[]).of(Parameter::Friction)), (Some(one), None));
    }

    /// Reads a case with a mass, a restitution and a depth as given; the others are certain.
    fn read(mass: &str, restitution: &str, depth: &str) -> crate::case::Case {
        let vehicle = |mass: &str, depth: &str| {
            format!(
                "[[vehicle]]\nmass = {mass}\nyaw_inertia = 1500\nheading = 0\nspeed = 10\nimpact_center = [2, 0]\n\
                 [vehicle.crush]\nwidth = 1.5\ndepths = [{depth}, 0.2]\nstiffness = {{ d0 = 90, d1 = 700 }}\n"
            )
        };
        let (one, two) = (vehicle(mass, "0.2"), vehicle("1000", depth));
        let text = format!("schema = 1\n{one}{two}[contact]\ncrush_plane = 0\nrestitution = {restitution}\n");
        crate::case::Case::parse(crate::source::Source::new("case.toml", text)).expect("a case")
    }

    #[test]
    fn each_form_has_its_distribution_and_its_nominal_value() {
        use Distribution::{Normal, Triangular, TruncatedNormal, Uniform};
        for (text, nominal, distribution) in [
            ("\"1600 kg ± 50 kg\"", 1600.0, Normal { mean: 1600.0, sd: 50.0 }),
            ("\"1600 ± 50 kg\"", 1600.0, Normal { mean: 1600.0, sd: 50.0 }),
            ("\"1.6 t +/- 5 %\"", 1600.0, Normal { mean: 1600.0, sd: 80.0 }),
            ("{ value = \"1600 kg\", sd = \"50 kg\" }", 1600.0, Normal { mean: 1600.0, sd: 50.0 }),
            ("{ value = \"1600 kg\", relative = \"5 %\" }", 1600.0, Normal { mean: 1600.0, sd: 80.0 }),
            ("{ min = \"1500 kg\", max = \"1.7 t\" }", 1600.0, Uniform { min: 1500.0, max: 1700.0 }),
            ("{ min = 1500, mode = 1550, max = 1700 }", 1550.0, Triangular { min: 1500.0, mode: 1550.0, max: 1700.0 }),
            (
                "{ value = 1600, sd = 50, min = 1500, max = 1800 }",
                1600.0,
                TruncatedNormal { mode: 1600.0, scale: 50.0, min: 1500.0, max: 1800.0 },
            ),
            ("{ median = 1600, factor = 1.1 }", 1600.0, Distribution::of_factor(1600.0, 1.1)),
            ("{ mean = \"1.6 t\", sd = 50, n = 3 }", 1600.0, Distribution::StudentT { mean: 1600.0, sd: 50.0, n: 3 }),
            ("{ value = 1600, resolution = 20 }", 1600.0, Uniform { min: 1590.0, max: 1610.0 }),
        ] {
            let case = read(text, "0.1", "0.2");
            let parameter = Parameter::Input(Input::Mass(Side::One));
            let input =
                UncertainInput { parameter, key: "vehicle.1.mass".to_owned(), nominal, distribution, values: None, is_for_95: false };
            assert_eq!(case.uncertain.inputs, [input], "{text}");
            assert_eq!(case.inputs.value(parameter), Ok(nominal), "{text}");
        }
        let Distribution::LogNormal { log_sd, .. } = Distribution::of_factor(1.0, 1.1) else { panic!("a log-normal distribution") };
        assert!((log_sd - 0.095_310_179_804_324_87).abs() < 1e-16); // ln 1.1
    }

    #[test]
    fn an_input_without_a_deviation_is_certain() {
        for text in ["1600", "\"1600 kg ± 0 kg\"", "\"1600 kg ± 0 %\"", "{ value = 1600, sd = 0 }", "{ value = 1600, resolution = 0 }"] {
            assert_eq!(read(text, "0.1", "0.2").uncertain, Uncertain::default(), "{text}");
        }
    }

    #[test]
    fn an_uncertain_input_has_its_path_in_the_file() {
        let case = read("1600", "\"10 % ± 2 %\"", "\"0.3 m ± 1 cm\"");
        let paths: Vec<(String, &str, f64)> =
            case.uncertain.inputs.iter().map(|input| (input.parameter.to_string(), input.key.as_str(), input.distribution.sd())).collect();
        assert_eq!(
            paths,
            [
                ("vehicle.2.crush.depths.1".to_owned(), "vehicle.2.crush.depths.1", 0.01),
                ("contact.restitution".to_owned(), "contact.restitution", 0.02),
            ]
        );
    }
}
