"""The exact decision against the conditions, and the pairs that conditions 1 to 9 leave open."""

import pytest

from disting.catalogs import Catalog, catalog
from disting.conditions.rule import Outcome
from disting.decide.same.exact import by_ideals, by_synthesis, exact_finding
from disting.errors import InputError
from disting.fibres.synthesis.decide import Direction, Grounds, decide, member
from disting.fibres.synthesis.task import Status
from disting.model.family import Family
from disting.model.question import Membership, Settings
from disting.verdict.result import Relation, View

OPEN_MEMBERS = {
    (3, True): {(1, 11)},
    (4, False): {(14, 20), (22, 26), (22, 28), (24, 26), (24, 28)},
    (4, True): {(1, 29), (8, 19)},
}
OPEN_COUNTS = {(3, True): 6, (4, False): 9, (4, True): 46}
AGREES = {
    Relation.DISTINGUISHABLE: Membership.EXCLUDED,
    Relation.INDISTINGUISHABLE: Membership.MEMBER,
}


def undecided(c: Catalog) -> list[tuple[int, int]]:
    return [(i, j) for i, j, v in c.pairs(View.COMBINED) if v.relation is Relation.UNDECIDED]


@pytest.mark.full
@pytest.mark.parametrize(("n", "damped"), [(3, False), (3, True), (4, False), (4, True)])
def test_agrees_with_the_conditions_on_pairs_of_equal_rank(n: int, damped: bool) -> None:
    c = catalog(n, damped=damped)
    rank = {row.number: row.rank for row in c.rows}
    decided = [
        (i, j, v)
        for i, j, v in c.pairs(View.COMBINED)
        if rank[i] == rank[j] and v.relation in AGREES
    ]
    assert len(decided) > 15
    for i, j, verdict in decided if n < 4 else decided[::6]:
        assert decide(c.family[i], c.family[j]).membership is AGREES[verdict.relation], (i, j)


@pytest.mark.full
@pytest.mark.parametrize(("n", "damped"), list(OPEN_MEMBERS))
def test_decides_every_open_pair(n: int, damped: bool) -> None:
    c = catalog(n, damped=damped)
    found = {pair: decide(c.family[pair[0]], c.family[pair[1]]) for pair in undecided(c)}
    assert len(found) == OPEN_COUNTS[n, damped]
    assert {pair for pair, e in found.items() if e.membership is Membership.MEMBER} == OPEN_MEMBERS[
        n, damped
    ]
    assert all(e.membership is not Membership.UNKNOWN for e in found.values())


@pytest.mark.full
def test_every_member_among_the_open_pairs_is_proven() -> None:
    for (n, damped), pairs in OPEN_MEMBERS.items():
        family = Family(n, damped)
        grounds = {decide(family[i], family[j]).grounds for i, j in pairs}
        assert grounds == ({Grounds.THEOREM} if damped else {Grounds.CONSTRUCTION})


@pytest.mark.full
def test_another_seed_says_the_same() -> None:
    c = catalog(3, damped=True)
    for i, j in undecided(c):
        assert (
            decide(c.family[i], c.family[j], "again").membership
            is decide(c.family[i], c.family[j]).membership
        )


@pytest.mark.slow
@pytest.mark.parametrize(
    ("damped", "members", "unknown"),
    [(False, 37, 0), (True, 2, 6)],
)
def test_five_masses(damped: bool, members: int, unknown: int) -> None:
    c = catalog(5, damped=damped)
    found = [decide(c.family[i], c.family[j]).membership for i, j in undecided(c)]
    assert (found.count(Membership.MEMBER), found.count(Membership.UNKNOWN)) == (members, unknown)


def test_damped_model_7_lies_inside_model_6_but_not_over_positive_parameters() -> None:
    family = Family(3, damped=True)
    found = member(family[7], family[6])
    assert (found.membership, found.grounds) == (Membership.MEMBER, Grounds.SUBSYSTEM)
    assert (found.real, found.positive) == (found.solutions, 0)


def test_the_point_makes_a_finding_repeatable() -> None:
    family = Family(3, damped=True)
    first, second = (decide(family[1], family[8]) for _ in range(2))
    assert first == second
    assert first.direction in Direction
    assert first.grounds is Grounds.REFUTED
    assert first.status is Status.EMPTY
    assert all(value > 0 for value in first.point.values())


def test_refuses_unequal_sizes_and_truth_values() -> None:
    with pytest.raises(InputError):
        decide(Family(2, damped=False)[1], Family(3, damped=False)[1])
    with pytest.raises(TypeError):
        bool(decide(Family(2, damped=False)[1], Family(2, damped=False)[2]))


def test_what_the_exact_decision_is_not_about_is_said():
    two, three = (Family(n, damped=True)[1] for n in (2, 3))
    sizes = exact_finding(two, three, Settings())
    assert sizes.outcome is Outcome.INAPPLICABLE and "equal size and sensor" in sizes.note
    degrees = by_ideals(three, Family(3, damped=True)[2], Settings())
    assert degrees.outcome is Outcome.INAPPLICABLE and "the degrees differ" in degrees.note
    assert by_synthesis(three, Family(3, damped=False)[1], Settings()) is None
