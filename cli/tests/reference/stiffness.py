#!/usr/bin/env python3
"""Barrier tests with the stiffness that fits them:  python3 stiffness.py > stiffness.jsonl

The two examples and series with uneven profiles, two vehicles and no standard deviations. Takes the units from solve.py. README.md tells how the answers are made.
"""
from fractions import Fraction

from mpmath import mp, mpf

from solve import POUND_FORCE, Bare, factor, read, show

ROOT_POUND = mp.sqrt(mpf(POUND_FORCE.numerator) / POUND_FORCE.denominator)
STEP = mpf(10) ** -15


def test(mass, speed, restitution, width, depths, *deviations):
    made = {"mass": mass, "speed": speed, "restitution": Bare(restitution), "width": width, "depths": depths}
    if deviations:
        made |= {"speed_sd": deviations[0], "restitution_sd": Bare(deviations[1]), "scatter": deviations[2]}
    return made


def struble_welsh(*deviations):
    rows = [("16.6537 ft/s", "0.18", "0.1062 ft"), ("29.3669 ft/s", "0.13", "0.5203 ft"), ("36.8580 ft/s", "0.12", "1.0768 ft")]
    return [test("101.91 slug", speed, e, "5 ft", [depth, depth], *deviations) for speed, e, depth in rows]


UNEVEN = [
    test("1500 kg", "8 m/s", "0.2", "1.5 m", ["10 cm", "16 cm", "22 cm", "12 cm"], "0.1 m/s", "0.03", "12 N^0.5"),
    test("1500 kg", "13 m/s", "0.1", "1.5 m", ["30 cm", "44 cm", "52 cm", "38 cm"], "0.15 m/s", "0.04", "15 N^0.5"),
]
OTHER = [
    test("1380 kg", "11 m/s", "0.15", "1.6 m", ["12 cm", "24 cm", "38 cm"], "0.2 m/s", "0.05", "20 N^0.5"),
    test("1390 kg", "16 m/s", "0.05", "1.6 m", ["33 cm", "50 cm", "81 cm"], "0.1 m/s", "0.02", "10 N^0.5"),
]
MALIBU = test("1779 kg", "15.6 m/s", "0", "1.478 m", ["0.265 m", "0.474 m", "0.504 m", "0.505 m", "0.475 m", "0.310 m"])


def bare(tests):
    return [{key: value for key, value in each.items() if key not in ("speed_sd", "restitution_sd", "scatter")} for each in tests]


CASES = [
    ("struble-welsh.toml", [("Cavalier", struble_welsh("0.3 ft/s", "0.05", "5 lbf^0.5"))], {"depth": "1 ft", "width": "5 ft"}),
    ("malibu.toml", [("Malibu", [MALIBU])], {"onset": "2.2 m/s"}),
    ("no standard deviations", [("car", struble_welsh())], {"depth": "30 cm", "width": "1.4 m"}),
    ("two uneven vehicles", [("one", UNEVEN), ("other", OTHER)], {"depth": "35 cm", "width": "1.2 m", "onset": "1.5 m/s"}),
    ("uneven without deviations", [("one", bare(UNEVEN)), ("other", bare(OTHER))], {"depth": "0.2 m", "width": "1.3 m"}),
]


def root_force(text):
    number, unit = text.split(" ")
    return mpf(number) * {"lbf^0.5": ROOT_POUND, "N^0.5": mpf(1)}[unit]


def forms(d0, d1):
    return {"d0": d0, "d1": d1, "A": d0 * d1, "B": d1 ** 2, "G": d0 ** 2 / 2}


def means(depths):
    """The means of the depth and of its square over the width, straight between the stations."""
    pieces = list(zip(depths, depths[1:]))
    return [sum((a + b) / 2 for a, b in pieces) / len(pieces), sum((a * a + a * b + b * b) / 3 for a, b in pieces) / len(pieces)]


def minimum(model, count, observed, weight):
    """Least squares by Gauss-Newton with difference quotients: coefficients, derivatives, fitted values."""
    at = mp.matrix([mpf(100), mpf(900)])
    for _ in range(60):
        fitted = mp.matrix([model(i, at) for i in range(count)])
        jacobian = mp.zeros(count, 2)
        for k in range(2):
            for i in range(count):
                ends = []
                for sign in (1, -1):
                    moved = at.copy()
                    moved[k] += sign * STEP
                    ends.append(model(i, moved))
                jacobian[i, k] = (ends[0] - ends[1]) / (2 * STEP)
        information = jacobian.T * weight * jacobian
        step = mp.lu_solve(information, jacobian.T * weight * (observed - fitted))
        at = at + step
    assert mp.norm(step) < mpf(10) ** -20
    return at, mp.inverse(information), fitted


def answer(title, vehicles, fit):
    has_deviations = any("scatter" in each for _, tests in vehicles for each in tests)
    tests, places, intensities, depths = [], [], [], []
    count = sum(len(each) for _, each in vehicles)
    covariance = mp.zeros(count, count)
    for name, series in vehicles:
        first, energy, squares, errors = len(places), mpf(0), mpf(0), []
        for at, made in enumerate(series):
            mass, speed = read(made["mass"], "mass"), read(made["speed"], "speed")
            exact = Fraction(made["restitution"])
            restitution, width = mpf(exact.numerator) / exact.denominator, read(made["width"], "length")
            mean, square = means([read(depth, "length") for depth in made["depths"]])
            own = mass * (1 - restitution ** 2) * speed ** 2 / 2
            energy, squares = energy + own, squares + (1 - restitution ** 2) * speed ** 2
            intensity = mp.sqrt(2 * energy / width)
            told = {"vehicle": name, "mean_depth": mean, "crush_energy": energy, "equivalent_energy_speed": mp.sqrt(squares),
                    "crush_intensity": intensity}
            if "onset" in fit and at == 0:
                b0 = read(fit["onset"], "speed")
                b1 = (mp.sqrt(2 * own / mass) - b0) / mean
                line = mp.sqrt(mass / width)
                told["on_mean_depth"] = {**forms(line * b0, line * b1), "b1": b1}
                # w/2 (d0^2 + 2 d0 d1 mean + d1^2 square) = E.
                d0 = line * b0
                root = [(-d0 * mean + mp.sqrt((d0 * mean) ** 2 + square * (2 * own / width - d0 ** 2))) / square]
                told["on_profile"] = forms(d0, root[0])
            tests.append(told)
            # What the errors of speed and restitution of this test do to the energies from here on, by difference quotients.
            if has_deviations:
                change = lambda v, e: (mass * (1 - (restitution + e) ** 2) * (speed + v) ** 2 - mass * (1 - (restitution - e) ** 2) * (speed - v) ** 2) / (4 * STEP)
                exact = Fraction(made["restitution_sd"])
                errors.append((change(STEP, 0) * read(made["speed_sd"], "speed")) ** 2
                              + (change(0, STEP) * mpf(exact.numerator) / exact.denominator) ** 2)
                places.append(width * intensity)
                for k in range(at + 1):
                    shared = sum(errors[:k + 1]) / (places[first + at] * places[first + k])
                    covariance[first + at, first + k] = covariance[first + k, first + at] = shared
                covariance[first + at, first + at] += root_force(made["scatter"]) ** 2
            else:
                places.append(width * intensity)
                covariance[first + at, first + at] = 1
            intensities.append(intensity)
            depths.append((mean, square))
    answer = {"schema": 1, "title": title, "tests": tests, "fits": []}
    if count < 2:
        return answer
    weight, observed = mp.inverse(covariance), mp.matrix(intensities)
    models = [("mean depth", lambda i, at: at[0] + at[1] * depths[i][0]),
              ("profile", lambda i, at: mp.sqrt(at[0] ** 2 + 2 * at[0] * at[1] * depths[i][0] + at[1] ** 2 * depths[i][1]))]
    for name, model in models:
        (d0, d1), spread, fitted = minimum(model, count, observed, weight)
        off = observed - fitted
        chi_square, freedom = (off.T * weight * off)[0], count - 2
        if not has_deviations and freedom:
            spread = spread * (chi_square / freedom)
        of = {"model": name, **forms(d0, d1), "chi_square": chi_square, "degrees_of_freedom": freedom,
              "residuals": [{"observed": observed[i], "fitted": fitted[i],
                             "standardised": off[i] / mp.sqrt(covariance[i, i]) if has_deviations else None} for i in range(count)],
              "covariance": {"basis": "standard deviations" if has_deviations else "residuals", "d0_d0": spread[0, 0], "d0_d1": spread[0, 1],
                             "d1_d1": spread[1, 1], "d0_sd": mp.sqrt(spread[0, 0]), "d1_sd": mp.sqrt(spread[1, 1]),
                             "correlation": spread[0, 1] / mp.sqrt(spread[0, 0] * spread[1, 1])}}
        if "depth" in fit:
            depth, width = read(fit["depth"], "length"), read(fit["width"], "length")
            energy = lambda x, y: width * (x + y * depth) ** 2 / 2
            by = mp.matrix([(energy(d0 + STEP, d1) - energy(d0 - STEP, d1)) / (2 * STEP),
                            (energy(d0, d1 + STEP) - energy(d0, d1 - STEP)) / (2 * STEP)])
            of["prediction"] = {"depth": depth, "width": width, "crush_energy": energy(d0, d1), "sd": mp.sqrt((by.T * spread * by)[0])}
        answer["fits"].append({**of, "findings": []})
    return answer


for title, vehicles, fit in CASES:
    made = {"schema": Bare("1"), "title": title, "vehicle": [{"name": name, "test": tests} for name, tests in vehicles], "fit": fit}
    print(show({"case": made, "answer": answer(title, vehicles, fit)}))
