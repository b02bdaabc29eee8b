//! Crush energy from residual crush.

use planar_impact::crush::{CrushStiffness, Profile, ProfileMoments, equivalent_energy_speed_squared};
use planar_impact::{Body, Contact, Field, Nt, Work};

use super::{Identity, identity};
use crate::equation::Equations;
use crate::free::Free;

pub(super) fn all() -> Vec<Identity> {
    vec![
        identity!(flat_profile, "crush energy of a flat profile", "E* = d₀ + d₁ C:  w E*² = 2 E_C", "Eqs 3, 4"),
        identity!(profile, "crush energy of six depths", "E_C = ½ ∫ (d₀ + d₁ C)² dw, C linear between the depths", "Eq 4"),
        identity!(refined, "more depths on the same lines change nothing", "E_C from the depths and their midpoints is E_C", "Eq 4"),
        identity!(split, "the energy of a width is that of its parts", "E_C of two profiles side by side is the sum", "Eq 4"),
        identity!(series, "a series of barrier tests adds up", "½ m EES² = −Σ W_n,  EES² = Σ (1 − e²) v_n²", "Eq 9"),
    ]
}

/// Number of depths of the measuring protocol.
const DEPTHS: usize = 6;

fn stiffness<T: Field>(free: &mut Free<'_, T>) -> CrushStiffness<T> {
    CrushStiffness { onset: free.variable(), slope: free.variable() }
}

fn energy<T: Field>(stiffness: &CrushStiffness<T>, width: T, depths: &[T]) -> T {
    stiffness.crush_energy(ProfileMoments::of(width, depths).expect("two depths or more"))
}

fn flat_profile<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let (stiffness, width, depth) = (stiffness(free), free.variable(), free.variable());
    let energy = energy(&stiffness, width.clone(), &[depth.clone(), depth.clone(), depth.clone()]);
    let mut must = Equations::new();
    must.equal(width * stiffness.crush_intensity(depth).squared(), T::int(2) * energy);
    must
}

fn profile<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let (stiffness, width) = (stiffness(free), free.variable());
    let depths: [T; DEPTHS] = core::array::from_fn(|_| free.variable());
    let step = width.clone() / T::int(DEPTHS as i32 - 1);
    // Simpson's rule is exact for the square of a line.
    let integral = depths.windows(2).fold(T::int(0), |sum, ends| {
        let [a, b] = [&ends[0], &ends[1]].map(|depth| stiffness.onset.clone() + stiffness.slope.clone() * depth.clone());
        let middle = (a.clone() + b.clone()).half();
        sum + step.clone() * (a.squared() + T::int(4) * middle.squared() + b.squared()) / T::int(6)
    });
    let mut must = Equations::new();
    must.equal(energy(&stiffness, width, &depths), integral.half());
    must
}

fn refined<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let (stiffness, width) = (stiffness(free), free.variable());
    let depths: [T; DEPTHS] = core::array::from_fn(|_| free.variable());
    let middles = depths.windows(2).map(|ends| (ends[0].clone() + ends[1].clone()).half());
    let mut fine: Vec<T> = depths.iter().cloned().zip(middles).flat_map(|(depth, middle)| [depth, middle]).collect();
    fine.extend(depths.last().cloned());
    let mut must = Equations::new();
    must.equal(energy(&stiffness, width.clone(), &fine), energy(&stiffness, width, &depths));
    must
}

fn split<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let stiffness = stiffness(free);
    let [stations, depths]: [[T; DEPTHS]; 2] = core::array::from_fn(|_| core::array::from_fn(|_| free.variable()));
    let energy = |range: core::ops::Range<usize>| {
        let profile = Profile::at_stations_unchecked(stations[range.clone()].to_vec(), depths[range].to_vec());
        profile.ok().map_or(T::int(0), |profile| stiffness.crush_energy(profile.moments()))
    };
    let mut must = Equations::new();
    must.equal(energy(0..DEPTHS), energy(0..3) + energy(2..DEPTHS));
    must
}

fn series<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let car = free.body();
    // C straight ahead along n, and no yaw rate: the normal impulse is central, as Eq 9 assumes.
    let central =
        |speed: Nt<T>| Body { arm: Nt { n: car.arm.n.clone(), t: T::int(0) }, velocity: speed, yaw_rate: T::int(0), ..car.clone() };
    let tests: [(Nt<T>, T); 3] = core::array::from_fn(|_| (free.nt(), free.variable()));
    let work = tests.iter().fold(T::int(0), |sum, (speed, e)| {
        let contact = Contact::between(central(speed.clone()), Body::fixed());
        let v = contact.approach.clone();
        let impulse = contact.compliance.impulse_for(Nt { n: (T::int(1) + e.clone()) * v.n.clone(), t: v.t.clone() });
        sum + Work::of(impulse.clone(), v, contact.separation(impulse)).n
    });
    let squared = equivalent_energy_speed_squared(tests.into_iter().map(|(speed, e)| (speed.n, e)));
    let mut must = Equations::new();
    must.equal((squared / car.inverse_mass).half(), -work);
    must
}
