"""The shipped catalogues: current to the byte, every evidence true, damage recognised."""

import json
import shutil

import pytest

from disting import CatalogError, Engine, Query, Relation, View, catalog
from disting.catalogs.build import build, false_evidence, verify, write
from disting.catalogs.files import PROVENANCE, lines, name_of, provenance_of, shipped_folder
from disting.decide.same.evidence_check import Witness
from disting.errors import InputError

SMALL = [(n, damped) for n in (1, 2, 3) for damped in (False, True)]
# seconds to minutes
LARGE = [
    pytest.param(n, damped, marks=pytest.mark.slow) for n in (4, 5) for damped in (False, True)
]


def stored_text(n, damped):
    return (shipped_folder() / f"{name_of(n, damped)}.jsonl").read_text(encoding="utf-8")


@pytest.mark.thin(2)
@pytest.mark.parametrize(("n", "damped"), SMALL + LARGE)
def test_rebuilding_gives_the_same_bytes(n, damped):
    assert lines(list(build(n, damped=damped, engine=Engine()).records)) == stored_text(n, damped)


@pytest.mark.thin(2)
@pytest.mark.parametrize(("n", "damped"), SMALL + LARGE)
def test_every_shipped_evidence_holds(n, damped):
    assert list(false_evidence(catalog(n, damped=damped))) == []


SAMPLES = {
    (4, False): [(2, 6), (2, 16), (6, 8), (11, 13), (14, 20), (22, 26)],
    (4, True): [(1, 29), (1, 2), (8, 19), (3, 17)],
    (5, False): [(7, 2), (18, 14), (1, 40), (64, 59)],
    (5, True): [(1, 73), (2, 30)],
}


@pytest.mark.thin(1)
@pytest.mark.parametrize(("n", "damped"), SAMPLES)
def test_some_pairs_are_decided_again_with_the_same_evidence(n, damped):
    """Pairs of every rule and relation, in all views."""
    c, witness, engine = catalog(n, damped=damped), Witness(), Engine()
    for left, right in map(sorted, SAMPLES[n, damped]):
        subjects = [engine.subject(f"{n}:{i}", c.family[i]) for i in (left, right)]
        for view in View:
            stored = c.verdict(left, right, view)
            assert engine.verdict(*subjects, Query(view)) == stored
            assert stored.evidence is None or witness.confirms(
                stored.evidence, stored.representation, *(s.chain for s in subjects)
            )


def test_provenance_names_the_digest_of_every_file():
    stored = json.loads((shipped_folder() / PROVENANCE).read_text())
    assert stored["files"] == provenance_of(shipped_folder())["files"]
    assert len(stored["files"]) == 41


@pytest.mark.full
def test_verify_finds_one_altered_evidence(tmp_path):
    shutil.copytree(shipped_folder(), tmp_path, dirs_exist_ok=True)
    (tmp_path / PROVENANCE).unlink()  # it would refuse the file at once
    path = tmp_path / "chains-3-damped.jsonl"
    path.write_text(path.read_text().replace('"left":6,"right":7', '"left":7,"right":6', 1))
    wrong = verify(3, damped=True, folder=tmp_path, engine=Engine())
    assert any("not what is computed now" in sentence for sentence in wrong)
    assert any("evidence of condition" in sentence for sentence in wrong)


@pytest.mark.parametrize(
    "text",
    ["", "{}\n", "no json\n", '{"schema": 99, "models": 0}\n', '{"schema": 1, "models": 11}\n'],
)
def test_damaged_files_are_refused_with_the_remedy(tmp_path, text):
    (tmp_path / "chains-3-undamped.jsonl").write_text(text)
    with pytest.raises(CatalogError, match="disting catalog build"):
        catalog(3, folder=tmp_path, damped=False)


@pytest.mark.parametrize(
    ("sound", "damaged"),
    [
        ('"kind":"ranks"', '"kind":"other"'),
        ('"evidence":{', '"evidence":null,"was":{'),
        ('"certainty":"bounded"', '"certainty":"sure"'),
        ('"rows":[', '"lines":['),
    ],
)
def test_damaged_pairs_are_named_with_the_remedy(tmp_path, sound, damaged):
    """What no sum tells: the file is complete and JSON, a record is no record."""
    header, *records = (shipped_folder() / "chains-3-damped.jsonl").read_text().splitlines()
    pairs = [text.replace(sound, damaged) for text in records[11:]]
    assert pairs != records[11:]
    (tmp_path / "chains-3-damped.jsonl").write_text("\n".join([header, *records[:11], *pairs, ""]))
    with pytest.raises(
        CatalogError, match=r"chains-3-damped, \d+:\d+ cannot be read .* 'disting catalog build'"
    ):
        list(catalog(3, damped=True, folder=tmp_path).pairs())


@pytest.mark.parametrize(
    "change", [lambda pairs: pairs[::-1], lambda pairs: [pairs[0], pairs[0], *pairs[2:]]]
)
def test_pairs_in_disorder_are_refused(tmp_path, change):
    text = (shipped_folder() / "chains-3-undamped.jsonl").read_text().splitlines()
    (tmp_path / "chains-3-undamped.jsonl").write_text(
        "\n".join([*text[:12], *change(text[12:]), ""])
    )
    with pytest.raises(CatalogError, match="incomplete"):
        catalog(3, folder=tmp_path, damped=False)


def test_missing_catalogues_are_named():
    with pytest.raises(CatalogError, match="1 to 5 masses"):
        catalog(6, damped=False)


def test_look_up_in_any_order_and_bad_pairs():
    c = catalog(4, damped=False)
    assert c.verdict(13, 11) == c.verdict(11, 13)
    assert c.verdict(11, 13, View.EXACT).decided_by == "7"
    assert (c.verdict(28, 29).left, c.verdict(28, 29).right) == ("4:28", "4:29")
    for pair in ((1, 1), (0, 1), (1, 30), (-1, 2)):
        with pytest.raises(InputError, match="1 to 29"):
            c.verdict(*pair)


@pytest.mark.full
def test_tables_agree_with_the_verdicts():
    c = catalog(3, damped=True)
    matrix = c.matrix()
    assert matrix.shape == (11, 11)
    assert matrix.loc[2, 5] == matrix.loc[5, 2] == "indistinguishable"
    assert all(matrix.loc[i, i] == "" for i in range(1, 12))
    models = c.models()
    assert models.loc[7, "rank"] == 6
    assert list(models.index[models["collocated"]]) == [1, 4, 6, 8, 11]
    assert c.classes(View.COMBINED) == ((2, 5), (9, 10))
    assert c.classes() == ((1, 11), (2, 5), (9, 10))
    assert [r.group for r in c.rows] == [1, 2, 0, 0, 2, 0, 0, 0, 3, 3, 1]


def test_csv_and_json_hold_every_pair():
    c = catalog(3, damped=False)
    rows = c.to_csv().splitlines()
    assert rows[0].startswith(
        "left,right,relation,decided_by,representation,certainty,error_bound,domain,image,closure,"
    )
    assert rows[0].endswith(",left_positive,right_positive,damped,quantity")
    assert all(row.endswith(",false,acceleration") for row in rows[1:])
    assert len(rows) == 1 + 55
    data = json.loads(c.to_json(View.TF))
    assert len(data["verdicts"]) == 55
    assert {v["relation"] for v in data["verdicts"]} == {
        Relation.DISTINGUISHABLE,
        Relation.INDISTINGUISHABLE,
    }


def test_evidence_of_an_unknown_name_is_damage_when_it_is_read(tmp_path):
    """It was a KeyError when its sentence was asked for."""
    name = "chains-3-undamped.jsonl"
    text = (shipped_folder() / name).read_text(encoding="utf-8")
    assert '"Foster"' in text
    (tmp_path / name).write_text(text.replace('"Foster"', '"FostNer"'), encoding="utf-8")
    with pytest.raises(CatalogError, match="cannot be read"):
        catalog(3, folder=tmp_path, damped=False).to_json()


@pytest.mark.full
def test_writing_leaves_no_partial_files(tmp_path):
    paths = write([build(2, damped=False, engine=Engine())], tmp_path)
    assert [p.name for p in paths] == ["chains-2-undamped.jsonl", "provenance.json"]
    assert sorted(p.name for p in tmp_path.iterdir()) == sorted(p.name for p in paths)


@pytest.mark.thin(2)
@pytest.mark.parametrize(
    ("n", "damped", "left_open"),
    [(2, True, 0), (3, True, 0), (4, False, 0), (4, True, 0), (5, False, 0), (5, True, 0)],
)
def test_the_exact_decision_leaves_nothing_open(n, damped, left_open):
    c = catalog(n, damped=damped)
    counts = c.counts(View.EXACT)
    assert counts[""] == left_open
    assert counts["exact"] == c.counts(View.COMBINED)[""] - left_open


def test_what_the_exact_decision_says_and_how_surely():
    c = catalog(3, damped=True)
    assert c.verdict(1, 11, View.COMBINED).relation is Relation.UNDECIDED
    dual, apart = c.verdict(1, 11, View.EXACT), c.verdict(1, 6, View.EXACT)
    assert (dual.relation, dual.decided_by, dual.certainty) == (
        Relation.INDISTINGUISHABLE,
        "exact",
        "theorem",
    )
    assert (apart.relation, apart.certainty) == (Relation.DISTINGUISHABLE, "bounded")
    assert apart.safety >= 100
