"""What to measure next as files, shipped for the groups of indistinguishable structures of 2 to
5 masses.

`next-<masses>-<undamped|damped>.jsonl`: a header, then a line a group of structures that one
measurement cannot tell apart over complex parameters: its `group` (numbers of the structures), and
for each kind of experiment what `verdict.placed.Placed` holds of its spots, structure by structure
and mass by mass: `gains` (a letter each: n new, r repeats, s silent), `columns`, `classes`,
`links`, `open` and `safety`. The evidence is not kept: `disting compare --also` gives it.
"""

import json
from collections.abc import Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, replace
from functools import cache, cached_property
from pathlib import Path

from disting.catalogs.catalog import Catalog
from disting.catalogs.files import Record, lines, shipped_folder
from disting.catalogs.provenance import write_provenance
from disting.errors import CatalogError
from disting.experiments.menu import Costs, Gain, Kind
from disting.files import intact_text, write_whole
from disting.model.family import Family
from disting.verdict import Engine, Progress, View, silent
from disting.verdict.further import Further, further
from disting.verdict.placed import NOT_KNOWN, TESTS, Placed

SCHEMA = 1
SHIPPED_SIZES = (2, 3, 4, 5)
COMMAND = "disting catalog next"
LETTERS = {g.value[0]: g for g in Gain}


def name_of(n_masses: int, damped: bool) -> str:
    """Name of a file without its suffix, such as next-3-damped."""
    return f"next-{n_masses}-{'damped' if damped else 'undamped'}"


@dataclass(frozen=True)
class NextCatalog:
    """What to measure next for all groups of a family; `records` is the file's content."""

    family: Family
    records: tuple[Record, ...]

    @property
    def groups(self) -> tuple[tuple[int, ...], ...]:
        """Structures that one measurement cannot tell apart, over complex parameters."""
        return tuple(tuple(r["group"]) for r in self.records[1:])

    @cached_property
    def _place(self) -> dict[int, int]:
        return {m: at for at, group in enumerate(self.groups, 1) for m in group}

    @cached_property
    def _read(self) -> dict[int, Further]:
        """Groups that were asked for."""
        return {}

    def group(self, number: int) -> tuple[int, ...]:
        """The group of a structure, itself alone where it has none."""
        at = self._place.get(number)
        return self.groups[at - 1] if at else (number,)

    def further(self, numbers: Sequence[int], costs: Costs | None = None) -> Further | None:
        """What to measure next to tell these structures of one group apart, in this order; None
        where they are no two of one group. Raises CatalogError for a damaged record.
        """
        places = {self._place.get(m) for m in numbers}
        at = places.pop()
        if places or at is None or len(set(numbers)) < 2:
            return None
        if at not in self._read:
            self._read[at] = _further(self.family, self.records[at], self.records[0]["tests"])
        group = self.groups[at - 1]
        found = self._read[at].only([group.index(m) for m in numbers])
        return replace(found, costs=costs or Costs())


@cache
def next_catalog(n_masses: int, *, damped: bool = False) -> NextCatalog:
    """What is shipped; raises CatalogError where there is nothing.

    >>> found = next_catalog(3, damped=True).further((1, 11))
    >>> [kind.value for kind in found.kinds if found.anywhere(kind)]
    ['sensor', 'force', 'inertia', 'lock']
    """
    return read(shipped_folder(), n_masses, damped)


def build_next(
    stored: Catalog,
    engine: Engine,
    *,
    executor: Executor | None = None,
    progress: Progress = silent,
) -> str:
    """The text of the file that belongs to a catalogue, computed; the bytes do not depend on the
    machine or the order of the work.
    """
    n, damped = stored.n_masses, stored.damped
    groups = stored.classes(View.EXACT)
    header: Record = {
        "schema": SCHEMA,
        "catalog": name_of(n, damped),
        "groups": len(groups),
        "command": f"{COMMAND} {n}",
        "settings": engine.settings.to_dict(),
        "tests": list(TESTS),
    }
    records = [header]
    for done, members in enumerate(groups, 1):
        named = [(f"{n}:{m}", stored.family[m]) for m in members]
        found = further(named, engine, executor=executor, progress=progress)
        tables = {kind.value: _plain(table) for kind, table in found.tables.items()}
        records.append({"group": list(members), **tables})
        progress("groups", done, len(groups))
    return lines(records)


def write(text: str, n_masses: int, damped: bool, folder: Path) -> Path:
    """Write a file and, last, the provenance of its folder; returns its path."""
    folder.mkdir(parents=True, exist_ok=True)
    path = write_whole(folder / f"{name_of(n_masses, damped)}.jsonl", [text])
    write_provenance(folder)
    return path


def read(folder: Path, n_masses: int, damped: bool) -> NextCatalog:
    """The file in a folder; raises CatalogError where it is missing, damaged or of another
    schema.
    """
    path = folder / f"{name_of(n_masses, damped)}.jsonl"
    remedy = f"make it with '{COMMAND} {n_masses}'"
    try:
        records = [json.loads(line) for line in intact_text(path).splitlines()]
        header = records[0]
        if header["schema"] != SCHEMA or not set(header["tests"]) <= set(TESTS):
            raise ValueError("another schema")
        if len(records) != header["groups"] + 1 or any(len(r["group"]) < 2 for r in records[1:]):
            raise ValueError("groups are missing")
        return NextCatalog(Family(n_masses, damped), tuple(records))
    except FileNotFoundError:
        raise CatalogError(f"there is no {path}; {remedy}") from None
    except (OSError, ValueError, LookupError, TypeError) as reason:
        raise CatalogError(f"{path} cannot be read ({reason}); {remedy}") from None


def verify_next(
    stored: Catalog,
    folder: Path,
    engine: Engine,
    *,
    executor: Executor | None = None,
    progress: Progress = silent,
) -> list[str]:
    """What is wrong with the file of a catalogue, in sentences: its bytes against those that are
    computed now.
    """
    n, damped = stored.n_masses, stored.damped
    path = folder / f"{name_of(n, damped)}.jsonl"
    if not path.exists() and folder.resolve() != shipped_folder().resolve():
        return []  # a folder of one's own need not have it
    read(folder, n, damped)
    text = build_next(stored, engine, executor=executor, progress=progress)
    there = path.read_text(encoding="utf-8").splitlines()
    for number, (a, b) in enumerate(zip(there, text.splitlines(), strict=False), 1):
        if a != b:
            return [f"{path.name}, line {number} is not what is computed now"]
    return [] if len(there) == len(text.splitlines()) else [f"{path.name} has other groups"]


def _plain(table: Placed) -> Record:
    return {
        "gains": "".join(g.value[0] for g in table.gains),
        "columns": [list(row) for row in table.columns],
        "classes": list(table.classes),
        "links": list(table.links),
        "open": sorted(map(list, table.open)),
        "safety": table.safety,
    }


def _further(family: Family, record: Record, tests: Sequence[str]) -> Further:
    numbers = record["group"]
    try:
        tables = {
            kind: _placed(kind, family.n_masses, len(numbers), record[kind.value], tests)
            for kind in Kind
            if kind.value in record
        }
        names = tuple(f"{family.n_masses}:{m}" for m in numbers)
        return Further(names, tuple(family[m] for m in numbers), tables)
    except (LookupError, TypeError, ValueError) as reason:
        raise CatalogError(
            f"the group {numbers} cannot be read ({reason!r}); make it with '{COMMAND}"
            f" {family.n_masses}'"
        ) from None


def _placed(
    kind: Kind, n_masses: int, structures: int, plain: Record, tests: Sequence[str]
) -> Placed:
    """One table; a test that the file does not have is not known. Raises LookupError, TypeError or
    ValueError for what is none.
    """
    rows = [dict(zip(tests, map(int, row), strict=True)) for row in plain["columns"]]
    found = Placed(
        kind,
        n_masses,
        tuple(LETTERS[letter] for letter in plain["gains"]),
        tuple(tuple(row.get(test, NOT_KNOWN) for test in TESTS) for row in rows),
        tuple(map(int, plain["classes"])),
        tuple(map(str, plain["links"])),
        frozenset((int(a), int(b)) for a, b in plain["open"]),
        int(plain["safety"]),
    )
    lists = (found.gains, found.columns, found.classes, found.links)
    if {len(each) for each in lists} != {n_masses * structures}:
        raise ValueError("masses are missing")
    return found
