//! Benchmarks derivatives against the solution that they belong to.

use crate::COLLISIONS;
use crate::inputs::{self, Angles, collision_from_angles};
use criterion::{Criterion, Throughput};
use num_dual::Dual64;
use planar_impact::sensitivity::by_definition;
use planar_impact::{Collision, CrushPlane, Output, Outputs};
use std::cell::RefCell;
use std::hint::black_box;

/// Benchmarks a function on every collision, set up from its angles.
fn each<R>(c: &mut Criterion, group: &str, name: &str, compute: impl Fn(&Collision) -> R) {
    let cases: Vec<Angles<f64>> = inputs::cases(COLLISIONS);
    let mut group = c.benchmark_group(group);
    group.throughput(Throughput::Elements(COLLISIONS as u64));
    group.bench_function(name, |b| {
        b.iter(|| {
            for case in black_box(&cases) {
                black_box(&compute(&collision_from_angles(case)));
            }
        });
    });
    group.finish();
}

pub fn derivatives(c: &mut Criterion) {
    // All outputs, both with the checks of `solve` and without, by `evaluate`.
    each(c, "jacobian", "solve, all outputs", |collision| collision.solve().map(|impact| Outputs::of(collision, &impact)));
    each(c, "jacobian", "solve, all outputs by all inputs", |collision| collision.sensitivities());
    let kept = RefCell::new(Outputs::default());
    each(c, "jacobian", "solve, all outputs by all inputs, written to one place", |collision| {
        let solved = collision.sensitivities_to(&mut kept.borrow_mut()).is_ok();
        black_box(&kept);
        solved
    });
    each(c, "jacobian", "evaluate, all outputs", |collision| Outputs::of(collision, &collision.evaluate()));
    each(c, "jacobian", "evaluate, all outputs by all inputs", |collision| collision.sensitivities_of(&collision.evaluate()));
    each(c, "jacobian", "by definition, Dual64 for each input", by_definition);

    // One output. When only one is evaluated, the compiler omits what the others would need.
    each(c, "gradient", "solve, W_n", |collision| collision.solve().map(|impact| Output::NormalWork.of(collision, &impact)));
    each(c, "gradient", "solve, W_n by all inputs", |collision| collision.sensitivity(Output::NormalWork));
    each(c, "gradient", "evaluate, W_n alone", |collision| Output::NormalWork.of(collision, &collision.evaluate()));
    each(c, "gradient", "evaluate, W_n by all inputs", |collision| collision.sensitivity_of(&collision.evaluate(), Output::NormalWork));
    each(c, "gradient", "evaluate, W_n by the crush plane, Dual64", |collision| {
        let plane = collision.crush_plane.map(Dual64::from).turned(Dual64::new(0.0, 1.0));
        let seeded = Collision { crush_plane: CrushPlane { cos: plane.cos, sin: plane.sin }, ..collision.map(Dual64::from) };
        seeded.evaluate().work.n
    });

    each(c, "hessian", "solve, all outputs", |collision| collision.solve().map(|impact| Outputs::of(collision, &impact)));
    each(c, "hessian", "solve, W_n twice by all inputs", |collision| collision.curvature(Output::NormalWork));
    each(c, "hessian", "solve, dV1 twice by all inputs", |collision| {
        collision.curvature(Output::DeltaVMagnitude(planar_impact::Side::One))
    });
}
