//! A planner's inner loop: the least harmful steering angle before an unavoidable impact, by the gradient of a cost of several outputs.
// Examples and comparisons compute as their readers do.
#![allow(clippy::disallowed_methods)]

use planar_impact::prelude::*;
use planar_impact::sensitivity::Gradient;

/// J = ΔV² of both + (10 m × yaw rate)², with its derivatives by every input.
fn cost(collision: &Collision) -> Result<(f64, Gradient), Refusals> {
    let impact = collision.solve()?;
    let (one, two) = (&impact.one, &impact.two);
    let cost = one.delta_v.length_squared() + two.delta_v.length_squared() + 100.0 * one.after.yaw_rate.powi(2);
    let mut weights = Outputs::default();
    weights.one.delta_v_magnitude = 2.0 * one.delta_v_magnitude();
    weights.two.delta_v_magnitude = 2.0 * two.delta_v_magnitude();
    weights.one.after.yaw_rate = 200.0 * one.after.yaw_rate;
    Ok((cost, collision.pullback(&weights)?))
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let heading = Heading::from_degrees(8.0);
    let car = Vehicle::new(1400.0, 2400.0).with_heading(heading).with_impact_center(1.9, 0.4).with_speed(16.0);
    let other = Vehicle::new(1700.0, 3100.0).with_heading(Heading::from_degrees(172.0)).with_impact_center(2.0, 0.3).with_speed(9.0);
    let mut collision = Collision::new(car, other).with_restitution(0.1).with_impulse_ratio(ImpulseRatio::LimitedByFriction(0.4));
    let (mut least, first) = (cost(&collision)?.0, cost(&collision)?.0);
    // Steering turns the velocity with the heading: v̇ = ω × v.
    for _ in 0..40 {
        let (_, by) = cost(&collision)?;
        let velocity = collision.one.motion().velocity;
        let slope =
            by[Input::Heading(Side::One)] - velocity.y * by[Input::VelocityX(Side::One)] + velocity.x * by[Input::VelocityY(Side::One)];
        let turned = |step: f64| {
            let Party::Vehicle(vehicle) = collision.one else { return collision };
            let (x, y) = (velocity.x * step.cos() - velocity.y * step.sin(), velocity.x * step.sin() + velocity.y * step.cos());
            let vehicle = vehicle.with_heading(vehicle.heading.turned(step)).with_velocity(Xy::new(x, y));
            Collision { one: vehicle.into(), ..collision }
        };
        let Some(better) = (2..30).map(|k| turned(-slope.signum() * 0.5_f64.powi(k))).find(|next| cost(next).is_ok_and(|(j, _)| j < least))
        else {
            break;
        };
        (collision, least) = (better, cost(&better)?.0);
    }
    let angle = collision.input(Input::Heading(Side::One)).unwrap_or_default().to_degrees();
    println!("the cost falls from {first:.1} to {least:.1} at a heading of {angle:.2} deg");
    assert!(least < first);
    Ok(())
}
