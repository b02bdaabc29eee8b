//! Rows side by side in lanes, and a question about their derivatives.
//!
//! A derivative has several times the operations of its output, and more numbers than there are registers: a loop over the rows of a tile would not become one
//! over vectors. In lanes each operation is one, whatever surrounds it.

use alloc::boxed::Box;
use alloc::vec::Vec;
use core::ops::Range;

use super::derivative::Question;
use super::form::{Form, MomentForm};
use super::instructions::{Instructions, Vectors};
use super::tile::{Column, NOTHING, ROWS};
use crate::frame::{CrushPlane, Heading};
use crate::input::{Input, Side};
use crate::output::Outputs;
use crate::scalar::lanes::Lanes;
use crate::sensitivity::Sensitive;

/// Number of rows: four have the table of all derivatives in the first cache.
pub(super) const WIDTH: usize = 4;

const _: () = assert!(ROWS.is_multiple_of(WIDTH), "a tile has a whole number of blocks");

type Row = Lanes<WIDTH>;

/// Rows of one form.
pub(super) struct Block<'q, Q> {
    question: &'q Q,
    form: Form,
    inputs: [Row; Input::COUNT],
    /// The numbers of the question.
    given: Vec<Row>,
    table: Box<Outputs<Sensitive<Row>>>,
    to: Vec<Row>,
    place: usize,
    /// The answers of a tile.
    pub(super) answers: Vec<Column>,
    /// Zero where every number of an answer is finite, and otherwise not a number.
    finite: Column,
}

impl<'q, Q: Question> Block<'q, Q> {
    pub(super) fn asking(question: &'q Q) -> Self {
        Block {
            question,
            form: Form::default(),
            inputs: [Row::default(); Input::COUNT],
            given: question.given().iter().map(|_| Row::default()).collect(),
            table: Box::default(),
            to: (0..question.numbers()).map(|_| Row::default()).collect(),
            place: 0,
            answers: (0..question.numbers()).map(|_| NOTHING).collect(),
            finite: NOTHING,
        }
    }

    /// Answers for some rows of one form, which fill a tile.
    pub(super) fn answer(&mut self, instructions: Instructions, form: Form, inputs: &[&Column; Input::COUNT], rows: Range<usize>) {
        if self.to.is_empty() {
            return;
        }
        self.form = form;
        for place in (0..rows.len()).step_by(WIDTH) {
            self.gather(inputs, place, &rows);
            instructions.run(self);
        }
    }

    /// Returns `true` if every number of the answer at a place is finite.
    pub(super) fn is_finite(&self, place: usize) -> bool {
        self.finite[place] == 0.0
    }

    /// Returns `true` if every number of the answers of the tile is finite.
    pub(super) fn are_finite(&self) -> bool {
        self.finite.iter().fold(true, |all, finite| all & (*finite == 0.0))
    }

    /// Takes the rows at a place; the lanes that remain have the numbers of the last row.
    fn gather(&mut self, inputs: &[&Column; Input::COUNT], place: usize, rows: &Range<usize>) {
        self.place = place;
        for (lanes, column) in self.inputs.iter_mut().zip(inputs) {
            *lanes = Row::new(core::array::from_fn(|lane| column[place + lane]));
        }
        for (lanes, numbers) in self.given.iter_mut().zip(self.question.given()) {
            *lanes = Row::new(core::array::from_fn(|lane| numbers.at((rows.start + place + lane).min(rows.end - 1))));
        }
    }
}

impl<Q: Question> Vectors for Block<'_, Q> {
    #[inline(always)]
    fn compute(&mut self) {
        let number = |input: Input| self.inputs[input.index()];
        let heading = |side| Heading::from_angle(number(Input::Heading(side)));
        let directions = [heading(Side::One), heading(Side::Two)];
        // Said once more, so that nothing is compiled for moments, which stand alone.
        let form = Form { moment: MomentForm::None, ..self.form };
        let collision = form.collision().given(directions, CrushPlane::from_angle(number(Input::CrushPlane)), number);
        let impact = collision.evaluate();
        self.question.answer(&collision, &impact, &self.given, &mut self.table, &mut self.to);
        let mut nothing = Row::default();
        for (lanes, column) in self.to.iter().zip(&mut self.answers) {
            column[self.place..self.place + WIDTH].copy_from_slice(lanes.as_array());
            // Zero times a number is zero unless the number is not finite.
            nothing = nothing + *lanes * Row::default();
        }
        self.finite[self.place..self.place + WIDTH].copy_from_slice(nothing.as_array());
    }
}
