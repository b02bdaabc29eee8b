//! Warnings about rows, each once: sizes that no road vehicle has, and doubtful results.

use super::row::RowVehicle;
use crate::case::ContactInputs;
use crate::notice::Notice;
use crate::units::Units;
use crate::unusual;

/// A warning about one row or more: a size that no road vehicle has, or a result that deserves a second look.
#[derive(Clone, Debug, PartialEq)]
pub struct RowWarning {
    /// The first of these rows, counted from 0.
    pub first: usize,
    /// Their number.
    pub rows: usize,
    /// The warning about the first.
    pub notice: Notice,
}

impl RowWarning {
    /// Returns `true` if both are about the same thing of the same vehicle or contact.
    pub fn is_alike(&self, other: &RowWarning) -> bool {
        self.notice.is_alike(&other.notice)
    }

    /// Returns the same of a part whose rows come after others of the table.
    pub fn after(self, rows: usize) -> RowWarning {
        RowWarning { first: rows + self.first, ..self }
    }

    /// Returns the warning as a sentence in SI, with the name of its first row and the number of the others.
    pub fn sentence(&self, first: &str) -> String {
        let others = if self.rows > 1 { format!(", and {} more", self.rows - 1) } else { String::new() };
        format!("{} ({first}{others})", Units::Si.sentence(&self.notice.message))
    }

    /// Returns each warning of the parts of a table once, with its first row.
    pub fn merged(mut of_parts: Vec<RowWarning>) -> Vec<RowWarning> {
        of_parts.sort_by_key(|warning| warning.first);
        let mut merged = Vec::new();
        of_parts.into_iter().for_each(|warning| warning.add(&mut merged));
        merged
    }

    /// Adds later rows to a list that has each warning once.
    pub fn add(self, to: &mut Vec<RowWarning>) {
        match to.iter_mut().find(|known| known.is_alike(&self)) {
            Some(known) => known.rows += self.rows,
            None => to.push(self),
        }
    }
}

/// Returns the warnings about the sizes of a row.
pub(super) fn of_sizes(vehicles: &[Option<RowVehicle>; 2], contact: &ContactInputs) -> impl Iterator<Item = Notice> {
    let of_vehicles = vehicles.iter().zip(["vehicle.1", "vehicle.2"]).filter_map(|(vehicle, path)| Some((vehicle.as_ref()?, path)));
    of_vehicles.flat_map(|(vehicle, path)| of_vehicle(vehicle, path)).chain(unusual::friction(&contact.impulse_ratio))
}

/// Returns the warning of a row in which no input has a cell.
pub(super) fn empty_row() -> Notice {
    Notice::warning(
        "empty-row",
        "",
        "no input of the row has a number, so that it is the case itself; remove it if it is none of the table",
    )
}

fn of_vehicle(vehicle: &RowVehicle, path: &str) -> impl Iterator<Item = Notice> + use<> {
    let RowVehicle { mass, inertia, velocity, yaw_rate, impact_center, .. } = vehicle;
    unusual::sizes(path, *mass, inertia.of(*mass), *velocity, *yaw_rate, impact_center.length())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_row_of_any_part_is_kept() {
        let size = |first: usize, path: &str, message: &'static str| RowWarning {
            first,
            rows: 1,
            notice: Notice::warning("unusual-mass", path, message),
        };
        let merged = RowWarning::merged(vec![size(9, "vehicle.1", "of 9"), size(7, "vehicle.2", "of 7"), size(3, "vehicle.1", "of 3")]);
        assert_eq!(merged, [RowWarning { rows: 2, ..size(3, "vehicle.1", "of 3") }, size(7, "vehicle.2", "of 7")]);
    }
}
