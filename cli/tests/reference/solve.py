#!/usr/bin/env python3
"""Random collisions with their answers, from an independent solver:  python3 solve.py > cases.jsonl

The same seed gives the same file. Needs mpmath and nothing else. README.md tells how the answers are made.
"""
import json
import random
import re
from fractions import Fraction

from mpmath import mp, mpf

mp.dps = 50
SEED = "planar-impact reference 1"
SOLVED, REFUSED = 180, 6                  # cases that are solved, and cases of each reason to refuse
CLEAR = mpf(10) ** -6                     # how far from every boundary between two outcomes a case must be

# ------------------------------------------------------------------ quantities

POUND, GRAVITY, FOOT, INCH = Fraction("0.45359237"), Fraction("9.80665"), Fraction("0.3048"), Fraction("0.0254")
POUND_FORCE = POUND * GRAVITY
SLUG = POUND_FORCE / FOOT
UNITS = {
    "mass": {"kg": 1, "g": Fraction(1, 1000), "t": 1000, "lb": POUND, "slug": SLUG},
    "length": {"m": 1, "cm": Fraction(1, 100), "mm": Fraction(1, 1000), "in": INCH, "ft": FOOT},
    "speed": {"m/s": 1, "km/h": Fraction(5, 18), "mph": Fraction("0.44704"), "ft/s": FOOT},
    "angle": {"rad": 1, "deg": None},
    "yaw rate": {"rad/s": 1, "deg/s": None},
    "yaw inertia": {"kg m^2": 1, "slug ft^2": SLUG * FOOT ** 2, "lbf s^2 ft": POUND_FORCE * FOOT,
                    "lbf s^2 in": POUND_FORCE * INCH, "lb ft^2": POUND * FOOT ** 2},
    "moment": {"N m s": 1, "lbf s ft": POUND_FORCE * FOOT},
    "stiffness": {"N/m": 1, "N/cm": 100, "kN/m": 1000, "lbf/in": POUND_FORCE / INCH},
    "stiffness per width": {"N/m^2": 1, "lbf/in^2": POUND_FORCE / INCH ** 2},
}


class Bare(str):
    """A number that stands in the case without quotes: SI, or pure."""


def factor(kind, unit):
    """The SI value of one of a unit."""
    known = UNITS[kind][unit]
    return mp.pi / 180 if known is None else mpf(Fraction(known).numerator) / Fraction(known).denominator


def literal(rng, value):
    """A decimal number of three to nine significant digits."""
    places = rng.choice([3, 4, 5, 6, 7, 9])
    return f"{float(value):.{places}g}" if value else "0"


def written(rng, kind, si, bare=0.2):
    """A quantity as a case has it: mostly with a unit, sometimes a bare number in SI."""
    if rng.random() < bare:
        return Bare(literal(rng, si))
    unit = rng.choice(sorted(UNITS[kind]))
    return f"{literal(rng, si / factor(kind, unit))} {unit}"


def read(text, kind):
    """What a quantity is in SI, to 50 digits."""
    number, unit = (text, None) if isinstance(text, Bare) else text.split(" ", 1)
    exact = Fraction(number)
    value = mpf(exact.numerator) / exact.denominator
    return value if unit is None else value * factor(kind, unit)


# ------------------------------------------------------------------ cases

NAMES = ["sedan", "pickup", "van", "bus", "Käfer", "motorcycle", "truck 7.5 t", "a \"quoted\" name", "車"]


def angle(rng):
    """Over more than the full circle; right angles often, because they are so in practice."""
    if rng.random() < 0.2:
        return f"{rng.choice([0, 90, 180, 270, -90, -180, 45, -45, 30, 22.5, 360, 135])} deg"
    return written(rng, "angle", rng.uniform(-6.28, 6.28), 0.15)


def crush(rng):
    """The crush of a vehicle, which has no part in the impact."""
    form = rng.randrange(3)
    if form == 0:
        stiffness = {"d0": rng.choice(["48.27 lbf^0.5", "90 N^0.5"]), "d1": rng.choice(["162.8 lbf^0.5/ft", "900 N^0.5/m"])}
    elif form == 1:
        stiffness = {"A": written(rng, "stiffness", rng.uniform(2e4, 8e4)), "B": written(rng, "stiffness per width", rng.uniform(2e5, 9e5))}
    else:
        stiffness = {"b0": written(rng, "speed", rng.uniform(1, 4)), "b1": "25 mph/ft",
                     "test_mass": written(rng, "mass", rng.uniform(900, 2200)), "test_width": written(rng, "length", rng.uniform(1.2, 1.9))}
    depths = [written(rng, "length", rng.uniform(0.05, 0.8)) for _ in range(rng.choice([2, 4, 6]))]
    return {"width": written(rng, "length", rng.uniform(0.5, 2)), "depths": depths, "stiffness": stiffness}


def vehicle(rng):
    sort = rng.random()
    mass = rng.uniform(800, 2800) if sort < 0.6 else rng.uniform(5000, 40000) if sort < 0.8 else rng.uniform(150, 600)
    length = 2.2 + 0.3 * (mass / 250) ** 0.5
    radius = length * rng.uniform(0.24, 0.36)
    made = {"name": rng.choice(NAMES), "mass": written(rng, "mass", mass)}
    if rng.random() < 0.5:
        made["radius_of_gyration"] = written(rng, "length", radius)
    else:
        made["yaw_inertia"] = written(rng, "yaw inertia", mass * radius * radius)
    made["heading"] = angle(rng)
    speed = rng.choice([0, rng.uniform(1, 15), rng.uniform(1, 35), rng.uniform(1, 60)])
    if rng.random() < 0.5:
        made["speed"] = written(rng, "speed", speed if rng.random() < 0.95 else -speed)
    else:
        course = mpf(rng.uniform(-3.14, 3.14))
        made["velocity"] = [written(rng, "speed", speed * mp.cos(course)), written(rng, "speed", speed * mp.sin(course))]
    if rng.random() < 0.6:
        made["yaw_rate"] = written(rng, "yaw rate", rng.choice([0, rng.uniform(-1, 1), rng.uniform(-6, 6)]))
    forward, left = length / 2 * rng.uniform(-1, 1), 0.9 * rng.uniform(-1, 1)
    if rng.random() < 0.7:
        forward, left = rng.choice([(length / 2, left), (-length / 2, left), (forward, 0.9), (forward, -0.9)])
    made["impact_center"] = [written(rng, "length", forward), written(rng, "length", left)]
    if rng.random() < 0.1:
        made["crush"] = crush(rng)
    return made


def case(rng):
    """A case but for its impulse ratio."""
    vehicles = [vehicle(rng), vehicle(rng)]
    if rng.random() < 0.2:
        vehicles[rng.randrange(2)] = {"name": "wall", "barrier": True}
    restitution = rng.choice([0, 1, rng.uniform(0, 0.3), rng.uniform(0, 0.3), rng.uniform(0, 1), rng.uniform(0, 1)])
    contact = {"crush_plane": angle(rng), "restitution": Bare(literal(rng, restitution))}
    law = rng.choice(["brach", "brach", "kudlich-slibar"])
    if law != "brach" or rng.random() < 0.3:
        contact["tangential_law"] = law
    return {"schema": Bare("1"), "title": "", "vehicle": vehicles, "contact": contact}


def ratio_form(rng, contact, limit):
    """Adds one of the ways to say the impulse ratio; limit is the ratio that ends sliding."""
    form = rng.choice(["absent", "critical", "number", "number", "of_critical", "friction", "friction"])
    if form == "critical":
        contact["impulse_ratio"] = "critical"
    elif form == "number":
        share = rng.uniform(0, 0.98) if rng.random() < 0.8 else rng.choice([0, 0, 1.3, 2.5, -0.4])
        contact["impulse_ratio"] = Bare(literal(rng, share * limit))
    elif form == "of_critical":
        contact["impulse_ratio"] = {"of_critical": Bare(rng.choice([literal(rng, rng.uniform(0.01, 0.99)), "0.975", "0", "1"]))}
    elif form == "friction":
        contact["friction"] = Bare(literal(rng, rng.choice([0, 0.2, 0.45, 0.7, 1.2, rng.uniform(0, 1.5)])))


# ------------------------------------------------------------------ crush

def energy_of_depth(stiffness):
    """The energy per width that a depth stands for, from the law of each form: (d0 + d1 C)^2 / 2, the integral of the force
    A + B C from where it vanishes, or the kinetic energy of the barrier test that leaves the depth."""
    if "d0" in stiffness:
        (d0, unit_0), (d1, unit_1) = (stiffness[key].split(" ") for key in ("d0", "d1"))
        pound = mp.sqrt(mpf(POUND_FORCE.numerator) / POUND_FORCE.denominator)
        d0 = mpf(d0) * {"lbf^0.5": pound, "N^0.5": 1}[unit_0]
        d1 = mpf(d1) * {"lbf^0.5/ft": pound / factor("length", "ft"), "N^0.5/m": 1}[unit_1]
        return lambda depth: (d0 + d1 * depth) ** 2 / 2
    if "A" in stiffness:
        force, slope = read(stiffness["A"], "stiffness"), read(stiffness["B"], "stiffness per width")
        return lambda depth: force ** 2 / (2 * slope) + force * depth + slope * depth ** 2 / 2
    speed, slope = read(stiffness["b0"], "speed"), mpf(25) * factor("speed", "mph") / factor("length", "ft")
    assert stiffness["b1"] == "25 mph/ft"
    line_mass = read(stiffness["test_mass"], "mass") / read(stiffness["test_width"], "length")
    return lambda depth: line_mass * (speed + slope * depth) ** 2 / 2


def crush_answer(made, mass):
    """Simpson's rule, which is exact for the quadratic energy over each straight piece of the profile."""
    depths, energy_at = [read(depth, "length") for depth in made["depths"]], energy_of_depth(made["stiffness"])
    pieces, width = list(zip(depths, depths[1:])), read(made["width"], "length")
    per_width = sum(energy_at(a) + 4 * energy_at((a + b) / 2) + energy_at(b) for a, b in pieces) / 6 / len(pieces)
    mean_depth = sum((a + b) / 2 for a, b in pieces) / len(pieces)
    return {"crush_energy": width * per_width, "equivalent_energy_speed": mp.sqrt(2 * width * per_width / mass), "mean_depth": mean_depth}


# ------------------------------------------------------------------ mechanics

class Body:
    """A vehicle in SI on the ground axes; of a barrier all is zero."""

    def __init__(self, made):
        zero = mpf(0)
        self.name, self.fixed = made["name"], "barrier" in made
        self.mass = self.inertia = self.turn = zero
        self.motion, self.arm, self.crushed = (zero, zero, zero), (zero, zero), {}
        if self.fixed:
            return
        self.mass = read(made["mass"], "mass")
        if "yaw_inertia" in made:
            self.inertia = read(made["yaw_inertia"], "yaw inertia")
        else:
            self.inertia = self.mass * read(made["radius_of_gyration"], "length") ** 2
        self.turn = read(made["heading"], "angle")
        if "speed" in made:
            velocity = turned(read(made["speed"], "speed"), zero, self.turn)
        else:
            velocity = [read(part, "speed") for part in made["velocity"]]
        rate = read(made["yaw_rate"], "yaw rate") if "yaw_rate" in made else zero
        self.motion = (*velocity, rate)
        self.arm = turned(*(read(part, "length") for part in made["impact_center"]), self.turn)
        if "crush" in made:
            self.crushed = crush_answer(made["crush"], self.mass)


def turned(x, y, by):
    return x * mp.cos(by) - y * mp.sin(by), x * mp.sin(by) + y * mp.cos(by)


def contact_velocity(bodies, motions, plane):
    """The velocity of body 2 less that of body 1 at the impact center, along n and t."""
    points = [(x - w * body.arm[1], y + w * body.arm[0]) for body, (x, y, w) in zip(bodies, motions)]
    return turned(points[1][0] - points[0][0], points[1][1] - points[0][1], -plane)


def collide(bodies, plane, restitution, tangential):
    """Solves linear and angular momentum of each body, restitution, and one tangential condition: ("velocity", V_t) or
    ("ratio", mu), all at once. -> P_n, P_t and the motions after."""
    cosine, sine = mp.cos(plane), mp.sin(plane)
    moving = [body for body in bodies if not body.fixed]
    size = 3 * len(moving) + 2
    normal, tangent = size - 2, size - 1
    matrix, right = mp.zeros(size, size), mp.zeros(size, 1)
    for place, body in enumerate(moving):
        sign, (rx, ry) = 1 if body is bodies[0] else -1, body.arm
        # m V - P = m v along x and y; I W - r x P = I w. P is the impulse on body 1, and -P that on body 2.
        pushes = [(cosine, -sine), (sine, cosine), (rx * sine - ry * cosine, rx * cosine + ry * sine)]
        for k, (inertia, before, push) in enumerate(zip((body.mass, body.mass, body.inertia), body.motion, pushes)):
            row = 3 * place + k
            matrix[row, row] = inertia
            matrix[row, normal], matrix[row, tangent] = -sign * push[0], -sign * push[1]
            right[row] = inertia * before

    def contact_velocity_along(row, ax, ay):
        for place, body in enumerate(moving):
            sign = -1 if body is bodies[0] else 1
            for k, share in enumerate((ax, ay, body.arm[0] * ay - body.arm[1] * ax)):
                matrix[row, 3 * place + k] = sign * share

    contact_velocity_along(normal, cosine, sine)
    right[normal] = -restitution * contact_velocity(bodies, [body.motion for body in bodies], plane)[0]
    if tangential[0] == "velocity":
        contact_velocity_along(tangent, -sine, cosine)
        right[tangent] = tangential[1]
    else:
        matrix[tangent, tangent], matrix[tangent, normal] = mpf(1), -tangential[1]
    solved = mp.lu_solve(matrix, right)
    motions = [(mpf(0),) * 3 if body.fixed else tuple(solved[3 * moving.index(body) + k] for k in range(3)) for body in bodies]
    return solved[normal], solved[tangent], motions


def kinetic_energy(bodies, motions):
    return sum((b.mass * (x * x + y * y) + b.inertia * w * w for b, (x, y, w) in zip(bodies, motions)), mpf(0)) / 2


class Unclear(Exception):
    """Too near to a boundary between two outcomes, ill-conditioned, or read in two ways by reasonable people."""


def clear(margin):
    """Whether the margin is above zero."""
    if abs(margin) < CLEAR:
        raise Unclear
    return margin > 0


def answer(rng, made):
    """Adds an impulse ratio to a case. -> the status, the reason to refuse or None, and the JSON that `solve` prints."""
    contact, bodies = made["contact"], [Body(each) for each in made["vehicle"]]
    plane, restitution = read(contact["crush_plane"], "angle"), read(contact["restitution"], "")
    before = [body.motion for body in bodies]
    approach = contact_velocity(bodies, before, plane)
    # The center of mass 2 from that of 1: both reach the impact center by their arms, and a barrier's arm is zero.
    offset = turned(bodies[0].arm[0] - bodies[1].arm[0], bodies[0].arm[1] - bodies[1].arm[1], -plane)
    speed = max([mp.hypot(x, y) for x, y, _ in before] + [mp.hypot(*approach)])
    if abs(offset[0]) < mp.hypot(*offset) / 20 or abs(approach[0]) <= speed / 20:
        raise Unclear
    if approach[0] * offset[0] > 0:
        return 3, "separating", None
    side = mp.sign(offset[0])
    end = collide(bodies, plane, restitution, ("velocity", mpf(0)))
    critical = end[1] / end[0]
    if contact.get("tangential_law") == "kudlich-slibar":
        # The impulse up to the common velocity and e times as much again: both velocities turn round by the factor e.
        end = collide(bodies, plane, restitution, ("velocity", -restitution * approach[1]))
    limit = end[1] / end[0]
    if end[0] * side > 0 or max(abs(limit), abs(critical)) > 20:
        if limit == critical and rng.random() < 0.3 and clear(end[0] * side / (mp.hypot(*end[:2]))):
            return 3, "pulling", None     # the default ratio, where sliding does not end by pushing
        raise Unclear
    ratio_form(rng, contact, limit)
    given, form = contact.get("impulse_ratio", "critical"), "end"
    if "friction" in contact:
        friction = read(contact["friction"], "")
        if clear(abs(limit) - friction):
            form, ratio = "sliding", friction * mp.sign(limit)
    elif isinstance(given, dict):
        share = read(given["of_critical"], "")
        form, ratio = ("end" if share == 1 else "sliding"), share * limit
    elif isinstance(given, Bare):
        form, ratio = "sliding", read(given, "")
        beyond = [ratio != 0 and not clear(1 - ratio / end) for end in (limit, critical)]
        wrong_sign = [ratio * end < 0 for end in (limit, critical)]
        if len({a or b for a, b in zip(beyond, wrong_sign)}) > 1:
            raise Unclear                 # under a law of its own, one may hold a number against either limit
        if beyond[0] or wrong_sign[0]:
            return 3, "beyond critical", None
    if form == "end":
        (normal, tangent, after), ratio = end, limit
    else:
        normal, tangent, after = collide(bodies, plane, restitution, ("ratio", ratio))
    if not clear(-normal * side / mp.hypot(normal, tangent)):
        return 3, "pulling", None
    separation = contact_velocity(bodies, after, plane)
    work = [-p * (v + V) / 2 for p, v, V in zip((normal, tangent), approach, separation)]
    energy = [kinetic_energy(bodies, motions) for motions in (before, after)]
    size = max(energy[0], mp.hypot(normal, tangent) * mp.hypot(*approach))
    loss = energy[0] - energy[1]
    assert abs(loss + sum(work)) < mpf(10) ** -40 * size
    if abs(loss) > mpf(10) ** -40 * size and not clear(loss / size):
        return 3, "energy gain", None
    if max(abs(w) for _, _, w in after) < max(mpf("0.01"), max(abs(w) for _, _, w in before) / 100):
        raise Unclear                     # nothing to hold the rounding of the yaw rates against
    px, py = turned(normal, tangent, plane)
    vehicles = []
    for body, motion, sign in zip(bodies, after, (1, -1)):
        change = [0, 0] if body.fixed else [a - b for a, b in zip(motion[:2], body.motion)]
        ahead, left = turned(-sign * px, -sign * py, -body.turn)
        pdof = mpf(0) if body.fixed else mp.atan2(-left, ahead)
        vehicles.append({"name": body.name, "velocity": list(motion[:2]), "yaw_rate": motion[2], "delta_v": change,
                         "delta_v_magnitude": mp.hypot(*change), "pdof": pdof, **body.crushed})
    pair = lambda v: {"normal": v[0], "tangential": v[1]}
    return 0, None, {
        "schema": 1, "title": made["title"], "vehicles": vehicles,
        "contact": {"restitution": restitution, "impulse_ratio": ratio, "critical_impulse_ratio": critical,
                    "impulse": {**pair((normal, tangent)), "x": px, "y": py}, "approach": pair(approach), "separation": pair(separation)},
        "energy": {"before": energy[0], "after": energy[1], "loss": loss, "normal_work": work[0], "tangential_work": work[1]}}


# ------------------------------------------------------------------ the file

def digits(value):
    """25 of them; what is left of an exact zero is one."""
    return "0" if abs(value) < mpf(10) ** -35 else mp.nstr(value, 25, min_fixed=-5, max_fixed=20)


def show(value):
    if isinstance(value, Bare):
        return str(value)
    if isinstance(value, mpf):
        return json.dumps(digits(value))
    if isinstance(value, dict):
        return "{" + ", ".join(f"{json.dumps(key, ensure_ascii=False)}: {show(each)}" for key, each in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(show(each) for each in value) + "]"
    return json.dumps(value, ensure_ascii=False)


def main():
    rng = random.Random(SEED)
    wanted = {None: SOLVED, **dict.fromkeys(["separating", "beyond critical", "pulling", "energy gain"], REFUSED)}
    number = 0
    while any(wanted.values()):
        made = case(rng)
        try:
            status, reason, solved = answer(rng, made)
        except Unclear:
            continue
        if not wanted[reason]:
            continue
        wanted[reason], number = wanted[reason] - 1, number + 1
        made["title"] = f"case {number}"
        if solved:
            solved["title"] = made["title"]
        line = {"case": made, "status": status, **({"answer": solved} if solved else {"reason": reason})}
        print(show(line))


if __name__ == "__main__":
    main()
