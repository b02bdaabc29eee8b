//! Random collisions composed of small integers and their ratios.

use crate::rational::Rational;
use planar_impact::*;
use proptest::prelude::*;
use proptest::test_runner::{Config, FileFailurePersistence, RngSeed};

/// Runs 10⁴ cases per law unless `PROPTEST_CASES` sets another number; failures are saved next to the law that
/// failed. The cases are the same in every run, so that only a change of the code makes a test fail;
/// `PROPTEST_RNG_SEED` draws others.
///
/// A law fails if it rejects more cases than it tests, by a filter or by an assumption: its generator is then wrong.
pub fn config() -> Config {
    fewer(1)
}

/// Runs one case in `one_in`, for slow tests, and always some.
pub fn fewer(one_in: u32) -> Config {
    let in_environment = |name| std::env::var_os(name).is_some();
    let of_environment = Config::default();
    let cases = if in_environment("PROPTEST_CASES") { of_environment.cases } else { 10_000 };
    let cases = (cases / one_in).max(32);
    Config {
        cases,
        max_global_rejects: cases,
        max_local_rejects: cases,
        rng_seed: if in_environment("PROPTEST_RNG_SEED") { of_environment.rng_seed } else { RngSeed::Fixed(1) },
        failure_persistence: Some(Box::new(FileFailurePersistence::WithSource("regressions"))),
        ..of_environment
    }
}

/// Rejects a case that has no value to test.
pub trait OrReject<T> {
    fn or_reject(self, why: &str) -> Result<T, TestCaseError>;
}

impl<T> OrReject<T> for Option<T> {
    fn or_reject(self, why: &str) -> Result<T, TestCaseError> {
        self.ok_or_else(|| TestCaseError::reject(why.to_owned()))
    }
}

impl<T, E> OrReject<T> for Result<T, E> {
    fn or_reject(self, why: &str) -> Result<T, TestCaseError> {
        self.ok().or_reject(why)
    }
}

/// Returns the bits of a float, those of one NaN for all of them.
pub fn bits(x: f64) -> u64 {
    if x.is_nan() { f64::NAN.to_bits() } else { x.to_bits() }
}

/// n/d, in any field.
#[derive(Clone, Copy, Debug)]
pub struct Fraction(pub i32, pub i32);

impl Fraction {
    pub fn of<T: Field>(self) -> T {
        T::int(self.0) / T::int(self.1)
    }
}

#[derive(Clone, Copy, Debug)]
pub struct VehicleDraw {
    pub mass: i32,
    pub yaw_inertia: i32,
    /// Tangent of half the heading.
    pub heading: Fraction,
    pub impact_center: (i32, i32),
    pub velocity: (i32, i32),
    pub yaw_rate: i32,
}

#[derive(Clone, Copy, Debug)]
pub struct Draw {
    pub one: VehicleDraw,
    pub two: VehicleDraw,
    /// `true` if vehicle 2 is replaced by a barrier.
    pub barrier: bool,
    /// Tangent of half of Γ.
    pub crush_plane: Fraction,
    pub restitution: Fraction,
    pub ratio: RatioDraw,
    pub law: Law,
}

#[derive(Clone, Copy, Debug)]
pub enum RatioDraw {
    Critical,
    Given(Fraction),
    OfCritical(Fraction),
    LimitedByFriction(Fraction),
}

impl VehicleDraw {
    pub fn of<T: Field>(&self) -> Vehicle<T> {
        let int = T::int;
        Vehicle {
            mass: int(self.mass),
            yaw_inertia: int(self.yaw_inertia),
            heading: Heading::from_half_tangent(self.heading.of()),
            impact_center: ForwardLeft { forward: int(self.impact_center.0), left: int(self.impact_center.1) },
            motion: Motion { velocity: Xy { x: int(self.velocity.0), y: int(self.velocity.1) }, yaw_rate: int(self.yaw_rate) },
        }
    }
}

impl Draw {
    /// Returns the collision in a given field.
    pub fn of<T: Field>(&self) -> Collision<T> {
        Collision {
            one: Party::Vehicle(self.one.of()),
            two: if self.barrier { Party::Barrier } else { Party::Vehicle(self.two.of()) },
            crush_plane: CrushPlane::from_half_tangent(self.crush_plane.of()),
            restitution: self.restitution.of(),
            impulse_ratio: match self.ratio {
                RatioDraw::Critical => ImpulseRatio::Critical,
                RatioDraw::Given(ratio) => ImpulseRatio::Given(ratio.of()),
                RatioDraw::OfCritical(fraction) => ImpulseRatio::OfCritical(fraction.of()),
                RatioDraw::LimitedByFriction(friction) => ImpulseRatio::LimitedByFriction(friction.of()),
            },
            law: self.law,
            moment: Moment::None,
        }
    }

    pub fn exact(&self) -> Collision<Rational> {
        self.of()
    }

    /// Reverses every motion if the vehicles are separating, so that they approach each other.
    pub fn closing(self) -> Draw {
        let contact = self.of::<f64>().contact();
        if contact.approach.n * contact.offset().n < 0.0 {
            return self;
        }
        let reversed = |vehicle: VehicleDraw| {
            let (x, y) = vehicle.velocity;
            VehicleDraw { velocity: (-x, -y), yaw_rate: -vehicle.yaw_rate, ..vehicle }
        };
        Draw { one: reversed(self.one), two: reversed(self.two), ..self }
    }

    pub fn is_solved(&self) -> bool {
        self.of::<f64>().solve().is_ok()
    }

    /// Returns `true` if the impulse can be computed in rationals, which have no infinity: the ratio does not wedge
    /// the pair, and a fraction of the critical ratio is a fraction of a finite number.
    pub fn is_computable(&self) -> bool {
        let collision = self.exact();
        let contact = collision.contact();
        match &collision.impulse_ratio {
            ImpulseRatio::Given(ratio) => contact.compliance.along_ratio(ratio.clone()) != Rational::int(0),
            ImpulseRatio::OfCritical(fraction) => {
                let critical = Collision { impulse_ratio: ImpulseRatio::Critical, ..collision.clone() };
                let sticking = critical.impulse(&contact).0;
                if sticking.n == Rational::int(0) {
                    return false;
                }
                let ratio = fraction.clone() * sticking.t / sticking.n;
                contact.compliance.along_ratio(ratio) != Rational::int(0)
            }
            _ => true,
        }
    }
}

fn fraction(numerator: std::ops::RangeInclusive<i32>, denominator: i32) -> impl Strategy<Value = Fraction> {
    numerator.prop_map(move |n| Fraction(n, denominator))
}

/// Generates half-angle tangents of directions all around, including a quarter turn; simple ones first.
pub fn half_tangent() -> impl Strategy<Value = Fraction> {
    (-5..=5_i32, 1..=3_i32).prop_map(|(n, d)| Fraction(n, d))
}

pub fn vehicle() -> impl Strategy<Value = VehicleDraw> {
    let impact_center = (-5..=5_i32, -5..=5_i32);
    let velocity = (-9..=9_i32, -9..=9_i32);
    (1..=40_i32, 1..=60_i32, half_tangent(), impact_center, velocity, -4..=4_i32).prop_map(
        |(mass, yaw_inertia, heading, impact_center, velocity, yaw_rate)| VehicleDraw {
            mass,
            yaw_inertia,
            heading,
            impact_center,
            velocity,
            yaw_rate,
        },
    )
}

pub fn ratio() -> impl Strategy<Value = RatioDraw> {
    prop_oneof![
        Just(RatioDraw::Critical),
        fraction(-8..=8, 4).prop_map(RatioDraw::Given),
        fraction(0..=8, 8).prop_map(RatioDraw::OfCritical),
        fraction(0..=8, 6).prop_map(RatioDraw::LimitedByFriction),
    ]
}

/// Generates any collision, closing or not: the equations hold for both.
pub fn draw() -> impl Strategy<Value = Draw> {
    let law = prop_oneof![Just(Law::Brach), Just(Law::KudlichSlibar)];
    (vehicle(), vehicle(), proptest::bool::weighted(0.2), half_tangent(), fraction(0..=8, 8), ratio(), law).prop_map(
        |(one, two, barrier, crush_plane, restitution, ratio, law)| Draw { one, two, barrier, crush_plane, restitution, ratio, law },
    )
}

/// Generates any collision whose impulse can be computed.
pub fn computable() -> impl Strategy<Value = Draw> {
    draw().prop_filter("the impulse divides by zero", Draw::is_computable)
}

/// Generates collisions that can be solved.
pub fn solved() -> impl Strategy<Value = Draw> {
    draw().prop_map(Draw::closing).prop_filter("refused", Draw::is_solved)
}

/// Generates collisions at common velocity: e = 0, μ = μ₀.
pub fn common_velocity() -> impl Strategy<Value = Draw> {
    draw().prop_map(|draw| Draw { restitution: Fraction(0, 1), ratio: RatioDraw::Critical, ..draw })
}
