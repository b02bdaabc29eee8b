#!/usr/bin/env python3
"""Random effects by Paule and Mandel, independently of the library: Newton's method on F(t) = sum w (x - m)^2 - (k - 1) in 50 digits;
and a further vehicle by quadrature.

Prints the mean, its standard deviation and that between vehicles by Paule and Mandel, and those of the mean and of a further vehicle by quadrature, for each set
of numbers that the tests use."""
from decimal import Decimal as D, getcontext
from math import erf, exp, log, sqrt

getcontext().prec = 50


# The quantile at 0.975 of the normal distribution.
Z = 1.959963984540054


def spread_of_further(xs, vs, center):
    """The variance between vehicles that, with the error of the mean, gives the normal distribution the 95 % interval of a further vehicle about the center.

    The trapezoidal rule over ln tau, of the prior tau/(tau^2 + upper median of v) and the likelihood with a flat prior of the mean."""
    count, own = len(xs), sorted(vs)[len(vs) // 2]
    scale = sqrt(max(sum((x - center) ** 2 for x in xs) / count, own))
    if scale == 0:
        return 0.0

    def at(t):
        ws = [1 / (v + t) for v in vs]
        mean = sum(w * x for w, x in zip(ws, xs)) / sum(ws)
        return mean, 1 / sum(ws), sum(w * (x - mean) ** 2 for w, x in zip(ws, xs))

    nodes = []
    for i in range(-5000, 5001):
        tau = scale * exp(i / 100)
        mean, variance, squares = at(tau**2)
        density = 0.5 * (log(variance / scale**2) - sum(log((v + tau**2) / scale**2) for v in vs) - squares)
        weight = exp(density) * tau / (tau**2 + own) * tau
        nodes.append((weight, sqrt(tau**2 + variance) * sqrt(2), mean - center))
    greatest = max(node[0] for node in nodes)
    nodes = [node for node in nodes if node[0] > 1e-25 * greatest]
    total = sum(node[0] for node in nodes)

    def root(is_below, high):
        low = 0.0
        for _ in range(70):
            middle = (low + high) / 2
            low, high = (middle, high) if is_below(middle) else (low, middle)
        return high

    def within(h):
        return sum(w * (erf((h - d) / s) + erf((h + d) / s)) / 2 for w, s, d in nodes) / total

    half = root(lambda h: within(h) < 0.95, 1e3 * scale)
    return root(lambda t: t + at(t)[1] < (half / Z) ** 2, (half / Z) ** 2)


def further(numbers):
    mean, _, _ = pool(numbers)
    xs, vs = [float(x) for x, _ in numbers], [float(s) ** 2 for _, s in numbers]
    between = spread_of_further(xs, vs, float(mean))
    variance = 1 / sum(1 / (v + between) for v in vs)
    return D(sqrt(variance)), D(sqrt(between + variance))


def pool(numbers):
    xs = [D(str(x)) for x, _ in numbers]
    vs = [D(str(s)) ** 2 for _, s in numbers]
    squares = len(xs) - 1

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
        print(*(f"{float(value):.17g}" for value in [*pool(numbers), *further(numbers)]))
