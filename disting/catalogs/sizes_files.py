"""All pairs of models of different sizes as files, shipped for 1 to 5 masses, and with the
catalogues of each size one look-up for all pairs.

`sizes-<undamped|damped>.jsonl`: a header, then a line a pair of two sizes, the smaller model as
`left`, both named N:I; like the line of a pair in a catalogue it holds the deciding step by its
representation, and the `inclusions` of models of unequal rank. Only limits are asked for, over
complex parameters; where nothing settles them the finding says why.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import accumulate, combinations, islice
from pathlib import Path

from disting.catalogs.catalog import Catalog, catalog
from disting.catalogs.files import SHIPPED_SIZES, Record, Records, shipped_folder
from disting.catalogs.pairs import StoredPair
from disting.catalogs.sizes import combined_family
from disting.errors import CatalogError, InputError
from disting.files import intact_text
from disting.model.chain import Chain, Premise
from disting.model.presentation import NotebookTable, plural, summary
from disting.verdict.query import View
from disting.verdict.result import Relation, Verdict

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
        """Whether every spring has a damper beside it."""
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
        """Relation of two models, without the verdict: those of two sizes are told apart."""
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
        """Let go of the verdicts that were asked for, those of the catalogues too."""
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
        """Verdicts that were asked for; pages ask for each a few times."""
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
