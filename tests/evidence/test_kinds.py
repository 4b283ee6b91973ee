"""Every kind of evidence is registered, is called once, and is read only where it may stand."""

import importlib
import inspect
import pkgutil
from typing import get_args

import pytest

import disting.evidence
from disting.evidence.conditions import Counts
from disting.evidence.decision import Theorem
from disting.evidence.general import AtInverse, NoEquivalent, Replacement
from disting.evidence.ideals import ByRows, RowStep, Solutions, Vanishing
from disting.evidence.kind import read
from disting.evidence.kinds import (
    Evidence,
    InclusionEvidence,
    evidence_from,
    inclusion_evidence_from,
)
from disting.evidence.limits import LargerProjection, Minor, MissingElements, RelativeDegrees
from disting.evidence.positive import EmptyFibre, Interlacing, PositiveEvidence, RowWords

UNIONS = [set(get_args(union)) for union in (Evidence, InclusionEvidence, PositiveEvidence)]


def written():
    """Every class of the package that is a kind of evidence."""
    modules = [
        importlib.import_module(f"disting.evidence.{m.name}")
        for m in pkgutil.iter_modules(disting.evidence.__path__)
    ]
    classes = {c for m in modules for _, c in inspect.getmembers(m, inspect.isclass)}
    return {
        c for c in classes if c.__module__.startswith("disting.evidence") and hasattr(c, "kind")
    }


def test_each_kind_is_registered():
    """Of a part alone speaks `Vanishing`, which stands inside of `ByRows`."""
    assert written() - set.union(*UNIONS) == {Vanishing}


@pytest.mark.parametrize("union", UNIONS)
def test_no_two_kinds_of_one_statement_have_one_name(union):
    assert len({kind.kind for kind in union}) == len(union)


def test_what_belongs_to_another_statement_is_refused():
    projection = LargerProjection(("b0",), 2, 1)
    assert inclusion_evidence_from(projection.to_dict()) == projection
    with pytest.raises(KeyError):
        evidence_from(projection.to_dict())
    with pytest.raises(KeyError):
        inclusion_evidence_from(Theorem("duality").to_dict())
    with pytest.raises(KeyError):
        read(Counts((1, 2), (2, 2)).to_dict(), get_args(PositiveEvidence))


@pytest.mark.parametrize(
    ("found", "plain"),
    [
        (Theorem("duality"), {"kind": "theorem", "name": "duality"}),
        (EmptyFibre((("m1", "1/2"),)), {"kind": "no-equivalent", "point": (("m1", "1/2"),)}),
        (
            ByRows(
                True,
                (
                    RowStep("same", "free", Vanishing(3)),
                    RowStep("rigid", "free", Solutions(True, ("x",), ((1, 2),))),
                ),
            ),
            {
                "kind": "by-parts",
                "left_given": True,
                "steps": [
                    {"split": "same", "part": "free", "kind": "vanishing", "index": 3},
                    {
                        "split": "rigid",
                        "part": "free",
                        "kind": "solved",
                        "left_given": True,
                        "labels": ("x",),
                        "solutions": ((1, 2),),
                    }
                    | {"is_normalised": False},
                ],
            },
        ),
        (
            Interlacing((RowWords("free", 3, (1, 2), (1, 3), ((0, 2),)),)),
            {
                "kind": "interlacing",
                "parts": (
                    {
                        "part": "free",
                        "nodes": 3,
                        "given": (1, 2),
                        "other": (1, 3),
                        "lacking": ((0, 2),),
                    },
                ),
                "with_one": (),
                "without": (),
            },
        ),
    ],
)
def test_files_have_this_form_and_it_is_read_back(found, plain):
    assert found.to_dict() == plain
    assert read(plain, set.union(*UNIONS)) == found


def test_limits_have_their_formulas():
    assert MissingElements(True, ((0, 0), (1, 2))).formula == "0 → 0, 1 → 2"
    assert Minor(True, ((1, 1), (3, 2)), ("k12",), ()).formula == "1 → 1, 3 → 2"
    assert Minor(True, (), ("k12",), ("k23",)).formula == "k12 missing, k23 rigid"
    steep = "deg D₂ − deg N₂ ≥ 4 > 2 = deg D₁ − deg N₁"
    assert RelativeDegrees(True, 4, 2).formula == RelativeDegrees(False, 2, 4).formula == steep
    assert RelativeDegrees(True, 2, 4).formula == "deg D₂ − deg N₂ = 2 < 4 ≤ deg D₁ − deg N₁"


def test_steps_that_are_no_list_are_refused():
    plain = ByRows(True, (RowStep("free", "free", Vanishing(2)),)).to_dict()
    assert ByRows.from_dict(plain).to_dict() == plain
    with pytest.raises(TypeError, match="the steps are a list"):
        ByRows.from_dict(plain | {"steps": "free"})


def test_a_name_that_no_theorem_has_is_refused():
    with pytest.raises(ValueError, match="no theorem is called"):
        evidence_from({"kind": "theorem", "name": "wishful"})
    assert evidence_from(Solutions(True, ("a",), ((1, 2),)).to_dict()) == Solutions(
        True, ("a",), ((1, 2),)
    )


def test_evidence_inside_evidence_is_written_read_and_turned_with_it():
    inner = NoEquivalent("positive", True, ("p0 < 0",))
    outer = AtInverse("a", "b", Replacement("c", "d", True, False, inner))
    replaced = {"kind": "replaced", "left": "c", "right": "d"}
    larger = {"left_larger": True, "right_larger": False, "inner": inner.to_dict()}
    plain = {"kind": "at-inverse", "left": "a", "right": "b", "inner": replaced | larger}
    assert outer.to_dict() == plain and AtInverse.from_dict(plain) == outer
    turned = Replacement("d", "c", False, True, NoEquivalent("positive", False, ("p0 < 0",)))
    assert outer.turned == AtInverse("b", "a", turned)
