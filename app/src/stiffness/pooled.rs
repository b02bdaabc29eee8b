//! The stiffness of a class of vehicles, from that of each.

use planar_impact::Distribution;
use planar_impact::barrier::{CrushModel, Estimate, RandomEffects, StiffnessCovariance, StiffnessFit};
use schemars::JsonSchema;
use serde::Serialize;

use super::model_name;
use crate::message::Message;
use crate::named::positive_zero;
use crate::units::Measure;

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
    /// The fit to the tests of each vehicle alone, with its covariance; zero if it is not known.
    #[serde(skip)]
    own: Vec<StiffnessFit>,
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
    /// Standard deviation of the mean: 95 % of classes have theirs within 1.96 of it, however few vehicles tell the spread.
    pub mean_sd: f64,
    /// Standard deviation between the vehicles of the class.
    pub between_sd: f64,
    /// Standard deviation of a further vehicle of the class about the mean, which is itself uncertain: 95 % of such vehicles lie within 1.96 of it.
    pub further_sd: f64,
}

/// A vehicle with the fit to its own tests.
pub(super) struct OwnFit {
    pub name: String,
    pub fit: StiffnessFit,
    /// `true` if the covariance of the fit is known.
    pub is_uncertain: bool,
}

/// The stiffness of a vehicle that is none of those tested.
pub(crate) struct FurtherVehicle {
    /// With its covariance.
    pub fit: StiffnessFit,
    /// The part of the covariance that all further vehicles of the class share: that of the line through all tests. By the rest each differs by itself.
    pub common: StiffnessCovariance,
}

impl OwnFit {
    fn estimate(&self, of: fn(&StiffnessFit) -> Estimate) -> Estimate {
        let Estimate { value, variance } = of(&self.fit);
        Estimate { value, variance: if self.is_uncertain { variance } else { 0.0 } }
    }

    fn with_known_covariance(&self) -> StiffnessFit {
        let mut fit = self.fit.clone();
        if !self.is_uncertain {
            fit.covariance = StiffnessCovariance { onset: 0.0, between: 0.0, slope: 0.0 };
        }
        fit
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
        let own = own.iter().map(OwnFit::with_known_covariance).collect();
        Some(Pooled { model: model_name(model), vehicles, d0: PooledNumber::of(&d0)?, d1: PooledNumber::of(&d1)?, own })
    }

    /// Returns `true` if a further vehicle by the line through all tests is none of the class by its mean, beyond three standard deviations: an onset that is assumed
    /// is not that of the line, or no line holds for these vehicles.
    pub(crate) fn is_far_from(&self, further: &StiffnessFit) -> bool {
        [(further.onset(), &self.d0), (further.slope(), &self.d1)].into_iter().any(|(of_line, of_class)| {
            let variance = of_line.variance + of_class.further_sd * of_class.further_sd;
            (of_line.value - of_class.mean).abs() > 3.0 * variance.sqrt()
        })
    }

    /// Says that the class is far from the line.
    pub(crate) fn contradiction(&self) -> Message {
        Message::from("far from the mean of the vehicles, each by itself, d0 = ")
            .figure(Measure::RootForce, self.d0.mean)
            .text(" and d1 = ")
            .figure(Measure::RootForcePerLength, self.d1.mean)
            .text(": the assumed onset is not that of the line, or no one line holds for all; give the stiffness of each, or that of the class")
    }

    /// Returns a fit to all tests as the stiffness of a further vehicle of the class, which differs from it as the tested ones do from each other.
    ///
    /// The spread V between vehicles moves the line through all tests, of covariance C, by C Σ I V I C, with the information I of the tests of each vehicle: more
    /// than V/k where they were tested to different depths.
    pub(crate) fn further_vehicle(&self, mut fit: StiffnessFit) -> FurtherVehicle {
        let (all, count) = (fit.covariance, self.own.len() as f64);
        let Some([onset, slope]) = self.spread(&all) else { return FurtherVehicle { fit, common: all } };
        let informations: Option<Vec<StiffnessCovariance>> = self.own.iter().map(|own| inverse(&own.covariance)).collect();
        let spread = StiffnessCovariance { onset, between: 0.0, slope };
        let common = match informations.filter(|_| inverse(&all).is_some()) {
            Some(informations) => informations.iter().map(|each| around(&all, &around(each, &spread))).fold(all, sum),
            // Of tests that do not tell the covariance, or with one coefficient held, each vehicle counts as much as the others.
            None => sum(all, StiffnessCovariance { onset: onset / count, slope: slope / count, ..spread }),
        };
        fit.covariance = sum(common, spread);
        FurtherVehicle { fit, common }
    }

    /// Returns the variances between vehicles of d₀ and d₁, as large as they may be. Each by itself may vanish by chance, since the errors of both are large and
    /// opposite: at the depth where the line through all tests is known best, E* spreads at least as the E* of each vehicle there.
    fn spread(&self, all: &StiffnessCovariance) -> Option<[f64; 2]> {
        let between = |of: &dyn Fn(&StiffnessFit) -> Estimate| {
            RandomEffects::of_further(&self.own.iter().map(of).collect::<Vec<_>>()).map(|class| class.between)
        };
        let [onset, slope] = [between(&StiffnessFit::onset)?, between(&StiffnessFit::slope)?];
        let depth = -all.between / all.slope;
        if !(depth > 0.0 && depth.is_finite()) {
            return Some([onset, slope]);
        }
        let missing = (between(&|own| own.intensity_at(depth))? - onset - depth * depth * slope).max(0.0);
        Some([onset + missing / 2.0, slope + missing / (2.0 * depth * depth)])
    }
}

/// Returns the inverse of a covariance; `None` of a singular one.
fn inverse(of: &StiffnessCovariance) -> Option<StiffnessCovariance> {
    let determinant = of.onset * of.slope - of.between * of.between;
    let is_regular = determinant > 1e-12 * of.onset * of.slope;
    is_regular.then(|| StiffnessCovariance {
        onset: of.slope / determinant,
        between: -of.between / determinant,
        slope: of.onset / determinant,
    })
}

/// Returns A S A.
fn around(a: &StiffnessCovariance, s: &StiffnessCovariance) -> StiffnessCovariance {
    let rows = [[a.onset, a.between], [a.between, a.slope]];
    let entry = |[one, other]: [usize; 2]| {
        let by = |place: usize| rows[one][0] * [s.onset, s.between][place] + rows[one][1] * [s.between, s.slope][place];
        by(0) * rows[0][other] + by(1) * rows[1][other]
    };
    StiffnessCovariance { onset: entry([0, 0]), between: entry([0, 1]), slope: entry([1, 1]) }
}

fn sum(one: StiffnessCovariance, other: StiffnessCovariance) -> StiffnessCovariance {
    StiffnessCovariance { onset: one.onset + other.onset, between: one.between + other.between, slope: one.slope + other.slope }
}

impl PooledNumber {
    fn of(vehicles: &[Estimate]) -> Option<PooledNumber> {
        let (class, further) = (RandomEffects::of(vehicles)?, RandomEffects::of_further(vehicles)?);
        Some(PooledNumber {
            mean: positive_zero(class.mean.value),
            mean_sd: further.mean.deviation(),
            between_sd: class.deviation_between(),
            further_sd: (further.between + further.mean.variance).sqrt(),
        })
    }
}

/// Returns t/z, the 95 % interval of Student's distribution of `count` − 1 degrees of freedom in those of the normal one.
pub(crate) fn wider_than_normal(count: u32) -> f64 {
    let upper = |distribution: Distribution| distribution.quantile(0.975);
    let z = upper(Distribution::Normal { mean: 0.0, sd: 1.0 });
    upper(Distribution::StudentT { mean: 0.0, sd: f64::from(count).sqrt(), n: count }) / z
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_covariance_that_is_singular_by_rounding_has_no_inverse() {
        let of = |between: f64| inverse(&StiffnessCovariance { onset: 4e6, between, slope: 9e6 });
        for share in [1.0, 1.0 - 1e-14] {
            assert_eq!(of(-6e6 * share), None);
        }
        let found = of(-3e6).expect("a correlation of a half");
        let determinant = 4e6 * 9e6 - 9e12;
        assert_eq!(found, StiffnessCovariance { onset: 9e6 / determinant, between: 3e6 / determinant, slope: 4e6 / determinant });
        assert!(of(-6e6 * (1.0 - 1e-9)).is_some());
    }
}
