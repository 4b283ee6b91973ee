"""One answer wherever it is asked: a row that differs decides chains of any size, and no installed
program changes a verdict.
"""

import stat

import pytest

from disting import Engine, Query, Relation
from disting.algebra.certainty import Certainty
from disting.conditions.rule import Finding, Outcome
from disting.decide.same import exact
from disting.decide.same.evidence_check import Witness
from disting.decide.same.exact import exact_finding
from disting.evidence.kinds import evidence_from
from disting.fibres.ideals import Limits
from disting.model.chain import Chain
from disting.model.question import Settings
from disting.verdict.cascade import decide

WALLED = (Chain(5, 4, 1, 5, 3, 5, damped=True), Chain(5, 4, 2, 5, 4, 5, damped=True))
INSIDE = (Chain(6, 4, 1, 5, 3, 6, damped=True), Chain(6, 4, 2, 5, 4, 6, damped=True))
FREE = (Chain(5, 0, 0, 1, 0, 3, damped=True), Chain(5, 0, 0, 2, 0, 4, damped=True))


@pytest.mark.full
@pytest.mark.parametrize(
    ("pair", "part"),
    [(WALLED, "grounded"), (INSIDE, "grounded"), (FREE, "")],
    ids=["5 masses", "6 masses", "one row"],
)
def test_the_row_that_differs_decides_chains_of_any_size(pair, part):
    found = exact_finding(*pair, Settings())
    assert (found.outcome, found.certainty) == (Outcome.FAILS, Certainty.BOUNDED)
    assert found.safety >= 100
    assert (found.evidence.kind, found.evidence.part) == ("shared", part)
    assert Finding.from_json(found.to_json()) == found
    assert Witness().confirms(found.evidence, "fibre", *pair)
    assert not Witness().confirms(found.evidence, "fibre", pair[0], pair[0])


@pytest.mark.full
def test_decisions_and_one_pair_agree():
    engine = Engine()
    subjects = [engine.subject(name, c) for name, c in zip("ab", WALLED, strict=True)]
    query = Query(inclusion=False)
    many, one = engine.decisions(subjects, query), decide(*subjects, query)
    assert many.relation(0, 1) is one.relation is Relation.DISTINGUISHABLE
    assert many.verdict(0, 1) == one and one.evidence.kind == "shared"


@pytest.mark.slow
@pytest.mark.parametrize(
    ("here", "there"),
    [
        ((0, 1, 3), (0, 2, 4)),
        ((0, 1, 4), (0, 2, 5)),
        ((0, 2, 3), (0, 3, 4)),
        ((5, 1, 4), (5, 2, 5)),
    ],
    ids=str,
)
def test_nothing_of_six_damped_masses_is_open(here, there):
    """The four questions to which the last nine pairs came down, a few seconds each."""
    found = exact_finding(*(six(*places) for places in (here, there)), Settings())
    assert found.outcome is Outcome.FAILS
    assert found.safety >= 100


def six(gap, first, second):
    """A damped chain of six masses with both ports in its first row."""
    grounded = (gap, first, 6, second, 6)
    return Chain(6, *(grounded if gap else (0, 0, first, 0, second)), damped=True)


@pytest.mark.full
@pytest.mark.parametrize("name", ["msolve", "Singular"])
def test_an_installed_program_changes_no_verdict(name, monkeypatch, tmp_path):
    script = tmp_path / name
    script.write_text(
        '#!/bin/sh\necho "[1]"\nfor last; do :; done\ntest -z "$last" || echo "[1]" > "$last"\n'
    )
    script.chmod(script.stat().st_mode | stat.S_IXUSR)
    monkeypatch.setenv("PATH", f"{tmp_path}:/usr/bin:/bin")
    monkeypatch.setattr(exact, "LIMITS", Limits(seconds=60, entries=1, safety=100))
    pair = (Chain(4, 0, 0, 1, 0, 2, ground_dampers=(m,), damped=False) for m in (1, 2))
    assert exact_finding(*pair, Settings()).outcome is Outcome.ABANDONED


@pytest.mark.parametrize(
    ("evidence", "told"),
    [
        ({"kind": "program", "program": "msolve", "left_given": True, "label": "x"}, "program"),
        (
            {"kind": "row", "part": "whole", "wall": False, "masses": 5, "given": [2, 4]}
            | {"searched": [1, 3], "label": "rows:disting", "branches": 14, "degree": 7},
            "rows of masses",
        ),
    ],
)
def test_a_stored_verdict_of_a_kind_that_is_no_more_is_refused_with_the_reason(evidence, told):
    with pytest.raises(ValueError, match=f"{told}.*; ask for it again"):
        evidence_from(evidence)
