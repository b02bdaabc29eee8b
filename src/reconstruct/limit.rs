//! Limits of the physics: where a search along the evidence ends, or an interval.

use num_dual::Dual64;

use super::piece::Piece;
use super::placed::Placed;
use super::residuals::Model;
use super::variable::Variable;
use crate::contact::Contact;
use crate::impact::Impact;
use crate::law::ImpulseRatio;
use crate::least_squares::Bound;
use crate::scalar::Real;

/// Reason why a best fit, or the end of an interval, lies where it lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Limit {
    /// A bound of an unknown, given or that of the mechanics.
    Bound(Variable, Bound),
    /// Beyond it the vehicles do not approach each other.
    Closing,
    /// Beyond it the impulse would pull.
    Tension,
    /// Beyond it the tangential impulse is more than ends the sliding, or speeds it up.
    Sliding,
    /// Beyond it the impact would gain energy.
    Energy,
    /// An angle that has turned all the way round.
    Period,
}

impl Limit {
    /// Returns its name: that of the unknown and its bound, or the code of the refusal beyond it.
    pub fn name(self) -> String {
        match self {
            Limit::Bound(of, Bound::Min) => format!("{} min", of.name()),
            Limit::Bound(of, Bound::Max) => format!("{} max", of.name()),
            Limit::Closing => "not-closing".to_owned(),
            Limit::Tension => "tensile".to_owned(),
            Limit::Sliding => "beyond-critical".to_owned(),
            Limit::Energy => "energy-gain".to_owned(),
            Limit::Period => "period".to_owned(),
        }
    }
}

/// Returns the work that the normal impulse could do.
fn work<T: Real>(impact: &Impact<T>) -> T {
    impact.impulse.n.clone() * impact.approach.n.clone()
}

/// Returns `true` if the impact at a point, and those beside it, lose nothing but rounding: an elastic impact is at no limit. One that loses nothing among others that
/// gain is.
fn is_elastic(model: &Model<'_>, point: &[f64], impact: &Impact) -> bool {
    /// Share of the work that is rounding, far below the margin at which a search ends.
    const NOTHING: f64 = 1e-9;
    if impact.loss().abs() > NOTHING * work(impact) {
        return false;
    }
    let mut moved: Vec<Dual64> = point.iter().copied().map(Dual64::from).collect();
    (0..point.len()).all(|k| {
        moved[k].eps = model.scales[k];
        let impact = model.place(&moved).evaluate();
        moved[k].eps = 0.0;
        (impact.loss() / work(&impact)).eps.abs() <= NOTHING
    })
}

/// The margins of a collision: smooth functions of order 1 that are negative where the mechanics refuses it.
#[derive(Clone)]
pub(super) struct Margins {
    /// Those of the physics, in their order.
    limits: Vec<Limit>,
    /// The piece of the mechanics to stay within.
    piece: Piece,
    /// The side of vehicle 2 along n, 1 or −1.
    side: f64,
    /// The sign of a given impulse ratio, and 1 of a given share of the critical one; zero where neither limits anything.
    sliding: f64,
    /// `true` if a gain of energy is a limit.
    may_gain: bool,
    /// A significant relative velocity, impulse, energy and distance.
    velocity: f64,
    impulse: f64,
    energy: f64,
    /// `None` of point masses, and by momentum alone.
    distance: Option<f64>,
}

impl Margins {
    /// Creates the margins on the side of a collision that the mechanics accepts, that at a point, in its sizes.
    pub(super) fn around(model: &Model<'_>, point: &[f64], placed: &Placed<f64>, impact: &Impact) -> Self {
        let (collision, contact) = (&placed.collision, placed.collision.contact());
        let (approach, impulse) = match placed.impulse {
            Some(_) => (impact.approach.length(), impact.impulse.length()),
            None => (impact.approach.n.abs(), impact.impulse.n.abs()),
        };
        let velocity = approach.max(1.0);
        let impulse = impulse.max(velocity / contact.compliance.nn);
        // Point masses have no side on which they lie.
        let has_sides = placed.impulse.is_none() && !collision.is_of_points(&contact);
        let mut margins = Margins {
            limits: Vec::new(),
            piece: Piece::Whole,
            side: -1_f64.copysign(impact.approach.n),
            // A fixed ratio, or share, of zero has no tangential impulse, which nothing limits.
            sliding: match (Piece::of(placed), collision.impulse_ratio) {
                (Piece::OfRatio(side), _) => f64::from(side),
                (_, ImpulseRatio::Given(ratio)) if ratio != 0.0 => 1_f64.copysign(ratio),
                (_, ImpulseRatio::OfCritical(share)) if share != 0.0 || placed.ratio_is_unknown => 1.0,
                _ => 0.0,
            },
            may_gain: placed.impulse.is_some() || !is_elastic(model, point, impact),
            velocity,
            impulse,
            energy: impulse * velocity,
            distance: has_sides.then(|| contact.offset().n.abs().max(0.1)),
        };
        margins.limits = margins.of_physics(placed, &contact, impact).into_iter().map(|(limit, _)| limit).collect();
        margins
    }

    /// Lets the vehicles lie the other way round along the normal.
    pub(super) fn turn_round(&mut self) {
        self.side = -self.side;
    }

    /// Adds the edges of a piece of the mechanics.
    pub(super) fn within(&mut self, piece: Piece) {
        self.piece = piece;
        if let Piece::OfRatio(side) = piece {
            self.sliding = side.into();
        }
    }

    /// Returns the piece of the mechanics to whose edges the margins keep.
    pub(super) fn piece(&self) -> Piece {
        self.piece
    }

    /// Returns the limit whose distance a margin is, or `None` for an edge of the piece.
    pub(super) fn limit(&self, index: usize) -> Option<Limit> {
        self.limits.get(index).copied()
    }

    /// Returns the piece beyond each edge that a point is on, given its margins.
    pub(super) fn beyond(&self, margins: &[f64]) -> impl Iterator<Item = Piece> {
        /// Distance from an edge that is none.
        const ON: f64 = 1e-3;
        let is_on = |margin: &f64| margin.abs() < ON;
        let (limits, edges) = margins.split_at(self.limits.len());
        // Ratios of either sign meet where they have no tangential impulse, whatever that of sticking.
        let mut sliding = self.limits.iter().zip(limits).filter(|(limit, _)| **limit == Limit::Sliding);
        let meets = matches!(self.piece, Piece::OfRatio(_)) && sliding.nth(1).is_some_and(|(_, margin)| is_on(margin));
        let is_beyond = move |k: usize| edges.get(k).map_or(meets, is_on);
        self.piece.beyond().iter().enumerate().filter(move |(k, _)| is_beyond(*k)).map(|(_, beyond)| *beyond)
    }

    /// Returns the margins of a collision with its contact and its impact, in the order of [`Margins::limit`].
    pub(super) fn of<T: Real + From<f64>>(&self, placed: &Placed<T>, contact: &Contact<T>, impact: &Impact<T>) -> Vec<T> {
        let mut margins: Vec<T> = self.of_physics(placed, contact, impact).into_iter().map(|(_, margin)| margin).collect();
        margins.extend(self.piece.margins(&placed.collision, contact, -self.side * self.impulse));
        margins
    }

    fn of_physics<T: Real + From<f64>>(&self, placed: &Placed<T>, contact: &Contact<T>, impact: &Impact<T>) -> Vec<(Limit, T)> {
        /// Least approach velocity and offset, as a share: at zero there is no collision, and close to it nothing but rounding.
        const LEAST: f64 = 1e-4;
        /// Least of the rest, beyond rounding.
        const ROUNDING: f64 = 1e-7;
        let over = |value: T, unit: f64, least: f64| value * T::from(unit.recip()) - T::from(least);
        if placed.impulse.is_some() {
            return vec![(Limit::Energy, over(impact.loss(), self.energy, ROUNDING))];
        }
        let sticking = placed.collision.sticking_impulse(contact);
        let mut margins = vec![(Limit::Closing, over(impact.approach.n.clone(), -self.side * self.velocity, LEAST))];
        margins.extend(self.distance.map(|distance| (Limit::Closing, over(contact.offset().n, self.side * distance, LEAST))));
        margins.push((Limit::Tension, over(impact.impulse.n.clone(), -self.side * self.impulse, ROUNDING)));
        if self.may_gain {
            // Of the work that the impulse can do: the loss ends with the square of the approach, and a share of a constant would end it earlier.
            margins.push((Limit::Energy, over(impact.loss() - T::from(ROUNDING) * work(impact), self.energy, 0.0)));
        }
        match placed.collision.impulse_ratio {
            _ if self.sliding == 0.0 => (),
            // A normal impulse that pushes has the sign of the approach, and the tangential impulse that of the ratio beside it.
            ImpulseRatio::Given(_) => {
                let unit = -self.side * self.sliding * self.impulse;
                margins.push((Limit::Sliding, over(sticking.t - impact.impulse.t.clone(), unit, ROUNDING)));
                if placed.ratio_is_unknown {
                    margins.push((Limit::Sliding, over(impact.impulse.t.clone(), unit, 0.0)));
                }
            }
            ImpulseRatio::OfCritical(_) => margins.push((Limit::Tension, over(sticking.n, -self.side * self.impulse, ROUNDING))),
            ImpulseRatio::Critical | ImpulseRatio::LimitedByFriction(_) => (),
        }
        margins
    }
}
