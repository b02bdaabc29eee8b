#!/usr/bin/env python3
"""Reconstructions with the unknowns that fit their evidence best:  python3 reconstruct.py > reconstruct.jsonl

The collisions and their units are those of solve.py; least squares, covariance and influence are by difference quotients with 50 digits. README.md tells how the
answers are made.
"""
from mpmath import mp, mpf

from crush import crush_answer, number
from solve import Bare, Body, collide, contact_velocity, read, show, turned

mp.dps = 50
STEP = mpf(10) ** -16
KINDS = {"speed": "speed", "x": "speed", "y": "speed", "crush_plane": "angle", "restitution": "", "separation_yaw_rate": "yaw rate",
         "separation_direction": "angle", "approach_direction": "angle", "delta_v_magnitude": "speed", "delta_v_forward": "speed",
         "delta_v_left": "speed", "separation_speed": "speed", "pdof": "angle"}


def kind_of(name):
    return KINDS[name.rsplit(".", 1)[1]]


def quantity(text, kind):
    """In SI; without a unit a number."""
    return read(text, kind) if " " in text else number(text)


# ------------------------------------------------------------------ the cases

SEDAN = {"name": "sedan", "mass": "1160 kg", "yaw_inertia": "1950 kg m^2", "heading": "180 deg", "impact_center": ["1.94 m", "0 m"]}
PICKUP = {"name": "pickup", "mass": "2880 kg", "yaw_inertia": "7040 kg m^2", "heading": "90 deg", "impact_center": ["2.43 m", "-0.99 m"]}
CRUSH_1 = {"width": "1.5 m", "depths": ["20 cm", "31 cm", "42 cm", "40 cm"], "stiffness": {"A": "50000 N/m", "B": "500000 N/m^2"}}
CRUSH_2 = {"width": "1.6 m", "depths": ["9 cm", "14 cm", "8 cm"], "stiffness": {"A": "48000 N/m", "B": "550000 N/m^2"}}
EVIDENCE = {
    "vehicle.1.separation_velocity.x": ("-6.1 m/s", "0.5 m/s"),
    "vehicle.1.separation_velocity.y": ("4.1 m/s", "0.4 m/s"),
    "vehicle.1.separation_yaw_rate": ("-4.1 rad/s", "0.2 rad/s"),
    "vehicle.2.separation_direction": ("103.5 deg", "2 deg"),
}
SPEEDS = {"vehicle.1.speed": ("13 m/s", "0 m/s", None, None), "vehicle.2.speed": ("13 m/s", "0 m/s", None, None)}
PLANE, STICKING = {"crush_plane": "0 deg", "restitution": "0"}, {"crush_plane": "0 deg"}


def made_of(title, contact, evidence, unknown, crush=False):
    vehicles = [{**SEDAN, **({"crush": CRUSH_1} if crush else {})}, {**PICKUP, **({"crush": CRUSH_2} if crush else {})}]
    return title, vehicles, contact, evidence, unknown


CASES = [
    made_of("speeds from separation", PLANE, {**EVIDENCE, "crush_energy": ("42000 J", "2000 J")}, SPEEDS),
    made_of("restitution with a prior", STICKING, {**EVIDENCE, "crush_energy": ("43000 J", "1500 J")},
            {**SPEEDS, "contact.restitution": ("0.1", "0", "0.4", "0.05")}),
    made_of("crush plane", {"restitution": "0.05"},
            {**EVIDENCE, "vehicle.2.separation_direction": ("106 deg", "3 deg"), "vehicle.1.delta_v_forward": ("-6.3 m/s", "0.3 m/s"),
             "vehicle.2.delta_v_left": ("2.6 m/s", "0.3 m/s"), "crush_energy": ("from crush", "9000 J")},
            {**SPEEDS, "contact.crush_plane": ("-3 deg", "-25 deg", "25 deg", None)}, crush=True),
    made_of("a restitution at its upper bound", STICKING,
            {"vehicle.1.separation_velocity.x": ("-4.6 m/s", "0.5 m/s"), "vehicle.1.separation_velocity.y": ("4.1 m/s", "0.4 m/s"),
             "vehicle.1.separation_yaw_rate": ("-4.6 rad/s", "0.4 rad/s"), "vehicle.2.delta_v_magnitude": ("3.2 m/s", "0.3 m/s"),
             "crush_energy": ("41000 J", "2000 J")},
            {**SPEEDS, "contact.restitution": ("0.05", "0", "0.1", None)}),
    made_of("a speed at its lower bound", PLANE,
            {**EVIDENCE, "crush_energy": ("43000 J", "2500 J")},
            {"vehicle.1.speed": ("13 m/s", "0 m/s", None, None), "vehicle.2.speed": ("14 m/s", "12.5 m/s", "30 m/s", None)}),
    made_of("a contradiction", PLANE, {**EVIDENCE, "vehicle.1.separation_yaw_rate": ("-2 rad/s", "0.2 rad/s"),
                                       "crush_energy": ("60000 J", "2000 J")}, SPEEDS),
    made_of("a recorder and a certain speed", STICKING,
            {"vehicle.2.speed": ("12.5 m/s", None), "vehicle.1.delta_v_magnitude": ("7.1 m/s", "0.2 m/s"), "vehicle.1.pdof": ("-33 deg", "2 deg"),
             "vehicle.2.separation_speed": ("11.2 m/s", "0.4 m/s"), "crush_energy": ("40000 J", "3000 J")},
            {"vehicle.1.speed": ("13 m/s", "0 m/s", None, None), "contact.restitution": ("0.05", "0", "0.5", None)}),
    made_of("as many pieces as unknowns", PLANE,
            {"vehicle.1.separation_yaw_rate": ("-4.1 rad/s", "0.2 rad/s"), "crush_energy": ("42000 J", "2000 J")}, SPEEDS),
]


# ------------------------------------------------------------------ the mechanics

class Scene:
    """The vehicles, and what the evidence would be at given unknowns."""

    def __init__(self, vehicles, contact, certain):
        self.bodies = [Body({**{key: value for key, value in each.items() if key != "crush"}, "speed": "0 m/s"}) for each in vehicles]
        self.contact = {"crush_plane": mpf(0), "restitution": mpf(0)}
        for key, value in contact.items():
            self.contact[key] = quantity(value, KINDS[key])
        self.certain = certain

    def evidence(self, names, unknowns):
        values = {**self.certain, **unknowns}
        for i, body in enumerate(self.bodies):
            speed = values[f"vehicle.{i + 1}.speed"]
            body.motion = (*turned(speed, mpf(0), body.turn), mpf(0))
        plane = values.get("contact.crush_plane", self.contact["crush_plane"])
        restitution = values.get("contact.restitution", self.contact["restitution"])
        normal, tangent, after = collide(self.bodies, plane, restitution, ("velocity", mpf(0)))
        approach = contact_velocity(self.bodies, [body.motion for body in self.bodies], plane)[0]
        found = {"crush_energy": normal * (1 - restitution) * approach / 2, **values}
        for i, body in enumerate(self.bodies):
            name, (x, y, rate) = f"vehicle.{i + 1}.", after[i]
            change = (x - body.motion[0], y - body.motion[1])
            forward, left = turned(*change, -body.turn)
            found |= {name + "separation_velocity.x": x, name + "separation_velocity.y": y, name + "separation_yaw_rate": rate,
                      name + "separation_speed": mp.hypot(x, y), name + "separation_direction": mp.atan2(y, x),
                      name + "delta_v_magnitude": mp.hypot(*change), name + "delta_v_forward": forward, name + "delta_v_left": left,
                      name + "pdof": mp.atan2(left, -forward)}
        return [found[name] for name in names]


# ------------------------------------------------------------------ least squares

class Fit:
    def __init__(self, scene, names, given, sd, unknowns):
        self.scene, self.names, self.given, self.sd, self.unknowns = scene, names, given, sd, unknowns

    def computed(self, at):
        return self.scene.evidence(self.names, dict(zip(self.unknowns, at)))

    def jacobian(self, at, free):
        columns = []
        for k in free:
            ends = [self.computed([x + sign * STEP * (i == k) for i, x in enumerate(at)]) for sign in (1, -1)]
            columns.append([(a - b) / (2 * STEP) / sd for a, b, sd in zip(*ends, self.sd)])
        return mp.matrix(columns).T

    def residuals(self, at, given):
        return mp.matrix([(g - c) / sd for g, c, sd in zip(given, self.computed(at), self.sd)])

    def bend(self, at, free, given):
        """What the second derivatives of the evidence add to the normal matrix where residuals are left."""
        h, off = mpf(10) ** -12, self.residuals(at, given)
        def weighed(moves):
            computed = self.computed([x + sum(sign * h for k, sign in moves if k == i) for i, x in enumerate(at)])
            return sum(r * c / sd for r, c, sd in zip(off, computed, self.sd))
        made = mp.matrix(len(free), len(free))
        for i, one in enumerate(free):
            for j, two in enumerate(free):
                corners = [a * b * weighed([(one, a), (two, b)]) for a in (1, -1) for b in (1, -1)]
                made[i, j] = sum(corners) / (4 * h * h)
        return made

    def least(self, at, free, given=None):
        """Over the free unknowns, the others held: first Gauss-Newton, with shorter steps where they do not lead down, then Newton."""
        given, at = given or self.given, list(at)
        for count in range(60):
            jacobian, off = self.jacobian(at, free), self.residuals(at, given)
            normal = jacobian.T * jacobian - (self.bend(at, free, given) if count > 12 else mp.zeros(len(free), len(free)))
            step, share = mp.lu_solve(normal, jacobian.T * off), mpf(1)
            while True:
                moved = list(at)
                for k, change in zip(free, step):
                    moved[k] += share * change
                if mp.norm(step) * share < mpf(10) ** -10 or mp.norm(self.residuals(moved, given)) < mp.norm(off):
                    break
                share /= 2
            at = moved
            if mp.norm(step) < mpf(10) ** -26:
                return at
        raise ArithmeticError("no convergence")

    def gradient(self, at, k):
        """The derivative of chi-square by an unknown."""
        return -2 * (self.jacobian(at, [k]).T * self.residuals(at, self.given))[0]

    def bounded(self, start, bounds):
        """The least sum of squares within bounds, one bound after the other: -> the unknowns, where each sits, and which are held."""
        free, at, where = list(range(len(start))), start, [None] * len(start)
        while True:
            at = self.least(at, free)
            outside = [(k, end, limit) for k in free for end, limit, sign in (("min", bounds[k][0], 1), ("max", bounds[k][1], -1))
                       if limit is not None and sign * (at[k] - limit) < 0]
            if not outside:
                break
            for k, end, limit in outside:
                free.remove(k)
                at[k], where[k] = limit, end
        for k, end in enumerate(where):
            assert end is None or self.gradient(at, k) * {"min": 1, "max": -1}[end] > 0, "it is held by the bound"
        return at, where, free


def tail(chi_square, freedom):
    return mpf(1) if freedom == 0 else mp.gammainc(mpf(freedom) / 2, chi_square / 2, mp.inf, regularized=True)


def solve(title, vehicles, contact, evidence, unknown):
    certain = {name: quantity(value, kind_of(name)) for name, (value, sd) in evidence.items() if sd is None}
    energies = sum(crush_answer(each["crush"], mpf(1))["crush_energy"] for each in vehicles if "crush" in each)
    names = [name for name in evidence if name not in certain]
    given, deviations = [], []
    for name in names:
        kind = None if name == "crush_energy" else kind_of(name)
        value, sd = evidence[name]
        read_energy = lambda text: number(text.removesuffix(" J"))
        given.append(energies if value == "from crush" else read_energy(value) if kind is None else quantity(value, kind))
        deviations.append(read_energy(sd) if kind is None else quantity(sd, kind))
    size = len(names)
    unknowns = list(unknown)
    at_start, bounds = [], []
    for name, (start, low, high, prior) in unknown.items():
        parse = lambda text: None if text is None else quantity(text, kind_of(name))
        at_start.append(parse(start))
        bounds.append((parse(low), parse(high)))
        if prior is not None:
            names, given, deviations = names + [name], given + [parse(start)], deviations + [parse(prior)]
    fit = Fit(Scene(vehicles, contact, certain), names, given, deviations, unknowns)
    at, where, free = fit.bounded(at_start, bounds)
    residuals, computed = fit.residuals(at, given), fit.computed(at)
    # How the solution moves with each piece, by solving again.
    influence = mp.zeros(len(unknowns), len(names))
    for j, sd in enumerate(deviations):
        h = STEP * sd
        ends = [fit.least(at, free, [g + sign * h * (i == j) for i, g in enumerate(given)]) for sign in (1, -1)]
        for k in range(len(unknowns)):
            influence[k, j] = (ends[0][k] - ends[1][k]) / (2 * h)
    spread = mp.matrix(len(unknowns), len(unknowns))
    for i in range(len(unknowns)):
        for k in range(len(unknowns)):
            spread[i, k] = sum(influence[i, j] * influence[k, j] * deviations[j] ** 2 for j in range(len(names)))
    chi_square, freedom = (residuals.T * residuals)[0], len(names) - len(free)
    sd = [mp.sqrt(spread[k, k]) if k in free else None for k in range(len(unknowns))]
    has_spread = [sd[k] is not None or where[k] is not None for k in range(len(unknowns))]
    entry = lambda value, i, k: value if has_spread[i] and has_spread[k] else None
    probability = tail(chi_square, freedom)
    fitted = lambda j: {"given": given[j], "computed": computed[j], "sd": deviations[j], "standardised_residual": residuals[j]}
    answer = {
        "unknown": {name: {"value": at[k], "sd": sd[k], "at_bound": where[k]} for k, name in enumerate(unknowns)},
        "covariance": {one: {other: entry(spread[i, k], i, k) for k, other in enumerate(unknowns)} for i, one in enumerate(unknowns)},
        "correlation": {one: {other: spread[i, k] / (sd[i] * sd[k]) if sd[i] and sd[k] else None for k, other in enumerate(unknowns)}
                        for i, one in enumerate(unknowns)},
        "evidence": {**{names[j]: fitted(j) for j in range(size)},
                     **{name: {"given": value, "computed": value, "sd": None, "standardised_residual": None} for name, value in certain.items()}},
        **({"priors": {names[j]: fitted(j) for j in range(size, len(names))}} if len(names) > size else {}),
        "influence": {one: {("" if j < size else "prior of ") + names[j]: influence[i, j] for j in range(len(names))}
                      for i, one in enumerate(unknowns)},
        "chi_square": chi_square, "degrees_of_freedom": freedom, "probability": probability,
        "solutions": [{"unknown": dict(zip(unknowns, at)), "chi_square": chi_square, "degrees_of_freedom": freedom, "probability": probability}],
    }
    # Where the evidence agrees only outside of the bounds, that solution stands beside.
    if probability < mpf("1e-3"):
        answer["solutions"] = []
        if any(where):
            free_at = fit.least(at, list(range(len(unknowns))))
            outside = (fit.residuals(free_at, given).T * fit.residuals(free_at, given))[0]
            answer["without_bounds"] = {"unknown": dict(zip(unknowns, free_at)), "chi_square": outside}
    return answer


def case_of(title, vehicles, contact, evidence, unknown):
    bare = lambda text: Bare(text) if " " not in text else text
    def written(value, sd):
        if sd is None:
            return value
        return {"value": value, "sd": sd}
    def sought(start, low, high, prior):
        return {"start": bare(start), **{key: bare(value) for key, value in (("min", low), ("max", high), ("sd", prior)) if value is not None}}
    nested = lambda pairs: {name: value for name, value in pairs}
    return {"schema": Bare("1"), "title": title, "vehicle": vehicles, "contact": {key: bare(value) for key, value in contact.items()},
            "evidence": tree(nested((name, written(*each)) for name, each in evidence.items())),
            "unknown": tree(nested((name, sought(*each)) for name, each in unknown.items()))}


def tree(flat):
    """Dotted names as tables within tables."""
    made = {}
    for name, value in flat.items():
        place = made
        *parts, last = name.split(".")
        for part in parts:
            place = place.setdefault(part, {})
        place[last] = value
    return made


for case in CASES:
    print(show({"case": case_of(*case), "answer": solve(*case)}))
