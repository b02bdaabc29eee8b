//! The keys of `[rest]`, the rest positions.

use planar_impact::Xy;
use planar_impact::post_impact::{
    Area, Ground, MOST_FRICTION, MOST_GRADE, Method, PathPoint, Pose, Region, RestEvidence, Restraint, Slide, SlidingVehicle, Tires, Wheel,
    WheelPosition, Wheels,
};

use super::measured::{Amount, Measured};
use super::{CaseReader, one_of};
use crate::case::rest::{GivenPose, RestInputs, RestOfVehicle, WHEELS};
use crate::case::vehicle::VehicleInputs;
use crate::document::{Field, Table, Value};
use crate::quantity::Kind;
use crate::units::{Measure, trim};
use crate::unusual;

/// Maximum number of regions, and of corners of a region: each one is evaluated in every step.
const MOST_REGIONS: usize = 32;
const MOST_CORNERS: usize = 256;
/// Maximum number of points along a path.
const MOST_POINTS: usize = 64;

/// A value and its standard deviation, if the file gives one.
struct Estimate {
    value: f64,
    deviation: Option<f64>,
}

/// The ground under both vehicles, and the relative uncertainty of its friction.
struct GivenGround {
    ground: Ground,
    friction_deviation: f64,
}

/// Returns a share of a grade that the ground may have, or reports it.
pub(super) fn within_grade(place: &Field<'_>, share: f64, least: f64) -> Option<f64> {
    if (least..=MOST_GRADE).contains(&share) {
        return Some(share);
    }
    let help = "a grade is height over distance, as \"2 %\" or 0.02, and positive uphill";
    place.report_as("out-of-range", format!("it is {share}; it must be from {least} to {MOST_GRADE}"), Some(help.to_owned()));
    None
}

impl CaseReader {
    /// Reads `[rest]`. Reads it even if the vehicles are invalid, to report its own issues.
    pub(super) fn rest(
        &self,
        root: &Table<'_>,
        vehicles: Option<[Option<&VehicleInputs>; 2]>,
        impact_point: Option<Xy>,
    ) -> Option<RestInputs> {
        let rest = root.optional("rest").table()?;
        let ground = self.ground(&rest);
        let tables = rest.required("vehicle").table();
        rest.finish();
        let tables = tables?;
        let read = [("1", 0), ("2", 1)].map(|(number, i)| {
            if !tables.has(number) {
                return Some(None);
            }
            let field = tables.optional(number);
            if vehicles.is_some_and(|vehicles| vehicles[i].is_none()) {
                field.report(format!("vehicle {number} is a fixed barrier, which stays where it is"), None);
                return None;
            }
            self.rest_of(&field.table()?, vehicles.and_then(|vehicles| vehicles[i]), ground.as_ref(), impact_point).map(Some)
        });
        tables.finish();
        if !tables.has("1") && !tables.has("2") {
            tables.issue("no vehicle", Some("begin with [rest.vehicle.1] or [rest.vehicle.2]".to_owned()));
            return None;
        }
        let [one, two] = read;
        Some(RestInputs { vehicles: [one?, two?] })
    }

    fn ground(&self, rest: &Table<'_>) -> Option<GivenGround> {
        let friction = self.estimate(rest.required("friction"), Measure::Ratio);
        let friction = friction.filter(|friction| {
            let field = rest.optional("friction");
            let holds = friction.value > 0.0 && friction.value <= MOST_FRICTION;
            if !holds {
                field.report_as("out-of-range", format!("it is {}; it must be above 0 and at most {MOST_FRICTION}", friction.value), None);
            } else if friction.deviation.is_some_and(|deviation| deviation > friction.value) {
                field.report("its standard deviation is larger than itself", None);
                return false;
            }
            holds
        });
        let gravity = if rest.has("gravity") { self.gravity_of_rest(rest.optional("gravity")) } else { Some(self.gravity()) };
        let grade = self.grade(rest);
        let regions = if rest.has("regions") { self.regions(rest.optional("regions"), grade) } else { Some(Vec::new()) };
        let friction = friction?;
        self.warn_of_tires(rest, Some(friction.value));
        self.has_uncertain_rest.set(friction.deviation.is_some_and(|deviation| deviation > 0.0));
        let ground = Ground { grade: grade?, regions: regions?, gravity: gravity?, ..Ground::uniform(friction.value) };
        Some(GivenGround { ground, friction_deviation: friction.deviation.unwrap_or(0.0) / friction.value })
    }

    /// Reads the gravity of `[rest]`, which must not contradict that of the case.
    fn gravity_of_rest(&self, field: Field<'_>) -> Option<f64> {
        let place = field.clone();
        self.uses_gravity.set(true);
        let gravity = self.positive(field, Kind::ACCELERATION)?;
        match self.gravity.get() {
            Some(other) if (gravity - other).abs() > 1e-9 * other => {
                let message = format!("it is {gravity} m/s^2, and the `gravity` of the case is {other} m/s^2");
                place.report(message, Some("give one of them".to_owned()));
                None
            }
            _ => Some(gravity),
        }
    }

    /// Reads a grade: its shares along x and y, or its rise and the direction uphill. Without one the ground is level.
    fn grade(&self, table: &Table<'_>) -> Option<Xy> {
        if !table.has("grade") {
            return Some(Xy::zero());
        }
        let field = table.optional("grade");
        match field.value() {
            Some(Value::Table(_)) => {
                let grade = field.table()?;
                let rise = self.share_of_grade(grade.required("rise"), 0.0);
                let toward = self.quantity(grade.required("toward"), Kind::ANGLE);
                grade.finish();
                let (rise, (sin, cos)) = (rise?, libm::sincos(toward?));
                Some(Xy { x: rise * cos, y: rise * sin })
            }
            _ => {
                let expected =
                    "an array of two shares, along x and y, such as [\"2 %\", \"-1 %\"], or { rise = \"2 %\", toward = \"90 deg\" }";
                let shares = field.items(expected, 2..=2)?;
                let read: Vec<_> = shares.into_iter().map(|share| self.share_of_grade(share, -MOST_GRADE)).collect();
                let [x, y] = read.into_iter().collect::<Option<Vec<_>>>()?.try_into().ok()?;
                Some(Xy { x, y })
            }
        }
    }

    fn share_of_grade(&self, field: Field<'_>, least: f64) -> Option<f64> {
        let place = field.clone();
        within_grade(&place, self.quantity(field, Kind::PURE)?, least)
    }

    fn regions(&self, field: Field<'_>, grade: Option<Xy>) -> Option<Vec<Region>> {
        let place = field.clone();
        let tables = field.array_of_tables()?;
        if tables.len() > MOST_REGIONS {
            place.report(format!("{} regions are more than the {MOST_REGIONS} that are taken", tables.len()), None);
            return None;
        }
        let read: Vec<Option<Region>> = tables.iter().map(|table| self.region(table, grade)).collect();
        read.into_iter().collect()
    }

    /// Warns of a friction of a table that no tire has.
    pub(super) fn warn_of_tires(&self, table: &Table<'_>, friction: Option<f64>) {
        let path = format!("{}.friction", table.path());
        self.notices.borrow_mut().extend(friction.and_then(|friction| unusual::friction_of_tires(&path, friction)));
    }

    /// Reads a region; without a grade of its own it has that of the ground around it.
    fn region(&self, table: &Table<'_>, around: Option<Xy>) -> Option<Region> {
        let friction = self.coefficient(table.required("friction"), MOST_FRICTION);
        let grade = if table.has("grade") { self.grade(table) } else { around };
        let area = match one_of(table, "polygon", "half_plane") {
            Some("polygon") => self.polygon(table.required("polygon")),
            Some(_) => self.half_plane(table.required("half_plane")),
            None => None,
        };
        table.finish();
        self.warn_of_tires(table, friction);
        Some(Region { friction: friction?, grade: grade?, area: area? })
    }

    fn polygon(&self, field: Field<'_>) -> Option<Area> {
        let place = field.clone();
        let items = field.items("an array of 3 to 256 corners, each such as [\"10 m\", \"-5 m\"]", 3..=MOST_CORNERS)?;
        let corners: Vec<Option<Xy>> = items.into_iter().map(|corner| self.pair(corner, Kind::LENGTH).map(|[x, y]| Xy { x, y })).collect();
        let area = Area::Polygon(corners.into_iter().collect::<Option<_>>()?);
        if !area.has_inside() {
            place.report("all its corners lie on a line", None);
            return None;
        }
        if !area.is_simple() {
            place.report("its sides cross each other", Some("give the corners in their order along the border".to_owned()));
            return None;
        }
        Some(area)
    }

    fn half_plane(&self, field: Field<'_>) -> Option<Area> {
        let table = field.table()?;
        let from = self.pair(table.required("from"), Kind::LENGTH);
        let toward = self.quantity(table.required("toward"), Kind::ANGLE);
        table.finish();
        let ([x, y], toward) = (from?, toward?);
        Some(Area::HalfPlane { from: Xy { x, y }, toward: Xy { x: libm::cos(toward), y: libm::sin(toward) } })
    }

    fn rest_of(
        &self,
        table: &Table<'_>,
        inputs: Option<&VehicleInputs>,
        ground: Option<&GivenGround>,
        impact_point: Option<Xy>,
    ) -> Option<RestOfVehicle> {
        let given = self.given_pose(table, impact_point);
        // Only a slide forward does without the rest pose.
        let pose = (table.has("position") || table.has("heading")).then(|| {
            let position = self.position_at_rest(table.required("position"));
            let heading = self.uncertain(table.required("heading"), Measure::Angle, "135 deg ± 5 deg");
            position.zip(heading)
        });
        let points = if table.has("points") { self.path_points(table) } else { Some(Vec::new()) };
        let vehicle = self.sliding_vehicle(table, inputs);
        let method = match table.optional("method").choice(&["slide", "closed-form"]) {
            Some("closed-form") => Method::ClosedForm,
            _ => Method::Slide,
        };
        if table.has("points") && method == Method::ClosedForm {
            table
                .optional("method")
                .report("the closed form follows no path, and `points` lie on one", Some("leave one of them out".to_owned()));
            return None;
        }
        table.finish();
        let GivenGround { ground, friction_deviation } = ground?;
        let given = given?;
        let separation = given.of(inputs);
        let evidence = match pose {
            Some(pose) => {
                let ([(x, x_deviation), (y, y_deviation)], (heading, heading_deviation)) = pose?;
                Some(RestEvidence {
                    separation,
                    rest: Pose { position: Xy { x, y }, heading },
                    position_deviation: Xy { x: x_deviation, y: y_deviation },
                    heading_deviation,
                    friction_deviation: *friction_deviation,
                    points: points?,
                })
            }
            None => None,
        };
        Some(RestOfVehicle { slide: Slide { vehicle: vehicle?, ground: ground.clone() }, separation, given, evidence, method, whole: None })
    }

    /// Reads what the file says of the separation pose.
    fn given_pose(&self, table: &Table<'_>, impact_point: Option<Xy>) -> Option<GivenPose> {
        let mut given = GivenPose { impact_point, ..GivenPose::default() };
        if !table.has("separation") {
            return Some(given);
        }
        let separation = table.optional("separation").table()?;
        let position = separation.has("position").then(|| self.pair(separation.optional("position"), Kind::LENGTH));
        let heading = separation.has("heading").then(|| self.quantity(separation.optional("heading"), Kind::ANGLE));
        separation.finish();
        if let Some(position) = position {
            let [x, y] = position?;
            given.position = Some(Xy { x, y });
        }
        if let Some(heading) = heading {
            given.heading = Some(heading?);
        }
        Some(given)
    }

    fn position_at_rest(&self, field: Field<'_>) -> Option<[(f64, f64); 2]> {
        let items = field.items("an array of two values, each a length with its deviation, such as \"12.3 m ± 0.3 m\"", 2..=2)?;
        let read: Vec<_> = items.into_iter().map(|item| self.uncertain(item, Measure::Length, "12.3 m ± 0.3 m")).collect();
        read.into_iter().collect::<Option<Vec<_>>>()?.try_into().ok()
    }

    /// Reads points that the vehicle passed, such as tire marks. They are evidence beside the rest pose, not in place of it.
    fn path_points(&self, table: &Table<'_>) -> Option<Vec<PathPoint>> {
        let field = table.optional("points");
        let place = field.clone();
        let tables = field.array_of_tables()?;
        if tables.is_empty() || tables.len() > MOST_POINTS {
            place.report(format!("{} points; expected 1 to {MOST_POINTS}", tables.len()), None);
            return None;
        }
        let read: Vec<Option<PathPoint>> = tables.iter().map(|point| self.path_point(point)).collect();
        if !table.has("position") && !table.has("heading") {
            let help = "give `position` and `heading` at rest too";
            place.report("points along the path do not say where the vehicle came to rest", Some(help.to_owned()));
            return None;
        }
        read.into_iter().collect()
    }

    fn path_point(&self, table: &Table<'_>) -> Option<PathPoint> {
        let position = self.position_at_rest(table.required("position"));
        let wheel = table.has("wheel").then(|| {
            let name = table.optional("wheel").choice(&WHEELS)?;
            WHEELS.into_iter().zip(WheelPosition::ALL).find_map(|(known, wheel)| (known == name).then_some(wheel))
        });
        table.finish();
        let [(x, x_deviation), (y, y_deviation)] = position?;
        let wheel = match wheel {
            Some(wheel) => Some(wheel?),
            None => None,
        };
        Some(PathPoint { wheel, position: Xy { x, y }, deviation: Xy { x: x_deviation, y: y_deviation } })
    }

    fn sliding_vehicle(&self, table: &Table<'_>, inputs: Option<&VehicleInputs>) -> Option<SlidingVehicle> {
        let length = |key| self.length(table.required(key));
        let (front_axle, rear_axle, track) = (length("front_axle"), length("rear_axle"), length("track"));
        let steer = self.steer(table, 0.0);
        let wheels = self.wheels(table, steer.unwrap_or(0.0));
        let rolling_resistance = table.has("rolling_resistance").then(|| self.coefficient(table.optional("rolling_resistance"), 1.0));
        let slip_angle = table.has("slip_angle").then(|| self.slip_angle(table.optional("slip_angle")));
        steer?;
        let mut tires = Tires::ORDINARY;
        if let Some(resistance) = rolling_resistance {
            tires.rolling_resistance = resistance?;
        }
        if let Some(angle) = slip_angle {
            tires.slip_angle = libm::tan(angle?);
        }
        let (front_axle, rear_axle, track) = (front_axle?, rear_axle?, track?);
        self.notices.borrow_mut().extend(unusual::wheelbase(table.path(), front_axle + rear_axle, &inputs?.size));
        let (mass, yaw_inertia) = (inputs?.mass, inputs?.yaw_inertia());
        Some(SlidingVehicle { mass, yaw_inertia, front_axle, rear_axle, track, wheels: wheels?, tires })
    }

    /// Reads the angle of a wheel to the vehicle, which may be that of another place.
    fn steer(&self, table: &Table<'_>, elsewhere: f64) -> Option<f64> {
        if !table.has("steer") {
            return Some(elsewhere);
        }
        let field = table.optional("steer");
        let path = field.path().to_owned();
        let angle = self.quantity(field, Kind::ANGLE)?;
        self.notices.borrow_mut().extend(unusual::steer(&path, angle));
        Some(angle)
    }

    /// Reads the slip angle at which tires slide, below a right angle.
    fn slip_angle(&self, field: Field<'_>) -> Option<f64> {
        let place = field.clone();
        let angle = self.positive(field, Kind::ANGLE)?;
        if angle >= std::f64::consts::FRAC_PI_2 {
            place.report_as("out-of-range", format!("it is {} deg; it must be below 90 deg", trim(angle.to_degrees())), None);
            return None;
        }
        Some(angle)
    }

    /// Reads the wheels, all of which are required, because none can be assumed to roll freely after a collision. The
    /// front wheels take the steering angle.
    fn wheels(&self, table: &Table<'_>, steer: f64) -> Option<Wheels<Wheel>> {
        let wheels = table.required("wheels").table()?;
        let front_left = self.wheel(wheels.required("front_left"), steer);
        let front_right = self.wheel(wheels.required("front_right"), steer);
        let rear_left = self.wheel(wheels.required("rear_left"), 0.0);
        let rear_right = self.wheel(wheels.required("rear_right"), 0.0);
        wheels.finish();
        Some(Wheels { front_left: front_left?, front_right: front_right?, rear_left: rear_left?, rear_right: rear_right? })
    }

    fn wheel(&self, field: Field<'_>, steer: f64) -> Option<Wheel> {
        if let Some(Value::Number(number)) = field.value() {
            let help = format!("did you mean {{ braking = {} }}?", number.text);
            field.report("a number by itself does not say what it is of the wheel", Some(help));
            return None;
        }
        if !matches!(field.value(), Some(Value::Table(_))) {
            let restraint = match field.choice(&["locked", "rolling"])? {
                "locked" => Restraint::Locked,
                _ => Restraint::Rolling,
            };
            return Some(Wheel { restraint, steer });
        }
        let table = field.table()?;
        let restraint = match one_of(&table, "braking", "state") {
            Some("braking") => self.coefficient(table.required("braking"), 1.0).map(Restraint::Braked),
            Some(_) => match table.required("state").choice(&["locked", "rolling"]) {
                Some("locked") => Some(Restraint::Locked),
                Some(_) => Some(Restraint::Rolling),
                None => None,
            },
            None => None,
        };
        let own = self.steer(&table, steer);
        table.finish();
        Some(Wheel { restraint: restraint?, steer: own? })
    }

    /// Reads a value whose standard deviation is required.
    fn uncertain(&self, field: Field<'_>, measure: Measure, example: &str) -> Option<(f64, f64)> {
        let place = field.clone();
        let Estimate { value, deviation } = self.estimate(field, measure)?;
        match deviation {
            Some(deviation) => Some((value, deviation)),
            None => {
                place.report("it has no standard deviation", Some(format!("write how well it is known, as \"{example}\"")));
                None
            }
        }
    }

    /// Reads a value and its standard deviation, if the file gives one.
    fn estimate(&self, field: Field<'_>, measure: Measure) -> Option<Estimate> {
        let Measured { amount, spread } = self.measured(field, measure)?;
        let Amount::Number(value) = amount else { return None };
        Some(Estimate { value, deviation: spread.of(value).standard_deviation() })
    }
}
