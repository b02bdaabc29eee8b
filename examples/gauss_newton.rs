//! A fit by Gauss and Newton: both approach speeds from the ΔV that two event data recorders have stored.
// Examples and comparisons compute as their readers do.
#![allow(clippy::disallowed_methods)]

use planar_impact::nalgebra::{Matrix2, Vector2};
use planar_impact::prelude::*;

fn with_speeds(speeds: Vector2<f64>) -> Collision {
    let one = Vehicle::new(1300.0, 2100.0).with_impact_center(1.8, 0.5).with_speed(speeds.x);
    let other = Heading::from_degrees(105.0);
    let two = Vehicle::new(1600.0, 2900.0).with_heading(other).with_impact_center(0.4, 0.9).with_speed(speeds.y);
    Collision::new(one, two).with_crush_plane(CrushPlane::from_degrees(15.0)).with_restitution(0.1)
}

fn main() -> Result<(), Refusals> {
    let truth = with_speeds(Vector2::new(17.0, 8.0)).solve()?;
    let measured = Vector2::new(truth.one.delta_v_magnitude(), truth.two.after.velocity.x);
    let mut speeds = Vector2::new(12.0, 6.0);
    for _ in 0..20 {
        let outputs = with_speeds(speeds).sensitivities()?;
        let rows = [&outputs.one.delta_v_magnitude, &outputs.two.after.velocity.x];
        let residual = measured - Vector2::new(rows[0].value, rows[1].value);
        // A speed moves both components of the velocity.
        let heading = Heading::from_degrees(105.0);
        let by_speeds = rows.map(|row| {
            let of_two = heading.cos * row.by[Input::VelocityX(Side::Two)] + heading.sin * row.by[Input::VelocityY(Side::Two)];
            [row.by[Input::VelocityX(Side::One)], of_two]
        });
        let jacobian = Matrix2::from_row_slice(&by_speeds.concat());
        let Some(step) = jacobian.lu().solve(&residual) else { break };
        speeds += step;
        if step.norm() < 1e-12 {
            break;
        }
    }
    println!("speeds {:.6} m/s and {:.6} m/s", speeds.x, speeds.y);
    assert!((speeds - Vector2::new(17.0, 8.0)).norm() < 1e-9);
    Ok(())
}
