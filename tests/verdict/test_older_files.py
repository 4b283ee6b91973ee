"""Verdict files of version 0.3.0 still hold, and a false sentence in one of them does not.
`files-of-0.3.0.jsonl` was written by that version: a pair for every form of its sentences.
"""

import json
from pathlib import Path
from typing import Any

import pytest

from disting import verify
from disting.evidence.decision import THEOREMS
from disting.verdict.older_files import _PHRASES, OLDER
from disting.verdict.verification import Status

FILES = [
    json.loads(line)
    for line in (Path(__file__).parent / "files-of-0.3.0.jsonl").read_text("utf-8").splitlines()
]
RARE = {"nothing settles them", "are driving-point functions ", "has positive ones alone"}
"""Phrases of an open verdict, and of two deciders that others precede in 0.3.0."""


def sentences(file: dict[str, Any]) -> str:
    return file["sentence"] + file["over_complex"].get("sentence", "")


@pytest.mark.thin(1)
@pytest.mark.parametrize("file", FILES, ids=lambda file: f"{file['left']} and {file['right']}")
def test_a_file_of_0_3_0_holds(file: dict[str, Any]) -> None:
    assert (file["format"], file["program"]) == (OLDER, "0.3.0")
    assert verify(file).status is Status.HOLDS
    false = file["sentence"].replace("parameters", "values", 1)
    assert false != file["sentence"]
    assert verify(file | {"sentence": false}).status is Status.FAILS


BY_THEOREM = [file for file in FILES if file["evidence"].get("kind") == "theorem"]


@pytest.mark.thin(8)
@pytest.mark.parametrize("name", THEOREMS)
@pytest.mark.parametrize("file", BY_THEOREM, ids=lambda file: f"{file['left']} and {file['right']}")
def test_a_theorem_that_does_not_apply_is_no_evidence(file: dict[str, Any], name: str) -> None:
    """A theorem is not searched for again, so that its premises are all that is checked."""
    again = verify(file | {"evidence": file["evidence"] | {"name": name}})
    assert again.status is (Status.HOLDS if name == file["evidence"]["name"] else Status.FAILS)


def test_each_older_phrase_is_in_a_file() -> None:
    written = "".join(map(sentences, FILES))
    missing = {older[:28] for _, older in _PHRASES if older not in written}
    assert missing == RARE
