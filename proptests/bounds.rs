//! Guaranteed bounds over a box: no accepted point has a value beyond them, and the attained values are as near as they say.

use crate::strategies::{Draw, OrReject, draw, fewer};
use planar_impact::uncertainty::{Bounds, Direct, Mapping, NoBounds, RefusedPart, Search, bounds};
use planar_impact::*;
use proptest::prelude::*;
use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::atomic::{AtomicU64, Ordering};

use Side::{One, Two};

/// Position A of the paper, in feet and slugs (`validation/data/geometry.csv`).
fn side_impact() -> Collision {
    let motion = |x, y| Motion { velocity: Xy { x, y }, yaw_rate: 0.0 };
    let sedan = Vehicle {
        mass: 2564.0 / 32.2,
        yaw_inertia: 1434.9,
        heading: Heading::from_angle(PI),
        impact_center: ForwardLeft { forward: 6.3499, left: 0.0 },
        motion: motion(-40.0, 0.0),
    };
    let pickup = Vehicle {
        mass: 6345.0 / 32.2,
        yaw_inertia: 5192.4,
        heading: Heading::from_angle(FRAC_PI_2),
        impact_center: ForwardLeft { forward: 7.96804, left: -3.2356 },
        motion: motion(0.0, 40.0),
    };
    Collision::new(sedan, pickup)
}

fn into_barrier() -> Collision {
    Collision::new(Vehicle::new(1500.0, 2500.0).with_impact_center(2.0, 0.3).with_speed(15.0), Party::Barrier).with_restitution(0.1)
}

fn search(gap: f64, cells: usize) -> Search {
    Search { gap, cells }
}

fn of(base: &Collision, mapping: &impl Mapping, ranges: &[(f64, f64)], output: Output, search: Search) -> Result<Bounds, NoBounds> {
    bounds(base, mapping, ranges, output, &search, &|_| true)
}

/// Returns the value of an output where physics accepts the collision, an angle of force within a half turn of another one.
fn value(base: &Collision, mapping: &impl Mapping, point: &[f64], output: Output, near: f64) -> Option<f64> {
    let collision = mapping.apply::<f64>(base, point);
    let value = output.of(&collision, &collision.solve().ok()?);
    let is_direction = matches!(output, Output::PrincipalDirectionOfForce(_));
    Some(if is_direction { value - 2.0 * PI * ((value - near) / (2.0 * PI)).round() } else { value })
}

/// Checks everything that bounds claim, at these points too. Returns the least and the greatest value there.
fn check(
    base: &Collision,
    mapping: &impl Mapping,
    ranges: &[(f64, f64)],
    output: Output,
    search: Search,
    found: &Bounds,
    points: impl Iterator<Item = Vec<f64>>,
) -> Result<(f64, f64), TestCaseError> {
    let Bounds { low, high, low_attained, high_attained, .. } = *found;
    let scale = low_attained.abs().max(high_attained.abs());
    let rounding = 2e-9 * scale.max(1.0);
    prop_assert!(low <= low_attained && low_attained <= high_attained && high_attained <= high, "{found:?} of {output}");
    for (at, attained) in [(&found.at_low, low_attained), (&found.at_high, high_attained)] {
        let there = value(base, mapping, at, output, attained).or_reject("nothing")?;
        prop_assert!((there - attained).abs() <= rounding, "{there}, not {attained}, of {output}");
        prop_assert!(at.iter().zip(ranges).all(|(x, range)| range.0 <= *x && *x <= range.1));
    }
    if found.is_tight {
        let gap = search.gap * scale + rounding;
        prop_assert!(low_attained - low <= gap && high - high_attained <= gap, "{found:?} of {output} is not tight");
    }
    let (mut least, mut greatest) = (f64::INFINITY, f64::NEG_INFINITY);
    for point in points {
        let Some(value) = value(base, mapping, &point, output, 0.5 * low + 0.5 * high) else {
            prop_assert_eq!(found.refused, RefusedPart::Some);
            continue;
        };
        prop_assert!(low - rounding <= value && value <= high + rounding, "{value} at {point:?} is not in {low} to {high}: {output}");
        (least, greatest) = (least.min(value), greatest.max(value));
    }
    Ok((least, greatest))
}

/// Returns the points of a grid.
fn grid(ranges: &[(f64, f64)], steps: u32) -> impl Iterator<Item = Vec<f64>> {
    let axis = move |&(low, high): &(f64, f64)| (0..=steps).map(move |i| low + (high - low) * f64::from(i) / f64::from(steps)).collect();
    let axes: Vec<Vec<f64>> = ranges.iter().map(axis).collect();
    let count = axes.iter().map(Vec::len).product::<usize>();
    (0..count).map(move |mut number| {
        let mut place = |axis: &Vec<f64>| {
            let x = axis[number % axis.len()];
            number /= axis.len();
            x
        };
        axes.iter().map(&mut place).collect()
    })
}

/// Computes bounds, checks them, and compares them with a grid whose extremes are as near as its step allows.
fn on_a_grid(base: &Collision, inputs: &[Input], ranges: &[(f64, f64)], output: Output, gap: f64, near: f64) -> Bounds {
    let mapping = Direct(inputs.to_vec());
    let search = search(gap, 100_000);
    let found = of(base, &mapping, ranges, output, search).expect("some are accepted");
    let steps = if inputs.len() == 1 { 5_000 } else { 100 };
    let (least, greatest) = check(base, &mapping, ranges, output, search, &found, grid(ranges, steps)).expect("the bounds hold");
    let scale = least.abs().max(greatest.abs());
    assert!(least - found.low <= near * scale && found.high - greatest <= near * scale, "{output}: {found:?}, {least} to {greatest}");
    found
}

const DEGREE: f64 = PI / 180.0;

#[test]
fn bounds_of_a_side_impact_are_those_of_a_dense_grid() {
    let (inputs, ranges) = ([Input::CrushPlane, Input::Restitution], [(-10.0 * DEGREE, 10.0 * DEGREE), (0.0, 0.3)]);
    for output in [Output::NormalWork, Output::TangentialWork, Output::NormalImpulse, Output::CriticalImpulseRatio] {
        let found = on_a_grid(&side_impact(), &inputs, &ranges, output, 1e-12, 1e-3);
        assert!(found.is_tight && found.refused == RefusedPart::None && found.cells < 1_000, "{output}: {found:?}");
    }
    // At e = 0 none depends on Γ: a whole line of extremes, which takes second derivatives.
    for output in [Output::DeltaVMagnitude(One), Output::DeltaVMagnitude(Two), Output::PrincipalDirectionOfForce(One)] {
        let found = on_a_grid(&side_impact(), &inputs, &ranges, output, 1e-9, 1e-3);
        assert!(found.is_tight && found.cells < 2_000, "{output}: {found:?}");
    }
    // Neither does the slope of the loss by e.
    let found = on_a_grid(&side_impact(), &inputs, &ranges, Output::Loss, 1e-9, 1e-3);
    assert!(found.is_tight, "{found:?}");
}

#[test]
fn a_monotone_output_is_bounded_at_the_ends() {
    let found = on_a_grid(&into_barrier(), &[Input::VelocityX(One)], &[(10.0, 20.0)], Output::DeltaVMagnitude(One), 1e-12, 1e-9);
    assert!(found.is_tight && found.at_low == [10.0] && found.at_high == [20.0]);
}

#[test]
fn an_extreme_between_the_ends_is_found() {
    let found = on_a_grid(&side_impact().with_restitution(0.3), &[Input::CrushPlane], &[(-1.0, 1.0)], Output::Loss, 1e-12, 1e-6);
    assert!(found.is_tight && -0.99 < found.at_low[0] && found.at_low[0] < 0.99, "{found:?}");
}

#[test]
fn beyond_the_limit_of_friction_nothing_changes() {
    let collision = side_impact().with_impulse_ratio(ImpulseRatio::LimitedByFriction(0.5));
    for output in [Output::TangentialImpulse, Output::NormalImpulse, Output::Loss] {
        let found = on_a_grid(&collision, &[Input::ImpulseRatio], &[(0.1, 1.2)], output, 1e-9, 1e-3);
        assert!(found.is_tight && found.refused == RefusedPart::None, "{output}: {found:?}");
        on_a_grid(&collision, &[Input::ImpulseRatio, Input::CrushPlane], &[(0.3, 0.9), (-0.1, 0.1)], output, 1e-4, 1e-2);
    }
}

#[test]
fn the_refused_half_of_a_box_does_not_count() {
    let output = Output::NormalSeparation;
    let found = on_a_grid(&into_barrier(), &[Input::VelocityX(One)], &[(-10.0, 10.0)], output, 1e-9, 1e-3);
    assert!(found.refused == RefusedPart::Some && found.at_high[0] > 0.0 && (found.high - 1.0).abs() < 1e-8, "{found:?}");
    let mapping = Direct(vec![Input::VelocityX(One)]);
    let refused = of(&into_barrier(), &mapping, &[(-10.0, -5.0)], output, Search::default()).expect_err("they separate");
    let Collision { one, .. } = into_barrier();
    let middle = Collision { one: one.vehicle().expect("a vehicle").with_velocity(Xy { x: -7.5, y: 0.0 }).into(), ..into_barrier() };
    let reasons = middle.solve().expect_err("they separate");
    assert!(matches!(&refused, NoBounds::Refused { at_the_middle: Some(found) } if **found == reasons), "{refused}, not {reasons}");
}

/// The restitution falls towards the edge of what physics accepts, along which it has its least value in between.
struct Edge;

impl Mapping for Edge {
    fn numbers(&self) -> usize {
        2
    }

    fn inputs(&self) -> &[Input] {
        &[Input::VelocityX(One), Input::Restitution]
    }

    fn write<T: Real + Copy + From<f64>>(&self, numbers: &[T], inputs: &mut [T]) {
        let [a, b] = [numbers[0], numbers[1]];
        inputs[0] = a + b;
        inputs[1] = T::from(0.5) + T::from(0.1) * (a + b + b + T::from(0.8) * b * b);
    }
}

#[test]
fn an_output_that_falls_towards_refused_points_is_least_on_their_edge() {
    let car = Vehicle::new(1500.0, 2500.0).with_impact_center(2.0, 0.0);
    let base = Collision::new(car, Party::Barrier);
    let (ranges, search) = ([(-1.0, 1.3), (-1.0, 1.0)], search(1e-3, 4_000));
    let found = of(&base, &Edge, &ranges, Output::Restitution, search).expect("half of it is accepted");
    let (least, _) = check(&base, &Edge, &ranges, Output::Restitution, search, &found, grid(&ranges, 400)).expect("the bounds hold");
    assert!(found.low <= 0.468_75 && found.low > 0.46 && least < 0.472 && found.refused == RefusedPart::Some, "{found:?}, {least}");
}

#[test]
fn an_angle_is_bounded_across_its_cut() {
    // Struck from behind: from −π + 0.1 over π to π − 0.1.
    let car = Vehicle::new(1500.0, 2500.0).with_impact_center(-2.0, 0.0).with_speed(-15.0);
    let base = Collision::new(car, Party::Barrier);
    let output = Output::PrincipalDirectionOfForce(One);
    let found = on_a_grid(&base, &[Input::CrushPlane, Input::VelocityY(One)], &[(-0.1, 0.1), (-2.0, 2.0)], output, 1e-6, 1e-2);
    assert!(
        found.is_tight && found.high - found.low < 1.0 && found.low < PI && PI < found.high || found.low < -PI && -PI < found.high,
        "{found:?}"
    );
}

#[test]
fn a_range_may_be_a_number_or_nearly_everything() {
    let (base, output) = (into_barrier(), Output::DeltaVMagnitude(One));
    let mapping = Direct(vec![Input::VelocityX(One), Input::Mass(One)]);
    let found = of(&base, &mapping, &[(15.0, 15.0), (1500.0, 1500.0)], output, search(1e-12, 10)).expect("accepted");
    assert!(found.is_tight && found.cells == 0 && found.high - found.low < 1e-12, "{found:?}");
    for ranges in [[(1e-300, 1e300), (1e-300, 1e300)], [(-1e308, 1e308), (1.0, 2.0)], [(-f64::MAX, f64::MAX), (-f64::MAX, f64::MAX)]] {
        if let Ok(found) = of(&base, &mapping, &ranges, output, search(1e-9, 200)) {
            check(&base, &mapping, &ranges, output, search(1e-9, 200), &found, grid(&ranges, 20)).expect("the bounds hold");
        }
    }
    let nothing = of(&base, &Direct(vec![]), &[], output, Search::default()).expect("accepted");
    assert!(nothing.is_tight && nothing.at_low.is_empty());
    // A barrier has neither a change of velocity nor a direction.
    for output in [Output::DeltaVMagnitude(Two), Output::PrincipalDirectionOfForce(Two), Output::YawRate(Two)] {
        let found = of(&base, &mapping, &[(10.0, 20.0), (1000.0, 2000.0)], output, Search::default()).expect("accepted");
        assert!(found.is_tight && found.low_attained == 0.0 && found.high_attained == 0.0, "{output}: {found:?}");
    }
}

#[test]
fn ranges_that_are_none_are_refused() {
    let mapping = Direct(vec![Input::VelocityX(One)]);
    let refused = |ranges: &[(f64, f64)]| of(&into_barrier(), &mapping, ranges, Output::Loss, Search::default()).expect_err("no range");
    for range in [(f64::NAN, 1.0), (1.0, f64::NAN), (2.0, 1.0), (f64::NEG_INFINITY, 1.0), (1.0, f64::INFINITY)] {
        assert!(matches!(refused(&[range]), NoBounds::Range { place: 0, .. }), "{range:?}");
    }
    assert_eq!(refused(&[]).to_string(), "0 ranges for 1 uncertain numbers; give one for each");
    let missing = of(&into_barrier(), &Direct(vec![Input::Mass(Two)]), &[(1.0, 2.0)], Output::Loss, Search::default());
    assert_eq!(missing, Err(NoBounds::NoSuchInput(NoSuchInput(Input::Mass(Two)))));
}

#[test]
fn any_budget_has_bounds_and_a_search_can_be_stopped() {
    let (inputs, ranges) = (Direct(vec![Input::CrushPlane, Input::Restitution]), [(-0.2, 0.2), (0.0, 0.3)]);
    let output = Output::Loss;
    let mut widest = f64::INFINITY;
    for cells in [0, 1, 2, 30, 1_000] {
        let search = search(1e-12, cells);
        let found = of(&side_impact(), &inputs, &ranges, output, search).expect("accepted");
        check(&side_impact(), &inputs, &ranges, output, search, &found, grid(&ranges, 20)).expect("the bounds hold");
        assert!(found.cells <= cells && !found.is_tight && found.high - found.low <= widest, "{found:?}");
        widest = found.high - found.low;
    }
    for gap in [f64::NAN, -1.0] {
        assert!(!of(&side_impact(), &inputs, &ranges, output, search(gap, 10)).expect("accepted").is_tight);
    }
    let called = AtomicU64::new(0);
    let stop = |_| {
        called.fetch_add(1, Ordering::Relaxed);
        false
    };
    let found = bounds(&side_impact(), &inputs, &ranges, output, &search(1e-12, 100_000), &stop).expect("accepted");
    assert!(!found.is_tight && found.cells < 1_000 && called.into_inner() <= 2, "{found:?}");
}

/// Uncertain inputs, each with its reach down and up.
type Reaches = Vec<(Input, f64, f64)>;

/// Generates some inputs of a collision, each within a range about its value, and points of the box.
fn boxes() -> impl Strategy<Value = (Draw, Output, Reaches, Vec<Vec<f64>>)> {
    let reach = || prop_oneof![Just(0.0), 0.0..0.02, 0.0..0.5];
    let input = (prop::sample::select(Input::ALL.to_vec()), reach(), reach());
    let point = prop::collection::vec(prop_oneof![Just(0.0), Just(1.0), 0.0..=1.0], 4);
    (
        draw().prop_map(Draw::closing),
        prop::sample::select(Output::ALL.to_vec()),
        prop::collection::vec(input, 1..=4),
        prop::collection::vec(point, 20),
    )
}

proptest! {
    #![proptest_config(fewer(10))]

    #[test]
    fn no_accepted_point_is_out_of_bounds((draw, output, uncertain, shares) in boxes()) {
        let base = draw.of::<f64>();
        let mut uncertain: Vec<_> = uncertain.into_iter().filter(|(input, ..)| base.input(*input).is_some()).collect();
        uncertain.sort_by_key(|(input, ..)| input.index());
        uncertain.dedup_by_key(|(input, ..)| input.index());
        let mapping = Direct(uncertain.iter().map(|(input, ..)| *input).collect());
        let ranges: Vec<_> = uncertain.iter().map(|(input, down, up)| {
            let x = base.input(*input).expect("it has it");
            (x - down * (1.0 + x.abs()), x + up * (1.0 + x.abs()))
        }).collect();
        let search = search(1e-6, 60);
        let points = || shares.iter().map(|shares| ranges.iter().zip(shares).map(|(&(low, high), share)| (low + (high - low) * share).clamp(low, high)).collect::<Vec<_>>());
        match of(&base, &mapping, &ranges, output, search) {
            Ok(found) => {
                check(&base, &mapping, &ranges, output, search, &found, points())?;
            }
            Err(NoBounds::Refused { .. }) => {
                for point in points() {
                    prop_assert_eq!(value(&base, &mapping, &point, output, 0.0), None, "{:?} is accepted", point);
                }
            }
            Err(NoBounds::NoAcceptedPoint { .. }) => (),
            Err(other) => prop_assert!(false, "{}", other),
        }
    }
}
