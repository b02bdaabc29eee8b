//! What determines the impulse of a case.

/// What determines the impulse of a case.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ContactModel {
    /// Restitution and impulse ratio, at the crush plane.
    #[default]
    ImpulseRatio,
    /// Momentum alone: evidence of how the vehicles separated.
    Momentum {
        /// `true` if the impulse also changes the yaw rates, because the case gives yaw inertia and impact center of both vehicles.
        angular: bool,
    },
}

impl ContactModel {
    /// Returns `true` for momentum alone.
    pub fn is_momentum(self) -> bool {
        self != ContactModel::ImpulseRatio
    }

    /// Returns `true` if the model determines yaw rates.
    pub fn is_angular(self) -> bool {
        self != ContactModel::Momentum { angular: false }
    }
}
