"""The page of models of several sizes: its counts, its fields, its words."""

import pytest

from disting.catalogs.combined import combined
from disting.questions.inclusion import Inclusion, Sense
from disting.report.scene import Text
from disting.report.sizes import between, figure, outside, sizes_page
from disting.verdict import Decisions, Query


@pytest.fixture(scope="module")
def decided() -> Decisions:
    return combined((2, 3))


def test_counts_are_those_of_the_pairs(decided: Decisions) -> None:
    (row,) = between(decided)
    assert (row.small, row.large, row.inside + row.outside + row.unknown) == (2, 3, 33)
    found = [decided.inclusion(i, j, Sense.CLOSURE) for i in range(3) for j in range(3, 14)]
    assert row.inside == found.count(Inclusion.LEFT_IN_RIGHT)
    assert row.outside == len(list(outside(decided))) == found.count(Inclusion.NEITHER) > 0


def test_every_pair_has_its_sign(decided: Decisions) -> None:
    shown = figure(decided)
    (signs,) = (layer.shapes for layer in shown.layers if layer.name == "signs")
    assert len(signs) == 14 * 13 // 2
    inside = [s for s in signs if isinstance(s, Text) and s.text in "⊂⊃"]
    kinds = (Inclusion.LEFT_IN_RIGHT, Inclusion.RIGHT_IN_LEFT)
    assert len(inside) == sum(
        decided.inclusion(j, i, Sense.CLOSURE) in kinds for i in range(14) for j in range(i)
    )


def test_the_page_says_it_in_words(decided: Decisions) -> None:
    text = sizes_page(decided)
    assert (
        "Chains of 2 to 3 masses, undamped" in text
        and "disting verdicts 2-3 --undamped --json FILE" in text
    )
    for one in outside(decided):
        assert f"<strong>{one.left} in {one.right}</strong>: " in text
    assert "is not known" not in text


def test_what_is_not_known_is_said() -> None:
    text = sizes_page(combined((1, 2), query=Query(inclusion=False)))
    assert "<strong>3</strong> it is not known" in text
