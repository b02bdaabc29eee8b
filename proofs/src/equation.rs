//! The equations of an identity at one point.

use planar_impact::{ForwardLeft, KineticEnergy, Motion, Nt, Response, Work, Xy};

/// Two sides that must be equal.
#[derive(Clone, Debug)]
pub struct Equation<T> {
    /// The left side.
    pub left: T,
    /// The right side.
    pub right: T,
}

/// All the equations of an identity.
#[derive(Clone, Debug)]
pub struct Equations<T>(Vec<Equation<T>>);

impl<T> Equations<T> {
    /// Creates an empty list.
    pub fn new() -> Self {
        Equations(Vec::new())
    }

    /// Requires two numbers to be equal, or two vectors, motions or works in each component.
    pub fn equal<P: Parts<T>>(&mut self, left: P, right: P) {
        self.0.extend(left.parts().into_iter().zip(right.parts()).map(|(left, right)| Equation { left, right }));
    }

    /// Returns the number of equations.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Returns an iterator over the equations.
    pub fn iter(&self) -> impl Iterator<Item = &Equation<T>> {
        self.0.iter()
    }
}

impl<T> IntoIterator for Equations<T> {
    type Item = Equation<T>;
    type IntoIter = std::vec::IntoIter<Equation<T>>;
    fn into_iter(self) -> Self::IntoIter {
        self.0.into_iter()
    }
}

/// A value composed of a fixed number of numbers.
pub trait Parts<T> {
    /// Returns its numbers, in a fixed order.
    fn parts(self) -> Vec<T>;
}

impl<T> Parts<T> for T {
    fn parts(self) -> Vec<T> {
        vec![self]
    }
}

impl<T> Parts<T> for Xy<T> {
    fn parts(self) -> Vec<T> {
        vec![self.x, self.y]
    }
}

impl<T> Parts<T> for Nt<T> {
    fn parts(self) -> Vec<T> {
        vec![self.n, self.t]
    }
}

impl<T> Parts<T> for ForwardLeft<T> {
    fn parts(self) -> Vec<T> {
        vec![self.forward, self.left]
    }
}

impl<T> Parts<T> for Motion<T> {
    fn parts(self) -> Vec<T> {
        vec![self.velocity.x, self.velocity.y, self.yaw_rate]
    }
}

impl<T> Parts<T> for Work<T> {
    fn parts(self) -> Vec<T> {
        vec![self.n, self.t, self.m]
    }
}

impl<T> Parts<T> for KineticEnergy<T> {
    fn parts(self) -> Vec<T> {
        vec![self.before, self.after]
    }
}

impl<T> Parts<T> for Response<T> {
    fn parts(self) -> Vec<T> {
        [self.after.parts(), self.delta_v.parts(), self.delta_v_in_vehicle.parts()].into_iter().flatten().collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_vector_is_as_many_equations_as_it_has_components() {
        let mut must = Equations::new();
        must.equal(1.0, 2.0);
        must.equal(Nt { n: 3.0, t: 4.0 }, Nt { n: 5.0, t: 6.0 });
        must.equal(Motion::rest(), Motion { velocity: Xy { x: 7.0, y: 8.0 }, yaw_rate: 9.0 });
        let sides: Vec<_> = must.iter().map(|equation| (equation.left, equation.right)).collect();
        assert_eq!(sides, [(1.0, 2.0), (3.0, 5.0), (4.0, 6.0), (0.0, 7.0), (0.0, 8.0), (0.0, 9.0)]);
    }
}
