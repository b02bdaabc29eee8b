#!/usr/bin/env python3
"""Random effects by Paule and Mandel, independently of the library: Newton's method on F(t) = sum w (x - m)^2 - (k - 1) in 50 digits.

Prints the mean, its standard deviation, the standard deviation between vehicles and that of a further vehicle for each set of numbers that the tests use."""
from decimal import Decimal as D, getcontext

getcontext().prec = 50


# Quantiles at 0.975 of the normal distribution and of Student's with k - 1 degrees of freedom, from mpmath.
Z = D("1.959963984540054235524594")
T = {3: D("4.30265272974946385232094"), 5: D("2.77644510519779435780310")}


def further(numbers):
    """The spread and the error of the mean, both with (k - 1) (z/t)^2 in place of k - 1."""
    k = len(numbers)
    _, of_mean, between = pool(numbers, (k - 1) * (Z / T[k]) ** 2)
    return (between**2 + of_mean**2).sqrt()


def pool(numbers, squares=None):
    xs = [D(str(x)) for x, _ in numbers]
    vs = [D(str(s)) ** 2 for _, s in numbers]
    squares = len(xs) - 1 if squares is None else squares

    def at(t):
        ws = [1 / (v + t) for v in vs]
        mean = sum(w * x for w, x in zip(ws, xs)) / sum(ws)
        f = sum(w * (x - mean) ** 2 for w, x in zip(ws, xs)) - squares
        # DerSimonian and Kacker (2007): the derivative in t.
        slope = -sum(w**2 * (x - mean) ** 2 for w, x in zip(ws, xs))
        return mean, 1 / sum(ws), f, slope

    t = D("1e-30")
    if all(v > 0 for v in vs) and at(D(0))[2] <= 0:
        t = D(0)
    else:
        for _ in range(500):
            _, _, f, slope = at(t)
            t = t - f / slope
    mean, variance, _, _ = at(t) if t > 0 or all(v > 0 for v in vs) else (xs[0], D(0), 0, 0)
    return mean, variance.sqrt(), t.sqrt()


def slopes(b0, scatter, tests):
    """d1 of tests of uniform depth with b0 held, and its error by the scatter of E*: E* = b0 sqrt(m/w) + d1 C."""
    found = []
    for mass, width, speed, restitution, depth in (map(D, test) for test in tests):
        root = (mass / width).sqrt()
        intensity = root * speed * (1 - restitution**2).sqrt()
        found.append(((intensity - D(b0) * root) / depth, D(scatter) / depth))
    return found


# cli/tests/main/stiffness.rs, CLASS: kg, m, m/s, -, m.
CLASS = [("1500", "1.5", "15", "0.1", "0.40"), ("1600", "1.6", "14", "0.15", "0.45"), ("1300", "1.4", "16", "0.12", "0.38")]

if __name__ == "__main__":
    for numbers in [
        [(812, 31), (945, 22), (760, 40), (1010, 18), (880, 55)],
        slopes("2", "10", CLASS),
        slopes("2", "60", CLASS),
    ]:
        print(*(f"{float(value):.17g}" for value in [*pool(numbers), further(numbers)]))
