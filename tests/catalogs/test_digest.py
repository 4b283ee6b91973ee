"""Catalogue files are what their provenance names, or they are not believed."""

import random
import shutil

import pytest

from disting import CatalogError, catalog
from disting.catalogs.files import shipped_folder
from disting.files import intact_text


def damaged(folder, source):
    """Change one digit of one record: the file stays JSON, and mostly a catalogue."""
    path = folder / "chains-3-undamped.jsonl"
    content = bytearray((shipped_folder() / path.name).read_bytes())
    at = source.choice([i for i, byte in enumerate(content) if 48 <= byte <= 57])
    content[at] = 48 + (content[at] - 47) % 10
    path.write_bytes(content)


@pytest.mark.full
def test_a_damaged_file_is_named_with_a_remedy(tmp_path):
    shutil.copy(shipped_folder() / "provenance.json", tmp_path)
    source = random.Random(7)
    for _ in range(50):
        damaged(tmp_path, source)
        with pytest.raises(
            CatalogError, match=r"chains-3-undamped.jsonl is damaged: .*; install disting anew"
        ):
            catalog(3, folder=tmp_path, damped=False)


def test_an_intact_file_is_read_and_a_folder_without_provenance_too(tmp_path):
    shutil.copy(shipped_folder() / "chains-3-undamped.jsonl", tmp_path)
    assert catalog(3, folder=tmp_path, damped=False) == catalog(3, damped=False)
    shutil.copy(shipped_folder() / "provenance.json", tmp_path)
    assert catalog(3, folder=tmp_path, damped=False) == catalog(3, damped=False)


def test_a_growing_file_may_grow_but_not_change(tmp_path):
    name = "settled-dampers.jsonl"
    content = (shipped_folder() / name).read_bytes()
    shutil.copy(shipped_folder() / "provenance.json", tmp_path)
    (tmp_path / name).write_bytes(content + content[-200:])
    assert intact_text(tmp_path / name).startswith(content.decode())
    for damaged in (content[:-1], b"x" + content[1:]):
        (tmp_path / name).write_bytes(damaged)
        with pytest.raises(CatalogError, match="is damaged"):
            intact_text(tmp_path / name)


@pytest.mark.parametrize("text", ["", "[]", '{"files": 3}', "\0"])
def test_a_damaged_provenance_is_an_error_too(tmp_path, text):
    shutil.copy(shipped_folder() / "chains-3-undamped.jsonl", tmp_path)
    (tmp_path / "provenance.json").write_text(text)
    with pytest.raises(CatalogError, match=r"provenance.json is damaged"):
        catalog(3, folder=tmp_path, damped=False)
