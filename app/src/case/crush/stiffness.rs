//! A stiffness in the form in which a case file gives it.

use planar_impact::Real;
use planar_impact::crush::{BarrierSpeedLine, CrushStiffness, ForceLine};

use super::key::FormKey;

/// A stiffness in the form in which a case file gives it, in SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StiffnessInputs {
    /// d0 and d1.
    Roots(CrushStiffness),
    /// A and B.
    Force(ForceLine),
    /// b0 and b1 of a barrier test.
    Speed(BarrierSpeedLine),
}

impl StiffnessInputs {
    /// Returns the stiffness as d0 and d1.
    pub fn roots(&self) -> CrushStiffness {
        self.on_scalar(|_| 0.0)
    }

    /// Sets d0 or d1, which from then on are its form.
    pub(super) fn set_roots(&mut self, set: impl FnOnce(&mut CrushStiffness)) {
        let mut roots = self.roots();
        set(&mut roots);
        *self = StiffnessInputs::Roots(roots);
    }

    /// Returns a number of another form, or `None` if the stiffness does not have this form.
    pub(super) fn place(&mut self, key: FormKey) -> Option<&mut f64> {
        match (self, key) {
            (StiffnessInputs::Force(line), FormKey::ForceOnset) => Some(&mut line.onset),
            (StiffnessInputs::Force(line), FormKey::ForceSlope) => Some(&mut line.slope),
            (StiffnessInputs::Speed(line), FormKey::SpeedOnset) => Some(&mut line.onset),
            (StiffnessInputs::Speed(line), FormKey::SpeedSlope) => Some(&mut line.slope),
            (StiffnessInputs::Speed(line), FormKey::TestMass) => Some(&mut line.test_mass),
            (StiffnessInputs::Speed(line), FormKey::TestWidth) => Some(&mut line.test_width),
            _ => None,
        }
    }

    /// Returns the stiffness as d0 and d1 on any scalar type, adding `by` of its key to each number of another form.
    pub(super) fn on_scalar<T: Real + From<f64>>(&self, mut by: impl FnMut(FormKey) -> T) -> CrushStiffness<T> {
        let mut plus = |value: f64, key| T::from(value) + by(key);
        match self {
            StiffnessInputs::Roots(line) => CrushStiffness { onset: T::from(line.onset), slope: T::from(line.slope) },
            StiffnessInputs::Force(line) => {
                let (onset, slope) = (plus(line.onset, FormKey::ForceOnset), plus(line.slope, FormKey::ForceSlope));
                ForceLine { onset, slope }.into()
            }
            StiffnessInputs::Speed(line) => {
                let (onset, slope) = (plus(line.onset, FormKey::SpeedOnset), plus(line.slope, FormKey::SpeedSlope));
                let (test_mass, test_width) = (plus(line.test_mass, FormKey::TestMass), plus(line.test_width, FormKey::TestWidth));
                BarrierSpeedLine { onset, slope, test_mass, test_width }.into()
            }
        }
    }
}

impl From<CrushStiffness> for StiffnessInputs {
    fn from(stiffness: CrushStiffness) -> Self {
        StiffnessInputs::Roots(stiffness)
    }
}
