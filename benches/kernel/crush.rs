//! Benchmarks crush energy against the formula written by hand, its derivatives, and CRASH3.

use crate::COLLISIONS;
use crate::inputs::{self, collision_from_angles};
use criterion::{Criterion, Throughput};
use num_dual::Dual64;
use planar_impact::crash3::DamagedPair;
use planar_impact::crush::{CrushStiffness, ProfileMoments};
use std::hint::black_box;

/// Number of depths of the measuring protocol.
const DEPTHS: usize = 6;

/// A measured crush: width, depths, d₀, d₁.
struct Measured {
    width: f64,
    depths: [f64; DEPTHS],
    stiffness: CrushStiffness,
}

/// Returns depths of some decimeters that differ from one to the next.
fn measured() -> Vec<Measured> {
    let depth = |i: usize| 0.05 + 0.001 * ((i * 7919) % 601) as f64;
    let one = |i: usize| Measured {
        width: 1.2 + 0.001 * (i % 500) as f64,
        depths: std::array::from_fn(|j| depth(DEPTHS * i + j)),
        stiffness: CrushStiffness { onset: 80.0 + (i % 17) as f64, slope: 900.0 + (i % 101) as f64 },
    };
    (0..COLLISIONS).map(one).collect()
}

/// Computes the six-depth formula of textbooks.
fn by_hand(crush: &Measured) -> f64 {
    let [c1, c2, c3, c4, c5, c6] = crush.depths;
    let (w, d0, d1) = (crush.width, crush.stiffness.onset, crush.stiffness.slope);
    let k1 = w / 2.0;
    let k2 = w / 10.0 * (c1 + 2.0 * (c2 + c3 + c4 + c5) + c6);
    let squares = c1 * c1 + 2.0 * (c2 * c2 + c3 * c3 + c4 * c4 + c5 * c5) + c6 * c6;
    let k3 = w / 30.0 * (squares + c1 * c2 + c2 * c3 + c3 * c4 + c4 * c5 + c5 * c6);
    d0 * d0 * k1 + d0 * d1 * k2 + d1 * d1 * k3
}

fn generic(crush: &Measured) -> f64 {
    crush.stiffness.crush_energy(ProfileMoments::of(crush.width, &crush.depths).expect("six depths"))
}

/// Computes ∂E_C/∂C₃.
fn by_a_depth(crush: &Measured) -> Dual64 {
    let depths: [Dual64; DEPTHS] = std::array::from_fn(|i| Dual64::new(crush.depths[i], f64::from(u8::from(i == 2))));
    let stiffness = CrushStiffness { onset: crush.stiffness.onset.into(), slope: crush.stiffness.slope.into() };
    stiffness.crush_energy(ProfileMoments::of(crush.width.into(), &depths).expect("six depths"))
}

pub fn crush(c: &mut Criterion) {
    let crushes = measured();
    assert!(crushes.iter().all(|crush| (by_hand(crush) / generic(crush) - 1.0).abs() < 1e-13), "both compute the same");
    let mut group = c.benchmark_group("crush");
    group.throughput(Throughput::Elements(COLLISIONS as u64));
    macro_rules! each {
        ($name:literal, $compute:expr) => {
            group.bench_function($name, |b| {
                b.iter(|| {
                    for crush in black_box(&crushes) {
                        black_box($compute(crush));
                    }
                });
            });
        };
    }
    each!("hand-written six depths", by_hand);
    each!("generic six depths", generic);
    each!("generic six depths, by one of them", by_a_depth);
    let cases: Vec<_> = inputs::cases(COLLISIONS).iter().map(collision_from_angles::<f64>).collect();
    group.bench_function("CRASH3 of a collision, direction of force included", |b| {
        b.iter(|| {
            for collision in black_box(&cases) {
                black_box(DamagedPair::of_collision(collision, [80e3, 60e3]).evaluate());
            }
        });
    });
    group.finish();
}
