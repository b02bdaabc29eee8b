"""Checks of posterior.py:  python3 posterior.py --check [CASE…]

The table is not used. Each check prints its numbers; the last line says whether all of them hold.
"""
import math

import numpy as np

import posterior as P


def eight_equations(problem, x):
    """The collision at one point by linear momentum, angular momentum and two conditions at the contact: one linear system of the motions and the impulse."""
    at = {**problem.certain, **dict(zip(problem.unknowns, x))}
    plane, e, share = (at["contact." + key] for key in ("crush_plane", "restitution", "impulse_ratio.of_critical"))
    n, t = (math.cos(plane), math.sin(plane)), (-math.sin(plane), math.cos(plane))
    bodies = []
    for number in (1, 2):
        if problem.barrier[number - 1]:
            continue
        get = lambda key: at[f"vehicle.{number}.{key}"]
        mass = get("mass")
        inertia = at.get(f"vehicle.{number}.yaw_inertia") or mass * get("radius_of_gyration") ** 2
        c, s = math.cos(get("heading")), math.sin(get("heading"))
        forward, left = get("impact_center.forward"), get("impact_center.left")
        bodies.append((mass, inertia, (c * get("speed"), s * get("speed")), (c * forward - s * left, s * forward + c * left)))
    size = 3 * len(bodies) + 2
    signs = (1, -1)

    def solve(last_row, last_value):
        matrix, right = np.zeros((size, size)), np.zeros(size)
        before = {"n": 0.0, "t": 0.0}
        rows = {"n": np.zeros(size), "t": np.zeros(size)}
        for k, (mass, inertia, velocity, arm) in enumerate(bodies):
            i, sign = 3 * k, signs[k]
            # m V - P = m v, I Omega - r x P = 0, with P = P_n n + P_t t in the last two columns.
            for axis in (0, 1):
                matrix[i + axis, i + axis] = mass
                matrix[i + axis, -2:] = -sign * n[axis], -sign * t[axis]
                right[i + axis] = mass * velocity[axis]
            matrix[i + 2, i + 2] = inertia
            matrix[i + 2, -2:] = [-sign * (arm[0] * u[1] - arm[1] * u[0]) for u in (n, t)]
            for axis, u in (("n", n), ("t", t)):
                before[axis] -= sign * (velocity[0] * u[0] + velocity[1] * u[1])
                rows[axis][i:i + 3] -= sign * np.array([u[0], u[1], arm[0] * u[1] - arm[1] * u[0]])
        matrix[-2], right[-2] = rows["n"], -e * before["n"]
        if last_row == "sticking":
            matrix[-1], right[-1] = rows["t"], 0.0
        else:
            matrix[-1, -2:] = -last_value, 1.0
        scale = np.abs(matrix).max(axis=1)
        return np.linalg.solve(matrix / scale[:, None], right / scale), rows, before

    found, rows, before = solve("sticking", None)
    found, rows, before = solve("ratio", share * found[-1] / found[-2])
    after = {axis: rows[axis] @ found for axis in "nt"}
    works = {axis: -0.5 * p * (before[axis] + after[axis]) for axis, p in (("n", found[-2]), ("t", found[-1]))}
    out = {"contact.closing_speed": abs(before["n"]), "energy.normal_work": works["n"], "energy.tangential_work": works["t"],
           "energy.loss": sum(0.5 * m * (v[0] ** 2 + v[1] ** 2 - found[3 * k] ** 2 - found[3 * k + 1] ** 2) - 0.5 * i * found[3 * k + 2] ** 2
                              for k, (m, i, v, _) in enumerate(bodies)),
           "contact.impulse_ratio": found[-1] / found[-2]}
    for k, (_, _, velocity, _) in enumerate(bodies):
        name = f"vehicle.{k + 1}."
        out |= {name + "separation_velocity.x": found[3 * k], name + "separation_velocity.y": found[3 * k + 1],
                name + "separation_yaw_rate": found[3 * k + 2],
                name + "delta_v_magnitude": math.hypot(found[3 * k] - velocity[0], found[3 * k + 1] - velocity[1])}
    return out


def forward_model(problem, made):
    """The largest relative difference of the vectorised model from the eight equations; energies relative to the loss."""
    z, _ = made.draw(np.random.default_rng(3).random((made.n, 500)))
    x = made.place(z)
    found, possible = problem.forward(x)
    worst = 0.0
    for i in np.flatnonzero(possible):
        other = eight_equations(problem, x[:, i])
        for key, value in other.items():
            size = abs(other["energy.loss"]) if key.startswith("energy") else max(1.0, abs(value))
            worst = max(worst, abs(found[key][i] - value) / size)
    return worst


def direct_grid(problem, box):
    """Statistics by a plain grid in the unknowns themselves, with one point at random in each cell: without weights of a step function, turned axes or Sobol points."""
    n = len(box)
    cells = {2: 2000, 3: 160, 4: 44}[n]
    rng = np.random.default_rng(8)
    keep = problem.unknowns + problem.derived
    values, weight = {key: [] for key in keep}, []
    for part in P.chunks(cells**n, 2**19):
        index = np.array(np.unravel_index(np.arange(part.start, part.stop), (cells,) * n))
        x = box[:, :1] + (index + rng.random(index.shape)) / cells * (box[:, 1:] - box[:, :1])
        lp, found = problem.log_density(x, with_found=True)
        inside = lp > -40
        weight.append(np.exp(lp[inside]))
        for key in keep:
            values[key].append(np.broadcast_to(found[key], lp.shape)[inside])
    return P.statistics({key: np.concatenate(parts) for key, parts in values.items()}, np.concatenate(weight), P.PROBABILITIES[problem.name])


def by_emcee(problem, made, walkers=64, steps=8000):
    """Runs emcee; returns the statistics and the number of independent points."""
    import emcee
    np.random.seed(4)
    rng = np.random.default_rng(4)
    z, q = made.draw(rng.random((made.n, 4000)))
    x = made.place(z)
    lp = problem.log_density(x)
    chance = np.where(np.isfinite(lp), np.exp(lp - made.top) / q, 0)
    start = x[:, rng.choice(len(lp), walkers, replace=False, p=chance / chance.sum())].T
    moves = [(emcee.moves.StretchMove(), 0.5), (emcee.moves.DEMove(), 0.4), (emcee.moves.DEMove(gamma0=1.0), 0.1)]
    sampler = emcee.EnsembleSampler(walkers, made.n, lambda at: problem.log_density(at.T), vectorize=True, moves=moves)
    sampler.run_mcmc(start, steps)
    worth = walkers * steps / float(np.max(sampler.get_autocorr_time(quiet=True)))
    flat = sampler.get_chain(discard=1000, flat=True).T
    found, _ = problem.forward(flat)
    keep = problem.unknowns + problem.derived
    return P.statistics({key: found[key] for key in keep}, np.ones(flat.shape[1]), P.PROBABILITIES[problem.name]), worth


def largest(one, other, whole, skip=("hdi",)):
    """The largest difference in posterior standard deviations (probabilities as they are), and where."""
    size = lambda key: 1.0 if key[1] == "probability" else whole[key[0], "sd"]
    keys = [key for key in one if not key[1].startswith(skip)]
    return max((abs(one[key] - other[key]) / size(key), key) for key in keys)


def run(names):
    good = True
    for name in names:
        problem = P.Problem(name)
        whole, error, useful, made = P.posterior(problem)
        print(f"{name}: useful share of the points {useful:.3f}")
        size = lambda key: 1.0 if key[1] == "probability" else whole[key[0], "sd"]
        for what, keys in (("all but hdi", [k for k in whole if not k[1].startswith("hdi")]), ("hdi", [k for k in whole if k[1].startswith("hdi")])):
            print(f"  largest standard error in sd, {what}: {max((error[k] / size(k), k) for k in keys)}")
        off = forward_model(problem, made)
        good &= off < 1e-10
        print(f"  forward model and eight equations: {off:.1e}")
        half, half_error, _, _ = P.posterior(problem, points=P.POINTS // 4, seed=2, cells=made.cells * 3 // 4)
        far = largest(half, whole, whole)
        ends = largest(half, whole, whole, skip=("mean", "sd", "q", "prob"))
        score = max((abs(half[k] - whole[k]) / max(math.hypot(half_error[k], error[k]), 1e-12 * abs(whole[k]) + 1e-300), k) for k in whole if not k[1].startswith("hdi"))
        good &= score[0] < 6
        print(f"  a quarter of the points, other cells and seeds, in sd: {far}; hdi {ends}; in standard errors {score}")
        direct = direct_grid(problem, made.box)
        far = largest(direct, whole, whole)
        ends = largest(direct, whole, whole, skip=("mean", "sd", "q", "prob"))
        good &= far[0] < 2e-2
        print(f"  plain grid with a point in each cell, in sd: {far}; hdi {ends}")
        ensemble, worth = by_emcee(problem, made)
        far = largest(ensemble, whole, whole)
        good &= far[0] < 10 / math.sqrt(worth)
        print(f"  emcee, worth {worth:.0f} independent points, in sd: {far}, or {far[0] * math.sqrt(worth):.1f} / sqrt of the worth")
        if name == "open":
            # The evidence depends on (1 + e) v_1 and v_2 alone: the density of e is proportional to 1/(1 + e).
            e = "contact.restitution"
            exact = {(e, f"q{p}"): 1.3**p - 1 for p in P.QUANTILES}
            exact |= {(e, "mean"): 0.3 / math.log(1.3) - 1, (e, "hdi_low"): 0.0, (e, "hdi_high"): 1.3**0.95 - 1}
            worst = max(abs(whole[key] - value) for key, value in exact.items())
            good &= worst < 1e-5
            print(f"  closed form of the density of e: {worst:.1e}")
    print("all hold" if good else "NOT ALL HOLD")
    return 0 if good else 1
