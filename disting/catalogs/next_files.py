"""Shipped files of further measurements, for the groups of indistinguishable structures of 2 to 5
masses.

`next-<masses>-<undamped|damped>.jsonl`: a header, then a line a group of structures that one
measurement cannot distinguish over complex parameters: its `group` (numbers of the structures), and
for each kind of experiment what `verdict.placement_record.SpotClasses` holds of its spots,
structure by structure and mass by mass: `gains` (a letter each: n new, r repeats, s silent),
`columns`, `classes`, `links`, `open` and `safety`. The evidence is not kept: `disting compare
--also` gives it.

`next-dampers-<masses>-<undamped|damped>.jsonl`, shipped for 3 masses: the same for structures with
dampers to the ground, in groups in which at least one has some; a number is the place, from 0,
among all structures with all sets of dampers.
"""

import json
from collections.abc import Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, replace
from functools import cache, cached_property
from pathlib import Path

from disting.catalogs.catalog import Catalog
from disting.catalogs.dampers import DamperFamily, DamperSets, Masses
from disting.catalogs.files import Record, lines, shipped_folder, write_provenance
from disting.errors import CatalogError
from disting.experiments.menu import Costs, Gain
from disting.files import intact_text, write_whole
from disting.model.chain import Chain
from disting.model.family import Family
from disting.model.kinds import KINDS, Kind
from disting.model.presentation import plural, summary
from disting.verdict.buckets import NOT_KNOWN
from disting.verdict.engine import Engine, Progress, silent
from disting.verdict.next_experiments import Menu, menu_for
from disting.verdict.placement_record import TESTS, Placement, SpotClasses
from disting.verdict.result import View

SCHEMA = 1
SHIPPED_SIZES = (2, 3, 4, 5)
WITH_DAMPERS = (3,)  # shipped with dampers to the ground
COMMAND = "disting catalog next"
LETTERS = {g.value[0]: g for g in Gain}


def name_of(n_masses: int, damped: bool, dampers: bool = False) -> str:
    """Name of a file without its suffix, such as next-3-damped; `dampers`: to the ground."""
    kind = f"{n_masses}-{'damped' if damped else 'undamped'}"
    return f"next-dampers-{kind}" if dampers else f"next-{kind}"


@dataclass(frozen=True)
class NextCatalog:
    """Further measurements for all groups of a family; `records` is the file's content.

    `sets` of dampers to the ground, if any: then structures are counted from 0, each of the family
    with each set, else from 1.
    """

    family: Family
    records: tuple[Record, ...]
    sets: tuple[Masses, ...] = ()

    @property
    def name(self) -> str:
        """Name of the file without its suffix."""
        return name_of(self.family.n_masses, self.family.damped, bool(self.sets))

    def named(self, number: int) -> tuple[str, Chain]:
        """A structure with its name, such as 3:4 or 3:4+b1."""
        if not self.sets:
            return f"{self.family.n_masses}:{number}", self.family[number]
        model, chosen = number // len(self.sets) + 1, self.sets[number % len(self.sets)]
        name = "+".join([f"{self.family.n_masses}:{model}", *(f"b{m}" for m in chosen)])
        return name, replace(self.family[model], ground_dampers=chosen)

    def number(self, model: int, dampers: Masses = ()) -> int:
        """The number of a model of the family with these dampers to the ground."""
        return (model - 1) * len(self.sets) + self.sets.index(dampers) if self.sets else model

    def __repr__(self) -> str:
        name = name_of(self.family.n_masses, self.family.damped)
        return summary(self, f"{name}, {plural(len(self.groups), 'group')}")

    @property
    def groups(self) -> tuple[tuple[int, ...], ...]:
        """Structures that one measurement cannot distinguish, over complex parameters."""
        return tuple(tuple(r["group"]) for r in self.records[1:])

    @cached_property
    def _place(self) -> dict[int, int]:
        return {m: at for at, group in enumerate(self.groups, 1) for m in group}

    @cached_property
    def _read(self) -> dict[int, Menu[Chain]]:
        """Cache of the requested groups."""
        return {}

    def group(self, number: int) -> tuple[int, ...]:
        """The group of a structure, itself alone where it has none."""
        at = self._place.get(number)
        return self.groups[at - 1] if at else (number,)

    def further(self, numbers: Sequence[int], costs: Costs | None = None) -> Menu[Chain] | None:
        """Further measurements that distinguish these structures of one group, in this order; None
        if they are not at least two structures of one group, or if a kind with a cost is not in the
        file. Raises CatalogError for a damaged record.
        """
        costs = costs or Costs()
        places = {self._place.get(m) for m in numbers}
        at = places.pop()
        if places or at is None or len(set(numbers)) < 2:
            return None
        if at not in self._read:
            self._read[at] = _further(self, self.records[at])
        group, advice = self.groups[at - 1], self._read[at]
        if tuple(numbers) != group:
            advice = advice.only([group.index(m) for m in numbers])
        kinds = costs.kinds(self.family.n_masses)
        return replace(advice, costs=costs) if advice.tables.keys() >= set(kinds) else None


@cache
def next_catalog(n_masses: int, *, damped: bool = True, dampers: bool = False) -> NextCatalog:
    """Shipped catalogue of further measurements, of structures with `dampers` to the ground or
    without; raises CatalogError where there is none.

    >>> found = next_catalog(3, damped=True).further((1, 11))
    >>> [kind.name for kind in found.kinds if found.anywhere(kind)]
    ['sensor', 'force', 'inertia', 'lock']
    """
    return read(shipped_folder(), n_masses, damped, dampers)


def build_next(
    stored: Catalog | DamperFamily,
    engine: Engine,
    *,
    executor: Executor | None = None,
    progress: Progress = silent,
) -> str:
    """The text of the file that belongs to a catalogue, computed; the bytes do not depend on the
    machine or the order of the work.
    """
    empty, groups = _empty_catalog(stored)
    n = empty.family.n_masses
    header: Record = {
        "schema": SCHEMA,
        "catalog": empty.name,
        "groups": len(groups),
        "command": f"{COMMAND} {n}",
        "settings": engine.settings.to_dict(),
        "tests": list(TESTS),
    }
    records = [header]
    for done, members in enumerate(groups, 1):
        named = [empty.named(m) for m in members]
        advice = menu_for(named, engine, executor=executor, progress=progress)
        tables = {kind.name: _plain(table) for kind, table in advice.tables.items()}
        records.append({"group": list(members), **tables})
        progress("groups", done, len(groups))
    return lines(records)


def _empty_catalog(
    stored: Catalog | DamperFamily,
) -> tuple[NextCatalog, tuple[tuple[int, ...], ...]]:
    """A catalogue without answers, and the groups that it is about."""
    if isinstance(stored, Catalog):
        return NextCatalog(stored.family, ()), stored.classes(View.EXACT)
    empty = NextCatalog(stored.family, (), stored.sets)
    bare = {empty.number(m) for m in range(1, len(stored.family) + 1)}
    groups = (tuple(map(stored.place, names)) for names in stored.classes())
    return empty, tuple(g for g in groups if not bare.issuperset(g))


def write(text: str, folder: Path) -> Path:
    """Write a file, whose first line names it, and, last, the provenance of its folder; returns
    its path.
    """
    folder.mkdir(parents=True, exist_ok=True)
    name = json.loads(text.partition("\n")[0])["catalog"]
    path = write_whole(folder / f"{name}.jsonl", [text])
    write_provenance(folder)
    return path


def read(folder: Path, n_masses: int, damped: bool, dampers: bool = False) -> NextCatalog:
    """The file in a folder; raises CatalogError where it is missing, damaged or of another
    schema.
    """
    path = folder / f"{name_of(n_masses, damped, dampers)}.jsonl"
    remedy = f"make it with '{COMMAND} {n_masses}'"
    try:
        records = [json.loads(line) for line in intact_text(path).splitlines()]
        header = records[0]
        if header["schema"] != SCHEMA or not set(header["tests"]) <= set(TESTS):
            raise ValueError("another schema")
        if len(records) != header["groups"] + 1 or any(len(r["group"]) < 2 for r in records[1:]):
            raise ValueError("groups are missing")
        sets = DamperSets.ALL.of(n_masses) if dampers else ()
        return NextCatalog(Family(n_masses, damped), tuple(records), sets)
    except FileNotFoundError:
        raise CatalogError(f"there is no {path}; {remedy}") from None
    except (OSError, ValueError, LookupError, TypeError) as reason:
        raise CatalogError(f"{path} cannot be read ({reason}); {remedy}") from None


def verify_next(
    stored: Catalog | DamperFamily,
    folder: Path,
    engine: Engine,
    *,
    executor: Executor | None = None,
    progress: Progress = silent,
) -> list[str]:
    """Faults of the file of a catalogue, in sentences: its bytes are compared with those computed
    now.
    """
    family, dampers = stored.family, isinstance(stored, DamperFamily)
    kind = family.n_masses, family.damped, dampers
    path = folder / f"{name_of(*kind)}.jsonl"
    if not path.exists() and folder.resolve() != shipped_folder().resolve():
        return []  # a folder of one's own need not have it
    read(folder, *kind)
    text = build_next(stored, engine, executor=executor, progress=progress)
    rows = path.read_text(encoding="utf-8").splitlines()
    for number, (a, b) in enumerate(zip(rows, text.splitlines(), strict=False), 1):
        if a != b:
            return [f"{path.name}, line {number} is not what is computed now"]
    return [] if len(rows) == len(text.splitlines()) else [f"{path.name} has other groups"]


def _plain(table: Placement) -> Record:
    decided = table.decided
    assert isinstance(decided, SpotClasses)  # that of chains
    return {
        "gains": "".join(g.value[0] for g in table.gains),
        "columns": [list(row) for row in decided.columns],
        "classes": list(decided.classes),
        "links": list(decided.links),
        "open": sorted(map(list, decided.open)),
        "safety": decided.safety,
    }


def _further(stored: NextCatalog, record: Record) -> Menu[Chain]:
    n, numbers, tests = stored.family.n_masses, record["group"], stored.records[0]["tests"]
    try:
        tables = {
            kind: _read_placement(kind, n, len(numbers), record[kind.name], tests)
            for kind in KINDS
            if kind.name in record
        }
        names, chains = zip(*map(stored.named, numbers), strict=True)
        return Menu(names, chains, tables)
    except (LookupError, TypeError, ValueError) as reason:
        raise CatalogError(
            f"the group {numbers} cannot be read ({reason!r}); make it with '{COMMAND} {n}'"
        ) from None


def _read_placement(
    kind: Kind, n_masses: int, structures: int, plain: Record, tests: Sequence[str]
) -> Placement:
    """One table; a test that the file does not have is not known. Raises LookupError, TypeError or
    ValueError for what is none.
    """
    rows = [dict(zip(tests, map(int, row), strict=True)) for row in plain["columns"]]
    gains = tuple(LETTERS[letter] for letter in plain["gains"])
    decided = SpotClasses(
        tuple(tuple(row.get(test, NOT_KNOWN) for test in TESTS) for row in rows),
        tuple(map(int, plain["classes"])),
        tuple(map(str, plain["links"])),
        frozenset((int(a), int(b)) for a, b in plain["open"]),
        int(plain["safety"]),
    )
    lists = (gains, decided.columns, decided.classes, decided.links)
    if {len(each) for each in lists} != {n_masses * structures}:
        raise ValueError("masses are missing")
    places = (tuple(range(1, n_masses + 1)),) * structures
    return Placement(kind, places, gains, decided)
