//! Random oblique collisions of two cars, and their simulated measurements.

use planar_impact::reconstruct::{Answer, Axis, Measurand, ReconstructionProblem, Search, Uncertainty, Variable};
use planar_impact::*;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// A source of collisions that is the same in every run.
pub struct Source(pub ChaCha8Rng);

impl Source {
    pub fn of(seed: u64) -> Self {
        Source(ChaCha8Rng::seed_from_u64(seed))
    }

    pub fn between(&mut self, least: f64, most: f64) -> f64 {
        least + (most - least) * self.0.random::<f64>()
    }

    fn car(&mut self, heading: f64) -> Vehicle {
        let (mass, speed) = (self.between(900.0, 2500.0), self.between(8.0, 30.0));
        let heading = Heading::from_angle(heading);
        Vehicle {
            mass,
            yaw_inertia: mass * self.between(1.2, 1.6).powi(2),
            heading,
            impact_center: ForwardLeft { forward: self.between(0.5, 2.2), left: self.between(-0.8, 0.8) },
            motion: Motion { velocity: heading.to_ground(ForwardLeft { forward: speed, left: 0.0 }), yaw_rate: 0.0 },
        }
    }

    /// Draws two cars that meet obliquely or head-on, with some sliding left.
    pub fn collision(&mut self) -> Collision {
        loop {
            let heading = self.between(1.8, 4.4);
            let collision = Collision {
                one: self.car(0.0).into(),
                two: self.car(heading).into(),
                crush_plane: CrushPlane::from_angle(self.between(-0.5, 0.5)),
                restitution: self.between(0.02, 0.25),
                impulse_ratio: ImpulseRatio::OfCritical(self.between(0.5, 0.98)),
                law: Law::Brach,
                moment: Moment::None,
            };
            if collision.solve().is_ok() {
                return collision;
            }
        }
    }
}

/// Returns the collision with another value of an unknown.
pub fn with(collision: &Collision, of: Variable, value: f64) -> Collision {
    let mut other = *collision;
    for (own, party) in [(Side::One, &mut other.one), (Side::Two, &mut other.two)] {
        if let (true, Party::Vehicle(vehicle)) = (of == Variable::Speed(own), party) {
            vehicle.motion.velocity = vehicle.heading.to_ground(ForwardLeft { forward: value, left: 0.0 });
        }
    }
    if let Variable::Input(input) = of {
        other.set(input, value).expect("the collision has it");
    }
    other
}

/// Returns a car that drives straight into a barrier, with a crush plane that may be oblique to its path.
pub fn straight_into_barrier(crush_plane: f64) -> Collision {
    let car = Vehicle {
        mass: 1500.0,
        yaw_inertia: 2500.0,
        heading: Heading::from_angle(0.0),
        impact_center: ForwardLeft { forward: 2.0, left: 0.0 },
        motion: Motion { velocity: Xy { x: 15.0, y: 0.0 }, yaw_rate: 0.0 },
    };
    Collision {
        one: car.into(),
        two: Party::Barrier,
        crush_plane: CrushPlane::from_angle(crush_plane),
        restitution: 0.1,
        impulse_ratio: ImpulseRatio::Critical,
        law: Law::Brach,
        moment: Moment::None,
    }
}

/// A plane of 0.3 or −0.3, of which other evidence prefers the first by a given χ²; `more` is that of a prior which contradicts both.
pub fn preferred(chi_square: f64, more: f64) -> (ReconstructionProblem, Answer) {
    let truth = Truth::of(straight_into_barrier(0.3), 1.0);
    let (plane, energy, delta_v) = (Variable::Input(Input::CrushPlane), Measurand::CrushEnergy, Measurand::DeltaVForward(Side::One));
    let sd = Uncertainty::StandardDeviation;
    let question = ReconstructionProblem::of(truth.collision)
        .between(plane, 0.1, -0.6, 0.6)
        .evidence(energy, truth.measured(energy), sd(1.0))
        .evidence(delta_v, truth.measured(delta_v), sd(1.0))
        .evidence(Measurand::Variable(plane), 0.3, sd(0.6 / chi_square.sqrt()))
        // It does not depend on the plane.
        .evidence(Measurand::Variable(Variable::Speed(Side::One)), 15.0 + more.sqrt(), sd(1.0));
    let answer = question.solve(&Search::default()).expect("it has answers");
    for (solution, expected) in answer.solutions.iter().chain(&answer.worse).zip([more, more + chi_square]) {
        assert!((solution.chi_square - expected).abs() < 1e-3, "{} for {expected}", solution.chi_square);
    }
    (question, answer)
}

/// The true collision.
pub struct Truth {
    pub collision: Collision,
    pub impact: Impact,
    pub crush_share: f64,
}

impl Truth {
    pub fn of(collision: Collision, crush_share: f64) -> Self {
        let impact = collision.solve().expect("it has been solved before");
        Truth { collision, impact, crush_share }
    }

    fn vehicle(&self, side: Side) -> Vehicle {
        let party = match side {
            Side::One => &self.collision.one,
            Side::Two => &self.collision.two,
        };
        *party.vehicle().expect("both are vehicles")
    }

    pub fn variable(&self, variable: Variable) -> f64 {
        match variable {
            Variable::Input(input) => self.collision.input(input).expect("the collision has it"),
            Variable::Speed(side) => self.vehicle(side).motion.velocity.length(),
            Variable::RadiusOfGyration(side) => self.vehicle(side).radius_of_gyration(),
            Variable::CrushShare => self.crush_share,
            Variable::Impulse(Axis::X) => self.impact.impulse_on_ground.x,
            Variable::Impulse(Axis::Y) => self.impact.impulse_on_ground.y,
            // Nobody brakes before the impact.
            Variable::SkidSpeed(_) => 0.0,
        }
    }

    /// Returns the true value of a measurand, computed independently of the library's measurands.
    pub fn measured(&self, measurable: Measurand) -> f64 {
        let response = |side| match side {
            Side::One => &self.impact.one,
            Side::Two => &self.impact.two,
        };
        let crush_energy = -self.impact.work.n;
        match measurable {
            Measurand::Variable(variable) => self.variable(variable),
            Measurand::Output(output) => Outputs::of(&self.collision, &self.impact)[output],
            Measurand::CrushEnergy => crush_energy,
            Measurand::CrushEnergyOf(Side::One) => crush_energy * self.crush_share,
            Measurand::CrushEnergyOf(Side::Two) => crush_energy * (1.0 - self.crush_share),
            Measurand::EquivalentEnergySpeed(side) => {
                let share = if side == Side::One { self.crush_share } else { 1.0 - self.crush_share };
                (2.0 * share * crush_energy / self.vehicle(side).mass).sqrt()
            }
            Measurand::ApproachDirection(side) => {
                let velocity = self.vehicle(side).motion.velocity;
                velocity.y.atan2(velocity.x)
            }
            Measurand::ClosingSpeed => {
                let along = |side| {
                    let Vehicle { heading, impact_center: at, motion, .. } = self.vehicle(side);
                    let x = motion.velocity.x - motion.yaw_rate * (at.forward * heading.sin + at.left * heading.cos);
                    let y = motion.velocity.y + motion.yaw_rate * (at.forward * heading.cos - at.left * heading.sin);
                    x * self.collision.crush_plane.cos + y * self.collision.crush_plane.sin
                };
                (along(Side::Two) - along(Side::One)).abs()
            }
            Measurand::SeparationSpeed(side) => response(side).after.velocity.x.hypot(response(side).after.velocity.y),
            Measurand::SeparationDirection(side) => response(side).after.velocity.y.atan2(response(side).after.velocity.x),
            Measurand::DeltaVForward(side) => {
                let (delta_v, heading) = (response(side).delta_v, self.vehicle(side).heading);
                delta_v.x * heading.cos + delta_v.y * heading.sin
            }
            Measurand::DeltaVLeft(side) => {
                let (delta_v, heading) = (response(side).delta_v, self.vehicle(side).heading);
                delta_v.y * heading.cos - delta_v.x * heading.sin
            }
            // Nobody brakes before the impact.
            Measurand::BrakingSpeed(side) => self.vehicle(side).motion.velocity.length(),
            _ => unimplemented!("{measurable:?} is new: measure it by hand"),
        }
    }
}

/// Returns the typical standard deviation of a measurand.
pub fn deviation(measurable: Measurand, value: f64) -> f64 {
    match measurable {
        Measurand::CrushEnergy | Measurand::CrushEnergyOf(_) => 0.05 * value,
        Measurand::Output(Output::NormalWork) => 0.05 * value.abs(),
        Measurand::ApproachDirection(_) | Measurand::SeparationDirection(_) | Measurand::Output(Output::PrincipalDirectionOfForce(_)) => {
            0.03
        }
        _ => 0.3,
    }
}

/// Adds an unknown to the question, with a start independent of the truth; for components, a start near it.
pub fn asking(question: ReconstructionProblem, variable: Variable, truth: f64, source: &mut Source) -> ReconstructionProblem {
    match variable {
        Variable::Speed(_) => question.between(variable, 15.0, 0.0, 50.0),
        Variable::RadiusOfGyration(_) => question.between(variable, 1.3, 0.5, 3.0),
        Variable::CrushShare => question.between(variable, 0.5, 0.0, 1.0),
        Variable::Input(Input::Restitution) => question.between(variable, 0.15, 0.0, 0.4),
        Variable::Input(Input::ImpulseRatio) => question.between(variable, 0.75, 0.0, 1.0),
        Variable::Input(Input::CrushPlane) => question.between(variable, 0.0, -0.8, 0.8),
        Variable::Input(Input::ImpactCenterForward(_) | Input::ImpactCenterLeft(_)) => question.between(variable, 0.0, -1.0, 1.0),
        Variable::Input(Input::YawRate(_)) => question.unknown(variable, 0.0),
        Variable::Input(Input::Heading(_)) => question.between(variable, 0.1, -0.8, 0.8),
        Variable::Impulse(_) => question.unknown(variable, truth + source.between(-5e3, 5e3)),
        Variable::SkidSpeed(_) => question.between(variable, 5.0, 0.0, 50.0),
        Variable::Input(_) => question.unknown(variable, truth + source.between(-5.0, 5.0)),
    }
}
