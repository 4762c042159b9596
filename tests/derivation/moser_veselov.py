#!/usr/bin/env python3
"""The terms of include/adstar/integrators/moser_veselov_moments.hpp, derived anew in exact rationals.

    tests/derivation/moser_veselov.py            prints both tables
    tests/derivation/moser_veselov.py --check    compares them with the header; 1 if they differ

The exact flow of a free body has a power series in h. Its quaternion, put into the three equations of
a discrete Moser-Veselov step,
    (h/2) y_1 = J_1 p_0 p_1 + (J_3 - J_2) p_2 p_3   and cyclically,
makes them linear in the modified moments J_j(h). Their inverses turn out to be
    1/J_j = (1/I_j) (1 + s) + d
with the same s and d for all three j, even in h: both are asserted. s_2k and d_2k are polynomials in
the variables of the header (middle moment 1); as many samples as there are monomials fix the
coefficients, and more samples than that must agree.
"""

import pathlib
import random
import re
import sys
from fractions import Fraction

DEGREE = 4          # of the polynomials in c and b: order 2 + 2 DEGREE
POWERS = 2 * DEGREE + 2
HEADER = pathlib.Path(__file__).parents[2] / "include/adstar/integrators/moser_veselov_moments.hpp"


def convolution(u, v, n):
    return sum(u[k] * v[n - k] for k in range(n + 1))


def flow(a, momentum):
    """Series in h of the quaternion of y' = y x (a y), q' = q (0, a y)/2, q(0) = 1."""
    y = [[v] for v in momentum]
    q = [[Fraction(v)] for v in (1, 0, 0, 0)]
    for n in range(POWERS):
        w = [[a[i] * v for v in y[i]] for i in range(3)]
        dy = [convolution(y[(i + 1) % 3], w[(i + 2) % 3], n)
              - convolution(y[(i + 2) % 3], w[(i + 1) % 3], n) for i in range(3)]
        dq = [-sum(convolution(q[i + 1], w[i], n) for i in range(3))]
        for i in range(3):
            j, k = (i + 1) % 3, (i + 2) % 3
            dq.append(convolution(q[0], w[i], n) + convolution(q[j + 1], w[k], n)
                      - convolution(q[k + 1], w[j], n))
        for series, slope in zip(y + q, dy + [v / 2 for v in dq]):
            series.append(slope / (n + 1))
    return q


def modified(a, momentum):
    """Coefficients of h^2, h^4, ... of s and of d."""
    q = flow(a, momentum)
    over_h = lambda u, v: [convolution(u, v, n + 1) for n in range(POWERS)]
    J = [[] for _ in range(3)]
    own = [over_h(q[0], q[i + 1]) for i in range(3)]
    other = [over_h(q[(i + 1) % 3 + 1], q[(i + 2) % 3 + 1]) for i in range(3)]
    for n in range(POWERS - 1):
        known = [(momentum[i] / 2 if n == 0 else 0)
                 - sum(own[i][n - t] * J[i][t]
                       + other[i][n - t] * (J[(i + 2) % 3][t] - J[(i + 1) % 3][t]) for t in range(n))
                 for i in range(3)]
        for i in range(3):
            J[i].append(known[i] / own[i][0])   # `other` begins with h
    inverse = []
    for i in range(3):
        series = [1 / J[i][0]]
        for n in range(1, POWERS - 1):
            series.append(-series[0] * sum(J[i][k] * series[n - k] for k in range(1, n + 1)))
        inverse.append(series)
    s = [(u - v) / (a[0] - a[1]) for u, v in zip(inverse[0], inverse[1])]
    d = [u - a[0] * v for u, v in zip(inverse[0], s)]
    assert s[0] == 1 and d[0] == 0
    assert all(inverse[2][n] == a[2] * s[n] + d[n] for n in range(POWERS - 1))
    assert not any(s[1::2]) and not any(d[1::2])
    return s[2::2], d[2::2]


def sample(generator):
    """(c, b, f, g) and s, d of a body whose middle moment is 1."""
    betas = (Fraction(generator.randint(1, 9)), -Fraction(generator.randint(1, 9), 10))
    a = (1 + betas[0], Fraction(1), 1 + betas[1])
    y = [Fraction(generator.randint(1, 7)) for _ in range(3)]
    c = sum(v * v for v in y) / 2
    b = (betas[0] * y[0] ** 2 + betas[1] * y[2] ** 2) / 2
    return (c, b, betas[0] + betas[1], betas[0] * betas[1]), modified(a, y)


def monomials(k, extra):
    """(c, b, f, g) exponents of degree k in c and b; in 1/I, c counts two and b one."""
    for c in range(k, -1, -1):
        weight = 2 * c + (k - c) + extra
        for f in range(weight + 1):
            for g in range((weight - f) // 2 + 1):
                yield (c, k - c, f, g)


def solve(rows):
    """The one solution of an overdetermined system, rows (coefficients..., right-hand side)."""
    unknowns = len(rows[0]) - 1
    rows = [row[:] for row in rows]
    for p in range(unknowns):
        pivot = next(i for i in range(p, len(rows)) if rows[i][p])
        rows[p], rows[pivot] = rows[pivot], rows[p]
        scale = 1 / rows[p][p]
        rows[p] = [v * scale for v in rows[p]]
        for i in range(len(rows)):
            if i != p and rows[i][p]:
                t = rows[i][p]
                rows[i] = [u - t * v for u, v in zip(rows[i], rows[p])]
    assert not any(row[-1] for row in rows[unknowns:]), "the samples do not agree"
    return [rows[i][-1] for i in range(unknowns)]


def derive():
    generator = random.Random(1991)
    seen = {}
    while len(seen) < 140:
        point, series = sample(generator)
        seen[point] = series
    tables = {"kScale": [], "kShift": []}
    for extra, name in enumerate(tables):
        for k in range(1, DEGREE + 1):
            basis = list(monomials(k, extra))
            rows = []
            for point, series in list(seen.items())[:len(basis) + 10]:
                row = []
                for exponents in basis:
                    value = Fraction(1)
                    for base, exponent in zip(point, exponents):
                        value *= base ** exponent
                    row.append(value)
                rows.append(row + [series[extra][k - 1]])
            for exponents, value in zip(basis, solve(rows)):
                if value:
                    assert exponents[2] <= exponents[1], "a needle would not be bounded"
                    tables[name].append(exponents + (value.numerator, value.denominator))
    return tables


def in_header(name):
    body = re.search(name + r"\[\] = \{(.*?)\};", HEADER.read_text(), re.S).group(1)
    return [tuple(int(v) for v in row.split(",")) for row in re.findall(r"\{([^{}]+)\}", body)]


def main():
    same = True
    for name, terms in derive().items():
        if "--check" in sys.argv[1:]:
            agrees = sorted(terms) == sorted(in_header(name))
            print(f"{name}: {len(terms)} terms, " + ("as derived" if agrees else "NOT as derived"))
            same = same and agrees
        else:
            print(name, *("{%d, %d, %d, %d, %d, %d}" % term for term in terms), sep="\n  ")
    return 0 if same else 1


if __name__ == "__main__":
    sys.exit(main())
