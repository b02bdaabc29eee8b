//! The smooth pieces of which the mechanics of a collision with friction consists.
//!
//! Where friction begins to hold, and where sliding changes its side, no slope leads on: a search that follows the edge between two pieces needs the edge as a
//! margin, and each piece continued beyond it.

use super::placed::Placed;
use crate::collision::Collision;
use crate::contact::Contact;
use crate::law::{FrictionCone, ImpulseRatio};
use crate::scalar::Real;

/// What friction does throughout one piece.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Friction {
    /// It ends the sliding.
    Holds,
    /// The vehicles slide throughout, at a ratio of this sign: 1 or −1.
    Slides(i8),
}

impl Friction {
    /// Everything that friction may do where it limits the impulse.
    pub(super) const ALL: [Option<Self>; 3] = [Some(Friction::Holds), Some(Friction::Slides(1)), Some(Friction::Slides(-1))];

    /// Returns what it does in a collision, or `None` if friction does not limit the impulse there.
    pub(super) fn of(placed: &Placed<f64>) -> Option<Self> {
        let collision = &placed.collision;
        let ImpulseRatio::LimitedByFriction(friction) = collision.impulse_ratio else { return None };
        if placed.impulse.is_some() {
            return None;
        }
        let contact = collision.contact();
        let change = collision.sticking_change(&contact, collision.moment_impulse(&contact).as_ref());
        let cone = FrictionCone::around(&contact.compliance.impulse_for(change), &change, &friction);
        Some(if cone.slides { Friction::Slides(if cone.side < 0.0 { -1 } else { 1 }) } else { Friction::Holds })
    }

    /// Returns a collision with the law of this piece, also where friction does something else.
    pub(super) fn throughout<T: Real>(self, collision: Collision<T>) -> Collision<T> {
        let ImpulseRatio::LimitedByFriction(friction) = collision.impulse_ratio else { return collision };
        let impulse_ratio = match self {
            Friction::Holds => ImpulseRatio::Critical,
            Friction::Slides(side) => ImpulseRatio::Given(T::int(side.into()) * friction),
        };
        Collision { impulse_ratio, ..collision }
    }

    /// Returns functions that are negative beyond the edges of this piece, in units of an impulse that has the sign of compression; [`Friction::beyond`] has what lies
    /// there.
    pub(super) fn margins<T: Real + From<f64>>(self, collision: &Collision<T>, contact: &Contact<T>, unit: f64) -> Vec<T> {
        let ImpulseRatio::LimitedByFriction(friction) = &collision.impulse_ratio else { return Vec::new() };
        let sticking = collision.sticking_impulse(contact) * T::from(unit.recip());
        let most = friction.clone() * sticking.n;
        match self {
            Friction::Holds => vec![most.clone() - sticking.t.clone(), most + sticking.t],
            Friction::Slides(side) => vec![T::int(side.into()) * sticking.t - most],
        }
    }

    /// Returns what friction does beyond each edge, in the order of the margins.
    pub(super) fn beyond(self) -> &'static [Friction] {
        match self {
            Friction::Holds => &[Friction::Slides(1), Friction::Slides(-1)],
            Friction::Slides(_) => &[Friction::Holds],
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

    /// One piece has a collision within its edges, and there its law is that of friction. Beyond an edge of another one lies what is said to lie there.
    #[test]
    fn a_collision_lies_within_the_edges_of_what_friction_does_in_it() {
        let mut seen = [0; 3];
        for (k, angle) in [0.4, 1.5, 2.5, -0.4, -1.6].into_iter().cycle().take(240).enumerate() {
            let friction = 0.02 * f64::from(u8::try_from(k % 48).expect("small"));
            let law = [Law::Brach, Law::KudlichSlibar][k % 2];
            let moment = [Moment::None, Moment::Given(300.0), Moment::OfCritical(0.5)][k % 3];
            let mirror = [1.0, -1.0][k / 6 % 2];
            let plane = CrushPlane::from_angle([0.0, 3.0 * mirror][k % 2]);
            let collision = collision(mirror, angle, friction, law, moment).with_crush_plane(plane);
            let Ok(impact) = collision.solve() else { continue };
            let placed = Placed { collision, crush_share: 0.5, impulse: None, skids: [None; 2] };
            let own = Friction::of(&placed).expect("friction");
            assert_eq!(own.throughout(collision).evaluate().impulse, impact.impulse, "{k}");
            let contact = collision.contact();
            let unit = 1e3_f64.copysign(impact.impulse.n);
            for (place, friction) in Friction::ALL.into_iter().flatten().enumerate() {
                let margins = friction.margins(&collision, &contact, unit);
                assert_eq!(margins.len(), friction.beyond().len());
                if friction == own {
                    assert!(margins.iter().all(|margin| *margin >= 0.0), "{k}: {margins:?}");
                    seen[place] += 1;
                } else {
                    let beyond: Vec<Friction> =
                        margins.iter().zip(friction.beyond()).filter(|(margin, _)| **margin < 0.0).map(|(_, beyond)| *beyond).collect();
                    let way = if friction == Friction::Holds { own } else { Friction::Holds };
                    assert_eq!(beyond, [way], "{k}: {own:?}");
                }
            }
        }
        assert!(seen.iter().all(|count| *count > 10), "{seen:?}");
    }

    #[test]
    fn without_friction_there_is_one_piece() {
        let limited = collision(1.0, 2.5, 0.4, Law::Brach, Moment::None);
        let placed = |collision, impulse| Placed { collision, crush_share: 0.5, impulse, skids: [None; 2] };
        assert_eq!(Friction::of(&placed(limited.with_impulse_ratio(ImpulseRatio::Critical), None)), None);
        assert_eq!(Friction::of(&placed(limited, Some(crate::frame::Xy { x: -9e3, y: 0.0 }))), None);
    }
}
