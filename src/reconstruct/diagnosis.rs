//! What a reconstruction looks like beside what is known of such crashes: one figure, one limit with its source and one sentence for each question.
//!
//! The questions are those that users of EDCRASH are used to from its run-time diagnostics, and the guideline of the paper. A figure outside its limit is no proof that the
//! reconstruction is wrong; it is what to look at first.

mod coefficients;
mod force;
mod meaning;
mod motion;

pub use meaning::Meaning;

use super::given::Reconstruction;
use super::solution::Solution;
use crate::crush::{ForceLine, Profile, StiffnessZones};
use crate::impact::ForceOrigin;

/// How far below its bound a figure has to be to be within it, where sitting on the bound is what is asked about.
const ON_BOUND: f64 = 1e-9;

/// A question that a reconstruction is asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Question {
    /// Do the crush forces of the two vehicles balance (Newton's third law)?
    ForceBalance,
    /// Are the principal directions of force that were read off the two vehicles opposite?
    OppositeForces,
    /// Does each vehicle turn the way the moment of the force turns it?
    Rotation,
    /// Do the vehicles reach a common velocity where they touch?
    CommonVelocity,
    /// Do the vehicles share the crush energy as their stiffness says?
    CrushShare,
    /// Is the restitution one that crash tests show at this closing speed?
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
    /// A share, to be read in per cent.
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

/// What is expected of a figure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Limit {
    /// At most this.
    AtMost(Figure),
    /// From the one to the other.
    Between(Figure, Figure),
    /// The same sign as what it is compared with.
    SameSign,
}

/// How a figure lies to its limit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reading {
    /// Within it.
    Within,
    /// Outside.
    Outside,
    /// There is nothing to compare.
    NotChecked,
}

/// The answer to one question.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// The question.
    pub question: Question,
    /// How the figure lies to its limit.
    pub reading: Reading,
    /// The figure; none where there is nothing to compare.
    pub figure: Option<Figure>,
    /// What is expected of it.
    pub limit: Limit,
    /// Where that comes from.
    pub source: &'static str,
    /// What it means.
    pub meaning: Meaning,
}

/// The residual crush of one vehicle, as far as the questions need it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Damage {
    /// The crush energy, in J.
    pub crush_energy: f64,
    /// The force that the crush has taken at its end, normal to the surface, in N; none where it is not known.
    pub force: Option<f64>,
    /// How the force grows with the depth, over the whole width, in N/m; none where it does not grow so.
    pub stiffness: Option<f64>,
    /// Where the principal force comes from, as read off the vehicle.
    pub force_origin: Option<ForceOrigin>,
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

    /// Its name in reports.
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
    /// Of a crush profile and the stiffness along it.
    pub fn of(profile: &Profile, zones: &StiffnessZones) -> Self {
        let lines = zones.moments(profile).zip(zones.zones()).map(|(moments, zone)| (moments, ForceLine::from(*zone)));
        let (force, stiffness) = lines.fold((0.0, 0.0), |(force, stiffness), (moments, line)| {
            (force + line.onset * moments.width() + line.slope * moments.second, stiffness + line.slope * moments.width())
        });
        Damage { crush_energy: zones.crush_energy(profile), force: Some(force), stiffness: Some(stiffness), force_origin: None }
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
    /// The number, whatever its kind, in SI.
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
    /// Whether a figure is within it. A figure that is not a number is not.
    pub fn admits(self, figure: Figure) -> bool {
        /// What rounding may take a figure beyond its limit by.
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
    /// What this solution looks like beside what is known of such crashes: one finding for each [`Question`], and for the rotation one for each vehicle whose
    /// separation yaw rate is evidence.
    ///
    /// `damage` is the crush of vehicle 1 and of vehicle 2, where it was measured.
    pub fn diagnose(&self, question: &Reconstruction, damage: &[Option<Damage>; 2]) -> Vec<Finding> {
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
