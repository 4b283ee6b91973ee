"""The tables of deciders are complete, consistent, and what the guide prints."""

import inspect
from collections import Counter
from pathlib import Path
from typing import get_args

import pytest

import disting
from disting.decide import (
    OF_INCLUSIONS,
    OF_VERDICTS,
    SAME_CHAINS,
    TABLES,
    Asked,
    Cost,
    Decider,
    Of,
    as_markdown,
    check,
    deciders_of,
    first_finding,
    function,
    recheck,
)
from disting.evidence.decision import GEARS, DeadTime, Theorem
from disting.evidence.kind import Carrier
from disting.evidence.kinds import Evidence, InclusionEvidence
from disting.evidence.positive import PositiveEvidence
from disting.general.formulas import is_explicit
from disting.model.chain import Chain
from disting.model.question import Settings

ROWS = [(table, row) for table in TABLES for row in table.deciders]
DECIDERS = Carrier.EXACT | Carrier.ADMISSIBLE


def arguments(name):
    """Names of the arguments that a function has to be given."""
    every = inspect.signature(function(name)).parameters.values()
    return [p for p in every if p.kind is p.POSITIONAL_OR_KEYWORD]


def needed(name):
    """How many of them have no default."""
    return sum(p.default is p.empty for p in arguments(name))


@pytest.mark.thin(8)
@pytest.mark.parametrize(("table", "row"), ROWS, ids=lambda x: getattr(x, "name", ""))
def test_all_functions_of_a_row_are_there(table, row):
    names = [row.decide, row.applies, row.check, row.recheck]
    assert all(callable(function(name)) for name in names if name)
    if row.applies:
        assert len(arguments(row.applies)) == needed(row.decide)
    first = "evidence"
    for name in filter(None, (row.check, row.recheck)):
        assert arguments(name)[0].name == first


@pytest.mark.thin(8)
@pytest.mark.parametrize("table", TABLES, ids=repr)
def test_rows_of_a_table_can_stand_for_each_other(table):
    """All take as many arguments, some with a default."""
    for rows in (table.at_once, table.rows):
        least = max((needed(row.decide) for row in rows), default=0)
        assert all(least <= len(arguments(row.decide)) for row in rows)


@pytest.mark.parametrize("of", Of)
def test_what_is_verified_has_a_check(of):
    """Evidence that a verdict or an inclusion may carry is found again by the row that yields it."""
    for row in (*deciders_of(of), *deciders_of(of, OF_INCLUSIONS)):
        is_quick = row.decide.startswith("experiments.exact:") and not row.yields
        assert bool(row.check) == bool(row.yields) or is_quick


def test_every_kind_of_evidence_has_its_row():
    yielded = {k if isinstance(k, type) else type(k) for _, row in ROWS for k in row.yields}
    decided = {k for k in get_args(Evidence) if k.claim.carriers & DECIDERS}
    outside = {k for k in decided if k.claim.carriers & Carrier.CONDITION} - {Theorem}
    assert decided - outside <= yielded
    assert {*get_args(InclusionEvidence)} <= yielded
    assert {k.__name__ for k in {*get_args(PositiveEvidence)} - yielded} == {"BoxMap"}  # of ranges


def test_no_two_rows_of_a_table_have_one_name():
    for table in TABLES:
        assert max(Counter(row.name for row in table.deciders).values()) == 1


def test_the_guide_shows_the_tables():
    page = Path(disting.__file__).parent / "guide" / "deciders.md"
    assert as_markdown() in page.read_text(encoding="utf-8")


def test_no_row_is_asked_after_one_that_decides():
    """Rows after it are not: here they would fail."""
    one, same = Chain(2, damped=True), Chain(2, 1, 1, 2, 1, 2, damped=True)
    broken = Decider("broken", Cost.SEARCH, "nowhere:at_all")
    rows = (*SAME_CHAINS.rows[:1], broken)
    assert first_finding(rows, one, same, Settings()).evidence == Theorem("duality")
    with pytest.raises(ImportError):
        first_finding(rows, one, Chain(2, dead_time=True), Settings())


def test_evidence_of_other_models_does_not_hold():
    """Each kind is found again for the models that its row is for."""
    one, same = Chain(2, damped=True), Chain(2, 1, 1, 2, 1, 2, damped=True)
    rows = deciders_of(Of.CHAINS)
    assert check(Theorem("duality"), rows, one, same)
    assert not check(Theorem("symmetry"), rows, one, same)
    assert not check(DeadTime(True), deciders_of(Of.NETWORKS), one, same)
    assert not check(Theorem("duality"), deciders_of(Of.NETWORKS), one, same)
    assert recheck(DeadTime(True), SAME_CHAINS.rows, one, same, Settings()) is None
    assert recheck(Theorem(GEARS), deciders_of(Of.MEASURED), one, same, Settings()) is None


def test_all_questions_and_kinds_of_models_have_tables():
    assert {t.asked for t in TABLES} == {*Asked} and {t.of for t in TABLES} == {*Of}
    assert {*OF_VERDICTS, *OF_INCLUSIONS, Asked.SHARE} == {*Asked}
    assert any(row.check.endswith(is_explicit.__name__) for row in deciders_of(Of.NETWORKS))
