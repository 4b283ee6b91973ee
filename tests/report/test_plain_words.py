"""Phrases that may not come back into the README and the guide: the text is plain English."""

import re
from collections.abc import Sequence
from pathlib import Path

import pytest
from markdown_it import MarkdownIt
from markdown_it.token import Token

from disting.decide import as_markdown

ROOT = Path(__file__).parents[2]
PACKAGE = ROOT / "disting"
GUIDE = PACKAGE / "guide"
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

SYNONYMS = {
    "ground damper": r"dampers? to the ground|grounded dampers?",
    "dead time": r"time delays?|delay times?|transport delays?|deadtimes?",
    "collocated": r"co-?located",
    "port": r"terminal pairs?",
    "sensor quantity": r"measurands?|measured variables?",
    "structure": r"topolog(?:y|ies)|model structures?",
    "candidate": r"competitors?|contenders?|trial models?",
    "catalogue": r"catalogs?(?! (?:build|verify|settle))",
    "compartment": r"pools?",
    "transfer function": r"transmission functions?|system functions?|frequency characteristics?",
    "driving-point function": r"input functions?",
    "fibre": r"fibers?",
    "equivalent": r"twins?",
    "distinguishable": r"discernible|discriminable|separable models?",
    "indistinguishable": r"indiscernible|non-?distinguishable|undistinguishable",
    "undecided": r"undecidable",
    "finding": r"sub-?verdicts?",
    "renaming": r"relabell?ings?|relabell?ed",
    "excluded": r"ruled out|discarded|thrown out",
    "selected": r"winners?|winning",
    "misfit": r"mismatch(?:es)?",
    "scatter": r"dispersion",
    "hit rate": r"success rates?",
    "rival": r"opponents?",
    "line": r"frequency points?|spectral lines?|frequency bins?",
    "scaled condition index": r"condition numbers?",
    "the paper": r"the article|the publication",
}
"""Term of the glossary: other words for it, which the README and the guide do not use."""


def prose(text: str) -> list[tuple[int, str]]:
    """(Line number, text) of each line outside blocks of code, inline code as x, links in brackets."""
    return [
        (token.map[0] + 1 + number, line)
        for token in MarkdownIt("commonmark").enable("table").parse(text)
        if token.type == "inline" and token.map
        for number, line in enumerate("".join(map(_words, token.children or ())).split("\n"))
    ]


def _words(token: Token) -> str:
    if token.type in ("softbreak", "hardbreak"):
        return "\n"
    marks = {"code_inline": "x", "link_open": "[", "link_close": "]"}
    return marks.get(token.type, token.content)


def text_of(path: Path) -> str:
    """Text of a page without the tables that the code prints."""
    return path.read_text("utf-8").replace(as_markdown(), "")


def faults(path: Path, phrases: Sequence[str]) -> list[str]:
    """Page, line and words of every phrase of the list."""
    return [
        f"{path.name}:{number}: {found[0]}"
        for number, line in prose(text_of(path))
        for phrase in phrases
        for found in re.finditer(phrase, line, re.IGNORECASE)
    ]


@pytest.mark.thin(1)
@pytest.mark.parametrize("path", PAGES, ids=lambda path: path.name)
def test_plain_words(path: Path) -> None:
    assert faults(path, PHRASES) == []


def glossary() -> dict[str, str]:
    """Definitions by term; one heading may have several terms."""
    _, *parts = re.split(r"^### (.+)$", (GUIDE / "glossary.md").read_text("utf-8"), flags=re.M)
    headings = zip(parts[::2], parts[1::2], strict=True)
    return {term: text for heading, text in headings for term in heading.split(", ")}


@pytest.mark.thin(1)
@pytest.mark.parametrize("path", PAGES, ids=lambda path: path.name)
def test_one_word_for_one_thing(path: Path) -> None:
    assert faults(path, [rf"\b(?:{words})\b" for words in SYNONYMS.values()]) == []


def test_synonyms_are_those_of_terms_of_the_glossary() -> None:
    assert set(SYNONYMS) <= set(glossary())


@pytest.mark.full
def test_every_term_of_the_glossary_is_used() -> None:
    """By the guide, the README, a definition of another term, a message or a page."""
    defined = glossary()
    used = [text_of(path) for path in PAGES if path.name != "glossary.md"]
    # not the list of the words that pages link to the glossary
    code = [path for path in PACKAGE.rglob("*.py") if path.name != "markdown.py"]
    used += [path.read_text("utf-8") for path in (*code, *PACKAGE.rglob("*.html"))]
    text = "\n".join(used).lower()
    unused = [
        term
        for term in defined
        if term.lower() not in text
        and not any(term.lower() in words.lower() for of, words in defined.items() if of != term)
    ]
    assert unused == []


def test_quoted_symptoms_are_words_of_the_program() -> None:
    """Of the page on files that are not read: a reader searches it for the message on the screen."""
    page = (GUIDE / "file-not-read.md").read_text("utf-8")
    symptoms = [row.split("|")[1] for row in page.splitlines() if row.startswith('| "')]
    quoted = re.findall(r'"([^"]+)"', " ".join(symptoms))
    code = "\n".join(path.read_text("utf-8") for path in PACKAGE.rglob("*.py"))
    said = re.sub(r'"\s+f?"', "", code)  # literals over several lines
    parts = [part.strip() for words in quoted for part in re.split(r"\.\.|'foo'|\d+", words)]
    assert len(parts) > 10
    assert [part for part in parts if part not in said] == []
