//! Comparison of a reconstruction with published crashes: one figure, one limit with its source and one sentence for each question.
//!
//! The questions are those of EDCRASH's run-time diagnostics, and of the guideline of the paper. A figure outside its limit does not prove that the
//! reconstruction is wrong; it indicates what to examine first.

mod coefficients;
mod force;
mod meaning;
mod motion;

pub use meaning::Meaning;

use super::given::ReconstructionProblem;
use super::solution::Solution;
use crate::crush::{ForceLine, Profile, StiffnessZones};
use crate::impact::ForceDirection;

/// Margin by which a figure must be below its bound to be within it, if the question is about sitting on the bound.
const ON_BOUND: f64 = 1e-9;

/// A diagnostic question about a reconstruction.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Question {
    /// Do the crush forces of the two vehicles balance (Newton's third law)?
    ForceBalance,
    /// Are the measured principal directions of force on the two vehicles opposite?
    OppositeForces,
    /// Does each vehicle rotate in the direction of the moment of the force?
    Rotation,
    /// Do the vehicles reach a common velocity at the contact?
    CommonVelocity,
    /// Do the vehicles share the crush energy as their stiffness says?
    CrushShare,
    /// Is the restitution consistent with crash tests at this closing speed?
    Restitution,
    /// Is the restitution on its upper bound (the paper's guideline)?
    RestitutionBound,
    /// Has sliding ended: is the impulse ratio the critical one (the paper's guideline)?
    ImpulseRatio,
}

/// A number with its kind, in SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Figure {
    /// A plain number.
    Number(f64),
    /// A share, to be displayed in percent.
    Share(f64),
    /// An angle in rad.
    Angle(f64),
    /// A velocity in m/s.
    Speed(f64),
    /// A yaw rate in rad/s.
    YawRate(f64),
    /// A force in N.
    Force(f64),
}

/// The expected range of a figure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Limit {
    /// At most this.
    AtMost(Figure),
    /// From the first to the second.
    Between(Figure, Figure),
    /// The same sign as the quantity it is compared with.
    SameSign,
}

/// Position of a figure relative to its limit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reading {
    /// Within its limit.
    Within,
    /// Outside its limit.
    Outside,
    /// There is nothing to compare.
    NotChecked,
}

/// The answer to one question.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// The question.
    pub question: Question,
    /// Position of the figure relative to its limit.
    pub reading: Reading,
    /// The figure; `None` if there is nothing to compare.
    pub figure: Option<Figure>,
    /// Its expected range.
    pub limit: Limit,
    /// Source of the limit.
    pub source: &'static str,
    /// A sentence on the figure.
    pub meaning: Meaning,
}

/// The residual crush of one vehicle, as far as the questions need it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Damage {
    /// The crush energy, in J.
    pub crush_energy: f64,
    /// The force at the end of the crush, normal to the surface, in N; `None` if unknown.
    pub force: Option<f64>,
    /// Increase of the force with the depth, over the whole width, in N/m; `None` if it does not grow with depth.
    pub stiffness: Option<f64>,
    /// Direction the principal force comes from, as observed on the vehicle.
    pub force_direction: Option<ForceDirection>,
}

impl Question {
    /// Every question, in the order of the answers.
    pub const ALL: [Question; 8] = [
        Question::ForceBalance,
        Question::OppositeForces,
        Question::Rotation,
        Question::CommonVelocity,
        Question::CrushShare,
        Question::Restitution,
        Question::RestitutionBound,
        Question::ImpulseRatio,
    ];

    /// Returns its name in reports.
    pub fn name(self) -> &'static str {
        match self {
            Question::ForceBalance => "balance of crush forces",
            Question::OppositeForces => "opposite PDOFs",
            Question::Rotation => "rotation",
            Question::CommonVelocity => "common velocity",
            Question::CrushShare => "share of crush energy",
            Question::Restitution => "restitution",
            Question::RestitutionBound => "restitution at its bound",
            Question::ImpulseRatio => "impulse ratio",
        }
    }
}

impl Damage {
    /// Creates the damage from a crush profile and the stiffness along it.
    pub fn of(profile: &Profile, zones: &StiffnessZones) -> Self {
        let slopes = zones.moments(profile).zip(zones.zones()).map(|(moments, zone)| ForceLine::from(*zone).slope * moments.width());
        let (force, stiffness) = (Some(zones.crush_force(profile)), Some(slopes.sum()));
        let damage = Damage { crush_energy: zones.crush_energy(profile), force, stiffness, force_direction: None };
        // A profile without depth implies no force, and did not test its stiffness.
        if profile.depths().iter().all(|depth| *depth <= 0.0) { damage.without_force() } else { damage }
    }

    /// Returns the damage if the force stops growing at a depth: with another crush energy, and without the force and the stiffness that follow from the
    /// depth.
    pub fn saturated(self, crush_energy: f64) -> Self {
        Damage { crush_energy, ..self.without_force() }
    }

    fn without_force(self) -> Self {
        Damage { force: None, stiffness: None, ..self }
    }
}

impl Finding {
    fn new(question: Question, figure: Figure, limit: Limit, source: &'static str, meaning: Meaning) -> Self {
        let reading = if limit.admits(figure) { Reading::Within } else { Reading::Outside };
        Finding { question, reading, figure: Some(figure), limit, source, meaning }
    }

    fn not_checked(question: Question, limit: Limit, source: &'static str, why: &str) -> Self {
        Finding { question, reading: Reading::NotChecked, figure: None, limit, source, meaning: Meaning::of(why) }
    }
}

impl Figure {
    /// Returns the number, whatever its kind, in SI.
    pub fn value(self) -> f64 {
        match self {
            Figure::Number(value)
            | Figure::Share(value)
            | Figure::Angle(value)
            | Figure::Speed(value)
            | Figure::YawRate(value)
            | Figure::Force(value) => value,
        }
    }
}

impl Limit {
    /// Returns `true` if a figure is within the limit; NaN is not.
    pub fn admits(self, figure: Figure) -> bool {
        /// Accepted rounding of a figure beyond its limit.
        const ROUNDING: f64 = 1e-12;
        let value = figure.value();
        match self {
            Limit::AtMost(most) => value <= most.value() + ROUNDING,
            Limit::Between(least, most) => (least.value() - ROUNDING..=most.value() + ROUNDING).contains(&value),
            Limit::SameSign => value >= 0.0,
        }
    }
}

impl Solution {
    /// Compares this solution with published crashes: returns one finding for each [`Question`], and for the rotation one for each vehicle whose separation
    /// yaw rate is evidence.
    ///
    /// `damage` is the crush of vehicle 1 and of vehicle 2, if it was measured.
    pub fn diagnose(&self, question: &ReconstructionProblem, damage: &[Option<Damage>; 2]) -> Vec<Finding> {
        let mut findings = vec![force::balance(self, damage), force::opposite(self, damage)];
        findings.extend(motion::rotation(self));
        findings.push(motion::common_velocity(self));
        findings.push(force::share(self, damage));
        findings.push(coefficients::restitution(self));
        findings.push(coefficients::restitution_bound(self, question));
        findings.push(coefficients::impulse_ratio(self));
        findings
    }
}
