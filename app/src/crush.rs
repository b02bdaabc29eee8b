//! The verb `crush`: computes crush energy and equivalent speed from residual crush.

use planar_impact::crash3::{Surface, force_correction};
use planar_impact::crush::{CrushStiffness, ForceLine, MOST_FORCE_IMBALANCE, ProfileMoments, force_imbalance};
use planar_impact::reconstruct::Variable;
use planar_impact::{ForceDirection, Input};
use schemars::JsonSchema;
use serde::Serialize;

use crate::answer::Answer;
use crate::case::{Case, Crush, CrushOutputs};
use crate::control::Control;
use crate::crash3::name_of;
use crate::issue::{Issue, Issues};
use crate::named::positive_zero;
use crate::notice::Notice;

/// The crush of both vehicles, in SI and radians.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct CrushAnswer {
    /// The names of the vehicles.
    pub names: [String; 2],
    /// The crush of each vehicle; `null` for a vehicle without crush, zeros for a barrier.
    pub vehicles: [Option<VehicleCrush>; 2],
    /// By how much the larger of the forces at the PDOF exceeds the smaller, as a share of the smaller: 0 by Newton's third law, and at most 1 by EDCRASH's
    /// diagnostics; `null` unless both are known.
    pub force_imbalance: Option<f64>,
}

/// The crush of a vehicle.
#[derive(Clone, Debug, Default, PartialEq, Serialize, JsonSchema)]
pub struct VehicleCrush {
    /// The name of the vehicle.
    pub name: String,
    /// `true` if it is a fixed barrier.
    pub barrier: bool,
    /// Width w of the crush in m.
    pub width: f64,
    /// Number of measured depths.
    pub depths: usize,
    /// Mean depth in m.
    pub mean_depth: f64,
    /// Moments K1, K2, K3 of the profile, in m, m², m³.
    #[serde(rename = "K")]
    pub moments: [f64; 3],
    /// Form factor: the mean of the squared depths over the square of their mean, 1 for a uniform crush; `null` without crush.
    pub form_factor: Option<f64>,
    /// Stiffness; `null` if each zone has its own.
    #[serde(flatten)]
    pub stiffness: Stiffness,
    /// Crush energy E_C in J.
    pub crush_energy: f64,
    /// Speed at which the crush energy is the vehicle's kinetic energy, in m/s.
    pub equivalent_energy_speed: f64,
    /// Force normal to the surface at the end of the crush, the integral of A + B C over the width, in N; `null` without crush.
    pub crush_force: Option<f64>,
    /// Principal direction of force in rad that `crush_force_at_pdof` is for: that of the file, or of the common-velocity impulse; `null` if neither is known.
    pub pdof: Option<f64>,
    /// The surface from whose perpendicular the angle of the force is taken; `null` without `pdof`.
    pub surface: Option<&'static str>,
    /// The force along the PDOF, in N: `crush_force` over the cosine of the angle; `null` if the force does not point into the surface.
    pub crush_force_at_pdof: Option<f64>,
    /// Depth beyond which the force is constant, in m, if the file gives one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub saturation: Option<f64>,
    /// The zones along the width, if there are several.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    #[schemars(default)]
    pub zones: Vec<Zone>,
}

/// A stiffness in its equivalent forms.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Stiffness {
    /// d0 in √N.
    pub d0: Option<f64>,
    /// d1 in √N/m.
    pub d1: Option<f64>,
    /// A = d0 d1 in N/m.
    #[serde(rename = "A")]
    pub force: Option<f64>,
    /// B = d1² in N/m².
    #[serde(rename = "B")]
    pub force_per_depth: Option<f64>,
    /// G = d0²/2 in N.
    #[serde(rename = "G")]
    pub without_crush: Option<f64>,
}

/// A zone of a crush.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Zone {
    /// Its end, in m from the first station; `null` for the last zone.
    pub to: Option<f64>,
    /// Its width in m.
    pub width: f64,
    /// Moments K1, K2, K3 of its part of the profile.
    #[serde(rename = "K")]
    pub moments: [f64; 3],
    /// Its stiffness.
    #[serde(flatten)]
    pub stiffness: Stiffness,
    /// Its crush energy in J.
    pub crush_energy: f64,
}

impl Default for Stiffness {
    fn default() -> Self {
        Stiffness { d0: Some(0.0), d1: Some(0.0), force: Some(0.0), force_per_depth: Some(0.0), without_crush: Some(0.0) }
    }
}

/// Computes the crush energy and the equivalent speed of each vehicle that has a crush. The vehicles need not collide.
///
/// # Errors
///
/// A mass that the case lists as unknown, or that no vehicle has a crush.
pub fn crush(case: &Case, _: &(), _: &dyn Control) -> Result<Answer<CrushAnswer>, Issues> {
    case.needs(|of| matches!(of, Variable::Input(Input::Mass(_))))?;
    if case.setup.crush.iter().all(Option::is_none) {
        let help = "give a [vehicle.crush] with width, depths and stiffness under a [[vehicle]]";
        return Err(case.unfit([Issue::at("no-crush", "vehicle", "no vehicle has a crush").with_help(help)]));
    }
    let outputs = case.setup.crush_outputs();
    let parties = case.collision.parties();
    let directions = directions_of_force(case);
    let vehicle = |i: usize| match (parties[i].vehicle(), &case.setup.crush[i], &outputs[i]) {
        (None, ..) => Some(VehicleCrush { name: case.names[i].clone(), barrier: true, ..VehicleCrush::default() }),
        (Some(_), Some(crush), Some(outputs)) => Some(VehicleCrush::of(&case.names[i], crush, outputs).at(directions[i])),
        _ => None,
    };
    let vehicles = [vehicle(0), vehicle(1)];
    let [one, two] = vehicles.each_ref().map(|vehicle| vehicle.as_ref().and_then(|vehicle| vehicle.crush_force_at_pdof));
    // Beside a stiffness without force there is no share.
    let force_imbalance = one.zip(two).map(|(one, two)| force_imbalance([one, two])).filter(|share| share.is_finite());
    let warning = force_imbalance.filter(|imbalance| *imbalance > MOST_FORCE_IMBALANCE).map(|_| {
        let message = "the crush forces on the two vehicles, which are one and the same, differ by more than EDCRASH's diagnostics accept; check stiffness, \
                       depths and pdof of both";
        Notice::warning("crush-forces-not-balanced", "vehicle", message)
    });
    let leaves = |(i, direction): (usize, &Option<(Surface, ForceDirection)>)| {
        let (surface, origin) = direction.as_ref()?;
        pulling(i, *surface, origin)
    };
    let warnings = directions.iter().enumerate().filter_map(leaves).chain(warning);
    Ok(case.answer(CrushAnswer { names: case.names.clone(), vehicles, force_imbalance }, warnings))
}

/// Returns the surface and the direction of the principal force of each vehicle, as `crash3` takes them; `None` where they follow from a collision that is not
/// known, or that has no common velocity.
fn directions_of_force(case: &Case) -> [Option<(Surface, ForceDirection)>; 2] {
    let is_known = case.knowledge.left_out.is_empty() && !case.model.is_momentum();
    let has_common_velocity = is_known && case.collision.at_common_velocity().solve().is_ok();
    let pair = case.setup.damaged_along([0.0; 2]);
    [(pair.one, 0), (pair.two, 1)].map(|(damaged, i)| {
        let crush = case.setup.crush[i].as_ref()?;
        let has_direction = crush.force_direction.is_some() || has_common_velocity;
        let has_surface = crush.surface.is_some() || is_known;
        damaged.filter(|_| has_direction && has_surface).map(|damaged| (damaged.surface, damaged.force_direction))
    })
}

/// Returns the force along its direction as a multiple of that across the surface; `None` if it runs along the surface or leaves it.
fn pressing(surface: Surface, direction: &ForceDirection) -> Option<f64> {
    /// A force so many times that across the surface runs along it.
    const ALONG: f64 = 1e6;
    force_correction(surface, direction).filter(|correction| *correction < ALONG)
}

/// Returns a warning of a force that does not press on the damaged surface of a vehicle.
pub(crate) fn pulling(place: usize, surface: Surface, direction: &ForceDirection) -> Option<Notice> {
    let path = format!("vehicle.{}", place + 1);
    let message = format!("{path}: the force does not press on the damaged surface; check `surface` and the sign of `pdof`");
    pressing(surface, direction).is_none().then(|| Notice::warning("pulling-force", path, message))
}

impl VehicleCrush {
    fn of(name: &str, crush: &Crush, outputs: &CrushOutputs) -> Self {
        let zones = crush.zones.zones();
        let zone = |(i, moments): (usize, ProfileMoments)| Zone {
            to: crush.zones.borders().get(i).copied(),
            width: moments.width(),
            moments: of_moments(moments),
            stiffness: Stiffness::of(&zones[i]),
            crush_energy: positive_zero(zones[i].crush_energy(moments)),
        };
        let one = zones.len() == 1;
        let is_crushed = outputs.mean_depth > 0.0;
        let mean_square = outputs.moments.third / outputs.moments.first;
        VehicleCrush {
            name: name.to_owned(),
            width: crush.profile.width(),
            depths: crush.profile.depths().len(),
            mean_depth: positive_zero(outputs.mean_depth),
            moments: of_moments(outputs.moments),
            form_factor: is_crushed.then(|| mean_square / (outputs.mean_depth * outputs.mean_depth)),
            crush_force: is_crushed.then(|| crush.force()),
            stiffness: if one { Stiffness::of(&zones[0]) } else { Stiffness::none() },
            crush_energy: positive_zero(outputs.energy),
            equivalent_energy_speed: positive_zero(outputs.equivalent_speed),
            saturation: crush.saturation,
            zones: if one { Vec::new() } else { crush.zones.moments(&crush.profile).enumerate().map(zone).collect() },
            ..VehicleCrush::default()
        }
    }

    /// Adds the force along a principal direction of force.
    fn at(self, direction: Option<(Surface, ForceDirection)>) -> Self {
        let Some((surface, origin)) = direction else { return self };
        let along = self.crush_force.zip(pressing(surface, &origin)).map(|(force, factor)| force * factor);
        VehicleCrush {
            pdof: Some(positive_zero(origin.direction())),
            surface: Some(name_of(surface)),
            crush_force_at_pdof: along.filter(|force| force.is_finite()),
            ..self
        }
    }
}

impl Stiffness {
    fn of(stiffness: &CrushStiffness) -> Self {
        let force = ForceLine::from(*stiffness);
        Stiffness {
            d0: Some(positive_zero(stiffness.onset)),
            d1: Some(positive_zero(stiffness.slope)),
            force: Some(positive_zero(force.onset)),
            force_per_depth: Some(positive_zero(force.slope)),
            without_crush: Some(positive_zero(stiffness.energy_without_crush())),
        }
    }

    fn none() -> Self {
        Stiffness { d0: None, d1: None, force: None, force_per_depth: None, without_crush: None }
    }
}

fn of_moments(moments: ProfileMoments) -> [f64; 3] {
    [moments.first, moments.second, moments.third].map(positive_zero)
}
