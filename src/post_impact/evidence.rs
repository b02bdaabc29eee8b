//! Evidence from a vehicle's rest position, and the separation it implies.

use alloc::borrow::Cow;
use alloc::vec::Vec;
use core::fmt;

use statrs::distribution::{ChiSquared, ContinuousCDF};

use super::check::{check_pose, check_proportions};
use super::issue::{NoRest, SlideIssues};
use super::path_point::{NearestPlace, PathPoint};
use super::slide::Slide;
use super::trajectory_state::TrajectoryState;
use super::vehicle::Pose;
use crate::frame::Xy;
use crate::input::Side;
use crate::issue::{Issue, Place};
use crate::measure::Measure;
use crate::message::Message;
use crate::output::Output;
use crate::reconstruct::{Correlation, Evidence, Measurand, Uncertainty};
use crate::vehicle::Motion;

/// Poses of a vehicle at separation and at rest, and points that it passed between them, with their uncertainty.
#[derive(Clone, Debug, PartialEq)]
pub struct RestEvidence {
    /// Pose at separation, taken as exact.
    pub separation: Pose,
    /// Pose at rest; whole turns between the two headings count.
    pub rest: Pose,
    /// The standard deviations of the position at rest, in m.
    pub position_deviation: Xy,
    /// The standard deviation of the heading at rest, in rad.
    pub heading_deviation: f64,
    /// The standard deviation of a factor common to all frictions, dimensionless: 0.1 for a friction of 0.7 ± 0.07.
    pub friction_deviation: f64,
    /// Points that the center of mass or a wheel passed, such as tire marks.
    pub points: Vec<PathPoint>,
}

/// Method of computing the separation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Method {
    /// From the slide that ends in the pose at rest.
    Slide,
    /// From the work of the tires along a straight path.
    ClosedForm,
}

/// Motion of a vehicle at separation.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Separation {
    /// Its velocity on the ground and its yaw rate.
    pub motion: Motion,
    /// Their covariance.
    pub covariance: MotionCovariance,
    /// The part of their error that is due to the friction: their change if every friction is larger by its standard deviation, in m/s and rad/s. The
    /// covariance includes it. For two vehicles on the same ground these errors are correlated: their covariance is the product of the two parts. A fit to several
    /// pieces of evidence weighs them at the fitted motion ([`Separation::with_friction_at`]).
    pub by_friction: Motion,
    /// Fit of the slide to the pose at rest; `None` for the closed form.
    pub fit: Option<SlideFit>,
}

/// The covariance of V_x, V_y and Ω, in this order, in m/s and rad/s.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct MotionCovariance(pub [[f64; 3]; 3]);

/// Fit of a slide to a pose at rest.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SlideFit {
    /// Number of steps of the search that found it.
    pub iterations: usize,
    /// Number of starts that were tried.
    pub starts: usize,
    /// Number of starts that led to a solution.
    pub converged: usize,
    /// Distance of the end of its slide from the pose at rest.
    pub miss: Miss,
    /// The place of the path that is nearest to each point of the evidence.
    pub points: Vec<NearestPlace>,
    /// The sum of the squares of what pose and points are missed by, in standard deviations.
    pub chi_square: f64,
    /// The number of points: three unknowns are determined by the pose at rest alone.
    pub degrees_of_freedom: usize,
    /// The probability of a χ² this large or larger by chance; 1 without points.
    pub probability: f64,
    /// Other separations that end in the same pose at rest and come past the points, the best first; their own fits have no others.
    pub others: Vec<Separation>,
}

/// A computed pose at rest less the given one.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Miss {
    /// Difference in position, in m.
    pub position: Xy,
    /// Difference in heading, in rad.
    pub heading: f64,
}

/// Reason for the absence of a separation.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub enum NoSeparation {
    /// The input is refused.
    Refused(SlideIssues),
    /// No motion that was tried comes to rest: the reason for the first, which is that of the closed form.
    NoRest(NoRest),
    /// No search reached a solution; this is the best result.
    NotConverged {
        /// The motion whose slide ends nearest to the pose, in standard deviations.
        motion: Motion,
        /// Distance of the end of its slide from the pose at rest.
        miss: Miss,
    },
    /// The pose at rest does not determine the motion: a change of the motion along this direction has no significant effect on the pose.
    NotDetermined {
        /// The direction, of length 1 in m/s and rad/s; zero if the derivatives are not finite.
        along: Motion,
    },
    /// The vehicle does not stand in the pose at rest: the grade is steeper than its tires hold.
    NotHeld,
    /// The closed form has no path that could be compared with points.
    NoPath,
    /// The closed form has no solution: on a straight path the tires, or the grade, would drive the vehicle.
    Driven,
    /// The closed form cannot determine the yaw rate: the tires alone would rotate the vehicle, for instance because one side drags more, and its rotation is
    /// within a few deviations of zero, or of the values at which they would drive it.
    Turned {
        /// The change of its heading, in rad.
        turn: f64,
        /// The deviation of its heading, in rad.
        deviation: f64,
    },
    /// The pose at rest is that at separation; or the closed form cannot determine its uncertainty, since the vehicle moved no further than the deviation of its position
    /// at rest.
    TooShort {
        /// Distance that it moved, in m.
        distance: f64,
        /// The larger of the deviations of its position, in m.
        deviation: f64,
    },
    /// The search was stopped.
    Stopped,
}

impl Separation {
    /// Returns `true` if every standard deviation is finite and above zero, so that the separation can be weighted as evidence.
    pub fn has_deviations(&self) -> bool {
        self.covariance.deviations().iter().all(|sd| sd.is_finite() && *sd > 0.0)
    }

    /// Returns the miss of the nearest slide if it exceeds the deviations of the pose, or `None` if the slide reaches the pose or for the closed form.
    ///
    /// With points along the path, pose and points share what is missed, and [`SlideFit::probability`] is the measure of it.
    pub fn miss_beyond(&self, rest: &RestEvidence) -> Option<Miss> {
        let miss = self.fit.as_ref().filter(|fit| fit.points.is_empty())?.miss;
        let within = miss.position.x.abs() <= rest.position_deviation.x
            && miss.position.y.abs() <= rest.position_deviation.y
            && miss.heading.abs() <= rest.heading_deviation;
        (!miss.is_nothing() && !within).then_some(miss)
    }

    /// Returns the same separation with the errors by the friction that it would have with another motion, of a vehicle of this radius of gyration in m: they grow with
    /// the motion.
    ///
    /// Where evidence disagrees, a fit that weighs them at the given motion prefers low speeds: the friction is common to all of it, and a lower one lessens every
    /// disagreement (Peelle's puzzle; D'Agostini 1994). Weighed at the fitted motion they prefer none.
    ///
    /// ```
    /// use planar_impact::post_impact::{MotionCovariance, Separation};
    /// use planar_impact::{Motion, Xy};
    /// // On locked wheels a friction of ± 20 % is ± 10 % of the speed; the place at rest adds ± 0.3 m/s along x.
    /// let motion = |x, y| Motion { velocity: Xy { x, y }, yaw_rate: 0.0 };
    /// let covariance = MotionCovariance([[0.25 + 0.09, 0.0, 0.0], [0.0, 0.04, 0.0], [0.0, 0.0, 0.1]]);
    /// let separation = Separation { motion: motion(5.0, 0.0), covariance, by_friction: motion(0.5, 0.0), fit: None };
    /// let fitted = separation.with_friction_at(&motion(4.0, 1.0), 1.3);
    /// assert_eq!((fitted.by_friction.velocity, fitted.motion), (Xy { x: 0.4, y: 0.1 }, separation.motion));
    /// assert!((fitted.covariance.0[0][0] - (0.16 + 0.09)).abs() < 1e-15 && (fitted.covariance.0[0][1] - 0.04).abs() < 1e-15);
    /// ```
    #[must_use]
    pub fn with_friction_at(&self, motion: &Motion, gyration: f64) -> Separation {
        let [given, by_friction, there] = [self.motion, self.by_friction, *motion].map(Motion::components);
        let share = self.share_by_friction(gyration);
        let moved: [f64; 3] = core::array::from_fn(|i| by_friction[i] + share * (there[i] - given[i]));
        let mut weighed = self.clone();
        weighed.by_friction = Motion { velocity: Xy { x: moved[0], y: moved[1] }, yaw_rate: moved[2] };
        for (i, row) in weighed.covariance.0.iter_mut().enumerate() {
            for (k, entry) in row.iter_mut().enumerate() {
                *entry += moved[i] * moved[k] - by_friction[i] * by_friction[k];
            }
        }
        weighed
    }

    /// Returns the share of the motion that its error by the friction is: half of that of the friction on locked wheels, of which a speed grows with the root. Zero of a vehicle
    /// at rest.
    ///
    /// ```
    /// use planar_impact::post_impact::{MotionCovariance, Separation};
    /// use planar_impact::{Motion, Xy};
    /// let motion = |x, y| Motion { velocity: Xy { x, y }, yaw_rate: 0.0 };
    /// let separation = Separation { motion: motion(5.0, 0.0), covariance: MotionCovariance([[0.25; 3]; 3]), by_friction: motion(0.5, 0.0), fit: None };
    /// assert_eq!(separation.share_by_friction(1.3), 0.1);
    /// ```
    pub fn share_by_friction(&self, gyration: f64) -> f64 {
        let [given, by_friction] = [self.motion, self.by_friction].map(Motion::components);
        let metric = [1.0, 1.0, gyration * gyration];
        let dot = |one: [f64; 3], other: [f64; 3]| -> f64 { (0..3).map(|i| metric[i] * one[i] * other[i]).sum() };
        let share = dot(by_friction, given) / dot(given, given);
        if share.is_finite() { share } else { 0.0 }
    }

    /// Returns the correlation of V_x, V_y or Ω of one vehicle with one of them of another that slid on the same ground, which is due to the friction.
    pub fn correlation_by_friction(&self, i: usize, other: &Separation, k: usize) -> f64 {
        let scale = self.covariance.deviations()[i] * other.covariance.deviations()[k];
        if scale > 0.0 { self.by_friction.components()[i] * other.by_friction.components()[k] / scale } else { 0.0 }
    }
}

/// Separations of two vehicles as evidence of a collision.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SeparationEvidence {
    /// V_x, V_y and Ω of each vehicle, each with its standard deviation.
    pub evidence: Vec<Evidence>,
    /// Correlations of their errors: for one vehicle from its covariance, for two from the friction of the common ground.
    pub correlations: Vec<Correlation>,
}

impl SeparationEvidence {
    /// Converts the separations of vehicle 1 and of vehicle 2, as far as they are known.
    pub fn of(separations: [Option<&Separation>; 2]) -> Self {
        let outputs = |side| Output::motion_after(side).map(Measurand::Output);
        let mut all = SeparationEvidence::default();
        let mut correlate = |one, other, coefficient: f64| {
            // NaN is kept, because the reconstruction refuses it.
            if coefficient != 0.0 {
                all.correlations.push(Correlation { one, other, coefficient });
            }
        };
        for (side, separation) in [Side::One, Side::Two].into_iter().zip(separations) {
            let Some(Separation { motion, covariance, .. }) = separation else { continue };
            let of = outputs(side);
            for ((of, value), sd) in of.into_iter().zip(motion.components()).zip(covariance.deviations()) {
                all.evidence.push(Evidence { of, value, uncertainty: Uncertainty::StandardDeviation(sd) });
            }
            for (i, k) in [(0, 1), (0, 2), (1, 2)] {
                correlate(of[i], of[k], covariance.correlation(i, k));
            }
        }
        if let [Some(one), Some(two)] = separations {
            let (of_one, of_two) = (outputs(Side::One), outputs(Side::Two));
            for (i, of_one) in of_one.into_iter().enumerate() {
                for (k, of_two) in of_two.into_iter().enumerate() {
                    correlate(of_one, of_two, one.correlation_by_friction(i, two, k));
                }
            }
        }
        all
    }
}

impl SlideFit {
    /// Returns the fit with another sum of squares, such as the least one with numbers of the vehicle that are uncertain, and its probability.
    #[must_use]
    pub fn with_chi_square(mut self, chi_square: f64) -> SlideFit {
        let by_chance = |freedom: usize| ChiSquared::new(freedom as f64).map_or(f64::NAN, |distribution| distribution.sf(chi_square));
        self.probability = if self.degrees_of_freedom == 0 { 1.0 } else { by_chance(self.degrees_of_freedom) };
        SlideFit { chi_square, ..self }
    }
}

impl MotionCovariance {
    /// Returns the standard deviations of V_x and V_y, in m/s, and of Ω, in rad/s.
    pub fn deviations(&self) -> [f64; 3] {
        core::array::from_fn(|i| self.0[i][i].sqrt())
    }

    /// Returns the correlation of two of them, from −1 to 1, or 0 if one has no variance.
    pub fn correlation(&self, i: usize, k: usize) -> f64 {
        let scale = (self.0[i][i] * self.0[k][k]).sqrt();
        if scale > 0.0 { self.0[i][k] / scale } else { 0.0 }
    }
}

impl Miss {
    pub(super) fn of(computed: &Pose, given: &Pose) -> Miss {
        Miss { position: computed.position - given.position, heading: computed.heading - given.heading }
    }

    /// Returns `true` if the pose is reached, to a tenth of a millimeter and a hundredth of a degree.
    pub fn is_nothing(&self) -> bool {
        self.position.length() <= 1e-4 && self.heading.abs() <= 1.75e-4
    }
}

impl Slide {
    /// Computes the motion at separation of a vehicle that came to rest in a pose.
    ///
    /// # Errors
    ///
    /// [`NoSeparation`]: every issue of the input, or the reason why the pose at rest does not determine the motion.
    pub fn separation(&self, evidence: &RestEvidence, method: Method) -> Result<Separation, NoSeparation> {
        self.separation_while(evidence, method, &|_, _| true)
    }

    /// As [`Slide::separation`], and calls a function before each slide that is followed, with the work that is done and the most there may be. It stops the search by
    /// returning `false`.
    ///
    /// # Errors
    ///
    /// [`NoSeparation`].
    pub fn separation_while(
        &self,
        evidence: &RestEvidence,
        method: Method,
        goes_on: &dyn Fn(usize, usize) -> bool,
    ) -> Result<Separation, NoSeparation> {
        self.check_evidence(evidence).map_err(NoSeparation::Refused)?;
        if !self.stands(&evidence.rest) {
            return Err(NoSeparation::NotHeld);
        }
        // Tires give way at the speeds that lead no further, and what they say of the speed then is of their regularization.
        let way = Miss::of(&evidence.rest, &evidence.separation);
        if way.is_nothing() && evidence.points.is_empty() {
            let Xy { x, y } = evidence.position_deviation;
            return Err(NoSeparation::TooShort { distance: way.position.length(), deviation: x.max(y) });
        }
        match method {
            Method::ClosedForm if !evidence.points.is_empty() => Err(NoSeparation::NoPath),
            Method::ClosedForm => self.separation_in_closed_form(evidence),
            Method::Slide => self.separation_by_slide(evidence, goes_on),
        }
    }

    /// Computes the separation near that of a vehicle, or of a pose at separation, that differs little: the last steps of the search alone, without its checks. `None`
    /// if they do not lead to the pose at rest.
    #[must_use]
    pub fn separation_near(&self, evidence: &RestEvidence, method: Method, known: &Motion) -> Option<Separation> {
        match method {
            Method::ClosedForm => self.separation_in_closed_form(evidence).ok(),
            Method::Slide => self.separation_by_slide_near(evidence, known),
        }
    }

    /// Returns what a pose at rest says of the separation to first order about another motion, such as one that more evidence leads to: the motion that a step of Gauss
    /// and Newton from there leads to, with the covariance and the part by the friction there. `None` where that motion does not come to rest, or its rest does not
    /// depend on it.
    ///
    /// Where a slide bends, the slopes about the fitted motion are those that count: on wheels that roll the motion that ends in the pose itself may lie beside a fold,
    /// at which separations turn round. The closed form is the same about any motion.
    ///
    /// ```
    /// use planar_impact::post_impact::*;
    /// use planar_impact::{Motion, Xy};
    ///
    /// let vehicle = SlidingVehicle {
    ///     mass: 1500.0,
    ///     yaw_inertia: 2500.0,
    ///     front_axle: 1.2,
    ///     rear_axle: 1.5,
    ///     track: 1.5,
    ///     wheels: Wheels::all(Wheel::LOCKED),
    ///     tires: Tires::ORDINARY,
    /// };
    /// let slide = Slide { vehicle, ground: Ground::uniform(0.7) };
    /// let ahead = |speed: f64| Motion { velocity: Xy { x: speed, y: 0.0 }, yaw_rate: 0.0 };
    /// let evidence = RestEvidence {
    ///     separation: Pose::default(),
    ///     rest: slide.to_rest(&Pose::default(), &ahead(10.0)).expect("it stops").pose,
    ///     position_deviation: Xy { x: 0.3, y: 0.3 },
    ///     heading_deviation: 0.05,
    ///     friction_deviation: 0.0,
    ///     points: Vec::new(),
    /// };
    /// // The way is v²/(2μg). About 9 m/s a step leads to 9 + (10² - 9²)/(2 · 9) m/s, with a deviation of μg σ/9.
    /// let about = slide.separation_about(&evidence, Method::Slide, &ahead(9.0)).expect("it stops");
    /// assert!((about.motion.velocity.x - (9.0 + 19.0 / 18.0)).abs() < 1e-3);
    /// assert!((about.covariance.deviations()[0] - 0.7 * 9.80665 * 0.3 / 9.0).abs() < 1e-3);
    /// ```
    #[must_use]
    pub fn separation_about(&self, evidence: &RestEvidence, method: Method, about: &Motion) -> Option<Separation> {
        match method {
            Method::ClosedForm => self.separation_in_closed_form(evidence).ok(),
            Method::Slide => self.separation_by_slide_about(evidence, about),
        }
    }

    fn check_evidence(&self, evidence: &RestEvidence) -> Result<(), SlideIssues> {
        let mut issues = self.issues();
        check_proportions(&mut issues, &self.vehicle);
        check_pose(&mut issues, ["separation.position.x", "separation.position.y", "separation.heading"], &evidence.separation);
        check_pose(&mut issues, ["rest.position.x", "rest.position.y", "rest.heading"], &evidence.rest);
        issues.positive(Place::of("rest.position.x.sd", Measure::Length), &evidence.position_deviation.x);
        issues.positive(Place::of("rest.position.y.sd", Measure::Length), &evidence.position_deviation.y);
        issues.positive(Place::of("rest.heading.sd", Measure::Angle), &evidence.heading_deviation);
        for (index, point) in evidence.points.iter().enumerate() {
            issues.finite(Place::of("point.position.x", Measure::Length).at(index), &point.position.x);
            issues.finite(Place::of("point.position.y", Measure::Length).at(index), &point.position.y);
            issues.positive(Place::of("point.position.x.sd", Measure::Length).at(index), &point.deviation.x);
            issues.positive(Place::of("point.position.y.sd", Measure::Length).at(index), &point.deviation.y);
        }
        issues.within(Place::plain("friction.sd"), &evidence.friction_deviation, 0.0, Some(1.0));
        issues.finish()
    }
}

impl Issue for NoSeparation {
    type Number = f64;

    /// Returns the code of the first issue if the input is refused.
    fn code(&self) -> &'static str {
        match self {
            NoSeparation::Refused(issues) => issues.first().code(),
            NoSeparation::NoRest(why) => why.code(),
            NoSeparation::NotConverged { .. } => "not-converged",
            NoSeparation::NotDetermined { .. } => "underdetermined",
            NoSeparation::NotHeld => "not-held",
            NoSeparation::NoPath => "no-path",
            NoSeparation::Driven => "driven",
            NoSeparation::Turned { .. } => "turned",
            NoSeparation::TooShort { .. } => "too-short",
            NoSeparation::Stopped => "stopped",
        }
    }

    fn path(&self) -> Option<Cow<'static, str>> {
        match self {
            NoSeparation::Refused(issues) => issues.first().path(),
            NoSeparation::NoRest(why) => why.path(),
            _ => None,
        }
    }

    fn message(&self) -> Message {
        let message = Message::new();
        match self {
            NoSeparation::Refused(issues) => message.text(alloc::format!("{issues}")),
            NoSeparation::NoRest(NoRest::Moves(TrajectoryState { time, .. })) => message
                .text("the vehicle does not come to rest: from every motion that was tried it still moves after ")
                .figure(Measure::Time, *time),
            NoSeparation::NoRest(why) => why.message(),
            NoSeparation::NotConverged { miss, .. } => message
                .text("no slide was found that ends in the pose at rest: the best misses it by ")
                .figure(Measure::Length, miss.position.length())
                .text(" and ")
                .figure(Measure::Angle, miss.heading),
            NoSeparation::NotDetermined { along } if *along == Motion::rest() => {
                "the derivatives of the pose at rest by the separation are not finite".into()
            }
            NoSeparation::NotDetermined { along } => message
                .text("the pose at rest does not determine the separation: motions that differ along (")
                .figure(Measure::Speed, along.velocity.x)
                .text(", ")
                .figure(Measure::Speed, along.velocity.y)
                .text(", ")
                .figure(Measure::YawRate, along.yaw_rate)
                .text(") end in the same pose"),
            NoSeparation::Stopped => "stopped before the separation was found".into(),
            NoSeparation::NotHeld => "the vehicle does not stay in the pose at rest: the grade there is steeper than its tires hold".into(),
            NoSeparation::NoPath => "the closed form follows no path, so that points along it say nothing".into(),
            NoSeparation::Driven => "on a straight path to the pose at rest the tires or the grade would drive the vehicle".into(),
            NoSeparation::Turned { turn, deviation } => message
                .text("the drag of the tires differs between the sides and would turn the vehicle, which turned ")
                .figure(Measure::Angle, *turn)
                .text(" ± ")
                .figure(Measure::Angle, *deviation)
                .text(": the closed form does not apply"),
            NoSeparation::TooShort { distance, deviation } => message
                .text("the vehicle moved ")
                .figure(Measure::Length, *distance)
                .text(", no further than the position at rest is uncertain, ")
                .figure(Measure::Length, *deviation),
        }
    }
}

impl fmt::Display for NoSeparation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:.3}", self.message())
    }
}

impl core::error::Error for NoSeparation {}

#[cfg(test)]
mod tests {
    use super::*;

    fn separation(covariance: [[f64; 3]; 3], [x, y, yaw_rate]: [f64; 3]) -> Separation {
        let by_friction = Motion { velocity: Xy { x, y }, yaw_rate };
        Separation { motion: Motion::rest(), covariance: MotionCovariance(covariance), by_friction, fit: None }
    }

    /// By hand: a covariance over both deviations, of one vehicle from its own matrix, and of two from what the friction does to both.
    #[test]
    fn each_pair_has_its_own_correlation() {
        let one = separation([[4.0, 1.0, 0.5], [1.0, 9.0, -0.6], [0.5, -0.6, 0.25]], [1.0, 0.0, 0.2]);
        let two = separation([[1.0, 0.0, 0.0], [0.0, 4.0, 0.0], [0.0, 0.0, 1.0]], [0.0, 1.0, 0.5]);
        let found = SeparationEvidence::of([Some(&one), Some(&two)]).correlations;
        let [x, y, spin] = [Output::VelocityX, Output::VelocityY, Output::YawRate];
        let (first, second) = (Side::One, Side::Two);
        let wanted = [
            (x(first), y(first), 1.0 / 6.0),
            (x(first), spin(first), 0.5),
            (y(first), spin(first), -0.4),
            (x(first), y(second), 0.25),
            (x(first), spin(second), 0.25),
            (spin(first), y(second), 0.2),
            (spin(first), spin(second), 0.2),
        ];
        assert_eq!(found.len(), wanted.len(), "{found:?}");
        for (found, (one, other, coefficient)) in found.iter().zip(wanted) {
            assert_eq!((found.one, found.other), (Measurand::Output(one), Measurand::Output(other)));
            assert!((found.coefficient - coefficient).abs() < 1e-15, "{found:?}");
        }
    }

    /// A separation without a standard deviation can neither be weighted nor correlated.
    #[test]
    fn what_is_exact_has_no_correlation() {
        let exact = separation([[0.0; 3], [0.0, 9.0, 0.0], [0.0, 0.0, 0.25]], [1.0, 2.0, 0.2]);
        let other = separation([[4.0, 0.0, 0.0], [0.0, 9.0, 0.0], [0.0, 0.0, 0.25]], [1.0, 0.0, 0.2]);
        assert!(!exact.has_deviations() && other.has_deviations());
        assert_eq!((exact.correlation_by_friction(0, &other, 0), exact.correlation_by_friction(1, &other, 0)), (0.0, 1.0 / 3.0));
    }

    #[test]
    fn a_slide_that_misses_any_part_of_the_pose_is_beyond_it() {
        let rest = RestEvidence {
            separation: Pose::default(),
            rest: Pose::default(),
            position_deviation: Xy { x: 0.3, y: 0.2 },
            heading_deviation: 0.1,
            friction_deviation: 0.05,
            points: Vec::new(),
        };
        let miss = |x, y, heading| {
            let miss = Miss { position: Xy { x, y }, heading };
            let fit = SlideFit {
                iterations: 1,
                starts: 1,
                converged: 1,
                miss,
                points: Vec::new(),
                chi_square: 0.0,
                degrees_of_freedom: 0,
                probability: 1.0,
                others: Vec::new(),
            };
            Separation { fit: Some(fit), ..separation([[1.0; 3]; 3], [0.0; 3]) }.miss_beyond(&rest) == Some(miss)
        };
        assert!(miss(0.31, 0.0, 0.0) && miss(0.0, -0.21, 0.0) && miss(0.0, 0.0, -0.11));
        assert!(!miss(0.29, 0.19, 0.09) && !miss(0.0, 0.0, 0.0));
    }
}
