//! Quantities that depend on the crush plane, and quantities that do not.

use planar_impact::{Collision, CrushPlane, Field, Moment};

use super::scene::{Scene, inelastic, kudlich_slibar, with_moment};
use super::{Identity, identity};
use crate::equation::Equations;
use crate::free::Free;

pub(super) fn all() -> Vec<Identity> {
    vec![
        identity!(common_velocity, "at e = 0, μ = μ0 nothing depends on Γ", "V₁, Ω₁, V₂, Ω₂, P_x, P_y and T_L are the same at any two Γ"),
        identity!(common_motion, "nor with the critical moment", "the same with M = M0, and M0 itself"),
        identity!(kudlich_slibar_plane, "nor under Kudlich–Slibar at any e", "the same at any two Γ"),
        identity!(two_normals, "Γ and Γ + 180° are the same plane", "the same motions, works and energies; P_n, P_t change sign"),
        identity!(quarter, "Γ + 90° exchanges the works at e = 0, μ = μ0", "W_n(Γ + 90°) = W_t(Γ),  W_t(Γ + 90°) = W_n(Γ)"),
    ]
}

/// Requires the quantities that are equal in two scenes with different crush planes.
fn same_on_ground<T: Field>(must: &mut Equations<T>, here: Scene<T>, there: Scene<T>) {
    must.equal(here.impact.loss(), there.impact.loss());
    must.equal(here.impact.kinetic_energy, there.impact.kinetic_energy);
    must.equal(here.impact.impulse_on_ground, there.impact.impulse_on_ground);
    must.equal(here.impact.moment, there.impact.moment);
    must.equal(here.impact.one, there.impact.one);
    must.equal(here.impact.two, there.impact.two);
}

fn common_velocity<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let mut must = Equations::new();
    for collision in free.collisions().map(inelastic) {
        let turned = Collision { crush_plane: free.crush_plane(), ..collision.clone() };
        same_on_ground(&mut must, Scene::sticking(collision), Scene::sticking(turned));
    }
    must
}

fn common_motion<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let mut must = Equations::new();
    for collision in free.collisions().map(inelastic) {
        let collision = with_moment(collision, Moment::OfCritical(T::int(1)));
        let turned = Collision { crush_plane: free.crush_plane(), ..collision.clone() };
        same_on_ground(&mut must, Scene::sticking(collision), Scene::sticking(turned));
    }
    must
}

fn kudlich_slibar_plane<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let mut must = Equations::new();
    for collision in free.collisions().map(kudlich_slibar) {
        let turned = Collision { crush_plane: free.crush_plane(), ..collision.clone() };
        same_on_ground(&mut must, Scene::sticking(collision), Scene::sticking(turned));
    }
    must
}

fn two_normals<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let mut must = Equations::new();
    for collision in free.collisions() {
        let ratio = free.variable();
        let CrushPlane { cos, sin } = collision.crush_plane.clone();
        let turned = Collision { crush_plane: CrushPlane { cos: -cos, sin: -sin }, ..collision.clone() };
        for (here, there) in [
            (Scene::sticking(collision.clone()), Scene::sticking(turned.clone())),
            (Scene::at_ratio(collision, ratio.clone()), Scene::at_ratio(turned, ratio)),
        ] {
            must.equal(here.impact.work.clone(), there.impact.work.clone());
            must.equal(here.impact.impulse.clone(), -there.impact.impulse.clone());
            same_on_ground(&mut must, here, there);
        }
    }
    must
}

fn quarter<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let mut must = Equations::new();
    for collision in free.collisions().map(inelastic) {
        let CrushPlane { cos, sin } = collision.crush_plane.clone();
        let turned = Collision { crush_plane: CrushPlane { cos: -sin, sin: cos }, ..collision.clone() };
        let (here, there) = (Scene::sticking(collision).impact.work, Scene::sticking(turned).impact.work);
        must.equal(here.n, there.t);
        must.equal(here.t, there.n);
    }
    must
}
