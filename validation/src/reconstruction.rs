//! Table B2: speeds and energies from the residual crush of the crabbed tests, by CRASH3 and by planar impact mechanics.

use crate::barrier::MPH;
use crate::data::DataError;
use crate::entries::{Entries, GivenColumn, Nature};
use crate::geometry::{Geometry, Wall, solve};
use crate::impulses::Measurements;
use crate::series::{CrabbedTest, Cumulative, Restitution, Series};
use crate::sheet::Sheet;
use planar_impact::Impact;
use planar_impact::crash3::{DamagedPair, VehicleEstimate};
use planar_impact::crush::{ProfileMoments, speed_of_energy};

pub(crate) const TABLE_B2: &str = "Table B2";

/// The CRASH3 result from the crush: no restitution, and a point mass.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Crash3 {
    /// Crush energy, normal to the car's front.
    pub(crate) normal: f64,
    /// Crush energy with the correction 1 + tan² α, where α is the direction of the impulse at e = 0.
    pub(crate) total: f64,
    /// ΔV from the uncorrected crush energy and the whole mass, as printed in the paper.
    pub(crate) delta_v: f64,
    /// ΔV from the corrected energy and the effective mass, as in CRASH3's algorithm.
    pub(crate) algorithm_delta_v: f64,
    /// γ = k²/(k² + h²), the ratio of effective mass to mass.
    pub(crate) effective_mass_factor: f64,
}

/// One row: the crush of a test, with one restitution.
#[derive(Clone, Debug)]
pub(crate) struct Reconstruction {
    pub(crate) cumulative: Cumulative,
    /// E* = d₀ + d₁ C_avg.
    pub(crate) intensity_of_crush: f64,
    pub(crate) crash3: Crash3,
    /// The same crabbed impact at the speed at which the normal work equals the crush energy.
    pub(crate) planar: Impact,
}

/// Returns the crabbed impact whose normal work is a crush energy. Works are proportional to the square of the speed.
fn planar(geometry: &Geometry, test: &CrabbedTest, restitution: Restitution, wall: Wall, crush_energy: f64) -> Result<Impact, DataError> {
    let name = format!("{TABLE_B2}, {}", test.label(restitution));
    let at = |speed: f64| solve(&geometry.crabbed(speed, test.restitution_in(restitution), wall), &name);
    let speed = test.speed.value();
    let share = crush_energy / -at(speed)?.work.n;
    at(speed * share.sqrt())
}

/// Returns CRASH3's estimate for a crabbed car, with the direction of force of the impulse at e = 0.
fn crash3(geometry: &Geometry, test: &CrabbedTest, wall: Wall, crush_energy: f64) -> Result<VehicleEstimate, DataError> {
    let collision = geometry.crabbed(test.speed.value(), 0.0, wall);
    // The wall has no crush; the body that the paper uses instead is so heavy that its effective mass does not matter.
    let car = DamagedPair { two: None, ..DamagedPair::of_collision(&collision, [crush_energy, 0.0]) };
    let refused = |reasons: String| DataError::Refused { collision: format!("{TABLE_B2}, CRASH3, test {}", test.name), reasons };
    let estimate = car.solve().map_err(|reasons| refused(reasons.to_string()))?;
    estimate.one.ok_or_else(|| refused("no vehicle".into()))
}

impl Reconstruction {
    pub(crate) fn of(geometry: &Geometry, series: &Series, which: usize, restitution: Restitution, wall: Wall) -> Result<Self, DataError> {
        let test = &series.tests[which];
        let profile = ProfileMoments::of(geometry.crush_width, &[test.depth, test.depth]).expect("two depths are a profile");
        let energy = geometry.crush.crush_energy(profile);
        let estimate = crash3(geometry, test, wall, energy)?;
        Ok(Reconstruction {
            cumulative: series.cumulative(geometry, which, restitution),
            intensity_of_crush: geometry.crush.crush_intensity(test.depth),
            crash3: Crash3 {
                normal: energy,
                total: estimate.corrected_energy,
                delta_v: speed_of_energy(energy, geometry.barrier_mass),
                algorithm_delta_v: estimate.delta_v_magnitude,
                effective_mass_factor: estimate.effective_mass_factor,
            },
            planar: planar(geometry, test, restitution, wall, energy)?,
        })
    }
}

/// Every test with and without restitution: `[test][restitution]`, in the order of [`Restitution::BOTH`].
#[derive(Clone, Debug)]
pub(crate) struct Reconstructions(Vec<[Reconstruction; 2]>);

impl Reconstructions {
    pub(crate) fn of(geometry: &Geometry, series: &Series, wall: Wall) -> Result<Self, DataError> {
        let both = |which| {
            let [none, measured] = Restitution::BOTH.map(|restitution| Reconstruction::of(geometry, series, which, restitution, wall));
            Ok([none?, measured?])
        };
        (0..series.tests.len()).map(both).collect::<Result<_, _>>().map(Reconstructions)
    }

    pub(crate) fn get(&self, which: usize, restitution: Restitution) -> &Reconstruction {
        &self.0[which][restitution as usize]
    }
}

/// Computes Table B2: 6 rows of up to twenty-two cells; a row omits values printed in an earlier row of its test.
pub(crate) fn table_b2(
    geometry: &Geometry,
    series: &Series,
    reconstructions: &Reconstructions,
    measurements: &Measurements<'_>,
    text: &str,
) -> Result<Entries, DataError> {
    const FILE: &str = "tableB2.csv";
    const DEPTH: GivenColumn = GivenColumn { header: "C_avg", column: "C_avg", unit: "ft", nature: Nature::Measured };
    let sheet = Sheet::read(FILE, text)?;
    let mut entries = Entries::of(TABLE_B2, &sheet, &["test"]);
    for row in sheet.rows() {
        let name = row.text("test")?;
        let unknown = |column, field: &str| DataError::UnknownWord { file: FILE, column, field: field.to_owned() };
        let which = series.place(name).ok_or_else(|| unknown("test", name))?;
        let test = &series.tests[which];
        let e = row.number("e")?;
        let fits = |restitution: &Restitution| test.restitution_in(*restitution) == e.value();
        let restitution = Restitution::BOTH.into_iter().find(fits).ok_or_else(|| unknown("e", e.text()))?;
        let label = test.label(restitution);
        measurements.carry(&mut entries, &row, &label, name)?;
        entries.give(&row, &label, &[DEPTH])?;
        let found = reconstructions.get(which, restitution);
        for (header, column, unit, value) in columns(geometry, test, found) {
            if let Some(printed) = row.number_if_any(header)? {
                entries.compute(&label, column, unit, printed, value);
            }
        }
    }
    Ok(entries)
}

/// A column's header in the text, its name in reports, its unit and its value in one row.
pub(crate) type Column = (&'static str, &'static str, &'static str, f64);

pub(crate) fn columns(geometry: &Geometry, test: &CrabbedTest, found: &Reconstruction) -> [Column; 19] {
    let Reconstruction { cumulative, intensity_of_crush, crash3, planar } = found;
    let speed = test.speed.value();
    let velocity = geometry.crabbed_velocity(speed);
    let delta_v = planar.one.delta_v_magnitude();
    [
        ("vi", "v_i", "ft/s", speed),
        ("vn", "v_n", "ft/s", velocity.x),
        ("vt", "v_t", "ft/s", velocity.y),
        ("Ti", "T_i", "ft lb", geometry.barrier_mass * speed * speed / 2.0),
        ("Ec_cumulative", "test_E_C", "ft lb", cumulative.energy),
        ("EES_ftps", "test_EES", "ft/s", cumulative.equivalent_speed),
        ("sqrt_2Ec_over_w", "test_E*", "lbf^0.5", cumulative.intensity),
        ("Estar", "E*", "lbf^0.5", *intensity_of_crush),
        ("crash3_TLn", "crash3_T_Ln", "ft lb", crash3.normal),
        ("crash3_TLt", "crash3_T_Lt", "ft lb", crash3.total - crash3.normal),
        ("crash3_TL", "crash3_T_L", "ft lb", crash3.total),
        ("pim_TLn", "planar_T_Ln", "ft lb", -planar.work.n),
        ("pim_TLt", "planar_T_Lt", "ft lb", -planar.work.t),
        ("pim_TL", "planar_T_L", "ft lb", planar.loss()),
        ("pim_mu", "planar_mu", "1", planar.critical_impulse_ratio().abs()),
        ("crash3_dv_ftps", "crash3_dv_ftps", "ft/s", crash3.delta_v),
        ("crash3_dv_mph", "crash3_dv_mph", "mph", crash3.delta_v * MPH),
        ("pim_dv_ftps", "planar_dv_ftps", "ft/s", delta_v),
        ("pim_dv_mph", "planar_dv_mph", "mph", delta_v * MPH),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::Texts;

    fn found(which: usize, restitution: Restitution) -> (Geometry, Reconstruction) {
        let texts = Texts::embedded();
        let geometry = Geometry::read(texts.geometry).expect("embedded");
        let series = Series::read(texts.table_b1, texts.table_b2).expect("embedded");
        let found = Reconstruction::of(&geometry, &series, which, restitution, Wall::Fixed).expect("possible");
        (geometry, found)
    }

    #[test]
    fn the_normal_work_is_the_crush_energy() {
        for (which, restitution) in [(0, Restitution::None), (1, Restitution::Measured), (2, Restitution::Measured)] {
            let (geometry, found) = found(which, restitution);
            assert!((-found.planar.work.n / found.crash3.normal - 1.0).abs() < 1e-12, "{which}");
            // ½ w E*², with E* from the line of the same depth.
            let energy = geometry.crush_width * found.intensity_of_crush.powi(2) / 2.0;
            assert!((found.crash3.normal / energy - 1.0).abs() < 1e-12, "{which}");
        }
    }

    #[test]
    fn the_velocity_change_follows_from_the_crush_energy_in_closed_form() {
        // Without lateral offset ΔV = √(2 E_C/m) (1 + e)/√(1 − e²) √(1 + μ₀²), with e = 0.13 of Table B2's test 2.
        let (geometry, found) = found(1, Restitution::Measured);
        let (e, mu) = (0.13_f64, found.planar.critical_impulse_ratio());
        let expected =
            (2.0 * found.crash3.normal / geometry.barrier_mass).sqrt() * (1.0 + e) / (1.0 - e * e).sqrt() * (1.0 + mu * mu).sqrt();
        assert!((found.planar.one.delta_v_magnitude() / expected - 1.0).abs() < 1e-12);
    }

    #[test]
    fn a_point_mass_of_the_corrected_energy_is_the_planar_result_without_restitution() {
        let (_, found) = found(2, Restitution::None);
        let point_mass = found.crash3.algorithm_delta_v / found.crash3.effective_mass_factor.sqrt();
        assert!((point_mass / found.planar.one.delta_v_magnitude() - 1.0).abs() < 1e-12);
        // Its energy differs, because it ignores the rotation of the car. The effective mass includes it: γ = k²/(k²
        // + h²), with geometry.csv's arm of 4.5 ft.
        assert!(found.planar.loss() / found.crash3.total > 1.07);
        let arm = 4.5 * found.planar.critical_impulse_ratio().atan().sin();
        assert!((found.crash3.effective_mass_factor - 1866.2 / (1866.2 + 101.91 * arm * arm)).abs() < 1e-12);
    }
}
