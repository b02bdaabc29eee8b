//! Small-overlap barrier tests: one front corner of a car strikes the edge of a fixed barrier, which makes the car rotate.

use super::{Reading, RootMeanSquare, recorded};
use crate::data::DataError;
use crate::geometry::solve;
use crate::sheet::{Row, Sheet};
use planar_impact::{Collision, CrushPlane, ForwardLeft, Heading, Impact, ImpulseRatio, Law, Moment, Motion, Party, Vehicle, Xy};

const FILE: &str = "iihs.csv";
/// 9.80665 m/s² in ft/s²: pounds in a slug.
const GRAVITY: f64 = 9.806_65 / 0.3048;

/// One test.
#[derive(Clone, Debug, PartialEq)]
pub struct SmallOverlap {
    /// Its number.
    pub test: String,
    /// ΔV in ft/s, by the paper's tangential law.
    pub delta_v: Reading,
    /// Clockwise yaw rate in deg/s, by the paper's tangential law.
    pub yaw_rate: Reading,
    /// ΔV in ft/s by the law of Kudlich and Slibar, with the same fraction of its own critical ratio.
    pub kudlich_slibar_delta_v: f64,
    /// Clockwise yaw rate in deg/s by that law.
    pub kudlich_slibar_yaw_rate: f64,
    /// Reason for the errors.
    pub reason: String,
}

impl SmallOverlap {
    /// Returns `true` if the computed yaw rates by both laws have the direction of the measured one.
    pub fn turns_as_measured(&self) -> bool {
        let measured = self.yaw_rate.measured.value();
        [self.yaw_rate.computed, self.kudlich_slibar_yaw_rate].iter().all(|computed| computed * measured > 0.0)
    }

    /// Computes root mean square errors of ΔV and of the yaw rate over tests, by the paper's law.
    pub fn root_mean_squares(tests: &[SmallOverlap]) -> [RootMeanSquare; 2] {
        [
            RootMeanSquare::of(tests.iter().map(|test| (&test.delta_v, test.delta_v.computed))),
            RootMeanSquare::of(tests.iter().map(|test| (&test.yaw_rate, test.yaw_rate.computed))),
        ]
    }

    /// Computes the same errors by the law of Kudlich and Slibar.
    pub fn kudlich_slibar_root_mean_squares(tests: &[SmallOverlap]) -> [RootMeanSquare; 2] {
        [
            RootMeanSquare::of(tests.iter().map(|test| (&test.delta_v, test.kudlich_slibar_delta_v))),
            RootMeanSquare::of(tests.iter().map(|test| (&test.yaw_rate, test.kudlich_slibar_yaw_rate))),
        ]
    }
}

pub(super) fn read(text: &str) -> Result<Vec<SmallOverlap>, DataError> {
    Sheet::read(FILE, text)?.rows().map(|row| one(&row)).collect()
}

fn one(row: &Row<'_>) -> Result<SmallOverlap, DataError> {
    let test = row.text("test")?.to_owned();
    let [brach, kudlich_slibar] = [Law::Brach, Law::KudlichSlibar].map(|law| solve(&collision(row, law)?, &format!("{FILE}, {test}")));
    let (brach, kudlich_slibar) = (brach?, kudlich_slibar?);
    let reading = |quantity, unit, column, computed, record| {
        Ok(Reading { quantity, unit, measured: row.number(column)?, computed, recorded: recorded(FILE, row, record)? })
    };
    Ok(SmallOverlap {
        delta_v: reading("delta-V", "ft/s", "dv_ftps", brach.one.delta_v_magnitude(), "dv_recorded")?,
        yaw_rate: reading("yaw rate", "deg/s", "yaw_degps", clockwise(&brach), "yaw_recorded")?,
        kudlich_slibar_delta_v: kudlich_slibar.one.delta_v_magnitude(),
        kudlich_slibar_yaw_rate: clockwise(&kudlich_slibar),
        reason: row.text("reason")?.to_owned(),
        test,
    })
}

fn clockwise(impact: &Impact) -> f64 {
    -impact.one.after.yaw_rate.to_degrees()
}

/// Returns the collision in feet, slugs and seconds, with the car driving in +x.
fn collision(row: &Row<'_>, law: Law) -> Result<Collision, DataError> {
    let number = |column| row.number(column).map(|number| number.value());
    let (distance, bearing) = (number("d_ft")?, -number("phi_deg")?.to_radians());
    let car = Vehicle {
        mass: number("car_lb")? / GRAVITY,
        yaw_inertia: number("yaw_inertia_slugft2")?,
        heading: Heading { cos: 1.0, sin: 0.0 },
        impact_center: ForwardLeft { forward: distance * libm::cos(bearing), left: distance * libm::sin(bearing) },
        motion: Motion { velocity: Xy { x: number("v_ftps")?, y: 0.0 }, yaw_rate: 0.0 },
    };
    Ok(Collision {
        one: car.into(),
        two: Party::Barrier,
        crush_plane: CrushPlane::from_angle(-number("gamma_deg")?.to_radians()),
        restitution: number("e")?,
        impulse_ratio: ImpulseRatio::OfCritical(number("share")?),
        law,
        moment: Moment::None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::Texts;

    fn tests(text: &str) -> Vec<SmallOverlap> {
        read(text).expect("possible")
    }

    #[test]
    fn the_laws_agree_without_restitution() {
        let tests = tests(Texts::embedded().iihs);
        for (test, e) in tests.iter().zip([0.0, 0.0, 0.103]) {
            let apart =
                (test.kudlich_slibar_delta_v - test.delta_v.computed).abs() + (test.kudlich_slibar_yaw_rate - test.yaw_rate.computed).abs();
            assert_eq!(apart < 1e-9, e == 0.0, "{} {apart}", test.test);
        }
    }

    #[test]
    fn the_impulse_goes_through_the_impact_center() {
        // I Ω = r × P: computed from the row of CF10020, with P = m ΔV.
        let sheet = Sheet::read(FILE, Texts::embedded().iihs).expect("embedded");
        let row = sheet.rows().nth(1).expect("three rows");
        let impact = solve(&collision(&row, Law::Brach).expect("digits"), "CF10020").expect("possible");
        let (x, y) = (3.8 * 37.5_f64.to_radians().cos(), -3.8 * 37.5_f64.to_radians().sin());
        let impulse = impact.one.delta_v;
        let yaw_rate = 3574.2 / GRAVITY * (x * impulse.y - y * impulse.x) / 2336.3;
        assert!((yaw_rate / impact.one.after.yaw_rate - 1.0).abs() < 1e-12);
        // It decelerates the car, and pushes its front to the left, away from the barrier on its right.
        assert!(impulse.x < 0.0 && impulse.y > 0.0 && yaw_rate < 0.0);
    }

    #[test]
    fn a_barrier_on_the_other_side_turns_the_car_the_other_way() {
        let text = Texts::embedded().iihs.replace(",37.5,77.6,", ",-37.5,-77.6,");
        let tests = tests(&text);
        assert!(tests[0].turns_as_measured() && !tests[1].turns_as_measured() && tests[2].turns_as_measured());
        assert!((tests[1].delta_v.computed - 46.99).abs() < 0.01);
    }

    #[test]
    fn the_bearing_that_would_give_the_yaw_rate_is_as_told() {
        // The reason of CF10023 in iihs.csv: 196.3 deg/s at 35.9°.
        let tests = tests(&Texts::embedded().iihs.replace(",26.3,", ",35.9,"));
        assert!(tests[0].yaw_rate.percent().abs() < 0.1 && tests[0].delta_v.percent().abs() < 3.0, "{:?}", tests[0]);
    }

    #[test]
    fn a_recorded_error_needs_a_reason() {
        let text =
            Texts::embedded().iihs.replace(",\"what the published e, share and gamma give; the other tangential law is farther off\"", ",");
        assert!(matches!(read(&text).err(), Some(DataError::UnknownWord { column: "reason", .. })));
        let unrecorded = text.replace(",-0.44,-1.37,", ",,,");
        assert!(tests(&unrecorded)[2].delta_v.is_as_recorded());
    }
}
