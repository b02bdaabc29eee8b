//! Laws of crush: force per width at a depth, F/w, and absorbed energy per width, E/w. The second is the integral of the first from depth 0, plus the energy
//! that leaves no crush.

use super::{CrushStiffness, Profile, Segment};
use crate::scalar::Field;

/// Force and absorbed energy of a structure as it is crushed.
pub trait CrushLaw<T: Field> {
    /// Returns the force per width at a depth of residual crush, in N/m: the derivative of the energy.
    fn force(&self, depth: T) -> T;

    /// Returns the energy per width at a depth of residual crush, in J/m, including the energy that leaves no crush.
    fn energy(&self, depth: T) -> T;

    /// Returns the energy of a width over which the depth changes linearly, in J: by a formula if there is one, otherwise by
    /// [`energy_by_quadrature`](super::energy_by_quadrature).
    fn energy_of_segment(&self, segment: &Segment<T>) -> T;

    /// Returns the energy of a profile, in J.
    fn energy_of(&self, profile: &Profile<T>) -> T {
        profile.segments().fold(T::int(0), |sum, segment| sum + self.energy_of_segment(&segment))
    }
}

impl<T: Field> CrushLaw<T> for CrushStiffness<T> {
    fn force(&self, depth: T) -> T {
        self.slope.clone() * self.crush_intensity(depth)
    }

    fn energy(&self, depth: T) -> T {
        self.crush_intensity(depth).squared().half()
    }

    fn energy_of_segment(&self, segment: &Segment<T>) -> T {
        self.crush_energy(segment.moments())
    }

    fn energy_of(&self, profile: &Profile<T>) -> T {
        self.crush_energy(profile.moments())
    }
}
