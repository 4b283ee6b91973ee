"""Force on an end mass, sensor on the next one: models of the row, what is none, and what is known
to be a limit.
"""

from itertools import islice

import pytest

from disting import Family, catalog
from disting.algebra.certainty import prime, residues
from disting.algebra.determinants import polynomial
from disting.decide.inclusion.closures import of_closure
from disting.decide.inclusion.row_neighbours import _has_no_common_root, are_no_limits
from disting.fibres.ideals import normalise
from disting.fibres.ideals.fibre_ideal import evaluate
from disting.fibres.ideals.system import terms
from disting.model.row import Row

DRAWS = 60


def points(structure, name):
    """Receptances of a row at random points modulo primes."""
    model = normalise(structure)
    for k in range(DRAWS):
        modulus = prime(f"{name}:{k}")
        point = residues(f"{name}:{k}:p", len(model.parameters), modulus)
        num, den = (
            [evaluate(terms(c), point, modulus) for c in side]
            for side in (model.numerator, model.denominator)
        )
        yield num, den, modulus


@pytest.mark.parametrize("n", [4, 5])
def test_other_functions_of_the_same_degrees_are_no_limits(n):
    """Also of a numerator that is 0 at 0, or without its highest coefficient, nothing is said."""
    row = Row(n, False, 1, 2, True)
    drawn = []
    for k in range(DRAWS):
        modulus = prime(f"free:{k}")
        num = residues(f"free:{k}:b", 2 * n - 2, modulus)
        den = [0, 0, *residues(f"free:{k}:a", 2 * n - 1, modulus)]
        den[3] = den[2] * num[1] * pow(num[0], -1, modulus) % modulus  # momentum is kept
        drawn.append((num, den, modulus))
    assert are_no_limits(row, drawn)
    assert are_no_limits(Row(n, False, n - 1, n, True), drawn)
    assert not are_no_limits(Row(n, False, 2, 3, True), drawn)
    assert not are_no_limits(Row(n, True, 1, 2, True), drawn)
    assert not are_no_limits(row, [([*num[:-1], 0], den, p) for num, den, p in drawn])
    assert not are_no_limits(row, [([0, *num[1:]], den, p) for num, den, p in drawn])


@pytest.mark.full
@pytest.mark.parametrize("n", [4, 5, 6])
def test_its_own_functions_fulfil_it_at_the_root_of_the_joint_alone(n):
    row = Row(n, False, 1, 2, True)
    assert not are_no_limits(row, points(row.structure, f"own {n}"))
    for num, den, modulus in islice(points(row.structure, f"own {n}"), 3):
        numerator, energy = polynomial(num, modulus), polynomial(den[2:], modulus)
        factors = [f for f, _ in numerator.factor()[1] if f.degree() == 1]
        roots = [-int(f[0]) * pow(int(f[1]), -1, modulus) for f in factors]
        apart = [_has_no_common_root(numerator, energy, t % modulus) for t in roots]
        assert apart.count(False) == 1


@pytest.mark.full
@pytest.mark.parametrize("n", [4, 5])
def test_what_is_known_to_be_a_limit_is_refuted_by_no_equation(n):
    stored = catalog(n, damped=True)
    told = [
        (left, right) if v.closure.value == "left-in-right" else (right, left)
        for left, right, v in stored.pairs()
        if v.closure.value in ("left-in-right", "right-in-left")
    ]
    family = Family(n, damped=True)
    refuted = [
        (small, large)
        for small, large in told
        for found in [of_closure(family[small], family[large], "limits")]
        if found is not None and type(found[0]).__name__ == "Outside"
    ]
    assert len(told) > 10 and not refuted


@pytest.mark.full
@pytest.mark.parametrize(("n", "large", "small"), [(4, 2, [16, 18]), (5, 2, [25, 32, 47])])
def test_limits_of_chains_with_neighbours_at_the_end(n, large, small):
    family = Family(n, damped=True)
    for k in small:
        evidence, bits = of_closure(family[k], family[large], "neighbours")
        assert bits == 0 and [step.why.value for step in evidence.steps] == ["resultant"]
