//! Collisions into lanes, and impacts out of them.

use core::array;
use core::mem::discriminant;

use super::{LaneMask, Lanes};
use crate::collision::Collision;
use crate::frame::{CrushPlane, ForwardLeft, Heading, Xy};
use crate::impact::Impact;
use crate::input::{Input, Side};
use crate::vehicle::{Motion, Party, Vehicle};

/// Takes a number of each of several things into lanes.
macro_rules! gather {
    ($all:expr, $($field:tt)+) => {
        Lanes(array::from_fn(|lane| $all[lane].$($field)+))
    };
}

impl<const N: usize> Collision<Lanes<N>> {
    /// Packs collisions into lanes, or returns `None` if they differ in more than numbers: in which party is a barrier, the law, or how the impulse ratio or the
    /// moment is given.
    ///
    /// ```
    /// use planar_impact::scalar::lanes::Lanes;
    /// use planar_impact::*;
    /// let car = |speed: f64| Vehicle::new(1500.0, 2500.0).with_impact_center(2.0, 0.3).with_speed(speed);
    /// let rows = [10.0, 12.0, -3.0, 14.0].map(|speed| Collision::new(car(speed), Party::Barrier).with_restitution(0.1));
    /// let lanes: Collision<Lanes<4>> = Collision::gather(&rows).expect("all are cars against a wall");
    /// let (impact, accepted) = lanes.solve_lanes();
    /// // The third car drives away from the wall.
    /// assert_eq!(accepted.to_array(), [true, true, false, true]);
    /// assert_eq!(impact.scatter()[1], rows[1].solve()?);
    /// # Ok::<(), Refusals>(())
    /// ```
    pub fn gather(rows: &[Collision; N]) -> Option<Self> {
        let first = rows.first()?;
        let form = |row: &Collision| (discriminant(&row.impulse_ratio), row.law, discriminant(&row.moment));
        if rows.iter().any(|row| form(row) != form(first)) {
            return None;
        }
        let number = |input| Lanes(array::from_fn(|lane| rows[lane].input(input).unwrap_or(f64::NAN)));
        Some(Collision {
            one: party(rows, Side::One)?,
            two: party(rows, Side::Two)?,
            crush_plane: CrushPlane { cos: gather!(rows, crush_plane.cos), sin: gather!(rows, crush_plane.sin) },
            restitution: gather!(rows, restitution),
            impulse_ratio: first.impulse_ratio.map(|_| number(Input::ImpulseRatio)),
            law: first.law,
            moment: first.moment.map(|_| number(Input::Moment)),
        })
    }

    /// Computes the impact of every lane, and the lanes that [`Collision::solve`] accepts. The others have the numbers of [`Collision::evaluate`]; solve such a
    /// collision by itself for the reasons.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn solve_lanes(&self) -> (Impact<Lanes<N>>, LaneMask<N>) {
        let contact = self.contact();
        let impact = self.impact_at(&contact);
        let possible = self.is_possible(&contact, &impact);
        (impact, possible)
    }
}

fn party<const N: usize>(rows: &[Collision; N], side: Side) -> Option<Party<Lanes<N>>> {
    let of = |row: &Collision| match side {
        Side::One => row.one,
        Side::Two => row.two,
    };
    if rows.iter().all(|row| of(row) == Party::Barrier) {
        return Some(Party::Barrier);
    }
    let mut vehicles = [Vehicle::default(); N];
    for (vehicle, row) in vehicles.iter_mut().zip(rows) {
        *vehicle = *of(row).vehicle()?;
    }
    Some(Party::Vehicle(Vehicle {
        mass: gather!(vehicles, mass),
        yaw_inertia: gather!(vehicles, yaw_inertia),
        heading: Heading { cos: gather!(vehicles, heading.cos), sin: gather!(vehicles, heading.sin) },
        impact_center: ForwardLeft { forward: gather!(vehicles, impact_center.forward), left: gather!(vehicles, impact_center.left) },
        motion: Motion {
            velocity: Xy { x: gather!(vehicles, motion.velocity.x), y: gather!(vehicles, motion.velocity.y) },
            yaw_rate: gather!(vehicles, motion.yaw_rate),
        },
    }))
}

impl<const N: usize> Impact<Lanes<N>> {
    /// Returns the impact of each lane.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn scatter(&self) -> [Impact; N] {
        array::from_fn(|lane| self.map(|number| number.0[lane]))
    }
}
