#!/usr/bin/env python3
"""Compare `planar-impact uncertainty` with NumPy, JAX, OpenTURNS and SALib on one case of six uncertain inputs.

    cargo build --release -p planar-impact-cli
    pip install -r benches/peers/requirements.txt
    benches/peers/uncertainty.py

Every peer has one thread and the same vectorised mechanics, which checks nothing; the inputs are drawn by its own means. Times are those of the processor: of a
peer for the computation alone, of the program for the whole process, from the start to the JSON. JAX has compiled its program before. Agreement is the largest difference of two estimates in
standard errors of that difference.
"""

import json
import math
import os
import resource
import subprocess
import sys
import time
from pathlib import Path

for threads in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[threads] = "1"
os.environ["XLA_FLAGS"] = "--xla_cpu_multi_thread_eigen=false intra_op_parallelism_threads=1"
os.environ["JAX_ENABLE_X64"] = "1"

import jax
import jax.numpy as jnp
import numpy as np
import openturns as ot
from SALib.analyze import sobol as analysis
from SALib.sample import sobol as sampling
from scipy import stats

from mechanics import mechanics

PROGRAM = Path(os.environ.get("PLANAR_IMPACT", Path(__file__).parents[2] / "target/release/planar-impact"))
SAMPLES, PAIRS, REPEATS = 1_000_000, 1 << 15, 5
KMH, DEG = 1 / 3.6, math.pi / 180
OUTPUTS = ("vehicle.1.delta_v_magnitude", "vehicle.2.delta_v_magnitude", "energy.normal_work", "energy.loss")
QUANTILES = (0.025, 0.25, 0.5, 0.75, 0.975)

# Name, how the file has it, how scipy and OpenTURNS have it.
INPUTS = [
    ("vehicle.1.mass", "1450 kg ± 40 kg", stats.norm(1450, 40), ot.Normal(1450, 40)),
    ("vehicle.1.speed", "52 km/h ± 3 km/h", stats.norm(52 * KMH, 3 * KMH), ot.Normal(52 * KMH, 3 * KMH)),
    ("vehicle.2.mass", "2180 kg ± 60 kg", stats.norm(2180, 60), ot.Normal(2180, 60)),
    ("vehicle.2.speed", {"min": "36 km/h", "max": "46 km/h"}, stats.uniform(36 * KMH, 10 * KMH), ot.Uniform(36 * KMH, 46 * KMH)),
    ("contact.crush_plane", {"min": "-8 deg", "max": "8 deg"}, stats.uniform(-8 * DEG, 16 * DEG), ot.Uniform(-8 * DEG, 8 * DEG)),
    ("contact.restitution", {"min": 0, "mode": 0.1, "max": 0.3}, stats.triang(1 / 3, 0, 0.3), ot.Triangular(0, 0.1, 0.3)),
]
NAMES = [name for name, *_ in INPUTS]
FIXED = {
    "vehicle.1.yaw_inertia": 2413.0, "vehicle.1.heading": 0.0, "vehicle.1.yaw_rate": 0.0, "vehicle.1.impact_center.forward": 1.9, "vehicle.1.impact_center.left": 0.35,
    "vehicle.2.yaw_inertia": 4583.0, "vehicle.2.heading": 118 * DEG, "vehicle.2.yaw_rate": 0.0, "vehicle.2.impact_center.forward": 2.1, "vehicle.2.impact_center.left": -0.4,
}


def case():
    of = {name: written for name, written, *_ in INPUTS}
    vehicle = lambda i: {
        "mass": of[f"vehicle.{i}.mass"], "yaw_inertia": FIXED[f"vehicle.{i}.yaw_inertia"], "heading": FIXED[f"vehicle.{i}.heading"], "speed": of[f"vehicle.{i}.speed"],
        "impact_center": [FIXED[f"vehicle.{i}.impact_center.{part}"] for part in ("forward", "left")]}
    contact = {key: of[f"contact.{key}"] for key in ("crush_plane", "restitution")}
    return json.dumps({"schema": 1, "vehicle": [vehicle(1), vehicle(2)], "contact": contact})


def outputs(columns, of=np):
    get = lambda name: columns.get(name, FIXED.get(name))
    found = mechanics(get, of.sin, of.cos, of.sqrt, of.arctan2)
    return of.stack([found[name] for name in OUTPUTS], axis=-1)


def with_program(*more):
    """-> the answer, and the time of the processor."""
    call = [PROGRAM, "uncertainty", "-", "--format", "json", "--of", ",".join(OUTPUTS), *more]
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    run = subprocess.run(call, input=case().encode(), capture_output=True, check=True, env=os.environ | {"RAYON_NUM_THREADS": "1"})
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return json.loads(run.stdout), after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def timed(compute):
    before = time.process_time()
    found = compute()
    return found, time.process_time() - before


def least(compute):
    """-> the answer of one run, and the shortest of some times."""
    runs = [compute() for _ in range(REPEATS)]
    return runs[0][0], min(seconds for _, seconds in runs)


def numpy_samples():
    rng = np.random.default_rng(1)
    columns = {
        "vehicle.1.mass": rng.normal(1450, 40, SAMPLES), "vehicle.1.speed": rng.normal(52 * KMH, 3 * KMH, SAMPLES), "vehicle.2.mass": rng.normal(2180, 60, SAMPLES),
        "vehicle.2.speed": rng.uniform(36 * KMH, 46 * KMH, SAMPLES), "contact.crush_plane": rng.uniform(-8 * DEG, 8 * DEG, SAMPLES),
        "contact.restitution": rng.triangular(0, 0.1, 0.3, SAMPLES)}
    found = outputs(columns)
    return found.mean(axis=0), found.std(axis=0, ddof=1), np.quantile(found, QUANTILES, axis=0)


@jax.jit
def jax_summary(key):
    keys = dict(zip(NAMES, jax.random.split(key, len(NAMES))))
    normal = lambda name, mean, sd: mean + sd * jax.random.normal(keys[name], (SAMPLES,))
    uniform = lambda name, low, high: jax.random.uniform(keys[name], (SAMPLES,), minval=low, maxval=high)
    found = outputs({
        "vehicle.1.mass": normal("vehicle.1.mass", 1450, 40), "vehicle.1.speed": normal("vehicle.1.speed", 52 * KMH, 3 * KMH),
        "vehicle.2.mass": normal("vehicle.2.mass", 2180, 60), "vehicle.2.speed": uniform("vehicle.2.speed", 36 * KMH, 46 * KMH),
        "contact.crush_plane": uniform("contact.crush_plane", -8 * DEG, 8 * DEG),
        "contact.restitution": jax.random.triangular(keys["contact.restitution"], 0, 0.1, 0.3, (SAMPLES,))}, jnp)
    return found.mean(axis=0), found.std(axis=0, ddof=1), jnp.quantile(found, jnp.array(QUANTILES), axis=0)


def jax_samples():
    return [np.asarray(found) for found in jax_summary(jax.random.key(1))]


def openturns_samples():
    ot.RandomGenerator.SetSeed(1)
    drawn = np.asarray(ot.JointDistribution([of for *_, of in INPUTS]).getSample(SAMPLES))
    found = ot.Sample(outputs(dict(zip(NAMES, drawn.T))))
    quantiles = [np.array(found.computeQuantilePerComponent(p)) for p in QUANTILES]
    return np.array(found.computeMean()), np.array(found.computeStandardDeviation()), np.array(quantiles)


def salib_shares(resamples):
    problem = {"num_vars": len(NAMES), "names": NAMES, "bounds": [[0, 1]] * len(NAMES)}
    points = np.clip(sampling.sample(problem, PAIRS, calc_second_order=False, seed=1), 1e-12, 1 - 1e-12)
    found = outputs({name: of.ppf(points[:, i]) for i, (name, _, of, _) in enumerate(INPUTS)})
    analyze = lambda of: analysis.analyze(problem, of, calc_second_order=False, num_resamples=resamples, conf_level=0.6826894921, seed=1)
    return [analyze(found[:, k]) for k in range(len(OUTPUTS))]


def openturns_shares():
    ot.RandomGenerator.SetSeed(1)
    design = ot.SobolIndicesExperiment(ot.JointDistribution([of for *_, of in INPUTS]), PAIRS, False).generate()
    found = outputs(dict(zip(NAMES, np.asarray(design).T)))
    shares = [ot.JansenSensitivityAlgorithm(design, ot.Sample(found[:, [k]]), PAIRS) for k in range(len(OUTPUTS))]
    for one in shares:
        one.setUseAsymptoticDistribution(True)
    intervals = lambda one: (one.getFirstOrderIndices(), one.getTotalOrderIndices(), one.getFirstOrderIndicesInterval(), one.getTotalOrderIndicesInterval())
    return [intervals(one) for one in shares]


def apart(differences):
    return f"{max(abs(one - other) / math.hypot(*errors) for one, other, errors in differences):.1f}"


def of_samples(answer, found):
    mean, sd, quantiles = found
    for k, name in enumerate(OUTPUTS):
        ours = answer["of"][name]["monte_carlo"]
        # Both have as many samples, and so the same standard errors.
        yield ours["mean"], mean[k], [ours["mean_se"]] * 2
        yield ours["sd"], sd[k], [ours["sd_se"]] * 2
        for p, value in zip(QUANTILES, quantiles[:, k]):
            yield ours["quantiles"][str(p)], value, [ours["quantiles_se"][str(p)]] * 2


def of_shares(answer, found):
    """`found` has for each output (first, total, and the standard errors of both) of each input."""
    for name, shares in zip(OUTPUTS, found):
        for i, parameter in enumerate(NAMES):
            ours = answer["of"][name]["sobol"][parameter]
            yield ours["first"], shares[0][i], (ours["first_se"], shares[2][i])
            yield ours["total"], shares[1][i], (ours["total_se"], shares[3][i])


def main():
    ot.TBB.Disable()
    print(f"{len(INPUTS)} uncertain inputs, {len(OUTPUTS)} outputs, one thread, processor time, the least of {REPEATS} runs\n")
    samples, seconds = least(lambda: with_program("--method", "monte-carlo", "--samples", str(SAMPLES)))
    print(f"mean, sd and five quantiles of {SAMPLES} samples")
    print(f"  planar-impact   {seconds:7.3f} s")
    for peer, compute in (("NumPy", numpy_samples), ("JAX", jax_samples), ("OpenTURNS", openturns_samples)):
        found, taken = least(lambda: timed(compute))
        print(f"  {peer:15} {taken:7.3f} s   {taken / seconds:5.1f} x   {apart(of_samples(samples, found))} standard errors apart")
    shares, seconds = least(lambda: with_program("--method", "sobol", "--samples", str(5 * PAIRS)))
    print(f"indices of Sobol', first and total, of {PAIRS} pairs of samples with their standard errors")
    print(f"  planar-impact   {seconds:7.3f} s")
    _, taken = least(lambda: timed(lambda: salib_shares(2)))
    print(f"  {'SALib':15} {taken:7.3f} s   {taken / seconds:5.1f} x   without standard errors")
    found, taken = least(lambda: timed(lambda: salib_shares(100)))
    of_salib = [(one["S1"], one["ST"], one["S1_conf"], one["ST_conf"]) for one in found]
    print(f"  {'':15} {taken:7.3f} s   {taken / seconds:5.1f} x   {apart(of_shares(shares, of_salib))} standard errors apart, those of 100 resamples")
    found, taken = least(lambda: timed(openturns_shares))
    half = lambda interval: (np.array(interval.getUpperBound()) - np.array(interval.getLowerBound())) / (2 * 1.959963984540054)
    of_openturns = [(first, total, half(of_first), half(of_total)) for first, total, of_first, of_total in found]
    print(f"  {'OpenTURNS':15} {taken:7.3f} s   {taken / seconds:5.1f} x   {apart(of_shares(shares, of_openturns))} standard errors apart")


if __name__ == "__main__":
    sys.exit(main())
