"""Families of several sizes in one matrix."""

import csv
import io
from collections import Counter

import pytest

from disting import Engine, Inclusion, InputError, Query, Relation, catalog
from disting.catalogs.sizes import answers_in, combine, combined_family
from disting.cli import main
from disting.conditions.inclusion import Sense

ENGINE = Engine()


@pytest.fixture(scope="module", params=[False, True], ids=["undamped", "damped"])
def three(request):
    return request.param, combine((1, 2, 3), damped=request.param, engine=ENGINE)


@pytest.mark.full
def test_the_answers_in_catalogues_are_those_that_would_be_computed(three):
    """And with them nothing is asked about the pairs of one size."""
    damped, computed = three
    engine, asked = Engine(), set()
    for n in (1, 2, 3):
        for known in answers_in(catalog(n, damped=damped)):
            engine.remember(*known)
    found = combine(
        (1, 2, 3),
        damped=damped,
        engine=engine,
        progress=lambda what, done, total: asked.add(what),
    )
    assert found.inclusions == computed.inclusions
    assert found.shares == computed.shares
    assert not {"images", "positive equivalents"} & asked


def test_forty_four_models_of_one_to_four_masses():
    assert [name for name, _ in combined_family((1, 2, 3, 4), damped=False)][::14] == [
        "1:1",
        "3:11",
        "4:14",
        "4:28",
    ]
    assert len(combined_family((4, 2, 1, 3, 3), damped=False)) == 44


@pytest.mark.full
@pytest.mark.parametrize("damped", [False, True])
def test_models_of_different_sizes_are_distinguishable_by_their_degrees(damped):
    """All pairs of 1 to 4 masses: by condition 1, and by 2 where equally many coefficients are
    distributed differently.
    """
    found = combine((1, 2, 3, 4), damped=damped, query=Query(inclusion=False), engine=ENGINE)
    n = [s.chain.n_masses for s in found.subjects]
    pairs = [(i, j) for i in range(len(n)) for j in range(i + 1, len(n)) if n[i] != n[j]]
    assert {found.relation(i, j) for i, j in pairs} == {Relation.DISTINGUISHABLE}
    counts = Counter(found.rule(i, j) for i, j in pairs)
    assert counts == ({"1": 482} if damped else {"1": 462, "2": 20})


@pytest.mark.full
def test_pairs_of_one_size_are_those_of_the_catalogue(three):
    damped, found = three
    places = {s.name: i for i, s in enumerate(found.subjects)}
    shipped = catalog(3, damped=damped)
    for left, right, verdict in shipped.pairs():
        i, j = places[f"3:{left}"], places[f"3:{right}"]
        assert found.relation(i, j) is verdict.relation
        assert [found.inclusion(i, j, sense) for sense in Sense] == [verdict.image, verdict.closure]
        assert found.verdict(i, j).decided_by == verdict.decided_by


@pytest.mark.full
def test_one_sided_inclusion_is_shown(three):
    damped, found = three
    places = {s.name: i for i, s in enumerate(found.subjects)}
    between = Counter()
    for (i, j), finding in found.inclusions.items():
        sizes = tuple(found.subjects[k].chain.n_masses for k in (i, j))
        if sizes[0] != sizes[1]:
            between[sizes, finding.closure.inclusion] += 1
    assert (
        between[(1, 2), Inclusion.LEFT_IN_RIGHT] == 3
        and between[(1, 3), Inclusion.LEFT_IN_RIGHT] == 11
    )
    assert between[(2, 3), Inclusion.LEFT_IN_RIGHT] == (33 if damped else 31)
    assert not {Inclusion.RIGHT_IN_LEFT, Inclusion.UNKNOWN} & {
        inclusion for _, inclusion in between
    }
    assert found.verdict(places["2:1"], places["3:1"]).closure is Inclusion.LEFT_IN_RIGHT


@pytest.mark.slow
@pytest.mark.parametrize(("damped", "inside", "outside"), [(False, 417, 65), (True, 441, 41)])
def test_models_of_one_to_four_masses(damped, inside, outside):
    """All 482 pairs of different size are settled."""
    found = combine((1, 2, 3, 4), damped=damped, engine=ENGINE)
    sizes = [s.chain.n_masses for s in found.subjects]
    pairs = [(i, j) for i in range(44) for j in range(i + 1, 44) if sizes[i] != sizes[j]]
    counts = Counter(found.inclusion(i, j, Sense.CLOSURE) for i, j in pairs)
    assert counts == {Inclusion.LEFT_IN_RIGHT: inside, Inclusion.NEITHER: outside}


def test_csv_with_names(capsys):
    assert main(["verdicts", "1-2", "--damped", "--csv", "-", "--no-cache"]) == 0
    rows = list(csv.DictReader(io.StringIO(capsys.readouterr().out)))
    assert [(r["left"], r["right"]) for r in rows][:3] == [
        ("1:1", "2:1"),
        ("1:1", "2:2"),
        ("1:1", "2:3"),
    ]
    assert [r["closure"] for r in rows][:3] == ["left-in-right"] * 3


@pytest.mark.full
def test_summary_of_the_command(capsys):
    assert main(["verdicts", "1-3", "--no-cache", "--undamped"]) == 0
    assert (
        "over complex parameters: 45 smaller models are limits of larger ones"
        in capsys.readouterr().out
    )
    assert main(["verdicts", "3", "--no-cache", "--undamped"]) == 0
    assert "limits of larger" not in capsys.readouterr().out


@pytest.mark.parametrize("sizes", ["0", "3-1", "1-", "a", "1-2-3"])
def test_bad_sizes(sizes, capsys):
    with pytest.raises(SystemExit) as left:
        main(["verdicts", sizes, "--undamped"])
    assert left.value.code == 2
    assert "sizes are written like 4 or 1-4" in capsys.readouterr().err


def test_no_size():
    with pytest.raises(InputError, match="at least one size"):
        combined_family((), damped=False)
