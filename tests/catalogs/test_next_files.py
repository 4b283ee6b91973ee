"""The shipped answers to what to measure next, and their files."""

import json
from itertools import combinations

import pytest

from disting.catalogs import catalog
from disting.catalogs.dampers import damper_catalog
from disting.catalogs.files import shipped_folder
from disting.catalogs.next_files import (
    SHIPPED_SIZES,
    build_next,
    name_of,
    next_catalog,
    read,
    verify_next,
    write,
)
from disting.cli import main
from disting.errors import CatalogError
from disting.verdict.engine import Engine
from disting.verdict.next_experiments import menu_for
from disting.verdict.next_words import to_dict
from disting.verdict.result import View

FAMILIES = [(n, damped) for n in SHIPPED_SIZES for damped in (False, True)]
DAMPED_OR_NOT = pytest.mark.parametrize("damped", [False, True])


@pytest.mark.thin(3)
@pytest.mark.parametrize(("n", "damped"), FAMILIES)
def test_every_group_of_every_catalogue_is_there(n, damped):
    stored, found = catalog(n, damped=damped), next_catalog(n, damped=damped)
    assert found.groups == stored.classes(View.EXACT)
    for members in found.groups:
        whole = found.further(members)
        assert whole is not None and whole.structures == tuple(stored.family[m] for m in members)


@pytest.mark.full
@pytest.mark.parametrize("damped", [False, True])
def test_shipped_bytes_are_what_is_computed(damped):
    assert verify_next(catalog(3, damped=damped), shipped_folder(), Engine()) == []


@pytest.mark.slow
@pytest.mark.parametrize(("n", "damped"), FAMILIES)
def test_all_shipped_bytes_are_what_is_computed(n, damped):
    assert verify_next(catalog(n, damped=damped), shipped_folder(), Engine()) == []


@DAMPED_OR_NOT
def test_every_group_with_dampers_to_the_ground_is_there(damped):
    stored = damper_catalog(3, damped=damped)
    found = next_catalog(3, damped=damped, dampers=True)
    names = [tuple(found.named(i)[0] for i in group) for group in found.groups]
    every = [tuple(stored.text(stored.place(m)) for m in members) for members in stored.classes()]
    assert names == [group for group in every if "+" in "".join(group)]
    for group in found.groups:
        whole = found.further(group)
        assert whole.structures == tuple(stored.found.chains[i] for i in group)
        assert not any(table.decided.open for table in whole.tables.values())


@pytest.mark.slow
@DAMPED_OR_NOT
def test_all_bytes_with_dampers_to_the_ground_are_what_is_computed(damped):
    assert verify_next(damper_catalog(3, damped=damped), shipped_folder(), Engine()) == []


@pytest.mark.full
def test_a_group_with_dampers_to_the_ground_is_what_is_computed():
    stored = next_catalog(3, damped=False, dampers=True)
    numbers = [stored.number(1, (1,)), stored.number(4, (2,))]
    assert stored.group(numbers[0]) == tuple(numbers)
    fresh = menu_for([stored.named(i) for i in numbers], Engine())
    assert stored.further(numbers).tables == fresh.tables
    assert stored.further(numbers).names == ("3:1+b1", "3:4+b2")


def test_five_masses_are_looked_up():
    """The group of 16 that one force and one sensor at one place cannot tell apart."""
    found = next_catalog(5, damped=False).further((1, 73))
    assert found.names == ("5:1", "5:73") and all(found.anywhere(kind) for kind in found.kinds)
    assert len(next_catalog(5, damped=False).group(1)) == 16


@pytest.mark.full
def test_a_pair_out_of_a_group_is_what_is_computed_of_the_pair():
    """In either order."""
    stored, family = next_catalog(3, damped=False), catalog(3, damped=False).family
    engine = Engine()
    for pair in ((8, 11), (11, 8), (4, 1)):
        said = stored.further(pair)
        fresh = menu_for([(f"3:{m}", family[m]) for m in pair], engine)
        assert said is not None
        assert [r["relation"] for r in to_dict(said)["pairs"]] == [
            r["relation"] for r in to_dict(fresh)["pairs"]
        ]
        assert to_dict(said)["least"] == to_dict(fresh)["least"]


def test_no_pair_of_two_groups():
    found = next_catalog(3, damped=True)
    assert found.further((1, 2)) is None and found.further((1,)) is None
    assert found.further((3, 4)) is None
    assert found.group(3) == (3,) and found.group(11) == (1, 11)


def test_more_structures_are_never_told_apart_by_less():
    """What is enough for a group is enough for each of its pairs."""
    for n, damped in FAMILIES[:4]:
        stored = next_catalog(n, damped=damped)
        for group in stored.groups:
            whole = stored.further(group)
            for pair in combinations(group, 2):
                part = stored.further(pair)
                assert {k for k in whole.kinds if whole.anywhere(k)} <= {
                    k for k in part.kinds if part.anywhere(k)
                }


@pytest.mark.full
def test_the_command_writes_what_is_shipped(tmp_path, capsys):
    assert main(["catalog", "next", "2", "--out", str(tmp_path), "--no-cache"]) == 0
    names = [f"{name_of(2, damped)}.jsonl" for damped in (False, True)]
    assert capsys.readouterr().out.split() == [str(tmp_path / name) for name in names]
    for name in names:
        assert (tmp_path / name).read_bytes() == (shipped_folder() / name).read_bytes()


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda header, rows: [header | {"schema": 0}, *rows], "another schema"),
        (lambda header, rows: [header], "groups are missing"),
        (lambda header, rows: [], "make it with 'disting catalog next 2'"),
    ],
    ids=["schema", "groups", "empty"],
)
def test_a_file_of_another_kind_is_refused(tmp_path, change, said):
    path = shipped_folder() / f"{name_of(2, False)}.jsonl"
    header, *rows = map(json.loads, path.read_text(encoding="utf-8").splitlines())
    text = "".join(json.dumps(row) + "\n" for row in change(header, rows))
    (tmp_path / path.name).write_text(text, encoding="utf-8")
    with pytest.raises(CatalogError, match=said):
        read(tmp_path, 2, False)


def test_a_missing_file_is_named(tmp_path):
    with pytest.raises(CatalogError, match=r"there is no .*next-2-damped.jsonl; make it with"):
        read(tmp_path, 2, True)


@pytest.mark.full
def test_a_damaged_file_is_refused(tmp_path):
    text = build_next(catalog(2, damped=False), Engine())
    path = write(text, tmp_path)
    assert path.name == f"{name_of(2, False)}.jsonl" and read(tmp_path, 2, False).groups == (
        (1, 3),
    )
    path.write_text(text.replace("n", "r"), encoding="utf-8")
    with pytest.raises(CatalogError, match="damaged"):
        read(tmp_path, 2, False)


@pytest.mark.parametrize("spoil", ["gains", "classes", "columns", "links", "open", "safety"])
def test_a_record_without_its_masses_is_refused(spoil, tmp_path):
    records = [
        json.loads(line) for line in build_next(catalog(2, damped=False), Engine()).splitlines()
    ]
    records[1]["sensor"][spoil] = {"safety": "x", "open": [1]}.get(spoil, [])
    text = "".join(json.dumps(r) + "\n" for r in records)
    (tmp_path / f"{name_of(2, False)}.jsonl").write_text(text, encoding="utf-8")
    with pytest.raises(CatalogError, match="cannot be read"):
        read(tmp_path, 2, False).further((1, 3))


def test_verification_finds_a_wrong_line(tmp_path):
    records = [
        json.loads(line) for line in build_next(catalog(2, damped=False), Engine()).splitlines()
    ]
    records[1]["sensor"]["safety"] += 1
    write("".join(json.dumps(r, separators=(",", ":")) + "\n" for r in records), tmp_path)
    (said,) = verify_next(catalog(2, damped=False), tmp_path, Engine())
    assert "line 2 is not what is computed now" in said
