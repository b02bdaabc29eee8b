//! The terms of the field, for a reader of another one.

use crate::block::Block;

const TERMS: [(&str, &str); 19] = [
    (
        "Chi-square",
        "The sum of the squares of the residuals of all pieces of evidence, each in its standard deviations. About the number of degrees of freedom where evidence and mechanics agree.",
    ),
    ("Confidence interval", "A range computed so that, of many such ranges, the stated share contains the true value."),
    ("Critical impulse ratio, mu0", "The impulse ratio at which the sliding between the vehicles ends before they separate."),
    ("Crush energy", "The energy that it took to deform a vehicle as it was found."),
    (
        "Crush plane",
        "The common surface of the crushed vehicles; its direction is that of the tangent t, and its normal n is at the angle Gamma from the ground axis x.",
    ),
    ("CRASH3", "A published method of the 1980s, which finds the change of velocity from crush."),
    (
        "Delta-V, ΔV",
        "The change of a vehicle's velocity in the impact, as a vector: its length is given here. The measure of severity for occupants.",
    ),
    ("Equivalent energy speed, EES", "The speed at which the vehicle's kinetic energy would be its crush energy."),
    ("Heading", "The direction in which a vehicle faces, counter-clockwise from the ground axis x."),
    ("Impact center", "The point at which the impulse acts, seen from each vehicle's center of mass: forward and left."),
    ("Impulse", "Force times time, summed over the contact. Both vehicles get the same impulse in opposite directions."),
    ("Impulse ratio, mu", "The tangential impulse over the normal impulse: friction and snagging together."),
    ("Kinetic energy", "The energy of motion, of travel and of rotation."),
    (
        "Principal direction of force, PDOF",
        "The direction from which the impulse came, in the vehicle's axes, clockwise from straight ahead: 0 is frontal, 90 degrees from the right; also on a clock with 12 ahead.",
    ),
    ("Residual", "A piece of evidence less what the fit says of it, in standard deviations."),
    (
        "Restitution, e",
        "The normal velocity at which the vehicles separate at the impact center, over that at which they approached: 0 without rebound.",
    ),
    ("Standard deviation", "The usual size of an error: about two of three errors are smaller, and 19 of 20 are smaller than two of it."),
    ("Yaw inertia", "How hard it is to spin the vehicle about its vertical axis."),
    ("Yaw rate", "How fast a vehicle rotates, counter-clockwise seen from above."),
];

/// Renders the terms.
pub fn blocks() -> Vec<Block> {
    TERMS.iter().map(|(term, meaning)| Block::item(format!("{term}:"), *meaning)).collect()
}
