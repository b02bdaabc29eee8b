//! The collisions of the tables, in feet, slugs and seconds: the library accepts any coherent units.

use crate::data::DataError;
use crate::sheet::Sheet;
use planar_impact::crush::CrushStiffness;
use planar_impact::{
    Collision, CrushPlane, ForwardLeft, Heading, Impact, ImpulseRatio, Law, Moment, Motion, Party, Real as _, Vehicle, Xy,
};
use std::collections::HashMap;

const FILE: &str = "geometry.csv";

/// Position of the impact on vehicle 2 (Fig 3).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Position {
    A,
    B,
    C,
}

impl Position {
    pub(crate) const ALL: [Position; 3] = [Position::A, Position::B, Position::C];

    pub(crate) fn letter(self) -> &'static str {
        match self {
            Position::A => "A",
            Position::B => "B",
            Position::C => "C",
        }
    }

    pub(crate) fn of_letter(letter: &str) -> Option<Self> {
        Position::ALL.into_iter().find(|position| position.letter() == letter)
    }
}

/// Two vehicles at right angles, vehicle 1 heading in −x and vehicle 2 in +y.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Perpendicular {
    pub(crate) position: Position,
    /// Velocity of vehicle 1 along x.
    pub(crate) v_1x: f64,
    /// Velocity of vehicle 2 along y.
    pub(crate) v_2y: f64,
    pub(crate) gamma_degrees: f64,
    pub(crate) restitution: f64,
}

/// The barrier of the crabbed car in Table B1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Wall {
    /// A fixed barrier.
    Fixed,
    /// The very heavy body at rest that the paper uses.
    Papers,
}

/// Masses, inertias and arms of the paper's two examples.
#[derive(Clone, Debug)]
pub(crate) struct Geometry {
    gravity: f64,
    weights: [f64; 2],
    yaw_inertias: [f64; 2],
    /// Vectors from each center of mass to the impact center, in ground axes, for positions A, B, C.
    arms: [[Xy; 2]; 3],
    pub(crate) barrier_mass: f64,
    crab_angle: f64,
    barrier_arm: f64,
    barrier_yaw_inertia: f64,
    pub(crate) papers_barrier_mass: f64,
    /// Width of the residual crush in ft.
    pub(crate) crush_width: f64,
    /// The line E* = d₀ + d₁ C in √lbf and √lbf/ft.
    pub(crate) crush: CrushStiffness,
}

impl Geometry {
    pub(crate) fn read(text: &str) -> Result<Self, DataError> {
        let sheet = Sheet::read(FILE, text)?;
        let mut entries = HashMap::new();
        for row in sheet.rows() {
            let entry = row.text("entry")?.to_owned();
            if entries.insert(entry.clone(), row.number("value")?.value()).is_some() {
                return Err(DataError::NotOnce { file: FILE, entry });
            }
        }
        let mut take = |entry: &str| entries.remove(entry).ok_or_else(|| DataError::NotOnce { file: FILE, entry: entry.to_owned() });
        let mut arms = [[Xy::zero(); 2]; 3];
        for (arms, position) in arms.iter_mut().zip(Position::ALL) {
            for (arm, vehicle) in arms.iter_mut().zip(["one", "two"]) {
                let mut component = |axis: &str| take(&format!("{}.{vehicle}.{axis}", position.letter()));
                *arm = Xy { x: component("x")?, y: component("y")? };
            }
        }
        let geometry = Geometry {
            gravity: take("gravity")?,
            weights: [take("one.weight")?, take("two.weight")?],
            yaw_inertias: [take("one.yaw_inertia")?, take("two.yaw_inertia")?],
            arms,
            barrier_mass: take("barrier.mass")?,
            crab_angle: take("barrier.crab_angle")?,
            barrier_arm: take("barrier.arm")?,
            barrier_yaw_inertia: take("barrier.yaw_inertia")?,
            papers_barrier_mass: take("barrier.papers_mass")?,
            crush_width: take("crush.width")?,
            crush: CrushStiffness { onset: take("crush.onset")?, slope: take("crush.slope")? },
        };
        match entries.into_keys().min() {
            Some(field) => Err(DataError::UnknownWord { file: FILE, column: "entry", field }),
            None => Ok(geometry),
        }
    }

    /// Returns the collision of the example, at the critical ratio.
    pub(crate) fn perpendicular(&self, case: Perpendicular) -> Collision {
        let headings = [Heading { cos: -1.0, sin: 0.0 }, Heading { cos: 0.0, sin: 1.0 }];
        let velocities = [Xy { x: case.v_1x, y: 0.0 }, Xy { x: 0.0, y: case.v_2y }];
        let arms = self.arms[case.position as usize];
        let [one, two] = [0, 1].map(|which| {
            Party::Vehicle(Vehicle {
                mass: self.weights[which] / self.gravity,
                yaw_inertia: self.yaw_inertias[which],
                heading: headings[which],
                impact_center: headings[which].to_vehicle(arms[which]),
                motion: Motion { velocity: velocities[which], yaw_rate: 0.0 },
            })
        });
        collision(one, two, CrushPlane::from_angle(case.gamma_degrees.to_radians()), case.restitution)
    }

    /// Returns the same example with other weights, in lbf.
    #[cfg(test)]
    pub(crate) fn with_weights(&self, weights: [f64; 2]) -> Self {
        Geometry { weights, ..self.clone() }
    }

    pub(crate) fn weights(&self) -> [f64; 2] {
        self.weights
    }

    /// Returns forward and lateral components of a crabbed car's velocity.
    pub(crate) fn crabbed_velocity(&self, speed: f64) -> Xy {
        let (sin, cos) = self.crab_angle.to_radians().sin_and_cos();
        Xy { x: speed * cos, y: speed * sin }
    }

    /// Returns the collision of the crabbed car: its front is parallel to the wall, its velocity is not along its heading.
    pub(crate) fn crabbed(&self, speed: f64, restitution: f64, wall: Wall) -> Collision {
        let ahead = Heading { cos: 1.0, sin: 0.0 };
        let one = Vehicle {
            mass: self.barrier_mass,
            yaw_inertia: self.barrier_yaw_inertia,
            heading: ahead,
            impact_center: ForwardLeft { forward: self.barrier_arm, left: 0.0 },
            motion: Motion { velocity: self.crabbed_velocity(speed), yaw_rate: 0.0 },
        };
        let two = match wall {
            Wall::Fixed => Party::Barrier,
            // Struck at its center of mass, so that its inertia does not matter.
            Wall::Papers => Party::Vehicle(Vehicle {
                mass: self.papers_barrier_mass,
                yaw_inertia: self.papers_barrier_mass,
                heading: ahead,
                impact_center: ForwardLeft::zero(),
                motion: Motion::rest(),
            }),
        };
        collision(one.into(), two, CrushPlane { cos: 1.0, sin: 0.0 }, restitution)
    }
}

fn collision(one: Party, two: Party, crush_plane: CrushPlane, restitution: f64) -> Collision {
    Collision { one, two, crush_plane, restitution, impulse_ratio: ImpulseRatio::Critical, law: Law::Brach, moment: Moment::None }
}

/// Solves the impact, or returns an error that names the collision.
pub(crate) fn solve(collision: &Collision, name: &str) -> Result<Impact, DataError> {
    collision.solve().map_err(|reasons| DataError::Refused { collision: name.to_owned(), reasons: reasons.to_string() })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::Texts;

    #[test]
    fn the_arms_are_those_of_the_data_in_ground_axes() {
        let geometry = Geometry::read(Texts::embedded().geometry).expect("embedded");
        let case = Perpendicular { position: Position::A, v_1x: -40.0, v_2y: 40.0, gamma_degrees: 0.0, restitution: 0.0 };
        let contact = geometry.perpendicular(case).contact();
        // geometry.csv, A.one and A.two; at Γ = 0 n is x and t is y.
        assert_eq!((contact.one.arm.n, contact.one.arm.t), (-6.34990, 0.0));
        assert_eq!((contact.two.arm.n, contact.two.arm.t), (3.23560, 7.96804));
        // Both at 40 along their headings: the approach velocity is v_2 − v_1.
        assert_eq!((contact.approach.n, contact.approach.t), (40.0, 40.0));
    }

    #[test]
    fn an_entry_that_is_missing_twice_there_or_unknown_is_refused() {
        let whole = Texts::embedded().geometry;
        let without = whole.replace("barrier.arm,", "barrier.leg,");
        assert_eq!(Geometry::read(&without).err(), Some(DataError::NotOnce { file: FILE, entry: "barrier.arm".into() }));
        let twice = format!("{whole}gravity,32.2,ft/s2,again\n");
        assert_eq!(Geometry::read(&twice).err(), Some(DataError::NotOnce { file: FILE, entry: "gravity".into() }));
        let more = format!("{whole}moon,1,ft,nowhere\n");
        assert!(matches!(Geometry::read(&more).err(), Some(DataError::UnknownWord { field, .. }) if field == "moon"));
    }

    #[test]
    fn the_library_refuses_a_vehicle_without_mass() {
        let text = Texts::embedded().geometry.replace("barrier.mass,101.91", "barrier.mass,0");
        let geometry = Geometry::read(&text).expect("numbers");
        let refused = solve(&geometry.crabbed(19.23, 0.0, Wall::Fixed), "Table B1, 1 0.00");
        assert!(matches!(refused, Err(DataError::Refused { collision, .. }) if collision == "Table B1, 1 0.00"));
    }
}
