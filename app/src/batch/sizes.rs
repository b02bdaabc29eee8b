//! Rows with sizes that no road vehicle has.

use planar_impact::ImpulseRatio;

use super::row::RowVehicle;
use crate::case::{ContactInputs, Velocity};
use crate::notice::Notice;
use crate::unusual;

/// A size that no road vehicle has, in one row or more.
#[derive(Clone, Debug, PartialEq)]
pub struct Unusual {
    /// The first of these rows, counted from 0.
    pub first: usize,
    /// Their number.
    pub rows: usize,
    /// The warning about the first.
    pub warning: Notice,
}

impl Unusual {
    /// Adds later rows to a list that has each size once.
    pub fn add(self, to: &mut Vec<Unusual>) {
        let is_same = |known: &&mut Unusual| (known.warning.code, &known.warning.path) == (self.warning.code, &self.warning.path);
        match to.iter_mut().find(is_same) {
            Some(known) => known.rows += self.rows,
            None => to.push(self),
        }
    }
}

/// Returns the warnings about the sizes of a row.
pub(super) fn of_row(vehicles: &[Option<RowVehicle>; 2], contact: &ContactInputs) -> impl Iterator<Item = Notice> {
    let of_vehicles = vehicles.iter().zip(["vehicle.1", "vehicle.2"]).filter_map(|(vehicle, path)| Some((vehicle.as_ref()?, path)));
    let friction = match contact.impulse_ratio {
        ImpulseRatio::LimitedByFriction(friction) => unusual::friction("contact.friction", friction),
        _ => None,
    };
    of_vehicles.flat_map(|(vehicle, path)| of_vehicle(vehicle, path).into_iter().flatten()).chain(friction)
}

fn of_vehicle(vehicle: &RowVehicle, path: &str) -> [Option<Notice>; 5] {
    let RowVehicle { mass, inertia, velocity, yaw_rate, impact_center, .. } = vehicle;
    let speed = match velocity {
        Velocity::Speed(speed) => *speed,
        Velocity::Components(velocity) => velocity.length(),
    };
    [
        unusual::mass(path, *mass),
        unusual::radius_of_gyration(path, (inertia.of(*mass) / mass).sqrt()),
        unusual::arm(path, impact_center.length()),
        unusual::speed(path, speed),
        unusual::yaw_rate(path, *yaw_rate),
    ]
}
