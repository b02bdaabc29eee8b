//! What a page shows while a handle is dragged: one call a frame.

use planar_impact_app::gradient::{self, Selection};
use planar_impact_app::{Case, Issues, Uncontrolled, Units, scene, solve};
use planar_impact_report::page;
use planar_impact_report::{chart, html};
use serde::Serialize;
use wasm_bindgen::prelude::*;

use crate::input::{self, Input};
use crate::reply::Reply;

/// The answer of a frame.
#[wasm_bindgen(getter_with_clone)]
#[derive(Default)]
pub struct Frame {
    /// The scene as SVG.
    #[wasm_bindgen(readonly)]
    pub scene: String,
    /// The impulse plane as SVG; empty where momentum alone determines the impulse.
    #[wasm_bindgen(readonly)]
    pub impulse: String,
    /// The account of energy as SVG.
    #[wasm_bindgen(readonly)]
    pub energy: String,
    /// The tables of `solve` as HTML.
    #[wasm_bindgen(readonly)]
    pub tables: String,
    /// The tables of `gradient` as HTML.
    #[wasm_bindgen(readonly)]
    pub gradient: String,
    /// Handles of the scene, as JSON.
    #[wasm_bindgen(readonly)]
    pub handles: String,
    /// Why there is no answer, as a JSON array of issues.
    #[wasm_bindgen(readonly)]
    pub issues: String,
    /// `input`, `physics` or `defect` with issues.
    #[wasm_bindgen(readonly)]
    pub cause: String,
    /// `true` if the case has unknowns, so that `reconstruct` answers it.
    #[wasm_bindgen(readonly)]
    pub has_unknowns: bool,
}

/// Where the scene lies on the page, and what can be dragged.
#[derive(Serialize)]
struct Handles {
    origin: (f64, f64),
    scale: f64,
    speed: f64,
    normal: f64,
    impact_point: [f64; 2],
    crush_plane: f64,
    restitution: f64,
    vehicles: [Option<HandlesOfVehicle>; 2],
}

#[derive(Serialize)]
struct HandlesOfVehicle {
    name: String,
    position: [f64; 2],
    heading: f64,
    velocity: [f64; 2],
    /// `true` if the file gives components, `false` if a speed along the heading.
    has_components: bool,
    impact_center: [f64; 2],
    /// From the center of mass to the rear end, in m.
    rear: f64,
}

/// Computes a frame of a case, which is JSON.
#[wasm_bindgen]
pub fn frame(case: &str) -> Frame {
    let refused = |issues: &Issues, units| {
        let Reply { issues, cause, .. } = Reply::refusal(issues, units);
        Frame { issues, cause, ..Frame::default() }
    };
    let input = match input::read::<Input>(case) {
        Ok(input) => input,
        Err(issues) => return refused(&issues, Units::Si),
    };
    let case = match input.case() {
        Ok(case) => case,
        Err(issues) => return refused(&issues, input.units_or(Units::Si)),
    };
    if !case.knowledge.unknowns.is_empty() || case.model.is_momentum() {
        return Frame { has_unknowns: true, ..Frame::default() };
    }
    let units = input.units(&case);
    of(&case, units).unwrap_or_else(|issues| refused(&issues, units))
}

fn of(case: &Case, units: Units) -> Result<Frame, Issues> {
    let solution = solve::solve(case, &(), &Uncontrolled)?;
    let drawn = scene::draw_solved(case)?;
    let principal = gradient::Options { of: Selection::Principal, wrt: Selection::Principal, second: false };
    let gradient = gradient::gradient(case, &principal, &Uncontrolled)?;
    Ok(Frame {
        scene: planar_impact_report::scene::scene(&drawn, units),
        impulse: chart::impulse(&solution, units)?.unwrap_or_default(),
        energy: chart::energy(&solution, units)?,
        tables: html::fragment(&page::page(&solution, units)),
        gradient: html::fragment(&page::page(&gradient, units)),
        handles: serde_json::to_string(&handles(case, &drawn, units)).map_err(Issues::defect)?,
        ..Frame::default()
    })
}

fn handles(case: &Case, drawn: &scene::Scene, units: Units) -> Handles {
    let placing = planar_impact_report::scene::placing(drawn, units);
    let vehicle = |i: usize| {
        let vehicle = &drawn.vehicles[i];
        let inputs = case.inputs.vehicles[i].as_ref()?;
        Some(HandlesOfVehicle {
            name: vehicle.name.clone(),
            position: vehicle.position,
            heading: vehicle.heading,
            velocity: vehicle.before.velocity,
            has_components: matches!(inputs.velocity, planar_impact_app::case::Velocity::Components(_)),
            impact_center: vehicle.impact_center,
            rear: vehicle.outline.as_ref().map_or(2.0, |outline| outline.rear),
        })
    };
    Handles {
        origin: placing.origin,
        scale: placing.scale,
        speed: placing.speed,
        normal: placing.normal,
        impact_point: drawn.impact_point,
        crush_plane: drawn.crush_plane.unwrap_or(case.inputs.contact.crush_plane),
        restitution: case.collision.restitution,
        vehicles: [vehicle(0), vehicle(1)],
    }
}
