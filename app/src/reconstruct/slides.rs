//! Evidence that seems to contradict itself by a way to rest whose separation is followed to first order.

use planar_impact::post_impact::Separation;
use planar_impact::reconstruct::Solution;
use planar_impact::{Side, Xy};

use super::followed::Followed;
use super::from_rest::{Separations, key, speed_of};
use super::question::Question;
use crate::case::{Case, vehicle_number};
use crate::notice::Notice;

/// Returns a warning of each separation that is taken about its rest position, and bends within the uncertainty of that. On wheels that roll it may turn round within one standard
/// deviation, of a long slide too.
pub fn bends(case: &Case, question: &Question, separations: &Separations) -> Vec<Notice> {
    /// Share of its standard deviation by which a separation leaves its slope within one standard deviation of the rest position.
    const MOST: f64 = 0.5;
    let warning = |followed: Followed<'_>| {
        let rest = followed.with(&[]).filter(|rest| !rest.slide.vehicle.is_locked())?;
        let near = |axis: usize, by: f64| {
            let mut moved = rest.clone();
            let evidence = moved.evidence.as_mut()?;
            let Xy { x, y } = evidence.position_deviation;
            match axis {
                0 => evidence.rest.position.x += by * x,
                1 => evidence.rest.position.y += by * y,
                _ => evidence.rest.heading += by * evidence.heading_deviation,
            }
            followed.near(&moved).map(|separation| separation.motion.components())
        };
        let (here, sds) = (followed.separation.motion.components(), followed.separation.covariance.deviations());
        // Where no slide leads to a place beside the rest position, the separation does not go on as its slope does.
        let is_bent = |axis: usize| {
            near(axis, 1.0)
                .zip(near(axis, -1.0))
                .is_none_or(|(more, less)| (0..3).any(|i| (0.5 * (more[i] + less[i]) - here[i]).abs() > MOST * sds[i]))
        };
        let message = || {
            format!(
                "vehicle.{}: its separation bends within the uncertainty of its rest position, and is taken to first order: intervals may be too narrow, and evidence that agrees may \
                 seem to contradict itself; measure the rest position better, or give the separation velocity as evidence",
                vehicle_number(followed.side)
            )
        };
        (0..3).any(is_bent).then(|| Notice::warning("slide-bends", key(followed.side), message()))
    };
    let about_rest = |followed: &Followed<'_>| !question.about_fit[followed.side as usize];
    Followed::all(case, &case.inputs, separations).filter(about_rest).filter_map(warning).collect()
}

/// Returns a warning of evidence that contradicts itself and might not if ways to rest were followed from every motion: short ones on locked wheels, and those on wheels that roll
/// whose separation bends and is not taken about the fit.
pub fn of_contradiction(question: &Question, separations: &Separations, best: &Solution) -> Vec<Notice> {
    /// Share of the speed from which a slide on locked wheels ends elsewhere than its way at one motion does.
    const BENT: f64 = 0.15;
    /// How many times as large chi-square was as by the slides themselves: up to twice in 1000 crashes with ways below two meters on locked wheels, and up to seven times in 69 with
    /// wheels that roll.
    const MOST: [f64; 2] = [2.0, 8.0];
    let warning = |(side, separation): (Side, &Option<Separation>)| {
        let separation = separation.as_ref()?;
        let is_by_way = question.asked.separation_from_rest[side as usize];
        if question.about_fit[side as usize] {
            return None;
        }
        let [speed, sd] = speed_of(separation);
        let is_short = sd > BENT * speed;
        let most = MOST[usize::from(!is_by_way)];
        if (is_by_way && !is_short) || !best.would_be_explained(best.chi_square / most) {
            return None;
        }
        let why = if is_by_way { "is short" } else { "is on wheels that roll" };
        let message = format!(
            "vehicle.{}: its way to rest {why}, and chi-square takes its separation to first order, which makes it up to {most} times too large: evidence that agrees may seem to \
             contradict itself, and intervals may be too narrow; see with `slide` how far from the rest position the best fit ends",
            vehicle_number(side)
        );
        Some(Notice::warning("contradiction-by-slide", key(side), message))
    };
    Side::ALL.into_iter().zip(separations).filter_map(warning).collect()
}
