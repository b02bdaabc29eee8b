//! Many collisions at once, column by column, with the vector instructions of the machine.
//!
//! A [`Batch`] has a collision, whose numbers hold for every row, and a column for each input that differs from row to row. It is [evaluated](Batch::evaluate)
//! without a check or [solved](Batch::solve) with the verdict of [`Collision::solve`] on each row. Each row has the bits of that collision by itself, whatever
//! the machine, its instructions, and the place of the row.
//!
//! ```
//! use planar_impact::batch::Batch;
//! use planar_impact::*;
//!
//! let car: Vehicle = Vehicle::new(1500.0, 2500.0).with_impact_center(2.0, 0.3);
//! let collision = Collision::new(car, Party::Barrier).with_restitution(0.1);
//! let speeds: Vec<f64> = (-1..1000).map(f64::from).collect();
//! let batch = Batch::of(collision).with(Input::VelocityX(Side::One), &speeds)?;
//! let answer = batch.solve(&[Output::Loss, Output::NormalWork]);
//!
//! // A car that moves away, or does not move, does not collide.
//! let codes = answer.refused.iter().map(|refused| (refused.row, refused.refusals.iter().next().map(Refusal::code)));
//! assert!(codes.eq([(0, Some("separating")), (1, Some("not-closing"))]));
//! assert!(answer.columns[Output::Loss][0].is_nan());
//! assert_eq!(answer.columns[Output::Loss][16], batch.row(16).solve()?.loss()); // 15 m/s
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Speed
//!
//! Rows are computed in tiles that stay in the first cache, by loops without a branch. Rows of different [`Form`] in one tile cost a pass each; a row with a
//! moment impulse, and one that is refused, costs as much as by itself.

mod columns;
mod derivative;
mod form;
mod instructions;
mod lanes;
mod row;
mod tile;

use alloc::boxed::Box;
use alloc::vec;
use alloc::vec::Vec;
use core::fmt;
use core::marker::PhantomData;
use core::ops::Range;

pub use columns::Columns;
pub use derivative::{Derivatives, Numbers};
pub use form::{Form, MomentForm, RatioForm};
pub use instructions::Instructions;
#[cfg(feature = "simulation")]
pub(crate) use instructions::Vectors;

use self::derivative::Question;
use self::lanes::Asking;
use self::row::{Fused, Row};
use self::tile::{ANGLES, Asked, Column, ROWS, Tile};
use crate::collision::Collision;
use crate::input::Input;
use crate::output::{Output, Outputs};
use crate::refusal::{Refusal, Refusals};

/// Collisions in rows.
#[derive(Clone, Debug)]
pub struct Batch<'a> {
    /// The numbers and the form of rows without a column.
    common: [f64; Input::COUNT],
    form: Form,
    columns: [Option<&'a [f64]>; Input::COUNT],
    forms: Option<&'a [Form]>,
    rows: Option<usize>,
    instructions: Instructions,
    is_fast: bool,
}

/// A column whose length is not that of the others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct UnequalColumn {
    /// The input, or `None` for the column of forms.
    pub of: Option<Input>,
    /// Its length.
    pub rows: usize,
    /// The length of the others.
    pub wanted: usize,
}

/// A row that is refused.
#[derive(Clone, Debug, PartialEq)]
pub struct Refused {
    /// The row, counted from 0.
    pub row: usize,
    /// Every reason, as [`Collision::solve`] has them.
    pub refusals: Refusals,
}

/// The answer of [`Batch::solve`].
#[derive(Clone, Debug, PartialEq)]
pub struct Solved {
    /// The outputs; NaN in every row that is refused.
    pub columns: Columns,
    /// The rows that are refused, in order.
    pub refused: Vec<Refused>,
}

impl fmt::Display for UnequalColumn {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.of {
            Some(input) => write!(f, "the column {input} has {} rows, and the others {}", self.rows, self.wanted),
            None => write!(f, "the column of forms has {} rows, and the others {}", self.rows, self.wanted),
        }
    }
}

impl core::error::Error for UnequalColumn {}

impl<'a> Batch<'a> {
    /// Creates a batch whose rows have the numbers and the form of a collision, except in the columns that follow. Without a column it has one row.
    #[must_use]
    pub fn of(collision: Collision) -> Self {
        Batch {
            common: collision.to_inputs(),
            form: Form::of(&collision),
            columns: [None; Input::COUNT],
            forms: None,
            rows: None,
            instructions: Instructions::best(),
            is_fast: false,
        }
    }

    /// Returns the same batch with a column for an input, angles in rad. A column for an input that a row does not have, such as the mass of a barrier, is not
    /// read there.
    ///
    /// # Errors
    ///
    /// [`UnequalColumn`] if the batch has another number of rows.
    pub fn with(mut self, input: Input, column: &'a [f64]) -> Result<Self, UnequalColumn> {
        self.rows = Some(self.equal(Some(input), column.len())?);
        self.columns[input.index()] = Some(column);
        Ok(self)
    }

    /// Returns the same batch with a form for each row.
    ///
    /// # Errors
    ///
    /// [`UnequalColumn`] if the batch has another number of rows.
    pub fn with_forms(mut self, forms: &'a [Form]) -> Result<Self, UnequalColumn> {
        self.rows = Some(self.equal(None, forms.len())?);
        self.forms = Some(forms);
        Ok(self)
    }

    /// Returns the same batch, to be computed with some vector instructions in place of the best: for comparing them. The bits are the same.
    #[must_use]
    pub fn on(self, instructions: Instructions) -> Self {
        Batch { instructions, ..self }
    }

    /// Returns the same batch, to be computed with fused multiplication and addition where the machine has it: faster, and with other last bits than
    /// [`Collision::solve`], which differ between machines. A row that it refuses is solved by itself, for the same refusals; one within rounding of a refusal may
    /// be accepted. Derivatives keep their bits.
    ///
    /// ```
    /// use planar_impact::batch::Batch;
    /// use planar_impact::*;
    /// let car: Vehicle = Vehicle::new(1500.0, 2500.0).with_impact_center(2.0, 0.3).with_speed(15.0);
    /// let batch = Batch::of(Collision::new(car, Party::Barrier).with_restitution(0.1));
    /// let [exact, fast] = [&batch, &batch.clone().fast()].map(|batch| batch.evaluate(&[Output::Loss])[Output::Loss][0]);
    /// assert!((fast / exact - 1.0).abs() < 1e-14);
    /// ```
    #[must_use]
    pub fn fast(self) -> Self {
        Batch { is_fast: true, ..self }
    }

    /// Returns the same batch with a number of rows, should it have no column.
    #[cfg(feature = "simulation")]
    pub(crate) fn with_rows(self, rows: usize) -> Self {
        Batch { rows: Some(rows), ..self }
    }

    fn equal(&self, of: Option<Input>, rows: usize) -> Result<usize, UnequalColumn> {
        match self.rows {
            Some(wanted) if wanted != rows => Err(UnequalColumn { of, rows, wanted }),
            _ => Ok(rows),
        }
    }

    /// Returns the number of rows.
    pub fn rows(&self) -> usize {
        self.rows.unwrap_or(1)
    }

    /// Returns some of the rows, to be computed apart, for instance on another thread.
    ///
    /// # Panics
    ///
    /// If the range goes beyond the rows.
    #[must_use]
    pub fn slice(&self, rows: Range<usize>) -> Self {
        assert!(rows.end <= self.rows(), "rows {rows:?} of {}", self.rows());
        let columns = self.columns.map(|column| column.map(|column| &column[rows.clone()]));
        let forms = self.forms.map(|forms| &forms[rows.clone()]);
        Batch { columns, forms, rows: Some(rows.len()), ..self.clone() }
    }

    /// Returns the collision of a row: [`Collision::with_inputs`] of its numbers, in its form.
    ///
    /// # Panics
    ///
    /// If there is no such row.
    pub fn row(&self, row: usize) -> Collision {
        assert!(row < self.rows(), "row {row} of {}", self.rows());
        let number = |input: Input| self.columns[input.index()].map_or(self.common[input.index()], |column| column[row]);
        self.form(row).collision().with_inputs(Input::ALL.map(number))
    }

    fn form(&self, row: usize) -> Form {
        self.forms.map_or(self.form, |forms| forms[row])
    }

    /// Returns `true` if a row has one of the [forms of its tile](Self::forms_of), of which there is one without a column.
    fn has_form(&self, row: usize, form: Form) -> bool {
        self.forms.is_none_or(|forms| forms[row] == form)
    }

    /// Computes outputs of every row as [`Collision::evaluate`] does, whether or not its impact is possible.
    #[must_use]
    pub fn evaluate(&self, of: &[Output]) -> Columns {
        self.compute(of, false).columns
    }

    /// Computes outputs of every row that [`Collision::solve`] accepts, and says why it refuses the others.
    #[must_use]
    pub fn solve(&self, of: &[Output]) -> Solved {
        self.compute(of, true)
    }

    fn compute(&self, of: &[Output], is_checked: bool) -> Solved {
        let (columns, _, refused) = self.ask(of, is_checked, &derivative::Nothing);
        Solved { columns, refused }
    }

    /// Computes outputs of every row, and the numbers of a question about its derivatives.
    fn ask<Q: Question>(&self, of: &[Output], is_checked: bool, question: &Q) -> (Columns, Vec<Vec<f64>>, Vec<Refused>) {
        let mut answer = Answer::of(of, self.rows());
        let mut tile = Box::new(Tile::new());
        let mut copies = Box::new(self.common.map(|common| [common; ROWS]));
        let mut asking = Asking::of(question, self.rows());
        let mut is_turned = [true; ANGLES.len()];
        let has_angles = of.iter().any(|output| matches!(output, Output::PrincipalDirectionOfForce(_)));
        for start in (0..self.rows()).step_by(ROWS) {
            let rows = start..(start + ROWS).min(self.rows());
            let inputs = self.inputs(&mut copies, rows.clone());
            for form in self.forms_of(rows.clone()) {
                if form.is_in_tiles() {
                    let asked =
                        Asked { tile: &mut tile, inputs: &inputs, form, is_turned, is_checked, has_angles, scalar: PhantomData::<Row> };
                    if self.is_fast && self.instructions.are_fused() {
                        self.instructions.run(&mut asked.on::<Fused>());
                    } else {
                        self.instructions.run(&mut { asked });
                    }
                    is_turned = ANGLES.map(|angle| self.columns[angle.index()].is_some());
                    asking.answer(self.instructions, form, &inputs, rows.clone(), |row| self.has_form(row, form));
                    answer.take(&tile, rows.clone(), |row| self.has_form(row, form));
                }
                // Where every row of the tile has its answer there is nothing to look for.
                if form.is_in_tiles() && self.forms.is_none() && !(is_checked && tile.has_impossible()) && asking.are_finite() {
                    continue;
                }
                for (place, row) in rows.clone().enumerate().filter(|(_, row)| self.has_form(*row, form)) {
                    let is_done = form.is_in_tiles() && !(is_checked && tile.possible[place] == 0) && asking.is_finite(place);
                    if !is_done {
                        let alone = alone(&self.row(row), row, is_checked, question);
                        asking.put(row, alone.as_ref().ok().map(|(_, numbers)| &numbers[..]));
                        answer.put(row, alone);
                    }
                }
            }
        }
        answer.refused.sort_by_key(|refused| refused.row);
        (Columns::new(of, answer.outputs), asking.into_columns(), answer.refused)
    }

    /// Returns the numbers of a tile: rows of the columns, where they fill it, or else copies of them, with those of the last row in the places that remain.
    fn inputs<'c>(&'c self, copies: &'c mut [Column; Input::COUNT], rows: Range<usize>) -> [&'c Column; Input::COUNT] {
        if rows.len() < ROWS {
            for (to, column) in copies.iter_mut().zip(&self.columns) {
                let Some(column) = column else { continue };
                let (given, rest) = to.split_at_mut(rows.len());
                given.copy_from_slice(&column[rows.clone()]);
                rest.fill(column[rows.end - 1]);
            }
        }
        let copies = &*copies;
        let of_column = |column: &'c [f64]| <&Column>::try_from(&column[rows.clone()]).ok();
        core::array::from_fn(|i| self.columns[i].and_then(of_column).unwrap_or(&copies[i]))
    }

    /// Returns the forms of some rows, each once.
    fn forms_of(&self, rows: Range<usize>) -> Vec<Form> {
        let Some(forms) = self.forms else { return vec![self.form] };
        let mut found: Vec<Form> = Vec::with_capacity(1);
        for form in &forms[rows] {
            if !found.contains(form) {
                found.push(*form);
            }
        }
        found
    }
}

/// The answer of a batch, as far as it is known.
struct Answer<'a> {
    of: &'a [Output],
    outputs: Vec<Vec<f64>>,
    refused: Vec<Refused>,
}

/// The outputs of one row with the numbers of a question, or why it is refused.
type Alone = Result<(Outputs, Vec<f64>), Refusals>;

/// Computes a row by itself.
fn alone<Q: Question>(collision: &Collision, row: usize, is_checked: bool, question: &Q) -> Alone {
    let impact = if is_checked { collision.solve()? } else { collision.evaluate() };
    let given: Vec<f64> = question.given().iter().map(|numbers| numbers.at(row)).collect();
    let mut numbers = Vec::with_capacity(question.numbers());
    question.answer(collision, &impact, &given, &mut numbers);
    if numbers.iter().all(|number| number.is_finite()) {
        Ok((Outputs::of(collision, &impact), numbers))
    } else {
        Err(Refusal::OutOfFloatRange.into())
    }
}

impl<'a> Answer<'a> {
    fn of(of: &'a [Output], rows: usize) -> Self {
        Answer { of, outputs: of.iter().map(|_| Vec::with_capacity(rows)).collect(), refused: Vec::new() }
    }

    /// Takes some rows from a tile.
    fn take(&mut self, tile: &Tile, rows: Range<usize>, is_taken: impl Fn(usize) -> bool) {
        for (output, to) in self.of.iter().zip(&mut self.outputs) {
            let from = &tile.outputs[output.index()];
            // Rows of other forms follow in their places.
            if to.len() == rows.start {
                to.extend_from_slice(&from[..rows.len()]);
                continue;
            }
            to.resize(rows.end, f64::NAN);
            let rows = rows.clone().zip(from).zip(&mut to[rows.clone()]);
            rows.filter(|((row, _), _)| is_taken(*row)).for_each(|((_, from), to)| *to = *from);
        }
    }

    fn put(&mut self, row: usize, alone: Alone) {
        for (output, column) in self.of.iter().zip(&mut self.outputs) {
            column.resize(column.len().max(row + 1), f64::NAN);
            column[row] = alone.as_ref().map_or(f64::NAN, |(outputs, _)| outputs[*output]);
        }
        self.refused.extend(alone.err().map(|refusals| Refused { row, refusals }));
    }
}
