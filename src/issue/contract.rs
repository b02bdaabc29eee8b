//! The trait of every error.

use alloc::borrow::Cow;

use crate::message::Message;

/// One issue of an input, or one reason for the absence of a result.
///
/// | code | meaning |
/// |---|---|
/// | `not-finite` | a number is infinite or not a number |
/// | `not-positive` | a number that must be above zero is not |
/// | `out-of-range` | a number lies outside its range |
/// | `out-of-order` | a number of a list is on the wrong side of the one before it |
/// | `too-few` | a list is too short |
/// | `not-a-direction` | a cosine and a sine do not belong to an angle |
/// | `nothing-moves` | both parties are barriers |
/// | `overflow` | the result is beyond the range of the scalar |
/// | `ill-conditioned` | rounding changes the result by more than the accepted amount |
/// | `separating`, `not-closing` | the vehicles move apart, or do not approach each other |
/// | `tensile` | the normal impulse is tensile |
/// | `wedging` | no compressive impulse separates the vehicles at the given impulse ratio |
/// | `beyond-critical` | the impulse ratio is beyond the critical one, or has the opposite sign |
/// | `energy-gain` | the vehicles have more energy after the impact than before |
/// | `unequal-lengths` | two lists that belong together differ in length |
/// | `zone-count` | the number of borders does not match the number of stiffness zones |
/// | `perpendicular-surfaces` | two surfaces at a right angle have no single plane half way between them |
/// | `instants-differ` | two records are sampled at different instants |
/// | `impossible-profile` | no crush profile has the given moments |
/// | `one-depth` | all tests have the same mean depth |
/// | `undetermined` | the profiles of the tests do not tell the coefficients of a stiffness apart |
/// | `onset-too-fast` | the assumed onset speed is above the speed of the test |
/// | `sampled-too-slowly`, `not-uniform` | a record is sampled too slowly for its filter, or at unequal intervals |
/// | `span-too-narrow` | too few samples have a weight in a local line |
/// | `not-converged` | an iteration did not converge |
/// | `no-area` | a region of the ground has no inside |
/// | `does-not-rest`, `integration-failed` | the vehicle does not come to rest, or its motion cannot be integrated |
/// | `underdetermined` | the evidence does not determine the result |
/// | `driven`, `turned`, `too-short` | the closed form does not apply: the tires drive or turn the vehicle, or it barely moved |
/// | `nothing-unknown`, `too-little-evidence` | there are no unknowns, or fewer pieces of evidence than unknowns without two bounds |
/// | `not-in-case` | the collision has no such quantity |
/// | `repeated` | the same quantity is given twice |
/// | `speed-and-velocity` | a speed and a component of the same velocity are both unknown |
/// | `bounds-crossed` | a lower bound is not below the upper one |
/// | `share-unknown` | evidence of one vehicle's crush energy, without the share of each |
/// | `correlation-without-evidence`, `impossible-correlations` | a correlation needs two different pieces of evidence, or the correlations are not positive definite |
/// | `no-start` | the collision is refused at every start |
/// | `shape-without-prior` | a prior has a shape and no standard deviation |
/// | `posterior-improper`, `no-posterior` | nothing limits an unknown, or the collision is refused all around the solutions |
/// | `stopped` | the caller stopped a search or the draws |
pub trait Issue {
    /// The scalar type of the figures.
    type Number;

    /// Returns a stable name of the kind of issue, in kebab case.
    fn code(&self) -> &'static str;

    /// Returns the dotted name of the input that the issue is about, if it is about one.
    fn path(&self) -> Option<Cow<'static, str>> {
        None
    }

    /// Returns the message: what is wrong, the value, and what is accepted. It is shown next to [`Issue::path`] and does not repeat it.
    fn message(&self) -> Message<Self::Number>;

    /// Returns advice on what to do, if it adds to [`Issue::message`].
    fn help(&self) -> Option<Message<Self::Number>> {
        None
    }
}
