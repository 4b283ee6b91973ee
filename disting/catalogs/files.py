"""Where catalogue files are and what is in them: one JSON record a line, so that a change shows as
changed lines.

First line: header. Then a line a model, in order; then a line a pair (left < right), with the
deciding step in each representation, absent where nothing decides, the `inclusions` of models of
unequal rank (`closure`: limits; `image`: finite elements other than zero, absent where both have
one reason), and which positive models of either side have a positive equivalent on the other
(`left_positive`, `right_positive`), where generic ones have equivalents.

What the data files of a folder are: `provenance.json` with the digest of each, compared
whenever one is read.

`settled-dampers.jsonl`: pairs of chains with dampers to the ground that were decided once, with
patience, a line a pair of canonical chains with its finding, which has its evidence. `dampers`
takes over what it finds there; the evidence is checked separately (`evidence_check.finding_holds`).
The file, to which `disting catalog settle` appends, is named with the length that it had: what is
appended later is the user's own. See `disting.files.intact_text`, which compares.
"""

import hashlib
import json
import platform
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import combinations
from pathlib import Path
from typing import Any, overload

from disting.conditions.rule import Finding
from disting.errors import CatalogError
from disting.files import (
    PROVENANCE as PROVENANCE,
    __version__,
    intact_text,
    json_text,
    shipped_folder as shipped_folder,
    write_whole,
)
from disting.model.chain import Chain

SETTLED = "settled-dampers.jsonl"
Findings = dict[tuple[Chain, Chain], Finding]
"""Findings on ordered pairs of canonical chains."""
SCHEMA = 4
SHIPPED_SIZES = (1, 2, 3, 4, 5)
LEFT_POSITIVE, RIGHT_POSITIVE = "left_positive", "right_positive"  # of a pair's record
INCLUSIONS = "inclusions"
Record = dict[str, Any]


def read_findings(canonical_chains: Iterable[Chain], folder: Path | None = None) -> Findings:
    """Stored findings on these canonical chains: from the shipped file and from the given
    folder.
    """
    named = {str(chain): chain for chain in canonical_chains}
    findings = Findings()
    folders = dict.fromkeys(where.resolve() for where in (shipped_folder(), folder) if where)
    for path in (where / SETTLED for where in folders):
        for text in intact_text(path).splitlines() if path.is_file() else ():
            record = json.loads(text)
            if record["left"] in named and record["right"] in named:
                pair = named[record["left"]], named[record["right"]]
                findings[pair] = Finding.from_json(json.dumps(record["finding"]))
    return findings


def append(folder: Path, first: Chain, second: Chain, finding: Finding) -> None:
    """Add a finding to the file, at once."""
    record = {
        "left": str(first),
        "right": str(second),
        "finding": json.loads(finding.to_json()),
    }
    with (folder / SETTLED).open("a", encoding="utf-8", newline="\n") as file:
        file.write(line(record) + "\n")


def name_of(n_masses: int, damped: bool) -> str:
    """Name of a catalogue, such as chains-3-damped."""
    return f"chains-{n_masses}-{'damped' if damped else 'undamped'}"


def damper_name(n_masses: int, damped: bool) -> str:
    """Name of a file of classes without its suffix, such as dampers-3-damped."""
    return f"dampers-{n_masses}-{'damped' if damped else 'undamped'}"


def line(record: Record) -> str:
    """A line of a catalogue file."""
    return json_text(record, ascii_only=True)


def lines(records: Iterable[Record]) -> str:
    """The text of a catalogue file."""
    return "".join(line(record) + "\n" for record in records)


@dataclass(frozen=True, slots=True)
class Records(Sequence[Record]):
    """Records as the lines of their file, each parsed on request: as text they take a tenth of the
    memory, and most of them are never requested.
    """

    lines: tuple[str, ...]

    def __len__(self) -> int:
        return len(self.lines)

    @overload
    def __getitem__(self, at: int) -> Record: ...
    @overload
    def __getitem__(self, at: slice) -> list[Record]: ...
    def __getitem__(self, at: int | slice) -> Record | list[Record]:
        found = self.lines[at]
        return json.loads(found) if isinstance(found, str) else list(map(json.loads, found))


def read_records(path: Path) -> Records:
    """Records of a catalogue file; raises CatalogError where it is missing, damaged or of
    another schema.
    """
    try:
        records = Records(tuple(intact_text(path).splitlines()))
        header = records[0]
        complete = _is_complete(records, header["models"])
    except FileNotFoundError:
        raise CatalogError(
            f"there is no catalogue {path}; make it with 'disting catalog build'"
        ) from None
    except (OSError, ValueError, LookupError, TypeError) as reason:
        raise CatalogError(
            f"the catalogue {path} cannot be read ({reason}); rebuild it with 'disting catalog"
            " build'"
        ) from None
    if header.get("schema") != SCHEMA or not complete:
        raise CatalogError(
            f"the catalogue {path} is incomplete or of another schema; rebuild it with 'disting"
            " catalog build'"
        )
    return records


def _is_complete(records: Records, models: int) -> bool:
    """Return True if the lines are those of all models, then of all pairs, judged by how they
    begin.
    """
    numbers = range(1, models + 1)
    heads = [f'{{"model":{i},' for i in numbers]
    heads += [f'{{"left":{i},"right":{j},' for i, j in combinations(numbers, 2)]
    lines_after = records.lines[1:]
    return len(lines_after) == len(heads) and all(map(str.startswith, lines_after, heads))


def digest(path: Path) -> str:
    """SHA-256 of a file."""
    return hashlib.sha256(path.read_bytes()).hexdigest()


def provenance_of(folder: Path) -> Record:
    """Schema, software versions, command and the digest of each data file in a folder."""
    from importlib.metadata import version

    return {
        "schema": SCHEMA,
        "command": "disting catalog build 1 2 3 4 5",
        "software": (
            {"disting": __version__, "python": platform.python_version()}
            | {name: version(name) for name in ("numpy", "python-flint")}
        ),
        "files": {p.name: _text_of(p) for p in sorted(folder.glob("*.jsonl"))},
    }


def write_provenance(folder: Path) -> Path:
    """Write it again, after the files of the folder; returns its path."""
    return write_whole(
        folder / PROVENANCE,
        [json_text(provenance_of(folder), indent=1, ascii_only=True, sort_keys=True), "\n"],
    )


def _text_of(path: Path) -> str:
    return f"{digest(path)}:{path.stat().st_size}" if path.name == SETTLED else digest(path)
