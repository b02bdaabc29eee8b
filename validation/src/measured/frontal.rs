//! Full-frontal barrier tests: the stiffness of a car's front computed from one test, and the energy computed back from its crush profile.

use super::{Reading, recorded};
use crate::data::DataError;
use crate::sheet::{Printed, Row, Sheet};
use planar_impact::barrier::{BarrierTest, TestIssues};
use planar_impact::crush::{CrushStiffness, ProfileMoments, speed_of_energy};

const FILE: &str = "nhtsa.csv";

/// One test, in SI.
#[derive(Clone, Debug, PartialEq)]
pub struct Frontal {
    /// Its number.
    pub test: String,
    /// The car.
    pub vehicle: String,
    /// Mean depth over the width, in m.
    pub mean_depth: f64,
    /// b₁, A, B, and d₀, d₁ of the crush line through the test.
    pub coefficients: Vec<Coefficient>,
    /// Energy of the crush profile, compared with the kinetic energy ½ m v², in J.
    pub energy: Reading,
    /// Energy with the stiffness obtained from the profile instead of its mean depth, in J: equal to the energy of
    /// the test, whatever the profile.
    pub energy_by_profile: f64,
    /// Excess of the energy of the profile over that of a flat one with the same mean depth, ½ B ∫ (C − C̄)² dw, in J.
    pub unevenness: f64,
    /// Speed equivalent to the energy of the profile, in m/s.
    pub speed_of_crush: f64,
    /// Speed of the test, in m/s.
    pub speed: Printed,
    /// Reason for the error.
    pub reason: String,
}

/// A coefficient of the crush line.
#[derive(Clone, Debug, PartialEq)]
pub struct Coefficient {
    /// Its symbol.
    pub name: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// The computed value.
    pub computed: f64,
    /// The value published with the test, if any.
    pub published: Option<Printed>,
}

impl Coefficient {
    /// Returns `true` if it rounds to the published value, or if none was published.
    pub fn is_as_published(&self) -> bool {
        self.published.as_ref().is_none_or(|published| published.agrees_with(self.computed))
    }
}

pub(super) fn read(text: &str) -> Result<Vec<Frontal>, DataError> {
    Sheet::read(FILE, text)?.rows().map(|row| one(&row)).collect()
}

fn one(row: &Row<'_>) -> Result<Frontal, DataError> {
    let number = |column| row.number(column).map(|number| number.value());
    let (mass, width, onset, speed) = (number("mass_kg")?, number("width_m")?, number("b0_mps")?, row.number("speed_mps")?);
    let profile = ProfileMoments::of(width, &depths(row)?).ok_or_else(|| no_depths(row))?;
    let mean_depth = profile.mean_depth();
    // The line passes through the test: v = b₀ + b₁ C̄.
    let test = BarrierTest { mass, speed: speed.value(), restitution: 0.0, crush: profile };
    let refused = |reasons: TestIssues| refused(row, reasons.to_string());
    let line = test.speed_line(onset).map_err(refused)?;
    let stiffness = CrushStiffness::from(line);
    let coefficient = |name, unit, computed, column: Option<&'static str>| {
        let published = column.map(|column| row.number_if_any(column)).transpose()?.flatten();
        Ok(Coefficient { name, unit, computed, published })
    };
    let energy = stiffness.crush_energy(profile);
    Ok(Frontal {
        test: row.text("test")?.to_owned(),
        vehicle: row.text("vehicle")?.to_owned(),
        mean_depth,
        coefficients: vec![
            coefficient("b1", "1/s", line.slope, Some("b1_1ps"))?,
            coefficient("A", "N/m", stiffness.onset * stiffness.slope, Some("A_Npm"))?,
            coefficient("B", "N/m^2", stiffness.slope * stiffness.slope, Some("B_Npm2"))?,
            coefficient("d0", "N^0.5", stiffness.onset, None)?,
            coefficient("d1", "N^0.5/m", stiffness.slope, None)?,
        ],
        energy: Reading {
            quantity: "crush energy",
            unit: "J",
            measured: whole(test.crush_energy(), row)?,
            computed: energy,
            recorded: recorded(FILE, row, "energy_recorded")?,
        },
        energy_by_profile: test.stiffness(onset).map_err(refused)?.crush_energy(profile),
        unevenness: stiffness.slope * stiffness.slope * (profile.third - profile.first * mean_depth * mean_depth),
        speed_of_crush: speed_of_energy(energy, mass),
        speed,
        reason: row.text("reason")?.to_owned(),
    })
}

/// Rounds the kinetic energy to a tenth of a joule: it is computed from measurements, so its digits have no meaning of their own.
fn whole(kinetic: f64, row: &Row<'_>) -> Result<Printed, DataError> {
    Printed::parse(&format!("{kinetic:.1}")).filter(|energy| energy.value() > 0.0).ok_or_else(|| refused(row, "no energy".to_owned()))
}

fn refused(row: &Row<'_>, reasons: String) -> DataError {
    DataError::Refused { collision: format!("{FILE}, {}", row.text("test").unwrap_or_default()), reasons }
}

fn depths(row: &Row<'_>) -> Result<Vec<f64>, DataError> {
    let depth = |field: &str| Printed::parse(field).map(|depth| depth.value()).filter(|&depth| depth >= 0.0);
    row.text("depths_m")?.split_whitespace().map(|field| depth(field).ok_or_else(|| no_depths(row))).collect()
}

fn no_depths(row: &Row<'_>) -> DataError {
    let field = row.text("depths_m").unwrap_or_default().to_owned();
    DataError::NotANumber { file: FILE, column: "depths_m", field }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::Texts;

    #[test]
    fn the_profile_has_the_energy_of_its_mean_and_of_its_unevenness() {
        let tests = read(Texts::embedded().nhtsa).expect("embedded");
        for test in &tests {
            // ½ (d₀ + d₁ C̄)² w is ½ m v², because the line passes through the test.
            assert!((test.energy.error() - test.unevenness).abs() < 0.1, "{} {}", test.energy.error(), test.unevenness);
            assert!(test.unevenness > 0.0);
            // The stiffness from the profile reproduces the energy of the test, which is shown to a tenth of a joule.
            assert!(test.energy.error_of(test.energy_by_profile).abs() <= 0.05, "{}", test.energy_by_profile);
        }
        // Test 6268: depths 0.265 and 0.310 count by half, over five gaps.
        assert!((tests[0].mean_depth - 0.4491).abs() < 1e-12);
    }

    #[test]
    fn a_published_coefficient_is_held_against_the_computed_one() {
        let text = Texts::embedded().nhtsa;
        let published = |text: &str| read(text).expect("digits")[0].coefficients.iter().filter(|c| !c.is_as_published()).count();
        assert_eq!(published(text), 0);
        assert_eq!(published(&text.replace("79010.7", "79011.7")), 1);
        // Another mass changes A and B, but not b1.
        assert_eq!(published(&text.replace(",1779,", ",1780,")), 2);
    }

    #[test]
    fn depths_must_be_a_profile() {
        let text = Texts::embedded().nhtsa;
        for bad in ["0.265", "", "0.265 deep", "0.265 -0.1"] {
            let text = text.replace("0.265 0.474 0.504 0.505 0.475 0.310", bad);
            assert!(matches!(read(&text).err(), Some(DataError::NotANumber { column: "depths_m", .. })), "{bad}");
        }
        for speed in [",0,", ",2.1,"] {
            assert!(matches!(read(&text.replace(",15.6,", speed)).err(), Some(DataError::Refused { .. })), "{speed}");
        }
    }
}
