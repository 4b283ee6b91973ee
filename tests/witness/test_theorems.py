"""The duality theorem and degenerate points, by an evaluation that shares no code with disting."""

import random
from fractions import Fraction
from itertools import permutations

import pytest
from flint import acb, ctx, fmpq
from hypothesis import given, settings, strategies as st

from disting import Chain, Family
from disting.fibres.synthesis.fibre import fibre
from disting.fibres.synthesis.task import Fibre, Solution, Status, target
from disting.fibres.synthesis.theorems import are_dual, dual
from disting.model.question import Answer
from tests.witness.mechanics import response

Point = dict[str, Fraction]


def at_gap(n: int, g: int, damped: bool) -> Chain:
    """Both ports on the two sides of the gap."""
    return Chain(n, g, g, g + 1, g, g + 1, damped=damped)


def random_point(chain: Chain, label: str) -> Point:
    """Fractions between 1/9 and 9, which need no common denominator."""
    draw = random.Random(f"{chain}:{label}")
    return {
        name: Fraction(draw.randint(100, 900), draw.randint(100, 900)) for name in chain.parameters
    }


def same_receptance(left: Chain, p: Point, right: Chain, q: Point) -> bool:
    """num/den of degree 2 N at most agree if they do at more than 4 N points; s > 0 is never a
    pole of a passive chain.
    """
    points = map(Fraction, range(1, 4 * left.n_masses + 2))
    return all(response(left, p, s) == response(right, q, s) for s in points)


def exact(point: Point) -> dict[str, fmpq]:
    return {name: fmpq(x.numerator, x.denominator) for name, x in point.items()}


def holds(solution: Solution, point: Point) -> bool:
    """Whether these fractions, much sharper than any ball, lie in the solution's balls."""
    with ctx.workprec(20_000):
        return all(solution.values[name].contains(acb(x)) for name, x in exact(point).items())


@pytest.mark.thin(8)
@pytest.mark.parametrize("damped", [False, True])
@pytest.mark.parametrize(("n", "g"), [(n, g) for n in range(2, 6) for g in range(n)] + [(8, 5)])
def test_dual_chains_have_one_receptance(n: int, g: int, damped: bool) -> None:
    left, right = at_gap(n, g, damped), at_gap(n, n - 1 - g, damped)
    point = random_point(left, "dual")
    image = dual(left, point)
    assert are_dual(left, right)
    assert tuple(image) == right.parameters
    assert all(isinstance(x, Fraction) and x > 0 for x in image.values())
    assert same_receptance(left, point, right, image)
    assert dual(right, image) == point


@pytest.mark.full
@settings(max_examples=15, deadline=None)
@given(st.data())
def test_duality_holds_for_every_instance(data: st.DataObject) -> None:
    n = data.draw(st.integers(1, 6))
    left = (
        at_gap(n, data.draw(st.integers(0, n - 1)), data.draw(st.booleans()))
        if n > 1
        else Chain(1, damped=False)
    )
    right = at_gap(n, n - 1 - left.gap, left.damped) if n > 1 else Chain(1, damped=False)
    positive = st.fractions(Fraction(1, 50), 50, max_denominator=50)
    point = {name: data.draw(positive, name) for name in left.parameters}
    image = dual(left, point)
    assert min(image.values()) > 0
    assert same_receptance(left, point, right, image)
    assert dual(right, image) == point


@pytest.mark.slow
@pytest.mark.parametrize("damped", [False, True])
@pytest.mark.parametrize(("n", "g"), [(n, g) for n in range(6, 9) for g in range(n)])
@pytest.mark.parametrize("label", ["a", "b", "c"])
def test_dual_chains_of_six_to_eight_masses(n: int, g: int, damped: bool, label: str) -> None:
    left, right = at_gap(n, g, damped), at_gap(n, n - 1 - g, damped)
    point = random_point(left, label)
    assert same_receptance(left, point, right, dual(left, point))
    assert dual(right, dual(left, point)) == point


def test_duality_needs_the_ports_at_the_gap() -> None:
    """The evaluation can tell: the dual's parameters in a chain with the force one mass further
    give something else.
    """
    left, other = at_gap(3, 0, True), Chain(3, 2, 1, 3, 2, 3, damped=True)
    point = random_point(left, "other")
    assert not are_dual(left, other)
    assert not same_receptance(left, point, other, dual(left, point))


@pytest.mark.parametrize(("n", "g"), [(3, 1), pytest.param(5, 2, marks=pytest.mark.slow)])
@pytest.mark.parametrize("label", ["a", "b", "c"])
def test_a_self_dual_chain_has_two_positive_parameter_vectors(n: int, g: int, label: str) -> None:
    """p0 and its dual, which differ."""
    chain = at_gap(n, g, True)
    point = random_point(chain, label)
    found = fibre(chain, target(chain.structure, exact(point)))
    positive = [s for s in found.solutions if s.positive is Answer.YES]
    assert found.status is Status.COMPLETE
    assert len(positive) == 2
    image = dual(chain, point)
    assert image != point
    for planted in (point, image):
        assert sum(holds(s, planted) for s in positive) == 1


def planted(chain: Chain, values: Point) -> Fibre:
    """The fibre over a chain's own receptance: p0 itself lies in it."""
    return fibre(chain, target(chain.structure, exact(values)))


SPECIAL = [
    Chain(3, damped=True),
    Chain(3, meas_plus=2, damped=True),
    Chain(3, meas_plus=3, damped=True),
    Chain(3, 0, 0, 2, 0, 2, damped=True),
    Chain(3, 1, 1, 2, 1, 2, damped=True),
    Chain(3, 1, 1, 2, 1, 3, damped=True),
    Chain(3, 2, 1, 3, 2, 3, damped=True),
    Chain(3, 2, 2, 3, 2, 3, damped=True),
    Chain(4, 2, 2, 3, 2, 3, damped=True),
    Chain(4, 2, 1, 3, 1, 3, damped=True),
]
UNDAMPED = [
    Chain(3, damped=False),
    Chain(3, 1, 1, 2, 1, 2, damped=False),
    Chain(3, 2, 2, 3, 2, 3, damped=False),
    Chain(4, 2, 1, 3, 2, 4, damped=False),
    Chain(4, 0, 0, 2, 0, 3, damped=False),
]


def is_right(chain: Chain, values: Point, found: Fibre) -> bool:
    """DEGENERATE and NOT_COVERED claim nothing; a family needs no special member; a complete
    list holds the planted one.
    """
    if found.status is Status.COMPLETE:
        return any(holds(s, values) for s in found.solutions)
    return found.status is not Status.EMPTY


@pytest.mark.thin(8)
@pytest.mark.parametrize("ratio", [Fraction(1), Fraction(1, 7)])
@pytest.mark.parametrize("chain", SPECIAL, ids=str)
def test_proportional_damping_is_never_empty(chain: Chain, ratio: Fraction) -> None:
    point = random_point(chain, "proportional")
    point |= {name: ratio * point[f"k{name[1:]}"] for name in chain.parameters if name[0] == "d"}
    assert is_right(chain, point, planted(chain, point))


@pytest.mark.thin(8)
@pytest.mark.parametrize("chain", SPECIAL + UNDAMPED, ids=str)
def test_equal_masses_are_never_empty(chain: Chain) -> None:
    point = random_point(chain, "equal")
    point |= {name: Fraction(2) for name in chain.parameters if name[0] == "m"}
    assert is_right(chain, point, planted(chain, point))


@pytest.mark.thin(8)
@pytest.mark.parametrize("chain", SPECIAL + UNDAMPED, ids=str)
def test_equal_elements_are_never_empty(chain: Chain) -> None:
    point = dict.fromkeys(chain.parameters, Fraction(1))
    assert is_right(chain, point, planted(chain, point))


@pytest.mark.full
@settings(max_examples=30, deadline=None)
@given(st.sampled_from(SPECIAL + UNDAMPED), st.data())
def test_small_whole_numbers_are_never_empty(chain: Chain, data: st.DataObject) -> None:
    point = {name: Fraction(data.draw(st.integers(1, 3), name)) for name in chain.parameters}
    assert is_right(chain, point, planted(chain, point))


@pytest.mark.slow
@pytest.mark.parametrize(
    "chain", [c for n in (2, 3, 4) for damped in (False, True) for c in Family(n, damped)], ids=str
)
def test_many_small_whole_numbers_are_never_empty(chain: Chain) -> None:
    draw = random.Random(str(chain))
    for _ in range(30 if chain.n_masses < 4 else 8):
        point = {name: Fraction(draw.randint(1, 3)) for name in chain.parameters}
        assert is_right(chain, point, planted(chain, point)), point


@pytest.mark.full
@pytest.mark.parametrize("n", [3, 4])
def test_collocated_undamped_chains_are_never_missed_at_equal_elements(n: int) -> None:
    """Foster: all of them realise each other's receptances, with positive elements, unless
    poles coincide or get lost.
    """
    collocated = [c for c in Family(n, damped=False) if c.collocated]
    statuses = set()
    for left, right in permutations(collocated, 2):
        found = fibre(
            right, target(left.structure, exact(dict.fromkeys(left.parameters, Fraction(1))))
        )
        statuses.add(found.status)
        assert all(s.positive is Answer.YES for s in found.solutions)
    assert statuses == {Status.COMPLETE, Status.DEGENERATE}


@pytest.mark.parametrize("damped", [False, True])
@pytest.mark.parametrize("g", range(3))
def test_a_special_model_of_the_dual_chain_is_never_missed(g: int, damped: bool) -> None:
    """Equal masses and equal ratios of the one are an exact equivalent in the other."""
    left, right = at_gap(3, g, damped), at_gap(3, 2 - g, damped)
    point = dict.fromkeys(left.parameters, Fraction(1))
    found = fibre(right, target(left.structure, exact(point)))
    assert is_right(right, dual(left, point), found)
