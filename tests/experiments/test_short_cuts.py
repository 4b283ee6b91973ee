"""What spares the dear decisions of what to measure next, against plain SymPy, against Gröbner
bases modulo a prime by other code, and against the ideals that it spares.
"""

from itertools import combinations, product

import pytest
from sympy import Rational

from disting import Chain, Experiment, Family, Settings
from disting.algebra.certainty import LEAST_SAFETY
from disting.catalogs.next_files import SHIPPED_SIZES, next_catalog
from disting.evidence.ideals import Refutation, Solutions
from disting.experiments.equal_machines import same_by_rows, standard
from disting.experiments.exact import LIMITS, by_ideals, by_parts
from disting.experiments.experiment import MeasuredChain
from disting.experiments.listing import by_list
from disting.experiments.maps import match_maps
from disting.experiments.menu import Costs, Item, measure_with
from disting.model.kinds import FORCE, INERTIA, KINDS, LOCK, SENSOR
from disting.verdict.result import Relation
from tests.experiments.plain_stack import keywords, transfer
from tests.experiments.test_truth import SAME

AS_IT_IS, U, A = Experiment(), Family(3, damped=False), Family(3, damped=True)
INERTIAS = [
    (pair, i, j, f"{i}/{j}" in SAME[pair][2].split())
    for pair in ((2, 5), (9, 10))
    for i, j in product((1, 2, 3), repeat=2)
]


def shows_the_same(one, other, values, there):
    for a, b in zip(one.experiments, other.experiments, strict=True):
        n1, d1 = transfer(one.chain, values, **keywords(a))
        n2, d2 = transfer(other.chain, there, **keywords(b))
        if (n1 * d2 - n2 * d1).expand() != 0:
            return False
    return True


def reflected(chain, values):
    """The values of the same machine whose free row is numbered from its other end."""

    def fold(i):
        return chain.gap + 1 + chain.n_masses - i if i > chain.gap else i

    def name(p):
        if p[0] == "m":
            return f"m{fold(int(p[1:]))}"
        a, b = sorted((fold(int(p[1])), fold(int(p[2]))))
        return f"{p[0]}{a}{b}"

    return {name(p) if int(p[1]) > chain.gap else p: x for p, x in values.items()}


@pytest.mark.full
@pytest.mark.sampled(7)
@pytest.mark.parametrize(("number", "kind"), list(product((2, 4, 5, 8, 9, 10), KINDS)))
def test_the_standard_form_shows_the_same(number, kind):
    chain = U[number]
    values = {p: Rational(7 * k + 3, 5 + k) for k, p in enumerate(chain.parameters)}
    for at in (1, 2, 3):
        given = measure_with(chain, Item(kind, at))
        form = standard(given)
        ways = (values, reflected(chain, values))
        assert any(shows_the_same(given, form, values, there) for there in ways)
        assert standard(form) == form


def test_a_force_moved_is_a_sensor_moved_in_the_exchanged_machine():
    there = standard(measure_with(A[2], Item(FORCE, 3)))
    assert there == standard(measure_with(A[5], Item(SENSOR, 1)))
    assert [e.force for e in there.experiments] == [None, None]
    assert standard(measure_with(A[2], Item(FORCE, 2))) != there


def test_reciprocity_of_one_row_alone_is_none_of_the_machine():
    """Force and sensor exchanged in the grounded row only: another sensor beside tells them."""
    one, other = (Chain(3, 2, a, 3, b, 3, damped=False) for a, b in ((1, 2), (2, 1)))
    pair = [MeasuredChain(c, (AS_IT_IS, Experiment(sensor=1))) for c in (one, other)]
    assert standard(pair[0]) != standard(pair[1])


def spots(numbers, kind):
    for a, b in combinations(numbers, 2):
        for i, j in product((1, 2, 3), repeat=2):
            yield (a, i), (b, j), [measure_with(U[m], Item(kind, at)) for m, at in ((a, i), (b, j))]


@pytest.mark.full
@pytest.mark.parametrize("kind", Costs().kinds(3))
def test_rows_and_parts_never_contradict_the_tables(kind):
    for group in next_catalog(3, damped=False).groups:
        table = next_catalog(3, damped=False).further(group).tables[kind]
        for (a, i), (b, j), pair in spots(group, kind):
            said = table.look_up((group.index(a), i), (group.index(b), j))[0]
            if same_by_rows(*pair):
                assert said is Relation.INDISTINGUISHABLE
            if said is Relation.INDISTINGUISHABLE and not any(m.silent for m in pair):
                assert by_parts(*pair, Settings()) is None


@pytest.mark.parametrize(
    ("kind", "i", "j"),
    [(SENSOR, 1, 2), (SENSOR, 3, 3), (INERTIA, 1, 2), (LOCK, 3, 3)],
)
def test_rows_say_what_ideals_say(kind, i, j):
    """Two ports of a full grounded row, and what is done in the free row that both share."""
    pair = [measure_with(U[m], Item(kind, at)) for m, at in ((8, i), (11, j))]
    assert same_by_rows(*pair)
    assert isinstance(by_ideals(*pair, Settings(), LIMITS).evidence, Solutions)
    elsewhere = measure_with(U[11], Item(kind, 1 if j != 1 else 2))
    assert not same_by_rows(pair[0], elsewhere)


@pytest.mark.thin(1)
@pytest.mark.parametrize(("pair", "i", "j", "same"), INERTIAS)
def test_an_inertia_in_the_coordinates_of_its_mass(pair, i, j, same):
    both = [
        MeasuredChain(A[m], (AS_IT_IS, Experiment(inertias={at: 1})))
        for m, at in zip(pair, (i, j), strict=True)
    ]
    maps = match_maps(*both)
    assert all(m.parts[0] == 1 and not any("scale" in p for p in m.parameters) for m in maps)
    told_apart = by_parts(*both, Settings())
    assert told_apart is None or not same
    if told_apart is None:
        found = by_ideals(*both, Settings(), LIMITS)
        assert isinstance(found.evidence, Solutions if same else Refutation)


def test_inertias_of_two_sizes_are_not_compared_by_their_masses():
    both = [
        MeasuredChain(A[m], (AS_IT_IS, Experiment(inertias={2: size})))
        for m, size in ((2, 1), (5, 2))
    ]
    assert all(any("scale" in p for p in m.parameters) for m in match_maps(*both))


@pytest.mark.full
def test_five_damped_masses_have_bounds():
    """Without the coordinates of the mass, primes of 64 bits gave none, and nothing decided."""
    chain = Family(5, damped=True)[44]
    one, two, four = (measure_with(chain, Item(INERTIA, at)) for at in (1, 2, 4))
    found = by_ideals(one, two, Settings(), LIMITS)
    assert isinstance(found.evidence, Refutation) and found.safety >= LEAST_SAFETY
    by_ranks = by_parts(one, four, Settings())
    assert by_ranks.outcome.value == "fails" and by_ranks.safety >= LEAST_SAFETY


@pytest.mark.full
def test_a_shared_list_says_what_a_list_of_its_own_says():
    for i, j in product((1, 2, 3), repeat=2):
        pair = [measure_with(A[m], Item(INERTIA, at)) for m, at in ((2, i), (5, j))]
        shared, own = by_list(*pair, Settings(), shared=True), by_list(*pair, Settings())
        assert (shared is None) == (own is None)
        if shared is not None:
            assert (shared.outcome, shared.safety) == (own.outcome, own.safety)
            assert shared.evidence.point != own.evidence.point


@pytest.mark.parametrize(("n", "damped"), list(product(SHIPPED_SIZES, (False, True))))
def test_nothing_is_said_below_the_bound_that_is_promised(n, damped):
    stored = next_catalog(n, damped=damped)
    for group in stored.groups:
        for table in stored.further(group).tables.values():
            safety = table.decided.safety
            assert safety == 0 or safety >= LEAST_SAFETY
