"""One answer wherever it is asked: rows decided once serve every command, and no installed
program changes a verdict.
"""

import stat

import pytest

from disting import Engine, Query, Relation
from disting.algebra.certainty import Certainty
from disting.conditions.finding import Outcome
from disting.conditions.finding_json import finding_from_json, finding_to_json
from disting.evidence.ideals import ByRow
from disting.evidence.kinds import evidence_from
from disting.fibres.ideals import Limits
from disting.fibres.ideals.by_one_row import row_pairs
from disting.model.chain import Chain
from disting.model.settings import Settings
from disting.questions.same import exact
from disting.questions.same.evidence_check import Witness
from disting.questions.same.exact import by_row, exact_finding
from disting.verdict import decide

WALLED = (Chain(5, 4, 1, 5, 3, 5, damped=True), Chain(5, 4, 2, 5, 4, 5, damped=True))
INSIDE = (Chain(6, 4, 1, 5, 3, 6, damped=True), Chain(6, 4, 2, 5, 4, 6, damped=True))


@pytest.mark.parametrize(
    "pair", [pytest.param(WALLED, marks=pytest.mark.slow), INSIDE], ids=["5 masses", "6 masses"]
)
def test_a_row_known_once_decides_chains_of_any_size(pair):
    found = by_row(*pair)
    assert (found.outcome, found.certainty) == (
        Outcome.FAILS,
        Certainty.BOUNDED,
    ) and found.safety >= 100
    assert found.evidence == ByRow("grounded", True, 4, (2, 4), (1, 3), "rows:disting", 7, 6)
    assert by_row(*pair[::-1]).evidence == found.evidence
    assert finding_from_json(finding_to_json(found)) == found
    assert Witness().confirms(found.evidence, "fibre", *pair)
    assert not Witness().confirms(found.evidence, "fibre", pair[0], pair[0])


def test_decisions_and_one_pair_agree():
    engine = Engine()
    subjects = [engine.subject(name, c) for name, c in zip("ab", WALLED, strict=True)]
    query = Query(inclusion=False)
    many, one = engine.decisions(subjects, query), decide(*subjects, query)
    assert many.relation(0, 1) is one.relation is Relation.DISTINGUISHABLE
    assert many.verdict(0, 1) == one and one.evidence.kind == "row"


@pytest.mark.parametrize("name", ["msolve", "Singular"])
def test_an_installed_program_changes_no_verdict(name, monkeypatch, tmp_path):
    script = tmp_path / name
    script.write_text(
        '#!/bin/sh\necho "[1]"\nfor last; do :; done\ntest -z "$last" || echo "[1]" > "$last"\n'
    )
    script.chmod(script.stat().st_mode | stat.S_IXUSR)
    monkeypatch.setenv("PATH", f"{tmp_path}:/usr/bin:/bin")
    monkeypatch.setattr(exact, "LIMITS", Limits(seconds=60, entries=1, safety=100))
    pair = (Chain(6, 0, 0, 2, 0, 3, damped=True), Chain(6, 0, 0, 3, 0, 4, damped=True))
    assert exact_finding(*pair, Settings()).outcome is Outcome.ABANDONED


def test_a_stored_verdict_by_a_program_is_refused_with_the_reason():
    with pytest.raises(ValueError, match="external program"):
        evidence_from({"kind": "program", "program": "msolve", "left_given": True, "label": "x"})


def test_rows_of_chains_that_the_theorem_does_not_cover_decide_nothing():
    damped, undamped = WALLED[0], Chain(5, 4, 2, 5, 4, 5)
    assert row_pairs(damped.structure, undamped.structure, "test") == []
    rubbed = Chain(5, 4, 2, 5, 4, 5, damped=True, ground_dampers=(1,))
    assert row_pairs(damped.structure, rubbed.structure, "test") == []
    assert row_pairs(damped.structure, Chain(5, 3, 2, 5, 3, 5, damped=True).structure, "test") == []
