//! Rows in cache, and the loops over them, each of which is compiled into vector instructions.
//!
//! The impact is computed in three passes: directions, mechanics, magnitudes and angles. In one pass the processor would wait for the sines of a row before it
//! could begin the next.

// A loop over rows takes from several columns at once.
#![allow(clippy::needless_range_loop)]

use super::form::{Form, RatioForm};
use super::instructions::Vectors;
use super::row::{Row, vector};
use crate::frame::{CrushPlane, Heading};
use crate::impact::ForceDirection;
use crate::input::{Input, Side};
use crate::output::Output;
use crate::scalar::circular;

/// Number of rows.
pub(super) const ROWS: usize = 48;

/// A number of each row.
pub(super) type Column = [f64; ROWS];

pub(super) const NOTHING: Column = [0.0; ROWS];

/// Rows of one form.
#[repr(align(64))]
pub(super) struct Tile {
    pub(super) inputs: [Column; Input::COUNT],
    pub(super) outputs: [Column; Output::COUNT],
    /// Cosine and sine of both headings and of the crush plane.
    directions: [[Column; 2]; 3],
    /// Where the force comes from, right and ahead, of each vehicle.
    forces: [[Column; 2]; 2],
    /// The sticking impulse.
    critical: [Column; 2],
    /// Not zero where the impact is possible; only if asked.
    pub(super) possible: [u64; ROWS],
}

/// What is asked of a tile.
pub(super) struct Asked<'a> {
    pub(super) tile: &'a mut Tile,
    pub(super) form: Form,
    /// Whether the impact is possible.
    pub(super) is_checked: bool,
    /// Whether arctangents are.
    pub(super) has_angles: bool,
}

impl Vectors for Asked<'_> {
    #[inline(always)]
    fn compute(&mut self) {
        self.tile.evaluate(self.form, self.is_checked, self.has_angles);
    }
}

impl Tile {
    pub(super) const fn new() -> Self {
        Tile {
            inputs: [NOTHING; Input::COUNT],
            outputs: [NOTHING; Output::COUNT],
            directions: [[NOTHING; 2]; 3],
            forces: [[NOTHING; 2]; 2],
            critical: [NOTHING; 2],
            possible: [0; ROWS],
        }
    }

    /// Computes the outputs of every row.
    #[inline(always)]
    fn evaluate(&mut self, form: Form, is_checked: bool, has_angles: bool) {
        let angles = [Input::Heading(Side::One), Input::Heading(Side::Two), Input::CrushPlane];
        for (angle, [cos, sin]) in angles.into_iter().zip(&mut self.directions) {
            sines(&self.inputs[angle.index()], sin, cos);
        }
        // Each form is a loop of its own, without a choice in it. A barrier is one even if the other party is.
        let Form { is_vehicle: [one, two], ratio, law, .. } = form;
        macro_rules! of_form {
            ($($one:literal $two:literal $ratio:ident;)*) => {
                match (one, two, ratio) {
                    $(($one, $two, RatioForm::$ratio) => {
                        let form = Form { is_vehicle: [$one, $two], ratio: RatioForm::$ratio, law, ..Form::default() };
                        if is_checked { self.mechanics::<true>(form) } else { self.mechanics::<false>(form) }
                    })*
                    (false, false, _) => (),
                }
            };
        }
        of_form! {
            true true Critical; true true Given; true true OfCritical; true true LimitedByFriction;
            true false Critical; true false Given; true false OfCritical; true false LimitedByFriction;
            false true Critical; false true Given; false true OfCritical; false true LimitedByFriction;
        }
        self.finish(has_angles);
    }

    #[inline(always)]
    fn mechanics<const CHECKED: bool>(&mut self, form: Form) {
        let Tile { inputs, outputs, directions, forces, critical, possible } = self;
        mechanics::<CHECKED>(form, inputs, directions, outputs, forces, critical, possible);
    }

    /// Computes magnitudes, ratios and angles from components.
    #[inline(always)]
    fn finish(&mut self, has_angles: bool) {
        let Tile { outputs, forces, critical, .. } = self;
        let [n, t, of] = [Output::NormalImpulse, Output::TangentialImpulse, Output::ImpulseRatio].map(Output::index);
        for row in 0..ROWS {
            outputs[of][row] = outputs[t][row] / outputs[n][row];
        }
        let of = Output::CriticalImpulseRatio.index();
        for row in 0..ROWS {
            outputs[of][row] = critical[1][row] / critical[0][row];
        }
        for (side, [right, ahead]) in Side::ALL.into_iter().zip(forces) {
            let [x, y, of] = [Output::DeltaVX(side), Output::DeltaVY(side), Output::DeltaVMagnitude(side)].map(Output::index);
            for row in 0..ROWS {
                outputs[of][row] = vector(outputs[x][row], outputs[y][row]).length().0;
            }
            if has_angles {
                angles(right, ahead, &mut outputs[Output::PrincipalDirectionOfForce(side).index()]);
            }
        }
    }
}

#[inline(always)]
fn sines(angle: &Column, sin: &mut Column, cos: &mut Column) {
    if circular::are_within(angle, circular::LARGEST_ANGLE) {
        for row in 0..ROWS {
            (sin[row], cos[row]) = circular::sin_cos_within(angle[row]);
        }
    } else {
        for row in 0..ROWS {
            (sin[row], cos[row]) = circular::sin_cos(angle[row]);
        }
    }
}

#[inline(always)]
fn angles(right: &Column, ahead: &Column, angle: &mut Column) {
    if circular::are_within(right, circular::LARGEST_COORDINATE) && circular::are_within(ahead, circular::LARGEST_COORDINATE) {
        for row in 0..ROWS {
            angle[row] = ForceDirection { ahead: Row(ahead[row]), right: Row(right[row]) }.direction().0;
        }
    } else {
        for row in 0..ROWS {
            angle[row] = ForceDirection { ahead: ahead[row], right: right[row] }.direction();
        }
    }
}

#[inline(always)]
fn mechanics<const CHECKED: bool>(
    form: Form,
    inputs: &[Column; Input::COUNT],
    directions: &[[Column; 2]; 3],
    outputs: &mut [Column; Output::COUNT],
    forces: &mut [[Column; 2]; 2],
    critical: &mut [Column; 2],
    possible: &mut [u64; ROWS],
) {
    for row in 0..ROWS {
        let direction = |of: usize| (Row(directions[of][0][row]), Row(directions[of][1][row]));
        let heading = |of| {
            let (cos, sin) = direction(of);
            Heading { cos, sin }
        };
        let (cos, sin) = direction(2);
        let number = |input: Input| Row(inputs[input.index()][row]);
        let collision = form.collision().given([heading(0), heading(1)], CrushPlane { cos, sin }, number);
        let contact = collision.contact();
        let impact = collision.impact_at(&contact);
        macro_rules! outputs {
            ($($output:expr),* $(,)?) => {
                $(outputs[$output.index()][row] = $output.of(&collision, &impact).0;)*
            };
        }
        use Output::*;
        use Side::{One, Two};
        outputs![
            VelocityX(One),
            VelocityY(One),
            YawRate(One),
            DeltaVX(One),
            DeltaVY(One),
            VelocityX(Two),
            VelocityY(Two),
            YawRate(Two),
            DeltaVX(Two),
            DeltaVY(Two),
            Restitution,
            NormalImpulse,
            TangentialImpulse,
            ImpulseX,
            ImpulseY,
            Moment,
            NormalApproach,
            TangentialApproach,
            NormalSeparation,
            TangentialSeparation,
            EnergyBefore,
            EnergyAfter,
            Loss,
            NormalWork,
            TangentialWork,
            MomentWork,
        ];
        let [one, two] = [impact.one.force_direction(), impact.two.force_direction()];
        (forces[0][0][row], forces[0][1][row]) = (one.right.0, one.ahead.0);
        (forces[1][0][row], forces[1][1][row]) = (two.right.0, two.ahead.0);
        (critical[0][row], critical[1][row]) = (impact.critical_impulse.n.0, impact.critical_impulse.t.0);
        if CHECKED {
            possible[row] = u64::from(collision.is_possible(&contact, &impact));
        }
    }
}
