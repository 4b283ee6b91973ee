"""All pairs of models of different sizes as files, shipped for 1 to 5 masses, and with the
catalogues of each size one look-up for all pairs.

`sizes-<undamped|damped>.jsonl`: a header, then a line a pair of two sizes, the smaller model as
`left`, both named N:I; like the line of a pair in a catalogue it holds the deciding step by its
representation, and the `inclusions` of models of unequal rank. Only limits are decided, over
complex parameters; where they stay open the finding gives the reason.

Models of different sizes differ in their degrees (conditions 1 and 2); but the smaller model may
lie inside the larger one, as a limit (see `decide.inclusion.across_sizes`). The file is
computed, written, and verified like a catalogue.
"""

from collections.abc import Iterator, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import accumulate, combinations, islice
from pathlib import Path
from typing import Any

from disting.catalogs.build import step
from disting.catalogs.catalog import Catalog, StoredPair, catalog
from disting.catalogs.files import (
    INCLUSIONS,
    LEFT_POSITIVE,
    RIGHT_POSITIVE,
    SHIPPED_SIZES,
    Record,
    Records,
    lines,
    shipped_folder,
    write_provenance,
)
from disting.conditions.chain_view import ChainView
from disting.conditions.inclusion import inclusions_from_dict, inclusions_to_dict
from disting.conditions.side import Side
from disting.decide.inclusion.confirmation import confirms
from disting.decide.inclusion.decide import CLOSURE, IMAGE, turn
from disting.decide.same.evidence_check import Witness
from disting.decide.same.real_and_positive import POSITIVELY
from disting.errors import CatalogError, InputError
from disting.evidence.positive import PositiveFinding
from disting.files import intact_text, write_whole
from disting.model.chain import Chain, Premise, Quantity
from disting.model.family import Family
from disting.model.presentation import NotebookTable, plural, summary
from disting.model.question import Models, Question
from disting.model.symmetry import canonical
from disting.verdict.decisions import Decisions
from disting.verdict.engine import Engine, Progress, silent
from disting.verdict.result import Query, Relation, Verdict, View


def combined_family(
    sizes: Sequence[int], *, damped: bool = True, quantity: Quantity = Quantity.ACCELERATION
) -> tuple[tuple[str, Chain], ...]:
    """All models of several sizes with their names, in the order of sizes and numbers; raises
    InputError for none.

    >>> [name for name, _ in combined_family((1, 2), damped=False)]
    ['1:1', '2:1', '2:2', '2:3']
    """
    if not sizes:
        raise InputError("a combined family needs at least one size")
    families = (Family(n, damped, quantity) for n in sorted(set(sizes)))
    return tuple(
        (f"{f.n_masses}:{number}", chain) for f in families for number, chain in enumerate(f, 1)
    )


def combine(
    sizes: Sequence[int],
    *,
    damped: bool = True,
    quantity: Quantity = Quantity.ACCELERATION,
    query: Query | None = None,
    engine: Engine | None = None,
    executor: Executor | None = None,
    progress: Progress = silent,
) -> Decisions:
    """The verdicts on all pairs, with the inclusion of smaller models in larger ones; the subjects
    are named N:I.

    Of the 482 pairs of different size of 1 to 4 masses, the smaller model lies in the larger one
    in 417 without dampers and in 441 with dampers; in the others it does not.

    >>> found = combine((1, 2), damped=False)
    >>> found.subjects[2].name, found.relation(0, 2).value, found.verdict(0, 2).closure.value
    ('2:2', 'distinguishable', 'left-in-right')
    """
    engine = engine or Engine()
    subjects = [
        engine.subject(*named) for named in combined_family(sizes, damped=damped, quantity=quantity)
    ]
    return engine.decisions(subjects, query or Query(), executor=executor, progress=progress)


def answers_in(catalog: Catalog) -> Iterator[tuple[Question[Any], Models, Any]]:
    """Yield what a catalogue answers about pairs of its models: which are limits or equivalents
    of others, and which positive ones have positive equivalents.

    The question, the canonical forms in its order, and the answer, as an engine remembers it.

    >>> from disting.catalogs import catalog
    >>> from collections import Counter
    >>> sorted(Counter(question.name for question, *_ in answers_in(catalog(2))).items())
    [('closures', 2), ('images', 2), ('positive equivalents', 4)]
    """
    n = len(catalog.family)
    forms = [canonical(chain).chain for chain in catalog.family]
    ranks = [catalog.record(number)["rank"] for number in range(1, 1 + n)]
    for record in catalog.records[1 + n :]:
        i, j = record["left"] - 1, record["right"] - 1
        for name, value, other in ((LEFT_POSITIVE, i, j), (RIGHT_POSITIVE, j, i)):
            if name in record:
                finding = PositiveFinding.from_dict(record[name])
                yield POSITIVELY, (forms[value], forms[other]), finding
        if INCLUSIONS in record:
            both = inclusions_from_dict(record[INCLUSIONS])
            small, large = (i, j) if ranks[i] < ranks[j] else (j, i)
            for question, part in ((IMAGE, both.image), (CLOSURE, both.closure)):
                yield question, (forms[small], forms[large]), part if small == i else turn(part)


SCHEMA = 1
COMMAND = "disting catalog sizes"
VIEWS = (View.POSITIVE, View.REAL, View.EXACT)  # the paper's views are not kept


def name_of(damped: bool) -> str:
    """Name of a file without its suffix, and of its page, such as sizes-damped."""
    return f"sizes-{'damped' if damped else 'undamped'}"


@dataclass(frozen=True)
class SizesCatalog(NotebookTable):
    """All verdicts on the models of several sizes, counted from 1 in the order of sizes.

    `catalogs`: one a size, for the pairs of one size; `records`: the file's content.

    >>> found = sizes_catalog(damped=True)
    >>> found.names[3], found.verdict(1, 4).closure.value
    ('2:3', 'left-in-right')
    """

    catalogs: tuple[Catalog, ...]
    records: Sequence[Record]

    def __repr__(self) -> str:
        return summary(self, f"{self.name}, {plural(len(self.family), 'model')}")

    @property
    def damped(self) -> bool:
        """True if every spring has a damper in parallel."""
        return self.catalogs[0].damped

    @property
    def name(self) -> str:
        """Such as sizes-damped."""
        return name_of(self.damped)

    @property
    def premise(self) -> Premise:
        """Damping and sensor quantity of all models."""
        return self.catalogs[0].premise

    @cached_property
    def family(self) -> tuple[Chain, ...]:
        """The models."""
        return tuple(chain for c in self.catalogs for chain in c.family)

    @cached_property
    def names(self) -> tuple[str, ...]:
        """Names of the models, such as 3:4."""
        return tuple(f"{c.n_masses}:{i}" for c, i in self._places)

    def size(self, model: int) -> int:
        """Number of masses of a model."""
        return self._places[model - 1][0].n_masses

    def verdict(self, left: int, right: int, view: View = View.POSITIVE) -> Verdict:
        """The stored verdict on two different models, the smaller number first.

        Raises InputError for other models and views, CatalogError for a damaged record.
        """
        key = (*self._pair(left, right, view), view)
        if key not in self._known:
            self._known[key] = self._read(*key)
        return self._known[key]

    def relation(self, left: int, right: int, view: View = View.POSITIVE) -> Relation:
        """Relation of two models, without the verdict: those of two sizes are distinguishable."""
        low, high = self._pair(left, right, view)
        (this_catalog, i), (other, j) = self._places[low - 1], self._places[high - 1]
        return (
            this_catalog.relation(i, j, view) if this_catalog is other else Relation.DISTINGUISHABLE
        )

    def pairs(self, view: View = View.POSITIVE) -> Iterator[tuple[int, int, Verdict]]:
        """All pairs, left < right."""
        for low, high in combinations(range(1, len(self.family) + 1), 2):
            yield low, high, self.verdict(low, high, view)

    def classes(self, view: View = View.POSITIVE) -> tuple[tuple[int, ...], ...]:
        """Groups of two or more mutually indistinguishable models: those of each size, since
        models of two sizes are distinguishable.
        """
        return tuple(
            tuple(before + m for m in group)
            for before, c in zip(self._before, self.catalogs, strict=True)
            for group in c.classes(view)
        )

    def depending(self, view: View = View.POSITIVE) -> tuple[tuple[int, int], ...]:
        """The pairs that are indistinguishable for some parameters only."""
        return tuple(
            (before + i, before + j)
            for before, c in zip(self._before, self.catalogs, strict=True)
            for i, j in c.depending(view)
        )

    def forget(self) -> None:
        """Drop the cached verdicts, those of the catalogues too."""
        self._known.clear()
        for c in self.catalogs:
            c.forget()

    def _read(self, low: int, high: int, view: View) -> Verdict:
        left, right = self.names[low - 1], self.names[high - 1]
        (this_catalog, i), (other, j) = self._places[low - 1], self._places[high - 1]
        if this_catalog is other:
            return this_catalog.verdict(i, j, view)
        if view is not View.EXACT:  # what distinguishes over complex parameters does so over all
            return replace(self.verdict(low, high, View.EXACT), domain=view.domain)
        try:
            pair = StoredPair(self.records[self._across[left, right]])
            return pair.verdict(view, (left, right), (this_catalog.premise, other.premise))
        except (KeyError, TypeError, ValueError, AttributeError) as reason:
            raise CatalogError(
                f"{self.name}, {left} and {right} cannot be read ({reason!r});"
                f" make it with '{COMMAND}'"
            ) from None

    def _pair(self, left: int, right: int, view: View) -> tuple[int, int]:
        low, high = sorted((left, right))
        if low == high or not 1 <= low <= high <= len(self.family):
            raise InputError(
                f"{self.name} holds pairs of two different models 1 to {len(self.family)}, not"
                f" {left} and {right}"
            )
        if view not in VIEWS:
            raise InputError(f"{self.name} holds no verdicts of the view {view}: ask a catalogue")
        return low, high

    @cached_property
    def _places(self) -> tuple[tuple[Catalog, int], ...]:
        """The catalogue of each model and its number there."""
        return tuple((c, i) for c in self.catalogs for i in range(1, len(c.family) + 1))

    @cached_property
    def _before(self) -> tuple[int, ...]:
        """Number of models before those of each catalogue."""
        return (0, *accumulate(len(c.family) for c in self.catalogs))[:-1]

    @cached_property
    def _known(self) -> dict[tuple[int, int, View], Verdict]:
        """Cache of the requested verdicts; pages request each a few times."""
        return {}

    @cached_property
    def _across(self) -> dict[tuple[str, str], int]:
        """Places of the records by the names of their models."""
        pairs = ((r["left"], r["right"]) for r in islice(self.records, 1, None))
        return {pair: at for at, pair in enumerate(pairs, 1)}


def sizes_catalog(
    *, damped: bool = True, folder: Path | None = None, known: Sequence[Catalog] = ()
) -> SizesCatalog:
    """The shipped verdicts on all models of 1 to 5 masses (or those of another folder); no
    computation.

    `known`: catalogues that are in memory already. Raises CatalogError where a file is missing,
    damaged or of another schema.
    """
    path = (folder or shipped_folder()) / f"{name_of(damped)}.jsonl"
    try:
        records = Records(tuple(intact_text(path).splitlines()))
        _check(records)
    except FileNotFoundError:
        raise CatalogError(f"there is no {path}; make it with '{COMMAND}'") from None
    except (OSError, ValueError, LookupError, TypeError) as reason:
        raise CatalogError(f"{path} cannot be read ({reason}); make it with '{COMMAND}'") from None
    catalogs = {(c.n_masses, c.damped): c for c in known}
    return SizesCatalog(
        tuple(
            catalogs.get((n, damped)) or catalog(n, damped=damped, folder=folder)
            for n in SHIPPED_SIZES
        ),
        records,
    )


def pairs_across() -> Iterator[tuple[str, str]]:
    """Names of all pairs of two sizes, the smaller model first, in the order of the file."""
    named = combined_family(SHIPPED_SIZES, damped=False)
    for (left, chain), (right, other) in combinations(named, 2):
        if chain.n_masses != other.n_masses:
            yield left, right


def _check(records: Sequence[Record]) -> None:
    """Raises ValueError or LookupError for records that are not those of a file, complete."""
    if records[0]["schema"] != SCHEMA:
        raise ValueError("another schema")
    wanted = pairs_across()
    for record in islice(records, 1, None):
        if (record["left"], record["right"]) != next(wanted, None):
            raise ValueError("pairs are missing")
        step = StoredPair(record).step(View.EXACT)
        if step is None or step.relation is not Relation.DISTINGUISHABLE:
            raise ValueError("models of two sizes are distinguishable")
    if next(wanted, None):
        raise ValueError("pairs are missing")


def build_sizes(
    *,
    damped: bool,
    engine: Engine,
    folder: Path | None = None,
    sizes: Sequence[int] = SHIPPED_SIZES,
    executor: Executor | None = None,
    progress: Progress = silent,
) -> str:
    """The file's text; the bytes do not depend on the machine or the order of the work.

    Verdicts on pairs of one size are taken from the catalogues of the sizes (of a folder, or the
    shipped ones).
    """
    for n in sizes:
        stored = catalog(n, damped=damped, folder=folder)
        if stored.record(0)["settings"] == engine.settings.to_dict():
            for parts in answers_in(stored):
                engine.remember(*parts)
    decisions = combine(
        sizes,
        damped=damped,
        query=Query(View.EXACT),
        engine=engine,
        executor=executor,
        progress=progress,
    )
    header: Record = {
        "schema": SCHEMA,
        "catalog": name_of(damped),
        "sizes": list(SHIPPED_SIZES),
        "models": len(decisions.subjects),
        "command": COMMAND,
        "settings": engine.settings.to_dict(),
    }
    return lines([header, *_pairs(decisions)])


def write(text: str, damped: bool, folder: Path) -> Path:
    """Write the file and, last, the provenance of its folder; returns its path."""
    folder.mkdir(parents=True, exist_ok=True)
    path = write_whole(folder / f"{name_of(damped)}.jsonl", [text])
    write_provenance(folder)
    return path


def verify_sizes(
    *,
    damped: bool,
    folder: Path,
    engine: Engine,
    executor: Executor | None = None,
    progress: Progress = silent,
) -> list[str]:
    """Faults of the file, in sentences: its bytes are compared with those computed now, and every
    piece of evidence is checked by itself.
    """
    path = folder / f"{name_of(damped)}.jsonl"
    if not path.exists() and folder.resolve() != shipped_folder().resolve():
        return []  # a folder of one's own need not have it
    stored = sizes_catalog(damped=damped, folder=folder)
    text = build_sizes(
        damped=damped, engine=engine, folder=folder, executor=executor, progress=progress
    )
    rows = lines(list(stored.records)).splitlines()
    differ = (
        f"{stored.name}.jsonl, line {number} is not what is computed now"
        for number, (a, b) in enumerate(zip(rows, text.splitlines(), strict=True), 1)
        if a != b
    )
    return [*([first] if (first := next(differ, "")) else []), *false_evidence(stored, progress)]


def false_evidence(stored: SizesCatalog, progress: Progress = silent) -> Iterator[str]:
    """Yield a sentence for each piece of evidence on two sizes that does not hold."""
    witness, chains = Witness(), stored.family
    named = zip(stored.names, chains, strict=True)
    subjects = [Side(name, ChainView(chain)) for name, chain in named]
    across = [
        (i, j)
        for i, j in combinations(range(len(chains)), 2)
        if chains[i].n_masses != chains[j].n_masses
    ]
    for done, (i, j) in enumerate(across, 1):
        v = stored.verdict(i + 1, j + 1, View.EXACT)
        where = f"{stored.name}, {v.left} and {v.right}"
        if v.evidence and not witness.confirms(v.evidence, v.representation, chains[i], chains[j]):
            yield f"{where}: the evidence of {v.rule} does not hold"
        limits = None if v.inclusions is None else v.inclusions.closure.evidence
        if limits is not None and not confirms(limits, subjects[i], subjects[j]):
            yield f"{where}: the evidence of the inclusion (limits) does not hold"
        progress("evidence", done, len(across))


def _pairs(decisions: Decisions) -> Iterator[Record]:
    """A record a pair of two sizes."""
    sizes, names = decisions.sizes, [s.name for s in decisions.subjects]
    for i, j in combinations(range(len(names)), 2):
        if sizes[i] != sizes[j]:
            both = decisions.inclusions.get((i, j))
            fields = {} if both is None else {INCLUSIONS: inclusions_to_dict(both)}
            where = decisions.verdict(i, j).representation.value
            yield {"left": names[i], "right": names[j], **fields, where: step(decisions, i, j)}
