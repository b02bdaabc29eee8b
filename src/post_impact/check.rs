//! Checks of the input of a slide.

use super::ground::{Area, Region};
use super::issue::SlideIssue;
use super::slide::Slide;
use super::tire::Restraint;
use super::vehicle::{Pose, SlidingVehicle};
use crate::issue::{IssueCollector, Place};
use crate::measure::Measure;
use crate::scalar::Field as _;

/// Largest accepted coefficient of friction: no tire transmits more than this many times its load.
pub const MOST_FRICTION: f64 = 10.0;

/// Steepest accepted grade, as height over horizontal distance along x or y.
pub const MOST_GRADE: f64 = 1.0;

impl Slide {
    /// Returns the issues of the vehicle and of the ground.
    pub(super) fn issues(&self) -> IssueCollector<SlideIssue> {
        let mut issues = IssueCollector::<SlideIssue>::new();
        let (vehicle, ground) = (&self.vehicle, &self.ground);
        issues.positive(Place::of("mass", Measure::Mass), &vehicle.mass);
        issues.positive(Place::of("yaw_inertia", Measure::YawInertia), &vehicle.yaw_inertia);
        issues.positive(Place::of("front_axle", Measure::Length), &vehicle.front_axle);
        issues.positive(Place::of("rear_axle", Measure::Length), &vehicle.rear_axle);
        issues.positive(Place::of("track", Measure::Length), &vehicle.track);
        let wheels = &vehicle.wheels;
        for (index, wheel) in [&wheels.front_left, &wheels.front_right, &wheels.rear_left, &wheels.rear_right].into_iter().enumerate() {
            issues.finite(Place::of("wheel.steer", Measure::Angle).at(index), &wheel.steer);
            if let Restraint::Braked(fraction) = wheel.restraint {
                issues.within(Place::plain("wheel.braking").at(index), &fraction, 0.0, Some(1.0));
            }
        }
        issues.within(Place::plain("rolling_resistance"), &vehicle.tires.rolling_resistance, 0.0, Some(MOST_FRICTION));
        issues.positive(Place::plain("slip_angle"), &vehicle.tires.slip_angle);
        issues.positive(Place::of("regularization", Measure::Speed), &vehicle.tires.regularization);
        issues.within(Place::plain("friction"), &ground.friction, 0.0, Some(MOST_FRICTION));
        issues.positive(Place::of("gravity", Measure::Acceleration), &ground.gravity);
        issues.positive(Place::of("contact_length", Measure::Length), &ground.contact_length);
        for (axis, grade) in [("grade.x", ground.grade.x), ("grade.y", ground.grade.y)] {
            issues.within(Place::plain(axis), &grade, -MOST_GRADE, Some(MOST_GRADE));
        }
        for (index, region) in ground.regions.iter().enumerate() {
            check_region(&mut issues, index, region);
        }
        issues
    }
}

/// Checks that a vehicle has the proportions of one. The slide of any other can be followed, but the search for its separation would take long and mean nothing.
pub(super) fn check_proportions(issues: &mut IssueCollector<SlideIssue>, vehicle: &SlidingVehicle) {
    /// Largest track, in wheelbases.
    const WIDEST: f64 = 3.0;
    /// Least and greatest radius of gyration, in distances of the farthest wheel from the center of mass: those of cars and trucks are 0.6 to 1.2.
    const GYRATION: [f64; 2] = [0.05, 5.0];
    let SlidingVehicle { mass, yaw_inertia, front_axle, rear_axle, track, .. } = *vehicle;
    if ![mass, yaw_inertia, front_axle, rear_axle, track].iter().all(|value| value.is_finite() && *value > 0.0) {
        return;
    }
    let farthest_squared = front_axle.max(rear_axle).squared() + (track / 2.0).squared();
    let [least, greatest] = GYRATION.map(|radius| to_two_digits(mass * radius * radius * farthest_squared));
    if issues.within(Place::of("track", Measure::Length), &track, 0.0, Some(to_two_digits(WIDEST * (front_axle + rear_axle)))) {
        issues.within(Place::of("yaw_inertia", Measure::YawInertia), &yaw_inertia, least, Some(greatest));
    }
}

/// Rounds a limit to two digits: more would suggest that it is exact.
fn to_two_digits(value: f64) -> f64 {
    let digits = libm::exp10(1.0 - libm::log10(value).floor());
    (value * digits).round() / digits
}

/// Checks a pose, given the names of its position and heading.
pub(super) fn check_pose(issues: &mut IssueCollector<SlideIssue>, [x, y, heading]: [&'static str; 3], pose: &Pose) {
    issues.finite(Place::of(x, Measure::Length), &pose.position.x);
    issues.finite(Place::of(y, Measure::Length), &pose.position.y);
    issues.finite(Place::of(heading, Measure::Angle), &pose.heading);
}

fn check_region(issues: &mut IssueCollector<SlideIssue>, index: usize, region: &Region) {
    issues.within(Place::plain("region.friction").at(index), &region.friction, 0.0, Some(MOST_FRICTION));
    for (axis, grade) in [("region.grade.x", region.grade.x), ("region.grade.y", region.grade.y)] {
        issues.within(Place::plain(axis).at(index), &grade, -MOST_GRADE, Some(MOST_GRADE));
    }
    let corners: &[_] = match &region.area {
        Area::HalfPlane { from, toward } => &[*from, *toward],
        Area::Polygon(corners) => corners,
    };
    // One issue for all corners of a region.
    let corner = Place::of("region.corner", Measure::Length).at(index);
    let finite = corners.iter().flat_map(|corner| [corner.x, corner.y]).all(|value| value.is_finite() || issues.finite(corner, &value));
    if finite && !region.area.has_inside() {
        issues.push(SlideIssue::NoArea { region: index });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::post_impact::{Wheel, Wheels};

    #[test]
    fn a_track_is_at_most_three_wheelbases() {
        // 3 (1.2 + 1.4) = 7.8.
        for (track, is_refused) in [(1.5, false), (7.7, false), (7.9, true)] {
            let vehicle = SlidingVehicle { front_axle: 1.2, rear_axle: 1.4, track, ..SlidingVehicle::sedan(Wheels::all(Wheel::LOCKED)) };
            let mut issues = IssueCollector::<SlideIssue>::new();
            check_proportions(&mut issues, &vehicle);
            assert_eq!(issues.finish().is_err(), is_refused, "{track}");
        }
    }
}
