"""Makes uncertainty.jsonl: cases with uncertain inputs, and what derivatives and samples say of their outputs.

    pip install numpy scipy
    python3 uncertainty.py > uncertainty.jsonl

The mechanics are the compliance of the contact, K P = ((1 + e) v_n, v_t), written for arrays; the derivatives are difference quotients, the distributions
those of scipy, the samples those of numpy. Nothing is shared with the program. README.md has the rest.
"""

import json
import math

import numpy as np
from scipy import stats

SAMPLES = 2_000_000
PAIRS = 400_000
BATCHES = 50
SUBSETS = 50_000
QUANTILES = (0.025, 0.25, 0.5, 0.75, 0.975)
SEED = 20240607


# ------------------------------------------------------------------ distributions

class Values:
    """Measured values, each as likely as another."""

    def __init__(self, values):
        self.values = np.sort(np.array(values))

    def ppf(self, p):
        return self.values[np.minimum((np.asarray(p) * len(self.values)).astype(int), len(self.values) - 1)]

    def mean(self):
        return self.values.mean()

    def central(self, k):
        return ((self.values - self.values.mean()) ** k).mean()


class Uncertain:
    """A number of a case: how the file has it, and its distribution in SI."""

    def __init__(self, written, shape):
        self.written, self.shape = written, shape

    def mean(self):
        return float(self.shape.mean())

    def central(self, k):
        if isinstance(self.shape, Values):
            return float(self.shape.central(k))
        variance, skewness, excess = (float(x) for x in self.shape.stats(moments="vsk"))
        return {2: variance, 3: skewness * variance ** 1.5, 4: (excess + 3) * variance ** 2}[k]


def normal(mean, sd, unit, si=1.0):
    return Uncertain(f"{mean} {unit} ± {sd} {unit}", stats.norm(mean * si, sd * si))


def ratio(mean, sd):
    return Uncertain(f"{mean} ± {sd}", stats.norm(mean, sd))


def uniform(low, high, unit, si=1.0):
    return Uncertain({"min": f"{low} {unit}".strip(), "max": f"{high} {unit}".strip()}, stats.uniform(low * si, (high - low) * si))


def triangular(low, mode, high, unit, si=1.0):
    written = {key: f"{x} {unit}".strip() for key, x in (("min", low), ("mode", mode), ("max", high))}
    return Uncertain(written, stats.triang((mode - low) / (high - low), low * si, (high - low) * si))


def truncated(value, sd, low, high, unit, si=1.0):
    written = {key: f"{x} {unit}".strip() for key, x in (("value", value), ("sd", sd), ("min", low), ("max", high))}
    return Uncertain(written, stats.truncnorm((low - value) / sd, (high - value) / sd, value * si, sd * si))


def log_normal(median, factor, unit):
    return Uncertain({"median": f"{median} {unit}", "factor": factor}, stats.lognorm(math.log(factor), scale=median))


def recorded(value, step, unit, si=1.0):
    written = {"value": f"{value} {unit}", "resolution": f"{step} {unit}"}
    return Uncertain(written, stats.uniform((value - step / 2) * si, step * si))


def of_measurements(mean, sd, n):
    return Uncertain({"mean": mean, "sd": sd, "n": n}, stats.t(n - 1, mean, sd / math.sqrt(n)))


def measured(values):
    return Uncertain({"values": values}, Values(values))


class Curve:
    """A restitution over the closing speed in km/h: its mean and its standard deviation at points, with lines between."""

    def __init__(self, points, sd):
        self.speeds, self.means, self.sd = [p[0] for p in points], [p[1] for p in points], sd
        self.scatter = Uncertain(None, stats.norm(0, 1))

    def at(self, speed, scatter):
        over = lambda values: np.interp(speed / KMH, self.speeds, values)
        return over(self.means) + scatter * over(self.sd if isinstance(self.sd, list) else [self.sd] * len(self.speeds))

    def written(self):
        return {"closing_speed": [f"{speed} km/h" for speed in self.speeds], "restitution": self.means, "sd": self.sd}


DEG, KMH = math.pi / 180, 1 / 3.6


# ------------------------------------------------------------------ mechanics, on numbers or arrays

def rotated(x, y, by):
    return x * np.cos(by) - y * np.sin(by), x * np.sin(by) + y * np.cos(by)


def collide(case, at):
    """The outputs of a case, given the value of each number by its name. -> outputs, and a mask for each reason to refuse."""
    contact, mass, inertia, speed, arm, heading, weights = case["contact"], [], [], [], [], [], []
    number = lambda name, certain: at[name] if name in at else certain
    wrong = {"out-of-range": False, "not-positive": False}
    outputs = {}
    gamma = number("contact.crush_plane", contact.get("crush_plane"))
    for i, vehicle in enumerate(case["vehicle"], 1):
        name = f"vehicle.{i}."
        if vehicle.get("barrier"):
            mass.append(None), inertia.append(None), speed.append((0.0, 0.0, 0.0)), arm.append((0.0, 0.0)), heading.append(0.0)
            weights.append((0.0, 0.0))
            continue
        m, theta = number(name + "mass", vehicle["mass"]), number(name + "heading", vehicle["heading"])
        if "radius_of_gyration" in vehicle:
            inertia_now = m * number(name + "radius_of_gyration", vehicle["radius_of_gyration"]) ** 2
        else:
            inertia_now = number(name + "yaw_inertia", vehicle["yaw_inertia"])
        v = number(name + "speed", vehicle["speed"])
        mass.append(m), inertia.append(inertia_now), heading.append(theta), weights.append((1 / m, 1 / inertia_now))
        speed.append((v * np.cos(theta), v * np.sin(theta), number(name + "yaw_rate", vehicle.get("yaw_rate", 0.0))))
        forward, left = vehicle["impact_center"]
        arm.append(rotated(number(name + "impact_center.forward", forward), number(name + "impact_center.left", left), theta))
        wrong["not-positive"] = wrong["not-positive"] | (m <= 0) | (inertia_now <= 0)
        if "crush" in vehicle:
            crush = vehicle["crush"]
            depths = [number(f"{name}crush.depths.{k}", depth) for k, depth in enumerate(crush["depths"], 1)]
            d0, d1 = (number(f"{name}crush.{key}", crush["stiffness"][key]) for key in ("d0", "d1"))
            root = [d0 + d1 * depth for depth in depths]
            # The mean of ((d0 + d1 C)^2)/2 over each piece, where C is linear.
            pieces = [(a * a + a * b + b * b) / 6 for a, b in zip(root, root[1:])]
            outputs[f"vehicle.{i}.crush_energy"] = number(name + "crush.width", crush["width"]) * sum(pieces) / len(pieces)
    # The contact's place from each center of mass, and velocities there, along n and t.
    (r1n, r1t), (r2n, r2t) = (rotated(x, y, -gamma) for x, y in arm)
    points = [(vx - w * ry, vy + w * rx) for (vx, vy, w), (rx, ry) in zip(speed, arm)]
    vn, vt = rotated(points[1][0] - points[0][0], points[1][1] - points[0][1], -gamma)
    e = number("contact.restitution", contact.get("restitution"))
    if isinstance(e, Curve):
        e = e.at(np.abs(vn), number("contact.restitution.scatter", 0.0))
    (w1, j1), (w2, j2) = weights
    knn = w1 + w2 + j1 * r1t ** 2 + j2 * r2t ** 2
    knt = -(j1 * r1n * r1t + j2 * r2n * r2t)
    ktt = w1 + w2 + j1 * r1n ** 2 + j2 * r2n ** 2
    det = knn * ktt - knt ** 2
    stick_n = ((1 + e) * vn * ktt - knt * vt) / det
    stick_t = (knn * vt - knt * (1 + e) * vn) / det
    critical = stick_t / stick_n
    wrong["out-of-range"] = wrong["out-of-range"] | (e < 0) | (e > 1)
    beyond = False
    if "friction" in contact:
        friction = number("contact.friction", contact["friction"])
        wrong["out-of-range"] = wrong["out-of-range"] | (friction < 0)
        mu = np.where(np.abs(critical) > friction, friction * np.sign(critical), critical)
    elif isinstance(contact.get("impulse_ratio"), dict):
        share = number("contact.impulse_ratio.of_critical", contact["impulse_ratio"]["of_critical"])
        wrong["out-of-range"] = wrong["out-of-range"] | (share < 0) | (share > 1)
        mu = share * critical
    elif "impulse_ratio" in contact:
        mu = number("contact.impulse_ratio", contact["impulse_ratio"]) + 0 * critical
        beyond = (mu / critical > 1) | (mu * critical < 0)
    else:
        mu = critical
    pn = (1 + e) * vn / (knn + mu * knt)
    pt = mu * pn
    after_n, after_t = vn - (knn * pn + knt * pt), vt - (knt * pn + ktt * pt)
    wn, wt = -0.5 * pn * (vn + after_n), -0.5 * pt * (vt + after_t)
    px, py = rotated(pn, pt, gamma)
    outputs.update({"result.contact.restitution": e + 0 * critical, "contact.critical_impulse_ratio": critical, "result.contact.impulse_ratio": mu, "energy.normal_work": wn,
                    "energy.tangential_work": wt, "energy.loss": -(wn + wt)})
    for i, (sign, (w, j), (vx, vy, rate), (rx, ry), theta) in enumerate(zip((1, -1), weights, speed, arm, heading), 1):
        outputs[f"vehicle.{i}.delta_v_magnitude"] = w * np.hypot(px, py)
        outputs[f"result.vehicle.{i}.velocity.x"] = vx + sign * w * px
        outputs[f"result.vehicle.{i}.velocity.y"] = vy + sign * w * py
        outputs[f"result.vehicle.{i}.yaw_rate"] = rate + sign * j * (rx * py - ry * px)
        ahead, left = rotated(-sign * px, -sign * py, -theta)
        outputs[f"vehicle.{i}.pdof"] = np.arctan2(-left, ahead)
    # Center of mass 2 from that of 1, along n: the way in which the vehicles close.
    side = r1n - r2n
    readable = ~(wrong["out-of-range"] | wrong["not-positive"])
    separating = readable & (vn * side > 0)
    going = readable & ~separating
    tensile = going & (pn * side > 0)
    reasons = {**wrong, "separating": separating, "beyond-critical": going & ~tensile & beyond, "tensile": tensile}
    reasons["energy-gain"] = going & ~tensile & ~(reasons["beyond-critical"]) & (outputs["energy.loss"] < 0)
    return outputs, {code: mask for code, mask in reasons.items() if np.any(mask)}


# ------------------------------------------------------------------ a case

def numbers_of(case):
    """The uncertain numbers by name, and the case with their nominal means in their places."""
    found = {}

    def walk(value, name):
        if isinstance(value, Uncertain):
            found[name] = value
            return value.mean()
        if isinstance(value, Curve):
            found[f"{name}.scatter"] = value.scatter
            return value
        if isinstance(value, tuple):                     # a certain number: how it is written, and in SI
            return value[1]
        if isinstance(value, dict):
            # The file groups what the name does not.
            return {key: walk(inner, name if key in ("stiffness", "contact") else f"{name}.{key}" if name else key) for key, inner in value.items()}
        if isinstance(value, list) and name.endswith("impact_center"):
            return [walk(inner, f"{name}.{part}") for part, inner in zip(("forward", "left"), value)]
        if isinstance(value, list):
            return [walk(inner, f"{name}.{k}") for k, inner in enumerate(value, 1)]
        return value

    return {"vehicle": [walk(v, f"vehicle.{i}") for i, v in enumerate(case["vehicle"], 1)], "contact": walk(case["contact"], "contact")}, found



def written(value):
    if isinstance(value, Uncertain):
        return value.written
    if isinstance(value, Curve):
        return value.written()
    if isinstance(value, tuple):
        return value[0]
    if isinstance(value, dict):
        return {key: written(inner) for key, inner in value.items()}
    return [written(inner) for inner in value] if isinstance(value, list) else value


def factor_of(names, correlations):
    matrix = np.eye(len(names))
    for one, other, r in correlations:
        i, j = names.index(one), names.index(other)
        matrix[i, j] = matrix[j, i] = r
    return np.linalg.cholesky(matrix)


def covariance_of(names, numbers, correlations):
    """Covariances of the numbers themselves; of a correlated pair by Gauss' rule over two normal scores, on each side of a corner of a quantile function."""
    nodes, weights = np.polynomial.legendre.leggauss(100)

    def pieces(number):
        corner = stats.norm.ppf(number.shape.args[0]) if "mode" in number.written else 0.0
        ends = [-9.0, corner, 9.0]
        places = np.concatenate([low + (high - low) * (nodes + 1) / 2 for low, high in zip(ends, ends[1:])])
        return places, np.concatenate([(high - low) * weights / 2 for low, high in zip(ends, ends[1:])])

    matrix = np.diag([numbers[name].central(2) for name in names])
    for one, other, r in correlations:
        (z, wz), (w, ww) = pieces(numbers[one]), pieces(numbers[other])
        # The upper tail through the survival function, where a probability near 1 has lost its digits.
        x, y = (np.where(s < 0, n.shape.ppf(stats.norm.cdf(s)), n.shape.isf(stats.norm.sf(s))) - n.mean() for s, n in ((z, numbers[one]), (w, numbers[other])))
        square = z[:, None] ** 2 - 2 * r * z[:, None] * w + w ** 2
        density = np.exp(-square / (2 * (1 - r * r))) / (2 * math.pi * math.sqrt(1 - r * r))
        i, j = names.index(one), names.index(other)
        matrix[i, j] = matrix[j, i] = (wz * x) @ density @ (ww * y)
    return matrix


def derivatives(f, means, steps):
    """First and second difference quotients of fourth order."""
    n = len(means)
    stencil = [(-2, 1 / 12), (-1, -8 / 12), (1, 8 / 12), (2, -1 / 12)]
    second = [(-2, -1 / 12), (-1, 16 / 12), (0, -30 / 12), (1, 16 / 12), (2, -1 / 12)]

    def moved(*moves):
        at = np.array(means, dtype=float)
        for i, k in moves:
            at[i] += k * steps[i]
        return f(at)

    gradient = np.array([sum(c * moved((i, k)) for k, c in stencil) / steps[i] for i in range(n)])
    hessian = np.empty((n, n))
    for i in range(n):
        hessian[i, i] = sum(c * moved((i, k)) for k, c in second) / steps[i] ** 2
        for j in range(i):
            mixed = sum(c * d * moved((i, k), (j, l)) for k, c in stencil for l, d in stencil)
            hessian[i, j] = hessian[j, i] = mixed / steps[i] / steps[j]
    return gradient, hessian


def about(values, center, is_angle):
    """Angles within half a turn of a center."""
    return values - 2 * math.pi * np.round((values - center) / (2 * math.pi)) if is_angle else values


def proportion(count, n):
    p = count / n
    return [float(p), float(math.sqrt(max(p * (1 - p), 1 / n) / n))]


def shapley_effects(case, names, numbers, correlations, of, centers):
    """The Shapley effects of all inputs on each output, by every subset of them.

    The value of a subset is the covariance of two outputs that have it in common, and all else independent of each other given it.
    """
    rng = np.random.default_rng(SEED + 1)
    n, factor = len(names), factor_of(names, correlations)
    matrix, scores = factor @ factor.T, rng.standard_normal((SUBSETS, len(names))) @ factor.T

    def run(z):
        drawn = {name: numbers[name].shape.ppf(stats.norm.cdf(z[:, i])) for i, name in enumerate(names)}
        outputs, bad = collide(case, drawn)
        assert not bad, "a case with effects is refused nowhere"
        return np.array([about(outputs[output], centers[output], output.endswith("pdof")) - centers[output] for output in of])

    first = run(scores)
    first_mean = first.mean(axis=1, keepdims=True)
    added = np.zeros((n, len(of), SUBSETS))
    for subset in range(1, 1 << n):
        inside = [i for i in range(n) if subset >> i & 1]
        outside = [i for i in range(n) if not subset >> i & 1]
        if outside:
            known = np.linalg.solve(matrix[np.ix_(inside, inside)], matrix[np.ix_(inside, outside)]).T
            rest = np.linalg.cholesky(matrix[np.ix_(outside, outside)] - known @ matrix[np.ix_(inside, outside)])
            other = scores.copy()
            other[:, outside] = scores[:, inside] @ known.T + rng.standard_normal((SUBSETS, len(outside))) @ rest.T
            second = run(other)
        else:
            second = first
        value = (first - first_mean) * (second - second.mean(axis=1, keepdims=True))
        size = len(inside)
        for i in range(n):
            if i in inside:
                added[i] += value * (math.factorial(size - 1) * math.factorial(n - size) / math.factorial(n))
            else:
                added[i] -= value * (math.factorial(size) * math.factorial(n - size - 1) / math.factorial(n))
    variance = first.var(axis=1)
    found = {}
    for k, output in enumerate(of):
        spread = (first[k] - first_mean[k]) ** 2
        effects = added[:, k].mean(axis=1) / variance[k]
        errors = (added[:, k] - effects[:, None] * spread).std(axis=1) / math.sqrt(SUBSETS) / variance[k]
        found[output] = {name: [float(effects[i]), float(errors[i])] for i, name in enumerate(names)}
    return found


def reference(made, of, probabilities, correlations=(), sobol=True, second_order=True, shapley=False):
    rng = np.random.default_rng(SEED)
    case, numbers = numbers_of(made)
    names = list(numbers)
    means = [numbers[name].mean() for name in names]
    covariance = covariance_of(names, numbers, correlations)
    steps = [0.02 * math.sqrt(numbers[name].central(2)) for name in names]
    answer = {"of": {}, "probabilities": {}}

    def at_means(output):
        center = float(collide(case, dict(zip(names, means)))[0][output])
        return lambda x: float(about(collide(case, dict(zip(names, x)))[0][output], center, output.endswith("pdof")))

    for output in of:
        gradient, hessian = derivatives(at_means(output), means, steps)
        mean = at_means(output)(np.array(means))
        variance = float(gradient @ covariance @ gradient)
        shares = gradient * (covariance @ gradient) / variance
        found = {"linear": {"mean": mean, "sd": math.sqrt(variance), "shares": dict(zip(names, shares.tolist()))}}
        found["linear"]["sd_if_halved"] = {}
        for i, name in enumerate(names):
            half = np.ones(len(names))
            half[i] = 0.5
            found["linear"]["sd_if_halved"][name] = math.sqrt(max(0.0, float((half * gradient) @ covariance @ (half * gradient))))
        if second_order:
            # The quadratic function in normal scores, turned until each has a term of its own, b z + λ z²/2, whose third cumulant is 3 b² λ + λ³.
            root = np.linalg.cholesky(covariance)
            values, turn = np.linalg.eigh(root.T @ hessian @ root)
            slopes = turn.T @ root.T @ gradient
            third = float(np.sum(3 * slopes ** 2 * values + values ** 3)) + sum(g ** 3 * numbers[n].central(3) for g, n in zip(gradient, names))
            found["second_order"] = {"mean": mean + 0.5 * float(np.sum(hessian * covariance))}
            if not correlations:
                # The variance of a quadratic function of independent numbers, term by term.
                m2, m3, m4 = (np.array([numbers[name].central(k) for name in names]) for k in (2, 3, 4))
                own = gradient ** 2 * m2 + gradient * np.diag(hessian) * m3 + np.diag(hessian) ** 2 / 4 * (m4 - m2 ** 2)
                pairs = sum(hessian[i, j] ** 2 * m2[i] * m2[j] for i in range(len(names)) for j in range(i))
                found["second_order"]["sd"] = math.sqrt(float(own.sum() + pairs))
                found["second_order"]["skewness"] = third / found["second_order"]["sd"] ** 3
        answer["of"][output] = found

    factor = factor_of(names, correlations)
    scores = rng.standard_normal((SAMPLES, len(names))) @ factor.T
    drawn = {name: numbers[name].shape.ppf(stats.norm.cdf(scores[:, i])) for i, name in enumerate(names)}
    with np.errstate(all="ignore"):
        outputs, reasons = collide(case, drawn)
    refused = np.zeros(SAMPLES, dtype=bool)
    for mask in reasons.values():
        refused = refused | mask
    answer["refused"] = {"share": proportion(refused.sum(), SAMPLES),
                         "reasons": {code: proportion(mask.sum(), SAMPLES) for code, mask in reasons.items()}}
    for output in of:
        x = about(outputs[output], answer["of"][output]["linear"]["mean"], output.endswith("pdof"))[~refused]
        n, sd = len(x), float(x.std(ddof=1))
        kurtosis = float(((x - x.mean()) ** 4).mean() / x.var() ** 2)
        x.sort()
        at = lambda p: float(x[min(max(int(p * n), 0), n - 1)])
        quantile = lambda p: [at(p), abs(at(p + math.sqrt(p * (1 - p) / n)) - at(p - math.sqrt(p * (1 - p) / n))) / 2]
        answer["of"][output]["monte_carlo"] = {
            "mean": [float(x.mean()), sd / math.sqrt(n)],
            "sd": [sd, sd * math.sqrt(max(kurtosis - 1, 0) / n) / 2],
            "skewness": [float(stats.skew(x)), float(np.std([stats.skew(part) for part in np.array_split(rng.permutation(x), BATCHES)]) / math.sqrt(BATCHES))],
            "quantiles": {str(p): quantile(p) for p in QUANTILES}}
    for output, unit, si, value, sign in probabilities:
        x = outputs[output][~refused]
        holds = x > value * si if sign == ">" else x < value * si
        answer["probabilities"][f"{output} {sign} {value} {unit}".strip()] = proportion(holds.sum(), len(x))
    if sobol:
        draw = lambda: rng.random((PAIRS, len(names)))
        run = lambda u: collide(case, {name: numbers[name].shape.ppf(u[:, i]) for i, name in enumerate(names)})
        a, b = draw(), draw()
        (of_a, bad_a), (of_b, bad_b) = run(a), run(b)
        assert not bad_a and not bad_b, "a case with shares is refused nowhere"
        for output in of:
            answer["of"][output]["sobol"] = {}
        for i, name in enumerate(names):
            mixed = a.copy()
            mixed[:, i] = b[:, i]
            of_mixed = run(mixed)[0]
            for output in of:
                u, v, w = (about(x[output], answer["of"][output]["linear"]["mean"], output.endswith("pdof")) for x in (of_a, of_b, of_mixed))
                center = np.concatenate([u, v]).mean()
                u, v, w = u - center, v - center, w - center
                parts = np.array([[np.mean(q * (r - p)) / ((np.var(p) + np.var(q)) / 2), np.mean((p - r) ** 2) / (np.var(p) + np.var(q))]
                                  for p, q, r in zip(*(np.array_split(x, BATCHES) for x in (u, v, w)))])
                mean, error = parts.mean(axis=0), parts.std(axis=0, ddof=1) / math.sqrt(BATCHES)
                answer["of"][output]["sobol"][name] = {"first": [float(mean[0]), float(error[0])], "total": [float(mean[1]), float(error[1])]}
    if shapley:
        centers = {output: answer["of"][output]["linear"]["mean"] for output in of}
        for output, effects in shapley_effects(case, names, numbers, correlations, of, centers).items():
            answer["of"][output]["shapley"] = effects
    file = {"schema": 1, "title": made["title"], **({"correlation": [list(pair) for pair in correlations]} if correlations else {}),
            "vehicle": written(made["vehicle"]), "contact": written(made["contact"])}
    print(json.dumps({"case": file, **answer}, ensure_ascii=False), flush=True)


# ------------------------------------------------------------------ the cases

def kg(x): return (f"{x} kg", x)
def m(x): return (f"{x} m", x)
def deg(x): return (f"{x} deg", x * DEG)
def kmh(x): return (f"{x} km/h", x * KMH)


def main():
    one, two = "vehicle.1.delta_v_magnitude", "vehicle.2.delta_v_magnitude"
    # Independent numbers of five shapes; the yaw inertia follows the mass.
    reference({"title": "independent", "vehicle": [
        {"mass": normal(1450, 60, "kg"), "radius_of_gyration": normal(1.29, 0.05, "m"), "heading": normal(3, 2, "deg", DEG),
         "speed": normal(52, 4, "km/h", KMH), "impact_center": [m(1.9), normal(0.35, 0.1, "m")]},
        {"mass": kg(2180), "radius_of_gyration": m(1.45), "heading": deg(118), "speed": uniform(34, 48, "km/h", KMH),
         "yaw_rate": normal(5, 8, "deg/s", DEG), "impact_center": [m(2.1), m(-0.4)]}],
        "contact": {"crush_plane": uniform(-10, 10, "deg", DEG), "restitution": triangular(0, 0.1, 0.3, "")}},
        [one, "energy.normal_work", "result.vehicle.2.yaw_rate"],
        [(one, "m/s", 1.0, 11.0, ">"), ("energy.normal_work", "kJ", 1000.0, -85, "<")])
    # Correlated numbers, most of them not normal.
    reference({"title": "correlated", "vehicle": [
        {"mass": log_normal(1400, 1.1, "kg"), "radius_of_gyration": m(1.3), "heading": deg(10), "speed": uniform(40, 60, "km/h", KMH),
         "impact_center": [triangular(1.7, 1.9, 2.3, "m"), m(0.3)]},
        {"mass": triangular(1500, 1600, 1900, "kg"), "yaw_inertia": ("2900 kg m^2", 2900.0), "heading": deg(160),
         "speed": uniform(20, 35, "km/h", KMH), "impact_center": [m(1.8), normal(0.2, 0.1, "m")]}],
        "contact": {"crush_plane": normal(4, 3, "deg", DEG), "restitution": truncated(0.1, 0.08, 0, 0.4, "")}},
        [one, two, "energy.loss"], [(two, "km/h", KMH, 36, ">")],
        [("vehicle.1.mass", "vehicle.2.mass", 0.7), ("vehicle.1.speed", "vehicle.2.speed", -0.6), ("vehicle.1.mass", "contact.restitution", 0.3)],
        sobol=False, shapley=True)
    # Some per cent refused: a restitution below nothing, a pair that separates.
    reference({"title": "near refusal", "vehicle": [
        {"mass": normal(1500, 80, "kg"), "radius_of_gyration": m(1.35), "heading": deg(0), "speed": normal(60, 4, "km/h", KMH),
         "impact_center": [m(2.0), m(-0.6)]},
        {"mass": kg(1700), "radius_of_gyration": m(1.4), "heading": normal(8, 3, "deg", DEG), "speed": normal(48, 5, "km/h", KMH),
         "impact_center": [m(-2.1), m(0.4)]}],
        "contact": {"crush_plane": deg(0), "restitution": ratio(0.1, 0.06)}},
        [one, "energy.loss"], [(one, "km/h", KMH, 10, ">")], sobol=False)
    # A wall, crush of correlated stiffness, a share of the critical ratio, measured restitutions.
    reference({"title": "barrier", "vehicle": [
        {"mass": normal(1320, 20, "kg"), "yaw_inertia": normal(2100, 150, "kg m^2"), "heading": normal(0, 1.5, "deg", DEG),
         "speed": recorded(50, 2, "km/h", KMH), "impact_center": [m(1.8), normal(0.3, 0.08, "m")],
         "crush": {"width": normal(1.5, 0.05, "m"), "depths": [normal(0.3, 0.03, "m"), m(0.42), normal(0.5, 0.03, "m")],
                   "stiffness": {"d0": normal(90, 12, "N^0.5"), "d1": normal(650, 60, "N^0.5/m")}}},
        {"barrier": True}],
        "contact": {"crush_plane": deg(20), "restitution": measured([0.05, 0.08, 0.08, 0.11, 0.14, 0.21]),
                    "impulse_ratio": {"of_critical": uniform(0.8, 1, "")}}},
        ["vehicle.1.crush_energy", one, "result.contact.impulse_ratio"], [("vehicle.1.crush_energy", "kJ", 1000.0, 110, ">")],
        [("vehicle.1.crush.d0", "vehicle.1.crush.d1", -0.8)], sobol=False)
    # Friction, known from twelve measurements, that always limits the impulse.
    reference({"title": "friction", "vehicle": [
        {"mass": normal(1600, 50, "kg"), "radius_of_gyration": m(1.4), "heading": deg(0), "speed": normal(70, 3, "km/h", KMH),
         "impact_center": [m(1.9), m(0.7)]},
        {"mass": kg(1900), "radius_of_gyration": m(1.5), "heading": deg(90), "speed": truncated(30, 6, 18, 44, "km/h", KMH),
         "impact_center": [m(0.3), m(0.9)]}],
        "contact": {"crush_plane": normal(35, 2, "deg", DEG), "restitution": uniform(0, 0.2, ""), "friction": of_measurements(0.35, 0.06, 12)}},
        [one, "result.contact.impulse_ratio", "energy.tangential_work"], [(one, "km/h", KMH, 40, "<")])
    # Struck from behind: the direction of force lies on both sides of half a turn.
    reference({"title": "from behind", "vehicle": [
        {"mass": normal(1200, 30, "kg"), "radius_of_gyration": m(1.2), "heading": normal(0, 4, "deg", DEG), "speed": normal(5, 1, "km/h", KMH),
         "impact_center": [m(-2.0), normal(0.0, 0.2, "m")]},
        {"mass": kg(1500), "radius_of_gyration": m(1.3), "heading": normal(0, 3, "deg", DEG), "speed": normal(45, 3, "km/h", KMH),
         "impact_center": [m(2.0), m(0.1)]}],
        "contact": {"crush_plane": deg(0), "restitution": uniform(0.1, 0.3, "")}},
        ["vehicle.1.pdof", one], [(one, "km/h", KMH, 25, ">")])
    # A restitution that falls with the closing speed, which lies on both sides of a point: with the same scatter everywhere, and so much that some per cent
    # of the samples have a restitution below 0.
    for title, curve, sobol in [("closing speed", Curve([(20, 0.3), (50, 0.2), (90, 0.12)], 0.015), True),
                                ("closing speed with scatter", Curve([(10, 0.35), (45, 0.12), (70, 0.08)], [0.1, 0.06, 0.04]), False)]:
        reference({"title": title, "vehicle": [
            {"mass": normal(1450, 40, "kg"), "radius_of_gyration": m(1.3), "heading": deg(5), "speed": normal(40, 6, "km/h", KMH),
             "impact_center": [m(1.9), normal(0.3, 0.1, "m")]},
            {"mass": kg(1700), "radius_of_gyration": m(1.4), "heading": normal(170, 4, "deg", DEG), "speed": uniform(8, 16, "km/h", KMH),
             "impact_center": [m(2.0), m(-0.2)]}],
            "contact": {"crush_plane": uniform(-5, 5, "deg", DEG), "restitution": curve}},
            [one, "energy.loss", "result.contact.restitution"], [("result.contact.restitution", "", 1.0, 0.2, ">")], sobol=sobol)


if __name__ == "__main__":
    main()
