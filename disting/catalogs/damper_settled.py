"""Pairs of chains with dampers to the ground that were decided once with much time:
`settled-dampers.jsonl`, shipped.

A line a pair of canonical chains with its finding; `damper_family` takes over what it finds there.
"""

import json
from collections.abc import Sequence
from pathlib import Path

from disting.conditions.finding import Finding
from disting.files import intact_text
from disting.model.chain import Chain
from disting.questions.same.low_cost import SETTLED
from disting.verdict.chain_side import ComparedChain
from disting.verdict.engine import Engine, question_key

FILE = "settled-dampers.jsonl"
Settled = dict[tuple[str, str], Finding]
"""Findings on ordered pairs of canonical chains, by their texts."""


def read_settled(folder: Path) -> Settled:
    """What the folder's file holds; nothing if there is none."""
    path = folder / FILE
    records = (
        [json.loads(line) for line in intact_text(path).splitlines()] if path.is_file() else []
    )
    return {(r["left"], r["right"]): Finding.from_json(json.dumps(r["finding"])) for r in records}


def append(folder: Path, first: Chain, second: Chain, finding: Finding) -> None:
    """Add a finding to the file, at once."""
    record = {
        "left": str(first),
        "right": str(second),
        "finding": json.loads(finding.to_json()),
    }
    with (folder / FILE).open("a", encoding="utf-8", newline="\n") as file:
        file.write(json.dumps(record, separators=(",", ":")) + "\n")


def preload(engine: Engine, known: Settled, subjects: Sequence[ComparedChain]) -> None:
    """Let the engine know the findings on these subjects."""
    chains = {str(s.canonical.chain): s.canonical.chain for s in subjects}
    for names, finding in known.items():
        if chains.keys() >= set(names):
            pair = (chains[names[0]], chains[names[1]])
            engine.answers[question_key(SETTLED, pair, engine.settings)] = finding
