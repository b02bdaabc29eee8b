//! The residual crush of a vehicle, placed on its outline.

use planar_impact::ForwardLeft;
use planar_impact::crash3::Surface;
use schemars::JsonSchema;
use serde::Serialize;

use super::outline::Outline;
use crate::case::CrushInputs;
use crate::crash3::name_of;

/// The residual crush on the outline of a vehicle, in its axes: forward and left of the center of mass, in m.
///
/// Stations run from left to right at the front and the rear, and from the rear to the front on the sides, as investigators count them. The case does not say
/// where along the surface the crush lies: its middle is drawn at the impact center, as far as the outline allows.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Damage {
    /// The crushed surface: `front`, `right`, `rear` or `left`.
    pub surface: &'static str,
    /// `true` if the case names the surface; otherwise it is the one along the crush plane.
    pub is_given: bool,
    /// The stations on the undamaged surface.
    pub undamaged: Vec<[f64; 2]>,
    /// The crushed surface at the same stations.
    pub crushed: Vec<[f64; 2]>,
    /// Where one zone of stiffness ends and the next begins, on the undamaged surface.
    pub borders: Vec<[f64; 2]>,
}

impl Damage {
    pub(super) fn of(crush: &CrushInputs, surface: Surface, outline: &Outline, center: ForwardLeft) -> Damage {
        let profile = crush.profile.on_scalar(|_| 0.0);
        let stations = profile.stations();
        let width = profile.width();
        // Along the surface, from the first station to the last.
        let (from, to, at) = match surface {
            Surface::Front | Surface::Rear => (-outline.half_width, outline.half_width, -center.left),
            Surface::Right | Surface::Left => (-outline.rear, outline.front, center.forward),
        };
        let first = if width >= to - from { (from + to - width) / 2.0 } else { (at - width / 2.0).clamp(from, to - width) };
        let start = stations.first().copied().unwrap_or(0.0);
        let place = |station: f64, depth: f64| {
            let along = first + station - start;
            match surface {
                Surface::Front => [outline.front - depth, -along],
                Surface::Rear => [-outline.rear + depth, -along],
                Surface::Right => [along, -outline.half_width + depth],
                Surface::Left => [along, outline.half_width - depth],
            }
        };
        Damage {
            surface: name_of(surface),
            is_given: crush.surface.is_some(),
            undamaged: stations.iter().map(|station| place(*station, 0.0)).collect(),
            crushed: stations.iter().zip(profile.depths()).map(|(station, depth)| place(*station, *depth)).collect(),
            borders: crush.borders.iter().map(|border| place(*border, 0.0)).collect(),
        }
    }
}
