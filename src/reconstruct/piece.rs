//! The smooth pieces of which the mechanics of a collision with friction consists.
//!
//! Where friction begins to hold, and where sliding changes its side, no slope leads on: a search that follows the edge between two pieces needs the edge as a
//! margin, and each piece continued beyond it.

use super::placed::Placed;
use crate::collision::Collision;
use crate::contact::Contact;
use crate::impact::Impact;
use crate::law::{FrictionCone, ImpulseRatio};
use crate::scalar::Real;

/// A piece, by what friction does throughout it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Piece {
    /// The whole of the mechanics: smooth where friction does not limit the impulse.
    Whole,
    /// It ends the sliding.
    Sticks,
    /// The vehicles slide throughout, at a ratio of this sign: 1 or −1.
    Slides(i8),
    /// They do so at an unknown ratio, of this sign.
    OfRatio(i8),
}

impl Piece {
    /// Returns the piece that a collision lies in.
    pub(super) fn of(placed: &Placed<f64>) -> Self {
        let collision = &placed.collision;
        let sign = |x: f64| if x < 0.0 { -1 } else { 1 };
        match collision.impulse_ratio {
            _ if placed.impulse.is_some() => Piece::Whole,
            ImpulseRatio::LimitedByFriction(friction) => {
                let contact = collision.contact();
                let change = collision.sticking_change(&contact, collision.moment_impulse(&contact).as_ref());
                let cone = FrictionCone::around(&contact.compliance.impulse_for(change), &change, &friction);
                if cone.slides { Piece::Slides(sign(cone.side)) } else { Piece::Sticks }
            }
            // A ratio of zero has the sign of those that are possible beside it.
            ImpulseRatio::Given(0.0) if placed.ratio_is_unknown => {
                let contact = collision.contact();
                Piece::OfRatio(sign(collision.sticking_impulse(&contact).t * contact.approach.n))
            }
            ImpulseRatio::Given(ratio) if placed.ratio_is_unknown => Piece::OfRatio(sign(ratio)),
            _ => Piece::Whole,
        }
    }

    /// Returns every piece of the same mechanics.
    pub(super) fn all(self) -> &'static [Piece] {
        match self {
            Piece::Whole => &[Piece::Whole],
            Piece::Sticks | Piece::Slides(_) => &[Piece::Sticks, Piece::Slides(1), Piece::Slides(-1)],
            Piece::OfRatio(_) => &[Piece::OfRatio(1), Piece::OfRatio(-1)],
        }
    }

    /// Returns the impact by the law of this piece, also where friction does something else.
    pub(super) fn impact_of<T: Real + Copy + From<f64>>(self, placed: &Placed<T>, contact: &Contact<T>) -> Impact<T> {
        let ratio = match (self, placed.collision.impulse_ratio) {
            (Piece::Sticks, ImpulseRatio::LimitedByFriction(_)) => ImpulseRatio::Critical,
            (Piece::Slides(side), ImpulseRatio::LimitedByFriction(friction)) => ImpulseRatio::Given(T::int(side.into()) * friction),
            _ => return placed.impact_at(contact),
        };
        Collision { impulse_ratio: ratio, ..placed.collision }.impact_at(contact)
    }

    /// Returns functions that are negative beyond the edges of this piece, in units of an impulse that has the sign of compression; [`Piece::beyond`] has what lies
    /// there. Those of an unknown ratio are limits of the physics.
    pub(super) fn margins<T: Real + From<f64>>(self, collision: &Collision<T>, contact: &Contact<T>, unit: f64) -> Vec<T> {
        let ImpulseRatio::LimitedByFriction(friction) = &collision.impulse_ratio else { return Vec::new() };
        let sticking = collision.sticking_impulse(contact) * T::from(unit.recip());
        let most = friction.clone() * sticking.n;
        match self {
            Piece::Whole | Piece::OfRatio(_) => Vec::new(),
            Piece::Sticks => vec![most.clone() - sticking.t.clone(), most + sticking.t],
            Piece::Slides(side) => vec![T::int(side.into()) * sticking.t - most],
        }
    }

    /// Returns the piece beyond each edge, in the order of the margins.
    pub(super) fn beyond(self) -> &'static [Piece] {
        match self {
            Piece::Whole => &[],
            Piece::Sticks => &[Piece::Slides(1), Piece::Slides(-1)],
            Piece::Slides(_) => &[Piece::Sticks],
            Piece::OfRatio(1) => &[Piece::OfRatio(-1)],
            Piece::OfRatio(_) => &[Piece::OfRatio(1)],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{CrushPlane, Heading, Law, Moment, Vehicle};

    /// A collision, or its image in the x axis for a mirror of −1.
    fn collision(mirror: f64, angle: f64, friction: f64, law: Law, moment: Moment<f64>) -> Collision {
        let one = Vehicle::new(1500.0, 2400.0).with_impact_center(1.9, 0.5 * mirror).with_speed(14.0);
        let heading = Heading::from_angle(angle * mirror);
        let two = Vehicle::new(1100.0, 1700.0).with_impact_center(-0.3, 0.8 * mirror).with_heading(heading).with_speed(3.0);
        let ratio = ImpulseRatio::LimitedByFriction(friction);
        Collision { law, moment, ..Collision::new(one, two).with_restitution(0.2).with_impulse_ratio(ratio) }
    }

    /// One piece has a collision within its edges, and there its law is that of friction. Beyond an edge of another one lies the piece that is said to lie there.
    #[test]
    fn a_collision_lies_within_the_edges_of_its_piece() {
        let mut seen = [0; 3];
        for (k, angle) in [0.4, 1.5, 2.5, -0.4, -1.6].into_iter().cycle().take(240).enumerate() {
            let friction = 0.02 * f64::from(u8::try_from(k % 48).expect("small"));
            let law = [Law::Brach, Law::KudlichSlibar][k % 2];
            let moment = [Moment::None, Moment::Given(300.0), Moment::OfCritical(0.5)][k % 3];
            let mirror = [1.0, -1.0][k / 6 % 2];
            let plane = CrushPlane::from_angle([0.0, 3.0 * mirror][k % 2]);
            let collision = collision(mirror, angle, friction, law, moment).with_crush_plane(plane);
            let Ok(impact) = collision.solve() else { continue };
            let placed = Placed { collision, crush_share: 0.5, impulse: None, skids: [None; 2], ratio_is_unknown: false };
            let (own, contact) = (Piece::of(&placed), collision.contact());
            assert_eq!(own.impact_of(&placed, &contact).impulse, impact.impulse, "{k}");
            assert_eq!(Piece::Whole.impact_of(&placed, &contact).impulse, impact.impulse, "{k}");
            let unit = 1e3_f64.copysign(impact.impulse.n);
            for (place, piece) in own.all().iter().enumerate() {
                let margins = piece.margins(&collision, &contact, unit);
                assert_eq!(margins.len(), piece.beyond().len());
                if *piece == own {
                    assert!(margins.iter().all(|margin| *margin >= 0.0), "{k}: {margins:?}");
                    seen[place] += 1;
                } else {
                    let beyond: Vec<Piece> =
                        margins.iter().zip(piece.beyond()).filter(|(margin, _)| **margin < 0.0).map(|(_, beyond)| *beyond).collect();
                    let way = if *piece == Piece::Sticks { own } else { Piece::Sticks };
                    assert_eq!(beyond, [way], "{k}: {own:?}");
                }
            }
        }
        assert!(seen.iter().all(|count| *count > 10), "{seen:?}");
    }

    #[test]
    fn without_friction_there_is_one_piece() {
        let limited = collision(1.0, 2.5, 0.4, Law::Brach, Moment::None);
        let placed = |collision, impulse| Placed { collision, crush_share: 0.5, impulse, skids: [None; 2], ratio_is_unknown: false };
        let critical = placed(limited.with_impulse_ratio(ImpulseRatio::Critical), None);
        for placed in [critical, placed(limited, Some(crate::frame::Xy { x: -9e3, y: 0.0 }))] {
            assert_eq!((Piece::of(&placed), Piece::of(&placed).all()), (Piece::Whole, &[Piece::Whole][..]));
            assert!(Piece::Whole.margins(&limited, &limited.contact(), 1e3).is_empty() && Piece::Whole.beyond().is_empty());
        }
    }
}
