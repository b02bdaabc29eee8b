//! A batch is the collisions of its rows: the same bits, the same verdicts.

use std::collections::BTreeMap;

use crate::strategies::bits;
use num_dual::Dual64;
use planar_impact::batch::{Batch, Derivatives, Form, Instructions, MomentForm, Numbers, RatioForm, Solved, UnequalColumn};
use planar_impact::*;
use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

const ROWS: usize = 1_000_000;

/// Numbers that no input should have.
const ODD: [f64; 10] = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 0.0, -0.0, -1.0, 1e300, 1e-300, 5e-324, 3e5];

struct Rows {
    columns: Vec<Vec<f64>>,
    forms: Vec<Form>,
}

/// Draws rows that mostly collide, some of which have an odd number. Rows of one form mostly stand together.
fn draw(rows: usize) -> Rows {
    let mut random = ChaCha8Rng::seed_from_u64(14);
    let mut found = Rows { columns: vec![Vec::new(); Input::COUNT], forms: Vec::new() };
    let mut form = Form::default();
    for _ in 0..rows {
        if random.random_ratio(1, 100) {
            form = any_form(&mut random);
        }
        let facing = random.random_range(-3.0..3.0);
        for input in Input::ALL {
            let number =
                if random.random_ratio(1, 400) { ODD[random.random_range(0..ODD.len())] } else { number(input, facing, form, &mut random) };
            found.columns[input.index()].push(number);
        }
        found.forms.push(if random.random_ratio(1, 300) { any_form(&mut random) } else { form });
    }
    found
}

fn any_form(random: &mut impl Rng) -> Form {
    let ratios = [RatioForm::Critical, RatioForm::Given, RatioForm::OfCritical, RatioForm::LimitedByFriction];
    let moments = [MomentForm::None, MomentForm::None, MomentForm::None, MomentForm::Given, MomentForm::OfCritical];
    let parties = [[true, true], [true, true], [true, true], [true, false], [false, true], [false, false]];
    Form {
        is_vehicle: parties[random.random_range(0..parties.len())],
        ratio: ratios[random.random_range(0..ratios.len())],
        law: if random.random() { Law::Brach } else { Law::KudlichSlibar },
        moment: moments[random.random_range(0..moments.len())],
    }
}

/// Draws an input of two vehicles that drive towards each other along a direction, most of the time.
fn number(input: Input, facing: f64, form: Form, random: &mut impl Rng) -> f64 {
    let towards = |side| if side == Side::One { 1.0 } else { -1.0 };
    match input {
        Input::Mass(_) => random.random_range(800.0..20e3),
        Input::YawInertia(_) => random.random_range(800.0..40e3),
        Input::Heading(side) => facing + if side == Side::One { 0.0 } else { std::f64::consts::PI } + random.random_range(-0.8..0.8),
        Input::ImpactCenterForward(_) => random.random_range(0.5..2.5),
        Input::ImpactCenterLeft(_) => random.random_range(-0.9..0.9),
        Input::VelocityX(side) => towards(side) * random.random_range(-2.0..20.0) * facing.cos(),
        Input::VelocityY(side) => towards(side) * random.random_range(-2.0..20.0) * facing.sin(),
        Input::YawRate(_) => random.random_range(-1.0..1.0),
        Input::CrushPlane => facing + random.random_range(-0.7..0.7),
        Input::Restitution => random.random_range(-0.02..1.02_f64),
        Input::ImpulseRatio if form.ratio == RatioForm::Given => random.random_range(-1.5..1.5),
        Input::ImpulseRatio => random.random_range(-0.05..1.1),
        Input::Moment if form.moment == MomentForm::OfCritical => random.random_range(-0.05..1.05),
        Input::Moment => random.random_range(-500.0..500.0),
    }
}

impl Rows {
    fn batch(&self) -> Batch<'_> {
        let all = Batch::of(Collision::new(Vehicle::default(), Vehicle::default())).with_forms(&self.forms).expect("as many rows");
        Input::ALL.into_iter().fold(all, |batch, input| batch.with(input, &self.columns[input.index()]).expect("as many rows"))
    }
}

/// On all vector instructions of the machine, whatever stands beside a row.
#[test]
fn every_row_is_the_collision_by_itself() {
    let rows = draw(ROWS);
    let batch = rows.batch();
    let alone: Vec<Collision> = (0..ROWS).map(|row| batch.row(row)).collect();
    let mut codes = BTreeMap::<String, usize>::new();
    let mut forms = BTreeMap::<String, usize>::new();
    let verdicts: Vec<Result<Impact, Refusals>> = alone.iter().map(Collision::solve).collect();
    for (verdict, form) in verdicts.iter().zip(&rows.forms) {
        match verdict {
            Ok(_) => *forms.entry(format!("{form:?}")).or_default() += 1,
            Err(refusals) => refusals.iter().for_each(|refusal| *codes.entry(refusal.code().to_owned()).or_default() += 1),
        }
    }
    // Nothing is left out: of the 96 forms the 24 of two barriers are refused.
    assert_eq!(forms.len(), 96 - 24, "{forms:#?}");
    assert!(forms.values().all(|count| *count >= 300) && forms.values().sum::<usize>() > ROWS / 5, "{forms:#?}");
    for code in [
        "not-finite",
        "not-positive",
        "out-of-range",
        "nothing-moves",
        "separating",
        "tensile",
        "wedging",
        "beyond-critical",
        "energy-gain",
    ] {
        assert!(codes.get(code).is_some_and(|count| *count >= 500), "{code}: {codes:#?}");
    }
    for set in Instructions::available() {
        let solved = batch.clone().on(set).solve(&Output::ALL);
        let evaluated = batch.clone().on(set).evaluate(&Output::ALL);
        let mut refused = solved.refused.iter();
        for (row, (collision, verdict)) in alone.iter().zip(&verdicts).enumerate() {
            let impact = collision.evaluate();
            let outputs = Outputs::of(collision, &impact);
            if let Err(refusals) = verdict {
                let next = refused.next().expect("it is refused");
                assert_eq!((next.row, format!("{:?}", next.refusals)), (row, format!("{refusals:?}")), "{set:?}");
            } else {
                assert_eq!(verdict.as_ref().map(|impact| impact.impulse), Ok(impact.impulse));
            }
            for output in Output::ALL {
                assert_eq!(bits(evaluated[output][row]), bits(outputs[output]), "{output} of row {row} on {set:?}");
                let wanted = if verdict.is_ok() { outputs[output] } else { f64::NAN };
                assert_eq!(bits(solved.columns[output][row]), bits(wanted), "{output} of row {row} on {set:?}");
            }
        }
        assert_eq!(refused.next(), None);
    }
}

/// Only the last bits of a fast batch differ; the verdicts are the same but within rounding of a limit.
#[test]
fn a_fast_batch_differs_by_rounding() {
    let rows = draw(60_000);
    let batch = rows.batch();
    let exact = batch.solve(&Output::ALL);
    for set in Instructions::available() {
        let fast = batch.clone().on(set).fast().solve(&Output::ALL);
        let verdicts = |solved: &Solved| solved.refused.iter().map(|refused| (refused.row, format!("{:?}", refused.refusals))).collect();
        let [one, other]: [BTreeMap<usize, String>; 2] = [verdicts(&exact), verdicts(&fast)];
        let doubtful =
            one.iter().filter(|(row, refusals)| other.get(row) != Some(refusals)).count() + other.len() - one.len().min(other.len());
        assert!(doubtful <= 3 && one.len() > 20_000, "{doubtful} of {}", one.len());
        let mut differ = 0;
        for (output, column) in fast.columns.iter() {
            let pairs = column.iter().zip(&exact.columns[output]).filter(|(fast, exact)| fast.is_finite() && exact.is_finite());
            let mut errors: Vec<f64> = pairs.map(|(fast, exact)| (fast - exact).abs() / exact.abs().max(1e-3)).collect();
            errors.sort_by(f64::total_cmp);
            differ += errors.iter().filter(|error| **error > 0.0).count();
            assert!(errors[errors.len() / 2] < 1e-15 && errors[errors.len() * 999 / 1000] < 1e-10, "{output} on {set:?}");
        }
        assert_eq!(differ > 100_000, set != Instructions::Compiled || cfg!(target_arch = "aarch64"), "{differ} on {set:?}");
    }
}

/// The place of a row, its neighbors, and what else is asked for make no difference.
#[test]
fn a_part_of_a_batch_is_that_part() {
    let rows = draw(1_000);
    let batch = rows.batch();
    let whole = batch.solve(&Output::ALL);
    for (start, end) in [(0, 1), (0, 0), (17, 17), (1, 50), (47, 49), (333, 1_000), (999, 1_000)] {
        for of in [&Output::ALL[..], &[Output::NormalWork], &[Output::PrincipalDirectionOfForce(Side::Two), Output::CriticalImpulseRatio]] {
            let part = batch.slice(start..end).solve(of);
            for (output, column) in part.columns.iter() {
                assert!(
                    column.iter().map(|x| bits(*x)).eq(whole.columns[output][start..end].iter().map(|x| bits(*x))),
                    "{output} {start}..{end}"
                );
            }
            assert_eq!(part.columns.iter().count(), of.len());
            let refused = whole.refused.iter().map(|refused| refused.row).filter(|row| (start..end).contains(row)).map(|row| row - start);
            assert!(part.refused.iter().map(|refused| refused.row).eq(refused), "{start}..{end}");
        }
    }
}

#[test]
fn numbers_without_a_column_are_those_of_the_collision() {
    let rows = draw(300);
    let car = Vehicle::new(1500.0, 2500.0).with_impact_center(2.0, 0.3).with_heading(Heading::from_angle(0.3)).with_speed(12.0);
    let other = Vehicle::new(1800.0, 3100.0).with_impact_center(1.9, -0.2).with_heading(Heading::from_angle(-2.8));
    let collision =
        Collision::new(car, other).with_crush_plane(CrushPlane::from_angle(0.1)).with_impulse_ratio(ImpulseRatio::OfCritical(0.9));
    let column = |input: Input| &rows.columns[input.index()];
    let varied = [Input::VelocityX(Side::Two), Input::Restitution];
    let batch = varied.into_iter().fold(Batch::of(collision), |batch, input| batch.with(input, column(input)).expect("as many rows"));
    let answer = batch.evaluate(&[Output::Loss, Output::YawRate(Side::Two)]);
    for row in 0..300 {
        let mut inputs = collision.to_inputs();
        varied.iter().for_each(|input| inputs[input.index()] = column(*input)[row]);
        let impact = collision.with_inputs(inputs).evaluate();
        assert_eq!(bits(answer[Output::Loss][row]), bits(impact.loss()));
        assert_eq!(bits(answer[Output::YawRate(Side::Two)][row]), bits(impact.two.after.yaw_rate));
    }
}

#[test]
fn columns_have_one_length() {
    let (two, three, forms) = ([1.0; 2], [1.0; 3], [Form::default(); 4]);
    let batch = Batch::of(Collision::default());
    assert_eq!((batch.rows(), batch.evaluate(&[Output::Loss])[Output::Loss].len()), (1, 1));
    let batch = batch.with(Input::Restitution, &two).expect("the first one");
    assert_eq!(batch.rows(), 2);
    let unequal = |error: Result<Batch<'_>, UnequalColumn>| error.map(|_| ()).expect_err("another length").to_string();
    assert_eq!(unequal(batch.clone().with(Input::CrushPlane, &three)), "the column contact.crush_plane has 3 rows, and the others 2");
    assert_eq!(unequal(batch.with_forms(&forms)), "the column of forms has 4 rows, and the others 2");
    let columns = Batch::of(Collision::default()).with(Input::Restitution, &[]).expect("none").solve(&[Output::Loss, Output::NormalWork]);
    assert_eq!((columns.refused, columns.columns.into_columns()), (vec![], vec![vec![]; 2]));
}

/// Derivatives of every row are those of the collision by itself, in every form, on all vector instructions of the machine; a row whose derivative is not
/// finite is refused.
#[test]
fn the_derivatives_of_every_row_are_those_of_the_collision_by_itself() {
    // Three more than whole vectors have.
    let rows = draw(20_003);
    let batch = rows.batch();
    let of = [Output::Loss, Output::CriticalImpulseRatio, Output::PrincipalDirectionOfForce(Side::Two), Output::YawRate(Side::One)];
    let by = [Input::CrushPlane, Input::Mass(Side::One), Input::ImpulseRatio, Input::VelocityY(Side::Two)];
    let steps: Vec<f64> = (0..rows.forms.len()).map(|row| row as f64 % 7.0 - 3.0).collect();
    let weights = [(of[0], Numbers::Same(0.5)), (of[2], Numbers::Column(&steps))];
    let direction = [(by[0], Numbers::Column(&steps)), (by[1], Numbers::Same(2.0))];
    let covariance = Covariance::new(&by[..2], &[[0.01, -0.5], [-0.5, 400.0]]).expect("a covariance");
    for set in Instructions::available() {
        let batch = batch.clone().on(set);
        let all = batch.sensitivities(&of, &by);
        let one = batch.sensitivity(of[0], &by);
        let sum = batch.pullback(&weights, &by);
        let along = batch.pushforward(&of, &direction);
        let spread = batch.variances(&of, &covariance);
        let mut answered = 0;
        for (row, step) in steps.iter().copied().enumerate() {
            let collision = batch.row(row);
            let solved = collision.solve();
            let table = solved.as_ref().ok().map(|impact| collision.sensitivities_of(impact));
            let wanted = |numbers: &dyn Fn(&Outputs<Sensitive>) -> Vec<f64>| {
                // The numbers of a row that is accepted and has finite ones.
                table.as_ref().map(numbers).filter(|numbers| numbers.iter().all(|number| number.is_finite()))
            };
            let jacobian = wanted(&|table| of.iter().flat_map(|of| by.map(|by| table[*of].by[by])).collect());
            answered += usize::from(jacobian.is_some());
            same(&all, row, jacobian, &solved);
            let impact = solved.as_ref().ok();
            same(&one, row, wanted(&|_| by.map(|by| collision.sensitivity_of(impact.expect("solved"), of[0]).by[by]).to_vec()), &solved);
            let mut weighted = Outputs::default();
            (weighted[of[0]], weighted[of[2]]) = (0.5, step);
            let pulled = collision.pullback(&weighted).ok();
            same(&sum, row, wanted(&|_| by.map(|by| pulled.as_ref().map_or(f64::NAN, |gradient| gradient[by])).to_vec()), &solved);
            let mut towards = [0.0; Input::COUNT];
            (towards[by[0].index()], towards[by[1].index()]) = (step, 2.0);
            let pushed = collision.map(Dual64::from).shifted(|input| Dual64::new(0.0, towards[input.index()]));
            let pushed = Outputs::of(&pushed, &pushed.evaluate());
            close(&along, row, wanted(&|_| of.map(|of| pushed[of].eps).to_vec()), &solved);
            same(&spread, row, wanted(&|table| of.map(|of| covariance.variance_of(&table[of].by)).to_vec()), &solved);
        }
        assert!(answered > rows.forms.len() / 5, "{answered}");
    }
}

/// Weights may be of any size. Rows that are the same are refused all, however many there are.
#[test]
fn rows_with_the_same_infinite_derivative_are_refused_all() {
    let car = Vehicle::new(1500.0, 2500.0).with_impact_center(2.0, 0.3).with_speed(12.0);
    for rows in [1, 2, 4, 8, 9] {
        let restitution = vec![0.1; rows];
        let batch = Batch::of(Collision::new(car, Party::Barrier)).with(Input::Restitution, &restitution).expect("the first one");
        let found = batch.pullback(&[(Output::Loss, Numbers::Same(1e308))], &[Input::VelocityX(Side::One)]);
        assert_eq!(found.refused.len(), rows);
        assert!(found.derivatives.iter().all(|(_, column)| column.iter().all(|x| x.is_nan())));
    }
}

type Verdict = Result<Impact, Refusals>;

/// Checks the numbers of a row, or its refusal.
fn same<K: Copy + PartialEq>(found: &Derivatives<K>, row: usize, wanted: Option<Vec<f64>>, solved: &Verdict) {
    check(found, row, wanted, solved, |found, wanted| bits(found) == bits(wanted));
}

/// Checks within the rounding of another order of operations.
fn close<K: Copy + PartialEq>(found: &Derivatives<K>, row: usize, wanted: Option<Vec<f64>>, solved: &Verdict) {
    let size = wanted.iter().flatten().fold(0.0, |size: f64, x| size.max(x.abs()));
    check(found, row, wanted, solved, |found, wanted| (found - wanted).abs() <= 1e-9 * size);
}

fn check<K: Copy + PartialEq>(
    found: &Derivatives<K>,
    row: usize,
    wanted: Option<Vec<f64>>,
    solved: &Verdict,
    agree: impl Fn(f64, f64) -> bool,
) {
    let refused = found.refused.iter().find(|refused| refused.row == row);
    match (&wanted, solved) {
        (Some(_), _) => assert_eq!(refused, None, "row {row}"),
        (None, Ok(_)) => assert_eq!(refused.map(|refused| &refused.refusals), Some(&Refusals::from(Refusal::OutOfFloatRange)), "row {row}"),
        (None, Err(refusals)) => assert_eq!(format!("{:?}", refused.map(|refused| &refused.refusals)), format!("{:?}", Some(refusals))),
    }
    for (i, (_, column)) in found.derivatives.iter().enumerate() {
        match &wanted {
            Some(wanted) => assert!(agree(column[row], wanted[i]), "row {row}: {}, {}", column[row], wanted[i]),
            None => assert!(column[row].is_nan()),
        }
    }
    assert!(found.values.iter().all(|(_, column)| column[row].is_nan() == wanted.is_none()), "row {row}");
}
