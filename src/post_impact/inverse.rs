//! The inverse problem: the separation whose slide ends in the pose at rest.

mod starts;
mod to_rest;
mod uncertainty;

use alloc::vec::Vec;

use super::evidence::{NoSeparation, RestEvidence, Separation};
use super::slide::Slide;
use crate::frame::Xy;
use crate::least_squares::{self, by_chi_square};
use crate::vehicle::Motion;
use starts::{FAR, Starts};
use to_rest::{Found, ToRest};

/// Maximum number of further starts if none of these led to a solution.
const MORE_STARTS: usize = 40;
/// Share of the work that is kept from further starts, for the best end and for twins.
const LEFT_FOR_BEST: f64 = 0.25;
/// Maximum number of integration steps in one search. Those that reach the pose mostly take a third of it, and others, beside a path that only comes near, would go on for twenty times as long.
const WORK_OF_SEARCH: usize = 10_000;
/// Significant changes of speed, in m/s, and of the yaw rate, in rad/s.
const SCALES: [f64; 3] = [1.0, 1.0, 0.3];
/// Largest distance, in these scales, of two solutions that are the same.
const SAME: f64 = 1e-4;
/// The same before the last steps of a fit to points, and the largest step of a search that is close enough for them.
const CLOSE: f64 = 0.01;
/// Sum of squares, in squares of standard deviations, at which the pose at rest is reached: a hundred-thousandth of a deviation.
const REACHED: f64 = 1e-10;
/// Largest excess of χ² over the best at which a path past given points remains an alternative: by chance it is exceeded in one case of a thousand.
const NEARLY_AS_GOOD: f64 = 10.83;

fn motion(unknowns: &[f64]) -> Motion {
    Motion { velocity: Xy { x: unknowns[0], y: unknowns[1] }, yaw_rate: unknowns[2] }
}

impl Slide {
    pub(super) fn separation_by_slide(
        &self,
        evidence: &RestEvidence,
        goes_on: &dyn Fn(usize, usize) -> bool,
    ) -> Result<Separation, NoSeparation> {
        let search = ToRest::of(self, evidence, goes_on);
        let first = self.first_guess(evidence);
        let mut found: Vec<Found> = Vec::new();
        let (mut tried, mut converged) = (0, 0);
        let has_points = !evidence.points.is_empty();
        let mut search_from = |start: [f64; 3], work: usize, found: &mut Vec<Found>| {
            tried += 1;
            if let Some(end) = search.end_of_search(&start, work) {
                converged += 1;
                keep(found, end, if has_points { CLOSE } else { SAME });
            }
        };
        let mut starts = Starts::around(first);
        for start in starts.chosen(&search) {
            if search.work_left() > LEFT_FOR_BEST {
                search_from(start, WORK_OF_SEARCH, &mut found);
            }
        }
        for _ in 0..MORE_STARTS {
            if found.is_empty() && search.work_left() > LEFT_FOR_BEST {
                search_from(starts.draw(FAR), WORK_OF_SEARCH, &mut found);
            }
        }
        // Where a vehicle rolls far, steps are many and small: the best search goes on with what work is left.
        let best = search.take_unfinished();
        if let (true, Some(best)) = (found.is_empty(), best) {
            search_from([best.unknowns[0], best.unknowns[1], best.unknowns[2]], usize::MAX, &mut found);
        }
        for start in search.twins(&found) {
            if search.work_left() > 0.0 {
                search_from(start, WORK_OF_SEARCH, &mut found);
            }
        }
        if search.is_stopped() {
            return Err(NoSeparation::Stopped);
        }
        if has_points {
            let mut refined = Vec::new();
            for one in found {
                keep(&mut refined, search.refined(one), SAME);
            }
            found = refined;
        }
        let Some(best) = best_of(&mut found, &first, has_points) else { return Err(search.nothing_found(&first)) };
        let mut separation = match search.separation(&best) {
            // A search without any way to continue stays at its start.
            Err(NoSeparation::NotDetermined { .. }) if search.miss(&best.unknowns).is_ok_and(|miss| !miss.is_nothing()) => {
                return Err(search.nothing_found(&first));
            }
            separation => separation?,
        };
        if let Some(fit) = &mut separation.fit {
            // One that the evidence does not determine is no alternative.
            fit.others = found.iter().filter_map(|other| search.separation(other).ok()).collect();
            (fit.starts, fit.converged) = (tried, converged);
        }
        Ok(separation)
    }

    pub(super) fn separation_by_slide_near(&self, evidence: &RestEvidence, known: &Motion) -> Option<Separation> {
        let search = ToRest::of(self, evidence, &|_, _| true);
        search.separation(&search.near(known)?).ok()
    }

    pub(super) fn separation_by_slide_about(&self, evidence: &RestEvidence, about: &Motion) -> Option<Separation> {
        ToRest::of(self, evidence, &|_, _| true).about(about)
    }

    /// Returns the closed form, or a rotation in proportion to the path if the tires would drive the vehicle.
    fn first_guess(&self, evidence: &RestEvidence) -> [f64; 3] {
        let Motion { velocity, yaw_rate } = self.closed_form(&evidence.separation, &evidence.rest);
        let travel = evidence.rest.position - evidence.separation.position;
        let turn = evidence.rest.heading - evidence.separation.heading;
        let velocity = if velocity.x.is_finite() && velocity.y.is_finite() { velocity } else { travel };
        let yaw_rate = if yaw_rate.is_finite() { yaw_rate } else { turn * velocity.length() / travel.length().max(1.0) };
        [velocity.x, velocity.y, yaw_rate]
    }
}

/// Keeps a result, or the earlier one if it is the same, to some distance, and better.
fn keep(found: &mut Vec<Found>, one: Found, same: f64) {
    match found.iter_mut().find(|other| distance(&other.unknowns, &one.unknowns) <= same) {
        Some(other) if one.sum_of_squares < other.sum_of_squares => *other = one,
        Some(_) => (),
        None => found.push(one),
    }
}

/// Returns the distance between two motions, in the scales.
fn distance(one: &[f64], other: &[f64]) -> f64 {
    least_squares::distance(one, other, SCALES)
}

/// Removes and returns the best result: the least sum of squares, and of several equally good ones the nearest to the first guess. Worse ones are dropped,
/// such as a slide that stops short of the pose where the search could not continue. Points along the path decide between those that remain: the others are in
/// the order of their sums.
fn best_of(found: &mut Vec<Found>, first: &[f64; 3], has_points: bool) -> Option<Found> {
    let least = found.iter().map(|one| one.sum_of_squares).reduce(f64::min)?;
    let limit = if has_points { least + NEARLY_AS_GOOD } else { (least * (1.0 + 1e-6)).max(REACHED) };
    found.retain(|one| one.sum_of_squares <= limit);
    found.sort_by(|a, b| distance(&a.unknowns, first).total_cmp(&distance(&b.unknowns, first)));
    if has_points {
        found.sort_by(|a, b| by_chi_square(a.sum_of_squares, b.sum_of_squares));
    }
    Some(found.remove(0))
}

#[cfg(test)]
mod tests {
    use core::cell::RefCell;

    use super::uncertainty::uncertainty;
    use super::*;
    use crate::post_impact::variation::{FINE, Slopes};
    use crate::post_impact::{
        Area, Ground, Method, Miss, NoRest, PathPoint, Pose, Region, Restraint, SlidingVehicle, Wheel, WheelPosition, Wheels,
    };

    fn slide(wheels: Wheels<Wheel>) -> Slide {
        let vehicle = SlidingVehicle::sedan(wheels);
        Slide { vehicle, ground: Ground::uniform(0.7) }
    }

    fn damaged() -> Wheels<Wheel> {
        Wheels {
            front_left: Wheel::LOCKED,
            front_right: Wheel::braked(0.4).steered(0.1),
            rear_left: Wheel::ROLLING,
            rear_right: Wheel { restraint: Restraint::Braked(0.2), steer: 0.0 },
        }
    }

    const MOTIONS: [[f64; 3]; 4] = [[9.0, 4.0, 2.5], [3.0, 8.0, 0.5], [15.0, 1.0, 0.0], [12.0, -3.0, -4.0]];

    fn evidence(rest: Pose) -> RestEvidence {
        RestEvidence {
            separation: FROM,
            rest,
            position_deviation: Xy { x: 0.3, y: 0.2 },
            heading_deviation: 0.09,
            friction_deviation: 0.07,
            points: Vec::new(),
        }
    }

    const FROM: Pose = Pose { position: Xy { x: 1.0, y: 2.0 }, heading: 0.3 };

    #[test]
    fn there_and_back() {
        // A vehicle whose wheels all roll freely goes far, and its rest position depends on everything: not all cases can be inverted.
        let all = [(Wheels::all(Wheel::LOCKED), 4), (damaged(), 4), (Wheels::all(Wheel::braked(0.3)), 4), (Wheels::all(Wheel::ROLLING), 2)];
        for (wheels, motions) in all {
            let slide = slide(wheels);
            for [vx, vy, yaw_rate] in &MOTIONS[..motions] {
                let motion = Motion { velocity: Xy { x: *vx, y: *vy }, yaw_rate: *yaw_rate };
                let rest = slide.to_rest(&FROM, &motion).expect("it comes to rest").pose;
                let found = slide.separation(&evidence(rest), Method::Slide).expect("a solution");
                let fit = found.fit.clone().expect("a fit");
                assert!(fit.miss.is_nothing() && fit.converged > 0, "{fit:?}");
                let all = fit.others.iter().map(|other| other.motion).chain([found.motion]);
                let nearest =
                    all.map(|one| (one.velocity - motion.velocity).length().max((one.yaw_rate - yaw_rate).abs())).fold(1e9, f64::min);
                // The less the rest position depends on the motion, the larger the effect of an error.
                let [x, y, rate] = found.covariance.deviations();
                assert!(nearest < 1e-9 * (x + y + rate).max(1.0), "{motion:?} {found:?}");
            }
        }
    }

    /// Moving the rest position or the friction by a deviation moves the separation as the covariance predicts, input by input.
    #[test]
    fn the_covariance_is_that_of_solutions_to_moved_evidence() {
        for method in [Method::Slide, Method::ClosedForm] {
            let slide = slide(damaged());
            let rest = slide.to_rest(&FROM, &motion(&MOTIONS[0])).expect("it comes to rest").pose;
            let given = RestEvidence {
                position_deviation: Xy { x: 1e-3, y: 2e-3 },
                heading_deviation: 1e-3,
                friction_deviation: 1e-3,
                ..evidence(rest)
            };
            let of = |slide: &Slide, rest: Pose| {
                let motion = slide.separation(&RestEvidence { rest, ..given.clone() }, method).expect("a solution").motion;
                motion.components()
            };
            let moved = |by: [f64; 4]| {
                let mut slide = slide.clone();
                slide.ground = slide.ground.times(1.0 + by[3]);
                let position = Xy { x: rest.position.x + by[0], y: rest.position.y + by[1] };
                of(&slide, Pose { position, heading: rest.heading + by[2] })
            };
            let mut sum = [[0.0; 3]; 3];
            let mut change = [0.0; 3];
            for (input, deviation) in [1e-3, 2e-3, 1e-3, 1e-3].into_iter().enumerate() {
                let by = |sign: f64| core::array::from_fn(|i| if i == input { sign * deviation } else { 0.0 });
                let (more, less) = (moved(by(1.0)), moved(by(-1.0)));
                change = core::array::from_fn(|i| (more[i] - less[i]) / 2.0);
                for i in 0..3 {
                    for k in 0..3 {
                        sum[i][k] += change[i] * change[k];
                    }
                }
            }
            let found = slide.separation(&given, method).expect("a solution");
            // The last input is the friction.
            let by_friction = found.by_friction.components();
            for i in 0..3 {
                assert!((by_friction[i] - change[i]).abs() < 1e-3 * sum[i][i].sqrt(), "{method:?} {i}: {by_friction:?} {change:?}");
                for k in 0..3 {
                    let scale = (sum[i][i] * sum[k][k]).sqrt();
                    assert!((found.covariance.0[i][k] - sum[i][k]).abs() < 1e-3 * scale, "{method:?} {i} {k}: {found:?} {sum:?}");
                }
            }
        }
    }

    /// What a pose says about another motion is the line there: the change of the pose along it is what the slide of that motion misses, and the covariance on it is that of
    /// the pose. About the solution it is the solution.
    #[test]
    fn about_another_motion_the_pose_is_followed_along_the_slopes_there() {
        let slide = slide(damaged());
        let at_rest = |motion: &Motion| {
            let Pose { position: Xy { x, y }, heading } = slide.to_rest(&FROM, motion).expect("it comes to rest").pose;
            [x, y, heading]
        };
        let solution = motion(&MOTIONS[0]);
        let [x, y, heading] = at_rest(&solution);
        let given = RestEvidence { friction_deviation: 0.0, ..evidence(Pose { position: Xy { x, y }, heading }) };
        let found = slide.separation_near(&given, Method::Slide, &solution).expect("a solution");
        let same = slide.separation_about(&given, Method::Slide, &found.motion).expect("it comes to rest");
        let off = same.motion.components().into_iter().zip(found.motion.components()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(off < 1e-6 && same.covariance == found.covariance, "{same:?} {found:?}");
        let about = [8.4, 4.3, 2.2];
        let said = slide.separation_about(&given, Method::Slide, &motion(&about)).expect("it comes to rest");
        let here = at_rest(&motion(&about));
        let slopes: [[f64; 3]; 3] = core::array::from_fn(|k| {
            let by = |step: f64| at_rest(&motion(&core::array::from_fn::<f64, 3, _>(|i| about[i] + if i == k { step } else { 0.0 })));
            let (more, less) = (by(1e-4), by(-1e-4));
            core::array::from_fn(|i| (more[i] - less[i]) / 2e-4)
        });
        let step: [f64; 3] = core::array::from_fn(|k| said.motion.components()[k] - about[k]);
        assert!(step.iter().all(|by| by.abs() > 0.01), "{step:?}");
        let deviations = [given.position_deviation.x, given.position_deviation.y, given.heading_deviation];
        for i in 0..3 {
            let change: f64 = (0..3).map(|k| slopes[k][i] * step[k]).sum();
            let miss = [x, y, heading][i] - here[i];
            assert!((change - miss).abs() < 1e-3 * miss.abs(), "{i}: {change} {miss}");
            let variance: f64 =
                (0..3).flat_map(|k| (0..3).map(move |l| (k, l))).map(|(k, l)| slopes[k][i] * said.covariance.0[k][l] * slopes[l][i]).sum();
            assert!((variance.sqrt() / deviations[i] - 1.0).abs() < 1e-3, "{i}: {variance}");
        }
        let never = slide.separation_about(&given, Method::Slide, &motion(&[f64::NAN, 0.0, 0.0]));
        assert_eq!(never, None);
        let closed = slide.separation_about(&given, Method::ClosedForm, &motion(&about));
        assert_eq!(closed, slide.separation(&given, Method::ClosedForm).ok());
    }

    /// Points on the path of a known motion change nothing but what is known of it; one beside it is missed, and moves the motion.
    #[test]
    fn points_on_the_path_narrow_the_separation_down() {
        let slide = slide(damaged());
        let truth = motion(&MOTIONS[0]);
        let rest = slide.to_rest(&FROM, &truth).expect("it comes to rest");
        let passed = |share: f64, wheel: Option<WheelPosition>, aside: Xy| {
            let state = &rest.path[(share * rest.path.len() as f64) as usize];
            let position = wheel.map_or(state.pose.position, |wheel| *slide.vehicle.wheel_places(&state.pose).of(wheel)) + aside;
            PathPoint { wheel, position, deviation: Xy { x: 0.1, y: 0.1 } }
        };
        let without = evidence(rest.pose);
        let of = |points| slide.separation(&RestEvidence { points, ..without.clone() }, Method::Slide).expect("a solution");
        let (alone, on_path) =
            (of(Vec::new()), of(alloc::vec![passed(0.2, Some(WheelPosition::FrontLeft), Xy::zero()), passed(0.4, None, Xy::zero())]));
        let difference = (on_path.motion.velocity - truth.velocity).length() + (on_path.motion.yaw_rate - truth.yaw_rate).abs();
        let fit = on_path.fit.expect("a fit");
        assert!(difference < 1e-4 && fit.chi_square < 1e-6 && fit.degrees_of_freedom == 2, "{difference} {fit:?}");
        let (narrow, wide) = (on_path.covariance.deviations(), alone.covariance.deviations());
        assert!((0..3).all(|i| narrow[i] <= wide[i] * (1.0 + 1e-6)) && narrow[1] < 0.9 * wide[1], "{narrow:?} {wide:?}");
        let beside = of(alloc::vec![passed(0.4, None, Xy { x: 0.0, y: 1.5 })]).fit.expect("a fit");
        assert!(beside.probability < 1e-3 && beside.points[0].standardized_residual > 1.0, "{beside:?}");
    }

    /// The derivatives of the residuals of points are difference quotients.
    #[test]
    fn residuals_of_points_have_their_slopes() {
        let slide = slide(damaged());
        let rest = slide.to_rest(&FROM, &motion(&MOTIONS[0])).expect("it comes to rest").pose;
        let at = |wheel, x, y| PathPoint { wheel, position: Xy { x, y }, deviation: Xy { x: 0.2, y: 0.1 } };
        // One is passed; the vehicle ends before the other.
        let points = alloc::vec![at(Some(WheelPosition::RearRight), 4.0, 3.0), at(None, rest.position.x + 3.0, rest.position.y + 1.0)];
        let evidence = RestEvidence { points, ..evidence(rest) };
        let search = ToRest::of(&slide, &evidence, &|_, _| true);
        let slopes = search.slopes(&MOTIONS[0], FINE);
        for k in 0..3 {
            let by = |step: f64| {
                let mut unknowns = MOTIONS[0];
                unknowns[k] += step;
                search.residuals(&unknowns).expect("it comes to rest")
            };
            let (more, less) = (by(1e-4), by(-1e-4));
            for i in 0..7 {
                let quotient = (more[i] - less[i]) / 2e-4;
                assert!((slopes[i][k] - quotient).abs() < 1e-3 * (1.0 + quotient.abs()), "{i} by {k}: {} and {quotient}", slopes[i][k]);
            }
        }
    }

    #[test]
    fn a_pose_that_the_tires_do_not_hold_is_refused() {
        let mut slide = slide(Wheels::all(Wheel::ROLLING));
        slide.ground.grade = Xy { x: 0.02, y: 0.0 };
        let end = slide.separation(&evidence(Pose { position: Xy { x: 20.0, y: 2.0 }, heading: 0.0 }), Method::Slide);
        assert_eq!(end, Err(NoSeparation::NotHeld));
        let up = slide.to_rest(&Pose::default(), &motion(&[5.0, 0.0, 0.0]));
        // By hand: 5² = 2 g (0.015 + 0.02) d.
        let Err(NoRest::RollsBack(state)) = up else { panic!("{up:?}") };
        assert!((state.pose.position.x - 25.0 / (2.0 * 9.80665 * 0.035)).abs() < 0.01, "{state:?}");
    }

    #[test]
    fn a_pose_out_of_reach_says_by_how_much() {
        // Straight ahead without brakes and without resistance: such a vehicle stops only if it slides sideways.
        let mut slide = slide(Wheels::all(Wheel::ROLLING));
        slide.vehicle.tires.rolling_resistance = 0.0;
        let end = slide.separation(&evidence(Pose { position: Xy { x: 20.0, y: 2.0 }, heading: 0.3 }), Method::Slide);
        let Err(NoSeparation::NotConverged { miss, .. }) = end else { panic!("{end:?}") };
        assert!(!miss.is_nothing(), "{miss:?}");
    }

    /// Ice from 3 m on: the first guess, which is to go further, does not stop; a slower vehicle does.
    #[test]
    fn what_some_motions_reach_is_not_said_to_have_no_rest() {
        let mut slide = slide(Wheels::all(Wheel::LOCKED));
        let ice = Area::HalfPlane { from: Xy { x: 3.0, y: 0.0 }, toward: Xy { x: 1.0, y: 0.0 } };
        slide.ground.regions = alloc::vec![Region { friction: 0.0, grade: Xy::zero(), area: ice }];
        let end = slide.separation(&evidence(Pose { position: Xy { x: 40.0, y: 2.0 }, heading: 0.3 }), Method::Slide);
        let Err(NoSeparation::NotConverged { motion, miss }) = end else { panic!("{end:?}") };
        let rest = slide.to_rest(&FROM, &motion).expect("it comes to rest").pose;
        assert!(
            rest.position.x < 9.0 && miss == Miss::of(&rest, &Pose { position: Xy { x: 40.0, y: 2.0 }, heading: 0.3 }),
            "{rest:?} {miss:?}"
        );
    }

    #[test]
    fn one_separation_is_found_once_and_the_others_are_as_good_by_chance() {
        let one = |x: f64, sum_of_squares: f64| Found { unknowns: alloc::vec![x, 0.0, 0.0], sum_of_squares, iterations: 0 };
        let mut found = Vec::new();
        for (x, sum_of_squares) in [(1.0, 3.0), (1.000_05, 2.0), (1.000_02, 2.5), (5.0, 12.5), (9.0, 13.0), (7.0, 2.1)] {
            keep(&mut found, one(x, sum_of_squares), SAME);
        }
        assert_eq!(found.iter().map(|found| found.sum_of_squares).collect::<Vec<_>>(), [2.0, 12.5, 13.0, 2.1]);
        let best = best_of(&mut found, &[0.0; 3], true).expect("one");
        assert_eq!(
            (best.sum_of_squares, found.iter().map(|found| found.sum_of_squares).collect::<Vec<_>>()),
            (2.0, alloc::vec![2.1, 12.5])
        );
        // Without points all that reach the pose are as good, and the nearest to the first guess is the one.
        let mut found: Vec<Found> = [(8.0, 1e-20), (2.0, 1e-14), (1.0, 1.0)].map(|(x, sum)| one(x, sum)).into();
        assert_eq!((best_of(&mut found, &[0.0; 3], false).expect("one").unknowns[0], found.len()), (2.0, 1));
    }

    /// Locked rear wheels drive the rotation from a motion ahead: it is in proportion to the path.
    #[test]
    fn a_rotation_that_the_tires_drive_begins_in_proportion_to_the_path() {
        let slide = slide(Wheels { rear_left: Wheel::LOCKED, rear_right: Wheel::LOCKED, ..Wheels::all(Wheel::ROLLING) });
        let ahead = Xy { x: 10.0 * libm::cos(FROM.heading), y: 10.0 * libm::sin(FROM.heading) };
        let rest = Pose { position: FROM.position + ahead, heading: FROM.heading + 1.0 };
        assert!(slide.closed_form(&FROM, &rest).yaw_rate.is_nan());
        let [x, y, yaw_rate] = slide.first_guess(&evidence(rest));
        assert!((yaw_rate - libm::hypot(x, y) / 10.0).abs() < 1e-12 * yaw_rate, "{x} {y} {yaw_rate}");
    }

    #[test]
    fn a_search_without_an_end_reports_the_motion_that_came_nearest() {
        let slide = slide(damaged());
        let at = |share: f64| motion(&MOTIONS[0].map(|component| share * component));
        let evidence = evidence(slide.to_rest(&FROM, &at(1.0)).expect("it comes to rest").pose);
        let search = ToRest::of(&slide, &evidence, &|_, _| true);
        for share in [0.5, 0.9, 1.3, 0.8] {
            search.residuals(&at(share).components()).expect("it comes to rest");
        }
        let Err(NoSeparation::NotConverged { motion, .. }) = Err::<(), _>(search.nothing_found(&MOTIONS[1])) else { panic!("no motion") };
        assert_eq!(motion, at(0.9));
    }

    /// The last steps are those of Newton: from a thousandth beside it to the last digits.
    #[test]
    fn the_last_steps_reach_the_motion() {
        let slide = slide(damaged());
        let truth = motion(&MOTIONS[0]);
        let evidence = evidence(slide.to_rest(&FROM, &truth).expect("it comes to rest").pose);
        let search = ToRest::of(&slide, &evidence, &|_, _| true);
        let beside = motion(&[9.01, 3.99, 2.49]);
        let found = search.near(&beside).expect("a minimum");
        assert!(distance(&found.unknowns, &MOTIONS[0]) < 1e-8 && found.sum_of_squares < 1e-14, "{:?}", found.unknowns);
    }

    #[test]
    fn slopes_that_are_no_numbers_determine_nothing() {
        for bad in [f64::NAN, f64::INFINITY] {
            let mut slopes: [Slopes; 3] = core::array::from_fn(|i| core::array::from_fn(|k| if i == k { 1.0 } else { 0.0 }));
            slopes[1][2] = bad;
            assert!(matches!(uncertainty(&slopes, &evidence(FROM)), Err(NoSeparation::NotDetermined { .. })));
        }
    }

    #[test]
    fn what_never_rests_is_said() {
        let mut slide = slide(Wheels::all(Wheel::LOCKED));
        slide.ground.friction = 0.0;
        let end = slide.separation(&evidence(Pose { position: Xy { x: 20.0, y: 2.0 }, heading: 0.3 }), Method::Slide);
        assert!(matches!(end, Err(NoSeparation::NoRest(NoRest::Moves(_)))), "{end:?}");
    }

    /// A search that was stopped does not ask again whether to go on. The work that it reports grows with each slide.
    #[test]
    fn a_search_stops_when_it_is_told_to() {
        let rest = slide(damaged()).to_rest(&FROM, &motion(&MOTIONS[0])).expect("it comes to rest").pose;
        let told = RefCell::new(Vec::new());
        let goes_on = |done, total| {
            told.borrow_mut().push((done, total));
            told.borrow().len() < 100
        };
        assert_eq!(slide(damaged()).separation_while(&evidence(rest), Method::Slide, &goes_on), Err(NoSeparation::Stopped));
        let told = told.into_inner();
        assert_eq!(told.len(), 100);
        assert!(told.windows(2).all(|pair| pair[0].0 < pair[1].0) && told.iter().all(|(done, total)| done <= total), "{told:?}");
    }

    #[test]
    fn everything_wrong_is_said_at_once() {
        let mut slide = slide(Wheels::all(Wheel::braked(1.5)));
        (slide.vehicle.mass, slide.ground.friction) = (0.0, f64::NAN);
        let given = RestEvidence { heading_deviation: 0.0, ..evidence(Pose { heading: f64::INFINITY, ..FROM }) };
        let end = slide.separation(&given, Method::Slide);
        let Err(NoSeparation::Refused(issues)) = end else { panic!("{end:?}") };
        assert_eq!(issues.len(), 4 + 4, "{issues}");
        let start = slide.to_rest(&Pose::default(), &motion(&[f64::NAN, 1.0, 2.0]));
        let Err(NoRest::Refused(issues)) = start else { panic!("{start:?}") };
        assert_eq!(issues.len(), 4 + 2 + 1, "{issues}");
    }
}
