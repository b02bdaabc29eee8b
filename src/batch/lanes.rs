//! Rows side by side in lanes, and a question about their derivatives.
//!
//! A derivative has several times the operations of its output, and more numbers than there are registers: a loop over the rows of a tile would not become one
//! over vectors. In lanes each operation is one, whatever surrounds it.

use alloc::vec::Vec;
use core::ops::Range;

use super::derivative::{Answers, Question};
use super::form::{Form, MomentForm};
use super::instructions::{Instructions, Vectors};
use super::tile::{Column, ROWS};
use crate::frame::{CrushPlane, Heading};
use crate::input::{Input, Side};
use crate::scalar::lanes::Lanes;

/// Number of rows.
const WIDTH: usize = 4;

const _: () = assert!(ROWS.is_multiple_of(WIDTH), "a tile has a whole number of blocks");

type Block = Lanes<WIDTH>;

/// A question, and the answers so far.
pub(super) struct Asking<'q, Q: Question> {
    question: &'q Q,
    /// A column for each number.
    answers: Vec<Vec<f64>>,
    /// Zero where every number of the answer to a row of the tile is finite.
    infinite: [u64; ROWS],
}

impl<'q, Q: Question> Asking<'q, Q> {
    /// Asks a question about a number of rows.
    pub(super) fn of(question: &'q Q, rows: usize) -> Self {
        Asking { question, answers: (0..question.numbers()).map(|_| Vec::with_capacity(rows)).collect(), infinite: [0; ROWS] }
    }

    /// Answers for some rows of one form, which fill a tile.
    pub(super) fn answer(
        &mut self,
        instructions: Instructions,
        form: Form,
        inputs: &[&Column; Input::COUNT],
        rows: Range<usize>,
        has_form: impl Fn(usize) -> bool,
    ) {
        let Some(first) = self.answers.first() else { return };
        let given = self.question.given().iter().map(|_| Block::default()).collect();
        // Where the rows are the next of every column, whatever another form has there is written over later.
        let are_next = first.len() == rows.start;
        let kept = core::array::from_fn(|place| place < rows.len() && has_form(rows.start + place));
        self.infinite = [0; ROWS];
        // Four lanes fill the vectors of AVX2; with those of AVX-512 the same takes longer.
        let instructions = if instructions == Instructions::Avx512 { Instructions::Avx2 } else { instructions };
        instructions.run(&mut Tiled { asking: self, form, inputs, given, rows, kept, are_next });
    }

    /// Returns `true` if every number of the answer at a place of the tile is finite.
    pub(super) fn is_finite(&self, place: usize) -> bool {
        self.infinite[place] == 0
    }

    /// Returns `true` if every number of the answers of the tile is finite.
    pub(super) fn are_finite(&self) -> bool {
        self.infinite.iter().fold(0, |all, infinite| all | infinite) == 0
    }

    /// Puts down the answer of one row; none is known if it is refused.
    pub(super) fn put(&mut self, row: usize, answer: Option<&[f64]>) {
        for (i, column) in self.answers.iter_mut().enumerate() {
            column.resize(column.len().max(row + 1), f64::NAN);
            column[row] = answer.map_or(f64::NAN, |answer| answer[i]);
        }
    }

    /// Returns a column for each number.
    pub(super) fn into_columns(self) -> Vec<Vec<f64>> {
        self.answers
    }
}

/// The rows of a tile that a question is asked about.
struct Tiled<'a, 'q, Q: Question> {
    asking: &'a mut Asking<'q, Q>,
    form: Form,
    inputs: &'a [&'a Column; Input::COUNT],
    given: Vec<Block>,
    rows: Range<usize>,
    /// Whether the answer to each row is kept: it is one, and has the form.
    kept: [bool; ROWS],
    /// Whether every column ends where the rows begin.
    are_next: bool,
}

impl<Q: Question> Vectors for Tiled<'_, '_, Q> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn compute(&mut self) {
        for place in (0..self.rows.len()).step_by(WIDTH) {
            self.answer(place);
        }
    }
}

impl<Q: Question> Tiled<'_, '_, Q> {
    /// Answers for the rows at a place; the lanes that remain have the numbers of the last row.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn answer(&mut self, place: usize) {
        let Asking { question, answers, infinite } = &mut *self.asking;
        let mut inputs = [Block::default(); Input::COUNT];
        for (lanes, column) in inputs.iter_mut().zip(self.inputs) {
            *lanes = Block::of(&column[place..place + WIDTH]);
        }
        for (lanes, numbers) in self.given.iter_mut().zip(question.given()) {
            *lanes = Block::new(core::array::from_fn(|lane| numbers.at((self.rows.start + place + lane).min(self.rows.end - 1))));
        }
        let heading = |side| Heading::from_angle(inputs[Input::Heading(side).index()]);
        let directions = [heading(Side::One), heading(Side::Two)];
        // Said once more, so that nothing is compiled for moments, which stand alone.
        let form = Form { moment: MomentForm::None, ..self.form };
        let plane = CrushPlane::from_angle(inputs[Input::CrushPlane.index()]);
        let collision = form.collision().given(directions, plane, |input| inputs[input.index()]);
        let mut to = InColumns {
            columns: answers.iter_mut(),
            row: self.rows.start + place,
            next: if self.are_next { (self.rows.len() - place).min(WIDTH) } else { 0 },
            kept: &self.kept[place..place + WIDTH],
            infinite: [0; WIDTH],
        };
        question.answer(&collision, &collision.evaluate(), &self.given, &mut to);
        infinite[place..place + WIDTH].copy_from_slice(&to.infinite);
    }
}

/// Rows of a number in one column after the other.
struct InColumns<'a> {
    columns: core::slice::IterMut<'a, Vec<f64>>,
    row: usize,
    /// How many are the next of their column.
    next: usize,
    /// Whether the answer to each row is kept.
    kept: &'a [bool],
    infinite: [u64; WIDTH],
}

impl Answers<Block> for InColumns<'_> {
    #[expect(clippy::eq_op, reason = "a number less itself is zero unless it is not finite")]
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn put<const N: usize>(&mut self, numbers: &[Block; N], places: &[usize]) {
        let mut infinite = [0; WIDTH];
        for (place, column) in places.iter().zip(&mut self.columns) {
            let numbers = numbers[*place].as_array();
            for lane in 0..WIDTH {
                infinite[lane] |= (numbers[lane] - numbers[lane]).to_bits();
            }
            match self.next {
                WIDTH => column.extend_from_slice(numbers),
                0 => put_some(column, numbers, self.row, self.kept),
                next => column.extend_from_slice(&numbers[..next]),
            }
        }
        for (all, here) in self.infinite.iter_mut().zip(infinite) {
            *all |= here;
        }
    }
}

/// Puts down those rows of a number that are kept.
#[cold]
#[inline(never)]
fn put_some(column: &mut Vec<f64>, numbers: &[f64; WIDTH], row: usize, kept: &[bool]) {
    for (lane, number) in numbers.iter().enumerate().filter(|(lane, _)| kept[*lane]) {
        column.resize(column.len().max(row + lane + 1), f64::NAN);
        column[row + lane] = *number;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_that_are_not_kept_stay_as_they_were() {
        let mut column = alloc::vec![7.0; 9];
        put_some(&mut column, &[1.0, 2.0, 3.0, 4.0], 8, &[false, false, true, false]);
        assert_eq!((column.len(), &column[..9], column[10]), (11, &[7.0; 9][..], 3.0));
        assert!(column[9].is_nan());
        put_some(&mut column, &[1.0, 2.0, 3.0, 4.0], 8, &[true, true, false, false]);
        assert_eq!(column[8..], [1.0, 2.0, 3.0]);
    }
}
