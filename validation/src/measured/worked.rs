//! The third stage: worked examples and staged collisions of the field, by momentum, common velocity and skids.

use planar_impact::momentum::approach_speeds;
use planar_impact::skid::{Skid, skid_speed};
use planar_impact::{Collision, Heading, Impact, ImpulseRatio, Motion, STANDARD_GRAVITY, Vehicle, Xy};

use super::{Reading, recorded_as};
use crate::data::DataError;
use crate::geometry::solve;
use crate::sheet::{Row, Sheet};

const FILE: &str = "worked.csv";

/// The quantities of worked examples.
const QUANTITIES: [&str; 5] = ["speed 1", "speed 2", "speed after", "delta-V 1", "delta-V 2"];
/// Their units.
const UNITS: [&str; 2] = ["mph", "m/s"];

/// A published number of a worked example.
#[derive(Clone, Debug, PartialEq)]
pub struct Worked {
    /// The example.
    pub example: String,
    /// The published number and the computed one; an error is recorded where the number was measured.
    pub reading: Reading,
    /// Where it is from.
    pub source: String,
}

impl Worked {
    /// Returns `true` if a number worked by hand comes out to its digits, or a measured one with its recorded error.
    pub fn holds(&self) -> bool {
        if self.reading.recorded.is_some() { self.reading.is_as_recorded() } else { self.reading.is_within_digits() }
    }
}

pub(super) fn read(text: &str) -> Result<Vec<Worked>, DataError> {
    Sheet::read(FILE, text)?.rows().map(|row| one(&row)).collect()
}

fn one(row: &Row<'_>) -> Result<Worked, DataError> {
    let word = |column, known: &[&'static str]| {
        let field = row.text(column)?;
        let found = known.iter().copied().find(|known| *known == field);
        found.ok_or_else(|| DataError::UnknownWord { file: FILE, column, field: field.to_owned() })
    };
    let (quantity, unit) = (word("quantity", &QUANTITIES)?, word("unit", &UNITS)?);
    let example = row.text("example")?.to_owned();
    let which = usize::from(quantity.ends_with('2'));
    let computed = match word("kind", &["momentum", "locked", "pushed", "rear-end"])? {
        "momentum" => {
            let [one, two] = vehicles(row, [0.0, 90.0])?;
            let [x1, y1, x2, y2] = numbers(row, ["x1", "y1", "x2", "y2"])?;
            approach_speeds([&one, &two], [Xy { x: x1, y: y1 }, Xy { x: x2, y: y2 }])[which]
        }
        "locked" => {
            let [x1, y1, x2, y2] = numbers(row, ["x1", "y1", "x2", "y2"])?;
            impact(row, [Xy { x: x1, y: y1 }, Xy { x: x2, y: y2 }], 0.0)?.one.after.velocity.length()
        }
        "pushed" => {
            let [mass_1, mass_2, length, friction] = numbers(row, ["mass_1", "mass_2", "x1", "coefficient"])?;
            let together = skid_speed(&[Skid { length, friction, grade: 0.0, braking: 1.0 }], STANDARD_GRAVITY);
            (mass_1 + mass_2) / mass_1 * together
        }
        _ => {
            let [closing, restitution] = numbers(row, ["x1", "coefficient"])?;
            let impact = impact(row, [Xy { x: closing, y: 0.0 }, Xy::zero()], restitution)?;
            [impact.one, impact.two][which].delta_v_magnitude()
        }
    };
    let recorded = recorded_as(FILE, row, "recorded", "source")?;
    Ok(Worked {
        reading: Reading { quantity, unit, measured: row.number("published")?, computed, recorded },
        source: row.text("source")?.to_owned(),
        example,
    })
}

fn numbers<const N: usize>(row: &Row<'_>, columns: [&'static str; N]) -> Result<[f64; N], DataError> {
    let mut found = [0.0; N];
    for (number, column) in found.iter_mut().zip(columns) {
        *number = row.number(column)?.value();
    }
    Ok(found)
}

/// Returns two point masses with headings in degrees.
fn vehicles(row: &Row<'_>, headings: [f64; 2]) -> Result<[Vehicle; 2], DataError> {
    let [mass_1, mass_2] = numbers(row, ["mass_1", "mass_2"])?;
    let vehicle = |mass, heading: f64| Vehicle::new(mass, 1.0).with_heading(Heading::from_angle(heading.to_radians()));
    Ok([vehicle(mass_1, headings[0]), vehicle(mass_2, headings[1])])
}

/// Returns the impact of two point masses with velocities, at the critical ratio.
fn impact(row: &Row<'_>, velocities: [Xy; 2], restitution: f64) -> Result<Impact, DataError> {
    let [mut one, mut two] = vehicles(row, [0.0, 0.0])?;
    (one.motion, two.motion) = (Motion { velocity: velocities[0], yaw_rate: 0.0 }, Motion { velocity: velocities[1], yaw_rate: 0.0 });
    let collision = Collision::new(one, two).with_restitution(restitution).with_impulse_ratio(ImpulseRatio::Critical);
    solve(&collision, &format!("{FILE}, {}", row.text("example")?))
}
