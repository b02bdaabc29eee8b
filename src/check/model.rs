//! What the program that made a record says it used, and which records must agree.

use crate::law::Law;
use alloc::string::String;

/// What the program says it used.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Model {
    /// Coefficient of restitution e.
    pub restitution: Option<f64>,
    /// The number that the impulse ratio is given by; what it is depends on the kind.
    pub impulse_ratio: Option<f64>,
    /// What that number is.
    pub ratio_kind: RatioKind,
    /// Which impulse ends the tangential process.
    pub law: Law,
}

/// What the impulse ratio of a model is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum RatioKind {
    /// The number is μ = P_t/P_n, signed.
    #[default]
    Given,
    /// Sliding has ended as the law says; the number, if there is one, is the ratio that came out.
    Critical,
    /// The number is the fraction of the critical ratio.
    OfCritical,
    /// The number is a coefficient of friction: sliding has ended, or goes on throughout at this ratio.
    Friction,
}

impl RatioKind {
    /// Every kind.
    pub const ALL: [RatioKind; 4] = [RatioKind::Given, RatioKind::Critical, RatioKind::OfCritical, RatioKind::Friction];

    /// Its name in a file of records.
    pub const fn name(self) -> &'static str {
        match self {
            RatioKind::Given => "given",
            RatioKind::Critical => "critical",
            RatioKind::OfCritical => "of_critical",
            RatioKind::Friction => "friction",
        }
    }
}

/// That a record belongs to a group.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Membership {
    /// The name of the group.
    pub name: String,
    /// What its records have in common.
    pub agreement: Agreement,
}

/// What the records of a group have in common.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Agreement {
    /// The energy lost and the magnitude of the impulse: a sweep of the crush plane at e = 0 and μ = μ₀, mirror images, exchanged bodies, moving observers.
    #[default]
    Magnitudes,
    /// The energy lost alone.
    Loss,
    /// These, and the impulse and the motions after it component by component: a sweep of the crush plane at e = 0 and μ = μ₀.
    Outcome,
}

impl Agreement {
    /// Every agreement.
    pub const ALL: [Agreement; 3] = [Agreement::Magnitudes, Agreement::Loss, Agreement::Outcome];

    /// Its name in a file of records.
    pub const fn name(self) -> &'static str {
        match self {
            Agreement::Magnitudes => "magnitudes",
            Agreement::Loss => "loss",
            Agreement::Outcome => "outcome",
        }
    }
}
