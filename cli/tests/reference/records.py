#!/usr/bin/env python3
"""Collision records with what a checker must find in them, from a solver that shares nothing with the program.

    pip install mpmath
    python3 records.py > records.jsonl

Each line is {"expected": RULE or null, "record": RECORD}: null where nothing is wrong, else the name of a rule that must be found broken, among others maybe.
Lengths are in m, masses in kg, times in s, angles in degrees.

For each body linear momentum along x and y and angular momentum about its center of mass, for the pair restitution along the normal and one condition along the
tangent: one linear system, solved by elimination with 50 digits. What is reported of energies is the difference of kinetic energies, and the works are those of the
impulse at its point; that both agree to 40 digits is asserted.
"""

import copy
import json
import random

from mpmath import mp, mpf

mp.dps = 50
SEED = 20260814
DEGREE = mp.pi / 180


class Body:
    def __init__(self, mass=None, gyration=None, arm=(0, 0), velocity=(0, 0), yaw_rate=0):
        """arm: from the center of mass to the contact point, in ground axes. Without a mass it is fixed."""
        self.fixed = mass is None
        self.mass = mpf(mass or 0)
        self.inertia = self.mass * mpf(gyration or 0) ** 2
        self.arm = [mpf(x) for x in arm]
        self.velocity = [mpf(x) for x in velocity]
        self.yaw_rate = mpf(yaw_rate)


def collide(bodies, angle, restitution, condition):
    """condition: ("slip", factor), V_t = factor v_t; or ("ratio", mu). -> P_x, P_y, and velocity and yaw rate of each body after."""
    n = (mp.cos(angle), mp.sin(angle))
    t = (-n[1], n[0])
    # Unknowns: V_1x V_1y W_1 V_2x V_2y W_2 P_x P_y, P on body 1.
    matrix, right = mp.zeros(8, 8), mp.zeros(8, 1)
    for i, body in enumerate(bodies):
        sign, base = (1, -1)[i], 3 * i
        before = (*body.velocity, body.yaw_rate)
        inertia = (1, 1, 1) if body.fixed else (body.mass, body.mass, body.inertia)
        pushes = ((1, 0), (0, 1), (-body.arm[1], body.arm[0]))
        for k in range(3):
            matrix[base + k, base + k] = inertia[k]
            right[base + k] = inertia[k] * before[k]
            if not body.fixed:
                matrix[base + k, 6], matrix[base + k, 7] = -sign * pushes[k][0], -sign * pushes[k][1]

    def relative(axis):
        """Coefficients of the velocity at the contact point of body 2 less that of body 1, along an axis."""
        row = []
        for i, body in enumerate(bodies):
            sign = (-1, 1)[i]
            row += [sign * axis[0], sign * axis[1], sign * (body.arm[0] * axis[1] - body.arm[1] * axis[0])]
        return row

    before = [x for body in bodies for x in (*body.velocity, body.yaw_rate)]
    at = lambda axis, motion: sum(c * x for c, x in zip(relative(axis), motion))
    for k, coefficient in enumerate(relative(n)):
        matrix[6, k] = coefficient
    right[6] = -restitution * at(n, before)
    if condition[0] == "slip":
        for k, coefficient in enumerate(relative(t)):
            matrix[7, k] = coefficient
        right[7] = condition[1] * at(t, before)
    else:
        matrix[7, 6], matrix[7, 7] = t[0] - condition[1] * n[0], t[1] - condition[1] * n[1]
    solved = mp.lu_solve(matrix, right)
    after = [solved[k] for k in range(6)]
    impulse = (solved[6], solved[7])
    along = [impulse[0] * n[0] + impulse[1] * n[1], impulse[0] * t[0] + impulse[1] * t[1]]
    speeds = [(at(axis, before), at(axis, after)) for axis in (n, t)]
    works = [-p * (v + w) / 2 for p, (v, w) in zip(along, speeds)]
    energy = lambda motion: sum(
        (b.mass * (motion[3 * i] ** 2 + motion[3 * i + 1] ** 2) + b.inertia * motion[3 * i + 2] ** 2) / 2 for i, b in enumerate(bodies))
    # A moving barrier does work on the ground.
    if not any(b.fixed and any(b.velocity) for b in bodies):
        assert abs(energy(before) - energy(after) + sum(works)) < mpf(10) ** -40 * energy(before)
    return impulse, after, along, speeds, works, (energy(before), energy(after))


def record(name, bodies, angle, restitution, condition, point=(0, 0), **model):
    impulse, after, along, speeds, works, energies = collide(bodies, angle, restitution, condition)
    made = {"id": name, "bodies": []}
    changes = []
    for i, body in enumerate(bodies):
        if body.fixed:
            shown = {"fixed": True}
            if any(body.velocity):
                shown["before"] = {"v": body.velocity}
            changes.append(mpf(0))
        else:
            motion = after[3 * i:3 * i + 3]
            changes.append(mp.hypot(motion[0] - body.velocity[0], motion[1] - body.velocity[1]))
            shown = {"mass": body.mass, "yaw_inertia": body.inertia, "cg": [point[0] - body.arm[0], point[1] - body.arm[1]],
                     "before": {"v": body.velocity, "yaw_rate": body.yaw_rate / DEGREE}, "after": {"v": motion[:2], "yaw_rate": motion[2] / DEGREE}}
        made["bodies"].append(shown)
    made["contact"] = {"point": list(point), "normal_angle": angle / DEGREE}
    made["model"] = {"restitution": restitution, **model}
    if model.get("ratio_kind") == "critical":
        made["model"]["impulse_ratio"] = along[1] / along[0]
    made["reported"] = {
        "energy_loss": -sum(works), "work_normal": works[0], "work_tangential": works[1], "delta_v": changes,
        "impulse": {"normal": along[0], "tangential": along[1], "x": impulse[0], "y": impulse[1], "magnitude": mp.hypot(*impulse)},
        "closing_speed": abs(speeds[0][0]), "separation_speed": abs(speeds[0][1]), "impulse_ratio": along[1] / along[0]}
    return made


def rounded(value, decimals, resolution):
    """A copy with every number rounded to the decimals of its kind, and the resolutions that this makes."""
    kinds = {"v": "v", "yaw_rate": "yaw_rate", "delta_v": "v", "closing_speed": "v", "separation_speed": "v", "energy_loss": "energy",
             "work_normal": "energy", "work_tangential": "energy", "impulse": "impulse", "impulse_ratio": "impulse_ratio", "cg": "length"}

    def walk(value, kind):
        if isinstance(value, dict):
            return {key: walk(each, kinds.get(key, kind)) for key, each in value.items()}
        if isinstance(value, list):
            return [walk(each, kind) for each in value]
        if isinstance(value, mpf) and kind in decimals:
            return mpf(mp.nint(value * 10 ** decimals[kind])) / 10 ** decimals[kind]
        return value

    made = walk(copy.deepcopy(value), None)
    made["profile"] = "printed"
    made["resolution"] = {kind: mpf(10) ** -places / 2 for kind, places in decimals.items()}
    return made


def show(value):
    if isinstance(value, mpf):
        return repr(float(value))
    if isinstance(value, dict):
        return "{" + ", ".join(f"{json.dumps(key)}: {show(each)}" for key, each in value.items()) + "}"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(show(each) for each in value) + "]"
    return json.dumps(value)


def say(expected, made):
    print(show({"expected": expected, "record": made}))


def changed(made, name, change):
    wrong = copy.deepcopy(made)
    wrong["id"] = name
    change(wrong)
    return wrong


def main():
    rng = random.Random(SEED)
    sedan = lambda: Body(1163, 1.29, (-1.93, 0.31), (-13.4, 1.2), 0.4)
    pickup = lambda: Body(2878, 1.61, (0.98, 2.2), (0.7, 12.1), -0.2)
    pair = lambda: [sedan(), pickup()]
    wall = lambda: [Body(1487, 1.4, (2.1, -0.4), (15.1, 3.3), -0.6), Body()]
    critical = {"ratio_kind": "critical"}
    gamma = 8 * DEGREE

    good = record("oblique, critical", pair(), gamma, mpf("0.12"), ("slip", 0), (4, -3), **critical)
    say(None, good)
    mu = good["model"]["impulse_ratio"]
    say(None, record("normal the other way", pair(), gamma + mp.pi, mpf("0.12"), ("slip", 0), (4, -3), **critical))
    say(None, record("bodies exchanged", pair()[::-1], gamma, mpf("0.12"), ("slip", 0), (4, -3), **critical))
    say(None, record("sliding", pair(), gamma, mpf("0.12"), ("ratio", mu / 3), (4, -3), ratio_kind="given", impulse_ratio=mu / 3))
    say(None, record("a fraction", pair(), gamma, mpf("0.12"), ("ratio", mu * 3 / 4), (4, -3), ratio_kind="of_critical", impulse_ratio=mpf(3) / 4))
    say(None, record("friction slides", pair(), gamma, mpf("0.12"), ("ratio", mp.sign(mu) * mpf("0.2")), ratio_kind="friction", impulse_ratio=mpf("0.2")))
    say(None, record("friction sticks", pair(), gamma, mpf("0.12"), ("slip", 0), ratio_kind="friction", impulse_ratio=mpf(3)))
    other = record("restitution of both components", pair(), gamma, mpf("0.3"), ("slip", -mpf("0.3")), law="kudlich-slibar", **critical)
    say(None, other)
    barrier = record("barrier", wall(), 5 * DEGREE, mpf("0.1"), ("slip", 0), **critical)
    say(None, barrier)
    say(None, record("barrier first", wall()[::-1], 5 * DEGREE, mpf("0.1"), ("slip", 0), **critical))
    moving = wall()
    moving[1].velocity = [mpf(-6), mpf(1)]
    say(None, record("moving barrier", moving, 5 * DEGREE, mpf("0.1"), ("slip", 0), **critical))
    say(None, record("point masses", [Body(1000, 1.3, (1, 0), (10, 0)), Body(1500, 1.4, (-1, 0), (-2, 0))], mpf(0), mpf("0.5"), ("slip", 0), **critical))
    digits = {"v": 2, "yaw_rate": 1, "energy": 0, "impulse": 0, "impulse_ratio": 3, "length": 2}
    printed = rounded(good, digits, {})
    printed["id"] = "printed digits"
    say(None, printed)
    coarse = rounded(barrier, {**digits, "v": 1, "yaw_rate": 0, "energy": -2}, {})
    coarse["id"] = "coarse digits"
    say(None, coarse)
    stepped = copy.deepcopy(good)
    stepped["id"], stepped["profile"] = "stepping engine", "stepper"
    for body in stepped["bodies"]:
        body["after"]["yaw_rate"] *= 1 + mpf(rng.uniform(-0.004, 0.004))
    del stepped["reported"]
    say(None, stepped)
    for degrees in (-20, 0, 35, 70):
        swept = record(f"sweep {degrees}", pair(), degrees * DEGREE, mpf(0), ("slip", 0), (4, -3), **critical)
        swept["group"] = {"name": "sweep", "agreement": "outcome"}
        say(None, swept)

    # Each has one thing wrong.
    def of_body(i, *path, by):
        def change(made):
            place = made["bodies"][i]
            for key in path[:-1]:
                place = place[key]
            place[path[-1]] = by(place[path[-1]])
            # Only what was computed shows it, not what was reported.
            del made["reported"]
        return change

    thousandth = lambda x: x * mpf("1.001")
    for i in (0, 1):
        for when in ("before", "after"):
            for k in (0, 1):
                wrong = changed(good, f"body {i + 1} {when} v{'xy'[k]} off", of_body(i, when, "v", k, by=thousandth))
                say("linear-momentum", wrong)
        for when in ("before", "after"):
            say("line-of-action", changed(good, f"body {i + 1} {when} yaw rate turned", of_body(i, when, "yaw_rate", by=lambda x: -x)))
            say("angular-momentum", changed(good, f"body {i + 1} {when} yaw rate in rad/s", of_body(i, when, "yaw_rate", by=lambda x: x * DEGREE)))
        say("line-of-action", changed(good, f"body {i + 1} yaw inertia off", of_body(i, "yaw_inertia", by=thousandth)))
    say("line-of-action", changed(barrier, "barrier, vx off", of_body(0, "after", "v", 0, by=thousandth)))
    say("line-of-action", changed(barrier, "barrier, vy off", of_body(0, "before", "v", 1, by=thousandth)))
    say("line-of-action", changed(barrier, "barrier, yaw rate turned", of_body(0, "after", "yaw_rate", by=lambda x: -x)))

    def swap(*keys):
        def change(made):
            one, two = made["bodies"]
            for key in keys:
                one[key], two[key] = two[key], one[key]
        return change

    say("linear-momentum", changed(good, "masses exchanged", swap("mass")))
    say("linear-momentum", changed(good, "masses and inertias exchanged", swap("mass", "yaw_inertia")))
    say("restitution", changed(good, "normal in radians", lambda made: made["contact"].update(normal_angle=gamma)))
    say("plausible-units", changed(good, "normal in degrees twice", lambda made: made["contact"].update(normal_angle=gamma / DEGREE / DEGREE)))
    say("restitution", changed(good, "normal turned by 5 degrees", lambda made: made["contact"].update(normal_angle=13)))
    say("line-of-action", changed(good, "contact moved", lambda made: made["contact"].update(point=[4, -2])))
    say("restitution", changed(good, "restitution said wrong", lambda made: made["model"].update(restitution=mpf("0.13"))))
    say("restitution", changed(good, "restitution in percent", lambda made: made["model"].update(restitution=12)))
    say("restitution", changed(good, "restitution below zero", lambda made: made["model"].update(restitution=-mpf("0.12"))))
    say("restitution", record("restitution above one", pair(), gamma, mpf("1.2"), ("slip", 0), **critical))
    say("energy-gain", record("restitution that gains energy", pair(), gamma, mpf("1.6"), ("slip", 0), **critical))
    say("energy-gain", record("Kane's paradox", [Body(1000, 1, (-1, 1), (-3, -2)), Body()], mpf(0), mpf(1), ("slip", 0), **critical))
    say("impulse-ratio", changed(good, "ratio said wrong", lambda made: made["model"].update(impulse_ratio=mu * mpf("1.001"))))
    say("impulse-ratio", record("not critical", pair(), gamma, mpf("0.12"), ("ratio", mu / 2), **critical))
    say("beyond-critical", record("ratio beyond critical", pair(), gamma, mpf("0.12"), ("ratio", mu * mpf("1.1")), ratio_kind="given", impulse_ratio=mu * mpf("1.1")))
    say("beyond-critical", record("ratio of the other sign", pair(), gamma, mpf("0.12"), ("ratio", -mu / 4), ratio_kind="given", impulse_ratio=-mu / 4))
    say("compressive", record("parting pair", [Body(1000, 1.3, (1, 0.2), (-10, 0)), Body(1500, 1.4, (-1, 0.3), (2, 1))], mpf(0), mpf(0), ("slip", 0), **critical))

    def still(made):
        for body in made["bodies"]:
            body["after"] = body["before"]

    say("interpenetration", changed(good, "nothing happened", still))
    for key in ("energy_loss", "work_normal", "work_tangential", "closing_speed", "separation_speed", "impulse_ratio"):
        wrong = changed(good, f"{key} said wrong", lambda made: made["reported"].update({key: made["reported"][key] * mpf("1.001")}))
        say("reported", wrong)
    say("reported", changed(good, "delta-V said wrong", lambda made: made["reported"]["delta_v"].__setitem__(1, made["reported"]["delta_v"][0])))
    say("reported", changed(good, "impulse said wrong", lambda made: made["reported"]["impulse"].update(x=-made["reported"]["impulse"]["x"])))
    say("restitution", changed(other, "the other law", lambda made: made["model"].update(restitution=mpf("0.31"))))
    say("impulse-ratio", changed(other, "the other law not said", lambda made: made["model"].pop("law")))
    say("line-of-action", changed(printed, "printed, yaw rate misprinted", lambda made: made["bodies"][0]["after"].update(yaw_rate=made["bodies"][0]["after"]["yaw_rate"] + 10)))
    say("linear-momentum", changed(printed, "printed, a digit exchanged", of_body(1, "after", "v", 1, by=lambda x: x + mpf("0.09"))))
    for degrees, off in ((-10, 1), (10, 1), (20, mpf("1.001"))):
        swept = record(f"works {degrees}", pair(), degrees * DEGREE, mpf(0), ("slip", 0), (4, -3), **critical)
        claims = {key: swept["reported"][key] * off for key in ("work_normal", "work_tangential")}
        say("group" if off != 1 else None, {"id": swept["id"], "group": "works", "contact": {"normal_angle": degrees}, "reported": claims})


if __name__ == "__main__":
    main()
