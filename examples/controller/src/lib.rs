//! A crash severity for a controller: ΔV of the own vehicle and its derivatives, in f32, without the standard library and without an allocator.

#![cfg_attr(not(test), no_std)]

use planar_impact::{Collision, Heading, Input, Output, Refusal, Side, Vehicle};

#[cfg(not(test))]
#[panic_handler]
fn stop(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {}
}

/// ΔV of the own vehicle, and the effect of braking and steering on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Severity {
    /// ΔV, in m/s.
    pub delta_v: f32,
    /// Derivative by the own speed.
    pub by_speed: f32,
    /// Derivative by the own heading, in m/s per rad.
    pub by_heading: f32,
}

/// Reason for the absence of a severity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// The vehicles do not collide: they do not approach each other.
    NoCollision,
    /// A sensor delivered an invalid number.
    Sensor,
    /// Another reason, such as a coefficient that the mechanics refuses.
    Other,
}

/// Computes the severity of a collision, whose vehicle 1 is the own one.
///
/// # Errors
///
/// The [`Fault`], by the refusals of [`Collision::solve`].
pub fn severity(collision: &Collision<f32>) -> Result<Severity, Fault> {
    let delta_v = collision.sensitivity(Output::DeltaVMagnitude(Side::One)).map_err(|refusals| {
        if refusals.iter().any(|refusal| matches!(refusal, Refusal::Input(_) | Refusal::NotADirection { .. })) {
            Fault::Sensor
        } else if refusals.iter().any(|refusal| matches!(refusal.code(), "separating" | "not-closing")) {
            Fault::NoCollision
        } else {
            Fault::Other
        }
    })?;
    let by = |input| delta_v.by[input];
    Ok(Severity { delta_v: delta_v.value, by_speed: by(Input::VelocityX(Side::One)), by_heading: by(Input::Heading(Side::One)) })
}

/// Returns the collision of the own front with the right side of a vehicle that comes from the left, at two measured speeds.
pub fn crossing(own_speed: f32, other_speed: f32) -> Collision<f32> {
    let own = Vehicle::new(1500.0, 2500.0).with_impact_center(2.0, 0.25).with_speed(own_speed);
    let other = Vehicle::new(1200.0, 1900.0)
        .with_heading(Heading::from_angle(-core::f32::consts::FRAC_PI_2))
        .with_impact_center(0.5, -0.75)
        .with_speed(other_speed);
    Collision::new(own, other).with_restitution(0.125)
}

#[cfg(test)]
mod tests {
    use super::*;
    use planar_impact::Refusals;

    #[test]
    fn the_numbers_are_those_of_f64() {
        let collision = crossing(14.0, 9.0);
        let exact = collision.map(f64::from).sensitivity(Output::DeltaVMagnitude(Side::One)).expect("they collide");
        let severity = severity(&collision).expect("they collide");
        let expected = [exact.value, exact.by[Input::VelocityX(Side::One)], exact.by[Input::Heading(Side::One)]];
        for (found, expected) in [severity.delta_v, severity.by_speed, severity.by_heading].into_iter().zip(expected) {
            assert!((f64::from(found) - expected).abs() < 1e-4 * (1.0 + expected.abs()), "{found}, {expected}");
        }
    }

    #[test]
    fn the_reason_is_known_by_its_code() {
        assert_eq!(severity(&crossing(-14.0, 9.0)), Err(Fault::NoCollision));
        assert_eq!(severity(&crossing(f32::NAN, 9.0)), Err(Fault::Sensor));
        assert_eq!(severity(&Collision { restitution: 1.5, ..crossing(14.0, 9.0) }), Err(Fault::Sensor));
    }

    /// There is room for every refusal.
    #[test]
    fn every_input_may_be_refused_at_once() {
        let nothing = Collision::from_inputs([f32::NAN; Input::COUNT]);
        let refusals: Refusals<f32> = nothing.solve().expect_err("nothing is a number");
        assert_eq!(refusals.len(), Input::COUNT);
        assert!(refusals.iter().all(|refusal| refusal.code() == "not-finite"));
    }

    /// With a moment impulse, the fast derivatives are computed on dual numbers instead.
    #[test]
    fn a_moment_has_derivatives() {
        use planar_impact::{Moment, sensitivity::by_definition};
        let collision = crossing(14.0, 9.0).with_moment(Moment::OfCritical(0.5));
        let of = Output::DeltaVMagnitude(Side::One);
        assert_eq!(collision.sensitivity(of).expect("they collide"), by_definition(&collision)[of]);
    }
}
