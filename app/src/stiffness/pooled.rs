//! The stiffness of a class of vehicles, from that of each.

use planar_impact::Distribution;
use planar_impact::barrier::{CrushModel, Estimate, RandomEffects, StiffnessFit};
use schemars::JsonSchema;
use serde::Serialize;

use super::model_name;
use crate::named::positive_zero;

/// The stiffness of a class: its mean over the vehicles, and how much they differ.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Pooled {
    /// Representation of the crush: `mean depth` or `profile`.
    pub model: &'static str,
    /// The stiffness of each vehicle.
    pub vehicles: Vec<OfVehicle>,
    /// d0 of the class in √N.
    pub d0: PooledNumber,
    /// d1 of the class in √N/m.
    pub d1: PooledNumber,
}

/// The stiffness of one vehicle of a class.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct OfVehicle {
    /// Its name.
    pub name: String,
    /// d0 in √N.
    pub d0: f64,
    /// Its standard deviation in √N; 0 where the tests do not give it, or d0 is held.
    pub d0_sd: f64,
    /// d1 in √N/m.
    pub d1: f64,
    /// Its standard deviation in √N/m; 0 where the tests do not give it.
    pub d1_sd: f64,
}

/// A number of a class of vehicles, in the unit of the number, by the random-effects model of Paule and Mandel (1982).
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct PooledNumber {
    /// Mean over the class.
    pub mean: f64,
    /// Standard deviation of the mean.
    pub mean_sd: f64,
    /// Standard deviation between the vehicles of the class.
    pub between_sd: f64,
    /// Standard deviation of a further vehicle of the class about the mean: 95 % of such vehicles lie within 1.96 of it, however few vehicles tell the spread.
    pub further_sd: f64,
}

/// A vehicle with the fit to its own tests.
pub(super) struct OwnFit {
    pub name: String,
    pub fit: StiffnessFit,
    /// `true` if the covariance of the fit is known.
    pub is_uncertain: bool,
}

impl OwnFit {
    fn estimate(&self, of: fn(&StiffnessFit) -> Estimate) -> Estimate {
        let Estimate { value, variance } = of(&self.fit);
        Estimate { value, variance: if self.is_uncertain { variance } else { 0.0 } }
    }
}

impl Pooled {
    /// Pools the stiffness of two or more vehicles; `None` for fewer.
    pub(super) fn of(model: CrushModel, own: &[OwnFit]) -> Option<Pooled> {
        let numbers = |of: fn(&StiffnessFit) -> Estimate| own.iter().map(|own| own.estimate(of)).collect::<Vec<_>>();
        let (d0, d1) = (numbers(StiffnessFit::onset), numbers(StiffnessFit::slope));
        let vehicle = |((own, d0), d1): ((&OwnFit, &Estimate), &Estimate)| OfVehicle {
            name: own.name.clone(),
            d0: positive_zero(d0.value),
            d0_sd: d0.deviation(),
            d1: positive_zero(d1.value),
            d1_sd: d1.deviation(),
        };
        let vehicles = own.iter().zip(&d0).zip(&d1).map(vehicle).collect();
        Some(Pooled { model: model_name(model), vehicles, d0: PooledNumber::of(&d0)?, d1: PooledNumber::of(&d1)? })
    }

    /// Returns a fit to all tests as the stiffness of a further vehicle of the class, which differs from it as the tested ones do from each other.
    pub(crate) fn further_vehicle(&self, mut fit: StiffnessFit) -> StiffnessFit {
        let squared = |number: &PooledNumber| number.further_sd * number.further_sd;
        fit.covariance.onset += squared(&self.d0);
        fit.covariance.slope += squared(&self.d1);
        fit
    }
}

impl PooledNumber {
    fn of(vehicles: &[Estimate]) -> Option<PooledNumber> {
        let class = RandomEffects::of(vehicles)?;
        Some(PooledNumber {
            mean: positive_zero(class.mean.value),
            mean_sd: class.mean.deviation(),
            between_sd: class.deviation_between(),
            further_sd: deviation_of_further(vehicles)?,
        })
    }
}

/// Returns the standard deviation of a further vehicle about the mean of a class, which is that of the normal distribution with its 95 % interval.
///
/// With k vehicles that are known exactly the interval is x̄ ± t s √(1 + 1/k), with the quantile t of Student's distribution of k − 1 degrees of freedom. It is
/// x̄ ± z τ √(1 + 1/k) with the variance τ² at which the sum of squares is (k − 1) (z/t)², and so it is for vehicles with an error of their own: an estimate of
/// τ², which is 0 by chance for half of the classes of two, would be too small.
fn deviation_of_further(vehicles: &[Estimate]) -> Option<f64> {
    let count = u32::try_from(vehicles.len()).ok()?;
    let upper = |distribution: Distribution| distribution.quantile(0.975);
    let z = upper(Distribution::Normal { mean: 0.0, sd: 1.0 });
    let t = upper(Distribution::StudentT { mean: 0.0, sd: f64::from(count).sqrt(), n: count });
    let between = RandomEffects::between_at(vehicles, f64::from(count - 1) * (z / t).powi(2))?;
    Some((between * (1.0 + 1.0 / f64::from(count))).sqrt())
}
