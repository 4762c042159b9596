#!/usr/bin/env python3
"""The terms of include/adstar/integrators/moser_veselov_terms.hpp, derived anew, exactly.

    tests/derivation/moser_veselov.py            prints both tables
    tests/derivation/moser_veselov.py --check    compares them with the header; 1 if they differ

The exact flow of a free body has a power series in h. Its quaternion, put into the three equations of
a discrete Moser-Veselov step,
    (h/2) y_1 = J_1 p_0 p_1 + (J_3 - J_2) p_2 p_3   and cyclically,
makes them linear in the modified moments J_j(h). Their inverses turn out to be
    1/J_j = (1/I_j) (1 + s) + d
with the same s and d for all three j, even in h: both are asserted. s_2k and d_2k are polynomials in
the variables of moser_veselov_moments.hpp (middle moment 1); as many samples as there are monomials fix the
coefficients, and more samples than that must agree.

All of it is done modulo the prime P: the samples are random residues, and a coefficient is the one
fraction with numerator and denominator below 2^130 that its residue allows. That every fraction found is
far smaller than that (asserted), and that the spare samples agree, leaves no room for chance.
"""

import math
import pathlib
import random
import re
import sys

DEGREE = 7          # of the polynomials in c and b: order 2 + 2 DEGREE
POWERS = 2 * DEGREE + 2
SPARE = 10          # samples beyond those that fix the coefficients
P = 2**521 - 1      # prime (Robinson 1952)
HEADER = pathlib.Path(__file__).parents[2] / "include/adstar/integrators/moser_veselov_terms.hpp"


def inverse(v):
    return pow(v, -1, P)


HALF = inverse(2)
ONE_OVER = [0] + [inverse(n) for n in range(1, POWERS + 2)]


def convolution(u, v, n):
    return sum(u[k] * v[n - k] for k in range(n + 1))


def flow(a, momentum):
    """Series in h of the quaternion of y' = y x (a y), q' = q (0, a y)/2, q(0) = 1."""
    y = [[v] for v in momentum]
    q = [[v] for v in (1, 0, 0, 0)]
    for n in range(POWERS):
        w = [[a[i] * v % P for v in y[i]] for i in range(3)]
        dy = [convolution(y[(i + 1) % 3], w[(i + 2) % 3], n)
              - convolution(y[(i + 2) % 3], w[(i + 1) % 3], n) for i in range(3)]
        dq = [-sum(convolution(q[i + 1], w[i], n) for i in range(3))]
        for i in range(3):
            j, k = (i + 1) % 3, (i + 2) % 3
            dq.append(convolution(q[0], w[i], n) + convolution(q[j + 1], w[k], n)
                      - convolution(q[k + 1], w[j], n))
        for series, slope in zip(y + q, dy + [v * HALF for v in dq]):
            series.append(slope * ONE_OVER[n + 1] % P)
    return q


def modified(a, momentum):
    """Coefficients of h^2, h^4, ... of s and of d."""
    q = flow(a, momentum)
    over_h = lambda u, v: [convolution(u, v, n + 1) % P for n in range(POWERS)]
    J = [[] for _ in range(3)]
    own = [over_h(q[0], q[i + 1]) for i in range(3)]
    other = [over_h(q[(i + 1) % 3 + 1], q[(i + 2) % 3 + 1]) for i in range(3)]
    leading = [inverse(own[i][0]) for i in range(3)]
    for n in range(POWERS - 1):
        known = [(momentum[i] * HALF if n == 0 else 0)
                 - sum(own[i][n - t] * J[i][t]
                       + other[i][n - t] * (J[(i + 2) % 3][t] - J[(i + 1) % 3][t]) for t in range(n))
                 for i in range(3)]
        for i in range(3):
            J[i].append(known[i] * leading[i] % P)   # `other` begins with h
    over_J = []
    for i in range(3):
        series = [inverse(J[i][0])]
        for n in range(1, POWERS - 1):
            series.append(-series[0] * sum(J[i][k] * series[n - k] for k in range(1, n + 1)) % P)
        over_J.append(series)
    apart = inverse(a[0] - a[1])
    s = [(u - v) * apart % P for u, v in zip(over_J[0], over_J[1])]
    d = [(u - a[0] * v) % P for u, v in zip(over_J[0], s)]
    assert s[0] == 1 and d[0] == 0
    assert all((over_J[2][n] - a[2] * s[n] - d[n]) % P == 0 for n in range(POWERS - 1))
    assert not any(s[1::2]) and not any(d[1::2])
    return s[2::2], d[2::2]


def sample(generator):
    """(c, b, f, g) and s, d of a body whose middle moment is 1."""
    betas = (generator.randrange(1, P), generator.randrange(1, P))
    a = (1 + betas[0], 1, 1 + betas[1])
    y = [generator.randrange(1, P) for _ in range(3)]
    c = sum(v * v for v in y) * HALF % P
    b = (betas[0] * y[0] ** 2 + betas[1] * y[2] ** 2) * HALF % P
    return (c, b, sum(betas) % P, betas[0] * betas[1] % P), modified(a, y)


def monomials(k, extra):
    """(c, b, f, g) exponents of degree k in c and b; in 1/I, c counts two and b one. No power of f
    exceeds that of b, or a needle would not be bounded: that these suffice is what is found."""
    for c in range(k, -1, -1):
        weight = 2 * c + (k - c) + extra
        for f in range(min(weight, k - c) + 1):
            for g in range((weight - f) // 2 + 1):
                yield (c, k - c, f, g)


def solve(rows):
    """The one solution of an overdetermined system, rows (coefficients..., right-hand side)."""
    unknowns = len(rows[0]) - 1
    for p in range(unknowns):   # what is left of the pivot is not looked at again
        pivot = next(i for i in range(p, len(rows)) if rows[i][p])
        rows[p], rows[pivot] = rows[pivot], rows[p]
        scale = inverse(rows[p][p])
        tail = [v * scale % P for v in rows[p][p:]]
        rows[p][p:] = tail
        for i in range(p + 1, len(rows)):
            t = rows[i][p]
            rows[i][p:] = [(u - t * v) % P for u, v in zip(rows[i][p:], tail)]
    assert not any(row[-1] for row in rows[unknowns:]), "the samples do not agree"
    solution = [0] * unknowns
    for p in range(unknowns - 1, -1, -1):
        solution[p] = (rows[p][-1] - sum(rows[p][j] * solution[j] for j in range(p + 1, unknowns))) % P
    return solution


def fraction(residue):
    """The small fraction that is `residue` modulo P (Wang 1981)."""
    u, v = (P, 0), (residue, 1)
    while v[0] >= 2**130:
        t = u[0] // v[0]
        u, v = v, (u[0] - t * v[0], u[1] - t * v[1])
    numerator, denominator = (v[0], v[1]) if v[1] > 0 else (-v[0], -v[1])
    assert math.gcd(numerator, denominator) == 1
    assert abs(numerator) < 2**63 and denominator < 2**63, "not the fraction meant, or beyond int64"
    return numerator, denominator


def derive():
    generator = random.Random(1991)
    most = max(len(list(monomials(DEGREE, extra))) for extra in (0, 1))
    seen = [sample(generator) for _ in range(most + SPARE)]
    tables = {"kScale": [], "kShift": []}
    for extra, name in enumerate(tables):
        for k in range(1, DEGREE + 1):
            basis = list(monomials(k, extra))
            rows = []
            for point, series in seen[:len(basis) + SPARE]:
                powers = [[1] for _ in point]
                for base, row in zip(point, powers):
                    for _ in range(3 * k):
                        row.append(row[-1] * base % P)
                rows.append([powers[0][e[0]] * powers[1][e[1]] % P
                             * (powers[2][e[2]] * powers[3][e[3]] % P) % P for e in basis]
                            + [series[extra][k - 1]])
            for exponents, value in zip(basis, solve(rows)):
                if value:
                    tables[name].append(exponents + fraction(value))
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
