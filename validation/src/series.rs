//! The three crabbed tests of one car: measurements, and sums from test to test.

use crate::data::DataError;
use crate::geometry::Geometry;
use crate::sheet::{Printed, Sheet};
use planar_impact::crush::{crush_intensity, equivalent_energy_speed};

/// One crabbed test, from its rows in Tables B1 and B2.
#[derive(Clone, Debug)]
pub(crate) struct CrabbedTest {
    pub(crate) name: String,
    /// Speed in ft/s as printed in Table B1; Table B2 rounds it.
    pub(crate) speed: Printed,
    /// The measured restitution that the paper uses.
    pub(crate) restitution: Printed,
    /// Measured ΔV in mph.
    pub(crate) delta_v_mph: f64,
    /// Measured yaw rate in deg/s.
    pub(crate) yaw_rate: f64,
    /// Mean residual crush C_avg in ft, accumulated over the tests up to this one.
    pub(crate) depth: f64,
}

/// The restitution with which a row is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Restitution {
    /// e = 0.
    None,
    /// The mean from Table 4.
    Measured,
}

impl Restitution {
    pub(crate) const BOTH: [Restitution; 2] = [Restitution::None, Restitution::Measured];
}

/// Cumulative results of the tests up to one of them, in feet and pounds.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cumulative {
    /// Σ ½ m (1 − e²) v_n², in ft lb.
    pub(crate) energy: f64,
    /// Equivalent energy speed in ft/s   (Eq 9, with restitution).
    pub(crate) equivalent_speed: f64,
    /// E* = √(2 E_C/w) in √lbf.
    pub(crate) intensity: f64,
}

/// The tests, in order.
#[derive(Clone, Debug)]
pub(crate) struct Series {
    pub(crate) tests: Vec<CrabbedTest>,
}

impl Series {
    pub(crate) fn read(table_b1: &str, table_b2: &str) -> Result<Self, DataError> {
        let crush = Sheet::read("tableB2.csv", table_b2)?;
        let mut tests = Vec::new();
        for row in Sheet::read("tableB1.csv", table_b1)?.rows() {
            // The rows with e = 0 have no measured cells.
            if row.text("omega_test")?.is_empty() {
                continue;
            }
            let name = row.text("test")?.to_owned();
            let mut depth = None;
            for row in crush.rows() {
                if row.text("test")? == name && depth.is_none() {
                    depth = row.number_if_any("C_avg")?;
                }
            }
            let missing = || DataError::NotOnce { file: "tableB2.csv", entry: format!("C_avg of test {name}") };
            tests.push(CrabbedTest {
                speed: row.number("vi")?,
                restitution: row.number("e")?,
                delta_v_mph: row.number("dv_test_mph")?.value(),
                yaw_rate: row.number("omega_test")?.value(),
                depth: depth.ok_or_else(missing)?.value(),
                name,
            });
        }
        Ok(Series { tests })
    }

    /// Returns the index of a test.
    pub(crate) fn place(&self, name: &str) -> Option<usize> {
        self.tests.iter().position(|test| test.name == name)
    }

    /// Sums the energies of all tests up to one, each normal to the wall.
    pub(crate) fn cumulative(&self, geometry: &Geometry, which: usize, restitution: Restitution) -> Cumulative {
        let tests = self.tests.iter().take(which + 1);
        let tests = tests.map(|test| (geometry.crabbed_velocity(test.speed.value()).x, test.restitution_in(restitution)));
        let equivalent_speed = equivalent_energy_speed(tests);
        let energy = geometry.barrier_mass * equivalent_speed * equivalent_speed / 2.0;
        Cumulative { energy, equivalent_speed, intensity: crush_intensity(energy, geometry.crush_width) }
    }
}

impl CrabbedTest {
    pub(crate) fn restitution_in(&self, restitution: Restitution) -> f64 {
        match restitution {
            Restitution::None => 0.0,
            Restitution::Measured => self.restitution.value(),
        }
    }

    /// Returns the label of its rows in Tables B1 and B2.
    pub(crate) fn label(&self, restitution: Restitution) -> String {
        match restitution {
            Restitution::None => format!("{} 0.00", self.name),
            Restitution::Measured => format!("{} {}", self.name, self.restitution.text()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::Texts;

    #[test]
    fn each_test_adds_its_own_energy() {
        let texts = Texts::embedded();
        let geometry = Geometry::read(texts.geometry).expect("embedded");
        let series = Series::read(texts.table_b1, texts.table_b2).expect("embedded");
        assert_eq!(series.tests.iter().map(|test| test.depth).collect::<Vec<_>>(), [0.1062, 0.5203, 1.0768]);
        for (which, test) in series.tests.iter().enumerate() {
            let before = if which == 0 { 0.0 } else { series.cumulative(&geometry, which - 1, Restitution::Measured).energy };
            let (normal, e) = (geometry.crabbed_velocity(test.speed.value()).x, test.restitution.value());
            let own = geometry.barrier_mass * normal * normal * (1.0 - e * e) / 2.0;
            let sum = series.cumulative(&geometry, which, Restitution::Measured).energy;
            assert!(((sum - before) / own - 1.0).abs() < 1e-12, "{}", test.name);
        }
    }

    #[test]
    fn a_depth_that_is_missing_is_an_error() {
        let texts = Texts::embedded();
        let missing = Series::read(texts.table_b1, &texts.table_b2.replace(",0.5203,", ",,")).err();
        assert_eq!(missing, Some(DataError::NotOnce { file: "tableB2.csv", entry: "C_avg of test 2".into() }));
    }
}
