//! The answer to a batch, row by row.

use planar_impact::batch::{Batch, Form, MomentForm, RatioForm};
use planar_impact::check::{Options, Record, Severity, check};
use planar_impact::{Collision, Heading, ImpulseRatio, Input, Moment, Output, Party, Refusal, Side, Vehicle, Xy};

use super::Plan;
use super::column::{Cell, Column, Table};
use super::row::{Fault, Row, RowVehicle, describe};
use super::row_warning::{self, RowWarning};
use super::watch::{self, Watch};
use crate::case::{CaseOutput, ContactInputs, Crush, CrushInputs, Inertia, Inputs, Parameter, Velocity};
use crate::derivative;
use crate::message::Message;
use crate::named::positive_zero;
use crate::notice::Notice;
use crate::{doubtful, unusual, wording};

/// The answer to some rows, in SI and radians.
#[derive(Clone, Debug, PartialEq)]
pub struct Answer {
    /// A column for each output; NaN where the row is refused.
    pub outputs: Vec<Vec<f64>>,
    /// A column for each derivative: those of the first output, then those of the next. NaN where the row is refused, where it does not have the input, and
    /// where there is no derivative.
    pub derivatives: Vec<Vec<f64>>,
    /// The rules that each row violates, joined by `;`, if the plan checks them.
    pub check: Option<Vec<Option<String>>>,
    /// The rows that are refused, in order.
    pub refused: Vec<Refused>,
    /// Sizes that no road vehicle has, and doubtful results, each warning once.
    pub warnings: Vec<RowWarning>,
}

/// A row that is refused.
#[derive(Clone, Debug, PartialEq)]
pub struct Refused {
    /// The row, counted from 0.
    pub row: usize,
    /// The codes of the reasons, joined by `;`.
    pub codes: String,
    /// The reasons.
    pub reason: Message,
    /// Whether a cell is at fault, and not the physics.
    pub is_of_input: bool,
}

impl Plan {
    /// Solves rows.
    ///
    /// # Panics
    ///
    /// If there is not a column for each [input](Self::inputs), or one has another number of rows.
    pub fn solve(&self, table: &Table<'_>) -> Answer {
        let Table { rows, columns, unreadable } = table;
        assert_eq!(columns.len(), self.inputs.len(), "a column for each input");
        assert!(columns.iter().all(|column| column.rows() == *rows), "{rows} rows in each column");
        let mut answer = Answer::with_capacity(self, *rows);
        let mut read = Rows::default();
        let mut unreadable = unreadable.iter().peekable();
        let gives_crush = self.gives_crush();
        for first in (0..*rows).step_by(ROWS) {
            let end = (first + ROWS).min(*rows);
            read.clear();
            for row in first..end {
                let mut cells = Row { keys: &self.inputs, columns, row, faults: Vec::new() };
                if let Some((_, why)) = unreadable.next_if(|(unreadable, _)| *unreadable == row) {
                    cells.faults.push(Fault::NotARow(*why));
                }
                let vehicles = [0, 1].map(|i| cells.vehicle(&self.vehicles[i], &self.defaults.vehicles[i]));
                let contact = cells.contact(&self.contact, &self.defaults);
                let crushes = if gives_crush { self.crush_of(&mut cells) } else { [None, None] };
                let mut is_unusual = false;
                if cells.faults.is_empty() {
                    let is_empty = !columns.is_empty() && columns.iter().all(|column| matches!(column.at(row), Cell::Empty));
                    let of_row = |notice| RowWarning { first: row, rows: 1, notice }.add(&mut answer.warnings);
                    let of_crush = crushes.iter().zip(&self.vehicles).zip(["vehicle.1.crush", "vehicle.2.crush"]).flat_map(
                        |((crush, columns), path)| {
                            let crush = crush.as_ref().filter(|_| !columns.crush.is_empty());
                            crush.into_iter().flat_map(move |crush| unusual::sizes_of_crush(path, crush))
                        },
                    );
                    let of_sizes = row_warning::of_sizes(&vehicles, &contact).inspect(|_| is_unusual = true);
                    of_sizes.chain(of_crush).chain(is_empty.then(row_warning::empty_row)).for_each(of_row);
                }
                read.push(&vehicles, &contact, cells.faults);
                read.is_unusual.push(is_unusual);
            }
            self.solve_read(first, columns, &mut read, &mut answer);
        }
        answer
    }

    /// Solves rows that have been read, of which the first is one of the table, and appends them to the answer.
    fn solve_read(&self, first: usize, columns: &[Column<'_>], read: &mut Rows, answer: &mut Answer) {
        let rows = read.forms.len();
        let of: Vec<Output> = self.outputs.iter().filter_map(|output| impact(*output)).collect();
        let by = needed(&self.wrt);
        let batch = if self.is_fast { read.batch().fast() } else { read.batch() };
        let (mut values, slopes, found) = if by.is_empty() {
            let solved = batch.solve(&of);
            (solved.columns.into_columns(), Vec::new(), solved.refused)
        } else {
            let solved = batch.sensitivities(&of, &by);
            (solved.values.into_columns(), solved.derivatives.into_columns(), solved.refused)
        };
        let (mut unsolved, mut without_some_derivative) = (Vec::new(), Vec::new());
        for refused in found {
            let row = refused.row;
            if read.is_refused[row] {
                continue;
            }
            // A derivative that does not exist is no reason to refuse the values, nor the others.
            match if by.is_empty() { Err(refused.refusals) } else { batch.row(row).solve() } {
                Ok(impact) => {
                    let outputs = planar_impact::Outputs::of(&batch.row(row), &impact);
                    of.iter().zip(&mut values).for_each(|(of, column)| column[row] = outputs[*of]);
                    without_some_derivative.push(row);
                }
                Err(refusals) => unsolved.push(Refused {
                    row,
                    codes: wording::codes(&refusals),
                    reason: wording::reasons(&refusals),
                    is_of_input: !refusals.iter().all(Refusal::is_physical),
                }),
            }
        }
        let check = self.is_checked.then(|| (0..rows).map(|row| violated(&batch.row(row))).collect());
        let doubts = read.doubts(&batch);
        let slopes = self.derivatives(read, &of, &Slopes { by: &by, columns: slopes });
        let mut part = self.arrange(values, slopes, check, rows);
        for row in without_some_derivative {
            let inputs = self.case(columns, first + row);
            self.differentiate(&inputs, |output| impact(output).is_some(), row, &mut part);
        }
        unsolved.into_iter().for_each(|refused| read.refuse(refused));
        if self.has_crush() {
            self.add_crush(&mut part, first, columns, read);
        }
        for (row, notice) in doubts.into_iter().filter(|(row, _)| !read.is_refused[*row]) {
            RowWarning { first: row, rows: 1, notice }.add(&mut part.warnings);
        }
        part.blank(&read.is_refused);
        read.refused.sort_by_key(|refused| refused.row);
        part.refused.extend(read.refused.drain(..).map(|refused| Refused { row: first + refused.row, ..refused }));
        part.warnings.iter_mut().for_each(|warning| warning.first += first);
        answer.append(part);
    }

    fn crush_of(&self, cells: &mut Row<'_>) -> [Option<CrushInputs>; 2] {
        [0, 1].map(|i| self.crush[i].as_ref().map(|crush| cells.crush(&self.vehicles[i], crush)))
    }

    /// Returns `true` if a column gives a part of the crush.
    fn gives_crush(&self) -> bool {
        self.vehicles.iter().any(|vehicle| !vehicle.crush.is_empty())
    }

    fn has_crush(&self) -> bool {
        self.crush.iter().any(Option::is_some)
    }

    /// Puts the columns of the impact at their places among the outputs.
    fn arrange(&self, values: Vec<Vec<f64>>, derivatives: Vec<Vec<f64>>, check: Option<Vec<Option<String>>>, rows: usize) -> Answer {
        let nothing = || vec![f64::NAN; rows];
        let (mut values, mut derivatives) = (values.into_iter(), derivatives.into_iter());
        let mut answer = Answer { outputs: Vec::new(), derivatives: Vec::new(), check, refused: Vec::new(), warnings: Vec::new() };
        for output in &self.outputs {
            let is_of_impact = impact(*output).is_some();
            answer.outputs.push(if is_of_impact { values.next().unwrap_or_else(nothing) } else { nothing() });
            for _ in &self.wrt {
                answer.derivatives.push(if is_of_impact { derivatives.next().unwrap_or_else(nothing) } else { nothing() });
            }
        }
        answer
    }

    /// Computes the derivatives of outputs of the impact by the parameters, from those by the inputs of the library.
    fn derivatives(&self, read: &Rows, of: &[Output], slopes: &Slopes<'_>) -> Vec<Vec<f64>> {
        let mut columns = vec![vec![f64::NAN; read.forms.len()]; of.len() * self.wrt.len()];
        for (row, form) in read.forms.iter().enumerate() {
            for (k, parameter) in self.wrt.iter().enumerate() {
                let Some(terms) = read.terms(*parameter, row, *form) else { continue };
                for i in 0..of.len() {
                    let slope: f64 = terms.iter().map(|(input, factor)| slopes.get(i, *input, row) * factor).sum();
                    columns[i * self.wrt.len() + k][row] = if slope.is_finite() { slope } else { f64::NAN };
                }
            }
        }
        columns
    }

    /// Computes what follows from the crush, case by case.
    fn add_crush(&self, answer: &mut Answer, first: usize, columns: &[Column<'_>], read: &mut Rows) {
        // Where no column gives the crush it is that of the case, whatever the speed of a row.
        let gives_crush = self.gives_crush();
        for row in 0..read.is_refused.len() {
            if read.is_refused[row] {
                continue;
            }
            let inputs = self.case(columns, first + row);
            let setup = inputs.as_given();
            if let Some(reason) = setup.crush.iter().flatten().find_map(Crush::unfit) {
                read.refuse(Refused { row, codes: "no-crush".to_owned(), reason: reason.into(), is_of_input: true });
                continue;
            }
            let outputs = setup.evaluate();
            let [one, two] = Side::ALL.map(|side| outputs.get(CaseOutput::CrushEnergy(side)).unwrap_or(0.0));
            let of_row = |notice| RowWarning { first: row, rows: 1, notice }.add(&mut answer.warnings);
            let before = outputs.get(CaseOutput::Impact(Output::EnergyBefore)).filter(|_| gives_crush);
            before.and_then(|before| doubtful::crush(one + two, before)).into_iter().for_each(of_row);
            for (i, output) in self.outputs.iter().enumerate().filter(|(_, output)| impact(**output).is_none()) {
                answer.outputs[i][row] = outputs.get(*output).unwrap_or(f64::NAN);
            }
            self.differentiate(&inputs, |output| impact(output).is_none(), row, answer);
        }
    }

    /// Returns the numbers of the case file that a row stands for.
    fn case(&self, columns: &[Column<'_>], row: usize) -> Inputs {
        let mut cells = Row { keys: &self.inputs, columns, row, faults: Vec::new() };
        let [one, two] = self.crush_of(&mut cells);
        let mut vehicle = |i: usize, crush| Some(cells.vehicle(&self.vehicles[i], &self.defaults.vehicles[i])?.with_crush(crush));
        let vehicles = [vehicle(0, one), vehicle(1, two)];
        Inputs { vehicles, contact: cells.contact(&self.contact, &self.defaults) }
    }

    /// Differentiates outputs of one row, whose values are in the answer.
    fn differentiate(&self, inputs: &Inputs, is_asked: impl Fn(CaseOutput) -> bool, row: usize, answer: &mut Answer) {
        for (k, by) in self.wrt.iter().enumerate() {
            if inputs.value(*by).is_err() && *by != Parameter::Input(Input::ImpulseRatio) {
                continue;
            }
            let slopes = derivative::by(inputs, *by);
            for (i, output) in self.outputs.iter().enumerate().filter(|(_, output)| is_asked(**output)) {
                let slope = slopes.get(*output).map(|dual| dual.eps).filter(|slope| slope.is_finite());
                let value = answer.outputs[i][row];
                answer.derivatives[i * self.wrt.len() + k][row] = derivative::defined(*output, value, &[*by], slope);
            }
        }
    }
}

impl Answer {
    fn with_capacity(plan: &Plan, rows: usize) -> Self {
        let columns = |count: usize| (0..count).map(|_| Vec::with_capacity(rows)).collect();
        let check = plan.is_checked.then(|| Vec::with_capacity(rows));
        Answer {
            outputs: columns(plan.outputs.len()),
            derivatives: columns(plan.outputs.len() * plan.wrt.len()),
            check,
            refused: Vec::new(),
            warnings: Vec::new(),
        }
    }

    /// Adds rows that follow those it has.
    fn append(&mut self, later: Answer) {
        let numbers = self.outputs.iter_mut().chain(&mut self.derivatives).zip(later.outputs.iter().chain(&later.derivatives));
        numbers.for_each(|(column, later)| column.extend(later.iter().map(|number| positive_zero(*number))));
        self.check.iter_mut().zip(later.check).for_each(|(column, later)| column.extend(later));
        self.refused.extend(later.refused);
        later.warnings.into_iter().for_each(|warning| warning.add(&mut self.warnings));
    }

    /// Leaves no number in a row that is refused.
    fn blank(&mut self, is_refused: &[bool]) {
        for column in self.outputs.iter_mut().chain(&mut self.derivatives) {
            column.iter_mut().zip(is_refused).filter(|(_, is_refused)| **is_refused).for_each(|(value, _)| *value = f64::NAN);
        }
        if let Some(check) = &mut self.check {
            check.iter_mut().zip(is_refused).filter(|(_, is_refused)| **is_refused).for_each(|(rules, _)| *rules = None);
        }
    }
}

fn impact(output: CaseOutput) -> Option<Output> {
    match output {
        CaseOutput::Impact(output) => Some(output),
        _ => None,
    }
}

/// Returns the inputs of the library that derivatives by these parameters follow from.
fn needed(wrt: &[Parameter]) -> Vec<Input> {
    let mut all = Vec::new();
    let mut add = |input: Input| {
        if !all.contains(&input) {
            all.push(input)
        }
    };
    for parameter in wrt {
        match *parameter {
            Parameter::Input(Input::Mass(side)) => [Input::Mass(side), Input::YawInertia(side)].into_iter().for_each(&mut add),
            Parameter::Input(Input::Heading(side)) => {
                [Input::Heading(side), Input::VelocityX(side), Input::VelocityY(side)].into_iter().for_each(&mut add);
            }
            Parameter::Input(input) => add(input),
            Parameter::Speed(side) => [Input::VelocityX(side), Input::VelocityY(side)].into_iter().for_each(&mut add),
            Parameter::RadiusOfGyration(side) => add(Input::YawInertia(side)),
            Parameter::Friction | Parameter::RatioOfCritical => add(Input::ImpulseRatio),
            Parameter::MomentOfCritical => add(Input::Moment),
            // Nothing of the impact depends on crush and skids, and no row has a restitution over the closing speed.
            Parameter::RestitutionScatter | Parameter::Crush(..) | Parameter::Skid(..) | Parameter::RestFriction => (),
        }
    }
    all
}

/// Derivatives of outputs of the impact by inputs of the library.
struct Slopes<'a> {
    by: &'a [Input],
    columns: Vec<Vec<f64>>,
}

impl Slopes<'_> {
    fn get(&self, of: usize, by: Input, row: usize) -> f64 {
        self.by.iter().position(|input| *input == by).map_or(f64::NAN, |k| self.columns[of * self.by.len() + k][row])
    }
}

/// Rows that are read and solved together: few enough that they stay in the second cache.
const ROWS: usize = 2048;

/// Rows that have been read.
#[derive(Default)]
struct Rows {
    columns: [Vec<f64>; Input::COUNT],
    forms: Vec<Form>,
    /// What a derivative holds, for each vehicle: its speed or radius of gyration where it has one.
    speeds: [Vec<f64>; 2],
    radii: [Vec<f64>; 2],
    is_refused: Vec<bool>,
    is_unusual: Vec<bool>,
    refused: Vec<Refused>,
}

impl Rows {
    /// Forgets every row, and keeps the memory.
    fn clear(&mut self) {
        let Rows { columns, forms, speeds, radii, is_refused, is_unusual, refused } = self;
        columns.iter_mut().chain(speeds).chain(radii).for_each(Vec::clear);
        forms.clear();
        is_refused.clear();
        is_unusual.clear();
        refused.clear();
    }

    fn push(&mut self, vehicles: &[Option<RowVehicle>; 2], contact: &ContactInputs, faults: Vec<Fault>) {
        let mut set = |input: Input, number: f64| self.columns[input.index()].push(number);
        for (i, (side, vehicle)) in Side::ALL.into_iter().zip(vehicles).enumerate() {
            let of = |number: fn(&RowVehicle) -> f64| vehicle.as_ref().map_or(f64::NAN, number);
            set(Input::Mass(side), of(|vehicle| vehicle.mass));
            set(Input::YawInertia(side), of(|vehicle| vehicle.inertia.of(vehicle.mass)));
            set(Input::Heading(side), of(|vehicle| vehicle.heading));
            set(Input::YawRate(side), of(|vehicle| vehicle.yaw_rate));
            set(Input::ImpactCenterForward(side), of(|vehicle| vehicle.impact_center.forward));
            set(Input::ImpactCenterLeft(side), of(|vehicle| vehicle.impact_center.left));
            let velocity = vehicle.map_or(Xy { x: f64::NAN, y: f64::NAN }, |vehicle| vehicle.velocity.on_ground(vehicle.heading));
            set(Input::VelocityX(side), velocity.x);
            set(Input::VelocityY(side), velocity.y);
            self.speeds[i].push(of(|vehicle| match vehicle.velocity {
                Velocity::Speed(speed) => speed,
                Velocity::Components(_) => f64::NAN,
            }));
            self.radii[i].push(of(|vehicle| match vehicle.inertia {
                Inertia::Radius(radius) => radius,
                Inertia::Yaw(_) => f64::NAN,
            }));
        }
        set(Input::CrushPlane, contact.crush_plane);
        set(Input::Restitution, contact.restitution.given().unwrap_or(f64::NAN));
        let (ratio, number) = match contact.impulse_ratio {
            ImpulseRatio::Critical => (RatioForm::Critical, 0.0),
            ImpulseRatio::Given(ratio) => (RatioForm::Given, ratio),
            ImpulseRatio::OfCritical(share) => (RatioForm::OfCritical, share),
            ImpulseRatio::LimitedByFriction(friction) => (RatioForm::LimitedByFriction, friction),
        };
        set(Input::ImpulseRatio, number);
        let (moment, number) = match contact.moment {
            Moment::None => (MomentForm::None, 0.0),
            Moment::Given(moment) => (MomentForm::Given, moment),
            Moment::OfCritical(share) => (MomentForm::OfCritical, share),
        };
        set(Input::Moment, number);
        self.forms.push(Form { is_vehicle: vehicles.each_ref().map(Option::is_some), ratio, law: contact.law, moment });
        self.is_refused.push(false);
        if !faults.is_empty() {
            let (codes, reason) = describe(&faults);
            self.refuse(Refused { row: self.forms.len() - 1, codes, reason, is_of_input: true });
        }
    }

    fn refuse(&mut self, refused: Refused) {
        self.is_refused[refused.row] = true;
        self.refused.push(refused);
    }

    /// Returns the warnings about the results of rows, which have been solved.
    fn doubts(&self, batch: &Batch<'_>) -> Vec<(usize, Notice)> {
        let watch = Watch::of(batch, &self.columns, &self.forms);
        let of_row = |row: usize| {
            let is_doubted = self.is_unusual[row] || watch.may_be_doubtful(row);
            let of_result = if is_doubted { watch::of_result(&batch.row(row), self.is_unusual[row]) } else { Vec::new() };
            of_result.into_iter().map(move |notice| (row, notice))
        };
        (0..self.forms.len()).filter(|row| !self.is_refused[*row]).flat_map(of_row).collect()
    }

    fn batch(&self) -> Batch<'_> {
        let any = Collision::new(Vehicle::default(), Party::Barrier);
        let batch = Input::ALL.into_iter().try_fold(Batch::of(any), |batch, input| batch.with(input, &self.columns[input.index()]));
        match batch.and_then(|batch| batch.with_forms(&self.forms)) {
            Ok(batch) => batch,
            Err(unequal) => panic!("every row has every number: {unequal}"),
        }
    }

    /// Returns the derivatives by inputs of the library, each with its factor, whose sum is that by a parameter; `None` if the row does not have it.
    fn terms(&self, parameter: Parameter, row: usize, form: Form) -> Option<Vec<(Input, f64)>> {
        let number = |input: Input| self.columns[input.index()][row];
        if parameter.side().is_some_and(|side| !form.is_vehicle[side as usize]) {
            return None;
        }
        let given = |is_given: bool, input: Input| is_given.then(|| vec![(input, 1.0)]);
        match parameter {
            Parameter::Input(Input::Mass(side)) => {
                let radius = self.radii[side as usize][row];
                let by_inertia = (!radius.is_nan()).then_some((Input::YawInertia(side), radius * radius));
                Some([(Input::Mass(side), 1.0)].into_iter().chain(by_inertia).collect())
            }
            Parameter::RadiusOfGyration(side) => {
                let radius = self.radii[side as usize][row];
                (!radius.is_nan()).then(|| vec![(Input::YawInertia(side), 2.0 * number(Input::Mass(side)) * radius)])
            }
            Parameter::Input(Input::Heading(side)) => {
                let along = Heading::from_angle(number(Input::Heading(side)));
                let speed = self.speeds[side as usize][row];
                let turning = [(Input::VelocityX(side), -speed * along.sin), (Input::VelocityY(side), speed * along.cos)];
                let turning = turning.into_iter().filter(|_| !speed.is_nan());
                Some([(Input::Heading(side), 1.0)].into_iter().chain(turning).collect())
            }
            Parameter::Speed(side) => {
                let along = Heading::from_angle(number(Input::Heading(side)));
                Some(vec![(Input::VelocityX(side), along.cos), (Input::VelocityY(side), along.sin)])
            }
            // Where a row does not give the ratio, nothing depends on the one that follows.
            Parameter::Input(Input::ImpulseRatio) if form.ratio != RatioForm::Given => Some(Vec::new()),
            Parameter::RatioOfCritical => given(form.ratio == RatioForm::OfCritical, Input::ImpulseRatio),
            Parameter::Friction => given(form.ratio == RatioForm::LimitedByFriction, Input::ImpulseRatio),
            Parameter::Input(Input::Moment) => given(form.moment == MomentForm::Given, Input::Moment),
            Parameter::MomentOfCritical => given(form.moment == MomentForm::OfCritical, Input::Moment),
            Parameter::Input(input) => given(true, input),
            Parameter::RestitutionScatter => None,
            Parameter::Crush(..) | Parameter::Skid(..) | Parameter::RestFriction => Some(Vec::new()),
        }
    }
}

/// Returns the names of the laws that the result of a collision violates; `None` if it violates none, or has no result.
fn violated(collision: &Collision) -> Option<String> {
    let impact = collision.solve().ok()?;
    let outcome = check(&Record::of(collision, &impact), &Options::default());
    let failed: Vec<&str> =
        outcome.findings.iter().filter(|found| found.severity == Severity::Fail).map(|found| found.rule.name()).collect();
    (!failed.is_empty()).then(|| failed.join(";"))
}
