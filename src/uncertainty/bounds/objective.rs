//! The function that is minimized: an output, or its negative, of the uncertain numbers, on any scalar.

use alloc::vec::Vec;

use crate::collision::Collision;
use crate::impact::{Impact, Response};
use crate::input::Side;
use crate::output::Output;
use crate::scalar::Real;
use crate::scalar::interval::{Interval, Truth};
use crate::sensitivity::dual::Dual;
use crate::uncertainty::Mapping;

/// An output of a collision as a function of uncertain numbers.
#[derive(Clone, Copy)]
pub(super) struct Objective<'a, M> {
    base: &'a Collision,
    mapping: &'a M,
    of: Output,
    is_negated: bool,
    /// Direction (ahead, right) from which the angle of a force is measured.
    ahead: Option<(f64, f64)>,
}

/// A point that physics accepts, and the value of the objective there.
#[derive(Clone, Debug)]
pub(super) struct Attained {
    pub(super) point: Vec<f64>,
    pub(super) value: f64,
}

/// Enclosure over a cell.
pub(super) struct Enclosure {
    pub(super) value: Interval,
    pub(super) is_possible: Truth,
    /// Whether the objective is continuous over the cell.
    pub(super) is_continuous: bool,
}

impl<'a, M: Mapping> Objective<'a, M> {
    pub(super) fn new(base: &'a Collision, mapping: &'a M, of: Output) -> Self {
        Objective { base, mapping, of, is_negated: false, ahead: None }
    }

    pub(super) fn negated(&self) -> Self {
        Objective { is_negated: !self.is_negated, ..*self }
    }

    /// Measures the angle of a force from its direction at an accepted point.
    pub(super) fn turn_to(&mut self, point: &[f64]) {
        if let Output::PrincipalDirectionOfForce(side) = self.of {
            let collision = self.mapping.apply::<f64>(self.base, point);
            let force = response(&collision.evaluate(), side).force_direction();
            self.ahead = Some((force.ahead, force.right));
        }
    }

    fn value<T: Real + Copy + From<f64>>(&self, collision: &Collision<T>, impact: &Impact<T>) -> T {
        let value = match self.of {
            // Of the magnitudes, whose squares are not negative on an interval either.
            Output::DeltaVMagnitude(side) => {
                let delta_v = response(impact, side).delta_v;
                (delta_v.x.magnitude().squared() + delta_v.y.magnitude().squared()).square_root()
            }
            Output::PrincipalDirectionOfForce(side) => {
                let force = response(impact, side).force_direction();
                match self.ahead {
                    // A barrier has none, and neither has a vehicle without a force.
                    Some((0.0, 0.0)) => T::int(0),
                    Some((ahead, right)) => {
                        let (cos, sin) = (T::from(ahead), T::from(right));
                        let (along, across) = (force.ahead * cos + force.right * sin, force.right * cos - force.ahead * sin);
                        across.arctangent(along) + sin.arctangent(cos)
                    }
                    None => force.direction(),
                }
            }
            of => of.of(collision, impact),
        };
        if self.is_negated { -value } else { value }
    }

    /// Returns the value at a point, if physics accepts it.
    pub(super) fn at(&self, point: &[f64]) -> Option<f64> {
        let collision = self.mapping.apply::<f64>(self.base, point);
        let impact = collision.solve().ok()?;
        Some(self.value(&collision, &impact)).filter(|value| value.is_finite())
    }

    /// Returns the value at a point with its derivative and its second derivative by one of the numbers. It is not checked.
    pub(super) fn curve(&self, point: &[f64], by: usize) -> [f64; 3] {
        let seeded = |i: usize| f64::from(u8::from(i == by));
        let numbers: Vec<Dual<Dual<f64>>> = point
            .iter()
            .enumerate()
            .map(|(i, x)| Dual { value: Dual { value: *x, derivative: seeded(i) }, derivative: Dual::constant(seeded(i)) })
            .collect();
        let collision = self.mapping.apply(self.base, &numbers);
        let value = self.value(&collision, &collision.evaluate());
        [value.value.value, value.value.derivative, value.derivative.derivative]
    }

    /// Returns the enclosure over a cell.
    pub(super) fn over(&self, cell: &[Interval]) -> Enclosure {
        let collision = self.mapping.apply(self.base, cell);
        let contact = collision.contact();
        let impact = collision.impact_at(&contact);
        let value = self.value(&collision, &impact);
        let is_cut = matches!(self.of, Output::PrincipalDirectionOfForce(_)) && value.width() > 6.0;
        Enclosure {
            value,
            is_possible: collision.is_possible_exactly(&contact, &impact),
            is_continuous: !is_cut && !collision.friction_may_reverse(&contact),
        }
    }

    /// Returns whether physics accepts the points of a cell.
    pub(super) fn is_possible(&self, cell: &[Interval]) -> Truth {
        let collision = self.mapping.apply(self.base, cell);
        let contact = collision.contact();
        collision.is_possible_exactly(&contact, &collision.impact_at(&contact))
    }

    /// Returns the enclosure of the value over a cell, unchecked: for a point, that of its rounding.
    pub(super) fn value_over(&self, cell: &[Interval]) -> Interval {
        let collision = self.mapping.apply(self.base, cell);
        self.value(&collision, &collision.evaluate())
    }

    /// Returns the derivative by one of the numbers over a cell, with the value.
    pub(super) fn slope_over(&self, numbers: &mut [Dual<Interval>], by: usize) -> Dual<Interval> {
        numbers[by].derivative = Interval::from(1.0);
        let collision = self.mapping.apply(self.base, numbers);
        let value = self.value(&collision, &collision.evaluate());
        numbers[by].derivative = Interval::default();
        value
    }
}

fn response<T>(impact: &Impact<T>, side: Side) -> &Response<T> {
    match side {
        Side::One => &impact.one,
        Side::Two => &impact.two,
    }
}
