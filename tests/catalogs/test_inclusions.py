"""Catalogue records of inclusions: both senses are kept, read and checked again."""

import copy

import pytest

from disting import Engine
from disting.catalogs.build import build, false_evidence
from disting.catalogs.catalog import Catalog
from disting.errors import CatalogError


@pytest.fixture(scope="module")
def records():
    return build(2, damped=True, engine=Engine()).records


def altered(records, change):
    """The catalogue with one change in the inclusions of the pair 1, 2."""
    copied = copy.deepcopy(list(records))
    change(next(r for r in copied if (r.get("left"), r.get("right")) == (1, 2))["inclusions"])
    return Catalog.from_records(copied)


@pytest.mark.full
def test_both_senses_are_told(records):
    stored = Catalog.from_records(records)
    told = [r["inclusions"] for r in records if "inclusions" in r]
    assert len(told) == 2 and any(set(t) == {"closure", "image"} for t in told)
    for i, j, v in stored.pairs():
        assert (v.inclusions is not None) == (stored.rows[i - 1].rank != stored.rows[j - 1].rank)
    header, *rows = stored.to_csv().splitlines()
    assert header.split(",")[8:10] == ["image", "closure"]
    told = [
        ["" if x == "unknown" else x.value for x in (v.image, v.closure)]
        for _, _, v in stored.pairs()
    ]
    assert [row.split(",")[8:10] for row in rows] == told
    assert not list(false_evidence(stored))


@pytest.mark.full
def test_false_inclusions_are_found_out(records):
    def other_evidence(told):
        told["closure"]["evidence"] = {"kind": "counts", "left": [2, 2], "right": [1, 2]}
        told["closure"]["inclusion"] = "neither"
        told.pop("image", None)

    false = list(false_evidence(altered(records, other_evidence)))
    assert false and all("the evidence of the inclusion" in sentence for sentence in false)


def test_evidence_of_finite_elements_is_not_read_as_one_of_limits(records):
    def of_finite_elements(told):
        told["closure"] = told["image"] = {
            "inclusion": "neither", "certainty": "proven", "safety": 0, "reason": "",
            "evidence": {"kind": "relative-degrees", "left_is_larger": False, "left": 4, "right": 2},
        }  # fmt: skip

    with pytest.raises(CatalogError, match="cannot be read"):
        altered(records, of_finite_elements).verdict(1, 2)
