#!/usr/bin/env python3
"""A further vehicle of a class, independently of the library: 2x2 matrices by elimination, and pooled.py for the variances between vehicles.

The class is that of cli/tests/main/reconstruct/from_tests.rs: two vehicles with two new cars each, 1500 kg over 1.5 m at 7 and 15 m/s with a restitution of 0.1.
Prints the line through all tests, the standard deviations of d0 and d1 of a further vehicle and their covariance."""
from math import sqrt

from pooled import pool, spread_of_further

SCATTER = 4.0


def matmul(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(2)) for j in range(len(b[0]))] for i in range(2)]


def add(*all_of_them):
    return [[sum(m[i][j] for m in all_of_them) for j in range(len(all_of_them[0][0]))] for i in range(2)]


def inverse(m):
    (a, b), (c, d) = m
    determinant = a * d - b * c
    return [[d / determinant, -b / determinant], [-c / determinant, a / determinant]]


def between(numbers, variances):
    """The variance between vehicles for a further one, about their mean by Paule and Mandel."""
    mean, _, _ = pool([(number, sqrt(variance)) for number, variance in zip(numbers, variances)])
    return spread_of_further(numbers, variances, float(mean))


def further(vehicles):
    """Depths and E* of the tests of each vehicle."""
    information, moment = [], []
    for tests in vehicles:
        rows = [[1.0, depth] for depth, _ in tests]
        information.append([[sum(r[i] * r[j] for r in rows) / SCATTER**2 for j in range(2)] for i in range(2)])
        moment.append([[sum(r[i] * e for r, (_, e) in zip(rows, tests)) / SCATTER**2] for i in range(2)])
    own = [matmul(inverse(i), m) for i, m in zip(information, moment)]
    covariances = [inverse(i) for i in information]
    total = inverse(add(*information))
    line = matmul(total, add(*moment))
    v = [between([t[j][0] for t in own], [c[j][j] for c in covariances]) for j in range(2)]
    depth = -total[0][1] / total[1][1]
    along = [c[0][0] + 2 * depth * c[0][1] + depth**2 * c[1][1] for c in covariances]
    missing = max(between([t[0][0] + depth * t[1][0] for t in own], along) - v[0] - depth**2 * v[1], 0.0)
    spread = [[v[0] + missing / 2, 0.0], [0.0, v[1] + missing / 2 / depth**2]]
    moved = [matmul(matmul(total, i), matmul(spread, matmul(i, total))) for i in information]
    return line, add(total, spread, *moved)


if __name__ == "__main__":
    root = sqrt(1500 * (1 - 0.1**2) / 1.5)
    for depths in [[(0.16, 0.42), (0.22, 0.60)], [(0.10, 0.20), (0.45, 0.60)]]:
        line, covariance = further([[(depth, speed * root) for depth, speed in zip(of, (7, 15))] for of in depths])
        print(*(f"{x:.17g}" for x in (line[0][0], line[1][0], sqrt(covariance[0][0]), sqrt(covariance[1][1]), covariance[0][1])))
