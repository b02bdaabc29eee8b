//! Consistency checks of a collision as any program reports it.
//!
//! A [`Record`] contains what is known of one collision: masses, motions before and after, the contact, the coefficients, and results such as an energy loss
//! or a ΔV. [`check`] tests it against every [`Rule`] whose numbers are present, and reports which rules are broken and by how much. Derived quantities are
//! computed by the mechanics of this crate.
//!
//! # The bound
//!
//! No number computed from rounded numbers is exactly zero. How far a residual may be from zero follows from the precision of its numbers: from their
//! [`Resolution`]s if any of them has one, otherwise from the tolerance of the [`Profile`] times the size of a residual with arbitrary errors. The mechanics
//! are evaluated in affine arithmetic, so the bound of a residual is the sum of the resolutions times the exact partial derivatives, plus a second-order
//! term: half a digit in each number never raises a false alarm, and an error of several times the bound is found. Rounding is added.
//!
//! A record that breaks no rule passes, unless a rule cannot be evaluated because the bound is larger than the quantity itself: then the verdict is
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
//! check(&record, &Options::default()).assert(); // also that no number is missing
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
//! | property | test in `proptests/check.rs` |
//! |---|---|
//! | a collision solved by this crate breaks no rule | `what_is_solved_passes` |
//! | the same with a moment impulse | `what_is_solved_with_a_moment_passes` |
//! | a contact that lasts breaks no law that holds for any force | `a_contact_that_lasts_breaks_no_law_of_any_force` |
//! | nor do its numbers when rounded to any number of digits, with their resolutions | `rounded_digits_raise_no_alarm` |
//! | a single corruption beyond the bound is found, under the name of its rule | `each_corruption_is_found_by_name` |

mod claim_consistency;
mod claimed_energies;
mod claimed_impulse;
mod claims;
mod common;
mod coverage;
mod energy_loss;
mod finite;
mod format;
mod group;
mod implied_motions;
mod judge;
mod key;
mod known;
mod model;
mod momentum;
mod normal;
mod options;
mod outcome;
mod profile;
mod record;
mod reported;
mod resolution;
mod resolution_group;
mod rule;
mod subject;
mod tangent;
mod travel;
mod uncertain;
mod work;

pub use group::Consensus;
pub use key::Key;
pub use model::{Agreement, Membership, Model, RatioKind};
pub use options::Options;
pub use outcome::{Finding, Outcome, Unchecked, Verdict};
pub use profile::Profile;
pub use record::{Record, State, Subject};
pub use reported::{Reported, ReportedImpulse};
pub use resolution::Resolution;
pub use resolution_group::ResolutionGroup;
pub use rule::{Rule, Severity};

use judge::Judge;
use known::Known;

/// Checks a record against every rule whose numbers are present, except the rule of its group: see [`Consensus`].
///
/// Numbers and [`Options`] that are not finite or out of range break [`Rule::Finite`]; then nothing else is checked.
pub fn check(record: &Record, options: &Options) -> Outcome {
    // Without resolutions there is no spread to propagate.
    if record.resolution.is_empty() { check_exact(record, options) } else { checked(record, options, laws::<{ subject::PLACES }>) }
}

/// Checks a record as [`check`] does, with its numbers as they are: resolutions do not count. A program that calls this alone does not hold the propagation of
/// resolutions, which is two thirds of the checker.
///
/// ```
/// use planar_impact::check::{Key, Options, Record, Resolution, Verdict, check, check_exact};
/// let mut record = Record { resolution: Resolution::default().with_key(Key::SeparationSpeed, 0.1), ..Record::default() };
/// [(Key::ClosingSpeed, 10.0), (Key::SeparationSpeed, 2.05), (Key::Restitution, 0.2)].into_iter().for_each(|(key, value)| record.set(key, value));
/// assert_eq!(check(&record, &Options::default()).verdict(), Verdict::Pass);
/// assert_eq!(check_exact(&record, &Options::default()).verdict(), Verdict::Fail);
/// ```
pub fn check_exact(record: &Record, options: &Options) -> Outcome {
    checked(record, options, laws::<0>)
}

fn checked(record: &Record, options: &Options, laws: fn(&Record, &mut Judge)) -> Outcome {
    let mut judge = Judge::new(record.profile, options);
    finite::check(record, options, &mut judge);
    if !judge.has_failed() {
        finite::plausible(record, &mut judge);
        laws(record, &mut judge);
    }
    judge.done(record)
}

fn laws<const N: usize>(record: &Record, judge: &mut Judge) {
    let known = Known::<N>::of(record);
    if let Some(share) = known.touch.and_then(|touch| touch.wedging_share()) {
        judge.allow_for_wedging(share);
    }
    momentum::check(&known, judge);
    normal::check(&known, judge);
    tangent::check(&known, judge);
    work::check(&known, judge);
    claims::check(&known, judge);
    claim_consistency::check(&known, judge);
    // What is claimed has to hold by itself too: coarse motions leave more open than precise claims do.
    if let Some(claimed) = known.without_motions().filter(|_| !judge.has_failed()) {
        let mut alone = judge.afresh();
        normal::check(&claimed, &mut alone);
        tangent::check(&claimed, &mut alone);
        claim_consistency::check(&claimed, &mut alone);
        judge.take_failures(alone);
    }
    implied_motions::check(&known, judge);
    if let Some(group) = &record.group {
        common::collect(&known, group.agreement, judge);
    }
}

#[cfg(test)]
mod tests;
