//! How exact the numbers of a record are taken to be.

/// How exact the numbers of a record are where no [`Resolution`](super::Resolution) is given, and what a resolution is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Profile {
    /// An impulse solver in f64: the laws hold to 1e-9.
    #[default]
    Impulse,
    /// Numbers from print: a resolution is half a unit of the last digit, and decides. A number without one is exact.
    Printed,
    /// An engine that steps through time in f64: momentum to 1e-6; its position correction disturbs the rest by up to 2e-2.
    Stepper,
    /// The same in f32: momentum to 1e-5, and the rounding of an f32.
    StepperF32,
    /// Measurements: a resolution is a standard uncertainty, and three of the residual's are allowed. Without any, 5e-2.
    Measured,
}

impl Profile {
    /// Every profile.
    pub const ALL: [Profile; 5] = [Profile::Impulse, Profile::Printed, Profile::Stepper, Profile::StepperF32, Profile::Measured];

    /// Its name in a file of records.
    pub const fn name(self) -> &'static str {
        match self {
            Profile::Impulse => "impulse",
            Profile::Printed => "printed",
            Profile::Stepper => "stepper",
            Profile::StepperF32 => "stepper-f32",
            Profile::Measured => "measured",
        }
    }

    /// How far linear momentum may be from conserved, as a share of what is exchanged.
    pub const fn linear_tolerance(self) -> f64 {
        match self {
            Profile::Impulse | Profile::Printed => 1e-9,
            Profile::Stepper => 1e-6,
            Profile::StepperF32 => 1e-5,
            Profile::Measured => 5e-2,
        }
    }

    /// The same for everything else.
    pub const fn tolerance(self) -> f64 {
        match self {
            Profile::Impulse | Profile::Printed => 1e-9,
            Profile::Stepper | Profile::StepperF32 => 2e-2,
            Profile::Measured => 5e-2,
        }
    }

    /// The share of its terms that a sum may be off by rounding: a few units in the last place.
    pub(super) const fn rounding(self) -> f64 {
        match self {
            Profile::StepperF32 => 1.0 / (1 << 20) as f64,
            _ => 64.0 * f64::EPSILON,
        }
    }
}
