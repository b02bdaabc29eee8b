#!/usr/bin/env python3
"""Random collisions with the derivatives of every output by every input:  python3 gradients.py > gradients.jsonl

The same seed gives the same file. The solver writes down linear and angular momentum of each vehicle, as that of solve.py, and takes
central differences of its solution with 60 digits. README.md tells more. Needs mpmath and solve.py beside it.
"""
import random

from mpmath import mp, mpf

import solve
from solve import Bare, Unclear, clear, read, show, turned

mp.dps = 60
SEED = "planar-impact gradients 1"
COUNT = 30
FIRST, SECOND = mpf(10) ** -20, mpf(10) ** -15      # steps of the first and of the second differences

# ------------------------------------------------------------------ what a case gives

def numbers(made):
    """Every number of a case by its name, in SI, with zero for what may be added in another way than the file's."""
    given = {}
    for i, vehicle in enumerate(made["vehicle"], 1):
        if "barrier" in vehicle:
            continue
        at = f"vehicle.{i}."
        given[at + "mass"] = read(vehicle["mass"], "mass")
        given[at + "yaw_inertia"] = read(vehicle["yaw_inertia"], "yaw inertia") if "yaw_inertia" in vehicle else mpf(0)
        if "radius_of_gyration" in vehicle:
            given[at + "radius_of_gyration"] = read(vehicle["radius_of_gyration"], "length")
        given[at + "heading"] = read(vehicle["heading"], "angle")
        x, y = (read(part, "speed") for part in vehicle["velocity"]) if "velocity" in vehicle else (mpf(0), mpf(0))
        given[at + "velocity.x"], given[at + "velocity.y"] = x, y
        given[at + "speed"] = read(vehicle["speed"], "speed") if "speed" in vehicle else mpf(0)
        given[at + "yaw_rate"] = read(vehicle["yaw_rate"], "yaw rate") if "yaw_rate" in vehicle else mpf(0)
        forward, left = vehicle["impact_center"]
        given[at + "impact_center.forward"], given[at + "impact_center.left"] = read(forward, "length"), read(left, "length")
        if "crush" in vehicle:
            given.update(crush_numbers(vehicle["crush"], at + "crush."))
    contact = made["contact"]
    given["contact.crush_plane"] = read(contact["crush_plane"], "angle")
    given["contact.restitution"] = read(contact["restitution"], "")
    ratio, moment = contact.get("impulse_ratio", "critical"), contact.get("moment")
    given["contact.impulse_ratio"] = read(ratio, "") if isinstance(ratio, Bare) else mpf(0)
    if isinstance(ratio, dict):
        given["contact.impulse_ratio.of_critical"] = read(ratio["of_critical"], "")
    if "friction" in contact:
        given["contact.friction"] = read(contact["friction"], "")
    if isinstance(moment, dict):
        given["contact.moment.of_critical"] = read(moment["of_critical"], "")
    elif moment is not None:
        given["contact.moment"] = read(moment, "moment")
    return given


def crush_numbers(crush, at):
    """Width, depths, and the line d0 + d1 C whose square is twice the energy per width."""
    energy_at = solve.energy_of_depth(crush["stiffness"])
    at_0, at_1 = (mp.sqrt(2 * energy_at(mpf(depth))) for depth in (0, 1))
    depths = {f"{at}depths.{k}": read(depth, "length") for k, depth in enumerate(crush["depths"], 1)}
    return {at + "width": read(crush["width"], "length"), **depths, at + "d0": at_0, at + "d1": at_1 - at_0}


# ------------------------------------------------------------------ mechanics

class Body:
    """A vehicle on the ground axes; of a barrier all is zero."""

    def __init__(self, given, i):
        at, zero = f"vehicle.{i}.", mpf(0)
        self.fixed, self.sign = at + "mass" not in given, 1 if i == 1 else -1
        self.mass = self.inertia = self.turn = zero
        self.motion, self.arm = (zero, zero, zero), (zero, zero)
        if self.fixed:
            return
        self.mass = given[at + "mass"]
        self.inertia = given[at + "yaw_inertia"] + self.mass * given.get(at + "radius_of_gyration", zero) ** 2
        self.turn = given[at + "heading"]
        x, y = turned(given[at + "speed"], zero, self.turn)
        self.motion = (x + given[at + "velocity.x"], y + given[at + "velocity.y"], given[at + "yaw_rate"])
        self.arm = turned(given[at + "impact_center.forward"], given[at + "impact_center.left"], self.turn)


def collide(bodies, plane, normal_velocity, tangential, turning):
    """Momentum of each body, the normal separation velocity, one tangential condition, ("velocity", V_t) or ("ratio", mu), and one
    of turning, ("rate", relative yaw rate) or ("moment", M). -> P_n, P_t, M and the motions after."""
    cosine, sine = mp.cos(plane), mp.sin(plane)
    moving = [body for body in bodies if not body.fixed]
    size = 3 * len(moving) + 3
    n, t, m = size - 3, size - 2, size - 1
    matrix, right = mp.zeros(size, size), mp.zeros(size, 1)
    for place, body in enumerate(moving):
        rx, ry = body.arm
        pushes = [(cosine, -sine, 0), (sine, cosine, 0), (rx * sine - ry * cosine, rx * cosine + ry * sine, 1)]
        for k, (inertia, before, push) in enumerate(zip((body.mass, body.mass, body.inertia), body.motion, pushes)):
            row = 3 * place + k
            matrix[row, row], right[row] = inertia, inertia * before
            for column, share in zip((n, t, m), push):
                matrix[row, column] = -body.sign * share
        for row, (ax, ay) in ((n, (cosine, sine)), (t, (-sine, cosine))):
            for k, share in enumerate((ax, ay, rx * ay - ry * ax)):
                matrix[row, 3 * place + k] = -body.sign * share
        matrix[m, 3 * place + 2] = -body.sign
    right[n], right[t], right[m] = normal_velocity, tangential[1], turning[1]
    for row, kind, column in ((t, tangential, n), (m, turning, m)):
        if kind[0] in ("ratio", "moment"):
            for k in range(size):
                matrix[row, k] = 0
            matrix[row, row] = 1
            right[row] = turning[1] if row == m else 0
            if row == t:
                matrix[row, column] = -kind[1]
    solved = mp.lu_solve(matrix, right)
    motions = [(mpf(0),) * 3 if body.fixed else tuple(solved[3 * moving.index(body) + k] for k in range(3)) for body in bodies]
    return solved[n], solved[t], solved[m], motions


def outputs(made, given):
    """Every output by its name, and how the tangential process ended."""
    contact, bodies = made["contact"], [Body(given, i) for i in (1, 2)]
    plane, e = given["contact.crush_plane"], given["contact.restitution"]
    before = [body.motion for body in bodies]
    v_n, v_t = solve.contact_velocity(bodies, before, plane)
    slibar = contact.get("tangential_law") == "kudlich-slibar"
    end = ("velocity", -e * v_t if slibar else mpf(0))
    turning = ("moment", given.get("contact.moment", mpf(0)))
    if "contact.moment.of_critical" in given:
        rate = before[1][2] - before[0][2]
        critical = collide(bodies, plane, -e * v_n, end, ("rate", -e * rate if slibar else mpf(0)))
        turning = ("moment", given["contact.moment.of_critical"] * critical[2])
    stuck = collide(bodies, plane, -e * v_n, ("velocity", mpf(0)), turning)
    ending = collide(bodies, plane, -e * v_n, end, turning)
    limit, form, ratio = ending[1] / ending[0], "end", None
    if "contact.friction" in given:
        if clear(abs(limit) - given["contact.friction"]):
            form, ratio = "sliding", given["contact.friction"] * mp.sign(limit)
    elif "contact.impulse_ratio.of_critical" in given:
        form, ratio = "sliding", given["contact.impulse_ratio.of_critical"] * limit
    elif isinstance(contact.get("impulse_ratio"), Bare):
        form, ratio = "sliding", given["contact.impulse_ratio"]
    p_n, p_t, moment, after = ending if form == "end" else collide(bodies, plane, -e * v_n, ("ratio", ratio), turning)
    V_n, V_t = solve.contact_velocity(bodies, after, plane)
    energies = [solve.kinetic_energy(bodies, motions) for motions in (before, after)]
    works = [-p * (v + V) / 2 for p, v, V in ((p_n, v_n, V_n), (p_t, v_t, V_t), (moment, before[1][2] - before[0][2], after[1][2] - after[0][2]))]
    px, py = turned(p_n, p_t, plane)
    found = {"contact.restitution": e, "contact.impulse_ratio": p_t / p_n, "contact.critical_impulse_ratio": stuck[1] / stuck[0],
             "contact.impulse.normal": p_n, "contact.impulse.tangential": p_t, "contact.impulse.x": px, "contact.impulse.y": py,
             "contact.approach.normal": v_n, "contact.approach.tangential": v_t, "contact.separation.normal": V_n,
             "contact.separation.tangential": V_t, "energy.before": energies[0], "energy.after": energies[1],
             "energy.loss": energies[0] - energies[1], "energy.normal_work": works[0], "energy.tangential_work": works[1]}
    if "moment" in contact:
        found.update({"contact.impulse.moment": moment, "energy.moment_work": works[2]})
    for i, (body, motion) in enumerate(zip(bodies, after), 1):
        change = [mpf(0)] * 2 if body.fixed else [a - b for a, b in zip(motion[:2], body.motion)]
        ahead, left = turned(-body.sign * px, -body.sign * py, -body.turn)
        named = {"velocity.x": motion[0], "velocity.y": motion[1], "yaw_rate": motion[2], "delta_v.x": change[0], "delta_v.y": change[1],
                 "delta_v_magnitude": mp.hypot(*change), "pdof": mpf(0) if body.fixed else mp.atan2(-left, ahead)}
        found.update({f"vehicle.{i}.{name}": value for name, value in named.items()})
        found.update(crush_outputs(given, f"vehicle.{i}.", body.mass))
    return found, (form, stuck, ending, energies)


def crush_outputs(given, at, mass):
    if at + "crush.width" not in given:
        return {}
    depths = [given[name] for name in given if name.startswith(at + "crush.depths.")]
    energy_at = lambda depth: (given[at + "crush.d0"] + given[at + "crush.d1"] * depth) ** 2 / 2
    pieces = list(zip(depths, depths[1:]))
    energy = given[at + "crush.width"] * sum(energy_at(a) + 4 * energy_at((a + b) / 2) + energy_at(b) for a, b in pieces) / 6 / len(pieces)
    return {at + "crush_energy": energy, at + "equivalent_energy_speed": mp.sqrt(2 * energy / mass),
            at + "mean_depth": sum((a + b) / 2 for a, b in pieces) / len(pieces)}


# ------------------------------------------------------------------ cases

def case(rng):
    """A case that is solved, at a distance from every boundary between two outcomes."""
    while True:
        made = solve.case(rng)
        contact = made["contact"]
        for vehicle in made["vehicle"]:
            if "barrier" not in vehicle and rng.random() < 0.3:
                vehicle["crush"] = solve.crush(rng)
        moment = rng.choice([None, None, "given", "of_critical"])
        if moment == "given":
            contact["moment"] = solve.written(rng, "moment", rng.uniform(-2000, 2000))
        elif moment:
            contact["moment"] = {"of_critical": Bare(rng.choice(["1", "0", solve.literal(rng, rng.uniform(0, 1))]))}
        try:
            # The ratio is drawn when the limit is known.
            contact["impulse_ratio"] = "critical"
            _, (_, stuck, ending, _) = outputs(made, numbers(made))
            del contact["impulse_ratio"]
            solve.ratio_form(rng, contact, ending[1] / ending[0])
            if is_solved(made):
                return made
        except (Unclear, ZeroDivisionError):
            continue


def is_solved(made):
    given = numbers(made)
    found, (form, stuck, ending, energies) = outputs(made, given)
    bodies = [Body(given, i) for i in (1, 2)]
    plane = given["contact.crush_plane"]
    offset = turned(bodies[0].arm[0] - bodies[1].arm[0], bodies[0].arm[1] - bodies[1].arm[1], -plane)
    approach, speed = found["contact.approach.normal"], max(mp.hypot(*body.motion[:2]) for body in bodies)
    if abs(offset[0]) < mp.hypot(*offset) / 20 or abs(approach) <= speed / 20 or approach * offset[0] > 0:
        return False
    side = mp.sign(offset[0])
    if any(impulse[0] * side > 0 or abs(impulse[1] / impulse[0]) > 5 for impulse in (stuck, ending)):
        return False
    ratio, limit = found["contact.impulse_ratio"], ending[1] / ending[0]
    if form == "sliding" and (ratio * limit < 0 or abs(ratio) > abs(limit) * mpf("0.999") and ratio != limit):
        return False
    size = max(energies[0], mp.hypot(found["contact.impulse.normal"], found["contact.impulse.tangential"]) * abs(approach))
    return found["contact.impulse.normal"] * side < 0 and found["energy.loss"] > size / 1000


# ------------------------------------------------------------------ derivatives

def shifted(given, steps):
    moved = dict(given)
    for name, step in steps:
        moved[name] = moved[name] + step
    return moved


def first(made, given, name):
    """The derivatives of every output by one input."""
    up, down = (outputs(made, shifted(given, [(name, step)]))[0] for step in (FIRST, -FIRST))
    return {output: (up[output] - down[output]) / (2 * FIRST) for output in up}


def second(made, given, one, two):
    """Those by two inputs, which may be one."""
    corners = [(a, b, outputs(made, shifted(given, [(one, a * SECOND), (two, b * SECOND)]))[0]) for a in (1, -1) for b in (1, -1)]
    return {output: sum(a * b * at[output] for a, b, at in corners) / (4 * SECOND ** 2) for output in corners[0][2]}


def row(derivatives, names):
    """In the order of the names, 14 digits of each; the differences leave 1e-25 of what vanishes."""
    digits = lambda value: "0" if abs(value) < mpf(10) ** -25 else mp.nstr(value, 14, min_fixed=-3, max_fixed=15)
    return [Bare(digits(derivatives[name])) for name in names]


def main():
    rng = random.Random(SEED)
    for _ in range(COUNT):
        made = case(rng)
        given = numbers(made)
        inputs, of = list(given), list(outputs(made, given)[0])
        pairs = [tuple(rng.choice(inputs) for _ in range(2)) for _ in range(6)]
        line = {"case": made, "of": of, "d": {name: row(first(made, given, name), of) for name in inputs},
                "d2": [{"by": list(pair), "d2": row(second(made, given, *pair), of)} for pair in pairs]}
        print(show(line))


if __name__ == "__main__":
    main()
