//! The model stated by a program, and groups of records that must agree.

use crate::law::Law;
use alloc::string::String;

/// The model stated by the program.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Model {
    /// Coefficient of restitution e.
    pub restitution: Option<f64>,
    /// The number that specifies the impulse ratio, as described by `ratio_kind`.
    pub impulse_ratio: Option<f64>,
    /// The kind of that number.
    pub ratio_kind: RatioKind,
    /// The impulse that ends the tangential process.
    pub law: Law,
}

/// The kind of the impulse ratio of a model.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum RatioKind {
    /// The number is μ = P_t/P_n, with its sign.
    #[default]
    Given,
    /// Sliding has ended as the law says; the number, if present, is the resulting ratio.
    Critical,
    /// The number is the fraction of the critical ratio.
    OfCritical,
    /// The number is a coefficient of friction: sliding has ended, or continues throughout at this ratio.
    Friction,
}

impl RatioKind {
    /// Every kind.
    pub const ALL: [RatioKind; 4] = [RatioKind::Given, RatioKind::Critical, RatioKind::OfCritical, RatioKind::Friction];

    /// Returns its name in a file of records.
    pub const fn name(self) -> &'static str {
        match self {
            RatioKind::Given => "given",
            RatioKind::Critical => "critical",
            RatioKind::OfCritical => "of_critical",
            RatioKind::Friction => "friction",
        }
    }
}

/// Membership of a record in a group.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Membership {
    /// The name of the group.
    pub name: String,
    /// The quantities that its records share.
    pub agreement: Agreement,
}

/// The quantities that the records of a group share.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum Agreement {
    /// The energy lost and the magnitude of the impulse: a sweep of the crush plane at e = 0 and μ = μ₀, mirror images, exchanged bodies, moving observers.
    #[default]
    Magnitudes,
    /// Only the energy lost.
    Loss,
    /// The energy lost and the magnitude of the impulse, and also the impulse and the post-impact motions by component: a sweep of the crush plane at e = 0
    /// and μ = μ₀.
    Outcome,
}

impl Agreement {
    /// Every agreement.
    pub const ALL: [Agreement; 3] = [Agreement::Magnitudes, Agreement::Loss, Agreement::Outcome];

    /// Returns its name in a file of records.
    pub const fn name(self) -> &'static str {
        match self {
            Agreement::Magnitudes => "magnitudes",
            Agreement::Loss => "loss",
            Agreement::Outcome => "outcome",
        }
    }
}
