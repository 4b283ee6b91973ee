"""Both coefficient maps of a chain, against the transfer function written out in its parameters."""

from fractions import Fraction

import pytest
import sympy
from flint import fmpz_mpoly
from hypothesis import given, settings, strategies as st

from disting.algebra.symbols import symbols
from disting.errors import InputError
from disting.fibres.ideals import CoefficientMap, coefficient_map, normalise
from disting.fibres.ideals.system import match_maps
from disting.model.chain import Chain
from disting.model.family import Family


@st.composite
def chains(draw: st.DrawFn) -> Chain:
    n = draw(st.integers(1, 4))
    gap = draw(st.integers(0, n - 1))
    low, high = st.integers(min(1, gap), gap), st.integers(gap + 1, n)
    dampers = tuple(i for i in range(1, n + 1) if draw(st.booleans()))
    sensor = draw(st.sampled_from(["position", "velocity", "acceleration"]))
    ports = (draw(low), draw(high), draw(low), draw(high))
    flags = {"damped": draw(st.booleans()), "lag": draw(st.booleans())}
    return Chain(n, gap, *ports, quantity=sensor, ground_dampers=dampers, **flags)


def value(polynomial: fmpz_mpoly, values: dict[str, Fraction]) -> Fraction:
    names = polynomial.context().names()
    total = Fraction(0)
    for exponents, number in polynomial.to_dict().items():
        term = Fraction(int(number))
        for name, e in zip(names, exponents, strict=True):
            term *= values[name] ** int(e)
        total += term
    return total


def monic(
    model: CoefficientMap, values: dict[str, Fraction]
) -> tuple[list[Fraction], list[Fraction]]:
    num, den = (
        [value(p, values) for p in polynomials]
        for polynomials in (model.numerator, model.denominator)
    )
    return [b / den[-1] for b in num], [a / den[-1] for a in den]


def in_quotients(chain: Chain, p: dict[str, Fraction]) -> dict[str, Fraction]:
    """The unknowns of `normalise` as the text of its module defines them."""
    n = chain.n_masses
    mass = {i: p[f"m{i}"] for i in range(1, n + 1)}
    result = {f"r{i}": mass[i] / mass[i + 1] for i in range(1, n)} | {
        f"f{i}": p.get(f"b{i}", Fraction(0)) / mass[i] for i in mass
    }
    for i in range(n):
        result[f"u{i}"] = p.get(f"k{i}{i + 1}", Fraction(0)) / mass[max(i, 1)]
        result[f"e{i}"] = p.get(f"d{i}{i + 1}", Fraction(0)) / mass[max(i, 1)]
    delay = 1 / p["T1"] if chain.lag else Fraction(1)
    result[f"g{chain.gap + 1}"] = delay / mass[max(chain.act_plus, chain.meas_plus)]
    if chain.gap:
        result["g1"] = delay / mass[max(chain.act_minus, chain.meas_minus)]
    return result | {"lag": delay}


@pytest.mark.full
@given(chains(), st.randoms(use_true_random=False))
@settings(max_examples=60, deadline=None)
def test_normalised_is_the_same_transfer_function(chain, random):
    values = {
        name: Fraction(random.randint(1, 50), random.randint(1, 50)) for name in chain.parameters
    }
    plain, quotients = coefficient_map(chain.structure), normalise(chain.structure)
    assert monic(quotients, in_quotients(chain, values)) == monic(plain, values)


@given(chains())
@settings(max_examples=60, deadline=None)
def test_normalised_is_monic_linear_in_each_unknown_and_no_larger(chain):
    model = normalise(chain.structure)
    assert model.is_monic
    joints = [i for i, name in enumerate(model.parameters) if name[0] != "g"]
    assert all(
        e[i] <= 1
        for terms in model.coordinates[model.degrees[0] + 1 :]
        for e, _ in terms
        for i in joints
    )
    assert len(model.parameters) == len(chain.parameters)


@pytest.mark.full
def test_a_worked_example():
    s, m1, m2, k, d = sympy.symbols("s m1 m2 k12 d12")
    stiff = k + d * s
    matrix = sympy.Matrix([[m1 * s**2 + stiff, -stiff], [-stiff, m2 * s**2 + stiff]])
    expected = sympy.cancel(s**2 * matrix.inv()[0, 0])
    model = coefficient_map(Chain(2, damped=True).structure)
    num, den = (
        sum(sympy.sympify(str(c)) * s**i for i, c in enumerate(part))
        for part in (model.numerator, model.denominator)
    )
    assert sympy.simplify(num / den - expected) == 0


def test_bad_maps_are_refused():
    x, y = symbols(["x", "y"]).values()
    with pytest.raises(InputError, match="exactly its parameters"):
        CoefficientMap(("x",), (x,), (y,))
    with pytest.raises(InputError, match="not zero"):
        CoefficientMap(("x", "y"), (x,), (y, x - x))


def test_maps_of_unequally_many_poles_are_not_compared():
    a, b = (
        normalise(Family(2, damped=False)[1].structure),
        normalise(Family(3, damped=False)[1].structure),
    )
    with pytest.raises(InputError, match="equally many poles"):
        match_maps(a, b)


def test_a_shorter_numerator_is_compared_with_zeros():
    a, b = (normalise(Family(2, damped=False)[i].structure) for i in (1, 2))
    assert a.degrees[0] < b.degrees[0] or a.degrees[0] > b.degrees[0]
    one, other = match_maps(a, b)
    short, long = (one, other) if a.degrees[0] < b.degrees[0] else (other, one)
    top = max(a.degrees[0], b.degrees[0])
    assert len(short.coordinates) == len(long.coordinates)
    assert short.coordinates[top] == () != long.coordinates[top]
    assert short.degrees == min(a.degrees, b.degrees)


def test_the_scale_makes_functions_comparable():
    x, y = symbols(["x", "y"]).values()
    model = CoefficientMap(("x", "y"), (x,), (x**0, y)).with_scale()
    assert [str(p) for p in (*model.numerator, *model.denominator)] == [
        "x*scale",
        "scale",
        "y*scale",
    ]
