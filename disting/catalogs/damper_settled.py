"""Pairs of chains with dampers to the ground that were decided once, with patience:
`settled-dampers.jsonl`, shipped.

A line a pair of canonical chains with its finding, which has its evidence. `damper_family` takes
over what it finds there; that the evidence holds is looked at by itself (`holds`).
"""

import json
from collections.abc import Iterable
from pathlib import Path

from disting.conditions.rule import Finding
from disting.evidence.ideals import Refuted, Solved
from disting.fibres.ideals import coefficient_map, matched, normalised, refuted_at
from disting.files import intact_text, shipped_folder
from disting.model.chain import Chain
from disting.model.question import Settings
from disting.questions.same.evidence_check import Witness
from disting.questions.same.exact import exact_again, rational_part

FILE = "settled-dampers.jsonl"
Settled = dict[tuple[Chain, Chain], Finding]
"""Findings on ordered pairs of canonical chains."""


def read_settled(canonical_chains: Iterable[Chain], folder: Path | None = None) -> Settled:
    """What is settled of these canonical chains: in the shipped file, and in the folder's own."""
    named = {str(chain): chain for chain in canonical_chains}
    found = Settled()
    folders = dict.fromkeys(where.resolve() for where in (shipped_folder(), folder) if where)
    for path in (where / FILE for where in folders):
        for text in intact_text(path).splitlines() if path.is_file() else ():
            record = json.loads(text)
            if record["left"] in named and record["right"] in named:
                pair = named[record["left"]], named[record["right"]]
                found[pair] = Finding.from_json(json.dumps(record["finding"]))
    return found


def append(folder: Path, first: Chain, second: Chain, finding: Finding) -> None:
    """Add a finding to the file, at once."""
    record = {
        "left": str(first),
        "right": str(second),
        "finding": json.loads(finding.to_json()),
    }
    with (folder / FILE).open("a", encoding="utf-8", newline="\n") as file:
        file.write(json.dumps(record, separators=(",", ":")) + "\n")


def holds(found: Finding, first: Chain, second: Chain, settings: Settings) -> bool:
    """Whether a finding on two canonical chains of equal rank is what its evidence shows.

    Outcome, bound and labels are compared with those that the settings draw. At these labels shares
    are refuted once more, solutions are put into both transfer functions, and contradictions of
    ideals are found again: all that the bound counts, in the direction that the evidence names.
    Raises NotSeenError where that takes too long.
    """
    evidence = found.evidence
    if evidence is None or found != exact_again(evidence, first, second, settings):
        return False
    if isinstance(evidence, Solved):  # of ideals, only the labels were drawn again
        return Witness().confirms(evidence, "fibre", first, second)
    if isinstance(evidence, Refuted):
        coordinates = normalised if evidence.is_normalised else coefficient_map
        maps = matched(*(coordinates(rational_part(chain)) for chain in (first, second)))
        return refuted_at(evidence.labels, evidence, *maps)
    return True
