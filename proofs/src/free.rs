//! Free variables, and values composed of them: an identity holds for all their values.

use planar_impact::{
    Body, Collision, Contact, CrushPlane, Field, ForwardLeft, Heading, ImpulseRatio, Law, Moment, Motion, Nt, Party, Vehicle, Xy,
};

/// A source of free variables. It determines what is computed: random residues, random fractions, or the sizes of polynomials.
pub struct Free<'a, T> {
    next: &'a mut dyn FnMut() -> T,
}

impl<'a, T: Field> Free<'a, T> {
    /// Creates a source from a function that returns the next variable.
    pub fn new(next: &'a mut dyn FnMut() -> T) -> Self {
        Free { next }
    }

    /// Returns one more variable.
    pub fn variable(&mut self) -> T {
        (self.next)()
    }

    /// Returns a vector in ground axes.
    pub fn xy(&mut self) -> Xy<T> {
        Xy { x: self.variable(), y: self.variable() }
    }

    /// Returns a vector in n-t axes.
    pub fn nt(&mut self) -> Nt<T> {
        Nt { n: self.variable(), t: self.variable() }
    }

    /// Returns a vector in vehicle axes.
    pub fn forward_left(&mut self) -> ForwardLeft<T> {
        ForwardLeft { forward: self.variable(), left: self.variable() }
    }

    /// Returns a direction, from the tangent of half its angle.
    pub fn heading(&mut self) -> Heading<T> {
        Heading::from_half_tangent(self.variable())
    }

    /// Returns a crush plane, from the tangent of half of Γ.
    pub fn crush_plane(&mut self) -> CrushPlane<T> {
        CrushPlane::from_half_tangent(self.variable())
    }

    /// Returns a vehicle with all numbers free.
    pub fn vehicle(&mut self) -> Vehicle<T> {
        Vehicle {
            mass: self.variable(),
            yaw_inertia: self.variable(),
            heading: self.heading(),
            impact_center: self.forward_left(),
            motion: Motion { velocity: self.xy(), yaw_rate: self.variable() },
        }
    }

    /// Returns a body in n-t axes with all numbers free.
    pub fn body(&mut self) -> Body<T> {
        Body {
            inverse_mass: self.variable(),
            inverse_yaw_inertia: self.variable(),
            arm: self.nt(),
            velocity: self.nt(),
            yaw_rate: self.variable(),
        }
    }

    /// Returns two free bodies in contact.
    pub fn contact(&mut self) -> Contact<T> {
        Contact::between(self.body(), self.body())
    }

    /// Returns a collision of two free vehicles, any Γ and any e.
    pub fn collision(&mut self) -> Collision<T> {
        let two = self.vehicle().into();
        self.collision_with(two)
    }

    /// Returns a collision of a free vehicle and a barrier, any Γ and any e.
    pub fn barrier_collision(&mut self) -> Collision<T> {
        self.collision_with(Party::Barrier)
    }

    /// Returns one collision of each kind.
    pub fn collisions(&mut self) -> [Collision<T>; 2] {
        [self.collision(), self.barrier_collision()]
    }

    fn collision_with(&mut self, two: Party<T>) -> Collision<T> {
        Collision {
            one: self.vehicle().into(),
            two,
            crush_plane: self.crush_plane(),
            restitution: self.variable(),
            impulse_ratio: ImpulseRatio::Critical,
            law: Law::Brach,
            moment: Moment::None,
        }
    }
}
