//! Free variables, and what is made of them: everything that an identity holds for all of.

use planar_impact::{
    Body, Collision, Contact, CrushPlane, Field, ForwardLeft, Heading, ImpulseRatio, Law, Moment, Motion, Nt, Party, Vehicle, Xy,
};

/// A source of free variables. Where they come from decides what is computed: random residues, random fractions, or the sizes of polynomials.
pub struct Free<'a, T> {
    next: &'a mut dyn FnMut() -> T,
}

impl<'a, T: Field> Free<'a, T> {
    /// Of whatever answers with the next variable.
    pub fn new(next: &'a mut dyn FnMut() -> T) -> Self {
        Free { next }
    }

    /// One more variable.
    pub fn variable(&mut self) -> T {
        (self.next)()
    }

    /// A vector on the ground.
    pub fn xy(&mut self) -> Xy<T> {
        Xy { x: self.variable(), y: self.variable() }
    }

    /// A vector in the axes of the contact.
    pub fn nt(&mut self) -> Nt<T> {
        Nt { n: self.variable(), t: self.variable() }
    }

    /// A vector in the axes of a vehicle.
    pub fn forward_left(&mut self) -> ForwardLeft<T> {
        ForwardLeft { forward: self.variable(), left: self.variable() }
    }

    /// A direction, by the tangent of half its angle.
    pub fn heading(&mut self) -> Heading<T> {
        Heading::from_half_tangent(self.variable())
    }

    /// A crush plane, by the tangent of half of Γ.
    pub fn crush_plane(&mut self) -> CrushPlane<T> {
        CrushPlane::from_half_tangent(self.variable())
    }

    /// A vehicle of which everything is free.
    pub fn vehicle(&mut self) -> Vehicle<T> {
        Vehicle {
            mass: self.variable(),
            yaw_inertia: self.variable(),
            heading: self.heading(),
            impact_center: self.forward_left(),
            motion: Motion { velocity: self.xy(), yaw_rate: self.variable() },
        }
    }

    /// A body in the axes of the contact of which everything is free.
    pub fn body(&mut self) -> Body<T> {
        Body {
            inverse_mass: self.variable(),
            inverse_yaw_inertia: self.variable(),
            arm: self.nt(),
            velocity: self.nt(),
            yaw_rate: self.variable(),
        }
    }

    /// Two free bodies in contact.
    pub fn contact(&mut self) -> Contact<T> {
        Contact::between(self.body(), self.body())
    }

    /// Two free vehicles, any Γ and any e.
    pub fn collision(&mut self) -> Collision<T> {
        let two = self.vehicle().into();
        self.collision_with(two)
    }

    /// A free vehicle and a barrier, any Γ and any e.
    pub fn barrier_collision(&mut self) -> Collision<T> {
        self.collision_with(Party::Barrier)
    }

    /// One collision of each kind.
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
