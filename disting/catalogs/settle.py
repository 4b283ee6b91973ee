"""Pairs too large for the default limits of the exact decision: settled once with more time, carried by the catalogues.

`settled.jsonl` holds the findings, a line a pair of canonical chains; `build` takes over what it finds there. So does
`damper_family` from `settled-dampers.jsonl`, where the chains have dampers to the ground.
"""

import json
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

from disting.catalogs.catalog import Catalog
from disting.conditions.codec import finding_from_json, finding_to_json
from disting.conditions.exact import LIMITS, by_ideals
from disting.conditions.finding import Finding, Outcome
from disting.conditions.subject import EXACTLY, Subject
from disting.engine import Engine
from disting.engine.engine import question_key
from disting.model.chain import Chain
from disting.question import Question
from disting.verdict import Relation, View

SETTLED = "settled.jsonl"
SETTLED_DAMPERS = "settled-dampers.jsonl"
Settled = dict[tuple[str, str], Finding]
"""Findings on ordered pairs of canonical chains, by their texts."""


def read_settled(folder: Path, name: str = SETTLED) -> Settled:
    """What a file of the folder holds; nothing if there is none."""
    path = folder / name
    records = [json.loads(line) for line in path.read_text(encoding="utf-8").splitlines()] if path.is_file() else []
    return {(r["left"], r["right"]): finding_from_json(json.dumps(r["finding"])) for r in records}


def preload(engine: Engine, known: Settled, subjects: Sequence[Subject], question: Question[Finding] = EXACTLY) -> None:
    """Let the engine know the findings on these subjects as answers to a question."""
    chains = {str(s.canonical.chain): s.canonical.chain for s in subjects}
    for names, finding in known.items():
        if chains.keys() >= set(names):
            pair = (chains[names[0]], chains[names[1]])
            engine.answers[question_key(question, pair, engine.settings)] = finding


def settle(catalog: Catalog, folder: Path, seconds: float, told: Callable[[str], None]) -> int:
    """Settle what a catalogue leaves open, each pair within `seconds`; every finding is kept at once. The number of them."""
    subjects = {number: Subject(f"A{number}", chain) for number, chain in enumerate(catalog.family, 1)}
    stored = catalog.pairs(View.EXACT)
    open_pairs = [subjects[i].in_order(subjects[j]) for i, j, v in stored if v.relation is Relation.UNDECIDED]
    count = 0
    for first, second in dict.fromkeys(open_pairs):
        finding = _settled(first, second, seconds)
        told(f"{first} and {second}: {finding.note or finding.outcome}")
        if finding.outcome is not Outcome.ABANDONED:
            append(folder / SETTLED, first, second, finding)
            count += 1
    return count


def _settled(first: Chain, second: Chain, seconds: float) -> Finding:
    limits = replace(LIMITS, seconds=seconds, entries=10**9)
    return by_ideals(first, second, Subject("", first).settings, limits)


def append(path: Path, first: Chain, second: Chain, finding: Finding) -> None:
    """Add a finding to a file, at once."""
    record = {"left": str(first), "right": str(second), "finding": json.loads(finding_to_json(finding))}
    with path.open("a", encoding="utf-8") as file:
        file.write(json.dumps(record, separators=(",", ":")) + "\n")
