"""Dimensions that add up: the numbers by hand and by SymPy, and models that come as near as one
likes.
"""

import numpy as np
import pytest
import sympy as sp
from scipy.optimize import least_squares

from disting import Chain, Family
from disting.behaviour.chain_model import degrees, powers
from disting.decide.inclusion.limits import Room, room
from disting.model.chain import Quantity

POINTS = np.exp(np.linspace(-1, 1, 14) + 1j * (np.linspace(0.7, 21, 14) % 3.1))

NEAR = 1e-4


def response(chain, values):
    """Acceleration by force at complex frequencies, from the equation of motion."""
    v, n = dict(zip(chain.parameters, values, strict=True)), chain.n_masses
    act, meas = np.zeros(n), np.zeros(n)
    for vector, plus, minus in (
        (act, chain.act_plus, chain.act_minus),
        (meas, chain.meas_plus, chain.meas_minus),
    ):
        vector[plus - 1] += 1
        if minus:
            vector[minus - 1] -= 1
    found = []
    for s in POINTS:
        a = np.diag([v[f"m{i}"] * s * s for i in range(1, n + 1)]).astype(complex)
        for i in range(n):
            w = v.get(f"k{i}{i + 1}", 0) + v.get(f"d{i}{i + 1}", 0) * s
            a[i, i] += w
            if i:
                a[i - 1, i - 1] += w
                a[i - 1, i] -= w
                a[i, i - 1] -= w
        found.append(s * s * (meas @ np.linalg.solve(a, act)))
    return np.array(found)


def nearest(small, large, tries=4):
    """Relative distance of complex models of the larger kind to one of the smaller kind: the
    first small one found.
    """
    rng, k = np.random.default_rng(0), len(large.parameters)
    wanted = response(small, rng.uniform(0.5, 2, len(small.parameters)))
    reach = np.concatenate([np.full(k, 12.0), np.full(k, 60.0)])

    def distance(x):
        found = (response(large, np.exp(x[:k] + 1j * x[k:])) - wanted) / abs(wanted)
        return np.concatenate([found.real, found.imag])

    starts = (np.concatenate([rng.normal(0, 0.5, k), rng.uniform(-3, 3, k)]) for _ in range(tries))
    found = (least_squares(distance, x, max_nfev=200, bounds=(-reach, reach)).fun for x in starts)
    distances = [9.0]
    while distances[-1] > NEAR and (last := next(found, None)) is not None:
        distances.append(abs(last).max())
    return min(distances)


@pytest.mark.parametrize(
    ("small", "large", "damped", "expected"),
    [
        # 2:1 in 3:3: n and d fit without a common factor; masses are equal
        (1, 3, True, Room(6, 8, 1, True)),
        (1, 7, True, Room(6, 10, 3, True)),
        (1, 7, False, Room(4, 6, 2, False)),
        (2, 1, False, Room(5, 6, 2, False)),
        (1, 3, False, Room(3, 4, 0, False)),  # more zeros than the larger model has
    ],
)
def test_numbers_by_hand(small, large, damped, expected):
    found = room(Family(2, damped)[small].structure, Family(3, damped)[large].structure)
    assert found == expected and found.suffices == (expected.factors > 0)


def test_the_inequality():
    assert Room(6, 8, 2, False).suffices and Room(6, 8, 1, True).suffices
    assert not Room(6, 8, 1, False).suffices and not Room(8, 8, 0, True).suffices


@pytest.mark.full
@pytest.mark.parametrize(
    "chain",
    [
        Chain(3, 1, 1, 2, 1, 3, damped=True),
        Chain(2, meas_plus=2, damped=False),
        Chain(2, ground_dampers=(1,), damped=False),
    ],
)
def test_powers_and_rank_against_sympy(chain):
    num, den = symbolic(chain)
    assert tuple(frozenset(m[0] for m in p.monoms()) for p in (num, den)) == powers(chain.structure)
    assert degrees(chain.structure) == (num.degree(), den.degree())
    coefficients = [sp.expand(c / den.LC()) for p in (num, den) for c in p.all_coeffs()]
    jacobian = sp.Matrix(coefficients).jacobian(sp.symbols(chain.parameters))
    at = {sp.Symbol(name): sp.Rational(3 + i * i, 1 + i) for i, name in enumerate(chain.parameters)}
    assert room(chain.structure, chain.structure).rank == jacobian.subs(at).rank()


def symbolic(chain):
    """Numerator and denominator of the acceleration, in lowest terms, as polynomials in s."""
    s, n = sp.Symbol("s"), chain.n_masses
    p = {name: sp.Symbol(name) for name in chain.parameters}
    a = sp.zeros(n, n)
    for i in range(1, n + 1):
        a[i - 1, i - 1] += p[f"m{i}"] * s**2 + p.get(f"b{i}", 0) * s
    for i in range(1, n):
        w = p.get(f"k{i}{i + 1}", 0) + p.get(f"d{i}{i + 1}", 0) * s
        a[i, i] += w
        a[i - 1, i - 1] += w
        a[i, i - 1] -= w
        a[i - 1, i] -= w
    if chain.gap:
        a[0, 0] += p["k01"] + p.get("d01", 0) * s
    act, meas = sp.zeros(n, 1), sp.zeros(1, n)
    for vector, plus, minus in (
        (act, chain.act_plus, chain.act_minus),
        (meas, chain.meas_plus, chain.meas_minus),
    ):
        vector[plus - 1] += 1
        if minus:
            vector[minus - 1] -= 1
    quotient = sp.fraction(
        sp.cancel(s**2 * (meas * a.adjugate() * act)[0] / a.det(method="berkowitz"))
    )
    return tuple(sp.Poly(part, s) for part in quotient)


@pytest.mark.full
@pytest.mark.parametrize(
    "chain",
    [
        Chain(3, damped=True),
        Chain(2, 1, 1, 2, 1, 2, damped=True),
        Chain(2, meas_plus=2, damped=True),
    ],
)
def test_the_mass_is_in_two_pairs_of_coefficients(chain):
    num, den = (p.all_coeffs()[::-1] for p in symbolic(chain))
    assert sp.expand(num[0] * den[1] - num[1] * den[0]) == 0


@pytest.mark.parametrize(
    ("small", "large"),
    [
        (Chain(2, damped=True), Chain(3, meas_plus=3, damped=True, ground_dampers=(1,))),
        (Chain(2, damped=True), Chain(3, meas_plus=3, damped=True, lag=True)),
        (Chain(2, damped=True, ground_dampers=(2,)), Chain(3, damped=True)),
    ],
)
def test_dampers_to_the_ground_and_a_lag_hide_the_mass(small, large):
    assert not room(small.structure, large.structure).same_mass


@pytest.mark.parametrize("sensor", list(Quantity))
def test_every_sensor_counts_alike(sensor):
    chains = [
        Chain(2, damped=True, quantity=sensor),
        Chain(3, 1, 1, 2, 1, 3, quantity=sensor, damped=True),
    ]
    assert room(*(c.structure for c in chains)) == Room(6, 10, 3, True)


@pytest.mark.full
@pytest.mark.parametrize(
    ("small", "large", "damped"),
    [
        (1, 7, False),
        (1, 7, True),
        *(
            pytest.param(*x, marks=pytest.mark.slow)
            for x in ((2, 11, False), (1, 9, False), (3, 4, True), (2, 6, True))
        ),
    ],
)
def test_models_come_near_where_dimensions_add_up(small, large, damped):
    """A search over complex parameters, which knows nothing of dimensions, finds models that
    are nearly the same.
    """
    chains = Family(2, damped)[small], Family(3, damped)[large]
    assert room(*(c.structure for c in chains)).suffices
    assert nearest(*chains) < NEAR


@pytest.mark.full
def test_models_do_not_come_near_where_zeros_are_missing():
    assert nearest(Family(2, damped=False)[1], Family(3, damped=False)[3], tries=2) > 0.1
