//! Vehicles of a case that momentum alone determines.

use planar_impact::{ForwardLeft, Side};

use super::{CaseReader, has_inertia};
use crate::case::rest::{RestInputs, WholeVehicle};
use crate::case::uncertain::UncertainInput;
use crate::case::vehicle::{Inertia, VehicleInputs};
use crate::document::Table;
use crate::notice::Notice;
use crate::units::Measure;

/// Inertia of a vehicle whose yaw does not take part: any will do.
pub(super) const ANY_INERTIA: Inertia = Inertia::Radius(1.0);

impl CaseReader {
    /// Returns `true` if each vehicle that slides to rest has a yaw inertia, and reports those that have none.
    pub(super) fn rests_have_inertia(&self, root: &Table<'_>) -> bool {
        let (Some(rest), Some(vehicles)) = (root.optional("rest").table(), root.optional("vehicle").array_of_tables()) else { return true };
        let Some(rests) = rest.optional("vehicle").table() else { return true };
        let mut all = true;
        for (key, vehicle) in ["1", "2"].into_iter().zip(&vehicles) {
            if rests.has(key) && !has_inertia(vehicle) {
                let help = "give `yaw_inertia` or `radius_of_gyration`, or its separation velocity in place of its rest".to_owned();
                rests.optional(key).report("its slide to rest needs its yaw inertia", Some(help));
                all = false;
            }
        }
        all
    }

    /// Returns `true` if both vehicles have a yaw inertia and an impact center, so that the impulse also changes their yaw rates. Reports a barrier, which takes any
    /// momentum.
    pub(super) fn is_angular(&self, root: &Table<'_>, vehicles: [&Option<VehicleInputs>; 2]) -> Option<bool> {
        let tables = root.optional("vehicle").array_of_tables()?;
        if vehicles.iter().any(|vehicle| vehicle.is_none()) {
            let help = "give the barrier a contact: `crush_plane` and `restitution`, without `model`".to_owned();
            root.optional("vehicle").report("momentum alone needs two vehicles: a barrier takes any momentum", Some(help));
            return None;
        }
        Some(tables.iter().all(|table| table.has("impact_center") && has_inertia(table)))
    }

    /// Makes both vehicles point masses in the collision; the slides to rest keep what the file gives of them.
    pub(super) fn make_point_masses(
        &self,
        root: &Table<'_>,
        vehicles: [&mut Option<VehicleInputs>; 2],
        rest: Option<&mut RestInputs>,
    ) -> Option<()> {
        let tables = root.optional("vehicle").array_of_tables()?;
        if tables.iter().any(|table| table.has("impact_center") || has_inertia(table)) {
            let slides = if rest.is_some() { ", except in slides to rest" } else { "" };
            let message = format!(
                "yaw inertia and impact center take part only if both vehicles give both: the vehicles are point masses here{slides}"
            );
            self.notices.borrow_mut().push(Notice::note("point-masses", "vehicle", message));
        }
        let (others, take_part): (Vec<UncertainInput>, _) =
            self.uncertain.take().into_iter().partition(|input| input.parameter.is_of_extended_body());
        self.uncertain.replace(take_part);
        let mut rests = rest.map_or([None, None], |rest| rest.vehicles.each_mut().map(Option::as_mut)).into_iter();
        for ((table, vehicle), side) in tables.iter().zip(vehicles.into_iter().flatten()).zip(Side::ALL) {
            self.record_unused(table, vehicle);
            if let Some(rest) = rests.next().flatten() {
                let uncertain = others.iter().filter(|input| input.parameter.side() == Some(side)).cloned().collect();
                rest.whole = Some(WholeVehicle { inputs: vehicle.clone(), uncertain });
            }
            (vehicle.inertia, vehicle.impact_center) = (ANY_INERTIA, ForwardLeft { forward: 0.0, left: 0.0 });
        }
        Some(())
    }

    /// Records what the file gives of a vehicle that becomes a point mass, so that a comparison of files shows it.
    fn record_unused(&self, table: &Table<'_>, vehicle: &VehicleInputs) {
        let record = |key: &str, value: f64, measure: Measure| {
            let path = format!("{}.{key}", table.path());
            self.contents.borrow_mut().numbers(&path, [(path.clone(), value, measure)]);
        };
        match vehicle.inertia {
            Inertia::Yaw(inertia) if table.has("yaw_inertia") => record("yaw_inertia", inertia, Measure::YawInertia),
            Inertia::Radius(radius) if table.has("radius_of_gyration") => record("radius_of_gyration", radius, Measure::Length),
            _ => (),
        }
        if table.has("impact_center") {
            record("impact_center.1", vehicle.impact_center.forward, Measure::Length);
            record("impact_center.2", vehicle.impact_center.left, Measure::Length);
        }
    }
}
