//! The answer of `uncertainty`.

use schemars::JsonSchema;
use serde::Serialize;

use crate::case::{CaseOutput, Parameter};
use crate::named::Named;

/// Outputs with their uncertainty, in SI and radians.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Uncertainty {
    /// The samples drawn, refused ones included: those of `monte-carlo` and of probabilities, or without these the ones of `sobol` and `shapley`; 0 if no
    /// method draws any.
    pub samples: u64,
    /// The seed of the samples.
    pub seed: u64,
    /// The samples that physics refuses: all figures of samples are of the others.
    pub refused: RefusedSamples,
    /// The uncertain inputs.
    pub inputs: Named<UncertainNumber>,
    /// Each output with what the methods say of it.
    pub of: Named<OutputUncertainty>,
    /// The probability of each statement, as it is written.
    pub probabilities: Named<Probability>,
    /// The outputs, in the order of `of`.
    #[serde(skip)]
    pub outputs: Vec<CaseOutput>,
    /// The uncertain inputs, in the order of `inputs`.
    #[serde(skip)]
    pub parameters: Vec<Parameter>,
    /// The level of the middle range that the text shows.
    #[serde(skip)]
    pub level: f64,
}

/// Samples that physics refuses.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct RefusedSamples {
    /// Their number.
    pub count: u64,
    /// How many have each code of a refusal; a sample may have several.
    pub reasons: Named<u64>,
}

/// An uncertain input.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct UncertainNumber {
    /// The value that a verb with one number uses.
    pub value: f64,
    /// The mean of its distribution; `null` if it has none.
    #[schemars(with = "Option<f64>")]
    pub mean: f64,
    /// The standard deviation of its distribution; `null` if it has none, or an infinite one.
    #[schemars(with = "Option<f64>")]
    pub sd: f64,
    /// The least and the greatest value that `bounds` takes; `null` where there is none.
    #[schemars(with = "[Option<f64>; 2]")]
    pub range: [f64; 2],
}

/// An output with what the methods say of it; those that were not asked for, or do not apply, are absent.
#[derive(Clone, Debug, Default, PartialEq, Serialize, JsonSchema)]
pub struct OutputUncertainty {
    /// Its value at the nominal inputs; `null` if physics refuses them.
    #[schemars(with = "Option<f64>")]
    pub value: f64,
    /// From first derivatives at the means of the inputs.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub linear: Option<Linear>,
    /// From first and second derivatives at the means of the inputs.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub second_order: Option<SecondOrder>,
    /// From samples.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub monte_carlo: Option<MonteCarlo>,
    /// The share of each input in the variance, from samples: indices of Sobol'.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sobol: Option<Named<Share>>,
    /// The part of each input in the variance, from samples: Shapley effects.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shapley: Option<Named<ShapleyEffect>>,
    /// The guaranteed range over all inputs within their limits.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bounds: Option<Bounds>,
}

/// An output to first order.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Linear {
    /// The output at the means.
    pub mean: f64,
    /// Its standard deviation; `null` if an input has an infinite one.
    #[schemars(with = "Option<f64>")]
    pub sd: f64,
    /// The share of each input in the variance. With correlations a share may be negative; `null` if nothing matters.
    #[schemars(with = "Named<Option<f64>>")]
    pub shares: Named<f64>,
    /// The change of the output where an input increases by its standard deviation; `null` if it has an infinite one.
    #[schemars(with = "Named<Option<f64>>")]
    pub effects: Named<f64>,
    /// The standard deviation that would be left if one input had half its own.
    #[schemars(with = "Named<Option<f64>>")]
    pub sd_if_halved: Named<f64>,
}

/// An output to second order.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct SecondOrder {
    /// The mean.
    #[schemars(with = "Option<f64>")]
    pub mean: f64,
    /// The standard deviation; `null` if there is none.
    #[schemars(with = "Option<f64>")]
    pub sd: f64,
    /// The third central moment over the cube of the standard deviation; `null` if there is none.
    #[schemars(with = "Option<f64>")]
    pub skewness: f64,
}

/// An output of samples, each figure with its standard error (`se`).
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct MonteCarlo {
    /// The mean.
    #[schemars(with = "Option<f64>")]
    pub mean: f64,
    /// Its standard error.
    #[schemars(with = "Option<f64>")]
    pub mean_se: f64,
    /// The standard deviation.
    #[schemars(with = "Option<f64>")]
    pub sd: f64,
    /// Its standard error.
    #[schemars(with = "Option<f64>")]
    pub sd_se: f64,
    /// The third central moment over the cube of the standard deviation; `null` for an output that is certain.
    #[schemars(with = "Option<f64>")]
    pub skewness: f64,
    /// Quantiles by their probabilities.
    #[schemars(with = "Named<Option<f64>>")]
    pub quantiles: Named<f64>,
    /// Their standard errors; `null` where less than one sample is expected beyond a quantile.
    #[schemars(with = "Named<Option<f64>>")]
    pub quantiles_se: Named<f64>,
    /// The density.
    pub density: Density,
}

/// The share of the samples in bins of equal width.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Density {
    /// Edges of the bins, one more than bins, between the quantiles of 0.1 % and 99.9 %.
    #[schemars(with = "Vec<Option<f64>>")]
    pub edges: Vec<f64>,
    /// The share of the samples in each.
    #[schemars(with = "Vec<Option<f64>>")]
    pub shares: Vec<f64>,
}

/// The share of an input in the variance of an output.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Share {
    /// Alone: the part of the variance that would go if it were known.
    #[schemars(with = "Option<f64>")]
    pub first: f64,
    /// Its standard error.
    #[schemars(with = "Option<f64>")]
    pub first_se: f64,
    /// With all others: the part that would be left if all others were known.
    #[schemars(with = "Option<f64>")]
    pub total: f64,
    /// Its standard error.
    #[schemars(with = "Option<f64>")]
    pub total_se: f64,
    /// What `total` is at most, from derivatives at samples; `null` for a distribution without such a limit.
    pub total_at_most: Option<f64>,
}

/// The Shapley effect of an input on an output: its part of the variance, in which what inputs share by correlation or interaction is divided evenly. The effects
/// of an output add up to 1; `null` for an output that is certain.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct ShapleyEffect {
    /// The effect.
    #[schemars(with = "Option<f64>")]
    pub effect: f64,
    /// Its standard error.
    #[schemars(with = "Option<f64>")]
    pub se: f64,
}

/// The guaranteed range of an output: `low` is at most its least value, and that at most `low_attained`; the same for the greatest.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Bounds {
    /// No value is less; `null` if nothing is proven.
    #[schemars(with = "Option<f64>")]
    pub low: f64,
    /// No value is greater; `null` if nothing is proven.
    #[schemars(with = "Option<f64>")]
    pub high: f64,
    /// The least value found.
    pub low_attained: f64,
    /// The greatest value found.
    pub high_attained: f64,
    /// The inputs at which the least value is found.
    pub at_low: Named<f64>,
    /// The inputs at which the greatest value is found.
    pub at_high: Named<f64>,
    /// Whether the values found are within the requested gap of the ends; if not, nothing tighter is proven.
    pub is_tight: bool,
    /// Whether it is proven that physics refuses nothing within the limits. If not, the range is that of what it accepts.
    pub is_whole: bool,
}

/// The probability of a statement.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Probability {
    /// The probability.
    #[schemars(with = "Option<f64>")]
    pub value: f64,
    /// Its standard error.
    #[schemars(with = "Option<f64>")]
    pub se: f64,
}
