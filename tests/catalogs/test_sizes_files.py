"""The shipped verdicts on pairs of two sizes: as computed now, as compare says, complete, and
refused where they are damaged.
"""

import json
from itertools import combinations
from pathlib import Path
from random import Random

import pytest

from disting import CatalogError, Engine, Inclusion, InputError, Relation, View, catalog, compare
from disting.catalogs.files import lines, shipped_folder
from disting.catalogs.sizes import (
    VIEWS,
    SizesCatalog,
    build_sizes,
    combine,
    false_evidence,
    sizes_catalog,
    verify_sizes,
    write,
)
from disting.conditions.inclusion import Sense

DAMPINGS = pytest.mark.parametrize("damped", [False, True], ids=["undamped", "damped"])


@pytest.fixture(scope="module")
def both() -> dict[bool, SizesCatalog]:
    return {damped: sizes_catalog(damped=damped) for damped in (False, True)}


def _copied(found: SizesCatalog, folder: Path, *, size: int = 1, **changes: object) -> Path:
    """The file in a folder of its own, one record changed."""
    records = [dict(r) for r in found.records]
    records[size] |= changes
    (folder / f"{found.name}.jsonl").write_text(lines(records), encoding="utf-8")
    return folder


@pytest.mark.full
@DAMPINGS
def test_every_pair_of_the_models_of_one_to_five_masses_is_there(
    both: dict[bool, SizesCatalog], damped: bool
) -> None:
    found = both[damped]
    counts = [1, 3, 11, 29, 73]
    assert list(found.names) == [
        f"{n}:{i}" for n, k in enumerate(counts, 1) for i in range(1, k + 1)
    ]
    assert len(found.records) == 1 + (117 * 116 - sum(k * (k - 1) for k in counts)) // 2


@pytest.mark.full
@DAMPINGS
def test_small_sizes_are_as_computed_now(both: dict[bool, SizesCatalog], damped: bool) -> None:
    computed, found = combine((1, 2, 3), damped=damped), both[damped]
    for i, j in combinations(range(len(computed.subjects)), 2):
        now, stored = computed.verdict(i, j), found.verdict(j + 1, i + 1)
        assert (stored.left, stored.right) == (now.left, now.right)
        assert (stored.relation, stored.decided_by, stored.evidence, stored.domain) == (
            now.relation,
            now.decided_by,
            now.evidence,
            now.domain,
        )
        assert stored.inclusions == now.inclusions
        assert found.relation(i + 1, j + 1) is now.relation
        assert stored.closure is computed.inclusion(i, j, Sense.CLOSURE)


@pytest.mark.full
@DAMPINGS
def test_lines_of_small_sizes_are_those_of_the_file(
    both: dict[bool, SizesCatalog], damped: bool, tmp_path: Path
) -> None:
    """Whatever else a file holds; the verdicts on pairs of one size are those of a folder."""
    found, text = both[damped], build_sizes(damped=damped, engine=Engine(), sizes=(1, 2, 3))
    path = write(text, damped, tmp_path / "new")
    assert path.name == f"{found.name}.jsonl" and path.read_text(encoding="utf-8") == text
    header, *rows = text.splitlines()
    small = {"1:", "2:", "3:"}
    stored = [r for r in found.records[1:] if {r["left"][:2], r["right"][:2]} <= small]
    assert len(rows) == 1 * 3 + 1 * 11 + 3 * 11
    assert "\n".join(rows) == lines(stored).strip()
    assert json.loads(header) == dict(found.records[0]) | {"models": 15}


@pytest.mark.full
def test_a_folder_without_the_file_has_nothing_wrong(tmp_path: Path) -> None:
    assert verify_sizes(damped=False, folder=tmp_path, engine=Engine()) == []


@pytest.mark.full
def test_a_file_without_its_end_is_refused(both: dict[bool, SizesCatalog], tmp_path: Path) -> None:
    text = lines([dict(r) for r in both[False].records[:-1]])
    (tmp_path / "sizes-undamped.jsonl").write_text(text, encoding="utf-8")
    with pytest.raises(CatalogError, match="pairs are missing"):
        sizes_catalog(folder=tmp_path, known=both[False].catalogs, damped=False)


@pytest.mark.full
def test_a_verdict_that_is_damaged_behind_its_relation_is_refused_when_it_is_read(
    both: dict[bool, SizesCatalog],
) -> None:
    records = list(both[False].records)
    records[1] = {**records[1], "tf": {**records[1]["tf"], "evidence": {"kind": "?"}}}
    damaged = SizesCatalog(both[False].catalogs, records)
    assert damaged.relation(1, 2) is Relation.DISTINGUISHABLE
    with pytest.raises(CatalogError, match=r"1:1 and 2:1 cannot be read .*disting catalog sizes"):
        damaged.verdict(1, 2)
    assert damaged.verdict(1, 3) == both[False].verdict(1, 3)


@pytest.mark.full
@pytest.mark.parametrize(("damped", "count"), [(False, 8), (True, 4)])
def test_large_sizes_are_as_compare_says(
    both: dict[bool, SizesCatalog], damped: bool, count: int
) -> None:
    engine, random = Engine(), Random(3)
    for _ in range(count):
        i, j = sorted(random.sample(range(5, 118), 2))
        stored = both[damped].verdict(i, j)
        now = compare(stored.left, stored.right, damped=damped, engine=engine)
        assert (stored.relation, stored.decided_by, stored.closure) == (
            now.relation,
            now.decided_by,
            now.closure,
        )


@pytest.mark.full
@DAMPINGS
def test_what_is_open_is_open_of_four_in_five_damped_masses_only(
    both: dict[bool, SizesCatalog], damped: bool
) -> None:
    found = both[damped]
    unknown = [
        (found.size(i), found.size(j))
        for i, j in combinations(range(1, 118), 2)
        if found.size(i) != found.size(j) and found.verdict(i, j).closure is Inclusion.UNKNOWN
    ]
    assert unknown == [(4, 5)] * (1126 if damped else 0)


@pytest.mark.full
@DAMPINGS
def test_models_of_two_sizes_are_distinguishable_in_every_view(
    both: dict[bool, SizesCatalog], damped: bool
) -> None:
    found = both[damped]
    for view in VIEWS:
        assert {
            found.relation(i, j, view)
            for i, j in combinations(range(1, 118), 2)
            if found.size(i) != found.size(j)
        } == {Relation.DISTINGUISHABLE}


@pytest.mark.full
@DAMPINGS
def test_the_counts_of_one_to_four_masses(both: dict[bool, SizesCatalog], damped: bool) -> None:
    found, inside = both[damped], 441 if damped else 417
    told = [
        found.verdict(i, j).closure
        for i, j in combinations(range(1, 45), 2)
        if found.size(i) != found.size(j)
    ]
    assert told.count(Inclusion.LEFT_IN_RIGHT) == inside
    assert told.count(Inclusion.NEITHER) == 482 - inside


@pytest.mark.full
@DAMPINGS
def test_groups_are_those_of_each_size(both: dict[bool, SizesCatalog], damped: bool) -> None:
    found, view = both[damped], View.POSITIVE
    named = {tuple(found.names[m - 1] for m in group) for group in found.classes(view)}
    assert named == {
        tuple(f"{n}:{m}" for m in group)
        for n in range(1, 6)
        for group in catalog(n, damped=damped).classes(view)
    }
    pairs = [(found.names[i - 1], found.names[j - 1]) for i, j in found.depending()]
    assert ("4:2", "4:6") in pairs or damped


@pytest.mark.full
def test_a_small_part_of_the_evidence_holds_by_itself(both: dict[bool, SizesCatalog]) -> None:
    for found in both.values():
        part = SizesCatalog(found.catalogs[:3], found.records)
        assert list(false_evidence(part)) == []


@pytest.mark.full
def test_false_evidence_is_found(both: dict[bool, SizesCatalog]) -> None:
    records = [json.loads(json.dumps(r)) for r in both[False].records]
    records[1]["tf"]["evidence"]["right"] = [4, 4]
    records[2]["inclusions"]["closure"]["evidence"]["parts"][0][2] = []
    told = list(false_evidence(SizesCatalog(both[False].catalogs[:2], tuple(records))))
    assert [line.partition(": ")[0] for line in told] == [
        "sizes-undamped, 1:1 and 2:1",
        "sizes-undamped, 1:1 and 2:2",
    ]


@pytest.mark.full
def test_the_papers_views_and_other_models_are_refused(both: dict[bool, SizesCatalog]) -> None:
    with pytest.raises(InputError, match="no verdicts of the view tf"):
        both[False].verdict(1, 2, View.TF)
    for wrong in ((1, 1), (0, 1), (1, 118)):
        with pytest.raises(InputError, match="two different models 1 to 117"):
            both[False].relation(*wrong)


@pytest.mark.full
@pytest.mark.parametrize(
    "changes",
    [{"left": "2:1"}, {"tf": {}}, {"tf": {"relation": "indistinguishable"}}, {"tf": None}],
    ids=str,
)
def test_what_is_damaged_is_refused(
    both: dict[bool, SizesCatalog], tmp_path: Path, changes: dict[str, object]
) -> None:
    with pytest.raises(CatalogError, match="disting catalog sizes"):
        sizes_catalog(
            folder=_copied(both[False], tmp_path, **changes),
            known=both[False].catalogs,
            damped=False,
        )


@pytest.mark.full
def test_another_schema_and_no_file_are_said(
    both: dict[bool, SizesCatalog], tmp_path: Path
) -> None:
    with pytest.raises(CatalogError, match="make it with 'disting catalog sizes'"):
        sizes_catalog(folder=tmp_path, damped=False)
    with pytest.raises(CatalogError, match="another schema"):
        sizes_catalog(folder=_copied(both[False], tmp_path, size=0, schema=0), damped=False)


@pytest.mark.slow
def test_rebuilding_gives_the_same_bytes_and_all_evidence_holds() -> None:
    """Damped it takes a quarter of an hour: `disting catalog verify 1 2 3 4 5`."""
    assert verify_sizes(damped=False, folder=shipped_folder(), engine=Engine()) == []


@pytest.mark.slow
def test_all_evidence_of_damped_pairs_holds(both: dict[bool, SizesCatalog]) -> None:
    assert list(false_evidence(both[True])) == []
