"""The formats of all JSON that disting writes, and what is in them, as JSON Schema.

Each says at "format" which it is. A field that is added leaves its number as it is; one that goes,
or means something else, raises it. Definitions that several share stand in one file; a schema that
is asked for has those that it needs.
"""

import json
import re
from enum import StrEnum
from pathlib import Path
from typing import Any

DEFINITION = re.compile(r'"#/\$defs/(\w+)"')


class Format(StrEnum):
    """What a JSON says at "format"."""

    VERDICT = "disting verdict 1"
    EVERYWHERE = "disting verdicts for every place 1"
    VERDICTS = "disting verdicts 1"
    CATALOGUE = "disting catalogue 1"
    EQUIVALENTS = "disting equivalents 1"
    NETWORK_EQUIVALENTS = "disting equivalents of a network 1"
    NEXT = "disting next 1"
    NEXT_OF_FIT = "disting next of a fit 1"
    NEXT_OF_NETWORK_FIT = "disting next of a fit of networks 1"
    FIT = "disting fit 1"
    NETWORK_FIT = "disting fit of networks 1"
    PLAN = "disting plan 1"
    PLANS_OF_FIT = "disting plans of a fit 1"
    MODELS = "disting models 1"
    GATE = "disting gate 1"

    @property
    def short(self) -> str:
        """Its name on a command line, and that of its file.

        >>> Format.NEXT_OF_FIT.short
        'next-of-a-fit'
        """
        return "-".join(self.value.split()[1:-1])

    @property
    def description(self) -> str:
        """What it holds and who writes it."""
        return str(_read(self.short)["description"])


def schema(of: Format) -> dict[str, Any]:
    """Its JSON Schema, which needs no other file.

    >>> schema(Format.NEXT)["title"], sorted(schema(Format.NEXT)["$defs"])[:2]
    ('disting next 1', ['certainty', 'next'])
    """
    found, known = _read(of.short), _read("definitions")
    needed: dict[str, Any] = {}
    new = _names(found)
    while new:
        needed |= {name: known[name] for name in sorted(new)}
        new = {n for name in new for n in _names(known[name])} - needed.keys()
    return found | {"$defs": dict(sorted(needed.items()))}


def _names(part: object) -> set[str]:
    """Definitions that a part of a schema refers to."""
    return set(DEFINITION.findall(json.dumps(part)))


def _read(name: str) -> dict[str, Any]:
    text = (Path(__file__).parent / f"{name}.json").read_text(encoding="utf-8")
    found: dict[str, Any] = json.loads(text)
    return found
