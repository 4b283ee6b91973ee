"""One answer wherever it is asked: catalogue, `compare`, `verdicts` and page give the same
verdict on every pair.
"""

import csv
import io
import json
import re
from itertools import combinations

import pytest

from disting import Engine, Query, Relation, View, catalog, compare
from disting.catalogs.export import decisions_csv
from disting.model.question import Domain
from disting.report import page
from disting.verdict.result import Verdict

ENGINE = Engine()
SMALL = [(n, damped) for n in (2, 3, 4) for damped in (False, True)]
Answer = tuple[str, str, str]
"""Relation, rule and domain."""


def answer(verdict: Verdict) -> Answer:
    return verdict.relation.value, verdict.decided_by, verdict.domain.value


def by_verdicts(shipped, query) -> dict[tuple[int, int], Answer]:
    """The table that `disting verdicts` writes."""
    subjects = [ENGINE.subject(f"A{i}", chain) for i, chain in enumerate(shipped.family, 1)]
    rows = csv.DictReader(io.StringIO(decisions_csv(ENGINE.decisions(subjects, query))))
    return {
        (int(r["left"]), int(r["right"])): (r["relation"], r["decided_by"], r["domain"])
        for r in rows
    }


def by_page(shipped, view) -> dict[tuple[int, int], Answer]:
    """The view that a page's script reads, unpacked: a negative number repeats what is before
    it.
    """
    found = re.search(
        r'<script type="application/json" id="data">(.*?)</script>', page(shipped), re.DOTALL
    )
    assert found
    data, numbers = json.loads(found[1]), []
    for number in data["views"][view]:
        numbers += [number] if number >= 0 else [numbers[-1]] * -number
    fields = [[data["texts"][n] for n in data["entries"][number]] for number in numbers]
    pairs = [(low, high) for high in range(2, len(shipped.family) + 1) for low in range(1, high)]
    return {
        pair: (relation, by, domain)
        for pair, (relation, by, _, _, domain, *_) in zip(pairs, fields, strict=True)
    }


def by_compare(shipped, pairs, **query) -> dict[tuple[int, int], Answer]:
    return {
        (i, j): answer(compare(shipped.family[i], shipped.family[j], engine=ENGINE, **query))
        for i, j in pairs
    }


@pytest.mark.thin(1)
@pytest.mark.parametrize(("n", "damped"), SMALL[:4])
def test_by_default_every_door_gives_the_same_answer_over_positive_parameters(n, damped):
    assert_one_answer(n, damped)


@pytest.mark.slow
@pytest.mark.parametrize(("n", "damped"), SMALL[4:])
def test_every_door_gives_the_same_answer_for_four_masses(n, damped):
    assert_one_answer(n, damped)


def assert_one_answer(n, damped):
    shipped = catalog(n, damped=damped)
    pairs = list(combinations(range(1, len(shipped.family) + 1), 2))
    stored = {pair: answer(shipped.verdict(*pair)) for pair in pairs}
    assert {domain for *_, domain in stored.values()} == {Domain.POSITIVE}
    assert by_compare(shipped, pairs) == stored
    assert by_verdicts(shipped, Query()) == stored
    assert by_page(shipped, "positive") == stored


@pytest.mark.thin(1)
@pytest.mark.parametrize(("n", "damped"), SMALL[:4])
def test_and_over_complex_ones(n, damped):
    shipped = catalog(n, damped=damped)
    pairs = list(combinations(range(1, len(shipped.family) + 1), 2))
    stored = {pair: answer(shipped.verdict(*pair, View.EXACT)) for pair in pairs}
    assert {domain for *_, domain in stored.values()} == {Domain.COMPLEX}
    assert by_compare(shipped, pairs, query=Query(View.EXACT)) == stored
    assert by_verdicts(shipped, Query(View.EXACT)) == stored
    assert by_page(shipped, "exact") == stored


@pytest.mark.full
def test_four_masses_at_some_pairs():
    """With the pair that depends on the values."""
    shipped = catalog(4, damped=False)
    pairs = [*shipped.depending(), *list(combinations(range(1, 30), 2))[::25]]
    stored = {pair: answer(shipped.verdict(*pair)) for pair in pairs}
    drawn = by_page(shipped, "positive")
    assert by_compare(shipped, pairs) == stored == {pair: drawn[pair] for pair in pairs}


@pytest.mark.slow
@pytest.mark.parametrize("damped", [False, True])
def test_five_masses_at_some_pairs(damped):
    """Those that depend on the values, and every fiftieth."""
    shipped = catalog(5, damped=damped)
    pairs = [*shipped.depending(), *list(combinations(range(1, 74), 2))[::50]]
    assert by_compare(shipped, pairs) == {pair: answer(shipped.verdict(*pair)) for pair in pairs}
    drawn = by_page(shipped, "positive")
    assert {pair: drawn[pair] for pair in pairs} == {
        pair: answer(shipped.verdict(*pair)) for pair in pairs
    }


@pytest.mark.thin(2)
@pytest.mark.parametrize(
    ("n", "damped", "sometimes"),
    [(3, False, 0), (4, False, 1), (4, True, 0), (5, False, 13), (5, True, 0)],
)
def test_what_depends_on_the_values_is_in_no_group_for_that(n, damped, sometimes):
    """Over complex parameters these pairs are indistinguishable; over positive ones they are
    named on their own.
    """
    shipped = catalog(n, damped=damped)
    assert len(shipped.depending()) == sometimes and shipped.depending(View.EXACT) == ()
    for low, high in shipped.depending():
        assert shipped.relation(low, high) is Relation.SOMETIMES
        assert shipped.relation(low, high, View.EXACT) is Relation.INDISTINGUISHABLE
        assert not any({low, high} <= set(group) for group in shipped.classes())
        assert any({low, high} <= set(group) for group in shipped.classes(View.EXACT))


@pytest.mark.thin(3)
@pytest.mark.parametrize(("n", "damped"), [*SMALL, (5, False), (5, True)])
def test_groups_over_positive_parameters_hold_every_indistinguishable_pair_and_no_other(n, damped):
    shipped = catalog(n, damped=damped)
    inside = {pair for group in shipped.classes() for pair in combinations(group, 2)}
    same = {(i, j) for i, j, v in shipped.pairs() if v.relation is Relation.INDISTINGUISHABLE}
    assert inside == same
