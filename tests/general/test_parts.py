"""Parts of networks that tell of the whole: which there are, against ranks by SymPy; what they tell,
checked anew and against twins found by plain numbers.
"""

import random
from dataclasses import replace
from itertools import combinations

import pytest
import sympy

from disting.conditions.rule import ADMISSIBLE, Finding, Outcome
from disting.evidence.decision import Theorem
from disting.evidence.general import OfPart
from disting.general.any_model import of_network
from disting.general.forms import by_parts, confirms_forms, over_positive
from disting.general.orthant import BRIEF
from disting.general.parts import parts_of, without
from disting.model.question import Domain, Relation, Settings
from disting.network.notation import network_of

pytestmark = pytest.mark.full

WHOLE = "1>2, 2>1, 2>3, 3>2, 1>0, 2>0; in 1; out 1"
PAIR = (
    "1>0, 1>2, 1>3, 2>0, 2>3, 3>1; in 3; out 2",
    "1>0, 1>2, 1>3, 2>1, 2>3, 3>1; in 3; out 2",
)


def jacobian_rank(text, missing):
    """The rank of the coefficients of a graph of compartments without these flows, and how many
    vary, by SymPy.
    """
    flows, enter, leave = text.split("; ")
    pairs = [tuple(map(int, f.split(">"))) for f in flows.split(", ")]
    names = {sympy.Symbol(f"a{i}{j}"): (i, j) for i, j in pairs if f"a{i}{j}" not in missing}
    n, s = max(i for i, _ in pairs), sympy.Symbol("s")
    matrix = sympy.zeros(n, n)
    for name, (i, j) in names.items():
        matrix[i - 1, i - 1] += name
        if j:
            matrix[j - 1, i - 1] -= name
    matrix += s * sympy.eye(n)
    i, j = int(enter.split()[1]) - 1, int(leave.split()[1]) - 1
    sides = sympy.expand(matrix.cofactor(i, j)), sympy.expand(matrix.det())
    found = [c for side in sides for c in sympy.Poly(side, s).all_coeffs() if c.free_symbols]
    degrees = [sympy.degree(side, s) for side in sides]
    rows = sympy.Matrix(found).jacobian(sympy.Matrix(list(names)))
    draw = random.Random(1)
    return rows.subs({x: draw.randint(1, 99) for x in names}).rank(), len(found), degrees


@pytest.mark.parametrize("text", [WHOLE, pytest.param(PAIR[0], marks=pytest.mark.slow)])
def test_parts_are_those_with_all_coefficients_independent(text):
    whole = of_network(network_of(text))
    rank, count, degrees = jacobian_rank(text, ())
    assert rank == count
    expected = {
        missing
        for size in range(1, len(whole.parameters))
        for missing in combinations(sorted(whole.parameters), size)
        if is_part(text, missing, (count, count, degrees))
    }
    assert {tuple(sorted(missing)) for missing, _ in parts_of(whole)} == expected
    for missing, part in parts_of(whole):
        assert {*part.parameters} == {*whole.parameters} - {*missing}


def is_part(text, missing, wanted):
    try:
        return jacobian_rank(text, missing) == wanted
    except (ValueError, sympy.PolynomialError):  # nothing varies, or nothing moves
        return False


@pytest.mark.parametrize("text", ["R1-p(R2,P1)", "1>2; in 1; out 2", "1~2; F1; S2:1"])
def test_without_spare_elements_there_is_none(text):
    assert not list(parts_of(of_network(network_of(text))))


def test_what_is_no_part_is_refused():
    whole = of_network(network_of(WHOLE))
    assert without(whole, ("a20",)) is not None
    for missing in (("a12",), ("a10", "a20"), ("b1",)):
        assert without(whole, missing) is None


@pytest.fixture(scope="module")
def told():
    """A pair, and what parts tell of it."""
    left, right = (of_network(network_of(text)) for text in PAIR)
    return left, right, by_parts(left, right, Settings())


@pytest.mark.slow
def test_parts_tell_what_a_search_does_not(told):
    left, right, found = told
    assert over_positive(left, right, Settings(), BRIEF).outcome is Outcome.ABANDONED
    evidence = found.evidence
    assert found.outcome is Outcome.SOMETIMES and isinstance(evidence, OfPart)
    assert evidence.shows(Domain.POSITIVE) is Relation.SOMETIMES
    assert evidence.shows(Domain.REAL) is Relation.UNDECIDED
    assert confirms_forms(evidence, left, right, "tf")
    assert confirms_forms(evidence.turned, right, left, "tf")
    assert Finding.from_json(found.to_json(), rule=ADMISSIBLE) == found
    assert f"without {evidence.missing[0]}" in evidence.sentence("A", "B")


def test_its_evidence_is_checked(told):
    left, right, found = told
    evidence = found.evidence
    assert not confirms_forms(replace(evidence, missing=()), left, right, "tf")
    assert not confirms_forms(replace(evidence, missing=("a99",)), left, right, "tf")
    turned = replace(evidence, left_is_part=not evidence.left_is_part)
    theorem = replace(evidence, inner=Theorem("replacement"))
    for other in (turned, theorem):  # these say nothing of the whole
        assert other.shows(Domain.POSITIVE) is Relation.UNDECIDED
