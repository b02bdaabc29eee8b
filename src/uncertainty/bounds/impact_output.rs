//! An output of the impact as a function of uncertain numbers.

use super::minimum::refused_part;
use super::objective::{Bounded, Enclosure, Objective};
use super::{CELLS_OF_REFUSAL, RefusedPart};
use crate::collision::Collision;
use crate::frame::Nt;
use crate::impact::{ForceDirection, Impact, Response};
use crate::input::Side;
use crate::law::{FrictionCone, ImpulseRatio};
use crate::measure::Measure;
use crate::output::Output;
use crate::scalar::Real;
use crate::scalar::interval::{Interval, Truth};
use crate::uncertainty::{Mapped, Mapping};

/// An output of a collision whose inputs follow from uncertain numbers.
pub(super) struct ImpactOutput<'a, M> {
    base: &'a Collision,
    mapping: &'a M,
    of: Output,
    /// Direction from which the angle of a force is measured.
    ahead: Option<ForceDirection>,
}

impl<'a, M: Mapping> ImpactOutput<'a, M> {
    pub(super) fn new(base: &'a Collision, mapping: &'a M, of: Output) -> Self {
        ImpactOutput { base, mapping, of, ahead: None }
    }

    fn value_of<T: Real + Copy + From<f64>>(&self, collision: &Collision<T>, impact: &Impact<T>) -> T {
        match self.of {
            // Of the magnitudes, whose squares are not negative on an interval either.
            Output::DeltaVMagnitude(side) => {
                let delta_v = response(impact, side).delta_v;
                (delta_v.x.magnitude().squared() + delta_v.y.magnitude().squared()).square_root()
            }
            Output::ImpulseRatio => chosen_ratio(collision, impact).unwrap_or_else(|| self.of.of(collision, impact)),
            Output::PrincipalDirectionOfForce(side) => {
                let force = force_at_ratio(collision, impact, side).unwrap_or_else(|| response(impact, side).force_direction());
                self.ahead.map_or_else(|| force.direction(), |ahead| force.direction_about(&ahead))
            }
            of => of.of(collision, impact),
        }
    }
}

impl<M: Mapping> Bounded for ImpactOutput<'_, M> {
    fn numbers(&self) -> usize {
        self.mapping.numbers()
    }

    fn value<T: Real + Copy + From<f64>>(&self, numbers: &[T]) -> T {
        let collision = self.mapping.apply(self.base, numbers);
        self.value_of(&collision, &collision.evaluate())
    }

    fn at(&self, point: &[f64]) -> Option<f64> {
        let collision = self.mapping.apply::<f64>(self.base, point);
        let impact = collision.solve().ok()?;
        Some(self.value_of(&collision, &impact))
    }

    fn is_possible(&self, cell: &[Interval]) -> Truth {
        is_possible(&self.mapping.apply(self.base, cell))
    }

    fn is_continuous(&self, cell: &[Interval], value: Interval) -> bool {
        let collision = self.mapping.apply(self.base, cell);
        !is_cut(self.of.measure(), value) && !collision.friction_may_reverse(&collision.contact())
    }

    fn over(&self, cell: &[Interval]) -> Enclosure {
        let collision = self.mapping.apply(self.base, cell);
        let contact = collision.contact();
        let impact = collision.impact_at(&contact);
        let value = self.value_of(&collision, &impact);
        Enclosure {
            value,
            is_possible: collision.is_possible_exactly(&contact, &impact),
            is_continuous: !is_cut(self.of.measure(), value) && !collision.friction_may_reverse(&contact),
        }
    }

    fn turn_to(&mut self, accepted: &[f64]) {
        if let Output::PrincipalDirectionOfForce(side) = self.of {
            let collision = self.mapping.apply::<f64>(self.base, accepted);
            self.ahead = Some(response(&collision.evaluate(), side).force_direction());
        }
    }
}

impl<M: Mapping> Mapped<M> {
    /// Returns whether physics accepts the collision at every point of a cell, at none, or whether this is not decided.
    pub fn is_possible(&self, cell: &[Interval]) -> Truth {
        is_possible(&self.mapping().apply(self.collision(), cell))
    }

    /// Returns the part of a box that physics refuses, as far as some hundred cells of it tell.
    pub fn refused_part(&self, whole: &[Interval]) -> RefusedPart {
        // Any output will do: whether physics accepts the collision does not depend on it.
        let output = ImpactOutput::new(self.collision(), self.mapping(), Output::NormalImpulse);
        refused_part(&Objective::new(&output), whole, CELLS_OF_REFUSAL).0
    }
}

fn is_possible(collision: &Collision<Interval>) -> Truth {
    let contact = collision.contact();
    collision.is_possible_exactly(&contact, &collision.impact_at(&contact))
}

/// Returns `true` if an angle may have been cut at a half turn.
pub(super) fn is_cut(measure: Measure, value: Interval) -> bool {
    measure == Measure::Angle && value.width() > 6.0
}

/// Returns the impulse ratio where it is not that of the critical impulse: an interval of P_t/P_n would not see that it depends on no more than the friction.
fn chosen_ratio<T: Real>(collision: &Collision<T>, impact: &Impact<T>) -> Option<T> {
    match &collision.impulse_ratio {
        ImpulseRatio::Given(ratio) => Some(ratio.clone()),
        ImpulseRatio::LimitedByFriction(friction) => {
            let contact = collision.contact();
            let change = collision.sticking_change(&contact, collision.moment_impulse(&contact).as_ref());
            let cone = FrictionCone::around(&contact.compliance.impulse_for(change.clone()), &change, friction);
            Some(T::select(cone.slides, cone.side * friction.clone(), impact.impulse_ratio()))
        }
        ImpulseRatio::Critical | ImpulseRatio::OfCritical(_) => None,
    }
}

/// Returns the direction of force of an impulse of that ratio, toward the side to which the normal impulse pushes.
fn force_at_ratio<T: Real>(collision: &Collision<T>, impact: &Impact<T>, side: Side) -> Option<ForceDirection<T>> {
    let (party, pushes) = match side {
        Side::One => (&collision.one, 1),
        Side::Two => (&collision.two, -1),
    };
    let toward = T::select(impact.impulse.n.less(&T::int(0)), T::int(-pushes), T::int(pushes));
    let push = Nt { t: toward.clone() * chosen_ratio(collision, impact)?, n: toward };
    Some(ForceDirection::of_push(party.vehicle()?.heading.to_vehicle(collision.crush_plane.to_ground(push))))
}

fn response<T>(impact: &Impact<T>, side: Side) -> &Response<T> {
    match side {
        Side::One => &impact.one,
        Side::Two => &impact.two,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::uncertainty::{Direct, Search, bounds, bounds_of};
    use crate::{Heading, ImpulseRatio, Input, Vehicle};

    #[test]
    fn an_angle_that_is_about_a_whole_turn_may_be_cut() {
        let range = |low: f64, high: f64| Interval::new(low, high).expect("in order");
        let cut =
            [is_cut(Measure::Angle, range(-3.1, 3.1)), is_cut(Measure::Angle, range(-2.9, 2.9)), is_cut(Measure::Speed, range(-3.1, 3.1))];
        assert_eq!(cut, [true, false, false]);
    }

    /// Where the normal change of sticking is zero, the limit by friction may jump.
    #[test]
    fn what_is_computed_at_once_is_what_is_computed_apart() {
        let car = |speed: f64| Vehicle::new(1400.0, 2500.0).with_impact_center(2.0, 0.6).with_speed(speed);
        let base = Collision::new(car(15.0), car(5.0).with_heading(Heading::from_degrees(200.0)))
            .with_impulse_ratio(ImpulseRatio::LimitedByFriction(0.5));
        let mapping = Direct(alloc::vec![Input::CrushPlane, Input::Restitution]);
        for of in [Output::DeltaVMagnitude(Side::One), Output::PrincipalDirectionOfForce(Side::Two), Output::CriticalImpulseRatio] {
            let output = ImpactOutput::new(&base, &mapping, of);
            for (plane, is_continuous) in [((0.0, 0.1), true), ((-1.5, 1.5), false), ((1.3, 1.7), false)] {
                let cell = [Interval::new(plane.0, plane.1).expect("in order"), Interval::from(0.1)];
                let value = output.value(&cell);
                let apart = Enclosure { value, is_possible: output.is_possible(&cell), is_continuous: output.is_continuous(&cell, value) };
                assert_eq!(output.over(&cell), apart, "{of:?} {plane:?}");
                assert_eq!(apart.is_continuous, is_continuous, "{of:?} {plane:?}");
            }
        }
    }

    /// At a given ratio, and sliding, the direction of the force is that of the ratio: by hand, of a push at arctan μ from a normal along x, on vehicles that face
    /// along x and y.
    #[test]
    fn a_direction_of_a_given_ratio_depends_on_nothing_else() {
        let car = |speed: f64| Vehicle::new(1450.0, 2500.0).with_impact_center(1.9, 0.3).with_speed(speed);
        let other = Vehicle::new(1250.0, 1900.0).with_impact_center(0.4, 0.75).with_heading(Heading::from_degrees(90.0)).with_speed(8.0);
        let base = Collision::new(car(14.0), other);
        let inputs = Direct(alloc::vec![Input::VelocityX(Side::One), Input::Restitution]);
        let ranges = [(12.0, 16.0), (0.0, 0.2)];
        let search = Search { cells: 50, ..Search::default() };
        for ratio in [ImpulseRatio::Given(-0.05), ImpulseRatio::LimitedByFriction(0.05)] {
            let base = base.with_impulse_ratio(ratio);
            let of = |output| bounds(&base, &inputs, &ranges, output, &search, &|_| true).expect("it collides");
            let mu = base.evaluate().impulse_ratio();
            assert!((mu.abs() - 0.05).abs() < 1e-15, "{ratio:?}: {mu}");
            let turned = |range: crate::uncertainty::Bounds, angle: f64| {
                assert!(range.is_tight && range.high - range.low < 1e-12, "{ratio:?}: {range:?}");
                assert!((range.low - angle).abs() < 1e-12, "{ratio:?}: {} is not {angle}", range.low);
            };
            turned(of(Output::ImpulseRatio), mu);
            // Clockwise from ahead; the push on body 2 points the other way.
            let on_one = -mu.atan();
            turned(of(Output::PrincipalDirectionOfForce(Side::One)), on_one);
            let on_two = 90_f64.to_radians() - mu.atan() - core::f64::consts::PI;
            turned(of(Output::PrincipalDirectionOfForce(Side::Two)), on_two);
        }
    }

    /// A search that ends at once has no bound of its own beyond the free one: physics refuses a gain of energy, no magnitude is negative, no more is lost or left than the
    /// ½ 1500 (18² + 3² + 15²) J that there are at most, and the normal impulse takes energy.
    #[test]
    fn no_bound_is_beyond_what_is_lawful() {
        let car = |speed: f64| Vehicle::new(1500.0, 2500.0).with_impact_center(1.8, 0.4).with_speed(speed);
        let other = car(12.0).with_heading(Heading::from_angle(3.0));
        let collision = Collision::new(car(14.0), other).with_restitution(0.1);
        let inputs =
            [Input::VelocityX(Side::One), Input::VelocityY(Side::One), Input::VelocityX(Side::Two), Input::CrushPlane, Input::Restitution];
        let ranges = [(10.0, 18.0), (-3.0, 3.0), (-15.0, -9.0), (-0.4, 0.4), (0.0, 0.3)];
        let search = Search { cells: 1, ..Search::default() };
        let in_both = |of| {
            let free = bounds_of(&mut ImpactOutput::new(&collision, &Direct(inputs.to_vec()), of), &ranges, &search, &|_| true);
            [bounds(&collision, &Direct(inputs.to_vec()), &ranges, of, &search, &|_| true), free].map(|range| range.expect("it collides"))
        };
        for of in [Output::Loss, Output::EnergyAfter, Output::EnergyBefore, Output::DeltaVMagnitude(Side::One)] {
            let [range, free] = in_both(of);
            assert!(range.low >= 0.0 && range.low <= range.low_attained, "{of}: {range:?}");
            assert_eq!(range.low, free.low.max(0.0), "{of}");
            if matches!(of, Output::Loss | Output::EnergyAfter) {
                let most = 750.0 * (18.0 * 18.0 + 9.0 + 15.0 * 15.0);
                assert!(free.high > range.high && (range.high - most).abs() < 1e-6, "{of}: {range:?} and {}", free.high);
            }
        }
        let [range, free] = in_both(Output::NormalWork);
        assert!(free.high > 0.0 && range.high == 0.0 && range.low == free.low, "{range:?} and {}", free.high);
    }
}
