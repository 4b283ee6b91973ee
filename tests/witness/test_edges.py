"""Edges that random cases seldom meet: targets a method cannot take, special points, stated
bounds and notes.
"""

from itertools import pairwise

import pytest
from flint import fmpq, nmod_mat

from disting import Chain, Engine, Family, Query, Relation, Settings, View
from disting.algebra.matroid import matroid
from disting.fibres.synthesis.decide import point_bits, rational_point, safety_of_point
from disting.fibres.synthesis.fibre import fibre
from disting.fibres.synthesis.task import Exclusions, Status, target

# --- fibres
# ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "chain", [Chain(3, damped=True), Chain(3, 1, 1, 2, 1, 3, damped=True)], ids=str
)
def test_an_undamped_receptance_is_a_special_one_of_a_damped_chain(chain: Chain) -> None:
    """It is the limit of vanishing dampers: neither a member, nor refuted, and no balls are
    needed to see that.
    """
    undamped = Chain(*chain.indices, damped=False)
    found = fibre(chain, target(undamped.structure, rational_point(undamped, "edge")))
    assert (found.status, found.precision_bits) == (Status.DEGENERATE, 0)
    assert found.reason == "multiple or missing poles or zeros"


def test_multiple_poles_are_seen_before_any_ball() -> None:
    """Grounded mass 1 (k01/m1 = 2) and the free pair (k23 (1/m2 + 1/m3) = 2) share their
    frequency.
    """
    chain = Chain(3, 1, 1, 2, 1, 2, damped=False)
    point = {"m1": fmpq(1), "m2": fmpq(1), "m3": fmpq(1), "k01": fmpq(2), "k23": fmpq(1)}
    found = fibre(chain, target(chain.structure, point))
    assert (found.status, found.precision_bits) == (Status.DEGENERATE, 0)


def test_degrees_alone_refute_without_a_branch() -> None:
    given, searched = Chain(3, damped=False), Chain(3, meas_plus=2, damped=False)
    found = fibre(searched, target(given.structure, rational_point(given, "edge")))
    assert (found.status, found.tests) == (Status.EMPTY, Exclusions(0, 0, 0))
    assert found.precision_bits == 0


SLOPES_VANISH = [
    (Chain(3, meas_plus=2, damped=True), (1, 1, 2, 1, 2, 1, 3)),
    (Chain(3, meas_plus=2, damped=True), (2, 3, 3, 2, 3, 2, 1)),
    (Chain(4, 1, 1, 3, 1, 4, damped=True), (1, 1, 2, 2, 3, 1, 2, 3, 3, 2)),
]


@pytest.mark.parametrize(("chain", "numbers"), SLOPES_VANISH, ids=str)
def test_the_model_itself_is_listed_where_both_slopes_vanish(
    chain: Chain, numbers: tuple[int, ...]
) -> None:
    """The mass behind the sensor's spring is a quotient of two remainders, whose slopes are
    both zero here.
    """
    point = dict(zip(chain.parameters, map(fmpq, numbers), strict=True))
    found = fibre(chain, target(chain.structure, point))
    listed = any(
        all(s.values[name].overlaps(s.values[name] * 0 + x) for name, x in point.items())
        for s in found.solutions
    )
    assert listed or found.status is not Status.COMPLETE


# --- bounds and notes
# ------------------------------------------------------------------------------------------------


@pytest.mark.thin(8)
@pytest.mark.parametrize("n_masses", [1, 2, 3, 5, 8, 12])
@pytest.mark.parametrize("rubbing", [False, True])
@pytest.mark.parametrize("damped", [False, True])
def test_error_bound_of_one_point(n_masses: int, rubbing: bool, damped: bool) -> None:
    """2^-b is the smallest power of two not below 6 D^(n+1)/2^(B-1) in whole numbers, n of the
    searched chain.
    """
    chain = Chain(
        n_masses, damped=damped, ground_dampers=tuple(range(1, n_masses + 1)) if rubbing else ()
    )
    n = len(chain.parameters)
    chances = 6 * max(3 * n_masses + 2, n + 1) ** (n + 1)
    assert chances <= 2 ** (point_bits(chain) - 1 - safety_of_point(chain)) < 2 * chances
    assert safety_of_point(chain) >= 128


@pytest.mark.parametrize("view", [View.TF, View.COMBINED])
def test_what_does_not_apply_is_not_called_abandoned(view: View) -> None:
    engine, family = Engine(), Family(3, damped=True)
    left, right = (engine.subject(f"A{i}", family[i]) for i in (1, 8))
    verdict = engine.verdict(left, right, Query(view))
    assert (verdict.relation, verdict.notes) == (Relation.UNDECIDED, ())
    assert (
        verdict.sentence
        == "A1 and A8, damped, acceleration, are undecided over complex parameters:"
        " none of the available methods decides them."
    )


def test_a_search_that_was_abandoned_is_noted_once_a_representation() -> None:
    engine, family = Engine(Settings(subset_limit=0)), Family(3, damped=True)
    left, right = (engine.subject(f"A{i}", family[i]) for i in (1, 8))
    notes = engine.verdict(left, right, Query(View.COMBINED)).notes
    assert [note.split(" was abandoned")[0] for note in notes] == [
        "condition 5 on tf",
        "condition 5 on markov",
    ]


# --- matroids
# --------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("p", [2, 101])
def test_dependences_of_a_matroid_kept_as_its_dual(p: int) -> None:
    """A cycle of 5 edges with a chord: rank 4 of 6, kept as dual of rank 2 with parallel
    classes as flats.
    """
    edges = [*pairwise(range(5)), (4, 0), (0, 2)]
    rows = [[(v == a) - (v == b) for v in range(5)] for a, b in edges]
    table = nmod_mat(6, 5, [x % p for row in rows for x in row], p)
    form = matroid(table, 1000)
    (component,) = form.components
    assert (component.rank, component.dual, {flat for flat, _ in component.flats}) == (
        4,
        True,
        {(0, 1), (2, 3, 4)},
    )
    stated = dict(form.dependences())
    assert stated[2, 3, 4, 5] == 3 and stated[0, 1, 5] == 2
    for chosen, rank in stated.items():
        assert nmod_mat(len(chosen), 5, [x % p for i in chosen for x in rows[i]], p).rank() == rank
