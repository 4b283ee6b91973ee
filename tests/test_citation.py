"""How to cite: one version, one date, the same words for programs and people."""

import re
from pathlib import Path

from disting.files import __version__

ROOT = Path(__file__).parents[1]
CITATION = (ROOT / "CITATION.cff").read_text(encoding="utf-8")
PAGE = (ROOT / "disting" / "guide" / "citing.md").read_text(encoding="utf-8")


def field(name: str) -> str:
    match = re.search(rf'^\s*(?:- )?{name}: "?([^"\n]+)"?$', CITATION, re.MULTILINE)
    assert match, name
    return match[1]


def test_version_and_licence_are_those_of_the_package() -> None:
    assert field("version") == __version__
    project = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    assert f'license = "{field("license")}"' in project


def test_the_page_says_the_same() -> None:
    for name in ("version", "date-released", "license", "title", "journal"):
        assert f"{{{field(name)}}}" in PAGE, name
    for person in re.findall(r"family-names: (\w+)\n\s+given-names: (\w+)", CITATION):
        assert f"{person[0]}, {person[1]}" in PAGE
