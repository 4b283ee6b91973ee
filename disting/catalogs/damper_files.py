"""The classes of whole families with all sets of ground dampers as files, shipped for 3, 4 and 5
masses.

`dampers-<masses>-<undamped|damped>.jsonl`: a header with the pairs of classes that are undecided,
then a line a model of the family with a list for each of its sets of dampers, in the order of
`DamperSets.ALL`: `columns` (buckets of the tests that the header names, 10 for the exact decision;
null where not known), `group`, `renamed`, `free` and `rank`, as in `verdict.classes`. Evidence is
kept of what was settled once (`damper_settled`); of all else `compare` gives it.
"""

import json
from collections.abc import Sequence
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np

from disting.catalogs.damper_family import DamperFamily
from disting.catalogs.dampers import DamperSets
from disting.catalogs.files import Record, lines, shipped_folder, write_provenance
from disting.conditions.rule import EXACT, WRITTEN
from disting.errors import CatalogError
from disting.files import intact_text, write_whole
from disting.model.family import Family
from disting.model.question import Settings
from disting.verdict.classes import Classes

SCHEMA = 1
SHIPPED_SIZES = (3, 4, 5)
COMMAND = "disting catalog dampers"
COLUMNS = ("group", "renamed", "free", "rank")


def name_of(n_masses: int, damped: bool) -> str:
    """Name of a file without its suffix, such as dampers-3-damped."""
    return f"dampers-{n_masses}-{'damped' if damped else 'undamped'}"


@cache
def damper_catalog(n_masses: int, *, damped: bool = True) -> DamperFamily:
    """The shipped classes of a family with all sets of ground dampers; raises CatalogError where
    there are none.

    >>> damper_catalog(5, damped=True).look_up((1, (1, 2)), (1, (3,)))[0].value
    'distinguishable'
    """
    return read(shipped_folder(), n_masses, damped)


def text_of(found: DamperFamily, settings: Settings) -> str:
    """The file's text, naming the command that found it; the bytes do not depend on the machine
    or the order of the work.
    """
    family, classes, size = found.family, found.found, len(found.sets)
    header: Record = {
        "schema": SCHEMA,
        "catalog": name_of(family.n_masses, family.damped),
        "models": len(family),
        "sets": size,
    }
    header |= {
        "command": f"{COMMAND} {family.n_masses}",
        "settings": settings.to_dict(),
        "tests": list(map(_written, classes.tests)),
    }
    header |= {"undecided": sorted(map(list, classes.open_groups))}
    records = [header]
    for number in range(1, len(family) + 1):
        here = slice((number - 1) * size, number * size)
        rows = [[None if x < 0 else int(x) for x in row] for row in classes.columns[here]]
        lists = {name: getattr(classes, name)[here].tolist() for name in COLUMNS}
        records.append({"model": number, "columns": rows, **lists})
    return lines(records)


def read(folder: Path, n_masses: int, damped: bool) -> DamperFamily:
    """The classes in a folder; raises CatalogError where the file is missing, damaged or of
    another schema.
    """
    path = folder / f"{name_of(n_masses, damped)}.jsonl"
    remedy = f"make it with '{COMMAND} {n_masses}'"
    try:
        header, *models = (json.loads(line) for line in intact_text(path).splitlines())
        if header["schema"] != SCHEMA:
            raise ValueError("another schema")
        return _family(Family(n_masses, damped), header, models)
    except FileNotFoundError:
        raise CatalogError(f"there is no {path}; {remedy}") from None
    except (OSError, ValueError, LookupError, TypeError) as reason:
        raise CatalogError(f"{path} cannot be read ({reason}); {remedy}") from None


def write(found: DamperFamily, settings: Settings, folder: Path) -> Path:
    """Write the file; returns its path."""
    folder.mkdir(parents=True, exist_ok=True)
    name = name_of(found.family.n_masses, found.family.damped)
    path = write_whole(folder / f"{name}.jsonl", [text_of(found, settings)])
    write_provenance(folder)
    return path


def _written(name: str) -> int | str:
    """The name of a rule as the files have it: numbers of one digit, and the exact decision
    after those of the paper.
    """
    if name == EXACT.name:
        return WRITTEN
    return int(name) if len(name) == 1 and name.isdecimal() else name


def _read(written: int | str) -> str:
    return EXACT.name if written == WRITTEN else str(written)


def _family(family: Family, header: Record, models: Sequence[Record]) -> DamperFamily:
    """Raises ValueError or LookupError for records that do not belong together."""
    sets = DamperSets.ALL.of(family.n_masses)
    if [m["model"] for m in models] != list(range(1, len(family) + 1)):
        raise ValueError("models are missing")
    chains = tuple(replace(chain, ground_dampers=masses) for chain in family for masses in sets)
    rows = [[-1 if x is None else x for x in row] for m in models for row in m["columns"]]
    columns = np.array(rows, np.int32)
    lists = {name: np.array([x for m in models for x in m[name]], np.int32) for name in COLUMNS}
    if columns.shape != (len(chains), len(header["tests"])) or any(
        a.shape != (len(chains),) for a in lists.values()
    ):
        raise ValueError("sets of dampers are missing")
    undecided = frozenset((int(a), int(b)) for a, b in header["undecided"])
    tests = tuple(map(_read, header["tests"]))
    return DamperFamily(
        family, sets, Classes(chains, tests, columns, open_groups=undecided, **lists)
    )
