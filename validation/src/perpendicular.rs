//! Tables 1 and 2: two vehicles at right angles.

use crate::data::DataError;
use crate::entries::{Entries, GivenColumn, Nature};
use crate::geometry::{Geometry, Perpendicular, Position, solve};
use crate::sheet::{Row, Sheet};

pub(crate) const TABLE_1: &str = "Table 1";
pub(crate) const TABLE_2: &str = "Table 2";

/// Computes Table 1: 27 rows of μ₀, W_n and W_t at Γ = 0.
pub(crate) fn table_1(geometry: &Geometry, text: &str) -> Result<Entries, DataError> {
    const FILE: &str = "table1.csv";
    const GIVEN: [GivenColumn; 3] = [chosen("v1x", "v_1x", "ft/s"), chosen("v2y", "v_2y", "ft/s"), chosen("e", "e", "1")];
    let sheet = Sheet::read(FILE, text)?;
    let mut entries = Entries::of(TABLE_1, &sheet, &["position"]);
    for row in sheet.rows() {
        let letter = row.text("position")?;
        let unknown = || DataError::UnknownWord { file: FILE, column: "position", field: letter.to_owned() };
        let position = Position::of_letter(letter).ok_or_else(unknown)?;
        let (v_1x, v_2y, restitution) = (row.number("v1x")?, row.number("v2y")?, row.number("e")?);
        let label = format!("{letter} {} {} {}", v_1x.text(), v_2y.text(), restitution.text());
        let case = Perpendicular { position, v_1x: v_1x.value(), v_2y: v_2y.value(), gamma_degrees: 0.0, restitution: restitution.value() };
        entries.give(&row, &label, &GIVEN)?;
        ratio_and_works(geometry, &mut entries, &label, case, &row)?;
    }
    Ok(entries)
}

const fn chosen(header: &'static str, column: &'static str, unit: &'static str) -> GivenColumn {
    GivenColumn { header, column, unit, nature: Nature::Chosen }
}

/// Computes Table 2: 13 crush planes in position A, at ∓40 and e = 0.
pub(crate) fn table_2(geometry: &Geometry, text: &str) -> Result<Entries, DataError> {
    let sheet = Sheet::read("table2.csv", text)?;
    let mut entries = Entries::of(TABLE_2, &sheet, &[]);
    for row in sheet.rows() {
        let gamma = row.number("gamma_deg")?;
        let case = turned(gamma.value(), 0.0);
        entries.give(&row, gamma.text(), &[chosen("gamma_deg", "gamma", "deg")])?;
        ratio_and_works(geometry, &mut entries, gamma.text(), case, &row)?;
    }
    Ok(entries)
}

/// Returns the collision of Table 2 at a crush plane and a restitution.
pub(crate) fn turned(gamma_degrees: f64, restitution: f64) -> Perpendicular {
    Perpendicular { position: Position::A, v_1x: -40.0, v_2y: 40.0, gamma_degrees, restitution }
}

fn ratio_and_works(geometry: &Geometry, entries: &mut Entries, label: &str, case: Perpendicular, row: &Row<'_>) -> Result<(), DataError> {
    let impact = solve(&geometry.perpendicular(case), &format!("{}, {label}", entries.table))?;
    entries.compute(label, "mu_0", "1", row.number("mu0")?, impact.critical_impulse_ratio());
    entries.compute(label, "W_n", "ft lb", row.number("Wn_ftlb")?, impact.work.n);
    entries.compute(label, "W_t", "ft lb", row.number("Wt_ftlb")?, impact.work.t);
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::account::{Computed, value};
    use crate::data::Texts;

    #[test]
    fn table_2_at_no_turn_is_a_row_of_table_1() {
        let texts = Texts::embedded();
        let geometry = Geometry::read(texts.geometry).expect("embedded");
        let one = table_1(&geometry, texts.table_1).expect("embedded").computed;
        let two = table_2(&geometry, texts.table_2).expect("embedded").computed;
        let pick = |cells: &[Computed], row: &str| {
            cells.iter().filter(|cell| cell.row == row).map(|cell| (cell.printed.clone(), cell.value)).collect::<Vec<_>>()
        };
        assert_eq!(pick(&one, "A -40 40 0.00"), pick(&two, "0"));
        assert_eq!(pick(&two, "0").len(), 3);
    }

    #[test]
    fn position_b_is_a_head_on_impact_of_the_reduced_mass() {
        let texts = Texts::embedded();
        let geometry = Geometry::read(texts.geometry).expect("embedded");
        let cells = table_1(&geometry, texts.table_1).expect("embedded").computed;
        // Both impact centers are on the line of motion of vehicle 1: W_n = −½ m̄ v² (1 − e²), with the printed weights and 40 ft/s.
        let reduced = 2564.0 * 6345.0 / (2564.0 + 6345.0) / 32.2;
        let work = |row: &str| value(&cells, row, "W_n");
        for (row, e) in [("B -40 40 0.00", 0.0), ("B -40 20 0.30", 0.3)] {
            let expected = -0.5 * reduced * 1600.0 * (1.0 - e * e);
            assert!((work(row) / expected - 1.0).abs() < 1e-12, "{row}");
        }
    }

    #[test]
    fn another_position_is_refused() {
        let texts = Texts::embedded();
        let geometry = Geometry::read(texts.geometry).expect("embedded");
        let error = table_1(&geometry, &texts.table_1.replace(",B\n", ",D\n")).err();
        assert_eq!(error, Some(DataError::UnknownWord { file: "table1.csv", column: "position", field: "D".into() }));
    }
}
