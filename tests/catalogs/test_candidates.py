"""The shipped verdicts on the candidates of a fit: current to the byte, as compare says, and
used by the fit.
"""

import json
from dataclasses import replace
from itertools import combinations
from random import Random

import pytest

from disting import (
    CatalogError,
    Certainty,
    Chain,
    Engine,
    Family,
    InputError,
    Quantity,
    Relation,
    compare,
)
from disting.catalogs import candidates as stored
from disting.catalogs.files import shipped_folder
from disting.cli import main
from disting.fit.judge.alternatives import alternatives, representatives
from disting.fit.search.candidates import figure_1, whole_family

SAME, APART = Relation.INDISTINGUISHABLE, Relation.DISTINGUISHABLE
FIRST = Chain(2, damped=True)


class Untouched(Engine):
    """An engine that must not compute."""

    def decisions(self, *arguments, **options):
        raise AssertionError("verdicts are computed that are shipped")

    def verdict(self, *arguments, **options):
        raise AssertionError("verdicts are computed that are shipped")


def test_the_shipped_file_holds_all_candidates_and_pairs():
    found = stored.shipped_matrix()
    assert found.chains == figure_1()
    assert sum(found.counts().values()) == 7140


# Printed: "the set of candidate models was chosen appropriately with distinguishable models only".
def test_every_two_candidates_are_distinguishable():
    assert stored.shipped_matrix().counts() == {APART: 7140, SAME: 0, Relation.UNDECIDED: 0}


@pytest.mark.slow
def test_rebuilding_gives_the_same_bytes():
    text = (shipped_folder() / stored.FILE).read_text(encoding="utf-8")
    assert stored.matrix(figure_1()).text() == text


@pytest.mark.full
def test_a_part_of_the_matrix_is_as_computed_now():
    part = figure_1(sizes=(1, 2))
    found, known = stored.matrix(part), stored.shipped_matrix()
    for i, left in enumerate(part):
        for right in part[i + 1 :]:
            for column in (
                stored.Matrix.relation,
                stored.Matrix.decided_by,
                stored.Matrix.certainty,
            ):
                assert column(found, left, right) == column(known, right, left)


@pytest.mark.full
def test_as_compare_says():
    engine, known, random = Engine(), stored.shipped_matrix(), Random(1)
    for _ in range(60):
        left, right = random.sample(known.chains, 2)
        verdict = compare(left, right, engine=engine)
        assert verdict.relation is known.relation(left, right)
        assert verdict.decided_by == known.decided_by(left, right)
        assert verdict.certainty is known.certainty(left, right)


@pytest.mark.full
def test_the_error_bound_is_that_of_the_weakest_verdict():
    assert stored.shipped_matrix().records[0]["safety"] >= 100
    chains, engine = [Family(3, damped=True)[i] for i in (1, 4, 6, 8)], Engine()
    verdicts = [compare(a, b, engine=engine) for a, b in combinations(chains, 2)]
    bits = {v.safety for v in verdicts if v.certainty is Certainty.BOUNDED}
    assert len(bits) > 1
    assert stored.matrix(chains, engine=engine).records[0]["safety"] == min(bits)


def test_a_matrix_with_all_relations_survives_its_file(tmp_path):
    chains = [Family(3, damped=True)[i] for i in (1, 4, 11)]
    found = stored.matrix(chains)
    stored.write(found, tmp_path)
    again = stored.read(tmp_path)
    assert again == found
    assert [again.relation(chains[i], chains[j]) for i, j in ((0, 1), (0, 2), (1, 2))] == [
        APART,
        SAME,
        APART,
    ]
    assert again.decided_by(chains[0], chains[2]) == "exact"


@pytest.mark.parametrize("sensor", Quantity)
def test_the_fit_looks_up_and_does_not_compute(sensor):
    family = figure_1((2, 3), sensor)
    assert representatives(family, Untouched(), {}) == {c: c for c in family}
    assert alternatives(replace(FIRST, quantity=sensor), family, Untouched(), {}) == ()


@pytest.mark.full
def test_other_candidates_are_computed():
    family = whole_family((2,))
    first = representatives(family, Engine(), {})
    assert first[Chain(2, meas_plus=2, damped=True, ground_dampers=(2,))] == Chain(
        2, meas_plus=2, damped=True, ground_dampers=(1,)
    )
    assert first[FIRST] == FIRST


def test_pairs_that_are_not_there_are_refused():
    for pair in (
        (FIRST, FIRST),
        (FIRST, Chain(2, damped=False)),
        (FIRST, Chain(3, damped=True, quantity="position")),
    ):
        with pytest.raises(InputError, match="two of its models"):
            stored.shipped_matrix().relation(*pair)
    with pytest.raises(InputError, match="one sensor"):
        stored.matrix([FIRST, Chain(2, quantity="velocity", damped=False)])


@pytest.mark.parametrize(
    "text",
    ["", "{}\n", "no json\n", '{"schema": 1, "models": 2}\n', '{"schema": 9, "models": 0}\n'],
)
def test_damaged_files_are_refused_with_the_remedy(tmp_path, text):
    (tmp_path / stored.FILE).write_text(text)
    with pytest.raises(CatalogError, match="disting catalog candidates"):
        stored.read(tmp_path)


def test_a_missing_file_is_named(tmp_path):
    with pytest.raises(CatalogError, match="disting catalog candidates"):
        stored.read(tmp_path)


@pytest.mark.slow
def test_the_command_writes_the_shipped_file(tmp_path, capsys):
    assert main(["catalog", "candidates", "--out", str(tmp_path), "--no-cache"]) == 0
    assert "120 models, 7140 distinguishable" in capsys.readouterr().out
    assert json.loads((tmp_path / stored.FILE).read_text().splitlines()[0])["models"] == 120
    assert (tmp_path / stored.FILE).read_bytes() == (shipped_folder() / stored.FILE).read_bytes()
