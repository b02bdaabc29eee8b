//! How the uncertain numbers of a case determine the inputs of its collision.

use planar_impact::uncertainty::Mapping;
use planar_impact::{Collision, ForwardLeft, Heading, Input, NoSuchInput, Real, Side};

use crate::case::{Inertia, Inputs, Parameter, Restitution, RestitutionCurve, Velocity};

/// The inputs that the uncertain numbers of a case determine, and how.
#[derive(Clone, Debug, PartialEq)]
pub struct CaseMapping {
    numbers: usize,
    inputs: Vec<Input>,
    rules: Vec<Rule>,
    /// What the restitution follows from, the last of the inputs; `None` if it is a number.
    of_closing_speed: Option<OfClosingSpeed>,
}

/// A restitution over the closing speed, and the inputs that this speed has apart from the uncertain numbers.
#[derive(Clone, Debug, PartialEq)]
struct OfClosingSpeed {
    curve: RestitutionCurve,
    scatter: Number,
    base: Collision,
}

/// How an input follows.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Rule {
    /// It is a number itself.
    Same(usize),
    /// The component of the speed along x or y.
    Along { speed: Number, heading: Number, is_x: bool },
    /// The mass times the square of the radius of gyration.
    Inertia { mass: Number, radius: Number },
}

/// An uncertain number by its place, or a certain one.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Number {
    Uncertain(usize),
    Certain(f64),
}

impl Number {
    #[inline]
    fn of<T: Real + Copy + From<f64>>(self, numbers: &[T]) -> T {
        match self {
            Number::Uncertain(place) => numbers[place],
            Number::Certain(value) => T::from(value),
        }
    }

    fn is_uncertain(self) -> bool {
        matches!(self, Number::Uncertain(_))
    }
}

impl CaseMapping {
    /// Returns the mapping of the uncertain parameters of a case.
    pub fn of(inputs: &Inputs, parameters: &[Parameter]) -> Self {
        let number = |parameter: Parameter, value: f64| {
            let place = parameters.iter().position(|uncertain| *uncertain == parameter);
            place.map_or(Number::Certain(value), Number::Uncertain)
        };
        let mut found: Vec<(Input, Rule)> = Vec::new();
        for (place, parameter) in parameters.iter().enumerate() {
            let input = match *parameter {
                Parameter::Input(input) => input,
                Parameter::Friction | Parameter::RatioOfCritical => Input::ImpulseRatio,
                Parameter::MomentOfCritical => Input::Moment,
                Parameter::RestitutionScatter
                | Parameter::RadiusOfGyration(_)
                | Parameter::Speed(_)
                | Parameter::Crush(..)
                | Parameter::Skid(..)
                | Parameter::RestFriction => continue,
            };
            found.push((input, Rule::Same(place)));
        }
        for (side, vehicle) in Side::ALL.into_iter().zip(&inputs.vehicles) {
            let Some(vehicle) = vehicle else { continue };
            if let Inertia::Radius(radius) = vehicle.inertia {
                let (mass, radius) =
                    (number(Parameter::Input(Input::Mass(side)), vehicle.mass), number(Parameter::RadiusOfGyration(side), radius));
                if mass.is_uncertain() || radius.is_uncertain() {
                    found.push((Input::YawInertia(side), Rule::Inertia { mass, radius }));
                }
            }
            if let Velocity::Speed(speed) = vehicle.velocity {
                let (speed, heading) =
                    (number(Parameter::Speed(side), speed), number(Parameter::Input(Input::Heading(side)), vehicle.heading));
                if speed.is_uncertain() || heading.is_uncertain() {
                    let along = |is_x| Rule::Along { speed, heading, is_x };
                    found.extend([(Input::VelocityX(side), along(true)), (Input::VelocityY(side), along(false))]);
                }
            }
        }
        let (mut of_rules, rules): (Vec<Input>, Vec<Rule>) = found.into_iter().unzip();
        let of_closing_speed = match &inputs.contact.restitution {
            Restitution::Given(_) => None,
            Restitution::OfClosingSpeed(curve) => {
                of_rules.push(Input::Restitution);
                let scatter = number(Parameter::RestitutionScatter, curve.scatter);
                Some(OfClosingSpeed { curve: curve.clone(), scatter, base: inputs.as_given().collision })
            }
        };
        CaseMapping { numbers: parameters.len(), inputs: of_rules, rules, of_closing_speed }
    }
}

impl Mapping for CaseMapping {
    fn numbers(&self) -> usize {
        self.numbers
    }

    fn inputs(&self) -> &[Input] {
        &self.inputs
    }

    fn write<T: Real + Copy + From<f64>>(&self, numbers: &[T], inputs: &mut [T]) {
        for (rule, input) in self.rules.iter().zip(&mut *inputs) {
            *input = match *rule {
                Rule::Same(place) => numbers[place],
                Rule::Inertia { mass, radius } => mass.of(numbers) * radius.of(numbers).squared(),
                Rule::Along { speed, heading, is_x } => {
                    let ahead = ForwardLeft { forward: speed.of(numbers), left: T::int(0) };
                    let velocity = Heading::from_angle(heading.of(numbers)).to_ground(ahead);
                    if is_x { velocity.x } else { velocity.y }
                }
            };
        }
        if let (Some(of), Some((restitution, others))) = (&self.of_closing_speed, inputs.split_last_mut()) {
            let mut collision = of.base.map(T::from);
            for (input, value) in self.inputs.iter().zip(others) {
                collision.set(*input, *value).unwrap_or_else(|none: NoSuchInput| panic!("{none}"));
            }
            *restitution = of.curve.of(&collision, of.scatter.of(numbers));
        }
    }
}
