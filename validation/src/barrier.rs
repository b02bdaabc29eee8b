//! Table B1: a car crabbed by 30° against a barrier, in three tests.

use crate::account::Computed;
use crate::data::DataError;
use crate::entries::{Entries, GivenColumn, Nature};
use crate::geometry::{Geometry, Wall, solve};
use crate::impulses::Measurements;
use crate::sheet::Sheet;
use planar_impact::{Collision, Impact, Party};

pub(crate) const TABLE_B1: &str = "Table B1";

/// Miles per hour in one foot per second.
pub(crate) const MPH: f64 = 15.0 / 22.0;

/// Computes Table B1: 6 rows of eleven cells.
pub(crate) fn table_b1(geometry: &Geometry, text: &str, wall: Wall) -> Result<Vec<Computed>, DataError> {
    let mut cells = Vec::new();
    for row in Sheet::read("tableB1.csv", text)?.rows() {
        let (speed, restitution) = (row.number("vi")?, row.number("e")?);
        let label = format!("{} {}", row.text("test")?, restitution.text());
        let collision = geometry.crabbed(speed.value(), restitution.value(), wall);
        let impact = solve(&collision, &format!("{TABLE_B1}, {label}"))?;
        let mut cell = |column, unit, printed, value| {
            cells.push(Computed { table: TABLE_B1, row: label.clone(), column, unit, printed, value });
        };
        let velocity = geometry.crabbed_velocity(speed.value());
        cell("v_n", "ft/s", row.number("vn")?, velocity.x);
        cell("v_t", "ft/s", row.number("vt")?, velocity.y);
        cell("T_i", "ft lb", row.number("Ti")?, impact.kinetic_energy.before);
        // All eighteen energy losses end in zero, so the second decimal is filler.
        cell("T_Ln", "ft lb", row.number("TLn")?.without_filler(), -impact.work.n);
        cell("T_Lt", "ft lb", row.number("TLt")?.without_filler(), -impact.work.t);
        cell("T_L", "ft lb", row.number("TL")?.without_filler(), impact.loss());
        // Printed as a magnitude.
        cell("mu", "1", row.number("mu")?, impact.critical_impulse_ratio().abs());
        cell("omega", "deg/s", row.number("omega")?, yaw_rate(&impact));
        let delta_v = impact.one.delta_v_magnitude();
        cell("dv_ftps", "ft/s", row.number("dv_ftps")?, delta_v);
        cell("dv_mph", "mph", row.number("dv_mph")?, delta_v * MPH);
        cell("pdof", "deg", row.number("pdof_deg")?, impact.one.principal_direction_of_force().to_degrees().abs());
    }
    Ok(cells)
}

/// Collects all cells of Table B1: those above, those repeated from Tables 3 and 4, and those that are not computed.
pub(crate) fn entries(computed: &[Computed], measurements: &Measurements<'_>, text: &str) -> Result<Entries, DataError> {
    const GIVEN: [GivenColumn; 3] = [
        GivenColumn { header: "vi", column: "v_i", unit: "ft/s", nature: Nature::Measured },
        GivenColumn { header: "omega_test", column: "test_omega", unit: "deg/s", nature: Nature::Measured },
        GivenColumn { header: "dv_test_mph", column: "test_dv_mph", unit: "mph", nature: Nature::Measured },
    ];
    let sheet = Sheet::read("tableB1.csv", text)?;
    let mut entries = Entries::of(TABLE_B1, &sheet, &["test"]);
    for row in sheet.rows() {
        let (test, e) = (row.text("test")?, row.number("e")?);
        let label = format!("{test} {}", e.text());
        entries.give(&row, &label, &GIVEN)?;
        measurements.carry(&mut entries, &row, &label, test)?;
    }
    entries.computed.extend_from_slice(computed);
    Ok(entries)
}

fn yaw_rate(impact: &Impact) -> f64 {
    impact.one.after.yaw_rate.to_degrees().abs()
}

/// Returns the ratio of a party's mass to that of the vehicle, if it is a vehicle.
pub(crate) fn vehicle_masses(collision: &Collision) -> Option<f64> {
    let mass = |party: &Party| party.vehicle().map(|vehicle| vehicle.mass);
    Some(mass(&collision.two)? / mass(&collision.one)?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::Texts;
    use crate::sheet::Printed;

    fn cells(wall: Wall) -> Vec<Computed> {
        let texts = Texts::embedded();
        let geometry = Geometry::read(texts.geometry).expect("embedded");
        table_b1(&geometry, texts.table_b1, wall).expect("embedded")
    }

    #[test]
    fn the_energy_losses_end_in_filler() {
        let losses = cells(Wall::Fixed).into_iter().filter(|cell| cell.column.starts_with("T_L")).map(|cell| cell.printed);
        let losses = losses.collect::<Vec<_>>();
        assert_eq!(losses.len(), 18);
        assert!(losses.iter().all(|printed| printed.text().ends_with('0') && printed.half_unit() == 0.05));
    }

    #[test]
    fn the_normal_loss_is_that_of_the_normal_speed() {
        // The arm has no lateral part: T_Ln = ½ m v_n² (1 − e²), with geometry.csv's mass and Table B1's test 1.
        let loss = |row: &str| cells(Wall::Fixed).into_iter().find(|c| c.row == row && c.column == "T_Ln").map_or(f64::NAN, |c| c.value);
        let normal = 19.23 * 0.75_f64.sqrt();
        assert!((loss("1 0.00") / (0.5 * 101.91 * normal * normal) - 1.0).abs() < 1e-12);
        assert!((loss("1 0.18") / (0.5 * 101.91 * normal * normal * (1.0 - 0.18 * 0.18)) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn a_heavy_body_is_almost_a_barrier() {
        // The normal loss differs by 1/9813, everything else by less.
        for (fixed, heavy) in cells(Wall::Fixed).iter().zip(cells(Wall::Papers)) {
            assert!((fixed.value / heavy.value - 1.0).abs() < 1.1e-4, "{} {}", fixed.row, fixed.column);
        }
    }

    #[test]
    fn with_the_papers_wall_the_cells_agree_to_the_last_digit() {
        // Except for the two columns that the paper computes from its rounded cells (T_L, dv_mph), and with the misprint corrected.
        let mut agreeing = 0;
        for cell in cells(Wall::Papers).into_iter().filter(|cell| cell.column != "T_L" && cell.column != "dv_mph") {
            let misprinted = cell.row == "2 0.13" && cell.column == "T_Ln";
            let printed = if misprinted { Printed::parse("43197.3").expect("digits") } else { cell.printed };
            assert!(printed.agrees_with(cell.value), "{} {}: {} for {}", cell.row, cell.column, cell.value, printed.text());
            agreeing += 1;
        }
        assert_eq!(agreeing, 54);
    }
}
