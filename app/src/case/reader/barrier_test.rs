//! The test of `contact.record` beside the case that it is evidence of.

use planar_impact::barrier::Estimate;
use planar_impact::reconstruct::{Measurand, Variable};
use planar_impact::{Body, Compliance, CrushPlane, ForwardLeft, Heading, Input, Side, Vehicle};

use super::CaseReader;
use super::evidence::Piece;
use super::recorder::RecordingOf;
use crate::case::vehicle::{VehicleInputs, Velocity};
use crate::message::Message;
use crate::notice::Notice;
use crate::record::{FollowedPoint, Uncertain};
use crate::units::{Measure, trim};

/// A test of a vehicle against a barrier whose restitution is evidence.
pub(crate) struct BarrierTest {
    /// That of the center of mass, e = ΔV/v − 1; none if it is that of a point.
    pub(super) of_center: Option<Uncertain>,
    /// Tangential to normal impulse, if both were recorded.
    pub(super) ratio: Option<Uncertain>,
    /// The name of the file.
    pub(super) file: String,
    pub(super) mass: Option<Estimate>,
    pub(super) speed: Option<Estimate>,
    /// The point that it is of, if it is not that of the center of mass.
    pub(super) followed: Option<FollowedPoint>,
}

/// Share by which the mass or the speed of a test may differ from that of the case.
const SAME_TEST: f64 = 0.05;

/// Length by which the point that a test follows may lie from the impact center, in m, and the angle by which its barrier may stand otherwise than the crush plane, in rad.
const SAME_POINT: f64 = 0.1;
const SAME_ANGLE: f64 = 0.1;

/// Standard deviations by which two restitutions hardly differ.
const HARDLY: f64 = 0.5;

impl CaseReader {
    /// Compares the test of `contact.record` with the case, once it has been read: its restitution is that of one vehicle against a barrier. Reports one of the center of
    /// mass if that of the impact center is another one, and warns of a case of two vehicles, and of another mass, speed, point or angle.
    ///
    /// Of a normal impulse P the center of mass gains P/m and the impact center P (K_nn + μ K_nt), 1/(m̄ q) in (A14).
    pub(super) fn compare_with_test(
        &self,
        pieces: &[Piece<'_>],
        is_sought: &dyn Fn(Variable) -> bool,
        vehicles: [&Option<VehicleInputs>; 2],
        crush_plane: f64,
    ) -> Option<()> {
        let Some(test) = self.barrier_test.take() else { return Some(()) };
        let is_restitution = |piece: &&Piece<'_>| piece.of == Measurand::Variable(RecordingOf::Contact.variable());
        let place = &pieces.iter().find(is_restitution)?.place;
        let warn = |code, message: Message| {
            let message = Message::from(format!("{}: {} ", place.path(), test.file)).join(message);
            self.notices.borrow_mut().push(Notice::warning(code, place.path(), message));
        };
        let (side, vehicle) = match vehicles {
            [Some(vehicle), None] => (Side::One, vehicle),
            [None, Some(vehicle)] => (Side::Two, vehicle),
            _ => {
                let message = "is a test against a barrier, and here two vehicles collide: its restitution and its impulse ratio are those of \
                               another contact";
                warn("test-of-barrier", message.into());
                return Some(());
            }
        };
        let differs =
            |of_test: &Estimate, of_case: f64| (of_test.value - of_case).abs() > SAME_TEST * of_case.abs() + 2.0 * of_test.deviation();
        if let Some(mass) = test.mass.filter(|mass| differs(mass, vehicle.mass)) {
            let message = Message::from("has a mass of ").figure(Measure::Mass, mass.value).text(" and the case one of ");
            warn("another-test", message.figure(Measure::Mass, vehicle.mass).text(": check that it is the test of this vehicle"));
        }
        let of_speed = Variable::Speed(side);
        let is_given = !is_sought(of_speed) && pieces.iter().all(|piece| piece.of != Measurand::Variable(of_speed));
        if let (Velocity::Speed(speed), Some(of_test)) = (vehicle.velocity, test.speed)
            && is_given
            && differs(&of_test, speed.abs())
        {
            let message = Message::from("has a speed of ").figure(Measure::Speed, of_test.value).text(" and the case one of ");
            warn("another-test", message.figure(Measure::Speed, speed).text(": the restitution falls as the speed rises"));
        }
        if let Some(followed) = &test.followed {
            let is_known = |input: Input| !is_sought(Variable::Input(input));
            for message in differences(followed, side, vehicle, crush_plane, &is_known) {
                warn("another-test", message);
            }
        }
        let Some(restitution) = test.of_center else { return Some(()) };
        let ForwardLeft { forward, left } = vehicle.impact_center;
        let party = Vehicle::new(vehicle.mass, vehicle.yaw_inertia())
            .with_heading(Heading::from_angle(vehicle.heading))
            .with_impact_center(forward, left);
        let body = Body::seen_from(&CrushPlane::from_angle(crush_plane), &party.into());
        let compliance = Compliance::between(&body, &Body::fixed());
        let ratio = test.ratio.unwrap_or(Uncertain { value: 0.0, sd: None });
        let gain = vehicle.mass * compliance.along_ratio(ratio.value);
        let there = (1.0 + restitution.value) * gain - 1.0;
        let sd = restitution.sd?;
        if (there - restitution.value).abs() <= HARDLY * sd {
            return Some(());
        }
        let of_ratio = (1.0 + restitution.value) * vehicle.mass * compliance.nt() * ratio.sd.unwrap_or(0.0);
        let message = Message::from(format!("the restitution of {} is ", test.file))
            .figure(Measure::Ratio, restitution.value)
            .text(", of the center of mass; of the impact center, ")
            .figure(Measure::Length, body.arm.t.abs())
            .text(" beside the normal through it, it is ")
            .figure(Measure::Ratio, there);
        let of_ratio_too = test.ratio.map_or_else(String::new, |ratio| {
            format!(" and contact.impulse_ratio = \"{} ± {}\"", trim(ratio.value), trim(ratio.sd.unwrap_or(0.0)))
        });
        let help = format!(
            "in place of the recording give contact.restitution = \"{} ± {}\"{of_ratio_too}",
            trim(there),
            trim(gain.abs() * sd + of_ratio.abs())
        );
        place.report_as("restitution-of-center", message, Some(help));
        None
    }
}

/// Returns how the point and the barrier of a test differ from the impact center and the crush plane of a case, where these are known.
fn differences(
    followed: &FollowedPoint,
    side: Side,
    vehicle: &VehicleInputs,
    crush_plane: f64,
    is_known: &dyn Fn(Input) -> bool,
) -> Vec<Message> {
    let FollowedPoint { place: [ahead, beside], barrier, .. } = followed;
    let ForwardLeft { forward, left } = vehicle.impact_center;
    let mut found = Vec::new();
    let apart = |of_test: &Estimate, of_case: f64| ((of_test.value - of_case).abs() - 2.0 * of_test.deviation()).max(0.0);
    let has_center = is_known(Input::ImpactCenterForward(side)) && is_known(Input::ImpactCenterLeft(side));
    if has_center && libm::hypot(apart(ahead, forward), apart(beside, left)) > SAME_POINT {
        let at = |message: Message, [ahead, left]: [f64; 2]| {
            let message = message.figure(Measure::Length, ahead).text(" ahead of the center of mass and ");
            message.figure(Measure::Length, left).text(" to its left")
        };
        let message = at("follows a point ".into(), [ahead.value, beside.value]).text(", and the impact center of the case is ");
        found.push(at(message, [forward, left]).text(": the restitution is that of the point"));
    }
    let of_case = crush_plane - vehicle.heading;
    let has_angles = is_known(Input::CrushPlane) && is_known(Input::Heading(side));
    if has_angles && libm::sin(barrier - of_case).abs() > libm::sin(SAME_ANGLE) {
        let message = Message::from("has its barrier at ").figure(Measure::Angle, *barrier);
        let message = message.text(" from the heading of the vehicle, and the case its crush plane at ").figure(Measure::Angle, of_case);
        found.push(message.text(": the restitution is that along another normal"));
    }
    found
}
