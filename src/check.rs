//! Whether a collision, as any program reports it, can have happened as reported.
//!
//! A [`Record`] says what is known of one collision: masses, motions before and after, the contact, the coefficients, results such as a loss of energy or a ΔV.
//! [`check`] holds it against every [`Rule`] whose numbers are there, and tells which do not hold and by how much. What can be computed is computed by the
//! mechanics of this crate.
//!
//! # The bound
//!
//! Nothing computed with numbers is zero. How far a residual may be from it follows from how exact its numbers are: if any of them has a [`Resolution`], from
//! those, else from the tolerance of the [`Profile`] times the size that the residual has where nothing is right. The mechanics are evaluated in affine
//! arithmetic, so that the bound of a residual is the sum of the resolutions times the exact partial derivatives, and a term of second order: half a digit in each
//! number never makes a false alarm, and an error of several times the bound is found. Rounding is added.
//!
//! A record that breaks no rule passes, unless of one it cannot be told, because the bound is larger than the quantity itself: then it is
//! [`Verdict::Undecidable`].
//!
//! # In a test
//!
//! ```
//! use planar_impact::check::{Options, Record, Rule, Verdict, check};
//! # use planar_impact::*;
//! # let car: Vehicle = Vehicle {
//! #     mass: 1500.0, yaw_inertia: 2500.0, heading: Heading::from_angle(0.0), impact_center: ForwardLeft { forward: 2.0, left: 0.5 },
//! #     motion: Motion { velocity: Xy { x: 15.0, y: 0.0 }, yaw_rate: 0.0 },
//! # };
//! # let collision = Collision {
//! #     one: car.into(), two: Party::Barrier, crush_plane: CrushPlane::from_angle(0.0), restitution: 0.1,
//! #     impulse_ratio: ImpulseRatio::Critical, law: Law::Brach, moment: Moment::None,
//! # };
//! # let impact = collision.solve()?;
//! let record = Record::of(&collision, &impact); // or filled from another simulator
//! check(&record, &Options::default()).assert();
//!
//! // The yaw rate after the impact in the wrong direction:
//! let mut wrong = record.clone();
//! wrong.one.after.yaw_rate = wrong.one.after.yaw_rate.map(|rate| -rate);
//! let outcome = check(&wrong, &Options::default());
//! assert_eq!(outcome.verdict(), Verdict::Fail);
//! assert!(outcome.of(Rule::LineOfAction).next().is_some());
//! # Ok::<(), Refusals>(())
//! ```
//!
//! # Properties
//!
//! | what holds | test in `proptests/check.rs` |
//! |---|---|
//! | what this crate solves breaks no rule | `what_is_solved_passes` |
//! | nor do its numbers rounded to any digits, with their resolutions | `rounded_digits_raise_no_alarm` |
//! | a single corruption beyond the bound is found, under its name | `each_corruption_is_found_by_name` |

mod claims;
mod common;
mod fall;
mod finite;
mod group;
mod judge;
mod key;
mod known;
mod measure;
mod model;
mod momentum;
mod mutual;
mod normal;
mod outcome;
mod profile;
mod record;
mod reported;
mod resolution;
mod rule;
mod say;
mod subject;
mod tangent;
mod uncertain;
mod work;

pub use group::Consensus;
pub use key::Key;
pub use measure::Measure;
pub use model::{Agreement, Membership, Model, RatioKind};
pub use outcome::{Finding, Outcome, Verdict};
pub use profile::Profile;
pub use record::{Record, State, Subject};
pub use reported::{Reported, ReportedImpulse};
pub use resolution::Resolution;
pub use rule::{Rule, Severity};

use judge::Judge;
use known::Known;

/// How to check.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Options {
    /// The tolerance in place of the profile's, as a share of what a residual is where nothing is right.
    pub tolerance: Option<f64>,
}

/// Holds a record against every rule whose numbers are there, but for those of its group: see [`Consensus`].
pub fn check(record: &Record, options: &Options) -> Outcome {
    let mut judge = Judge::new(record.profile, options);
    finite::check(record, &mut judge);
    if !judge.has_failed() {
        finite::plausible(record, &mut judge);
        // Without resolutions there is no spread to carry.
        if record.resolution.is_empty() {
            laws::<0>(record, &mut judge);
        } else {
            laws::<{ subject::PLACES }>(record, &mut judge);
        }
    }
    judge.done(record.id.clone())
}

fn laws<const N: usize>(record: &Record, judge: &mut Judge) {
    let known = Known::<N>::of(record);
    momentum::check(&known, judge);
    normal::check(&known, judge);
    tangent::check(&known, judge);
    work::check(&known, judge);
    claims::check(&known, judge);
    mutual::check(&known, judge);
    if let Some(group) = &record.group {
        common::collect(&known, group.agreement, judge);
    }
}

#[cfg(test)]
mod tests;
