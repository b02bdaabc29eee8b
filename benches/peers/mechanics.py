"""The mechanics of a collision under the law of Brach, for arrays of any library and numbers of any precision."""

from math import pi


def mechanics(get, sin, cos, sqrt, arctan2, ratio=None):
    """Return every output of `solve` by its name, from a function that returns an input by its name.

    The impulse ratio is the critical one, or what the function `ratio` makes of it.
    """
    gamma, e = get("contact.crush_plane"), get("contact.restitution")
    cg, sg = cos(gamma), sin(gamma)
    body = []
    for i in (1, 2):
        of = lambda key: get(f"vehicle.{i}.{key}")
        m, j, w, c, s = of("mass"), of("yaw_inertia"), of("yaw_rate"), cos(of("heading")), sin(of("heading"))
        f, l = of("impact_center.forward"), of("impact_center.left")
        vx, vy = of("speed") * c, of("speed") * s
        x, y = f * c - l * s, f * s + l * c
        body.append((m, j, w, c, s, vx, vy, x * cg + y * sg, y * cg - x * sg))
    (m1, j1, w1, c1, s1, vx1, vy1, n1, t1), (m2, j2, w2, c2, s2, vx2, vy2, n2, t2) = body
    un = (vx2 * cg + vy2 * sg - t2 * w2) - (vx1 * cg + vy1 * sg - t1 * w1)
    ut = (vy2 * cg - vx2 * sg + n2 * w2) - (vy1 * cg - vx1 * sg + n1 * w1)
    knn = 1 / m1 + 1 / m2 + t1 * t1 / j1 + t2 * t2 / j2
    ktt = 1 / m1 + 1 / m2 + n1 * n1 / j1 + n2 * n2 / j2
    knt = -(n1 * t1 / j1 + n2 * t2 / j2)
    det = knn * ktt - knt * knt
    # The impulse is the one on vehicle 1; it ends the approach along t, and turns the one along n round.
    pn = ((1 + e) * un * ktt - ut * knt) / det
    pt = (ut * knn - (1 + e) * un * knt) / det
    critical = mu = pt / pn
    if ratio is not None:
        mu = ratio(critical)
        pn = (1 + e) * un / (knn + mu * knt)
        pt = mu * pn
    px, py = pn * cg - pt * sg, pn * sg + pt * cg
    out = {}
    before = after = 0
    for i, sign, (m, j, w, c, s, vx, vy, n, t) in ((1, 1, body[0]), (2, -1, body[1])):
        dx, dy = sign * px / m, sign * py / m
        rate = w + sign * (n * pt - t * pn) / j
        v = f"vehicle.{i}"
        out |= {f"result.{v}.velocity.x": vx + dx, f"result.{v}.velocity.y": vy + dy, f"result.{v}.yaw_rate": rate}
        out |= {f"{v}.delta_v.x": dx, f"{v}.delta_v.y": dy, f"{v}.delta_v_magnitude": sqrt(dx * dx + dy * dy)}
        out[f"{v}.pdof"] = arctan2(dy * c - dx * s, -(dx * c + dy * s))
        before = before + 0.5 * (m * (vx * vx + vy * vy) + j * w * w)
        after = after + 0.5 * (m * ((vx + dx) * (vx + dx) + (vy + dy) * (vy + dy)) + j * rate * rate)
    sn, st = un - (knn * pn + knt * pt), ut - (knt * pn + ktt * pt)
    wn, wt = -0.5 * pn * (un + sn), -0.5 * pt * (ut + st)
    out |= {"result.contact.restitution": e, "result.contact.impulse_ratio": mu, "contact.critical_impulse_ratio": critical}
    out |= {"contact.impulse.normal": pn, "contact.impulse.tangential": pt, "contact.impulse.x": px, "contact.impulse.y": py}
    out |= {"contact.approach.normal": un, "contact.approach.tangential": ut, "contact.separation.normal": sn, "contact.separation.tangential": st}
    out |= {"energy.before": before, "energy.after": after, "energy.loss": -(wn + wt), "energy.normal_work": wn, "energy.tangential_work": wt}
    return out


def difference(name, one, of, sqrt):
    """Return how far an output is from the one that `of` returns by its name, relative to the largest of its kind in its row."""
    speed = abs(of("contact.approach.normal")) + abs(of("contact.approach.tangential")) + abs(of("vehicle.1.speed"))
    impulse = sqrt(of("contact.impulse.normal") ** 2 + of("contact.impulse.tangential") ** 2)
    apart = abs(one - of(name))
    if "energy" in name:
        return apart / of("energy.before")
    if ".impulse." in name:
        return apart / impulse
    if any(kind in name for kind in ("velocity", "delta_v", "approach", "separation")):
        return apart / speed
    if name.endswith("pdof"):
        return abs((apart + pi) % (2 * pi) - pi) * of(f"{name[:9]}.delta_v_magnitude") / speed
    if name.endswith("ratio"):
        return apart * of("contact.impulse.normal") ** 2 / impulse**2
    return apart
