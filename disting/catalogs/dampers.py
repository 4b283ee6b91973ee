"""Sets of dampers to the ground of one model, all against each other (Fig. 14 of the paper).

The paper compares one at a time: no damper, then one at mass 1, 2, .., N. `DamperSets.ALL` takes
all 2^N sets. Where two sets are indistinguishable over positive parameters, no experiment with this
force and sensor can show where the friction is.

A whole family with every set of ground dampers, 88, 464, 2336 models of 3, 4, 5 masses, is
compared by classes, all against all. The classes are files, shipped for 3, 4 and 5 masses.

`dampers-<masses>-<undamped|damped>.jsonl`: a header with the pairs of classes that are undecided,
then a line a model of the family with a list for each of its sets of dampers, in the order of
`DamperSets.ALL`: `columns` (buckets of the tests that the header names, 10 for the exact decision;
null where not known), `group`, `renamed`, `free` and `rank`, as in `verdict.classes`. Evidence is
kept of what was settled once (`files`); of all else `compare` gives it.
"""

import csv
import io
import json
from collections.abc import Iterator, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, replace
from enum import StrEnum
from functools import cache, cached_property
from itertools import combinations
from pathlib import Path

import numpy as np

from disting.catalogs.export import premise_text
from disting.catalogs.files import (
    Record,
    damper_name,
    lines,
    read_findings,
    shipped_folder,
    write_provenance,
)
from disting.conditions.rule import EXACT, WRITTEN
from disting.decide.same.low_cost import PATIENTLY
from disting.errors import CatalogError, InputError, of_type, short
from disting.files import intact_text, write_whole
from disting.model.chain import Chain
from disting.model.family import Family
from disting.model.names import read_together
from disting.model.presentation import plural, summary
from disting.model.question import Domain, Settings
from disting.model.symmetry import canonical
from disting.renamed import renamed
from disting.verdict.class_search import classes
from disting.verdict.classes import Classes
from disting.verdict.decisions import Decisions
from disting.verdict.engine import Engine, Progress, silent
from disting.verdict.forest import classes_of
from disting.verdict.result import Relation, Verdict, query_of

Masses = tuple[int, ...]
COLUMNS = ("left", "right", "relation", "decided_by", "domain", "damped", "quantity")


class DamperSets(StrEnum):
    """Sets of ground dampers: none or a single one, as in Fig. 14, or all 2^N."""

    SINGLE = "single"
    ALL = "all"

    def of(self, n_masses: int) -> tuple[Masses, ...]:
        """The sets in the order of size, then of masses.

        >>> [spell(masses) for masses in DamperSets.ALL.of(2)]
        ['0', '1', '2', '1+2']
        """
        most = n_masses if self is DamperSets.ALL else 1
        return tuple(
            chosen
            for size in range(most + 1)
            for chosen in combinations(range(1, n_masses + 1), size)
        )


def spell(masses: Masses) -> str:
    """A set as text: 0 for no damper, else the masses such as 1+3.

    >>> spell(()), spell((1, 3))
    ('0', '1+3')
    """
    return "+".join(map(str, masses)) or "0"


@dataclass(frozen=True)
class DamperTable:
    """All pairs of `sets` of ground dampers of one `chain`; the subjects of `decided` are in
    their order.
    """

    chain: Chain
    sets: tuple[Masses, ...]
    decided: Decisions

    def __repr__(self) -> str:
        return summary(self, f"{self.chain}, {plural(len(self.sets), 'set')} of ground dampers")

    @property
    def domain(self) -> Domain:
        """Parameter domain of the verdicts."""
        return self.decided.query.view.domain

    def relation(self, left: Masses, right: Masses) -> Relation:
        """Relation of two different sets; raises InputError for a set that is not in the table."""
        return self.decided.relation(*self._places(left, right))

    def verdict(self, left: Masses, right: Masses) -> Verdict:
        """The verdict with its evidence, the sets in the table's order."""
        return self.decided.verdict(*self._places(left, right))

    def rows(self) -> Iterator[tuple[Masses, Masses, Relation, str]]:
        """Yield (left, right, relation, deciding rule) of all pairs, left before right."""
        for i, j in combinations(range(len(self.sets)), 2):
            yield self.sets[i], self.sets[j], self.decided.relation(i, j), self.decided.rule(i, j)

    def classes(self) -> tuple[tuple[Masses, ...], ...]:
        """The sets grouped by indistinguishability, in the order of their first members; an
        undecided pair joins no groups.
        """
        classes = classes_of([spell(s) for s in self.sets], self.decided.relation)
        return tuple(tuple(self.sets[i] for i in members) for members in classes)

    def to_csv(self) -> str:
        """All pairs as CSV text: left, right, relation, decided_by ("" if undecided), domain,
        and the premise of the chain.
        """
        premise = premise_text(self.chain.premise, self.chain.premise)
        out = io.StringIO()
        writer = csv.writer(out, lineterminator="\n")
        writer.writerow(COLUMNS)
        rows = self.rows()
        writer.writerows(
            (spell(a), spell(b), relation.value, rule, self.domain.value, *premise)
            for a, b, relation, rule in rows
        )
        return out.getvalue()

    def _places(self, left: Masses, right: Masses) -> tuple[int, int]:
        if left == right or not {left, right} <= set(self.sets):
            raise InputError(
                f"the table holds pairs of two different sets of ground dampers, not {left} and"
                f" {right}"
            )
        return self.sets.index(left), self.sets.index(right)


@renamed(which="sets")
def dampers(
    chain: Chain | str,
    sets: DamperSets | str = DamperSets.SINGLE,
    *,
    damped: bool | None = None,
    domain: Domain | str = Domain.POSITIVE,
    engine: Engine | None = None,
    executor: Executor | None = None,
    progress: Progress = silent,
) -> DamperTable:
    """The table of a chain over a domain of parameters; ground dampers that it has already are
    replaced by each set in turn.

    `sets`: "single" (none, or one) or "all" 2^N; `chain` also by its name, to which `damped`
    applies; `domain`: "complex", "real" or "positive". Over positive parameters sets are undecided
    where they are indistinguishable over complex ones and no theorem decides. Raises InputError.

    >>> from disting.model.family import Family
    >>> dampers(Family(3, damped=True)[3], domain=Domain.COMPLEX).classes()
    (((),), ((1,), (2,), (3,)))
    """
    engine = engine or Engine()
    of_type(chain, Chain | str, "dampers are those of a chain, or of its name such as '3:4'")
    if isinstance(chain, str):
        (chain,) = read_together([chain], damped=damped)
    if sets not in tuple(DamperSets):
        raise InputError(f"sets is {' or '.join(DamperSets)}, not {short(sets)}")
    each = DamperSets(sets).of(chain.n_masses)
    subjects = [engine.subject(spell(s), replace(chain, ground_dampers=s)) for s in each]
    query = replace(query_of(None, domain), inclusion=False)
    decided = engine.decisions(subjects, query, executor=executor, progress=progress)
    return DamperTable(chain, each, decided)


# masses: there shares and ideals are asked where the synthesis is silent; for 5 they take up to
# hours, and `disting catalog settle` asks them once
PATIENT_UP_TO = 4
Name = tuple[int, Masses]
"""A model: its number in the family and the masses with a damper to the ground."""
SCHEMA = 1
SHIPPED_SIZES = (3, 4, 5)
COMMAND = "disting catalog dampers"
CLASS_COLUMNS = ("group", "renamed", "free", "rank")


@dataclass(frozen=True)
class DamperFamily:
    """All pairs of a family's models with `sets` of ground dampers; no pair is stored."""

    family: Family
    sets: tuple[Masses, ...]
    found: Classes

    def __repr__(self) -> str:
        return summary(self, f"{self.family!r}, {plural(len(self), 'model')}")

    def __len__(self) -> int:
        return len(self.found)

    def look_up(self, left: Name, right: Name) -> tuple[Relation, str]:
        """Relation and deciding rule ("" if undecided) of two models, in microseconds; raises
        InputError.
        """
        return self.found.look_up(self.place(left), self.place(right))

    def place(self, name: Name) -> int:
        """Place of a model, counted from 0; raises InputError for one that is not there."""
        number, masses = name
        if not 1 <= number <= len(self.family) or masses not in self._order:
            raise InputError(
                f"the family has models 1 to {len(self.family)} with sets of {self.family.n_masses}"
                f" masses, not {name}"
            )
        return (number - 1) * len(self.sets) + self._order[masses]

    def name(self, place: int) -> Name:
        """The model at a place."""
        return place // len(self.sets) + 1, self.sets[place % len(self.sets)]

    def classes(self) -> tuple[tuple[Name, ...], ...]:
        """Classes of two or more indistinguishable models."""
        return tuple(tuple(map(self.name, members)) for members in self.found.classes())

    def csv_lines(self) -> Iterator[str]:
        """Yield left, right, relation, decided_by, domain, damped, quantity of all pairs, models
        written 3:4+b1+b3, a line at a time.

        The domain is complex: over positive parameters, families are not decided.
        """
        yield "left,right,relation,decided_by,domain,damped,quantity\n"
        premise = ",".join(premise_text(*[self.family[1].premise] * 2))
        names = [self.text(i) for i in range(len(self))]
        for i, j, relation, rule in self.found.pairs():
            yield f"{names[i]},{names[j]},{relation.value},{rule},complex,{premise}\n"

    def text(self, place: int) -> str:
        """A model as `compare` names it."""
        number, masses = self.name(place)
        return "+".join([f"{self.family.n_masses}:{number}", *(f"b{m}" for m in masses)])

    def pair_text(self, left: int, right: int) -> str:
        """Two models in a sentence, with what their names leave out."""
        kind = "damped" if self.family.damped else "undamped"
        return f"{self.text(left)} and {self.text(right)}, {kind}"

    @cached_property
    def _order(self) -> dict[Masses, int]:
        return {masses: k for k, masses in enumerate(self.sets)}


def damper_family(
    n_masses: int,
    *,
    damped: bool = True,
    which: DamperSets = DamperSets.ALL,
    folder: Path | None = None,
    engine: Engine | None = None,
    executor: Executor | None = None,
    progress: Progress = silent,
) -> DamperFamily:
    """The classes of a family with sets of ground dampers; what is finished is in the engine's
    store, so that a run resumes.

    What was settled once is taken over: it is shipped, and may be in a `folder` of one's own.

    >>> found = damper_family(2, damped=True)
    >>> len(found), found.look_up((2, (1,)), (2, (2,)))[0].value
    (12, 'indistinguishable')
    """
    family, sets = Family(n_masses, damped), which.of(n_masses)
    chains = [replace(chain, ground_dampers=masses) for chain in family for masses in sets]
    the_classes = classes(
        chains,
        engine or Engine(),
        settled=read_findings((canonical(chain).chain for chain in chains), folder),
        more=[PATIENTLY] if n_masses <= PATIENT_UP_TO else [],
        executor=executor,
        progress=progress,
    )
    return DamperFamily(family, sets, the_classes)


@cache
def damper_catalog(n_masses: int, *, damped: bool = True) -> DamperFamily:
    """The shipped classes of a family with all sets of ground dampers; raises CatalogError where
    there are none.

    >>> damper_catalog(5, damped=True).look_up((1, (1, 2)), (1, (3,)))[0].value
    'distinguishable'
    """
    return read(shipped_folder(), n_masses, damped)


def text_of(the_family: DamperFamily, settings: Settings) -> str:
    """The file's text, naming the command that found it; the bytes do not depend on the machine
    or the order of the work.
    """
    family, classes, size = the_family.family, the_family.found, len(the_family.sets)
    header: Record = {
        "schema": SCHEMA,
        "catalog": damper_name(family.n_masses, family.damped),
        "models": len(family),
        "sets": size,
    }
    header |= {
        "command": f"{COMMAND} {family.n_masses}",
        "settings": settings.to_dict(),
        "tests": list(map(_rule_key, classes.tests)),
    }
    header |= {"undecided": sorted(map(list, classes.open_groups))}
    records = [header]
    for number in range(1, len(family) + 1):
        own_slice = slice((number - 1) * size, number * size)
        rows = [[None if x < 0 else int(x) for x in row] for row in classes.columns[own_slice]]
        lists = {name: getattr(classes, name)[own_slice].tolist() for name in CLASS_COLUMNS}
        records.append({"model": number, "columns": rows, **lists})
    return lines(records)


def read(folder: Path, n_masses: int, damped: bool) -> DamperFamily:
    """The classes in a folder; raises CatalogError where the file is missing, damaged or of
    another schema.
    """
    path = folder / f"{damper_name(n_masses, damped)}.jsonl"
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


def write(family: DamperFamily, settings: Settings, folder: Path) -> Path:
    """Write the file; returns its path."""
    folder.mkdir(parents=True, exist_ok=True)
    name = damper_name(family.family.n_masses, family.family.damped)
    path = write_whole(folder / f"{name}.jsonl", [text_of(family, settings)])
    write_provenance(folder)
    return path


def _rule_key(name: str) -> int | str:
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
    lists = {
        name: np.array([x for m in models for x in m[name]], np.int32) for name in CLASS_COLUMNS
    }
    if columns.shape != (len(chains), len(header["tests"])) or any(
        a.shape != (len(chains),) for a in lists.values()
    ):
        raise ValueError("sets of dampers are missing")
    undecided = frozenset((int(a), int(b)) for a, b in header["undecided"])
    tests = tuple(map(_read, header["tests"]))
    return DamperFamily(
        family, sets, Classes(chains, tests, columns, open_groups=undecided, **lists)
    )
