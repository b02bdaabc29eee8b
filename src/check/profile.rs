//! Assumed precision of the numbers of a record.

/// Assumed precision of numbers without a [`Resolution`](super::Resolution), and the meaning of a resolution.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
#[non_exhaustive]
pub enum Profile {
    /// An impulse solver in f64: the laws hold to 1e-9.
    #[default]
    Impulse,
    /// Printed numbers: a resolution is half a unit of the last digit, and determines the bound. A number without one is exact.
    Printed,
    /// A time-stepping engine in f64: momentum to 1e-6; its position correction disturbs the rest by up to 2e-2.
    Stepper,
    /// A time-stepping engine in f32: momentum to 1e-5, and the rounding of an f32.
    StepperF32,
    /// Measurements: a resolution is a standard uncertainty, and residuals of three standard uncertainties are accepted. Without any resolution, 5e-2.
    Measured,
}

impl Profile {
    /// Every profile.
    pub const ALL: [Profile; 5] = [Profile::Impulse, Profile::Printed, Profile::Stepper, Profile::StepperF32, Profile::Measured];

    /// Returns its name in a file of records.
    pub const fn name(self) -> &'static str {
        match self {
            Profile::Impulse => "impulse",
            Profile::Printed => "printed",
            Profile::Stepper => "stepper",
            Profile::StepperF32 => "stepper-f32",
            Profile::Measured => "measured",
        }
    }

    /// Returns the tolerance of the conservation of linear momentum, as a share of the exchanged momentum.
    pub const fn linear_tolerance(self) -> f64 {
        match self {
            Profile::Impulse | Profile::Printed => 1e-9,
            Profile::Stepper => 1e-6,
            Profile::StepperF32 => 1e-5,
            Profile::Measured => 5e-2,
        }
    }

    /// Returns the tolerance of every other rule.
    pub const fn tolerance(self) -> f64 {
        match self {
            Profile::Impulse | Profile::Printed => 1e-9,
            Profile::Stepper | Profile::StepperF32 => 2e-2,
            Profile::Measured => 5e-2,
        }
    }

    /// Returns the rounding error of a sum as a share of its terms: a few units in the last place.
    pub(super) const fn rounding(self) -> f64 {
        match self {
            Profile::StepperF32 => 1.0 / (1 << 20) as f64,
            _ => 64.0 * f64::EPSILON,
        }
    }
}
