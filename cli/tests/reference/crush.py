#!/usr/bin/env python3
"""Random crush with what it stands for and what CRASH3 makes of it:  python3 crush.py > crush.jsonl

The same seed gives the same file. Takes the units, the drawing of vehicles and the momentum equations from solve.py. README.md tells how the answers are made.
"""
import random
from fractions import Fraction

from mpmath import mp, mpf

from solve import (POUND_FORCE, Bare, Body, Unclear, clear, collide, contact_velocity, factor, literal, read, show, turned, vehicle,
                   written)

SEED = "planar-impact crush 1"
CASES = 120
FORCE_ROOTS = {"lbf^0.5": mp.sqrt(mpf(POUND_FORCE.numerator) / POUND_FORCE.denominator), "N^0.5": mpf(1)}


# ------------------------------------------------------------------ the file's side

def stiffness(rng):
    form = rng.randrange(3)
    if form == 0:
        root, length = rng.choice(sorted(FORCE_ROOTS)), rng.choice(["ft", "m"])
        d0, d1 = rng.choice([0, rng.uniform(20, 150)]), rng.choice([0, rng.uniform(100, 1500), rng.uniform(100, 1500)])
        return {"d0": f"{literal(rng, d0)} {root}", "d1": f"{literal(rng, d1)} {root}/{length}"}
    if form == 1:
        return {"A": written(rng, "stiffness", rng.uniform(2e4, 8e4)), "B": written(rng, "stiffness per width", rng.uniform(2e5, 9e5))}
    return {"b0": written(rng, "speed", rng.uniform(1, 4)), "b1": f"{literal(rng, rng.uniform(10, 40))} 1/s",
            "test_mass": written(rng, "mass", rng.uniform(900, 2200)), "test_width": written(rng, "length", rng.uniform(1.2, 1.9))}


def crush(rng):
    count = rng.randrange(2, 9)
    made, width = {}, rng.uniform(0.4, 2)
    offset, angle = rng.uniform(0.05, 0.3), rng.uniform(-0.3, 0.3)
    measured = rng.random() < 0.25
    depths = [0 if rng.random() < 0.1 else rng.uniform(0.01, 0.9) for _ in range(count)]
    if rng.random() < 0.5:
        made["width"] = written(rng, "length", width)
        first, last = 0, width
    else:
        first = rng.uniform(-1, 0.5)
        gaps = [rng.uniform(0.05, 0.4) for _ in range(count - 1)]
        made["stations"] = [written(rng, "length", first + sum(gaps[:i])) for i in range(count)]
        last = first + sum(gaps)
    made["depths"] = [written(rng, "length", (depth + offset) / float(mp.cos(angle)) if measured else depth) for depth in depths]
    if measured:
        made["measured"] = {"offset": written(rng, "length", offset * 0.9), "angle": written(rng, "angle", angle)}
    sort = rng.random()
    if sort < 0.25:
        zones = sorted(rng.uniform(first - 0.2, last + 0.2) for _ in range(rng.randrange(1, 4)))
        made["stiffness"] = [{**stiffness(rng), "to": written(rng, "length", end)} for end in zones] + [stiffness(rng)]
    else:
        made["stiffness"] = stiffness(rng)
        if sort > 0.8:
            made["stiffness"]["saturation"] = written(rng, "length", rng.uniform(0, 0.8))
    if rng.random() < 0.3:
        made["surface"] = rng.choice(["front", "right", "rear", "left"])
    if rng.random() < 0.2:
        made["pdof"] = written(rng, "angle", rng.uniform(-3, 3))
    return made


def case(rng):
    vehicles = [vehicle(rng), vehicle(rng)]
    for made in vehicles:
        made["crush"] = crush(rng)
    if rng.random() < 0.25:
        vehicles[rng.randrange(2)] = {"name": "wall", "barrier": True}
    contact = {"crush_plane": written(rng, "angle", rng.uniform(-6.28, 6.28)),
               "restitution": Bare(literal(rng, rng.choice([0, 0, rng.uniform(0, 0.4)])))}
    return {"schema": Bare("1"), "title": "", "vehicle": vehicles, "contact": contact}


# ------------------------------------------------------------------ crush

def number(text):
    exact = Fraction(text)
    return mpf(exact.numerator) / exact.denominator


def line_of(made):
    """A and B of a stiffness, and G: the force per width A + B C, and the energy per width G before it."""
    if "d0" in made:
        (d0, root), (d1, per) = (made[key].split(" ") for key in ("d0", "d1"))
        d0, d1 = number(d0) * FORCE_ROOTS[root], number(d1) * FORCE_ROOTS[root] / factor("length", per.split("/")[1])
        return d0 * d1, d1 * d1, d0 * d0 / 2
    if "A" in made:
        force, slope = read(made["A"], "stiffness"), read(made["B"], "stiffness per width")
        return force, slope, force ** 2 / (2 * slope)
    speed, slope = read(made["b0"], "speed"), number(made["b1"].split(" ")[0])
    line_mass = read(made["test_mass"], "mass") / read(made["test_width"], "length")
    return line_mass * speed * slope, line_mass * slope ** 2, line_mass * speed ** 2 / 2


def profile_of(made):
    """Stations and depths."""
    readings = [read(depth, "length") for depth in made["depths"]]
    if "width" in made:
        width = read(made["width"], "length")
        places = [width * i / (len(readings) - 1) for i in range(len(readings))]
    else:
        places = [read(place, "length") for place in made["stations"]]
    if "measured" not in made:
        return places, readings
    offset, angle = read(made["measured"]["offset"], "length"), read(made["measured"]["angle"], "angle")
    along = [place + reading * mp.sin(angle) for place, reading in zip(places, readings)]
    return along, [reading * mp.cos(angle) - offset for reading in readings]


def pieces(places, depths, borders, saturation):
    """The profile cut wherever a zone or the law changes: (zone, from, to, depth there, depth here), each piece a straight line under one law."""
    for (a, b), (c, d) in zip(zip(places, places[1:]), zip(depths, depths[1:])):
        cuts = [x for x in borders if a < x < b]
        if saturation is not None and min(c, d) < saturation < max(c, d):
            cuts.append(a + (saturation - c) * (b - a) / (d - c))
        ends = [a, *sorted(cuts), b]
        for low, high in zip(ends, ends[1:]):
            middle = (low + high) / 2
            zone = sum(1 for x in borders if x < middle)
            depth = lambda x: c + (d - c) * (x - a) / (b - a)
            yield zone, low, high, depth


def simpson(low, high, f):
    return (high - low) * (f(low) + 4 * f((low + high) / 2) + f(high)) / 6


def crush_answer(made, mass):
    places, depths = profile_of(made)
    if min(b - a for a, b in zip(places, places[1:])) < mpf("0.01") or min(depths) < 0:
        raise Unclear
    zones = made["stiffness"] if isinstance(made["stiffness"], list) else [made["stiffness"]]
    lines = [line_of(zone) for zone in zones]
    borders = [read(zone["to"], "length") for zone in zones[:-1]]
    if any(b - a < mpf("1e-6") for a, b in zip(borders, borders[1:])):
        raise Unclear
    saturation = read(zones[0]["saturation"], "length") if "saturation" in zones[0] else None

    def energy_at(zone, depth):
        force, slope, first = lines[zone]
        if saturation is None or depth <= saturation:
            return first + force * depth + slope * depth ** 2 / 2
        return first + force * saturation + slope * saturation ** 2 / 2 + (force + slope * saturation) * (depth - saturation)

    width = places[-1] - places[0]
    sums = [[mpf(0)] * 4 for _ in zones]
    for zone, low, high, depth in pieces(places, depths, borders, saturation):
        sums[zone][0] += (high - low) / 2
        sums[zone][1] += simpson(low, high, depth)
        sums[zone][2] += simpson(low, high, lambda x: depth(x) ** 2 / 2)
        sums[zone][3] += simpson(low, high, lambda x: energy_at(zone, depth(x)))
    total = [sum(each) for each in zip(*sums)]
    law = lambda line: {"d0": mp.sqrt(2 * line[2]), "d1": mp.sqrt(line[1]), "A": line[0], "B": line[1], "G": line[2]}
    answer = {"width": width, "mean_depth": total[1] / width, "K": total[:3], "crush_energy": total[3],
              "equivalent_energy_speed": mp.sqrt(2 * total[3] / mass)}
    if len(zones) == 1:
        return {**answer, **law(lines[0])}
    of_zone = lambda zone, line: {"K": zone[:3], "crush_energy": zone[3], **law(line)}
    return {**answer, "zones": [of_zone(zone, line) for zone, line in zip(sums, lines)]}


# ------------------------------------------------------------------ CRASH3

SURFACES = ["front", "right", "rear", "left"]


def crash3_answer(made, bodies, energies):
    plane, restitution = read(made["contact"]["crush_plane"], "angle"), read(made["contact"]["restitution"], "")
    approach = contact_velocity(bodies, [body.motion for body in bodies], plane)
    offset = turned(bodies[0].arm[0] - bodies[1].arm[0], bodies[0].arm[1] - bodies[1].arm[1], -plane)
    speed = max([mp.hypot(x, y) for body in bodies for x, y in [body.motion[:2]]] + [mp.hypot(*approach)])
    if abs(offset[0]) < mp.hypot(*offset) / 20 or abs(approach[0]) <= speed / 20 or approach[0] * offset[0] > 0:
        raise Unclear
    side = mp.sign(approach[0])
    common = collide(bodies, plane, mpf(0), ("velocity", mpf(0)))
    actual = collide(bodies, plane, restitution, ("velocity", mpf(0)))
    for normal, tangent, _ in (common, actual):
        if not clear(normal * side / mp.hypot(normal, tangent)) or abs(tangent / normal) > 20:
            raise Unclear
    force = turned(common[0], common[1], plane)
    answers, corrected, yielding = [], mpf(0), mpf(0)
    for body, vehicle_made, energy, sign in zip(bodies, made["vehicle"], energies, (1, -1)):
        if body.fixed:
            answers.append(None)
            continue
        ahead, left = turned(sign * force[0], sign * force[1], -body.turn)
        pdof = mp.atan2(left, -ahead)
        if "pdof" in vehicle_made["crush"]:
            pdof = read(vehicle_made["crush"]["pdof"], "angle")
        # The crush plane's normal, on the side that the force comes from.
        normal = body.turn - plane
        if not clear(mp.cos(normal - pdof)):
            normal += mp.pi
        quarter = mp.atan2(mp.sin(normal), mp.cos(normal)) / (mp.pi / 2)
        if abs(abs(quarter - mp.floor(quarter)) - mpf(1) / 2) < mpf("1e-6"):
            raise Unclear
        surface = vehicle_made["crush"].get("surface", SURFACES[int(mp.nint(quarter)) % 4])
        alpha = pdof - SURFACES.index(surface) * mp.pi / 2
        factor_of = 1 + mp.tan(alpha) ** 2 if mp.cos(alpha) > mpf("1e-6") else mpf(2)
        if abs(factor_of - 2) < mpf("1e-6") and factor_of != 2:
            raise Unclear
        factor_of = min(factor_of, mpf(2))
        # The push has the components (-cos, +sin) of the angle it comes from, forward and left.
        forward, sideways = turned(*body.arm, -body.turn)
        arm = forward * mp.sin(pdof) + sideways * mp.cos(pdof)
        k_squared = body.inertia / body.mass
        gamma = k_squared / (k_squared + arm ** 2)
        corrected, yielding = corrected + energy * factor_of, yielding + 1 / (gamma * body.mass)
        answers.append({"surface": surface, "crush_energy": energy, "pdof": mp.atan2(mp.sin(pdof), mp.cos(pdof)), "correction": factor_of,
                        "corrected_energy": energy * factor_of, "moment_arm": arm, "effective_mass_factor": gamma})
    # Common velocity of the masses gamma m where they touch: the energy is that of their relative motion, (reduced mass) v^2 / 2.
    reduced = 1 / yielding
    closing = mp.sqrt(2 * corrected / reduced)
    for body, each, after, sign in zip(bodies, answers, actual[2], (1, -1)):
        if each is None:
            continue
        each["delta_v_magnitude"] = reduced * closing / body.mass
        push = turned(-mp.cos(each["pdof"]) * each["delta_v_magnitude"], mp.sin(each["pdof"]) * each["delta_v_magnitude"], body.turn)
        each["delta_v"] = list(push)
        each["reconstruction"] = {"separation_velocity": list(after[:2]), "approach_velocity": [v - dv for v, dv in zip(after, push)]}
    # Planar mechanics from the same energy: the collision of the case at other speeds, all of them scaled alike.
    separation = contact_velocity(bodies, actual[2], plane)
    work = -actual[0] * (approach[0] + separation[0]) / 2
    loss = actual[0] * (approach[0] + separation[0]) / 2 + actual[1] * (approach[1] + separation[1]) / 2
    if not clear(loss / (-work)):
        raise Unclear
    scale = mp.sqrt(sum(energies) / -work)
    changes = [mp.hypot(*actual[:2]) / body.mass if body.mass else mpf(0) for body in bodies]
    energy = sum(energies)
    row = lambda lost, impulse: {"loss": lost, "delta_v_magnitude": [impulse / body.mass if body.mass else mpf(0) for body in bodies]}

    def yielding_along(push):
        """How readily the impact center yields along an impulse: the sum of 1/m + h^2/I, h the arm of its line about each center of mass."""
        x, y = turned(push[0], push[1], plane)
        length = mp.hypot(x, y)
        arms = [(body.arm[0] * y - body.arm[1] * x) / length for body in bodies]
        return sum(1 / body.mass + arm ** 2 / body.inertia for body, arm in zip(bodies, arms) if not body.fixed)

    impulse = scale * mp.hypot(*actual[:2])
    planar = {"crush_energy": energy, "planar": row(scale ** 2 * loss, impulse)}
    # The same at common velocity: all of the relative motion is lost, e = 0.
    common_work = [p * v / 2 for p, v in zip(common[:2], approach)]
    if not clear(common_work[0] / abs(sum(common_work))):
        raise Unclear
    share = energy / common_work[0]
    planar["common_velocity"] = row(share * sum(common_work), mp.sqrt(share) * mp.hypot(*common[:2]))
    # A point of the effective mass M: E_C = M v_n^2 (1 - e^2)/2, P_n = M v_n (1 + e), and the tangential part brings P_t/M, from which it loses P_t^2/(2 M).
    ratio = actual[1] / actual[0]
    mass = 1 / yielding_along(actual)
    normal = mp.sqrt(2 * energy / (mass * (1 - restitution ** 2))) * mass * (1 + restitution)
    planar["point_mass"] = row(energy + (ratio * normal) ** 2 / (2 * mass), normal * mp.sqrt(1 + ratio ** 2))
    planar["tangential_factor"] = row(energy * (1 + ratio ** 2), impulse * mp.sqrt(energy * (1 + ratio ** 2) / (scale ** 2 * loss)))
    whole = energy * (1 + (common[1] / common[0]) ** 2)
    planar["together"] = row(whole, mp.sqrt(2 * whole / yielding_along(common)))
    return {"vehicles": answers, "corrected_energy": corrected, "impulse": reduced * closing, "planar": planar}


def main():
    rng = random.Random(SEED)
    made_so_far = 0
    while made_so_far < CASES:
        made = case(rng)
        try:
            bodies = [Body({key: value for key, value in each.items() if key != "crush"}) for each in made["vehicle"]]
            crushed = [None if body.fixed else crush_answer(each["crush"], body.mass) for body, each in zip(bodies, made["vehicle"])]
            energies = [mpf(0) if each is None else each["crush_energy"] for each in crushed]
            if not sum(energies):
                raise Unclear
            crash3 = crash3_answer(made, bodies, energies)
        except Unclear:
            continue
        made_so_far += 1
        made["title"] = f"case {made_so_far}"
        print(show({"case": made, "crush": crushed, "crash3": crash3}))


if __name__ == "__main__":
    main()
