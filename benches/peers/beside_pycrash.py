#!/usr/bin/env python3
"""Solve random collisions with pycrash and with `planar-impact batch`, and account for every difference; then check pycrash's results as records.

    cargo build --release -p planar-impact-cli
    pip install pycrash            # in an environment of its own: it asks for pandas before 3
    benches/peers/beside_pycrash.py 10000 [SEED]

The collisions are drawn without a look at what either program makes of them, so about half of the vehicles move apart. The constants of pycrash (32.2 ft/s²,
1.46667, 0.681818) are taken as they are, so that nothing remains but the mechanics. Fails if a difference has no cause that can be computed from the inputs.
"""

import contextlib
import csv
import io
import os
import random
import re
import subprocess
import sys
import tempfile
from collections import Counter
from math import atan, cos, hypot, pi, radians, sin

from checker import PROGRAM, broken_rules

with contextlib.redirect_stdout(io.StringIO()):
    from pycrash.model_calcs.carpenter_momentum import IMPC
    from pycrash.vehicle import Vehicle

GRAVITY, FEET_PER_MILE, MILES_PER_FOOT = 32.2, 1.46667, 0.681818
AGREED = 1e-9
FOOT, SLUG, FOOT_POUND = 0.3048, 4.4482216152605 / 0.3048, 4.4482216152605 * 0.3048


def draw(rng):
    """Return the inputs of pycrash: lb, lb ft s², ft, mph, degrees; axes forward and right, angles clockwise."""
    vehicles = [
        {
            "weight": rng.uniform(1800, 9000), "izz": rng.uniform(900, 5000), "head_angle": rng.uniform(-180, 180), "omega_z": rng.gauss(0, 30),
            "vx_initial": rng.uniform(0, 60), "vy_initial": rng.gauss(0, 5),
        }
        for _ in range(2)
    ]
    centers = [(rng.uniform(-8, 8), rng.uniform(-3, 3)) for _ in range(2)]
    contact = {"cor": rng.uniform(0, 0.6), "cof": rng.uniform(0, 1.2), "impact_norm_deg": rng.uniform(-180, 180)}
    return vehicles, centers, contact


def turned(degrees, x, y):
    c, s = cos(radians(degrees)), sin(radians(degrees))
    return c * x - s * y, s * x + c * y


def with_pycrash(vehicles, centers, contact):
    """Return the results of both vehicles, and the energy dissipated that is printed, in ft lb."""
    # pycrash finds the impact center of vehicle 2 from where both vehicles are.
    one, two = (turned(vehicle["head_angle"], *center) for vehicle, center in zip(vehicles, centers))
    striking = {**vehicles[0], "pimpact_x": centers[0][0], "pimpact_y": centers[0][1], "init_x_pos": 0, "init_y_pos": 0}
    struck = {**vehicles[1], "init_x_pos": one[0] - two[0], "init_y_pos": one[1] - two[1]}
    with contextlib.redirect_stdout(io.StringIO()) as printed:
        impact = IMPC("case", Vehicle("striking", striking), Vehicle("struck", struck), contact)
    loss = float(re.search(r"'tn_total_dis': (?:np\.float64\()?([-+.e\d]+)", printed.getvalue())[1])
    return [impact.v1_result, impact.v2_result], loss


def row(vehicles, centers, contact):
    """Return the same collision as a row of `batch`: axes to the left and angles counter-clockwise, so both change sign."""
    out = {}
    for number, (vehicle, center) in enumerate(zip(vehicles, centers), 1):
        v = f"vehicle.{number}."
        x, y = turned(vehicle["head_angle"], vehicle["vx_initial"] * FEET_PER_MILE, vehicle["vy_initial"] * FEET_PER_MILE)
        out |= {
            v + "mass [kg]": vehicle["weight"] / GRAVITY * SLUG, v + "yaw_inertia [kg m^2]": vehicle["izz"] * SLUG * FOOT**2,
            v + "heading [deg]": -vehicle["head_angle"], v + "yaw_rate [deg/s]": -vehicle["omega_z"],
            v + "velocity.x [ft/s]": x, v + "velocity.y [ft/s]": -y,
            v + "impact_center.forward [ft]": center[0], v + "impact_center.left [ft]": -center[1],
        }
    plane = -(vehicles[0]["head_angle"] + contact["impact_norm_deg"])
    return {**out, "contact.crush_plane [deg]": plane, "contact.restitution": contact["cor"], "contact.friction": contact["cof"], "contact.tangential_law": "kudlich-slibar"}


def record(name, vehicles, centers, contact, results):
    """Return pycrash's collision as a record of the checker, as the guide has it: in its own axes, which are a mirror image."""

    def body(vehicle, center, result):
        def ground(x, y):
            return turned(vehicle["head_angle"], x, y)

        return {
            "mass": vehicle["weight"] / GRAVITY, "yaw_inertia": vehicle["izz"], "heading": vehicle["head_angle"], "cg": ground(-center[0], -center[1]),
            "before": {"v": ground(vehicle["vx_initial"] * FEET_PER_MILE, vehicle["vy_initial"] * FEET_PER_MILE), "yaw_rate": vehicle["omega_z"]},
            "after": {"v": ground(result["vx"] / MILES_PER_FOOT, result["vy"] / MILES_PER_FOOT), "yaw_rate": result["oz_deg"]},
        }

    return {
        "id": name,
        "bodies": [body(*each) for each in zip(vehicles, centers, results)],
        "contact": {"point": [0, 0], "normal_angle": vehicles[0]["head_angle"] + contact["impact_norm_deg"]},
        "model": {"restitution": contact["cor"], "impulse_ratio": contact["cof"], "ratio_kind": "friction", "law": "kudlich-slibar"},
        "reported": {"delta_v": [result["dv"] / MILES_PER_FOOT for result in results]},
    }


def closing(vehicles, centers, contact):
    """Return v_n s, which is negative where the vehicles close, from pycrash's inputs alone."""
    plane = radians(vehicles[0]["head_angle"] + contact["impact_norm_deg"])
    n = cos(plane), sin(plane)
    ahead, speed = 0, 0
    for sign, vehicle, center in zip((-1, 1), vehicles, centers):
        x, y = turned(vehicle["head_angle"], vehicle["vx_initial"] * FEET_PER_MILE, vehicle["vy_initial"] * FEET_PER_MILE)
        right, forward = turned(vehicle["head_angle"], *center)[::-1], radians(vehicle["omega_z"])
        speed += sign * ((x - forward * right[0]) * n[0] + (y + forward * right[1]) * n[1])
        ahead -= sign * (right[1] * n[0] + right[0] * n[1])
    return speed if ahead >= 0 else -speed


def differences(vehicles, results, loss, answer):
    """Return by how much the answers differ: motions of the greatest speed and rate, the directions of force in rad, the loss of the energy before."""
    speed = max(hypot(v["vx_initial"], v["vy_initial"]) for v in vehicles) * FEET_PER_MILE * FOOT
    out = {"motion": 0.0, "PDOF": []}
    for number, (vehicle, result) in enumerate(zip(vehicles, results), 1):
        v = f"vehicle.{number}."
        x, y = turned(vehicle["head_angle"], result["dvx"] / MILES_PER_FOOT * FOOT, result["dvy"] / MILES_PER_FOOT * FOOT)
        out["motion"] = max(out["motion"], hypot(x - float(answer[v + "delta_v.x"]), -y - float(answer[v + "delta_v.y"])) / speed)
        rate = float(answer[f"result.{v}yaw_rate"])
        out["motion"] = max(out["motion"], abs(-radians(result["oz_deg"]) - rate) / max(1, abs(rate)))
        direction = float(answer[v + "pdof"]) - atan(result["dvy"] / result["dvx"])
        out["PDOF"].append(abs((direction + pi) % (2 * pi) - pi))
    out["energy"] = abs(loss * FOOT_POUND - float(answer["energy.loss"])) / float(answer["energy.before"])
    return out


def batch(drawn, folder):
    """Return the rows of `planar-impact batch` for the collisions."""
    source, target = (os.path.join(folder, name) for name in ("in.csv", "out.csv"))
    with open(source, "w", newline="", encoding="utf-8") as file:
        rows = [row(*each) for each in drawn]
        lines = csv.DictWriter(file, list(rows[0]))
        lines.writeheader()
        lines.writerows(rows)
    subprocess.run([PROGRAM, "batch", source, "-o", target], stderr=subprocess.DEVNULL, check=False)
    with open(target, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def main():
    cases, seed = int(float(sys.argv[1])) if len(sys.argv) > 1 else 1000, int(sys.argv[2]) if len(sys.argv) > 2 else 1
    rng = random.Random(seed)
    drawn = [draw(rng) for _ in range(cases)]
    theirs = [with_pycrash(*each) for each in drawn]
    with tempfile.TemporaryDirectory() as folder:
        answers = batch(drawn, folder)
    records = [record(str(name), *each, results) for name, (each, (results, _)) in enumerate(zip(drawn, theirs))]
    broken = broken_rules(records, "ft", "slug", "deg")
    assert len(answers) == len(broken) == cases
    counts, greatest, unexplained = Counter(), Counter(), []
    for number, (each, (results, loss), answer, rules) in enumerate(zip(drawn, theirs, answers, broken)):
        if closing(*each) >= 0:
            counts["separating"] += 1
            if answer["refusal"] != "separating" or "compressive" not in rules:
                unexplained.append((number, answer["refusal"], rules))
            continue
        if answer["refusal"] or rules:
            unexplained.append((number, answer["refusal"], rules))
            continue
        counts["closing"] += 1
        for what, difference in differences(each[0], results, loss, answer).items():
            if what == "PDOF":
                counts["opposite"] += sum(abs(d - pi) < AGREED for d in difference)
                difference = max(min(d, abs(d - pi)) for d in difference)
            greatest[what] = max(greatest[what], difference)
            if difference > AGREED:
                unexplained.append((number, what, difference))
    print(f"| of {cases} collisions | number | in pycrash 0.0.18 | here |\n|---|---:|---|---|")
    print(f"| vehicles close | {counts['closing']} | solved | solved, the same: motions to {greatest['motion']:.0e}, energies to {greatest['energy']:.0e}; `check` finds nothing broken |")
    print(f"| vehicles move apart | {counts['separating']} | solved | refused, `separating`; `check` finds `compressive` broken in what pycrash answers |")
    print(f"| the force comes from behind (of {2 * counts['closing']} vehicles) | {counts['opposite']} | PDOF by arctan, as from ahead | PDOF over the full circle |")
    print(f"| no cause found | {len(unexplained)} | | |")
    for each in unexplained[:5]:
        print(*each, file=sys.stderr)
    return bool(unexplained)


if __name__ == "__main__":
    sys.exit(main())
