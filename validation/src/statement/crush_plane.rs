//! Statements of Table 2 and its text about the crush plane Γ.

use super::{Standing, Statement, largest};
use crate::account::{Computed, find, value};
use crate::data::DataError;
use crate::geometry::{Geometry, solve};
use crate::perpendicular::turned;
use planar_impact::{Impact, Xy};

const PLACE: &str = "after Table 2";

pub(super) fn statements(geometry: &Geometry, cells: &[Computed]) -> Result<Vec<Statement>, DataError> {
    Ok(vec![
        rows_add_up(cells),
        loss_does_not_depend_on_the_crush_plane(geometry)?,
        velocities_do_not_depend_on_the_crush_plane(geometry)?,
        works_are_almost_linear(cells),
        works_change_by_ten_to_twenty_percent(cells),
    ])
}

fn at(geometry: &Geometry, gamma_degrees: f64, restitution: f64) -> Result<Impact, DataError> {
    solve(&geometry.perpendicular(turned(gamma_degrees, restitution)), &format!("position A, Γ = {gamma_degrees}°, e = {restitution}"))
}

fn rows_add_up(cells: &[Computed]) -> Statement {
    let rows = cells.iter().filter(|cell| cell.column == "W_n").map(|cell| {
        let total = |get: fn(&Computed) -> f64| get(cell) + find(cells, &cell.row, "W_t").map_or(f64::NAN, get);
        (cell.row.as_str(), total(|c| c.value), total(|c| c.printed.value()))
    });
    let rows = rows.collect::<Vec<_>>();
    // Two roundings of half a tenth, plus the error of the recovered geometry.
    let off = rows.iter().filter(|(_, computed, printed)| (printed - computed).abs() >= 0.25 || printed.is_nan());
    let off = off.map(|(row, computed, printed)| (*row, printed - computed)).collect::<Vec<_>>();
    let most = largest(rows.iter().map(|row| row.1));
    let least = -largest(rows.iter().map(|row| -row.1));
    let short = off.iter().map(|(row, by)| format!("Γ = {row}° by {by:.2}")).collect::<Vec<_>>().join(", ");
    Statement {
        name: "rows of Table 2 add up to the same loss",
        place: "this crate",
        says: "W_n + W_t is the same in every row of Table 2, and so it is in print",
        found: format!("computed: {least:.2} ft lb in every row; in print all rows but: {short}"),
        standing: Standing::conditional(
            rows.len() == 13 && most - least < 1e-6 && off.iter().all(|(row, by)| *row == "-2" && (by - 8.0).abs() < 0.1),
            off.is_empty(),
        ),
        expected: Standing::HoldsConditionally,
    }
}

/// Returns the range of the loss over all Γ that the library accepts, relative to the loss at Γ = 0, and the number of those Γ.
fn spread(geometry: &Geometry, restitution: f64) -> Result<(f64, usize), DataError> {
    let nominal = at(geometry, 0.0, restitution)?.loss();
    // The plane must face both vehicles: beyond some angle the collision is impossible.
    let losses = (0..180).filter_map(|degrees| Some(at(geometry, f64::from(degrees), restitution).ok()?.loss())).collect::<Vec<_>>();
    let most = largest(losses.iter().copied());
    let least = -largest(losses.iter().map(|loss| -loss));
    Ok(((most - least) / nominal, losses.len()))
}

fn loss_does_not_depend_on_the_crush_plane(geometry: &Geometry) -> Result<Statement, DataError> {
    let (inelastic, planes) = spread(geometry, 0.0)?;
    let (elastic, planes_elastic) = spread(geometry, 0.3)?;
    Ok(Statement {
        name: "loss does not depend on the crush plane",
        place: PLACE,
        says: "as Γ changes from 0° to 180°, the total amount of energy lost remains constant and is independent of Γ",
        found: format!(
            "at e = 0 it varies by {inelastic:.0e} of itself over the {planes} whole degrees that are possible; at e = 0.3 by {:.1} %, over {planes_elastic}: the condition e = 0, μ = μ0 is missing here",
            elastic * 100.0
        ),
        standing: Standing::conditional(inelastic < 1e-12 && planes > 90, elastic < 1e-12),
        expected: Standing::HoldsConditionally,
    })
}

fn velocities_do_not_depend_on_the_crush_plane(geometry: &Geometry) -> Result<Statement, DataError> {
    let turn = |restitution: f64| -> Result<f64, DataError> {
        let nominal = at(geometry, 0.0, restitution)?;
        let mut differences = Vec::new();
        for degrees in -10..=10 {
            let impact = at(geometry, f64::from(degrees), restitution)?;
            let responses = [(impact.one, nominal.one), (impact.two, nominal.two)];
            differences.extend(responses.map(|(is, was)| {
                let change: Xy = is.after.velocity - was.after.velocity;
                change.length() + (is.after.yaw_rate - was.after.yaw_rate).abs()
            }));
        }
        Ok(largest(differences))
    };
    let (inelastic, elastic) = (turn(0.0)?, turn(0.3)?);
    Ok(Statement {
        name: "velocities do not depend on the crush plane",
        place: "before the example",
        says: "under the common velocity conditions the velocities are independent of the selection of Γ",
        found: format!("for Γ from -10° to 10° they differ by {inelastic:.0e} ft/s and rad/s at e = 0, and by {elastic:.2} at e = 0.3"),
        standing: Standing::of(inelastic < 1e-10),
        expected: Standing::Holds,
    })
}

fn works_are_almost_linear(cells: &[Computed]) -> Statement {
    // Deviation of the value at Γ = 0 from the mean of those at ±5°, relative to their difference.
    let bend = |column| {
        let [low, middle, high] = ["-5", "0", "5"].map(|row| value(cells, row, column));
        ((middle - (low + high) / 2.0) / (high - low)).abs()
    };
    let most = largest([bend("W_n"), bend("W_t")]);
    Statement {
        name: "works are almost linear in the crush plane",
        place: PLACE,
        says: "the trends of W_n and W_t are essentially linear for Γ from -5° to 5°",
        found: format!("they bend by {:.2} % of their change over that range", most * 100.0),
        standing: Standing::of(most < 0.02),
        expected: Standing::Holds,
    }
}

fn works_change_by_ten_to_twenty_percent(cells: &[Computed]) -> Statement {
    let change = |row: &str, column| (value(cells, row, column) / value(cells, "0", column) - 1.0).abs() * 100.0;
    let [n_5, t_5, n_10, t_10] = [(5, "W_n"), (5, "W_t"), (10, "W_n"), (10, "W_t")]
        .map(|(degrees, column)| largest([format!("-{degrees}"), degrees.to_string()].map(|row| change(&row, column))));
    Statement {
        name: "works change by 10 to 20 percent",
        place: PLACE,
        says: "changes in Γ of 5° or more give rise to changes in W_n and W_t on the order of 10 % to 20 %",
        found: format!("up to {n_5:.1} % of W_n and {t_5:.1} % of W_t at 5°, up to {n_10:.1} % and {t_10:.1} % at 10°"),
        // "On the order of 20 %" is interpreted as less than 25 %.
        standing: Standing::conditional(largest([n_5, t_5]) < 25.0, largest([n_10, t_10]) < 25.0),
        expected: Standing::HoldsConditionally,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::Texts;
    use crate::perpendicular::table_2;

    #[test]
    fn a_corrected_row_adds_up() {
        let texts = Texts::embedded();
        let geometry = Geometry::read(texts.geometry).expect("embedded");
        let standing = |text: &str| rows_add_up(&table_2(&geometry, text).expect("digits").computed).standing;
        assert_eq!(standing(texts.table_2), Standing::HoldsConditionally);
        // The misprint of Γ = −2°, corrected.
        assert_eq!(standing(&texts.table_2.replace("-21631.2", "-21639.2")), Standing::Holds);
        // Another misprint.
        assert_eq!(standing(&texts.table_2.replace("-20758.8", "-20758.3")), Standing::Fails);
    }

    #[test]
    fn nothing_holds_of_no_table() {
        for statement in [rows_add_up(&[]), works_are_almost_linear(&[]), works_change_by_ten_to_twenty_percent(&[])] {
            assert_eq!(statement.standing, Standing::Fails, "{}", statement.name);
        }
    }
}
