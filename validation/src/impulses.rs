//! Tables 3 and 4: measurements of the crabbed tests, and ratios and means computed from them.

use crate::account::{Computed, value};
use crate::data::DataError;
use crate::entries::{Entries, GivenColumn, Nature};
use crate::sheet::{Row, Sheet};
use planar_impact::Nt;
use planar_impact::barrier::{TestIssues, impulse_ratio};

pub(crate) const TABLE_3: &str = "Table 3";
pub(crate) const TABLE_4: &str = "Table 4";

const fn measured(header: &'static str, column: &'static str, unit: &'static str) -> GivenColumn {
    GivenColumn { header, column, unit, nature: Nature::Measured }
}

const IMPULSES: [GivenColumn; 3] =
    [measured("left_Ns", "left", "N s"), measured("right_Ns", "right", "N s"), measured("wing_Ns", "wing", "N s")];

const RESTITUTIONS: [GivenColumn; 2] = [measured("rigid_body_kinematics", "kinematics", "1"), measured("film_analysis", "film", "1")];

/// Computes Table 3: the impulses on the load cells of main barrier and wing. The normal impulse is that of both
/// halves; the ratio is that of the wing to it.
pub(crate) fn table_3(text: &str) -> Result<Entries, DataError> {
    let sheet = Sheet::read("table3.csv", text)?;
    let mut entries = Entries::of(TABLE_3, &sheet, &["test"]);
    for row in sheet.rows() {
        let label = row.text("test")?;
        entries.give(&row, label, &IMPULSES)?;
        let [left, right, wing] = [row.number("left_Ns")?, row.number("right_Ns")?, row.number("wing_Ns")?].map(|impulse| impulse.value());
        entries.compute(label, "normal", "N s", row.number("normal_Ns")?, left + right);
        let refused =
            |reasons: TestIssues| DataError::Refused { collision: format!("{TABLE_3}, test {label}"), reasons: reasons.to_string() };
        let ratio = impulse_ratio(Nt { n: left + right, t: wing }).map_err(refused)?;
        entries.compute(label, "ratio", "1", row.number("impulse_ratio")?, ratio);
    }
    Ok(entries)
}

/// Computes Table 4: restitution by two methods, and their mean.
pub(crate) fn table_4(text: &str) -> Result<Entries, DataError> {
    let sheet = Sheet::read("table4.csv", text)?;
    let mut entries = Entries::of(TABLE_4, &sheet, &["test"]);
    for row in sheet.rows() {
        let label = row.text("test")?;
        entries.give(&row, label, &RESTITUTIONS)?;
        let mean = (row.number("rigid_body_kinematics")?.value() + row.number("film_analysis")?.value()) / 2.0;
        entries.compute(label, "mean", "1", row.number("average")?, mean);
    }
    Ok(entries)
}

/// Values that other tables take from these two.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Measurements<'a> {
    pub(crate) table_3: &'a [Computed],
    pub(crate) table_4: &'a [Computed],
}

impl Measurements<'_> {
    /// Adds the cells of a row that come from these tables: the measured ratio, and the restitution if it is measured; e = 0 is chosen.
    pub(crate) fn carry(&self, entries: &mut Entries, row: &Row<'_>, label: &str, test: &str) -> Result<(), DataError> {
        const CHOSEN: GivenColumn = GivenColumn { header: "e", column: "e", unit: "1", nature: Nature::Chosen };
        let e = row.number("e")?;
        if e.value() == 0.0 {
            entries.give(row, label, &[CHOSEN])?;
        } else {
            entries.compute(label, "e", "1", e, value(self.table_4, test, "mean"));
        }
        if let Some(ratio) = row.number_if_any("mu_test")? {
            entries.compute(label, "test_mu", "1", ratio, value(self.table_3, test, "ratio"));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::Texts;

    #[test]
    fn the_normal_impulse_is_that_of_both_halves() {
        let table = table_3(Texts::embedded().table_3).expect("embedded");
        // Table 3, test 2: 3301 + 6788, and 2857 for the wing.
        assert_eq!(value(&table.computed, "2", "normal"), 10089.0);
        assert_eq!(value(&table.computed, "2", "ratio"), 2857.0 / 10089.0);
        assert_eq!((table.computed.len(), table.given.len(), table.printed), (6, 9, 15));
    }

    #[test]
    fn the_mean_is_that_of_both_methods() {
        let table = table_4(Texts::embedded().table_4).expect("embedded");
        // Table 4, test 1: 0.111 and 0.256.
        assert!((value(&table.computed, "1", "mean") - 0.1835).abs() < 1e-15);
        assert_eq!((table.computed.len(), table.given.len(), table.printed), (3, 6, 9));
    }
}
