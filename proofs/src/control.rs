//! False identities: a run that fails to detect one of them proves nothing.

use num_traits::FromPrimitive;
use planar_impact::paper::PaperNotation;
use planar_impact::{Collision, Field};

use crate::equation::Equations;
use crate::free::Free;
use crate::identity::identity;
use crate::identity::scene::{Scene, inelastic};
use crate::proof::{Proof, Verdict};
use crate::scalar::PRIMES;

/// A false identity, and its verdict in the run.
#[derive(Clone, Debug)]
pub struct Control {
    /// The attempt to prove it.
    pub proof: Proof,
    /// Reason why it must fail.
    pub expected: Expected,
}

/// Reason why a false identity must fail.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Expected {
    /// A point shows it to be false.
    False,
    /// It is true modulo every prime, but its coefficients are too large.
    TooLarge,
    /// It divides by zero.
    Undefined,
    /// It contains no equation.
    Empty,
}

impl Control {
    /// Returns `true` if it was detected.
    pub fn is_detected(&self) -> bool {
        let told = match self.expected {
            Expected::False => matches!(self.proof.verdict, Verdict::False { .. }),
            Expected::TooLarge => self.proof.verdict == Verdict::TooLarge,
            Expected::Undefined => matches!(self.proof.verdict, Verdict::Undefined(_)),
            Expected::Empty => self.proof.verdict == Verdict::Empty,
        };
        told && !self.proof.holds()
    }
}

/// Tests all controls.
pub(crate) fn all(seed: u64) -> Vec<Control> {
    let controls = [
        (Expected::False, identity!(wrong_sign, "a wrong sign", "m₂ (V₂ − v₂) = +P")),
        (Expected::False, identity!(no_condition, "a condition left out", "T_L is the same at any two Γ, for every e")),
        (Expected::False, identity!(printed_a11, "an equation as printed", "v_m = (v_2n − d_a ω₂) − (v_1n − d_c ω₁)", "A11")),
        (Expected::False, identity!(one_prime, "true modulo one prime", "(2⁶¹ − 1) x = 0")),
        (Expected::TooLarge, identity!(all_primes, "true modulo every prime", "(2⁶¹ − 1) (2⁶¹ − 31) ⋯ x = 0")),
        (Expected::Undefined, identity!(nowhere_defined, "nowhere defined", "1/(x − x) = 1/(x − x)")),
        (Expected::Empty, identity!(nothing, "no equation at all", "")),
    ];
    // Streams far from those of the identities.
    let streams = (0..).map(|place| u64::from(u32::MAX) + place);
    controls
        .into_iter()
        .zip(streams)
        .map(|((expected, identity), stream)| Control { proof: Proof::of(identity, seed, stream), expected })
        .collect()
}

fn wrong_sign<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let collision = free.collision();
    let scene = Scene::by_any_impulse(free, collision);
    let mut must = Equations::new();
    for side in scene.sides() {
        must.equal(side.momentum_gained(), scene.impact.impulse_on_ground.clone());
    }
    must
}

fn no_condition<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let collision = free.collision();
    let turned = Collision { crush_plane: free.crush_plane(), ..collision.clone() };
    let mut must = Equations::new();
    must.equal(Scene::sticking(inelastic(collision.clone())).impact.loss(), Scene::sticking(inelastic(turned.clone())).impact.loss());
    must.equal(Scene::sticking(collision).impact.loss(), Scene::sticking(turned).impact.loss());
    must
}

fn printed_a11<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let contact = free.contact();
    let l = PaperNotation::of(&contact.one, &contact.two, T::int(0), T::int(0));
    let mut must = Equations::new();
    must.equal((l.v_2n - l.d_a * l.omega_2) - (l.v_1n - l.d_c * l.omega_1), contact.approach.n);
    must
}

fn multiple<T: Field>(primes: &[u64], free: &mut Free<'_, T>) -> Equations<T> {
    let product = primes.iter().fold(T::int(1), |product, &prime| product * <T as FromPrimitive>::from_u64(prime).expect("an integer"));
    let mut must = Equations::new();
    must.equal(product * free.variable(), T::int(0));
    must
}

fn one_prime<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    multiple(&PRIMES[..1], free)
}

fn all_primes<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    multiple(&PRIMES, free)
}

fn nowhere_defined<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let x = free.variable();
    let infinite = (x.clone() - x).inv();
    let mut must = Equations::new();
    must.equal(infinite.clone(), infinite);
    must
}

fn nothing<T: Field>(_: &mut Free<'_, T>) -> Equations<T> {
    Equations::new()
}
