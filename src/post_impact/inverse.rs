//! The inverse problem: the separation whose slide ends in the pose at rest.

use alloc::vec::Vec;
use core::cell::{Cell, RefCell};
use core::f64::consts::FRAC_PI_2;

use nalgebra::{DMatrix, Matrix3, SMatrix, Vector3};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

use super::evidence::{Miss, MotionCovariance, NoSeparation, OtherSeparation, RestEvidence, Separation, SlideFit};
use super::issue::NoRest;
use super::slide::Slide;
use super::variation::{COARSE, FINE, VARIED};
use crate::frame::Xy;
use crate::least_squares::{self, FitError, Minimum, NotConverged, ParameterBounds, Residuals};
use crate::vehicle::Motion;

/// Number of starts of the search; the first is the closed form.
const STARTS: usize = 12;
/// Number of starts that are random, and of candidates from which the others are chosen.
const AT_RANDOM: usize = 4;
const LOOKED_AT: usize = 160;
/// Maximum number of steps of one search.
const ITERATIONS: usize = 60;
/// Maximum number of integration steps in all searches together, about a second: starts beyond it are not tried.
const WORK: usize = 600_000;
/// Cost of a step with its derivatives, in steps without.
const COST_OF_DERIVATIVES: usize = 6;
/// Significant changes of speed, in m/s, and of the yaw rate, in rad/s.
const SCALES: [f64; 3] = [1.0, 1.0, 0.3];
/// Largest distance, in these scales, of two solutions that are the same.
const SAME: f64 = 1e-4;
/// Sum of squares, in squares of standard deviations, at which the pose at rest is reached: a hundred-thousandth of a deviation.
const REACHED: f64 = 1e-10;
/// Share of the largest singular value below which a direction does not change the pose at rest.
const NOTHING: f64 = 1e-8;
/// Maximum number of iterations of a 3×3 decomposition, which needs a handful.
const MOST_SWEEPS: usize = 1000;

/// The pose at rest, computed less given, in standard deviations.
struct ToRest<'a> {
    slide: &'a Slide,
    evidence: &'a RestEvidence,
    /// The motion that comes to rest nearest to the pose. A motion that stands still from the beginning is not counted.
    nearest: RefCell<Option<Nearest>>,
    /// The reason why the first motion that does not come to rest does not.
    never: RefCell<Option<NoRest>>,
    /// The remaining number of integration steps, and the number of steps of the last slide.
    work: Cell<usize>,
    last: Cell<usize>,
}

/// A motion, the miss of its slide, and that miss in squares of standard deviations.
#[derive(Clone, Copy)]
struct Nearest {
    motion: Motion,
    miss: Miss,
    sum_of_squares: f64,
}

fn motion(unknowns: &[f64]) -> Motion {
    Motion { velocity: Xy { x: unknowns[0], y: unknowns[1] }, yaw_rate: unknowns[2] }
}

impl ToRest<'_> {
    fn deviations(&self) -> [f64; 3] {
        [self.evidence.position_deviation.x, self.evidence.position_deviation.y, self.evidence.heading_deviation]
    }

    fn miss(&self, unknowns: &[f64]) -> Result<Miss, NoRest> {
        let rest = self.slide.to_rest(&self.evidence.separation, &motion(unknowns));
        // A motion that does not come to rest takes the longest.
        self.spend(rest.as_ref().map_or(1000, |rest| rest.path.len()));
        let rest = rest?;
        Ok(Miss::of(&rest.pose, &self.evidence.rest))
    }

    fn residuals(&self, unknowns: &[f64]) -> Result<Vec<f64>, NoRest> {
        let miss = self.miss(unknowns)?;
        let Miss { position, heading } = miss;
        let residuals: Vec<f64> =
            [position.x, position.y, heading].into_iter().zip(self.deviations()).map(|(miss, sd)| miss / sd).collect();
        let sum_of_squares = residuals.iter().map(|residual| residual * residual).sum();
        let mut nearest = self.nearest.borrow_mut();
        let moves = !self.slide.is_at_rest(&motion(unknowns));
        if moves && nearest.is_none_or(|nearest| sum_of_squares < nearest.sum_of_squares) {
            *nearest = Some(Nearest { motion: motion(unknowns), miss, sum_of_squares });
        }
        Ok(residuals)
    }

    fn sum_of_squares(&self, unknowns: &[f64]) -> Result<f64, NoRest> {
        Ok(self.residuals(unknowns)?.iter().map(|residual| residual * residual).sum())
    }

    /// Returns the reason for finding nothing: the miss of the best motion, or, if no motion came to rest, the reason of the first.
    fn nothing_found(&self, first: &[f64; 3]) -> NoSeparation {
        if let Some(Nearest { motion, miss, .. }) = *self.nearest.borrow() {
            return NoSeparation::NotConverged { motion, miss };
        }
        // If nothing moved, use the first motion.
        match self.never.take().map_or_else(|| self.miss(first), Err) {
            Ok(miss) => NoSeparation::NotConverged { motion: motion(first), miss },
            Err(why) => NoSeparation::NoRest(why),
        }
    }

    fn spend(&self, steps: usize) {
        self.last.set(steps);
        self.work.set(self.work.get().saturating_sub(steps));
    }

    /// Returns the derivatives of the pose at rest by the motion and by the factor of the frictions, in standard deviations.
    fn slopes(&self, unknowns: &[f64], tolerance: f64) -> SMatrix<f64, 3, VARIED> {
        let deviations = self.deviations();
        match self.slide.varied_rest(&self.evidence.separation, &motion(unknowns), tolerance) {
            Ok(varied) => SMatrix::from_fn(|i, k| varied.by[i][k] / deviations[i]),
            Err(_) => SMatrix::zeros(),
        }
    }
}

impl Residuals for ToRest<'_> {
    fn at(&self, unknowns: &[f64]) -> Option<Vec<f64>> {
        if self.work.get() == 0 {
            return None;
        }
        self.residuals(unknowns)
            .map_err(|why| {
                self.never.borrow_mut().get_or_insert(why);
            })
            .ok()
    }

    fn jacobian(&self, unknowns: &[f64]) -> DMatrix<f64> {
        self.work.set(self.work.get().saturating_sub(COST_OF_DERIVATIVES * self.last.get()));
        let slopes = self.slopes(unknowns, COARSE);
        DMatrix::from_fn(3, 3, |i, k| slopes[(i, k)])
    }
}

/// The result of a search.
#[derive(Clone)]
struct Found {
    unknowns: Vec<f64>,
    sum_of_squares: f64,
    iterations: usize,
}

impl Slide {
    pub(super) fn separation_by_slide(&self, evidence: &RestEvidence) -> Result<Separation, NoSeparation> {
        let search = ToRest {
            slide: self,
            evidence,
            nearest: RefCell::new(None),
            never: RefCell::new(None),
            work: Cell::new(WORK),
            last: Cell::new(0),
        };
        let first = self.first_guess(evidence);
        let mut found: Vec<Found> = Vec::new();
        let (mut tried, mut converged) = (0, 0);
        for start in starts(&search, first) {
            if search.work.get() == 0 {
                break;
            }
            tried += 1;
            let spans = SCALES.map(|scale| ParameterBounds { min: f64::NEG_INFINITY, max: f64::INFINITY, scale });
            let end = match least_squares::minimum(&search, &start, &spans, ITERATIONS) {
                Ok(Minimum { unknowns, sum_of_squares, iterations, .. }) => Some(Found { unknowns, sum_of_squares, iterations }),
                Err(FitError::NotConverged(NotConverged { unknowns, iterations, .. })) => {
                    // If its work was used up, the search stopped evaluating the residuals: evaluate them here.
                    let Ok(sum_of_squares) = search.sum_of_squares(&unknowns) else { continue };
                    let end = Found { unknowns, sum_of_squares, iterations };
                    // The pose is reached, if not to the last digits: if hardly anything depends on the motion, these are noise.
                    (sum_of_squares <= REACHED).then_some(end)
                }
                Err(FitError::NoStart) => continue,
            };
            if let Some(end) = end {
                converged += 1;
                keep(&mut found, end);
            }
        }
        let Some(best) = best_of(&mut found, &first) else { return Err(search.nothing_found(&first)) };
        let miss = search.miss(&best.unknowns).map_err(NoSeparation::NoRest)?;
        let Uncertain { covariance, by_friction } = match uncertainty(&search.slopes(&best.unknowns, FINE), evidence) {
            // A search without any way to continue stays at its start.
            Err(_) if !miss.is_nothing() => return Err(search.nothing_found(&first)),
            uncertain => uncertain?,
        };
        let other = |other: &Found| Some(OtherSeparation { motion: motion(&other.unknowns), miss: search.miss(&other.unknowns).ok()? });
        let others = found.iter().filter_map(other).collect();
        let fit = SlideFit { iterations: best.iterations, starts: tried, converged, miss, others };
        Ok(Separation { motion: motion(&best.unknowns), covariance, by_friction, fit: Some(fit) })
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

/// Returns the first guess and other starts around it: a few at random, to find other solutions, and those of many candidates whose slides end nearest to the
/// pose. They deviate up to 90° to either side, from a third to one and a half times as fast, and rotate up to five times as fast.
fn starts(search: &ToRest<'_>, first: [f64; 3]) -> Vec<[f64; 3]> {
    let mut random = ChaCha8Rng::seed_from_u64(1966);
    let speed = libm::hypot(first[0], first[1]);
    let mut draw = || {
        let aside = random.random_range(-FRAC_PI_2..FRAC_PI_2);
        let faster = random.random_range(0.33..1.5);
        let turning = random.random_range(-1.0..5.0) * first[2] + random.random_range(-0.5..0.5);
        let (sin, cos) = libm::sincos(libm::atan2(first[1], first[0]) + aside);
        [faster * speed * cos, faster * speed * sin, turning]
    };
    let at_random: Vec<[f64; 3]> = (0..AT_RANDOM).map(|_| draw()).collect();
    let mut near: Vec<(f64, [f64; 3])> = Vec::new();
    for _ in 0..LOOKED_AT {
        let start = draw();
        if search.work.get() > WORK / 2
            && let Some(residuals) = search.at(&start)
        {
            near.push((residuals.iter().map(|residual| residual * residual).sum(), start));
        }
    }
    near.sort_by(|a, b| a.0.total_cmp(&b.0));
    let near = near.into_iter().take(STARTS - 1 - AT_RANDOM).map(|(_, start)| start);
    core::iter::once(first).chain(near).chain(at_random).collect()
}

/// Keeps a result, or the earlier one if it is the same and better.
fn keep(found: &mut Vec<Found>, one: Found) {
    match found.iter_mut().find(|other| distance(&other.unknowns, &one.unknowns) <= SAME) {
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
/// such as a slide that stops short of the pose where the search could not continue.
fn best_of(found: &mut Vec<Found>, first: &[f64; 3]) -> Option<Found> {
    let least = found.iter().map(|one| one.sum_of_squares).reduce(f64::min)?;
    found.retain(|one| one.sum_of_squares <= (least * (1.0 + 1e-6)).max(REACHED));
    found.sort_by(|a, b| distance(&a.unknowns, first).total_cmp(&distance(&b.unknowns, first)));
    Some(found.remove(0))
}

/// Uncertainty of a motion: its covariance, and the part from the friction alone.
struct Uncertain {
    covariance: MotionCovariance,
    by_friction: Motion,
}

/// Returns the covariance of the motion from that of the pose at rest, which is 1 in standard deviations, and from the friction: with J the derivatives by
/// the motion and j those by the friction, A = (JᵀJ)⁻¹ Jᵀ and C = A (1 + j σ² jᵀ) Aᵀ. With more friction, the motion that ends in the same pose changes by −A
/// j.
fn uncertainty(slopes: &SMatrix<f64, 3, VARIED>, evidence: &RestEvidence) -> Result<Uncertain, NoSeparation> {
    let scales = Matrix3::from_diagonal(&Vector3::from(SCALES));
    let jacobian = slopes.fixed_columns::<3>(0) * scales;
    // NaN has no decomposition, and the search for one would not end.
    let svd = if slopes.iter().all(|slope| slope.is_finite()) { jacobian.try_svd(true, true, f64::EPSILON, MOST_SWEEPS) } else { None };
    let Some(svd) = svd else { return Err(NoSeparation::NotDetermined { along: Motion::rest() }) };
    let largest = svd.singular_values.max();
    let (smallest, least) = svd.singular_values.argmin();
    let is_determined = least > NOTHING * largest;
    if !is_determined {
        let along = svd.v_t.map(|v_t| scales * v_t.row(smallest).transpose()).unwrap_or_default().normalize();
        return Err(NoSeparation::NotDetermined { along: motion(along.as_slice()) });
    }
    let Ok(inverse) = svd.pseudo_inverse(0.0) else {
        return Err(NoSeparation::NotDetermined { along: Motion::rest() });
    };
    let back = scales * inverse;
    let by_friction = -back * slopes.column(VARIED - 1) * evidence.friction_deviation;
    let covariance = back * back.transpose() + by_friction * by_friction.transpose();
    let covariance = MotionCovariance(core::array::from_fn(|i| core::array::from_fn(|k| covariance[(i, k)])));
    Ok(Uncertain { covariance, by_friction: motion(by_friction.as_slice()) })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::post_impact::{Area, Ground, Method, Pose, Region, Restraint, SlidingVehicle, Wheel, Wheels};

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
                let motion = slide.separation(&RestEvidence { rest, ..given }, method).expect("a solution").motion;
                [motion.velocity.x, motion.velocity.y, motion.yaw_rate]
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
            let by_friction = [found.by_friction.velocity.x, found.by_friction.velocity.y, found.by_friction.yaw_rate];
            for i in 0..3 {
                assert!((by_friction[i] - change[i]).abs() < 1e-3 * sum[i][i].sqrt(), "{method:?} {i}: {by_friction:?} {change:?}");
                for k in 0..3 {
                    let scale = (sum[i][i] * sum[k][k]).sqrt();
                    assert!((found.covariance.0[i][k] - sum[i][k]).abs() < 1e-3 * scale, "{method:?} {i} {k}: {found:?} {sum:?}");
                }
            }
        }
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
        slide.ground.regions = alloc::vec![Region { friction: 0.0, area: ice }];
        let end = slide.separation(&evidence(Pose { position: Xy { x: 40.0, y: 2.0 }, heading: 0.3 }), Method::Slide);
        let Err(NoSeparation::NotConverged { motion, miss }) = end else { panic!("{end:?}") };
        let rest = slide.to_rest(&FROM, &motion).expect("it comes to rest").pose;
        assert!(
            rest.position.x < 9.0 && miss == Miss::of(&rest, &Pose { position: Xy { x: 40.0, y: 2.0 }, heading: 0.3 }),
            "{rest:?} {miss:?}"
        );
    }

    #[test]
    fn slopes_that_are_no_numbers_determine_nothing() {
        for bad in [f64::NAN, f64::INFINITY] {
            let mut slopes = SMatrix::<f64, 3, VARIED>::identity();
            slopes[(1, 2)] = bad;
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
