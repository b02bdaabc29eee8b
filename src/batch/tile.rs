//! Rows in cache, and the loops over them, each of which is compiled into vector instructions.
//!
//! The impact is computed in three passes: directions, mechanics, magnitudes and angles. In one pass the processor would wait for the sines of a row before it
//! could begin the next.

// A loop over rows takes from several columns at once.
#![allow(clippy::needless_range_loop)]

use super::form::{Form, RatioForm};
use super::instructions::Vectors;
use core::marker::PhantomData;

use super::row::Number;
use crate::frame::{CrushPlane, Heading, Xy};
use crate::impact::ForceDirection;
use crate::input::{Input, Side};
use crate::output::Output;
use crate::scalar::circular;

/// Number of rows.
pub(super) const ROWS: usize = 48;

/// A number of each row.
pub(super) type Column = [f64; ROWS];

pub(super) const NOTHING: Column = [0.0; ROWS];

/// The inputs that are directions.
pub(super) const ANGLES: [Input; 3] = [Input::Heading(Side::One), Input::Heading(Side::Two), Input::CrushPlane];

/// Rows of one form.
#[repr(align(64))]
pub(super) struct Tile {
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

/// What is asked of a tile, to be computed on a scalar.
pub(super) struct Asked<'a, N> {
    pub(super) tile: &'a mut Tile,
    pub(super) inputs: &'a [&'a Column; Input::COUNT],
    pub(super) form: Form,
    /// Whether the headings and the crush plane are other than in the tile before.
    pub(super) is_turned: [bool; 3],
    /// Whether the impact is possible.
    pub(super) is_checked: bool,
    /// Whether arctangents are.
    pub(super) has_angles: bool,
    pub(super) scalar: PhantomData<N>,
}

impl<'a, N> Asked<'a, N> {
    /// Returns the same on another scalar.
    pub(super) fn on<M>(self) -> Asked<'a, M> {
        let Asked { tile, inputs, form, is_turned, is_checked, has_angles, .. } = self;
        Asked { tile, inputs, form, is_turned, is_checked, has_angles, scalar: PhantomData }
    }
}

impl<N: Number> Vectors for Asked<'_, N> {
    const FUSED: bool = N::FUSED;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn compute(&mut self) {
        self.tile.turn::<N>(self.inputs, self.is_turned);
        self.tile.evaluate::<N>(self.inputs, self.form, self.is_checked, self.has_angles);
    }
}

impl Tile {
    pub(super) const fn new() -> Self {
        Tile {
            outputs: [NOTHING; Output::COUNT],
            directions: [[NOTHING; 2]; 3],
            forces: [[NOTHING; 2]; 2],
            critical: [NOTHING; 2],
            possible: [0; ROWS],
        }
    }

    /// Returns `true` if the impact of a row, or of the last that fills the tile up, is impossible.
    pub(super) fn has_impossible(&self) -> bool {
        self.possible.iter().fold(false, |any, possible| any | (*possible == 0))
    }

    /// Computes the directions that are other than in the tile before.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn turn<N: Number>(&mut self, inputs: &[&Column; Input::COUNT], is_turned: [bool; 3]) {
        for ((angle, is_turned), [cos, sin]) in ANGLES.into_iter().zip(is_turned).zip(&mut self.directions) {
            if is_turned {
                sines::<N>(inputs[angle.index()], sin, cos);
            }
        }
    }

    /// Computes the outputs of every row.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn evaluate<N: Number>(&mut self, inputs: &[&Column; Input::COUNT], form: Form, is_checked: bool, has_angles: bool) {
        // Each form is a loop of its own, without a choice in it. A barrier is one even if the other party is.
        let Form { is_vehicle: [one, two], ratio, law, .. } = form;
        macro_rules! of_form {
            ($($one:literal $two:literal $ratio:ident;)*) => {
                match (one, two, ratio) {
                    $(($one, $two, RatioForm::$ratio) => {
                        let form = Form { is_vehicle: [$one, $two], ratio: RatioForm::$ratio, law, ..Form::default() };
                        if is_checked { self.mechanics::<N, true>(inputs, form) } else { self.mechanics::<N, false>(inputs, form) }
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
        self.finish::<N>(has_angles);
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn mechanics<N: Number, const CHECKED: bool>(&mut self, inputs: &[&Column; Input::COUNT], form: Form) {
        let Tile { outputs, directions, forces, critical, possible } = self;
        mechanics::<N, CHECKED>(form, inputs, directions, outputs, forces, critical, possible);
    }

    /// Computes magnitudes, ratios and angles from components.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn finish<N: Number>(&mut self, has_angles: bool) {
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
                outputs[of][row] = Xy { x: N::new(outputs[x][row]), y: N::new(outputs[y][row]) }.length().get();
            }
            if has_angles {
                angles::<N>(right, ahead, &mut outputs[Output::PrincipalDirectionOfForce(side).index()]);
            }
        }
    }
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn sines<N: Number>(angle: &Column, sin: &mut Column, cos: &mut Column) {
    if circular::are_within(angle, circular::LARGEST_ANGLE) {
        for row in 0..ROWS {
            let (y, x) = N::new(angle[row]).sin_and_cos();
            (sin[row], cos[row]) = (y.get(), x.get());
        }
    } else {
        for row in 0..ROWS {
            (sin[row], cos[row]) = circular::sin_cos(angle[row]);
        }
    }
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn angles<N: Number>(right: &Column, ahead: &Column, angle: &mut Column) {
    if circular::are_within(right, circular::LARGEST_COORDINATE) && circular::are_within(ahead, circular::LARGEST_COORDINATE) {
        for row in 0..ROWS {
            angle[row] = ForceDirection { ahead: N::new(ahead[row]), right: N::new(right[row]) }.direction().get();
        }
    } else {
        for row in 0..ROWS {
            angle[row] = ForceDirection { ahead: ahead[row], right: right[row] }.direction();
        }
    }
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn mechanics<N: Number, const CHECKED: bool>(
    form: Form,
    inputs: &[&Column; Input::COUNT],
    directions: &[[Column; 2]; 3],
    outputs: &mut [Column; Output::COUNT],
    forces: &mut [[Column; 2]; 2],
    critical: &mut [Column; 2],
    possible: &mut [u64; ROWS],
) {
    for row in 0..ROWS {
        let direction = |of: usize| (N::new(directions[of][0][row]), N::new(directions[of][1][row]));
        let heading = |of| {
            let (cos, sin) = direction(of);
            Heading { cos, sin }
        };
        let (cos, sin) = direction(2);
        let number = |input: Input| N::new(inputs[input.index()][row]);
        let collision = form.collision().given([heading(0), heading(1)], CrushPlane { cos, sin }, number);
        let contact = collision.contact();
        let impact = collision.impact_at(&contact);
        macro_rules! outputs {
            ($($output:expr),* $(,)?) => {
                $(outputs[$output.index()][row] = $output.of(&collision, &impact).get();)*
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
        (forces[0][0][row], forces[0][1][row]) = (one.right.get(), one.ahead.get());
        (forces[1][0][row], forces[1][1][row]) = (two.right.get(), two.ahead.get());
        (critical[0][row], critical[1][row]) = (impact.critical_impulse.n.get(), impact.critical_impulse.t.get());
        if CHECKED {
            possible[row] = u64::from(collision.is_possible(&contact, &impact));
        }
    }
}
