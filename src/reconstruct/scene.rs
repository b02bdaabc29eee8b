//! The collision for given unknowns, on any scalar.

use super::given::ReconstructionProblem;
use super::placed::Placed;
use super::variable::{Axis, Variable, party};
use crate::collision::Collision;
use crate::frame::Xy;
use crate::input::{Input, Side};
use crate::scalar::Real;
use crate::vehicle::Party;

/// Inserts values of the unknowns into the collision.
pub(super) struct Scene {
    base: Collision,
    variables: Vec<Variable>,
    /// The speed of a vehicle that drives along its heading, if it is known.
    speeds: [Option<f64>; 2],
    /// The square of the radius of gyration of a vehicle that keeps it.
    gyrations: [Option<f64>; 2],
    crush_share: f64,
    /// The skid speed of a vehicle, if it is known.
    skids: [Option<f64>; 2],
}

impl Scene {
    pub(super) fn of(question: &ReconstructionProblem) -> Self {
        let speed = |side| {
            let driven = question.drives_along_heading[side as usize];
            party(&question.collision, side).vehicle().filter(|_| driven).map(super::variable::speed)
        };
        let gyration = |side| {
            let is_solved_for = question.unknowns.iter().any(|unknown| unknown.of == Variable::Input(Input::YawInertia(side)));
            let kept = question.holds_radius_of_gyration[side as usize] && !is_solved_for;
            party(&question.collision, side).vehicle().filter(|_| kept).map(|vehicle| vehicle.yaw_inertia / vehicle.mass)
        };
        Scene {
            base: question.collision,
            variables: question.unknowns.iter().map(|unknown| unknown.of).collect(),
            speeds: [speed(Side::One), speed(Side::Two)],
            gyrations: [gyration(Side::One), gyration(Side::Two)],
            crush_share: question.crush_share.unwrap_or(0.5),
            skids: question.skid_speeds,
        }
    }

    /// Returns the collision for given values of the unknowns, in their order.
    pub(super) fn place<T: Real + Copy + From<f64>>(&self, values: &[T]) -> Placed<T> {
        let mut placed = Placed {
            collision: self.base.map(T::from),
            crush_share: T::from(self.crush_share),
            impulse: None,
            skids: self.skids.map(|speed| speed.map(T::from)),
            ratio_is_unknown: self.variables.contains(&Variable::Input(Input::ImpulseRatio)),
        };
        let mut speeds = self.speeds.map(|speed| speed.map(T::from));
        let mut gyrations = self.gyrations.map(|square| square.map(T::from));
        for (variable, &value) in self.variables.iter().zip(values) {
            match *variable {
                Variable::CrushShare => placed.crush_share = value,
                Variable::Impulse(Axis::X) => placed.impulse.get_or_insert_with(Xy::zero).x = value,
                Variable::Impulse(Axis::Y) => placed.impulse.get_or_insert_with(Xy::zero).y = value,
                Variable::SkidSpeed(side) => placed.skids[side as usize] = Some(value),
                Variable::Speed(side) => speeds[side as usize] = Some(value),
                Variable::RadiusOfGyration(side) => gyrations[side as usize] = Some(value.squared()),
                // An input that the collision does not have is reported by the check of the problem.
                Variable::Input(input) => drop(placed.collision.set(input, value)),
            }
        }
        turn(&mut placed.collision.one, gyrations[0]);
        turn(&mut placed.collision.two, gyrations[1]);
        drive(&mut placed.collision.one, speeds[0]);
        drive(&mut placed.collision.two, speeds[1]);
        placed
    }
}

/// Sets the velocity of a vehicle to a speed along its heading.
fn drive<T: Real + Copy>(party: &mut Party<T>, speed: Option<T>) {
    if let (Party::Vehicle(vehicle), Some(speed)) = (party, speed) {
        *vehicle = vehicle.with_speed(speed);
    }
}

/// Sets the yaw inertia of a vehicle from the square of its radius of gyration.
fn turn<T: Real + Copy>(party: &mut Party<T>, gyration: Option<T>) {
    if let (Party::Vehicle(vehicle), Some(square)) = (party, gyration) {
        vehicle.yaw_inertia = vehicle.mass * square;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::{CrushPlane, ForwardLeft, Heading};
    use crate::law::{ImpulseRatio, Law};
    use crate::moment::Moment;
    use crate::reconstruct::{Correlation, Measurand, PriorCorrelation, Search, Uncertainty};
    use crate::vehicle::{Motion, Vehicle};

    fn problem() -> ReconstructionProblem {
        let vehicle = |heading: f64, mass: f64, speed: Xy| Vehicle {
            mass,
            yaw_inertia: 1.5 * mass,
            heading: Heading::from_angle(heading),
            impact_center: ForwardLeft { forward: 2.0, left: 0.25 },
            motion: Motion { velocity: speed, yaw_rate: 0.0 },
        };
        ReconstructionProblem::of(Collision {
            one: vehicle(0.0, 1000.0, Xy { x: 10.0, y: 0.0 }).into(),
            two: vehicle(2.0, 1500.0, Xy { x: -5.0, y: 8.0 }).into(),
            crush_plane: CrushPlane::from_angle(0.1),
            restitution: 0.1,
            impulse_ratio: ImpulseRatio::Critical,
            law: Law::Brach,
            moment: Moment::None,
        })
    }

    #[test]
    fn a_kept_radius_of_gyration_moves_the_yaw_inertia_with_the_mass() {
        let mass = Variable::Input(Input::Mass(Side::One));
        let free = problem().unknown(mass, 1000.0);
        let kept = ReconstructionProblem { holds_radius_of_gyration: [true, false], ..free.clone() };
        let inertia = |question: &ReconstructionProblem, values: &[f64]| {
            let placed = Scene::of(question).place(values).collision;
            [placed.one, placed.two].map(|party| party.vehicle().expect("a vehicle").yaw_inertia)
        };
        assert_eq!(inertia(&free, &[1200.0]), [1500.0, 2250.0]);
        assert_eq!(inertia(&kept, &[1200.0]), [1800.0, 2250.0]);
        // An unknown yaw inertia is what it is.
        assert_eq!(inertia(&kept.clone().unknown(Variable::Input(Input::YawInertia(Side::One)), 1.0), &[1200.0, 7.0]), [7.0, 2250.0]);
        let radius = free.unknown(Variable::RadiusOfGyration(Side::Two), 1.0);
        assert_eq!(inertia(&radius, &[1200.0, 2.0]), [1500.0, 6000.0]);
        let placed = Scene::of(&radius).place(&[1200.0, 2.0]).collision;
        assert_eq!(Variable::RadiusOfGyration(Side::Two).of(&placed, &0.5), Some(2.0));
    }

    #[test]
    fn correlated_priors_are_correlated_evidence() {
        let [one, two] = [Side::One, Side::Two].map(|side| Variable::Input(Input::Mass(side)));
        let speed = problem().unknown(Variable::Speed(Side::One), 12.0).evidence(
            Measurand::CrushEnergy,
            100e3,
            Uncertainty::StandardDeviation(5e3),
        );
        let deviation = Uncertainty::StandardDeviation;
        let mut as_evidence = speed.clone().unknown(one, 1000.0).unknown(two, 1500.0);
        as_evidence = as_evidence.evidence(Measurand::Variable(one), 1000.0, deviation(50.0));
        as_evidence = as_evidence.evidence(Measurand::Variable(two), 1500.0, deviation(80.0));
        let of = Measurand::Variable;
        as_evidence.correlations = vec![Correlation { one: of(one), other: of(two), coefficient: 0.75 }];
        let mut as_priors = speed.prior(one, 1000.0, 50.0).prior(two, 1500.0, 80.0);
        as_priors.prior_correlations = vec![PriorCorrelation { one: two, other: one, coefficient: 0.75 }];
        let search = Search { starts: 1, ..Search::default() };
        let [evidence, priors] = [&as_evidence, &as_priors].map(|question| question.solve(&search).expect("an answer"));
        assert_eq!(evidence.best().unknowns, priors.best().unknowns);
        assert_eq!(evidence.best().covariance, priors.best().covariance);
        // The crush energy tells one speed; what is known of the masses stays as it was.
        let correlation = priors.best().covariance.correlation(1, 2).expect("variances");
        assert!((correlation - 0.75).abs() < 1e-9, "{correlation}");
        let independent = ReconstructionProblem { prior_correlations: Vec::new(), ..as_priors.clone() };
        let of_speed = |question: &ReconstructionProblem| question.solve(&search).expect("an answer").best().unknowns[0].sd;
        assert_ne!(of_speed(&as_priors), of_speed(&independent));
        for (a, b, coefficient) in [(one, one, 0.5), (one, Variable::Speed(Side::One), 0.5), (one, two, 1.0), (one, two, -1.5)] {
            as_priors.prior_correlations = vec![PriorCorrelation { one: a, other: b, coefficient }];
            assert!(as_priors.check().is_err(), "{a:?} {b:?} {coefficient}");
        }
    }
}
