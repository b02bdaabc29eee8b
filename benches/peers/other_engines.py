#!/usr/bin/env python3
"""Collide pairs of bodies in Chipmunk (pymunk), Box2D and MuJoCo, check them as records, and judge each complaint of the checker by the numbers of the record.

    cargo build --release -p planar-impact-cli
    pip install -r benches/peers/requirements.txt
    benches/peers/other_engines.py 1000 [SEED]

Each engine has the conventions of `planar_impact::guide::checking`: all numbers of one side of a contact belong to one instant. The judge has the laws in
exact rational arithmetic and shares nothing with the checker; its tolerances are those that the guide states for a stepper. Fails if a complaint is not borne
out by the record, or a law is broken by twice its tolerance and the checker says nothing.
"""

import random
import sys
from collections import Counter
from fractions import Fraction
from math import atan2, cos, hypot, pi, sin, sqrt

import Box2D
import mujoco
import pymunk
from checker import broken_rules

STEP, STEPS = 1 / 960, 2000
# A contact of a millisecond, in which bodies hardly move, takes some twenty of its steps.
MUJOCO_STEPS = 20
# What a stepper may leave: of the momentum that is exchanged, with the rounding of momenta, and of the rest.
LINEAR, ROUNDING, REST = {"stepper": 1e-6, "stepper-f32": 1e-5}, {"stepper": 2**-46, "stepper-f32": 2**-20}, 2e-2


def draw(rng):
    """Return a pair of bodies on a collision course, in kg, m, s and rad: boxes of the size of cars, or discs."""

    def body(x, towards):
        shape = {"half": (rng.uniform(1.9, 2.6), rng.uniform(0.8, 1.0))} if rng.random() < 0.7 else {"radius": rng.uniform(0.8, 1.5)}
        area = 4 * shape["half"][0] * shape["half"][1] if "half" in shape else pi * shape["radius"] ** 2
        gyration = (shape["half"][0] ** 2 + shape["half"][1] ** 2) / 3 if "half" in shape else shape["radius"] ** 2 / 2
        mass = area * rng.uniform(120, 220)
        return {
            **shape, "mass": mass, "inertia": mass * gyration, "place": (x, rng.uniform(-0.8, 0.8)), "heading": rng.uniform(-3.1, 3.1),
            "velocity": (towards * rng.uniform(5, 15), rng.uniform(-4, 4)), "rate": rng.uniform(-0.5, 0.5),
        }

    return {"bodies": [body(-3.5, 1), body(3.5, -1)], "restitution": rng.choice([0, 0.3, 0.7, 1]), "friction": rng.choice([0, 0.4])}


def with_pymunk(pair):
    """Chipmunk moves the bodies first, and then finds the contact and its impulse: what it knows after a step belongs to the places after it."""
    space = pymunk.Space()
    space.iterations = 100
    bodies = []
    for given in pair["bodies"]:
        body = pymunk.Body(given["mass"], given["inertia"])
        body.position, body.angle, body.velocity, body.angular_velocity = given["place"], given["heading"], given["velocity"], given["rate"]
        if "half" in given:
            shape = pymunk.Poly.create_box(body, tuple(2 * half for half in given["half"]))
        else:
            shape = pymunk.Circle(body, given["radius"])
        # Chipmunk multiplies the coefficients of both shapes.
        shape.elasticity, shape.friction = sqrt(pair["restitution"]), sqrt(pair["friction"])
        space.add(body, shape)
        bodies.append(body)
    contacts = []
    space.on_collision(post_solve=lambda arbiter, _space, _data: contacts.append(arbiter.contact_point_set))

    def state():
        return [(tuple(body.velocity), body.angular_velocity) for body in bodies]

    def step():
        contacts.clear()
        space.step(STEP)
        places = [tuple(body.position) for body in bodies]
        found = contacts[0] if contacts else None
        points = [tuple((a + b) / 2 for a, b in zip(point.point_a, point.point_b)) for point in found.points] if found else []
        return places, (tuple(found.normal) if found else None), points

    return impulses(pair, state, step, "stepper")


def with_box2d(pair):
    """Box2D finds the contact and its impulse first, and then moves the bodies: what it knows in PreSolve belongs to the places before the step."""
    contacts = []

    class Listener(Box2D.b2ContactListener):
        def PreSolve(self, contact, _old):
            manifold = contact.worldManifold
            contacts.append((tuple(manifold.normal), [tuple(point) for point in manifold.points[: contact.manifold.pointCount]]))

    listener = Listener()
    world = Box2D.b2World(gravity=(0, 0), contactListener=listener)
    bodies = []
    for given in pair["bodies"]:
        shape = Box2D.b2PolygonShape(box=given["half"]) if "half" in given else Box2D.b2CircleShape(radius=given["radius"])
        fixture = Box2D.b2FixtureDef(shape=shape, density=1, friction=pair["friction"], restitution=pair["restitution"])
        body = world.CreateDynamicBody(position=given["place"], angle=given["heading"], linearVelocity=given["velocity"], angularVelocity=given["rate"],
                                       fixtures=fixture, allowSleep=False)
        body.massData = Box2D.b2MassData(mass=given["mass"], I=given["inertia"], center=(0, 0))
        bodies.append(body)

    def state():
        return [(tuple(body.linearVelocity), body.angularVelocity) for body in bodies]

    def step():
        contacts.clear()
        before = [tuple(body.worldCenter) for body in bodies]
        world.Step(STEP, 100, 100)
        normal, points = contacts[0] if contacts else (None, [])
        return before, normal, points

    # Single precision: the masses that it has.
    for given, body in zip(pair["bodies"], bodies):
        given["mass"], given["inertia"] = body.mass, body.inertia
    return impulses(pair, state, step, "stepper-f32")


def with_mujoco(pair):
    """MuJoCo's contacts are springs, and it has no coefficient of restitution. A contact belongs to the places before the step."""
    bodies = "".join(
        f"""<body name="b{i}" pos="{given['place'][0]!r} {given['place'][1]!r} 0"><inertial pos="0 0 0" mass="{given['mass']!r}"
        diaginertia="{given['inertia']!r} {given['inertia']!r} {given['inertia']!r}"/>
        <joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 1 0"/><joint type="hinge" axis="0 0 1"/>
        <geom type="{'box' if 'half' in given else 'sphere'}" size="{' '.join(map(repr, given['half'])) + ' 0.5' if 'half' in given else repr(given['radius'])}"
        friction="{pair['friction']!r} 0 0" condim="3" solref="0.001 0.2"/></body>"""
        for i, given in enumerate(pair["bodies"])
    )
    model = mujoco.MjModel.from_xml_string(
        f"""<mujoco><option timestep="{(STEP / MUJOCO_STEPS)!r}" gravity="0 0 0" integrator="Euler" cone="elliptic" iterations="200" tolerance="1e-14"/>
        <worldbody>{bodies}</worldbody></mujoco>"""
    )
    data = mujoco.MjData(model)
    for i, given in enumerate(pair["bodies"]):
        data.qpos[3 * i + 2] = given["heading"]
        data.qvel[3 * i : 3 * i + 3] = [*given["velocity"], given["rate"]]

    def places():
        return [tuple(given["place"][axis] + data.qpos[3 * i + axis] for axis in (0, 1)) for i, given in enumerate(pair["bodies"])]

    def state():
        return [((float(data.qvel[3 * i]), float(data.qvel[3 * i + 1])), float(data.qvel[3 * i + 2])) for i in (0, 1)]

    def step():
        before = places()
        mujoco.mj_step(model, data)
        deepest = sorted((data.contact[i] for i in range(data.ncon)), key=lambda contact: contact.dist)
        # Two boxes of one height touch above and below in the same place of the plane.
        points = sorted({(round(float(contact.pos[0]), 9), round(float(contact.pos[1]), 9)) for contact in deepest})
        return before, (tuple(map(float, deepest[0].frame[:2])) if deepest else None), points

    return lasting(pair, state, step, model.opt.timestep)


def body(given, place, before, after):
    """Return a body of a record."""
    state = {side: {"v": velocity, "yaw_rate": rate} for side, (velocity, rate) in (("before", before), ("after", after))}
    return {"mass": given["mass"], "yaw_inertia": given["inertia"], "cg": place, **state}


def impulses(pair, state, step, profile):
    """Return a record of each step that begins a contact at another place: these engines exchange an impulse at an instant."""
    records, last = [], []
    for _ in range(STEPS):
        before = state()
        places, normal, points = step()
        after = state()
        if points and after != before and all(hypot(x - u, y - v) > 0.1 for x, y in points for u, v in last):
            bodies = [body(*each) for each in zip(pair["bodies"], places, before, after)]
            contact = {"normal_angle": atan2(normal[1], normal[0])} | dict(zip(("point", "point_after"), points))
            record = {"profile": profile, "bodies": bodies, "contact": contact}
            # Both restore the velocity before the step, Box2D one of more than 1 m/s; a coefficient belongs to one point.
            if len(points) == 1 and abs(motion(record)["approach"]) > 1:
                record["model"] = {"restitution": pair["restitution"], "impulse_ratio": pair["friction"], "ratio_kind": "friction"}
            records.append(record)
        last = points
    return records


def lasting(pair, state, step, timestep):
    """Return a record of the first contact from its first step to its last: this engine's contacts are springs."""
    first, last, steps = None, None, 0
    for _ in range(MUJOCO_STEPS * STEPS):
        before = state()
        places, normal, points = step()
        if points:
            first = first or (before, places, normal, points)
            last, steps = (state(), places, points), steps + 1
        elif first:
            break
    if first is None or len(first[3]) > 1 or len(last[2]) > 1:
        return []
    bodies = [body(*each) for each in zip(pair["bodies"], first[1], first[0], last[0])]
    for each, place in zip(bodies, last[1]):
        each["after"]["cg"] = place
    contact = {"normal_angle": atan2(first[2][1], first[2][0]), "point": first[3][0], "point_after": last[2][0], "duration": steps * timestep}
    return [{"profile": "stepper", "bodies": bodies, "contact": contact}]


def motion(record):
    """Return from the numbers of a record, in exact arithmetic, by how much each law is broken, as a multiple of what a stepper may; and the approach."""

    def vector(pair):
        return Fraction(pair[0]), Fraction(pair[1])

    def dot(a, b):
        return a[0] * b[0] + a[1] * b[1]

    def cross(a, b):
        return a[0] * b[1] - a[1] * b[0]

    def less(a, b):
        return a[0] - b[0], a[1] - b[1]

    def size(*vectors):
        return max(hypot(*map(float, each)) for each in vectors)

    contact, bodies = record["contact"], record["bodies"]
    n = Fraction(cos(contact["normal_angle"])), Fraction(sin(contact["normal_angle"]))
    points = [vector(contact[key]) for key in ("point", "point_after") if key in contact]
    mass, inertia = ([Fraction(each[key]) for each in bodies] for key in ("mass", "yaw_inertia"))
    center = [vector(each["cg"]) for each in bodies]
    center_after = [vector(each["after"].get("cg", each["cg"])) for each in bodies]
    v, V = ([vector(each[side]["v"]) for each in bodies] for side in ("before", "after"))
    w, W = ([Fraction(each[side]["yaw_rate"]) for each in bodies] for side in ("before", "after"))
    gained = [(mass[i] * (V[i][0] - v[i][0]), mass[i] * (V[i][1] - v[i][1])) for i in (0, 1)]
    spin = [inertia[i] * (W[i] - w[i]) for i in (0, 1)]
    impulse, momentum = size(*gained), ROUNDING[record["profile"]] * float(sum(mass[i] * Fraction(size(v[i], V[i])) for i in (0, 1)))

    def relative(point, centers, velocities, rates):
        """Return the velocity of body 2 less that of body 1 at a point."""
        one, two = ((v[0] - w * (point[1] - c[1]), v[1] + w * (point[0] - c[0])) for c, v, w in zip(centers, velocities, rates))
        return less(two, one)

    # Two points at one instant have different velocities; that of the first is used.
    before, after = relative(points[0], center, v, w), relative(points[-1] if "duration" in contact else points[0], center_after, V, W)
    speed, arm = size(before), max(size(less(point, place)) for point in points for place in center)
    ahead = 1 if dot(less(center[1], center[0]), n) >= 0 else -1
    energy = [sum(mass[i] * dot(v[i], v[i]) + inertia[i] * w[i] ** 2 for i in (0, 1)) / 2 for v, w in ((v, w), (V, W))]

    # Seen from the center of mass of the pair.
    past = less(v[1], v[0])
    available = (dot(past, past) / (1 / mass[0] + 1 / mass[1]) + sum(inertia[i] * w[i] ** 2 for i in (0, 1))) / 2

    def off_line(i):
        """Return how far the change of spin is from the moment of the impulse about any point between the two."""
        moments = [cross(less(point, place), gained[i]) for point, place in zip((points[0], points[-1]), (center[i], center_after[i]))]
        return max(spin[i] - max(moments), min(moments) - spin[i], 0)

    def beyond_critical():
        """Return V_t where the impulse has reversed the sliding: where P_t is not between zero and that with the same V_n and no V_t."""
        t = -n[1], n[0]
        arms = [(dot(arm, n), dot(arm, t)) for arm in (less(points[0], place) for place in center)]
        nn, nt, tt = (sum(unit / mass[i] + product(*arms[i]) / inertia[i] for i in (0, 1))
                      for unit, product in ((1, lambda _, t: t * t), (0, lambda n, t: -n * t), (1, lambda n, _: n * n)))
        # K P = v − V for the impulse on body 1.
        ending = (nn * dot(before, t) - nt * (dot(before, n) - dot(after, n))) / (nn * tt - nt * nt)
        tangential = dot(gained[0], t)
        lies_between = abs(tangential) <= REST * impulse or 0 <= tangential / ending <= 1
        return 0 if lies_between else abs(dot(after, t))

    out = {
        "linear-momentum": size((gained[0][0] + gained[1][0], gained[0][1] + gained[1][1])) / (LINEAR[record["profile"]] * impulse + momentum),
        "angular-momentum": abs(sum(spin[i] + mass[i] * (cross(center_after[i], V[i]) - cross(center[i], v[i])) for i in (0, 1))) / (REST * impulse * arm),
        "line-of-action": max(off_line(0), off_line(1)) / (REST * impulse * arm),
        "energy-gain": (energy[1] - energy[0]) / (Fraction(REST) * available),
        "compressive": max(dot(before, n) * ahead / (REST * speed), dot(gained[0], n) * ahead / (REST * impulse)),
        "interpenetration": -dot(after, n) * ahead / (REST * speed),
    }
    # A law of velocities at a contact holds for one point, and for bodies that approach each other.
    if (len(points) == 1 or "duration" in contact) and abs(dot(before, n)) > REST * speed:
        out["beyond-critical"] = beyond_critical() / (REST * speed)
        if "model" in record:
            out["restitution"] = abs(dot(after, n) / dot(before, n) + Fraction(record["model"]["restitution"])) / REST
    return {rule: float(share) for rule, share in out.items()} | {"approach": float(dot(before, n))}


def main():
    pairs, seed = int(float(sys.argv[1])) if len(sys.argv) > 1 else 200, int(sys.argv[2]) if len(sys.argv) > 2 else 1
    wrong = []
    print("| engine | contacts | pass or warn | complaints, each borne out by the record | largest residual of a record that passes, of what may be |\n|---|---:|---:|---|---|")
    for name, engine in {f"Chipmunk (pymunk {pymunk.version})": with_pymunk, f"Box2D {Box2D.__version__}": with_box2d, f"MuJoCo {mujoco.__version__}": with_mujoco}.items():
        rng = random.Random(seed)
        records = [{"id": f"{i}.{j}", **record} for i in range(pairs) for j, record in enumerate(engine(draw(rng)))]
        complaints, largest = Counter(), Counter()
        for record, broken in zip(records, broken_rules(records, "m", "kg", "rad"), strict=True):
            residuals = motion(record)
            complaints.update(broken)
            # What is within a factor of two of its bound depends on the size that the residual is taken of.
            wrong += [(name, record["id"], rule, "complaint", residuals.get(rule)) for rule in broken if not residuals.get(rule, 0) > 0.5]
            wrong += [(name, record["id"], rule, "silence", share) for rule, share in residuals.items() if rule != "approach" and share > 2 and rule not in broken]
            complaints["fail"] += bool(broken)
            for rule, share in residuals.items() if not broken else ():
                largest[rule] = max(largest[rule], share)
        failed = complaints.pop("fail", 0)
        listed = "; ".join(f"`{rule}` {count}" for rule, count in sorted(complaints.items())) or "none"
        most = "; ".join(f"`{rule}` {share:.1g}" for rule, share in largest.most_common() if share > 1e-3 and rule != "approach")
        print(f"| {name} | {len(records)} | {len(records) - failed} | {listed} | {most} |")
    for each in wrong[:10]:
        print(*each, file=sys.stderr)
    print(f"\n{len(wrong)} judged otherwise by the exact laws")
    return bool(wrong)


if __name__ == "__main__":
    sys.exit(main())
