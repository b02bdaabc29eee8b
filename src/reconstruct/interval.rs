//! Intervals by profile likelihood (Venzon and Moolgavkar 1988).
//!
//! The interval of a quantity is the range over which the best fit of everything else, within all bounds and the limits of the physics, stays within a quantile
//! of χ² of the least one.

use super::branches::Region;
use super::given::ReconstructionProblem;
use super::limit::Limit;
use super::measurand::Measurand;
use super::outwards::{End, Quantity};
use super::profile::Profile;
use super::residuals::Model;
use super::search::spans;
use super::verdict::Answer;
use crate::input::Side;
use crate::output::Output;

/// The method that found an interval.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Method {
    /// The profile of the likelihood.
    Profile,
}

/// The range of a quantity that the evidence, the bounds and the physics allow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// Its quantity.
    pub of: Measurand,
    /// Its value at the best solution, in SI.
    pub value: f64,
    /// Its standard deviation from those of the unknowns; `None` where one of them has none.
    pub sd: Option<f64>,
    /// Its lower end, in SI; −∞ if nothing limits it. An angle is not wrapped: its ends enclose the value.
    pub low: f64,
    /// Its upper end, in SI; ∞ if nothing limits it.
    pub high: f64,
    /// The probability with which such intervals contain the true value.
    pub level: f64,
    /// The method that found it.
    pub method: Method,
    /// A bound or a limit of the physics that makes the lower end; `None` if the evidence alone does.
    pub low_limited_by: Option<Limit>,
    /// A bound or a limit of the physics that makes the upper end.
    pub high_limited_by: Option<Limit>,
    /// `true` if it is narrower than the range that the bounds of the unknown alone allow, or than a whole turn.
    pub narrows: bool,
}

impl Method {
    /// Returns its name.
    pub fn name(self) -> &'static str {
        match self {
            Method::Profile => "profile",
        }
    }
}

impl ReconstructionProblem {
    /// Returns the intervals of quantities at a level of confidence, such as 0.95, around the solutions of an answer to this problem. A quantity that the
    /// unknowns do not determine is left out.
    ///
    /// ```
    /// use planar_impact::reconstruct::*;
    /// use planar_impact::*;
    ///
    /// let car = Vehicle::new(1500.0, 2500.0).with_impact_center(2.0, 0.3).with_speed(13.0);
    /// let collision = Collision::new(car, Party::Barrier).with_restitution(0.1);
    /// let after = collision.solve()?.one;
    /// // A speed from a change of velocity and a yaw rate, with a restitution of which only the range is known.
    /// let problem = ReconstructionProblem::of(collision)
    ///     .unknown(Variable::Speed(Side::One), 15.0)
    ///     .between(Variable::Input(Input::Restitution), 0.1, 0.0, 0.3)
    ///     .evidence(Measurand::DeltaVForward(Side::One), after.delta_v_in_vehicle.forward, Uncertainty::StandardDeviation(0.5))
    ///     .evidence(Measurand::Output(Output::YawRate(Side::One)), after.after.yaw_rate, Uncertainty::StandardDeviation(0.2));
    /// let answer = problem.solve(&Search::default())?;
    /// let [speed] = problem.intervals(&answer, 0.95, &[Measurand::Variable(Variable::Speed(Side::One))])[..] else { panic!() };
    /// assert!(speed.low < 11.0 && speed.high > 14.3 && speed.method.name() == "profile");
    /// assert_eq!(speed.low_limited_by.map(Limit::name).as_deref(), Some("contact.restitution max"));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Panics
    ///
    /// If the level is not between 0 and 1.
    pub fn intervals(&self, answer: &Answer, level: f64, of: &[Measurand]) -> Vec<Interval> {
        self.intervals_while(answer, level, of, &|_, _| true).unwrap_or_default()
    }

    /// As [`ReconstructionProblem::intervals`], and calls a function before each step, with the number of steps that are done and of all. It stops the search by
    /// returning `false`: then there is none.
    ///
    /// # Panics
    ///
    /// If the level is not between 0 and 1.
    pub fn intervals_while(
        &self,
        answer: &Answer,
        level: f64,
        of: &[Measurand],
        goes_on: &dyn Fn(usize, usize) -> bool,
    ) -> Option<Vec<Interval>> {
        assert!(level > 0.0 && level < 1.0, "the level of an interval is between 0 and 1, and not {level}");
        let model = Model::of(self);
        let Some(profile) = Profile::of(&model, spans(self), answer, level) else { return Some(Vec::new()) };
        let of: Vec<Measurand> = of.iter().copied().filter(|of| self.determines(*of)).collect();
        // With the unknowns themselves, whose ends lie all around the region.
        let unknowns = self.unknowns.iter().map(|unknown| Measurand::Variable(unknown.of)).filter(|unknown| !of.contains(unknown));
        let quantities: Vec<Measurand> = of.iter().copied().chain(unknowns).collect();
        let steps = 2 * quantities.len();
        let mut all: Vec<(Quantity<'_>, [End; 2])> = Vec::new();
        for (done, of) in quantities.iter().enumerate() {
            if !goes_on(done, steps) {
                return None;
            }
            let Some(quantity) = Quantity::of(&profile, *of) else { continue };
            all.extend(quantity.around_solutions().map(|ends| (quantity, ends)));
        }
        extend_by_each_other(&mut all);
        let region = Region::of(&profile, all.iter().flat_map(|(_, ends)| ends));
        for (done, (quantity, ends)) in all.iter_mut().enumerate() {
            if !goes_on(quantities.len() + done, steps) {
                return None;
            }
            region.extend(quantity, ends);
            region.climb(quantity, ends);
        }
        extend_by_each_other(&mut all);
        let asked = all.iter().filter(|(quantity, _)| of.contains(&quantity.of));
        Some(asked.map(|(quantity, ends)| quantity.interval(ends, level)).collect())
    }

    /// Returns what is derived from the unknowns and asked for most: ΔV and principal direction of force of each vehicle, closing speed, energies, ratio, and
    /// where they are known, the equivalent energy speed of each vehicle and its speed when it began to brake. Momentum alone has no closing speed along the
    /// normal, no works and no ratio.
    pub fn derived(&self) -> impl Iterator<Item = Measurand> {
        let sides = [Side::One, Side::Two];
        let of_vehicles =
            [Side::One, Side::Two].into_iter().flat_map(|side| [Output::DeltaVMagnitude(side), Output::PrincipalDirectionOfForce(side)]);
        let speeds = sides.map(Measurand::EquivalentEnergySpeed).into_iter().chain(sides.map(Measurand::BrakingSpeed));
        let of_contact = [Output::Loss, Output::NormalWork, Output::TangentialWork, Output::ImpulseRatio];
        let outputs = of_vehicles.chain(of_contact).map(Measurand::Output);
        let all = [Measurand::ClosingSpeed].into_iter().chain(outputs).chain(speeds);
        all.filter(|of| self.determines(*of) && (!self.is_by_momentum() || !of.is_of_contact()))
    }
}

/// Widens intervals by the ends of others: each may show that another is wider.
fn extend_by_each_other(all: &mut [(Quantity<'_>, [End; 2])]) {
    const ROUNDS: usize = 3;
    for _ in 0..ROUNDS {
        let reached: Vec<Vec<f64>> = all.iter().flat_map(|(_, ends)| ends).map(|end| end.at.clone()).collect();
        for (quantity, ends) in &mut *all {
            reached.iter().for_each(|point| quantity.extend(ends, point));
        }
    }
}
