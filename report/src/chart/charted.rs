//! The data of a chart of a sweep.

use std::ops::Deref;

use planar_impact_app::sweep::Sweep;
use planar_impact_app::units::Units;

/// A sweep in the units of its chart.
pub struct Charted<'a> {
    pub sweep: &'a Sweep,
    pub units: Units,
}

impl Deref for Charted<'_> {
    type Target = Sweep;

    fn deref(&self) -> &Sweep {
        self.sweep
    }
}
