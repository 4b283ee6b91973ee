"""Phrases that may not come back into the README and the guide: the text is plain English."""

import re
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
GUIDE = ROOT / "disting" / "guide"
PAGES = [ROOT / "README.md", *sorted(GUIDE.glob("*.md"))]

PHRASES = (
    r"\b(?:is|are|was|were) told\b(?! apart)",
    r"\btold apart\b",
    r"\btells? (?:it|them|these|those|all|two|the \w+) (?:of them )?apart\b",
    r"\b(?:is|are) said\b",
    r"\b(?:is|are) asked\b",
    r"\bas it stands\b",
    r"\bstands? (?:beside|behind|on few|for yours)\b",
    r"\b(?:is|are) (?:not )?seen\b",
    r"\bnobody sees\b",
    r"\bcomes? to (?:that|this|the same)\b",
    r"\b(?:does|do) the same\b",
    r"\bcan do what\b",
    r"\bleave (?:it|them|one|those) away\b",
    r"\bleave the lines .* away\b",
    r"\blooked at\b",
    r"\blooks (?:on|across)\b",
    r"\bsays? (?:so|it)\b",
    r"\bsays (?:which|what|how|for which)\b",
    r"\bfound back\b",
    r"\bwhat is left\b",
    r"\bwhat is quoted\b",
    r"\bthe one (?:is|are|has|may|over)\b",
    r"\bone and the same\b",
    r"\bas many .* as\b.*\bas\b",
    r"\bmay as well\b",
    r"\bbut for\b",
    r"\bspecial (?:values|ones) aside\b",
    r"\bwhichever it is\b",
    r"\b(?:is|are) another matter\b",
    r"\bsurely (?:enough|tells)\b",
    r"\bno(?:body| one) knows\b",
    r"\bgoes? by what\b",
    r"\bwithout loss, as\b",
    r"\b(?:everything|what) it rests on\b",
    r"\b(?:is|are) there too\b",
    r"(?:^|[.:;] )(?:What|Which|Whether) [^?.]{3,60}\b(?:is|are|has|have|says|follows)\b[^?]*\.",
)
"""Idiom of earlier versions; each is a regular expression, searched in one line."""

NOT_YET = frozenset(
    {
        "decisions.md",
        "development.md",
    }
)
"""Pages that are not yet rewritten. This set may only shrink."""


def prose(text: str) -> list[tuple[int, str]]:
    """(Line number, text) of each line outside code blocks, inline code removed."""
    lines: list[tuple[int, str]] = []
    inside = False
    for number, line in enumerate(text.splitlines(), 1):
        if line.startswith("```"):
            inside = not inside
        elif not inside:
            lines.append((number, re.sub(r"`[^`]*`", "`x`", line)))
    return lines


def faults(path: Path) -> list[str]:
    """Page, line and words of every phrase of the list."""
    return [
        f"{path.name}:{number}: {found[0]}"
        for number, line in prose(path.read_text("utf-8"))
        for phrase in PHRASES
        for found in re.finditer(phrase, line, re.IGNORECASE)
    ]


@pytest.mark.parametrize("path", PAGES, ids=lambda path: path.name)
def test_plain_words(path: Path) -> None:
    found = faults(path)
    if path.name in NOT_YET:
        print(f"not yet rewritten: {path.name}, {len(found)} phrases", file=sys.stderr)
    else:
        assert found == []
