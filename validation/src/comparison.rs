//! Tables 5 and 6: tests, CRASH3 and planar impact mechanics side by side, in two systems of units.

use crate::barrier::MPH;
use crate::data::DataError;
use crate::entries::Entries;
use crate::reconstruction::Reconstructions;
use crate::series::{Restitution, Series};
use crate::sheet::Sheet;

pub(crate) const TABLE_5: &str = "Table 5";
pub(crate) const TABLE_6: &str = "Table 6";

/// Joules in one foot-pound: 0.3048 m times 4.4482216152605 N.
pub(crate) const JOULES: f64 = 0.3048 * 4.448_221_615_260_5;
/// Kilometers per hour in one foot per second.
pub(crate) const KPH: f64 = 0.3048 * 3.6;

/// The values that both tables print for a test, in feet and pounds.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Comparison {
    /// Total crush energy of the tests up to this one, normal to the wall.
    test_energy: f64,
    test_speed: f64,
    /// Crush energy with CRASH3's correction, T_L of Table B2.
    crash3_energy: f64,
    crash3_delta_v: f64,
    /// The total loss, T_L of Table B2.
    planar_energy: f64,
    planar_delta_v: f64,
}

/// Units and headers of a table.
struct Style {
    table: &'static str,
    file: &'static str,
    energy: (&'static str, f64),
    speed: (&'static str, f64),
    /// The headers of energy and speed for the test, CRASH3 and planar impact mechanics.
    headers: [(&'static str, &'static str); 3],
}

const US: Style = Style {
    table: TABLE_5,
    file: "table5.csv",
    energy: ("ft lb", 1.0),
    speed: ("mph", MPH),
    headers: [("test_crush_energy_ftlb", "test_ees_mph"), ("crash3_energy_ftlb", "crash3_dv_mph"), ("pim_energy_ftlb", "pim_dv_mph")],
};

const METRIC: Style = Style {
    table: TABLE_6,
    file: "table6.csv",
    energy: ("kJ", JOULES / 1000.0),
    speed: ("km/h", KPH),
    headers: [("test_crush_energy_kJ", "test_ees_kph"), ("crash3_energy_kJ", "crash3_dv_kph"), ("pim_energy_kJ", "pim_dv_kph")],
};

impl Comparison {
    /// Computes the values of a test with the measured restitution; CRASH3 has none.
    fn of(reconstructions: &Reconstructions, which: usize) -> Self {
        let found = reconstructions.get(which, Restitution::Measured);
        Comparison {
            test_energy: found.cumulative.energy,
            test_speed: found.cumulative.equivalent_speed,
            crash3_energy: found.crash3.total,
            crash3_delta_v: found.crash3.delta_v,
            planar_energy: found.planar.loss(),
            planar_delta_v: found.planar.one.delta_v_magnitude(),
        }
    }

    /// Returns energy and speed of the test, CRASH3 and planar impact mechanics, with their column names.
    fn columns(&self) -> [[(&'static str, f64); 2]; 3] {
        [
            [("test_energy", self.test_energy), ("test_EES", self.test_speed)],
            [("crash3_energy", self.crash3_energy), ("crash3_dv", self.crash3_delta_v)],
            [("planar_energy", self.planar_energy), ("planar_dv", self.planar_delta_v)],
        ]
    }
}

/// Computes Table 5: 3 rows of six cells, in ft lb and mph.
pub(crate) fn table_5(series: &Series, reconstructions: &Reconstructions, text: &str) -> Result<Entries, DataError> {
    table(series, reconstructions, text, &US)
}

/// Computes Table 6: the same in kJ and km/h.
pub(crate) fn table_6(series: &Series, reconstructions: &Reconstructions, text: &str) -> Result<Entries, DataError> {
    table(series, reconstructions, text, &METRIC)
}

fn table(series: &Series, reconstructions: &Reconstructions, text: &str, style: &Style) -> Result<Entries, DataError> {
    let sheet = Sheet::read(style.file, text)?;
    let mut entries = Entries::of(style.table, &sheet, &["test"]);
    for row in sheet.rows() {
        let name = row.text("test")?;
        let unknown = || DataError::UnknownWord { file: style.file, column: "test", field: name.to_owned() };
        let which = series.place(name).ok_or_else(unknown)?;
        let columns = Comparison::of(reconstructions, which).columns();
        for ((energy_header, speed_header), [energy, speed]) in style.headers.into_iter().zip(columns) {
            entries.compute(name, energy.0, style.energy.0, row.number(energy_header)?, energy.1 * style.energy.1);
            entries.compute(name, speed.0, style.speed.0, row.number(speed_header)?, speed.1 * style.speed.1);
        }
    }
    Ok(entries)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::account::value;
    use crate::data::Texts;
    use crate::geometry::{Geometry, Wall};

    #[test]
    fn both_tables_are_one_in_other_units() {
        let texts = Texts::embedded();
        let geometry = Geometry::read(texts.geometry).expect("embedded");
        let series = Series::read(texts.table_b1, texts.table_b2).expect("embedded");
        let found = Reconstructions::of(&geometry, &series, Wall::Fixed).expect("possible");
        let us = table_5(&series, &found, texts.table_5).expect("embedded");
        let metric = table_6(&series, &found, texts.table_6).expect("embedded");
        assert_eq!((us.computed.len(), metric.computed.len()), (18, 18));
        for cell in &us.computed {
            // 1 ft lb is 1.3558 J, 1 mph is 1.609344 km/h.
            let factor = if cell.unit == "mph" { 1.609_344 } else { 1.355_817_948e-3 };
            let ratio = value(&metric.computed, &cell.row, cell.column) / cell.value;
            assert!((ratio / factor - 1.0).abs() < 1e-9, "{} {}", cell.row, cell.column);
        }
    }
}
