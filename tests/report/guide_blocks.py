"""The texts of guide and README, and what their blocks show."""

import re
from functools import cache
from pathlib import Path

from markdown_it import MarkdownIt

ROOT = Path(__file__).parents[2]
FOLDER, README = ROOT / "disting" / "guide", ROOT / "README.md"
TEXTS = {
    **{path.name: path.read_text(encoding="utf-8") for path in sorted(FOLDER.glob("*.md"))},
    "README.md": README.read_text("utf-8"),
}


@cache
def blocks(text: str) -> list[tuple[str, str]]:
    """Kind and content of every block of code."""
    found = MarkdownIt("commonmark").parse(text)
    return [(token.info, token.content) for token in found if token.type == "fence"]


def fences(text: str) -> list[str]:
    """Contents of the blocks."""
    return [content for _, content in blocks(text)]


def transcripts() -> list[tuple[str, str, str]]:
    """Page, command and its output, of what is shown with output."""
    found = []
    for name, text in TEXTS.items():
        for block in fences(text):
            parts = re.split(r"^\$ ", block, flags=re.MULTILINE)[1:]
            found += [(name, *part.split("\n", 1)) for part in parts]
    return found


def commands_alone() -> list[tuple[str, str]]:
    """Page and command, of commands that stand in a block without what they say."""
    return [
        (name, line)
        for name, text in TEXTS.items()
        for block in fences(text)
        for line in block.splitlines()
        if line.startswith("disting ")
    ]
