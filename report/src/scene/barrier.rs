//! A fixed barrier: a wall along the crush plane.

use planar_impact_app::scene::Scene;

use super::vehicle::name;
use super::view::View;
use crate::svg::{INK, Svg};

/// Returns the sine and the cosine of the angle of the crush plane, which every barrier has.
fn plane(scene: &Scene) -> (f64, f64) {
    libm::sincos(scene.crush_plane.unwrap_or_default())
}

/// Returns which way along n a barrier lies from the impact center: away from the other vehicle.
fn away(scene: &Scene, which: usize) -> f64 {
    let other = &scene.vehicles[1 - which];
    let (sin, cos) = plane(scene);
    let along = (other.position[0] - scene.impact_point[0]) * cos + (other.position[1] - scene.impact_point[1]) * sin;
    if along > 0.0 { -1.0 } else { 1.0 }
}

/// Returns a point of the wall behind the impact center.
pub fn behind(scene: &Scene, which: usize, size: f64) -> [f64; 2] {
    let (sin, cos) = plane(scene);
    let by = 0.12 * size * away(scene, which);
    [scene.impact_point[0] + by * cos, scene.impact_point[1] + by * sin]
}

/// Returns a point of the ground along the crush plane from the impact center, and into the wall, both over the size of the vehicles.
fn on_ground(scene: &Scene, which: usize, size: f64, along: f64, deep: f64) -> [f64; 2] {
    let (sin, cos) = plane(scene);
    let (t, n) = (along * size, away(scene, which) * deep * size);
    [scene.impact_point[0] - t * sin + n * cos, scene.impact_point[1] + t * cos + n * sin]
}

/// Returns the corners of the wall on the ground, its face first.
pub fn corners(scene: &Scene, which: usize, size: f64) -> [[f64; 2]; 4] {
    [(-0.45, 0.0), (0.45, 0.0), (0.45, 0.08), (-0.45, 0.08)].map(|(along, deep)| on_ground(scene, which, size, along, deep))
}

/// Draws a barrier: a wall along the crush plane, hatched.
pub fn draw(svg: &mut Svg, view: &View, scene: &Scene, which: usize, size: f64) {
    let at = |along: f64, deep: f64| view.place(on_ground(scene, which, size, along, deep));
    svg.group(&[("class", &format!("barrier vehicle-{}", which + 1))], |svg| {
        svg.title(&name(&scene.vehicles[which]));
        let wall = corners(scene, which, size).map(|corner| view.place(corner));
        svg.points("polygon", &wall, &[("fill", "#d0d0d0"), ("stroke", INK), ("stroke-width", "1.5")]);
        for k in 0..12 {
            let along = -0.45 + 0.075 * f64::from(k);
            svg.line(at(along, 0.08), at(along + 0.075, 0.0), &[("stroke", "#606060"), ("stroke-width", "1")]);
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use planar_impact_app::scene::draw;
    use planar_impact_app::{Case, Source, Uncontrolled, template};

    #[test]
    fn behind_a_wall_is_away_from_the_vehicle() {
        let text = template::of("barrier").expect("a template").to_owned();
        let case = Case::parse(Source::new("case.toml", text)).expect("a case");
        let scene = draw(&case, &(), &Uncontrolled).expect("a scene");
        let from = |[x, y]: [f64; 2]| [x - scene.impact_point[0], y - scene.impact_point[1]];
        let (behind, vehicle) = (from(behind(&scene, 1, 10.0)), from(scene.vehicles[0].position));
        assert!((libm::hypot(behind[0], behind[1]) - 1.2).abs() < 1e-12, "a share of the size: {behind:?}");
        assert!(behind[0] * vehicle[0] + behind[1] * vehicle[1] < 0.0, "{behind:?} {vehicle:?}");
    }
}
