"""Positive values of one network that give the response of another one, by plain least squares from
many starts on the coefficients of the transfer functions; what is found is put into Kirchhoff's and
Newton's laws of both.
"""

import numpy as np
from scipy.optimize import least_squares

from disting.general.any_model import of_network
from tests.oracles.plain_network import equations

STARTS = 200
SPREADS = (0.5, 1.0, 1.5)  # of the logarithms of values from which searches start, in turn
FREQUENCIES = (0.31, 0.77, 1.3, 2.9, 7.1)
CLOSE = 1e-9
FARTHEST = 30.0  # logarithm of a value: farther away it runs to zero or infinity


def twin(given, other, draw, starts=STARTS):
    """Values of `given` and of `other` with one response; no second ones if none are found."""
    one, there = of_network(given), of_network(other)
    if _shape(one) != _shape(there):
        return None, None
    mine = [draw.uniform(0.5, 2) for _ in one.parameters]
    goal = _coefficients(one, np.array(mine))
    if len(goal) == 0:
        return mine, [1.0] * len(there.parameters)

    for theirs in solutions(there, goal, draw, starts):
        if respond_alike(given, mine, other, theirs):
            return mine, theirs
    return mine, None


def signs(network, draw, starts=STARTS):
    """Signs of the determinants of coefficients and values at all values with the response of
    random ones that many starts find.
    """
    model, found = of_network(network), list[np.ndarray]()
    goal = _coefficients(model, np.array([draw.uniform(0.5, 2) for _ in model.parameters]))
    for values in solutions(model, goal, draw, starts):
        if not any(np.allclose(values, other, rtol=1e-5) for other in found):
            found.append(np.array(values))
    return [int(np.sign(np.linalg.det(_jacobian(model, values)))) for values in found]


def solutions(model, goal, draw, starts):
    """Yield positive values with these coefficients, as searches from many starts end in them."""

    def residual(logs):
        return _coefficients(model, _values(logs)) / goal - 1

    def slopes(logs):
        return _jacobian(model, _values(logs)) / goal[:, None]

    for k in range(starts):
        far = SPREADS[k % len(SPREADS)]
        start = np.array([draw.uniform(-far, far) for _ in model.parameters])
        found = least_squares(
            residual, start, slopes, xtol=1e-15, ftol=1e-15, gtol=1e-15, max_nfev=1000
        )
        if np.max(np.abs(found.fun)) < CLOSE / 100 and np.max(np.abs(found.x)) < FARTHEST:
            yield list(_values(found.x))


def respond_alike(given, mine, other, theirs):
    """Whether both responses are the same at some frequencies, by the laws alone."""
    for omega in FREQUENCIES:
        x, y = (_response(n, v, 1j * omega) for n, v in ((given, mine), (other, theirs)))
        if abs(x - y) > CLOSE * max(abs(x), abs(y)):
            return False
    return True


def _response(network, values, s):
    at = dict(zip(network.parameters, values, strict=True))
    sides = equations(network, at.__getitem__, s, np.sqrt(s))
    a, b, c = (np.array(side, dtype=complex) for side in sides)
    return complex((c @ np.linalg.solve(a, b.T))[0, 0] * s**network.order)


def _values(logs):
    """Values that no power of which is too large for a number of 64 bits."""
    return np.exp(np.clip(logs, -FARTHEST, FARTHEST))


def _shape(model):
    """Which coefficients are there."""
    sides = model.numerator_terms, model.denominator_terms
    return model.powers.halves, *(tuple(map(bool, side)) for side in sides)


def _every(model):
    return [t for side in (model.numerator_terms, model.denominator_terms) for t in side if t]


def _coefficients(model, values):
    """Those that are there, over the leading one."""
    every = [sum(c * np.prod(values ** np.array(e)) for e, c in terms) for terms in _every(model)]
    return np.array(every[:-1]) / every[-1]


def _jacobian(model, values):
    """Derivatives of these by the logarithms of the values."""
    parts, slopes = [], []
    for terms in _every(model):
        each = [(c * np.prod(values ** np.array(e)), np.array(e)) for e, c in terms]
        parts.append(sum(x for x, _ in each))
        slopes.append(sum(x * e for x, e in each))
    lead, along = parts[-1], slopes[-1]
    rows = [(g * lead - x * along) / lead**2 for x, g in zip(parts[:-1], slopes[:-1], strict=True)]
    return np.array(rows)
