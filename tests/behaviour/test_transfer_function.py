"""G(s) of a chain as a SymPy expression: against complex numbers, against a plain determinant,
and as a general model.
"""

from random import Random

import numpy as np
import pytest
import sympy
from hypothesis import given, settings, strategies as st

from disting import Chain, Family, Model, transfer_function
from tests.laws.strategies import chains

S = sympy.Symbol("s")


def motion(chain, values, s, zero):
    """Dynamic stiffness of all masses, force, and sensor, from the definition: element by
    element, with a ground node.
    """
    n = chain.n_masses
    matrix = [[zero for _ in range(n + 1)] for _ in range(n + 1)]
    for i in range(1, n + 1):
        friction = values.get(f"b{i}", 0)
        matrix[i][i] += values[f"m{i}"] * s**2 + friction * s
    for i in range(n):
        if i == chain.gap:
            continue
        law = values[f"k{i}{i + 1}"] + values.get(f"d{i}{i + 1}", 0) * s
        for a, b, sign in ((i, i, 1), (i + 1, i + 1, 1), (i, i + 1, -1), (i + 1, i, -1)):
            matrix[a][b] += sign * law
    force, sensor = (
        [int(i == plus) - int(i == minus) for i in range(1, n + 1)]
        for plus, minus in ((chain.act_plus, chain.act_minus), (chain.meas_plus, chain.meas_minus))
    )
    return [row[1:] for row in matrix[1:]], force, sensor


@pytest.mark.full
@settings(max_examples=25, deadline=None)
@given(chains(max_masses=3, dead_time=True), st.integers(0, 10**6))
def test_at_random_numbers(chain, seed):
    draw = Random(seed)
    values = {name: draw.uniform(0.5, 2.0) for name in chain.parameters}
    s = complex(draw.uniform(0.1, 1.0), draw.uniform(0.1, 1.0))
    matrix, force, sensor = motion(chain, values, s, 0j)
    expected = (
        s**chain.sensor.order
        * np.array(sensor)
        @ np.linalg.solve(np.array(matrix), np.array(force, dtype=complex))
    )
    expected *= np.exp(-s * values.get("Td", 0.0)) / (1 + s * values.get("T1", 0.0))
    found = transfer_function(chain)
    assert found.free_symbols <= {
        S,
        *(sympy.Symbol(name, positive=True) for name in chain.parameters),
    }
    numbers = {sympy.Symbol(name, positive=True): value for name, value in values.items()}
    assert complex(found.subs(numbers).subs(S, s)) == pytest.approx(expected, rel=1e-9)


@pytest.mark.thin(2)
@pytest.mark.parametrize(
    "chain",
    [
        *Family(2, damped=False),
        *Family(2, damped=True),
        *Family(3, damped=False),
        Chain(2, ground_dampers=(1, 2), lag=True, sensor="velocity", damped=False),
    ],
    ids=str,
)
def test_by_cramers_rule(chain):
    """Exactly: two determinants, written out."""
    values = {name: sympy.Symbol(name, positive=True) for name in chain.parameters}
    matrix, force, sensor = motion(chain, values, S, sympy.Integer(0))
    whole = sympy.Matrix(
        [[*row, -f] for row, f in zip(matrix, force, strict=True)] + [[*sensor, 0]]
    )
    expected = (
        S**chain.sensor.order
        * whole.det()
        / sympy.Matrix(matrix).det()
        / (1 + S * values.get("T1", 0))
    )
    assert sympy.cancel(transfer_function(chain) - expected) == 0


def test_lag_and_dead_time():
    m1, t1, td = sympy.symbols("m1 T1 Td", positive=True)
    chain = Chain(1, lag=True, dead_time=True, damped=False)
    assert sympy.simplify(transfer_function(chain) - sympy.exp(-S * td) / (m1 * (1 + t1 * S))) == 0


@pytest.mark.parametrize(
    "chain",
    [*Family(3, damped=True), Chain(2, ground_dampers=(1,), lag=True, damped=False)],
    ids=str,
)
def test_read_again_it_is_the_model_of_the_chain(chain):
    assert Model.from_transfer_function(transfer_function(chain)) == Model.from_chain(chain)
