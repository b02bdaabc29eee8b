//! Which rows may have a result that deserves a second look: bounds without an angle, so that only those are solved by themselves.

use planar_impact::batch::{Batch, Columns, Form, MomentForm};
use planar_impact::{Collision, Input, Output, Side};

use crate::doubtful::{self, NEARLY_WEDGED};
use crate::notice::Notice;

/// Rounding of a bound, and of an output that is computed with other instructions.
const MARGIN: f64 = 1.001;

/// Numbers of solved rows, by which they are watched.
pub(super) struct Watch<'a> {
    columns: &'a [Vec<f64>; Input::COUNT],
    forms: &'a [Form],
    outputs: Columns,
}

impl<'a> Watch<'a> {
    pub(super) fn of(batch: &Batch<'_>, columns: &'a [Vec<f64>; Input::COUNT], forms: &'a [Form]) -> Self {
        use Output::{ImpulseRatio, NormalApproach, NormalImpulse};
        Watch { columns, forms, outputs: batch.evaluate(&[NormalImpulse, NormalApproach, ImpulseRatio]) }
    }

    /// Returns `false` if [`doubtful::result`] finds nothing about a row of usual sizes.
    pub(super) fn may_be_doubtful(&self, row: usize) -> bool {
        let output = |output: Output| self.outputs[output][row];
        let [least, greatest] = self.compliance(row);
        let e = self.columns[Input::Restitution.index()][row];
        let may_gain = {
            // 1 − K_nt²/(K_nn K_tt) is least where K_nn = K_tt: det K over the square of half the trace.
            let ratio = greatest / least;
            MARGIN * e * e > 4.0 * ratio / ((1.0 + ratio) * (1.0 + ratio))
        };
        let may_wedge = {
            // P_n = −(1 + e) v_n/(K_nn + μ K_nt), but for a moment impulse, and its parts are not above the greatest compliance.
            let along_ratio = (1.0 + e) * (output(Output::NormalApproach) / output(Output::NormalImpulse)).abs();
            let share = along_ratio / (greatest * (1.0 + output(Output::ImpulseRatio).abs()));
            share.is_nan() || share < MARGIN * NEARLY_WEDGED || self.forms[row].moment != MomentForm::None
        };
        may_gain || may_wedge
    }

    /// Returns bounds of the compliance K of a row in any direction: Σ 1/m, and with it Σ r²/I.
    fn compliance(&self, row: usize) -> [f64; 2] {
        let of = |input: Input| self.columns[input.index()][row];
        let (mut least, mut of_arms) = (0.0, 0.0);
        for side in Side::ALL.into_iter().filter(|side| self.forms[row].is_vehicle[*side as usize]) {
            let (forward, left) = (of(Input::ImpactCenterForward(side)), of(Input::ImpactCenterLeft(side)));
            least += 1.0 / of(Input::Mass(side));
            of_arms += (forward * forward + left * left) / of(Input::YawInertia(side));
        }
        [least, least + of_arms]
    }
}

/// Returns the warnings about the result of a row, which is solved by itself; one that has unusual sizes may lack digits too. A tangential impulse that returns energy is
/// common in tables, which have its work, and no warning there.
pub(super) fn of_result(collision: &Collision, is_unusual: bool) -> Vec<Notice> {
    collision.solve().map_or_else(|_| Vec::new(), |impact| doubtful::result(collision, &impact, is_unusual))
}
