//! The scene of a collision, drawn to scale as SVG.

mod barrier;
mod dial;
mod impact;
mod labels;
mod legend;
mod overview;
mod phases;
mod vehicle;
mod view;

use planar_impact_app::plain_text::shorten;
use planar_impact_app::scene::Scene;
use planar_impact_app::units::{Measure, beyond_rounding};
use planar_impact_app::{Answer, Units};

use crate::svg::{INK, Svg, fitting, text_width};

/// Width of the page in pixels, and of its margin.
const WIDTH: f64 = 1000.0;
const MARGIN: f64 = 20.0;
/// Width of the picture of the impact, and height.
const IMPACT: (f64, f64) = (666.0, 560.0);
/// Height of a picture of a phase.
const PHASE: f64 = 200.0;
/// Greatest height of the picture of skids and rest positions.
const OVERVIEW: f64 = 340.0;
/// Sizes of text.
const TITLE: f64 = 20.0;
const TEXT: f64 = 14.0;
const SMALL: f64 = 12.0;

/// Stroke, fill, dashes of the fill pattern, and color of text of a vehicle. The fills differ in lightness, so they do in grey.
#[derive(Clone, Copy)]
struct Style {
    stroke: &'static str,
    fill: &'static str,
}

const STYLES: [Style; 2] = [Style { stroke: "#0060a0", fill: "#dcecf8" }, Style { stroke: "#a83c00", fill: "#f6d3b8" }];

/// How the picture of the impact lies on the page, for an interface in which it can be dragged.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placing {
    /// Place of the origin of the ground: pixels to the right, pixels down.
    pub origin: (f64, f64),
    /// Pixels of a meter.
    pub scale: f64,
    /// Length on the ground of the arrow of a speed of 1 m/s, in m.
    pub speed: f64,
    /// Length on the ground of the normal of the crush plane, in m.
    pub normal: f64,
}

/// Frame of the picture of the impact.
const FRAME: view::Frame = view::Frame { x: MARGIN, y: 50.0, width: IMPACT.0, height: IMPACT.1 };

/// Returns how the picture of the impact lies on the page of [`scene`].
pub fn placing(scene: &Scene, units: Units) -> Placing {
    impact::placing(scene, units, FRAME)
}

/// Draws a scene: the impact with its vectors, the principal directions of force, the phases and, where the case has them, skids and rest positions.
pub fn scene(answer: &Answer<Scene>, units: Units) -> String {
    let scene = &answer.facts;
    let title = if answer.title.trim().is_empty() { "Scene of the collision".to_owned() } else { answer.title.clone() };
    let notes = notes(answer, units);
    let has_overview = overview::is_needed(scene);
    let phases_at = 50.0 + IMPACT.1 + 12.0;
    let overview_at = phases_at + PHASE + 24.0;
    let overview_height = if has_overview { overview::height(scene, WIDTH - 2.0 * MARGIN, OVERVIEW) } else { 0.0 };
    let notes_at = overview_at + if has_overview { overview_height + 12.0 } else { 0.0 };
    let height = notes_at + 18.0 * notes.len() as f64 + 12.0;
    let mut svg = Svg::new(WIDTH, height, &shorten(&title, 200), &description(scene, units));
    svg.element("rect", &[("width", "100%"), ("height", "100%"), ("fill", "#ffffff")]);
    svg.text((MARGIN, 32.0), TITLE, "title", &fitting(&title, TITLE, WIDTH - 2.0 * MARGIN));
    impact::draw(&mut svg, scene, units, FRAME);
    legend::draw(
        &mut svg,
        scene,
        units,
        view::Frame { x: MARGIN + IMPACT.0 + 14.0, y: 50.0, width: WIDTH - 2.0 * MARGIN - IMPACT.0 - 14.0, height: IMPACT.1 },
    );
    phases::draw(&mut svg, scene, units, view::Frame { x: MARGIN, y: phases_at, width: WIDTH - 2.0 * MARGIN, height: PHASE });
    if has_overview {
        overview::draw(
            &mut svg,
            scene,
            units,
            view::Frame { x: MARGIN, y: overview_at, width: WIDTH - 2.0 * MARGIN, height: overview_height },
        );
    }
    for (row, note) in notes.iter().enumerate() {
        svg.text((MARGIN, notes_at + 14.0 + 18.0 * row as f64), SMALL, "note", note);
    }
    svg.finish()
}

/// The notices of the answer in lines that fit the page.
fn notes(answer: &Answer<Scene>, units: Units) -> Vec<String> {
    let most = ((WIDTH - 2.0 * MARGIN) / text_width("m", SMALL)) as usize;
    let of_text = answer.notices.0.iter().map(|notice| units.sentence(&notice.message) + ".");
    of_text
        .flat_map(|text| {
            textwrap::wrap(&planar_impact_app::plain_text::shown(&text), most).into_iter().map(|line| line.into_owned()).collect::<Vec<_>>()
        })
        .collect()
}

/// Formats an angle or a velocity, 0 if it is rounding beside those of vehicles.
fn quantity(units: Units, measure: Measure, value: f64) -> String {
    units.quantity(measure, beyond_rounding(value, 1.0))
}

/// What the drawing shows, in words.
fn description(scene: &Scene, units: Units) -> String {
    let of = |number: usize| {
        let vehicle = &scene.vehicles[number - 1];
        if vehicle.barrier {
            return format!("Vehicle {number}, {}, is a fixed barrier.", vehicle::name(vehicle));
        }
        format!(
            "Vehicle {number}, {}, heads to {}, {} before and {} after the impact; principal direction of force {}.",
            vehicle::name(vehicle),
            quantity(units, Measure::Angle, vehicle.heading),
            quantity(units, Measure::RoadSpeed, vehicle.speed_before()),
            quantity(units, Measure::RoadSpeed, vehicle.speed_after()),
            quantity(units, Measure::Angle, vehicle.pdof),
        )
    };
    let plane = scene.crush_plane.map(|gamma| format!(" Crush plane at {}.", units.quantity(Measure::Angle, gamma)));
    format!("{} {}{}", of(1), of(2), plane.unwrap_or_default())
}

/// Attributes of a frame around a picture.
fn border<'a>() -> [(&'a str, &'a str); 3] {
    [("fill", "none"), ("stroke", "#b8b8b8"), ("stroke-width", "1")]
}

/// Attributes of a thin line.
fn thin<'a>() -> [(&'a str, &'a str); 2] {
    [("stroke", INK), ("stroke-width", "1.2")]
}
