//! One body of a record, in numbers with a resolution.

use super::key::Key;
use super::record::Record;
use super::uncertain::Uncertain;
use crate::body::Body;
use crate::frame::{CrushPlane, ForwardLeft, Heading, Xy};
use crate::input::Side;
use crate::scalar::Field;
use crate::vehicle::{Motion, Vehicle};
use num_traits::Inv;

/// The known quantities of one body.
#[derive(Clone, Copy)]
pub(super) struct Subject<const N: usize> {
    pub(super) fixed: bool,
    pub(super) mass: Option<Uncertain<N>>,
    pub(super) yaw_inertia: Option<Uncertain<N>>,
    /// Center of mass; for a fixed body the contact point, if that is known.
    pub(super) center: Option<Xy<Uncertain<N>>>,
    pub(super) before: Option<Xy<Uncertain<N>>>,
    pub(super) after: Option<Xy<Uncertain<N>>>,
    pub(super) yaw_before: Option<Uncertain<N>>,
    pub(super) yaw_after: Option<Uncertain<N>>,
    /// Center of mass at the end of a contact that lasts.
    pub(super) center_after: Option<Xy<Uncertain<N>>>,
    /// From the center of mass to the contact point.
    pub(super) arm: Option<Xy<Uncertain<N>>>,
    /// The same at the end of a contact that lasts, and `arm` if the contact point then is unknown.
    pub(super) arm_after: Option<Xy<Uncertain<N>>>,
}

/// Before or after the impact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum When {
    Before,
    After,
}

/// Number of slots for inputs with a resolution: one for each number of a record.
pub(super) const PLACES: usize = Key::ALL.len();

/// Returns a number of the record with its resolution.
pub(super) fn number<const N: usize>(record: &Record, key: Key) -> Option<Uncertain<N>> {
    let value = record.get(key)?;
    let resolution = if N == 0 { 0.0 } else { record.resolution.of(key).unwrap_or(0.0) };
    Some(Uncertain::input(value, key.index(), resolution))
}

/// Returns two numbers of the record as a vector in ground axes.
pub(super) fn pair<const N: usize>(record: &Record, x: Key, y: Key) -> Option<Xy<Uncertain<N>>> {
    Some(Xy { x: number(record, x)?, y: number(record, y)? })
}

impl<const N: usize> Subject<N> {
    /// Returns a body of a record that touches the other body at a point.
    pub(super) fn of(record: &Record, side: Side, point: Option<Xy<Uncertain<N>>>) -> Self {
        let [before, after] =
            [(Key::BeforeX(side), Key::BeforeY(side)), (Key::AfterX(side), Key::AfterY(side))].map(|(x, y)| pair(record, x, y));
        if record.subject(side).fixed {
            let (rest, still) = (Some(Xy::zero()), Some(Uncertain::exact(0.0)));
            // It keeps its velocity, whichever is known.
            let before = before.or(after).or(rest);
            return Subject {
                fixed: true,
                mass: None,
                yaw_inertia: None,
                center: point,
                before,
                after: before,
                yaw_before: still,
                yaw_after: still,
                center_after: None,
                arm: rest,
                arm_after: rest,
            };
        }
        let center = pair(record, Key::CenterX(side), Key::CenterY(side));
        let center_after = pair(record, Key::CenterAfterX(side), Key::CenterAfterY(side));
        let arm = point.zip(center).map(|(point, center)| point - center);
        let point_after = pair(record, Key::PointAfterX, Key::PointAfterY);
        Subject {
            fixed: false,
            mass: number(record, Key::Mass(side)),
            yaw_inertia: number(record, Key::YawInertia(side)),
            center,
            before,
            after,
            yaw_before: number(record, Key::BeforeYawRate(side)),
            yaw_after: number(record, Key::AfterYawRate(side)),
            center_after,
            arm,
            arm_after: point_after.zip(center_after.or(center)).map(|(point, center)| point - center).or(arm),
        }
    }

    /// Returns the same body without its motions, if it has any of its own.
    pub(super) fn without_motions(&self) -> Self {
        if self.fixed {
            return *self;
        }
        Subject { before: None, after: None, yaw_before: None, yaw_after: None, ..*self }
    }

    pub(super) fn velocity(&self, when: When) -> Option<Xy<Uncertain<N>>> {
        match when {
            When::Before => self.before,
            When::After => self.after,
        }
    }

    pub(super) fn yaw_rate(&self, when: When) -> Option<Uncertain<N>> {
        match when {
            When::Before => self.yaw_before,
            When::After => self.yaw_after,
        }
    }

    /// Returns its change of velocity.
    pub(super) fn delta_v(&self) -> Option<Xy<Uncertain<N>>> {
        Some(self.after? - self.before?)
    }

    /// Returns its change of momentum; `None` for a fixed body, which has no mass.
    pub(super) fn momentum_gained(&self) -> Option<Xy<Uncertain<N>>> {
        Some(self.delta_v()? * self.mass?)
    }

    /// Returns its change of spin, I (Ω − ω), which needs no inertia where it never spins; `None` for a fixed body, which has no inertia.
    pub(super) fn spin_gained(&self) -> Option<Uncertain<N>> {
        let (before, after) = (self.yaw_before?, self.yaw_after?);
        if !self.fixed && before.is_zero() && after.is_zero() {
            return Some(Uncertain::exact(0.0));
        }
        Some((after - before) * self.yaw_inertia?)
    }

    /// Returns `true` if its change of spin is known or it is fixed.
    pub(super) fn spin_is_known(&self) -> bool {
        self.fixed || self.spin_gained().is_some()
    }

    /// Returns the body in contact axes, without its inertia. One that does not spin has the same velocity everywhere, and may have no arm.
    pub(super) fn body(&self, plane: &CrushPlane<Uncertain<N>>, when: When) -> Option<Body<Uncertain<N>>> {
        let arm = match when {
            When::Before => self.arm,
            When::After => self.arm_after,
        };
        let yaw_rate = self.yaw_rate(when)?;
        let arm = arm.or_else(|| yaw_rate.is_zero().then(Xy::zero))?;
        Some(Body { arm: plane.to_contact(arm), velocity: plane.to_contact(self.velocity(when)?), yaw_rate, ..Body::fixed() })
    }

    /// Returns `true` if it touches the other body at its center of mass.
    pub(super) fn has_no_arm(&self) -> bool {
        self.arm.is_some_and(|arm| arm.x.is_zero() && arm.y.is_zero())
    }

    /// Returns the same body with its inertia, if it has an arm.
    pub(super) fn with_inertia(&self, body: Body<Uncertain<N>>) -> Option<Body<Uncertain<N>>> {
        if self.fixed {
            return Some(body);
        }
        self.arm?;
        Some(Body { inverse_mass: self.mass?.inv(), inverse_yaw_inertia: self.yaw_inertia?.inv(), ..body })
    }

    /// Returns its inverse mass and inverse yaw inertia, without resolutions, if it has an arm.
    pub(super) fn yields(&self) -> Option<(f64, f64)> {
        if self.fixed {
            return Some((0.0, 0.0));
        }
        self.arm?;
        Some((1.0 / self.mass?.value, 1.0 / self.yaw_inertia?.value))
    }

    /// Returns the kinetic energy of its spin, zero for a fixed body.
    pub(super) fn spin_energy(&self, when: When) -> Option<Uncertain<N>> {
        match self.yaw_rate(when) {
            Some(rate) if self.fixed || rate.is_zero() => Some(Uncertain::exact(0.0)),
            rate => Some(self.yaw_inertia? * rate?.squared().half()),
        }
    }

    /// Returns its kinetic energy for a moving observer, with its spin or of its translation alone; zero for a fixed body.
    pub(super) fn kinetic_energy(&self, when: When, observer: Xy<Uncertain<N>>, spin: bool) -> Option<Uncertain<N>> {
        let none = Uncertain::exact(0.0);
        if self.fixed {
            return Some(none);
        }
        let vehicle = Vehicle {
            mass: self.mass?,
            yaw_inertia: none,
            heading: Heading { cos: Uncertain::exact(1.0), sin: none },
            impact_center: ForwardLeft::zero(),
            motion: Motion::rest(),
        };
        let of_translation = vehicle.kinetic_energy(Motion { velocity: self.velocity(when)? - observer, yaw_rate: none });
        Some(if spin { of_translation + self.spin_energy(when)? } else { of_translation })
    }
}
