//! The uncertainty of outputs as CSV, a figure in each row, in the reader's units.

use planar_impact_app::uncertainty::{OutputUncertainty, Uncertainty};
use planar_impact_app::units::Units;

use super::sweep_csv::digits;

/// Returns the records: a header, the figures of each output, then the probabilities.
pub fn records(answer: &Uncertainty, units: Units) -> Vec<Vec<String>> {
    let mut rows = vec![["name", "unit", "method", "figure", "value", "standard error"].map(str::to_owned).into()];
    for (of, (name, found)) in answer.outputs.iter().zip(answer.of.iter()) {
        figures(found, &mut |method, figure, value, error, has_unit| {
            let convert = |si: f64| if has_unit { units.convert(of.measure(), si) } else { si };
            let unit = if has_unit { units.unit(of.measure()) } else { "" };
            rows.push(vec![
                name.to_owned(),
                unit.to_owned(),
                method.to_owned(),
                figure.to_owned(),
                digits(convert(value)),
                digits(convert(error)),
            ]);
        });
    }
    for (text, found) in answer.probabilities.iter() {
        let words = [text, "", "monte-carlo", "probability"].map(str::to_owned);
        rows.push(words.into_iter().chain([digits(found.value), digits(found.se)]).collect());
    }
    rows
}

/// Calls a function with each figure: method, name, value, standard error, and whether it has the unit of the output.
fn figures(found: &OutputUncertainty, row: &mut impl FnMut(&str, &str, f64, f64, bool)) {
    const NONE: f64 = f64::NAN;
    row("nominal", "value", found.value, NONE, true);
    if let Some(linear) = &found.linear {
        row("linear", "mean", linear.mean, NONE, true);
        row("linear", "sd", linear.sd, NONE, true);
        linear.shares.iter().for_each(|(input, share)| row("linear", &format!("share of {input}"), *share, NONE, false));
        linear.sd_if_halved.iter().for_each(|(input, sd)| row("linear", &format!("sd with half of {input}"), *sd, NONE, true));
    }
    if let Some(second) = &found.second_order {
        row("second-order", "mean", second.mean, NONE, true);
        row("second-order", "sd", second.sd, NONE, true);
        row("second-order", "skewness", second.skewness, NONE, false);
    }
    if let Some(samples) = &found.monte_carlo {
        row("monte-carlo", "mean", samples.mean, samples.mean_se, true);
        row("monte-carlo", "sd", samples.sd, samples.sd_se, true);
        row("monte-carlo", "skewness", samples.skewness, NONE, false);
        for ((p, quantile), (_, error)) in samples.quantiles.iter().zip(samples.quantiles_se.iter()) {
            row("monte-carlo", &format!("quantile {p}"), *quantile, *error, true);
        }
    }
    for (input, share) in found.sobol.iter().flat_map(|shares| shares.iter()) {
        row("sobol", &format!("first of {input}"), share.first, share.first_se, false);
        row("sobol", &format!("total of {input}"), share.total, share.total_se, false);
    }
    for (input, share) in found.shapley.iter().flat_map(|effects| effects.iter()) {
        row("shapley", &format!("effect of {input}"), share.effect, share.se, false);
    }
    if let Some(bounds) = &found.bounds {
        row("bounds", "low", bounds.low, NONE, true);
        row("bounds", "high", bounds.high, NONE, true);
        row("bounds", "low attained", bounds.low_attained, NONE, true);
        row("bounds", "high attained", bounds.high_attained, NONE, true);
    }
}
