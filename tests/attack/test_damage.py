"""Damaged caches and catalogues: the true result, or a refusal; and what is exported reads back
as it was.
"""

import csv
import io
import json
import warnings

import pytest

from disting.catalogs import catalog
from disting.catalogs.dampers import read as read_dampers
from disting.catalogs.files import shipped_folder
from disting.cli import main
from disting.errors import CatalogError
from disting.model.question import Domain
from disting.store.store import CacheWarning
from tests.attack.counts import chance, times
from tests.attack.measured_files import with_bytes_changed
from tests.cli.process import disting

pytestmark = pytest.mark.attack
ASK = ["verdicts", "2", "--damped", "--json", "-"]
BYTES = bytes(range(256))


def damaged(draw, content):
    """A copy with bytes changed, a cut, or a part overwritten."""
    at = draw.randrange(len(content))
    length = draw.randrange(1, 5000)
    kinds = (
        lambda: with_bytes_changed(draw, content, 0, BYTES),
        lambda: content[:at],
        lambda: (
            content[:at] + draw.randbytes(min(length, len(content) - at)) + content[at + length :]
        ),
        lambda: content[:at] + content[at + length :],
    )
    return draw.choice(kinds)()


def test_caches(tmp_path, monkeypatch, counts, capsys):
    draw, path = chance("caches"), tmp_path / "cache.sqlite3"
    monkeypatch.setenv("DISTING_CACHE", str(path))
    assert main(ASK) == main(ASK) == 0
    reference, content = capsys.readouterr().out.splitlines()[0], path.read_bytes()
    for _ in range(times(300)):
        for old in tmp_path.iterdir():
            old.unlink()
        path.write_bytes(damaged(draw, content))
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", CacheWarning)
            assert main(ASK) == 0
        counts["damaged caches"] += 1
        counts["wrong"] += capsys.readouterr().out.splitlines() != [reference]
    assert not counts["wrong"]


def told(folder, damped):
    """All verdicts of a catalogue as text."""
    return catalog(2, damped=damped, folder=folder).to_json()


@pytest.mark.parametrize("damped", [False, True])
def test_catalogues(tmp_path, counts, damped):
    """A catalogue of one's own has no digest: changed letters may change what it says, 'catalog
    verify' tells; nothing else.
    """
    name = f"chains-2-{'damped' if damped else 'undamped'}.jsonl"
    draw, content, reference = (
        chance(name),
        (shipped_folder() / name).read_bytes(),
        told(None, damped),
    )
    for _ in range(times(1000)):
        (tmp_path / name).write_bytes(damaged(draw, content))
        counts["damaged catalogues"] += 1
        try:
            counts[
                "accepted, same" if told(tmp_path, damped) == reference else "accepted, other"
            ] += 1
        except CatalogError:
            counts["refused"] += 1


def test_classes_with_dampers(tmp_path, counts):
    name = "dampers-3-damped.jsonl"
    draw, content = chance(name), (shipped_folder() / name).read_bytes()
    reference = list(read_dampers(shipped_folder(), 3, True).csv_lines())
    for _ in range(times(100)):
        (tmp_path / name).write_bytes(damaged(draw, content))
        counts["damaged files"] += 1
        try:
            found = list(read_dampers(tmp_path, 3, True).csv_lines())
            counts["accepted, same" if found == reference else "accepted, other"] += 1
        except CatalogError:
            counts["refused"] += 1


def plainly(entry):
    """As CSV has it: of which positive models have an equivalent, the share alone."""
    return entry.get("share", "") if isinstance(entry, dict) else str(entry or "")


@pytest.mark.parametrize("domain", list(Domain))
def test_verdicts_as_csv_and_json_say_the_same(tmp_path, counts, domain):
    where = ("--csv", tmp_path / "a.csv", "--json", tmp_path / "a.json")
    assert disting("verdicts", "1-2", "--domain", domain.value, *where, "--damped").returncode == 0
    table = list(csv.DictReader(io.StringIO((tmp_path / "a.csv").read_text(encoding="utf-8"))))
    plain = json.loads((tmp_path / "a.json").read_text(encoding="utf-8"))["verdicts"]
    shared = [name for name in table[0] if name in plain[0] and name not in ("image", "closure")]
    assert [[row[n] for n in shared] for row in table] == [
        [plainly(v[n]) for n in shared] for v in plain
    ]
    assert {"left", "right", "relation", "decided_by", "domain"} <= set(shared)
    counts["pairs read back"] += len(table)


@pytest.mark.parametrize("n", [1, 2, 3])
@pytest.mark.parametrize("damped", [False, True])
def test_catalogues_as_csv_and_json_say_the_same(counts, n, damped):
    found = catalog(n, damped=damped)
    table = list(csv.DictReader(io.StringIO(found.to_csv())))
    plain = json.loads(found.to_json())["verdicts"]
    told = [(i, j, v.relation, v.decided_by) for i, j, v in found.pairs()]
    names = ("left", "right", "relation", "decided_by")
    assert [tuple(str(v[name] or "") for name in names) for v in plain] == [
        tuple(map(str, row)) for row in told
    ]
    assert [tuple(row[name] for name in names) for row in table] == [
        tuple(map(str, row)) for row in told
    ]
    counts["pairs read back"] += len(told)
