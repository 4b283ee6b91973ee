"""Positive values of one model with the transfer function of another one, to 60 digits: a start by
plain least squares, then Newton's method in long numbers on as many equations as are independent
and as many unknowns, the others being fixed. It knows of no theorem: only coefficients.
"""

import numpy as np
from flint import arb, arb_mat, ctx, fmpq
from scipy.linalg import qr
from scipy.optimize import least_squares

STARTS = 200
SPREADS = (
    0.5,
    1.0,
    1.5,
    2.0,
    3.0,
)  # of the logarithms of values from which searches start, in turn
BITS = 256
STEPS = 12
CLOSE = 1e-4
DIGITS = arb(10) ** -60
FARTHEST = 30.0  # logarithm of a value: farther away it runs to zero or infinity
SMALL = 1e-12  # singular values, relative


def construct(given, other, draw, starts=STARTS):
    """Values of `other`, with 60 digits, that give the function of drawn values of `given`."""
    rows, there = _rows(given), _rows(other)
    if [bool(t) for t in rows] != [bool(t) for t in there]:
        return None
    mine = [fmpq(draw.randint(30, 200), 100) for _ in given.parameters]
    with ctx.workprec(BITS):
        exact = _ratios(_values(rows, list(map(arb, mine))))
        goal = np.array([float(x) for x in exact])
        for k in range(starts):
            start = _start(there, len(other.parameters), goal, draw, SPREADS[k % len(SPREADS)])
            found = None if start is None else _polished(there, start, exact)
            if found is not None:
                return found
    return None


def _rows(model):
    sides = model.numerator_terms, model.denominator_terms
    return [[(e, int(c)) for e, c in terms] for side in sides for terms in side]


def _start(rows, count, goal, draw, spread):
    terms = [(i, e, float(c)) for i, row in enumerate(t for t in rows if t) for e, c in row]
    places, numbers = np.array([i for i, _, _ in terms]), np.array([c for _, _, c in terms])
    powers = np.array([e for _, e, _ in terms], float)
    n_rows = places[-1] + 1

    def both(logs):
        each = numbers * np.exp(np.clip(powers @ logs, -300, 300))
        totals, slopes = np.bincount(places, each, n_rows), np.zeros((n_rows, count))
        np.add.at(slopes, places, each[:, None] * powers)
        found = totals[:-1] / totals[-1]
        by = slopes[:-1] / totals[-1] - found[:, None] * slopes[-1] / totals[-1]
        return found / goal - 1, by / goal[:, None]

    first = np.array([draw.uniform(-spread, spread) for _ in range(count)])
    tight = {"xtol": 1e-15, "ftol": 1e-15, "gtol": 1e-15, "max_nfev": 1000}
    found = least_squares(lambda x: both(x)[0], first, lambda x: both(x)[1], **tight)
    if np.max(np.abs(found.fun)) > CLOSE or np.max(np.abs(found.x)) > FARTHEST:
        return None
    table = both(found.x)[1]
    equations = _independent(table.T)
    return np.exp(found.x), equations, _independent(table[equations], len(equations))


def _independent(table, count=None):
    """So many columns that are independent; all that span the rest, as far as rounded numbers tell."""
    _, upper, order = qr(table, mode="economic", pivoting=True)
    sizes = np.abs(np.diag(upper))
    rank = int(np.sum(sizes > SMALL * sizes[0])) if count is None else count
    return sorted(int(i) for i in order[:rank])


def _polished(rows, start, exact):
    """Values at which all equations hold to 60 digits, or None."""
    first, equations, unknowns = start
    values = [arb(float(x)) for x in first]
    kept = [row for row in rows if row]
    for _ in range(STEPS):
        totals = _values(rows, values)
        errors = [a / b - 1 for a, b in zip(_ratios(totals), exact, strict=True)]
        if max(map(abs, errors), key=lambda x: float(x)) < DIGITS:
            return values if all(x > 0 for x in values) else None
        slopes = [[_slope(row, values, j) for j in unknowns] for row in kept]
        table = [
            [
                (slopes[i][k] - slopes[-1][k] * totals[i] / totals[-1]) / totals[-1] / exact[i]
                for k in range(len(unknowns))
            ]
            for i in equations
        ]
        try:
            step = arb_mat(table).solve(arb_mat([[errors[i]] for i in equations]))
        except ZeroDivisionError:
            return None
        for k, j in enumerate(unknowns):
            values[j] = (values[j] - step[k, 0]).mid()
    return None


def _values(rows, values):
    return [sum((_term(t, values) for t in row), arb(0)) for row in rows if row]


def _term(term, values):
    exponents, number = term
    total = arb(number)
    for x, e in zip(values, exponents, strict=True):
        if e:
            total *= x ** int(e)
    return total


def _slope(row, values, at):
    found = (_term((e, c), values) * int(e[at]) / values[at] for e, c in row if e[at])
    return sum(found, arb(0))


def _ratios(totals):
    return [x / totals[-1] for x in totals[:-1]]
