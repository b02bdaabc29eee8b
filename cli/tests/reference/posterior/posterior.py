#!/usr/bin/env python3
"""Posteriors and profile-likelihood intervals of the reconstructions of this directory:

    pip install numpy==2.4.6 scipy==1.17.1 emcee==3.1.6
    python3 posterior.py > posterior.csv
    python3 posterior.py --check            # forward model, halved samples, direct grid, emcee, closed forms

Written for Python 3.11 with numpy 2.4.6, scipy 1.17.1 and, for --check alone, emcee 3.1.6. README.md describes the method.
"""
import csv
import itertools
import math
import pathlib
import re
import sys
import tomllib

import numpy as np
from scipy import optimize, special, stats

HERE = pathlib.Path(__file__).resolve().parent
NAMES = ["fold", "bound", "two-modes", "open", "regular", "shapes"]
PROBABILITIES = {
    "fold": "contact.crush_plane > 5 deg",
    "bound": "contact.impulse_ratio.of_critical > 0.95",
    "two-modes": "contact.crush_plane > -10 deg",
    "open": "vehicle.1.speed > 15 m/s",
    "regular": "vehicle.1.speed > 14 m/s",
    "shapes": "vehicle.1.speed > 13.5 m/s",
}
# The search replaces the shapes of this case by normal densities, so its profile is that of another problem.
NO_PROFILE = {"shapes"}
QUANTILES = [0.025, 0.05, 0.25, 0.5, 0.75, 0.95, 0.975]
LEVEL = 3.841459
REPLICATES, POINTS = 16, 2**17

# ------------------------------------------------------------------ units

LB, FT, G = 0.45359237, 0.3048, 9.80665
SLUG = LB * G / FT
UNITS = {"kg": 1, "lb": LB, "slug": SLUG, "m": 1, "cm": 0.01, "ft": FT, "m/s": 1, "ft/s": FT, "km/h": 1 / 3.6, "deg": math.pi / 180, "rad": 1,
         "deg/s": math.pi / 180, "rad/s": 1, "J": 1, "kJ": 1000, "kg m^2": 1, "slug ft^2": SLUG * FT * FT, "": 1}


def si(text):
    """A quantity in SI: a number, or a text with a unit."""
    if not isinstance(text, str):
        return float(text)
    number, unit = re.fullmatch(r"\s*([-+0-9.eE]+)\s*(.*?)\s*", text).groups()
    return float(number) * UNITS[unit]


# ------------------------------------------------------------------ densities

class Density:
    """What is known of a number beforehand. `log` is -inf outside of its limits; `residual` is None without a normal density."""

    def __init__(self, kind, low=-math.inf, high=math.inf, **numbers):
        self.kind, self.low, self.high = kind, low, high
        self.__dict__.update(numbers)

    def log(self, x):
        inside = (x >= self.low) & (x <= self.high)
        with np.errstate(all="ignore"):
            if self.kind == "flat":
                value = np.zeros_like(x)
            elif self.kind == "normal":
                value = -0.5 * ((x - self.value) / self.sd) ** 2
            elif self.kind == "triangular":
                value = np.log(np.where(x < self.mode, (x - self.low) / (self.mode - self.low), (self.high - x) / (self.high - self.mode)))
            elif self.kind == "log-normal":
                value = -0.5 * (np.log(x / self.median) / self.log_sd) ** 2 - np.log(x)
        return np.where(inside, value, -np.inf)

    def range(self):
        """Limits, or what a first look may leave out."""
        if self.kind == "normal":
            return max(self.low, self.value - 8 * self.sd), min(self.high, self.value + 8 * self.sd)
        if self.kind == "log-normal":
            return self.median * math.exp(-8 * self.log_sd), self.median * math.exp(8 * self.log_sd)
        return self.low, self.high


def density(given, domain):
    """The density of a table or text of the file, within the domain of the mechanics; None for a certain number."""
    low, high = domain
    if isinstance(given, str) and "±" in given:
        value, sd = given.split("±")
        return Density("normal", low, high, value=si(value), sd=si(sd))
    if not isinstance(given, dict):
        return None
    has = {key: si(value) for key, value in given.items()}
    low, high = max(low, has.get("min", low)), min(high, has.get("max", high))
    if "median" in has:
        return Density("log-normal", max(low, 0), high, median=has["median"], log_sd=math.log(has["factor"]))
    if "mode" in has:
        return Density("triangular", low, high, mode=has["mode"])
    if "sd" in has:
        return Density("normal", low, high, value=has["value"] if "value" in has else has["start"], sd=has["sd"])
    return Density("flat", low, high)


DOMAINS = {"restitution": (0, 1), "of_critical": (0, 1), "mass": (0, math.inf), "yaw_inertia": (0, math.inf), "radius_of_gyration": (0, math.inf)}
FIRST_LOOK = {"speed": (-10, 60), "crush_plane": (-math.pi / 2, math.pi / 2)}


# ------------------------------------------------------------------ mechanics

def turned(x, y, angle):
    """The components of a vector after a turn by an angle."""
    c, s = np.cos(angle), np.sin(angle)
    return c * x - s * y, s * x + c * y


class Body:
    """A vehicle in ground axes, or a barrier that nothing moves. Each number may be an array."""

    def __init__(self, numbers):
        self.barrier = numbers is None
        if self.barrier:
            self.w = self.j = self.vx = self.vy = self.rate = self.rx = self.ry = self.heading = self.mass = self.inertia = 0.0
            return
        self.mass = numbers["mass"]
        self.inertia = numbers["yaw_inertia"] if "yaw_inertia" in numbers else self.mass * numbers["radius_of_gyration"] ** 2
        self.w, self.j = 1 / self.mass, 1 / self.inertia
        self.heading = numbers["heading"]
        self.vx, self.vy = turned(numbers["speed"], 0.0, self.heading)
        self.rate = numbers.get("yaw_rate", 0.0)
        self.rx, self.ry = turned(numbers["forward"], numbers["left"], self.heading)

    def after(self, px, py):
        """Newton and Euler: the motion after an impulse at the impact center."""
        return self.vx + self.w * px, self.vy + self.w * py, self.rate + self.j * (self.rx * py - self.ry * px)

    def at_center(self, motion):
        x, y, rate = motion
        return x - rate * self.ry, y + rate * self.rx


def collide(one, two, plane, restitution, share):
    """The impact: momentum, restitution along the normal, and a share of the ratio that ends sliding. `possible` is where mechanics allows it."""
    nx, ny, tx, ty = np.cos(plane), np.sin(plane), -np.sin(plane), np.cos(plane)

    def relative(px, py):
        """Relative velocity at the impact center after an impulse on body one, along n and t."""
        ax, ay = one.at_center(one.after(px, py))
        bx, by = two.at_center(two.after(-px, -py))
        return (bx - ax) * nx + (by - ay) * ny, (bx - ax) * tx + (by - ay) * ty

    vn, vt = relative(0.0, 0.0)
    # The relative velocity is affine in the impulse: V = v + P_n c_n + P_t c_t. The columns are differences by impulses of the size of an impact's.
    size = 1e4
    nn, tn = ((after - before) / size for after, before in zip(relative(size * nx, size * ny), (vn, vt)))
    nt, tt = ((after - before) / size for after, before in zip(relative(size * tx, size * ty), (vn, vt)))
    determinant = nn * tt - nt * tn
    # V_n = -e v_n and V_t = 0.
    gain_n, gain_t = -(1 + restitution) * vn, -vt
    sticking_n, sticking_t = (gain_n * tt - nt * gain_t) / determinant, (nn * gain_t - tn * gain_n) / determinant
    with np.errstate(all="ignore"):
        ratio = share * sticking_t / sticking_n
        pn = gain_n / (nn + ratio * nt)
    pt = ratio * pn
    px, py = pn * nx + pt * tx, pn * ny + pt * ty
    un, ut = relative(px, py)
    normal_work, tangential_work = -0.5 * pn * (vn + un), -0.5 * pt * (vt + ut)
    offset = (one.rx - two.rx) * nx + (one.ry - two.ry) * ny
    loss = -(normal_work + tangential_work)
    # P acts on vehicle 1 against vehicle 2: compressive if P_n and v_n have one sign.
    possible = (vn * offset < 0) & (pn * vn > 0) & ((share == 0) | (sticking_n * vn > 0)) & (loss >= -1e-12 * np.abs(pn * vn))
    possible &= (restitution >= 0) & (restitution <= 1) & (share >= 0) & (share <= 1)
    found = {"contact.closing_speed": np.abs(vn), "energy.loss": loss, "energy.normal_work": normal_work, "crush_energy": -normal_work,
             "energy.tangential_work": tangential_work, "contact.impulse_ratio": ratio, "impulse.normal": pn, "impulse.tangential": pt}
    for number, body, sign in ((1, one, 1), (2, two, -1)):
        if body.barrier:
            continue
        name = f"vehicle.{number}."
        x, y, rate = body.after(sign * px, sign * py)
        forward, left = turned(sign * px * body.w, sign * py * body.w, -body.heading)
        found |= {name + "separation_velocity.x": x, name + "separation_velocity.y": y, name + "separation_yaw_rate": rate,
                  name + "separation_direction": np.arctan2(y, x), name + "separation_speed": np.hypot(x, y),
                  name + "delta_v_forward": forward, name + "delta_v_left": left, name + "delta_v_magnitude": np.hypot(forward, left),
                  name + "pdof": np.arctan2(left, -forward)}
    return found, possible


# ------------------------------------------------------------------ the problem of a file

def leaves(table, path=()):
    """Dotted names of a nested table, down to tables that describe one number."""
    for key, value in table.items():
        if isinstance(value, dict) and not set(value) & {"start", "value", "sd", "min", "max", "mode", "median"}:
            yield from leaves(value, path + (key,))
        elif isinstance(value, list):
            for axis, item in zip(("x", "y"), value):
                yield ".".join(path + (key, axis)), item
        else:
            yield ".".join(path + (key,)), value


class Problem:
    def __init__(self, name):
        self.name = name
        self.file = HERE / f"{name}.toml"
        case = tomllib.loads(self.file.read_text())
        self.certain, self.known = {}, {}
        self.barrier = [bool(vehicle.get("barrier")) for vehicle in case["vehicle"]]

        def take(key, given):
            found = density(given, DOMAINS.get(key.rsplit(".", 1)[1], (-math.inf, math.inf)))
            if found is None:
                self.certain[key] = si(given)
            else:
                self.known[key] = found

        for key, given in leaves(case["unknown"]):
            take(key, given)
        for number, vehicle in enumerate(case["vehicle"], 1):
            for key, given in vehicle.items():
                if key == "impact_center":
                    take(f"vehicle.{number}.impact_center.forward", given[0])
                    take(f"vehicle.{number}.impact_center.left", given[1])
                elif key not in ("name", "barrier"):
                    take(f"vehicle.{number}.{key}", given)
        for key, given in case["contact"].items():
            take(f"contact.{key}", given)
        self.certain.setdefault("contact.impulse_ratio.of_critical", 1.0)
        # Those between two bounds first: their bounds are then planes of the grid.
        self.unknowns = sorted(self.known, key=lambda key: not (math.isfinite(self.known[key].low) and math.isfinite(self.known[key].high)))
        self.evidence = []
        for key, given in leaves(case["evidence"]):
            of = density(given, (-math.inf, math.inf))
            self.evidence.append((key, of.value, of.sd))
        vehicles = [number for number in (1, 2) if not self.barrier[number - 1]]
        self.derived = [f"vehicle.{number}.{what}" for number in vehicles for what in ("delta_v_magnitude", "pdof")]
        self.derived += ["contact.closing_speed", "energy.loss", "energy.normal_work", "energy.tangential_work", "contact.impulse_ratio"]
        self.bounds = np.array([[self.known[key].low, self.known[key].high] for key in self.unknowns])

    def forward(self, x):
        """Every quantity at the unknowns x, of shape (number of unknowns, …), and where mechanics allows it."""
        at = {**self.certain, **{key: x[i] for i, key in enumerate(self.unknowns)}}
        bodies = []
        for number in (1, 2):
            prefix = f"vehicle.{number}."
            numbers = {key.rsplit(".", 1)[1]: value for key, value in at.items() if key.startswith(prefix)}
            bodies.append(Body(None if self.barrier[number - 1] else numbers))
        found, possible = collide(*bodies, at["contact.crush_plane"], at["contact.restitution"], at["contact.impulse_ratio.of_critical"])
        for body in bodies:
            possible = possible & (body.barrier or ((body.mass > 0) & (body.inertia > 0)))
        return {**found, **at}, possible

    def residuals(self, x):
        """Of the evidence, then of normal densities of unknowns; in standard deviations."""
        found, possible = self.forward(x)
        rows = []
        for key, value, sd in self.evidence:
            off = value - found[key]
            if key.endswith(("direction", "pdof")):
                off = (off + math.pi) % (2 * math.pi) - math.pi
            rows.append(off / sd)
        for i, key in enumerate(self.unknowns):
            if self.known[key].kind == "normal":
                rows.append((self.known[key].value - x[i]) / self.known[key].sd)
        return np.array(rows), possible

    def log_density(self, x, with_found=False):
        found, possible = self.forward(x)
        total = np.zeros(np.shape(x)[1:])
        with np.errstate(all="ignore"):
            for key, value, sd in self.evidence:
                off = value - found[key]
                if key.endswith(("direction", "pdof")):
                    off = (off + math.pi) % (2 * math.pi) - math.pi
                total = total - 0.5 * (off / sd) ** 2
            for i, key in enumerate(self.unknowns):
                total = total + self.known[key].log(x[i])
        total = np.where(possible & np.isfinite(total), total, -np.inf)
        return (total, found) if with_found else total

    def first_box(self):
        box = []
        for key in self.unknowns:
            low, high = self.known[key].range()
            if not (math.isfinite(low) and math.isfinite(high)):
                wide = FIRST_LOOK[key.rsplit(".", 1)[1]]
                low, high = max(low, wide[0]), min(high, wide[1])
            box.append((low, high))
        return np.array(box)


# ------------------------------------------------------------------ posterior by quadrature

def chunks(n, size=2**17):
    return [slice(i, min(i + size, n)) for i in range(0, n, size)]


class Posterior:
    """Randomised quasi-Monte Carlo with weights: points follow a step function on a grid of cells around the posterior."""
    CELLS = {2: 240, 3: 56, 4: 24, 5: 14}

    def __init__(self, problem, seed=1, cells=None):
        self.problem, self.n = problem, len(problem.unknowns)
        self.cells = cells or self.CELLS[self.n]
        self.find_box(seed)
        self.make_table()

    def find_box(self, seed):
        """Shrinks a box to what lies within DEEP of the greatest logarithm of the density, then turns to axes without correlation."""
        deep, box = 22.0, self.problem.first_box()
        engine = stats.qmc.Sobol(self.n, seed=seed)
        last = 0
        for count in range(40):
            x = box[:, :1] + (box[:, 1:] - box[:, :1]) * engine.random(2**17).T
            lp = self.problem.log_density(x)
            limit = min(lp.max() - deep, np.quantile(lp, 0.995))
            inside = x[:, lp >= limit]
            new = np.stack([inside.min(axis=1), inside.max(axis=1)], axis=1)
            margin = 0.1 * (new[:, 1] - new[:, 0])
            new = np.clip(np.stack([new[:, 0] - margin, new[:, 1] + margin], axis=1), box[:, :1], box[:, 1:])
            size = np.prod((new[:, 1] - new[:, 0]) / (box[:, 1] - box[:, 0]))
            box = new
            if limit == lp.max() - deep and size > 0.7:
                break
        self.box = box
        x = box[:, :1] + (box[:, 1:] - box[:, :1]) * engine.random(2**18).T
        lp = self.problem.log_density(x)
        weight = np.exp((lp - lp.max()) / 4)
        mean = np.average(x, axis=1, weights=weight)
        self.center, self.map = mean, np.linalg.cholesky(np.cov(x, aweights=weight))
        z = np.linalg.solve(self.map, x[:, lp > lp.max() - deep] - mean[:, None])
        low, high = z.min(axis=1), z.max(axis=1)
        pad = 0.08 * (high - low)
        self.low, self.high = low - pad, high + pad
        # A bound of the first unknowns is a plane in z as well, if their axes are not mixed.
        bounds = self.problem.bounds
        for i in range(self.n):
            if np.all(self.map[i, :i] == 0):
                self.low[i] = max(self.low[i], (bounds[i, 0] - mean[i]) / self.map[i, i])
                self.high[i] = min(self.high[i], (bounds[i, 1] - mean[i]) / self.map[i, i])

    def place(self, z):
        return self.center[:, None] + self.map @ z

    def at_grid(self, shift):
        """The logarithm of the density at the corners (0) or the centers (0.5) of the cells."""
        n = self.cells + (shift == 0)
        axes = [low + (np.arange(n) + shift) / self.cells * (high - low) for low, high in zip(self.low, self.high)]
        size = n**self.n
        out = np.empty(size)
        for part in chunks(size):
            index = np.unravel_index(np.arange(part.start, part.stop), (n,) * self.n)
            out[part] = self.problem.log_density(self.place(np.array([axis[i] for axis, i in zip(axes, index)])))
        return out.reshape((n,) * self.n)

    def make_table(self):
        corners, centers = self.at_grid(0), self.at_grid(0.5)
        self.top = max(corners.max(), centers.max())
        corners, table = np.exp(corners - self.top), np.exp(centers - self.top)
        count = 2**self.n
        mean = sum(corners[tuple(slice(b, b + self.cells) for b in bits)] for bits in itertools.product((0, 1), repeat=self.n)) / count
        table = 0.5 * table + 0.5 * mean
        table += 1e-3 * table.mean()
        table /= table.sum()
        self.levels = [table.sum(axis=tuple(range(k + 1, self.n))) for k in range(self.n)]
        self.table = table
        self.cell_volume = np.prod((self.high - self.low) / self.cells)

    def draw(self, u):
        """Points of the step function from points of the unit cube, and its density in z."""
        prefix = np.zeros(u.shape[1], dtype=np.int64)
        z = np.empty_like(u)
        for k in range(self.n):
            level = self.levels[k].reshape(-1, self.cells)
            total = np.cumsum(level.ravel())
            ends = np.concatenate([[0.0], total])
            start, stop = ends[prefix * self.cells], ends[(prefix + 1) * self.cells]
            target = start + u[k] * (stop - start)
            cell = np.clip(np.searchsorted(total, target, side="right"), prefix * self.cells, (prefix + 1) * self.cells - 1)
            inside = np.clip((target - ends[cell]) / (ends[cell + 1] - ends[cell]), 0, 1)
            z[k] = self.low[k] + (cell % self.cells + inside) / self.cells * (self.high[k] - self.low[k])
            prefix = cell
        return z, self.table.ravel()[prefix] / self.cell_volume

    def sample(self, seed, points):
        """Weighted points of one randomisation: quantities in a dictionary, and weights."""
        u = np.ascontiguousarray(stats.qmc.Sobol(self.n, seed=seed).random(points).T)
        keep = self.problem.unknowns + self.problem.derived
        values, weight = {key: np.empty(points) for key in keep}, np.empty(points)
        for part in chunks(points):
            z, q = self.draw(u[:, part])
            lp, found = self.problem.log_density(self.place(z), with_found=True)
            weight[part] = np.exp(lp - self.top) / q
            for key in keep:
                values[key][part] = found[key]
        return values, weight


class Sorted:
    """Weighted points in order, with their quantiles."""

    def __init__(self, values, weight):
        used = weight > 0
        order = np.argsort(values[used])
        self.x, self.w = values[used][order], weight[used][order]
        self.w = self.w / self.w.sum()
        self.p = np.cumsum(self.w) - 0.5 * self.w

    def quantile(self, p):
        return np.interp(p, self.p, self.x)

    def shortest(self, share=0.95):
        """Ends of the shortest interval with a probability: the minimum of a quartic through its width near the least one found."""
        p = np.linspace(0, 1 - share, 2001)
        width = self.quantile(p + share) - self.quantile(p)
        best = int(np.argmin(width))
        near = width <= width[best] * 1.02
        first, last = best, best
        while first > 0 and near[first - 1]:
            first -= 1
        while last < len(p) - 1 and near[last + 1]:
            last += 1
        if last - first >= 20:
            middle, half = 0.5 * (p[first] + p[last]), 0.5 * (p[last] - p[first])
            scaled = (p[first:last + 1] - middle) / half
            curve = np.polynomial.Polynomial.fit(scaled, width[first:last + 1], 4)
            fine = np.linspace(-1, 1, 20001)
            at = middle + half * fine[np.argmin(curve(fine))]
        else:
            at = p[best]
        return self.quantile(at), self.quantile(at + share)


def statistics(values, weight, statement):
    """Statistic by (quantity, name)."""
    found = {}
    total = weight.sum()
    for key, x in values.items():
        mean = (weight @ x) / total
        found[key, "mean"] = mean
        found[key, "sd"] = math.sqrt((weight @ (x - mean) ** 2) / total)
        ordered = Sorted(x, weight)
        for p in QUANTILES:
            found[key, f"q{p}"] = float(ordered.quantile(p))
        found[key, "hdi_low"], found[key, "hdi_high"] = map(float, ordered.shortest())
    key, limit = statement.split(" > ")
    found[statement, "probability"] = (weight @ (values[key] > si(limit))) / total
    return found


def posterior(problem, replicates=REPLICATES, points=POINTS, seed=1, cells=None):
    """-> statistics of all points, their standard errors by the spread of independent randomisations, and the share of useful points."""
    made = Posterior(problem, seed=seed, cells=cells)
    parts = [made.sample(1000 * seed + i, points) for i in range(replicates)]
    statement = PROBABILITIES[problem.name]
    each = [statistics(*part, statement) for part in parts]
    weight = np.concatenate([w for _, w in parts])
    values = {key: np.concatenate([v[key] for v, _ in parts]) for key in parts[0][0]}
    whole = statistics(values, weight, statement)
    error = {key: float(np.std([one[key] for one in each], ddof=1)) / math.sqrt(replicates) for key in whole}
    # A standard error of a shortest interval does not fall as fast as others, since the width is flat at its minimum.
    useful = weight.sum() ** 2 / (weight @ weight) / len(weight)
    return whole, error, useful, made


# ------------------------------------------------------------------ profile likelihood

class Profile:
    """Least chi-square over the other unknowns, with every choice of bounds that may hold them."""

    def __init__(self, problem, box):
        self.problem, self.box = problem, box
        self.scale = box[:, 1] - box[:, 0]
        engine = stats.qmc.Sobol(len(box), seed=99)
        x = box[:, :1] + self.scale[:, None] * engine.random(2**19).T
        # Bounds are part of the box: a face of it is tried as well.
        faces = [x]
        for i in range(len(box)):
            for bound in problem.bounds[i]:
                if math.isfinite(bound) and box[i, 0] <= bound <= box[i, 1]:
                    on = x[:, :2**17].copy()
                    on[i] = bound
                    faces.append(on)
        self.pool = np.concatenate(faces, axis=1)
        self.pool_chi = self.chi(self.pool)
        self.best = self.least({})
        self.limit = self.best[0] + LEVEL

    def chi(self, x):
        with np.errstate(all="ignore"):
            rows, possible = self.problem.residuals(x)
            chi = (rows**2).sum(axis=0)
        inside = np.all((x >= self.problem.bounds[:, :1]) & (x <= self.problem.bounds[:, 1:]), axis=0)
        return np.where(possible & inside & np.isfinite(chi), chi, np.inf)

    def least(self, held, starts=()):
        """-> (chi-square, unknowns) with some unknowns held, from the points of the pool nearest to it and from starts."""
        n, bounds = len(self.box), self.problem.bounds
        free = [i for i in range(n) if i not in held]
        if not free:
            x = np.array([held[i] for i in range(n)])
            return float(self.chi(x[:, None])[0]), x
        if held:
            cost = self.pool_chi + sum(((self.pool[i] - value) / (0.02 * self.scale[i])) ** 2 for i, value in held.items())
        else:
            cost = self.pool_chi
        chosen = []
        for at in np.argsort(cost)[:4000]:
            x = self.pool[:, at]
            if all(np.max(np.abs((x - other) / self.scale)) > 0.08 for other in chosen):
                chosen.append(x)
            if len(chosen) == 6:
                break
        chosen += list(starts)
        best = (math.inf, None)
        ends = [[None] + [b for b in bounds[i] if math.isfinite(b)] for i in free]
        for choice in itertools.product(*ends):
            on = {**held, **{i: b for i, b in zip(free, choice) if b is not None}}
            loose = [i for i in range(n) if i not in on]

            def whole(y):
                x = np.empty(n)
                for i, value in on.items():
                    x[i] = value
                x[loose] = y * self.scale[loose]
                return x

            if not loose:
                x = whole(np.empty(0))
                value = float(self.chi(x[:, None])[0])
                best = min(best, (value, x), key=lambda pair: pair[0])
                continue
            for start in chosen:
                with np.errstate(all="ignore"):
                    try:
                        made = optimize.least_squares(lambda y: self.problem.residuals(whole(y)[:, None])[0][:, 0], start[loose] / self.scale[loose],
                                                      jac="3-point", method="trf", xtol=1e-15, ftol=1e-15, gtol=1e-15, max_nfev=200)
                    except ValueError:
                        continue
                x = whole(made.x)
                value = float(self.chi(x[:, None])[0])
                if value < best[0]:
                    best = (value, x)
        return best

    def interval(self, k):
        return [self.end(k, direction) for direction in (-1, 1)]

    def end(self, k, direction):
        """The farthest value of an unknown whose least chi-square is within the limit."""
        inside = self.pool[:, self.pool_chi <= self.limit]
        near = inside[:, np.argmax(direction * inside[k])]
        if direction * (self.best[1][k] - near[k]) > 0:
            near = self.best[1]
        last = {"x": near}

        def over(value):
            chi, x = self.least({k: value}, [last["x"]])
            if x is not None:
                last["x"] = x
            return chi - self.limit

        bound = self.problem.bounds[k, (direction + 1) // 2]
        step = 0.01 * self.scale[k]
        a = near[k]
        fa = over(a)
        while True:
            b = a + direction * step
            if direction * (b - bound) >= 0:
                b = bound
            fb = over(b)
            if fb > 0:
                break
            if b == bound:
                return bound
            a, fa = b, fb
        if not math.isfinite(fb):
            # Mechanics refuses what lies beyond: bisect on what is possible.
            while abs(b - a) > 1e-7 * self.scale[k]:
                middle = 0.5 * (a + b)
                if over(middle) > 0:
                    b = middle
                else:
                    a = middle
            return 0.5 * (a + b)
        return optimize.brentq(over, a, b, xtol=1e-9 * self.scale[k], rtol=1e-14)


# ------------------------------------------------------------------ output

def rows_of(name):
    problem = Problem(name)
    whole, error, useful, made = posterior(problem)
    rows = [(name, key, statistic, value, error[key, statistic]) for (key, statistic), value in whole.items()]
    ends = {}
    if name not in NO_PROFILE:
        profile = Profile(problem, made.box)
        for k, key in enumerate(problem.unknowns):
            low, high = profile.interval(k)
            rows += [(name, key, "profile_low", low, 0.0), (name, key, "profile_high", high, 0.0)]
            ends[key] = (low, high)
    print(f"{name}: useful share of the points {useful:.3f}", file=sys.stderr)
    return rows


def main():
    chosen = [name for name in sys.argv[1:] if not name.startswith("-")] or NAMES
    if "--check" in sys.argv:
        import check
        sys.exit(check.run(chosen))
    out = csv.writer(sys.stdout, lineterminator="\n")
    out.writerow(["case", "quantity", "statistic", "value", "standard_error"])
    for name in chosen:
        for case, key, statistic, value, error in rows_of(name):
            out.writerow([case, key, statistic, f"{value:.10g}", f"{error:.2g}"])


if __name__ == "__main__":
    main()
