//! Skids in a straight line.

use crate::strategies::config;
use planar_impact::Xy;
use planar_impact::skid::{Skid, braking, braking_speed, skid_speed};
use proptest::prelude::*;

const GRAVITY: f64 = 9.80665;

fn skid() -> impl Strategy<Value = Skid> {
    (0.1..80.0, 0.1..1.0, -0.08..0.12, 0.3..=1.0).prop_map(|(length, friction, grade, braking)| Skid {
        length,
        friction: friction + 0.3,
        grade,
        braking,
    })
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn parts_are_the_motion_in_small_steps(skids in prop::collection::vec(skid(), 1..4), end in 0.5..30.0) {
        let parts = braking(&skids, end, GRAVITY);
        prop_assert_eq!(parts.len(), skids.len());
        prop_assert_eq!(parts[parts.len() - 1].end, end);
        for pair in parts.windows(2) {
            prop_assert_eq!(pair[0].end, pair[1].start);
        }
        let whole = (end * end + skid_speed(&skids, GRAVITY).powi(2)).sqrt();
        prop_assert!((parts[0].start - whole).abs() < 1e-12 * whole);
        // Whatever the direction of travel.
        let (y, x) = (0.3 * end).sin_cos();
        let at_impact = Xy { x: end * x, y: end * y };
        prop_assert!((braking_speed(at_impact, skid_speed(&skids, GRAVITY)) - whole).abs() < 1e-12 * whole);
        // Newton's law along the slope: friction of the normal force, and the weight's part along the road.
        for (skid, part) in skids.iter().zip(&parts) {
            let slope = skid.grade.atan();
            let slows = GRAVITY * (skid.friction * skid.braking * slope.cos() + slope.sin());
            prop_assert!((part.deceleration - slows).abs() < 1e-12 * GRAVITY);
            prop_assert!((part.start - part.deceleration * part.time - part.end).abs() < 1e-9 * part.start);
            let run = 0.5 * (part.start + part.end) * part.time;
            prop_assert!((run * slope.cos() - skid.length).abs() < 1e-9 * skid.length);
        }
    }

    #[test]
    fn a_divided_skid_is_the_same(skid in skid(), share in 0.01..0.99, end in 0.0..30.0) {
        let whole = braking(&[skid], end, GRAVITY);
        let [first, second] = [share, 1.0 - share].map(|share| Skid { length: share * skid.length, ..skid });
        let parts = braking(&[first, second], end, GRAVITY);
        prop_assert!((parts[0].start - whole[0].start).abs() < 1e-12 * whole[0].start);
        let time = parts[0].time + parts[1].time;
        prop_assert!((time - whole[0].time).abs() < 1e-9 * whole[0].time);
    }
}
