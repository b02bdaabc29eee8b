//! Results that a program reports besides the motions.

/// Results that a program reports besides the motions. Each is compared with what the motions imply and with the others.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Reported {
    /// Energy lost, T_L, in J.
    pub energy_loss: Option<f64>,
    /// Work of the normal impulse in J, negative where energy is lost.
    pub work_normal: Option<f64>,
    /// Work of the tangential impulse in J, negative where energy is lost.
    pub work_tangential: Option<f64>,
    /// Work of the moment impulse in J, negative where energy is lost.
    pub work_moment: Option<f64>,
    /// Kinetic energy of both bodies before the impact, in J.
    pub kinetic_energy_before: Option<f64>,
    /// Kinetic energy of both bodies after it, in J.
    pub kinetic_energy_after: Option<f64>,
    /// Magnitude of the change of velocity of bodies 1 and 2, in m/s.
    pub delta_v: [Option<f64>; 2],
    /// Direction that the force on bodies 1 and 2 comes from, clockwise from the heading, in rad.
    pub pdof: [Option<f64>; 2],
    /// Equivalent energy speed of bodies 1 and 2 in m/s: Σ ½ m EES² is the work of the normal impulse with its sign reversed or, in some programs, the total
    /// loss.
    pub ees: [Option<f64>; 2],
    /// The impulse on body 1.
    pub impulse: ReportedImpulse,
    /// Speed at which the bodies approach each other along the normal at the contact point, in m/s.
    pub closing_speed: Option<f64>,
    /// Speed at which they separate there, in m/s.
    pub separation_speed: Option<f64>,
    /// P_t/P_n.
    pub impulse_ratio: Option<f64>,
    /// The ratio at which sliding just ends, μ₀.
    pub critical_impulse_ratio: Option<f64>,
}

/// The impulse on body 1 as a program reports it, in N s.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ReportedImpulse {
    /// Along the normal.
    pub normal: Option<f64>,
    /// Along the tangent: the normal turned by +90°.
    pub tangential: Option<f64>,
    /// Along x.
    pub x: Option<f64>,
    /// Along y.
    pub y: Option<f64>,
    /// Its magnitude.
    pub magnitude: Option<f64>,
}
