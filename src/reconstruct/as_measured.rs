//! Compares evidence that was computed from a measurement by the error of what was measured.

use alloc::vec::Vec;

use super::crush_depth::CrushDepth;
use super::given::{Evidence, ReconstructionProblem};
use super::placed::Placed;
use super::way_to_rest::WayToRest;
use crate::impact::Impact;
use crate::scalar::Real;

/// The evidence whose errors are normal in something else than its value.
pub(super) struct AsMeasured {
    ways: Vec<WayToRest>,
    depths: Vec<CrushDepth>,
}

impl AsMeasured {
    pub(super) fn of(question: &ReconstructionProblem, evidence: &[Evidence]) -> Self {
        AsMeasured { ways: WayToRest::all(question, evidence), depths: CrushDepth::all(question, evidence) }
    }

    /// Returns `true` if the errors of all evidence are those of its values.
    pub(super) fn is_nothing(&self) -> bool {
        self.ways.is_empty() && self.depths.is_empty()
    }

    /// Returns the computed values of evidence, each replaced by that whose distance from the given one is, to first order, what the measurement differs by.
    pub(super) fn compared<T: Real + Copy + From<f64>>(&self, evidence: &[Evidence], placed: &Placed<T>, impact: &Impact<T>) -> Vec<T> {
        let mut computed = computed(evidence, placed, impact);
        self.ways.iter().for_each(|way| way.straighten(&mut computed));
        self.depths.iter().for_each(|depth| depth.straighten(&mut computed));
        computed
    }
}

/// Returns the computed values of evidence.
pub(super) fn computed<T: Real + Copy + From<f64>>(evidence: &[Evidence], placed: &Placed<T>, impact: &Impact<T>) -> Vec<T> {
    evidence.iter().map(|evidence| evidence.of.of(placed, impact).unwrap_or_else(|| T::int(0))).collect()
}
