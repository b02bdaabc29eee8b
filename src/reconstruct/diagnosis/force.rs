//! Forces implied by the crush of the two vehicles.

use super::{Damage, Figure, Finding, Limit, Meaning, Question};
use crate::crash3::force_factor;
use crate::crush::{MOST_FORCE_IMBALANCE, force_imbalance};
use crate::frame::Xy;
use crate::impact::ForceDirection;
use crate::reconstruct::Solution;
use crate::scalar::Real;
use crate::vehicle::Party;

/// Message for missing input of the comparisons of two vehicles.
const NEEDS_BOTH: &str = "not checked: it needs the crush of two vehicles, with their stiffness";

/// Checks Newton's third law: the forces at the end of both crushes are the same.
pub(super) fn balance(solution: &Solution, damage: &[Option<Damage>; 2]) -> Finding {
    let limit = Limit::AtMost(Figure::Share(MOST_FORCE_IMBALANCE));
    let source = "EDCRASH's run-time diagnostics: 100 %, here of the smaller force";
    let forces = damage.map(|damage| damage.and_then(|damage| Some((damage, damage.force?))));
    let [Some(one), Some(two)] = forces else { return Finding::not_checked(Question::ForceBalance, limit, source, NEEDS_BOTH) };
    let principal = [(one, &solution.collision.one), (two, &solution.collision.two)].map(|((damage, normal), party)| {
        // The force along the surface adds to the force normal to it.
        normal * slant(solution, party, &damage)
    });
    let stiffer = if principal[0] > principal[1] { 1 } else { 2 };
    let meaning = Meaning::of("the crush of vehicle 1 implies ")
        .figure(Figure::Force(principal[0]))
        .words(", that of vehicle 2 implies ")
        .figure(Figure::Force(principal[1]))
        .words(format!(
            "; the forces are one and the same, so where they differ much, stiffness or depths are wrong: those of vehicle {stiffer} are too large or those of the other \
             too small"
        ));
    Finding::new(Question::ForceBalance, Figure::Share(force_imbalance(principal)), limit, source, meaning)
}

/// Returns 1/cos α of the force on a vehicle, α from the normal of the crushed surface, for which the crush plane is used because the forces of both are
/// compared on it.
fn slant(solution: &Solution, party: &Party, damage: &Damage) -> f64 {
    let along = |force: Xy| {
        let contact = solution.collision.crush_plane.to_contact(force);
        force_factor(contact.n.abs(), contact.length())
    };
    let read_off = damage.force_direction.and_then(|origin| push(party, origin));
    let slant = along(read_off.unwrap_or(solution.impact.impulse_on_ground));
    if slant.is_finite() { slant } else { 1.0 }
}

/// Returns the direction of the push on the ground of a force from a given direction.
fn push(party: &Party, origin: ForceDirection) -> Option<Xy> {
    Some(party.vehicle()?.heading.to_ground(origin.push()))
}

/// Checks that the measured directions of force on the two vehicles are opposite.
pub(super) fn opposite(solution: &Solution, damage: &[Option<Damage>; 2]) -> Finding {
    // Two directions, each with a standard deviation of 12.6°, and two standard deviations of their difference.
    let limit = Limit::AtMost(Figure::Angle((2.0 * 12.6 * 2.0_f64.sqrt()).to_radians()));
    let source = "Johnson and Gabler, side crashes: PDOFs read off vehicles are 12.6 deg off (one standard deviation); two standard deviations of two of them";
    let read_off = |i: usize, party| damage[i].and_then(|damage| push(party, damage.force_direction?));
    match (read_off(0, &solution.collision.one), read_off(1, &solution.collision.two)) {
        (Some(one), Some(two)) => {
            let angle = Real::arctangent(one.cross(two), -one.dot(two)).abs();
            let meaning = "the force on one vehicle is opposite to that on the other on the ground; where the PDOFs read off them are not, one of them or a \
                           heading is wrong";
            Finding::new(Question::OppositeForces, Figure::Angle(angle), limit, source, Meaning::of(meaning))
        }
        (one, two) => match one.or(two.map(|force| -force)) {
            Some(force) => {
                let impulse = solution.impact.impulse_on_ground;
                let angle = Real::arctangent(force.cross(impulse), force.dot(impulse)).abs();
                let meaning = "only one PDOF was read off; this is how far it is from the direction of the reconstructed impulse";
                Finding::new(Question::OppositeForces, Figure::Angle(angle), limit, source, Meaning::of(meaning))
            }
            None => Finding::not_checked(
                Question::OppositeForces,
                limit,
                source,
                "not checked: no PDOF was read off the vehicles; those of the reconstruction are opposite by construction",
            ),
        },
    }
}

/// Checks that the crush energies are shared in accordance with the stiffness: E = F²/(2 B w) for a linear structure at the same force.
pub(super) fn share(solution: &Solution, damage: &[Option<Damage>; 2]) -> Finding {
    let limit = Limit::Between(Figure::Number(0.25), Figure::Number(4.0));
    let source = "E = F^2/(2 B w) with forces 100 % apart, EDCRASH's limit of their balance";
    let stiffness = damage.map(|damage| damage.and_then(|damage| Some((damage.crush_energy, damage.stiffness?))));
    let [Some((energy_1, b_1)), Some((energy_2, b_2))] = stiffness else {
        return Finding::not_checked(Question::CrushShare, limit, source, NEEDS_BOTH);
    };
    let expected = b_2 / (b_1 + b_2);
    let measured = energy_1 / (energy_1 + energy_2);
    let odds = (energy_1 * b_1) / (energy_2 * b_2);
    let used = solution.crush_share;
    let by_share = solution.estimate(crate::reconstruct::Variable::CrushShare);
    let meaning = Meaning::of("vehicle 1 has ")
        .figure(Figure::Share(measured))
        .words(" of the crush energy, by the stiffness of both it should have ")
        .figure(Figure::Share(expected));
    let meaning = match by_share {
        Some(_) => meaning.words("; the reconstruction has ").figure(Figure::Share(used)),
        None => meaning,
    };
    let meaning = meaning.words("; the softer vehicle takes more. The figure is the ratio of the two energies over that by stiffness");
    Finding::new(Question::CrushShare, Figure::Number(odds), limit, source, meaning)
}
