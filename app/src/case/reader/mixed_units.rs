//! One table or array in which one number has a unit, and another of the same quantity has none and counts in SI.

use std::collections::BTreeMap;

use super::measured::DISTRIBUTION_KEYS;
use crate::notice::Notice;
use crate::quantity::{Kind, Quantity};

/// The numbers that have been read, by their table and the unit of a number without one.
#[derive(Default)]
pub(super) struct NumbersBeside(BTreeMap<(String, &'static str), Beside>);

/// The first number of each form.
#[derive(Default)]
struct Beside {
    bare: Option<String>,
    /// Its path and its unit.
    with_unit: Option<(String, String)>,
    is_told: bool,
}

impl NumbersBeside {
    /// Adds a number, and warns of the first of a table that has no unit beside one that has another than that of SI. A zero needs none.
    pub(super) fn add(&mut self, path: &str, quantity: &Quantity, kind: Kind) -> Option<Notice> {
        let (table, key) = path.rsplit_once('.')?;
        let Quantity { si, unit, bare, .. } = quantity;
        // Ratios stand beside each other as numbers and in percent, unless one describes the other.
        let is_alone = kind.si.is_empty() && !DISTRIBUTION_KEYS.contains(&key);
        if *si == 0.0 || is_alone || (!bare && unit == kind.si) {
            return None;
        }
        let beside = self.0.entry((table.to_owned(), kind.si)).or_default();
        match bare {
            true => beside.bare.get_or_insert_with(|| path.to_owned()),
            false => &mut beside.with_unit.get_or_insert_with(|| (path.to_owned(), unit.clone())).0,
        };
        let (bare, (other, unit)) = (beside.bare.as_ref()?, beside.with_unit.as_ref()?);
        let is_first = !std::mem::replace(&mut beside.is_told, true);
        is_first.then(|| Notice::mixed_units(bare.as_str(), bare, kind.si, [other, unit]))
    }
}
